//! Meshes, surfaces of CAD files and control nets: the first byte chooses the name, the rest are the bytes.
#![no_main]

use libfuzzer_sys::fuzz_target;
use loftsman::internals::exchange::{read_body, read_subdivision, write_ftm};

const NAMES: &[&str] = &[
    "a.stl", "a.obj", "a.igs", "a.step", "a.fbm", "a.ftm", "a.glb", "a.gdf", "a.pnl", "a.mar", "a.ply", "a.off", "a.vtk",
    "a.vtu", "a.vtp", "a.msh", "a.3mf", "a.hst", "a.gltf", "a.dxf", "a.3dm",
];

fuzz_target!(|data: &[u8]| {
    let Some((first, bytes)) = data.split_first() else { return };
    let name = NAMES[usize::from(*first) % NAMES.len()];
    if let Some(Ok(body)) = read_body(name, bytes, None) {
        let _ = body.table();
    }
    if let Some(Ok(project)) = read_subdivision(name, bytes) {
        let again = read_subdivision("a.ftm", write_ftm(&project).as_bytes());
        assert!(again.is_some_and(|read| read.is_ok_and(|read| read.net == project.net)));
    }
});
