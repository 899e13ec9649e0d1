//! The part of the volume between a knot line in u and the midship plane, at each of many draughts.
//!
//! The volume aft of midship is that aft of a knot line u_0 near midship, which the pass over the surface gives, and
//! 2 int z_v int_(u_0)^(u_m(v)) y x_u du dv with x(u_m(v), v) = L_PP / 2. The inner integral is exact span by span. The outer one
//! is cut at the knots in v and where midship crosses a knot line in u; in between the integrand is analytic, and a
//! polynomial where the lines in u are vertical. Next to a profile v = a + (b - a) t^2 (3 - 2t) takes out the square root.

use crate::hull::{Hull, Immersion, crossings, is_slanting};
use crate::numeric::gauss_legendre;
use crate::spline::MAX_DEGREE;

/// Nodes a piece where the integrand is no polynomial.
const NODES: usize = 16;

/// A piece in v between cuts.
struct Piece {
    from: f64,
    to: f64,
    span: usize,
    /// Whether x depends on v there.
    slanting: bool,
}

/// The volume between the start of the span `span` in u and x = `midship` (negative when midship is aft of it), both sides,
/// below each immersion; none where the deck is immersed.
pub(super) fn volumes_to_midship(
    hull: &Hull,
    immersions: &[Option<Immersion>],
    midship: f64,
    span: usize,
) -> Vec<Option<f64>> {
    let start = hull.surface().u().knots()[span];
    let pieces = pieces(hull, midship);
    // Sums up to the end of each piece.
    let mut sum = 0.0;
    let below: Vec<f64> = pieces
        .iter()
        .map(|piece| {
            sum += slice(hull, midship, start, piece, piece.to);
            sum
        })
        .collect();
    immersions
        .iter()
        .map(|immersion| {
            let immersion = immersion.as_ref()?;
            if immersion.deck_immersed() {
                return None;
            }
            let end = immersion.waterline();
            let whole = pieces.iter().take_while(|piece| piece.to <= end).count();
            let rest = pieces.get(whole).filter(|piece| piece.from < end);
            let rest = rest.map_or(0.0, |piece| slice(hull, midship, start, piece, end));
            Some(if whole > 0 { below[whole - 1] } else { 0.0 } + rest)
        })
        .collect()
}

fn pieces(hull: &Hull, midship: f64) -> Vec<Piece> {
    let surface = hull.surface();
    let cuts = crossings(hull, midship, f64::INFINITY);
    let mut pieces = Vec::new();
    for span in surface.v().spans() {
        let (low, high) = (surface.v().knots()[span], surface.v().knots()[span + 1]);
        let mut from = low;
        for to in cuts.iter().copied().filter(|&v| v > low && v < high).chain([high]) {
            if to - from <= 4.0 * f64::EPSILON * (high - low) && to < high {
                continue;
            }
            let u = hull.length_parameter(midship, 0.5 * (from + to));
            let slanting = u.is_none_or(|u| is_slanting(hull, surface.u().find_span(u), span));
            pieces.push(Piece { from, to, span, slanting });
            from = to;
        }
    }
    pieces
}

/// The integral over a piece up to `end`.
fn slice(hull: &Hull, midship: f64, start: f64, piece: &Piece, end: f64) -> f64 {
    let surface = hull.surface();
    let (knots, q) = (surface.v(), surface.v().degree());
    let heights = &hull.heights().points()[piece.span - q..=piece.span];
    let width = end - piece.from;
    let count = if piece.slanting { NODES } else { (3 * q).div_ceil(2) };
    let mut known = None;
    let mut sum = 0.0;
    for (t, weight) in gauss_legendre(count).on(0.0, 1.0) {
        let (place, stretch) = if piece.slanting { (t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t)) } else { (t, 1.0) };
        let v = piece.from + width * place;
        let [across, slopes] = knots.basis_derivatives::<2>(piece.span, v);
        let rise: f64 = slopes.iter().zip(heights).map(|(b, h)| b * h[0]).sum();
        let u = match known {
            Some(u) if !piece.slanting => u,
            _ => passage(hull, midship, v),
        };
        known = Some(u);
        let (from, to, sign) = if u >= start { (start, u, 1.0) } else { (u, start, -1.0) };
        sum += 2.0 * weight * width * stretch * rise * sign * along(hull, &across, piece.span, from, to);
    }
    sum
}

/// The u at which a waterline passes midship; the nearer end of one that does not.
fn passage(hull: &Hull, midship: f64, v: f64) -> f64 {
    let domain = hull.surface().u().domain();
    let stern = hull.surface().eval(domain.0, v)[0];
    hull.length_parameter(midship, v).unwrap_or(if stern > midship { domain.0 } else { domain.1 })
}

/// int y x_u du from `from` to `to` on the line with basis functions `across` in v.
fn along(hull: &Hull, across: &[f64; MAX_DEGREE + 1], span_v: usize, from: f64, to: f64) -> f64 {
    let surface = hull.surface();
    let (knots, p, q, columns) = (surface.u(), surface.u().degree(), surface.v().degree(), surface.shape()[1]);
    let mut sum = 0.0;
    for span in knots.find_span(from)..=knots.find_span(to) {
        let (low, high) = (knots.knots()[span].max(from), knots.knots()[span + 1].min(to));
        if high <= low {
            continue;
        }
        let mut line = [[0.0; 2]; MAX_DEGREE + 1];
        for (i, at) in line.iter_mut().enumerate().take(p + 1) {
            let points = &surface.points()[(span - p + i) * columns + span_v - q..];
            for (b, point) in across[..=q].iter().zip(points) {
                at[0] += b * point[0];
                at[1] += b * point[1];
            }
        }
        for (u, weight) in gauss_legendre(p).on(low, high) {
            let [value, slope] = knots.basis_derivatives::<2>(span, u);
            let y: f64 = value.iter().zip(&line).map(|(b, c)| b * c[1]).sum();
            let stretch: f64 = slope.iter().zip(&line).map(|(b, c)| b * c[0]).sum();
            sum += weight * y * stretch;
        }
    }
    sum
}
