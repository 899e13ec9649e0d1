//! Triangles over rational B-spline surfaces in space.
//!
//! Each span of the knots is cut into equal parts, so many that the chords of the quarters of a span, and of its
//! diagonal, stay within the deviation; spans that need no cut are joined while they stay within it together, unless
//! the surface may have a corner between them. With parts halved the polyhedron is nested, and what is integrated over
//! it has an error that falls by four: 4/3 of the finer less 1/3 of the coarser is of fourth order where nothing cuts
//! the triangles.

use super::TriangleMesh;
use crate::spline::{BsplineSurface, KnotVector, length, minus};

/// Most parts of a span.
const MOST_PARTS: f64 = 100.0;

/// Spans of which the quarters are looked at; of more, up to the second number, the halves, of still more the spans as
/// a whole.
const QUARTERS: usize = 60_000;
const HALVES: usize = 400_000;

/// How often the deviation is doubled at most.
const DOUBLINGS: usize = 8;

/// Gives the points of a grid of parameters, u slowest.
pub(in super::super) trait Grid: Fn(&[f64], &[f64]) -> Vec<[f64; 3]> {}

impl<F: Fn(&[f64], &[f64]) -> Vec<[f64; 3]>> Grid for F {}

/// The bends of a surface in each span in u, and in v: the most by which halves of it leave their chords, and the diagonals
/// of its cells theirs. The points of a grid of parameters give the surface.
pub(in super::super) struct Bends<G> {
    grid: G,
    breaks: [Vec<f64>; 2],
    /// Whether the surface may have a corner at each of the breaks.
    corners: [Vec<bool>; 2],
    along: [Vec<f64>; 2],
    twist: [Vec<f64>; 2],
}

/// Parameters of all spans, each in `parts`.
fn fine(breaks: &[f64], parts: usize) -> Vec<f64> {
    let inner = breaks.windows(2).flat_map(|w| (0..parts).map(move |k| w[0] + (w[1] - w[0]) * k as f64 / parts as f64));
    inner.chain(breaks.last().copied()).collect()
}

/// The points of a grid of parameters, u slowest.
fn grid(surface: &BsplineSurface<4>, us: &[f64], vs: &[f64]) -> Vec<[f64; 3]> {
    let mut points = Vec::with_capacity(us.len() * vs.len());
    surface.grid_jets(us, vs, |_, _, jet| {
        let [x, y, z, w] = jet.point;
        points.push([x / w, y / w, z / w]);
    });
    points
}

/// What the middle of three points leaves the chord of the outer ones by.
fn off(from: [f64; 3], middle: [f64; 3], to: [f64; 3]) -> f64 {
    length([0, 1, 2].map(|k| middle[k] - 0.5 * (from[k] + to[k])))
}

/// The breakpoints of knots, and whether there may be a corner.
pub(in super::super) fn corners(knots: &KnotVector) -> Vec<(f64, bool)> {
    knots.breakpoints().into_iter().map(|t| (t, knots.multiplicity(t) >= knots.degree())).collect()
}

impl<G: Grid> Bends<G> {
    /// Of a surface that is smooth between breaks.
    pub(in super::super) fn of(grid: G, breaks: [Vec<(f64, bool)>; 2]) -> Self {
        let corners = breaks.each_ref().map(|list| list.iter().map(|(_, corner)| *corner).collect());
        let breaks = breaks.map(|list| list.into_iter().map(|(t, _)| t).collect::<Vec<f64>>());
        let spans = breaks.each_ref().map(|breaks| breaks.len() - 1);
        let parts = match spans[0].saturating_mul(spans[1]) {
            count if count <= QUARTERS => 4,
            count if count <= HALVES => 2,
            _ => 1,
        };
        let points = grid(&fine(&breaks[0], parts), &fine(&breaks[1], parts));
        let columns = parts * spans[1] + 1;
        let at = |i: usize, j: usize| points[i * columns + j];
        let mut along = spans.map(|count| vec![0.0_f64; count]);
        let mut twist = spans.map(|count| vec![0.0_f64; count]);
        let counts = [parts * spans[0], parts * spans[1]];
        for axis in 0..2 {
            let point = |k: usize, across: usize| if axis == 0 { at(k, across) } else { at(across, k) };
            for across in 0..=counts[1 - axis] {
                for (span, bend) in along[axis].iter_mut().enumerate() {
                    let first = parts * span;
                    let of = |from: usize, middle: usize, to: usize| {
                        off(point(from, across), point(middle, across), point(to, across))
                    };
                    // The bend of a half: of a whole it is four times that.
                    let found = match parts {
                        4 => of(first, first + 1, first + 2).max(of(first + 2, first + 3, first + 4)),
                        2 => 0.25 * of(first, first + 1, first + 2),
                        _ if counts[axis] > 1 => {
                            let middle = first.clamp(1, counts[axis] - 1);
                            0.0625 * of(middle - 1, middle, middle + 1)
                        }
                        _ => 0.0,
                    };
                    *bend = bend.max(found);
                }
            }
        }
        for i in 0..spans[0] {
            for j in (0..spans[1]).filter(|_| parts > 1) {
                let corner = |a: usize, b: usize| at(parts * i + a, parts * j + b);
                let middle = corner(parts / 2, parts / 2);
                let found = off(corner(0, 0), middle, corner(parts, parts)).min(off(
                    corner(0, parts),
                    middle,
                    corner(parts, 0),
                ));
                twist[0][i] = twist[0][i].max(found);
                twist[1][j] = twist[1][j].max(found);
            }
        }
        Self { grid, breaks, corners, along, twist }
    }

    /// The lines of a mesh that leaves the surface by about `deviation`, each part cut into `times`.
    pub(in super::super) fn lines(&self, deviation: f64, times: usize) -> [Vec<f64>; 2] {
        [0, 1].map(|axis| {
            let bends = self.along[axis].iter().copied().zip(self.twist[axis].iter().copied()).collect::<Vec<_>>();
            cut(&self.breaks[axis], &self.corners[axis], &bends, deviation, times)
        })
    }

    /// Triangles of such a mesh.
    fn count(&self, deviation: f64) -> usize {
        let [us, vs] = self.lines(deviation, 1);
        2 * (us.len() - 1) * (vs.len() - 1)
    }

    fn triangles(&self, deviation: f64, times: usize, corners: &mut Vec<[[f64; 3]; 3]>) {
        let [us, vs] = self.lines(deviation, times);
        let points = (self.grid)(&us, &vs);
        let at = |i: usize, j: usize| points[i * vs.len() + j];
        for i in 0..us.len() - 1 {
            for j in 0..vs.len() - 1 {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                if length(minus(a, c)) <= length(minus(b, d)) {
                    corners.extend([[a, b, c], [a, c, d]]);
                } else {
                    corners.extend([[b, c, d], [b, d, a]]);
                }
            }
        }
    }
}

/// The lines across one direction.
fn cut(breaks: &[f64], corners: &[bool], bends: &[(f64, f64)], deviation: f64, times: usize) -> Vec<f64> {
    // A half has a quarter of the bend of the whole.
    let count = |bend: f64| (2.0 * (bend / deviation).sqrt()).ceil().clamp(1.0, MOST_PARTS);
    let both = |twist: f64| (twist / deviation).sqrt().sqrt().ceil().clamp(1.0, MOST_PARTS);
    let parts: Vec<f64> = bends.iter().map(|&(bend, twist)| count(bend).max(both(twist))).collect();
    let mut lines = vec![breaks[0]];
    let mut span = 0;
    while span < parts.len() {
        let mut end = span + 1;
        // Bends grow with the square of the width, twists with its fourth power when both directions are joined.
        let (mut bend, mut turn) = bends[span];
        while parts[span] <= 1.0 && end < parts.len() && !corners[end] {
            (bend, turn) = (bend.max(bends[end].0), turn.max(bends[end].1));
            let width = (breaks[end + 1] - breaks[span]) / (breaks[span + 1] - breaks[span]);
            let narrow = (breaks[end + 1] - breaks[end]) / (breaks[span + 1] - breaks[span]);
            let wider = width / narrow.min(1.0);
            if 4.0 * bend * wider * wider > deviation || turn * wider.powi(4) > deviation {
                break;
            }
            end += 1;
        }
        let (from, width, count) = (breaks[span], breaks[end] - breaks[span], parts[span] as usize * times);
        lines
            .extend((1..=count).map(|k| if k == count { breaks[end] } else { from + width * k as f64 / count as f64 }));
        span = end;
    }
    lines
}

/// The bends of a spline.
fn bends(surface: &BsplineSurface<4>) -> Bends<impl Grid + '_> {
    Bends::of(move |us, vs| grid(surface, us, vs), [corners(surface.u()), corners(surface.v())])
}

impl TriangleMesh {
    /// Triangles over surfaces of (w x, w y, w z, w) \[m\], each for itself, that leave them by at most about
    /// `deviation` \[m\]; `times` as many along and around as that asks for.
    #[must_use]
    pub fn of_surfaces(surfaces: &[BsplineSurface<4>], deviation: f64, times: usize) -> Self {
        let mut corners = Vec::new();
        for surface in surfaces {
            bends(surface).triangles(deviation, times.max(1), &mut corners);
        }
        Self::from_corners(corners.into_iter())
    }

    /// Two such meshes, the second with every edge halved, and their deviation \[m\]: `deviation`, doubled up to eight
    /// times until the first has `enough` triangles.
    ///
    /// # Errors
    /// How many triangles there would be, where these are more than four times `enough` even so.
    pub fn nested(surfaces: &[BsplineSurface<4>], deviation: f64, enough: usize) -> Result<([Self; 2], f64), usize> {
        let bends: Vec<Bends<_>> = surfaces.iter().map(bends).collect();
        let count = |deviation: f64| bends.iter().map(|bends| bends.count(deviation)).fold(0, usize::saturating_add);
        let mut deviation = deviation;
        for _ in 0..DOUBLINGS {
            if count(deviation) > enough {
                deviation *= 2.0;
            }
        }
        let least = count(deviation);
        if least > enough.saturating_mul(4) {
            return Err(least);
        }
        let meshes = [1, 2].map(|times| {
            let mut corners = Vec::new();
            bends.iter().for_each(|bends| bends.triangles(deviation, times, &mut corners));
            Self::from_corners(corners.into_iter())
        });
        Ok((meshes, deviation))
    }
}
