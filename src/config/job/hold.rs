//! What a job holds of the hull.

use super::super::design_targets::position_along;
use super::super::document::{Document, Raw};
use super::super::keys::Kind;
use super::super::value::Scalar;
use super::keys::HOLD;
use super::ranges::allowed;
use super::{AreaCurve, JobFile, Location};
use crate::config::keys::expected;
use crate::fairing::constraint::Constraint;
use crate::fairing::job::{AMIDSHIPS, Holding};
use crate::units::Dimension;

/// A quantity of the hull that a job can hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Displacement.
    Displacement,
    /// C_B.
    BlockCoefficient,
    /// LCB.
    CentreOfBuoyancy,
    /// KB.
    HeightOfBuoyancy,
    /// LCF.
    CentreOfFlotation,
    /// C_WP.
    WaterplaneCoefficient,
    /// A_W.
    WaterplaneArea,
    /// C_M.
    MidshipCoefficient,
    /// KM_T.
    Metacentre,
    /// GM_T.
    MetacentricHeight,
    /// S.
    WettedSurface,
}

/// What is asked of a quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target {
    /// The value of the table's own surface.
    Table,
    /// Nothing.
    Free,
    /// A mass \[t\], which the density makes a volume.
    Mass(f64),
    /// A position along the ship: share of L_PP, and metres forward of AP.
    Along([f64; 2]),
    /// A number in the SI unit of the quantity.
    Value(f64),
}

impl Quantity {
    /// Every quantity.
    pub const ALL: [Self; 11] = [
        Self::Displacement,
        Self::BlockCoefficient,
        Self::CentreOfBuoyancy,
        Self::HeightOfBuoyancy,
        Self::CentreOfFlotation,
        Self::WaterplaneCoefficient,
        Self::WaterplaneArea,
        Self::MidshipCoefficient,
        Self::Metacentre,
        Self::MetacentricHeight,
        Self::WettedSurface,
    ];

    /// The key of `[hold]`.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Displacement => "displacement",
            Self::BlockCoefficient => "Cb",
            Self::CentreOfBuoyancy => "LCB",
            Self::HeightOfBuoyancy => "KB",
            Self::CentreOfFlotation => "LCF",
            Self::WaterplaneCoefficient => "Cwp",
            Self::WaterplaneArea => "waterplane_area",
            Self::MidshipCoefficient => "Cm",
            Self::Metacentre => "KM",
            Self::MetacentricHeight => "GM",
            Self::WettedSurface => "wetted_surface",
        }
    }

    /// The quantity that says the same in another unit.
    #[must_use]
    pub fn twin(self) -> Option<Self> {
        match self {
            Self::Displacement => Some(Self::BlockCoefficient),
            Self::BlockCoefficient => Some(Self::Displacement),
            Self::WaterplaneArea => Some(Self::WaterplaneCoefficient),
            Self::WaterplaneCoefficient => Some(Self::WaterplaneArea),
            Self::Metacentre => Some(Self::MetacentricHeight),
            Self::MetacentricHeight => Some(Self::Metacentre),
            _ => None,
        }
    }

    /// With the height of the centre of gravity \[m\].
    fn constraint(self, target: f64, gravity: f64) -> Constraint {
        match self {
            Self::Displacement => Constraint::Displacement(target),
            Self::BlockCoefficient => Constraint::BlockCoefficient(target),
            Self::CentreOfBuoyancy => Constraint::CentreOfBuoyancy(target),
            Self::HeightOfBuoyancy => Constraint::HeightOfBuoyancy(target),
            Self::CentreOfFlotation => Constraint::CentreOfFlotation(target),
            Self::WaterplaneCoefficient => Constraint::WaterplaneCoefficient(target),
            Self::WaterplaneArea => Constraint::WaterplaneArea(target),
            Self::MidshipCoefficient => Constraint::MidshipCoefficient(target),
            Self::Metacentre => Constraint::Metacentre { height: target, gravity: 0.0 },
            Self::MetacentricHeight => Constraint::Metacentre { height: target, gravity },
            Self::WettedSurface => Constraint::WettedSurface(target),
        }
    }

    /// In words, for people.
    pub(super) fn words(self) -> String {
        match self {
            // Without the height of its centre of gravity.
            Self::MetacentricHeight => "GM_T".to_owned(),
            other => other.constraint(0.0, 0.0).words(),
        }
    }

    /// Whether a constraint holds it.
    pub(super) fn is_of(self, constraint: &Constraint) -> bool {
        std::mem::discriminant(&self.constraint(0.0, 0.0)) == std::mem::discriminant(constraint)
    }
}

/// What is held of the table by default.
const DEFAULT: [Quantity; 3] = [Quantity::Displacement, Quantity::CentreOfBuoyancy, Quantity::MidshipCoefficient];

/// Greatest target and greatest band, in the unit of the quantity: no ship has more, and the programs overflow far above.
pub(super) const MOST_TARGET: f64 = 1e9;

/// Reads `[hold]`.
pub(super) fn read(document: &mut Document<'_>, job: &mut JobFile) {
    for quantity in Quantity::ALL {
        if let Some(target) = target(document, quantity) {
            job.hold.push((quantity, target));
        }
    }
    let named = |quantity: Quantity| job.hold.iter().any(|(q, w)| *q == quantity && *w != Target::Free);
    // Displacement and C_B are compared when the dimensions are known.
    for (first, second) in [
        (Quantity::WaterplaneArea, Quantity::WaterplaneCoefficient),
        (Quantity::Metacentre, Quantity::MetacentricHeight),
    ] {
        if named(first) && named(second) {
            let path = format!("hold.{}", second.key());
            let span = document.entry(&path).map_or(0..0, |e| e.key_span.clone());
            let message = format!("{} and {} say the same", first.key(), second.key());
            document.problem("E170", &path, &span, message, "Give one of them.".into());
        }
    }
    job.gravity = super::positive(document, "hold.KG", "length");
    section_areas(document, job);
}

fn target(document: &mut Document<'_>, quantity: Quantity) -> Option<Target> {
    let path = format!("hold.{}", quantity.key());
    let (raw, span, kind) = document.raw(&path)?;
    if matches!(quantity, Quantity::CentreOfBuoyancy | Quantity::CentreOfFlotation) {
        let Raw::Text(text) = &raw else {
            if matches!(raw, Raw::Number(_)) {
                let message = format!("{path} is {}, and its unit is missing", raw.describe());
                let help = "Write \"+0.8 %\" (of Lpp from midship, + forward) or \"41.0 m AP\".".into();
                document.problem("E123", &path, &span, message, help);
            } else {
                document.unexpected(&path, &raw, &span, kind);
            }
            return None;
        };
        if text.trim_start().starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) {
            return position_along(document, &path, text, &span, kind).map(Target::Along);
        }
        return document.one_of(&path, text, &span, &HOLD).map(word);
    }
    let measure = match document.measure_or_word(&path)? {
        Scalar::Word(found) => return Some(word(found)),
        Scalar::Measure(measure) => measure,
    };
    let fraction = matches!(kind, Kind::OrWord(Kind::Number, _));
    let most = if fraction { 1.0 } else { MOST_TARGET };
    // A ship may be unstable as she stands.
    let (size, numbers) = match quantity {
        Quantity::MetacentricHeight => (measure.value.abs(), "that is not 0"),
        _ => (measure.value, "above 0"),
    };
    let expected = format!("a number {numbers}, at most {most}");
    let value = allowed(document, &path, measure.value, size > 0.0 && size <= most, &expected)?;
    let mass = quantity == Quantity::Displacement && measure.dimension != Dimension::Volume;
    Some(if mass { Target::Mass(value) } else { Target::Value(value) })
}

fn word(word: &str) -> Target {
    if word == "free" { Target::Free } else { Target::Table }
}

fn section_areas(document: &mut Document<'_>, job: &mut JobFile) {
    let path = "hold.section_areas";
    job.section_area_band = band(document);
    let Some((raw, span, kind)) = document.raw(path) else { return };
    if let Raw::Text(text) = &raw {
        let place = Location::new(document, path, span.start);
        match text.trim() {
            "" => document.unexpected(path, &raw, &span, kind),
            "table" => job.section_area_curve = Some((AreaCurve::Table, place)),
            file => job.section_area_curve = Some((AreaCurve::File(file.to_owned()), place)),
        }
        return;
    }
    let Raw::Array(items) = &raw else {
        document.unexpected(path, &raw, &span, kind);
        return;
    };
    for (item, at) in items {
        let numbers: Option<Vec<f64>> = match item {
            Raw::Array(numbers) => {
                let finite = |(raw, _): &(Raw, _)| match raw {
                    Raw::Number(value) if value.is_finite() => Some(*value),
                    _ => None,
                };
                numbers.iter().map(finite).collect()
            }
            _ => None,
        };
        let place = Location::new(document, path, at.start);
        match numbers.as_deref() {
            Some(&[x, area]) if area > 0.0 && is_area(area) => {
                job.section_areas.push(([x, area, job.section_area_band], place))
            }
            Some(&[x, area, band]) if area > 0.0 && is_area(area) && is_area(band) => {
                job.section_areas.push(([x, area, band], place))
            }
            _ => {
                let found = match (numbers.as_deref(), item) {
                    (Some(numbers), _) => format!("{numbers:?}"),
                    (None, Raw::Array(_)) => "a list of something else than finite numbers".to_owned(),
                    (None, _) => item.describe(),
                };
                let expected =
                    format!("Expected {}; areas above 0, bands of 0 or more, {MOST_TARGET} at most.", expected(kind));
                document.problem("E122", path, at, format!("{path}: an item is {found}"), expected);
            }
        }
    }
}

/// Whether a section may have this area, or a band this half width \[m^2\].
pub(super) fn is_area(area: f64) -> bool {
    (0.0..=MOST_TARGET).contains(&area)
}

/// The band about section areas that have none of their own \[m^2\].
fn band(document: &mut Document<'_>) -> f64 {
    let path = "hold.section_area_band";
    let Some(value) = document.number(path) else { return 0.0 };
    let expected = format!("an area of 0 to {MOST_TARGET} m2");
    allowed(document, path, value, is_area(value), &expected).unwrap_or(0.0)
}

/// The constraints; what is given overrides the default. The table's own areas are held at `places` \[m\] within the
/// band \[m^2\].
pub(super) fn holding(
    hold: &[(Quantity, Target)],
    areas: &[([f64; 3], Location)],
    (places, band): (&[f64], f64),
    [length, density, gravity]: [f64; 3],
) -> Holding {
    let named_already = |quantity: Quantity| hold.iter().any(|(q, _)| *q == quantity);
    // The area of the midship section says the midship coefficient.
    let midship = areas.iter().any(|([x, ..], _)| (x - 0.5 * length).abs() <= AMIDSHIPS * length);
    let silent = |quantity: &Quantity| {
        let by_area = midship && *quantity == Quantity::MidshipCoefficient;
        !(by_area || named_already(*quantity) || quantity.twin().is_some_and(named_already))
    };
    let mut own: Vec<Constraint> = DEFAULT.into_iter().filter(silent).map(|q| q.constraint(0.0, gravity)).collect();
    let mut given = Vec::new();
    for &(quantity, target) in hold {
        match target {
            Target::Free => {}
            Target::Table => own.push(quantity.constraint(0.0, gravity)),
            Target::Mass(mass) => given.push(quantity.constraint(mass / density, gravity)),
            Target::Along([share, shift]) => given.push(quantity.constraint(share * length + shift, gravity)),
            Target::Value(value) => given.push(quantity.constraint(value, gravity)),
        }
    }
    own.extend(places.iter().map(|&x| Constraint::SectionArea { x, area: 0.0, band }));
    given.extend(areas.iter().map(|&([x, area, band], _)| Constraint::SectionArea { x, area, band }));
    Holding::Both { own, given }
}
