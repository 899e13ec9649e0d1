//! Wave resistance against fairness against moves: what each weight of the wave resistance comes to, and the knee.
//!
//! Curves join the answers of rising weights. Their abscissa is the mean of R_W over that of the first hull. The root of the
//! bending is the left ordinate, in which the knee is the point farthest from the chord; moves are the right one.

use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::chart::{Axis, Chart, Series, colour};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LEAST_LETTERS;
use crate::plot::paper::label::LabelPlacer;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;
use crate::resistance::WaveTrade;

/// Size of the sheet \[mm\].
const SHEET: [f64; 2] = [240.0, 160.0];
/// The chord from the first to the last weight.
const CHORD: Pen = Pen::new(0.25, "#7a7a7a").dashed(&[4.0, 1.5]);

/// Draws the weights, with `taken` as the knee; none where fewer than three differ.
///
/// # Errors
/// [`PlotError`] when the chart cannot be drawn.
pub fn trade_figure(name: &str, points: &[WaveTrade], taken: usize) -> Result<Option<Svg>, PlotError> {
    Ok(compose(name, points, taken)?.map(|canvas| Svg::new(canvas.finish("trade"))))
}

pub(in crate::plot) fn compose(name: &str, points: &[WaveTrade], taken: usize) -> Result<Option<Canvas>, PlotError> {
    let gain = |point: &WaveTrade| 100.0 * (point.ratio - 1.0);
    let bending: Vec<[f64; 2]> = points.iter().map(|p| [gain(p), p.energy.max(0.0).sqrt()]).collect();
    let moves: Vec<[f64; 2]> = points.iter().map(|p| [gain(p), 1e3 * p.moves]).collect();
    let ends = |list: &[[f64; 2]], axis: usize| {
        let values = list.iter().map(move |at| at[axis]);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
    };
    let ([low, high], [_, most], [_, farthest]) = (ends(&bending, 0), ends(&bending, 1), ends(&moves, 1));
    let (Some(first), Some(last), Some(knee)) = (bending.first(), bending.last(), bending.get(taken)) else {
        return Ok(None);
    };
    if points.len() < 3 || high - low <= 1e-9 || most <= 0.0 || farthest <= 0.0 {
        return Ok(None);
    }
    let chart = Chart {
        frame: Rectangle::new(28.0, 28.0, SHEET[0] - 28.0, SHEET[1] - 24.0),
        bottom: Axis::new("mean R_W, change [%]", low, high, 10.0),
        left: Axis::new("root of the energy of the change [m]", 0.0, 1.04 * most, 8.0),
        top: None,
        right: Some(Axis::new("moves of half-breadths, RMS [mm]", 0.0, 1.04 * farthest, 8.0)),
        text_size: 2.8,
    };
    let mut canvas = Canvas::new(SHEET[0], SHEET[1]);
    let words = format!(
        "the weight {:.2e} m2 is taken: R_W {:+.1} %, moves {:.1} mm RMS; thin ships (Michell)",
        points[taken].weight,
        knee[0],
        1e3 * points[taken].moves
    );
    caption::head(&mut canvas, SHEET[0], "WAVE RESISTANCE AGAINST FAIRNESS", name, &words);
    let mut placer = LabelPlacer::default();
    canvas.polyline(&[chart.place(*first), chart.place(*last)], &CHORD);
    let of = |name: &'static str, points: &[[f64; 2]], secondary: bool| Series {
        name,
        points: points.to_vec(),
        secondary,
        colour: if secondary { colour::VERMILION } else { colour::BLUE },
        dash: secondary.then_some([2.4, 1.2]),
        name_at: if secondary { 0.3 } else { 0.7 },
    };
    chart.draw(&mut canvas, &mut placer, &[of("energy", &bending, false), of("moves", &moves, true)], &[])?;
    let at: Vec<[f64; 2]> = bending.iter().map(|point| chart.place(*point)).collect();
    for (k, &[x, y]) in at.iter().enumerate() {
        let half = if k == taken { 1.5 } else { 0.8 };
        let ink = if k == taken { "#c00000" } else { "#0072b2" };
        canvas.fill(&Rectangle::new(x - half, y - half, x + half, y + half), ink);
        placer.take(Rectangle::new(x - half, y - half, x + half, y + half));
    }
    for (k, (point, &[x, y])) in points.iter().zip(&at).enumerate() {
        let (name, ink) = if k == taken {
            (format!("knee: w = {:.1e} m2", point.weight), "#c00000")
        } else {
            (format!("w = {:.1e}", point.weight), "#000000")
        };
        let style = TextStyle::new(2.6, Anchor::Start).coloured(ink).halo();
        let width = Canvas::text_place([0.0, 0.0], &name, &style).width();
        let places: Vec<[f64; 2]> = [-2.6, 1.0, 4.4, -5.8, 7.6, -9.0, -12.0, 11.0]
            .into_iter()
            .flat_map(|dy| [[x + 2.6, y + dy], [x - width - 2.6, y + dy]])
            .collect();
        placer.name_clear(&mut canvas, &name, &style, &places, &chart.frame);
    }
    canvas.text([SHEET[0] - 6.0, SHEET[1] - 4.0], &caption::program(), &TextStyle::new(LEAST_LETTERS, Anchor::End));
    Ok(Some(canvas))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// R = 1 / (1 + s) at the bending s^2: every weight is drawn, the one that is taken as the knee.
    #[test]
    fn the_knee_is_named_and_one_weight_is_no_curve() {
        let of = |s: f64| WaveTrade {
            weight: s,
            ratio: 1.0 / (1.0 + s),
            energy: s * s,
            moves: 0.01 * s,
            inflections: 0,
            keeps_signs: true,
        };
        let points = [0.1, 0.3, 0.6, 1.0, 1.6].map(of);
        let canvas = compose("ship", &points, 3).unwrap().unwrap();
        let words: Vec<&str> = canvas.texts().iter().map(|text| text.content.as_str()).collect();
        assert!(words.contains(&"knee: w = 1.0e0 m2"), "{words:?}");
        assert_eq!(words.iter().filter(|word| word.starts_with("w = ")).count(), 4, "{words:?}");
        assert!(compose("ship", &points[..1], 0).unwrap().is_none());
    }
}
