//! Hulls on one chart: the same knots, and the same x(u, v) and z(u, v) as far as their profiles are the same.
//!
//! One of the hulls, the base, keeps its surface: its degree is raised and knots are added, which changes nothing. The chart
//! of another one is that of the base, moved by what its profile is apart,
//!
//! ```text
//! X = x + f(m) E_a(v) + f(1 - m) E_f(v),     f(m) = t^3 (10 - 15 t + 6 t^2),  t = max(0, 1 - 2 m)
//! Z = z + (1 - h) K(u) + g(w) D(u),          g(w) = 2 w^3 - w^4,              w = max(0, (h - h_T) / (1 - h_T))
//! ```
//!
//! with m the part of the length on the design waterline, h that of the height at midship and h_T its value at T. E_a and E_f
//! are how far the end profiles are apart at one height, K and D how far keel and upper edge are apart at one x. So charts
//! differ near the ends only, and not at all between a common keel and T. Half-breadths are interpolated at the averages of the
//! knots (Greville sites); knots are halved until the surface that results is within [`FINE`] of the hull.

use super::super::refusal::Refusal;
use crate::hull::{Hull, HullError};
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector, SplineError, cross, dot};

/// Error of the refit, in parts of L_PP, below which knots are not halved.
const FINE: f64 = 2e-6;
/// Most rows and columns of the net.
const MOST: [usize; 2] = [220, 160];
/// Knots that are closer, in parts of the domain, are one.
const SAME_KNOT: f64 = 1e-5;
/// Differences of a height along the ship that are rounding, in parts of the height of the hull.
const ROUNDING: f64 = 1e-11;
/// Points of a span in each direction on which the distance of a refit is reported; of trials one.
const MEASURED: usize = 3;
/// Spans by which the deck at side is refitted.
const DECK_SPANS: usize = 32;

/// Hulls on one chart.
#[derive(Debug, Clone)]
pub(super) struct OneChart {
    /// The hulls, in their order.
    pub(super) hulls: Vec<Hull>,
    /// The one that keeps its surface.
    pub(super) base: usize,
    /// Largest distance of each from the hull that it stands for, normal to it \[m\].
    pub(super) errors: Vec<f64>,
}

/// Why a hull is not brought to the chart of another one.
#[derive(Debug)]
enum Unlike {
    /// A point of the chart is outside of its profile \[m\].
    Outside([f64; 2]),
    /// The net is none of a hull.
    Hull(HullError),
    /// The interpolation fails.
    Spline(SplineError),
}

impl From<HullError> for Unlike {
    fn from(error: HullError) -> Self {
        Self::Hull(error)
    }
}

impl From<SplineError> for Unlike {
    fn from(error: SplineError) -> Self {
        Self::Spline(error)
    }
}

/// Brings hulls of the same dimensions to the chart of that one on which the others are best refitted.
///
/// # Errors
/// E424 where the profiles are too different for one chart.
pub(super) fn on_one_chart(hulls: &[Hull], draught: f64) -> Result<OneChart, Refusal> {
    let mut best: Option<OneChart> = None;
    let mut failure = None;
    for base in 0..hulls.len() {
        match brought(hulls, base, draught, 0) {
            Ok(found) => {
                if best.as_ref().is_none_or(|other| worst(&found) < worst(other)) {
                    best = Some(found);
                }
            }
            Err((which, unlike)) => failure = failure.or(Some((which, base, unlike))),
        }
    }
    let Some(mut best) = best else {
        let (which, base, unlike) = failure.unwrap_or((0, 0, Unlike::Outside([0.0; 2])));
        return Err(refused(hulls, which, base, &unlike));
    };
    let length = hulls[best.base].particulars().length_between_perpendiculars;
    for halvings in 1..=3 {
        if worst(&best) <= FINE * length {
            break;
        }
        match brought(hulls, best.base, draught, halvings) {
            Ok(finer) if worst(&finer) < worst(&best) => best = finer,
            _ => break,
        }
    }
    best.errors =
        measured(hulls, &best, draught).map_err(|(which, unlike)| refused(hulls, which, best.base, &unlike))?;
    Ok(best)
}

/// The largest distances, on the points that are reported.
fn measured(hulls: &[Hull], found: &OneChart, draught: f64) -> Result<Vec<f64>, (usize, Unlike)> {
    let base = on_unit_square(&hulls[found.base]).map_err(|error| (found.base, error))?;
    let of = |(k, hull): (usize, &Hull)| {
        if k == found.base {
            return Ok(0.0);
        }
        let hull = on_unit_square(hull).map_err(|error| (k, error))?;
        let bend = Bend::new(&base, &hull, draught).ok_or((k, Unlike::Outside([0.0, draught])))?;
        Ok(bend.error(found.hulls[k].surface(), MEASURED))
    };
    hulls.iter().enumerate().map(of).collect()
}

fn worst(found: &OneChart) -> f64 {
    found.errors.iter().copied().fold(0.0, f64::max)
}

fn refused(hulls: &[Hull], which: usize, base: usize, unlike: &Unlike) -> Refusal {
    let why = match unlike {
        Unlike::Outside([x, z]) => format!("near x = {x:.2} m, z = {z:.2} m no point of it corresponds to the other"),
        Unlike::Hull(error) => error.to_string(),
        Unlike::Spline(error) => error.to_string(),
    };
    let message = format!("{} and {} have no common chart: {why}", hulls[which].name(), hulls[base].name());
    let remedy = "Blend hulls with profiles that are alike".to_owned();
    Refusal::new("E424", vec!["hulls"], message, remedy)
}

/// A knot vector with its domain from 0 to 1.
fn unit(knots: &KnotVector) -> Result<KnotVector, SplineError> {
    let (a, b) = knots.domain();
    KnotVector::new(knots.degree(), knots.knots().iter().map(|t| ((t - a) / (b - a)).clamp(0.0, 1.0)).collect())
}

/// A hull with its parameters from 0 to 1.
fn on_unit_square(hull: &Hull) -> Result<Hull, Unlike> {
    let surface = hull.surface();
    let surface = BsplineSurface::new(unit(surface.u())?, unit(surface.v())?, surface.points().to_vec())?;
    let deck = BsplineCurve::new(unit(hull.deck().knots())?, hull.deck().points().to_vec())?;
    Ok(Hull::new(hull.name(), *hull.particulars(), surface, deck)?)
}

/// Knots strictly inside of a domain with their multiplicities.
fn inner(knots: &KnotVector) -> Vec<(f64, usize)> {
    let breaks = knots.breakpoints();
    breaks[1..breaks.len() - 1].iter().map(|t| (*t, knots.multiplicity(*t))).collect()
}

/// What is to be inserted into `knots` for `wanted` knots with their multiplicities.
fn missing(knots: &KnotVector, wanted: &[(f64, usize)]) -> Vec<f64> {
    let mut all = inner(knots);
    let mut inserted = Vec::new();
    for &(t, times) in wanted.iter().filter(|(t, _)| (SAME_KNOT..=1.0 - SAME_KNOT).contains(t)) {
        let times = times.min(knots.degree());
        match all.iter_mut().find(|(other, _)| (other - t).abs() < SAME_KNOT) {
            Some((other, had)) => {
                inserted.extend(std::iter::repeat_n(*other, times.saturating_sub(*had)));
                *had = times.max(*had);
            }
            None => {
                inserted.extend(std::iter::repeat_n(t, times));
                all.push((t, times));
            }
        }
    }
    inserted
}

/// The middles of the spans, as knots.
fn halves(knots: &KnotVector) -> Vec<f64> {
    knots.breakpoints().windows(2).filter(|w| w[1] - w[0] > 4.0 * SAME_KNOT).map(|w| 0.5 * (w[0] + w[1])).collect()
}

/// The hulls on the chart of `base`, with the spans of its knots halved so often.
fn brought(hulls: &[Hull], base: usize, draught: f64, halvings: usize) -> Result<OneChart, (usize, Unlike)> {
    let of_base = |error: Unlike| (base, error);
    let all: Vec<Hull> =
        hulls.iter().enumerate().map(|(k, hull)| on_unit_square(hull).map_err(|e| (k, e))).collect::<Result<_, _>>()?;
    let degree = |of: &dyn Fn(&Hull) -> usize| all.iter().map(of).max().unwrap_or(0);
    let [in_u, in_v] = [degree(&|h| h.surface().u().degree()), degree(&|h| h.surface().v().degree())];
    let original = all[base].surface();
    let raised = original.elevate(in_u - original.u().degree(), in_v - original.v().degree());
    let mut surface = raised.map_err(|e| of_base(e.into()))?;
    let bend = |(k, hull)| match k == base {
        true => Ok(None),
        false => Bend::new(&all[base], hull, draught).map(Some).ok_or((k, Unlike::Outside([0.0, draught]))),
    };
    let bends = all.iter().enumerate().map(bend).collect::<Result<Vec<_>, _>>()?;
    for (k, bend) in bends.iter().enumerate().filter_map(|(k, bend)| Some((k, bend.as_ref()?))) {
        let [u, v] = bend.breaks([in_u, in_v]);
        surface =
            surface.insert_knots(&missing(surface.u(), &u), &missing(surface.v(), &v)).map_err(|e| (k, e.into()))?;
    }
    for _ in 0..halvings {
        let [rows, columns] = surface.shape();
        let more = [halves(surface.u()), halves(surface.v())];
        let few =
            |more: &[f64], now: usize, most: usize| if now + more.len() <= most { more.to_vec() } else { Vec::new() };
        let (u, v) = (few(&more[0], rows, MOST[0]), few(&more[1], columns, MOST[1]));
        surface = surface.insert_knots(&u, &v).map_err(|e| of_base(e.into()))?;
    }
    let decks = decks(&all, base).map_err(of_base)?;
    let mut found = OneChart { hulls: Vec::new(), base, errors: Vec::new() };
    for (k, hull) in all.iter().enumerate() {
        let (net, error) = match &bends[k] {
            None => (surface.clone(), 0.0),
            Some(bend) => bend.refitted(&surface).map_err(|e| (k, e))?,
        };
        let on = Hull::new(hull.name(), *hull.particulars(), net, decks[k].clone()).map_err(|e| (k, e.into()))?;
        found.hulls.push(on);
        found.errors.push(error);
    }
    Ok(found)
}

/// The decks at side over common knots: the base keeps its own, the others are interpolated at equal parts of their lengths.
fn decks(hulls: &[Hull], base: usize) -> Result<Vec<BsplineCurve<2>>, Unlike> {
    let degree = hulls.iter().map(|hull| hull.deck().knots().degree()).max().unwrap_or(1).max(3);
    let ends = |hull: &Hull| {
        let points = hull.deck().points();
        [points[0][0], points[points.len() - 1][0]]
    };
    let own = hulls[base].deck();
    let mut deck = own.elevate(degree - own.knots().degree())?;
    if hulls.iter().any(|hull| hull.deck() != own) {
        let more: Vec<(f64, usize)> = (1..DECK_SPANS).map(|k| (k as f64 / DECK_SPANS as f64, 1)).collect();
        deck = deck.insert_knots(&missing(deck.knots(), &more))?;
    }
    let sites = deck.knots().greville();
    let [aft, fore] = ends(&hulls[base]);
    let refitted = |(k, hull): (usize, &Hull)| {
        if k == base || hull.deck() == own {
            return Ok(deck.clone());
        }
        let [from, to] = ends(hull);
        let point = |t: &f64| {
            let x = from + (to - from) * (deck.eval(*t)[0] - aft) / (fore - aft);
            [x, hull.deck_height(x)]
        };
        let points: Vec<[f64; 2]> = sites.iter().map(point).collect();
        Ok(BsplineCurve::interpolate(deck.knots().clone(), &sites, &points)?)
    };
    hulls.iter().enumerate().map(refitted).collect()
}

/// The chart of a hull as that of the base and what its profile is apart from it.
struct Bend<'a> {
    base: &'a Hull,
    other: &'a Hull,
    /// Parameters of the design waterline and of midship on the base.
    waterline: f64,
    midship: f64,
    /// Ends of the design waterline of the base \[m\].
    ends: [f64; 2],
    /// Heights of the base at midship: keel, T, upper edge \[m\].
    heights: [f64; 3],
    /// Parameters of design waterline and midship on the other hull.
    of_other: [f64; 2],
}

/// What the profile of the other hull is apart at one u: x on keel and upper edge, K and D, and its parameters there.
#[derive(Clone, Copy)]
struct Across {
    u: f64,
    fades: [f64; 2],
    apart: [f64; 2],
    parameters: [f64; 2],
}

/// What the end profiles are apart at one v: E_a and E_f, and the parameters of the other hull there.
#[derive(Clone, Copy)]
struct Along {
    v: f64,
    weights: [f64; 2],
    apart: [f64; 2],
    parameters: [f64; 2],
}

/// f(m).
fn fade(part: f64) -> f64 {
    let t = (1.0 - 2.0 * part).clamp(0.0, 1.0);
    t.powi(3) * (10.0 - 15.0 * t + 6.0 * t * t)
}

/// The parameters of the design waterline and of midship.
fn marks(hull: &Hull, draught: f64) -> Option<[f64; 2]> {
    let mut middle = 0.5;
    let mut waterline = hull.height_parameter_at(middle, draught)?;
    // The lines u = constant are not upright: the middle of the waterline moves with it.
    for _ in 0..30 {
        let [a, b] = [0.0, 1.0].map(|u| hull.surface().eval(u, waterline)[0]);
        middle = hull.length_parameter(0.5 * (a + b), waterline)?;
        waterline = hull.height_parameter_at(middle, draught)?;
    }
    Some([waterline, middle])
}

/// Root of a function that rises from 0 to 1.
fn root(target: f64, function: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if function(middle) < target {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

impl<'a> Bend<'a> {
    fn new(base: &'a Hull, other: &'a Hull, draught: f64) -> Option<Self> {
        let [waterline, midship] = marks(base, draught)?;
        let ends = [0.0, 1.0].map(|u| base.surface().eval(u, waterline)[0]);
        let [keel, top] = [0.0, 1.0].map(|v| base.surface().eval(midship, v)[2]);
        let of_other = marks(other, draught)?;
        Some(Self { base, other, waterline, midship, ends, heights: [keel, draught, top], of_other })
    }

    /// 1 - h and g(w) at v.
    fn weights(&self, v: f64) -> [f64; 2] {
        let [keel, waterline, top] = self.heights;
        let z = self.base.surface().eval(self.midship, v)[2];
        let dry = top - waterline;
        let w = if dry > SAME_KNOT * (top - keel) { ((z - waterline) / dry).clamp(0.0, 1.0) } else { 0.0 };
        [1.0 - (z - keel) / (top - keel), w.powi(3) * (2.0 - w)]
    }

    /// What keel (0) or upper edge (1) is apart at an end of the ship, 0 or 1.
    fn corner(&self, end: f64, edge: f64) -> f64 {
        self.other.surface().eval(end, edge)[2] - self.base.surface().eval(end, edge)[2]
    }

    fn along(&self, v: f64) -> Along {
        let weights = self.weights(v);
        let of = |end: f64| {
            let [x, _, z] = self.base.surface().eval(end, v);
            let height = z + weights[0] * self.corner(end, 0.0) + weights[1] * self.corner(end, 1.0);
            let ends = [0.0, 1.0].map(|edge| self.other.surface().eval(end, edge)[2]);
            let slack = SAME_KNOT * (self.heights[2] - self.heights[0]);
            // Corners correspond, whatever rounding leaves.
            let parameter = if v <= 0.0 || v >= 1.0 || ends[1] - ends[0] <= slack {
                v
            } else {
                let rounding = || ends.iter().position(|z| (z - height).abs() <= slack).map(|edge| edge as f64);
                self.other.height_parameter_at(end, height).or_else(rounding).unwrap_or(f64::NAN)
            };
            (self.other.surface().eval(end, parameter)[0] - x, parameter)
        };
        let [(aft, at_aft), (fore, at_fore)] = [of(0.0), of(1.0)];
        Along { v, weights, apart: [aft, fore], parameters: [at_aft, at_fore] }
    }

    fn across(&self, u: f64, edges: &[Along; 2]) -> Across {
        let x = self.base.surface().eval(u, self.waterline)[0];
        let part = ((x - self.ends[0]) / (self.ends[1] - self.ends[0])).clamp(0.0, 1.0);
        let fades = [fade(part), fade(1.0 - part)];
        let of = |edge: &Along| {
            let [x, _, z] = self.base.surface().eval(u, edge.v);
            let x = x + fades[0] * edge.apart[0] + fades[1] * edge.apart[1];
            let parameter = if u <= 0.0 || u >= 1.0 { u } else { self.length_on_edge(x, edge.v) };
            (self.other.surface().eval(parameter, edge.v)[2] - z, parameter)
        };
        let [(keel, at_keel), (top, at_top)] = [of(&edges[0]), of(&edges[1])];
        Across { u, fades, apart: [keel, top], parameters: [at_keel, at_top] }
    }

    /// The parameter at x on keel or upper edge of the other hull; not finite beyond its ends.
    fn length_on_edge(&self, x: f64, edge: f64) -> f64 {
        let slack = SAME_KNOT * (self.ends[1] - self.ends[0]);
        let ends = [0.0, 1.0].map(|u| self.other.surface().eval(u, edge)[0]);
        let rounding = || ends.iter().position(|end| (end - x).abs() <= slack).map(|end| end as f64);
        self.other.length_parameter(x, edge).or_else(rounding).unwrap_or(f64::NAN)
    }

    /// X - x and Z - z.
    fn moved(across: &Across, along: &Along) -> [f64; 2] {
        let sum = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        [sum(across.fades, along.apart), sum(along.weights, across.apart)]
    }

    fn edges(&self) -> [Along; 2] {
        [self.along(0.0), self.along(1.0)]
    }

    /// Knots of the other hull on the chart of the base, with their multiplicities at the common degrees.
    fn breaks(&self, degrees: [usize; 2]) -> [Vec<(f64, usize)>; 2] {
        let edges = self.edges();
        let [waterline, midship] = self.of_other;
        let (on_waterline, at_midship) = (self.along(self.waterline), self.across(self.midship, &edges));
        let length = |u: f64| {
            self.base.surface().eval(u, self.waterline)[0] + Self::moved(&self.across(u, &edges), &on_waterline)[0]
        };
        let height =
            |v: f64| self.base.surface().eval(self.midship, v)[2] + Self::moved(&at_midship, &self.along(v))[1];
        let surface = self.other.surface();
        let raised = |knots: &KnotVector, degree: usize| {
            let more = degree - knots.degree();
            inner(knots).into_iter().map(move |(t, times)| (t, times + more)).collect::<Vec<_>>()
        };
        let u = raised(surface.u(), degrees[0]);
        let v = raised(surface.v(), degrees[1]);
        [
            u.into_iter().map(|(t, times)| (root(surface.eval(t, waterline)[0], length), times)).collect(),
            v.into_iter().map(|(t, times)| (root(surface.eval(midship, t)[2], height), times)).collect(),
        ]
    }

    /// The parameters of the other hull where its chart is (X, Z).
    fn parameters(&self, across: &Across, along: &Along, [x, z]: [f64; 2]) -> Result<[f64; 2], Unlike> {
        match (across.u, along.v) {
            (_, v) if v <= 0.0 => Ok([across.parameters[0], 0.0]),
            (_, v) if v >= 1.0 => Ok([across.parameters[1], 1.0]),
            (u, _) if u <= 0.0 => Ok([0.0, along.parameters[0]]),
            (u, _) if u >= 1.0 => Ok([1.0, along.parameters[1]]),
            _ => self.other.parameters(x, z).ok_or(Unlike::Outside([x, z])),
        }
    }

    /// The other hull over the knots of `surface`, and its largest error normal to the hull \[m\].
    fn refitted(&self, surface: &BsplineSurface<3>) -> Result<(BsplineSurface<3>, f64), Unlike> {
        let edges = self.edges();
        let sites = [surface.u().greville(), surface.v().greville()];
        let alongs: Vec<Along> = sites[1].iter().map(|v| self.along(*v)).collect();
        let mut values = Vec::with_capacity(sites[0].len() * sites[1].len());
        for u in &sites[0] {
            let across = self.across(*u, &edges);
            for along in &alongs {
                let [x, _, z] = self.base.surface().eval(*u, along.v);
                let [dx, dz] = Self::moved(&across, along);
                let [a, b] = self.parameters(&across, along, [x + dx, z + dz])?;
                if !(dx.is_finite() && dz.is_finite() && a.is_finite() && b.is_finite()) {
                    return Err(Unlike::Outside([x, z]));
                }
                values.push([dx, self.other.surface().eval(a, b)[1], dz]);
            }
        }
        let knots = [surface.u().clone(), surface.v().clone()];
        let change = BsplineSurface::interpolate(knots.clone(), [&sites[0], &sites[1]], &values)?;
        let heights = self.level_heights(&change);
        let columns = change.shape()[1];
        let of = |(k, (change, own)): (usize, (&[f64; 3], &[f64; 3]))| {
            let dz = heights.as_ref().map_or(change[2], |heights| heights[k % columns]);
            [own[0] + change[0], change[1], own[2] + dz]
        };
        let net = change.points().iter().zip(surface.points()).enumerate().map(of).collect();
        let [u, v] = knots;
        let net = BsplineSurface::new(u, v, net)?;
        let error = self.error(&net, 1);
        Ok((net, error))
    }

    /// The change of heights by columns, where it is the same in every row but for rounding.
    fn level_heights(&self, change: &BsplineSurface<3>) -> Option<Vec<f64>> {
        let [rows, columns] = change.shape();
        let slack = ROUNDING * (self.heights[2] - self.heights[0]);
        let of = |j: usize| {
            let first = change.point(0, j)[2];
            let same = (0..rows).all(|i| (change.point(i, j)[2] - first).abs() <= slack);
            same.then_some(if first.abs() <= slack { 0.0 } else { first })
        };
        (0..columns).map(of).collect()
    }

    /// Largest distance of `net` from the other hull, normal to it, and of their profiles \[m\], on `parts` points of a span in each
    /// direction: the middles of its parts. Points beside the profile count with their distance from it.
    fn error(&self, net: &BsplineSurface<3>, parts: usize) -> f64 {
        let middles = |knots: &KnotVector| -> Vec<f64> {
            let part = |k: usize| (k as f64 + 0.5) / parts as f64;
            let inside = |w: &[f64]| (0..parts).map(|k| w[0] + (w[1] - w[0]) * part(k)).collect::<Vec<f64>>();
            knots.breakpoints().windows(2).flat_map(inside).collect()
        };
        let [us, vs] = [middles(net.u()), middles(net.v())];
        let mut worst: f64 = 0.0;
        for u in &us {
            for v in &vs {
                let point = net.eval(*u, *v);
                let [x, y, z] = point;
                let Some([a, b]) = self.other.parameters(x, z) else {
                    worst = worst.max(self.beside(point));
                    continue;
                };
                let at = self.other.surface().tangents(a, b);
                let normal = cross(at.du, at.dv);
                let size = dot(normal, normal).sqrt();
                let across = if size > 0.0 { (normal[1] / size).abs() } else { 1.0 };
                worst = worst.max((y - at.point[1]).abs() * across);
            }
        }
        let ends = vs.iter().flat_map(|v| [[0.0, *v], [1.0, *v]]).filter_map(|[end, v]| {
            let [x, _, z] = net.eval(end, v);
            let at = self.other.height_parameter_at(end, z)?;
            Some((self.other.surface().eval(end, at)[0] - x).abs())
        });
        let edges = us.iter().flat_map(|u| [[*u, 0.0], [*u, 1.0]]).filter_map(|[u, edge]| {
            let [x, _, z] = net.eval(u, edge);
            let at = self.other.length_parameter(x, edge)?;
            Some((self.other.surface().eval(at, edge)[2] - z).abs())
        });
        ends.chain(edges).fold(worst, f64::max)
    }

    /// How far a point outside of the profile of the other hull is from it: along its waterline, up or down, or to a corner.
    fn beside(&self, [x, y, z]: [f64; 3]) -> f64 {
        let surface = self.other.surface();
        let along = [0.0, 1.0].map(|end| Some([end, self.other.height_parameter_at(end, z)?]));
        let up = [0.0, 1.0].map(|edge| Some([self.other.length_parameter(x, edge)?, edge]));
        let corners = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]].map(Some);
        let places = along.into_iter().chain(up).chain(corners).flatten();
        let distance = |[u, v]: [f64; 2]| {
            let [a, b, c] = surface.eval(u, v);
            // Transom, bottom and deck close the other hull from its profile to the centreplane.
            (x - a).hypot((y - b).max(0.0)).hypot(z - c)
        };
        places.map(distance).fold(f64::INFINITY, f64::min)
    }
}
