//! Points of a curve that contradict all others, and corners that the points show and do not declare.
//!
//! One after the other, as long as there is one: the point without which the noise of the smoothed curve is least, or the
//! corner with which it is, if that leaves much less. A point for which
//!
//! ```text
//! t = (d_k - y(x_k)) / (sigma sqrt(1 + q_k))
//! ```
//!
//! y the curve through the others with the weight that cross-validation gives them, sigma their noise and q_k the
//! variance of y(x_k) over sigma^2, is beyond what one curve in 50 exceeds by chance anywhere (Bonferroni) is a suspect.
//! Of the corners as many are reported as Schwarz' criterion (1978) asks for, where they leave less than half of the noise.
//!
//! Not suspected: points that are locked, doubtful or have a tolerance or a break of their own, and the ends.
//! Of 200 waterlines of 21 points with normal noise 1.5 % have a suspect; one error of 5, 8 and 15 standard deviations is
//! found in 28, 96 and 100 % of them, and another point is suspected in 0.4 %.

use super::super::robust::{point_of_t, tested, without as left_out};
use super::super::smoothing::Smoother;
use super::given::{CurveError, CurvePoint, CurveSettings};
use super::space::{CurveSpace, checked};

/// Probability that any point of a clean curve is suspected.
const LEVEL: f64 = 0.02;
/// Most suspects, in points.
const MOST: f64 = 0.15;
/// Most points that are tried one by one.
const MOST_TRIED: usize = 40;
/// Most corners.
const MOST_CORNERS: usize = 4;
/// What corners must leave of the noise.
const LEFT: f64 = 0.5;
/// Readings that the curve must not take up for a noise to be known, in readings.
const LEAST_FREEDOM: f64 = 0.5;
/// Powers of ten of the weight that are tried where that of cross-validation takes up more.
const POWERS: [i32; 2] = [-10, 9];
/// An error is taken for a corner where that leaves less than this part of the noise.
const CORNER: f64 = 0.7;
/// Steps of the writing that an error has at least.
const STEPS: f64 = 3.0;
/// An error below this part of the ordinates is rounding.
const ROUNDING: f64 = 1e-7;

/// A point that contradicts all others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveSuspect {
    /// Its index.
    pub index: usize,
    /// As given.
    pub value: f64,
    /// What the others have there.
    pub expected: f64,
    /// t.
    pub score: f64,
}

/// A point at which the points show a corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveCorner {
    /// Its index.
    pub index: usize,
    /// Noise without the corners, and with all that are reported.
    pub noise: [f64; 2],
}

/// What the points contradict.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Contradictions {
    /// Points.
    pub suspects: Vec<CurveSuspect>,
    /// Undeclared corners.
    pub corners: Vec<CurveCorner>,
}

/// What the smoothed curve of points says.
#[derive(Debug, Clone, Copy)]
struct Judged {
    /// Noise.
    sigma: f64,
    /// Readings that the curve does not take up.
    freedom: f64,
    /// Of the point that has no say: what the curve has more there, and t.
    missed: f64,
    score: f64,
}

impl Judged {
    /// Schwarz' criterion of `count` readings and so many corners, of which each has a place besides.
    fn criterion(&self, count: f64, corners: usize) -> f64 {
        let taken = count - self.freedom + corners as f64;
        count * (self.sigma * self.sigma * self.freedom / count).ln() + taken * count.ln()
    }
}

/// What smooths points; none where they make no curve.
fn smoother(points: &[CurvePoint], order: usize) -> Option<Smoother> {
    let space = CurveSpace::new(points, order).ok()?;
    Some(Smoother::new(&space.model(points, &vec![None; points.len()], space.energy(None))))
}

/// Smooths points, of which one may have no say; none where the others make no curve with a noise that is known.
fn judged(points: &[CurvePoint], order: usize, out: Option<usize>, least: f64) -> Option<Judged> {
    let smoother = smoother(points, order)?;
    let count = smoother.weights().len();
    let place = out.map(|k| points[..k].iter().filter(|point| point.y.is_some()).count());
    let list: Vec<bool> = (0..count).map(|k| Some(k) == place).collect();
    // Points without any error leave nothing to validate.
    let lambda = left_out(&smoother, &list).cross_validated().map_or(0.0, |(lambda, _)| lambda);
    let weights = [lambda].into_iter().chain((POWERS[0]..=POWERS[1]).map(|power| 10f64.powi(power)));
    let enough = LEAST_FREEDOM * count as f64;
    let (smoothed, scores, freedom) = weights
        .filter(|&weight| weight >= lambda)
        .find_map(|weight| tested(&smoother, weight, &list).ok().filter(|(.., freedom)| *freedom >= enough))?;
    let sigma = (smoothed.rss / freedom).sqrt().max(least);
    let [missed, score] = place.map_or([0.0; 2], |place| [smoothed.residuals[place], scores[place]]);
    Some(Judged { sigma, freedom, missed, score })
}

/// Those of the candidates that are furthest from the smoothed curve, if they are many.
fn standing_out(points: &[CurvePoint], order: usize, mut candidates: Vec<usize>) -> Vec<usize> {
    if candidates.len() <= MOST_TRIED {
        return candidates;
    }
    let Some(smoother) = smoother(points, order) else { return Vec::new() };
    let smoothed = smoother.cross_validated().and_then(|(lambda, _)| smoother.at(lambda));
    let Ok(smoothed) = smoothed else { return Vec::new() };
    let mut residuals = smoothed.residuals.iter();
    let sizes: Vec<f64> =
        points.iter().map(|point| point.y.and(residuals.next()).map_or(0.0, |residual| residual.abs())).collect();
    candidates.sort_by(|&a, &b| sizes[b].total_cmp(&sizes[a]).then(a.cmp(&b)));
    candidates.truncate(MOST_TRIED);
    candidates.sort_unstable();
    candidates
}

/// Finds what contradicts the other points.
///
/// # Errors
/// [`CurveError`] when the points make no curve.
pub fn contradictions(points: &[CurvePoint], settings: &CurveSettings) -> Result<Contradictions, CurveError> {
    checked(points, settings)?;
    let given: Vec<usize> = (0..points.len()).filter(|&k| points[k].y.is_some()).collect();
    let (Some(&first), Some(&last)) = (given.first(), given.last()) else { return Ok(Contradictions::default()) };
    let size = given.iter().filter_map(|&k| points[k].y).fold(0.0_f64, |most, y| most.max(y.abs()));
    let least = (STEPS * settings.quantum).max(ROUNDING * size);
    let count = given.len() as f64;
    let free = |point: &CurvePoint| {
        let marked = point.locked || point.knuckle || point.tangent;
        !marked && point.tolerance.is_none() && point.weight >= 1.0 && point.y.is_some()
    };
    let order = settings.order;
    // Less is rounding.
    let rounding = (settings.quantum / 12f64.sqrt()).max(ROUNDING * size);
    let mut now = points.to_vec();
    let mut found = Contradictions::default();
    let Some(mut smooth) = judged(&now, order, None, rounding) else { return Ok(found) };
    // Corners with what is judged with each of them and those before it.
    let mut corners: Vec<(usize, Judged)> = Vec::new();
    loop {
        let candidates = standing_out(&now, order, (first + 1..last).filter(|&k| free(&now[k])).collect());
        let mut spike: Option<(Judged, usize)> = None;
        let mut corner: Option<(Judged, usize)> = None;
        let mut pair = f64::INFINITY;
        let less = |trial: Judged, best: Option<(Judged, usize)>| best.is_none_or(|(best, _)| trial.sigma < best.sigma);
        let broken = |places: &[usize]| {
            let mut broken = now.clone();
            places.iter().for_each(|&at| broken[at].knuckle = true);
            judged(&broken, order, None, rounding)
        };
        for &k in &candidates {
            if let Some(trial) = judged(&now, order, Some(k), rounding) {
                let beyond = trial.score.abs() > point_of_t(0.5 * LEVEL / count, trial.freedom);
                if beyond && trial.missed.abs() > least && less(trial, spike) {
                    spike = Some((trial, k));
                }
            }
            if let Some(trial) = broken(&[k]).filter(|trial| less(*trial, corner)) {
                corner = Some((trial, k));
            }
        }
        let room = (found.suspects.len() + 1) as f64 <= (MOST * count).max(1.0);
        // Where there are two corners, one alone explains little.
        if let Some((_, k)) = spike.filter(|_| corners.len() + 1 < MOST_CORNERS) {
            let others = candidates.iter().filter(|&&other| other != k);
            let least =
                others.filter_map(|&other| broken(&[k, other])).map(|trial| trial.sigma).fold(f64::INFINITY, f64::min);
            if corner.is_none_or(|(trial, _)| least < trial.sigma)
                && let Some(trial) = broken(&[k])
            {
                corner = Some((trial, k));
                pair = least;
            }
        }
        let rival = corner.map_or(f64::INFINITY, |(trial, _)| trial.sigma).min(pair);
        if let Some((trial, k)) = spike.filter(|(trial, _)| room && CORNER * trial.sigma <= rival) {
            let value = now[k].y.unwrap_or_default();
            found.suspects.push(CurveSuspect { index: k, value, expected: value + trial.missed, score: trial.score });
            now[k].y = None;
            if corners.is_empty() {
                smooth = trial;
            }
        } else if let Some((trial, k)) = corner.filter(|_| corners.len() < MOST_CORNERS) {
            corners.push((k, trial));
            now[k].knuckle = true;
        } else {
            break;
        }
    }
    found.suspects.sort_by_key(|suspect| suspect.index);
    let criterion = |m: usize| m.checked_sub(1).map_or(smooth, |m| corners[m].1).criterion(count, m);
    let best = (0..=corners.len()).min_by(|&a, &b| criterion(a).total_cmp(&criterion(b))).unwrap_or(0);
    let left = corners[..best].last().map_or(smooth.sigma, |(_, trial)| trial.sigma);
    // As many as are tried are no corners, but something else.
    if best < MOST_CORNERS && left < LEFT * smooth.sigma && smooth.sigma > least {
        let reported = corners[..best].iter().map(|&(index, _)| CurveCorner { index, noise: [smooth.sigma, left] });
        found.corners = reported.collect();
        found.corners.sort_by_key(|corner| corner.index);
    }
    Ok(found)
}
