//! Checks of a table as a whole. A cell that is merely suspicious is not an error of reading.

use super::assemble::{SAME, TableReader};
use super::bottom;
use super::ends;
use super::problem::{Field, FilePosition, Problems};
use super::scale::{LARGEST_HALF_BREADTH, LARGEST_HEIGHT, LARGEST_LENGTH};
use super::settings::Settings;
use crate::hull::{Cell, Entry, OffsetTable, StationOffsets};
use crate::units::counted;

/// Distance of the lowest point from z = 0 over the height of the sections that is a warning.
const OFF_BASE: f64 = 0.2;

/// The lesser of the ends of a line of half-breadths over its greatest, at most.
const TAPERED: f64 = 0.3;

/// Most missing offsets that are named.
const MOST_PLACES: usize = 6;

/// Half-breadths are all positive, or all negative (starboard): then their sign is turned.
pub(super) fn signs(table: &mut OffsetTable, reader: &mut TableReader<'_>) {
    let values = || table.stations.iter().flat_map(|s| &s.half_breadths).filter_map(Cell::value);
    let (negative, positive) = (values().filter(|&y| y < 0.0).count(), values().filter(|&y| y > 0.0).count());
    if negative == 0 {
        return;
    }
    if positive == 0 {
        reader.problems.note("all half-breadths are negative (starboard side); their sign is turned".to_owned());
        reader.form.negative = true;
        for cell in table.stations.iter_mut().flat_map(|s| &mut s.half_breadths) {
            if let Entry::Given(value) = &mut cell.entry {
                *value = -*value;
            }
        }
        return;
    }
    let few_negative = negative <= positive;
    for station in &table.stations {
        for cell in &station.half_breadths {
            if cell.value().is_some_and(|y| if few_negative { y < 0.0 } else { y > 0.0 }) {
                let message = format!(
                    "half-breadths of both signs: {negative} are negative and {positive} positive; this one stands at station '{}'",
                    station.station.name
                );
                let remedy = "Half-breadths are distances from the centreplane: give them all the same sign";
                reader.problems.error("E309", &Field::of_cell(cell), message, remedy);
            }
        }
    }
}

/// The endings of the conventions, at the waterlines of the table.
pub(super) fn endings(table: &mut OffsetTable, settings: &Settings, problems: &mut Problems) {
    for (end, points) in settings.endings.iter().enumerate() {
        for &[z, x] in points {
            let Some(at) = table.waterlines.iter().position(|w| (w - z).abs() < SAME) else {
                let message = format!("[endings] gives x {x} m at the height {z} m, where the table has no waterline");
                problems.error(
                    "E311",
                    FilePosition::FILE,
                    message,
                    "Give the profiles at the heights of the waterlines",
                );
                continue;
            };
            if table.endings.is_empty() {
                table.endings = vec![[None; 2]; table.waterlines.len()];
            }
            table.endings[at][end] = Some(x);
        }
    }
}

/// Names offsets that are alone among the zeros of their waterline, which no surface follows.
fn lone(table: &OffsetTable, problems: &mut Problems) {
    for (j, &z) in table.waterlines.iter().enumerate() {
        let Some(station) = table.lone_offset(j).map(|k| &table.stations[k]) else { continue };
        let message = format!(
            "the offset at station '{}', waterline {z} m, is alone among zeros of its waterline: left out of the surface",
            station.station.name
        );
        let place = station.half_breadths.get(j).map_or(FilePosition::FILE, |cell| Field::of_cell(cell).place());
        problems.warning("W335", place, message, "Correct it, or those beside it");
    }
}

/// Profiles that contradict the stations: a stern before the middle of them, a stem behind it, or either within stations that
/// have a breadth at its height.
pub(super) fn profiles(table: &OffsetTable, problems: &mut Problems) {
    let xs = || table.stations.iter().map(|s| s.station.x);
    let Some((low, high)) = xs().reduce(f64::min).zip(xs().reduce(f64::max)) else { return };
    for (end, (name, word)) in [("stern", "aft of"), ("stem", "forward of")].into_iter().enumerate() {
        let aft_of = |a: f64, b: f64| if end == 0 { a < b } else { a > b };
        let given = || table.endings.iter().enumerate().filter_map(move |(j, ends)| Some((j, ends[end]?)));
        // Low waterlines of a keel that rises to both ends are short, and anywhere.
        let beyond = || given().filter(|&(_, x)| table.stations.len() > 1 && aft_of(0.5 * (low + high), x));
        if let Some((j, x)) = beyond().next().filter(|_| 2 * beyond().count() > given().count()) {
            let message = format!(
                "the profile of the {name} is at x {x} m on waterline {} m, beyond the middle of the stations, which is at {} m",
                table.waterlines[j],
                0.5 * (low + high)
            );
            problems.error(
                "E303",
                FilePosition::FILE,
                message,
                &format!(
                    "Give x of the profile forward of AP, as of the stations. If the row holds half-breadths of a station, \
                     write its position behind the name, as '{name} station ({high} m)'"
                ),
            );
            continue;
        }
        if end == 0 && looks_like_breadths(table) {
            let message = "the row of the stern is read as x of its profile, and rises with the waterlines as half-breadths of a \
                           station do";
            let remedy = "Write the position of such a station behind its name, as 'transom (0.50 m)'";
            problems.warning("W320", FilePosition::FILE, message.to_owned(), remedy);
        }
        let within = given().filter_map(|(j, x)| {
            let beyond = |s: &&StationOffsets| {
                aft_of(s.station.x, x - if end == 0 { SAME } else { -SAME })
                    && s.half_breadth(j).is_some_and(|y| y > 0.0)
            };
            Some((j, x, table.stations.iter().find(beyond)?))
        });
        let within: Vec<(usize, f64, &StationOffsets)> = within.collect();
        if let Some((j, x, station)) = within.first() {
            let message = format!(
                "the profile of the {name} is at x {x} m on waterline {} m, and '{}' {word} it has a half-breadth of {} m there; \
                 so on {}",
                table.waterlines[*j],
                station.station.name,
                station.half_breadth(*j).unwrap_or_default(),
                counted(within.len(), "waterline")
            );
            let remedy = "x counts forward of AP: distances aft of AP are negative";
            problems.warning("W320", FilePosition::FILE, message, remedy);
        }
    }
}

/// Whether x of the stern profile may be half-breadths: above 0, rising with the waterlines, and below the greatest breadth.
/// Sterns lean aft, and their x falls.
fn looks_like_breadths(table: &OffsetTable) -> bool {
    let given: Vec<f64> = table.endings.iter().filter_map(|ends| ends[0]).collect();
    let breadths = table.stations.iter().flat_map(|s| &s.half_breadths).filter_map(Cell::value);
    let greatest = breadths.fold(0.0, f64::max);
    let [first, .., last] = given[..] else { return false };
    let rises = given.windows(2).all(|pair| pair[1] >= pair[0]) && last > first + 0.05 * greatest;
    rises && first >= 0.0 && last <= greatest && last > 0.1 * greatest
}

/// Cells without hull among half-breadths, which no hull has: those that no chain of their like connects with an edge of
/// the table, where the hull ends, and that touch no zero, which is where a bulb ends; and those of a station between others
/// of which nothing is given. `absent` says of a cell whether it says that there is no hull, and nothing more.
pub(super) fn holes(table: &OffsetTable, absent: impl Fn(&Cell) -> bool) -> Vec<(usize, usize)> {
    let (rows, columns) = (table.stations.len(), table.waterlines.len());
    let none = Cell::default();
    let cell = |i: usize, j: usize| table.stations[i].half_breadths.get(j).unwrap_or(&none);
    let mut found: Vec<(usize, usize)> = Vec::new();
    let blank = |i: usize| {
        let station = &table.stations[i];
        let no_points = station.outlines.is_empty() && station.heights.is_empty();
        no_points && (0..columns).all(|j| absent(cell(i, j)))
    };
    let given: Vec<usize> = (0..rows).filter(|&i| !blank(i)).collect();
    if let [first, .., last] = given[..] {
        let between = (first..last).filter(|i| given.binary_search(i).is_err());
        found.extend(between.flat_map(|i| (0..columns).map(move |j| (i, j))));
    }
    let mut seen = vec![false; rows * columns];
    for from in 0..rows * columns {
        if seen[from] || !absent(cell(from / columns, from % columns)) {
            continue;
        }
        seen[from] = true;
        let (mut region, mut next, mut enclosed) = (vec![from], 0, true);
        while let Some(&at) = region.get(next) {
            next += 1;
            let (i, j) = (at / columns, at % columns);
            enclosed &= i > 0 && j > 0 && i + 1 < rows && j + 1 < columns;
            for (i, j) in [(i.wrapping_sub(1), j), (i + 1, j), (i, j.wrapping_sub(1)), (i, j + 1)] {
                if i >= rows || j >= columns || seen[i * columns + j] {
                    continue;
                }
                if absent(cell(i, j)) {
                    seen[i * columns + j] = true;
                    region.push(i * columns + j);
                } else {
                    enclosed &= match cell(i, j).entry {
                        Entry::Given(y) => y > 0.0,
                        Entry::Unknown => true,
                        Entry::Absent => false,
                    };
                }
            }
        }
        if enclosed {
            found.extend(region.into_iter().map(|at| (at / columns, at % columns)));
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

/// Blank cells among half-breadths are offsets that are missing, and no holes in the side; `-` and `*` are.
pub(super) fn missing(table: &mut OffsetTable, problems: &mut Problems) {
    let blank = |cell: &Cell| {
        let text = cell.written.as_ref().map_or("", |written| written.text.as_str());
        cell.entry == Entry::Absent && text.is_empty()
    };
    let found = holes(table, blank);
    if found.is_empty() {
        return;
    }
    for &(i, j) in &found {
        if let Some(cell) = table.stations[i].half_breadths.get_mut(j) {
            cell.entry = Entry::Unknown;
        }
    }
    let name = |&(i, j): &(usize, usize)| {
        format!("station {}, waterline {} m", table.stations[i].station.name, table.waterlines[j])
    };
    let mut places: Vec<String> = found.iter().take(MOST_PLACES).map(name).collect();
    if found.len() > MOST_PLACES {
        places.push(format!("{} more", found.len() - MOST_PLACES));
    }
    let message = format!(
        "{} among half-breadths: read as not known, and not as no hull ({})",
        counted(found.len(), "blank cell"),
        places.join("; ")
    );
    problems.warning("W314", FilePosition::FILE, message, "Write '?' there, the offset, or '-' where there is no hull");
}

/// What is wrong with a table, or should be known about it, once its numbers are read.
pub(super) fn whole(table: &OffsetTable, full: Option<bool>, problems: &mut Problems) {
    breadths(table, full, problems);
    if !problems.any_errors() {
        particulars(table, problems);
    }
    let offsets = table.stations.iter().flat_map(|s| s.half_breadths.iter().chain(&s.heights));
    let given = offsets.filter(|cell| cell.value().is_some()).count();
    let outlines = table.point_count();
    if given + outlines == 0 {
        problems.error("E313", FilePosition::FILE, "the table has no offset at all".to_owned(), "");
    }
    if !table.endings.iter().any(|e| e.iter().any(Option::is_some)) && !table.waterlines.is_empty() {
        let message = "no profiles of stem and stern; the ends of the waterlines will be extrapolated".to_owned();
        problems.warning(
            "W306",
            FilePosition::FILE,
            message,
            "Give rows 'stern' and 'stem' below the half-breadths, or [endings]",
        );
    }
    lone(table, problems);
    sides(table, problems);
    bottom::upside_down(table, problems);
    bottom::unknown(table, problems);
    ends::cut_off(table, problems);
    if let Some(highest) = table.closes_above() {
        let breadths = table.stations.iter().filter_map(|station| station.half_breadth(highest));
        let message = format!(
            "no breadth at any station above waterline {} m, where it is up to {} m: 0 is taken for a hull that closes there",
            table.waterlines[highest],
            breadths.fold(0.0, f64::max)
        );
        let remedy = "Leave the cells above the deck blank";
        problems.warning("W320", FilePosition::FILE, message, remedy);
    }
    if let Some(draught) = table.stated.draught {
        let below = table.waterlines.iter().filter(|&&z| z <= draught + SAME).count();
        if (1..6).contains(&below) {
            let message =
                format!("only {} up to T {draught} m: volumes from this table are coarse", counted(below, "waterline"));
            problems.warning("W307", FilePosition::FILE, message, "");
        }
    }
}

/// Heights of the deck below waterlines with half-breadths, and of the keel above them, at most stations: they are something
/// else, as half-breadths.
fn sides(table: &OffsetTable, problems: &mut Problems) {
    let has_breadth = |station: &StationOffsets, [low, high]: [f64; 2]| {
        let cells = station.half_breadths.iter().zip(&table.waterlines);
        cells.filter(|(_, z)| (low..high).contains(*z)).any(|(cell, _)| cell.value().is_some_and(|y| y > 0.0))
    };
    let above = |s: &StationOffsets| s.deck_height.map(|deck| has_breadth(s, [deck + SAME, f64::INFINITY]));
    let below = |s: &StationOffsets| s.keel_height.map(|keel| has_breadth(s, [f64::NEG_INFINITY, keel - SAME]));
    let count = |of: &dyn Fn(&StationOffsets) -> Option<bool>| {
        let all: Vec<bool> = table.stations.iter().filter_map(of).collect();
        (all.iter().filter(|wrong| **wrong).count(), all.len())
    };
    // Half-breadths fall to the ends; heights of a deck do not, and those of a keel rise to them.
    let heights = |of: fn(&StationOffsets) -> Option<f64>| table.stations.iter().filter_map(of).collect::<Vec<f64>>();
    let tapers = |list: Vec<f64>| match list[..] {
        [first, .., last] => first.min(last) < TAPERED * list.iter().copied().fold(0.0, f64::max),
        _ => false,
    };
    let deck = tapers(heights(|s| s.deck_height));
    let keel = tapers(heights(|s| s.keel_height));
    let all = [(count(&above), deck, "deck at side lies below"), (count(&below), keel, "keel lies above")];
    for ((wrong, all), _, what) in all.into_iter().filter(|(_, tapers, _)| *tapers) {
        if 2 * wrong > all {
            let message = format!("at {wrong} of {all} stations the {what} waterlines that have half-breadths there");
            let remedy = "Name the line for what its numbers are: these names are of heights above the base line";
            problems.warning("W320", FilePosition::FILE, message, remedy);
        }
    }
}

/// Hulls that are larger than any, or shorter than they are broad: another unit, numbers for distances, other axes.
fn size(table: &OffsetTable, problems: &mut Problems) {
    let range = |values: &mut dyn Iterator<Item = f64>| {
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
    };
    let points = || table.stations.iter().flat_map(|s| s.outlines.iter().flatten());
    let cells = table.stations.iter().flat_map(|s| s.half_breadths.iter().filter_map(Cell::value));
    let [aft, fore] = range(&mut table.stations.iter().map(|s| s.station.x));
    let half = range(&mut cells.chain(points().map(|p| p.y)))[1];
    let [low, high] = range(&mut table.waterlines.iter().copied().chain(points().map(|p| p.z)));
    let sizes = [
        ("length", fore - aft, LARGEST_LENGTH),
        ("half-breadth", half, LARGEST_HALF_BREADTH),
        ("height", high - low, LARGEST_HEIGHT),
    ];
    if low < -OFF_BASE * (high - low) && points().next().is_none() {
        let message = format!("the lowest waterline is at z = {low:.3} m, and draughts, C_B and KB count from z = 0");
        let remedy = "Give heights above the base line, or write 'Heights above LWL' over the table and state T";
        problems.warning("W320", FilePosition::FILE, message, remedy);
    }
    let mut good = true;
    for (what, found, most) in sizes.into_iter().filter(|(_, found, most)| found > most) {
        let message = format!("the hull would have a {what} of {found:.0} m, and no ship has one above {most} m");
        problems.error("E305", FilePosition::FILE, message, "Give the unit of the table, as units = \"mm\"");
        good = false;
    }
    if points().next().is_some() && low.abs() > OFF_BASE * (high - low) {
        let message = format!("the lowest point is at z = {low:.3} m, and draughts, C_B and KB count from z = 0");
        problems.warning("W320", FilePosition::FILE, message, "Give heights above the base line");
    }
    let level = |s: &StationOffsets| {
        let [low, high] = range(&mut s.outlines.iter().flatten().map(|p| p.z));
        s.outlines.iter().map(Vec::len).sum::<usize>() > 2 && high - low < SAME
    };
    if table.stations.len() > 2 && table.stations.first().is_some_and(level) && table.stations.last().is_some_and(level)
    {
        let message =
            "the first section and the last one are level lines: the columns y and z may be exchanged".to_owned();
        problems.warning(
            "W320",
            FilePosition::FILE,
            message,
            "Name the column of heights z and that of half-breadths y",
        );
    }
    if good && table.stations.len() > 2 && fore - aft < 2.0 * half {
        let message = format!(
            "the stations extend over {:.3} m, less than the breadth of {:.3} m: another unit, numbers of stations, or other axes",
            fore - aft,
            2.0 * half
        );
        let remedy = "Give units, x_units or station_spacing in the conventions";
        problems.warning("W320", FilePosition::FILE, message, remedy);
    }
}

/// Stated particulars that contradict the table: a draught above its top, a breadth that differs from twice the largest
/// half-breadth by more than 5 %, a length between perpendiculars that differs from the extent of the stations by more
/// than a factor 1.5.
pub(super) fn particulars(table: &OffsetTable, problems: &mut Problems) {
    size(table, problems);
    let stated = &table.stated;
    let points = || table.stations.iter().flat_map(|s| s.outlines.iter().flatten());
    let heights = table.stations.iter().flat_map(|s| s.heights.iter().filter_map(Cell::value).chain(s.deck_height));
    let top = table.waterlines.iter().copied().chain(points().map(|p| p.z)).chain(heights).reduce(f64::max);
    if let (Some(draught), Some(top)) = (stated.draught, top)
        && draught > top * 1.001 + SAME
    {
        let message = format!(
            "T is stated as {draught} m, and the table ends {top:.3} m above the base line, {:.3} m below it",
            draught - top
        );
        problems.warning("W308", FilePosition::FILE, message, "Correct T, or give the waterlines up to it");
    }
    // Above the draught a hull may flare beyond its moulded breadth.
    let limit = stated.draught.map_or(f64::INFINITY, |draught| draught * 1.001 + SAME);
    let largest_to = |limit: f64| {
        let cells = table.stations.iter().flat_map(|s| s.half_breadths.iter().zip(&table.waterlines));
        let cells = cells.filter(|(_, z)| **z <= limit).filter_map(|(cell, _)| cell.value());
        cells.chain(points().filter(|p| p.z <= limit).map(|p| p.y)).reduce(f64::max)
    };
    if let (Some(breadth), Some(all)) = (stated.breadth, largest_to(f64::INFINITY)) {
        let below = largest_to(limit).unwrap_or(all);
        let found = if 2.0 * all < 0.95 * breadth { 2.0 * all } else { 2.0 * below };
        if (2.0 * all < 0.95 * breadth || found > 1.05 * breadth) && found > 0.0 {
            let message = format!(
                "B is stated as {breadth} m, and twice the largest half-breadth is {found:.3} m: {:+.1} %",
                100.0 * (found / breadth - 1.0)
            );
            problems.warning("W309", FilePosition::FILE, message, "Correct B, or the unit of the half-breadths");
        }
    }
    let xs = || table.stations.iter().map(|s| s.station.x);
    if let Some((low, high)) = xs().reduce(f64::min).zip(xs().reduce(f64::max))
        && table.stations.len() > 2
        && (low + high).abs() < 0.5 * (high - low)
    {
        let message = format!(
            "the stations stand from x = {low:.3} to {high:.3} m, and x counts from AP: LCB, C_M and L_PP are those of a hull \
             with AP at x = 0"
        );
        let help = "Name the column x_from_midship if they count from there";
        problems.warning("W311", FilePosition::FILE, message, help);
    }
    if let (Some(length), Some(low), Some(high)) =
        (stated.length_between_perpendiculars, xs().reduce(f64::min), xs().reduce(f64::max))
        && table.stations.len() > 2
        && (high - low > 1.5 * length || length > 1.5 * (high - low))
    {
        let message = format!(
            "L_PP is stated as {length} m, and the stations extend over {:.3} m, from x = {low:.3} to {high:.3} m",
            high - low
        );
        problems.warning(
            "W310",
            FilePosition::FILE,
            message,
            "Correct Lpp, or the unit, the spacing or the number of the stations",
        );
    }
}

/// Full breadths that are meant as half-breadths, when B tells.
fn breadths(table: &OffsetTable, full: Option<bool>, problems: &mut Problems) {
    let Some(breadth) = table.stated.breadth else { return };
    let values = || table.stations.iter().flat_map(|s| &s.half_breadths).filter_map(Cell::value);
    let largest = values().fold(0.0, f64::max);
    let half = 0.5 * breadth;
    if full != Some(true) && largest > 1.8 * half && largest < 2.2 * half {
        let beyond = values().filter(|&y| y > half * (1.0 + 1e-6)).count();
        let message = format!(
            "{beyond} half-breadths exceed B/2 = {half:.2} by up to {:.2} m: the table seems to hold full breadths",
            largest - half
        );
        problems.error("E304", FilePosition::FILE, message, "Use breadths = \"full\"");
    }
    if full == Some(true) && largest > 0.0 && largest < 0.6 * half {
        let message = format!(
            "breadths are declared full, but half of the largest of them is {largest:.2} m and B/2 is {half:.2} m: the table \
             seems to hold half-breadths"
        );
        problems.error("E304", FilePosition::FILE, message, "Use breadths = \"half\"");
    }
}
