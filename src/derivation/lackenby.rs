//! Shifts of sections along the ship: Lackenby (1950) and one minus prismatic, in closed form.
//!
//! For one half body, x from midship over the length h of the half, phi its prismatic coefficient, xb its centroid, k its
//! radius about midship and p its parallel part (Lackenby 1950, Trans. INA 92, 289-316):
//!
//! ```text
//! A = phi (1 - 2 xb) - p (1 - phi)
//! B = phi (2 xb - 3 k^2 - p (1 - 2 xb)) / A
//! C = (B (1 - phi) - phi (1 - 2 xb)) / (1 - p)
//! dx = (1 - x) {dp / (1 - p) + (x - p) / A [dphi - dp (1 - phi) / (1 - p)]}
//! ```
//!
//! and for one minus prismatic dx = dphi / (1 - phi) (1 - x). Areas are linear in the shift, so that C_P is met in one
//! pass; the centre of buoyancy has a term of dx^2, which the method leaves. Here both are iterated.

use crate::hull::{Functional, Hull};
use crate::numeric::gauss_legendre;

/// Nodes and panels of the integrals over a half body.
const NODES: usize = 12;
const PANELS: usize = 12;

/// The curve of areas of half a ship: forward or aft of midship.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfBody {
    /// Length from midship to the end of the waterline \[m\].
    pub length: f64,
    /// phi: area below the curve over that of its rectangle \[-\].
    pub prismatic: f64,
    /// xb: centroid from midship, in half lengths \[-\].
    pub centroid: f64,
    /// k^2: square of the radius about midship, in half lengths \[-\].
    pub radius_squared: f64,
    /// p: the parallel part, in half lengths \[-\].
    pub parallel: f64,
}

/// How far a coefficient of a half body may change before sections pass each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShiftLimit {
    /// Least change of phi \[-\].
    pub low: f64,
    /// Greatest change of phi \[-\].
    pub high: f64,
}

impl HalfBody {
    /// Of a curve of areas over its largest, a(x) for x from 0 at midship to 1 at the end.
    #[must_use]
    pub fn of(length: f64, parallel: f64, area: impl Fn(f64) -> f64) -> Self {
        let rule = gauss_legendre(NODES);
        let mut sums = [0.0; 3];
        for panel in 0..PANELS {
            let [from, to] = [panel, panel + 1].map(|k| k as f64 / PANELS as f64);
            for (x, weight) in rule.on(from, to) {
                let a = weight * area(x);
                sums[0] += a;
                sums[1] += a * x;
                sums[2] += a * x * x;
            }
        }
        let [prismatic, moment, second] = sums;
        Self { length, prismatic, centroid: moment / prismatic, radius_squared: second / prismatic, parallel }
    }

    /// A of the formula \[-\].
    #[must_use]
    pub fn a(&self) -> f64 {
        self.prismatic * (1.0 - 2.0 * self.centroid) - self.parallel * (1.0 - self.prismatic)
    }

    /// B of the formula: the arm of what changes, in half lengths \[-\].
    #[must_use]
    pub fn b(&self) -> f64 {
        let Self { prismatic, centroid, radius_squared, parallel, .. } = *self;
        prismatic * (2.0 * centroid - 3.0 * radius_squared - parallel * (1.0 - 2.0 * centroid)) / self.a()
    }

    /// C of the formula \[-\].
    #[must_use]
    pub fn c(&self) -> f64 {
        let Self { prismatic, centroid, parallel, .. } = *self;
        (self.b() * (1.0 - prismatic) - prismatic * (1.0 - 2.0 * centroid)) / (1.0 - parallel)
    }

    /// dx(x) of Lackenby for a change of phi by `change` and of p by `parallel`; within the parallel body in proportion.
    #[must_use]
    pub fn lackenby(&self, x: f64, change: f64, parallel: f64) -> f64 {
        let p = self.parallel;
        if x < p {
            return parallel * x / p;
        }
        let steep = (change - parallel * (1.0 - self.prismatic) / (1.0 - p)) / self.a();
        (1.0 - x) * (parallel / (1.0 - p) + (x - p) * steep)
    }

    /// dx(x) of one minus prismatic; within the parallel body in proportion.
    #[must_use]
    pub fn one_minus_prismatic(&self, x: f64, change: f64) -> f64 {
        let (p, c) = (self.parallel, change / (1.0 - self.prismatic));
        if x < p { c * (1.0 - p) * x / p } else { c * (1.0 - x) }
    }

    /// Changes of phi at which the shift of Lackenby folds with a change of p by `parallel`: at the end for +, at the
    /// shoulder for -.
    ///
    /// 1 + dx' > 0 with dx' = -dp/(1 - p) + c (1 + p - 2 x) and c = [dphi - dp (1 - phi)/(1 - p)]/A.
    #[must_use]
    pub fn lackenby_limit(&self, parallel: f64) -> ShiftLimit {
        let p = self.parallel;
        let (lost, base) = (parallel / (1.0 - p), parallel * (1.0 - self.prismatic) / (1.0 - p));
        let most = (1.0 - lost) / (1.0 - p) * self.a();
        let [low, high] = [base - most, base + most];
        ShiftLimit { low: low.min(high), high: high.max(low) }
    }

    /// Changes of phi at which one minus prismatic folds: less than the parallel body cannot be taken away, and the end
    /// cannot be left without length.
    #[must_use]
    pub fn one_minus_prismatic_limit(&self) -> ShiftLimit {
        ShiftLimit { low: -self.parallel * (1.0 - self.prismatic) / (1.0 - self.parallel), high: 1.0 - self.prismatic }
    }
}

/// The halves of a hull below `draught` \[m\], aft and fore, about `midship` \[m\], with the ends of the parallel body. None
/// where midship is not between the ends of the waterline, or has no area.
pub(super) fn halves(hull: &Hull, draught: f64, midship: f64, parallel: Option<[f64; 2]>) -> Option<[HalfBody; 2]> {
    let [aft, fore] = hull.endings(draught)?;
    let area = |x: f64| Functional::SectionArea { x }.value(hull, draught);
    let largest = area(midship);
    if !(aft < midship && midship < fore && largest > 0.0) {
        return None;
    }
    let part = |reach: f64, length: f64| (reach / length).clamp(0.0, 0.999);
    let [from, to] = parallel.unwrap_or([midship; 2]);
    let (behind, ahead) = (midship - aft, fore - midship);
    Some([
        HalfBody::of(behind, part(midship - from, behind), |x| area(midship - x * behind) / largest),
        HalfBody::of(ahead, part(to - midship, ahead), |x| area(midship + x * ahead) / largest),
    ])
}

/// Changes of phi of the aft and the fore body for a change of phi of the whole by `change` and of its centroid by `moved` half
/// lengths forward, the parallel parts changing by `parallel` (aft, fore):
///
/// ```text
/// dphi_f,a = [2 (dphi (B_a,f +- z) +- dz (phi + dphi)) +- C_f dp_f -+ C_a dp_a] / (B_f + B_a)
/// ```
///
/// with z the centroid before, in half lengths forward of midship (Lackenby 1950).
#[must_use]
pub fn changes_of_halves([aft, fore]: &[HalfBody; 2], change: f64, moved: f64, parallel: [f64; 2]) -> [f64; 2] {
    let phi = 0.5 * (aft.prismatic + fore.prismatic);
    let centre = 0.5 * (fore.prismatic * fore.centroid - aft.prismatic * aft.centroid) / phi;
    let (ba, bf) = (aft.b(), fore.b());
    let ends = fore.c() * parallel[1] - aft.c() * parallel[0];
    let shifted = moved * (phi + change);
    let to_fore = (2.0 * (change * (ba + centre) + shifted) + ends) / (bf + ba);
    let to_aft = (2.0 * (change * (bf - centre) - shifted) - ends) / (bf + ba);
    [to_aft, to_fore]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parabola() -> HalfBody {
        HalfBody::of(50.0, 0.0, |x| 1.0 - x * x)
    }

    /// a = 1 - x^2: phi = 2/3, xb = 3/8, k^2 = 1/5, A = 1/6, B = 0.6, dx = 6 dphi x (1 - x).
    #[test]
    fn the_parabola_in_closed_form() {
        let half = parabola();
        for (found, expected) in [
            (half.prismatic, 2.0 / 3.0),
            (half.centroid, 0.375),
            (half.radius_squared, 0.2),
            (half.a(), 1.0 / 6.0),
            (half.b(), 0.6),
            (half.lackenby(0.3, 0.02, 0.0), 6.0 * 0.02 * 0.3 * 0.7),
            (half.one_minus_prismatic(0.3, 0.02), 0.06 * 0.7),
            (half.lackenby_limit(0.0).high, 1.0 / 6.0),
            (half.lackenby_limit(0.0).low, -1.0 / 6.0),
        ] {
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
    }

    /// At the limit the slope of the shift is -1: at the end for +, at midship for -.
    #[test]
    fn shifts_fold_where_they_are_stated_to() {
        let half = parabola();
        let slope = |x: f64, change: f64| (half.lackenby(x + 1e-6, change, 0.0) - half.lackenby(x, change, 0.0)) / 1e-6;
        assert!((slope(1.0 - 1e-6, 1.0 / 6.0) + 1.0).abs() < 1e-5);
        assert!((slope(0.0, -1.0 / 6.0) + 1.0).abs() < 1e-5);
        // With a parallel body that grows.
        let half = HalfBody { parallel: 0.2, ..HalfBody::of(50.0, 0.0, |x| 1.0 - ((x - 0.2) / 0.8).max(0.0).powi(2)) };
        let limit = half.lackenby_limit(0.1);
        let at = |x: f64, change: f64| half.lackenby(x, change, 0.1);
        assert!(((at(1.0, limit.high) - at(1.0 - 1e-6, limit.high)) / 1e-6 + 1.0).abs() < 1e-4);
        assert!(((at(0.2 + 1e-6, limit.low) - at(0.2, limit.low)) / 1e-6 + 1.0).abs() < 1e-4);
    }

    /// Both halves alike: without a move of the centroid each takes the whole change; and the areas are met in one pass.
    #[test]
    fn changes_are_shared_by_the_halves() {
        let halves = [parabola(), parabola()];
        let [aft, fore] = changes_of_halves(&halves, 0.03, 0.0, [0.0; 2]);
        assert!((aft - 0.03).abs() < 1e-12 && (fore - 0.03).abs() < 1e-12, "{aft} {fore}");
        // +0.03 of C_P and +1 % of L, 0.02 half lengths: the centroid comes out 0.06 % of L off (its term of dx^2).
        let [aft, fore] = changes_of_halves(&halves, 0.03, 0.02, [0.0; 2]);
        let moments = |half: &HalfBody, change: f64| {
            let rule = gauss_legendre(24);
            let sum = |power: i32| -> f64 {
                // int x'^power dA over the moved sections: a(x) dx', dx' = (1 + dx') dx.
                rule.on(0.0, 1.0)
                    .map(|(x, w)| {
                        let moved = x + half.lackenby(x, change, 0.0);
                        let slope = 1.0 + 6.0 * change * (1.0 - 2.0 * x);
                        w * (1.0 - x * x) * slope * moved.powi(power)
                    })
                    .sum()
            };
            [sum(0), sum(1)]
        };
        let ([va, ma], [vf, mf]) = (moments(&halves[0], aft), moments(&halves[1], fore));
        assert!((0.5 * (va + vf) - 2.0 / 3.0 - 0.03).abs() < 1e-12);
        // Half lengths to per cent of L.
        let error = 50.0 * ((mf - ma) / (va + vf) - 0.02);
        assert!((error - 0.06).abs() < 0.005, "{error}");
    }
}
