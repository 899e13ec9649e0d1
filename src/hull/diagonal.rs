//! Offsets on diagonals: the distance from the centreplane along a plane that slopes down and outboard from it.

use super::form::Hull;

/// Steps in which the first crossing is looked for.
const STEPS: usize = 96;
/// Halvings of the bracket of a crossing.
const HALVINGS: usize = 60;

/// Distance \[m\] along the diagonal that starts at `height` on the centreplane and falls by `angle` \[rad\], from
/// there to the side at the station `x`; the crossing nearest to the centreplane, to rounding. None where the diagonal
/// does not meet the side below the deck.
#[must_use]
pub fn diagonal_offset(hull: &Hull, x: f64, height: f64, angle: f64) -> Option<f64> {
    let (sine, cosine) = angle.sin_cos();
    let lowest = hull.bottom();
    let reach = if sine > 0.0 { (height - lowest) / sine } else { f64::INFINITY };
    let reach = reach.min(hull.particulars().breadth / cosine);
    // The breadth that is left between the plane and the side; none below the keel line and beyond the ends.
    let left = |s: f64| hull.half_breadth(x, height - s * sine).map(|y| y - s * cosine);
    if !(reach > 0.0 && reach.is_finite()) || height > hull.deck_height(x) || left(0.0)? < 0.0 {
        return None;
    }
    let mut from = 0.0;
    for k in 1..=STEPS {
        let to = reach * k as f64 / STEPS as f64;
        if left(to).is_some_and(|left| left > 0.0) {
            from = to;
            continue;
        }
        let (mut inside, mut outside) = (from, to);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (inside + outside);
            if left(middle).is_some_and(|left| left > 0.0) { inside = middle } else { outside = middle }
        }
        // Where the side ends in air below the plane nothing is met.
        return left(outside).filter(|left| left.abs() < 1e-9 * reach).map(|_| outside);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::PrincipalParticulars;
    use super::*;
    use crate::spline::{BsplineCurve, BsplineSurface, KnotVector};

    /// A wedge y = 0.8 z, 10 m long and 5 m deep.
    fn wedge() -> Hull {
        let knots = || KnotVector::uniform(1, 1).unwrap();
        let points = vec![[0.0, 0.0, 0.0], [0.0, 4.0, 5.0], [10.0, 0.0, 0.0], [10.0, 4.0, 5.0]];
        let surface = BsplineSurface::new(knots(), knots(), points).unwrap();
        let deck = BsplineCurve::new(knots(), vec![[0.0, 5.0], [10.0, 5.0]]).unwrap();
        let particulars =
            PrincipalParticulars { length_between_perpendiculars: 10.0, breadth: 8.0, draught: Some(4.0), depth: 5.0 };
        Hull::new("wedge", particulars, surface, deck).unwrap()
    }

    #[test]
    fn a_diagonal_meets_a_wedge_where_the_lines_cross() {
        // 0.8 (4 - s sin a) = s cos a.
        let angle = 0.6_f64;
        let exact = 3.2 / (angle.cos() + 0.8 * angle.sin());
        let found = diagonal_offset(&wedge(), 3.0, 4.0, angle).unwrap();
        assert!((found - exact).abs() < 1e-12, "{found} {exact}");
        assert_eq!(diagonal_offset(&wedge(), 11.0, 4.0, angle), None);
        assert_eq!(diagonal_offset(&wedge(), 3.0, 6.0, angle), None);
    }
}
