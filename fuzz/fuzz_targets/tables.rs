//! Tables of offsets of every format: the first byte chooses the name, the rest are the bytes.
#![no_main]

use libfuzzer_sys::fuzz_target;
use loftsman::internals::exchange::{read_table, write_britfair, write_freeship, write_ghs, write_pdstrip, write_pias};

const NAMES: &[&str] = &["a.csv", "a.gf", "a.bri", "a.txt", "a.xlsx", "in.mlt", "a.seaway", "a.igs", "a.dxf", "a.3dm"];

fuzz_target!(|data: &[u8]| {
    let Some((first, bytes)) = data.split_first() else { return };
    let name = NAMES[usize::from(*first) % NAMES.len()];
    if let Ok(read) = read_table(name, bytes) {
        for write in [write_ghs, write_britfair, write_pias, write_pdstrip, write_freeship] {
            let _ = write(&read.table);
        }
    }
});
