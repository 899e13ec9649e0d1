//! How far each cell lies from what its neighbours predict, in units of the local noise.
//!
//! Each direction is a witness. Its predictors are tried at the neighbouring cells too, with the cell in question
//! replaced by its prediction, so that a typing error does not speak for itself: the mean square of their residuals
//! there is the scale of the predictor here. A knuckle or a bilge raises it, or is the same on the neighbouring lines
//! and is taken off (levelled predictors). Local mean squares are moderated by the noise of the whole table with as
//! many degrees of freedom as the table is even (Smyth 2004, "Linear models and empirical Bayes methods"); of the
//! predictors with the smallest scales the one that the value offends least testifies.

use super::grid::{Along, Grid};
use super::stencil::{PREDICTORS, Stencil, stencils};

/// Neighbours whose residuals say how good a prediction is here: steps along the line, lines across, weight.
const AROUND: [(isize, isize, f64); 22] = [
    (0, -1, 1.0),
    (0, 1, 1.0),
    (-1, 0, 0.7),
    (1, 0, 0.7),
    (0, -2, 0.7),
    (0, 2, 0.7),
    (-1, -1, 0.7),
    (1, -1, 0.7),
    (-1, 1, 0.7),
    (1, 1, 0.7),
    (-2, 0, 0.4),
    (2, 0, 0.4),
    (-2, -1, 0.4),
    (2, -1, 0.4),
    (-2, 1, 0.4),
    (2, 1, 0.4),
    (-1, -2, 0.4),
    (1, -2, 0.4),
    (-1, 2, 0.4),
    (1, 2, 0.4),
    (0, -3, 0.4),
    (0, 3, 0.4),
];
/// Least weight of neighbours that a scale can rest on.
const LEAST_WEIGHT: f64 = 2.0;
/// Predictors that are also taken less the residual of the neighbouring lines.
const LEVELLED: usize = 8;
/// Predictors of a direction, levelled ones after the others.
const ALL: usize = PREDICTORS.len() + LEVELLED;
/// Cells of a table that its noise is taken from; of larger tables so many, evenly spread.
const SAMPLE: usize = 1500;
/// How many predictors of a direction are heard.
const JURY: usize = 3;
/// Predictors with a scale this much above the smallest are not heard (squared).
const HEARD: f64 = 9.0;
/// Variance of a prediction beyond the last neighbour, over what its neighbours show.
const AT_END: f64 = 4.0;
/// The same beside the end of a run.
const NEAR_END: f64 = 1.5;
/// Mean square of what stands in for a cell that is set aside, over that of a prediction beside it: side by side such
/// cells would otherwise confirm each other.
const STAND_IN: f64 = 25.0;
/// Independent residuals among those of overlapping stencils.
const INDEPENDENT: f64 = 0.75;
/// Most degrees of freedom that the table as a whole lends to a cell.
const MOST_FREEDOM: f64 = 50.0;
/// Disagreement of the two directions (chi square) that is not unusual.
const USUAL_CHI2: f64 = 3.0;

/// What one direction says about a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Witness {
    /// Value less prediction \[m\].
    pub(super) residual: f64,
    /// Mean square of the residual where nothing is wrong \[m²\].
    pub(super) scale2: f64,
    /// Noise of the residual over the reading noise, squared.
    pub(super) gain: f64,
    /// How many independent residuals the scale rests on.
    pub(super) freedom: f64,
}

/// What both directions say about a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Verdict {
    pub(super) cell: usize,
    /// Value less prediction \[m\].
    pub(super) residual: f64,
    /// Uncertainty of the residual \[m\]: reading noise and prediction together.
    pub(super) scale: f64,
    /// Uncertainty of the prediction alone \[m\].
    pub(super) uncertainty: f64,
    /// Degrees of freedom of the scale.
    pub(super) freedom: f64,
    /// Along the station, along the waterline.
    pub(super) witnesses: [Witness; 2],
}

impl Verdict {
    /// The residual in standard deviations of a normal law: Student's t of the scale's degrees of freedom, brought to
    /// normal by D. L. Wallace's formula (1959), within 1 % for t below 20 and five degrees of freedom or more.
    pub(super) fn score(&self) -> f64 {
        let t = self.residual / self.scale;
        let nu = self.freedom;
        ((nu * (t * t / nu).ln_1p()).sqrt() * (8.0 * nu + 1.0) / (8.0 * nu + 3.0)).copysign(t)
    }
}

const NONE: u32 = u32::MAX;

/// A number for each predictor.
type Row = [f64; ALL];

struct Direction {
    along: Along,
    stencils: Vec<Vec<Option<Stencil>>>,
    /// The cells beside a cell on the line before and on the line after, with the weights of linear interpolation
    /// between them; weight 0 where there is none.
    beside: Vec<[(u32, f64); 2]>,
    around: Vec<[u32; AROUND.len()]>,
    /// Weight of the cell in the predictions of its neighbours two and one steps before, and one and two steps after.
    lead: Vec<[[f64; PREDICTORS.len()]; 4]>,
    /// Whether neighbours lie on both sides: next, and next but one.
    sides: Vec<[bool; 2]>,
    /// By cell the residuals, their gains (0 where there is no prediction), and the inverse gains.
    residuals: Vec<Row>,
    gains: Vec<Row>,
    inverses: Vec<Row>,
}

/// Sums over the neighbours of a cell by predictor: of weighted squares of residuals, of weights, of squares of weights.
struct Heard {
    sum: Row,
    weight: Row,
    square: Row,
}

/// The judge of a table.
pub(super) struct Judge {
    pub(super) grid: Grid,
    directions: [Direction; 2],
    masked: Vec<bool>,
    /// How many are masked.
    set_aside: usize,
    floor2: f64,
    /// Reading noise and roughness of the table as a whole, squared \[m²\].
    pub(super) sigma2: f64,
    prior_freedom: f64,
}

fn across(along: Along) -> Along {
    match along {
        Along::Station => Along::Waterline,
        Along::Waterline => Along::Station,
    }
}

impl Direction {
    fn new(grid: &Grid, along: Along) -> Self {
        let index = |cell: Option<usize>| cell.and_then(|n| u32::try_from(n).ok()).unwrap_or(NONE);
        let n = grid.len();
        let mut beside = vec![[(NONE, 0.0); 2]; n];
        let mut around = vec![[NONE; AROUND.len()]; n];
        let mut sides = vec![[false; 2]; n];
        let mut lead = vec![[[0.0; PREDICTORS.len()]; 4]; n];
        let stencils = stencils(grid, along);
        for cell in (0..n).filter(|&cell| grid.is_given(cell)) {
            let at = |n| grid.coordinate(across(along), n);
            beside[cell] = match [-1, 1].map(|step| grid.shifted(along, cell, 0, step)) {
                [Some(low), Some(high)] => {
                    let share = (at(cell) - at(low)) / (at(high) - at(low));
                    [(index(Some(low)), 1.0 - share), (index(Some(high)), share)]
                }
                lines => lines.map(|line| (index(line), if line.is_some() { 1.0 } else { 0.0 })),
            };
            for (slot, &(steps, lines, _)) in around[cell].iter_mut().zip(&AROUND) {
                *slot = index(grid.shifted(along, cell, steps, lines));
            }
            sides[cell] = [1, 2].map(|far| [-far, far].into_iter().all(|s| grid.shifted(along, cell, s, 0).is_some()));
            for (weights, step) in lead[cell].iter_mut().zip([-2, -1, 1, 2]) {
                let Some(other) = grid.shifted(along, cell, step, 0) else { continue };
                for (weight, list) in weights.iter_mut().zip(&stencils) {
                    *weight = list[other].as_ref().map_or(0.0, |stencil| stencil.weight(cell));
                }
            }
        }
        let empty = vec![[0.0; ALL]; n];
        Self {
            along,
            stencils,
            beside,
            around,
            lead,
            sides,
            residuals: empty.clone(),
            gains: empty.clone(),
            inverses: empty,
        }
    }

    /// The residuals of one cell.
    fn refresh(&mut self, cell: usize, values: &[f64]) {
        for (p, list) in self.stencils.iter().enumerate() {
            if let Some(stencil) = &list[cell] {
                self.residuals[cell][p] = values[cell] - stencil.predict(values);
                self.gains[cell][p] = stencil.gain;
                self.inverses[cell][p] = stencil.gain.recip();
            }
        }
    }

    /// The levelled residuals of one cell: less those of the lines beside it.
    fn level(&mut self, cell: usize, masked: &[bool]) {
        for p in 0..LEVELLED {
            let (mut r, mut gain) = (self.residuals[cell][p], self.gains[cell][p]);
            let (mut lines, mut whole) = (0, gain > 0.0);
            for &(m, share) in self.beside[cell].iter().filter(|&&(m, _)| m != NONE) {
                let m = m as usize;
                whole &= !masked[m] && self.gains[m][p] > 0.0;
                r -= share * self.residuals[m][p];
                gain += share * share * self.gains[m][p];
                lines += 1;
            }
            let q = PREDICTORS.len() + p;
            let (r, gain) = if whole && lines > 0 { (r, gain) } else { (0.0, 0.0) };
            self.residuals[cell][q] = r;
            self.gains[cell][q] = gain;
            self.inverses[cell][q] = if gain > 0.0 { gain.recip() } else { 0.0 };
        }
    }

    /// What the neighbours of a cell say about the predictors, with the cell replaced by the prediction of each. The
    /// residual at a neighbour on the same line then grows by the weight of the cell in its prediction times the
    /// residual at the cell; a levelled one on a line beside it falls by its share of that.
    fn heard(&self, cell: usize, masked: &[bool]) -> Heard {
        const PLAIN: usize = PREDICTORS.len();
        let mut heard = Heard { sum: [0.0; ALL], weight: [0.0; ALL], square: [0.0; ALL] };
        let (e, gain, inverse) = (&self.residuals[cell], &self.gains[cell], &self.inverses[cell]);
        for (&n, &(steps, lines, w)) in self.around[cell].iter().zip(&AROUND) {
            if n == NONE || masked[n as usize] {
                continue;
            }
            let n = n as usize;
            let mut r = self.residuals[n];
            let lead = match steps {
                -2 => Some(&self.lead[cell][0]),
                -1 => Some(&self.lead[cell][1]),
                1 => Some(&self.lead[cell][2]),
                2 => Some(&self.lead[cell][3]),
                _ => None,
            };
            if let (0, Some(lead)) = (lines, lead) {
                for p in 0..PLAIN {
                    r[p] += lead[p] * e[p];
                }
                for p in 0..LEVELLED {
                    r[PLAIN + p] += lead[p] * e[PLAIN + p];
                }
            } else if lines == 1 || lines == -1 {
                let share = self.beside[n][usize::from(lines < 0)].1;
                for p in 0..LEVELLED {
                    r[PLAIN + p] -= share * lead.map_or(-1.0, |lead| lead[p]) * e[PLAIN + p];
                }
            }
            let (other, inverse_other) = (&self.gains[n], &self.inverses[n]);
            for q in 0..ALL {
                let ratio = gain[q] * inverse_other[q];
                let w = w * ratio.min(inverse[q] * other[q]);
                heard.sum[q] += w * r[q] * r[q] * ratio;
                heard.weight[q] += w;
                heard.square[q] += w * w;
            }
        }
        heard
    }
}

impl Heard {
    /// One predictor as a witness, without the table's noise.
    fn witness(&self, direction: &Direction, q: usize, cell: usize) -> Option<Witness> {
        let (gain, weight) = (direction.gains[cell][q], self.weight[q]);
        (gain > 0.0 && weight >= LEAST_WEIGHT).then(|| Witness {
            residual: direction.residuals[cell][q],
            scale2: self.sum[q] / weight,
            gain,
            freedom: INDEPENDENT * weight * weight / self.square[q],
        })
    }
}

impl Judge {
    pub(super) fn new(grid: Grid, quantum: f64) -> Self {
        let directions = Along::BOTH.map(|along| Direction::new(&grid, along));
        let masked = vec![false; grid.len()];
        let floor2 = quantum * quantum / 12.0;
        let mut judge = Self { grid, directions, masked, set_aside: 0, floor2, sigma2: floor2, prior_freedom: 1.0 };
        for direction in &mut judge.directions {
            (0..judge.grid.len()).for_each(|cell| direction.refresh(cell, &judge.grid.value));
            (0..judge.grid.len()).for_each(|cell| direction.level(cell, &judge.masked));
        }
        judge.level();
        judge
    }

    /// Gives a cell a value, and says whether it stands for the cell or stands in for it.
    pub(super) fn set(&mut self, cell: usize, value: f64, masked: bool) {
        self.grid.value[cell] = value;
        self.set_aside = self.set_aside + usize::from(masked) - usize::from(self.masked[cell]);
        self.masked[cell] = masked;
        let (row, column) = self.grid.place(cell);
        let (rows, width) = (self.grid.x.len(), self.grid.z.len());
        for direction in &mut self.directions {
            let (line, lines, length, step, across) = match direction.along {
                Along::Station => (row, rows, width, 1, width),
                Along::Waterline => (column, width, rows, width, 1),
            };
            for k in 0..length {
                direction.refresh(line * across + k * step, &self.grid.value);
            }
            for beside in line.saturating_sub(1)..(line + 2).min(lines) {
                for k in 0..length {
                    direction.level(beside * across + k * step, &self.masked);
                }
            }
        }
    }

    pub(super) fn is_masked(&self, cell: usize) -> bool {
        self.masked[cell]
    }

    /// The noise of the table and how even it is: of the predictors the one whose mean squares have the smallest median.
    pub(super) fn level(&mut self) {
        let cells: Vec<usize> = (0..self.grid.len()).filter(|&c| self.grid.is_given(c) && !self.masked[c]).collect();
        let cells: Vec<usize> = cells.iter().copied().step_by(1 + cells.len() / SAMPLE).collect();
        let mut best: Option<(f64, f64)> = None;
        for direction in &self.directions {
            let mut lists: [(Vec<f64>, f64); PREDICTORS.len()] = std::array::from_fn(|_| (Vec::new(), 0.0));
            for &cell in &cells {
                let heard = direction.heard(cell, &self.masked);
                for (q, (list, freedom)) in lists.iter_mut().enumerate() {
                    if let Some(w) = heard.witness(direction, q, cell) {
                        list.push((w.scale2 / w.gain + self.floor2).ln());
                        *freedom += w.freedom;
                    }
                }
            }
            for (mut list, freedom) in lists {
                if list.len() * 2 < cells.len() || list.len() < 8 {
                    continue;
                }
                let freedom = freedom / list.len() as f64;
                list.sort_unstable_by(f64::total_cmp);
                let quantile = |share: f64| list[((list.len() - 1) as f64 * share) as usize];
                // The logarithm of a mean square of nu normal numbers spreads by about sqrt(2/nu) about its median,
                // which lies 0.7/nu below the logarithm of the mean.
                let spread = (quantile(0.75) - quantile(0.25)) / 1.349;
                let excess = spread * spread - 2.0 / freedom;
                let prior = (2.0 / excess.max(2.0 / MOST_FREEDOM)).max(0.2);
                let median = quantile(0.5).exp() * (1.0 + 0.7 / freedom);
                if best.is_none_or(|(sigma2, _)| median < sigma2) {
                    best = Some((median, prior));
                }
            }
        }
        if let Some((sigma2, prior)) = best {
            self.sigma2 = sigma2.max(self.floor2);
            self.prior_freedom = prior;
        }
    }

    /// How much greater the mean square of a prediction is for what it takes from cells that are set aside: 1 +
    /// STAND_IN sum w^2.
    fn doubt(&self, d: usize, q: usize, cell: usize) -> f64 {
        if self.set_aside == 0 {
            return 1.0;
        }
        let predictor = if q < PREDICTORS.len() { q } else { q - PREDICTORS.len() };
        let stencil = self.directions[d].stencils[predictor][cell].as_ref();
        let taken = stencil.into_iter().flat_map(Stencil::iter).filter(|&(other, _)| self.masked[other]);
        1.0 + STAND_IN * taken.map(|(_, weight)| weight * weight).sum::<f64>()
    }

    /// What one direction says: of the predictors with the smallest scales the one that the value offends least.
    fn direction(&self, d: usize, cell: usize) -> Option<Witness> {
        let mut best: [Option<Witness>; JURY] = [None; JURY];
        let heard = self.directions[d].heard(cell, &self.masked);
        for q in 0..ALL {
            let Some(mut w) = heard.witness(&self.directions[d], q, cell) else { continue };
            let noise = w.gain * self.sigma2;
            w.scale2 = (self.prior_freedom * noise + w.freedom * w.scale2) / (self.prior_freedom + w.freedom);
            w.scale2 = w.scale2.max(w.gain * self.floor2) * self.doubt(d, q, cell);
            w.freedom += self.prior_freedom;
            let Some(at) = best.iter().position(|b| b.is_none_or(|b| w.scale2 < b.scale2)) else { continue };
            best[at..].rotate_right(1);
            best[at] = Some(w);
        }
        let offence = |w: &Witness| w.residual * w.residual / w.scale2;
        let limit = HEARD * best[0]?.scale2;
        let heard = best.into_iter().flatten().filter(|w| w.scale2 <= limit);
        let mut w = heard.min_by(|a, b| offence(a).total_cmp(&offence(b)))?;
        match self.directions[d].sides[cell] {
            [false, _] => w.scale2 *= AT_END,
            [true, false] => w.scale2 *= NEAR_END,
            [true, true] => {}
        }
        Some(w)
    }

    /// What both directions say; none where one of them cannot say anything.
    pub(super) fn verdict(&self, cell: usize) -> Option<Verdict> {
        if !self.grid.is_given(cell) {
            return None;
        }
        let [a, b] = [self.direction(0, cell)?, self.direction(1, cell)?];
        let own = (a.scale2 / a.gain).min(b.scale2 / b.gain);
        let [pa, pb] = [a, b].map(|w| (w.scale2 - own).max(0.1 * w.scale2));
        let weight = 1.0 / pa + 1.0 / pb;
        let gap = a.residual - b.residual;
        let chi2 = gap * gap / (pa + pb);
        let prediction2 = (chi2 / USUAL_CHI2).max(1.0) / weight;
        // Degrees of freedom of the sum of two variances, each 1/p over the square of the sum of weights (Satterthwaite
        // 1946).
        let [va, vb] = [1.0 / pa, 1.0 / pb];
        let freedom = (va + vb).powi(2) / (va * va / a.freedom + vb * vb / b.freedom);
        Some(Verdict {
            cell,
            residual: (a.residual / pa + b.residual / pb) / weight,
            scale: (own + prediction2).sqrt(),
            uncertainty: prediction2.sqrt(),
            freedom,
            witnesses: [a, b],
        })
    }

    /// How much the energy of the two lines through a cell falls when the cell gives way by `e`: sum of r²/gain of the
    /// cubic through four neighbours \[m²\].
    pub(super) fn energy_drop(&self, cell: usize, e: f64) -> f64 {
        let mut sum = 0.0;
        for direction in &self.directions {
            for steps in -3..=3 {
                let Some(n) = self.grid.shifted(direction.along, cell, steps, 0) else { continue };
                let Some(stencil) = &direction.stencils[0][n] else { continue };
                let before = direction.residuals[n][0];
                let after = before + e * if n == cell { -1.0 } else { stencil.weight(cell) };
                sum += (before * before - after * after) / stencil.gain;
            }
        }
        sum
    }
}
