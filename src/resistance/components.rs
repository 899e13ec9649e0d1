//! The parts of a resistance, and the methods that give them.

use super::friction::{froude_number, ittc57, reynolds_number};
use super::water::Water;

/// A method of prediction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// Holtrop 1984.
    Holtrop1984,
    /// Holtrop and Mennen 1982.
    Holtrop1982,
    /// Wave resistance by Michell 1898, friction by ITTC-57 with a form factor.
    Michell,
    /// Friction by ITTC-57 with a form factor; no wave resistance.
    Ittc57,
}

impl Method {
    /// All methods, the default first.
    pub const ALL: [Self; 4] = [Self::Holtrop1984, Self::Holtrop1982, Self::Michell, Self::Ittc57];

    /// The word for it.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Holtrop1984 => "holtrop-1984",
            Self::Holtrop1982 => "holtrop-1982",
            Self::Michell => "michell",
            Self::Ittc57 => "ittc-57",
        }
    }

    /// Where it was published.
    #[must_use]
    pub fn source(self) -> &'static str {
        match self {
            Self::Holtrop1984 => "J. Holtrop, Int. Shipbuilding Progress 31 (1984)",
            Self::Holtrop1982 => "J. Holtrop and G. G. J. Mennen, Int. Shipbuilding Progress 29 (1982)",
            Self::Michell => "J. H. Michell, Phil. Mag. 45 (1898), with the ITTC-57 line",
            Self::Ittc57 => "8th ITTC (1957)",
        }
    }
}

/// Resistance at one speed; forces in N against the motion.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Components {
    /// Speed [m/s].
    pub speed: f64,
    /// Froude number on the length of the waterline.
    pub froude: f64,
    /// Reynolds number on the same length.
    pub reynolds: f64,
    /// C_F of ITTC-57.
    pub friction_coefficient: f64,
    /// 1 + k1.
    pub form_factor: f64,
    /// R_F \[N\], without form factor.
    pub friction: f64,
    /// R_APP \[N\].
    pub appendages: f64,
    /// R_W \[N\].
    pub wave: f64,
    /// R_B \[N\], pressure of a bulb near the surface.
    pub bulb: f64,
    /// R_TR \[N\], pressure of an immersed transom.
    pub transom: f64,
    /// R_A \[N\], model-ship correlation.
    pub allowance: f64,
}

impl Components {
    /// R_T = R_F (1 + k1) + R_APP + R_W + R_B + R_TR + R_A \[N\].
    #[must_use]
    pub fn total(&self) -> f64 {
        self.friction * self.form_factor + self.appendages + self.wave + self.bulb + self.transom + self.allowance
    }

    /// Effective power P_E = R_T U \[W\].
    #[must_use]
    pub fn effective_power(&self) -> f64 {
        self.total() * self.speed
    }
}

/// Delivered power P_D = P_E / eta_D \[W\] of an effective power \[W\] and a propulsive efficiency.
#[must_use]
pub fn power(effective: f64, efficiency: f64) -> f64 {
    effective / efficiency
}

/// What the viscous parts of a resistance depend on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viscous {
    /// Length on the waterline \[m\].
    pub length: f64,
    /// Wetted surface [m^2].
    pub wetted_surface: f64,
    /// 1 + k1.
    pub form_factor: f64,
    /// C_A.
    pub allowance: f64,
    /// Sum of the surfaces of appendages times their factors 1 + k2 [m^2].
    pub appendages: f64,
}

impl Viscous {
    /// Friction by ITTC-57 with form factor, appendages and correlation allowance at a speed [m/s], and a wave resistance
    /// \[N\] that comes from elsewhere.
    #[must_use]
    pub fn components(&self, speed: f64, wave: f64, water: &Water) -> Components {
        let reynolds = reynolds_number(speed, self.length, water.viscosity);
        let (pressure, friction) = (0.5 * water.density * speed * speed, ittc57(reynolds));
        Components {
            speed,
            froude: froude_number(speed, self.length, water.gravity),
            reynolds,
            friction_coefficient: friction,
            form_factor: self.form_factor,
            friction: pressure * self.wetted_surface * friction,
            appendages: pressure * self.appendages * friction,
            wave,
            allowance: pressure * self.wetted_surface * self.allowance,
            ..Components::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_sum_to_the_total() {
        let water = Water { density: 1000.0, viscosity: 1e-6, gravity: 9.81 };
        let viscous =
            Viscous { length: 100.0, wetted_surface: 2000.0, form_factor: 1.2, allowance: 4e-4, appendages: 15.0 };
        let at = viscous.components(10.0, 5e3, &water);
        let friction = 0.075 / 49.0;
        assert!((at.total() - 5e4 * (2000.0 * (1.2 * friction + 4e-4) + 15.0 * friction) - 5e3).abs() < 1e-6);
        assert!((power(at.effective_power(), 0.5) - 20.0 * at.total()).abs() < 1e-6);
    }
}
