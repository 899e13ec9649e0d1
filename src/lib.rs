//! loftsman: the shape of ships.
#![cfg_attr(
    not(test),
    warn(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout, clippy::print_stderr)
)]

pub mod cli;
pub mod config;
pub mod exchange;
pub mod hull;
pub mod hydrostatics;
pub mod numeric;
pub mod parametric;
pub mod plot;
pub mod report;
pub mod spline;
pub mod units;
