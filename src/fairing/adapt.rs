//! An energy whose weight varies over the net of a fit: less smoothing where the surface bends sharply.
//!
//! The energy is that of true curvature with the metric of the start ([`super::metric`]). Its terms (waterlines, mixed,
//! stations) are weighed each for itself: with e_k the part of a term that the start has in a cell of the knots over
//! the area of the cell, averaged with the cells around it, it counts
//!
//! ```text
//! rho_k = min(1, median(e) / e_k)^1.5:
//! ```
//!
//! one weight for the whole surface either leaves the noise of the side or cuts the bilge and the ends, whose energies
//! lie decades apart; one weight for all terms lets the stations go where only the waterlines turn, at the bow. Across
//! a line of the net where only the slope is continuous, the energy of order 3 sees nothing of a jump J of the
//! curvature; the start has next to none there where it is smooth, and smoothing would make one. It is charged as a
//! rate J/h over the mean length h of the spans beside it,
//!
//! ```text
//! 10 rho int J^2 / h,   rho that of the cells beside it, or (median(e) / e_J)^1.5 by the density e_J of the start's own jump where that is less:
//! ```
//!
//! tangent lines, at which the start jumps, are spared. A rise of curvature that may be shared between jumps and the
//! spans is least with 1/(1 + 10) of it in the jumps. (Smoothing splines with a varying weight: Pintore, Speckman &
//! Holmes 2006.) Measured on benches/truth, three tables each: a Series 60 with 2 mm comes to 2.8 mm (3.8 mm with
//! derivatives by the parameters of the chart and one weight for all terms), with 41 mm to 25.8 mm (25.8), an S-175
//! with 2 mm to 3.9 mm (3.8), with 64 mm to 43.6 mm (45.6), and no saws are left on the stations of the DTC. Charging
//! jumps once instead of ten times: 3.6 and 3.8 mm with half of every rise in the jumps; a hundred times: 3.2 and 4.5
//! mm. Exponents 1 and 2 are within a tenth. Tried without success: weighing the cells again by the net that was
//! smoothed (S-175 with 2 mm: 4.9 mm); true curvature on charts that do not run level, whose waterlines graze the lines
//! of the net at the keel (a trawler: waterlines 148 > 172 changes of sign instead of 148).

use super::cells::{Cells, Row, add_square};
use super::metric::Metric;
use super::unbroken::Unbroken;
use crate::numeric::SymmetricBand;

/// Exponent of the ratio of energy densities.
const EXPONENT: f64 = 1.5;

/// Weight of a jump over that of a rise of the same height over one span.
const CHARGE: f64 = 10.0;

/// Weights of the cells of a net, and of the lines between them.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Spared {
    /// rho by term and cell, v running fastest.
    cells: Vec<Vec<f64>>,
    /// The same for the lines that may break, along the ship and up, by line and span.
    lines: [Vec<Vec<f64>>; 2],
}

impl Spared {
    /// The weights for the cells of a start.
    pub(super) fn new(cells: &Cells<'_>, metric: &Metric, unbroken: &Unbroken) -> Self {
        let [rows, columns] = cells.count();
        let mut density = vec![vec![0.0; rows * columns]; Metric::TERMS];
        for (k, cell) in cells.all().enumerate() {
            let area = cells.area(cell);
            for place in cells.places(cell) {
                metric.terms(&place, |term, weight, factors| {
                    density[term][k] += weight * place.value(factors).powi(2) / area;
                });
            }
        }
        let mut medians = Vec::new();
        let weights = density.iter().map(|density| {
            let even = averaged(density, [rows, columns]);
            let mut sorted = even.clone();
            sorted.sort_by(f64::total_cmp);
            let median = sorted[(sorted.len() - 1) / 2];
            medians.push(median);
            even.into_iter().map(|density| spared(density, median)).collect()
        });
        let weights: Vec<Vec<f64>> = weights.collect();
        let lines = [0, 1].map(|way: usize| {
            let term = way * (Metric::TERMS - 1);
            let count = [columns, rows][way];
            let rho =
                |span: usize, e: usize| weights[term][if way == 0 { span * columns + e } else { e * columns + span }];
            let lines = cells.jumps(way).iter().enumerate().map(|(line, jump)| {
                let spans = (0..count).map(|e| {
                    if unbroken.has(way, line, e) {
                        return 0.0;
                    }
                    let (mut own, mut area) = (0.0, 0.0);
                    for at in cells.crossings(way, jump, e) {
                        area += at.length * at.weight;
                        if let Some((weight, factors)) = metric.jump(way, &at) {
                            own += weight * at.value(factors).powi(2);
                        }
                    }
                    let beside = rho(jump.above - 1, e).min(rho(jump.above, e));
                    CHARGE * spared(own / area, medians[term]).min(beside)
                });
                spans.collect()
            });
            lines.collect()
        });
        Self { cells: weights, lines }
    }

    /// The energy with these weights over the cells of a surface on the same net, and its metric.
    pub(super) fn energy(&self, cells: &Cells<'_>, metric: &Metric) -> SymmetricBand {
        let (mut energy, mut row) = (metric.energy(cells, |term, k| self.cells[term][k]), Row::new());
        for way in 0..2 {
            for (jump, weights) in cells.jumps(way).iter().zip(&self.lines[way]) {
                for (e, rho) in weights.iter().enumerate() {
                    for at in cells.crossings(way, jump, e) {
                        if let Some((weight, factors)) = metric.jump(way, &at) {
                            at.form(factors, &mut row);
                            add_square(&mut energy, weight * rho, &row);
                        }
                    }
                }
            }
        }
        energy
    }
}

/// Each density averaged with those of the cells around.
fn averaged(density: &[f64], [rows, columns]: [usize; 2]) -> Vec<f64> {
    let around = |k: usize, count: usize| k.saturating_sub(1)..=(k + 1).min(count - 1);
    let cells = (0..rows).flat_map(|e| (0..columns).map(move |f| (e, f)));
    let mean = |(e, f)| {
        let cells = around(e, rows).flat_map(|a| around(f, columns).map(move |b| a * columns + b));
        let (sum, count) = cells.fold((0.0, 0.0), |(sum, count), k| (sum + density[k], count + 1.0));
        sum / count
    };
    cells.map(mean).collect()
}

/// rho for a density of energy.
fn spared(density: f64, median: f64) -> f64 {
    if density > median { (median / density).powf(EXPONENT) } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::super::unbroken::{Along, Breaks};
    use super::*;
    use crate::spline::{BsplineSurface, KnotVector};

    /// x = 100 u, z = 10 v over the knots' own domains taken to 1, with control values y.
    fn surface(u: &KnotVector, v: &KnotVector, y: impl Fn(usize, usize) -> f64) -> BsplineSurface<3> {
        let unit = |knots: &KnotVector| -> Vec<f64> {
            let (from, to) = knots.domain();
            knots.greville().iter().map(|t| (t - from) / (to - from)).collect()
        };
        let mut points = Vec::new();
        for (i, s) in unit(u).into_iter().enumerate() {
            for (j, t) in unit(v).into_iter().enumerate() {
                points.push([100.0 * s, y(i, j), 10.0 * t]);
            }
        }
        BsplineSurface::new(u.clone(), v.clone(), points).unwrap()
    }

    fn weights(surface: &BsplineSurface<3>, breaks: &Breaks) -> Spared {
        let (cells, metric) = (Cells::new(surface), Metric::new(surface));
        Spared::new(&cells, &metric, &Unbroken::new(&cells, &metric, breaks))
    }

    fn of(energy: &SymmetricBand, surface: &BsplineSurface<3>) -> f64 {
        let y: Vec<f64> = surface.points().iter().map(|point| point[1]).collect();
        energy.apply(&y).iter().zip(&y).map(|(e, y)| e * y).sum()
    }

    /// y = 1e-4 (u^3 + v^3), whose slopes are small: the energy is the same everywhere, the weights are 1, and nothing
    /// is changed.
    #[test]
    fn an_even_surface_has_the_even_energy() {
        let (u, v) = (KnotVector::uniform(3, 6).unwrap(), KnotVector::uniform(3, 4).unwrap());
        let cube = |knots: &KnotVector, i: usize| knots.knots()[i + 1..i + 4].iter().product::<f64>();
        let even = surface(&u, &v, |i, j| 1e-4 * (cube(&u, i) + cube(&v, j)));
        let weights = weights(&even, &Breaks::default());
        for term in [0, 3] {
            assert!(weights.cells[term].iter().all(|w| (w - 1.0).abs() < 1e-6), "{:?}", weights.cells[term]);
        }
        let (adapted, plain) = (
            of(&weights.energy(&Cells::new(&even), &Metric::new(&even)), &even),
            of(&Metric::new(&even).energy(&Cells::new(&even), |_, _| 1.0), &even),
        );
        assert!((adapted / plain - 1.0).abs() < 1e-6, "{adapted} for {plain}");
    }

    /// A net that is broken in curvature along a line: nothing is charged for a parabola; a kink of curvature is
    /// charged ten times.
    #[test]
    fn jumps_of_curvature_are_charged() {
        let u = KnotVector::uniform(3, 4).unwrap();
        let v = KnotVector::from_breakpoints(3, &[0.0, 0.5, 1.0, 1.5, 2.0], &[1, 2, 1]).unwrap();
        let knots = |j: usize| &v.knots()[j + 1..j + 4];
        let pairs = |t: &[f64]| (t[0] * t[1] + t[0] * t[2] + t[1] * t[2]) / 3.0;
        // Slopes so small that curvature is the second derivative.
        let cube = surface(&u, &v, |_, j| 1e-6 * knots(j).iter().product::<f64>());
        let lines = vec![Along { at: 0.5, reach: [f64::NEG_INFINITY, f64::INFINITY] }];
        let weights = weights(&cube, &Breaks { tangents: [Vec::new(), lines], ..Breaks::default() });
        let smooth = surface(&u, &v, |_, j| 1e-6 * pairs(knots(j)));
        assert!(of(&weights.energy(&Cells::new(&smooth), &Metric::new(&smooth)), &smooth).abs() < 1e-15);
        // max(v - 1, 0)^2 has the jump 2 and no third derivative: 2^5 * 2^2 / 0.5, over 0.6^3.
        let kinked = surface(&u, &v, |_, j| {
            let t: Vec<f64> = knots(j).iter().map(|t| t - 1.0).collect();
            if v.greville()[j] > 1.0 + 1e-12 { 1e-6 * pairs(&t) } else { 0.0 }
        });
        let found = of(&weights.energy(&Cells::new(&kinked), &Metric::new(&kinked)), &kinked) * 1e12;
        assert!((found * 0.6f64.powi(3) / (CHARGE * 256.0) - 1.0).abs() < 1e-6, "{found}");
    }

    /// The same half-breadths over a chart with waves of its own: what is smooth on the stations costs nothing,
    /// whatever its control values are.
    #[test]
    fn waves_of_the_chart_cost_nothing() {
        let (u, v) = (KnotVector::uniform(3, 8).unwrap(), KnotVector::uniform(3, 8).unwrap());
        let plain = surface(&u, &v, |_, _| 0.0);
        let columns = v.basis_count();
        // Lines u = const swing by 3 m, and the section y = 5 + 0.2 x - 1e-3 x^2 / 2 follows: a quadratic of a spline
        // has no control values that are simple, a linear one has.
        let waved: Vec<[f64; 3]> = plain
            .points()
            .iter()
            .enumerate()
            .map(|(k, p)| {
                let x = p[0] + if (k % columns) % 2 == 0 { 3.0 } else { -3.0 };
                [x, 5.0 + 0.2 * x, p[2]]
            })
            .collect();
        let waved = BsplineSurface::new(u.clone(), v.clone(), waved).unwrap();
        let parametric = of(&crate::spline::energy(&u, &v, 3, 0.6), &waved);
        let metric = Metric::new(&waved);
        let cells = Cells::new(&waved);
        let mut stations = 0.0;
        for cell in cells.all() {
            for place in cells.places(cell) {
                metric.terms(&place, |term, weight, factors| {
                    if term == 3 {
                        stations += weight * place.value(factors).powi(2);
                    }
                });
            }
        }
        assert!(parametric > 1.0, "{parametric}");
        assert!(stations < 1e-12 * parametric, "{stations} of {parametric}");
    }

    /// A bump in one corner has less weight there and leaves the rest as it is.
    #[test]
    fn a_bump_is_spared() {
        let (u, v) = (KnotVector::uniform(3, 10).unwrap(), KnotVector::uniform(3, 8).unwrap());
        let columns = v.basis_count();
        let bumped = surface(&u, &v, |i, j| {
            let k = i * columns + j;
            if k == columns + 1 { 1e-2 } else { ((k * 7919) % 13) as f64 * 1e-6 }
        });
        let weights = weights(&bumped, &Breaks::default()).cells;
        for term in weights {
            let (bump, far) = (term[0], term[term.len() - 1]);
            assert!(bump < 1e-4 && far > 1e3 * bump, "{bump} {far}");
        }
    }
}
