//! The search for the smoothing weight: the L-curve, deviation from the offsets against energy, one point a weight,
//! over the criterion that decided, both axes by powers of ten.
//!
//! The criterion is generalised cross-validation, or Mallows' C_p = RSS + 2 sigma^2 edf for the errors that the table
//! has; it is shown over its least value.

use super::pareto::energy_axis;
use crate::fairing::record::FairRecord;
use crate::fairing::smoothing::{Trial, end_of_search};
use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::chart::{Axis, Chart, Series, colour};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LEAST_LETTERS;
use crate::plot::paper::label::LabelPlacer;
use crate::plot::paper::scale::figures;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;

/// Size of the sheet [mm].
const SHEET: [f64; 2] = [210.0, 230.0];
/// Height of the chart of the criterion \[mm\].
const LOWER: f64 = 52.0;
/// How far above its least value the criterion is shown.
const HIGHEST: f64 = 4.0;

/// log10 of the deviation \[mm\] and of the energy over `unit`; none where one of them is 0.
fn point(trial: &Trial, unit: f64) -> Option<[f64; 2]> {
    let point = [(1e3 * trial.rms).log10(), (trial.energy / unit).log10()];
    point.iter().all(|value| value.is_finite()).then_some(point)
}

/// What decided, and log10 of each weight with log10 of the criterion over its least value; none where the weight that
/// was taken is the best of neither, and of a field, whose likelihood has more numbers than the weight.
fn criterion(record: &FairRecord) -> Option<(&'static str, Vec<[f64; 2]>)> {
    let count = record.readings as f64;
    let mallows = |trial: &Trial| count * trial.rms * trial.rms + 2.0 * record.errors * record.errors * trial.edf;
    let shown = |name, of: &dyn Fn(&Trial) -> f64| {
        let least =
            record.trials.iter().filter(|trial| of(trial).is_finite()).min_by(|a, b| of(a).total_cmp(&of(b)))?;
        let taken = (least.lambda / record.lambda).log10().abs() < 0.01;
        let points = record.trials.iter().map(|trial| [trial.lambda.log10(), (of(trial) / of(least)).log10()]);
        let points: Vec<[f64; 2]> = points.filter(|point| point.iter().all(|value| value.is_finite())).collect();
        (taken && !points.is_empty()).then_some((name, points))
    };
    if record.is_field {
        return None;
    }
    // Hulls with a quintic net of their own are searched by cross-validation, all others by the noise of their table.
    if record.after.surface().u().degree() > 3 {
        shown("generalised cross-validation / least", &|trial| trial.gcv)
    } else {
        shown("Mallows' criterion / least", &mallows)
    }
}

/// Draws the curve; none where the weight was given and nothing was tried.
///
/// # Errors
/// [`PlotError`] when the chart cannot be drawn.
pub fn smoothing_figure(record: &FairRecord) -> Result<Option<Svg>, PlotError> {
    let unit = if record.energy[0] > 0.0 { record.energy[0] } else { 1.0 };
    let decided = criterion(record);
    let height = if decided.is_some() { SHEET[1] } else { SHEET[1] - LOWER - 16.0 };
    let trials: Vec<(f64, [f64; 2])> =
        record.trials.iter().filter_map(|trial| Some((trial.lambda, point(trial, unit)?))).collect();
    let chosen = point(&record.chosen, unit);
    if trials.len() < 2 {
        return Ok(None);
    }
    let all = trials.iter().map(|(_, point)| *point).chain(chosen);
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for point in all {
        for axis in 0..2 {
            (low[axis], high[axis]) = (low[axis].min(point[axis]), high[axis].max(point[axis]));
        }
    }
    let frame = Rectangle::new(26.0, 26.0, SHEET[0] - 16.0, SHEET[1] - LOWER - 40.0);
    let chart = Chart {
        frame,
        bottom: Axis::powers("deviation of the offsets, RMS [mm]", low[0], high[0], 10),
        left: Axis::powers(energy_axis(record.is_field), low[1], high[1], 10),
        top: None,
        right: None,
        text_size: 2.8,
    };
    let mut canvas = Canvas::new(SHEET[0], height);
    let end = end_of_search(record.lambda, &record.trials);
    let words = format!(
        "weight taken {}{end}, {:.1} degrees of freedom, for errors of {:.3} mm; figures are weights",
        figures(record.lambda, 2),
        record.edf,
        1e3 * record.errors
    );
    caption::head(&mut canvas, SHEET[0], "SEARCH FOR THE SMOOTHING WEIGHT", &record.name, &words);
    let mut placer = LabelPlacer::default();
    let points = trials.iter().map(|(_, point)| *point).collect();
    let series = [Series { name: "", points, secondary: false, colour: colour::BLUE, dash: None, name_at: 0.5 }];
    chart.draw(&mut canvas, &mut placer, &series, &[])?;
    let dot = |canvas: &mut Canvas, at: [f64; 2], half: f64, fill: &'static str| {
        canvas.fill(&Rectangle::new(at[0] - half, at[1] - half, at[0] + half, at[1] + half), fill);
    };
    let taken = chosen.map(|point| chart.place(point));
    let style = TextStyle::new(LEAST_LETTERS, Anchor::Start).halo();
    for (k, (lambda, point)) in trials.iter().enumerate() {
        let at = chart.place(*point);
        dot(&mut canvas, at, 0.6, "#1f5fa8");
        let beside = taken.is_some_and(|taken| (taken[0] - at[0]).hypot(taken[1] - at[1]) < 8.0);
        if k % 2 == 0 && !beside {
            let name = figures(*lambda, 1);
            let width = Canvas::text_place([0.0, 0.0], &name, &style).width();
            let places = [[at[0] + 1.6, at[1] - 1.2], [at[0] - width - 1.6, at[1] + 1.6], [at[0] + 1.6, at[1] + 3.0]];
            placer.name_point(&mut canvas, &name, &style, &places, &frame);
        }
    }
    if let Some(at) = taken {
        dot(&mut canvas, at, 1.3, "#c00000");
        canvas.line([at[0], at[1]], [at[0], frame.bottom], &Pen::new(0.25, "#c00000").dashed(&[1.5, 1.0]));
        let style = TextStyle::new(2.8, Anchor::Start).coloured("#c00000").halo();
        let name = format!("taken: {}", figures(record.lambda, 2));
        let width = Canvas::text_place([0.0, 0.0], &name, &style).width();
        let places = [
            [at[0] + 2.2, at[1] - 2.2],
            [at[0] - width - 2.2, at[1] + 2.4],
            [at[0] + 2.2, at[1] + 2.4],
            [at[0] - width - 2.2, at[1] - 2.2],
            [at[0] + 2.2, at[1] - 6.0],
            [at[0] - width - 2.2, at[1] - 6.0],
        ];
        placer.name_clear(&mut canvas, &name, &style, &places, &frame);
    }
    if let Some((name, points)) = decided {
        let top = frame.bottom + 20.0;
        let shown: Vec<[f64; 2]> = points.iter().copied().filter(|[_, high]| *high <= HIGHEST.log10()).collect();
        let ends = [shown[0][0], shown[shown.len() - 1][0]];
        let highest = shown.iter().map(|at| at[1]).fold(0.0, f64::max);
        let chart = Chart {
            frame: Rectangle::new(26.0, top, SHEET[0] - 16.0, top + LOWER),
            bottom: Axis::powers("smoothing weight", ends[0], ends[1], 16),
            left: Axis::powers(name, 0.0, highest.max(0.02), 7),
            top: None,
            right: None,
            text_size: 2.8,
        };
        let series =
            [Series { name: "", points: shown, secondary: false, colour: colour::BLUE, dash: None, name_at: 0.5 }];
        chart.draw(&mut canvas, &mut LabelPlacer::default(), &series, &[])?;
        series[0].points.iter().for_each(|&at| dot(&mut canvas, chart.place(at), 0.6, "#1f5fa8"));
        let at = chart.place([record.lambda.log10(), 0.0]);
        dot(&mut canvas, at, 1.3, "#c00000");
        canvas.line([at[0], at[1]], [at[0], top], &Pen::new(0.25, "#c00000").dashed(&[1.5, 1.0]));
    }
    canvas.text([SHEET[0] - 6.0, height - 4.0], &caption::program(), &TextStyle::new(LEAST_LETTERS, Anchor::End));
    Ok(Some(Svg::new(canvas.finish("lcurve"))))
}
