//! The naval nouns: frame, particulars, the hull as a half-breadth surface, its sections, areas, offsets and linear
//! functionals.
//!
//! Frame (right-handed): x forward from the aft perpendicular AP, y to port, z up from the moulded base line; metres.

mod area;
mod brep;
mod cell;
mod chart;
mod charted;
mod diagonal;
mod distance;
mod fit;
mod form;
mod functional;
mod immersion;
mod inertia;
mod knuckles;
mod loft;
mod mesh;
mod offsets;
mod outlines;
mod panels;
mod particulars;
mod section;
mod solid;
mod subdivision;
mod table_form;
mod triangles;
mod vertices;

pub(crate) use area::KnotLines;
pub use area::SectionalAreaCurve;
pub use brep::{Brep, BrepEdge, BrepFace, BrepMesh, Conic, FaceFault, FaceSurface, Motion, Nearest, SpaceCurve, frame};
pub use cell::{
    Cell, Entry, FeatureLine, LineKind, Marks, OutlinePoint, StatedParticulars, TransomPlane, Written, enclosed,
};
pub(crate) use charted::advance;
pub use diagonal::diagonal_offset;
pub use distance::{SurfaceDistance, surface_distance};
pub use fit::{
    CellResidual, Chart, FitError, FitMethod, Fitted, LeastSquares, Misfit, NetKnots, Outermost, ParametricStations,
    PointResidual, QuadraticNet, SettingProblem, SettingProblems, Thinned, UniformBicubic, VolumeEstimate, carried_on,
    has_rocker, only_outlines, side_points,
};
pub(crate) use form::AFLOAT;
pub use form::{Hull, HullError};
pub use functional::Functional;
pub(crate) use immersion::{Immersion, Piece, UpperEnd};
pub use inertia::{transverse_inertia, transverse_inertia_gradient};
pub use loft::{FramePoint, LoftedFrame};
pub use mesh::{HullMesh, LEAST_ANGLE, MeshError, MeshReport, Region, SharpCorner, whole_volume};
pub use offsets::{
    OffsetStation, OffsetTable, StationNumbers, StationOffsets, default_buttocks, default_diagonals, default_stations,
    default_waterlines, keel_height,
};
pub use outlines::section_stations;
pub use panels::{MOST_PANELS, PanelError, PanelMesh, PanelReport, PanelSettings, floats_at};
pub(crate) use particulars::AT_EDGE;
pub use particulars::{NO_DRAUGHT, PrincipalParticulars};
pub use section::{Branch, Cut, Face, Section};
pub use solid::{Edge, Solid, SolidFace};
pub use subdivision::{NetEdge, NetFace, NetLayer, NetPointKind, SubdivisionNet};
pub use table_form::{
    Kept, Order, Program, Rows, SideKind, SideLine, StationDatum, TableForm, TableLayout, WrittenLine, WrittenPoint,
};
pub use triangles::{BodyPart, DrySkin, InnerShells, MeshLine, TriangleMesh, cover, lines_of_edges, triangle_area};
