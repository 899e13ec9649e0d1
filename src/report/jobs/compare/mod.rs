//! The job of `compare`.

pub(in crate::report) mod hulls;
pub(in crate::report) mod page;
pub(in crate::report) mod run;
