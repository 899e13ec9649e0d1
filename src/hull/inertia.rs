//! The transverse second moment of the waterplane, I_T = (2/3) int y^3 dx, and its gradient over the net of
//! half-breadths.
//!
//! dI_T/dy_k = 2 int y^2 N_k dx, on a fixed chart a row like that of the waterplane area with y^2 in the integrand; I_T
//! is a cubic form, so that I_T = (1/3) sum_k y_k dI_T/dy_k (Euler). Exact to rounding on level hulls, to about 1e-10
//! on others.

use super::charted::Arm;
use super::form::Hull;
use super::functional::waterplane_weights;

/// I_T \[m^4\] of the waterplane at `draught` \[m\], both sides; 0 where there is none.
#[must_use]
pub fn transverse_inertia(hull: &Hull, draught: f64) -> f64 {
    let columns = hull.surface().shape()[1];
    let points = hull.surface().points();
    let mut sum = 0.0;
    waterplane_weights(hull, draught, Arm::BreadthSquared, &mut |i, first, weights| {
        sum += points[i * columns + first..].iter().zip(weights).map(|(p, w)| w * p[1]).sum::<f64>();
    });
    sum / 3.0
}

/// dI_T/dy \[m^3\] over the net, `u` slowest.
#[must_use]
pub fn transverse_inertia_gradient(hull: &Hull, draught: f64) -> Vec<f64> {
    let columns = hull.surface().shape()[1];
    let mut row = vec![0.0; hull.surface().points().len()];
    waterplane_weights(hull, draught, Arm::BreadthSquared, &mut |i, first, weights| {
        for (target, weight) in row[i * columns + first..].iter_mut().zip(weights) {
            *target += weight;
        }
    });
    row
}
