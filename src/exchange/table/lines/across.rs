//! Curves at one x as sections: pieces whose ends meet are one line, and of two sides one is taken.

use std::collections::BTreeSet;

use super::super::body::{SEAM, joined};
use super::super::outline::{Deck, deviation, point, take_off_deck};
use super::super::problem::Problems;
use super::super::sections::{Section, note_asymmetry, starboard_of};
use super::{FLAT, SpaceCurve};
use crate::hull::{MeshLine, OutlinePoint};
use crate::units::counted;

/// Curves at one x at most.
const MOST_PIECES: usize = 2_000;

/// Two sides are alike where they differ by no more than this part of the size of the hull.
const ALIKE: f64 = 1e-5;

/// The sections at rising x, of a hull of this size \[m\].
pub(super) fn sections(lines: &[&SpaceCurve], size: f64, problems: &mut Problems) -> Vec<Section> {
    let slack = FLAT * size;
    let mut sorted = lines.to_vec();
    sorted.sort_by(|a, b| a.points[0][0].total_cmp(&b.points[0][0]));
    let (mut list, mut gaps): (Vec<Section>, Vec<(f64, f64)>) = (Vec::new(), Vec::new());
    for plane in sorted.chunk_by(|a, b| b.points[0][0] - a.points[0][0] <= slack) {
        let first = plane[0];
        let x = first.points[0][0];
        if plane.len() > MOST_PIECES {
            let message = format!("{} at x = {x:.3} m, expected at most {MOST_PIECES}", counted(plane.len(), "curve"));
            problems.error("E312", first.place(), message, "Draw each section as one polyline");
            return Vec::new();
        }
        let Some((mut branches, gap)) = branches(plane, size) else { continue };
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
    let mut apart: Option<f64> = None;
    let widened = |apart: Option<f64>, gap: f64| Some(apart.map_or(gap, |apart| apart.max(gap)));
    for line in joined(pieces(plane, slack), SEAM * size) {
        let points: Vec<OutlinePoint> = line.points.iter().map(|&[y, z]| point(y, z)).collect();
        let has = |sign: f64| points.iter().any(|p| sign * p.y > slack);
        let sides = [1.0, -1.0].map(has);
        if sides == [true; 2] || line.closed {
            if let Some((found, gap)) = starboard_of(&points) {
                near.extend(found);
                if sides == [true; 2] {
                    apart = widened(apart, gap);
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
        apart = widened(apart, deviation(&near, &far));
    }
    (!near.is_empty()).then_some((near, apart))
}

/// The curves of a plane, each once.
fn pieces(plane: &[&SpaceCurve], slack: f64) -> Vec<MeshLine> {
    let mut known = BTreeSet::new();
    let mut list = Vec::new();
    for line in plane {
        let mut points: Vec<[f64; 2]> = line.points.iter().map(|&[_, y, z]| [y, z]).collect();
        let cell = |[y, z]: [f64; 2]| [y, z].map(|c| (c / (4.0 * slack)).round() as i64);
        let (first, last) = (points[0], points[points.len() - 1]);
        let closed = points.len() > 3 && (first[0] - last[0]).hypot(first[1] - last[1]) <= slack;
        let mut ends = [cell(first), cell(last)];
        ends.sort_unstable();
        let middle = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / points.len() as f64);
        if !known.insert((ends, cell(middle), points.len())) {
            continue;
        }
        if closed {
            points.pop();
        }
        list.push(MeshLine { points, closed });
    }
    list
}
