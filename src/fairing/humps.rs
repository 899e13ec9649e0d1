//! Which humps and hollows of the lines of a field are errors of its table, and the field without them.
//!
//! A hump is a part of a station or a waterline with curvature of one sign, as an inspection counts them: while a part
//! departs from its chord by less than can be seen, the least goes to its neighbours. The numerator of curvature at a place is a
//! linear form a c of the control values ([`super::bends`]) with the posterior standard error sigma sqrt(a'N^-1 a). With
//!
//! ```text
//! t = max |a c| / (sigma sqrt(a'N^-1 a))        over the places of a hump with its sign,
//! ```
//!
//! removing the hump costs t^2 sigma^2 of the objective at least. Humps below the price of an inflection are removed,
//! the least of a line first, each into its neighbours. One convex program has the signs that remain; what a hump costs
//! there is at most the sum of multiplier times violation over its places. Humps above the price are given back, and the
//! program is solved again. A line whose answer has more inflections than it was asked for has the signs without the room
//! about its inflections in the next program.
//!
//! A hull whose lines have more inflections than the grade allows over the proved least, or more than the surface through
//! the table, is not fair yet. Then the humps of least t are removed until few inflections are left. Each of these may cost
//! [`DEAREST`] sigma^2. Fewer than few are not asked for. At the default this is so where the noise is within the least
//! tolerance. More noise leaves room for fewer inflections than the truth has: with 40 in the place of 12 a frigate with 19 mm
//! of noise was a fifth farther off. Tried: 130 (sigma^2 + (2 q)^2) for a resolution q. A fishing vessel with tables to the
//! millimetre had 20 changes of sign for 30, and 142 monotone pieces for 114.
//!
//! Where targets move the whole hull, the humps that the field did not have before are no clearer than the move. They are
//! candidates for the price of its mean square in the place of sigma^2.

mod line;

use super::bends::{Bend, Line, changes};
use super::choice::{trial, worth_it};
use super::least::TableLine;
use super::model::{Limit, Model, value, violated};
use super::program::{Program, RowName, Solved, Wishes};
use super::smoothing::{Smoothed, Smoother};
use super::strength::{Few, far_above};
use crate::numeric::SymmetricBand;
use crate::qp::{Interior, ProblemError, Settings};
use line::{Asked, Sign, mark_new};
use std::collections::BTreeMap;

/// Most programs.
const ROUNDS: usize = 10;

/// Most programs that choose what is worth its price, and where inflections are to be few.
const CHOICES: [usize; 2] = [3, 5];

/// Places of a line to each side of an inflection at which no sign is asked for.
const AROUND: usize = 4;

/// Where no program satisfies the signs, humps that are charged more than this part of the dearest are given back.
const SHARE: f64 = 0.5;

/// Dearest hump where inflections are to be few \[sigma^2\].
const DEAREST: f64 = 130.0;

/// Factor from one t^2 below which humps are removed to the next.
const CLEARER: f64 = 1.1;

/// A program without its signs.
pub(super) struct Question<'a> {
    pub(super) model: &'a Model,
    pub(super) smoother: &'a Smoother,
    /// The field at the weight of the likelihood.
    pub(super) likely: &'a Smoothed,
    pub(super) lambda: f64,
    /// Noise of a reading of weight 1 \[m\].
    pub(super) sigma: f64,
    pub(super) wishes: &'a Wishes,
    pub(super) lines: &'a [TableLine],
    /// Least departure from the chord that counts \[m\].
    pub(super) seen: f64,
    /// Dearest hump, in sigma^2.
    pub(super) price: f64,
    /// When inflections are few; none: those at the price stand.
    pub(super) few: Option<Few>,
    /// Inflections of the surface through the table: more are not few.
    pub(super) before: usize,
    /// Least tolerance \[m\].
    pub(super) least_tolerance: f64,
    pub(super) solver: &'a Settings,
}

/// What the choice comes to.
#[derive(Debug, Clone)]
pub struct Fewer {
    /// The program that was accepted last, with its answer; none when the first one stands.
    pub accepted: Option<(Program, Solved)>,
    /// Lines that were asked for signs, with the inflections that these have, and what the signs cost \[sigma^2\].
    pub asked: Vec<(Line, usize, f64)>,
    /// The least inflections of every line, and whether they are proved.
    pub least: Vec<(Line, usize, bool)>,
    /// What one inflection less was allowed to cost \[sigma^2\].
    pub dearest: f64,
    /// Programs solved.
    pub programs: usize,
    /// Iterations of the solver.
    pub iterations: usize,
}

impl Fewer {
    /// The least inflections of lines of which nothing is asked, at a price.
    fn with_least(lines: &[TableLine], dearest: f64) -> Self {
        let least = lines.iter().filter_map(|line| Some((line.line, line.least.as_ref()?)));
        Self {
            accepted: None,
            asked: Vec::new(),
            least: least.map(|(line, least)| (line, least.count, least.certified())).collect(),
            dearest,
            programs: 0,
            iterations: 0,
        }
    }
}

/// A hump: index of its line, and its own.
type Place = (usize, usize);

impl Sign {
    /// What it is known by, with the hump that has it.
    fn key(&self, (line, _): Place) -> SignKey {
        (line, self.at, self.positive)
    }
}

/// The signs at the places of each hump.
type Parts = BTreeMap<Place, Vec<Sign>>;

/// Line and place of a sign, and which it is.
type SignKey = (usize, usize, bool);

/// Slack and multiplier of the upper and of the lower limit of a row.
type Sides = Option<[[f64; 2]; 2]>;

/// What the program of the signs starts from: a point of the last of the same rows.
#[derive(Default)]
struct Memory {
    /// Control values; none without a program.
    x: Vec<f64>,
    /// Of the rows that are no signs, in their order.
    others: Vec<Sides>,
    /// Of signs.
    signs: BTreeMap<SignKey, Sides>,
}

impl Memory {
    /// A start for a program with these rows, those of signs by their keys.
    fn start(&self, keys: &[Option<SignKey>]) -> Option<Interior> {
        let others = keys.iter().filter(|key| key.is_none()).count();
        if self.x.is_empty() || others != self.others.len() {
            return None;
        }
        let mut others = self.others.iter();
        let row = |key: &Option<SignKey>| match key {
            None => others.next().copied().flatten(),
            Some(key) => self.signs.get(key).copied().flatten(),
        };
        Some(Interior { x: self.x.clone(), rows: keys.iter().map(row).collect() })
    }

    /// Takes the point of a program with these rows.
    fn take(&mut self, interior: Option<Interior>, keys: impl Iterator<Item = Option<SignKey>>) {
        let Some(Interior { x, rows }) = interior else { return };
        self.x = x;
        self.others.clear();
        for (key, sides) in keys.zip(rows) {
            match key {
                None => self.others.push(sides),
                Some(key) => drop(self.signs.insert(key, sides)),
            }
        }
    }
}

/// What each hump costs at most \[m^2\].
type Charges = BTreeMap<Place, f64>;

/// Which humps are removed.
#[derive(Clone, Copy)]
enum Aim {
    /// Those that are worth their price.
    Worth,
    /// The same, as long as few inflections are left.
    WorthOfFew(Few),
    /// The least clear, until few inflections are left.
    Few(Few),
}

/// What removing humps with one aim comes to.
struct Priced {
    /// None where too many inflections were left.
    fewer: Option<Fewer>,
    /// Inflections that are left along the lines whose least is known, and along all.
    left: [usize; 2],
}

/// What the aims have in common.
struct Search<'a> {
    /// The answer without signs.
    free: &'a Solved,
    /// The lines before anything is asked of them.
    lines: Vec<Asked>,
    memory: Memory,
    /// Programs that were solved, and iterations of the solver.
    work: [usize; 2],
}

impl Question<'_> {
    /// Solves for the least inflections that are worth their price; `free` is the answer without signs.
    pub(super) fn run(&self, free: &Solved) -> Result<Fewer, ProblemError> {
        let inverse = self.likely.factor.inverse_band();
        let lines: Vec<Asked> = self.lines.iter().map(|line| self.line(line, &free.net, &inverse)).collect();
        let mut search = Search { free, lines, memory: Memory::default(), work: [0; 2] };
        let is_asked = |few: &Few| few.dearer > 1.0 || self.sigma <= self.least_tolerance;
        let few = self.few.filter(is_asked);
        let mut best = self.priced(few.map_or(Aim::Worth, Aim::WorthOfFew), &mut search)?;
        if let Some(few) = few.filter(|few| !self.are_few(few, best.left)) {
            let next = self.priced(Aim::Few(few), &mut search)?;
            if best.fewer.is_none() && next.fewer.as_ref().is_none_or(|next| next.accepted.is_none()) {
                best = self.priced(Aim::Worth, &mut search)?;
            } else if best.fewer.is_none() || next.left[1] < best.left[1] {
                best = next;
            }
        }
        let mut found = best.fewer.unwrap_or_else(|| Fewer::with_least(self.lines, self.price));
        [found.programs, found.iterations] = search.work;
        Ok(found)
    }

    /// The signs of curvature that the lines of a net have, as limits.
    pub(super) fn signs_of(&self, net: &[f64]) -> Vec<Limit> {
        let of_line = |line: &TableLine| {
            let asked = Asked::as_it_is(&line.bends, net, self.seen);
            let limits = asked.signs(0.0).map(|signs| asked.limits(&signs, net));
            limits.into_iter().flatten().map(|(_, sign)| sign.limit).collect::<Vec<_>>()
        };
        self.lines.iter().flat_map(of_line).collect()
    }

    /// Inflections of a net along all lines.
    pub(super) fn inflections(&self, net: &[f64]) -> usize {
        let counted = |line: &TableLine| line::counted(&line.bends, net, self.seen);
        self.lines.iter().map(counted).sum()
    }

    /// Whether inflections along the lines whose least is known, and along all, are few.
    fn are_few(&self, few: &Few, [known, all]: [usize; 2]) -> bool {
        let least = self.lines.iter().filter_map(|line| line.least.as_ref()).map(|least| least.count).sum();
        all <= self.before && !far_above(known, least, few.near_least)
    }

    /// Inflections of a net along the lines whose least is known, and along all.
    fn counted(&self, lines: &[Asked], net: &[f64]) -> [usize; 2] {
        self.sums(lines.iter().map(|line| line.counted(net, self.seen)))
    }

    /// Sums of counts of the lines: of those whose least is known, and of all.
    fn sums(&self, counts: impl Iterator<Item = usize>) -> [usize; 2] {
        let counts = self.lines.iter().zip(counts);
        counts.fold([0; 2], |[known, all], (line, count)| {
            [known + if line.least.is_some() { count } else { 0 }, all + count]
        })
    }

    /// The same with one aim.
    fn priced(&self, aim: Aim, search: &mut Search) -> Result<Priced, ProblemError> {
        let (free, mut asked) = (search.free, search.lines.clone());
        let price = match aim {
            Aim::Few(few) => few.dearer * DEAREST,
            _ => self.price,
        };
        let mut found = Fewer::with_least(self.lines, price);
        let mut left = self.counted(&asked, &free.net);
        let mut fewest = usize::MAX;
        let (mut choices, most) = (0, CHOICES[usize::from(matches!(aim, Aim::Few(_)))]);
        let mut clear = if let Aim::Few(few) = aim { self.price / few.dearer } else { price };
        for _ in 0..ROUNDS {
            let mut signs = self.signs(&asked, clear);
            match aim {
                Aim::Few(few) => {
                    // After the last choice nothing more is asked for.
                    while choices + 1 < most && clear < price && !self.are_few(&few, self.left(&asked, &signs)) {
                        clear = price.min(CLEARER * clear);
                        signs = self.signs(&asked, clear);
                    }
                }
                Aim::WorthOfFew(few) => {
                    let wanted = self.left(&asked, &signs);
                    if found.accepted.is_none() && !self.are_few(&few, wanted) {
                        return Ok(Priced { fewer: None, left: wanted });
                    }
                }
                Aim::Worth => (),
            }
            let mut parts = Parts::new();
            for (k, (line, signs)) in asked.iter().zip(&signs).enumerate() {
                for (hump, sign) in signs.iter().flat_map(|signs| line.limits(signs, &free.net)) {
                    parts.entry((k, hump)).or_default().push(sign);
                }
            }
            if parts.is_empty() {
                break;
            }
            if choices < most {
                choices += 1;
                search.work[0] += 1;
                match self.choose(price, &parts, (&free.net, &mut search.memory), &mut asked)? {
                    None => break,
                    Some(true) => continue,
                    Some(false) => (),
                }
            }
            let (program, solved, charges) = self.solve(&parts, (&free.net, &mut search.memory))?;
            search.work[0] += 1;
            search.work[1] += solved.solution.iterations;
            let again = if solved.is_optimal() {
                let counted = self.counted(&asked, &solved.net);
                if counted[1] >= fewest {
                    break;
                }
                (fewest, left) = (counted[1], counted);
                let again = self.watch(&mut asked, &signs, &solved.net);
                self.tell(&mut found, &signs, &charges);
                found.accepted = Some((program, solved));
                again
            } else {
                let dearest = charges.values().copied().fold(0.0, f64::max);
                let gone = charges.iter().filter(|(_, charge)| **charge > 0.0 && **charge >= SHARE * dearest);
                give_back(&mut asked, gone.map(|(&place, _)| place))
            };
            if !again {
                break;
            }
        }
        Ok(Priced { fewer: Some(found), left })
    }

    /// Signs of the lines once the humps less clear than this [sigma^2] are removed.
    fn signs(&self, asked: &[Asked], clear: f64) -> Vec<Option<Vec<i8>>> {
        asked.iter().map(|line| line.signs(clear)).collect()
    }

    /// Inflections that signs leave along the lines whose least is known, and along all.
    fn left(&self, asked: &[Asked], signs: &[Option<Vec<i8>>]) -> [usize; 2] {
        let count = |(line, signs): (&Asked, &Option<Vec<i8>>)| {
            signs.as_ref().map_or_else(|| line.count(), |signs| changes(signs))
        };
        self.sums(asked.iter().zip(signs).map(count))
    }

    /// Gives back the humps that are not worth their price together; whether there were any, none where nothing was
    /// found.
    fn choose(
        &self,
        price: f64,
        parts: &Parts,
        (net, memory): (&[f64], &mut Memory),
        asked: &mut [Asked],
    ) -> Result<Option<bool>, ProblemError> {
        let moved = self.moved();
        let program = Program::new(self.model, self.smoother, self.lambda, self.wishes, None);
        let limits: Vec<Vec<&Limit>> =
            parts.values().map(|signs| signs.iter().map(|sign| &sign.limit).collect()).collect();
        let square = |&(k, hump): &Place| if asked[k].humps[hump].new { moved } else { 0.0 } + self.sigma * self.sigma;
        let prices: Vec<f64> = parts.keys().map(|place| price * square(place)).collect();
        let (chosen, interior) = worth_it((&program, &self.smoother.reduced), net, &limits, &prices, self.solver)?;
        let signs = parts.iter().flat_map(|(&place, signs)| signs.iter().map(move |sign| Some(sign.key(place))));
        let keys = program.names.iter().map(|_| None).chain(signs);
        memory.take(interior, keys);
        let Some(chosen) = chosen else { return Ok(None) };
        let gone = parts.keys().zip(chosen).filter(|(_, worth)| !worth);
        Ok(Some(give_back(asked, gone.map(|(&place, _)| place))))
    }

    /// The program with signs, its answer, and what each hump is charged \[m^2\].
    fn solve(
        &self,
        parts: &Parts,
        (net, memory): (&[f64], &mut Memory),
    ) -> Result<(Program, Solved, Charges), ProblemError> {
        let bends: Vec<Limit> = parts.values().flatten().map(|sign| sign.limit.clone()).collect();
        let owners: Vec<(Place, &Sign)> =
            parts.iter().flat_map(|(&owner, signs)| signs.iter().map(move |sign| (owner, sign))).collect();
        let wishes = Wishes { bends, ..self.wishes.clone() };
        let program = Program::new(self.model, self.smoother, self.lambda, &wishes, None);
        let key = |name: &RowName| match *name {
            RowName::Bend(row) => Some(owners[row].1.key(owners[row].0)),
            _ => None,
        };
        let keys: Vec<Option<SignKey>> = program.names.iter().map(key).collect();
        let start = memory.start(&keys);
        let mut solved = program.solve_from(self.smoother, self.lambda, &trial(self.solver), start.as_ref())?;
        memory.take(solved.solution.interior.take(), keys.into_iter());
        let mut charges = Charges::new();
        for (name, z) in program.names.iter().zip(&solved.solution.multipliers) {
            let RowName::Bend(row) = *name else { continue };
            *charges.entry(owners[row].0).or_default() += z.abs() * violated(&wishes.bends[row], net);
        }
        Ok((program, solved, charges))
    }

    /// Whether a line of the answer `net` has more inflections than it was asked for; it has signs, and less room about
    /// its inflections, from then on.
    fn watch(&self, asked: &mut [Asked], signs: &[Option<Vec<i8>>], net: &[f64]) -> bool {
        let mut again = false;
        for (line, signs) in asked.iter_mut().zip(signs) {
            let wanted = signs.as_ref().map_or_else(|| line.count(), |signs| changes(signs));
            if line.counted(net, self.seen) <= wanted || line.watched && line.around <= 1 {
                continue;
            }
            line.around = if signs.is_some() { 1 } else { AROUND };
            line.watched = true;
            again = true;
        }
        again
    }

    /// What the lines were asked for, and what it cost.
    fn tell(&self, found: &mut Fewer, signs: &[Option<Vec<i8>>], charges: &Charges) {
        let asked = self.lines.iter().zip(signs).enumerate().filter_map(|(k, (line, signs))| {
            let own = charges.range((k, 0)..(k + 1, 0)).map(|(_, charge)| charge);
            Some((line.line, changes(signs.as_ref()?), own.sum::<f64>() / (self.sigma * self.sigma)))
        });
        found.asked = asked.collect();
    }

    /// The mean square of the move to the targets at the readings \[m^2\].
    fn moved(&self) -> f64 {
        let Some(carried) = &self.model.carried else { return 0.0 };
        let squares = self.model.readings.iter().map(|reading| reading.weight * value(&reading.row, carried).powi(2));
        squares.sum::<f64>() / self.smoother.count().max(1) as f64
    }

    fn line(&self, line: &TableLine, net: &[f64], inverse: &SymmetricBand) -> Asked {
        let bends = line.bends.clone();
        let error = |bend: &Bend| {
            let (row, _) = self.smoother.reduced.row(&bend.numerator);
            inverse.quadratic_form(row.into_iter()).max(0.0).sqrt()
        };
        let errors: Vec<f64> = bends.iter().map(error).collect();
        let mut humps = line::humps(&bends, &errors, net, self.sigma, self.seen);
        if let Some(stationary) = self.model.stationary.as_ref().filter(|_| self.model.carried.is_some()) {
            mark_new(&mut humps, &line::humps(&bends, &errors, &stationary.net, self.sigma, self.seen));
        }
        let back = vec![false; humps.len()];
        Asked { bends, humps, back, watched: false, around: AROUND }
    }
}

/// Gives humps back; whether one of them was not given back before.
fn give_back(asked: &mut [Asked], gone: impl Iterator<Item = Place>) -> bool {
    gone.fold(false, |again, (k, hump)| again | !std::mem::replace(&mut asked[k].back[hump], true))
}
