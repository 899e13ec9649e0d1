//! Hydrostatic curves in panels: one draught axis, related quantities together.

use crate::hydrostatics::Hydrostatics;
use crate::plot::paper::canvas::{Anchor, Canvas, Rectangle, TextStyle};
use crate::plot::paper::chart::{Axis, Chart, DESIGN, EDGE, Level, Series, colour};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LEAST_LETTERS;
use crate::plot::paper::label::LabelPlacer;
use crate::plot::ship::caption;
use crate::plot::ship::inputs::FigureInputs;

/// Size of the sheet [mm].
const SHEET: [f64; 2] = [300.0, 222.0];
/// Size of the text of a panel [mm].
const TEXT: f64 = LEAST_LETTERS;

type Value = fn(&Hydrostatics) -> Option<f64>;

struct CurveStyle {
    name: &'static str,
    secondary: bool,
    colour: [u8; 3],
    dash: Option<[f64; 2]>,
    name_at: f64,
    value: Value,
}

struct Panel {
    bottom: &'static str,
    top: Option<&'static str>,
    /// Whether the axis begins at zero.
    from_zero: bool,
    lines: &'static [CurveStyle],
}

const LONG: Option<[f64; 2]> = Some([3.2, 1.0]);
const SHORT: Option<[f64; 2]> = Some([1.5, 0.9]);
const DOTTED: Option<[f64; 2]> = Some([0.5, 0.8]);

#[rustfmt::skip]
const PANELS: [Panel; 6] = {
    use colour::{BLACK, BLUE, GREEN, PURPLE, VERMILION};
    [
        Panel { bottom: "displacement mass Δ [t], volume ∇ [m³], moulded", top: None, from_zero: true, lines: &[
            CurveStyle { name: "Δ", secondary: false, colour: BLACK, dash: None, name_at: 0.4, value: |r| Some(r.displacement_mass) },
            CurveStyle { name: "∇", secondary: false, colour: BLUE, dash: LONG, name_at: 0.65, value: |r| Some(r.displacement_volume) },
        ] },
        Panel { bottom: "LCB, LCF [m from AP]", top: Some("KB [m above base line]"), from_zero: false, lines: &[
            CurveStyle { name: "LCB", secondary: false, colour: BLACK, dash: None, name_at: 0.7, value: |r| r.lcb },
            CurveStyle { name: "LCF", secondary: false, colour: BLUE, dash: LONG, name_at: 0.5, value: |r| r.lcf },
            CurveStyle { name: "KB", secondary: true, colour: VERMILION, dash: SHORT, name_at: 0.3, value: |r| r.kb },
        ] },
        Panel { bottom: "KM_T [m above base line]", top: Some("KM_L [m above base line]"), from_zero: false, lines: &[
            CurveStyle { name: "KM_T", secondary: false, colour: BLACK, dash: None, name_at: 0.5, value: |r| r.km_transverse },
            CurveStyle { name: "KM_L", secondary: true, colour: BLUE, dash: LONG, name_at: 0.4, value: |r| r.km_longitudinal },
        ] },
        Panel { bottom: "TPC [t/cm]", top: Some("MTC [t·m/cm]"), from_zero: true, lines: &[
            CurveStyle { name: "TPC", secondary: false, colour: BLACK, dash: None, name_at: 0.5, value: |r| Some(r.tonnes_per_centimetre) },
            CurveStyle { name: "MTC", secondary: true, colour: VERMILION, dash: LONG, name_at: 0.35, value: |r| r.moment_to_change_trim },
        ] },
        Panel { bottom: "form coefficients [-]", top: None, from_zero: false, lines: &[
            CurveStyle { name: "C_B", secondary: false, colour: BLACK, dash: None, name_at: 0.5, value: |r| r.block_coefficient },
            CurveStyle { name: "C_M", secondary: false, colour: VERMILION, dash: LONG, name_at: 0.35, value: |r| r.midship_coefficient },
            CurveStyle { name: "C_X", secondary: false, colour: PURPLE, dash: DOTTED, name_at: 0.75, value: |r| r.maximum_section_coefficient },
            CurveStyle { name: "C_P", secondary: false, colour: BLUE, dash: SHORT, name_at: 0.5, value: |r| r.prismatic_coefficient },
            CurveStyle { name: "C_WP", secondary: false, colour: GREEN, dash: Some([4.5, 0.8]), name_at: 0.6, value: |r| r.waterplane_coefficient },
        ] },
        Panel { bottom: "waterplane area A_WL [m²], wetted surface S [m²]", top: None, from_zero: true, lines: &[
            CurveStyle { name: "A_WL", secondary: false, colour: BLACK, dash: None, name_at: 0.5, value: |r| Some(r.waterplane_area) },
            CurveStyle { name: "S", secondary: false, colour: BLUE, dash: LONG, name_at: 0.5, value: |r| Some(r.wetted_surface) },
        ] },
    ]
};

/// C_M and C_X that differ by less are one curve.
const SAME: f64 = 5e-5;

/// Whether the largest section is that at midship at all draughts.
fn midship_is_largest(rows: &[Hydrostatics]) -> bool {
    let mut pairs = rows.iter().filter_map(|row| row.midship_coefficient.zip(row.maximum_section_coefficient));
    pairs.all(|(midship, largest)| (midship - largest).abs() < SAME)
}

impl Panel {
    fn series(&self, rows: &[Hydrostatics]) -> Vec<Series> {
        let one = midship_is_largest(rows);
        let points = |value: Value| {
            rows.iter().filter_map(|row| Some([value(row).filter(|v| v.is_finite())?, row.draught])).collect()
        };
        self.lines
            .iter()
            .filter(|line| !(one && line.name == "C_X"))
            .map(|line| Series {
                name: if one && line.name == "C_M" { "C_M = C_X" } else { line.name },
                points: points(line.value),
                secondary: line.secondary,
                colour: line.colour,
                dash: line.dash,
                name_at: line.name_at,
            })
            .collect()
    }

    fn axis(&self, name: &str, series: &[Series], secondary: bool) -> Axis {
        let values = series.iter().filter(|one| one.secondary == secondary).flat_map(|one| &one.points).map(|p| p[0]);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        if low > high {
            return Axis::new(name, 0.0, 1.0, 5.0);
        }
        // A quantity that hardly changes is not blown up: the axis spans a fiftieth of its size at least.
        let slack = (0.01 * high.abs() - 0.5 * (high - low)).max(0.0);
        Axis::new(name, if self.from_zero { low.min(0.0) } else { low - slack }, high + slack, 6.0)
    }
}

/// Draws the panels.
pub(in crate::plot) fn draw(inputs: &FigureInputs) -> Result<Canvas, PlotError> {
    let rows = inputs.dense_rows()?;
    let draught = inputs.design.map(|design| design.draught);
    let (low, high) = rows
        .iter()
        .map(|row| row.draught)
        .chain(draught)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), draught| (a.min(draught), b.max(draught)));
    let left = Axis::new("draught T [m]", if low < 0.35 * high { 0.0 } else { low }, high, 10.0);
    let (design, immersed) = (caption::design_waterline(inputs), inputs.immersed_edge(&rows));
    let edge = immersed.map_or(String::new(), caption::immersed_edge);
    let mut levels: Vec<Level> = draught.map(|at| Level { at, name: &design, pen: DESIGN }).into_iter().collect();
    levels.extend(immersed.map(|at| Level { at, name: &edge, pen: EDGE }));
    let mut canvas = Canvas::new(SHEET[0], SHEET[1]);
    let title = format!("HYDROSTATIC CURVES – {}", caption::plain(inputs.hull.name()));
    canvas.text([0.5 * SHEET[0], 8.0], &title, &TextStyle::new(4.5, Anchor::Middle));
    canvas.text([0.5 * SHEET[0], 15.0], &caption::conventions(inputs), &TextStyle::new(2.6, Anchor::Middle));
    for (k, panel) in PANELS.iter().enumerate() {
        let corner = [19.0 + 96.0 * (k % 3) as f64, 31.0 + 98.0 * (k / 3) as f64];
        let series = panel.series(&rows);
        let chart = Chart {
            frame: Rectangle::new(corner[0], corner[1], corner[0] + 78.0, corner[1] + 74.0),
            bottom: panel.axis(panel.bottom, &series, false),
            left: left.clone(),
            top: panel.top.map(|name| panel.axis(name, &series, true)),
            right: None,
            text_size: TEXT,
        };
        let mut placer = LabelPlacer::default();
        chart.draw(&mut canvas, &mut placer, &series, &levels)?;
    }
    canvas.text([SHEET[0] - 6.0, SHEET[1] - 5.0], &caption::program(), &TextStyle::new(LEAST_LETTERS, Anchor::End));
    Ok(canvas)
}
