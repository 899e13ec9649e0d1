//! The Kochin function of a net of half-breadths over fixed x and z.
//!
//! Where stations are lines u = constant and waterlines lines v = constant, F = sum of c_ij G_i(k) H_j(q) with k = nu
//! lambda and q = nu lambda^2,
//!
//! G_i(k) = int B_i'(x) e^{ikx} dx, H_j(q) = int B_j(z) e^{-q (T - z)} dz,
//!
//! so that the wave resistance is a quadratic form c'Gc in the control values c. Both integrals are closed where x and z
//! are linear in the parameter of a span; elsewhere the span is halved until a Legendre series follows to 1e-12.

use super::panel::{Moments, Panel, TERMS, oscillation, panels};
use crate::hull::Hull;
use crate::spline::{BsplineCurve, KnotVector, MAX_DEGREE};

/// Basis functions of a span.
const FUNCTIONS: usize = MAX_DEGREE + 1;
/// Terms of series that are dropped, beside values of 1.
const TOLERANCE: f64 = 1e-12;
/// What decays by this power is left out: 3e-20.
const DEEPEST: f64 = 45.0;
/// Steps along the ship that differ by less than this part are one.
const SAME_STEP: f64 = 1e-12;

/// The panels of one axis; with each the index of the first basis function.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    panels: Vec<(usize, Panel<FUNCTIONS>)>,
    functions: usize,
    count: usize,
}

impl Axis {
    pub(super) fn new(coordinate: &BsplineCurve<1>, slopes: bool, end: f64) -> Self {
        let knots: &KnotVector = coordinate.knots();
        let mut list = Vec::new();
        let along = coordinate.points().iter().map(|p| p[0]);
        let size = along.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
        let size = size[1] - size[0];
        for span in knots.spans() {
            let (from, to) = (knots.knots()[span], knots.knots()[span + 1].min(end));
            if to <= from {
                continue;
            }
            let first = span - knots.degree();
            let sample = |t: f64| {
                let [value, slope] = knots.basis_derivatives::<2>(span, t);
                let points = &coordinate.points()[first..=span];
                let along = |row: &[f64; FUNCTIONS]| points.iter().zip(row).map(|(p, b)| p[0] * b).sum::<f64>();
                (along(&value), along(&slope), if slopes { slope } else { value })
            };
            let [start, stop] = [sample(from).0, sample(to).0];
            if (stop - start).abs() <= 1e-9 * size {
                // x stands still: the functions jump there, and have no height.
                let values = [from, to].map(|t| knots.basis(span, t));
                let mut series = [[0.0; TERMS]; FUNCTIONS];
                series.iter_mut().enumerate().for_each(|(n, terms)| terms[0] = 0.5 * (values[1][n] - values[0][n]));
                if slopes {
                    list.push((first, Panel { middle: start, half: 0.0, series, count: 1 }));
                }
                continue;
            }
            list.extend(panels(&sample, [from, to], slopes, TOLERANCE).into_iter().map(|panel| (first, panel)));
        }
        Self { panels: list, functions: knots.degree() + 1, count: knots.basis_count() }
    }

    /// G_i at wave number `k`; a flat bow falls to the centreplane at x = `fore`.
    pub(super) fn wave(&self, k: f64, fore: f64, values: &mut NetValues) {
        let mut moments = Moments::default();
        let mut phases = Phases::new();
        for list in [&mut values.real, &mut values.imaginary] {
            list.clear();
            list.resize(self.count, 0.0);
        }
        for (first, panel) in &self.panels {
            let of_wave = *moments.of_wave(k, panel.half);
            let [cosine, sine] = phases.at(k, panel.middle);
            let ends = *first..*first + self.functions;
            let targets = values.real[ends.clone()].iter_mut().zip(&mut values.imaginary[ends]);
            for ((real, imaginary), series) in targets.zip(&panel.series) {
                let [a, b] = oscillation(series, &of_wave, panel.count);
                *real += cosine * a - sine * b;
                *imaginary += cosine * b + sine * a;
            }
        }
        let (sine, cosine) = (k * fore).sin_cos();
        values.real[self.count - 1] -= cosine;
        values.imaginary[self.count - 1] -= sine;
    }
}

/// e^{ikx} at rising x: where steps are equal, products of one factor.
struct Phases {
    x: f64,
    step: f64,
    here: [f64; 2],
    factor: [f64; 2],
}

impl Phases {
    /// At x = 0, after a step of 0.
    fn new() -> Self {
        Self { x: 0.0, step: 0.0, here: [1.0, 0.0], factor: [1.0, 0.0] }
    }

    fn at(&mut self, k: f64, x: f64) -> [f64; 2] {
        let of = |x: f64| {
            let (sine, cosine) = (k * x).sin_cos();
            [cosine, sine]
        };
        let step = x - self.x;
        if (step - self.step).abs() <= SAME_STEP * step.abs() {
            let ([a, b], [c, d]) = (self.here, self.factor);
            self.here = [a * c - b * d, a * d + b * c];
        } else {
            (self.here, self.factor, self.step) = (of(x), of(step), step);
        }
        self.x = x;
        self.here
    }
}

/// The sum of products, in four sums that do not wait for each other.
fn product(a: &[f64], b: &[f64]) -> f64 {
    let (fours, rest) = (a.chunks_exact(4), a.chunks_exact(4).remainder());
    let mut sums = [0.0; 4];
    for (a, b) in fours.zip(b.chunks_exact(4)) {
        sums.iter_mut().zip(a.iter().zip(b)).for_each(|(sum, (a, b))| *sum += a * b);
    }
    let last = b.chunks_exact(4).remainder();
    sums.iter().sum::<f64>() + rest.iter().zip(last).map(|(a, b)| a * b).sum::<f64>()
}

/// A hull whose chart is a rectangle, and the part of it below a waterline.
#[derive(Debug, Clone)]
pub(super) struct NetKochin {
    along: Axis,
    up: Axis,
    /// Control half-breadths, the index of the height runs fastest \[m\].
    breadths: Vec<f64>,
    draught: f64,
    /// x of the fore end, where a bow that is open is closed \[m\].
    fore: f64,
}

/// Room for the values of one evaluation.
#[derive(Debug, Clone, Default)]
pub(super) struct NetValues {
    /// Real parts of G_i.
    pub(super) real: Vec<f64>,
    /// Imaginary parts of G_i.
    pub(super) imaginary: Vec<f64>,
    /// H_j.
    heights: Vec<f64>,
    /// The first of them that does not vanish.
    lowest: usize,
}

impl NetKochin {
    /// None unless stations and waterlines are lines of the net.
    pub(super) fn new(hull: &Hull, draught: f64) -> Option<Self> {
        let heights = hull.heights().filter(|_| hull.is_upright())?;
        let surface = hull.surface();
        let [rows, columns] = surface.shape();
        let lengths = (0..rows).map(|i| [surface.point(i, 0)[0]]).collect();
        let lengths = BsplineCurve::new(surface.u().clone(), lengths).ok()?;
        let top = hull.height_parameter(draught.min(hull.top()))?;
        Some(Self {
            fore: surface.point(rows - 1, 0)[0],
            along: Axis::new(&lengths, true, f64::INFINITY),
            up: Axis::new(heights, false, top),
            breadths: (0..rows * columns).map(|k| surface.point(k / columns, k % columns)[1]).collect(),
            draught,
        })
    }

    /// Number of control values.
    pub(super) fn len(&self) -> usize {
        self.breadths.len()
    }

    /// Adds to one control value.
    #[cfg(test)]
    pub(super) fn change(&mut self, index: usize, by: f64) {
        self.breadths[index] += by;
    }

    /// F at wave number `k` and decay `q`, real and imaginary part [m^2].
    pub(super) fn kochin(&self, k: f64, q: f64, values: &mut NetValues) -> [f64; 2] {
        self.along_values(k, values);
        self.up_values(q, values);
        let mut sums = [0.0; 2];
        let lowest = values.lowest;
        for (row, (real, imaginary)) in
            self.breadths.chunks_exact(self.up.count).zip(values.real.iter().zip(&values.imaginary))
        {
            let breadth = product(&row[lowest..], &values.heights[lowest..]);
            sums[0] += real * breadth;
            sums[1] += imaginary * breadth;
        }
        sums
    }

    /// Adds `factor` times the derivatives of |F|^2 by the control values, at the values of the last evaluation.
    pub(super) fn add_gradient(&self, f: [f64; 2], factor: f64, values: &NetValues, gradient: &mut [f64]) {
        for (row, (real, imaginary)) in
            gradient.chunks_exact_mut(self.up.count).zip(values.real.iter().zip(&values.imaginary))
        {
            let along = 2.0 * factor * (f[0] * real + f[1] * imaginary);
            for (entry, height) in row.iter_mut().zip(&values.heights) {
                *entry += along * height;
            }
        }
    }

    /// G_i H_j at wave number `k` and decay `q`, real and imaginary parts, in the order of the control values.
    pub(super) fn row(&self, k: f64, q: f64, values: &mut NetValues, row: [&mut [f64]; 2]) {
        self.along_values(k, values);
        self.up_values(q, values);
        let [real, imaginary] = row;
        for (list, along) in [(real, &values.real), (imaginary, &values.imaginary)] {
            for (entries, g) in list.chunks_exact_mut(self.up.count).zip(along) {
                entries.iter_mut().zip(&values.heights).for_each(|(entry, h)| *entry = g * h);
            }
        }
    }

    fn along_values(&self, k: f64, values: &mut NetValues) {
        self.along.wave(k, self.fore, values);
    }

    fn up_values(&self, q: f64, values: &mut NetValues) {
        let mut moments = Moments::default();
        values.heights.clear();
        values.heights.resize(self.up.count, 0.0);
        values.lowest = self.up.count;
        for (first, panel) in &self.up.panels {
            let decay = q * (self.draught - panel.middle - panel.half).max(0.0);
            if decay > DEEPEST {
                continue;
            }
            values.lowest = values.lowest.min(*first);
            let factor = panel.half * (-decay).exp();
            let of_decay = moments.of_decay(q, panel.half);
            let targets = values.heights[*first..*first + self.up.functions].iter_mut();
            for (height, series) in targets.zip(&panel.series) {
                *height += factor * series.iter().zip(of_decay).take(panel.count).map(|(c, i)| c * i).sum::<f64>();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From any first place on, over steps that are equal and steps that are not.
    #[test]
    fn phases_are_those_of_their_places() {
        for first in [0.0, -3.0, 2.5] {
            let mut phases = Phases::new();
            for x in [0.0, 0.5, 1.0, 1.5, 4.0, 5.0, 6.0].map(|x| first + x) {
                let ([a, b], (sine, cosine)) = (phases.at(0.7, x), (0.7 * x).sin_cos());
                assert!((a - cosine).abs().max((b - sine).abs()) < 1e-14, "{x}: {a} {b}");
            }
        }
    }
}
