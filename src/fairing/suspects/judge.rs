//! How far each cell lies from what its neighbours predict, in units of the local noise.
//!
//! Each direction is a witness. Its predictors are tried at the neighbouring cells too, with the cell in question replaced by
//! its prediction, so that a typing error does not speak for itself: the mean square of their residuals there is the scale of
//! the predictor here. A knuckle or a bilge raises it, or is the same on the neighbouring lines and is taken off (levelled
//! predictors). Local mean squares are moderated by the noise of the whole table with as many degrees of freedom as the table
//! is even (Smyth 2004, "Linear models and empirical Bayes methods"); of the predictors with the smallest scales the one that
//! the value offends least testifies.

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
/// Sum of the weights of [`AROUND`].
const FULL_WEIGHT: f64 = 12.6;
/// Least weight of neighbours that a scale can rest on.
const LEAST_WEIGHT: f64 = 2.0;
/// Predictors that are also taken less the residual of the neighbouring lines.
const LEVELLED: usize = 8;
/// How many predictors of a direction are heard.
const JURY: usize = 3;
/// Predictors with a scale this much above the smallest are not heard (squared).
const HEARD: f64 = 9.0;
/// Variance of a prediction beyond the last neighbour, over what its neighbours show.
const AT_END: f64 = 4.0;
/// The same beside the end of a run.
const NEAR_END: f64 = 1.5;
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
    /// The residual in standard deviations of a normal law: Student's t of the scale's degrees of freedom, brought to normal by
    /// D. L. Wallace's formula (1959), within 1 % for t below 20 and five degrees of freedom or more.
    pub(super) fn score(&self) -> f64 {
        let t = self.residual / self.scale;
        let nu = self.freedom;
        ((nu * (t * t / nu).ln_1p()).sqrt() * (8.0 * nu + 1.0) / (8.0 * nu + 3.0)).copysign(t)
    }
}

const NONE: u32 = u32::MAX;

struct Direction {
    along: Along,
    stencils: Vec<Vec<Option<Stencil>>>,
    /// Gain of each stencil, 0 where there is none: read far oftener than the weights.
    gains: Vec<Vec<f64>>,
    /// The line that a cell lies on.
    line: Vec<u32>,
    /// The two lines beside a cell, with the weights of linear interpolation between them.
    beside: Vec<[(u32, f64); 2]>,
    around: Vec<[u32; AROUND.len()]>,
    /// Whether neighbours lie on both sides: next, and next but one.
    sides: Vec<[bool; 2]>,
    residuals: Vec<Vec<f64>>,
}

/// The judge of a table.
pub(super) struct Judge {
    pub(super) grid: Grid,
    directions: [Direction; 2],
    masked: Vec<bool>,
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
        let mut beside = vec![[(NONE, 0.0); 2]; grid.len()];
        let mut around = vec![[NONE; AROUND.len()]; grid.len()];
        let mut sides = vec![[false; 2]; grid.len()];
        for cell in (0..grid.len()).filter(|&cell| grid.is_given(cell)) {
            let at = |n| grid.coordinate(across(along), n);
            beside[cell] = match [-1, 1].map(|step| grid.shifted(along, cell, 0, step)) {
                [Some(low), Some(high)] => {
                    let share = (at(cell) - at(low)) / (at(high) - at(low));
                    [(index(Some(low)), 1.0 - share), (index(Some(high)), share)]
                }
                [one, other] => [(index(one.or(other)), 1.0), (NONE, 0.0)],
            };
            for (slot, &(steps, lines, _)) in around[cell].iter_mut().zip(&AROUND) {
                *slot = index(grid.shifted(along, cell, steps, lines));
            }
            sides[cell] = [1, 2].map(|far| [-far, far].into_iter().all(|s| grid.shifted(along, cell, s, 0).is_some()));
        }
        let stencils = stencils(grid, along);
        let gain = |stencil: &Option<Stencil>| stencil.as_ref().map_or(0.0, |stencil| stencil.gain);
        let gains = stencils.iter().map(|list| list.iter().map(gain).collect()).collect();
        let line = (0..grid.len())
            .map(|cell| match along {
                Along::Station => index(Some(grid.place(cell).0)),
                Along::Waterline => index(Some(grid.place(cell).1)),
            })
            .collect();
        Self { along, stencils, gains, line, beside, around, sides, residuals: Vec::new() }
    }
}

impl Judge {
    pub(super) fn new(grid: Grid, quantum: f64) -> Self {
        let directions = Along::BOTH.map(|along| Direction::new(&grid, along));
        let masked = vec![false; grid.len()];
        let floor2 = quantum * quantum / 12.0;
        let mut judge = Self { grid, directions, masked, floor2, sigma2: floor2, prior_freedom: 1.0 };
        for direction in &mut judge.directions {
            direction.residuals = vec![vec![0.0; judge.grid.len()]; PREDICTORS.len()];
        }
        (0..judge.grid.len()).for_each(|cell| judge.refresh(cell));
        judge.level();
        judge
    }

    /// The residuals of one cell.
    fn refresh(&mut self, cell: usize) {
        let values = &self.grid.value;
        for direction in &mut self.directions {
            for (residuals, stencils) in direction.residuals.iter_mut().zip(&direction.stencils) {
                if let Some(stencil) = &stencils[cell] {
                    residuals[cell] = values[cell] - stencil.predict(values);
                }
            }
        }
    }

    /// Gives a cell a value, and says whether it stands for the cell or stands in for it.
    pub(super) fn set(&mut self, cell: usize, value: f64, masked: bool) {
        self.grid.value[cell] = value;
        self.masked[cell] = masked;
        let (row, column) = self.grid.place(cell);
        let width = self.grid.z.len();
        (0..width).for_each(|j| self.refresh(row * width + j));
        (0..self.grid.x.len()).for_each(|i| self.refresh(i * width + column));
    }

    pub(super) fn is_masked(&self, cell: usize) -> bool {
        self.masked[cell]
    }

    /// The noise of the table and how even it is: of the predictors the one whose mean squares have the smallest median.
    pub(super) fn level(&mut self) {
        let cells: Vec<usize> = (0..self.grid.len()).filter(|&c| self.grid.is_given(c) && !self.masked[c]).collect();
        let mut best: Option<(f64, f64)> = None;
        for d in 0..2 {
            for p in 0..PREDICTORS.len() {
                let (mut list, mut freedom) = (Vec::with_capacity(cells.len()), 0.0);
                for &cell in &cells {
                    if let Some(w) = self.witness(d, p, false, cell, f64::INFINITY) {
                        list.push((w.scale2 / w.gain + self.floor2).ln());
                        freedom += w.freedom;
                    }
                }
                if list.len() * 2 < cells.len() || list.len() < 8 {
                    continue;
                }
                freedom /= list.len() as f64;
                list.sort_by(f64::total_cmp);
                let quantile = |share: f64| list[((list.len() - 1) as f64 * share) as usize];
                // The logarithm of a mean square of nu normal numbers spreads by about sqrt(2/nu) about its median, which lies
                // 0.7/nu below the logarithm of the mean.
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

    /// The residual at `n` once the cell `c` is less by `e`; `same` says that both are on one line.
    fn residual(&self, d: usize, p: usize, n: usize, c: usize, e: f64) -> Option<f64> {
        let direction = &self.directions[d];
        if direction.gains[p][n] <= 0.0 {
            return None;
        }
        let r = direction.residuals[p][n];
        if n == c {
            return Some(r - e);
        }
        if direction.line[n] != direction.line[c] {
            return Some(r);
        }
        Some(r + direction.stencils[p][n].as_ref()?.weight(c) * e)
    }

    /// The residual and its gain at `n`; levelled less that of the lines beside it.
    fn read(&self, d: usize, p: usize, levelled: bool, n: usize, c: usize, e: f64) -> Option<(f64, f64)> {
        let direction = &self.directions[d];
        let mut r = self.residual(d, p, n, c, e)?;
        let mut gain = direction.gains[p][n];
        if levelled {
            let mut lines = 0;
            for &(m, share) in direction.beside[n].iter().filter(|&&(m, _)| m != NONE) {
                let m = m as usize;
                if self.masked[m] {
                    return None;
                }
                r -= share * self.residual(d, p, m, c, e)?;
                gain += share * share * direction.gains[p][m];
                lines += 1;
            }
            if lines == 0 {
                return None;
            }
        }
        Some((r, gain))
    }

    /// One predictor as a witness, without the table's noise; none when its scale is above `limit`.
    fn witness(&self, d: usize, p: usize, levelled: bool, cell: usize, limit: f64) -> Option<Witness> {
        let (e, gain) = self.read(d, p, levelled, cell, cell, 0.0)?;
        let (mut sum, mut weight, mut square) = (0.0, 0.0, 0.0);
        for (&n, &(_, _, w)) in self.directions[d].around[cell].iter().zip(&AROUND) {
            if n == NONE || self.masked[n as usize] {
                continue;
            }
            let Some((r, other)) = self.read(d, p, levelled, n as usize, cell, e) else { continue };
            let ratio = gain / other;
            let w = w * ratio.min(1.0 / ratio);
            sum += w * r * r * ratio;
            weight += w;
            square += w * w;
            if sum > limit * FULL_WEIGHT {
                return None;
            }
        }
        if weight < LEAST_WEIGHT {
            return None;
        }
        Some(Witness { residual: e, scale2: sum / weight, gain, freedom: INDEPENDENT * weight * weight / square })
    }

    /// What one direction says: of the predictors with the smallest scales the one that the value offends least.
    fn direction(&self, d: usize, cell: usize) -> Option<Witness> {
        let mut best: [Option<Witness>; JURY] = [None; JURY];
        for levelled in [false, true] {
            for p in 0..if levelled { LEVELLED } else { PREDICTORS.len() } {
                // A moderated scale is no smaller than the share of the local one, at worst about a tenth of it.
                let limit = best[JURY - 1].map_or(f64::INFINITY, |w| w.scale2 * (1.0 + self.prior_freedom / 3.0));
                let Some(mut w) = self.witness(d, p, levelled, cell, limit) else { continue };
                let noise = w.gain * self.sigma2;
                w.scale2 = (self.prior_freedom * noise + w.freedom * w.scale2) / (self.prior_freedom + w.freedom);
                w.scale2 = w.scale2.max(w.gain * self.floor2);
                w.freedom += self.prior_freedom;
                let Some(at) = best.iter().position(|b| b.is_none_or(|b| w.scale2 < b.scale2)) else { continue };
                best[at..].rotate_right(1);
                best[at] = Some(w);
            }
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
        Some(Verdict {
            cell,
            residual: (a.residual / pa + b.residual / pb) / weight,
            scale: (own + prediction2).sqrt(),
            uncertainty: prediction2.sqrt(),
            freedom: a.freedom.min(b.freedom),
            witnesses: [a, b],
        })
    }

    /// How much the energy of the two lines through a cell falls when the cell gives way by `e`: sum of r²/gain of the cubic
    /// through four neighbours \[m²\].
    pub(super) fn energy_drop(&self, cell: usize, e: f64) -> f64 {
        let mut sum = 0.0;
        for (d, direction) in self.directions.iter().enumerate() {
            for steps in -3..=3 {
                let Some(n) = self.grid.shifted(direction.along, cell, steps, 0) else { continue };
                let Some(stencil) = &direction.stencils[0][n] else { continue };
                let before = direction.residuals[0][n];
                let after = self.residual(d, 0, n, cell, e).unwrap_or(before);
                sum += (before * before - after * after) / stencil.gain;
            }
        }
        sum
    }
}
