//! The catalogue: hulls that the program carries, and those of a folder, with their particulars and sources.
//!
//! A hull of the catalogue is a design of `loftsman new`, or a table of offsets with its source and licence in its comments.
//! `catalogue:NAME` stands for its file wherever a hull is read. The index has the particulars of all, made from the files.
//!
//! Closeness to wanted particulars is the root mean square of what each is off by: ln(x/x_0)/0.1 of lengths, (c - c_0)/0.02
//! of coefficients, and (LCB - LCB_0)/1 % of L_PP.

pub(crate) use crate::report::input::carried::catalogue_names;
pub(in crate::report) use crate::report::input::carried::{INDEX, PREFIX, carried, comment};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::config::TEMPLATES;
use crate::hydrostatics::{CurvesOfForm, default_draughts};
use crate::plot::{Figure, FigureInputs};
use crate::report::failure::Failure;
use crate::report::input::hydrostatic_body::read_hydrostatic_body;
use crate::report::input::source::read_source;
use crate::report::output::files::OutputFile;
use crate::report::output::manifest::figure_files;

/// What is off by so much counts as 1: natural logarithms of lengths, coefficients, LCB in per cent of L_PP.
const LENGTH_OFF: f64 = 0.1;
const COEFFICIENT_OFF: f64 = 0.02;
const LCB_OFF: f64 = 1.0;

/// A hull of the catalogue.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CatalogueEntry {
    /// Its name.
    pub name: String,
    /// What it is.
    pub title: String,
    /// Where its form comes from.
    pub source: String,
    /// Under which licence it is carried.
    pub licence: String,
    /// Length between perpendiculars \[m\].
    #[serde(rename = "L")]
    pub length: f64,
    /// Breadth \[m\].
    #[serde(rename = "B")]
    pub breadth: f64,
    /// Draught \[m\].
    #[serde(rename = "T")]
    pub draught: f64,
    /// Displacement volume \[m^3\].
    #[serde(rename = "volume")]
    pub volume: f64,
    /// Block coefficient.
    #[serde(rename = "Cb")]
    pub block: f64,
    /// Midship section coefficient; none where midship is not known.
    #[serde(rename = "Cm")]
    pub midship: Option<f64>,
    /// Waterplane coefficient.
    #[serde(rename = "Cwp")]
    pub waterplane: f64,
    /// LCB from midship, + forward [% of L_PP].
    #[serde(rename = "LCB")]
    pub lcb: Option<f64>,
}

/// Keys of particulars that may be wanted, and those that are lengths.
pub const WANTED: [&str; 8] = ["L", "B", "T", "volume", "Cb", "Cm", "Cwp", "LCB"];

impl CatalogueEntry {
    /// A particular by its key.
    #[must_use]
    pub fn particular(&self, key: &str) -> Option<f64> {
        match key {
            "L" => Some(self.length),
            "B" => Some(self.breadth),
            "T" => Some(self.draught),
            "volume" => Some(self.volume),
            "Cb" => Some(self.block),
            "Cm" => self.midship,
            "Cwp" => Some(self.waterplane),
            "LCB" => self.lcb,
            _ => None,
        }
    }

    /// How far it is from what is wanted, as the head of the module says; none where it lacks one of the particulars.
    #[must_use]
    pub fn distance(&self, wanted: &[(&'static str, f64)]) -> Option<f64> {
        let off = |&(key, value): &(&'static str, f64)| {
            let own = self.particular(key)?;
            Some(match key {
                "L" | "B" | "T" => (own / value).ln() / LENGTH_OFF,
                // A volume is a cube of lengths.
                "volume" => (own / value).ln() / (3.0 * LENGTH_OFF),
                "LCB" => (own - value) / LCB_OFF,
                _ => (own - value) / COEFFICIENT_OFF,
            })
        };
        let all: Vec<f64> = wanted.iter().map(off).collect::<Option<_>>()?;
        Some((all.iter().map(|off| off * off).sum::<f64>() / all.len().max(1) as f64).sqrt())
    }
}

fn rounded(value: f64, decimals: i32) -> f64 {
    let step = 10f64.powi(decimals);
    (value * step).round() / step + 0.0
}

/// The particulars of the hull in a file, with words about it; none of a hull without a draught.
///
/// # Errors
/// Those of reading the hull.
fn entry(path: &Path, name: &str, [title, source, licence]: [&str; 3]) -> Result<Option<CatalogueEntry>, Failure> {
    let body = read_hydrostatic_body(path)?;
    let Some(draught) = body.particulars.draught else { return Ok(None) };
    let (table, _) = body.curves_of_form(&[draught], &body.conventions)?;
    let found = table.rows.first().and_then(|row| Some((row, row.block_coefficient?, row.waterplane_coefficient?)));
    let Some((row, block, waterplane)) = found else { return Ok(None) };
    let of = |value: Option<f64>| value.map(|value| rounded(value, 4));
    Ok(Some(CatalogueEntry {
        name: name.to_owned(),
        title: title.to_owned(),
        source: source.to_owned(),
        licence: licence.to_owned(),
        length: rounded(body.particulars.length_between_perpendiculars, 3),
        breadth: rounded(body.particulars.breadth, 3),
        draught: rounded(draught, 3),
        volume: rounded(row.displacement_volume, 1),
        block: rounded(block, 4),
        midship: of(row.midship_coefficient),
        waterplane: rounded(waterplane, 4),
        lcb: of(row.lcb_percent),
    }))
}

/// The index of the hulls that the program carries, made anew from their files.
///
/// # Errors
/// Those of reading a hull, and of writing CSV.
pub fn index_csv() -> Result<String, Failure> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let failed = |error: &dyn std::fmt::Display| Failure::Internal(error.to_string());
    for name in catalogue_names() {
        let path = PathBuf::from(format!("{PREFIX}{name}"));
        let text = carried(name).map(|(_, text)| text).unwrap_or_default();
        let words = match TEMPLATES.iter().find(|template| template.name == name) {
            Some(template) => [template.title, "a preset of the program", "that of the program"],
            None => [comment(&text, "type"), comment(&text, "source"), comment(&text, "licence")],
        };
        if let Some(entry) = entry(&path, name, words)? {
            writer.serialize(&entry).map_err(|error| failed(&error))?;
        }
    }
    let bytes = writer.into_inner().map_err(|error| failed(&error))?;
    String::from_utf8(bytes).map_err(|error| failed(&error))
}

/// The hulls that the program carries, and those of a folder; and which files of the folder are left out, and why.
///
/// # Errors
/// [`Failure::FileSystem`] for a folder that cannot be read.
pub fn catalogue(folder: Option<&Path>) -> Result<(Vec<CatalogueEntry>, Vec<String>), Failure> {
    let mut entries: Vec<CatalogueEntry> = csv::Reader::from_reader(INDEX.as_bytes())
        .deserialize()
        .collect::<Result<_, _>>()
        .map_err(|error| Failure::Internal(format!("index of the catalogue: {error}")))?;
    let mut left_out = Vec::new();
    let Some(folder) = folder else { return Ok((entries, left_out)) };
    let failed = |error| Failure::FileSystem { act: "read", path: folder.to_owned(), error };
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(folder).map_err(failed)?.filter_map(|item| Some(item.ok()?.path())).collect();
    files.sort();
    for path in files.iter().filter(|path| path.is_file()) {
        // A TOML beside a table has its conventions.
        let beside = |ending: &str| path.with_extension(ending).is_file();
        if path.extension().is_some_and(|ending| ending == "toml") && (beside("csv") || beside("xlsx")) {
            continue;
        }
        let is_picture = |ending: &std::ffi::OsStr| ["png", "svg", "pdf"].iter().any(|known| ending == *known);
        if path.extension().is_some_and(is_picture) {
            continue;
        }
        let name = path.display().to_string();
        match entry(path, &name, ["", "the folder", ""]) {
            Ok(Some(entry)) => entries.push(entry),
            Ok(None) => left_out.push(format!("{name} is left out: it states no draught")),
            Err(error) => {
                let text = error.to_string();
                left_out.push(format!("{name} is left out: {}", text.lines().next().unwrap_or_default()));
            }
        }
    }
    Ok((entries, left_out))
}

/// Entries with their distances from what is wanted, the nearest first; those that lack a particular last.
#[must_use]
pub fn ranked(entries: Vec<CatalogueEntry>, wanted: &[(&'static str, f64)]) -> Vec<(CatalogueEntry, Option<f64>)> {
    let mut list: Vec<_> = entries
        .into_iter()
        .map(|entry| (entry.distance(wanted).filter(|_| !wanted.is_empty()), entry))
        .map(|(d, e)| (e, d))
        .collect();
    list.sort_by(|a, b| a.1.unwrap_or(f64::INFINITY).total_cmp(&b.1.unwrap_or(f64::INFINITY)));
    list
}

/// The lines plan of a hull that the program carries, `NAME.png`.
///
/// # Errors
/// Those of reading the hull, and [`Failure::Internal`] when it cannot be drawn.
pub fn catalogue_picture(name: &str) -> Result<OutputFile, Failure> {
    let source = read_source(&PathBuf::from(format!("{PREFIX}{name}")))?;
    let (hull, conventions) = (&source.hull, &source.conventions);
    let p = *hull.particulars();
    let curves = CurvesOfForm::new(hull, &default_draughts(p.draught, p.depth), conventions);
    let design = p.draught.and_then(|draught| CurvesOfForm::new(hull, &[draught], conventions).rows.pop());
    let inputs = FigureInputs {
        hull,
        before: None,
        record: None,
        design: design.as_ref(),
        curves: &curves,
        source: None,
        dense: None,
    };
    let drawn = figure_files(&inputs, &[Figure::Lines])?;
    let picture = drawn.into_iter().find(|file| file.name.ends_with(".png"));
    let missing = || Failure::Internal(format!("no picture of {name} was drawn"));
    Ok(OutputFile { name: format!("{name}.png"), ..picture.ok_or_else(missing)? })
}

/// The list as a page; with distances where something is wanted.
#[must_use]
pub fn catalogue_page(list: &[(CatalogueEntry, Option<f64>)], with_distances: bool) -> String {
    let width = list.iter().map(|(entry, _)| entry.name.chars().count()).max().unwrap_or(0).max(4);
    let off = if with_distances { "     off" } else { "" };
    let mut page =
        format!("{:<width$}    Lpp m     B m     T m  volume m3      CB      CM     CWP   LCB %{off}\n", "name");
    for (entry, distance) in list {
        let optional = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.4}"));
        let lcb = entry.lcb.map_or_else(|| "-".to_owned(), |lcb| format!("{lcb:+.2}"));
        page.push_str(&format!(
            "{:<width$} {:>8.2} {:>7.3} {:>7.3} {:>10.1} {:>7.4} {:>7} {:>7.4} {lcb:>7}",
            entry.name,
            entry.length,
            entry.breadth,
            entry.draught,
            entry.volume,
            entry.block,
            optional(entry.midship),
            entry.waterplane,
        ));
        if with_distances {
            page.push_str(&distance.map_or_else(|| "       -".to_owned(), |distance| format!(" {distance:>7.2}")));
        }
        page.push('\n');
    }
    page
}

/// The list as JSON.
#[must_use]
pub fn catalogue_json(list: &[(CatalogueEntry, Option<f64>)]) -> Value {
    let one = |(entry, distance): &(CatalogueEntry, Option<f64>)| {
        let mut value = json!(entry);
        if let (Some(object), Some(distance)) = (value.as_object_mut(), distance) {
            object.insert("distance".to_owned(), json!(distance));
        }
        value
    };
    json!({ "hulls": list.iter().map(one).collect::<Vec<_>>() })
}

/// The file of a hull that the program carries, for a folder: its name and its text; none for another name.
#[must_use]
pub fn catalogue_file(name: &str) -> Option<(String, String)> {
    carried(name).map(|(ending, text)| (format!("{name}.{ending}"), text))
}
