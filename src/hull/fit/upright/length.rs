//! The direction along the hull: x(u), the sites of the stations, and interpolation across them.
//!
//! x(u) = x_a + L g(u) with g one polynomial over the whole length, so that it lies in every cubic spline space exactly:
//! g = u where both ends are sharp or cut off; u (2 - u) where the fore end is blunt, u^2 where the aft end is,
//! 3 u^2 - 2 u^3 where both are. At a blunt end y ~ sqrt(distance) then is smooth in u.
//!
//! Across the stations every line and every column of the net is the cubic spline with the "not a knot" end conditions
//! (de Boor 2001, IV), of fourth order; where a line jumps (skeg, bulb) the spline is interrupted: the stations on both
//! sides of the jump are p-fold knots and the piece between them is straight. All of them lie in one space with a knot
//! at every station.

use crate::spline::{BsplineCurve, Collocation, KnotVector, SplineError};

/// Degree in u and v.
pub(super) const DEGREE: usize = 3;

/// Which ends are blunt.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::hull::fit) struct Blunt {
    pub(in crate::hull::fit) aft: bool,
    pub(in crate::hull::fit) fore: bool,
}

/// x(u) and the parameters of the stations.
#[derive(Debug, Clone)]
pub(in crate::hull::fit) struct Length {
    /// u of each station; from 0 to 1.
    pub(in crate::hull::fit) sites: Vec<f64>,
    /// Powers of u in x(u).
    powers: [f64; 4],
}

impl Length {
    /// For stations at the rising positions `x`.
    pub(in crate::hull::fit) fn new(x: &[f64], blunt: Blunt) -> Self {
        let (from, length) = (x[0], x[x.len() - 1] - x[0]);
        let powers = match (blunt.aft, blunt.fore) {
            (false, false) => [0.0, 1.0, 0.0, 0.0],
            (false, true) => [0.0, 2.0, -1.0, 0.0],
            (true, false) => [0.0, 0.0, 1.0, 0.0],
            (true, true) => [0.0, 0.0, 3.0, -2.0],
        };
        let inverse = |g: f64| match (blunt.aft, blunt.fore) {
            (false, false) => g,
            (false, true) => g / (1.0 + (1.0 - g).max(0.0).sqrt()),
            (true, false) => g.sqrt(),
            // 3 u^2 - 2 u^3 = g by the sine of three angles.
            (true, true) => 0.5 - ((1.0 - 2.0 * g).clamp(-1.0, 1.0).asin() / 3.0).sin(),
        };
        let last = x.len() - 1;
        let sites = x
            .iter()
            .enumerate()
            .map(|(k, &x)| match k {
                0 => 0.0,
                k if k == last => 1.0,
                _ => inverse(((x - from) / length).clamp(0.0, 1.0)),
            })
            .collect();
        let mut powers = powers.map(|a| a * length);
        powers[0] = from;
        Self { sites, powers }
    }

    /// The space of all lines and columns: a knot at every station, p-fold at the `breaks`.
    pub(super) fn knots(&self, breaks: &[usize]) -> Result<KnotVector, SplineError> {
        let inner = 1..self.sites.len() - 1;
        let times: Vec<usize> = inner.map(|k| if breaks.contains(&k) { DEGREE } else { 1 }).collect();
        KnotVector::from_breakpoints(DEGREE, &self.sites, &times)
    }

    /// The control values of x(u) over `knots`, exactly: blossoms of the powers (Ramshaw 1989).
    pub(in crate::hull::fit) fn control_lengths(&self, knots: &KnotVector) -> Vec<f64> {
        let [c0, c1, c2, c3] = self.powers;
        (0..knots.basis_count())
            .map(|i| {
                let t = &knots.knots()[i + 1..=i + 3];
                let (a, b, c) = (t[0], t[1], t[2]);
                c0 + c1 * (a + b + c) / 3.0 + c2 * (a * b + b * c + c * a) / 3.0 + c3 * a * b * c
            })
            .collect()
    }

    /// Interpolation at the stations, interrupted at `breaks`, with control values over the space with `all` breaks.
    pub(super) fn interpolation(&self, breaks: &[usize], all: &[usize]) -> Result<Across, SplineError> {
        let last = self.sites.len() - 1;
        let mut ends: Vec<usize> = breaks.iter().copied().filter(|k| (1..last).contains(k)).collect();
        ends.extend([0, last]);
        ends.sort_unstable();
        ends.dedup();
        let pieces = ends.windows(2).map(|w| Piece::new(&self.sites, w[0], w[1], all)).collect::<Result<_, _>>()?;
        Ok(Across { pieces })
    }
}

/// Interpolation across the stations.
#[derive(Debug, Clone)]
pub(super) struct Across {
    pieces: Vec<Piece>,
}

#[derive(Debug, Clone)]
struct Piece {
    first: usize,
    last: usize,
    knots: KnotVector,
    collocation: Collocation,
    inserted: Vec<f64>,
}

impl Piece {
    fn new(sites: &[f64], first: usize, last: usize, all: &[usize]) -> Result<Self, SplineError> {
        let own = &sites[first..=last];
        let degree = DEGREE.min(last - first);
        let mut breakpoints = vec![own[0]];
        if degree == DEGREE && own.len() > 4 {
            breakpoints.extend(&own[2..own.len() - 2]);
        }
        breakpoints.push(own[own.len() - 1]);
        let knots = KnotVector::from_breakpoints(degree, &breakpoints, &vec![1; breakpoints.len() - 2])?;
        let collocation = Collocation::new(&knots, own)?;
        let mut inserted = Vec::new();
        for (k, &site) in sites.iter().enumerate().take(last).skip(first + 1) {
            let wanted = if all.contains(&k) { DEGREE } else { 1 };
            let has = knots.multiplicity(site);
            inserted.extend(std::iter::repeat_n(site, wanted - has.min(wanted)));
        }
        Ok(Self { first, last, knots, collocation, inserted })
    }

    fn control(&self, values: &[f64]) -> Result<Vec<f64>, SplineError> {
        let mut values = values[self.first..=self.last].to_vec();
        self.collocation.solve(&mut values);
        let curve = BsplineCurve::new(self.knots.clone(), values.into_iter().map(|value| [value]).collect())?;
        let curve = curve.elevate(DEGREE - self.knots.degree())?.insert_knots(&self.inserted)?;
        Ok(curve.points().iter().map(|p| p[0]).collect())
    }
}

impl Across {
    /// The control values of the spline that takes `values` at the stations.
    pub(super) fn control(&self, values: &[f64]) -> Result<Vec<f64>, SplineError> {
        let mut result: Vec<f64> = Vec::new();
        for piece in &self.pieces {
            // Pieces share the value at the station between them.
            result.pop();
            result.extend(piece.control(values)?);
        }
        Ok(result)
    }
}

/// Stations on both sides of the jumps of a line with the given values: steps above a fifth of the `size` of the hull
/// there that are three times as steep as the steps next to them.
pub(super) fn jumps(x: &[f64], values: &[f64], size: f64) -> Vec<usize> {
    let slope = |k: usize| (values[k + 1] - values[k]) / (x[k + 1] - x[k]);
    let count = x.len().saturating_sub(1);
    let mut result = Vec::new();
    for k in 0..count {
        let beside = [k.checked_sub(1), (k + 1 < count).then_some(k + 1)];
        let steepest = beside.into_iter().flatten().map(|j| slope(j).abs()).fold(0.0, f64::max);
        if count > 1 && (values[k + 1] - values[k]).abs() > 0.2 * size && slope(k).abs() > 3.0 * steepest {
            result.extend([k, k + 1]);
        }
    }
    result.dedup();
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    const CASES: [(bool, bool); 4] = [(false, false), (false, true), (true, false), (true, true)];

    #[test]
    fn stations_are_met_whatever_the_ends() {
        let x = [-2.0, -1.0, 1.5, 2.0, 7.0];
        for (aft, fore) in CASES {
            let length = Length::new(&x, Blunt { aft, fore });
            let knots = length.knots(&[2]).unwrap();
            let points = length.control_lengths(&knots).into_iter().map(|x| [x]).collect();
            let curve = BsplineCurve::new(knots, points).unwrap();
            for (u, x) in length.sites.iter().zip(x) {
                assert!((curve.eval(*u)[0] - x).abs() < 1e-14, "{aft} {fore} {x}");
            }
        }
    }

    #[test]
    fn cubics_are_kept_and_breaks_do_not_matter_to_them() {
        let sites = [0.0, 0.1, 0.25, 0.5, 0.7, 0.8, 1.0];
        let length = Length { sites: sites.to_vec(), powers: [0.0; 4] };
        let cubic = |u: f64| 1.0 - u + 3.0 * u * u - 2.0 * u * u * u;
        let across = length.interpolation(&[], &[2, 3]).unwrap();
        let control = across.control(&sites.map(cubic)).unwrap();
        let points = control.into_iter().map(|c| [c]).collect();
        let curve = BsplineCurve::new(length.knots(&[2, 3]).unwrap(), points).unwrap();
        for k in 0..=40 {
            let u = f64::from(k) / 40.0;
            assert!((curve.eval(u)[0] - cubic(u)).abs() < 1e-14);
        }
    }

    #[test]
    fn a_jump_is_a_straight_piece_without_overshoot() {
        let x = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        let values = [3.0, 2.9, 2.8, -0.5, -0.4, -0.3, -0.2];
        let breaks = jumps(&x, &values, 4.0);
        assert_eq!(breaks, [2, 3]);
        let length = Length::new(&x, Blunt { aft: false, fore: false });
        let control = length.interpolation(&breaks, &breaks).unwrap().control(&values).unwrap();
        assert!(control.iter().all(|c| (-0.5 - 1e-12..=3.0 + 1e-12).contains(c)), "{control:?}");
    }
}
