//! The analytic hull of the cosh family: profiles, vertical laws, waterlines and their integrals.

use crate::numeric::gauss_legendre;
use crate::parametric::kernel::{HIGHEST_FULLNESS, Kernel, LOWEST_FULLNESS, Shape};
use crate::parametric::midship::MidshipSection;

/// Stem profile: x = Lpp + (z - T) tan(rake) above the design waterline; below it, with s = (T - z) / T,
/// x = Lpp - r s - (f - r) s^3, r = T tan(rake), so that it ends at Lpp - f on the keel with continuous curvature at T.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stem {
    pub(super) length: f64,
    pub(super) draught: f64,
    pub(super) rake: f64,
    pub(super) forefoot: f64,
}

impl Stem {
    pub(super) fn at(&self, z: f64) -> f64 {
        let slope = self.rake.tan();
        if z >= self.draught {
            self.length + (z - self.draught) * slope
        } else {
            let (s, r) = (1.0 - z / self.draught, self.draught * slope);
            self.length - r * s - (self.forefoot - r) * s.powi(3)
        }
    }
}

/// Stern profile. The waterlines of the run end on x_v(z) = c - (c - x_0) q(z / z_0), which rises from the cut-up (c,
/// 0) through (x_0, z_0), with q(s) = (1 - w) s + w s^2 for w in [0, 1] and (2 - w) s^2 + (w - 1) s^3 for w in [1, 2].
/// With a transom, (x_0, z_0) is its lowest point and the plane x = x_0 cuts the hull off, so that the surface passes
/// through the edge of the transom without a crease; without one (x_0, z_0) is the aft perpendicular at the design
/// waterline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stern {
    pub(super) cut_up: f64,
    pub(super) end: f64,
    pub(super) height: f64,
    pub(super) sweep: f64,
    pub(super) transom: bool,
}

impl Stern {
    /// Largest sweep w.
    pub(super) const LARGEST_SWEEP: f64 = 2.0;

    /// x_v(z), the end of the waterline were it not cut off.
    pub(super) fn virtual_end(&self, z: f64) -> f64 {
        let (s, w) = (z / self.height, self.sweep);
        let q = if w <= 1.0 { (1.0 - w) * s + w * s * s } else { (2.0 - w) * s * s + (w - 1.0) * s * s * s };
        self.cut_up - (self.cut_up - self.end) * q
    }

    /// The stern profile.
    pub(super) fn at(&self, z: f64) -> f64 {
        let end = self.virtual_end(z);
        if self.transom { end.max(self.end) } else { end }
    }
}

/// Fullness over height: phi = keel + (waterline - keel) H(z/T), H(s) = (1 - exp(-c s)) / (1 - exp(-c)) up to the
/// design waterline. Above it, with d = s - 1, H = 1 + H'(1) (a (1 - exp(-k d)) / k + b d exp(-k d)), k = max(2, c),
/// b = c/k - 1, a = 1 - b: continuous curvature, rising, bounded. `flare` adds (1 - phi) flare ((z - T) / (D - T))^3
/// there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Law {
    pub(super) keel: f64,
    pub(super) waterline: f64,
    pub(super) character: f64,
    pub(super) flare: f64,
}

impl Law {
    fn at(&self, z: f64, draught: f64, depth: f64) -> f64 {
        let (s, c) = (z / draught, self.character);
        let straight = c.abs() < 1e-9;
        let h = if s > 1.0 {
            let slope = if straight { 1.0 } else { c / c.exp_m1() };
            let (d, k) = (s - 1.0, c.max(2.0));
            let b = c / k - 1.0;
            1.0 + slope * ((1.0 - b) * -(-k * d).exp_m1() / k + b * d * (-k * d).exp())
        } else if straight {
            s
        } else {
            (-c * s).exp_m1() / (-c).exp_m1()
        };
        let mut phi = self.keel + (self.waterline - self.keel) * h;
        if s > 1.0 && self.flare > 0.0 {
            phi += (1.0 - phi) * self.flare * ((z - draught) / (depth - draught)).min(1.5).powi(3);
        }
        phi.clamp(LOWEST_FULLNESS, HIGHEST_FULLNESS)
    }
}

/// Every number of the analytic hull \[m, rad\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Form {
    pub(super) length: f64,
    pub(super) draught: f64,
    pub(super) depth: f64,
    pub(super) section: MidshipSection,
    pub(super) stem: Stem,
    pub(super) stern: Stern,
    /// Fore end of the run, aft end of the parallel body.
    pub(super) aft_shoulder: f64,
    /// Aft end of the entrance.
    pub(super) fore_shoulder: f64,
    pub(super) entrance: Law,
    pub(super) run: Law,
    /// Exponent m of the soft section of the ends, 0 for none.
    pub(super) softness: f64,
}

/// One waterline: the blended kernels of both ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Waterline {
    breadth: f64,
    soft: f64,
    aft_shoulder: f64,
    fore_shoulder: f64,
    stem: f64,
    virtual_stern: f64,
    stern: f64,
    entrance: Blend,
    run: Blend,
}

/// al J + (1 - al) S, both of one fullness.
#[derive(Debug, Clone, Copy)]
struct Blend {
    j: Shape,
    s: Shape,
    part: f64,
}

impl Blend {
    fn value(&self, t: f64) -> f64 {
        let mut sum = 0.0;
        if self.part > 0.0 {
            sum += self.part * self.j.value(t);
        }
        if self.part < 1.0 {
            sum += (1.0 - self.part) * self.s.value(t);
        }
        sum
    }

    fn fall(&self, t: f64) -> f64 {
        self.part * self.j.fall(t) + (1.0 - self.part) * self.s.fall(t)
    }

    fn moments(&self, t: f64) -> (f64, f64) {
        let (mut area, mut moment) = (0.0, 0.0);
        for (part, shape) in [(self.part, &self.j), (1.0 - self.part, &self.s)] {
            if part > 0.0 {
                let (a, m) = shape.moments(t);
                area += part * a;
                moment += part * m;
            }
        }
        (area, moment)
    }
}

impl Waterline {
    /// Half-breadth at `x`: f (b f + s (1 - f)), which increases with f, b and s while s <= 2 b.
    pub(super) fn half_breadth(&self, x: f64) -> f64 {
        let f = self.fraction(x);
        f * (self.breadth + (self.soft - self.breadth) * (1.0 - f))
    }

    /// Area and first moment about x = 0 of (s - b) f (1 - f), what the soft section adds.
    fn softening(&self) -> (f64, f64) {
        let (mut area, mut moment) = (0.0, 0.0);
        for (from, to) in [(self.stern, self.aft_shoulder), (self.fore_shoulder, self.stem)] {
            for (x, weight) in gauss_legendre(12).on(from, to) {
                let f = self.fraction(x);
                let y = weight * (self.soft - self.breadth) * f * (1.0 - f);
                area += y;
                moment += y * x;
            }
        }
        (area, moment)
    }

    /// f at `x`.
    fn fraction(&self, x: f64) -> f64 {
        if x > self.fore_shoulder {
            self.entrance.value((x - self.fore_shoulder) / (self.stem - self.fore_shoulder))
        } else if x < self.aft_shoulder {
            self.run.value((self.aft_shoulder - x) / (self.aft_shoulder - self.virtual_stern))
        } else {
            1.0
        }
    }

    /// Area and first moment about x = 0 of y / b.
    pub(super) fn integrals(&self) -> (f64, f64) {
        let length = self.stem - self.fore_shoulder;
        let (a, m) = self.entrance.moments(1.0);
        let (mut area, mut moment) = (length * a, self.fore_shoulder * length * a + length * length * m);
        let middle = self.fore_shoulder - self.aft_shoulder;
        area += middle;
        moment += 0.5 * middle * (self.fore_shoulder + self.aft_shoulder);
        let length = self.aft_shoulder - self.virtual_stern;
        let (a, m) = self.run.moments((self.aft_shoulder - self.stern) / length);
        (area + length * a, moment + self.aft_shoulder * length * a - length * length * m)
    }

    /// -d(y/b)/dx at the stem.
    pub(super) fn entrance_slope(&self) -> f64 {
        self.entrance.fall(1.0) / (self.stem - self.fore_shoulder)
    }
}

/// Volume and first moment below the design waterline, waterplane area and first moment there; both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Integrals {
    pub(super) volume: f64,
    pub(super) volume_moment: f64,
    pub(super) waterplane: f64,
    pub(super) waterplane_moment: f64,
}

/// A node of the quadrature over height: z, weight of dz, the same times b.
#[derive(Debug, Clone, Copy)]
pub(super) struct HeightNode {
    z: f64,
    rise: f64,
    weight: f64,
}

impl Form {
    /// The waterline at height `z`.
    pub(super) fn waterline(&self, z: f64) -> Waterline {
        let (phi_e, phi_r) = (self.entrance.at(z, self.draught, self.depth), self.run.at(z, self.draught, self.depth));
        let (stem, virtual_stern) = (self.stem.at(z), self.stern.virtual_end(z));
        let parallel = self.fore_shoulder > self.aft_shoulder;
        let blend = |phi| {
            let s = Shape::of_fullness(Kernel::S, phi);
            Blend { j: if parallel { s } else { Shape::of_fullness(Kernel::J, phi) }, s, part: 0.0 }
        };
        let (mut entrance, mut run) = (blend(phi_e), blend(phi_r));
        if !parallel {
            // No parallel body: the curvatures of both ends at the largest section are made equal.
            let fore = entrance.j.shoulder_curvature() / (stem - self.fore_shoulder).powi(2);
            let aft = run.j.shoulder_curvature() / (self.aft_shoulder - virtual_stern).powi(2);
            entrance.part = aft / (fore + aft);
            run.part = fore / (fore + aft);
        }
        let breadth = self.section.breadth_at(z);
        Waterline {
            breadth,
            soft: self.soft_breadth(z, breadth),
            aft_shoulder: self.aft_shoulder,
            fore_shoulder: self.fore_shoulder,
            stem,
            virtual_stern,
            stern: self.stern.at(z),
            entrance,
            run,
        }
    }

    /// The soft section s(z) = k + (B/2 - k) (1 - (1 - z/T)^m), of the area of the midship section, without its tangent
    /// lines.
    fn soft_breadth(&self, z: f64, breadth: f64) -> f64 {
        if self.softness <= 0.0 || z >= self.draught {
            return breadth;
        }
        let keel = self.section.keel;
        keel + (self.section.half_breadth - keel) * (1.0 - (1.0 - z / self.draught).powf(self.softness))
    }

    /// The exponent of the soft section for a midship section of coefficient `coefficient`; 0 where the floor is flat
    /// (the bilge then is what the ends have too) or where the section would not stay below twice the midship section.
    pub(super) fn soften(&mut self, coefficient: f64) {
        let (half, keel) = (self.section.half_breadth, self.section.keel);
        let part = (coefficient * half - keel) / (half - keel);
        let exponent = part / (1.0 - part);
        if self.section.deadrise <= 0.0 || exponent < 2.5 {
            return;
        }
        self.softness = exponent;
        let holds = (1..200).all(|k| {
            let z = self.draught * f64::from(k) / 200.0;
            let breadth = self.section.breadth_at(z);
            self.soft_breadth(z, breadth) <= 2.0 * breadth
        });
        if !holds {
            self.softness = 0.0;
        }
    }

    /// Volume and first moment below the design waterline that the soft section adds to [`Form::integrals`], both
    /// sides. (It adds nothing at the design waterline.)
    pub(super) fn softening(&self, nodes: &[HeightNode]) -> (f64, f64) {
        let (mut volume, mut moment) = (0.0, 0.0);
        for node in nodes {
            let (area, first) = self.waterline(node.z).softening();
            volume += 2.0 * node.rise * area;
            moment += 2.0 * node.rise * first;
        }
        (volume, moment)
    }

    /// Nodes of a quadrature (error 1e-7, which the correction of the net takes up) over the height from keel to design
    /// waterline, split where the section or the stern has a corner; along the girth, where b(z) is smooth.
    pub(super) fn height_nodes(&self) -> Vec<HeightNode> {
        let (floor, bilge) = self.section.girths();
        let top = self.section.girth_at(self.draught);
        let mut ends = vec![0.0, floor, (floor + bilge).min(top), top];
        if self.stern.transom && self.stern.height < self.draught {
            ends.push(self.section.girth_at(self.stern.height));
        }
        ends.sort_by(f64::total_cmp);
        ends.dedup_by(|a, b| *a - *b < 1e-9 * top);
        let mut nodes = Vec::new();
        for pair in ends.windows(2) {
            for (girth, weight) in gauss_legendre(6).on(pair[0], pair[1]) {
                let (y, z) = self.section.at_girth(girth);
                let slope = if girth < floor {
                    self.section.deadrise.sin()
                } else if girth < floor + bilge {
                    (self.section.deadrise + (girth - floor) / self.section.radius).sin()
                } else {
                    1.0
                };
                nodes.push(HeightNode { z, rise: weight * slope, weight: weight * slope * y });
            }
        }
        nodes
    }

    /// The integrals over the immersed body.
    pub(super) fn integrals(&self, nodes: &[HeightNode]) -> Integrals {
        let (mut volume, mut volume_moment) = (0.0, 0.0);
        for node in nodes {
            let (area, moment) = self.waterline(node.z).integrals();
            volume += 2.0 * node.weight * area;
            volume_moment += 2.0 * node.weight * moment;
        }
        let (area, moment) = self.waterline(self.draught).integrals();
        let breadth = 2.0 * self.section.breadth_at(self.draught);
        Integrals { volume, volume_moment, waterplane: breadth * area, waterplane_moment: breadth * moment }
    }

    /// Half angle of entrance of the design waterline \[rad\].
    pub(super) fn half_entrance(&self) -> f64 {
        (self.section.breadth_at(self.draught) * self.waterline(self.draught).entrance_slope()).atan()
    }

    /// Half-breadth \[m\].
    pub(super) fn half_breadth(&self, x: f64, z: f64) -> f64 {
        self.waterline(z).half_breadth(x)
    }
}
