//! The least number of inflections of a planar curve within tolerance bands, with a proof.
//!
//! The curve is a graph y(x), C1 between knuckles, that passes every site x_k within |y(x_k) - d_k| <= delta_k. Its
//! curvature y'' / (1 + y'^2)^(3/2) has the sign of y''. Wanted is the least number K of sign changes of y''; straight
//! pieces have no sign, so that a flat is no inflection, and knuckles split the curve (a change of sign across a
//! knuckle does not count).
//!
//! *From below.* A second divided difference of the values at the sites is y'' weighted by a hat function, and hat
//! functions diminish variation (Karlin 1968; de Boor 2001, XI): a curve with K changes of sign has values whose
//! divided differences change at most K times. Values of one bend within the bands of the sites i..j exist if and only
//! if no [`Witness`] stands among them, three sites of which the middle one cannot be brought to the chord of the outer
//! two. The longest run of one bend, then the longest run of the other that takes over its last cell, and so on, needs
//! the fewest runs. What stops each run is a witness, and the [`Chain`] of witnesses proves the number by comparing
//! decimal numbers: no solver is believed. O(n^2) operations.
//!
//! *From above.* A cubic spline with knots at the sites (and between them, if need be) whose y'', which is piecewise
//! linear, has the wanted pattern: a linear program finds the least factor tau on the tolerances for a pattern; if tau
//! <= 1 the spline is there to be looked at. Patterns are tried from the middle of the intervals that the chains leave.
//!
//! *Between.* The runs of a chain agree in where they meet but not in the values there, so that rarely the bound from
//! below is one too few. Then every pattern is excluded by a linear program over the values, each with Farkas
//! multipliers that are checked here ([`refuted`](Inflections::refuted) counts them).
//!
//! Limits: where the bands leave nothing but a polyline with a corner, no smooth curve attains the bound and the number
//! is not certified (5 of 6000 random bands of small whole numbers; bands of readings do not meet so exactly). The
//! bound counts y'' of a graph and does not see a tolerance across a steep curve. Measured: 48 waterlines of 21 offsets
//! with 0, 1 or 2 inflections and bands of three noise levels, all certified and right, 2 ms each.
//!
//! Compare Demetriou & Powell 1991 (least squares under the same constraint), Cullinan 1990 (the uniform norm).

mod attain;
mod bands;
mod minimum;
mod space;
mod witness;

pub use bands::{Bands, BandsError, Bend};
pub use minimum::{Inflections, Interval, SmallerCount, Stretch, minimum_inflections};
pub use space::{CurvatureRow, curvature_rows};
pub use witness::{Chain, Witness};
