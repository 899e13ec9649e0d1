//! Whether the skin of a body of triangles is what its figures take it to be.
//!
//! The figures are int y n_y dS and int y dx along the waterline, to which a missing deck, transom or flat bow adds nothing. Of
//! a closed skin below a draught T these hold:
//!
//! ```text
//! A_W = int y dx = - int n_z dS
//! V = int x n_x dS = int y n_y dS = int (z - T) n_z dS
//! ```
//!
//! Where they do not, the open edges below T are joined to lines, each closed by a chord and covered by triangles from its
//! middle. The figures miss what covers add to int y n_y dS, and chords at the waterline to int y dx. With the covers the
//! integrals agree, unless the skin is turned over in part, has sheets inside, or slits.

use super::{Clipped, WaterlineSums};
use crate::hull::{TriangleMesh, cover, lines_of_edges};
use crate::spline::{cross, length, minus};
use std::collections::HashMap;

/// Relative error of the integrals of a closed skin, at most.
const AGREES: f64 = 1e-3;

/// The skin is looked at so far below a draught, over the height of the body: plates may end at the draught itself.
const BELOW: f64 = 1.37e-3;

/// Draughts nearer to the lowest point than this part of the height are not looked at.
const LEAST: f64 = 0.02;

/// Waterplanes less than this part of the mean area of those below are compared with it.
const SMALL: f64 = 0.1;

/// A cover whose vertical part is more than this part of its area is a deck.
const DECK: f64 = 0.5;

/// What integrals over a skin below a draught contradict.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(hidden)]
pub struct Unclosed {
    /// The draught \[m\].
    pub draught: f64,
    /// By how much volumes differ at most, over the volume.
    pub volume: f64,
    /// By how much areas of the waterplane differ at most, over the area.
    pub waterplane: f64,
    /// Whether the draught is above the rim of an open deck.
    pub above_rim: bool,
}

/// Integrals over a skin below a draught: volumes by their three coordinates, and areas of the waterplane by the waterline and
/// by the skin.
#[derive(Debug, Clone, Copy, Default)]
struct Integrals {
    volumes: [f64; 3],
    line: f64,
    skin: f64,
}

impl Integrals {
    /// Adds a triangle below the draught; coordinates count from `origin`.
    fn add(&mut self, [a, b, c]: [[f64; 3]; 3], origin: [f64; 3]) {
        let normal = cross(minus(b, a), minus(c, a));
        for (k, volume) in self.volumes.iter_mut().enumerate() {
            *volume += normal[k] * (a[k] + b[k] + c[k] - 3.0 * origin[k]) / 6.0;
        }
        self.skin -= 0.5 * normal[2];
    }

    fn plus(&self, other: &Self) -> Self {
        let volumes = [0, 1, 2].map(|k: usize| self.volumes[k] + other.volumes[k]);
        Self { volumes, line: self.line + other.line, skin: self.skin + other.skin }
    }

    /// How far volumes and areas differ among themselves, over those given.
    fn off(&self, [volume, area]: [f64; 2]) -> [f64; 2] {
        let ends = |pick: fn(f64, f64) -> f64| pick(pick(self.volumes[0], self.volumes[1]), self.volumes[2]);
        [(ends(f64::max) - ends(f64::min)) / volume, (self.line - self.skin).abs() / area]
    }
}

/// What the skin below a draught \[m\] contradicts (see the head of the module); none where it agrees within 1e-3, or hardly
/// anything is immersed.
#[must_use]
#[doc(hidden)]
pub fn unclosed(mesh: &TriangleMesh, draught: f64) -> Option<Unclosed> {
    Looked { mesh }.unclosed(draught)
}

/// A mesh whose skin is looked at.
struct Looked<'a> {
    mesh: &'a TriangleMesh,
}

impl Looked<'_> {
    fn unclosed(&self, draught: f64) -> Option<Unclosed> {
        let [least, greatest] = self.mesh.bounds()?;
        let height = greatest[2] - least[2];
        let level = draught.min(greatest[2]) - BELOW * height;
        if level - least[2] <= LEAST * height {
            return None;
        }
        let origin = [0.5 * (least[0] + greatest[0]), 0.0, level];
        let skin = self.integrals(level, origin);
        let volume = skin.volumes.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let area = skin.line.abs().max(SMALL * volume / (level - least[2]));
        if volume <= 0.0 || skin.off([volume, area]).iter().all(|off| *off <= AGREES) {
            return None;
        }
        let lines = self.mesh.open_lines();
        let covers = self.covers(&lines, level, origin);
        let [apart, beside] = skin.plus(&covers).off([volume, area]);
        let decks: Vec<[f64; 2]> = lines.iter().filter_map(|line| self.deck(line)).collect();
        let above_rim = decks.iter().any(|[lowest, _]| *lowest < level);
        // Below an open deck that is all under water the body is no closed one.
        let [alone, _] = skin.off([volume, area]);
        let apart = if decks.iter().any(|[_, highest]| *highest < level) { apart.max(alone) } else { apart };
        let volume = apart.max((covers.volumes[1] / volume).abs());
        let waterplane = beside.max((covers.line / area).abs());
        (volume.max(waterplane) > AGREES).then_some(Unclosed { draught, volume, waterplane, above_rim })
    }

    fn integrals(&self, level: f64, origin: [f64; 3]) -> Integrals {
        let (mut found, mut line) = (Integrals::default(), WaterlineSums::default());
        for corners in self.mesh.corners() {
            let part = Clipped::new(&corners, |p| p[2] - level);
            part.triangles().for_each(|piece| found.add(piece, origin));
            if let Some(cut) = part.crossing {
                line.add(cut);
            }
        }
        found.line = line.area;
        found
    }

    /// What covers of open lines add below a level.
    fn covers(&self, lines: &[Vec<usize>], level: f64, origin: [f64; 3]) -> Integrals {
        let mut points = self.mesh.vertices.clone();
        let mut crossings: HashMap<[usize; 2], usize> = HashMap::new();
        let mut edges = Vec::new();
        for ends in lines.iter().flat_map(|line| line.windows(2)).map(|ends| [ends[0], ends[1]]) {
            let heights = ends.map(|k| self.mesh.vertices[k][2] - level);
            let below = heights.map(|height| height <= 0.0);
            if below == [false, false] {
                continue;
            }
            if below == [true, true] {
                edges.push(ends);
                continue;
            }
            let key = [ends[0].min(ends[1]), ends[0].max(ends[1])];
            let at = *crossings.entry(key).or_insert_with(|| {
                let share = heights[0] / (heights[0] - heights[1]);
                let [p, q] = ends.map(|k| self.mesh.vertices[k]);
                points.push([0, 1, 2].map(|k| p[k] + share * (q[k] - p[k])));
                points.len() - 1
            });
            edges.push(if below[0] { [ends[0], at] } else { [at, ends[1]] });
        }
        let (mut found, mut chords) = (Integrals::default(), WaterlineSums::default());
        for line in lines_of_edges(&edges) {
            let ends = [line[0], line[line.len() - 1]];
            let line: Vec<[f64; 3]> = line.into_iter().map(|k| points[k]).collect();
            cover(&line).into_iter().for_each(|triangle| found.add(triangle, origin));
            if ends.iter().all(|end| *end >= self.mesh.vertices.len()) {
                chords.add(ends.map(|k| points[k]));
            }
        }
        found.line = chords.area;
        found
    }

    /// The lowest and the highest point of a line that is the rim of a deck \[m\].
    fn deck(&self, line: &[usize]) -> Option<[f64; 2]> {
        let points: Vec<[f64; 3]> = line.iter().map(|&k| self.mesh.vertices[k]).collect();
        let sum = cover(&points).into_iter().fold([0.0; 3], |sum, [a, b, c]| {
            let normal = cross(minus(b, a), minus(c, a));
            [0, 1, 2].map(|k| sum[k] + normal[k])
        });
        let heights = || points.iter().map(|point| point[2]);
        (sum[2] > DECK * length(sum))
            .then(|| [heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max)])
    }
}
