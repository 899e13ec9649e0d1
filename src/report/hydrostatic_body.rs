//! What floats: a hull, or a body of triangles whose hydrostatics need no surface.

use std::path::Path;

use super::convert::is_hull;
use super::failure::Failure;
use super::source::{Overrides, read_bytes, read_source_with, sidecar, source_of};
use crate::exchange::{ReadBody, read_body};
use crate::hull::{Hull, PrincipalParticulars, TriangleMesh};
use crate::hydrostatics::{Conventions, CurvesOfForm, default_draughts};

/// A body with the conventions of its tables.
#[derive(Debug, Clone)]
pub struct HydrostaticBody {
    body: BodyShape,
    /// Its main dimensions; of a body of triangles as far as they are stated, else its extents.
    pub particulars: PrincipalParticulars,
    /// Conventions of its tables.
    pub conventions: Conventions,
    /// What was assumed, in words for the user.
    pub notes: Vec<String>,
}

#[derive(Debug, Clone)]
enum BodyShape {
    Hull(Box<Hull>),
    /// Of surfaces twice, the second time finer.
    Triangles(Vec<TriangleMesh>),
}

impl HydrostaticBody {
    /// The hull; none of a body of triangles.
    #[must_use]
    pub fn hull(&self) -> Option<&Hull> {
        match &self.body {
            BodyShape::Hull(hull) => Some(hull),
            BodyShape::Triangles(_) => None,
        }
    }

    /// Draughts of its table where none are asked for \[m\], of [`default_draughts`].
    ///
    /// # Errors
    /// [`Failure::Usage`] for a body without a height.
    pub fn default_draughts(&self) -> Result<Vec<f64>, Failure> {
        let list = default_draughts(self.particulars.draught, self.particulars.depth);
        if list.is_empty() {
            let message = "the body has no height from which draughts follow: give --draught or --draughts";
            return Err(Failure::Usage(message.to_owned()));
        }
        Ok(list)
    }

    /// Hydrostatics at draughts above the base line \[m\].
    #[must_use]
    pub fn curves_of_form(&self, draughts: &[f64], conventions: &Conventions) -> CurvesOfForm {
        match &self.body {
            BodyShape::Hull(hull) => CurvesOfForm::new(hull, draughts, conventions),
            BodyShape::Triangles(meshes) => of_meshes(meshes, &self.particulars, draughts, conventions),
        }
    }
}

fn of_meshes(
    meshes: &[TriangleMesh],
    particulars: &PrincipalParticulars,
    draughts: &[f64],
    conventions: &Conventions,
) -> CurvesOfForm {
    let none = TriangleMesh::default();
    CurvesOfForm::of_triangles(meshes.first().unwrap_or(&none), meshes.get(1), particulars, draughts, conventions)
}

/// A mesh (STL, OBJ, GLB), panels (GDF, NEMOH, PNL), the surfaces of a CAD file (STEP, IGES) or a control net
/// (FREE!ship) as the body that it is, and whatever else is a hull as that.
///
/// # Errors
/// [`Failure::FileSystem`], [`Failure::Input`], [`Failure::Infeasible`].
pub fn read_hydrostatic_body(path: &Path) -> Result<HydrostaticBody, Failure> {
    read_hydrostatic_body_with(path, &Overrides::default())
}

/// The same, with conventions of a body or a table over those of its file.
///
/// # Errors
/// Those of [`read_hydrostatic_body`]; [`Failure::Usage`] when conventions are given for a hull.
pub fn read_hydrostatic_body_with(path: &Path, overrides: &Overrides) -> Result<HydrostaticBody, Failure> {
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    let design = matches!(extension.as_str(), "toml" | "hgf" | "huf");
    let source = if path.is_dir() || design {
        read_source_with(path, overrides)?
    } else {
        let (bytes, list) = (read_bytes(path)?, sidecar(path, overrides)?);
        let list = list.iter().map(|(name, text)| (name.as_str(), text.as_str()));
        if let Some(body) = read_body(&path.display().to_string(), &bytes, list) {
            return body.map(of_body).map_err(|problems| overrides.refused(problems));
        }
        source_of(path, bytes, overrides)?
    };
    let particulars = *source.hull.particulars();
    let body = BodyShape::Hull(Box::new(source.hull));
    Ok(HydrostaticBody { body, particulars, conventions: source.conventions, notes: source.notes })
}

/// The same with a design draught \[m\] above the base line, over that of the file.
///
/// # Errors
/// Those of [`read_hydrostatic_body_with`]; [`Failure::Usage`] when the draught is none of the body.
pub fn read_hydrostatic_body_at(path: &Path, overrides: &Overrides, draught: f64) -> Result<HydrostaticBody, Failure> {
    if !is_hull(path) {
        let mut overrides = overrides.clone();
        overrides.keys.push(("T", format!("{draught} m")));
        return read_hydrostatic_body_with(path, &overrides);
    }
    let mut body = read_hydrostatic_body_with(path, overrides)?;
    if let BodyShape::Hull(hull) = body.body {
        let hull = hull.with_draught(draught).map_err(|error| Failure::Usage(error.to_string()))?;
        body.particulars = *hull.particulars();
        body.body = BodyShape::Hull(Box::new(hull));
    }
    Ok(body)
}

fn of_body(read: ReadBody) -> HydrostaticBody {
    let [least, greatest] = read.meshes.first().and_then(TriangleMesh::bounds).unwrap_or_default();
    let extent = |k: usize| greatest[k] - least[k];
    let stated = read.stated;
    let mut particulars = PrincipalParticulars {
        length_between_perpendiculars: stated.length_between_perpendiculars.unwrap_or(extent(0)),
        breadth: stated.breadth.unwrap_or(extent(1)),
        draught: stated.draught.filter(|_| stated.states_draught()),
        depth: stated.depth.unwrap_or(extent(2)),
    };
    let conventions = Conventions::default();
    // The breadth of a ship is that of its waterline, which flare does not widen.
    if let (None, Some(draught)) = (stated.breadth, stated.draught) {
        let row = of_meshes(&read.meshes, &particulars, &[draught], &conventions).rows;
        let afloat = row.first().map_or(0.0, |row| row.waterline_breadth);
        particulars.breadth = if afloat > 0.0 { afloat } else { particulars.breadth };
    }
    let mut notes: Vec<String> = read.notes.iter().map(ToString::to_string).collect();
    if stated.length_between_perpendiculars.is_none() {
        notes.push(format!(
            "Lpp is not stated; it is taken as the length of the body, {:.3} m, from x = 0",
            particulars.length_between_perpendiculars
        ));
    }
    HydrostaticBody { body: BodyShape::Triangles(read.meshes), particulars, conventions, notes }
}
