//! The figures of a faired table: before in grey, after in black and blue.

pub(in crate::plot) mod arrows;
pub(in crate::plot) mod arrows_long;
pub(in crate::plot) mod body;
pub(in crate::plot) mod combs;
pub(in crate::plot) mod curves;
pub(in crate::plot) mod half_breadths;
pub(in crate::plot) mod long;
pub(in crate::plot) mod moves;
pub(in crate::plot) mod plan;
pub(in crate::plot) mod reach;
pub(in crate::plot) mod sections;
pub(in crate::plot) mod strip_lines;
pub(in crate::plot) mod suspects;
pub(in crate::plot) mod table;
