//! The map of the side over stations.
//!
//! Rows follow the lines v = constant of the surface, at about equal steps of the mean girth, so that what runs along
//! such a line (a bilge, a chine, the edge of a flat) runs along a row. Knot lines across which curvature may jump are
//! two rows each, or two columns where x is constant along them: one for each side. Girths are measured along chords
//! and start at the centreplane, so that a flat of bottom counts.

use super::map::{KnotLine, MapBreak, MapPoint, SurfaceMap, distance, point};
use crate::hull::Hull;

/// How far the first and the last station stand inside the ends, in lengths of the hull.
const INSIDE: f64 = 1e-4;
/// How far beside a knot line its two sides are looked at, in the range of the parameter.
const BESIDE: f64 = 1e-7;
/// How far a knot line may be from a station and still be one, in lengths of the hull.
const UPRIGHT: f64 = 1e-7;
/// Lines u = constant and steps of v over which the mean girth is taken.
const MEAN: [usize; 2] = [9, 400];
/// Most knot lines in one direction that are two rows or two columns each: a surface with more breaks everywhere a
/// little.
const MOST: usize = 30;
/// Halvings of an interval of v in which a station leaves the surface.
const HALVINGS: usize = 30;

/// A column of the map.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Column {
    /// A line of the surface that is a station, by its u.
    Line(f64),
    /// A station by its x, wherever it runs on the surface.
    Station(f64),
}

/// Values from `edges[0]` to the last edge in about `count` equal steps, with both sides of the edges between.
fn banded(edges: &[f64], count: usize) -> (Vec<f64>, Vec<usize>) {
    let whole = edges[edges.len() - 1] - edges[0];
    let (mut values, mut firsts) = (Vec::new(), Vec::new());
    for (band, pair) in edges.windows(2).enumerate() {
        let [from, to] = [pair[0], pair[1]];
        let steps = (((count - 1) as f64 * (to - from) / whole).round() as usize).max(1);
        if band > 0 {
            firsts.push(values.len() - 1);
        }
        values.extend((0..=steps).map(|k| from + (to - from) * k as f64 / steps as f64));
    }
    (values, firsts)
}

/// The mean girth up to every v of a table over equal steps of v \[m\], rising.
fn mean_girths(hull: &Hull) -> Vec<[f64; 2]> {
    let surface = hull.surface();
    let ((u0, u1), (v0, v1)) = (surface.u().domain(), surface.v().domain());
    let us: Vec<f64> = (0..MEAN[0]).map(|k| u0 + (u1 - u0) * (k as f64 + 0.5) / MEAN[0] as f64).collect();
    let at = |v: f64| us.iter().map(|&u| surface.eval(u, v)).collect::<Vec<_>>();
    let step = (v1 - v0) / MEAN[1] as f64;
    let (mut table, mut last, mut sum) = (vec![[v0, 0.0]], at(v0), 0.0);
    for k in 1..=MEAN[1] {
        let v = v0 + step * k as f64;
        let next = at(v);
        sum += last.iter().zip(&next).map(|(a, b)| distance(*a, *b)).sum::<f64>() / MEAN[0] as f64;
        // Steps without girth keep their order.
        sum += 1e-9 * step;
        table.push([v, sum]);
        last = next;
    }
    table
}

/// Reads a rising table, from column `from` to column `to`.
fn read(table: &[[f64; 2]], from: usize, to: usize, value: f64) -> f64 {
    let i = table.partition_point(|row| row[from] < value).clamp(1, table.len() - 1);
    let [a, b] = [table[i - 1], table[i]];
    let t = ((value - a[from]) / (b[from] - a[from])).clamp(0.0, 1.0);
    a[to] + t * (b[to] - a[to])
}

/// The rows by v, and those pairs of them that are the sides of a knot line.
fn rows(hull: &Hull, count: usize) -> (Vec<f64>, Vec<MapBreak>, usize) {
    let knots = hull.surface().v();
    let (v0, v1) = knots.domain();
    let table = mean_girths(hull);
    let (breaks, more) = MapBreak::of(knots, MOST);
    let mut edges = vec![0.0];
    edges.extend(breaks.iter().map(|(v, _)| read(&table, 0, 1, *v)));
    edges.push(table[MEAN[1]][1]);
    let (girths, firsts) = banded(&edges, count);
    let mut values: Vec<f64> = girths.iter().map(|&girth| read(&table, 1, 0, girth)).collect();
    (values[0], values[girths.len() - 1]) = (v0, v1);
    let mut found = Vec::new();
    for (&first, &(v, line)) in firsts.iter().zip(&breaks) {
        (values[first], values[first + 1]) = (v - BESIDE * (v1 - v0), v + BESIDE * (v1 - v0));
        found.push(MapBreak { line, columns: false, first });
    }
    (values, found, more)
}

/// The inner knots in u at which curvature may jump and that are stations, with their x \[m\].
fn upright_breaks(hull: &Hull, length: f64) -> (Vec<(f64, f64, KnotLine)>, usize) {
    let surface = hull.surface();
    let (v0, v1) = surface.v().domain();
    let station = |&(u, line): &(f64, KnotLine)| {
        let xs = [0.0, 0.3, 0.7, 1.0].map(|part| surface.eval(u, v0 + part * (v1 - v0))[0]);
        let same = xs.iter().all(|x| (x - xs[0]).abs() <= UPRIGHT * length);
        same.then_some((u, xs[0], line))
    };
    let (breaks, more) = MapBreak::of(surface.u(), MOST);
    (breaks.iter().filter_map(station).collect(), more)
}

/// The columns from aft, and those pairs of them that are the sides of a knot line.
fn columns(hull: &Hull, count: usize) -> (Vec<Column>, Vec<MapBreak>, usize) {
    let surface = hull.surface();
    let (u0, u1) = surface.u().domain();
    let xs = surface.points().iter().map(|p| p[0]);
    let (low, high) = xs.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    let inside = INSIDE * (high - low);
    let (breaks, more) = upright_breaks(hull, high - low);
    let breaks: Vec<_> =
        breaks.into_iter().filter(|(_, x, _)| *x > low + 2.0 * inside && *x < high - 2.0 * inside).collect();
    let mut edges = vec![low + inside];
    edges.extend(breaks.iter().map(|(_, x, _)| *x));
    edges.push(high - inside);
    let (xs, firsts) = banded(&edges, count);
    let mut list: Vec<Column> = xs.into_iter().map(Column::Station).collect();
    let mut found = Vec::new();
    for (&first, &(u, _, line)) in firsts.iter().zip(&breaks) {
        let beside = BESIDE * (u1 - u0);
        (list[first], list[first + 1]) = (Column::Line(u - beside), Column::Line(u + beside));
        found.push(MapBreak { line, columns: true, first });
    }
    (list, found, more)
}

/// Parameters and the point there.
type Place = ([f64; 2], [f64; 3]);

/// A station on the surface.
struct Track<'a> {
    hull: &'a Hull,
    column: Column,
    /// Height of the deck at side.
    deck: f64,
}

impl Track<'_> {
    /// The parameters at `v` with the point; none where the station does not run over the side.
    fn at(&self, v: f64) -> Option<Place> {
        let u = match self.column {
            Column::Line(u) => u,
            Column::Station(x) => self.hull.length_parameter(x, v)?,
        };
        let at = self.hull.surface().eval(u, v);
        (at[2] <= self.deck).then_some(([u, v], at))
    }

    /// The v nearest to `outside` at which it still runs over the side; it does at `inside`.
    fn end(&self, mut inside: f64, mut outside: f64) -> f64 {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (inside + outside);
            if self.at(middle).is_some() { inside = middle } else { outside = middle }
        }
        inside
    }

    /// The places of the rows with their v: what lies beyond an end of the station is taken at that end; none between
    /// two pieces of it.
    fn places(&self, rows: &[f64]) -> Vec<Option<(f64, Place)>> {
        let on: Vec<_> = rows.iter().map(|&v| self.at(v)).collect();
        let (Some(first), Some(last)) = (on.iter().position(Option::is_some), on.iter().rposition(Option::is_some))
        else {
            return vec![None; rows.len()];
        };
        let edge = |from: usize, to: usize| Some(self.end(rows[from], rows[to]));
        let (low, high) = (first.checked_sub(1).map(|k| self.end(rows[first], rows[k])), rows.get(last + 1));
        let high = high.map(|&v| self.end(rows[last], v));
        let between = |k: usize| match k {
            k if on[k - 1].is_some() => edge(k - 1, k),
            k if on[k + 1].is_some() => edge(k + 1, k),
            _ => None,
        };
        let (low_place, high_place) = (low.and_then(|v| self.at(v)), high.and_then(|v| self.at(v)));
        let row = |k: usize| match on[k] {
            Some(place) => Some((rows[k], place)),
            None if k < first => low.zip(low_place),
            None if k > last => high.zip(high_place),
            None => between(k).and_then(|v| Some((v, self.at(v)?))),
        };
        (0..rows.len()).map(row).collect()
    }

    /// The points of the rows with their girths.
    fn points(&self, rows: &[f64]) -> Vec<MapPoint> {
        let mut points: Vec<MapPoint> = Vec::with_capacity(rows.len());
        let mut last: Option<(f64, [f64; 3])> = None;
        let mut girth = 0.0;
        for place in self.places(rows) {
            let Some((v, (parameters, at))) = place else {
                let at = last.map_or([0.0; 3], |(_, at)| at);
                points.push(MapPoint { at, normal: None, girth, curvature: None });
                continue;
            };
            girth += match last {
                None => at[1].max(0.0),
                Some((before, from)) => match self.at(0.5 * (before + v)).filter(|_| v > before) {
                    Some((_, middle)) => distance(from, middle) + distance(middle, at),
                    None => distance(from, at),
                },
            };
            points.push(point(self.hull, parameters, girth));
            last = Some((v, at));
        }
        points
    }
}

impl SurfaceMap {
    /// The map over about `columns` stations, aft to forward, with about `rows` points each. Stations without a curve
    /// on the side have points without normal and curvature.
    #[must_use]
    pub fn at_stations(hull: &Hull, columns: usize, rows: usize) -> Self {
        let (rows, mut breaks, above) = self::rows(hull, rows.max(2));
        let (columns, upright, along) = self::columns(hull, columns.max(2));
        breaks.extend(upright);
        let station = |&column: &Column| {
            let x = match column {
                Column::Line(u) => hull.surface().eval(u, rows[0])[0],
                Column::Station(x) => x,
            };
            let track = Track { hull, column, deck: hull.deck_height(x) + 1e-9 * hull.particulars().depth };
            let mut points = track.points(&rows);
            points.iter_mut().for_each(|point| point.at[0] = if point.normal.is_some() { point.at[0] } else { x });
            points
        };
        let points = columns.iter().flat_map(station).collect();
        Self { rows: rows.len(), points, breaks, more_breaks: above + along }
    }
}
