//! Design files, and the lengths and lists of the command line.
#![no_main]

use libfuzzer_sys::fuzz_target;
use loftsman::internals::{config, units};

fuzz_target!(|text: &str| {
    let _ = config::read("hull.toml", text);
    let _ = units::parse(text);
    let _ = units::parse_list(text);
});
