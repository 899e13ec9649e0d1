//! Conventions of a hydrostatic table: what is switchable, and is printed with every result.

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

/// From moulded to extreme displacement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shell {
    /// Moulded only: the extreme displacement is the moulded one.
    None,
    /// Extreme volume = moulded volume x factor.
    Factor(f64),
    /// Extreme volume = moulded volume + mean thickness [m] x wetted surface.
    Thickness(f64),
}

/// What the coefficients and masses of a table are referred to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conventions {
    /// Density of the water [t/m^3].
    pub density: f64,
    /// Length for coefficients.
    pub coefficient_length: CoefficientLength,
    /// Section for C_P.
    pub prismatic_section: PrismaticSection,
    /// Shell plating.
    pub shell: Shell,
    /// Thickness of the keel below the base line [m]: extreme draught = moulded draught + this.
    pub keel_thickness: f64,
    /// Height of the centre of gravity above the base line [m], when known; GM and MTC use it.
    pub centre_of_gravity_height: Option<f64>,
}

impl Default for Conventions {
    fn default() -> Self {
        Self {
            density: 1.025,
            coefficient_length: CoefficientLength::BetweenPerpendiculars,
            prismatic_section: PrismaticSection::Maximum,
            shell: Shell::None,
            keel_thickness: 0.0,
            centre_of_gravity_height: None,
        }
    }
}
