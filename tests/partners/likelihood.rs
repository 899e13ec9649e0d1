//! Chart, anisotropy and weight of greatest restricted likelihood (Patterson & Thompson 1971; Wahba 1985).
//!
//! With M the cells over the net, P the energy, w its weight, k the polynomials that cost no energy and r = rank P,
//!
//! ```text
//! -2 log likelihood = (n - k) log y'Ay - r log w - log det+ P + log det(M'M + wP) - log det X'X,   y'Ay = |y - Mc|^2 + w c'Pc,
//! ```
//!
//! X the polynomials at the cells. With P_ff the energy of the net but for k points g, and N the nets of the
//! polynomials, det+ P = det P_ff det N'N / det^2 N_g; det N'N falls out with that of an orthonormal X.

use std::collections::BTreeMap;
use std::fmt;
use std::rc::Rc;

use loftsman::internals::numeric::SymmetricBand;
use nalgebra::DMatrix;

use super::Table;
use super::net::{Cells, Chart, Fit, Net, ORDER};

/// Steps of the exponent of the weight in a power of ten, its least and its greatest.
const STEPS: i32 = 4;
const EXPONENTS: [i32; 2] = [-10, 3];

const ANISOTROPIES: [f64; 8] = [0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0];
const KEELS: [f64; 6] = [0.0, 0.1, 0.2, 0.3, 0.5, 1.0];
const ENDS: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

/// The surface that was chosen.
pub(super) struct Best {
    pub(super) net: Net,
    chart: Chart,
    anisotropy: f64,
    exponent: f64,
    /// \[m\]
    noise: f64,
}

impl fmt::Display for Best {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Chart { b, c: [fore, aft] } = self.chart;
        let (a, e) = (self.anisotropy, self.exponent);
        write!(f, "b {b} a {a} c {fore} {aft} weight 1e{e} noise {:.3} mm", 1e3 * self.noise)
    }
}

/// One chart with its best weight.
struct Candidate {
    value: f64,
    exponent: i32,
}

/// An energy and log det+ P, but for det N'N.
struct Energy {
    matrix: Rc<SymmetricBand>,
    determinant: f64,
}

struct Search<'a> {
    table: &'a Table,
    cells: Rc<Cells>,
    energies: BTreeMap<usize, Energy>,
    seen: BTreeMap<[usize; 4], Candidate>,
}

/// Exponents a and b of the polynomials t^a s^b that cost no energy.
fn kernel() -> impl Iterator<Item = [usize; 2]> {
    (0..ORDER).flat_map(|a| (0..ORDER - a).map(move |b| [a, b]))
}

fn energy(table: &Table, anisotropy: f64) -> Energy {
    let net = Net::new(table, Chart { b: 0.0, c: [0.0; 2] }, 1);
    let [slow, fast] = net.counts();
    let matrix = net.energy(table, anisotropy);
    // A triangle of control points, which a polynomial of degree 3 cannot all miss.
    let at = |k: usize, count: usize| k * (count - 1) / (ORDER - 1);
    let grounded: Vec<[usize; 2]> = kernel().map(|[a, b]| [at(a, slow), at(b, fast)]).collect();
    let powers = [net.powers(0), net.powers(1)];
    let count = grounded.len();
    let columns: Vec<[usize; 2]> = kernel().collect();
    let minor = DMatrix::from_fn(count, count, |row, column| {
        let ([i, j], [a, b]) = (grounded[row], columns[column]);
        powers[0][a][i] * powers[1][b][j]
    });
    let mut free = matrix.clone();
    for [i, j] in grounded {
        let point = i * fast + j;
        for other in point.saturating_sub(free.width())..=(point + free.width()).min(free.size() - 1) {
            free.add(point, other, f64::from(u8::from(other == point)) - free.get(point, other));
        }
    }
    let determinant = free.factor().map_or(f64::NAN, |factor| factor.log_determinant());
    let determinant = determinant - 2.0 * minor.lu().determinant().abs().ln();
    Energy { matrix: Rc::new(matrix), determinant }
}

/// log det X'X.
fn polynomials(fit: &Fit) -> f64 {
    let places: Vec<[f64; 2]> = fit.cells.cells.iter().map(|[x, z, _]| fit.net.parameters(*x, *z)).collect();
    let columns: Vec<[usize; 2]> = kernel().collect();
    let x = DMatrix::from_fn(places.len(), columns.len(), |row, column| {
        let [a, b] = columns[column].map(|power| power as i32);
        let [s, t] = places[row].map(|t| 2.0 * t - 1.0);
        s.powi(a) * t.powi(b)
    });
    2.0 * x.qr().r().diagonal().iter().map(|r| r.abs().ln()).sum::<f64>()
}

impl Search<'_> {
    fn fit(&mut self, [a, b, c, d]: [usize; 4]) -> (Fit, f64) {
        let table = self.table;
        let energy = self.energies.entry(a).or_insert_with(|| energy(table, ANISOTROPIES[a]));
        let chart = Chart { b: KEELS[b], c: [ENDS[c], ENDS[d]] };
        (Fit::new(Net::new(table, chart, 1), Rc::clone(&self.cells), Rc::clone(&energy.matrix)), energy.determinant)
    }

    /// The weight of greatest likelihood: whole powers of ten, then the steps about the best of them.
    fn candidate(&mut self, key: [usize; 4]) -> Candidate {
        let (fit, determinant) = self.fit(key);
        let fixed = -determinant - polynomials(&fit);
        let free = fit.cells.cells.len() as f64 - kernel().count() as f64;
        let rank = (fit.net.len() - kernel().count()) as f64;
        let value = |exponent: i32| {
            let log = f64::from(exponent) / f64::from(STEPS) * std::f64::consts::LN_10;
            let solved = fit.solve(log.exp(), 0.0)?;
            let form = solved.squares + log.exp() * solved.energy;
            Some(free * form.ln() - rank * log + solved.factor.log_determinant() + fixed)
        };
        let mut best = Candidate { value: f64::INFINITY, exponent: STEPS * EXPONENTS[1] };
        let take = |exponent: i32, best: &mut Candidate| {
            if let Some(value) = value(exponent).filter(|value| *value < best.value) {
                *best = Candidate { value, exponent };
            }
        };
        (EXPONENTS[0]..=EXPONENTS[1]).for_each(|power| take(STEPS * power, &mut best));
        let middle = best.exponent;
        for exponent in (middle - STEPS + 1..middle + STEPS).filter(|e| *e != middle) {
            if (STEPS * EXPONENTS[0]..=STEPS * EXPONENTS[1]).contains(&exponent) {
                take(exponent, &mut best);
            }
        }
        best
    }

    fn value(&mut self, key: [usize; 4]) -> f64 {
        if !self.seen.contains_key(&key) {
            let candidate = self.candidate(key);
            self.seen.insert(key, candidate);
        }
        self.seen[&key].value
    }
}

/// Coordinate descent over the numbers of the chart, three rounds at most: anisotropy, keel, both ends.
pub(super) fn choose(table: &Table) -> Best {
    let cells = Cells::new(table, true);
    let mut search = Search { table, cells, energies: BTreeMap::new(), seen: BTreeMap::new() };
    let mut at = [3, 1, 0, 0];
    for _ in 0..3 {
        let before = at;
        for (k, count) in [ANISOTROPIES.len(), KEELS.len(), ENDS.len(), ENDS.len()].into_iter().enumerate() {
            let mut least = f64::INFINITY;
            let start = at;
            for choice in 0..count {
                let mut key = start;
                key[k] = choice;
                let value = search.value(key);
                if value < least {
                    (least, at) = (value, key);
                }
            }
        }
        if at == before {
            break;
        }
    }
    let exponent = f64::from(search.seen[&at].exponent) / f64::from(STEPS);
    let (fit, _) = search.fit(at);
    let weight = 10f64.powf(exponent);
    let solved = fit.solve(weight, 0.0).expect("it was solved before");
    let free = fit.cells.cells.len() - kernel().count();
    let noise = ((solved.squares + weight * solved.energy) / free as f64).sqrt();
    let [a, b, c, d] = at;
    let chart = Chart { b: KEELS[b], c: [ENDS[c], ENDS[d]] };
    Best { net: fit.with(solved.values), chart, anisotropy: ANISOTROPIES[a], exponent, noise }
}
