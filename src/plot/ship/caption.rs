//! Lines of text that several figures carry.

use super::inputs::FigureInputs;
use crate::hydrostatics::CoefficientLength;
use crate::plot::paper::canvas::{Anchor, Canvas, TextStyle};

/// What a drawing says of a hull that does not meet all targets.
pub(in crate::plot) fn compromise(canvas: &mut Canvas, at: [f64; 2], style: &TextStyle) {
    canvas.text(at, "A COMPROMISE: NOT ALL TARGETS ARE MET", &style.coloured("#c00000"));
}

/// `text` without the sign that lowers what follows.
pub(in crate::plot) fn plain(text: &str) -> String {
    text.replace('_', " ")
}

/// Main dimensions, density and the length that coefficients are referred to.
pub(in crate::plot) fn conventions(inputs: &FigureInputs) -> String {
    let c = &inputs.curves.conventions;
    let length = match c.coefficient_length {
        CoefficientLength::BetweenPerpendiculars => "L_PP",
        CoefficientLength::Waterline => "L_WL",
    };
    format!(
        "{}   ρ {:.3} t/m³   coefficients on {length}, moulded{}",
        dimensions(inputs),
        c.density,
        assumed_note(inputs, "   ")
    )
}

/// A main dimension, `B 25.40 m`, with a star where it was assumed.
fn dimension(symbol: &str, value: f64, assumed: bool) -> String {
    format!("{symbol} {value:.2} m{}", if assumed { "*" } else { "" })
}

/// L_PP.
pub(in crate::plot) fn length(inputs: &FigureInputs) -> String {
    let p = inputs.hull.particulars();
    dimension("L_PP", p.length_between_perpendiculars, inputs.curves.conventions.assumed.length)
}

/// B.
pub(in crate::plot) fn breadth(inputs: &FigureInputs) -> String {
    dimension("B", inputs.hull.particulars().breadth, inputs.curves.conventions.assumed.breadth)
}

/// D.
pub(in crate::plot) fn depth(inputs: &FigureInputs) -> String {
    dimension("D", inputs.hull.particulars().depth, inputs.curves.conventions.assumed.depth)
}

/// L_PP, B, T and D.
pub(in crate::plot) fn dimensions(inputs: &FigureInputs) -> String {
    [length(inputs), breadth(inputs), draught(inputs), depth(inputs)].join("   ")
}

/// What the stars mean, after `gap`; nothing where there are none.
pub(in crate::plot) fn assumed_note(inputs: &FigureInputs, gap: &str) -> String {
    let none = inputs.curves.conventions.assumed.symbols().is_empty();
    if none { String::new() } else { format!("{gap}* assumed") }
}

/// How stations are numbered, `stations L_PP / 20 = 7.000 m from AP`.
pub(in crate::plot) fn stations(inputs: &FigureInputs) -> String {
    let numbers = inputs.curves.conventions.stations;
    let spacing = numbers.spacing(inputs.hull.particulars().length_between_perpendiculars);
    format!("stations L_PP / {} = {spacing:.3} m from {}", numbers.spaces, numbers.zero())
}

/// The design draught, `T 7.70 m`, or that none is stated.
pub(in crate::plot) fn draught(inputs: &FigureInputs) -> String {
    inputs.design.map_or("no design draught".to_owned(), |design| format!("T {:.2} m", design.draught))
}

/// The design waterline, `DWL 7.70 m`, or that none is stated.
pub(in crate::plot) fn design_waterline(inputs: &FigureInputs) -> String {
    inputs.design.map_or("no design draught".to_owned(), |design| format!("DWL {:.2} m", design.draught))
}

/// Where curves end because the deck edge goes under.
pub(in crate::plot) fn immersed_edge(edge: f64) -> String {
    format!("deck edge goes under at {edge:.2} m: curves end")
}

/// The title of a chart `width` \[mm\] wide with the name of the ship, and a line of words under it.
pub(in crate::plot) fn head(canvas: &mut Canvas, width: f64, title: &str, ship: &str, words: &str) {
    let ship: String = plain(ship).chars().take(40).collect();
    canvas.text([0.5 * width, 8.0], &format!("{title} – {ship}"), &TextStyle::new(4.2, Anchor::Middle));
    canvas.text([0.5 * width, 14.5], words, &TextStyle::new(2.8, Anchor::Middle));
}

/// Name and version of the program.
pub(in crate::plot) fn program() -> String {
    concat!("loftsman ", env!("CARGO_PKG_VERSION")).to_owned()
}
