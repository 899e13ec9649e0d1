//! The flat of side that a table shows and does not declare: offsets at its greatest half-breadth on all sides.
//!
//! Rounding makes a flat of every round crest, so that a run of equal offsets along a waterline or a station counts only
//! where the crest of a parabola does not explain it: with c the middle of the run (its end, where the table ends with
//! it), w its half length, and d what the next offset, at the distance e from c, is less, a parabola falls by d (w/e)^2
//! within the run; that is more than [`CREST`] steps of the writing on one side at least. What is left out as a suspect
//! belongs to the flat where both its neighbours along the waterline do.

use super::constraint::Rule;
use crate::hull::OffsetTable;

/// Steps of the writing by which the parabola of a round crest falls within a run that is flat.
const CREST: f64 = 2.0;

/// Multiples of the step of the writing that a table may be rounded to, the largest first: 5 cm in a table with two
/// decimals.
const MULTIPLES: [f64; 5] = [50.0, 20.0, 10.0, 5.0, 2.0];

/// Half-breadths that differ by less are equal, over the greatest.
const EQUAL: f64 = 1e-9;

/// Offsets on a grid of stations and waterlines, none where there is none or it was left out.
struct Grid {
    x: Vec<f64>,
    z: Vec<f64>,
    values: Vec<Vec<Option<f64>>>,
    /// Which of them are at the greatest half-breadth.
    full: Vec<Vec<bool>>,
    greatest: f64,
}

impl Grid {
    fn new(table: &OffsetTable, left_out: &[(usize, usize)]) -> Self {
        let value = |s: usize, w: usize| {
            let cell = table.stations[s].half_breadths.get(w)?;
            cell.value().filter(|_| !left_out.contains(&(s, w)))
        };
        let (x, z): (Vec<f64>, Vec<f64>) =
            (table.stations.iter().map(|s| s.station.x).collect(), table.waterlines.clone());
        let values: Vec<Vec<Option<f64>>> = (0..x.len()).map(|s| (0..z.len()).map(|w| value(s, w)).collect()).collect();
        let greatest = values.iter().flatten().flatten().fold(0.0_f64, |most, y| most.max(*y));
        let at = |y: &Option<f64>| y.is_some_and(|y| greatest - y <= EQUAL * greatest);
        let mut full: Vec<Vec<bool>> = values.iter().map(|row| row.iter().map(at).collect()).collect();
        for &(s, w) in left_out {
            if s > 0 && s + 1 < x.len() && w < z.len() && full[s - 1][w] && full[s + 1][w] {
                full[s][w] = true;
            }
        }
        Self { x, z, values, full, greatest }
    }

    /// The step that all half-breadths are multiples of, no less than the `written` one \[m\].
    fn step(&self, written: f64) -> f64 {
        let rounded =
            |step: f64| self.values.iter().flatten().flatten().all(|y| (y / step - (y / step).round()).abs() <= 1e-6);
        MULTIPLES.into_iter().map(|times| times * written).find(|&step| step > 0.0 && rounded(step)).unwrap_or(written)
    }

    /// Takes out the runs of a line of the grid that a round crest explains: `cells` along it with their places.
    fn without_crests(&mut self, cells: &[(usize, usize)], places: &[f64], step: f64) {
        let full: Vec<bool> = cells.iter().map(|&(s, w)| self.full[s][w]).collect();
        let mut from = 0;
        while from < full.len() {
            if !full[from] {
                from += 1;
                continue;
            }
            let to = (from..full.len()).take_while(|&k| full[k]).last().unwrap_or(from);
            let beside = |k: Option<usize>| {
                let k = k.filter(|&k| k < cells.len())?;
                let (s, w) = cells[k];
                Some((places[k], self.greatest - self.values[s][w]?))
            };
            let sides = [beside(from.checked_sub(1)), beside(Some(to + 1))];
            let middle = match sides {
                [Some(_), None] => places[to],
                [None, Some(_)] => places[from],
                _ => 0.5 * (places[from] + places[to]),
            };
            let half = (middle - places[from]).abs().max((places[to] - middle).abs());
            let falls = |(place, less): (f64, f64)| less * (half / (place - middle)).powi(2);
            let mut there = sides.into_iter().flatten().peekable();
            if there.peek().is_some() && !there.any(|side| falls(side) > CREST * step) {
                cells[from..=to].iter().for_each(|&(s, w)| self.full[s][w] = false);
            }
            from = to + 1;
        }
    }
}

/// The rule that keeps the flat of side of a table where it is; none where the table shows none.
pub(super) fn shown_flat(table: &OffsetTable, left_out: &[(usize, usize)]) -> Option<Rule> {
    let mut grid = Grid::new(table, left_out);
    let step = grid.step(table.form.quantum().unwrap_or(0.0));
    let rising = |places: &[f64]| places.windows(2).all(|pair| pair[0] < pair[1]);
    if grid.greatest <= 0.0 || !rising(&grid.x) || !rising(&grid.z) {
        return None;
    }
    let (x, z) = (grid.x.clone(), grid.z.clone());
    for w in 0..z.len() {
        let cells: Vec<(usize, usize)> = (0..x.len()).map(|s| (s, w)).collect();
        grid.without_crests(&cells, &x, step);
    }
    for s in 0..x.len() {
        let cells: Vec<(usize, usize)> = (0..z.len()).map(|w| (s, w)).collect();
        grid.without_crests(&cells, &z, step);
    }
    let mut rectangles = Vec::new();
    for s in 1..x.len() {
        for w in 1..z.len() {
            if [(s - 1, w - 1), (s - 1, w), (s, w - 1), (s, w)].iter().all(|&(s, w)| grid.full[s][w]) {
                rectangles.push([[x[s - 1], x[s]], [z[w - 1], z[w]]]);
            }
        }
    }
    let offsets = grid.full.iter().flatten().filter(|full| **full).count();
    (!rectangles.is_empty()).then_some(Rule::FlatShown { half_breadth: grid.greatest, offsets, rectangles })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hull::{Cell, StationOffsets, TableForm};

    /// Stations and waterlines 10 m and 1 m apart, half-breadths in millimetres, in steps of one.
    fn table(rows: &[&[i32]]) -> OffsetTable {
        let station = |(k, row): (usize, &&[i32])| StationOffsets {
            half_breadths: row.iter().map(|y| Cell::from(Some(1e-3 * f64::from(*y)))).collect(),
            ..StationOffsets::new(k.to_string(), 10.0 * k as f64)
        };
        OffsetTable {
            waterlines: (0..rows[0].len()).map(|k| k as f64).collect(),
            stations: rows.iter().enumerate().map(station).collect(),
            form: TableForm { decimals: Some(3), ..TableForm::default() },
            ..OffsetTable::default()
        }
    }

    fn of(rows: &[&[i32]], left_out: &[(usize, usize)]) -> Option<(usize, Vec<[[f64; 2]; 2]>)> {
        match shown_flat(&table(rows), left_out)? {
            Rule::FlatShown { half_breadth, offsets, rectangles } => {
                assert!((half_breadth - 10.0).abs() < 1e-12, "{half_breadth}");
                Some((offsets, rectangles))
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_flat_is_told_from_a_round_crest() {
        // Ends 300 mm less: flat from station 1 to 3 on the two upper waterlines.
        let flat: [&[i32]; 5] =
            [&[0, 9001, 9703], &[0, 10000, 10000], &[0, 10000, 10000], &[0, 10000, 10000], &[0, 9001, 9703]];
        let (offsets, rectangles) = of(&flat, &[]).unwrap();
        assert_eq!((offsets, rectangles.len()), (6, 2));
        assert_eq!(rectangles[0], [[10.0, 20.0], [1.0, 2.0]]);
        // Ends 1 mm less are a crest within the rounding.
        let crest: [&[i32]; 5] =
            [&[0, 9999, 9999], &[0, 10000, 10000], &[0, 10000, 10000], &[0, 10000, 10000], &[0, 9999, 9999]];
        assert_eq!(of(&crest, &[]), None);
        // Ends 50 mm less are a crest where the table is rounded to 50 mm, whatever its decimals.
        let coarse: [&[i32]; 5] =
            [&[0, 9950, 9950], &[0, 10000, 10000], &[0, 10000, 10000], &[0, 10000, 10000], &[0, 9950, 9950]];
        assert_eq!(of(&coarse, &[]), None);
        let finer: [&[i32]; 5] =
            [&[1, 9950, 9950], &[3, 10000, 10000], &[0, 10000, 10000], &[0, 10000, 10000], &[0, 9950, 9950]];
        assert_eq!(of(&finer, &[]).unwrap().0, 6);
        // So is a single station, however much the next are less.
        let bow: [&[i32]; 3] = [&[0, 9001, 9001], &[0, 10000, 10000], &[0, 9001, 9001]];
        assert_eq!(of(&bow, &[]), None);
    }

    #[test]
    fn an_offset_that_is_left_out_makes_no_hole() {
        let rows: [&[i32]; 5] =
            [&[0, 9001, 9703], &[0, 10000, 10000], &[0, 10000, 9010], &[0, 10000, 10000], &[0, 9001, 9703]];
        assert_eq!(of(&rows, &[]), None);
        assert_eq!(of(&rows, &[(2, 2)]).unwrap().0, 6);
    }
}
