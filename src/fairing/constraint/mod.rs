//! What a fair hull has to hold, one file each: quantities of the whole hull ([`Constraint`]) and rules for single
//! lines and regions ([`Rule`]), as rows over the net. Linear quantities are the same rows that the hydrostatics
//! evaluate; the metacentre and the wetted surface are linearised about a hull, and the answer is the start of the next
//! linearisation ([`super::relinearise`]).

mod area;
mod breadth;
mod centre;
mod curvature;
mod fixed;
mod flat;
pub mod inflections;
pub mod lines;
mod metacentre;
mod monotone;
mod rule;
mod tangent;
mod volume;
mod waterplane;
mod wetted;

use super::model::{Limit, Row};
use crate::hull::Hull;

/// A target for the whole hull.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Constraint {
    /// Displaced volume \[m^3\] at the design draught.
    Displacement(f64),
    /// Block coefficient: volume over L_PP B T.
    BlockCoefficient(f64),
    /// Longitudinal centre of buoyancy \[m\] forward of AP.
    CentreOfBuoyancy(f64),
    /// Height of the centre of buoyancy \[m\] above the base line.
    HeightOfBuoyancy(f64),
    /// Waterplane area \[m^2\].
    WaterplaneArea(f64),
    /// Waterplane coefficient: waterplane area over L_PP B.
    WaterplaneCoefficient(f64),
    /// Longitudinal centre of flotation \[m\] forward of AP.
    CentreOfFlotation(f64),
    /// Midship section coefficient: area of the section at L_PP/2 over B T.
    MidshipCoefficient(f64),
    /// Area of the section \[m^2\] at x \[m\], within a band \[m^2\]; 0 for exactly.
    SectionArea {
        /// Position forward of AP \[m\].
        x: f64,
        /// Area, both sides \[m^2\].
        area: f64,
        /// Half width of the band \[m^2\].
        band: f64,
    },
    /// Height of the transverse metacentre \[m\] at the design draught, KM_T = KB + I_T / V, less KG: GM_T for a height
    /// of the centre of gravity, KM_T for 0. Not linear: its row is that of the tangent at a hull.
    Metacentre {
        /// Target of GM_T or KM_T \[m\].
        height: f64,
        /// Height of the centre of gravity above the base line \[m\]; 0 for KM_T.
        gravity: f64,
    },
    /// Wetted surface \[m^2\] below the design draught. Not linear.
    WettedSurface(f64),
    /// Volume 2 int int y dz dx \[m^3\] below a height, where no draught is stated.
    Volume {
        /// Target \[m^3\].
        volume: f64,
        /// The height above the base line \[m\].
        below: f64,
    },
    /// Longitudinal centre of the volume below a height, where no draught is stated: 2 int int x y dz dx over that volume
    /// \[m\] forward of x = 0.
    CentreOfVolume {
        /// Target \[m\].
        x: f64,
        /// The height above the base line \[m\].
        below: f64,
    },
}

impl Constraint {
    /// Name in files.
    #[must_use]
    pub fn key(&self) -> &'static str {
        match self {
            Self::Displacement(_) => "displacement",
            Self::BlockCoefficient(_) => "block_coefficient",
            Self::CentreOfBuoyancy(_) => "lcb",
            Self::HeightOfBuoyancy(_) => "kb",
            Self::WaterplaneArea(_) => "waterplane_area",
            Self::WaterplaneCoefficient(_) => "waterplane_coefficient",
            Self::CentreOfFlotation(_) => "lcf",
            Self::MidshipCoefficient(_) => "midship_coefficient",
            Self::SectionArea { .. } => "section_area",
            Self::Metacentre { gravity, .. } if *gravity > 0.0 => "gm",
            Self::Metacentre { .. } => "km",
            Self::WettedSurface(_) => "wetted_surface",
            Self::Volume { .. } => "volume",
            Self::CentreOfVolume { .. } => "centre_of_volume",
        }
    }

    /// In words, for people.
    #[must_use]
    pub fn words(&self) -> String {
        match self {
            Self::Displacement(_) => "displacement".to_owned(),
            Self::BlockCoefficient(_) => "C_B".to_owned(),
            Self::CentreOfBuoyancy(_) => "LCB".to_owned(),
            Self::HeightOfBuoyancy(_) => "KB".to_owned(),
            Self::WaterplaneArea(_) => "waterplane area".to_owned(),
            Self::WaterplaneCoefficient(_) => "C_WP".to_owned(),
            Self::CentreOfFlotation(_) => "LCF".to_owned(),
            Self::MidshipCoefficient(_) => "C_M".to_owned(),
            Self::SectionArea { x, .. } => format!("section area at x = {x:.3} m"),
            Self::Metacentre { gravity, .. } if *gravity > 0.0 => format!("GM_T for KG {gravity:.3} m"),
            Self::Metacentre { .. } => "KM_T".to_owned(),
            Self::WettedSurface(_) => "wetted surface".to_owned(),
            Self::Volume { below, .. } => format!("volume below z = {below:.3} m"),
            Self::CentreOfVolume { below, .. } => format!("centre of the volume below z = {below:.3} m"),
        }
    }

    /// Unit of the quantity; `-` for a coefficient.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Displacement(_) | Self::Volume { .. } => "m3",
            Self::WaterplaneArea(_) | Self::SectionArea { .. } | Self::WettedSurface(_) => "m2",
            Self::CentreOfBuoyancy(_)
            | Self::CentreOfFlotation(_)
            | Self::HeightOfBuoyancy(_)
            | Self::CentreOfVolume { .. }
            | Self::Metacentre { .. } => "m",
            Self::BlockCoefficient(_) | Self::WaterplaneCoefficient(_) | Self::MidshipCoefficient(_) => "-",
        }
    }

    /// What an error of the row ([`Constraint::limit`]) is a part of, in words.
    #[must_use]
    pub fn relative_to(&self) -> &'static str {
        match self {
            Self::CentreOfBuoyancy(_) | Self::CentreOfFlotation(_) | Self::CentreOfVolume { .. } => "L_PP",
            Self::HeightOfBuoyancy(_) => "T",
            Self::MidshipCoefficient(_) | Self::SectionArea { .. } => "B T",
            Self::Metacentre { .. } => "KM_T",
            _ => "its target",
        }
    }

    /// The target, in the unit of the quantity.
    #[must_use]
    pub fn target(&self) -> f64 {
        match *self {
            Self::Displacement(value)
            | Self::BlockCoefficient(value)
            | Self::CentreOfBuoyancy(value)
            | Self::HeightOfBuoyancy(value)
            | Self::WaterplaneArea(value)
            | Self::WaterplaneCoefficient(value)
            | Self::CentreOfFlotation(value)
            | Self::MidshipCoefficient(value)
            | Self::WettedSurface(value)
            | Self::Metacentre { height: value, .. }
            | Self::Volume { volume: value, .. }
            | Self::CentreOfVolume { x: value, .. }
            | Self::SectionArea { area: value, .. } => value,
        }
    }

    /// The same quantity with another target.
    #[must_use]
    pub fn with_target(self, target: f64) -> Self {
        match self {
            Self::Displacement(_) => Self::Displacement(target),
            Self::BlockCoefficient(_) => Self::BlockCoefficient(target),
            Self::CentreOfBuoyancy(_) => Self::CentreOfBuoyancy(target),
            Self::HeightOfBuoyancy(_) => Self::HeightOfBuoyancy(target),
            Self::WaterplaneArea(_) => Self::WaterplaneArea(target),
            Self::WaterplaneCoefficient(_) => Self::WaterplaneCoefficient(target),
            Self::CentreOfFlotation(_) => Self::CentreOfFlotation(target),
            Self::MidshipCoefficient(_) => Self::MidshipCoefficient(target),
            Self::SectionArea { x, band, .. } => Self::SectionArea { x, area: target, band },
            Self::Metacentre { gravity, .. } => Self::Metacentre { height: target, gravity },
            Self::WettedSurface(_) => Self::WettedSurface(target),
            Self::Volume { below, .. } => Self::Volume { volume: target, below },
            Self::CentreOfVolume { below, .. } => Self::CentreOfVolume { x: target, below },
        }
    }

    /// Whether the quantity is one at a draught, so that it needs one that is stated.
    #[must_use]
    pub fn needs_draught(&self) -> bool {
        !matches!(self, Self::Volume { .. } | Self::CentreOfVolume { .. })
    }

    /// The quantity of a hull, in its unit. What [needs a draught](Self::needs_draught) is taken at
    /// [`Hull::reference_height`].
    #[must_use]
    pub fn value(&self, hull: &Hull) -> f64 {
        match *self {
            Self::Displacement(_) => volume::volume(hull, hull.reference_height()),
            Self::BlockCoefficient(_) => volume::block_coefficient(hull),
            Self::CentreOfBuoyancy(_) => centre::longitudinal(hull, hull.reference_height()),
            Self::HeightOfBuoyancy(_) => centre::vertical(hull),
            Self::WaterplaneArea(_) => waterplane::area(hull),
            Self::WaterplaneCoefficient(_) => waterplane::coefficient(hull),
            Self::CentreOfFlotation(_) => waterplane::centre(hull),
            Self::MidshipCoefficient(_) => area::midship_coefficient(hull),
            Self::SectionArea { x, .. } => area::section(hull, x),
            Self::Metacentre { gravity, .. } => metacentre::height(hull) - gravity,
            Self::WettedSurface(_) => wetted::surface(hull),
            Self::Volume { below, .. } => volume::volume(hull, below),
            Self::CentreOfVolume { below, .. } => centre::longitudinal(hull, below),
        }
    }

    /// What an error of the quantity is measured in, as [`Constraint::relative_to`] says in words.
    #[must_use]
    pub fn scale(&self, hull: &Hull) -> f64 {
        let p = hull.particulars();
        match *self {
            Self::CentreOfBuoyancy(_) | Self::CentreOfFlotation(_) | Self::CentreOfVolume { .. } => {
                p.length_between_perpendiculars
            }
            Self::HeightOfBuoyancy(_) => hull.reference_height(),
            Self::MidshipCoefficient(_) => 1.0,
            Self::SectionArea { .. } => p.breadth * hull.reference_height(),
            // GM_T may be small.
            Self::Metacentre { .. } => metacentre::height(hull),
            _ => self.target().abs(),
        }
    }

    /// How far the quantity may be from its target, in its unit.
    #[must_use]
    pub fn band(&self) -> f64 {
        if let Self::SectionArea { band, .. } = self { *band } else { 0.0 }
    }

    /// The same constraint where a value meets it; else one whose nearest limit is that value, and that band wide.
    #[must_use]
    pub fn eased(self, value: f64, hull: &Hull) -> Self {
        let off = value - self.target();
        if off.abs() - self.band() > 1e-9 * self.scale(hull) {
            self.with_target(value - self.band().copysign(off))
        } else {
            self
        }
    }

    /// By how much a value misses the target, over its scale.
    #[must_use]
    pub fn missed(&self, value: f64, hull: &Hull) -> f64 {
        ((value - self.target()).abs() - self.band()).max(0.0) / self.scale(hull)
    }

    /// Whether the quantity is linear in the net: its row is then that of any hull on the chart.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        !matches!(self, Self::Metacentre { .. } | Self::WettedSurface(_))
    }

    /// [`Constraint::limit`] with `room` more to both sides, in the unit of the quantity. The row of a centre is over the volume or
    /// area of `hull`, and that of the answer is another: a part of its room is left for that.
    #[must_use]
    #[doc(hidden)]
    pub fn limit_within(&self, hull: &Hull, room: f64) -> Limit {
        let is_centre = matches!(
            self,
            Self::CentreOfBuoyancy(_)
                | Self::HeightOfBuoyancy(_)
                | Self::CentreOfFlotation(_)
                | Self::CentreOfVolume { .. }
        );
        let room = if is_centre { (1.0 - LEFT_TO_SIZE) * room } else { room };
        let (limit, room) = (self.limit(hull), room / self.scale(hull));
        Limit { lower: limit.lower - room, upper: limit.upper + room, row: limit.row }
    }

    /// The row and its limits over the net of a hull; rows are scaled so that a relative error of the quantity (for
    /// centres: an error over L_PP or T) is an error of the row.
    #[must_use]
    #[doc(hidden)]
    pub fn limit(&self, hull: &Hull) -> Limit {
        match *self {
            Self::Displacement(target) => volume::limit(hull, hull.reference_height(), target),
            Self::BlockCoefficient(target) => volume::block(hull, target),
            Self::CentreOfBuoyancy(target) => centre::longitudinal_limit(hull, hull.reference_height(), target),
            Self::HeightOfBuoyancy(target) => centre::vertical_limit(hull, target),
            Self::WaterplaneArea(target) => waterplane::area_limit(hull, target),
            Self::WaterplaneCoefficient(target) => waterplane::coefficient_limit(hull, target),
            Self::CentreOfFlotation(target) => waterplane::centre_limit(hull, target),
            Self::MidshipCoefficient(target) => area::midship_limit(hull, target),
            Self::SectionArea { x, area, band } => area::section_limit(hull, x, area, band),
            Self::Metacentre { height, gravity } => metacentre::limit(hull, height + gravity),
            Self::WettedSurface(target) => wetted::limit(hull, target),
            Self::Volume { volume, below } => volume::limit(hull, below, volume),
            Self::CentreOfVolume { x, below } => centre::longitudinal_limit(hull, below, x),
        }
    }
}

pub use super::constraint::lines::{FixedLine, TangentPlace};
pub use breadth::{admit, between, breadths, broken, control_values, excess};
pub use flat::{edged, edges};
pub use rule::Rule;

/// Part of the room of a centre that is left for a change of the volume or area that it is the centre of.
const LEFT_TO_SIZE: f64 = 0.01;

/// A dense row without its zeros, times a factor.
fn compressed(row: &[f64], factor: f64) -> Row {
    row.iter().enumerate().filter(|(_, value)| **value != 0.0).map(|(i, value)| (i, factor * value)).collect()
}

/// row . c = target, the row and the target over `scale`.
fn equal(row: &[f64], target: f64, scale: f64) -> Limit {
    Limit { row: compressed(row, 1.0 / scale), lower: target / scale, upper: target / scale }
}

/// (moment row - target * size row) . c = 0 over the size that the hull has now: the centre moment/size lies at `target`.
fn centred(moment: &[f64], size: &[f64], target: f64, scale: f64) -> Limit {
    let row: Vec<f64> = moment.iter().zip(size).map(|(moment, size)| moment - target * size).collect();
    equal(&row, 0.0, scale)
}
