//! Outlines of areas with no more corners than they need.

/// How far corners may stand off the sides of an area that leaves them out [mm].
const STRAIGHT: f64 = 0.02;

/// The corners of an outline, but for those beside straight sides.
pub(in crate::plot) fn straightened(outline: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let Some((&first, rest)) = outline.split_first() else { return Vec::new() };
    let (mut kept, mut from) = (vec![first], 0);
    for k in 1..rest.len() {
        let (a, b) = (outline[from], outline[k + 1]);
        let along = [b[0] - a[0], b[1] - a[1]];
        let length = along[0].hypot(along[1]);
        let off = |p: &[f64; 2]| {
            let by = [p[0] - a[0], p[1] - a[1]];
            let across = (along[0] * by[1] - along[1] * by[0]).abs();
            // A corner that turns back is one.
            across > STRAIGHT * length || along[0] * by[0] + along[1] * by[1] > length * length
        };
        if outline[from + 1..=k].iter().any(off) {
            kept.push(outline[k]);
            from = k;
        }
    }
    kept.extend(rest.last());
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_on_straight_sides_are_left_out() {
        let square = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.001], [3.0, 0.0], [3.0, 1.5], [3.0, 3.0], [0.0, 3.0]];
        assert_eq!(straightened(&square), [[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0]]);
        assert_eq!(straightened(&[[0.0, 0.0], [2.0, 0.0], [1.0, 0.0]]).len(), 3);
        assert!(straightened(&[]).is_empty() && straightened(&square[..1]).len() == 1);
    }

    #[test]
    fn a_circle_stays_one() {
        let circle: Vec<[f64; 2]> =
            (0..200).map(|k| (0.0314 * f64::from(k)).sin_cos()).map(|(s, c)| [5.0 * s, 5.0 * c]).collect();
        let kept = straightened(&circle);
        assert!((10..60).contains(&kept.len()), "{}", kept.len());
    }
}
