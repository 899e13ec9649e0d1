//! Heights of waterlines: the distance between those that have numbers, and the plane from which heights count.

use super::assemble::TableReader;
use super::header::{
    Axis, Coordinate, Corner, Position, begins_as_number, counts_from_waterline, is_base_line, is_level, plain_number,
};
use super::matrix::Block;
use super::problem::{Field, FilePosition, Problems};
use super::settings::{Settings, metres};
use crate::hull::{Entry, OffsetTable, SideKind, SideLine, StationDatum, TableForm};
use crate::units::Notation;

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
        return counted(block, heads, spacing, noun, reader);
    }
    let unit = reader.units.z;
    let is_apart = said.as_ref().is_some_and(|(spacing, _)| are_apart(heads, *spacing, unit));
    if !counts || is_apart || !are_numbered(block, heads, settings, said.is_some()) {
        if block.across == Axis::Waterline && said.is_none() {
            warn_of_counts(block, heads, reader);
        }
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

/// The spacing that the conventions state, where numbers count it; none, with a warning, where they are so far apart already.
fn counted(block: &Block, heads: &[Position], spacing: f64, noun: &str, reader: &mut TableReader<'_>) -> Option<f64> {
    let written = |(head, field): (&Position, &Field)| !head.named || is_decimal(field.trimmed());
    let has_unit = has_unit(block, reader.settings) && !heads.iter().any(|head| head.named);
    let are_apart = heads.iter().zip(&block.heads).all(written) && are_apart(heads, spacing, reader.units.z);
    let are_positions = has_unit || are_apart;
    if are_positions && heads.iter().any(|head| head.number().is_some()) {
        let message = format!("{noun}_spacing {} m is not used: {noun}s stand at their positions", metres(spacing));
        let remedy = format!("Take {noun}_spacing away, or name the {noun}s by their numbers");
        reader.problems.warning("W332", FilePosition::FILE, message, &remedy);
    }
    Some(spacing).filter(|_| !are_positions)
}

/// Whether a unit of heights is stated.
fn has_unit(block: &Block, settings: &Settings) -> bool {
    let corner = Corner::of(block.corner.trimmed());
    let of_heights = corner.rows.is_none_or(|axis| !axis.is_station()) || corner.columns.is_some();
    settings.z_units.is_some() || corner.unit.is_some() && of_heights
}

/// Whether most plain numbers are a spacing other than 1 apart \[m\], so that they are positions and no numbers.
fn are_apart(heads: &[Position], spacing: f64, unit: Notation) -> bool {
    let numbers: Vec<f64> = heads.iter().filter_map(Position::number).collect();
    let near = |a: f64, b: f64| (a - b).abs() < 1e-3 * b.abs();
    let steps: Vec<f64> = numbers.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    let apart = steps.iter().filter(|step| near(unit.metres(**step), spacing)).count();
    let by_one = steps.iter().filter(|step| near(**step, 1.0)).count();
    apart > by_one && 2 * apart >= steps.len()
}

/// Says where heights follow each other in whole numbers beside stations that are numbered, or above a base line.
fn warn_of_counts(block: &Block, heads: &[Position], reader: &mut TableReader<'_>) {
    let numbers: Vec<f64> = heads.iter().filter_map(Position::number).collect();
    let by_one = numbers.windows(2).all(|pair| ((pair[1] - pair[0]).abs() - 1.0).abs() < 1e-9);
    let from_base = heads.iter().zip(&block.heads).any(|(head, field)| head.named && is_base_line(field.trimmed()));
    let beside_numbers = matches!(reader.form.origin, StationDatum::Numbers { .. });
    let is_written = block.heads.iter().any(|field| is_decimal(field.trimmed()));
    if !by_one || numbers.len() < LEAST_WHOLE || is_written || !(from_base || beside_numbers) {
        return;
    }
    if has_unit(block, reader.settings) {
        return;
    }
    let [first, .., last] = block.heads.as_slice() else { return };
    let message = format!(
        "waterlines '{}' to '{}' may be numbers, and their spacing is not known: taken as heights in {}",
        first.trimmed(),
        last.trimmed(),
        reader.units.z.as_str()
    );
    let remedy = "Give waterline_spacing or z_units in the conventions";
    reader.problems.warning("W320", FilePosition::FILE, message, remedy);
}

/// The spacing of the conventions \[m\], where the heights of points are numbers of waterlines that it counts: those of a column
/// that names waterlines, and others that follow each other by one; a warning where it is not used, and where numbers may be
/// such without it.
pub(super) fn counted_points(
    heights: &[&Field],
    names_waterlines: bool,
    unit: Option<Notation>,
    settings: &Settings,
    problems: &mut Problems,
) -> Option<f64> {
    let mut values: Vec<f64> = heights.iter().map(|field| plain_number(&field.text)).collect::<Option<_>>()?;
    values.sort_by(f64::total_cmp);
    values.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    let steps: Vec<f64> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let by_one = steps.iter().filter(|step| (*step - 1.0).abs() < 1e-9).count();
    let counts = 2 * by_one > steps.len() && values.iter().all(|value| (4.0 * value).fract().abs() < 1e-9);
    let (first, last) = (*values.first()?, *values.last()?);
    match settings.waterline_spacing {
        Some(spacing) if unit.is_none() && (names_waterlines || counts) => Some(spacing),
        Some(spacing) => {
            let message = format!(
                "waterline_spacing {} m is not used: points stand at heights {first} to {last}",
                metres(spacing)
            );
            let remedy = "Take waterline_spacing away, or give the numbers of the waterlines";
            problems.warning("W332", FilePosition::FILE, message, remedy);
            None
        }
        None => {
            if names_waterlines && counts && unit.is_none() && values.len() > 2 && first.fract().abs() < 1e-9 {
                let message = format!(
                    "waterlines {first} to {last} may be numbers, and their spacing is not known: taken as heights"
                );
                let remedy = "Name the column z, or give waterline_spacing in the conventions";
                problems.warning("W320", FilePosition::FILE, message, remedy);
            }
            None
        }
    }
}

/// Fewer whole numbers among waterlines are no numbers where others have decimals.
const LEAST_WHOLE: usize = 4;

/// Whether the waterlines have numbers, as WL 0, WL 1/2, WL 1, WL 2, and nothing says how far apart they are; where words do (`are_spaced`), bare numbers are such too. What is written
/// with a decimal sign or with a unit is a height.
fn are_numbered(block: &Block, heads: &[Position], settings: &Settings, are_spaced: bool) -> bool {
    if has_unit(block, settings) {
        return false;
    }
    let named = heads.iter().filter(|head| head.named).count();
    let by_corner = names_waterlines(block.corner.trimmed());
    // Halves may be written with a decimal sign, whole numbers are not.
    let count = |(head, field): (&Position, &Field)| match head.place {
        Coordinate::Length(_) => is_level(field.trimmed()),
        Coordinate::Number(number) => {
            (4.0 * number).fract().abs() < 1e-9 && (!is_decimal(field.trimmed()) || number.fract().abs() > 1e-9)
        }
        _ => false,
    };
    let whole = block.heads.iter().filter(|field| !is_decimal(field.trimmed())).count();
    let named = are_spaced || by_corner || 2 * named > heads.len();
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

/// Words above the points of a text that heights count from the waterline.
pub(super) fn from_waterline_above(text: &str) -> Option<String> {
    let above = text.lines().map(str::trim).take_while(|line| !begins_as_number(line));
    above.map(|line| line.trim_start_matches('#').trim()).find(|line| counts_from_waterline(line)).map(str::to_owned)
}

/// Words of a table, in its cells or its comments, that heights count from the waterline.
pub(super) fn from_waterline(rows: &[Vec<Field>], comments: &[(usize, String)]) -> Option<String> {
    let fields = rows.iter().flatten().map(Field::trimmed);
    let texts = fields.chain(comments.iter().map(|(_, text)| text.as_str()));
    texts.filter(|text| text.contains(char::is_alphabetic)).find(|text| counts_from_waterline(text)).map(str::to_owned)
}

/// Moves the heights of a table that counts them from the waterline, so that they count from the base line.
///
/// `words` say so, and the waterline is at the draught \[m\].
pub(super) fn settle(table: &mut OffsetTable, words: Option<&str>, draught: Option<f64>, problems: &mut Problems) {
    let Some(words) = words else { return };
    let mut lowest = f64::INFINITY;
    for_each(table, |height| lowest = lowest.min(*height));
    if lowest >= 0.0 {
        let message = format!(
            "'{words}' is not followed: no height lies below the waterline, and all are taken from the base line"
        );
        problems.warning("W320", FilePosition::FILE, message, "Give heights above the base line");
        return;
    }
    let Some(draught) = draught else {
        let message =
            format!("heights count from the waterline, by '{words}', and its height above the base line is not known");
        let remedy = "Give the draught T in the conventions, or heights above the base line";
        problems.error("E311", FilePosition::FILE, message, remedy);
        return;
    };
    let message =
        format!("heights count from the waterline, by '{words}', at T {} m above the base line", metres(draught));
    problems.warning("W320", FilePosition::FILE, message, "Correct T if the waterline lies elsewhere");
    for_each(table, |height| *height += draught);
    // What is written from now on counts from the base line.
    table.form = above_base(std::mem::take(&mut table.form));
    table.stations.iter_mut().flat_map(|station| &mut station.heights).for_each(|cell| cell.written = None);
}

/// Goes over all heights of a table \[m\].
fn for_each(table: &mut OffsetTable, mut visit: impl FnMut(&mut f64)) {
    table.waterlines.iter_mut().for_each(&mut visit);
    for station in &mut table.stations {
        for cell in &mut station.heights {
            if let Entry::Given(height) = &mut cell.entry {
                visit(height);
            }
        }
        let sides = [
            &mut station.keel_height,
            &mut station.flat_of_side,
            &mut station.deck_height,
            &mut station.deck_centre_height,
        ];
        sides.into_iter().flatten().for_each(&mut visit);
        station.outlines.iter_mut().flatten().for_each(|point| visit(&mut point.z));
    }
    table.lines.iter_mut().flat_map(|line| &mut line.points).for_each(|point| visit(&mut point[2]));
}

/// The form of a table whose heights no longer count from where its words say.
fn above_base(form: TableForm) -> TableForm {
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
        boat_lines: Vec::new(),
        ..form
    }
}
