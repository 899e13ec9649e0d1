//! Numbers, remarks and messages in words, for all jobs.

pub(super) mod codes;
pub(super) mod lengths;
pub(super) mod page;
pub(super) mod remarks;
