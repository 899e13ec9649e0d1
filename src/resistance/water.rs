//! Water: density, viscosity, gravity.

use std::ops::RangeInclusive;

/// Standard gravity [m/s^2].
const GRAVITY: f64 = 9.80665;
/// Temperatures whose viscosity is known \[deg C\].
pub const TEMPERATURES: RangeInclusive<f64> = 0.0..=30.0;
/// Densities of fresh and of sea water at 15 deg C [kg/m^3] (ITTC 2011).
const DENSITIES: [f64; 2] = [999.1026, 1026.0210];
/// Steps of the tables \[deg C\].
const STEP: f64 = 5.0;
/// Kinematic viscosity at 0, 5 ... 30 deg C of fresh and of sea water (35.16 g/kg) [1e-6 m^2/s] (ITTC 7.5-02-01-03, 2011;
/// IAPWS 2008 at 0 deg C).
const TABLES: [[f64; 7]; 2] = [
    [1.7918, 1.5182, 1.3063, 1.1386, 1.0034, 0.8927, 0.8007],
    [1.8544, 1.5762, 1.3604, 1.1892, 1.0508, 0.9371, 0.8425],
];

/// The water that a ship moves in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Water {
    /// Density [kg/m^3].
    pub density: f64,
    /// Kinematic viscosity [m^2/s].
    pub viscosity: f64,
    /// Gravity [m/s^2].
    pub gravity: f64,
}

impl Water {
    /// Water of a density [kg/m^3] at a temperature \[deg C\], under standard gravity.
    #[must_use]
    pub fn new(density: f64, temperature: f64) -> Self {
        Self { density, viscosity: kinematic_viscosity(density, temperature), gravity: GRAVITY }
    }

    /// Water of a density [t/m^3] for what does not depend on its viscosity: that of 15 deg C.
    #[must_use]
    pub fn of_density(density: f64) -> Self {
        Self::new(1000.0 * density, 15.0)
    }
}

/// Kinematic viscosity [m^2/s] of water that has this density [kg/m^3] at 15 deg C, at a temperature \[deg C\]: the
/// tables of ITTC 7.5-02-01-03 (2011), between fresh and sea water by density, between steps by a cubic through the
/// logarithms of four (2e-4). Beyond fresh water, sea water and 0 to 30 deg C the values of the ends.
#[must_use]
pub fn kinematic_viscosity(density: f64, temperature: f64) -> f64 {
    let [fresh, sea] = TABLES.map(|table| interpolated(&table, temperature));
    let part = ((density - DENSITIES[0]) / (DENSITIES[1] - DENSITIES[0])).clamp(0.0, 1.0);
    1e-6 * (fresh + part * (sea - fresh))
}

fn interpolated(table: &[f64; 7], temperature: f64) -> f64 {
    let place = temperature.clamp(*TEMPERATURES.start(), *TEMPERATURES.end()) / STEP;
    let first = (place.floor() as usize).saturating_sub(1).min(table.len() - 4);
    let nodes: [usize; 4] = std::array::from_fn(|k| first + k);
    let weight = |k: usize| {
        let others = nodes.iter().filter(|&&j| j != k);
        others.map(|&j| (place - j as f64) / (k as f64 - j as f64)).product::<f64>()
    };
    nodes.iter().map(|&k| weight(k) * table[k].ln()).sum::<f64>().exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of the table of ITTC 7.5-02-01-03 (2011) between the steps that are carried.
    #[test]
    fn viscosity_of_sea_water_follows_the_table() {
        for (temperature, value) in [(1.0, 1.7926), (7.0, 1.4836), (12.0, 1.2873), (15.0, 1.1892), (18.0, 1.1028)] {
            let found = 1e6 * kinematic_viscosity(1026.021, temperature);
            assert!((found / value - 1.0).abs() < 2e-4, "{temperature}: {found}");
        }
        for (temperature, value) in [(22.0, 1.0027), (28.0, 0.87837)] {
            let found = 1e6 * kinematic_viscosity(1030.0, temperature);
            assert!((found / value - 1.0).abs() < 2e-4, "{temperature}: {found}");
        }
        assert!((1e6 * kinematic_viscosity(999.0, 15.0) - 1.1386).abs() < 1e-12);
        assert!(kinematic_viscosity(1012.0, 15.0) > kinematic_viscosity(999.0, 15.0));
    }
}
