//! The figures of a report: what is drawn of a result, in the order of its pages, with captions that say what to look for.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use super::failure::Failure;
use super::result::JobResult;
use crate::plot::{
    Figure, FigureInputs, PlotError, Svg, fairing_body_plan, fairing_half_breadth_plan, fairing_moves, smoothing_figure,
};

/// A figure of a report.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ReportFigure {
    /// Stem of its files.
    pub(super) key: &'static str,
    /// Heading.
    pub(super) title: &'static str,
    /// What to look for.
    pub(super) caption: &'static str,
    /// The drawing.
    pub(super) svg: Svg,
    /// The picture.
    pub(super) png: Vec<u8>,
}

type Draw<'a> = Box<dyn Fn() -> Result<Option<Svg>, PlotError> + Sync + 'a>;

/// Key, heading, caption and drawing of a figure.
struct Job<'a> {
    words: [&'static str; 3],
    draw: Draw<'a>,
}

fn words(figure: Figure) -> [&'static str; 3] {
    let key = figure.key();
    match figure {
        Figure::Lines => [
            key,
            "Lines plan",
            "Sight along every line: waterlines, buttocks and diagonals run without humps, and neighbours keep their \
             distances. Diagonals cross the hull most squarely and are the judge.",
        ],
        Figure::Sections => [
            key,
            "Body plan",
            "Aft sections on the left, forward sections on the right. The gaps between neighbouring sections grow and \
             shrink evenly towards the ends.",
        ],
        Figure::SectionalArea => [
            key,
            "Sectional-area curve",
            "Its area is the displacement and its centroid the LCB. Shoulders should be no sharper than the hull needs; \
             hollows stand at the ends alone.",
        ],
        Figure::Hydrostatics => {
            [key, "Hydrostatic curves", "All curves over one axis of draught; the dash-dot line is the design draught."]
        }
        Figure::DiagramSheet => [
            key,
            "Diagram sheet",
            "The classic sheet: measure from the axis that the legend names and multiply by the scale of the curve.",
        ],
    }
}

/// What is drawn of a result.
fn jobs<'a>(result: &'a JobResult, inputs: &'a FigureInputs<'a>) -> Vec<Job<'a>> {
    let mut jobs: Vec<Job<'a>> = Vec::new();
    let standard = |figure: Figure| Job {
        words: words(figure),
        draw: Box::new(move || figure.draw(inputs).map(Some)) as Draw<'a>,
    };
    if let Some((record, _)) = &result.fairing {
        let mut add = |words: [&'static str; 3], draw: Draw<'a>| jobs.push(Job { words, draw });
        add(
            [
                "fairing-moves",
                "What moved",
                "Every offset with its move in millimetres, outward positive. Look for runs of one sign along a line: they \
                 are a change of shape, not noise. Locked cells are framed, cells at their tolerance underlined.",
            ],
            Box::new(|| fairing_moves(record).map(Some)),
        );
        add(
            [
                "fairing-body-plan",
                "Body plan before and after",
                "Combs stand on the convex side at one scale before (grey) and after (blue); their tips should run smoothly. \
                 Rings mark inflections: those that are left should be meant.",
            ],
            Box::new(|| fairing_body_plan(record).map(Some)),
        );
        add(
            [
                "fairing-half-breadth-plan",
                "Half-breadth plan before and after",
                "The same for the waterlines. Curvatures are those of the ship, however the breadths are stretched.",
            ],
            Box::new(|| fairing_half_breadth_plan(record).map(Some)),
        );
        add(
            [
                "lcurve",
                "Search for the smoothing weight",
                "Deviation from the offsets against energy, a point for each weight. The weight taken stands at the bend: to \
                 its left energy is bought dearly, to its right the offsets are given away.",
            ],
            Box::new(|| smoothing_figure(record)),
        );
    }
    jobs.extend(Figure::ALL.map(standard));
    jobs
}

/// Draws the figures of a result, pictures at `dots_per_inch`; on as many threads as there are cores, in one order.
pub(super) fn report_figures(
    result: &JobResult,
    inputs: &FigureInputs<'_>,
    dots_per_inch: f64,
) -> Result<Vec<ReportFigure>, Failure> {
    let jobs = jobs(result, inputs);
    let next = AtomicUsize::new(0);
    let drawn: Mutex<Vec<(usize, Result<Option<ReportFigure>, Failure>)>> = Mutex::new(Vec::new());
    let work = || {
        while let Some((index, job)) = Some(next.fetch_add(1, Ordering::Relaxed)).and_then(|k| Some((k, jobs.get(k)?)))
        {
            let one = figure(job, dots_per_inch);
            drawn.lock().unwrap_or_else(PoisonError::into_inner).push((index, one));
        }
    };
    let threads = thread::available_parallelism().map_or(1, usize::from).min(jobs.len());
    thread::scope(|scope| (0..threads).for_each(|_| drop(scope.spawn(work))));
    let mut drawn = drawn.into_inner().unwrap_or_else(PoisonError::into_inner);
    drawn.sort_by_key(|(index, _)| *index);
    drawn.into_iter().filter_map(|(_, figure)| figure.transpose()).collect()
}

fn figure(job: &Job<'_>, dots_per_inch: f64) -> Result<Option<ReportFigure>, Failure> {
    let [key, title, caption] = job.words;
    let failure = |error: PlotError| match error {
        PlotError::PictureSize { .. } => Failure::Usage(format!("{key}: {error}")),
        error => Failure::Internal(format!("{key}: {error}")),
    };
    let Some(svg) = (job.draw)().map_err(failure)? else { return Ok(None) };
    let png = svg.to_png(dots_per_inch).map_err(failure)?;
    Ok(Some(ReportFigure { key, title, caption, svg, png }))
}
