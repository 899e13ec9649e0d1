//! Conventions of a hydrostatic table: what is switchable, and is printed with every result.

use std::ops::RangeInclusive;

use crate::hull::{StatedParticulars, StationNumbers};

/// Length that coefficients are referred to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CoefficientLength {
    /// L_PP.
    BetweenPerpendiculars,
    /// L_WL at each draught.
    Waterline,
}

/// Section that C_P is referred to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PrismaticSection {
    /// The largest section at each draught, A_X.
    Maximum,
    /// The section at L_PP / 2, A_M.
    Midship,
}

/// Where the printed LCB is measured from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LcbReference {
    /// From the aft perpendicular, + forward \[m\].
    AftPerpendicular,
    /// From L_PP / 2, + forward \[m\].
    Midship,
    /// From the forward perpendicular, + aft \[m\].
    ForwardPerpendicular,
    /// From L_PP / 2, + forward [% of L_PP].
    Percent,
}

impl LcbReference {
    /// Every reference.
    pub const ALL: [Self; 4] = [Self::AftPerpendicular, Self::Midship, Self::ForwardPerpendicular, Self::Percent];

    /// The word in files and on the command line.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::AftPerpendicular => "AP",
            Self::Midship => "midship",
            Self::ForwardPerpendicular => "FP",
            Self::Percent => "percent",
        }
    }

    /// Unit of the printed LCB.
    #[must_use]
    pub fn unit(self) -> &'static str {
        if self == Self::Percent { "%" } else { "m" }
    }

    /// The printed LCB of a centre `x` \[m\] forward of AP; `length` is L_PP \[m\].
    #[must_use]
    pub fn lcb(self, x: f64, length: f64) -> f64 {
        match self {
            Self::AftPerpendicular => x,
            Self::Midship => x - 0.5 * length,
            Self::ForwardPerpendicular => length - x,
            Self::Percent => 100.0 * (x / length - 0.5),
        }
    }

    /// The reference in words, with its sign.
    #[must_use]
    pub fn statement(self) -> &'static str {
        match self {
            Self::AftPerpendicular => "LCB from AP, + forward",
            Self::Midship => "LCB from midship, + forward",
            Self::ForwardPerpendicular => "LCB from FP, + aft",
            Self::Percent => "LCB in % of Lpp from midship, + forward",
        }
    }
}

/// From moulded to extreme displacement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shell {
    /// Moulded only: the extreme displacement is the moulded one.
    None,
    /// Extreme volume = moulded volume x factor.
    Factor(f64),
    /// Extreme volume = moulded volume + mean thickness \[m\] x wetted surface.
    Thickness(f64),
}

/// Densities of water \[t/m^3\]. Outside this band it is another unit, not another water: fresh 0.995, Dead Sea 1.24.
pub const DENSITIES: RangeInclusive<f64> = 0.9..=1.3;

/// Heights of centres of gravity above the base line \[m\]. Outside this band it is another unit.
pub const GRAVITY_HEIGHTS: RangeInclusive<f64> = -1e3..=1e3;

/// Mean thicknesses of the shell \[m\].
pub const SHELL_THICKNESSES: RangeInclusive<f64> = 0.0..=1.0;

/// Extreme volumes over moulded ones.
pub const SHELL_FACTORS: RangeInclusive<f64> = 1.0..=1.1;

/// What the coefficients and masses of a table are referred to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conventions {
    /// Density of the water [t/m^3].
    pub density: f64,
    /// Length for coefficients.
    pub coefficient_length: CoefficientLength,
    /// Section for C_P.
    pub prismatic_section: PrismaticSection,
    /// Where the LCB on pages is measured from; XCB and XCBPC of files do not follow it.
    pub lcb_reference: LcbReference,
    /// Shell plating.
    pub shell: Shell,
    /// Thickness of the keel below the base line \[m\]: extreme draught = moulded draught + this.
    pub keel_thickness: f64,
    /// Height of the centre of gravity above the base line \[m\], when known; GM and MTC use it.
    pub centre_of_gravity_height: Option<f64>,
    /// Main dimensions that were assumed, because the table that the hull was laid through does not state them.
    #[doc(hidden)]
    pub assumed: Assumed,
    /// What the user stated, of that which every page names.
    #[doc(hidden)]
    pub given: Given,
    /// How stations are numbered.
    pub stations: StationNumbers,
}

/// Which of the main dimensions a table left to be assumed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Assumed {
    /// L_PP.
    pub length: bool,
    /// B.
    pub breadth: bool,
    /// D.
    pub depth: bool,
}

impl Assumed {
    /// All that is not stated, or stated with what can be no dimension.
    #[must_use]
    pub fn of(stated: &StatedParticulars) -> Self {
        let open = |value: Option<f64>| !value.is_some_and(|value| value.is_finite() && value > 0.0);
        Self {
            length: open(stated.length_between_perpendiculars),
            breadth: open(stated.breadth),
            depth: open(stated.depth),
        }
    }

    /// Symbols of those that were assumed: of `L_PP`, `B` and `D`. A draught never is.
    #[must_use]
    pub fn symbols(&self) -> Vec<&'static str> {
        let all = [("L_PP", self.length), ("B", self.breadth), ("D", self.depth)];
        all.into_iter().filter(|(_, assumed)| *assumed).map(|(symbol, _)| symbol).collect()
    }
}

/// Which values a user stated, in a design or a command. The others come from a table, or were assumed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Given {
    /// L_PP.
    pub length: bool,
    /// B.
    pub breadth: bool,
    /// T; none where the hull has no design draught.
    pub draught: Option<bool>,
    /// Where the printed LCB is measured from.
    pub lcb_reference: bool,
    /// Density of the water.
    pub density: bool,
}

/// Of a hull whose dimensions were stated and whose water was not.
impl Default for Given {
    fn default() -> Self {
        Self { length: true, breadth: true, draught: Some(true), lcb_reference: false, density: false }
    }
}

impl Given {
    /// Of a table; `draught` says whether the user stated that of the hull, where it has one.
    #[must_use]
    pub fn of_table(draught: Option<bool>) -> Self {
        Self { length: false, breadth: false, draught, ..Self::default() }
    }
}

impl Conventions {
    /// What is given, from the table and assumed of L_PP, B, T, the origin of LCB and the density, in one sentence.
    #[must_use]
    pub fn sources(&self) -> String {
        let Given { length, breadth, draught, lcb_reference, density } = self.given;
        let all = [
            ("L_PP", Some(length && !self.assumed.length), self.assumed.length),
            ("B", Some(breadth && !self.assumed.breadth), self.assumed.breadth),
            ("T", draught, false),
            ("LCB origin", Some(lcb_reference), true),
            ("density", Some(density), true),
        ];
        let of = |word: &str, is: fn(bool, bool) -> bool| {
            let names = all.into_iter().filter(|(_, given, assumed)| given.is_some_and(|given| is(given, *assumed)));
            let names: Vec<&str> = names.map(|(name, _, _)| name).collect();
            (!names.is_empty()).then(|| format!("{word}: {}", names.join(", ")))
        };
        let parts = [
            of("given", |given, _| given),
            of("from the table", |given, assumed| !given && !assumed),
            of("assumed", |given, assumed| !given && assumed),
        ];
        parts.into_iter().flatten().collect::<Vec<_>>().join("; ")
    }
}

/// ` (assumed)` where it was, for what follows a dimension in a line of text.
#[must_use]
pub fn assumed_mark(assumed: bool) -> &'static str {
    if assumed { " (assumed)" } else { "" }
}

impl Default for Conventions {
    fn default() -> Self {
        Self {
            density: 1.025,
            coefficient_length: CoefficientLength::BetweenPerpendiculars,
            prismatic_section: PrismaticSection::Maximum,
            lcb_reference: LcbReference::AftPerpendicular,
            shell: Shell::None,
            keel_thickness: 0.0,
            centre_of_gravity_height: None,
            assumed: Assumed::default(),
            given: Given::default(),
            stations: StationNumbers::default(),
        }
    }
}

/// One statement of the conventions of a table: what, and how it is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Statement {
    /// What it is about, in words.
    pub subject: &'static str,
    /// How it is.
    pub text: String,
}

impl Conventions {
    /// Values that no ship and no water have, each with its name in files, what it is and what it may be.
    #[must_use]
    pub fn faults(&self) -> Vec<String> {
        let (factor, thickness) = match self.shell {
            Shell::None => (None, None),
            Shell::Factor(factor) => (Some(factor), None),
            Shell::Thickness(thickness) => (None, Some(thickness)),
        };
        let values = [
            ("density", Some(self.density), " t/m3", DENSITIES),
            ("KG", self.centre_of_gravity_height, " m", GRAVITY_HEIGHTS),
            ("shell.factor", factor, "", SHELL_FACTORS),
            ("shell.thickness", thickness, " m", SHELL_THICKNESSES),
        ];
        let fault = |(name, value, unit, range): (&str, Option<f64>, &str, RangeInclusive<f64>)| {
            let value = value.filter(|value| !range.contains(value))?;
            Some(format!("{name} is {value}{unit}, expected {} to {}", range.start(), range.end()))
        };
        values.into_iter().filter_map(fault).collect()
    }

    /// What the numbers of a table are referred to, one statement a line; to be printed with every table.
    #[must_use]
    #[doc(hidden)]
    pub fn statements(&self) -> Vec<Statement> {
        let say = |subject, text: &str| Statement { subject, text: text.to_owned() };
        let (metacentre, known) = match self.centre_of_gravity_height {
            Some(height) => ("GM_L", format!("KG = {height} m")),
            None => ("BM_L", "KG not given".to_owned()),
        };
        let mut list = vec![
            say("frame", "x forward from the aft perpendicular AP, z up from the moulded base line; metres"),
            say("water", &format!("density {} t/m^3", self.density)),
            say(
                "coefficient length",
                match self.coefficient_length {
                    CoefficientLength::BetweenPerpendiculars => "L = Lpp",
                    CoefficientLength::Waterline => "L = L_WL at each draught",
                },
            ),
            say(
                "coefficient breadth and draught",
                "moulded breadth B of the particulars; T of the row, from the base line",
            ),
            say(
                "prismatic coefficients",
                match self.prismatic_section {
                    PrismaticSection::Maximum => "C_P, C_PF, C_PA refer to the largest section, A_X",
                    PrismaticSection::Midship => "C_P, C_PF, C_PA refer to the section at midship, A_M",
                },
            ),
            say("midship", "at Lpp/2"),
            say("longitudinal centres", "XCB and LCF from AP, + forward; XCBPC in % of Lpp from midship, + forward"),
            say("printed centre of buoyancy", self.lcb_reference.statement()),
            say(
                "shell",
                &match self.shell {
                    Shell::None => "none: the extreme displacement is the moulded one".to_owned(),
                    Shell::Factor(factor) => format!("extreme volume = {factor} x moulded volume"),
                    Shell::Thickness(thickness) => {
                        format!("extreme volume = moulded volume + {thickness} m x wetted surface")
                    }
                },
            ),
            say(
                "draught to the underside of the keel",
                &if self.keel_thickness > 0.0 {
                    format!("T_K = T + {} m, the thickness of the keel plate", self.keel_thickness)
                } else {
                    "T_K = T, the moulded draught: no thickness of the keel plate is given, and the shell is not counted".to_owned()
                },
            ),
            say("moment to change trim", &format!("MTC = displacement x {metacentre} / (100 Lpp); {known}")),
            say("trim", "trim = T_A - T_F, + by the stern; rows are at even keel"),
            say("wetted surface", "side, flat of bottom, immersed transom and flat bow; the deck is not counted"),
            say(
                "parallel middle body",
                "sections equal to the largest one within 1e-6 of it over at least 1 % of Lpp; L_E from its fore end to FP, \
                 L_R from AP to its aft end, both from x_AX where there is none",
            ),
            say("position of the largest section", "x_AX is the middle of the parallel middle body where there is one"),
        ];
        let assumed = self.assumed.symbols();
        if !assumed.is_empty() {
            let text =
                format!("{} assumed: the table that the hull was laid through does not state them", assumed.join(", "));
            list.push(say("main dimensions", &text));
        }
        list
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_formula_of_mtc_follows_the_centre_of_gravity() {
        let text = |conventions: Conventions| {
            let all = conventions.statements();
            all.iter().find(|s| s.subject == "moment to change trim").map(|s| s.text.clone()).unwrap()
        };
        assert!(text(Conventions::default()).contains("BM_L"));
        let known = Conventions { centre_of_gravity_height: Some(6.5), ..Conventions::default() };
        assert!(text(known).contains("GM_L / (100 Lpp); KG = 6.5 m"));
    }

    #[test]
    fn what_is_given_and_what_is_not_is_one_sentence() {
        let of = |given: Given, assumed: Assumed| Conventions { given, assumed, ..Conventions::default() }.sources();
        let none = Assumed::default();
        assert_eq!(of(Given::default(), none), "given: L_PP, B, T; assumed: LCB origin, density");
        let table = Given { density: true, ..Given::of_table(Some(false)) };
        let breadth = Assumed { breadth: true, ..none };
        assert_eq!(of(table, breadth), "given: density; from the table: L_PP, T; assumed: B, LCB origin");
        assert!(!of(Given::of_table(None), none).contains('T'));
    }

    #[test]
    fn one_centre_from_every_reference() {
        let printed = LcbReference::ALL.map(|reference| reference.lcb(51.0, 100.0));
        for (found, expected) in printed.into_iter().zip([51.0, 1.0, 49.0, 1.0]) {
            assert!((found - expected).abs() < 1e-12, "{printed:?}");
        }
        assert_eq!(LcbReference::ALL.map(LcbReference::unit), ["m", "m", "m", "%"]);
    }

    #[test]
    fn every_switch_is_stated() {
        let text = |conventions: &Conventions| format!("{:?}", conventions.statements());
        let base = Conventions::default();
        for changed in [
            Conventions { density: 1.0, ..base },
            Conventions { coefficient_length: CoefficientLength::Waterline, ..base },
            Conventions { prismatic_section: PrismaticSection::Midship, ..base },
            Conventions { lcb_reference: LcbReference::Midship, ..base },
            Conventions { lcb_reference: LcbReference::ForwardPerpendicular, ..base },
            Conventions { lcb_reference: LcbReference::Percent, ..base },
            Conventions { shell: Shell::Factor(1.006), ..base },
            Conventions { shell: Shell::Thickness(0.012), ..base },
            Conventions { keel_thickness: 0.02, ..base },
            Conventions { centre_of_gravity_height: Some(4.0), ..base },
        ] {
            assert_ne!(text(&changed), text(&base), "{changed:?}");
        }
    }
}
