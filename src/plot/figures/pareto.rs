//! Deviation against fairness: what smoothing alone makes of the table, weight by weight, and where the fair hull stands.
//!
//! A point of the curve cannot be bettered in both; the hull with all its targets lies above the curve, and how far is
//! what the targets cost. The surface through the table has no deviation and the energy of all its bumps. The energy of a
//! field is measured by that of the likeliest one, which is on the front.

use crate::fairing::record::FairRecord;
use crate::plot::paper::canvas::{Anchor, Canvas, Rectangle, TextStyle};
use crate::plot::paper::chart::{Axis, Chart, Series, colour};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LEAST_LETTERS;
use crate::plot::paper::label::LabelPlacer;
use crate::plot::paper::scale::nice_step;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;

/// Size of the sheet \[mm\].
const SHEET: [f64; 2] = [240.0, 160.0];
/// How far the chart goes beyond the deviation of the fair hull.
const BEYOND: f64 = 2.5;
/// Room for half a mark, as a part of an axis.
const MARK: f64 = 0.02;

/// Name of the axis of energies.
pub(in crate::plot) fn energy_axis(is_field: bool) -> &'static str {
    if is_field { "energy / that of the likeliest field" } else { "energy / that of the start" }
}

/// Draws the front; none where the weight was given and nothing was tried.
///
/// # Errors
/// [`PlotError`] when the chart cannot be drawn.
pub fn pareto_figure(record: &FairRecord) -> Result<Option<Svg>, PlotError> {
    Ok(compose(record)?.map(|canvas| Svg::new(canvas.finish("pareto"))))
}

pub(in crate::plot) fn compose(record: &FairRecord) -> Result<Option<Canvas>, PlotError> {
    // Deviation [mm] and power of ten of the energy over that of the surface through the table, or of the likeliest field.
    let unit = if record.energy[0] > 0.0 { record.energy[0] } else { 1.0 };
    let point = |rms: f64, energy: f64| (rms.is_finite() && energy > 0.0).then(|| [1e3 * rms, (energy / unit).log10()]);
    let mut front: Vec<[f64; 2]> =
        record.trials.iter().chain([&record.chosen]).filter_map(|trial| point(trial.rms, trial.energy)).collect();
    front.sort_by(|a, b| a[0].total_cmp(&b[0]));
    front.dedup();
    let (rms, _, _) = record.moves();
    let [start, fair] = [point(0.0, record.energy[0]).filter(|_| !record.is_field), point(rms, record.energy[1])];
    let (Some(fair), true) = (fair, front.len() > 2) else { return Ok(None) };
    let chosen = point(record.chosen.rms, record.chosen.energy);
    let reach = BEYOND * chosen.map_or(fair[0], |at| at[0].max(fair[0]));
    let inside = front.iter().filter(|at| at[0] <= reach).count();
    let weights = front.iter().take(inside).copied().collect::<Vec<_>>();
    // The curve goes on to the edge of the chart.
    if let (Some(&a), Some(&b)) = (front.get(inside.saturating_sub(1)), front.get(inside)) {
        let edge = a[1] + (reach - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
        front.truncate(inside);
        front.push([reach, edge]);
    }
    let last = front.iter().map(|at| at[0]).fold(0.0, f64::max);
    let marks = [start, Some(fair), chosen];
    let heights = || front.iter().chain(marks.iter().flatten()).map(|at| at[1]);
    let (low, high) = (heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max));
    // Marks at the ends of the axes stand inside the frame.
    let (end, room) = (last.max(fair[0]), MARK * (high - low));
    let chart = Chart {
        frame: Rectangle::new(26.0, 28.0, SHEET[0] - 16.0, SHEET[1] - 24.0),
        bottom: Axis::exact(
            "deviation of the offsets, RMS [mm]",
            -MARK * end,
            (1.0 + MARK) * end,
            nice_step(end, 12.0),
        ),
        left: Axis::powers(energy_axis(record.is_field), low - room, high + room, 8),
        top: None,
        right: None,
        text_size: 2.8,
    };
    let mut canvas = Canvas::new(SHEET[0], SHEET[1]);
    let words = format!(
        "the fair hull has {:.1} % of the energy of {}, {:.3} mm RMS from the offsets of the table",
        100.0 * 10f64.powf(fair[1]),
        if record.is_field { "the likeliest field" } else { "the surface through the table" },
        fair[0]
    );
    caption::head(&mut canvas, SHEET[0], "DEVIATION AGAINST FAIRNESS", &record.name, &words);
    let mut placer = LabelPlacer::default();
    let places: Vec<[f64; 2]> = weights.iter().map(|&at| chart.place(at)).collect();
    let series = [Series {
        name: "smoothing alone",
        points: front,
        secondary: false,
        colour: colour::BLUE,
        dash: None,
        name_at: 0.75,
    }];
    chart.draw(&mut canvas, &mut placer, &series, &[])?;
    for at in places {
        canvas.fill(&Rectangle::new(at[0] - 0.6, at[1] - 0.6, at[0] + 0.6, at[1] + 0.6), "#0072b2");
    }
    // Marks differ in shape as well as in colour.
    let named = [
        (start, "before: the surface through the table", "#000000", 3),
        (chosen, "the weight that was taken", "#0072b2", 4),
        (Some(fair), "the fair hull with its targets", "#c00000", 24),
    ];
    for (at, _, ink, corners) in named {
        let Some([x, y]) = at.map(|at| chart.place(at)) else { continue };
        let corner = |k: i32| {
            let (s, c) = (std::f64::consts::TAU * f64::from(k) / f64::from(corners)).sin_cos();
            [x + 1.7 * s, y - 1.7 * c]
        };
        canvas.area(&(0..corners).map(corner).collect::<Vec<_>>(), ink);
        placer.take(Rectangle::new(x - 1.9, y - 1.9, x + 1.9, y + 1.9));
    }
    for (at, name, ink, _) in named {
        let Some([x, y]) = at.map(|at| chart.place(at)) else { continue };
        let style = TextStyle::new(2.8, Anchor::Start).coloured(ink).halo();
        let width = Canvas::text_place([0.0, 0.0], name, &style).width();
        let places: Vec<[f64; 2]> = [-3.6, 3.6, -7.2, 7.2, -10.8, 10.8]
            .into_iter()
            .flat_map(|dy| [[x + 3.0, y + dy], [x - width - 3.0, y + dy]])
            .collect();
        placer.name_clear(&mut canvas, name, &style, &places, &chart.frame);
    }
    canvas.text([SHEET[0] - 6.0, SHEET[1] - 4.0], &caption::program(), &TextStyle::new(LEAST_LETTERS, Anchor::End));
    Ok(Some(canvas))
}
