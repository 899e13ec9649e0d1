//! Where a field bends more than elsewhere: the energy with a density rho.
//!
//! ```text
//! E = int int rho sum_k g_k C(4, k) a^(1-2k) (d^4 y / ds^(4-k) dt^k)^2 ds dt,   rho = exp(mean log e) / e
//! ```
//!
//! Here e is what a first field has in the place of the sum, averaged with a Gaussian of some intervals. A field is a
//! random one whose fourth derivatives have the variance e / w. Bow, stern and bilge bend more than a middle body. A field
//! of one variance everywhere is off the offsets at a bulb by what it smooths amidships (Pintore, Speckman and Holmes 2006).

use super::net::{DEGREE, Metric, Net, ORDER, add_block};
use crate::numeric::{SymmetricBand, gauss_legendre};
use nalgebra::DMatrix;

/// Greatest rho, and that of 1 / rho.
const MOST: f64 = 1e4;

/// Places an interval of the table at which rho is known.
const PLACES: f64 = 2.0;

/// Nodes of the rule in each direction of a cell of a net.
const NODES: usize = 4;

/// The factor rho over the unit square.
#[derive(Debug, Clone, PartialEq)]
pub struct Density {
    /// Standard deviation of the Gaussian of its mean, in intervals of the table.
    pub width: f64,
    /// Steps along u and v.
    steps: [usize; 2],
    /// log rho, v fastest.
    values: Vec<f64>,
}

/// A node of a rule along one direction: the place, its weight, the first function that is not zero there, and the
/// derivatives of the functions from it on.
struct Node {
    at: f64,
    weight: f64,
    first: usize,
    orders: [[f64; DEGREE + 1]; ORDER + 1],
}

fn nodes(net: &Net, direction: usize) -> Vec<Node> {
    let knots = &net.knots[direction];
    let rule = gauss_legendre(NODES);
    let node = |(at, weight): (f64, f64)| {
        let span = knots.find_span(at);
        let all = knots.basis_derivatives::<{ ORDER + 1 }>(span, at);
        Node { at, weight, first: span - DEGREE, orders: all.map(|row| std::array::from_fn(|k| row[k])) }
    };
    knots.breakpoints().windows(2).flat_map(|span| rule.on(span[0], span[1])).map(node).collect()
}

impl Density {
    /// That of a field by its control values, with a Gaussian of standard deviation `width`.
    #[must_use]
    pub fn of(net: &Net, metric: Metric, values: &[f64], width: f64) -> Self {
        let (ahead, above) = (nodes(net, 0), nodes(net, 1));
        let (columns, factors) = (net.shape()[1], net.factors(metric));
        let energies = |p: &Node| -> Vec<f64> {
            // What the derivatives by u of the field are in control values along v.
            let lines: [Vec<f64>; ORDER + 1] = std::array::from_fn(|k| {
                let mut line = vec![0.0; columns];
                for (r, b) in p.orders[ORDER - k].iter().enumerate() {
                    let row = &values[(p.first + r) * columns..(p.first + r + 1) * columns];
                    line.iter_mut().zip(row).for_each(|(sum, c)| *sum += b * c);
                }
                line
            });
            let energy = |q: &Node| -> f64 {
                let derivative = |k: usize| -> f64 {
                    q.orders[k].iter().zip(&lines[k][q.first..=q.first + DEGREE]).map(|(b, c)| b * c).sum()
                };
                (0..=ORDER).map(|k| factors[k] * derivative(k).powi(2)).sum()
            };
            above.iter().map(energy).collect()
        };
        let found: Vec<Vec<f64>> = ahead.iter().map(energies).collect();
        let steps = net.intervals.map(|count| (PLACES * count).ceil().max(1.0) as usize);
        let means = |nodes: &[Node], k: usize| -> Vec<Vec<f64>> {
            let row = |step: usize| {
                let at = step as f64 / steps[k] as f64;
                let weight = |node: &Node| {
                    let apart = (node.at - at) * net.intervals[k] / width;
                    node.weight * (-0.5 * apart * apart).exp()
                };
                let weights: Vec<f64> = nodes.iter().map(weight).collect();
                let sum: f64 = weights.iter().sum();
                weights.into_iter().map(|w| w / sum).collect()
            };
            (0..=steps[k]).map(row).collect()
        };
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let up = means(&above, 1);
        let by_height: Vec<Vec<f64>> = found.iter().map(|row| up.iter().map(|mean| dot(mean, row)).collect()).collect();
        let along = means(&ahead, 0);
        let mean =
            |weights: &[f64], j: usize| -> f64 { weights.iter().zip(&by_height).map(|(w, row)| w * row[j]).sum() };
        let mut values: Vec<f64> = along
            .iter()
            .flat_map(|weights| (0..up.len()).map(move |j| (weights, j)))
            .map(|(w, j)| mean(w, j))
            .collect();
        let count = values.len() as f64;
        values.iter_mut().for_each(|e| *e = -e.max(f64::MIN_POSITIVE).ln());
        let middle = values.iter().sum::<f64>() / count;
        values.iter_mut().for_each(|e| *e = (*e - middle).clamp(-MOST.ln(), MOST.ln()));
        Self { width, steps, values }
    }

    /// rho at (u, v), whose logarithm is bilinear between the places at which it is known.
    #[must_use]
    pub fn at(&self, place: [f64; 2]) -> f64 {
        let [(i, s), (j, t)] = [0, 1].map(|k| {
            let at = (place[k] * self.steps[k] as f64).clamp(0.0, self.steps[k] as f64);
            let low = (at as usize).min(self.steps[k] - 1);
            (low, at - low as f64)
        });
        let value = |i: usize, j: usize| self.values[i * (self.steps[1] + 1) + j];
        let along = |j: usize| (1.0 - s) * value(i, j) + s * value(i + 1, j);
        ((1.0 - t) * along(j) + t * along(j + 1)).exp()
    }

    /// Adds the energy of a net with this factor. It is summed along v first, at each u of the rule (sum factorisation; Orszag
    /// 1980).
    pub(super) fn add_energy(&self, net: &Net, metric: Metric, matrix: &mut SymmetricBand) {
        const COUNT: usize = DEGREE + 1;
        const TERMS: usize = NODES * (ORDER + 1);
        let (columns, factors) = (net.shape()[1], net.factors(metric));
        let (ahead, above) = (nodes(net, 0), nodes(net, 1));
        let pairs: Vec<[usize; 2]> = (0..COUNT).flat_map(|a| (0..=a).map(move |b| [a, b])).collect();
        // Of every order the products of the functions along v, with the weight of the node.
        let products: Vec<[[[f64; COUNT]; COUNT]; ORDER + 1]> = above
            .iter()
            .map(|node| {
                node.orders.map(|row| {
                    let run = |l: usize, t: usize| if l + t < COUNT { node.weight * row[l] * row[l + t] } else { 0.0 };
                    std::array::from_fn(|l| std::array::from_fn(|t| run(l, t)))
                })
            })
            .collect();
        for cell in ahead.chunks(NODES) {
            let mut strips = DMatrix::<f64>::zeros(columns * COUNT, TERMS);
            let mut along = DMatrix::<f64>::zeros(TERMS, pairs.len());
            for (p, node) in cell.iter().enumerate() {
                let rho: Vec<f64> = above.iter().map(|other| self.at([node.at, other.at])).collect();
                for k in 0..=ORDER {
                    let term = p * (ORDER + 1) + k;
                    let mut strip = strips.column_mut(term);
                    let (runs, _) = strip.as_mut_slice().as_chunks_mut::<COUNT>();
                    for ((other, product), rho) in above.iter().zip(&products).zip(&rho) {
                        for (run, product) in runs[other.first..other.first + COUNT].iter_mut().zip(&product[k]) {
                            (0..COUNT).for_each(|t| run[t] += rho * product[t]);
                        }
                    }
                    let row = &node.orders[ORDER - k];
                    for (pair, [a, b]) in pairs.iter().enumerate() {
                        along[(term, pair)] = factors[k] * node.weight * row[*a] * row[*b];
                    }
                }
            }
            let blocks = strips * along;
            for ([a, b], block) in pairs.iter().zip(blocks.column_iter()) {
                let (strip, _) = block.as_slice().as_chunks::<COUNT>();
                add_block(matrix, [cell[0].first + a, cell[0].first + b], strip);
            }
        }
    }
}
