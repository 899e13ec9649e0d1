//! What drawings of a ship share: views and pens, the grid of its lines, profile, body plan, combs, title blocks.

pub(super) mod body_plan;
pub(super) mod caption;
pub(super) mod comb;
pub(super) mod extent;
pub(super) mod extrapolated;
pub(super) mod framed;
pub(super) mod inputs;
pub(super) mod lines_grid;
pub(super) mod outline;
pub(super) mod profile;
pub(super) mod station_names;
pub(super) mod title_block;
pub(super) mod view;
pub(super) mod zero_lines;
