//! `fairing.json`, the certificate of a fair hull, and `changes.csv`, every offset before and after.

use serde_json::{Value, json};

use super::number::{cell, json_number, line, to_decimals};
use super::waves::waves_json;
use crate::fairing::bends::Line;
use crate::fairing::change::Change;
use crate::fairing::constraint::Constraint;
use crate::fairing::field::line_errors::{FoundErrors, ShiftedLine};
use crate::fairing::inspect::PolygonSigns;
use crate::fairing::outcome::Outcome;
use crate::fairing::proposals::Proposal;
use crate::fairing::record::TableLines;
use crate::fairing::surface::Origin;
use crate::hull::{Cut, LineKind, OffsetTable, SideKind};
use crate::qp::Status;

/// What writing the fair table in its notation did.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RoundingEffect {
    /// Largest change of an offset \[m\].
    pub largest: f64,
    /// Root of the mean square of all changes \[m\].
    pub root_mean_square: f64,
    /// Volume of the surface through the written table less that through the exact one \[m^3\]; none when either is not
    /// there.
    pub volume: Option<f64>,
    /// The same over the volume.
    pub volume_share: Option<f64>,
}

/// The word for the end of the program.
#[must_use]
pub fn status_word(status: Status) -> &'static str {
    match status {
        Status::Optimal => "optimal",
        Status::Infeasible => "infeasible",
        Status::Unbounded => "unbounded",
        Status::Limit => "limit",
    }
}

/// The line above a table or the points of a curve that do not meet all targets.
pub const COMPROMISE_LINE: &str = "# compromise: not all targets are met; fairing.json lists those that are not";

/// Moves below this \[m\] are none: without the target the objective falls, but the moves need not.
pub const NO_MOVE: f64 = 5e-7;

/// What a target costs, as "holding LCB costs 0.42 mm RMS".
#[must_use]
pub fn priced(words: &str, price: f64) -> String {
    if price.is_nan() {
        return format!("what holding {words} costs was not found");
    }
    if price < NO_MOVE {
        return format!("holding {words} costs no moves");
    }
    let value = 1e3 * price;
    let decimals = if value >= 10.0 {
        1
    } else if value >= 0.1 {
        2
    } else {
        3
    };
    format!("holding {words} costs {value:.decimals$} mm RMS")
}

fn at(cut: &Cut) -> f64 {
    match *cut {
        Cut::Station { x } => x,
        Cut::Waterline { z } => z,
        Cut::Buttock { y } => y,
        Cut::Diagonal { height, .. } => height,
        Cut::Plane { offset, .. } => offset,
    }
}

fn number(value: f64) -> Value {
    json_number(Some(value))
}

/// Inflections, monotone pieces of curvature and its total variation over its range of one kind of curve; `kind` as [`crate::fairing::inspect::kind`] names it. `asked` is the number that the
/// signs of the program were made for, `allowed` the most that its rows admit: no more than before, or than was asked.
fn inflections(outcome: &Outcome, kind: &str) -> Vec<Value> {
    let list = outcome.turns.iter().filter(|turns| crate::fairing::inspect::kind(&turns.cut) == kind);
    list.map(|turns| {
        let [pieces, variation] = [turns.pieces.map(Value::from), turns.variation.map(json_number)];
        let mut entry = json!({
            "at": number(at(&turns.cut)), "before": turns.before, "after": turns.after,
            "pieces": { "before": pieces[0], "after": pieces[1], "least": turns.least_pieces() },
            "variation": { "before": variation[0], "after": variation[1] },
        });
        if let Some((count, proved)) = turns.minimum {
            entry["minimum"] = json!(count);
            entry["minimum_proved"] = json!(proved);
        }
        // Nothing may bend more often than before.
        entry["allowed"] = json!(turns.before);
        let Some(line) = Line::of(turns.cut) else { return entry };
        let asked = outcome.faired.fewer.iter().flat_map(|fewer| &fewer.asked);
        if let Some((_, most, price)) = asked.into_iter().find(|(other, ..)| *other == line) {
            // What the signs leave room for, in the dead band and between their places, is allowed too.
            entry["asked"] = json!(most);
            entry["allowed"] = json!(turns.after.min(turns.before).max(*most));
            entry["price"] = number(*price);
        }
        entry
    })
    .collect()
}

/// How fair stations and waterlines are together, and the surface, before and after.
fn fair(outcome: &Outcome) -> Value {
    let [signs, signs_after] = outcome.changes_of_sign();
    let [pieces, pieces_after] = outcome.monotone_pieces();
    let [regions, regions_after] = outcome.regions;
    let [variation, variation_after] = outcome.variation().map_or([None; 2], |pair| pair.map(Some)).map(json_number);
    json!({
        "changes_of_sign": { "before": signs, "after": signs_after, "least": outcome.least_changes_of_sign() },
        "monotone_pieces": { "before": pieces, "after": pieces_after, "least": outcome.least_monotone_pieces() },
        // The median of the lines.
        "variation": { "before": variation, "after": variation_after },
        "gaussian_regions": { "before": regions, "after": regions_after },
    })
}

/// Why the targets are infeasible: the least factor on the tolerances, and for each constraint alone what the others
/// leave it, in the unit of its quantity.
fn diagnosis(outcome: &Outcome) -> Value {
    let Some(found) = &outcome.faired.diagnosis else { return Value::Null };
    let reaches: Vec<Value> = found
        .reaches
        .iter()
        .filter_map(|reach| {
            let held = outcome.held.get(reach.constraint)?;
            let [low, high] = reach.values.map_or([None; 2], |ends| ends.map(Some));
            Some(json!({
                "kind": held.constraint.key(), "least": json_number(low), "greatest": json_number(high),
                "target": number(held.constraint.target()),
            }))
        })
        .collect();
    let rules: Vec<Value> = found
        .rules
        .iter()
        .filter_map(|(rule, give)| {
            let held = outcome.rules.get(*rule)?;
            Some(json!({ "kind": held.rule.key(), "name": held.rule.words(), "slack": json_number(*give) }))
        })
        .collect();
    let cheapest = found.cheapest().and_then(|reach| outcome.held.get(reach.constraint));
    json!({
        "widening": json_number(found.widening),
        "widening_of_smooth_move": json_number(outcome.faired.carried),
        "nearest": outcome.nearest,
        "alone": reaches,
        "rules": rules,
        "cheapest": cheapest.map(|held| held.constraint.key()),
    })
}

/// Signs of the rows and columns of a net: + outboard of the chord of the neighbours, - inboard, 0 on it.
fn polygon(lines: &[PolygonSigns]) -> Vec<Value> {
    let of = |line: &PolygonSigns| {
        json!({
            "line": line.line.as_str(), "index": line.index, "at": number(line.at), "signs": line.text(),
            "changes": line.changes, "enclosed": line.enclosed,
        })
    };
    lines.iter().map(of).collect()
}

/// The same as a table, of both nets: one row a row or column, from aft forward or from bottom to top.
#[must_use]
pub fn control_polygon_csv(outcome: &Outcome) -> String {
    let mut csv = line(&["net", "line", "index", "at [m]", "changes", "enclosed", "signs"].map(str::to_owned));
    for (net, lines) in ["before", "after"].iter().zip(&outcome.signs) {
        for of in lines {
            csv.push_str(&line(&[
                (*net).to_owned(),
                of.line.as_str().to_owned(),
                of.index.to_string(),
                cell(Some(of.at)),
                of.changes.to_string(),
                of.enclosed.to_string(),
                // Not a number, whatever reads it.
                format!("'{}", of.text()),
            ]));
        }
    }
    csv
}

/// A line that the table does not declare, and what it would bring.
fn proposed(proposal: &Proposal) -> Value {
    let line = &proposal.line;
    json!({
        "id": format!("L{}", proposal.number), "kind": line.kind.as_str(), "course": line.course.as_str(),
        "at": number(line.at), "reach": line.reach.map(number), "gain": number(line.gain),
        "rms_without": json_number(proposal.rms.map(|rms| rms[0])), "rms_with": json_number(proposal.rms.map(|rms| rms[1])),
        "objective_gain": json_number(proposal.gain), "accepted": proposal.accepted,
    })
}

fn place(table: &OffsetTable, change: &Change) -> Value {
    let station = table.stations.get(change.station).map(|station| &station.station.name);
    json!({
        "station": station, "waterline": change.origin.waterline().and_then(|j| table.waterlines.get(j)),
        "x": number(change.x), "z": number(change.z),
        "before": number(change.before), "after": number(change.after), "move": number(change.after - change.before),
    })
}

/// Lines that are shifted and turned, with what each is too wide by at the two ends \[m\].
fn of_lines(found: &FoundErrors) -> Value {
    let line = |line: &ShiftedLine| json!({ "at": number(line.at), "too_wide": line.ends.map(number) });
    json!({
        "course": found.course.as_str(), "rms": number(found.rms), "gain": number(found.gain),
        "ends": found.extent.map(number), "lines": found.lines.iter().map(line).collect::<Vec<_>>(),
    })
}

/// The lines of a table, which `changes.csv` names.
fn lines(table: &OffsetTable, outcome: &Outcome) -> Value {
    let lines = TableLines::new(table, outcome);
    let stations: Vec<Value> = lines.stations.iter().map(|s| json!({ "name": s.name, "x": number(s.x) })).collect();
    let endings: Vec<[Value; 2]> = lines.endings.iter().map(|ends| ends.map(json_number)).collect();
    let crossings: Vec<Value> = lines
        .crossings
        .iter()
        .map(|c| json!({ "station": lines.stations[c.station].x, "z": number(c.z), "kind": kind_word(c.kind) }))
        .collect();
    json!({
        "notation": lines.notation.as_str(), "quantum": json_number(lines.quantum), "stations": stations,
        "waterlines": lines.waterlines.iter().map(|z| number(*z)).collect::<Vec<_>>(), "endings": endings,
        "crossings": crossings,
    })
}

/// The word for a kind of line.
pub(super) fn kind_word(kind: LineKind) -> &'static str {
    match kind {
        LineKind::Knuckle => "knuckle",
        LineKind::Tangent => "tangent",
    }
}

/// The certificate. `suspects` are the suspects as `check` writes them; `table` is the table as it was read.
#[must_use]
pub fn fairing_json(table: &OffsetTable, outcome: &Outcome, rounding: &RoundingEffect, suspects: &[Value]) -> Value {
    let faired = &outcome.faired;
    let certificate = &faired.solved.certificate;
    let constraints: Vec<Value> = outcome
        .held
        .iter()
        .map(|held| {
            let [low, high] = held.interval();
            let had = !outcome.nearest || held.is_had();
            let at = if had { "" } else { " at no more than what was reached" };
            let mut member = json!({
                "kind": held.constraint.key(), "name": held.constraint.words(), "unit": held.constraint.unit(),
                "target": number(held.constraint.target()), "low": number(low), "high": number(high),
                "before": number(held.before), "after": number(held.after),
                "residual": number(held.missed()), "multiplier": number(held.multiplier),
                "price": number(held.price), "words": priced(&(held.constraint.words() + at), held.price),
                "satisfied": had,
            });
            if let Constraint::SectionArea { x, band, .. } = held.constraint {
                member["x"] = number(x);
                member["band"] = number(band);
            }
            member
        })
        .collect();
    let rules: Vec<Value> = outcome
        .rules
        .iter()
        .map(|held| {
            json!({
                "kind": held.rule.key(), "name": held.rule.words(), "rows": held.rows, "binding": held.binding,
                "violation": number(held.violation), "multiplier": number(held.multiplier), "price": number(held.price),
                "given_up": held.given_up,
                "words": if held.given_up { format!("{} was given up", held.rule.words()) } else { priced(&held.rule.words(), held.price) },
            })
        })
        .collect();
    let (rms, max, largest) = outcome.moves();
    let tolerances = outcome.changes.iter().filter_map(|change| change.tolerance).filter(|t| *t > 0.0);
    let range = tolerances.fold(None, |range: Option<[f64; 2]>, t| {
        Some(range.map_or([t, t], |[least, most]| [least.min(t), most.max(t)]))
    });
    let trials: Vec<Value> = faired
        .trials
        .iter()
        .map(|trial| {
            json!({
                "weight": number(trial.lambda), "gcv": number(trial.gcv), "rms": number(trial.rms),
                "energy": number(trial.energy), "edf": number(trial.edf),
            })
        })
        .collect();
    let iterates = faired.solved.solution.progress.iter();
    let convergence: Vec<Value> =
        iterates.map(|p| json!({ "primal": number(p.primal), "dual": number(p.dual), "gap": number(p.gap) })).collect();
    json!({
        "name": table.name,
        "table": lines(table, outcome),
        // Null where a draught is stated: then the quantities are those at T.
        "held_below": outcome.held_below().map(|(z, words)| json!({ "z": number(z), "words": words })),
        "status": status_word(outcome.status),
        "energy": {
            "before": number(outcome.energy[0]), "after": number(outcome.energy[1]), "order": outcome.order,
            "before_is_of_the_field": outcome.is_field,
        },
        "certificate": {
            "primal": number(certificate.primal), "dual": number(certificate.dual), "gap": number(certificate.gap),
            "stationarity": number(certificate.stationarity), "max_violation": number(certificate.max_violation),
        },
        "constraints": constraints,
        "rules": rules,
        // Largest relative error of what is not linear, before its first new linearisation and after each.
        "nonlinear_residuals": faired.settled.as_ref().map(|list| list.iter().map(|value| number(*value)).collect::<Vec<_>>()),
        "fair": fair(outcome),
        "inflections": {
            // What departs less from its chord is no inflection [m].
            "dead_band": number(outcome.resolution),
            // Greatest cost of removing one [squares of the noise].
            "max_cost": number(faired.dearest),
            "waterlines": inflections(outcome, "waterline"), "stations": inflections(outcome, "station"),
            "buttocks": inflections(outcome, "buttock"), "diagonals": inflections(outcome, "diagonal"),
        },
        // The greatest jump of curvature across lines of the net where the surface through the table has none [1/m].
        "max_curvature_jump": json_number(outcome.jump),
        // By how much the half-breadth passes the greatest of the table, or B/2, before and after [m].
        "beyond_half_breadth": outcome.beyond.map(number),
        "control_polygon": { "before": polygon(&outcome.signs[0]), "after": polygon(&outcome.signs[1]) },
        "lines": outcome.proposals.iter().map(proposed).collect::<Vec<_>>(),
        "infeasible": diagnosis(outcome),
        "moves": { "offsets": outcome.changes.len(), "rms": number(rms), "max": number(max), "at": largest.map(|change| place(table, change)), "rms_normal": number(outcome.normal_moves[0]), "max_normal": number(outcome.normal_moves[1]) },
        "tolerance": {
            "least": json_number(range.map(|r| r[0])), "largest": json_number(range.map(|r| r[1])),
            "reached": reached(outcome).count(),
        },
        "rounding": {
            "largest": number(rounding.largest), "rms": number(rounding.root_mean_square),
            "volume": json_number(rounding.volume), "volume_share": json_number(rounding.volume_share),
        },
        "noise": {
            "sigma": number(faired.sigma), "errors": number(faired.errors),
            // What offsets of a line are too wide by together [m]; null where lines have no errors in common.
            "of_lines": outcome.line_errors.as_ref().map(of_lines),
        },
        "smoothing": {
            "fairness": number(outcome.fairness.grade()), "weight": number(faired.lambda), "readings": faired.smoother.count(), "edf": number(faired.edf), "rms": number(faired.chosen.rms),
            "energy": number(faired.chosen.energy), "trials": trials,
        },
        // Where R_W of thin ships joined the objective; null elsewhere.
        "wave_resistance": faired.waves.as_ref().map(waves_json),
        "suspects": suspects,
        "excluded": outcome.changes.iter().filter(|change| change.suspect).map(|c| place(table, c)).collect::<Vec<_>>(),
        "notes": outcome.notes,
        "convergence": convergence,
        "work": { "solves": faired.programs, "iterations": faired.iterations },
    })
}

/// The offsets that stop at their tolerance, to a thousandth of it; locked ones are not among them.
pub fn reached(outcome: &Outcome) -> impl Iterator<Item = &Change> {
    outcome.changes.iter().filter(|change| {
        let tolerance = change.tolerance.filter(|tolerance| *tolerance > 0.0 && !change.locked);
        tolerance.is_some_and(|tolerance| (change.after - change.before).abs() >= 0.999 * tolerance)
    })
}

/// The text of an offset in a table; empty where none is kept.
/// How an offset is written; nothing where that is not known.
fn cell_text(table: &OffsetTable, station: usize, waterline: usize) -> String {
    let cell = table.stations.get(station).and_then(|station| station.half_breadths.get(waterline));
    cell.and_then(|cell| cell.written.as_ref()).map(|written| written.text.clone()).unwrap_or_default()
}

fn text(table: &OffsetTable, change: &Change) -> String {
    let side = || {
        let lines = table.form.side_columns.iter().find(|side| side.kind == SideKind::DeckHalfBreadth)?;
        lines.texts.get(change.station)?.as_ref().map(|kept| kept.text.clone())
    };
    match change.origin {
        Origin::HalfBreadth { station, waterline } => cell_text(table, station, waterline),
        Origin::Deck { .. } => side().unwrap_or_default(),
        Origin::Point { .. } => String::new(),
    }
}

/// 0 for what is rounding of it \[m\].
fn without_noise(value: f64) -> f64 {
    if value.abs() < 1e-12 { 0.0 } else { value }
}

/// A length as people read it: what is beyond the ninth decimal is rounding of feet and inches.
fn metres(value: Option<f64>) -> String {
    cell(value.map(|value| to_decimals(value, 9)))
}

/// One row an offset: station, waterline (`deck` for the deck at side, `point 0.6` for point 6 of outline 0, which
/// count from 0 as in files that number them), place, before, after, move (outward positive), tolerance, the share of it
/// that is used, whether it is locked or was left out as a suspect, and its text in the old table and in `written`, the
/// new one as it is read back.
/// Then, with nothing before, the offsets that were unknown, and with nothing after those that no part of the hull reads
/// (zeros before it begins, stations that were left out): they stay as written.
#[must_use]
pub fn changes_csv(table: &OffsetTable, outcome: &Outcome, written: Option<&OffsetTable>) -> String {
    let head = [
        "station",
        "waterline",
        "x [m]",
        "z [m]",
        "before [m]",
        "after [m]",
        "move [m]",
        "tolerance [m]",
        "used",
        "locked",
        "suspect",
        "text before",
        "text after",
        "status",
    ];
    let mut csv = line(&head.map(str::to_owned));
    let yes = |flag: bool| if flag { "yes".to_owned() } else { String::new() };
    for change in &outcome.changes {
        let Some(station) = table.stations.get(change.station) else { continue };
        let moved = change.after - change.before;
        let waterline = match change.origin {
            Origin::HalfBreadth { waterline, .. } => metres(table.waterlines.get(waterline).copied()),
            Origin::Deck { .. } => "deck".to_owned(),
            Origin::Point { outline, point, .. } => format!("point {outline}.{point}"),
        };
        let used = change.tolerance.filter(|t| *t > 0.0).map(|tolerance| moved.abs() / tolerance);
        csv.push_str(&line(&[
            station.station.name.clone(),
            waterline,
            metres(Some(change.x)),
            metres(Some(change.z)),
            metres(Some(change.before)),
            metres(Some(without_noise(change.after))),
            metres(Some(without_noise(moved))),
            cell(change.tolerance),
            used.map(|used| format!("{used:.3}")).unwrap_or_default(),
            yes(change.locked),
            yes(change.suspect),
            text(table, change),
            written.map(|written| text(written, change)).unwrap_or_default(),
            status_word(outcome.status).to_owned(),
        ]));
    }
    for own in &outcome.predicted {
        let Some(station) = table.stations.get(own.station) else { continue };
        let text = |table: &OffsetTable| cell_text(table, own.station, own.waterline);
        let blank = String::new;
        csv.push_str(&line(&[
            station.station.name.clone(),
            cell(Some(own.z)),
            cell(Some(own.x)),
            cell(Some(own.z)),
            blank(),
            cell(Some(without_noise(own.half_breadth))),
            blank(),
            blank(),
            blank(),
            blank(),
            blank(),
            text(table),
            written.map(text).unwrap_or_default(),
            status_word(outcome.status).to_owned(),
        ]));
    }
    for (s, station) in table.stations.iter().enumerate() {
        for (w, given) in station.half_breadths.iter().enumerate() {
            let read = |change: &Change| change.station == s && change.origin.waterline() == Some(w);
            let Some(value) = given.value().filter(|_| !outcome.changes.iter().any(read)) else { continue };
            let z = metres(table.waterlines.get(w).copied());
            let text = cell_text(table, s, w);
            let mut row =
                [station.station.name.clone(), z.clone(), metres(Some(station.station.x)), z, metres(Some(value))]
                    .to_vec();
            row.resize(head.len() - 3, String::new());
            row.extend([text.clone(), text, "not used".to_owned()]);
            csv.push_str(&line(&row));
        }
    }
    csv
}
