//! The waterlines of a table, made ready for a surface: their cells, their ends, and what had to be assumed.
//!
//! An end of a waterline is, in this order: the one the table gives; where the profile (lowest point on the centreplane
//! of each station) crosses its height, interpolated with a monotone cubic (Fritsch & Butland 1984) in z; the last zero
//! before the hull begins; the last cell itself where the table ends with breadth (transom or cut); where the
//! waterline, continued straight, closes before the next station. Each assumption is told once, with the waterlines it
//! concerns.
//!
//! A zero says that the waterline has ended at its station, not where. Where the zeros of neighbouring waterlines stand
//! at different stations the profile through them is a staircase, with waves of the sections between the waterlines
//! (a tanker's stem: 0.2 m); there each waterline ends where it closes when continued straight, at its zero at the
//! latest.

use super::super::{Entry, LineKind, OffsetTable, StationOffsets};
use super::monotone::monotone_cubic;
use super::{FitError, features, transom};

/// Slack of a doubtful cell against one that must be met, as a part of the energy scale of the fit.
const DOUBTFUL: f64 = 1.0;

/// An end nearer to the last station than this part of the station's distance to the next one inside is at the station.
const AT_STATION: f64 = 0.05;

/// An outermost station nearer to the next one than this part of the following space is crowded.
const CROWDED: f64 = 0.1;

/// An offset on a waterline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Site {
    /// Index of the station in the table.
    pub(super) station: usize,
    /// Position \[m\].
    pub(super) x: f64,
    /// Half-breadth \[m\].
    pub(super) y: f64,
    /// 0 for cells that are met; more for doubtful ones.
    pub(super) slack: f64,
}

/// An end of a waterline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct End {
    /// Position \[m\].
    pub(super) x: f64,
    /// Half-breadth \[m\]: 0 where the waterline closes.
    pub(super) y: f64,
}

/// A waterline.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    /// Height \[m\].
    pub(super) z: f64,
    /// Index in the table; none for rows made from the keel.
    pub(super) waterline: Option<usize>,
    /// Its offsets between its ends, x rising.
    pub(super) sites: Vec<Site>,
    /// Stern and stem.
    pub(super) ends: [End; 2],
    /// A knuckle runs along it.
    pub(super) knuckle: bool,
    /// A tangent line runs along it.
    pub(super) tangent: bool,
    /// It ends on the plane of the transom.
    pub(super) transom: bool,
}

/// The waterlines, lowest first, and what was assumed.
#[derive(Debug, Clone, Default)]
pub(super) struct Rows {
    pub(super) rows: Vec<Row>,
    pub(super) notes: Vec<String>,
}

/// How an end was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Origin {
    Given,
    Transom,
    Profile,
    Zero,
    BeforeZero,
    Cut,
    Continued,
}

const SIDES: [&str; 2] = ["aft", "fore"];

/// The stations of a table, x rising, with what is known on waterline `j`.
struct Waterline<'a> {
    table: &'a OffsetTable,
    order: &'a [usize],
    j: usize,
}

impl Waterline<'_> {
    fn station(&self, k: usize) -> &StationOffsets {
        &self.table.stations[self.order[k]]
    }

    fn entry(&self, k: usize) -> Entry {
        self.station(k).entry(self.j)
    }

    fn value(&self, k: usize) -> Option<f64> {
        self.station(k).half_breadth(self.j)
    }

    fn x(&self, k: usize) -> f64 {
        self.station(k).station.x
    }

    fn z(&self) -> f64 {
        self.table.waterlines[self.j]
    }

    /// Whether the deck at side lies below the waterline at a station.
    fn above_deck(&self, k: usize) -> bool {
        self.station(k).ends_below(self.j, self.z())
    }

    /// The half-breadth that continues the side above the deck.
    fn deck_half_breadth(&self, k: usize) -> Option<f64> {
        self.station(k).edge_half_breadth(self.j)
    }
}

/// Makes the rows.
pub(super) fn prepare(table: &OffsetTable) -> Result<Rows, FitError> {
    let mut order: Vec<usize> =
        (0..table.stations.len()).filter(|&i| table.stations[i].station.x.is_finite()).collect();
    order.sort_by(|&a, &b| table.stations[a].station.x.total_cmp(&table.stations[b].station.x));
    order.dedup_by(|a, b| table.stations[*a].station.x <= table.stations[*b].station.x);
    let mut notes = Vec::new();
    crowded_ends(table, &mut order, &mut notes);
    let mut heights: Vec<usize> = (0..table.waterlines.len()).filter(|&j| table.waterlines[j].is_finite()).collect();
    heights.sort_by(|&a, &b| table.waterlines[a].total_cmp(&table.waterlines[b]));
    heights.dedup_by(|a, b| table.waterlines[*a] <= table.waterlines[*b]);
    let mut rows = Vec::new();
    let mut assumed: Vec<(Origin, usize, f64)> = Vec::new();
    let staircase = staircase(table, &order, &heights);
    for &j in &heights {
        let line = Waterline { table, order: &order, j };
        if let Some(row) = row(&line, staircase, &mut assumed, &mut notes) {
            rows.push(row);
        } else if order.iter().any(|&i| table.stations[i].half_breadths.get(j).is_some_and(|c| c.value().is_some())) {
            notes.push(format!("the waterline at z = {:.3} m has no length and is left out", table.waterlines[j]));
        }
    }
    if let Some(bottom) = bottom_row(table, &order, rows.first()) {
        notes.push(format!(
            "the body is closed below the lowest waterline at the keel, z = {:.3} m, with the flats of bottom of the table",
            bottom.z
        ));
        rows.insert(0, bottom);
    }
    notes.extend(transom::notes(table, &rows));
    for (origin, words) in [
        (Origin::Transom, "ends on the plane of the transom, its breadth there carried on from its last offsets"),
        (Origin::Profile, "ends on the profile"),
        (Origin::Zero, "ends at the last zero before the hull begins"),
        (
            Origin::BeforeZero,
            "ends where it closes when continued straight, at its zero at the latest: zeros of neighbours stand at other stations",
        ),
        (Origin::Cut, "is cut off at the last station, where it still has breadth"),
        (Origin::Continued, "ends where it closes when continued straight, before the next station"),
    ] {
        for (side, name) in SIDES.iter().enumerate() {
            let lines: Vec<f64> = assumed.iter().filter(|a| a.0 == origin && a.1 == side).map(|a| a.2).collect();
            if let (Some(first), Some(last)) = (lines.first(), lines.last()) {
                let which = if lines.len() == 1 {
                    format!("the waterline at z = {first:.3} m")
                } else {
                    format!("each of {} waterlines between z = {first:.3} and {last:.3} m", lines.len())
                };
                notes.push(format!("{name}: {which} {words}"));
            }
        }
    }
    let stations =
        order.iter().filter(|&&i| table.stations[i].half_breadths.iter().any(|c| c.value().is_some())).count();
    if rows.len() < 2 || stations < 2 {
        return Err(FitError::TooFew { stations, waterlines: rows.len(), least: 2 });
    }
    Ok(Rows { rows, notes })
}

/// Leaves out an outermost station that stands close to the next one and is much narrower: both are cut through a
/// raking transom (or a blunt stem), and no fair line passes through the two.
fn crowded_ends(table: &OffsetTable, order: &mut Vec<usize>, notes: &mut Vec<String>) {
    for fore in [false, true] {
        let at = |n: usize| if fore { order[order.len() - 1 - n] } else { order[n] };
        if order.len() < 4 {
            return;
        }
        let x = |n: usize| table.stations[at(n)].station.x;
        let (space, following) = ((x(1) - x(0)).abs(), (x(2) - x(1)).abs());
        let (outer, inner) = (&table.stations[at(0)].half_breadths, &table.stations[at(1)].half_breadths);
        let narrow = outer
            .iter()
            .zip(inner)
            .filter_map(|(a, b)| a.value().zip(b.value()))
            .any(|(outer, inner)| outer > 0.0 && outer < 0.5 * inner);
        if space < CROWDED * following && narrow {
            notes.push(format!(
                "the station at x = {:.3} m stands {space:.3} m from the next and is much narrower: it cuts the transom and is left out of the surface",
                x(0)
            ));
            let gone = if fore { order.len() - 1 } else { 0 };
            order.remove(gone);
        }
    }
}

/// Whether the zeros at which neighbouring waterlines end stand at different stations, aft and fore.
fn staircase(table: &OffsetTable, order: &[usize], heights: &[usize]) -> [bool; 2] {
    [false, true].map(|fore| {
        let zero = |&j: &usize| {
            let line = Waterline { table, order, j };
            let outwards = |n: usize| if fore { order.len() - 1 - n } else { n };
            let last = (0..order.len()).find(|&n| line.value(outwards(n)).is_some_and(|y| y > 0.0))?;
            let beyond = last.checked_sub(1)?;
            let given = table.endings.get(j).and_then(|ends| ends[usize::from(fore)]).is_some();
            line.value(outwards(beyond)).filter(|y| *y <= 0.0 && !given).map(|_| beyond)
        };
        let zeros: Vec<Option<usize>> = heights.iter().map(zero).collect();
        zeros.windows(2).any(|pair| matches!(pair, [Some(a), Some(b)] if a != b))
    })
}

fn row(
    line: &Waterline<'_>,
    staircase: [bool; 2],
    assumed: &mut Vec<(Origin, usize, f64)>,
    notes: &mut Vec<String>,
) -> Option<Row> {
    let count = line.order.len();
    let given: Vec<usize> = (0..count).filter(|&k| line.value(k).is_some()).collect();
    let positive: Vec<usize> = given.iter().copied().filter(|&k| line.value(k).is_some_and(|y| y > 0.0)).collect();
    let lone = line.table.lone_offset(line.j).and_then(|at| line.order.iter().position(|&i| i == at));
    let positive = if lone.is_some() { Vec::new() } else { positive };
    if let Some(k) = lone {
        notes.push(format!(
            "the offset {:.3} m at x = {:.3} m is alone among zeros on the waterline at z = {:.3} m, and the surface does not follow it",
            line.value(k).unwrap_or_default(),
            line.x(k),
            line.z()
        ));
    }
    // A line of zeros is a keel: it runs over all of them.
    let run = if positive.is_empty() { &given } else { &positive };
    let (&first, &last) = (run.first()?, run.last()?);
    // Above the deck the side goes on, so that the surface has no hole; the deck cuts it off.
    let decked = |range: &mut dyn Iterator<Item = usize>| -> Vec<usize> {
        range.take_while(|&k| line.above_deck(k) && line.deck_half_breadth(k).is_some()).collect()
    };
    let aft_deck = decked(&mut (0..first).rev());
    let fore_deck = decked(&mut (last + 1..count));
    let (first, last) = (aft_deck.last().copied().unwrap_or(first), fore_deck.last().copied().unwrap_or(last));
    let value = |k: usize| line.value(k).or_else(|| if line.above_deck(k) { line.deck_half_breadth(k) } else { None });
    let value = |k: usize| if lone == Some(k) { None } else { value(k) };
    let mut ends = [End { x: 0.0, y: 0.0 }; 2];
    let mut transom = false;
    for (side, place) in ends.iter_mut().enumerate() {
        let (k, step) = if side == 0 { (first, -1isize) } else { (last, 1) };
        let on_transom = if side == 0 { on_transom(line, first, last, &value) } else { None };
        transom |= on_transom.is_some();
        let (end, origin) = match on_transom {
            Some(end) => (end, Origin::Transom),
            None => end(line, (side, staircase[side]), k, step, &value)?,
        };
        *place = end;
        if origin != Origin::Given {
            assumed.push((origin, side, line.z()));
        }
    }
    if ends[1].x <= ends[0].x {
        return None;
    }
    let mut gap = Vec::new();
    let mut sites = Vec::new();
    let slack = 1e-9 * (ends[1].x - ends[0].x);
    for k in first..=last {
        let x = line.x(k);
        if x <= ends[0].x + slack || x >= ends[1].x - slack {
            continue;
        }
        let marks = line.station(k).half_breadths.get(line.j).map(|c| c.marks).unwrap_or_default();
        match value(k) {
            Some(y) => {
                let slack = if marks.doubtful && !marks.locked { DOUBTFUL } else { 0.0 };
                sites.push(Site { station: line.order[k], x, y, slack });
            }
            None if line.entry(k) == Entry::Absent && outside(line, k) => {
                gap.push(x);
                sites.push(Site { station: line.order[k], x, y: 0.0, slack: 0.0 });
            }
            None => {}
        }
    }
    if let (Some(from), Some(to)) = (gap.first(), gap.last()) {
        notes.push(format!(
            "the waterline at z = {:.3} m has no hull between x = {from:.3} and {to:.3} m: the surface is closed there to no breadth",
            line.z()
        ));
    }
    let along = |kind: LineKind| features::runs_along(line.table, line.j, kind);
    let (knuckle, tangent) = (along(LineKind::Knuckle), along(LineKind::Tangent));
    Some(Row { z: line.z(), waterline: Some(line.j), sites, ends, knuckle, tangent, transom })
}

/// Whether a blank cell lies outside the profile: below the keel, or between a bulb and the stem above it.
fn outside(line: &Waterline<'_>, k: usize) -> bool {
    !line.above_deck(k)
}

/// The end of a waterline on the plane of the transom; none where it closes before it, and where an offset lies aft of
/// the plane.
///
/// It closes before it when the table gives an end or a station without hull before the plane, or when it has no
/// breadth left there.
fn on_transom(line: &Waterline<'_>, first: usize, last: usize, value: &dyn Fn(usize) -> Option<f64>) -> Option<End> {
    let plane = line.table.transom?;
    let at = plane.x_base + plane.slope * line.z();
    let slack = 1e-9 * (1.0 + at.abs());
    if (0..line.order.len()).any(|k| line.x(k) < at - slack && line.value(k).is_some_and(|y| y > 0.0)) {
        return None;
    }
    if line.table.endings.get(line.j).and_then(|e| e[0]).is_some_and(|x| x > at + slack) {
        return None;
    }
    let start = (first..=last).find(|&k| line.x(k) >= at - slack)?;
    // A station before the plane at which there is no hull.
    if start.checked_sub(1).is_some_and(|k| line.x(k) >= at - slack) {
        return None;
    }
    let cells: Vec<(f64, f64)> = (start..=last).filter_map(|k| Some((line.x(k), value(k)?))).take(3).collect();
    let y = transom::breadth(at, &cells)?;
    Some(End { x: at, y })
}

fn end(
    line: &Waterline<'_>,
    (side, staircase): (usize, bool),
    k: usize,
    step: isize,
    value: &dyn Fn(usize) -> Option<f64>,
) -> Option<(End, Origin)> {
    let x = line.x(k);
    let y = value(k)?;
    let outward = |a: f64, b: f64| if side == 0 { a <= b } else { a >= b };
    if let Some(at) = line.table.endings.get(line.j).and_then(|e| e[side])
        && at.is_finite()
        && outward(at, x)
    {
        // An end at the station of the last cell has its breadth: a transom.
        let here = (at - x).abs() <= 1e-9 * (1.0 + x.abs());
        return Some((End { x: at, y: if here { y } else { 0.0 } }, Origin::Given));
    }
    let next = k.checked_add_signed(step).filter(|&n| n < line.order.len());
    if y <= 0.0 {
        return Some((End { x, y: 0.0 }, Origin::Zero));
    }
    let Some(next) = next else { return Some((End { x, y }, Origin::Cut)) };
    let straight = || {
        let back = (1..)
            .map_while(|n| k.checked_add_signed(-step * n))
            .take(3)
            .find_map(|b| if b < line.order.len() { line.value(b).map(|y| (line.x(b), y)) } else { None });
        back.and_then(|(xb, yb)| if yb > y { Some(x + (x - xb) * y / (yb - y)) } else { None })
    };
    if value(next).is_some_and(|y| y <= 0.0) {
        let zero = line.x(next);
        let before = straight().filter(|&at| staircase && outward(zero, at));
        let origin = if before.is_some() { Origin::BeforeZero } else { Origin::Zero };
        return Some((End { x: before.unwrap_or(zero), y: 0.0 }, origin));
    }
    if let Some(at) = profile_crossing(line, k, step) {
        // A profile that leaves the waterline at the station itself, or so near that the waterline could not close
        // without a jump: a level keel ends there with its breadth.
        let inner = k.checked_add_signed(-step).filter(|&n| n < line.order.len()).map(|n| (line.x(n) - x).abs());
        let near = inner.map_or(0.0, |spacing| AT_STATION * spacing);
        if (at - x).abs() <= near.max(1e-9 * (1.0 + x.abs())) {
            return Some((End { x, y }, Origin::Profile));
        }
        // Where between the two stations the profile rises is not known. A waterline that would have to close more
        // steeply than at 45 degrees is round there and closes later, at most half-way.
        let reach = (at - x).abs().max(y.min(0.5 * (line.x(next) - x).abs()));
        return Some((End { x: x + reach.copysign(at - x), y: 0.0 }, Origin::Profile));
    }
    // Straight on, not beyond the next station.
    let beyond = line.x(next);
    let limit = x + 0.9 * (beyond - x);
    let at = straight().map_or(limit, |s| if outward(limit, s) { s } else { limit });
    Some((End { x: at, y: 0.0 }, Origin::Continued))
}

/// Where the profile crosses the height of the waterline beyond station `k`.
fn profile_crossing(line: &Waterline<'_>, k: usize, step: isize) -> Option<f64> {
    let z = line.z();
    let next = k.checked_add_signed(step)?;
    let keel = |n: usize| line.station(n).keel_height.filter(|z| z.is_finite());
    let (inner, outer) = (keel(k)?, (next < line.order.len()).then(|| keel(next)).flatten()?);
    if !(inner <= z && outer > z) {
        return None;
    }
    // The rising part of the profile around the gap: x as a function of z.
    let mut chain = vec![(inner, line.x(k)), (outer, line.x(next))];
    let mut at = k;
    while let Some(n) = at.checked_add_signed(-step).filter(|&n| n < line.order.len())
        && let Some(height) = keel(n)
        && height < chain[0].0
        && chain.len() < 5
    {
        chain.insert(0, (height, line.x(n)));
        at = n;
    }
    at = next;
    while let Some(n) = at.checked_add_signed(step).filter(|&n| n < line.order.len())
        && let Some(height) = keel(n)
        && height > chain[chain.len() - 1].0
        && chain.len() < 8
    {
        chain.push((height, line.x(n)));
        at = n;
    }
    Some(monotone_cubic(&chain, z))
}

/// A row on the keel where the lowest waterline of the table lies above it.
fn bottom_row(table: &OffsetTable, order: &[usize], lowest: Option<&Row>) -> Option<Row> {
    let lowest = lowest?;
    let keels: Vec<(usize, f64)> = order
        .iter()
        .filter_map(|&i| table.stations[i].keel_height.map(|z| (i, z)))
        .filter(|k| k.1.is_finite())
        .collect();
    let keel = keels.iter().map(|k| k.1).fold(f64::INFINITY, f64::min);
    let height = table.waterlines.iter().copied().fold(f64::NEG_INFINITY, f64::max) - keel;
    if keel.is_nan() || lowest.z - keel <= 1e-3 * height {
        return None;
    }
    let flat: Vec<usize> = keels.iter().filter(|k| k.1 - keel <= 2e-3 * height).map(|k| k.0).collect();
    let x = |i: usize| table.stations[i].station.x;
    let (first, last) = (x(*flat.first()?), x(*flat.last()?));
    let breadth = |i: usize| table.stations[i].flat_of_bottom.unwrap_or(0.0);
    // A single lowest point, or a flat keel that ends between stations: a tenth of the lowest waterline beyond.
    let reach = 0.05 * (lowest.ends[1].x - lowest.ends[0].x);
    let ends = if flat.len() < 2 {
        [
            End { x: (first - reach).max(lowest.ends[0].x), y: 0.0 },
            End { x: (last + reach).min(lowest.ends[1].x), y: 0.0 },
        ]
    } else {
        [End { x: first, y: breadth(*flat.first()?) }, End { x: last, y: breadth(*flat.last()?) }]
    };
    let sites = flat
        .iter()
        .filter(|&&i| x(i) > ends[0].x && x(i) < ends[1].x)
        .map(|&i| Site { station: i, x: x(i), y: breadth(i), slack: 0.0 })
        .collect();
    (ends[1].x > ends[0].x).then_some(Row {
        z: keel,
        waterline: None,
        sites,
        ends,
        knuckle: false,
        tangent: false,
        transom: false,
    })
}
