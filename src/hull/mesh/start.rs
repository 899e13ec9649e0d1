//! The grid of the parameters that a mesh begins with: cells of the side, and strips between its edges and the
//! centreplane.

use super::super::vertices::Known;
use super::Region;
use super::body::{Body, Form, ROUND, Site};
use super::half::Half;
use crate::spline::{length, minus};

/// Edges of the side nearer to the centreplane than this part of the deviation are on it.
const SNAPPED: f64 = 0.5;

/// Neighbours in the grid that are closer than this part of the deviation are one vertex.
const SAME: f64 = 1e-2;

/// Wanted lengths of edges over the deviation, at least.
const LEAST_SIZE: f64 = 3.0;

/// The side whose square is five deviations over the curvature: an equilateral triangle of it leaves a sphere by five
/// sixths of the deviation, and a cylinder by five eighths.
fn size_at(curvature: f64, deviation: f64) -> f64 {
    (5.0 * deviation / curvature.max(1e-12)).sqrt().max(LEAST_SIZE * deviation)
}

/// The start of a mesh from lines of the parameters; `across` cells from the centreplane to the edge of the faces that
/// close the body.
pub(super) fn half<'a>(body: &'a Body<'a>, [us, ws]: [&[f64]; 2], deviation: f64, across: usize) -> Half<'a> {
    let mut half = Half {
        body,
        points: Vec::new(),
        sites: Vec::new(),
        sizes: Vec::new(),
        forms: Vec::new(),
        faces: Vec::new(),
        free: Vec::new(),
        around: Vec::new(),
        deviation: 0.5 * deviation,
        allowed: 0.5 * deviation,
    };
    let mut known = Known::default();
    let (m, n) = (us.len(), ws.len());
    let snap = SNAPPED * deviation;
    let mut place = |half: &mut Half, region: Region, at: [f64; 2], point: [f64; 3], size: f64, form: Form| -> usize {
        let count = half.points.len();
        let v = known.place(&mut half.points, point);
        if v == count {
            half.sites.push(Site::at(region, at));
            half.sizes.push(size);
            half.forms.push(form);
            half.around.push(Vec::new());
        } else {
            if half.sites[v].region == region {
                half.sites[v].add(at);
            }
            half.sizes[v] = half.sizes[v].min(size);
        }
        v
    };
    let same = SAME * deviation;
    let mut grid: Vec<Vec<usize>> = Vec::with_capacity(m);
    for (i, &u) in us.iter().enumerate() {
        let mut column: Vec<usize> = Vec::with_capacity(n);
        for (j, &w) in ws.iter().enumerate() {
            let mut point = body.side([u, w]);
            let edge = i == 0 || i + 1 == m || j == 0 || j + 1 == n;
            if edge && point[1] <= snap {
                point[1] = 0.0;
            }
            // Lines of the grid that shrink to a point do so but for rounding.
            let before = [column.last(), grid.last().map(|last: &Vec<usize>| &last[j])];
            let near = before.into_iter().flatten().find(|&&v| length(minus(half.points[v], point)) <= same);
            if let Some(&v) = near {
                point = half.points[v];
            }
            let (size, form) = body
                .curvature([u, w])
                .map_or((f64::INFINITY, ROUND), |(curvature, form)| (size_at(curvature, deviation), form));
            column.push(place(&mut half, Region::Hull, [u, w], point, size, form));
        }
        grid.push(column);
    }
    let cell = |half: &mut Half, region: Region, [a, b, c, d]: [usize; 4]| {
        let halves =
            if half.distance(a, c) <= half.distance(b, d) { [[a, b, c], [a, c, d]] } else { [[b, c, d], [b, d, a]] };
        for corners in halves {
            let [p, q, r] = corners;
            let flat = region == Region::Hull && corners.iter().all(|&v| half.on_centreplane(v));
            if p != q && q != r && r != p && !flat {
                half.push((region, corners));
            }
        }
    };
    for i in 0..m - 1 {
        for j in 0..n - 1 {
            cell(&mut half, Region::Hull, [grid[i][j], grid[i][j + 1], grid[i + 1][j + 1], grid[i + 1][j]]);
        }
    }
    let row = |j: usize| -> Vec<(f64, usize)> { us.iter().enumerate().map(|(i, &u)| (u, grid[i][j])).collect() };
    let column = |i: usize| -> Vec<(f64, usize)> { ws.iter().enumerate().map(|(j, &w)| (w, grid[i][j])).collect() };
    let reversed = |mut edge: Vec<(f64, usize)>| {
        edge.reverse();
        edge
    };
    let strips = [
        (Region::Bottom, reversed(row(0))),
        (Region::Transom, column(0)),
        (Region::Bow, reversed(column(m - 1))),
        (Region::Deck, row(n - 1)),
    ];
    for (region, edge) in strips {
        let breadth = edge.iter().map(|&(_, v)| half.points[v][1]).fold(0.0, f64::max);
        let mut lines: Vec<Vec<usize>> = Vec::new();
        for &(along, v) in &edge {
            let [x, y, z] = half.points[v];
            let wide = (breadth / across as f64).min(y.max(LEAST_SIZE * deviation));
            half.sizes[v] = half.sizes[v].min(if y > 0.0 { wide } else { breadth.max(LEAST_SIZE * deviation) });
            let inner = (0..across).map(|k| {
                let share = k as f64 / across as f64;
                if y <= 0.0 { v } else { place(&mut half, region, [along, share], [x, y * share, z], wide, ROUND) }
            });
            lines.push(inner.chain([v]).collect());
        }
        // Sheer: lengths by what the middle of three points of the edge leaves the line between the others by.
        for (k, three) in edge.windows(3).enumerate() {
            let [a, b, c] = [three[0].1, three[1].1, three[2].1].map(|v| half.points[v]);
            let (p, q) = (length([b[0] - a[0], 0.0, b[2] - a[2]]), length([c[0] - b[0], 0.0, c[2] - b[2]]));
            if p > 0.0 && q > 0.0 {
                let (s, t) = (minus(b, a).map(|c| c / p), minus(c, b).map(|c| c / q));
                let curvature = 2.0 * (t[0] - s[0]).hypot(t[2] - s[2]) / (p + q);
                let size = size_at(curvature, deviation);
                for &v in &lines[k + 1] {
                    half.sizes[v] = half.sizes[v].min(size);
                }
            }
        }
        for pair in lines.windows(2) {
            for k in 0..across {
                cell(&mut half, region, [pair[0][k], pair[1][k], pair[1][k + 1], pair[0][k + 1]]);
            }
        }
    }
    half.grade();
    half
}
