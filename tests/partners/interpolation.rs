//! C2 cubic interpolation along the lines of a table.

use loftsman::internals::spline::{Collocation, KnotVector};

use super::Table;
use super::lines::{Direction, Line, PLACES};

/// The cubic spline through the run of a line, without knots at its second and its last but one cell, at the places of
/// the line: over x on waterlines, over the root of the height above the lowest waterline on stations.
pub(super) fn along(table: &Table, line: &Line) -> Vec<f64> {
    let [along, _] = line.direction.of(table);
    let parameter = |t: f64| match line.direction {
        Direction::Waterline => t,
        Direction::Station => (t - table.z[0]).max(0.0).sqrt(),
    };
    let run = line.run[0]..=line.run[1];
    let sites: Vec<f64> = run.clone().map(|k| parameter(along[k])).collect();
    let mut net: Vec<f64> = run
        .map(|k| match line.direction {
            Direction::Waterline => table.y[k][line.index],
            Direction::Station => table.y[line.index][k],
        })
        .collect();
    let last = sites.len() - 1;
    let breaks: Vec<f64> = [&sites[..1], &sites[2..last - 1], &sites[last..]].concat();
    let knots = KnotVector::from_breakpoints(3, &breaks, &vec![1; breaks.len() - 2]).unwrap();
    Collocation::new(&knots, &sites).unwrap().solve(&mut net);
    let value = |t: f64| {
        let span = knots.find_span(t);
        knots.basis(span, t)[..4].iter().zip(&net[span - 3..]).map(|(n, c)| n * c).sum()
    };
    (0..PLACES).map(|k| value(parameter(line.place(k)))).collect()
}
