//! Solving the fullness of both ends for displacement, LCB and waterplane area.
//!
//! Unknown are the fullnesses of entrance and run at the design waterline (eW, rW) and on the keel (eK, rK). For a
//! given eW, rW follows from the waterplane area (monotone, Brent's method); then volume and moment are nearly affine
//! in (eK, rK) and two or three Newton steps solve them. eW itself is the least extreme one: it minimises the distance
//! of LCF from its usual place and the difference of the vertical laws of both ends (Brent's minimisation inside the
//! best cell of a scan, so that the hull depends continuously on the particulars).

use argmin::core::{CostFunction, Executor, State};
use argmin::solver::brent::BrentOpt;

use super::form::{Form, HeightNode};
use crate::numeric::bracketed_root;
use crate::parametric::kernel::{HIGHEST_FULLNESS, LOWEST_FULLNESS};

/// What the fullness is solved for \[m, m^2, m^3, rad\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Goal {
    pub(super) volume: f64,
    pub(super) lcb: f64,
    pub(super) waterplane: f64,
    /// Usual place of LCF.
    pub(super) lcf: f64,
    /// Largest half angle of entrance.
    pub(super) half_entrance: f64,
}

const FULLEST: f64 = HIGHEST_FULLNESS - 0.01;

/// The form with fullness `ew`, `rw` at the waterline and `ek`, `rk` on the keel.
fn with(form: &Form, ew: f64, rw: f64, ek: f64, rk: f64) -> Form {
    let mut form = *form;
    (form.entrance.waterline, form.entrance.keel) = (ew, ek);
    (form.run.waterline, form.run.keel) = (rw, rk);
    form
}

/// rW for the waterplane area, given eW.
fn run_fullness(form: &Form, goal: &Goal, ew: f64) -> Option<f64> {
    let breadth = 2.0 * form.section.breadth_at(form.draught);
    let error = |rw: f64| {
        let form = with(form, ew, rw, LOWEST_FULLNESS, LOWEST_FULLNESS);
        breadth * form.waterline(form.draught).integrals().0 - goal.waterplane
    };
    bracketed_root(error, LOWEST_FULLNESS, FULLEST, 1e-13).ok()
}

/// The form of waterline fullness `ew` that has the volume, the LCB and the waterplane area; none when a keel fullness
/// would leave [lowest, waterline fullness].
pub(super) fn at_entrance(form: &Form, nodes: &[HeightNode], goal: &Goal, ew: f64) -> Option<Form> {
    let rw = run_fullness(form, goal, ew)?;
    let residual = |ek: f64, rk: f64| {
        let i = with(form, ew, rw, ek, rk).integrals(nodes);
        [i.volume / goal.volume - 1.0, (i.volume_moment / goal.volume - goal.lcb) / form.length]
    };
    let mut at = [0.5 * (LOWEST_FULLNESS + ew), 0.5 * (LOWEST_FULLNESS + rw)];
    for _ in 0..12 {
        let r = residual(at[0], at[1]);
        if r[0].abs() < 1e-13 && r[1].abs() < 1e-13 {
            return Some(with(form, ew, rw, at[0], at[1]));
        }
        let step = 1e-5;
        let (side_e, side_r) =
            (if at[0] + step < ew { step } else { -step }, if at[1] + step < rw { step } else { -step });
        let (a, b) = (residual(at[0] + side_e, at[1]), residual(at[0], at[1] + side_r));
        let matrix = nalgebra::Matrix2::new(
            (a[0] - r[0]) / side_e,
            (b[0] - r[0]) / side_r,
            (a[1] - r[1]) / side_e,
            (b[1] - r[1]) / side_r,
        );
        let delta = matrix.lu().solve(&nalgebra::Vector2::new(r[0], r[1]))?;
        let next = [at[0] - delta[0], at[1] - delta[1]];
        // Far outside: the nearly affine residual says that there is no solution here.
        if next[0] < LOWEST_FULLNESS - 0.02
            || next[0] > ew + 0.02
            || next[1] < LOWEST_FULLNESS - 0.02
            || next[1] > rw + 0.02
        {
            return None;
        }
        at = [next[0].clamp(LOWEST_FULLNESS, ew), next[1].clamp(LOWEST_FULLNESS, rw)];
    }
    None
}

/// How far a form is from an ordinary one; infinite when the entrance is too blunt.
fn extremeness(form: &Form, nodes: &[HeightNode], goal: &Goal) -> f64 {
    if form.half_entrance() > goal.half_entrance {
        return f64::INFINITY;
    }
    let i = form.integrals(nodes);
    let lcf = (i.waterplane_moment / i.waterplane - goal.lcf) / (0.03 * form.length);
    let (e, r) = (form.entrance, form.run);
    let laws = ((e.waterline - e.keel) - (r.waterline - r.keel)) / 0.15;
    let beyond = |law: f64, low: f64| ((low - law).max(0.0) + (law - 0.86).max(0.0)) / 0.02;
    lcf * lcf
        + laws * laws
        + [(e.keel, 0.53), (r.keel, 0.53), (e.waterline, 0.58), (r.waterline, 0.58)]
            .into_iter()
            .map(|(law, low)| beyond(law, low).powi(2))
            .sum::<f64>()
}

struct Search<'a> {
    form: &'a Form,
    nodes: &'a [HeightNode],
    goal: &'a Goal,
}

impl Search<'_> {
    fn cost_at(&self, ew: f64) -> f64 {
        at_entrance(self.form, self.nodes, self.goal, ew)
            .map_or(f64::INFINITY, |form| extremeness(&form, self.nodes, self.goal))
    }
}

impl CostFunction for Search<'_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, ew: &f64) -> Result<f64, argmin::core::Error> {
        let cost = self.cost_at(*ew);
        Ok(if cost.is_finite() { cost } else { 1e6 })
    }
}

/// A form with its distance from an ordinary one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Found {
    pub(super) form: Form,
    pub(super) extremeness: f64,
}

/// The least extreme form that reaches the goal; none when the scan meets none (`fine`: a scan for narrow ranges as
/// well).
pub(super) fn solve(form: &Form, nodes: &[HeightNode], goal: &Goal, fine: bool) -> Option<Found> {
    let search = Search { form, nodes, goal };
    let cells = 14;
    let place = |k: usize| LOWEST_FULLNESS + 0.01 + (FULLEST - LOWEST_FULLNESS - 0.01) * k as f64 / cells as f64;
    let costs: Vec<f64> = (0..=cells).map(|k| search.cost_at(place(k))).collect();
    let best = (0..=cells).min_by(|&a, &b| costs[a].total_cmp(&costs[b]))?;
    if !costs[best].is_finite() {
        return if fine { narrow(form, nodes, goal) } else { None };
    }
    let (low, high) = (place(best.saturating_sub(1)), place((best + 1).min(cells)));
    let refined = Executor::new(Search { form, nodes, goal }, BrentOpt::new(low, high).set_tolerance(1e-9, 1e-9))
        .configure(|state| state.max_iters(24))
        .timer(false)
        .run()
        .ok()
        .and_then(|result| result.state().get_best_param().copied())
        .unwrap_or(place(best));
    let ew = if search.cost_at(refined) <= costs[best] { refined } else { place(best) };
    let form = at_entrance(form, nodes, goal, ew)?;
    Some(Found { form, extremeness: extremeness(&form, nodes, goal) })
}

/// A finer scan, for goals that only a narrow range of entrances can reach.
fn narrow(form: &Form, nodes: &[HeightNode], goal: &Goal) -> Option<Found> {
    let cells = 60;
    (0..=cells)
        .filter_map(|k| {
            let ew = LOWEST_FULLNESS + (FULLEST - LOWEST_FULLNESS) * f64::from(k) / f64::from(cells);
            at_entrance(form, nodes, goal, ew)
        })
        .map(|form| Found { form, extremeness: extremeness(&form, nodes, goal) })
        .filter(|found| found.extremeness.is_finite())
        .min_by(|a, b| a.extremeness.total_cmp(&b.extremeness))
}

/// Intervals that the family can reach with the profiles, the parallel body and the section of `form`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Reach {
    /// Waterplane area \[m^2\].
    pub(super) waterplane: (f64, f64),
    /// Volume at the waterplane area of the goal \[m^3\].
    pub(super) volume: (f64, f64),
    /// x of LCB at the volume and waterplane area of the goal \[m\]; none when the volume is out of reach.
    pub(super) lcb: Option<(f64, f64)>,
}

/// What can be reached, by a scan of the entrance and of the balance between the ends.
pub(super) fn reach(form: &Form, nodes: &[HeightNode], goal: &Goal) -> Reach {
    let breadth = 2.0 * form.section.breadth_at(form.draught);
    let area = |w: f64| breadth * with(form, w, w, w, w).waterline(form.draught).integrals().0;
    let (mut volume, mut lcb) = ((f64::INFINITY, f64::NEG_INFINITY), (f64::INFINITY, f64::NEG_INFINITY));
    for k in 0..=24 {
        let ew = LOWEST_FULLNESS + (FULLEST - LOWEST_FULLNESS) * f64::from(k) / 24.0;
        let Some(rw) = run_fullness(form, goal, ew) else { continue };
        let at = |ek: f64, rk: f64| with(form, ew, rw, ek, rk).integrals(nodes);
        let of = |ek: f64, rk: f64| at(ek, rk).volume;
        volume = (volume.0.min(of(LOWEST_FULLNESS, LOWEST_FULLNESS)), volume.1.max(of(ew, rw)));
        // Ends of the segment of constant volume in the rectangle of keel fullness.
        for ek in [LOWEST_FULLNESS, ew] {
            if let Ok(rk) = bracketed_root(|rk| of(ek, rk) - goal.volume, LOWEST_FULLNESS, rw, 1e-9) {
                let i = at(ek, rk);
                let x = i.volume_moment / i.volume;
                lcb = (lcb.0.min(x), lcb.1.max(x));
            }
        }
        for rk in [LOWEST_FULLNESS, rw] {
            if let Ok(ek) = bracketed_root(|ek| of(ek, rk) - goal.volume, LOWEST_FULLNESS, ew, 1e-9) {
                let i = at(ek, rk);
                let x = i.volume_moment / i.volume;
                lcb = (lcb.0.min(x), lcb.1.max(x));
            }
        }
    }
    Reach { waterplane: (area(LOWEST_FULLNESS), area(FULLEST)), volume, lcb: (lcb.0 <= lcb.1).then_some(lcb) }
}
