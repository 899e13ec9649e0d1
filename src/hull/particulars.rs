//! Principal particulars.

/// What a page says where nobody stated a draught.
pub const NO_DRAUGHT: &str = "no draught is stated: give --draught (T under [table] beside a table, under [dimensions] of a job) for displacement and coefficients";

/// Part of D by which the upper edge of a table may be from the design waterline at which it ends.
pub(crate) const AT_EDGE: f64 = 0.01;

/// Moulded main dimensions \[m\]. The aft perpendicular is at x = 0, the forward one at x =
/// `length_between_perpendiculars`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalParticulars {
    /// L_PP \[m\]
    pub length_between_perpendiculars: f64,
    /// B, moulded, both sides \[m\]
    pub breadth: f64,
    /// T, design draught above the base line \[m\]; none where nobody stated one
    pub draught: Option<f64>,
    /// D, depth to the deck at side amidships \[m\]
    pub depth: f64,
}

impl PrincipalParticulars {
    /// Whether the design draught is above the depth, by more than a hundredth: the upper edge of a table that ends at
    /// the design waterline may be as far from it.
    #[must_use]
    pub fn draught_exceeds_depth(&self) -> bool {
        self.draught.is_some_and(|draught| draught > (1.0 + AT_EDGE) * self.depth)
    }
}
