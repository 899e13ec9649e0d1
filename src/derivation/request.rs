//! What is asked of a daughter, and which targets follow from it.

use super::quantity::{Quantity, Reference, value_of};
use super::refusal::Refusal;
use crate::hull::Hull;
use crate::resistance::WaveRequest;

/// Main dimensions of the daughter \[m\]; those of the parent where none is named.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dimensions {
    /// L_PP
    pub length: Option<f64>,
    /// B
    pub breadth: Option<f64>,
    /// T
    pub draught: Option<f64>,
    /// D
    pub depth: Option<f64>,
}

/// How the targets are met.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Dimensions alone.
    Affine,
    /// Sections are shifted so that entrance and run become shorter or longer by one factor each.
    OneMinusPrismatic,
    /// Sections are shifted by the quadratic of Lackenby (1950), which keeps ends and parallel body.
    Lackenby,
    /// The hull nearest to the scaled parent: a level shift, then a convex program.
    #[default]
    Nearest,
}

impl Method {
    /// Every method.
    pub const ALL: [Self; 4] = [Self::Affine, Self::OneMinusPrismatic, Self::Lackenby, Self::Nearest];

    /// The word in flags and files.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Affine => "affine",
            Self::OneMinusPrismatic => "one-minus-prismatic",
            Self::Lackenby => "lackenby",
            Self::Nearest => "nearest",
        }
    }
}

/// Whether a target was stated or is kept from the parent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// The user states it.
    Given,
    /// It is that of the scaled parent.
    Kept,
}

impl Origin {
    /// The word in files: `given` or `kept`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Given => "given",
            Self::Kept => "kept",
        }
    }
}

/// A value that a quantity of the daughter has, in the unit of [`Quantity::unit`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// The quantity.
    pub quantity: Quantity,
    /// The value.
    pub value: f64,
    /// Where it comes from.
    pub origin: Origin,
}

/// What is asked of a daughter.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Request {
    /// Main dimensions.
    pub dimensions: Dimensions,
    /// C_B \[-\], in place of a volume.
    pub block_coefficient: Option<f64>,
    /// LCB \[% of L_PP\], + forward of L_PP/2, in place of a position.
    pub lcb_percent: Option<f64>,
    /// LCB and LCF as x = share L_PP + shift \[m\], in place of positions.
    #[doc(hidden)]
    pub centres: [Option<[f64; 2]>; 2],
    /// Bilge radius r \[m\], in place of C_M: that of a midship section with level bottom and plumb sides, C_M = 1 - (2 - pi/2)
    /// r^2 / (B T).
    #[doc(hidden)]
    pub bilge_radius: Option<f64>,
    /// Heights \[m\] of lines of the scaled parent, with those that they come to.
    #[doc(hidden)]
    pub moved_heights: Vec<[f64; 2]>,
    /// The same of positions forward of AP.
    #[doc(hidden)]
    pub moved_positions: Vec<[f64; 2]>,
    /// The other targets.
    pub targets: Vec<(Quantity, f64)>,
    /// Quantities that are not kept although nobody names them.
    pub free: Vec<Quantity>,
    /// The method.
    pub method: Method,
    /// Ends of the parallel body of the daughter \[m\], of the nearest hull and of the method of Lackenby.
    pub parallel_body: Option<[f64; 2]>,
    /// The wave resistance that is made small, of the nearest hull.
    #[doc(hidden)]
    pub waves: Option<WaveRequest>,
}

/// What a daughter keeps of her parent: C_B, LCB over L_PP and C_M by the affine laws, which the scaled parent has up to what
/// another depth moves below T.
pub(super) struct Laws<'a> {
    pub(super) parent: &'a Hull,
    /// The reference of the parent.
    pub(super) own: Reference,
    pub(super) scaled: &'a Hull,
}

impl Laws<'_> {
    fn value(&self, quantity: Quantity, reference: &Reference) -> f64 {
        let parent = value_of(quantity, self.parent, &self.own);
        let along = reference.between / self.own.between;
        match quantity {
            Quantity::Volume => {
                let sections = reference.breadth * reference.draught / (self.own.breadth * self.own.draught);
                parent * along * sections
            }
            Quantity::Lcb => parent * along,
            Quantity::MidshipCoefficient => parent,
            other => value_of(other, self.scaled, reference),
        }
    }
}

impl Request {
    /// The value that the request states for a quantity of a hull with this reference.
    pub(super) fn stated(&self, quantity: Quantity, reference: &Reference) -> Option<f64> {
        let own = self.targets.iter().find(|(named, _)| *named == quantity).map(|(_, value)| *value);
        let other = match quantity {
            Quantity::Volume => self.block_coefficient.map(|block| block * reference.volume()),
            Quantity::Lcb => {
                let part = self.lcb_percent.map(|part| [0.5 + 0.01 * part, 0.0]);
                part.or(self.centres[0]).map(|[share, shift]| share * reference.between + shift)
            }
            Quantity::Lcf => self.centres[1].map(|[share, shift]| share * reference.between + shift),
            Quantity::MidshipCoefficient => self.bilge_radius.map(|radius| reference.midship_coefficient(radius)),
            _ => None,
        };
        own.or(other)
    }

    /// The targets of the daughter: those that are stated, then volume, LCB and C_M of the scaled parent, as far as they are
    /// neither free nor follow from others.
    ///
    /// # Errors
    /// Every value that no ship has, and every target that the method does not take.
    pub(super) fn targets(&self, laws: &Laws<'_>, reference: &Reference) -> Result<Vec<Target>, Vec<Refusal>> {
        let scaled = laws.scaled;
        let mut list = Vec::new();
        for quantity in Quantity::ALL {
            let stated =
                self.stated(quantity, reference).map(|value| Target { quantity, value, origin: Origin::Given });
            let kept = || Target { quantity, value: laws.value(quantity, reference), origin: Origin::Kept };
            list.extend(stated.or_else(|| self.keeps(quantity).then(kept)));
        }
        list.extend(self.areas().map(|(x, value)| Target {
            quantity: Quantity::SectionArea { x },
            value,
            origin: Origin::Given,
        }));
        let mut refused: Vec<Refusal> = list
            .iter()
            .filter(|target| target.origin == Origin::Given)
            .filter_map(|target| impossible(target, reference))
            .collect();
        refused.extend(list.iter().filter_map(|target| undefined(target, scaled, reference)));
        refused.extend(self.of_method(&list));
        refused.extend(self.bilge_radius.and_then(|radius| no_bilge(radius, reference)));
        if refused.is_empty() { Ok(list) } else { Err(refused) }
    }

    /// Positions and areas of the sections that are stated.
    fn areas(&self) -> impl Iterator<Item = (f64, f64)> {
        self.targets.iter().filter_map(|(quantity, area)| match quantity {
            Quantity::SectionArea { x } => Some((*x, *area)),
            _ => None,
        })
    }

    pub(super) fn names(&self, quantity: Quantity) -> bool {
        let other = match quantity {
            Quantity::Volume => self.block_coefficient.is_some(),
            Quantity::Lcb => self.lcb_percent.is_some() || self.centres[0].is_some(),
            Quantity::Lcf => self.centres[1].is_some(),
            Quantity::MidshipCoefficient => self.bilge_radius.is_some(),
            _ => false,
        };
        other || self.targets.iter().any(|(named, _)| *named == quantity)
    }

    /// Whether a quantity that nobody states is that of the scaled parent.
    fn keeps(&self, quantity: Quantity) -> bool {
        let prismatic = self.names(Quantity::PrismaticCoefficient);
        let kept = match quantity {
            // C_P and C_M say what C_B is.
            Quantity::Volume => !prismatic || self.free.contains(&Quantity::MidshipCoefficient),
            Quantity::Lcb => true,
            Quantity::MidshipCoefficient => {
                self.method == Method::Nearest && !(prismatic && self.names(Quantity::Volume))
            }
            _ => false,
        };
        // A curve of areas says what volume, LCB and C_M are.
        let kept = kept && self.areas().next().is_none();
        kept && !self.free.contains(&quantity)
    }

    /// What the method does not take.
    fn of_method(&self, list: &[Target]) -> Vec<Refusal> {
        let takes = |quantity: Quantity| match self.method {
            Method::Affine => false,
            Method::OneMinusPrismatic | Method::Lackenby => {
                matches!(quantity, Quantity::Volume | Quantity::Lcb | Quantity::PrismaticCoefficient)
            }
            Method::Nearest => true,
        };
        let given = list.iter().filter(|target| target.origin == Origin::Given && !takes(target.quantity));
        let refusal = |target: &Target| {
            let word = target.quantity.word();
            let takes =
                if self.method == Method::Affine { "dimensions" } else { "dimensions, displacement or cb, cp and lcb" };
            let message = format!("method {} takes {takes} alone, and {word} is given", self.method.as_str());
            Refusal::new("E422", vec![word], message, "Take --method nearest, or leave it out".to_owned())
        };
        let mut refused: Vec<Refusal> = given.map(refusal).collect();
        let both = [Quantity::Volume, Quantity::PrismaticCoefficient].iter().all(|quantity| self.names(*quantity));
        if both && matches!(self.method, Method::OneMinusPrismatic | Method::Lackenby) {
            let message = "a shift of sections keeps C_M, so that cp follows from cb".to_owned();
            refused.push(Refusal::new("E422", vec!["cp", "cb"], message, "Leave one of them out".to_owned()));
        }
        if self.waves.is_some() && self.method != Method::Nearest {
            let message = format!("method {} takes no wave resistance", self.method.as_str());
            refused.push(Refusal::new("E422", vec!["wave-resistance"], message, "Take --method nearest".to_owned()));
        }
        if self.parallel_body.is_some() && !matches!(self.method, Method::Lackenby | Method::Nearest) {
            let message = format!("method {} takes no parallel body", self.method.as_str());
            let remedy = "Take --method nearest or lackenby".to_owned();
            refused.push(Refusal::new("E422", vec!["parallel-body"], message, remedy));
        }
        refused
    }
}

/// What the scaled parent has no value of, so that no daughter on its chart has.
pub(super) fn undefined(target: &Target, scaled: &Hull, reference: &Reference) -> Option<Refusal> {
    let word = target.quantity.word();
    match target.quantity {
        Quantity::SectionArea { x } => {
            let [aft, fore] = scaled.endings(reference.draught)?;
            let inside = x > aft && x < fore;
            (!inside).then(|| {
                let message = format!("the section at {x:.3} m is not between the ends of the waterline");
                let remedy = format!("Give positions between {aft:.3} and {fore:.3} m");
                Refusal::new("E421", vec![word], message, remedy)
            })
        }
        quantity if !value_of(quantity, scaled, reference).is_finite() => {
            let message = format!("the design waterline of the parent ends round, where {} is 90 deg", quantity.key());
            let remedy = "Leave it out, or derive from a hull with sharp ends of the waterline".to_owned();
            Some(Refusal::new("E420", vec![word], message, remedy))
        }
        _ => None,
    }
}

/// A bilge that does not fit into the midship section.
fn no_bilge(radius: f64, reference: &Reference) -> Option<Refusal> {
    let most = reference.largest_bilge();
    (radius > most).then(|| {
        let message = format!("bilge radius {radius:.3} m is more than the lesser of T and B/2, {most:.3} m");
        Refusal::new("E421", vec!["bilge-radius"], message, format!("Give at most {most:.3} m"))
    })
}

/// What no ship has.
pub(super) fn impossible(target: &Target, reference: &Reference) -> Option<Refusal> {
    let (l, b, t) = (reference.length, reference.breadth, reference.draught);
    let [low, high] = match target.quantity {
        Quantity::Volume => [0.0, 1.0],
        Quantity::MidshipCoefficient | Quantity::PrismaticCoefficient | Quantity::WaterplaneCoefficient => [0.0, 1.0],
        Quantity::Lcb | Quantity::Lcf => [0.0, reference.between],
        Quantity::Kb => [0.0, t],
        Quantity::Km => [0.0, t + b * b / (12.0 * t) / 0.1],
        Quantity::WettedSurface => [0.0, 2.0 * (l * b + l * t + b * t)],
        Quantity::HalfAngleOfEntrance | Quantity::HalfAngleOfRun => [0.0, 89.0],
        Quantity::SectionArea { .. } => [0.0, b * t],
    };
    let block = target.quantity == Quantity::Volume;
    let value = if block { target.value / reference.volume() } else { target.value };
    let strictly = value > low && if block { value < high } else { value <= high };
    if strictly && value.is_finite() {
        return None;
    }
    let (word, name) =
        if block { ("displacement", "C_B".to_owned()) } else { (target.quantity.word(), target.quantity.label()) };
    let unit =
        if target.quantity.unit() == "-" || block { String::new() } else { format!(" {}", target.quantity.unit()) };
    let message = format!("{name} is {value:.4}{unit}; a ship has more than {low} and less than {high:.4}{unit}");
    Some(Refusal::new("E421", vec![word], message, "Correct the value, or its unit".to_owned()))
}
