//! Flats and lines of a table as the level chart holds them: flat of side, tangent lines and knuckles along waterlines.

use super::Chart;
use super::monotone::monotone_cubic;
use crate::hull::cell::{Cell, FeatureLine, LineKind};
use crate::hull::offsets::{OffsetTable, StationOffsets};
use crate::units::counted;

/// Half-breadths on the flat of side agree to this \[m\].
const SAME: f64 = 1e-9;

/// A line is level when its heights vary by less than this part of the height of the table.
const LEVEL: f64 = 1e-6;

/// A line runs along a waterline when it covers this part of the length between its outermost offsets.
const COVERS: f64 = 0.9;

/// The flat of side: half-breadth, and the height at which it begins at each of its stations.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FlatOfSide {
    /// Half-breadth \[m\].
    pub(super) half: f64,
    /// (x, z) of its lower edge at successive stations, x rising \[m\].
    pub(super) edge: Vec<[f64; 2]>,
}

impl FlatOfSide {
    /// From the heights that the table gives, from offsets marked as points of a tangent line above which the
    /// half-breadth does not change, and from tangent lines of which all points are as wide. What contradicts the
    /// offsets is left out with a note.
    pub(super) fn new(table: &OffsetTable, notes: &mut Vec<String>) -> Option<Self> {
        let mut order: Vec<&StationOffsets> = table.stations.iter().filter(|s| s.station.x.is_finite()).collect();
        order.sort_by(|a, b| a.station.x.total_cmp(&b.station.x));
        let starts: Vec<Option<f64>> = order.iter().map(|s| start(table, s)).collect();
        let above = |k: usize, from: f64| {
            order[k].half_breadths.iter().zip(&table.waterlines).filter(move |(_, z)| **z >= from - SAME)
        };
        let mut wide: Vec<f64> = (0..order.len())
            .filter_map(|k| Some((k, starts[k]?)))
            .flat_map(|(k, z)| above(k, z).filter_map(|(c, _)| c.value()))
            .collect();
        wide.sort_by(f64::total_cmp);
        // Half of B where offsets are that, else what most offsets on the flat are.
        let count = |y: f64| wide.iter().filter(|w| (*w - y).abs() <= SAME).count();
        let stated = table.stated.breadth.map(|b| 0.5 * b);
        let most = wide.iter().copied().max_by_key(|&y| count(y));
        let half = stated.filter(|&y| wide.is_empty() || count(y) > 0).or(most)?;
        if starts.iter().all(Option::is_none) {
            return None;
        }
        let mut contradicted = Vec::new();
        let mut runs: Vec<Vec<[f64; 2]>> = vec![Vec::new()];
        for (k, start) in starts.iter().enumerate() {
            let Some(z) = *start else {
                runs.push(Vec::new());
                continue;
            };
            if above(k, z).filter_map(|(c, _)| c.value()).any(|y| (y - half).abs() > SAME) {
                contradicted.push(order[k].station.name.clone());
                runs.push(Vec::new());
            } else if let Some(run) = runs.last_mut() {
                run.push([order[k].station.x, z]);
            }
        }
        if !contradicted.is_empty() {
            notes.push(format!(
                "flat of side: offsets of stations {} above its lower edge are not {half:.3} m; it is not followed there",
                contradicted.join(", ")
            ));
        }
        let kept = runs.iter().map(Vec::len).max().unwrap_or(0);
        let others: usize = runs.iter().map(Vec::len).sum::<usize>() - kept;
        if others > 0 {
            notes.push(format!(
                "flat of side: {} apart from the {kept} that follow each other, and only these are used",
                counted(others, "station")
            ));
        }
        let edge = runs.into_iter().find(|run| run.len() == kept)?;
        if edge.len() < 2 {
            notes.push("flat of side: a single station makes no flat between stations".to_owned());
        }
        (edge.len() > 1).then_some(Self { half, edge })
    }

    /// Ends of the flat on the waterline at `z`, aft and fore \[m\]; none where it lies below the flat or meets it at a
    /// point.
    ///
    /// Between two stations the edge is the monotone cubic x(z) through the stations on its side of the lowest one.
    pub(super) fn ends(&self, z: f64) -> Option<[f64; 2]> {
        let lowest = (0..self.edge.len()).min_by(|&a, &b| self.edge[a][1].total_cmp(&self.edge[b][1]))?;
        let end = |side: &mut dyn Iterator<Item = &[f64; 2]>| {
            let mut chain: Vec<(f64, f64)> = Vec::new();
            for &[x, height] in side {
                match chain.last_mut() {
                    // Of a level part the far end.
                    Some(last) if (height - last.0).abs() <= SAME => *last = (last.0, x),
                    Some(last) if height < last.0 => {}
                    _ => chain.push((height, x)),
                }
            }
            (z >= chain.first()?.0 - SAME).then(|| monotone_cubic(&chain, z))
        };
        let aft = end(&mut self.edge[..=lowest].iter().rev())?;
        let fore = end(&mut self.edge[lowest..].iter())?;
        (fore - aft > SAME).then_some([aft, fore])
    }

    /// Level parts of the lower edge: height and ends in x of three or more successive stations at one height.
    pub(super) fn level_parts(&self) -> Vec<(f64, [f64; 2])> {
        let mut parts: Vec<(f64, [f64; 2], usize)> = Vec::new();
        for &[x, z] in &self.edge {
            match parts.last_mut() {
                Some((height, ends, count)) if (z - *height).abs() <= SAME => (ends[1], *count) = (x, *count + 1),
                _ => parts.push((z, [x, x], 1)),
            }
        }
        parts.into_iter().filter(|p| p.2 >= 3).map(|(z, ends, _)| (z, ends)).collect()
    }
}

/// The height at which the flat of side begins at a station.
fn start(table: &OffsetTable, station: &StationOffsets) -> Option<f64> {
    if let Some(z) = station.flat_of_side.filter(|z| z.is_finite()) {
        return Some(z);
    }
    let given: Vec<(f64, f64, bool)> = station
        .half_breadths
        .iter()
        .zip(&table.waterlines)
        .filter_map(|(c, &z)| Some((z, c.value()?, c.marks.tangent)))
        .collect();
    let top = given.last()?.1;
    let marked = given.iter().position(|&(_, y, tangent)| tangent && (y - top).abs() <= SAME);
    if let Some(k) = marked
        && k + 1 < given.len()
        && given[k..].iter().all(|&(_, y, _)| (y - top).abs() <= SAME)
    {
        return Some(given[k].0);
    }
    let line = table.lines.iter().filter(|line| line.kind == LineKind::Tangent && along_side(line));
    line.filter_map(|line| height_at(line, station.station.x)).min_by(f64::total_cmp)
}

/// Whether all points of a line have one half-breadth, and different heights or lengths.
fn along_side(line: &FeatureLine) -> bool {
    line.points.len() > 1
        && line.points[0][1] > 0.0
        && line.points.iter().all(|p| (p[1] - line.points[0][1]).abs() <= SAME)
}

/// The height of a line at `x`, straight from point to point.
fn height_at(line: &FeatureLine, x: f64) -> Option<f64> {
    let pair = line.points.windows(2).find(|w| w[0][0] <= x && x <= w[1][0] && w[1][0] > w[0][0])?;
    Some(pair[0][2] + (x - pair[0][0]) / (pair[1][0] - pair[0][0]) * (pair[1][2] - pair[0][2]))
}

/// Whether the waterline `j` is a line of the given kind: more than half of its offsets are marked so, or a level line
/// of the table runs along it.
pub(super) fn runs_along(table: &OffsetTable, j: usize, kind: LineKind) -> bool {
    let cells: Vec<(f64, &Cell)> = table
        .stations
        .iter()
        .filter_map(|s| s.half_breadths.get(j).filter(|c| c.value().is_some()).map(|c| (s.station.x, c)))
        .collect();
    let is = |cell: &Cell| if kind == LineKind::Knuckle { cell.marks.knuckle } else { cell.marks.tangent };
    let marked = cells.iter().filter(|(_, c)| is(c)).count();
    2 * marked > cells.len()
        || table.lines.iter().any(|line| line.kind == kind && level_on(table, line) == Some(j) && covers(line, &cells))
}

/// Whether a line covers the offsets with breadth of a waterline.
fn covers(line: &FeatureLine, cells: &[(f64, &Cell)]) -> bool {
    let wide = cells.iter().filter(|(_, c)| c.value().is_some_and(|y| y > 0.0)).map(|(x, _)| *x);
    let (low, high) = wide.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    let (first, last) = (line.points[0][0], line.points[line.points.len() - 1][0]);
    high > low && last.min(high) - first.max(low) >= COVERS * (high - low)
}

/// The waterline that a level line lies on.
fn level_on(table: &OffsetTable, line: &FeatureLine) -> Option<usize> {
    let (low, high) = (table.waterlines.first()?, table.waterlines.last()?);
    let slack = LEVEL * (high - low);
    let z = line.points.first()?[2];
    let level = line.points.iter().all(|p| (p[2] - z).abs() <= slack);
    if level { table.waterlines.iter().position(|own| (own - z).abs() <= slack) } else { None }
}

/// Whether every knuckle off the centreplane runs along a waterline, so that the level chart has it as a line.
pub(super) fn knuckles_are_level(table: &OffsetTable) -> bool {
    let wide = |line: &&FeatureLine| line.kind == LineKind::Knuckle && line.points.iter().any(|p| p[1] > 0.0);
    let along: Vec<bool> = (0..table.waterlines.len()).map(|j| runs_along(table, j, LineKind::Knuckle)).collect();
    table.lines.iter().filter(wide).all(|line| level_on(table, line).is_some_and(|j| along[j]))
        && table.stations.iter().all(|station| {
            station.half_breadths.iter().enumerate().all(|(j, c)| !c.marks.knuckle || along.get(j) == Some(&true))
                && station.outlines.iter().flatten().all(|p| !p.marks.knuckle)
                && station.heights.iter().all(|c| !c.marks.knuckle)
        })
}

/// What the level chart does not follow of the lines and heights of a table, in words.
pub(super) fn unused(table: &OffsetTable, flat: Option<&FlatOfSide>, notes: &mut Vec<String>) {
    let flat_lines = |line: &FeatureLine| flat.is_some() && along_side(line);
    for line in table.lines.iter().filter(|l| l.kind == LineKind::Tangent && l.points.iter().any(|p| p[1] > 0.0)) {
        if !flat_lines(line) && !level_on(table, line).is_some_and(|j| runs_along(table, j, LineKind::Tangent)) {
            notes.push(format!(
                "tangent line {} is neither level nor the edge of the flat of side: the surface is smooth across it",
                line.name
            ));
        }
    }
    let on_edge = |x: f64| flat.is_some_and(|f| f.edge.iter().any(|e| (e[0] - x).abs() <= SAME));
    let single =
        table.stations.iter().filter(|s| !on_edge(s.station.x)).flat_map(|s| s.half_breadths.iter().enumerate());
    let count = single.filter(|(j, c)| c.marks.tangent && !runs_along(table, *j, LineKind::Tangent)).count();
    if count > 0 {
        notes.push(format!(
            "{} marked as points of a tangent line, but neither on a waterline of such nor below a flat of side: such marks were not used",
            counted(count, "offset")
        ));
    }
}

/// What the chart does not hold of a table, in words: the camber of the deck, and on an upright chart a transom that
/// rakes.
pub(super) fn not_held(table: &OffsetTable, chart: Chart) -> Vec<String> {
    let mut notes = Vec::new();
    let cambered = |s: &&StationOffsets| {
        s.deck_centre_height.is_some_and(|centre| s.deck_height.is_none_or(|side| (centre - side).abs() > SAME))
    };
    let count = table.stations.iter().filter(cambered).count();
    if count > 0 {
        notes.push(format!(
            "heights of the deck on the centreline are given at {}: the body ends level at the deck at side, camber is no part of it",
            counted(count, "station")
        ));
    }
    if let (Chart::Upright, Some(plane)) = (chart, table.transom) {
        let aft = table.stations.iter().map(|s| s.station.x).fold(f64::INFINITY, f64::min);
        let upright = plane.slope.abs() <= SAME && (plane.x_base - aft).abs() <= SAME * (1.0 + aft.abs());
        if !upright {
            notes.push(format!(
                "the transom of the table (x = {:.3} {:+.4} z) is not held by a chart of upright stations: the hull ends at its aftmost one",
                plane.x_base, plane.slope
            ));
        }
    }
    notes
}
