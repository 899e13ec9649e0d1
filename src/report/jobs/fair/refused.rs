//! What a fairing could not have, and what it had at the price of fairness, in the words of messages.

use super::job::FairOutputs;
pub(in crate::report) use super::words::line_name;
use super::words::{least, millimetres};
use crate::config::{Diagnostic, Location, Severity};
use crate::fairing::change::Turns;
use crate::fairing::constraint::Constraint;
use crate::fairing::infeasible::{Diagnosis, Reach};
use crate::qp::Status;
use crate::report::failure::{Failure, problem};
use crate::report::words::page::upward;

/// Lines that a warning names.
const NAMED: usize = 4;

/// Parts of its scale by which a quantity may miss its target and still be on it, to the eye.
const NEAR: f64 = 1e-6;

impl FairOutputs {
    /// The first line of the page: whether the hull is fairer, by how much, and what it cost.
    #[must_use]
    pub fn headline(&self) -> String {
        super::short::headline(&self.outcome)
    }

    /// What was had and is not what was hoped for, in words for the one who reads nothing else: lines that bend more
    /// often than before, all together or single ones.
    #[must_use]
    pub fn warning(&self) -> Option<String> {
        self.bends_more().or_else(|| self.lines_bend_more())
    }

    fn warned(&self, code: &'static str, message: String, help: &str) -> String {
        let warning = problem(code, &self.table_file, message, help);
        Diagnostic { severity: Severity::Warning, ..warning }.to_string()
    }

    /// Single lines that bend more often than before.
    fn lines_bend_more(&self) -> Option<String> {
        let outcome = &self.outcome;
        let worse: Vec<_> = outcome.turns.iter().filter(|turns| turns.after > turns.before).collect();
        if outcome.status != Status::Optimal || worse.is_empty() {
            return None;
        }
        let name = |turns: &&Turns| format!("{} {} > {}", line_name(&turns.cut), turns.before, turns.after);
        let mut names: Vec<String> = worse.iter().take(NAMED).map(name).collect();
        if worse.len() > NAMED {
            names.push(format!("{} more", worse.len() - NAMED));
        }
        let bend = if worse.len() == 1 { "line bends" } else { "lines bend" };
        let message = format!("{} {bend} more often than before: {}", worse.len(), names.join(", "));
        Some(self.warned(
            "W402",
            message,
            "Allow them fewer inflections under shape.inflections, or less smoothing (--weight)",
        ))
    }

    /// Lines that bend more often all together.
    fn bends_more(&self) -> Option<String> {
        let outcome = &self.outcome;
        let [before, after] = outcome.all_inflections();
        // The surface through a table without targets was not asked for fewer.
        if outcome.status != Status::Optimal || after <= before || outcome.fairness.is_raw() && outcome.held.is_empty()
        {
            return None;
        }
        let wider = outcome.faired.carried.filter(|factor| *factor > 1.0).map_or(String::new(), |factor| {
            format!(", or tolerances {:.3} times as wide, with which the targets are one smooth move", upward(factor))
        });
        if outcome.faired.waves.is_some() {
            let message =
                format!("the wave resistance falls, and lines bend more often: {before} > {after} inflections");
            return Some(self.warned(
                "W401",
                message,
                "Give a lesser --wave-weight, or limit them under shape.inflections",
            ));
        }
        let message = format!("the targets are met by adding inflections: {before} > {after}");
        Some(self.warned("W401", message, &format!("Ask for nearer targets{wider}")))
    }

    /// That the hull is no fairer than the surface through the table, and what may help.
    fn no_fairer(&self) -> String {
        let [before, after] = self.outcome.changes_of_sign();
        let [pieces, pieces_after] = self.outcome.monotone_pieces();
        format!(
            "the hull is no fairer than the surface through the table: {before} > {after} changes of sign{}, {pieces} > \
             {pieces_after} monotone pieces of curvature on stations and waterlines. The files are written. Ask for nearer \
             targets, wider tolerances or more smoothing (--weight), or look for errors with `loftsman check`",
            least(&self.outcome)
        )
    }

    /// The failure that ends the program when the targets cannot all be met.
    ///
    /// # Errors
    /// [`Failure::Infeasible`]; [`Failure::Check`] when they are met and the hull is no fairer for it.
    pub fn verdict(&self) -> Result<(), Failure> {
        let (code, message, help) = match self.outcome.status {
            Status::Optimal if self.outcome.is_no_fairer() => {
                return Err(Failure::Check(format!("E503 {}: {}", self.table_file.display(), self.no_fairer())));
            }
            Status::Optimal => return Ok(()),
            Status::Infeasible => (
                "E401",
                "the targets cannot all be met within the tolerances; what was written is a compromise",
                Refused { outputs: self, found: self.outcome.faired.diagnosis.as_ref() }.remedy(),
            ),
            Status::Limit if self.outcome.faired.stalled() => (
                "E403",
                "what is held of metacentre or wetted surface did not come to its target; what was written is the nearest",
                "Look at constraints and nonlinear_residuals in fairing.json, widen the tolerance or move the target"
                    .to_owned(),
            ),
            Status::Unbounded | Status::Limit => (
                "E402",
                "the solver stopped before the optimum was proved; what was written is its best point",
                "Widen the tolerances or relax the targets; the residuals are in fairing.json".to_owned(),
            ),
        };
        Err(Failure::Infeasible(vec![problem(code, &self.table_file, message.to_owned(), &help)]))
    }
}

/// What was refused, and why as far as that is known.
struct Refused<'a> {
    outputs: &'a FairOutputs,
    found: Option<&'a Diagnosis>,
}

impl Refused<'_> {
    /// Everything that would do instead.
    fn remedy(&self) -> String {
        let which =
            [self.tolerances(), self.nearest_rule(), self.nearest_target(), self.intervals(), self.given_up()].concat();
        if which.is_empty() {
            return "Widen the tolerance, unlock cells, drop a rule or free one of the targets; no single one of them would \
                    do, or none was found that would"
                .to_owned();
        }
        let widen = self.found.is_none_or(|found| found.widening.is_some());
        let first = if widen { "Widen the tolerance, unlock" } else { "Unlock" };
        format!("{first} cells, drop a rule or free one of the targets:{}", which.trim_end_matches(';'))
    }

    /// How wide the tolerances would have to be: for a distorted hull, which uses all of every tolerance, and for one
    /// smooth move.
    fn tolerances(&self) -> String {
        let Some(found) = self.found else { return String::new() };
        let typical = self.outputs.outcome.changes.iter().filter_map(|change| change.tolerance).fold(0.0, f64::max);
        let wide = |factor: f64| {
            let factor = upward(factor);
            let wide = rounded_up(1e3 * factor * typical);
            format!("{factor:.3} times as wide ({wide} mm where it is widest now {} mm)", millimetres(typical))
        };
        let smooth = self.outputs.outcome.faired.carried.filter(|factor| *factor > 1.0);
        let least = match found.widening {
            Some(factor) if smooth.is_some_and(|smooth| smooth > factor) => {
                format!(" {} would do, but distorts the hull;", wide(factor))
            }
            Some(factor) => format!(" {} would do;", wide(factor)),
            None => " no tolerances were found that would do;".to_owned(),
        };
        let smooth = smooth.map_or(String::new(), |factor| {
            format!(" {} would meet the targets by one smooth move of the whole hull;", wide(factor))
        });
        least + &smooth
    }

    /// The rule that would have to give least, where its giving alone would do.
    fn nearest_rule(&self) -> String {
        let rules = self.found.into_iter().flat_map(|found| &found.rules);
        let able = rules.filter_map(|(rule, give)| Some((*rule, (*give)?)));
        let breadth = self.outputs.outcome.after.particulars().breadth;
        let nearest = able.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, give)| *give < breadth);
        let words = nearest.and_then(|(rule, give)| {
            let unit = self.outputs.outcome.rules.get(rule)?.rule.unit();
            Some(format!(" {} would have to give by {give:.1e}{unit};", self.rule_words(rule)?))
        });
        words.unwrap_or_default()
    }

    /// The target that would have to give least, where its giving alone would do.
    fn nearest_target(&self) -> String {
        let words = self.found.and_then(Diagnosis::cheapest).and_then(|reach| {
            let constraint = self.outputs.outcome.held.get(reach.constraint)?.constraint;
            let (words, of, missing) = (self.words(&constraint), constraint.relative_to(), 100.0 * reach.missing?);
            Some(format!(" {words} alone would have to give by {missing:.3} % of {of}: {};", self.reached(reach)?))
        });
        words.unwrap_or_default()
    }

    /// The feasible intervals of displacement and LCB, and what is out of reach where no single target would do.
    fn intervals(&self) -> String {
        let Some(found) = self.found else { return String::new() };
        let cheapest = found.cheapest();
        let each = found.reaches.iter().filter_map(|reach| {
            let held = self.outputs.outcome.held.get(reach.constraint)?;
            let off = held.missed().abs() > NEAR * held.scale;
            let always = matches!(
                held.constraint,
                Constraint::Displacement(_)
                    | Constraint::CentreOfBuoyancy(_)
                    | Constraint::Volume { .. }
                    | Constraint::CentreOfVolume { .. }
            );
            let is_cheapest = cheapest == Some(reach);
            ((off && cheapest.is_none() || always) && !is_cheapest).then_some(())?;
            let given = if reach.missing.is_some() { "with" } else { "without" };
            Some(format!(" {} {given} the other targets: {};", self.words(&held.constraint), self.reached(reach)?))
        });
        let none = cheapest.is_none() && found.reaches.iter().any(|reach| reach.values.is_some());
        let none = if none { " no single target would do;" } else { "" };
        none.to_owned() + &each.collect::<String>()
    }

    /// The rules that were given up.
    fn given_up(&self) -> String {
        let rules = (0..self.outputs.outcome.rules.len()).filter(|&rule| self.outputs.outcome.rules[rule].given_up);
        let words = rules.filter_map(|rule| self.rule_words(rule)).collect::<Vec<_>>().join(", ");
        if words.is_empty() { words } else { format!(" given up was {words};") }
    }

    fn words(&self, constraint: &Constraint) -> String {
        placed(constraint.words(), self.outputs.request.place_of(constraint))
    }

    fn rule_words(&self, rule: usize) -> Option<String> {
        let words = self.outputs.outcome.rules.get(rule)?.rule.words();
        Some(placed(words, self.outputs.request.rules.get(rule).map(|rule| &rule.place)))
    }

    fn reached(&self, reach: &Reach) -> Option<String> {
        let constraint = &self.outputs.outcome.held.get(reach.constraint)?.constraint;
        let [low, high] = reach.values?;
        let (target, unit) = (constraint.target(), unit(constraint));
        Some(format!("it could be {low:.6} to {high:.6}{unit} where {target:.6}{unit} is asked for"))
    }
}

/// A target in words, with the place where a job states it.
fn placed(words: String, place: Option<&Location>) -> String {
    match place {
        Some(place) => format!("{words} ({place})"),
        None => words,
    }
}

/// The unit of what is held after a number, and where it is counted from.
fn unit(constraint: &Constraint) -> String {
    let from = match constraint {
        Constraint::CentreOfBuoyancy(_) | Constraint::CentreOfFlotation(_) | Constraint::CentreOfVolume { .. } => {
            " from AP"
        }
        _ => "",
    };
    if constraint.unit() == "-" { String::new() } else { format!(" {}{from}", constraint.unit()) }
}

/// A length \[mm\] to four digits, upward: with less it would not do.
fn rounded_up(length: f64) -> String {
    let decimals = (3.0 - length.max(1e-3).log10().floor()).clamp(0.0, 6.0) as usize;
    let step = 0.1f64.powf(decimals as f64);
    format!("{:.decimals$}", step * (length / step - 1e-9).ceil())
}

#[cfg(test)]
mod tests {
    use super::rounded_up;

    #[test]
    fn lengths_are_rounded_upward() {
        let rounded = [17.038, 17.0, 263.81, 0.041_231, 4123.4, 99.999].map(rounded_up);
        assert_eq!(rounded, ["17.04", "17.00", "263.9", "0.04124", "4124", "100.00"]);
    }
}
