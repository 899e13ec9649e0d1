//! Sections of a hull shifted along the ship, so that volume and centre of buoyancy come out exactly.
//!
//! The classical shifts are functions of x alone: all of a section moves, its point of the profile too, and the ends of the
//! waterline stay. The level shift leaves the profiles where they are. Its ends are straight lines in the profile, x = a + b
//! z, just inside of stern and stem, so that the shift is smooth where a profile has corners; with t the part of the way from
//! midship to that line and l its length,
//!
//! ```text
//! x' = x + l dx(t),   dx = 64 a t^3 (1 - t)^3
//! ```
//!
//! Value, slope and curvature are nothing at midship and at the end, so that no line gets a knuckle or a jump of curvature. It
//! folds at |a| = sqrt(5) / 7.68, at t (1 - t) = 1/5. The control points are shifted, and the amplitudes of both halves are
//! found by Newton's method on the quantities of the shifted hull itself.

use super::quantity::{Quantity, Reference, value_of};
use super::request::Target;
use crate::hull::{Hull, HullError};
use crate::spline::BsplineSurface;

/// |a| at which the level shift folds, sqrt(5) / 7.68.
pub const LEVEL_FOLD: f64 = 0.291_154_684_570_285_15;

/// Least part of the way to the end of the waterline that a line inside the profile leaves at any height.
const LEAST_LENGTH: f64 = 0.3;

/// Relative error at which amplitudes have come to rest.
const AT_REST: f64 = 1e-13;
/// Most steps of Newton's method.
const STEPS: usize = 30;
/// Step of difference quotients.
const DIFFERENCE: f64 = 1e-5;

/// dx of the level shift.
pub(super) fn level(t: f64, amplitude: f64) -> f64 {
    64.0 * amplitude * (t * (1.0 - t)).powi(3)
}

/// How far the ends of a shift are from midship: a length \[m\] at each height, aft and fore.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ends {
    midship: f64,
    /// Length at z = 0 and its change per metre of height, aft and fore.
    lengths: [[f64; 2]; 2],
    /// Whether the shift goes on beyond the ends.
    beyond: bool,
}

impl Ends {
    /// The same at all heights, with a shift that goes on beyond them.
    pub(super) fn upright(midship: f64, [aft, fore]: [f64; 2]) -> Self {
        Self { midship, lengths: [[aft, 0.0], [fore, 0.0]], beyond: true }
    }

    /// Straight lines just inside of stern and stem.
    pub(super) fn inside(hull: &Hull, midship: f64) -> Self {
        let [rows, columns] = hull.surface().shape();
        let profile = |row: usize, way: f64| -> Vec<[f64; 2]> {
            let points = (0..columns).map(|j| hull.surface().point(row, j));
            points.map(|[x, _, z]| [z, way * (x - midship)]).collect()
        };
        let reach = [hull.bottom(), hull.top()];
        Self {
            midship,
            lengths: [line_below(&profile(0, -1.0), reach), line_below(&profile(rows - 1, 1.0), reach)],
            beyond: false,
        }
    }

    fn length(&self, side: usize, z: f64) -> f64 {
        self.lengths[side][0] + self.lengths[side][1] * z
    }
}

/// The straight line [at z = 0, per metre] below all points (z, length) with the least sum of gaps; the level one through the
/// least where no other leaves enough length between the heights `reach`.
fn line_below(points: &[[f64; 2]], reach: [f64; 2]) -> [f64; 2] {
    let least = points.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    let most = points.iter().map(|p| p[1]).fold(0.0, f64::max);
    let (height, size) = ((reach[1] - reach[0]).max(1e-9), most.max(1e-9));
    let gaps = |[at, by]: [f64; 2]| points.iter().map(|p| p[1] - at - by * p[0]).sum::<f64>();
    let mut best = ([least, 0.0], gaps([least, 0.0]));
    for (k, a) in points.iter().enumerate() {
        for b in &points[k + 1..] {
            if (b[0] - a[0]).abs() <= 0.05 * height {
                continue;
            }
            let by = (b[1] - a[1]) / (b[0] - a[0]);
            let line = [a[1] - by * a[0], by];
            let below = points.iter().all(|p| line[0] + by * p[0] <= p[1] + 1e-9 * size);
            let enough = reach.iter().all(|z| line[0] + by * z >= LEAST_LENGTH * size);
            if below && enough && gaps(line) < best.1 {
                best = (line, gaps(line));
            }
        }
    }
    best.0
}

/// The hull with its control points shifted: `shift` gives dx(t) of the aft (0) and the fore body (1).
///
/// # Errors
/// [`HullError`] where sections pass each other.
pub(super) fn shifted(hull: &Hull, ends: &Ends, shift: &dyn Fn(usize, f64) -> f64) -> Result<Hull, HullError> {
    let surface = hull.surface();
    let mut points = surface.points().to_vec();
    for [x, _, z] in &mut points {
        let (side, way) = if *x >= ends.midship { (1, 1.0) } else { (0, -1.0) };
        let length = ends.length(side, *z);
        let t = (*x - ends.midship).abs() / length;
        if length > 0.0 && (ends.beyond || t < 1.0) {
            *x += way * length * shift(side, t);
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
    pub(super) ends: Ends,
    pub(super) reference: &'a Reference,
    pub(super) targets: &'a [Target],
    /// dx(side, t, amplitude).
    pub(super) shift: &'a (dyn Fn(usize, f64, f64) -> f64 + Sync),
    /// Least and greatest amplitude of each side.
    pub(super) limits: [[f64; 2]; 2],
}

impl Family<'_> {
    fn at(&self, amplitudes: [f64; 2]) -> Option<Hull> {
        shifted(self.hull, &self.ends, &|side, t| (self.shift)(side, t, amplitudes[side])).ok()
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
        // t (1 - t) = 1/5.
        let steepest = 0.5 * (1.0 + 0.2f64.sqrt());
        assert!((slope(steepest) + 1.0).abs() < 1e-9 && slope(0.0).abs() < 1e-5 && slope(1.0).abs() < 1e-5);
        assert!((0..1000).all(|k| slope(f64::from(k) / 1000.0) > -1.0 - 1e-9));
    }

    #[test]
    fn lines_stand_inside_of_profiles() {
        // A corner at z = 1: the line through the lowest and the highest point is below it.
        let line = line_below(&[[0.0, 4.0], [1.0, 6.0], [2.0, 6.0]], [0.0, 2.0]);
        assert!((line[0] - 4.0).abs() < 1e-12 && (line[1] - 1.0).abs() < 1e-12, "{line:?}");
        let level = line_below(&[[0.0, 1.0], [1.0, 6.0]], [0.0, 1.0]);
        assert!((level[0] - 1.0).abs() < 1e-12 && level[1].abs() < 1e-12, "{level:?}");
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
                ends: Ends::inside(&hull, 0.5 * reference.between),
                reference: &reference,
                targets: &targets,
                shift: &|_, t, amplitude| level(t, amplitude),
                limits: [[-0.25, 0.25]; 2],
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
