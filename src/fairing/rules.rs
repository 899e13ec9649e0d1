//! Rules in the program: their rows, and the rounds in which lines that may have so many inflections get them.

use super::bends::{Bend, Line, bends};
use super::constraint::{Rule, inflections};
use super::error::FairError;
use super::least::TableLine;
use super::model::Limit;
use super::program::{Program, Solved};
use super::surface::FairSurface;
use std::borrow::Cow;

/// Most rounds of lines that bend too often.
const ROUNDS: usize = 4;

/// Rows with the index of their rule.
type RuleLimits = Vec<(usize, Limit)>;

/// Rows of every rule, or every rule that names what the surface does not have.
pub(super) fn rule_limits(surface: &FairSurface, rules: &[Rule]) -> Result<RuleLimits, Vec<(usize, String)>> {
    let (mut limits, mut problems) = (Vec::new(), Vec::new());
    for (k, rule) in rules.iter().enumerate() {
        match rule.limits(surface) {
            Ok(found) => limits.extend(found.into_iter().map(|limit| (k, limit))),
            Err(why) => problems.push((k, format!("{}: {why}", rule.words()))),
        }
    }
    if problems.is_empty() { Ok(limits) } else { Err(problems) }
}

/// The lines whose inflections are counted: not those whose inflections a rule decides, and of others only
/// what lies outside the ranges in which a rule decides the sign of curvature or the number of inflections.
pub(super) fn counted_lines<'a>(lines: &'a [TableLine], rules: &[Rule]) -> Cow<'a, [TableLine]> {
    let bending = |rule: &Rule| matches!(rule, Rule::Inflections { .. } | Rule::Curvature { .. });
    if !rules.iter().any(bending) {
        return Cow::Borrowed(lines);
    }
    let counted = |line: &TableLine| rules.iter().any(|rule| rule.counted_line() == Some(line.line));
    let mut kept: Vec<TableLine> = lines.iter().filter(|line| !counted(line)).cloned().collect();
    for rule in rules {
        if let Rule::Curvature { line, over: [from, to], .. } | Rule::Inflections { line, over: [from, to], .. } = rule
        {
            for other in kept.iter_mut().filter(|other| other.line == *line) {
                other.bends.retain(|bend| bend.at < *from || bend.at > *to);
            }
        }
    }
    Cow::Owned(kept)
}

/// Rows that leave every line its number of inflections, and the program with them.
pub(super) struct Turned {
    pub(super) limits: Vec<(usize, Limit)>,
    pub(super) program: Program,
    pub(super) solved: Solved,
}

/// Asks lines that bend more often than their rule allows for signs, `solve` being the program with rows for them; none
/// where no line does. The last program may have no solution: then the wishes cannot all be had.
///
/// The signs are those nearest to the net; where these cannot be met and the offsets of the line allow a curve with so
/// few inflections, the signs of that curve.
pub(super) fn turned(
    surface: &FairSurface,
    rules: &[Rule],
    lines: &[TableLine],
    net: &[f64],
    mut solve: impl FnMut(&[(usize, Limit)]) -> Result<(Program, Solved), FairError>,
) -> Result<Option<Turned>, FairError> {
    let ruled: Vec<(usize, usize, Option<Line>, Vec<Bend>)> = rules
        .iter()
        .enumerate()
        .filter_map(|(k, rule)| match rule {
            Rule::Inflections { line, over: [from, to], most } => {
                let mut bends = bends(surface, *line);
                bends.retain(|bend| (*from..=*to).contains(&bend.at));
                Some((k, *most, rule.counted_line(), bends))
            }
            _ => None,
        })
        .collect();
    let mut asked: Vec<(usize, Limit)> = Vec::new();
    let mut found: Option<Turned> = None;
    for _ in 0..ROUNDS {
        let now = found.as_ref().map_or(net, |found| &found.solved.net);
        let mut fresh: Vec<(usize, Vec<Limit>)> = Vec::new();
        for (k, most, _, bends) in &ruled {
            let known = asked.iter().any(|(rule, _)| rule == k);
            if !known && inflections::bends_too_often(bends, now, *most) {
                fresh.push((*k, inflections::limits(bends, now, *most)));
            }
        }
        if fresh.is_empty() {
            break;
        }
        let with = |fresh: &[(usize, Vec<Limit>)]| -> Vec<(usize, Limit)> {
            let new = fresh.iter().flat_map(|(k, limits)| limits.iter().map(move |limit| (*k, limit.clone())));
            asked.iter().cloned().chain(new).collect()
        };
        let mut limits = with(&fresh);
        let (mut program, mut solved) = solve(&limits)?;
        if !solved.is_optimal() {
            for (k, most, line, _) in &ruled {
                let least = lines.iter().find(|other| Some(other.line) == *line && other.least_at_most(*most));
                if let (Some(line), Some(place)) = (least, fresh.iter_mut().find(|(rule, _)| rule == k)) {
                    place.1 = line.signs_of_least(net);
                }
            }
            limits = with(&fresh);
            (program, solved) = solve(&limits)?;
        }
        let done = !solved.is_optimal();
        asked.clone_from(&limits);
        found = Some(Turned { limits, program, solved });
        if done {
            break;
        }
    }
    Ok(found)
}
