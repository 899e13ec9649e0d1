//! Buttocks and diagonals before and after fairing with combs at one scale. Neither was used in the fit: they are the independent
//! check. Diagonals are in their true shape. Heights and distances are stretched by a whole number, which is printed; curvatures are those
//! of the ship.

use super::canvas::{Anchor, Canvas, TextStyle};
use super::fairing::{Plan, curves, draw, extent, title};
use super::fairing_combs::FairingCombs;
use super::label::Preference;
use super::scale::drawing_scale;
use super::sheet::{LETTERS, Sheet};
use super::view::{BASE, GRID};
use super::{PlotError, Svg, caption};
use crate::fairing::record::FairRecord;
use crate::hull::Cut;

/// Room at the sides, above and below the drawing \[mm\].
const SIDE: f64 = 26.0;
const HEAD: f64 = 44.0;
const FOOT: f64 = 44.0;

/// From a point of the ship to metres along the ship and across the drawing.
type Project = fn(&Cut, [f64; 3]) -> [f64; 2];

/// Buttocks in the profile, before and after.
///
/// # Errors
/// [`PlotError::Chart`] for a hull without buttocks.
pub fn fairing_buttocks(record: &FairRecord, combs: &FairingCombs, sheet: Sheet) -> Result<Svg, PlotError> {
    Ok(Svg {
        text: compose(record, combs, sheet, "BUTTOCKS", &combs.buttocks, |_, p| [p[0], p[2]])?
            .finish("fairing-buttocks"),
    })
}

/// Diagonals in their true shape, before and after.
///
/// # Errors
/// [`PlotError::Chart`] for a hull without diagonals.
pub fn fairing_diagonals(record: &FairRecord, combs: &FairingCombs, sheet: Sheet) -> Result<Svg, PlotError> {
    let expanded: Project = |cut, p| match cut {
        Cut::Diagonal { height, .. } => [p[0], p[1].hypot(p[2] - height)],
        _ => [p[0], p[1]],
    };
    Ok(Svg {
        text: compose(record, combs, sheet, "DIAGONALS IN TRUE SHAPE", &combs.diagonals, expanded)?
            .finish("fairing-diagonals"),
    })
}

/// Name of a plane: its distance or height.
fn name(cut: &Cut) -> String {
    match cut {
        Cut::Buttock { y } => format!("y {y:.2} m"),
        Cut::Diagonal { height, .. } => format!("from z {height:.2} m"),
        _ => String::new(),
    }
}

pub(super) fn compose(
    record: &FairRecord,
    combs: &FairingCombs,
    sheet: Sheet,
    words: &'static str,
    cuts: &[Cut],
    project: Project,
) -> Result<Canvas, PlotError> {
    let paper = sheet.room();
    let fine = 1e-3 * record.after.particulars().breadth;
    let points: Vec<[f64; 2]> = cuts
        .iter()
        .flat_map(|cut| curves(&record.after, *cut, fine).into_iter().flatten().map(|p| project(cut, p)))
        .collect();
    let nothing = || PlotError::Chart("no plane cuts the side".to_owned());
    let (x, ..) = extent(record).filter(|_| !points.is_empty()).ok_or_else(nothing)?;
    let bounds = |axis: usize| {
        let start = (f64::INFINITY, f64::NEG_INFINITY);
        points.iter().map(|p| p[axis]).fold(start, |(a, b), v| (a.min(v), b.max(v)))
    };
    let ((low, high), (bottom, top)) = (bounds(0), bounds(1));
    let (low, high) = (low.min(x[0]), high.max(x[1]));
    let room = [paper[0] - 2.0 * SIDE, paper[1] - HEAD - FOOT];
    let n = drawing_scale(high - low, room[0]);
    let millimetres = 1000.0 / f64::from(n);
    let buttocks = matches!(cuts.first(), Some(Cut::Buttock { .. }));
    let across = if buttocks { "heights" } else { "distances" };
    let heights = if buttocks {
        "buttocks by y [m] from the centreplane"
    } else {
        "diagonals by z [m] at the centreplane; girths in their planes"
    };
    let stretch = (room[1] / ((top - bottom).max(fine) * millimetres)).floor().clamp(1.0, 10.0);
    let scale = if stretch > 1.0 { format!("1:{n}, {across} x {stretch:.0}") } else { format!("1:{n}") };
    let plan = Plan { record, combs, title: words, scale, heights, room: paper };
    let left = 0.5 * (paper[0] - millimetres * (high - low));
    let floor = paper[1] - FOOT - 0.5 * (room[1] - stretch * millimetres * (top - bottom)).max(0.0);
    let place = move |p: [f64; 2]| [left + millimetres * (p[0] - low), floor - stretch * millimetres * (p[1] - bottom)];
    let mut canvas = Canvas::new(paper[0], paper[1]);
    for station in &record.lines.stations {
        canvas.line(place([station.x, bottom]), place([station.x, top]), &GRID);
    }
    canvas.line(place([low, bottom]), place([high, bottom]), &BASE);
    let at = move |cut: &Cut| {
        let cut = *cut;
        move |p: [f64; 3]| place(project(&cut, p))
    };
    let drawn = draw(&mut canvas, &plan, cuts, 0.01 / (stretch * millimetres), &at);
    title(&mut canvas, &plan, &drawn);
    let mut placer = drawn.placer();
    let window = super::canvas::Rectangle::new(8.0, 24.0, paper[0] - 8.0, paper[1] - 14.0);
    let style = TextStyle::new(LETTERS, Anchor::Middle);
    for station in &record.lines.stations {
        let [px, py] = place([station.x, bottom]);
        let word: String = caption::plain(&station.name).chars().take(9).collect();
        placer.name_point(&mut canvas, &word, &style, &[[px, py + 12.0], [px, py + 15.4]], &window);
    }
    let style = TextStyle::new(LETTERS, Anchor::Middle);
    for (k, cut) in cuts.iter().enumerate() {
        let Some(curve) = drawn.curves.iter().position(|(other, _)| *other == k) else { continue };
        let preferred = Preference { part: 0.3 + 0.12 * ((k % 3) as f64), crossings: 3, beside: false };
        placer.name_curve(&mut canvas, curve, &name(cut), &style, preferred, &window);
    }
    canvas.text([14.0, paper[1] - 16.0], "AFT", &TextStyle::new(3.2, Anchor::Start));
    canvas.text([paper[0] - 14.0, paper[1] - 16.0], "FORWARD", &TextStyle::new(3.2, Anchor::End));
    Ok(canvas)
}
