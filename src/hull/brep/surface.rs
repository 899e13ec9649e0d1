//! Surfaces of faces, and where on them a point of space lies.

use super::curve::{Conic, SpaceCurve, knots_between, over, slope_over};
use super::nearest::{nearest, nearest_of_surface};
use super::{Motion, apart};
use crate::spline::{BsplineSurface, KnotVector, cross, dot, length, minus};
use std::f64::consts::{FRAC_PI_4, TAU};

/// Edges of a surface nearer to each other than this part of its size are one; lines shorter than it are points.
const CLOSED: f64 = 1e-6;

/// Parameters nearer to an end than this part of the domain are that end.
const ROUNDING: f64 = 1e-9;

/// A line around a surface of this many times the lengths that are 0 is a pole.
const POLE: f64 = 10.0;

/// The part of that at which a surface that is so narrow everywhere is a point.
const NARROW: f64 = 1e-4;

/// Points of a surface from which searches begin, along each direction.
const SEEDS: usize = 48;

/// Lines of these points, in each direction, of which the nearest point is a start.
const STARTS: usize = 3;

/// A surface with its parameters u and v; its normal is S_u x S_v.
#[derive(Debug, Clone)]
pub enum FaceSurface {
    /// origin + u x + v y.
    Plane {
        /// Where u and v are 0.
        origin: [f64; 3],
        /// Along u.
        x: [f64; 3],
        /// Along v.
        y: [f64; 3],
    },
    /// A profile with the parameter v, turned by the angle u about an axis.
    Revolved {
        /// A point of the axis.
        origin: [f64; 3],
        /// Its direction, of length 1.
        axis: [f64; 3],
        /// The profile at u = 0.
        profile: SpaceCurve,
    },
    /// A profile with the parameter u, moved by v along.
    Extruded {
        /// The profile at v = 0.
        profile: SpaceCurve,
        /// What v is counted in.
        along: [f64; 3],
    },
    /// Straight lines between two curves: u in [0, 1] along both, v in [0, 1] from the first to the second.
    Ruled {
        /// Each with the parameters of its ends.
        sides: [(SpaceCurve, [f64; 2]); 2],
    },
    /// A rational spline of points (w x, w y, w z, w).
    Spline(BsplineSurface<4>),
    /// A surface at a distance along the normal of another one.
    Offset {
        /// The other one.
        base: Box<FaceSurface>,
        /// The distance \[m\].
        distance: f64,
    },
}

impl FaceSurface {
    /// A plane by a point and its normal, of any length, and a direction for u, if it matters.
    #[must_use]
    pub fn plane(origin: [f64; 3], normal: [f64; 3], x: Option<[f64; 3]>) -> Self {
        let [x, y, _] = frame(normal, x);
        Self::Plane { origin, x, y }
    }

    /// Point, S_u and S_v; of an offset surface the derivatives are those of its base.
    #[must_use]
    pub fn at(&self, [u, v]: [f64; 2]) -> [[f64; 3]; 3] {
        match self {
            Self::Plane { origin, x, y } => [apart(apart(*origin, u, *x), v, *y), *x, *y],
            Self::Revolved { origin, axis, profile } => {
                let [point, slope] = profile.at(v);
                let arm = minus(point, *origin);
                let turned = turned(arm, *axis, u);
                let height = dot(turned, *axis);
                let radial = apart(turned, -height, *axis);
                [apart(*origin, 1.0, turned), cross(*axis, radial), self::turned(slope, *axis, u)]
            }
            Self::Extruded { profile, along } => {
                let [point, slope] = profile.at(u);
                [apart(point, v, *along), slope, *along]
            }
            Self::Ruled { sides } => {
                let [[a, da], [b, db]] = sides.each_ref().map(|(curve, [from, to])| {
                    let [point, slope] = curve.at(from + u * (to - from));
                    [point, slope.map(|c| c * (to - from))]
                });
                let across = minus(b, a);
                [apart(a, v, across), apart(da, v, minus(db, da)), across]
            }
            Self::Spline(surface) => {
                let [[point, dv], [du, _]] = surface.derivatives::<2>(u, v);
                let place = over(point);
                [place, slope_over(place, du, point[3]), slope_over(place, dv, point[3])]
            }
            Self::Offset { base, distance } => {
                let [point, du, dv] = base.at([u, v]);
                let normal = cross(du, dv);
                let size = length(normal);
                let point = if size > 0.0 { apart(point, distance / size, normal) } else { point };
                [point, du, dv]
            }
        }
    }

    /// Points around a surface of revolution, or over a spline; none of others.
    pub(super) fn around(&self) -> Vec<[f64; 3]> {
        let [us, vs] = match self {
            Self::Revolved { origin, profile, .. } => [[0.0, TAU], profile.search_range(*origin)],
            Self::Spline(surface) => [surface.u(), surface.v()].map(|knots| knots.domain().into()),
            _ => return Vec::new(),
        };
        let at = |[from, to]: [f64; 2], k: usize| from + (to - from) * k as f64 / 8.0;
        (0..72).map(|k| self.at([at(us, k % 8), at(vs, k / 8)])[0]).collect()
    }

    /// The curve on the surface where u (axis 0), or v (axis 1), has a value, with its own parameters at the given ends of
    /// the other one; none of planes and offsets.
    #[must_use]
    pub fn side(&self, axis: usize, value: f64, ends: [f64; 2]) -> Option<(SpaceCurve, [f64; 2])> {
        let curve = match (self, axis) {
            (Self::Spline(surface), 0) => Some(SpaceCurve::Spline(surface.curve_at_u(value))),
            (Self::Spline(surface), _) => Some(SpaceCurve::Spline(surface.curve_at_v(value))),
            (Self::Revolved { origin, axis, profile }, 0) => {
                let columns = [0, 1, 2].map(|k| turned([0, 1, 2].map(|j| f64::from(j == k)), *axis, value));
                let row = |k: usize| {
                    let [a, b, c] = columns.map(|column| column[k]);
                    [a, b, c, origin[k] - a * origin[0] - b * origin[1] - c * origin[2]]
                };
                Some(profile.moved(&Motion([row(0), row(1), row(2)])))
            }
            (Self::Revolved { origin, axis, profile }, _) => {
                let arm = minus(profile.point(value), *origin);
                let height = dot(arm, *axis);
                let x = apart(arm, -height, *axis);
                let (centre, y) = (apart(*origin, height, *axis), cross(*axis, x));
                Some(SpaceCurve::Conic { kind: Conic::Ellipse, centre, x, y })
            }
            (Self::Extruded { profile, along }, 0) => {
                Some(SpaceCurve::Line { origin: profile.point(value), along: *along })
            }
            (Self::Extruded { profile, along }, _) => {
                let row = |k: usize| [f64::from(k == 0), f64::from(k == 1), f64::from(k == 2), value * along[k]];
                Some(profile.moved(&Motion([row(0), row(1), row(2)])))
            }
            (Self::Ruled { .. }, 0) => {
                let [from, to] = [0.0, 1.0].map(|v| self.at([value, v])[0]);
                Some(SpaceCurve::between(from, to))
            }
            (Self::Ruled { sides }, _) => {
                let (curve, [from, to]) = &sides[usize::from(value > 0.5)];
                return Some((curve.clone(), ends.map(|u| from + u * (to - from))));
            }
            _ => None,
        };
        curve.map(|curve| (curve, ends))
    }

    /// The surface after a motion.
    #[must_use]
    pub fn moved(&self, motion: &Motion) -> Self {
        match self {
            Self::Plane { origin, x, y } => {
                let (x, y) = (motion.along(*x), motion.along(*y));
                let is_rigid = (length(x) - 1.0).abs().max((length(y) - 1.0).abs()).max(dot(x, y).abs()) < 1e-9;
                let [x, y, _] = if is_rigid { [x, y, x] } else { frame(cross(x, y), Some(x)) };
                Self::Plane { origin: motion.point(*origin), x, y }
            }
            Self::Revolved { origin, axis, profile } => {
                // A reflection turns the angle about the axis over.
                let [x, y, z] = [0, 1, 2].map(|k| motion.along([0, 1, 2].map(|j| f64::from(j == k))));
                let sense = dot(cross(x, y), z).signum();
                let axis = unit(motion.along(*axis)).map(|c| sense * c);
                Self::Revolved { origin: motion.point(*origin), axis, profile: profile.moved(motion) }
            }
            Self::Extruded { profile, along } => {
                Self::Extruded { profile: profile.moved(motion), along: motion.along(*along) }
            }
            Self::Ruled { sides } => {
                Self::Ruled { sides: sides.each_ref().map(|(curve, ends)| (curve.moved(motion), *ends)) }
            }
            Self::Spline(surface) => {
                let points = surface.points().iter().map(|&p| motion.weighted(p)).collect();
                let made = BsplineSurface::new(surface.u().clone(), surface.v().clone(), points);
                Self::Spline(made.unwrap_or_else(|_| surface.clone()))
            }
            Self::Offset { base, distance } => Self::Offset { base: Box::new(base.moved(motion)), distance: *distance },
        }
    }
}

/// The vector over its length.
pub(super) fn unit(vector: [f64; 3]) -> [f64; 3] {
    let size = length(vector);
    if size > 0.0 { vector.map(|c| c / size) } else { vector }
}

/// A right-handed frame (x, y, z) of unit vectors: z along the normal, x as near to the given direction as can be.
#[must_use]
pub fn frame(normal: [f64; 3], x: Option<[f64; 3]>) -> [[f64; 3]; 3] {
    let z = unit(normal);
    let across = |x: [f64; 3]| apart(x, -dot(x, z), z);
    let given = x.map(|x| across(unit(x))).filter(|x| length(*x) > 1e-9);
    let x = given.unwrap_or_else(|| {
        let least = (0..3).min_by(|&a, &b| z[a].abs().total_cmp(&z[b].abs())).unwrap_or(0);
        across([0, 1, 2].map(|k| f64::from(k == least)))
    });
    let x = unit(x);
    [x, cross(z, x), z]
}

/// A vector turned about an axis of length 1 (Rodrigues).
fn turned(vector: [f64; 3], axis: [f64; 3], angle: f64) -> [f64; 3] {
    let (sine, cosine) = angle.sin_cos();
    let side = cross(axis, vector);
    let along = dot(axis, vector) * (1.0 - cosine);
    [0, 1, 2].map(|k| vector[k] * cosine + side[k] * sine + axis[k] * along)
}

/// Where a point lies on a surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Preimage {
    /// The parameters.
    pub(super) uv: [f64; 2],
    /// How far the point is from the surface \[m\].
    pub(super) distance: f64,
    /// The direction that is a point there, so that its parameter may be any.
    pub(super) free: Option<usize>,
}

/// Parameters and their point.
type Seed = ([f64; 2], [f64; 3]);

/// The nearest of places by their distances.
fn lowest<'a>(places: impl Iterator<Item = &'a (f64, [f64; 2])>) -> Option<(f64, [f64; 2])> {
    places.min_by(|a, b| a.0.total_cmp(&b.0)).copied()
}

/// A surface with what searches on it need.
pub(super) struct Chart<'a> {
    pub(super) surface: &'a FaceSurface,
    /// Lengths of u and v after which it repeats itself.
    pub(super) period: [Option<f64>; 2],
    /// Where it ends.
    pub(super) domain: [Option<[f64; 2]>; 2],
    /// Lengths that are 0.
    slack: f64,
    /// Places from which searches begin, in rows of one u.
    seeds: Vec<Vec<Seed>>,
    /// Of a profile in a plane with its axis, the direction of that plane off the axis.
    side: Option<[f64; 3]>,
}

impl<'a> Chart<'a> {
    /// Of a body of the given size.
    pub(super) fn new(surface: &'a FaceSurface, size: f64) -> Self {
        let slack = CLOSED * size;
        let mut chart = Self { surface, period: [None; 2], domain: [None; 2], slack, seeds: Vec::new(), side: None };
        match surface {
            FaceSurface::Plane { .. } => {}
            FaceSurface::Revolved { origin, axis, profile } => {
                chart.period = [Some(TAU), profile.period()];
                chart.domain[1] = profile.domain();
                chart.side = side_of(*origin, *axis, profile, slack);
            }
            FaceSurface::Extruded { profile, .. } => {
                chart.period[0] = profile.period();
                chart.domain[0] = profile.domain();
            }
            FaceSurface::Ruled { .. } => chart.domain = [Some([0.0, 1.0]); 2],
            FaceSurface::Spline(spline) => {
                chart.domain = [spline.u(), spline.v()].map(|knots| Some(knots.domain().into()));
            }
            FaceSurface::Offset { base, .. } => {
                let Chart { period, domain, seeds, side, .. } = Chart::new(base, size);
                chart = Self { period, domain, seeds, side, ..chart };
            }
        }
        if let (FaceSurface::Ruled { .. } | FaceSurface::Spline(_), [Some(us), Some(vs)]) = (surface, chart.domain) {
            let grid = [0, 1].map(|axis| chart.sites(axis));
            chart.seeds =
                grid[0].iter().map(|&u| grid[1].iter().map(|&v| ([u, v], surface.at([u, v])[0])).collect()).collect();
            let apart = |a: [f64; 2], b: [f64; 2]| length(minus(surface.at(a)[0], surface.at(b)[0]));
            let meets = |axis: usize| {
                let (ends, across) = if axis == 0 { (us, &grid[1]) } else { (vs, &grid[0]) };
                let place = |t: f64, s: f64| if axis == 0 { [t, s] } else { [s, t] };
                across.iter().all(|&s| apart(place(ends[0], s), place(ends[1], s)) <= slack)
                    && across.windows(2).any(|w| apart(place(ends[0], w[0]), place(ends[0], w[1])) > slack)
            };
            chart.period = [0, 1].map(|axis| {
                let [a, b] = [us, vs][axis];
                meets(axis).then_some(b - a)
            });
        }
        chart
    }

    /// Parameters of a spline along one direction: knots and points between them.
    fn sites(&self, axis: usize) -> Vec<f64> {
        let [a, b] = self.domain[axis].unwrap_or([0.0, 1.0]);
        let breaks: Vec<f64> = self.breaks(axis, [a, b]).into_iter().map(|(t, _)| t).collect();
        let parts = (SEEDS / breaks.len().max(1)).clamp(1, 12);
        let skip = breaks.len().div_ceil(SEEDS);
        let kept: Vec<f64> =
            breaks[..breaks.len() - 1].iter().copied().step_by(skip).chain(breaks.last().copied()).collect();
        let inner =
            kept.windows(2).flat_map(|w| (0..parts).map(move |k| w[0] + (w[1] - w[0]) * k as f64 / parts as f64));
        inner.chain([b]).collect()
    }

    /// The parameters inside the domain of a closed direction.
    fn wrapped(&self, uv: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| match (self.domain[k], self.period[k]) {
            (Some([a, b]), Some(period)) if !(a..=b).contains(&uv[k]) => a + (uv[k] - a).rem_euclid(period),
            _ => uv[k],
        })
    }

    /// The point at the parameters.
    pub(super) fn point(&self, uv: [f64; 2]) -> [f64; 3] {
        self.surface.at(self.wrapped(uv))[0]
    }

    fn tangents(&self, uv: [f64; 2]) -> [[f64; 3]; 3] {
        self.surface.at(self.wrapped(uv))
    }

    /// The points of a grid of parameters, u slowest.
    pub(super) fn grid(&self, us: &[f64], vs: &[f64]) -> Vec<[f64; 3]> {
        us.iter().flat_map(|&u| vs.iter().map(move |&v| self.point([u, v]))).collect()
    }

    /// Parameters between which the surface is smooth in one direction, the ends of the range among them, and whether
    /// it may have a corner there.
    pub(super) fn breaks(&self, axis: usize, [from, to]: [f64; 2]) -> Vec<(f64, bool)> {
        let plain = |list: Vec<f64>| list.into_iter().map(|t| (t, false)).collect::<Vec<_>>();
        let equal = |width: f64| {
            let count = ((to - from) / width).ceil().clamp(1.0, 64.0);
            plain((0..=count as usize).map(|k| from + (to - from) * k as f64 / count).collect())
        };
        let of_knots = |knots: &KnotVector| {
            let inner = knots_between(knots, self.period[axis].is_some(), [from, to]);
            std::iter::once((from, true)).chain(inner).chain([(to, true)]).collect()
        };
        let of_curve = |curve: &SpaceCurve| match curve {
            SpaceCurve::Spline(spline) => of_knots(spline.knots()),
            _ => plain(curve.breaks(from, to)),
        };
        match (self.surface, axis) {
            (FaceSurface::Revolved { .. }, 0) => equal(FRAC_PI_4),
            (FaceSurface::Revolved { profile, .. }, _) | (FaceSurface::Extruded { profile, .. }, 0) => {
                of_curve(profile)
            }
            (FaceSurface::Ruled { sides: [(curve, [a, b]), _] }, 0) => {
                let width = b - a;
                let own = curve.breaks(a + from * width, a + to * width);
                own.into_iter().map(|t| ((t - a) / width, true)).collect()
            }
            (FaceSurface::Spline(surface), _) => of_knots(if axis == 0 { surface.u() } else { surface.v() }),
            (FaceSurface::Offset { base, .. }, _) => {
                let Self { surface: _, period, domain, slack, .. } = *self;
                Chart { surface: base, period, domain, slack, seeds: Vec::new(), side: self.side }
                    .breaks(axis, [from, to])
            }
            _ => plain(vec![from, to]),
        }
    }

    /// Where a point lies; of several places the one near to `near`.
    pub(super) fn preimage(&self, point: [f64; 3], near: Option<[f64; 2]>) -> Preimage {
        self.preimage_beside(point, near, POLE * self.slack)
    }

    /// The same on a surface that is narrow all over, where only rounding is a point.
    pub(super) fn preimage_on_narrow(&self, point: [f64; 3], near: Option<[f64; 2]>) -> Preimage {
        self.preimage_beside(point, near, NARROW * POLE * self.slack)
    }

    /// The same with a direction that is a point where it is not longer than this \[m\].
    fn preimage_beside(&self, point: [f64; 3], near: Option<[f64; 2]>, pole: f64) -> Preimage {
        let found = self.anywhere(self.surface, point, near);
        let uv = [0, 1].map(|k| match (self.period[k], near) {
            (Some(period), Some(near)) => found[k] + ((near[k] - found[k]) / period).round() * period,
            _ => found[k],
        });
        // Rounding does not leave the ends of a surface.
        let uv = [0, 1].map(|k: usize| match (self.period[k], self.domain[k]) {
            (None, Some([a, b])) if (uv[k] - a).abs() <= ROUNDING * (b - a) => a,
            (None, Some([a, b])) if (uv[k] - b).abs() <= ROUNDING * (b - a) => b,
            _ => uv[k],
        });
        let [place, du, dv] = self.tangents(uv);
        let widths = [0, 1].map(|k| self.period[k].or(self.domain[k].map(|[a, b]| b - a)));
        let is_point = |slope: [f64; 3], width: Option<f64>| width.is_some_and(|width| length(slope) * width <= pole);
        let free = if is_point(du, widths[0]) {
            Some(0)
        } else if is_point(dv, widths[1]) {
            Some(1)
        } else {
            None
        };
        Preimage { uv, distance: length(minus(place, point)), free }
    }

    fn anywhere(&self, surface: &FaceSurface, point: [f64; 3], near: Option<[f64; 2]>) -> [f64; 2] {
        match surface {
            FaceSurface::Plane { origin, x, y } => {
                let arm = minus(point, *origin);
                let (xx, yy, xy) = (dot(*x, *x), dot(*y, *y), dot(*x, *y));
                let (a, b) = (dot(arm, *x), dot(arm, *y));
                let determinant = xx * yy - xy * xy;
                [(a * yy - b * xy) / determinant, (b * xx - a * xy) / determinant]
            }
            FaceSurface::Revolved { origin, axis, profile } => self.on_revolved(point, *origin, *axis, profile),
            FaceSurface::Extruded { profile, along } => {
                let [x, y, z] = frame(*along, None);
                let flat = |p: [f64; 3]| [dot(p, x), dot(p, y)];
                let u = nearest_on(profile, point, |t| profile.at(t).map(flat), flat(point));
                [u, dot(minus(point, profile.point(u)), z) / length(*along)]
            }
            FaceSurface::Offset { base, .. } => self.anywhere(base, point, near),
            FaceSurface::Ruled { .. } | FaceSurface::Spline(_) => self.searched(point, near),
        }
    }

    fn on_revolved(&self, point: [f64; 3], origin: [f64; 3], axis: [f64; 3], profile: &SpaceCurve) -> [f64; 2] {
        let arm = minus(point, origin);
        let height = dot(arm, axis);
        let radial = apart(arm, -height, axis);
        let radius = length(radial);
        let angle = |from: [f64; 3], to: [f64; 3]| dot(cross(from, to), axis).atan2(dot(from, to));
        let local = |t: f64| profile.at(t).map(|p| (p, dot(p, axis)));
        match self.side {
            Some(side) => {
                let zero = dot(origin, axis);
                let flat = |t: f64| {
                    let [(point, level), (slope, rise)] = local(t);
                    [[dot(minus(point, origin), side), level - zero], [dot(slope, side), rise]]
                };
                let far = |target: [f64; 2]| {
                    let v = nearest_on(profile, point, flat, target);
                    let [[s, h], _] = flat(v);
                    (v, (s - target[0]).hypot(h - target[1]))
                };
                let [beside, opposite] = [far([radius, height]), far([-radius, height])];
                if beside.1 <= opposite.1 + self.slack {
                    [angle(side, radial), beside.0]
                } else {
                    [angle(side.map(|c| -c), radial), opposite.0]
                }
            }
            None => {
                let flat = |t: f64| {
                    let [point, slope] = profile.at(t);
                    let arm = minus(point, origin);
                    let level = dot(arm, axis);
                    let out = apart(arm, -level, axis);
                    let r = length(out).max(f64::MIN_POSITIVE);
                    [[r, level], [dot(out, slope) / r, dot(slope, axis)]]
                };
                let v = nearest_on(profile, point, flat, [radius, height]);
                let arm = minus(profile.point(v), origin);
                [angle(apart(arm, -dot(arm, axis), axis), radial), v]
            }
        }
    }

    /// By the method of Gauss and Newton, from `near` or from the nearest of the seeds.
    fn searched(&self, point: [f64; 3], near: Option<[f64; 2]>) -> [f64; 2] {
        let bounds = [0, 1].map(|k| if self.period[k].is_some() { None } else { self.domain[k] });
        let from = |start: [f64; 2]| nearest_of_surface(|uv| self.tangents(uv), start, bounds, point);
        let beside = near.map(from);
        if let Some((uv, far)) = beside
            && far <= self.slack
        {
            return uv;
        }
        let far = |(uv, place): &Seed| (length(minus(*place, point)), *uv);
        let seeds: Vec<Vec<(f64, [f64; 2])>> = self.seeds.iter().map(|row| row.iter().map(far).collect()).collect();
        // The nearest ones may all stand on the wrong side of a fold: those of several lines in both directions do not.
        let rows = seeds.iter().map(|row| lowest(row.iter()));
        let columns = (0..seeds.first().map_or(0, Vec::len)).map(|k| lowest(seeds.iter().map(move |row| &row[k])));
        let best_of = |mut list: Vec<(f64, [f64; 2])>| {
            list.sort_by(|a, b| a.0.total_cmp(&b.0));
            list.truncate(STARTS);
            list
        };
        let starts = best_of(rows.flatten().collect()).into_iter().chain(best_of(columns.flatten().collect()));
        let best = beside.into_iter().chain(starts.map(|(_, start)| from(start))).min_by(|a, b| a.1.total_cmp(&b.1));
        best.map_or([0.0; 2], |(uv, _)| uv)
    }

    /// Where the surface shrinks to points along a direction: values of the other parameter.
    pub(super) fn poles(&self, axis: usize) -> Vec<f64> {
        let shrinks = |value: f64| {
            let place = |t: f64| if axis == 0 { [t, value] } else { [value, t] };
            let width = self.period[axis].unwrap_or(1.0);
            let from = self.domain[axis].map_or(0.0, |[a, _]| a);
            let first = self.point(place(from));
            (1..4).all(|k| length(minus(self.point(place(from + 0.25 * width * f64::from(k))), first)) <= self.slack)
        };
        match self.surface {
            FaceSurface::Revolved { origin, profile, .. } if axis == 0 => {
                let Some(side) = self.side else { return Vec::new() };
                let off = |t: f64| dot(minus(profile.point(t), *origin), side);
                crossings(profile, off).into_iter().filter(|&v| shrinks(v)).chain(self.ends(1, &shrinks)).collect()
            }
            _ => self.ends(1 - axis, &shrinks),
        }
    }

    fn ends(&self, axis: usize, shrinks: &impl Fn(f64) -> bool) -> Vec<f64> {
        self.domain[axis].into_iter().flatten().filter(|&value| shrinks(value)).collect()
    }
}

/// The nearest parameter of a profile in a plane, where the profile is given as points and slopes; `point` bounds the search
/// on curves without ends.
fn nearest_on(profile: &SpaceCurve, point: [f64; 3], flat: impl Fn(f64) -> [[f64; 2]; 2], target: [f64; 2]) -> f64 {
    if matches!(profile, SpaceCurve::Line { .. }) {
        let [place, slope] = flat(0.0);
        let square = slope[0] * slope[0] + slope[1] * slope[1];
        return ((target[0] - place[0]) * slope[0] + (target[1] - place[1]) * slope[1]) / square;
    }
    let [from, to] = profile.search_range(point);
    nearest(flat, &profile.breaks(from, to), profile.period().is_some(), target).parameter
}

/// The direction off the axis of the plane in which a profile lies with it; none where it lies in none.
fn side_of(origin: [f64; 3], axis: [f64; 3], profile: &SpaceCurve, slack: f64) -> Option<[f64; 3]> {
    let [from, to] = match profile {
        SpaceCurve::Line { along, .. } => [0.0, 1.0 / length(*along).max(f64::MIN_POSITIVE)],
        _ => profile.search_range(origin),
    };
    let sites = (0..=16).map(|k| from + (to - from) * f64::from(k) / 16.0);
    let arms: Vec<[f64; 3]> =
        sites.map(|t| minus(profile.point(t), origin)).map(|arm| apart(arm, -dot(arm, axis), axis)).collect();
    let farthest = *arms.iter().max_by(|a, b| length(**a).total_cmp(&length(**b)))?;
    let side = unit(farthest);
    arms.iter().all(|&arm| length(apart(arm, -dot(arm, side), side)) <= slack).then_some(side)
}

/// Parameters at which a function of a profile changes its sign.
fn crossings(profile: &SpaceCurve, off: impl Fn(f64) -> f64) -> Vec<f64> {
    if matches!(profile, SpaceCurve::Line { .. }) {
        let (at, rise) = (off(0.0), off(1.0) - off(0.0));
        return if rise.abs() > 1e-12 * at.abs() { vec![-at / rise] } else { Vec::new() };
    }
    let [from, to] = match profile {
        SpaceCurve::Conic { .. } => [-0.1 - std::f64::consts::PI, std::f64::consts::PI - 0.1],
        _ => profile.domain().unwrap_or([0.0, 1.0]),
    };
    let site = |k: usize| from + (to - from) * k as f64 / 64.0;
    let mut found = Vec::new();
    for k in 0..64 {
        let (mut a, mut b) = (site(k), site(k + 1));
        if off(a) * off(b) < 0.0 {
            for _ in 0..60 {
                let middle = 0.5 * (a + b);
                if off(a) * off(middle) <= 0.0 { b = middle } else { a = middle }
            }
            found.push(0.5 * (a + b));
        }
    }
    found
}
