//! Sections as lines of points: full loops cut at the centreplane, decks taken off, branches separated; and back to
//! points.
//!
//! A half section runs from the centreplane below (or the edge of the bottom) to the deck at side. Where it returns to
//! the centreplane and leaves it again higher (a bulb and the flare above it) it has two branches.

use crate::hull::{Cell, Marks, OutlinePoint, StationOffsets};

/// A point nearer to the centreplane than this is on it \[m\].
const ON_CENTREPLANE: f64 = 1e-9;

/// The steepest deck: four times the usual camber of a fiftieth of the breadth, at the side, is 0.32.
const STEEPEST_DECK: f64 = 0.32;

/// The smallest turn of the section at the deck at side \[rad\]: less is the crown of a bulb.
const LEAST_TURN: f64 = 0.52;

/// A deck that was taken off a section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Deck {
    /// Deck at side.
    pub(super) side: OutlinePoint,
    /// Height on the centreline \[m\].
    pub(super) centre_height: f64,
}

/// A point without marks.
pub(super) fn point(y: f64, z: f64) -> OutlinePoint {
    OutlinePoint { y, z, marks: Marks::default() }
}

fn on_centreplane(p: &OutlinePoint) -> bool {
    p.y.abs() <= ON_CENTREPLANE
}

/// The halves of a full section: the branches of starboard (y > 0) and of port, mirrored, each from below upwards.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Halves {
    /// Branches on the side y > 0.
    pub(super) starboard: Vec<Vec<OutlinePoint>>,
    /// Branches on the side y < 0, mirrored.
    pub(super) port: Vec<Vec<OutlinePoint>>,
}

/// Cuts a closed section (the last point is joined to the first) at the centreplane; none where it does not reach it.
///
/// Where the line crosses the centreplane between two points a point is put there.
pub(super) fn halves(loop_points: &[OutlinePoint]) -> Option<Halves> {
    let mut points: Vec<OutlinePoint> = Vec::with_capacity(loop_points.len() + 4);
    for (i, &a) in loop_points.iter().enumerate() {
        let b = loop_points[(i + 1) % loop_points.len()];
        points.push(a);
        if !on_centreplane(&a) && !on_centreplane(&b) && (a.y < 0.0) != (b.y < 0.0) {
            let t = a.y / (a.y - b.y);
            points.push(point(0.0, a.z + t * (b.z - a.z)));
        }
    }
    let start = points.iter().position(on_centreplane)?;
    points.rotate_left(start);
    points.push(points[0]);
    let mut halves = Halves::default();
    let mut from = 0;
    for to in 1..points.len() {
        if !on_centreplane(&points[to]) {
            continue;
        }
        if to > from + 1 {
            let starboard = points[from + 1].y > 0.0;
            let mut piece: Vec<OutlinePoint> =
                points[from..=to].iter().map(|p| OutlinePoint { y: p.y.abs(), ..*p }).collect();
            if piece[piece.len() - 1].z < piece[0].z {
                piece.reverse();
            }
            if starboard { halves.starboard.push(piece) } else { halves.port.push(piece) }
        }
        from = to;
    }
    for side in [&mut halves.starboard, &mut halves.port] {
        side.sort_by(|a, b| a[0].z.total_cmp(&b[0].z));
    }
    Some(halves)
}

/// Separates the branches of a half section: it is cut where it runs along the centreplane between two wider parts.
pub(super) fn branches(half: Vec<OutlinePoint>) -> Vec<Vec<OutlinePoint>> {
    let mut pieces: Vec<Vec<OutlinePoint>> = vec![Vec::new()];
    // Up to its first wide point a branch may run along the centreplane: the stem below a section, for example.
    let last_wide = half.iter().rposition(|p| !on_centreplane(p)).unwrap_or(0);
    let mut wide = false;
    for (i, &p) in half.iter().enumerate() {
        if let Some(piece) = pieces.last()
            && i <= last_wide
            && wide
            && on_centreplane(&p)
            && piece.last().is_some_and(|before| on_centreplane(before) && (before.z - p.z).abs() > ON_CENTREPLANE)
        {
            pieces.push(Vec::new());
            wide = false;
        }
        if let Some(piece) = pieces.last_mut() {
            piece.push(p);
            wide |= !on_centreplane(&p);
        }
    }
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

/// The height of the keel of some outlines: the lowest point on the centreplane.
pub(super) fn keel_of(outlines: &[Vec<OutlinePoint>]) -> Option<f64> {
    let keel = outlines.iter().flatten().filter(|p| p.y.abs() <= 1e-9).map(|p| p.z);
    keel.min_by(f64::total_cmp)
}

/// Takes the deck off a branch that ends on the centreplane above: the nearly level lines beyond a corner at the side.
pub(super) fn take_off_deck(branch: &mut Vec<OutlinePoint>) -> Option<Deck> {
    let top = *branch.last().filter(|p| on_centreplane(p))?;
    let mut edge = branch.len() - 1;
    while edge > 0 {
        let (a, b) = (branch[edge - 1], branch[edge]);
        let inward = a.y - b.y;
        let repeated = inward.abs() <= ON_CENTREPLANE && (a.z - b.z).abs() <= ON_CENTREPLANE;
        if !repeated && (inward <= 0.0 || (b.z - a.z).abs() > STEEPEST_DECK * inward) {
            break;
        }
        edge -= 1;
    }
    let side = branch[edge];
    if edge == 0 || on_centreplane(&side) {
        return None;
    }
    let before = branch[..edge].iter().rfind(|p| (p.y - side.y).hypot(p.z - side.z) > ON_CENTREPLANE)?;
    let after = branch[edge..].iter().find(|p| (p.y - side.y).hypot(p.z - side.z) > ON_CENTREPLANE)?;
    let turn = {
        let (a, b) = ((side.y - before.y, side.z - before.z), (after.y - side.y, after.z - side.z));
        (a.0 * b.1 - a.1 * b.0).atan2(a.0 * b.0 + a.1 * b.1).abs()
    };
    if turn < LEAST_TURN {
        return None;
    }
    branch.truncate(edge + 1);
    Some(Deck { side, centre_height: top.z })
}

/// The largest distance of the points of two half sections from the other's line \[m\].
pub(super) fn deviation(a: &[Vec<OutlinePoint>], b: &[Vec<OutlinePoint>]) -> f64 {
    let count = |side: &[Vec<OutlinePoint>]| side.iter().map(Vec::len).sum::<usize>();
    // A million pairs are enough to say how far two sides differ.
    let stride = (count(a) * count(b) / 1_000_000).max(1);
    let one_way = |from: &[Vec<OutlinePoint>], to: &[Vec<OutlinePoint>]| {
        from.iter()
            .flatten()
            .step_by(stride)
            .map(|p| to.iter().flat_map(|line| line.windows(2)).map(|s| distance(p, s)).fold(f64::INFINITY, f64::min))
            .filter(|d| d.is_finite())
            .fold(0.0, f64::max)
    };
    one_way(a, b).max(one_way(b, a))
}

fn distance(p: &OutlinePoint, segment: &[OutlinePoint]) -> f64 {
    let (a, b) = (segment[0], segment[1]);
    let (dy, dz) = (b.y - a.y, b.z - a.z);
    let squared = dy * dy + dz * dz;
    let t = if squared > 0.0 { (((p.y - a.y) * dy + (p.z - a.z) * dz) / squared).clamp(0.0, 1.0) } else { 0.0 };
    (a.y + t * dy - p.y).hypot(a.z + t * dz - p.z)
}

/// The section of a station as branches of points: its outlines, or, of a grid, keel, half-breadths and deck, a branch
/// for each run of waterlines with hull.
#[must_use]
pub fn section_of(station: &StationOffsets, waterlines: &[f64]) -> Vec<Vec<OutlinePoint>> {
    if !station.outlines.is_empty() {
        return station.outlines.clone();
    }
    let deck = station.deck_height.unwrap_or(f64::INFINITY);
    let mut branches: Vec<Vec<OutlinePoint>> = vec![Vec::new()];
    if let Some(keel) = station.keel_height {
        branches[0].push(point(0.0, keel));
    }
    for (&z, cell) in waterlines.iter().zip(&station.half_breadths) {
        let Some(branch) = branches.last_mut() else { break };
        match cell.value() {
            Some(y) if z <= deck => {
                let known = branch.last().is_some_and(|last| (last.z - z).abs() < 1e-12 && (last.y - y).abs() < 1e-12);
                if !known {
                    branch.push(OutlinePoint { y, z, marks: cell.marks });
                }
            }
            Some(_) => {}
            None if branch.len() > 1 && absent(cell) => branches.push(Vec::new()),
            None => {}
        }
    }
    if let (Some(z), Some(y)) = (station.deck_height, station.deck_half_breadth) {
        match branches.iter_mut().rev().find(|branch| !branch.is_empty()) {
            Some(branch) if branch.last().is_none_or(|last| last.z < z - 1e-12) => branch.push(point(y, z)),
            _ => {}
        }
    }
    branches.retain(|branch| !branch.is_empty());
    branches
}

fn absent(cell: &Cell) -> bool {
    matches!(cell.entry, crate::hull::Entry::Absent)
}

/// Points nearer to each other than this are one in the decimals of the formats \[m\].
const SAME: f64 = 1e-4;

/// The section of a station as one line of points; none where fewer than two of them are distinct.
pub(super) fn line_of(station: &StationOffsets, waterlines: &[f64]) -> Option<Vec<OutlinePoint>> {
    let line = joined(&section_of(station, waterlines));
    let first = *line.first()?;
    line.iter().any(|p| (p.y - first.y).hypot(p.z - first.z) > SAME).then_some(line)
}

/// One line of points through all branches, joined along the centreplane.
fn joined(branches: &[Vec<OutlinePoint>]) -> Vec<OutlinePoint> {
    let mut line: Vec<OutlinePoint> = Vec::new();
    for branch in branches {
        if let (Some(&last), Some(&first)) = (line.last(), branch.first()) {
            for p in [last, first] {
                if !on_centreplane(&p) {
                    line.push(point(0.0, p.z));
                }
            }
        }
        line.extend(branch);
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(points: &[(f64, f64)]) -> Vec<OutlinePoint> {
        points.iter().map(|&(y, z)| point(y, z)).collect()
    }

    #[test]
    fn a_box_that_starts_off_centre() {
        let full = line(&[(-3.0, 0.0), (4.0, 0.0), (4.0, 5.0), (-4.0, 5.0), (-4.0, 0.0)]);
        let halves = halves(&full).unwrap();
        assert_eq!(halves.starboard, [line(&[(0.0, 0.0), (4.0, 0.0), (4.0, 5.0), (0.0, 5.0)])]);
        assert_eq!(halves.port, [line(&[(0.0, 0.0), (3.0, 0.0), (4.0, 0.0), (4.0, 5.0), (0.0, 5.0)])]);
        assert!(deviation(&halves.starboard, &halves.port) < 1e-15);
        let mut side = halves.starboard[0].clone();
        let deck = take_off_deck(&mut side).unwrap();
        assert_eq!(side, line(&[(0.0, 0.0), (4.0, 0.0), (4.0, 5.0)]));
        assert_eq!(deck, Deck { side: point(4.0, 5.0), centre_height: 5.0 });
    }

    #[test]
    fn a_bulb_below_and_flare_above() {
        let full = line(&[
            (0.0, 0.0),
            (1.0, 1.0),
            (0.0, 2.0),
            (0.0, 4.0),
            (3.0, 6.0),
            (-3.2, 6.0),
            (0.0, 4.0),
            (0.0, 2.0),
            (-1.0, 1.0),
        ]);
        let mut halves = halves(&full).unwrap();
        assert_eq!(halves.starboard.len(), 2);
        assert!((deviation(&halves.starboard, &halves.port) - 0.2).abs() < 1e-12);
        // The crown of the bulb is no deck.
        assert_eq!(take_off_deck(&mut halves.starboard[0]), None);
        let whole = joined(&halves.starboard);
        assert_eq!(branches(whole), halves.starboard);
    }

    #[test]
    fn round_crowns_and_steep_ends_are_no_decks() {
        let mut circle: Vec<_> = (0..=36)
            .map(|k| (f64::from(k) * 5.0).to_radians())
            .map(|a| point((2.0 * a.sin()).max(0.0), 2.0 - 2.0 * a.cos()))
            .collect();
        circle[36].y = 0.0;
        let before = circle.clone();
        assert_eq!(take_off_deck(&mut circle), None);
        assert_eq!(circle, before);
        let mut cambered = line(&[(0.0, 0.0), (5.0, 0.0), (5.0, 6.0), (2.5, 6.15), (0.0, 6.2)]);
        assert!((take_off_deck(&mut cambered).unwrap().centre_height - 6.2).abs() < 1e-15);
        assert_eq!(cambered.len(), 3);
    }

    #[test]
    fn loops_beside_the_centreplane_have_no_halves() {
        assert_eq!(halves(&line(&[(3.0, 0.0), (4.0, 0.0), (4.0, 1.0)])), None);
        assert_eq!(halves(&[]), None);
    }

    #[test]
    fn a_stem_below_a_section_is_no_branch() {
        let half = line(&[(0.0, 0.0), (0.0, 1.0), (0.5, 2.0), (1.0, 3.0)]);
        assert_eq!(branches(half.clone()), [half]);
    }

    #[test]
    fn sections_of_a_grid() {
        let station = StationOffsets {
            half_breadths: [Some(1.0), Some(0.5), None, Some(0.2), Some(0.9)].map(Cell::from).to_vec(),
            keel_height: Some(0.0),
            deck_height: Some(5.0),
            deck_half_breadth: Some(1.1),
            ..StationOffsets::new("1", 0.0)
        };
        let branches = section_of(&station, &[1.0, 2.0, 3.0, 4.0, 4.5]);
        assert_eq!(branches[0], line(&[(0.0, 0.0), (1.0, 1.0), (0.5, 2.0)]));
        assert_eq!(branches[1], line(&[(0.2, 4.0), (0.9, 4.5), (1.1, 5.0)]));
    }
}
