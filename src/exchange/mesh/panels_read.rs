//! Reading of panels, in the units and axes of their files: GDF (WAMIT), PNL (HAMS), meshes of NEMOH. Numbers are read
//! as words whatever the lines; a panel of four different corners becomes two triangles from its first. What the
//! plane of symmetry x = 0 mirrors is added. Where y = 0 is one, the half that is given is read: whoever reads bodies mirrors it.

use super::super::fault::{Faults, RecordFault};
use super::MOST_TRIANGLES;
use super::numbers::{DOUBLE, Numbers};
use crate::hull::TriangleMesh;

/// The acceleration of gravity in feet [ft/s^2].
const FEET: std::ops::RangeInclusive<f64> = 31.5..=32.8;

/// A body that reaches further to both sides, over its breadth, is none of which one side is given.
const BOTH_SIDES: f64 = 1e-2;

/// The triangles of a panel with corners in turn, from the first of these, as its volume is reckoned on the page of
/// `export`.
fn triangles([a, b, c, d]: [[f64; 3]; 4]) -> [[[f64; 3]; 3]; 2] {
    [[a, b, c], [a, c, d]]
}

/// Whether a number of a file is the flag 1.
fn is_one(number: f64) -> bool {
    (number - 1.0).abs() < f64::EPSILON
}

/// Panels as triangles, in the axes of their formats: x forward, y to port, z up.
pub(in super::super) struct PanelBody {
    /// What the file gives, and what the plane x = 0 mirrors.
    pub mesh: TriangleMesh,
    /// Whether y = 0 is a plane of symmetry: one side is given.
    pub is_half: bool,
    /// Metres in the unit of the file.
    pub unit: f64,
}

/// The body of corners and the planes of symmetry, x = 0 and y = 0.
pub(super) fn body(
    mut faults: Faults,
    corners: Vec<[[f64; 3]; 3]>,
    [along, across]: [bool; 2],
) -> Result<PanelBody, Vec<RecordFault>> {
    let other_end = corners.iter().filter(|_| along).map(|&[a, b, c]| [a, c, b].map(|[x, y, z]| [0.0 - x, y, z]));
    let mesh = TriangleMesh::from_corners(corners.iter().copied().chain(other_end));
    if mesh.triangles.is_empty() && faults.list.is_empty() {
        faults.add(None, "", "no panels".to_owned());
    }
    let [below, above] = mesh.bounds().map_or([0.0; 2], |[least, greatest]| [least[1], greatest[1]]);
    if across && -below > BOTH_SIDES * (above - below) && above > BOTH_SIDES * (above - below) {
        let message = format!("y = 0 is a plane of symmetry, and panels are on both sides: y from {below} to {above}");
        faults.add(None, "", message);
    }
    faults.or(|| PanelBody { mesh, is_half: across, unit: 1.0 })
}

pub(super) fn too_many(count: usize, faults: &mut Faults) -> bool {
    let over = count > MOST_TRIANGLES / 2;
    if over {
        faults.add(None, "", format!("{count} panels or nodes; at most {} are read", MOST_TRIANGLES / 2));
    }
    over
}

/// Reads a GDF file of low order: a title, ULEN and GRAV, ISX and ISY, the number of panels, and the corners of each.
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super) fn read_gdf(bytes: &[u8]) -> Result<PanelBody, Vec<RecordFault>> {
    let mut words = Numbers::of(bytes);
    // The title.
    words.rest_of_line();
    let mut corners = Vec::new();
    let (mut planes, mut unit) = ([false; 2], 1.0);
    let mut header = |words: &mut Numbers<'_>| -> Option<usize> {
        for what in [["ULEN", "GRAV"], ["ISX", "ISY"]] {
            let line = words.line();
            let numbers = [words.number(what[0])?, words.number(what[1])?];
            if what[1] == "GRAV" && FEET.contains(&numbers[1]) {
                unit = 0.3048;
            }
            planes = numbers.map(is_one);
            // Names may follow the numbers.
            words.next_line(line);
        }
        let line = words.line();
        let count = words.count("the number of panels")?;
        words.next_line(line);
        Some(count)
    };
    if let Some(count) = header(&mut words).filter(|count| !too_many(*count, &mut words.faults)) {
        for k in 0..count {
            let mut panel = [[0.0; 3]; 4];
            let what = format!("a corner of panel {} of {count}", k + 1);
            for corner in &mut panel {
                let Some(point) = words.point(DOUBLE, &what) else { return body(words.faults, Vec::new(), planes) };
                *corner = point;
            }
            corners.extend(triangles(panel));
        }
    }
    body(words.faults, corners, planes).map(|body| PanelBody { unit, ..body })
}

/// Whether this is the beginning of panels of WAMIT: a title, then two numbers, the second an acceleration of gravity, then
/// two flags, then a count.
pub(in super::super) fn is_gdf(bytes: &[u8]) -> bool {
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(1000)]).into_owned();
    let mut lines = start
        .lines()
        .skip(1)
        .map(|line| line.split_whitespace().map_while(|word| word.parse::<f64>().ok()).take(2).collect::<Vec<f64>>());
    let Some(((first, second), third)) = lines.next().zip(lines.next()).zip(lines.next()) else { return false };
    let is_gravity = |g: f64| (9.7..=9.9).contains(&g) || FEET.contains(&g);
    let is_flag = |n: &f64| n.abs() < f64::EPSILON || (n - 1.0).abs() < f64::EPSILON;
    first.len() == 2
        && first[0] > 0.0
        && is_gravity(first[1])
        && second.len() == 2
        && second.iter().all(is_flag)
        && third.first().is_some_and(|count| *count >= 1.0 && count.fract() <= 0.0)
}

/// The triangles of a panel by the numbers of its nodes, from 1; none, with a fault, when there is no such node.
pub(super) fn quadrilateral(
    numbers: [usize; 4],
    nodes: &[[f64; 3]],
    line: Option<usize>,
    faults: &mut Faults,
) -> Option<[[[f64; 3]; 3]; 2]> {
    let mut panel = [[0.0; 3]; 4];
    for (corner, number) in panel.iter_mut().zip(numbers) {
        let Some(node) = number.checked_sub(1).and_then(|k| nodes.get(k)) else {
            faults.add(line, &number.to_string(), format!("no node; there are {}", nodes.len()));
            return None;
        };
        *corner = *node;
    }
    Some(triangles(panel))
}

/// Whether this is the beginning of a mesh of NEMOH, whose files have several endings: 2 and 0 or 1 on the first line, node 1
/// and its three coordinates on the second.
pub(in super::super) fn is_nemoh(bytes: &[u8]) -> bool {
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(500)]).into_owned();
    let mut lines = start.lines().map(|line| line.split_whitespace().collect::<Vec<&str>>());
    let Some((first, second)) = lines.next().zip(lines.next()) else { return false };
    let are_coordinates = |words: &[&str]| words.iter().all(|word| word.parse::<f64>().is_ok());
    matches!(first[..], ["2", "0" | "1"])
        && second.len() == 4
        && second[0].parse::<f64>().is_ok_and(is_one)
        && are_coordinates(&second[1..])
}

/// Reads a mesh of NEMOH: two numbers, nodes with their numbers up to a line of zeros, four corners of each panel up to
/// another or to the end of the file. A line of zeros may have any number of them.
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super) fn read_nemoh(bytes: &[u8]) -> Result<PanelBody, Vec<RecordFault>> {
    let mut words = Numbers::of(bytes);
    let (mut nodes, mut corners) = (Vec::new(), Vec::new());
    let first = words.line();
    let (dimension, plane) = (words.number("2"), words.number("0 or 1 for the plane of symmetry"));
    let planes = [false, plane.is_some_and(is_one)];
    if dimension.and(plane).is_none() {
        return body(words.faults, corners, planes);
    }
    words.next_line(first);
    loop {
        let line = words.line();
        let Some(number) = words.count("the number of a node, or 0") else {
            return body(words.faults, corners, planes);
        };
        if number == 0 {
            words.next_line(line);
            break;
        }
        let Some(point) = words.point(DOUBLE, "a coordinate") else { return body(words.faults, corners, planes) };
        nodes.push(point);
        if too_many(nodes.len(), &mut words.faults) {
            return body(words.faults, corners, planes);
        }
    }
    loop {
        if words.is_at_end() {
            return body(words.faults, corners, planes);
        }
        let line = words.line();
        let mut numbers = [0; 4];
        for (k, number) in numbers.iter_mut().enumerate() {
            let found = words.count("the number of a corner, or 0");
            let Some(found) = found.filter(|found| k > 0 || *found > 0) else {
                return body(words.faults, corners, planes);
            };
            *number = found;
        }
        let Some(panel) = quadrilateral(numbers, &nodes, Some(line), &mut words.faults) else {
            return body(words.faults, corners, planes);
        };
        corners.extend(panel);
        if too_many(corners.len() / 2, &mut words.faults) {
            return body(words.faults, corners, planes);
        }
    }
}

/// Reads a PNL file: numbers of panels and nodes and two symmetries, nodes with their numbers, and panels with theirs,
/// the number of their corners and those.
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super) fn read_pnl(bytes: &[u8]) -> Result<PanelBody, Vec<RecordFault>> {
    let text = String::from_utf8_lossy(bytes);
    // Headings are lines of dashes.
    let said: String =
        text.lines().map(|line| if line.contains("--") { "\n".to_owned() } else { format!("{line}\n") }).collect();
    let mut words = Numbers::of(said.as_bytes());
    let mut corners = Vec::new();
    let header = [(); 4].map(|()| words.count("the numbers of panels and nodes and the symmetries"));
    let planes = [header[2], header[3]].map(|plane| plane == Some(1));
    let [Some(panels), Some(count), Some(_), Some(_)] = header else { return body(words.faults, corners, planes) };
    if too_many(panels.max(count), &mut words.faults) {
        return body(words.faults, corners, planes);
    }
    let mut nodes = Vec::new();
    for k in 0..count {
        let what = format!("node {} of {count}", k + 1);
        let (Some(_), Some(point)) = (words.count(&what), words.point(DOUBLE, &what)) else {
            return body(words.faults, corners, planes);
        };
        nodes.push(point);
    }
    for k in 0..panels {
        let (line, what) = (words.line(), format!("panel {} of {panels}", k + 1));
        let (Some(_), Some(sides)) = (words.count(&what), words.count(&what)) else {
            return body(words.faults, corners, planes);
        };
        if !(3..=4).contains(&sides) {
            words.faults.add(Some(line), &sides.to_string(), "expected 3 or 4 corners".to_owned());
            return body(words.faults, corners, planes);
        }
        let mut numbers = [0; 4];
        for number in numbers.iter_mut().take(sides) {
            let Some(found) = words.count(&what) else { return body(words.faults, corners, planes) };
            *number = found;
        }
        if sides == 3 {
            numbers[3] = numbers[2];
        }
        let Some(panel) = quadrilateral(numbers, &nodes, Some(line), &mut words.faults) else {
            return body(words.faults, corners, planes);
        };
        corners.extend(panel);
    }
    body(words.faults, corners, planes)
}
