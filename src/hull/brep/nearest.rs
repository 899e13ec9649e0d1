//! The nearest point of a curve, and of a surface, by the method of Gauss and Newton with a bound on its steps.

use crate::spline::dot;

/// A parameter and how far its point is from the wanted one.
#[derive(Debug, Clone, Copy)]
pub struct Nearest {
    /// The parameter.
    pub parameter: f64,
    /// The distance \[m\].
    pub distance: f64,
}

/// Points of a span that are tried first.
const TRIED: usize = 6;

/// Steps of a search.
const STEPS: usize = 60;

fn distance<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    a.iter().zip(&b).map(|(x, y)| (x - y) * (x - y)).sum::<f64>().sqrt()
}

/// The nearest point to `target` of a curve of points and derivatives over `breaks`, by the two best of a few points of
/// each span.
pub(super) fn nearest<const N: usize>(
    curve: impl Fn(f64) -> [[f64; N]; 2],
    breaks: &[f64],
    periodic: bool,
    target: [f64; N],
) -> Nearest {
    let (low, high) = (breaks[0].min(breaks[breaks.len() - 1]), breaks[0].max(breaks[breaks.len() - 1]));
    let mut starts: Vec<(f64, f64, f64)> = breaks
        .windows(2)
        .flat_map(|w| (0..=TRIED).map(move |k| (w[0] + (w[1] - w[0]) * k as f64 / TRIED as f64, (w[1] - w[0]).abs())))
        .map(|(t, width)| (distance(curve(t)[0], target), t, width / TRIED as f64))
        .collect();
    starts.sort_by(|a, b| a.0.total_cmp(&b.0));
    // The next best one may stand beside another minimum.
    let first = starts[0];
    let second = starts.iter().find(|s| (s.1 - first.1).abs() > 2.5 * first.2).copied();
    let mut best = Nearest { parameter: first.1, distance: first.0 };
    for (_, start, width) in std::iter::once(first).chain(second) {
        let found = refined(&curve, start, width, if periodic { None } else { Some([low, high]) }, target);
        if found.distance < best.distance {
            best = found;
        }
    }
    best
}

fn refined<const N: usize>(
    curve: &impl Fn(f64) -> [[f64; N]; 2],
    start: f64,
    width: f64,
    ends: Option<[f64; 2]>,
    target: [f64; N],
) -> Nearest {
    let mut at = Nearest { parameter: start, distance: distance(curve(start)[0], target) };
    let mut reach = width;
    for _ in 0..STEPS {
        let [point, along] = curve(at.parameter);
        let square: f64 = along.iter().map(|c| c * c).sum();
        if square <= 0.0 || reach <= 1e-15 * (1.0 + at.parameter.abs()) {
            break;
        }
        let ahead: f64 = (0..N).map(|k| (target[k] - point[k]) * along[k]).sum();
        let step = (ahead / square).clamp(-reach, reach);
        let next = at.parameter + step;
        let next = ends.map_or(next, |[a, b]| next.clamp(a, b));
        let far = distance(curve(next)[0], target);
        if far < at.distance {
            at = Nearest { parameter: next, distance: far };
        } else {
            // A bound on the steps, not their length: the full step is taken again when it is shorter.
            reach = 0.25 * step.abs();
        }
    }
    at
}

/// The point of a surface nearest to `target` from a start on, within bounds; `None` leaves a direction without bounds.
pub(super) fn nearest_of_surface(
    surface: impl Fn([f64; 2]) -> [[f64; 3]; 3],
    start: [f64; 2],
    bounds: [Option<[f64; 2]>; 2],
    target: [f64; 3],
) -> ([f64; 2], f64) {
    let clamped = |uv: [f64; 2]| [0, 1].map(|k: usize| bounds[k].map_or(uv[k], |[a, b]| uv[k].clamp(a, b)));
    let mut uv = clamped(start);
    let mut far = distance(surface(uv)[0], target);
    let mut damping = 1e-6;
    for _ in 0..STEPS {
        let [point, du, dv] = surface(uv);
        let rest = [0, 1, 2].map(|k| target[k] - point[k]);
        let (uu, vv, cross) = (dot(du, du), dot(dv, dv), dot(du, dv));
        let (mut a, mut b) = (dot(rest, du), dot(rest, dv));
        // What would leave the bounds stays on them.
        let held = |k: usize, ahead: f64| {
            bounds[k].is_some_and(|[low, high]| (uv[k] <= low && ahead < 0.0) || (uv[k] >= high && ahead > 0.0))
        };
        let holds = [held(0, a), held(1, b)];
        let mut cross = cross;
        if holds[0] {
            (a, cross) = (0.0, 0.0);
        }
        if holds[1] {
            (b, cross) = (0.0, 0.0);
        }
        let size = uu.max(vv).max(f64::MIN_POSITIVE);
        let (p, q) = (uu + damping * uu + 1e-14 * size, vv + damping * vv + 1e-14 * size);
        let determinant = p * q - cross * cross;
        if determinant <= 0.0 {
            damping = (10.0 * damping).max(1e-6);
            if damping > 1e6 {
                break;
            }
            continue;
        }
        let step = [(a * q - b * cross) / determinant, (b * p - a * cross) / determinant];
        let next = clamped([uv[0] + step[0], uv[1] + step[1]]);
        let moved = distance(surface(next)[0], target);
        if moved < far {
            let gain = far - moved;
            (uv, far) = (next, moved);
            damping *= 0.1;
            if gain <= 1e-15 * far {
                break;
            }
        } else {
            damping = (10.0 * damping).max(1e-9);
            if damping > 1e8 {
                break;
            }
        }
    }
    (uv, far)
}
