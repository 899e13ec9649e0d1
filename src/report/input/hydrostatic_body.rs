//! What floats: a hull, or a body of triangles whose hydrostatics need no surface.

use std::path::{Path, PathBuf};

use super::source::{Overrides, ending, is_hull, read_bytes, read_source_with, sidecar, source_of};
use crate::config::{Diagnostic, Severity};
use crate::exchange::{ReadBody, read_body};
use crate::hull::{AFLOAT, AT_EDGE, Hull, HullError, PrincipalParticulars, TriangleMesh};
use crate::hydrostatics::{
    Assumed, Conventions, CurvesOfForm, Given, Hydrostatics, Unclosed, default_draughts, unclosed,
};
use crate::report::failure::{Failure, problem};
use crate::report::words::remarks::{is_warning, without_folder};

/// Part of the height of a body by which its lowest point may be from the base line.
const AT_BASE: f64 = 0.2;

/// A row whose draught is off the design draught by at most this part of it tells what is unusual there.
const NEAR_DESIGN: f64 = 0.1;

/// A body with the conventions of its tables.
#[derive(Debug, Clone)]
pub struct HydrostaticBody {
    /// Where it was read from.
    path: PathBuf,
    body: BodyShape,
    /// What its triangles leave its surface by at most \[m\].
    deviation: f64,
    /// Whether these are over surfaces that may reach over each other.
    loose: bool,
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

/// Draughts of a table at which the skin is looked at.
const LOOKED_AT: usize = 3;

/// What integrals over a skin differ by, from which it is refused.
const REFUSED: f64 = 1e-2;

impl HydrostaticBody {
    /// The hull; none of a body of triangles.
    #[must_use]
    pub fn hull(&self) -> Option<&Hull> {
        match &self.body {
            BodyShape::Hull(hull) => Some(hull),
            BodyShape::Triangles(_) => None,
        }
    }

    /// Those of the notes that are warnings, for files: without the folder of the input.
    pub fn warnings(&self) -> impl Iterator<Item = String> + '_ {
        self.notes.iter().filter(|note| is_warning(note)).map(|note| without_folder(note, &self.path))
    }

    /// Heights of the lowest and the highest point \[m\]; none of a hull.
    fn heights(&self) -> Option<[f64; 2]> {
        match &self.body {
            BodyShape::Hull(_) => None,
            BodyShape::Triangles(meshes) => meshes.first()?.bounds().map(|[low, high]| [low[2], high[2]]),
        }
    }

    /// Height of its lowest point \[m\].
    pub(in crate::report) fn lowest(&self) -> f64 {
        match (&self.body, self.heights()) {
            (BodyShape::Hull(hull), _) => hull.bottom(),
            (_, heights) => heights.map_or(0.0, |[low, _]| low),
        }
    }

    /// Why a body of triangles does not float at its design draught; none where it does, or none is stated.
    fn draught_fault(&self) -> Option<String> {
        let (draught, [bottom, top]) = (self.particulars.draught?, self.heights()?);
        if draught > top + AT_EDGE * (top - bottom) {
            return Some(format!(
                "the design draught of {draught:.3} m lies above the highest point of the body, {top:.3} m: state one within it; z_origin \
                 in the TOML beside it moves the body"
            ));
        }
        (draught <= bottom + AFLOAT * (top - bottom)).then(|| HullError::Aground { draught, bottom }.to_string())
    }

    /// Draughts of its table where none are asked for \[m\], of [`default_draughts`]; up from the lowest point of a body of
    /// triangles that is far from the base line.
    ///
    /// # Errors
    /// [`Failure::Usage`] for a body without a height.
    pub fn default_draughts(&self) -> Result<Vec<f64>, Failure> {
        let list = match self.heights() {
            // Of panels z = 0 is the waterline.
            Some([low, high]) if self.particulars.draught.is_none() && low.abs() > AT_BASE * (high - low) => {
                default_draughts(None, high - low).into_iter().map(|draught| low + draught).collect()
            }
            _ => default_draughts(self.particulars.draught, self.particulars.depth),
        };
        if list.is_empty() {
            let message = "the body has no height from which draughts follow: give --draught or --draughts";
            return Err(Failure::Usage(message.to_owned()));
        }
        Ok(list)
    }

    /// Hydrostatics at draughts above the base line \[m\], with warnings about coefficients above 1.
    ///
    /// # Errors
    /// [`Failure::Input`] when a quantity is none that its body can have.
    pub fn curves_of_form(
        &self,
        draughts: &[f64],
        conventions: &Conventions,
    ) -> Result<(CurvesOfForm, Vec<String>), Failure> {
        let table = match &self.body {
            BodyShape::Hull(hull) => CurvesOfForm::new(hull, draughts, conventions),
            BodyShape::Triangles(meshes) => of_meshes(meshes, &self.particulars, draughts, conventions),
        };
        let bounds = self.bounds();
        let impossible = |row: &Hydrostatics| row.impossible(bounds);
        let faults: Vec<String> = table.rows.iter().flat_map(impossible).collect();
        if let Some(first) = faults.first() {
            let more = if faults.len() > 1 { format!(", and {} more", faults.len() - 1) } else { String::new() };
            let remedy =
                "The skin is counted twice, turned over, or has walls or tanks inside it: give the outer skin alone";
            return Err(Failure::Input(vec![problem("E353", &self.path, format!("{first}{more}"), remedy)]));
        }
        let unclosed = self.unclosed(draughts);
        if let Some(fault) =
            unclosed.iter().find(|found| !found.above_rim && found.volume.max(found.waterplane) > REFUSED)
        {
            return Err(Failure::Input(vec![problem("E353", &self.path, contradicts(fault), OF_SKIN)]));
        }
        let [least, greatest] = bounds;
        let above = |row: &Hydrostatics| {
            let extents = [greatest[0] - least[0], greatest[1] - least[1], row.draught - least[2]];
            // Dimensions are measured on triangles, which lie inside the surface.
            let slack = extents.map(|extent| 2.0 * self.deviation / extent.max(f64::MIN_POSITIVE));
            let found = row.above_one(slack.iter().sum());
            (!found.is_empty()).then(|| format!("{} at {:.3} m", found.join(", "), row.draught))
        };
        let warnings = table.rows.iter().find_map(above).map(|found| {
            let dimensions = if matches!(self.body, BodyShape::Hull(_)) && conventions.assumed.breadth {
                "The surface is broader or longer between the lines of the table than on them: give more lines where the hull bends"
            } else {
                "Lpp, B and T are less than those of the body, or are measured elsewhere. State them"
            };
            let message = format!("coefficients are above 1: {found}");
            Diagnostic { severity: Severity::Warning, ..problem("W353", &self.path, message, dimensions) }
        });
        let worst = unclosed
            .iter()
            .max_by(|a, b| a.volume.max(a.waterplane).total_cmp(&b.volume.max(b.waterplane)))
            .map(|found| problem("W355", &self.path, contradicts(found), OF_SKIN))
            .map(|problem| Diagnostic { severity: Severity::Warning, ..problem });
        let warnings = warnings.into_iter().chain(worst).chain(self.unusual(&table)).map(|warning| warning.to_string());
        Ok((table, warnings.collect()))
    }

    /// What the integrals over the skin contradict at some of the draughts; nothing of a hull, whose faces are implied.
    fn unclosed(&self, draughts: &[f64]) -> Vec<Unclosed> {
        let BodyShape::Triangles(meshes) = &self.body else { return Vec::new() };
        let Some(mesh) = meshes.last().filter(|_| !self.loose) else { return Vec::new() };
        let mut sorted: Vec<f64> = draughts.iter().copied().filter(|draught| draught.is_finite()).collect();
        sorted.sort_by(f64::total_cmp);
        sorted.dedup();
        let count = sorted.len().min(LOOKED_AT);
        let chosen = (1..=count).map(|k| sorted[k * sorted.len() / count - 1]);
        chosen.filter_map(|draught| unclosed(mesh, draught)).collect()
    }

    /// What hardly any ship has at the design draught, in the row that is near it; where no draught is stated, in that of
    /// the greatest.
    fn unusual(&self, table: &CurvesOfForm) -> Option<Diagnostic> {
        let off = |row: &Hydrostatics| self.particulars.draught.map_or(-row.draught, |t| (row.draught - t).abs());
        let row = table.rows.iter().min_by(|a, b| off(a).total_cmp(&off(b)))?;
        let draught = row.draught;
        if self.particulars.draught.is_some_and(|stated| (draught - stated).abs() > NEAR_DESIGN * stated) {
            return None;
        }
        let found: Vec<String> = row.unusual().into_iter().map(|(_, found)| found).collect();
        let remedy = "Check where AP is, and the forward axis";
        let message = || format!("at {draught:.3} m {}", found.join(", "));
        let problem = || problem("W354", &self.path, message(), remedy);
        (!found.is_empty()).then(|| Diagnostic { severity: Severity::Warning, ..problem() })
    }

    /// The corners of a box that holds the body \[m\]: triangles lie inside a surface that bends outward.
    fn bounds(&self) -> [[f64; 3]; 2] {
        match &self.body {
            BodyShape::Triangles(meshes) => {
                let (mut least, mut greatest) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
                for [low, high] in meshes.iter().filter_map(TriangleMesh::bounds) {
                    for k in 0..3 {
                        least[k] = least[k].min(low[k] - self.deviation);
                        greatest[k] = greatest[k].max(high[k] + self.deviation);
                    }
                }
                [least, greatest]
            }
            BodyShape::Hull(hull) => {
                let points = hull.surface().points();
                let along = |k: usize, pick: fn(f64, f64) -> f64| points.iter().map(|p| p[k]).fold(points[0][k], pick);
                let [least, greatest] = [f64::min, f64::max].map(|pick| [0, 1, 2].map(|k| along(k, pick)));
                let half = greatest[1].max(-least[1]);
                [[least[0], -half, least[2]], [greatest[0], half, greatest[2]]]
            }
        }
    }
}

/// What to do about a skin that is not closed.
const OF_SKIN: &str =
    "Close the skin below the draught, and give it alone, turned outward. Deck, transom and flat bow may be missing";

/// What integrals over a skin contradict, in words.
fn contradicts(Unclosed { draught, volume, waterplane, above_rim }: &Unclosed) -> String {
    let why =
        if *above_rim { "the draught is above the rim of an open deck" } else { "the skin is not closed or not one" };
    let [volume, waterplane] = [volume, waterplane].map(|off| 100.0 * off);
    format!(
        "at {draught:.3} m the integrals over the skin differ by {volume:.1} % of the volume and {waterplane:.1} % of the waterplane: {why}"
    )
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

/// A mesh (STL, OBJ, GLB), panels (GDF, NEMOH, PNL), the surfaces of a CAD file (STEP, IGES, 3DM) or a control net
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
/// Those of [`read_hydrostatic_body`]; [`Failure::Usage`] when conventions are given for a hull, or a draught at which the
/// body does not float.
pub fn read_hydrostatic_body_with(path: &Path, overrides: &Overrides) -> Result<HydrostaticBody, Failure> {
    let extension = ending(path);
    let design = matches!(extension.as_str(), "toml" | "hgf" | "huf");
    let source = if path.is_dir() || design {
        read_source_with(path, overrides)?
    } else {
        let (bytes, list) = (read_bytes(path)?, sidecar(path, overrides)?);
        let list = list.iter().map(|(name, text)| (name.as_str(), text.as_str()));
        if let Some(body) = read_body(&path.display().to_string(), &bytes, list) {
            let body = body.map(|read| of_body(path, read)).map_err(|problems| overrides.refused(problems))?;
            return match body.draught_fault() {
                None => Ok(body),
                Some(fault) if overrides.states_draught() => Err(Failure::of_draught(&fault)),
                Some(fault) => Err(Failure::Input(vec![problem("E314", path, fault, "")])),
            };
        }
        source_of(path, bytes, overrides)?
    };
    let particulars = *source.hull.particulars();
    let body = BodyShape::Hull(Box::new(source.hull));
    let path = path.to_owned();
    let (conventions, notes) = (source.conventions, source.notes);
    Ok(HydrostaticBody { path, body, deviation: 0.0, loose: false, particulars, conventions, notes })
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
        let hull = hull.with_draught(draught).map_err(|error| Failure::of_draught(&error))?;
        body.particulars = *hull.particulars();
        body.body = BodyShape::Hull(Box::new(hull));
    }
    Ok(body)
}

fn of_body(path: &Path, read: ReadBody) -> HydrostaticBody {
    let [least, greatest] = read.meshes.last().and_then(TriangleMesh::bounds).unwrap_or_default();
    let extent = |k: usize| greatest[k] - least[k];
    let stated = read.stated;
    let mut particulars = PrincipalParticulars {
        length_between_perpendiculars: stated.length_between_perpendiculars.unwrap_or(extent(0)),
        breadth: stated.breadth.unwrap_or(extent(1)),
        draught: stated.draught.filter(|_| stated.states_draught()),
        depth: stated.depth.unwrap_or(if greatest[2] > 0.0 { greatest[2] } else { extent(2) }),
    };
    let conventions = Conventions::default();
    // The breadth of a ship is that of its waterline, which flare does not widen.
    if let (None, Some(draught)) = (stated.breadth, stated.draught) {
        let row = of_meshes(&read.meshes, &particulars, &[draught], &conventions).rows;
        let afloat = row.first().map_or(0.0, |row| row.waterline_breadth);
        particulars.breadth = if afloat > 0.0 { afloat } else { particulars.breadth };
    }
    let conventions = Conventions {
        assumed: Assumed::of(&stated),
        given: Given::of_table(particulars.draught.map(|_| false)),
        ..conventions
    };
    let mut notes: Vec<String> = read.notes.iter().map(ToString::to_string).collect();
    if stated.length_between_perpendiculars.is_none() {
        notes.push(format!(
            "Lpp is not stated; it is taken as the length of the body, {:.3} m, from x = 0",
            particulars.length_between_perpendiculars
        ));
    }
    let (path, deviation, loose) = (path.to_owned(), read.deviation, read.loose);
    HydrostaticBody { path, body: BodyShape::Triangles(read.meshes), deviation, loose, particulars, conventions, notes }
}
