//! Rows and energies over the net of a tensor-product surface, points numbered as they are stored.

use super::gram::Gram;
use super::knots::KnotVector;
use super::surface::BsplineSurface;
use crate::numeric::SymmetricBand;

/// Basis values of the derivative of order (a, b) at (u, v) over the net, each with the index of its point.
#[must_use]
pub fn basis_row<const D: usize>(
    surface: &BsplineSurface<D>,
    [u, v]: [f64; 2],
    [a, b]: [usize; 2],
) -> Vec<(usize, f64)> {
    let (span_u, span_v) = (surface.u().find_span(u), surface.v().find_span(v));
    let (p, q) = (surface.u().degree(), surface.v().degree());
    let rows = surface.u().basis_derivatives::<5>(span_u, u)[a];
    let columns = surface.v().basis_derivatives::<5>(span_v, v)[b];
    let count = surface.v().basis_count();
    let mut row = Vec::with_capacity((p + 1) * (q + 1));
    for (i, along) in rows[..=p].iter().enumerate() {
        for (j, across) in columns[..=q].iter().enumerate() {
            row.push(((span_u - p + i) * count + span_v - q + j, along * across));
        }
    }
    row
}

/// Binomial coefficient C(n, k).
#[must_use]
pub fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64)
}

/// The energy of a scalar net over the unit square, whatever the domains of its knots: c'E c = sum_a C(n, a) w_u^(n-a)
/// w_v^a int int (d^n y / du^(n-a) dv^a)^2 du dv with n = `order`, w_u = `anisotropy` and w_v = 1/w_u; exact, and
/// nothing is charged across knots where the surface is broken.
#[must_use]
pub fn energy(u: &KnotVector, v: &KnotVector, order: usize, anisotropy: f64) -> SymmetricBand {
    let (rows, columns) = (u.basis_count(), v.basis_count());
    let (p, q) = (u.degree().min(rows - 1), v.degree().min(columns - 1));
    let mut energy = SymmetricBand::zeros(rows * columns, p * columns + q);
    // d^k/dt^k over [0, 1] is length^k times that over the domain, and dt = length * d(unit).
    let scaled = |knots: &KnotVector, k: usize| {
        let (from, to) = knots.domain();
        (Gram::new(knots, knots, [k, k]), (to - from).powi(2 * k as i32 - 1))
    };
    for a in 0..=order {
        let ((along, by_u), (across, by_v)) = (scaled(u, order - a), scaled(v, a));
        let weight = binomial(order, a) * anisotropy.powi((order - a) as i32 - a as i32) * by_u * by_v;
        add_product(&mut energy, [&along, &across], weight, [u, v]);
    }
    energy
}

/// Adds factor times the product of two Gram matrices, one over the rows and one over the columns of a net, to a band
/// over the net.
pub fn add_product(sum: &mut SymmetricBand, [along, across]: [&Gram; 2], factor: f64, [u, v]: [&KnotVector; 2]) {
    let (rows, columns) = (u.basis_count(), v.basis_count());
    let (p, q) = (u.degree().min(rows - 1), v.degree().min(columns - 1));
    for i in 0..rows {
        for k in i.saturating_sub(p)..=i {
            let g = factor * along.get(i, k);
            if g == 0.0 {
                continue;
            }
            for j in 0..columns {
                let last = if k == i { j } else { (j + q).min(columns - 1) };
                for l in j.saturating_sub(q)..=last {
                    let h = across.get(j, l);
                    if h != 0.0 {
                        sum.add(i * columns + j, k * columns + l, g * h);
                    }
                }
            }
        }
    }
}
