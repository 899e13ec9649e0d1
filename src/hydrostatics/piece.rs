//! Pieces of a station between the knots that it crosses.

/// Where a piece of the station lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum StationSpan {
    /// The station passes aft of the stern profile.
    Aft,
    /// In a span of u, by its number.
    Inside(usize),
    /// Forward of the stem profile.
    Fore,
}

/// A piece of a station between cuts.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub(super) from: f64,
    pub(super) to: f64,
    /// Number of the span in v.
    pub(super) across: usize,
    pub(super) place: StationSpan,
    /// Local parameter in u, -1 to 1, near the station.
    pub(super) start: f64,
    /// Whether x depends on v.
    pub(super) slanting: bool,
    /// Whether x depends on v and the span in u is an outermost one.
    pub(super) profile: bool,
    /// Whether it is a whole span in v.
    pub(super) whole: bool,
}
