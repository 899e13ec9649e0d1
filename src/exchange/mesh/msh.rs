//! MSH of gmsh (C. Geuzaine, J.-F. Remacle 2009), versions 2 and 4.1, as text or as bytes: its nodes and the faces among its
//! elements. Faces of second order become flat ones between their nodes.

use std::collections::HashMap;
use std::fmt::Write as _;

use super::super::fault::RecordFault;
use super::cells::{Cell, Cells};
use super::numbers::{Coding, DOUBLE, INTEGER, Kind, Numbers};
use super::polygons::Polygons;
use super::regions;
use crate::hull::{HullMesh, TriangleMesh};

/// Nodes of the elements, by their number from 1, and their dimension.
const ELEMENTS: [(usize, usize); 19] = [
    (2, 1),
    (3, 2),
    (4, 2),
    (4, 3),
    (8, 3),
    (6, 3),
    (5, 3),
    (3, 1),
    (6, 2),
    (9, 2),
    (10, 3),
    (27, 3),
    (18, 3),
    (14, 3),
    (1, 0),
    (8, 2),
    (20, 3),
    (15, 3),
    (13, 3),
];

/// Numbers of nodes and of items in files of version 4.1.
const SIZE: Kind = Kind::Unsigned(8);

/// Whether these are the bytes of a file of gmsh.
pub(in super::super) fn is_msh(bytes: &[u8]) -> bool {
    bytes.starts_with(b"$MeshFormat") || bytes.starts_with(b"$Comments")
}

/// Reads a file of gmsh, in its own units and axes.
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super) fn read_msh(bytes: &[u8]) -> Result<TriangleMesh, Vec<RecordFault>> {
    let mut file = File {
        numbers: Numbers::of(bytes),
        coding: Coding::Text,
        places: HashMap::new(),
        mesh: Polygons::default(),
        cells: Cells::default(),
    };
    let _ = file.read();
    file.cells.finish(&mut file.numbers.faults);
    file.mesh.finish(file.numbers.faults)
}

struct File<'a> {
    numbers: Numbers<'a>,
    coding: Coding,
    /// The places of nodes, by their numbers.
    places: HashMap<usize, usize>,
    mesh: Polygons,
    cells: Cells,
}

impl File<'_> {
    fn read(&mut self) -> Option<()> {
        let mut is_new = None;
        while let Some(line) = self.numbers.rest_of_line() {
            let Some(name) = line.strip_prefix('$') else { continue };
            match (name, is_new) {
                ("MeshFormat", _) => is_new = Some(self.format()?),
                ("Nodes", Some(true)) => self.blocks_of_nodes()?,
                ("Nodes", Some(false)) => self.nodes()?,
                ("Elements", Some(true)) => self.blocks_of_elements()?,
                ("Elements", Some(false)) => self.elements()?,
                ("Nodes" | "Elements", None) => return self.numbers.fault(line, "expected $MeshFormat before it"),
                _ => {}
            }
            self.numbers.coding = Coding::Text;
            if !self.numbers.skip_past(&format!("$End{name}")) {
                return self.numbers.fault(line, "the file ends within this part");
            }
        }
        Some(())
    }

    /// Whether the version is 4.1.
    fn format(&mut self) -> Option<bool> {
        let line = self.numbers.rest_of_line().unwrap_or_default();
        let words: Vec<&str> = line.split_whitespace().collect();
        let is_new = match words[..] {
            ["2" | "2.0" | "2.1" | "2.2", _, "8"] => Some(false),
            ["4.1", _, "8"] => Some(true),
            _ => None,
        };
        if is_new.is_none() {
            self.numbers.fault(line, "expected version 2.2 or 4.1, with reals of 8 bytes");
        }
        if words.get(1) == Some(&"1") {
            // The number 1 tells the order of bytes.
            let first = self.numbers.take(4, "the number 1")?;
            self.coding = if first[0] == 1 { Coding::LittleEndian } else { Coding::BigEndian };
        }
        is_new
    }

    /// A number of items on a line of its own, each of some bytes at least.
    fn count(&mut self, bytes: usize, what: &str) -> Option<usize> {
        let line = self.numbers.rest_of_line().unwrap_or_default();
        let Ok(count) = line.parse() else {
            self.numbers.fault(line, &format!("expected the number of {what}"));
            return None;
        };
        self.numbers.holds(count, bytes, what).then_some(count)
    }

    fn node(&mut self, number: usize, point: [f64; 3]) {
        self.places.insert(number, self.mesh.vertices.len());
        self.mesh.vertices.push(point);
    }

    fn nodes(&mut self) -> Option<()> {
        let count = self.count(8, "nodes")?;
        self.numbers.coding = self.coding;
        for k in 0..count {
            let what = format!("node {} of {count}", k + 1);
            let number = self.numbers.whole(INTEGER, &what)?;
            let point = self.numbers.point(DOUBLE, &what)?;
            self.node(number, point);
        }
        Some(())
    }

    fn blocks_of_nodes(&mut self) -> Option<()> {
        self.numbers.coding = self.coding;
        let blocks = self.numbers.whole(SIZE, "the number of blocks of nodes")?;
        (0..3).try_for_each(|_| self.numbers.skip(SIZE, "the number of nodes"))?;
        for _ in 0..blocks {
            let what = "the dimension and the number of an entity, and whether it has parameters";
            let dimension = self.numbers.whole(INTEGER, what)?;
            self.numbers.skip(INTEGER, what)?;
            let parameters = if self.numbers.whole(INTEGER, what)? == 0 { 0 } else { dimension };
            let count = self.numbers.whole(SIZE, "the number of nodes of a block")?;
            if !self.numbers.holds(count, 8, "nodes") {
                return None;
            }
            let numbers: Vec<usize> =
                (0..count).map(|_| self.numbers.whole(SIZE, "the number of a node")).collect::<Option<_>>()?;
            for number in numbers {
                let point = self.numbers.point(DOUBLE, "a coordinate")?;
                (0..parameters).try_for_each(|_| self.numbers.skip(DOUBLE, "a parameter"))?;
                self.node(number, point);
            }
        }
        Some(())
    }

    /// The nodes and the dimension of a kind of element.
    fn kind(&mut self, kind: usize) -> Option<(usize, usize)> {
        let found = kind.checked_sub(1).and_then(|k| ELEMENTS.get(k)).copied();
        if found.is_none() {
            let message = "elements of this kind are not read; write those of first or second order";
            self.numbers.fault(&format!("kind {kind}"), message);
        }
        found
    }

    fn element(&mut self, dimension: usize, nodes: &[usize]) -> Option<()> {
        let (mesh, faults) = (&mut self.mesh, &mut self.numbers.faults);
        if dimension != 2 {
            let kind = if dimension == 3 { Cell::Solid } else { Cell::Less };
            return self.cells.add((kind, 0), nodes, mesh, faults).then_some(());
        }
        let mut places = Vec::with_capacity(nodes.len());
        for node in nodes {
            let Some(place) = self.places.get(node) else {
                return self.numbers.fault(&node.to_string(), "no node of this number");
            };
            places.push(*place);
        }
        self.cells.curved(&places, mesh, faults).then_some(())
    }

    fn elements(&mut self) -> Option<()> {
        let count = self.count(8, "elements")?;
        self.numbers.coding = self.coding;
        let mut read = 0;
        while read < count {
            let what = format!("element {} of {count}", read + 1);
            if self.coding == Coding::Text {
                let line = self.numbers.line_of(0, &what)?;
                let (Some(&kind), Some(&tags)) = (line.get(1), line.get(2)) else {
                    return self.numbers.fault(&what, "expected its number, its kind and the number of its tags");
                };
                let (long, dimension) = self.kind(kind)?;
                let Some(nodes) = line.get(3 + tags..).filter(|nodes| nodes.len() == long) else {
                    return self.numbers.fault(&what, &format!("expected {long} nodes"));
                };
                let nodes = nodes.to_vec();
                self.element(dimension, &nodes)?;
                read += 1;
                continue;
            }
            let [kind, many, tags] = self.three(&what)?;
            let (long, dimension) = self.kind(kind)?;
            if many == 0 || !self.numbers.holds(many, 4 * (1 + long), "elements") {
                return self.numbers.fault(&what, "no elements of a kind");
            }
            for _ in 0..many {
                (0..=tags).try_for_each(|_| self.numbers.skip(INTEGER, &what))?;
                let nodes: Vec<usize> = (0..long).map(|_| self.numbers.whole(INTEGER, &what)).collect::<Option<_>>()?;
                self.element(dimension, &nodes)?;
            }
            read += many;
        }
        Some(())
    }

    fn three(&mut self, what: &str) -> Option<[usize; 3]> {
        let mut next = || self.numbers.whole(INTEGER, what);
        Some([next()?, next()?, next()?])
    }

    fn blocks_of_elements(&mut self) -> Option<()> {
        self.numbers.coding = self.coding;
        let blocks = self.numbers.whole(SIZE, "the number of blocks of elements")?;
        (0..3).try_for_each(|_| self.numbers.skip(SIZE, "the number of elements"))?;
        for _ in 0..blocks {
            let what = "the dimension and the number of an entity, and the kind of its elements";
            self.numbers.skip(INTEGER, what)?;
            self.numbers.skip(INTEGER, what)?;
            let kind = self.numbers.whole(INTEGER, what)?;
            let (long, dimension) = self.kind(kind)?;
            let count = self.numbers.whole(SIZE, "the number of elements of a block")?;
            if !self.numbers.holds(count, 2 * (1 + long), "elements") {
                return None;
            }
            for _ in 0..count {
                self.numbers.skip(SIZE, "the number of an element")?;
                let nodes: Vec<usize> =
                    (0..long).map(|_| self.numbers.whole(SIZE, "the number of a node")).collect::<Option<_>>()?;
                self.element(dimension, &nodes)?;
            }
        }
        Some(())
    }
}

/// Text of a file of gmsh, version 2.2, in the unit of the mesh; x forward, y to port, z up. Each region is a physical
/// group of its name.
#[must_use]
pub fn write_msh(mesh: &HullMesh) -> String {
    let regions = regions(mesh);
    let mut text = String::from("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n");
    let _ = writeln!(text, "{}", regions.len());
    for (k, (region, _)) in regions.iter().enumerate() {
        let _ = writeln!(text, "2 {} \"{}\"", k + 1, region.name());
    }
    let _ = writeln!(text, "$EndPhysicalNames\n$Nodes\n{}", mesh.vertices.len());
    for (k, [x, y, z]) in mesh.vertices.iter().enumerate() {
        let _ = writeln!(text, "{} {x} {y} {z}", k + 1);
    }
    let _ = writeln!(text, "$EndNodes\n$Elements\n{}", mesh.triangles.len());
    let all = regions.iter().enumerate().flat_map(|(k, (_, list))| list.iter().map(move |corners| (k + 1, corners)));
    for (element, (group, [a, b, c])) in all.enumerate() {
        let _ = writeln!(text, "{} 2 2 {group} {group} {} {} {}", element + 1, a + 1, b + 1, c + 1);
    }
    text.push_str("$EndElements\n");
    text
}
