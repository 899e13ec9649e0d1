//! Independent work on two threads.

use std::panic::resume_unwind;
use std::thread;

/// Two things at once, whose results do not depend on each other; the second on the thread of the caller. A panic of
/// either is the caller's.
pub fn join<A: Send, B>(first: impl FnOnce() -> A + Send, second: impl FnOnce() -> B) -> (A, B) {
    thread::scope(|scope| {
        let first = scope.spawn(first);
        let second = second();
        (first.join().unwrap_or_else(|panic| resume_unwind(panic)), second)
    })
}
