//! The side of a hull as a grid that is even to the eye, with curvature and girth: what maps and viewers show.
//!
//! Columns are lines of the surface from keel to deck at side, at equal steps of length along its middle ([`SurfaceMap::new`]), or
//! stations at equal steps along the ship ([`SurfaceMap::at_stations`]). Rows are equal steps of the girth of each column, taken along
//! chords: of 1/[`STEPS`] of the column, or within [`DEVIATION`] of B of a station.

use super::curvature::deck_parameter;
use crate::hull::{Cut, Face, Hull};

/// Chords of a column or row while its length is measured.
const STEPS: usize = 240;

/// How far chords leave a station, in B.
const DEVIATION: f64 = 1e-4;
/// How far the first and the last station stand inside the ends, in lengths of the hull.
const INSIDE: f64 = 1e-4;

/// A point of the map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapPoint {
    /// Where it is \[m\].
    pub at: [f64; 3],
    /// Unit normal, outward; none where there is no tangent plane.
    pub normal: Option<[f64; 3]>,
    /// Girth from the keel \[m\].
    pub girth: f64,
    /// Gaussian curvature [1/m^2] and mean curvature \[1/m\], positive where the surface is convex outward.
    pub curvature: Option<[f64; 2]>,
}

/// The grid.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceMap {
    /// Points of a column.
    pub rows: usize,
    /// Column by column from aft, each from the keel up.
    pub points: Vec<MapPoint>,
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(p, q)| (p - q).powi(2)).sum::<f64>().sqrt()
}

/// `count` parameters from `from` to `to` at equal steps of the length of a curve, with the lengths up to them.
fn even(from: f64, to: f64, count: usize, point: impl Fn(f64) -> [f64; 3]) -> Vec<[f64; 2]> {
    let at = |k: usize| from + (to - from) * k as f64 / STEPS as f64;
    let points: Vec<[f64; 3]> = (0..=STEPS).map(|k| point(at(k))).collect();
    let mut lengths = vec![0.0];
    for pair in points.windows(2) {
        lengths.push(lengths[lengths.len() - 1] + distance(pair[0], pair[1]));
    }
    let whole = lengths[STEPS];
    let parameter = |k: usize| {
        let part = k as f64 / (count - 1) as f64;
        if whole <= 0.0 {
            return [from + (to - from) * part, 0.0];
        }
        let wanted = whole * part;
        let i = lengths.partition_point(|&length| length < wanted).clamp(1, STEPS);
        let step = lengths[i] - lengths[i - 1];
        let inner = if step > 0.0 { (wanted - lengths[i - 1]) / step } else { 0.0 };
        [at(i - 1) + inner.clamp(0.0, 1.0) * (at(i) - at(i - 1)), wanted]
    };
    (0..count).map(parameter).collect()
}

/// A point of the surface.
fn point(hull: &Hull, [u, v]: [f64; 2], girth: f64) -> MapPoint {
    let jet = hull.surface().jet(u, v);
    let found = jet.curvature().filter(|c| c.gaussian.is_finite() && c.mean.is_finite());
    MapPoint {
        at: jet.point,
        // With u forward and v upward the normal of the spline points inboard.
        normal: found.map(|c| c.normal.map(|n| -n)),
        girth,
        curvature: found.map(|c| [c.gaussian, c.mean]),
    }
}

/// Points of a station at equal steps of its girth.
fn station(hull: &Hull, x: f64, rows: usize) -> Vec<MapPoint> {
    let nothing = |girth| MapPoint { at: [x, 0.0, 0.0], normal: None, girth, curvature: None };
    let section = hull.section(Cut::Station { x }, 1e-6);
    let side = section.branches.iter().filter(|branch| branch.face == Face::Side);
    let mut line: Vec<[f64; 3]> = Vec::new();
    for branch in side {
        line.extend(branch.polyline(DEVIATION * hull.particulars().breadth));
    }
    let Some(first) = line.first() else { return vec![nothing(0.0); rows] };
    let mut girths = vec![first[1].max(0.0)];
    for pair in line.windows(2) {
        girths.push(girths[girths.len() - 1] + distance(pair[0], pair[1]));
    }
    let (from, to) = (girths[0], girths[girths.len() - 1]);
    let along = |k: usize| {
        let girth = from + (to - from) * k as f64 / (rows - 1) as f64;
        if line.len() < 2 {
            return nothing(girth);
        }
        let i = girths.partition_point(|&g| g < girth).clamp(1, line.len() - 1);
        let step = girths[i] - girths[i - 1];
        let t = if step > 0.0 { ((girth - girths[i - 1]) / step).clamp(0.0, 1.0) } else { 0.0 };
        let z = line[i - 1][2] + t * (line[i][2] - line[i - 1][2]);
        hull.parameters(x, z).map_or(nothing(girth), |at| point(hull, at, girth))
    };
    (0..rows).map(along).collect()
}

impl SurfaceMap {
    /// The map of the side of a hull; two columns and two rows at least.
    #[must_use]
    pub fn new(hull: &Hull, columns: usize, rows: usize) -> Self {
        let (columns, rows) = (columns.max(2), rows.max(2));
        let surface = hull.surface();
        let ((u0, u1), (v0, v1)) = (surface.u().domain(), surface.v().domain());
        let middle = 0.5 * (v0 + v1);
        let mut points = Vec::with_capacity(columns * rows);
        for [u, _] in even(u0, u1, columns, |u| surface.eval(u, middle)) {
            let deck = deck_parameter(hull, u);
            for [v, girth] in even(v0, deck, rows, |v| surface.eval(u, v)) {
                points.push(point(hull, [u, v], girth));
            }
        }
        Self { rows, points }
    }

    /// The map over stations, aft to forward; girths start at the centreplane, a flat of bottom counts. Stations without a curve on the
    /// side have points without normal and curvature.
    #[must_use]
    pub fn at_stations(hull: &Hull, columns: usize, rows: usize) -> Self {
        let (columns, rows) = (columns.max(2), rows.max(2));
        let xs = hull.surface().points().iter().map(|p| p[0]);
        let (low, high) = xs.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let inside = INSIDE * (high - low);
        let mut points = Vec::with_capacity(columns * rows);
        for i in 0..columns {
            let x = low + inside + (high - low - 2.0 * inside) * i as f64 / (columns - 1) as f64;
            points.extend(station(hull, x, rows));
        }
        Self { rows, points }
    }

    /// How many columns there are.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.points.len() / self.rows
    }

    /// A point by column and row.
    #[must_use]
    pub fn point(&self, column: usize, row: usize) -> &MapPoint {
        &self.points[column * self.rows + row]
    }

    /// The least number that the part `share` of the sizes of a curvature (0 Gaussian, 1 mean) does not pass; 0 on a flat hull.
    #[must_use]
    pub fn size(&self, which: usize, share: f64) -> f64 {
        let mut sizes: Vec<f64> = self.points.iter().filter_map(|p| Some(p.curvature?[which].abs())).collect();
        sizes.sort_by(f64::total_cmp);
        let last = sizes.len().saturating_sub(1);
        sizes.get(((share * last as f64) as usize).min(last)).copied().unwrap_or(0.0)
    }
}
