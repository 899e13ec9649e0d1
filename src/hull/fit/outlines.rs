//! Points of sections beside the surface: what a fit leaves of tables that give sections instead of a grid.
//!
//! Where a section has several points at one height, its greatest half-breadth there counts; between points it is the
//! monotone piecewise cubic (Fritsch & Butland 1984) of y and of z over the chord length.

use super::super::{Hull, Marks, OffsetTable, OutlinePoint, StationOffsets};
use super::monotone::monotone_cubic;
use std::borrow::Cow;

/// Heights that count as one where flats are looked for, over the height of the table.
const CLOSEST: f64 = 1e-3;

/// A piece of a section that rises by less than this part of its way outward is level.
const LEVEL: f64 = 0.05;

/// Points along a section in which crossings are looked for, a chord.
const LOOKS: usize = 8;

fn usable(point: &&OutlinePoint) -> bool {
    point.y.is_finite() && point.z.is_finite()
}

/// Whether the table holds sections as points and no half-breadths.
pub fn only_outlines(table: &OffsetTable) -> bool {
    let cells = table.stations.iter().flat_map(|s| &s.half_breadths).filter(|c| c.value().is_some()).count();
    cells == 0 && table.stations.iter().any(|s| s.outlines.iter().any(|o| o.len() > 1))
}

/// Parts of a straight panel.
const PARTS: usize = 4;

/// The table with more points on its straight panels: a knuckle and the next point, where this is a knuckle or an end, are
/// joined by a straight line.
pub(super) fn with_straight_panels(table: &OffsetTable) -> Cow<'_, OffsetTable> {
    let knuckles = table.stations.iter().flat_map(|s| s.outlines.iter().flatten()).filter(|p| p.marks.knuckle).count();
    if knuckles == 0 {
        return Cow::Borrowed(table);
    }
    let mut table = table.clone();
    for outline in table.stations.iter_mut().flat_map(|station| &mut station.outlines) {
        *outline = with_panels(outline);
    }
    Cow::Owned(table)
}

fn with_panels(outline: &[OutlinePoint]) -> Vec<OutlinePoint> {
    let last = outline.len().saturating_sub(1);
    let is_break = |k: usize| k == 0 || k == last || outline[k].marks.knuckle;
    let mut points = Vec::with_capacity(PARTS * outline.len());
    for (k, pair) in outline.windows(2).enumerate() {
        let [a, b] = [pair[0], pair[1]];
        points.push(a);
        if is_break(k) && is_break(k + 1) && (a.marks.knuckle || b.marks.knuckle) {
            points.extend((1..PARTS).map(|part| {
                let share = part as f64 / PARTS as f64;
                let [y, z] = [a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)];
                OutlinePoint { y, z, marks: Marks::default() }
            }));
        }
    }
    points.extend(outline.last());
    points
}

/// The greatest half-breadth of a branch at height `z`; none where the branch does not reach.
fn half_breadth(branch: &[OutlinePoint], z: f64, slack: f64) -> Option<f64> {
    let mut length = 0.0;
    // y and z over the length along the chords.
    let mut ys: Vec<(f64, f64)> = Vec::new();
    let mut zs: Vec<(f64, f64)> = Vec::new();
    let mut before: Option<&OutlinePoint> = None;
    for point in branch.iter().filter(usable) {
        if let Some(b) = before {
            let chord = (point.y - b.y).hypot(point.z - b.z);
            if chord <= 0.0 {
                continue;
            }
            length += chord;
        }
        ys.push((length, point.y));
        zs.push((length, point.z));
        before = Some(point);
    }
    let at_points = zs.iter().zip(&ys).filter(|(height, _)| (height.1 - z).abs() <= slack).map(|(_, y)| y.1);
    let mut greatest = at_points.fold(f64::NEG_INFINITY, f64::max);
    for pair in zs.windows(2) {
        if (pair[0].1.min(pair[1].1)..=pair[0].1.max(pair[1].1)).contains(&z) {
            let step = (pair[1].0 - pair[0].0) / LOOKS as f64;
            let height = |t: f64| monotone_cubic(&zs, t) - z;
            for k in 0..LOOKS {
                let (mut a, mut b) = (pair[0].0 + step * k as f64, pair[0].0 + step * (k + 1) as f64);
                let rising = height(b) > height(a);
                if height(a) * height(b) > 0.0 {
                    continue;
                }
                for _ in 0..60 {
                    let middle = 0.5 * (a + b);
                    if (height(middle) > 0.0) == rising { b = middle } else { a = middle }
                }
                greatest = greatest.max(monotone_cubic(&ys, 0.5 * (a + b)));
            }
        }
    }
    greatest.is_finite().then_some(greatest.max(0.0))
}

/// A point of a section beside the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointResidual {
    /// Index of the station in the table.
    pub station: usize,
    /// Height of the point \[m\].
    pub height: f64,
    /// Half-breadth of the point \[m\].
    pub given: f64,
    /// Half-breadth of the surface at its height \[m\].
    pub half_breadth: f64,
}

impl PointResidual {
    /// Surface minus table \[m\].
    #[must_use]
    pub fn residual(&self) -> f64 {
        self.half_breadth - self.given
    }
}

/// Whether a point stands on a level piece of its branch: its half-breadth says nothing there.
fn is_level(branch: &[OutlinePoint], k: usize) -> bool {
    let flat = |a: &OutlinePoint, b: &OutlinePoint| (b.z - a.z).abs() <= LEVEL * (b.y - a.y).abs();
    (k > 0 && flat(&branch[k - 1], &branch[k])) || branch.get(k + 1).is_some_and(|next| flat(&branch[k], next))
}

/// The points of the sides of sections, as indices of station, outline and point: the outermost ones at their heights.
/// Points of level pieces and of lines that close a section across are no part of the side.
#[must_use]
pub fn side_points(table: &OffsetTable) -> Vec<[usize; 3]> {
    let mut found = Vec::new();
    for (s, station) in table.stations.iter().enumerate() {
        for (o, branch) in station.outlines.iter().enumerate() {
            for (p, point) in branch.iter().enumerate().filter(|(_, point)| usable(point)) {
                if is_level(branch, p) {
                    continue;
                }
                let widest = station.half_breadth_of_points(point.z).unwrap_or(0.0);
                if point.y >= widest - 1e-6 {
                    found.push([s, o, p]);
                }
            }
        }
    }
    found
}

impl StationOffsets {
    /// The greatest half-breadth of its points at height `z` \[m\]; none where they do not reach.
    #[must_use]
    pub fn half_breadth_of_points(&self, z: f64) -> Option<f64> {
        self.outlines.iter().filter_map(|branch| half_breadth(branch, z, 1e-9)).reduce(f64::max)
    }
}

/// The points of the sides above the bottom of the hull beside it, and the number of all points. Points where the hull does
/// not reach have no residual.
pub(super) fn point_residuals(table: &OffsetTable, hull: &Hull) -> (Vec<PointResidual>, usize) {
    let floor = hull.bottom() + CLOSEST * (hull.top() - hull.bottom());
    let all = table.stations.iter().flat_map(|station| station.outlines.iter().flatten()).filter(usable).count();
    let beside = |[station, o, p]: [usize; 3]| {
        let point = table.stations[station].outlines[o][p];
        let half_breadth = hull.half_breadth(table.stations[station].station.x, point.z).filter(|_| point.z > floor)?;
        Some(PointResidual { station, height: point.z, given: point.y, half_breadth })
    };
    (side_points(table).into_iter().filter_map(beside).collect(), all)
}

/// What is and what is not compared with the points of the sections.
pub(super) fn note(table: &OffsetTable, hull: &Hull) -> String {
    let (list, all) = point_residuals(table, hull);
    format!(
        "sections given as points: {} of {all} points are outermost points of the side and compared with the surface; the others lie on \
         the bottom and other level pieces, inside, or beyond the hull",
        list.len()
    )
}
