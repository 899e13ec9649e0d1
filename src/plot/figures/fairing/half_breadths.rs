//! The half-breadth plan of a hull before and after fairing, with combs.
//!
//! It is stretched athwartships by a whole number, which is printed; curvatures are those of the ship.

use super::combs::FairingCombs;
use super::plan::{CHORD, Plan, draw, rings_of, title};
use super::reach::{HALF_SIDE, Reach};
use super::sections::curves;
use crate::fairing::record::FairRecord;
use crate::hull::{Cut, OffsetStation};
use crate::plot::paper::canvas::{Anchor, Canvas, Rectangle, TextStyle};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LETTERS;
use crate::plot::paper::label::{Preference, length};
use crate::plot::paper::scale::{rule_scale, short};
use crate::plot::paper::sheet::Sheet;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;
use crate::plot::ship::comb::LONGEST;
use crate::plot::ship::extent::{extent, long_left};
use crate::plot::ship::station_names::ROWS;
use crate::plot::ship::view::{BASE, GRID, THREAD};

/// Room above and below the drawing \[mm\].
const HEAD: f64 = 40.0;
const FOOT: f64 = 30.0;
/// A row below all of [`ROWS`] for names of stations that combs leave no other place \[mm\].
const LAST_ROW: f64 = 17.4;

/// Half-breadth plan before and after, bow on the right; of long ships a sheet for each half.
///
/// # Errors
/// [`PlotError::Chart`] for a table without waterlines.
pub fn fairing_half_breadth_plan(
    record: &FairRecord,
    combs: &FairingCombs,
    sheet: Sheet,
) -> Result<Vec<Svg>, PlotError> {
    let sheets = half_breadth_plan(record, combs, sheet)?;
    Ok(sheets.into_iter().map(|canvas| Svg::new(canvas.finish("fairing-half-breadth-plan"))).collect())
}

/// Where a half-breadth plan, or a half of one, stands on its sheet.
struct HalfBreadths {
    /// Scale 1 : n along the ship.
    n: u32,
    millimetres: f64,
    stretch: f64,
    /// Place of the aft end on the centre line \[mm\], and its x \[m\].
    origin: [f64; 2],
    from: f64,
}

impl HalfBreadths {
    /// The part `reach` on `paper`, at the scale of the longest part.
    fn new(reach: &Reach, longest: &Reach, breadth: f64, paper: [f64; 2]) -> Self {
        let room = paper[1] - HEAD - FOOT - 20.0;
        let n = longest.scale(paper).max(rule_scale(breadth, room));
        let millimetres = 1000.0 / f64::from(n);
        // A whole number of times wider than long, so that waterlines keep apart.
        let stretch = (room / (breadth * millimetres)).floor().clamp(1.0, 10.0);
        // What is left of the height stands above and below.
        let floor = paper[1] - FOOT - 4.0 - 0.5 * (room - stretch * breadth * millimetres).max(0.0);
        let width = millimetres * reach.length();
        // Combs reach over the end of the ship, not over the border of a half.
        let left = if reach.outer[0] {
            long_left(paper, width)
        } else {
            (paper[0] - width - long_left(paper, width)).max(HALF_SIDE)
        };
        Self { n, millimetres, stretch, origin: [left, floor], from: reach.x[0] }
    }

    fn at(&self, p: [f64; 3]) -> [f64; 2] {
        let [left, floor] = self.origin;
        [left + self.millimetres * (p[0] - self.from), floor - self.stretch * self.millimetres * p[1]]
    }
}

/// The plan, or its two halves.
pub(in crate::plot) fn half_breadth_plan(
    record: &FairRecord,
    combs: &FairingCombs,
    sheet: Sheet,
) -> Result<Vec<Canvas>, PlotError> {
    let Some((x, breadth, _)) = extent(record).filter(|_| !record.lines.waterlines.is_empty()) else {
        return Err(PlotError::Chart("the table has no waterlines".to_owned()));
    };
    let cuts: Vec<Cut> = record.lines.waterlines.iter().map(|&z| Cut::Waterline { z }).collect();
    // Waterlines may run on beyond the outermost offsets: they stay on the sheet too.
    let drawn = [&record.before, &record.after].into_iter().flat_map(|hull| cuts.iter().map(move |cut| (hull, *cut)));
    let drawn = drawn.flat_map(|(hull, cut)| curves(hull, cut, 1e-3 * breadth)).flatten();
    let x = drawn.fold(x, |[aft, fore], p| [aft.min(p[0]), fore.max(p[0])]);
    let small = |reach: &Reach| HalfBreadths::new(reach, reach, breadth, Sheet::A3.room());
    let whole = small(&Reach::whole(x));
    let rings = rings_of(&combs.on(&cuts)[1], |_, p| whole.at(p));
    let reaches = Reach::sheets(x, |reach| small(reach).n, &rings);
    let one = |reach: &Reach| {
        let longest = Reach::longest(&reaches).unwrap_or(reach);
        half_breadths(record, combs, sheet, &cuts, (reach, longest, breadth))
    };
    Ok(reaches.iter().map(one).collect())
}

fn half_breadths(
    record: &FairRecord,
    combs: &FairingCombs,
    sheet: Sheet,
    cuts: &[Cut],
    (reach, longest, breadth): (&Reach, &Reach, f64),
) -> Canvas {
    let paper = sheet.room();
    let view = &HalfBreadths::new(reach, longest, breadth, paper);
    let (n, stretch) = (view.n, view.stretch);
    let scale = if stretch > 1.0 { format!("1:{n}, breadths x {stretch:.0}") } else { format!("1:{n}") };
    let plan = Plan {
        record,
        combs,
        title: "HALF-BREADTH PLAN",
        part: reach.name.clone(),
        scale,
        heights: "waterlines by z [m] above the base line",
        room: paper,
        longest: LONGEST,
    };
    let at = move |p: [f64; 3]| view.at(p);
    let mut canvas = Canvas::new(paper[0], paper[1]);
    let stations: Vec<&OffsetStation> = record.lines.stations.iter().filter(|station| reach.has(station.x)).collect();
    for station in &stations {
        let x = station.x;
        canvas.line(at([x, 0.0, 0.0]), at([x, breadth, 0.0]), &GRID);
    }
    let ends = reach.x.map(|x| at([x, 0.0, 0.0]));
    let sides = ends.map(|end| end[0]);
    canvas.line(ends[0], ends[1], &BASE);
    let border = reach.draw_border(&mut canvas, sides, [at([0.0, breadth, 0.0])[1] - 6.0, ends[0][1] + 2.0]);
    let shown = reach.window(sides, paper);
    canvas.begin_clip(&shown);
    let window = Rectangle::new(4.0, 24.0, paper[0] - 4.0, paper[1] - 14.0);
    let chord = CHORD / (stretch * view.millimetres);
    let drawn = draw(&mut canvas, &plan, cuts, chord, &|_| at, &|_| window).inside(&shown);
    canvas.end_group();
    title(&mut canvas, &plan, &drawn);
    let mut placer = drawn.placer();
    // Nothing is written on the centre line and on the border, where there is another place.
    placer.add_curve(&ends);
    border.iter().for_each(|border| placer.add_curve(border));
    // Names of stations under the centreline, every one where there is room.
    let style = TextStyle::new(LETTERS, Anchor::Middle).halo();
    for station in stations {
        let [px, py] = at([station.x, 0.0, 0.0]);
        let name: String = caption::plain(&station.name).chars().take(9).collect();
        let rows: Vec<[f64; 2]> = ROWS.into_iter().chain([LAST_ROW]).map(|down| [px, py + down]).collect();
        placer.name_point(&mut canvas, &name, &style, &rows, &window);
    }
    drawn.name_cut(&mut canvas, &mut placer, &[window]);
    let style = TextStyle::new(LETTERS, Anchor::Middle);
    let count = record.lines.waterlines.len();
    for (k, z) in record.lines.waterlines.iter().enumerate() {
        // The longest piece bears the name.
        let pieces = (0..drawn.curves.len()).filter(|curve| drawn.curves[*curve].0 == k);
        let by_length = |a: &usize, b: &usize| length(&drawn.curves[*a].1).total_cmp(&length(&drawn.curves[*b].1));
        let Some(curve) = pieces.max_by(by_length) else { continue };
        // Low waterlines are named aft, high ones forward.
        let part = 0.2 + 0.12 * ((k % 3) as f64) + if 2 * k > count { 0.3 } else { 0.0 };
        let preferred = Preference { part, crossings: 3, beside: false };
        let name = short(*z);
        if !placer.name_curve(&mut canvas, curve, &name, &style, preferred, &window) {
            placer.name_by_leader(&mut canvas, curve, &name, &style, &THREAD, &window);
        }
    }
    let words = TextStyle::new(3.2, Anchor::Start);
    canvas.text([14.0, paper[1] - 20.0], "AFT", &words);
    canvas.text([paper[0] - 14.0, paper[1] - 20.0], "FORWARD", &TextStyle::new(3.2, Anchor::End));
    canvas
}
