//! What stands for packages in a library that was built without them.

use crate::hull::HullMesh;

/// A 3MF package of a mesh.
///
/// # Errors
/// Always: this library was built without the feature `packages`.
pub fn write_threemf(_: &HullMesh, _: f64) -> Result<Vec<u8>, String> {
    Err("3MF needs the feature `packages` of the library".to_owned())
}
