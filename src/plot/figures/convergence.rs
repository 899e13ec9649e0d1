//! How the last program was solved: residuals and gap of each iterate of the interior point, as powers of ten.

use crate::fairing::record::FairRecord;
use crate::plot::paper::canvas::{Anchor, Canvas, Rectangle, TextStyle};
use crate::plot::paper::chart::{Axis, Chart, Series, colour};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LEAST_LETTERS;
use crate::plot::paper::label::LabelPlacer;
use crate::plot::paper::scale::nice_step;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;
use crate::qp::Progress;

/// Size of the sheet \[mm\].
const SHEET: [f64; 2] = [240.0, 150.0];
/// Sizes below this are rounding, and drawn here.
const LEAST: f64 = 1e-18;

/// Draws the iterates; none where there are fewer than two.
///
/// # Errors
/// [`PlotError`] when the chart cannot be drawn.
pub fn convergence_figure(record: &FairRecord) -> Result<Option<Svg>, PlotError> {
    if record.progress.len() < 2 {
        return Ok(None);
    }
    let line = |name: &'static str, colour: [u8; 3], dash, name_at: f64, of: fn(&Progress) -> f64| {
        let point = |(k, progress): (usize, &Progress)| [k as f64, of(progress).max(LEAST).log10()];
        let points = record.progress.iter().enumerate().map(point).collect();
        Series { name, points, secondary: false, colour, dash, name_at }
    };
    let series = [
        line("limits", colour::BLUE, None, 0.3, |p| p.primal),
        line("gradient", colour::VERMILION, Some([3.2, 1.0]), 0.5, |p| p.dual),
        line("gap", colour::GREEN, Some([1.5, 0.9]), 0.7, |p| p.gap),
    ];
    let values = series.iter().flat_map(|one| &one.points).map(|point| point[1]);
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    let last = (record.progress.len() - 1) as f64;
    let frame = Rectangle::new(26.0, 28.0, SHEET[0] - 16.0, SHEET[1] - 24.0);
    let chart = Chart {
        frame,
        bottom: Axis::exact("iterate", 0.0, last, nice_step(last, 20.0).max(1.0)),
        left: Axis::new("log10 of the relative size", low, high, 10.0),
        top: None,
        right: None,
        text_size: 2.8,
    };
    let mut canvas = Canvas::new(SHEET[0], SHEET[1]);
    let words = "the last program: what limits are missed by, the gradient of the Lagrangian, the products of slacks and multipliers";
    caption::head(&mut canvas, SHEET[0], "CONVERGENCE", &record.name, words);
    chart.draw(&mut canvas, &mut LabelPlacer::default(), &series, &[])?;
    canvas.text([SHEET[0] - 6.0, SHEET[1] - 4.0], &caption::program(), &TextStyle::new(LEAST_LETTERS, Anchor::End));
    Ok(Some(Svg::new(canvas.finish("convergence"))))
}
