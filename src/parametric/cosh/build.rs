//! From numbers to the hull: the search over what was left free, the net, and what to say when there is no hull.

use super::book::Sourced;
use super::form::{Form, Law, Stem, Stern};
use super::net::{self, Exact};
use super::resolve::Resolved;
use super::solve::{self, Goal};
use crate::hull::PrincipalParticulars;
use crate::numeric::bracketed_root;
use crate::parametric::{DesignValue, Generated, Infeasible, Target, ValueOrigin, achieved};

/// Extremeness below which no other waterplane coefficient is tried.
const ORDINARY: f64 = 4.0;

impl Resolved {
    /// The form with shoulders and profiles, its fullness still open; `rise` scales a cut-up that is ours to choose.
    fn form(&self, (aft_shoulder, fore_shoulder): (f64, f64), rise: f64) -> Form {
        let law = Law { keel: 0.6, waterline: 0.7, character: self.character, flare: 0.0 };
        // A preset that starts to rise forward of the shoulder gives way.
        let cut_up = match self.cut_up.origin {
            ValueOrigin::Given => self.cut_up.value,
            _ => (rise * self.cut_up.value).min(0.85 * aft_shoulder),
        };
        Form {
            length: self.length,
            draught: self.draught,
            depth: self.depth,
            section: self.section,
            stem: Stem { length: self.length, draught: self.draught, rake: self.rake, forefoot: self.forefoot },
            stern: Stern {
                cut_up,
                end: -self.overhang,
                height: self.transom_height.value,
                sweep: self.sweep,
                transom: self.transom,
            },
            aft_shoulder,
            fore_shoulder,
            entrance: law,
            run: law,
            softness: 0.0,
        }
    }

    /// Whether run and entrance have a length on the keel.
    fn has_ends(form: &Form) -> bool {
        let least = 0.02 * form.length;
        form.stern.cut_up + least <= form.aft_shoulder && form.fore_shoulder + least <= form.stem.at(0.0)
    }

    pub(super) fn goal(&self, waterplane: f64, lcb: f64) -> Goal {
        Goal {
            volume: self.block.value * self.length * self.breadth * self.draught,
            lcb,
            waterplane: waterplane * self.length * self.breadth,
            lcf: lcb - 0.02 * self.length,
            half_entrance: self.half_entrance,
        }
    }

    /// Shoulders to try, the usual ones first.
    fn bodies(&self) -> Vec<(f64, f64)> {
        if let (Some(aft), Some(fore)) = (self.aft_shoulder, self.fore_shoulder) {
            return vec![(aft, fore)];
        }
        let (l, middle) = (self.length, 0.5 * self.length);
        let usual = ((self.block.value / self.midship.value - 0.66) / 0.34).max(0.0);
        [0.0, -0.05, 0.05, -0.1, 0.1, 0.15, -0.15]
            .into_iter()
            .map(|step: f64| if usual + step < 0.03 { 0.0 } else { usual + step })
            .map(|part| {
                let half = 0.5 * part * l;
                match (self.aft_shoulder, self.fore_shoulder) {
                    (Some(aft), None) => (aft, (aft + 2.0 * half).min(0.9 * l)),
                    (None, Some(fore)) => ((fore - 2.0 * half).max(0.1 * l), fore),
                    _ => {
                        // Near LCB, and always over midship, where Cm is measured.
                        let centre = (middle + 0.8 * (self.lcb.value - middle)).clamp(middle - half, middle + half);
                        (centre - half, centre + half)
                    }
                }
            })
            .fold(Vec::new(), |mut kept, body| {
                if !kept.contains(&body) {
                    kept.push(body);
                }
                kept
            })
    }

    /// Waterplane coefficients to try, the usual one first.
    pub(super) fn waterplanes(&self) -> Vec<f64> {
        let usual = self.waterplane.value;
        if self.waterplane.origin == ValueOrigin::Given {
            return vec![usual];
        }
        std::iter::once(usual)
            .chain((1..=10).flat_map(|k| [0.012, -0.012].map(|s| usual + s * f64::from(k))))
            .filter(|c| *c < 0.99 && *c > self.block.value)
            .collect()
    }

    /// Searches what was left free: the first ordinary form, else the least extreme one; with its waterplane coefficient
    /// and LCB.
    fn search(&self) -> Option<(Form, Sourced, Sourced)> {
        let bodies = self.bodies();
        let mut best: Option<(f64, Form, Sourced, Sourced)> = None;
        for fine in [false, true] {
            if fine && self.waterplane.origin != ValueOrigin::Given {
                break;
            }
            let usual = bodies.iter().map(|&body| (body, 1.0));
            let others = [0.6, 1.4, 0.3].map(|rise| (bodies[0], rise));
            for (body, rise) in usual.chain(others) {
                if (rise - 1.0f64).abs() > 1e-9 && self.cut_up.origin == ValueOrigin::Given {
                    break;
                }
                let form = self.form(body, rise);
                if !Self::has_ends(&form) {
                    continue;
                }
                let nodes = form.height_nodes();
                for waterplane in self.waterplanes() {
                    let goal = self.goal(waterplane, self.lcb.value);
                    let Some(found) = solve::solve(&form, &nodes, &goal, fine) else { continue };
                    let same = (waterplane - self.waterplane.value).abs() < 1e-12;
                    let origin = if same { self.waterplane.origin } else { ValueOrigin::Solved };
                    let far = ((waterplane - self.waterplane.value) / 0.04).powi(2);
                    let cost = found.extremeness + far;
                    if best.as_ref().is_none_or(|b| cost < b.0) {
                        best = Some((cost, found.form, Sourced { value: waterplane, origin }, self.lcb));
                    }
                    if found.extremeness < ORDINARY {
                        break;
                    }
                }
                if best.is_some() {
                    break;
                }
            }
            if best.is_none() && self.lcb.origin != ValueOrigin::Given {
                best = self.search_lcb(bodies[0]);
            }
            if best.is_some() {
                break;
            }
        }
        best.map(|(_, form, waterplane, lcb)| (form, waterplane, lcb))
    }

    /// An LCB of our own choice yields: into the range that the usual body can have.
    fn search_lcb(&self, body: (f64, f64)) -> Option<(f64, Form, Sourced, Sourced)> {
        let form = self.form(body, 1.0);
        if !Self::has_ends(&form) {
            return None;
        }
        let nodes = form.height_nodes();
        self.waterplanes().into_iter().find_map(|waterplane| {
            let goal = self.goal(waterplane, self.lcb.value);
            let (low, high) = solve::reach(&form, &nodes, &goal).lcb?;
            let value = self.lcb.value.clamp(low + 0.25 * (high - low), high - 0.25 * (high - low));
            let found = solve::solve(&form, &nodes, &self.goal(waterplane, value), true)?;
            let origin = ValueOrigin::Solved;
            Some((found.extremeness, found.form, Sourced { value: waterplane, origin }, Sourced { value, origin }))
        })
    }

    /// Breadth of the transom at the deck over B, with the sweep `sweep`.
    fn transom_at(form: &Form, sweep: f64) -> f64 {
        let mut trial = *form;
        trial.stern.sweep = sweep;
        trial.half_breadth(trial.stern.end, trial.depth) / trial.section.half_breadth
    }

    /// A form whose transom can have the breadth `wanted`: the one given, or, where height and cut-up are ours to choose,
    /// the nearest to the preset.
    fn transom_in_reach(&self, form: &Form, goal: &Goal, wanted: f64) -> Option<Form> {
        let holds = |form: &Form| {
            Self::transom_at(form, 0.0) <= wanted && wanted <= Self::transom_at(form, Stern::LARGEST_SWEEP)
        };
        if holds(form) {
            return Some(*form);
        }
        let free = |wanted: Sourced, scales: &'static [f64]| {
            if wanted.origin == ValueOrigin::Given { &scales[..1] } else { scales }
        };
        let heights = free(self.transom_height, &[1.0, 1.06, 0.94, 0.88, 0.8]);
        let rises = free(self.cut_up, &[1.0, 0.8, 1.2, 0.6, 1.5, 0.4, 0.25]);
        rises.iter().flat_map(|rise| heights.iter().map(move |height| (rise, height))).find_map(|(rise, height)| {
            let mut trial = *form;
            trial.stern.cut_up = (form.stern.cut_up * rise).min(0.85 * form.aft_shoulder);
            trial.stern.height = (form.stern.height * height).min(0.5 * (self.draught + self.depth));
            let found = solve::solve(&trial, &trial.height_nodes(), goal, false)?;
            holds(&found.form).then_some(found.form)
        })
    }

    /// The sweep of the stern profile that gives the transom its breadth, by repeated solution at one entrance.
    fn fit_transom(&self, form: Form, goal: &Goal) -> Result<Form, Vec<Infeasible>> {
        let Some(wanted) = self.transom_breadth else { return Ok(form) };
        let refused = |form: &Form| {
            let (low, high) = (Self::transom_at(form, 0.0), Self::transom_at(form, Stern::LARGEST_SWEEP));
            vec![Infeasible {
                code: "E112",
                keys: vec!["transom_beam", "transom_height", "cut_up"],
                message: format!(
                    "a transom of {wanted:.3} B at the deck is out of reach: {low:.3} to {high:.3} B with its lowest point at {:.3} m and the cut-up at {:.3} m; a lower transom or a longer cut-up widens it",
                    form.stern.height, form.stern.cut_up
                ),
            }]
        };
        let Some(mut form) = self.transom_in_reach(&form, goal, wanted) else { return Err(refused(&form)) };
        for _ in 0..40 {
            let excess = |sweep| Self::transom_at(&form, sweep) - wanted;
            let Ok(sweep) = bracketed_root(excess, 0.0, Stern::LARGEST_SWEEP, 1e-13) else {
                return Err(refused(&form));
            };
            let change = (sweep - form.stern.sweep).abs();
            form.stern.sweep = sweep;
            let nodes = form.height_nodes();
            form = match solve::at_entrance(&form, &nodes, goal, form.entrance.waterline)
                .or_else(|| solve::solve(&form, &nodes, goal, true).map(|found| found.form))
            {
                Some(found) => found,
                None => return Err(self.infeasible(&form, goal)),
            };
            if change < 1e-11 {
                break;
            }
        }
        Ok(form)
    }

    /// Gives the ends the soft section, and solves again for what that leaves to do; where the fullness has no room for
    /// it, the form stays as it is.
    fn soften(&self, form: Form, goal: &Goal) -> Result<Form, Vec<Infeasible>> {
        let mut soft = form;
        soft.soften(self.midship.value);
        if soft.softness <= 0.0 {
            return Ok(form);
        }
        for _ in 0..6 {
            let nodes = soft.height_nodes();
            let (volume, moment) = soft.softening(&nodes);
            let left = goal.volume - volume;
            let goal = Goal { volume: left, lcb: (goal.volume * goal.lcb - moment) / left, ..*goal };
            match solve::at_entrance(&soft, &nodes, &goal, soft.entrance.waterline) {
                Some(found) => soft = self.fit_transom(found, &goal)?,
                None => return Ok(form),
            }
        }
        Ok(soft)
    }

    /// The flare above the waterline at 0.9 Lpp.
    fn fit_flare(&self, form: Form) -> Result<Form, Vec<Infeasible>> {
        let Some(wanted) = self.flare else { return Ok(form) };
        let angle = |part: f64| {
            let mut trial = form;
            trial.entrance.flare = part;
            let x = 0.9 * trial.length;
            let out = trial.half_breadth(x, trial.depth) - trial.half_breadth(x, trial.draught);
            (out / (trial.depth - trial.draught)).atan()
        };
        match bracketed_root(|part| angle(part) - wanted, 0.0, 1.0, 1e-13) {
            Ok(part) => {
                let mut form = form;
                form.entrance.flare = part;
                Ok(form)
            }
            Err(_) => Err(vec![Infeasible {
                code: "E113",
                keys: vec!["flare"],
                message: format!(
                    "a mean flare of {:.1} deg at 0.9 Lpp is out of reach: {:.1} to {:.1} deg with this stem and waterline",
                    wanted.to_degrees(),
                    angle(0.0).to_degrees(),
                    angle(1.0).to_degrees()
                ),
            }]),
        }
    }

    /// The hull.
    ///
    /// # Errors
    /// The infeasible target, with the feasible intervals.
    pub(super) fn build(mut self, name: &str) -> Result<Generated, Vec<Infeasible>> {
        let Some((form, waterplane, lcb)) = self.search() else {
            let bodies = self.bodies();
            let forms = bodies.iter().map(|&body| self.form(body, 1.0));
            let Some(form) = forms.clone().find(Self::has_ends) else {
                let form = self.form(bodies[0], 1.0);
                return Err(vec![Infeasible {
                    code: "E109",
                    keys: vec!["cut_up", "parallel_body", "run_length", "entrance_length", "forefoot"],
                    message: format!(
                        "the keel runs from the cut-up at {:.3} m to the forefoot at {:.3} m and must reach beyond the parallel body, {:.3} to {:.3} m, by 2 % of Lpp at each end; move one of them",
                        form.stern.cut_up,
                        form.stem.at(0.0),
                        form.aft_shoulder,
                        form.fore_shoulder
                    ),
                }]);
            };
            return Err(self.infeasible(&form, &self.goal(self.waterplane.value, self.lcb.value)));
        };
        let goal = self.goal(waterplane.value, lcb.value);
        let form = self.fit_flare(self.soften(self.fit_transom(form, &goal)?, &goal)?)?;

        let (l, b, t) = (self.length, self.breadth, self.draught);
        let particulars =
            PrincipalParticulars { length_between_perpendiculars: l, breadth: b, draught: Some(t), depth: self.depth };
        let at_midship = form.aft_shoulder <= 0.5 * l && form.fore_shoulder >= 0.5 * l;
        let station = if at_midship { 0.5 * l } else { 0.5 * (form.aft_shoulder + form.fore_shoulder) };
        let exact = Exact {
            volume: goal.volume,
            volume_moment: goal.volume * goal.lcb,
            section: (station, self.midship.value * b * t),
            waterplane: goal.waterplane,
        };
        let hull = net::interpolate(name, &form, particulars, &self.sheer)
            .and_then(|hull| net::correct(&hull, &form, &exact))
            .map_err(|error| {
                vec![Infeasible {
                    code: "E199",
                    keys: vec!["Lpp"],
                    message: format!("the surface could not be built: {error}"),
                }]
            })?;

        if let Some(problem) = self.misshapen(&hull, &form) {
            return Err(vec![problem]);
        }
        let [cb, cm, xcb, cwp] = achieved(&hull);
        let cx = crate::hull::Functional::SectionArea { x: station }.value(&hull, t) / (b * t);
        let section = if at_midship { ("CM", cm) } else { ("CX", cx) };
        if !at_midship {
            self.remarks.push(crate::parametric::Remark {
                code: "W203",
                key: "Cm",
                message: format!(
                    "the parallel body does not reach Lpp/2: Cm is held at the largest section, x = {station:.3} m"
                ),
            });
        }
        let target = |key, requested, achieved, origin| Target { key, requested, achieved, origin };
        let targets = vec![
            target("CB", self.block.value, cb, self.block.origin),
            target(section.0, self.midship.value, section.1, self.midship.origin),
            target("XCB", lcb.value, xcb, lcb.origin),
            target("CWP", waterplane.value, cwp, waterplane.origin),
        ];
        self.note_solved(&form, waterplane, lcb);
        Ok(Generated { hull, values: self.values, targets, remarks: self.remarks })
    }

    /// Enters what was solved into the list of values.
    fn note_solved(&mut self, form: &Form, waterplane: Sourced, lcb: Sourced) {
        let cut_up = Sourced {
            value: form.stern.cut_up,
            origin: if (form.stern.cut_up - self.cut_up.value).abs() < 1e-12 {
                self.cut_up.origin
            } else {
                ValueOrigin::Solved
            },
        };
        let height = Sourced {
            value: form.stern.height,
            origin: if (form.stern.height - self.transom_height.value).abs() < 1e-12 {
                self.transom_height.origin
            } else {
                ValueOrigin::Solved
            },
        };
        for (key, sourced, why) in [
            ("transom_height", height, "for the breadth of the transom"),
            ("cut_up", cut_up, "the nearest to the preset that Cb, LCB and Cwp allow"),
            ("Cwp", waterplane, "nearest to the usual value that Cb and LCB allow"),
            ("LCB", lcb, "nearest to the usual value that Cb and Cwp allow"),
        ] {
            if let Some(value) = self.values.iter_mut().find(|v| v.key == key)
                && sourced.origin == ValueOrigin::Solved
            {
                (value.value, value.origin, value.source) = (sourced.value, ValueOrigin::Solved, why.to_owned());
            }
        }
        let given = self.aft_shoulder.is_some() && self.fore_shoulder.is_some();
        let body = if given { ValueOrigin::Given } else { ValueOrigin::Preset };
        let source = if given { String::new() } else { "(Cp - 0.66) / 0.34 of Lpp, near LCB".to_owned() };
        let mut add = |key, name, value, unit, origin, source: &str| {
            self.values.push(DesignValue { key, name, value, unit, origin, source: source.to_owned() });
        };
        add("parallel_body_from", "aft end of the parallel body", form.aft_shoulder, "m", body, &source);
        add("parallel_body_to", "fore end of the parallel body", form.fore_shoulder, "m", body, &source);
        let solved = "for Cb, LCB and Cwp";
        add(
            "entrance_fullness",
            "fullness of the entrance at the design waterline",
            form.entrance.waterline,
            "-",
            ValueOrigin::Solved,
            solved,
        );
        add(
            "entrance_fullness_keel",
            "fullness of the entrance on the keel",
            form.entrance.keel,
            "-",
            ValueOrigin::Solved,
            solved,
        );
        add(
            "run_fullness",
            "fullness of the run at the design waterline",
            form.run.waterline,
            "-",
            ValueOrigin::Solved,
            solved,
        );
        add("run_fullness_keel", "fullness of the run on the keel", form.run.keel, "-", ValueOrigin::Solved, solved);
        add(
            "entrance_half_angle",
            "half angle of entrance",
            form.half_entrance().to_degrees(),
            "deg",
            ValueOrigin::Solved,
            solved,
        );
        if self.transom && self.transom_breadth.is_none() {
            let beam = form.half_breadth(form.stern.end, form.depth) / form.section.half_breadth;
            add(
                "transom_beam",
                "breadth of the transom at the deck over B",
                beam,
                "-",
                ValueOrigin::Solved,
                "by the stern profile",
            );
        }
    }
}
