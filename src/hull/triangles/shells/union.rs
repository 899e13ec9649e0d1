//! The skin of the union of shells that reach into others.
//!
//! A piece of a shell is on the skin where the other shells do not hold the point just outside of it. Of pieces of several
//! shells in one place, that of the first is kept. Triangles across the skin of another shell are cut in four, until
//! they are small. What is left across counts by its middle. The pieces are no conforming mesh.

use super::super::TriangleMesh;
use super::solid_angle;
use crate::spline::{cross, length, minus};
use std::f64::consts::PI;

/// Cuts of a triangle across a skin, one after the other, at most.
const CUTS: usize = 14;

/// Triangles that are no longer than this part of the body are not cut.
const SMALL: f64 = 1e-4;

/// Distance from a piece at which its sides are looked at, over the size of the body.
const BESIDE: f64 = 1e-6;

/// How far corners are drawn to the middle of their triangle before they are looked at.
const DRAWN: f64 = 1e-3;

/// Most solid angles.
const MOST: usize = 150_000_000;

type Triangle = [[f64; 3]; 3];

/// A shell with its openings covered, and its bounds.
struct Shell<'a> {
    triangles: &'a [Triangle],
    bounds: [[f64; 3]; 2],
}

impl Shell<'_> {
    fn holds(&self, point: [f64; 3], angles: &mut usize) -> bool {
        let [least, greatest] = self.bounds;
        if (0..3).any(|k| point[k] < least[k] || point[k] > greatest[k]) {
            return false;
        }
        *angles += self.triangles.len();
        let sum: f64 = self.triangles.iter().map(|t| solid_angle(t.map(|corner| minus(corner, point)))).sum();
        sum > 2.0 * PI
    }
}

/// What the other shells are to a point of a shell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    /// On the skin of the union.
    Skin,
    /// Inside, or in the place of a piece of an earlier shell.
    Within,
}

struct Union<'a> {
    shells: Vec<Shell<'a>>,
    beside: f64,
    /// Triangles shorter than this are not cut \[m\].
    shortest: f64,
    angles: usize,
}

impl Union<'_> {
    fn side(&mut self, own: usize, point: [f64; 3], normal: [f64; 3]) -> Side {
        let at = |by: f64| -> [f64; 3] { std::array::from_fn(|k| point[k] + by * normal[k]) };
        let (out, inside) = (at(self.beside), at(-self.beside));
        for (k, shell) in self.shells.iter().enumerate().filter(|(k, _)| *k != own) {
            if shell.holds(out, &mut self.angles) || k < own && shell.holds(inside, &mut self.angles) {
                // An earlier shell that holds the inside alone has its skin here.
                return Side::Within;
            }
        }
        Side::Skin
    }

    /// Adds the pieces of a triangle that are on the skin.
    fn cut(&mut self, own: usize, triangle: Triangle, depth: usize, pieces: &mut Vec<Triangle>) {
        let [a, b, c] = triangle;
        let normal = cross(minus(b, a), minus(c, a));
        let area = length(normal);
        if area <= 0.0 || self.angles > MOST {
            return;
        }
        let normal = normal.map(|n| n / area);
        let middle: [f64; 3] = std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0);
        let drawn = |corner: [f64; 3]| std::array::from_fn(|k| corner[k] + DRAWN * (middle[k] - corner[k]));
        let here = self.side(own, middle, normal);
        let alike = triangle.into_iter().all(|corner| self.side(own, drawn(corner), normal) == here);
        let small = self.apart(own, triangle);
        let longest = [minus(b, a), minus(c, b), minus(a, c)].into_iter().map(length).fold(0.0, f64::max);
        if (alike && small) || depth == 0 || longest < self.shortest {
            if here == Side::Skin {
                pieces.push(triangle);
            }
            return;
        }
        let half = |p: [f64; 3], q: [f64; 3]| -> [f64; 3] { std::array::from_fn(|k| 0.5 * (p[k] + q[k])) };
        let [p, q, r] = [half(a, b), half(b, c), half(c, a)];
        for part in [[a, p, r], [p, b, q], [r, q, c], [p, q, r]] {
            self.cut(own, part, depth - 1, pieces);
        }
    }

    /// Whether no other shell is smaller than the triangle where it is: it cannot pass through its middle.
    fn apart(&self, own: usize, triangle: Triangle) -> bool {
        let bounds = bounds(&[triangle]);
        self.shells.iter().enumerate().filter(|(k, _)| *k != own).all(|(_, shell)| {
            let meets = (0..3).all(|k| bounds[0][k] <= shell.bounds[1][k] && bounds[1][k] >= shell.bounds[0][k]);
            let size = |b: [[f64; 3]; 2]| length(minus(b[1], b[0]));
            !meets || size(bounds) < 0.5 * size(shell.bounds)
        })
    }
}

/// Least and greatest coordinates of triangles \[m\].
pub(super) fn bounds(triangles: &[Triangle]) -> [[f64; 3]; 2] {
    let fold = |pick: fn(f64, f64) -> f64, from: f64| {
        triangles.iter().flatten().fold([from; 3], |ends, point| [0, 1, 2].map(|k| pick(ends[k], point[k])))
    };
    [fold(f64::min, f64::INFINITY), fold(f64::max, f64::NEG_INFINITY)]
}

/// The skin of the union of the shells of a mesh, each with its openings covered in `closed`; none where it would cost too
/// much.
pub(super) fn united(mesh: &TriangleMesh, shells: &[Vec<usize>], closed: &[Vec<Triangle>]) -> Option<TriangleMesh> {
    let [least, greatest] = mesh.bounds()?;
    let shells_closed = closed.iter().map(|triangles| Shell { triangles, bounds: bounds(triangles) });
    let size = length(minus(greatest, least));
    let mut union = Union { shells: shells_closed.collect(), beside: BESIDE * size, shortest: SMALL * size, angles: 0 };
    let mut pieces = Vec::with_capacity(mesh.triangles.len());
    for (own, shell) in shells.iter().enumerate() {
        for &t in shell {
            let triangle = mesh.triangles[t].map(|v| mesh.vertices[v]);
            union.cut(own, triangle, CUTS, &mut pieces);
        }
        if union.angles > MOST {
            return None;
        }
    }
    Some(TriangleMesh::from_corners(pieces.into_iter()))
}

#[cfg(test)]
mod tests {
    use super::super::super::tests::brick;
    use super::super::TriangleMesh;

    /// Volume of a brick with others, each moved and scaled about the origin, over that of the brick.
    fn share(others: &[([f64; 3], f64)]) -> f64 {
        let moved = others.iter().flat_map(|&(by, scale)| {
            let place = move |corner: [f64; 3]| std::array::from_fn(|axis| by[axis] + scale * corner[axis]);
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
        // Half of a second brick, moved along, within faces in common; and moved in all directions.
        assert!((share(&[([0.5 * l, 0.0, 0.0], 1.0)]) - 1.5).abs() < 2e-3);
        let moved = share(&[([0.25 * l, 0.125 * b, 0.25 * h], 1.0)]);
        assert!((moved - (2.0 - 0.75 * 0.875 * 0.75)).abs() < 2e-2, "{moved}");
        // The same a hair's breadth aside.
        assert!((share(&[([1e-4 * l, 1e-4 * b, 1e-4 * h], 1.0)]) - 1.0).abs() < 2e-3);
    }
}
