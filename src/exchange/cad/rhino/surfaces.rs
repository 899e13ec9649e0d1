//! Surfaces of an archive: planes, splines, surfaces of revolution, and sums of two curves.

use super::super::surfaces::surface;
use super::chunks::class;
use super::cursor::{Cursor, Object};
use super::curves::{Budget, as_spline, interval, knots, net, plane};
use crate::exchange::fault::Faults;
use crate::hull::FaceSurface;
use crate::spline::{BsplineSurface, HIGHEST_DEGREE, dot, length, minus};

/// A surface with the ends of our parameters.
#[derive(Debug, Clone)]
pub(super) struct Patch {
    pub(super) surface: FaceSurface,
    pub(super) ends: [[f64; 2]; 2],
    /// Whether u and v of the file are our v and u.
    pub(super) swapped: bool,
}

impl Patch {
    fn of_spline(spline: BsplineSurface<4>) -> Self {
        let ends = [spline.u(), spline.v()].map(|knots| knots.domain().into());
        Self { surface: FaceSurface::Spline(spline), ends, swapped: false }
    }
}

impl Budget {
    /// A surface; none where its kind is not read.
    pub(super) fn surface(&mut self, object: &Object<'_>) -> Option<Patch> {
        let mut data = object.data.inside;
        match object.class {
            class::NURBS_SURFACE if object.data.is_sound() => self.spline_surface(&mut data).map(Patch::of_spline),
            class::PLANE_SURFACE => flat(&mut data),
            class::REVOLVED_SURFACE => self.revolved(&mut data),
            class::SUM_SURFACE => self.sum(&mut data).map(Patch::of_spline),
            _ => None,
        }
    }

    fn spline_surface(&mut self, data: &mut Cursor<'_>) -> Option<BsplineSurface<4>> {
        let [1, _] = data.version()? else { return None };
        let (dimension, rational) = (data.int()?, data.int()? != 0);
        let mut whole = || usize::try_from(data.int()?).ok();
        let [p, q, m, n] = [whole()?, whole()?, whole()?, whole()?];
        data.take(8)?;
        data.take(48)?;
        let count = m.checked_mul(n)?;
        let orders = 2..=HIGHEST_DEGREE + 1;
        if dimension != 3 || !(orders.contains(&p) && orders.contains(&q)) || !self.allows(count) {
            return None;
        }
        let (u, v) = (knots(data)?, knots(data)?);
        let net = net(data, [true, rational], count)?;
        if u.len() != m + p || v.len() != n + q {
            return None;
        }
        surface(&mut Faults::default(), None, "", [p - 1, q - 1], [u, v], net.into_iter())
    }

    fn revolved(&mut self, data: &mut Cursor<'_>) -> Option<Patch> {
        let [version, _] = data.version()?;
        let (origin, to): ([f64; 3], [f64; 3]) = (data.reals()?, data.reals()?);
        let angle = interval(data)?;
        if version >= 2 {
            data.take(16)?;
        }
        data.take(48)?;
        let swapped = data.int()? != 0;
        let profile = data.flag()?.then(|| self.curve(&data.object()?)).flatten()?;
        let along = minus(to, origin);
        let size = length(along);
        if size <= 0.0 {
            return None;
        }
        let surface = FaceSurface::Revolved { origin, axis: along.map(|c| c / size), profile: profile.curve };
        Some(Patch { surface, ends: [angle, profile.range], swapped })
    }

    /// base + first(u) + second(v) as a spline: of points (w x, w y, w z, w) the weights are products.
    fn sum(&mut self, data: &mut Cursor<'_>) -> Option<BsplineSurface<4>> {
        let [1, _] = data.version()? else { return None };
        let base: [f64; 3] = data.reals()?;
        data.take(48)?;
        let [first, second] = [self.curve(&data.object()?)?, self.curve(&data.object()?)?].map(|run| as_spline(&run));
        let (first, second) = (first?, second?);
        if !self.allows(first.points().len().checked_mul(second.points().len())?) {
            return None;
        }
        let mut points = Vec::new();
        for a in first.points() {
            for b in second.points() {
                let w = a[3] * b[3];
                let [x, y, z] = [0, 1, 2].map(|k: usize| a[k] * b[3] + b[k] * a[3] + w * base[k]);
                points.push([x, y, z, w]);
            }
        }
        BsplineSurface::new(first.knots().clone(), second.knots().clone(), points).ok()
    }
}

/// A plane between the ends of its coordinates along x and y.
fn flat(data: &mut Cursor<'_>) -> Option<Patch> {
    let [_, minor] = data.version()?;
    let [origin, x, y] = plane(data)?;
    let domain = [interval(data)?, interval(data)?];
    let ends = if minor >= 1 { [interval(data)?, interval(data)?] } else { domain };
    let is_frame = dot(x, y).abs() <= 1e-6 && [x, y].iter().all(|axis| (length(*axis) - 1.0).abs() <= 1e-6);
    is_frame.then_some(Patch { surface: FaceSurface::Plane { origin, x, y }, ends, swapped: false })
}
