//! The job of `report`.

pub(in crate::report) mod cells;
pub(in crate::report) mod comb_lines;
pub(in crate::report) mod figures;
pub(in crate::report) mod page;
pub(in crate::report) mod run;
pub(in crate::report) mod settings;
pub(in crate::report) mod tables;
pub(in crate::report) mod verdict;
