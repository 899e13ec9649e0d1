//! Curves at one x as sections: pieces whose ends meet are one line, and of two sides one is taken.

use std::collections::{BTreeMap, BTreeSet};

use super::super::body::{SEAM, joined};
use super::super::outline::{Deck, deviation, point, take_off_deck};
use super::super::problem::Problems;
use super::super::sections::{Section, note_asymmetry, starboard_of};
use super::{FLAT, SpaceCurve};
use crate::hull::{MeshLine, OutlinePoint};
use crate::units::counted;

/// Curves at one x at most.
const MOST_PIECES: usize = 1_000;

/// Two sides are alike where they differ by no more than this part of the size of the hull.
const ALIKE: f64 = 1e-5;

/// The sections at rising x, of a hull of this size \[m\].
pub(super) fn sections(lines: &[&SpaceCurve], size: f64, problems: &mut Problems) -> Vec<Section> {
    let slack = FLAT * size;
    let mut sorted = lines.to_vec();
    sorted.sort_by(|a, b| a.points[0][0].total_cmp(&b.points[0][0]));
    let (mut list, mut gaps): (Vec<Section>, Vec<(f64, f64)>) = (Vec::new(), Vec::new());
    let planes: Vec<&[&SpaceCurve]> = sorted.chunk_by(|a, b| b.points[0][0] - a.points[0][0] <= slack).collect();
    let minor = minor(&planes);
    for plane in planes {
        let first = plane[0];
        let x = first.points[0][0];
        if plane.len() > MOST_PIECES {
            let message = format!("{} at x = {x:.3} m, expected at most {MOST_PIECES}", counted(plane.len(), "curve"));
            problems.error("E312", first.place(), message, "Draw each section as one polyline");
            return Vec::new();
        }
        let mut own = plane.to_vec();
        own.retain(|line| !minor.contains(line.layer.as_str()));
        let own = if own.is_empty() { plane } else { &own };
        let Some((mut branches, gap)) = branches(own, size) else { continue };
        gaps.extend(gap.map(|gap| (gap, x)));
        branches.sort_by(|a, b| a[0].z.total_cmp(&b[0].z));
        let deck: Option<Deck> = branches.last_mut().and_then(take_off_deck);
        list.push(Section { name: None, x, place: first.place(), branches, deck });
    }
    let widest = gaps.iter().map(|(gap, _)| *gap).fold(0.0, f64::max);
    if widest > ALIKE * size {
        note_asymmetry(&gaps, problems);
    } else if !gaps.is_empty() {
        problems.note(format!("{} give both sides, which are alike", counted(gaps.len(), "section")));
    }
    list
}

/// The branches of one side of a section, and how far the other is from it, where it is drawn \[m\]; none without breadth.
fn branches(plane: &[&SpaceCurve], size: f64) -> Option<(Vec<Vec<OutlinePoint>>, Option<f64>)> {
    let slack = FLAT * size;
    let (mut near, mut far): (Vec<Vec<OutlinePoint>>, Vec<Vec<OutlinePoint>>) = (Vec::new(), Vec::new());
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
            side.push(points);
        }
    }
    if near.is_empty() {
        std::mem::swap(&mut near, &mut far);
    } else if !far.is_empty() {
        off = widened(off, deviation(&near, &far));
    }
    (!near.is_empty()).then_some((near, off))
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
