//! The skin of the union of skins that reach into others, or touch them.
//!
//! Triangles are cut along the planes of those of other skins that they meet, and along the edges of those that lie in their
//! own plane. So no piece passes through another skin. A piece is on the skin of the union where the other skins do not hold
//! the point just outside of it. Of pieces of several skins in one place, that of the first is kept. Triangles that hang
//! together and meet no other skin are looked at once. The pieces are no conforming mesh.

use super::super::TriangleMesh;
use super::super::boxes::{Bounds, Boxes, around, widened};
use super::winding::Winding;
use crate::spline::{cross, dot, length, minus};
use std::f64::consts::PI;

/// Distance from a piece at which its sides are looked at, over the size of the body.
const BESIDE: f64 = 1e-6;

/// Triangles lie in one plane where they are nearer to it than this part of the size of the body.
const FLAT: f64 = 2.0 * BESIDE;

/// Points are on a plane within this part of the size of the body.
const ON: f64 = 1e-10;

/// Most solid angles; and how many of them a piece is worth that is looked at beside a triangle.
const MOST: usize = 150_000_000;
const PIECE: usize = 16;

type Triangle = [[f64; 3]; 3];
type Polygon = Vec<[f64; 3]>;

/// Shells that enclose something together.
pub(super) struct Skin {
    /// Triangles of the mesh.
    pub(super) triangles: Vec<usize>,
    /// Their corners, and covers of the openings.
    pub(super) closed: Vec<Triangle>,
    pub(super) bounds: Bounds,
}

/// What becomes of a triangle.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Fate {
    /// On the skin of the union.
    Kept,
    /// Inside, or in the place of a piece of an earlier skin.
    Within,
    /// These of its pieces are on the skin.
    Cut(Vec<Polygon>),
}

/// How a piece meets a triangle of another skin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Contact {
    None,
    /// An edge of the piece is on it.
    Touch,
    /// The piece passes through it.
    Through,
    /// They lie in one plane and share an area.
    Flat,
}

/// A plane: points whose product with the normal is the distance.
struct Plane {
    normal: [f64; 3],
    off: f64,
}

impl Plane {
    fn height(&self, point: [f64; 3]) -> f64 {
        dot(self.normal, point) - self.off
    }

    /// The parts of a polygon below and above.
    fn split(&self, polygon: &[[f64; 3]], on: f64) -> [Polygon; 2] {
        let mut parts = [Vec::new(), Vec::new()];
        for (k, &p) in polygon.iter().enumerate() {
            let q = polygon[(k + 1) % polygon.len()];
            let (here, there) = (self.height(p), self.height(q));
            if here <= on {
                parts[0].push(p);
            }
            if here >= -on {
                parts[1].push(p);
            }
            if here < -on && there > on || here > on && there < -on {
                let share = here / (here - there);
                let point = [0, 1, 2].map(|i| p[i] + share * (q[i] - p[i]));
                parts.iter_mut().for_each(|part| part.push(point));
            }
        }
        parts
    }
}

/// A triangle with its plane and those through its edges, which face inward.
struct Cutter {
    plane: Plane,
    sides: [Plane; 3],
}

impl Cutter {
    fn new([a, b, c]: Triangle) -> Option<Self> {
        let through = |normal: [f64; 3], point: [f64; 3]| {
            let size = length(normal);
            let normal = normal.map(|n| n / size);
            (size > 0.0).then(|| Plane { normal, off: dot(normal, point) })
        };
        let plane = through(cross(minus(b, a), minus(c, a)), a)?;
        let side = |from: [f64; 3], to: [f64; 3]| through(cross(plane.normal, minus(to, from)), from);
        let sides = [side(a, b)?, side(b, c)?, side(c, a)?];
        Some(Self { plane, sides })
    }

    fn contact(&self, polygon: &[[f64; 3]], size: f64) -> Contact {
        let on = ON * size;
        let heights: Vec<f64> = polygon.iter().map(|point| self.plane.height(*point)).collect();
        if heights.iter().all(|h| h.abs() <= FLAT * size) {
            let shared = self.sides.iter().fold(polygon.to_vec(), |rest, side| side.split(&rest, on)[1].clone());
            return if area(&shared) > on * size { Contact::Flat } else { Contact::None };
        }
        let is_over = heights.iter().any(|h| *h > on);
        let is_under = heights.iter().any(|h| *h < -on);
        let [below, above] = self.plane.split(polygon, on);
        // The points of the polygon on the plane.
        let line: Vec<[f64; 3]> = if is_under { below } else { above };
        let mut ends = line.into_iter().filter(|point| self.plane.height(*point).abs() <= 4.0 * on);
        let Some(a) = ends.next() else { return Contact::None };
        let far = |p: &[f64; 3]| length(minus(*p, a));
        let Some(b) = ends.max_by(|p, q| far(p).total_cmp(&far(q))) else { return Contact::None };
        let mut range = [0.0_f64, 1.0_f64];
        for side in &self.sides {
            let (here, there) = (side.height(a) + on, side.height(b) + on);
            match (here < 0.0, there < 0.0) {
                (true, true) => return Contact::None,
                (true, false) => range[0] = range[0].max(here / (here - there)),
                (false, true) => range[1] = range[1].min(here / (here - there)),
                (false, false) => {}
            }
        }
        match range[0] <= range[1] {
            false => Contact::None,
            true if is_over && is_under => Contact::Through,
            true => Contact::Touch,
        }
    }

    /// Adds the parts into which the triangle cuts a piece.
    fn cut(&self, piece: Polygon, size: f64, parts: &mut Vec<Polygon>) {
        let on = ON * size;
        match self.contact(&piece, size) {
            Contact::None | Contact::Touch => parts.push(piece),
            Contact::Through => parts.extend(self.plane.split(&piece, on)),
            Contact::Flat => {
                let mut rest = piece;
                for side in &self.sides {
                    let [out, inside] = side.split(&rest, on);
                    parts.push(out);
                    rest = inside;
                }
                parts.push(rest);
            }
        }
    }
}

/// Twice the area of a polygon, as a vector along its normal.
fn normal(polygon: &[[f64; 3]]) -> [f64; 3] {
    let fans = (2..polygon.len()).map(|k| cross(minus(polygon[k - 1], polygon[0]), minus(polygon[k], polygon[0])));
    fans.fold([0.0; 3], |sum, n| [0, 1, 2].map(|k| sum[k] + n[k]))
}

fn area(polygon: &[[f64; 3]]) -> f64 {
    0.5 * length(normal(polygon))
}

struct Union<'a> {
    skins: &'a [Skin],
    windings: Vec<Winding>,
    size: f64,
    work: usize,
}

impl Union<'_> {
    fn holds(&mut self, skin: usize, point: [f64; 3]) -> bool {
        let [low, high] = self.skins[skin].bounds;
        if (0..3).any(|k| point[k] < low[k] || point[k] > high[k]) {
            return false;
        }
        self.windings[skin].angle(point, &mut self.work) > 2.0 * PI
    }

    fn is_on_skin(&mut self, own: usize, polygon: &[[f64; 3]]) -> bool {
        let normal = normal(polygon);
        let size = length(normal);
        if size <= 0.0 || self.work > MOST {
            return false;
        }
        let middle = super::mean(polygon.iter().copied(), polygon.len());
        let at = |by: f64| [0, 1, 2].map(|k| middle[k] + by * self.size * normal[k] / size);
        let (out, inside) = (at(BESIDE), at(-BESIDE));
        // An earlier skin that holds the inside alone is in the same place.
        (0..self.skins.len()).all(|k| k == own || !self.holds(k, out) && (k > own || !self.holds(k, inside)))
    }
}

/// What becomes of the triangles of a mesh; none where it would cost too much.
pub(super) fn fates(mesh: &TriangleMesh, skins: &[Skin]) -> Option<Vec<Fate>> {
    let [least, greatest] = mesh.bounds()?;
    let size = length(minus(greatest, least));
    let all: Vec<(usize, Triangle)> =
        skins.iter().enumerate().flat_map(|(k, skin)| skin.closed.iter().map(move |t| (k, *t))).collect();
    let tree = Boxes::new(all.iter().map(|(_, t)| around(t.iter().copied())).collect());
    let windings = skins.iter().map(|skin| Winding::of(&skin.closed)).collect();
    let mut union = Union { skins, windings, size, work: 0 };
    let mut fates = vec![Fate::Kept; mesh.triangles.len()];
    let mut alone = vec![false; mesh.triangles.len()];
    for (own, skin) in skins.iter().enumerate() {
        for &t in &skin.triangles {
            let corners = mesh.triangles[t].map(|v| mesh.vertices[v]);
            let near = tree.meeting(&widened(around(corners.into_iter()), FLAT * size));
            let cutters = near.into_iter().filter(|k| all[*k].0 != own).filter_map(|k| Cutter::new(all[k].1));
            let mut pieces: Vec<Polygon> = vec![corners.to_vec()];
            for cutter in cutters {
                union.work += 1;
                if cutter.contact(&corners, size) == Contact::None {
                    continue;
                }
                alone[t] = true;
                let mut parts = Vec::with_capacity(pieces.len() + 1);
                union.work += PIECE * pieces.len();
                pieces.into_iter().for_each(|piece| cutter.cut(piece, size, &mut parts));
                parts.retain(|part| part.len() > 2 && area(part) > 0.0);
                pieces = parts;
                if union.work > MOST {
                    return None;
                }
            }
            if alone[t] {
                let count = pieces.len();
                pieces.retain(|piece| union.is_on_skin(own, piece));
                fates[t] = match pieces.len() {
                    0 => Fate::Within,
                    kept if kept == count => Fate::Kept,
                    _ => Fate::Cut(pieces),
                };
            }
        }
    }
    let neighbours = mesh.neighbours();
    let mut of = vec![0; mesh.triangles.len()];
    skins.iter().enumerate().for_each(|(k, skin)| skin.triangles.iter().for_each(|&t| of[t] = k));
    for first in 0..fates.len() {
        if alone[first] {
            continue;
        }
        alone[first] = true;
        let mut part = vec![first];
        let mut next = 0;
        while let Some(&t) = part.get(next) {
            next += 1;
            for (other, _) in neighbours[t].into_iter().flatten() {
                if !alone[other] {
                    alone[other] = true;
                    part.push(other);
                }
            }
        }
        let corners = |t: usize| mesh.triangles[t].map(|v| mesh.vertices[v]);
        let large = |t: &usize| area(&corners(*t));
        let largest = part.iter().copied().max_by(|a, b| large(a).total_cmp(&large(b))).unwrap_or(first);
        if !union.is_on_skin(of[first], &corners(largest)) {
            part.iter().for_each(|&t| fates[t] = Fate::Within);
        }
    }
    (union.work <= MOST).then_some(fates)
}

#[cfg(test)]
mod tests {
    use super::super::super::tests::brick;
    use super::super::TriangleMesh;
    use super::PI;

    /// Volume of a brick with others, each moved and scaled about the origin, over that of the brick.
    fn share(others: &[([f64; 3], [f64; 3])]) -> f64 {
        let moved = others.iter().flat_map(|&(by, scale)| {
            let place = move |corner: [f64; 3]| std::array::from_fn(|axis| by[axis] + scale[axis] * corner[axis]);
            brick().corners().map(move |corners| corners.map(place)).collect::<Vec<_>>()
        });
        let both = TriangleMesh::from_corners(brick().corners().chain(moved).collect::<Vec<_>>().into_iter());
        let (mesh, found) = both.without_inner_shells();
        assert!(found.united, "{found:?}");
        mesh.report().volume / brick().report().volume
    }

    #[test]
    fn what_shells_share_counts_once() {
        let [least, greatest] = brick().bounds().unwrap();
        let [l, b, h] = [0, 1, 2].map(|k| greatest[k] - least[k]);
        for (by, scale, wanted) in [
            // Moved along, within faces in common; moved in all directions; a hair's breadth aside.
            ([0.5 * l, 0.0, 0.0], [1.0; 3], 1.5),
            ([0.25 * l, 0.125 * b, 0.25 * h], [1.0; 3], 2.0 - 0.75 * 0.875 * 0.75),
            ([1e-4 * l, 1e-4 * b, 1e-4 * h], [1.0; 3], 2.0 - (1.0 - 1e-4_f64).powi(3)),
            // A fin through both sides, a column flush with the bottom, a leg through bottom and deck.
            ([1.0, 0.0, 0.5], [0.1, 2.0, 0.05], 1.0 + 0.1 * 0.05),
            ([1.0, 0.0, 0.0], [0.25, 0.25, 3.0], 1.0 + 0.0625 * 2.0),
            ([1.0, 0.0, -3.0], [0.25, 0.25, 4.0], 1.0 + 0.0625 * 3.0),
        ] {
            let found = share(&[(by, scale)]);
            assert!((found - wanted).abs() < 1e-9, "{by:?} {scale:?}: {found} for {wanted}");
        }
    }

    /// A ball of many triangles with a block that holds half of it: no mesh of so many is left with what they share twice.
    #[test]
    fn a_skin_of_many_triangles_is_united() {
        let (rows, columns) = (120, 240);
        let at = |i: usize, j: usize| {
            let (v, u) = (PI * i as f64 / rows as f64, 2.0 * PI * (j % columns) as f64 / columns as f64);
            if i == 0 || i == rows { [0.0, 0.0, v.cos()] } else { [v.sin() * u.cos(), v.sin() * u.sin(), v.cos()] }
        };
        let cells = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
        let ball: Vec<_> = cells
            .flat_map(|(i, j)| {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                [[a, b, c], [a, c, d]]
            })
            .collect();
        let ball = TriangleMesh::from_corners(ball.into_iter());
        let [low, high] = brick().bounds().unwrap();
        // From x = 0.003 on, beyond the ball on all other sides.
        let place = |corner: [f64; 3]| {
            let share = |k: usize| (corner[k] - low[k]) / (high[k] - low[k]);
            [0.003 + 2.0 * share(0), 4.0 * share(1) - 2.0, 4.0 * share(2) - 2.0]
        };
        let block = TriangleMesh::from_corners(brick().corners().map(|t| t.map(place)).collect::<Vec<_>>().into_iter());
        let both: Vec<_> = ball.corners().chain(block.corners()).collect();
        let (mesh, found) = TriangleMesh::from_corners(both.into_iter()).without_inner_shells();
        assert!(found.united && !found.torn, "{found:?}");
        let wanted = 32.0 + 0.5 * ball.report().volume + PI * 0.003;
        let [volume, _] = mesh.enclosed_and_skin();
        assert!((volume - wanted).abs() < 1e-4, "{volume} for {wanted}");
    }
}
