//! Legacy files of VTK (Kitware, file formats of VTK, 2023), versions 1 to 5.1, as text or as bytes, the most significant
//! first: POLYDATA (polygons and strips of triangles) and UNSTRUCTURED_GRID (faces among its cells).

use std::fmt::Write as _;

use super::super::fault::RecordFault;
use super::cells::{Cell, Cells};
use super::numbers::{Coding, Kind, Numbers};
use super::polygons::Polygons;
use super::title;
use crate::hull::{HullMesh, Region, TriangleMesh};

/// Names of kinds of numbers.
const KINDS: [(&str, Kind); 14] = [
    ("char", Kind::Signed(1)),
    ("unsigned_char", Kind::Unsigned(1)),
    ("short", Kind::Signed(2)),
    ("unsigned_short", Kind::Unsigned(2)),
    ("int", Kind::Signed(4)),
    ("unsigned_int", Kind::Unsigned(4)),
    ("long", Kind::Signed(8)),
    ("unsigned_long", Kind::Unsigned(8)),
    ("vtkIdType", Kind::Signed(4)),
    ("vtktypeint32", Kind::Signed(4)),
    ("vtktypeint64", Kind::Signed(8)),
    ("vtktypeuint64", Kind::Unsigned(8)),
    ("float", Kind::Real(4)),
    ("double", Kind::Real(8)),
];

/// What a list of the data set is.
const FACES: &str = "POLYGONS";
const STRIPS: &str = "TRIANGLE_STRIPS";
const CELLS: &str = "CELLS";

/// Whether these are the bytes of a legacy file of VTK.
pub(in super::super) fn is_vtk(bytes: &[u8]) -> bool {
    bytes.starts_with(b"# vtk DataFile")
}

/// Reads a legacy file of VTK, in its own units and axes.
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super) fn read_vtk(bytes: &[u8]) -> Result<TriangleMesh, Vec<RecordFault>> {
    let mut file = File { numbers: Numbers::of(bytes), mesh: Polygons::default(), cells: Cells::default() };
    let _ = file.read();
    file.cells.finish(&mut file.numbers.faults);
    file.mesh.finish(file.numbers.faults)
}

struct File<'a> {
    numbers: Numbers<'a>,
    mesh: Polygons,
    cells: Cells,
}

impl File<'_> {
    fn kind(&mut self, name: &str) -> Option<Kind> {
        let kind = KINDS.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|(_, kind)| *kind);
        if kind.is_none() {
            self.numbers.fault(name, "no kind of numbers that is read");
        }
        kind
    }

    fn read(&mut self) -> Option<()> {
        let version = self.numbers.rest_of_line()?.split_whitespace().last()?.to_owned();
        let has_offsets = version.parse::<f64>().is_ok_and(|version| version >= 5.0);
        self.numbers.rest_of_line()?;
        let coding = match self.numbers.rest_of_line()? {
            "ASCII" => Coding::Text,
            "BINARY" => Coding::BigEndian,
            other => return self.numbers.fault(other, "expected ASCII or BINARY"),
        };
        let mut lists = Vec::new();
        let mut kinds = Vec::new();
        while let Some(line) = self.numbers.rest_of_line() {
            let words: Vec<&str> = line.split_whitespace().collect();
            match words[..] {
                ["DATASET", "POLYDATA" | "UNSTRUCTURED_GRID"] => {}
                ["DATASET", other] => return self.numbers.fault(other, "expected POLYDATA or UNSTRUCTURED_GRID"),
                // Between blank lines.
                ["METADATA"] => while self.numbers.rest_of_line().is_some_and(|line| !line.is_empty()) {},
                ["POINTS", count, kind] => {
                    let (count, kind) = (self.count(count)?, self.kind(kind)?);
                    self.points(count, kind, coding)?;
                }
                [name @ (FACES | STRIPS | CELLS | "LINES" | "VERTICES"), first, second] => {
                    let (first, second) = (self.count(first)?, self.count(second)?);
                    let list = if has_offsets {
                        self.by_offsets(first, second, coding)?
                    } else {
                        self.counted(first, second, coding)?
                    };
                    lists.push((name.to_owned(), list));
                }
                ["CELL_TYPES", count] => {
                    let count = self.count(count)?;
                    kinds = self.numbers(count, Kind::Signed(4), coding)?;
                }
                ["POINT_DATA" | "CELL_DATA", ..] => break,
                // What a file says of all of it.
                ["FIELD", _, count] => self.pass_fields(count, coding)?,
                _ => {}
            }
        }
        for (name, list) in lists {
            if name == CELLS && kinds.len() != list.len() {
                let message = format!("{} kinds of {} cells", kinds.len(), list.len());
                return self.numbers.fault("CELL_TYPES", &message);
            }
            for (k, nodes) in list.iter().enumerate() {
                let number = match name.as_str() {
                    FACES => 7,
                    STRIPS => 6,
                    CELLS => kinds[k],
                    _ => 0,
                };
                let (mesh, faults) = (&mut self.mesh, &mut self.numbers.faults);
                let goes_on = match (Cell::of_vtk(number), number) {
                    (Cell::Face, 22 | 23 | 28) => self.cells.curved(nodes, mesh, faults),
                    (kind, _) => self.cells.add((kind, number), nodes, mesh, faults),
                };
                if !goes_on {
                    return None;
                }
            }
        }
        Some(())
    }

    /// Passes over the arrays of a field: each has its name, components, tuples and kind in a line before its values.
    fn pass_fields(&mut self, count: &str, coding: Coding) -> Option<()> {
        for _ in 0..self.count(count)? {
            let line = loop {
                match self.numbers.rest_of_line()? {
                    "" => {}
                    line => break line,
                }
            };
            let [_, components, tuples, kind] = line.split_whitespace().collect::<Vec<_>>()[..] else {
                return self.numbers.fault(line, "expected name, components, tuples and kind of an array");
            };
            let values = self.count(components)?.saturating_mul(self.count(tuples)?);
            let kind = self.kind(kind)?;
            let width = if coding == Coding::Text { 2 } else { kind.bytes() };
            if !self.numbers.holds(values, width, "values") {
                return None;
            }
            self.numbers.coding = coding;
            let passed = (0..values).try_for_each(|_| self.numbers.skip(kind, "a value of a field"));
            self.numbers.coding = Coding::Text;
            passed?;
        }
        Some(())
    }

    fn count(&mut self, word: &str) -> Option<usize> {
        let count = word.parse().ok();
        if count.is_none() {
            self.numbers.fault(word, "expected a whole number");
        }
        count
    }

    fn points(&mut self, count: usize, kind: Kind, coding: Coding) -> Option<()> {
        let width = if coding == Coding::Text { 2 } else { kind.bytes() };
        if !self.numbers.holds(count, 3 * width, "points") {
            return None;
        }
        self.numbers.coding = coding;
        for k in 0..count {
            let point = self.numbers.point(kind, &format!("point {} of {count}", k + 1))?;
            self.mesh.vertices.push(point);
        }
        self.numbers.coding = Coding::Text;
        Some(())
    }

    /// Whole numbers of a kind.
    fn numbers(&mut self, count: usize, kind: Kind, coding: Coding) -> Option<Vec<usize>> {
        let width = if coding == Coding::Text { 2 } else { kind.bytes() };
        if !self.numbers.holds(count, width, "numbers") {
            return None;
        }
        self.numbers.coding = coding;
        let list = (0..count).map(|_| self.numbers.whole(kind, "the number of a point or kind")).collect();
        self.numbers.coding = Coding::Text;
        list
    }

    /// Cells, each with the number of its points before them.
    fn counted(&mut self, count: usize, size: usize, coding: Coding) -> Option<Vec<Vec<usize>>> {
        let all = self.numbers(size, Kind::Signed(4), coding)?;
        let (mut rest, mut list) = (&all[..], Vec::new());
        for _ in 0..count {
            let cell = rest.split_first().and_then(|(long, rest)| rest.split_at_checked(*long));
            let Some((nodes, after)) = cell else {
                self.numbers.fault(&size.to_string(), "fewer numbers than the cells need");
                return None;
            };
            list.push(nodes.to_vec());
            rest = after;
        }
        Some(list)
    }

    /// Cells by the places where each ends among all their points.
    fn by_offsets(&mut self, offsets: usize, size: usize, coding: Coding) -> Option<Vec<Vec<usize>>> {
        let mut lists = [Vec::new(), Vec::new()];
        for (list, (name, count)) in lists.iter_mut().zip([("OFFSETS", offsets), ("CONNECTIVITY", size)]) {
            let line = loop {
                match self.numbers.rest_of_line() {
                    Some("") => {}
                    line => break line.unwrap_or_default(),
                }
            };
            let kind = match line.split_whitespace().collect::<Vec<_>>()[..] {
                [found, kind] if found == name => self.kind(kind)?,
                _ => {
                    self.numbers.fault(line, &format!("expected {name} and the kind of its numbers"));
                    return None;
                }
            };
            *list = self.numbers(count, kind, coding)?;
        }
        let [offsets, nodes] = lists;
        let cells: Option<_> =
            offsets.windows(2).map(|ends| nodes.get(ends[0]..ends[1]).map(<[usize]>::to_vec)).collect();
        if cells.is_none() {
            self.numbers.fault("OFFSETS", "a cell that ends before it begins, or after the last of the points");
        }
        cells
    }
}

/// The number of a region in files, from 0.
fn number(region: Region) -> usize {
    Region::ALL.iter().position(|other| *other == region).unwrap_or(0)
}

/// Text of a legacy file of VTK, in the unit of the mesh; x forward, y to port, z up. The number of its region stands
/// with each triangle.
#[must_use]
pub fn write_vtk(mesh: &HullMesh, name: &str) -> String {
    let mut text = format!("# vtk DataFile Version 3.0\n{}\nASCII\nDATASET POLYDATA\n", title(name));
    let _ = writeln!(text, "POINTS {} double", mesh.vertices.len());
    for [x, y, z] in &mesh.vertices {
        let _ = writeln!(text, "{x} {y} {z}");
    }
    let count = mesh.triangles.len();
    let _ = writeln!(text, "POLYGONS {count} {}", 4 * count);
    for (_, [a, b, c]) in &mesh.triangles {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    let _ = writeln!(text, "CELL_DATA {count}\nSCALARS region int 1\nLOOKUP_TABLE default");
    for (region, _) in &mesh.triangles {
        let _ = writeln!(text, "{}", number(*region));
    }
    text
}
