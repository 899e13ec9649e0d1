//! How a body lies in its file, and how it comes into the ship's frame: axes, unit, origin, and the side that is not given.

use super::super::problem::{FilePosition, Problems};
use super::super::settings::{BodyFrame, Settings};
use super::parts::of_numbers;
use crate::hull::{BodyPart, DrySkin, InnerShells, TriangleMesh};
use crate::units::counted;

/// A body whose ends of an axis differ by less than this part of its size is symmetric about the zero of the axis.
const SYMMETRIC: f64 = 1e-3;

/// The middle of a body over its extent athwartships, at most, of one that is not quite symmetric.
const NEARLY: f64 = 0.1;

/// Odd moments of a body that is its own mirror image, at most.
const SKEWED: f64 = 0.01;

/// Length over breadth of a body that is certainly longer than it is broad.
const BROAD: f64 = 1.5;

/// The axes of a file.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Corners of one side of a body this many times as far from the centreplane as its inner edge belong on it.
const MOVED: f64 = 1.5;

/// Wells that have more than this part of what the outer skin encloses are named.
const WELLS: f64 = 0.1;

/// Faces that enclose less than this part of the power 3/2 of their area are sheets.
const NO_VOLUME: f64 = 1e-6;

/// Bodies are rarely shorter or longer than this \[m\].
const SHORT: f64 = 2.0;
const LONG: f64 = 600.0;

/// Points nearer to the centreplane than this part of the size of the body are on it.
const ON_CENTREPLANE: f64 = 1e-6;

/// What a file says of its body.
pub(in super::super) struct Given {
    /// Its unit \[m\].
    pub(in super::super) unit: f64,
    /// The axes, where the format has them.
    pub(in super::super) axes: Option<[(usize, f64); 3]>,
    /// The axis that points up in files of this format, unless the body contradicts it.
    pub(in super::super) up: usize,
    /// Whether one side is given, where the format says so.
    pub(in super::super) half: Option<bool>,
    /// Triangles over surfaces, each for itself.
    pub(in super::super) surfaces: bool,
    /// What is left out of it, in words.
    pub(in super::super) notes: Vec<String>,
}

impl Given {
    /// A file that says nothing but its unit \[m\].
    pub(in super::super) fn plain(unit: f64) -> Self {
        Self { unit, axes: None, up: 2, half: None, surfaces: false, notes: Vec::new() }
    }

    /// Metres in what the coordinates of the file count, by the settings before the file.
    pub(in super::super) fn metres(&self, settings: &Settings) -> f64 {
        settings.units.map_or(self.unit, |units| units.metres(1.0)) * settings.frame.scale.unwrap_or(1.0)
    }
}

/// The axes of a file whose x is forward, y to port and z up.
pub(in super::super) const AS_WRITTEN: [(usize, f64); 3] = [(0, 1.0), (1, 1.0), (2, 1.0)];

/// How points of a file come into the ship's frame.
pub(in super::super) struct Placement {
    axes: [(usize, f64); 3],
    unit: f64,
    slack: f64,
    origin: [f64; 2],
}

impl Placement {
    /// By how a body lies along the axes of its file, the settings and what the file says; none, with a problem, when the axes
    /// cannot be told.
    pub(in super::super) fn of(
        extents: &Extents,
        settings: &Settings,
        given: &Given,
        problems: &mut Problems,
    ) -> Option<Self> {
        let BodyFrame { axes, up, x_origin, z_origin, .. } = settings.frame;
        let known = axes.or(if up.is_none() { given.axes } else { None });
        let axes = known.or_else(|| found_axes(extents, up, given.up, problems))?;
        let unit = given.metres(settings);
        let size = extents.size() * unit;
        let origin = [x_origin, z_origin].map(|place| place.unwrap_or(0.0));
        Some(Self { axes, unit, slack: ON_CENTREPLANE * size, origin })
    }

    /// Points nearer to the centreplane than a millionth of the size are on it.
    pub(in super::super) fn place(&self, corner: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = self.axes.map(|(axis, sign)| sign * self.unit * corner[axis]);
        [x + self.origin[0], if y.abs() <= self.slack { 0.0 } else { y }, z + self.origin[1]]
    }
}

/// The body in the ship's frame: metres, x forward from AP, y to port, z up; whole, and turned outward. All meshes are
/// of one body and are moved alike; a second one comes from surfaces.
pub(in super::super) fn framed(
    mut meshes: Vec<TriangleMesh>,
    settings: &Settings,
    given: &Given,
    problems: &mut Problems,
) -> Vec<TriangleMesh> {
    let Some(extents) = Extents::of_mesh(&meshes[0]).filter(|_| !problems.any_errors()) else { return meshes };
    let Some(placement) = Placement::of(&extents, settings, given, problems) else { return meshes };
    let BodyFrame { x_origin, .. } = settings.frame;
    let surfaces = given.surfaces;
    let place = |corner: [f64; 3]| placement.place(corner);
    let (mut half, mut united) = (None, false);
    for (k, mesh) in meshes.iter_mut().enumerate() {
        let corners: Vec<[[f64; 3]; 3]> = mesh.corners().map(|triangle| triangle.map(place)).collect();
        *mesh = TriangleMesh::from_corners(corners.into_iter());
        if !surfaces {
            *mesh = std::mem::take(mesh).welded().without_shells_of_no_area();
            let (single, doubles) = std::mem::take(mesh).without_doubles();
            *mesh = single;
            if doubles > 0 && k == 0 {
                let message = format!("{} given twice: counted once", counted(doubles, "triangle"));
                problems.warning("W320", FilePosition::FILE, message, "");
            }
            let choice = settings.frame.parts.as_deref();
            *mesh = of_numbers(std::mem::take(mesh), choice, if k == 0 { Some(&mut *problems) } else { None });
        }
        if k == 0 {
            half = one_side(mesh, settings.frame.half, given.half, problems);
        }
        if let Some(slack) = half {
            *mesh = mesh.mirrored(slack);
        }
        if surfaces {
            *mesh = without_top(mesh);
        }
        let (oriented, turned) = std::mem::take(mesh).oriented();
        *mesh = oriented;
        if turned > 0 && k == 0 && !surfaces {
            problems.note(format!("{} turned outward", counted(turned, "triangle")));
        }
        if !surfaces {
            *mesh = without_dry_skin(mesh, if k == 0 { Some(&mut *problems) } else { None });
            *mesh = without_sheets(mesh, if k == 0 { Some(&mut *problems) } else { None });
            let (single, is_united) = without_inner(mesh, k == 0, problems);
            (*mesh, united) = (single, united || is_united);
        }
    }
    let Some([least, greatest]) = meshes[0].bounds() else { return meshes };
    let [volume, skin] = meshes[0].enclosed_and_skin();
    if volume.abs() <= NO_VOLUME * skin.powf(1.5) {
        let message = format!("the faces enclose no volume: {volume:.1e} m3 inside {skin:.3e} m2");
        let remedy = "Give the faces of the hull; of lines in space alone, without the faces, give the stations";
        problems.error("E354", FilePosition::FILE, message, remedy);
    }
    let length = greatest[0] - least[0];
    if !(0.01..=1e4).contains(&length) {
        let message = format!("the body is {length} m long");
        problems.error(
            "E351",
            FilePosition::FILE,
            message,
            "Say --input-unit, or units or scale in a TOML file of the same name beside it",
        );
    }
    size(length, given, settings, problems);
    stated([length, greatest[1] - least[1]], settings, problems);
    // Panels count from the free surface, and are open there.
    let at_surface = given.axes.is_some() && given.half.is_some();
    if x_origin.is_none() && least[0].abs() > 0.2 * length {
        meshes.iter_mut().flat_map(|mesh| &mut mesh.vertices).for_each(|vertex| vertex[0] -= least[0]);
        let message = format!(
            "the body runs from {:.3} to {:.3} m along its length; its aftmost point is taken as AP. x_origin in the TOML beside it \
             says otherwise",
            least[0], greatest[0]
        );
        problems.warning("W320", FilePosition::FILE, message, "");
    }
    if !at_surface {
        off_base([least[2], greatest[2]], settings, problems);
    }
    // The pieces of a union are no conforming mesh.
    let open = if surfaces || united { Vec::new() } else { meshes[0].gaps() };
    if !surfaces
        && !united
        && !at_surface
        && let Some((share, [low, high])) = meshes[0].hole()
    {
        let message = format!(
            "a hole of {:.0} % of the skin, from ({:.3}, {:.3}, {:.3}) to ({:.3}, {:.3}, {:.3}) m: a side or the bottom is missing",
            100.0 * share,
            low[0],
            low[1],
            low[2],
            high[0],
            high[1],
            high[2]
        );
        let remedy = "Close the body: deck, transom and flat bow alone may be missing";
        problems.error("E354", FilePosition::FILE, message, remedy);
    }
    let is_level = |edge: &[usize; 2]| edge.iter().all(|&k| meshes[0].vertices[k][2].abs() <= ON_CENTREPLANE * length);
    if !(open.is_empty() || at_surface && open.iter().all(is_level)) {
        let lowest = open.iter().flatten().map(|&k| meshes[0].vertices[k][2]).fold(f64::INFINITY, f64::min);
        let message = format!(
            "{} open, the lowest at z = {lowest:.3} m: what is missing must be deck, transom or flat bow",
            counted(open.len(), "edge")
        );
        problems.warning("W351", FilePosition::FILE, message, "");
    }
    meshes
}

/// Says of bodies whose lowest point is far from z = 0 that draughts count from there; nothing where z_origin is given.
pub(in super::super) fn off_base([low, high]: [f64; 2], settings: &Settings, problems: &mut Problems) {
    if settings.frame.z_origin.is_none() && low.abs() > 0.2 * (high - low) {
        let message = format!(
            "the lowest point is {low:.3} m from z = 0 of the file, from where draughts count; z_origin in the TOML beside it moves it"
        );
        problems.warning("W320", FilePosition::FILE, message, "");
    }
}

/// Says of bodies that are very short or very long for a ship that their unit may be another.
pub(in super::super) fn size(length: f64, given: &Given, settings: &Settings, problems: &mut Problems) {
    let is_stated = settings.units.is_some() || settings.frame.scale.is_some();
    if is_stated || (SHORT..=LONG).contains(&length) || !(0.01..=1e4).contains(&length) {
        return;
    }
    let message = format!("the body is {length:.3} m long, with {} m for the unit of the file", given.unit);
    let remedy = "Say --input-unit (units in the TOML beside it) where the unit is another";
    problems.warning("W320", FilePosition::FILE, message, remedy);
}

/// Dimensions that contradict the length and breadth of the body \[m\].
fn stated([length, breadth]: [f64; 2], settings: &Settings, problems: &mut Problems) {
    if let Some(stated) = settings.stated.breadth.filter(|stated| (stated / breadth - 1.0).abs() > 0.05) {
        let message = format!("B is stated as {stated} m, and the body is {breadth:.3} m broad");
        problems.warning("W309", FilePosition::FILE, message, "Correct B, or the unit of the body");
    }
    if let Some(stated) =
        settings.stated.length_between_perpendiculars.filter(|l| *l > 1.5 * length || length > 1.5 * *l)
    {
        let message = format!("L_PP is stated as {stated} m, and the body is {length:.3} m long");
        problems.warning("W310", FilePosition::FILE, message, "Correct L_PP, or the unit of the body");
    }
}

/// A mesh without the sheets that share edges with its skin inside, and the inner skin of a hollow body, turned outward; of
/// several meshes the first alone has problems to say.
fn without_dry_skin(mesh: &mut TriangleMesh, problems: Option<&mut Problems>) -> TriangleMesh {
    let (mesh, DrySkin { sheets, inner, wells }) = std::mem::take(mesh).without_dry_skin();
    let mut problems = problems;
    if wells > WELLS
        && let Some(problems) = &mut problems
    {
        let message = format!(
            "holds or wells that are open from above have {:.0} % of what the outer skin encloses: they count as open to the water",
            100.0 * wells
        );
        let remedy = "Give the outer skin alone where they stay dry, or close them by a deck";
        problems.warning("W320", FilePosition::FILE, message, remedy);
    }
    if sheets + inner == 0 {
        return mesh;
    }
    let left = |count: usize, what: &str| format!("{} {what}", counted(count, "triangle"));
    let of_sheets =
        "of sheets inside that share edges with the skin left out: bulkheads and decks add nothing to the body";
    let of_inner =
        "of an inner skin left out: the body is hollow, and displaces what its outer skin encloses up to the rim";
    if let Some(problems) = problems {
        for (count, what) in [(sheets, of_sheets), (inner, of_inner)] {
            if count > 0 {
                problems.warning("W320", FilePosition::FILE, left(count, what), "");
            }
        }
    }
    mesh.oriented().0
}

/// A mesh without open sheets beside its body; of several meshes the first alone has problems to say.
fn without_sheets(mesh: &mut TriangleMesh, problems: Option<&mut Problems>) -> TriangleMesh {
    let (mesh, sheets) = std::mem::take(mesh).without_sheets();
    let mesh = if sheets > 0 { mesh.oriented().0 } else { mesh };
    if let Some(problems) = problems.filter(|_| sheets > 0) {
        let message = format!(
            "{} of open sheets left out: bulkheads, keels and rudders as sheets have no volume",
            counted(sheets, "triangle")
        );
        problems.warning("W320", FilePosition::FILE, message, "");
    }
    mesh
}

/// A mesh without the shells inside others, and whether it is cut to the skin of a union; of nested meshes the first alone has
/// warnings to say. What cannot be united counts twice, whichever of them it is.
fn without_inner(mesh: &mut TriangleMesh, is_first: bool, problems: &mut Problems) -> (TriangleMesh, bool) {
    let (mesh, found) = std::mem::take(mesh).without_inner_shells();
    let InnerShells { inside, crossing, touching, united, torn, sum, unseen } = found;
    if crossing > 0 && !united {
        if !problems.any_errors() {
            let why =
                if torn { "the skin of their union does not close" } else { "there are too many for their union" };
            let message = format!(
                "shells of {} reach into others, and {why}: what they share would count twice in the {sum:.4e} m3 of all parts",
                counted(crossing, "triangle")
            );
            let remedy = "Unite the shells to one skin, or choose parts that do not cross with --parts";
            problems.error("E354", FilePosition::FILE, message, remedy);
        }
        return (mesh, united);
    }
    if !is_first {
        return (mesh, united);
    }
    if inside > 0 {
        let message = format!(
            "{} of shells inside the others left out: tanks, decks and bulkheads add nothing to the body",
            counted(inside, "triangle")
        );
        problems.warning("W320", FilePosition::FILE, message, "");
    }
    if unseen > 0 {
        let message = format!(
            "{}: none is looked at for tanks inside others or for crossings, which add to the volume",
            counted(unseen, "shell")
        );
        problems.warning("W351", FilePosition::FILE, message, "Unite the parts to one skin");
    }
    if touching {
        let message =
            format!("shells of {} touch others: what they touch with is no skin", counted(crossing, "triangle"));
        problems.warning("W320", FilePosition::FILE, message, "");
    } else if crossing > 0 {
        let message =
            format!("shells of {} reach into others: what they share counts once", counted(crossing, "triangle"));
        problems.warning("W351", FilePosition::FILE, message, "Unite the shells to one skin");
    }
    (mesh, united)
}

/// Of a body of which one side is given, within how much of the centreplane its corners belong on it \[m\]; none of a
/// whole one. `stated` stands before what the `format` says, and both before how the body lies.
fn one_side(mesh: &TriangleMesh, stated: Option<bool>, format: Option<bool>, problems: &mut Problems) -> Option<f64> {
    let part = mesh.part();
    let known = stated.or(format);
    if known == Some(false) {
        if stated.is_none() && part != BodyPart::Whole {
            let message = "the body is on one side of y = 0, and the file names no plane of symmetry there: it is taken as whole. \
                           --body half (body in the TOML beside it) says otherwise";
            problems.warning("W320", FilePosition::FILE, message.to_owned(), "");
        }
        return None;
    }
    let slack = match part {
        BodyPart::Half { inner } => MOVED * inner.abs(),
        BodyPart::Whole if known.is_none() => {
            beside(mesh, problems);
            return None;
        }
        BodyPart::ClosedBeside if known.is_none() => {
            let message =
                "the body lies on one side of y = 0 and is closed there: one half of a hull, or a whole body beside it";
            problems.error(
                "E351",
                FilePosition::FILE,
                message.to_owned(),
                "Say --body half or --body whole (body in the TOML beside it)",
            );
            return None;
        }
        _ => 0.0,
    };
    let [both, _] = mesh.astride();
    if !both.triangles.is_empty() {
        let message = format!(
            "{} of parts on both sides of y = 0 are not mirrored, as one side of the others is",
            counted(both.triangles.len(), "triangle")
        );
        problems.warning("W320", FilePosition::FILE, message, "");
    }
    let [least, greatest] = mesh.bounds()?;
    if slack > ON_CENTREPLANE * (greatest[1] - least[1]) {
        let message = format!(
            "one side of the body is given, and its inner edge is {:.4} m off y = 0: it is moved there and mirrored. \
             --body whole (body in the TOML beside it) says otherwise",
            slack / MOVED
        );
        problems.warning("W320", FilePosition::FILE, message, "");
    } else {
        problems.note("one side of the body is given; it is mirrored".to_owned());
    }
    Some(slack)
}

/// Says of bodies that begin near the centreplane that they are taken as whole; others that are not symmetric are named with the
/// axes.
fn beside(mesh: &TriangleMesh, problems: &mut Problems) {
    let Some([least, greatest]) = mesh.bounds() else { return };
    let (size, middle) = (greatest[1] - least[1], 0.5 * (least[1] + greatest[1]).abs());
    let inner = middle - 0.5 * size;
    if middle > SYMMETRIC * size && inner.abs() <= NEARLY * size {
        let message = format!(
            "the body begins {inner:.3} m from y = 0, nearly as one side of a hull does: it is taken as whole. \
             --body half (body in the TOML beside it) says otherwise"
        );
        problems.warning("W320", FilePosition::FILE, message, "");
    }
}

/// A body without what is level at its top: an untrimmed deck is wider than the hull, and closes nothing that counts.
fn without_top(mesh: &TriangleMesh) -> TriangleMesh {
    let Some([least, greatest]) = mesh.bounds() else { return mesh.clone() };
    let top = greatest[2] - ON_CENTREPLANE * (greatest[2] - least[2]);
    let kept: Vec<[[f64; 3]; 3]> = mesh.corners().filter(|t| t.iter().any(|point| point[2] < top)).collect();
    TriangleMesh::from_corners(kept.into_iter())
}

/// How a body lies along the axes of its file.
pub(in super::super) struct Extents {
    least: [f64; 3],
    greatest: [f64; 3],
    /// Root mean square distance from its middle.
    spread: [f64; 3],
    /// How far it is from its mirror image across the plane through zero, and across that through the middle of its extent:
    /// odd moments of its skin over their greatest size; 0 of a body that is mirrored there.
    skew: [[f64; 3]; 2],
}

impl Extents {
    /// Of the skin of a mesh; none of an empty one.
    fn of_mesh(mesh: &TriangleMesh) -> Option<Self> {
        let bounds = mesh.bounds()?;
        Some(Self::new(bounds, |origin| mesh.moments(origin)))
    }

    /// Of points; none where there are none.
    pub(in super::super) fn of_points(points: &[[f64; 3]]) -> Option<Self> {
        let first = *points.first()?;
        let fold = |pick: fn(f64, f64) -> f64| {
            points.iter().fold(first, |ends, point| [0, 1, 2].map(|k| pick(ends[k], point[k])))
        };
        let bounds = [fold(f64::min), fold(f64::max)];
        let mean = |origin: [f64; 3]| {
            let (mut first, mut mixed) = ([0.0; 3], [[0.0; 3]; 3]);
            for point in points {
                let from: [f64; 3] = [0, 1, 2].map(|k| (point[k] - origin[k]) / points.len() as f64);
                for k in 0..3 {
                    first[k] += from[k];
                    (0..3).for_each(|l| mixed[k][l] += from[k] * (point[l] - origin[l]));
                }
            }
            (first, mixed)
        };
        Some(Self::new(bounds, mean))
    }

    /// By first moments and products of inertia about a point, over the area of the skin.
    fn new(bounds: [[f64; 3]; 2], moments: impl Fn([f64; 3]) -> ([f64; 3], [[f64; 3]; 3])) -> Self {
        let (_, about_mean) = moments(moments([0.0; 3]).0);
        let spread = [0, 1, 2].map(|k: usize| about_mean[k][k].sqrt());
        let [least, greatest] = bounds;
        let half = [0, 1, 2].map(|k: usize| (0.5 * (greatest[k] - least[k])).max(f64::MIN_POSITIVE));
        let middle = middle(bounds);
        let skew = |axis: usize, place: f64| {
            let mut origin = middle;
            origin[axis] = place;
            let (first, mixed) = moments(origin);
            let others = (0..3).filter(|k| *k != axis).map(|k| mixed[axis][k].abs() / (half[axis] * half[k]));
            others.fold(first[axis].abs() / half[axis], f64::max)
        };
        let skew = [[0.0; 3], middle].map(|places| [0, 1, 2].map(|k| skew(k, places[k])));
        Self { least, greatest, spread, skew }
    }

    pub(in super::super) fn extent(&self, axis: usize) -> f64 {
        self.greatest[axis] - self.least[axis]
    }

    /// The greatest extent.
    fn size(&self) -> f64 {
        (0..3).map(|k| self.extent(k)).fold(0.0, f64::max)
    }

    /// Distance of the middle from zero, over the extent.
    fn off(&self, axis: usize) -> f64 {
        0.5 * (self.least[axis] + self.greatest[axis]).abs() / self.extent(axis).max(f64::MIN_POSITIVE)
    }

    /// Whether zero is in the middle.
    fn is_centred(&self, axis: usize) -> bool {
        (self.least[axis] + self.greatest[axis]).abs() <= SYMMETRIC * self.size()
    }

    /// Whether the body is its own mirror image across the plane through zero.
    fn is_mirrored(&self, axis: usize) -> bool {
        self.is_centred(axis) && self.skew[0][axis] < SKEWED
    }

    /// Whether the body is not its own mirror image across the middle of its extent.
    fn is_uneven(&self, axis: usize) -> bool {
        self.skew[1][axis] >= SKEWED
    }

    /// Whether it begins at zero.
    fn is_one_sided(&self, axis: usize) -> bool {
        self.least[axis].abs().min(self.greatest[axis].abs()) <= NEARLY * self.extent(axis)
    }
}

fn middle([least, greatest]: [[f64; 3]; 2]) -> [f64; 3] {
    [0, 1, 2].map(|k| 0.5 * (least[k] + greatest[k]))
}

/// The axes of a body; none, with a problem, when they cannot be told.
///
/// They are those in which files of the format are written, x forward and the `usual` axis up, unless the body contradicts them:
/// it is no mirror image of itself across the centreplane that they give, and is one across that of another reading. Where its
/// shape fits both, as that of a box does, the axes are ambiguous.
fn found_axes(
    body: &Extents,
    up: Option<(usize, f64)>,
    usual: usize,
    problems: &mut Problems,
) -> Option<[(usize, f64); 3]> {
    // Right-handed: port is up x forward.
    let with_up = |(up, sign): (usize, f64)| {
        let (a, b) = ((up + 1) % 3, (up + 2) % 3);
        if body.extent(a) >= body.extent(b) {
            [(a, 1.0), (b, sign), (up, sign)]
        } else {
            [(b, 1.0), (a, -sign), (up, sign)]
        }
    };
    if let Some(up) = up {
        return Some(with_up(up));
    }
    let written = if usual == 2 { AS_WRITTEN } else { with_up((usual, 1.0)) };
    let [forward, across, up] = written.map(|(axis, _)| axis);
    let is_tall =
        [forward, across].iter().all(|&k| body.extent(up) > body.extent(k) && body.spread[up] > body.spread[k]);
    let is_square = (body.extent(forward) - body.extent(across)).abs() <= SYMMETRIC * body.size();
    // Other readings, and whether the shape tells them from the one that is written.
    let mut readings: Vec<([(usize, f64); 3], bool)> = Vec::new();
    if !body.is_mirrored(across) {
        let is_broad = body.extent(across) > BROAD * body.extent(forward) && !body.is_centred(across);
        if body.extent(across) > body.extent(forward)
            && (body.is_mirrored(forward) || is_broad && body.is_one_sided(forward))
            && (is_broad || body.is_uneven(across))
        {
            readings.push((upright(across, forward, up), true));
        }
        if body.is_mirrored(up) && body.off(across) > 0.5 * NEARLY && !is_tall {
            readings.push((upright(forward, up, across), body.is_uneven(across)));
        }
        if is_tall && !is_square && body.is_mirrored(forward) {
            readings.push((upright(up, forward, across), body.is_uneven(across)));
        }
    }
    let is_anyhow = is_tall
        && !is_square
        && ![forward, across, up].iter().any(|&k| body.is_centred(k))
        && body.off(forward).min(body.off(across)) > 0.5 * NEARLY;
    let frame = match readings[..] {
        [] if !is_anyhow => written,
        [(other, true)] => other,
        _ => {
            let range = |k: usize| format!("{} runs from {} to {}", AXES[k], body.least[k], body.greatest[k]);
            let message = format!("the axes are ambiguous: {}", [0, 1, 2].map(range).join(", "));
            let remedy = "Say --axes \"x y z\" (the file's axis for forward, port and up; axes in the TOML beside it)";
            problems.error("E351", FilePosition::FILE, message, remedy);
            return None;
        }
    };
    say(body, frame, written, problems);
    Some(frame)
}

/// Says of a body how it lies where that is not usual.
fn say(body: &Extents, frame: [(usize, f64); 3], written: [(usize, f64); 3], problems: &mut Problems) {
    let [forward, across, up] = frame.map(|(axis, _)| axis);
    let remedy = "Say --axes (axes in the TOML beside it) where the axes are others";
    if frame != written {
        let words = frame.map(|(axis, sign)| format!("{}{}", if sign < 0.0 { "-" } else { "" }, AXES[axis]));
        let message = format!("axes are taken as \"{}\", by the symmetry of the body", words.join(" "));
        problems.warning("W320", FilePosition::FILE, message, remedy);
    }
    if !body.is_centred(across) && !body.is_one_sided(across) {
        let message = format!(
            "{} runs from {:.3} to {:.3} in the unit of the file: the body is not symmetric about the centreplane, and is taken as it is",
            AXES[across], body.least[across], body.greatest[across]
        );
        problems.warning("W320", FilePosition::FILE, message, remedy);
    }
    let [length, breadth, height] = [forward, across, up].map(|axis| body.extent(axis));
    if breadth > (1.0 + SYMMETRIC) * length {
        let message = format!(
            "the body is {length:.3} long, {breadth:.3} broad and {height:.3} high in the unit of the file, with its {} forward",
            AXES[forward]
        );
        problems.warning("W320", FilePosition::FILE, message, remedy);
    }
}

/// The right-handed frame of a body whose length, breadth and height are these axes.
fn upright(forward: usize, across: usize, up: usize) -> [(usize, f64); 3] {
    let sign = if (forward + 1) % 3 == across { 1.0 } else { -1.0 };
    [(forward, 1.0), (across, sign), (up, 1.0)]
}
