//! Hull families: one file a family, and the values they report.

pub mod analytic;
pub mod cosh;
mod kernel;
mod loft;
mod midship;
mod presets;
pub mod ucl_cosh;

pub use presets::ShipType;

/// A family with its parameters.
#[derive(Debug, Clone, PartialEq)]
pub enum Family {
    /// Hyperbolic-cosine waterlines solved for the particulars.
    Cosh(Box<cosh::DesignTargets>),
    /// The raw cosh generator.
    UclCosh(ucl_cosh::Parameters),
    /// Wigley hull.
    Wigley(analytic::Dimensions),
    /// Rectangular box.
    Box(analytic::Dimensions),
    /// Ellipsoid.
    Ellipsoid(analytic::Dimensions),
}

impl Family {
    /// The hull of the family for its parameters.
    ///
    /// # Errors
    /// Every infeasible target, at once.
    pub fn generate(&self, name: &str) -> Result<Generated, Vec<Infeasible>> {
        match self {
            Self::Cosh(requested) => cosh::generate(name, requested),
            Self::UclCosh(parameters) => ucl_cosh::generate(name, parameters),
            Self::Wigley(dimensions) => analytic::wigley(name, dimensions),
            Self::Box(dimensions) => analytic::rectangular_box(name, dimensions),
            Self::Ellipsoid(dimensions) => analytic::ellipsoid(name, dimensions),
        }
    }
}

/// Where a value came from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ValueOrigin {
    /// Written in the design.
    Given,
    /// Filled in from a preset or a formula.
    Preset,
    /// Found by the solver.
    Solved,
}

impl ValueOrigin {
    /// The word in files: `given`, `preset` or `solved`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Given => "given",
            Self::Preset => "preset",
            Self::Solved => "solved",
        }
    }
}

/// One value of a design: what the family was given, took from a preset, or solved.
#[derive(Debug, Clone, PartialEq)]
pub struct DesignValue {
    /// Key of the design file, `Cb`, `bilge_radius`, ...
    pub key: &'static str,
    /// What it is, in words.
    pub name: &'static str,
    /// The value, in `unit`.
    pub value: f64,
    /// Unit: `m`, `deg`, `-`, ...
    pub unit: &'static str,
    /// Where it came from.
    pub origin: ValueOrigin,
    /// The formula or preset it came from, or what it was solved for; empty when given.
    pub source: String,
}

/// A coefficient that was asked for and what the finished hull has.
#[derive(Debug, Clone, PartialEq)]
pub struct Target {
    /// Key of the quantity: `CB`, `CM`, `XCB`, `CWP`.
    pub key: &'static str,
    /// Requested value (XCB in metres from AP).
    pub requested: f64,
    /// Value of the B-spline hull, integrated exactly.
    pub achieved: f64,
    /// Where the request came from.
    pub origin: ValueOrigin,
}

/// An infeasible target, or a value outside its range.
#[derive(Debug, Clone, PartialEq)]
pub struct Infeasible {
    /// Code of the message, `E102`.
    pub code: &'static str,
    /// Keys of the design file that conflict, the first one to be shown.
    pub keys: Vec<&'static str>,
    /// What, with numbers, why, and the nearest feasible values.
    pub message: String,
}

/// A remark about a design that can be built: code and text.
#[derive(Debug, Clone, PartialEq)]
pub struct Remark {
    /// Code of the message, `W201`.
    pub code: &'static str,
    /// Key of the design file that it is about.
    pub key: &'static str,
    /// The text.
    pub message: String,
}

/// A generated hull with what was asked, filled in and solved.
#[derive(Debug, Clone)]
pub struct Generated {
    /// The hull.
    pub hull: crate::hull::Hull,
    /// Every value of the design with its origin.
    pub values: Vec<DesignValue>,
    /// Coefficients asked for and achieved.
    pub targets: Vec<Target>,
    /// Remarks.
    pub remarks: Vec<Remark>,
}

/// C_B, C_M, x of LCB \[m\] and C_WP of a hull at its design draught, on L_PP and B, integrated exactly.
fn achieved(hull: &crate::hull::Hull) -> [f64; 4] {
    use crate::hull::Functional;
    let p = *hull.particulars();
    let (l, b, t) = (p.length_between_perpendiculars, p.breadth, hull.reference_height());
    let volume = Functional::Volume.value(hull, t);
    [
        volume / (l * b * t),
        Functional::SectionArea { x: 0.5 * l }.value(hull, t) / (b * t),
        Functional::LongitudinalMoment.value(hull, t) / volume,
        Functional::WaterplaneArea.value(hull, t) / (l * b),
    ]
}
