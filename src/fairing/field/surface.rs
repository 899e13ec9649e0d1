//! From the offsets of a table to the chart of its hull.

use super::super::lines::LineCourse;
use super::bent::Bent;
use super::breaks::FoundBreak;
use super::chart::{Chart, Shape};
use super::choice::{Chosen, Energies};
use super::error::FieldError;
use super::likeliest::{Likeliest, likeliest};
use super::likelihood::{ALLOWED, Cell, EXACT, Observed, Readings, Smoothed, smoothed};
use super::line_errors::{FoundErrors, LineErrors, SAME};
use super::net::{Break, CLOSE, DEGREE, Metric, Net};
use super::observed::{End, Observations, Zero, ZeroKind};
use super::region::{Bend, Field, steepness};
use super::rocker::Rocker;
use crate::spline::{KnotVector, SplineError};
use std::f64::consts::PI;

/// Heights a span at which the kind of an end is looked at.
const SAMPLES: usize = 8;

/// The metric of a first field.
const FIRST_METRIC: Metric = Metric { anisotropy: 1.0, mixed: 1.0 };

/// Ratio of likelihoods below which a zero beside the hull is none of it: strong evidence (Kass and Raftery 1995).
const NO_ZERO: f64 = 0.05;

/// Standard deviations from which a field has breadth at a zero.
const BREADTH: f64 = 2.0;

/// Distance in v at which the sides of a corner are looked at.
const BESIDE: f64 = 1e-6;

/// What the net of a hull may miss its field by between its knots, over the noise and over the greatest half-breadth.
const MISSED: [f64; 2] = [0.05, 5e-5];

/// How often a span along v is halved at most where an end has too few knots.
const HALVINGS: usize = 2;

/// Rounds in which the side above the deck is kept from closing, and a waterline made to close.
const ROUNDS: usize = 4;

/// Least noise over the length of the half-breadths where no digit says it.
const LEAST_NOISE: f64 = 1e-7;

/// A field with the chart of its hull.
#[derive(Debug, Clone)]
pub struct ChartedField {
    /// Its net.
    pub net: Net,
    /// Chart, weight and field.
    pub chosen: Chosen,
    /// The field itself.
    pub field: Field,
    /// The chart of the hull.
    pub bent: Bent,
    /// Lines across which it breaks.
    pub lines: Vec<FoundBreak>,
    /// What its lines are off by in common.
    pub line_errors: Option<FoundErrors>,
    /// The power of the steepness of the hull that the errors go with.
    pub power: f64,
    /// What is not exact.
    pub inexact: Vec<Cell>,
    /// Residuals of these, without what lines are off by in common, over the scale of their errors \[m\].
    pub residuals: Vec<f64>,
    /// Correlation of the residuals of neighbouring stations on a waterline, or of neighbouring points of a section, over
    /// its standard deviation for errors that are independent: errors have none, or a negative one, and the form of a hull
    /// that the field does not follow has a positive one (Durbin and Watson 1950).
    pub correlation: f64,
    /// The keel line to which its heights are relative.
    pub rocker: Option<Rocker>,
}

impl ChartedField {
    /// The field of greatest likelihood through the readings of a table of so many stations and waterlines, whose offsets
    /// are written to `resolution` \[m\].
    ///
    /// # Errors
    /// [`FieldError`] where they determine none.
    pub fn new(seen: &Observations, [stations, waterlines]: [usize; 2], resolution: f64) -> Result<Self, FieldError> {
        let [length, height] = seen.extent;
        let spans = [stations.max(4), waterlines.max(4)];
        let net = Net::uniform(spans, [stations as f64 - 1.0, waterlines as f64 - 1.0])?;
        let rectangle = Chart { length, height, shape: Shape { keel: 0.1, ends: [0.0; 2] } };
        let greatest = seen.readings.iter().fold(0.0f64, |m, cell| m.max(cell.y));
        let least = (resolution / 12f64.sqrt()).max(LEAST_NOISE * 2.0 * greatest);
        let mut energies = Energies::new(&net);
        let mut seen = seen.clone();
        settle(&mut seen, &mut energies, rectangle, least);
        let seen = &seen;
        let readings = seen.of_field();
        let (_, first) = smooth_first(&mut energies, &readings, rectangle, least).ok_or(FieldError::Undetermined)?;
        let field = Field::new(rectangle, &net, &first.values)?;
        let steep = |cell: &Cell| steepness(slopes(&field, seen.rocker.as_ref(), [cell.x, cell.z]));
        let steepness: Vec<f64> = seen.readings.iter().map(steep).collect();
        let place =
            |cell: &Cell| [cell.x, seen.rocker.as_ref().map_or(cell.z, |rocker| rocker.absolute(cell.x, cell.z))];
        // Points of sections are on no waterlines.
        let courses: &[LineCourse] =
            if seen.has_points { &[LineCourse::Station] } else { &[LineCourse::Waterline, LineCourse::Station] };
        let lines: Vec<_> =
            courses.iter().filter_map(|course| LineErrors::of(*course, &readings.cells, place)).collect();
        let found = likeliest(&mut energies, &readings, (&steepness, &lines), (rectangle, least))?;
        let Likeliest { power, mut readings, mut chosen, net, lines, gain } = found;
        let mut field = Field::new(chosen.chart, &net, &chosen.field.values)?;
        let offsets = readings.cells.len();
        let weight = 10f64.powf(chosen.exponent);
        for _ in 0..ROUNDS {
            let value = |cell: &Cell| field.at([field.chart.u(cell.x), field.chart.v(cell.z)]);
            let is_new = |cell: &Cell| {
                let same = |other: &Cell| (other.x - cell.x).abs() < 1e-9 && (other.z - cell.z).abs() < 1e-9;
                !readings.cells.iter().any(same)
            };
            let open = seen.bounds.iter().filter(|bound| value(bound) < 0.5 * bound.y).copied();
            let unclosed = closings(seen).filter(|cell| value(cell) > chosen.field.sigma && is_new(cell)).collect();
            let closed = within_errors(unclosed, &net, &chosen, &readings)?;
            let added: Vec<Cell> = open.filter(is_new).chain(closed).collect();
            if added.is_empty() {
                break;
            }
            readings.cells.extend(added);
            let rough = chosen.roughness(&net).map_err(|_| FieldError::Undetermined)?;
            let observed = Observed::new(&net, &chosen.chart, &readings);
            chosen.field = smoothed(&observed, &rough, weight, least).map_err(|_| FieldError::Undetermined)?;
            field = Field::new(chosen.chart, &net, &chosen.field.values)?;
        }
        let most = (MISSED[0] * chosen.field.sigma).max(MISSED[1] * greatest);
        let below = (ALLOWED[0] * chosen.field.sigma).max(ALLOWED[1] * 2.0 * greatest);
        let bent = bent(&net, &field, seen, [most, below])?;
        let line_errors = readings.common.as_ref().map(|lines| lines.found(&chosen.field.common, gain));
        let of_line = |cell: &Cell| {
            let found = line_errors.as_ref().filter(|_| cell.y > 0.0);
            found.map_or(0.0, |found| found.at(place(cell)))
        };
        let residual = |cell: &Cell| {
            (field.at([field.chart.u(cell.x), field.chart.v(cell.z)]) + of_line(cell) - cell.y) / cell.scale
        };
        let inexact: Vec<Cell> = readings.cells[..offsets].iter().filter(|cell| cell.scale > EXACT).copied().collect();
        let residuals: Vec<f64> = inexact.iter().map(residual).collect();
        // Points of sections follow each other up them.
        let order = |[x, z]: [f64; 2]| if seen.has_points { [z, x] } else { [x, z] };
        let correlation = correlation(inexact.iter().map(place).map(order).zip(residuals.iter().copied()));
        let rocker = seen.rocker.clone();
        Ok(Self { field, bent, net, chosen, power, inexact, residuals, correlation, lines, line_errors, rocker })
    }

    /// sqrt(1 + y_x^2 + y_z^2) at a place (x, z) of the hull ([`steepness`]).
    #[must_use]
    pub fn steepness(&self, [x, z]: [f64; 2]) -> f64 {
        let height = self.rocker.as_ref().map_or(z, |rocker| rocker.relative(x, z).unwrap_or(rocker.height[0]));
        steepness(slopes(&self.field, self.rocker.as_ref(), [x, height]))
    }

    /// The control points of its hull \[m\].
    ///
    /// # Errors
    /// [`SplineError`] when the knots do not determine them.
    pub fn control_points(&self) -> Result<Vec<[f64; 3]>, SplineError> {
        let bent = &self.bent;
        let mut places = bent.places()?;
        if let Some(rocker) = &self.rocker {
            let chart = &bent.chart;
            let heights = bent.interpolated(|w, v| rocker.absolute(chart.x(bent.bend.u(w, v)), chart.z(v)))?;
            let columns = bent.shape()[1];
            // A stem that leans aft above a keel which rises to it may turn the net over: there it goes straight up.
            for (k, z) in heights.into_iter().enumerate() {
                places[k][1] = if k % columns > 0 { z.max(places[k - 1][1]) } else { z };
            }
        }
        let values = bent.half_breadths(&self.field)?;
        Ok(places.into_iter().zip(values).map(|([x, z], y)| [x, y, z]).collect())
    }
}

/// The correlation of what places (x, z) have which follow each other along x, times the root of their number.
fn correlation(found: impl Iterator<Item = ([f64; 2], f64)>) -> f64 {
    let mut sorted: Vec<([f64; 2], f64)> = found.collect();
    sorted.sort_by(|([x, z], _), ([other, height], _)| {
        (z / SAME).round().total_cmp(&(height / SAME).round()).then(x.total_cmp(other))
    });
    let pairs = sorted.windows(2).filter(|pair| (pair[0].0[1] - pair[1].0[1]).abs() <= SAME);
    let (mut count, mut products, mut squares) = (0.0f64, 0.0, 0.0);
    for pair in pairs {
        count += 1.0;
        products += pair[0].1 * pair[1].1;
        squares += 0.5 * (pair[0].1.powi(2) + pair[1].1.powi(2));
    }
    if squares > 0.0 { products / squares * count.sqrt() } else { 0.0 }
}

/// y_x and y_z of a field at (x, zeta) of a keel line.
fn slopes(field: &Field, rocker: Option<&Rocker>, [x, zeta]: [f64; 2]) -> [f64; 2] {
    let [along, up] = field.slopes(x, zeta);
    let Some(rocker) = rocker else { return [along, up] };
    let [by_x, by_z] = rocker.slopes(x, rocker.absolute(x, zeta));
    [along + up * by_x, up * by_z]
}

/// A first smooth field, for the slopes of the hull, and the weight of its energy.
fn smooth_first(energies: &mut Energies<'_>, readings: &Readings, chart: Chart, least: f64) -> Option<(f64, Smoothed)> {
    let observed = Observed::new(energies.net, &chart, readings);
    let rough = energies.of(FIRST_METRIC).ok()?;
    let weights = (-6..=0).map(|e| 10f64.powi(e));
    let tried = weights.filter_map(|weight| Some((weight, smoothed(&observed, rough, weight, least).ok()?)));
    tried.min_by(|a, b| a.1.cost.total_cmp(&b.1.cost))
}

/// Decides which zeros beside the hull belong to it: keels, and ends that neighbouring waterlines share. Such an end is a
/// perpendicular or beyond the hull. A first field without the zeros has the value m there, with standard deviation s. The
/// half-breadth beside the zero is y. The ratio of Savage and Dickey (1971) decides.
///
/// ```text
/// r = max(y, s) exp(-m^2 / 2 s^2) / (s sqrt(2 pi))
/// ```
///
/// It is the likelihood of a value of zero over that of any value down to -max(y, s). Below [`NO_ZERO`] the zero is left out.
/// Where the field still has breadth at a shared end it stays. Any other end closes before its zero, and the zero is left out,
/// unless the field has breadth there by [`BREADTH`] standard deviations.
fn settle(seen: &mut Observations, energies: &mut Energies<'_>, chart: Chart, least: f64) {
    let zeros = seen.zeros();
    if zeros.is_empty() {
        return seen.settle(&zeros);
    }
    let net = energies.net;
    let rows: Vec<_> = zeros.iter().map(|zero| net.row([chart.u(zero.cell.x), chart.v(zero.cell.z)])).collect();
    let mut first = || {
        let readings = seen.of_field();
        let (weight, first) = smooth_first(energies, &readings, chart, least)?;
        let observed = Observed::new(net, &chart, &readings);
        let errors = observed.errors(energies.of(FIRST_METRIC).ok()?, weight, &first, &rows).ok()?;
        Some((first, errors))
    };
    let Some((first, errors)) = first() else { return seen.settle(&zeros) };
    let value = |row: &[(usize, f64)]| row.iter().map(|(j, b)| b * first.values[*j]).sum::<f64>();
    let agrees = |zero: &Zero, value: f64, error: f64| {
        let error = error.hypot(first.sigma);
        let apart = match zero.kind {
            ZeroKind::Keel => value,
            ZeroKind::SharedEnd => value.min(0.0),
            ZeroKind::End => return value > BREADTH * error,
        } / error;
        let ratio = (zero.beside / error).max(1.0) * (-0.5 * apart * apart).exp() / (2.0 * PI).sqrt();
        ratio >= NO_ZERO
    };
    let found = zeros.iter().zip(rows.iter().zip(&errors));
    let agreeing = found.filter(|(zero, (row, error))| agrees(zero, value(row), **error)).map(|(zero, _)| *zero);
    seen.settle(&agreeing.collect::<Vec<_>>());
}

/// Where waterlines have closed: at the station beyond their last offset.
fn closings(seen: &Observations) -> impl Iterator<Item = Cell> + '_ {
    let closing = |z: f64, end: End| match end {
        End::Between(_, x) => Some(Cell { x, z, y: 0.0, scale: 1.0 }),
        _ => None,
    };
    let ends = seen.waterlines.iter().flat_map(|line| line.heights.into_iter().zip(line.ends));
    ends.filter_map(move |(z, end)| closing(z, end))
}

/// Of places at which a field has breadth those where this may be an error of the field ([`BREADTH`]).
fn within_errors(places: Vec<Cell>, net: &Net, chosen: &Chosen, readings: &Readings) -> Result<Vec<Cell>, FieldError> {
    if places.is_empty() {
        return Ok(places);
    }
    let (chart, field) = (&chosen.chart, &chosen.field);
    let rows: Vec<_> = places.iter().map(|cell| net.row([chart.u(cell.x), chart.v(cell.z)])).collect();
    let value = |row: &[(usize, f64)]| row.iter().map(|(j, b)| b * field.values[*j]).sum::<f64>();
    let rough = chosen.roughness(net).map_err(|_| FieldError::Undetermined)?;
    let observed = Observed::new(net, chart, readings);
    let weight = 10f64.powf(chosen.exponent);
    let errors = observed.errors(&rough, weight, field, &rows).map_err(|_| FieldError::Undetermined)?;
    let is_error = |(row, error): (&Vec<(usize, f64)>, f64)| value(row) <= BREADTH * error.hypot(field.sigma);
    let kept: Vec<bool> = rows.iter().zip(errors).map(is_error).collect();
    Ok(places.into_iter().zip(kept).filter(|(_, kept)| *kept).map(|(cell, _)| cell).collect())
}

/// The ends of a hull at any height.
struct Ends<'a> {
    field: &'a Field,
    seen: &'a Observations,
    /// The least v at which a contour is looked for, aft and forward: on a keel the field vanishes all along.
    least: [f64; 2],
}

impl Ends<'_> {
    /// u of the end at v, and whether the hull is cut off there with breadth.
    fn at(&self, v: f64, side: usize) -> (f64, bool) {
        let v = v.max(self.least[side]);
        let (chart, lines) = (&self.field.chart, &self.seen.waterlines);
        let z = chart.z(v);
        let above = lines.partition_point(|line| line.heights[side] < z);
        let last = lines.len() - 1;
        let [below, above] = [&lines[above.saturating_sub(1).min(last)], &lines[above.min(last)]];
        let pick = |a: f64, b: f64, outer: bool| if (side == 0) == outer { a.min(b) } else { a.max(b) };
        // Below the lowest waterline a hull without a keel line may end anywhere inside of it.
        let is_below = self.seen.rocker.is_none() && z < lines[0].heights[side];
        let inner = pick(below.inner[side], above.inner[side], false);
        let from = if is_below { 0.5 * (lines[0].inner[0] + lines[0].inner[1]) } else { inner };
        let to = match [below.ends[side], above.ends[side]] {
            [End::Cut(a), End::Cut(b)] if above.heights[side] > below.heights[side] => {
                let [low, high] = [below, above].map(|line| line.heights[side]);
                a + (b - a) * ((z - low) / (high - low)).clamp(0.0, 1.0)
            }
            // Plumb.
            [End::Closed(a), End::Closed(b)] if (a - b).abs() <= 1e-9 * (1.0 + a.abs()) => return (chart.u(a), false),
            [a, b] => pick(a.outermost(), b.outermost(), true),
        };
        let cut = [below, above].iter().any(|line| matches!(line.ends[side], End::Cut(_)));
        let (from, to) = (chart.u(from), chart.u(to));
        match self.field.zero(v, from, to) {
            Some(u) => (u, false),
            None if cut => (to, true),
            // It has to close between two stations: where it comes nearest to it.
            None => (self.field.least(v, from, to), false),
        }
    }

    /// Heights v at which a contour meets an edge, from below.
    fn corners(&self, side: usize, steps: usize) -> Vec<f64> {
        let at = |k: usize| k as f64 / steps as f64;
        let cut = |v: f64| self.at(v, side).1;
        let mut corners = Vec::new();
        for k in 0..steps {
            let (mut low, mut high) = (at(k), at(k + 1));
            let below = cut(low);
            if cut(high) == below {
                continue;
            }
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                if cut(middle) == below { low = middle } else { high = middle }
            }
            corners.push(0.5 * (low + high));
        }
        corners
    }
}

/// The chart of the hull: its ends are those of the field, within what the table leaves open. Spans along v where its net
/// misses the field by more than `most` \[m\] are halved once. So are those where an end passes the centreplane by more than
/// `below` \[m\], up to [`HALVINGS`] times.
fn bent(net: &Net, field: &Field, seen: &Observations, [most, below]: [f64; 2]) -> Result<Bent, FieldError> {
    let mut breaks = net.knots[1].breakpoints();
    let spacing = 1.0 / (breaks.len() - 1) as f64;
    let least = [0, 1].map(|side| match seen.rocker {
        // Below its lowest waterline that ends there a hull on a keel line is plumb.
        Some(_) => field.chart.v(seen.waterlines[0].heights[side]).max(0.5 * spacing),
        None if seen.keel_closed => 0.5 * spacing,
        None => 0.0,
    });
    let ends = Ends { field, seen, least };
    let mut corners: Vec<f64> = (0..2).flat_map(|side| ends.corners(side, SAMPLES * (breaks.len() - 1))).collect();
    corners.retain(|v| (CLOSE * spacing..=1.0 - CLOSE * spacing).contains(v));
    corners.sort_by(f64::total_cmp);
    corners.dedup_by(|a, b| *a - *b < CLOSE * spacing);
    breaks.retain(|b| *b <= 0.0 || *b >= 1.0 || corners.iter().all(|c| (b - c).abs() >= CLOSE * spacing));
    breaks.extend(&corners);
    breaks.sort_by(f64::total_cmp);
    let broken: Vec<Break> = net.breaks.iter().filter(|line| breaks.contains(&line.at)).copied().collect();
    let multiplicity = |at: &f64| match broken.iter().find(|line| line.at.total_cmp(at).is_eq()) {
        _ if corners.contains(at) => DEGREE,
        Some(line) => line.multiplicity(),
        None => 1,
    };
    let on = |breaks: &[f64]| -> Result<(KnotVector, Bend), FieldError> {
        let multiplicities: Vec<usize> = breaks[1..breaks.len() - 1].iter().map(multiplicity).collect();
        let knots = KnotVector::from_breakpoints(DEGREE, breaks, &multiplicities)?;
        let bend = Bend::new([&net.knots[0], &knots], |v| [0, 1].map(|side| ends.at(v, side).0))?;
        Ok((knots, bend))
    };
    let (mut knots, mut bend) = on(&breaks)?;
    // Where an end runs past its contour, its spline has too few knots.
    for _ in 0..HALVINGS {
        let passes = |v: f64, side: usize| {
            let at = bend.ends[side].eval(v)[0].clamp(0.0, 1.0);
            field.at([at, v]) < -below && !ends.at(v, side).1
        };
        let halved = |span: &[f64]| {
            let at = |part: f64| span[0] + part * (span[1] - span[0]);
            (0..2).any(|side| [0.25, 0.5, 0.75].iter().any(|&part| passes(at(part), side))).then(|| at(0.5))
        };
        let halves: Vec<f64> = breaks.windows(2).filter_map(halved).collect();
        if halves.is_empty() {
            break;
        }
        breaks.extend(halves);
        breaks.sort_by(f64::total_cmp);
        (knots, bend) = on(&breaks)?;
    }
    let (chart, keel_closed) = (field.chart, seen.keel_closed);
    let knots = [net.knots[0].clone(), knots];
    let open = Bent { chart, knots, bend, corners, breaks: broken, closed: Default::default(), keel_closed };
    let halves = open.unresolved(field, most)?;
    let refined = open.refined(&halves)?;
    // At a corner the end is closed where it is so on one side of it.
    let is_closed = |v: f64, side: usize| [-BESIDE, BESIDE].iter().any(|d| !ends.at((v + d).clamp(0.0, 1.0), side).1);
    let closed = [0, 1].map(|side| refined.knots[1].greville().iter().map(|&v| is_closed(v, side)).collect());
    Ok(Bent { closed, ..refined })
}
