//! The job file: how a table of offsets is to be faired, what is held, what may not move.
//!
//! ```toml
//! [table]
//! file = "offsets.csv"            # beside the job file; may be left out when the command names one
//! [tolerance]
//! table = "3 mm"
//! stations = { "10" = "1 mm" }
//! [lock]
//! cells = ["20@6.5024"]           # station@waterline
//! [hold]
//! displacement = "table"          # of the table's own surface; or "4050 t", or "free"
//! LCB = "-1.5 %"
//! ```

mod hold;
mod keys;
mod location;
mod ranges;
mod shape;
mod table_ref;

use hold::{MOST_TARGET, is_area};
pub use hold::{Quantity, Target};
pub use keys::JOB_KEYS;
pub use location::Location;
use ranges::{density, dimension, fairness, positive, price, weight};
pub use shape::RuleEntry;
pub use table_ref::{TableItem, TableRef};

use super::diagnostic::Diagnostic;
use super::document::{Document, Raw};
use super::keys::Kind;
use crate::fairing::constraint::Constraint;
use crate::fairing::job::{Holding, Job};
use crate::fairing::proposals::Accepted;
use crate::fairing::strength::Fairness;
use crate::hull::{OffsetTable, StatedParticulars};
use crate::hydrostatics::Conventions;
use crate::resistance::{Water, WaveRequest};

/// What a job file says; what it does not say is none.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct JobFile {
    /// The table of offsets, relative to the file.
    pub table: Option<String>,
    /// Main dimensions that override those of the table.
    pub stated: StatedParticulars,
    /// Density of the water \[t/m^3\].
    pub density: Option<f64>,
    /// How strongly the table is faired.
    pub fairness: Option<Fairness>,
    /// Smoothing weight; none for `auto`.
    pub weight: Option<Option<f64>>,
    /// Tolerance of all offsets \[m\].
    pub tolerance: Option<f64>,
    /// Tolerances of single lines and cells \[m\].
    pub tolerances: Vec<(TableRef, f64)>,
    /// What does not move.
    pub locks: Vec<TableRef>,
    /// What is held, or left free.
    pub hold: Vec<(Quantity, Target)>,
    /// Height of the centre of gravity \[m\].
    pub gravity: Option<f64>,
    /// Rules for lines and regions.
    pub rules: Vec<RuleEntry>,
    /// Knuckles and tangent lines.
    pub lines: Vec<RuleEntry>,
    /// Which proposed lines are taken.
    pub accepted: Option<Accepted>,
    /// Section areas: x \[m\], area and band \[m^2\].
    pub section_areas: Vec<([f64; 3], Location)>,
    /// Where more of them are from.
    pub section_area_curve: Option<(AreaCurve, Location)>,
    /// The band of those that have none of their own \[m^2\].
    pub section_area_band: f64,
    /// Whether suspects are left out.
    pub exclude_suspects: Option<bool>,
    /// What the removal of an inflection may cost at most, in squares of the noise.
    pub price: Option<f64>,
    /// Froude numbers at which the wave resistance is made small.
    pub froude_numbers: Option<Vec<f64>>,
    /// Its weight [m^2].
    pub wave_weight: Option<f64>,
    /// Where the values of the keys stand; of a key that is given twice the last counts.
    places: Vec<Location>,
}

/// Where the areas of a sectional-area curve are from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum AreaCurve {
    /// The surface through the table, at its stations.
    Table,
    /// A file, from the folder of the job.
    File(String),
}

impl JobFile {
    /// The file of section areas, with the place that names it.
    #[must_use]
    pub fn area_file(&self) -> Option<(&str, &Location)> {
        match &self.section_area_curve {
            Some((AreaCurve::File(file), place)) => Some((file, place)),
            _ => None,
        }
    }
}

/// Reads a job file. `file` is its name for messages.
///
/// # Errors
/// Every problem of the file at once.
pub fn read_job(file: &str, text: &str) -> Result<JobFile, Vec<Diagnostic>> {
    let mut document = Document::with_keys(file, text, JOB_KEYS, "a job");
    if !document.problems.iter().any(|p| p.code == "E120") {
        let job = interpret(&mut document);
        if document.problems.is_empty() {
            return Ok(job);
        }
    }
    Err(document.finish())
}

/// What an option of a command says, in the words of the job file: `key` is the path of a key, `value` the text of its
/// value.
///
/// # Errors
/// Every problem of the value; the option stands for the file in the messages.
pub fn read_option(option: &str, key: &str, value: &str) -> Result<JobFile, Vec<Diagnostic>> {
    let kind = JOB_KEYS.iter().find(|k| k.path() == key).map(|k| k.kind);
    // Texts are quoted, as in a file; lists, switches and whole numbers stand as they are.
    let bare = match kind {
        Some(Kind::Integer(..) | Kind::Switch) => true,
        Some(Kind::OrWord(Kind::Area, _)) => value.trim().parse::<f64>().is_ok(),
        _ => false,
    };
    let quoted = serde_json::Value::String(value.to_owned()).to_string();
    let text = match kind {
        Some(Kind::Names | Kind::Phrases(_)) => format!("{key} = [{quoted}]"),
        _ if bare => format!("{key} = {value}"),
        _ => format!("{key} = {quoted}"),
    };
    read_job(option, &text)
        .map(|mut job| {
            let rules = job.rules.iter_mut().chain(&mut job.lines).map(|rule| &mut rule.place);
            let locks = job.locks.iter_mut().map(|lock| &mut lock.place);
            rules.chain(locks).chain(&mut job.places).for_each(Location::of_option);
            job
        })
        .map_err(|problems| {
            problems.into_iter().map(|problem| Diagnostic { line: None, column: None, ..problem }).collect()
        })
}

fn interpret(document: &mut Document<'_>) -> JobFile {
    document.integer("schema");
    let mut job = JobFile {
        table: document.text("table.file"),
        stated: StatedParticulars {
            length_between_perpendiculars: dimension(document, "dimensions.Lpp"),
            breadth: dimension(document, "dimensions.B"),
            draught: dimension(document, "dimensions.T"),
            depth: dimension(document, "dimensions.D"),
        },
        density: density(document),
        fairness: fairness(document),
        weight: weight(document),
        tolerance: positive(document, "tolerance.table", "length; what must not move is locked under [lock]"),
        exclude_suspects: document.switch("suspects.exclude"),
        price: price(document),
        froude_numbers: document.froude_numbers("waves.froude_numbers"),
        wave_weight: positive(document, "waves.weight", "number"),
        places: document.entries.iter().map(|e| Location::new(document, &e.key.path(), e.span.start)).collect(),
        ..JobFile::default()
    };
    table_ref::read(document, &mut job);
    hold::read(document, &mut job);
    shape::read(document, &mut job);
    job
}

impl JobFile {
    /// This job with what `other` says over it; locks, tolerances of lines and section areas are added.
    #[must_use]
    pub fn with(mut self, other: Self) -> Self {
        self.hold.retain(|(mine, _)| !other.hold.iter().any(|(quantity, _)| mine.twin() == Some(*quantity)));
        self.and(other)
    }

    /// This job and what `other` says at the same place, as another option: of two quantities that say the same both stay.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        self.stated = other.stated.over(&self.stated);
        for (quantity, target) in other.hold {
            self.hold.retain(|(mine, _)| *mine != quantity);
            self.hold.push((quantity, target));
        }
        self.tolerances.extend(other.tolerances);
        self.locks.extend(other.locks);
        self.section_areas.extend(other.section_areas);
        self.section_area_curve = other.section_area_curve.or(self.section_area_curve);
        self.rules.extend(other.rules);
        self.lines.extend(other.lines);
        self.places.extend(other.places);
        Self {
            table: other.table.or(self.table),
            accepted: other.accepted.or(self.accepted),
            density: other.density.or(self.density),
            gravity: other.gravity.or(self.gravity),
            fairness: other.fairness.or(self.fairness),
            weight: other.weight.or(self.weight),
            tolerance: other.tolerance.or(self.tolerance),
            exclude_suspects: other.exclude_suspects.or(self.exclude_suspects),
            price: other.price.or(self.price),
            froude_numbers: other.froude_numbers.or(self.froude_numbers),
            wave_weight: other.wave_weight.or(self.wave_weight),
            ..self
        }
    }

    /// The job for a table whose L_PP is `length` \[m\], and for water of the density of the file or of 1.025 t/m^3.
    ///
    /// # Errors
    /// Names of stations, waterlines, cells and lines that the table does not have, empty ranges, GM without KG, targets at
    /// a draught that is not stated; all of them.
    pub fn for_table(&self, table: &OffsetTable, length: f64) -> Result<Job, Vec<Diagnostic>> {
        let mut job = Job { fairness: self.fairness.unwrap_or_default(), ..Job::default() };
        job.weight = self.weight.flatten();
        job.exclude_suspects = self.exclude_suspects.unwrap_or(true);
        job.price = self.price;
        job.waves = self.waves();
        job.accepted = self.accepted.clone().unwrap_or_default();
        job.tolerance.table = self.tolerance;
        job.holding = self.holding(table, length);
        let mut problems = self.two_strengths();
        problems.extend(self.at_no_draught(table));
        problems.extend(self.weight_of_no_waves());
        let mut named: Vec<(TableItem, f64)> = Vec::new();
        for (mark, tolerance) in &self.tolerances {
            let found = mark.find(table);
            if let Ok(item) = &found {
                match named
                    .iter()
                    .find(|(other, other_tolerance)| other == item && (other_tolerance - tolerance).abs() > 0.0)
                {
                    Some((_, other)) => problems.push(mark.named_twice(*other, *tolerance)),
                    None => named.push((*item, *tolerance)),
                }
            }
            match found {
                Ok(TableItem::Station(station)) => job.tolerance.stations.push((station, *tolerance)),
                Ok(TableItem::Waterline(waterline)) => job.tolerance.waterlines.push((waterline, *tolerance)),
                Ok(TableItem::Cell(station, waterline)) => job.tolerance.cells.push((station, waterline, *tolerance)),
                Err(problem) => problems.push(*problem),
            }
        }
        for mark in &self.locks {
            match mark.find(table) {
                Ok(item) => job.locked.extend(item.cells(table)),
                Err(problem) => problems.push(*problem),
            }
        }
        for rule in &self.rules {
            match rule.find(table) {
                Ok(rule) => job.rules.extend(rule),
                Err(problem) => problems.push(*problem),
            }
        }
        for line in &self.lines {
            match line.find_line(table) {
                Ok(line) => job.lines.extend(line),
                Err(problem) => problems.push(*problem),
            }
        }
        let ends = table.stations.iter().map(|station| station.station.x);
        if let (Some(from), Some(to)) = (ends.clone().reduce(f64::min), ends.reduce(f64::max)) {
            for ([x, ..], place) in self.section_areas.iter().filter(|([x, ..], _)| !(from..=to).contains(x)) {
                let text = format!("no section at x = {x:.3} m: the stations stand from {from:.3} to {to:.3} m");
                problems.push(place.problem("E171", &text, "Give a position between them."));
            }
        }
        for ([x, area, band], place) in &self.section_areas {
            if !is_area(*area) || !is_area(*band) {
                let text = format!("a section area of {area:?} m2 with a band of {band:?} m2 at x = {x:.3} m");
                problems.push(place.problem("E171", &text, format!("Expected 0 to {MOST_TARGET} m2.")));
            }
        }
        let metacentric = |(quantity, target): &(Quantity, Target)| {
            *quantity == Quantity::MetacentricHeight && *target != Target::Free
        };
        let held = self.hold.iter().any(metacentric);
        if let (Some(place), false) = (self.place("hold.KG"), held) {
            let text = "the height of the centre of gravity is given, and no GM is held";
            problems.push(place.problem("E179", text, "Give hold.GM (--gm), or leave it out."));
        }
        if let (None, Some(place), true) = (self.gravity, self.place("hold.GM"), held) {
            let text = "the height of the centre of gravity is not given";
            problems.push(place.problem("E179", text, "Give hold.KG (--kg), or hold KM instead."));
        }
        job.locked.sort_unstable();
        job.locked.dedup();
        if problems.is_empty() { Ok(job) } else { Err(problems) }
    }

    /// What is asked for at a draught that neither job nor table states: a problem for each, at its place.
    fn at_no_draught(&self, table: &OffsetTable) -> Vec<Diagnostic> {
        if table.stated.states_draught() || self.stated.states_draught() {
            return Vec::new();
        }
        let problem = |place: &Location, what: &str| {
            let text = format!("{what} needs a draught, and none is stated");
            place.problem(
                "E184",
                &text,
                "Give --draught (T under [table] beside a table, under [dimensions] of a job), or leave it out. \
                 Then volume and centre of volume below the highest waterline that every station between the ends has are held.",
            )
        };
        let quantities = self.hold.iter().filter(|(_, target)| *target != Target::Free);
        let mut problems: Vec<Diagnostic> = quantities
            .filter_map(|(quantity, _)| {
                Some(problem(self.place(&format!("hold.{}", quantity.key()))?, &quantity.words()))
            })
            .collect();
        let curve = self.section_area_curve.iter().map(|(_, place)| place);
        let areas = self.section_areas.iter().map(|(_, place)| place).chain(curve);
        problems.extend(areas.map(|place| problem(place, "a section area")));
        problems.extend(self.place("waves.froude_numbers").map(|place| problem(place, "the wave resistance")));
        problems.dedup();
        problems
    }

    /// The wave resistance that joins the objective, in the water of the job.
    fn waves(&self) -> Option<WaveRequest> {
        let water = Water::of_density(self.density.unwrap_or(Conventions::default().density));
        let froude_numbers = self.froude_numbers.clone()?;
        Some(WaveRequest { froude_numbers, weight: self.wave_weight, within: None, water })
    }

    /// A weight of no wave resistance.
    fn weight_of_no_waves(&self) -> Option<Diagnostic> {
        let place = self.place("waves.weight").filter(|_| self.froude_numbers.is_none())?;
        let text = "a weight of the wave resistance is given, and no Froude numbers are";
        Some(place.problem("E125", text, "Give waves.froude_numbers (--wave-resistance), or leave it out."))
    }

    /// Keys that say how strongly a table is faired beside the one that does.
    fn two_strengths(&self) -> Vec<Diagnostic> {
        let given = [("energy.weight", self.weight.flatten().is_some()), ("inflections.cost", self.price.is_some())];
        let others = given.iter().filter(|(_, given)| self.fairness.is_some() && *given);
        let problem = |(key, _): &(&str, bool)| {
            let text = format!("fairness and {key} both say how strongly the table is faired");
            Some(self.place(key)?.problem("E170", &text, "Give one of them."))
        };
        others.filter_map(problem).collect()
    }

    /// Where a key stands, by its path.
    #[must_use]
    pub fn place(&self, key: &str) -> Option<&Location> {
        self.places.iter().rev().find(|place| place.key == key)
    }

    /// Where it names a target; none for targets that are held by default.
    #[must_use]
    pub fn place_of(&self, constraint: &Constraint) -> Option<&Location> {
        if let Constraint::SectionArea { x, .. } = constraint {
            let same = |(area, _): &&([f64; 3], Location)| area[0].total_cmp(x).is_eq();
            let row = self.section_areas.iter().find(same).map(|(_, place)| place);
            return row.or(self.section_area_curve.as_ref().map(|(_, place)| place));
        }
        let held = self.hold.iter().find(|(quantity, target)| *target != Target::Free && quantity.is_of(constraint));
        held.and_then(|(quantity, _)| self.place(&format!("hold.{}", quantity.key())))
    }

    fn holding(&self, table: &OffsetTable, length: f64) -> Holding {
        let own = matches!(self.section_area_curve, Some((AreaCurve::Table, _)));
        if self.hold.is_empty() && self.section_areas.is_empty() && !own {
            return Holding::Table;
        }
        let places: Vec<f64> = table.stations.iter().filter(|_| own).map(|station| station.station.x).collect();
        let density = self.density.unwrap_or(crate::hydrostatics::Conventions::default().density);
        hold::holding(
            &self.hold,
            &self.section_areas,
            (&places, self.section_area_band),
            [length, density, self.gravity.unwrap_or(0.0)],
        )
    }
}

/// A text, or a number as it is written.
fn name(raw: &Raw) -> Option<String> {
    match raw {
        Raw::Text(text) if !text.trim().is_empty() => Some(text.trim().to_owned()),
        Raw::Number(value) if value.is_finite() => Some(format!("{value}")),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
