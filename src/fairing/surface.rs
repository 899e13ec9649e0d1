//! The hull as a model to be faired: which net, which readings, which energy.
//!
//! The chart x(u, v), z(u, v) of the start hull stays; the half-breadths y of its net are the unknowns. A hull with plumb ends
//! over a rectangle gets a quintic net of its own, about one control value for 1.25 offsets along the ship; all others keep the
//! cubic net of their fit, in which profiles, knuckles and flats are lines of the net already.
//!
//! Energy of order n over the unit square of the parameters,
//!
//! ```text
//! E = sum_a C(n, a) w_u^(n-a) w_v^a int int (d^n y / du^(n-a) dv^a)^2 du dv,   w_v = 1/w_u,
//! ```
//!
//! exact by Gram matrices, broken at knots where the surface is (knuckles, tangent lines): nothing is charged across them.

use super::model::{Model, Reading};
use crate::hull::{Entry, Hull, HullError, OffsetTable};
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector, MAX_DEGREE};
pub use crate::spline::{basis_row, energy, mixed_energy};

/// Half-breadths below this part of B are on the centreplane.
const CENTREPLANE: f64 = 1e-9;

/// Control values along the ship for an offset, on the quintic net.
const DENSITY: [f64; 2] = [0.8, 0.9];

/// Weight of a doubtful offset.
const DOUBTFUL: f64 = 0.01;

/// Which energy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnergySettings {
    /// Order n of the derivatives: 2, 3 or 4; none takes 4 on quintic nets and 3 on cubic ones.
    pub order: Option<usize>,
    /// w_u; w_v is its inverse. 1 treats both directions alike.
    pub anisotropy: f64,
}

impl Default for EnergySettings {
    fn default() -> Self {
        Self { order: None, anisotropy: 0.6 }
    }
}

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
    /// Order of the energy.
    pub order: usize,
    /// w_u of the energy.
    pub anisotropy: f64,
    /// Whether the net is one of its own, not that of the fit.
    pub own: bool,
    /// Whether the chart is the rectangle itself: x linear in u and z linear in v.
    pub plain: bool,
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

/// Whether a level hull has plumb ends and simple knots: it stands over a rectangle and has no lines along which it breaks.
fn is_rectangular(hull: &Hull) -> bool {
    let surface = hull.surface();
    let [rows, columns] = surface.shape();
    let length = surface.point(rows - 1, 0)[0] - surface.point(0, 0)[0];
    let plumb =
        |i: usize| (0..columns).all(|j| (surface.point(i, j)[0] - surface.point(i, 0)[0]).abs() <= 1e-9 * length);
    let simple = |knots: &KnotVector| {
        let breaks = knots.breakpoints();
        breaks[1..breaks.len() - 1].iter().all(|&t| knots.multiplicity(t) == 1)
    };
    hull.is_level() && plumb(0) && plumb(rows - 1) && simple(surface.u()) && simple(surface.v())
}

/// A quintic net over the rectangle of a hull with `counts` control values, through the same deck; half-breadths 0.
fn rectangle(hull: &Hull, counts: [usize; 2]) -> Result<Hull, HullError> {
    let knots = |count: usize| {
        let degree = 5.min(count - 1);
        KnotVector::uniform(degree, count - degree)
    };
    let (u, v) = (knots(counts[0])?, knots(counts[1])?);
    let surface = hull.surface();
    let [rows, columns] = surface.shape();
    let (aft, fore) = (surface.point(0, 0)[0], surface.point(rows - 1, columns - 1)[0]);
    let mut points = Vec::with_capacity(counts[0] * counts[1]);
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
    /// From a fit of the table to a model of it; `own` asks for a quintic net of its own, where the hull stands over a rectangle.
    ///
    /// # Errors
    /// [`HullError`] when the net makes no hull.
    pub fn new(table: &OffsetTable, fitted: &Hull, settings: EnergySettings, own: bool) -> Result<Self, HullError> {
        let smooth = own && is_rectangular(fitted) && table.lines.is_empty();
        let mut hull = if smooth {
            let ([stations, waterlines], [along, up]) = ([table.stations.len(), table.waterlines.len()], DENSITY);
            let count =
                |lines: usize, density: f64| ((lines as f64 * density).ceil() as usize).clamp(6.min(lines), lines);
            rectangle(fitted, [count(stations, along), count(waterlines, up)])?
        } else {
            fitted.clone()
        };
        if smooth {
            hull = with_half_breadths(&hull, &greville_values(fitted, &hull))?;
        }
        let start: Vec<f64> = hull.surface().points().iter().map(|p| p[1]).collect();
        let surface = hull.surface();
        let order = settings.order.unwrap_or(if smooth { 4 } else { 3 });
        let order = order.clamp(2, surface.u().degree().max(surface.v().degree()).min(MAX_DEGREE));
        let (mut readings, places) = readings(table, &hull);
        let known = known(fitted, &hull, !smooth);
        for reading in &mut readings {
            // A reading of known control values alone says nothing.
            let free =
                reading.row.iter().filter(|(i, _)| known[*i].is_none()).map(|(_, value)| value.abs()).sum::<f64>();
            if free < 1e-9 {
                reading.weight = 0.0;
            }
        }
        let energy = energy(surface.u(), surface.v(), order, settings.anisotropy);
        let plain = is_plain(&hull);
        Ok(Self {
            model: Model { energy, readings, known, start: (!smooth).then(|| start.clone()) },
            places,
            start,
            order,
            anisotropy: settings.anisotropy,
            plain,
            own: smooth,
            hull,
        })
    }

    /// The hull with other half-breadths of the net.
    ///
    /// # Errors
    /// [`HullError`] when they make no hull.
    pub fn hull_of(&self, y: &[f64]) -> Result<Hull, HullError> {
        with_half_breadths(&self.hull, y)
    }
}

/// Half-breadths of `fitted` at the Greville points of another net over the same rectangle: control values to second order.
fn greville_values(fitted: &Hull, hull: &Hull) -> Vec<f64> {
    hull.surface().points().iter().map(|p| fitted.half_breadth(p[0], p[2]).unwrap_or(0.0)).collect()
}

/// Every given half-breadth and deck at side that lies on the surface.
fn readings(table: &OffsetTable, hull: &Hull) -> (Vec<Reading>, Vec<Place>) {
    let (mut readings, mut places) = (Vec::new(), Vec::new());
    let mut add = |origin: Origin, x: f64, z: f64, value: f64, doubtful: bool, locked: bool| {
        let Some(at) = hull.parameters(x, z) else { return };
        let weight = if doubtful { DOUBTFUL } else { 1.0 };
        readings.push(Reading { row: basis_row(hull.surface(), at, [0, 0]), value, weight, tolerance: None });
        places.push(Place { origin, x, z, at, locked });
    };
    for (station, column) in table.stations.iter().enumerate() {
        for (waterline, (cell, &z)) in column.half_breadths.iter().zip(&table.waterlines).enumerate() {
            if let Entry::Given(value) = cell.entry {
                let origin = Origin::HalfBreadth { station, waterline };
                add(origin, column.station.x, z, value, cell.marks.doubtful, cell.marks.locked);
            }
        }
        if let (Some(z), Some(y)) = (column.deck_height, column.deck_half_breadth) {
            add(Origin::Deck { station }, column.station.x, z, y, false, false);
        }
    }
    (readings, places)
}

/// Control values that do not move: those of the edges of the net that lie on the centreplane in the fit.
fn known(fitted: &Hull, hull: &Hull, own: bool) -> Vec<Option<f64>> {
    let [rows, columns] = hull.surface().shape();
    let slack = CENTREPLANE * hull.particulars().breadth;
    let [fit_rows, fit_columns] = fitted.surface().shape();
    let at = |i: usize, j: usize| fitted.surface().point(i, j)[1].abs() <= slack;
    // On a net of its own an edge is on the centreplane or it is not.
    let whole_row = |i: usize| (0..fit_columns).all(|j| at(i, j));
    let whole_column = |j: usize| (0..fit_rows).all(|i| at(i, j));
    let (aft, fore, keel) = (whole_row(0), whole_row(fit_rows - 1), whole_column(0));
    let mut known = vec![None; rows * columns];
    for i in 0..rows {
        for j in 0..columns {
            let edge = (i == 0, i + 1 == rows, j == 0);
            let fixed = if own {
                (edge.0 || edge.1 || edge.2) && at(i, j)
            } else {
                (edge.0 && aft) || (edge.1 && fore) || (edge.2 && keel)
            };
            if fixed {
                known[i * columns + j] = Some(0.0);
            }
        }
    }
    known
}
