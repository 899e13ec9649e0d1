//! The wave resistance of level hulls as a quadratic form of the control half-breadths, R_W = c'Gc = |R'c|^2.
//!
//! F is linear in the control values, whatever the ends rake: at the depth d the waterline is a line v = constant of the net,
//! x(u) its coordinate there, and
//!
//! ```text
//! F = sum over levels d of w_d e^{-q d} sum over i, j of B_j(v_d) int B_i'(u) e^{ikx(u)} du c_ij
//! ```
//!
//! So the integral over the directions of the waves is a sum of squares of linear forms, G = sum of w (a a' + b b'), of which
//! [`super::roots`] leaves few.
//! Accuracy: that of the evaluation of [`super::ThinShip`], at the end of the integral where that of the hull settles to 1e-6.

use std::cell::RefCell;

use super::super::water::Water;
use super::integral::{OctaveEnd, OctaveWeights, integral};
use super::net::{NetKochin, NetValues};
use super::roots::roots;
use super::waterlines::{NODES, Rings};
use super::{TOLERANCES, factor, immersed_length};
use crate::hull::Hull;
use crate::numeric::gauss_legendre;
use crate::spline::{KnotVector, MAX_DEGREE};

/// A waterline v = constant with its weight.
#[derive(Debug, Clone)]
struct Level {
    depth: f64,
    weight: f64,
    first: usize,
    heights: [f64; MAX_DEGREE + 1],
    /// Control values of x along it \[m\].
    lengths: Vec<f64>,
}

#[derive(Debug, Clone)]
enum Rows {
    Net(NetKochin),
    Levels(Rings<Level>),
}

/// Gauss rules over the spans of u, for integrals of B_i'(u) e^{ikx(u)}.
struct Mesh {
    /// Nodes of a span.
    count: usize,
    /// The first basis function of each node, the basis there, and its slopes times the weight.
    nodes: Vec<(usize, [[f64; MAX_DEGREE + 1]; 2])>,
}

/// A level hull below a waterline, ready for the quadratic forms of any number of speeds.
#[derive(Debug, Clone)]
pub struct WaveForms {
    rows: Rows,
    shape: [usize; 2],
    breadths: Vec<f64>,
    length: f64,
    along: KnotVector,
    /// Half of the longest span on any waterline \[m\].
    half_span: f64,
}

/// R_W at one speed around a hull: R_W(c + d) = R_W + g'd + |R'd|^2 over the control values that may change.
#[derive(Debug, Clone)]
pub struct WaveForm {
    /// R_W \[N\].
    pub resistance: f64,
    /// g, by the control values that may change [N/m].
    pub gradient: Vec<f64>,
    /// Columns of R [N^1/2/m].
    pub roots: Vec<Vec<f64>>,
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
        let along = surface.u().clone();
        let half_span = half_span(hull);
        Some(Self { rows, shape: surface.shape(), breadths, length: immersed_length(hull), along, half_span })
    }

    /// The linear form of F at wave number `k` and decay `q`.
    fn row(&self, k: f64, q: f64, (mesh, values): (&mut Mesh, &mut NetValues), [real, imaginary]: [&mut [f64]; 2]) {
        let rings = match &self.rows {
            Rows::Net(net) => return net.row(k, q, values, [real, imaginary]),
            Rows::Levels(rings) => rings,
        };
        let columns = self.shape[1];
        mesh.follow(k * self.half_span, &self.along);
        for level in rings.at(q) {
            let weight = level.weight * (-q * level.depth).exp();
            mesh.wave(k, &level.lengths, values);
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
        let mut gradient = vec![0.0; free.len()];
        if speed <= 0.0 {
            return WaveForm { resistance: 0.0, gradient, roots: Vec::new() };
        }
        let nu = water.gravity / (speed * speed);
        let (mut mesh, mut values) = (Mesh { count: 0, nodes: Vec::new() }, NetValues::default());
        let nodes = RefCell::new(Nodes::default());
        integral(
            nu * self.length,
            TOLERANCES[1],
            |l, weights| {
                let (mut real, mut imaginary) = (vec![0.0; count], vec![0.0; count]);
                self.row(nu * l, nu * l * l, (&mut mesh, &mut values), [&mut real, &mut imaginary]);
                let f = [&real, &imaginary].map(|row| row.iter().zip(&self.breadths).map(|(a, y)| a * y).sum::<f64>());
                let chosen = [real, imaginary].map(|row| free.iter().map(|&k| row[k]).collect());
                nodes.borrow_mut().add(weights, f, chosen);
                f[0] * f[0] + f[1] * f[1]
            },
            |end| nodes.borrow_mut().end(end),
        );
        let factor = factor(speed, water);
        let mut resistance = 0.0;
        let mut forms = Vec::new();
        for node in nodes.into_inner().weighted() {
            let weight = factor * node.weight;
            for (value, mut row) in node.values.into_iter().zip(node.rows) {
                resistance += weight * value * value;
                gradient.iter_mut().zip(&row).for_each(|(g, a)| *g += 2.0 * weight * value * a);
                row.iter_mut().for_each(|a| *a *= weight.sqrt());
                forms.push(row);
            }
        }
        WaveForm { resistance, gradient, roots: roots(&forms) }
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
        heights[..=knots.degree()].iter().enumerate().map(column).sum::<f64>()
    };
    Some(Level { depth, weight, first, heights, lengths: (0..rows).map(of).collect() })
}

/// Half of the longest span of u on any waterline \[m\], at most: x is a mean of the lines of its control values.
fn half_span(hull: &Hull) -> f64 {
    let surface = hull.surface();
    let (knots, [rows, columns]) = (surface.u(), surface.shape());
    let x = |j: usize, u: f64| {
        let span = knots.find_span(u);
        let first = span - knots.degree();
        let basis = knots.basis(span, u);
        (first..rows.min(span + 1)).zip(&basis).map(|(i, b)| surface.point(i, j)[0] * b).sum::<f64>()
    };
    let of = |span: usize| {
        let ends = [span, span + 1].map(|k| knots.knots()[k]);
        (0..columns).map(|j| x(j, ends[1]) - x(j, ends[0])).fold(0.0, f64::max)
    };
    0.5 * knots.spans().into_iter().map(of).fold(0.0, f64::max)
}

impl Mesh {
    /// Nodes for phases of `theta` over half a span: the rule of n nodes leaves Bessel functions of the order 2 n - degree, which are
    /// below 1e-10 beyond theta + 9 theta^(1/3).
    fn follow(&mut self, theta: f64, knots: &KnotVector) {
        let order = theta + 9.0 * theta.cbrt() + 1.0 + knots.degree() as f64;
        let least = (0.5 * order).ceil() as usize;
        if least <= self.count && 2 * least > self.count {
            return;
        }
        self.count = least + least / 4 + 2;
        self.nodes.clear();
        for span in knots.spans() {
            let [from, to] = [knots.knots()[span], knots.knots()[span + 1]];
            for (u, weight) in gauss_legendre(self.count).on(from, to) {
                let [basis, slopes] = knots.basis_derivatives::<2>(span, u);
                self.nodes.push((span - knots.degree(), [basis, slopes.map(|slope| weight * slope)]));
            }
        }
    }

    /// int B_i'(u) e^{ikx(u)} du for the x of these control values; a flat bow falls to the centreplane at the last.
    fn wave(&self, k: f64, lengths: &[f64], values: &mut NetValues) {
        for list in [&mut values.real, &mut values.imaginary] {
            list.clear();
            list.resize(lengths.len(), 0.0);
        }
        for (first, [basis, slopes]) in &self.nodes {
            let x: f64 = lengths[*first..].iter().zip(basis).map(|(x, b)| x * b).sum();
            let (sine, cosine) = (k * x).sin_cos();
            let targets = values.real[*first..].iter_mut().zip(&mut values.imaginary[*first..]);
            for ((real, imaginary), slope) in targets.zip(slopes) {
                *real += cosine * slope;
                *imaginary += sine * slope;
            }
        }
        if let Some(&fore) = lengths.last() {
            let (sine, cosine) = (k * fore).sin_cos();
            values.real[lengths.len() - 1] -= cosine;
            values.imaginary[lengths.len() - 1] -= sine;
        }
    }
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
