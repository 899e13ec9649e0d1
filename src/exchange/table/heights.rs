//! Heights of waterlines: the distance between those that have numbers, and the plane from which heights count.

use super::assemble::TableReader;
use super::header::{Axis, Coordinate, Corner, Position, is_base_line};
use super::matrix::Block;
use super::problem::{Field, FilePosition, Problems};
use super::settings::{Settings, metres};
use crate::hull::{Entry, SideKind, SideLine, StationDatum, TableForm};

/// The distance between waterlines, or buttocks, that have numbers \[m\], where it is known; a warning where it is not.
pub(super) fn spacing(block: &Block, heads: &[Position], reader: &mut TableReader<'_>) -> Option<f64> {
    let settings = reader.settings;
    let (noun, stated, said) = match block.across {
        Axis::Buttock => ("buttock", settings.buttock_spacing, &settings.sentences.buttocks),
        _ => ("waterline", settings.waterline_spacing, &settings.sentences.waterlines),
    };
    // Buttocks 1, 2, 3 are numbers; 0.5, 2 and 4 are distances.
    let is_count = |pair: &[Position]| match (pair[0].place, pair[1].place) {
        (Coordinate::Number(a), Coordinate::Number(b)) => ((b - a).abs() - 1.0).abs() < 1e-9,
        _ => false,
    };
    let counts = block.across != Axis::Buttock || heads.windows(2).all(is_count);
    if let Some(spacing) = stated {
        let is_waterline = noun == "waterline" && !are_obeyed(block, heads, spacing, reader);
        if is_waterline && heads.iter().any(|head| matches!(head.place, Coordinate::Number(_))) {
            let message = format!("waterline_spacing {} m is not used: waterlines are heights", metres(spacing));
            let remedy = "Name waterlines WL 1, WL 2 if they are numbers, or leave the key out";
            reader.problems.warning("W332", FilePosition::FILE, message, remedy);
        }
        return stated;
    }
    if !counts {
        return None;
    }
    if !are_numbered(block, heads, settings) {
        may_be_numbers(block, heads, reader);
        return None;
    }
    let (message, remedy) = match said {
        Some((spacing, words)) => {
            let message = format!("'{words}' says that {noun}s are {} m apart", metres(*spacing));
            (message, format!("Give {noun}_spacing in the conventions if it does not"))
        }
        None => {
            let [first, .., last] = block.heads.as_slice() else { return None };
            let message = format!(
                "{noun}s are numbered, '{}' to '{}', and their spacing is not known: taken as 1 {} apart",
                first.trimmed(),
                last.trimmed(),
                reader.units.z.as_str()
            );
            let positions = if noun == "buttock" { "distances" } else { "heights" };
            (message, format!("Give {noun}_spacing in the conventions, or {positions} with their unit"))
        }
    };
    reader.problems.warning("W320", FilePosition::FILE, message, &remedy);
    said.as_ref().map(|(spacing, _)| *spacing)
}

/// Whether plain numbers over waterlines are such as the spacing stated is of: named, or none that already lie so far apart, where
/// no unit of heights is stated.
pub(super) fn are_obeyed(block: &Block, heads: &[Position], spacing: f64, reader: &TableReader<'_>) -> bool {
    if 2 * heads.iter().filter(|head| head.named).count() > heads.len() || names_waterlines(block.corner.trimmed()) {
        return true;
    }
    let step = usual_step(heads).map(|step| (reader.units.z.metres(step), step));
    !has_unit(block, reader.settings)
        && step.is_some_and(|(length, step)| (length / spacing - 1.0).abs() > 1e-6 && (step - 1.0).abs() < 1e-9)
}

/// The median step between the plain numbers of positions.
fn usual_step(heads: &[Position]) -> Option<f64> {
    let number = |head: &Position| if let Coordinate::Number(number) = head.place { Some(number) } else { None };
    let numbers: Vec<f64> = heads.iter().map(number).collect::<Option<_>>()?;
    let mut steps: Vec<f64> = numbers.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    steps.sort_by(f64::total_cmp);
    steps.get(steps.len() / 2).copied()
}

/// Whether a unit of heights is stated.
fn has_unit(block: &Block, settings: &Settings) -> bool {
    let corner = Corner::of(block.corner.trimmed());
    let of_heights = corner.rows.is_none_or(|axis| !axis.is_station()) || corner.columns.is_some();
    settings.z_units.is_some() || corner.unit.is_some() && of_heights
}

/// Says that waterlines 0, 1, 2, 3 are taken as heights, where stations are numbered too or the base line stands among them.
fn may_be_numbers(block: &Block, heads: &[Position], reader: &mut TableReader<'_>) {
    let whole = |(head, field): (&Position, &Field)| {
        matches!(head.place, Coordinate::Number(number) if (4.0 * number).fract().abs() < 1e-9)
            && !(is_decimal(field.trimmed()) && field.trimmed().ends_with(".0"))
    };
    let numbered = matches!(reader.form.origin, StationDatum::Numbers { .. });
    let base = block.heads.first().into_iter().chain(block.heads.last()).any(|head| is_base_line(head.trimmed()));
    let follow = usual_step(heads).is_some_and(|step| (step - 1.0).abs() < 1e-9);
    let all = heads.len() > 3 && heads.iter().zip(&block.heads).all(whole);
    let [first, .., last] = block.heads.as_slice() else { return };
    if block.across == Axis::Waterline && (numbered || base) && follow && all && !has_unit(block, reader.settings) {
        let message = format!(
            "waterlines '{}' to '{}' may be numbers, and their spacing is not known: taken as heights",
            first.trimmed(),
            last.trimmed()
        );
        let remedy = "Give waterline_spacing in the conventions, or z_units if they are heights";
        reader.problems.warning("W320", FilePosition::FILE, message, remedy);
    }
}

/// Fewer whole numbers among waterlines are no numbers where others have decimals.
const LEAST_WHOLE: usize = 4;

/// Whether the waterlines have numbers, as WL 0, WL 1/2, WL 1, WL 2, and nothing says how far apart they are. What is written
/// with a decimal sign or with a unit is a height.
fn are_numbered(block: &Block, heads: &[Position], settings: &Settings) -> bool {
    if has_unit(block, settings) {
        return false;
    }
    let named = heads.iter().filter(|head| head.named).count();
    let by_corner = names_waterlines(block.corner.trimmed());
    // Halves may be written with a decimal sign, whole numbers are not.
    let count = |(head, field): (&Position, &Field)| match head.place {
        Coordinate::Number(number) => {
            (4.0 * number).fract().abs() < 1e-9 && (!is_decimal(field.trimmed()) || number.fract().abs() > 1e-9)
        }
        _ => false,
    };
    let whole = block.heads.iter().filter(|field| !is_decimal(field.trimmed())).count();
    let named = by_corner || 2 * named > heads.len();
    let mostly = whole == heads.len() || whole >= LEAST_WHOLE && 2 * whole > heads.len();
    heads.len() > 2 && named && mostly && heads.iter().zip(&block.heads).all(count)
}

/// Whether a corner says of its columns that they are waterlines, and not heights.
pub(super) fn names_waterlines(corner: &str) -> bool {
    let after = corner.split_once(['\\', '/']).map_or(corner, |(_, after)| after);
    after
        .split(|c: char| !c.is_alphabetic())
        .any(|word| ["wl", "wls", "waterline", "waterlines"].contains(&word.to_lowercase().as_str()))
}

/// Whether the number of a header has a decimal sign; the point of an abbreviation is none.
fn is_decimal(text: &str) -> bool {
    let signs = text.char_indices().filter(|(_, c)| matches!(c, '.' | ','));
    signs.into_iter().any(|(at, _)| {
        text[at + 1..].starts_with(|c: char| c.is_ascii_digit()) && !text[..at].ends_with(char::is_alphabetic)
    })
}

/// Height of the plane above the base line from which heights count \[m\]: the draught, where words say so.
pub(super) fn level(blocks: &[Block], settings: &Settings, problems: &mut Problems) -> f64 {
    let Some(words) = &settings.from_waterline else { return 0.0 };
    let cells = |block: &Block| block.stations.iter().flat_map(|line| line.cells.clone()).collect::<Vec<Field>>();
    let heights = |block: &Block| if block.across == Axis::Waterline { block.heads.clone() } else { cells(block) };
    if !blocks.iter().flat_map(heights).any(|field| begins_below(field.trimmed())) {
        let message = format!(
            "'{words}' is not followed: no height lies below the waterline, and all are taken from the base line"
        );
        problems.warning("W320", FilePosition::FILE, message, "Give heights above the base line");
        return 0.0;
    }
    match settings.stated.draught {
        Some(draught) => {
            let message = format!(
                "heights count from the waterline, by '{words}', at T {} m above the base line",
                metres(draught)
            );
            problems.warning("W320", FilePosition::FILE, message, "Correct T if the waterline lies elsewhere");
            draught
        }
        None => {
            let message = format!(
                "heights count from the waterline, by '{words}', and its height above the base line is not known"
            );
            problems.error(
                "E311",
                FilePosition::FILE,
                message,
                "Give the draught T in the conventions, or heights above the base line",
            );
            0.0
        }
    }
}

/// Whether the first number of a text is below zero: `-6`, `WL -6`; a dash between words and numbers joins them.
fn begins_below(text: &str) -> bool {
    let start = text.find(|c: char| c.is_ascii_digit()).unwrap_or(text.len());
    let before = text[..start].trim_end_matches('.').strip_suffix(['-', '\u{2212}']);
    before.is_some_and(|before| !before.ends_with(char::is_alphabetic))
}

/// The form of a table whose heights no longer count from where its words say.
pub(super) fn above_base(form: TableForm) -> TableForm {
    let bare =
        |columns: Vec<SideLine>| columns.into_iter().map(|column| SideLine { texts: Vec::new(), ..column }).collect();
    let keeps_names = |columns: Vec<SideLine>| {
        let (names, others): (Vec<SideLine>, Vec<SideLine>) =
            columns.into_iter().partition(|c| c.kind == SideKind::Name);
        let others: Vec<SideLine> = bare(others);
        names.into_iter().chain(others).collect()
    };
    TableForm {
        preamble: Vec::new(),
        corner: None,
        waterline_heads: Vec::new(),
        buttock_corner: None,
        side_columns: keeps_names(form.side_columns),
        buttock_columns: keeps_names(form.buttock_columns),
        ..form
    }
}

/// Moves a height up \[m\].
pub(super) fn raise(entry: &mut Entry, by: f64) {
    if let Entry::Given(height) = entry {
        *height += by;
    }
}
