//! Files of a run that every job writes in the same way: JSON, figures, the manifest.

use std::path::Path;

use super::files::OutputFile;
use crate::exchange::{Manifest, ManifestEntry};
use crate::plot::{Figure, FigureInputs};
use crate::report::failure::Failure;

pub(in crate::report) fn internal(what: &str, error: &dyn std::fmt::Display) -> Failure {
    Failure::Internal(format!("{what}: {error}"))
}

/// A file of JSON with a line end.
pub(in crate::report) fn json_file(name: &str, value: &impl serde::Serialize) -> Result<OutputFile, Failure> {
    let text = serde_json::to_string_pretty(value).map_err(|e| internal(name, &e))?;
    Ok(OutputFile::text(name, text + "\n"))
}

/// The figures as files, without those at a draught that nobody stated.
pub(in crate::report) fn figure_files(
    inputs: &FigureInputs<'_>,
    figures: &[Figure],
) -> Result<Vec<OutputFile>, Failure> {
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
pub(in crate::report) fn manifest_entry(path: &Path, bytes: &[u8]) -> ManifestEntry {
    ManifestEntry::new(&path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default(), bytes)
}

/// The manifest of a run that wrote `files`.
pub(in crate::report) fn manifest_file(input: ManifestEntry, files: &[OutputFile]) -> Result<OutputFile, Failure> {
    manifest_of(input, Vec::new(), files)
}

/// The manifest of a run that read `others` besides.
pub(in crate::report) fn manifest_of(
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

/// Digits of a hash in title blocks.
const HASH: usize = 8;

/// A file for title blocks: its name and the first digits of its SHA-256.
pub(in crate::report) fn source_words(entry: &ManifestEntry) -> String {
    let hash: String = entry.sha256.chars().take(HASH).collect();
    format!("{}  sha256 {hash}", entry.file)
}
