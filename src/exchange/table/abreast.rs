//! Sections side by side, two columns a station: `y | z | y | z`, with the stations in the row above, or in the words of the
//! columns (`St 3 y | St 3 z`), as rows of one point each.

use super::columns::{Column, column};
use super::header::begins_as_number;
use super::problem::{Field, Problems};
use crate::units::counted;

/// The header stands among so many rows.
const HIGHEST_HEADER: usize = 20;
/// Fewer pairs of columns are no sections.
const LEAST_PAIRS: usize = 2;

/// Two columns of one station.
struct Pair {
    station: Field,
    y: usize,
    z: usize,
}

/// What a header says of its column: half-breadths (`true`) or heights, and the words before that.
fn ordinate(field: &Field) -> Option<(bool, String)> {
    let of = |text: &str| match column(text)?.column {
        Column::Y => Some(true),
        Column::Z => Some(false),
        _ => None,
    };
    let text = field.trimmed();
    if let Some(is_y) = of(text) {
        return Some((is_y, String::new()));
    }
    // `St 3 y`, `St 3: y [m]`, `St 3 (y)`; a unit in brackets belongs to the last word.
    let bare = text.strip_suffix([')', ']']).filter(|bare| bare.ends_with(['y', 'z', 'Y', 'Z'])).unwrap_or(text);
    let parts = bare.match_indices([' ', '_', ',', ':', '(', '-']).map(|(at, _)| bare.split_at(at));
    let mut found =
        parts.filter_map(|(before, after)| Some((of(after.trim_matches([' ', '_', ',', ':', '(', '-']))?, before)));
    found.next_back().map(|(is_y, before)| (is_y, before.trim_matches([' ', '_', ',', ':', '(', '-']).to_owned()))
}

/// The pairs of columns below a row of headers, where all its words but the first are of such.
fn pairs(rows: &[Vec<Field>], at: usize) -> Option<Vec<Pair>> {
    let named: Vec<(usize, bool, String)> = rows[at]
        .iter()
        .enumerate()
        .filter_map(|(k, field)| ordinate(field).map(|(is_y, name)| (k, is_y, name)))
        .collect();
    let others = rows[at].iter().filter(|field| !field.is_blank()).count() - named.len();
    if named.len() < 2 * LEAST_PAIRS || named.len() % 2 == 1 || others > 1 {
        return None;
    }
    let above = rows[..at].iter().rev().find(|row| row.iter().any(|field| !field.is_blank()));
    let mut list = Vec::new();
    for pair in named.chunks(2) {
        let [(first, is_y, name), (second, other, own)] = pair else { return None };
        if is_y == other || name != own || second - first > 2 {
            return None;
        }
        let station = if name.is_empty() {
            above?.get(*first..=*second)?.iter().find(|field| !field.is_blank())?.clone()
        } else {
            Field { text: name.clone(), ..rows[at][*first].clone() }
        };
        let (y, z) = if *is_y { (*first, *second) } else { (*second, *first) };
        list.push(Pair { station, y, z });
    }
    let differ = |k: usize| list[..k].iter().all(|other| other.station.trimmed() != list[k].station.trimmed());
    (0..list.len()).all(differ).then_some(list)
}

/// The number in words that give a distance: `x = 12.5`, `X: 3 m`.
fn distance(text: &str) -> Option<&str> {
    let rest = text.trim().strip_prefix(['x', 'X'])?.trim_start_matches([' ', '=', ':']);
    begins_as_number(rest).then_some(rest)
}

/// Makes rows of points of sections that stand side by side.
pub(super) fn settle(rows: &mut Vec<Vec<Field>>, problems: &mut Problems) {
    let Some((at, list)) = (0..rows.len().min(HIGHEST_HEADER)).find_map(|at| Some((at, pairs(rows, at)?))) else {
        return;
    };
    let header = &rows[at];
    let above = rows[..at].iter().rposition(|row| row.iter().any(|field| !field.is_blank()));
    let by_names = header.get(list[0].y).and_then(ordinate).is_none_or(|(_, name)| !name.is_empty());
    let above = above.filter(|_| !by_names);
    // What the label of the row of stations says: `x [m]`, `Station`.
    let label = above.and_then(|k| rows[k].iter().take(list[0].y.min(list[0].z)).find(|field| !field.is_blank()));
    let are_distances = list.iter().all(|pair| distance(pair.station.trimmed()).is_some());
    let word = |text: &str| Field { text: text.to_owned(), ..header[list[0].y].clone() };
    let ordinates = |k: usize| {
        let text = header[k].trimmed();
        let (_, name) = ordinate(&header[k]).unwrap_or_default();
        word(text[name.len()..].trim_matches([' ', '_', ',', ':', '(', ')', '-']))
    };
    let along = match label.filter(|label| column(label.trimmed()).is_some()) {
        Some(label) => label.clone(),
        None => word(if are_distances { "x" } else { "station" }),
    };
    let mut points = vec![vec![along, ordinates(list[0].y), ordinates(list[0].z)]];
    let body = &rows[at + 1..];
    for pair in &list {
        let text = if are_distances { distance(pair.station.trimmed()) } else { None };
        let station = Field { text: text.unwrap_or(pair.station.trimmed()).to_owned(), ..pair.station.clone() };
        let cells = body.iter().filter_map(|row| Some([row.get(pair.y)?, row.get(pair.z)?]));
        let filled = cells.filter(|cells| cells.iter().any(|cell| !cell.is_blank()));
        points.extend(filled.map(|[y, z]| vec![station.clone(), y.clone(), z.clone()]));
    }
    problems
        .note(format!("{} side by side, with columns of half-breadths and of heights", counted(list.len(), "section")));
    rows.splice(above.unwrap_or(at).., points);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settled(text: &str) -> Vec<String> {
        let field = |row: usize, (k, text): (usize, &str)| Field { text: text.to_owned(), row, column: k + 1 };
        let of_line =
            |(row, line): (usize, &str)| line.split(',').enumerate().map(|part| field(row + 1, part)).collect();
        let mut rows: Vec<Vec<Field>> = text.lines().enumerate().map(of_line).collect();
        settle(&mut rows, &mut Problems::new("t"));
        rows.iter().map(|row| row.iter().map(Field::trimmed).collect::<Vec<_>>().join(",")).collect()
    }

    #[test]
    fn columns_of_stations_become_rows_of_points() {
        let points = ["station,y,z", "St 1,0,1", "St 1,2,3", "St 2,4,5"];
        for text in [
            "St 1,,St 2,\ny,z,y,z\n0,1,4,5\n2,3,,",
            "St 1 y,St 1 z,St 2 y,St 2 z\n0,1,4,5\n2,3,,",
            "Point,St 1 (y),St 1 (z),St 2 (y),St 2 (z)\n1,0,1,4,5\n2,2,3,,",
            "St 1,St 1,St 2,St 2\nz,y,z,y\n1,0,5,4\n3,2,,",
        ] {
            assert_eq!(settled(text), points, "{text}");
        }
        let by_distance = settled("x = 1 m,,x = 2.5 m,\ny [m],z [m],y [m],z [m]\n0,1,4,5");
        assert_eq!(by_distance, ["x,y [m],z [m]", "1 m,0,1", "2.5 m,4,5"]);
        assert_eq!(settled("x [ft],1,,2,\n,y,z,y,z\n,0,1,4,5")[..2], ["x [ft],y,z", "1,0,1"]);
    }

    #[test]
    fn other_tables_stay() {
        for text in ["x,y,z\n0,1,2\n0,2,3", "station,WL 1,WL 2\n0,1,2", "y,z,y,z\n0,1,2,3", "x,y,z,x,y,z\n0,1,2,0,1,2"]
        {
            assert_eq!(settled(text), text.lines().collect::<Vec<_>>(), "{text}");
        }
    }
}
