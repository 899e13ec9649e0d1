//! From the analytic hull to its net, and the last linear correction that makes the coefficients exact.
//!
//! v runs along the girth of the midship section (floor, bilge, side), so that y is smooth in v where dy/dz is
//! infinite; the tangent lines of the bilge are double knots, the height of the transom tip is a triple one (corner of
//! the stern profile), the design waterline a simple one. x(u, v) = linear + (stern profile) (1 - u/ua)^3 + (stem
//! profile) ((u - uf)/(1 - uf))^3, cut off at the shoulders ua and uf: it lies in the spline space, is C2 and x_u > 0.
//! Along the parallel body the columns of the net are those of the midship section exactly; without one, a double knot
//! holds value and slope at the largest section.

use super::form::Form;
use crate::hull::{Functional, Hull, HullError, PrincipalParticulars};
use crate::parametric::loft;
use crate::spline::{BsplineCurve, Collocation, Condition, KnotVector, SplineError};

/// Rise of the deck at side above D at FP and at AP \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sheer {
    pub(super) fore: f64,
    pub(super) aft: f64,
}

/// Coefficients that the finished hull shall have, as integrals \[m^2, m^3, m^4\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Exact {
    pub(super) volume: f64,
    pub(super) volume_moment: f64,
    /// Position and area of the section that the midship coefficient is held at.
    pub(super) section: (f64, f64),
    pub(super) waterplane: f64,
}

const END_SPANS: usize = 14;
const BODY_SPANS: usize = 3;

/// The deck at side and the top of the surface.
fn deck(form: &Form, sheer: &Sheer) -> Result<(BsplineCurve<2>, f64), SplineError> {
    let middle = 0.5 * form.length;
    let height = |x: f64| {
        let s = (x - middle) / middle;
        form.depth + if s > 0.0 { sheer.fore } else { sheer.aft } * s * s
    };
    // The deck ends where it meets the profiles: a contraction, because the profiles are steep.
    let (mut aft, mut fore) = (form.stern.at(form.depth), form.stem.at(form.depth));
    for _ in 0..60 {
        (aft, fore) = (form.stern.at(height(aft)), form.stem.at(height(fore)));
    }
    let top = height(aft).max(height(fore)).max(form.depth);
    let line = |a: f64, b: f64, t: f64| a + (b - a) * t;
    // Parabolas as quadratic pieces: middle control points on both tangents.
    let points = vec![
        [aft, height(aft)],
        [line(aft, middle, 0.5), form.depth],
        [middle, form.depth],
        [line(middle, fore, 0.5), form.depth],
        [fore, height(fore)],
    ];
    let knots = KnotVector::from_breakpoints(2, &[0.0, 0.5, 1.0], &[2])?;
    Ok((BsplineCurve::new(knots, points)?, top))
}

/// Knots in v: girths of the midship section.
fn girth_knots(form: &Form, top: f64) -> Result<KnotVector, SplineError> {
    let section = &form.section;
    let (floor, bilge) = section.girths();
    let total = section.girth_at(top);
    let mut lines: Vec<(f64, usize)> = vec![(0.0, 4), (section.girth_at(form.draught), 1), (total, 4)];
    if bilge < 1e-6 * total {
        // A hard chine.
        lines.push((floor, 3));
    } else {
        lines.extend([(floor, 2), (floor + bilge, 2)]);
    }
    if form.stern.transom && form.stern.height < top {
        lines.push((section.girth_at(form.stern.height), 3));
    }
    lines.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut merged: Vec<(f64, usize)> = Vec::new();
    for (at, times) in lines {
        match merged.last_mut() {
            Some(last) if at - last.0 < 1e-6 * total => last.1 = last.1.max(times),
            _ => merged.push((at, times)),
        }
    }
    if let Some(last) = merged.last_mut() {
        last.0 = total;
    }
    let mut breaks = vec![0.0];
    let mut times = Vec::new();
    for pair in merged.windows(2) {
        let (a, b) = (pair[0].0, pair[1].0);
        let in_bilge = a >= floor - 1e-9 * total && b <= floor + bilge + 1e-9 * total;
        let longest = if in_bilge { bilge / 4.0 } else { total / 9.0 };
        let parts = ((b - a) / longest - 1e-9).ceil().max(1.0) as usize;
        for k in 1..=parts {
            breaks.push(a + (b - a) * k as f64 / parts as f64);
            times.push(if k == parts { pair[1].1 } else { 1 });
        }
    }
    times.pop();
    let scale = breaks[breaks.len() - 1];
    let breaks: Vec<f64> = breaks.iter().map(|g| g / scale).collect();
    KnotVector::from_breakpoints(3, &breaks, &times)
}

/// What the net meets in v: a value, or, on the tangent lines of the bilge, the value and the slope there, so that flat
/// floors and flat sides are flat. The slope is the one-sided five-point difference from the flat (error 1e-11).
struct Level {
    condition: Condition,
    /// The girth of a value, or the five girths of a difference.
    girths: [f64; 5],
    /// Weights of the functions at these girths.
    weights: [f64; 5],
}

impl Level {
    /// The girths at which functions are asked for.
    fn girths(&self) -> &[f64] {
        if self.condition.order == 0 { &self.girths[..1] } else { &self.girths }
    }

    fn combine(&self, at: impl Fn(usize) -> f64) -> f64 {
        if self.condition.order == 0 {
            return at(0);
        }
        // Differences to the first value: a constant has slope 0 exactly.
        let first = at(0);
        (1..5).map(|k| self.weights[k] * (at(k) - first)).sum()
    }

    fn data(&self, value: impl Fn(f64) -> f64) -> f64 {
        self.combine(|k| value(self.girths[k]))
    }
}

/// The conditions in v, one a basis function.
fn levels(form: &Form, v: &KnotVector, girth: f64) -> Vec<Level> {
    let value = |site: f64| Level {
        condition: Condition { site, order: 0 },
        girths: [site * girth; 5],
        weights: [1.0, 0.0, 0.0, 0.0, 0.0],
    };
    let mut levels: Vec<Level> = loft::sites(v).into_iter().map(value).collect();
    let (floor, bilge) = form.section.girths();
    for (line, direction) in [(floor, -1.0), (floor + bilge, 1.0)] {
        let knots = v.knots();
        let Some(first) = knots.iter().position(|t| (t * girth - line).abs() < 1e-9 * girth) else { continue };
        let times = knots[first..].iter().take_while(|&&t| t <= knots[first]).count();
        if times != 2 {
            continue;
        }
        // The two basis functions whose sites straddle a double knot.
        let site = knots[first];
        let Some(above) = levels.iter().position(|level| level.condition.site > site) else { continue };
        let step = 1e-3 * direction * if direction < 0.0 { floor } else { girth - line };
        let mut slope = value(site);
        slope.condition.order = 1;
        slope.girths = [0.0, 1.0, 2.0, 3.0, 4.0].map(|k| line + k * step);
        slope.weights = [-25.0, 48.0, -36.0, 16.0, -3.0].map(|w| w * girth / (12.0 * step));
        levels[above - 1] = value(site);
        levels[above] = slope;
    }
    levels
}

/// The hull through the analytic form, before the correction.
pub(super) fn interpolate(
    name: &str,
    form: &Form,
    particulars: PrincipalParticulars,
    sheer: &Sheer,
) -> Result<Hull, HullError> {
    let (deck, top) = deck(form, sheer)?;
    let v = girth_knots(form, top)?;
    let girth = form.section.girth_at(top);
    let levels = levels(form, &v, girth);
    let mut in_v: Vec<Condition> = levels.iter().map(|level| level.condition).collect();
    let across = Collocation::with_conditions(&v, &in_v)?;
    let data = |value: &dyn Fn(f64) -> f64| -> Vec<f64> {
        levels.iter().map(|level| level.data(|g| value(form.section.at_girth(g).1))).collect()
    };
    let net = |value: &dyn Fn(f64) -> f64| {
        let mut values = data(value);
        across.solve(&mut values);
        values
    };
    let mut z = data(&|z| z);
    if form.section.deadrise > 0.0 {
        across.solve(&mut z);
    } else {
        // The bilge leaves the flat of bottom with dz/dv = 0.
        in_v[1] = Condition { site: 0.0, order: 1 };
        z[1] = 0.0;
        Collocation::with_conditions(&v, &in_v)?.solve(&mut z);
        z[1] = 0.0;
    }
    (z[0], z[v.basis_count() - 1]) = (0.0, top);

    // Lengths: the shortest waterline rules the linear part.
    let (aft, fore) = (form.stern.at(0.0), form.stem.at(0.0));
    let parameter = |x: f64| (x - aft) / (fore - aft);
    let (ua, uf) = (parameter(form.aft_shoulder), parameter(form.fore_shoulder));
    let parallel = form.fore_shoulder > form.aft_shoulder;
    let graded = |k: usize| 1.0 - (1.0 - k as f64 / END_SPANS as f64).powf(1.3);
    let mut breaks: Vec<f64> = (0..=END_SPANS).rev().map(|k| ua * (1.0 - graded(k))).collect();
    breaks[0] = 0.0;
    if parallel {
        breaks.extend((1..=BODY_SPANS).map(|k| ua + (uf - ua) * k as f64 / BODY_SPANS as f64));
    }
    breaks.extend((1..=END_SPANS).map(|k| if k == END_SPANS { 1.0 } else { uf + (1.0 - uf) * graded(k) }));
    let mut times = vec![1; breaks.len() - 2];
    if !parallel {
        times[END_SPANS - 1] = 2;
    }
    let u = KnotVector::from_breakpoints(3, &breaks, &times)?;
    let cube = |t: f64| t.max(0.0).powi(3);
    let run = |t: f64| cube(1.0 - t / ua);
    let entrance = |t: f64| cube((t - uf) / (1.0 - uf));

    // Conditions in u: the sites; across a parallel body, value, slope and curvature at both shoulders.
    let mut conditions: Vec<Condition> = loft::sites(&u).into_iter().map(|site| Condition { site, order: 0 }).collect();
    if parallel {
        for order in 0..3 {
            conditions[END_SPANS + order] = Condition { site: ua, order };
            conditions[END_SPANS + BODY_SPANS + order] = Condition { site: uf, order };
        }
    } else {
        // Value and slope at the largest section, where the curvatures of both ends agree by the choice of the kernels.
        for order in 0..2 {
            conditions[END_SPANS + 1 + order] = Condition { site: ua, order };
        }
    }
    let along = Collocation::with_conditions(&u, &conditions)?;
    let (run_net, entrance_net, line) = (loft::interpolate(&u, run)?, loft::interpolate(&u, entrance)?, u.greville());
    let (stern_net, stem_net) = (net(&|z| form.stern.at(z) - aft), net(&|z| form.stem.at(z) - fore));
    let (rows, columns) = (u.basis_count(), v.basis_count());
    let mut x = vec![0.0; rows * columns];
    for i in 0..rows {
        for j in 0..columns {
            x[i * columns + j] =
                aft + (fore - aft) * line[i] + stern_net[j] * run_net[i] + stem_net[j] * entrance_net[i];
        }
    }
    let mut y = vec![0.0; rows * columns];
    for (j, level) in levels.iter().enumerate() {
        let waterlines: Vec<_> = level
            .girths()
            .iter()
            .map(|&g| {
                let (_, z) = form.section.at_girth(g);
                (form.stern.at(z) - aft, form.stem.at(z) - fore, form.waterline(z))
            })
            .collect();
        for (i, condition) in conditions.iter().enumerate() {
            let t = condition.site;
            let at = |k: usize| {
                let (stern, stem, waterline) = &waterlines[k];
                let x = aft + (fore - aft) * t + stern * run(t) + stem * entrance(t);
                waterline.half_breadth(x)
            };
            y[i * columns + j] = if condition.order > 0 { 0.0 } else { level.combine(at) };
        }
    }
    along.solve_tensor(&across, &mut y);
    let breadth = form.section.half_breadth;
    for (k, value) in y.iter_mut().enumerate() {
        // Stem and profile lie on the centreplane, the side on B/2: rounding is cleared.
        if value.abs() < 1e-11 * breadth || k / columns == rows - 1 {
            *value = 0.0;
        } else if (*value - breadth).abs() < 1e-11 * breadth {
            *value = breadth;
        }
    }
    Hull::new(name, particulars, loft::surface(&u, &v, &x, &y, &z)?, deck)
}

/// Moves the net by the smallest combination of four smooth fields (fullness of the section, of both ends, their balance,
/// and the height of the ends) that makes the integrals exact. The remaining error is rounding.
pub(super) fn correct(hull: &Hull, form: &Form, exact: &Exact) -> Result<Hull, HullError> {
    let mut hull = hull.clone();
    for _ in 0..2 {
        let t = form.draught;
        let rows = [
            Functional::Volume.row(&hull, t),
            Functional::LongitudinalMoment.row(&hull, t),
            Functional::SectionArea { x: exact.section.0 }.row(&hull, t),
            Functional::WaterplaneArea.row(&hull, t),
        ];
        let wanted = [exact.volume, exact.volume_moment, exact.section.1, exact.waterplane];
        let [_, columns] = hull.surface().shape();
        let points = hull.surface().points();
        let largest: Vec<f64> =
            (0..columns).map(|j| points.iter().skip(j).step_by(columns).map(|p| p[1]).fold(0.0, f64::max)).collect();
        let half = form.section.half_breadth;
        let fields: Vec<[f64; 4]> = points
            .iter()
            .enumerate()
            .map(|(k, &[x, y, z])| {
                let b = largest[k % columns];
                let ends = if b > 0.0 { y * (1.0 - y / b) } else { 0.0 };
                let balance = (x - 0.5 * (form.aft_shoulder + form.fore_shoulder)) / form.length;
                [y * (1.0 - b / half).max(0.0), ends, ends * balance, ends * z / t]
            })
            .collect();
        let mut matrix = nalgebra::Matrix4::zeros();
        let mut error = nalgebra::Vector4::zeros();
        for (r, row) in rows.iter().enumerate() {
            error[r] = wanted[r] - row.iter().zip(points).map(|(a, p)| a * p[1]).sum::<f64>();
            for (a, field) in row.iter().zip(&fields) {
                for c in 0..4 {
                    matrix[(r, c)] += a * field[c];
                }
            }
        }
        let Some(parts) = matrix.lu().solve(&error) else { return Ok(hull) };
        let (mut x, mut y) = (Vec::with_capacity(points.len()), Vec::with_capacity(points.len()));
        for (point, field) in points.iter().zip(&fields) {
            x.push(point[0]);
            y.push(point[1] + (0..4).map(|c| parts[c] * field[c]).sum::<f64>());
        }
        let z: Vec<f64> = points[..columns].iter().map(|p| p[2]).collect();
        let surface = loft::surface(hull.surface().u(), hull.surface().v(), &x, &y, &z)?;
        hull = Hull::new(hull.name(), *hull.particulars(), surface, hull.deck().clone())?;
    }
    Ok(hull)
}
