//! The part of the volume between a knot line in u and the midship plane, at each of many draughts.
//!
//! The volume aft of midship is that aft of a knot line u_0 near midship, which the pass over the surface gives, and 2
//! int z_v int_(u_0)^(u_m(v)) y x_u du dv with x(u_m(v), v) = L_PP / 2. The inner integral is exact span by span, the
//! outer one an expansion along the station at midship, exact to rounding.

use super::piece::StationSpan;
use super::station::Stations;
use crate::hull::{Hull, Immersion};
use crate::numeric::gauss_legendre;
use crate::spline::MAX_DEGREE;

/// The volume between the start of the span `span` in u and x = `midship` (negative when midship is aft of it), both
/// sides, below each immersion; none where the deck is immersed.
pub(super) fn volumes_to_midship<const N: usize>(
    stations: &Stations<N>,
    immersions: &[Option<Immersion>],
    midship: f64,
    span: usize,
) -> Vec<Option<f64>> {
    let hull = stations.hull;
    let (knots, spans_v) = (hull.surface().u(), hull.surface().v().spans());
    let start = knots.knots()[span];
    let pieces = stations.pieces(midship, f64::INFINITY);
    let mut at = (f64::NAN, 0.0);
    let expansion = stations.expansion(&pieces, true, midship.abs() * stations.size, |piece, node| {
        let u = match piece.place {
            StationSpan::Aft => knots.domain().0,
            StationSpan::Fore => knots.domain().1,
            StationSpan::Inside(_) => {
                if at.0.to_bits() != piece.from.to_bits() {
                    at = (piece.from, piece.start);
                }
                stations.point(midship, piece, node, &mut at.1).u
            }
        };
        let (from, to, sign) = if u >= start { (start, u, 1.0) } else { (u, start, -1.0) };
        [2.0 * sign * node.rise * along(hull, &node.value, spans_v[piece.across], from, to)]
    });
    immersions
        .iter()
        .map(|immersion| {
            let immersion = immersion.as_ref().filter(|immersion| !immersion.deck_immersed())?;
            Some(expansion.up_to(immersion.waterline())[0])
        })
        .collect()
}

/// int y x_u du from `from` to `to` on the line with basis functions `across` in v.
fn along(hull: &Hull, across: &[f64], span_v: usize, from: f64, to: f64) -> f64 {
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
            for (b, point) in across.iter().zip(points) {
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
