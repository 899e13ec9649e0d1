//! What stands around a table of offsets says about it: its name, main dimensions, units, and full breadths.

use super::header::{Axis, Corner, axis_of, counts_down, plain_number, side_of, unit_of};
use super::long::from_header;
use super::pieces::{Piece, Pieces};
use super::problem::{Field, FilePosition, Problems};
use super::ratio::slot;
use super::settings::{Settings, metres};
use crate::units::{Notation, parse_length};

/// Takes over what the words around the tables say and the conventions do not.
pub(super) fn settle(pieces: &Pieces, settings: &mut Settings, problems: &mut Problems) {
    dimensions(pieces, settings, problems);
    let texts = || pieces.texts.iter().chain(pieces.tables.iter().flat_map(|piece| &piece.texts));
    if let Some(piece) = pieces.tables.first() {
        units_below(piece, settings, problems);
        let corner = piece.rows.first().and_then(|row| Corner::of(row.first()?.trimmed()).unit);
        for line in joined(texts()) {
            units_by_kind(&line, settings, problems);
        }
        if settings.units.or(corner).is_none()
            && let Some((text, unit)) = texts().find_map(|text| Some((text, unit_of_text(text.trimmed())?)))
        {
            problems.note(format!("'{}' states the unit {}", text.trimmed(), unit.as_str()));
            settings.units = Some(unit);
        }
    }
    let heads = pieces.tables.first().and_then(|piece| piece.rows.first());
    if let Some(unit) =
        heads.and_then(|row| unit_of_breadths(row.first()?.trimmed())).filter(|_| settings.units.is_none())
    {
        let other = heads.and_then(|row| unit_of(row.first()?.trimmed()));
        settings.units = Some(unit);
        settings.x_units = settings.x_units.or(other);
    }
    let corners = heads.into_iter().flatten();
    if let Some(text) = texts().chain(corners).find(|text| says_full(&text.text)).filter(|_| settings.full.is_none()) {
        take_full(text, settings, problems);
    }
    let corner = heads.and_then(|row| row.first());
    if let Some(text) = corner.filter(|text| counts_down(text.trimmed())) {
        problems.error("E311", text, "heights count downward, and are not read so".to_owned(), UPWARD);
    }
    for line in joined(texts().filter(|text| !text.text.starts_with('#'))) {
        settings.prose(&line);
        settings.dimensions(&line, problems);
    }
    let says_half = corner.is_some_and(|text| text.text.to_lowercase().contains("half"));
    let titles = texts().filter(|text| says_breadths(&text.text, false));
    let heads = heads.into_iter().flatten().skip(1).filter(|text| names_breadths(&text.text));
    let rows = pieces.tables.first().into_iter().flat_map(|piece| &piece.rows).skip(1);
    let rows = rows.filter_map(|row| row.first()).filter(|text| names_breadths(&text.text));
    let open = titles.chain(corner.filter(|text| says_breadths(&text.text, true))).chain(heads).chain(rows).next();
    if let Some(text) = open.filter(|_| settings.full.is_none() && !says_half) {
        match pieces.tables.first().and_then(|piece| by_dimensions(piece, settings)) {
            Some((full, why)) => {
                problems.warning("W320", text.place(), taken(text.trimmed(), full, &why), HALF_OR_FULL);
                settings.full = Some(full);
            }
            None => problems.warning("W320", text.place(), half_taken(text.trimmed()), HALF_OR_FULL),
        }
    }
}

/// The texts of each row as one: a comma within a title parts it.
fn joined<'f>(texts: impl Iterator<Item = &'f Field>) -> Vec<String> {
    let mut lines: Vec<(usize, String)> = Vec::new();
    for text in texts.filter(|text| text.row > 0) {
        match lines.last_mut() {
            Some((row, line)) if *row == text.row => {
                line.push_str(", ");
                line.push_str(text.trimmed());
            }
            _ => lines.push((text.row, text.trimmed().to_owned())),
        }
    }
    lines.into_iter().map(|(_, line)| line).collect()
}

/// The largest number beside the breadth stated differs from it, or from its half, by less than this part.
const SAME_BREADTH: f64 = 0.03;

/// Lengths of ships in breadths.
const SLENDER: std::ops::RangeInclusive<f64> = 3.5..=12.0;

/// Whether breadths are full, by the stated breadth, or by L/B where one reading alone gives that of a ship; with the reason.
fn by_dimensions(piece: &Piece, settings: &Settings) -> Option<(bool, String)> {
    let corner = Corner::of(piece.rows.first()?.first()?.trimmed());
    let cells = piece.rows.iter().skip(1).flat_map(|row| row.iter().skip(1));
    let sizes = cells.filter_map(|field| {
        let number =
            plain_number(&field.text).map(|n| settings.units.or(corner.unit).unwrap_or(Notation::Metres).metres(n));
        number.or_else(|| parse_length(field.trimmed()).ok()).filter(|n| n.is_finite())
    });
    let largest = sizes.fold(0.0, f64::max);
    let near = |breadth: f64| (largest / breadth - 1.0).abs() < SAME_BREADTH;
    if let Some(breadth) = settings.stated.breadth {
        let full = if near(breadth) { Some(true) } else { near(0.5 * breadth).then_some(false) };
        return full.map(|full| (full, format!("by the breadth of {} m", metres(breadth))));
    }
    let ends = piece.rows.iter().skip(1).filter_map(|row| plain_number(&row.first()?.text));
    let extent = ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], n| [low.min(n), high.max(n)]);
    let unit = settings.x_units.or(corner.unit).or(settings.units).unwrap_or(Notation::Metres);
    let is_long =
        corner.rows.is_none_or(|axis| axis == Axis::X) && settings.stations.is_none_or(|scale| !scale.numbers);
    let by_stations = is_long.then(|| unit.metres(extent[1] - extent[0]));
    by_slenderness(settings.stated.length_between_perpendiculars.or(by_stations)?, largest)
}

/// Whether breadths up to `largest` \[m\] are full on a hull of some length \[m\]: where one reading alone gives the L/B of a ship;
/// with the reason.
pub(super) fn by_slenderness(length: f64, largest: f64) -> Option<(bool, String)> {
    let [full, half] = [length / largest, 0.5 * length / largest];
    let why = |ratio: f64, other: f64| format!("because L/B is {ratio:.1}, and {other:.1} otherwise");
    match (SLENDER.contains(&full), SLENDER.contains(&half)) {
        (true, false) if half < *SLENDER.start() => Some((true, why(full, half))),
        (false, true) if full > *SLENDER.end() => Some((false, why(half, full))),
        _ => None,
    }
}

/// Takes over what titles say of a table that is no matrix: rows of one text, up to its header.
pub(super) fn titles(rows: &[Vec<Field>], settings: &mut Settings, problems: &mut Problems) {
    let above = &rows[..rows.len() - from_header(rows).len()];
    let texts = || above.iter().flatten().filter(|field| !field.is_blank());
    joined(texts()).iter().for_each(|line| settings.prose(line));
    for text in texts() {
        settings.prose(text.trimmed());
        settings.dimensions(text.trimmed(), problems);
    }
    breadths(&texts().collect::<Vec<_>>(), settings, problems);
}

/// Takes over what titles say of breadths.
pub(super) fn breadths(titles: &[&Field], settings: &mut Settings, problems: &mut Problems) {
    if settings.full.is_some() {
        return;
    }
    if let Some(text) = titles.iter().find(|text| says_full(&text.text)) {
        take_full(text, settings, problems);
    } else if let Some(text) = titles.iter().find(|text| says_breadths(&text.text, false)) {
        problems.warning("W320", text.place(), half_taken(text.trimmed()), HALF_OR_FULL);
    }
}

/// Takes breadths as full ones, by a text.
fn take_full(text: &Field, settings: &mut Settings, problems: &mut Problems) {
    let message = format!("full breadths, by '{}'", text.trimmed());
    problems.warning("W320", text.place(), message, "Give breadths = \"half\" in the conventions if they are not");
    settings.full = Some(true);
}

/// What settles whether breadths are half ones.
pub(super) const HALF_OR_FULL: &str = "Give breadths = \"half\" or breadths = \"full\" in the conventions";

/// Says that breadths are taken as full or half ones, and why.
pub(super) fn taken(name: &str, full: bool, why: &str) -> String {
    let taken = if full { "full breadths" } else { "half-breadths" };
    format!("'{name}' does not say whether breadths are half or full: taken as {taken}, {why}")
}

/// Says that breadths are taken as half ones.
pub(super) fn half_taken(name: &str) -> String {
    format!("'{name}' does not say whether breadths are half or full: taken as half-breadths")
}

/// What is to be done about heights that count downward.
pub(super) const UPWARD: &str = "Give heights above the base line";

/// Whether words say that numbers are breadths, and not whether half or full ones.
fn says_breadths(text: &str, is_header: bool) -> bool {
    let lower = text.to_lowercase().replace(['-', '_'], " ");
    // `B(x,z)` is the breadth where `y(x,z)` is the half-breadth.
    let close: String = lower.chars().filter(|c| !c.is_whitespace()).collect();
    if ["b(x", "b(z"].iter().any(|begin| close.starts_with(begin)) {
        return true;
    }
    let mut words = lower.split(|c: char| !c.is_alphabetic());
    // `Beam trawler` is the name of a ship.
    let says = |word: &str| {
        matches!(word, "breadths" | "widths" | "beams") || is_header && matches!(word, "breadth" | "beam" | "width")
    };
    // `B [m]`, `B` in the corner.
    if is_header && lower.split(['[', '(']).next().is_some_and(|bare| bare.trim() == "b") {
        return true;
    }
    let all: Vec<&str> = lower.split(|c: char| !c.is_alphabetic()).filter(|word| !word.is_empty()).collect();
    let is_of_ship = |word: &&str| matches!(*word, "breadth" | "beam" | "width");
    // `Breadth offsets`, `Moulded breadth table`, `Beam at waterlines`, `Breadth at each waterline`.
    let of_lines = ["offsets", "table", "waterlines", "waterline", "stations", "station"];
    if all.iter().any(is_of_ship) && all.iter().any(|word| of_lines.contains(word)) {
        return !all.contains(&"half") && !has_value(&lower) && side_of(text).is_none();
    }
    if all.iter().any(|word| matches!(*word, "breadths" | "widths" | "beams" | "breiten"))
        && !all.contains(&"half")
        && !has_value(&lower)
    {
        return true;
    }
    // `B`, `breadth moulded` and `beam 12 m` are dimensions.
    let has_number = lower.bytes().any(|b| b.is_ascii_digit());
    let is_dimension = has_number || lower.contains(['=', ':']) || lower.contains("mould") || lower.contains("mold");
    !lower.contains("half") && !is_dimension && side_of(text).is_none() && words.any(says)
}

/// Whether a text has a number behind a word for a breadth: a dimension of the ship.
fn has_value(lower: &str) -> bool {
    let words = ["breadth", "beam", "width"];
    let at = words.iter().filter_map(|word| lower.find(word)).min();
    at.is_some_and(|at| {
        lower[at..].split([',', ';']).next().is_some_and(|part| part.bytes().any(|b| b.is_ascii_digit()))
    })
}

/// Whether the header of a line of offsets says breadth or beam: `Beam at 2 m`.
fn names_breadths(text: &str) -> bool {
    let lower = text.to_lowercase();
    let mut words = lower.split(|c: char| !c.is_alphabetic());
    let is_half = lower.contains("half") || lower.contains("semi");
    !is_half && side_of(text).is_none() && words.any(|word| matches!(word, "breadth" | "beam" | "width"))
}

/// The unit of half-breadths where a header states it apart from that of the positions: `x [m]; half-breadths in mm`.
fn unit_of_breadths(text: &str) -> Option<Notation> {
    let lower = text.to_lowercase();
    let (_, after) = lower.split_once("breadths").or_else(|| lower.split_once("offsets"))?;
    let word = after.trim().trim_start_matches("in ").trim_matches(|c: char| !c.is_alphabetic());
    Notation::from_word(word)
}

/// Whether words say that breadths are full. `Full breadth moulded 16 m` states a dimension.
pub(super) fn says_full(text: &str) -> bool {
    let lower = text.to_lowercase();
    lower.split([';', ',']).any(|part| !is_particular(part) && says_full_part(part))
}

/// Whether a part of a text states a breadth of the ship: one breadth, with its number or the word moulded.
fn is_particular(lower: &str) -> bool {
    let words: Vec<&str> = lower.split(|c: char| !c.is_alphabetic()).filter(|word| !word.is_empty()).collect();
    let has = |any: &[&str]| words.iter().any(|word| any.contains(word));
    let number = lower.find(|c: char| c.is_ascii_digit());
    // `Full breadth at 2 m` is over offsets.
    let states = number.is_some_and(|at| !lower[..at].trim_end().ends_with(" at"));
    has(&["breadth", "beam", "width"])
        && (states || has(&["moulded", "molded", "mld", "extreme", "overall", "max", "maximum"]))
}

fn says_full_part(lower: &str) -> bool {
    let close: String = lower.chars().filter(|c| !c.is_whitespace()).collect();
    if lower.split(|c: char| !c.is_alphanumeric()).any(|word| matches!(word, "2y" | "2b")) {
        return true;
    }
    if ["2y(x", "2y(z", "2y["].iter().any(|begin| close.starts_with(begin)) {
        return true;
    }
    let words: Vec<&str> = lower.split(|c: char| !c.is_alphabetic()).filter(|word| !word.is_empty()).collect();
    let is_full = |word: &str| matches!(word, "full" | "whole");
    let is_breadth = |word: &str| matches!(word.trim_end_matches('s'), "breadth" | "beam" | "width");
    // `Breadths (full)` too, and not `Beam, full load`.
    let behind = |k: usize| is_breadth(words[k]) && is_full(words[k + 1]) && words.get(k + 2) != Some(&"load");
    let says = |k: usize| is_full(words[k]) && is_breadth(words[k + 1]) || behind(k);
    !lower.contains("half") && (0..words.len().saturating_sub(1)).any(says)
}

/// Comments that say what the row of units did, which is not written back.
pub(super) fn unit_lines(pieces: &Pieces, settings: &Settings) -> Vec<String> {
    let Some(piece) = pieces.tables.first().filter(|piece| !piece.units.is_empty()) else { return Vec::new() };
    let first = piece.units.first().copied().flatten();
    let all = [("units", settings.units), ("x_units", settings.x_units.or(first))];
    all.into_iter().filter_map(|(key, unit)| Some(format!("# {key} = {}", unit?.as_str()))).collect()
}

/// The unit that a title or a note states: in brackets, or after `in`.
pub(super) fn unit_of_text(text: &str) -> Option<Notation> {
    let words: Vec<&str> = text.split_whitespace().map(|word| word.trim_matches(['.', ',', ';'])).collect();
    let after_in =
        words.windows(2).find_map(|pair| pair[0].eq_ignore_ascii_case("in").then(|| Notation::from_word(pair[1])));
    match after_in {
        Some(unit) => unit,
        None => unit_of(text).filter(|_| text.contains(['[', '('])),
    }
}

/// Units of breadths, of heights and of distances that one text states apart: `Half-breadths in mm, heights in m`,
/// `Half-breadths [mm] on waterlines [m]`.
fn units_said(text: &str) -> [Option<Notation>; 3] {
    let lower = text.to_lowercase();
    let mut found = [None; 3];
    let mut kind = None;
    let words: Vec<&str> = lower.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
    for (k, word) in words.iter().enumerate() {
        let named = match *word {
            "breadths" | "halfbreadths" | "offsets" | "ordinates" => Some(1),
            "heights" | "waterlines" | "levels" => Some(2),
            "stations" | "distances" | "lengths" | "positions" => Some(0),
            _ => None,
        };
        kind = named.or(kind);
        let is_said = words.get(k.wrapping_sub(1)) == Some(&"in")
            || lower.contains(&format!("[{word}]"))
            || lower.contains(&format!("({word})"));
        if let Some((at, unit)) = kind.zip(Notation::from_word(word).filter(|_| is_said)) {
            found[at] = found[at].or(Some(unit));
        }
    }
    found
}

/// Takes the units that a title states for more than one kind of number.
fn units_by_kind(text: &str, settings: &mut Settings, problems: &mut Problems) {
    let found = units_said(text);
    if found.iter().flatten().count() < 2 || settings.units.is_some() {
        return;
    }
    let [x, y, z] = found;
    let names = [("distances", x), ("half-breadths", y), ("heights", z)];
    let said: Vec<String> =
        names.iter().filter_map(|(name, unit)| Some(format!("{name} in {}", (*unit)?.as_str()))).collect();
    problems.note(format!("'{text}' states {}", said.join(", ")));
    settings.x_units = settings.x_units.or(x);
    settings.z_units = settings.z_units.or(z);
    settings.units = y;
}

/// Main dimensions in two columns beside or above a table.
fn dimensions(pieces: &Pieces, settings: &mut Settings, problems: &mut Problems) {
    for (key, value) in &pieces.pairs {
        let bare = key.text.split(['[', '(', '=', ':']).next().unwrap_or_default();
        let own = unit_of(key.trimmed()).filter(|_| plain_number(&value.text).is_some());
        settings.prose(&format!("{} {} {}", bare.trim(), value.trimmed(), own.map_or("", Notation::as_str)));
        let Some(slot) = slot(&mut settings.stated, bare) else { continue };
        let unit = unit_of(key.trimmed()).unwrap_or(Notation::Metres);
        let length = match plain_number(&value.text) {
            Some(number) => Ok(unit.metres(number)),
            None => parse_length(value.trimmed()),
        };
        match length {
            Ok(length) if length.is_finite() && length > 0.0 && length < 1e5 => {
                if slot.is_none() {
                    *slot = Some(length);
                    problems.note(format!("{} is {length} m by row {}", bare.trim(), key.row));
                }
            }
            Ok(length) => {
                let message = format!("{} would be {length} m", bare.trim());
                problems.error("E311", value, message, "It must be larger than 0 and smaller than 100000");
            }
            Err(error) => problems.error("E311", value, format!("{}: {error}", bare.trim()), ""),
        }
    }
}

/// Units in a row below the header.
fn units_below(piece: &Piece, settings: &mut Settings, problems: &mut Problems) {
    let Some((first, others)) = piece.units.split_first() else { return };
    let mut given = others.iter().flatten().copied();
    let Some(offsets) = given.next().or(*first) else { return };
    let corner = piece.rows.first().and_then(|row| row.first());
    let by_corner = corner.and_then(|field| Corner::of(field.trimmed()).unit);
    if let Some(other) = given.find(|unit| *unit != offsets) {
        let message = format!("offsets in {} and in {} in one table", offsets.as_str(), other.as_str());
        problems.error("E305", FilePosition::FILE, message, "Give all offsets in one unit");
    }
    if let (Some(corner), Some(below)) = (by_corner, first)
        && corner != *below
    {
        let message = format!("the header states {}, and the row below it {}", corner.as_str(), below.as_str());
        problems.error("E305", FilePosition::FILE, message, "Correct one of them");
    }
    settings.x_units = settings.x_units.or(settings.units).or(by_corner).or(*first);
    settings.units = settings.units.or(Some(offsets));
}

/// The title of the tables: the first text above their header, but for words over its columns.
pub(super) fn name(pieces: &Pieces, header_row: usize) -> Option<String> {
    let texts = pieces.texts.iter().chain(pieces.tables.iter().flat_map(|piece| &piece.texts));
    let over_columns = |text: &str| axis_of(text).is_some() || text.to_lowercase().contains("breadth");
    let titles = texts.filter(|text| text.row < header_row && !over_columns(text.trimmed()));
    titles.min_by_key(|text| (text.row, text.column)).map(|text| text.trimmed().to_owned())
}
