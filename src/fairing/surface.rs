//! The hull as a model to be faired: which net, which readings, which energy.
//!
//! The chart x(u, v), z(u, v) of the start hull stays; the half-breadths y of its net are the unknowns. A hull with
//! plumb ends over a rectangle gets a quintic net of its own, about one control value for 1.25 offsets along the ship,
//! with lines of the net where straight parts begin ([`super::breaks`]); all others keep the cubic net of their fit, in
//! which profiles, knuckles and flats are lines of the net already, and an energy that spares what bends sharply
//! (`adapt`).
//!
//! On a net of its own the energy of order n = 4 is that over the unit square of the parameters,
//!
//! ```text
//! E = sum_a C(n, a) w_u^(n-a) w_v^a int int (d^n y / du^(n-a) dv^a)^2 du dv,   w_u = 0.6, w_v = 1/w_u,
//! ```
//!
//! exact by Gram matrices, broken at knots where the surface is (knuckles, tangent lines): nothing is charged across
//! them. On the net of a fit it is that of true curvature with the metric of the fit ([`super::metric`], `adapt`).

use super::adapt::Spared;
use super::breaks::{Break, Course, Lines, STIFF};
use super::cells::Cells;
use super::field::breaks::FoundBreak;
use super::field::line_errors::FoundErrors;
use super::field::observed::DOUBTFUL;
use super::metric::{self, Metric};
use super::model::{Model, Reading, value};
use super::unbroken::{Breaks, Unbroken};
use crate::hull::{Entry, Hull, HullError, LineKind, OffsetTable};
use crate::numeric::SymmetricBand;
use crate::spline::{BsplineCurve, BsplineSurface, Gram, KnotVector, add_product};
pub use crate::spline::{basis_row, energy};

/// Half-breadths below this part of B are on the centreplane.
const CENTREPLANE: f64 = 1e-9;

/// Control values of stem and stern below this part of B are on the centreplane: a fit leaves up to 7e-6 at closed ends
/// of published tables, and ends that are open have 2e-3 and more.
const ENDS: f64 = 1e-5;

/// Control values along the ship for an offset, on the quintic net.
const DENSITY: [f64; 2] = [0.8, 0.9];

/// Declared lines nearer to each other than this part of the length or the height are no lines of one net; at the edges
/// they are the edges.
const BESIDE: f64 = 1e-3;

/// w_u, the weight of bending along the ship; w_v is its inverse.
pub(super) const ANISOTROPY: f64 = 0.6;

/// Order of the energy on a net of its own that has the degree for it.
const OWN_ORDER: usize = 4;

/// Where a reading comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// The cell of a station and a waterline.
    HalfBreadth {
        /// Index of the station.
        station: usize,
        /// Index of the waterline.
        waterline: usize,
    },
    /// The deck at side of a station.
    Deck {
        /// Index of the station.
        station: usize,
    },
    /// A point of a section that is given as outlines. Its height stays; only its half-breadth is read.
    Point {
        /// Index of the station.
        station: usize,
        /// Index of the outline.
        outline: usize,
        /// Index of the point.
        point: usize,
    },
}

impl Origin {
    /// Index of the station.
    #[must_use]
    pub fn station(self) -> usize {
        match self {
            Self::HalfBreadth { station, .. } | Self::Deck { station } | Self::Point { station, .. } => station,
        }
    }

    /// Index of the waterline, of a cell.
    #[must_use]
    pub fn waterline(self) -> Option<usize> {
        match self {
            Self::HalfBreadth { waterline, .. } => Some(waterline),
            Self::Deck { .. } | Self::Point { .. } => None,
        }
    }

    /// What it is of a station, in words: "waterline 2.000 m", "deck at side", "point 7 at 2.000 m"; points count from
    /// 0, as in files that number them.
    #[must_use]
    pub fn words(self, z: f64) -> String {
        match self {
            Self::HalfBreadth { .. } => format!("waterline {z:.3} m"),
            Self::Deck { .. } => "deck at side".to_owned(),
            Self::Point { point, .. } => format!("point {point} at {z:.3} m"),
        }
    }
}

/// A reading with its place on the ship.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Where it comes from.
    pub origin: Origin,
    /// Position forward of AP \[m\].
    pub x: f64,
    /// Height above the base line \[m\].
    pub z: f64,
    /// Parameters on the surface.
    pub at: [f64; 2],
    /// The table says that it must not move.
    pub locked: bool,
}

/// A hull with the model of its half-breadths.
#[derive(Debug, Clone)]
pub struct FairSurface {
    /// The start: its chart stays, its half-breadths are those of the fit.
    pub hull: Hull,
    /// Energy, readings, known values.
    pub model: Model,
    /// The place of each reading of the model.
    pub places: Vec<Place>,
    /// Half-breadths of the net at the start \[m\].
    pub start: Vec<f64>,
    /// Where the net of a fit might break and does not.
    unbroken: Option<Unbroken>,
    /// Order of the energy.
    pub order: usize,
    /// Whether the net is one of its own, not that of the fit.
    pub own: bool,
    /// Whether the fit that a net of its own replaces breaks along no lines but those declared.
    pub simple: bool,
    /// Breaks and straight parts along the ship and up, on a net of its own.
    pub courses: [Course; 2],
    /// Whether the chart is the rectangle itself: x linear in u and z linear in v.
    pub plain: bool,
    /// Whether the net is that of a fair field.
    pub is_field: bool,
    /// Waterlines across which a field breaks.
    pub breaks: Vec<FoundBreak>,
    /// What the lines of the table are off by in common, of a field.
    pub line_errors: Option<FoundErrors>,
    /// How far the keel line of a field with rocker is from its heights at most \[m\].
    pub keel: Option<f64>,
}

/// What straight parts ask of a net: [`STIFF`] times the square of the second derivative over them, in the size of one
/// reading.
fn straightness(surface: &BsplineSurface<3>, courses: &[Course; 2]) -> Option<SymmetricBand> {
    let knots = [surface.u(), surface.v()];
    let [rows, columns] = surface.shape();
    let width = knots[0].degree().min(rows - 1) * columns + knots[1].degree().min(columns - 1);
    let mut all = SymmetricBand::zeros(rows * columns, width);
    let plain = knots.map(|knots| Gram::new(knots, knots, [0, 0]));
    for k in 0..2 {
        for part in courses[k].stiffness(knots[k]).into_iter().flatten() {
            let grams = if k == 0 { [&part, &plain[1]] } else { [&plain[0], &part] };
            add_product(&mut all, grams, 1.0, knots);
        }
    }
    let trace = all.trace();
    (trace > 0.0).then(|| SymmetricBand::zeros(rows * columns, width).plus(STIFF / trace, &all))
}

/// Whether the chart is a rectangle: level, plumb ends, z and x linear in the parameters.
fn is_plain(hull: &Hull) -> bool {
    let surface = hull.surface();
    let linear = |knots: &KnotVector, values: &[f64]| {
        let sites = knots.greville();
        let ((a, b), (p, q)) = (knots.domain(), (values[0], values[values.len() - 1]));
        let slack = 1e-9 * (q - p).abs();
        sites.iter().zip(values).all(|(t, value)| (p + (q - p) * (t - a) / (b - a) - value).abs() <= slack)
    };
    let [rows, columns] = surface.shape();
    let z: Vec<f64> = (0..columns).map(|j| surface.point(0, j)[2]).collect();
    hull.is_level()
        && linear(surface.v(), &z)
        && (0..columns).all(|j| linear(surface.u(), &(0..rows).map(|i| surface.point(i, j)[0]).collect::<Vec<_>>()))
}

/// Whether a level hull has plumb ends and simple knots: it stands over a rectangle and has no lines along which it
/// breaks.
fn is_rectangular(hull: &Hull) -> bool {
    let surface = hull.surface();
    let [rows, columns] = surface.shape();
    let length = surface.point(rows - 1, 0)[0] - surface.point(0, 0)[0];
    let plumb =
        |i: usize| (0..columns).all(|j| (surface.point(i, j)[0] - surface.point(i, 0)[0]).abs() <= 1e-9 * length);
    hull.is_level() && plumb(0) && plumb(rows - 1)
}

/// Whether no knot of a fit is multiple beyond those of as many declared lines: it has no other features of its own.
fn is_simple(knots: &KnotVector, lines: usize) -> bool {
    let breaks = knots.breakpoints();
    breaks[1..breaks.len() - 1].iter().filter(|&&t| knots.multiplicity(t) > 1).count() <= lines
}

/// The offsets of a table over the rectangle of its fit, as lines that run forward (waterlines) and up (stations), with
/// the breaks that the table declares; none where the hull does not stand over a rectangle or a declared line is
/// neither level nor plumb.
struct OverRectangle {
    lines: [Lines; 2],
    given: [Vec<Break>; 2],
    /// The fit has no features but those.
    simple: bool,
}

impl OverRectangle {
    fn new(table: &OffsetTable, fitted: &Hull) -> Option<Self> {
        if !is_rectangular(fitted) {
            return None;
        }
        let [rows, columns] = fitted.surface().shape();
        let (aft, fore) = (fitted.surface().point(0, 0)[0], fitted.surface().point(rows - 1, columns - 1)[0]);
        let part = |value: f64, from: f64, to: f64| ((value - from) / (to - from)).clamp(0.0, 1.0);
        let along: Vec<f64> = table.stations.iter().map(|station| part(station.station.x, aft, fore)).collect();
        let up: Vec<f64> = table.waterlines.iter().map(|&z| part(z, fitted.bottom(), fitted.top())).collect();
        if [&along, &up].iter().any(|sites| sites.len() < 4 || sites.windows(2).any(|w| w[1] <= w[0])) {
            return None;
        }
        let value = |station: usize, waterline: usize| {
            table.stations[station].half_breadths[waterline].value().unwrap_or(f64::NAN)
        };
        let spans = |sites: &[f64], density: f64| {
            let count = ((sites.len() as f64 * density).ceil() as usize).clamp(6.min(sites.len()), sites.len());
            count - 5.min(count - 1)
        };
        let mut given = [Vec::new(), Vec::new()];
        for line in &table.lines {
            let smooth = match line.kind {
                LineKind::Knuckle => 0,
                LineKind::Tangent => 1,
            };
            let spread = |axis: usize| {
                let values = line.points.iter().map(|p| p[axis]);
                let (low, high) =
                    (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max));
                (high - low, 0.5 * (low + high))
            };
            let (long, high) = (spread(0), spread(2));
            if high.0 <= 1e-6 * (fitted.top() - fitted.bottom()) {
                given[1].push(Break { at: part(high.1, fitted.bottom(), fitted.top()), smooth });
            } else if long.0 <= 1e-6 * (fore - aft) {
                given[0].push(Break { at: part(long.1, aft, fore), smooth });
            } else {
                return None;
            }
        }
        for list in &mut given {
            list.retain(|b| (BESIDE..=1.0 - BESIDE).contains(&b.at));
            list.sort_by(|a, b| a.at.total_cmp(&b.at));
            if list.windows(2).any(|w| w[1].at - w[0].at < BESIDE) {
                return None;
            }
        }
        let net = [fitted.surface().u(), fitted.surface().v()];
        let simple = (0..2).all(|k| is_simple(net[k], given[k].len()));
        let forward = (0..up.len()).map(|w| (0..along.len()).map(|s| value(s, w)).collect()).collect();
        let upward = (0..along.len()).map(|s| (0..up.len()).map(|w| value(s, w)).collect()).collect();
        let lines = [
            Lines { spans: spans(&along, DENSITY[0]), sites: along, values: forward },
            Lines { spans: spans(&up, DENSITY[1]), sites: up, values: upward },
        ];
        Some(Self { lines, given, simple })
    }
}

/// A net of given knots over the rectangle of a hull, through the same deck; half-breadths 0.
fn rectangle(hull: &Hull, [u, v]: [KnotVector; 2]) -> Result<Hull, HullError> {
    let surface = hull.surface();
    let [rows, columns] = surface.shape();
    let (aft, fore) = (surface.point(0, 0)[0], surface.point(rows - 1, columns - 1)[0]);
    let mut points = Vec::with_capacity(u.basis_count() * v.basis_count());
    for s in u.greville() {
        for t in v.greville() {
            points.push([aft + (fore - aft) * s, 0.0, hull.bottom() + (hull.top() - hull.bottom()) * t]);
        }
    }
    Hull::new(hull.name(), *hull.particulars(), BsplineSurface::new(u, v, points)?, hull.deck().clone())
}

/// The same hull with other half-breadths.
///
/// # Errors
/// [`HullError`] when the half-breadths make no hull.
pub fn with_half_breadths(hull: &Hull, y: &[f64]) -> Result<Hull, HullError> {
    let surface = hull.surface();
    let points = surface.points().iter().zip(y).map(|(p, &y)| [p[0], y, p[2]]).collect();
    let surface = BsplineSurface::new(surface.u().clone(), surface.v().clone(), points)?;
    let deck = BsplineCurve::new(hull.deck().knots().clone(), hull.deck().points().to_vec())?;
    Hull::new(hull.name(), *hull.particulars(), surface, deck)
}

impl FairSurface {
    /// Multiplies the tolerances of all readings.
    pub(super) fn widen(&mut self, factor: f64) {
        self.model.readings.iter_mut().for_each(|reading| reading.tolerance = reading.tolerance.map(|t| t * factor));
    }

    /// From a fit of the table to a model of it; `own` asks for a quintic net of its own, where the hull stands over a
    /// rectangle. The curvature may jump at `breaks` though it does not in the fit.
    ///
    /// # Errors
    /// [`HullError`] when the net makes no hull.
    pub fn new(table: &OffsetTable, fitted: &Hull, own: Option<f64>, breaks: &Breaks) -> Result<Self, HullError> {
        let over = own.and_then(|noise| OverRectangle::new(table, fitted).map(|over| (over, noise)));
        let smooth = over.is_some();
        let mut courses = [Course::default(), Course::default()];
        let mut hull = if let Some((OverRectangle { lines, given, .. }, noise)) = &over {
            courses = [0, 1].map(|k| lines[k].course(&given[k], *noise));
            let knots = |k: usize| courses[k].knots(&lines[k].sites, lines[k].spans);
            rectangle(fitted, [knots(0)?, knots(1)?])?
        } else {
            fitted.clone()
        };
        if smooth {
            hull = with_half_breadths(&hull, &greville_values(fitted, &hull))?;
        }
        let start: Vec<f64> = hull.surface().points().iter().map(|p| p[1]).collect();
        let surface = hull.surface();
        let degree = surface.u().degree().max(surface.v().degree());
        let order = if smooth { OWN_ORDER.min(degree) } else { metric::ORDER };
        let (mut readings, places) = readings(table, &hull);
        let known = known(fitted, &hull, smooth);
        for reading in &mut readings {
            // A reading of known control values alone says nothing.
            let free =
                reading.row.iter().filter(|(i, _)| known[*i].is_none()).map(|(_, value)| value.abs()).sum::<f64>();
            if free < 1e-9 {
                reading.weight = 0.0;
            }
        }
        let (u, v) = (surface.u(), surface.v());
        let plain = is_plain(&hull);
        let mut straight = straightness(surface, &courses);
        let (unbroken, energy) = if smooth {
            (None, energy(u, v, order, ANISOTROPY))
        } else {
            let metric = if hull.is_level() { Metric::new } else { Metric::parametric }(surface);
            let cells = Cells::new(surface);
            let unbroken = Unbroken::new(&cells, &metric, breaks);
            let energy = Spared::new(&cells, &metric, &unbroken).energy(&cells, &metric);
            straight = unbroken.form(&cells, &metric);
            (Some(unbroken), energy)
        };
        Ok(Self {
            model: Model {
                energy,
                readings,
                known,
                straight,
                start: (!smooth).then(|| start.clone()),
                carried: None,
                stationary: None,
            },
            courses,
            places,
            start,
            unbroken,
            order,
            plain,
            own: smooth,
            is_field: false,
            breaks: Vec::new(),
            line_errors: None,
            keel: None,
            simple: over.is_none_or(|(over, _)| over.simple),
            hull,
        })
    }

    /// A field over the chart of its hull.
    pub(super) fn over(hull: Hull, model: Model, places: Vec<Place>, start: Vec<f64>) -> Self {
        Self {
            plain: is_plain(&hull),
            hull,
            model,
            places,
            start,
            unbroken: None,
            order: super::field::net::ORDER,
            own: false,
            simple: true,
            courses: [Course::default(), Course::default()],
            is_field: true,
            breaks: Vec::new(),
            line_errors: None,
            keel: None,
        }
    }

    /// Offsets of known control values alone that are further off than their tolerances, in words.
    pub(super) fn out_of_reach(&self, net: &[f64]) -> Vec<String> {
        let named = |(reading, place): (&Reading, &Place)| {
            let is_known = reading.row.iter().all(|&(k, b)| b.abs() < 1e-12 || self.model.known[k].is_some());
            let (off, tolerance) = ((value(&reading.row, net) - reading.value).abs(), reading.tolerance?);
            (is_known && off > tolerance * 1.001).then(|| {
                format!(
                    "the offset at x = {:.3} m, z = {:.3} m is on the end of the hull, which does not move for it: it is {:.0} mm off, \
                     for a tolerance of {:.0} mm",
                    place.x,
                    place.z,
                    1e3 * off,
                    1e3 * tolerance
                )
            })
        };
        self.model.readings.iter().zip(&self.places).filter_map(named).collect()
    }

    /// What a field does with the keel line, in words, across which waterlines its curvature breaks, and what lines are off by.
    pub(super) fn lines_of_field(&self) -> impl Iterator<Item = String> {
        let keel = self.keel.map(|off| {
            format!(
                "the keel line is the likeliest one through the heights of the keel: it leaves them by {:.1} mm at most",
                1e3 * off
            )
        });
        let breaks = self.breaks.iter().map(|line| {
            format!(
                "curvature breaks along the waterline at z = {:.2} m, as at the end of a bilge: the offsets show it (-2 ln of the likelihood \
                 falls by {:.0})",
                line.z, line.gain
            )
        });
        let line_errors = self.line_errors.iter().map(FoundErrors::words);
        keel.into_iter().chain(breaks).chain(line_errors)
    }

    /// Straight parts that were found and are kept straight, in words.
    #[must_use]
    pub fn straight_parts(&self) -> Vec<String> {
        let surface = self.hull.surface();
        let [rows, columns] = surface.shape();
        let (aft, fore) = (surface.point(0, 0)[0], surface.point(rows - 1, columns - 1)[0]);
        let spans = [(aft, fore, "waterlines", "x"), (self.hull.bottom(), self.hull.top(), "stations", "z")];
        let parts = self.courses.iter().zip(spans).flat_map(|(course, (from, to, lines, axis))| {
            course.straight.iter().map(move |part| {
                let [a, b] = part.map(|t| from + (to - from) * t);
                format!("all {lines} are straight from {axis} = {a:.2} to {b:.2} m within the noise and stay so")
            })
        });
        parts.collect()
    }

    /// The greatest jump of curvature of a hull on this net across lines of it where the surface through the table has
    /// none \[1/m\]; none where there are no such lines, on a net of its own as well.
    pub(super) fn greatest_jump(&self, hull: &Hull) -> Option<f64> {
        self.unbroken.as_ref()?.greatest(hull.surface())
    }

    /// The hull with other half-breadths of the net.
    ///
    /// # Errors
    /// [`HullError`] when they make no hull.
    pub fn hull_of(&self, y: &[f64]) -> Result<Hull, HullError> {
        with_half_breadths(&self.hull, y)
    }
}

/// Half-breadths of `fitted` at the Greville points of another net over the same rectangle: control values to second
/// order.
fn greville_values(fitted: &Hull, hull: &Hull) -> Vec<f64> {
    hull.surface().points().iter().map(|p| fitted.half_breadth(p[0], p[2]).unwrap_or(0.0)).collect()
}

/// Every given half-breadth, deck at side and point of a section that lies on the surface.
pub(super) fn readings(table: &OffsetTable, hull: &Hull) -> (Vec<Reading>, Vec<Place>) {
    let (mut readings, mut places) = (Vec::new(), Vec::new());
    let mut put = |origin: Origin, at: [f64; 2], [x, value, z]: [f64; 3], doubtful: bool, locked: bool| {
        let weight = if doubtful { DOUBTFUL.powi(-2) } else { 1.0 };
        readings.push(Reading {
            row: basis_row(hull.surface(), at, [0, 0]),
            value,
            weight,
            tolerance: None,
            shared: 0.0,
        });
        places.push(Place { origin, x, z, at, locked });
    };
    for (station, column) in table.stations.iter().enumerate() {
        if column.outlines.is_empty() {
            continue;
        }
        let x = column.station.x;
        let line = StationLine::new(hull, x);
        for (outline, points) in column.outlines.iter().enumerate() {
            for (point, p) in points.iter().enumerate() {
                if let Some(at) = line.nearest([p.y, p.z]) {
                    let origin = Origin::Point { station, outline, point };
                    put(origin, at, [x, p.y, p.z], p.marks.doubtful, p.marks.locked);
                }
            }
        }
    }
    let mut add = |origin: Origin, x: f64, z: f64, value: f64, doubtful: bool, locked: bool| {
        let Some(at) = hull.parameters(x, z) else { return };
        put(origin, at, [x, value, z], doubtful, locked);
    };
    for (station, column) in table.stations.iter().enumerate() {
        for (waterline, (cell, &z)) in column.half_breadths.iter().zip(&table.waterlines).enumerate() {
            if let Entry::Given(value) = cell.entry {
                let origin = Origin::HalfBreadth { station, waterline };
                add(origin, column.station.x, z, value, cell.marks.doubtful, cell.marks.locked);
            }
        }
        if let (Some(z), Some(y), true) = (column.deck_height, column.deck_half_breadth, column.outlines.is_empty()) {
            add(Origin::Deck { station }, column.station.x, z, y, false, false);
        }
    }
    (readings, places)
}

/// A station of the surface as points.
struct StationLine<'a> {
    hull: &'a Hull,
    x: f64,
    /// v and the point (y, z) there.
    line: Vec<(f64, [f64; 2])>,
}

impl<'a> StationLine<'a> {
    /// Points to a span of the knots.
    const POINTS: usize = 8;
    /// Farthest a point of a section may lie from the surface, in breadths: what the fit left out does.
    const FAR: f64 = 1e-3;

    fn new(hull: &'a Hull, x: f64) -> Self {
        let breaks = hull.surface().v().breakpoints();
        let inside = breaks.windows(2).flat_map(|w| {
            (0..Self::POINTS).map(|k| w[0] + (w[1] - w[0]) * k as f64 / Self::POINTS as f64).collect::<Vec<_>>()
        });
        let all = inside.chain(breaks.last().copied());
        let point = |v: f64| {
            let [_, y, z] = hull.surface().eval(hull.length_parameter(x, v)?, v);
            Some((v, [y, z]))
        };
        Self { hull, x, line: all.filter_map(point).collect() }
    }

    /// Parameters of the point of the station next to (y, z); none where it is far.
    fn nearest(&self, [y, z]: [f64; 2]) -> Option<[f64; 2]> {
        let square = |p: [f64; 2]| (p[0] - y).powi(2) + (p[1] - z).powi(2);
        let (mut v, from) = *self.line.iter().min_by(|a, b| square(a.1).total_cmp(&square(b.1)))?;
        let mut best = (square(from), self.hull.length_parameter(self.x, v)?, v);
        let (low, high) = self.hull.surface().v().domain();
        // Gauss and Newton's steps along the station.
        for _ in 0..30 {
            let u = self.hull.length_parameter(self.x, v)?;
            let at = self.hull.surface().tangents(u, v);
            let gap = square([at.point[1], at.point[2]]);
            if gap < best.0 {
                best = (gap, u, v);
            }
            let slide = if at.du[0].abs() > 0.0 { -at.dv[0] / at.du[0] } else { 0.0 };
            let [dy, dz] = [1, 2].map(|d| at.dv[d] + slide * at.du[d]);
            let size = dy * dy + dz * dz;
            let step = ((y - at.point[1]) * dy + (z - at.point[2]) * dz) / size;
            if !step.is_finite() || step.abs() <= 1e-14 * (high - low) {
                break;
            }
            v = (v + step).clamp(low, high);
        }
        let far = Self::FAR * self.hull.particulars().breadth;
        (best.0 <= far * far).then_some([best.1, best.2])
    }
}

/// Control values that do not move: on a net of the fit those at stem, stern and keel that lie on the centreplane, where
/// they lie; on a net of its own (`own`) stem, stern or keel where all of it lies on the centreplane in the fit.
fn known(fitted: &Hull, hull: &Hull, own: bool) -> Vec<Option<f64>> {
    let [rows, columns] = hull.surface().shape();
    let [fit_rows, fit_columns] = fitted.surface().shape();
    let breadth = hull.particulars().breadth;
    let closed = |i: usize, j: usize, part: f64| {
        let y = fitted.surface().point(i, j)[1];
        (y.abs() <= part * breadth).then_some(y)
    };
    // On a net of its own an edge is on the centreplane or it is not.
    let whole_row = |i: usize| (0..fit_columns).all(|j| closed(i, j, ENDS).is_some());
    let whole_column = |j: usize| (0..fit_rows).all(|i| closed(i, j, CENTREPLANE).is_some());
    let (aft, fore, keel) = (whole_row(0), whole_row(fit_rows - 1), whole_column(0));
    let value = |i: usize, j: usize| {
        let [at_aft, at_fore, at_keel] = [i == 0, i + 1 == rows, j == 0];
        if own {
            ((at_aft && aft) || (at_fore && fore) || (at_keel && keel)).then_some(0.0)
        } else if at_aft || at_fore {
            closed(i, j, ENDS)
        } else {
            closed(i, j, CENTREPLANE).filter(|_| at_keel)
        }
    };
    (0..rows * columns).map(|k| value(k / columns, k % columns)).collect()
}
