//! Points, curves and surfaces of STEP (ISO 10303-42).

use std::collections::BTreeMap;

use super::super::super::fault::Faults;
use super::super::surfaces::{MOST_POINTS, spline_curve, surface};
use super::read::{Instance, Value, numbers, whole};
use crate::hull::{Conic, FaceSurface, SpaceCurve, frame};
use crate::spline::{BsplineSurface, HIGHEST_DEGREE};

/// Curves of curves, and surfaces of surfaces, at most.
const DEEPEST: usize = 8;

/// The instances of a file with what reading their geometry needs.
pub(super) struct Geometry<'a> {
    pub(super) instances: &'a BTreeMap<u64, Instance>,
    pub(super) faults: &'a mut Faults,
    /// Radians in the unit of plane angles.
    pub(super) radian: f64,
    /// Control points so far.
    pub(super) points: usize,
}

/// An axis placement: its origin, and x, y and z.
pub(super) type Frame = ([f64; 3], [[f64; 3]; 3]);

fn scaled(vector: [f64; 3], by: f64) -> [f64; 3] {
    vector.map(|c| by * c)
}

/// A number, typed or not.
fn real(value: &Value) -> Option<f64> {
    match value {
        Value::Number(number) => Some(*number),
        Value::Typed(list) => list.first().and_then(real),
        _ => None,
    }
}

/// Whether a value is `.T.`.
pub(super) fn is_true(value: &Value) -> bool {
    matches!(value, Value::Word(word) if word == ".T." || word == ".TRUE.")
}

/// Knots with their multiplicities as one sequence.
fn knots(multiplicities: &Value, values: &Value) -> Option<Vec<f64>> {
    let (times, values) = (numbers(multiplicities)?, numbers(values)?);
    let fits = times.len() == values.len() && times.iter().all(|&t| (1.0..=HIGHEST_DEGREE as f64 + 1.0).contains(&t));
    fits.then(|| times.iter().zip(&values).flat_map(|(&t, &value)| std::iter::repeat_n(value, t as usize)).collect())
}

/// The keyword of a spline of any form, the parameters that all forms have, and its own. Alone an instance has a name before
/// the `count` parameters of all; among others it has its own only.
fn spline_parts<'a>(
    instance: &'a Instance,
    keywords: [&'static str; 4],
    (common, count): (&str, usize),
) -> Option<(&'static str, &'a [Value], &'a [Value])> {
    let (keyword, own) = keywords.into_iter().find_map(|keyword| Some((keyword, instance.part(keyword)?)))?;
    match instance.part(common) {
        Some(form) => Some((keyword, form, own)),
        None => Some((keyword, own.get(1..=count)?, own.get(1 + count..)?)),
    }
}

/// Knots that a keyword stands for: of a spline of Bezier pieces, uniform ones, and uniform ones with clamped ends.
fn implied(keyword: &str, degree: usize, count: usize) -> Option<Vec<f64>> {
    if keyword.starts_with("UNIFORM") {
        return Some((0..count + degree + 1).map(|k| k as f64 - degree as f64).collect());
    }
    let (spans, times) = match keyword {
        _ if keyword.starts_with("QUASI_UNIFORM") => (count.checked_sub(degree)?, 1),
        _ => ((count.checked_sub(1)?).checked_div(degree)?, degree),
    };
    let inner = (1..spans).flat_map(|k| std::iter::repeat_n(k as f64, times));
    let ends = |at: f64| std::iter::repeat_n(at, degree + 1);
    Some(ends(0.0).chain(inner).chain(ends(spans as f64)).collect())
}

impl Geometry<'_> {
    /// The instance that a value refers to.
    pub(super) fn get(&self, value: &Value) -> Option<&Instance> {
        match value {
            Value::Reference(number) => self.instances.get(number),
            _ => None,
        }
    }

    /// The parameters of a keyword of the instance that a value refers to.
    pub(super) fn part(&self, value: &Value, keyword: &str) -> Option<&[Value]> {
        self.get(value)?.part(keyword)
    }

    pub(super) fn point(&self, value: &Value) -> Option<[f64; 3]> {
        let [_, coordinates, ..] = self.part(value, "CARTESIAN_POINT")? else { return None };
        let [x, y, z] = numbers(coordinates)?[..] else { return None };
        Some([x, y, z])
    }

    fn direction(&self, value: &Value) -> Option<[f64; 3]> {
        let [_, ratios, ..] = self.part(value, "DIRECTION")? else { return None };
        let [x, y, z] = numbers(ratios)?[..] else { return None };
        Some([x, y, z])
    }

    fn vector(&self, value: &Value) -> Option<[f64; 3]> {
        let [_, along, size, ..] = self.part(value, "VECTOR")? else { return None };
        let [_, _, unit] = frame(self.direction(along)?, None);
        Some(scaled(unit, real(size)?))
    }

    /// An axis placement; what it leaves out is z, and x across it.
    pub(super) fn placement(&self, value: &Value) -> Option<Frame> {
        let [_, origin, axis, reference, ..] = self.part(value, "AXIS2_PLACEMENT_3D")? else { return None };
        let z = self.direction(axis).unwrap_or([0.0, 0.0, 1.0]);
        Some((self.point(origin)?, frame(z, self.direction(reference).or(Some([1.0, 0.0, 0.0])))))
    }

    fn axis(&self, value: &Value) -> Option<([f64; 3], [f64; 3])> {
        let [_, origin, axis, ..] = self.part(value, "AXIS1_PLACEMENT")? else { return None };
        let [_, _, z] = frame(self.direction(axis).unwrap_or([0.0, 0.0, 1.0]), None);
        Some((self.point(origin)?, z))
    }

    fn counted(&mut self, line: usize, name: &str, more: usize) -> Option<()> {
        self.points = self.points.saturating_add(more);
        if self.points > MOST_POINTS {
            self.faults.add(Some(line), name, format!("more than {MOST_POINTS} control points"));
            return None;
        }
        Some(())
    }

    /// A curve in space.
    pub(super) fn curve(&mut self, value: &Value, depth: usize) -> Option<SpaceCurve> {
        let Value::Reference(number) = value else { return None };
        let instances = self.instances;
        let instance = instances.get(number)?;
        let name = format!("#{number}");
        for keyword in ["SURFACE_CURVE", "SEAM_CURVE", "INTERSECTION_CURVE"] {
            if let Some([_, curve, ..]) = instance.part(keyword) {
                return if depth < DEEPEST { self.curve(curve, depth + 1) } else { None };
            }
        }
        if let Some([_, basis, _, _, sense, ..]) = instance.part("TRIMMED_CURVE") {
            let basis = if depth < DEEPEST { self.curve(basis, depth + 1) } else { None }?;
            return Some(if is_true(sense) { basis } else { basis.reversed() });
        }
        if let Some([_, origin, along, ..]) = instance.part("LINE") {
            return Some(SpaceCurve::Line { origin: self.point(origin)?, along: self.vector(along)? });
        }
        if let Some(conic) = self.conic(instance) {
            return Some(conic);
        }
        if let Some([_, Value::List(list), ..]) = instance.part("POLYLINE") {
            let points: Option<Vec<[f64; 3]>> = list.iter().map(|point| self.point(point)).collect();
            return SpaceCurve::polyline(&points?);
        }
        let keywords = ["B_SPLINE_CURVE_WITH_KNOTS", "BEZIER_CURVE", "UNIFORM_CURVE", "QUASI_UNIFORM_CURVE"];
        let (keyword, form, own) = spline_parts(instance, keywords, ("B_SPLINE_CURVE", 5))?;
        let [degree, Value::List(list), ..] = form else { return None };
        let degree = whole(degree, 100)?;
        self.counted(instance.line, &name, list.len())?;
        let net: Vec<[f64; 3]> = list.iter().map(|point| self.point(point)).collect::<Option<_>>()?;
        let weights = match instance.part("RATIONAL_B_SPLINE_CURVE") {
            Some([weights, ..]) => numbers(weights)?,
            _ => vec![1.0; net.len()],
        };
        let knots = match own {
            [times, values, ..] => knots(times, values)?,
            _ => implied(keyword, degree, net.len())?,
        };
        if weights.len() != net.len() {
            return None;
        }
        let found = spline_curve(self.faults, instance.line, &name, degree, knots, weights.into_iter().zip(net))?;
        Some(SpaceCurve::Spline(found))
    }

    fn conic(&self, instance: &Instance) -> Option<SpaceCurve> {
        let with = |kind: Conic, placement: &Value, a: f64, b: f64| {
            let (centre, [x, y, _]) = self.placement(placement)?;
            Some(SpaceCurve::Conic { kind, centre, x: scaled(x, a), y: scaled(y, b) })
        };
        if let Some([_, placement, radius, ..]) = instance.part("CIRCLE") {
            return with(Conic::Ellipse, placement, real(radius)?, real(radius)?);
        }
        if let Some([_, placement, a, b, ..]) = instance.part("ELLIPSE") {
            return with(Conic::Ellipse, placement, real(a)?, real(b)?);
        }
        if let Some([_, placement, a, b, ..]) = instance.part("HYPERBOLA") {
            return with(Conic::Hyperbola, placement, real(a)?, real(b)?);
        }
        if let Some([_, placement, focus, ..]) = instance.part("PARABOLA") {
            return with(Conic::Parabola, placement, real(focus)?, 2.0 * real(focus)?);
        }
        None
    }

    /// A surface; none where its kind is not read, or it refers to what is not there.
    pub(super) fn surface(&mut self, value: &Value, depth: usize) -> Option<FaceSurface> {
        let Value::Reference(number) = value else { return None };
        let instances = self.instances;
        let instance = instances.get(number)?;
        if depth > DEEPEST {
            return None;
        }
        if let Some([_, placement, ..]) = instance.part("PLANE") {
            let (origin, [x, y, _]) = self.placement(placement)?;
            return Some(FaceSurface::Plane { origin, x, y });
        }
        if let Some(elementary) = self.elementary(instance) {
            return Some(elementary);
        }
        if let Some([_, profile, axis, ..]) = instance.part("SURFACE_OF_REVOLUTION") {
            let (origin, axis) = self.axis(axis)?;
            return Some(FaceSurface::Revolved { origin, axis, profile: self.curve(profile, 0)? });
        }
        if let Some([_, profile, along, ..]) = instance.part("SURFACE_OF_LINEAR_EXTRUSION") {
            return Some(FaceSurface::Extruded { profile: self.curve(profile, 0)?, along: self.vector(along)? });
        }
        if let Some([_, basis, ..]) = instance.part("RECTANGULAR_TRIMMED_SURFACE") {
            return self.surface(basis, depth + 1);
        }
        if let Some([_, basis, distance, ..]) = instance.part("OFFSET_SURFACE") {
            let (distance, base) = (real(distance)?, self.surface(basis, depth + 1)?);
            return Some(FaceSurface::Offset { base: Box::new(base), distance });
        }
        self.spline_surface(*number).map(FaceSurface::Spline)
    }

    /// Surfaces that a line or a circle makes about an axis.
    fn elementary(&self, instance: &Instance) -> Option<FaceSurface> {
        let about = |placement: &Value, profile: &dyn Fn([f64; 3], [f64; 3], [f64; 3]) -> SpaceCurve| {
            let (origin, [x, _, z]) = self.placement(placement)?;
            Some(FaceSurface::Revolved { origin, axis: z, profile: profile(origin, x, z) })
        };
        if let Some([_, placement, radius, ..]) = instance.part("CYLINDRICAL_SURFACE") {
            let radius = real(radius)?;
            return about(placement, &|origin, x, z| SpaceCurve::beside(origin, x, radius, z));
        }
        if let Some([_, placement, radius, angle, ..]) = instance.part("CONICAL_SURFACE") {
            let (radius, slope) = (real(radius)?, (self.radian * real(angle)?).tan());
            return about(placement, &|origin, x, z| {
                SpaceCurve::beside(origin, x, radius, [0, 1, 2].map(|k| slope * x[k] + z[k]))
            });
        }
        if let Some([_, placement, radius, ..]) = instance.part("SPHERICAL_SURFACE") {
            let radius = real(radius)?;
            return about(placement, &|origin, x, z| SpaceCurve::circle(origin, x, z, radius));
        }
        for keyword in ["TOROIDAL_SURFACE", "DEGENERATE_TOROIDAL_SURFACE"] {
            if let Some([_, placement, major, minor, ..]) = instance.part(keyword) {
                let (major, minor) = (real(major)?, real(minor)?);
                return about(placement, &|origin, x, z| {
                    SpaceCurve::circle([0, 1, 2].map(|k| origin[k] + major * x[k]), x, z, minor)
                });
            }
        }
        None
    }

    /// A B-spline surface of any form.
    pub(super) fn spline_surface(&mut self, number: u64) -> Option<BsplineSurface<4>> {
        let instances = self.instances;
        let instance = instances.get(&number)?;
        let name = format!("#{number}");
        let keywords = ["B_SPLINE_SURFACE_WITH_KNOTS", "BEZIER_SURFACE", "UNIFORM_SURFACE", "QUASI_UNIFORM_SURFACE"];
        let (keyword, form, own) = spline_parts(instance, keywords, ("B_SPLINE_SURFACE", 7))?;
        let [u_degree, v_degree, Value::List(rows), ..] = form else { return None };
        let degrees = [whole(u_degree, 100)?, whole(v_degree, 100)?];
        let mut net = Vec::new();
        for row in rows {
            let Value::List(row) = row else { return None };
            self.counted(instance.line, &name, row.len())?;
            for value in row {
                net.push(self.point(value)?);
            }
        }
        let weights = match instance.part("RATIONAL_B_SPLINE_SURFACE") {
            Some([Value::List(rows), ..]) => {
                rows.iter().map(numbers).collect::<Option<Vec<_>>>()?.into_iter().flatten().collect()
            }
            _ => vec![1.0; net.len()],
        };
        if weights.len() != net.len() {
            return None;
        }
        let knots = match own {
            [u_times, v_times, u_knots, v_knots, ..] => [knots(u_times, u_knots)?, knots(v_times, v_knots)?],
            _ => {
                let columns = net.len() / rows.len().max(1);
                [implied(keyword, degrees[0], rows.len())?, implied(keyword, degrees[1], columns)?]
            }
        };
        surface(self.faults, Some(instance.line), &name, degrees, knots, weights.into_iter().zip(net))
    }
}
