//! loftsman generates, fits and fairs ship hulls as B-spline surfaces, and computes their hydrostatics and drawings.
//!
//! Fairing is one convex program in the control values c \[m\]. The offsets y have rows M and errors of standard deviations S.
//! P is an energy of fourth derivatives.
//!
//! ```text
//! minimise    |S^-1 (M c - y)|^2 + w c'P c
//! subject to  volume, centre of volume and areas of c as stated
//!             |(M c - y)_i| <= tolerance_i
//!             signs of curvature along stations and waterlines
//! ```
//!
//! Units are metres and tonnes. The frame is right-handed: x forward from the aft perpendicular, y to port, z up from the base
//! line. [`prelude`] has every job in a few lines:
//!
//! ```no_run
//! use loftsman::prelude::*;
//!
//! # fn main() -> Result<(), Failure> {
//! let faired = fair("offsets.csv", &[("dimensions.T", "6.502"), ("tolerance.table", "20 mm")])?;
//! println!("{}", faired.headline());
//! write(&faired.files, "out/faired")
//! # }
//! ```
//!
//! # A hull from particulars
//!
//! ```
//! use loftsman::parametric::ShipType;
//! use loftsman::parametric::cosh::{self, MidshipTarget, DesignTargets};
//!
//! let requested = DesignTargets {
//!     ship_type: Some(ShipType::BulkCarrier),
//!     length: 217.0,
//!     breadth: Some(32.25),
//!     draught: Some(12.2),
//!     block_coefficient: Some(0.80),
//!     midship_coefficient: Some(MidshipTarget::Value(0.99)),
//!     ..DesignTargets::default()
//! };
//! let ship = cosh::generate("bulk carrier", &requested).expect("feasible");
//! for target in &ship.targets {
//!     assert!((target.achieved - target.requested).abs() < 1e-10 * target.requested.max(1.0));
//! }
//! // What is infeasible is refused with numbers.
//! let refused = cosh::generate("no ship", &DesignTargets { block_coefficient: Some(0.995), ..requested }).unwrap_err();
//! assert!(refused.iter().any(|problem| problem.message.contains("Cb")));
//! ```
//!
//! # Hydrostatics
//!
//! ```
//! use loftsman::hydrostatics::{Conventions, CurvesOfForm};
//! use loftsman::parametric::analytic::{self, Dimensions};
//!
//! let dimensions = Dimensions { length: 100.0, breadth: 10.0, draught: 6.25, depth: 9.0 };
//! let hull = analytic::wigley("Wigley", &dimensions).expect("valid dimensions").hull;
//! let table = CurvesOfForm::new(&hull, &[3.0, 6.25], &Conventions::default());
//! assert!((table.rows[1].displacement_volume - 4.0 / 9.0 * 6250.0).abs() < 1e-8);
//! assert!((table.rows[1].kb.expect("immersed") - 5.0 / 8.0 * 6.25).abs() < 1e-10);
//! ```
//!
//! # Sections and offsets
//!
//! ```
//! use loftsman::hull::{Cut, Functional};
//! use loftsman::parametric::analytic::{self, Dimensions};
//!
//! let dimensions = Dimensions { length: 100.0, breadth: 10.0, draught: 6.25, depth: 9.0 };
//! let hull = analytic::wigley("Wigley", &dimensions).expect("valid dimensions").hull;
//! let buttock = hull.section(Cut::Buttock { y: 2.0 }, 1e-9);
//! assert_eq!(buttock.branches.len(), 1);
//! assert!((hull.half_breadth(50.0, 6.25).expect("on the hull") - 5.0).abs() < 1e-12);
//! // Volume is a row over the net: linear in the half-breadths.
//! let row = Functional::Volume.row(&hull, 6.25);
//! let volume: f64 = row.iter().zip(hull.surface().points()).map(|(r, p)| r * p[1]).sum();
//! assert!((volume - Functional::Volume.value(&hull, 6.25)).abs() < 1e-9);
//! ```
//!
//! # Splines
//!
//! ```
//! use loftsman::spline::{BsplineCurve, KnotVector};
//!
//! let knots = KnotVector::uniform(3, 4).expect("valid knots");
//! let points = knots.greville().iter().map(|&t| [t, t * t]).collect();
//! let curve = BsplineCurve::new(knots, points).expect("as many points as basis functions");
//! let [point, tangent, _second] = curve.derivatives::<3>(0.5);
//! assert!((point[0] - 0.5).abs() < 1e-15 && (tangent[0] - 1.0).abs() < 1e-14);
//! ```
//!
//! The floors of the library and what belongs where are in `ARCHITECTURE.md`.
#![cfg_attr(
    not(all(feature = "pdf", feature = "workbooks")),
    allow(dead_code, reason = "parts of drawings and tables serve documents and workbooks alone")
)]
#![cfg_attr(
    not(test),
    warn(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout, clippy::print_stderr)
)]

#[cfg(feature = "cli")]
pub mod cli;
pub mod config;
pub mod derivation;
pub mod exchange;
pub mod fairing;
pub mod hull;
pub mod hydrostatics;
pub mod numeric;
pub mod parametric;
pub mod plot;
pub mod prelude;
pub mod qp;
pub mod report;
pub mod resistance;
pub mod spline;
pub mod units;
