//! What stands in a table of offsets besides numbers: cells with their marks, points of sections and lines.

use super::particulars::PrincipalParticulars;
use crate::numeric::trapezoids;

/// What a cell says about the hull.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Entry {
    /// There is no hull here: the cell is blank, `-` or `*`.
    #[default]
    Absent,
    /// There is a hull, and its offset is not known (`?`): to be predicted.
    Unknown,
    /// The offset \[m\].
    Given(f64),
}

/// What is known of an offset besides its value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Marks {
    /// Doubtful, `(6.41)`: it counts little.
    pub doubtful: bool,
    /// Locked, `6.41!`: it must not move.
    pub locked: bool,
    /// On a knuckle, `6.41K`: the tangent breaks here.
    pub knuckle: bool,
    /// On a tangent line, `6.41T`: a flat of side or bottom begins here.
    pub tangent: bool,
}

/// A cell as it was written, and where.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// The text of the cell.
    pub text: String,
    /// Row (line) in the file, from 1.
    pub row: usize,
    /// Column (field) in the file, from 1.
    pub column: usize,
}

/// A cell of a table of offsets.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Cell {
    /// What it says.
    pub entry: Entry,
    /// Its marks.
    pub marks: Marks,
    /// How it was written; none when it was computed.
    #[doc(hidden)]
    pub written: Option<Written>,
}

impl Cell {
    /// The offset \[m\]; none where there is no hull or it is not known.
    #[must_use]
    pub fn value(&self) -> Option<f64> {
        match self.entry {
            Entry::Given(value) => Some(value),
            Entry::Absent | Entry::Unknown => None,
        }
    }
}

impl From<Option<f64>> for Cell {
    /// A computed cell, without marks; absent for none.
    fn from(value: Option<f64>) -> Self {
        Self { entry: value.map_or(Entry::Absent, Entry::Given), ..Self::default() }
    }
}

/// A point of a section given as a line of points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutlinePoint {
    /// Half-breadth \[m\].
    pub y: f64,
    /// Height above the base line \[m\].
    pub z: f64,
    /// Its marks.
    pub marks: Marks,
}

/// Area between a line of points and the centreplane, int y dz [m^2], one side; pieces that fall take away.
#[must_use]
pub fn enclosed(points: &[OutlinePoint]) -> f64 {
    let heights: Vec<[f64; 2]> = points.iter().map(|point| [point.z, point.y]).collect();
    trapezoids(&heights)
}

/// What a line on the hull is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineKind {
    /// The tangent breaks across it: C0.
    Knuckle,
    /// The curvature breaks across it, the tangent does not: G1 (edge of a flat of side or bottom, of a bilge).
    Tangent,
}

/// A line on the hull along which the surface is less smooth.
#[derive(Debug, Clone, PartialEq)]
pub struct FeatureLine {
    /// Name as the table gives it.
    pub name: String,
    /// What it is.
    pub kind: LineKind,
    /// Points (x, y, z) \[m\], x rising.
    pub points: Vec<[f64; 3]>,
}

/// The plane of a transom: x = x_base + slope z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TransomPlane {
    /// x on the base line \[m\].
    pub x_base: f64,
    /// dx/dz; 0 for an upright transom, negative when it rakes aft.
    pub slope: f64,
}

/// Main dimensions as far as a table states them \[m\].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StatedParticulars {
    /// L_PP.
    pub length_between_perpendiculars: Option<f64>,
    /// B.
    pub breadth: Option<f64>,
    /// T.
    pub draught: Option<f64>,
    /// D.
    pub depth: Option<f64>,
}

impl StatedParticulars {
    /// Whether there is a design draught that can be one: a positive number.
    #[must_use]
    pub fn states_draught(&self) -> bool {
        self.draught.is_some_and(|draught| draught.is_finite() && draught > 0.0)
    }

    /// These, and of `under` what they leave open.
    #[must_use]
    pub fn over(&self, under: &Self) -> Self {
        Self {
            length_between_perpendiculars: self.length_between_perpendiculars.or(under.length_between_perpendiculars),
            breadth: self.breadth.or(under.breadth),
            draught: self.draught.or(under.draught),
            depth: self.depth.or(under.depth),
        }
    }
}

impl From<&PrincipalParticulars> for StatedParticulars {
    /// All of them stated.
    fn from(p: &PrincipalParticulars) -> Self {
        Self {
            length_between_perpendiculars: Some(p.length_between_perpendiculars),
            breadth: Some(p.breadth),
            draught: p.draught,
            depth: Some(p.depth),
        }
    }
}
