//! The raw generator of the UCL design-building-block lineage, as in `.hgf` files.
//!
//! With a_x = pi times the fullness number x and arc(s, a) = arccosh(1 + s (cosh a - 1)) / a:
//! * midship half-breadth b(z) = (B/2) arc(z/D, a_ms), full at the deck;
//! * stem profile x_bow(z) = L (k + (1 - k) arc(z/D, a_bow));
//! * forward waterline, x >= L/2: y = b(z) (1 - (cosh(a t) - 1) / (cosh a - 1)), t = (x - L/2) / (x_bow - L/2),
//!   a = pi (m_deck z/D + 0.001);
//! * transom half-breadth t(z) = tb (B/2) arc((z - zt) / (D - zt), a_tr) above its tip zt = td D, 0 below; the stern
//!   profile is the transom, x = (D - z) tan(slope), down to the tip, then a straight line to x = acu L on the keel;
//! * aft waterline, x <= L/2: the circular arc that is tangent to y = b at L/2 and passes through the end of the transom.
//!
//! The parameters of the surface are graded so that y is smooth where b and t rise like square roots: below the tip z/D
//! = (cosh(a_ms s) - 1) / (cosh a_ms - 1), above it (z - zt) / (D - zt) = (cosh(a_tr w) - 1) / (cosh a_tr - 1). At the
//! tip the surface has a corner line along v, as the family has. Bicubic; volume and waterplane areas within 1e-5 of
//! the formulas (tested).

use std::f64::consts::PI;

use super::kernel::{Kernel, Shape};
use super::loft;
use super::{DesignValue, Generated, Infeasible, ValueOrigin};
use crate::hull::PrincipalParticulars;
use crate::spline::KnotVector;

/// Raw parameters, named as in `.hgf` files.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameters {
    /// LOA \[m\]
    pub length: f64,
    /// BOA \[m\]
    pub breadth: f64,
    /// D \[m\]
    pub depth: f64,
    /// Design draught \[m\].
    pub draught: f64,
    /// `ms_val`: midship fullness, a = ms pi.
    pub midship_fullness: f64,
    /// `bow_val`: bow profile.
    pub bow: f64,
    /// `tr_stern_val`: transom fullness.
    pub transom_fullness: f64,
    /// `deck_val`: fullness of the forward deck line.
    pub forward_deck: f64,
    /// `tb_val`: transom breadth at the deck over BOA.
    pub transom_breadth_ratio: f64,
    /// `td_val`: height of the transom tip over D.
    pub transom_tip_ratio: f64,
    /// `acu_val`: aft cut-up over LOA.
    pub aft_cut_up_ratio: f64,
    /// `kf_val`: fore end of the keel over LOA.
    pub keel_forward_ratio: f64,
    /// `sa_val`: slope of the transom from the vertical \[rad\].
    pub side_slope: f64,
}

/// Range of one raw parameter: key, words, value, lowest, highest.
type ParameterRow = (&'static str, &'static str, f64, f64, f64);

impl Parameters {
    fn rows(&self) -> [ParameterRow; 13] {
        let (least, most) = super::analytic::LENGTHS;
        [
            ("Lpp", "length overall", self.length, least, most),
            ("B", "breadth overall", self.breadth, least, most),
            ("T", "draught", self.draught, least, most),
            ("D", "depth", self.depth, least, most),
            ("ms", "midship fullness", self.midship_fullness, 0.001, 10.0),
            ("bow", "bow profile", self.bow, 0.001, 10.0),
            ("transom", "transom fullness", self.transom_fullness, 0.001, 10.0),
            ("deck", "fullness of the forward deck line", self.forward_deck, 0.0, 10.0),
            ("tb", "transom breadth ratio", self.transom_breadth_ratio, 0.0, 1.0),
            ("td", "transom tip ratio", self.transom_tip_ratio, 0.02, 0.98),
            ("acu", "aft cut-up ratio", self.aft_cut_up_ratio, 0.0, 0.45),
            ("kf", "keel forward ratio", self.keel_forward_ratio, 0.55, 1.0),
            ("sa", "side slope", self.side_slope, 0.0, 1.0),
        ]
    }

    fn problems(&self) -> Vec<Infeasible> {
        let mut problems: Vec<Infeasible> = self
            .rows()
            .into_iter()
            .filter(|&(_, _, value, low, high)| !(value.is_finite() && (low..=high).contains(&value)))
            .map(|(key, name, value, low, high)| {
                let range = format!("between {low} and {high}");
                Infeasible {
                    code: "E101",
                    keys: vec![key],
                    message: format!("{key} ({name}) is {value}; it must be {range}"),
                }
            })
            .collect();
        if problems.is_empty() {
            let smallest = self.breadth.min(self.draught).min(self.length);
            if self.length.max(self.breadth).max(self.depth) > super::analytic::LARGEST_RATIO * smallest {
                problems.push(Infeasible {
                    code: "E101",
                    keys: vec!["Lpp", "B", "T", "D"],
                    message: format!(
                        "the dimensions differ by more than a factor of {}; the smallest is {smallest} m",
                        super::analytic::LARGEST_RATIO
                    ),
                });
            }
            if self.draught > self.depth {
                problems.push(Infeasible {
                    code: "E105",
                    keys: vec!["T", "D"],
                    message: format!("T {:.3} m exceeds depth D {:.3} m", self.draught, self.depth),
                });
            }
            let tip = (self.depth - self.tip()) * self.side_slope.tan();
            if tip > self.aft_cut_up_ratio * self.length || tip > 0.45 * self.length {
                problems.push(Infeasible {
                    code: "E109",
                    keys: vec!["sa", "acu"],
                    message: format!(
                        "the transom tip lies at x = {tip:.3} m, forward of the cut-up at {:.3} m; lower sa or raise acu",
                        self.aft_cut_up_ratio * self.length
                    ),
                });
            }
        }
        problems
    }

    fn tip(&self) -> f64 {
        self.transom_tip_ratio * self.depth
    }

    fn stern(&self, z: f64) -> f64 {
        let (tip, slope) = (self.tip(), self.side_slope.tan());
        if z >= tip {
            (self.depth - z) * slope
        } else {
            let (at_tip, cut_up) = ((self.depth - tip) * slope, self.aft_cut_up_ratio * self.length);
            cut_up + (at_tip - cut_up) * z / tip
        }
    }

    fn stem(&self, z: f64) -> f64 {
        let k = self.keel_forward_ratio;
        self.length * (k + (1.0 - k) * arc(z / self.depth, PI * self.bow))
    }

    /// Half-breadth at `x` on the waterline `z`; `transom` is t(z).
    fn half_breadth(&self, x: f64, z: f64, transom: f64) -> f64 {
        let middle = 0.5 * self.length;
        let b = 0.5 * self.breadth * arc(z / self.depth, PI * self.midship_fullness);
        if x >= middle {
            let a = PI * (self.forward_deck * z / self.depth + 0.001);
            b * Shape::new(Kernel::J, a * a).value((x - middle) / (self.stem(z) - middle))
        } else {
            let (n, run, d) = (b - transom, middle - self.stern(z), middle - x);
            let curvature = 2.0 * n / (n * n + run * run);
            b - curvature * d * d / (1.0 + (1.0 - (curvature * d).powi(2)).max(0.0).sqrt())
        }
    }
}

/// arccosh(1 + s (cosh a - 1)) / a, exact near s = 0.
fn arc(s: f64, a: f64) -> f64 {
    let e = s.max(0.0) * 2.0 * (0.5 * a).sinh().powi(2);
    (e + (e * (e + 2.0)).sqrt()).ln_1p() / a
}

/// (cosh(a s) - 1) / (cosh a - 1), the inverse of [`arc`].
fn rise(s: f64, a: f64) -> f64 {
    ((0.5 * a * s).sinh() / (0.5 * a).sinh()).powi(2)
}

/// The hull of the raw parameters.
///
/// # Errors
/// Every parameter outside its range.
pub fn generate(name: &str, parameters: &Parameters) -> Result<Generated, Vec<Infeasible>> {
    let p = *parameters;
    let problems = p.problems();
    if !problems.is_empty() {
        return Err(problems);
    }
    let (tip, ms, tr) = (p.tip(), PI * p.midship_fullness, PI * p.transom_fullness);
    // v in [0, 1] below the tip, [1, 2] above.
    let lower = arc(tip / p.depth, ms);
    let height = |v: f64| {
        if v <= 1.0 { p.depth * rise(v * lower, ms) } else { tip + (p.depth - tip) * rise(v - 1.0, tr) }
    };
    let transom = |v: f64| if v <= 1.0 { 0.0 } else { 0.5 * p.breadth * p.transom_breadth_ratio * (v - 1.0) };
    let middle = 0.5 * p.length;
    // The shortest waterline end rules the linear part of x(u), so that x_u stays positive.
    let (aft, fore) = (p.aft_cut_up_ratio * p.length, p.keel_forward_ratio * p.length);
    let shoulder = (middle - aft) / (fore - aft);
    let x_at = |u: f64, z: f64| {
        let run = (1.0 - u / shoulder).max(0.0).powi(3);
        let entrance = ((u - shoulder) / (1.0 - shoulder)).max(0.0).powi(3);
        aft + (fore - aft) * u + (p.stern(z) - aft) * run + (p.stem(z) - fore) * entrance
    };
    let hull = || {
        let spans = 18;
        let mut breaks: Vec<f64> = (0..=spans).map(|k| shoulder * f64::from(k) / f64::from(spans)).collect();
        breaks.extend((1..=spans).map(|k| shoulder + (1.0 - shoulder) * f64::from(k) / f64::from(spans)));
        let mut times = vec![1; breaks.len() - 2];
        times[spans as usize - 1] = 2;
        let u = KnotVector::from_breakpoints(3, &breaks, &times)?;
        let half = 8;
        let levels: Vec<f64> = (0..=2 * half).map(|k| f64::from(k) / f64::from(half)).collect();
        let mut times = vec![1; levels.len() - 2];
        times[half as usize - 1] = 3;
        let v = KnotVector::from_breakpoints(3, &levels, &times)?;
        let z = loft::interpolate(&v, height)?;
        let x = loft::interpolate_tensor(&u, &v, |u, v| x_at(u, height(v)))?;
        let mut y = loft::interpolate_tensor(&u, &v, |u, v| {
            let z = height(v);
            p.half_breadth(x_at(u, z), z, transom(v))
        })?;
        for value in &mut y {
            // The stem, the keel and the profile below the tip lie on the centreplane: clear what rounding left.
            if value.abs() < 1e-12 * p.breadth {
                *value = 0.0;
            }
        }
        let particulars = PrincipalParticulars {
            length_between_perpendiculars: p.length,
            breadth: p.breadth,
            draught: Some(p.draught),
            depth: p.depth,
        };
        loft::level_hull(name, particulars, loft::surface(&u, &v, &x, &y, &z)?)
    };
    let hull = hull().map_err(|error: crate::hull::HullError| {
        vec![Infeasible { code: "E101", keys: vec!["Lpp"], message: error.to_string() }]
    })?;
    let values = p
        .rows()
        .into_iter()
        .enumerate()
        .map(|(k, (key, name, value, _, _))| DesignValue {
            key,
            name,
            value,
            unit: match k {
                0..4 => "m",
                12 => "rad",
                _ => "-",
            },
            origin: ValueOrigin::Given,
            source: String::new(),
        })
        .collect();
    Ok(Generated { hull, values, targets: Vec::new(), remarks: Vec::new() })
}
