//! The quantities that a daughter is derived for: their values, and their equations over the net of half-breadths.
//!
//! With both sides counted, V the volume below T, M and M_z its moments about AP and base line, A(x) the section areas, A_W
//! and M_W the waterplane and its moment, I its transverse second moment and S the wetted surface, the equations are
//!
//! ```text
//! V = V*,   M - LCB V = 0,   A(L/2) = C_M B T,   V - C_P L A(x_X) = 0,   A_W = C_WP L B,
//! M_W - LCF A_W = 0,   M_z - KB V = 0,   tan i = -+dy/dx,   A(x) = A*,   M_z + I - KM V = 0,   S = S*
//! ```
//!
//! All but the last two, and the place x_X of the largest section, are linear in the half-breadths on a fixed chart. Each is
//! divided by its size, so that residuals are relative: to the value, and to L_PP for LCB and LCF.

use std::f64::consts::FRAC_PI_2;

use super::ending::{WaterlineEnd, slope};
use crate::hull::{Functional, Hull, SectionalAreaCurve, transverse_inertia, transverse_inertia_gradient};
use crate::hydrostatics::{CoefficientLength, Conventions, PrismaticSection, wetted_surface, wetted_surface_gradient};

/// Stations among which the largest section is looked for.
const STATIONS: usize = 161;
/// Halvings of the interval around it.
const HALVINGS: usize = 60;

/// A quantity that can be a target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantity {
    /// Displacement volume \[m^3\].
    Volume,
    /// Longitudinal centre of buoyancy, forward of AP \[m\].
    Lcb,
    /// C_M \[-\], of the section at L_PP/2 on B and T.
    MidshipCoefficient,
    /// C_P \[-\], on the section of the conventions.
    PrismaticCoefficient,
    /// C_WP \[-\].
    WaterplaneCoefficient,
    /// Longitudinal centre of flotation, forward of AP \[m\].
    Lcf,
    /// Height of the centre of buoyancy above the base line \[m\].
    Kb,
    /// Height of the transverse metacentre above the base line \[m\].
    Km,
    /// Wetted surface \[m^2\].
    WettedSurface,
    /// Half angle of entrance of the design waterline \[deg\].
    HalfAngleOfEntrance,
    /// Half angle of run of the design waterline \[deg\].
    HalfAngleOfRun,
    /// Area of a section below T, both sides \[m^2\].
    SectionArea {
        /// Position forward of AP \[m\].
        x: f64,
    },
}

impl Quantity {
    /// Every quantity but the areas of sections, in the order of tables.
    pub const ALL: [Self; 11] = [
        Self::Volume,
        Self::Lcb,
        Self::MidshipCoefficient,
        Self::PrismaticCoefficient,
        Self::WaterplaneCoefficient,
        Self::Lcf,
        Self::Kb,
        Self::Km,
        Self::WettedSurface,
        Self::HalfAngleOfEntrance,
        Self::HalfAngleOfRun,
    ];

    /// The key of its row in tables of hydrostatics.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Volume => "DISPVOL",
            Self::Lcb => "XCB",
            Self::MidshipCoefficient => "CM",
            Self::PrismaticCoefficient => "CP",
            Self::WaterplaneCoefficient => "CWP",
            Self::Lcf => "XWL",
            Self::Kb => "KB",
            Self::Km => "KMT",
            Self::WettedSurface => "S",
            Self::HalfAngleOfEntrance => "IE",
            Self::HalfAngleOfRun => "IR",
            Self::SectionArea { .. } => "A",
        }
    }

    /// The key, of areas with the position: `A@45.000`.
    #[must_use]
    pub fn label(self) -> String {
        match self {
            Self::SectionArea { x } => format!("A@{x:.3}"),
            _ => self.key().to_owned(),
        }
    }

    /// The word in flags and job files.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Volume => "displacement",
            Self::Lcb => "lcb",
            Self::MidshipCoefficient => "cm",
            Self::PrismaticCoefficient => "cp",
            Self::WaterplaneCoefficient => "cwp",
            Self::Lcf => "lcf",
            Self::Kb => "kb",
            Self::Km => "km",
            Self::WettedSurface => "wetted-surface",
            Self::HalfAngleOfEntrance => "entrance",
            Self::HalfAngleOfRun => "run",
            Self::SectionArea { .. } => "section-areas",
        }
    }

    /// Unit, `-` for none.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Volume => "m3",
            Self::Lcb | Self::Lcf | Self::Kb | Self::Km => "m",
            Self::WettedSurface | Self::SectionArea { .. } => "m2",
            Self::HalfAngleOfEntrance | Self::HalfAngleOfRun => "deg",
            _ => "-",
        }
    }
}

/// What coefficients of a hull refer to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference {
    /// Length of C_B, C_P and C_WP \[m\].
    pub length: f64,
    /// L_PP \[m\].
    pub between: f64,
    /// B \[m\].
    pub breadth: f64,
    /// T \[m\].
    pub draught: f64,
    /// Section of C_P.
    pub section: PrismaticSection,
}

impl Reference {
    /// Of a hull at its design draught; none where it states none, or where nothing floats.
    #[must_use]
    pub fn of(hull: &Hull, conventions: &Conventions) -> Option<Self> {
        let p = hull.particulars();
        let draught = p.draught?;
        let [aft, fore] = hull.endings(draught)?;
        let length = match conventions.coefficient_length {
            CoefficientLength::BetweenPerpendiculars => p.length_between_perpendiculars,
            CoefficientLength::Waterline => fore - aft,
        };
        let between = p.length_between_perpendiculars;
        Some(Self { length, between, breadth: p.breadth, draught, section: conventions.prismatic_section })
    }

    /// L B T \[m^3\].
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.length * self.breadth * self.draught
    }

    /// C_M of a section with level bottom, plumb sides and bilges of this radius \[m\].
    pub(super) fn midship_coefficient(&self, radius: f64) -> f64 {
        1.0 - (2.0 - FRAC_PI_2) * radius * radius / (self.breadth * self.draught)
    }

    /// The radius \[m\] of the bilges of such a section with this C_M.
    pub(super) fn bilge_radius(&self, midship: f64) -> f64 {
        ((1.0 - midship).max(0.0) * self.breadth * self.draught / (2.0 - FRAC_PI_2)).sqrt()
    }

    /// The largest bilge radius that fits into the section \[m\].
    pub(super) fn largest_bilge(&self) -> f64 {
        self.draught.min(0.5 * self.breadth)
    }

    /// Position of the section of C_P \[m\].
    fn section_position(&self, hull: &Hull) -> f64 {
        match self.section {
            PrismaticSection::Midship => 0.5 * self.between,
            PrismaticSection::Maximum => largest_section(hull, self.draught),
        }
    }
}

/// Position of the largest section \[m\], by sections at equal distances and golden sections of the interval around the
/// largest of them.
fn largest_section(hull: &Hull, draught: f64) -> f64 {
    let Some([aft, fore]) = hull.endings(draught) else { return 0.0 };
    let step = (fore - aft) / (STATIONS - 1) as f64;
    let stations: Vec<f64> = (0..STATIONS).map(|k| aft + step * k as f64).collect();
    let areas = SectionalAreaCurve::new(hull, draught, &stations).areas;
    let best = areas.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1).then(b.0.cmp(&a.0))).map_or(0, |(k, _)| k);
    let area = |x: f64| Functional::SectionArea { x }.value(hull, draught);
    let (mut low, mut high) = (stations[best.saturating_sub(1)], stations[(best + 1).min(STATIONS - 1)]);
    let part = 0.5 * (5f64.sqrt() - 1.0);
    let (mut a, mut b) = (high - part * (high - low), low + part * (high - low));
    let (mut at_a, mut at_b) = (area(a), area(b));
    for _ in 0..HALVINGS {
        if (high - low).abs() <= 1e-8 * (fore - aft) {
            break;
        }
        if at_a >= at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - part * (high - low);
            at_a = area(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + part * (high - low);
            at_b = area(b);
        }
    }
    let middle = 0.5 * (low + high);
    if area(middle) >= areas[best] { middle } else { stations[best] }
}

/// The value of a quantity of a hull, in the unit of [`Quantity::unit`]; not finite where it is not defined.
#[must_use]
pub fn value_of(quantity: Quantity, hull: &Hull, reference: &Reference) -> f64 {
    let t = reference.draught;
    let of = |functional: Functional| functional.value(hull, t);
    match quantity {
        Quantity::Volume => of(Functional::Volume),
        Quantity::Lcb => of(Functional::LongitudinalMoment) / of(Functional::Volume),
        Quantity::MidshipCoefficient => {
            of(Functional::SectionArea { x: 0.5 * reference.between }) / (reference.breadth * t)
        }
        Quantity::PrismaticCoefficient => {
            let x = reference.section_position(hull);
            of(Functional::Volume) / (of(Functional::SectionArea { x }) * reference.length)
        }
        Quantity::WaterplaneCoefficient => of(Functional::WaterplaneArea) / (reference.length * reference.breadth),
        Quantity::Lcf => of(Functional::WaterplaneMoment) / of(Functional::WaterplaneArea),
        Quantity::Kb => of(Functional::VerticalMoment) / of(Functional::Volume),
        Quantity::Km => (of(Functional::VerticalMoment) + transverse_inertia(hull, t)) / of(Functional::Volume),
        Quantity::WettedSurface => wetted_surface(hull, t),
        Quantity::HalfAngleOfEntrance => angle(hull, t, WaterlineEnd::Fore),
        Quantity::HalfAngleOfRun => angle(hull, t, WaterlineEnd::Aft),
        Quantity::SectionArea { x } => of(Functional::SectionArea { x }),
    }
}

/// The half angle at an end of the waterline \[deg\]; not a number where the end is round.
fn angle(hull: &Hull, draught: f64, end: WaterlineEnd) -> f64 {
    slope(hull, draught, end).map_or(f64::NAN, |(slope, _)| slope.atan().to_degrees())
}

/// The equation that tan of the half angle at an end is that of `target` \[deg\].
fn angle_equation(hull: &Hull, draught: f64, end: WaterlineEnd, target: f64) -> Equation {
    let wanted = target.to_radians().tan();
    let mut gradient = vec![0.0; hull.surface().points().len()];
    let Some((found, weights)) = slope(hull, draught, end) else { return Equation { residual: f64::NAN, gradient } };
    weights.into_iter().for_each(|(k, weight)| gradient[k] += weight / wanted);
    Equation { residual: found / wanted - 1.0, gradient }
}

/// An equation at a net: what it is off by, relative to its size, and the gradient of that over the net.
#[derive(Debug, Clone)]
pub(super) struct Equation {
    pub(super) residual: f64,
    pub(super) gradient: Vec<f64>,
}

/// sum of factors times rows, divided by `size`.
fn combined(parts: &[(f64, Vec<f64>)], size: f64) -> Vec<f64> {
    let mut sum = vec![0.0; parts.first().map_or(0, |(_, row)| row.len())];
    for (factor, row) in parts {
        sum.iter_mut().zip(row).for_each(|(sum, value)| *sum += factor / size * value);
    }
    sum
}

/// The equation that a quantity of a hull is `target`.
pub(super) fn equation(quantity: Quantity, target: f64, hull: &Hull, reference: &Reference) -> Equation {
    let t = reference.draught;
    let row = |functional: Functional| functional.row(hull, t);
    let of = |functional: Functional| functional.value(hull, t);
    let linear = |parts: &[(f64, Functional)], known: f64, size: f64| {
        let value: f64 = parts.iter().map(|(factor, functional)| factor * of(*functional)).sum();
        let rows: Vec<(f64, Vec<f64>)> = parts.iter().map(|(factor, functional)| (*factor, row(*functional))).collect();
        Equation { residual: (value - known) / size, gradient: combined(&rows, size) }
    };
    let volume = of(Functional::Volume);
    match quantity {
        Quantity::Volume => linear(&[(1.0, Functional::Volume)], target, target),
        Quantity::Lcb => {
            let parts = [(1.0, Functional::LongitudinalMoment), (-target, Functional::Volume)];
            linear(&parts, 0.0, reference.between * volume)
        }
        Quantity::MidshipCoefficient => {
            let area = target * reference.breadth * t;
            linear(&[(1.0, Functional::SectionArea { x: 0.5 * reference.between })], area, area)
        }
        Quantity::PrismaticCoefficient => {
            let x = reference.section_position(hull);
            let parts = [(1.0, Functional::Volume), (-target * reference.length, Functional::SectionArea { x })];
            linear(&parts, 0.0, volume)
        }
        Quantity::WaterplaneCoefficient => {
            let area = target * reference.length * reference.breadth;
            linear(&[(1.0, Functional::WaterplaneArea)], area, area)
        }
        Quantity::Lcf => {
            let parts = [(1.0, Functional::WaterplaneMoment), (-target, Functional::WaterplaneArea)];
            linear(&parts, 0.0, reference.between * of(Functional::WaterplaneArea))
        }
        Quantity::Kb => {
            linear(&[(1.0, Functional::VerticalMoment), (-target, Functional::Volume)], 0.0, target * volume)
        }
        Quantity::Km => {
            let size = target * volume;
            let value = of(Functional::VerticalMoment) + transverse_inertia(hull, t) - target * volume;
            let rows = [
                (1.0, row(Functional::VerticalMoment)),
                (1.0, transverse_inertia_gradient(hull, t)),
                (-target, row(Functional::Volume)),
            ];
            Equation { residual: value / size, gradient: combined(&rows, size) }
        }
        Quantity::WettedSurface => Equation {
            residual: wetted_surface(hull, t) / target - 1.0,
            gradient: combined(&[(1.0, wetted_surface_gradient(hull, t))], target),
        },
        Quantity::HalfAngleOfEntrance => angle_equation(hull, t, WaterlineEnd::Fore, target),
        Quantity::HalfAngleOfRun => angle_equation(hull, t, WaterlineEnd::Aft, target),
        Quantity::SectionArea { x } => linear(&[(1.0, Functional::SectionArea { x })], target, target),
    }
}
