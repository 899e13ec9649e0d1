//! Least inflections on the lines of a table, as signs that the surface is asked to have.
//!
//! For each station and waterline the offsets with their tolerances have a proved least number of inflections
//! ([`super::inflections`]), and a curve that has it. Where a line of the surface bends more often, it is asked for the
//! signs of that curve; the inflections are free within the intervals in which they can lie. Lines are taken together
//! into one program, so that they can contradict each other. The price of a line is
//!
//! ```text
//! sum_k |z_k| v_k / sigma^2
//! ```
//!
//! over its rows, z the multipliers and v the violations at the net without them: by convexity the objective rises by
//! no more than the sum over all lines. What one may cost is said in `fairing::humps`.

use super::bends::{Bend, Line, bends, dead};
use super::inflections::{Bands, Inflections, minimum_inflections};
use super::model::{Limit, value};
use super::surface::{FairSurface, Origin};

/// y'' below this part of its largest value has no sign.
const STRAIGHT: f64 = 1e-6;

/// A line of the table.
#[derive(Debug, Clone)]
pub struct TableLine {
    /// Which.
    pub line: Line,
    /// Its bends on the surface.
    pub bends: Vec<Bend>,
    /// The least number of inflections, when the line has offsets enough.
    pub least: Option<Inflections>,
}

/// Offsets of a line with their tolerances.
fn bands(surface: &FairSurface, line: Line) -> Option<Bands> {
    let same = 1e-9 * surface.hull.particulars().length_between_perpendiculars;
    // Where a line of the net may break, the curve has a knuckle and may turn for nothing.
    let (across, net) = (usize::from(matches!(line, Line::Station(_))), surface.hull.surface());
    let knots = [net.u(), net.v()][across];
    let near = 1e-9 * (knots.domain().1 - knots.domain().0);
    // A field is smooth across the corners of its chart.
    let may_break = |&t: &f64| !surface.is_field && knots.multiplicity(t) >= knots.degree();
    let breaks: Vec<f64> = knots.breakpoints().into_iter().filter(may_break).collect();
    let mut points: Vec<(f64, f64, f64, bool)> = Vec::new();
    let mut on_outline: Vec<([usize; 2], f64)> = Vec::new();
    for (place, reading) in surface.places.iter().zip(&surface.model.readings) {
        let site = match (line, place.origin) {
            // A point reads the surface at the height of the chart, which may be beside its own.
            (Line::Station(x), Origin::Point { .. }) if (place.x - x).abs() < same => {
                net.eval(place.at[0], place.at[1])[2]
            }
            (Line::Station(x), _) if (place.x - x).abs() < same => place.z,
            (Line::Waterline(z), Origin::HalfBreadth { .. } | Origin::Deck { .. }) if (place.z - z).abs() < same => {
                place.x
            }
            _ => continue,
        };
        if let Origin::Point { outline, point, .. } = place.origin {
            on_outline.push(([outline, point], site));
        }
        if let Some(tolerance) = reading.tolerance {
            let broken = breaks.iter().any(|t| (place.at[across] - t).abs() <= near);
            points.push((site, reading.value, tolerance, broken));
        }
    }
    // Points of a section need not rise: they are a function of the height where one outline does all along.
    on_outline.sort_by_key(|point| point.0);
    let rises = |pair: &[([usize; 2], f64)]| pair[0].0[0] == pair[1].0[0] && pair[1].1 - pair[0].1 > same;
    if !on_outline.windows(2).all(rises) {
        return None;
    }
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points.dedup_by(|a, b| a.0 - b.0 < same);
    let list = |of: fn(&(f64, f64, f64, bool)) -> f64| points.iter().map(of).collect();
    let inside = 1..points.len().saturating_sub(1);
    let knuckles = inside.filter(|&k| points[k].3).collect();
    Bands::new(list(|p| p.0), list(|p| p.1), list(|p| p.2), knuckles).ok()
}

impl TableLine {
    /// A line of the surface with the least number of inflections of its offsets.
    #[must_use]
    pub fn new(surface: &FairSurface, line: Line) -> Self {
        let least = bands(surface, line).map(|bands| minimum_inflections(&bands));
        Self { line, bends: bends(surface, line), least }
    }

    /// The least number of inflections within the tolerances of the offsets, and whether it is proved, for a line of a
    /// net that keeps them: a net without inflection is the proof itself, else the search of [`super::inflections`].
    #[must_use]
    pub fn minimum(surface: &FairSurface, line: Line, net: &[f64]) -> Option<(usize, bool)> {
        let values: Vec<f64> = bends(surface, line).iter().map(|bend| value(&bend.numerator, net)).collect();
        let (low, high) = values.iter().fold((0.0_f64, 0.0_f64), |(a, b), v| (a.min(*v), b.max(*v)));
        if low.abs().min(high) <= STRAIGHT * low.abs().max(high) {
            return Some((0, true));
        }
        let least = minimum_inflections(&bands(surface, line)?);
        Some((least.count, least.certified()))
    }

    /// Whether the offsets allow a curve with at most `most` inflections.
    #[must_use]
    pub fn least_at_most(&self, most: usize) -> bool {
        self.least.as_ref().is_some_and(|least| least.curve.is_some() && least.count <= most)
    }

    /// Limits that ask for the signs of the curve with the least inflections, with room as at `start`.
    #[must_use]
    pub fn signs_of_least(&self, start: &[f64]) -> Vec<Limit> {
        let Some((least, curve)) = self.least.as_ref().and_then(|least| Some((least, least.curve.as_ref()?))) else {
            return Vec::new();
        };
        let (from, to) = curve.knots().domain();
        let second = |x: f64| curve.derivatives::<3>(x)[2][0];
        let inside: Vec<&Bend> = self.bends.iter().filter(|bend| (from..=to).contains(&bend.at)).collect();
        let values: Vec<f64> = inside.iter().map(|bend| second(bend.at)).collect();
        let largest = values.iter().fold(0.0, |largest: f64, k| largest.max(k.abs()));
        let bent: Vec<i8> =
            values.iter().map(|k| if k.abs() <= STRAIGHT * largest { 0 } else { k.signum() as i8 }).collect();
        let asked = filled(&bent);
        let free: Vec<[f64; 2]> = least
            .stretches
            .iter()
            .flat_map(|stretch| &stretch.inflections)
            .map(|interval| [interval.from.min(interval.at), interval.to.max(interval.at)])
            .collect();
        let free = |x: f64| free.iter().any(|[a, b]| (*a..=*b).contains(&x));
        let none = dead(&self.bends, start);
        let asked = inside.into_iter().zip(asked).filter(|(bend, sign)| *sign != 0 && !free(bend.at));
        asked.filter_map(|(bend, sign)| bend.limit(sign > 0, start, none)).collect()
    }
}

/// Between its bends the curve of an optimal basis is straight: signs with those of both neighbours in place of zeros,
/// or of the one neighbour at an end; zeros where the neighbours differ.
fn filled(signs: &[i8]) -> Vec<i8> {
    let mut filled = signs.to_vec();
    let mut last = None;
    for k in 0..=signs.len() {
        let here = signs.get(k).copied();
        if here == Some(0) {
            continue;
        }
        let before = last.map(|k: usize| signs[k]);
        if let Some(sign) = before.or(here).filter(|sign| here.is_none_or(|here| here == *sign)) {
            filled[last.map_or(0, |k| k + 1)..k].fill(sign);
        }
        last = Some(k);
    }
    filled
}

#[cfg(test)]
mod tests {
    use super::filled;

    #[test]
    fn straight_parts_bend_as_beside_them_where_that_is_one_way() {
        let cases: [(&[i8], &[i8]); 5] = [
            (&[1, 0, 0, 1, 0], &[1, 1, 1, 1, 1]),
            (&[0, -1, 0, 1, 0, 0, 1], &[-1, -1, 0, 1, 1, 1, 1]),
            (&[0, 0], &[0, 0]),
            (&[-1, 1], &[-1, 1]),
            (&[], &[]),
        ];
        for (given, expected) in cases {
            assert_eq!(filled(given), expected, "{given:?}");
        }
    }
}
