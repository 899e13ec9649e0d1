//! The cosh family: waterlines of hyperbolic-cosine arcs on both ends of a prismatic body, solved for Cb, Cm, LCB and
//! Cwp.
//!
//! At each height z the waterline is y = b(z) f_E((x - xf) / (x_stem(z) - xf)) in the entrance, b(z) along the parallel
//! body and b(z) f_R((xa - x) / (xa - x_v(z))) in the run, where b is the midship section and f_E, f_R are blends of
//! the kernels J and S of equal fullness: S beside a parallel body (curvature 0 at the shoulder), J and S such that the
//! curvatures agree where there is none. The fullness of each end rises from keel to waterline by an exponential law,
//! which keeps waterlines nested: no tumblehome, sections do not cross, at most one inflection an end. The transom is a
//! plane cut of the run.
//!
//! The four numbers of fullness are solved for displacement, LCB and waterplane area; the net interpolates that form
//! and a last linear correction makes the coefficients of the B-spline hull exact (errors below 1e-12, see the tests).

mod book;
mod build;
mod form;
mod net;
mod refuse;
mod resolve;
mod solve;

use super::presets::ShipType;
use super::{Generated, Infeasible};

/// How the midship coefficient is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MidshipTarget {
    /// A number.
    Value(f64),
    /// Kerlen: Cm = 1.006 - 0.0056 Cb^-3.56.
    Kerlen,
    /// HSVA: Cm = 1 / (1 + (1 - Cb)^3.5).
    Hsva,
    /// Benford: Cm = 0.977 + 0.085 (Cb - 0.60).
    Benford,
}

/// What is asked of a hull of the cosh family; what is `None` gets a default. Lengths \[m\], angles \[rad\], x from AP.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DesignTargets {
    /// Type of ship whose preset fills what is left out.
    pub ship_type: Option<ShipType>,
    /// Lpp.
    pub length: f64,
    /// B.
    pub breadth: Option<f64>,
    /// T.
    pub draught: Option<f64>,
    /// D.
    pub depth: Option<f64>,
    /// Cb, on Lpp.
    pub block_coefficient: Option<f64>,
    /// Displaced volume \[m^3\]; with it Cb follows.
    pub displacement_volume: Option<f64>,
    /// Cm.
    pub midship_coefficient: Option<MidshipTarget>,
    /// x of the centre of buoyancy.
    pub lcb: Option<f64>,
    /// Cwp, on Lpp.
    pub waterplane_coefficient: Option<f64>,
    /// Parallel middle body from, to.
    pub parallel_body: Option<[f64; 2]>,
    /// Length of the entrance: fore end of the parallel body (or of the largest section) to FP.
    pub entrance_length: Option<f64>,
    /// Length of the run: AP to the aft end of the parallel body.
    pub run_length: Option<f64>,
    /// Radius of the bilge.
    pub bilge_radius: Option<f64>,
    /// Rise of floor angle.
    pub deadrise: Option<f64>,
    /// Breadth of the flat keel (full breadth).
    pub keel_breadth: Option<f64>,
    /// Rake of the stem, forward of the vertical, above and at the design waterline.
    pub stem_rake: Option<f64>,
    /// Distance by which the stem at the keel lies aft of FP.
    pub forefoot: Option<f64>,
    /// Breadth of the transom at the deck, a fraction of B.
    pub transom_breadth: Option<f64>,
    /// Height of the lowest point of the transom above the base line.
    pub transom_height: Option<f64>,
    /// Distance of the transom aft of AP.
    pub stern_overhang: Option<f64>,
    /// x at which the keel starts to rise aft.
    pub cut_up: Option<f64>,
    /// Mean angle of flare between the design waterline and the deck at x = 0.9 Lpp.
    pub flare: Option<f64>,
    /// Rise of the deck at side at FP above amidships.
    pub sheer_fore: Option<f64>,
    /// Rise of the deck at side at AP above amidships.
    pub sheer_aft: Option<f64>,
    /// Largest half angle of entrance of the design waterline.
    pub maximum_half_entrance: Option<f64>,
    /// Character of the sections: the exponent s of the vertical law; 0 linear, positive U, negative V.
    pub section_character: Option<f64>,
}

/// The hull that meets the targets.
///
/// # Errors
/// Every infeasible target, at once, with the nearest feasible values.
pub fn generate(name: &str, requested: &DesignTargets) -> Result<Generated, Vec<Infeasible>> {
    resolve::Resolved::new(requested)?.build(name)
}
