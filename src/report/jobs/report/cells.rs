//! The tables of a report: cells as text, for the page and for sheets of paper.

use serde_json::Value;

use crate::exchange::NO_MOVE;
use crate::fairing::fair::PRICE;
use crate::fairing::record::FairRecord;
use crate::fairing::surface::Origin;
use crate::hull::OffsetStation;
use crate::hydrostatics::{CoefficientLength, CurvesOfForm, Hydrostatics, QUANTITIES};
use crate::report::input::result::JobResult;
use crate::report::words::page::{fixed, tender_words, unit};

/// What the page says above tables at other draughts than a design draught.
pub(in crate::report) const NO_DESIGN_DRAUGHT: &str = "No design draught is stated: give --draught to the command that wrote this result. The hydrostatic table holds at \
     the draught of each row.";

/// Text for HTML.
pub(in crate::report) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A table; the first `words` columns are text.
pub(in crate::report) struct Table {
    pub(in crate::report) heads: Vec<String>,
    pub(in crate::report) words: usize,
    pub(in crate::report) rows: Vec<(bool, Vec<String>)>,
}

impl Table {
    fn new(heads: &[&str], words: usize) -> Self {
        Self { heads: heads.iter().map(|head| (*head).to_owned()).collect(), words, rows: Vec::new() }
    }

    pub(in crate::report) fn html(&self) -> String {
        let class = |column: usize| if column < self.words { " class=\"word\"" } else { "" };
        let mut html = String::from("<div class=\"scroll\"><table class=\"sortable\"><thead><tr>");
        for (column, head) in self.heads.iter().enumerate() {
            html.push_str(&format!("<th{}>{}</th>", class(column), lowered(head)));
        }
        html.push_str("</tr></thead><tbody>\n");
        for (marked, cells) in &self.rows {
            html.push_str(if *marked { "<tr class=\"design\">" } else { "<tr>" });
            for (column, cell) in cells.iter().enumerate() {
                html.push_str(&format!("<td{}>{}</td>", class(column), lowered(cell)));
            }
            html.push_str("</tr>\n");
        }
        html.push_str("</tbody></table></div>\n");
        html
    }
}

/// Every quantity over the draughts; the design draught is marked where one is stated.
pub(in crate::report) fn hydrostatics(curves: &CurvesOfForm, design: Option<f64>) -> Table {
    let defined = |q: &&crate::hydrostatics::Quantity| curves.rows.iter().any(|row| (q.value)(row).is_some());
    let quantities: Vec<_> = QUANTITIES.iter().filter(defined).collect();
    let head = |q: &&crate::hydrostatics::Quantity| match printed_unit(q.unit) {
        unit if unit.is_empty() => q.key.to_owned(),
        unit => format!("{} [{unit}]", q.key),
    };
    let heads = quantities.iter().map(head).collect();
    let row = |row: &Hydrostatics| {
        let cells = quantities.iter().map(|q| (q.value)(row).map_or(String::new(), |v| fixed(v, q.decimals_of(v))));
        (design.is_some_and(|design| (row.draught - design).abs() < 1e-9), cells.collect())
    };
    Table { heads, words: 0, rows: curves.rows.iter().map(row).collect() }
}

/// A table with the line that marks too little GM, where it has rows with that.
pub(in crate::report) fn marked<'r>(table: String, rows: impl IntoIterator<Item = &'r Hydrostatics>) -> String {
    tender_words(rows).map_or_else(|| table.clone(), |words| format!("<p class=\"bad\">{words}</p>\n{table}"))
}

/// The design condition, that before fairing where there is one, and what was asked for where something was.
pub(in crate::report) fn condition(result: &JobResult, design: &Hydrostatics, before: Option<&Hydrostatics>) -> Table {
    let mut heads = vec!["quantity", "key", "unit"];
    heads.extend(if before.is_some() { ["before", "after", "difference"].as_slice() } else { &["value"] });
    if !result.targets.is_empty() {
        heads.push("target");
    }
    let mut table = Table::new(&heads, 3);
    // Designs ask for coefficients on L_PP.
    let length = match (&result.fairing, result.conventions.coefficient_length) {
        (None, CoefficientLength::Waterline) => design.waterline_length,
        _ => result.hull.particulars().length_between_perpendiculars,
    };
    let shares = |key: &str| match key {
        "CB" | "CWP" => result.hull.particulars().length_between_perpendiculars / length,
        _ => 1.0,
    };
    for q in QUANTITIES {
        let Some(value) = (q.value)(design) else { continue };
        let mut cells = vec![q.name.to_owned(), q.key.to_owned(), printed_unit(unit(q.key))];
        let decimals = q.decimals_of(value);
        if let Some(before) = before {
            let old = (q.value)(before);
            cells.push(old.map_or(String::new(), |old| fixed(old, decimals)));
            cells.push(fixed(value, decimals));
            cells.push(old.map_or(String::new(), |old| fixed(value - old, decimals + 1)));
        } else {
            cells.push(fixed(value, decimals));
        }
        if !result.targets.is_empty() {
            let target = result.targets.iter().find(|(key, _)| key == q.key);
            let asked = |(_, wanted): &(String, f64)| match shares(q.key) {
                1.0 => fixed(*wanted, decimals),
                share => format!("{} ({} on L_PP)", fixed(wanted * share, decimals), fixed(*wanted, decimals)),
            };
            cells.push(target.map_or(String::new(), asked));
        }
        table.rows.push((false, cells));
    }
    table
}

pub(in crate::report) fn text(value: &Value) -> String {
    value.as_str().unwrap_or_default().to_owned()
}

/// A number of a file to `digits` figures; plain where it is neither very large nor very small.
pub(in crate::report) fn figures(value: &Value, digits: usize) -> String {
    let Some(number) = value.as_f64() else { return String::new() };
    let size = number.abs();
    if size == 0.0 {
        return "0".to_owned();
    }
    let power = size.log10().floor() as i32;
    if (-3..9).contains(&power) {
        format!("{number:.*}", (digits as i32 - 1 - power).max(0) as usize)
    } else {
        format!("{number:.*e}", digits.saturating_sub(1))
    }
}

/// A value that is held; what is rounding is 0.
fn value(value: &Value) -> String {
    if value.as_f64().is_some_and(|number| number.abs() < 1e-9) { "0".to_owned() } else { figures(value, 8) }
}

/// A price \[m\] in millimetres to two figures; what is rounding, of either sign, is 0.
fn price(value: &Value) -> String {
    let Some(metres) = value.as_f64() else { return String::new() };
    if metres < NO_MOVE { "0".to_owned() } else { figures(&(1e3 * metres).into(), 2) }
}

/// A unit as it is printed: m² for m2, t·m/cm for t m/cm, nothing for numbers alone.
fn printed_unit(unit: &str) -> String {
    let raised = [("m2", "m²"), ("m3", "m³"), ("m4", "m⁴"), ("t m", "t·m")];
    let unit = if unit == "-" { "" } else { unit };
    raised.iter().fold(unit.to_owned(), |text, (plain, printed)| text.replace(plain, printed))
}

/// What symbols with a lowered part begin with.
const SYMBOLS: [&str; 13] = ["A", "B", "BM", "C", "D", "GM", "I", "KB", "KM", "L", "LCB", "T", "X"];

/// Text of a page: C_M, L_PP with the letters after the sign lowered; names of files and ships stay.
pub(in crate::report) fn lowered(text: &str) -> String {
    let text = escape(text);
    let mut html = String::with_capacity(text.len());
    let mut done = 0;
    for (at, _) in text.match_indices('_').filter(|(at, _)| *at > 0) {
        let (before, after) = (&text[..at], &text[at + 1..]);
        let end = after.find(|c: char| !c.is_ascii_uppercase()).unwrap_or(after.len());
        let symbol = before.rsplit(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap_or_default();
        let mut follows = after[end..].chars();
        let ends = match follows.next() {
            Some('.') => !follows.next().is_some_and(char::is_alphanumeric),
            Some(c) => !(c.is_alphanumeric() || c == '_'),
            None => true,
        };
        if (1..=2).contains(&end) && ends && SYMBOLS.contains(&symbol) {
            html.push_str(&format!("{}<sub>{}</sub>", &text[done..at], &after[..end]));
            done = at + 1 + end;
        }
    }
    html.push_str(&text[done..]);
    html
}

pub(in crate::report) fn list(value: &Value) -> impl Iterator<Item = &Value> {
    value.as_array().into_iter().flatten()
}

/// What price and multiplier of [`constraints`] are.
pub(in crate::report) const PRICES: &str = "residual: distance outside the interval of the target; price: RMS of the moves that dropping the target would save; multiplier: what the objective, a sum of squares of moves, falls by for \
     each part by which its row is relaxed, of the target (LCB, LCF: of L_PP; KB: of T; C_M: of 1; a section area: of B T; KM, GM: of KM_T)";

pub(in crate::report) fn constraints(fairing: &Value) -> Table {
    let heads = ["quantity", "unit", "target", "before", "after", "residual", "multiplier [m²]", "price [mm RMS]"];
    let mut table = Table::new(&heads, 2);
    for held in list(&fairing["constraints"]) {
        let missed = [&held["satisfied"], &held["had"]].contains(&&Value::Bool(false));
        let name = text(&held["name"]);
        table.rows.push((
            missed,
            vec![
                if missed { format!("{name}: NOT HELD") } else { name },
                printed_unit(held["unit"].as_str().unwrap_or_default()),
                value(&held["target"]),
                value(&held["before"]),
                value(&held["after"]),
                residual(&held["residual"], held["target"].as_f64().unwrap_or_default().abs()),
                figures(&held["multiplier"], 3),
                price(&held["price"]),
            ],
        ));
    }
    for rule in list(&fairing["rules"]) {
        let blank = || String::new();
        table.rows.push((
            false,
            vec![
                text(&rule["name"]),
                format!("{} rows, {} bind", rule["rows"], rule["binding"]),
                blank(),
                blank(),
                blank(),
                residual(&rule["violation"], 1.0),
                figures(&rule["multiplier"], 3),
                price(&rule["price"]),
            ],
        ));
    }
    table
}

/// What is missed of a target of the size `scale`, in words where it is rounding; the digits of that are in
/// `fairing.json`.
fn residual(value: &Value, scale: f64) -> String {
    const ROUNDING: f64 = 1e-12;
    let within = |missed: &f64| missed.abs() <= ROUNDING * scale;
    value.as_f64().filter(within).map_or_else(|| figures(value, 2), |_| "0 to rounding".to_owned())
}

/// What forbidding a change of curvature was allowed to cost.
fn dearest(fairing: &Value) -> f64 {
    let inflections = &fairing["inflections"];
    inflections["max_cost"].as_f64().or(inflections["dearest"].as_f64()).unwrap_or(PRICE)
}

/// How often every line bends and in how many monotone pieces its curvature runs, before, after, at least, and what was
/// asked of it. On `paper` the pieces are one column, and variation is left out.
pub(in crate::report) fn inflections(record: &FairRecord, fairing: &Value, paper: bool) -> Table {
    let pieces: &[&str] = if paper {
        &["pieces"]
    } else {
        &["pieces before", "pieces after", "pieces least", "variation before", "variation after"]
    };
    let mut table =
        Table::new(&[&["line", "at [m]", "before", "after", "least"], pieces, &["asked", "price"]].concat(), 1);
    for (kind, key) in
        [("waterline", "waterlines"), ("station", "stations"), ("buttock", "buttocks"), ("diagonal", "diagonals")]
    {
        for line in list(&fairing["inflections"][key]) {
            let count = |key: &str| line[key].as_u64().map_or(String::new(), |n| n.to_string());
            let place = line["at"].as_f64().unwrap_or(f64::NAN);
            let named = |station: &&OffsetStation| (station.x - place).abs() < 1e-9 && !station.is_named_by_place();
            let name = match kind {
                "station" => record.lines.stations.iter().find(named).map_or(kind.to_owned(), OffsetStation::words),
                _ => kind.to_owned(),
            };
            let least = match line["minimum_proved"].as_bool() {
                Some(false) => format!("{}, not proved", count("minimum")),
                _ => count("minimum"),
            };
            let asked = match (line["asked"].as_u64(), kind) {
                (Some(most), _) if line["after"].as_u64().is_some_and(|after| after > most) => {
                    format!("at most {most}, has more")
                }
                (Some(most), _) => format!("at most {most}"),
                (None, "buttock" | "diagonal") => "not used".to_owned(),
                _ => "nothing".to_owned(),
            };
            let price = line["price"].as_f64().map_or_else(String::new, |price| fixed(price, 2));
            let more = line["after"].as_u64() > line["before"].as_u64() || asked.ends_with("more");
            let mut cells = vec![name, fixed(place, 3), count("before"), count("after"), least];
            // Files of old programs have neither.
            let pieces = ["before", "after", "least"].map(|key| figures(&line["pieces"][key], 1));
            match pieces {
                [before, after, least] if paper => cells.push(match least.as_str() {
                    "" => format!("{before} > {after}"),
                    least => format!("{before} > {after} ({least})"),
                }),
                pieces => {
                    cells.extend(pieces);
                    cells.extend(["before", "after"].map(|key| figures(&line["variation"][key], 3)));
                }
            }
            cells.extend([asked, price]);
            table.rows.push((more, cells));
        }
    }
    table
}

/// What the columns of [`inflections`] are.
pub(in crate::report) fn inflections_words(record: &FairRecord, fairing: &Value, paper: bool) -> String {
    let band = record.resolution;
    let variation =
        if paper { "" } else { " variation: total variation of curvature over its range, empty on straight lines;" };
    format!(
        "bends that leave their chord by less than {} are flat and do not count; least: what the tolerances leave possible; pieces: monotone \
         pieces of curvature between swings of that height (dk l² / π²), with the least that goes with the least inflections;{variation} at most: what \
         was asked of the line, where no inflection less is worth more than {}; not used: buttocks and diagonals are the \
         independent check; price: what asking costs at most, in the sum of squares of moves over the noise squared",
        record.lines.notation.small(band),
        dearest(fairing)
    )
}

pub(in crate::report) fn suspects(fairing: &Value) -> Table {
    let heads =
        ["id", "what it may be", "written", "x [m]", "z [m]", "value [m]", "expected [m]", "proposed [m]", "score"];
    let mut table = Table::new(&heads, 3);
    for suspect in list(&fairing["suspects"]) {
        let metres = |key: &str| suspect[key].as_f64().map_or(String::new(), |v| fixed(v, 4));
        table.rows.push((
            false,
            vec![
                text(&suspect["id"]),
                text(&suspect["hypothesis"]),
                text(&suspect["written"]),
                metres("station"),
                metres("waterline"),
                metres("value"),
                metres("expected"),
                metres("proposed"),
                figures(&suspect["score"], 3),
            ],
        ));
    }
    table
}

pub(in crate::report) fn changes(result: &JobResult) -> Option<Table> {
    let (record, _) = result.fairing.as_ref()?;
    let heads = ["station", "marks", "x [m]", "z [m]", "before [m]", "after [m]", "move [mm]", "tolerance [mm]"];
    let mut table = Table::new(&heads, 2);
    for change in &record.changes {
        let name = record.lines.stations.get(change.station).map_or("", |station| station.name.as_str());
        let marks = [
            (matches!(change.origin, Origin::Deck { .. }), "deck"),
            (change.locked, "locked"),
            (change.suspect, "suspect"),
        ];
        let marks: Vec<&str> = marks.into_iter().filter(|(set, _)| *set).map(|(_, word)| word).collect();
        table.rows.push((
            false,
            vec![
                name.to_owned(),
                marks.join(", "),
                fixed(change.x, 3),
                fixed(change.z, 3),
                fixed(change.before, 4),
                fixed(change.after, 4),
                fixed(1e3 * (change.after - change.before), 2),
                change.tolerance.map_or(String::new(), |t| fixed(1e3 * t, 2)),
            ],
        ));
    }
    Some(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prices_that_are_rounding_are_nothing() {
        for (metres, text) in [(-7.7e-7, "0"), (4.9e-7, "0"), (2.6e-6, "0.0026"), (1.7e-4, "0.17"), (0.0123, "12")] {
            assert_eq!(price(&metres.into()), text);
        }
    }

    #[test]
    fn symbols_and_units_are_printed_as_such() {
        for (text, html) in [
            ("holding C_M < 1", "holding C<sub>M</sub> &lt; 1"),
            ("L_PP = 175 m, B/2", "L<sub>PP</sub> = 175 m, B/2"),
            ("s60_cb060_, _A", "s60_cb060_, _A"),
            ("DTC_T13.csv KCS_MODEL C_B.csv C_WP. X_A_B", "DTC_T13.csv KCS_MODEL C_B.csv C<sub>WP</sub>. X_A_B"),
        ] {
            assert_eq!(lowered(text), html);
        }
        assert_eq!(["m3", "t m/cm", "-", "m"].map(printed_unit), ["m³", "t·m/cm", "", "m"]);
    }
}
