//! Meshes for other programs: triangles as STL, OBJ, GLB; panels below a draught as GDF, NEMOH, PNL.

mod gdf;
mod glb;
mod nemoh;
mod obj;
mod pnl;
mod stl;

pub use gdf::write_gdf;
pub use glb::write_glb;
pub use nemoh::write_nemoh;
pub use obj::write_obj;
pub(super) use obj::{is_obj, read_obj};
pub use pnl::write_pnl;
pub(super) use stl::{is_stl, read_stl};
pub use stl::{write_stl, write_stl_ascii};

use crate::hull::{HullMesh, Region};
use crate::spline::{cross, dot, minus};

/// Meshes of more triangles are not read.
const MOST_TRIANGLES: usize = 4_000_000;

/// After so many faults the rest of a file is not read.
const MOST_FAULTS: usize = 100;

/// Coordinates larger than this are of no ship in any unit.
const LARGEST: f64 = 1e8;

/// What is wrong with a record of a mesh.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct MeshFault {
    /// Line, from 1; none in binary files and of the whole.
    pub(super) line: Option<usize>,
    /// What stands there.
    pub(super) found: String,
    /// What is wrong with it.
    pub(super) message: String,
}

/// The faults found so far.
#[derive(Debug, Default)]
struct Faults {
    list: Vec<MeshFault>,
}

impl Faults {
    fn add(&mut self, line: Option<usize>, found: &str, message: String) {
        if !self.is_full() {
            self.list.push(MeshFault { line, found: found.chars().take(80).collect(), message });
        }
    }

    fn is_full(&self) -> bool {
        self.list.len() >= MOST_FAULTS
    }

    /// A point of `count` words that must be numbers.
    fn point(&mut self, line: usize, text: &str, words: &[&str], count: usize) -> Option<[f64; 3]> {
        if words.len() != count {
            self.add(Some(line), text, format!("{} numbers, expected {count}", words.len()));
            return None;
        }
        let mut point = [0.0; 3];
        for (slot, word) in point.iter_mut().zip(words) {
            match word.parse::<f64>() {
                Ok(value) if value.abs() <= LARGEST => *slot = value,
                _ => {
                    self.add(Some(line), word, "expected a number of at most 1e8".to_owned());
                    return None;
                }
            }
        }
        Some(point)
    }

    fn or<T>(self, value: impl FnOnce() -> T) -> Result<T, Vec<MeshFault>> {
        if self.list.is_empty() { Ok(value()) } else { Err(self.list) }
    }
}

/// Regions of a mesh that have triangles, in the order of files, each with its triangles.
fn regions(mesh: &HullMesh) -> Vec<(Region, Vec<[usize; 3]>)> {
    let of = |wanted: Region| -> Vec<[usize; 3]> {
        mesh.triangles.iter().filter(|(region, _)| *region == wanted).map(|(_, corners)| *corners).collect()
    };
    Region::ALL.into_iter().map(|region| (region, of(region))).filter(|(_, list)| !list.is_empty()).collect()
}

/// A name on one line of printable ASCII, at most 72 of its characters.
fn title(name: &str) -> String {
    name.chars().take(72).map(|c| if c == ' ' || c.is_ascii_graphic() { c } else { '_' }).collect()
}

/// The normal of unit length of a triangle; zero where it has no area.
fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let n = cross(minus(b, a), minus(c, a));
    let length = dot(n, n).sqrt();
    if length > 0.0 { n.map(|c| c / length) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests;
