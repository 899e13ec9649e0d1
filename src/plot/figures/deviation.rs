//! Histogram of the moves of the offsets against the noise that was assumed: if the moves are the noise of the table,
//! the steps follow the curve; long tails are wrong readings, a shifted middle is a change of shape.

use crate::fairing::record::FairRecord;
use crate::plot::paper::canvas::{Anchor, Canvas, Rectangle, TextStyle};
use crate::plot::paper::chart::{Axis, Chart, Series, colour};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LEAST_LETTERS;
use crate::plot::paper::label::LabelPlacer;
use crate::plot::paper::scale::nice_step;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;
use crate::units::counted;

/// Size of the sheet \[mm\].
const SHEET: [f64; 2] = [240.0, 160.0];
/// Bins over the range, at most.
const BINS: f64 = 40.0;

/// Draws the histogram; none where nothing moved.
///
/// # Errors
/// [`PlotError`] when the chart cannot be drawn.
pub fn deviation_figure(record: &FairRecord) -> Result<Option<Svg>, PlotError> {
    Ok(compose(record)?.map(|canvas| Svg::new(canvas.finish("deviation"))))
}

pub(in crate::plot) fn compose(record: &FairRecord) -> Result<Option<Canvas>, PlotError> {
    let kept = record.changes.iter().filter(|change| !change.suspect);
    let moves: Vec<f64> = kept.map(|change| 1e3 * (change.after - change.before)).collect();
    let (rms, largest, _) = record.moves();
    let range = (1e3 * largest).max(3.0 * 1e3 * record.sigma);
    if moves.is_empty() || largest <= 0.0 {
        return Ok(None);
    }
    let step = nice_step(2.0 * range, BINS);
    let first = (-range / step - 0.5).floor() as i64;
    let last = (range / step + 0.5).ceil() as i64;
    // Bin k holds (k - 1/2, k + 1/2] steps, so that no move is the commonest bin of an exact table.
    let count = |k: i64| moves.iter().filter(|m| (**m / step - 0.5).ceil() as i64 == k).count();
    let counts: Vec<usize> = (first..=last).map(count).collect();
    let mut steps = Vec::new();
    for (k, count) in (first..=last).zip(&counts) {
        let [a, b] = [k as f64 - 0.5, k as f64 + 0.5].map(|edge| edge * step);
        steps.extend([[a, *count as f64], [b, *count as f64]]);
    }
    let sigma = 1e3 * record.sigma;
    let normal = |x: f64| {
        let peak = moves.len() as f64 * step / (sigma * (std::f64::consts::TAU).sqrt());
        peak * (-0.5 * (x / sigma).powi(2)).exp()
    };
    let bell: Vec<[f64; 2]> = (-200..=200).map(|k| range * f64::from(k) / 200.0).map(|x| [x, normal(x)]).collect();
    let most = counts.iter().copied().max().unwrap_or(1) as f64;
    // A noise far below the moves is a spike beside them: its height is not shown.
    let shown = sigma > 0.2 * step && bell.iter().all(|p| p[1] < 4.0 * most);
    let top = if shown { bell.iter().map(|p| p[1]).fold(most, f64::max) } else { most };
    let frame = Rectangle::new(26.0, 28.0, SHEET[0] - 16.0, SHEET[1] - 24.0);
    let chart = Chart {
        frame,
        bottom: Axis::new("move, outward positive [mm]", -range - step, range + step, 12.0),
        left: Axis::new("offsets", 0.0, 1.05 * top, 8.0),
        top: None,
        right: None,
        text_size: 2.8,
    };
    let mut canvas = Canvas::new(SHEET[0], SHEET[1]);
    let mean = moves.iter().sum::<f64>() / moves.len() as f64;
    let words = format!(
        "{}, {:.3} mm RMS, mean {mean:+.3} mm; assumed noise {sigma:.3} mm{}",
        counted(moves.len(), "offset"),
        1e3 * rms,
        if shown { "" } else { ", too narrow or too high to be drawn" }
    );
    caption::head(&mut canvas, SHEET[0], "MOVES AND ASSUMED NOISE", &record.name, &words);
    let bars =
        Series { name: "moves", points: steps, secondary: false, colour: colour::BLUE, dash: None, name_at: 0.3 };
    let mut series = vec![bars];
    if shown {
        let dash = Some([2.4, 1.2]);
        series.push(Series {
            name: "noise",
            points: bell,
            secondary: false,
            colour: colour::VERMILION,
            dash,
            name_at: 0.62,
        });
    }
    chart.draw(&mut canvas, &mut LabelPlacer::default(), &series, &[])?;
    canvas.text([SHEET[0] - 6.0, SHEET[1] - 4.0], &caption::program(), &TextStyle::new(LEAST_LETTERS, Anchor::End));
    Ok(Some(canvas))
}
