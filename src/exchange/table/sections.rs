//! A table of offsets of sections given as lines of points.

use super::fields::finish;
use super::header::From;
use super::numbering::ORIGINS;
use super::outline::{Deck, Halves, branches, deviation, halves, keel_of};
use super::problem::{FilePosition, Problems};
use super::{ReadTable, TableProblem};
use crate::hull::{OffsetTable, OutlinePoint, StatedParticulars, StationOffsets, TableForm, TableLayout};
use crate::units::counted;

/// A section as a file gives it.
#[derive(Debug, Clone)]
pub(super) struct Section {
    /// Its name or number; the running number from aft where the file has none.
    pub(super) name: Option<String>,
    /// Position, positive forward \[m\].
    pub(super) x: f64,
    /// Where it begins in the file.
    pub(super) place: FilePosition,
    /// Its branches.
    pub(super) branches: Vec<Vec<OutlinePoint>>,
    /// The deck, where the file draws it.
    pub(super) deck: Option<Deck>,
}

/// From where a file counts x.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum XOrigin {
    /// From the after perpendicular.
    AfterPerpendicular,
    /// From another point, positive forward: L_PP is known, or the ends of the sections are the perpendiculars.
    Named(From),
    /// The file does not say, and the conventions can.
    Open,
    /// The file does not say.
    Unknown,
}

/// The sections of a hull.
#[derive(Debug, Clone)]
pub(super) struct Body {
    /// Name of the ship.
    pub(super) name: String,
    /// What the file states.
    pub(super) stated: StatedParticulars,
    /// The sections in the order of the file.
    pub(super) sections: Vec<Section>,
    /// From where x counts.
    pub(super) origin: XOrigin,
    /// Metres in a unit of the file.
    pub(super) unit: f64,
}

/// Half-breadths below zero by less than this part of the largest of the section are dust of other programs.
const DUST: f64 = 1e-4;

/// Refuses negative half-breadths of a half section, all of a section in one message; dust is put on the centreplane,
/// with a note.
pub(super) fn refuse_negative(points: &mut [OutlinePoint], x: f64, place: FilePosition, problems: &mut Problems) {
    let largest = points.iter().map(|p| p.y).fold(0.0, f64::max);
    let Some(least) = points.iter().map(|p| p.y).filter(|&y| y < 0.0).min_by(f64::total_cmp) else { return };
    let count = points.iter().filter(|p| p.y < 0.0).count();
    if least >= -DUST * largest {
        points.iter_mut().for_each(|p| p.y = p.y.max(0.0));
        let message = format!("section at x = {x}: {count} half-breadths down to {least} are taken as 0");
        problems.warning("W335", place, message, "");
        return;
    }
    let message = format!("section at x = {x}: {count} of {} half-breadths are negative", points.len());
    let remedy = if count == points.len() {
        "Give the side with positive y."
    } else {
        "This format has half sections: give one side only."
    };
    problems.error("E325", (place, format!("{least}").as_str()), message, remedy);
}

/// The half section of a full section of both sides: starboard, and how far port is from it \[m\]; none when there is no
/// side with a breadth.
pub(super) fn starboard_of(points: &[OutlinePoint]) -> Option<(Vec<Vec<OutlinePoint>>, f64)> {
    let Halves { starboard, port } = halves(points)?;
    match (starboard.is_empty(), port.is_empty()) {
        (true, true) => None,
        (false, true) | (true, false) => {
            let only = if port.is_empty() { starboard } else { port };
            let breadth = only.iter().flatten().map(|p| p.y).fold(0.0, f64::max);
            Some((only, breadth))
        }
        (false, false) => {
            let gap = deviation(&starboard, &port);
            Some((starboard, gap))
        }
    }
}

/// Says how far the sides of a ship given with both differ, of which `side` is taken; `gaps` are distances \[m\] with x \[m\]
/// as the file counts it.
pub(super) fn note_asymmetry(gaps: &[(f64, f64)], side: &str, problems: &mut Problems) {
    if let Some((gap, x)) = gaps.iter().copied().max_by(|a, b| a.0.total_cmp(&b.0)) {
        let many = gaps.iter().filter(|(gap, _)| *gap > 1e-3).count();
        let message = format!(
            "{} sections give both sides; {side} is taken. The sides differ by up to {gap:.4} m (x = {x:.3} m), in {many} \
             sections by more than 1 mm",
            gaps.len()
        );
        problems.warning("W331", FilePosition::FILE, message, "");
    }
}

/// The table of the sections, with every problem found so far and of their order.
pub(super) fn table(body: Body, mut problems: Problems) -> Result<ReadTable, Vec<TableProblem>> {
    let Body { name, stated, mut sections, origin, unit } = body;
    if sections.len() > super::grid::MOST_LINES {
        let message = format!("{} sections; a table has at most {}", sections.len(), super::grid::MOST_LINES);
        problems.error("E312", FilePosition::FILE, message, "");
        return finish(problems, None);
    }
    for section in &sections {
        let points = section.branches.iter().flatten().flat_map(|p| [p.y, p.z]);
        if let Some(value) = std::iter::once(section.x).chain(points).find(|v| v.abs() > super::assemble::LARGEST) {
            let message = format!("a length of {value:e} m is no ship's");
            problems.error("E321", section.place, message, "Correct the number, or its unit.");
        }
    }
    check_order(&mut sections, &mut problems);
    if sections.len() < 2 && !problems.any_errors() {
        let message = format!("only {}", counted(sections.len(), "section"));
        problems.error("E328", FilePosition::FILE, message, "At least two are needed.");
    }
    if problems.any_errors() {
        return finish(problems, None);
    }
    let shift = match origin {
        XOrigin::AfterPerpendicular => 0.0,
        XOrigin::Named(from) => from_named(from, &sections, &stated, &mut problems),
        XOrigin::Open => place_after_perpendicular(&sections, &stated, ORIGINS, &mut problems),
        XOrigin::Unknown => place_after_perpendicular(&sections, &stated, "", &mut problems),
    };
    let stations = sections
        .into_iter()
        .enumerate()
        .map(|(i, section)| {
            let outlines: Vec<Vec<OutlinePoint>> = section.branches.into_iter().flat_map(branches).collect();
            StationOffsets {
                keel_height: keel_of(&outlines),
                deck_height: section.deck.map(|deck| deck.side.z),
                deck_half_breadth: section.deck.map(|deck| deck.side.y),
                deck_centre_height: section.deck.map(|deck| deck.centre_height),
                outlines,
                ..StationOffsets::new(section.name.unwrap_or_else(|| i.to_string()), section.x + shift)
            }
        })
        .collect();
    let decimals = decimals_in_metres(problems.decimals, unit);
    let form = TableForm { layout: TableLayout::Other, decimals: Some(decimals), ..TableForm::default() };
    finish(problems, Some(OffsetTable { name, stated, stations, form, ..OffsetTable::default() }))
}

/// Decimals in metres whose step is not below that of `decimals` in units of `unit` \[m\].
pub(super) fn decimals_in_metres(decimals: usize, unit: f64) -> usize {
    let step = unit * 10f64.powi(-i32::try_from(decimals).unwrap_or(17));
    (-step.log10() + 1e-9).floor().clamp(0.0, 17.0) as usize
}

/// Sections must follow each other; a table written from the bow is turned round.
fn check_order(sections: &mut [Section], problems: &mut Problems) {
    let rises = sections.windows(2).filter(|pair| pair[1].x > pair[0].x).count();
    let falls = sections.windows(2).filter(|pair| pair[1].x < pair[0].x).count();
    let falling = falls > rises;
    for pair in sections.windows(2) {
        let (before, after) = (&pair[0], &pair[1]);
        let (code, found) = ("E323", format!("{}", after.x));
        if (after.x - before.x).abs() <= 1e-9 {
            let message = format!("two sections at x = {} m", after.x);
            problems.error(code, (after.place, found.as_str()), message, "Leave one out, or correct x.");
        } else if (after.x < before.x) != falling {
            let message = format!("section out of order: x = {} m after {} m", after.x, before.x);
            problems.error(
                code,
                (after.place, found.as_str()),
                message,
                "Sections run from stern to bow or from bow to stern.",
            );
        }
    }
    if falling {
        problems.note("stations are written from forward aft; their order is turned".to_owned());
        sections.reverse();
    }
}

/// The distance by which x is moved forward \[m\] where it counts from a point that is named.
fn from_named(from: From, sections: &[Section], stated: &StatedParticulars, problems: &mut Problems) -> f64 {
    let (Some(first), Some(last)) = (sections.first(), sections.last()) else { return 0.0 };
    let length = stated.length_between_perpendiculars;
    let (shift, assumed) = match from {
        From::AftPerpendicular => return 0.0,
        From::ForePerpendicular => (length.unwrap_or(-first.x), "the aftermost section is taken as AP"),
        From::Midship => (0.5 * length.unwrap_or(last.x - first.x), "the outermost sections are taken as AP and FP"),
    };
    let assumed = if length.is_some() { String::new() } else { format!(", and L_PP is not known: {assumed}") };
    let message = format!("sections count from {}{assumed}; moved forward by {shift:.4} m", from.as_str());
    problems.warning("W330", FilePosition::FILE, message, "");
    shift
}

/// The distance by which x is moved forward, so that it counts from AP \[m\].
///
/// A file whose aftermost section is within a fifth of the length of its origin counts from AP; one whose foremost is,
/// from FP; one with its middle there, from amidships. Otherwise, and where no length is stated, AP is at the aftermost
/// section.
fn place_after_perpendicular(
    sections: &[Section],
    stated: &StatedParticulars,
    remedy: &str,
    problems: &mut Problems,
) -> f64 {
    let (Some(first), Some(last)) = (sections.first(), sections.last()) else { return 0.0 };
    let (aft, forward) = (first.x, last.x);
    let near = 0.2 * (forward - aft);
    let (shift, origin) = if aft.abs() <= near {
        (0.0, "the after perpendicular")
    } else {
        match stated.length_between_perpendiculars {
            Some(length) if forward.abs() <= near => (length, "the forward perpendicular"),
            Some(length) if (0.5 * (aft + forward)).abs() <= near => (0.5 * length, "amidships"),
            _ => (-aft, "a point that is not named; the aftermost section is taken as AP"),
        }
    };
    let moved = if shift.abs() > 0.0 { format!("; moved forward by {shift:.4} m") } else { String::new() };
    let message =
        format!("sections from {aft:.4} to {forward:.4} m forward of the file's origin, taken as {origin}{moved}");
    problems.warning("W330", FilePosition::FILE, message, remedy);
    shift
}
