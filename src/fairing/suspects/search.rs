//! The search for suspects: the strongest first, each set aside before the next is looked for, all of them heard again.
//!
//! How much evidence a cell needs depends on the rest of its table (empirical Bayes). With n offsets and beliefs b_k in
//! the other suspects the share of wrong cells is taken as
//!
//!   a = (UNFOUND + sum b_k + FURTHER (1 - prod (1 - b_k))) / n,
//!
//! so that a table in which nothing is certain needs odds of n/UNFOUND from the cell alone, and one with a certain
//! error a few hundred times less. A belief is the probability from the cell's own evidence, discounted by WITNESS. The
//! price: the only error of a table has to be larger to be found than one among several. The three constants were
//! chosen on seeded tables with planted errors (tests/suspects.rs says how), not derived.

use super::grid::{Along, Grid};
use super::judge::{Judge, Verdict};
use super::posterior::{Reading, readings, student, weighed};
use super::reading::{Hypothesis, Writing, bare, repairs};
use crate::hull::OffsetTable;
use crate::numeric::median;

/// Least score of a suspect, in standard deviations of a normal law.
const LEAST_SCORE: f64 = 3.0;
/// Least probability that a suspect is wrong.
const LEAST_PROBABILITY: f64 = 0.6;
/// Wrong cells that a table is expected to have before any has been found in it. It stands well below what misprints
/// alone would say: what looks like the only error of a table is oftener a feature of the hull that no predictor
/// follows.
const UNFOUND: f64 = 0.002;
/// Wrong cells that are expected besides those found once one is certain.
const FURTHER: f64 = 1.0;
/// How much stronger the evidence for a suspect must be before it speaks for errors elsewhere.
const WITNESS: f64 = 30.0;
/// Score from which a cell throws a shadow on its neighbours, which are not looked at before it has been dealt with.
const SHADOW_SCORE: f64 = 2.5;
/// Reach of the shadow along the lines.
const SHADOW: usize = 4;
/// Most suspects of a table, as a share of its cells; more are no misprints.
const MOST: f64 = 0.1;
/// Least fall of the cost for which a suspect is exchanged for a neighbour.
const EXCHANGED: f64 = 1.5;
/// Neighbours for which a suspect may be exchanged: steps along the station, stations across.
const EXCHANGES: [(isize, isize); 12] =
    [(0, 1), (0, -1), (1, 0), (-1, 0), (0, 2), (0, -2), (2, 0), (-2, 0), (1, 1), (1, -1), (-1, 1), (-1, -1)];
/// Cells before one that make a straight run which goes on to it, and how far they may be off their chord, in steps of
/// the writing: what rounding does.
const STRAIGHT: isize = 3;
const STEP: f64 = 0.5 + 1e-6;
/// Reach along the lines, and the lines beside, of the cells that an exchange is judged by.
const REACH: isize = 3;

/// What the neighbours of a cell say about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellVerdict {
    /// What the neighbours predict \[m\].
    pub expected: f64,
    /// Standard uncertainty of the prediction \[m\].
    pub uncertainty: f64,
    /// Local noise \[m\]: standard deviation of (value - prediction) where nothing is wrong.
    pub noise: f64,
    /// (value - prediction) over the local noise, brought to a normal law for the few neighbours that the noise rests on.
    pub score: f64,
    /// What the neighbours on the station predict, and its uncertainty \[m\].
    pub along_station: [f64; 2],
    /// What the neighbours on the waterline predict, and its uncertainty \[m\].
    pub along_waterline: [f64; 2],
}

/// A cell that stands out.
#[derive(Debug, Clone, PartialEq)]
pub struct Suspect {
    /// `S1` is the most severe.
    pub id: String,
    /// Index of the station in the table.
    pub station: usize,
    /// Index of the waterline in the table.
    pub waterline: usize,
    /// The cell as written.
    pub written: String,
    /// Its half-breadth \[m\].
    pub value: f64,
    /// What its neighbours say.
    #[doc(hidden)]
    pub verdict: CellVerdict,
    /// The hypotheses, most probable first; probabilities sum to one.
    #[doc(hidden)]
    pub readings: Vec<Reading>,
    /// Probability that the cell is wrong.
    pub probability: f64,
    /// Value of the most probable hypothesis that holds the cell for wrong, in the quantum of the table \[m\].
    pub proposed: f64,
    /// The cell as it would be written, with its marks.
    pub proposed_text: String,
}

impl Suspect {
    /// The most probable hypothesis that holds the cell for wrong.
    #[must_use]
    pub fn hypothesis(&self) -> Hypothesis {
        self.readings.iter().map(|r| r.hypothesis).find(|&h| h != Hypothesis::Noise).unwrap_or(Hypothesis::Unexplained)
    }
}

/// The suspects of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Suspects {
    /// Noise of the table \[m\]: standard deviation of an offset from a smooth neighbourhood; reading noise and
    /// roughness.
    pub noise: f64,
    /// The suspects, most severe first.
    pub suspects: Vec<Suspect>,
    /// By station and waterline: what the neighbours say once the suspects are set aside; none where too few neighbours
    /// speak.
    #[doc(hidden)]
    pub verdicts: Vec<Vec<Option<CellVerdict>>>,
}

/// Rounds of search and second hearing.
const ROUNDS: usize = 3;
/// Sweeps in which cells that are set aside together get their predictions.
const SWEEPS: usize = 3;
/// Distance from the median of the simplest predictions, over its usual size around, from which a cell is set aside
/// before the search begins.
const GROSS: f64 = 4.0;

/// Cells that lie far off the median of six predictions by straight lines: between and beyond the neighbours in both
/// directions. One wrong neighbour spoils two or three of the six only, so that wrong cells side by side do not hide
/// each other.
fn gross(grid: &Grid, noise: f64, most: usize) -> Vec<usize> {
    let mut offs: Vec<Option<f64>> = vec![None; grid.len()];
    for (cell, off) in offs.iter_mut().enumerate().filter(|&(cell, _)| grid.is_given(cell)) {
        let mut list = Vec::with_capacity(6);
        for along in Along::BOTH {
            let at = grid.coordinate(along, cell);
            for [one, other] in [[-1, 1], [-1, -2], [1, 2]] {
                if let (Some(a), Some(b)) = (grid.shifted(along, cell, one, 0), grid.shifted(along, cell, other, 0)) {
                    let (s, t) = (grid.coordinate(along, a), grid.coordinate(along, b));
                    let share = (at - s) / (t - s);
                    list.push(grid.value[cell] - grid.value[a] - share * (grid.value[b] - grid.value[a]));
                }
            }
        }
        *off = median(&mut list).filter(|_| list.len() >= 3);
    }
    let mut found = Vec::new();
    for cell in 0..grid.len() {
        let Some(off) = offs[cell] else { continue };
        let mut around: Vec<f64> = (-2..=2)
            .flat_map(|steps| (-2..=2).map(move |lines| (steps, lines)))
            .filter(|&place| place != (0, 0))
            .filter_map(|(steps, lines)| grid.shifted(Along::Station, cell, steps, lines))
            .filter_map(|n| offs[n].map(f64::abs))
            .collect();
        let usual = median(&mut around).map_or(f64::INFINITY, |m| 1.48 * m + noise);
        if off.abs() > GROSS * usual {
            found.push((off.abs() / usual, cell));
        }
    }
    found.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    found.into_iter().take(most).map(|(_, cell)| cell).collect()
}

struct Search<'a> {
    table: &'a OffsetTable,
    judge: Judge,
    written: Vec<f64>,
    texts: Vec<String>,
    writing: Writing,
    quantum: f64,
    verdicts: Vec<Option<Verdict>>,
    /// Probability that a cell that is set aside is wrong; 0 for all others.
    beliefs: Vec<f64>,
    /// How many cells have an offset.
    given: f64,
}

/// The suspects among the half-breadths of a table; nothing is changed.
#[must_use]
pub fn suspects(table: &OffsetTable) -> Suspects {
    let quantum = table.form.quantum().unwrap_or(1e-4);
    let writing = Writing::of(&table.form);
    let grid = Grid::new(table);
    let texts = table
        .stations
        .iter()
        .flat_map(|station| (0..table.waterlines.len()).map(|j| station.half_breadths.get(j)))
        .map(|cell| {
            cell.map_or(String::new(), |cell| match (&cell.written, cell.value()) {
                (Some(written), _) => written.text.trim().to_owned(),
                (None, Some(value)) => writing.write(value),
                (None, None) => String::new(),
            })
        })
        .collect();
    let written = grid.value.clone();
    let verdicts = vec![None; written.len()];
    let beliefs = vec![0.0; written.len()];
    let given = (0..grid.len()).filter(|&cell| grid.is_given(cell)).count().max(1) as f64;
    let judge = Judge::new(grid, quantum);
    let mut search = Search { table, judge, written, texts, writing, quantum, verdicts, beliefs, given };
    let found = search.run();
    search.conclude(found)
}

impl Search<'_> {
    fn hear(&mut self) {
        for cell in 0..self.written.len() {
            self.verdicts[cell] = if self.judge.is_masked(cell) { None } else { self.judge.verdict(cell) };
        }
    }

    /// Hears again the cells that a change of `cell` reaches.
    fn hear_around(&mut self, cell: usize) {
        let (row, column) = self.judge.grid.place(cell);
        for other in 0..self.written.len() {
            let (i, j) = self.judge.grid.place(other);
            let (di, dj) = (i.abs_diff(row), j.abs_diff(column));
            if di.max(dj) <= 11 && di.min(dj) <= 5 {
                self.verdicts[other] = if self.judge.is_masked(other) { None } else { self.judge.verdict(other) };
            }
        }
    }

    /// Kinds of neighbours whose text the cell repeats.
    fn copies(&self, cell: usize) -> Vec<Hypothesis> {
        // Where the text goes on beyond the neighbour it is a flat of the hull and no copy.
        let same = |along: Along, step: isize| {
            let text = |far: isize| self.judge.grid.shifted(along, cell, far * step, 0).map(|other| &self.texts[other]);
            text(1) == Some(&self.texts[cell]) && text(2) != Some(&self.texts[cell])
        };
        let kinds =
            [(Along::Station, Hypothesis::NeighbouringWaterline), (Along::Waterline, Hypothesis::NeighbouringStation)];
        kinds
            .into_iter()
            .filter(|&(along, _)| [-1, 1].into_iter().any(|step| same(along, step)))
            .map(|(_, kind)| kind)
            .collect()
    }

    fn weighed(&self, verdict: &Verdict) -> Vec<Reading> {
        let cell = verdict.cell;
        let list = repairs(&self.texts[cell], self.writing);
        let wrong = (self.expected_elsewhere(cell) / self.given).min(MOST);
        weighed(verdict, self.written[cell], &self.texts[cell], &list, &self.copies(cell), self.quantum, wrong)
    }

    fn readings(&self, verdict: &Verdict) -> Vec<Reading> {
        readings(self.weighed(verdict))
    }

    /// Wrong cells that the rest of the table makes likely: UNFOUND, those found, and FURTHER when any of them is one.
    fn expected_elsewhere(&self, cell: usize) -> f64 {
        let others =
            || self.beliefs.iter().enumerate().filter(|&(other, &b)| other != cell && b > 0.0).map(|(_, &b)| b);
        let none: f64 = others().map(|belief| 1.0 - belief).product();
        UNFOUND + others().sum::<f64>() + FURTHER * (1.0 - none)
    }

    /// Probability that a cell is wrong, from its verdict and from what else has been found.
    fn probability(&self, verdict: &Verdict) -> f64 {
        let list = self.readings(verdict);
        1.0 - list.iter().find(|r| r.hypothesis == Hypothesis::Noise).map_or(0.0, |r| r.probability)
    }

    /// What a suspect says for errors elsewhere in the table: its probability on its own evidence, with odds a further
    /// WITNESS lower, so that features of the hull do not vouch for each other.
    fn belief(&self, verdict: &Verdict) -> f64 {
        let p = self.probability(verdict);
        let odds = p / (1.0 - p).max(1e-12) * UNFOUND / self.expected_elsewhere(verdict.cell) / WITNESS;
        odds / (1.0 + odds)
    }

    /// Whether the cell is in line with the three before it on one side, to the writing: a wall or a panel goes on to
    /// it and ends there, which says nothing against it.
    fn ends_a_straight_run(&self, cell: usize) -> bool {
        let grid = &self.judge.grid;
        let sides = Along::BOTH.into_iter().flat_map(|along| [(along, -1), (along, 1)]);
        sides.into_iter().any(|(along, step)| {
            let places: Option<Vec<(f64, f64)>> = (0..=STRAIGHT)
                .map(|far| {
                    let other = grid.shifted(along, cell, far * step, 0)?;
                    let value = self.written[other];
                    let counts = value > 0.0 && (other == cell || !self.judge.is_masked(other));
                    counts.then(|| (grid.coordinate(along, other), value))
                })
                .collect();
            places.is_some_and(|places| {
                let [(a, first), .., (b, last)] = places[..] else { return false };
                let chord = |t: f64| first + (last - first) * (t - a) / (b - a);
                places.iter().all(|&(t, value)| (value - chord(t)).abs() <= STEP * self.quantum)
            })
        })
    }

    /// Whether the verdict makes the cell a suspect.
    fn stands_out(&self, verdict: &Verdict) -> bool {
        if verdict.score().abs() < LEAST_SCORE || self.ends_a_straight_run(verdict.cell) {
            return false;
        }
        self.probability(verdict) >= LEAST_PROBABILITY
    }

    /// The suspect to set aside next: of those that stand out the one whose yielding takes most energy off its lines,
    /// unless it lies in the shadow of another.
    fn next(&self) -> Option<Verdict> {
        let mut order: Vec<(f64, Verdict)> = self
            .verdicts
            .iter()
            .flatten()
            .filter(|v| v.score().abs() >= SHADOW_SCORE)
            .map(|v| (self.judge.energy_drop(v.cell, v.residual), *v))
            .collect();
        order.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (k, (_, verdict)) in order.iter().enumerate() {
            let (i, j) = self.judge.grid.place(verdict.cell);
            let shaded = order[..k].iter().any(|(_, other)| {
                let (row, column) = self.judge.grid.place(other.cell);
                (i == row && j.abs_diff(column) <= SHADOW) || (j == column && i.abs_diff(row) <= SHADOW)
            });
            if !shaded && self.stands_out(verdict) {
                return Some(*verdict);
            }
        }
        // In the shadow of what does not stand out.
        order.iter().map(|(_, v)| *v).find(|v| self.stands_out(v))
    }

    fn set_aside(&mut self, verdict: &Verdict) {
        self.beliefs[verdict.cell] = self.belief(verdict);
        self.judge.set(verdict.cell, self.written[verdict.cell] - verdict.residual, true);
        self.hear_around(verdict.cell);
    }

    fn take_back(&mut self, cell: usize) -> Option<Verdict> {
        self.judge.set(cell, self.written[cell], false);
        self.judge.verdict(cell)
    }

    fn run(&mut self) -> Vec<Verdict> {
        let most = (MOST * self.written.len() as f64).ceil() as usize;
        let mut found = gross(&self.judge.grid, self.judge.sigma2.sqrt(), most);
        let untouched = found.is_empty();
        for &cell in &found {
            self.judge.set(cell, self.written[cell], true);
        }
        for _ in 0..SWEEPS {
            for &cell in &found {
                self.impute(cell);
            }
        }
        if !untouched {
            self.judge.level();
        }
        self.hear();
        let mut kept: Vec<Verdict> = Vec::new();
        for _ in 0..ROUNDS {
            let before = found.clone();
            while found.len() < most {
                let Some(verdict) = self.next() else { break };
                self.set_aside(&verdict);
                found.push(verdict.cell);
            }
            if found == before && kept.len() == found.len() {
                break;
            }
            kept = self.hear_again(&mut found);
            if self.exchange(&mut found) | self.merge(&mut found) {
                kept = self.hear_again(&mut found);
            }
        }
        if !untouched || !found.is_empty() {
            self.judge.level();
            self.hear();
        }
        kept
    }

    /// Cells about neighbours that say which of them is wrong.
    fn region(&self, cells: &[usize]) -> Vec<usize> {
        let mut list = Vec::new();
        for (steps, lines) in (-REACH..=REACH).flat_map(|s| (-REACH..=REACH).map(move |l| (s, l))) {
            if steps.abs().min(lines.abs()) <= 1 {
                list.extend(cells.iter().filter_map(|&at| self.judge.grid.shifted(Along::Station, at, steps, lines)));
            }
        }
        list.sort_unstable();
        list.dedup();
        list
    }

    /// Minus the logarithm of the evidence (pseudo-likelihood) of the cells of a region that are not set aside.
    fn cost(&self, region: &[usize]) -> f64 {
        let cells = region.iter().filter(|&&cell| !self.judge.is_masked(cell));
        let density = |v: Verdict| (student(v.residual / v.scale, v.freedom) / v.scale).max(f64::MIN_POSITIVE);
        cells.filter_map(|&cell| self.judge.verdict(cell)).map(|v| -density(v).ln()).sum()
    }

    /// Minus the logarithm of the evidence that a cell is wrong.
    fn cost_of_wrong(&self, verdict: &Verdict) -> f64 {
        let wrong =
            self.weighed(verdict).iter().filter(|r| r.hypothesis != Hypothesis::Noise).map(|r| r.probability).sum();
        -f64::max(wrong, f64::MIN_POSITIVE).ln()
    }

    /// How much the cost falls when `other` is set aside in the place of some that are, and the value that then stands
    /// in for it.
    fn gain_of_exchange(&mut self, cells: &[usize], other: usize) -> Option<(f64, f64)> {
        let region = self.region(&[cells, &[other]].concat());
        let stand_ins: Vec<f64> = cells.iter().map(|&cell| self.judge.grid.value[cell]).collect();
        let kept = self.cost(&region);
        let mut mine = Some(0.0);
        for (&cell, &value) in cells.iter().zip(&stand_ins) {
            let verdict = self.take_back(cell);
            self.judge.set(cell, value, true);
            mine = mine.zip(verdict).map(|(sum, verdict)| sum + self.cost_of_wrong(&verdict));
        }
        cells.iter().for_each(|&cell| self.judge.set(cell, self.written[cell], false));
        let mut result = None;
        if let (Some(mine), Some(theirs)) = (mine, self.judge.verdict(other)) {
            self.judge.set(other, self.written[other] - theirs.residual, true);
            self.impute(other);
            let exchanged = self.cost(&region) + self.cost_of_wrong(&theirs);
            result = Some((kept + mine - exchanged, self.judge.grid.value[other]));
            self.judge.set(other, self.written[other], false);
        }
        cells.iter().zip(stand_ins).for_each(|(&cell, value)| self.judge.set(cell, value, true));
        result
    }

    /// Exchanges cells that are set aside for the one beside all of them that explains the neighbourhood best, where
    /// one explains it better.
    fn exchanged(&mut self, cells: &[usize]) -> Option<usize> {
        let beside = |grid: &Grid, cell: usize| {
            EXCHANGES.map(|(steps, lines)| grid.shifted(Along::Station, cell, steps, lines)).into_iter().flatten()
        };
        let grid = &self.judge.grid;
        let others: Vec<usize> = beside(grid, *cells.first()?)
            .filter(|&other| !self.judge.is_masked(other))
            .filter(|&other| cells[1..].iter().all(|&cell| beside(grid, cell).any(|b| b == other)))
            .collect();
        let mut best: Option<(f64, usize, f64)> = None;
        for other in others {
            let Some((gain, value)) = self.gain_of_exchange(cells, other) else { continue };
            if gain > best.map_or(EXCHANGED, |b| b.0) {
                best = Some((gain, other, value));
            }
        }
        let (_, other, value) = best?;
        let mut belief = 0.0;
        for &cell in cells {
            self.judge.set(cell, self.written[cell], false);
            belief = f64::max(belief, std::mem::take(&mut self.beliefs[cell]));
        }
        self.judge.set(other, value, true);
        self.beliefs[other] = belief;
        Some(other)
    }

    /// Exchanges suspects for neighbours where that explains the neighbourhood better: beside a wrong cell a right one
    /// may have looked worse.
    fn exchange(&mut self, found: &mut [usize]) -> bool {
        let mut changed = false;
        for cell in found {
            if let Some(other) = self.exchanged(&[*cell]) {
                *cell = other;
                changed = true;
            }
        }
        changed
    }

    /// Exchanges two suspects for one cell beside both where that explains the neighbourhood better: both sides of a
    /// wrong cell may have looked worse than it.
    fn merge(&mut self, found: &mut Vec<usize>) -> bool {
        let mut changed = false;
        let pairs: Vec<[usize; 2]> =
            found.iter().enumerate().flat_map(|(k, &a)| found[..k].iter().map(move |&b| [b, a])).collect();
        for pair in pairs {
            if pair.iter().any(|&cell| !self.judge.is_masked(cell)) {
                continue;
            }
            let Some(other) = self.exchanged(&pair) else { continue };
            found.retain(|cell| !pair.contains(cell));
            found.push(other);
            changed = true;
        }
        changed
    }

    /// The prediction stands in for a cell that is set aside.
    fn impute(&mut self, cell: usize) {
        if let Some(verdict) = self.judge.verdict(cell) {
            let value = self.judge.grid.value[cell] - verdict.residual;
            self.judge.set(cell, value, true);
        }
    }

    /// Hears each cell that is set aside again, the weakest first, with the others set aside; those that do not stand
    /// out are taken back.
    fn hear_again(&mut self, found: &mut Vec<usize>) -> Vec<Verdict> {
        let mut kept = Vec::new();
        for last in [false, true] {
            let mut heard: Vec<(usize, f64)> = Vec::with_capacity(found.len());
            for &cell in &*found {
                let stand_in = self.judge.grid.value[cell];
                let verdict = self.take_back(cell);
                self.judge.set(cell, stand_in, true);
                self.beliefs[cell] = verdict.map_or(0.0, |v| self.belief(&v));
                heard.push((cell, verdict.map_or(0.0, |v| v.score().abs())));
            }
            heard.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
            kept.clear();
            let mut changed = false;
            for (cell, _) in heard {
                match self.take_back(cell).filter(|verdict| self.stands_out(verdict)) {
                    Some(verdict) => {
                        self.judge.set(cell, self.written[cell] - verdict.residual, true);
                        self.beliefs[cell] = self.belief(&verdict);
                        kept.push(verdict);
                    }
                    None => {
                        self.beliefs[cell] = 0.0;
                        changed = true;
                    }
                }
            }
            *found = kept.iter().map(|v: &Verdict| v.cell).collect();
            if !changed || last {
                break;
            }
        }
        self.hear();
        kept
    }

    fn conclude(self, mut found: Vec<Verdict>) -> Suspects {
        let mut all = self.verdicts.clone();
        for verdict in &found {
            all[verdict.cell] = Some(*verdict);
        }
        found.sort_by(|a, b| b.score().abs().total_cmp(&a.score().abs()).then(a.cell.cmp(&b.cell)));
        let suspects = found
            .iter()
            .enumerate()
            .map(|(k, verdict)| {
                let (station, waterline) = self.judge.grid.place(verdict.cell);
                let readings = self.readings(verdict);
                let noise = readings.iter().find(|r| r.hypothesis == Hypothesis::Noise).map_or(0.0, |r| r.probability);
                let best = readings.iter().find(|r| r.hypothesis != Hypothesis::Noise);
                let expected = self.written[verdict.cell] - verdict.residual;
                let text = best.map(|r| r.text.clone()).filter(|text| !text.is_empty());
                let text = text.unwrap_or_else(|| self.writing.write(expected));
                let cell_text = &self.texts[verdict.cell];
                Suspect {
                    id: format!("S{}", k + 1),
                    station,
                    waterline,
                    written: self.texts[verdict.cell].clone(),
                    value: self.written[verdict.cell],
                    verdict: self.words(verdict),
                    probability: 1.0 - noise,
                    proposed: self.writing.read(&text).unwrap_or(expected),
                    proposed_text: cell_text.replacen(bare(cell_text), &text, 1),
                    readings,
                }
            })
            .collect();
        let width = self.table.waterlines.len().max(1);
        let verdicts: Vec<Vec<Option<CellVerdict>>> =
            all.chunks(width).map(|row| row.iter().map(|v| v.as_ref().map(|v| self.words(v))).collect()).collect();
        Suspects { noise: self.judge.sigma2.sqrt(), suspects, verdicts }
    }

    fn words(&self, verdict: &Verdict) -> CellVerdict {
        let value = self.written[verdict.cell];
        let own = verdict.scale.powi(2) - verdict.uncertainty.powi(2);
        let [along_station, along_waterline] =
            verdict.witnesses.map(|w| [value - w.residual, (w.scale2 - own).max(0.1 * w.scale2).sqrt()]);
        CellVerdict {
            expected: value - verdict.residual,
            uncertainty: verdict.uncertainty,
            noise: verdict.scale,
            score: verdict.score(),
            along_station,
            along_waterline,
        }
    }
}
