//! Curves as CSV, and the record of a fairing that `report` reads.
#![no_main]

use libfuzzer_sys::fuzz_target;
use loftsman::internals::exchange::{read_curve, read_fairing};
use loftsman::internals::units::Notation;

fuzz_target!(|text: &str| {
    let _ = read_curve(text, Notation::Metres);
    let _ = read_fairing(text);
});
