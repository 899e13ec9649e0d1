//! The triangles over the surfaces and the faces of a CAD file.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::super::super::cad::{CadSurfaces, Unread, is_closed, whole};
use super::super::problem::{FilePosition, Problems};
use super::super::settings::{PartChoice, Settings};
use super::SEAM;
use super::frame::{Given, framed};
use crate::hull::{Brep, FaceSurface, TriangleMesh};
use crate::spline::{BsplineSurface, dot, length, minus};
use crate::units::counted;

/// What triangles leave surfaces by at most, over the longest extent of these.
const DEVIATION: f64 = 1e-5;

/// What triangles leave faces inside loops by at most, over the longest extent of the body; the two meshes are
/// extrapolated.
const FACE_DEVIATION: f64 = 3e-5;

/// More triangles than this are made fewer by a deviation that is doubled.
const ENOUGH: usize = 150_000;

/// Volumes of nested meshes differ by at most so many deviations times the area of the skin, and this part of them: chords over few
/// spans of a surface that bends sharply. What the meshes are extrapolated to is off by a third of it at most.
const NESTED: f64 = 4.0;
const ALIKE_VOLUMES: f64 = 5e-3;

/// Control points nearer to each other than this part of the size are one.
const ALIKE: f64 = 1e-6;

/// Most surfaces at one place that are compared with another.
const MOST_AT_PLACE: usize = 64;

/// Most surfaces whose sides are compared.
const MOST_COMPARED: usize = 300;

/// Spaces between points of a side of a surface; every second point is looked for on other sides.
const SPACES: usize = 32;

/// The body of a CAD file in the ship's frame, what it leaves the surfaces by at most \[m\], and whether it is of surfaces each
/// for itself; none, with problems, when it cannot be read whole.
pub(super) fn meshes(
    read: CadSurfaces,
    kind: &str,
    settings: &Settings,
    problems: &mut Problems,
) -> (Vec<TriangleMesh>, f64, bool) {
    let CadSurfaces { mut surfaces, unit, notes, mut body, mut unread, .. } = read;
    let unit = unit.unwrap_or(1.0);
    notes.into_iter().for_each(|note| problems.warning("W352", FilePosition::FILE, note, ""));
    if surfaces.iter().any(is_closed) {
        // A ball is closed by its seam, which faces have.
        for spline in surfaces.drain(..) {
            let ends = [spline.u(), spline.v()].map(|knots| knots.domain().into());
            if whole(&FaceSurface::Spline(spline), ends, "of B-splines", &mut body).is_none() {
                unread.push(Unread { why: "nothing bounds it".to_owned(), ..Unread::default() });
            }
        }
    }
    let faces = body.faces.len() + unread.len();
    if faces > 0 {
        match body.whole_surfaces().filter(|_| unread.is_empty()) {
            Some(whole) => surfaces.extend(whole),
            None => {
                let (meshes, deviation) = of_faces(&body, &mut unread, (kind, unit), settings, problems);
                return (meshes, deviation, false);
            }
        }
    }
    if let Some(shells) = closed_shells(&surfaces) {
        let (meshes, deviation) = of_shells(shells, &surfaces, (kind, unit), settings, problems);
        return (meshes, deviation, false);
    }
    // Whole surfaces need no sewing. Where their meshes do not enclose one volume, edges that are sewn may.
    let mut of_whole = problems.clone();
    let (meshes, deviation) = of_surfaces(surfaces, (kind, unit), settings, &mut of_whole);
    if faces > 0 && of_whole.any_errors() && !problems.any_errors() {
        let mut sewn = problems.clone();
        let (meshes, deviation) = of_faces(&body, &mut unread, (kind, unit), settings, &mut sewn);
        if !sewn.any_errors() {
            *problems = sewn;
            return (meshes, deviation, false);
        }
    }
    *problems = of_whole;
    (meshes, deviation, true)
}

/// Faces inside their loops, in two nested meshes.
fn of_faces(
    body: &Brep,
    unread: &mut Vec<Unread>,
    (kind, unit): (&str, f64),
    settings: &Settings,
    problems: &mut Problems,
) -> (Vec<TriangleMesh>, f64) {
    let faces = body.faces.len() + unread.len();
    let edges = body.edges.len();
    problems.note(format!("a body ({kind}) of {faces} faces, {edges} edges; the unit of the file is {unit} m"));
    let made = body.triangulated(FACE_DEVIATION, ENOUGH);
    unread.extend(made.faults.iter().map(|fault| {
        let face = &body.faces[fault.face];
        Unread { line: None, name: face.name.clone(), kind: face.kind.clone(), why: fault.why.to_owned() }
    }));
    if let Some(first) = unread.first() {
        let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
        unread.iter().for_each(|face| *kinds.entry(&face.kind).or_default() += 1);
        let kinds: Vec<String> = kinds.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        let message = format!(
            "{} of {} cannot be read ({}), and without them the body is not whole: {}",
            unread.len(),
            counted(faces, "face"),
            kinds.join(", "),
            first.why
        );
        let place = first.line.map_or(FilePosition::FILE, FilePosition::row);
        problems.error(
            "E352",
            (place, first.name.as_str()),
            message,
            "Convert these faces to B-splines where the file comes from, or give a mesh",
        );
        return (Vec::new(), 0.0);
    }
    in_frame(made.meshes, made.deviation, &Given::plain(unit), settings, problems)
}

/// Surfaces in turn as two closed shells or more, each as two nested meshes turned outward, where the file gives shell after
/// shell and their triangles meet edge to edge. So a wall that two of them have in common belongs to both.
fn closed_shells(surfaces: &[BsplineSurface<4>]) -> Option<Vec<[TriangleMesh; 2]>> {
    if surfaces.len() > MOST_COMPARED {
        return None;
    }
    let deviation = DEVIATION * extent(surfaces);
    let (mut shells, mut own): (Vec<_>, [Vec<_>; 2]) = (Vec::new(), [Vec::new(), Vec::new()]);
    for surface in surfaces {
        let (nested, _) = TriangleMesh::nested(std::slice::from_ref(surface), deviation, ENOUGH).ok()?;
        own.iter_mut().zip(&nested).for_each(|(corners, mesh)| corners.extend(mesh.corners()));
        if TriangleMesh::from_corners(own[0].iter().copied()).odd_edges() == 0 {
            let whole = std::mem::take(&mut own);
            shells.push(whole.map(|corners| TriangleMesh::from_corners(corners.into_iter()).oriented().0));
        }
    }
    (own[0].is_empty() && shells.len() > 1).then_some(shells)
}

/// Closed shells of whole surfaces as solids, in two nested meshes.
fn of_shells(
    shells: Vec<[TriangleMesh; 2]>,
    surfaces: &[BsplineSurface<4>],
    (kind, unit): (&str, f64),
    settings: &Settings,
    problems: &mut Problems,
) -> (Vec<TriangleMesh>, f64) {
    problems.note(format!(
        "{} surfaces ({kind}) in {} closed shells, untrimmed; the unit of the file is {unit} m",
        surfaces.len(),
        shells.len()
    ));
    let all = |k: usize| TriangleMesh::from_corners(shells.iter().flat_map(|nested| nested[k].corners()));
    in_frame([all(0), all(1)], DEVIATION * extent(surfaces), &Given::plain(unit), settings, problems)
}

/// Whole surfaces, in two nested meshes.
fn of_surfaces(
    surfaces: Vec<BsplineSurface<4>>,
    (kind, unit): (&str, f64),
    settings: &Settings,
    problems: &mut Problems,
) -> (Vec<TriangleMesh>, f64) {
    let choice = settings.frame.parts.as_deref().unwrap_or_default();
    if choice.iter().any(|part| matches!(part, PartChoice::Number(_))) {
        let message = "parts: surfaces that nothing trims have no numbers".to_owned();
        let remedy = "Name layers of a 3DM file, or leave out the numbers";
        problems.error("E311", FilePosition::FILE, message, remedy);
        return (Vec::new(), 0.0);
    }
    let [single, twins] = without_doubles(surfaces);
    let doubles = twins.len();
    let walls = || [single.as_slice(), &twins].concat();
    let open = |surfaces: &[BsplineSurface<4>]| {
        let nested = TriangleMesh::nested(surfaces, DEVIATION * extent(surfaces), ENOUGH);
        nested.map_or(usize::MAX, |([coarse, _], _)| coarse.odd_edges())
    };
    // A wall that two bodies have in common belongs to each of them: without one of it edges are open.
    let is_shared = (1..single.len()).contains(&doubles) && open(&walls()) == 0 && open(&single) > 0;
    if is_shared {
        let message = format!(
            "{} twice where bodies have a wall in common, and untrimmed surfaces do not tell whose it is",
            if doubles == 1 { "1 surface stands".to_owned() } else { format!("{doubles} surfaces stand") }
        );
        let remedy =
            "Choose the layers of one body with --parts, or give the bodies as solids (STEP, IGES) or as a mesh";
        problems.error("E354", FilePosition::FILE, message, remedy);
        return (Vec::new(), 0.0);
    }
    let surfaces = single;
    if doubles > 0 {
        let message = format!("{} given twice: counted once", counted(doubles, "surface"));
        problems.warning("W320", FilePosition::FILE, message, "");
    }
    let surfaces = &surfaces[..];
    warn_of_sheets(surfaces, kind, problems);
    let points = surfaces.iter().map(|surface| surface.points().len()).sum::<usize>();
    problems.note(format!(
        "{} surfaces ({kind}) of {points} control points, untrimmed; the unit of the file is {unit} m",
        surfaces.len()
    ));
    match TriangleMesh::nested(surfaces, DEVIATION * extent(surfaces), ENOUGH) {
        Ok((nested, deviation)) => {
            let given = Given { surfaces: true, ..Given::plain(unit) };
            in_frame(nested, deviation, &given, settings, problems)
        }
        Err(count) => {
            let message = format!(
                "the surfaces bend so often that {count} triangles would not follow them, expected at most {}",
                4 * ENOUGH
            );
            problems.error("E350", FilePosition::FILE, message, "Give the surfaces of the hull alone, or a mesh");
            (Vec::new(), 0.0)
        }
    }
}

/// Two nested meshes in the ship's frame, and what they leave the surfaces by, `deviation` in units of the file \[m\].
fn in_frame(
    nested: [TriangleMesh; 2],
    deviation: f64,
    given: &Given,
    settings: &Settings,
    problems: &mut Problems,
) -> (Vec<TriangleMesh>, f64) {
    let deviation = deviation * given.metres(settings);
    problems.note(format!("within {deviation:.1e} m of them: {} triangles", nested[1].triangles.len()));
    let meshes = framed(nested.to_vec(), settings, given, problems);
    agree(&meshes, deviation, problems);
    (meshes, deviation)
}

/// Refuses nested meshes of which parts were left out or united in one and not in the other: they enclose what differs by more
/// than their deviation \[m\] over their skin.
pub(super) fn agree(meshes: &[TriangleMesh], deviation: f64, problems: &mut Problems) {
    let [coarse, fine] = meshes else { return };
    let ([first, skin], [second, _]) = (coarse.enclosed_and_skin(), fine.enclosed_and_skin());
    if problems.any_errors() || (first - second).abs() <= NESTED * deviation * skin + ALIKE_VOLUMES * second.abs() {
        return;
    }
    let message = format!(
        "two meshes over the same faces enclose {first:.4e} and {second:.4e} m3: what of them is skin is not told alike"
    );
    let remedy = "Give the outer skin alone, its parts united, or choose parts with --parts";
    problems.error("E354", FilePosition::FILE, message, remedy);
}

/// The longest extent of the control points.
fn extent(surfaces: &[BsplineSurface<4>]) -> f64 {
    let [low, high] = around(surfaces.iter().flat_map(BsplineSurface::points).map(|&point| place(point)));
    (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max)
}

/// The place of a control point or of a point of a rational surface.
fn place([x, y, z, w]: [f64; 4]) -> [f64; 3] {
    [x / w, y / w, z / w]
}

/// The surfaces without those that are given twice, in whatever direction their parameters run, and what was given again, with
/// the parameters of the first.
fn without_doubles(surfaces: Vec<BsplineSurface<4>>) -> [Vec<BsplineSurface<4>>; 2] {
    let slack = (ALIKE * extent(&surfaces)).max(f64::MIN_POSITIVE);
    let (mut kept, mut twins): (Vec<BsplineSurface<4>>, Vec<BsplineSurface<4>>) = (Vec::new(), Vec::new());
    // Means of points that are alike are in the same cell or in neighbours.
    let mut cells: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
    for surface in surfaces {
        let count = surface.points().len() as f64;
        let mean = |k: usize| surface.points().iter().map(|&point| place(point)[k]).sum::<f64>() / count;
        let cell = [0, 1, 2].map(|k| (mean(k) / (4.0 * slack)).floor() as i64);
        let known = (0..27_i64).map(|n| [n % 3, n / 3 % 3, n / 9]).find_map(|step| {
            let near = [0, 1, 2].map(|k: usize| cell[k].saturating_add(step[k] - 1));
            let mut others = cells.get(&near).into_iter().flatten().take(MOST_AT_PLACE);
            others.find(|&&other| are_same(&surface, &kept[other], slack)).copied()
        });
        if let Some(other) = known {
            twins.push(kept[other].clone());
        } else {
            cells.entry(cell).or_default().push(kept.len());
            kept.push(surface);
        }
    }
    [kept, twins]
}

/// Whether two surfaces have the same net, in whatever direction their parameters run.
fn are_same(a: &BsplineSurface<4>, b: &BsplineSurface<4>, slack: f64) -> bool {
    let near = |p: [f64; 4], q: [f64; 4]| {
        length(minus(place(p), place(q))) <= slack && (p[3] - q[3]).abs() <= ALIKE * q[3].abs()
    };
    let alike = |a: &BsplineSurface<4>| {
        let [rows, columns] = a.shape();
        let degrees = |surface: &BsplineSurface<4>| [surface.u().degree(), surface.v().degree()];
        a.shape() == b.shape()
            && degrees(a) == degrees(b)
            && [[false, false], [false, true], [true, false], [true, true]].into_iter().any(|[up, across]| {
                let row = |i: usize| if up { rows - 1 - i } else { i };
                let column = |j: usize| if across { columns - 1 - j } else { j };
                (0..rows).all(|i| (0..columns).all(|j| near(a.point(row(i), column(j)), b.point(i, j))))
            })
    };
    alike(a) || alike(&a.transposed())
}

/// Says of surfaces that share no side with the others that they count as skin.
fn warn_of_sheets(surfaces: &[BsplineSurface<4>], kind: &str, problems: &mut Problems) {
    let remedy = if kind == "3DM" {
        "Put what is no skin on layers of its own, and name the others with --parts"
    } else {
        "Give the surfaces of the skin alone"
    };
    if surfaces.len() > MOST_COMPARED {
        let message = format!("{} surfaces: whether a sheet inside the skin is among them is open", surfaces.len());
        problems.warning("W351", FilePosition::FILE, message, remedy);
        return;
    }
    let groups = groups(surfaces);
    if groups > 1 {
        let message = format!("{groups} groups of surfaces share no side with each other, and all count as skin");
        problems.warning("W351", FilePosition::FILE, message, remedy);
    }
}

/// The sides of a surface as points, and its bounds.
struct Outline {
    sides: [Vec<[f64; 3]>; 4],
    bounds: [[f64; 3]; 2],
}

impl Outline {
    fn new(surface: &BsplineSurface<4>) -> Self {
        let [(u0, u1), (v0, v1)] = [surface.u().domain(), surface.v().domain()];
        let side = |from: [f64; 2], to: [f64; 2]| -> Vec<[f64; 3]> {
            let share = |k: usize| k as f64 / SPACES as f64;
            let at = |t: f64| place(surface.eval(from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])));
            (0..=SPACES).map(|k| at(share(k))).collect()
        };
        let sides =
            [side([u0, v0], [u1, v0]), side([u0, v1], [u1, v1]), side([u0, v0], [u0, v1]), side([u1, v0], [u1, v1])];
        Self { sides, bounds: around(surface.points().iter().map(|&point| place(point))) }
    }

    fn has_near(&self, point: [f64; 3], slack: f64) -> bool {
        let [low, high] = self.bounds;
        (0..3).all(|k| (low[k] - slack..=high[k] + slack).contains(&point[k]))
            && self.sides.iter().any(|side| side.windows(2).any(|ends| off(point, [ends[0], ends[1]]) <= slack))
    }

    /// Whether a stretch of a side of this one lies on the sides of another one.
    fn lies_on(&self, other: &Self, slack: f64) -> bool {
        self.sides.iter().any(|side| {
            let mut shared = side.iter().step_by(2).filter(|&&point| other.has_near(point, slack));
            let Some(first) = shared.next() else { return false };
            shared.any(|point| length(minus(*point, *first)) > 4.0 * slack)
        })
    }

    /// Whether it is level at an end of the body, which it closes even where it is wider: a deck, a transom.
    fn closes(&self, [low, high]: [[f64; 3]; 2], slack: f64) -> bool {
        let [from, to] = self.bounds;
        (0..3).any(|k| to[k] - from[k] <= slack && (from[k] - low[k] <= slack || high[k] - to[k] <= slack))
    }
}

/// The distance of a point from a line between two others.
fn off(point: [f64; 3], [a, b]: [[f64; 3]; 2]) -> f64 {
    let (along, to) = (minus(b, a), minus(point, a));
    let size = dot(along, along);
    let share = if size > 0.0 { (dot(to, along) / size).clamp(0.0, 1.0) } else { 0.0 };
    length(minus(to, along.map(|c| share * c)))
}

/// The bounds of points.
fn around(points: impl Iterator<Item = [f64; 3]>) -> [[f64; 3]; 2] {
    points.fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |[low, high], point| {
        let least = [0, 1, 2].map(|k: usize| low[k].min(point[k]));
        let greatest = [0, 1, 2].map(|k: usize| high[k].max(point[k]));
        [least, greatest]
    })
}

/// How many groups surfaces form by the sides that they share; those alone that close an end of the body are none.
fn groups(surfaces: &[BsplineSurface<4>]) -> usize {
    let slack = SEAM * extent(surfaces);
    let outlines: Vec<Outline> = surfaces.iter().map(Outline::new).collect();
    let mut group: Vec<usize> = (0..outlines.len()).collect();
    for (n, a) in outlines.iter().enumerate() {
        for (m, b) in outlines[..n].iter().enumerate() {
            if group[n] != group[m] && (a.lies_on(b, slack) || b.lies_on(a, slack)) {
                let (from, to) = (group[n], group[m]);
                group.iter_mut().filter(|own| **own == from).for_each(|own| *own = to);
            }
        }
    }
    let body = around(outlines.iter().flat_map(|outline| outline.bounds));
    let counting = outlines.iter().zip(&group).filter(|(outline, _)| !outline.closes(body, slack));
    counting.map(|(_, group)| group).collect::<BTreeSet<_>>().len()
}
