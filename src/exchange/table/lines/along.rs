//! Sections that are made of waterlines: their half-breadths at one x, between the contour of keel, stem and stern below
//! and the deck at side above; straight between them.
//!
//! The contour is of the curves on the centreplane that pass through the ends of waterlines, have its names as layers, or
//! stand upright on the layer of sections. Where there is none at an end, the ends of the waterlines are it.

use std::collections::BTreeSet;
use std::f64::consts::PI;

use super::super::outline::point;
use super::super::problem::{FilePosition, Problems};
use super::super::sections::Section;
use super::{FLAT, Planes, SpaceCurve};
use crate::exchange::table::body::SEAM;
use crate::hull::OutlinePoint;
use crate::units::counted;

/// Fewer waterlines make no sections.
pub(super) const LEAST_WATERLINES: usize = 3;

/// Spaces between sections that are made of waterlines, and those at an end of others.
pub(super) const SECTIONS: usize = 40;
const AT_END: usize = 6;

/// Words in the layers of contours, and of the deck at side.
const CONTOURS: [&str; 7] = ["STEM", "STERN", "KEEL", "PROFILE", "CONTOUR", "BOW", "TRANSOM"];
const DECKS: [&str; 2] = ["SHEER", "DECK"];

/// A contour ends the hull where it rises to the top of the outermost section less this part of its height.
const RISEN: f64 = 0.2;

/// Ends of waterlines at which contours are looked for.
const MOST_ENDS: usize = 400;

/// A waterline by the curves that draw it.
struct Waterline<'a> {
    z: f64,
    curves: Vec<&'a SpaceCurve>,
}

/// What runs along the hull.
pub(super) struct Along<'a> {
    waterlines: Vec<Waterline<'a>>,
    /// Curves on the centreplane as points (x, z).
    contour: Vec<Vec<[f64; 2]>>,
    sheer: Vec<&'a SpaceCurve>,
    size: f64,
}

fn has_word(line: &SpaceCurve, words: &[&str]) -> bool {
    let layer = line.layer.to_ascii_uppercase();
    words.iter().any(|word| layer.contains(word))
}

fn is_deck(line: &SpaceCurve, slack: f64) -> bool {
    has_word(line, &DECKS) && !line.is_flat(0, slack)
}

/// The values of a polyline at a place of one of its coordinates.
fn crossings<const N: usize>(points: &[[f64; N]], at: f64) -> impl Iterator<Item = [f64; N]> + '_ {
    points.windows(2).filter_map(move |pair| {
        let (a, b) = (pair[0], pair[1]);
        let (low, high) = (a[0].min(b[0]), a[0].max(b[0]));
        let share = if high > low { (at - a[0]) / (b[0] - a[0]) } else { 0.0 };
        (low <= at && at <= high).then(|| std::array::from_fn(|k| a[k] + share * (b[k] - a[k])))
    })
}

impl Waterline<'_> {
    /// The greatest half-breadth at x.
    fn breadth(&self, x: f64) -> Option<f64> {
        let all = self.curves.iter().flat_map(|line| crossings(&line.points, x));
        all.map(|[_, y, _]| y.abs()).max_by(f64::total_cmp)
    }

    /// Whether it reaches the centreplane at x, from the side or along a transom.
    fn meets_centreplane(&self, x: f64, slack: f64) -> bool {
        let points = || self.curves.iter().flat_map(|line| &line.points);
        points().any(|[own, y, _]| (own - x).abs() <= slack && y.abs() <= slack)
    }

    /// Its ends.
    fn range(&self) -> [f64; 2] {
        let ranges = self.curves.iter().map(|line| line.range(0));
        ranges.fold([f64::INFINITY, f64::NEG_INFINITY], |p, q| [p[0].min(q[0]), p[1].max(q[1])])
    }
}

impl<'a> Along<'a> {
    pub(super) fn of(planes: &Planes<'a>, size: f64) -> Self {
        let slack = FLAT * size;
        let mut waterlines: Vec<Waterline<'a>> = Vec::new();
        let mut sorted = planes.level.clone();
        sorted.sort_by(|a, b| a.points[0][2].total_cmp(&b.points[0][2]));
        for line in sorted {
            let z = line.points[0][2];
            match waterlines.last_mut().filter(|last| (last.z - z).abs() <= slack) {
                Some(last) => last.curves.push(line),
                None => waterlines.push(Waterline { z, curves: vec![line] }),
            }
        }
        // Ends of waterlines on the centreplane.
        let ends: Vec<[f64; 2]> = waterlines
            .iter()
            .flat_map(|line| line.range().map(|x| (x, line)))
            .filter(|(x, line)| line.meets_centreplane(*x, SEAM * size))
            .map(|(x, line)| [x, line.z])
            .collect();
        let flat = |line: &SpaceCurve| line.points.iter().map(|&[x, _, z]| [x, z]).collect::<Vec<_>>();
        let stride = (ends.len() / MOST_ENDS).max(1);
        let passes = |line: &SpaceCurve| {
            let points = flat(line);
            ends.iter().step_by(stride).filter(|end| near(&points, **end) <= SEAM * size).count() > 1
        };
        let mut contour: Vec<Vec<[f64; 2]>> =
            planes.middle.iter().filter(|l| has_word(l, &CONTOURS) || passes(l)).map(|l| flat(l)).collect();
        // A section without breadth on the layer of the others, and a keel that is drawn as a waterline without breadth.
        let layers = |lines: &[&'a SpaceCurve]| lines.iter().map(|l| l.layer.as_str()).collect::<BTreeSet<&str>>();
        let (across, level) = (layers(&planes.across), layers(&planes.level));
        let is_upright = |l: &SpaceCurve| l.is_flat(0, slack) && across.contains(l.layer.as_str());
        let is_keel = |l: &SpaceCurve| l.is_flat(2, slack) && level.contains(l.layer.as_str());
        contour.extend(planes.middle.iter().filter(|l| is_upright(l)).map(|l| flat(l)));
        let keel: Vec<Vec<[f64; 2]>> = planes.middle.iter().filter(|l| is_keel(l)).map(|l| flat(l)).collect();
        // Where most ends of waterlines are on no contour, they are it.
        let [low, high] = waterlines.iter().map(Waterline::range).fold([0.0; 2], |[a, b], [c, d]| [a + c, b + d]);
        let middle = 0.5 * (low + high) / waterlines.len().max(1) as f64;
        let (aft, fore): (Vec<[f64; 2]>, Vec<[f64; 2]>) = ends.iter().copied().partition(|end| end[0] < middle);
        for half in [aft, fore].into_iter().filter(|half| half.len() > 1) {
            let is_free = |end: &&[f64; 2]| !contour.iter().any(|line| near(line, **end) <= SEAM * size);
            let looked = || half.iter().step_by(stride);
            if 2 * looked().filter(is_free).count() > looked().count() {
                contour.push(half);
            }
        }
        contour.extend(keel);
        let named = planes.others.iter().chain(&planes.level).chain(&planes.across);
        let sheer = named.copied().filter(|line| is_deck(line, slack)).collect();
        Self { waterlines, contour, sheer, size }
    }

    /// How many waterlines there are.
    pub(super) fn heights(&self) -> usize {
        self.waterlines.len()
    }

    /// Whether a curve is the deck at side.
    pub(super) fn uses(&self, line: &SpaceCurve) -> bool {
        is_deck(line, FLAT * self.size)
    }

    /// The points of one side at x from below: of the contour, the waterlines and the deck.
    fn points(&self, x: f64) -> Vec<OutlinePoint> {
        let slack = FLAT * self.size;
        let deck = self.sheer.iter().flat_map(|line| crossings(&line.points, x));
        let deck = deck.map(|[_, y, z]| point(y.abs(), z)).max_by(|a, b| a.z.total_cmp(&b.z));
        let top = deck.map_or(f64::INFINITY, |deck| deck.z);
        let breadths = self.waterlines.iter().filter_map(|line| Some(point(line.breadth(x)?, line.z)));
        let mut points: Vec<OutlinePoint> = breadths.filter(|p| p.z < top - slack).collect();
        points.extend(deck);
        let heights = self.contour.iter().flat_map(|line| crossings(line, x)).map(|[_, z]| z);
        // A waterline that is there has the breadth of its height. Waterlines are in the order of their heights.
        let is_there = |z: f64| {
            let next = points.partition_point(|p| p.z < z - slack);
            points.get(next).is_some_and(|p| p.z <= z + slack)
        };
        let free = heights.filter(|&z| z < top - slack && !is_there(z));
        let middle: Vec<OutlinePoint> = free.map(|z| point(0.0, z)).collect();
        points.extend(middle);
        points.sort_by(|a, b| a.z.total_cmp(&b.z));
        points.dedup_by(|b, a| (a.z - b.z).abs() <= slack && (a.y - b.y).abs() <= slack);
        points
    }

    /// Sections between the ends of all waterlines.
    pub(super) fn sections(&self, problems: &mut Problems) -> Vec<Section> {
        let ranges = self.waterlines.iter().map(Waterline::range);
        let [aft, fore] = ranges.fold([f64::INFINITY, f64::NEG_INFINITY], |p, q| [p[0].min(q[0]), p[1].max(q[1])]);
        let message = format!(
            "{} waterlines: sections at {} x are made of straight lines between them",
            self.heights(),
            SECTIONS + 1
        );
        problems.warning("W334", FilePosition::FILE, message, "");
        let slack = FLAT * self.size;
        let sections = (0..=SECTIONS).map(|k| {
            let x = aft + 0.5 * (fore - aft) * (1.0 - (PI * k as f64 / SECTIONS as f64).cos());
            made(x, self.points(x))
        });
        let ends = |section: &Section| section.x <= aft || section.x >= fore;
        let is_whole = |section: &Section| {
            let points = &section.branches[0];
            points.len() > 1 && (ends(section) || points.iter().any(|p| p.y > slack))
        };
        sections.filter(is_whole).collect()
    }

    /// Closes a hull beyond its outermost sections, where a contour ends it; whether waterlines were needed.
    pub(super) fn close(&self, list: &mut Vec<Section>, problems: &mut Problems) -> bool {
        let mut made = 0;
        for fore in [false, true] {
            let Some(last) = (if fore { list.last() } else { list.first() }) else { return false };
            let sign = if fore { 1.0 } else { -1.0 };
            let Some(end) = self.end(last, sign) else { continue };
            let (from, mut added) = (last.x, vec![end.clone()]);
            if self.heights() >= LEAST_WATERLINES {
                let between = (1..AT_END).map(|k| {
                    let x = from + (end.x - from) * (0.5 * PI * k as f64 / AT_END as f64).sin();
                    self::made(x, self.points(x))
                });
                added.extend(between.filter(|section| section.branches[0].len() > 1));
            }
            if added.len() == 1 {
                let message = format!(
                    "a line on the centreplane at x = {:.3} m ends the hull, straight from the section at x = {from:.3} m",
                    end.x
                );
                problems.warning("W334", FilePosition::FILE, message, "");
            }
            made += added.len() - 1;
            list.extend(added);
            list.sort_by(|a, b| a.x.total_cmp(&b.x));
        }
        if made > 0 {
            let message = format!(
                "{} between the outermost ones and the ends of the hull are made of waterlines, straight between them",
                counted(made, "section")
            );
            problems.warning("W334", FilePosition::FILE, message, "");
        }
        made > 0
    }

    /// The end of the hull beyond its outermost section, forward (1) or aft (-1): on a contour that rises to its deck.
    fn end(&self, last: &Section, sign: f64) -> Option<Section> {
        let slack = FLAT * self.size;
        let points = || last.branches.iter().flatten();
        let [low, top] = points().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], p| [a.min(p.z), b.max(p.z)]);
        let beyond = |p: &&[f64; 2]| sign * (p[0] - last.x) > slack;
        let rises = |line: &&Vec<[f64; 2]>| line.iter().filter(beyond).any(|p| p[1] >= top - RISEN * (top - low));
        let contour = self.contour.iter().filter(rises).flatten();
        let deck = self.sheer.iter().flat_map(|line| &line.points).filter(|p| p[1].abs() <= SEAM * self.size);
        let deck = deck.map(|&[x, _, z]| [x, z]);
        let tips: Vec<[f64; 2]> = contour.copied().chain(deck).filter(|p| beyond(&p)).collect();
        let x = sign * tips.iter().map(|p| sign * p[0]).max_by(f64::total_cmp)?;
        let mut points = self.points(x);
        points.extend(tips.iter().filter(|p| (p[0] - x).abs() <= slack).map(|p| point(0.0, p[1])));
        points.sort_by(|a, b| a.z.total_cmp(&b.z));
        points.dedup_by(|b, a| (a.z - b.z).abs() <= slack);
        Some(made(x, points))
    }
}

/// The distance of a point from a polyline.
fn near(line: &[[f64; 2]], [x, z]: [f64; 2]) -> f64 {
    let distance = |pair: &[[f64; 2]]| {
        let ([a, b], [c, d]) = (pair[0], pair[1]);
        let (dx, dz) = (c - a, d - b);
        let squared = dx * dx + dz * dz;
        let share = if squared > 0.0 { (((x - a) * dx + (z - b) * dz) / squared).clamp(0.0, 1.0) } else { 0.0 };
        (a + share * dx - x).hypot(b + share * dz - z)
    };
    line.windows(2).map(distance).fold(f64::INFINITY, f64::min)
}

fn made(x: f64, points: Vec<OutlinePoint>) -> Section {
    Section { name: None, x, place: FilePosition::FILE, branches: vec![points], deck: None }
}
