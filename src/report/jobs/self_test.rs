//! The analytic bodies: what the program finds against closed forms.
//!
//! Box: volume L B d, KB d/2, BM_T B^2/(12 d), BM_L L^2/(12 d), S = L B + 2 (L + B) d. Wigley hull at the draught d, with
//! s = 1 - d/T the depth of the waterline over T: volume (2/3) L B T (2/3 - s + s^3/3), A_W = (2/3) L B (1 - s^2),
//! I_T = (4/105) L B^3 (1 - s^2)^3, I_L = (1/30) B L^3 (1 - s^2). Half an ellipsoid: volume (2/3) pi a b c,
//! KB 5c/8, A_W = pi a b, I_T = pi a b^3 / 4, I_L = pi b a^3 / 4, C_M = pi/4; a hemisphere has S = 2 pi r^2.

use std::f64::consts::PI;

use crate::hydrostatics::{Conventions, CurvesOfForm, Quantity};
use crate::parametric::Family;
use crate::parametric::analytic::Dimensions;
use crate::report::failure::Failure;

/// One quantity of one body.
#[derive(Debug, Clone, PartialEq)]
pub struct SelfCheck {
    /// The body and its draught.
    pub body: String,
    /// ITTC code of the quantity.
    pub key: &'static str,
    /// What the program finds.
    pub ours: Option<f64>,
    /// The closed form.
    pub exact: f64,
    /// |ours - exact| / |exact|
    pub error: f64,
    /// The largest error that passes.
    pub tolerance: f64,
}

impl SelfCheck {
    /// Whether it passes.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.error <= self.tolerance
    }
}

type Exact = Vec<(&'static str, f64)>;

fn box_at(d: Dimensions, draught: f64) -> Exact {
    let (l, b) = (d.length, d.breadth);
    vec![
        ("DISPVOL", l * b * draught),
        ("XCB", 0.5 * l),
        ("KB", 0.5 * draught),
        ("AWL", l * b),
        ("IT", l * b.powi(3) / 12.0),
        ("IL", b * l.powi(3) / 12.0),
        ("BMT", b * b / (12.0 * draught)),
        ("BML", l * l / (12.0 * draught)),
        ("CB", 1.0),
        ("CM", 1.0),
        ("CWP", 1.0),
        ("S", l * b + 2.0 * (l + b) * draught),
    ]
}

fn wigley_at(d: Dimensions, draught: f64) -> Exact {
    let (l, b, t) = (d.length, d.breadth, d.draught);
    let s = 1.0 - draught / t;
    let waterline = 1.0 - s * s;
    let volume = 2.0 / 3.0 * l * b * t * (2.0 / 3.0 - s + s.powi(3) / 3.0);
    // The moment about the keel: the integral of t (1 - t^2) from s to 1 is (1 - s^2)^2 / 4, measured down from T.
    let moment = t * volume - 2.0 / 3.0 * l * b * t * t * waterline * waterline / 4.0;
    let inertia = [4.0 / 105.0 * l * b.powi(3) * waterline.powi(3), b * l.powi(3) / 30.0 * waterline];
    vec![
        ("DISPVOL", volume),
        ("XCB", 0.5 * l),
        ("KB", moment / volume),
        ("AWL", 2.0 / 3.0 * l * b * waterline),
        ("IT", inertia[0]),
        ("IL", inertia[1]),
        ("BMT", inertia[0] / volume),
        ("BML", inertia[1] / volume),
        ("CB", volume / (l * b * draught)),
        ("CWP", 2.0 / 3.0 * waterline),
    ]
}

fn ellipsoid_at(d: Dimensions, sphere: bool) -> Exact {
    let (a, b, c) = (0.5 * d.length, 0.5 * d.breadth, d.draught);
    let volume = 2.0 / 3.0 * PI * a * b * c;
    let mut exact = vec![
        ("DISPVOL", volume),
        ("XCB", a),
        ("KB", 0.625 * c),
        ("AWL", PI * a * b),
        ("IT", PI * a * b.powi(3) / 4.0),
        ("IL", PI * b * a.powi(3) / 4.0),
        ("BMT", 0.375 * b * b / c),
        ("BML", 0.375 * a * a / c),
        ("CB", PI / 6.0),
        ("CM", PI / 4.0),
        ("CWP", PI / 4.0),
    ];
    if sphere {
        exact.push(("S", 2.0 * PI * c * c));
    }
    exact
}

/// Every check of the analytic bodies.
///
/// # Errors
/// [`Failure::Internal`] when a body cannot be generated.
pub fn self_test() -> Result<Vec<SelfCheck>, Failure> {
    let dims = |length, breadth, draught, depth| Dimensions { length, breadth, draught, depth };
    let (boxed, wigley) = (dims(100.0, 20.0, 5.0, 10.0), dims(100.0, 10.0, 6.25, 10.0));
    let (ellipsoid, sphere) = (dims(60.0, 20.0, 8.0, 12.0), dims(12.0, 12.0, 6.0, 9.0));
    let cases = [
        ("box", Family::Box(boxed), 5.0, box_at(boxed, 5.0)),
        ("box", Family::Box(boxed), 2.0, box_at(boxed, 2.0)),
        ("Wigley", Family::Wigley(wigley), 6.25, wigley_at(wigley, 6.25)),
        ("Wigley", Family::Wigley(wigley), 2.5, wigley_at(wigley, 2.5)),
        ("ellipsoid", Family::Ellipsoid(ellipsoid), 8.0, ellipsoid_at(ellipsoid, false)),
        ("hemisphere", Family::Ellipsoid(sphere), 6.0, ellipsoid_at(sphere, true)),
    ];
    let mut checks = Vec::new();
    for (name, family, draught, exact) in cases {
        let hull = family
            .generate(name)
            .map_err(|reasons| {
                Failure::Internal(format!("{name}: {}", reasons.first().map_or("refused", |r| r.message.as_str())))
            })?
            .hull;
        let table = CurvesOfForm::new(&hull, &[draught], &Conventions::default());
        for (key, exact) in exact {
            let quantity = Quantity::of(key);
            let ours = quantity.zip(table.rows.first()).and_then(|(quantity, row)| (quantity.value)(row));
            let error = ours.map_or(f64::INFINITY, |ours| (ours - exact).abs() / exact.abs());
            let tolerance = if key == "S" { 1e-8 } else { 1e-10 };
            checks.push(SelfCheck { body: format!("{name} at {draught} m"), key, ours, exact, error, tolerance });
        }
    }
    Ok(checks)
}

/// The table of the self-test.
#[must_use]
pub fn self_test_page(checks: &[SelfCheck]) -> String {
    let mut page = format!("{:<20}{:<9}{:>18}{:>18}{:>9}\n", "body", "quantity", "ours", "exact", "error");
    for check in checks {
        let ours = check.ours.map_or_else(|| "-".to_owned(), |v| format!("{v:.8}"));
        let verdict = if check.passed() { "" } else { "  FAILED" };
        page.push_str(&format!(
            "{:<20}{:<9}{ours:>18}{:>18.8}{:>9.0e}{verdict}\n",
            check.body, check.key, check.exact, check.error
        ));
    }
    let failed = checks.iter().filter(|check| !check.passed()).count();
    page.push_str(&format!("{} of {} checks passed.\n", checks.len() - failed, checks.len()));
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn closed_forms_agree_with_the_coefficients_of_the_text_books() {
        let wigley = wigley_at(Dimensions { length: 1.0, breadth: 1.0, draught: 1.0, depth: 1.0 }, 1.0);
        let value = |key: &str| wigley.iter().find(|(k, _)| *k == key).unwrap().1;
        assert!((value("CB") - 4.0 / 9.0).abs() < 1e-15 && (value("KB") - 0.625).abs() < 1e-15);
        assert!((value("BMT") - 3.0 / 35.0).abs() < 1e-15 && (value("BML") - 0.075).abs() < 1e-15);
    }

    #[test]
    fn every_check_passes_and_a_wrong_number_would_not() {
        let mut checks = self_test().unwrap();
        assert!(checks.len() > 50);
        for check in &checks {
            assert!(check.passed(), "{check:?}");
        }
        checks[0].error = f64::INFINITY;
        assert!(!checks[0].passed());
    }
}
