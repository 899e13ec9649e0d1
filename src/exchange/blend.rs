//! `blend.json`: how a blend is made of hulls.

use serde_json::{Value, json};

use super::derive::DerivedTarget;
use super::number::json_number;

/// A hull of a blend.
#[derive(Debug, Clone, PartialEq)]
pub struct BlendPart {
    /// Its name.
    pub name: String,
    /// Its weight.
    pub weight: f64,
    /// How far it moves when it is brought to the chart of the blend, normal to itself, at most \[m\].
    pub moved: f64,
    /// Its inflections of stations and waterlines.
    pub inflections: usize,
    /// What the targets are of it at the dimensions of the blend, in the order of the targets.
    pub values: Vec<f64>,
}

/// What `blend.json` holds.
#[derive(Debug, Clone, Copy)]
pub struct BlendReport<'a> {
    /// The hulls.
    pub hulls: &'a [BlendPart],
    /// The name of the hull that keeps its surface.
    pub base: &'a str,
    /// Whether volume, moments and areas are linear in the weights.
    pub is_linear: bool,
    /// The targets; the value of the scaled parent is that of equal weights.
    pub targets: &'a [DerivedTarget],
    /// Dimensions that were free.
    pub free: &'a [&'static str],
    /// Inflections of stations and waterlines of the blend.
    pub inflections: usize,
    /// Warnings.
    pub warnings: &'a [String],
}

/// `{"hulls", "base", "linear", "targets", "free", "inflections", "warnings"}`.
#[must_use]
pub fn blend_json(report: &BlendReport<'_>) -> Value {
    let hull = |part: &BlendPart| {
        json!({
            "name": part.name,
            "weight": json_number(Some(part.weight)),
            "moved_to_chart": json_number(Some(part.moved)),
            "inflections": part.inflections,
        })
    };
    let target = |(k, t): (usize, &DerivedTarget)| {
        let values: Vec<Value> = report.hulls.iter().map(|hull| json_number(hull.values.get(k).copied())).collect();
        json!({
            "key": t.key,
            "unit": t.unit,
            "of_hulls": values,
            "requested": json_number(Some(t.requested)),
            "achieved": json_number(Some(t.achieved)),
            "error": json_number(Some(t.achieved - t.requested)),
            "interval": t.interval.map(|ends| ends.map(|end| json_number(Some(end)))),
        })
    };
    json!({
        "hulls": report.hulls.iter().map(hull).collect::<Vec<_>>(),
        "base": report.base,
        "linear": report.is_linear,
        "targets": report.targets.iter().enumerate().map(target).collect::<Vec<_>>(),
        "free": report.free,
        "inflections": report.inflections,
        "warnings": report.warnings,
    })
}
