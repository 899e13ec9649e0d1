//! The ends of the hull: where sections shrink to a point, where the hull is cut off, and which ends are blunt.

use super::length::Blunt;
use super::profile::{Profile, SectionPoint};
use crate::hull::OffsetTable;

/// A bow that is not in the table is carried on over at most this many times the last space between stations.
const REACH: f64 = 1.5;

/// Half-breadth of a point, in parts of the greatest one.
const POINTED: f64 = 1e-6;

/// Closes the hull at its ends.
///
/// A section with breadth at an end of the table is the transom, or a flat bow, unless the ends of the waterlines tell
/// where the profile reaches the upper edge. At the fore end a section that narrows is carried on along keel line and
/// upper edge to the point in which they meet, when that is within a space and a half.
pub(in crate::hull::fit) fn close(table: &OffsetTable, profiles: &mut Vec<Profile>, notes: &mut Vec<String>) {
    let breadth = profiles.iter().map(Profile::breadth).fold(0.0, f64::max);
    for fore in [false, true] {
        let end = if fore { &profiles[profiles.len() - 1] } else { &profiles[0] };
        let (x, wide) = (end.x, end.breadth() > POINTED * breadth);
        let name = if fore { "fore" } else { "aft" };
        let point = profile_end(table, end, fore).or_else(|| {
            if fore && wide { stem(profiles) } else { None }.inspect(|[at, _]| {
                notes.push(format!(
                    "the stem was put at x = {at:.3} m, where keel line and upper edge of the last stations meet when carried on"
                ));
            })
        });
        match point {
            Some([at, z]) => {
                let tip = Profile { x: at, station: None, points: vec![SectionPoint { z, y: Some(0.0), mark: None }] };
                profiles.insert(if fore { profiles.len() } else { 0 }, tip);
            }
            None if wide => notes.push(format!("the hull is cut off upright at its {name} end, x = {x:.3} m")),
            None => {}
        }
    }
}

/// Where the profile reaches the upper edge, from the ends of the waterlines: (x, z) beyond the last section.
fn profile_end(table: &OffsetTable, last: &Profile, fore: bool) -> Option<[f64; 2]> {
    let slack = 1e-6 * (1.0 + last.top().abs());
    let (z, end) = table
        .waterlines
        .iter()
        .zip(&table.endings)
        .filter_map(|(&z, ends)| Some((z, ends[usize::from(fore)]?)))
        .max_by(|a, b| a.0.total_cmp(&b.0))?;
    let beyond = if fore { end - last.x } else { last.x - end };
    (beyond > slack && z >= last.top() - slack).then_some([end, z])
}

/// The tip of the stem beyond the last section.
fn stem(profiles: &[Profile]) -> Option<[f64; 2]> {
    let outermost = |p: &Profile| Outermost { x: p.x, keel: p.keel(), top: p.top(), breadth: p.breadth() };
    let [.., before, end] = profiles else { return None };
    carried_on(outermost(before), outermost(end))
}

/// A section by its keel, its upper edge and its greatest half-breadth \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outermost {
    /// Position forward of AP.
    pub x: f64,
    /// Height of the keel.
    pub keel: f64,
    /// Height of the upper edge.
    pub top: f64,
    /// Greatest half-breadth.
    pub breadth: f64,
}

/// Where keel line and upper edge meet \[m\], (x, z), carried on straight beyond the last of two sections; none where that is
/// more than a space and a half away, or the hull would still be broad there.
#[must_use]
pub fn carried_on(before: Outermost, end: Outermost) -> Option<[f64; 2]> {
    let [height, higher] = [end.top - end.keel, before.top - before.keel];
    if !(height > 0.0 && higher > height && before.breadth > end.breadth) {
        return None;
    }
    let spaces = height / (higher - height);
    let left = end.breadth - spaces * (before.breadth - end.breadth);
    let at = [end.x + spaces * (end.x - before.x), end.top + spaces * (end.top - before.top)];
    (spaces <= REACH && left <= 0.5 * end.breadth).then_some(at)
}

/// Ends at which half-breadths grow like the square root of the distance, by the exponent between the two stations next
/// to them.
pub(in crate::hull::fit) fn blunt(profiles: &[Profile]) -> Blunt {
    let greatest = profiles.iter().map(Profile::breadth).fold(0.0, f64::max);
    let is_blunt = |end: &Profile, next: Option<&Profile>, second: Option<&Profile>| {
        let (Some(next), Some(second)) = (next, second) else { return false };
        let (near, far) = (next.breadth(), second.breadth());
        if end.breadth() > POINTED * greatest || near <= 0.0 || far <= near {
            return false;
        }
        (far / near).ln() / ((second.x - end.x) / (next.x - end.x)).ln() < 0.75
    };
    let count = profiles.len();
    Blunt {
        aft: is_blunt(&profiles[0], profiles.get(1), profiles.get(2)),
        fore: is_blunt(
            &profiles[count - 1],
            count.checked_sub(2).map(|k| &profiles[k]),
            count.checked_sub(3).map(|k| &profiles[k]),
        ),
    }
}
