//! The noise of a table that is taken on the net of a fit, and its errors by differences in which the hull's own form is
//! least.
//!
//! A divided difference of order p along the waterlines and q along the stations takes out every form of lower degree:
//! of readings with errors of standard deviation sigma, its weights scaled to a sum of squares of 1, it leaves sigma and
//! what the hull's form has beyond that degree. The |difference| of normal errors alone has its quantile of
//! `QUANTILE` at `NORMAL` sigma; a low quantile, because form stands in few places (Rice 1984, for pseudo-residuals
//! of first differences; Hall, Kay & Titterington 1990 for those of higher order). Of all orders to `ORDER` the mean of
//! the `ORDERS_AVERAGED` least is taken.

use crate::hull::OffsetTable;

/// Greatest order of a difference along waterlines and along stations.
const ORDER: usize = 5;

/// Least order along both together.
const LEAST_TOTAL_ORDER: usize = 2;

/// Part of the differences that are no larger than what is taken of them.
const QUANTILE: f64 = 0.35;

/// The same quantile of |x| for a standard normal x.
const NORMAL: f64 = 0.453_762_190_169_879_5;

/// Fewest differences of one order.
const FEWEST_DIFFERENCES: usize = 40;

/// Orders whose mean is taken.
const ORDERS_AVERAGED: usize = 4;

/// Noise of a table, over the greatest that is assumed for roughness, from which it is taken as it is: the tolerance
/// itself.
const ROUGH: f64 = 3.0;

/// Part of what the differences of a table leave that is taken for errors where the weight is chosen; the rest is the
/// form of a hull with features: tables of a Series 60 and an S-175 that were made fair leave 4 and 7 mm without
/// errors, 4.4 and 7.5 mm with 2 mm, 11 and 14 mm with 10 mm.
const ERROR_SHARE: f64 = 0.7;

/// Least part of the noise that is taken for errors: that of all tables whose noise is within a designer's tolerance and
/// for the most part form. Without it the coaster keeps 89 of 124 inflections, with it 77 of 99; with all of the noise
/// moves of the shared tables are 1.1 to 1.8 times as large, and inflections 4 more to 8 fewer.
const LEAST_ERROR_SHARE: f64 = 0.6;

/// What differences leave over the noise from which all of it is errors: of errors alone they leave 0.83 in the median.
const ALL_ERRORS: f64 = 0.8;

/// What differences leave of a table, and its noise, whatever tolerances are named.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Differences {
    /// What is left \[m\].
    pub left: f64,
    /// The noise of the table \[m\].
    pub noise: f64,
}

/// The noise of a table that is taken on the net of a fit \[m\], where no less than `least` is assumed and no more than
/// `most` for the roughness of a drawing.
pub(super) fn taken(noise: f64, [least, most]: [f64; 2]) -> f64 {
    let (noise, most) = (noise.max(least), most.max(least));
    if noise > ROUGH * most { noise } else { noise.min(most) }.max(1e-12)
}

/// What is taken for errors of a noise of `sigma` on the net of a fit \[m\]: all of it where a designer's tolerance
/// has no room for so much, or differences leave next to as much.
pub(super) fn errors(differences: Option<Differences>, [least, most]: [f64; 2], sigma: f64) -> f64 {
    match differences {
        Some(Differences { left, noise }) if noise <= ROUGH * most.max(least) && left < ALL_ERRORS * noise => {
            (ERROR_SHARE * left).max(least).clamp(LEAST_ERROR_SHARE * sigma, sigma)
        }
        _ => sigma,
    }
}

/// What differences leave of a table's offsets \[m\], without the cells `left_out` (station, waterline) and those on the
/// centreplane: the standard deviation of their errors, and form that no low order takes out. None where there are too few
/// offsets side by side. Of the errors of 99 tables of a hull in closed form, 21 x 11 offsets, 0.83 are found in the
/// median, 0.56 to 1.10 in all.
#[must_use]
pub(super) fn left_by_differences(table: &OffsetTable, left_out: &[(usize, usize)]) -> Option<f64> {
    let (stations, waterlines) = (table.stations.len(), table.waterlines.len());
    let value = |i: usize, j: usize| {
        let cell = table.stations[i].half_breadths.get(j)?;
        cell.value().filter(|&y| y > 0.0 && !left_out.contains(&(i, j)))
    };
    let cells: Vec<Vec<Option<f64>>> = (0..stations).map(|i| (0..waterlines).map(|j| value(i, j)).collect()).collect();
    let positions: Vec<f64> = table.stations.iter().map(|station| station.station.x).collect();
    let mut found = Vec::new();
    for along in 0..=ORDER {
        for up in 0..=ORDER {
            if along + up < LEAST_TOTAL_ORDER || stations <= along || waterlines <= up {
                continue;
            }
            let across: Vec<Vec<f64>> = table.waterlines.windows(up + 1).map(weights).collect();
            let mut sizes = Vec::new();
            for (i, xs) in positions.windows(along + 1).enumerate() {
                let over = weights(xs);
                sizes.extend(across.iter().enumerate().filter_map(|(j, across)| {
                    let block = cells[i..=i + along].iter().map(|row| &row[j..=j + up]);
                    difference(block, &over, across)
                }));
            }
            if sizes.len() >= FEWEST_DIFFERENCES {
                let place = (QUANTILE * (sizes.len() - 1) as f64).round() as usize;
                let (_, size, _) = sizes.select_nth_unstable_by(place, f64::total_cmp);
                found.push(*size / NORMAL);
            }
        }
    }
    found.sort_by(f64::total_cmp);
    found.truncate(ORDERS_AVERAGED);
    (!found.is_empty()).then(|| found.iter().sum::<f64>() / found.len() as f64)
}

/// Weights of the divided difference over `points`, of a sum of squares of 1.
fn weights(points: &[f64]) -> Vec<f64> {
    let weight = |i: usize| {
        let others = points.iter().enumerate().filter(|(j, _)| *j != i);
        1.0 / others.map(|(_, other)| points[i] - other).product::<f64>()
    };
    let all: Vec<f64> = (0..points.len()).map(weight).collect();
    let size = all.iter().map(|weight| weight * weight).sum::<f64>().sqrt();
    all.iter().map(|weight| weight / size).collect()
}

/// |sum of weights times offsets|; none where one is missing, all are the same, as on a flat of side, or two stand
/// in one place.
fn difference<'a>(block: impl Iterator<Item = &'a [Option<f64>]>, over: &[f64], across: &[f64]) -> Option<f64> {
    let (mut sum, mut low, mut high) = (0.0, f64::INFINITY, f64::NEG_INFINITY);
    for (row, a) in block.zip(over) {
        for (cell, b) in row.iter().zip(across) {
            let y = (*cell)?;
            sum += a * b * y;
            (low, high) = (low.min(y), high.max(y));
        }
    }
    (high > low && sum.is_finite()).then_some(sum.abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hull::{Cell, StationOffsets};

    /// Wigley's hull of 100 x 10 x 6.25 m at 21 stations, not evenly spaced, and 11 waterlines, with errors that are the
    /// sum of twelve evenly distributed numbers, of a standard deviation \[m\].
    fn wigley(deviation: f64, seed: u64) -> OffsetTable {
        let mut state = seed;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut error = || deviation * ((0..12).map(|_| uniform()).sum::<f64>() - 6.0);
        let mut table =
            OffsetTable { waterlines: (0..11).map(|j| 0.625 * f64::from(j)).collect(), ..OffsetTable::default() };
        for i in 0..21 {
            let x = 5.0 * f64::from(i) + if i % 4 == 1 { 1.5 } else { 0.0 };
            let (s, mut station) = (x / 50.0 - 1.0, StationOffsets::new(i.to_string(), x));
            let half = |z: f64| 5.0 * (1.0 - s * s) * (1.0 - (1.0 - z / 6.25).powi(2));
            station.half_breadths = table
                .waterlines
                .iter()
                .map(|&z| Cell::from(Some(half(z)).map(|y| y + if y > 0.0 { error() } else { 0.0 })))
                .collect();
            table.stations.push(station);
        }
        table
    }

    #[test]
    fn errors_are_found_in_the_median_and_form_of_low_degree_is_none() {
        let mut found: Vec<f64> =
            (0..99).map(|seed| left_by_differences(&wigley(0.002, seed), &[]).unwrap() / 0.002).collect();
        found.sort_by(f64::total_cmp);
        assert!(found[0] > 0.55 && found[98] < 1.11 && (found[49] - 0.83).abs() < 0.05, "{found:?}");
        assert!(left_by_differences(&wigley(0.0, 1), &[]).unwrap() < 1e-9);
    }

    #[test]
    fn errors_are_what_differences_leave_between_six_tenths_of_the_noise_and_all_of_it() {
        let of = |left: f64, noise: f64, sigma: f64| errors(Some(Differences { left, noise }), [0.0003, 0.005], sigma);
        // Mostly form; next to no form; more than a designer's tolerance; capped, in between.
        for (given, expected) in [
            ([0.002, 0.004, 0.004], 0.0024),
            ([0.0033, 0.004, 0.004], 0.004),
            ([0.004, 0.016, 0.016], 0.016),
            ([0.0055, 0.008, 0.005], 0.00385),
            ([0.009, 0.012, 0.005], 0.005),
        ] {
            let found = of(given[0], given[1], given[2]);
            assert!((found - expected).abs() < 1e-12, "{given:?}: {found} for {expected}");
        }
        // A narrower tolerance never smooths more.
        let named: Vec<f64> = (1..=40).map(|k| of(0.002, 0.004, 1e-4 * f64::from(k))).collect();
        assert!(named.windows(2).all(|pair| pair[1] >= pair[0]), "{named:?}");
        assert!((errors(None, [0.0003, 0.005], 0.004) - 0.004).abs() < 1e-15);
    }

    #[test]
    fn cells_that_are_left_out_tell_nothing_and_few_cells_tell_nothing_either() {
        let mut table = wigley(0.002, 3);
        let without = left_by_differences(&table, &[(10, 5)]);
        table.stations[10].half_breadths[5] = Cell::from(Some(0.5));
        assert_eq!(left_by_differences(&table, &[(10, 5)]), without);
        table.stations.truncate(4);
        assert_eq!(left_by_differences(&table, &[]), None);
    }
}
