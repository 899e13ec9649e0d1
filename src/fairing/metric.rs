//! The energy of true curvature with a frozen metric: a quadratic form that is exact at the net at which it was frozen.
//!
//! Along a waterline or a station with arc length s, and Q = x'^2 + y'^2 (z' for x' on stations) taken at the present
//! net,
//!
//! ```text
//! N = x' y'' - x'' y',   kappa = N Q^(-3/2),   dkappa/ds = (N' Q^(-3/2) - 3/2 N Q' Q^(-5/2)) Q^(-1/2)
//! ```
//!
//! are linear in y once Q and Q' are frozen. With L and H the length and the height of the surface, and w = 0.6,
//!
//! ```text
//! E = w^3  int int (L^3 dkappa/ds)^2 ds/L dz/H      over waterlines
//!   + w^-3 int int (H^3 dkappa/ds)^2 ds/H dx/L      over stations
//!   + sum_(0 < k < 3) C(3, k) w^(3 - 2 k) int int ((H d/ds)^k d^(3-k)y/du^(3-k))^2 du dv,    s along stations,
//! ```
//!
//! which is the parametric energy of [`super::surface`] on a rectangular chart where slopes are small.
//! ds dz = Q^(1/2) |z_v| du dv on a waterline; Gauss sums over the spans, with as many nodes as the degree plus one.
//!
//! A chart that follows the profiles of a ship has waves of its own: derivatives by its parameters are no derivatives
//! along a station, and what is smooth in them is a saw on the body plan where lines of the chart swing round a bulb or
//! spread and crowd with the waterlines.

use super::cells::{Cells, Combination, Crossing, ORDERS, Place, Row, add_square};

use crate::numeric::SymmetricBand;
use crate::spline::{BsplineSurface, binomial};

/// Order of the energy: the highest derivative of y.
pub(super) const ORDER: usize = 3;

/// Rate of the other parameter below which a line is one of the net.
const SKEW: f64 = 1e-9;

/// Part of the derivatives of the held coordinate below which a line does not cross those of the net.
const STEEP: f64 = 1e-9;

/// What a line runs on along the ship or up, over its length, below which it runs across the ship.
const ATHWART: f64 = 1e-3;

/// Terms (factor, order in s, order in t) of D^k with D = a d/ds + d/dt, b = D a, c = D^2 a; k is 1 to 3.
fn terms(order: usize, [a, b, c]: [f64; 3]) -> [(f64, usize, usize); 7] {
    let none = (0.0, 0, 0);
    match order {
        1 => [(a, 1, 0), (1.0, 0, 1), none, none, none, none, none],
        2 => [(a * a, 2, 0), (2.0 * a, 1, 1), (1.0, 0, 2), (b, 1, 0), none, none, none],
        _ => [
            (a * a * a, 3, 0),
            (3.0 * a * a, 2, 1),
            (3.0 * a, 1, 2),
            (1.0, 0, 3),
            (3.0 * a * b, 2, 0),
            (3.0 * b, 1, 1),
            (c, 1, 0),
        ],
    }
}

/// The station or the waterline through a place.
struct Line {
    station: bool,
    /// Derivative of the held coordinate across the line.
    steep: f64,
    turn: [f64; 3],
    /// Derivatives of order 1 to 3 of what runs on (z on a station, x on a waterline) and of y.
    run: [f64; ORDER],
    breadth: [f64; ORDER],
}

impl Line {
    /// None where the chart has no such line.
    fn new(place: &Place<'_>, station: bool) -> Option<Self> {
        let (held, run) = if station { (0, 2) } else { (2, 0) };
        let d = &place.derivatives;
        let coordinate = |axis: usize, s: usize, t: usize| if station { d[s][t][axis] } else { d[t][s][axis] };
        let (steep, level) = (coordinate(held, 1, 0), coordinate(held, 0, 1));
        if steep.abs() <= STEEP * (steep.abs() + level.abs()) {
            return None;
        }
        let along = |axis: usize, k: usize, turn: [f64; 3]| -> f64 {
            terms(k, turn).iter().map(|&(factor, s, t)| factor * coordinate(axis, s, t)).sum()
        };
        // The held coordinate stands still: its derivatives along the line give a, Da and D^2 a one after the other.
        let a = -level / steep;
        let b = -along(held, 2, [a, 0.0, 0.0]) / steep;
        let c = -along(held, 3, [a, b, 0.0]) / steep;
        // On a line of the net they are zero but for rounding.
        let skew = [a, b, c].iter().any(|rate| rate.abs() > SKEW);
        let turn = if skew { [a, b, c] } else { [0.0; 3] };
        let all = |axis: usize| [1, 2, 3].map(|k| along(axis, k, turn));
        Some(Self { station, steep, turn, run: all(run), breadth: all(1) })
    }

    /// Q and Q'.
    fn square_of_speed(&self) -> [f64; 2] {
        let (x, y) = (self.run, self.breadth);
        [x[0] * x[0] + y[0] * y[0], 2.0 * (x[0] * x[1] + y[0] * y[1])]
    }

    /// sum_k factors[k - 1] D^k as a combination, D^k applied to the derivative of order `across` by the other parameter.
    fn combination(&self, factors: &[f64], across: usize) -> Combination {
        let mut all = [[0.0; ORDERS]; ORDERS];
        for (k, factor) in (1..).zip(factors) {
            for (own, s, t) in terms(k, self.turn).into_iter().filter(|term| term.0 != 0.0) {
                let (u, v) = if self.station { (s + across, t) } else { (t, s + across) };
                all[u][v] += factor * own;
            }
        }
        all
    }

    /// (H d/ds)^k of the derivative of y of order `across` by the other parameter, k = 1 or 2; none where the line
    /// stands still.
    fn mixed(&self, k: usize, across: usize, height: f64) -> Option<Combination> {
        let [q, dq] = self.square_of_speed();
        let rate = height / q.sqrt();
        let square = rate * rate;
        let factors = if k == 1 { vec![rate] } else { vec![-0.5 * square * dq / q, square] };
        rate.is_finite().then(|| self.combination(&factors, across))
    }

    /// kappa (order 2) or dkappa/ds (3), and the weight of its square per area of the parameters; none where the line
    /// stands still.
    fn curvature(&self, order: usize) -> Option<(Combination, f64)> {
        let (x, [q, dq]) = (self.run, self.square_of_speed());
        let speed = q.sqrt();
        if speed <= 0.0 || speed.is_nan() {
            return None;
        }
        // g = Q^(-3/2) and its derivative.
        let g = 1.0 / (q * speed);
        let dg = -1.5 * g * dq / q;
        // N and N' as factors of y', y'' and y'''.
        let n = [-x[1], x[0], 0.0];
        let dn = [-x[2], 0.0, x[0]];
        let factor = |k: usize| if order == 2 { n[k] * g } else { (dn[k] * g + n[k] * dg) / speed };
        let factors: Vec<f64> = (0..order).map(factor).collect();
        Some((self.combination(&factors, 0), speed * self.steep.abs()))
    }
}

/// C(3, k) w^(3 - 2 k).
fn weight(k: usize) -> f64 {
    binomial(ORDER, k) * ANISOTROPY.powi((ORDER - k) as i32 - k as i32)
}

/// The terms of the energy of one surface.
pub(super) struct Metric {
    /// L^6 / (L H) w^3 over waterlines, H^6 / (L H) w^-3 over stations.
    scales: [f64; 2],
    height: f64,
    /// Whether all terms are derivatives by the parameters.
    parametric: bool,
}

impl Metric {
    /// How many terms there are: waterlines, the mixed ones, stations.
    pub(super) const TERMS: usize = ORDER + 1;

    /// With the metric of the surface as it is.
    pub(super) fn new(surface: &BsplineSurface<3>) -> Self {
        let extent = |axis: usize| {
            let values = surface.points().iter().map(|point| point[axis]);
            values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
        };
        let (length, height) = (extent(0), extent(2));
        let n = ORDER as i32;
        let scales = [
            ANISOTROPY.powi(n) * length.powi(2 * n) / (length * height),
            ANISOTROPY.powi(-n) * height.powi(2 * n) / (length * height),
        ];
        Self { scales, height, parametric: false }
    }

    /// All terms as derivatives by the parameters.
    pub(super) fn parametric(surface: &BsplineSurface<3>) -> Self {
        Self { parametric: true, ..Self::new(surface) }
    }

    /// Calls `each` with every term at a place: which, its weight of the integral, and what is squared.
    pub(super) fn terms(&self, place: &Place<'_>, mut each: impl FnMut(usize, f64, &Combination)) {
        let parametric = |k: usize| {
            let mut all = [[0.0; ORDERS]; ORDERS];
            all[ORDER - k][k] = 1.0;
            all
        };
        if self.parametric {
            (0..Self::TERMS).for_each(|k| each(k, weight(k) * place.weight, &parametric(k)));
            return;
        }
        let [waterline, station] = [false, true].map(|station| Line::new(place, station));
        for (which, line, scale) in [(0, &waterline, self.scales[0]), (ORDER, &station, self.scales[1])] {
            if let Some((factors, weight)) = line.as_ref().and_then(|line| line.curvature(ORDER)) {
                each(which, scale * weight * place.weight, &factors);
            }
        }
        for k in 1..ORDER {
            let factors = station.as_ref().and_then(|line| line.mixed(k, ORDER - k, self.height));
            each(k, weight(k) * place.weight, &factors.unwrap_or_else(|| parametric(k)));
        }
    }

    /// The energy with weights by term and number of the cell.
    pub(super) fn energy(&self, cells: &Cells<'_>, weights: impl Fn(usize, usize) -> f64) -> SymmetricBand {
        let (mut energy, mut row) = (cells.zeros(), Row::new());
        for (k, cell) in cells.all().enumerate() {
            for place in cells.places(cell) {
                self.terms(&place, |term, weight, factors| {
                    place.form(factors, &mut row);
                    add_square(&mut energy, weight * weights(term, k), &row);
                });
            }
        }
        energy
    }

    /// The jump of the curvature of a waterline (`way` 0) or station (1) where it crosses a line of the net: the weight
    /// of its square in the energy, and its factors. It counts as dkappa/ds = jump/h over the mean length h of
    /// the spans beside the line.
    pub(super) fn jump(&self, way: usize, at: &Crossing<'_>) -> Option<(f64, [f64; 3])> {
        if self.parametric {
            return Some((weight(ORDER * way) * at.weight / at.length, [0.0, 0.0, 1.0]));
        }
        let Jumped { factors, speed, steep } = self.jumped(way, at)?;
        Some((self.scales[way] * steep * at.weight / (at.length * speed), factors))
    }

    /// The same jump as factors; by the parameters that of d^2 y/dt^2, at speed 1.
    pub(super) fn jumped(&self, way: usize, at: &Crossing<'_>) -> Option<Jumped> {
        if self.parametric {
            return Some(Jumped { factors: [0.0, 0.0, 1.0], speed: 1.0, steep: 1.0 });
        }
        let (held, run) = if way == 1 { (0, 2) } else { (2, 0) };
        let (steep, level) = (at.by_s[held], at.by_t[held]);
        if steep.abs() <= STEEP * (steep.abs() + level.abs()) {
            return None;
        }
        let (a, b) = (-level / steep, -at.jumped[held] / steep);
        let along = |axis: usize| at.by_t[axis] + a * at.by_s[axis];
        let (x, y) = (along(run), along(1));
        let speed = x.hypot(y);
        if speed <= 0.0 || speed.is_nan() {
            return None;
        }
        let g = 1.0 / (speed * speed * speed);
        let turned = at.jumped[run] + b * at.by_s[run];
        let factors = [g * (x * b - turned * a), -g * turned, g * x];
        Some(Jumped { factors, speed, steep: steep.abs() })
    }
}

/// A waterline (`way` 0) or station (1) where it crosses a line of the net across which its slope may jump.
pub(super) struct Folded {
    /// Sine of the angle that it turns by, the part of either side.
    pub(super) turn: [Combination; 2],
    /// What its curvature above is more than that below \[1/m\], the part of either side.
    pub(super) curvature: [Combination; 2],
    /// Mean of its lengths over the spans beside the line \[m\].
    pub(super) length: f64,
}

impl Folded {
    /// None where the chart has no such line, or it stands still or runs across the ship. `lengths` are those of the spans beside it.
    pub(super) fn new(way: usize, sides: &[Place<'_>; 2], lengths: [f64; 2]) -> Option<Self> {
        let [below, above] = [&sides[0], &sides[1]].map(|place| Line::new(place, way == 1));
        let (below, above) = (below?, above?);
        let curvature = [below.curvature(2)?.0.map(|row| row.map(|factor| -factor)), above.curvature(2)?.0];
        let speeds = [&below, &above].map(|line| line.square_of_speed()[0].sqrt());
        let both = speeds[0] * speeds[1];
        let turn = [below.combination(&[-above.run[0] / both], 0), above.combination(&[below.run[0] / both], 0)];
        // Half-breadths say nothing of the direction of what runs across the ship.
        if [&below, &above].iter().zip(speeds).any(|(line, speed)| line.run[0].abs() <= ATHWART * speed) {
            return None;
        }
        let length = 0.5 * (speeds[0] * lengths[0] + speeds[1] * lengths[1]);
        Some(Self { turn, curvature, length })
    }
}

/// A jump of curvature as a form.
pub(super) struct Jumped {
    /// Factors of dy/ds, dy/dt and the jump of d^2 y/dt^2.
    pub(super) factors: [f64; 3],
    /// Length of the line for the parameter \[m\].
    pub(super) speed: f64,
    /// Derivative of the held coordinate across the line \[m\].
    steep: f64,
}

impl Jumped {
    /// What a jump of size 1 makes the line depart by over a span \[m^2\].
    pub(super) fn departure(&self, at: &Crossing<'_>) -> f64 {
        (self.speed * at.length).powi(2)
    }
}

/// w_u, the weight of bending along the ship; w_v is its inverse.
pub(super) const ANISOTROPY: f64 = 0.6;

#[cfg(test)]
mod tests {
    use super::super::surface::energy;
    use super::*;
    use crate::numeric::gauss_legendre;
    use crate::spline::KnotVector;

    /// x = 100 u, z = 10 v, half-breadths from a function of (x, z) at the Greville points.
    fn surface(y: impl Fn(f64, f64) -> f64) -> BsplineSurface<3> {
        let (u, v) = (KnotVector::uniform(3, 5).unwrap(), KnotVector::uniform(3, 4).unwrap());
        let mut points = Vec::new();
        for s in u.greville() {
            for t in v.greville() {
                let (x, z) = (100.0 * s, 10.0 * t);
                points.push([x, y(x, z), z]);
            }
        }
        BsplineSurface::new(u, v, points).unwrap()
    }

    fn half_breadths(surface: &BsplineSurface<3>) -> Vec<f64> {
        surface.points().iter().map(|point| point[1]).collect()
    }

    fn true_energy(surface: &BsplineSurface<3>) -> f64 {
        Metric::new(surface).energy(&Cells::new(surface), |_, _| 1.0).quadratic(&half_breadths(surface))
    }

    #[test]
    fn small_slopes_give_the_parametric_energy() {
        let flat = surface(|x, z| 1e-7 * ((0.31 * x).sin() + (0.9 * z + 0.05 * x).cos()));
        let parametric = energy(flat.u(), flat.v(), 3, 0.6).quadratic(&half_breadths(&flat));
        let exact = true_energy(&flat);
        assert!((exact / parametric - 1.0).abs() < 1e-9, "{exact:e} for {parametric:e}");
    }

    /// Waterlines that bend by up to 45 degrees, the same at every height: int (dkappa/ds)^2 ds by its own formula.
    #[test]
    fn steep_waterlines_have_their_true_energy() {
        let hull = surface(|x, _| 30.0 * (0.03 * x).sin());
        let breaks = hull.u().breakpoints();
        let mut expected = 0.0;
        for piece in breaks.windows(2) {
            for (u, weight) in gauss_legendre(4).on(piece[0], piece[1]) {
                let d = hull.derivatives::<4>(u, 0.5);
                let (p, q, r) = (d[1][0][1] / 100.0, d[2][0][1] / 1e4, d[3][0][1] / 1e6);
                let w = 1.0 + p * p;
                let rate = (r / w.powf(1.5) - 3.0 * p * q * q / w.powf(2.5)) / w.sqrt();
                expected += 100.0 * weight * rate * rate * w.sqrt();
            }
        }
        // w^3 L^6 ds/L dz/H over H.
        let expected = expected * 0.6f64.powi(3) * 100f64.powi(5);
        let found = true_energy(&hull);
        assert!((found / expected - 1.0).abs() < 1e-10, "{found:e} for {expected:e}");
    }

    /// y = ((x + 3 z) / 40)^3 on a plumb and on a raked chart: the stations are the same curves, and so is their
    /// energy, where the raked chart is cut by other lines of the net.
    #[test]
    fn stations_of_a_raked_chart() {
        let cube = |skew: f64| {
            // A cubic is in the space of either chart; its control values by the blossom of ((100 u + skew v + 30 v) /
            // 40)^3.
            let (u, v) = (KnotVector::uniform(3, 1).unwrap(), KnotVector::uniform(3, 1).unwrap());
            let mut points = Vec::new();
            for i in 0..4_u32 {
                for j in 0..4_u32 {
                    let (a, b): (f64, f64) = (100.0 / 40.0, (skew + 30.0) / 40.0);
                    // Coefficients of u^k v^(3-k) in Bernstein form: falling factorials.
                    let binomial = [1.0, 3.0, 3.0, 1.0];
                    let fall = |n: u32, k: u32| (0..k).map(|m| f64::from(n) - f64::from(m)).product::<f64>();
                    let y: f64 = (0..4_u32)
                        .map(|k| {
                            let term = binomial[k as usize] * a.powi(k as i32) * b.powi(3 - k as i32);
                            term * fall(i, k) / fall(3, k) * fall(j, 3 - k) / fall(3, 3 - k)
                        })
                        .sum();
                    points.push([100.0 * f64::from(i) / 3.0 + skew * f64::from(j) / 3.0, y, 10.0 * f64::from(j) / 3.0]);
                }
            }
            BsplineSurface::new(u, v, points).unwrap()
        };
        let raked = cube(20.0);
        // (dkappa/ds) of the station through the first node of the raked chart, against the curve y(z) itself.
        let cells = Cells::new(&raked);
        let place = cells.places([0, 0]).next().unwrap();
        let (factors, _) = Line::new(&place, true).unwrap().curvature(3).unwrap();
        let mut row = Row::new();
        place.form(&factors, &mut row);
        let y = half_breadths(&raked);
        let found: f64 = row.iter().map(|&(k, factor)| factor * y[k]).sum();
        assert!((found / place.value(&factors) - 1.0).abs() < 1e-12);
        let [x, _, z] = place.derivatives[0][0];
        let t = (x + 3.0 * z) / 40.0;
        let (p, q, r) = (9.0 * t * t / 40.0, 54.0 * t / 1600.0, 162.0 / 64000.0);
        let w: f64 = 1.0 + p * p;
        let expected = (r / w.powf(1.5) - 3.0 * p * q * q / w.powf(2.5)) / w.sqrt();
        assert!((found / expected - 1.0).abs() < 1e-11, "{found:e} for {expected:e}");
    }
}
