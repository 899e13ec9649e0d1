//! How far one hull is from another: the distance of the points of its side from the other body.
//!
//! Points stand in the middle of cells of the parameters, each with the weight |S_u x S_v| du dv. The nearest point of the
//! other side comes from the best of a grid by the method of Gauss and Newton inside the domain. Blocks of the grid, and of the
//! chords of edges, that are farther than what is found already are passed over ([`Block`]). The faces that close the
//! other body count as well: the bottom across its keel line, transom and flat bow between the profiles and the
//! centreplane. Points above the deck of their own hull are left out.

use super::form::Hull;
use crate::spline::{BsplineSurface, cross, dot, minus};

/// Points along and up at which a hull is looked at, at least.
const POINTS: [usize; 2] = [96, 40];
/// Intervals of the grid of the other hull from which a search begins.
const GRID: [usize; 2] = [72, 30];
/// Chords of an edge across which a face closes the other body.
const CHORDS: usize = 240;
/// Intervals of a block of the grid, and chords of a block of an edge.
const BLOCK: [usize; 2] = [8, 8];
const BLOCK_OF_CHORDS: usize = 12;
/// Part of the size of coordinates that rounding of a point on a chord stays below by far.
const ROUNDING: f64 = 1e-12;
/// Steps of a search.
const STEPS: usize = 24;

/// How far the side of a hull is from another body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceDistance {
    /// The largest distance \[m\].
    pub largest: f64,
    /// Where that is, on the hull that was measured \[m\].
    pub at: [f64; 3],
    /// Whether that point is outside of the other side.
    pub outside: bool,
    /// Root of the mean square of the distances, weighted by area \[m\].
    pub rms: f64,
    /// Mean of the distances, weighted by area \[m\].
    pub mean: f64,
}

/// Where `parts` cells a span, `least` in all at least, have their middles, with their widths.
fn middles(breakpoints: &[f64], least: usize) -> Vec<(f64, f64)> {
    let parts = least.div_ceil(breakpoints.len().saturating_sub(1).max(1)).max(2);
    let mut cells = Vec::new();
    for w in breakpoints.windows(2) {
        let width = (w[1] - w[0]) / parts as f64;
        cells.extend((0..parts).map(|k| (w[0] + width * (k as f64 + 0.5), width)));
    }
    cells
}

/// Points, or chords, with the box that holds them.
struct Block<T> {
    low: [f64; 3],
    high: [f64; 3],
    members: Vec<T>,
}

impl<T> Block<T> {
    fn new(members: Vec<T>, points: impl Iterator<Item = [f64; 3]>) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for point in points {
            for axis in 0..3 {
                (low[axis], high[axis]) = (low[axis].min(point[axis]), high[axis].max(point[axis]));
            }
        }
        Self { low, high, members }
    }

    /// Square of the distance of a point from the box. Rounding is monotone, so that no member is found nearer.
    fn square(&self, point: [f64; 3]) -> f64 {
        let gap = [0, 1, 2].map(|k| (self.low[k] - point[k]).max(point[k] - self.high[k]).max(0.0));
        dot(gap, gap)
    }
}

/// Visits blocks, the nearest first and then those that `visit` may find something in: whose box is no farther than what it
/// returned last.
fn nearest_first<T>(blocks: &[Block<T>], point: [f64; 3], mut best: f64, mut visit: impl FnMut(&Block<T>) -> f64) {
    let squares = || blocks.iter().map(|block| block.square(point));
    let Some((first, least)) = squares().enumerate().min_by(|a, b| a.1.total_cmp(&b.1)) else { return };
    if least > best {
        return;
    }
    best = visit(&blocks[first]);
    for (k, square) in squares().enumerate() {
        if k != first && square <= best {
            best = visit(&blocks[k]);
        }
    }
}

/// A point of the grid: its place in it, its parameters and where it is.
type GridPoint = (usize, [f64; 2], [f64; 3]);

/// The other body: its side with a grid of points, and the edges across which faces close it.
struct Target<'a> {
    hull: &'a Hull,
    surface: &'a BsplineSurface<3>,
    grid: Vec<Block<GridPoint>>,
    chords: Vec<Block<[[f64; 3]; 2]>>,
}

impl<'a> Target<'a> {
    fn new(hull: &'a Hull) -> Self {
        let surface = hull.surface();
        let (u, v) = (surface.u().domain(), surface.v().domain());
        let part = |(a, b): (f64, f64), k: usize, n: usize| a + (b - a) * k as f64 / n as f64;
        let point = |i: usize, j: usize| -> GridPoint {
            let at = [part(u, i, GRID[0]), part(v, j, GRID[1])];
            (i * (GRID[1] + 1) + j, at, surface.eval(at[0], at[1]))
        };
        let mut grid = Vec::new();
        for i in (0..=GRID[0]).step_by(BLOCK[0]) {
            for j in (0..=GRID[1]).step_by(BLOCK[1]) {
                let rows = i..(i + BLOCK[0]).min(GRID[0] + 1);
                let columns = j..(j + BLOCK[1]).min(GRID[1] + 1);
                let members: Vec<GridPoint> =
                    rows.flat_map(|i| columns.clone().map(move |j| (i, j))).map(|(i, j)| point(i, j)).collect();
                let points: Vec<[f64; 3]> = members.iter().map(|member| member.2).collect();
                grid.push(Block::new(members, points.into_iter()));
            }
        }
        let along = |k: usize| part(u, k, CHORDS);
        let up = |k: usize| part(v, k, CHORDS);
        let keel: Vec<[f64; 3]> = (0..=CHORDS).map(|k| surface.eval(along(k), v.0)).collect();
        let ends = [u.0, u.1].map(|end| (0..=CHORDS).map(|k| surface.eval(end, up(k))).collect::<Vec<_>>());
        let [aft, fore] = ends;
        let mut chords = Vec::new();
        for edge in [keel, aft, fore] {
            let list: Vec<[[f64; 3]; 2]> = edge.windows(2).map(|w| [w[0], w[1]]).collect();
            for members in list.chunks(BLOCK_OF_CHORDS) {
                let size = members.iter().flatten().flatten().fold(0.0, |size: f64, c| size.max(c.abs()));
                let pad = ROUNDING * size;
                // A face goes to the centreplane.
                let corners = members.iter().flatten().flat_map(|&[x, y, z]| {
                    [[x - pad, f64::NEG_INFINITY, z - pad], [x + pad, y.max(0.0) + pad, z + pad]]
                });
                let corners: Vec<[f64; 3]> = corners.collect();
                chords.push(Block::new(members.to_vec(), corners.into_iter()));
            }
        }
        Self { hull, surface, grid, chords }
    }

    /// Square of the distance of a point from the side, and whether it is outside of it: from the nearest point of the grid,
    /// and from the point at the same x and z, since lines of the net may crowd where a search stands still.
    fn to_side(&self, point: [f64; 3]) -> (f64, bool) {
        let square = |p: &[f64; 3]| dot(minus(*p, point), minus(*p, point));
        // The first of several that are as near.
        let mut on_grid = (f64::INFINITY, usize::MAX, [0.0; 2]);
        nearest_first(&self.grid, point, f64::INFINITY, |block| {
            for (place, at, p) in &block.members {
                let found = square(p);
                if found < on_grid.0 || (found <= on_grid.0 && *place < on_grid.1) {
                    on_grid = (found, *place, *at);
                }
            }
            on_grid.0
        });
        let across = self.hull.parameters(point[0], point[2]).map(|at| (square(&self.surface.eval(at[0], at[1])), at));
        let found = [(on_grid.0, on_grid.2)].into_iter().chain(across).map(|start| self.searched(point, start));
        found.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, false))
    }

    /// The nearest point in reach of a start: the square of its distance, and whether `point` is outside of the side there.
    fn searched(&self, point: [f64; 3], (mut best, mut at): (f64, [f64; 2])) -> (f64, bool) {
        let square = |p: &[f64; 3]| dot(minus(*p, point), minus(*p, point));
        let ((a, b), (c, d)) = (self.surface.u().domain(), self.surface.v().domain());
        let mut damping = 1e-9;
        for _ in 0..STEPS {
            let t = self.surface.tangents(at[0], at[1]);
            let miss = minus(point, t.point);
            let step = gauss_newton(t.du, t.dv, miss, at, [(a, b), (c, d)], damping);
            let next = [(at[0] + step[0]).clamp(a, b), (at[1] + step[1]).clamp(c, d)];
            let found = square(&self.surface.eval(next[0], next[1]));
            if found < best {
                let small = best - found <= 1e-14 * best;
                (best, at, damping) = (found, next, damping * 0.1);
                if small {
                    break;
                }
            } else if damping > 1e3 {
                break;
            } else {
                damping = (10.0 * damping).max(1e-4);
            }
        }
        let t = self.surface.tangents(at[0], at[1]);
        // x rises with u and z with v, so that S_u x S_v points to the centreplane.
        (best, dot(minus(point, t.point), cross(t.du, t.dv)) < 0.0)
    }

    /// Square of the distance from the faces between an edge and the centreplane, or `best` where that is less.
    fn to_faces(&self, point: [f64; 3], mut best: f64) -> f64 {
        let [x, y, z] = point;
        let chord = |w: &[[f64; 3]; 2]| {
            let (dx, dz) = (w[1][0] - w[0][0], w[1][2] - w[0][2]);
            let size = dx * dx + dz * dz;
            let t = if size > 0.0 { (((x - w[0][0]) * dx + (z - w[0][2]) * dz) / size).clamp(0.0, 1.0) } else { 0.0 };
            let edge = (w[0][1] + t * (w[1][1] - w[0][1])).max(0.0);
            let beyond = (y - edge).max(0.0);
            (x - w[0][0] - t * dx).powi(2) + (z - w[0][2] - t * dz).powi(2) + beyond * beyond
        };
        nearest_first(&self.chords, point, best, |block| {
            best = block.members.iter().map(chord).fold(best, f64::min);
            best
        });
        best
    }
}

/// A damped step of Gauss and Newton; a parameter at its end that would leave the domain stays there.
fn gauss_newton(
    du: [f64; 3],
    dv: [f64; 3],
    miss: [f64; 3],
    at: [f64; 2],
    domains: [(f64, f64); 2],
    damping: f64,
) -> [f64; 2] {
    let (gu, gv) = (dot(du, miss), dot(dv, miss));
    let held = |k: usize, g: f64| (at[k] <= domains[k].0 && g < 0.0) || (at[k] >= domains[k].1 && g > 0.0);
    let (uu, vv, uv) = (dot(du, du) * (1.0 + damping), dot(dv, dv) * (1.0 + damping), dot(du, dv));
    let alone = |g: f64, square: f64| if square > 0.0 { g / square } else { 0.0 };
    match (held(0, gu), held(1, gv)) {
        (true, true) => [0.0, 0.0],
        (true, false) => [0.0, alone(gv, vv)],
        (false, true) => [alone(gu, uu), 0.0],
        (false, false) => {
            let determinant = uu * vv - uv * uv;
            if determinant > 1e-14 * uu * vv {
                [(vv * gu - uv * gv) / determinant, (uu * gv - uv * gu) / determinant]
            } else {
                [alone(gu, uu), alone(gv, vv)]
            }
        }
    }
}

/// How far the side of `hull` is from the body `other`, as both stand in the frame: x from AP, z from the base line. None for
/// a hull whose side has no area.
///
/// The distances are those of nearest points, not half-breadths at one place; they are exact to about 1e-9 of the size at
/// each point, and the largest is that of about 4000 points.
#[must_use]
pub fn surface_distance(hull: &Hull, other: &Hull) -> Option<SurfaceDistance> {
    let target = Target::new(other);
    let surface = hull.surface();
    let (us, vs) = (middles(&surface.u().breakpoints(), POINTS[0]), middles(&surface.v().breakpoints(), POINTS[1]));
    let mut result = SurfaceDistance { largest: -1.0, at: [0.0; 3], outside: false, rms: 0.0, mean: 0.0 };
    let mut area = 0.0;
    for &(u, along) in &us {
        for &(v, up) in &vs {
            let t = surface.tangents(u, v);
            if hull.is_cut_by_deck() && t.point[2] > hull.deck_height(t.point[0]) {
                continue;
            }
            let normal = cross(t.du, t.dv);
            let weight = dot(normal, normal).sqrt() * along * up;
            let (side, outside) = target.to_side(t.point);
            let square = target.to_faces(t.point, side);
            area += weight;
            result.rms += weight * square;
            result.mean += weight * square.sqrt();
            if square.sqrt() > result.largest {
                (result.largest, result.at, result.outside) = (square.sqrt(), t.point, outside);
            }
        }
    }
    (area > 0.0).then(|| SurfaceDistance { rms: (result.rms / area).sqrt(), mean: result.mean / area, ..result })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hull::PrincipalParticulars;
    use crate::spline::{BsplineCurve, KnotVector};

    /// A box with half-breadth `y` from z = 0 to 2, 10 m long.
    fn slab(y: f64) -> Hull {
        let line = || KnotVector::uniform(1, 1).unwrap();
        let points = [[0.0, y, 0.0], [0.0, y, 2.0], [10.0, y, 0.0], [10.0, y, 2.0]].to_vec();
        let deck = BsplineCurve::new(line(), vec![[0.0, 2.0], [10.0, 2.0]]).unwrap();
        let particulars = PrincipalParticulars {
            length_between_perpendiculars: 10.0,
            breadth: 2.0 * y,
            draught: Some(1.0),
            depth: 2.0,
        };
        Hull::new("slab", particulars, BsplineSurface::new(line(), line(), points).unwrap(), deck).unwrap()
    }

    /// What is passed over is never nearer: blocks find what all members do.
    #[test]
    fn blocks_find_the_nearest_of_all() {
        let hull = slab(2.0);
        let target = Target::new(&hull);
        for point in [[5.1, 2.2, 0.7], [-1.0, 0.3, 3.0], [9.9, 0.0, -0.2], [3.0, 1.9, 1.0]] {
            let square = |p: &[f64; 3]| dot(minus(*p, point), minus(*p, point));
            let all = target.grid.iter().flat_map(|block| &block.members).map(|member| square(&member.2));
            let mut found = f64::INFINITY;
            nearest_first(&target.grid, point, f64::INFINITY, |block| {
                found = block.members.iter().map(|member| square(&member.2)).fold(found, f64::min);
                found
            });
            assert!((found - all.fold(f64::INFINITY, f64::min)).abs() < 1e-300);
            let whole = target.to_faces(point, f64::INFINITY);
            assert!((target.to_faces(point, 1e3) - whole.min(1e3)).abs() < 1e-300);
        }
    }

    #[test]
    fn planes_are_as_far_apart_as_they_are() {
        let (a, b) = (slab(2.0), slab(2.25));
        let out = surface_distance(&b, &a).unwrap();
        assert!((out.largest - 0.25).abs() < 1e-12 && (out.rms - 0.25).abs() < 1e-12 && out.outside, "{out:?}");
        // From inside, bottom and ends are nearer where they are: 0.02 m at the lowest points.
        let inside = surface_distance(&a, &b).unwrap();
        assert!(inside.largest <= 0.25 + 1e-12 && inside.mean < 0.25 && !inside.outside, "{inside:?}");
        let none = surface_distance(&a, &a).unwrap();
        assert!(none.largest < 1e-12, "{none:?}");
    }
}
