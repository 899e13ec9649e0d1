//! Section areas and the sectional-area curve.
//!
//! The area of the section at X is 2 int y(u(X, v), v) (dz/dv) dv, where u(X, v) solves x(u, v) = X and dz/dv, taken
//! along the station, is J / x_u: z_v on level and on upright hulls. The integral is cut in v at the knots, at every
//! point where the station crosses a knot line in u, and where it leaves the hull over the stern or the stem profile:
//! these points are roots of x(u_k, v) = X, of which all are found, profiles that turn back included, by subdividing
//! Bernstein polynomials with Descartes' rule of signs (Lane & Riesenfeld 1981). In between the integrand is analytic,
//! and a polynomial where x does not depend on v; Gauss-Legendre rules are refined until the row over the net is
//! settled, so that rows and areas are exact to rounding. Next to a profile the variable is changed to v = a + (b - a)
//! t^2 (3 - 2t), which takes out the square root that a round stem or stern brings.

use super::form::Hull;
use super::immersion::Immersion;
use crate::numeric::gauss_legendre;
use crate::spline::{KnotVector, MAX_DEGREE};

/// Nodes of the rule that is refined where x depends on v.
const NODES: usize = 7;

/// Halvings of a piece at most.
const HALVINGS: usize = 12;

/// Change of a row by halving, relative to the height of the section, at which a piece is settled. The halved rule that
/// is kept is better than the change by a factor of about 2^14.
const SETTLED: f64 = 1e-11;

/// Areas of the immersed sections along the hull at one draught.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionalAreaCurve {
    /// Draught above the base line \[m\].
    pub draught: f64,
    /// Positions forward of AP \[m\], rising.
    pub stations: Vec<f64>,
    /// Areas, both sides [m^2].
    pub areas: Vec<f64>,
}

impl SectionalAreaCurve {
    /// Areas at `stations` below `draught`, exact to rounding; 0 beyond the hull.
    #[must_use]
    pub fn new(hull: &Hull, draught: f64, stations: &[f64]) -> Self {
        let areas = Self::areas(hull, &[draught], stations).into_iter().flatten().collect();
        Self { draught, stations: stations.to_vec(), areas }
    }

    /// Areas at `stations` below each of `draughts` [m^2], a row a station; each part of a station is integrated once
    /// for all draughts.
    #[must_use]
    pub fn areas(hull: &Hull, draughts: &[f64], stations: &[f64]) -> Vec<Vec<f64>> {
        let (surface, lines) = (hull.surface(), KnotLines::new(hull));
        let columns = surface.shape()[1];
        let immersions: Vec<Option<Immersion>> =
            draughts.iter().map(|&draught| Immersion::new(hull, draught)).collect();
        let row = |&station: &f64| {
            let given = immersions.iter().enumerate().filter_map(|(k, immersion)| Some((k, immersion.as_ref()?)));
            let mut cuts: Vec<(usize, Cut)> = given.map(|(k, immersion)| (k, Cut::new(immersion, station))).collect();
            cuts.sort_by(|a, b| a.1.end.total_cmp(&b.1.end));
            let (order, cuts): (Vec<usize>, Vec<Cut>) = cuts.into_iter().unzip();
            let mut parts = vec![0.0; cuts.len()];
            pieces(hull, &lines, station, &cuts, |cut, i, j, weights| {
                let points = &surface.points()[i * columns + j..];
                parts[cut] += weights.iter().zip(points).map(|(weight, point)| weight * point[1]).sum::<f64>();
            });
            let (mut areas, mut below) = (vec![0.0; immersions.len()], 0.0);
            for (k, part) in order.into_iter().zip(parts) {
                below += part;
                areas[k] = below;
            }
            areas
        };
        stations.iter().map(row).collect()
    }

    /// Ends \[m\] of the parallel middle body: the stretch around the largest section on which areas stay within the part
    /// `tolerance` of the largest. None where that is no flat, but the rounded top that every curve has: a parabola is
    /// within a sixteenth of a tolerance on a quarter of the length, a fourth power on half of it.
    ///
    /// ```
    /// use loftsman::geometry::SectionalAreaCurve;
    /// let stations: Vec<f64> = (0..=100).map(f64::from).collect();
    /// let of = |area: fn(f64) -> f64| {
    ///     let areas = stations.iter().map(|x| area(*x)).collect();
    ///     SectionalAreaCurve { draught: 1.0, stations: stations.clone(), areas }.parallel_middle_body(5e-4)
    /// };
    /// assert_eq!(of(|x| 1.0 - ((x - 50.0) / 50.0).powi(2)), None);
    /// let [aft, fore] = of(|x| 1.0 - ((30.0 - x) / 30.0).max((x - 60.0) / 40.0).max(0.0).powi(2)).ok_or("none")?;
    /// assert!((aft - 29.3).abs() < 0.3 && (fore - 60.9).abs() < 0.3);
    /// # Ok::<(), &str>(())
    /// ```
    #[must_use]
    pub fn parallel_middle_body(&self, tolerance: f64) -> Option<[f64; 2]> {
        let flat = self.near_largest(tolerance)?;
        let wide = self.near_largest(WIDER * tolerance)?;
        let length = |[aft, fore]: [f64; 2]| fore - aft;
        let whole = self.stations.last()? - self.stations.first()?;
        (length(flat) >= SHORTEST * whole && length(flat) >= FLAT * length(wide)).then_some(flat)
    }

    /// Where the areas around the largest pass the part 1 - `share` of it \[m\], linear between stations; the first and
    /// the last station where they do not.
    fn near_largest(&self, share: f64) -> Option<[f64; 2]> {
        let points: Vec<[f64; 2]> = self.stations.iter().zip(&self.areas).map(|(x, area)| [*x, *area]).collect();
        let top = (0..points.len()).max_by(|a, b| points[*a][1].total_cmp(&points[*b][1]))?;
        let level = (1.0 - share) * points[top][1];
        let passes = |pair: [[f64; 2]; 2]| {
            let [[x, above], [far, below]] = pair;
            (below < level).then(|| x + (far - x) * (above - level) / (above - below))
        };
        let aft = (1..=top).rev().find_map(|k| passes([points[k], points[k - 1]]));
        let fore = (top..points.len() - 1).find_map(|k| passes([points[k], points[k + 1]]));
        (level > 0.0).then(|| [aft.unwrap_or(points[0][0]), fore.unwrap_or(points[points.len() - 1][0])])
    }
}

/// A parallel middle body is as long as this part of the stretch within so many times the tolerance.
const FLAT: f64 = 0.55;
const WIDER: f64 = 16.0;
/// Shortest parallel middle body, as a part of the curve.
const SHORTEST: f64 = 0.02;

/// Where the section ends at a draught.
#[derive(Debug, Clone, Copy)]
struct Cut {
    /// Its parameter v.
    end: f64,
    /// The draught \[m\].
    draught: f64,
}

impl Cut {
    fn new(immersion: &Immersion<'_>, station: f64) -> Self {
        Self { end: immersion.section_end(station), draught: immersion.draught() }
    }
}

/// Weights of one piece: rows span_u - p ..= span_u, columns span_v - q ..= span_v; or coefficients of basis functions,
/// power by power.
type Block = [[f64; MAX_DEGREE + 1]; MAX_DEGREE + 1];

/// One station within one cell of the knots.
struct Cell<'a> {
    hull: &'a Hull,
    station: f64,
    span_u: usize,
    span_v: usize,
    /// Whether x depends on v within the cell.
    slanting: bool,
    /// Height of the section, which the weights of the row sum up to (twice, for both sides) \[m\].
    height: f64,
    /// Whether the cell is next to the stern or the stem profile and x depends on v.
    at_profile: bool,
    /// Middle of the span in u.
    middle: f64,
    /// Coefficients of the powers of u - middle, from the lowest, of the basis functions in u.
    powers: Block,
}

impl Cell<'_> {
    /// Basis functions in u at the point of the station on the line with the basis functions `across` in v, searched
    /// from `start`, which is moved there.
    fn along(&self, across: &[f64; MAX_DEGREE + 1], start: &mut f64) -> [f64; MAX_DEGREE + 1] {
        let surface = self.hull.surface();
        let (knots, p, q) = (surface.u(), surface.u().degree(), surface.v().degree());
        let columns = surface.shape()[1];
        // x - X along the line as a polynomial in u less the middle of the span.
        let mut x = [0.0; MAX_DEGREE + 1];
        for i in 0..=p {
            let row = &surface.points()[(self.span_u - p + i) * columns + self.span_v - q..];
            let control: f64 = across[..=q].iter().zip(row).map(|(b, point)| b * point[0]).sum();
            for (x, power) in x.iter_mut().zip(&self.powers).take(p + 1) {
                *x += power[i] * control;
            }
        }
        x[0] -= self.station;
        let (mut low, mut high) = (knots.knots()[self.span_u], knots.knots()[self.span_u + 1]);
        let resolution = 2.0 * f64::EPSILON * low.abs().max(high.abs());
        let mut u = start.clamp(low, high);
        for _ in 0..100 {
            let t = u - self.middle;
            let (error, slope) =
                x[..=p].iter().rev().fold((0.0, 0.0), |(value, slope), c| (value * t + c, slope * t + value));
            if error > 0.0 {
                high = u;
            } else {
                low = u;
            }
            let newton = u - error / slope;
            let next = if newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
            let step = (next - u).abs();
            u = next;
            if step <= resolution || error == 0.0 {
                break;
            }
        }
        *start = u;
        knots.basis(self.span_u, u)
    }

    /// dz/dv along the station at (u, v).
    fn rise(&self, u: f64, v: f64) -> f64 {
        let at = self.hull.surface().tangents(u, v);
        let lean = at.dv[0] * at.du[2];
        if self.slanting && lean.abs() > 0.0 && at.du[0] > 0.0 { at.dv[2] - lean / at.du[0] } else { at.dv[2] }
    }

    /// The weights for v in [from, to] of a rule of `count` nodes, in t of the changed variable where a profile is near.
    fn rule(&self, ends: (f64, f64), part: (f64, f64), count: usize, start: &mut f64) -> Block {
        let surface = self.hull.surface();
        let (p, q) = (surface.u().degree(), surface.v().degree());
        let heights = self.hull.heights().map(|heights| &heights.points()[self.span_v - q..=self.span_v]);
        let width = ends.1 - ends.0;
        let mut block: Block = Default::default();
        for (t, weight) in gauss_legendre(count).on(part.0, part.1) {
            let (place, stretch) =
                if self.at_profile { (t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t)) } else { (t, 1.0) };
            let v = ends.0 + width * place;
            let [across, slopes] = surface.v().basis_derivatives::<2>(self.span_v, v);
            let along = self.along(&across, start);
            let slope = match heights {
                Some(heights) => slopes.iter().zip(heights).map(|(b, h)| b * h[0]).sum::<f64>(),
                None => self.rise(*start, v),
            };
            let factor = 2.0 * weight * width * stretch * slope;
            for (row, a) in block[..=p].iter_mut().zip(&along) {
                for (target, b) in row[..=q].iter_mut().zip(&across) {
                    *target += factor * a * b;
                }
            }
        }
        block
    }

    /// Adds the weights of the piece to `block`, halving it until the rule is settled.
    fn settle(&self, ends: (f64, f64), part: (f64, f64), rough: &Block, depth: usize, start: f64, block: &mut Block) {
        let middle = 0.5 * (part.0 + part.1);
        let mut at = start;
        let left = self.rule(ends, (part.0, middle), NODES, &mut at);
        let between = at;
        let right = self.rule(ends, (middle, part.1), NODES, &mut at);
        let mut change = 0.0f64;
        for ((l, r), w) in left.iter().flatten().zip(right.iter().flatten()).zip(rough.iter().flatten()) {
            change = change.max((l + r - w).abs());
        }
        if change <= SETTLED * self.height || depth >= HALVINGS {
            for ((target, l), r) in block.iter_mut().flatten().zip(left.iter().flatten()).zip(right.iter().flatten()) {
                *target += l + r;
            }
            return;
        }
        self.settle(ends, (part.0, middle), &left, depth + 1, start, block);
        self.settle(ends, (middle, part.1), &right, depth + 1, between, block);
    }
}

/// Enumerates the weights of the area of the section at `station` below `draught`: `sink(i, j, w)` adds w_k to the
/// weight of the point (i, j + k).
pub(super) fn section_weights(hull: &Hull, station: f64, draught: f64, sink: &mut dyn FnMut(usize, usize, &[f64])) {
    let Some(immersion) = Immersion::new(hull, draught) else { return };
    let cut = Cut::new(&immersion, station);
    pieces(hull, &KnotLines::new(hull), station, &[cut], |_, i, j, weights| sink(i, j, weights));
}

/// The same for several draughts, whose cuts rise: `sink` gets the number of the lowest cut above each part of the
/// section.
fn pieces(
    hull: &Hull,
    lines: &KnotLines,
    station: f64,
    cuts: &[Cut],
    mut sink: impl FnMut(usize, usize, usize, &[f64]),
) {
    let Some(end) = cuts.last().map(|cut| cut.end).filter(|_| station.is_finite()) else { return };
    let surface = hull.surface();
    let (p, q) = (surface.u().degree(), surface.v().degree());
    let mut inside: Vec<f64> = lines.crossings(hull, station, end).iter().map(|crossing| crossing.v).collect();
    inside.extend(cuts.iter().map(|cut| cut.end));
    inside.sort_by(f64::total_cmp);
    for span_v in surface.v().spans() {
        let (from, to) = (surface.v().knots()[span_v], surface.v().knots()[span_v + 1].min(end));
        if to <= from {
            break;
        }
        let mut a = from;
        for b in inside.iter().copied().filter(|&v| v > from && v < to).chain([to]) {
            if b - a <= 4.0 * f64::EPSILON * (to - from) && b < to {
                continue;
            }
            let ends = (a, b);
            a = b;
            let middle = 0.5 * (ends.0 + ends.1);
            let Some(u) = hull.length_parameter(station, middle) else { continue };
            let span_u = surface.u().find_span(u);
            let slanting = is_slanting(hull, span_u, span_v);
            let outermost = span_u == p || span_u + 1 == surface.u().basis_count();
            let above = cuts.partition_point(|cut| cut.end < middle);
            let height = cuts[above].draught - hull.bottom();
            let (middle, powers) = power_basis(surface.u(), span_u);
            let at_profile = slanting && outermost;
            let cell = Cell { hull, station, span_u, span_v, slanting, height, at_profile, middle, powers };
            let mut start = u;
            let mut block: Block = Default::default();
            if cell.slanting {
                let rough = cell.rule(ends, (0.0, 1.0), NODES, &mut start);
                cell.settle(ends, (0.0, 1.0), &rough, 0, u, &mut block);
            } else {
                block = cell.rule(ends, (0.0, 1.0), q, &mut start);
            }
            for (i, row) in block.iter().enumerate().take(p + 1) {
                sink(above, span_u - p + i, span_v - q, &row[..=q]);
            }
        }
    }
}

/// The middle of a span, and the coefficients of the powers of t less it, from the lowest, of the basis functions that
/// do not vanish there.
fn power_basis(knots: &KnotVector, span: usize) -> (f64, Block) {
    let middle = 0.5 * (knots.knots()[span] + knots.knots()[span + 1]);
    let mut powers = knots.basis_derivatives::<{ MAX_DEGREE + 1 }>(span, middle);
    let mut factorial = 1.0;
    for (k, row) in powers.iter_mut().enumerate().skip(1) {
        factorial *= k as f64;
        row.iter_mut().for_each(|value| *value /= factorial);
    }
    (middle, powers)
}

/// Whether x depends on v within a cell of the knots.
fn is_slanting(hull: &Hull, span_u: usize, span_v: usize) -> bool {
    if hull.is_upright() && !hull.is_level() {
        return false;
    }
    let surface = hull.surface();
    let (p, q) = (surface.u().degree(), surface.v().degree());
    (span_u - p..=span_u).any(|i| {
        let x = surface.point(i, span_v)[0];
        (span_v - q..span_v).any(|j| (surface.point(i, j)[0] - x).abs() > 0.0)
    })
}

/// A point where a station crosses a knot line in u.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Crossing {
    /// Its parameter.
    pub(crate) v: f64,
    /// The number of the knot line; the first is the stern profile, the last the stem profile.
    pub(crate) line: usize,
}

/// x on the knot lines in u, as splines in v.
#[derive(Debug, Clone)]
pub(crate) struct KnotLines {
    /// Control values, line by line.
    values: Vec<f64>,
    columns: usize,
    scale: f64,
}

impl KnotLines {
    pub(crate) fn new(hull: &Hull) -> Self {
        let surface = hull.surface();
        let (knots, p, columns) = (surface.u(), surface.u().degree(), surface.shape()[1]);
        let mut values = Vec::with_capacity(knots.spans().len() * columns + columns);
        for u in knots.breakpoints() {
            let span = knots.find_span(u);
            let basis = knots.basis(span, u);
            values.extend((0..columns).map(|j| {
                basis.iter().take(p + 1).enumerate().map(|(i, b)| b * surface.point(span - p + i, j)[0]).sum::<f64>()
            }));
        }
        let scale = surface.points().iter().map(|point| point[0].abs()).fold(0.0, f64::max);
        Self { values, columns, scale }
    }

    /// x on a line where the basis functions in v from the function `first` on are `across`.
    pub(crate) fn x(&self, line: usize, first: usize, across: &[f64]) -> f64 {
        self.values[line * self.columns + first..].iter().zip(across).map(|(x, b)| x * b).sum()
    }

    /// Every v below `end` at which a knot line passes `station`, in increasing order; lines on which x is the station
    /// throughout a span have none there.
    pub(crate) fn crossings(&self, hull: &Hull, station: f64, end: f64) -> Vec<Crossing> {
        let knots = hull.surface().v();
        let q = knots.degree();
        let zero = 4.0 * f64::EPSILON * self.scale.max(station.abs());
        let mut found = Vec::new();
        for (line, values) in self.values.chunks_exact(self.columns).enumerate() {
            let (aft, fore) = (station - zero, station + zero);
            if values.iter().all(|&x| x > fore) || values.iter().all(|&x| x < aft) {
                continue;
            }
            for span in knots.spans() {
                let (from, to) = (knots.knots()[span], knots.knots()[span + 1].min(end));
                if to <= from {
                    break;
                }
                let mut local = [0.0; MAX_DEGREE + 1];
                for (c, x) in local.iter_mut().zip(&values[span - q..=span]) {
                    *c = x - station;
                }
                let local = &local[..=q];
                if local.iter().all(|&c| c > zero) || local.iter().all(|&c| c < -zero) {
                    continue;
                }
                let mut polynomial = [0.0; MAX_DEGREE + 1];
                for (k, value) in polynomial.iter_mut().enumerate().take(q + 1) {
                    *value = blossom(knots.knots(), local, span, q, |r| if r < k { to } else { from });
                }
                roots(&polynomial[..=q], 0.0, 1.0, zero, 0, &mut |t| {
                    found.push(Crossing { v: from + t * (to - from), line });
                });
            }
        }
        found.sort_by(|a, b| a.v.total_cmp(&b.v));
        found
    }
}

/// The polar form of a spline of degree q on span `span`, at the arguments `argument(0)`, ..., `argument(q - 1)`, from
/// the control values span - q ..= span (Ramshaw 1989).
fn blossom(knots: &[f64], values: &[f64], span: usize, q: usize, argument: impl Fn(usize) -> f64) -> f64 {
    let mut d = [0.0; MAX_DEGREE + 1];
    d[..=q].copy_from_slice(values);
    for r in 1..=q {
        let t = argument(r - 1);
        for j in (r..=q).rev() {
            let i = span - q + j;
            let share = (t - knots[i]) / (knots[i + q - r + 1] - knots[i]);
            d[j] = (1.0 - share) * d[j - 1] + share * d[j];
        }
    }
    d[q]
}

/// Roots in [from, to] of the Bernstein polynomial with coefficients `c`, values below `zero` in size being taken as 0.
fn roots(c: &[f64], from: f64, to: f64, zero: f64, depth: usize, found: &mut impl FnMut(f64)) {
    let middle = 0.5 * (from + to);
    let mut signs = c.iter().filter(|value| value.abs() > zero).map(|&value| value > 0.0);
    let Some(mut sign) = signs.next() else {
        if depth > 0 {
            found(middle);
        }
        return;
    };
    let mut changes = 0;
    for next in signs {
        changes += usize::from(next != sign);
        sign = next;
    }
    if changes == 0 {
        return;
    }
    // A cluster that thirty halvings have not parted counts as one root.
    if depth >= if changes > 1 { 30 } else { 52 } {
        found(middle);
        return;
    }
    let n = c.len() - 1;
    let (mut left, mut right) = ([0.0; MAX_DEGREE + 1], [0.0; MAX_DEGREE + 1]);
    right[..=n].copy_from_slice(c);
    left[0] = c[0];
    for (r, last) in left.iter_mut().enumerate().take(n + 1).skip(1) {
        for j in 0..=n - r {
            right[j] = 0.5 * (right[j] + right[j + 1]);
        }
        *last = right[0];
    }
    roots(&left[..=n], from, middle, zero, depth + 1, found);
    if left[n].abs() <= zero {
        found(middle);
    }
    roots(&right[..=n], middle, to, zero, depth + 1, found);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_roots_of_a_polynomial_with_a_double_root() {
        // (t - 0.2)(t - 0.5)^2 (t - 0.9) in Bernstein form, from its power coefficients.
        let power = [0.045, -0.455, 1.53, -2.1, 1.0];
        let choose = |n: i32, k: i32| (0..k).map(|i| f64::from(n - i) / f64::from(i + 1)).product::<f64>();
        let c: Vec<f64> =
            (0..=4).map(|i| (0..=i).map(|k| choose(i, k) / choose(4, k) * power[k as usize]).sum()).collect();
        let mut found = Vec::new();
        roots(&c, 0.0, 1.0, 1e-16, 0, &mut |t| found.push(t));
        for root in [0.2, 0.9] {
            assert!(found.iter().any(|t| (t - root).abs() < 1e-13), "{root}: {found:?}");
        }
        assert!(found.iter().any(|t| (t - 0.5).abs() < 1e-6), "{found:?}");
        assert!(found.len() < 20, "{found:?}");
    }
}
