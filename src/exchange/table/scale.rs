//! Units and origins: from what a table declares, and else from the size of its numbers.

use super::header::{Coordinate, Corner, From, Position};
use super::numbering::Datum;
use super::problem::{Field, FilePosition, Problems};
use super::settings::{Settings, metres};
use crate::hull::StationDatum;
use crate::units::{CellEntry, CellReading, CellRules, CellWriting, Notation, parse_cell};

/// No half-breadth is larger \[m\]; larger plain numbers are millimetres.
pub(super) const LARGEST_HALF_BREADTH: f64 = 120.0;
/// No waterline is higher \[m\].
pub(super) const LARGEST_HEIGHT: f64 = 120.0;
/// No hull is longer \[m\].
pub(super) const LARGEST_LENGTH: f64 = 1000.0;
/// Heights and lengths in half-breadths, as most ships have them.
const USUAL_HEIGHT: f64 = 1.0;
const USUAL_LENGTH: f64 = 12.0;
/// Numbers smaller than this, with decimals, are no millimetres.
const SMALLEST_MILLIMETRES: f64 = 25.0;

/// What plain numbers of a kind look like.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Size {
    /// Largest absolute plain number, and how many there are.
    pub(super) largest: f64,
    pub(super) plain: usize,
    /// Digits after the decimal sign at most.
    pub(super) decimals: usize,
    /// Cells in feet, inches and eighths.
    pub(super) eighths: usize,
}

impl Size {
    /// The size of the offsets in `cells`; what cannot be read is reported later.
    pub(super) fn of<'f>(cells: impl Iterator<Item = &'f Field>, decimal_comma: bool) -> Self {
        let rules = CellRules { unit: Notation::Metres, decimal_comma };
        let mut size = Self::default();
        for field in cells {
            match parse_cell(&field.text, rules) {
                Ok(CellReading {
                    entry: CellEntry::Length(value), writing: CellWriting::Plain { decimals }, ..
                }) => {
                    size.largest = size.largest.max(value.abs());
                    size.plain += 1;
                    size.decimals = size.decimals.max(decimals);
                }
                Ok(CellReading { writing: CellWriting::Eighths, .. }) => size.eighths += 1,
                _ => {}
            }
        }
        size
    }

    /// The size of plain positions.
    pub(super) fn of_positions<'p>(positions: impl Iterator<Item = &'p Position>) -> Self {
        let mut size = Self::default();
        for position in positions {
            if let Some(value) = position.number() {
                size.largest = size.largest.max(value.abs());
                size.plain += 1;
            }
        }
        size
    }
}

/// The units of the three directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Units {
    pub(super) x: Notation,
    pub(super) y: Notation,
    pub(super) z: Notation,
}

/// The units of a table. `stations_are_numbers` keeps their positions out of it.
pub(super) fn units(
    settings: &Settings,
    corner: Corner,
    [x, y, z]: [Size; 3],
    stations_are_numbers: bool,
    problems: &mut Problems,
) -> Units {
    let both = corner.rows.is_some() && corner.columns.is_some();
    let declared = settings.units.or(corner.unit);
    let offsets = declared.unwrap_or_else(|| {
        if y.eighths > 0 {
            Notation::FeetInchesEighths
        } else if y.largest > LARGEST_HALF_BREADTH || beyond(y, z, x, stations_are_numbers) {
            undeclared(y.largest, "millimetres", problems);
            Notation::Millimetres
        } else if y.plain > 0 {
            undeclared(y.largest, "metres", problems);
            Notation::Metres
        } else {
            // Half-breadths with units of their own say nothing of plain positions beside them.
            let plain = if stations_are_numbers { 0.0 } else { x.largest }.max(z.largest);
            if plain > 0.0 {
                let message = format!("no unit is declared; positions up to {plain} are taken as metres");
                problems.warning("W320", FilePosition::FILE, message, OTHER_UNIT);
            }
            Notation::Metres
        }
    });
    let x_unit = settings.x_units.or(corner.x_unit).or(corner.unit);
    let z_unit = settings.z_units.or(corner.unit.filter(|_| both));
    let possible = |unit: Option<Notation>, size: Size, largest: f64, usual: f64| {
        let length = unit.or(declared).unwrap_or(Notation::Metres).metres(size.largest);
        (length > 0.0 && length <= largest).then_some(length / usual)
    };
    let by_length = || possible(x_unit, x, LARGEST_LENGTH, USUAL_LENGTH).filter(|_| !stations_are_numbers);
    if declared.is_some() {
        let usual = possible(z_unit, z, LARGEST_HEIGHT, USUAL_HEIGHT).or_else(by_length);
        let (unit, size, largest) = (offsets, y, LARGEST_HALF_BREADTH);
        Contradiction { what: "half-breadth", key: "units", unit, size, largest, usual }.report(problems);
    }
    let half_breadth = possible(declared, y, LARGEST_HALF_BREADTH, 1.0);
    let mut positions = |what: &'static str, own: Option<Notation>, size: Size, largest: f64, usual: f64| {
        let unit = own.unwrap_or_else(|| {
            let same = if offsets == Notation::FeetInchesEighths { Notation::Feet } else { offsets };
            let metres = match declared {
                // Without a declaration each direction is judged by its size.
                None => nearer_in_metres(size.largest, 1e-3 * y.largest, usual),
                Some(_) => !both,
            };
            // Centimetres may be those of a model: the size of the half-breadths tells it.
            let off = |length: f64| (length / (usual * same.metres(y.largest))).ln().abs();
            let centimetres = same == Notation::Centimetres && off(size.largest) < off(same.metres(size.largest));
            let is_small = same == Notation::Millimetres && metres || centimetres && declared.is_some() && !both;
            if is_small && size.largest <= largest && size.plain > 0 {
                let message =
                    format!("half-breadths are {}; {what}s up to {} are taken as metres", name(same), size.largest);
                problems.warning("W320", FilePosition::FILE, message, OTHER_UNIT);
                Notation::Metres
            } else if declared.is_none() && same == Notation::Metres && size.largest > largest {
                let message =
                    format!("half-breadths are metres; {what}s up to {} are taken as millimetres", size.largest);
                problems.warning("W320", FilePosition::FILE, message, OTHER_UNIT);
                Notation::Millimetres
            } else {
                same
            }
        });
        if own.or(declared).is_some() {
            let key = if what == "height" { "z_units" } else { "x_units" };
            let usual = half_breadth.map(|half_breadth| usual * half_breadth);
            Contradiction { what, key, unit, size, largest, usual }.report(problems);
        }
        unit
    };
    let z = positions("height", z_unit, z, LARGEST_HEIGHT, USUAL_HEIGHT);
    let own = x_unit;
    let x = if stations_are_numbers {
        own.unwrap_or(offsets)
    } else {
        positions("distance", own, x, LARGEST_LENGTH, USUAL_LENGTH)
    };
    Units { x, y: offsets, z }
}

/// Says that nothing states the unit of half-breadths.
fn undeclared(largest: f64, unit: &str, problems: &mut Problems) {
    let message = format!("no unit is declared; half-breadths up to {largest} are taken as {unit}");
    problems.warning("W320", FilePosition::FILE, message, UNIT);
}

/// What settles that of positions.
const OTHER_UNIT: &str = "Give x_units and z_units in the conventions";

/// What settles the unit.
pub(super) const UNIT: &str = "Give units in the conventions, as units = \"m\", or --input-unit";

/// Whether positions up to `largest` are nearer to `usual` half-breadths \[m\] as metres than as millimetres.
fn nearer_in_metres(largest: f64, half_breadth: f64, usual: f64) -> bool {
    let off = |length: f64| (length / (usual * half_breadth)).ln().abs();
    !(largest > 0.0 && half_breadth > 0.0) || off(largest) <= off(1e-3 * largest)
}

/// Whether half-breadths are beyond any ship against its height and, where it is known, its length: they have another
/// unit.
fn beyond(y: Size, z: Size, x: Size, stations_are_numbers: bool) -> bool {
    y.plain > 0
        && z.largest > 0.0
        && y.largest > 50.0 * USUAL_HEIGHT * z.largest
        && !stations_are_numbers
        && x.largest > 0.0
        && y.largest > 50.0 / USUAL_LENGTH * x.largest
}

/// Numbers of a kind that cannot be of the unit that is declared for them.
struct Contradiction {
    what: &'static str,
    /// The key that states their unit.
    key: &'static str,
    unit: Notation,
    size: Size,
    /// No ship has larger ones \[m\].
    largest: f64,
    /// How large they are beside the other lengths of the table \[m\], where these can be.
    usual: Option<f64>,
}

impl Contradiction {
    /// Says so, with the unit that the numbers look like; where nothing tells it, with all that they can have.
    fn report(&self, problems: &mut Problems) {
        let Self { what, key, unit, size, largest, usual } = self;
        let found = size.largest;
        if size.plain == 0 {
            return;
        }
        let smaller: &[Notation] = match unit {
            Notation::Metres | Notation::Feet if unit.metres(found) > *largest => {
                &[Notation::Millimetres, Notation::Centimetres]
            }
            Notation::Centimetres if unit.metres(found) > *largest => &[Notation::Millimetres],
            Notation::Millimetres if found > 0.0 && found < SMALLEST_MILLIMETRES && size.decimals > 0 => {
                &[Notation::Metres]
            }
            _ => return,
        };
        let mut fitting: Vec<Notation> =
            smaller.iter().copied().filter(|unit| unit.metres(found) <= *largest).collect();
        if let Some(usual) = usual {
            let off = |unit: &Notation| (unit.metres(found) / usual).ln().abs();
            fitting.sort_by(|a, b| off(a).total_cmp(&off(b)));
            fitting.truncate(1);
        }
        let list = |of: &dyn Fn(&Notation) -> String| fitting.iter().map(of).collect::<Vec<_>>().join(" or ");
        let message = format!(
            "the largest {what} is {found}, which looks like {}, but the unit is {}",
            list(&|unit| name(*unit).to_owned()),
            unit.as_str()
        );
        let remedy = format!("Declare {}", list(&|unit| format!("{key} = \"{}\"", unit.as_str())));
        problems.error("E305", FilePosition::FILE, message, &remedy);
    }
}

/// A unit in full.
fn name(unit: Notation) -> &'static str {
    match unit {
        Notation::Metres => "metres",
        Notation::Centimetres => "centimetres",
        Notation::Millimetres => "millimetres",
        other => other.as_str(),
    }
}

/// Part of the longer distance from midship at which the perpendiculars may stand.
const PERPENDICULARS: f64 = 0.9;

/// The origin of distances from midship or from FP where L_PP is not known; `unit` is that of the distances.
///
/// From midship AP is the outermost station aft of it that has a station as far forward, if it stands near the end of the
/// table; without such a pair x is 0 at midship. From FP the aftermost station is AP.
pub(super) fn ends_from_midship(
    origin: Datum,
    settings: &Settings,
    heads: &[Position],
    unit: Notation,
    problems: &mut Problems,
) -> StationDatum {
    let (StationDatum::Shifted { sign, .. }, Some(from)) = (origin.datum, origin.open) else { return origin.datum };
    if settings.stated.length_between_perpendiculars.is_some() {
        return origin.datum;
    }
    let distance = |position: &Position| match position.place {
        Coordinate::Number(number) => Some(unit.metres(number)),
        Coordinate::Length(length) => Some(length),
        _ => None,
    };
    let all: Vec<f64> = heads.iter().filter_map(distance).collect();
    let farthest = all.iter().map(|x| x.abs()).fold(0.0, f64::max);
    let paired = |x: f64| x > 0.0 && all.iter().any(|other| (x + other).abs() <= 1e-6 * farthest);
    let half = all.iter().copied().filter(|&x| paired(x)).fold(0.0, f64::max);
    let (offset, assumed) = if from == From::ForePerpendicular {
        let aftermost = all.iter().map(|x| -sign * x).fold(0.0, f64::max);
        (aftermost, format!("the aftermost station, {} m aft of FP, is taken as AP", metres(aftermost)))
    } else if half >= PERPENDICULARS * farthest && half > 0.0 {
        let apart = metres(2.0 * half);
        (half, format!("the outermost stations at equal distances are taken as AP and FP, {apart} m apart"))
    } else {
        (0.0, "x is 0 at midship".to_owned())
    };
    let message = format!("distances count from {} and L_PP is not known: {assumed}", from.as_str());
    problems.warning("W320", FilePosition::FILE, message, "Give Lpp in the conventions");
    StationDatum::Shifted { offset, sign }
}
