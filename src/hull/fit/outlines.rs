//! Tables that give sections as points: half-breadths on waterlines that suit the points.
//!
//! Each section is the monotone piecewise cubic (Fritsch & Butland 1984) of y and of z over the chord length of its points: no
//! overshoot, second order at least. The waterlines are quantiles of the heights of all points, at least [`LEAST`] and never
//! closer than a hundredth of the height; where a section has several points at one height, its greatest half-breadth there
//! counts. What the surface leaves at the points is measured afterwards.

use super::super::{Cell, Hull, OffsetTable, OutlinePoint};
use super::monotone::monotone_cubic;

/// Fewest waterlines made of points.
const LEAST: usize = 12;

/// Most waterlines made of points.
const MOST: usize = 60;

/// Heights that count as one where flats are looked for, over the height of the table.
const CLOSEST: f64 = 1e-3;

/// Closest heights of waterlines made of points, over the height of the table.
const SPACING: f64 = 1e-2;

/// Waterlines over the median number of points of a section.
const DENSITY: f64 = 1.5;

/// Points along a section in which crossings are looked for, a chord.
const LOOKS: usize = 8;

fn usable(point: &&OutlinePoint) -> bool {
    point.y.is_finite() && point.z.is_finite()
}

/// Whether the table holds sections as points and no half-breadths.
pub(super) fn only_outlines(table: &OffsetTable) -> bool {
    let cells = table.stations.iter().flat_map(|s| &s.half_breadths).filter(|c| c.value().is_some()).count();
    cells == 0 && table.stations.iter().any(|s| s.outlines.iter().any(|o| o.len() > 1))
}

/// The greatest half-breadth of a branch at height `z`; none where the branch does not reach.
fn half_breadth(branch: &[OutlinePoint], z: f64, slack: f64) -> Option<f64> {
    let mut length = 0.0;
    // y and z over the length along the chords.
    let mut ys: Vec<(f64, f64)> = Vec::new();
    let mut zs: Vec<(f64, f64)> = Vec::new();
    let mut before: Option<&OutlinePoint> = None;
    for point in branch.iter().filter(usable) {
        if let Some(b) = before {
            let chord = (point.y - b.y).hypot(point.z - b.z);
            if chord <= 0.0 {
                continue;
            }
            length += chord;
        }
        ys.push((length, point.y));
        zs.push((length, point.z));
        before = Some(point);
    }
    let at_points = zs.iter().zip(&ys).filter(|(height, _)| (height.1 - z).abs() <= slack).map(|(_, y)| y.1);
    let mut greatest = at_points.fold(f64::NEG_INFINITY, f64::max);
    for pair in zs.windows(2) {
        if (pair[0].1.min(pair[1].1)..=pair[0].1.max(pair[1].1)).contains(&z) {
            let step = (pair[1].0 - pair[0].0) / LOOKS as f64;
            let height = |t: f64| monotone_cubic(&zs, t) - z;
            for k in 0..LOOKS {
                let (mut a, mut b) = (pair[0].0 + step * k as f64, pair[0].0 + step * (k + 1) as f64);
                let rising = height(b) > height(a);
                if height(a) * height(b) > 0.0 {
                    continue;
                }
                for _ in 0..60 {
                    let middle = 0.5 * (a + b);
                    if (height(middle) > 0.0) == rising { b = middle } else { a = middle }
                }
                greatest = greatest.max(monotone_cubic(&ys, 0.5 * (a + b)));
            }
        }
    }
    greatest.is_finite().then_some(greatest.max(0.0))
}

/// The table with half-breadths read off its sections, keel and deck heights and flats of bottom where it does not give them.
pub(super) fn with_waterlines(table: &OffsetTable) -> OffsetTable {
    let mut result = table.clone();
    let mut heights: Vec<f64> = Vec::new();
    let mut counts: Vec<usize> = Vec::new();
    for station in &table.stations {
        let points: Vec<f64> = station.outlines.iter().flatten().filter(usable).map(|p| p.z).collect();
        if !points.is_empty() {
            counts.push(points.len());
        }
        heights.extend(points);
    }
    heights.sort_by(f64::total_cmp);
    counts.sort_unstable();
    let (Some(&bottom), Some(&top), Some(&median)) = (heights.first(), heights.last(), counts.get(counts.len() / 2))
    else {
        return result;
    };
    let wanted = ((median as f64 * DENSITY) as usize).clamp(LEAST, MOST);
    let rise = top - bottom;
    let mut lines = vec![bottom];
    let draught = table.stated.draught.filter(|t| *t > bottom && *t < top);
    let quantiles = (1..wanted).map(|k| heights[k * (heights.len() - 1) / wanted]);
    // Even steps where the points are few, so that no gap is wider than two of them.
    let steps = (1..wanted).map(|k| bottom + rise * k as f64 / wanted as f64);
    let mut graded: Vec<f64> = quantiles.chain(draught).collect();
    graded.sort_by(f64::total_cmp);
    for z in graded {
        if z - lines[lines.len() - 1] > SPACING * rise && top - z > SPACING * rise {
            lines.push(z);
        }
    }
    lines.push(top);
    let step = rise / wanted as f64;
    let even: Vec<f64> = steps.filter(|z| lines.iter().all(|l| (l - z).abs() > step)).collect();
    lines.extend(even);
    lines.sort_by(f64::total_cmp);
    let slack = 1e-9 * rise;
    for station in &mut result.stations {
        let points = || station.outlines.iter().flatten().filter(usable);
        let low = points().map(|p| p.z).fold(f64::INFINITY, f64::min);
        let high = points().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
        if low.is_finite() {
            let flat = points().filter(|p| p.z <= low + CLOSEST * rise).map(|p| p.y).fold(0.0, f64::max);
            station.keel_height = station.keel_height.or(Some(low));
            station.deck_height = station.deck_height.or(Some(high));
            station.flat_of_bottom = station.flat_of_bottom.or(Some(flat));
        }
        station.half_breadths = lines
            .iter()
            .map(|&z| {
                let widths = station.outlines.iter().filter_map(|branch| half_breadth(branch, z, slack));
                Cell::from(widths.reduce(f64::max))
            })
            .collect();
    }
    result.endings = vec![[None; 2]; lines.len()];
    result.waterlines = lines;
    result
}

/// A point of a section beside the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointResidual {
    /// Index of the station in the table.
    pub station: usize,
    /// Height of the point \[m\].
    pub height: f64,
    /// Half-breadth of the point \[m\].
    pub given: f64,
    /// Half-breadth of the surface at its height \[m\].
    pub half_breadth: f64,
}

impl PointResidual {
    /// Surface minus table \[m\].
    #[must_use]
    pub fn residual(&self) -> f64 {
        self.half_breadth - self.given
    }
}

/// The outermost points of the sections above the bottom of the hull, and the number of all points. Points of the bottom and of
/// lines that close a section across are no part of the side, and points where the hull does not reach have no residual.
pub(super) fn point_residuals(table: &OffsetTable, hull: &Hull) -> (Vec<PointResidual>, usize) {
    let (mut list, mut all) = (Vec::new(), 0usize);
    let floor = hull.bottom() + CLOSEST * (hull.top() - hull.bottom());
    for (index, station) in table.stations.iter().enumerate() {
        for point in station.outlines.iter().flatten().filter(usable) {
            all += 1;
            if point.z <= floor {
                continue;
            }
            let widest =
                station.outlines.iter().filter_map(|branch| half_breadth(branch, point.z, 1e-9)).fold(0.0, f64::max);
            if point.y >= widest - 1e-6
                && let Some(y) = hull.half_breadth(station.station.x, point.z)
            {
                list.push(PointResidual { station: index, height: point.z, given: point.y, half_breadth: y });
            }
        }
    }
    (list, all)
}

/// What is and what is not compared with the points of the sections.
pub(super) fn note(table: &OffsetTable, hull: &Hull) -> String {
    let (list, all) = point_residuals(table, hull);
    format!(
        "sections given as points: {} of {all} points are outermost points of the side and compared with the surface; the others lie on \
         the bottom, inside, or beyond the hull",
        list.len()
    )
}
