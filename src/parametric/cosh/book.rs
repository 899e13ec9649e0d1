//! The book that values and problems are entered into while the gaps of the targets are filled, and the parts of the
//! design that are checked on their own: the midship section and the shoulders.

use super::DesignTargets;
use crate::parametric::midship::{MidshipProblem, MidshipSection};
use crate::parametric::presets::{Preset, ShipType};
use crate::parametric::{DesignValue, Infeasible, Remark, ValueOrigin};

/// A number with its origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sourced {
    pub(super) value: f64,
    pub(super) origin: ValueOrigin,
}

/// Collects values and problems while gaps are filled.
pub(super) struct Ledger {
    pub(super) values: Vec<DesignValue>,
    pub(super) problems: Vec<Infeasible>,
}

impl Ledger {
    pub(super) fn problem(&mut self, code: &'static str, keys: &[&'static str], message: String) {
        self.problems.push(Infeasible { code, keys: keys.to_vec(), message });
    }

    /// A value that is given or filled in, checked against its range (in the unit of the message).
    #[allow(clippy::too_many_arguments, reason = "one line a value in the table of values below")]
    pub(super) fn take(
        &mut self,
        key: &'static str,
        name: &'static str,
        unit: &'static str,
        scale: f64,
        given: Option<f64>,
        default: f64,
        source: &str,
        range: (f64, f64),
    ) -> Sourced {
        let (value, origin) = given.map_or((default, ValueOrigin::Preset), |value| (value, ValueOrigin::Given));
        let shown = value * scale;
        if !value.is_finite() || shown < range.0 || shown > range.1 {
            let unit = if unit == "-" { String::new() } else { format!(" {unit}") };
            let range = match (range.0.is_finite(), range.1.is_finite()) {
                (true, true) => format!("between {:.4} and {:.4}{unit}", range.0, range.1),
                (true, false) => format!("at least {:.4}{unit}", range.0),
                _ => format!("at most {:.4}{unit}", range.1),
            };
            self.problem("E101", &[key], format!("{key} ({name}) is {shown:.4}{unit}; it must be {range}"));
        }
        let source = if origin == ValueOrigin::Given { String::new() } else { source.to_owned() };
        self.values.push(DesignValue { key, name, value: shown, unit, origin, source });
        Sourced { value, origin }
    }
}

/// The section of the midship coefficient; its problem goes into the book.
pub(super) fn midship_section(
    book: &mut Ledger,
    requested: &DesignTargets,
    half: f64,
    draught: f64,
    keel: f64,
    midship: Sourced,
) -> Option<MidshipSection> {
    let (breadth, cm) = (2.0 * half, midship.value);
    let solved = MidshipSection::solve(half, draught, keel, cm, requested.deadrise, requested.bilge_radius);
    let both = requested.deadrise.zip(requested.bilge_radius);
    match solved {
        Ok(section) => {
            if let Some((deadrise, radius)) = both
                && (section.deadrise - deadrise).abs() > 1e-4
            {
                book.problem(
                    "E106",
                    &["Cm", "bilge_radius", "deadrise"],
                    format!(
                        "Cm {cm:.4} with a bilge radius of {radius:.3} m needs a rise of floor of {:.2} deg; you set {:.2} deg. Leave one of the three out",
                        section.deadrise.to_degrees(),
                        deadrise.to_degrees()
                    ),
                );
            }
            for (key, name, given, value, unit) in [
                ("bilge_radius", "bilge radius", requested.bilge_radius.is_some(), section.radius, "m"),
                ("deadrise", "rise of floor", requested.deadrise.is_some(), section.deadrise.to_degrees(), "deg"),
            ] {
                if !given {
                    let source = format!("for Cm {cm:.4}");
                    book.values.push(DesignValue { key, name, value, unit, origin: ValueOrigin::Solved, source });
                }
            }
            Some(section)
        }
        Err(problem) => {
            let smallest = MidshipSection::smallest_coefficient(half, draught, keel);
            let text = match problem {
                MidshipProblem::Bilge { radius, largest } => format!(
                    "Cm {cm:.4} (B {breadth:.3}, T {draught:.3}) needs a bilge radius of {radius:.3} m where {largest:.3} m fits: one circular bilge cannot do it with this rise of floor. Leave the rise of floor free, or use Cm of at least {smallest:.3}"
                ),
                MidshipProblem::Floor { largest } => format!(
                    "Cm {cm:.4} allows a rise of floor of at most {:.2} deg, and then a hard chine; lower the rise or Cm",
                    largest.to_degrees()
                ),
                MidshipProblem::Coefficient { lowest, highest } if lowest > highest => format!(
                    "a bilge radius of {:.3} m does not fit B {breadth:.3} m and T {draught:.3} m at any rise of floor; use a smaller one",
                    requested.bilge_radius.unwrap_or_default()
                ),
                MidshipProblem::Coefficient { lowest, highest } => format!(
                    "with this bilge radius Cm lies between {lowest:.4} and {highest:.4} whatever the rise of floor; you set {cm:.4}"
                ),
            };
            book.problem("E106", &["Cm", "bilge_radius", "deadrise"], text);
            None
        }
    }
}

/// Shoulders that the targets fix: fore, aft.
pub(super) fn shoulders(book: &mut Ledger, requested: &DesignTargets, length: f64) -> (Option<f64>, Option<f64>) {
    let mut fore = requested.parallel_body.map(|b| b[1]);
    let mut aft = requested.parallel_body.map(|b| b[0]);
    if let Some(entrance) = requested.entrance_length {
        book.take(
            "entrance_length",
            "length of entrance",
            "m",
            1.0,
            Some(entrance),
            entrance,
            "",
            (0.05 * length, 0.9 * length),
        );
        if fore.is_some_and(|x| (x - (length - entrance)).abs() > 1e-6 * length) {
            book.problem(
                "E109",
                &["parallel_body", "entrance_length"],
                "the parallel body and the length of entrance disagree; give one of them".to_owned(),
            );
        }
        fore = Some(length - entrance);
    }
    if let Some(run) = requested.run_length {
        book.take("run_length", "length of run", "m", 1.0, Some(run), run, "", (0.05 * length, 0.9 * length));
        if aft.is_some_and(|x| (x - run).abs() > 1e-6 * length) {
            book.problem(
                "E109",
                &["parallel_body", "run_length"],
                "the parallel body and the length of run disagree; give one of them".to_owned(),
            );
        }
        aft = Some(run);
    }
    if let (Some(a), Some(f)) = (aft, fore)
        && (a > f || a < 0.05 * length || f > 0.95 * length)
    {
        book.problem(
            "E109",
            &["parallel_body", "entrance_length", "run_length"],
            format!("the parallel body from {a:.3} m to {f:.3} m must run forward and leave at least 5 % of Lpp ({:.3} m) to each end", 0.05 * length),
        );
    }
    (fore, aft)
}

/// Remarks on ratios outside the usual band of the type.
pub(super) fn band_remarks(
    ship: ShipType,
    preset: &Preset,
    typed: bool,
    lb: f64,
    bt: f64,
    block: Sourced,
) -> Vec<Remark> {
    if !typed {
        return Vec::new();
    }
    [
        ("B", "L/B", lb, preset.length_breadth),
        ("T", "B/T", bt, preset.breadth_draught),
        ("Cb", "Cb", block.value, preset.block),
    ]
    .into_iter()
    .filter(|(_, _, value, band)| !(band[1] * 0.999..=band[2] * 1.001).contains(value))
    .map(|(key, name, value, band)| Remark {
        code: "W202",
        key,
        message: format!(
            "{name} {value:.3} is outside the usual band of preset {} ({} to {})",
            ship.as_str(),
            band[1],
            band[2]
        ),
    })
    .collect()
}
