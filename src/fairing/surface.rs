//! The hull as a model to be faired: which net, which readings, which energy.
//!
//! The chart x(u, v), z(u, v) of the start hull stays; the half-breadths y of its net are the unknowns. Over a field the
//! net is that of its hull (`fielded`). Otherwise it is the cubic net of the surface through
//! the table, in which profiles, knuckles and flats are lines of the net already. Its energy is that of true curvature in the
//! metric of that surface ([`super::metric`]), and spares what bends sharply (`adapt`).

use super::adapt::Spared;
use super::cells::Cells;
use super::field::breaks::FoundBreak;
use super::field::line_errors::FoundErrors;
use super::field::observed::DOUBTFUL;
use super::metric::{self, Metric};
use super::model::{Model, Reading, value};
use super::unbroken::{Breaks, Unbroken};
use crate::hull::{Entry, Hull, HullError, OffsetTable};
use crate::spline::{BsplineCurve, BsplineSurface};
pub use crate::spline::{basis_row, energy};

/// Half-breadths below this part of B are on the centreplane.
const CENTREPLANE: f64 = 1e-9;

/// Control values of stem and stern below this part of B are on the centreplane: a fit leaves up to 7e-6 at closed ends
/// of published tables, and ends that are open have 2e-3 and more.
const ENDS: f64 = 1e-5;

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
    /// Whether the net is that of a fair field.
    pub is_field: bool,
    /// Waterlines across which a field breaks.
    pub breaks: Vec<FoundBreak>,
    /// What the lines of the table are off by in common, of a field.
    pub line_errors: Option<FoundErrors>,
    /// How far the keel line of a field with rocker is from its heights at most \[m\].
    pub keel: Option<f64>,
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

    /// From the surface through a table to a model of it, whose curvature may jump at `breaks` though it does not there.
    #[must_use]
    pub fn new(table: &OffsetTable, fitted: &Hull, breaks: &Breaks) -> Self {
        let hull = fitted.clone();
        let surface = hull.surface();
        let start: Vec<f64> = surface.points().iter().map(|p| p[1]).collect();
        let (mut readings, places) = readings(table, &hull);
        let known = known(&hull);
        for reading in &mut readings {
            // A reading of known control values alone says nothing.
            let free =
                reading.row.iter().filter(|(i, _)| known[*i].is_none()).map(|(_, value)| value.abs()).sum::<f64>();
            if free < 1e-9 {
                reading.weight = 0.0;
            }
        }
        let metric = if hull.is_level() { Metric::new } else { Metric::parametric }(surface);
        let cells = Cells::new(surface);
        let unbroken = Unbroken::new(&cells, &metric, breaks);
        let model = Model {
            energy: Spared::new(&cells, &metric, &unbroken).energy(&cells, &metric),
            readings,
            known,
            straight: unbroken.form(&cells, &metric),
            start: Some(start.clone()),
            carried: None,
            stationary: None,
        };
        let of_fit = Self::over(hull, model, places, start);
        Self { unbroken: Some(unbroken), order: metric::ORDER, is_field: false, ..of_fit }
    }

    /// A field over the chart of its hull.
    pub(super) fn over(hull: Hull, model: Model, places: Vec<Place>, start: Vec<f64>) -> Self {
        Self {
            hull,
            model,
            places,
            start,
            unbroken: None,
            order: super::field::net::ORDER,
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

    /// The greatest jump of curvature of a hull on this net across lines of it where the surface through the table has
    /// none \[1/m\]; none where there are no such lines.
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

/// Control values of the surface through a table that do not move: those at stem, stern and keel that lie on the
/// centreplane, where they lie.
fn known(hull: &Hull) -> Vec<Option<f64>> {
    let [rows, columns] = hull.surface().shape();
    let breadth = hull.particulars().breadth;
    let closed = |i: usize, j: usize, part: f64| {
        let y = hull.surface().point(i, j)[1];
        (y.abs() <= part * breadth).then_some(y)
    };
    let value = |i: usize, j: usize| {
        if i == 0 || i + 1 == rows { closed(i, j, ENDS) } else { closed(i, j, CENTREPLANE).filter(|_| j == 0) }
    };
    (0..rows * columns).map(|k| value(k / columns, k % columns)).collect()
}
