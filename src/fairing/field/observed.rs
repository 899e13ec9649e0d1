//! What a table says of a level hull: offsets as readings of its field, the ends of its waterlines as far as they are
//! known, and where there is no hull.
//!
//! An end of a waterline is, in this order: the one the table gives; on the plane of the transom; the edge of the table
//! where the last station still has breadth; a zero that neighbouring waterlines have at the same station, where the
//! offsets agree to that (a perpendicular); a zero at which the field would have breadth. Otherwise it lies between the last station with breadth and the next one: the
//! field says where.

use super::likelihood::{Cell, EXACT, PLACES, Readings};
use super::rocker::Rocker;
use crate::hull::{Marks, OffsetTable, StationOffsets, TransomPlane};

/// Scale of the errors of a doubtful offset.
pub const DOUBTFUL: f64 = 10.0;

/// Scale of the errors of what is marked so.
pub(super) fn scale(marks: Marks) -> f64 {
    match (marks.locked, marks.doubtful) {
        (true, _) => EXACT,
        (_, true) => DOUBTFUL,
        _ => 1.0,
    }
}

/// A keel this part of the height above the lowest is off the base.
const LEVEL: f64 = 2e-3;

/// Least distance of the lowest waterline from the keel, over the height, from which the keel is a waterline of its own.
const ABOVE_KEEL: f64 = 1e-3;

/// An end of a waterline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End {
    /// It closes at x \[m\].
    Closed(f64),
    /// It is cut off at x \[m\], with breadth.
    Cut(f64),
    /// It closes between the last station with breadth and the next one \[m\].
    Between(f64, f64),
    /// The same, and the table has a zero at that next station.
    Zero {
        /// The last station with breadth \[m\].
        last: f64,
        /// The next one \[m\].
        at: f64,
        /// Whether neighbouring waterlines have a zero there as well: it may be a perpendicular.
        shared: bool,
    },
}

impl End {
    /// The outermost x that it may be at.
    #[must_use]
    pub fn outermost(self) -> f64 {
        match self {
            Self::Closed(x) | Self::Cut(x) | Self::Between(_, x) | Self::Zero { at: x, .. } => x,
        }
    }
}

/// A waterline of the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Waterline {
    /// Height at its ends \[m\]: above a keel with rocker they differ.
    pub heights: [f64; 2],
    /// Its ends.
    pub ends: [End; 2],
    /// The outermost x at which the hull surely has breadth.
    pub inner: [f64; 2],
}

/// A zero beside the hull, which may belong to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Zero {
    /// Where it is, as an exact reading.
    pub cell: Cell,
    /// The half-breadth beside it: of the station before an end, of the waterline above a keel \[m\].
    pub beside: f64,
    /// What it is.
    pub kind: ZeroKind,
}

/// What a zero beside the hull is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ZeroKind {
    /// A keel above the base.
    Keel,
    /// The end of a waterline, at the station of that of its neighbours.
    SharedEnd,
    /// The end of a waterline alone.
    End,
}

/// All of it.
#[derive(Debug, Clone, Default)]
pub struct Observations {
    /// Offsets and other values of the field.
    pub readings: Vec<Cell>,
    /// Places (x, z) \[m\] between two offsets of a station, or above its keel, at which the hull is.
    pub inside: Vec<[f64; 2]>,
    /// Keels above the base.
    pub keels: Vec<Zero>,
    /// Half-breadths above the deck, where the side goes on.
    pub bounds: Vec<Cell>,
    /// Waterlines with breadth, from below.
    pub waterlines: Vec<Waterline>,
    /// From aft to forward and from below upwards: the rectangle \[m\].
    pub extent: [[f64; 2]; 2],
    /// Whether the lowest line is on the centreplane all along.
    pub keel_closed: bool,
    /// Whether its readings are points of sections.
    pub has_points: bool,
    /// The keel line to which all heights are relative; none: heights are those of the table.
    pub rocker: Option<Rocker>,
}

struct Line<'a> {
    table: &'a OffsetTable,
    j: usize,
}

impl Line<'_> {
    fn station(&self, k: usize) -> &StationOffsets {
        &self.table.stations[k]
    }

    fn value(&self, k: usize) -> Option<f64> {
        self.station(k).half_breadth(self.j)
    }

    fn is_above_deck(&self, k: usize) -> bool {
        self.station(k).ends_below(self.j, self.table.waterlines[self.j])
    }
}

impl Observations {
    /// Reads a table whose stations and waterlines rise.
    #[must_use]
    pub fn new(table: &OffsetTable) -> Self {
        let stations = &table.stations;
        let has_breadth = |j: &usize| stations.iter().any(|s| s.half_breadth(*j).is_some_and(|y| y > 0.0));
        let with_breadth = (0..table.waterlines.len()).filter(has_breadth).map(|j| table.waterlines[j]);
        let highest = with_breadth.fold(f64::NEG_INFINITY, f64::max);
        let lowest = table.waterlines.iter().copied().fold(f64::INFINITY, f64::min);
        let keels = || stations.iter().filter_map(|s| s.keel_height.filter(|z| z.is_finite()).map(|z| (s, z)));
        let keel = keels().map(|(_, z)| z).fold(f64::INFINITY, f64::min);
        let height = highest - keel.min(lowest);
        let bottom = if lowest - keel > ABOVE_KEEL * height { keel } else { lowest };
        let mut found = Self::default();
        for j in 0..table.waterlines.len() {
            found.waterline(&Line { table, j }, lowest);
        }
        for (station, z) in keels() {
            let level = level_keel(Some(z), bottom, height);
            // On the lowest waterline an offset says it already.
            if level && bottom >= lowest {
                continue;
            }
            let x = station.station.x;
            if level {
                let y = station.flat_of_bottom.unwrap_or(0.0);
                found.readings.push(Cell { x, z: bottom, y, scale: 1.0 });
            } else {
                let above = (0..table.waterlines.len()).filter(|&j| table.waterlines[j] > z);
                let breadth = above.filter_map(|j| station.half_breadth(j)).next().unwrap_or(0.0);
                let cell = Cell { x, z, y: 0.0, scale: EXACT };
                found.keels.push(Zero { cell, beside: breadth, kind: ZeroKind::Keel });
            }
        }
        for (k, station) in stations.iter().enumerate() {
            found.inside_of(table, k, bottom, level_keel(station.keel_height, bottom, height));
        }
        for station in stations {
            let deck = station.deck_height.zip(station.deck_half_breadth);
            let Some((z, y)) = deck.filter(|(z, y)| z.is_finite() && y.is_finite() && *z <= highest) else { continue };
            // On a waterline an offset says it already.
            let waterline = table.waterlines.iter().position(|&w| (w - z).abs() <= 1e-9 * height);
            if waterline.and_then(|j| station.half_breadth(j)).is_none() {
                found.readings.push(Cell { x: station.station.x, z, y, scale: 1.0 });
            }
        }
        let ends = found.waterlines.iter().flat_map(|w| w.ends).map(End::outermost);
        let places = found.readings.iter().chain(found.keels.iter().map(|keel| &keel.cell)).map(|cell| cell.x);
        let along = ends.chain(places).fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
        found.extent = [along, [bottom, highest]];
        let mut lowest = found.readings.iter().filter(|cell| cell.z <= bottom + 1e-9 * height).peekable();
        found.keel_closed = lowest.peek().is_some() && lowest.all(|cell| cell.y <= 0.0);
        found
    }

    /// Has points of sections in place of what they say at levels; offsets on the keel stay.
    pub fn read_points(&mut self, points: &[Cell]) {
        let bottom = self.extent[1][0];
        self.readings.retain(|cell| cell.z <= bottom);
        self.readings.extend(points);
        self.has_points = true;
    }

    /// What a field is made from.
    #[must_use]
    pub fn of_field(&self) -> Readings {
        Readings { cells: self.readings.clone(), inside: self.inside.clone(), common: None }
    }

    /// Notes where the hull is at a station, `bottom` being its keel where that is on the base.
    fn inside_of(&mut self, table: &OffsetTable, k: usize, bottom: f64, on_base: bool) {
        let breadth = |k: usize, j: usize| table.stations[k].half_breadth(j).is_some_and(|y| y > 0.0);
        let x = table.stations[k].station.x;
        let count = table.stations.len();
        for (j, &z) in table.waterlines.iter().enumerate().filter(|(j, _)| breadth(k, *j)) {
            // Next to an end of a waterline the stem may rise between this one and the keel.
            let surrounded = (0..k).any(|k| breadth(k, j)) && (k + 1..count).any(|k| breadth(k, j));
            let (from, power) = match j.checked_sub(1) {
                Some(below) if breadth(k, below) => (table.waterlines[below], 1),
                below if on_base && surrounded && below.is_none_or(|j| table.waterlines[j] <= bottom) => (bottom, 2),
                _ => continue,
            };
            self.inside.extend(between(x, [from, z], power));
        }
    }

    /// The zeros that may belong to the hull: keels above the base, and ends of waterlines.
    #[must_use]
    pub fn zeros(&self) -> Vec<Zero> {
        // Above a keel with rocker heights of a waterline at neighbouring stations are not quite the same.
        let breadth = |x: f64, z: f64| {
            let at = self.readings.iter().filter(|cell| cell.x.total_cmp(&x).is_eq());
            let nearest = at.min_by(|a, b| (a.z - z).abs().total_cmp(&(b.z - z).abs()));
            nearest.map_or(0.0, |cell| cell.y)
        };
        let end = |(end, z): (End, f64)| {
            let End::Zero { last, at, shared } = end else { return None };
            let kind = if shared { ZeroKind::SharedEnd } else { ZeroKind::End };
            Some(Zero { cell: closing(at, z), beside: breadth(last, z), kind })
        };
        let ends = self.waterlines.iter().flat_map(|line| line.ends.into_iter().zip(line.heights)).filter_map(end);
        self.keels.iter().copied().chain(ends).collect()
    }

    /// Takes for readings those of [`Self::zeros`] that agree with the offsets. Other ends are somewhere before such a zero.
    pub fn settle(&mut self, agreeing: &[Zero]) {
        self.readings.extend(agreeing.iter().map(|zero| zero.cell));
        self.keels.clear();
        for line in &mut self.waterlines {
            for (end, z) in line.ends.iter_mut().zip(line.heights) {
                let End::Zero { last, at, .. } = *end else { continue };
                let cell = closing(at, z);
                let closes = agreeing.iter().any(|zero| zero.kind != ZeroKind::Keel && zero.cell == cell);
                *end = if closes { End::Closed(at) } else { End::Between(last, at) };
            }
        }
    }

    /// The same of a field over heights relative to a keel with rocker: offsets above the keel, whose end is the
    /// keel line itself. The hull ends at the ends of this line, plumb. Where the line ends before the hull, waterlines above
    /// it end as the table says. None where an offset is below the line.
    #[must_use]
    pub fn over_keel(self, table: &OffsetTable, rocker: Rocker) -> Option<Self> {
        let level = self;
        let relative = |cell: &Cell| Some(Cell { z: rocker.relative(cell.x, cell.z)?, ..*cell });
        let [bottom, top] = rocker.height;
        let has_keel = |x: f64| (rocker.run[0]..=rocker.run[1]).contains(&x);
        let with_breadth = level.readings.iter().filter(|cell| cell.y > 0.0);
        let mut readings: Vec<Cell> = with_breadth.clone().filter_map(relative).collect();
        if with_breadth.filter(|cell| !has_keel(cell.x)).any(|cell| relative(cell).is_none()) {
            return None;
        }
        let bounds = level.bounds.iter().filter_map(relative).collect();
        let above = |keel: &Zero| Some(Zero { cell: relative(&keel.cell)?, ..*keel });
        let keels = level.keels.iter().filter(|keel| !has_keel(keel.cell.x)).filter_map(above).collect();
        let mut inside: Vec<[f64; 2]> =
            level.inside.iter().map(|&[x, z]| [x, rocker.relative(x, z).unwrap_or(bottom)]).collect();
        let mut keel_closed = true;
        for station in &table.stations {
            let x = station.station.x;
            if station.keel_height.is_none() || !has_keel(x) {
                continue;
            }
            let offsets = readings.iter().filter(|cell| (cell.x - x).abs() < 1e-9);
            let lowest = offsets.map(|cell| cell.z).fold(f64::INFINITY, f64::min);
            inside.extend(between(x, [bottom, lowest], 2).filter(|_| lowest.is_finite()));
            let y = station.flat_of_bottom.unwrap_or(0.0);
            keel_closed &= y <= 0.0;
            readings.push(Cell { x, z: bottom, y, scale: if y > 0.0 { 1.0 } else { EXACT } });
        }
        let lines = table.waterlines.len().max(2);
        let plumb = |side: usize| {
            let x = rocker.length[side];
            rocker.closed[side].map(|closed| if closed { End::Closed(x) } else { End::Cut(x) })
        };
        for side in (0..2).filter(|&side| rocker.closed[side] == Some(true)) {
            let x = rocker.length[side];
            let places = (0..lines).map(|k| bottom + (top - bottom) * k as f64 / (lines - 1) as f64);
            readings.extend(places.map(|z| Cell { x, z, y: 0.0, scale: EXACT }));
        }
        // A plumb end is the same at all heights.
        let waterline = |line: &Waterline| {
            let mut found = *line;
            for side in 0..2 {
                match plumb(side) {
                    Some(end) => {
                        (found.heights[side], found.ends[side], found.inner[side]) = (bottom, end, rocker.length[side]);
                    }
                    None => found.heights[side] = rocker.relative(line.ends[side].outermost(), line.heights[side])?,
                }
            }
            Some(found)
        };
        let waterlines: Vec<Waterline> = level.waterlines.iter().filter_map(waterline).collect();
        let closed = |(end, z): (End, f64), side: usize| match end {
            End::Closed(at) if rocker.closed[side].is_none() => Some(closing(at, z)),
            _ => None,
        };
        let ends = |line: &Waterline| [0, 1].map(|side| closed((line.ends[side], line.heights[side]), side));
        readings.extend(waterlines.iter().flat_map(ends).flatten());
        let extent = [rocker.length, rocker.height];
        let (has_points, rocker) = (level.has_points, Some(rocker));
        Some(Self { readings, inside, keels, bounds, waterlines, extent, keel_closed, has_points, rocker })
    }

    fn waterline(&mut self, line: &Line<'_>, lowest: f64) {
        let count = line.table.stations.len();
        let (j, z) = (line.j, line.table.waterlines[line.j]);
        let given: Vec<usize> = (0..count).filter(|&k| line.value(k).is_some()).collect();
        let positive: Vec<usize> = given.iter().copied().filter(|&k| line.value(k).is_some_and(|y| y > 0.0)).collect();
        // The lowest waterline with more zeros than breadths between its ends is a keel with some width here and there.
        let ends = positive.first().zip(positive.last()).filter(|_| z <= lowest);
        let inside = |k: usize| ends.is_some_and(|(&first, &last)| (first..=last).contains(&k));
        let is_keel = given.iter().filter(|k| inside(**k)).count() > 2 * positive.len();
        for &k in &given {
            let Some(y) = line.value(k) else { continue };
            if y <= 0.0 && !positive.is_empty() && !(is_keel && inside(k)) {
                continue;
            }
            // A line of zeros is the keel.
            let is_zero = positive.is_empty();
            let scale = if is_zero { EXACT } else { scale(line.station(k).half_breadths[j].marks) };
            self.readings.push(Cell { x: line.station(k).station.x, z, y, scale });
        }
        let (Some(&first), Some(&last)) = (positive.first(), positive.last()) else { return };
        // Above the deck the side goes on. Blanks and zeros between offsets say nothing: keels are written so.
        for k in first..=last {
            if line.is_above_deck(k) {
                self.above_deck(line, k);
            }
        }
        let mut ends = [End::Cut(0.0); 2];
        let mut inner = [0.0; 2];
        for side in 0..2 {
            let mut k = if side == 0 { first } else { last };
            let outward = |k: usize| if side == 0 { k.checked_sub(1) } else { Some(k + 1).filter(|&n| n < count) };
            while let Some(n) = outward(k).filter(|&n| line.is_above_deck(n)) {
                self.above_deck(line, n);
                k = n;
            }
            inner[side] = line.station(if side == 0 { first } else { last }).station.x;
            ends[side] = self.end(line, side, k, outward(k));
        }
        self.waterlines.push(Waterline { heights: [z; 2], ends, inner });
    }

    fn end(&mut self, line: &Line<'_>, side: usize, k: usize, next: Option<usize>) -> End {
        let (x, z) = (line.station(k).station.x, line.table.waterlines[line.j]);
        let outward = |a: f64, b: f64| if side == 0 { a <= b } else { a >= b };
        if let Some(at) =
            line.table.endings.get(line.j).and_then(|ends| ends[side]).filter(|at| at.is_finite() && outward(*at, x))
        {
            if (at - x).abs() <= 1e-9 * (1.0 + x.abs()) {
                return End::Cut(x);
            }
            self.readings.push(Cell { x: at, z, y: 0.0, scale: EXACT });
            return End::Closed(at);
        }
        if side == 0
            && let Some(at) = line.table.transom.and_then(|plane| on_transom(plane, z, x))
        {
            if let Some(n) = next.filter(|&n| line.station(n).station.x >= at) {
                return End::Between(x, line.station(n).station.x);
            }
            return End::Cut(at);
        }
        let Some(next) = next else { return End::Cut(x) };
        let beyond = line.station(next).station.x;
        if line.value(next).is_some_and(|y| y <= 0.0) {
            return End::Zero { last: x, at: beyond, shared: is_shared(line, side) };
        }
        End::Between(x, beyond)
    }

    fn above_deck(&mut self, line: &Line<'_>, k: usize) {
        let station = line.station(k);
        let Some(y) = station.edge_half_breadth(line.j) else { return };
        self.bounds.push(Cell { x: station.station.x, z: line.table.waterlines[line.j], y, scale: 1.0 });
    }
}

/// Places (x, z) between two heights of a station \[m\], whose parts of the distance are even ones to a power.
fn between(x: f64, [from, to]: [f64; 2], power: i32) -> impl Iterator<Item = [f64; 2]> {
    let part = move |place: usize| (place as f64 / (PLACES + 1) as f64).powi(power);
    (1..=PLACES).map(move |place| [x, from + (to - from) * part(place)])
}

/// Whether a keel is on the base; one that is not given is.
fn level_keel(keel: Option<f64>, bottom: f64, height: f64) -> bool {
    keel.is_none_or(|z| z - bottom <= LEVEL * height)
}

/// The zero at which a waterline may end.
fn closing(x: f64, z: f64) -> Cell {
    Cell { x, z, y: 0.0, scale: EXACT }
}

/// x of the plane at a height, where the last station with breadth is not aft of it.
fn on_transom(plane: TransomPlane, z: f64, last: f64) -> Option<f64> {
    let at = plane.x_base + plane.slope * z;
    (last >= at - 1e-9 * (1.0 + at.abs())).then_some(at)
}

/// Whether a waterline ends at a zero at the station of that of the next waterline above or below.
fn is_shared(line: &Line<'_>, side: usize) -> bool {
    let count = line.table.stations.len();
    let outwards = |n: usize| if side == 1 { count - 1 - n } else { n };
    let zero = |j: usize| {
        let line = Line { table: line.table, j };
        let last = (0..count).find(|&n| line.value(outwards(n)).is_some_and(|y| y > 0.0))?;
        let beyond = last.checked_sub(1)?;
        line.value(outwards(beyond)).filter(|y| *y <= 0.0).map(|_| beyond)
    };
    let own = zero(line.j);
    let beside = [line.j.checked_sub(1), Some(line.j + 1).filter(|&j| j < line.table.waterlines.len())];
    own.is_some() && beside.into_iter().flatten().any(|j| zero(j) == own)
}
