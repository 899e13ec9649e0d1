//! Which sides of a skin water reaches: sheets inside a body and the inner skin of a hollow one add nothing to it.
//!
//! The box around the body is divided into cells; those that triangles pass through are walls. Water from outside passes
//! from cell to cell across faces. Its level in a cell is the least height to which it rises on the way there, found from
//! below (the search of Dijkstra, with the greatest height of a path as its length). Where that is the height of the cell,
//! the cell is outside. Where it is greater, the cell is in a basin, dry until water comes over its rim. Cells that are not
//! reached are closed in.
//!
//! From the middle of a triangle each side is followed to the first cell that is no wall, or to another triangle. A skin has
//! water on one side. A part without any is a sheet inside. A part that has water here and a deep basin there is the outer and the
//! inner skin of a hollow body; what faces the basin is left out. Where plates are nearer to each other than two
//! cells, triangles are as those beside them.
//!
//! A cell shuts openings that are narrower than itself: a moonpool or the slot of a centreboard looks like a basin. The well of a
//! dock is one until water comes over its sill. So an inner skin is left out where the body is one of plates alone: without it
//! the body encloses [`HOLLOW`] times as much.

use super::TriangleMesh;
use crate::spline::{cross, dot, length, minus};
use std::cell::Cell as Counter;
use std::collections::HashSet;

/// Cells along each axis of the body; one more at each end.
const CELLS: usize = 64;
const ALONG: usize = CELLS + 2;

/// Points of a triangle, in cells apart: a gap of half a cell would let water through.
const STEP: f64 = 0.4;

/// How far a side of a triangle is followed, and in steps of what length, in cells.
const REACH: usize = 14;
const STRIDE: f64 = 0.25;

/// A point of a triangle is this near to one of the points that stand for it, and a step to where it meets a ray, in cells.
const BESIDE: f64 = 0.6;

/// Neighbours whose normals have a greater product than this are one smooth piece.
const SMOOTH: f64 = 0.7;

/// A basin of a hollow body is at least so many cells deep.
const DEEP: usize = CELLS / 4;

/// What a body of plates encloses without its inner skin, at least, over what it does with it.
const HOLLOW: f64 = 3.0;

/// Most triangles that are looked at beside others. A body with more of them in its cells stays as it is.
const MOST: u64 = 300_000_000;

/// Triangles nearer than this to a middle are hit by no ray from there, in cells.
const NEAR: f64 = 1e-6;

/// What is no level.
const WALL: u8 = u8::MAX;
const DRY: u8 = u8::MAX - 1;

/// Triangles that water does not reach.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DrySkin {
    /// Those of sheets inside that share edges with the skin.
    pub sheets: usize,
    /// Those of the inner skin of a hollow body.
    pub inner: usize,
    /// What wells that are open from above hold, over what the body encloses without them; they stay as they are.
    pub wells: f64,
}

/// What is beside a triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Water,
    /// So many cells below the rim.
    Basin(usize),
    Closed,
    /// Another triangle is nearer than a cell that is no wall.
    Near,
}

impl Side {
    /// How far below the rim of a basin it is, where it is dry.
    fn depth(self) -> Option<usize> {
        match self {
            Self::Basin(depth) => Some(depth),
            Self::Closed => Some(0),
            Self::Water | Self::Near => None,
        }
    }
}

/// What a triangle is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Skin,
    /// Dry on both sides, or in a basin on its outer one; and how far below its rim, 0 where it is closed in.
    Dry(usize),
    Unknown,
}

type Point = [f64; 3];

/// The edges of a triangle, the smaller index first.
fn edges([a, b, c]: [usize; 3]) -> [[usize; 2]; 3] {
    [[a, b], [b, c], [c, a]].map(|[p, q]| [p.min(q), p.max(q)])
}

/// The cells around a body, in coordinates of which a cell has the length 1.
struct Cells {
    triangles: Vec<[Point; 3]>,
    levels: Vec<u8>,
    /// Triangles by the cells that they pass through or near, and where in this list those of a cell begin.
    walls: Vec<u32>,
    firsts: Vec<usize>,
    /// Triangles that were looked at beside others.
    work: Counter<u64>,
}

fn cell(point: Point) -> Option<usize> {
    let at = point.map(f64::floor);
    at.iter().all(|c| (0.0..ALONG as f64).contains(c)).then(|| {
        let [i, j, k] = at.map(|c| c as usize);
        (k * ALONG + j) * ALONG + i
    })
}

/// Calls `put` with points of a triangle so near to each other that no cell between two of them is passed over.
fn each_point(corners: [Point; 3], mut put: impl FnMut(Point)) {
    let between = |p: Point, q: Point, t: f64| -> Point { std::array::from_fn(|k| p[k] + t * (q[k] - p[k])) };
    let [a, b, c] = corners;
    let sides = [[a, b, c], [b, c, a], [c, a, b]];
    let long = |[p, q, _]: &[Point; 3]| length(minus(*q, *p));
    // Rows along the longest side.
    let Some(&[a, b, c]) = sides.iter().max_by(|p, q| long(p).total_cmp(&long(q))) else { return };
    let base = length(minus(b, a));
    let height = length(cross(minus(b, a), minus(c, a))) / base.max(f64::MIN_POSITIVE);
    let rows = (height / STEP).ceil().max(1.0) as usize;
    for row in 0..=rows {
        let t = row as f64 / rows as f64;
        let (from, to) = (between(a, c, t), between(b, c, t));
        let count = ((1.0 - t) * base / STEP).ceil().max(1.0) as usize;
        (0..=count).for_each(|k| put(between(from, to, k as f64 / count as f64)));
    }
}

impl Cells {
    /// Of a mesh; none where it is flat.
    fn of(mesh: &TriangleMesh) -> Option<Self> {
        let [low, high] = mesh.bounds()?;
        let size = minus(high, low);
        if size.iter().any(|extent| *extent <= 0.0) {
            return None;
        }
        let scaled = |p: Point| [0, 1, 2].map(|k| 1.0 + CELLS as f64 * (p[k] - low[k]) / size[k]);
        let triangles: Vec<[Point; 3]> = mesh.corners().map(|corners| corners.map(scaled)).collect();
        let mut levels = vec![DRY; ALONG * ALONG * ALONG];
        for &corners in &triangles {
            each_point(corners, |point| {
                if let Some(at) = Self::inside(point) {
                    levels[at] = WALL;
                }
            });
        }
        Some(Self { triangles, levels, walls: Vec::new(), firsts: Vec::new(), work: Counter::new(0) })
    }

    /// The cell of a point of the body, of which none is beside it.
    fn inside(point: Point) -> Option<usize> {
        cell(point.map(|c| c.clamp(1.0, CELLS as f64 + 0.5)))
    }

    /// Lets water in; the greatest depth of a basin.
    fn flood(&mut self) -> usize {
        let height = |at: usize| at / (ALONG * ALONG);
        let mut waiting: Vec<Vec<usize>> = vec![Vec::new(); ALONG];
        let last = ALONG - 1;
        for at in 0..self.levels.len() {
            let [i, j, k] = [at % ALONG, at / ALONG % ALONG, height(at)];
            if [i, j, k].iter().any(|c| *c == 0 || *c == last) {
                self.levels[at] = k as u8;
                waiting[k].push(at);
            }
        }
        let mut deepest = 0;
        for level in 0..ALONG {
            while let Some(at) = waiting[level].pop() {
                deepest = deepest.max(level - height(at));
                let places = [at % ALONG, at / ALONG % ALONG, height(at)];
                for (place, step) in places.into_iter().zip([1, ALONG, ALONG * ALONG]) {
                    let beside = [(place > 0).then(|| at - step), (place < last).then(|| at + step)];
                    for next in beside.into_iter().flatten() {
                        if self.levels[next] == DRY {
                            let risen = level.max(height(next));
                            self.levels[next] = risen as u8;
                            waiting[risen].push(next);
                        }
                    }
                }
            }
        }
        deepest
    }

    /// Lists the triangles by cells.
    fn list(&mut self) {
        let mut walls: Vec<(u32, u32)> = Vec::new();
        for (k, &corners) in self.triangles.iter().enumerate() {
            let mut last = [None; 8];
            each_point(corners, |point| {
                let corner = |n: usize| {
                    cell([0, 1, 2].map(|axis| point[axis] + if n >> axis & 1 == 0 { -BESIDE } else { BESIDE }))
                };
                let near: [Option<usize>; 8] = std::array::from_fn(corner);
                let fresh = near.iter().zip(last).filter(|(at, before)| **at != *before);
                walls.extend(fresh.filter_map(|(at, _)| Some(((*at)? as u32, k as u32))));
                last = near;
            });
        }
        walls.sort_unstable();
        walls.dedup();
        let mut next = 0;
        self.firsts = (0..=self.levels.len())
            .map(|at| {
                next += walls[next..].iter().take_while(|(own, _)| (*own as usize) < at).count();
                next
            })
            .collect();
        self.walls = walls.into_iter().map(|(_, k)| k).collect();
    }

    /// The triangles of a cell.
    fn in_cell(&self, at: usize) -> impl Iterator<Item = usize> + '_ {
        self.walls[self.firsts[at]..self.firsts[at + 1]].iter().map(|k| *k as usize)
    }

    /// What is beside a triangle in a direction.
    fn side(&self, own: usize, from: Point, along: Point) -> Side {
        let mut hit = f64::INFINITY;
        for step in 1..=REACH {
            let t = STRIDE * step as f64;
            let Some(at) = cell([0, 1, 2].map(|k| from[k] + t * along[k])) else { return Side::Water };
            self.work.set(self.work.get() + (self.firsts[at + 1] - self.firsts[at]) as u64);
            if self.work.get() > MOST {
                break;
            }
            let others = self.in_cell(at).filter(|k| *k != own);
            hit = others.filter_map(|k| met(self.triangles[k], from, along)).fold(hit, f64::min);
            match self.levels[at] {
                _ if hit < t => break,
                WALL => {}
                DRY => return Side::Closed,
                level => {
                    let depth = usize::from(level) - at / (ALONG * ALONG);
                    return if depth == 0 { Side::Water } else { Side::Basin(depth) };
                }
            }
        }
        Side::Near
    }

    fn kind(&self, k: usize) -> Kind {
        let [a, b, c] = self.triangles[k];
        let normal = cross(minus(b, a), minus(c, a));
        let size = length(normal);
        if size <= 0.0 {
            return Kind::Unknown;
        }
        let normal = normal.map(|n| n / size);
        let middle = [0, 1, 2].map(|k: usize| (a[k] + b[k] + c[k]) / 3.0);
        let [front, back] = [normal, normal.map(|n| -n)].map(|along| self.side(k, middle, along));
        match (front, back) {
            (Side::Water, _) | (_, Side::Water) => Kind::Skin,
            (Side::Basin(depth), Side::Near) => Kind::Dry(depth),
            _ => front.depth().zip(back.depth()).map_or(Kind::Unknown, |(a, b)| Kind::Dry(a.max(b))),
        }
    }
}

/// How far along a ray a triangle is (Moeller and Trumbore 1997).
fn met([a, b, c]: [Point; 3], from: Point, along: Point) -> Option<f64> {
    let (u, v) = (minus(b, a), minus(c, a));
    let across = cross(along, v);
    let volume = dot(u, across);
    if volume.abs() <= f64::MIN_POSITIVE {
        return None;
    }
    let arm = minus(from, a);
    let first = dot(arm, across) / volume;
    let turned = cross(arm, u);
    let second = dot(along, turned) / volume;
    let t = dot(v, turned) / volume;
    (first >= 0.0 && second >= 0.0 && first + second <= 1.0 && t > NEAR).then_some(t)
}

impl TriangleMesh {
    /// The mesh without sheets inside that share edges with its skin, and without the inner skin of a hollow body; and how many
    /// triangles these have. The triangles face outward.
    #[must_use]
    pub fn without_dry_skin(mut self) -> (Self, DrySkin) {
        let mut found = DrySkin::default();
        let branches = self.branches();
        let Some(mut cells) = Cells::of(&self) else { return (self, found) };
        if cells.flood() < DEEP && branches.is_empty() {
            return (self, found);
        }
        cells.list();
        let mut kinds: Vec<Kind> = (0..self.triangles.len()).map(|k| cells.kind(k)).collect();
        if cells.work.get() > MOST {
            return (self, found);
        }
        self.spread(&mut kinds, SMOOTH);
        self.spread(&mut kinds, -1.0);
        let (mut left_out, mut inner) = (vec![false; kinds.len()], Vec::new());
        let depth = |k: usize| if let Kind::Dry(depth) = kinds[k] { Some(depth) } else { None };
        for shell in self.shells() {
            let dry: Vec<(usize, usize)> = shell.iter().filter_map(|&k| Some((k, depth(k)?))).collect();
            let deepest = dry.iter().map(|(_, depth)| *depth).max().unwrap_or(0);
            if dry.len() < shell.len() {
                let facing = dry.iter().filter(|(_, depth)| deepest >= DEEP && *depth > 0);
                inner.extend(facing.map(|(k, _)| *k));
            } else if (deepest == 0 || deepest >= DEEP) && self.is_joined(&shell, &branches) {
                // What shares no edge with the skin is a tank, or a loose sheet.
                shell.iter().for_each(|&k| left_out[k] = true);
                found.sheets += shell.len();
            } else if deepest >= DEEP {
                // An inner skin whose rim is not joined to the outer one.
                inner.extend(dry.iter().filter(|(_, depth)| *depth > 0).map(|(k, _)| *k));
            }
        }
        let [body, outer] = self.with_and_without(&inner);
        if !inner.is_empty() && outer > HOLLOW * body.abs() {
            inner.iter().for_each(|&k| left_out[k] = true);
            found.inner = inner.len();
        } else {
            found.wells = (1.0 - body / outer).max(0.0);
        }
        if found.sheets + found.inner == 0 {
            return (self, found);
        }
        let mut out = left_out.into_iter();
        self.triangles.retain(|_| !out.next().unwrap_or(false));
        let kept: Vec<[Point; 3]> = self.corners().collect();
        (Self::from_corners(kept.into_iter()), found)
    }

    /// What the body encloses, and what it does without these triangles, its inner skin, which what is open above adds nothing
    /// to \[m^3\].
    fn with_and_without(&self, inner: &[usize]) -> [f64; 2] {
        let enclosed = |triangle: &[usize; 3]| {
            let [a, b, c] = triangle.map(|vertex| self.vertices[vertex]);
            cross(minus(b, a), minus(c, a))[1] * (a[1] + b[1] + c[1]) / 6.0
        };
        let body: f64 = self.triangles.iter().map(enclosed).sum();
        let within: f64 = inner.iter().map(|&k| enclosed(&self.triangles[k])).sum();
        [body, body - within]
    }

    /// Edges of three triangles and more that are no common edges of closed shells.
    fn branches(&self) -> HashSet<[usize; 2]> {
        let neighbours = self.neighbours();
        let open: HashSet<[usize; 2]> = self.open_edges().into_iter().map(|[p, q]| [p.min(q), p.max(q)]).collect();
        let alone = self.triangles.iter().zip(neighbours).flat_map(|(t, beside)| {
            let [ab, bc, ca] = edges(*t);
            [ab, bc, ca].into_iter().zip(beside).filter(|(_, other)| other.is_none()).map(|(edge, _)| edge)
        });
        alone.filter(|edge| !open.contains(edge)).collect()
    }

    fn is_joined(&self, shell: &[usize], branches: &HashSet<[usize; 2]>) -> bool {
        shell.iter().flat_map(|&k| edges(self.triangles[k])).any(|edge| branches.contains(&edge))
    }

    /// Gives triangles without a kind that of those beside them, the nearest first, across edges where the product of normals is
    /// large enough.
    fn spread(&self, kinds: &mut [Kind], least: f64) {
        let neighbours = self.neighbours();
        let normal = |k: usize| {
            let [a, b, c] = self.triangles[k].map(|v| self.vertices[v]);
            let normal = cross(minus(b, a), minus(c, a));
            let size = length(normal);
            if size > 0.0 { normal.map(|n| n / size) } else { normal }
        };
        let mut front: Vec<usize> = (0..kinds.len()).filter(|&k| kinds[k] != Kind::Unknown).collect();
        while !front.is_empty() {
            let mut next = Vec::new();
            for &k in &front {
                for (other, _) in neighbours[k].into_iter().flatten() {
                    if kinds[other] == Kind::Unknown && dot(normal(k), normal(other)) >= least {
                        kinds[other] = kinds[k];
                        next.push(other);
                    }
                }
            }
            front = next;
        }
    }
}
