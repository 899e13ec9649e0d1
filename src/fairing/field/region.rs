//! Where the hull is within the rectangle of its chart: its ends at every height, and the chart that has them as edges.
//!
//! A field runs past the ends of the hull over the whole rectangle; the hull is where it is positive. Stern and stem are
//! its zero contours, or the edges of the rectangle where it is still positive there (a transom). The chart of the hull
//! bends that of the field near the ends alone,
//!
//! ```text
//! u(w, v) = w + (alpha(v) - 0) A(w) + (beta(v) - 1) B(w),   A = ((1 - w/r)+)^p,   B(w) = ((1 - (1-w)/r)+)^p
//! ```
//!
//! with alpha and beta the ends in u, r and p so that u rises with w by at least a quarter everywhere; p = 5 keeps four
//! derivatives.

use super::chart::Chart;
use super::net::{DEGREE, Net};
use crate::spline::KnotVector;

/// Steps a span in which a zero of the field is looked for.
const STEPS: usize = 8;

/// Least du/dw of the chart of the hull.
const LEAST_SLOPE: f64 = 0.25;

/// How often the spline of the ends is corrected.
const CORRECTIONS: usize = 6;

/// How far from an end a bend reaches at least.
const REACH: f64 = 0.3;

/// A field on its net.
#[derive(Debug, Clone, Copy)]
pub struct Field<'a> {
    /// The chart.
    pub chart: &'a Chart,
    /// The net.
    pub net: &'a Net,
    /// Its control values \[m\].
    pub values: &'a [f64],
}

impl Field<'_> {
    /// Half-breadth at (u, v) \[m\].
    #[must_use]
    pub fn at(&self, place: [f64; 2]) -> f64 {
        let ((i, along), (j, up)) = (self.net.basis(0, place[0]), self.net.basis(1, place[1]));
        let count = self.net.shape()[1];
        let row = |r: usize| -> f64 {
            let values = &self.values[(i + r) * count + j..];
            up.iter().zip(values).map(|(b, c)| b * c).sum()
        };
        along.iter().enumerate().map(|(r, b)| b * row(r)).sum()
    }

    /// sqrt(1 + y_x^2 + y_z^2) at (x, z): the error of a half-breadth over the error normal to the hull.
    #[must_use]
    pub fn steepness(&self, x: f64, z: f64) -> f64 {
        let (u, v) = (self.chart.u(x), self.chart.v(z));
        let step = 1e-5;
        let slope = |a: [f64; 2], b: [f64; 2], distance: f64| (self.at(a) - self.at(b)) / distance;
        let (low, high) = ((u - step).max(0.0), (u + step).min(1.0));
        let along = slope([high, v], [low, v], self.chart.x(high) - self.chart.x(low));
        let (low, high) = ((v - step).max(0.0), (v + step).min(1.0));
        let up = slope([u, high], [u, low], self.chart.z(high) - self.chart.z(low));
        (1.0 + along * along + up * up).sqrt()
    }

    /// Where the field is least at height v between u = `from` and u = `to`, at one of the places at which zeros are looked
    /// for.
    #[must_use]
    pub fn least(&self, v: f64, from: f64, to: f64) -> f64 {
        let steps = self.steps(from, to);
        let places = (0..=steps).map(|k| from + (to - from) * k as f64 / steps as f64);
        places.map(|u| (self.at([u, v]), u)).min_by(|a, b| a.0.total_cmp(&b.0)).map_or(to, |(_, u)| u)
    }

    fn steps(&self, from: f64, to: f64) -> usize {
        let spans = self.net.knots[0].breakpoints().len() as f64;
        (((to - from).abs() * spans).ceil() as usize * STEPS).max(STEPS)
    }

    /// The first zero at height v on the way from u = `from`, where the field is positive, to u = `to`; none where it is
    /// positive all the way.
    #[must_use]
    pub fn zero(&self, v: f64, from: f64, to: f64) -> Option<f64> {
        let steps = self.steps(from, to);
        let (mut inside, mut outside) = (from, None);
        for k in 1..=steps {
            let u = from + (to - from) * k as f64 / steps as f64;
            if self.at([u, v]) <= 0.0 {
                outside = Some(u);
                break;
            }
            inside = u;
        }
        let mut outside = outside?;
        for _ in 0..60 {
            let middle = 0.5 * (inside + outside);
            if self.at([middle, v]) > 0.0 { inside = middle } else { outside = middle }
        }
        Some(0.5 * (inside + outside))
    }
}

/// How the ends of the hull bend the chart of its field.
#[derive(Debug, Clone)]
pub struct Bend {
    /// Knots of the ends along v.
    pub knots: KnotVector,
    /// Control values of u at the aft and at the forward end, over v.
    pub ends: [Vec<f64>; 2],
    /// How far from the ends the bend reaches, aft and forward.
    pub reach: [f64; 2],
    /// Its power, aft and forward.
    pub power: [i32; 2],
}

impl Bend {
    /// The bend whose ends are given at any v: their control values are the ends at the Greville places (variation
    /// diminishing splines, Schoenberg 1967), corrected by what the spline misses there a few times, so that it comes near
    /// the interpolating spline where that does not swing.
    #[must_use]
    pub fn new(knots: KnotVector, end: impl Fn(f64) -> [f64; 2]) -> Self {
        let sites = knots.greville();
        let wanted: Vec<[f64; 2]> = sites.iter().map(|&v| end(v)).collect();
        let ends = [0, 1].map(|side| {
            let exact: Vec<f64> = wanted.iter().map(|ends| ends[side]).collect();
            let mut control = exact.clone();
            for _ in 0..CORRECTIONS {
                let found: Vec<f64> = sites.iter().map(|&v| spline(&knots, &control, v)).collect();
                control.iter_mut().zip(exact.iter().zip(&found)).for_each(|(c, (e, f))| *c += e - f);
            }
            let bounds = exact.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], &e| [a.min(e), b.max(e)]);
            control.into_iter().map(|c| c.clamp(bounds[0], bounds[1])).collect::<Vec<f64>>()
        });
        let most = [ends[0].iter().fold(0.0f64, |m, &e| m.max(e)), ends[1].iter().fold(0.0f64, |m, &e| m.max(1.0 - e))];
        let mut reach = [REACH; 2];
        let mut power = [DEGREE as i32; 2];
        for side in 0..2 {
            // u_w >= 1 - p m / r.
            let room = 1.0 - LEAST_SLOPE;
            reach[side] = (DEGREE as f64 * most[side] / room).max(REACH);
            if reach[side] > 0.5 {
                reach[side] = 1.0;
                power[side] = ((0.5 * (1.0 + room) / most[side].max(1e-9)).floor() as i32).clamp(1, DEGREE as i32);
            }
        }
        Self { knots, ends, reach, power }
    }

    /// u at (w, v).
    #[must_use]
    pub fn u(&self, w: f64, v: f64) -> f64 {
        let [a, b] = [0, 1].map(|side| spline(&self.knots, &self.ends[side], v));
        let fade = |side: usize, w: f64| (1.0 - w / self.reach[side]).max(0.0).powi(self.power[side]);
        w + a * fade(0, w) + (b - 1.0) * fade(1, 1.0 - w)
    }

    /// w at (u, v), to rounding, by bisection.
    #[must_use]
    pub fn w(&self, u: f64, v: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.u(middle, v) < u { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }

    /// Whether no end is off an edge of the rectangle.
    #[must_use]
    pub fn is_straight(&self) -> bool {
        self.ends[0].iter().all(|e| *e <= 0.0) && self.ends[1].iter().all(|e| *e >= 1.0)
    }
}

fn spline(knots: &KnotVector, control: &[f64], t: f64) -> f64 {
    let span = knots.find_span(t);
    let p = knots.degree();
    knots.basis(span, t)[..=p].iter().zip(&control[span - p..]).map(|(b, c)| b * c).sum()
}
