//! Errors that the offsets of a line have in common.
//!
//! A waterline or a station that was drawn or read askew is shifted by a and turned by b, with places s from -1 to 1 along
//! the lines of its kind. Its offsets have errors e of their own besides.
//!
//! ```text
//! y = M c + a + b s + e,   var a = var b = q sigma^2
//! ```
//!
//! A smooth field takes errors of whole lines for the form of the hull, and its sections then snake from waterline to
//! waterline. What lines have in common are unknowns beside those of the field, with the likelihood of their variance
//! (Patterson and Thompson 1971; Robinson 1991).

use super::super::lines::LineCourse;
use super::choice::Chosen;
use super::likelihood::{Cell, EXACT, Observed, Readings};
use super::net::Net;

/// Heights, or places along the ship, that differ by no more are those of one line \[m\].
pub(super) const SAME: f64 = 1e-6;

/// Fewest offsets of a line that has a shift and a turn.
const FEWEST: usize = 4;

/// Ratios q: standard deviations of 1/4 to 16 times that of an offset. Beyond that it is form that the field does not follow.
const RATIOS: [f64; 7] = [0.0625, 0.25, 1.0, 4.0, 16.0, 64.0, 256.0];

/// The one that is tried first.
const FIRST: usize = 4;

/// What the lines of a table have in common.
#[derive(Debug, Clone, PartialEq)]
pub struct LineErrors {
    /// Which way the lines run.
    pub course: LineCourse,
    /// The lines.
    pub lines: Vec<Line>,
    /// Least and greatest place along them \[m\].
    pub extent: [f64; 2],
    /// q: the variance of a shift, and of a turn, over that of the error of an offset.
    pub ratio: f64,
}

/// A line of offsets.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Its height, or its place along the ship \[m\].
    pub at: f64,
    /// Its cells, with their places s along it, from -1 to 1.
    pub cells: Vec<(usize, f64)>,
}

/// Errors that lines were found to have in common.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundErrors {
    /// Which way the lines run.
    pub course: LineCourse,
    /// The lines.
    pub lines: Vec<ShiftedLine>,
    /// Their root mean square over the offsets \[m\].
    pub rms: f64,
    /// What -2 log l falls by.
    pub gain: f64,
    /// Least and greatest place along the lines \[m\].
    pub extent: [f64; 2],
}

/// A line that is shifted and turned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShiftedLine {
    /// Its height, or its place along the ship \[m\].
    pub at: f64,
    /// What its offsets are too wide by at the two ends of the extent \[m\]: a - b and a + b.
    pub ends: [f64; 2],
}

/// Where the line through (x, z) is, and the place along it.
fn line_and_place(course: LineCourse, [x, z]: [f64; 2]) -> [f64; 2] {
    match course {
        LineCourse::Waterline => [z, x],
        LineCourse::Station => [x, z],
    }
}

impl FoundErrors {
    /// What an offset at a place (x, z) is too wide by \[m\]; 0 off the lines.
    #[must_use]
    pub fn at(&self, place: [f64; 2]) -> f64 {
        let [own, along] = line_and_place(self.course, place);
        let part = (along - self.extent[0]) / (self.extent[1] - self.extent[0]);
        let line = self.lines.iter().find(|line| (line.at - own).abs() <= SAME);
        line.map_or(0.0, |line| line.ends[0] + part * (line.ends[1] - line.ends[0]))
    }

    /// In words.
    pub(in crate::fairing) fn words(&self) -> String {
        let Self { course, lines, rms, gain, .. } = self;
        let off = |line: &&ShiftedLine| line.ends.into_iter().fold(0.0f64, |most, end| most.max(end.abs()));
        let most = lines.iter().max_by(|a, b| off(a).total_cmp(&off(b)));
        let most = most.map(|ShiftedLine { at, ends: [first, last] }| {
            let ends = [first, last].map(|end| format!("{:+.1} mm", 1e3 * end));
            let [first, last] = match course {
                LineCourse::Waterline => [format!("{} aft", ends[0]), format!("{} forward", ends[1])],
                LineCourse::Station => [format!("{} at the keel", ends[0]), format!("{} at the top", ends[1])],
            };
            format!("; most at the {} {at:.3} m, {first} and {last}", course.as_str())
        });
        format!(
            "the offsets of each {} are too wide or too narrow together, by {:.1} mm RMS{}. They are taken for {} {}s that are shifted and \
             turned (-2 ln of the likelihood falls by {gain:.0})",
            course.as_str(),
            1e3 * rms,
            most.unwrap_or_default(),
            lines.len(),
            course.as_str()
        )
    }
}

impl LineErrors {
    /// Of lines of offsets at places (x, z) that are not exact; none where fewer than two lines have enough of them.
    pub(super) fn of(course: LineCourse, cells: &[Cell], place: impl Fn(&Cell) -> [f64; 2]) -> Option<Self> {
        let found = cells.iter().enumerate().filter(|(_, cell)| cell.scale > EXACT && cell.y > 0.0);
        // The number of the line, and the place along it.
        let mut places: Vec<(usize, f64, f64)> = found
            .map(|(k, cell)| (k, line_and_place(course, place(cell))))
            .map(|(k, [line, along])| (k, (line / SAME).round(), along))
            .collect();
        places.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.2.total_cmp(&b.2)));
        let wider = |[low, high]: [f64; 2], place: &(usize, f64, f64)| [low.min(place.2), high.max(place.2)];
        let [low, high] = places.iter().fold([f64::INFINITY, f64::NEG_INFINITY], wider);
        let part = |at: f64| 2.0 * (at - low) / (high - low) - 1.0;
        let lines: Vec<Line> = places
            .chunk_by(|a, b| a.1.total_cmp(&b.1).is_eq())
            .filter(|line| line.len() >= FEWEST)
            .map(|line| Line { at: SAME * line[0].1, cells: line.iter().map(|&(k, _, at)| (k, part(at))).collect() })
            .collect();
        (lines.len() > 1).then_some(Self { course, lines, extent: [low, high], ratio: RATIOS[FIRST] })
    }

    /// With the shift and the turn of each line \[m\], which lower -2 log l by `gain`.
    pub(super) fn found(&self, common: &[f64], gain: f64) -> FoundErrors {
        let pairs = || self.lines.iter().zip(common.chunks_exact(2));
        let lines =
            pairs().map(|(line, of)| ShiftedLine { at: line.at, ends: [of[0] - of[1], of[0] + of[1]] }).collect();
        let errors = || pairs().flat_map(|(line, of)| line.cells.iter().map(|(_, s)| of[0] + of[1] * s));
        let squares: f64 = errors().map(|error| error * error).sum();
        let rms = (squares / errors().count().max(1) as f64).sqrt();
        FoundErrors { course: self.course, lines, rms, gain, extent: self.extent }
    }

    /// With the ratio of greatest likelihood on the chart of a choice, and that choice with it: the first of [`RATIOS`] from
    /// its own on that is above those beside it. None where the cells determine no field.
    pub(super) fn likeliest(
        &self,
        chosen: &Chosen,
        net: &Net,
        readings: &Readings,
        least: f64,
    ) -> Option<(Self, Chosen)> {
        let rough = chosen.roughness(net).ok()?;
        let readings = Readings { common: Some(self.clone()), ..readings.clone() };
        let mut observed = Observed::new(net, &chosen.chart, &readings);
        let mut of = |ratio: f64, start: f64| {
            observed.set_ratio(ratio);
            Some((ratio, chosen.weighed_with(&rough, &observed, start, least, f64::INFINITY)?))
        };
        let own = RATIOS.partition_point(|ratio| *ratio < self.ratio);
        let mut best = of(self.ratio, chosen.exponent)?;
        let [above, below] = [(own + 1..RATIOS.len()).collect::<Vec<_>>(), (0..own).rev().collect()];
        for side in [above, below] {
            let from = best.0;
            for k in side {
                let next = of(RATIOS[k], best.1.exponent)?;
                if next.1.field.cost >= best.1.field.cost {
                    break;
                }
                best = next;
            }
            if best.0 > from {
                break;
            }
        }
        let (ratio, found) = best;
        Some((Self { ratio, ..self.clone() }, found))
    }
}
