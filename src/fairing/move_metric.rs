//! What a move of the whole hull costs: its mean square and its bending.
//!
//! ```text
//! d'Q d = (n / A) int int (d / s)^2 dx dz + n b int int d_uu^2 + 2 d_uv^2 + d_vv^2 du dv
//! ```
//!
//! Here d is the move of the half-breadth, s the factor of its errors, A the area int int 1 / s^2 dx dz of the
//! centreplane, n the number of offsets, u and v the parameters of the chart from 0 to 1. A move alike everywhere costs what
//! it costs at the offsets. A move that bends bends lines that were nearly straight. Without the second term S-175 with LCB
//! 0.6 % of L further forward has 63 changes of sign for the 53 of its table, a Series 60 43 for 43; with it 40 and 27.
//! Any b from 1e-4 to 1e-2 does.

use super::cells::add_square;
use crate::numeric::{SymmetricBand, gauss_legendre};
use crate::spline::{BsplineSurface, KnotVector, basis_row};

/// Nodes of the rule in each direction of a cell.
const NODES: usize = 3;

/// Weight b of the bending of a move.
const BENDING: f64 = 1e-3;

/// The matrix Q of a net for so many offsets; `scale` is the factor of errors at (x, z).
pub(super) fn move_metric(surface: &BsplineSurface<3>, count: usize, scale: impl Fn(f64, f64) -> f64) -> SymmetricBand {
    let [rows, columns] = surface.shape();
    let degrees = [surface.u().degree().min(rows - 1), surface.v().degree().min(columns - 1)];
    let none = SymmetricBand::zeros(rows * columns, degrees[0] * columns + degrees[1]);
    let (mut square, mut bending) = (none.clone(), none.clone());
    let rule = gauss_legendre(NODES);
    let nodes = |knots: &KnotVector| -> Vec<(f64, f64)> {
        knots.breakpoints().windows(2).flat_map(|span| rule.on(span[0], span[1])).collect()
    };
    let sides = [surface.u(), surface.v()].map(|knots| knots.domain().1 - knots.domain().0);
    let (ahead, above) = (nodes(surface.u()), nodes(surface.v()));
    let mut area = 0.0;
    for &(u, share) in &ahead {
        for &(v, weight) in &above {
            let [[point, by_v], [by_u, _]] = surface.derivatives::<2>(u, v);
            let s = scale(point[0], point[2]);
            let measure = share * weight * (by_u[0] * by_v[2] - by_u[2] * by_v[0]).abs() / (s * s);
            area += measure;
            add_square(&mut square, measure, &basis_row(surface, [u, v], [0, 0]));
            for (orders, times) in [([2, 0], 1.0), ([1, 1], 2.0), ([0, 2], 1.0)] {
                let unit = [0, 1].map(|k| sides[k].powi(2 * orders[k] as i32 - 1));
                let measure = times * share * weight * unit[0] * unit[1];
                add_square(&mut bending, measure, &basis_row(surface, [u, v], orders));
            }
        }
    }
    let count = count as f64;
    none.plus(if area > 0.0 { count / area } else { 0.0 }, &square).plus(BENDING * count, &bending)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_move_alike_everywhere_costs_what_it_costs_at_the_offsets() {
        let knots = [KnotVector::uniform(5, 4).unwrap(), KnotVector::uniform(3, 3).unwrap()];
        let at = |knots: &KnotVector| knots.greville();
        let (us, vs) = (at(&knots[0]), at(&knots[1]));
        let points = us.iter().flat_map(|u| vs.iter().map(move |v| [10.0 * u, 0.0, 2.0 * v])).collect();
        let surface = BsplineSurface::new(knots[0].clone(), knots[1].clone(), points).unwrap();
        let cost = |move_of: &dyn Fn(f64, f64) -> f64, scale: f64| -> f64 {
            let net: Vec<f64> =
                us.iter().flat_map(|&u| vs.iter().map(move |&v| (u, v))).map(|(u, v)| move_of(u, v)).collect();
            let product = move_metric(&surface, 7, |_, _| scale).apply(&net);
            product.iter().zip(&net).map(|(a, b)| a * b).sum()
        };
        assert!((cost(&|_, _| 0.1, 1.0) - 0.07).abs() < 1e-14);
        assert!((cost(&|_, _| 0.1, 3.0) - 0.07).abs() < 1e-14);
        // The mean of u^2 is 1/3, and of (u v)^2 it is 1/9; u v is twisted by 1.
        assert!((cost(&|u, _| u, 1.0) - 7.0 / 3.0).abs() < 1e-13);
        let bent = 7.0 * (1.0 / 9.0 + 2.0 * BENDING);
        assert!((cost(&|u, v| u * v, 1.0) - bent).abs() < 1e-13);
    }
}
