//! Control nets of FREE!ship and DELFTship: the project files `.ftm` (text) and `.fbm` (binary), of the same records in
//! the same order.
//!
//! Name `FREE!ship`, version, precision; how the program shows the model; the project (name, designer, length, breadth,
//! draught, ..., units, comment, preview); layers; points; edges; control curves; faces; then what does not concern the
//! body (stations, buttocks, waterlines, diagonals, markers, estimates of resistance), which is not read. Records come
//! and go with versions ([`Version`]). x forward, y to port, z up; metres, or feet where the project says so. Layers
//! that are symmetric hold one side.

mod fbm;
mod ftm;

pub(super) use fbm::{is_fbm, read_fbm};
pub use ftm::write_ftm;
pub(super) use ftm::{is_ftm, read_ftm};

use super::fault::{Faults, LARGEST, RecordFault};
use super::table::{TableProblem, body_faults};
use crate::hull::{NetEdge, NetFace, NetLayer, NetPointKind, StatedParticulars, SubdivisionNet};

/// More points, edges or faces than this are of no net drawn by hand.
const MOST: usize = 200_000;

/// Corners of a face.
const MOST_CORNERS: usize = 200;

/// A foot \[m\].
const FOOT: f64 = 0.3048;

/// A project: its net, in its own unit, and what it states.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SubdivisionProject {
    /// Its name.
    pub name: String,
    /// Length, breadth and draught \[m\], where the project has set them.
    pub stated: StatedParticulars,
    /// The unit of the net \[m\]: 1 or 0.3048.
    pub unit: f64,
    /// The net.
    pub net: SubdivisionNet,
}

/// Reads a project of FREE!ship, text or binary; none when the bytes are neither.
///
/// # Errors
/// The record that cannot be read (E350).
pub fn read_subdivision(name: &str, bytes: &[u8]) -> Option<Result<SubdivisionProject, Vec<TableProblem>>> {
    let read = if is_fbm(bytes) {
        read_fbm(bytes)
    } else if is_ftm(bytes) {
        read_ftm(bytes)
    } else {
        return None;
    };
    Some(read.map_err(|faults| body_faults(name, faults)))
}

/// Versions at which records change, in the order of their numbers in binary files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Version(usize);

/// The names of the versions; a binary file has the place in this list.
const VERSIONS: [&str; 45] = [
    "1.0", "1.1", "1.2", "1.3", "1.4", "1.5", "1.6", "1.65", "1.7", "1.8", "1.9", "1.91", "1.95", "1.98", "2.0",
    "2.01", "2.1", "2.2", "2.3", "2.4", "2.5", "2.6", "2.7+", "2.8+", "2.94+", "2.95+", "2.96+", "2.97+", "2.98+",
    "3.0+", "3.02+", "3.03+", "3.08+", "3.09+", "3.10+", "3.13+", "3.14+", "3.17+", "3.27+", "3.32+", "3.35+", "4.21+",
    "4.30+", "4.62+", "5.0+",
];

impl Version {
    const V160: Self = Self(6);
    const V165: Self = Self(7);
    const V180: Self = Self(9);
    const V191: Self = Self(11);
    const V195: Self = Self(12);
    const V198: Self = Self(13);
    const V201: Self = Self(15);
    const V210: Self = Self(16);
    const V220: Self = Self(17);
    const V230: Self = Self(18);
    const V250: Self = Self(20);
    const V260: Self = Self(21);
    const V317: Self = Self(37);
    const V332: Self = Self(39);
    const V500: Self = Self(44);
}

/// The records of a file in turn; none ends the reading, with a fault told.
trait Records {
    fn version(&mut self, faults: &mut Faults) -> Option<Version>;
    fn integer(&mut self, what: &str, faults: &mut Faults) -> Option<i64>;
    fn number(&mut self, what: &str, faults: &mut Faults) -> Option<f64>;
    fn boolean(&mut self, what: &str, faults: &mut Faults) -> Option<bool>;
    fn text(&mut self, what: &str, faults: &mut Faults) -> Option<String>;
    fn point(&mut self, what: &str, faults: &mut Faults) -> Option<[f64; 3]>;
    /// The bytes of a picture, passed over.
    fn picture(&mut self, size: usize, faults: &mut Faults) -> Option<()>;
    /// Records that may follow at most, so that a count is not believed that the file cannot hold.
    fn left(&self) -> usize;
    /// The line of the record read last, where the file has lines.
    fn line(&self) -> Option<usize>;

    fn count(&mut self, what: &str, most: usize, faults: &mut Faults) -> Option<usize> {
        let count = self.integer(what, faults)?;
        let found = usize::try_from(count).ok().filter(|&n| n <= most && n <= self.left());
        if found.is_none() {
            let message = format!("{what}: {count}; expected 0 to {}, and no more than follow", most.min(self.left()));
            faults.add(self.line(), &count.to_string(), message);
        }
        found
    }

    fn pass(&mut self, booleans: usize, what: &str, faults: &mut Faults) -> Option<()> {
        (0..booleans).try_for_each(|_| self.boolean(what, faults).map(drop))
    }

    fn pass_numbers(&mut self, numbers: usize, what: &str, faults: &mut Faults) -> Option<()> {
        (0..numbers).try_for_each(|_| self.number(what, faults).map(drop))
    }

    /// A place in a list of `count`; -1, which the program writes for what it has lost, is 0.
    fn place(&mut self, what: &str, count: usize, faults: &mut Faults) -> Option<usize> {
        let found = self.integer(what, faults)?;
        let place = usize::try_from(found.max(if found == -1 { 0 } else { found })).ok().filter(|&k| k < count);
        if place.is_none() {
            faults.add(self.line(), &found.to_string(), format!("{what}: {found}, expected 0 to {}", count.max(1) - 1));
        }
        place
    }
}

/// Reads the records.
fn project(records: &mut impl Records) -> Result<SubdivisionProject, Vec<RecordFault>> {
    let mut faults = Faults::default();
    let read = whole(records, &mut faults);
    if read.is_none() && faults.list.is_empty() {
        faults.add(None, "", "the file cannot be read".to_owned());
    }
    faults.or(|| read.unwrap_or_default())
}

fn whole(records: &mut impl Records, faults: &mut Faults) -> Option<SubdivisionProject> {
    let name = records.text("the name of the format", faults)?;
    if name != "FREE!ship" {
        faults.add(records.line(), &name, "the first record is not FREE!ship".to_owned());
        return None;
    }
    let version = records.version(faults)?;
    records.integer("the precision", faults)?;
    shown(records, version, faults)?;
    let (name, stated, unit) = particulars(records, version, faults)?;
    let net = net(records, version, faults)?;
    Some(SubdivisionProject { name, stated, unit, net })
}

/// How the program shows the model.
fn shown(records: &mut impl Records, version: Version, faults: &mut Faults) -> Option<()> {
    let what = "what is shown of the model";
    records.integer(what, faults)?;
    records.pass(10, what, faults)?;
    records.number("the scale of curvature", faults)?;
    if version >= Version::V195 {
        records.pass(1, what, faults)?;
    }
    if version >= Version::V210 {
        records.number("the step of the cursor", faults)?;
    }
    if version >= Version::V220 {
        records.pass(6, what, faults)?;
    }
    if version >= Version::V250 {
        records.pass(1, what, faults)?;
    }
    Some(())
}

/// The project: its name, what it states \[m\], its unit \[m\].
fn particulars(
    records: &mut impl Records,
    version: Version,
    faults: &mut Faults,
) -> Option<(String, StatedParticulars, f64)> {
    let name = records.text("the name of the project", faults)?;
    records.text("the designer", faults)?;
    let mut main = [0.0; 3];
    for (slot, what) in main.iter_mut().zip(["the length", "the breadth", "the draught"]) {
        *slot = records.number(what, faults)?;
    }
    let set = records.boolean("whether the main particulars are set", faults)?;
    records.pass_numbers(2, "density and appendages", faults)?;
    records.pass(1, "the shade under water", faults)?;
    records.integer("the colour under water", faults)?;
    let unit = match records.integer("the units (0 metric, 1 imperial)", faults)? {
        1 => FOOT,
        _ => 1.0,
    };
    if version >= Version::V160 {
        records.boolean("the section that splits the body plan", faults)?;
        records.number("the section that splits the body plan", faults)?;
    }
    if version >= Version::V165 {
        records.boolean("the check of the model", faults)?;
    }
    records.text("the comment", faults)?;
    records.text("who made the file", faults)?;
    if version >= Version::V210 {
        records.integer("what coefficients refer to", faults)?;
        if records.boolean("whether there is a preview", faults)? {
            records.integer("the width of the preview", faults)?;
            records.integer("the height of the preview", faults)?;
            let size = records.integer("the size of the preview", faults)?;
            records.picture(usize::try_from(size).unwrap_or(0), faults)?;
        }
    }
    if version >= Version::V230 {
        records.boolean("whether sections are made simpler", faults)?;
    }
    if version >= Version::V250 {
        records.pass_numbers(4, "draughts and trim", faults)?;
        let displacements = records.count("the number of displacements", MOST, faults)?;
        records.pass_numbers(displacements + 3, "a displacement", faults)?;
        records.boolean("whether displacements go by a step", faults)?;
        for what in ["the number of angles", "the number of trims"] {
            let count = records.count(what, MOST, faults)?;
            records.pass_numbers(count, what, faults)?;
        }
        records.boolean("whether trim is free", faults)?;
        records.number("the centre of gravity", faults)?;
    }
    if version >= Version::V317 {
        records.boolean("whether the model moves", faults)?;
    }
    if version >= Version::V332 {
        records.boolean("whether Bonjean curves are shown", faults)?;
    }
    if version >= Version::V500 {
        records.integer("the transparency under water", faults)?;
    }
    let [length, breadth, draught] = main.map(|value| Some(unit * value).filter(|&l| set && l > 0.0 && l < LARGEST));
    let stated = StatedParticulars { length_between_perpendiculars: length, breadth, draught, depth: None };
    Some((name, stated, unit))
}

fn net(records: &mut impl Records, version: Version, faults: &mut Faults) -> Option<SubdivisionNet> {
    let mut net = SubdivisionNet::default();
    for _ in 0..records.count("the number of layers", 10_000, faults)? {
        net.layers.push(layer(records, version, faults)?);
    }
    records.integer("the active layer", faults)?;
    for _ in 0..records.count("the number of points", MOST, faults)? {
        let point = records.point("a point of the net", faults)?;
        let kind = records.place("the kind of a point (0 regular, 1 crease, 2 dart, 3 corner)", 4, faults)?;
        records.boolean("whether a point is selected", faults)?;
        if version >= Version::V198 {
            records.boolean("whether a point is locked", faults)?;
        }
        net.points.push((point, NetPointKind::ALL[kind]));
    }
    let points = net.points.len();
    for _ in 0..records.count("the number of edges", MOST, faults)? {
        let mut ends = [0; 2];
        for end in &mut ends {
            *end = records.place("a point of an edge", points, faults)?;
        }
        let crease = records.boolean("whether an edge is a crease", faults)?;
        records.boolean("whether an edge is selected", faults)?;
        net.edges.push(NetEdge { ends, crease });
    }
    if version >= Version::V195 {
        for _ in 0..records.count("the number of control curves", MOST, faults)? {
            for _ in 0..records.count("the number of points of a control curve", MOST, faults)? {
                records.place("a point of a control curve", points, faults)?;
            }
            records.boolean("whether a control curve is selected", faults)?;
        }
    }
    let layers = net.layers.len();
    for k in 0..records.count("the number of faces", MOST, faults)? {
        let count = records.count("the number of corners of a face", MOST_CORNERS, faults)?;
        let mut corners = Vec::with_capacity(count);
        for _ in 0..count {
            corners.push(records.place("a corner of a face", points, faults)?);
        }
        let line = records.line();
        // A layer that is not there is the first.
        let layer = records.integer("the layer of a face", faults)?;
        records.boolean("whether a face is selected", faults)?;
        let mut sorted = corners.clone();
        sorted.sort_unstable();
        sorted.dedup();
        if sorted.len() != corners.len() || corners.len() < 3 {
            let message = format!("face {} has {} corners, {} of them different", k + 1, corners.len(), sorted.len());
            faults.add(line, &format!("{corners:?}"), message);
            return None;
        }
        net.faces.push(NetFace { corners, layer: usize::try_from(layer).ok().filter(|&k| k < layers).unwrap_or(0) });
    }
    if net.faces.is_empty() {
        faults.add(records.line(), "", "the net has no faces".to_owned());
        return None;
    }
    Some(net)
}

fn layer(records: &mut impl Records, version: Version, faults: &mut Faults) -> Option<NetLayer> {
    let name = records.text("the name of a layer", faults)?;
    records.integer("the number of a layer", faults)?;
    let colour = records.integer("the colour of a layer", faults)?;
    records.boolean("whether a layer is shown", faults)?;
    let symmetric = records.boolean("whether a layer is symmetric", faults)?;
    records.boolean("whether a layer is developable", faults)?;
    let mut in_hydrostatics = true;
    if version >= Version::V180 {
        records.boolean("whether a layer is cut", faults)?;
        in_hydrostatics = records.boolean("whether a layer displaces water", faults)?;
    }
    if version >= Version::V191 {
        records.pass_numbers(2, "density and thickness of a layer", faults)?;
    }
    if version >= Version::V201 {
        records.boolean("whether a layer is in the lines plan", faults)?;
    }
    if version >= Version::V260 {
        records.integer("the transparency of a layer", faults)?;
    }
    let colour = u32::try_from(colour & 0xFF_FFFF).unwrap_or(0);
    Some(NetLayer { name, colour, symmetric, in_hydrostatics })
}

#[cfg(test)]
mod tests;
