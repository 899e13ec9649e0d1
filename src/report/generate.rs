//! The main job: a design in, every file about it out. Nothing is written here.

use std::path::Path;
use std::sync::OnceLock;

use super::failure::Failure;
use super::files::OutputFile;
use super::markdown::markdown_page;
use super::result_files::source_words;
use super::source::build;
use crate::config::{Design, Diagnostic, Severity};
use crate::exchange::{
    Manifest, ManifestEntry, SummaryFile, TargetLine, ValueLine, conventions_json, conventions_toml, heights_csv,
    hydrostatics_csv, offsets_csv, row_json, write_hull,
};
use crate::hull::{Hull, OffsetStation, OffsetTable, default_buttocks, default_stations, default_waterlines};
use crate::hydrostatics::{CurvesOfForm, Hydrostatics, default_draughts};
use crate::parametric::Family;
use crate::plot::{Figure, FigureInputs};
use crate::units::{Notation, decimal};

/// What the main job gives.
#[derive(Debug, Clone)]
pub struct Outputs {
    /// The hull.
    pub hull: Hull,
    /// The design condition.
    #[doc(hidden)]
    pub summary: SummaryFile,
    /// Hydrostatics at the design draught.
    pub design_row: Hydrostatics,
    /// The hydrostatic table.
    pub table: CurvesOfForm,
    /// Remarks about the design.
    pub remarks: Vec<Diagnostic>,
    /// The files, in the order of their names; the manifest is the last.
    pub files: Vec<OutputFile>,
}

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

fn internal(what: &str, error: &dyn std::fmt::Display) -> Failure {
    Failure::Internal(format!("{what}: {error}"))
}

/// A file of JSON with a line end.
pub(super) fn json_file(name: &str, value: &impl serde::Serialize) -> Result<OutputFile, Failure> {
    let text = serde_json::to_string_pretty(value).map_err(|e| internal(name, &e))?;
    Ok(OutputFile::text(name, text + "\n"))
}

/// The figures as files, without those at a draught that nobody stated.
pub(super) fn figure_files(inputs: &FigureInputs<'_>, figures: &[Figure]) -> Result<Vec<OutputFile>, Failure> {
    let file = |figure: &Figure| {
        let svg = figure.draw(inputs).map_err(|e| internal(figure.key(), &e))?;
        // The body plan goes into documents and cutters as it is; the others are looked at.
        Ok(match figure {
            Figure::Sections => OutputFile::text("sections.svg", svg.as_str().to_owned()),
            _ => OutputFile {
                name: format!("{}.png", figure.key()),
                contents: svg.to_png(figure.dots_per_inch()).map_err(|e| internal(figure.key(), &e))?,
            },
        })
    };
    let there = |figure: &&Figure| inputs.design.is_some() || !figure.needs_draught();
    figures.iter().filter(there).map(file).collect()
}

/// The entry of a file that was read.
pub(super) fn manifest_entry(path: &Path, bytes: &[u8]) -> ManifestEntry {
    ManifestEntry::new(&path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default(), bytes)
}

/// The manifest of a run that wrote `files`.
pub(super) fn manifest_file(input: ManifestEntry, files: &[OutputFile]) -> Result<OutputFile, Failure> {
    manifest_of(input, Vec::new(), files)
}

/// The manifest of a run that read `others` besides.
pub(super) fn manifest_of(
    input: ManifestEntry,
    others: Vec<ManifestEntry>,
    files: &[OutputFile],
) -> Result<OutputFile, Failure> {
    let manifest = Manifest {
        program: env!("CARGO_PKG_NAME"),
        version: env!("CARGO_PKG_VERSION"),
        input,
        others,
        outputs: files.iter().map(|file| ManifestEntry::new(&file.name, &file.contents)).collect(),
    };
    json_file("manifest.json", &manifest)
}
