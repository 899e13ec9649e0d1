//! Curvature of curves and surfaces (do Carmo 1976, chapters 1 and 3; Farin 2002, chapter 19).
//!
//! Signs: a planar curve that turns to the left has positive curvature. The normal of a surface is that of S_u x S_v,
//! and a normal curvature is positive where the surface bends towards the normal: with the normal outward, a sphere of
//! radius R has the principal and mean curvature -1/R and the Gaussian curvature 1/R^2.

use super::curve::BsplineCurve;
use super::jet::SurfaceJet;
use super::vector::{cross, dot};

/// Curvatures of a surface at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceCurvature {
    /// Unit vector along S_u x S_v.
    pub normal: [f64; 3],
    /// Principal curvatures, the greater first \[1/length\].
    pub principal: [f64; 2],
    /// H, the mean of the principal curvatures \[1/length\].
    pub mean: f64,
    /// K, the product of the principal curvatures \[1/length^2\].
    pub gaussian: f64,
}

impl BsplineCurve<2> {
    /// Signed curvature (x' y'' - y' x'') / |C'|^3 at `t` \[1/length\], positive where the curve turns to the left;
    /// none where the curve stands still.
    #[must_use]
    pub fn curvature(&self, t: f64) -> Option<f64> {
        let [_, first, second] = self.derivatives::<3>(t);
        let speed = first[0].hypot(first[1]);
        (speed > 0.0).then(|| (first[0] * second[1] - first[1] * second[0]) / speed.powi(3))
    }
}

impl BsplineCurve<3> {
    /// Curvature |C' x C''| / |C'|^3 at `t` \[1/length\], never negative; none where the curve stands still.
    #[must_use]
    pub fn curvature(&self, t: f64) -> Option<f64> {
        let [_, first, second] = self.derivatives::<3>(t);
        let speed = dot(first, first).sqrt();
        let turn = cross(first, second);
        (speed > 0.0).then(|| dot(turn, turn).sqrt() / speed.powi(3))
    }
}

impl SurfaceJet<3> {
    /// The curvatures; none at a degenerate point, where |S_u x S_v| is at most 1e-14 of |S_u|^2 + |S_v|^2.
    #[must_use]
    pub fn curvature(&self) -> Option<SurfaceCurvature> {
        let along = cross(self.du, self.dv);
        let area = dot(along, along).sqrt();
        if area <= 1e-14 * (dot(self.du, self.du) + dot(self.dv, self.dv)) || area.is_nan() {
            return None;
        }
        let normal = along.map(|c| c / area);
        // S_u = a e_1 and S_v = b e_1 + c e_2 with e_1, e_2 orthonormal in the tangent plane: the second fundamental
        // form in that frame is the symmetric matrix of the shape operator, whose eigenvalues lose no digits at
        // umbilics.
        let a = dot(self.du, self.du).sqrt();
        let (b, c) = (dot(self.du, self.dv) / a, area / a);
        let [l, m, n] = [self.duu, self.duv, self.dvv].map(|d| dot(d, normal));
        let ratio = b / a;
        let s11 = l / (a * a);
        let s12 = (m - ratio * l) / (a * c);
        let s22 = (n - 2.0 * ratio * m + ratio * ratio * l) / (c * c);
        let mean = 0.5 * (s11 + s22);
        let radius = (0.5 * (s11 - s22)).hypot(s12);
        Some(SurfaceCurvature {
            normal,
            principal: [mean + radius, mean - radius],
            mean,
            gaussian: s11 * s22 - s12 * s12,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spline::KnotVector;

    fn jet(point: [f64; 3], du: [f64; 3], dv: [f64; 3], duu: [f64; 3], duv: [f64; 3], dvv: [f64; 3]) -> SurfaceJet<3> {
        SurfaceJet { point, du, dv, duu, duv, dvv }
    }

    #[test]
    fn a_parabola_turns_left() {
        // y = x^2 over [0, 1]: curvature 2 / (1 + 4 x^2)^(3/2).
        let points = vec![[0.0, 0.0], [0.5, 0.0], [1.0, 1.0]];
        let c = BsplineCurve::new(KnotVector::uniform(2, 1).unwrap(), points).unwrap();
        for x in [0.0f64, 0.3, 1.0] {
            let exact = 2.0 / (1.0 + 4.0 * x * x).powf(1.5);
            assert!((c.curvature(x).unwrap() - exact).abs() < 1e-14);
            assert!((c.reversed().curvature(1.0 - x).unwrap() + exact).abs() < 1e-14);
        }
    }

    #[test]
    fn a_twisted_cubic() {
        // (t, t^2, t^3): curvature 2 sqrt(9 t^4 + 9 t^2 + 1) / (9 t^4 + 4 t^2 + 1)^(3/2).
        let points = vec![[0.0; 3], [1.0 / 3.0, 0.0, 0.0], [2.0 / 3.0, 1.0 / 3.0, 0.0], [1.0; 3]];
        let c = BsplineCurve::new(KnotVector::uniform(3, 1).unwrap(), points).unwrap();
        for t in [0.0f64, 0.4, 1.0] {
            let (s, q) = (t * t, t.powi(4));
            let exact = 2.0 * (9.0 * q + 9.0 * s + 1.0).sqrt() / (9.0 * q + 4.0 * s + 1.0).powf(1.5);
            assert!((c.curvature(t).unwrap() - exact).abs() < 1e-14);
        }
    }

    /// Torus of radii 3 and 1 (do Carmo 1976, 3-3 example 5): K = cos u / (r (R + r cos u)), outward normal.
    #[test]
    fn a_torus_in_skew_parameters() {
        let (big, small) = (3.0f64, 1.0f64);
        for (u, v) in [(0.0f64, 0.2f64), (1.0, 0.7), (2.5, 4.0), (std::f64::consts::PI, 1.0)] {
            let w = big + small * u.cos();
            let [r, t] = [[v.cos(), v.sin(), 0.0], [-v.sin(), v.cos(), 0.0]];
            let mix = |x: f64, y: f64, z: f64| [x * r[0] + y * t[0], x * r[1] + y * t[1], z];
            let point = mix(w, 0.0, small * u.sin());
            let (fu, fv) = (mix(-small * u.sin(), 0.0, small * u.cos()), mix(0.0, w, 0.0));
            let (fuu, fuv) = (mix(-small * u.cos(), 0.0, -small * u.sin()), mix(0.0, -small * u.sin(), 0.0));
            let fvv = mix(-w, 0.0, 0.0);
            // Parameters p = v + u / 2, q = u: a skew net; S_p = S_v, S_q = S_u - S_v / 2.
            let lin = |x: f64, a: &[f64; 3], y: f64, b: &[f64; 3]| -> [f64; 3] {
                std::array::from_fn(|d| x * a[d] + y * b[d])
            };
            let dqq = lin(1.0, &lin(1.0, &fuu, -1.0, &fuv), 0.25, &fvv);
            let k = jet(point, fv, lin(1.0, &fu, -0.5, &fv), fvv, lin(1.0, &fuv, -0.5, &fvv), dqq).curvature().unwrap();
            let around = u.cos() / w;
            assert!((k.gaussian - around / small).abs() < 1e-14, "{k:?}");
            assert!((k.mean + 0.5 * (around + 1.0 / small)).abs() < 1e-14, "{k:?}");
            assert!((k.principal[0] + around).abs() < 1e-14 && (k.principal[1] + 1.0 / small).abs() < 1e-14);
            let outward = mix(u.cos(), 0.0, u.sin());
            assert!((dot(k.normal, outward) - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn degenerate_points_have_no_curvature() {
        let (x, y) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        assert!(jet([0.0; 3], x, [0.0; 3], y, y, y).curvature().is_none());
        assert!(jet([0.0; 3], x, x, y, y, y).curvature().is_none());
        let still = BsplineCurve::new(KnotVector::uniform(1, 1).unwrap(), vec![[1.0, 1.0]; 2]).unwrap();
        assert!(still.curvature(0.5).is_none());
    }
}
