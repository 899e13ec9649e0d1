//! The plane of the transom: the breadth of a waterline on it, and what becomes of it.

use super::rows::Row;
use crate::hull::offsets::OffsetTable;

/// What the waterlines make of the plane, in words.
pub(super) fn notes(table: &OffsetTable, rows: &[Row]) -> Vec<String> {
    let Some(plane) = table.transom else { return Vec::new() };
    let mut notes = Vec::new();
    let beyond = |x: f64, z: f64| x < plane.x_base + plane.slope * z - 1e-9 * (1.0 + x.abs());
    let aft = table.stations.iter().filter(|s| {
        let mut cells = s.half_breadths.iter().zip(&table.waterlines);
        cells.any(|(c, &z)| c.value().is_some_and(|y| y > 0.0) && beyond(s.station.x, z))
    });
    let names: Vec<&str> = aft.map(|s| s.station.name.as_str()).collect();
    if !names.is_empty() {
        notes.push(format!(
            "stations {} have offsets aft of the plane of the transom: the waterlines of these offsets are not cut by it",
            names.join(", ")
        ));
    }
    match rows.iter().rposition(|r| !r.transom) {
        Some(last) if last + 1 == rows.len() => {
            notes.push("the plane of the transom is not used: the highest waterline closes before it".to_owned());
        }
        Some(below) => notes.push(format!(
            "the foot of the transom lies between the waterlines at z = {:.3} and {:.3} m: the hull is closed straight across there",
            rows[below].z,
            rows[below + 1].z
        )),
        None => {}
    }
    notes
}

/// The half-breadth at `x` of the parabola through the first three of `cells` (x, y), the aftmost first; of the line
/// through two, or one alone. None where it is not positive, or the first cell has no breadth.
///
/// Third order in the spaces between stations. A parabola does not carry more than twice the change over the first space.
pub(super) fn breadth(x: f64, cells: &[(f64, f64)]) -> Option<f64> {
    let &(x0, y0) = cells.first().filter(|c| c.1 > 0.0)?;
    let Some(&(x1, y1)) = cells.get(1) else { return Some(y0) };
    let chord = (y1 - y0) / (x1 - x0);
    let straight = (x - x0) * chord;
    let bend = cells.get(2).map_or(0.0, |&(x2, y2)| ((y2 - y1) / (x2 - x1) - chord) / (x2 - x0) * (x - x0) * (x - x1));
    let most = 2.0 * (y1 - y0).abs();
    Some(y0 + (straight + bend).clamp(-most, most)).filter(|y| *y > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parabolas_are_carried_on() {
        let y = |x: f64| 3.0 + 0.5 * x - 0.05 * x * x;
        let cells = [0.0, 2.0, 5.0].map(|x| (x, y(x)));
        assert!((breadth(-0.7, &cells).unwrap() - y(-0.7)).abs() < 1e-14);
        assert!((breadth(-1.0, &cells[..2]).unwrap() - 2.6).abs() < 1e-14);
        assert_eq!(breadth(-1.0, &cells[..1]), Some(3.0));
        // On the plane itself the cell is the breadth.
        assert_eq!(breadth(0.0, &cells), Some(3.0));
        // A waterline that closes before the plane does not reach it.
        assert_eq!(breadth(-2.0, &[(0.0, 1.0), (1.0, 2.0)]), None);
    }
}
