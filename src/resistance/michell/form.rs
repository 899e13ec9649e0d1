//! The wave resistance of level hulls as a quadratic form of the control half-breadths, R_W = c'Gc.
//!
//! F is linear in the control values, whatever the ends rake: at the depth d the waterline is a line v = constant of the net,
//! x(u) its coordinate there, and
//!
//! ```text
//! F = sum over levels d of w_d e^{-q d} sum over i, j of B_j(v_d) int B_i'(u) e^{ikx(u)} du c_ij
//! ```
//!
//! So the integral over the directions of the waves is a sum of squares of linear forms, G = sum of w (a a' + b b').
//! Accuracy: that of the evaluation of [`super::ThinShip`], at the end of the integral where that of the hull settles to 1e-6.

use std::cell::RefCell;

use nalgebra::DMatrix;

use super::super::water::Water;
use super::integral::{OctaveEnd, OctaveWeights, integral};
use super::net::{Axis, NetKochin, NetValues};
use super::waterlines::{NODES, Rings};
use super::{TOLERANCES, factor, immersed_length};
use crate::hull::Hull;
use crate::spline::{BsplineCurve, MAX_DEGREE};

/// Rows of the linear forms that are multiplied at once.
const BATCH: usize = 256;

/// A waterline v = constant with its weight.
#[derive(Debug, Clone)]
struct Level {
    depth: f64,
    weight: f64,
    first: usize,
    heights: [f64; MAX_DEGREE + 1],
    along: Axis,
    fore: f64,
}

#[derive(Debug, Clone)]
enum Rows {
    Net(NetKochin),
    Levels(Rings<Level>),
}

/// A level hull below a waterline, ready for the quadratic forms of any number of speeds.
#[derive(Debug, Clone)]
pub struct WaveForms {
    rows: Rows,
    shape: [usize; 2],
    breadths: Vec<f64>,
    length: f64,
}

/// R_W at one speed around a hull: R_W(c + d) = R_W + g'd + d'Gd over the control values that may change.
#[derive(Debug, Clone)]
pub struct WaveForm {
    /// R_W \[N\].
    pub resistance: f64,
    /// g, by the control values that may change [N/m].
    pub gradient: Vec<f64>,
    /// G, symmetric and positive semidefinite [N/m^2].
    pub form: DMatrix<f64>,
}

impl WaveForms {
    /// None where waterlines are not lines v = constant of the net, or the hull does not reach the draught.
    #[must_use]
    pub fn new(hull: &Hull, draught: f64) -> Option<Self> {
        hull.heights()?;
        hull.takes_draught(draught).ok()?;
        let surface = hull.surface();
        let rows = match NetKochin::new(hull, draught) {
            Some(net) => Rows::Net(net),
            None => {
                // A level that cannot be made would be missing from the sum.
                let rings =
                    Rings::new(draught - hull.bottom(), NODES, |depth, weight| level(hull, draught, depth, weight));
                Rows::Levels(rings.whole()?)
            }
        };
        let breadths = surface.points().iter().map(|point| point[1]).collect();
        Some(Self { rows, shape: surface.shape(), breadths, length: immersed_length(hull) })
    }

    /// The linear form of F at wave number `k` and decay `q`.
    fn row(&self, k: f64, q: f64, values: &mut NetValues, [real, imaginary]: [&mut [f64]; 2]) {
        let rings = match &self.rows {
            Rows::Net(net) => return net.row(k, q, values, [real, imaginary]),
            Rows::Levels(rings) => rings,
        };
        let columns = self.shape[1];
        for level in rings.at(q) {
            let weight = level.weight * (-q * level.depth).exp();
            level.along.wave(k, level.fore, values);
            for (list, along) in [(&mut *real, &values.real), (&mut *imaginary, &values.imaginary)] {
                for (entries, g) in list.chunks_exact_mut(columns).zip(along) {
                    let entries = entries[level.first..].iter_mut();
                    entries.zip(&level.heights).for_each(|(entry, h)| *entry += weight * g * h);
                }
            }
        }
    }

    /// R_W at a speed [m/s] over the control values `free`, by their indices in the net.
    #[must_use]
    pub fn at(&self, speed: f64, water: &Water, free: &[usize]) -> WaveForm {
        let count = self.breadths.len();
        let mut form = DMatrix::zeros(free.len(), free.len());
        let mut gradient = vec![0.0; free.len()];
        if speed <= 0.0 {
            return WaveForm { resistance: 0.0, gradient, form };
        }
        let nu = water.gravity / (speed * speed);
        let mut values = NetValues::default();
        let nodes = RefCell::new(Nodes::default());
        integral(
            nu * self.length,
            TOLERANCES[1],
            |l, weights| {
                let (mut real, mut imaginary) = (vec![0.0; count], vec![0.0; count]);
                self.row(nu * l, nu * l * l, &mut values, [&mut real, &mut imaginary]);
                let f = [&real, &imaginary].map(|row| row.iter().zip(&self.breadths).map(|(a, y)| a * y).sum::<f64>());
                let chosen = [real, imaginary].map(|row| free.iter().map(|&k| row[k]).collect());
                nodes.borrow_mut().add(weights, f, chosen);
                f[0] * f[0] + f[1] * f[1]
            },
            |end| nodes.borrow_mut().end(end),
        );
        let factor = factor(speed, water);
        let mut resistance = 0.0;
        let mut batch = Vec::with_capacity(BATCH * free.len());
        let mut multiply = |batch: &mut Vec<f64>| {
            // One linear form a column.
            let forms = DMatrix::from_column_slice(free.len(), batch.len() / free.len().max(1), batch);
            form.gemm(1.0, &forms, &forms.transpose(), 1.0);
            batch.clear();
        };
        for node in nodes.into_inner().weighted() {
            for (value, row) in node.values.iter().zip(&node.rows) {
                resistance += factor * node.weight * value * value;
                gradient.iter_mut().zip(row).for_each(|(g, a)| *g += 2.0 * factor * node.weight * value * a);
                let size = (factor * node.weight).sqrt();
                batch.extend(row.iter().map(|a| size * a));
            }
            if batch.len() >= BATCH * free.len() {
                multiply(&mut batch);
            }
        }
        multiply(&mut batch);
        WaveForm { resistance, gradient, form }
    }
}

fn level(hull: &Hull, draught: f64, depth: f64, weight: f64) -> Option<Level> {
    let surface = hull.surface();
    let v = hull.height_parameter(draught - depth)?;
    let knots = surface.v();
    let span = knots.find_span(v);
    let first = span - knots.degree();
    let heights = knots.basis(span, v);
    let [rows, columns] = surface.shape();
    let of = |i: usize| {
        let column = |(n, weight): (usize, &f64)| surface.points()[i * columns + first + n][0] * weight;
        [heights[..=knots.degree()].iter().enumerate().map(column).sum::<f64>()]
    };
    let lengths: Vec<[f64; 1]> = (0..rows).map(of).collect();
    let fore = lengths[rows - 1][0];
    let along = Axis::new(&BsplineCurve::new(surface.u().clone(), lengths).ok()?, true, f64::INFINITY);
    Some(Level { depth, weight, first, heights, along, fore })
}

/// A direction of the waves: its weight, the parts of F there and the linear forms that they are of.
struct Node {
    weights: OctaveWeights,
    weight: f64,
    values: [f64; 2],
    rows: [Vec<f64>; 2],
}

/// The nodes of the integral by octaves, with what its end makes of their weights: octaves before the last but one count in
/// full, and with r the factor of the last difference, S + r (S - S') of the last two sums under their windows.
#[derive(Default)]
struct Nodes {
    ended: Vec<Vec<Node>>,
    open: Vec<Node>,
    rest: f64,
}

impl Nodes {
    fn add(&mut self, weights: OctaveWeights, values: [f64; 2], rows: [Vec<f64>; 2]) {
        self.open.push(Node { weights, weight: 0.0, values, rows });
    }

    fn end(&mut self, end: OctaveEnd) {
        self.ended.push(std::mem::take(&mut self.open));
        self.rest = if end.last { end.rest } else { 0.0 };
    }

    fn weighted(mut self) -> Vec<Node> {
        let (count, rest) = (self.ended.len(), self.rest);
        for (octave, nodes) in self.ended.iter_mut().enumerate() {
            for Node { weights, weight, .. } in nodes {
                *weight = match count - octave {
                    1 => (1.0 + rest) * weights.windowed,
                    2 => (1.0 + rest) * weights.full - rest * weights.windowed,
                    _ => weights.full,
                };
            }
        }
        self.ended.into_iter().flatten().collect()
    }
}
