//! Parametric stations and waterlines (Silalahi 1999): each waterline is splined with its ends and cut into equal parts
//! of its parameter, then the columns likewise, and a surface is put through the matrix of points, which includes the
//! ends.
//!
//! The parameters of the columns are averaged over all of them, so that waterlines stay level. Where a table does not
//! give an end, the waterline ends at its first or last offset. The surface does not pass through the cells but through
//! points of the waterlines between them; it misses the cells by the error of those splines.

use super::super::FitError;
use super::super::method::{ParametricStations, Problems};
use super::matrix::Matrix;
use crate::hull::cell::Entry;
use crate::hull::offsets::OffsetTable;
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector, Parametrization, SplineError};
use crate::units::counted;

/// Most parts in one direction; finer than this, a surface is no smaller in error.
const MOST_PARTS: usize = 1000;

/// Points (x, y) of a waterline from the stern to the stem.
fn waterline(table: &OffsetTable, matrix: &Matrix, j: usize) -> (Vec<[f64; 2]>, usize) {
    let extent = matrix.xs[matrix.xs.len() - 1] - matrix.xs[0];
    let near = 1e-9 * extent;
    let [stern, stem] = table.endings.get(j).copied().unwrap_or([None; 2]);
    let columns = matrix.zs.len();
    let said = |i: usize| {
        let cell = table.stations[i].half_breadths.get(j).map(|c| c.entry);
        matches!(cell, Some(Entry::Given(_) | Entry::Unknown))
    };
    let inside = |x: f64| stern.is_none_or(|s| x > s - near) && stem.is_none_or(|s| x < s + near);
    let mut points: Vec<[f64; 2]> = (0..matrix.xs.len())
        .filter(|&i| said(i) && inside(matrix.xs[i]))
        .map(|i| [matrix.xs[i], matrix.ys[i * columns + j]])
        .collect();
    // A waterline touches the centreplane at an end unless a station stands there.
    let first = points.first().map_or(f64::INFINITY, |p| p[0]);
    let last = points.last().map_or(f64::NEG_INFINITY, |p| p[0]);
    if let Some(x) = stern.filter(|&x| first - x > near) {
        points.insert(0, [x, 0.0]);
    }
    if let Some(x) = stem.filter(|&x| x - last > near) {
        points.push([x, 0.0]);
    }
    (points, usize::from(stern.is_none()) + usize::from(stem.is_none()))
}

/// A spline through points, of the degree or less when they are few.
fn through<const D: usize>(
    degree: usize,
    rule: Parametrization,
    points: &[[f64; D]],
) -> Result<BsplineCurve<D>, SplineError> {
    let sites = rule.parameters(points)?;
    let knots = KnotVector::between_sites(degree.min(sites.len() - 1), &sites)?;
    BsplineCurve::interpolate(knots, &sites, points)
}

fn part(k: usize, parts: usize) -> f64 {
    k as f64 / parts as f64
}

/// How far a control point may be moved to keep x rising, over the length of its waterline.
const MOST_MOVED: f64 = 0.01;

/// Makes x of one column of a net rise from its first to its last point, both kept. At a round end, where the waterline
/// stands across, interpolation lets the point next to the end fall back by its own error. Gives the largest movement
/// \[m\]; a net that falls further than [`MOST_MOVED`] stays as it is, to be refused.
fn rising(net: &mut [[f64; 3]], column: usize, columns: usize) -> f64 {
    let mut xs: Vec<f64> = net.iter().skip(column).step_by(columns).map(|p| p[0]).collect();
    let (first, last) = (xs[0], xs[xs.len() - 1]);
    if first > last {
        return 0.0;
    }
    let (mut moved, mut before) = (0.0f64, first);
    for x in &mut xs {
        let to = x.clamp(before, last);
        moved = moved.max((to - *x).abs());
        (*x, before) = (to, to);
    }
    if moved > MOST_MOVED * (last - first) {
        return 0.0;
    }
    net.iter_mut().skip(column).step_by(columns).zip(xs).for_each(|(point, x)| point[0] = x);
    moved
}

/// The surface of the method.
pub(super) fn surface(
    table: &OffsetTable,
    matrix: &mut Matrix,
    settings: &ParametricStations,
) -> Result<BsplineSurface<3>, FitError> {
    let (stations, lines) = (matrix.xs.len(), matrix.zs.len());
    let along = settings.parts_along.unwrap_or(stations + 1);
    let up = settings.parts_up.unwrap_or(lines - 1);
    let mut problems = Problems::default();
    let degree = problems.degree("order", settings.order);
    for (key, parts) in [("parts_along", along), ("parts_up", up)] {
        if !(1..=MOST_PARTS).contains(&parts) {
            problems.add(key, format!("{parts} parts"), format!("Expected 1 to {MOST_PARTS}."));
        }
    }
    problems.done()?;
    let rule = settings.parametrization;
    let mut open = 0;
    let mut few = Problems::default();
    // Parametric stations: points of each waterline, stations slowest.
    let mut columns = vec![[0.0; 3]; (along + 1) * lines];
    for j in 0..lines {
        let (points, without_end) = waterline(table, matrix, j);
        open += without_end;
        if points.len() < 2 {
            let message =
                format!("the waterline at {} m has {}, its ends counted", matrix.zs[j], counted(points.len(), "point"));
            few.add("kind", message, "Each waterline needs two: give its ends, or leave it out.");
            continue;
        }
        let line = through(degree, rule, &points)?;
        for i in 0..=along {
            let [x, y] = line.eval(part(i, along));
            columns[i * lines + j] = [x, y, matrix.zs[j]];
        }
    }
    few.done()?;
    if open > 0 {
        matrix
            .notes
            .push(format!("{open} ends of waterlines are not given: those waterlines end at their last offset"));
    }
    // Parametric waterlines: the columns have their parameters in common, and so waterlines stay level.
    let turned: Vec<[f64; 3]> =
        (0..lines).flat_map(|j| (0..=along).map(move |i| i * lines + j)).map(|k| columns[k]).collect();
    let sites = rule.averaged_parameters(&turned, along + 1)?;
    let knots = KnotVector::between_sites(degree.min(lines - 1), &sites)?;
    let mut grid = Vec::with_capacity((along + 1) * (up + 1));
    for column in columns.chunks_exact(lines) {
        let column = BsplineCurve::interpolate(knots.clone(), &sites, column)?;
        grid.extend((0..=up).map(|k| column.eval(part(k, up))));
    }
    let through = BsplineSurface::through_grid([degree; 2], rule, up + 1, &grid)?;
    let mut net = through.points().to_vec();
    let moved = (0..=up).map(|column| rising(&mut net, column, up + 1)).fold(0.0, f64::max);
    if moved > 0.0 {
        matrix.notes.push(format!(
            "round ends: control points that fell back behind the one before them were moved to it, by {moved:.4} m at most"
        ));
    }
    // Heights belong to v alone; equal data give control heights that are equal but for rounding.
    for k in up + 1..net.len() {
        net[k][2] = net[k - up - 1][2];
    }
    Ok(BsplineSurface::new(through.u().clone(), through.v().clone(), net)?)
}
