//! The chart of a level hull by few numbers: parameters in which half-breadths are smooth.
//!
//! ```text
//! x = x0 + L h(u),  h = (1-c0) u (1-u)^2 + u^2 (3 - 2u) - (1-c1) u^2 (1-u),   h'(0) = 1-c0, h'(1) = 1-c1
//! z = z0 + H ((1-b) v^2 + b v)
//! ```
//!
//! With b = 0 sections leave the bottom like y ~ sqrt(z) (flat bottoms), with b = 1 straight (V keels). With c = 1
//! waterlines end like the square root of the distance from the end (round ends), with c = 0 straight. Both are
//! polynomials: a spline net of degree 3 and more holds them exactly.

use crate::numeric::bracketed_root;

/// Numbers of a chart besides its rectangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// b: slope of z over v at the lower edge, over H; in \[0, 1\].
    pub keel: f64,
    /// c at the aft and at the forward end, in \[0, 1).
    pub ends: [f64; 2],
}

/// x(u) and z(v) over the unit square.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chart {
    /// x of the aft and of the forward edge \[m\].
    pub length: [f64; 2],
    /// z of the lower and of the upper edge \[m\].
    pub height: [f64; 2],
    /// What bends it.
    pub shape: Shape,
}

impl Chart {
    /// x at u \[m\].
    #[must_use]
    pub fn x(&self, u: f64) -> f64 {
        let [from, to] = self.length;
        from + (to - from) * self.along(u)
    }

    /// z at v \[m\].
    #[must_use]
    pub fn z(&self, v: f64) -> f64 {
        let ([from, to], b) = (self.height, self.shape.keel);
        from + (to - from) * v * (b + (1.0 - b) * v)
    }

    /// dx/du \[m\].
    #[must_use]
    pub fn x_slope(&self, u: f64) -> f64 {
        let [c0, c1] = self.shape.ends;
        let w = 1.0 - u;
        let slope = (1.0 - c0) * w * (w - 2.0 * u) + 6.0 * u * w - (1.0 - c1) * u * (2.0 * w - u);
        (self.length[1] - self.length[0]) * slope
    }

    /// dz/dv \[m\].
    #[must_use]
    pub fn z_slope(&self, v: f64) -> f64 {
        let b = self.shape.keel;
        (self.height[1] - self.height[0]) * (b + 2.0 * (1.0 - b) * v)
    }

    fn along(&self, u: f64) -> f64 {
        let [c0, c1] = self.shape.ends;
        let w = 1.0 - u;
        (1.0 - c0) * u * w * w + u * u * (3.0 - 2.0 * u) - (1.0 - c1) * u * u * w
    }

    /// u at x, to rounding; places outside are taken to the nearest edge.
    #[must_use]
    pub fn u(&self, x: f64) -> f64 {
        let [from, to] = self.length;
        let part = ((x - from) / (to - from)).clamp(0.0, 1.0);
        if part <= 0.0 || part >= 1.0 {
            return part;
        }
        bracketed_root(|u| self.along(u) - part, 0.0, 1.0, 1e-15).unwrap_or(part)
    }

    /// v at z, to rounding; places outside are taken to the nearest edge.
    #[must_use]
    pub fn v(&self, z: f64) -> f64 {
        let ([from, to], b) = (self.height, self.shape.keel);
        let part = ((z - from) / (to - from)).clamp(0.0, 1.0);
        let root = (b * b + 4.0 * (1.0 - b) * part).sqrt();
        if part > 0.0 { (2.0 * part / (b + root)).min(1.0) } else { 0.0 }
    }
}
