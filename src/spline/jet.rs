//! Point and derivatives of a surface.

/// Point and partial derivatives up to the second order of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceJet<const D: usize> {
    /// S
    pub point: [f64; D],
    /// S_u
    pub du: [f64; D],
    /// S_v
    pub dv: [f64; D],
    /// S_uu
    pub duu: [f64; D],
    /// S_uv
    pub duv: [f64; D],
    /// S_vv
    pub dvv: [f64; D],
}

#[inline(always)]
pub(super) fn add<const D: usize>(sum: &mut [f64; D], weight: f64, point: &[f64; D]) {
    for (s, c) in sum.iter_mut().zip(point) {
        *s += weight * c;
    }
}
