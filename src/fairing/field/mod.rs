//! A fair field of half-breadths through a level table, on a chart of few numbers.
//!
//! The field y(u, v) is the quintic spline over the rectangle of the table with the least sum of squares and energy.
//!
//! ```text
//! sum_i ((y(u_i, v_i) - y_i) / s_i)^2 + w int int sum_k g_k C(4, k) (d^4 y / ds^(4-k) dt^k)^2 ds dt
//! ```
//!
//! Here s and t are the parameters counted in intervals of the table, t over the anisotropy a ([`net`]). g_k is 1 for k =
//! 0 and 4, and g for the mixed derivatives. The chart x(u), z(v) has three numbers ([`chart`]). These, a, g, w and the
//! noise maximise the restricted likelihood of the table ([`likelihood`], [`choice`]; Patterson and Thompson 1971, Wahba
//! 1985).
//!
//! Where a hull bends unlike from place to place, the energy has a density that follows it ([`density`]). [`likeliest`] has
//! the order in which all of this is chosen.
//!
//! Waterlines, or stations, may have errors in common: each is shifted and turned ([`line_errors`]).
//!
//! On a keel with rocker the field is one over heights relative to it ([`rocker`]).
//!
//! [`observed`] has what the table says of ends, [`region`] where the hull is within its rectangle. [`bent`] is the net
//! of the hull with the same energy.

#[allow(clippy::needless_range_loop, reason = "orders of derivatives are what the loops run over")]
pub mod bent;
pub mod breaks;
pub mod chart;
pub mod choice;
#[allow(
    clippy::needless_range_loop,
    reason = "orders of derivatives and places of functions are what the loops run over"
)]
pub mod density;
pub mod error;
pub mod likeliest;
pub mod likelihood;
pub mod line_errors;
pub mod net;
pub mod observed;
pub mod points;
pub mod region;
pub mod rocker;
pub mod surface;
#[cfg(test)]
#[allow(clippy::needless_range_loop, reason = "orders of derivatives are what the loops run over")]
mod tests;
