//! What jobs start from: files, hulls, bodies and results as they are read.

pub(super) mod carried;
pub(super) mod doubts;
pub(super) mod hydrostatic_body;
pub(super) mod result;
pub(super) mod source;
