//! Energies of true curvature with a frozen metric: quadratic forms that are exact at the net at which they were frozen.
//!
//! Along a waterline or a station with arc length s, and Q = x'^2 + y'^2 (z' for x' on stations) taken at the present net,
//!
//! ```text
//! N = x' y'' - x'' y',   kappa = N Q^(-3/2),   dkappa/ds = (N' Q^(-3/2) - 3/2 N Q' Q^(-5/2)) Q^(-1/2),   and once more
//! ```
//!
//! are linear in y once Q and its derivatives are frozen. With L and H the length and the height of the surface,
//!
//! ```text
//! E_n = w^n  int int (L^n d^(n-2)kappa/ds^(n-2))^2 ds/L dz/H      over waterlines
//!     + w^-n int int (H^n d^(n-2)kappa/ds^(n-2))^2 ds/H dx/L      over stations
//!     + the mixed terms of the parametric energy,
//! ```
//!
//! which is the parametric energy of [`super::surface`] on a rectangular chart where slopes are small. ds dz = Q^(1/2) |z_v| du dv
//! on a waterline; Gauss sums over the spans, with as many nodes as the degree plus one. Freezing again at the answer until it stands still
//! minimises the true functional. Exact bending energy of a graph can fall to nothing by running the slope to infinity: a step
//! counts only while the exact functional falls, and the tolerances bound it.

use super::surface::{basis_row, mixed_energy};
use crate::numeric::{SymmetricBand, gauss_legendre};
use crate::spline::BsplineSurface;

/// Terms (factor, order in s, order in t) of D^k with D = a d/ds + d/dt, b = D a, c = D^2 a; the fourth only along lines of the net.
fn terms(order: usize, [a, b, c]: [f64; 3]) -> Vec<(f64, usize, usize)> {
    match order {
        1 => vec![(a, 1, 0), (1.0, 0, 1)],
        2 => vec![(a * a, 2, 0), (2.0 * a, 1, 1), (1.0, 0, 2), (b, 1, 0)],
        3 => vec![
            (a * a * a, 3, 0),
            (3.0 * a * a, 2, 1),
            (3.0 * a, 1, 2),
            (1.0, 0, 3),
            (3.0 * a * b, 2, 0),
            (3.0 * b, 1, 1),
            (c, 1, 0),
        ],
        _ => vec![(1.0, 0, 4)],
    }
}

/// Highest derivative of y in the energy of order n.
const HIGHEST: usize = 4;

/// The form of d^(n-2)kappa/ds^(n-2) over the local basis and the weight of its square, at one point.
struct Form {
    row: Vec<f64>,
    weight: f64,
}

/// The point of the surface with everything that both lines need.
struct Point<'a> {
    d: [[[f64; 3]; 5]; 5],
    /// `basis[a][b]`: derivative of order a in u and b in v of the local basis.
    basis: &'a [Vec<Vec<f64>>],
}

impl Point<'_> {
    /// The station or the waterline through the point; none where the chart has none.
    fn form(&self, station: bool, order: usize) -> Option<Form> {
        let (held, run) = if station { (0, 2) } else { (2, 0) };
        let coordinate =
            |axis: usize, s: usize, t: usize| if station { self.d[s][t][axis] } else { self.d[t][s][axis] };
        let (steep, level) = (coordinate(held, 1, 0), coordinate(held, 0, 1));
        if steep.abs() <= 1e-9 * (steep.abs() + level.abs()) {
            return None;
        }
        let along = |axis: usize, k: usize, turn: [f64; 3]| -> f64 {
            terms(k, turn).iter().map(|&(factor, s, t)| factor * coordinate(axis, s, t)).sum()
        };
        // The held coordinate stands still: its derivatives along the line give a, Da and D^2 a one after the other.
        let a = -level / steep;
        let b = -along(held, 2, [a, 0.0, 0.0]) / steep;
        let c = -along(held, 3, [a, b, 0.0]) / steep;
        let turn = [a, b, c];
        let skew = turn.iter().any(|rate| rate.abs() > 1e-9);
        if order == 4 && skew {
            return None;
        }
        let x: Vec<f64> = (1..=HIGHEST).map(|k| along(run, k, turn)).collect();
        let y: Vec<f64> = (1..=HIGHEST).map(|k| along(1, k, turn)).collect();
        let rows: Vec<Vec<f64>> = (1..=order)
            .map(|k| {
                let mut row = vec![0.0; self.basis[0][0].len()];
                for (factor, s, t) in terms(k, turn).into_iter().filter(|term| term.0 != 0.0) {
                    let values = if station { &self.basis[s][t] } else { &self.basis[t][s] };
                    row.iter_mut().zip(values).for_each(|(sum, value)| *sum += factor * value);
                }
                row
            })
            .collect();
        let q = x[0] * x[0] + y[0] * y[0];
        let dq = 2.0 * (x[0] * x[1] + y[0] * y[1]);
        let ddq = 2.0 * (x[1] * x[1] + x[0] * x[2] + y[1] * y[1] + y[0] * y[2]);
        let speed = q.sqrt();
        if speed <= 0.0 || speed.is_nan() {
            return None;
        }
        // g = Q^(-3/2) and its derivatives.
        let g = 1.0 / (q * speed);
        let dg = -1.5 * g * dq / q;
        let ddg = g * (3.75 * dq * dq / q - 1.5 * ddq) / q;
        // N, N', N'' as factors of y', y'', y''', y''''.
        let n = [-x[1], x[0], 0.0, 0.0];
        let dn = [-x[2], 0.0, x[0], 0.0];
        let ddn = [-x[3], -x[2], x[1], x[0]];
        let factors: Vec<f64> = (0..order)
            .map(|k| match order {
                2 => n[k] * g,
                3 => (dn[k] * g + n[k] * dg) / speed,
                _ => {
                    let first = dn[k] * g + n[k] * dg;
                    let second = ddn[k] * g + 2.0 * dn[k] * dg + n[k] * ddg;
                    (second - 0.5 * first * dq / q) / q
                }
            })
            .collect();
        let mut row = vec![0.0; rows[0].len()];
        for (factor, form) in factors.iter().zip(&rows) {
            row.iter_mut().zip(form).for_each(|(sum, value)| *sum += factor * value);
        }
        Some(Form { row, weight: speed * steep.abs() })
    }
}

/// The energy of order 2, 3 or 4 with the metric of the surface as it is.
#[must_use]
pub fn true_energy(surface: &BsplineSurface<3>, order: usize, anisotropy: f64) -> SymmetricBand {
    let order = order.clamp(2, HIGHEST);
    let (u, v) = (surface.u(), surface.v());
    let mut energy = mixed_energy(u, v, order, anisotropy);
    let extent = |axis: usize| {
        let values = surface.points().iter().map(|point| point[axis]);
        values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
    };
    let (length, height) = (extent(0), extent(2));
    let n = order as i32;
    // L^2n / (L H) over waterlines, H^2n / (L H) over stations.
    let scales = [
        anisotropy.powi(n) * length.powi(2 * n) / (length * height),
        anisotropy.powi(-n) * height.powi(2 * n) / (length * height),
    ];
    let nodes = |knots: &crate::spline::KnotVector| -> Vec<(f64, f64)> {
        let rule = gauss_legendre(knots.degree() + 1);
        let breaks = knots.breakpoints();
        breaks.windows(2).flat_map(|w| rule.on(w[0], w[1]).collect::<Vec<_>>()).collect()
    };
    for &(s, ws) in &nodes(u) {
        for &(t, wt) in &nodes(v) {
            let basis: Vec<Vec<Vec<f64>>> = (0..=HIGHEST)
                .map(|a| {
                    let values = |b| basis_row(surface, [s, t], [a, b]).into_iter().map(|(_, value)| value).collect();
                    (0..=HIGHEST - a).map(values).collect()
                })
                .collect();
            let places: Vec<usize> = basis_row(surface, [s, t], [0, 0]).into_iter().map(|(place, _)| place).collect();
            let point = Point { d: surface.derivatives::<5>(s, t), basis: &basis };
            for (station, scale) in [(false, scales[0]), (true, scales[1])] {
                let Some(form) = point.form(station, order) else { continue };
                let weight = scale * form.weight * ws * wt;
                for (k, &i) in places.iter().enumerate() {
                    let left = weight * form.row[k];
                    if left == 0.0 {
                        continue;
                    }
                    for (l, &j) in places[..=k].iter().enumerate() {
                        energy.add(i, j, left * form.row[l]);
                    }
                }
            }
        }
    }
    energy
}

#[cfg(test)]
mod tests {
    use super::super::surface::energy;
    use super::*;
    use crate::spline::KnotVector;

    /// x = 100 u + skew v, z = 10 v, half-breadths from a function of (x, z) at the Greville points.
    fn surface(degree: usize, skew: f64, y: impl Fn(f64, f64) -> f64) -> BsplineSurface<3> {
        let (u, v) = (KnotVector::uniform(degree, 5).unwrap(), KnotVector::uniform(degree, 4).unwrap());
        let mut points = Vec::new();
        for s in u.greville() {
            for t in v.greville() {
                let (x, z) = (100.0 * s + skew * t, 10.0 * t);
                points.push([x, y(x, z), z]);
            }
        }
        BsplineSurface::new(u, v, points).unwrap()
    }

    fn half_breadths(surface: &BsplineSurface<3>) -> Vec<f64> {
        surface.points().iter().map(|point| point[1]).collect()
    }

    fn of(energy: &SymmetricBand, y: &[f64]) -> f64 {
        energy.apply(y).iter().zip(y).map(|(e, y)| e * y).sum()
    }

    #[test]
    fn small_slopes_give_the_parametric_energy() {
        for (degree, order) in [(3, 2), (3, 3), (5, 4)] {
            let flat = surface(degree, 0.0, |x, z| 1e-7 * ((0.31 * x).sin() + (0.9 * z + 0.05 * x).cos()));
            let y = half_breadths(&flat);
            let (parametric, exact) =
                (of(&energy(flat.u(), flat.v(), order, 0.6), &y), of(&true_energy(&flat, order, 0.6), &y));
            assert!((exact / parametric - 1.0).abs() < 1e-9, "order {order}: {exact:e} for {parametric:e}");
        }
    }

    /// Waterlines that bend by up to 45 degrees, the same at every height: int (dkappa/ds)^2 ds by its own formula.
    #[test]
    fn steep_waterlines_have_their_true_energy() {
        let hull = surface(3, 0.0, |x, _| 30.0 * (0.03 * x).sin());
        let y = half_breadths(&hull);
        let breaks = hull.u().breakpoints();
        let mut expected = 0.0;
        for piece in breaks.windows(2) {
            for (u, weight) in gauss_legendre(4).on(piece[0], piece[1]) {
                let d = hull.derivatives::<4>(u, 0.5);
                let (p, q, r) = (d[1][0][1] / 100.0, d[2][0][1] / 1e4, d[3][0][1] / 1e6);
                let w = 1.0 + p * p;
                let rate = (r / w.powf(1.5) - 3.0 * p * q * q / w.powf(2.5)) / w.sqrt();
                expected += 100.0 * weight * rate * rate * w.sqrt();
            }
        }
        // w^3 L^6 ds/L dz/H over H.
        let expected = expected * 0.6f64.powi(3) * 100f64.powi(5);
        let found = of(&true_energy(&hull, 3, 0.6), &y);
        assert!((found / expected - 1.0).abs() < 1e-10, "{found:e} for {expected:e}");
    }

    /// y = ((x + 3 z) / 40)^3 on a plumb and on a raked chart: the stations are the same curves, and so is their energy, where
    /// the raked chart is cut by other lines of the net.
    #[test]
    fn stations_of_a_raked_chart() {
        let cube = |skew: f64| {
            // A cubic is in the space of either chart; its control values by the blossom of ((100 u + skew v + 30 v) / 40)^3.
            let (u, v) = (KnotVector::uniform(3, 1).unwrap(), KnotVector::uniform(3, 1).unwrap());
            let mut points = Vec::new();
            for i in 0..4_u32 {
                for j in 0..4_u32 {
                    let (a, b): (f64, f64) = (100.0 / 40.0, (skew + 30.0) / 40.0);
                    // Coefficients of u^k v^(3-k) in Bernstein form: falling factorials.
                    let binomial = [1.0, 3.0, 3.0, 1.0];
                    let fall = |n: u32, k: u32| (0..k).map(|m| f64::from(n) - f64::from(m)).product::<f64>();
                    let y: f64 = (0..4_u32)
                        .map(|k| {
                            let term = binomial[k as usize] * a.powi(k as i32) * b.powi(3 - k as i32);
                            term * fall(i, k) / fall(3, k) * fall(j, 3 - k) / fall(3, 3 - k)
                        })
                        .sum();
                    points.push([100.0 * f64::from(i) / 3.0 + skew * f64::from(j) / 3.0, y, 10.0 * f64::from(j) / 3.0]);
                }
            }
            BsplineSurface::new(u, v, points).unwrap()
        };
        let raked = cube(20.0);
        // (dkappa/ds) of the station through a point of the raked chart, against the curve y(z) itself.
        let at = [0.3, 0.6];
        let basis: Vec<Vec<Vec<f64>>> = (0..=HIGHEST)
            .map(|a| {
                (0..=HIGHEST - a)
                    .map(|b| basis_row(&raked, at, [a, b]).into_iter().map(|(_, value)| value).collect())
                    .collect()
            })
            .collect();
        let point = Point { d: raked.derivatives::<5>(at[0], at[1]), basis: &basis };
        let form = point.form(true, 3).unwrap();
        let found: f64 = form.row.iter().zip(half_breadths(&raked)).map(|(a, y)| a * y).sum();
        let t = (100.0 * 0.3 + 50.0 * 0.6) / 40.0;
        let (p, q, r) = (9.0 * t * t / 40.0, 54.0 * t / 1600.0, 162.0 / 64000.0);
        let w: f64 = 1.0 + p * p;
        let expected = (r / w.powf(1.5) - 3.0 * p * q * q / w.powf(2.5)) / w.sqrt();
        assert!((found / expected - 1.0).abs() < 1e-11, "{found:e} for {expected:e}");
    }
}
