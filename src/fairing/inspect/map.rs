//! The side of a hull as a grid that is even to the eye, with curvature and girth: what maps and viewers show.
//!
//! Columns are lines of the surface from keel to deck at side, at equal steps of length along its middle
//! ([`SurfaceMap::new`]), or stations at equal steps along the ship ([`SurfaceMap::at_stations`], in `stations`).

use super::curvature::deck_parameter;
use crate::hull::Hull;
use crate::spline::KnotVector;

/// Chords of a column or row while its length is measured.
const STEPS: usize = 240;

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
    /// Knot lines of the surface across which curvature may jump.
    pub breaks: Vec<MapBreak>,
    /// How many more of them the surface has: where there are too many, knuckles alone are among `breaks`.
    pub more_breaks: usize,
}

/// What a knot line of the surface is to curvature.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum KnotLine {
    /// The tangent plane is continuous, curvature may jump.
    Tangent,
    /// The tangent plane may break: a knuckle.
    Knuckle,
}

/// A knot line of the surface that is two rows or two columns of a map, one for each of its sides, at one place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MapBreak {
    /// What it is.
    pub line: KnotLine,
    /// Whether it is a pair of columns; else it is a pair of rows.
    pub columns: bool,
    /// The first of the two.
    pub first: usize,
}

impl MapBreak {
    /// The inner knots at which curvature may jump, and how many are left out: of more than `most` knuckles alone are
    /// kept.
    pub(super) fn of(knots: &KnotVector, most: usize) -> (Vec<(f64, KnotLine)>, usize) {
        let (low, high) = knots.domain();
        let inner = knots.breakpoints().into_iter().filter(|&t| low < t && t < high);
        let line = |t: f64| match knots.multiplicity(t) {
            n if n >= knots.degree() => Some((t, KnotLine::Knuckle)),
            n if n + 1 >= knots.degree() => Some((t, KnotLine::Tangent)),
            _ => None,
        };
        let mut list: Vec<(f64, KnotLine)> = inner.filter_map(line).collect();
        let all = list.len();
        if all > most {
            list.retain(|(_, line)| *line == KnotLine::Knuckle);
            list.truncate(most);
        }
        let left_out = all - list.len();
        (list, left_out)
    }
}

pub(super) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
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
pub(super) fn point(hull: &Hull, [u, v]: [f64; 2], girth: f64) -> MapPoint {
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
        Self { rows, points, breaks: Vec::new(), more_breaks: 0 }
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

    /// The two points beside each other across a break, all along it, by the number of the column or row that crosses it.
    #[must_use]
    pub fn across(&self, found: &MapBreak) -> Vec<[&MapPoint; 2]> {
        let pair = |k: usize| match found.columns {
            true => [self.point(found.first, k), self.point(found.first + 1, k)],
            false => [self.point(k, found.first), self.point(k, found.first + 1)],
        };
        (0..if found.columns { self.rows } else { self.columns() }).map(pair).collect()
    }

    /// The least number that the part `share` of the surface does not pass with the size of a curvature (0 Gaussian, 1
    /// mean); a point stands for the girth and the length between the middles of its steps. 0 on a flat hull.
    #[must_use]
    pub fn size(&self, which: usize, share: f64) -> f64 {
        let weighted = |(k, point): (usize, &MapPoint)| {
            let (first, last) = (k / self.rows * self.rows, (k / self.rows + 1) * self.rows - 1);
            let girth = |k: usize| self.points[k.clamp(first, last)].girth;
            let high = girth(k + 1) - girth(k.saturating_sub(1));
            let along = |k: usize| self.points[k].at[0];
            let beside = [
                k.checked_sub(self.rows).unwrap_or(k),
                Some(k + self.rows).filter(|&n| n < self.points.len()).unwrap_or(k),
            ];
            Some((point.curvature?[which].abs(), high * (along(beside[1]) - along(beside[0])).abs()))
        };
        let mut sizes: Vec<(f64, f64)> = self.points.iter().enumerate().filter_map(weighted).collect();
        sizes.sort_by(|a, b| a.0.total_cmp(&b.0));
        let whole: f64 = sizes.iter().map(|(_, wide)| wide).sum();
        let mut sum = 0.0;
        let found = sizes.iter().find(|(_, wide)| {
            sum += wide;
            sum >= share * whole
        });
        found.map_or(0.0, |(size, _)| *size)
    }
}
