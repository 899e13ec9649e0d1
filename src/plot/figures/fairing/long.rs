//! Buttocks and diagonals before and after fairing, a strip each, with combs at one scale. Neither was used in the fit:
//! they are the independent check. Diagonals are in their true shape. Where there are more than a sheet has strips for,
//! every second or third of them is shown, which the sheet says; where rings touch or the scale is small, halves of the
//! ship have sheets of their own. Heights and distances may be stretched by a whole number, which is printed; curvatures
//! are those of the ship.

use super::combs::{FairingCombs, LONGEST_ALONG, some};
use super::curves::{Range, figures_clear, rules};
use super::plan::{Drawn, Plan, draw, rings_of, title};
use super::reach::Reach;
use super::sections::curves;
use crate::fairing::inspect::Comb;
use crate::fairing::record::FairRecord;
use crate::hull::{Cut, OffsetStation};
use crate::plot::paper::canvas::{Anchor, Canvas, Rectangle, TextStyle};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LETTERS;
use crate::plot::paper::scale::rule_scale;
use crate::plot::paper::sheet::Sheet;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;
use crate::plot::ship::extent::{extent, long_left};
use crate::plot::ship::station_names::ROWS;
use crate::plot::ship::view::GRID;

/// Room above and below the strips \[mm\].
const HEAD: f64 = 24.5;
const FOOT: f64 = 37.0;
/// Most strips of a sheet, and room over each for its words \[mm\].
const MOST: usize = 4;
/// Most strips of a sheet with half a ship.
const FEW: usize = 2;
const WORDS: f64 = 7.5;

/// Which lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::plot) enum Kind {
    Buttocks,
    Diagonals,
}

impl Kind {
    /// From a point of the ship to metres along the ship and across the drawing.
    fn project(cut: &Cut, p: [f64; 3]) -> [f64; 2] {
        match cut {
            Cut::Diagonal { height, .. } => [p[0], p[1].hypot(p[2] - height)],
            _ => [p[0], p[2]],
        }
    }

    /// Title, what is stretched, what the strips are, and the axis across.
    fn words(self) -> [&'static str; 4] {
        match self {
            Self::Buttocks => ["BUTTOCKS", "heights", "buttocks by y from the centreplane", "z [m]"],
            Self::Diagonals => [
                "DIAGONALS IN TRUE SHAPE",
                "distances",
                "diagonals by z at the centreplane, distances in their planes",
                "distance [m]",
            ],
        }
    }
}

/// Buttocks in the profile, before and after; of long ships a sheet for each half.
///
/// # Errors
/// [`PlotError::Chart`] for a hull without buttocks.
pub fn fairing_buttocks(record: &FairRecord, combs: &FairingCombs, sheet: Sheet) -> Result<Vec<Svg>, PlotError> {
    let sheets = compose(record, combs, sheet, Kind::Buttocks)?;
    Ok(sheets.into_iter().map(|canvas| Svg::new(canvas.finish("fairing-buttocks"))).collect())
}

/// Diagonals in their true shape, before and after; of long ships a sheet for each half.
///
/// # Errors
/// [`PlotError::Chart`] for a hull without diagonals.
pub fn fairing_diagonals(record: &FairRecord, combs: &FairingCombs, sheet: Sheet) -> Result<Vec<Svg>, PlotError> {
    let sheets = compose(record, combs, sheet, Kind::Diagonals)?;
    Ok(sheets.into_iter().map(|canvas| Svg::new(canvas.finish("fairing-diagonals"))).collect())
}

/// Name of a plane: its distance or height, and where it is one of `all` diagonals its number and how far it falls.
fn name(cut: &Cut, all: &[Cut]) -> String {
    match cut {
        Cut::Buttock { y } => format!("buttock {y:.2} m"),
        Cut::Diagonal { height, angle } => {
            // From the lowest up, as the lines plan has them.
            let below = |other: &&Cut| matches!(other, Cut::Diagonal { height: z, .. } if z < height);
            let number = all.iter().filter(below).count() + 1;
            format!("D{number}, from z {height:.2} m on the centreplane, {:.1}° down outboard", angle.to_degrees())
        }
        _ => String::new(),
    }
}

/// The planes that get a strip: those with combs where only some have them, evenly as many as there are strips.
fn shown(combs: &FairingCombs, all: &[Cut]) -> Vec<Cut> {
    let bearing: Vec<Cut> = all.iter().copied().filter(|cut| !combs.on(&[*cut])[1].is_empty()).collect();
    let from = if bearing.is_empty() { all } else { &bearing };
    some(from.len(), MOST).into_iter().map(|k| from[k]).collect()
}

/// The part of a strip that its line runs in, its combs left aside.
struct Strip {
    frame: Rectangle,
    /// x at the left edge, and the least height or distance \[m\].
    from: [f64; 2],
    millimetres: f64,
    stretch: f64,
}

impl Strip {
    fn at(&self, [along, across]: [f64; 2]) -> [f64; 2] {
        [
            self.frame.left + self.millimetres * (along - self.from[0]),
            self.frame.bottom - self.stretch * self.millimetres * (across - self.from[1]),
        ]
    }
}

/// Scale 1 : n along the ship for strips that show `longest` of it and reach `across` \[m\], and how many times larger
/// what stands across is drawn.
fn scales(longest: &Reach, across: f64, room: f64, paper: [f64; 2]) -> (u32, f64) {
    let n = longest.scale(paper).max(rule_scale(across, room));
    (n, (room * f64::from(n) / (1000.0 * across)).floor().clamp(1.0, 10.0))
}

/// The strips on one sheet, or a few of them at a time on a sheet for each half of the ship.
pub(in crate::plot) fn compose(
    record: &FairRecord,
    combs: &FairingCombs,
    sheet: Sheet,
    kind: Kind,
) -> Result<Vec<Canvas>, PlotError> {
    let all = if kind == Kind::Buttocks { &combs.buttocks } else { &combs.diagonals };
    let cuts = shown(combs, all);
    let fine = 1e-3 * record.after.particulars().breadth;
    let points = cuts
        .iter()
        .flat_map(|cut| curves(&record.after, *cut, fine).into_iter().flatten().map(|p| Kind::project(cut, p)));
    let start = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    let bounds = points.fold(start, |b, p| [0, 1].map(|d| [b[d][0].min(p[d]), b[d][1].max(p[d])]));
    let nothing = || PlotError::Chart("no plane cuts the side".to_owned());
    let (x, ..) = extent(record).filter(|_| bounds[0][0].is_finite()).ok_or_else(nothing)?;
    let ends = [bounds[0][0].min(x[0]), bounds[0][1].max(x[1])];
    let [bottom, top] = bounds[1];
    let across = (top - bottom).max(fine);
    let room = |paper: [f64; 2], strips: usize| (paper[1] - HEAD - FOOT) / strips as f64 - WORDS - 2.0 * LONGEST_ALONG;
    let small = Sheet::A3.room();
    // Halves are larger only where fewer strips share their sheet.
    let strips = |reach: &Reach| if reach.is_whole() { cuts.len() } else { cuts.len().min(FEW) };
    let of = |reach: &Reach| scales(reach, across, room(small, strips(reach)), small);
    let (n, stretch) = of(&Reach::whole(ends));
    let millimetres = 1000.0 / f64::from(n);
    let place = |comb: &Comb, p: [f64; 3]| {
        let [along, across] = Kind::project(&comb.cut, p);
        [millimetres * along, stretch * millimetres * across]
    };
    let rings = rings_of(&combs.on(&cuts)[1], place);
    let reaches = Reach::sheets(ends, |reach| of(reach).0, &rings);
    let longest = Reach::longest(&reaches).ok_or_else(nothing)?;
    let (most, shown) = (strips(longest), cuts.len());
    let scales = scales(longest, across, room(sheet.room(), most), sheet.room());
    let drawn = cuts.chunks(most).flat_map(|cuts| {
        let strips =
            Strips { record, combs, kind, all, cuts, most, shown, paper: sheet.room(), scales, heights: [bottom, top] };
        reaches.iter().map(|reach| strips.draw(reach).ok_or_else(nothing)).collect::<Vec<_>>()
    });
    drawn.collect()
}

/// What is drawn of the lines on every sheet.
struct Strips<'a> {
    record: &'a FairRecord,
    combs: &'a FairingCombs,
    kind: Kind,
    all: &'a [Cut],
    cuts: &'a [Cut],
    /// Strips that have room on a sheet, and all that are shown.
    most: usize,
    shown: usize,
    paper: [f64; 2],
    scales: (u32, f64),
    /// Least and greatest height or distance \[m\].
    heights: [f64; 2],
}

impl Strips<'_> {
    /// The sheet of a part of the ship; none without lines.
    fn draw(&self, reach: &Reach) -> Option<Canvas> {
        let Self { record, combs, kind, all, cuts, most, shown, paper, scales: (n, stretch), heights: [bottom, top] } =
            *self;
        let millimetres = 1000.0 / f64::from(n);
        let pitch = (paper[1] - HEAD - FOOT) / most as f64;
        let [words, across, heights, axis] = kind.words();
        let scale = if stretch > 1.0 { format!("1:{n}, {across} x {stretch:.0}") } else { format!("1:{n}") };
        let plan = Plan {
            record,
            combs,
            title: words,
            part: reach.name.clone(),
            scale,
            heights,
            room: paper,
            longest: LONGEST_ALONG,
        };
        let width = millimetres * reach.length();
        let left = long_left(paper, width);
        let height = stretch * millimetres * (top - bottom);
        let stations: Vec<&OffsetStation> =
            record.lines.stations.iter().filter(|station| reach.has(station.x)).collect();
        let window = reach.window([left, left + width], paper);
        let mut canvas = Canvas::new(paper[0], paper[1]);
        let mut drawn: Option<Drawn> = None;
        for (k, cut) in cuts.iter().enumerate() {
            let upper = HEAD + pitch * k as f64;
            let middle = upper + WORDS + 0.5 * (pitch - WORDS);
            let frame = Rectangle::new(left, middle - 0.5 * height, left + width, middle + 0.5 * height);
            let strip = Strip { frame, from: [reach.x[0], bottom], millimetres, stretch };
            for station in &stations {
                canvas.line(strip.at([station.x, bottom]), strip.at([station.x, top]), &GRID);
            }
            let _ = reach.draw_border(&mut canvas, [left, left + width], [frame.top - 3.0, frame.bottom + 3.0]);
            let ruled = rules(&mut canvas, &strip.frame, &Range { low: bottom, high: top });
            let at = |cut: &Cut| {
                let (cut, strip) = (*cut, &strip);
                move |p: [f64; 3]| strip.at(Kind::project(&cut, p))
            };
            canvas.begin_clip(&window);
            let whole = canvas.frame();
            let own = std::slice::from_ref(cut);
            let one = draw(&mut canvas, &plan, own, 0.01 / (stretch * millimetres), &at, &|_| whole);
            canvas.end_group();
            let one = one.inside(&window);
            figures_clear(&mut canvas, &mut one.placer(), &strip.frame, &ruled, axis);
            drawn = Some(match drawn {
                Some(others) => others.joined(one),
                None => one,
            });
            let bearing = combs.on(&[*cut]);
            let [before, after] = [0, 1].map(|k| bearing[k].iter().map(|comb| comb.inflections.len()).sum::<usize>());
            let bears = if bearing[1].is_empty() {
                String::new()
            } else if reach.is_whole() {
                format!("    inflections {before} → {after}")
            } else {
                format!("    inflections of the whole line {before} → {after}")
            };
            let style = TextStyle::new(LETTERS, Anchor::Start);
            canvas.text([left, upper + 2.5], &format!("{}{bears}", name(cut, all)), &style);
        }
        let drawn = drawn?;
        title(&mut canvas, &plan, &drawn);
        let window = Rectangle::new(4.0, 24.0, paper[0] - 4.0, paper[1] - 14.0);
        let style = TextStyle::new(LETTERS, Anchor::Middle);
        let mut placer = drawn.placer();
        for text in canvas.texts() {
            placer.take(text.place);
        }
        for station in stations {
            let px = left + millimetres * (station.x - reach.x[0]);
            let word: String = caption::plain(&station.name).chars().take(9).collect();
            let places = ROWS.map(|down| [px, paper[1] - FOOT + down]);
            placer.name_point(&mut canvas, &word, &style, &places, &window);
        }
        drawn.name_cut(&mut canvas, &mut placer, &[window]);
        if shown < all.len() {
            let plural = if kind == Kind::Buttocks { "buttocks" } else { "diagonals" };
            let words = format!("{shown} of {} {plural}; the lines plan has all of them", all.len());
            canvas.text([0.5 * paper[0], paper[1] - 17.5], &words, &style);
        }
        canvas.text([14.0, paper[1] - 17.5], "AFT", &TextStyle::new(3.2, Anchor::Start));
        canvas.text([paper[0] - 14.0, paper[1] - 17.5], "FORWARD", &TextStyle::new(3.2, Anchor::End));
        Some(canvas)
    }
}
