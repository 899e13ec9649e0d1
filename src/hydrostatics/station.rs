//! Passes along a station x = X: integrals over v of functions of the point (u(X, v), v) with x(u(X, v), v) = X, up to
//! any of many heights.
//!
//! The station is cut at the knots in v and where it crosses a knot line in u or leaves the hull over a profile; on the
//! pieces in between the integrands are analytic, and polynomials where x does not depend on v. u(X, v) is found by
//! Newton's method on the polynomial of the cell in u. Integrals up to one height are Gauss sums
//! ([`Stations::integral`]). For many heights each piece is expanded in Legendre polynomials, whose integrals up to any
//! height cost a few products ([`Stations::expansion`]): O(spans_v + heights) for a station. Pieces are halved until
//! the last coefficients have died away, so that both are exact to rounding (relative 1e-13). Next to a profile v = a +
//! (b - a) t^2 (3 - 2t) takes out the square root that a round stem or stern brings.

use super::expansion::{Expansion, Series, Transform};
use super::node::{Node, node_at};
use super::piece::{Piece, StationSpan};
use crate::hull::{Hull, KnotLines};
use crate::numeric::gauss_legendre;
use crate::spline::MAX_DEGREE;

/// Nodes at most on a piece.
const MOST: usize = 2 * MAX_DEGREE + 2;

/// Nodes of Gauss sums, whose error is about the square of the last coefficients, and of expansions, where x depends on
/// v.
const SUMMED: usize = 8;
const EXPANDED: usize = 12;

/// Size of the last coefficients, relative to the largest integrand of the piece, at which sums and expansions are
/// settled.
const SETTLED_SUM: f64 = 1e-7;
const SETTLED_EXPANSION: f64 = 1e-13;

/// Last coefficients that are rounding, relative to the largest half-breadth times the height of the hull.
const NEGLIGIBLE: f64 = 1e-14;

/// Halvings of a piece at most.
const HALVINGS: usize = 12;

/// x and y of a cell of the knots, as polynomials in the local parameter of u with coefficients that are splines in v.
struct Cell<const N: usize> {
    x: [[f64; MAX_DEGREE + 1]; N],
    y: [[f64; MAX_DEGREE + 1]; N],
    slanting: bool,
}

/// A point of a station.
#[derive(Debug, Clone, Copy)]
pub(super) struct StationPoint {
    pub(super) u: f64,
    pub(super) y: f64,
    /// dz/dv along the station.
    pub(super) rise: f64,
    /// dy/dx on the waterline times dz/dv along the station.
    pub(super) growth: f64,
}

impl StationPoint {
    const NONE: Self = Self { u: 0.0, y: 0.0, rise: 0.0, growth: 0.0 };

    /// What adds up over v to the area and to its growth along the hull, both sides.
    pub(super) fn areas(&self) -> [f64; 2] {
        [2.0 * self.rise * self.y, 2.0 * self.growth]
    }
}

/// What all stations of a hull share.
pub(super) struct Stations<'a, const N: usize> {
    pub(super) hull: &'a Hull,
    lines: KnotLines,
    spans_u: Vec<(f64, f64)>,
    spans_v: Vec<usize>,
    cells: Vec<Cell<N>>,
    /// z of the cells, as x and y; none on a level hull.
    heights: Vec<[[f64; MAX_DEGREE + 1]; N]>,
    /// Nodes on whole spans in v, for each of the counts.
    grids: Vec<(usize, Vec<Node<N>>)>,
    transforms: Vec<Transform>,
    /// Least and greatest x of the control points of the profiles with a breadth.
    flats: Vec<(f64, f64)>,
    /// Largest |x| of the net \[m\].
    scale: f64,
    /// Largest |y| of the net times the height of the hull [m^2].
    pub(super) size: f64,
}

/// Local parameter, y and dy/dx of the station at `x` on the line of a node, for a degree in u below P.
fn solve<const N: usize, const P: usize>(cell: &Cell<N>, x: f64, node: &Node<N>, start: f64) -> [f64; 3] {
    let line = |columns: &[[f64; MAX_DEGREE + 1]; N]| {
        let mut sum = [0.0; P];
        for (column, b) in columns.iter().zip(&node.value) {
            for (target, c) in sum.iter_mut().zip(column) {
                *target += b * c;
            }
        }
        sum
    };
    let horner = |c: &[f64; P], s: f64| {
        let (mut value, mut slope) = (c[P - 1], 0.0);
        for &c in c[..P - 1].iter().rev() {
            slope = slope * s + value;
            value = value * s + c;
        }
        (value, slope)
    };
    // Where x does not depend on v, any column will do.
    let mut lengths = if cell.slanting { line(&cell.x) } else { std::array::from_fn(|k| cell.x[0][k]) };
    lengths[0] -= x;
    let (mut low, mut high) = (-1.0, 1.0);
    let mut s = start.clamp(low, high);
    for _ in 0..80 {
        let (value, slope) = horner(&lengths, s);
        if value > 0.0 {
            high = s;
        } else {
            low = s;
        }
        let newton = s - value / slope;
        let good = newton >= low && newton <= high;
        let next = if good { newton } else { 0.5 * (low + high) };
        let step = (next - s).abs();
        s = next;
        // Newton's method squares the error.
        if (good && step <= 1e-9) || step <= 4.0 * f64::EPSILON {
            break;
        }
    }
    let along = horner(&lengths, s).1;
    let (y, rise) = horner(&line(&cell.y), s);
    [s, y, if along > 1e-300 { rise / along } else { 0.0 }]
}

/// Derivatives, along and up, of a polynomial of a cell at the local parameter `s` on the line of a node.
fn slopes<const N: usize>(columns: &[[f64; MAX_DEGREE + 1]; N], node: &Node<N>, s: f64) -> [f64; 2] {
    let (mut along, mut up) = (0.0, 0.0);
    for ((column, b), d) in columns.iter().zip(&node.value).zip(&node.slope) {
        let (mut value, mut slope) = (0.0, 0.0);
        for &c in column.iter().rev() {
            slope = slope * s + value;
            value = value * s + c;
        }
        along += b * slope;
        up += d * value;
    }
    [along, up]
}

impl<'a, const N: usize> Stations<'a, N> {
    pub(super) fn new(hull: &'a Hull) -> Self {
        let surface = hull.surface();
        let (knots, p, q) = (surface.u(), surface.u().degree(), N - 1);
        let spans_v = surface.v().spans();
        let mut cells = Vec::with_capacity(knots.spans().len() * spans_v.len());
        let mut heights = Vec::new();
        let mut spans_u = Vec::new();
        for span in knots.spans() {
            let (from, to) = (knots.knots()[span], knots.knots()[span + 1]);
            spans_u.push((from, to));
            // Taylor's coefficients at the middle, scaled by the half length.
            let mut powers = knots.basis_derivatives::<{ MAX_DEGREE + 1 }>(span, 0.5 * (from + to));
            let mut factor = 1.0;
            for (k, row) in powers.iter_mut().enumerate() {
                row.iter_mut().for_each(|value| *value *= factor);
                factor *= 0.5 * (to - from) / (k + 1) as f64;
            }
            for &span_v in &spans_v {
                let mut cell = Cell { x: [[0.0; MAX_DEGREE + 1]; N], y: [[0.0; MAX_DEGREE + 1]; N], slanting: false };
                let mut rises = [[0.0; MAX_DEGREE + 1]; N];
                for i in 0..=p {
                    for (j, rise) in rises.iter_mut().enumerate() {
                        let [x, y, z] = surface.point(span - p + i, span_v - q + j);
                        cell.slanting |= x.to_bits() != surface.point(span - p + i, span_v)[0].to_bits();
                        for (k, row) in powers.iter().enumerate().take(p + 1) {
                            cell.x[j][k] += row[i] * x;
                            cell.y[j][k] += row[i] * y;
                            rise[k] += row[i] * z;
                        }
                    }
                }
                if !hull.is_level() {
                    heights.push(rises);
                    cell.slanting &= !hull.is_upright();
                }
                cells.push(cell);
            }
        }
        let mut counts = vec![q, 2 * q, SUMMED, EXPANDED];
        counts.sort_unstable();
        counts.dedup();
        let grids = counts
            .iter()
            .map(|&count| {
                let mut nodes = Vec::with_capacity(count * spans_v.len());
                for &span in &spans_v {
                    crate::hydrostatics::node::nodes::<N>(hull, span, f64::INFINITY, count, &mut nodes);
                }
                (count, nodes)
            })
            .collect();
        let transforms = counts.iter().map(|&count| Transform::new(count)).collect();
        let [rows, columns] = surface.shape();
        let flats = [0, rows - 1]
            .into_iter()
            .map(|row| &surface.points()[row * columns..(row + 1) * columns])
            .filter(|points| points.iter().any(|point| point[1] > 0.0))
            .map(|points| {
                let x = points.iter().map(|point| point[0]);
                (x.clone().fold(f64::INFINITY, f64::min), x.fold(f64::NEG_INFINITY, f64::max))
            })
            .collect();
        let largest = |axis: usize| surface.points().iter().map(|point| point[axis].abs()).fold(0.0, f64::max);
        let (scale, size) = (largest(0), largest(1) * (hull.top() - hull.bottom()));
        Self {
            hull,
            lines: KnotLines::new(hull),
            spans_u,
            spans_v,
            cells,
            heights,
            grids,
            transforms,
            flats,
            scale,
            size,
        }
    }

    /// The pieces of the station at `x` below `end`.
    pub(super) fn pieces(&self, x: f64, end: f64) -> Vec<Piece> {
        let crossings = self.lines.crossings(self.hull, x, end);
        let knots = self.hull.surface().v();
        let mut pieces = Vec::with_capacity(self.spans_v.len() + crossings.len());
        for (across, &span) in self.spans_v.iter().enumerate() {
            let (low, knot) = (knots.knots()[span], knots.knots()[span + 1]);
            let high = knot.min(end);
            if high <= low {
                break;
            }
            let mut from = low;
            for to in crossings.iter().map(|c| c.v).filter(|&v| v > low && v < high).chain([high]) {
                if to - from <= 4.0 * f64::EPSILON * (high - low) && to < high {
                    continue;
                }
                let (place, start) = self.locate(x, across, 0.5 * (from + to));
                let (mut slanting, mut profile) = (false, false);
                if let StationSpan::Inside(k) = place {
                    slanting = self.cells[k * self.spans_v.len() + across].slanting;
                    profile = slanting && (k == 0 || k + 1 == self.spans_u.len());
                }
                let whole = from <= low && to >= knot;
                pieces.push(Piece { from, to, across, place, start, slanting, profile, whole });
                from = to;
            }
        }
        pieces
    }

    /// The span in u of the station at `v`, and the local parameter by linear interpolation.
    fn locate(&self, x: f64, across: usize, v: f64) -> (StationSpan, f64) {
        let span = self.spans_v[across];
        let basis = self.hull.surface().v().basis(span, v);
        let at = |line: usize| self.lines.x(line, span + 1 - N, &basis[..N]);
        let last = self.spans_u.len();
        let (stern, stem) = (at(0), at(last));
        let slack = 1e-12 * (stem - stern).abs().max(stern.abs()).max(stem.abs());
        if x < stern - slack {
            return (StationSpan::Aft, 0.0);
        }
        if x > stem + slack {
            return (StationSpan::Fore, 0.0);
        }
        let (mut low, mut high) = (0, last);
        let (mut below, mut above) = (stern, stem);
        while high - low > 1 {
            let middle = (low + high) / 2;
            let value = at(middle);
            if value <= x {
                (low, below) = (middle, value);
            } else {
                (high, above) = (middle, value);
            }
        }
        let share = if above > below { ((x - below) / (above - below)).clamp(0.0, 1.0) } else { 0.0 };
        (StationSpan::Inside(low), 2.0 * share - 1.0)
    }

    /// The point of the station at `x` on the line of a node, searched from the local parameter `start`, which is moved
    /// there.
    pub(super) fn point(&self, x: f64, piece: &Piece, node: &Node<N>, start: &mut f64) -> StationPoint {
        let StationSpan::Inside(k) = piece.place else { return StationPoint::NONE };
        let number = k * self.spans_v.len() + piece.across;
        let cell = &self.cells[number];
        let [s, y, slope] = match self.hull.surface().u().degree() {
            1 | 2 => solve::<N, 3>(cell, x, node, *start),
            3 => solve::<N, 4>(cell, x, node, *start),
            4 | 5 => solve::<N, 6>(cell, x, node, *start),
            _ => solve::<N, { MAX_DEGREE + 1 }>(cell, x, node, *start),
        };
        *start = s;
        let (from, to) = self.spans_u[k];
        let u = 0.5 * ((1.0 - s) * from + (1.0 + s) * to);
        let Some(heights) = self.heights.get(number) else {
            return StationPoint { u, y, rise: node.rise, growth: node.rise * slope };
        };
        let [x_along, x_up] = slopes(&cell.x, node, s);
        let [y_along, y_up] = slopes(&cell.y, node, s);
        let [z_along, z_up] = slopes(heights, node, s);
        if x_along <= 1e-300 {
            return StationPoint { u, y, rise: z_up, growth: 0.0 };
        }
        let lean = if cell.slanting { z_along * x_up / x_along } else { 0.0 };
        StationPoint { u, y, rise: z_up - lean, growth: (y_along * z_up - y_up * z_along) / x_along }
    }

    /// Integrand times dv/dt at the nodes of a part of a piece, and the largest of them.
    fn sample<const K: usize>(
        &self,
        piece: &Piece,
        part: (f64, f64),
        count: usize,
        integrand: &mut impl FnMut(&Piece, &Node<N>) -> [f64; K],
        values: &mut [[f64; K]; MOST],
    ) -> f64 {
        let width = piece.to - piece.from;
        let mut largest = 0.0f64;
        let whole = piece.whole && !piece.profile && part.1 - part.0 >= 1.0;
        let grid = if whole { self.grids.iter().find(|grid| grid.0 == count) } else { None };
        for (k, (t, _)) in gauss_legendre(count).on(part.0, part.1).enumerate() {
            let mut factor = width;
            let mut value = if let Some((_, nodes)) = grid {
                integrand(piece, &nodes[piece.across * count + k])
            } else {
                let mut place = t;
                if piece.profile {
                    (place, factor) = (t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t) * width);
                }
                let node = node_at::<N>(self.hull, self.spans_v[piece.across], piece.from + width * place, 0.0);
                integrand(piece, &node)
            };
            for value in &mut value {
                *value *= factor;
                largest = largest.max(value.abs());
            }
            values[k] = value;
        }
        largest
    }

    /// Whether the last two coefficients of the first integrand are at most `tolerance`.
    fn settled<const K: usize>(transform: &Transform, values: &[[f64; K]], tolerance: f64) -> bool {
        let size = |j: usize| transform.coefficient(j, values).iter().take(1).fold(0.0f64, |m, c| m.max(c.abs()));
        size(transform.count - 1).max(size(transform.count - 2)) <= tolerance
    }

    fn transform(&self, count: usize) -> &Transform {
        self.transforms.iter().find(|t| t.count == count).unwrap_or(&self.transforms[0])
    }

    /// The integral of `integrand` times dv over the pieces; it may not depend on the order of the pieces.
    pub(super) fn integral<const K: usize>(
        &self,
        pieces: &[Piece],
        mut integrand: impl FnMut(&Piece, &Node<N>) -> [f64; K],
    ) -> [f64; K] {
        let mut total = [0.0; K];
        let mut values = [[0.0; K]; MOST];
        let mut parts: Vec<((f64, f64), usize)> = Vec::new();
        for piece in pieces {
            parts.push(((0.0, 1.0), 0));
            while let Some((part, depth)) = parts.pop() {
                let count = if piece.slanting { SUMMED } else { N - 1 };
                let largest = self.sample(piece, part, count, &mut integrand, &mut values);
                let open = piece.slanting && depth < HALVINGS;
                let tolerance = (SETTLED_SUM * largest).max(NEGLIGIBLE * self.size);
                if open && !Self::settled(self.transform(count), &values[..count], tolerance) {
                    let middle = 0.5 * (part.0 + part.1);
                    parts.extend([((middle, part.1), depth + 1), ((part.0, middle), depth + 1)]);
                    continue;
                }
                for ((_, weight), value) in gauss_legendre(count).on(part.0, part.1).zip(&values) {
                    for (target, value) in total.iter_mut().zip(value) {
                        *target += weight * value;
                    }
                }
            }
        }
        total
    }

    /// The integrals of `integrand` times dv from the lowest line up to any height, in which what is below 1e-14 of
    /// `size` is neglected. `analytic`: the integrand is no polynomial where x does not depend on v either.
    pub(super) fn expansion<const K: usize>(
        &self,
        pieces: &[Piece],
        analytic: bool,
        size: f64,
        mut integrand: impl FnMut(&Piece, &Node<N>) -> [f64; K],
    ) -> Expansion<K> {
        let mut series = Vec::with_capacity(pieces.len());
        let mut total = [0.0; K];
        let mut values = [[0.0; K]; MOST];
        let mut parts: Vec<((f64, f64), usize)> = Vec::new();
        for piece in pieces {
            parts.push(((0.0, 1.0), 0));
            while let Some((part, depth)) = parts.pop() {
                let open = analytic || piece.slanting;
                let count = if open { EXPANDED } else { 2 * (N - 1) };
                let largest = self.sample(piece, part, count, &mut integrand, &mut values);
                let tolerance = (SETTLED_EXPANSION * largest).max(NEGLIGIBLE * size);
                let transform = self.transform(count);
                let settled = !open || depth >= HALVINGS || Self::settled(transform, &values[..count], tolerance);
                if !settled {
                    let middle = 0.5 * (part.0 + part.1);
                    parts.extend([((middle, part.1), depth + 1), ((part.0, middle), depth + 1)]);
                    continue;
                }
                let coefficients: Vec<[f64; K]> =
                    (0..count).map(|j| transform.coefficient(j, &values[..count])).collect();
                let below = total;
                for (target, c) in total.iter_mut().zip(&coefficients[0]) {
                    *target += (part.1 - part.0) * c;
                }
                series.push(Series { piece: *piece, part, coefficients, below });
            }
        }
        Expansion { series, total }
    }

    /// What the slope of the keel line, and of the upper edge where `end` is there, adds to dA/dx at `x`, both sides;
    /// nothing on level hulls.
    pub(super) fn edges(&self, x: f64, end: f64) -> f64 {
        let surface = self.hull.surface();
        let (low, high) = surface.v().domain();
        if self.heights.is_empty() || end <= low {
            return 0.0;
        }
        let at = |v: f64| {
            let Some(u) = self.hull.length_parameter(x, v) else { return 0.0 };
            let at = surface.tangents(u, v);
            if at.du[0] > 0.0 { 2.0 * at.point[1] * at.du[2] / at.du[0] } else { 0.0 }
        };
        (if end >= high { at(high) } else { 0.0 }) - at(low)
    }

    /// What the moving ends of the section at `x` add to dA/dx, both sides: height v of the end and 2 y z_v / |x_v|, with
    /// the sign of growth.
    pub(super) fn ends(&self, x: f64, end: f64) -> Vec<[f64; 2]> {
        let surface = self.hull.surface();
        let (knots, columns) = (surface.v(), surface.shape()[1]);
        let last = self.spans_u.len();
        let mut ends = Vec::new();
        if !self.flats.iter().any(|(low, high)| (low..=high).contains(&&x)) {
            return ends;
        }
        for crossing in self.lines.crossings(self.hull, x, end) {
            let (row, sign) = match crossing.line {
                0 => (0, 1.0),
                line if line == last => (surface.shape()[0] - 1, -1.0),
                _ => continue,
            };
            let span = knots.find_span(crossing.v);
            let node = node_at::<N>(self.hull, span, crossing.v, 0.0);
            let points = &surface.points()[row * columns + node.first..row * columns + node.first + N];
            let y: f64 = points.iter().zip(&node.value).map(|(point, b)| b * point[1]).sum();
            let rise = if self.heights.is_empty() {
                node.rise
            } else {
                points.iter().zip(&node.slope).map(|(point, b)| b * point[2]).sum::<f64>()
            };
            let rake: f64 = points.iter().zip(&node.slope).map(|(point, b)| b * point[0]).sum();
            if y > 0.0 {
                ends.push([crossing.v, 2.0 * sign * y * rise / rake.abs().max(1e-9 * self.scale)]);
            }
        }
        ends
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hull::{Functional, PrincipalParticulars};
    use crate::spline::{BsplineCurve, BsplineSurface, KnotVector};

    /// A hull with a raked transom, a bulging stem and lines that slant everywhere.
    fn hull() -> Hull {
        let (u, v) = (KnotVector::uniform(3, 6).unwrap(), KnotVector::uniform(3, 5).unwrap());
        let mut points = Vec::new();
        for &s in &u.greville() {
            for &t in &v.greville() {
                let (stern, stem) = (3.0 - 6.0 * t, 95.0 + 4.0 * (7.0 * t).sin() + 4.0 * t);
                let y = 8.0 * (1.0 - s * s) * (0.15 + s).min(1.0) * (0.3 + 0.7 * t);
                points.push([stern + (stem - stern) * s * (1.4 - 0.4 * s), y, 9.0 * t * (0.4 + 0.6 * t)]);
            }
        }
        let line = KnotVector::uniform(1, 1).unwrap();
        let deck = BsplineCurve::new(line, vec![[-5.0, 9.0], [110.0, 9.0]]).unwrap();
        let particulars = PrincipalParticulars {
            length_between_perpendiculars: 100.0,
            breadth: 16.0,
            draught: Some(5.0),
            depth: 9.0,
        };
        Hull::new("test", particulars, BsplineSurface::new(u, v, points).unwrap(), deck).unwrap()
    }

    /// Area and slope of the station at `x` up to `end`, from the expansion and from Gauss sums.
    fn both(stations: &Stations<4>, x: f64, end: f64) -> [[f64; 2]; 2] {
        let integrand = |start: &mut f64, piece: &Piece, node: &Node<4>| stations.point(x, piece, node, start).areas();
        let (mut first, mut second) = (0.0, 0.0);
        let pieces = stations.pieces(x, f64::INFINITY);
        let expansion =
            stations.expansion(&pieces, false, stations.size, |piece, node| integrand(&mut first, piece, node));
        let below = stations.pieces(x, end);
        let sum = stations.integral(&below, |piece, node| integrand(&mut second, piece, node));
        [expansion.up_to(end), sum]
    }

    #[test]
    fn expansions_sums_and_rows_agree_at_any_height() {
        let hull = hull();
        let stations = Stations::<4>::new(&hull);
        for x in [-1.5, 2.9, 20.0, 50.0, 77.7, 94.0, 97.5] {
            for draught in [0.3, 1.0, 2.2, 5.0, 8.9] {
                let end = hull.height_parameter(draught).unwrap();
                let [expanded, summed] = both(&stations, x, end);
                let area = Functional::SectionArea { x }.value(&hull, draught);
                assert!((summed[0] - area).abs() <= 1e-12 * area, "{x} {draught}: {summed:?} {area}");
                assert!((expanded[0] - area).abs() <= 1e-12 * (area + 1.0), "{x} {draught}: {expanded:?} {area}");
            }
        }
    }

    #[test]
    fn slopes_are_differences_of_areas() {
        let hull = hull();
        let stations = Stations::<4>::new(&hull);
        for x in [-1.5, 1.1, 20.0, 50.0, 77.7, 94.0, 97.5] {
            for draught in [1.0, 5.0, 8.9] {
                let end = hull.height_parameter(draught).unwrap();
                let ends: f64 = stations.ends(x, end).iter().map(|end| end[1]).sum();
                let step = 1e-4;
                let area = |x: f64| Functional::SectionArea { x }.value(&hull, draught);
                let difference = (area(x + step) - area(x - step)) / (2.0 * step);
                for [_, slope] in both(&stations, x, end) {
                    assert!(
                        (slope + ends - difference).abs() <= 1e-5 * (1.0 + difference.abs()),
                        "{x} {draught}: {slope} {ends} {difference}"
                    );
                }
            }
        }
    }
}
