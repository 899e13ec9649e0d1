//! The sections of a table as lines of points from the centreplane at the keel to the upper edge, heights never falling.
//!
//! Level pieces (flat of bottom, ledges) stay. Between two branches (bulb and flare) the line goes back to the
//! centreplane and up along it. A piece that falls is no part of a half-breadth surface: its points are left out and
//! named. Lines that close a section along its deck are no part of the side.

use crate::hull::OffsetTable;
use crate::hull::cell::OutlinePoint;

/// A piece goes along a deck when it falls or rises by less than this part of the way it goes inward.
const DECK_SLOPE: f64 = 0.15;

/// Heights that fall by less than this part of the depth of the section fall by inaccuracy.
const DUST: f64 = 0.01;

/// The centre of a flat bottom lies below its edge by this part of the depth of the section, so that the half-breadth
/// at the height of the keel is that of the flat.
const HAIR: f64 = 1e-10;

/// An outermost section nearer to the next one than this part of the following space is crowded.
const CROWDED: f64 = 0.1;

/// A crowded section with less than this part of the area of the next one cuts the transom, and the next one may with
/// less than this part of what the following two let expect.
const NARROW: f64 = 0.75;

/// A section.
#[derive(Debug, Clone)]
pub(super) struct Section {
    /// Position forward of AP \[m\].
    pub(super) x: f64,
    /// Index of the station in the table.
    pub(super) station: usize,
    /// Points (y, z), the first on the centreplane.
    pub(super) points: Vec<[f64; 2]>,
}

impl Section {
    pub(super) fn keel(&self) -> f64 {
        self.points[0][1]
    }

    /// Chord length up to each point \[m\].
    pub(super) fn girths(&self) -> Vec<f64> {
        let mut length = 0.0;
        let steps = self.points.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1]));
        std::iter::once(0.0)
            .chain(steps.map(|step| {
                length += step;
                length
            }))
            .collect()
    }
}

impl Section {
    /// Area of one side \[m^2\].
    fn area(&self) -> f64 {
        self.points.windows(2).map(|w| 0.5 * (w[0][0] + w[1][0]) * (w[1][1] - w[0][1])).sum()
    }
}

/// The sections of a table in order of x, and what was left out of them or moved.
pub(super) fn sections(table: &OffsetTable, notes: &mut Vec<String>) -> Vec<Section> {
    let mut result: Vec<Section> = Vec::new();
    let mut levelled: Vec<(String, f64)> = Vec::new();
    let mut hooks: Vec<(String, f64)> = Vec::new();
    for (index, station) in table.stations.iter().enumerate() {
        if !station.station.x.is_finite() {
            continue;
        }
        let mut branches: Vec<Vec<[f64; 2]>> = station.outlines.iter().map(|line| upward(line)).collect();
        branches.retain(|branch| !branch.is_empty());
        branches.sort_by(|a, b| a[0][1].total_cmp(&b[0][1]));
        if let Some(top) = branches.last_mut() {
            take_off_deck(top);
        }
        let (points, hook) = joined(branches);
        let (mut points, moved) = rising(points);
        points.dedup_by(|b, a| (a[0] - b[0]).abs() <= 0.0 && (a[1] - b[1]).abs() <= 0.0);
        if points.is_empty() {
            notes.push(format!("station {} has no section and was left out", station.station.name));
            continue;
        }
        lower_centre(&mut points);
        if moved > 0.0 {
            levelled.push((station.station.name.clone(), moved));
        }
        if hook > 0.0 {
            hooks.push((station.station.name.clone(), hook));
        }
        result.push(Section { x: station.station.x, station: index, points });
    }
    for (list, what) in [
        (levelled, "hollows on the way from keel to deck; their points were put on one height, moved by up to"),
        (hooks, "pieces that fall on the way from keel to deck; their points were left out, by up to"),
    ] {
        if let Some(most) = list.iter().map(|h| h.1).max_by(f64::total_cmp) {
            let names: Vec<&str> = list.iter().map(|h| h.0.as_str()).collect();
            let (station, have) = if names.len() == 1 { ("station", "has") } else { ("stations", "have") };
            notes.push(format!("{station} {} {have} {what} {most:.3} m", names.join(", ")));
        }
    }
    result.sort_by(|a, b| a.x.total_cmp(&b.x));
    result.dedup_by(|b, a| {
        let same = b.x <= a.x;
        if same {
            notes.push(format!("there are two sections at x = {:.3} m: the first was taken", a.x));
        }
        same
    });
    crowded_ends(&mut result, notes);
    result
}

/// Leaves out an outermost section that stands close to the next one and is much smaller: it cuts a raking transom.
fn crowded_ends(sections: &mut Vec<Section>, notes: &mut Vec<String>) {
    for fore in [false, true] {
        if sections.len() < 4 {
            return;
        }
        let at = |n: usize| if fore { &sections[sections.len() - 1 - n] } else { &sections[n] };
        let (space, following) = ((at(1).x - at(0).x).abs(), (at(2).x - at(1).x).abs());
        if space < CROWDED * following && at(0).points.len() > 1 && at(0).area() < NARROW * at(1).area() {
            notes.push(format!(
                "the section at x = {:.3} m stands {space:.3} m from the next and is much smaller: it cuts the transom and is left out",
                at(0).x
            ));
            let gone = if fore { sections.len() - 1 } else { 0 };
            sections.remove(gone);
            note_cut(sections, fore, notes);
        }
    }
}

/// Tells of an outermost section, beside one that was left out, with much less area than the next two let expect: it is
/// met, and hollows the surface up to the next one.
fn note_cut(sections: &[Section], fore: bool, notes: &mut Vec<String>) {
    let at = |n: usize| if fore { &sections[sections.len() - 1 - n] } else { &sections[n] };
    let rate = (at(1).area() - at(2).area()) / (at(1).x - at(2).x);
    let expected = at(1).area() + rate * (at(0).x - at(1).x);
    if at(0).area() < NARROW * expected {
        notes.push(format!(
            "the section at x = {:.3} m has {:.2} m2 where the next two let expect {:.2}: if it cuts the transom as well, leave it out of the \
             table, since it hollows the surface up to x = {:.3} m",
            at(0).x,
            2.0 * at(0).area(),
            2.0 * expected,
            at(1).x
        ));
    }
}

/// One line of all branches, joined on the centreplane, from a point on it; and the greatest fall that was left out.
fn joined(branches: Vec<Vec<[f64; 2]>>) -> (Vec<[f64; 2]>, f64) {
    let heights = || branches.iter().flatten().map(|p| p[1]);
    let depth = heights().fold(f64::NEG_INFINITY, f64::max) - heights().fold(f64::INFINITY, f64::min);
    let mut points: Vec<[f64; 2]> = Vec::new();
    let (mut highest, mut hook) = (f64::NEG_INFINITY, 0.0f64);
    for branch in branches {
        match points.last() {
            None => points.push([0.0, branch[0][1]]),
            Some(&last) if branch[0][1] >= last[1] => points.extend([[0.0, last[1]], [0.0, branch[0][1]]]),
            Some(_) => {}
        }
        for point in branch {
            let fall = highest - point[1];
            if fall > DUST * depth {
                hook = hook.max(fall);
            } else {
                highest = highest.max(point[1]);
                points.push(point);
            }
        }
    }
    (points, hook)
}

/// Points with heights that never fall, nearest to the given ones in the mean square (pool adjacent violators; Barlow
/// et al. 1972), and the greatest move.
fn rising(mut points: Vec<[f64; 2]>) -> (Vec<[f64; 2]>, f64) {
    // Sum, count.
    let mut pools: Vec<(f64, usize)> = Vec::new();
    for point in &points {
        let mut pool = (point[1], 1usize);
        while let Some(last) = pools.last()
            && last.0 / last.1 as f64 > pool.0 / pool.1 as f64
        {
            pool = (pool.0 + last.0, pool.1 + last.1);
            pools.pop();
        }
        pools.push(pool);
    }
    let mut moved = 0.0f64;
    let heights = pools.iter().flat_map(|p| std::iter::repeat_n((p.0 / p.1 as f64, p.1), p.1));
    for (point, (z, shared)) in points.iter_mut().zip(heights) {
        if shared > 1 {
            moved = moved.max((point[1] - z).abs());
            point[1] = z;
        }
    }
    (points, moved)
}

/// Lowers the centre of a flat bottom by a hair.
fn lower_centre(points: &mut [[f64; 2]]) {
    let (keel, top) = (points[0][1], points[points.len() - 1][1]);
    let edge = points.partition_point(|p| p[1] <= keel) - 1;
    let (width, hair) = (points[edge][0], HAIR * (top - keel));
    if width > 0.0 && edge > 0 && points[..=edge].windows(2).all(|w| w[1][0] >= w[0][0]) {
        points[..edge].iter_mut().for_each(|p| p[1] -= hair * (1.0 - p[0] / width));
    }
}

/// The usable points of an outline from the keel up, half-breadths not negative.
fn upward(line: &[OutlinePoint]) -> Vec<[f64; 2]> {
    let usable = line.iter().filter(|p| p.y.is_finite() && p.z.is_finite());
    let mut points: Vec<[f64; 2]> = usable.map(|p| [p.y.max(0.0), p.z]).collect();
    if let (Some(first), Some(last)) = (points.first(), points.last())
        && first[1] > last[1]
    {
        points.reverse();
    }
    points
}

/// Takes off the line that closes a section along its deck, inward to the centreplane.
fn take_off_deck(points: &mut Vec<[f64; 2]>) {
    let mut end = points.len();
    if points[end - 1][0] > 0.0 {
        return;
    }
    let inward = |k: usize| {
        let (run, rise) = (points[k - 1][0] - points[k][0], points[k][1] - points[k - 1][1]);
        run > 0.0 && rise.abs() <= DECK_SLOPE * run
    };
    while end > 2 && inward(end - 1) {
        end -= 1;
    }
    points.truncate(end);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hull::{Marks, StationOffsets};

    fn outline(points: &[[f64; 2]]) -> Vec<OutlinePoint> {
        points.iter().map(|&[y, z]| OutlinePoint { y, z, marks: Marks::default() }).collect()
    }

    fn read(outlines: &[&[[f64; 2]]]) -> (Vec<[f64; 2]>, Vec<String>) {
        let mut station = StationOffsets::new("1", 3.0);
        station.outlines = outlines.iter().map(|line| outline(line)).collect();
        let table = OffsetTable { stations: vec![station], ..OffsetTable::default() };
        let mut notes = Vec::new();
        let section = sections(&table, &mut notes).remove(0);
        (section.points, notes)
    }

    fn near(found: &[[f64; 2]], expected: &[[f64; 2]]) {
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for (a, b) in found.iter().zip(expected) {
            assert!((a[0] - b[0]).abs() < 1e-8 && (a[1] - b[1]).abs() < 1e-8, "{found:?}");
        }
    }

    #[test]
    fn flats_and_ledges_stay_and_decks_go() {
        let line = [[0.0, 0.0], [3.0, 0.0], [4.0, 1.0], [6.0, 1.0], [6.0, 5.0], [3.0, 5.2], [0.0, 5.3]];
        let (points, notes) = read(&[&line]);
        near(&points, &line[..5]);
        assert!(notes.is_empty() && points[0][1] < 0.0 && points[1][1] >= 0.0);
        let reversed: Vec<[f64; 2]> = line.iter().rev().copied().collect();
        near(&read(&[&reversed]).0, &line[..5]);
        // A section that starts with breadth has a flat bottom; a bulb is closed at the centreplane.
        near(&read(&[&line[1..3]]).0, &line[..3]);
        assert_eq!(read(&[&[[0.0, 0.0], [1.0, 1.0], [0.0, 2.0]]]).0.len(), 3);
    }

    #[test]
    fn branches_are_joined_on_the_centreplane() {
        let (points, _) = read(&[&[[0.0, 6.0], [2.0, 9.0]], &[[0.0, 1.0], [1.0, 2.0], [0.5, 3.0]]]);
        near(&points, &[[0.0, 1.0], [1.0, 2.0], [0.5, 3.0], [0.0, 3.0], [0.0, 6.0], [2.0, 9.0]]);
    }

    #[test]
    fn hooks_are_left_out_and_hollows_levelled() {
        let (points, notes) = read(&[&[[0.0, 1.0], [1.0, 2.0], [2.0, 1.75], [3.0, 2.5]]]);
        near(&points, &[[0.0, 1.0], [1.0, 2.0], [3.0, 2.5]]);
        assert!(notes[0].contains("left out") && notes[0].contains("0.250 m"), "{notes:?}");
        let (points, notes) = read(&[&[[0.0, 1.0], [1.0, 2.0], [2.0, 1.98], [3.0, 12.5]]]);
        near(&points, &[[0.0, 1.0], [1.0, 1.99], [2.0, 1.99], [3.0, 12.5]]);
        assert!(notes[0].contains("one height") && notes[0].contains("0.010 m"), "{notes:?}");
    }

    #[test]
    fn a_section_through_the_transom_is_left_out() {
        let whole = [[0.0, 0.0], [4.0, 1.0], [4.0, 5.0]];
        let rest = [[0.0, 0.1], [0.5, 4.0], [4.0, 5.0]];
        let stations = [(-0.05, &rest), (0.0, &whole), (2.0, &whole), (4.0, &whole)]
            .map(|(x, line)| StationOffsets { outlines: vec![outline(line)], ..StationOffsets::new("s", x) });
        let mut notes = Vec::new();
        let table = OffsetTable { stations: stations.into(), ..OffsetTable::default() };
        assert_eq!(sections(&table, &mut notes).len(), 3);
        assert!(notes.len() == 1 && notes[0].contains("cuts the transom"), "{notes:?}");
        // The next one may cut it too: that is told.
        let narrower = [[0.0, 0.1], [0.3, 4.0], [3.0, 5.0]];
        let stations = [(-0.05, &narrower), (0.0, &rest), (2.0, &whole), (4.0, &whole), (6.0, &whole)]
            .map(|(x, line)| StationOffsets { outlines: vec![outline(line)], ..StationOffsets::new("s", x) });
        let mut notes = Vec::new();
        let table = OffsetTable { stations: stations.into(), ..OffsetTable::default() };
        assert_eq!(sections(&table, &mut notes).len(), 4);
        // (0.25 * 3.9 + 2.25) and 2 + 16 m2 a side.
        assert!(notes[1].contains("6.45 m2") && notes[1].contains("36.00"), "{notes:?}");
    }
}
