//! The curves of a CAD file without surfaces (IGES, entities 126 and 110) as a table: those at one x are sections;
//! where there are none, those at one height are waterlines.
//!
//! Units, axes and origin are found as those of bodies are. Curves on the side y < 0 are mirrored; curves of both sides
//! are cut at the centreplane. Several curves at one x are branches of one section. Of waterlines sections are made at
//! x = x_a + L (1 - cos(pi k/n))/2, straight between them. All other curves (profiles, deck lines, chines in space) are
//! left out, with a note.

use std::f64::consts::PI;

use super::super::cad::{CadCurve, CadSurfaces, is_iges, read_iges};
use super::body::frame::{Given, Placement};
use super::outline::point;
use super::problem::{FilePosition, Problems};
use super::sections::{Body, Section, XOrigin, note_asymmetry, starboard_of, table};
use super::settings::Settings;
use super::{ReadTable, TableProblem, sidecar};
use crate::hull::OutlinePoint;
use crate::units::counted;

/// A curve whose extent in a direction is less than this part of the size is in a plane across it; planes nearer to
/// each other are one.
const FLAT: f64 = 1e-6;

/// Fewer waterlines make no sections.
const LEAST_WATERLINES: usize = 3;

/// Spaces between sections that are made of waterlines.
const SECTIONS: usize = 40;

/// A curve in the ship's frame.
struct SpaceCurve {
    row: usize,
    points: Vec<[f64; 3]>,
}

impl SpaceCurve {
    fn range(&self, axis: usize) -> [f64; 2] {
        let values = self.points.iter().map(|point| point[axis]);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(v), b.max(v)])
    }

    fn is_flat(&self, axis: usize, slack: f64) -> bool {
        let [least, greatest] = self.range(axis);
        greatest - least <= slack
    }
}

/// The table of a CAD file of curves, with the conventions beside it; none when it is no such file, or has surfaces.
pub(super) fn read(name: &str, bytes: &[u8], sidecar: &[(&str, &str)]) -> Option<Result<ReadTable, Vec<TableProblem>>> {
    if !is_iges(bytes) {
        return None;
    }
    let CadSurfaces { surfaces, unit, curves, notes, body, unread } = read_iges(bytes).ok()?;
    if !surfaces.is_empty() || !body.faces.is_empty() || !unread.is_empty() || curves.is_empty() {
        return None;
    }
    let mut problems = Problems::new(name);
    let mut settings = Settings::default();
    for (name, text) in sidecar {
        sidecar::read(name, text, &mut settings, &mut problems);
    }
    notes.into_iter().for_each(|note| problems.warning("W352", FilePosition::FILE, note, ""));
    let unit = unit.unwrap_or(1.0);
    problems
        .note(format!("{} (IGES) without surfaces; the unit of the file is {unit} m", counted(curves.len(), "curve")));
    let mut lines = Vec::new();
    if !problems.any_errors()
        && let Some(placed) = placed(&curves, &settings, unit, &mut problems)
    {
        lines = placed;
    }
    if problems.any_errors() {
        return Some(Err(problems.finish().err().unwrap_or_default()));
    }
    let sections = sections(&lines, &mut problems);
    problems.decimals = 6;
    let body = Body {
        name: settings.name.unwrap_or_default(),
        stated: settings.stated,
        sections,
        origin: if settings.frame.x_origin.is_some() { XOrigin::AfterPerpendicular } else { XOrigin::Unknown },
        unit: 1.0,
    };
    Some(table(body, problems))
}

/// The curves in the ship's frame.
fn placed(curves: &[CadCurve], settings: &Settings, unit: f64, problems: &mut Problems) -> Option<Vec<SpaceCurve>> {
    let points = || curves.iter().flat_map(|curve| &curve.points);
    let first = *points().next()?;
    let fold =
        |pick: fn(f64, f64) -> f64| points().fold(first, |ends, point| [0, 1, 2].map(|k| pick(ends[k], point[k])));
    let bounds = [fold(f64::min), fold(f64::max)];
    let given = Given::plain(unit);
    let placement = Placement::of(bounds, settings, &given, problems)?;
    let line = |curve: &CadCurve| SpaceCurve {
        row: curve.line,
        points: curve.points.iter().map(|&point| placement.place(point)).collect(),
    };
    Some(curves.iter().map(line).collect())
}

/// Sections of the curves that are such, or of waterlines.
fn sections(lines: &[SpaceCurve], problems: &mut Problems) -> Vec<Section> {
    let size = (0..3)
        .map(|axis| {
            let ranges = lines.iter().map(|line| line.range(axis));
            let [a, b] = ranges.fold([f64::INFINITY, f64::NEG_INFINITY], |p, q| [p[0].min(q[0]), p[1].max(q[1])]);
            b - a
        })
        .fold(0.0, f64::max);
    let slack = FLAT * size;
    let (across, along): (Vec<&SpaceCurve>, Vec<&SpaceCurve>) = lines.iter().partition(|line| line.is_flat(0, slack));
    let (level, others): (Vec<&SpaceCurve>, Vec<&SpaceCurve>) =
        along.iter().copied().partition(|line| line.is_flat(2, slack));
    let mut list = of_sections(&across, slack, problems);
    let mut left = others.len();
    if list.len() >= 2 {
        left += level.len();
    } else {
        let made = of_waterlines(&level, slack, problems);
        if made.is_empty() {
            let message = format!(
                "{}: {} at one x, {} at one height; sections at two x at least, or {LEAST_WATERLINES} waterlines, make \
                 a table",
                counted(lines.len(), "curve"),
                across.len(),
                level.len()
            );
            let place = lines.first().map_or(FilePosition::FILE, |line| FilePosition::row(line.row));
            problems.error("E328", place, message, "Give surfaces, or curves in such planes.");
        } else {
            list = made;
        }
    }
    if left > 0 && !list.is_empty() {
        let message = format!("left out: {}, in no plane of a section", counted(left, "curve"));
        problems.warning("W332", FilePosition::FILE, message, "");
    }
    list
}

fn of_sections(lines: &[&SpaceCurve], slack: f64, problems: &mut Problems) -> Vec<Section> {
    let mut sorted = lines.to_vec();
    sorted.sort_by(|a, b| a.points[0][0].total_cmp(&b.points[0][0]));
    let (mut list, mut gaps): (Vec<Section>, Vec<(f64, f64)>) = (Vec::new(), Vec::new());
    for line in sorted {
        let x = line.points[0][0];
        let points: Vec<OutlinePoint> = line.points.iter().map(|&[_, y, z]| point(y, z)).collect();
        let (negative, positive) = (points.iter().any(|p| p.y < -slack), points.iter().any(|p| p.y > slack));
        let mut branches: Vec<Vec<OutlinePoint>> = if negative && positive {
            match starboard_of(&points) {
                Some((branches, gap)) => {
                    gaps.push((gap, x));
                    branches
                }
                None => Vec::new(),
            }
        } else if negative || positive {
            vec![points.into_iter().map(|p| point(p.y.abs(), p.z)).collect()]
        } else {
            Vec::new()
        };
        for branch in &mut branches {
            if branch[0].z > branch[branch.len() - 1].z {
                branch.reverse();
            }
        }
        match list.last_mut().filter(|section| (section.x - x).abs() <= slack) {
            // The other side of a section that is there already says nothing new.
            Some(section) if negative && !positive && !section.branches.is_empty() => {}
            Some(section) => section.branches.extend(branches),
            None => list.push(Section { name: None, x, place: FilePosition::row(line.row), branches, deck: None }),
        }
    }
    list.retain(|section| !section.branches.is_empty());
    for section in &mut list {
        section.branches.sort_by(|a, b| a[0].z.total_cmp(&b[0].z));
    }
    note_asymmetry(&gaps, problems);
    list
}

/// The greatest half-breadth of a waterline at x.
fn breadth(line: &SpaceCurve, x: f64) -> Option<f64> {
    line.points
        .windows(2)
        .filter_map(|pair| {
            let ([a, y, _], [b, w, _]) = (pair[0], pair[1]);
            let (low, high) = (a.min(b), a.max(b));
            let share = if high > low { (x - a) / (b - a) } else { 0.0 };
            (low <= x && x <= high).then(|| (y + share * (w - y)).abs())
        })
        .max_by(f64::total_cmp)
}

fn of_waterlines(lines: &[&SpaceCurve], slack: f64, problems: &mut Problems) -> Vec<Section> {
    let mut heights: Vec<(f64, Vec<&SpaceCurve>)> = Vec::new();
    let mut sorted = lines.to_vec();
    sorted.sort_by(|a, b| a.points[0][2].total_cmp(&b.points[0][2]));
    for line in sorted {
        let z = line.points[0][2];
        match heights.last_mut().filter(|(height, _)| (height - z).abs() <= slack) {
            Some((_, list)) => list.push(line),
            None => heights.push((z, vec![line])),
        }
    }
    if heights.len() < LEAST_WATERLINES {
        return Vec::new();
    }
    let ranges = lines.iter().map(|line| line.range(0));
    let [aft, fore] = ranges.fold([f64::INFINITY, f64::NEG_INFINITY], |p, q| [p[0].min(q[0]), p[1].max(q[1])]);
    let message =
        format!("{} waterlines: sections at {} x are made of straight lines between them", heights.len(), SECTIONS + 1);
    problems.warning("W334", FilePosition::FILE, message, "");
    let sections = (0..=SECTIONS).map(|k| {
        let x = aft + 0.5 * (fore - aft) * (1.0 - (PI * k as f64 / SECTIONS as f64).cos());
        let at = |(z, list): &(f64, Vec<&SpaceCurve>)| {
            let y = list.iter().filter_map(|line| breadth(line, x)).max_by(f64::total_cmp)?;
            Some(point(y, *z))
        };
        let branch: Vec<OutlinePoint> = heights.iter().filter_map(at).collect();
        Section { name: None, x, place: FilePosition::FILE, branches: vec![branch], deck: None }
    });
    sections
        .filter(|section| section.branches[0].len() > 1 && section.branches[0].iter().any(|p| p.y > slack))
        .collect()
}

#[cfg(test)]
mod tests;
