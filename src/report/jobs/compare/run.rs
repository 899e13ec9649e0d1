//! The job of `compare`: two hulls become particulars, hydrostatics and distances beside each other, files and figures.

pub(crate) use super::hulls::{CompareJob, CompareOutputs, ComparedHull};
use std::path::{Path, PathBuf};

use super::page::compare_markdown;
use crate::config::{Diagnostic, Severity};
use crate::exchange::{ComparedValue, compare_csv, compare_json, per_cent};
use crate::hull::{Hull, PrincipalParticulars, surface_distance};
use crate::hydrostatics::{Conventions, Hydrostatics, Quantity, default_draughts};
use crate::numeric::join;
use crate::plot::{ComparedHulls, Svg, compared_areas, compared_body_plans};
use crate::report::failure::{Failure, problem};
use crate::report::input::hydrostatic_body::{HydrostaticBody, read_hydrostatic_body_at, read_hydrostatic_body_with};
use crate::report::input::source::{read_bytes, read_source_with, ship_name};
use crate::report::output::files::OutputFile;
use crate::report::output::manifest::{json_file, manifest_entry, manifest_of};
use crate::report::words::remarks::is_warning;

/// Dots per inch of the figures.
const DOTS_PER_INCH: f64 = 150.0;
/// Most common draughts of the table.
const MOST_DRAUGHTS: usize = 10;
/// Quantities at the draught of each hull.
const AFLOAT: [&str; 16] =
    ["DISPVOL", "DISPM", "CB", "CM", "CP", "CWP", "XCB", "XCBPC", "XWL", "KB", "KMT", "AWL", "S", "LWL", "BWL", "IE"];

/// Rows at common draughts, that at the draught of the hull, warnings.
type Rows = (Vec<Hydrostatics>, Option<Hydrostatics>, Vec<String>);

/// A body that was read, with the hull for sections and distances.
struct Opened {
    body: HydrostaticBody,
    hull: Hull,
}

fn open(path: &Path, job: &CompareJob) -> Result<Opened, Failure> {
    let body = match job.draught {
        Some(draught) => read_hydrostatic_body_at(path, &job.overrides, draught)?,
        None => read_hydrostatic_body_with(path, &job.overrides)?,
    };
    let hull = match body.hull() {
        Some(hull) => hull.clone(),
        None => surface_of(path, job)?,
    };
    Ok(Opened { body, hull })
}

/// The surface through the sections of a body of triangles.
fn surface_of(path: &Path, job: &CompareJob) -> Result<Hull, Failure> {
    let mut overrides = job.overrides.clone();
    overrides.keys.extend(job.draught.map(|draught| ("T", format!("{draught} m"))));
    Ok(read_source_with(path, &overrides)?.hull)
}

/// Reads both hulls and compares them.
///
/// # Errors
/// Those of [`read_hydrostatic_body_with`]; [`Failure::Usage`] for a draught at which one of them does not float.
pub fn compare_outputs(job: &CompareJob) -> Result<CompareOutputs, Failure> {
    let [first, second] = [open(&job.hulls[0], job)?, open(&job.hulls[1], job)?];
    let conventions = first.body.conventions;
    let mut warnings: Vec<String> = first.body.warnings().chain(second.body.warnings()).collect();
    let each = [(job.hulls[0].as_path(), &conventions), (job.hulls[1].as_path(), &second.body.conventions)];
    let remedy = "Compare what both state, or make the second hull with the conventions of the first";
    warnings.extend(other_conventions(each, "both", remedy));
    let notes = first.body.notes.iter().chain(&second.body.notes).filter(|note| !is_warning(note));
    let notes = notes.cloned().collect();
    let common = common_draughts(&first.body, &second.body)?;
    let rows = |opened: &Opened| -> Result<Rows, Failure> {
        let stated = opened.body.particulars.draught;
        let list: Vec<f64> = common.iter().copied().chain(stated).collect();
        let own = Conventions { assumed: opened.body.conventions.assumed, ..conventions };
        let (mut table, warned) = opened.body.curves_of_form(&list, &own)?;
        let row = stated.and_then(|_| table.rows.pop());
        Ok((table.rows, row, warned))
    };
    let ((a, a_row, a_warned), (b, b_row, b_warned)) = (rows(&first)?, rows(&second)?);
    warnings.extend(a_warned.into_iter().chain(b_warned));
    let hull = |opened: Opened, path: &PathBuf, row| ComparedHull {
        name: opened.body.hull().map_or_else(|| ship_name(path), |hull| hull.name().to_owned()),
        particulars: opened.body.particulars,
        hull: opened.hull,
        row,
        input: Some(if path.is_dir() { path.join("hull.json") } else { path.clone() }),
    };
    let hulls = [hull(first, &job.hulls[0], a_row), hull(second, &job.hulls[1], b_row)];
    let rows = a.into_iter().zip(b).map(|(a, b)| [a, b]).collect();
    let mut outputs = compared(hulls, ["first", "second"], conventions, rows);
    outputs.warnings.splice(0..0, warnings);
    outputs.notes = notes;
    Ok(outputs)
}

/// The comparison of two hulls with their rows.
pub(in crate::report) fn compared(
    hulls: [ComparedHull; 2],
    roles: [&'static str; 2],
    conventions: Conventions,
    rows: Vec<[Hydrostatics; 2]>,
) -> CompareOutputs {
    let values = values_of(&hulls);
    let (ahead, back) =
        join(|| surface_distance(&hulls[1].hull, &hulls[0].hull), || surface_distance(&hulls[0].hull, &hulls[1].hull));
    let distances = [ahead, back];
    CompareOutputs { hulls, roles, conventions, values, rows, distances, warnings: Vec::new(), notes: Vec::new() }
}

/// That a hull has other conventions than the first, whose serve for `both` or `all`; `remedy` is what helps.
pub(in crate::report) fn other_conventions(
    [first, other]: [(&Path, &Conventions); 2],
    which: &str,
    remedy: &str,
) -> Option<String> {
    let ((first_path, first), (path, other)) = (first, other);
    let differs = [
        ("density", first.density.to_bits() != other.density.to_bits()),
        ("coefficient length", first.coefficient_length != other.coefficient_length),
        ("section for CP", first.prismatic_section != other.prismatic_section),
        ("shell", first.shell != other.shell),
    ];
    let names: Vec<&str> = differs.into_iter().filter(|(_, differ)| *differ).map(|(name, _)| name).collect();
    let message = || {
        let names = names.join(", and its ");
        format!("its {names} differs from that of {}, which serves for {which}", first_path.display())
    };
    let warning = || Diagnostic { severity: Severity::Warning, ..problem("W520", path, message(), remedy) }.to_string();
    (!names.is_empty()).then(warning)
}

/// Round draughts up to the lesser depth, above the lowest points of both \[m\].
pub(in crate::report) fn round_draughts(stated: Option<f64>, [low, high]: [f64; 2]) -> Vec<f64> {
    let list = default_draughts(stated.filter(|draught| *draught < high), high);
    // A round draught that is as good as the design draught is left out beside it.
    let near = |draught: f64, part: f64| stated.is_some_and(|stated| (stated - draught).abs() <= part * stated);
    let inside = |draught: &f64| *draught > low && *draught <= high && (near(*draught, 1e-9) || !near(*draught, 0.01));
    let list: Vec<f64> = list.into_iter().filter(inside).collect();
    let every = list.len().div_ceil(MOST_DRAUGHTS).max(1);
    let kept = list.iter().enumerate().filter(|(k, draught)| k % every == 0 || near(**draught, 1e-9));
    kept.map(|(_, draught)| *draught).collect()
}

fn common_draughts(first: &HydrostaticBody, second: &HydrostaticBody) -> Result<Vec<f64>, Failure> {
    let low = first.lowest().max(second.lowest());
    let high = first.particulars.depth.min(second.particulars.depth);
    let list = round_draughts(first.particulars.draught, [low, high]);
    if list.is_empty() {
        let message = "the hulls have no common draught: one ends below the lowest point of the other";
        return Err(Failure::Usage(message.to_owned()));
    }
    Ok(list)
}

fn values_of(hulls: &[ComparedHull; 2]) -> Vec<ComparedValue> {
    type Particular = (&'static str, &'static str, fn(&PrincipalParticulars) -> Option<f64>);
    let particulars: [Particular; 4] = [
        ("LPP", "length between perpendiculars", |p| Some(p.length_between_perpendiculars)),
        ("B", "moulded breadth", |p| Some(p.breadth)),
        ("T", "draught, moulded", |p| p.draught),
        ("D", "depth to the deck at side", |p| Some(p.depth)),
    ];
    let particular = |(key, name, of): Particular| {
        let values = [of(&hulls[0].particulars), of(&hulls[1].particulars)];
        ComparedValue { key, name, unit: "m", decimals: 3, values, change: per_cent(values) }
    };
    let afloat = |quantity: &'static Quantity| {
        let of = |hull: &ComparedHull| hull.row.as_ref().and_then(quantity.value).filter(|value| value.is_finite());
        let values = [of(&hulls[0]), of(&hulls[1])];
        let decimals = values[0].map_or(quantity.decimals, |value| quantity.decimals_of(value));
        let change = match quantity.key {
            "XCB" | "XWL" => centre_change(values, hulls),
            "XCBPC" => values[0].zip(values[1]).map(|(a, b)| b - a),
            _ => per_cent(values),
        };
        ComparedValue { key: quantity.key, name: quantity.name, unit: quantity.unit, decimals, values, change }
    };
    let quantities = AFLOAT.into_iter().filter_map(Quantity::of).map(afloat);
    particulars.into_iter().map(particular).chain(quantities).collect()
}

/// The change of a longitudinal centre over its own L_PP, in per cent.
fn centre_change(values: [Option<f64>; 2], hulls: &[ComparedHull; 2]) -> Option<f64> {
    let part = |k: usize| Some(values[k]? / hulls[k].particulars.length_between_perpendiculars);
    Some(100.0 * (part(1)? - part(0)?))
}

/// The figures: body plans, and curves of areas where both state a draught.
fn figures(outputs: &CompareOutputs) -> Result<Vec<(&'static str, Svg)>, Failure> {
    let [a, b] = &outputs.hulls;
    let words = format!("{}   stations L_PP / {}", outputs.draughts(), outputs.conventions.stations.spaces);
    let sheet = ComparedHulls {
        hulls: [&a.hull, &b.hull],
        names: [&a.name, &b.name],
        roles: outputs.roles,
        draughts: [a.particulars.draught, b.particulars.draught],
        stations: outputs.conventions.stations,
        words: &words,
    };
    let internal = |error: crate::plot::PlotError| Failure::Internal(format!("comparison: {error}"));
    let body = compared_body_plans(&sheet).map_err(internal)?;
    let areas = compared_areas(&ComparedHulls { words: &outputs.draughts(), ..sheet }).map_err(internal)?;
    Ok([Some(("compared-body-plans", body)), areas.map(|areas| ("compared-areas", areas))]
        .into_iter()
        .flatten()
        .collect())
}

/// The files of a comparison without their manifest: `compare.md`, `compare.csv`, `compare.json`, and the figures as PNG and
/// SVG.
pub(in crate::report) fn comparison_files(outputs: &CompareOutputs, drawn: bool) -> Result<Vec<OutputFile>, Failure> {
    let file = outputs.file();
    let mut files =
        vec![OutputFile::text("compare.csv", compare_csv(&file)), json_file("compare.json", &compare_json(&file))?];
    let figures = if drawn { figures(outputs)? } else { Vec::new() };
    let names: Vec<&str> = figures.iter().map(|(name, _)| *name).collect();
    files.push(OutputFile::text("compare.md", compare_markdown(outputs, &names)));
    for (name, figure) in figures {
        let contents = figure.to_png(DOTS_PER_INCH).map_err(|e| Failure::Internal(format!("{name}: {e}")))?;
        files.push(OutputFile { name: format!("{name}.png"), contents });
        files.push(OutputFile::text(&format!("{name}.svg"), figure.as_str().to_owned()));
    }
    Ok(files)
}

/// The files of a comparison, and their manifest.
///
/// # Errors
/// [`Failure::FileSystem`] when a hull cannot be read again for its hash; [`Failure::Internal`] when a figure cannot be
/// drawn.
pub fn compare_files(outputs: &CompareOutputs, drawn: bool) -> Result<Vec<OutputFile>, Failure> {
    let mut files = comparison_files(outputs, drawn)?;
    let entry = |path: &PathBuf| Ok(manifest_entry(path, &read_bytes(path)?));
    let entries: Result<Vec<_>, Failure> =
        outputs.hulls.iter().filter_map(|hull| hull.input.as_ref()).map(entry).collect();
    let mut entries = entries?.into_iter();
    if let Some(input) = entries.next() {
        let manifest = manifest_of(input, entries.collect(), &files)?;
        files.push(manifest);
    }
    Ok(files)
}
