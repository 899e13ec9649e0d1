//! How a body lies in its file, and how it comes into the ship's frame: axes, unit, origin, and the side that is not given.

use super::super::problem::{FilePosition, Problems};
use super::super::settings::{BodyFrame, Settings};
use crate::hull::{BodyPart, InnerShells, TriangleMesh};
use crate::units::counted;

/// A body whose ends of an axis differ by less than this part of its size is symmetric about the zero of the axis.
const SYMMETRIC: f64 = 1e-3;

/// The middle of a body over its extent: up to the first athwartships, from the second on upwards, of one that is not quite
/// symmetric.
const NEARLY: f64 = 0.1;
const NOT_NEARLY: f64 = 0.5;

/// Corners of one side of a body this many times as far from the centreplane as its inner edge belong on it.
const MOVED: f64 = 1.5;

/// Points nearer to the centreplane than this part of the size of the body are on it.
const ON_CENTREPLANE: f64 = 1e-6;

/// What a file says of its body.
pub(in super::super) struct Given {
    /// Its unit \[m\].
    pub(in super::super) unit: f64,
    /// The axes, where the format has them.
    pub(in super::super) axes: Option<[(usize, f64); 3]>,
    /// Whether one side is given, where the format says so.
    pub(in super::super) half: Option<bool>,
    /// Triangles over surfaces, each for itself.
    pub(in super::super) surfaces: bool,
}

impl Given {
    /// A file that says nothing but its unit \[m\].
    pub(in super::super) fn plain(unit: f64) -> Self {
        Self { unit, axes: None, half: None, surfaces: false }
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
    /// By the bounds of the points, the settings and what the file says; none, with a problem, when the axes cannot be
    /// told.
    pub(in super::super) fn of(
        bounds: [[f64; 3]; 2],
        settings: &Settings,
        given: &Given,
        problems: &mut Problems,
    ) -> Option<Self> {
        let BodyFrame { axes, up, x_origin, z_origin, .. } = settings.frame;
        let known = axes.or(if up.is_none() { given.axes } else { None });
        let axes = known.or_else(|| found_axes(bounds, up, problems))?;
        let unit = given.metres(settings);
        let size = (0..3).map(|k| bounds[1][k] - bounds[0][k]).fold(0.0, f64::max) * unit;
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
    let Some(bounds) = meshes[0].bounds().filter(|_| !problems.any_errors()) else { return meshes };
    let Some(placement) = Placement::of(bounds, settings, given, problems) else { return meshes };
    let BodyFrame { x_origin, z_origin, .. } = settings.frame;
    let surfaces = given.surfaces;
    let place = |corner: [f64; 3]| placement.place(corner);
    let mut half = None;
    for (k, mesh) in meshes.iter_mut().enumerate() {
        let corners: Vec<[[f64; 3]; 3]> = mesh.corners().map(|triangle| triangle.map(place)).collect();
        *mesh = TriangleMesh::from_corners(corners.into_iter());
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
            *mesh = without_inner(mesh, if k == 0 { Some(&mut *problems) } else { None });
        }
    }
    let Some([least, greatest]) = meshes[0].bounds() else { return meshes };
    let length = greatest[0] - least[0];
    if !(0.01..=1e4).contains(&length) {
        let message = format!("the body is {length} m long");
        problems.error(
            "E351",
            FilePosition::FILE,
            message,
            "Say units or scale in a TOML file of the same name beside it",
        );
    }
    if x_origin.is_none() && least[0].abs() > 0.2 * length {
        meshes.iter_mut().flat_map(|mesh| &mut mesh.vertices).for_each(|vertex| vertex[0] -= least[0]);
        let message = format!(
            "x of the file runs from {:.3} to {:.3} m; its aftmost point is taken as AP. x_origin in the TOML beside it says \
             otherwise",
            least[0], greatest[0]
        );
        problems.warning("W320", FilePosition::FILE, message, "");
    }
    let depth = greatest[2] - least[2];
    if z_origin.is_none() && least[2].abs() > 0.2 * depth {
        let message = format!(
            "the lowest point is {:.3} m from z = 0 of the file, from where draughts count; z_origin in the TOML beside it moves it",
            least[2]
        );
        problems.warning("W320", FilePosition::FILE, message, "");
    }
    let open = if surfaces { Vec::new() } else { meshes[0].open_edges() };
    if !open.is_empty() {
        let lowest = open.iter().flatten().map(|&k| meshes[0].vertices[k][2]).fold(f64::INFINITY, f64::min);
        let message = format!(
            "{} open, the lowest at z = {lowest:.3} m: what is missing must be deck, transom or flat bow",
            counted(open.len(), "edge")
        );
        problems.warning("W351", FilePosition::FILE, message, "");
    }
    meshes
}

/// A mesh without the shells inside others; of nested meshes the first alone has problems to say.
fn without_inner(mesh: &mut TriangleMesh, problems: Option<&mut Problems>) -> TriangleMesh {
    let (mesh, InnerShells { inside, crossing }) = std::mem::take(mesh).without_inner_shells();
    let Some(problems) = problems else { return mesh };
    if inside > 0 {
        let message = format!(
            "{} of shells inside the others left out: tanks, decks and bulkheads add nothing to the body",
            counted(inside, "triangle")
        );
        problems.warning("W320", FilePosition::FILE, message, "");
    }
    if crossing > 0 {
        let message = format!(
            "shells of {} reach into others; what they share counts twice in volume and areas",
            counted(crossing, "triangle")
        );
        problems.warning("W351", FilePosition::FILE, message, "Unite the shells to one skin");
    }
    mesh
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
        BodyPart::Whole if known.is_none() => return None,
        BodyPart::BesideWall if known.is_none() => {
            let message = "the body lies on one side of y = 0 and has a wall there: one half of a hull, or a whole body beside it";
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

/// A body without what is level at its top: an untrimmed deck is wider than the hull, and closes nothing that counts.
fn without_top(mesh: &TriangleMesh) -> TriangleMesh {
    let Some([least, greatest]) = mesh.bounds() else { return mesh.clone() };
    let top = greatest[2] - ON_CENTREPLANE * (greatest[2] - least[2]);
    let kept: Vec<[[f64; 3]; 3]> = mesh.corners().filter(|t| t.iter().any(|point| point[2] < top)).collect();
    TriangleMesh::from_corners(kept.into_iter())
}

/// The axes of a body by its extents; none, with a problem, when they cannot be told.
fn found_axes(
    [least, greatest]: [[f64; 3]; 2],
    up: Option<(usize, f64)>,
    problems: &mut Problems,
) -> Option<[(usize, f64); 3]> {
    let extent = |k: usize| greatest[k] - least[k];
    if let Some((up, sign)) = up {
        let (a, b) = ((up + 1) % 3, (up + 2) % 3);
        // Right-handed: port is up x forward.
        return Some(if extent(a) >= extent(b) {
            [(a, 1.0), (b, sign), (up, sign)]
        } else {
            [(b, 1.0), (a, -sign), (up, sign)]
        });
    }
    let long = (0..3).max_by(|&a, &b| extent(a).total_cmp(&extent(b)).then(b.cmp(&a)))?;
    let size = extent(long);
    let across = |k: usize| {
        let near = |value: f64| value.abs() <= SYMMETRIC * size;
        near(least[k] + greatest[k]) || near(least[k]) || near(greatest[k])
    };
    let symmetric = |k: usize| (least[k] + greatest[k]).abs() <= SYMMETRIC * size;
    // A body whose centreline is a little off, or whose sides differ, is nearer to symmetry across than up.
    let off = |k: usize| (least[k] + greatest[k]).abs() / extent(k).max(f64::MIN_POSITIVE);
    let is_nearly = |[across, up]: [usize; 2]| off(across) <= NEARLY && off(up) >= NOT_NEARLY;
    let names = ["x", "y", "z"];
    // The right-handed frame in which the longest axis is forward and the third is up.
    let (y, z) = ((long + 1) % 3, (long + 2) % 3);
    let frame = match [y, z].map(|k| (symmetric(k), across(k))) {
        [(true, _), (false, _)] => [(long, 1.0), (y, 1.0), (z, 1.0)],
        [(false, _), (true, _)] => [(long, 1.0), (z, -1.0), (y, 1.0)],
        [(false, true), (false, false)] if !is_nearly([z, y]) => [(long, 1.0), (y, 1.0), (z, 1.0)],
        [(false, false), (false, true)] if !is_nearly([y, z]) => [(long, 1.0), (z, -1.0), (y, 1.0)],
        _ if is_nearly([y, z]) => [(long, 1.0), (y, 1.0), (z, 1.0)],
        _ if is_nearly([z, y]) => [(long, 1.0), (z, -1.0), (y, 1.0)],
        // Both may be: what is usual.
        [(a, true), (b, true)] if a == b => [(long, 1.0), (y, 1.0), (z, 1.0)],
        _ => {
            let message = format!(
                "the axes are ambiguous: x runs from {} to {}, y from {} to {}, z from {} to {}",
                least[0], greatest[0], least[1], greatest[1], least[2], greatest[2]
            );
            let remedy = "Say axes = \"x y z\" (the file's axis for forward, port and up) in a TOML file of the same name beside it";
            problems.error("E351", FilePosition::FILE, message, remedy);
            return None;
        }
    };
    let across = frame[1].0;
    if !symmetric(across) && is_nearly([across, frame[2].0]) {
        let message = format!(
            "{} runs from {} to {}: the body is not symmetric about the centreplane, and is taken as it is",
            names[across], least[across], greatest[across]
        );
        problems.warning("W320", FilePosition::FILE, message, "");
    }
    if frame.map(|(axis, _)| axis) != [0, 1, 2] {
        let written = frame.map(|(axis, sign)| format!("{}{}", if sign < 0.0 { "-" } else { "" }, names[axis]));
        let message = format!("axes are taken as \"{}\" by the extents of the body", written.join(" "));
        problems.warning("W320", FilePosition::FILE, message, "");
    }
    Some(frame)
}
