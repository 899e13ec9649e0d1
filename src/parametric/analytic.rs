//! Analytic test bodies: Wigley hull, box, ellipsoid.
//!
//! The Wigley hull and the box are polynomials and are represented exactly; the ellipsoid is graded by its angles, z =
//! T (1 - cos theta), x = L/2 (1 + sin theta sin phi), y = B/2 sin theta cos phi, and interpolated with degree 7, which
//! leaves it within 1e-14 B of the body (tested).

use std::f64::consts::{FRAC_PI_2, PI};

use super::loft;
use super::{DesignValue, Generated, Infeasible, Target, ValueOrigin};
use crate::hull::{Hull, HullError, PrincipalParticulars};
use crate::spline::KnotVector;

/// Main dimensions of a test body \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dimensions {
    /// L.
    pub length: f64,
    /// B.
    pub breadth: f64,
    /// T.
    pub draught: f64,
    /// D, at least T.
    pub depth: f64,
}

/// Range of a dimension \[m\].
pub(super) const LENGTHS: (f64, f64) = (0.01, 10_000.0);
/// Largest ratio of two dimensions.
pub(super) const LARGEST_RATIO: f64 = 2000.0;

impl Dimensions {
    fn particulars(&self) -> PrincipalParticulars {
        PrincipalParticulars {
            length_between_perpendiculars: self.length,
            breadth: self.breadth,
            draught: Some(self.draught),
            depth: self.depth,
        }
    }

    fn problems(&self, deepest: f64) -> Vec<Infeasible> {
        let mut problems = Vec::new();
        for (key, value) in [("Lpp", self.length), ("B", self.breadth), ("T", self.draught), ("D", self.depth)] {
            if !(LENGTHS.0..=LENGTHS.1).contains(&value) {
                problems.push(Infeasible {
                    code: "E101",
                    keys: vec![key],
                    message: format!("{key} is {value} m; it must be between {} and {} m", LENGTHS.0, LENGTHS.1),
                });
            }
        }
        let smallest = self.length.min(self.breadth).min(self.draught);
        if problems.is_empty() && self.length.max(self.breadth).max(self.depth) > LARGEST_RATIO * smallest {
            problems.push(Infeasible {
                code: "E101",
                keys: vec!["Lpp", "B", "T", "D"],
                message: format!(
                    "the dimensions differ by more than a factor of {LARGEST_RATIO}; the smallest is {smallest} m"
                ),
            });
        }
        if problems.is_empty() && !(self.draught..=deepest * self.draught).contains(&self.depth) {
            let upper = if deepest.is_finite() {
                format!(" and at most {:.3} m", deepest * self.draught)
            } else {
                String::new()
            };
            problems.push(Infeasible {
                code: "E105",
                keys: vec!["D", "T"],
                message: format!(
                    "D {:.3} m does not suit T {:.3} m: it must be at least {:.3} m{upper}",
                    self.depth, self.draught, self.draught
                ),
            });
        }
        problems
    }

    fn finish(
        &self,
        hull: Result<Hull, HullError>,
        coefficients: [(&'static str, f64); 4],
    ) -> Result<Generated, Vec<Infeasible>> {
        let hull = hull.map_err(|error| {
            vec![Infeasible { code: "E101", keys: vec!["Lpp", "B", "T", "D"], message: error.to_string() }]
        })?;
        let given = |key, name, value| DesignValue {
            key,
            name,
            value,
            unit: "m",
            origin: ValueOrigin::Given,
            source: String::new(),
        };
        let achieved = super::achieved(&hull);
        Ok(Generated {
            values: vec![
                given("Lpp", "length between perpendiculars", self.length),
                given("B", "breadth", self.breadth),
                given("T", "draught", self.draught),
                given("D", "depth", self.depth),
            ],
            targets: coefficients
                .into_iter()
                .zip(achieved)
                .map(|((key, requested), achieved)| Target { key, requested, achieved, origin: ValueOrigin::Preset })
                .collect(),
            remarks: Vec::new(),
            hull,
        })
    }
}

/// y = (B/2) (1 - (2x/L)^2) (1 - (z/T)^2), x from midship and z down from the waterline; wall-sided above it.
///
/// # Errors
/// Dimensions outside their ranges.
pub fn wigley(name: &str, dimensions: &Dimensions) -> Result<Generated, Vec<Infeasible>> {
    let d = dimensions;
    let problems = d.problems(f64::INFINITY);
    if !problems.is_empty() {
        return Err(problems);
    }
    let hull = || {
        let u = KnotVector::uniform(3, 20)?;
        let freeboard = d.depth > d.draught;
        let mut heights: Vec<f64> = (0..=10).map(|k| d.draught * f64::from(k) / 10.0).collect();
        let mut times = vec![1; 9];
        if freeboard {
            heights.extend([0.5 * (d.draught + d.depth), d.depth]);
            times.extend([2, 1]);
        }
        let v = KnotVector::from_breakpoints(3, &heights, &times)?;
        let z = v.greville();
        let lengths: Vec<f64> = u.greville().iter().map(|s| s * d.length).collect();
        let x: Vec<f64> = lengths.iter().flat_map(|&x| std::iter::repeat_n(x, z.len())).collect();
        let y = loft::interpolate_tensor(&u, &v, |s, z| {
            let (x, below) = (2.0 * s - 1.0, (1.0 - z / d.draught).max(0.0));
            0.5 * d.breadth * (1.0 - x * x) * (1.0 - below * below)
        })?;
        loft::level_hull(name, d.particulars(), loft::surface(&u, &v, &x, &y, &z)?)
    };
    d.finish(hull(), [("CB", 4.0 / 9.0), ("CM", 2.0 / 3.0), ("XCB", 0.5 * d.length), ("CWP", 2.0 / 3.0)])
}

/// A rectangular box.
///
/// # Errors
/// Dimensions outside their ranges.
pub fn rectangular_box(name: &str, dimensions: &Dimensions) -> Result<Generated, Vec<Infeasible>> {
    let d = dimensions;
    let problems = d.problems(f64::INFINITY);
    if !problems.is_empty() {
        return Err(problems);
    }
    let hull = || {
        let (u, v) = (KnotVector::uniform(3, 4)?, KnotVector::uniform(3, 4)?);
        let z: Vec<f64> = v.greville().iter().map(|t| t * d.depth).collect();
        let x: Vec<f64> = u.greville().iter().flat_map(|s| std::iter::repeat_n(s * d.length, z.len())).collect();
        let y = vec![0.5 * d.breadth; x.len()];
        loft::level_hull(name, d.particulars(), loft::surface(&u, &v, &x, &y, &z)?)
    };
    d.finish(hull(), [("CB", 1.0), ("CM", 1.0), ("XCB", 0.5 * d.length), ("CWP", 1.0)])
}

/// An ellipsoid with semi-axes L/2, B/2 and T, its centre at the design waterline; D at most 1.95 T.
///
/// # Errors
/// Dimensions outside their ranges.
pub fn ellipsoid(name: &str, dimensions: &Dimensions) -> Result<Generated, Vec<Infeasible>> {
    let d = dimensions;
    let problems = d.problems(1.95);
    if !problems.is_empty() {
        return Err(problems);
    }
    let hull = || {
        let top = (1.0 - d.depth / d.draught).acos();
        let u = KnotVector::uniform(7, 24)?;
        // A knot at the waterline, where theta = pi/2, whatever the depth.
        let above = ((top - FRAC_PI_2) / FRAC_PI_2 * 12.0).ceil() as usize;
        let mut angles: Vec<f64> = (0..=12).map(|k| FRAC_PI_2 * f64::from(k) / 12.0).collect();
        if top > FRAC_PI_2 + 1e-9 {
            angles.extend((1..=above).map(|k| FRAC_PI_2 + (top - FRAC_PI_2) * k as f64 / above as f64));
        }
        let v = KnotVector::from_breakpoints(7, &angles, &vec![1; angles.len() - 2])?;
        let z = loft::interpolate(&v, |theta| 2.0 * d.draught * (0.5 * theta).sin().powi(2))?;
        let phi = |s: f64| PI * (s - 0.5);
        let mut x = loft::interpolate_tensor(&u, &v, |s, theta| 0.5 * d.length * (1.0 + theta.sin() * phi(s).sin()))?;
        let mut y = loft::interpolate_tensor(&u, &v, |s, theta| 0.5 * d.breadth * theta.sin() * phi(s).cos())?;
        let columns = v.basis_count();
        let last = u.basis_count() - 1;
        for j in 0..columns {
            (y[j], y[last * columns + j]) = (0.0, 0.0);
        }
        // The pole on the keel is one point.
        for row in 0..=last {
            (x[row * columns], y[row * columns]) = (0.5 * d.length, 0.0);
        }
        loft::level_hull(name, d.particulars(), loft::surface(&u, &v, &x, &y, &z)?)
    };
    d.finish(hull(), [("CB", PI / 6.0), ("CM", PI / 4.0), ("XCB", 0.5 * d.length), ("CWP", PI / 4.0)])
}
