//! `grades.csv`: one table at several grades of fairness.

use super::fairing::status_word;
use super::number::{cell, line, to_decimals};
use crate::fairing::outcome::Outcome;
use crate::hydrostatics::Hydrostatics;
use crate::qp::Status;

/// What a fairing came to, as its exit code says it: `met`, `no fairer` or `compromise`.
#[must_use]
pub fn result_word(outcome: &Outcome) -> &'static str {
    match outcome.status {
        Status::Optimal if outcome.is_no_fairer() => "no fairer",
        Status::Optimal => "met",
        Status::Infeasible | Status::Unbounded | Status::Limit => "compromise",
    }
}

/// One row a grade: how it ended, changes of sign of curvature on stations and on waterlines, inflections of all lines,
/// moves \[m\], energy over that before (of a field, over that of the likeliest one), and hydrostatics at the design
/// draught. The energy is empty where that before is 0.
#[must_use]
pub fn grades_csv(grades: &[(&Outcome, Option<&Hydrostatics>)]) -> String {
    let head = [
        "grade",
        "status",
        "result",
        "changes of sign on stations",
        "changes of sign on waterlines",
        "inflections of all lines",
        "move RMS [m]",
        "largest move [m]",
        "energy / energy before",
        "displacement [m3]",
        "displacement [t]",
        "LCB [m]",
        "C_B",
    ];
    let mut csv = line(&head.map(str::to_owned));
    for (outcome, row) in grades {
        let (rms, largest, _) = outcome.moves();
        let [before, after] = outcome.energy;
        let rounded = |value: f64, decimals| cell(Some(to_decimals(value, decimals)));
        csv.push_str(&line(&[
            cell(Some(outcome.fairness.grade())),
            status_word(outcome.status).to_owned(),
            result_word(outcome).to_owned(),
            outcome.inflections("station")[1].to_string(),
            outcome.inflections("waterline")[1].to_string(),
            outcome.all_inflections()[1].to_string(),
            rounded(rms, 9),
            rounded(largest, 9),
            cell((before > 0.0).then(|| to_decimals(after / before, 6))),
            cell(row.map(|row| to_decimals(row.displacement_volume, 4))),
            cell(row.map(|row| to_decimals(row.displacement_mass, 4))),
            cell(row.and_then(|row| row.lcb).map(|lcb| to_decimals(lcb, 4))),
            cell(row.and_then(|row| row.block_coefficient).map(|block| to_decimals(block, 6))),
        ]));
    }
    csv
}
