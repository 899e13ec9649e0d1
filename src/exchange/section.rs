//! Plane sections as CSV and JSON: polylines, one a branch.

use serde_json::{Value, json};

use super::number::{cell, line};
use crate::hull::{Face, Section};

fn face(face: Face) -> &'static str {
    match face {
        Face::Side => "side",
        Face::Bottom => "bottom",
        Face::Transom => "transom",
        Face::Bow => "bow",
    }
}

/// `branch,x,y,z,face` \[m\], branches counted from 1; chords stay within `deviation` \[m\] of the curves.
#[must_use]
pub fn section_csv(section: &Section, deviation: f64) -> String {
    let mut text = String::from("branch,x,y,z,face\n");
    for (index, branch) in section.branches.iter().enumerate() {
        for point in branch.polyline(deviation) {
            let mut fields = vec![format!("{}", index + 1)];
            fields.extend(point.map(|c| cell(Some(c))));
            fields.push(face(branch.face).to_owned());
            text.push_str(&line(&fields));
        }
    }
    text
}

/// `{"deviation": m, "branches": [{"face", "closed", "points": [[x, y, z], ...]}]}`
#[must_use]
pub fn section_json(section: &Section, deviation: f64) -> Value {
    let branches: Vec<Value> = section
        .branches
        .iter()
        .map(|branch| {
            json!({ "face": face(branch.face), "closed": branch.closed, "points": branch.polyline(deviation) })
        })
        .collect();
    json!({ "deviation": deviation, "branches": branches })
}
