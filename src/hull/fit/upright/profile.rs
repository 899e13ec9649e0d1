//! The section of each station as heights with half-breadths, from keel to upper edge.
//!
//! Half-breadths at waterlines, heights at buttocks, points of outlines, keel, flat of bottom and deck at side are put
//! into one sequence of rising heights. A horizontal line at the bottom leaves its outermost point (the flat of bottom
//! is implied by it); one further up cannot be told by y(z) and leaves its outermost point too, with a note. Blank
//! cells between two values are water between two branches of the section (bulb and flare): there the surface lies on
//! the centreplane.

use crate::hull::OffsetTable;
use crate::hull::cell::{Entry, LineKind, Marks, OutlinePoint};
use crate::hull::offsets::StationOffsets;

/// A point of a section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::hull::fit) struct SectionPoint {
    /// Height \[m\].
    pub(in crate::hull::fit) z: f64,
    /// Half-breadth \[m\]; none at an upper edge whose breadth is not given.
    pub(in crate::hull::fit) y: Option<f64>,
    /// The point is marked as one of a knuckle or of a tangent line.
    pub(in crate::hull::fit) mark: Option<LineKind>,
}

/// What the marks of a cell or point say.
fn marked(marks: Marks) -> Option<LineKind> {
    match (marks.knuckle, marks.tangent) {
        (true, _) => Some(LineKind::Knuckle),
        (false, true) => Some(LineKind::Tangent),
        (false, false) => None,
    }
}

impl SectionPoint {
    fn new(z: f64, y: f64, mark: Option<LineKind>) -> Self {
        Self { z, y: Some(y), mark }
    }
}

/// A section.
#[derive(Debug, Clone)]
pub(in crate::hull::fit) struct Profile {
    /// Position forward of AP \[m\].
    pub(in crate::hull::fit) x: f64,
    /// Index of the station in the table; none for an end of the hull that is no station.
    pub(in crate::hull::fit) station: Option<usize>,
    /// Points, heights rising; the first is on the keel line and the last on the upper edge. One point only where the
    /// section shrinks to a point.
    pub(in crate::hull::fit) points: Vec<SectionPoint>,
}

impl Profile {
    /// Height of the keel line \[m\].
    pub(in crate::hull::fit) fn keel(&self) -> f64 {
        self.points[0].z
    }

    /// Height of the upper edge \[m\].
    pub(in crate::hull::fit) fn top(&self) -> f64 {
        self.points[self.points.len() - 1].z
    }

    /// The greatest half-breadth \[m\].
    pub(in crate::hull::fit) fn breadth(&self) -> f64 {
        self.points.iter().filter_map(|p| p.y).fold(0.0, f64::max)
    }
}

/// Whether sections beside each other have level or falling parts above the bottom, which a half-breadth over the height cannot
/// follow. That of one section alone is an error of its drawing: a hollow of 3 mm in one of 20 made a hull of corners.
pub(in crate::hull::fit) fn has_ledges(table: &OffsetTable) -> bool {
    let is_ledged = |station| section(table, station).is_some_and(|(_, ledge, _)| ledge);
    table.stations.windows(2).any(|pair| pair.iter().all(is_ledged))
}

/// The sections of a table in order of x; stations without any offset are left out with a note.
pub(super) fn profiles(table: &OffsetTable, notes: &mut Vec<String>) -> Vec<Profile> {
    let mut result: Vec<Profile> = Vec::new();
    let mut guessed = Vec::new();
    let mut ledges = Vec::new();
    for (index, station) in table.stations.iter().enumerate() {
        let name = &station.station.name;
        let Some((points, ledge, guess)) = section(table, station) else {
            notes.push(format!("station {name} has no offsets and was left out"));
            continue;
        };
        if ledge {
            ledges.push(name.clone());
        }
        if guess {
            guessed.push(name.clone());
        }
        result.push(Profile { x: station.station.x, station: Some(index), points });
    }
    if !guessed.is_empty() {
        notes.push(format!(
            "no keel height is given at stations {}: the section was carried on as a parabola to the centreplane",
            guessed.join(", ")
        ));
    }
    if !ledges.is_empty() {
        notes.push(format!(
            "stations {} have level or falling parts above the bottom: their outermost points were used",
            ledges.join(", ")
        ));
    }
    result.sort_by(|a, b| a.x.total_cmp(&b.x));
    result.dedup_by(|b, a| (a.x - b.x).abs() <= 0.0);
    result
}

/// The points of a station; whether level parts were dropped; whether the keel was guessed.
fn section(table: &OffsetTable, station: &StationOffsets) -> Option<(Vec<SectionPoint>, bool, bool)> {
    let mut points: Vec<SectionPoint> = Vec::new();
    for (cell, &z) in station.half_breadths.iter().zip(&table.waterlines) {
        if let Some(y) = cell.value() {
            points.push(SectionPoint::new(z, y, marked(cell.marks)));
        }
    }
    for (cell, &y) in station.heights.iter().zip(&table.buttocks) {
        if let Some(z) = cell.value()
            && y > 0.0
        {
            points.push(SectionPoint::new(z, y, marked(cell.marks)));
        }
    }
    let mut ledge = false;
    let mut branches: Vec<Vec<SectionPoint>> = station.outlines.iter().map(|line| rising(line, &mut ledge)).collect();
    branches.retain(|branch| !branch.is_empty());
    branches.sort_by(|a, b| a[0].z.total_cmp(&b[0].z));
    for k in 1..branches.len() {
        let (below, above) = (branches[k - 1][branches[k - 1].len() - 1].z, branches[k][0].z);
        points.extend([0.25, 0.5, 0.75].map(|f| SectionPoint::new(below + f * (above - below), 0.0, None)));
    }
    points.extend(branches.into_iter().flatten());
    if let Some(z) = station.deck_height {
        points.push(SectionPoint { z, y: station.deck_half_breadth, mark: None });
    }
    points.sort_by(|a, b| a.z.total_cmp(&b.z));
    let (low, high) = (points.first()?.z, points.last()?.z);
    if station.outlines.is_empty() {
        close_gaps(table, station, [low, high], &mut points);
    }
    let guess = match station.keel_height {
        Some(z) if z <= low => {
            // A flat of bottom belongs to the keel height where the table says so.
            points.insert(0, SectionPoint::new(z, station.flat_of_bottom.unwrap_or(0.0).max(0.0), None));
            false
        }
        Some(_) => false,
        None => guess_keel(table, station, &mut points),
    };
    points.sort_by(|a, b| a.z.total_cmp(&b.z));
    let slack = 1e-9 * (1.0 + high.abs().max(low.abs()));
    let mut merged: Vec<SectionPoint> = Vec::new();
    for point in points {
        let on_keel = merged.len() == 1;
        match merged.last_mut() {
            Some(last) if point.z - last.z <= slack => {
                let (a, b) = (last.y, point.y);
                if let (Some(a), Some(b)) = (a, b)
                    && (a - b).abs() > slack
                    && !on_keel
                {
                    ledge = true;
                }
                last.y = match (a, b) {
                    (Some(a), Some(b)) => Some(a.max(b)),
                    (a, b) => a.or(b),
                };
                last.mark = last.mark.or(point.mark);
            }
            _ => merged.push(point),
        }
    }
    let width = merged.iter().filter_map(|p| p.y).fold(0.0, f64::max);
    if merged[0].y.is_none() {
        merged[0].y = Some(0.0);
    }
    (merged.len() > 1 || width > 0.0 || station.keel_height.is_some()).then_some((merged, ledge, guess))
}

/// The points of an outline from the keel up, as far as heights rise; level starts leave their outermost point.
fn rising(line: &[OutlinePoint], ledge: &mut bool) -> Vec<SectionPoint> {
    let downward = matches!((line.first(), line.last()), (Some(a), Some(b)) if a.z > b.z);
    let ordered: Vec<&OutlinePoint> = if downward { line.iter().rev().collect() } else { line.iter().collect() };
    let mut result: Vec<SectionPoint> = Vec::new();
    let count = ordered.len();
    for (k, point) in ordered.into_iter().enumerate() {
        let new = SectionPoint::new(point.z, point.y, marked(point.marks));
        match result.last().copied() {
            Some(last) if point.z <= last.z => {
                let last_y = last.y.unwrap_or(0.0);
                // The way out along a flat bottom, or the way in along a deck.
                let bottom = result.len() == 1 && (last.z - point.z).abs() <= 0.0;
                let deck = k + 1 == count && point.y < last_y;
                if point.y > last_y && (result.len() == 1 || (last.z - point.z).abs() <= 0.0) {
                    let end = result.len() - 1;
                    result[end] = SectionPoint { z: if bottom { point.z } else { last.z }, ..new };
                }
                *ledge |= !bottom && !deck;
            }
            _ => result.push(new),
        }
    }
    result
}

/// Blank cells between two values: the surface lies on the centreplane between two branches.
fn close_gaps(table: &OffsetTable, station: &StationOffsets, [low, high]: [f64; 2], points: &mut Vec<SectionPoint>) {
    let given: Vec<f64> = station
        .half_breadths
        .iter()
        .zip(&table.waterlines)
        .filter(|(cell, _)| cell.value().is_some())
        .map(|(_, &z)| z)
        .collect();
    let (Some(&first), Some(&last)) = (given.first(), given.last()) else { return };
    for (cell, &z) in station.half_breadths.iter().zip(&table.waterlines) {
        if cell.entry == Entry::Absent && z > first.max(low) && z < last.min(high) {
            points.push(SectionPoint::new(z, 0.0, None));
        }
    }
    points.sort_by(|a, b| a.z.total_cmp(&b.z));
}

/// Finds the keel of a section without one: at its lowest point when that is on the centreplane or on the lowest
/// waterline; from the ends of the waterlines; else where the parabola y^2 through the two lowest points meets the
/// centreplane, not below the waterline under them. True when it was guessed.
fn guess_keel(table: &OffsetTable, station: &StationOffsets, points: &mut Vec<SectionPoint>) -> bool {
    let x = station.station.x;
    let first = points[0];
    let width = points.iter().filter_map(|p| p.y).fold(0.0, f64::max);
    if first.y.unwrap_or(0.0) <= 1e-9 * width || !station.outlines.is_empty() {
        return false;
    }
    let below = table.waterlines.iter().copied().filter(|&z| z < first.z).fold(f64::NEG_INFINITY, f64::max);
    if below.is_infinite() {
        return false;
    }
    // The profile: the first waterline, from below, that reaches the station.
    let ends: Vec<(f64, [f64; 2])> = table
        .waterlines
        .iter()
        .zip(&table.endings)
        .filter_map(|(&z, &[a, b])| Some((z, [a?, b?])))
        .filter(|(z, _)| *z <= first.z)
        .collect();
    for pair in ends.windows(2) {
        let ((z0, [a0, b0]), (z1, [a1, b1])) = (pair[0], pair[1]);
        for (from, to) in [(a0, a1), (b0, b1)] {
            let inside = (from - x) * (to - x) <= 0.0 && (from - to).abs() > 0.0 && !(a0..=b0).contains(&x);
            if inside {
                points.insert(0, SectionPoint::new(z0 + (z1 - z0) * (x - from) / (to - from), 0.0, None));
                return false;
            }
        }
    }
    let second = points.get(1).copied().unwrap_or(first);
    let (y0, y1) = (first.y.unwrap_or(0.0), second.y.unwrap_or(0.0));
    let drop = if y1 > y0 { y0 * y0 * (second.z - first.z) / (y1 * y1 - y0 * y0) } else { 0.5 * (first.z - below) };
    points.insert(0, SectionPoint::new(first.z - drop.min(0.999 * (first.z - below)), 0.0, None));
    true
}
