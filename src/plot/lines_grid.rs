//! The grid of a lines plan and the curves in which its planes cut the hull.

use super::outline;
use super::scale::{decimals, multiples, nice_step};
use crate::hull::{Cut, Face, Hull, StationNumbers, default_buttocks};

/// Stations closer than this to the perpendiculars stand at half intervals [intervals].
const HALF_STATIONS: i32 = 2;
/// With more spaces only every second, third, ... station is drawn.
const MOST_SPACES: i32 = 40;
/// How near a station is to an end of the hull that it stands at, in lengths of the hull.
const INSIDE: f64 = 1e-4;
/// Deviation of a section from surface and plane [m].
const TOLERANCE: f64 = 1e-6;

/// A plane of the grid with its name and the curves in which it cuts one side of the hull.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct GridPlane {
    /// x, z or y of the plane [m]; for a diagonal its height on the centreplane.
    pub(super) at: f64,
    /// Short name: `3½`, `WL 2`, `II`, `D1`.
    pub(super) name: String,
    /// Connected curves (x, y, z) [m].
    pub(super) curves: Vec<Vec<[f64; 3]>>,
    /// How many of them, from the first, lie on the side of the hull; the others on its flats.
    pub(super) on_side: usize,
}

/// Stations, waterlines, buttocks and diagonals of a hull.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LinesGrid {
    /// From aft to forward.
    pub(super) stations: Vec<GridPlane>,
    /// From the base line up; the design waterline is not among them.
    pub(super) waterlines: Vec<GridPlane>,
    /// The design waterline.
    pub(super) design_waterline: GridPlane,
    /// From the centreplane out.
    pub(super) buttocks: Vec<GridPlane>,
    /// From the lowest up.
    pub(super) diagonals: Vec<GridPlane>,
    /// Angle of the diagonals below the horizontal [rad].
    pub(super) diagonal_angle: f64,
    /// Distance of full stations [m].
    pub(super) station_spacing: f64,
    /// Distance of waterlines [m].
    pub(super) waterline_spacing: f64,
    /// Distance of buttocks [m].
    pub(super) buttock_spacing: f64,
    /// Aft and fore end of the hull: x [m].
    pub(super) length: [f64; 2],
    /// Lowest and highest point of the hull: z [m].
    pub(super) height: [f64; 2],
    /// Largest half-breadth of the deck and of the waterlines [m].
    pub(super) half_breadth: f64,
    /// The deck at side (x, y, z) [m].
    pub(super) deck: Vec<[f64; 3]>,
    /// Stern and stem line from the keel to the deck (x, y, z) [m].
    pub(super) ends: [Vec<[f64; 3]>; 2],
}

/// `halves` halves: 3 is `1½`.
fn numeral(halves: i32) -> String {
    let sign = if halves < 0 { "-" } else { "" };
    let (whole, half) = (halves.abs() / 2, halves.abs() % 2 == 1);
    match (whole, half) {
        (0, true) => format!("{sign}½"),
        (_, true) => format!("{sign}{whole}½"),
        _ => format!("{sign}{whole}"),
    }
}

/// The same with the nought of a half alone, which beside other names would be read as a half of one of them: 1 is `0½`.
fn station_name(halves: i32) -> String {
    if halves == 1 { "0½".to_owned() } else { numeral(halves) }
}

/// Roman numerals up to 39.
fn roman(number: usize) -> String {
    let units = ["", "I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX"];
    format!("{}{}", "X".repeat(number / 10), units[number % 10])
}

/// The stations, in half intervals from AP, that a hull between `aft` and `fore` (in intervals from AP) has.
fn station_numbers(spaces: i32, aft: f64, fore: f64) -> Vec<i32> {
    let every = 2 * ((spaces + MOST_SPACES - 1) / MOST_SPACES).max(1);
    (-2 * spaces..=4 * spaces)
        .filter(|halves| {
            let inside = (2 * HALF_STATIONS..=2 * (spaces - HALF_STATIONS)).contains(halves);
            let at = 0.5 * f64::from(*halves);
            at >= aft && at <= fore && (halves % every == 0 || every == 2 && !inside)
        })
        .collect()
}

/// A station at an end of the hull that is a plane at its waterlines alone goes in and out of that plane: its longest
/// piece stays.
fn in_one_piece(mut plane: GridPlane) -> GridPlane {
    if plane.on_side > 1 {
        let length =
            |curve: &Vec<[f64; 3]>| curve.windows(2).map(|w| (w[1][1] - w[0][1]).hypot(w[1][2] - w[0][2])).sum::<f64>();
        plane.curves.truncate(plane.on_side);
        plane.curves.sort_by(|a, b| length(b).total_cmp(&length(a)));
        plane.curves.truncate(1);
        plane.on_side = 1;
    }
    plane
}

impl LinesGrid {
    /// Cuts the hull; chords of the curves stay within `deviation` [m] of them.
    pub(super) fn new(hull: &Hull, deviation: f64, numbers: StationNumbers) -> Self {
        let p = hull.particulars();
        let plane = |at: f64, name: String, cut: Cut| {
            let branches = hull.section(cut, TOLERANCE).branches;
            let on_side = branches.iter().take_while(|branch| branch.face == Face::Side).count();
            GridPlane { at, name, curves: branches.iter().map(|b| b.polyline(deviation)).collect(), on_side }
        };
        let deck = outline::deck_at_side(hull);
        let ends = [outline::end_profile(hull, false), outline::end_profile(hull, true)];
        let length = outline::overall_length(hull);
        let top = deck.iter().map(|point| point[2]).fold(p.draught, f64::max);
        let height = [hull.bottom(), top];

        let station_spacing = numbers.spacing(p.length_between_perpendiculars);
        let stations = station_numbers(numbers.spaces as i32, length[0] / station_spacing, length[1] / station_spacing)
            .into_iter()
            .map(|halves| {
                let x = 0.5 * f64::from(halves) * station_spacing;
                let number = numbers.number(0.5 * f64::from(halves));
                let found = plane(x, station_name((2.0 * number).round() as i32), Cut::Station { x });
                let ended = length.iter().any(|end| (x - end).abs() <= INSIDE * (length[1] - length[0]));
                if ended { in_one_piece(found) } else { found }
            })
            .collect();
        let waterline_spacing = nice_step(p.draught, 8.0);
        // One half waterline at the bilge.
        let waterlines: Vec<_> = multiples(0.5 * waterline_spacing, height[0], height[1])
            .into_iter()
            .filter(|z| (z - p.draught).abs() > 1e-6 * waterline_spacing)
            .map(|z| (z, (2.0 * z / waterline_spacing).round() as i32))
            .filter(|(_, halves)| halves % 2 == 0 || *halves == 1)
            .map(|(z, halves)| plane(z, format!("WL {}", numeral(halves)), Cut::Waterline { z }))
            .collect();
        let design_waterline = plane(p.draught, "DWL".to_owned(), Cut::Waterline { z: p.draught });
        let half_breadth = waterlines
            .iter()
            .chain([&design_waterline])
            .flat_map(|plane| plane.curves.iter().flatten())
            .chain(&deck)
            .map(|point| point[1])
            .fold(0.0, f64::max);
        // Those of the tables of heights.
        let distances = default_buttocks(hull);
        let buttock_spacing = distances.first().copied().unwrap_or(0.5 * p.breadth);
        let buttocks =
            distances.into_iter().enumerate().map(|(k, y)| plane(y, roman(k + 1), Cut::Buttock { y })).collect();
        let diagonal_angle = p.draught.atan2(0.5 * p.breadth);
        let diagonals = [0.7, 1.0, 1.3]
            .into_iter()
            .map(|part| part * p.draught)
            .filter(|&height| height < p.depth)
            .enumerate()
            .map(|(k, height)| plane(height, format!("D{}", k + 1), Cut::Diagonal { height, angle: diagonal_angle }))
            .collect();
        Self {
            stations,
            waterlines,
            design_waterline,
            buttocks,
            diagonals,
            diagonal_angle,
            station_spacing,
            waterline_spacing,
            buttock_spacing,
            length,
            height,
            half_breadth,
            deck,
            ends,
        }
    }

    /// Name and height of a waterline: `WL 3  1.50 m`.
    pub(super) fn waterline_label(&self, plane: &GridPlane) -> String {
        let is_half = plane.name.contains('½');
        let step = if is_half { 0.5 * self.waterline_spacing } else { self.waterline_spacing };
        format!("{}  {:.*} m", plane.name, decimals(step).max(2), plane.at)
    }

    /// Name and distance of a buttock: `II  3.0 m`.
    pub(super) fn buttock_label(&self, plane: &GridPlane) -> String {
        format!("{}  {:.*} m", plane.name, decimals(self.buttock_spacing).max(1), plane.at)
    }

    /// A point of a diagonal in its true shape: x, and the distance from the centreplane along the plane [m].
    pub(super) fn expanded(point: &[f64; 3], height: f64) -> [f64; 2] {
        [point[0], point[1].hypot(point[2] - height)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_stations_stand_at_the_ends() {
        let names: Vec<_> = station_numbers(20, -0.3, 20.6).into_iter().map(station_name).collect();
        let first = ["0", "0½", "1", "1½", "2", "3"];
        assert_eq!(names[..6], first);
        assert_eq!(names[names.len() - 6..], ["18", "18½", "19", "19½", "20", "20½"]);
        assert_eq!(numeral(-3), "-1½");
    }

    #[test]
    fn numerals_of_buttocks() {
        for (number, text) in [(1, "I"), (4, "IV"), (9, "IX"), (14, "XIV")] {
            assert_eq!(roman(number), text);
        }
    }

    #[test]
    fn diagonals_are_expanded_to_their_true_distance() {
        let [x, s] = LinesGrid::expanded(&[7.0, 3.0, 1.0], 5.0);
        assert!((x - 7.0).abs() < 1e-15 && (s - 5.0).abs() < 1e-15);
    }
}
