//! Hulls for CAD, and the surfaces of its files: the B-splines themselves, exact nets and knots.

mod dxf;
mod iges;
mod rhino;
mod step;
mod surfaces;

pub(super) use dxf::{Drawing, is_dxf, read_dxf};
pub use dxf::{DxfLine, DxfVersion, write_dxf};
pub use iges::write_iges;
pub(super) use iges::{is_iges, read_iges};
pub use rhino::write_3dm;
pub(super) use rhino::{Model, ModelObject, PlacedObject, is_3dm, read_3dm, united};
pub use step::write_step;
pub(super) use step::{is_step, read_step};
pub(super) use surfaces::{CadCurve, CadSurfaces, Unread, is_closed, sampled, whole};

/// Unit of length of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CadUnit {
    /// Metres.
    #[default]
    Metre,
    /// Millimetres.
    Millimetre,
}

impl CadUnit {
    /// Units in a metre.
    #[must_use]
    pub const fn in_a_metre(self) -> f64 {
        match self {
            Self::Metre => 1.0,
            Self::Millimetre => 1000.0,
        }
    }
}

/// A real number with a decimal point that is read back bit for bit: 1., 0.25, 1.5E-7.
fn real(value: f64) -> String {
    let text = format!("{:?}", value + 0.0);
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, ""));
    let mantissa = match mantissa.strip_suffix(".0") {
        Some(whole) => format!("{whole}."),
        None if mantissa.contains('.') => mantissa.to_owned(),
        None => format!("{mantissa}."),
    };
    if exponent.is_empty() { mantissa } else { format!("{mantissa}E{exponent}") }
}

/// Knots with their multiplicities.
fn multiplicities(knots: &[f64]) -> Vec<(f64, usize)> {
    let mut list: Vec<(f64, usize)> = Vec::new();
    for &knot in knots {
        match list.last_mut() {
            Some((last, times)) if last.to_bits() == knot.to_bits() => *times += 1,
            _ => list.push((knot, 1)),
        }
    }
    list
}

/// Characters that every reader takes: printable ASCII, others as `_`.
fn plain(name: &str) -> String {
    name.chars().map(|c| if c == ' ' || c.is_ascii_graphic() { c } else { '_' }).collect()
}

#[cfg(test)]
mod tests;
