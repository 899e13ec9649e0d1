//! Regions of one sign of Gaussian curvature.
//!
//! The fewer there are, the fairer the surface: between them it turns from synclastic, K > 0, to anticlastic, K < 0. The
//! side of the hull is taken on a grid ([`SurfaceMap`]). Points without a tangent plane and those with a half-breadth
//! below B/1000 belong to no region. Neighbours along rows and columns with the same sign of K = k1 k2 are one region.
//! A region has the height
//!
//! ```text
//! h = 1/pi^2 int |k| dA \[m\],      k = K / max(|k1|, |k2|),
//! ```
//!
//! the weaker principal curvature k \[1/m\], whose sign that of K turns on, over its area \[m^2\]: as a swing of curvature
//! has |dk| l^2 / pi^2. While the least region has a height below the band \[m\], it goes to the regions about it, which
//! become one, with its height less.

use std::collections::BTreeSet;
use std::f64::consts::PI;

use super::NO_BREADTH;
use super::map::{SurfaceMap, distance};
use crate::hull::Hull;

/// Columns and rows of the grid.
const GRID: [usize; 2] = [200, 60];

/// A region of the grid, or several that became one.
struct Region {
    height: f64,
    beside: BTreeSet<usize>,
}

/// The number of regions of one sign of Gaussian curvature on one side of a hull below the deck at side; `band` is the
/// height from which one counts \[m\]. A surface that is developable within the band has none.
#[must_use]
pub fn gaussian_regions(hull: &Hull, band: f64) -> usize {
    let map = SurfaceMap::new(hull, GRID[0], GRID[1]);
    let least = NO_BREADTH * hull.particulars().breadth;
    let point = |k: usize| {
        let [gaussian, mean] = map.points[k].curvature.filter(|_| map.points[k].at[1] >= least)?;
        let strong = mean.abs() + (mean * mean - gaussian).max(0.0).sqrt();
        let weak = if strong > 0.0 { gaussian / strong } else { 0.0 };
        Some((gaussian >= 0.0, weak.abs() * area(&map, k) / (PI * PI)))
    };
    let points: Vec<Option<(bool, f64)>> = (0..map.points.len()).map(point).collect();
    counted(regions(&points, map.rows), band)
}

/// The area that a point of a map stands for \[m^2\].
fn area(map: &SurfaceMap, k: usize) -> f64 {
    let (column, row) = (k / map.rows, k % map.rows);
    let half = |a: (usize, usize), b: (usize, usize)| 0.5 * distance(map.point(a.0, a.1).at, map.point(b.0, b.1).at);
    let along = half((column.saturating_sub(1), row), ((column + 1).min(map.columns() - 1), row));
    along * half((column, row.saturating_sub(1)), (column, (row + 1).min(map.rows - 1)))
}

/// Connected points of one sign, with their heights together; columns have `rows` points each.
fn regions(points: &[Option<(bool, f64)>], rows: usize) -> Vec<Region> {
    let mut of: Vec<Option<usize>> = vec![None; points.len()];
    let mut list: Vec<Region> = Vec::new();
    let beside = |k: usize| {
        let row = k % rows;
        [
            (row > 0).then(|| k - 1),
            (row + 1 < rows).then_some(k + 1),
            k.checked_sub(rows),
            Some(k + rows).filter(|&next| next < points.len()),
        ]
    };
    for start in 0..points.len() {
        let Some((sign, _)) = points[start].filter(|_| of[start].is_none()) else { continue };
        let (own, mut height, mut open) = (list.len(), 0.0, vec![start]);
        of[start] = Some(own);
        while let Some(k) = open.pop() {
            height += points[k].map_or(0.0, |(_, height)| height);
            for next in beside(k).into_iter().flatten() {
                if of[next].is_none() && points[next].is_some_and(|(other, _)| other == sign) {
                    of[next] = Some(own);
                    open.push(next);
                }
            }
        }
        list.push(Region { height, beside: BTreeSet::new() });
    }
    for k in 0..points.len() {
        for next in beside(k).into_iter().flatten() {
            if let (Some(own), Some(other)) = (of[k], of[next])
                && own != other
            {
                list[own].beside.insert(other);
            }
        }
    }
    list
}

/// How many regions are left when those below the band have gone to their neighbours, the least first.
fn counted(mut list: Vec<Region>, band: f64) -> usize {
    let mut left: BTreeSet<usize> = (0..list.len()).collect();
    while let Some(&least) = left.iter().min_by(|&&a, &&b| list[a].height.total_cmp(&list[b].height)) {
        if list[least].height >= band {
            break;
        }
        let gone = std::mem::take(&mut list[least].beside);
        left.remove(&least);
        let Some(&into) = gone.iter().max_by(|&&a, &&b| list[a].height.total_cmp(&list[b].height)) else { continue };
        let mut beside = BTreeSet::new();
        let mut height = -list[least].height;
        for &other in &gone {
            height += list[other].height;
            beside.append(&mut list[other].beside);
            left.remove(&other);
        }
        beside.retain(|next| *next != least && !gone.contains(next));
        for &next in &beside {
            list[next].beside.retain(|other| !gone.contains(other));
            list[next].beside.insert(into);
        }
        list[into] = Region { height: height.max(0.0), beside };
        left.insert(into);
    }
    left.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points of a picture: rows of text are rows of the grid, `+` and `-` have the height 1 each, blanks none.
    fn picture(lines: &[&str]) -> Vec<Region> {
        let column = |c: usize| lines.iter().map(move |line| line.as_bytes()[c]);
        let point = |sign: u8| (sign != b' ').then_some((sign == b'+', 1.0));
        let points: Vec<_> = (0..lines[0].len()).flat_map(column).map(point).collect();
        regions(&points, lines.len())
    }

    #[test]
    fn regions_below_the_band_go_to_those_about_them() {
        let drawn = ["++++--++", "+-++--++", "++++--++"];
        for (band, count) in [(0.5, 4), (1.5, 3), (6.5, 1), (20.0, 0)] {
            assert_eq!(counted(picture(&drawn), band), count, "{band}");
        }
    }

    /// What has no curvature parts regions, and corners do not join them.
    #[test]
    fn blanks_part_regions_and_corners_do_not_join_them() {
        assert_eq!(counted(picture(&["++ ++", "++ ++"]), 0.5), 2);
        assert_eq!(counted(picture(&["+-", "-+"]), 0.5), 4);
    }
}
