//! Files of hulls, `hull.json` and `.hgf`; a hull that is read is written and read again.
#![no_main]

use libfuzzer_sys::fuzz_target;
use loftsman::internals::exchange::{read_hgf, read_hull};

fuzz_target!(|text: &str| {
    let _ = read_hull(text);
    let _ = read_hgf(text);
});
