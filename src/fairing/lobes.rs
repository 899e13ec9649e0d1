//! Lobes that a line of the table has beyond its least inflections, taken out one after the other where that is cheap.
//!
//! [`super::guard`] asks a line for the signs of a curve with the least inflections; where these are too dear, or not to be
//! had with those of the others, the line keeps lobes that nothing asks for. Here the least lobe of each such line,
//! by its departure kappa l^2 / 8, is asked to turn as its neighbours do, beside everything that holds already: the
//! program of the answer with more rows. Signs of the line are imposed all along it, but for one place at each
//! inflection that stays, so that it moves there freely and cannot turn thrice.
//!
//! Lines are taken together: [`super::choice`] finds those that are worth [`FairSettings::price`] each, and one program
//! asks them for their signs. A group after which a curve bends more often than before, buttocks and diagonals among
//! them, or all of them together not less often, counted on the hull itself, is halved.
//!
//! Against no lobes taken out, inflections of all curves of the shared tables: DTMB 5415 389 > 374, DTC 276 > 254,
//! oe1012 89 > 76, Series 60 90 > 87, S-175 92 > 91. Tried instead of the choice: letting go what the proof of a
//! contradiction charges most, one line a program (DTMB 5415: 40 programs, 85 s, 377 left).

use super::bends::{Bend, Line, asked, lobes};
use super::changes::Counted;
use super::choice::{charges, trial, worth_it};
use super::fair::{FairError, FairSettings, Faired};
use super::least::TableLine;
use super::model::Limit;
use super::outcome::total;
use super::repeated::{Attempt, excess};
use super::surface::FairSurface;

/// Most times that lobes are chosen, and most programs with those that were.
const ROUNDS: usize = 6;
const PROGRAMS: usize = 12;

/// Dearest lobe, over the price: the choice is no sharper than its accuracy.
const DEAREST: f64 = 1.25;

/// Inflections of a line by the signs of the net, and the lobe that it is asked to give up.
#[derive(Debug, Clone)]
struct Lobe {
    /// Index of the line.
    line: usize,
    /// Where the lobe is greatest: an index of the bends.
    top: usize,
    /// Inflections that are left of it.
    most: usize,
    /// The signs.
    limits: Vec<Limit>,
}

impl Lobe {
    fn key(&self) -> (usize, usize) {
        (self.line, self.top)
    }
}

/// Lines that are asked to give up lobes.
pub(super) struct Lobes<'a> {
    pub(super) surface: &'a FairSurface,
    pub(super) settings: &'a FairSettings,
    pub(super) lines: &'a [TableLine],
    pub(super) watched: &'a Counted,
    /// The least departure that is counted \[m\].
    pub(super) seen: f64,
}

impl Lobes<'_> {
    /// The attempt without the lobes that can be had for less than their price.
    pub(super) fn fewer(&self, attempt: Attempt) -> Result<Attempt, FairError> {
        let faired = &attempt.faired;
        // The rows of what is not linear stand for the answer that they were made at.
        if !attempt.is_optimal() || faired.settled.is_some() {
            return Ok(attempt);
        }
        let mut best = attempt;
        let mut refused: Vec<(usize, usize)> = Vec::new();
        let mut left = PROGRAMS;
        'again: for _ in 0..ROUNDS {
            let candidates = self.candidates(&best, &refused);
            if candidates.is_empty() {
                break;
            }
            let (cheap, dear) = self.cheap(&best, candidates)?;
            refused.extend(dear.iter().map(Lobe::key));
            let mut groups = vec![cheap];
            while let Some(mut group) = groups.pop().filter(|group| !group.is_empty() && left > 0) {
                left -= 1;
                if self.without(&mut best, &group)? {
                    continue 'again;
                }
                if group.len() > 1 {
                    // Some of them hide what the others bring.
                    let rest = group.split_off(group.len() / 2);
                    groups.extend([group, rest]);
                } else {
                    refused.extend(group.iter().map(Lobe::key));
                }
            }
            break;
        }
        Ok(best)
    }

    /// Lobes that are worth their price together, and the others.
    fn cheap(&self, best: &Attempt, lobes: Vec<Lobe>) -> Result<(Vec<Lobe>, Vec<Lobe>), FairError> {
        let Faired { program, smoother, sigma, net, .. } = &best.faired;
        let limits: Vec<&[Limit]> = lobes.iter().map(|lobe| lobe.limits.as_slice()).collect();
        let prices = vec![self.settings.price * sigma * sigma; lobes.len()];
        let chosen = worth_it((program, &smoother.reduced), net, &limits, &prices, &self.settings.solver)?;
        let mut chosen = chosen.into_iter().flatten();
        Ok(lobes.into_iter().partition(|_| chosen.next() == Some(true)))
    }

    /// The least lobe of every line that bends too often and was not refused.
    fn candidates(&self, best: &Attempt, refused: &[(usize, usize)]) -> Vec<Lobe> {
        let net = &best.faired.net;
        let counted = |line: Line| best.lines.iter().find(|turns| Line::of(turns.cut) == Some(line));
        let of_line = |(index, line): (usize, &TableLine)| {
            let least = line.least.as_ref().filter(|least| least.curve.is_some())?.count;
            counted(line.line).filter(|turns| turns.after > least)?;
            let found = lobes(&line.bends, net, self.seen);
            let excess = found.len().saturating_sub(1).checked_sub(least).filter(|excess| *excess > 0)?;
            let inside = |k: usize| k > 0 && k + 1 < found.len();
            let allowed = (0..found.len())
                .filter(|&k| (!inside(k) || excess > 1) && !refused.contains(&(index, found[k].top)))
                .min_by(|&a, &b| found[a].departure.total_cmp(&found[b].departure))?;
            let fewer = if inside(allowed) { 2 } else { 1 };
            let signs = turned(&found, allowed, &line.bends, net);
            let end = found.get(allowed + 1).map_or(line.bends.len(), |next| next.from);
            let gone = if allowed == 0 { 0 } else { found[allowed].from }..end;
            let limits = asked(&line.bends, net, &signs, gone, self.seen);
            Some(Lobe { line: index, top: found[allowed].top, most: found.len() - 1 - fewer, limits })
        };
        self.lines.iter().enumerate().filter_map(of_line).collect()
    }

    /// Asks for the lobes of a group; whether the attempt is now without them.
    fn without(&self, best: &mut Attempt, group: &[Lobe]) -> Result<bool, FairError> {
        let Faired { program, smoother, lambda, sigma, net, solved: before, .. } = &best.faired;
        let all: Vec<Limit> = group.iter().flat_map(|lobe| lobe.limits.iter().cloned()).collect();
        let (program, first) = program.with_bends(&all, &smoother.reduced);
        let solved = program.solve(smoother, *lambda, &trial(&self.settings.solver))?;
        let unit = sigma * sigma;
        let limits: Vec<&[Limit]> = group.iter().map(|lobe| lobe.limits.as_slice()).collect();
        let charges = charges((&program, &solved), &limits, first, net).into_iter().map(|charge| charge / unit);
        let charges: Vec<f64> = charges.collect();
        if !solved.is_optimal() || charges.iter().any(|charge| *charge > DEAREST * self.settings.price) {
            return Ok(false);
        }
        let after = self.surface.hull_of(&solved.net)?;
        let lines = self.watched.turns(&after);
        if excess(&lines) > excess(&best.lines) || total(&lines)[1] >= total(&best.lines)[1] {
            return Ok(false);
        }
        let dearer = (solved.objective - before.objective) / unit;
        let faired = &mut best.faired;
        faired.price += dearer;
        faired.programs += 1;
        faired.iterations += solved.solution.iterations;
        faired.net.clone_from(&solved.net);
        (faired.program, faired.solved) = (program, solved);
        if let Some(guarded) = &mut faired.guarded {
            for (lobe, charge) in group.iter().zip(charges) {
                guarded.gave_up(self.lines[lobe.line].line, lobe.most, charge);
            }
        }
        (best.after, best.lines) = (after, lines);
        Ok(true)
    }
}

/// Signs along a line whose lobe `gone` turns as its neighbours do; 0 at one place beside each inflection.
fn turned(found: &[super::bends::Lobe], gone: usize, bends: &[Bend], net: &[f64]) -> Vec<i8> {
    let mut signs = vec![0; bends.len()];
    let mut from = 0;
    for (k, lobe) in found.iter().enumerate() {
        // What lies between two lobes goes with the one before.
        let to = found.get(k + 1).map_or(bends.len(), |next| next.from);
        signs[from..to].fill(if k == gone { -lobe.sign } else { lobe.sign });
        from = to;
    }
    for k in 1..signs.len() {
        if signs[k] * signs[k - 1] < 0 {
            let weaker = bends[k].curvature(net).abs() < bends[k - 1].curvature(net).abs();
            signs[if weaker { k } else { k - 1 }] = 0;
        }
    }
    signs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fairing::bends::Lobe as Seen;

    #[test]
    fn a_lobe_that_is_taken_out_turns_as_its_neighbours_and_one_place_is_free_beside_each_inflection() {
        let bend =
            |k: usize| Bend { numerator: vec![(k, 1.0)], offset: 0.0, slope: Vec::new(), along: 1.0, at: k as f64 };
        let net = [1.0, 1.0, 0.5, -0.2, -0.2, 0.4, 0.6, -0.3, -1.0, -1.0];
        let bends: Vec<Bend> = (0..net.len()).map(bend).collect();
        let seen = |(sign, from): (i8, usize)| Seen { sign, from, top: from, departure: 1.0 };
        let found: Vec<Seen> = [(1, 0), (-1, 3), (1, 5), (-1, 7)].map(seen).to_vec();
        // Of 0.6 and -0.3 the weaker is free.
        assert_eq!(turned(&found, 1, &bends, &net), [1, 1, 1, 1, 1, 1, 1, 0, -1, -1]);
        // Both places of a short lobe may be free: there is no room for more than it.
        assert_eq!(turned(&found, 3, &bends, &net), [1, 1, 1, 0, 0, 1, 1, 1, 1, 1]);
    }
}
