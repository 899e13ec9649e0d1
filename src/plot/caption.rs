//! Lines of text that several figures carry.

use super::FigureInputs;
use crate::hydrostatics::CoefficientLength;

/// `text` without the sign that lowers what follows.
pub(super) fn plain(text: &str) -> String {
    text.replace('_', " ")
}

/// Main dimensions, density and the length that coefficients are referred to.
pub(super) fn conventions(inputs: &FigureInputs) -> String {
    let p = inputs.hull.particulars();
    let c = &inputs.curves.conventions;
    let length = match c.coefficient_length {
        CoefficientLength::BetweenPerpendiculars => "L_PP",
        CoefficientLength::Waterline => "L_WL",
    };
    format!(
        "L_PP {:.2} m   B {:.2} m   T {:.2} m   D {:.2} m   ρ {:.3} t/m³   coefficients on {length}, moulded",
        p.length_between_perpendiculars, p.breadth, p.draught, p.depth, c.density
    )
}

/// Name and version of the program.
pub(super) fn program() -> String {
    concat!("loftsman ", env!("CARGO_PKG_VERSION")).to_owned()
}
