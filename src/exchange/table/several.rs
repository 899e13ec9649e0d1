//! Rows that stand for several stations, as drawings have them in a parallel body: `4,5,6`, `4, 5 & 6`, `4-6`, `4 to 6`.

use super::header::{is_orderly, position};
use super::matrix::{Block, MatrixRow};
use super::problem::{Field, Problems};

/// No row stands for more stations.
const MOST: usize = 100;

fn whole(text: &str) -> Option<u32> {
    text.trim().parse().ok()
}

/// From one station to another, in steps of one.
fn range(first: u32, last: u32) -> Option<Vec<u32>> {
    let between = first.abs_diff(last);
    if between == 0 || between as usize >= MOST {
        return None;
    }
    Some(if first < last { (first..=last).collect() } else { (last..=first).rev().collect() })
}

/// The stations that a header lists; none where it lists none, or one alone.
fn listed(text: &str) -> Option<Vec<u32>> {
    let lower = text.to_lowercase().replace(['\u{2010}', '\u{2011}', '\u{2012}', '\u{2013}', '\u{2014}'], "-");
    let bare = lower.trim_start_matches(|c: char| c.is_alphabetic() || matches!(c, ' ' | '.'));
    let bare =
        bare.replace(" and ", ",").replace(['&', '+'], ",").replace(" to ", "-").replace("..", "-").replace(", ,", ",");
    let mut list = Vec::new();
    for part in bare.split(',').filter(|part| !part.trim().is_empty()) {
        let numbers: Vec<u32> = part.split('-').map(whole).collect::<Option<_>>()?;
        match numbers[..] {
            [one] => list.push(one),
            [first, last] => list.extend(range(first, last)?),
            // 4-5-6, one after the other.
            _ if numbers.windows(2).all(|pair| pair[0].abs_diff(pair[1]) == 1) => list.extend(numbers),
            _ => return None,
        }
    }
    (list.len() > 1 && list.len() <= MOST && is_orderly(&list)).then_some(list)
}

/// The plain number of a station.
fn number(head: &Field, comma: bool) -> Option<f64> {
    position(head.trimmed(), comma).ok()?.number()
}

/// Whether stations stand between those before and after them, one of which is a number at least.
fn fits(list: &[u32], before: Option<f64>, after: Option<f64>) -> bool {
    let ends = [list[0], list[list.len() - 1]].map(f64::from);
    let rises = ends[1] > ends[0];
    let follows = |a: f64, b: f64| if rises { a < b } else { a > b };
    (before.is_some() || after.is_some())
        && before.is_none_or(|number| follows(number, ends[0]))
        && after.is_none_or(|number| follows(ends[1], number))
}

/// The stations of a row of a block, where it lists several.
fn stations_of(rows: &[MatrixRow], at: usize, comma: bool) -> Option<(Vec<u32>, bool)> {
    let head = rows[at].head.trimmed();
    let list = listed(head)?;
    // 4,5 among decimal commas is a number, but for whole stations on all other rows.
    let is_decimal = comma && number(&rows[at].head, comma).is_some();
    let others = rows.iter().enumerate().filter(|(k, _)| *k != at).map(|(_, row)| &row.head);
    let whole_others = others.clone().all(|head| !head.text.contains(','));
    let successive = list.len() == 2 && list[0].abs_diff(list[1]) == 1;
    if is_decimal && !(whole_others && successive) {
        return None;
    }
    let neighbour = |row: Option<&MatrixRow>| row.and_then(|row| number(&row.head, comma));
    let (before, after) = (neighbour(at.checked_sub(1).and_then(|k| rows.get(k))), neighbour(rows.get(at + 1)));
    fits(&list, before, after).then_some((list, is_decimal))
}

/// Gives every station of a list a row of its own, with the same offsets.
pub(super) fn expand(blocks: &mut [Block], comma: bool, problems: &mut Problems) {
    for block in blocks {
        let mut rows = Vec::with_capacity(block.stations.len());
        for (at, row) in block.stations.iter().enumerate() {
            let Some((list, is_decimal)) = stations_of(&block.stations, at, comma) else {
                rows.push(row.clone());
                continue;
            };
            let names: Vec<String> = list.iter().map(u32::to_string).collect();
            let message = format!("the header '{}' stands for the stations {}", row.head.trimmed(), names.join(", "));
            if is_decimal {
                let remedy = "Write 4 & 5 for two stations, or 4.5";
                problems.warning("W320", row.head.place(), format!("{message}, not for a decimal number"), remedy);
            } else {
                problems.note(message);
            }
            let station = |name: String| MatrixRow { head: Field { text: name, ..row.head.clone() }, ..row.clone() };
            rows.extend(names.into_iter().map(station));
        }
        block.stations = rows;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_stations() {
        for text in ["4,5,6", "4, 5 & 6", "4-6", "4 to 6", "4\u{2013}6", "STN 4, 5 and 6", "4-5-6", "Stations 4..6"] {
            assert_eq!(listed(text), Some(vec![4, 5, 6]), "{text}");
        }
        assert_eq!(listed("6-4"), Some(vec![6, 5, 4]));
        for text in ["4", "4.5", "", "AP", "3-4-7", "5,4,6", "4-4", "0-1000", "WL 3 (1.5 m)"] {
            assert_eq!(listed(text), None, "{text}");
        }
    }

    #[test]
    fn lists_stand_between_their_neighbours() {
        assert!(fits(&[4, 5, 6], Some(2.0), Some(8.0)) && fits(&[4, 5, 6], None, Some(8.0)));
        assert!(!fits(&[4, 5, 6], Some(5.0), Some(8.0)) && !fits(&[4, 5, 6], None, None));
        assert!(fits(&[6, 5, 4], Some(8.0), Some(2.0)));
    }
}
