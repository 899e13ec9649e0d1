//! The control polygon's signs.
//!
//! Each inner vertex of a row or column of the net is + where it lies outboard of the chord of its two neighbours, -
//! where it lies inboard, and 0 where it lies on it. The rule (ITS Surabaya 1999): a row is fair when the sign changes
//! seldom and no sign is enclosed by two opposite ones. The curve of a row is convex where its signs do not change
//! (variation diminishing: it has no more inflections than its polygon).
//!
//! Rows are the lines v = constant, looked at from above (x, y); columns the lines u = constant, looked at along the ship
//! (z, y).

use crate::spline::BsplineSurface;

/// A vertex within this part of the tolerance of the chord counts as on it.
pub const ON_CHORD: f64 = 0.1;

/// Side of a vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Outboard of the chord of its neighbours, `+`.
    Outboard,
    /// On it, `0`.
    On,
    /// Inboard of it, `-`.
    Inboard,
}

impl Side {
    /// `+`, `0` or `-`.
    #[must_use]
    pub fn as_char(self) -> char {
        match self {
            Self::Outboard => '+',
            Self::On => '0',
            Self::Inboard => '-',
        }
    }
}

/// Which way a line of the net runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NetLine {
    /// v = constant, from aft to forward.
    Row,
    /// u = constant, from bottom to top.
    Column,
}

impl NetLine {
    /// `row` or `column`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Row => "row",
            Self::Column => "column",
        }
    }
}

/// The signs of one row or column of the net.
#[derive(Debug, Clone, PartialEq)]
pub struct PolygonSigns {
    /// Row or column.
    pub line: NetLine,
    /// Its number in the net, from 0.
    pub index: usize,
    /// Mean height of a row, mean x of a column \[m\].
    pub at: f64,
    /// One sign an inner vertex.
    pub signs: Vec<Side>,
    /// Changes from + to - or back; zeros between are skipped.
    pub changes: usize,
    /// Single signs between two opposite ones; zeros between are skipped.
    pub enclosed: usize,
}

impl PolygonSigns {
    /// The signs in order, as `+-0+`.
    #[must_use]
    pub fn text(&self) -> String {
        self.signs.iter().map(|side| side.as_char()).collect()
    }
}

/// Signs of a polygon of (abscissa, half-breadth); vertices at most `zero` off the chord are on it.
#[must_use]
pub fn polygon_signs(polygon: &[[f64; 2]], zero: f64) -> Vec<Side> {
    polygon
        .windows(3)
        .map(|p| {
            let (chord, arm) = ([p[2][0] - p[0][0], p[2][1] - p[0][1]], [p[1][0] - p[0][0], p[1][1] - p[0][1]]);
            let length = chord[0].hypot(chord[1]);
            let off = if length > 0.0 { (chord[0] * arm[1] - chord[1] * arm[0]) / length } else { arm[1] };
            if off.abs() <= zero {
                Side::On
            } else if off > 0.0 {
                Side::Outboard
            } else {
                Side::Inboard
            }
        })
        .collect()
}

/// Numbers of changes and of enclosed signs.
#[must_use]
pub fn changes_and_enclosed(signs: &[Side]) -> (usize, usize) {
    let kept: Vec<Side> = signs.iter().copied().filter(|side| *side != Side::On).collect();
    let changes = kept.windows(2).filter(|pair| pair[0] != pair[1]).count();
    let enclosed = kept.windows(3).filter(|three| three[0] == three[2] && three[0] != three[1]).count();
    (changes, enclosed)
}

fn report(line: NetLine, index: usize, at: f64, polygon: &[[f64; 2]], zero: f64) -> PolygonSigns {
    let signs = polygon_signs(polygon, zero);
    let (changes, enclosed) = changes_and_enclosed(&signs);
    PolygonSigns { line, index, at, signs, changes, enclosed }
}

/// The signs of every row and column of a net of (x, y, z); vertices at most `zero` \[m\] off the chord are on it.
#[must_use]
pub fn net_signs(surface: &BsplineSurface<3>, zero: f64) -> Vec<PolygonSigns> {
    let [rows, columns] = surface.shape();
    let mean = |points: &[[f64; 3]], d: usize| points.iter().map(|p| p[d]).sum::<f64>() / points.len() as f64;
    let along_u = (0..columns).map(|j| {
        let points: Vec<[f64; 3]> = (0..rows).map(|i| surface.point(i, j)).collect();
        let polygon: Vec<[f64; 2]> = points.iter().map(|p| [p[0], p[1]]).collect();
        report(NetLine::Row, j, mean(&points, 2), &polygon, zero)
    });
    let along_v = (0..rows).map(|i| {
        let points: Vec<[f64; 3]> = (0..columns).map(|j| surface.point(i, j)).collect();
        let polygon: Vec<[f64; 2]> = points.iter().map(|p| [p[2], p[1]]).collect();
        report(NetLine::Column, i, mean(&points, 0), &polygon, zero)
    });
    along_u.chain(along_v).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(polygon: &[[f64; 2]]) -> String {
        polygon_signs(polygon, 1e-6).iter().map(|side| side.as_char()).collect()
    }

    #[test]
    fn signs_of_the_seven_vertices_of_a_zigzag() {
        let zigzag: Vec<[f64; 2]> = (0..9).map(|i| [f64::from(i), if i % 2 == 1 { 0.1 } else { 0.0 }]).collect();
        assert_eq!(text(&zigzag), "+-+-+-+");
        assert_eq!(changes_and_enclosed(&polygon_signs(&zigzag, 1e-6)), (6, 5));
    }

    #[test]
    fn a_hollow_end_changes_once_and_encloses_nothing() {
        let polygon: Vec<[f64; 2]> = (0..=10).map(|i| [f64::from(i), (0.3 * f64::from(i)).cos()]).collect();
        // The cosine turns hollow past pi / 2, at 5.2.
        assert_eq!(text(&polygon), "+++++----");
        assert_eq!(changes_and_enclosed(&polygon_signs(&polygon, 1e-6)), (1, 0));
    }

    #[test]
    fn a_straight_piece_is_zero_and_does_not_count() {
        let polygon = [[0.0, 0.0], [1.0, 1.0], [2.0, 1.5], [3.0, 1.5], [4.0, 1.5], [5.0, 1.0], [6.0, 0.0]];
        assert_eq!(text(&polygon), "++0++");
        assert_eq!(changes_and_enclosed(&polygon_signs(&polygon, 1e-6)), (0, 0));
        // A polygon that runs straight across, as on a flat of bottom.
        assert_eq!(text(&[[0.0, 0.0], [0.0, 1.0], [0.0, 2.0], [1.0, 2.0]]), "0+");
    }
}
