//! The job of `report`: a result in, its figures and pages out. Nothing is written here.

pub(crate) use super::settings::ReportSettings;
pub(in crate::report) use crate::report::output::manifest::source_words;
use std::sync::OnceLock;

use super::comb_lines::comb_lines;
use super::figures::report_figures;
use super::page::report_page;
use super::tables::{page_tables, report_tables};
use crate::hydrostatics::CurvesOfForm;
use crate::numeric::join;
use crate::plot::{FairingCombs, FigureInputs, Heading, Page, PlotError, write_pdf};
use crate::report::failure::Failure;
use crate::report::input::result::JobResult;
use crate::report::output::files::OutputFile;
use crate::report::output::manifest::manifest_file;

/// The files of a report, in the order of their names; the manifest is the last.
///
/// # Errors
/// [`Failure::Usage`] for a resolution that makes no picture; [`Failure::Internal`] when a figure cannot be drawn.
pub fn report_outputs(result: &JobResult, settings: &ReportSettings) -> Result<Vec<OutputFile>, Failure> {
    let hull = &result.hull;
    let mut draughts = result.draughts.clone();
    draughts.extend(hull.particulars().draught);
    let chosen = comb_lines(result, settings)?;
    let combs = || result.fairing.as_ref().map(|(record, _)| FairingCombs::new(record, &chosen));
    // The combs take as long as the curves of form.
    let (combs, mut curves) = join(combs, || CurvesOfForm::new(hull, &draughts, &result.conventions));
    let design = hull.particulars().draught.and_then(|_| curves.rows.pop());
    let start = result.fairing.as_ref().map(|(record, _)| &record.before);
    let (source, dense) =
        (result.origin.as_ref().or(result.inputs.first()).map_or(String::new(), source_words), OnceLock::new());
    let inputs = FigureInputs {
        hull,
        before: start,
        record: result.fairing.as_ref().map(|(record, _)| record),
        design: design.as_ref(),
        curves: &curves,
        source: Some(&source),
        dense: Some(&dense),
    };
    let before = result.fairing.as_ref().zip(hull.particulars().draught).and_then(|((record, _), draught)| {
        CurvesOfForm::new(&record.before, &[draught], &result.conventions).rows.pop()
    });
    let figures = report_figures(result, &inputs, before.as_ref(), combs.as_ref(), settings)?;
    let internal = |error: PlotError| Failure::Internal(format!("report.pdf: {error}"));
    let pages: Vec<Page<'_>> = figures
        .iter()
        .map(|figure| {
            let svg = figure.large.as_ref().unwrap_or(&figure.svg);
            Page { title: &figure.title, caption: figure.caption, svg }
        })
        .collect();
    let pages = &pages;
    // The PDF takes as long as page and tables together.
    let heading = Heading { ship: hull.name(), source: &source, date: settings.date.as_deref() };
    let (pdf, (page, tables)) = join(
        || write_pdf(&heading, pages, settings.sheet),
        || {
            let tables = report_tables(result, &curves);
            let offsets = tables.as_ref().map_or_else(|_| Vec::new(), |files| page_tables(result, files));
            (report_page(result, (design.as_ref(), before.as_ref()), &curves, &figures, &offsets), tables)
        },
    );
    let pdf = pdf.map_err(internal)?;
    let mut files =
        vec![OutputFile::text("report.html", page), OutputFile { name: "report.pdf".to_owned(), contents: pdf }];
    files.extend(tables?);
    for figure in figures {
        files.push(OutputFile::text(&format!("{}.svg", figure.key), figure.svg.as_str().to_owned()));
        files.push(OutputFile { name: format!("{}.png", figure.key), contents: figure.png });
    }
    files.sort_by(|a, b| a.name.cmp(&b.name));
    let input = result.inputs.first().cloned().ok_or_else(|| Failure::Internal("no input".to_owned()))?;
    let manifest = manifest_file(input, &files)?;
    files.push(manifest);
    Ok(files)
}
