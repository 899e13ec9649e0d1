//! Diagonals of a table of lines: distances from the centreplane along a straight line of the body plan.
//!
//! Where they lie stands in a note, a comment or the label of the row: `Diagonal A: up 4-0-0 on CL, out 3-0-0 on base`,
//! `Diagonal B: up 3-6-0 on CL, out 2-0-0 at WL 1-0-0`, `Diag. C: up 4-0-0 on CL, 45 deg`.

use std::borrow::Cow;

use super::super::assemble::TableReader;
use super::super::header::Position;
use super::super::pieces::is_numeric;
use super::super::problem::Field;
use super::LinePoint;
use super::groups::{Row, words};
use crate::units::{CellEntry, CellRules, Notation, parse_cell};

/// What the program needs to place a diagonal.
const REMEDY: &str = "Define it in a note: 'Diagonal A: up 4-0-0 on CL, out 3-0-0 on base', or 'up 4-0-0 on CL, 45 deg below horizontal'";

/// A straight line of the body plan from the centreplane.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Diagonal {
    /// Height on the centreplane \[m\].
    height: f64,
    /// Outward and upward parts of its direction.
    direction: [f64; 2],
}

/// Rows without those that define diagonals, and what these say.
pub(super) fn without_definitions(rows: &[Vec<Field>]) -> (Cow<'_, [Vec<Field>]>, Vec<String>) {
    let text = |row: &[Field]| -> String {
        let filled: Vec<&str> = row.iter().filter(|field| !field.is_blank()).map(Field::trimmed).collect();
        filled.join(", ")
    };
    let defines = |row: &Vec<Field>| {
        let texts = row.iter().filter(|field| !field.is_blank());
        texts.clone().count() <= 4
            && !texts.clone().any(is_numeric)
            && split(&text(row)).is_some_and(|(_, rest)| is_definition(rest))
    };
    if !rows.iter().any(defines) {
        return (Cow::Borrowed(rows), Vec::new());
    }
    let (notes, kept): (Vec<_>, Vec<_>) = rows.iter().cloned().partition(defines);
    (Cow::Owned(kept), notes.iter().map(|row| text(row)).collect())
}

/// The name of a diagonal and what follows it: `a` and the rest of `Diagonal A: ...`.
fn split(text: &str) -> Option<(String, &str)> {
    let start = text.to_ascii_lowercase().find("diag")?;
    let end = start + text[start..].find([':', '=', ',', '('])?;
    let name = words(&text[start..end]).into_iter().skip(1).collect::<Vec<_>>().join(" ");
    Some((name, &text[end + 1..]))
}

/// Whether a text says where a line lies.
fn is_definition(text: &str) -> bool {
    let has = |word: &str| words(text).iter().any(|other| other == word);
    has("up") || has("out") || has("deg") || has("degrees") || text.contains('°')
}

/// A number of a definition: a length as it is written, or degrees.
enum Number<'t> {
    Length(&'t str),
    Degrees(f64),
}

/// The numbers of a definition, each with the words before it.
fn numbers(text: &str) -> Vec<(Vec<String>, Number<'_>)> {
    let (mut list, mut before) = (Vec::new(), Vec::new());
    let parts: Vec<&str> = text.split(|c: char| c.is_whitespace() || matches!(c, ',' | ';' | '(' | ')')).collect();
    for (k, part) in parts.iter().enumerate().filter(|(_, part)| !part.is_empty()) {
        if !part.starts_with(|c: char| c.is_ascii_digit()) {
            before.extend(words(part));
            continue;
        }
        let next = parts.get(k + 1).map_or(String::new(), |next| next.to_lowercase());
        let bare = part.trim_end_matches(['°', '.']);
        let number = match bare.parse::<f64>() {
            Ok(value) if part.ends_with('°') || next.starts_with("deg") || next == "°" => Number::Degrees(value),
            _ => Number::Length(bare),
        };
        list.push((std::mem::take(&mut before), number));
    }
    // Words behind the last number.
    list.push((before, Number::Length("")));
    list
}

/// What a definition says; none where it leaves anything open.
fn defined(text: &str, rules: CellRules) -> Option<Diagonal> {
    let list = numbers(text);
    let length = |k: usize| match list.get(k)? {
        (_, Number::Length(text)) => match parse_cell(text, rules).ok()?.entry {
            CellEntry::Length(value) => Some(value),
            _ => None,
        },
        (_, Number::Degrees(_)) => None,
    };
    let before =
        |k: usize, known: &[&str]| list.get(k).is_some_and(|(w, _)| w.iter().any(|w| known.contains(&w.as_str())));
    let height = length(0).filter(|_| before(0, &["up", "height", "h"]) || before(1, &["above", "up"]))?;
    if let Some((_, Number::Degrees(degrees))) = list.get(1) {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let even = (degrees - 45.0).abs() < 1e-9;
        let level = before(2, &["horizontal", "horizon", "level", "base", "wl"]);
        let plumb = before(2, &["vertical", "cl", "c.l.", "centreline", "centerline", "centreplane"]);
        let inside = *degrees > 0.0 && *degrees < 90.0;
        let direction = match (level, plumb) {
            (true, false) => [cosine, -sine],
            (false, true) => [sine, -cosine],
            _ if even => [cosine, -sine],
            _ => return None,
        };
        return inside.then_some(Diagonal { height, direction });
    }
    let out = length(1).filter(|_| before(1, &["out"]) || before(2, &["out"]))?;
    let other = match length(2) {
        Some(other) if before(2, &["up", "wl", "waterline", "above", "at", "height"]) => other,
        None if before(2, &["base", "bl", "baseline", "b.l."]) => 0.0,
        _ => return None,
    };
    let (dy, dz) = (out, other - height);
    let far = dy.hypot(dz);
    (out > 0.0 && far > 0.0).then(|| Diagonal { height, direction: [dy / far, dz / far] })
}

/// The points of a row of distances along a diagonal, or a warning that says what is missing.
pub(super) fn points(
    row: &Row<'_>,
    definitions: &[String],
    heads: &[(usize, Position)],
    reader: &mut TableReader<'_>,
    points: &mut Vec<LinePoint>,
) {
    let label = row.label.trimmed();
    let own = split(label);
    let name = own.as_ref().map_or_else(|| row.name.clone(), |(name, _)| name.clone());
    let rules = CellRules { unit: reader.units.z, decimal_comma: reader.form.decimal_comma };
    let all = own.into_iter().chain(definitions.iter().filter_map(|text| split(text)));
    let found = all.filter(|(other, _)| *other == name).find_map(|(_, text)| defined(text, rules));
    let Some(diagonal) = found else {
        let message = format!("left out: the diagonal '{label}', of which nothing says where it lies");
        return reader.problems.warning("W332", row.label.place(), message, REMEDY);
    };
    let [out, up] = diagonal.direction;
    let what = format!(
        "'{label}' counts from the centreplane, {} up, along a line that falls by {:.1} degrees",
        Notation::Metres.write_to(diagonal.height, Some(4)),
        -up.atan2(out).to_degrees()
    );
    reader.problems.note(what);
    for (station, (at, _)) in heads.iter().enumerate() {
        let Some(field) = row.cells.get(*at) else { continue };
        // Distances along a line are no full breadths.
        if let Some(distance) = reader.cell(field, false).value() {
            let (y, z) = (distance * out, diagonal.height + distance * up);
            points.push(LinePoint { station, name: label.to_owned(), is_cut: true, y, z, cells: [None, None] });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_placed_by_what_words_say() {
        let rules = CellRules { unit: Notation::FeetInchesEighths, decimal_comma: false };
        let foot = 0.3048;
        for (text, height, direction) in [
            ("Diagonal A: up 4-0-0 on CL, out 3-0-0 on base", 4.0, [0.6, -0.8]),
            ("Diagonal A: up 5-0-0 on CL, out 3-0-0 at WL 1-0-0", 5.0, [0.6, -0.8]),
            ("Diag. A (up 5-0-0 on CL, out 3-0-0 up 1-0-0)", 5.0, [0.6, -0.8]),
            ("DIAGONAL A = up 4-0-0 on C.L., 45°", 4.0, [0.5f64.sqrt(), -0.5f64.sqrt()]),
            ("Diagonal A: 4-0-0 above base on CL, 30 deg below horizontal", 4.0, [0.75f64.sqrt(), -0.5]),
            ("Diagonal A: height 4-0-0 on CL, 30 degrees to the centreline", 4.0, [0.5, -(0.75f64.sqrt())]),
        ] {
            let (name, rest) = split(text).unwrap();
            assert!(name == "a" && is_definition(rest), "{text}: {name} {rest}");
            let found = defined(rest, rules).unwrap_or_else(|| panic!("{text}"));
            let by = (found.height - height * foot).abs() + (found.direction[0] - direction[0]).abs();
            assert!(by + (found.direction[1] - direction[1]).abs() < 1e-12, "{text}: {found:?}");
        }
        for text in ["Diagonal A: up 4-0-0 on CL, 30 deg", "Diagonal A: out 3-0-0", "Diagonal A: up 4-0-0, out 3-0-0"] {
            assert_eq!(split(text).and_then(|(_, rest)| defined(rest, rules)), None, "{text}");
        }
    }
}
