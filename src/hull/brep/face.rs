//! The triangles of a face: those of a constrained Delaunay triangulation of its loops and of a grid inside them, in the
//! plane of the parameters, counted in cells of the grid.

use super::Samples;
use super::outline::{Corner, Outline, place};
use super::surface::Chart;
use std::collections::HashSet;

use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation, mitigate_underflow};

/// Points of the grid nearer to a loop than this part of a cell are left out.
const NEAR: f64 = 0.35;

/// A corner of triangles.
#[derive(Debug, Clone, Copy)]
struct Spot {
    uv: [f64; 2],
    /// Its index among the points of the body; none inside the face.
    id: Option<usize>,
}

/// The triangles of a face.
#[derive(Debug)]
pub(super) struct Patch {
    spots: Vec<Spot>,
    triangles: Vec<[usize; 3]>,
}

/// Lines of loops by the rows of cells that they pass.
struct Fence {
    rows: Vec<Vec<[[f64; 2]; 2]>>,
}

impl Fence {
    fn of(loops: &[Vec<[f64; 2]>], rows: usize) -> Self {
        let mut fence = Self { rows: vec![Vec::new(); rows.max(1)] };
        for points in loops {
            for (&a, &b) in points.iter().zip(points.iter().cycle().skip(1)) {
                let (from, to) = (fence.row(a[1].min(b[1])), fence.row(a[1].max(b[1])));
                for row in &mut fence.rows[from..=to] {
                    row.push([a, b]);
                }
            }
        }
        fence
    }

    fn row(&self, y: f64) -> usize {
        (y.max(0.0) as usize).min(self.rows.len() - 1)
    }

    /// Whether a point is inside the loops.
    fn holds(&self, [x, y]: [f64; 2]) -> bool {
        let crosses =
            |&&[[ax, ay], [bx, by]]: &&[[f64; 2]; 2]| (ay > y) != (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax);
        self.rows[self.row(y)].iter().filter(crosses).count() % 2 == 1
    }

    /// Whether a point is nearer than [`NEAR`] to a line.
    fn is_near(&self, [x, y]: [f64; 2]) -> bool {
        let (from, to) = (self.row(y - NEAR), self.row(y + NEAR));
        self.rows[from..=to].iter().flatten().any(|&[[ax, ay], [bx, by]]| {
            let (dx, dy) = (bx - ax, by - ay);
            let square = dx * dx + dy * dy;
            let share = if square > 0.0 { (((x - ax) * dx + (y - ay) * dy) / square).clamp(0.0, 1.0) } else { 0.0 };
            (x - ax - share * dx).hypot(y - ay - share * dy) < NEAR
        })
    }
}

/// Which faces of a triangulation are inside its constraints: from outside in, over each of them once. Lines that are run
/// through `twice` divide nothing.
pub(in crate::hull) fn inside(
    net: &ConstrainedDelaunayTriangulation<Point2<f64>>,
    twice: &HashSet<[usize; 2]>,
) -> Vec<bool> {
    let mut known: Vec<Option<bool>> = vec![None; net.num_all_faces()];
    let mut next = vec![net.outer_face().index()];
    known[next[0]] = Some(false);
    let edges: Vec<[usize; 2]> =
        net.directed_edges().map(|edge| [edge.face().index(), edge.rev().face().index()]).collect();
    let mut beside: Vec<Vec<usize>> = vec![Vec::new(); known.len()];
    edges.iter().enumerate().for_each(|(k, [own, _])| beside[*own].push(k));
    let divides: Vec<bool> = net
        .directed_edges()
        .map(|edge| {
            let [a, b] = edge.vertices().map(|corner| corner.index());
            edge.is_constraint_edge() && !twice.contains(&[a.min(b), a.max(b)])
        })
        .collect();
    while let Some(face) = next.pop() {
        for &edge in &beside[face] {
            let other = edges[edge][1];
            if known[other].is_none() {
                known[other] = known[face].map(|inside| inside != divides[edge]);
                next.push(other);
            }
        }
    }
    known.into_iter().map(|inside| inside == Some(true)).collect()
}

impl Patch {
    /// Of loops, with the lines of the grid inside.
    pub(super) fn of(outline: Outline, lines: &[Vec<f64>; 2]) -> Result<Self, &'static str> {
        let counted = |uv: [f64; 2]| [0, 1].map(|k: usize| place(&lines[k], uv[k]));
        let plane: Vec<Vec<[f64; 2]>> =
            outline.loops.iter().map(|corners| corners.iter().map(|corner| counted(corner.uv)).collect()).collect();
        let fence = Fence::of(&plane, lines[1].len() - 1);
        let mut net = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
        let mut spots: Vec<Spot> = Vec::new();
        let mut twice = HashSet::new();
        let mut add = |net: &mut ConstrainedDelaunayTriangulation<Point2<f64>>, [x, y]: [f64; 2], spot: Spot| {
            let handle =
                net.insert(mitigate_underflow(Point2::new(x, y))).map_err(|_| "its loops have no place on it")?;
            if handle.index() == spots.len() {
                spots.push(spot);
            }
            Ok::<_, &'static str>(handle)
        };
        for (corners, points) in outline.loops.iter().zip(&plane) {
            let mut handles = Vec::with_capacity(points.len());
            for (&Corner { id, uv, .. }, &point) in corners.iter().zip(points) {
                handles.push(add(&mut net, point, Spot { uv, id: Some(id) })?);
            }
            for (&a, &b) in handles.iter().zip(handles.iter().cycle().skip(1)) {
                if a == b {
                    continue;
                }
                if !net.can_add_constraint(a, b) {
                    return Err("its loops cross each other");
                }
                if !net.add_constraint(a, b) {
                    let pair = [a.index().min(b.index()), a.index().max(b.index())];
                    if !twice.remove(&pair) {
                        twice.insert(pair);
                    }
                }
            }
        }
        for (i, &u) in lines[0].iter().enumerate() {
            for (j, &v) in lines[1].iter().enumerate() {
                let at = [i as f64, j as f64];
                if fence.holds(at) && !fence.is_near(at) {
                    add(&mut net, at, Spot { uv: [u, v], id: None })?;
                }
            }
        }
        let inside = inside(&net, &twice);
        let all = net.inner_faces().filter(|face| inside[face.index()]);
        let mut triangles: Vec<[usize; 3]> = all.map(|face| face.vertices().map(|corner| corner.index())).collect();
        if triangles.is_empty() {
            return Err("its loops enclose nothing");
        }
        if outline.left == Some(false) {
            triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        Ok(Self { spots, triangles })
    }

    /// Adds the triangles, and those of the mesh whose edges are halved.
    pub(super) fn triangles(
        &self,
        chart: &Chart<'_>,
        samples: &Samples,
        coarse: &mut Vec<[[f64; 3]; 3]>,
        fine: &mut Vec<[[f64; 3]; 3]>,
    ) {
        let points: Vec<[f64; 3]> = self
            .spots
            .iter()
            .map(|spot| spot.id.map_or_else(|| chart.point(spot.uv), |id| samples.points[id]))
            .collect();
        let middle = |a: usize, b: usize| {
            let (p, q) = (self.spots[a], self.spots[b]);
            match (p.id, q.id) {
                (Some(p), Some(q)) if p == q => return samples.points[p],
                (Some(p), Some(q)) => {
                    if let Some(&known) = samples.middles.get(&[p.min(q), p.max(q)]) {
                        return known;
                    }
                }
                _ => {}
            }
            chart.point([0, 1].map(|k: usize| 0.5 * (p.uv[k] + q.uv[k])))
        };
        for &[a, b, c] in &self.triangles {
            let [p, q, r] = [a, b, c].map(|k| points[k]);
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            coarse.push([p, q, r]);
            fine.extend([[p, ab, ca], [ab, q, bc], [ca, bc, r], [ab, bc, ca]]);
        }
    }
}
