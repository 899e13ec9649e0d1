//! What words of headers and titles say: names of side columns, units of areas, the point and the direction from which heights and
//! distances count.

use std::sync::LazyLock;

use super::{From, LEVELS, words};
use crate::hull::SideKind;
use crate::units::Notation;

/// Names of side columns and rows; the first of each kind is the one that we write. Order and filling words do not count.
pub(in crate::exchange::table) const SIDES: [(&str, SideKind); 39] = [
    ("keel", SideKind::Keel),
    ("z keel", SideKind::Keel),
    ("keel height", SideKind::Keel),
    ("rabbet", SideKind::Keel),
    ("rabbet height", SideKind::Keel),
    ("z min", SideKind::Keel),
    ("flat of bottom", SideKind::FlatOfBottom),
    ("fob", SideKind::FlatOfBottom),
    ("half siding", SideKind::FlatOfBottom),
    ("flat of side", SideKind::FlatOfSide),
    ("fos", SideKind::FlatOfSide),
    ("deck at side", SideKind::DeckHeight),
    ("z top", SideKind::DeckHeight),
    ("z deck", SideKind::DeckHeight),
    ("deck height", SideKind::DeckHeight),
    ("sheer", SideKind::DeckHeight),
    ("sheer height", SideKind::DeckHeight),
    ("deck at side height", SideKind::DeckHeight),
    ("z max", SideKind::DeckHeight),
    ("half breadth at deck", SideKind::DeckHalfBreadth),
    ("y deck", SideKind::DeckHalfBreadth),
    ("sheer half breadth", SideKind::DeckHalfBreadth),
    ("deck at side half breadth", SideKind::DeckHalfBreadth),
    ("deck centre", SideKind::DeckCentreHeight),
    ("deck centre height", SideKind::DeckCentreHeight),
    ("stern", SideKind::Stern),
    ("x stern", SideKind::Stern),
    ("stern profile", SideKind::Stern),
    ("aft end", SideKind::Stern),
    ("stern contour", SideKind::Stern),
    ("aft contour", SideKind::Stern),
    ("stem", SideKind::Stem),
    ("x stem", SideKind::Stem),
    ("stem profile", SideKind::Stem),
    ("fore end", SideKind::Stem),
    ("stem contour", SideKind::Stem),
    ("bow contour", SideKind::Stem),
    ("bow profile", SideKind::Stem),
    ("fore contour", SideKind::Stem),
];

/// More words than any name of a side column has.
const MOST_WORDS: usize = 8;

/// The words of a name of a side column in one writing and order: `Height of rabbet` as `Rabbet ht`.
fn side_words(text: &str) -> Vec<String> {
    let mut list = Vec::new();
    for word in words(text) {
        match word.as_str() {
            "of" | "at" | "the" | "line" => {}
            "ht" | "hgt" => list.push("height".to_owned()),
            "center" => list.push("centre".to_owned()),
            "hb" | "halfbreadth" => list.extend(["half".to_owned(), "breadth".to_owned()]),
            _ => list.push(word),
        }
    }
    list.sort();
    list
}

/// A header without the unit that its last word is.
fn without_unit(text: &str) -> &str {
    let bare = text.trim_end_matches(|c: char| !c.is_alphabetic());
    let Some((at, c)) = bare.char_indices().rev().find(|(_, c)| !c.is_alphabetic()) else { return text };
    if Notation::from_word(&bare[at + c.len_utf8()..]).is_some() { &bare[..at] } else { text }
}

/// The side column or row that a header names.
pub(in crate::exchange::table) fn side_of(text: &str) -> Option<SideKind> {
    if text.bytes().any(|b| b.is_ascii_digit()) || words(text).len() > MOST_WORDS {
        return None;
    }
    static KNOWN: LazyLock<Vec<(Vec<String>, SideKind)>> =
        LazyLock::new(|| SIDES.iter().map(|(name, kind)| (side_words(name), *kind)).collect());
    let name = side_words(without_unit(text));
    KNOWN.iter().find(|(known, _)| *known == name).map(|(_, kind)| *kind)
}

/// Whether a header is the deck, and does not say whether its height or its half-breadth.
pub(in crate::exchange::table) fn is_deck(text: &str) -> bool {
    !text.bytes().any(|b| b.is_ascii_digit()) && side_words(without_unit(text)) == ["deck"]
}

/// Whether a word is a unit of area or volume: `m2`, `m^3`, `ft²`, `sqm`.
pub(in crate::exchange::table) fn is_area_unit(word: &str) -> bool {
    let plain = word.trim_matches(['[', ']', '(', ')']).to_lowercase();
    let plain = plain.replace(['^', '*', '.'], "").replace('\u{b2}', "2").replace('\u{b3}', "3");
    let power = plain.strip_suffix(['2', '3']).is_some_and(|unit| Notation::from_word(unit).is_some());
    power || matches!(plain.as_str(), "sqm" | "sqft" | "sqin" | "cbm" | "cum" | "cuft")
}

/// Whether a header has such a unit beside its name.
pub(in crate::exchange::table) fn has_area_unit(text: &str) -> bool {
    let words: Vec<&str> = text.split([' ', '[', ']', '(', ')', '_', ',']).filter(|word| !word.is_empty()).collect();
    let two = |pair: &[&str]| {
        matches!(pair[0].trim_end_matches('.').to_lowercase().as_str(), "sq" | "cu" | "square" | "cubic")
            && Notation::from_word(pair[1].trim_end_matches('.')).is_some()
    };
    words.iter().skip(1).any(|word| is_area_unit(word)) || words.windows(2).any(two)
}

/// Levels from which heights may count instead of the base line, in words.
const LOAD_LINES: [&str; 9] =
    ["load", "design", "designed", "designer", "construction", "loaded", "summer", "scantling", "datum"];

/// Whether words say that heights count from the load waterline: `Heights above LWL`, `z from the design waterline`, `z = 0 at
/// DWL`.
pub(in crate::exchange::table) fn counts_from_waterline(text: &str) -> bool {
    let spoken = text.to_lowercase().replace('.', "");
    let all: Vec<&str> = spoken.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let is_height = |word: &str| matches!(word, "height" | "heights" | "z" | "wl" | "wls" | "waterlines" | "levels");
    let is_level = |words: &[&str]| {
        let at = words.iter().position(|word| !matches!(*word, "to" | "the" | "at" | "is" | "from" | "in" | "m"));
        let Some((first, rest)) = at.and_then(|at| words[at..].split_first()) else { return false };
        let is_load = LOAD_LINES.contains(first);
        let next = rest.iter().find(|word| !LOAD_LINES.contains(*word) && **word != "water");
        *first == "waterline"
            || LEVELS.contains(first)
            || is_load && next.is_some_and(|word| matches!(*word, "waterline" | "line" | "wl" | "waterplane"))
    };
    let behind = |k: usize| {
        let near =
            all.iter().skip(k + 1).take(4).position(|word| matches!(*word, "above" | "from" | "relative" | "over"));
        let zero = (all.get(k + 1) == Some(&"0")).then_some(0);
        near.or(zero).is_some_and(|at| is_level(&all[k + 2 + at..]))
    };
    (0..all.len()).any(|k| is_height(all[k]) && behind(k))
}

/// The header that we write over a side column.
pub(in crate::exchange::table) fn side_name(kind: SideKind) -> &'static str {
    if kind == SideKind::DeckHalfBreadth {
        // With the hyphen that the words leave out.
        return "half-breadth at deck";
    }
    SIDES.iter().find(|(_, k)| *k == kind).map_or("name", |(name, _)| name)
}

/// Whether words say that heights count downward: `depth below DWL`, `z down`. What stands in brackets does not count.
pub(in crate::exchange::table) fn counts_down(text: &str) -> bool {
    let mut depth = 0_usize;
    let outside = |c: &char| {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            _ => return depth == 0,
        }
        false
    };
    let bare: String = text.chars().filter(outside).collect();
    let words = words(&bare);
    let is_height = |word: &str| matches!(word, "depth" | "depths" | "height" | "heights" | "z");
    let is_down = |word: &str| matches!(word, "below" | "under" | "beneath" | "down" | "downward" | "downwards");
    // `x \ below deck` too: below behind the bar.
    let behind = bare.split_once(['\\', '/']).and_then(|(_, after)| after.split_whitespace().next());
    words.windows(2).any(|pair| is_height(&pair[0]) && is_down(&pair[1]))
        || behind.is_some_and(|word| is_down(&word.to_lowercase()))
}

/// Whether words say that distances are positive aft: `+ aft`, `aft of midship`, `abaft`.
pub(in crate::exchange::table) fn is_aftward(text: &str) -> bool {
    const AFT: [&str; 6] = ["+ aft", "+aft", "aft +", "positive aft", "aft positive", "+ve aft"];
    const FORWARD: [&str; 8] =
        ["fwd +", "forward +", "+ fwd", "+ forward", "forward positive", "positive forward", "aft -", "aft negative"];
    let lower = text.to_lowercase();
    let contains = |any: &[&str]| any.iter().any(|words| lower.contains(words));
    let words = words(&lower);
    let is_aft = |pair: &[String]| {
        let from = ["of", "from"].contains(&pair[1].as_str()) || From::of(&pair[1]).is_some();
        matches!(pair[0].as_str(), "aft" | "abaft") && from
    };
    (contains(&AFT) || words.windows(2).any(is_aft)) && !contains(&FORWARD)
}

/// Whether a corner names a breadth over both directions: `y(x,z)`, `B(x, z)`.
pub(super) fn is_function(text: &str) -> bool {
    let close: String = text.to_lowercase().chars().filter(|c| !c.is_whitespace()).collect();
    close.split_once('(').is_some_and(|(_, inside)| inside.starts_with("x,z)") || inside.starts_with("z,x)"))
}
