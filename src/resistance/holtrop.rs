//! Resistance by Holtrop and Mennen, the sets of 1982 and of 1984.
//!
//! R = R_F (1 + k1) + R_APP + R_W + R_B + R_TR + R_A, regressions of model tests and trials:
//! * J. Holtrop and G. G. J. Mennen, An approximate power prediction method, Int. Shipbuilding Progress 29 (1982);
//! * J. Holtrop, A statistical re-analysis of resistance and propulsion data, Int. Shipbuilding Progress 31 (1984):
//!   another form factor, m4 for m2, and a formula of its own for R_W above Fn 0.55.
//!
//! Formulas are used as printed, with these corrections and remarks:
//! * c15 is -1.69385 for L^3 / volume < 512. A sign + in some prints is a misprint: with it the worked example of 1982
//!   has humps for hollows, and not its R_W.
//! * The worked example of 1982 (L 205 m, 25 knots) prints R_A 221.98 kN. The formula for C_A gives 0.000352 with its
//!   data as printed, and R_A 220.57 kN: an inconsistency of the paper.
//! * The wetted surface, the half angle and C_A are the same in both sets.

use super::components::Components;
use super::friction::{froude_number, ittc57, reynolds_number};
use super::ship::{ShipFault, ShipParameters};
use super::water::Water;

/// Which set of coefficients.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Edition {
    /// Holtrop and Mennen 1982.
    Of1982,
    /// Holtrop 1984.
    Of1984,
}

/// Exponent d of the Froude number.
const EXPONENT: f64 = -0.9;
/// Froude numbers between which R_W of 1984 is linear.
const BETWEEN: [f64; 2] = [0.40, 0.55];

/// A ship with the coefficients that do not depend on its speed.
#[derive(Debug, Clone, PartialEq)]
pub struct Holtrop {
    ship: ShipParameters,
    edition: Edition,
    form_factor: f64,
    allowance: f64,
    c1: f64,
    c2: f64,
    c5: f64,
    c15: f64,
    c17: f64,
    lambda: f64,
    m1: f64,
    m3: f64,
}

impl Holtrop {
    /// Coefficients of a ship.
    ///
    /// # Errors
    /// Every parameter for which the formulas are not defined.
    pub fn new(ship: &ShipParameters, edition: Edition) -> Result<Self, Vec<ShipFault>> {
        let faults = ship.faults();
        if !faults.is_empty() {
            return Err(faults);
        }
        let (l, b, t, volume) = (ship.length, ship.breadth, ship.draught(), ship.volume);
        let (cp, cm) = (ship.prismatic_coefficient(), ship.midship_coefficient);
        let c7 = match b / l {
            ratio if ratio < 0.11 => 0.229577 * ratio.powf(0.33333),
            ratio if ratio <= 0.25 => ratio,
            _ => 0.5 - 0.0625 * l / b,
        };
        let c16 =
            if cp < 0.80 { 8.07981 * cp - 13.8673 * cp.powi(2) + 6.984388 * cp.powi(3) } else { 1.73014 - 0.7067 * cp };
        let slenderness = l.powi(3) / volume;
        let c15 = match slenderness {
            ratio if ratio < 512.0 => -1.69385,
            ratio if ratio <= 1726.91 => -1.69385 + (l / volume.cbrt() - 8.0) / 2.36,
            _ => 0.0,
        };
        let c2 = bulb_reduction(ship);
        Ok(Self {
            form_factor: match edition {
                Edition::Of1982 => form_factor_1982(ship),
                Edition::Of1984 => form_factor_1984(ship),
            },
            allowance: correlation_allowance(ship, c2),
            c1: 2_223_105.0 * c7.powf(3.78613) * (t / b).powf(1.07961) * (90.0 - ship.half_angle).powf(-1.37565),
            c2,
            c5: (1.0 - 0.8 * ship.transom_area / (b * t * cm)).max(0.0),
            c15,
            c17: 6919.3 * cm.powf(-1.3346) * (volume / l.powi(3)).powf(2.00977) * (l / b - 2.0).powf(1.40692),
            lambda: if l / b < 12.0 { 1.446 * cp - 0.03 * l / b } else { 1.446 * cp - 0.36 },
            m1: 0.0140407 * l / t - 1.75254 * volume.cbrt() / l - 4.79323 * b / l - c16,
            m3: -7.2035 * (b / l).powf(0.326869) * (t / b).powf(0.605375),
            ship: ship.clone(),
            edition,
        })
    }

    /// 1 + k1.
    #[must_use]
    pub fn form_factor(&self) -> f64 {
        self.form_factor
    }

    /// The correlation allowance C_A.
    #[must_use]
    pub fn correlation_allowance(&self) -> f64 {
        self.allowance
    }

    /// The resistance at a speed [m/s]; all 0 at speed 0.
    #[must_use]
    pub fn components(&self, speed: f64, water: &Water) -> Components {
        let ship = &self.ship;
        let froude = froude_number(speed, ship.length, water.gravity);
        let reynolds = reynolds_number(speed, ship.length, water.viscosity);
        let friction = ittc57(reynolds);
        let pressure = 0.5 * water.density * speed * speed;
        let appendages: f64 = ship.appendages.iter().map(|one| one.surface * one.factor).sum();
        let moving = if speed > 0.0 { 1.0 } else { 0.0 };
        Components {
            speed,
            froude,
            reynolds,
            friction_coefficient: friction,
            form_factor: self.form_factor,
            friction: pressure * ship.wetted_surface * friction,
            appendages: pressure * appendages * friction,
            wave: if moving > 0.0 { self.wave(froude, water) } else { 0.0 },
            bulb: self.bulb(speed, water),
            transom: pressure * ship.transom_area * self.transom_coefficient(speed, water),
            allowance: pressure * ship.wetted_surface * self.allowance,
        }
    }

    fn wave(&self, froude: f64, water: &Water) -> f64 {
        let [low, high] = BETWEEN;
        let part = match self.edition {
            Edition::Of1982 => {
                let m2 = self.c15 * self.ship.prismatic_coefficient().powi(2) * (-0.1 * froude.powi(-2)).exp();
                self.hump(self.c1, self.m1, m2, froude)
            }
            Edition::Of1984 if froude <= low => self.hump_1984(self.c1, self.m1, froude),
            Edition::Of1984 if froude >= high => self.hump_1984(self.c17, self.m3, froude),
            Edition::Of1984 => {
                let ends = [self.hump_1984(self.c1, self.m1, low), self.hump_1984(self.c17, self.m3, high)];
                ends[0] + (10.0 * froude - 4.0) * (ends[1] - ends[0]) / 1.5
            }
        };
        self.c2 * self.c5 * self.ship.volume * water.density * water.gravity * part
    }

    fn hump_1984(&self, c: f64, m: f64, froude: f64) -> f64 {
        self.hump(c, m, self.c15 * 0.4 * (-0.034 * froude.powf(-3.29)).exp(), froude)
    }

    /// c exp(m Fn^d + a cos(lambda Fn^-2)).
    fn hump(&self, c: f64, m: f64, amplitude: f64, froude: f64) -> f64 {
        c * (m * froude.powf(EXPONENT) + amplitude * (self.lambda * froude.powi(-2)).cos()).exp()
    }

    /// Pressure of a bulb near the surface, R_B.
    fn bulb(&self, speed: f64, water: &Water) -> f64 {
        let ship = &self.ship;
        if ship.bulb_area <= 0.0 || speed <= 0.0 {
            return 0.0;
        }
        let emergence = 0.56 * ship.bulb_area.sqrt() / (ship.draught_fore - 1.5 * ship.bulb_height);
        let depth = ship.draught_fore - ship.bulb_height - 0.25 * ship.bulb_area.sqrt();
        let froude = speed / (water.gravity * depth + 0.15 * speed * speed).max(f64::MIN_POSITIVE).sqrt();
        0.11 * (-3.0 * emergence.powi(-2)).exp()
            * froude.powi(3)
            * ship.bulb_area.powf(1.5)
            * water.density
            * water.gravity
            / (1.0 + froude * froude)
    }

    /// c6 = 0.2 (1 - 0.2 F_nT) for F_nT < 5, else 0.
    fn transom_coefficient(&self, speed: f64, water: &Water) -> f64 {
        let ship = &self.ship;
        if ship.transom_area <= 0.0 {
            return 0.0;
        }
        let depth = 2.0 * ship.transom_area / (ship.breadth * (1.0 + ship.waterplane_coefficient));
        let froude = speed / (water.gravity * depth).sqrt();
        if froude < 5.0 { 0.2 * (1.0 - 0.2 * froude) } else { 0.0 }
    }
}

fn form_factor_1982(ship: &ShipParameters) -> f64 {
    let (l, cp) = (ship.length, ship.prismatic_coefficient());
    let c12 = match ship.draught() / l {
        ratio if ratio > 0.05 => ratio.powf(0.2228446),
        ratio if ratio > 0.02 => 48.20 * (ratio - 0.02).powf(2.078) + 0.479948,
        _ => 0.479948,
    };
    let c13 = 1.0 + 0.003 * ship.stern.coefficient();
    c13 * (0.93
        + c12
            * (ship.breadth / ship.run_length()).powf(0.92497)
            * (0.95 - cp).max(1e-3).powf(-0.521448)
            * (1.0 - cp + 0.0225 * ship.lcb).powf(0.6906))
}

fn form_factor_1984(ship: &ShipParameters) -> f64 {
    let (l, b, t) = (ship.length, ship.breadth, ship.draught());
    let c14 = 1.0 + 0.011 * ship.stern.coefficient();
    0.93 + 0.487118
        * c14
        * (b / l).powf(1.06806)
        * (t / l).powf(0.46106)
        * (l / ship.run_length()).powf(0.121563)
        * (l.powi(3) / ship.volume).powf(0.36486)
        * (1.0 - ship.prismatic_coefficient()).powf(-0.604247)
}

/// c2 = exp(-1.89 sqrt(c3)), the reduction of R_W by a bulb.
fn bulb_reduction(ship: &ShipParameters) -> f64 {
    if ship.bulb_area <= 0.0 {
        return 1.0;
    }
    let depth = 0.31 * ship.bulb_area.sqrt() + ship.draught_fore - ship.bulb_height;
    let c3 = 0.56 * ship.bulb_area.powf(1.5) / (ship.breadth * ship.draught() * depth);
    (-1.89 * c3.sqrt()).exp()
}

/// C_A = 0.006 (L + 100)^-0.16 - 0.00205 + 0.003 sqrt(L / 7.5) C_B^4 c2 (0.04 - c4), c4 = T_F / L, at most 0.04.
fn correlation_allowance(ship: &ShipParameters, c2: f64) -> f64 {
    let c4 = (ship.draught_fore / ship.length).min(0.04);
    0.006 * (ship.length + 100.0).powf(-0.16) - 0.00205
        + 0.003 * (ship.length / 7.5).sqrt() * ship.block_coefficient().powi(4) * c2 * (0.04 - c4)
}

/// (1 + k2)_eq, the mean of the factors of appendages by their surfaces; 1 without any.
#[must_use]
pub fn appendage_factor(ship: &ShipParameters) -> f64 {
    let surface: f64 = ship.appendages.iter().map(|one| one.surface).sum();
    let weighted: f64 = ship.appendages.iter().map(|one| one.surface * one.factor).sum();
    if surface > 0.0 { weighted / surface } else { 1.0 }
}

/// Half angle of entrance i_E \[deg\] from the dimensions (Holtrop and Mennen 1982): 1 + 89 exp(-(L/B)^0.80856
/// (1 - C_WP)^0.30484 (1 - C_P - 0.0225 lcb)^0.6367 (L_R/B)^0.34574 (100 volume/L^3)^0.16302), from 1 to 90.
#[must_use]
pub fn half_angle_of_entrance(ship: &ShipParameters) -> f64 {
    let (l, b) = (ship.length, ship.breadth);
    let power = (l / b).powf(0.80856)
        * (1.0 - ship.waterplane_coefficient).max(0.0).powf(0.30484)
        * (1.0 - ship.prismatic_coefficient() - 0.0225 * ship.lcb).max(0.0).powf(0.6367)
        * (ship.run_length() / b).max(0.0).powf(0.34574)
        * (100.0 * ship.volume / l.powi(3)).powf(0.16302);
    1.0 + 89.0 * (-power).exp()
}

/// Wetted surface [m^2] from the dimensions (Holtrop and Mennen 1982): L (2T + B) sqrt(C_M) (0.453 + 0.4425 C_B - 0.2862
/// C_M - 0.003467 B/T + 0.3696 C_WP) + 2.38 A_BT / C_B.
#[must_use]
pub fn wetted_surface_estimate(ship: &ShipParameters) -> f64 {
    let (b, t, cb, cm) = (ship.breadth, ship.draught(), ship.block_coefficient(), ship.midship_coefficient);
    ship.length
        * (2.0 * t + b)
        * cm.sqrt()
        * (0.453 + 0.4425 * cb - 0.2862 * cm - 0.003467 * b / t + 0.3696 * ship.waterplane_coefficient)
        + 2.38 * ship.bulb_area / cb
}

#[cfg(test)]
mod tests;
