//! Suspects among the heights and half-breadths of the lines of a boat: each number against a smooth line through the
//! others of its row.
//!
//! Rows are graphs over the length and are judged as sections are (head of `outline.rs`). They are short: six to twelve
//! stations. Parabolas through three neighbours are heard besides; rows of the same numbers say how even lines are.

use super::outline::{Judge, LinePlace, Number, PointNumber, PointSuspects, Predictor, Run, search};
use super::reading::Writing;
use crate::hull::{OffsetTable, OutlinePoint, Written, WrittenLine, WrittenPoint};

const PREDICTORS: [Predictor; 7] = [
    Predictor { offsets: &[-2, -1, 1, 2], degree: 3 },
    Predictor { offsets: &[-2, -1, 1, 2], degree: 2 },
    Predictor { offsets: &[-2, -1, 1], degree: 2 },
    Predictor { offsets: &[-1, 1, 2], degree: 2 },
    Predictor { offsets: &[-3, -2, -1], degree: 2 },
    Predictor { offsets: &[1, 2, 3], degree: 2 },
    Predictor { offsets: &[-1, 1], degree: 1 },
];

/// Points of a line that give one of its numbers, by index.
fn row(line: &WrittenLine, number: usize) -> Vec<usize> {
    (0..line.points.len()).filter(|k| line.points[*k].cells[number].is_some()).collect()
}

/// Index of a point in the section of its station; none where the table has no such point.
fn place(table: &OffsetTable, point: &WrittenPoint) -> Option<usize> {
    let same = |p: &OutlinePoint| (p.y - point.given[0]).hypot(p.z - point.given[1]) < 1e-6;
    table.stations.get(point.station)?.outlines.first()?.iter().position(same)
}

/// Whether the table has lines of a boat, and their points as they were written.
pub(super) fn has_lines(table: &OffsetTable) -> bool {
    let mut points = table.form.boat_lines.iter().flat_map(|line| &line.points).peekable();
    points.peek().is_some() && points.all(|point| place(table, point).is_some())
}

/// The suspects among the numbers of lines; a branch is a number, half-breadth or height, until they are named.
pub(super) fn line_suspects(table: &OffsetTable) -> PointSuspects {
    let lines = &table.form.boat_lines;
    let quantum = table.form.quantum().unwrap_or(1e-4);
    let mut runs = Vec::new();
    for (station, line) in lines.iter().enumerate() {
        for branch in 0..2 {
            let points: Vec<[f64; 2]> = row(line, branch)
                .into_iter()
                .map(|k| [table.stations[line.points[k].station].station.x, line.points[k].given[branch]])
                .collect();
            let aside = vec![false; points.len()];
            runs.push(Run { station, branch, first: 0, points, aside, is_graph: true });
        }
    }
    let beside = |run: &Run| {
        let same = |other: &Run| other.branch == run.branch && other.station != run.station;
        runs.iter().enumerate().filter(|(_, other)| same(other)).map(|(k, _)| k).collect()
    };
    let beside = runs.iter().map(beside).collect();
    let breadths = Writing::of(&table.form);
    let heights = Writing { notation: table.form.z_notation, factor: 1.0, ..breadths };
    let numbers = |run: &Run, at: usize| {
        let (line, number) = (&lines[run.station], run.branch);
        let cell = line.points[row(line, number)[at]].cells[number].as_ref();
        let named = |cell: &Written| Number {
            index: 1,
            number: [PointNumber::HalfBreadth, PointNumber::Height][number],
            text: cell.text.clone(),
            writing: [breadths, heights][number],
            line: Some(LinePlace { name: line.name.clone(), row: cell.row, column: cell.column }),
        };
        cell.map(named).into_iter().collect()
    };
    let mut found = search(Judge::new(runs, beside, quantum, &PREDICTORS), &numbers);
    for suspect in &mut found.suspects {
        let number = suspect.branch;
        let line = &lines[suspect.station];
        let point = &line.points[row(line, number)[suspect.point]];
        let other = 1 - number;
        let whole = |value: f64| if number == 0 { [value, point.given[other]] } else { [point.given[other], value] };
        (suspect.given, suspect.expected) = (point.given, whole(suspect.expected[1]));
        suspect.station = point.station;
        suspect.branch = 0;
        suspect.point = place(table, point).unwrap_or(0);
    }
    found
}
