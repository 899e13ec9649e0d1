//! Draughts of a table when none are asked for.

/// Draughts \[m\] from 0.2 T to the depth D at a round step (1, 2, 2.5 or 5 times a power of ten), the widest that
/// gives at least 20 rows; T and D always belong to the list, which never has more than 50 rows. Rising. Without a T
/// from 0.2 D to D.
///
/// Steps next to each other differ by a factor of at most 2, so that the widest step with 20 multiples in the range has
/// fewer than 2 x 20 + 2 of them. Nothing when a dimension is not a positive number; D below T counts as T.
#[must_use]
pub fn default_draughts(draught: Option<f64>, depth: f64) -> Vec<f64> {
    let draught = draught.unwrap_or(depth);
    if !(draught.is_finite() && depth.is_finite() && draught > 0.0) {
        return Vec::new();
    }
    let (from, to) = (0.2 * draught, depth.max(draught));
    let decade = (to - from).log10().floor() as i32;
    let steps =
        (decade - 3..=decade).rev().flat_map(|exponent| [5.0, 2.5, 2.0, 1.0].map(|mantissa| (mantissa, exponent)));
    let multiples = |(mantissa, exponent): (f64, i32)| -> Vec<f64> {
        // Multiples are k m 10^e, with the division by a power of ten last: it is then the decimal number that is meant.
        let at = |k: f64| {
            if exponent < 0 { k * mantissa / 10f64.powi(-exponent) } else { k * mantissa * 10f64.powi(exponent) }
        };
        let unit = at(1.0);
        let (first, last) = ((from / unit - 1e-9).ceil(), (to / unit + 1e-9).floor());
        let count = (last - first + 1.0).clamp(0.0, 1000.0) as usize;
        (0..count).map(|k| at(first + k as f64)).collect()
    };
    let mut list = steps.map(multiples).find(|list| list.len() >= 20).unwrap_or_default();
    let slack = 1e-9 * to;
    for wanted in [draught, to] {
        list.retain(|z| (z - wanted).abs() > slack);
        list.push(wanted);
    }
    list.sort_by(f64::total_cmp);
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frigate_gets_half_metres() {
        let list = default_draughts(Some(6.15), 12.0);
        assert_eq!(&list[..4], [1.5, 2.0, 2.5, 3.0]);
        assert!(list.contains(&6.15) && list.contains(&12.0));
        assert_eq!(list.len(), 23);
    }

    #[test]
    fn twenty_to_fifty_rising_rows_with_the_design_draught_at_any_size() {
        let mut draught = 0.01;
        while draught < 60.0 {
            for ratio in [0.5, 1.0, 1.013, 1.3, 1.7, 2.4, 4.0] {
                let list = default_draughts(Some(draught), ratio * draught);
                assert!((20..=50).contains(&list.len()), "{draught} {ratio}: {}", list.len());
                assert!(list.windows(2).all(|w| w[1] - w[0] > 1e-10 * draught), "{list:?}");
                assert!(list.iter().any(|z| z.to_bits() == draught.to_bits()));
                assert!(list[0] >= 0.2 * draught * (1.0 - 1e-9) && list[0] < 0.27 * draught * ratio.max(1.0));
            }
            draught *= 1.037;
        }
    }

    #[test]
    fn no_draughts_for_no_ship() {
        assert!(default_draughts(Some(0.0), 3.0).is_empty());
        assert!(default_draughts(Some(f64::NAN), 3.0).is_empty());
        assert!(default_draughts(Some(3.0), f64::INFINITY).is_empty());
        assert!(default_draughts(None, f64::NAN).is_empty());
    }

    #[test]
    fn without_a_design_draught_they_go_from_a_fifth_of_the_depth() {
        let list = default_draughts(None, 12.0);
        assert!((list[0] - 2.5).abs() < 1e-12 && (list[list.len() - 1] - 12.0).abs() < 1e-12, "{list:?}");
        assert_eq!(list, default_draughts(Some(12.0), 12.0));
    }
}
