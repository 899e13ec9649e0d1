//! Resistance of ships in calm water: ITTC-57, Holtrop and Mennen 1982 and 1984, Michell's thin ship.
//!
//! Speeds are in m/s, forces in N against the motion, powers in W, densities in kg/m^3. A published method is used as it
//! was printed, misprints are named beside the formula, and every figure that leaves the range of its data says so.

mod components;
mod friction;
mod holtrop;
mod michell;
mod prediction;
mod ranges;
mod ship;
mod water;
mod wave_term;

pub use components::{Components, Method, Viscous, power};
pub use friction::{froude_number, ittc57, reynolds_number};
pub use holtrop::{Edition, Holtrop, appendage_factor, half_angle_of_entrance, wetted_surface_estimate};
pub use michell::{THIN_SHIP_LIMITS, ThinShip, WaveForm, WaveForms, WaveGradient};
pub use prediction::{InputOrigin, Prediction, PredictionInput, PredictionRow, ViscousOverrides, limits, predict};
pub use ranges::{Range, outside};
pub use ship::{Appendage, AppendageKind, ShipFault, ShipParameters, SternShape};
pub use water::{TEMPERATURES, Water, kinematic_viscosity};
pub use wave_term::{NoWaveTerm, WaveRequest, WaveResult, WaveTerm, WaveTrade, knee};
