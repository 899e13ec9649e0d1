//! The midship section: flat keel, floor with rise, one circular bilge, vertical side.
//!
//! With half-breadth h = B/2, half width of the keel k, w = h - k, rise of floor beta, d = pi/2 - beta and bilge radius
//! R, the area missing from the rectangle is (1 - Cm) h T = w^2 tan(beta) / 2 + R^2 (tan(d/2) - d/2); for beta = 0 this
//! is Watson (1998) eq. 8.1, R = sqrt(2.33 (1 - Cm) B T). The bilge fits while R tan(d/2) <= min(w / cos(beta), T - w
//! tan(beta)).

use std::f64::consts::FRAC_PI_2;

use crate::numeric::bracketed_root;

/// A midship section, one side \[m, rad\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MidshipSection {
    /// B/2.
    pub(super) half_breadth: f64,
    /// Half width of the flat keel.
    pub(super) keel: f64,
    /// Rise of floor.
    pub(super) deadrise: f64,
    /// Bilge radius.
    pub(super) radius: f64,
}

/// Why no section was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum MidshipProblem {
    /// The bilge does not fit: the radius that the area asks for, and the largest that fits.
    Bilge { radius: f64, largest: f64 },
    /// The floor alone takes more than is missing: the largest rise that the area allows.
    Floor { largest: f64 },
    /// With this radius the section coefficient stays between these values whatever the rise of floor.
    Coefficient { lowest: f64, highest: f64 },
}

/// Radius of the bilge for a missing area, or `None` when the floor alone takes more.
fn radius_for(missing: f64, w: f64, deadrise: f64) -> Option<f64> {
    let d = FRAC_PI_2 - deadrise;
    let left = missing - 0.5 * w * w * deadrise.tan();
    (left >= -1e-14 * missing.max(w * w)).then(|| (left.max(0.0) / ((0.5 * d).tan() - 0.5 * d)).sqrt())
}

/// The largest radius that fits, negative when the floor rises above the waterline.
fn largest_radius(w: f64, draught: f64, deadrise: f64) -> f64 {
    (w / deadrise.cos()).min(draught - w * deadrise.tan()) / (0.5 * (FRAC_PI_2 - deadrise)).tan()
}

impl MidshipSection {
    /// The section of coefficient `coefficient` = area / (h T); a rise of floor or a radius that is given is kept. When
    /// neither is given the floor is flat if the bilge fits, otherwise the rise lies 15 % up the feasible interval (a
    /// round bilge).
    pub(super) fn solve(
        half_breadth: f64,
        draught: f64,
        keel: f64,
        coefficient: f64,
        deadrise: Option<f64>,
        radius: Option<f64>,
    ) -> Result<Self, MidshipProblem> {
        let w = half_breadth - keel;
        let missing = (1.0 - coefficient) * half_breadth * draught;
        let section = |deadrise: f64, radius: f64| Self { half_breadth, keel, deadrise, radius };
        let fits = |beta: f64| radius_for(missing, w, beta).is_some_and(|r| r <= largest_radius(w, draught, beta));
        if let Some(radius) = radius {
            let excess = |beta: f64| {
                let d = FRAC_PI_2 - beta;
                0.5 * w * w * beta.tan() + radius * radius * ((0.5 * d).tan() - 0.5 * d) - missing
            };
            // The missing area first falls, then rises with the rise of floor: bracket on the rising branch.
            let steps = 400;
            let highest = (draught / w).atan();
            let betas: Vec<f64> = (0..=steps).map(|k| highest * f64::from(k) / f64::from(steps)).collect();
            let usable = |beta: f64| radius <= largest_radius(w, draught, beta) * (1.0 + 1e-12);
            let mut range = (f64::INFINITY, f64::NEG_INFINITY);
            for pair in betas.windows(2) {
                if !usable(pair[0]) {
                    continue;
                }
                let (a, b) = (excess(pair[0]), excess(pair[1]));
                let of = |e: f64| 1.0 - (e + missing) / (half_breadth * draught);
                range = (range.0.min(of(a)), range.1.max(of(a)));
                if (a <= 0.0) != (b <= 0.0) || a.abs() < 1e-14 * missing {
                    let beta = bracketed_root(excess, pair[0], pair[1], 1e-15).unwrap_or(pair[0]);
                    return Ok(section(beta, radius));
                }
            }
            return Err(MidshipProblem::Coefficient { lowest: range.0, highest: range.1 });
        }
        let beta = match deadrise {
            Some(beta) => beta,
            None if fits(0.0) => 0.0,
            None => {
                let highest = (2.0 * missing / (w * w)).atan().min((draught / w).atan());
                let steps = 1000;
                let feasible: Vec<f64> =
                    (1..=steps).map(|k| highest * f64::from(k) / f64::from(steps)).filter(|&b| fits(b)).collect();
                match (feasible.first(), feasible.last()) {
                    (Some(first), Some(last)) => first + 0.15 * (last - first),
                    _ => 0.0,
                }
            }
        };
        match radius_for(missing, w, beta) {
            None => Err(MidshipProblem::Floor { largest: (2.0 * missing / (w * w)).atan() }),
            Some(radius) => {
                let largest = largest_radius(w, draught, beta);
                if radius <= largest * (1.0 + 1e-12) {
                    Ok(section(beta, radius))
                } else {
                    Err(MidshipProblem::Bilge { radius, largest })
                }
            }
        }
    }

    /// Smallest coefficient that one circular bilge can have at this draught, over all rises of floor.
    pub(super) fn smallest_coefficient(half_breadth: f64, draught: f64, keel: f64) -> f64 {
        let w = half_breadth - keel;
        let steps = 500;
        (0..=steps)
            .map(|k| {
                let beta = (draught / w).atan() * f64::from(k) / f64::from(steps);
                let radius = largest_radius(w, draught, beta).max(0.0);
                let d = FRAC_PI_2 - beta;
                let missing = 0.5 * w * w * beta.tan() + radius * radius * ((0.5 * d).tan() - 0.5 * d);
                1.0 - missing / (half_breadth * draught)
            })
            .fold(1.0, f64::min)
    }

    /// Where the floor meets the bilge: (y, z).
    pub(super) fn floor_end(&self) -> (f64, f64) {
        let (sin, cos) = self.deadrise.sin_cos();
        let (y, z) = self.bilge_centre();
        (y + self.radius * sin, z - self.radius * cos)
    }

    /// Centre of the bilge circle: (y, z).
    pub(super) fn bilge_centre(&self) -> (f64, f64) {
        let y = self.half_breadth - self.radius;
        (y, (y - self.keel) * self.deadrise.tan() + self.radius / self.deadrise.cos())
    }

    /// Lengths along the section of floor (0 when it is flat and belongs to the bottom) and bilge.
    pub(super) fn girths(&self) -> (f64, f64) {
        let floor = if self.deadrise > 0.0 { self.floor_end().1 / self.deadrise.sin() } else { 0.0 };
        (floor, self.radius * (FRAC_PI_2 - self.deadrise))
    }

    /// The point (y, z) at `girth` along floor, bilge and side.
    pub(super) fn at_girth(&self, girth: f64) -> (f64, f64) {
        let (floor, bilge) = self.girths();
        let (sin, cos) = self.deadrise.sin_cos();
        if girth < floor {
            (self.keel + girth * cos, girth * sin)
        } else if bilge > 0.0 && girth <= floor + bilge {
            let angle = self.deadrise + (girth - floor) / self.radius;
            let (y, z) = self.bilge_centre();
            // 1 - cos by the half angle: exact where the bilge leaves a flat bottom.
            let low = z - self.radius;
            (y + self.radius * angle.sin(), low + 2.0 * self.radius * (0.5 * angle).sin().powi(2))
        } else {
            (self.half_breadth, self.bilge_centre().1 + (girth - floor - bilge))
        }
    }

    /// Girth at which the section reaches height `z`.
    pub(super) fn girth_at(&self, z: f64) -> f64 {
        let (floor, bilge) = self.girths();
        let (_, start) = self.floor_end();
        let (_, centre) = self.bilge_centre();
        if z <= start && self.deadrise > 0.0 {
            z / self.deadrise.sin()
        } else if z < centre {
            let cos = ((centre - z) / self.radius).clamp(-1.0, 1.0);
            (floor + self.radius * (cos.acos() - self.deadrise)).clamp(floor, floor + bilge)
        } else {
            floor + bilge + (z - centre)
        }
    }

    /// b(z), one side.
    pub(super) fn breadth_at(&self, z: f64) -> f64 {
        self.at_girth(self.girth_at(z)).0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::gauss_legendre;

    fn area(section: &MidshipSection, draught: f64) -> f64 {
        let (floor, bilge) = section.girths();
        let rule = gauss_legendre(32);
        let flat = 1e-7;
        let mut sum = 0.0;
        for (a, b) in [(0.0, floor), (floor, floor + bilge), (floor + bilge, section.girth_at(draught))] {
            for (s, w) in rule.on(a, b) {
                let slope = (section.at_girth(s + flat).1 - section.at_girth(s - flat).1) / (2.0 * flat);
                sum += w * section.at_girth(s).0 * slope;
            }
        }
        sum
    }

    #[test]
    fn sections_have_their_coefficient() {
        for (h, t, cm) in
            [(16.125, 12.2, 0.99), (16.1, 10.8, 0.98), (9.53, 6.15, 0.8), (3.43, 2.5, 0.8), (2.0, 0.8, 0.7)]
        {
            let section = MidshipSection::solve(h, t, 0.0, cm, None, None).unwrap();
            assert!((area(&section, t) / (h * t) - cm).abs() < 1e-6, "{section:?} {}", area(&section, t) / (h * t));
            let (y, z) = section.floor_end();
            assert!(y >= -1e-12 && z >= -1e-12 && section.bilge_centre().1 <= t + 1e-9);
            for k in 0..100 {
                let z = t * f64::from(k) / 100.0;
                assert!((section.at_girth(section.girth_at(z)).1 - z).abs() < 1e-12);
                assert!((section.breadth_at(z + 1e-3)) >= section.breadth_at(z));
            }
        }
    }

    #[test]
    fn a_given_radius_or_rise_is_kept() {
        let section = MidshipSection::solve(10.0, 6.0, 0.5, 0.93, None, Some(2.0)).unwrap();
        assert!((section.radius - 2.0).abs() < 1e-15);
        assert!((area(&section, 6.0) / 60.0 - 0.93).abs() < 1e-6);
        let section = MidshipSection::solve(10.0, 6.0, 0.5, 0.93, Some(0.05), None).unwrap();
        assert!((section.deadrise - 0.05).abs() < 1e-15);
        assert!((area(&section, 6.0) / 60.0 - 0.93).abs() < 1e-6);
    }

    #[test]
    fn what_does_not_fit_says_why() {
        assert!(matches!(
            MidshipSection::solve(9.53, 6.15, 0.0, 0.8, Some(0.0), None),
            Err(MidshipProblem::Bilge { .. })
        ));
        assert!(matches!(
            MidshipSection::solve(9.53, 6.15, 0.0, 0.95, Some(0.3), None),
            Err(MidshipProblem::Floor { .. })
        ));
        assert!(matches!(
            MidshipSection::solve(9.53, 6.15, 0.0, 0.99, None, Some(5.0)),
            Err(MidshipProblem::Coefficient { .. })
        ));
        assert!(MidshipSection::smallest_coefficient(9.53, 6.15, 0.0) < 0.8);
    }
}
