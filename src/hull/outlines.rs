//! The sections of a hull as lines of points, for programs that take nothing else.

use super::cell::{Marks, OutlinePoint};
use super::form::Hull;
use super::offsets::{OffsetStation, OffsetTable, StationNumbers, StationOffsets, default_stations};
use super::section::{Cut, Face};

/// Ends of pieces of a section that are as near as this part of the breadth are one point.
const SAME: f64 = 1e-7;

/// Points as near to the centreplane as this part of the breadth are on it where a section begins.
const CENTREPLANE: f64 = 1e-6;

/// Places on each end of the profile at which there is a section, from its lowest to its highest point.
const PROFILE: usize = 5;

/// Sections nearer to each other than this part of the length are one.
const APART: f64 = 2e-3;

/// Stations of the sections of a hull: the default ones, and between and beyond them places along the stem and the
/// stern profile, so that raked ends are not cut short.
#[must_use]
pub fn section_stations(hull: &Hull) -> Vec<OffsetStation> {
    let mut stations = default_stations(hull, StationNumbers::default());
    let apart = APART * hull.particulars().length_between_perpendiculars;
    let ((aft, fore), (low, high)) = (hull.surface().u().domain(), hull.surface().v().domain());
    for u in [aft, fore] {
        for k in 0..PROFILE {
            let v = low + (high - low) * k as f64 / (PROFILE - 1) as f64;
            let x = hull.surface().eval(u, v)[0];
            if stations.iter().all(|station| (station.x - x).abs() > apart) {
                stations.push(OffsetStation { name: format!("{x:.3}"), x });
            }
        }
    }
    stations.sort_by(|a, b| a.x.total_cmp(&b.x));
    stations
}

impl OffsetTable {
    /// The sections at the given stations as points from the centreplane below to the deck at side, so dense that the
    /// lines between them leave the sections by at most `deviation` \[m\]; a branch for each piece that does not hang
    /// together. Stations at which the hull has no breadth are left out.
    #[must_use]
    pub fn of_sections(hull: &Hull, stations: &[OffsetStation], deviation: f64) -> Self {
        let p = hull.particulars();
        let stations = stations
            .iter()
            .map(|station| StationOffsets {
                outlines: outlines(hull, station.x, deviation),
                ..StationOffsets::new(station.name.clone(), station.x)
            })
            .filter(|station| station.outlines.iter().flatten().any(|point| point.y > SAME * p.breadth))
            .collect();
        Self { name: hull.name().to_owned(), stated: p.into(), stations, ..Self::default() }
    }
}

/// The branches of the section at `x`.
fn outlines(hull: &Hull, x: f64, deviation: f64) -> Vec<Vec<OutlinePoint>> {
    let slack = SAME * hull.particulars().breadth;
    let section = hull.section(Cut::Station { x }, 1e-9);
    let mut pieces: Vec<Vec<[f64; 2]>> = section
        .branches
        .iter()
        .filter(|branch| matches!(branch.face, Face::Side | Face::Bottom))
        .map(|branch| {
            let points = branch.polyline(deviation).into_iter();
            points.map(|[_, y, z]| [if y.abs() <= slack { 0.0 } else { y.max(0.0) }, z]).collect()
        })
        .filter(|line: &Vec<[f64; 2]>| line.len() > 1)
        .collect();
    // From below, the bottom before the side that begins at its edge.
    pieces.sort_by(|a, b| a[0][1].total_cmp(&b[0][1]).then(a[0][0].total_cmp(&b[0][0])));
    let mut lines: Vec<Vec<[f64; 2]>> = Vec::new();
    for piece in pieces {
        let near = |a: [f64; 2]| (a[0] - piece[0][0]).abs() <= slack && (a[1] - piece[0][1]).abs() <= slack;
        match lines.last_mut().filter(|line| near(line[line.len() - 1])) {
            Some(line) => line.extend_from_slice(&piece[1..]),
            None => lines.push(piece),
        }
    }
    let near = CENTREPLANE * hull.particulars().breadth;
    lines.iter_mut().for_each(|line| begin_at_lowest(line, near));
    let extends = |line: &Vec<[f64; 2]>| line.iter().any(|p| (p[0] - line[0][0]).hypot(p[1] - line[0][1]) > slack);
    lines.retain(extends);
    let point = |[y, z]: [f64; 2]| OutlinePoint { y, z, marks: Marks::default() };
    lines.into_iter().map(|line| line.into_iter().map(point).collect()).collect()
}

/// Takes off the points along the centreplane from which a line first falls: beside the keel the surface may be beyond
/// the centreplane by as much as its fit leaves.
fn begin_at_lowest(line: &mut Vec<[f64; 2]>, near: f64) {
    let falls = |pair: &[[f64; 2]]| pair[0][0] <= near && pair[1][0] <= near && pair[1][1] <= pair[0][1];
    let count = line.windows(2).take_while(|pair| falls(pair)).count();
    if count > 0 {
        line.drain(..count);
        line[0][0] = 0.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_section_begins_where_it_rises() {
        let mut line = vec![[0.0, 0.02], [0.0, 0.01], [4e-6, 0.0], [1.0, 0.0], [2.0, 3.0]];
        begin_at_lowest(&mut line, 1e-5);
        assert_eq!(line, [[0.0, 0.0], [1.0, 0.0], [2.0, 3.0]]);
        // Hollow bottoms and skegs stay.
        for kept in [vec![[0.0, 1.0], [1.0, 0.5], [2.0, 3.0]], vec![[0.0, 0.0], [0.0, 1.0], [2.0, 3.0]]] {
            let mut line = kept.clone();
            begin_at_lowest(&mut line, 1e-5);
            assert_eq!(line, kept);
        }
    }
}
