//! Principal particulars.

/// Moulded main dimensions \[m\]. The aft perpendicular is at x = 0, the forward one at x =
/// `length_between_perpendiculars`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalParticulars {
    /// L_PP \[m\]
    pub length_between_perpendiculars: f64,
    /// B, moulded, both sides \[m\]
    pub breadth: f64,
    /// T, design draught above the base line \[m\]
    pub draught: f64,
    /// D, depth to the deck at side amidships \[m\]
    pub depth: f64,
}
