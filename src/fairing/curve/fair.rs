//! The whole job of fairing a curve.

use super::super::infeasible::Diagnosis;
use super::super::infeasible::least_widening;
use super::super::inflections::{Bands, BandsError, Inflections, minimum_inflections};
use super::super::model::{Model, Row, value};
use super::super::program::{Between, Program, RowName, Solved, Wishes};
use super::super::smoothing::{Smoothed, Smoother, Trial};
use super::given::{CurveError, CurvePoint, CurveSettings, InflectionWish};
use super::result::{CurveLine, CurveMove, FairCurve, FairStatus, LineKind, inflections};
use super::signs::{Signs, scores};
use super::space::{CurveSpace, checked};
use super::wishes::{Wished, between, limits, quantity};

use crate::spline::{BsplineCurve, Condition, Energy, KnotVector};

/// Dearest pattern, in units of sigma^2.
pub const PRICE: f64 = 12.0;
/// Slopes below this are mild: the metric changes energies by less than a few parts in a hundred.
const MILD: f64 = 0.1;
/// Most refreshes of the metric after the first.
const REFRESHES: usize = 5;
/// The exact functional must fall by this part of itself.
const FALL: f64 = 1e-6;
/// Most programs in the search for the best places of the changes.
const MOVES: usize = 40;
/// Noise levels of a tolerance that is not given.
const LEVELS: f64 = 3.0;
/// Rounding that a tolerance forgives, as a part of it.
pub(super) const SLACK: f64 = 1e-6;

/// The programs of one job.
pub(super) struct Job<'a> {
    pub(super) settings: &'a CurveSettings,
    pub(super) space: CurveSpace,
    forms: Vec<Row>,
    pub(super) model: Model,
    pub(super) smoother: Smoother,
    lambda: f64,
    pub(super) wishes: Wishes,
    pub(super) programs: usize,
    iterations: usize,
}

/// A pattern that was solved for.
struct Patterned {
    signs: Signs,
    solved: Solved,
}

impl Job<'_> {
    pub(super) fn program(&self, wishes: &Wishes, imposed: Option<&[i8]>) -> Program {
        let signs = imposed.map(|imposed| (self.forms.as_slice(), imposed));
        Program::new(&self.model, &self.smoother, self.lambda, wishes, signs)
    }

    pub(super) fn solve(&mut self, wishes: &Wishes, imposed: Option<&[i8]>) -> Result<Solved, CurveError> {
        let program = self.program(wishes, imposed);
        let solved = program.solve(&self.smoother, self.lambda, &self.settings.solver)?;
        self.programs += 1;
        self.iterations += solved.solution.iterations;
        Ok(solved)
    }

    /// The best pattern with these numbers of changes: that which overrules least, its changes moved while the
    /// objective falls.
    fn pattern(&mut self, z: &[f64], starts: &[usize], counts: &[usize]) -> Result<Option<Patterned>, CurveError> {
        let Some(signs) = Signs::best(z, starts, counts) else { return Ok(None) };
        let wishes = self.wishes.clone();
        let solved = self.solve(&wishes, Some(&signs.imposed(z)))?;
        let mut best = Patterned { signs, solved };
        let value = |solved: &Solved| if solved.is_optimal() { solved.objective } else { f64::INFINITY };
        let budget = self.programs + MOVES;
        let mut better = true;
        while better && self.programs < budget {
            better = false;
            for (stretch, &count) in counts.iter().enumerate() {
                for which in 0..count {
                    for by in [-1, 1, -2, 2] {
                        let Some(signs) = best.signs.moved(stretch, which, by) else { continue };
                        let solved = self.solve(&wishes, Some(&signs.imposed(z)))?;
                        if value(&solved) < value(&best.solved) * (1.0 - FALL) {
                            best = Patterned { signs, solved };
                            better = true;
                        }
                    }
                }
            }
        }
        Ok(best.solved.is_optimal().then_some(best))
    }

    /// The energy with the metric of a curve, at the same weight.
    fn remeasure(&mut self, curve: &BsplineCurve<1>) {
        let weight = self.lambda * self.smoother.unit;
        self.model.energy = self.space.energy(Some(curve));
        self.smoother = Smoother::new(&self.model);
        self.lambda = weight / self.smoother.unit;
    }

    /// sum w r^2 + mu E with the metric of the curve itself.
    fn exact(&self, net: &[f64]) -> Result<f64, CurveError> {
        let energy = self.space.exact_energy(&self.space.curve(net)?);
        let misfit = self.model.misfit(net, self.smoother.weights());
        Ok(misfit + self.lambda * self.smoother.unit * energy)
    }
}

/// Fairs a curve; points must have rising abscissae.
///
/// # Errors
/// [`CurveError`] when the question is none; that targets and limits cannot be met together is a status.
pub fn fair_curve(points: &[CurvePoint], settings: &CurveSettings) -> Result<FairCurve, CurveError> {
    checked(points, settings)?;
    // Sites and values are judged before anything is built on them.
    let read: Vec<usize> = (0..points.len()).filter(|&k| points[k].y.is_some()).collect();
    let all: Vec<f64> = points.iter().map(|point| point.x).collect();
    Bands::new(all, vec![0.0; points.len()], vec![0.0; points.len()], Vec::new())?;
    let space = CurveSpace::new(points, settings.order)?;
    let model = space.model(points, &vec![None; points.len()], space.energy(None));
    let smoother = Smoother::new(&model);
    let forms = space.forms();
    let mut job = Job {
        settings,
        space,
        forms,
        model,
        smoother,
        lambda: 1.0,
        wishes: Wishes { widening: 1.0, ..Wishes::default() },
        programs: 0,
        iterations: 0,
    };
    let (mut smoothed, mut trials) = smooth(&mut job)?;
    let first = job.space.curve(&job.smoother.reduced.expand(&smoothed.free))?;
    let steep = settings.true_curvature && job.space.steepest(&first) > MILD;
    let mut refreshes = 0;
    if steep {
        job.remeasure(&first);
        (smoothed, trials) = smooth(&mut job)?;
        refreshes = 1;
    }
    let sigma = smoothed.sigma(job.smoother.count()).max(settings.quantum / 12f64.sqrt()).max(1e-12);
    let tolerances = tolerances(points, settings, sigma);
    job.model = job.space.model(points, &tolerances, job.model.energy.clone());
    let batten = batten(points, &read)?;
    let wished = limits(&job.space, settings);
    job.wishes.constraints = wished.iter().map(|wish| wish.limit.clone()).collect();

    let bands = bands(points, &read, &tolerances)?;
    let least = minimum_inflections(&bands);
    let knuckles: Vec<f64> = points.iter().filter(|p| p.knuckle).map(|p| p.x).collect();
    let starts = job.space.stretches(&knuckles);

    let (reference, sites) = kept_near(&mut job, points, &tolerances, &smoothed)?;
    let Within { free, mut status, diagnosis, nearest, mut contradictory } = job.within(&wished, &sites, &reference)?;
    let z = scores(&job.forms, &job.smoother, &smoothed, &free.net);
    let mut choice = choose(&mut job, &z, &starts, &least, &free, sigma)?;
    let (mut solved, mut pattern) = match choice.taken.take() {
        Some(taken) => (taken.solved, Some(taken.signs.imposed(&z))),
        None => (free.clone(), None),
    };
    if choice.widening > 1.0 {
        status = FairStatus::Infeasible;
        contradictory |= choice.widening.is_infinite();
    }
    // The metric follows the curve while the exact functional falls.
    if steep && status == FairStatus::Optimal && solved.is_optimal() {
        let mut exact = job.exact(&solved.net)?;
        let wishes = job.wishes.clone();
        for _ in 0..REFRESHES {
            let kept = (job.model.energy.clone(), job.smoother.clone(), job.lambda);
            let curve = job.space.curve(&solved.net)?;
            job.remeasure(&curve);
            let mut next = job.solve(&wishes, pattern.as_deref())?;
            // What kept to its number of changes by itself may not do so with another metric.
            let often = |(s, count): (usize, &usize)| changes(&job, &next, starts[s], starts[s + 1]) > *count;
            if pattern.is_none()
                && choice.counts.iter().enumerate().any(often)
                && let Some(found) = job.pattern(&z, &starts, &choice.counts)?
            {
                choice.price = ((found.solved.objective - next.objective) / (sigma * sigma)).max(0.0);
                pattern = Some(found.signs.imposed(&z));
                next = found.solved;
            }
            let now = if next.is_optimal() { job.exact(&next.net)? } else { f64::INFINITY };
            if now >= exact * (1.0 - FALL) {
                (job.model.energy, job.smoother, job.lambda) = kept;
                break;
            }
            (solved, exact) = (next, now);
            refreshes += 1;
        }
    }
    if status == FairStatus::Optimal && !solved.is_optimal() {
        status = FairStatus::Limit;
    }
    let curve = job.space.curve(&solved.net)?;
    let lines = priced(&mut job, &wished, &solved, pattern.as_deref(), &batten)?;
    let moves = moved(points, &curve, &tolerances, job.wishes.widening);
    let through = job.space.exact_energy(&interpolant(&job, points, &read)?);
    Ok(FairCurve {
        status,
        points: moves,
        order: settings.order,
        energy: [job.space.exact_energy(&curve), through],
        sigma,
        lambda: job.lambda,
        freedom: smoothed.edf,
        trials,
        certificate: solved.certificate,
        lines,
        least,
        inflections: [inflections(&batten, &knuckles), inflections(&curve, &knuckles)],
        allowed: choice.allowed,
        price: choice.price,
        refused: choice.refused,
        widening: if contradictory { f64::INFINITY } else { job.wishes.widening },
        diagnosis,
        nearest,
        work: [job.programs, job.iterations],
        refreshes,
        curve,
        batten,
    })
}

/// The smoothed net, and the limits between the points about it. Where points are locked, about the fairest curve through
/// them within the tolerances of the others: what they ask for is nothing that the curve must be kept from.
fn kept_near(
    job: &mut Job,
    points: &[CurvePoint],
    tolerances: &[Option<f64>],
    smoothed: &Smoothed,
) -> Result<(Vec<f64>, Vec<Between>), CurveError> {
    let reference = job.smoother.reduced.expand(&smoothed.free);
    let sites = between(&job.space, points, tolerances, job.settings, &reference);
    if !points.iter().any(|point| point.locked && point.y.is_some()) {
        return Ok((reference, sites));
    }
    let breadths = job.not_below(&sites).collect();
    let through = job.solve(&Wishes { widening: 1.0, breadths, ..Wishes::default() }, None)?;
    if !through.is_optimal() {
        return Ok((reference, sites));
    }
    let sites = between(&job.space, points, tolerances, job.settings, &through.net);
    Ok((through.net, sites))
}

/// The smoothing weight: given, or by cross-validation and not below what the rounding of the readings asks for.
fn smooth(job: &mut Job) -> Result<(Smoothed, Vec<Trial>), CurveError> {
    let (mut lambda, trials) = match job.settings.weight {
        Some(weight) => (weight, Vec::new()),
        None => job.smoother.cross_validated()?,
    };
    let mut smoothed = job.smoother.at(lambda)?;
    let rounding = job.settings.quantum / 12f64.sqrt();
    while job.settings.weight.is_none() && smoothed.sigma(job.smoother.count()) < rounding && lambda < 1e3 {
        lambda *= 2.0;
        smoothed = job.smoother.at(lambda)?;
    }
    job.lambda = lambda;
    Ok((smoothed, trials))
}

fn tolerances(points: &[CurvePoint], settings: &CurveSettings, sigma: f64) -> Vec<Option<f64>> {
    let usual = |point: &CurvePoint| {
        let own = (LEVELS * sigma / point.weight.sqrt()).max(2.0 * settings.quantum);
        point.tolerance.or(settings.tolerance).unwrap_or(own)
    };
    points.iter().map(|point| point.y.map(|_| if point.locked { 0.0 } else { usual(point) })).collect()
}

fn bands(points: &[CurvePoint], read: &[usize], tolerances: &[Option<f64>]) -> Result<Bands, CurveError> {
    let mut knuckles = Vec::new();
    for (k, point) in points.iter().enumerate().filter(|(_, point)| point.knuckle) {
        let place = read.iter().position(|&r| r == k).filter(|_| point.y.is_some());
        knuckles.push(place.ok_or(BandsError::Knuckle(k))?);
    }
    let sites = read.iter().map(|&k| points[k].x).collect();
    let values = read.iter().map(|&k| points[k].y.unwrap_or_default()).collect();
    let widths = read.iter().map(|&k| tolerances[k].unwrap_or_default()).collect();
    Ok(Bands::new(sites, values, widths, knuckles)?)
}

/// The cubic spline of least bending through the points as given.
fn batten(points: &[CurvePoint], read: &[usize]) -> Result<BsplineCurve<1>, CurveError> {
    let (mut breaks, mut times) = (Vec::new(), Vec::new());
    for (index, &k) in read.iter().enumerate() {
        breaks.push(points[k].x);
        if index > 0 && index + 1 < read.len() {
            times.push(if points[k].knuckle { 3 } else { 1 });
        }
    }
    let knots = KnotVector::from_breakpoints(3, &breaks, &times)?;
    through(&knots, 2, points, read)
}

fn through(
    knots: &KnotVector,
    order: usize,
    points: &[CurvePoint],
    read: &[usize],
) -> Result<BsplineCurve<1>, CurveError> {
    let conditions: Vec<Condition> = read.iter().map(|&k| Condition { site: points[k].x, order: 0 }).collect();
    let values: Vec<f64> = read.iter().map(|&k| points[k].y.unwrap_or_default()).collect();
    let net = Energy::new(knots, order).interpolation(&conditions)?.solve(&values);
    Ok(BsplineCurve::new(knots.clone(), net.into_iter().map(|c| [c]).collect())?)
}

/// The spline of least energy of this order through the points as given; of less order where knuckles leave that one
/// open.
fn interpolant(job: &Job, points: &[CurvePoint], read: &[usize]) -> Result<BsplineCurve<1>, CurveError> {
    let exact = (2..=job.space.order).rev().find_map(|order| through(&job.space.knots, order, points, read).ok());
    match exact {
        Some(curve) => Ok(curve),
        None => batten(points, read),
    }
}

/// Area under the batten through the points as given, and the abscissa of its centroid.
///
/// # Errors
/// [`CurveError`] when the points make no curve.
pub fn area_and_centroid(points: &[CurvePoint]) -> Result<[f64; 2], CurveError> {
    let read: Vec<usize> = (0..points.len()).filter(|&k| points[k].y.is_some()).collect();
    if read.len() < 3 {
        return Err(CurveError::TooFew { found: read.len(), order: 2, needed: 3 });
    }
    let batten = batten(points, &read)?;
    Ok([quantity(LineKind::Area, &batten), quantity(LineKind::Centroid, &batten)])
}

/// The lines of the list of constraints; each is priced by leaving it out.
fn priced(
    job: &mut Job,
    wished: &[Wished],
    solved: &Solved,
    pattern: Option<&[i8]>,
    batten: &BsplineCurve<1>,
) -> Result<Vec<CurveLine>, CurveError> {
    let curve = job.space.curve(&solved.net)?;
    let names = job.program(&job.wishes, pattern).names;
    let moved = |job: &Job, net: &[f64]| {
        let weights = job.smoother.weights();
        let sum: f64 = weights.iter().sum();
        (job.model.misfit(net, weights) / sum.max(f64::MIN_POSITIVE)).sqrt()
    };
    let mut lines = Vec::new();
    for (index, wish) in wished.iter().enumerate() {
        let multiplier = names.iter().position(|name| *name == RowName::Constraint(index));
        let mut price = 0.0;
        if index < job.wishes.constraints.len() {
            let mut without = job.wishes.clone();
            without.constraints.remove(index);
            let other = job.solve(&without, pattern)?;
            price = if other.is_optimal() { moved(job, &solved.net) - moved(job, &other.net) } else { f64::NAN };
        }
        lines.push(CurveLine {
            kind: wish.kind,
            target: wish.target,
            before: quantity(wish.kind, batten),
            after: quantity(wish.kind, &curve),
            multiplier: multiplier.map_or(0.0, |row| solved.solution.multipliers[row]),
            price,
        });
    }
    Ok(lines)
}

fn moved(points: &[CurvePoint], curve: &BsplineCurve<1>, tolerances: &[Option<f64>], widening: f64) -> Vec<CurveMove> {
    let one = |(point, tolerance): (&CurvePoint, &Option<f64>)| {
        let d = curve.derivatives::<3>(point.x);
        // What is locked is met to rounding.
        let met = point.y.filter(|y| point.locked && (d[0][0] - y).abs() <= 1e-12 * (1.0 + y.abs()));
        let after = met.unwrap_or(d[0][0]);
        let active = match (point.y, tolerance) {
            (Some(y), Some(t)) => (after - y).abs() >= t * widening * (1.0 - 1e-4),
            _ => false,
        };
        CurveMove {
            x: point.x,
            before: point.y,
            after,
            tolerance: *tolerance,
            active,
            slope: d[1][0],
            curvature: d[2][0] / (1.0 + d[1][0] * d[1][0]).powf(1.5),
            suspect: false,
        }
    };
    points.iter().zip(tolerances).map(one).collect()
}

/// What was decided about the signs.
struct Choice {
    taken: Option<Patterned>,
    /// Changes that each stretch keeps to by itself; none where they are imposed, or may be any.
    counts: Vec<usize>,
    allowed: Option<usize>,
    price: f64,
    refused: Vec<(usize, f64)>,
    widening: f64,
}

/// The pattern: the least number of changes that the price allows, or the number that is wished.
fn choose(
    job: &mut Job,
    z: &[f64],
    starts: &[usize],
    least: &Inflections,
    free: &Solved,
    sigma: f64,
) -> Result<Choice, CurveError> {
    let mut choice =
        Choice { taken: None, counts: Vec::new(), allowed: None, price: 0.0, refused: Vec::new(), widening: 1.0 };
    let raw: Vec<usize> = (0..starts.len() - 1).map(|s| changes(job, free, starts[s], starts[s + 1])).collect();
    let price = |solved: &Solved| ((solved.objective - free.objective) / (sigma * sigma)).max(0.0);
    match job.settings.inflections {
        InflectionWish::Any => {}
        InflectionWish::Least => {
            let mut counts: Vec<usize> = least.stretches.iter().map(|stretch| stretch.inflections.len()).collect();
            while counts.iter().zip(&raw).any(|(count, raw)| count < raw) {
                let found = job.pattern(z, starts, &counts)?;
                let cost = found.as_ref().map_or(f64::INFINITY, |found| price(&found.solved));
                let total = counts.iter().sum();
                if cost <= PRICE {
                    choice.allowed = Some(total);
                    choice.price = cost;
                    choice.taken = found;
                    return Ok(choice);
                }
                choice.refused.push((total, cost));
                let Some(stretch) = cheapest(z, starts, &counts, &raw) else { return Ok(choice) };
                counts[stretch] += 1;
            }
            // The curve keeps to the number by itself.
            choice.allowed = Some(counts.iter().sum());
            choice.counts = counts;
        }
        InflectionWish::AtMost(wished) => {
            let mut counts = vec![0; raw.len()];
            while counts.iter().sum::<usize>() < wished {
                let Some(stretch) = cheapest(z, starts, &counts, &raw) else { break };
                counts[stretch] += 1;
            }
            choice.allowed = Some(wished);
            if counts.iter().zip(&raw).all(|(count, raw)| count >= raw) {
                choice.counts = counts;
                return Ok(choice);
            }
            choice.taken = job.pattern(z, starts, &counts)?;
            if choice.taken.is_none() {
                widen(job, z, starts, &counts, &mut choice)?;
            }
            choice.price = choice.taken.as_ref().map_or(0.0, |taken| price(&taken.solved));
        }
    }
    Ok(choice)
}

/// The tolerances that make a wished number of changes possible, and the best curve with them.
fn widen(job: &mut Job, z: &[f64], starts: &[usize], counts: &[usize], choice: &mut Choice) -> Result<(), CurveError> {
    let Some(mut best) = Signs::best(z, starts, counts) else { return Ok(()) };
    let factor_of = |job: &mut Job, signs: &Signs| {
        let plain = Wishes { widening: 1.0, ..job.wishes.clone() };
        job.programs += 1;
        least_widening(&job.program(&plain, Some(&signs.imposed(z))), &job.settings.solver, |_, _| None)
    };
    let Some(mut factor) = factor_of(job, &best)? else {
        choice.widening = f64::INFINITY;
        return Ok(());
    };
    let budget = job.programs + MOVES;
    let mut better = true;
    while better && job.programs < budget {
        better = false;
        for (stretch, &count) in counts.iter().enumerate() {
            for which in 0..count {
                for by in [-1, 1, -2, 2] {
                    let Some(signs) = best.moved(stretch, which, by) else { continue };
                    if let Some(now) = factor_of(job, &signs)?.filter(|now| *now < factor * (1.0 - FALL)) {
                        (best, factor, better) = (signs, now, true);
                    }
                }
            }
        }
    }
    choice.widening = factor.max(1.0 + SLACK);
    job.wishes.widening = factor * (1.0 + 1e-4);
    let wishes = job.wishes.clone();
    let solved = job.solve(&wishes, Some(&best.imposed(z)))?;
    choice.taken = Some(Patterned { signs: best, solved });
    Ok(())
}

/// Changes of sign of the forms of a stretch, flat ones passed over.
fn changes(job: &Job, free: &Solved, from: usize, to: usize) -> usize {
    let values: Vec<f64> = job.forms[from..to].iter().map(|row| value(row, &free.net)).collect();
    let largest = values.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    let seen: Vec<f64> = values.into_iter().filter(|v| v.abs() > 1e-9 * largest).collect();
    seen.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count()
}

/// The stretch on which one change more saves most.
fn cheapest(z: &[f64], starts: &[usize], counts: &[usize], raw: &[usize]) -> Option<usize> {
    let cost = |counts: &[usize]| Signs::best(z, starts, counts).map(|signs| signs.cost.iter().sum::<f64>());
    let now = cost(counts)?;
    let gain = |stretch: usize| {
        let mut more = counts.to_vec();
        more[stretch] += 1;
        cost(&more).map_or(f64::NEG_INFINITY, |then| now - then)
    };
    (0..counts.len()).filter(|&s| counts[s] < raw[s]).max_by(|&a, &b| gain(a).total_cmp(&gain(b)))
}

/// What it comes to; the targets of the job are those that were met.
pub(super) struct Within {
    pub(super) free: Solved,
    pub(super) status: FairStatus,
    pub(super) diagnosis: Option<Diagnosis>,
    /// Whether targets were relaxed.
    pub(super) nearest: bool,
    /// Whether no tolerance would do.
    pub(super) contradictory: bool,
}
