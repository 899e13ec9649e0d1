//! What an inspection prints: tables of at most 100 columns, and one JSON object.

use std::fmt::Write as _;

use serde_json::{Value, json};

use crate::fairing::inspect::{CurvatureAt, CurveReport, Inspection, kind};
use crate::hull::Cut;
use crate::numeric::median;
use crate::report::words::page::fixed;
use crate::units::counted;

/// Share of a sum from which one curve rules it, and the least number of curves for which that is reported.
const RULING: f64 = 0.5;
const RULED: usize = 4;

const KINDS: [&str; 5] = ["station", "waterline", "buttock", "diagonal", "plane"];

/// The position of a plane: x, z, y or the height on the centreplane \[m\]; normal and offset of any other.
fn position(cut: &Cut) -> Vec<f64> {
    match *cut {
        Cut::Station { x } => vec![x],
        Cut::Waterline { z } => vec![z],
        Cut::Buttock { y } => vec![y],
        Cut::Diagonal { height, .. } => vec![height],
        Cut::Plane { normal, offset } => vec![normal[0], normal[1], normal[2], offset],
    }
}

fn named(cut: &Cut) -> String {
    let numbers: Vec<String> = position(cut).into_iter().map(|p| fixed(p, 3)).collect();
    format!("{:<10}{:>9}", kind(cut), numbers.join(","))
}

/// The plane in a sentence.
fn plain(cut: &Cut) -> String {
    named(cut).split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The curve of a kind that holds more than RULING of the kind's sum of squared curvature, among RULED curves at least,
/// and its share: a tight turn, as at the edge of a narrow flat near the ends, says more about such a sum than all
/// other curves do.
fn ruling<'i>(inspection: &'i Inspection, word: &str) -> Option<(&'i CurveReport, f64)> {
    let curves = || inspection.curves.iter().filter(|curve| kind(&curve.cut) == word);
    let sum: f64 = curves().map(|curve| curve.bending).sum();
    let most = curves().max_by(|a, b| a.bending.total_cmp(&b.bending))?;
    let share = most.bending / sum;
    (curves().count() >= RULED && share > RULING).then_some((most, share))
}

/// The median of the sums of squared curvature of curves, which no single turn rules.
fn median_bending(curves: &[&CurveReport]) -> f64 {
    let mut list: Vec<f64> = curves.iter().map(|curve| curve.bending).collect();
    median(&mut list).unwrap_or(0.0)
}

/// Four significant digits, with a power of ten.
fn scientific(value: f64) -> String {
    format!("{:.3e}", value + 0.0)
}

fn curve_line(curve: &CurveReport) -> String {
    let branch = if curve.branch > 1 { format!("/{}", curve.branch) } else { String::new() };
    let flat: f64 = curve.flats.iter().map(|flat| flat.length).sum();
    let flats = match curve.flats.len() {
        0 => String::new(),
        n => format!("{n} ({:.0} %)", 100.0 * flat / curve.length),
    };
    format!(
        "{:<22}{:>9} {:>5} {:>5} {:>9} {:>5} {:>9} {:>9} {:>9} {:>9}",
        named(&curve.cut) + &branch,
        fixed(curve.length, 3),
        curve.inflections.len(),
        curve.extrema.len(),
        flats,
        curve.knuckles.len(),
        fixed(curve.largest.value, 5),
        curve.step.map(|step| fixed(step, 5)).unwrap_or_default(),
        scientific(curve.bending),
        scientific(curve.variation),
    )
}

fn places(places: &[[f64; 3]]) -> String {
    let shown = places.iter().map(|p| format!("({}, {}, {})", fixed(p[0], 3), fixed(p[1], 3), fixed(p[2], 3)));
    shown.collect::<Vec<_>>().join(" ")
}

/// The tables of an inspection as text.
#[must_use]
pub fn inspection_page(name: &str, inspection: &Inspection) -> String {
    let mut page = String::new();
    // Writing to a String cannot fail.
    let _ = write_page(&mut page, name, inspection);
    page
}

fn write_page(page: &mut String, name: &str, inspection: &Inspection) -> std::fmt::Result {
    writeln!(page, "{name}\n")?;
    writeln!(
        page,
        "Lengths in m, curvature in 1/m, positive where convex outward. What departs from a batten by less than"
    )?;
    writeln!(page, "{} mm is not counted.\n", fixed(1000.0 * inspection.tolerance, 3))?;
    writeln!(
        page,
        "{:<22}{:>9} {:>5} {:>5} {:>9} {:>5} {:>9} {:>9} {:>9} {:>9}",
        "curve", "length", "infl", "extr", "flats", "knuck", "kappa max", "step max", "int k2", "int dk2"
    )?;
    for word in KINDS {
        for curve in inspection.curves.iter().filter(|curve| kind(&curve.cut) == word) {
            writeln!(page, "{}", curve_line(curve))?;
        }
    }
    for word in KINDS {
        let of_kind: Vec<&CurveReport> = inspection.curves.iter().filter(|curve| kind(&curve.cut) == word).collect();
        if !of_kind.is_empty() {
            let total = |count: fn(&CurveReport) -> usize| of_kind.iter().map(|curve| count(curve)).sum::<usize>();
            writeln!(
                page,
                "{:<31} {:>5} {:>5} {:>9} {:>5}",
                format!("all {} {word}s", of_kind.len()),
                total(|c| c.inflections.len()),
                total(|c| c.extrema.len()),
                total(|c| c.flats.len()),
                total(|c| c.knuckles.len())
            )?;
        }
    }
    for word in KINDS {
        if let Some((curve, share)) = ruling(inspection, word) {
            let (percent, at) = (fixed(100.0 * share, 0), places(&[curve.largest.at]));
            writeln!(
                page,
                "{percent} % of int k2 of all {word}s is that of {} alone, with its turn at {at}",
                plain(&curve.cut)
            )?;
        }
    }
    for cut in &inspection.narrow {
        writeln!(page, "{} is not counted: no breadth (half-breadth below B/1000 all along)", named(cut))?;
    }
    for curve in inspection.curves.iter().filter(|curve| curve.without_breadth > 0.0) {
        let length = fixed(curve.without_breadth, 3);
        writeln!(page, "{} counts without {length} m at its ends, where it has no breadth", named(&curve.cut))?;
    }
    for cut in &inspection.empty {
        writeln!(page, "{} does not cut the side of the hull in a curve", named(cut))?;
    }
    let turned: Vec<&CurveReport> = inspection.curves.iter().filter(|curve| !curve.inflections.is_empty()).collect();
    if !turned.is_empty() {
        writeln!(page, "\nInflections (x, y, z)")?;
        for curve in turned {
            writeln!(page, "{}  {}", named(&curve.cut), places(&curve.inflections))?;
        }
    }
    writeln!(page, "\nControl polygon: side of each inner vertex of the chord of its neighbours, + outboard")?;
    writeln!(page, "{:<8}{:>5}{:>10} {:>8} {:>9}  signs", "line", "no", "at", "changes", "enclosed")?;
    for line in &inspection.net {
        let signs: String = line.signs.iter().map(|side| side.as_char()).collect();
        writeln!(
            page,
            "{:<8}{:>5}{:>10} {:>8} {:>9}  {signs}",
            line.line.as_str(),
            line.index,
            fixed(line.at, 3),
            line.changes,
            line.enclosed
        )?;
    }
    let surface = &inspection.surface;
    writeln!(
        page,
        "\nSurface, one side below the deck: area {} m2, int (k1^2 + k2^2) dA {}",
        fixed(surface.area, 3),
        scientific(surface.bending)
    )?;
    for range in &surface.ranges {
        let end = |at: &CurvatureAt| format!("{} at {}", scientific(at.value), places(&[at.at]));
        writeln!(page, "{:<12} least {}, greatest {}", range.name, end(&range.least), end(&range.greatest))?;
    }
    if surface.degenerate > 0 {
        writeln!(page, "left out: {} without a tangent plane", counted(surface.degenerate, "point"))?;
    }
    Ok(())
}

fn curve_json(curve: &CurveReport) -> Value {
    let at = position(&curve.cut);
    let flats: Vec<Value> =
        curve.flats.iter().map(|flat| json!({ "from": flat.from, "to": flat.to, "length": flat.length })).collect();
    json!({
        "kind": kind(&curve.cut),
        "at": if at.len() == 1 { json!(at[0]) } else { json!(at) },
        "branch": curve.branch,
        "length": curve.length,
        "turning": curve.turning,
        "inflections": curve.inflections.len(),
        "inflections_at": curve.inflections,
        "extrema": curve.extrema.len(),
        "extrema_at": curve.extrema,
        "max_curvature": curve.largest.value,
        "max_curvature_at": curve.largest.at,
        "max_step": curve.step,
        "bending_energy": curve.bending,
        "variation_energy": curve.variation,
        "flats": flats,
        "knuckles": curve.knuckles,
        "without_breadth": curve.without_breadth,
    })
}

/// An inspection as JSON: `{"name", "tolerance", "curves": [{"kind", "at", "branch", "length", "inflections",
/// "inflections_at", "extrema", "max_curvature", "max_step", "bending_energy", "variation_energy", "flats", "knuckles",
/// ...}], "totals": {"stations": {...}}, "empty": [...], "no_breadth": [...], "net": [{"line", "index", "at", "signs",
/// "changes", "enclosed"}], "surface": {...}}`; lengths \[m\], curvatures \[1/m\], points \[x, y, z\].
#[must_use]
pub fn inspection_json(name: &str, inspection: &Inspection) -> Value {
    let mut totals = serde_json::Map::new();
    for word in KINDS {
        let of_kind: Vec<&CurveReport> = inspection.curves.iter().filter(|curve| kind(&curve.cut) == word).collect();
        let count = |count: fn(&CurveReport) -> usize| of_kind.iter().map(|curve| count(curve)).sum::<usize>();
        if !of_kind.is_empty() {
            let total = json!({
                "curves": of_kind.len(),
                "inflections": count(|c| c.inflections.len()),
                "extrema": count(|c| c.extrema.len()),
                "flats": count(|c| c.flats.len()),
                "knuckles": count(|c| c.knuckles.len()),
                "bending_energy": of_kind.iter().map(|curve| curve.bending).sum::<f64>(),
                "bending_energy_median": median_bending(&of_kind),
                "variation_energy": of_kind.iter().map(|curve| curve.variation).sum::<f64>(),
                "ruled_by": ruling(inspection, word).map(|(curve, share)| json!({
                    "at": position(&curve.cut), "branch": curve.branch, "share": share, "turn_at": curve.largest.at,
                })),
            });
            totals.insert(format!("{word}s"), total);
        }
    }
    let net: Vec<Value> = inspection
        .net
        .iter()
        .map(|line| {
            let signs: String = line.signs.iter().map(|side| side.as_char()).collect();
            json!({
                "line": line.line.as_str(), "index": line.index, "at": line.at, "signs": signs,
                "changes": line.changes, "enclosed": line.enclosed,
            })
        })
        .collect();
    let surface = &inspection.surface;
    let mut measures = serde_json::Map::new();
    measures.insert("area".to_owned(), json!(surface.area));
    measures.insert("bending_energy".to_owned(), json!(surface.bending));
    measures.insert("degenerate_points".to_owned(), json!(surface.degenerate));
    for range in &surface.ranges {
        let end = |at: &CurvatureAt| json!({ "value": at.value, "at": at.at });
        measures.insert(range.name.to_owned(), json!({ "least": end(&range.least), "greatest": end(&range.greatest) }));
    }
    json!({
        "name": name,
        "tolerance": inspection.tolerance,
        "curves": inspection.curves.iter().map(curve_json).collect::<Vec<_>>(),
        "totals": totals,
        "empty": inspection.empty.iter().map(|cut| json!({ "kind": kind(cut), "at": position(cut) })).collect::<Vec<_>>(),
        "no_breadth": inspection.narrow.iter().map(|cut| json!({ "kind": kind(cut), "at": position(cut) })).collect::<Vec<_>>(),
        "net": net,
        "surface": measures,
    })
}
