//! loftsman generates, fits and fairs ship hulls as B-spline surfaces, and computes their hydrostatics and drawings.
//!
//! A hull is its half-breadth y over the centreplane, S(u, v) = (x(u, v), y(u, v), z(u, v)). Fairing is one convex program in
//! the control values c \[m\] of y:
//!
//! ```text
//! minimise    |S^-1 (M c - y)|^2 + w c'P c      misfit of the offsets, and energy
//! subject to  a'c  = t                          volume, centre of volume, areas and coefficients as stated
//!             |(M c - y)_i| <= d_i              moves within the tolerances
//!             s_k (K c)_k >= 0                  signs of curvature along stations and waterlines
//!             0 <= y <= B/2
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | y, M | offsets of the table; rows that read them from c | m; 1 |
//! | S | standard deviations of their errors | m |
//! | P, w | energy of derivatives of the fourth order; smoothing weight | |
//! | a, t | row of a quantity that is linear in c; its target | m3, m4, m2 over m; m3, m4, m2 |
//! | d | tolerances | m |
//! | K, s | rows of curvature; signs, +1 where a line is convex outward | |
//!
//! Generated hulls meet their targets by the same rows a. The optimum is global; a certificate that is computed outside the
//! solver proves it.
//!
//! # Units and signs
//!
//! Lengths are in metres, masses in tonnes, angles in radians, unless a name says otherwise. The frame is right-handed: x
//! forward from the aft perpendicular, y to port, z up from the moulded base line. A move is positive outward. A curvature is
//! positive where the hull is convex outward. LCB in per cent of L_PP is positive forward of midship.
//!
//! # Where to start
//!
//! | module | has |
//! |---|---|
//! | [`prelude`] | every job in a few lines, with files as the commands read and write them |
//! | [`geometry`] | hulls, sections, areas, splines, meshes |
//! | [`offsets`] | tables of offsets and flagged offsets |
//! | [`generation`] | hulls from particulars |
//! | [`fitting`] | surfaces through tables |
//! | [`fairness`] | fairing of tables and of curves |
//! | [`hydro`] | hydrostatics and their conventions |
//! | [`variation`] | daughters of a parent, comparison of hulls |
//! | [`powering`] | resistance in calm water |
//! | [`files`] | what is written, export to other programs, errors |
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
//! The book is in `docs/src` of the package. `concepts/conventions.md` has the conventions, `concepts/fairness.md` noise,
//! fairness and proof, `guide/library.md` the examples, `validation/exact.md` what the figures are checked against.
//! `ARCHITECTURE.md` says what belongs where.
#![cfg_attr(
    not(all(feature = "pdf", feature = "workbooks")),
    allow(dead_code, reason = "parts of drawings and tables serve documents and workbooks alone")
)]
#![cfg_attr(
    not(test),
    warn(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout, clippy::print_stderr)
)]

#[cfg(feature = "cli")]
mod cli;
mod config;
mod derivation;
mod exchange;
mod fairing;
mod hull;
mod hydrostatics;
mod numeric;
mod parametric;
mod plot;
mod qp;
mod report;
mod resistance;
mod spline;
mod units;

#[doc(hidden)]
pub mod internals;
pub mod prelude;

pub mod geometry {
    //! Hulls, their sections and areas, the splines they are made of, and closed meshes.
    //!
    //! Volume, moments and areas are rows over the net, linear in the half-breadths:
    //!
    //! ```
    //! use loftsman::generation::{AnalyticDimensions, Family};
    //! use loftsman::geometry::{Cut, Functional};
    //!
    //! let dimensions = AnalyticDimensions { length: 100.0, breadth: 10.0, draught: 6.25, depth: 9.0 };
    //! let hull = Family::Wigley(dimensions).generate("Wigley").map_err(|reasons| reasons[0].message.clone())?.hull;
    //! let buttock = hull.section(Cut::Buttock { y: 2.0 }, 1e-9);
    //! assert_eq!(buttock.branches.len(), 1);
    //! assert!((hull.half_breadth(50.0, 6.25).unwrap_or(0.0) - 5.0).abs() < 1e-12);
    //! let row = Functional::Volume.row(&hull, 6.25);
    //! let volume: f64 = row.iter().zip(hull.surface().points()).map(|(r, p)| r * p[1]).sum();
    //! assert!((volume - Functional::Volume.value(&hull, 6.25)).abs() < 1e-9);
    //! # Ok::<(), String>(())
    //! ```
    //!
    //! Splines know no ship:
    //!
    //! ```
    //! use loftsman::geometry::{BsplineCurve, KnotVector};
    //!
    //! # fn main() -> Result<(), loftsman::geometry::SplineError> {
    //! let knots = KnotVector::uniform(3, 4)?;
    //! let points = knots.greville().iter().map(|&t| [t, t * t]).collect();
    //! let curve = BsplineCurve::new(knots, points)?;
    //! let [point, tangent, _second] = curve.derivatives::<3>(0.5);
    //! assert!((point[0] - 0.5).abs() < 1e-15 && (tangent[0] - 1.0).abs() < 1e-14);
    //! # Ok(())
    //! # }
    //! ```

    pub use crate::hull::{
        Branch, Cut, Face, Functional, Hull, HullError, HullMesh, MeshError, PrincipalParticulars, Region, Section,
        SectionalAreaCurve, SurfaceDistance, surface_distance,
    };
    pub use crate::spline::{BsplineCurve, BsplineSurface, KnotVector, SplineError, SurfaceTangents};
}

pub mod offsets {
    //! Tables of offsets: read, taken from a hull or built point by point, and the offsets that their neighbours contradict.

    pub use crate::exchange::{Severity, TableProblem};
    pub use crate::fairing::{Hypothesis, Suspect, Suspects, suspects};
    pub use crate::hull::{
        Cell, Entry, FeatureLine, LineKind, Marks, OffsetStation, OffsetTable, OutlinePoint, StatedParticulars,
        StationNumbers, StationOffsets, TransomPlane,
    };
    pub use crate::report::read_table_file;
}

pub mod generation {
    //! Hulls from particulars, in memory: a family with its parameters makes a hull or every reason why there is none.
    //!
    //! ```
    //! use loftsman::generation::{DesignTargets, Family, MidshipTarget, ShipType};
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
    //! let ship = Family::Cosh(Box::new(requested.clone())).generate("bulk carrier").expect("feasible");
    //! for target in &ship.targets {
    //!     assert!((target.achieved - target.requested).abs() < 1e-10 * target.requested.max(1.0));
    //! }
    //! // What is infeasible is refused with numbers.
    //! let full = DesignTargets { block_coefficient: Some(0.995), ..requested };
    //! let refused = Family::Cosh(Box::new(full)).generate("no ship").unwrap_err();
    //! assert!(refused.iter().any(|problem| problem.message.contains("Cb")));
    //! ```

    pub use crate::parametric::analytic::Dimensions as AnalyticDimensions;
    pub use crate::parametric::cosh::{DesignTargets, MidshipTarget};
    pub use crate::parametric::ucl_cosh::Parameters as UclCoshParameters;
    pub use crate::parametric::{DesignValue, Family, Generated, Infeasible, Remark, ShipType, Target, ValueOrigin};
    pub use crate::report::Outputs;
}

pub mod fitting {
    //! Surfaces through tables of offsets: [`Hull::fit`](crate::geometry::Hull::fit) and what it returns.

    pub use crate::hull::{CellResidual, Chart, FitError, FitMethod, Fitted, Misfit, VolumeEstimate};
    pub use crate::report::FitOutputs;
}

pub mod fairness {
    //! Fairing of tables ([`Job::run`]) and of curves ([`fair_curve`]) in memory, and what it comes to.
    //!
    //! [`prelude::fair`](crate::prelude::fair) takes any key of the job file; [`Job`] has targets, tolerances and locks.

    pub use crate::fairing::change::{Change, Predicted, Turns};
    pub use crate::fairing::constraint::Constraint;
    pub use crate::fairing::curve::{
        CurveError, CurveMove, CurvePoint, CurveSettings, FairCurve, FairStatus, InflectionWish, fair_curve,
    };
    pub use crate::fairing::held::Held;
    pub use crate::fairing::inflections::Inflections;
    pub use crate::fairing::job::{Holding, Job, JobError, Tolerance};
    pub use crate::fairing::outcome::Outcome;
    pub use crate::fairing::strength::Fairness;
    pub use crate::fairing::surface::Origin;
    pub use crate::qp::{Certificate, Status};
    pub use crate::report::{FairOutputs, FairedCurve};
}

pub mod hydro {
    //! Hydrostatics of a hull on even keel, and the conventions they depend on. Columns have the codes of the ITTC
    //! ([`QUANTITIES`]).
    //!
    //! ```
    //! use loftsman::generation::{AnalyticDimensions, Family};
    //! use loftsman::hydro::{Conventions, CurvesOfForm};
    //!
    //! let dimensions = AnalyticDimensions { length: 100.0, breadth: 10.0, draught: 6.25, depth: 9.0 };
    //! let hull = Family::Wigley(dimensions).generate("Wigley").map_err(|reasons| reasons[0].message.clone())?.hull;
    //! let table = CurvesOfForm::new(&hull, &[3.0, 6.25], &Conventions::default());
    //! assert!((table.rows[1].displacement_volume - 4.0 / 9.0 * 6250.0).abs() < 1e-8);
    //! assert!((table.rows[1].kb.unwrap_or(0.0) - 5.0 / 8.0 * 6.25).abs() < 1e-10);
    //! # Ok::<(), String>(())
    //! ```

    pub use crate::hydrostatics::{
        CoefficientLength, Conventions, CurvesOfForm, Hydrostatics, LcbReference, PrismaticSection, QUANTITIES,
        Quantity, Shell,
    };
}

pub mod variation {
    //! Daughters of a parent with other dimensions and coefficients ([`derive()`]), and hulls beside each other.

    pub use crate::derivation::{
        Derived, Dimensions, Interval, Method, Origin, Quantity, Reached, Reference, Refusal, Request, Target, derive,
    };
    pub use crate::exchange::ComparedValue;
    pub use crate::report::{BlendOutputs, CompareOutputs, ComparedHull, DeriveOutputs};
}

pub mod powering {
    //! Resistance in calm water: Holtrop and Mennen, ITTC-57, and Michell's integral with its gradient.

    pub use crate::resistance::{
        Appendage, Components, Method, Prediction, PredictionRow, Range, ShipFault, ShipParameters, SternShape,
        ThinShip, ViscousOverrides, Water, WaveGradient, predict,
    };
}

pub mod files {
    //! What jobs write, hulls in the formats of other programs, and the one error type of the jobs.

    pub use crate::config::{Diagnostic, Severity};
    pub use crate::exchange::{CadUnit, DxfVersion};
    pub use crate::report::{ExportFormat, ExportSettings, Exported, Failure, OutputFile, Source, export};
}
