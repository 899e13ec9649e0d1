//! Blends of hulls: weights that are not negative and sum to 1, over hulls of common dimensions on one chart.
//!
//! Half-breadths of a blend lie between those of the hulls at the same place of the chart. On common profiles the chart is
//! common, so that volume, moments and areas are linear in the weights: k hulls meet k - 1 such targets, and one more for
//! each dimension that is left free. Where profiles differ they are blended with the same weights, the volume is a polynomial of
//! them, and the targets are met all the same.

mod chart;
mod model;
mod weights;

use super::affine::scaled;
use super::inflections::{counted_planes, inflections};
use super::limits::Interval;
use super::quantity::{Quantity, Reference, value_of};
use super::refusal::Refusal;
use super::request::{Dimensions, Request, Target, impossible, undefined};
use crate::hull::Hull;
use crate::hydrostatics::Conventions;
use model::Model;
use weights::{Blending, Failed, Mix};

/// A dimension that may change for the targets; the depth stays.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// L_PP
    Length,
    /// B
    Breadth,
    /// T
    Draught,
}

impl Dimension {
    /// Every dimension.
    pub const ALL: [Self; 3] = [Self::Length, Self::Breadth, Self::Draught];

    /// The word in flags.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Length => "lpp",
            Self::Breadth => "beam",
            Self::Draught => "draught",
        }
    }
}

/// What is asked of a blend.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BlendRequest {
    /// Main dimensions; those of the first hull where none is named.
    pub dimensions: Dimensions,
    /// The weights, where they are stated: then there are no targets.
    pub weights: Option<Vec<f64>>,
    /// C_B \[-\], in place of a volume.
    pub block_coefficient: Option<f64>,
    /// LCB and LCF as x = share L_PP + shift \[m\], which follow a length that is free.
    pub centres: [Option<[f64; 2]>; 2],
    /// The other targets.
    pub targets: Vec<(Quantity, f64)>,
    /// Dimensions that may change for the targets, by a factor of 1.5 at most.
    pub free: Vec<Dimension>,
}

/// A hull of a blend.
#[derive(Debug, Clone)]
pub struct BlendedHull {
    /// The hull at the dimensions of the blend.
    pub scaled: Hull,
    /// Its weight.
    pub weight: f64,
    /// How far it moves, normal to itself, when it is brought to the chart of the blend, at most \[m\].
    pub error: f64,
    /// Its inflections of stations and waterlines.
    pub inflections: usize,
}

/// A target of a blend.
#[derive(Debug, Clone, PartialEq)]
pub struct BlendTarget {
    /// The target.
    pub target: Target,
    /// What it is of each hull at the dimensions of the blend.
    pub of_hulls: Vec<f64>,
    /// The value of the blend.
    pub achieved: f64,
    /// What it can be with the others as they are, where that was asked for.
    pub interval: Option<Interval>,
}

/// A blend.
#[derive(Debug, Clone)]
pub struct Blend {
    /// The hull.
    pub hull: Hull,
    /// What its coefficients refer to.
    pub reference: Reference,
    /// The hulls that it is made of.
    pub parents: Vec<BlendedHull>,
    /// Which of them keeps its surface on the common chart.
    pub base: usize,
    /// The targets.
    pub targets: Vec<BlendTarget>,
    /// Whether x and z of the chart are common below T, so that volume, moments and areas are linear in the weights.
    pub is_linear: bool,
    /// Its inflections of stations and waterlines.
    pub inflections: usize,
}

/// Blends hulls; `intervals` says whether what each target can be is computed as well.
///
/// # Errors
/// Every refusal: a hull without a draught (E184), a value that no ship has (E421), weights that are none or more targets
/// than hulls can meet (E423), profiles without a common chart (E424), targets that no weights meet (E420), each with numbers.
pub fn blend(
    hulls: &[Hull],
    request: &BlendRequest,
    conventions: &Conventions,
    intervals: bool,
) -> Result<Blend, Vec<Refusal>> {
    let wanted = stated(request);
    let quantities = quantities(&wanted);
    let refused = counts(hulls, request, quantities.len());
    if !refused.is_empty() {
        return Err(refused);
    }
    let parents = common(hulls, &request.dimensions)?;
    let draught = parents[0].particulars().draught.unwrap_or_default();
    let one = chart::on_one_chart(&parents, draught).map_err(|refusal| vec![refusal])?;
    let (all, free) = (quantities.clone(), &request.free);
    let without = Blending { hulls: &one.hulls, request: &wanted, free, conventions, quantities, model: None };
    without.possible(&parents)?;
    let model = if all.is_empty() { None } else { Model::new(&without, &all).ok().flatten() };
    let blending = Blending { model: model.as_ref(), ..without };
    let mix = match &request.weights {
        Some(weights) => Ok(Mix { weights: weights.clone(), changes: Vec::new() }),
        None => blending.solve(),
    };
    let made = mix.and_then(|mix| Ok((blending.hull(&mix)?, mix)));
    let (hull, mix) = made.map_err(|failed| blending.infeasible(&failed))?;
    let dimensions = of(&hull);
    let parents = common(&parents, &dimensions)?;
    let Some((reference, targets)) = blending.targets(&hull) else { return Err(vec![Refusal::no_draught()]) };
    let planes = counted_planes(&hull, conventions.stations);
    let reached = |target: Target| BlendTarget {
        target,
        of_hulls: parents.iter().map(|parent| value_of(target.quantity, parent, &reference)).collect(),
        achieved: value_of(target.quantity, &hull, &reference),
        interval: intervals.then(|| blending.interval(target.quantity)).flatten().map(|found| {
            let unit = blending.measure(target.quantity, &reference);
            Interval { low: unit * found.low, high: unit * found.high, ..found }
        }),
    };
    let targets = targets.into_iter().map(reached).collect();
    let is_linear = is_linear(&one.hulls, draught);
    let inflections_of_blend = inflections(&hull, &planes);
    let of_parent = |(k, scaled): (usize, Hull)| BlendedHull {
        inflections: inflections(&scaled, &planes),
        scaled,
        weight: mix.weights[k],
        error: one.errors[k],
    };
    let parents = parents.into_iter().enumerate().map(of_parent).collect();
    Ok(Blend { hull, reference, parents, base: one.base, targets, is_linear, inflections: inflections_of_blend })
}

/// The dimensions of a hull.
fn of(hull: &Hull) -> Dimensions {
    let p = hull.particulars();
    Dimensions {
        length: Some(p.length_between_perpendiculars),
        breadth: Some(p.breadth),
        draught: p.draught,
        depth: Some(p.depth),
    }
}

/// The targets as those of a daughter.
fn stated(request: &BlendRequest) -> Request {
    Request {
        block_coefficient: request.block_coefficient,
        centres: request.centres,
        targets: request.targets.clone(),
        ..Request::default()
    }
}

/// The quantities that are targets, in the order of tables.
fn quantities(request: &Request) -> Vec<Quantity> {
    Quantity::ALL.into_iter().filter(|quantity| request.names(*quantity)).collect()
}

/// The hulls at common dimensions: those that are named, and else those of the first.
fn common(hulls: &[Hull], named: &Dimensions) -> Result<Vec<Hull>, Vec<Refusal>> {
    let first = of(&hulls[0]);
    let dimensions = Dimensions {
        length: named.length.or(first.length),
        breadth: named.breadth.or(first.breadth),
        draught: named.draught.or(first.draught),
        depth: named.depth.or(first.depth),
    };
    let named =
        |refusal: Refusal, hull: &Hull| Refusal { message: format!("{}: {}", hull.name(), refusal.message), ..refusal };
    let scaled = |hull: &Hull| scaled(hull, &dimensions).map_err(|refusal| named(refusal, hull));
    let (made, refused): (Vec<_>, Vec<_>) = hulls.iter().map(scaled).partition(Result::is_ok);
    if refused.is_empty() {
        return Ok(made.into_iter().flatten().collect());
    }
    Err(refused.into_iter().filter_map(Result::err).collect())
}

/// What is wrong with numbers of hulls, weights and targets.
fn counts(hulls: &[Hull], request: &BlendRequest, targets: usize) -> Vec<Refusal> {
    let mut refused = Vec::new();
    let mut refuse = |words: Vec<&'static str>, message: String, remedy: &str| {
        refused.push(Refusal::new("E423", words, message, remedy.to_owned()));
    };
    let count = hulls.len();
    if count < 2 {
        refuse(
            vec!["hulls"],
            format!("{count} hull is given, and a blend is made of two or more"),
            "Name another hull",
        );
    }
    for dimension in &request.free {
        let twice = request.free.iter().filter(|other| *other == dimension).count() > 1;
        let stated = match dimension {
            Dimension::Length => request.dimensions.length,
            Dimension::Breadth => request.dimensions.breadth,
            Dimension::Draught => request.dimensions.draught,
        };
        if twice || stated.is_some() {
            let message = format!("{} is free and given, or free twice", dimension.word());
            refuse(vec!["free"], message, "Leave one of them out");
        }
    }
    if let Some(weights) = &request.weights {
        let list = |values: &[f64]| values.iter().map(|w| format!("{w}")).collect::<Vec<_>>().join(",");
        let total: f64 = weights.iter().sum();
        if weights.len() != count {
            let message = format!("{} weights are given for {count} hulls", weights.len());
            refuse(vec!["weights"], message, "Give one weight a hull, in the order of the hulls");
        } else if !weights.iter().all(|w| w.is_finite() && *w >= 0.0) {
            let message = format!("the weights are {}, and none may be negative", list(weights));
            refuse(vec!["weights"], message, "Give weights of 0 to 1");
        } else if (total - 1.0).abs() > 1e-9 {
            let part: Vec<f64> = weights.iter().map(|w| w / total).collect();
            let message = format!("the weights {} sum to {total}, and must sum to 1", list(weights));
            let remedy = if total > 0.0 { format!("Give {}", list(&part)) } else { "Give weights above 0".to_owned() };
            refuse(vec!["weights"], message, &remedy);
        }
        if targets > 0 || !request.free.is_empty() {
            let message = "weights are given, and targets or free dimensions as well".to_owned();
            refuse(vec!["weights"], message, "Leave the weights out, or the targets");
        }
    } else if targets == 0 {
        let message = "neither weights nor a target are given".to_owned();
        refuse(vec!["weights"], message, "Give --weights, or targets such as --cb and --lcb");
    } else if targets + 1 > count + request.free.len() {
        let message = format!(
            "{targets} targets are given, and {count} hulls with {} free dimensions meet {}",
            request.free.len(),
            (count + request.free.len()).saturating_sub(1)
        );
        refuse(vec!["hulls"], message, "Leave a target out, name another hull, or free a dimension with --free");
    }
    refused
}

/// Whether x and z of hulls on one chart are the same below T.
fn is_linear(hulls: &[Hull], draught: f64) -> bool {
    let first = hulls[0].surface();
    let columns = first.shape()[1];
    let wet = hulls[0].height_parameter(draught).map_or(columns, |v| first.v().find_span(v) + 1);
    let p = hulls[0].particulars();
    let slack = [1e-11 * p.length_between_perpendiculars, 1e-11 * p.depth];
    let same = |k: usize, a: &[f64; 3], b: &[f64; 3]| {
        k % columns >= wet || ((a[0] - b[0]).abs() <= slack[0] && (a[2] - b[2]).abs() <= slack[1])
    };
    let alike = |hull: &Hull| {
        let points = hull.surface().points().iter().zip(first.points());
        points.enumerate().all(|(k, (a, b))| same(k, a, b))
    };
    hulls.iter().all(alike)
}

impl Blending<'_> {
    /// Values that no ship of these dimensions has.
    fn possible(&self, hulls: &[Hull]) -> Result<(), Vec<Refusal>> {
        let Some((reference, targets)) = self.targets(&hulls[0]) else { return Err(vec![Refusal::no_draught()]) };
        let of_hull = |hull: &Hull| targets.iter().find_map(|target| undefined(target, hull, &reference));
        if let Some(refusal) = hulls.iter().find_map(of_hull) {
            return Err(vec![refusal]);
        }
        if !self.free.is_empty() {
            // They are values of other dimensions than these.
            return Ok(());
        }
        let refused: Vec<Refusal> = targets.iter().filter_map(|target| impossible(target, &reference)).collect();
        if refused.is_empty() { Ok(()) } else { Err(refused) }
    }

    /// Why there are no weights, with what each target can be.
    fn infeasible(&self, failed: &Failed) -> Vec<Refusal> {
        let words: Vec<&'static str> = self.quantities.iter().map(|quantity| quantity.word()).collect();
        let refuse = |message: String, remedy: String| vec![Refusal::new("E420", words.clone(), message, remedy)];
        match failed {
            Failed::Hull(error) => {
                return refuse(format!("the blend is no hull: {error}"), "Blend hulls that are alike".to_owned());
            }
            Failed::Astray(left) => {
                let message = format!("no weights were found: a relative error of {left:.1e} is left");
                return refuse(message, "Give targets nearer to those of the hulls".to_owned());
            }
            Failed::Infeasible => {}
        }
        let mut refused = Vec::new();
        let Some((reference, targets)) = self.hull_of_even().and_then(|hull| self.targets(&hull)) else {
            return refuse("nothing floats at the draught of the blend".to_owned(), "Give another draught".to_owned());
        };
        for target in targets {
            let Some(interval) = self.interval(target.quantity) else { continue };
            let value = self.measured(target.quantity, target.value, &reference);
            if interval.holds(value) {
                continue;
            }
            let is_stated = (self.measure(target.quantity, &reference) - 1.0).abs() > 0.0;
            let (name, unit) = match (target.quantity, is_stated) {
                (Quantity::Volume, true) => ("C_B", String::new()),
                (quantity, true) => (quantity.key(), " L_PP forward of AP".to_owned()),
                (quantity, false) if quantity.unit() == "-" => (quantity.key(), String::new()),
                (quantity, false) => (quantity.key(), format!(" {}", quantity.unit())),
            };
            if interval.high - interval.low <= 2e-5 * interval.high.abs().max(1.0) {
                let message = format!(
                    "{name} is {:.5}{unit} whatever the weights and dimensions that are free, and {value:.5} is wanted",
                    interval.low
                );
                let remedy = "Leave it out, or add a hull: the dimensions that are free do not change it".to_owned();
                refused.push(Refusal::new("E420", vec![target.quantity.word()], message, remedy));
                continue;
            }
            // Rounded to the inside, so that the ends are feasible.
            let [low, high] = [(1e5 * interval.low).ceil() / 1e5, (1e5 * interval.high).floor() / 1e5];
            let nearest = value.clamp(low.min(high), high.max(low));
            let message = format!(
                "{name} can be {low:.5} to {high:.5}{unit} of these hulls with the other targets met, and {value:.5} is wanted"
            );
            let remedy = format!("Give {nearest:.5}{unit}, add a hull beyond it, or free a dimension");
            refused.push(Refusal::new("E420", vec![target.quantity.word()], message, remedy));
        }
        if refused.is_empty() {
            let message =
                "no weights of these hulls meet the targets together, whichever of them is left out".to_owned();
            return refuse(message, "Give fewer targets, add a hull, or free a dimension".to_owned());
        }
        refused
    }

    /// The hull of equal weights.
    fn hull_of_even(&self) -> Option<Hull> {
        let count = self.hulls.len();
        weights::mixed(self.hulls, &vec![1.0 / count as f64; count]).ok()
    }
}
