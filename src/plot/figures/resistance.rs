//! Resistance with its parts and effective power over speed.

use crate::plot::paper::canvas::{Anchor, Canvas, Rectangle, TextStyle};
use crate::plot::paper::chart::{Axis, Chart, Series, colour};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LEAST_LETTERS;
use crate::plot::paper::label::LabelPlacer;
use crate::plot::paper::scale::nice_step;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;
use crate::resistance::{Components, Method, PredictionRow};
use crate::units::KNOT;

/// Size of the sheet \[mm\].
const SHEET: [f64; 2] = [240.0, 165.0];
/// Parts below this share of the greatest resistance are not drawn.
const LEAST: f64 = 0.005;

/// What the figure shows.
#[derive(Debug, Clone, Copy)]
pub struct ResistanceSheet<'a> {
    /// Name of the hull.
    pub name: &'a str,
    /// The method.
    pub method: Method,
    /// A row a speed, speeds rising.
    pub rows: &'a [PredictionRow],
    /// Dimensions and conditions in one line.
    pub words: &'a str,
}

type Part = (&'static str, [u8; 3], Option<[f64; 2]>, f64, fn(&Components) -> f64);

const PARTS: [Part; 5] = [
    ("R_T", colour::BLACK, None, 0.80, Components::total),
    ("R_F (1+k_1)", colour::BLUE, Some([3.2, 1.0]), 0.55, |c| c.friction * c.form_factor),
    ("R_W", colour::VERMILION, Some([1.5, 0.9]), 0.88, |c| c.wave),
    ("R_A", colour::GREEN, Some([4.5, 0.8]), 0.65, |c| c.allowance),
    ("R_APP+R_B+R_TR", colour::GREY, Some([0.5, 0.8]), 0.45, |c| c.appendages + c.bulb + c.transom),
];

/// Draws the curves; none with fewer than two speeds.
///
/// # Errors
/// [`PlotError`] when the chart cannot be drawn.
pub fn resistance_figure(sheet: &ResistanceSheet<'_>) -> Result<Option<Svg>, PlotError> {
    let [Some(first), Some(last)] = [sheet.rows.first(), sheet.rows.last()] else { return Ok(None) };
    let knots = |row: &PredictionRow| row.components.speed / KNOT;
    let (from, to) = (knots(first), knots(last));
    if to <= from {
        return Ok(None);
    }
    let most = sheet.rows.iter().map(|row| row.components.total()).fold(0.0, f64::max);
    let drawn = |of: fn(&Components) -> f64| sheet.rows.iter().any(|row| of(&row.components) > LEAST * most);
    let mut series: Vec<Series> = PARTS
        .into_iter()
        .filter(|part| drawn(part.4))
        .map(|(name, colour, dash, name_at, of)| Series {
            name,
            points: sheet.rows.iter().map(|row| [knots(row), 1e-3 * of(&row.components)]).collect(),
            secondary: false,
            colour,
            dash,
            name_at,
        })
        .collect();
    // Kilowatts, or megawatts where there are many.
    let greatest = sheet.rows.iter().map(|row| row.components.effective_power()).fold(0.0, f64::max);
    let (unit, axis) =
        if greatest > 1e7 { (1e6, "effective power P_E [MW]") } else { (1e3, "effective power P_E [kW]") };
    series.push(Series {
        name: "P_E",
        points: sheet.rows.iter().map(|row| [row.components.froude, row.components.effective_power() / unit]).collect(),
        secondary: true,
        colour: colour::PURPLE,
        dash: None,
        name_at: 0.6,
    });
    let bottom = Axis::exact("speed [kn]", from, to, nice_step(to - from, 12.0));
    let froude = [first, last].map(|row| row.components.froude);
    let name = "Froude number on the length of the waterline";
    let chart = Chart {
        frame: Rectangle::new(26.0, 38.0, SHEET[0] - 26.0, SHEET[1] - 26.0),
        top: Some(bottom.divided(name, to / froude[1], nice_step(froude[1] - froude[0], 10.0))),
        bottom,
        left: Axis::new("resistance [kN]", 0.0, 1e-3 * most, 8.0),
        right: Some(Axis::new(axis, 0.0, greatest / unit, 8.0)),
        text_size: 2.8,
    };
    let mut canvas = Canvas::new(SHEET[0], SHEET[1]);
    caption::head(&mut canvas, SHEET[0], "RESISTANCE AND EFFECTIVE POWER", sheet.name, sheet.words);
    chart.draw(&mut canvas, &mut LabelPlacer::default(), &series, &[])?;
    let small = TextStyle::new(LEAST_LETTERS, Anchor::Start);
    let source = format!("{}: {}", sheet.method.as_str(), sheet.method.source());
    canvas.text([6.0, SHEET[1] - 4.0], &(source + &outside(sheet.rows)), &small);
    canvas.text([SHEET[0] - 6.0, SHEET[1] - 4.0], &caption::program(), &TextStyle::new(LEAST_LETTERS, Anchor::End));
    Ok(Some(Svg::new(canvas.finish("resistance"))))
}

/// What leaves the range of the data at any speed, after a gap.
fn outside(rows: &[PredictionRow]) -> String {
    let mut symbols: Vec<&str> = rows.iter().flat_map(|row| row.outside.iter().map(|range| range.symbol)).collect();
    symbols.sort_unstable();
    symbols.dedup();
    if symbols.is_empty() { String::new() } else { format!("   outside its data: {}", symbols.join(", ")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_that_are_nothing_are_not_drawn() {
        let row = |knots: f64| PredictionRow {
            components: Components {
                speed: knots * KNOT,
                froude: 0.02 * knots,
                friction: 1e3 * knots * knots,
                form_factor: 1.2,
                ..Components::default()
            },
            outside: Vec::new(),
        };
        let rows: Vec<PredictionRow> = (8..=16).map(|n| row(f64::from(n))).collect();
        let sheet = ResistanceSheet { name: "ship", method: Method::Ittc57, rows: &rows, words: "L 100 m" };
        let svg = resistance_figure(&sheet).unwrap().unwrap();
        assert!(svg.as_str().contains("effective power") && svg.as_str().contains("8th ITTC"));
        assert!(svg.as_str().contains("[kW]"));
        let one = ResistanceSheet { rows: &rows[..1], ..sheet };
        assert!(resistance_figure(&one).unwrap().is_none());
        assert!(resistance_figure(&ResistanceSheet { rows: &[], ..sheet }).unwrap().is_none());
    }
}
