//! One table at several grades of fairness: deviation from its offsets against changes of sign of curvature and against
//! energy, one mark a grade.

use super::pareto::energy_axis;
use crate::fairing::outcome::Outcome;
use crate::plot::paper::canvas::{Anchor, Canvas, Rectangle, TextStyle};
use crate::plot::paper::chart::{Axis, Chart, Series, colour};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LEAST_LETTERS;
use crate::plot::paper::label::LabelPlacer;
use crate::plot::paper::scale::nice_step;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;
use crate::qp::Status;

/// Size of the sheet \[mm\].
const SHEET: [f64; 2] = [210.0, 220.0];
/// Top and bottom of the frame of each chart \[mm\].
const FRAMES: [[f64; 2]; 2] = [[28.0, 108.0], [124.0, 196.0]];
/// Radius of a mark \[mm\].
const MARK: f64 = 1.5;
/// Room for marks at the ends of an axis, as a part of it.
const ROOM: f64 = 0.04;

/// A grade of fairness in the figure.
#[derive(Debug, Clone, PartialEq)]
pub struct GradePoint {
    /// The grade, from 0 to 10.
    pub grade: f64,
    /// Root of the mean square of the moves of the offsets \[m\].
    pub rms: f64,
    /// Changes of sign of curvature on stations and waterlines.
    pub changes: usize,
    /// Energy over that before, or of a field over that of the likeliest one; none where that is 0.
    pub energy: Option<f64>,
    /// Whether all targets are met, and the optimum is proved.
    pub met: bool,
    /// Whether it is the grade that was asked for.
    pub asked: bool,
}

impl GradePoint {
    /// The point of an outcome; `asked` says whether its grade was asked for.
    #[must_use]
    pub fn new(outcome: &Outcome, asked: bool) -> Self {
        let [before, after] = outcome.energy;
        Self {
            grade: outcome.fairness.grade(),
            rms: outcome.moves().0,
            changes: outcome.changes_of_sign()[1],
            energy: (before > 0.0 && after > 0.0).then(|| after / before),
            met: outcome.status == Status::Optimal,
            asked,
        }
    }

    fn ink(&self) -> &'static str {
        if self.met { "#0072b2" } else { "#c00000" }
    }
}

/// Draws the grades of a table, in rising order; none where no offset moves. `is_field` says that energies are over that
/// of the likeliest field.
///
/// # Errors
/// [`PlotError`] when a chart cannot be drawn.
pub fn grades_figure(ship: &str, is_field: bool, grades: &[GradePoint]) -> Result<Option<Svg>, PlotError> {
    Ok(compose(ship, is_field, grades)?.map(|canvas| Svg::new(canvas.finish("grades"))))
}

pub(in crate::plot) fn compose(ship: &str, is_field: bool, grades: &[GradePoint]) -> Result<Option<Canvas>, PlotError> {
    let furthest = grades.iter().map(|point| 1e3 * point.rms).fold(0.0, f64::max);
    if !(furthest > 0.0 && furthest.is_finite()) {
        return Ok(None);
    }
    let bottom = |name: &str| Axis::exact(name, -ROOM * furthest, (1.0 + ROOM) * furthest, nice_step(furthest, 12.0));
    let frame = |[top, bottom]: [f64; 2]| Rectangle::new(26.0, top, SHEET[0] - 16.0, bottom);
    let most = grades.iter().map(|point| point.changes as f64).fold(1.0, f64::max);
    let at_most = nice_step(most, 10.0).max(1.0);
    let changes = Chart {
        frame: frame(FRAMES[0]),
        bottom: bottom(""),
        left: Axis::exact("changes of sign, stations and waterlines", -ROOM * most, (1.0 + ROOM) * most, at_most),
        top: None,
        right: None,
        text_size: 2.8,
    };
    let powers = grades.iter().filter_map(|point| point.energy).map(f64::log10);
    let [low, high] = powers.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], power| [a.min(power), b.max(power)]);
    let room = (ROOM * (high - low)).max(1e-3);
    let energies = (low <= high).then(|| Chart {
        frame: frame(FRAMES[1]),
        bottom: bottom("deviation of the offsets, RMS [mm]"),
        left: Axis::powers(energy_axis(is_field), low - room, high + room, 8),
        ..changes.clone()
    });
    let mut canvas = Canvas::new(SHEET[0], SHEET[1]);
    let words = "figures are grades of fairness; filled: the grade that was asked for";
    let red = if grades.iter().all(|point| point.met) { "" } else { "; red: not all targets are met" };
    caption::head(&mut canvas, SHEET[0], "GRADES OF FAIRNESS", ship, &format!("{words}{red}"));
    let place = |point: &GradePoint, high: Option<f64>| high.map(|high| (point.clone(), [1e3 * point.rms, high]));
    let upper: Vec<_> = grades.iter().filter_map(|point| place(point, Some(point.changes as f64))).collect();
    let lower: Vec<_> = grades.iter().filter_map(|point| place(point, point.energy.map(f64::log10))).collect();
    draw(&mut canvas, &changes, &upper)?;
    if let Some(energies) = &energies {
        draw(&mut canvas, energies, &lower)?;
    }
    canvas.text([SHEET[0] - 6.0, SHEET[1] - 4.0], &caption::program(), &TextStyle::new(LEAST_LETTERS, Anchor::End));
    Ok(Some(canvas))
}

/// One chart: the line from grade to grade, the marks and their numbers.
fn draw(canvas: &mut Canvas, chart: &Chart, points: &[(GradePoint, [f64; 2])]) -> Result<(), PlotError> {
    let mut placer = LabelPlacer::default();
    let line = points.iter().map(|(_, at)| *at).collect();
    let series = [Series { name: "", points: line, secondary: false, colour: colour::GREY, dash: None, name_at: 0.5 }];
    chart.draw(canvas, &mut placer, &series, &[])?;
    let ring = |[x, y]: [f64; 2], radius: f64| -> Vec<[f64; 2]> {
        let corner = |k: i32| {
            let (s, c) = (std::f64::consts::TAU * f64::from(k) / 24.0).sin_cos();
            [x + radius * s, y - radius * c]
        };
        (0..24).map(corner).collect()
    };
    // The one that was asked for lies over the others.
    let by_asked = |asked: bool| points.iter().filter(move |(point, _)| point.asked == asked);
    for (point, at) in by_asked(false).chain(by_asked(true)) {
        let [x, y] = chart.place(*at);
        canvas.area(&ring([x, y], MARK), point.ink());
        if !point.asked {
            canvas.area(&ring([x, y], MARK - 0.4), "#ffffff");
        }
        placer.take(Rectangle::new(x - MARK, y - MARK, x + MARK, y + MARK));
    }
    for (point, at) in by_asked(true).chain(by_asked(false)) {
        let [x, y] = chart.place(*at);
        let style = TextStyle::new(2.8, Anchor::Middle).coloured(point.ink()).halo();
        let name = point.grade.to_string();
        let around = |radius: f64| {
            [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.7, -0.7], [0.7, 0.7], [-0.7, 0.7], [-0.7, -0.7]]
                .map(|[dx, dy]| [x + radius * dx, y + radius * dy + 1.0])
        };
        let places: Vec<[f64; 2]> = [3.4, 5.2, 7.0, 9.0].into_iter().flat_map(around).collect();
        placer.name_clear(canvas, &name, &style, &places, &chart.frame);
    }
    Ok(())
}
