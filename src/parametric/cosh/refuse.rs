//! The message when there is no hull: the infeasible target and the feasible interval.

use super::form::Form;
use super::resolve::Resolved;
use super::solve::{self, Goal, Reach};
use crate::hull::Hull;
use crate::parametric::{Infeasible, ValueOrigin};

/// The union of what is reached with each waterplane area.
fn union(reaches: &[Reach]) -> Reach {
    let join = |a: (f64, f64), b: (f64, f64)| (a.0.min(b.0), a.1.max(b.1));
    let empty = (f64::INFINITY, f64::NEG_INFINITY);
    reaches.iter().fold(Reach { waterplane: empty, volume: empty, lcb: None }, |all, one| Reach {
        waterplane: join(all.waterplane, one.waterplane),
        volume: join(all.volume, one.volume),
        lcb: match (all.lcb, one.lcb) {
            (Some(a), Some(b)) => Some(join(a, b)),
            (a, b) => a.or(b),
        },
    })
}

impl Resolved {
    /// Which target is infeasible, with the feasible intervals; over all waterplane areas where none was given.
    pub(super) fn infeasible(&self, form: &Form, goal: &Goal) -> Vec<Infeasible> {
        let (l, lb) = (self.length, self.length * self.breadth);
        let nodes = form.height_nodes();
        let given = self.waterplane.origin == ValueOrigin::Given;
        let areas = if given { vec![goal.waterplane / lb] } else { self.waterplanes() };
        let reaches: Vec<Reach> = areas
            .iter()
            .step_by(2)
            .map(|area| solve::reach(form, &nodes, &Goal { waterplane: area * lb, ..*goal }))
            .collect();
        let reach = union(&reaches);
        let (wl, wh) = (reach.waterplane.0 / lb, (reach.waterplane.1 / lb).min(1.0));
        let cwp = goal.waterplane / lb;
        let cwp_text = if given { format!("Cwp {cwp:.4}") } else { "any Cwp".to_owned() };
        let with = format!(
            "a parallel body from {:.3} to {:.3} m, a cut-up at {:.3} m",
            form.aft_shoulder, form.fore_shoulder, form.stern.cut_up
        );
        let box_volume = lb * self.draught;
        let percent = |x: f64| 100.0 * (x / l - 0.5);
        let ends = ["parallel_body", "entrance_length", "run_length", "cut_up"];
        let keys = |first: &[&'static str]| first.iter().copied().chain(ends).collect::<Vec<_>>();
        let (code, keys, message) = if given && (cwp < wl || cwp > wh) {
            ("E107", keys(&["Cwp"]), format!("Cwp {cwp:.4} is out of reach: {wl:.4} to {wh:.4} with {with}"))
        } else if goal.volume < reach.volume.0 || goal.volume > reach.volume.1 {
            let (low, high) = (reach.volume.0 / box_volume, reach.volume.1 / box_volume);
            let hint = match (given, goal.volume > reach.volume.1) {
                (true, true) => "raise Cwp or lengthen the parallel body",
                (true, false) => "lower Cwp, shorten the parallel body or cut the ends away",
                (false, true) => "lengthen the parallel body or shorten the cut-up",
                (false, false) => "shorten the parallel body or cut the ends away",
            };
            (
                "E108",
                keys(&["Cb", "Cwp", "Cm"]),
                format!(
                    "Cb {:.4} is out of reach: {low:.4} to {high:.4} with Cm {:.4}, {cwp_text}, {with}; {hint}",
                    self.block.value, self.midship.value
                ),
            )
        } else if let Some((low, high)) = reach.lcb.filter(|r| goal.lcb < r.0 || goal.lcb > r.1) {
            let way = if goal.lcb > high { "forward" } else { "aft" };
            (
                "E104",
                keys(&["LCB"]),
                format!(
                    "LCB {:+.2} % of Lpp from midship is out of reach: {:+.2} to {:+.2} % with Cb {:.4}, {cwp_text}, {with}; move the parallel body {way}{}",
                    percent(goal.lcb),
                    percent(low),
                    percent(high),
                    self.block.value,
                    if given { " or lower Cwp" } else { "" }
                ),
            )
        } else if self.half_entrance.is_finite() {
            (
                "E114",
                vec!["entrance_half_angle_max"],
                format!(
                    "no entrance below {:.1} deg reaches Cb {:.4} and LCB {:+.2} % with {cwp_text}, {with}; allow a larger angle or lengthen the entrance",
                    self.half_entrance.to_degrees(),
                    self.block.value,
                    percent(goal.lcb)
                ),
            )
        } else {
            (
                "E108",
                keys(&["Cb", "Cwp", "LCB"]),
                format!(
                    "Cb {:.4} and LCB {:+.2} % are infeasible together with {cwp_text}, {with}; leave LCB{} free or change the ends",
                    self.block.value,
                    percent(goal.lcb),
                    if given { " or Cwp" } else { "" }
                ),
            )
        };
        vec![Infeasible { code, keys, message }]
    }

    /// A net that does not follow its form, because an end is so full that it is nearly a step: wider than B, negative,
    /// or with tumblehome.
    pub(super) fn misshapen(&self, hull: &Hull, form: &Form) -> Option<Infeasible> {
        let half = 0.5 * self.breadth;
        let surface = hull.surface();
        let (low, high) = surface.v().domain();
        let mut below: Vec<(f64, f64)> = Vec::new();
        let mut worst: f64 = 0.0;
        for j in 0..=80 {
            let line = surface.curve_at_v(low + (high - low) * f64::from(j) / 80.0);
            let (a, b) = line.knots().domain();
            let points: Vec<(f64, f64)> = (0..=120)
                .map(|k| {
                    let [x, y, _] = line.eval(a + (b - a) * f64::from(k) / 120.0);
                    (x, y)
                })
                .collect();
            for &(x, y) in &points {
                worst = worst.max(y - half).max(-y);
                // Half-breadth of the waterline below at the same x, between its points: chords lie inside a convex line.
                let at = below.partition_point(|p| p.0 < x);
                if at > 0 && at < below.len() {
                    let ((x0, y0), (x1, y1)) = (below[at - 1], below[at]);
                    let under = if x1 > x0 { y0 + (y1 - y0) * (x - x0) / (x1 - x0) } else { y0.min(y1) };
                    worst = worst.max(under - y - 1e-3 * half);
                }
            }
            below = points;
        }
        (worst > 1e-4 * half).then(|| Infeasible {
            code: "E115",
            keys: vec!["Cb", "Cwp", "LCB", "transom_height", "transom_immersion", "cut_up"],
            message: format!(
                "the ends become so full (entrance {:.3}, run {:.3} of their length times breadth) that the surface bulges by {:.3} m; lower Cb, shorten the cut-up or lengthen the parallel body",
                form.entrance.waterline, form.run.waterline, worst
            ),
        })
    }
}
