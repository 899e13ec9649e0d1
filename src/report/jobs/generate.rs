//! The main job: a design in, every file about it out. Nothing is written here.

use super::outputs::Outputs;
pub(in crate::report) use crate::report::output::manifest::{
    figure_files, internal, json_file, manifest_entry, manifest_file,
};
use std::path::Path;
use std::sync::OnceLock;

use super::markdown::markdown_page;
use crate::config::{Design, Diagnostic, Severity};
use crate::exchange::{
    SummaryFile, TargetLine, ValueLine, conventions_json, conventions_toml, heights_csv, hydrostatics_csv, offsets_csv,
    row_json, write_hull,
};
use crate::hull::{Hull, OffsetStation, OffsetTable, default_buttocks, default_stations, default_waterlines};
use crate::hydrostatics::{CurvesOfForm, default_draughts};
use crate::parametric::Family;
use crate::plot::{Figure, FigureInputs};
use crate::report::failure::Failure;
use crate::report::input::source::build;
use crate::report::output::files::OutputFile;
use crate::report::output::manifest::source_words;
use crate::units::{Notation, decimal};

fn family_word(family: &Family) -> &'static str {
    match family {
        Family::Cosh(_) => "cosh",
        Family::UclCosh(_) => "ucl-cosh",
        Family::Wigley(_) => "wigley",
        Family::Box(_) => "box",
        Family::Ellipsoid(_) => "ellipsoid",
    }
}

/// Positions of the stations of the offset table.
fn stations(design: &Design, hull: &Hull) -> Vec<OffsetStation> {
    let named = |x: f64, name: String| OffsetStation { name, x };
    if let Some(list) = &design.output.stations {
        return list.iter().map(|&x| named(x, format!("{x}"))).collect();
    }
    let stations = default_stations(hull, design.conventions.stations).into_iter();
    stations.map(|s| OffsetStation { x: decimal(s.x), ..s }).collect()
}

/// Generates the hull of a design, its tables and its figures. `input` is the file name and the bytes of the design,
/// for the manifest; `figures` are drawn.
///
/// # Errors
/// [`Failure::Infeasible`] with every reason; [`Failure::Internal`] when a table or a figure cannot be made.
pub fn generate_outputs(design: &Design, input: (&Path, &[u8]), figures: &[Figure]) -> Result<Outputs, Failure> {
    let generated = build(design)?;
    let hull = generated.hull;
    let particulars = *hull.particulars();
    let draughts =
        design.output.draughts.clone().unwrap_or_else(|| default_draughts(particulars.draught, particulars.depth));
    // All draughts in one pass over the surface: those of the table, the design draught, those of the reference.
    let mut all = draughts.clone();
    all.push(hull.reference_height());
    all.extend(design.reference.iter().flat_map(|reference| reference.rows.iter().map(|row| row.draught)));
    let mut table = CurvesOfForm::new(&hull, &all, &design.conventions);
    let reference_rows = table.rows.split_off(draughts.len() + 1);
    let design_row = table.rows.split_off(draughts.len()).swap_remove(0);
    let waterlines = design
        .output
        .waterlines
        .clone()
        .unwrap_or_else(|| default_waterlines(&hull).into_iter().map(decimal).collect());
    let buttocks =
        design.output.buttocks.clone().unwrap_or_else(|| default_buttocks(&hull).into_iter().map(decimal).collect());
    let offsets = OffsetTable::from_hull(&hull, &stations(design, &hull), &waterlines, &buttocks);

    let mut remarks: Vec<Diagnostic> =
        generated.remarks.iter().map(|r| design.diagnose(Severity::Warning, r.code, &[r.key], &r.message)).collect();
    // The analytic bodies are what they are.
    let of_a_ship = matches!(design.family, Family::Cosh(_) | Family::UclCosh(_));
    let unusual = design_row.unusual().into_iter().filter(|_| of_a_ship);
    remarks.extend(unusual.map(|(key, message)| design.diagnose(Severity::Warning, "W204", &[key], &message)));
    let summary = SummaryFile {
        name: design.name.clone(),
        family: family_word(&design.family),
        particulars: (&particulars).into(),
        design: row_json(&design_row),
        targets: generated
            .targets
            .iter()
            .map(|t| TargetLine {
                key: t.key.to_owned(),
                requested: t.requested,
                achieved: t.achieved,
                error: t.achieved - t.requested,
                origin: t.origin.as_str(),
            })
            .collect(),
        values: generated
            .values
            .iter()
            .map(|v| ValueLine {
                key: v.key,
                name: v.name,
                value: Some(v.value).filter(|value| value.is_finite()),
                unit: v.unit,
                origin: v.origin.as_str(),
                source: v.source.clone(),
            })
            .collect(),
        conventions: conventions_json(&design.conventions),
        remarks: remarks.iter().map(|r| format!("{} {}", r.code, r.message)).collect(),
    };

    let mut files = vec![
        OutputFile::text("hull.json", write_hull(&hull, &design.conventions).map_err(|e| internal("hull.json", &e))?),
        OutputFile::text("offsets.csv", offsets_csv(&offsets, Notation::Metres, true)),
        OutputFile::text("offsets.toml", conventions_toml(hull.particulars())),
        OutputFile::text("heights.csv", heights_csv(&offsets, Notation::Metres)),
        OutputFile::text("hydrostatics.csv", hydrostatics_csv(&table)),
        json_file("summary.json", &summary)?,
    ];
    let (source, dense) = (source_words(&manifest_entry(input.0, input.1)), OnceLock::new());
    let (source, dense) = (Some(source.as_str()), Some(&dense));
    let inputs = FigureInputs {
        hull: &hull,
        before: None,
        record: None,
        design: Some(&design_row),
        curves: &table,
        source,
        dense,
    };
    files.extend(figure_files(&inputs, figures)?);
    files.sort_by(|a, b| a.name.cmp(&b.name));
    let mut outputs = Outputs { hull, summary, design_row, table, remarks, files };
    let references: Vec<_> = design.reference.iter().cloned().collect();
    let rows = [CurvesOfForm { conventions: design.conventions, rows: reference_rows }];
    outputs.files.push(OutputFile::text("report.md", markdown_page(&outputs, &references, &rows)));
    outputs.files.sort_by(|a, b| a.name.cmp(&b.name));
    let manifest = manifest_file(manifest_entry(input.0, input.1), &outputs.files)?;
    outputs.files.push(manifest);
    Ok(outputs)
}
