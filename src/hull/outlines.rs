//! The sections of a hull as lines of points, for programs that take nothing else.

use super::area::SectionalAreaCurve;
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

/// Lines of the surface whose ends are looked at for the ends of the hull.
const LINES: usize = 32;

/// Sections nearer to each other than this part of the length are one.
const APART: f64 = 2e-3;

/// What the volume between the sections is off by at most, over that of the hull, where linear areas are taken between them.
const VOLUME: f64 = 5e-4;

/// Most sections, and most rounds in which some are added.
const MOST: usize = 400;
const ROUNDS: usize = 12;

/// Stations of the sections of a hull: the default ones, and between and beyond them places along the stem and the
/// stern profile and wherever the areas up to one of the `heights` \[m\] turn, so that nothing of the hull is cut off.
#[must_use]
pub fn section_stations(hull: &Hull, heights: &[f64]) -> Vec<OffsetStation> {
    let [aft, fore] = extent(hull);
    let default = default_stations(hull, StationNumbers::default());
    let mut stations: Vec<OffsetStation> =
        default.into_iter().filter(|station| (aft..=fore).contains(&station.x)).collect();
    let apart = APART * (fore - aft);
    let (us, (low, high)) = (hull.surface().u().domain(), hull.surface().v().domain());
    let profile = [us.0, us.1].into_iter().flat_map(|u| {
        (0..PROFILE).map(move |k| hull.surface().eval(u, low + (high - low) * k as f64 / (PROFILE - 1) as f64)[0])
    });
    for x in profile.chain([aft, fore]) {
        if stations.iter().all(|station| (station.x - x).abs() > apart) {
            stations.push(OffsetStation { name: format!("{x:.3}"), x });
        }
    }
    stations.sort_by(|a, b| a.x.total_cmp(&b.x));
    for _ in 0..ROUNDS {
        let added = between(hull, heights, &stations);
        if added.is_empty() || stations.len() + added.len() > MOST {
            break;
        }
        stations.extend(added.into_iter().map(|x| OffsetStation { name: format!("{x:.3}"), x }));
        stations.sort_by(|a, b| a.x.total_cmp(&b.x));
    }
    stations
}

/// Least and greatest x of a hull \[m\], by the points of its surface on lines of its parameters.
fn extent(hull: &Hull) -> [f64; 2] {
    let surface = hull.surface();
    let lines = |range: (f64, f64)| (0..=LINES).map(move |k| range.0 + (range.1 - range.0) * k as f64 / LINES as f64);
    let vs: Vec<f64> = surface.v().breakpoints().into_iter().chain(lines(surface.v().domain())).collect();
    let ends = surface.u().domain();
    let xs = [ends.0, ends.1].into_iter().flat_map(|u| vs.iter().map(move |&v| surface.eval(u, v)[0]));
    xs.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}

/// Middles of the spaces between stations in which linear areas are off by more than their part of [`VOLUME`], or at whose
/// outer end the hull has no section.
fn between(hull: &Hull, heights: &[f64], stations: &[OffsetStation]) -> Vec<f64> {
    let xs: Vec<f64> = stations.iter().map(|station| station.x).collect();
    let middles: Vec<f64> = xs.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
    let (at, inside) =
        (SectionalAreaCurve::areas(hull, heights, &xs), SectionalAreaCurve::areas(hull, heights, &middles));
    let mut wanted = vec![false; middles.len()];
    for h in 0..heights.len() {
        let space = |k: usize| {
            let (width, ends) = (xs[k + 1] - xs[k], [at[k][h], at[k + 1][h]]);
            let middle = inside[k][h];
            let outer = k == 0 && ends[0] <= 0.0 || k + 2 == xs.len() && ends[1] <= 0.0;
            let off = 2.0 / 3.0 * width * (middle - 0.5 * (ends[0] + ends[1])).abs();
            let volume = width * (ends[0] + 4.0 * middle + ends[1]) / 6.0;
            [if outer { off + volume } else { off }, volume]
        };
        let spaces: Vec<[f64; 2]> = (0..middles.len()).map(space).collect();
        let volume: f64 = spaces.iter().map(|[_, volume]| volume).sum();
        let off: f64 = spaces.iter().map(|[off, _]| off).sum();
        if off > VOLUME * volume {
            let part = VOLUME * volume / spaces.len() as f64;
            wanted.iter_mut().zip(&spaces).for_each(|(wanted, [off, _])| *wanted |= *off > part);
        }
    }
    middles.into_iter().zip(wanted).filter(|(_, wanted)| *wanted).map(|(x, _)| x).collect()
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
