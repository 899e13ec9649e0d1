//! Splines of least energy on given knots.
//!
//! Among all splines f = sum c_j N_j on a knot vector the one that minimises
//!
//! > int w(t) (f^(m)(t))^2 dt + sum_k (B_k c - y_k)^2 / s_k,    subject to B_k c = y_k where s_k = 0.
//!
//! B_k c is the value or a derivative at a site; there may be fewer conditions than coefficients (the rule) and any
//! number of them in one span, as long as the exact ones are independent. The conditions of optimality,
//!
//! > H c + B'p = 0,    B c - s p = y,
//!
//! with H the Gram matrix of the m-th derivatives, form one symmetric banded system once each multiplier stands among
//! the coefficients it meets (quasi-definite; Vanderbei 1995, and Reinsch 1967 for m = 2 on the knots themselves). It
//! is scaled, factored once with pivoting and refined: conditions are met to a few 1e-15 of the size of the data. Cost:
//! O((n + k) (degree + k/n)^2) for n coefficients and k conditions, once, and O((n + k) (degree + k/n)) a set of data.
//!
//! Limits: the energy is that of derivatives in the parameter. The polynomials of degree below m are free, so that at
//! least m conditions are needed.

use super::fit::Condition;
use super::gram::Gram;
use super::knots::{KnotVector, SplineError};
use crate::numeric::{BandedLu, gauss_legendre};

/// Most passes of refinement after a solution; one is enough unless knots are graded by many orders of magnitude.
const REFINEMENTS: usize = 3;

/// Control values of data of size 1 beyond which a spline counts as not determined.
const LARGEST: f64 = 1e10;

/// Nodes a span of the rule for weighted energies, beyond those that integrate the unweighted one exactly.
const WEIGHT_NODES: usize = 4;

/// The quadratic form c'Hc = int w (f^(m))^2 dt.
#[derive(Debug, Clone)]
pub struct Energy {
    knots: KnotVector,
    order: usize,
    /// Row j: H_jj, H_j,j+1, ... H_j,j+p.
    upper: Vec<f64>,
}

impl Energy {
    /// The integral of the square of the derivative of order `order` (2: bending, 3: change of curvature).
    #[must_use]
    pub fn new(knots: &KnotVector, order: usize) -> Self {
        let gram = Gram::new(knots, knots, [order, order]);
        let (count, p) = (knots.basis_count(), knots.degree());
        let mut upper = vec![0.0; count * (p + 1)];
        for j in 0..count {
            for d in 0..=p.min(count - 1 - j) {
                upper[j * (p + 1) + d] = gram.get(j, j + d);
            }
        }
        Self { knots: knots.clone(), order, upper }
    }

    /// The same with a weight w(t) >= 0, integrated by a Gauss rule with four nodes a span more than the unweighted form
    /// needs: exact for weights that are polynomials of degree 8 within the spans.
    #[must_use]
    pub fn weighted(knots: &KnotVector, order: usize, weight: impl Fn(f64) -> f64) -> Self {
        let (count, p) = (knots.basis_count(), knots.degree());
        let mut upper = vec![0.0; count * (p + 1)];
        let rule = gauss_legendre(p.saturating_sub(order) + 1 + WEIGHT_NODES);
        if order <= p {
            for span in knots.spans() {
                let first = span - p;
                for (t, w) in rule.on(knots.knots()[span], knots.knots()[span + 1]) {
                    let row = derivative_row(knots, order, t).1;
                    let factor = w * weight(t);
                    for r in 0..=p {
                        for s in r..=p {
                            upper[(first + r) * (p + 1) + s - r] += factor * row[r] * row[s];
                        }
                    }
                }
            }
        }
        Self { knots: knots.clone(), order, upper }
    }

    /// The knots.
    #[must_use]
    pub fn knots(&self) -> &KnotVector {
        &self.knots
    }

    /// H_ij.
    fn get(&self, i: usize, j: usize) -> f64 {
        let (low, high) = (i.min(j), i.max(j));
        let p = self.knots.degree();
        if high - low <= p { self.upper[low * (p + 1) + high - low] } else { 0.0 }
    }

    /// H c.
    ///
    /// # Panics
    /// When `coefficients` is shorter than the number of basis functions.
    #[must_use]
    pub fn apply(&self, coefficients: &[f64]) -> Vec<f64> {
        let (count, p) = (self.knots.basis_count(), self.knots.degree());
        let mut result = vec![0.0; count];
        for j in 0..count {
            result[j] += self.upper[j * (p + 1)] * coefficients[j];
            for d in 1..=p.min(count - 1 - j) {
                let h = self.upper[j * (p + 1) + d];
                result[j] += h * coefficients[j + d];
                result[j + d] += h * coefficients[j];
            }
        }
        result
    }

    /// The energy c'Hc.
    ///
    /// # Panics
    /// When `coefficients` is shorter than the number of basis functions.
    #[must_use]
    pub fn value(&self, coefficients: &[f64]) -> f64 {
        self.apply(coefficients).iter().zip(coefficients).map(|(h, c)| h * c).sum()
    }

    /// The spline of least energy that meets all `conditions` exactly.
    ///
    /// # Errors
    /// [`SplineError::Site`] when a site is not finite or outside the domain, [`SplineError::Undetermined`] when the
    /// conditions are dependent or leave a polynomial of degree below m free.
    pub fn interpolation(&self, conditions: &[Condition]) -> Result<MinimumEnergy, SplineError> {
        self.smoothing(conditions, &vec![0.0; conditions.len()])
    }

    /// The spline that minimises the energy plus the sum of (B_k c - y_k)^2 / s_k; conditions with `slacks` s_k = 0 are
    /// met exactly. Penalised least squares, sum w_k (B_k c - y_k)^2 + lambda c'Hc, is s_k = lambda / w_k.
    ///
    /// # Errors
    /// As [`Self::interpolation`]; [`SplineError::PointCount`] when there are not as many slacks as conditions,
    /// [`SplineError::Site`] also for a slack that is negative or not finite.
    pub fn smoothing(&self, conditions: &[Condition], slacks: &[f64]) -> Result<MinimumEnergy, SplineError> {
        MinimumEnergy::new(self, conditions, slacks)
    }
}

/// Derivatives of order `order` of the basis functions at `t`, and the index of the first of them.
fn derivative_row(knots: &KnotVector, order: usize, t: f64) -> (usize, [f64; crate::spline::basis::MAX_DEGREE + 1]) {
    match order {
        0 => {
            let (first, [row]) = knots.orders_at::<1>(t);
            (first, row)
        }
        1 | 2 => {
            let (first, rows) = knots.orders_at::<3>(t);
            (first, rows[order])
        }
        _ => {
            let (first, rows) = knots.orders_at::<{ crate::spline::basis::MAX_DEGREE + 1 }>(t);
            (first, rows[order.min(crate::spline::basis::MAX_DEGREE)])
        }
    }
}

/// The factored problem: conditions and energy on one knot vector, for any number of sets of data.
#[derive(Debug, Clone)]
pub struct MinimumEnergy {
    energy: Energy,
    /// For each condition the first basis function it meets and its row.
    rows: Vec<(usize, [f64; crate::spline::basis::MAX_DEGREE + 1])>,
    slacks: Vec<f64>,
    /// Position of coefficients, then of multipliers, in the banded system, and the scale of each.
    position: Vec<usize>,
    scale: Vec<f64>,
    lu: BandedLu,
}

impl MinimumEnergy {
    fn new(energy: &Energy, conditions: &[Condition], slacks: &[f64]) -> Result<Self, SplineError> {
        let (knots, count) = (&energy.knots, energy.knots.basis_count());
        let p = knots.degree();
        if slacks.len() != conditions.len() {
            return Err(SplineError::PointCount { found: slacks.len(), expected: conditions.len() });
        }
        let (a, b) = knots.domain();
        for (index, (condition, &slack)) in conditions.iter().zip(slacks).enumerate() {
            let value = condition.site;
            if !(a..=b).contains(&value) {
                return Err(SplineError::Site { index, value, problem: "outside the domain of the spline" });
            }
            if !(slack >= 0.0 && slack.is_finite()) {
                return Err(SplineError::Site { index, value, problem: "its slack is not a number from 0 up" });
            }
        }
        if conditions.len() < energy.order {
            return Err(SplineError::Undetermined { column: conditions.len() });
        }
        let rows: Vec<_> = conditions.iter().map(|c| derivative_row(knots, c.order, c.site)).collect();
        // A multiplier stands behind the middle one of its basis functions.
        let mut keys: Vec<(usize, bool, usize)> = (0..count).map(|j| (j, false, j)).collect();
        keys.extend(rows.iter().enumerate().map(|(k, row)| (row.0 + p / 2, true, count + k)));
        keys.sort_unstable();
        let size = keys.len();
        let mut position = vec![0; size];
        keys.iter().enumerate().for_each(|(place, key)| position[key.2] = place);
        // Symmetric scaling: unit diagonal of H, then unit rows of B.
        let largest = (0..count).map(|j| energy.get(j, j)).fold(0.0, f64::max);
        if !(largest > 0.0 && largest.is_finite()) {
            return Err(SplineError::Undetermined { column: 0 });
        }
        let mut scale: Vec<f64> = (0..count).map(|j| energy.get(j, j).max(1e-18 * largest).sqrt().recip()).collect();
        for (first, row) in &rows {
            let size = (0..=p).map(|r| (row[r] * scale[first + r]).abs()).fold(0.0, f64::max);
            scale.push(if size > 0.0 { size.recip() } else { 1.0 });
        }
        let mut band = 0;
        for (k, (first, _)) in rows.iter().enumerate() {
            for j in *first..=first + p {
                band = band.max(position[j].abs_diff(position[count + k]));
            }
        }
        for j in 0..count {
            band = band.max(position[(j + p).min(count - 1)] - position[j]);
        }
        let entry = |i: usize, j: usize| {
            let (i, j) = (keys[i].2, keys[j].2);
            let value = match (i < count, j < count) {
                (true, true) => energy.get(i, j),
                (false, false) if i == j => -slacks[i - count],
                (false, false) => 0.0,
                _ => {
                    let (column, condition) = (i.min(j), i.max(j) - count);
                    let (first, row) = &rows[condition];
                    if (*first..=first + p).contains(&column) { row[column - first] } else { 0.0 }
                }
            };
            value * scale[i] * scale[j]
        };
        let lu = BandedLu::new(size, band, band, entry)
            .map_err(|error| SplineError::Undetermined { column: keys[error.column].0.min(count - 1) })?;
        let problem = Self { energy: energy.clone(), rows, slacks: slacks.to_vec(), position, scale, lu };
        problem.check_independent()?;
        Ok(problem)
    }

    /// Dependent conditions can leave a pivot that is rounding instead of zero: data that are not met show them.
    fn check_independent(&self) -> Result<(), SplineError> {
        // Not a polynomial of low degree, not symmetric: it meets dependent conditions with no solution.
        let data: Vec<f64> = (0..self.rows.len()).map(|k| (k as f64 * 2.399).sin()).collect();
        let coefficients = self.solve(&data);
        let size = coefficients.iter().fold(1.0f64, |m, c| m.max(c.abs()));
        // A piece between corners without data of its own is free to turn: rounding blows it up.
        if let Some(column) = coefficients.iter().position(|c| c.is_nan() || c.abs() > LARGEST) {
            return Err(SplineError::Undetermined { column });
        }
        let p = self.energy.knots.degree();
        for (((first, row), &slack), y) in self.rows.iter().zip(&self.slacks).zip(&data) {
            let value: f64 = (0..=p).map(|r| row[r] * coefficients[first + r]).sum();
            let weight = row.iter().fold(1.0f64, |m, b| m.max(b.abs()));
            if !value.is_finite() || (slack <= 0.0 && (value - y).abs() > 1e-9 * size * weight) {
                return Err(SplineError::Undetermined { column: *first });
            }
        }
        Ok(())
    }

    /// Number of conditions.
    #[must_use]
    pub fn condition_count(&self) -> usize {
        self.rows.len()
    }

    /// The control values for the data y_k, one a condition.
    ///
    /// # Panics
    /// When there are fewer data than conditions.
    #[must_use]
    pub fn solve(&self, data: &[f64]) -> Vec<f64> {
        let count = self.energy.knots.basis_count();
        let mut solution = vec![0.0; self.position.len()];
        let mut residual = vec![0.0; self.position.len()];
        residual[count..].copy_from_slice(&data[..self.rows.len()]);
        let mut before = f64::INFINITY;
        for _ in 0..=REFINEMENTS {
            let step = self.step(&residual);
            let trial: Vec<f64> = solution.iter().zip(&step).map(|(x, s)| x + s).collect();
            residual = self.residual(&trial, data);
            let size = residual[count..].iter().fold(0.0f64, |m, r| m.max(r.abs()));
            if size >= before || size.is_nan() {
                break;
            }
            (solution, before) = (trial, size);
        }
        solution.truncate(count);
        solution
    }

    /// How much each condition's own datum moves the fitted value there, d(B_k c)/d(y_k): 1 for exact conditions, 0 for
    /// ones without influence; the diagonal of the hat matrix. O(k) solutions: O(k (n + k) (degree + k/n)).
    #[must_use]
    pub fn leverages(&self) -> Vec<f64> {
        let count = self.energy.knots.basis_count();
        (0..self.rows.len())
            .map(|k| {
                if self.slacks[k] <= 0.0 {
                    return 1.0;
                }
                let mut right = vec![0.0; self.position.len()];
                right[count + k] = 1.0;
                // B_k c = y_k + s_k p_k.
                (1.0 + self.slacks[k] * self.step(&right)[count + k]).clamp(0.0, 1.0)
            })
            .collect()
    }

    /// One solution of the scaled system, unscaled.
    fn step(&self, right: &[f64]) -> Vec<f64> {
        let mut values = vec![0.0; right.len()];
        for (i, r) in right.iter().enumerate() {
            values[self.position[i]] = r * self.scale[i];
        }
        self.lu.solve(&mut values);
        (0..right.len()).map(|i| values[self.position[i]] * self.scale[i]).collect()
    }

    /// What is left of the right-hand side.
    fn residual(&self, solution: &[f64], data: &[f64]) -> Vec<f64> {
        let (count, p) = (self.energy.knots.basis_count(), self.energy.knots.degree());
        let mut result: Vec<f64> = self.energy.apply(&solution[..count]).iter().map(|h| -h).collect();
        for (k, (first, row)) in self.rows.iter().enumerate() {
            let multiplier = solution[count + k];
            let mut value = data[k] + self.slacks[k] * multiplier;
            for r in 0..=p {
                result[first + r] -= row[r] * multiplier;
                value -= row[r] * solution[first + r];
            }
            result.push(value);
        }
        result
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spline::BsplineCurve;
    use crate::spline::tests::knots;
    use proptest::prelude::*;

    fn values(sites: &[f64]) -> Vec<Condition> {
        sites.iter().map(|&site| Condition { site, order: 0 }).collect()
    }

    fn curve(knots: &KnotVector, coefficients: &[f64]) -> BsplineCurve<1> {
        BsplineCurve::new(knots.clone(), coefficients.iter().map(|&c| [c]).collect()).unwrap()
    }

    /// With knots at the data, m = 2 and cubics give the natural spline (Holladay 1957): f'' = 0 at the ends, and between
    /// the data 0, 1, 0 at 0, 1, 2 it is f = (3 t - t^3) / 2 on the first span.
    #[test]
    fn the_natural_spline() {
        let knots = KnotVector::from_breakpoints(3, &[0.0, 1.0, 2.0], &[1]).unwrap();
        let problem = Energy::new(&knots, 2).interpolation(&values(&[0.0, 1.0, 2.0])).unwrap();
        let f = curve(&knots, &problem.solve(&[0.0, 1.0, 0.0]));
        for t in [0.1, 0.4, 0.9] {
            assert!((f.eval(t)[0] - (3.0 * t - t * t * t) / 2.0).abs() < 1e-14, "{t}");
        }
        // Energy of f'' = -3 t twice: 2 int 9 t^2 = 6.
        let energy = Energy::new(&knots, 2);
        assert!((energy.value(&problem.solve(&[0.0, 1.0, 0.0])) - 6.0).abs() < 1e-12);
    }

    /// Reinsch 1967: with slacks 1/alpha the smoothing spline through 0, 1, 0 is the natural spline, shrunk to the line
    /// through the mean. By hand: residual r = s g with g the second difference of the solution's multipliers.
    #[test]
    fn the_smoothing_spline_of_three_points() {
        let knots = KnotVector::from_breakpoints(3, &[0.0, 1.0, 2.0], &[1]).unwrap();
        let slack = 0.7;
        let problem = Energy::new(&knots, 2).smoothing(&values(&[0.0, 1.0, 2.0]), &[slack; 3]).unwrap();
        let f = curve(&knots, &problem.solve(&[0.0, 1.0, 0.0]));
        // The fitted bend b = f1 - (f0 + f2)/2 has energy 6 b^2 and data misfit (2/3)(b - 1)^2 / s: 6 b = (2/3)(1 -
        // b) / s.
        let bend = (2.0 / 3.0 / slack) / (6.0 + 2.0 / 3.0 / slack);
        let found = f.eval(1.0)[0] - 0.5 * (f.eval(0.0)[0] + f.eval(2.0)[0]);
        assert!((found - bend).abs() < 1e-14, "{found} {bend}");
        // Leverages sum to the degrees of freedom: 2 of the line, and the bend's share.
        let freedom: f64 = problem.leverages().iter().sum();
        assert!((freedom - 2.0 - bend).abs() < 1e-13, "{freedom}");
    }

    /// A weight of 1 on one side and 10^6 on the other pushes the bend to the cheap side.
    #[test]
    fn weights_move_the_bend() {
        let knots = KnotVector::uniform(3, 20).unwrap();
        let conditions = values(&[0.0, 0.25, 0.5, 0.75, 1.0]);
        let energy = Energy::weighted(&knots, 2, |t| if t < 0.5 { 1.0 } else { 1e6 });
        let f = curve(&knots, &energy.interpolation(&conditions).unwrap().solve(&[0.0, 0.0, 0.0, 0.5, 1.0]));
        assert!(f.derivatives::<3>(0.6)[2][0].abs() < 0.1);
        let same = Energy::weighted(&knots, 3, |_| 1.0);
        let gram = Energy::new(&knots, 3);
        for (a, b) in same.upper.iter().zip(&gram.upper) {
            assert!((a - b).abs() < 1e-9 * gram.get(5, 5), "{a} {b}");
        }
    }

    #[test]
    fn conditions_that_do_not_determine_it() {
        let knots = KnotVector::uniform(3, 4).unwrap();
        let energy = Energy::new(&knots, 2);
        let undetermined =
            |sites: &[f64]| matches!(energy.interpolation(&values(sites)), Err(SplineError::Undetermined { .. }));
        assert!(undetermined(&[0.5]));
        assert!(undetermined(&[0.3, 0.3]));
        // Five values in one cubic span.
        assert!(undetermined(&[0.01, 0.05, 0.1, 0.15, 0.2]));
        assert!(matches!(energy.interpolation(&values(&[0.0, 1.5])), Err(SplineError::Site { index: 1, .. })));
        assert!(matches!(energy.smoothing(&values(&[0.0, 1.0]), &[0.0]), Err(SplineError::PointCount { .. })));
        assert!(matches!(
            energy.smoothing(&values(&[0.0, 1.0]), &[0.0, -1.0]),
            Err(SplineError::Site { index: 1, .. })
        ));
    }

    proptest! {
        #[test]
        fn data_are_met_and_no_neighbour_bends_less(
            k in knots(7),
            order in 1usize..4,
            fractions in prop::collection::vec(0.0f64..1.0, 4..9),
            numbers in prop::collection::vec(-1.0f64..1.0, 16),
        ) {
            let order = order.min(k.degree());
            let (a, b) = k.domain();
            let mut sites: Vec<f64> = fractions.iter().map(|f| a + f * (b - a)).collect();
            sites.sort_by(f64::total_cmp);
            sites.dedup_by(|x, y| *x - *y < 0.02 * (b - a));
            // At most one a coefficient, and spread: half of the coefficients.
            sites.truncate(k.basis_count() / 2);
            if sites.len() < order {
                return Ok(());
            }
            let mut conditions = values(&sites);
            conditions.push(Condition { site: a, order: 1 });
            let energy = Energy::new(&k, order);
            let Ok(problem) = energy.interpolation(&conditions) else { return Ok(()) };
            let data = &numbers[..conditions.len()];
            let c = problem.solve(data);
            let scale = c.iter().fold(1.0f64, |m, x| m.max(x.abs()));
            let f = curve(&k, &c);
            for (s, y) in sites.iter().zip(data) {
                prop_assert!((f.eval(*s)[0] - y).abs() < 1e-12 * scale, "{} {}", f.eval(*s)[0], y);
            }
            // The gradient is a combination of the rows: H c is orthogonal to every change that keeps the data.
            let free: Vec<f64> = (0..c.len()).map(|j| ((j * j) as f64).cos()).collect();
            let g = curve(&k, &free);
            let mut kept: Vec<f64> = sites.iter().map(|s| g.eval(*s)[0]).collect();
            kept.push(g.derivatives::<2>(a)[1][0]);
            let change: Vec<f64> = free.iter().zip(problem.solve(&kept)).map(|(x, y)| x - y).collect();
            let h = energy.apply(&c);
            let product: f64 = h.iter().zip(&change).map(|(x, y)| x * y).sum();
            let size = energy.value(&c).max(0.0).sqrt() * energy.value(&change).max(0.0).sqrt();
            let rounding = (0..c.len()).map(|j| energy.get(j, j) * c[j].abs().max(1.0) * change[j].abs()).sum::<f64>();
            // Rounding of the sum itself, for data that ask for hardly any energy.
            let terms: f64 = h.iter().zip(&change).map(|(x, y)| (x * y).abs()).sum();
            let slack = 1e-7 * size + 1e-12 * (rounding + terms) + 1e-15;
            prop_assert!(product.abs() <= slack, "{} {}", product, size);
        }
    }
}
