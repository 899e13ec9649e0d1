//! The field of greatest likelihood: the power of the steepness that errors go with, chart, breaks and density.

use super::breaks::{FoundBreak, broken};
use super::chart::Chart;
use super::choice::{Chosen, Energies, WIDTHS, choose};
use super::error::FieldError;
use super::likelihood::{Cell, Readings};
use super::line_errors::LineErrors;
use super::net::Net;

/// Powers of the steepness that are tried, the first with every chart: 0 where errors are alike in y, as written digits are,
/// 1 where they are alike normal to the hull, as readings of a drawing are.
const POWERS: [f64; 3] = [0.5, 0.0, 1.0];

/// Spans of the net over those of the table.
const FINER: f64 = 1.5;

/// What -2 log l of the first charts falls by where it is worth a look whether lines have errors in common: strong evidence
/// (Kass and Raftery 1995).
const SEEN: f64 = 10.0;

/// What it has to fall by for each line that has errors in common: as much for a shift as for a turn, the square of two and a
/// half standard errors.
const COMMON: f64 = 12.5;

/// The part of this by which the likeliest charts must be likelier, before breaks and a density are looked for.
const SHOWN: f64 = 0.25;

/// Ratio by which the errors of single offsets may be larger where lines have errors in common than where they have none:
/// these are taken out of them. Form that the field does not follow leaves larger ones.
const LARGER: f64 = 1.5;

/// What is likeliest.
pub(super) struct Likeliest {
    /// The power of the steepness that the errors go with.
    pub(super) power: f64,
    /// What it is made from, with the scales of the errors.
    pub(super) readings: Readings,
    /// Chart, weight and field.
    pub(super) chosen: Chosen,
    /// The net of the field.
    pub(super) net: Net,
    /// Lines across which it breaks.
    pub(super) lines: Vec<FoundBreak>,
    /// What -2 log l falls by where lines have errors in common.
    pub(super) gain: f64,
}

/// A choice with errors that go with a power of the steepness.
#[derive(Clone)]
struct Scaled {
    /// -2 log l with the scales of the errors.
    cost: f64,
    power: f64,
    readings: Readings,
    chosen: Chosen,
}

impl Scaled {
    fn new(power: f64, readings: Readings, chosen: Chosen, net: &Net) -> Self {
        let jacobian = readings.cells.iter().map(|cell| 2.0 * cell.scale.ln()).sum::<f64>();
        Self { cost: chosen.field.cost + chosen.price(net) + jacobian, power, readings, chosen }
    }

    /// With the breaks that it shows.
    fn broken(&self, net: &Net, spans: [usize; 2], least: f64) -> (Self, Net, Vec<FoundBreak>) {
        let (net, chosen, lines) = broken(net.clone(), spans, &self.readings, self.chosen.clone(), least);
        (Self::new(self.power, self.readings.clone(), chosen, &net), net, lines)
    }

    /// Whether the errors of single offsets are no larger than another's ([`LARGER`]).
    fn has_no_larger_errors(&self, other: &Self) -> bool {
        self.chosen.field.sigma <= LARGER * other.chosen.field.sigma
    }

    /// What it costs where lines have no errors in common.
    fn without_common(&self, net: &Net, least: f64) -> f64 {
        let readings = Readings { common: None, ..self.readings.clone() };
        let without = self.chosen.on(net, &readings, self.chosen.exponent, least, f64::INFINITY);
        without.map_or(f64::INFINITY, |without| self.cost + without.field.cost - self.chosen.field.cost)
    }

    fn with_density(&self, net: &Net, least: f64, widths: &[f64]) -> Self {
        let chosen = self.chosen.with_density(net, &self.readings, least, widths);
        Self::new(self.power, self.readings.clone(), chosen, net)
    }
}

/// The likeliest field of readings at which the hull is so steep, and whose lines may have errors in common; `energies` are
/// those of a net with the spans of the table.
///
/// # Errors
/// [`FieldError`] where the readings determine none.
pub(super) fn likeliest(
    energies: &mut Energies<'_>,
    seen: &Readings,
    (steepness, lines): (&[f64], &[LineErrors]),
    (rectangle, least): (Chart, f64),
) -> Result<Likeliest, FieldError> {
    let tried = charts(energies, seen, steepness, (rectangle, least));
    let first = tried.first().ok_or(FieldError::Undetermined)?.clone();
    let (mut best, mut gain) = (finished(energies.net, tried, least)?, 0.0);
    let in_common = |lines: &LineErrors| {
        let (lines, chosen) = lines.likeliest(&first.chosen, energies.net, &first.readings, least)?;
        let gain = first.chosen.field.cost - chosen.field.cost;
        (gain > SEEN).then_some((gain, lines))
    };
    if let Some((_, lines)) = lines.iter().filter_map(in_common).max_by(|a, b| a.0.total_cmp(&b.0)) {
        let count = lines.lines.len();
        let seen = Readings { common: Some(lines), ..seen.clone() };
        let tried = charts(energies, &seen, steepness, (rectangle, least));
        let needed = COMMON * count as f64;
        let shows = |with: &Scaled| with.has_no_larger_errors(&first) && first.cost - with.cost > SHOWN * needed;
        if tried.first().is_some_and(shows)
            && let Ok(found) = finished(energies.net, tried, least)
            && found.0.has_no_larger_errors(&best.0)
        {
            let fall = best.0.cost.min(found.0.without_common(&found.1, least)) - found.0.cost;
            if fall > needed {
                (best, gain) = (found, fall);
            }
        }
    }
    let (Scaled { power, readings, chosen, .. }, net, lines) = best;
    Ok(Likeliest { power, readings, chosen, net, lines, gain })
}

/// The likeliest chart for each power of the steepness, the likeliest first; each with the likeliest ratio of what lines have
/// in common.
fn charts(
    energies: &mut Energies<'_>,
    seen: &Readings,
    steepness: &[f64],
    (rectangle, least): (Chart, f64),
) -> Vec<Scaled> {
    let coarse = energies.net;
    let mut tried: Vec<Scaled> = Vec::new();
    for power in POWERS {
        let scale = |(cell, s): (&Cell, &f64)| Cell { scale: cell.scale * s.powf(power), ..*cell };
        let cells = seen.cells.iter().zip(steepness).map(scale).collect();
        let mut readings = Readings { cells, ..seen.clone() };
        let earlier = tried.iter().min_by(|a, b| a.cost.total_cmp(&b.cost)).map(|best| &best.chosen);
        let Some(mut chosen) = choose(energies, &readings, rectangle, least, earlier) else { continue };
        if let Some((lines, found)) =
            readings.common.as_ref().and_then(|lines| lines.likeliest(&chosen, coarse, &readings, least))
        {
            (readings.common, chosen) = (Some(lines), found);
        }
        tried.push(Scaled::new(power, readings, chosen, coarse));
    }
    tried.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    tried
}

/// The likeliest of some charts on a finer net than the `coarse` one, with its breaks and its density.
///
/// # Errors
/// [`FieldError`] where there is none.
fn finished(coarse: &Net, tried: Vec<Scaled>, least: f64) -> Result<(Scaled, Net, Vec<FoundBreak>), FieldError> {
    let spans = [0, 1].map(|k| (FINER * (coarse.knots[k].breakpoints().len() - 1) as f64).round() as usize);
    let net = Net::uniform(spans, coarse.intervals)?;
    let on_finer = |Scaled { power, readings, chosen, .. }: Scaled| {
        let chosen = chosen.on(&net, &readings, chosen.exponent, least, f64::INFINITY)?;
        Some(Scaled::new(power, readings, chosen, &net))
    };
    let mut tried = tried.into_iter().filter_map(on_finer);
    let first = tried.next().ok_or(FieldError::Undetermined)?;
    // Breaks, and then a density of the energy.
    let (scaled, broken_net, lines) = first.broken(&net, spans, least);
    let unbroken = lines.is_empty();
    let mut best = (scaled.with_density(&broken_net, least, &WIDTHS), broken_net, lines);
    if let Some(width) = best.0.chosen.density.as_ref().map(|density| density.width) {
        // Where the hull bends unlike from place to place, the power and the breaks are known after that alone.
        let with_density = |scaled: Scaled| scaled.with_density(&net, least, &[width]);
        let first = if unbroken { best.0.clone() } else { with_density(first) };
        let dense = std::iter::once(first).chain(tried.map(with_density));
        if let Some(scaled) = dense.min_by(|a, b| a.cost.total_cmp(&b.cost)) {
            let other = scaled.broken(&net, spans, least);
            if other.0.cost < best.0.cost {
                best = other;
            }
        }
    }
    Ok(best)
}
