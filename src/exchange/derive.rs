//! `derive.json`: how a daughter was derived.

use serde_json::{Value, json};

use super::number::json_number;
use super::waves::waves_json;
use crate::hull::SurfaceDistance;
use crate::resistance::WaveResult;

/// A target of a daughter.
#[derive(Debug, Clone, PartialEq)]
pub struct DerivedTarget {
    /// Key of its quantity: `DISPVOL`, `XCB`, `CM`, `A@45.000`, ...
    pub key: String,
    /// Unit, `-` for none.
    pub unit: &'static str,
    /// `given` or `kept`.
    pub origin: &'static str,
    /// The value of the parent at the dimensions of the daughter.
    pub scaled: f64,
    /// The value that is wanted.
    pub requested: f64,
    /// The value of the daughter.
    pub achieved: f64,
    /// Shadow price: derivative of the optimum by the relative change of the target, of LCB and LCF by that over L_PP \[m^2\].
    pub price: Option<f64>,
    /// Least and greatest value with the others as they are.
    pub interval: Option<[f64; 2]>,
    /// Whether signs of curvature are kept all over it.
    pub keeps_signs: bool,
}

/// What `derive.json` holds.
#[derive(Debug, Clone)]
pub struct DeriveReport<'a> {
    /// Name of the parent.
    pub parent: &'a str,
    /// The word of the method.
    pub method: &'static str,
    /// The targets.
    pub targets: &'a [DerivedTarget],
    /// Amplitudes of the shift of the aft and the fore body, and the least and the greatest at which it folds.
    pub shift: Option<[[f64; 2]; 3]>,
    /// C_B that the shift alone reaches.
    pub shift_reach: Option<[f64; 2]>,
    /// Bending energy of the change \[m^2\], duality gap over the optimum, programs.
    pub program: (f64, f64, usize),
    /// Limits that bound it: what they are about, how many, and the derivative of the optimum by a slack that all of them get.
    pub limits: Vec<(&'static str, usize, f64)>,
    /// Ends of the parallel body that is held \[m\].
    pub parallel_body: Option<[f64; 2]>,
    /// Inflections of stations and waterlines, of the scaled parent and of the daughter.
    pub inflections: [usize; 2],
    /// Ends of the parallel middle body of the scaled parent and of the daughter \[m\].
    pub middle_bodies: [Option<[f64; 2]>; 2],
    /// Heights and positions \[m\] that lines of the scaled parent come from and to.
    pub moved_lines: [&'a [[f64; 2]]; 2],
    /// How far the daughter is from the scaled parent.
    pub moved: Option<SurfaceDistance>,
    /// The wave resistance, where it is made small.
    pub waves: Option<&'a WaveResult>,
    /// Warnings.
    pub warnings: &'a [String],
}

/// `{"parent", "method", "targets", "shift", "program", "parallel_body", "inflections", "moved_from_scaled_parent", "wave_resistance", "warnings"}`.
#[must_use]
pub fn derive_json(report: &DeriveReport<'_>) -> Value {
    let target = |t: &DerivedTarget| {
        json!({
            "key": t.key,
            "unit": t.unit,
            "origin": t.origin,
            "scaled_parent": json_number(Some(t.scaled)),
            "requested": json_number(Some(t.requested)),
            "achieved": json_number(Some(t.achieved)),
            "error": json_number(Some(t.achieved - t.requested)),
            "shadow_price": json_number(t.price),
            "interval": t.interval.map(|ends| ends.map(|end| json_number(Some(end)))),
            "interval_keeps_signs": t.interval.map(|_| t.keeps_signs),
        })
    };
    let shift = report.shift.map(|[amplitudes, low, high]| {
        json!({ "aft_fore": amplitudes, "folds_below": low, "folds_above": high, "CB_alone": report.shift_reach })
    });
    let (energy, gap, programs) = report.program;
    let limit = |(kind, count, price): &(&str, usize, f64)| json!({ "kind": kind, "binding": count, "shadow_price": json_number(Some(*price)) });
    let limits: Vec<Value> = report.limits.iter().map(limit).collect();
    let moved = report.moved.map(|d| json!({ "largest": d.largest, "at": d.at, "rms": d.rms }));
    json!({
        "parent": report.parent,
        "method": report.method,
        "targets": report.targets.iter().map(target).collect::<Vec<_>>(),
        "shift": shift,
        "program": { "energy": json_number(Some(energy)), "gap": json_number(Some(gap)), "limits": limits, "solved": programs },
        "parallel_body": report.parallel_body,
        "inflections": { "scaled_parent": report.inflections[0], "daughter": report.inflections[1] },
        "moved_from_scaled_parent": moved,
        "moved_lines": { "heights": report.moved_lines[0], "positions": report.moved_lines[1] },
        "parallel_middle_body": {
            "scaled_parent": report.middle_bodies[0].map(|ends| ends.map(|end| json_number(Some(end)))),
            "daughter": report.middle_bodies[1].map(|ends| ends.map(|end| json_number(Some(end)))),
        },
        "wave_resistance": report.waves.map(waves_json),
        "warnings": report.warnings,
    })
}
