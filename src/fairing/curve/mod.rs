//! Fairing of one curve y(x): a waterline, a sheer line, a curve of section areas.
//!
//! ```text
//! minimise    sum_k w_k (y(x_k) - d_k)^2 + mu E_m(y)
//! subject to  |y(x_k) - d_k| <= delta_k,  locked points and end slopes,  area, centroid,  signs of y''
//! ```
//!
//! y is a spline (quintic; cubic for m = 2) with knots at the sites: broken at knuckles, of broken curvature at tangent
//! points. mu comes from generalised cross-validation ([`super::smoothing`]). E_m is the integral of the square of the
//! (m-2)th derivative of the true curvature with respect to arc length. Its metric is frozen at the last curve, which
//! makes one convex program of it; programs follow while the exact functional falls, within the tolerances, which are
//! the trust region. Where slopes are mild one is enough.
//!
//! Signs: the least number of inflections within the tolerances is found and proved by [`super::inflections`]; a
//! pattern with this number (or the number that is wished) is imposed on the coefficients of y'', one free at each
//! change. Its price, the growth of the objective over sigma^2, must not exceed [`PRICE`]; else one more inflection is
//! allowed, until it does.
//!
//! Points that contradict all others, and corners that nobody declared, are found before ([`contradictions`]).
//!
//! References: Reinsch 1967, Wahba 1990 (smoothing splines); Horn 1983, Moreton & Sequin 1992 (true curvature).

mod fair;
mod given;
mod result;
mod signs;
mod space;
mod suspects;
mod wishes;
mod within;

pub use fair::{PRICE, area_and_centroid, fair_curve};
pub use given::{CurveError, CurvePoint, CurveSettings, InflectionWish};
pub use result::{CurveLine, CurveMove, FairCurve, FairStatus, LineKind};
pub use suspects::{Contradictions, CurveCorner, CurveSuspect, contradictions};
