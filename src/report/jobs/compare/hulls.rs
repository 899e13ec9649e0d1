//! Two hulls beside each other: what `compare` is asked for and what it finds.

use std::path::PathBuf;

use crate::exchange::{CompareFile, ComparedValue};
use crate::hull::{Hull, PrincipalParticulars, SurfaceDistance};
use crate::hydrostatics::{Conventions, Hydrostatics};
use crate::report::input::source::Overrides;

/// Two hulls to be compared.
#[derive(Debug, Clone)]
pub struct CompareJob {
    /// The hulls, tables, designs, meshes or CAD files.
    pub hulls: [PathBuf; 2],
    /// Conventions of tables and bodies over those of their files.
    pub overrides: Overrides,
    /// Draught of both above the base line \[m\], over their own.
    pub draught: Option<f64>,
}

/// One of two hulls that are compared.
#[derive(Debug, Clone)]
pub struct ComparedHull {
    /// Its name.
    pub name: String,
    /// Its surface.
    pub hull: Hull,
    /// Its main dimensions.
    pub particulars: PrincipalParticulars,
    /// Hydrostatics at its draught; none where none is stated.
    pub row: Option<Hydrostatics>,
    /// The file that was read; none of a hull that this run made.
    pub(in crate::report) input: Option<PathBuf>,
}

/// What a comparison comes to.
#[derive(Debug, Clone)]
pub struct CompareOutputs {
    /// The hulls, the first of which is the measure.
    pub hulls: [ComparedHull; 2],
    /// What they are to each other, in a word each.
    pub roles: [&'static str; 2],
    /// Conventions of the figures of both.
    pub conventions: Conventions,
    /// Particulars and coefficients.
    pub values: Vec<ComparedValue>,
    /// Hydrostatics of both at common draughts.
    pub rows: Vec<[Hydrostatics; 2]>,
    /// How far the second is from the first, and the first from the second.
    pub distances: [Option<SurfaceDistance>; 2],
    /// Warnings, each with its code.
    pub warnings: Vec<String>,
    /// What was assumed when the hulls were read.
    pub notes: Vec<String>,
}

impl CompareOutputs {
    /// What the files and the JSON of the command hold.
    #[must_use]
    #[doc(hidden)]
    pub fn file(&self) -> CompareFile<'_> {
        CompareFile {
            names: [&self.hulls[0].name, &self.hulls[1].name],
            values: &self.values,
            rows: &self.rows,
            distances: self.distances,
            warnings: &self.warnings,
        }
    }

    /// The draughts of both, in words.
    #[must_use]
    pub fn draughts(&self) -> String {
        let of = |hull: &ComparedHull| hull.particulars.draught.map(|t| format!("{t:.3} m"));
        match (of(&self.hulls[0]), of(&self.hulls[1])) {
            (Some(a), Some(b)) if a == b => format!("both at T {a}"),
            (Some(a), Some(b)) => format!("each at its own draught: T {a} and T {b}"),
            _ => "without coefficients: a draught is not stated (--draught)".to_owned(),
        }
    }
}
