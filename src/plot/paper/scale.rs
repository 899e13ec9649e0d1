//! Scales: of drawings, of the curves of a diagram sheet, and of axes.

/// Scales of drawings, 1 : n, that a scale rule has: those of ISO 5455 and its 1:25 and 1:250.
pub const DRAWING_SCALES: [u32; 8] = [20, 25, 50, 100, 200, 250, 500, 1000];

/// Every scale that a drawing can have, from the largest: [`DRAWING_SCALES`] and its steps on both sides.
pub(in crate::plot) fn drawing_scales() -> impl Iterator<Item = u32> {
    let large = [2000, 2500, 5000, 10_000, 20_000, 25_000, 50_000, 100_000];
    [1, 2, 5, 10].into_iter().chain(DRAWING_SCALES).chain(large)
}

/// The largest scale of [`DRAWING_SCALES`] at which `extent` [m] fits into `room` [mm]; past 1:1000 the list goes on with
/// 2000, 2500, 5000, ..., and below 1:20 with 10, 5, 2, 1.
pub(in crate::plot) fn drawing_scale(extent: f64, room: f64) -> u32 {
    let needed = 1000.0 * extent / room;
    drawing_scales().find(|&scale| f64::from(scale) >= needed * (1.0 - 1e-9)).unwrap_or(1_000_000)
}

/// The largest scale of a rule at which `extent` \[m\] fits into `room` \[mm\]: the scales of drawings, and those of rules
/// with 1:75 and 1:125. For the lengths of contracted profiles, whose heights have another scale, and for plans that are
/// looked at and not built from, which fill their sheet better so.
pub(in crate::plot) fn rule_scale(extent: f64, room: f64) -> u32 {
    let between = [75, 125, 750, 1250, 7500, 12_500].into_iter();
    let fits = |scale: &u32| f64::from(*scale) >= 1000.0 * extent / room * (1.0 - 1e-9);
    between.filter(fits).chain([drawing_scale(extent, room)]).min().unwrap_or(1_000_000)
}

/// First member of `mantissas` times a power of ten that is not below `value`; `mantissas` rise from 1 to 10.
/// A member that `value` equals to nine digits is taken as it is.
fn round_up(value: f64, mantissas: &[f64]) -> f64 {
    if !(value.is_finite() && value > 0.0) {
        return 1.0;
    }
    let power = value.log10().floor();
    let unit = 10f64.powi(power as i32);
    let mantissa = mantissas.iter().copied().find(|m| m * unit >= value * (1.0 - 1e-9)).unwrap_or(10.0);
    // 10^-k as a quotient, so that 0.05 is the number that is written so.
    if power < 0.0 { mantissa / 10f64.powi(-(power as i32)) } else { mantissa * unit }
}

/// The scale of a curve of a diagram sheet, its unit a millimetre: the largest `value` stands at `target` millimetres or
/// less, and the scale is 1, 2, 2.5, 4 or 5 times a power of ten.
///
/// A scale of nothing (`value` not a positive number) is 1.
///
/// ```
/// use loftsman::internals::plot::sheet_scale;
/// assert_eq!(sheet_scale(463.4, 120.0).to_string(), "4"); // raw scale 3.86
/// assert_eq!(sheet_scale(12.8, 100.0).to_string(), "0.2"); // raw scale 0.128
/// ```
#[must_use]
pub fn sheet_scale(value: f64, target: f64) -> f64 {
    round_up(value / target, &[1.0, 2.0, 2.5, 4.0, 5.0, 10.0])
}

/// Step of 1, 2, 2.5 or 5 times a power of ten that divides `range` into at most `count` parts.
pub(in crate::plot) fn nice_step(range: f64, count: f64) -> f64 {
    round_up(range / count, &[1.0, 2.0, 2.5, 5.0, 10.0])
}

/// Decimals that write multiples of `step` in full.
pub(in crate::plot) fn decimals(step: f64) -> usize {
    (0..6)
        .find(|&d| {
            let scaled = step * 10f64.powi(d);
            (scaled - scaled.round()).abs() < 1e-6 * scaled.abs().max(1e-9)
        })
        .map_or(6, |d| d as usize)
}

/// More lines than this are no axis.
const MOST_MULTIPLES: f64 = 10_000.0;

/// Multiples of `step` from `low` to `high`, both included to a billionth of the step; none where there are more than
/// could be drawn, or the step is not a positive number.
pub(in crate::plot) fn multiples(step: f64, low: f64, high: f64) -> Vec<f64> {
    let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
    // From 2^53 on neighbouring numbers are no longer neighbouring multiples.
    let counts = step > 0.0 && last - first < MOST_MULTIPLES && first.abs().max(last.abs()) < 9e15;
    if counts { (first as i64..=last as i64).map(|k| k as f64 * step).collect() } else { Vec::new() }
}

/// A number to so many figures: plain between a thousandth and a million, else with its power of ten.
pub(in crate::plot) fn figures(value: f64, count: usize) -> String {
    let written = format!("{value:.*e}", count.saturating_sub(1));
    let power: i32 = written.split('e').nth(1).and_then(|power| power.parse().ok()).unwrap_or_default();
    if (-3..6).contains(&power) { format!("{value:.*}", (count as i32 - 1 - power).max(0) as usize) } else { written }
}

/// A volume to five figures at least, and to a tenth of a cubic metre.
pub(in crate::plot) fn volume_of(volume: f64) -> String {
    let power = volume.abs().max(1e-9).log10().floor() as i32;
    format!("{volume:.*}", (4 - power).clamp(1, 9) as usize)
}

/// A number to millimetres, as short as it can be written.
pub(in crate::plot) fn short(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_have_more_scales_than_drawings() {
        for (extent, expected) in [(36.8, 100), (36.9, 125), (380.0, 1250), (500.0, 2000), (5000.0, 20_000), (1.0, 5)] {
            assert_eq!(rule_scale(extent, 368.0), expected, "{extent}");
        }
    }

    #[test]
    fn a_scale_of_the_list_that_just_fits_is_taken() {
        assert_eq!(drawing_scale(40.0, 400.0), 100);
        assert_eq!(drawing_scale(40.1, 400.0), 200);
        assert_eq!(drawing_scale(90.0, 400.0), 250);
        assert_eq!(drawing_scale(250.0, 400.0), 1000);
        assert_eq!(drawing_scale(650.0, 400.0), 2000);
    }

    #[test]
    fn scales_of_a_sheet_are_rounded_up_to_what_a_rule_has() {
        let raw_and_scale: [(f64, f64); 9] = [
            (4.0, 4.0),
            (4.01, 5.0),
            (5.01, 10.0),
            (10.0, 10.0),
            (10.01, 20.0),
            (0.1, 0.1),
            (0.128, 0.2),
            (0.0434, 0.05),
            (2.2e-3, 2.5e-3),
        ];
        for (raw, scale) in raw_and_scale {
            let found = sheet_scale(raw * 100.0, 100.0);
            assert!((found - scale).abs() <= 1e-15 * scale, "{raw}: {found}");
        }
    }

    #[test]
    fn nothing_has_the_scale_one() {
        for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!((sheet_scale(value, 100.0) - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn steps_and_their_decimals() {
        for (range, count, step, places) in
            [(5.2, 6.0, 1.0, 0), (0.9, 4.0, 0.25, 2), (13.2, 4.0, 5.0, 0), (1.2, 5.0, 0.25, 2), (0.01, 5.0, 0.002, 3)]
        {
            let found = nice_step(range, count);
            assert!((found - step).abs() < 1e-12, "{range}: {found}");
            assert_eq!(decimals(found), places, "{range}");
        }
    }

    #[test]
    fn multiples_include_both_ends() {
        assert_eq!(multiples(0.1, 0.0, 0.3).len(), 4);
        assert_eq!(multiples(0.5, -0.6, 1.0).len(), 4);
    }

    #[test]
    fn what_cannot_be_counted_has_no_multiples() {
        for (step, low, high) in [
            (1.0, -1e300, 1e300),
            (1.0, 1e18, 1e18 + 512.0),
            (1e-9, 0.0, 1.0),
            (0.0, 0.0, 1.0),
            (f64::NAN, 0.0, 1.0),
            (1.0, f64::NAN, 1.0),
            (1.0, 0.0, f64::INFINITY),
        ] {
            assert!(multiples(step, low, high).is_empty(), "{step} {low} {high}");
        }
    }

    #[test]
    fn numbers_of_ordinary_size_have_no_powers() {
        for (value, count, text) in [
            (1.0, 1, "1"),
            (0.96, 1, "1"),
            (0.032, 2, "0.032"),
            (12_345.0, 2, "12345"),
            (3e-7, 1, "3e-7"),
            (2e9, 2, "2.0e9"),
        ] {
            assert_eq!(figures(value, count), text);
        }
    }
}
