//! Evaluation of surfaces: anywhere, and on grids of parameters.
//!
//! The work for a point is two bases and a (p + 1) x (q + 1) net, and nothing is allocated for it. A bicubic surface is
//! put into powers of the parameters, span by span, when its second derivatives are first asked for; after that a point
//! needs no bases. A grid computes the bases once a line and collapses the net once a line u = constant, after which a
//! point costs O(q).

use super::basis::MAX_DEGREE;
use super::jet::{SurfaceJet, add};
use super::surface::BsplineSurface;

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

/// Calls the given method for equal degrees with the order as a constant, and its last argument otherwise.
macro_rules! by_degree {
    ($surface:expr, $fixed:ident, $arguments:tt, $other:expr) => {{
        let (p, q) = ($surface.u().degree(), $surface.v().degree());
        match p {
            _ if p != q || p > MAX_DEGREE => $other,
            1 => by_degree!(@call $surface, $fixed, 2, $arguments),
            2 => by_degree!(@call $surface, $fixed, 3, $arguments),
            3 => by_degree!(@call $surface, $fixed, 4, $arguments),
            4 => by_degree!(@call $surface, $fixed, 5, $arguments),
            5 => by_degree!(@call $surface, $fixed, 6, $arguments),
            6 => by_degree!(@call $surface, $fixed, 7, $arguments),
            _ => by_degree!(@call $surface, $fixed, 8, $arguments),
        }
    }};
    (@call $surface:expr, $fixed:ident, $order:literal, ($($argument:expr),*)) => {
        $surface.$fixed::<$order>($($argument),*)
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
        if self.u().degree().max(self.v().degree()) > MAX_DEGREE {
            return self.combined(self.u().wide_orders_at::<N>(u), self.v().wide_orders_at::<N>(v));
        }
        self.combined(self.u().orders_at::<N>(u), self.v().orders_at::<N>(v))
    }

    /// The sums of the net from each first index on with the weights of each order.
    #[inline(always)]
    fn combined<const N: usize, const W: usize>(
        &self,
        (first_u, basis_u): (usize, [[f64; W]; N]),
        (first_v, basis_v): (usize, [[f64; W]; N]),
    ) -> [[[f64; D]; N]; N] {
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

    /// Point, first and second derivatives at (u, v). The first call for a bicubic surface allocates 16 points for each
    /// pair of spans and makes their polynomials; no other call allocates. For a few points of a
    /// surface that is then thrown away [`Self::derivatives`] is the cheaper way.
    #[must_use]
    #[inline]
    pub fn jet(&self, u: f64, v: f64) -> SurfaceJet<D> {
        if self.u().degree() == 3 && self.v().degree() == 3 {
            return self.powers().jet(self.parts(), u, v);
        }
        by_degree!(self, jet_fixed, (u, v), {
            let d = self.derivatives::<3>(u, v);
            SurfaceJet { point: d[0][0], du: d[1][0], dv: d[0][1], duu: d[2][0], duv: d[1][1], dvv: d[0][2] }
        })
    }

    /// The point at (u, v) as [`Self::jet`] has it: for many points of a bicubic surface, whose polynomials the first
    /// call makes.
    #[must_use]
    #[inline]
    pub fn point_of_many(&self, u: f64, v: f64) -> [f64; D] {
        if self.u().degree() == 3 && self.v().degree() == 3 {
            return self.powers().point(self.parts(), u, v);
        }
        by_degree!(self, point_fixed, (u, v), { self.eval(u, v) })
    }

    #[inline(never)]
    fn point_fixed<const K: usize>(&self, u: f64, v: f64) -> [f64; D] {
        let (first_u, basis_u) = self.u().orders_at_fixed::<K, 1>(u);
        let (first_v, basis_v) = self.v().orders_at_fixed::<K, 1>(v);
        combine(&basis_v[0], &self.strips::<K, 1>(first_u, first_v, &basis_u)[0])
    }

    /// Point and first derivatives at (u, v); nothing is allocated.
    #[must_use]
    #[inline]
    pub fn tangents(&self, u: f64, v: f64) -> SurfaceTangents<D> {
        by_degree!(self, tangents_fixed, (u, v), {
            let d = self.derivatives::<2>(u, v);
            SurfaceTangents { point: d[0][0], du: d[1][0], dv: d[0][1] }
        })
    }

    #[inline(never)]
    fn jet_fixed<const K: usize>(&self, u: f64, v: f64) -> SurfaceJet<D> {
        let (first_u, basis_u) = self.u().orders_at_fixed::<K, 3>(u);
        let (first_v, basis_v) = self.v().orders_at_fixed::<K, 3>(v);
        let strips = self.strips::<K, 3>(first_u, first_v, &basis_u);
        SurfaceJet {
            point: combine(&basis_v[0], &strips[0]),
            du: combine(&basis_v[0], &strips[1]),
            dv: combine(&basis_v[1], &strips[0]),
            duu: combine(&basis_v[0], &strips[2]),
            duv: combine(&basis_v[1], &strips[1]),
            dvv: combine(&basis_v[2], &strips[0]),
        }
    }

    /// The K x K net at (`first_u`, `first_v`), summed in u with N sets of weights.
    #[inline(always)]
    fn strips<const K: usize, const N: usize>(
        &self,
        first_u: usize,
        first_v: usize,
        weights: &[[f64; K]; N],
    ) -> [[[f64; D]; K]; N] {
        let columns = self.v().basis_count();
        let start = first_u * columns + first_v;
        let rows: [&[[f64; D]]; K] = std::array::from_fn(|i| &self.points()[start + i * columns..][..K]);
        let mut strips = [[[0.0; D]; K]; N];
        for j in 0..K {
            for l in 0..D {
                for o in 0..N {
                    let mut sum = weights[o][0] * rows[0][j][l];
                    for i in 1..K {
                        sum += weights[o][i] * rows[i][j][l];
                    }
                    strips[o][j][l] = sum;
                }
            }
        }
        strips
    }

    #[inline(never)]
    fn tangents_fixed<const K: usize>(&self, u: f64, v: f64) -> SurfaceTangents<D> {
        let (first_u, basis_u) = self.u().orders_at_fixed::<K, 2>(u);
        let (first_v, basis_v) = self.v().orders_at_fixed::<K, 2>(v);
        let strips = self.strips::<K, 2>(first_u, first_v, &basis_u);
        SurfaceTangents {
            point: combine(&basis_v[0], &strips[0]),
            du: combine(&basis_v[0], &strips[1]),
            dv: combine(&basis_v[1], &strips[0]),
        }
    }

    /// Calls `visit(i, j, jet)` for every pair of parameters (`us[i]`, `vs[j]`), `i` slowest. Storage for the bases in v
    /// and for one collapsed line of the net is allocated once a call.
    pub fn grid_jets(&self, us: &[f64], vs: &[f64], visit: impl FnMut(usize, usize, &SurfaceJet<D>)) {
        match self.v().degree() {
            1 => self.grid_fixed::<2>(us, vs, visit),
            2 => self.grid_fixed::<3>(us, vs, visit),
            3 => self.grid_fixed::<4>(us, vs, visit),
            4 => self.grid_fixed::<5>(us, vs, visit),
            5 => self.grid_fixed::<6>(us, vs, visit),
            6 => self.grid_fixed::<7>(us, vs, visit),
            7 => self.grid_fixed::<8>(us, vs, visit),
            8 => self.grid_fixed::<9>(us, vs, visit),
            9 => self.grid_fixed::<10>(us, vs, visit),
            10 => self.grid_fixed::<11>(us, vs, visit),
            11 => self.grid_fixed::<12>(us, vs, visit),
            12 => self.grid_fixed::<13>(us, vs, visit),
            13 => self.grid_fixed::<14>(us, vs, visit),
            14 => self.grid_fixed::<15>(us, vs, visit),
            _ => self.grid_fixed::<16>(us, vs, visit),
        }
    }

    fn grid_fixed<const K: usize>(&self, us: &[f64], vs: &[f64], mut visit: impl FnMut(usize, usize, &SurfaceJet<D>)) {
        let columns = self.v().basis_count();
        let bases: Vec<(usize, [[f64; K]; 3])> = vs.iter().map(|&v| self.v().orders_at_fixed::<K, 3>(v)).collect();
        // The net summed in u with the weights of the value, the first and the second derivative.
        let mut line = vec![[[0.0; D]; 3]; columns];
        for (i, &u) in us.iter().enumerate() {
            let (first, basis) = self.u().wide_orders_at::<3>(u);
            line.fill([[0.0; D]; 3]);
            for (k, row) in self.points().chunks_exact(columns).skip(first).take(self.u().degree() + 1).enumerate() {
                for (sums, point) in line.iter_mut().zip(row) {
                    for (sum, order) in sums.iter_mut().zip(&basis) {
                        add(sum, order[k], point);
                    }
                }
            }
            for (j, (first, basis)) in bases.iter().enumerate() {
                let strip = &line[*first..][..K];
                let (mut values, mut slopes, mut bends) = ([[0.0; D]; 3], [[0.0; D]; 2], [0.0; D]);
                for k in 0..K {
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
}

/// The weighted sum of points.
#[inline(always)]
fn combine<const K: usize, const L: usize>(weights: &[f64; K], points: &[[f64; L]; K]) -> [f64; L] {
    let mut sum = [0.0; L];
    for j in 0..K {
        for l in 0..L {
            let term = weights[j] * points[j][l];
            sum[l] = if j == 0 { term } else { sum[l] + term };
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spline::KnotVector;
    use crate::spline::tests::{bicubic, parameters, surface};
    use proptest::prelude::*;

    fn close<const D: usize>(a: &SurfaceJet<D>, d: &[[[f64; D]; 3]; 3]) -> bool {
        let pairs = [
            (a.point, d[0][0]),
            (a.du, d[1][0]),
            (a.dv, d[0][1]),
            (a.duu, d[2][0]),
            (a.duv, d[1][1]),
            (a.dvv, d[0][2]),
        ];
        let size = d.iter().flatten().flatten().fold(1.0f64, |m, x| m.max(x.abs()));
        pairs.iter().all(|(x, y)| (0..D).all(|k| (x[k] - y[k]).abs() <= 1e-13 * size))
    }

    fn fast_ways_agree<const D: usize>(s: &BsplineSurface<D>) -> Result<(), TestCaseError> {
        let (mut us, vs) = (parameters(s.u()), parameters(s.v()));
        us.push(s.u().domain().1 + 1.0);
        for &u in &us {
            for &v in &vs {
                let exact = s.derivatives::<3>(u, v);
                prop_assert!(close(&s.jet(u, v), &exact), "{:?} {:?}", s.jet(u, v), exact);
                let t = s.tangents(u, v);
                let jet = SurfaceJet { point: t.point, du: t.du, dv: t.dv, ..s.jet(u, v) };
                prop_assert!(close(&jet, &exact));
                let jet = SurfaceJet { point: s.point_of_many(u, v), ..jet };
                prop_assert!(close(&jet, &exact));
            }
        }
        let mut visited = 0;
        let mut wrong = 0;
        s.grid_jets(&us, &vs, |i, j, jet| {
            visited += 1;
            wrong += usize::from(!close(jet, &s.derivatives::<3>(us[i], vs[j])));
        });
        prop_assert_eq!((visited, wrong), (us.len() * vs.len(), 0));
        Ok(())
    }

    proptest! {
        #[test]
        fn fast_ways_agree_with_the_general_one(a in surface::<3>(7), b in surface::<2>(4), c in surface::<1>(3)) {
            fast_ways_agree(&a)?;
            fast_ways_agree(&b)?;
            fast_ways_agree(&c)?;
        }

        #[test]
        fn fast_ways_agree_for_cubics(a in bicubic::<3>(), b in bicubic::<1>()) {
            fast_ways_agree(&a)?;
            fast_ways_agree(&b)?;
            // Copies are equal, evaluated or not, and give the same numbers.
            let fresh = BsplineSurface::new(a.u().clone(), a.v().clone(), a.points().to_vec()).unwrap();
            prop_assert_eq!(&fresh, &a);
            let (u, v) = (0.3 * a.u().domain().0 + 0.7 * a.u().domain().1, a.v().domain().1);
            prop_assert_eq!(a.clone().jet(u, v), a.jet(u, v));
            prop_assert_eq!(fresh.jet(u, v), a.jet(u, v));
        }

        #[test]
        fn derivatives_are_the_slopes_of_those_below(s in surface::<3>(5)) {
            let middle = |w: &[f64]| (0.6 * w[0] + 0.4 * w[1], w[1] - w[0]);
            let ((u, du), (v, dv)) = (middle(&s.u().breakpoints()), middle(&s.v().breakpoints()));
            let (hu, hv) = (1e-5 * du, 1e-5 * dv);
            let d = s.derivatives::<4>(u, v);
            let (lower, upper) = (s.derivatives::<4>(u - hu, v), s.derivatives::<4>(u + hu, v));
            let (before, after) = (s.derivatives::<4>(u, v - hv), s.derivatives::<4>(u, v + hv));
            let size = d.iter().flatten().flatten().fold(1.0f64, |m, x| m.max(x.abs()));
            let limit = 1e-6 * size / du.min(dv).min(1.0);
            for (a, b, k) in (0..3).flat_map(|a| (0..3).flat_map(move |b| (0..3).map(move |k| (a, b, k)))) {
                prop_assert!(((upper[a][b][k] - lower[a][b][k]) / (2.0 * hu) - d[a + 1][b][k]).abs() <= limit);
                prop_assert!(((after[a][b][k] - before[a][b][k]) / (2.0 * hv) - d[a][b + 1][k]).abs() <= limit);
            }
        }
    }

    #[test]
    fn the_corners_are_control_points_exactly() {
        let knots = || KnotVector::from_breakpoints(3, &[0.0, 0.3, 0.7, 1.9], &[1, 2]).unwrap();
        let points: Vec<[f64; 3]> =
            (0..49).map(|k| [f64::from(k), 0.1 * f64::from(k * k), 1.0 / f64::from(k + 3)]).collect();
        let s = BsplineSurface::new(knots(), knots(), points).unwrap();
        for (u, v, i, j) in [(0.0, 0.0, 0, 0), (0.0, 1.9, 0, 6), (1.9, 0.0, 6, 0), (1.9, 1.9, 6, 6)] {
            let exact = s.point(i, j).map(f64::to_bits);
            assert_eq!(s.jet(u, v).point.map(f64::to_bits), exact);
            assert_eq!(s.tangents(u, v).point.map(f64::to_bits), exact);
        }
    }
}
