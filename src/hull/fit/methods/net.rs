//! Surfaces with x a function of u and z a function of v: hat functions, least squares, and offsets as control points.

use super::super::FitError;
use super::super::method::{LeastSquares, NetKnots, Problems, QuadraticNet, SettingProblems, UniformBicubic};
use super::matrix::Matrix;
use crate::spline::{BsplineCurve, BsplineSurface, Ends, KnotVector, SplineError};

/// The net of (x_i, y_ij, z_j).
fn points(xs: &[f64], ys: &[f64], zs: &[f64]) -> Vec<[f64; 3]> {
    let columns = zs.len();
    xs.iter()
        .enumerate()
        .flat_map(|(i, &x)| zs.iter().enumerate().map(move |(j, &z)| [x, ys[i * columns + j], z]))
        .collect()
}

/// sum y_ij psi_i(x) psi_j(z); the knots are the lines themselves, and the hats over them are the basis of degree 1.
pub(super) fn bilinear(matrix: &Matrix) -> Result<BsplineSurface<3>, SplineError> {
    let knots = |lines: &[f64]| KnotVector::from_breakpoints(1, lines, &vec![1; lines.len() - 2]);
    BsplineSurface::new(knots(&matrix.xs)?, knots(&matrix.zs)?, points(&matrix.xs, &matrix.ys, &matrix.zs))
}

/// Keys of the settings of one direction.
struct Keys {
    lines: &'static str,
    order: &'static str,
    control_points: &'static str,
    knots: &'static str,
    parameters: &'static str,
}

const KEYS: [Keys; 2] = [
    Keys {
        lines: "stations",
        order: "order_along",
        control_points: "control_points_along",
        knots: "knots_along",
        parameters: "parameters_along",
    },
    Keys {
        lines: "waterlines",
        order: "order_up",
        control_points: "control_points_up",
        knots: "knots_up",
        parameters: "parameters_up",
    },
];

/// Knots and sites of one direction; none when a problem was noted.
fn direction(
    settings: &LeastSquares,
    side: usize,
    lines: &[f64],
    problems: &mut Problems,
) -> Option<(KnotVector, Vec<f64>)> {
    let keys = &KEYS[side];
    let degree = problems.degree(keys.order, settings.orders[side]);
    let knots = settings.knots[side].as_deref();
    let chosen = (3 * lines.len()).div_ceil(4).clamp(degree + 1, lines.len().max(degree + 1));
    // Too few knots are a problem of the knots, not of the number of control points.
    let from_knots = knots.map(|knots| knots.len().saturating_sub(degree + 1).max(degree + 1));
    let count = settings.control_points[side].or(from_knots).unwrap_or(chosen);
    if count < degree + 1 || count > lines.len() {
        let message = format!("{count} control points of order {} for {} {}", degree + 1, lines.len(), keys.lines);
        let help = format!("Expected {} to {}.", degree + 1, lines.len());
        problems.add(keys.control_points, message, help);
        return None;
    }
    let given = settings.parameters[side].as_deref();
    if let Some(parameters) = given
        && parameters.len() != lines.len()
    {
        let message = format!("{} parameters for {} {}", parameters.len(), lines.len(), keys.lines);
        problems.add(keys.parameters, message, "Give one for each line of the table.");
        return None;
    }
    let need = format!("{count} control points of order {} need {}.", degree + 1, count + degree + 1);
    if let Some(knots) = knots
        && knots.len() < count + degree + 1
    {
        problems.add(keys.knots, format!("{} knots", knots.len()), need);
        return None;
    }
    let vector = match knots {
        Some(knots) => KnotVector::from_unclamped(degree, knots, count),
        None => KnotVector::for_least_squares(degree, given.unwrap_or(lines), count),
    };
    let vector = match vector {
        Ok(vector) => vector,
        Err(error) => {
            let key = if knots.is_some() { keys.knots } else { keys.parameters };
            problems.add(key, error.to_string(), need);
            return None;
        }
    };
    let (a, b) = vector.domain();
    let sites: Vec<f64> = match given {
        Some(parameters) => parameters.to_vec(),
        None => {
            let (first, last) = (lines[0], lines[lines.len() - 1]);
            lines.iter().map(|line| (a + (b - a) * (line - first) / (last - first)).min(b)).collect()
        }
    };
    if let Some(outside) = sites.iter().find(|t| !(a..=b).contains(*t)) {
        let message = format!("{outside} is outside the knots");
        problems.add(keys.parameters, message, format!("The functions make a full basis from {a} to {b}."));
        return None;
    }
    Some((vector, sites))
}

/// Least squares in y; x(u) and z(v) by least squares too, exactly linear where the parameters are.
pub(super) fn least_squares(matrix: &Matrix, settings: &LeastSquares) -> Result<BsplineSurface<3>, FitError> {
    let mut problems = Problems::default();
    let along = direction(settings, 0, &matrix.xs, &mut problems);
    let up = direction(settings, 1, &matrix.zs, &mut problems);
    problems.done()?;
    let (Some((u, us)), Some((v, vs))) = (along, up) else { return Err(SettingProblems(Vec::new()).into()) };
    let mut problems = Problems::default();
    let mut line = |side: usize, knots: &KnotVector, sites: &[f64], lines: &[f64]| -> Vec<f64> {
        let data: Vec<[f64; 1]> = lines.iter().map(|&l| [l]).collect();
        match BsplineCurve::fit(knots.clone(), sites, &data, Ends::Free) {
            Ok(curve) => curve.points().as_flattened().to_vec(),
            Err(error) => {
                let help = "Every control point needs a line of the table in the support of its function.";
                problems.add(KEYS[side].parameters, error.to_string(), help);
                Vec::new()
            }
        }
    };
    let (xs, zs) = (line(0, &u, &us, &matrix.xs), line(1, &v, &vs, &matrix.zs));
    problems.done()?;
    let data: Vec<[f64; 1]> = matrix.ys.iter().map(|&y| [y]).collect();
    let ys = BsplineSurface::fit([u.clone(), v.clone()], [&us, &vs], &data, Ends::Free)?;
    Ok(BsplineSurface::new(u, v, points(&xs, ys.points().as_flattened(), &zs))?)
}

/// The offsets as vertices, the ends and the knuckles three times.
pub(super) fn uniform_bicubic(matrix: &Matrix, settings: &UniformBicubic) -> Result<BsplineSurface<3>, FitError> {
    let mut problems = Problems::default();
    let rows = problems.lines("knuckle_stations", &settings.knuckle_stations, &matrix.xs);
    let columns = problems.lines("knuckle_waterlines", &settings.knuckle_waterlines, &matrix.zs);
    problems.done()?;
    let vertices = points(&matrix.xs, &matrix.ys, &matrix.zs);
    let surface = BsplineSurface::from_vertices(3, matrix.zs.len(), &vertices, [&rows, &columns]);
    Ok(surface?)
}

/// Quadratic knots over the lines, with a double knot where one part ends and the next begins.
fn quadratic_knots(rule: NetKnots, lines: &[f64], splits: &[usize]) -> Result<KnotVector, SplineError> {
    let mut breakpoints = vec![0.0];
    let mut multiplicities = Vec::new();
    let mut from = 0;
    for to in splits.iter().copied().chain([lines.len() - 1]) {
        let part = &lines[from..=to];
        let inner = match rule {
            NetKnots::OpenUniform => KnotVector::uniform(2, part.len() - 2)?,
            NetKnots::Midpoints => KnotVector::between_sites(2, part)?,
        };
        let (a, start) = (inner.domain().0, breakpoints[breakpoints.len() - 1]);
        // Equal spans are one long each, whatever the part.
        let scale = if rule == NetKnots::OpenUniform { (part.len() - 2) as f64 } else { 1.0 };
        let steps = inner.breakpoints();
        breakpoints.extend(steps[1..].iter().map(|t| start + scale * (t - a)));
        multiplicities.extend(std::iter::repeat_n(1, steps.len() - 2));
        multiplicities.push(2);
        from = to;
    }
    multiplicities.pop();
    KnotVector::from_breakpoints(2, &breakpoints, &multiplicities)
}

/// The offsets as control points of a quadratic surface.
pub(super) fn quadratic_net(matrix: &Matrix, settings: &QuadraticNet) -> Result<BsplineSurface<3>, FitError> {
    let mut problems = Problems::default();
    let splits = problems.lines("split_stations", &settings.split_stations, &matrix.xs);
    let ends = [0].into_iter().chain(splits.iter().copied()).chain([matrix.xs.len() - 1]);
    let ends: Vec<usize> = ends.collect();
    if let Some(short) = ends.windows(2).find(|w| w[1] < w[0] + 2) {
        let message =
            format!("{} stations from {} m to {} m", short[1] - short[0] + 1, matrix.xs[short[0]], matrix.xs[short[1]]);
        problems.add("split_stations", message, "Each part needs three, its ends counted.");
    }
    problems.done()?;
    let u = quadratic_knots(settings.knots, &matrix.xs, &splits)?;
    let v = quadratic_knots(settings.knots, &matrix.zs, &[])?;
    Ok(BsplineSurface::new(u, v, points(&matrix.xs, &matrix.ys, &matrix.zs))?)
}
