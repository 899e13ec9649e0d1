//! `summary.json`: the design condition, what was asked and what was achieved.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::hull::PrincipalParticulars;

/// Main dimensions \[m\].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Particulars {
    /// Length between perpendiculars.
    #[serde(rename = "Lpp")]
    pub lpp: f64,
    /// Breadth.
    #[serde(rename = "B")]
    pub b: f64,
    /// Design draught; left out where nobody stated one.
    #[serde(rename = "T", default, skip_serializing_if = "Option::is_none")]
    pub t: Option<f64>,
    /// Depth.
    #[serde(rename = "D")]
    pub d: f64,
}

impl From<&PrincipalParticulars> for Particulars {
    fn from(p: &PrincipalParticulars) -> Self {
        Self { lpp: p.length_between_perpendiculars, b: p.breadth, t: p.draught, d: p.depth }
    }
}

impl From<&Particulars> for PrincipalParticulars {
    fn from(p: &Particulars) -> Self {
        Self { length_between_perpendiculars: p.lpp, breadth: p.b, draught: p.t, depth: p.d }
    }
}

/// A coefficient that was asked for.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TargetLine {
    /// `CB`, `CM`, `XCB`, `CWP`, `A@45.000`.
    pub key: String,
    /// Asked for; XCB in metres from AP.
    pub requested: f64,
    /// What the hull has.
    pub achieved: f64,
    /// achieved - requested
    pub error: f64,
    /// `given`, `preset`, `solved`.
    pub origin: &'static str,
}

/// One value of the design.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ValueLine {
    /// Key of the design file.
    pub key: &'static str,
    /// In words.
    pub name: &'static str,
    /// Value in its unit; null when it is not finite.
    pub value: Option<f64>,
    /// Unit.
    pub unit: &'static str,
    /// `given`, `preset`, `solved`.
    pub origin: &'static str,
    /// Formula or preset.
    pub source: String,
}

/// The design condition.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SummaryFile {
    /// Name of the ship.
    pub name: String,
    /// Family of the hull.
    pub family: &'static str,
    /// Main dimensions.
    pub particulars: Particulars,
    /// Every hydrostatic quantity at the design draught, by its ITTC code.
    pub design: Value,
    /// Coefficients asked for and achieved.
    pub targets: Vec<TargetLine>,
    /// Every value of the design with its origin.
    pub values: Vec<ValueLine>,
    /// Conventions of the quantities.
    pub conventions: Value,
    /// Remarks with their codes.
    pub remarks: Vec<String>,
}
