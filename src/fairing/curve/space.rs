//! The spline, its readings and its energy.
//!
//! With p = y', q = 1 + p^2, ds = sqrt(q) dx and kappa = q^(-3/2) y'', the derivative of order j of kappa with respect
//! to s is linear in y'', ..., y^(j+2) once q and its derivatives are those of a given curve. With g = q^(-3/2) and w =
//! q^(-1/2):
//!
//! ```text
//! kappa     = g y''
//! kappa_s   = w (g y''' + g' y'')
//! kappa_ss  = w (w (g y'''' + 2 g' y''' + g'' y'') + w' (g y''' + g' y''))
//! ```
//!
//! E_m = int kappa_(m-2)^2 ds; on a level line (q = 1) it is the integral of the square of the m-th derivative. Gauss
//! rules with [`EXTRA`] nodes a span more than polynomials need.

use super::super::inflections::{CurvatureRow, curvature_rows};
use super::super::model::{Model, Reading, Row};
use super::given::{CurveError, CurvePoint, CurveSettings};
use crate::numeric::{SymmetricBand, gauss_legendre};
use crate::spline::{BsplineCurve, KnotVector};

/// Gauss nodes a span beyond those for polynomials.
const EXTRA: usize = 4;

/// The spline over the points.
#[derive(Debug, Clone)]
pub(super) struct CurveSpace {
    pub(super) knots: KnotVector,
    /// Ends of the stretches between knuckles, and the order of the energy there: no higher than their readings
    /// determine.
    orders: Vec<(f64, usize)>,
    pub(super) order: usize,
    /// Points with an ordinate, by index.
    pub(super) read: Vec<usize>,
    /// Coefficients of y''.
    pub(super) bends: Vec<CurvatureRow>,
}

/// Coefficients of y'', y''' and y'''' in the derivative of curvature, and ds/dx.
fn metric(curve: Option<&BsplineCurve<1>>, order: usize, x: f64) -> ([f64; 3], f64) {
    let d = curve.map_or([[0.0]; 5], |curve| curve.derivatives::<5>(x));
    let (p, y2, y3) = (d[1][0], d[2][0], d[3][0]);
    let q = 1.0 + p * p;
    let (q1, q2) = (2.0 * p * y2, 2.0 * (y2 * y2 + p * y3));
    let w = 1.0 / q.sqrt();
    let g = w / q;
    let g1 = -1.5 * g / q * q1;
    let g2 = 3.75 * g / (q * q) * q1 * q1 - 1.5 * g / q * q2;
    let w1 = -0.5 * w / q * q1;
    let forms = match order {
        2 => [g, 0.0, 0.0],
        3 => [w * g1, w * g, 0.0],
        _ => [w * (w * g2 + w1 * g1), w * (2.0 * w * g1 + w1 * g), w * w * g],
    };
    (forms, 1.0 / w)
}

impl CurveSpace {
    pub(super) fn new(points: &[CurvePoint], order: usize) -> Result<Self, CurveError> {
        let read: Vec<usize> = (0..points.len()).filter(|&k| points[k].y.is_some()).collect();
        let degree = if order == 2 { 3 } else { 5 };
        let (mut breaks, mut times) = (Vec::new(), Vec::new());
        let last = points.len().saturating_sub(1);
        for (k, point) in points.iter().enumerate() {
            // A knot where something is known or broken, and at both ends.
            if k != 0 && k != last && point.y.is_none() && !point.knuckle && !point.tangent {
                continue;
            }
            breaks.push(point.x);
            if k != 0 && k != last {
                times.push(match point {
                    point if point.knuckle => degree,
                    point if point.tangent => degree - 1,
                    _ => 1,
                });
            }
        }
        let knots = KnotVector::from_breakpoints(degree, &breaks, &times)?;
        let bends = curvature_rows(&knots);
        let mut orders = Vec::new();
        let mut from = 0;
        for (k, point) in points.iter().enumerate() {
            if k > from && (point.knuckle || k == last) {
                let readings = read.iter().filter(|&&k| (points[from].x..=point.x).contains(&points[k].x)).count();
                orders.push((point.x, order.min(readings).max(2)));
                from = k;
            }
        }
        Ok(Self { knots, orders, order, read, bends })
    }

    /// The order of the energy at x.
    fn order_at(&self, x: f64) -> usize {
        self.orders.iter().find(|(end, _)| x <= *end).map_or(self.order, |(_, order)| *order)
    }

    /// The row of the derivative of this order at x.
    pub(super) fn row(&self, x: f64, order: usize) -> Row {
        let (p, span) = (self.knots.degree(), self.knots.find_span(x));
        let values = self.knots.basis_derivatives::<2>(span, x)[order.min(1)];
        (0..=p).map(|r| (span - p + r, values[r])).filter(|entry| entry.1 != 0.0).collect()
    }

    /// The curve of these control values.
    pub(super) fn curve(&self, net: &[f64]) -> Result<BsplineCurve<1>, CurveError> {
        Ok(BsplineCurve::new(self.knots.clone(), net.iter().map(|&c| [c]).collect())?)
    }

    /// The energy with the metric of a curve, or of a level line.
    pub(super) fn energy(&self, at: Option<&BsplineCurve<1>>) -> SymmetricBand {
        let (p, n) = (self.knots.degree(), self.knots.basis_count());
        let mut energy = SymmetricBand::zeros(n, p);
        self.each_node(|span, x, weight| {
            let (forms, speed) = metric(at, self.order_at(x), x);
            let basis = self.knots.basis_derivatives::<5>(span, x);
            let first = span - p;
            let value = |r: usize| forms[0] * basis[2][r] + forms[1] * basis[3][r] + forms[2] * basis[4][r];
            for i in 0..=p {
                for j in 0..=i {
                    energy.add(first + i, first + j, weight * speed * value(i) * value(j));
                }
            }
        });
        energy
    }

    /// The exact functional E_m of a curve: its own metric.
    pub(super) fn exact_energy(&self, curve: &BsplineCurve<1>) -> f64 {
        let mut sum = 0.0;
        self.each_node(|_, x, weight| {
            let (forms, speed) = metric(Some(curve), self.order_at(x), x);
            let d = curve.derivatives::<5>(x);
            let value = forms[0] * d[2][0] + forms[1] * d[3][0] + forms[2] * d[4][0];
            sum += weight * speed * value * value;
        });
        sum
    }

    fn each_node(&self, mut visit: impl FnMut(usize, f64, f64)) {
        let t = self.knots.knots();
        let rule = gauss_legendre(self.knots.degree() - 1 + EXTRA);
        for span in self.knots.spans() {
            for (x, weight) in rule.on(t[span], t[span + 1]) {
                visit(span, x, weight);
            }
        }
    }

    /// The steepest slope of a curve in magnitude.
    pub(super) fn steepest(&self, curve: &BsplineCurve<1>) -> f64 {
        let mut most = 0.0_f64;
        self.each_node(|_, x, _| most = most.max(curve.derivatives::<2>(x)[1][0].abs()));
        most
    }

    /// Readings, weights and tolerances over the control values.
    pub(super) fn model(&self, points: &[CurvePoint], tolerances: &[Option<f64>], energy: SymmetricBand) -> Model {
        let readings = self
            .read
            .iter()
            .map(|&k| Reading {
                row: self.row(points[k].x, 0),
                value: points[k].y.unwrap_or_default(),
                weight: points[k].weight,
                tolerance: tolerances[k],
                shared: 0.0,
            })
            .collect();
        Model {
            energy,
            readings,
            known: vec![None; self.knots.basis_count()],
            straight: None,
            start: None,
            carried: None,
            stationary: None,
        }
    }

    /// The coefficients of y'' as forms over the control values, of size 1.
    pub(super) fn forms(&self) -> Vec<Row> {
        let rows = self.bends.iter().map(|bend| {
            let size = bend.weights.iter().fold(0.0_f64, |most, w| most.max(w.abs()));
            bend.weights.iter().enumerate().map(|(k, w)| (bend.first + k, w / size)).collect()
        });
        rows.collect()
    }

    /// int x^power y dx as a row.
    pub(super) fn moment(&self, power: u32) -> Vec<f64> {
        let (from, to) = self.knots.domain();
        self.knots.moments(power, from, to)
    }

    /// The first form of each stretch between knuckles, and their number at the end.
    pub(super) fn stretches(&self, knuckles: &[f64]) -> Vec<usize> {
        let mut starts = vec![0];
        starts.extend(knuckles.iter().map(|&x| self.bends.partition_point(|bend| bend.support[0] < x)));
        starts.push(self.bends.len());
        starts
    }
}

/// Greatest setting, in its unit: programs overflow far above.
const MOST: f64 = 1e12;

/// Points that the settings cannot use.
pub(super) fn checked(points: &[CurvePoint], settings: &CurveSettings) -> Result<(), CurveError> {
    if !(2..=4).contains(&settings.order) {
        return Err(CurveError::Order(settings.order));
    }
    let found = points.iter().filter(|point| point.y.is_some()).count();
    if found <= settings.order {
        return Err(CurveError::TooFew { found, order: settings.order, needed: settings.order + 1 });
    }
    let positive = [
        ("the tolerance", settings.tolerance, false),
        ("the smoothing weight", settings.weight, true),
        ("the quantum", Some(settings.quantum), false),
    ];
    for (what, value, strict) in positive {
        if let Some(value) = value.filter(|v| !(0.0..=MOST).contains(v) || (strict && *v <= 0.0)) {
            return Err(CurveError::Setting { what, value });
        }
    }
    let finite =
        [("the first slope", settings.slopes[0]), ("the last slope", settings.slopes[1]), ("the area", settings.area)];
    for (what, value) in finite.into_iter().chain([("the centroid", settings.centroid)]) {
        if let Some(value) = value.filter(|v| v.is_nan() || v.abs() > MOST) {
            return Err(CurveError::Setting { what, value });
        }
    }
    for (index, point) in points.iter().enumerate() {
        if !(point.weight > 0.0 && point.weight.is_finite()) {
            return Err(super::super::inflections::BandsError::Number {
                what: "the weight",
                index,
                value: point.weight,
            }
            .into());
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The forms of the metric against curvature differentiated along the arc by small steps.
    #[test]
    fn the_metric_is_that_of_arc_length() {
        let points: Vec<CurvePoint> =
            (0..12).map(|k| CurvePoint::new(f64::from(k), (0.7 * f64::from(k)).sin() * 2.0)).collect();
        let space = CurveSpace::new(&points, 4).unwrap();
        let net: Vec<f64> = (0..space.knots.basis_count()).map(|i| (0.6 * i as f64).sin() * 2.0).collect();
        let curve = space.curve(&net).unwrap();
        let kappa = |x: f64| {
            let d = curve.derivatives::<3>(x);
            d[2][0] / (1.0 + d[1][0] * d[1][0]).powf(1.5)
        };
        let speed = |x: f64| (1.0 + curve.derivatives::<2>(x)[1][0].powi(2)).sqrt();
        let h = 1e-3;
        let first = |x: f64| (kappa(x + h) - kappa(x - h)) / (2.0 * h) / speed(x);
        let second = |x: f64| (first(x + h) - first(x - h)) / (2.0 * h) / speed(x);
        for x in [1.3, 4.45, 6.6, 9.4] {
            let d = curve.derivatives::<5>(x);
            for (order, exact) in [(2, kappa(x)), (3, first(x)), (4, second(x))] {
                let (forms, ds) = metric(Some(&curve), order, x);
                let value = forms[0] * d[2][0] + forms[1] * d[3][0] + forms[2] * d[4][0];
                assert!((value - exact).abs() < 1e-4 * (1.0 + exact.abs()), "{order} at {x}: {value} {exact}");
                assert!((ds - speed(x)).abs() < 1e-14);
            }
        }
        // On a level line the energy is that of the derivative.
        let level = space.energy(None);
        let product: f64 = level.apply(&net).iter().zip(&net).map(|(e, c)| e * c).sum();
        let mut sum = 0.0;
        space.each_node(|_, x, weight| sum += weight * curve.derivatives::<5>(x)[4][0].powi(2));
        assert!((product - sum).abs() < 1e-10 * sum);
        let frozen = space.energy(Some(&curve));
        let product: f64 = frozen.apply(&net).iter().zip(&net).map(|(e, c)| e * c).sum();
        assert!((product - space.exact_energy(&curve)).abs() < 1e-9 * product);
    }
}
