//! The iteration: predictor, corrector, step, and when it ends.

use super::super::problem::{Progress, Settings};
use super::newton::{Newton, Right, Step};
use super::point::{Direction, Iterate, Residuals, Slack};
use super::scaled::Scaled;
use super::schur::inverse;

/// Residuals and complementarity of this size count when no iteration lowers them any more: the precision of the Newton
/// systems is reached. So many iterations that do not halve them show it.
const ENOUGH: f64 = 1e-8;
const STANDSTILL: usize = 8;
/// Iterations without one that halves the largest of residuals and complementarity, after which it stalls, where that is
/// above [`FAR_OFF`].
const HALVED: usize = 40;
const FAR_OFF: f64 = 1e-4;
/// Part of the way to the boundary that a step may go.
const FRACTION: f64 = 0.995;
/// Iterations beyond the tolerance, as long as each divides the duality gap by the factor.
const FINISH: usize = 6;
const FINISH_FACTOR: f64 = 3.0;
/// While the residuals are not there, the complementarity stays above this part of the tolerance.
const WAIT: f64 = 0.1;
/// The iterate with residuals and complementarity of this size is kept for a warm start: near the centre, far from the
/// faces.
const KEEP: f64 = 3e-5;
/// Most correctors after Mehrotra's; none for steps this long; the part of the hoped-for gain that one must bring.
const CORRECTORS: usize = 2;
const LONG: f64 = 0.9;
const WORTH: f64 = 0.1;
/// Relative precision of the last Newton system of an iteration, and the part of a residual that needs no precision.
const EXACT: f64 = 1e-12;
const SHARE: f64 = 1e-3;
/// Products that more correctors leave alone, in units of the target.
const SMALLEST: f64 = 0.1;
const LARGEST: f64 = 10.0;
/// After so many iterations without this reduction of the complementarity the second-order term is damped.
const PATIENCE: usize = 4;
const PROGRESS: f64 = 0.9;
/// A Farkas proof excludes feasible points within this multiple of the size of the iterate.
const PROOF: f64 = 1e-9;
/// Iterates beyond this may run along a ray.
const FAR: f64 = 1e6;

/// How the iteration ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    Optimal,
    /// Nothing was reached, from where it began.
    Stalled,
    /// The iterate may be a proof that there is no solution.
    Hopeless,
}

/// Targets of the products s_u z_u and s_l z_l.
struct Targets {
    upper: Vec<f64>,
    lower: Vec<f64>,
}

/// The right side of the Newton system for the targets (mathematics in the parent module).
fn right_side(scaled: &Scaled, point: &Iterate, residuals: &Residuals, weights: &[f64], targets: &Targets) -> Right {
    let f = residuals.dual.iter().map(|value| -value).collect();
    let g = (0..point.z.len())
        .map(|row| {
            let r = residuals.primal[row];
            if scaled.equal[row] {
                return r;
            }
            let (upper, lower) = (point.upper[row], point.lower[row]);
            let gamma = (targets.upper[row] / upper.s - upper.z) - (targets.lower[row] / lower.s - lower.z);
            if scaled.inside[row] { weights[row] * r - gamma } else { r - gamma * inverse(weights[row]) }
        })
        .collect();
    Right { f, g }
}

/// dt = A dx - r_p and the changes of the multipliers that go with (dx, dz).
fn completed(scaled: &Scaled, point: &Iterate, residuals: &Residuals, targets: &Targets, step: Step) -> Direction {
    let m = point.z.len();
    let mut direction = Direction { t: vec![0.0; m], upper: vec![0.0; m], lower: vec![0.0; m], step };
    for row in 0..m {
        if scaled.equal[row] {
            continue;
        }
        let (upper, lower) = (point.upper[row], point.lower[row]);
        let t = direction.step.values[row] - residuals.primal[row];
        direction.t[row] = t;
        direction.upper[row] = (targets.upper[row] + upper.z * t) / upper.s - upper.z;
        direction.lower[row] = (targets.lower[row] - lower.z * t) / lower.s - lower.z;
    }
    direction
}

/// Products to the target, with the second-order term ds dz of the predictor (Mehrotra 1992).
fn corrected(affine: &Direction, target: f64) -> Targets {
    let terms = |z: &[f64], sign: f64| affine.t.iter().zip(z).map(|(t, z)| target + sign * t * z).collect();
    Targets { upper: terms(&affine.upper, 1.0), lower: terms(&affine.lower, -1.0) }
}

/// Targets moved so that the products after a step of length `aim` come back between a tenth and ten times the target
/// (Gondzio 1996).
fn centred(point: &Iterate, step: &Direction, targets: &Targets, target: f64, aim: f64) -> Targets {
    let moved = |sides: &[Slack], dz: &[f64], sign: f64, old: &[f64]| {
        (0..sides.len())
            .map(|row| {
                let side = sides[row];
                if !side.exists() {
                    return old[row];
                }
                let product = (side.s + sign * aim * step.t[row]) * (side.z + aim * dz[row]);
                let wanted = product.clamp(SMALLEST * target, LARGEST * target);
                old[row] + (wanted - product).max(-LARGEST * target)
            })
            .collect()
    };
    Targets {
        upper: moved(&point.upper, &step.upper, -1.0, &targets.upper),
        lower: moved(&point.lower, &step.lower, 1.0, &targets.lower),
    }
}

/// Iterates from a point; the number of iterations and how it ended. Keeps an early iterate for the next start, and
/// tells of all.
pub(super) fn iterate(
    scaled: &Scaled,
    newton: &mut Newton,
    point: &mut Iterate,
    settings: &Settings,
    (kept, progress): (&mut Option<Iterate>, &mut Vec<Progress>),
) -> (usize, End) {
    *kept = None;
    let (tolerance, most) = (settings.tolerance, settings.iterations);
    let m = point.z.len();
    let sides = point.sides();
    let linear_program = scaled.quadratic.values().iter().all(|value| *value == 0.0);
    let mut finishing: Option<(usize, Iterate, f64)> = None;
    let mut residuals = point.residuals(scaled);
    let (mut short, mut slow, mut least) = (0, 0, f64::INFINITY);
    // The best iterate within reach of the tolerance, and iterations since.
    let mut near: Option<(f64, Iterate, usize)> = None;
    // What they were when last halved, and iterations since.
    let mut halved = (f64::INFINITY, 0);
    for count in 0..most {
        let mean = residuals.complementarity / sides.max(1) as f64;
        let size = residuals.objective.abs().max(scaled.objective_scale);
        let relative = residuals.complementarity / size;
        progress.push(Progress { primal: residuals.primal_size, dual: residuals.dual_size, gap: relative });
        let reached = |limit: f64| {
            residuals.primal_size.max(residuals.dual_size) <= limit && residuals.complementarity <= limit * size
        };
        if kept.is_none() && reached(KEEP) {
            *kept = Some(point.clone());
        }
        let good = reached(tolerance);
        let gap = residuals.gap(point);
        match &finishing {
            None if good => {
                if sides == 0 {
                    return (count, End::Optimal);
                }
                finishing = Some((0, point.clone(), gap));
            }
            None => {}
            Some((rounds, best, before)) => {
                if gap * FINISH_FACTOR > *before || *rounds + 1 >= FINISH {
                    if gap > *before {
                        point.clone_from(best);
                    }
                    return (count, End::Optimal);
                }
                finishing = Some((rounds + 1, point.clone(), gap));
            }
        }
        if hopeless(scaled, point, &residuals) {
            return (count, End::Hopeless);
        }
        let off = residuals.primal_size.max(residuals.dual_size).max(relative);
        halved = if 2.0 * off < halved.0 { (off, 0) } else { (halved.0, halved.1 + 1) };
        if halved.1 > HALVED && off > FAR_OFF {
            return (count, End::Stalled);
        }
        near = match near.take() {
            Some((best, at, since)) if 2.0 * off > best => Some((best, at, since + 1)),
            _ if off <= ENOUGH.max(tolerance) => Some((off, point.clone(), 0)),
            none => none,
        };
        if let Some((_, at, since)) = &near
            && finishing.is_none()
            && *since >= STANDSTILL
        {
            point.clone_from(at);
            return (count, End::Optimal);
        }
        slow = if residuals.complementarity < PROGRESS * least { 0 } else { slow + 1 };
        least = least.min(residuals.complementarity);
        let weights = point.weights();
        let failed = finishing.is_some();
        let ended = |point: &mut Iterate, finishing: Option<(usize, Iterate, f64)>| {
            let best = finishing.map(|(_, best, _)| best).or(near.as_ref().map(|(_, best, _)| best.clone()));
            let end = if best.is_some() { End::Optimal } else { End::Stalled };
            if let Some(best) = best {
                *point = best;
            }
            (count, end)
        };
        if !newton.factor(scaled, &weights) {
            return ended(point, finishing);
        }
        // Predictor: products to 0.
        let nothing = Targets { upper: vec![0.0; m], lower: vec![0.0; m] };
        let mut directed = |targets: &Targets| {
            let right = right_side(scaled, point, &residuals, &weights, targets);
            let step = newton.pass(scaled, &right);
            (completed(scaled, point, &residuals, targets, step), right)
        };
        let (affine, _) = directed(&nothing);
        let mut reach = point.longest(&affine).map(|length| length.min(1.0));
        if !linear_program {
            reach = [reach[0].min(reach[1]); 2];
        }
        let after = point.mean_after(&affine, reach, sides);
        let ratio = if mean > 0.0 { after / mean } else { 0.0 };
        // Below what the tolerance asks for, the products wait for the residuals.
        let enough = if finishing.is_some() || residuals.primal_size > 1e3 * tolerance {
            0.0
        } else {
            (WAIT * tolerance * size / sides.max(1) as f64).min(mean)
        };
        let target = (ratio.clamp(0.0, 1.0).powi(3) * mean).max(enough);
        // Corrector: products to the target, with the second-order term of the predictor.
        let mut targets = corrected(&affine, target);
        let (mut step, mut right) = directed(&targets);
        let mut longest = point.longest(&step);
        // More correctors while they lengthen the step.
        for _ in 0..CORRECTORS {
            let length = longest[0].min(longest[1]);
            if length >= LONG {
                break;
            }
            let aim = (1.1 * length + 0.1).min(1.0);
            let centred = centred(point, &step, &targets, target, aim);
            let (other, other_right) = directed(&centred);
            let tried = point.longest(&other);
            if tried[0].min(tried[1]) < length + WORTH * (aim - length) {
                break;
            }
            (step, longest, targets, right) = (other, tried, centred, other_right);
        }
        let exact = |size: f64, scale: f64| scale * EXACT.max(SHARE * size);
        let tolerance =
            [exact(residuals.dual_size, residuals.dual_scale), exact(residuals.primal_size, residuals.primal_scale)];
        newton.refine(scaled, &right, tolerance, &mut step.step);
        let step = completed(scaled, point, &residuals, &targets, step.step);
        let mut longest = point.longest(&step);
        let fraction = if failed { 1.0 - 1e-4 } else { FRACTION };
        longest = longest.map(|length| (fraction * length).min(1.0));
        if !linear_program {
            longest = [longest[0].min(longest[1]); 2];
        }
        if slow >= PATIENCE {
            // The mean of the products is a parabola along the step: go to its lowest point.
            let at = |part: f64| point.mean_after(&step, longest.map(|length| part * length), sides);
            let part = [1.0, 0.7, 0.5, 0.3, 0.1].into_iter().min_by(|a, b| at(*a).total_cmp(&at(*b))).unwrap_or(1.0);
            longest = longest.map(|length| part * length);
        }
        if !longest[0].is_finite() || step.step.x.iter().any(|value| !value.is_finite()) {
            return ended(point, finishing);
        }
        short = if longest[0].max(longest[1]) < 1e-7 { short + 1 } else { 0 };
        if short > 3 {
            return ended(point, finishing);
        }
        point.advance(&step, longest, &scaled.equal);
        residuals = point.residuals(scaled);
        if !residuals.dual_size.is_finite() || !residuals.primal_size.is_finite() {
            return ended(point, finishing);
        }
    }
    if finishing.is_none()
        && let Some((_, best, _)) = near
    {
        *point = best;
        return (most, End::Optimal);
    }
    (most, if finishing.is_some() { End::Optimal } else { End::Stalled })
}

/// Whether the iterate has become a proof that no solution exists: multipliers that separate, or a direction of endless
/// fall. The caller looks at it again.
fn hopeless(scaled: &Scaled, point: &Iterate, residuals: &Residuals) -> bool {
    let reach = point.x.iter().fold(1.0_f64, |most, value| most.max(value.abs()));
    if residuals.support < 0.0 && residuals.pull * reach.min(1e6) <= PROOF * -residuals.support {
        return true;
    }
    if reach < FAR {
        return false;
    }
    let slope: f64 = point.x.iter().zip(&scaled.linear).map(|(x, q)| x * q).sum();
    let curved = scaled.quadratic.apply(&point.x).iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    slope < 0.0 && curved <= PROOF * -slope
}
