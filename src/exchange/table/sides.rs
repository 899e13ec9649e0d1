//! Points of sections that stand on the other side of the centreplane, or on both.

use super::problem::Problems;
use crate::units::counted;
use std::collections::BTreeSet;

/// Two sides are one hull where they differ by no more than this part of the breadth.
const ALIKE: f64 = 1e-3;

/// What a list of points [x, y, z] has to become for one side with positive half-breadths.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Sides {
    /// Nothing changes; a reader says what is wrong.
    Kept,
    /// All half-breadths change their sign.
    Turned,
    /// These points are on the other side too.
    Doubled(BTreeSet<usize>),
}

/// The sides of points, with a note where they change.
pub(super) fn sides(points: &[[f64; 3]], problems: &mut Problems) -> Sides {
    let largest = points.iter().map(|[_, y, _]| y.abs()).fold(0.0, f64::max);
    let beyond = ALIKE * largest;
    let negative = points.iter().filter(|[_, y, _]| *y < -beyond).count();
    if negative == 0 {
        return Sides::Kept;
    }
    if points.iter().all(|[_, y, _]| *y <= beyond) {
        problems.note("all half-breadths are negative (starboard side); their sign is turned".to_owned());
        return Sides::Turned;
    }
    // Points by their places, to find the one across.
    let key = |[x, y, z]: [f64; 3]| [x, z, y].map(|value| (value / (2.0 * beyond)).round() as i64);
    let known: BTreeSet<[i64; 3]> = points.iter().map(|point| key(*point)).collect();
    let has_other = |[x, y, z]: [f64; 3]| {
        let [x, z, y] = key([x, -y, z]);
        (-1..=1).any(|by| known.contains(&[x, z, y + by]))
    };
    if !points.iter().all(|point| has_other(*point)) {
        return Sides::Kept;
    }
    let mut seen: BTreeSet<[i64; 3]> = BTreeSet::new();
    let doubled = points.iter().enumerate().filter(|(_, point)| {
        // A point on the centreplane stands in the half of each side.
        point[1] < -beyond || point[1].abs() <= beyond && !seen.insert(key(**point))
    });
    let doubled: BTreeSet<usize> = doubled.map(|(k, _)| k).collect();
    problems.note(format!(
        "both sides are given and alike: {} of the other side left out",
        counted(doubled.len(), "point")
    ));
    Sides::Doubled(doubled)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_side_is_left() {
        let of = |points: &[[f64; 3]]| sides(points, &mut Problems::new("points.csv"));
        assert_eq!(of(&[[0.0, 1.0, 0.0], [0.0, 2.0, 1.0]]), Sides::Kept);
        assert_eq!(of(&[[0.0, -1.0, 0.0], [0.0, -2.0, 1.0], [0.0, 0.0, 0.0]]), Sides::Turned);
        let both = [[0.0, -2.0, 1.0], [0.0, 0.0, 0.0], [0.0, 2.0, 1.0], [0.0, 0.0, 0.0]];
        assert_eq!(of(&both), Sides::Doubled(BTreeSet::from([0, 3])));
        assert_eq!(of(&[[0.0, -2.0, 1.0], [0.0, 1.0, 1.0]]), Sides::Kept);
    }
}
