//! A prediction: what went in with where it came from, and a row a speed.

use super::components::{Components, Method, Viscous};
use super::holtrop::{Edition, Holtrop};
use super::michell::{THIN_SHIP_LIMITS, ThinShip};
use super::ranges::{Range, outside};
use super::ship::{ShipFault, ShipParameters};
use super::water::Water;

/// Where an input came from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InputOrigin {
    /// The user stated it.
    Given,
    /// The hull has it.
    FromHull,
    /// The program supplied it.
    Assumed,
}

impl InputOrigin {
    /// The words for it.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Given => "given",
            Self::FromHull => "from the hull",
            Self::Assumed => "assumed",
        }
    }
}

/// One input.
#[derive(Debug, Clone, PartialEq)]
pub struct PredictionInput {
    /// Symbol.
    pub symbol: &'static str,
    /// Name, with its sign convention.
    pub name: &'static str,
    /// Value in `unit`.
    pub value: f64,
    /// Unit; `-` where there is none.
    pub unit: &'static str,
    /// Decimals that are shown.
    pub decimals: usize,
    /// Where it came from.
    pub origin: InputOrigin,
    /// How it was found, where that needs words; else empty.
    pub note: &'static str,
}

/// Resistance at one speed, with what leaves the range of the method.
#[derive(Debug, Clone, PartialEq)]
pub struct PredictionRow {
    /// The parts.
    pub components: Components,
    /// Ranges of the data that the ship leaves at this speed.
    pub outside: Vec<Range>,
}

/// A form factor and a correlation allowance instead of those of a method.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ViscousOverrides {
    /// 1 + k1.
    pub form_factor: Option<f64>,
    /// C_A.
    pub allowance: Option<f64>,
}

/// The rows of a prediction with the form factor and the allowance that they have.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// 1 + k1.
    pub form_factor: f64,
    /// C_A.
    pub allowance: f64,
    /// A row a speed, in the order of the speeds.
    pub rows: Vec<PredictionRow>,
}

/// What a page with figures of a method states.
#[must_use]
pub fn limits(method: Method) -> &'static str {
    match method {
        Method::Holtrop1984 | Method::Holtrop1982 => {
            "Regression of models and trials of displacement ships: calm deep water, clean hull, no wind, no sea margin. \
             Beyond the ranges of the data it is an extrapolation."
        }
        Method::Michell => THIN_SHIP_LIMITS,
        Method::Ittc57 => {
            "Viscous resistance alone: no wave resistance, no transom, no bulb; calm deep water, clean hull."
        }
    }
}

/// Predicts by Holtrop and Mennen, by ITTC-57, or by Michell where the hull is given, at speeds [m/s].
///
/// Without a form factor ITTC-57 and Michell take that of Holtrop 1984 where the ship has one, else 1; without an
/// allowance 0.
///
/// # Errors
/// What the formulas of Holtrop and Mennen are not defined for, where they are the method.
pub fn predict(
    method: Method,
    ship: &ShipParameters,
    thin: Option<&ThinShip>,
    speeds: &[f64],
    water: &Water,
    overrides: ViscousOverrides,
) -> Result<Prediction, Vec<ShipFault>> {
    let impossible = ship.impossible();
    if !impossible.is_empty() {
        return Err(impossible);
    }
    let edition = if method == Method::Holtrop1982 { Edition::Of1982 } else { Edition::Of1984 };
    let holtrop = Holtrop::new(ship, edition);
    let statistical = matches!(method, Method::Holtrop1982 | Method::Holtrop1984);
    let of_method = match (&holtrop, statistical) {
        (Ok(holtrop), true) => [holtrop.form_factor(), holtrop.correlation_allowance()],
        (Ok(holtrop), false) => [holtrop.form_factor(), 0.0],
        (Err(faults), true) => return Err(faults.clone()),
        (Err(_), false) => [1.0, 0.0],
    };
    let form_factor = overrides.form_factor.unwrap_or(of_method[0]);
    let allowance = overrides.allowance.unwrap_or(of_method[1]);
    let viscous = Viscous {
        length: ship.length,
        wetted_surface: ship.wetted_surface,
        form_factor,
        allowance,
        appendages: ship.appendages.iter().map(|one| one.surface * one.factor).sum(),
    };
    let waves = thin.filter(|_| method == Method::Michell).map(|thin| thin.wave_resistances(speeds, water));
    let row = |(n, &speed): (usize, &f64)| {
        let wave = waves.as_ref().and_then(|waves| waves.get(n)).copied().unwrap_or(0.0);
        let plain = viscous.components(speed, wave, water);
        let components = match (&holtrop, statistical) {
            (Ok(holtrop), true) => {
                Components { form_factor, allowance: plain.allowance, ..holtrop.components(speed, water) }
            }
            _ => plain,
        };
        PredictionRow { outside: outside(method, components.froude, form(ship)), components }
    };
    let rows: Vec<PredictionRow> = speeds.iter().enumerate().map(row).collect();
    // Ships of displacement float at speeds where their resistance is a part of their weight.
    let weight = water.density * water.gravity * ship.volume;
    let beyond = rows.iter().map(|row| row.components.total() / weight).find(|part| part.is_nan() || *part > 1.0);
    if let Some(value) = beyond {
        return Err(vec![ShipFault { symbol: "R_T over the weight", value, limit: "no more than 1, at lower speeds" }]);
    }
    Ok(Prediction { form_factor, allowance, rows })
}

/// L/B, B/T, C_P and C_B.
fn form(ship: &ShipParameters) -> [f64; 4] {
    let (b, t) = (ship.breadth, ship.draught());
    [ship.length / b, b / t, ship.prismatic_coefficient(), ship.block_coefficient()]
}
