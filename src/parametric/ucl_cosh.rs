//! The raw generator of the UCL design-building-block lineage.

use super::{Generated, Infeasible};

/// Raw parameters, named as in `.hgf` files.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameters {
    /// LOA [m]
    pub length: f64,
    /// BOA [m]
    pub breadth: f64,
    /// D [m]
    pub depth: f64,
    /// Design draught [m].
    pub draught: f64,
    /// `ms_val`: midship fullness, a = ms pi.
    pub midship_fullness: f64,
    /// `bow_val`: bow profile.
    pub bow: f64,
    /// `tr_stern_val`: transom fullness.
    pub transom_fullness: f64,
    /// `deck_val`: fullness of the forward deck line.
    pub forward_deck: f64,
    /// `tb_val`: transom breadth at the deck over BOA.
    pub transom_breadth_ratio: f64,
    /// `td_val`: height of the transom tip over D.
    pub transom_tip_ratio: f64,
    /// `acu_val`: aft cut-up over LOA.
    pub aft_cut_up_ratio: f64,
    /// `kf_val`: fore end of the keel over LOA.
    pub keel_forward_ratio: f64,
    /// `sa_val`: slope of the transom from the vertical [rad].
    pub side_slope: f64,
}

/// The hull of the raw parameters.
///
/// # Errors
/// Every parameter outside its range.
pub fn generate(name: &str, parameters: &Parameters) -> Result<Generated, Vec<Infeasible>> {
    let _ = (name, parameters);
    Err(Vec::new())
}
