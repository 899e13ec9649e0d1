//! Waterlines and buttocks of a table of lines: where they lie, and whether the section that they make can be true.
//!
//! `WL 6` may be at 6 feet, at 6 inches, or the sixth of equal spaces. The lines of the same stations judge: a waterline lies
//! between the lowest and the highest of them, and the section through both goes out as it goes up.

use super::super::assemble::TableReader;
use super::super::header::{Coordinate, Position};
use super::super::problem::{Field, FilePosition};
use super::super::settings::metres;
use super::super::settings::prose::spacing;
use super::LinePoint;
use super::groups::{Group, Lines, across};
use crate::hull::Cell;
use crate::units::Notation;

/// Points of a section nearer than this are at one height, and offsets differ by no more \[m\].
const NEAR: f64 = 0.005;
/// A half-breadth between two points of a section over the larger of theirs, at most; of sides that fall home.
const TUMBLEHOME: f64 = 1.25;
/// A lowest point of a section within this part of its half-breadth is on the keel.
const KEEL: f64 = 0.25;
/// One point of so many, at most, lies outside the section where positions are right.
const SHARE: usize = 4;

/// A waterline or a buttock with its values.
struct Cut<'g> {
    label: &'g Field,
    place: Position,
    /// The unit that its heading states.
    unit: Option<Notation>,
    /// Stations and cells.
    cells: Vec<(usize, Cell)>,
}

impl Cut<'_> {
    /// Its number, where it states no length and is not the base line.
    fn number(&self) -> Option<f64> {
        match self.place.place {
            Coordinate::Number(number) if number.abs() > 0.0 => Some(number),
            _ => None,
        }
    }
}

/// Waterlines (`half`), with half-breadths at heights, or buttocks, with heights at half-breadths.
#[derive(Clone, Copy)]
struct Kind {
    half: bool,
}

impl Kind {
    fn noun(self) -> &'static str {
        if self.half { "waterline" } else { "buttock" }
    }

    fn point(self, place: f64, value: f64) -> [f64; 2] {
        if self.half { [value, place] } else { [place, value] }
    }
}

/// A section as its lines give it.
#[derive(Default)]
struct Known {
    /// Half-breadths and heights, from the lowest.
    points: Vec<[f64; 2]>,
    /// Whether the lowest point is the keel, and the highest the sheer.
    ends: [bool; 2],
}

impl Known {
    fn of(points: &[LinePoint], stations: usize) -> Vec<Self> {
        let mut all: Vec<Self> = (0..stations).map(|_| Self::default()).collect();
        let is_top = |name: &str| ["sheer", "deck", "gunwale", "rail"].iter().any(|word| name.contains(word));
        for point in points {
            let known = &mut all[point.station];
            known.points.push([point.y, point.z]);
            known.ends[1] |= !point.is_cut && is_top(&point.name);
        }
        for known in &mut all {
            known.points.sort_by(|a, b| a[1].total_cmp(&b[1]));
            let most = known.points.iter().map(|point| point[0]).fold(0.0, f64::max);
            known.ends[0] = known.points.first().is_some_and(|lowest| lowest[0] <= KEEL * most);
        }
        all
    }

    /// Whether a point is outside the section; none where the lines do not tell.
    fn excludes(&self, [y, z]: [f64; 2]) -> Option<bool> {
        let (low, high) = (self.points.first()?[1], self.points.last()?[1]);
        if self.points.len() < 2 || y < NEAR {
            return None;
        }
        if z < low - NEAR || z > high + NEAR {
            return self.ends[usize::from(z > high)].then_some(true);
        }
        let below = self.points.iter().rev().find(|point| point[1] <= z + NEAR)?[1];
        let above = self.points.iter().find(|point| point[1] >= z - NEAR)?[1];
        let beside = self.points.iter().filter(|p| (p[1] - below).abs() <= NEAR || (p[1] - above).abs() <= NEAR);
        let (least, most) = beside.fold((f64::INFINITY, 0.0_f64), |(a, b), p| (a.min(p[0]), b.max(p[0])));
        Some(y < least - NEAR || y > TUMBLEHOME * most + NEAR)
    }

    /// The half-breadth at a height on straight lines between the points, over the largest.
    fn off(&self, [y, z]: [f64; 2]) -> f64 {
        let most = self.points.iter().map(|point| point[0]).fold(f64::MIN_POSITIVE, f64::max);
        let pair = self.points.windows(2).find(|pair| pair[0][1] <= z && z < pair[1][1]);
        let between = |pair: &[[f64; 2]]| {
            let share = (z - pair[0][1]) / (pair[1][1] - pair[0][1]);
            pair[0][0] + share * (pair[1][0] - pair[0][0])
        };
        (y - pair.map_or(0.0, between)).abs() / most
    }
}

/// How points agree with the lines.
#[derive(Default, Clone, Copy)]
struct Verdict {
    judged: usize,
    outside: usize,
    off: f64,
}

impl Verdict {
    fn fits(self) -> bool {
        SHARE * self.outside <= self.judged
    }
}

fn verdict(kind: Kind, cuts: &[Cut<'_>], known: &[Known], at: impl Fn(&Cut<'_>) -> Option<f64>) -> Verdict {
    let mut all = Verdict::default();
    for cut in cuts {
        let Some(place) = at(cut) else { continue };
        for (station, cell) in &cut.cells {
            let Some(value) = cell.value() else { continue };
            let point = kind.point(place, value);
            if let Some(outside) = known[*station].excludes(point) {
                all.judged += 1;
                all.outside += usize::from(outside);
                all.off += known[*station].off(point);
            }
        }
    }
    all
}

/// Adds the points of waterlines and of buttocks to those of the lines.
pub(super) fn points(
    lines: &Lines<'_>,
    heads: &[(usize, Position)],
    reader: &mut TableReader<'_>,
    points: &mut Vec<LinePoint>,
) {
    for kind in [Kind { half: true }, Kind { half: false }] {
        let cuts = cuts(kind, lines, heads, reader);
        let known = Known::of(points, heads.len());
        let Some(number) = number(kind, &cuts, &known, lines, reader) else { continue };
        let at = |cut: &Cut<'_>| match cut.place.place {
            Coordinate::Number(own) => number.place(cut, own),
            Coordinate::Length(length) => length,
            Coordinate::AftPerpendicular | Coordinate::ForePerpendicular | Coordinate::Midship => 0.0,
        };
        for cut in &cuts {
            let place = at(cut);
            contradiction(kind, cut, place, &known, reader);
            for (station, cell) in &cut.cells {
                let Some(value) = cell.value() else { continue };
                let [y, z] = kind.point(place, value);
                let written = cell.written.clone();
                let cells = if kind.half { [written, None] } else { [None, written] };
                let name = cut.label.trimmed().to_owned();
                points.push(LinePoint { station: *station, name, is_cut: true, y, z, cells });
            }
        }
    }
}

/// The rows of a kind, with their cells.
fn cuts<'g>(kind: Kind, lines: &Lines<'g>, heads: &[(usize, Position)], reader: &mut TableReader<'_>) -> Vec<Cut<'g>> {
    let group = if kind.half { Group::HalfBreadths } else { Group::Heights };
    let mut list = Vec::new();
    for row in lines.rows.iter().filter(|row| row.group == Some(group)) {
        let Some(place) = across(row) else { continue };
        let mut cell = |(station, (at, _)): (usize, &(usize, Position))| {
            Some((station, reader.cell(row.cells.get(*at)?, kind.half)))
        };
        let cells = heads.iter().enumerate().filter_map(&mut cell).collect();
        list.push(Cut { label: row.label, place, unit: row.unit, cells });
    }
    list
}

/// What the numbers of waterlines or of buttocks count.
#[derive(Clone, Copy)]
struct Number {
    /// Metres for one.
    metres: f64,
    /// The same of numbers with words, `WL 3`, where these count equal spaces.
    spacing: Option<f64>,
}

impl Number {
    fn place(self, cut: &Cut<'_>, number: f64) -> f64 {
        match (self.spacing.filter(|_| cut.place.named), cut.unit) {
            (Some(spacing), _) => spacing * number,
            (None, Some(unit)) => unit.metres(number),
            (None, None) => self.metres * number,
        }
    }
}

/// What numbers count, by the conventions, by a sentence, by the headings, or by what the lines allow; none, with an error,
/// where the lines allow nothing.
fn number(
    kind: Kind,
    cuts: &[Cut<'_>],
    known: &[Known],
    lines: &Lines<'_>,
    reader: &mut TableReader<'_>,
) -> Option<Number> {
    let settings = reader.settings;
    let own = if kind.half { reader.units.z } else { reader.units.y };
    let (stated, unit) = match kind.half {
        true => (settings.waterline_spacing, settings.z_units),
        false => (settings.buttock_spacing, None),
    };
    let own_number = Number { metres: own.metres(1.0), spacing: stated };
    let named = || cuts.iter().filter(|cut| cut.number().is_some() && cut.place.named);
    if stated.is_some() || cuts.iter().all(|cut| cut.number().is_none()) {
        return Some(own_number);
    }
    let mut said = lines.texts().filter_map(|text| Some((text, spacing_of(text, kind)?)));
    let sentence = if kind.half { &settings.sentences.waterlines } else { &settings.sentences.buttocks };
    let sentence = sentence.as_ref().map(|(spacing, words)| (words.as_str(), *spacing));
    if let Some((text, spacing)) = said.next().or(sentence).filter(|_| named().next().is_some()) {
        let message = format!("'{text}' says that {}s are {} m apart", kind.noun(), metres(spacing));
        let remedy = format!("Give {}_spacing in the conventions if it does not", kind.noun());
        reader.problems.warning("W320", FilePosition::FILE, message, &remedy);
        return Some(Number { spacing: Some(spacing), ..own_number });
    }
    let open: Vec<&Cut<'_>> = cuts.iter().filter(|cut| cut.number().is_some() && cut.unit.is_none()).collect();
    let (Some(first), Some(last)) = (open.first(), open.last()) else { return Some(own_number) };
    if unit.is_some() {
        return Some(own_number);
    }
    let units = candidates(own);
    let judge = |unit: Notation| {
        verdict(kind, cuts, known, |cut| cut.number().filter(|_| cut.unit.is_none()).map(|n| unit.metres(n)))
    };
    let verdicts: Vec<(Notation, Verdict)> = units.iter().map(|unit| (*unit, judge(*unit))).collect();
    let off = |v: &Verdict| v.off / v.judged.max(1) as f64;
    let fitting = verdicts.iter().filter(|(_, verdict)| verdict.fits());
    let best = match verdicts.first().filter(|(_, verdict)| verdict.fits()) {
        Some(own) => Some(own),
        // Numbers one after the other count spaces.
        None if follow(&open) => None,
        None => fitting.clone().min_by(|a, b| off(&a.1).total_cmp(&off(&b.1))),
    };
    let numbers = format!("{}s '{}' to '{}' are numbers", kind.noun(), first.label.trimmed(), last.label.trimmed());
    let feet = matches!(own, Notation::Feet | Notation::FeetInchesEighths | Notation::Inches);
    let remedy = format!(
        "Give {}_spacing in the conventions, or positions with their unit, as '{} {}'",
        kind.noun(),
        if kind.half { "WL" } else { "Butt" },
        if feet { "0-9-0" } else { "0.25 m" }
    );
    let outside = |(unit, verdict): &(Notation, Verdict)| {
        format!("as {} {} of {} points are outside the lines", plural(*unit), verdict.outside, verdict.judged)
    };
    let Some(best) = best else {
        let why: Vec<String> = verdicts.iter().map(outside).collect();
        let message = format!("{numbers}, and their spacing is not known: {}", why.join(", "));
        reader.problems.error("E310", first.label, message, &remedy);
        return None;
    };
    if best.0 != units[0] {
        let why = outside(&verdicts[0]);
        let message = format!("{numbers}, and nothing states their unit: taken as {}; {why}", plural(best.0));
        reader.problems.warning("W320", FilePosition::FILE, message, &remedy);
    } else if may_count(&open, own) {
        let message = format!("{numbers}, and their spacing is not known: taken as 1 {} apart", best.0.as_str());
        reader.problems.warning("W320", FilePosition::FILE, message, &remedy);
    }
    Some(Number { metres: best.0.metres(1.0), spacing: None })
}

/// A unit as a word; `in` alone is a preposition.
fn plural(unit: Notation) -> &'static str {
    match unit {
        Notation::Metres => "metres",
        Notation::Centimetres => "centimetres",
        Notation::Millimetres => "millimetres",
        Notation::Feet | Notation::FeetInchesEighths => "feet",
        Notation::Inches => "inches",
    }
}

/// Units that numbers may have, that of the table first.
fn candidates(own: Notation) -> Vec<Notation> {
    let (own, others) = match own {
        Notation::Feet | Notation::FeetInchesEighths => (Notation::Feet, vec![Notation::Inches]),
        Notation::Inches => (own, vec![Notation::Feet]),
        Notation::Metres => (own, vec![Notation::Centimetres, Notation::Millimetres]),
        Notation::Centimetres => (own, vec![Notation::Metres, Notation::Millimetres]),
        Notation::Millimetres => (own, vec![Notation::Metres, Notation::Centimetres]),
    };
    [vec![own], others].concat()
}

/// Whether positions may be counts of spaces: names with quarters and no decimal sign. Of feet, inches and eighths any
/// number is open, and of small units only numbers that follow each other.
fn may_count(cuts: &[&Cut<'_>], own: Notation) -> bool {
    let counts = |cut: &&Cut<'_>| {
        let quarters = cut.number().is_some_and(|number| (4.0 * number).fract().abs() < 1e-9);
        cut.place.named && quarters && !cut.label.trimmed().contains(['.', ','])
    };
    match own {
        Notation::FeetInchesEighths => true,
        Notation::Centimetres | Notation::Millimetres => cuts.iter().all(counts) && follow(cuts),
        Notation::Metres | Notation::Feet | Notation::Inches => cuts.iter().all(counts),
    }
}

/// Whether most numbers are one more than another.
fn follow(cuts: &[&Cut<'_>]) -> bool {
    let numbers: Vec<f64> = cuts.iter().filter_map(|cut| cut.number()).collect();
    let before = |number: &&f64| numbers.iter().any(|other| (**number - other - 1.0).abs() < 1e-9);
    2 * numbers.iter().filter(before).count() >= numbers.len()
}

/// The spacing that a sentence gives: `Waterlines 9 in apart`, `buttock spacing: 6 in`.
fn spacing_of(text: &str, kind: Kind) -> Option<f64> {
    let lower = text.to_lowercase();
    let names: [&str; 4] =
        if kind.half { ["waterlines", "waterline", "wls", "wl"] } else { ["buttocks", "buttock", "butts", "butt"] };
    spacing(&lower, &names)
}

/// Says where a line that states its position contradicts the others at most stations.
fn contradiction(kind: Kind, cut: &Cut<'_>, place: f64, known: &[Known], reader: &mut TableReader<'_>) {
    let found = verdict(kind, std::slice::from_ref(cut), known, |_| Some(place));
    if found.judged > 1 && 2 * found.outside > found.judged {
        let message = format!(
            "the {} '{}' is outside the section of the other lines at {} of {} stations",
            kind.noun(),
            cut.label.trimmed(),
            found.outside,
            found.judged
        );
        let remedy = "Correct its position, or the values of its row";
        reader.problems.warning("W336", cut.label.place(), message, remedy);
    }
}
