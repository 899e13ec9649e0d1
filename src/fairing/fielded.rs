//! A level table as a fair field of few numbers, ready to be constrained.
//!
//! The field ([`super::field`]) of greatest likelihood is interpolated on the net of its hull, whose edges are stern and
//! stem. Targets then move it by a change d of least energy. The field F makes the sum of squares and energy J
//! stationary, so that J(F + d) = J(F) + |S^-1 M d|^2 + w d'Pd. Without targets the answer is the field itself.

use super::constraint::{Constraint, Rule, breadths};
use super::error::FairError;
use super::fair::{FairSettings, Prepared};
use super::field::observed::{DOUBTFUL, Observations};
use super::field::points::Points;
use super::field::rocker::Rocker;
use super::field::surface::ChartedField;
use super::local_noise::{LEAST_FREEDOM, below_centreplane};
use super::model::{Limit, Model, Reading, Stationary, value};
use super::move_metric::move_metric;
use super::program::{Program, Wishes};
use super::robust::typical;
use super::smoothing::Smoother;
use super::surface::{FairSurface, Origin, Place, basis_row, readings};
use crate::hull::{Functional, Hull, HullError, OffsetTable, StationOffsets, has_rocker, only_outlines};
use crate::qp::Settings;
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector};

/// A half-breadth of the bottom above this part of B is none of a keel.
const KEEL: f64 = 1e-2;

/// Correlation of the residuals along a waterline, over its standard deviation, from which a field does not follow a table.
const CORRELATED: f64 = 3.0;

/// Half-breadths of control values over the greatest offset from which a field swings between the offsets.
const BEYOND: f64 = 1.5;

/// Part of the volume by which a field may differ from the surface through the table: more is open between its waterlines.
const VOLUME: f64 = 0.02;

/// The largest residual over the typical one, and over the breadth, beyond both of which a field does not follow its table.
const FARTHEST: [f64; 2] = [10.0, 3e-3];

/// Standardised residuals of offsets that contradict a field, over the typical one, and over the greatest.
const CONTRADICTS: f64 = 5.0;
const ALIKE: f64 = 2.0 / 3.0;

/// A locked offset that is further off does not stay \[m\].
const KEPT: f64 = 1e-9;

/// Least error of a height of the keel, over the depth.
const LEAST_KEEL: f64 = 1e-6;

/// Powers of ten to each side of the weight of a field that are drawn.
const TRIALS: i32 = 3;

/// What the likelihood says of a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Likely {
    /// Standard deviation of the errors of an offset of weight 1 \[m\].
    pub(super) sigma: f64,
    /// Weight of the energy against sums of squares.
    pub(super) weight: f64,
}

/// The field of a level table, before it is known whether it follows the table.
pub(super) struct TableField<'a> {
    table: &'a OffsetTable,
    /// The surface through the table.
    fitted: &'a Hull,
    rules: &'a [Rule],
    /// The table with what the rules fix as locked.
    marked: OffsetTable,
    /// Points of sections, where the table has these.
    points: Option<Points>,
    field: ChartedField,
    /// Below it the table says nothing of the volume: the lowest waterline with breadth \[m\]; none where all is said.
    lowest: Option<f64>,
    /// The greatest half-breadth of the table \[m\].
    greatest: f64,
    /// What residuals say nothing of the fit below: the noise of the table, or its last digit \[m\].
    least: f64,
}

impl<'a> TableField<'a> {
    /// The field of greatest likelihood of a table of this noise \[m\] over the chart of its hull; none where the offsets
    /// determine none. It passes through offsets that are locked, and those of lines that do not move by the `rules`.
    /// Breadth, depth and deck are those of `fitted`.
    pub(super) fn new(table: &'a OffsetTable, fitted: &'a Hull, (noise, rules): (f64, &'a [Rule])) -> Option<Self> {
        let breaks = |station: &StationOffsets| {
            let points = station.outlines.iter().flatten().map(|point| point.marks);
            station.half_breadths.iter().map(|cell| cell.marks).chain(points).any(|marks| marks.knuckle)
        };
        // A field closes at a keel, and not at the top.
        if table.stations.iter().any(breaks) || table.closes_above().is_some() {
            return None;
        }
        let points = match table.point_count() {
            0 => None,
            _ if !only_outlines(table) => return None,
            _ => Some(Points::new(table, extent(fitted.surface(), 0))?),
        };
        let marked = with_fixed_lines(table, rules);
        let levels = points.as_ref().map_or(&marked, |points| &points.levels);
        let is_level = if points.is_some() { !has_rocker(levels) } else { fitted.is_level() };
        let mut seen = Observations::new(levels);
        if let Some(points) = &points {
            seen.read_points(&points.cells);
        }
        if !is_level {
            let least = noise.max(LEAST_KEEL * fitted.particulars().depth);
            let rocker = Rocker::new(levels, least, seen.extent[0])?;
            seen = seen.over_keel(levels, rocker)?;
        }
        let shape = [levels.stations.len(), levels.waterlines.len()];
        if shape.iter().any(|&n| n < 4) || seen.waterlines.len() < 2 || seen.readings.len() < 16 {
            return None;
        }
        let quantum = table.form.quantum().unwrap_or(0.0);
        let field = ChartedField::new(&seen, shape, quantum).ok()?;
        let least = quantum.max(noise);
        let greatest = seen.readings.iter().fold(0.0f64, |most, cell| most.max(cell.y));
        // With a keel, or points of sections, it is all said.
        let all = !is_level || points.is_some() || table.stations.iter().any(|station| station.keel_height.is_some());
        let lowest = (!all).then(|| seen.waterlines[0].heights[0]);
        Some(Self { table, fitted, rules, marked, points, field, lowest, greatest, least })
    }

    /// What a residual is too large beyond \[m\] ([`FARTHEST`]).
    fn farthest(&self) -> f64 {
        let typical = typical(self.field.residuals.iter().copied());
        (FARTHEST[0] * typical).max(FARTHEST[1] * self.fitted.particulars().breadth).max(self.least)
    }

    /// Whether residuals are above the least and go together ([`CORRELATED`]).
    fn has_pattern(&self) -> bool {
        let residuals = &self.field.residuals;
        let squares: f64 = residuals.iter().map(|residual| residual * residual).sum();
        self.field.correlation > CORRELATED && (squares / residuals.len().max(1) as f64).sqrt() > self.least
    }

    /// Whether the field follows its table: no pattern in the residuals, and none of them is too large.
    fn follows(&self) -> bool {
        let farthest = self.farthest();
        !self.has_pattern() && self.field.residuals.iter().all(|residual| residual.abs() <= farthest)
    }

    /// Whether control values swing between the offsets ([`BEYOND`]).
    fn swings(&self, net: &[f64]) -> bool {
        net.iter().any(|y| y.abs() > BEYOND * self.greatest)
    }

    /// Offsets that contradict the field, with its half-breadths there without them: standardised residuals r / sqrt(1 - h) of
    /// [`CONTRADICTS`] typical ones, no less than [`ALIKE`] of the greatest. What is less may be pulled by these.
    pub(super) fn contradictions(&self) -> Vec<((usize, usize), f64)> {
        let Some((surface, likely)) = self.modelled() else { return Vec::new() };
        let smoother = Smoother::new(&surface.model);
        let Ok(smoothed) = smoother.at(likely.weight / smoother.unit) else { return Vec::new() };
        let free = |k: usize| (1.0 - smoothed.leverages[k]).max(LEAST_FREEDOM);
        let readings = surface.model.readings.iter().enumerate();
        let sizes: Vec<f64> =
            readings.map(|(k, r)| (r.weight / free(k)).sqrt() * smoothed.residuals[k].abs()).collect();
        let greatest = sizes.iter().copied().fold(0.0, f64::max);
        let typical = typical(sizes.iter().copied().filter(|size| *size > 0.0));
        let least = (CONTRADICTS * typical).max(ALIKE * greatest).max(self.least);
        let cell = |(k, size): (usize, &f64)| match surface.places[k] {
            Place { origin: Origin::HalfBreadth { station, waterline }, locked: false, .. } if *size >= least => {
                Some(((station, waterline), surface.model.readings[k].value + smoothed.residuals[k] / free(k)))
            }
            _ => None,
        };
        sizes.iter().enumerate().filter_map(cell).collect()
    }

    /// The field as a surface to be faired, with its likelihood; none where it does not follow the table, or no longer does
    /// once it keeps to its side of the centreplane.
    pub(super) fn surface(&self) -> Option<(FairSurface, Likely)> {
        if !self.follows() {
            return None;
        }
        let (surface, likely) = self.modelled()?;
        // A locked offset that is not on the hull would not be kept.
        let is_lost = |origin: &Origin| !surface.places.iter().any(|place| place.origin == *origin);
        if locked(&self.marked).iter().any(is_lost) {
            return None;
        }
        let surface = surface.within_limits(likely, self.rules)?;
        if surface.farthest_off() > self.farthest() || self.swings(&surface.start) {
            return None;
        }
        let top = surface.hull.reference_height();
        let above = |hull: &Hull| {
            let below = self.lowest.filter(|z| *z < top).map_or(0.0, |z| Functional::Volume.value(hull, z));
            Functional::Volume.value(hull, top) - below
        };
        let (own, given) = match &self.points {
            Some(points) => (above(&surface.hull), points.volume(top)),
            None => (above(&surface.hull), above(self.fitted)),
        };
        ((own - given).abs() <= VOLUME * given.abs()).then_some((surface, likely))
    }

    /// The field as a surface, with its likelihood; none where it makes no hull.
    fn modelled(&self) -> Option<(FairSurface, Likely)> {
        let Self { table, fitted, points, field, .. } = self;
        let breadth = fitted.particulars().breadth;
        let hull = hull_of(field, fitted).ok()?;
        let start: Vec<f64> = hull.surface().points().iter().map(|p| p[1]).collect();
        if self.swings(&start) {
            return None;
        }
        let known: Vec<Option<f64>> = (0..start.len()).map(|k| field.bent.is_closed(k).then_some(0.0)).collect();
        let (readings, places) = match &points {
            Some(points) => side_readings(table, &points.sides, &hull),
            None => readings(table, &hull),
        };
        // Zeros on the lowest waterline of a flat bottom are its keel, not its edge.
        let base = hull.bottom() + 1e-9 * (hull.top() - hull.bottom());
        let between = |place: &Place| {
            let Origin::HalfBreadth { station, waterline } = place.origin else { return false };
            let wide = |k: usize| table.stations[k].half_breadth(waterline).is_some_and(|y| y > 0.0);
            (0..station).any(wide) && (station + 1..table.stations.len()).any(wide)
        };
        let is_offset = |(reading, place): &(Reading, Place)| {
            let far = value(&reading.row, &start) > KEEL * breadth;
            !far || reading.value > 0.0 || place.z > base || place.locked || !between(place)
        };
        let (mut readings, places): (Vec<Reading>, Vec<Place>) =
            readings.into_iter().zip(places).filter(is_offset).unzip();
        weigh(&mut readings, &places, field, &known);
        if let Some(found) = &field.line_errors {
            // Zeros and locked offsets are where they are.
            let shares = |(reading, place): &(&mut Reading, &Place)| reading.value > 0.0 && !place.locked;
            let shared = readings.iter_mut().zip(&places).filter(shares);
            shared.for_each(|(reading, place)| reading.shared = found.at([place.x, place.z]));
        }
        let energy = field.bent.energy(&field.net, field.chosen.metric, field.chosen.density.as_ref());
        let likely = Likely { sigma: field.chosen.field.sigma, weight: 10f64.powf(field.chosen.exponent) };
        let scale = |x: f64, z: f64| field.steepness([x, z]).powf(field.power);
        // A move bends no sharper across a corner of the chart than the field may.
        let mut moves = field.bent.jumps(&field.net);
        moves.add_band(1.0, &move_metric(hull.surface(), readings.len(), scale));
        let own =
            field.net.energy(field.chosen.metric, field.chosen.density.as_ref()).quadratic(&field.chosen.field.values);
        let stationary = Some(Stationary { weight: likely.weight, net: start.clone(), energy: own, moves });
        let model = Model { energy, readings, known, straight: None, start: None, carried: None, stationary };
        let mut found = FairSurface::over(hull, model, places, start);
        found.breaks = field.lines.clone();
        found.line_errors = field.line_errors.clone();
        found.keel = field.rocker.as_ref().map(|rocker| rocker.off);
        Some((found, likely))
    }
}

impl FairSurface {
    /// The largest residual of an offset that counts, without what its line is off by, over the scale of its errors \[m\].
    fn farthest_off(&self) -> f64 {
        let off = |reading: &Reading| {
            let residual = value(&reading.row, &self.start) + reading.shared - reading.value;
            residual.abs() * reading.weight.sqrt()
        };
        self.model.readings.iter().map(off).fold(0.0, f64::max)
    }

    /// The field of least objective that has the offsets which do not move, and passes the centreplane by no more than its
    /// errors; none where that was not found.
    fn within_limits(mut self, likely: Likely, rules: &[Rule]) -> Option<Self> {
        let margin = below_centreplane(likely.sigma, &self.hull);
        let mut limits = breadths(&self.hull, &self.start, f64::INFINITY, margin);
        limits.iter_mut().for_each(|limit| limit.lower = -margin);
        let stays = |place: &Place| {
            let deck = matches!(place.origin, Origin::Deck { .. });
            place.locked || rules.iter().any(|rule| rule.fixes([place.x, place.z], deck))
        };
        let readings = || self.model.readings.iter().zip(&self.places).filter(|(_, place)| stays(place));
        // What is on an end of the hull does not get there.
        let fails = |(reading, _): (&Reading, &Place)| {
            reading.weight <= 0.0 && (value(&reading.row, &self.start) - reading.value).abs() > KEPT
        };
        if readings().any(fails) {
            return None;
        }
        let exact: Vec<(usize, Limit)> = readings()
            .filter(|(reading, _)| reading.weight > 0.0)
            .map(|(reading, _)| (0, Limit { row: reading.row.clone(), lower: reading.value, upper: reading.value }))
            .collect();
        if exact.is_empty() && limits.iter().all(|limit| value(&limit.row, &self.start) >= limit.lower) {
            return Some(self);
        }
        let smoother = Smoother::new(&self.model);
        let lambda = likely.weight / smoother.unit;
        let wishes = Wishes { breadths: limits, rules: exact, widening: 1.0, ..Wishes::default() };
        let program = Program::new(&self.model, &smoother, lambda, &wishes, None);
        let solved = program.solve(&smoother, lambda, &Settings::default()).ok()?;
        if !solved.is_optimal() {
            return None;
        }
        self.hull = self.hull_of(&solved.net).ok()?;
        let energy = self.model.energy_of(&solved.net);
        if let Some(stationary) = &mut self.model.stationary {
            stationary.net.clone_from(&solved.net);
            stationary.energy = energy;
        }
        self.start = solved.net;
        Some(self)
    }
}

/// The table with the offsets of lines that do not move locked.
fn with_fixed_lines(table: &OffsetTable, rules: &[Rule]) -> OffsetTable {
    let mut marked = table.clone();
    for station in &mut marked.stations {
        for (cell, &z) in station.half_breadths.iter_mut().zip(&table.waterlines) {
            cell.marks.locked |= rules.iter().any(|rule| rule.fixes([station.station.x, z], false));
        }
    }
    marked
}

/// Offsets and points with breadth that are locked.
fn locked(table: &OffsetTable) -> Vec<Origin> {
    let mut found = Vec::new();
    for (station, column) in table.stations.iter().enumerate() {
        for (waterline, cell) in column.half_breadths.iter().enumerate() {
            if cell.marks.locked && cell.value().is_some_and(|y| y > KEPT) {
                found.push(Origin::HalfBreadth { station, waterline });
            }
        }
        for (outline, branch) in column.outlines.iter().enumerate() {
            let points = branch.iter().enumerate().filter(|(_, point)| point.marks.locked && point.y > KEPT);
            found.extend(points.map(|(point, _)| Origin::Point { station, outline, point }));
        }
    }
    found
}

/// The hull of a field.
fn hull_of(field: &ChartedField, fitted: &Hull) -> Result<Hull, HullError> {
    let bent = &field.bent;
    let surface = BsplineSurface::new(bent.knots[0].clone(), bent.knots[1].clone(), field.control_points()?)?;
    let deck = deck(fitted.deck(), extent(&surface, 0), extent(&surface, 2))?;
    Hull::new(fitted.name(), *fitted.particulars(), surface, deck)
}

/// Least and greatest control value of a surface along an axis \[m\].
fn extent(surface: &BsplineSurface<3>, axis: usize) -> [f64; 2] {
    let values = surface.points().iter().map(|p| p[axis]);
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)])
}

/// The deck at side over another length, within other heights.
fn deck(deck: &BsplineCurve<2>, [aft, fore]: [f64; 2], [low, high]: [f64; 2]) -> Result<BsplineCurve<2>, HullError> {
    let slack = 1e-6 * (fore - aft);
    let inside = deck.points().iter().filter(|p| p[0] > aft + slack && p[0] < fore - slack).copied();
    let (first, last) = (deck.points()[0][1], deck.points()[deck.points().len() - 1][1]);
    let points: Vec<[f64; 2]> = std::iter::once([aft, first])
        .chain(inside)
        .chain([[fore, last]])
        .map(|[x, z]| [x, z.clamp(low + 1e-6 * (high - low), high)])
        .collect();
    let breaks: Vec<f64> = points.iter().map(|p| p[0]).collect();
    let knots = KnotVector::from_breakpoints(1, &breaks, &vec![1; breaks.len() - 2])?;
    Ok(BsplineCurve::new(knots, points)?)
}

/// The points of the sides of sections as readings of a hull, at their heights.
fn side_readings(table: &OffsetTable, sides: &[[usize; 3]], hull: &Hull) -> (Vec<Reading>, Vec<Place>) {
    let found = sides.iter().filter_map(|&[station, outline, point]| {
        let (column, p) = (&table.stations[station], table.stations[station].outlines[outline][point]);
        let x = column.station.x;
        let at = hull.parameters(x, p.z)?;
        let weight = if p.marks.doubtful { DOUBTFUL.powi(-2) } else { 1.0 };
        let row = basis_row(hull.surface(), at, [0, 0]);
        let origin = Origin::Point { station, outline, point };
        let place = Place { origin, x, z: p.z, at, locked: p.marks.locked };
        Some((Reading { row, value: p.y, weight, tolerance: None, shared: 0.0 }, place))
    });
    found.unzip()
}

/// Weights of the readings: one over the square of the factor of their errors.
fn weigh(readings: &mut [Reading], places: &[Place], field: &ChartedField, known: &[Option<f64>]) {
    for (reading, place) in readings.iter_mut().zip(places) {
        let scale = field.steepness([place.x, place.z]).powf(field.power);
        reading.weight /= scale * scale;
        let free = reading.row.iter().filter(|(i, _)| known[*i].is_none()).map(|(_, value)| value.abs()).sum::<f64>();
        if free < 1e-9 {
            reading.weight = 0.0;
        }
    }
}

impl Prepared {
    /// Weight and noise of a field by its likelihood.
    ///
    /// # Errors
    /// [`FairError`] when the readings leave a control value open.
    pub(super) fn likely(
        surface: &mut FairSurface,
        settings: &FairSettings,
        likely: Likely,
    ) -> Result<Self, FairError> {
        let smoother = Smoother::new(&surface.model);
        let lambda = settings.weight.unwrap_or(likely.weight / smoother.unit);
        let trials = (-TRIALS..=TRIALS).filter_map(|power| smoother.trial(lambda * 10f64.powi(power))).collect();
        Self::searched(surface, settings, smoother, (lambda, trials), likely.sigma)
    }

    /// Two standard errors of linear quantities of a field, each in its unit: 2 sigma sqrt(l'N^-1 l) for the row l of a
    /// quantity and N = A'WA + w E of the likelihood. That of a centre is less by the part by which the size may differ.
    pub(super) fn twice_the_errors(&self, surface: &FairSurface, quantities: &[Constraint]) -> Vec<f64> {
        let factor = &self.likely.as_ref().unwrap_or(&self.smoothed).factor;
        let hull = &surface.hull;
        let error = |quantity: &Constraint| {
            let mut row = vec![0.0; self.smoother.reduced.free.len()];
            for (i, value) in self.smoother.reduced.row(&quantity.limit(hull).row).0 {
                row[i] += value;
            }
            let mut solved = row.clone();
            factor.solve(&mut solved);
            let square: f64 = row.iter().zip(&solved).map(|(l, x)| l * x).sum();
            2.0 * self.sigma * square.max(0.0).sqrt()
        };
        let volume = error(&Constraint::Displacement(Constraint::Displacement(0.0).value(hull)));
        let narrower = |quantity: &Constraint| match quantity {
            Constraint::CentreOfBuoyancy(_) | Constraint::CentreOfVolume { .. } => (1.0 - volume).max(0.0),
            _ => 1.0,
        };
        quantities.iter().map(|quantity| error(quantity) * quantity.scale(hull) * narrower(quantity)).collect()
    }
}
