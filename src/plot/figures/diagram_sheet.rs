//! The diagram sheet: the classic sheet of hydrostatic curves, read with a scale rule.
//!
//! A frame of 240 mm x 200 mm, or as high as the draughts need at their scale, with the draught upwards and three axes:
//! AP at 0, midship (L_PP / 2) at 120 mm, FP at 240 mm. Areas, volumes, inertias and heights are measured forward from
//! AP, centres and the moment to trim from midship, form coefficients aft from FP (1 mm = 0.025). The scale of a curve
//! is its largest value over its target length, rounded up to 1, 2, 2.5, 4, 5 or 10 times a power of ten; LCB and LCF
//! are scaled by their largest distance from midship. KM_L and KM_T grow without bound as the draught goes to zero:
//! they are scaled by their value at the lowest draught of 0.2 T or more, and to a smaller scale where they would
//! otherwise leave the frame above it (KM_T may rise with the draught). Further down they may run out of the frame.

use crate::hydrostatics::Hydrostatics;
use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::chart::{DESIGN, EDGE, Level, draw_level};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::label::{LabelPlacer, Preference};
use crate::plot::paper::scale::sheet_scale;
use crate::plot::ship::caption;
use crate::plot::ship::inputs::FigureInputs;
use crate::plot::ship::view::THREAD;

/// Width of the frame [mm].
const WIDTH: f64 = 240.0;
/// Largest height of the frame, and what the legend takes beside it [mm].
const HEIGHT: f64 = 200.0;
const LEGEND: f64 = 134.0;
/// Form coefficients: this much a millimetre.
const COEFFICIENT_SCALE: f64 = 0.025;
/// Below this part of the design draught KM_L and KM_T may leave the frame.
const SHALLOW: f64 = 0.2;
/// Upper left corner of the frame on the sheet [mm].
const CORNER: [f64; 2] = [24.0, 30.0];

/// The axis a curve is measured from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Axis {
    /// Forward from AP.
    Aft,
    /// From midship, forward positive.
    Midship,
    /// From midship: distances from AP, less L_PP / 2.
    MidshipOfPosition,
    /// Aft from FP.
    Fore,
}

/// Which row fixes the scale.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ScaledBy {
    /// The largest value.
    Largest,
    /// The value at the lowest draught that is no less than [`SHALLOW`] of the design draught; above it the curve stays
    /// in the frame.
    LowestDraught,
}

struct Curve {
    symbol: &'static str,
    unit: &'static str,
    axis: Axis,
    scaled_by: ScaledBy,
    /// Length that the value which fixes the scale is given [mm]; none: the scale of coefficients.
    target: Option<f64>,
    /// Part of its length at which the curve bears its name.
    name_at: f64,
    colour: &'static str,
    dash: &'static [f64],
    value: fn(&Hydrostatics) -> Option<f64>,
}

/// Dashes, dots and gaps \[mm\]: every curve has its own, so that they can be distinguished without colours.
const FULL: &[f64] = &[];
const DASHES: [&[f64]; 16] = [
    &[8.0, 1.2],
    &[4.0, 1.2],
    &[2.0, 1.2],
    &[1.0, 0.8],
    &[0.4, 0.9],
    &[8.0, 1.0, 0.5, 1.0],
    &[4.0, 1.0, 0.5, 1.0],
    &[2.0, 0.8, 0.5, 0.8],
    &[8.0, 1.0, 0.5, 1.0, 0.5, 1.0],
    &[4.0, 1.0, 0.5, 1.0, 0.5, 1.0],
    &[2.0, 0.8, 0.5, 0.8, 0.5, 0.8],
    &[8.0, 1.0, 2.0, 1.0],
    &[4.0, 1.0, 1.5, 1.0],
    &[8.0, 1.0, 2.0, 1.0, 2.0, 1.0],
    &[8.0, 1.0, 0.5, 1.0, 0.5, 1.0, 0.5, 1.0],
    &[4.0, 3.0],
];

/// The curves in the order of the legend. Displacement volume has the scale of displacement mass.
#[rustfmt::skip]
const CURVES: [Curve; 17] = {
    use Axis::{Aft, Fore, Midship, MidshipOfPosition};
    use ScaledBy::{Largest, LowestDraught};
    [
        Curve { symbol: "KM_L", unit: "m", axis: Aft, scaled_by: LowestDraught, target: Some(120.0), name_at: 0.5, colour: "#0072b2", dash: DASHES[0], value: |r| r.km_longitudinal },
        Curve { symbol: "A_WL", unit: "m²", axis: Aft, scaled_by: Largest, target: Some(100.0), name_at: 0.7, colour: "#d55e00", dash: DASHES[1], value: |r| Some(r.waterplane_area) },
        Curve { symbol: "KM_T", unit: "m", axis: Aft, scaled_by: LowestDraught, target: Some(150.0), name_at: 0.4, colour: "#a8437f", dash: DASHES[5], value: |r| r.km_transverse },
        Curve { symbol: "KB", unit: "m", axis: Aft, scaled_by: Largest, target: Some(80.0), name_at: 0.35, colour: "#8a6100", dash: DASHES[6], value: |r| r.kb },
        Curve { symbol: "LCB", unit: "m", axis: MidshipOfPosition, scaled_by: Largest, target: Some(50.0), name_at: 0.6, colour: "#007a59", dash: DASHES[2], value: |r| r.lcb },
        Curve { symbol: "LCF", unit: "m", axis: MidshipOfPosition, scaled_by: Largest, target: Some(50.0), name_at: 0.8, colour: "#007a59", dash: DASHES[8], value: |r| r.lcf },
        Curve { symbol: "I_L", unit: "m⁴", axis: Aft, scaled_by: Largest, target: Some(180.0), name_at: 0.6, colour: "#0072b2", dash: DASHES[9], value: |r| Some(r.longitudinal_inertia) },
        Curve { symbol: "I_T", unit: "m⁴", axis: Aft, scaled_by: Largest, target: Some(150.0), name_at: 0.5, colour: "#a8437f", dash: DASHES[3], value: |r| Some(r.transverse_inertia) },
        Curve { symbol: "TPC", unit: "t/cm", axis: Aft, scaled_by: Largest, target: Some(100.0), name_at: 0.3, colour: "#d55e00", dash: DASHES[7], value: |r| Some(r.tonnes_per_centimetre) },
        Curve { symbol: "Δ", unit: "t", axis: Aft, scaled_by: Largest, target: Some(220.0), name_at: 0.45, colour: "#000000", dash: FULL, value: |r| Some(r.displacement_mass) },
        Curve { symbol: "∇", unit: "m³", axis: Aft, scaled_by: Largest, target: Some(220.0), name_at: 0.65, colour: "#000000", dash: DASHES[11], value: |r| Some(r.displacement_volume) },
        Curve { symbol: "MTM", unit: "t·m/m", axis: Midship, scaled_by: Largest, target: Some(80.0), name_at: 0.75, colour: "#4a4a4a", dash: DASHES[12], value: |r| r.moment_to_trim_metre },
        Curve { symbol: "S", unit: "m²", axis: Aft, scaled_by: Largest, target: Some(200.0), name_at: 0.25, colour: "#8a6100", dash: DASHES[13], value: |r| Some(r.wetted_surface) },
        Curve { symbol: "C_WP", unit: "-", axis: Fore, scaled_by: Largest, target: None, name_at: 0.9, colour: "#0072b2", dash: DASHES[10], value: |r| r.waterplane_coefficient },
        Curve { symbol: "C_B", unit: "-", axis: Fore, scaled_by: Largest, target: None, name_at: 0.8, colour: "#000000", dash: DASHES[14], value: |r| r.block_coefficient },
        Curve { symbol: "C_P", unit: "-", axis: Fore, scaled_by: Largest, target: None, name_at: 0.7, colour: "#a8437f", dash: DASHES[15], value: |r| r.prismatic_coefficient },
        Curve { symbol: "C_X", unit: "-", axis: Fore, scaled_by: Largest, target: None, name_at: 0.6, colour: "#d55e00", dash: DASHES[4], value: |r| r.maximum_section_coefficient },
    ]
};

impl Curve {
    /// The value that is drawn: for positions the distance from midship.
    fn drawn(&self, row: &Hydrostatics, midship: f64) -> Option<f64> {
        let value = (self.value)(row).filter(|value| value.is_finite())?;
        Some(if self.axis == Axis::MidshipOfPosition { value - midship } else { value })
    }

    /// The value that fixes the scale; `rows` rise in draught, `draught` is the design draught, or the greatest of the
    /// rows where none is stated [m].
    fn scaling_value(&self, rows: &[Hydrostatics], midship: f64, draught: f64) -> f64 {
        // Centres that stay at midship are not blown up: their scale is for a hundredth of L_PP / 2 at least.
        let least = if self.axis == Axis::MidshipOfPosition { 0.01 * midship } else { 0.0 };
        let value = |row: &Hydrostatics| self.drawn(row, midship).map(f64::abs);
        let largest = |rows: &[Hydrostatics]| rows.iter().filter_map(value).fold(least, f64::max);
        match self.scaled_by {
            ScaledBy::Largest => largest(rows),
            ScaledBy::LowestDraught => {
                let low = SHALLOW * draught * (1.0 - 1e-9);
                let deep = rows.iter().position(|row| row.draught >= low).map_or(rows, |first| &rows[first..]);
                let fitting = self.target.unwrap_or(WIDTH) / WIDTH * largest(deep);
                deep.iter().find_map(value).unwrap_or(0.0).max(fitting)
            }
        }
    }

    /// Distance from the aft axis at which `value` stands [mm].
    fn place(&self, value: f64, scale: f64) -> f64 {
        match self.axis {
            Axis::Aft => value / scale,
            Axis::Midship | Axis::MidshipOfPosition => 0.5 * WIDTH + value / scale,
            Axis::Fore => WIDTH - value / scale,
        }
    }
}

/// The scale of every curve, its unit a millimetre, in the order of the legend.
fn scales(rows: &[Hydrostatics], midship: f64, draught: f64) -> [f64; CURVES.len()] {
    let scale_of = |curve: &Curve| {
        curve.target.map_or(COEFFICIENT_SCALE, |mm| sheet_scale(curve.scaling_value(rows, midship, draught), mm))
    };
    let mass = CURVES.iter().find(|curve| curve.symbol == "Δ").map_or(1.0, scale_of);
    std::array::from_fn(|k| if CURVES[k].symbol == "∇" { mass } else { scale_of(&CURVES[k]) })
}

/// Where a curve runs: distance from the aft axis [mm] and draught [m] of every row.
fn track(curve: &Curve, scale: f64, rows: &[Hydrostatics], midship: f64) -> Vec<[f64; 2]> {
    let at = |row: &Hydrostatics| Some([curve.place(curve.drawn(row, midship)?, scale), row.draught]);
    rows.iter().filter_map(at).collect()
}

/// Draws the sheet.
pub(in crate::plot) fn draw(inputs: &FigureInputs) -> Result<Canvas, PlotError> {
    let rows = inputs.dense_rows()?;
    let midship = 0.5 * inputs.hull.particulars().length_between_perpendiculars;
    let draught = inputs.design.map(|design| design.draught);
    let highest = rows.iter().map(|row| row.draught).chain(draught).fold(f64::NEG_INFINITY, f64::max);
    let draught_scale = sheet_scale(highest, HEIGHT);
    let frame_height = (5.0 * (highest / draught_scale / 5.0).ceil()).min(HEIGHT);
    let frame = Rectangle::new(CORNER[0], CORNER[1], CORNER[0] + WIDTH, CORNER[1] + frame_height);
    let mut canvas = Canvas::new(356.0, (frame.bottom + 13.0).max(frame.top + LEGEND) + 10.0);
    let height = |draught: f64| frame.bottom - draught / draught_scale;

    let title = TextStyle::new(5.0, Anchor::Middle);
    canvas.text(
        [frame.left + 0.5 * WIDTH, 8.0],
        &format!("DIAGRAM SHEET – {}", caption::plain(inputs.hull.name())),
        &title,
    );
    canvas.text([frame.left + 0.5 * WIDTH, 15.0], &caption::conventions(inputs), &TextStyle::new(2.8, Anchor::Middle));
    draw_grid(&mut canvas, &frame);
    let mut placer = LabelPlacer::default();
    draw_rulers(&mut canvas, &frame, draught_scale);

    let scales = scales(&rows, midship, draught.unwrap_or(highest));
    canvas.begin_clip(&frame);
    for (curve, scale) in CURVES.iter().zip(scales) {
        let points: Vec<[f64; 2]> =
            track(curve, scale, &rows, midship).into_iter().map(|[x, z]| [frame.left + x, height(z)]).collect();
        canvas.polyline(&points, &Pen::new(0.4, curve.colour).dashed(curve.dash));
        placer.add_curve(&points);
    }
    canvas.end_group();
    if let Some(draught) = draught {
        let design = caption::design_waterline(inputs);
        let level = Level { at: height(draught), name: &design, pen: DESIGN };
        draw_level(&mut canvas, &mut placer, &frame, &level, 2.7);
    }
    if let Some(at) = inputs.immersed_edge(&rows) {
        let edge = caption::immersed_edge(at);
        draw_level(&mut canvas, &mut placer, &frame, &Level { at: height(at), name: &edge, pen: EDGE }, 2.7);
    }
    for (k, curve) in CURVES.iter().enumerate() {
        let style = TextStyle::new(2.8, Anchor::Middle).coloured(curve.colour);
        // On the curve where that is clear, or else with a thread to it.
        let (room, part) = (frame.grown(-0.5), curve.name_at);
        let clear = Preference { part, crossings: 0, beside: false };
        let anywhere = Preference { part, crossings: usize::MAX, beside: true };
        let _ = placer.name_curve(&mut canvas, k, curve.symbol, &style, clear, &room)
            || placer.name_by_leader(&mut canvas, k, curve.symbol, &style, &THREAD, &room)
            || placer.name_curve(&mut canvas, k, curve.symbol, &style, anywhere, &room);
    }
    draw_legend(&mut canvas, &frame, &scales, draught_scale);
    Ok(canvas)
}

fn draw_grid(canvas: &mut Canvas, frame: &Rectangle) {
    let (fine, coarse) = (Pen::new(0.08, "#dddddd"), Pen::new(0.1, "#bcbcbc"));
    let pen = |k: i32| if k % 2 == 0 { &coarse } else { &fine };
    for k in 1..(WIDTH / 5.0) as i32 {
        let x = frame.left + 5.0 * f64::from(k);
        canvas.line([x, frame.top], [x, frame.bottom], pen(k));
    }
    for k in 1..(frame.height() / 5.0).round() as i32 {
        let y = frame.bottom - 5.0 * f64::from(k);
        canvas.line([frame.left, y], [frame.right, y], pen(k));
    }
    let axis = Pen::new(0.35, "#000000");
    canvas.rectangle(frame, &axis);
    canvas.line([frame.left + 0.5 * WIDTH, frame.top], [frame.left + 0.5 * WIDTH, frame.bottom], &axis);
    let style = TextStyle::new(3.0, Anchor::Middle);
    let foot = TextStyle::new(2.7, Anchor::Middle);
    for (part, name, note) in [
        (0.0, "AP", "areas, volumes, heights, inertias: forward from here"),
        (0.5, "midship (L_PP / 2)", "LCB, LCF, MTM: from here, + forward"),
        (1.0, "FP", "C_WP, C_B, C_P, C_X: aft from here"),
    ] {
        let x = frame.left + part * WIDTH;
        canvas.text([x, frame.top - 4.0], name, &style);
        let anchor = if part > 0.9 {
            Anchor::End
        } else if part < 0.1 {
            Anchor::Start
        } else {
            Anchor::Middle
        };
        canvas.text([x, frame.bottom + 6.0], note, &TextStyle { anchor, ..foot });
    }
}

/// Decimetres between the draughts that are named: whole metres where there is room for the figures, every one, second,
/// fifth, tenth, ...; on a sheet of less than three metres, half metres or decimetres.
fn named_every(height: f64, draught_scale: f64) -> i64 {
    let decimetre = 0.1 / draught_scale;
    let fine = if height * draught_scale < 3.0 { [1, 5].as_slice() } else { &[] };
    let steps = fine.iter().copied().chain([10, 20, 50, 100, 200, 500]);
    steps.into_iter().find(|&n| n as f64 * decimetre >= if n < 10 { 8.0 } else { 4.0 }).unwrap_or(1000)
}

fn draw_rulers(canvas: &mut Canvas, frame: &Rectangle, draught_scale: f64) {
    let pen = Pen::new(0.18, "#000000");
    let decimetre = 0.1 / draught_scale;
    let steps = (frame.height() / decimetre + 1e-9).floor() as i64;
    let metre_room = 10.0 * decimetre;
    let every = named_every(frame.height(), draught_scale);
    let style = TextStyle::new(2.8, Anchor::End);
    for k in 0..=steps {
        let length = if k % 10 == 0 {
            6.0
        } else if k % 5 == 0 {
            4.0
        } else {
            2.0
        };
        let smallest_room = if k % 10 == 0 {
            metre_room
        } else if k % 5 == 0 {
            5.0 * decimetre
        } else {
            decimetre
        };
        if smallest_room < 0.7 {
            continue;
        }
        let y = frame.bottom - k as f64 * decimetre;
        canvas.line([frame.left, y], [frame.left - length, y], &pen);
        canvas.line([frame.right, y], [frame.right + length, y], &pen);
        if k % every == 0 {
            let name = if every < 10 { format!("{:.1}", 0.1 * k as f64) } else { format!("{}", k / 10) };
            canvas.text([frame.left - 7.5, y], &name, &style);
            canvas.text([frame.right + 7.5, y], &name, &TextStyle { anchor: Anchor::Start, ..style });
        }
    }
    let name = TextStyle::new(2.8, Anchor::Middle).upward();
    let middle = 0.5 * (frame.top + frame.bottom);
    canvas.text([frame.left - 16.0, middle], "draught T above the base line [m]", &name);
}

fn draw_legend(canvas: &mut Canvas, frame: &Rectangle, scales: &[f64], draught_scale: f64) {
    let left = frame.right + 19.0;
    let style = TextStyle::new(2.8, Anchor::Start);
    let mut y = frame.top + 2.0;
    canvas.text([left, y], &format!("T   1 mm = {draught_scale} m"), &style);
    for (curve, scale) in CURVES.iter().zip(scales) {
        y += 6.5;
        canvas.line([left, y], [left + 17.0, y], &Pen::new(0.5, curve.colour).dashed(curve.dash));
        let unit = if curve.unit == "-" { String::new() } else { format!(" {}", curve.unit) };
        canvas.text([left + 18.5, y], curve.symbol, &style.coloured(curve.colour));
        canvas.text([left + 28.0, y], &format!("1 mm = {scale}{unit}"), &style);
    }
    y += 9.0;
    for line in ["Δ, ∇ moulded", "heights above base line"] {
        canvas.text([left, y], line, &TextStyle::new(2.7, Anchor::Start));
        y += 4.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Draught, KM_L, KM_T, KB, LCF, I_L, A_WL, LCB, I_T, TPC, volume, mass, moment to trim of a frigate of 102.5 m
    /// (a student's table of 2011, first and last draught).
    const FIRST: [f64; 13] =
        [1.0, 463.421, 6.512, 0.603, 53.041, 134_099.3, 434.54, 54.041, 1712.2, 4.454, 289.745, 296.989, 1710.512];
    const LAST: [f64; 13] =
        [9.0, 112.242, 7.927, 5.41, 44.307, 825_119.4, 1249.0, 46.04, 19_442.0, 12.802, 7723.538, 7916.626, 8273.176];

    fn row(v: &[f64; 13]) -> Hydrostatics {
        Hydrostatics {
            draught: v[0],
            km_longitudinal: Some(v[1]),
            km_transverse: Some(v[2]),
            kb: Some(v[3]),
            lcf: Some(v[4]),
            longitudinal_inertia: v[5],
            waterplane_area: v[6],
            lcb: Some(v[7]),
            transverse_inertia: v[8],
            tonnes_per_centimetre: v[9],
            displacement_volume: v[10],
            displacement_mass: v[11],
            moment_to_trim_metre: Some(v[12]),
            ..Hydrostatics::default()
        }
    }

    fn curve(symbol: &str) -> (usize, &'static Curve) {
        let k = CURVES.iter().position(|curve| curve.symbol == symbol).unwrap();
        (k, &CURVES[k])
    }

    #[test]
    fn raw_scales_of_the_frigate_are_those_of_its_sheet() {
        let rows = [row(&FIRST), row(&LAST)];
        for (symbol, raw) in [
            ("KM_L", 3.861_84),
            ("A_WL", 12.49),
            ("KM_T", 0.043_413_3),
            ("I_L", 4584.0),
            ("I_T", 129.613),
            ("TPC", 0.128_02),
            ("Δ", 35.9847),
            ("MTM", 103.415),
        ] {
            let curve = curve(symbol).1;
            let found = curve.scaling_value(&rows, 0.0, 4.4) / curve.target.unwrap();
            assert!((found - raw).abs() < 1e-5 * raw, "{symbol}: {found}");
        }
    }

    #[test]
    fn scales_of_the_frigate() {
        let midship = 51.25;
        let found = scales(&[row(&FIRST), row(&LAST)], midship, 4.4);
        for (symbol, scale) in [
            ("KM_L", 4.0),
            ("A_WL", 20.0),
            ("KM_T", 0.05),
            ("KB", 0.1),
            ("LCB", 0.2), // 51.25 - 46.04 = 5.21 m in 50 mm: 0.104
            ("LCF", 0.2), // 51.25 - 44.307 = 6.94 m in 50 mm: 0.139
            ("I_L", 5000.0),
            ("I_T", 200.0),
            ("TPC", 0.2),
            ("Δ", 40.0),
            ("∇", 40.0),
            ("MTM", 200.0),
            ("C_B", 0.025),
        ] {
            let k = curve(symbol).0;
            assert!((found[k] - scale).abs() < 1e-12 * scale, "{symbol}: {}", found[k]);
        }
    }

    #[test]
    fn a_metacentre_that_rises_with_the_draught_stays_in_the_frame() {
        // KM_T of a parabolic hull, its least value at the lowest draught; KM_L falls.
        let rows: Vec<Hydrostatics> = (1..=50)
            .map(|k| {
                let draught = 0.2 * f64::from(k);
                Hydrostatics {
                    draught,
                    km_transverse: Some(0.3 * draught + 1.0 / draught + 1.0),
                    km_longitudinal: Some(900.0 / draught),
                    ..Hydrostatics::default()
                }
            })
            .collect();
        let found = scales(&rows, 50.0, 6.0);
        for symbol in ["KM_T", "KM_L"] {
            let (k, curve) = curve(symbol);
            let points = track(curve, found[k], &rows, 50.0);
            assert!(points.iter().filter(|p| p[1] >= 0.25 * 6.0).all(|p| (0.0..=WIDTH).contains(&p[0])), "{symbol}");
            assert!(points.iter().any(|p| p[0] > WIDTH), "{symbol}: nothing left the frame");
        }
    }

    #[test]
    fn draughts_of_shallow_hulls_are_named_in_tenths() {
        for (scale, every) in [(0.01, 1), (0.015, 5), (0.02, 10), (0.06, 10), (0.2, 10), (0.4, 20)] {
            assert_eq!(named_every(175.0, scale), every, "{scale}");
        }
    }

    #[test]
    fn coefficients_are_measured_aft_from_the_forward_perpendicular() {
        let curve = curve("C_B").1;
        assert!((curve.place(0.5, COEFFICIENT_SCALE) - 220.0).abs() < 1e-12);
    }

    #[test]
    fn centres_are_measured_from_midship() {
        let (_, curve) = curve("LCB");
        let drawn = curve.drawn(&row(&LAST), 51.25).unwrap();
        assert!((curve.place(drawn, 0.2) - (120.0 - 5.21 / 0.2)).abs() < 1e-9);
    }
}
