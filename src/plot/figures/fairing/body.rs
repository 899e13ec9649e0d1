//! The body plan before and after fairing with combs, and where body plans of faired tables stand on their sheets.

use super::combs::FairingCombs;
use super::plan::{CHORD, Plan, draw, title};
use super::sections::station_cut;
use crate::fairing::record::FairRecord;
use crate::hull::Cut;
use crate::plot::paper::canvas::{Anchor, Canvas, Rectangle, TextStyle};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LETTERS;
use crate::plot::paper::label::LabelPlacer;
use crate::plot::paper::scale::rule_scale;
use crate::plot::paper::sheet::Sheet;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::comb::LONGEST;
use crate::plot::ship::extent::{base, extent, midship};
use crate::plot::ship::station_names::{name_stations, number_sections};
use crate::plot::ship::view::{BASE, GRID};

/// Room at the sides for heights and combs, above for names of stations and below for combs \[mm\].
const SIDE: f64 = 36.0;
const HEAD: f64 = 36.0;
const FOOT: f64 = 29.5;
/// Where words over and under the plan end \[mm\].
const TITLE: f64 = 20.0;
const NOTES: f64 = 15.5;

/// Where a body plan stands on its sheet, aft sections on the left: as large as a rule has a scale for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::plot) struct BodyView {
    /// Scale 1 : n.
    pub(in crate::plot) n: u32,
    /// Millimetres a metre.
    pub(in crate::plot) millimetres: f64,
    /// The centre line and the height of the lowest point on the sheet \[mm\].
    pub(in crate::plot) centre: f64,
    floor: f64,
    /// Half-breadth, and lowest and greatest height \[m\].
    pub(in crate::plot) breadth: f64,
    pub(in crate::plot) z: [f64; 2],
    /// What lies aft of it is on the left \[m\].
    pub(in crate::plot) midship: f64,
    /// Where names and combs may stand \[mm\].
    pub(in crate::plot) window: Rectangle,
}

impl BodyView {
    /// The plan of a table and its hulls on `paper`; none without offsets.
    pub(in crate::plot) fn new(record: &FairRecord, paper: [f64; 2]) -> Option<Self> {
        let (x, breadth, [low, high]) = extent(record)?;
        Some(Self::of([breadth, low, high], midship(record, x), paper))
    }

    /// The plan of half-breadths and heights up to those given \[m\].
    pub(in crate::plot) fn of([breadth, low, high]: [f64; 3], midship: f64, paper: [f64; 2]) -> Self {
        let z = [low, high];
        let room = [paper[0] - 2.0 * SIDE, paper[1] - HEAD - FOOT];
        let n = rule_scale(2.0 * breadth, room[0]).max(rule_scale(z[1] - z[0], room[1]));
        let millimetres = 1000.0 / f64::from(n);
        let floor = paper[1] - FOOT - 0.5 * (room[1] - millimetres * (z[1] - z[0])).max(0.0);
        let window = Rectangle::new(8.0, TITLE, paper[0] - 8.0, paper[1] - NOTES);
        Self { n, millimetres, centre: 0.5 * paper[0], floor, breadth, z, midship, window }
    }

    /// -1 for stations that are drawn on the left, 1 for the others.
    pub(in crate::plot) fn side(&self, x: f64) -> f64 {
        if x < self.midship { -1.0 } else { 1.0 }
    }

    /// Where a half-breadth and a height stand on the side `side`.
    pub(in crate::plot) fn on(&self, side: f64, y: f64, z: f64) -> [f64; 2] {
        [self.centre + side * self.millimetres * y, self.floor - self.millimetres * (z - self.z[0])]
    }

    /// The half of the window on the side `side`.
    pub(in crate::plot) fn half(&self, side: f64) -> Rectangle {
        if side < 0.0 {
            Rectangle { right: self.centre, ..self.window }
        } else {
            Rectangle { left: self.centre, ..self.window }
        }
    }

    /// Waterlines, base line and centre line; the heights that are named, from the lowest. Waterlines above everything
    /// that is drawn are left out.
    pub(in crate::plot) fn draw_grid(&self, canvas: &mut Canvas, record: &FairRecord) -> Vec<f64> {
        let slack = 1e-9 * (self.z[1] - self.z[0]);
        let shown = record.lines.waterlines.iter().copied().filter(|height| *height <= self.z[1] + slack);
        let shown: Vec<f64> = shown.collect();
        for &height in &shown {
            canvas.line(self.on(-1.0, self.breadth, height), self.on(1.0, self.breadth, height), &GRID);
        }
        let [left, right] = self.base_line();
        canvas.line(left, right, &BASE);
        canvas.line(self.on(1.0, 0.0, self.z[0]), self.on(1.0, 0.0, self.z[1]), &BASE);
        shown
    }

    /// The base line on the sheet.
    pub(in crate::plot) fn base_line(&self) -> [[f64; 2]; 2] {
        [-1.0, 1.0].map(|side| self.on(side, self.breadth, base(self.z)))
    }

    /// Heights left of the plan in one column, outside the reach of what the placer has, where the sheet has room.
    pub(in crate::plot) fn name_heights(&self, canvas: &mut Canvas, placer: &mut LabelPlacer, heights: &[f64]) {
        let style = TextStyle::new(LETTERS, Anchor::End);
        let named = heights.iter().map(|&height| (self.on(-1.0, self.breadth, height), format!("{height:.3}")));
        let named: Vec<([f64; 2], String)> = named.map(|([x, y], name)| ([x - 2.0, y], name)).collect();
        let places: Vec<Rectangle> =
            named.iter().map(|(at, name)| Canvas::text_place(*at, name, &style).grown(0.6)).collect();
        let left = places.iter().map(|place| place.left).fold(f64::INFINITY, f64::min);
        let shift = placer.clear_shift(&places, left - self.window.left);
        for ([x, y], name) in named {
            let found = placer.name_point(canvas, &name, &style, &[[x - shift, y]], &self.window);
            if shift > 0.0 && found.is_some() {
                canvas.line([x - shift + 0.8, y], [x + 2.0, y], &GRID);
            }
        }
    }

    /// AFT and FORWARD at the foot of the sheet.
    pub(in crate::plot) fn name_sides(&self, canvas: &mut Canvas, paper: [f64; 2]) {
        for (x, word, anchor) in [(14.0, "AFT", Anchor::Start), (paper[0] - 14.0, "FORWARD", Anchor::End)] {
            canvas.text([x, paper[1] - 12.5], word, &TextStyle::new(LETTERS, anchor));
        }
    }
}

/// Body plan before and after, aft sections on the left.
///
/// # Errors
/// [`PlotError::Chart`] for a table without stations.
pub fn fairing_body_plan(record: &FairRecord, combs: &FairingCombs, sheet: Sheet) -> Result<Svg, PlotError> {
    Ok(Svg::new(body_plan(record, combs, sheet)?.finish("fairing-body-plan")))
}

pub(in crate::plot) fn body_plan(record: &FairRecord, combs: &FairingCombs, sheet: Sheet) -> Result<Canvas, PlotError> {
    let paper = sheet.room();
    let Some(view) = BodyView::new(record, paper) else {
        return Err(PlotError::Chart("the table has no offsets".to_owned()));
    };
    let plan = Plan {
        record,
        combs,
        title: "BODY PLAN",
        part: String::new(),
        scale: format!("1:{}", view.n),
        heights: "waterlines by z [m] above the base line",
        room: paper,
        longest: LONGEST,
    };
    let mut canvas = Canvas::new(paper[0], paper[1]);
    let heights = view.draw_grid(&mut canvas, record);
    let cuts: Vec<Cut> = record.lines.stations.iter().map(|station| station_cut(record, station.x)).collect();
    let side = |cut: &Cut| if let Cut::Station { x } = *cut { view.side(x) } else { 1.0 };
    let place = |cut: &Cut| {
        let side = side(cut);
        move |p: [f64; 3]| view.on(side, p[1], p[2])
    };
    // A half belongs to its own stations: no comb reaches over the centre line.
    let bounds = |cut: &Cut| view.half(side(cut));
    let drawn = draw(&mut canvas, &plan, &cuts, CHORD / view.millimetres, &place, &bounds);
    let mut placer = drawn.placer();
    placer.add_curve(&view.base_line());
    title(&mut canvas, &plan, &drawn);
    view.name_sides(&mut canvas, paper);
    canvas.texts().iter().for_each(|text| placer.take(text.place));
    view.name_heights(&mut canvas, &mut placer, &heights);
    name_stations(&mut canvas, record, &drawn.curves, &mut placer, &view.window, [view.centre, view.midship]);
    let halves = [-1.0, 1.0].map(|side| view.half(side));
    drawn.name_cut(&mut canvas, &mut placer, &halves);
    number_sections(&mut canvas, record, &drawn.curves, &mut placer, &halves.map(|half| half.grown(-0.4)));
    Ok(canvas)
}
