//! Half-breadths that are printed in several tables: more stations at the same waterlines, or more waterlines at the same
//! stations.

use super::header::{Axis, Coordinate, is_orderly, position};
use super::matrix::{Block, MatrixRow};
use super::problem::{Field, Problems};
use crate::units::{CellEntry, CellRules, Notation, parse_cell};

/// From one waterline to the next the sum of half-breadths changes by no larger factor.
const MOST_CHANGE: f64 = 2.0;

/// Where fields stand, as they are written; none where one names no place.
fn places(fields: &[&Field], comma: bool) -> Option<Vec<Coordinate>> {
    fields.iter().map(|field| position(field.trimmed(), comma).ok().map(|position| position.place)).collect()
}

fn number(place: Coordinate) -> Option<f64> {
    match place {
        Coordinate::Number(number) | Coordinate::Length(number) => Some(number),
        Coordinate::AftPerpendicular | Coordinate::ForePerpendicular | Coordinate::Midship => None,
    }
}

/// Whether places rise or fall all along; those without a number are left to the reader of positions.
fn follow_each_other(places: impl Iterator<Item = Coordinate>) -> bool {
    is_orderly(&places.filter_map(number).collect::<Vec<f64>>())
}

/// Which of two lists of places comes first, when they have none in common and follow each other.
fn second_first(a: &[Coordinate], b: &[Coordinate]) -> Option<bool> {
    if a.iter().any(|place| b.contains(place)) {
        return None;
    }
    let joined = |first: &[Coordinate], second: &[Coordinate]| follow_each_other(first.iter().chain(second).copied());
    if joined(a, b) {
        return Some(false);
    }
    joined(b, a).then_some(true)
}

fn extend<T>(list: &mut Vec<T>, more: Vec<T>, before: bool) {
    if before {
        list.splice(0..0, more);
    } else {
        list.extend(more);
    }
}

/// Whether the rows of two tables have the same fields beside the offsets.
fn same_sides(a: &Block, b: &Block) -> bool {
    a.sides.len() == b.sides.len() && a.sides.iter().zip(&b.sides).all(|(a, b)| a.kind == b.kind)
}

fn heads(block: &Block) -> Vec<&Field> {
    block.heads.iter().collect()
}

fn lines(block: &Block) -> Vec<&Field> {
    block.stations.iter().map(|row| &row.head).collect()
}

/// Whether offsets go on from one table to the next: where they meet, the sums of both are alike. Heights at buttocks are
/// not.
fn is_continuous(block: &Block, other: &Block, before: bool, comma: bool) -> bool {
    let rules = CellRules { unit: Notation::Metres, decimal_comma: comma };
    let value = |field: Option<&Field>| match parse_cell(&field?.text, rules).ok()?.entry {
        CellEntry::Length(length) => Some(length.abs()),
        CellEntry::Absent | CellEntry::Unknown => None,
    };
    let mut sums = [0.0, 0.0];
    for (own, more) in block.stations.iter().zip(&other.stations) {
        let ends = if before { (own.cells.first(), more.cells.last()) } else { (own.cells.last(), more.cells.first()) };
        if let (Some(a), Some(b)) = (value(ends.0), value(ends.1)) {
            sums = [sums[0] + a, sums[1] + b];
        }
    }
    sums[0].max(sums[1]) <= MOST_CHANGE * sums[0].min(sums[1])
}

/// The second table without the station that both have where they meet, as aft bodies and fore bodies have midship, when
/// its offsets are the same in both.
fn without_shared(
    block: &Block,
    mut other: Block,
    along: &[Coordinate],
    mut more_along: Vec<Coordinate>,
) -> (Block, Vec<Coordinate>) {
    let texts = |row: &MatrixRow| -> Vec<String> { row.cells.iter().map(|cell| cell.trimmed().to_owned()).collect() };
    let same = |own: Option<&MatrixRow>, more: Option<&MatrixRow>| {
        own.zip(more).is_some_and(|(own, more)| texts(own) == texts(more))
    };
    let count = other.stations.len();
    if count > 1 && along.last() == more_along.first() && same(block.stations.last(), other.stations.first()) {
        other.stations.remove(0);
        more_along.remove(0);
    } else if count > 1 && along.first() == more_along.last() && same(block.stations.first(), other.stations.last()) {
        other.stations.pop();
        more_along.pop();
    }
    (other, more_along)
}

/// Puts `other` into `block`; gives it back where it does not go on with it.
fn join(block: &mut Block, other: Block, comma: bool) -> Option<Block> {
    let all = (places(&heads(block), comma), places(&heads(&other), comma));
    let (Some(across), Some(more_across)) = all else { return Some(other) };
    let all = (places(&lines(block), comma), places(&lines(&other), comma));
    let (Some(along), Some(more_along)) = all else { return Some(other) };
    if across == more_across && same_sides(block, &other) {
        let (other, more_along) = without_shared(block, other, &along, more_along);
        let Some(before) = second_first(&along, &more_along) else { return Some(other) };
        extend(&mut block.stations, other.stations, before);
        block.endings.extend(other.endings);
        return None;
    }
    let same_endings = block.endings.len() == other.endings.len()
        && block.endings.iter().zip(&other.endings).all(|((a, _), (b, _))| a == b);
    if along != more_along || !same_endings || !other.sides.is_empty() {
        return Some(other);
    }
    let Some(before) = second_first(&across, &more_across) else { return Some(other) };
    if !is_continuous(block, &other, before, comma) {
        return Some(other);
    }
    extend(&mut block.heads, other.heads, before);
    let rows = |block: Block| -> Vec<MatrixRow> {
        block.stations.into_iter().chain(block.endings.into_iter().map(|(_, row)| row)).collect()
    };
    let more = rows(Block { heads: Vec::new(), ..other });
    let own = block.stations.iter_mut().chain(block.endings.iter_mut().map(|(_, row)| row));
    for (row, more) in own.zip(more) {
        extend(&mut row.cells, more.cells, before);
    }
    None
}

/// Joins tables of half-breadths that go on with each other; the others stay as they are.
pub(super) fn join_all(blocks: Vec<Block>, comma: bool, problems: &mut Problems) -> Vec<Block> {
    let mut list: Vec<Block> = Vec::new();
    let mut joined = 0;
    for block in blocks {
        let half = block.across == Axis::Waterline;
        match list.iter_mut().find(|first| half && first.across == Axis::Waterline) {
            Some(first) => match join(first, block, comma) {
                None => joined += 1,
                Some(block) => list.push(block),
            },
            None => list.push(block),
        }
    }
    if joined > 0 {
        problems.note(format!("half-breadths stand in {} tables, which are joined", joined + 1));
    }
    list
}
