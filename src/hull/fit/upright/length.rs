//! The direction along the hull: x(u), the sites of the stations, and interpolation across them.
//!
//! x(u) = x_a + L g(u) with g one polynomial over the whole length, so that it lies in every cubic spline space exactly:
//! g = u where both ends are sharp or cut off; u (2 - u) where the fore end is blunt, u^2 where the aft end is,
//! 3 u^2 - 2 u^3 where both are. At a blunt end y ~ sqrt(distance) then is smooth in u.
//!
//! Across the stations every line and every column of the net is the cubic spline with the "not a knot" end conditions
//! (de Boor 2001, IV), of fourth order. Where it would leave the range of its neighbours it takes the slope that
//! [`limits`] leaves at the stations beside, and is C1 there: a level keel stays level up to the station at which it rises.
//! Where a line jumps (skeg, bulb) the spline is interrupted: the stations on both sides of the jump are p-fold knots and
//! the piece between them is straight. All of them lie in one space with a knot at every station.

use super::super::limits;
use crate::spline::{BsplineCurve, Collocation, Condition, KnotVector, SplineError};

/// Degree in u and v.
pub(super) const DEGREE: usize = 3;

/// Rounds in which slopes are limited: a slope that is taken back swings its neighbours.
const ROUNDS: usize = 4;

/// Most that a cubic departs by a slope, over slope and width of its gap: t (1 - t)^2 at t = 1/3.
const BULGE: f64 = 4.0 / 27.0;

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

    /// The space of lines and columns of which each has one of the `courses`: a knot at every station, double where a slope
    /// is given and p-fold where one is interrupted.
    pub(super) fn knots<'a>(&self, courses: impl IntoIterator<Item = &'a Course>) -> Result<KnotVector, SplineError> {
        let mut times = vec![1; self.sites.len()];
        for piece in courses.into_iter().flat_map(|course| &course.pieces) {
            piece.slopes.iter().for_each(|&(k, _)| times[piece.first + k] = times[piece.first + k].max(2));
            times[piece.first] = DEGREE;
            times[piece.last] = DEGREE;
        }
        KnotVector::from_breakpoints(DEGREE, &self.sites, &times[1..times.len() - 1])
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

    /// The spline that takes `values` at the stations, interrupted at `breaks`, without bulges of more than `bulge` beyond
    /// what its neighbours and `floor` allow.
    ///
    /// # Errors
    /// [`SplineError`] when the stations do not determine it.
    pub(super) fn course(
        &self,
        breaks: &[usize],
        values: &[f64],
        floor: f64,
        bulge: f64,
    ) -> Result<Course, SplineError> {
        let last = self.sites.len() - 1;
        let mut ends: Vec<usize> = breaks.iter().copied().filter(|k| (1..last).contains(k)).collect();
        ends.extend([0, last]);
        ends.sort_unstable();
        ends.dedup();
        let piece = |w: &[usize]| Piece::new(w[0], &self.sites[w[0]..=w[1]], &values[w[0]..=w[1]], floor, bulge);
        Ok(Course { pieces: ends.windows(2).map(piece).collect::<Result<_, _>>()? })
    }

    /// The control values of a course over `knots`, which hold its own.
    ///
    /// # Errors
    /// [`SplineError`] when they do not.
    pub(super) fn control(&self, course: &Course, knots: &KnotVector) -> Result<Vec<f64>, SplineError> {
        let mut result: Vec<f64> = Vec::new();
        for piece in &course.pieces {
            let own = piece.curve.knots();
            let inserted: Vec<f64> = self.sites[piece.first + 1..piece.last]
                .iter()
                .flat_map(|&site| {
                    std::iter::repeat_n(site, knots.multiplicity(site).saturating_sub(own.multiplicity(site)))
                })
                .collect();
            let curve = piece.curve.elevate(DEGREE - own.degree())?.insert_knots(&inserted)?;
            // Pieces share the value at the station between them.
            result.pop();
            result.extend(curve.points().iter().map(|p| p[0]));
        }
        Ok(result)
    }
}

/// A spline across the stations.
#[derive(Debug, Clone)]
pub(super) struct Course {
    pieces: Vec<Piece>,
}

/// A spline from station to station without an interruption.
#[derive(Debug, Clone)]
struct Piece {
    first: usize,
    last: usize,
    /// Stations of the piece, from 0, at which the slope is given.
    slopes: Vec<(usize, f64)>,
    curve: BsplineCurve<1>,
}

impl Piece {
    fn new(first: usize, sites: &[f64], values: &[f64], floor: f64, bulge: f64) -> Result<Self, SplineError> {
        let mut slopes: Vec<(usize, f64)> = Vec::new();
        let mut curve = through(sites, values, &slopes)?;
        for _ in 0..ROUNDS {
            let free: Vec<f64> = sites.iter().map(|&u| curve.derivatives::<2>(u)[1][0]).collect();
            let mut limited = free.clone();
            limits::limit(sites, values, floor, &mut limited);
            let width = |k: usize| {
                let beside = [k.checked_sub(1).map(|j| [j, k]), Some([k, k + 1]).filter(|_| k + 1 < sites.len())];
                beside.into_iter().flatten().map(|[a, b]| sites[b] - sites[a]).fold(0.0, f64::max)
            };
            let more: Vec<(usize, f64)> = (0..sites.len())
                .filter(|&k| slopes.iter().all(|s| s.0 != k))
                .filter(|&k| BULGE * (free[k] - limited[k]).abs() * width(k) > bulge)
                .map(|k| (k, limited[k]))
                .collect();
            if more.is_empty() {
                break;
            }
            slopes.extend(more);
            slopes.sort_unstable_by_key(|s| s.0);
            curve = through(sites, values, &slopes)?;
        }
        Ok(Self { first, last: first + sites.len() - 1, slopes, curve })
    }
}

/// The spline through `values` with the given slopes at some of the sites: C2, but C1 where a slope is given, and of third
/// degree as far as that is determined.
fn through(sites: &[f64], values: &[f64], slopes: &[(usize, f64)]) -> Result<BsplineCurve<1>, SplineError> {
    let count = sites.len();
    let degree = DEGREE.min(count + slopes.len() - 1);
    let mut times = vec![0; count];
    if count == 3 {
        times[1] = (count + slopes.len()).saturating_sub(DEGREE + 1);
    }
    if count > 3 {
        times[2..count - 2].fill(1);
        // At the ends no slope makes "not a knot" of the station beside, a given one a knot.
        slopes.iter().for_each(|s| times[s.0.clamp(1, count - 2)] += 1);
    }
    let inner: Vec<usize> = (1..count - 1).filter(|&k| times[k] > 0).collect();
    let breakpoints: Vec<f64> = [0].iter().chain(&inner).chain(&[count - 1]).map(|&k| sites[k]).collect();
    let times: Vec<usize> = inner.iter().map(|&k| times[k]).collect();
    let knots = KnotVector::from_breakpoints(degree, &breakpoints, &times)?;
    let (mut conditions, mut control) = (Vec::new(), Vec::new());
    for (k, (&site, &value)) in sites.iter().zip(values).enumerate() {
        conditions.push(Condition { site, order: 0 });
        control.push(value);
        if let Some(&(_, slope)) = slopes.iter().find(|s| s.0 == k) {
            conditions.push(Condition { site, order: 1 });
            control.push(slope);
        }
    }
    Collocation::with_conditions(&knots, &conditions)?.solve(&mut control);
    BsplineCurve::new(knots, control.into_iter().map(|value| [value]).collect())
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
            let level = length.course(&[2], &[0.0; 5], 0.0, 0.0).unwrap();
            let knots = length.knots([&level]).unwrap();
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
        let course = |breaks: &[usize]| length.course(breaks, &sites.map(cubic), f64::NEG_INFINITY, 1.0).unwrap();
        let (whole, broken) = (course(&[]), course(&[2, 3]));
        let knots = length.knots([&whole, &broken]).unwrap();
        let control = length.control(&whole, &knots).unwrap();
        let curve = BsplineCurve::new(knots, control.into_iter().map(|c| [c]).collect()).unwrap();
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
        let course = length.course(&breaks, &values, f64::NEG_INFINITY, 1e-3).unwrap();
        let control = length.control(&course, &length.knots([&course]).unwrap()).unwrap();
        assert!(control.iter().all(|c| (-0.5 - 1e-12..=3.0 + 1e-12).contains(c)), "{control:?}");
    }

    /// A keel that is level between stations far apart and straight between those close together, as of a barge with rakes.
    #[test]
    fn a_level_keel_stays_level_whatever_the_spacing() {
        let x = [0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 20.0, 30.0, 40.0, 50.0, 52.0, 54.0, 60.0];
        let values = x.map(|x: f64| (3.0 - 0.3 * x.min(60.0 - x)).max(0.0));
        let length = Length::new(&x, Blunt { aft: false, fore: false });
        let course = length.course(&[], &values, f64::NEG_INFINITY, 1e-3).unwrap();
        let knots = length.knots([&course]).unwrap();
        let control = length.control(&course, &knots).unwrap();
        let curve = BsplineCurve::new(knots, control.into_iter().map(|c| [c]).collect()).unwrap();
        for k in 0..=600 {
            let x = 0.1 * f64::from(k);
            let (z, straight) = (curve.eval(x / 60.0)[0], (3.0 - 0.3 * x.min(60.0 - x)).max(0.0));
            // A knuckle is rounded within the gap beside it.
            assert!(z > -3e-3 && (z - straight).abs() < 0.5, "{x}: {z} for {straight}");
        }
        for (x, value) in x.iter().zip(values) {
            assert!((curve.eval(x / 60.0)[0] - value).abs() < 1e-12);
        }
    }
}
