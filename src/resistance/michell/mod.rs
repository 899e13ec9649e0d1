//! Wave resistance of thin ships (Michell 1898).
//!
//! R_W = (4 rho g^2 / pi U^2) int_1^inf |F|^2 l^2 / sqrt(l^2 - 1) dl,
//! F(l) = iint y_x exp(-nu l^2 d) exp(i nu l x) dx dz, nu = g / U^2, d the depth below the undisturbed surface
//! (Michell 1898; Tuck 1989, J. Austral. Math. Soc. B 30). Linear theory of an inviscid fluid: slender ships in deep
//! water, that neither sink nor trim. A transom leaves a hollow that goes on aft with its section; a flat bow is closed.
//!
//! Accuracy of the integral, relative: 1e-9 where stations and waterlines are lines of the net and F falls like the
//! waves of a sharp end; on other hulls 1e-5 where waterlines change smoothly with depth, and 5e-4 where they do not, as
//! at the foot of a transom (3.3e-4 on a generated frigate at Fn 0.15). That of the theory is another matter: [`THIN_SHIP_LIMITS`].

mod form;
mod integral;
mod net;
mod panel;
pub(super) mod roots;
mod waterlines;

pub use form::{WaveForm, WaveForms};

use std::cell::RefCell;
use std::f64::consts::PI;

use crate::hull::Hull;
use crate::numeric::join;
use integral::{OctaveEnd, OctaveWeights, integral};
use net::{NetKochin, NetValues};
use waterlines::WaterlineKochin;

use super::water::Water;

/// Agreement of successive limits of the integral over the directions, on nets over fixed x and z and on other hulls; its
/// error is about a hundredth of that.
const TOLERANCES: [f64; 2] = [1e-7, 1e-6];

/// What a page with figures of this theory states.
pub const THIN_SHIP_LIMITS: &str = "Thin-ship theory: slender hull, deep water, no sinkage, trim, viscosity or breaking waves; \
the flow is taken to leave a transom dry. Humps and hollows come out too strong below Fn 0.3. \
Above C_B 0.6 the figures rank hulls at best.";

/// A hull below a waterline, ready for any number of speeds.
#[derive(Debug, Clone)]
pub struct ThinShip {
    kochin: Kochin,
    /// Length of what is below the waterline, of which waves of bow and stern are apart \[m\].
    length: f64,
}

#[derive(Debug, Clone)]
enum Kochin {
    Net(NetKochin),
    Waterlines(WaterlineKochin),
}

/// Wave resistance with its derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct WaveGradient {
    /// R_W \[N\].
    pub resistance: f64,
    /// dR_W / dy of the control half-breadths, in the order of [`crate::spline::BsplineSurface::points`] [N/m].
    pub gradient: Vec<f64>,
}

impl ThinShip {
    /// The part of a hull below a draught above the base line \[m\].
    ///
    /// # Errors
    /// [`crate::hull::HullError`] when the hull does not float at it.
    pub fn new(hull: &Hull, draught: f64) -> Result<Self, crate::hull::HullError> {
        hull.takes_draught(draught)?;
        let kochin = match NetKochin::new(hull, draught) {
            Some(net) => Kochin::Net(net),
            None => Kochin::Waterlines(WaterlineKochin::new(hull, draught, waterlines::NODES)),
        };
        Ok(Self { kochin, length: immersed_length(hull) })
    }

    /// Whether the wave resistance is a quadratic form in the control half-breadths: stations and waterlines are lines
    /// of the net.
    #[must_use]
    pub fn is_quadratic_form(&self) -> bool {
        matches!(self.kochin, Kochin::Net(_))
    }

    /// R_W \[N\] at a speed [m/s], positive against the motion; 0 at speed 0.
    #[must_use]
    pub fn wave_resistance(&self, speed: f64, water: &Water) -> f64 {
        if speed <= 0.0 {
            return 0.0;
        }
        let nu = water.gravity / (speed * speed);
        let found = match &self.kochin {
            Kochin::Net(net) => {
                let mut values = NetValues::default();
                self.integrate(nu, TOLERANCES[0], |k, q| net.kochin(k, q, &mut values))
            }
            Kochin::Waterlines(lines) => self.integrate(nu, TOLERANCES[1], |k, q| lines.kochin(k, q)),
        };
        factor(speed, water) * found
    }

    /// R_W \[N\] at each of some speeds [m/s], on two threads.
    #[must_use]
    pub fn wave_resistances(&self, speeds: &[f64], water: &Water) -> Vec<f64> {
        let each = |first: usize| -> Vec<f64> {
            speeds.iter().skip(first).step_by(2).map(|&speed| self.wave_resistance(speed, water)).collect()
        };
        let (even, odd) = join(|| each(0), || each(1));
        (0..speeds.len()).map(|n| if n.is_multiple_of(2) { even[n / 2] } else { odd[n / 2] }).collect()
    }

    /// R_W at a speed [m/s] with its derivatives by the control half-breadths: R_W = c'Gc, so that they are 2 G c, and
    /// their products with c sum to 2 R_W (to 1e-7). None where it is no quadratic form.
    #[must_use]
    pub fn wave_gradient(&self, speed: f64, water: &Water) -> Option<WaveGradient> {
        let Kochin::Net(net) = &self.kochin else { return None };
        if speed <= 0.0 {
            return Some(WaveGradient { resistance: 0.0, gradient: vec![0.0; net.len()] });
        }
        let nu = water.gravity / (speed * speed);
        let mut values = NetValues::default();
        let sums = RefCell::new(GradientSums::new(net.len()));
        let found = integral(
            nu * self.length,
            TOLERANCES[0],
            |l, weights| {
                let f = net.kochin(nu * l, nu * l * l, &mut values);
                let mut sums = sums.borrow_mut();
                net.add_gradient(f, weights.full, &values, &mut sums.full);
                net.add_gradient(f, weights.windowed, &values, &mut sums.windowed);
                f[0] * f[0] + f[1] * f[1]
            },
            |end| sums.borrow_mut().end(end),
        );
        let total = sums.into_inner().total;
        let factor = factor(speed, water);
        let gradient = total.into_iter().map(|entry| factor * entry).collect();
        Some(WaveGradient { resistance: factor * found, gradient })
    }

    fn integrate(&self, nu: f64, tolerance: f64, mut kochin: impl FnMut(f64, f64) -> [f64; 2]) -> f64 {
        let square = |l: f64, _: OctaveWeights| {
            let [real, imaginary] = kochin(nu * l, nu * l * l);
            real * real + imaginary * imaginary
        };
        integral(nu * self.length, tolerance, square, |_| {})
    }
}

/// The derivatives of an octave, and their sum up to it.
struct GradientSums {
    full: Vec<f64>,
    windowed: Vec<f64>,
    /// Full octaves so far.
    before: Vec<f64>,
    /// The sum that ended under the window of the last octave, and at last the limit.
    total: Vec<f64>,
}

impl GradientSums {
    fn new(count: usize) -> Self {
        let [full, windowed, before, total] = [(); 4].map(|()| vec![0.0; count]);
        Self { full, windowed, before, total }
    }

    fn end(&mut self, end: OctaveEnd) {
        for n in 0..self.total.len() {
            let next = self.before[n] + self.windowed[n];
            let rest = if end.last { end.rest * (next - self.total[n]) } else { 0.0 };
            self.total[n] = next + rest;
            self.before[n] += self.full[n];
            (self.full[n], self.windowed[n]) = (0.0, 0.0);
        }
    }
}

/// 4 rho g^2 / (pi U^2) [N/m^4].
fn factor(speed: f64, water: &Water) -> f64 {
    4.0 * water.density * (water.gravity / speed).powi(2) / PI
}

fn immersed_length(hull: &Hull) -> f64 {
    let ends = hull.surface().points().iter().map(|point| point[0]);
    let (low, high) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    high - low
}

#[cfg(test)]
mod tests;
