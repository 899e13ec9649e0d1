//! What statistical methods need to know of a ship.

use std::fmt;

/// Shape of the after body (Holtrop 1984, C_stern).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SternShape {
    /// Pram with gondola, C_stern -25; in the set of 1984 alone.
    Pram,
    /// V-shaped sections, C_stern -10.
    V,
    /// Normal sections, C_stern 0.
    #[default]
    Normal,
    /// U-shaped sections with Hogner stern, C_stern +10.
    U,
}

impl SternShape {
    /// All shapes.
    pub const ALL: [Self; 4] = [Self::Pram, Self::V, Self::Normal, Self::U];

    /// The word for it.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Pram => "pram",
            Self::V => "V",
            Self::Normal => "normal",
            Self::U => "U",
        }
    }

    /// C_stern.
    #[must_use]
    pub fn coefficient(self) -> f64 {
        match self {
            Self::Pram => -25.0,
            Self::V => -10.0,
            Self::Normal => 0.0,
            Self::U => 10.0,
        }
    }
}

/// Kinds of appendages with their factor 1 + k2 (Holtrop and Mennen 1982); of ranges the middle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AppendageKind {
    /// Rudder behind skeg, 1.5 to 2.0.
    RudderBehindSkeg,
    /// Rudder behind stern, 1.3 to 1.5.
    RudderBehindStern,
    /// Twin-screw balance rudders, 2.8.
    TwinRudders,
    /// Shaft brackets, 3.0.
    ShaftBrackets,
    /// Skeg, 1.5 to 2.0.
    Skeg,
    /// Strut bossings, 3.0.
    StrutBossings,
    /// Hull bossings, 2.0.
    HullBossings,
    /// Shafts, 2.0 to 4.0.
    Shafts,
    /// Stabiliser fins, 2.8.
    StabiliserFins,
    /// Dome, 2.7.
    Dome,
    /// Bilge keels, 1.4.
    BilgeKeels,
}

impl AppendageKind {
    /// All kinds.
    pub const ALL: [Self; 11] = [
        Self::RudderBehindSkeg,
        Self::RudderBehindStern,
        Self::TwinRudders,
        Self::ShaftBrackets,
        Self::Skeg,
        Self::StrutBossings,
        Self::HullBossings,
        Self::Shafts,
        Self::StabiliserFins,
        Self::Dome,
        Self::BilgeKeels,
    ];

    /// The word for it.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::RudderBehindSkeg => "rudder-behind-skeg",
            Self::RudderBehindStern => "rudder-behind-stern",
            Self::TwinRudders => "twin-rudders",
            Self::ShaftBrackets => "shaft-brackets",
            Self::Skeg => "skeg",
            Self::StrutBossings => "strut-bossings",
            Self::HullBossings => "hull-bossings",
            Self::Shafts => "shafts",
            Self::StabiliserFins => "stabiliser-fins",
            Self::Dome => "dome",
            Self::BilgeKeels => "bilge-keels",
        }
    }

    /// 1 + k2.
    #[must_use]
    pub fn factor(self) -> f64 {
        match self {
            Self::RudderBehindSkeg | Self::Skeg => 1.75,
            Self::RudderBehindStern | Self::BilgeKeels => 1.4,
            Self::TwinRudders | Self::StabiliserFins => 2.8,
            Self::ShaftBrackets | Self::StrutBossings | Self::Shafts => 3.0,
            Self::HullBossings => 2.0,
            Self::Dome => 2.7,
        }
    }
}

/// An appendage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Appendage {
    /// Wetted surface [m^2].
    pub surface: f64,
    /// 1 + k2.
    pub factor: f64,
}

/// Part by which areas of a body may pass those that bound them.
const ROUNDING: f64 = 1e-9;

/// Form of a ship as Holtrop and Mennen state it; lengths in metres.
#[derive(Debug, Clone, PartialEq)]
pub struct ShipParameters {
    /// Length on the waterline L \[m\].
    pub length: f64,
    /// Breadth B \[m\].
    pub breadth: f64,
    /// Draught at the fore perpendicular T_F \[m\].
    pub draught_fore: f64,
    /// Draught at the aft perpendicular T_A \[m\].
    pub draught_aft: f64,
    /// Displacement volume [m^3].
    pub volume: f64,
    /// Longitudinal centre of buoyancy, forward of L/2 [% of L].
    pub lcb: f64,
    /// Midship section coefficient C_M, on B and the mean draught.
    pub midship_coefficient: f64,
    /// Waterplane coefficient C_WP, on L and B.
    pub waterplane_coefficient: f64,
    /// Wetted surface of the hull without transom S [m^2].
    pub wetted_surface: f64,
    /// Half angle of entrance i_E \[deg\].
    pub half_angle: f64,
    /// Immersed area of the transom at rest A_T [m^2].
    pub transom_area: f64,
    /// Transverse area of the bulb where the still water meets the stem A_BT [m^2].
    pub bulb_area: f64,
    /// Height of the centre of that area above the keel h_B \[m\].
    pub bulb_height: f64,
    /// Shape of the after body.
    pub stern: SternShape,
    /// Appendages.
    pub appendages: Vec<Appendage>,
}

/// A parameter for which the formulas are not defined.
#[derive(Debug, Clone, PartialEq)]
pub struct ShipFault {
    /// Its symbol.
    pub symbol: &'static str,
    /// Its value.
    pub value: f64,
    /// What it must be.
    pub limit: &'static str,
}

impl fmt::Display for ShipFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { symbol, value, limit } = self;
        if value.abs() < 1e6 {
            write!(f, "{symbol} is {value:.4}; the formulas need {limit}")
        } else {
            write!(f, "{symbol} is {value:.1e}; the formulas need {limit}")
        }
    }
}

impl std::error::Error for ShipFault {}

impl ShipParameters {
    /// Mean draught T \[m\].
    #[must_use]
    pub fn draught(&self) -> f64 {
        0.5 * (self.draught_fore + self.draught_aft)
    }

    /// C_B on L.
    #[must_use]
    pub fn block_coefficient(&self) -> f64 {
        self.volume / (self.length * self.breadth * self.draught())
    }

    /// C_P = C_B / C_M on L.
    #[must_use]
    pub fn prismatic_coefficient(&self) -> f64 {
        self.block_coefficient() / self.midship_coefficient
    }

    /// Length of the run L_R = L (1 - C_P + 0.06 C_P lcb / (4 C_P - 1)) \[m\] (Holtrop and Mennen 1982).
    #[must_use]
    pub fn run_length(&self) -> f64 {
        let cp = self.prismatic_coefficient();
        self.length * (1.0 - cp + 0.06 * cp * self.lcb / (4.0 * cp - 1.0))
    }

    /// What no ship has, whatever the method: areas beyond the section amidships, a wetted surface below the waterplane, C_B
    /// above 1.
    #[must_use]
    pub fn impossible(&self) -> Vec<ShipFault> {
        let section = (1.0 + ROUNDING) * self.breadth * self.draught() * self.midship_coefficient;
        let waterplane = (1.0 - ROUNDING) * self.length * self.breadth * self.waterplane_coefficient;
        let block = self.block_coefficient();
        let checks = [
            ("C_B", block, block > 0.0 && block <= 1.0 + ROUNDING, "0 to 1"),
            ("A_T", self.transom_area, self.transom_area <= section, "no more than the section amidships, B T C_M"),
            ("A_BT", self.bulb_area, self.bulb_area <= section, "no more than the section amidships, B T C_M"),
            ("S", self.wetted_surface, self.wetted_surface >= waterplane, "no less than the waterplane, L B C_WP"),
        ];
        let failed = checks.into_iter().filter(|(_, value, holds, _)| !holds || !value.is_finite());
        failed.map(|(symbol, value, _, limit)| ShipFault { symbol, value, limit }).collect()
    }

    /// Everything for which the formulas of Holtrop and Mennen are not defined.
    #[must_use]
    pub fn faults(&self) -> Vec<ShipFault> {
        let cp = self.prismatic_coefficient();
        let bulb = self.bulb_area > 0.0;
        let checks = [
            ("L", self.length, self.length > 0.0, "more than 0"),
            ("B", self.breadth, self.breadth > 0.0, "more than 0"),
            ("T", self.draught(), self.draught() > 0.0, "more than 0"),
            ("volume", self.volume, self.volume > 0.0, "more than 0"),
            ("S", self.wetted_surface, self.wetted_surface > 0.0, "more than 0"),
            ("C_M", self.midship_coefficient, (0.0..=1.0).contains(&self.midship_coefficient), "0 to 1"),
            ("C_WP", self.waterplane_coefficient, (0.0..=1.0).contains(&self.waterplane_coefficient), "0 to 1"),
            ("C_P", cp, cp > 0.26 && cp < 0.99, "0.26 to 0.99"),
            ("L_R", self.run_length(), self.run_length() > 0.0, "a run of positive length"),
            ("1 - C_P + 0.0225 lcb", 1.0 - cp + 0.0225 * self.lcb, 1.0 - cp + 0.0225 * self.lcb > 0.0, "more than 0"),
            ("1 - C_P - 0.0225 lcb", 1.0 - cp - 0.0225 * self.lcb, 1.0 - cp - 0.0225 * self.lcb > 0.0, "more than 0"),
            ("L/B", self.length / self.breadth, self.length > 2.0 * self.breadth, "more than 2"),
            ("i_E", self.half_angle, (0.0..90.0).contains(&self.half_angle), "0 to 90 degrees"),
            ("A_T", self.transom_area, self.transom_area >= 0.0, "0 or more"),
            ("A_BT", self.bulb_area, self.bulb_area >= 0.0, "0 or more"),
            (
                "h_B",
                self.bulb_height,
                !bulb || (0.0..=0.6 * self.draught_fore).contains(&self.bulb_height),
                "0 to 0.6 T_F (Holtrop 1984)",
            ),
        ];
        let failed = checks.into_iter().filter(|(_, value, holds, _)| !holds || !value.is_finite());
        failed.map(|(symbol, value, _, limit)| ShipFault { symbol, value, limit }).collect()
    }
}
