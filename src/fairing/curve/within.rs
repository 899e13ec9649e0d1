//! The program without signs, kept near the points between them; where it has no answer, why, and the best compromise:
//! tolerances a little wider, or within the tolerances the nearest that can be had of area, centroid and slopes.

use super::super::infeasible::{Target, diagnose, least_widening, nearest};
use super::super::model::{Limit, value};
use super::super::program::{Between, Solved, Wishes};
use super::fair::{Job, SLACK, Within};
use super::given::CurveError;
use super::result::FairStatus;
use super::wishes::{Wished, quantity};
use crate::qp::Status;

/// Least widening from which the wishes give way and not the tolerances.
const FAR: f64 = 1.5;

/// The part of the way from the nearest that can be had, where no point has room left, to the fairest within the
/// tolerances that is gone back.
const GONE_BACK: f64 = 0.5;

/// Most times that limits are added which an answer breaks.
const ROUNDS: usize = 10;

/// Those of the limits that a net breaks.
fn broken<'a>(sites: &'a [Between], net: &'a [f64], widening: f64) -> impl Iterator<Item = Between> + 'a {
    let far = move |site: &&Between| {
        let band = site.tolerance * widening + site.room;
        (value(&site.row, net) - site.value).abs() > band * (1.0 + SLACK)
    };
    sites.iter().filter(far).cloned()
}

impl Job<'_> {
    /// Solves with the limits that answers break.
    fn settled(&mut self, sites: &[Between]) -> Result<Solved, CurveError> {
        let mut solved = self.solve(&self.wishes.clone(), None)?;
        for _ in 0..ROUNDS {
            if !solved.is_optimal() || !self.limit(sites, &solved.net) {
                break;
            }
            solved = self.solve(&self.wishes.clone(), None)?;
        }
        Ok(solved)
    }

    /// Adds the limits that a net breaks; false where it breaks none.
    fn limit(&mut self, sites: &[Between], net: &[f64]) -> bool {
        let slack = SLACK * self.model.readings.iter().fold(0.0, |most: f64, reading| most.max(reading.value.abs()));
        let below = self.not_below(sites).filter(|limit| value(&limit.row, net) < -slack).collect::<Vec<Limit>>();
        let wishes = &mut self.wishes;
        let before = wishes.between.len() + wishes.breadths.len();
        wishes.between.extend(broken(sites, net, wishes.widening));
        wishes.breadths.extend(below);
        wishes.between.len() + wishes.breadths.len() > before
    }

    /// A curve of points that are nowhere below 0 does not go below either.
    pub(super) fn not_below<'s>(&self, sites: &'s [Between]) -> impl Iterator<Item = Limit> + use<'s> {
        let positive = self.model.readings.iter().all(|reading| reading.value >= 0.0);
        let limit = |site: &Between| Limit { row: site.row.clone(), lower: 0.0, upper: f64::INFINITY };
        sites.iter().filter(move |_| positive).map(limit)
    }

    /// Solves for what is wished, or the best compromise; `reference` is the net as it was smoothed.
    pub(super) fn within(
        &mut self,
        wished: &[Wished],
        sites: &[Between],
        reference: &[f64],
    ) -> Result<Within, CurveError> {
        let free = self.settled(sites)?;
        let contradicts = |solved: &Solved| {
            let off = solved.certificate.max_violation;
            solved.solution.status == Status::Infeasible || (!solved.is_optimal() && off > SLACK)
        };
        let mut found =
            Within { free, status: FairStatus::Optimal, diagnosis: None, nearest: false, contradictory: false };
        if !contradicts(&found.free) {
            return Ok(found);
        }
        found.status = FairStatus::Infeasible;
        let solver = &self.settings.solver;
        // Linear programs have no energy to keep them near.
        let breadths = self.not_below(sites).collect();
        let wishes = Wishes { between: sites.to_vec(), breadths, ..self.wishes.clone() };
        let plain = self.program(&wishes, None);
        let least = least_widening(&plain, solver, |_, _| None)?;
        let reference = self.space.curve(reference)?;
        let target = |wish: &Wished| {
            let here = wish.with_target(&self.space, quantity(wish.kind, &reference));
            let row = self.smoother.reduced.row(&here.limit.row).0;
            Target { limits: [wish.target; 2], scale: wish.scale(&self.space), row }
        };
        let targets: Vec<Target> = wished.iter().map(target).collect();
        let of = |k: usize, x: &[f64]| {
            let curve = self.space.curve(&self.smoother.reduced.expand(x)).ok()?;
            Some(quantity(wished[k].kind, &curve)).filter(|value| value.is_finite())
        };
        let (diagnosis, mut programs) = diagnose(plain.clone(), least, &targets, of, solver, |_| None)?;
        let mut near = None;
        if least.is_none_or(|least| least > FAR) && !wished.is_empty() {
            let (x, more) = nearest(plain, |_| true, &targets, solver, |_| None)?;
            programs += more;
            near = x.map(|[near, fair]| {
                let x: Vec<f64> = near.iter().zip(&fair).map(|(near, fair)| near + GONE_BACK * (fair - near)).collect();
                let had = |k: usize| of(k, &x).map(|value| wished[k].with_target(&self.space, value).limit);
                (0..wished.len()).filter_map(had).collect::<Vec<Limit>>()
            });
        }
        self.programs += programs + 1;
        found.diagnosis = Some(diagnosis);
        match (near.filter(|limits| limits.len() == wished.len()), least) {
            (Some(limits), _) => {
                self.wishes.constraints = limits;
                found.nearest = true;
            }
            (None, Some(factor)) => self.wishes.widening = factor * (1.0 + SLACK),
            // No tolerance would do: what is locked and wished contradicts itself.
            (None, None) => {
                self.wishes.constraints.clear();
                found.contradictory = true;
            }
        }
        found.free = self.settled(sites)?;
        Ok(found)
    }
}
