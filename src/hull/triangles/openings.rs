//! Lines of open edges, and triangles that cover them.

use super::{ONE, TriangleMesh, triangle_area};
use std::collections::HashMap;

/// Directed edges end to end as lines of vertices: those with loose ends first, then the loops, whose first vertex is their last.
#[must_use]
pub fn lines_of_edges(edges: &[[usize; 2]]) -> Vec<Vec<usize>> {
    let mut ends: HashMap<usize, Vec<usize>> = HashMap::new();
    let mut excess: HashMap<usize, i64> = HashMap::new();
    for &[from, to] in edges.iter().rev() {
        ends.entry(from).or_default().push(to);
        *excess.entry(from).or_default() += 1;
        *excess.entry(to).or_default() -= 1;
    }
    let mut found = Vec::new();
    for loose in [true, false] {
        for &[first, _] in edges {
            if loose && excess.get(&first).is_none_or(|count| *count <= 0) {
                continue;
            }
            let (mut line, mut at) = (vec![first], first);
            while let Some(next) = ends.get_mut(&at).and_then(Vec::pop) {
                line.push(next);
                at = next;
            }
            if line.len() > 1 {
                *excess.entry(first).or_default() -= 1;
                *excess.entry(at).or_default() += 1;
                found.push(line);
            }
        }
    }
    found
}

/// Triangles from the middle of a line of points to its edges and to the chord between its ends. They close the skin whose open
/// edges run along the line.
#[must_use]
pub fn cover(line: &[[f64; 3]]) -> Vec<[[f64; 3]; 3]> {
    let count = line.len().max(1) as f64;
    let middle = [0, 1, 2].map(|k: usize| line.iter().map(|point| point[k]).sum::<f64>() / count);
    let edges = line.iter().zip(line.iter().cycle().skip(1));
    edges.map(|(&from, &to)| [to, from, middle]).collect()
}

impl TriangleMesh {
    /// Open edges that no other lies on, within 1e-4 of the size of the body, end to end.
    #[must_use]
    pub fn open_lines(&self) -> Vec<Vec<usize>> {
        lines_of_edges(&self.openings(ONE))
    }

    /// The area of what covers the openings \[m^2\].
    pub(super) fn open_area(&self) -> f64 {
        let area = |line: &Vec<usize>| {
            let points: Vec<[f64; 3]> = line.iter().map(|&vertex| self.vertices[vertex]).collect();
            cover(&points).into_iter().map(triangle_area).sum::<f64>()
        };
        self.open_lines().iter().map(area).sum()
    }
}
