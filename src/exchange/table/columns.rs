//! What the columns of a table of one point a row hold, by the usual words of their headers.
//!
//! | column | headers |
//! |---|---|
//! | x | `x`, `pos_x`, `position`, `length`, `longitudinal position`, `LongPos`, `abscissa`, `distance`, `station position`, `frame location`, `x from AP` |
//! | station | `station`, `stn`, `st`, `sta`, `section`, `frame`, `ordinate`, `name` |
//! | z | `z`, `height`, `elevation`, `waterline height`, `height above base` |
//! | waterline | `waterline`, `wl`, `level`, `draught` |
//! | y | `y`, `offset`, `half-breadth`, `half_breadth`, `halfbreadth`, `half width`, `half beam`, `HB`; `breadth`, `width` or `beam` where no other column is one of these |
//! | index | none, `i`, `j`, `k`, `n`, `no`, `id`, `index`, `row`, `hull`, `ship`, and stations or waterlines with `id`, `no` or `index` |
//! | curve, flag, loop, point | `curve`, `kind`, `flag`, `mark`, `loop`, `branch`, `point` |
//!
//! A unit may follow (`y_mm`, `Offset [m]`), and what a fraction is of (`x/L`, `z/T`, `z/D`, `y/(B/2)`, `x_frac`). Columns of
//! the names of lines (`line`) are indices.

use super::header::unit_of;
use crate::units::Notation;

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Column {
    Station,
    X,
    Loop,
    Point,
    Y,
    Z,
    /// Waterlines by their height, or by their number.
    Waterline,
    Curve,
    Flag,
    /// A count of the rows, stations, waterlines or hulls.
    Index,
}

/// What a fraction is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Whole {
    Breadth,
    HalfBreadth,
    Depth,
    /// The header does not say it.
    Unsaid,
}

/// A header that is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Named {
    pub(super) column: Column,
    pub(super) unit: Option<Notation>,
    pub(super) from_ap: bool,
    pub(super) fraction: Option<Whole>,
}

/// A name in small letters without what it says of a fraction.
fn whole_of(name: &str) -> (String, Option<Whole>) {
    let close: String = name.chars().filter(|c| !matches!(c, ' ' | '(' | ')' | '_')).collect();
    for (end, whole) in [("/b/2", Whole::HalfBreadth), ("/0.5b", Whole::HalfBreadth), ("/b", Whole::Breadth)] {
        if let Some(bare) = close.strip_suffix(end) {
            return match bare.strip_prefix('2') {
                Some(bare) => (bare.to_owned(), Some(Whole::HalfBreadth)),
                None => (bare.to_owned(), Some(whole)),
            };
        }
    }
    if let Some(bare) = close.strip_suffix("/d") {
        return (bare.to_owned(), Some(Whole::Depth));
    }
    if let Some(bare) = ["/lpp", "/lbp", "/l", "/t"].iter().find_map(|end| close.strip_suffix(end)) {
        return (bare.to_owned(), Some(Whole::Unsaid));
    }
    let is_fraction = |word: &str| matches!(word, "frac" | "fraction" | "fractions" | "rel" | "relative" | "nondim");
    let words: Vec<&str> = name.split([' ', '_', '-', '(', ')', '[', ']']).filter(|word| !word.is_empty()).collect();
    if words.iter().any(|word| is_fraction(word)) {
        let rest: Vec<&str> = words.into_iter().filter(|word| !is_fraction(word)).collect();
        // Fractions without a word are those of half-breadths.
        let bare = if rest.is_empty() { "y".to_owned() } else { rest.join(" ") };
        return (bare, Some(Whole::Unsaid));
    }
    (name.to_owned(), None)
}

/// What a header says that its column holds; none where its words are not known.
pub(super) fn column(name: &str) -> Option<Named> {
    let (lower, fraction) = whole_of(&name.trim().to_lowercase());
    let unit = unit_of(&lower);
    let bracketed = lower.find(['[', '(']).filter(|_| unit.is_some());
    let parted = lower[..bracketed.unwrap_or(lower.len())].replace(['[', ']', '(', ')'], " ");
    let mut words: Vec<&str> = parted.split([' ', '_', '-']).filter(|word| !word.is_empty()).collect();
    if unit.is_some() && bracketed.is_none() && words.len() > 1 {
        words.pop();
    }
    let from_ap = words.ends_with(&["from", "ap"]);
    if from_ap {
        words.truncate(words.len() - 2);
    }
    // `z above LWL`, `height over base`: from where heights count.
    let level = words.iter().position(|word| matches!(*word, "above" | "over"));
    if let Some(at) = level.filter(|at| axis(&words[..*at].join(" ")) == Some(Column::Z)) {
        words.truncate(at);
    }
    let counts = words.len() > 1
        && words.last().is_some_and(|word| matches!(*word, "id" | "no" | "no." | "nr" | "number" | "index" | "idx"));
    let joined = words.join(" ");
    let column = match joined.trim_end_matches('.') {
        _ if counts => match axis(&words[..words.len() - 1].join(" "))? {
            Column::X | Column::Y | Column::Z | Column::Curve | Column::Flag => return None,
            _ => Column::Index,
        },
        "" | "i" | "j" | "k" | "n" | "no" | "nr" | "id" | "idx" | "index" | "#" | "row" | "hull" | "ship"
        | "vessel" | "model" | "line" | "line name" | "unnamed: 0" => Column::Index,
        words => axis(words)?,
    };
    Some(Named { column, unit, from_ap, fraction })
}

/// A column of breadths without a word for half or full.
pub(super) fn breadths(name: &str) -> Option<Named> {
    let lower = name.to_lowercase();
    let word = ["breadth", "width", "beam"].into_iter().find(|word| lower.contains(word))?;
    column(&lower.replacen(word, "half breadth", 1)).filter(|named| named.column == Column::Y)
}

/// Whether a header says ordinate, which is a station in some tables and a half-breadth in others.
pub(super) fn is_ordinate(name: &str) -> bool {
    let lower = name.to_lowercase();
    lower.split(|c: char| !c.is_alphabetic()).any(|word| word == "ordinate")
}

/// The words of the columns of points, for messages.
pub(super) const KNOWN: &str = "x or station, z or height, y or half-breadth, each perhaps with a unit, as 'x [m]'";

/// `x` of `pos x`, `x coordinate` or `x position`.
fn bare_axis(words: &str) -> Option<&str> {
    let around = |word: &&str| {
        matches!(*word, "pos" | "pos." | "position" | "coord" | "coordinate" | "co" | "ordinate" | "point" | "value")
    };
    let mut others = words.split(' ').filter(|word| !around(word));
    let axis = others.next().filter(|word| matches!(*word, "x" | "y" | "z"));
    axis.filter(|_| others.next().is_none())
}

fn axis(words: &str) -> Option<Column> {
    Some(match bare_axis(words).unwrap_or(words) {
        "station" | "stations" | "stn" | "sta" | "stat" | "st" | "section" | "frame" | "ordinate" | "name"
        | "spant" => Column::Station,
        "x"
        | "long. pos"
        | "longitudinal pos"
        | "longitudinal position"
        | "position"
        | "pos"
        | "distance"
        | "abscissa"
        | "longpos"
        | "long pos"
        | "longitudinal"
        | "longitudinal location"
        | "length"
        | "station position"
        | "frame position"
        | "section position"
        | "station location"
        | "frame location"
        | "section location"
        | "station x"
        | "x station" => Column::X,
        "loop" | "branch" => Column::Loop,
        "point" => Column::Point,
        "y" | "offset" | "half breadth" | "halfbreadth" | "half width" | "half beam" | "half ordinate"
        | "semi breadth" | "semibreadth" | "y offset" | "hb" | "halbbreite" => Column::Y,
        "z" | "height" | "h" | "elevation" | "waterline height" | "waterline z" => Column::Z,
        "waterline" | "water line" | "wl" | "level" | "draught" | "draft" | "wasserlinie" => Column::Waterline,
        "curve" | "kind" => Column::Curve,
        "flag" | "flags" | "mark" | "marks" => Column::Flag,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(name: &str) -> Column {
        column(name).unwrap_or_else(|| panic!("{name}")).column
    }

    #[test]
    fn the_usual_words() {
        for name in ["y", "Half-breadth [m]", "half_breadth", "offset_mm", "Half Breadth (ft)"] {
            assert_eq!(of(name), Column::Y, "{name}");
        }
        for name in ["station_id", "waterline_index", "i", "", "hull", "Station No", "Unnamed: 0"] {
            assert_eq!(of(name), Column::Index, "{name}");
        }
        assert_eq!((of("x_from_AP_m"), of("WL"), of("z [m]")), (Column::X, Column::Waterline, Column::Z));
        assert_eq!(column("y_mm").unwrap().unit, Some(Notation::Millimetres));
        assert_eq!((of("z above LWL"), of("Height above base (mm)")), (Column::Z, Column::Z));
        assert_eq!((of("x [feet-inches-eighths]"), of("Long. Pos (m)")), (Column::X, Column::X));
        assert!(column("x_from_ap_m").unwrap().from_ap);
        assert_eq!(breadths("breadth_m").map(|named| named.unit), Some(Some(Notation::Metres)));
        for name in ["breadth", "0.5", "WL 3", "keel", "beam"] {
            assert_eq!(column(name), None, "{name}");
        }
    }

    #[test]
    fn fractions() {
        let of = |name: &str| column(name).map(|named| (named.column, named.fraction));
        assert_eq!(of("x/L"), Some((Column::X, Some(Whole::Unsaid))));
        assert_eq!(of("y/(B/2)"), Some((Column::Y, Some(Whole::HalfBreadth))));
        assert_eq!(of("2y/B"), Some((Column::Y, Some(Whole::HalfBreadth))));
        assert_eq!(of("y / B"), Some((Column::Y, Some(Whole::Breadth))));
        assert_eq!(of("z_frac"), Some((Column::Z, Some(Whole::Unsaid))));
        assert_eq!(of("frac"), Some((Column::Y, Some(Whole::Unsaid))));
        assert_eq!(of("half_breadth_frac"), Some((Column::Y, Some(Whole::Unsaid))));
    }
}
