//! Vertices of meshes, each once.

use std::collections::HashMap;

/// Places of vertices by the bits of their coordinates.
#[derive(Default)]
pub(super) struct Known(HashMap<[u64; 3], usize>);

impl Known {
    /// The index of `point` among `vertices`, which gets it where it is new.
    pub(super) fn place(&mut self, vertices: &mut Vec<[f64; 3]>, point: [f64; 3]) -> usize {
        // -0 is 0.
        let point = point.map(|c| c + 0.0);
        *self.0.entry(point.map(f64::to_bits)).or_insert_with(|| {
            vertices.push(point);
            vertices.len() - 1
        })
    }
}
