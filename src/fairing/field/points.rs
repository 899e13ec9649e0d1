//! Sections that are given as points: the points of their sides as readings of a field, and a table of levels that says
//! where the hull is.
//!
//! A field has one half-breadth at a place (x, z). Points of level pieces and points that others hide say nothing of it.
//! What the sections say at the levels is for ends of waterlines alone; the field is made from the points.

use super::likelihood::Cell;
use super::observed::scale;
use crate::hull::{self, Entry, OffsetTable, StationOffsets, side_points};

/// Fewest and most levels.
const LEVELS: [usize; 2] = [8, 20];

/// Least height of a level above the lowest point, over the height.
const LOWEST: f64 = 5e-3;

/// Heights that are one, over the height.
const SAME: f64 = 1e-6;

/// Half-breadths below this part of the greatest are on the centreplane.
const CENTREPLANE: f64 = 1e-4;

/// The sections of a table.
#[derive(Debug, Clone)]
pub struct Points {
    /// Points of the sides: indices of station, outline and point.
    pub sides: Vec<[usize; 3]>,
    /// The same as readings of the field; those on the base are its keel.
    pub cells: Vec<Cell>,
    /// Half-breadths of the sections at levels, with keel, flat of bottom and deck.
    pub levels: OffsetTable,
}

/// Whether a point of a section is on the centreplane, beside the greatest half-breadth: a keel, and no half-breadth.
#[must_use]
pub fn is_on_centreplane(y: f64, greatest: f64) -> bool {
    y <= CENTREPLANE * greatest
}

impl Points {
    /// Those of a table that has no offsets; none where there are too few. Where the hull goes on beyond the first or the
    /// last section, to `ends` at most \[m\], there are empty sections.
    #[must_use]
    pub fn new(table: &OffsetTable, ends: [f64; 2]) -> Option<Self> {
        let greatest = table.stations.iter().flat_map(|s| s.outlines.iter().flatten()).map(|p| p.y).fold(0.0, f64::max);
        let mut sides = side_points(table);
        sides.retain(|&[s, o, p]| !is_on_centreplane(table.stations[s].outlines[o][p].y, greatest));
        let all = table.stations.iter().flat_map(|station| station.outlines.iter().flatten());
        let [bottom, top] = all.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], p| [a.min(p.z), b.max(p.z)]);
        let height = top - bottom;
        let mut heights: Vec<f64> = sides.iter().map(|&[s, o, p]| table.stations[s].outlines[o][p].z).collect();
        heights.retain(|z| *z >= bottom + LOWEST * height);
        heights.sort_by(f64::total_cmp);
        let stations = table.stations.iter().filter(|station| !station.outlines.is_empty()).count();
        let count = (heights.len() / stations.max(1)).clamp(LEVELS[0], LEVELS[1]);
        if heights.len() < count {
            return None;
        }
        let mut waterlines: Vec<f64> = (0..count).map(|k| heights[k * (heights.len() - 1) / (count - 1)]).collect();
        waterlines.dedup_by(|a, b| *a - *b <= SAME * height);
        let level = |station: &StationOffsets| {
            let mut found = StationOffsets::new(station.station.name.clone(), station.station.x);
            let points = || station.outlines.iter().flatten();
            let lowest = points().min_by(|a, b| a.z.total_cmp(&b.z).then(b.y.total_cmp(&a.y)));
            let highest = points().max_by(|a, b| a.z.total_cmp(&b.z).then(a.y.total_cmp(&b.y)));
            let (Some(lowest), Some(highest)) = (lowest, highest) else { return found };
            let on_lowest = points().filter(|p| p.z - lowest.z <= SAME * height);
            let [least, most] = on_lowest.fold([f64::INFINITY, 0.0], |[a, b], p| [p.y.min(a), p.y.max(b)]);
            // A section that does not reach the centreplane has no keel.
            if is_on_centreplane(least, greatest) || lowest.z - bottom <= LOWEST * height {
                found.keel_height = Some(lowest.z);
                found.flat_of_bottom = Some(most);
            }
            (found.deck_height, found.deck_half_breadth) = (Some(highest.z), Some(highest.y));
            let cell = |&z: &f64| hull::Cell {
                entry: station.half_breadth_of_points(z).map_or(Entry::Absent, Entry::Given),
                ..hull::Cell::default()
            };
            found.half_breadths = waterlines.iter().map(cell).collect();
            found
        };
        let mut stations: Vec<StationOffsets> = table.stations.iter().map(level).collect();
        let [first, last] = [stations.first()?.station.x, stations.last()?.station.x];
        let slack = SAME * (last - first);
        let beyond = |x: f64| StationOffsets {
            half_breadths: vec![hull::Cell::default(); waterlines.len()],
            ..StationOffsets::new("", x)
        };
        if ends[0] < first - slack {
            stations.insert(0, beyond(ends[0]));
        }
        if ends[1] > last + slack {
            stations.push(beyond(ends[1]));
        }
        let levels = OffsetTable {
            name: table.name.clone(),
            stations,
            transom: table.transom,
            waterlines: waterlines.clone(),
            ..OffsetTable::default()
        };
        let cell = |&[s, o, p]: &[usize; 3]| {
            let (station, point) = (&table.stations[s], table.stations[s].outlines[o][p]);
            Cell { x: station.station.x, z: point.z, y: point.y, scale: scale(point.marks) }
        };
        let cells = sides.iter().map(cell).filter(|cell| cell.z > bottom + SAME * height).collect();
        Some(Self { sides, cells, levels })
    }

    /// Volume of the sections below a height, both sides together \[m3\]: by trapezoids up them, and along the ship by the
    /// mean of the two parabolas through three areas that have an interval in common.
    #[must_use]
    pub fn volume(&self, height: f64) -> f64 {
        let area = |station: &StationOffsets| {
            let side = station.half_breadths.iter().zip(&self.levels.waterlines);
            let mut points: Vec<[f64; 2]> = side.filter_map(|(cell, &z)| Some([z, cell.value()?])).collect();
            let ends =
                [(station.keel_height, station.flat_of_bottom), (station.deck_height, station.deck_half_breadth)];
            points.extend(ends.into_iter().filter_map(|(z, y)| Some([z?, y?])));
            let own = self.cells.iter().filter(|cell| (cell.x - station.station.x).abs() < 1e-9);
            points.extend(own.map(|cell| [cell.z, cell.y]));
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let piece = |pair: &[[f64; 2]]| {
                let [[low, a], [high, b]] = [pair[0], pair[1]];
                let part = if high > low { ((height - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
                part * (high - low) * (a + 0.5 * part * (b - a))
            };
            points.windows(2).map(piece).sum::<f64>()
        };
        let areas: Vec<[f64; 2]> = self.levels.stations.iter().map(|s| [s.station.x, area(s)]).collect();
        let bend = |three: &[[f64; 2]]| {
            let slope = |k: usize| (three[k + 1][1] - three[k][1]) / (three[k + 1][0] - three[k][0]);
            (slope(1) - slope(0)) / (three[2][0] - three[0][0])
        };
        let bends: Vec<f64> = areas.windows(3).map(bend).collect();
        let piece = |(k, pair): (usize, &[[f64; 2]])| {
            let length = pair[1][0] - pair[0][0];
            let beside = [k.checked_sub(1).and_then(|k| bends.get(k)), bends.get(k)];
            let (count, sum) = beside.into_iter().flatten().fold((0.0f64, 0.0), |(n, sum), bend| (n + 1.0, sum + bend));
            length * (pair[0][1] + pair[1][1]) - length.powi(3) / 3.0 * sum / count.max(1.0)
        };
        areas.windows(2).enumerate().map(piece).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hull::{Marks, OutlinePoint};

    /// A body with the sections y^2 = 4 b(x)^2 z / 10, b = 1 - (x/10)^2: half of the area up to z = 10 is 40/3 b, and the
    /// volume 2 x 40/3 x 20 x 2/3. The levels have the half-breadths of the points, to the error of their cubics.
    #[test]
    fn sections_have_levels_and_a_volume() {
        let station = |k: i32| {
            let x = f64::from(k);
            let b = 1.0 - 0.01 * x * x;
            let point = |j: i32| {
                let z = 10.0 * (f64::from(j) / 40.0).powi(2);
                OutlinePoint { y: 2.0 * b * (z / 10.0).sqrt(), z, marks: Marks::default() }
            };
            StationOffsets { outlines: vec![(0..=40).map(point).collect()], ..StationOffsets::new(format!("{k}"), x) }
        };
        let table = OffsetTable { stations: (-9..=9).map(station).collect(), ..OffsetTable::default() };
        let points = Points::new(&table, [-9.0, 9.0]).unwrap();
        assert!((8..=20).contains(&points.levels.waterlines.len()));
        for (station, k) in points.levels.stations.iter().zip(-9..=9) {
            let b = 1.0 - 0.01 * f64::from(k * k);
            assert!(station.keel_height.is_some_and(|z| z.abs() < 1e-12));
            assert!(station.flat_of_bottom.is_some_and(|y| y.abs() < 1e-12));
            for (cell, z) in station.half_breadths.iter().zip(&points.levels.waterlines) {
                assert!((cell.value().unwrap() - 2.0 * b * (z / 10.0).sqrt()).abs() < 2e-3, "{k} {z}");
            }
        }
        // Without the ends beyond the first and the last station.
        let ends = 2.0 * (1.0 - 0.9 + (0.9f64.powi(3) - 1.0) / 3.0) * 10.0;
        let volume = 2.0 * 40.0 / 3.0 * (40.0 / 3.0 - ends);
        assert!((points.volume(10.0) / volume - 1.0).abs() < 2e-3, "{} {volume}", points.volume(10.0));
        // Level pieces and what others hide are no readings.
        let square = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0], [0.0, 2.0]];
        let points = |station: &StationOffsets| {
            let marks = Marks::default();
            let outlines = vec![square.map(|[y, z]| OutlinePoint { y, z, marks }).to_vec()];
            StationOffsets { outlines, ..station.clone() }
        };
        let boxes = OffsetTable { stations: table.stations.iter().map(points).collect(), ..OffsetTable::default() };
        assert!(side_points(&boxes).iter().all(|&[_, _, p]| p == 3));
    }
}
