//! From a table to the model that is faired: what is left out, the surface through the rest, accepted lines, the net.

use super::changes::Watched;
use super::constraint::{Rule, edged, edges};
use super::fielded::{Likely, TableField};
use super::job::{Job, JobError};
use super::lines::{LineKind, ProposedLine, proposed_lines};
use super::proposals::{Accepted, Proposal, add_lines, declared, has_line, proposals, with_line};
use super::surface::FairSurface;
use super::suspects::{Suspects, point_suspects, suspects};
use super::unbroken::{Along, Breaks};
use crate::hull::{self, Entry, FitMethod, Hull, OffsetTable};
use crate::numeric::join;
use crate::units::counted;
use std::sync::Arc;

/// Most offsets that contradict a field of all others, over their number.
const CONTRADICTING: f64 = 0.02;

/// A cell: (station, waterline).
type Cell = (usize, usize);

/// What a job starts from. The grade of fairness does not enter.
#[derive(Debug, Clone)]
pub(super) struct Started {
    /// Suspects of the table.
    pub(super) found: Suspects,
    /// The surface through the table.
    pub(super) before: Hull,
    pub(super) notes: Vec<String>,
    /// What the surface through the table had to assume.
    pub(super) assumed: Vec<String>,
    /// Noise of the table, not below its rounding \[m\].
    pub(super) noise: f64,
    /// Step of its writing \[m\].
    pub(super) quantum: f64,
    pub(super) proposals: Vec<Proposal>,
    pub(super) surface: FairSurface,
    /// What the likelihood says, of a field.
    pub(super) likely: Option<Likely>,
    /// Cells that are left out.
    pub(super) excluded: Vec<Cell>,
    /// The lines that are counted, on the surface before.
    pub(super) watched: Watched,
}

/// The table as it is faired.
#[derive(Clone)]
struct Cleaned {
    /// Without the cells that are left out.
    clean: OffsetTable,
    /// With the expected values in their place: the surface through it needs some.
    charted: OffsetTable,
    excluded: Vec<Cell>,
}

impl Cleaned {
    fn leave_out(&mut self, (station, waterline): Cell, expected: f64) {
        self.clean.stations[station].half_breadths[waterline].entry = Entry::Unknown;
        self.charted.stations[station].half_breadths[waterline].entry = Entry::Given(expected.max(0.0));
        self.excluded.push((station, waterline));
    }
}

/// The net with what is known about it.
struct Modelled {
    before: Hull,
    notes: Vec<String>,
    proposals: Vec<Proposal>,
    /// The surface with accepted lines and edges of flats, and the lines along which its curvature may jump.
    start: (Hull, Breaks),
    watched: Watched,
}

/// What may be declared, the surface through the table with what is where that is another one, and the same with accepted
/// lines and edges of flats.
type Surfaced = (Vec<Proposal>, Option<Hull>, (Hull, Breaks));

/// A field with its likelihood, and where offsets are left out for it the table and the model without them.
type FieldStart = ((FairSurface, Likely), Option<(Cleaned, Modelled)>);

impl Started {
    /// Leaves out what is certainly wrong: suspects of the table, and what contradicts the field of all others.
    pub(super) fn new(job: &Job, table: &OffsetTable) -> Result<Self, JobError> {
        let mut found = suspects(table);
        let mut cleaned = Cleaned { clean: job.marked(table), charted: table.clone(), excluded: Vec::new() };
        let mut kept = Vec::new();
        for suspect in found.suspects.iter().filter(|suspect| job.exclude_suspects && suspect.probability > 0.5) {
            let cell = (suspect.station, suspect.waterline);
            if job.holds(table, cell) {
                kept.push(cell);
            } else {
                cleaned.leave_out(cell, suspect.verdict.expected);
            }
        }
        // A suspected point of a section stays, as a doubtful one: beside it there is no grid that says what to put in
        // its place.
        let mut doubtful = 0;
        if table.stations.iter().any(|station| !station.outlines.is_empty()) {
            let points = point_suspects(table);
            found.noise = found.noise.max(points.noise);
            for suspect in points.suspects.iter().filter(|s| job.exclude_suspects && s.probability > 0.5) {
                cleaned.clean.stations[suspect.station].outlines[suspect.branch][suspect.point].marks.doubtful = true;
                doubtful += 1;
            }
        }
        let quantum = table.form.quantum().unwrap_or(0.0);
        let noise = found.noise.max(quantum / 12f64.sqrt());
        let as_field = job.suits_a_field(noise) && table.lines.is_empty();
        let mut modelled = Modelled::new(job, &cleaned, &found, noise)?;
        let field =
            if as_field { field_without_contradictions(job, (&cleaned, &modelled), &found, noise)? } else { None };
        let (surface, likely) = match field {
            Some(((surface, likely), without)) => {
                if let Some(without) = without {
                    (cleaned, modelled) = without;
                }
                (surface, Some(likely))
            }
            None => (FairSurface::new(&cleaned.clean, &modelled.start.0, &modelled.start.1), None),
        };
        let Modelled { before, notes: assumed, proposals, watched, .. } = modelled;
        let mut notes = Vec::new();
        for (station, waterline) in kept {
            let (name, z) = (table.stations[station].station.words(), table.waterlines[waterline]);
            notes.push(format!(
                "the offset of {name} at {z} m is suspected, and stays: it is locked, or its tolerance is named"
            ));
        }
        if doubtful > 0 {
            notes.push(format!(
                "{} of sections suspected, and doubtful: a hundredth of the weight of the others",
                counted(doubtful, "point")
            ));
        }
        let excluded = cleaned.excluded;
        Ok(Self { found, before, notes, assumed, noise, quantum, proposals, surface, likely, excluded, watched })
    }
}

/// The field of a table with what is left out of it, and the model of that. Where the field does not follow the table,
/// offsets that contradict all others are left out, as long as these are few.
fn field_without_contradictions(
    job: &Job,
    (cleaned, modelled): (&Cleaned, &Modelled),
    found: &Suspects,
    noise: f64,
) -> Result<Option<FieldStart>, JobError> {
    let offsets = cleaned.clean.stations.iter().flat_map(|station| &station.half_breadths);
    let most = (CONTRADICTING * offsets.filter(|cell| cell.value().is_some()).count() as f64).max(1.0);
    let mut without: Option<(Cleaned, Modelled)> = None;
    loop {
        let (table, model) = without.as_ref().map_or((cleaned, modelled), |(table, model)| (table, model));
        let field = TableField::new(&table.clean, &model.before, (noise, &job.rules));
        if let Some(surface) = field.as_ref().and_then(TableField::surface) {
            return Ok(Some((surface, without)));
        }
        if !job.exclude_suspects {
            return Ok(None);
        }
        let mut wrong = match released(&table.clean, &job.rules) {
            Some(free) => TableField::new(&free, &model.before, (noise, &[])).map(|field| field.contradictions()),
            None => field.map(|field| field.contradictions()),
        }
        .unwrap_or_default();
        wrong.retain(|(cell, _)| !job.holds(&table.clean, *cell));
        let count = table.excluded.len() - cleaned.excluded.len() + wrong.len();
        if wrong.is_empty() || count as f64 > most {
            return Ok(None);
        }
        let mut table = table.clone();
        wrong.into_iter().for_each(|(cell, expected)| table.leave_out(cell, expected));
        let model = Modelled::new(job, &table, found, noise)?;
        without = Some((table, model));
    }
}

/// A table without its locks where it has these, or rules that lock lines of it: they keep an offset where it is and do not
/// say that others are wrong.
fn released(table: &OffsetTable, rules: &[Rule]) -> Option<OffsetTable> {
    let mut free = table.clone();
    let mut count = rules.len();
    for cell in free.stations.iter_mut().flat_map(|station| &mut station.half_breadths) {
        count += usize::from(std::mem::take(&mut cell.marks.locked));
    }
    (count > 0).then_some(free)
}

impl Modelled {
    fn new(job: &Job, table: &Cleaned, found: &Suspects, noise: f64) -> Result<Self, JobError> {
        let Cleaned { clean, charted, .. } = table;
        let fitted = Hull::fit(charted, &FitMethod::Graded)?;
        let before = fitted.hull;
        let (mut watched, modelled) =
            join(|| Watched::new(clean, &before), || Self::surface(job, table, found, noise, &before));
        let (proposals, refitted, start) = modelled?;
        // Without a line that the hull has, the surface through the table is another one between the offsets.
        let before = match refitted {
            Some(refitted) => {
                watched = Watched::new(clean, &refitted);
                refitted
            }
            None => before,
        };
        Ok(Self { before, notes: fitted.notes, proposals, start, watched })
    }

    /// What may be declared, the surface through the table with what is where that is another one, and the same with accepted
    /// lines and edges of flats.
    fn surface(job: &Job, table: &Cleaned, found: &Suspects, noise: f64, before: &Hull) -> Result<Surfaced, JobError> {
        let Cleaned { clean, charted, .. } = table;
        let mut list = proposed_lines(charted, found);
        list.retain(|line| !has_line(before, line));
        if let Accepted::These(numbers) = &job.accepted
            && let Some(&number) = numbers.iter().find(|number| !(1..=list.len()).contains(number))
        {
            return Err(JobError::NoLine { number, count: list.len() });
        }
        // What somebody says is there comes after what is found, and takes its place where both are one line.
        let named: Vec<ProposedLine> = job.lines.iter().filter(|line| !has_line(before, line)).copied().collect();
        let found = list.len();
        list.extend(&named);
        let mut breaks = declared_breaks(charted, before);
        let mut proposals = proposals(clean, before, &list, noise, (&job.accepted, &breaks))?;
        for proposal in proposals.iter_mut().skip(found) {
            let ProposedLine { course, kind, at, .. } = proposal.line;
            if proposal.rms.is_none() {
                return Err(JobError::NoCourse { course, kind, at });
            }
            proposal.accepted = true;
        }
        let same = |a: &ProposedLine, b: &ProposedLine| {
            (a.course, a.kind) == (b.course, b.kind) && (a.at - b.at).abs() <= 1e-6 * (1.0 + b.at.abs())
        };
        let mut index = 0;
        proposals.retain(|proposal| {
            index += 1;
            index > found || !named.iter().any(|line| same(line, &proposal.line))
        });
        let declared = declared(&proposals, before, charted);
        let lined = OffsetTable { lines: charted.lines.iter().cloned().chain(declared).collect(), ..charted.clone() };
        let more = lined.lines.len() > charted.lines.len();
        let refitted = if more { Hull::fit(&lined, &FitMethod::Graded).ok().map(|fitted| fitted.hull) } else { None };
        let mut start = refitted.as_ref().unwrap_or(before).clone();
        for proposal in proposals.iter().filter(|proposal| proposal.accepted) {
            start = with_line(&start, &proposal.line)?.unwrap_or(start);
        }
        add_lines(&start, proposals.iter().filter(|p| p.accepted).map(|p| &p.line), &mut breaks);
        for rule in &job.rules {
            if let Rule::FlatOfSide { x, z } = rule {
                let edges = edges(*x, *z);
                add_lines(&start, edges.iter(), &mut breaks);
                start = edged(&start, &edges)?;
            }
        }
        Ok((proposals, refitted, (start, breaks)))
    }
}

/// The lines that a table declares.
fn declared_breaks(table: &OffsetTable, hull: &Hull) -> Breaks {
    let (from, to) = hull.surface().v().domain();
    let mut breaks = Breaks::default();
    for line in &table.lines {
        let [Some(first), Some(middle), Some(last)] =
            [0, line.points.len() / 2, line.points.len().saturating_sub(1)].map(|point| line.points.get(point))
        else {
            continue;
        };
        let kind = match line.kind {
            hull::LineKind::Knuckle => LineKind::Knuckle,
            hull::LineKind::Tangent => LineKind::Tangent,
        };
        let along = |[_, v]: [f64; 2]| Along { at: (v - from) / (to - from), reach: [first[0], last[0]] };
        breaks.of(kind)[1].extend(hull.parameters(middle[0], middle[2]).map(along));
    }
    breaks
}

/// What an outcome came from.
#[derive(Debug, Clone)]
pub(super) struct Taken {
    /// The job.
    pub(super) job: Job,
    /// What it started from.
    pub(super) started: Arc<Started>,
}
