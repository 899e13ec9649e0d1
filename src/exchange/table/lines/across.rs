//! Curves at one x as sections: pieces whose ends meet are one line, and of two sides one is taken.

use std::collections::{BTreeMap, BTreeSet};

use super::super::body::{SEAM, joined};
use super::super::outline::{Deck, deviation, point, take_off_deck};
use super::super::problem::{FilePosition, Problems};
use super::super::sections::{Section, note_asymmetry, starboard_of};
use super::{FLAT, SpaceCurve, named};
use crate::hull::{MeshLine, OutlinePoint};
use crate::units::counted;

/// Curves at one x at most.
const MOST_PIECES: usize = 1_000;

/// Two sides are alike where they differ by no more than this part of the size of the hull.
const ALIKE: f64 = 1e-5;

/// Curves of minor layers that go on from each other at most.
const MOST_STEPS: usize = 100;

/// A curve is beside another where its middle height is within that one's less this part of it at both ends.
const BESIDE: f64 = 0.02;

/// The sections at rising x, of a hull of this size \[m\], and the curves that are left out.
pub(super) fn sections<'a>(
    lines: &[&'a SpaceCurve],
    size: f64,
    problems: &mut Problems,
) -> (Vec<Section>, Vec<&'a SpaceCurve>) {
    let slack = FLAT * size;
    let mut sorted = lines.to_vec();
    sorted.sort_by(|a, b| a.points[0][0].total_cmp(&b.points[0][0]));
    let (mut list, mut gaps): (Vec<Section>, Vec<(f64, f64)>) = (Vec::new(), Vec::new());
    let (mut left, mut beside): (Vec<&SpaceCurve>, Vec<(f64, Vec<&SpaceCurve>)>) = (Vec::new(), Vec::new());
    let planes: Vec<&[&'a SpaceCurve]> = sorted.chunk_by(|a, b| b.points[0][0] - a.points[0][0] <= slack).collect();
    let minor = minor(&planes);
    for plane in planes {
        let first = plane[0];
        let x = first.points[0][0];
        if plane.len() > MOST_PIECES {
            let message = format!("{} at x = {x:.3} m, expected at most {MOST_PIECES}", counted(plane.len(), "curve"));
            problems.error("E312", first.place(), message, "Draw each section as one polyline");
            return (Vec::new(), Vec::new());
        }
        let (own, dropped) = kept(plane, &minor, SEAM * size);
        left.extend(dropped);
        let Some(Sides { mut branches, gap, are_beside }) = branches(&own, size) else { continue };
        if are_beside {
            beside.push((x, own));
        }
        gaps.extend(gap.map(|gap| (gap, x)));
        branches.sort_by(|a, b| a[0].z.total_cmp(&b[0].z));
        let deck: Option<Deck> = branches.last_mut().and_then(take_off_deck);
        list.push(Section { name: None, x, place: first.place(), branches, deck });
    }
    let widest = gaps.iter().map(|(gap, _)| *gap).fold(0.0, f64::max);
    if widest > ALIKE * size {
        note_asymmetry(&gaps, "port", problems);
    } else if !gaps.is_empty() {
        problems.note(format!("{} give both sides, which are alike", counted(gaps.len(), "section")));
    }
    if let Some((x, _)) = beside.first() {
        let layers: BTreeSet<&str> = beside.iter().flat_map(|(_, own)| own).map(|line| line.layer.as_str()).collect();
        let layers = named(layers.into_iter().filter(|layer| !layer.is_empty()).map(str::to_owned).collect());
        let of = if layers.is_empty() { layers } else { format!(" (layers {layers})") };
        let message = format!(
            "{}, the first at x = {x:.3} m, have curves beside each other at one height, and all of them count{of}",
            counted(beside.len(), "section")
        );
        problems.warning("W334", FilePosition::FILE, message, "Name the layers of the hull with --parts");
    }
    (list, left)
}

/// The curves of a plane that make its section, and the others: those of minor layers count where they are alone, or go
/// on above or below from the ends of the others, off the centreplane.
fn kept<'a>(plane: &[&'a SpaceCurve], minor: &BTreeSet<&str>, seam: f64) -> (Vec<&'a SpaceCurve>, Vec<&'a SpaceCurve>) {
    let is_minor = |line: &&SpaceCurve| minor.contains(line.layer.as_str());
    let (mut rest, mut kept): (Vec<&'a SpaceCurve>, Vec<&'a SpaceCurve>) = plane.iter().copied().partition(is_minor);
    if kept.is_empty() {
        return (rest, kept);
    }
    for _ in 0..MOST_STEPS {
        let heights = kept.iter().map(|line| line.range(2));
        let [low, high] = heights.fold([f64::INFINITY, f64::NEG_INFINITY], |p, q| [p[0].min(q[0]), p[1].max(q[1])]);
        let is_outer = |[y, z]: &[f64; 2]| y.abs() > seam && (*z <= low + seam || *z >= high - seam);
        let outer: Vec<[f64; 2]> = kept.iter().flat_map(|line| ends(line)).filter(is_outer).collect();
        let meets = |p: [f64; 2]| outer.iter().any(|&end| apart(p, end) <= seam);
        let goes_on = |line: &&SpaceCurve| {
            let ([a, b], [least, greatest]) = (ends(line), line.range(2));
            let far = match [meets(a), meets(b)] {
                [true, false] => b,
                [false, true] => a,
                _ => return false,
            };
            // What ends on the centreplane above is a deck.
            greatest <= low + seam || (least >= high - seam && far[0].abs() > seam)
        };
        let (more, others): (Vec<&'a SpaceCurve>, Vec<&'a SpaceCurve>) = rest.into_iter().partition(goes_on);
        rest = others;
        if more.is_empty() {
            break;
        }
        kept.extend(more);
    }
    (kept, rest)
}

/// The ends of a curve across the hull.
fn ends(line: &SpaceCurve) -> [[f64; 2]; 2] {
    let points = &line.points;
    [points[0], points[points.len() - 1]].map(|[_, y, z]| [y, z])
}

/// Whether of open curves of one side, by their heights from and to, one is beside another.
fn are_beside(heights: &[[f64; 2]]) -> bool {
    let is_beside = |a: &[f64; 2], b: &[f64; 2]| {
        let (short, long) = if a[1] - a[0] <= b[1] - b[0] { (a, b) } else { (b, a) };
        let (middle, slack) = (0.5 * (short[0] + short[1]), BESIDE * (long[1] - long[0]));
        middle > long[0] + slack && middle < long[1] - slack
    };
    (1_usize..).zip(heights).any(|(next, a)| heights[next..].iter().any(|b| is_beside(a, b)))
}

/// One side of a section.
struct Sides {
    branches: Vec<Vec<OutlinePoint>>,
    /// How far the other side is from it, where it is drawn \[m\].
    gap: Option<f64>,
    /// Whether it has open curves beside each other.
    are_beside: bool,
}

/// The branches of one side of a section; none without breadth.
fn branches(plane: &[&SpaceCurve], size: f64) -> Option<Sides> {
    let slack = FLAT * size;
    let (mut near, mut far): (Vec<Vec<OutlinePoint>>, Vec<Vec<OutlinePoint>>) = (Vec::new(), Vec::new());
    let mut heights: [Vec<[f64; 2]>; 2] = [Vec::new(), Vec::new()];
    let mut off: Option<f64> = None;
    let widened = |off: Option<f64>, gap: f64| Some(off.map_or(gap, |off| off.max(gap)));
    for line in joined(pieces(plane, size), SEAM * size) {
        let mut points: Vec<OutlinePoint> = line.points.iter().map(|&[y, z]| point(y, z)).collect();
        // Where pieces meet their ends are one point.
        points.dedup_by(|b, a| (a.y - b.y).abs() <= slack && (a.z - b.z).abs() <= slack);
        let has = |sign: f64| points.iter().any(|p| sign * p.y > slack);
        let sides = [1.0, -1.0].map(has);
        if sides == [true; 2] || line.closed {
            if let Some((found, gap)) = starboard_of(&points) {
                near.extend(found);
                if sides == [true; 2] {
                    off = widened(off, gap);
                }
            }
            continue;
        }
        let side = if sides[1] { &mut far } else { &mut near };
        let mut points: Vec<OutlinePoint> = points.into_iter().map(|p| point(p.y.abs(), p.z)).collect();
        if points[0].z > points[points.len() - 1].z {
            points.reverse();
        }
        if sides != [false; 2] {
            let ends = points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], p| [a.min(p.z), b.max(p.z)]);
            heights[usize::from(sides[1])].push(ends);
            side.push(points);
        }
    }
    if near.is_empty() {
        std::mem::swap(&mut near, &mut far);
    } else if !far.is_empty() {
        off = widened(off, deviation(&near, &far));
    }
    let are_beside = heights.iter().any(|list| are_beside(list));
    (!near.is_empty()).then_some(Sides { branches: near, gap: off, are_beside })
}

/// A curve of a plane, and the point at half its length.
struct Piece {
    line: MeshLine,
    middle: [f64; 2],
}

fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

impl Piece {
    fn of(line: &SpaceCurve, slack: f64) -> Self {
        let mut points: Vec<[f64; 2]> = line.points.iter().map(|&[_, y, z]| [y, z]).collect();
        let half = 0.5 * points.windows(2).map(|pair| apart(pair[0], pair[1])).sum::<f64>();
        let (mut middle, mut length) = (points[0], 0.0);
        for pair in points.windows(2) {
            let step = apart(pair[0], pair[1]);
            if step > 0.0 && (length..=length + step).contains(&half) {
                middle = [0, 1].map(|k| pair[0][k] + (half - length) / step * (pair[1][k] - pair[0][k]));
            }
            length += step;
        }
        let closed = points.len() > 3 && apart(points[0], points[points.len() - 1]) <= slack;
        if closed {
            points.pop();
        }
        Self { line: MeshLine { points, closed }, middle }
    }

    fn ends(&self) -> [[f64; 2]; 2] {
        let points = &self.line.points;
        [points[0], points[points.len() - 1]]
    }

    /// Whether two draw the same, however many points they have.
    fn is_again(&self, other: &Self, slack: f64, seam: f64) -> bool {
        let ([a, b], [c, d]) = (self.ends(), other.ends());
        let alike = |p: [f64; 2], q: [f64; 2]| apart(p, c) <= slack && apart(q, d) <= slack;
        (alike(a, b) || alike(b, a)) && apart(self.middle, other.middle) <= seam
    }
}

/// The curves of a plane, each once.
fn pieces(plane: &[&SpaceCurve], size: f64) -> Vec<MeshLine> {
    let slack = FLAT * size;
    let mut list: Vec<Piece> = Vec::new();
    for line in plane {
        let piece = Piece::of(line, slack);
        if !list.iter().any(|known| known.is_again(&piece, slack, SEAM * size)) {
            list.push(piece);
        }
    }
    list.into_iter().map(|piece| piece.line).collect()
}

/// The curves on layers that have few planes among those that have many: contours and transoms beside sections.
fn minor<'a>(planes: &[&[&'a SpaceCurve]]) -> BTreeSet<&'a str> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for plane in planes {
        let layers: BTreeSet<&str> = plane.iter().map(|line| line.layer.as_str()).collect();
        layers.into_iter().for_each(|layer| *counts.entry(layer).or_default() += 1);
    }
    let most = counts.values().copied().max().unwrap_or(0);
    counts.into_iter().filter(|(_, count)| 2 * count < most).map(|(layer, _)| layer).collect()
}
