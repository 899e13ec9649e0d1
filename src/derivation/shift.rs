//! Sections of a hull shifted along the ship, so that volume and centre of buoyancy come out exactly.
//!
//! A shift is a function of the part t of the way from midship to the end of each waterline of the net, the same on all: x' =
//! x + l dx(t), with l the length of that part. Stern and stem profile therefore stay as they are; where ends are upright
//! the lines are stations, and it is the classical shift of sections. The control points are shifted, and the amplitudes of
//! both halves are found by Newton's method on the quantities of the shifted hull itself.
//!
//! The level shift is dx = 16 a t^2 (1 - t)^2: value and slope are nothing at midship and at the end, so that no line gets a
//! knuckle. It folds at |a| = 3 sqrt(3) / 16, at t = (1 +- 1/sqrt(3)) / 2.

use super::quantity::{Quantity, Reference, value_of};
use super::request::Target;
use crate::hull::{Hull, HullError};
use crate::spline::BsplineSurface;

/// |a| at which the level shift folds, 3 sqrt(3) / 16.
pub const LEVEL_FOLD: f64 = 0.324_759_526_419_164_5;

/// Relative error at which amplitudes have come to rest.
const AT_REST: f64 = 1e-13;
/// Most steps of Newton's method.
const STEPS: usize = 30;
/// Step of difference quotients.
const DIFFERENCE: f64 = 1e-5;

/// dx of the level shift.
pub(super) fn level(t: f64, amplitude: f64) -> f64 {
    16.0 * amplitude * (t * (1.0 - t)).powi(2)
}

/// The hull with its control points shifted: `shift` gives dx(t) of the aft (0) and the fore body (1).
///
/// # Errors
/// [`HullError`] where sections pass each other.
pub(super) fn shifted(hull: &Hull, midship: f64, shift: &dyn Fn(usize, f64) -> f64) -> Result<Hull, HullError> {
    let surface = hull.surface();
    let [rows, columns] = surface.shape();
    let mut points = surface.points().to_vec();
    for j in 0..columns {
        let (aft, fore) = (surface.point(0, j)[0], surface.point(rows - 1, j)[0]);
        for i in 0..rows {
            let x = &mut points[i * columns + j][0];
            let (length, side, way) = if *x >= midship { (fore - midship, 1, 1.0) } else { (midship - aft, 0, -1.0) };
            if length > 0.0 {
                let t = ((*x - midship).abs() / length).min(1.0);
                *x += way * length * shift(side, t);
            }
        }
    }
    let surface = BsplineSurface::new(surface.u().clone(), surface.v().clone(), points)?;
    Hull::new(hull.name(), *hull.particulars(), surface, hull.deck().clone())
}

/// What a pair of amplitudes comes to.
pub(super) struct Settled {
    pub(super) hull: Hull,
    pub(super) amplitudes: [f64; 2],
    /// Largest relative error that is left.
    pub(super) error: f64,
}

/// A family of shifts with two amplitudes (aft, fore) and what it is to meet: at most two targets.
pub(super) struct Family<'a> {
    pub(super) hull: &'a Hull,
    pub(super) midship: f64,
    pub(super) reference: &'a Reference,
    pub(super) targets: &'a [Target],
    /// dx(side, t, amplitude).
    pub(super) shift: &'a (dyn Fn(usize, f64, f64) -> f64 + Sync),
    /// Least and greatest amplitude of each side.
    pub(super) limits: [[f64; 2]; 2],
}

impl Family<'_> {
    fn at(&self, amplitudes: [f64; 2]) -> Option<Hull> {
        shifted(self.hull, self.midship, &|side, t| (self.shift)(side, t, amplitudes[side])).ok()
    }

    /// Relative errors of the targets, of a centre over L_PP.
    fn errors(&self, hull: &Hull) -> [f64; 2] {
        let mut errors = [0.0; 2];
        for (error, target) in errors.iter_mut().zip(self.targets) {
            let size = if target.quantity == Quantity::Lcb { self.reference.between } else { target.value };
            *error = (value_of(target.quantity, hull, self.reference) - target.value) / size;
        }
        errors
    }

    fn clamped(&self, amplitudes: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|side| amplitudes[side].clamp(self.limits[side][0], self.limits[side][1]))
    }

    /// The step of Newton's method: both sides alike where there is one target.
    fn step(&self, at: [f64; 2], errors: [f64; 2]) -> Option<[f64; 2]> {
        let mut columns = [[0.0; 2]; 2];
        for side in 0..2 {
            let mut beside = at;
            // Away from the nearer limit.
            let [low, high] = self.limits[side];
            let by = if at[side] - low < high - at[side] { DIFFERENCE } else { -DIFFERENCE };
            beside[side] += by;
            let moved = self.errors(&self.at(beside)?);
            columns[side] = [0, 1].map(|k| (moved[k] - errors[k]) / by);
        }
        let [[a, c], [b, d]] = columns;
        if self.targets.len() < 2 {
            let both = a + b;
            return (both.abs() > 1e-12).then(|| [-errors[0] / both; 2]);
        }
        let determinant = a * d - b * c;
        (determinant.abs() > 1e-14).then(|| {
            let [e, f] = errors;
            [-(d * e - b * f) / determinant, -(a * f - c * e) / determinant]
        })
    }

    /// The amplitudes that meet the targets, or come nearest to them within the limits; none where even no shift makes a
    /// hull.
    pub(super) fn settle(&self, start: [f64; 2]) -> Option<Settled> {
        let largest = |errors: [f64; 2]| errors[0].abs().max(errors[1].abs());
        let mut amplitudes = self.clamped(start);
        let mut hull = self.at(amplitudes)?;
        let mut errors = self.errors(&hull);
        for _ in 0..STEPS {
            if self.targets.is_empty() || largest(errors) <= AT_REST {
                break;
            }
            let Some(step) = self.step(amplitudes, errors) else { break };
            let mut part = 1.0;
            let better = loop {
                let next = self.clamped([0, 1].map(|side| amplitudes[side] + part * step[side]));
                let found = self.at(next).map(|hull| (self.errors(&hull), hull, next));
                match found {
                    Some(found) if largest(found.0) < largest(errors) => break Some(found),
                    _ if part < 1e-3 => break None,
                    _ => part *= 0.5,
                }
            };
            let Some((found, next_hull, next)) = better else { break };
            (errors, hull, amplitudes) = (found, next_hull, next);
        }
        Some(Settled { hull, amplitudes, error: largest(errors) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::derivation::Origin;
    use crate::derivation::samples::{parabolic, tug};
    use crate::hydrostatics::Conventions;

    #[test]
    fn the_level_shift_folds_at_its_limit() {
        let slope = |t: f64| (level(t + 1e-6, LEVEL_FOLD) - level(t - 1e-6, LEVEL_FOLD)) / 2e-6;
        let steepest = 0.5 * (1.0 + 1.0 / 3f64.sqrt());
        assert!((slope(steepest) + 1.0).abs() < 1e-9 && slope(0.0).abs() < 1e-5 && slope(1.0).abs() < 1e-5);
        assert!((0..1000).all(|k| slope(f64::from(k) / 1000.0) > -1.0 - 1e-9));
    }

    #[test]
    fn volume_and_centre_come_out_exactly() {
        for hull in [tug(), parabolic()] {
            let reference = Reference::of(&hull, &Conventions::default()).unwrap();
            let wanted = |quantity, change: f64| Target {
                quantity,
                value: value_of(quantity, &hull, &reference) + change,
                origin: Origin::Given,
            };
            let volume = 0.03 * reference.volume();
            let targets = [wanted(Quantity::Volume, volume), wanted(Quantity::Lcb, 0.008 * reference.between)];
            let family = Family {
                hull: &hull,
                midship: 0.5 * reference.between,
                reference: &reference,
                targets: &targets,
                shift: &|_, t, amplitude| level(t, amplitude),
                limits: [[-0.3, 0.3]; 2],
            };
            let settled = family.settle([0.0; 2]).unwrap();
            assert!(settled.error < 1e-12, "{}", settled.error);
            // Profiles stay.
            let [rows, columns] = hull.surface().shape();
            for j in 0..columns {
                for i in [0, rows - 1] {
                    let (a, b) = (hull.surface().point(i, j), settled.hull.surface().point(i, j));
                    assert!((a[0] - b[0]).abs() < 1e-12);
                }
            }
        }
    }
}
