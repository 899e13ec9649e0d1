//! A smoother that knows nothing of ships: x and the root of z, two spans an interval, one weight by generalised
//! cross-validation (Craven & Wahba 1979) in which a degree of freedom counts 1.2 times.

use std::rc::Rc;

use super::Table;
use super::net::{Cells, Chart, Fit, Net};

const GAMMA: f64 = 1.2;
/// x, and the root of z.
pub(super) const CHART: Chart = Chart { b: 0.0, c: [0.0; 2] };

const RIDGE: f64 = 1e-12;

/// The net and the exponent of its weight.
pub(super) fn cross_validated(table: &Table) -> (Net, f64) {
    let net = Net::new(table, CHART, 2);
    let energy = Rc::new(net.energy(table, 1.0));
    let fit = Fit::new(net, Cells::new(table, false), energy);
    let count = fit.cells.cells.len() as f64;
    let mut best: Option<(f64, f64, Vec<f64>)> = None;
    for k in 0..=16 {
        let exponent = 0.5 * f64::from(k) - 7.0;
        let Some(solved) = fit.solve(10f64.powf(exponent), RIDGE) else { continue };
        let freedom = solved.factor.inverse_band().trace_of_product(&fit.normal);
        let left = count - GAMMA * freedom;
        let score = if left <= 0.0 { f64::INFINITY } else { solved.squares / (left * left) };
        if best.as_ref().is_none_or(|(least, ..)| score < *least) {
            best = Some((score, exponent, solved.values));
        }
    }
    let (_, exponent, values) = best.expect("the energy and the cells determine the net");
    (fit.with(values), exponent)
}
