//! Evaluation of surfaces: anywhere, and on grids of parameters.
//!
//! Nothing is allocated for a point. The work for a point is two bases and a (p + 1) x (q + 1) net; a grid computes the
//! bases once a line and collapses the net once a line u = constant, after which a point costs O(q).

use super::basis::Row;
use super::knots::MAX_DEGREE;
use super::surface::BsplineSurface;

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

/// Point and first partial derivatives of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceTangents<const D: usize> {
    /// S
    pub point: [f64; D],
    /// S_u
    pub du: [f64; D],
    /// S_v
    pub dv: [f64; D],
}

/// Calls the given method for equal degrees with the degree as a constant, and its last argument otherwise.
macro_rules! by_degree {
    ($surface:expr, $fixed:ident, $arguments:tt, $other:expr) => {{
        let (p, q) = ($surface.u().degree(), $surface.v().degree());
        match p {
            _ if p != q => $other,
            1 => by_degree!(@call $surface, $fixed, 1, $arguments),
            2 => by_degree!(@call $surface, $fixed, 2, $arguments),
            3 => by_degree!(@call $surface, $fixed, 3, $arguments),
            4 => by_degree!(@call $surface, $fixed, 4, $arguments),
            5 => by_degree!(@call $surface, $fixed, 5, $arguments),
            6 => by_degree!(@call $surface, $fixed, 6, $arguments),
            _ => by_degree!(@call $surface, $fixed, 7, $arguments),
        }
    }};
    (@call $surface:expr, $fixed:ident, $degree:literal, ($($argument:expr),*)) => {
        $surface.$fixed::<$degree>($($argument),*)
    };
}

impl<const D: usize> BsplineSurface<D> {
    /// The point at (u, v).
    #[must_use]
    pub fn eval(&self, u: f64, v: f64) -> [f64; D] {
        self.derivatives::<1>(u, v)[0][0]
    }

    /// `result[a][b]` is the derivative of order a in u and b in v, 0 to N - 1 each, in one call; nothing is allocated.
    #[must_use]
    pub fn derivatives<const N: usize>(&self, u: f64, v: f64) -> [[[f64; D]; N]; N] {
        let ((first_u, basis_u), (first_v, basis_v)) = (self.u().orders_at::<N>(u), self.v().orders_at::<N>(v));
        let columns = self.v().basis_count();
        let mut result = [[[0.0; D]; N]; N];
        for i in 0..=self.u().degree() {
            let start = (first_u + i) * columns + first_v;
            let row = &self.points()[start..=start + self.v().degree()];
            let mut across = [[0.0; D]; N];
            for (j, point) in row.iter().enumerate() {
                for (sum, order) in across.iter_mut().zip(&basis_v) {
                    add(sum, order[j], point);
                }
            }
            for (line, order) in result.iter_mut().zip(&basis_u) {
                for (sum, value) in line.iter_mut().zip(&across) {
                    add(sum, order[i], value);
                }
            }
        }
        result
    }

    /// Point, first and second derivatives at (u, v); nothing is allocated.
    #[must_use]
    pub fn jet(&self, u: f64, v: f64) -> SurfaceJet<D> {
        by_degree!(self, jet_fixed, (u, v), {
            let d = self.derivatives::<3>(u, v);
            SurfaceJet { point: d[0][0], du: d[1][0], dv: d[0][1], duu: d[2][0], duv: d[1][1], dvv: d[0][2] }
        })
    }

    /// Point and first derivatives at (u, v); nothing is allocated.
    #[must_use]
    pub fn tangents(&self, u: f64, v: f64) -> SurfaceTangents<D> {
        by_degree!(self, tangents_fixed, (u, v), {
            let d = self.derivatives::<2>(u, v);
            SurfaceTangents { point: d[0][0], du: d[1][0], dv: d[0][1] }
        })
    }

    fn jet_fixed<const P: usize>(&self, u: f64, v: f64) -> SurfaceJet<D> {
        let (first_u, basis_u) = self.u().orders_at_fixed::<P, 3>(u);
        let (first_v, basis_v) = self.v().orders_at_fixed::<P, 3>(v);
        let strips = basis_u.map(|order| self.strip::<P>(first_u, first_v, &order));
        let at = |a: usize, b: usize| combine::<P, D>(&basis_v[b], &strips[a]);
        SurfaceJet { point: at(0, 0), du: at(1, 0), dv: at(0, 1), duu: at(2, 0), duv: at(1, 1), dvv: at(0, 2) }
    }

    fn tangents_fixed<const P: usize>(&self, u: f64, v: f64) -> SurfaceTangents<D> {
        let (first_u, basis_u) = self.u().orders_at_fixed::<P, 2>(u);
        let (first_v, basis_v) = self.v().orders_at_fixed::<P, 2>(v);
        let strips = basis_u.map(|order| self.strip::<P>(first_u, first_v, &order));
        let at = |a: usize, b: usize| combine::<P, D>(&basis_v[b], &strips[a]);
        SurfaceTangents { point: at(0, 0), du: at(1, 0), dv: at(0, 1) }
    }

    /// Calls `visit(i, j, jet)` for every pair of parameters (`us[i]`, `vs[j]`), `i` slowest. Storage for the bases in v
    /// and for one collapsed line of the net is allocated once a call.
    pub fn grid_jets(&self, us: &[f64], vs: &[f64], visit: impl FnMut(usize, usize, &SurfaceJet<D>)) {
        match self.v().degree() {
            1 => self.grid_fixed::<1>(us, vs, visit),
            2 => self.grid_fixed::<2>(us, vs, visit),
            3 => self.grid_fixed::<3>(us, vs, visit),
            4 => self.grid_fixed::<4>(us, vs, visit),
            5 => self.grid_fixed::<5>(us, vs, visit),
            6 => self.grid_fixed::<6>(us, vs, visit),
            _ => self.grid_fixed::<7>(us, vs, visit),
        }
    }

    fn grid_fixed<const Q: usize>(&self, us: &[f64], vs: &[f64], mut visit: impl FnMut(usize, usize, &SurfaceJet<D>)) {
        let columns = self.v().basis_count();
        let bases: Vec<(usize, [Row; 3])> = vs.iter().map(|&v| self.v().orders_at::<3>(v)).collect();
        // The net summed in u with the weights of the value, the first and the second derivative.
        let mut line = vec![[[0.0; D]; 3]; columns];
        for (i, &u) in us.iter().enumerate() {
            let (first, basis) = self.u().orders_at::<3>(u);
            line.fill([[0.0; D]; 3]);
            for (k, row) in self.points().chunks_exact(columns).skip(first).take(self.u().degree() + 1).enumerate() {
                for (sums, point) in line.iter_mut().zip(row) {
                    for (sum, order) in sums.iter_mut().zip(&basis) {
                        add(sum, order[k], point);
                    }
                }
            }
            for (j, (first, basis)) in bases.iter().enumerate() {
                let strip = &line[*first..][..Q + 1];
                let (mut values, mut slopes, mut bends) = ([[0.0; D]; 3], [[0.0; D]; 2], [0.0; D]);
                for k in 0..=Q {
                    for d in 0..D {
                        for a in 0..3 {
                            values[a][d] += basis[0][k] * strip[k][a][d];
                        }
                        for a in 0..2 {
                            slopes[a][d] += basis[1][k] * strip[k][a][d];
                        }
                        bends[d] += basis[2][k] * strip[k][0][d];
                    }
                }
                let [point, du, duu] = values;
                let [dv, duv] = slopes;
                visit(i, j, &SurfaceJet { point, du, dv, duu, duv, dvv: bends });
            }
        }
    }

    /// The (P + 1) x (P + 1) net at (`first_u`, `first_v`), weighted and summed in u.
    #[inline(always)]
    fn strip<const P: usize>(&self, first_u: usize, first_v: usize, weights: &Row) -> [[f64; D]; MAX_DEGREE + 1] {
        let columns = self.v().basis_count();
        let mut strip = [[0.0; D]; MAX_DEGREE + 1];
        for i in 0..=P {
            let row = &self.points()[(first_u + i) * columns + first_v..][..P + 1];
            for j in 0..=P {
                for d in 0..D {
                    strip[j][d] += weights[i] * row[j][d];
                }
            }
        }
        strip
    }
}

/// The sum of the first P + 1 points with their weights.
#[inline(always)]
fn combine<const P: usize, const D: usize>(weights: &Row, points: &[[f64; D]; MAX_DEGREE + 1]) -> [f64; D] {
    let mut sum = [0.0; D];
    for j in 0..=P {
        for d in 0..D {
            sum[d] += weights[j] * points[j][d];
        }
    }
    sum
}

#[inline(always)]
fn add<const D: usize>(sum: &mut [f64; D], weight: f64, point: &[f64; D]) {
    for (s, c) in sum.iter_mut().zip(point) {
        *s += weight * c;
    }
}
