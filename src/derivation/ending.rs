//! The angles between the design waterline and the centreplane at its ends.
//!
//! With the determinant J = x_u z_v - x_v z_u of the chart, the waterline through (u, v) has
//!
//! ```text
//! dy/dx = (y_u z_v - y_v z_u) / J,      tan i_E = -dy/dx at its fore end,      tan i_R = dy/dx at its aft end
//! ```
//!
//! which is linear in the half-breadths on a fixed chart. Where J vanishes the stem is round, and the waterline has no angle.

use super::pool::row_of;
use crate::hull::Hull;

/// |J| below this part of its mean is none.
const VANISHING: f64 = 1e-6;

/// An end of the design waterline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum WaterlineEnd {
    Aft,
    Fore,
}

/// tan of the half angle at an end of the waterline at `draught`, with its weights over the net; none where the end is round.
pub(super) fn slope(hull: &Hull, draught: f64, end: WaterlineEnd) -> Option<(f64, Vec<(usize, f64)>)> {
    let surface = hull.surface();
    let (along, up) = (surface.u(), surface.v());
    let ((aft, fore), (low, high)) = (along.domain(), up.domain());
    let (u, way) = if end == WaterlineEnd::Fore { (fore, -1.0) } else { (aft, 1.0) };
    let v = hull.height_parameter_at(u, draught)?;
    let d = surface.derivatives::<2>(u, v);
    let jacobian = d[1][0][0] * d[0][1][2] - d[0][1][0] * d[1][0][2];
    let mean =
        hull.particulars().length_between_perpendiculars * (hull.top() - hull.bottom()) / ((fore - aft) * (high - low));
    if jacobian.abs() <= VANISHING * mean {
        return None;
    }
    let heights = [d[0][1][2], -d[1][0][2]].map(|z| way * z / jacobian);
    let mut weights = row_of(surface, [u, v], &[[1, 0], [0, 1]], &heights);
    weights.retain(|(_, weight)| weight.abs() > 0.0);
    Some((weights.iter().map(|&(k, weight)| weight * surface.points()[k][1]).sum(), weights))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::derivation::samples::{parabolic, tug};
    use crate::hydrostatics::{Conventions, CurvesOfForm};

    /// Wigley: y = b (1 - X^2) with X = 2 x / L - 1 has tan i = 2 B / L at both ends.
    #[test]
    fn the_angle_of_a_parabola() {
        for end in [WaterlineEnd::Aft, WaterlineEnd::Fore] {
            let (found, _) = slope(&parabolic(), 6.25, end).unwrap();
            assert!((found - 0.2).abs() < 1e-12, "{found}");
        }
    }

    /// What hydrostatics find by other rules, where stem and stern rake.
    #[test]
    fn the_angles_are_those_of_hydrostatics() {
        let hull = tug();
        let row = CurvesOfForm::new(&hull, &[3.6], &Conventions::default()).rows.remove(0);
        for (end, angle) in
            [(WaterlineEnd::Aft, row.half_angle_of_run), (WaterlineEnd::Fore, row.half_angle_of_entrance)]
        {
            let found = slope(&hull, 3.6, end).map(|(slope, _)| slope.atan().to_degrees());
            assert!(found.zip(angle).is_some_and(|(a, b)| (a.abs() - b).abs() < 1e-9), "{end:?} {found:?} {angle:?}");
        }
    }
}
