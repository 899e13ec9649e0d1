//! The basis functions of one span, with derivatives (de Boor 2001, chapter IX; Piegl & Tiller 1997, 2.3).
//!
//! Values follow the triangle N_{i,j} = (t - t_i) / (t_{i+j} - t_i) N_{i,j-1} + (t_{i+j+1} - t) / (t_{i+j+1} - t_{i+1})
//! N_{i+1,j-1} upward from the one function of degree 0. A derivative of order m starts m rows lower and climbs with
//! N'_{i,j} = j (N_{i,j-1} / (t_{i+j} - t_i) - N_{i+1,j-1} / (t_{i+j+1} - t_{i+1})). The reciprocals are precomputed.

/// One value for each basis function of a span; those beyond the degree are 0.
pub(super) type BasisValues = [f64; MAX_DEGREE + 1];

/// As [`BasisValues`] for any degree.
pub(super) type WideValues = [f64; HIGHEST_DEGREE + 1];

/// `result[order][function]` for orders 0 to N - 1 of the K = p + 1 functions k - p ..= k at `t` in span k.
///
/// `window` holds the knots k + 1 - p ..= k + p, `reciprocals` those of [`super::table::SpanTable`].
#[inline(always)]
pub(super) fn basis_orders<const K: usize, const N: usize>(
    window: &[f64],
    reciprocals: &[f64],
    t: f64,
) -> [[f64; K]; N] {
    let p = K - 1;
    let window = &window[..2 * p];
    let reciprocals = &reciprocals[..p * K / 2];
    let mut triangle = [[0.0; K]; K];
    triangle[0][0] = 1.0;
    for j in 1..K {
        let mut saved = 0.0;
        for r in 0..j {
            let term = triangle[j - 1][r] * reciprocals[j * (j - 1) / 2 + r];
            triangle[j][r] = saved + (window[p + r] - t) * term;
            saved = (t - window[p + r - j]) * term;
        }
        triangle[j][j] = saved;
    }
    let mut result = [[0.0; K]; N];
    for (m, row) in result.iter_mut().enumerate().take(K) {
        *row = triangle[p - m];
        for j in K - m..K {
            let mut saved = 0.0;
            for r in 0..j {
                let term = row[r] * (reciprocals[j * (j - 1) / 2 + r] * j as f64);
                row[r] = saved - term;
                saved = term;
            }
            row[j] = saved;
        }
    }
    result
}

/// As [`basis_orders`], in rows of length W.
pub(super) fn padded_orders<const K: usize, const N: usize, const W: usize>(
    window: &[f64],
    reciprocals: &[f64],
    t: f64,
) -> [[f64; W]; N] {
    let mut result = [[0.0; W]; N];
    for (row, values) in result.iter_mut().zip(&basis_orders::<K, N>(window, reciprocals, t)) {
        row[..K].copy_from_slice(values);
    }
    result
}

/// Coefficients of the control points k - p ..= k in the polar form (blossom) of the polynomial of span k, at `arguments`
/// (Ramshaw 1989). `knots` need not be clamped; the span must have positive length.
///
/// When the arguments are successive knots of a refinement, and knot k is the last one of the old knots that is not above
/// the knot before them, this is a row of the Oslo algorithm (Cohen, Lyche & Riesenfeld 1980): no coefficient is negative
/// and they sum to 1.
pub(super) fn blossom_row(knots: &[f64], span: usize, arguments: &[f64]) -> WideValues {
    let mut values = [0.0; HIGHEST_DEGREE + 1];
    values[0] = 1.0;
    for (j, t) in arguments.iter().enumerate().map(|(j, t)| (j + 1, t)) {
        let mut saved = 0.0;
        for r in 0..j {
            let (right, left) = (knots[span + r + 1], knots[span + 1 + r - j]);
            let term = values[r] / (right - left);
            values[r] = saved + (right - t) * term;
            saved = (t - left) * term;
        }
        values[j] = saved;
    }
    values
}

/// The highest degree of a spline whose bases are asked for: of nets of hulls, of fits.
pub const MAX_DEGREE: usize = 7;

/// The highest degree of a spline that is evaluated, cut and clamped, as CAD files have them.
pub const HIGHEST_DEGREE: usize = 15;
