//! The median.

/// The median of a list, the mean of the two in the middle where their number is even; none of an empty list. Sorts the
/// list.
pub fn median(list: &mut [f64]) -> Option<f64> {
    list.sort_by(f64::total_cmp);
    let n = list.len();
    (n > 0).then(|| 0.5 * (list[(n - 1) / 2] + list[n / 2]))
}
