//! Midship section, largest section and parallel middle body at each of many draughts.
//!
//! On the spans of u whose lines are vertical (x does not depend on v) the area of the section through u is itself a spline in
//! u, A(u) = 2 sum_i N_i(u) sum_j y_ij int M_j z_v dv, whose maximum is found exactly. Elsewhere areas are sampled from
//! half-breadths at the nodes in v and interpolated in each span of u; from the places so found parabolas through exact areas
//! ([`Functional::SectionArea`]) lead to the maximum. Its place is then known to about 1e-6 of the length of the span and the
//! area to rounding. Corners of the areas at a raked transom or flat bow are looked at by themselves.

use super::volume::{Node, count_up, nodes};
use crate::hull::{Functional, Hull, Immersion};
use crate::spline::MAX_DEGREE;

/// Sections equal to the largest one within this relative difference belong to the parallel middle body.
pub(super) const PARALLEL_TOLERANCE: f64 = 1e-6;

/// Shortest parallel middle body, as a part of L_PP.
pub(super) const PARALLEL_LENGTH: f64 = 0.01;

/// Two areas are equal when they differ by less than this, relative to the larger one.
const ROUNDING: f64 = 1e-13;

/// Relative error of interpolated areas that is allowed for in the choice of the places to be refined.
const INTERPOLATION: f64 = 1e-3;

/// Sections below one draught.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Sections {
    /// Area of the section at L_PP / 2 [m^2].
    pub(super) midship: f64,
    /// Largest section area [m^2].
    pub(super) largest: f64,
    /// Its place [m].
    pub(super) place: Option<f64>,
    /// Ends of the parallel middle body [m].
    pub(super) parallel: Option<[f64; 2]>,
}

/// Samples on one span of u: Chebyshev extremes, ends included.
struct Span {
    span: usize,
    ends: (f64, f64),
    vertical: bool,
    /// Parameters.
    u: Vec<f64>,
    /// Basis functions in u there.
    basis: Vec<[f64; MAX_DEGREE + 1]>,
    /// x there; on the line `reference` where the lines are not vertical.
    x: Vec<f64>,
}

/// What is the same for every draught.
struct Table<'a, const N: usize> {
    hull: &'a Hull,
    spans: Vec<Span>,
    /// Nodes in v, `count` a span of v.
    nodes: Vec<Node<N>>,
    count: usize,
    /// Half-breadths at the nodes, for every sample of the spans that are not vertical, in order.
    breadths: Vec<Vec<f64>>,
}

/// The sections below each immersion.
pub(super) fn sections(hull: &Hull, immersions: &[Option<Immersion>]) -> Vec<Sections> {
    match hull.surface().v().degree() {
        1 => sections_of::<2>(hull, immersions),
        2 => sections_of::<3>(hull, immersions),
        3 => sections_of::<4>(hull, immersions),
        4 => sections_of::<5>(hull, immersions),
        5 => sections_of::<6>(hull, immersions),
        6 => sections_of::<7>(hull, immersions),
        _ => sections_of::<{ MAX_DEGREE + 1 }>(hull, immersions),
    }
}

fn sections_of<const N: usize>(hull: &Hull, immersions: &[Option<Immersion>]) -> Vec<Sections> {
    let table = Table::<N>::new(hull);
    immersions.iter().map(|immersion| immersion.as_ref().map_or_else(Sections::default, |i| table.below(i))).collect()
}

impl<'a, const N: usize> Table<'a, N> {
    fn new(hull: &'a Hull) -> Self {
        let surface = hull.surface();
        let (knots, p, columns) = (surface.u(), surface.u().degree(), surface.shape()[1]);
        let reference = surface.curve_at_v(surface.v().domain().1);
        let straight: Vec<bool> = (0..surface.shape()[0])
            .map(|i| {
                let row = &surface.points()[i * columns..(i + 1) * columns];
                row.iter().all(|point| point[0].to_bits() == row[0][0].to_bits())
            })
            .collect();
        let samples = p.max(3);
        let spans: Vec<Span> = knots
            .spans()
            .into_iter()
            .map(|span| {
                let (from, to) = (knots.knots()[span], knots.knots()[span + 1]);
                let u: Vec<f64> = (0..=samples)
                    .map(|k| {
                        let place = 0.5 - 0.5 * (std::f64::consts::PI * k as f64 / samples as f64).cos();
                        if k == samples { to } else { from + (to - from) * place }
                    })
                    .collect();
                let basis: Vec<[f64; MAX_DEGREE + 1]> = u.iter().map(|&u| knots.basis(span, u)).collect();
                let points = &reference.points()[span - p..=span];
                let x = basis.iter().map(|b| b.iter().zip(points).map(|(b, c)| b * c[0]).sum()).collect();
                let vertical = straight[span - p..=span].iter().all(|&flag| flag);
                Span { span, ends: (from, to), vertical, u, basis, x }
            })
            .collect();
        let count = count_up(hull);
        let mut all = Vec::new();
        for span in surface.v().spans() {
            nodes::<N>(hull, span, f64::INFINITY, count, &mut all);
        }
        let mut table = Self { hull, spans, nodes: all, count, breadths: Vec::new() };
        let places: Vec<f64> =
            table.spans.iter().filter(|span| !span.vertical).flat_map(|span| span.x.iter().copied()).collect();
        table.breadths = vec![Vec::with_capacity(table.nodes.len()); places.len()];
        if !places.is_empty() {
            for node in &table.nodes {
                half_breadths(hull, node, &places, &mut table.breadths);
            }
        }
        table
    }

    /// Exact area of the section at `x` below `immersion`.
    fn area(&self, x: f64, immersion: &Immersion) -> f64 {
        Functional::SectionArea { x }.value(self.hull, immersion.draught())
    }

    fn below(&self, immersion: &Immersion) -> Sections {
        let surface = self.hull.surface();
        let (p, columns) = (surface.u().degree(), surface.shape()[1]);
        let midship = 0.5 * self.hull.particulars().length_between_perpendiculars;
        let deck = immersion.deck_immersed();
        // Weights of the control points in v and of the half-breadths at the nodes.
        let (across, at_nodes) = self.weights(immersion.waterline());
        // Areas of the vertical lines: control values of a spline in u.
        let line: Vec<f64> = surface
            .points()
            .chunks_exact(columns)
            .map(|row| row.iter().zip(&across).map(|(point, weight)| weight * point[1]).sum())
            .collect();
        let spline = |span: &Span, u: f64| -> [f64; 2] {
            let rows = surface.u().basis_derivatives::<2>(span.span, u);
            let points = &line[span.span - p..=span.span];
            rows.map(|row| row.iter().zip(points).map(|(b, c)| b * c).sum())
        };
        let mut breadths = self.breadths.iter();
        let samples: Vec<Vec<f64>> = self
            .spans
            .iter()
            .map(|span| {
                let points = &line[span.span - p..=span.span];
                let sampled = |index: usize| -> f64 {
                    if deck {
                        self.area(span.x[index], immersion)
                    } else {
                        span.basis[index].iter().zip(points).map(|(b, c)| b * c).sum()
                    }
                };
                if span.vertical {
                    return (0..span.u.len()).map(sampled).collect();
                }
                (0..span.u.len())
                    .map(|index| {
                        let heights = breadths.next();
                        if deck {
                            return self.area(span.x[index], immersion);
                        }
                        heights.map_or(0.0, |y| y.iter().zip(&at_nodes).map(|(y, weight)| weight * y).sum())
                    })
                    .collect()
            })
            .collect();
        let at_midship = self
            .spans
            .iter()
            .position(|span| span.vertical && span.x[0] <= midship && midship <= span.x[span.x.len() - 1])
            .filter(|_| !deck)
            .and_then(|k| Some(spline(&self.spans[k], self.hull.length_parameter(midship, immersion.waterline())?)[0]));
        let midship_area = at_midship.unwrap_or_else(|| self.area(midship, immersion));

        let highest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let top = samples.iter().map(|values| highest(values)).fold(0.0, f64::max);
        let (mut best, mut place) = (midship_area, midship);
        let mut candidates = Vec::new();
        for (k, values) in samples.iter().enumerate() {
            // The maximum lies in a span next to the highest sample; spans a hundredth lower are far from it.
            if top <= 0.0 || highest(values) < top * (1.0 - 1e-2) {
                continue;
            }
            let polynomial = Interpolant { u: &self.spans[k].u, values };
            let maxima = polynomial.maxima(self.spans[k].ends);
            candidates.extend(maxima.into_iter().map(|u| (polynomial.value(u), k, u)));
        }
        candidates.sort_by(|a, b| b.0.total_cmp(&a.0));
        let highest_value = candidates.first().map_or(0.0, |candidate| candidate.0);
        let mut taken: Vec<f64> = Vec::new();
        for &(value, k, u) in &candidates {
            let span = &self.spans[k];
            let (mut x, width) = (self.place(u), span.x[span.x.len() - 1] - span.x[0]);
            let exact = span.vertical && !deck;
            let near = taken.iter().any(|other| (other - x).abs() < 0.5 * width);
            if value < highest_value * (1.0 - if exact { ROUNDING } else { INTERPOLATION }) || near || taken.len() >= 3
            {
                continue;
            }
            let mut area = if exact { spline(span, u)[0] } else { self.area(x, immersion) };
            if !exact {
                self.climb(&mut x, &mut area, 0.05 * width, immersion);
            }
            taken.push(x);
            if area > best * (1.0 + ROUNDING) {
                (best, place) = (area, x);
            }
        }
        for x in self.corners(immersion) {
            let area = self.area(x, immersion);
            if area > best * (1.0 + ROUNDING) {
                (best, place) = (area, x);
            }
        }
        if best <= 0.0 {
            return Sections { midship: midship_area.max(0.0), ..Sections::default() };
        }
        let parallel = self.parallel(&samples, best, place);
        let place = parallel.map_or(place, |[aft, fore]| 0.5 * (aft + fore));
        Sections { midship: midship_area, largest: best, place: Some(place), parallel }
    }

    /// Moves (x, area) uphill to the vertex of parabolas through exact areas, first `step` and then a fiftieth of it apart.
    fn climb(&self, x: &mut f64, area: &mut f64, step: f64, immersion: &Immersion) {
        let mut step = step;
        let mut refined = 0;
        for _ in 0..16 {
            let (before, after) = (self.area(*x - step, immersion), self.area(*x + step, immersion));
            if before.max(after) > *area * (1.0 + ROUNDING) {
                (*x, *area) = if before > after { (*x - step, before) } else { (*x + step, after) };
                continue;
            }
            let bend = before - 2.0 * *area + after;
            if bend >= -ROUNDING * *area {
                return;
            }
            let vertex = *x + 0.5 * step * (before - after) / bend;
            let value = self.area(vertex, immersion);
            if value >= *area {
                (*x, *area) = (vertex, value);
            }
            refined += 1;
            if refined == 2 {
                return;
            }
            step *= 0.02;
        }
    }

    /// Places where the areas have a corner: ends of a raked transom or flat bow, at the lowest line and the waterline.
    fn corners(&self, immersion: &Immersion) -> Vec<f64> {
        let surface = self.hull.surface();
        let [rows, columns] = surface.shape();
        let mut corners = Vec::new();
        for (row, u) in [(0, surface.u().domain().0), (rows - 1, surface.u().domain().1)] {
            let points = &surface.points()[row * columns..(row + 1) * columns];
            let flat = points.iter().any(|point| point[1] > 0.0);
            let raked = points.iter().any(|point| point[0].to_bits() != points[0][0].to_bits());
            if flat && raked {
                corners.push(points[0][0]);
                corners.push(surface.eval(u, immersion.waterline())[0]);
            }
        }
        corners
    }

    /// x at `u`, on the reference line.
    fn place(&self, u: f64) -> f64 {
        let v = self.hull.surface().v().domain().1;
        self.hull.surface().eval(u, v)[0]
    }

    /// Extent around `place` of the sections that equal `best`.
    fn parallel(&self, samples: &[Vec<f64>], best: f64, place: f64) -> Option<[f64; 2]> {
        let enough = best * (1.0 - PARALLEL_TOLERANCE);
        let flat: Vec<(usize, usize)> =
            samples.iter().enumerate().flat_map(|(k, values)| (0..values.len()).map(move |index| (k, index))).collect();
        let x = |at: (usize, usize)| self.spans[at.0].x[at.1];
        let value = |at: (usize, usize)| samples[at.0][at.1];
        // The run of samples that contains the place.
        let after = flat.partition_point(|&at| x(at) < place).min(flat.len() - 1);
        let start = [after, after.saturating_sub(1)].into_iter().find(|&i| value(flat[i]) >= enough)?;
        let (mut low, mut high) = (start, start);
        while low > 0 && value(flat[low - 1]) >= enough {
            low -= 1;
        }
        while high + 1 < flat.len() && value(flat[high + 1]) >= enough {
            high += 1;
        }
        // Between the last equal sample and the first lower one, both of one span.
        let edge = |inside: (usize, usize), outside: Option<(usize, usize)>| -> f64 {
            let Some(outside) = outside.filter(|outside| outside.0 == inside.0) else { return x(inside) };
            let span = &self.spans[inside.0];
            let polynomial = Interpolant { u: &span.u, values: &samples[inside.0] };
            let (mut good, mut bad) = (span.u[inside.1], span.u[outside.1]);
            for _ in 0..50 {
                let middle = 0.5 * (good + bad);
                if polynomial.value(middle) >= enough {
                    good = middle;
                } else {
                    bad = middle;
                }
            }
            self.place(good)
        };
        let ends =
            [edge(flat[low], low.checked_sub(1).map(|i| flat[i])), edge(flat[high], flat.get(high + 1).copied())];
        let shortest = PARALLEL_LENGTH * self.hull.particulars().length_between_perpendiculars;
        (ends[1] - ends[0] >= shortest).then_some(ends)
    }

    /// Weights w_j with A = sum_j w_j y_j for the control points of a vertical line below `end`, and weights for the
    /// half-breadths at the nodes, both sides counted.
    fn weights(&self, end: f64) -> (Vec<f64>, Vec<f64>) {
        let knots = self.hull.surface().v();
        let mut across = vec![0.0; self.hull.surface().shape()[1]];
        let mut at_nodes = vec![0.0; self.nodes.len()];
        let mut add = |node: &Node<N>| {
            for (target, b) in across[node.first..].iter_mut().zip(&node.value) {
                *target += 2.0 * node.weight * node.rise * b;
            }
        };
        for (k, span) in knots.spans().into_iter().enumerate() {
            let (from, to) = (knots.knots()[span], knots.knots()[span + 1]);
            let own = k * self.count..(k + 1) * self.count;
            if to <= end {
                for (node, target) in self.nodes[own.clone()].iter().zip(&mut at_nodes[own]) {
                    add(node);
                    *target = 2.0 * node.weight * node.rise;
                }
            } else if from < end {
                let mut part = Vec::with_capacity(self.count);
                nodes::<N>(self.hull, span, end, self.count, &mut part);
                let sites: Vec<f64> = self.nodes[own.clone()].iter().map(|node| node.v).collect();
                for node in &part {
                    add(node);
                    for (k, target) in at_nodes[own.clone()].iter_mut().enumerate() {
                        *target += 2.0 * node.weight * node.rise * lagrange(&sites, k, node.v);
                    }
                }
            }
        }
        (across, at_nodes)
    }
}

/// Half-breadths at rising `places` on the line of a node, 0 beyond its ends, appended to the list of each place.
fn half_breadths<const N: usize>(hull: &Hull, node: &Node<N>, places: &[f64], into: &mut [Vec<f64>]) {
    let surface = hull.surface();
    let (knots, p, columns) = (surface.u(), surface.u().degree(), surface.shape()[1]);
    let line: Vec<[f64; 2]> = surface
        .points()
        .chunks_exact(columns)
        .map(|row| {
            let mut sum = [0.0; 2];
            for (point, b) in row[node.first..].iter().zip(&node.value) {
                sum[0] += b * point[0];
                sum[1] += b * point[1];
            }
            sum
        })
        .collect();
    let at = |span: usize, u: f64| {
        let rows = knots.basis_derivatives::<2>(span, u);
        let points = &line[span - p..=span];
        let sum = |row: &[f64], c: usize| row.iter().zip(points).map(|(b, point)| b * point[c]).sum::<f64>();
        [sum(&rows[0], 0), sum(&rows[1], 0), sum(&rows[0], 1)]
    };
    let spans = knots.spans();
    let slack = 1e-12 * (line[line.len() - 1][0] - line[0][0]).abs();
    let mut ends: Option<(usize, f64, f64)> = None;
    let mut k = 0;
    for (&x, target) in places.iter().zip(into) {
        if x < line[0][0] - slack || x > line[line.len() - 1][0] + slack {
            target.push(0.0);
            continue;
        }
        // The span that holds x.
        let (from, to) = loop {
            let (low, high) = (knots.knots()[spans[k]], knots.knots()[spans[k] + 1]);
            let (_, from, to) = match ends {
                Some(found) if found.0 == k => found,
                _ => (k, at(spans[k], low)[0], at(spans[k], high)[0]),
            };
            ends = Some((k, from, to));
            if x <= to || k + 1 == spans.len() {
                break (from, to);
            }
            k += 1;
        };
        let (mut low, mut high) = (knots.knots()[spans[k]], knots.knots()[spans[k] + 1]);
        let resolution = 1e-12 * (high - low);
        let mut u = if to > from { low + (high - low) * ((x - from) / (to - from)).clamp(0.0, 1.0) } else { low };
        let mut y = 0.0;
        for _ in 0..60 {
            let [value, slope, breadth] = at(spans[k], u);
            y = breadth;
            if value > x {
                high = u;
            } else {
                low = u;
            }
            let newton = u - (value - x) / slope;
            let next = if newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
            let step = (next - u).abs();
            u = next;
            if step <= resolution {
                break;
            }
        }
        target.push(y);
    }
}

/// The Lagrange polynomial of site `k` at `t`.
fn lagrange(sites: &[f64], k: usize, t: f64) -> f64 {
    let others = sites.iter().enumerate().filter(|&(i, _)| i != k);
    others.map(|(_, site)| (t - site) / (sites[k] - site)).product()
}

/// The polynomial through values at distinct parameters.
struct Interpolant<'a> {
    u: &'a [f64],
    values: &'a [f64],
}

impl Interpolant<'_> {
    fn value(&self, u: f64) -> f64 {
        self.values.iter().enumerate().map(|(k, value)| value * lagrange(self.u, k, u)).sum()
    }

    /// The derivative.
    fn slope(&self, u: f64) -> f64 {
        let mut sum = 0.0;
        for (k, value) in self.values.iter().enumerate() {
            for m in (0..self.u.len()).filter(|&m| m != k) {
                let others = (0..self.u.len()).filter(|&i| i != k && i != m);
                let product: f64 = others.map(|i| (u - self.u[i]) / (self.u[k] - self.u[i])).product();
                sum += value * product / (self.u[k] - self.u[m]);
            }
        }
        sum
    }

    /// The ends and the interior maxima.
    fn maxima(&self, ends: (f64, f64)) -> Vec<f64> {
        let mut found = vec![ends.0, ends.1];
        let count = 2 * self.u.len();
        let at = |k: usize| ends.0 + (ends.1 - ends.0) * k as f64 / count as f64;
        for k in 0..count {
            let (mut low, mut high) = (at(k), at(k + 1));
            if self.slope(low) <= 0.0 || self.slope(high) >= 0.0 {
                continue;
            }
            // False position with the Illinois weights, which settles in some eight steps.
            let (mut at_low, mut at_high) = (self.slope(low), self.slope(high));
            let mut u = 0.5 * (low + high);
            for _ in 0..40 {
                let next = (low * at_high - high * at_low) / (at_high - at_low);
                let next = if next > low && next < high { next } else { 0.5 * (low + high) };
                let settled = (next - u).abs() <= 1e-15 * (ends.1 - ends.0);
                u = next;
                let slope = self.slope(u);
                if settled || slope == 0.0 {
                    break;
                }
                if slope > 0.0 {
                    (low, at_low, at_high) = (u, slope, 0.5 * at_high);
                } else {
                    (high, at_high, at_low) = (u, slope, 0.5 * at_low);
                }
            }
            found.push(u);
        }
        found
    }
}
