//! A hull before and after fairing: what plans with combs share.
//!
//! Before is grey, after is black and blue; the combs of both have one scale, inflections are ringed. Stations and
//! waterlines are those of the table.

use super::combs::FairingCombs;
use super::sections::whole_curves;
use crate::fairing::inspect::Comb;
use crate::fairing::record::FairRecord;
use crate::hull::{Cut, OffsetStation};
use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::font::LETTERS;
use crate::plot::paper::label::LabelPlacer;
use crate::plot::paper::scale::figures;
use crate::plot::paper::sheet::{in_lines, wide};
use crate::plot::ship::caption;
use crate::plot::ship::comb::{CombPens, CombScale, CutTeeth, arrows_apart, draw_arrows, draw_rings};
use crate::plot::ship::extrapolated::{BEYOND, guessed, known, parts};
use crate::plot::ship::view::THREAD;
use crate::qp::Status;
use crate::units::counted;

/// Deviation of drawn chords \[m\] a millimetre of the sheet.
pub(in crate::plot) const CHORD: f64 = 0.01;

pub(in crate::plot) const BEFORE: Pen = Pen::new(0.2, "#7d7d7d");
pub(in crate::plot) const AFTER: Pen = Pen::new(0.22, "#000000");
pub(in crate::plot) const BEFORE_COMB: CombPens = CombPens {
    teeth: Pen::new(0.1, "#dedede"),
    tips: Pen::new(0.18, "#8f8f8f").dashed(&[0.7, 0.5]),
    ring: Pen::new(0.3, "#9a9a9a"),
    cut: Pen::new(0.15, "#8f8f8f"),
};
pub(in crate::plot) const AFTER_COMB: CombPens = CombPens {
    teeth: Pen::new(0.1, "#a9c0e2"),
    tips: Pen::new(0.2, "#1f5fa8"),
    ring: Pen::new(0.4, "#c00000"),
    cut: Pen::new(0.25, "#000000"),
};

/// A plan: which lines, where points of the ship stand.
pub(in crate::plot) struct Plan<'a> {
    pub(in crate::plot) record: &'a FairRecord,
    pub(in crate::plot) combs: &'a FairingCombs,
    pub(in crate::plot) title: &'static str,
    /// Which part of the ship it shows, where that is not the whole.
    pub(in crate::plot) part: String,
    pub(in crate::plot) scale: String,
    /// What the names of the other lines are.
    pub(in crate::plot) heights: &'static str,
    /// Width and height of the drawing \[mm\].
    pub(in crate::plot) room: [f64; 2],
    /// Longest tooth of a comb that it has room for \[mm\].
    pub(in crate::plot) longest: f64,
}

/// Places on a sheet of the inflections of fair lines, line by line.
pub(in crate::plot) fn rings_of(combs: &[&Comb], at: impl Fn(&Comb, [f64; 3]) -> [f64; 2]) -> Vec<Vec<[f64; 2]>> {
    combs.iter().map(|comb| comb.inflections.iter().map(|&place| at(comb, place)).collect()).collect()
}

/// The pieces of a line that lie in a window.
fn pieces_inside(line: &[[f64; 2]], window: &Rectangle) -> Vec<Vec<[f64; 2]>> {
    let inside = |p: &[f64; 2]| window.contains(&Rectangle::new(p[0], p[1], p[0], p[1]));
    line.split(|p| !inside(p)).filter(|piece| piece.len() > 1).map(<[_]>::to_vec).collect()
}

/// What was drawn.
pub(in crate::plot) struct Drawn {
    /// The fair curves with the number of their plane.
    pub(in crate::plot) curves: Vec<(usize, Vec<[f64; 2]>)>,
    /// Inflections.
    rings: Vec<[f64; 2]>,
    /// The scale of the combs; none where there are no combs.
    words: Option<String>,
    /// Tips of the combs, and teeth of the fair ones.
    tips: Vec<Vec<[f64; 2]>>,
    teeth: Vec<[[f64; 2]; 2]>,
    /// Arrows for teeth of the fair curves that had to be left out, with their curvature \[1/m\].
    cut: Vec<CutTeeth>,
    /// The same of the curves before.
    cut_before: Vec<[[f64; 2]; 2]>,
    /// Whether curves run on beyond the offsets of their lines.
    beyond: bool,
    /// Where arrows and rings are not drawn for want of room.
    left: [Vec<[f64; 2]>; 2],
}

impl Drawn {
    /// What was drawn here and what was drawn there.
    pub(in crate::plot) fn joined(mut self, other: Self) -> Self {
        self.curves.extend(other.curves);
        self.rings.extend(other.rings);
        self.tips.extend(other.tips);
        self.teeth.extend(other.teeth);
        self.cut.extend(other.cut);
        self.cut_before.extend(other.cut_before);
        for (own, more) in self.left.iter_mut().zip(other.left) {
            own.extend(more);
        }
        Self { words: self.words.or(other.words), beyond: self.beyond || other.beyond, ..self }
    }

    /// What of it is seen in a window.
    pub(in crate::plot) fn inside(self, window: &Rectangle) -> Self {
        let has = |p: &[f64; 2]| window.contains(&Rectangle::new(p[0], p[1], p[0], p[1]));
        let curves = self.curves.iter();
        Self {
            curves: curves
                .flat_map(|(k, line)| pieces_inside(line, window).into_iter().map(|piece| (*k, piece)))
                .collect(),
            rings: self.rings.into_iter().filter(has).collect(),
            tips: self.tips.iter().flat_map(|line| pieces_inside(line, window)).collect(),
            teeth: self.teeth.into_iter().filter(|[foot, _]| has(foot)).collect(),
            cut: self.cut.into_iter().filter(|([foot, _], _)| has(foot)).collect(),
            cut_before: self.cut_before.into_iter().filter(|[foot, _]| has(foot)).collect(),
            left: self.left.map(|places| places.into_iter().filter(has).collect()),
            ..self
        }
    }

    /// Keeps names off the curves and the rings, and off the combs where there is room.
    pub(in crate::plot) fn placer(&self) -> LabelPlacer {
        let mut placer = LabelPlacer::default();
        self.curves.iter().for_each(|(_, line)| placer.add_curve(line));
        self.tips.iter().for_each(|line| placer.add_faint(line));
        placer.add_teeth(&self.teeth);
        self.cut.iter().for_each(|(arrow, _)| placer.add_arrow(*arrow));
        self.cut_before.iter().for_each(|arrow| placer.add_arrow(*arrow));
        for [x, y] in &self.rings {
            placer.take(Rectangle::new(*x, *y, *x, *y).grown(1.2));
        }
        placer
    }

    /// Writes the curvature of teeth that had to be left out beside their arrows, each in the one of `windows` that the
    /// arrow is in.
    pub(in crate::plot) fn name_cut(&self, canvas: &mut Canvas, placer: &mut LabelPlacer, windows: &[Rectangle]) {
        let middle = |[a, b]: [[f64; 2]; 2]| [0, 1].map(|d| 0.5 * (a[d] + b[d]));
        let has = |window: &Rectangle, [x, y]: [f64; 2]| window.contains(&Rectangle::new(x, y, x, y));
        for cut in &self.cut {
            if let Some(window) = windows.iter().find(|window| has(window, middle(cut.0))) {
                name_curvatures(canvas, placer, std::slice::from_ref(cut), window);
            }
        }
    }
}

/// Writes the curvature of teeth that had to be left out beside their arrows.
pub(in crate::plot) fn name_curvatures(
    canvas: &mut Canvas,
    placer: &mut LabelPlacer,
    cut: &[([[f64; 2]; 2], f64)],
    window: &Rectangle,
) {
    let style = TextStyle::new(LETTERS, Anchor::Middle).halo();
    for (arrow, curvature) in cut {
        let name = if *curvature > CORNER { "a corner".to_owned() } else { format!("{} 1/m", figures(*curvature, 2)) };
        placer.name_arrow(canvas, &name, &style, *arrow, window, &THREAD);
    }
}

/// Curvature \[1/m\] beyond which a line is rounded with less than a millimetre, which is none.
const CORNER: f64 = 1e3;

/// Room at each side of the words below a drawing, where AFT and FORWARD may stand \[mm\].
const BESIDE_KEY: f64 = 30.0;

/// Draws combs, which stay inside what `bounds` says of their planes, and curves.
pub(in crate::plot) fn draw<F: Fn([f64; 3]) -> [f64; 2]>(
    canvas: &mut Canvas,
    plan: &Plan<'_>,
    cuts: &[Cut],
    deviation: f64,
    at: &dyn Fn(&Cut) -> F,
    bounds: &dyn Fn(&Cut) -> Rectangle,
) -> Drawn {
    let [before, after] = plan.combs.on(cuts);
    let (mut tips, mut teeth) = (Vec::new(), Vec::new());
    let mut long: [Vec<CutTeeth>; 2] = [Vec::new(), Vec::new()];
    for (k, (list, pens)) in [(&before, &BEFORE_COMB), (&after, &AFTER_COMB)].into_iter().enumerate() {
        for comb in list {
            let scale = plan.combs.scale(&comb.cut).within(plan.longest);
            let drawn = scale.draw(canvas, comb, at(&comb.cut), pens, &bounds(&comb.cut));
            tips.extend(drawn.tips);
            long[k].extend(drawn.cut);
            if k == 1 {
                teeth.extend(drawn.teeth);
            }
        }
    }
    let [long_before, long_after] = long;
    let (cut, mut arrows_left) = arrows_apart(long_after, &[]);
    let (cut_before, left_before) = arrows_apart(long_before, &cut);
    arrows_left.extend(left_before);
    draw_arrows(canvas, &cut_before, &BEFORE_COMB.cut);
    draw_arrows(canvas, &cut, &AFTER_COMB.cut);
    let (mut curves, mut beyond) = (Vec::new(), false);
    for (hull, pen, fair) in [(&plan.record.before, &BEFORE, false), (&plan.record.after, &AFTER, true)] {
        for (k, cut) in cuts.iter().enumerate() {
            for line in whole_curves(hull, *cut, deviation) {
                for (out, part) in parts(&line, known(plan.record, cut)) {
                    let part: Vec<[f64; 2]> = part.into_iter().map(at(cut)).collect();
                    let pen = if out { guessed(*pen) } else { *pen };
                    canvas.polyline(&part, &pen);
                    beyond |= out;
                }
                let line: Vec<[f64; 2]> = line.into_iter().map(at(cut)).collect();
                if fair {
                    curves.push((k, line));
                }
            }
        }
    }
    let (mut rings, mut rings_left) = (Vec::new(), Vec::new());
    for (list, pens) in [(&before, &BEFORE_COMB), (&after, &AFTER_COMB)] {
        let places = rings_of(list, |comb, place| at(&comb.cut)(place)).concat();
        let [drawn, left] = draw_rings(canvas, &places, &pens.ring);
        rings.extend(drawn);
        rings_left.extend(left);
    }
    let bearing = cuts.iter().filter(|cut| after.iter().any(|comb| comb.cut == **cut)).count();
    let words = after.first().map(|comb| plan.combs.words(&comb.cut, [bearing, cuts.len()]));
    let cut_before = cut_before.into_iter().map(|(arrow, _)| arrow).collect();
    Drawn { curves, rings, words, tips, teeth, cut, cut_before, beyond, left: [arrows_left, rings_left] }
}

/// What the names of the stations are: their x, or names of the table with the x of the first and the last.
pub(in crate::plot) fn station_words(record: &FairRecord) -> String {
    let stations = &record.lines.stations;
    match (stations.first(), stations.last()) {
        (Some(a), Some(b)) if !stations.iter().all(OffsetStation::is_named_by_place) => format!(
            "stations by their names in the table, from {} at x = {:.2} m to {} at x = {:.2} m forward of AP",
            caption::plain(&a.name),
            a.x,
            caption::plain(&b.name),
            b.x
        ),
        _ => "stations by x [m] forward of AP".to_owned(),
    }
}

/// How many arrows and rings are not drawn; nothing where all are.
pub(in crate::plot) fn left_out_words([arrows, rings]: [usize; 2]) -> Option<String> {
    let counts = [(arrows, "arrow"), (rings, "ring")].into_iter().filter(|(count, _)| *count > 0);
    let counts: Vec<String> = counts.map(|(count, word)| counted(count, word)).collect();
    let verb = if arrows + rings == 1 { "is" } else { "are" };
    (!counts.is_empty()).then(|| format!("{} {verb} not drawn, for want of room", counts.join(" and ")))
}

/// Title, scales and key.
pub(in crate::plot) fn title(canvas: &mut Canvas, plan: &Plan<'_>, drawn: &Drawn) {
    let name: String = caption::plain(&plan.record.name).chars().take(60).collect();
    let words = format!("{} BEFORE AND AFTER FAIRING{} – {name}", plan.title, plan.part);
    canvas.text([0.5 * plan.room[0], 9.0], &words, &TextStyle::new(4.5, Anchor::Middle));
    let (rms, largest, _) = plan.record.moves();
    let left_out = !drawn.cut.is_empty() || !drawn.cut_before.is_empty();
    let longer = if left_out { ", arrows: longer than there is room for, with the curvature after" } else { "" };
    let combs = drawn.words.as_ref().map_or("no combs".to_owned(), |words| format!("{words}{longer}"));
    let second = format!(
        "scale {}    {combs}    moves {:.2} mm RMS, {:.2} mm at most",
        plan.scale,
        1000.0 * rms,
        1000.0 * largest
    );
    canvas.text([0.5 * plan.room[0], 16.0], &second, &TextStyle::new(3.2, Anchor::Middle));
    let words = TextStyle::new(LETTERS, Anchor::Middle);
    if let Some(left) = left_out_words(drawn.left.each_ref().map(Vec::len)) {
        canvas.text([0.5 * plan.room[0], 21.3], &left, &words);
    }
    let rings = format!(
        "rings: inflections of bends {} or more off their chord",
        plan.record.lines.notation.small(plan.record.resolution)
    );
    let stations = station_words(plan.record);
    let key = [stations.as_str(), plan.heights, &rings].into_iter().chain(drawn.beyond.then_some(BEYOND));
    let lines = in_lines(key, "    ", |line| wide(line, LETTERS) <= plan.room[0] - 2.0 * BESIDE_KEY);
    for (above, line) in lines.iter().rev().enumerate() {
        canvas.text([0.5 * plan.room[0], plan.room[1] - 12.5 - 4.6 * above as f64], line, &words);
    }
    let y = plan.room[1] - 6.0;
    let style = TextStyle::new(LETTERS, Anchor::Start);
    let mut x = 10.0;
    for (pens, pen, word) in [(BEFORE_COMB, BEFORE, "before"), (AFTER_COMB, AFTER, "after")] {
        canvas.line([x, y], [x + 12.0, y], &pen);
        canvas.text([x + 13.0, y], word, &style);
        canvas.line([x + 30.0, y], [x + 40.0, y], &pens.tips);
        canvas.text([x + 41.5, y], "tips of the comb", &style);
        let at = [x + 78.0, y];
        let ring = Comb { cut: Cut::Waterline { z: 0.0 }, teeth: Vec::new(), inflections: vec![[at[0], at[1], 0.0]] };
        CombScale::rings(canvas, &ring, |p| [p[0], p[1]], &pens);
        canvas.text([x + 81.0, y], "inflection", &style);
        x += 112.0;
    }
    if plan.record.status != Status::Optimal {
        caption::compromise(canvas, [x, y], &style);
    }
    canvas.text([plan.room[0] - 8.0, y], &caption::program(), &TextStyle::new(LETTERS, Anchor::End));
}
