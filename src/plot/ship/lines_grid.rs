//! The grid of a lines plan and the curves in which its planes cut the hull.

use super::{caption, outline};
use crate::fairing::record::TableLines;
use crate::hull::{Branch, Cut, Face, Hull, OffsetStation, StationNumbers, default_buttocks, default_diagonals};
use crate::plot::paper::scale::{decimals, multiples, nice_step, short};

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
pub(in crate::plot) struct GridPlane {
    /// x, z or y of the plane [m]; for a diagonal its height on the centreplane.
    pub(in crate::plot) at: f64,
    /// Short name: `3½`, `WL 2`, `II`, `D1`.
    pub(in crate::plot) name: String,
    /// Connected curves (x, y, z) [m].
    pub(in crate::plot) curves: Vec<Vec<[f64; 3]>>,
    /// How many of them, from the first, lie on the side of the hull; the others on its flats.
    pub(in crate::plot) on_side: usize,
    /// Whether it is none of those that stand between others and yield to them.
    pub(in crate::plot) whole: bool,
    /// Its number in the grid: where there is no room for all, every second, fourth, ... is named.
    pub(in crate::plot) count: i32,
    /// What the curves are chords of.
    branches: Vec<Branch>,
}

/// Stations, waterlines, buttocks and diagonals of a hull.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::plot) struct LinesGrid {
    /// From aft to forward.
    pub(in crate::plot) stations: Vec<GridPlane>,
    /// From the base line up; the design waterline is not among them.
    pub(in crate::plot) waterlines: Vec<GridPlane>,
    /// The design waterline; none where no draught is stated.
    pub(in crate::plot) design_waterline: Option<GridPlane>,
    /// From the centreplane out.
    pub(in crate::plot) buttocks: Vec<GridPlane>,
    /// From the lowest up.
    pub(in crate::plot) diagonals: Vec<GridPlane>,
    /// Angle of the diagonals below the horizontal [rad].
    pub(in crate::plot) diagonal_angle: f64,
    /// Distance of full stations [m].
    pub(in crate::plot) station_spacing: f64,
    /// Distance of waterlines [m].
    pub(in crate::plot) waterline_spacing: f64,
    /// Distance of buttocks [m].
    pub(in crate::plot) buttock_spacing: f64,
    /// Aft and fore end of the hull: x [m].
    pub(in crate::plot) length: [f64; 2],
    /// Lowest and highest point of the hull: z [m].
    pub(in crate::plot) height: [f64; 2],
    /// Largest half-breadth of the deck and of the waterlines [m].
    pub(in crate::plot) half_breadth: f64,
    /// The deck at side (x, y, z) [m].
    pub(in crate::plot) deck: Vec<[f64; 3]>,
    /// Stern and stem line from the keel to the deck (x, y, z) [m].
    pub(in crate::plot) ends: [Vec<[f64; 3]>; 2],
    /// Whether its stations, and its waterlines, are those of a table.
    pub(in crate::plot) of_table: [bool; 2],
    /// Whether stations are numbered in intervals; those of a table may bear their x or their names.
    pub(in crate::plot) numbered: bool,
}

/// Fewest stations and waterlines of a table that make a grid.
const FEWEST: [usize; 2] = [7, 4];
/// Part of the stations of a table that stand at whole intervals, where those alone are main ones; where fewer do, all are,
/// and bear their x.
const MAIN: f64 = 0.35;

/// The name of a station at so many intervals: halves and quarters as such, others with two decimals.
fn interval_name(number: f64) -> String {
    let quarters = (4.0 * number).round();
    if (4.0 * number - quarters).abs() > 1e-6 {
        return format!("{number:.2}");
    }
    match (quarters as i32).rem_euclid(4) {
        part @ (1 | 3) => {
            let sign = if quarters < 0.0 { "-" } else { "" };
            let part = if (part == 1) == (quarters > 0.0) { '¼' } else { '¾' };
            format!("{sign}{}{part}", (quarters.abs() / 4.0).floor())
        }
        _ => station_name((quarters / 2.0).round() as i32),
    }
}

/// A plane of the grid before it is cut: where it is, its name, its number, whether it is whole.
type PlannedPlane = (f64, String, i32, bool);

/// Whether a station stands at a whole interval.
fn is_whole(x: f64, spacing: f64) -> bool {
    (x / spacing - (x / spacing).round()).abs() <= 1e-6
}

/// Whether enough stations of a table do that those alone are main ones.
fn is_regular(lines: &TableLines, ends: [f64; 2], spacing: f64) -> bool {
    let inside = || lines.stations.iter().map(|station| station.x).filter(|x| *x >= ends[0] && *x <= ends[1]);
    inside().filter(|x| is_whole(*x, spacing)).count() as f64 >= MAIN * inside().count() as f64
}

/// The stations of a table between the ends of the hull.
fn table_stations(lines: &TableLines, ends: [f64; 2], spacing: f64, numbers: StationNumbers) -> Vec<PlannedPlane> {
    let slack = INSIDE * (ends[1] - ends[0]);
    let inside = |x: f64| x >= ends[0] - slack && x <= ends[1] + slack;
    let stations: Vec<_> = lines.stations.iter().filter(|station| inside(station.x)).collect();
    let regular = is_regular(lines, ends, spacing);
    let mark = |(k, station): (usize, &&OffsetStation)| {
        let x = station.x;
        let name = if station.is_named_by_place() {
            if regular { interval_name(numbers.number(x / spacing)) } else { short(x) }
        } else {
            caption::plain(&station.name).chars().take(9).collect()
        };
        let count = if regular { (x / spacing).round() as i32 } else { k as i32 };
        (x, name, count, !regular || is_whole(x, spacing))
    };
    stations.iter().enumerate().map(mark).collect()
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
        let longest = (0..plane.on_side).max_by(|a, b| length(&plane.curves[*a]).total_cmp(&length(&plane.curves[*b])));
        let longest = longest.unwrap_or(0);
        plane.curves = vec![plane.curves.swap_remove(longest)];
        plane.branches = vec![plane.branches.swap_remove(longest)];
        plane.on_side = 1;
    }
    plane
}

/// The largest half-breadth of waterlines and deck [m].
fn widest<'a>(waterlines: impl Iterator<Item = &'a GridPlane>, deck: &'a [[f64; 3]]) -> f64 {
    let points = waterlines.flat_map(|plane| plane.curves.iter().flatten()).chain(deck);
    points.map(|point| point[1]).fold(0.0, f64::max)
}

impl LinesGrid {
    /// Cuts the hull, at the stations and waterlines of a table where there is one; chords of the curves stay within
    /// `deviation` [m] of them.
    pub(in crate::plot) fn new(
        hull: &Hull,
        deviation: f64,
        numbers: StationNumbers,
        table: Option<&TableLines>,
    ) -> Self {
        let p = hull.particulars();
        let marked = |(at, name, count, whole): PlannedPlane, cut: Cut| {
            let branches = hull.section(cut, TOLERANCE).branches;
            let on_side = branches.iter().take_while(|branch| branch.face == Face::Side).count();
            let curves = branches.iter().map(|b| b.polyline(deviation)).collect();
            GridPlane { at, name, curves, on_side, whole, count, branches }
        };
        let plane = |at: f64, name: String, cut: Cut| marked((at, name, 0, true), cut);
        let deck = outline::deck_at_side(hull);
        let ends = [outline::end_profile(hull, false), outline::end_profile(hull, true)];
        let length = outline::overall_length(hull);
        let top = deck.iter().map(|point| point[2]).fold(hull.reference_height(), f64::max);
        let height = [hull.bottom(), top];

        let station_spacing = numbers.spacing(p.length_between_perpendiculars);
        let by_number = |halves: i32| {
            let number = numbers.number(0.5 * f64::from(halves));
            let name = station_name((2.0 * number).round() as i32);
            (0.5 * f64::from(halves) * station_spacing, name, halves / 2, halves % 2 == 0)
        };
        let of_table = table.map(|lines| table_stations(lines, length, station_spacing, numbers));
        let of_table = of_table.filter(|stations| stations.len() >= FEWEST[0]);
        let has_stations = of_table.is_some();
        let in_intervals = |lines: &TableLines| {
            lines.stations.iter().any(OffsetStation::is_named_by_place) && is_regular(lines, length, station_spacing)
        };
        let numbered = !has_stations || table.is_some_and(in_intervals);
        let marks = of_table.unwrap_or_else(|| {
            let [aft, fore] = length.map(|x| x / station_spacing);
            station_numbers(numbers.spaces as i32, aft, fore).into_iter().map(by_number).collect()
        });
        let stations = marks
            .into_iter()
            .map(|mark| {
                let x = mark.0;
                let found = marked(mark, Cut::Station { x });
                let ended = length.iter().any(|end| (x - end).abs() <= INSIDE * (length[1] - length[0]));
                if ended { in_one_piece(found) } else { found }
            })
            .collect();
        let waterline_spacing = nice_step(hull.reference_height(), 8.0);
        let known = table.map(|lines| {
            let inside = |z: &f64| *z >= height[0] - 1e-9 && *z <= height[1] + 1e-9;
            lines.waterlines.iter().copied().filter(inside).collect::<Vec<f64>>()
        });
        let known = known.filter(|heights| heights.len() >= FEWEST[1]);
        let has_waterlines = known.is_some();
        let marks: Vec<PlannedPlane> = match known {
            Some(heights) => {
                let mark = |(k, z): (usize, f64)| (z, format!("WL {}", short(z)), k as i32, true);
                heights.into_iter().enumerate().map(mark).collect()
            }
            // One half waterline at the bilge.
            None => multiples(0.5 * waterline_spacing, height[0], height[1])
                .into_iter()
                .map(|z| (z, (2.0 * z / waterline_spacing).round() as i32))
                .filter(|(_, halves)| halves % 2 == 0 || *halves == 1)
                .map(|(z, halves)| (z, format!("WL {}", numeral(halves)), halves / 2, halves % 2 == 0))
                .collect(),
        };
        let waterlines: Vec<_> = marks
            .into_iter()
            .filter(|mark| p.draught.is_none_or(|draught| (mark.0 - draught).abs() > 1e-6 * waterline_spacing))
            .map(|mark| {
                let z = mark.0;
                marked(mark, Cut::Waterline { z })
            })
            .collect();
        let design_waterline = p.draught.map(|z| plane(z, "DWL".to_owned(), Cut::Waterline { z }));
        let half_breadth = widest(waterlines.iter().chain(&design_waterline), &deck);
        // Those of the tables of heights.
        let distances = default_buttocks(hull);
        let buttock_spacing = distances.first().copied().unwrap_or(0.5 * p.breadth);
        let buttocks =
            distances.into_iter().enumerate().map(|(k, y)| plane(y, roman(k + 1), Cut::Buttock { y })).collect();
        let (heights, diagonal_angle) = default_diagonals(hull);
        let diagonals = heights
            .into_iter()
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
            of_table: [has_stations, has_waterlines],
            numbered,
        }
    }

    /// Whether a plane is that of the design waterline.
    pub(in crate::plot) fn is_design(&self, plane: &GridPlane) -> bool {
        self.design_waterline.as_ref().is_some_and(|design| design.name == plane.name)
    }

    /// The same planes with curves whose chords stay within another `deviation` [m].
    pub(in crate::plot) fn refined(mut self, deviation: f64) -> Self {
        let Self { stations, waterlines, design_waterline, buttocks, diagonals, .. } = &mut self;
        let lists = [stations, waterlines, buttocks, diagonals].into_iter().flatten();
        for plane in lists.chain(design_waterline) {
            plane.curves = plane.branches.iter().map(|branch| branch.polyline(deviation)).collect();
        }
        self.half_breadth = widest(self.waterlines.iter().chain(&self.design_waterline), &self.deck);
        self
    }

    /// Name and height of a waterline: `WL 3  1.50 m`.
    pub(in crate::plot) fn waterline_label(&self, plane: &GridPlane) -> String {
        if self.of_table[1] && !self.is_design(plane) {
            return format!("{} m", plane.name);
        }
        let step = if plane.whole { self.waterline_spacing } else { 0.5 * self.waterline_spacing };
        format!("{}  {:.*} m", plane.name, decimals(step).max(2), plane.at)
    }

    /// Name and distance of a buttock: `II  3.0 m`.
    pub(in crate::plot) fn buttock_label(&self, plane: &GridPlane) -> String {
        format!("{}  {:.*} m", plane.name, decimals(self.buttock_spacing).max(1), plane.at)
    }

    /// A point of a diagonal in its true shape: x, and the distance from the centreplane along the plane [m].
    pub(in crate::plot) fn expanded(point: &[f64; 3], height: f64) -> [f64; 2] {
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
    fn stations_of_tables_are_numbered_in_intervals() {
        for (number, text) in
            [(0.0, "0"), (0.5, "0½"), (0.25, "0¼"), (19.75, "19¾"), (-0.25, "-0¼"), (-0.5, "-½"), (20.0845, "20.08")]
        {
            assert_eq!(interval_name(number), text);
        }
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
