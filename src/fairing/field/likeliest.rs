//! The field of greatest likelihood: the power of the steepness that errors go with, chart, breaks and density.

use super::breaks::{FoundBreak, broken};
use super::chart::Chart;
use super::choice::{Chosen, Energies, WIDTHS, choose};
use super::likelihood::{Cell, Readings};
use super::net::Net;
use super::surface::FieldError;

/// Powers of the steepness that are tried, the first with every chart: 0 where errors are alike in y, as written digits are,
/// 1 where they are alike normal to the hull, as readings of a drawing are.
const POWERS: [f64; 3] = [0.5, 0.0, 1.0];

/// Spans of the net over those of the table.
const FINER: f64 = 1.5;

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

    fn with_density(&self, net: &Net, least: f64, widths: &[f64]) -> Self {
        let chosen = self.chosen.with_density(net, &self.readings, least, widths);
        Self::new(self.power, self.readings.clone(), chosen, net)
    }
}

/// The likeliest field of readings at which the hull is so steep; `energies` are those of a net with the spans of the table.
///
/// # Errors
/// [`FieldError`] where the readings determine none.
pub(super) fn likeliest(
    energies: &mut Energies<'_>,
    seen: &Readings,
    steepness: &[f64],
    (rectangle, least): (Chart, f64),
) -> Result<Likeliest, FieldError> {
    let coarse = energies.net;
    let mut tried: Vec<Scaled> = Vec::new();
    for power in POWERS {
        let scale = |(cell, s): (&Cell, &f64)| Cell { scale: cell.scale * s.powf(power), ..*cell };
        let cells = seen.cells.iter().zip(steepness).map(scale).collect();
        let readings = Readings { cells, inside: seen.inside.clone() };
        let earlier = tried.iter().min_by(|a, b| a.cost.total_cmp(&b.cost)).map(|best| &best.chosen);
        let chosen = choose(energies, &readings, rectangle, least, earlier);
        tried.extend(chosen.map(|chosen| Scaled::new(power, readings, chosen, coarse)));
    }
    tried.sort_by(|a, b| a.cost.total_cmp(&b.cost));
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
    let (Scaled { power, readings, chosen, .. }, net, lines) = best;
    Ok(Likeliest { power, readings, chosen, net, lines })
}
