//! Where the hull is within the rectangle of its chart: its ends at every height, and the chart that has them as edges.
//!
//! A field runs past the ends of the hull over the whole rectangle; the hull is where it is positive. Stern and stem are
//! its zero contours, or the edges of the rectangle where it is still positive there (a transom). The chart of the hull
//! bends that of the field near the ends alone.
//!
//! ```text
//! u(w, v) = w + alpha(v) A(w) + (beta(v) - 1) B(w)
//! ```
//!
//! Here alpha and beta are the ends in u. The fade A is the spline whose control values are (1 - w/r)+ at its Greville
//! places, on every third line of the net: straight near the end, zero beyond the reach r, with four continuous derivatives.
//! B is the same from the other end. The reach lets u rise with w by at least a quarter; where those of the two ends meet,
//! both are 1, and u rises by the length of the waterline. A power of 1 - w/r in their place bent the chart five times as far
//! into the hull, and sections amidships took the waves of a profile.

use super::chart::Chart;
use super::net::{DEGREE, Net};
use crate::numeric::bracketed_root;
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector, SplineError};

/// Greatest factor of the errors in y of a cell over those normal to the hull.
const STEEPEST: f64 = 10.0;

/// Error in u of a zero of the field.
const ROUNDING: f64 = 1e-15;

/// Steps a span in which a zero of the field is looked for.
const STEPS: usize = 8;

/// Least du/dw of the chart of the hull.
const LEAST_SLOPE: f64 = 0.25;

/// How often the spline of the ends is corrected.
const CORRECTIONS: usize = 6;

/// How far from an end a bend reaches at least.
const REACH: f64 = 0.3;

/// Lines of the net for each of a fade.
const FADE: usize = 3;

/// A field on its chart.
#[derive(Debug, Clone)]
pub struct Field {
    /// The chart.
    pub chart: Chart,
    surface: BsplineSurface<1>,
    /// Lines u = constant of the net.
    lines: f64,
}

impl Field {
    /// The field of these control values \[m\] on a net.
    ///
    /// # Errors
    /// [`SplineError`] when there are not as many as the net has.
    pub fn new(chart: Chart, net: &Net, values: &[f64]) -> Result<Self, SplineError> {
        let [u, v] = net.knots.clone();
        let lines = u.breakpoints().len() as f64;
        Ok(Self { chart, surface: BsplineSurface::new(u, v, values.iter().map(|&y| [y]).collect())?, lines })
    }

    /// Half-breadth at (u, v) \[m\].
    #[must_use]
    pub fn at(&self, [u, v]: [f64; 2]) -> f64 {
        self.surface.eval(u, v)[0]
    }

    /// y_x and y_z at (x, z). The latter is infinite on a flat bottom with b = 0.
    #[must_use]
    pub fn slopes(&self, x: f64, z: f64) -> [f64; 2] {
        let (u, v) = (self.chart.u(x), self.chart.v(z));
        let [[_, up], [along, _]] = self.surface.derivatives::<2>(u, v).map(|row| row.map(|value| value[0]));
        [along / self.chart.x_slope(u), up / self.chart.z_slope(v)]
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
        (((to - from).abs() * self.lines).ceil() as usize * STEPS).max(STEPS)
    }

    /// The first zero at height v on the way from u = `from`, where the field is positive, to u = `to`; none where it is
    /// positive all the way.
    #[must_use]
    pub fn zero(&self, v: f64, from: f64, to: f64) -> Option<f64> {
        let steps = self.steps(from, to);
        let place = |k: usize| from + (to - from) * k as f64 / steps as f64;
        let value = |u: f64| self.at([u, v]);
        let outside = (1..=steps).find(|&k| value(place(k)) <= 0.0)?;
        let (inside, outside) = (place(outside - 1), place(outside));
        // Without a bracket the field is not positive at the start, and the hull ends there.
        Some(bracketed_root(value, inside, outside, ROUNDING).unwrap_or(inside))
    }
}

/// sqrt(1 + y_x^2 + y_z^2): the error of a half-breadth over the error normal to the hull, at most ten.
#[must_use]
pub fn steepness([along, up]: [f64; 2]) -> f64 {
    // `min` takes what is no number for ten.
    (1.0 + along * along + up * up).sqrt().min(STEEPEST)
}

/// How the ends of the hull bend the chart of its field.
#[derive(Debug, Clone)]
pub struct Bend {
    /// u at the aft and at the forward end, over v.
    pub ends: [BsplineCurve<1>; 2],
    /// How the bend fades with w, aft and forward.
    pub fades: [BsplineCurve<1>; 2],
}

impl Bend {
    /// The bend on knots along w and v, whose ends are given at any v. Their control values are the ends at the Greville
    /// places (variation diminishing splines, Schoenberg 1967). They are corrected a few times by what the spline misses
    /// there, so that it comes near the interpolating spline where that does not swing.
    ///
    /// # Errors
    /// [`SplineError`] when the knots make no curve.
    pub fn new([along, up]: [&KnotVector; 2], end: impl Fn(f64) -> [f64; 2]) -> Result<Self, SplineError> {
        let wanted: Vec<[f64; 2]> = up.greville().into_iter().map(end).collect();
        let curve = |side: usize| through(up, &wanted.iter().map(|ends| ends[side]).collect::<Vec<f64>>());
        let ends = [curve(0)?, curve(1)?];
        // u_w >= 1 - m / r.
        let mut reach = [0, 1].map(|side| (off_edge(&ends[side], side) / (1.0 - LEAST_SLOPE)).max(REACH));
        if reach[0] + reach[1] > 1.0 {
            reach = [1.0; 2];
        }
        let breaks = along.breakpoints();
        let last = breaks.len() - 1;
        let coarse: Vec<f64> = (0..last).step_by(FADE).chain([last]).map(|k| breaks[k]).collect();
        let knots = KnotVector::from_breakpoints(DEGREE, &coarse, &vec![1; coarse.len() - 2])?;
        let fade = |side: usize| {
            let from = |w: f64| if side == 0 { w } else { 1.0 - w };
            let control = knots.greville().into_iter().map(|w| [(1.0 - from(w) / reach[side]).max(0.0)]).collect();
            BsplineCurve::new(knots.clone(), control)
        };
        let fades = [fade(0)?, fade(1)?];
        Ok(Self { ends, fades })
    }

    /// u at (w, v).
    #[must_use]
    pub fn u(&self, w: f64, v: f64) -> f64 {
        let [a, b] = [0, 1].map(|side| self.ends[side].eval(v)[0]);
        let [aft, forward] = [0, 1].map(|side| self.fades[side].eval(w)[0]);
        w + a * aft + (b - 1.0) * forward
    }

    /// Whether no end is off an edge of the rectangle.
    #[must_use]
    pub fn is_straight(&self) -> bool {
        (0..2).all(|side| off_edge(&self.ends[side], side) <= 0.0)
    }
}

/// The furthest that a control value of an end is off its edge of the rectangle, into it.
fn off_edge(end: &BsplineCurve<1>, side: usize) -> f64 {
    end.points().iter().map(|[u]| if side == 0 { *u } else { 1.0 - u }).fold(0.0, f64::max)
}

/// The spline near values at the Greville places, within their range.
fn through(knots: &KnotVector, values: &[f64]) -> Result<BsplineCurve<1>, SplineError> {
    let bounds = values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], &e| [a.min(e), b.max(e)]);
    let curve = |control: &[f64]| BsplineCurve::new(knots.clone(), control.iter().map(|&c| [c]).collect());
    let mut control = values.to_vec();
    for _ in 0..CORRECTIONS {
        let found = curve(&control)?;
        let missed = knots.greville().into_iter().zip(values).map(|(v, value)| value - found.eval(v)[0]);
        control.iter_mut().zip(missed).for_each(|(c, missed)| *c += missed);
    }
    control.iter_mut().for_each(|c| *c = c.clamp(bounds[0], bounds[1]));
    curve(&control)
}
