//! A quintic tensor spline on a smooth chart, fitted to the cells of a table with an energy of fourth derivatives.

use std::rc::Rc;

use loftsman::internals::numeric::{BandedCholesky, SymmetricBand};
use loftsman::internals::spline::{Gram, KnotVector, add_product, binomial};

use super::Table;

pub(super) const DEGREE: usize = 5;
pub(super) const ORDER: usize = 4;

/// The chart over the rectangle of a table: z = z0 + H ((1 - b) v^2 + b v), x = x0 + L h(u) with the cubic h of end
/// slopes 1 - c. With b = 0 sections leave the keel like a root, with c near 1 waterlines end round.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Chart {
    pub(super) b: f64,
    pub(super) c: [f64; 2],
}

impl Chart {
    /// u of a fraction of the length.
    fn u(&self, s: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..52 {
            let m: f64 = 0.5 * (low + high);
            let h = (1.0 - self.c[0]) * m * (1.0 - m).powi(2) + m * m * (3.0 - 2.0 * m)
                - (1.0 - self.c[1]) * m * m * (1.0 - m);
            if h < s { low = m } else { high = m }
        }
        0.5 * (low + high)
    }

    /// v of a fraction of the height.
    fn v(&self, s: f64) -> f64 {
        2.0 * s / (self.b + (self.b * self.b + 4.0 * (1.0 - self.b) * s).sqrt() + 1e-300)
    }
}

/// The net of a spline over the unit square of a table: its numbering has the shorter direction fastest.
#[derive(Debug, Clone)]
pub(super) struct Net {
    chart: Chart,
    /// First station and lowest waterline, and the size of the rectangle from there \[m\].
    pub(super) origin: [f64; 2],
    pub(super) size: [f64; 2],
    /// Along the ship, across the waterlines.
    knots: [KnotVector; 2],
    /// Which direction is numbered slowly, which fast.
    order: [usize; 2],
    pub(super) values: Vec<f64>,
}

impl Net {
    /// A net with `density` spans a station and a waterline.
    pub(super) fn new(table: &Table, chart: Chart, density: usize) -> Self {
        let size = |list: &[f64]| list[list.len() - 1] - list[0];
        let spans = [table.x.len(), table.z.len()].map(|count| density * count);
        Self::over([table.x[0], table.z[0]], [size(&table.x), size(&table.z)], chart, spans)
    }

    /// A net without values over a rectangle, with these numbers of spans along and across.
    pub(super) fn over(origin: [f64; 2], size: [f64; 2], chart: Chart, spans: [usize; 2]) -> Self {
        let knots = spans.map(|count| KnotVector::uniform(DEGREE, count).unwrap());
        let order = if knots[0].basis_count() < knots[1].basis_count() { [1, 0] } else { [0, 1] };
        Self { chart, origin, size, knots, order, values: Vec::new() }
    }

    /// Numbers of basis functions: slow, fast.
    pub(super) fn counts(&self) -> [usize; 2] {
        self.order.map(|k| self.knots[k].basis_count())
    }

    /// Numbers of spans along and across.
    pub(super) fn spans(&self) -> [usize; 2] {
        [0, 1].map(|k| self.knots[k].basis_count() - DEGREE)
    }

    pub(super) fn len(&self) -> usize {
        self.counts().iter().product()
    }

    fn band(&self) -> SymmetricBand {
        SymmetricBand::zeros(self.len(), DEGREE * self.counts()[1] + DEGREE)
    }

    /// u and v of a place, in the order slow, fast.
    pub(super) fn parameters(&self, x: f64, z: f64) -> [f64; 2] {
        let part = |k: usize, at: f64| ((at - self.origin[k]) / self.size[k]).clamp(0.0, 1.0);
        let uv = [self.chart.u(part(0, x)), self.chart.v(part(1, z))];
        self.order.map(|k| uv[k].clamp(0.0, 1.0))
    }

    /// The basis functions at a place, with their numbers.
    fn row(&self, x: f64, z: f64) -> Vec<(usize, f64)> {
        let at = self.parameters(x, z);
        let [(first, slow), (second, fast)] = [0, 1].map(|k| {
            let knots = &self.knots[self.order[k]];
            let span = knots.find_span(at[k]);
            (span - DEGREE, knots.basis(span, at[k]))
        });
        let count = self.counts()[1];
        let mut row = Vec::with_capacity((DEGREE + 1) * (DEGREE + 1));
        for (i, s) in slow[..=DEGREE].iter().enumerate() {
            row.extend(fast[..=DEGREE].iter().enumerate().map(|(j, f)| ((first + i) * count + second + j, s * f)));
        }
        row
    }

    /// y(x, z).
    pub(super) fn value(&self, x: f64, z: f64) -> f64 {
        self.row(x, z).iter().map(|(k, n)| n * self.values[*k]).sum()
    }

    /// The integral of the squares of all fourth derivatives, each direction in units of an interval of the table, the
    /// heights further by the anisotropy.
    pub(super) fn energy(&self, table: &Table, anisotropy: f64) -> SymmetricBand {
        let scale = [(table.x.len() - 1) as f64, anisotropy * (table.z.len() - 1) as f64];
        let mut energy = self.band();
        let knots = self.order.map(|k| &self.knots[k]);
        for k in 0..=ORDER {
            let orders = [ORDER - k, k];
            let grams = [0, 1].map(|side| Gram::new(knots[side], knots[side], [orders[side]; 2]));
            let power = |side: usize| scale[self.order[side]].powi(1 - 2 * orders[side] as i32);
            let factor = binomial(ORDER, k) * power(0) * power(1);
            add_product(&mut energy, [&grams[0], &grams[1]], factor, knots);
        }
        energy
    }

    /// The net of the polynomials 1, .., t^3 with t = 2u - 1 from -1 to 1 in one direction (0 slow, 1 fast): one row a
    /// power. A control value of t^k is the mean of all products of k of its inner knots.
    pub(super) fn powers(&self, side: usize) -> Vec<Vec<f64>> {
        let knots = &self.knots[self.order[side]];
        let mut powers = vec![Vec::new(); ORDER];
        for i in 0..knots.basis_count() {
            let mut symmetric = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
            for t in &knots.knots()[i + 1..=i + DEGREE] {
                (1..=DEGREE).rev().for_each(|k| symmetric[k] += (2.0 * t - 1.0) * symmetric[k - 1]);
            }
            powers.iter_mut().enumerate().for_each(|(k, row)| row.push(symmetric[k] / binomial(DEGREE, k)));
        }
        powers
    }
}

/// The cells that a net is fitted to: all offsets, and the zeros beside them.
#[derive(Debug)]
pub(super) struct Cells {
    /// x, z, y.
    pub(super) cells: Vec<[f64; 3]>,
}

impl Cells {
    /// Zeros count beside an offset of the same waterline; with `below` those of a waterline without any offset count
    /// under an offset too.
    pub(super) fn new(table: &Table, below: bool) -> Rc<Self> {
        let rows = table.x.len();
        let mut cells = Vec::new();
        for j in 0..table.z.len() {
            let empty = !(0..rows).any(|i| table.full(i, j));
            for i in 0..rows {
                let beside = (i > 0 && table.full(i - 1, j)) || (i + 1 < rows && table.full(i + 1, j));
                let under = below && empty && j + 1 < table.z.len() && table.full(i, j + 1);
                if table.y[i][j].is_finite() && (table.full(i, j) || beside || under) {
                    cells.push([table.x[i], table.z[j], table.y[i][j]]);
                }
            }
        }
        Rc::new(Self { cells })
    }
}

/// A net with the normal equations of its cells.
pub(super) struct Fit {
    pub(super) net: Net,
    pub(super) cells: Rc<Cells>,
    rows: Vec<Vec<(usize, f64)>>,
    /// M'M and M'y.
    pub(super) normal: SymmetricBand,
    right: Vec<f64>,
    pub(super) energy: Rc<SymmetricBand>,
}

/// One weight of the energy.
pub(super) struct Solved {
    pub(super) values: Vec<f64>,
    pub(super) factor: BandedCholesky,
    /// Sum of the squares of the residuals.
    pub(super) squares: f64,
    /// The energy of the net.
    pub(super) energy: f64,
}

impl Fit {
    pub(super) fn new(net: Net, cells: Rc<Cells>, energy: Rc<SymmetricBand>) -> Self {
        let rows: Vec<_> = cells.cells.iter().map(|[x, z, _]| net.row(*x, *z)).collect();
        let (mut normal, mut right) = (net.band(), vec![0.0; net.len()]);
        for (row, [_, _, y]) in rows.iter().zip(&cells.cells) {
            for (k, (i, a)) in row.iter().enumerate() {
                right[*i] += a * y;
                row[..=k].iter().for_each(|(j, b)| normal.add(*i, *j, a * b));
            }
        }
        Self { net, cells, rows, normal, right, energy }
    }

    /// The net of least squares + weight x energy + ridge |values|^2; none where the sum is singular to rounding.
    pub(super) fn solve(&self, weight: f64, ridge: f64) -> Option<Solved> {
        let mut sum = self.normal.plus(weight, &self.energy);
        (0..sum.size()).for_each(|i| sum.add(i, i, ridge));
        let factor = sum.factor().ok()?;
        let mut values = self.right.clone();
        factor.solve(&mut values);
        let residual = |(row, [_, _, y]): (&Vec<(usize, f64)>, &[f64; 3])| {
            (row.iter().map(|(k, a)| a * values[*k]).sum::<f64>() - y).powi(2)
        };
        let squares = self.rows.iter().zip(&self.cells.cells).map(residual).sum();
        let energy = self.energy.apply(&values).iter().zip(&values).map(|(p, c)| p * c).sum();
        Some(Solved { values, factor, squares, energy })
    }

    /// The net with these values.
    pub(super) fn with(self, values: Vec<f64>) -> Net {
        Net { values, ..self.net }
    }
}
