//! Headers: what a line is about (stations, waterlines, buttocks), where it lies, and in which unit.
//!
//! A position is a number in any notation, alone or with words: `1.5`, `1.50 m`, `3-0-0`, `WL 3`, `WL 3 (1.50 m)`,
//! `z = 1.5`, `STN 1 1/2`, `station 7 @ 14.7 m`, `wl0.75`, `3. WL`, `AP`, `FP`, `20 (FP)`, and the base line `BL` among
//! waterlines.

mod names;

pub(super) use names::{
    SIDES, counts_down, counts_from_waterline, has_area_unit, is_aftward, is_area_unit, is_deck, side_name, side_of,
};

use self::names::is_function;
use crate::units::{Dimension, Notation, UnitError, parse};

/// What a header is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Axis {
    /// Stations by their distance.
    X,
    /// Stations by their number.
    Station,
    /// Stations by the number of a frame.
    Frame,
    Waterline,
    Buttock,
}

impl Axis {
    pub(super) fn is_station(self) -> bool {
        matches!(self, Self::X | Self::Station | Self::Frame)
    }
}

/// Where a line lies, as it was written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Coordinate {
    /// A plain number, in the unit of the table or a station number.
    Number(f64),
    /// A length \[m\] with its own unit.
    Length(f64),
    AftPerpendicular,
    ForePerpendicular,
    Midship,
}

/// A header that names a position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Position {
    pub(super) place: Coordinate,
    /// What the words beside it say.
    pub(super) axis: Option<Axis>,
    /// Only a number after a word or before it, as `WL 3` and `3. WL`: a name or a height.
    pub(super) named: bool,
    /// The perpendicular that the header names, alone or beside its number.
    pub(super) end: Option<From>,
}

impl Position {
    /// Its plain number; none of a length or of a perpendicular.
    pub(super) fn number(&self) -> Option<f64> {
        if let Coordinate::Number(number) = self.place { Some(number) } else { None }
    }

    fn at(place: Coordinate, text: &str) -> Self {
        Self { place, axis: axis_of(text), named: false, end: From::end_of(text).or_else(|| From::of(text)) }
    }
}

/// Whether a header names the base line: the waterline at height 0. Among buttocks `BL` is one of these.
pub(super) fn is_base_line(text: &str) -> bool {
    let name = words(text).join(" ");
    let known = matches!(
        name.as_str(),
        "bl" | "base" | "base line" | "baseline" | "b l" | "moulded base" | "moulded base line"
    );
    known && !text.bytes().any(|b| b.is_ascii_digit())
}

/// Words beside the height of a waterline that name it.
const LEVELS: [&str; 9] = ["dwl", "lwl", "cwl", "swl", "dlwl", "kwl", "clwl", "mwl", "lwp"];

/// Whether a header is a level alone, as `LWL` among waterlines that are numbered.
pub(super) fn is_level(text: &str) -> bool {
    let name: String = text.to_lowercase().chars().filter(|c| c.is_alphabetic()).collect();
    !text.bytes().any(|b| b.is_ascii_digit()) && LEVELS.contains(&name.as_str())
}

/// Words of a text in lower case: runs of letters, and runs of other signs left out.
fn words(text: &str) -> Vec<String> {
    text.split(|c: char| !c.is_alphabetic()).filter(|w| !w.is_empty()).map(str::to_lowercase).collect()
}

fn axis_word(word: &str) -> Option<Axis> {
    Some(match word {
        "x" | "distance" | "abscissa" => Axis::X,
        "station" | "stations" | "stn" | "stns" | "sta" | "stat" | "st" | "ordinate" | "section" | "sections"
        | "sec" | "rebro" => Axis::Station,
        "frame" | "frames" | "fr" | "spant" => Axis::Frame,
        "z" | "wl" | "wls" | "waterline" | "waterlines" | "height" | "heights" | "draught" | "draft" | "level"
        | "base" | "baseline" => Axis::Waterline,
        word if LEVELS.contains(&word) => Axis::Waterline,
        "y" | "bt" | "butt" | "buttock" | "buttocks" | "bl" => Axis::Buttock,
        _ => return None,
    })
}

/// What the words of a header are about: the first word that says it.
pub(super) fn axis_of(text: &str) -> Option<Axis> {
    // `1st` is no station.
    let counts = |(at, word): (usize, &str)| {
        matches!(word, "st" | "nd" | "rd" | "th") && text[..at].ends_with(|c: char| c.is_ascii_digit())
    };
    let lower = text.to_lowercase();
    let mut at = 0;
    lower.split(|c: char| !c.is_alphabetic()).find_map(|word| {
        let start = at;
        at += word.len() + 1;
        if lower.len() == text.len() && text.is_ascii() && counts((start, word)) { None } else { axis_word(word) }
    })
}

/// The unit of positions alone in `Station (ft from AP)`.
fn unit_of_positions(text: &str) -> Option<Notation> {
    let (unit, rest) = text.split_once(['(', '['])?.1.trim_start().split_once(' ')?;
    let word = rest.split_whitespace().next()?.to_lowercase();
    let is_from = matches!(word.as_str(), "from" | "aft" | "abaft" | "fwd" | "forward");
    is_from.then(|| Notation::from_word(unit)).flatten()
}

/// The unit that a header declares: in brackets, or as its last word after a low line (`x_from_AP_m`).
pub(super) fn unit_of(text: &str) -> Option<Notation> {
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some((_, after)) = text.split_once(open)
            && let Some((inside, _)) = after.split_once(close)
            && let Some(unit) = Notation::from_word(inside)
        {
            return Some(unit);
        }
    }
    let (before, last) = text.trim().rsplit_once(['_', ' ', ','])?;
    (!before.is_empty()).then(|| Notation::from_word(last)).flatten()
}

/// What the field says in which the headers cross.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Corner {
    pub(super) rows: Option<Axis>,
    pub(super) columns: Option<Axis>,
    pub(super) unit: Option<Notation>,
    /// The unit of the distances of stations alone.
    pub(super) x_unit: Option<Notation>,
    /// Positions from midship or from FP, as the words say.
    pub(super) from: Option<From>,
    /// Whether distances from midship are positive aft.
    pub(super) aftward: bool,
    /// Spaces in L_PP, as in `station_20_over_Lpp`.
    pub(super) spaces: Option<f64>,
}

/// From where positions of stations count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum From {
    AftPerpendicular,
    ForePerpendicular,
    Midship,
}

impl From {
    /// Its name in messages.
    pub(super) fn as_str(self) -> &'static str {
        match self {
            Self::AftPerpendicular => "AP",
            Self::ForePerpendicular => "FP",
            Self::Midship => "midship",
        }
    }

    pub(super) fn of(text: &str) -> Option<Self> {
        words(&text.replace('.', "")).iter().find_map(|word| match word.as_str() {
            "ap" => Some(Self::AftPerpendicular),
            "fp" => Some(Self::ForePerpendicular),
            "midship" | "midships" | "amidships" | "amidship" => Some(Self::Midship),
            _ => None,
        })
    }
}

impl From {
    /// The end of the hull that words name: FWD, forward perpendicular, aft.
    pub(super) fn end_of(text: &str) -> Option<Self> {
        words(&text.replace('.', "")).iter().find_map(|word| match word.as_str() {
            "ap" | "aft" | "after" | "stern" => Some(Self::AftPerpendicular),
            "fp" | "fwd" | "forward" | "fore" | "bow" | "stem" => Some(Self::ForePerpendicular),
            _ => None,
        })
    }
}

impl Corner {
    pub(super) fn of(text: &str) -> Self {
        let unit = unit_of(text);
        // `y(x,z)` is over half-breadths, and says nothing of rows and columns.
        let bare = if is_function(text) { "" } else { text.split(['[', '(']).next().unwrap_or("") };
        let parts = bare.split_once(['\\', '/']).filter(|(_, after)| axis_of(after).is_some());
        let (rows, columns) = match parts {
            Some((before, after)) => (axis_of(before), axis_of(after)),
            None => (axis_of(bare), None),
        };
        let lower = text.to_lowercase();
        let spaces = lower
            .contains("lpp")
            .then(|| lower.split(|c: char| !c.is_ascii_digit()).find(|d| !d.is_empty())?.parse().ok())
            .flatten();
        // Per cent of the length are numbers of a hundred stations.
        let of_length = ["lpp", "lbp", "length"].iter().any(|word| lower.contains(word));
        let before = lower.split(['%']).next().unwrap_or("").trim_end();
        let counted = before.len() < lower.len() && before.ends_with(|c: char| c.is_ascii_digit());
        let of_stations = rows.is_none_or(Axis::is_station)
            && !["breadth", "height", "offset", "ordinate"].iter().any(|word| lower.contains(word));
        let is_share = of_length
            && of_stations
            && !counted
            && ["%", "per cent", "percent"].iter().any(|word| lower.contains(word));
        let close: String = lower.split(['[', '(']).next().unwrap_or("").split_whitespace().collect();
        let is_part = ["x/lpp", "x/lbp"].iter().any(|words| close.starts_with(words)) || close == "x/l";
        let (rows, spaces) = match (is_share, is_part) {
            (true, _) => (Some(Axis::Station), Some(100.0)),
            (false, true) => (Some(Axis::Station), Some(1.0)),
            // A spacing of so many per cent.
            (false, false) if counted && of_length => (rows, spaces.map(|share: f64| 100.0 / share)),
            (false, false) => (rows, spaces),
        };
        // `Distance from stem`, and `x aft`.
        let first = |after: &str| words(after).into_iter().find(|word| word != "the");
        let behind = lower.split_once(" from ").and_then(|(_, after)| From::end_of(&first(after)?));
        let aft = rows.is_some_and(Axis::is_station) && words(bare).len() == 2 && words(bare)[1] == "aft";
        let from = From::of(text).or(behind).or(aft.then_some(From::ForePerpendicular));
        let aftward = is_aftward(&lower);
        let x_unit = unit_of_positions(text).filter(|_| rows.is_some_and(Axis::is_station));
        Self { rows, columns, unit, x_unit, from, aftward, spaces: spaces.filter(|&n: &f64| n > 0.0) }
    }
}

/// A number with a decimal point or a decimal comma.
pub(super) fn plain_number(text: &str) -> Option<f64> {
    text.trim().replace(',', ".").parse().ok()
}

/// Whether a text begins as a number does.
pub(super) fn begins_as_number(text: &str) -> bool {
    let text = text.trim().trim_start_matches(['(', '-', '+', '.', '\u{2212}', '\u{2013}']);
    text.starts_with(|c: char| c.is_ascii_digit())
}

/// Whether values rise, or fall, all along.
pub(super) fn is_orderly<T: PartialOrd>(values: &[T]) -> bool {
    values.windows(2).all(|pair| pair[0] < pair[1]) || values.windows(2).all(|pair| pair[0] > pair[1])
}

/// What a text without words writes.
fn number(text: &str) -> Result<Coordinate, UnitError> {
    let measure = parse(text)?;
    match measure.dimension {
        Dimension::None => Ok(Coordinate::Number(measure.value)),
        Dimension::Length => Ok(Coordinate::Length(measure.value)),
        other => Err(UnitError::Kind { text: text.to_owned(), found: other.as_str(), expected: "a length" }),
    }
}

/// The positions that the headers of lines name, or why one names none.
///
/// The point of `WL.5` closes an abbreviation. Headers that rise or fall only with it as a decimal point, as `WL.25`, `WL.5`,
/// `WL1`, have decimals.
pub(super) fn positions<'t>(
    texts: impl Iterator<Item = &'t str>,
    decimal_comma: bool,
) -> Vec<Result<Position, UnitError>> {
    let texts: Vec<&str> = texts.collect();
    let closed = texts.iter().map(|text| position(text, decimal_comma)).collect();
    if !texts.iter().any(|text| abbreviation(text).is_some()) {
        return closed;
    }
    let spaced = texts.iter().map(|text| match abbreviation(text) {
        Some(at) => position(&format!("{} {}", &text[..at], &text[at..]), decimal_comma),
        None => position(text, decimal_comma),
    });
    let decimal: Vec<Result<Position, UnitError>> = spaced.collect();
    let orderly = |list: &[Result<Position, UnitError>]| {
        let numbers = list.iter().filter_map(|head| match head.as_ref().ok()?.place {
            Coordinate::Number(number) | Coordinate::Length(number) => Some(number),
            _ => None,
        });
        is_orderly(&numbers.collect::<Vec<f64>>())
    };
    if !orderly(&closed) && orderly(&decimal) { decimal } else { closed }
}

/// Where the point stands that follows a letter and precedes a digit, as in `WL.5`.
fn abbreviation(text: &str) -> Option<usize> {
    let at =
        text.char_indices().zip(text.chars().skip(1)).zip(text.chars().skip(2)).find_map(|(((at, a), b), c)| {
            (a.is_alphabetic() && b == '.' && c.is_ascii_digit()).then_some(at + a.len_utf8())
        })?;
    // A decimal writes its zeros: `WL.05`.
    let digits = &text[at + 1..];
    (!(digits.starts_with('0') && digits[1..].starts_with(|c: char| c.is_ascii_digit()))).then_some(at)
}

/// The position that a header names.
///
/// # Errors
/// Why it names none.
pub(super) fn position(text: &str, decimal_comma: bool) -> Result<Position, UnitError> {
    let text = text.trim();
    let replaced = if decimal_comma { text.replace(',', ".") } else { String::new() };
    let text = if decimal_comma { replaced.as_str() } else { text };
    let here = |place: Coordinate| Ok(Position::at(place, text));
    match text.to_lowercase().replace('.', "").as_str() {
        "ap" => return here(Coordinate::AftPerpendicular),
        "fp" => return here(Coordinate::ForePerpendicular),
        "midship" | "midships" | "amidships" => return here(Coordinate::Midship),
        _ if is_base_line(text) => {
            return Ok(Position {
                place: Coordinate::Number(0.0),
                axis: Some(Axis::Waterline),
                named: true,
                end: None,
            });
        }
        _ => {}
    }
    // A length in brackets, or after = or @, is the position; what stands before it is a name. Words in brackets that name
    // a perpendicular stand beside a position.
    let mut bare = text;
    if let Some((before, after)) = text.split_once(['(', '[']) {
        let inside = after.trim_end().trim_end_matches([')', ']']);
        let unit = Notation::from_word(inside).is_some();
        let words_alone =
            !inside.bytes().any(|b| b.is_ascii_digit()) && From::of(inside).or_else(|| From::end_of(inside)).is_some();
        if words_alone && !before.trim().is_empty() {
            bare = before.trim();
        } else if !before.trim().is_empty() && !unit {
            let inside = inside.trim_start_matches(|c: char| c.is_alphabetic() || c.is_whitespace() || c == '=');
            return here(number(inside)?);
        }
        if before.trim().is_empty() {
            bare = inside;
        }
    }
    if let Some((_, after)) = bare.split_once(['=', '@']) {
        return here(number(&unbracketed(after))?);
    }
    // `1.50 m above base`.
    if let Some((before, after)) = bare.split_once(" above ")
        && (is_base_line(after) || after.trim().eq_ignore_ascii_case("keel"))
    {
        bare = before.trim();
    }
    if let Ok(place) = number(&unbracketed(bare)) {
        return here(place);
    }
    // Words before the number, or after it.
    let is_digit = |c: char| c.is_ascii_digit() || matches!(c, '\u{bc}'..='\u{be}');
    let start = bare.find(is_digit).unwrap_or(bare.len());
    let is_closed = abbreviation(bare).is_some_and(|at| at + 1 == start);
    let signed = start < bare.len() && bare[..start].ends_with('.') && !is_closed
        || bare[..start].ends_with(" -")
        || bare[..start] == *"-";
    let start = if signed { start - 1 } else { start };
    let prefix_is_words = bare[..start].chars().all(|c| c.is_alphabetic() || matches!(c, ' ' | '_' | '.' | '-' | '#'));
    let rest = &bare[start..];
    if rest.is_empty() || !prefix_is_words {
        return Err(UnitError::Number(text.chars().take(40).collect()));
    }
    let (rest, follows) = match rest.trim_end().rsplit_once([' ', '_']) {
        Some((before, word)) if axis_of(word).is_some() || From::end_of(word).is_some() => (before, true),
        _ => (rest, false),
    };
    let place = number(&unbracketed(cardinal(rest)))?;
    let named = start > 0 || follows && matches!(place, Coordinate::Number(_));
    Ok(Position { named, ..Position::at(place, text) })
}

/// `1st` as `1`, of waterlines that are counted.
fn cardinal(text: &str) -> &str {
    let end = text.trim_end().find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    let (number, rest) = text.split_at(end);
    let is_ordinal = ["st", "nd", "rd", "th"].iter().any(|word| rest.trim_end().eq_ignore_ascii_case(word));
    if is_ordinal && !number.is_empty() { number } else { text }
}

/// `1.50 [m]` as `1.50 m`.
fn unbracketed(text: &str) -> String {
    text.chars().map(|c| if matches!(c, '[' | ']' | '(' | ')') { ' ' } else { c }).collect::<String>().trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(text: &str) -> Coordinate {
        position(text, false).unwrap().place
    }

    #[test]
    fn positions_of_every_writing() {
        assert_eq!(place("1.5"), Coordinate::Number(1.5));
        assert_eq!(place(" -3.25 "), Coordinate::Number(-3.25));
        assert_eq!(place("1.50 m"), Coordinate::Length(1.5));
        assert_eq!(place("1.50 [m]"), Coordinate::Length(1.5));
        assert_eq!(place("WL 3 (1.50 m)"), Coordinate::Length(1.5));
        assert_eq!(place("WL 3 (1.50)"), Coordinate::Number(1.5));
        assert_eq!(place("WL 3 (z = 1.50 m)"), Coordinate::Length(1.5));
        assert_eq!(place("z = 1.5"), Coordinate::Number(1.5));
        assert_eq!(place("station 7 @ 14.7 m"), Coordinate::Length(14.7));
        assert_eq!(place("STN 1/4"), Coordinate::Number(0.25));
        assert_eq!(place("STN 1 1/2"), Coordinate::Number(1.5));
        assert_eq!(place("station 7"), Coordinate::Number(7.0));
        assert_eq!(place("WL -0.5"), Coordinate::Number(-0.5));
        assert_eq!(place("WL-3"), Coordinate::Number(3.0));
        assert_eq!(place("wl0.075"), Coordinate::Number(0.075));
        assert_eq!(place("WL .5"), Coordinate::Number(0.5));
        assert_eq!((place("WL.5"), place("St.10")), (Coordinate::Number(5.0), Coordinate::Number(10.0)));
        assert_eq!((place("WL.05"), place("WL.0.5")), (Coordinate::Number(0.05), Coordinate::Number(0.5)));
        assert_eq!(place("1.5 WL"), Coordinate::Number(1.5));
        assert_eq!((axis_of("1st WL"), axis_of("St. 1")), (Some(Axis::Waterline), Some(Axis::Station)));
        assert_eq!((place("1st WL"), place("Waterline 2nd")), (Coordinate::Number(1.0), Coordinate::Number(2.0)));
        assert_eq!(place("1.5 m WL"), Coordinate::Length(1.5));
        assert_eq!((place("1.5m above base"), place("\u{bd} WL")), (Coordinate::Length(1.5), Coordinate::Number(0.5)));
        assert_eq!(place("R5"), Coordinate::Number(5.0));
        assert_eq!(place("3-0-0"), Coordinate::Length(0.9144));
        assert_eq!((place("A.P."), place("FP")), (Coordinate::AftPerpendicular, Coordinate::ForePerpendicular));
        assert_eq!(
            (place("BL"), place("Base line"), place("0. WL")),
            (Coordinate::Number(0.0), Coordinate::Number(0.0), Coordinate::Number(0.0))
        );
        assert_eq!((place("DWL 4.5 m"), place("0.75m WL")), (Coordinate::Length(4.5), Coordinate::Length(0.75)));
        for (text, at, end) in [
            ("0 (FP)", 0.0, From::ForePerpendicular),
            ("0 (bow)", 0.0, From::ForePerpendicular),
            ("20 AP", 20.0, From::AftPerpendicular),
        ] {
            let found = position(text, false).unwrap();
            assert_eq!((found.place, found.end), (Coordinate::Number(at), Some(end)));
        }
        assert!(position("3. WL", false).unwrap().named && !position("3", false).unwrap().named);
        assert_eq!(position("1,5", true).unwrap().place, Coordinate::Number(1.5));
        assert_eq!(position("WL 3", false).unwrap().axis, Some(Axis::Waterline));
        for text in ["", "deck", "WL", "1.2.3", "abc 3 def", "nan", "inf"] {
            assert!(position(text, false).is_err(), "{text}");
        }
    }

    #[test]
    fn corners() {
        let corner = Corner::of("x\\z [mm]");
        assert_eq!((corner.rows, corner.columns), (Some(Axis::X), Some(Axis::Waterline)));
        assert_eq!(corner.unit, Some(Notation::Millimetres));
        let corner = Corner::of("x_from_midship_m");
        assert_eq!((corner.rows, corner.from), (Some(Axis::X), Some(From::Midship)));
        assert_eq!(corner.unit, Some(Notation::Metres));
        let corner = Corner::of("station_20_over_Lpp");
        assert_eq!((corner.rows, corner.spaces), (Some(Axis::Station), Some(20.0)));
        let corner = Corner::of("x in % of Lpp from AP");
        assert_eq!((corner.rows, corner.spaces), (Some(Axis::Station), Some(100.0)));
        assert_eq!(Corner::of("").rows, None);
        assert_eq!(Corner::of("station_as_printed").unit, None);
    }

    #[test]
    fn areas_and_levels() {
        for text in ["A [m2]", "SA m2", "Awl (m\u{b2})", "Volume [ft^3]", "A sq ft", "A_m2"] {
            assert!(has_area_unit(text), "{text}");
        }
        for text in ["WL 2", "WL 2 m", "m2", "1.5 [m]", "BT 2 in"] {
            assert!(!has_area_unit(text), "{text}");
        }
        for text in
            ["Heights above LWL in metres", "x \\ z from the design waterline [m]", "z = 0 at DWL", "WL above D.W.L."]
        {
            assert!(counts_from_waterline(text), "{text}");
        }
        for text in
            ["Heights above base", "Waterlines from keel to LWL", "LWL 6 m above base", "Heights above the bottom line"]
        {
            assert!(!counts_from_waterline(text), "{text}");
        }
        assert!(
            is_aftward("x aft of midship [m]") && is_aftward("Distance abaft amidships") && is_aftward("x (+ aft)")
        );
        assert!(!is_aftward("Distance from aft perpendicular") && !is_aftward("x from midship, aft -"));
    }

    #[test]
    fn sides() {
        use crate::hull::SideKind;
        assert_eq!(side_of("z_keel"), Some(SideKind::Keel));
        assert_eq!(side_of("Flat of Bottom [m]"), Some(SideKind::FlatOfBottom));
        assert_eq!(side_of("half-breadth at deck"), Some(SideKind::DeckHalfBreadth));
        assert_eq!(side_of("stern"), Some(SideKind::Stern));
        assert_eq!(
            (side_of("Rabbet ht"), side_of("Height of keel (mm)")),
            (Some(SideKind::Keel), Some(SideKind::Keel))
        );
        assert_eq!(side_of("Sheer half-breadth"), side_of("Half-breadth at sheer"));
        assert_eq!(side_of("Deck side height [m]"), Some(SideKind::DeckHeight));
        assert_eq!((side_of("Deck"), is_deck("Deck (m)"), is_deck("Deck 2")), (None, true, false));
        assert_eq!(side_of("WL 3"), None);
        for (_, kind) in SIDES {
            assert_eq!(side_of(side_name(kind)), Some(kind));
        }
    }
}
