//! The side of a hull as a grid that is even to the eye, with curvature and girth: what maps and viewers show.
//!
//! Columns are lines of the surface from keel to deck at side, at equal steps of length along its middle ([`SurfaceMap::new`]), or
//! stations at equal steps along the ship ([`SurfaceMap::at_stations`]). Rows are equal steps of the girth of each column, taken along
//! chords: of 1/[`STEPS`] of the column, or within [`DEVIATION`] of B of a station. Lines of the surface across which curvature jumps
//! (tangent lines of a bilge, edges of flats, chines) part the stations into bands with rows of their own, and both sides of such a line
//! are points of the map, at one place.

use super::curvature::deck_parameter;
use crate::hull::{Cut, Face, Hull};

/// Chords of a column or row while its length is measured.
const STEPS: usize = 240;

/// How far chords leave a station, in B.
const DEVIATION: f64 = 1e-4;
/// How far the first and the last station stand inside the ends, in lengths of the hull.
const INSIDE: f64 = 1e-4;

/// Most lines that part the stations; a surface with more of them breaks everywhere a little, and nowhere in particular.
const MOST_BREAKS: usize = 6;
/// How far beside such a line its two sides are looked at, in the range of the parameter.
const BESIDE: f64 = 1e-7;
/// Least rows of a band, in steps.
const LEAST_STEPS: usize = 2;

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

/// Values of v across which curvature jumps.
fn breaks(hull: &Hull) -> Vec<f64> {
    let knots = hull.surface().v();
    let inner = knots.breakpoints().into_iter().filter(|&v| {
        let (low, high) = knots.domain();
        low < v && v < high && knots.multiplicity(v) + 1 >= knots.degree()
    });
    let list: Vec<f64> = inner.collect();
    if list.len() > MOST_BREAKS { Vec::new() } else { list }
}

/// The side of a station as chords, with the girths of their ends.
struct Girth {
    x: f64,
    line: Vec<[f64; 3]>,
    girths: Vec<f64>,
}

impl Girth {
    fn new(hull: &Hull, x: f64) -> Self {
        let section = hull.section(Cut::Station { x }, 1e-6);
        let side = section.branches.iter().filter(|branch| branch.face == Face::Side);
        let mut line: Vec<[f64; 3]> = Vec::new();
        for branch in side {
            line.extend(branch.polyline(DEVIATION * hull.particulars().breadth));
        }
        let mut girths: Vec<f64> = line.first().map(|first| first[1].max(0.0)).into_iter().collect();
        for pair in line.windows(2) {
            girths.push(girths[girths.len() - 1] + distance(pair[0], pair[1]));
        }
        Self { x, line, girths }
    }

    fn ends(&self) -> [f64; 2] {
        [self.girths.first().copied().unwrap_or(0.0), self.girths.last().copied().unwrap_or(0.0)]
    }

    /// Height at a girth; none of a station without a curve.
    fn height(&self, girth: f64) -> Option<f64> {
        if self.line.len() < 2 {
            return None;
        }
        let (line, girths) = (&self.line, &self.girths);
        let i = girths.partition_point(|&g| g < girth).clamp(1, line.len() - 1);
        let step = girths[i] - girths[i - 1];
        let t = if step > 0.0 { ((girth - girths[i - 1]) / step).clamp(0.0, 1.0) } else { 0.0 };
        Some(line[i - 1][2] + t * (line[i][2] - line[i - 1][2]))
    }

    fn parameters(&self, hull: &Hull, girth: f64) -> Option<[f64; 2]> {
        hull.parameters(self.x, self.height(girth)?)
    }

    /// The girth at which the station crosses the line `v` of the surface; an end of the station where it does not reach it.
    fn crossing(&self, hull: &Hull, v: f64) -> f64 {
        let [mut low, mut high] = self.ends();
        // v rises along a station.
        for _ in 0..44 {
            let middle = 0.5 * (low + high);
            match self.parameters(hull, middle) {
                Some(at) if at[1] < v => low = middle,
                Some(_) => high = middle,
                None => break,
            }
        }
        0.5 * (low + high)
    }

    /// The points of bands between `edges`, each of so many steps; both sides of inner edges are looked at.
    fn points(&self, hull: &Hull, edges: &[f64], lines: &[f64], steps: &[usize]) -> Vec<MapPoint> {
        let (low, high) = hull.surface().v().domain();
        let mut points = Vec::new();
        for (band, &count) in steps.iter().enumerate() {
            let (from, to) = (edges[band], edges[band + 1]);
            for k in 0..=count {
                let girth = from + (to - from) * k as f64 / count as f64;
                let found = self.parameters(hull, girth).map(|[u, v]| {
                    let beside = BESIDE * (high - low);
                    let above = band.checked_sub(1).map_or(low, |below| lines[below] + beside);
                    let below = lines.get(band).map_or(high, |line| line - beside);
                    // Bands that a station does not reach have no height.
                    [u, if above < below && to > from { v.clamp(above, below) } else { v }]
                });
                let nothing = MapPoint { at: [self.x, 0.0, 0.0], normal: None, girth, curvature: None };
                points.push(found.map_or(nothing, |at| point(hull, at, girth)));
            }
        }
        points
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
        Self { rows, points }
    }

    /// The map over stations, aft to forward, about `rows` points each; girths start at the centreplane, a flat of bottom counts. Stations without a curve on the
    /// side have points without normal and curvature.
    #[must_use]
    pub fn at_stations(hull: &Hull, columns: usize, rows: usize) -> Self {
        let (columns, rows) = (columns.max(2), rows.max(2));
        let xs = hull.surface().points().iter().map(|p| p[0]);
        let (low, high) = xs.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let inside = INSIDE * (high - low);
        let lines = breaks(hull);
        let stations: Vec<(Girth, Vec<f64>)> = (0..columns)
            .map(|i| {
                let x = low + inside + (high - low - 2.0 * inside) * i as f64 / (columns - 1) as f64;
                let girth = Girth::new(hull, x);
                let [from, to] = girth.ends();
                let mut edges = vec![from];
                edges.extend(lines.iter().map(|&v| girth.crossing(hull, v)));
                edges.push(to);
                (girth, edges)
            })
            .collect();
        // As many steps as the widest part of each band asks for.
        let wide = |band: usize| stations.iter().map(|(_, edges)| edges[band + 1] - edges[band]).fold(0.0, f64::max);
        let widths: Vec<f64> = (0..=lines.len()).map(wide).collect();
        let whole = widths.iter().sum::<f64>().max(f64::MIN_POSITIVE);
        let share = |width: &f64| ((rows - 1) as f64 * width / whole).round() as usize;
        let steps: Vec<usize> = match lines.len() {
            0 => vec![rows - 1],
            _ => widths.iter().map(|width| share(width).max(LEAST_STEPS)).collect(),
        };
        let points = stations.iter().flat_map(|(girth, edges)| girth.points(hull, edges, &lines, &steps)).collect();
        Self { rows: steps.iter().map(|count| count + 1).sum(), points }
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

    /// The least number that the part `share` of the surface does not pass with the size of a curvature (0 Gaussian, 1 mean); a point
    /// stands for the girth between the middles of its steps. 0 on a flat hull.
    #[must_use]
    pub fn size(&self, which: usize, share: f64) -> f64 {
        let weighted = |(k, point): (usize, &MapPoint)| {
            let (first, last) = (k / self.rows * self.rows, (k / self.rows + 1) * self.rows - 1);
            let girth = |k: usize| self.points[k.clamp(first, last)].girth;
            let wide = girth(k + 1) - girth(k.saturating_sub(1));
            Some((point.curvature?[which].abs(), wide))
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
