//! Lengths of a table on a page: in its own notation, with metres beside another.

use crate::hull::{Kept, OffsetTable, TableForm};
use crate::units::Notation;

/// Decimals of feet, inches and centimetres where the table has none.
const DECIMALS: usize = 3;

/// `length` \[m\] in `notation`, and in metres with so many decimals: `7.7948 m`, or `25-6-7 (7.7948 m)`.
pub(in crate::report) fn length(notation: Notation, length: f64, decimals: usize) -> String {
    let metres = format!("{length:.decimals$} m");
    match notation {
        Notation::Metres => metres,
        Notation::FeetInchesEighths => format!("{} ({metres})", notation.write(length)),
        _ => format!("{} {} ({metres})", notation.write_to(length, Some(DECIMALS)), notation.as_str()),
    }
}

/// The notation of heights: that of half-breadths where plain numbers are feet among feet, inches and eighths.
pub(in crate::report) fn of_heights(form: &TableForm) -> Notation {
    match form.z_notation {
        Notation::Feet if form.notation == Notation::FeetInchesEighths => form.notation,
        notation => notation,
    }
}

/// The same with a sign, for a difference.
pub(in crate::report) fn difference(notation: Notation, by: f64, decimals: usize) -> String {
    match notation {
        Notation::Metres => format!("{by:+.decimals$} m"),
        _ if by < 0.0 => length(notation, by, decimals),
        _ => format!("+{}", length(notation, by, decimals)),
    }
}

/// The place of a waterline or a buttock: metres, or what its header has, with metres: `21 ft (6.401 m)`.
pub(in crate::report) fn place(notation: Notation, heads: &[Kept], at: f64) -> String {
    let metres = format!("{at:.3}");
    let near = |head: &&Kept| (head.value - at).abs() < 1e-9;
    // A header may state another unit than the table: `21 ft` in metres.
    let unit = |text: &str| text.rsplit_once(' ').and_then(|(_, word)| Notation::from_word(word));
    let is_other = |head: &&Kept| unit(&head.text).unwrap_or(notation) != Notation::Metres;
    match heads.iter().find(near).filter(is_other) {
        Some(head) => format!("{} ({metres} m)", head.text),
        None if notation == Notation::Metres => metres,
        None => length(notation, at, 3),
    }
}

/// The name of a station, with the unit of its distance where this is no metre and stands beside nothing else.
pub(in crate::report) fn station(table: &OffsetTable, index: usize) -> String {
    let name = &table.stations[index].station.name;
    let unit = match table.form.x_notation {
        Notation::FeetInchesEighths => Notation::Feet,
        other => other,
    };
    let is_distance = |number: f64| (unit.metres(number) - table.stations[index].station.x).abs() < 1e-9;
    match name.parse::<f64>() {
        Ok(number) if unit != Notation::Metres && is_distance(number) => format!("{name} {}", unit.as_str()),
        _ => name.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn metres_stand_beside_the_notation_of_the_table() {
        let feet = Notation::FeetInchesEighths;
        assert_eq!(length(Notation::Metres, 7.7948, 4), "7.7948 m");
        assert_eq!(length(feet, 0.3048, 4), "1-0-0 (0.3048 m)");
        assert_eq!(length(Notation::Millimetres, 0.5, 3), "500.000 mm (0.500 m)");
        assert_eq!(
            (difference(feet, 0.3048, 4), difference(feet, -0.3048, 4)),
            ("+1-0-0 (0.3048 m)".into(), "-1-0-0 (-0.3048 m)".into())
        );
        assert_eq!(difference(Notation::Metres, 0.5, 4), "+0.5000 m");
        let heads = [Kept { text: "21 ft".to_owned(), value: 6.4008 }];
        assert_eq!(
            (place(feet, &heads, 6.4008), place(feet, &heads, 0.3048)),
            ("21 ft (6.401 m)".into(), "1-0-0 (0.305 m)".into())
        );
        assert_eq!(place(Notation::Metres, &heads, 6.4008), "21 ft (6.401 m)");
        let heads = [Kept { text: "WL 3".to_owned(), value: 6.4008 }];
        assert_eq!(place(Notation::Metres, &heads, 6.4008), "6.401");
        let form = TableForm { notation: feet, z_notation: Notation::Feet, ..TableForm::default() };
        assert_eq!(of_heights(&form), feet);
    }
}
