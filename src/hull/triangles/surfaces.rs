//! Triangles over rational B-spline surfaces in space.
//!
//! Each span of the knots is cut into equal parts, so many that the chords of the quarters of a span, and of its diagonal, stay within
//! the deviation. With parts halved the polyhedron is nested, and what is integrated over it has an error that falls by four: 4/3 of
//! the finer less 1/3 of the coarser is of fourth order where nothing cuts the triangles.

use super::TriangleMesh;
use crate::spline::{BsplineSurface, minus};

/// Most parts of a span.
const MOST_PARTS: f64 = 100.0;

/// Lines of a span along which its bend is looked at.
const LINES: [f64; 3] = [0.0, 0.5, 1.0];

/// The point of a surface of (w x, w y, w z, w); none where the weight is not positive.
fn point(surface: &BsplineSurface<4>, u: f64, v: f64) -> [f64; 3] {
    let [x, y, z, w] = surface.eval(u, v);
    [x / w, y / w, z / w]
}

/// Cuts of each span into parts, `times` as many as the deviation asks for.
fn cuts(surface: &BsplineSurface<4>, deviation: f64, times: usize) -> [Vec<f64>; 2] {
    let breaks = [surface.u().breakpoints(), surface.v().breakpoints()];
    let mut parts = [vec![1.0_f64; breaks[0].len() - 1], vec![1.0_f64; breaks[1].len() - 1]];
    for i in 0..parts[0].len() {
        for j in 0..parts[1].len() {
            let at = |s: f64, t: f64| {
                let (u, v) = (&breaks[0][i..=i + 1], &breaks[1][j..=j + 1]);
                point(surface, u[0] + s * (u[1] - u[0]), v[0] + t * (v[1] - v[0]))
            };
            let bend = |from: [f64; 3], middle: [f64; 3], to: [f64; 3]| {
                let off = [0, 1, 2].map(|k| middle[k] - 0.5 * (from[k] + to[k]));
                minus(off, [0.0; 3]).map(|c| c * c).iter().sum::<f64>().sqrt()
            };
            let (mut along, mut around) = (0.0_f64, 0.0_f64);
            for line in LINES {
                for half in [0.0, 0.5] {
                    along = along.max(bend(at(half, line), at(half + 0.25, line), at(half + 0.5, line)));
                    around = around.max(bend(at(line, half), at(line, half + 0.25), at(line, half + 0.5)));
                }
            }
            let twist =
                bend(at(0.0, 0.0), at(0.5, 0.5), at(1.0, 1.0)).min(bend(at(0.0, 1.0), at(0.5, 0.5), at(1.0, 0.0)));
            // A half has a quarter of the bend of the whole.
            let count = |bend: f64| (2.0 * (bend / deviation).sqrt()).ceil().clamp(1.0, MOST_PARTS);
            let both = (twist / deviation).sqrt().sqrt().ceil().clamp(1.0, MOST_PARTS);
            parts[0][i] = parts[0][i].max(count(along)).max(both);
            parts[1][j] = parts[1][j].max(count(around)).max(both);
        }
    }
    [0, 1].map(|axis| {
        let inner = breaks[axis].windows(2).zip(&parts[axis]).flat_map(|(w, &count)| {
            let (from, width, count) = (w[0], w[1] - w[0], count as usize * times);
            (0..count).map(move |k| from + width * k as f64 / count as f64)
        });
        inner.chain(breaks[axis].last().copied()).collect()
    })
}

impl TriangleMesh {
    /// Triangles over surfaces of (w x, w y, w z, w) \[m\], each for itself, that leave them by at most about `deviation` \[m\];
    /// `times` as many along and around as that asks for.
    #[must_use]
    pub fn of_surfaces(surfaces: &[BsplineSurface<4>], deviation: f64, times: usize) -> Self {
        let mut corners = Vec::new();
        for surface in surfaces {
            let [us, vs] = cuts(surface, deviation, times.max(1));
            let grid: Vec<Vec<[f64; 3]>> =
                us.iter().map(|&u| vs.iter().map(|&v| point(surface, u, v)).collect()).collect();
            for columns in grid.windows(2) {
                for (left, right) in columns[0].windows(2).zip(columns[1].windows(2)) {
                    let [a, b, c, d] = [left[0], right[0], right[1], left[1]];
                    let length = |p: [f64; 3], q: [f64; 3]| minus(p, q).map(|c| c * c).iter().sum::<f64>();
                    if length(a, c) <= length(b, d) {
                        corners.extend([[a, b, c], [a, c, d]]);
                    } else {
                        corners.extend([[b, c, d], [b, d, a]]);
                    }
                }
            }
        }
        Self::from_corners(corners.into_iter())
    }
}
