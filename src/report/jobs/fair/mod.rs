//! The job of `fair`.

pub(in crate::report) mod figures;
pub(in crate::report) mod grades;
pub(in crate::report) mod held;
pub(in crate::report) mod job;
pub(in crate::report) mod page;
pub(in crate::report) mod refused;
pub(in crate::report) mod run;
pub(in crate::report) mod short;
pub(in crate::report) mod words;
