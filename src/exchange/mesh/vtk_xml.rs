//! VTP and VTU of VTK (Kitware, file formats of VTK, 2023): XML with arrays as text, in base 64, or behind the elements, as
//! they are or packed by zlib.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use roxmltree::{Document, Node, ParsingOptions};
use std::io::Read as _;

use super::super::fault::{Faults, LARGEST, RecordFault};
use super::MOST_TRIANGLES;
use super::cells::{Cell, Cells};
use super::numbers::Kind;
use super::polygons::Polygons;
use crate::hull::TriangleMesh;

/// Names of kinds of numbers.
const KINDS: [(&str, Kind); 10] = [
    ("Int8", Kind::Signed(1)),
    ("UInt8", Kind::Unsigned(1)),
    ("Int16", Kind::Signed(2)),
    ("UInt16", Kind::Unsigned(2)),
    ("Int32", Kind::Signed(4)),
    ("UInt32", Kind::Unsigned(4)),
    ("Int64", Kind::Signed(8)),
    ("UInt64", Kind::Unsigned(8)),
    ("Float32", Kind::Real(4)),
    ("Float64", Kind::Real(8)),
];

/// What begins the arrays behind the elements.
const APPENDED: &[u8] = b"<AppendedData";

/// Numbers of an array, at most.
const MOST_NUMBERS: usize = 16 * MOST_TRIANGLES;

/// Whether these are the bytes of a VTP or VTU file, or of another of their family.
pub(in super::super) fn is_vtk_xml(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(2000)];
    String::from_utf8_lossy(start).trim_start().starts_with('<') && start.windows(8).any(|part| part == b"<VTKFile")
}

/// Reads a VTP or VTU file, in its own units and axes.
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super) fn read_vtk_xml(bytes: &[u8]) -> Result<TriangleMesh, Vec<RecordFault>> {
    let (mut faults, mut mesh, mut cells) = (Faults::default(), Polygons::default(), Cells::default());
    if let Err(message) = read(bytes, &mut mesh, &mut cells, &mut faults) {
        faults.add(None, "", message);
    }
    cells.finish(&mut faults);
    mesh.finish(faults)
}

/// What the arrays of a file are written by.
struct Arrays<'a> {
    /// The bytes behind the elements.
    appended: &'a [u8],
    /// Whether these are in base 64.
    encoded: bool,
    big_endian: bool,
    /// The numbers before an array.
    header: Kind,
    packed: bool,
}

fn read(bytes: &[u8], mesh: &mut Polygons, cells: &mut Cells, faults: &mut Faults) -> Result<(), String> {
    // Arrays as they are behind the elements are no XML.
    let cut = bytes.windows(APPENDED.len()).position(|part| part == APPENDED);
    let (elements, rest) = bytes.split_at(cut.unwrap_or(bytes.len()));
    let mut text = String::from_utf8_lossy(elements).into_owned();
    if cut.is_some() {
        text.push_str("</VTKFile>");
    }
    let options = ParsingOptions { nodes_limit: 1 << 20, ..ParsingOptions::default() };
    let document = Document::parse_with_options(&text, options).map_err(|error| format!("no XML: {error}"))?;
    let root = document.root_element();
    let heading_ends = rest.iter().position(|byte| *byte == b'>').map_or(0, |at| at + 1);
    let (heading, rest) = rest.split_at(heading_ends);
    let begins = rest.iter().position(|byte| *byte == b'_').map_or(rest.len(), |at| at + 1);
    let packed = match root.attribute("compressor") {
        None => false,
        Some("vtkZLibDataCompressor") => true,
        Some(other) => return Err(format!("arrays packed by {other} are not read; write the file as text")),
    };
    let arrays = Arrays {
        appended: &rest[begins..],
        encoded: String::from_utf8_lossy(heading).contains("base64"),
        big_endian: root.attribute("byte_order") == Some("BigEndian"),
        header: if root.attribute("header_type") == Some("UInt64") { Kind::Unsigned(8) } else { Kind::Unsigned(4) },
        packed,
    };
    let name = root.attribute("type").unwrap_or_default();
    if !["PolyData", "UnstructuredGrid"].contains(&name) {
        return Err(format!("a file of {name}; expected PolyData (VTP) or UnstructuredGrid (VTU)"));
    }
    let pieces = child(root, name).ok_or_else(|| format!("no element {name}"))?;
    for piece in pieces.children().filter(|node| node.has_tag_name("Piece")) {
        let first = mesh.vertices.len();
        let points =
            child(piece, "Points").and_then(|points| child(points, "DataArray")).ok_or("a piece without points")?;
        let coordinates = arrays.numbers(points)?;
        if points.attribute("NumberOfComponents") != Some("3")
            || !coordinates.iter().all(|value| value.abs() <= LARGEST)
        {
            return Err("points need three numbers each, of at most 1e8".to_owned());
        }
        if mesh.vertices.len() + coordinates.len() / 3 > MOST_NUMBERS {
            return Err(format!("more than {MOST_NUMBERS} points"));
        }
        mesh.vertices.extend(coordinates.chunks_exact(3).map(|p| [p[0], p[1], p[2]]));
        for (list, number) in [("Polys", 7), ("Strips", 6), ("Cells", 0)] {
            let Some(list) = child(piece, list) else { continue };
            let array = |name: &str| {
                let found = list.children().find(|node| node.attribute("Name") == Some(name));
                found.map_or(Ok(Vec::new()), |node| arrays.whole(node, name))
            };
            let (nodes, ends) = (array("connectivity")?, array("offsets")?);
            let kinds = if number == 0 { array("types")? } else { vec![number; ends.len()] };
            if kinds.len() != ends.len() {
                return Err(format!("{} types of {} cells", kinds.len(), ends.len()));
            }
            let mut from = 0;
            for (end, number) in ends.into_iter().zip(kinds) {
                let cell =
                    nodes.get(from..end).ok_or("a cell that ends before it begins, or after the last of the points")?;
                from = end;
                let cell: Vec<usize> = cell.iter().map(|node| first.saturating_add(*node)).collect();
                let goes_on = match (Cell::of_vtk(number), number) {
                    (Cell::Face, 22 | 23 | 28) => cells.curved(&cell, mesh, faults),
                    (kind, _) => cells.add((kind, number), &cell, mesh, faults),
                };
                if !goes_on {
                    return Ok(());
                }
            }
        }
    }
    Ok(())
}

fn child<'a, 'b>(node: Node<'a, 'b>, name: &str) -> Option<Node<'a, 'b>> {
    node.children().find(|node| node.has_tag_name(name))
}

impl Arrays<'_> {
    /// Whole numbers that are not negative.
    fn whole(&self, array: Node<'_, '_>, name: &str) -> Result<Vec<usize>, String> {
        let to_whole = |value: f64| (value >= 0.0 && value.fract() == 0.0).then_some(value as usize);
        let list: Option<Vec<usize>> = self.numbers(array)?.into_iter().map(to_whole).collect();
        list.ok_or_else(|| format!("{name}: expected whole numbers"))
    }

    fn numbers(&self, array: Node<'_, '_>) -> Result<Vec<f64>, String> {
        let name = array.attribute("Name").unwrap_or("points");
        let kind = array.attribute("type").unwrap_or_default();
        let kind = KINDS.iter().find(|(known, _)| *known == kind).map(|(_, kind)| *kind);
        let kind = kind.ok_or_else(|| format!("{name}: no kind of numbers that is read"))?;
        let text = array.text().unwrap_or_default();
        let most = kind.bytes() * MOST_NUMBERS;
        let bytes = match array.attribute("format").unwrap_or("ascii") {
            "ascii" => {
                let list: Result<Vec<f64>, _> = text.split_ascii_whitespace().map(str::parse).collect();
                return list.map_err(|_| format!("{name}: expected numbers"));
            }
            "binary" => self.encoded(text.trim().as_bytes(), most),
            "appended" => {
                let offset = array.attribute("offset").and_then(|offset| offset.parse().ok());
                let from = offset.and_then(|offset: usize| self.appended.get(offset..));
                from.and_then(|from| if self.encoded { self.encoded(from, most) } else { self.plain(from, most) })
            }
            _ => None,
        };
        let bytes = bytes.ok_or_else(|| format!("{name}: its bytes are not in the file, or are damaged"))?;
        Ok(bytes.chunks_exact(kind.bytes()).map(|bytes| self.value(kind, bytes)).collect())
    }

    fn value(&self, kind: Kind, bytes: &[u8]) -> f64 {
        let mut eight = [0; 8];
        let eight = &mut eight[..bytes.len()];
        eight.copy_from_slice(bytes);
        if self.big_endian {
            eight.reverse();
        }
        kind.value(eight)
    }

    /// The whole numbers before an array: one, its bytes; of a packed one the number of its blocks, their size and that
    /// of the last, and the packed size of each.
    fn header(&self, bytes: &[u8]) -> Option<Vec<usize>> {
        let width = self.header.bytes();
        let number = |k: usize| {
            let found = bytes.get(k * width..(k + 1) * width)?;
            Some(self.value(self.header, found) as usize)
        };
        let count = if self.packed { number(0)?.checked_add(3).filter(|count| *count <= bytes.len())? } else { 1 };
        (0..count).map(number).collect()
    }

    /// The bytes of an array behind its header, both as they are.
    fn plain(&self, bytes: &[u8], most: usize) -> Option<Vec<u8>> {
        let header = self.header(bytes)?;
        self.unpacked(&header, bytes.get(header.len() * self.header.bytes()..)?, most)
    }

    /// The bytes of an array in base 64. The header of a packed one is encoded by itself.
    fn encoded(&self, text: &[u8], most: usize) -> Option<Vec<u8>> {
        let long = |bytes: usize| bytes.div_ceil(3).checked_mul(4);
        let decoded = |from: usize, bytes: usize| {
            let part = text.get(from..from.checked_add(long(bytes)?)?)?;
            STANDARD.decode(part).ok().filter(|found| found.len() == bytes)
        };
        let width = self.header.bytes();
        let first = STANDARD.decode(text.get(..long(width)?)?).ok()?;
        if !self.packed {
            let size = self.header(&first)?[0];
            // The length may be encoded by itself, and then ends in a sign that fills it up.
            if text.get(..long(width)?)?.ends_with(b"=") && !width.is_multiple_of(3) && first.len() == width {
                return decoded(long(width)?, size).filter(|bytes| bytes.len() <= most);
            }
            return decoded(0, size.checked_add(width)?).map(|mut bytes| bytes.split_off(width));
        }
        let blocks = self.value(self.header, first.get(..width)?) as usize;
        let size = blocks.checked_add(3)?.checked_mul(width)?;
        let header = self.header(&decoded(0, size)?)?;
        let packed = header[3..].iter().try_fold(0_usize, |sum, size| sum.checked_add(*size))?;
        self.unpacked(&header, &decoded(long(size)?, packed)?, most)
    }

    fn unpacked(&self, header: &[usize], bytes: &[u8], most: usize) -> Option<Vec<u8>> {
        if !self.packed {
            return bytes.get(..header[0]).map(<[u8]>::to_vec);
        }
        let (mut rest, mut all) = (bytes, Vec::new());
        for size in &header[3..] {
            let (block, after) = rest.split_at_checked(*size)?;
            let room = most.checked_sub(all.len())?;
            ZlibDecoder::new(block).take(room as u64 + 1).read_to_end(&mut all).ok()?;
            rest = after;
        }
        (all.len() <= most).then_some(all)
    }
}
