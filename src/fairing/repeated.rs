//! On the net of a fit, the fairing again with the signs of the start for every curve that was seen to bend more often
//! after than before: stations and waterlines, and buttocks and diagonals, which no offset tells of.

use super::bends::Line;
use super::changes::Counted;
use super::fair::{FairSettings, Faired, Prepared, fair_prepared};
use super::job::JobError;
use super::oblique::oblique_limits;
use super::outcome::Turns;
use super::surface::FairSurface;
use crate::hull::{Cut, Hull};

/// Most times that it is done again.
const REPEATS: usize = 6;

/// A fair hull and what its curves do.
pub(super) struct Attempt {
    pub(super) faired: Faired,
    pub(super) after: Hull,
    pub(super) lines: Vec<Turns>,
}

impl Attempt {
    fn worse(&self) -> impl Iterator<Item = &Turns> {
        self.lines.iter().filter(|turns| turns.after > turns.before)
    }

    fn excess(&self) -> usize {
        excess(&self.lines)
    }

    pub(super) fn is_optimal(&self) -> bool {
        self.faired.diagnosis.is_none() && self.faired.solved.is_optimal()
    }
}

/// Inflections more than before, all worse curves together.
pub(super) fn excess(lines: &[Turns]) -> usize {
    lines.iter().map(|turns| turns.after.saturating_sub(turns.before)).sum()
}

/// What is done again.
pub(super) struct Repeated<'a> {
    pub(super) surface: &'a mut FairSurface,
    pub(super) settings: &'a mut FairSettings,
    pub(super) prepared: &'a Prepared,
    pub(super) watched: &'a Counted,
}

impl Repeated<'_> {
    /// The attempt with the least inflections more than before; `seen` is the least departure that is seen \[m\],
    /// `guarded` says whether a line is not counted by a rule.
    ///
    /// # Errors
    /// [`JobError`] as of the fairing itself.
    pub(super) fn until_none_is_worse(
        self,
        first: Attempt,
        seen: f64,
        guarded: impl Fn(&Line) -> bool,
    ) -> Result<Attempt, JobError> {
        let Self { surface, settings, prepared, watched } = self;
        let (mut best, mut last): (Attempt, Option<Attempt>) = (first, None);
        let mut oblique: Vec<Cut> = Vec::new();
        for _ in 0..REPEATS {
            let now = last.as_ref().unwrap_or(&best);
            if !now.is_optimal() {
                break;
            }
            let worse: Vec<Line> = now.worse().filter_map(|turns| Line::of(turns.cut)).filter(&guarded).collect();
            let (again, worse): (Vec<Line>, Vec<Line>) =
                worse.into_iter().partition(|line| now.faired.kept().contains(line));
            let stricter: Vec<Line> = again.into_iter().filter(|line| !settings.strict.contains(line)).collect();
            let across = now.worse().map(|turns| turns.cut).filter(|cut| Line::of(*cut).is_none());
            let across: Vec<Cut> = across.filter(|cut| !oblique.contains(cut)).collect();
            if worse.is_empty() && across.is_empty() {
                // The start itself may break a limit of half-breadths with the signs it has: the last thing to ask for.
                if stricter.is_empty() {
                    break;
                }
                settings.strict.extend(stricter);
            }
            settings.kept = now.faired.kept().iter().copied().chain(worse).collect();
            settings.released = now.faired.released().to_vec();
            for cut in across {
                settings.oblique.extend(oblique_limits(&surface.hull, &surface.start, cut, seen));
                oblique.push(cut);
            }
            let faired = fair_prepared(surface, settings, prepared)?;
            // Signs that nothing but far control values can keep make no hull.
            let Ok(after) = surface.hull_of(&faired.net) else { break };
            let lines = watched.turns(&after);
            let next = Attempt { faired, after, lines };
            if next.is_optimal() && next.excess() < best.excess() {
                (best, last) = (next, None);
            } else {
                last = Some(next);
            }
        }
        Ok(best)
    }
}
