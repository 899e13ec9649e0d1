//! DXF of AutoCAD 2000 (AC1015): every object has a handle and an owner. Flat lines are LWPOLYLINE, lines in space
//! POLYLINE.

use std::fmt::Write as _;

use super::{COLOURS, Scaled, number};

/// Handles of what every drawing has.
const BLOCK_RECORDS: u32 = 0x1;
const LAYERS: u32 = 0x2;
const LINE_TYPES: u32 = 0x5;
const STYLES: u32 = 0x3;
const MODEL_SPACE: u32 = 0x1F;
const PAPER_SPACE: u32 = 0x1B;
const ROOT: u32 = 0xC;
const GROUPS: u32 = 0xD;

/// The first handle that is free.
const FREE: u32 = 0x100;

/// Runs of group codes and values.
struct Groups {
    text: String,
    next: u32,
}

impl Groups {
    fn put(&mut self, code: u16, value: &str) {
        let _ = writeln!(self.text, "{code:>3}\n{value}");
    }

    fn handle(&mut self, code: u16, handle: u32) {
        self.put(code, &format!("{handle:X}"));
    }

    fn fresh(&mut self) -> u32 {
        self.next += 1;
        self.next - 1
    }

    fn pairs(&mut self, pairs: &[(u16, &str)]) {
        pairs.iter().for_each(|(code, value)| self.put(*code, value));
    }

    /// The head of a table.
    fn table(&mut self, name: &str, handle: u32, count: usize) {
        self.pairs(&[(0, "TABLE"), (2, name)]);
        self.handle(5, handle);
        self.pairs(&[(330, "0"), (100, "AcDbSymbolTable"), (70, &count.to_string())]);
    }

    /// The head of a record of a table.
    fn record(&mut self, kind: &str, handle: u32, owner: u32, class: &str, name: &str) {
        self.put(0, kind);
        self.handle(5, handle);
        self.handle(330, owner);
        self.pairs(&[(100, "AcDbSymbolTableRecord"), (100, class), (2, name)]);
    }

    /// The head of an entity.
    fn entity(&mut self, kind: &str, handle: u32, owner: u32, layer: &str) {
        self.put(0, kind);
        self.handle(5, handle);
        self.handle(330, owner);
        self.pairs(&[(100, "AcDbEntity"), (8, layer)]);
    }

    fn point(&mut self, point: &[f64]) {
        for (k, &coordinate) in point.iter().enumerate() {
            self.put(10 * (k as u16 + 1), &number(coordinate));
        }
    }
}

/// Text of a file; `unit` is the number of the unit for insertions, 6 metres, 4 millimetres.
pub(super) fn write(lines: &[Scaled], layers: &[&str], ends: [[f64; 3]; 2], unit: u8) -> String {
    let mut body = Groups { text: String::new(), next: FREE };
    tables(&mut body, layers);
    blocks(&mut body);
    body.pairs(&[(0, "SECTION"), (2, "ENTITIES")]);
    for (layer, points, flat) in lines {
        let handle = body.fresh();
        if *flat {
            body.entity("LWPOLYLINE", handle, MODEL_SPACE, layer);
            body.pairs(&[(100, "AcDbPolyline"), (90, &points.len().to_string()), (70, "0"), (43, "0.0")]);
            points.iter().for_each(|point| body.point(&point[..2]));
            continue;
        }
        body.entity("POLYLINE", handle, MODEL_SPACE, layer);
        body.put(100, "AcDb3dPolyline");
        body.point(&[0.0; 3]);
        body.put(70, "8");
        for point in points {
            let vertex = body.fresh();
            body.entity("VERTEX", vertex, handle, layer);
            body.pairs(&[(100, "AcDbVertex"), (100, "AcDb3dPolylineVertex")]);
            body.point(point);
            body.put(70, "32");
        }
        let end = body.fresh();
        body.entity("SEQEND", end, handle, layer);
    }
    body.put(0, "ENDSEC");
    body.pairs(&[(0, "SECTION"), (2, "OBJECTS"), (0, "DICTIONARY")]);
    body.handle(5, ROOT);
    body.pairs(&[(330, "0"), (100, "AcDbDictionary"), (281, "1"), (3, "ACAD_GROUP")]);
    body.handle(350, GROUPS);
    body.put(0, "DICTIONARY");
    body.handle(5, GROUPS);
    body.handle(330, ROOT);
    body.pairs(&[(100, "AcDbDictionary"), (281, "1"), (0, "ENDSEC"), (0, "EOF")]);
    let mut head = Groups { text: String::new(), next: 0 };
    head.pairs(&[(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1015"), (9, "$HANDSEED")]);
    head.handle(5, body.next);
    head.pairs(&[(9, "$INSUNITS"), (70, &unit.to_string()), (9, "$MEASUREMENT"), (70, "1")]);
    for (name, point) in [("$EXTMIN", ends[0]), ("$EXTMAX", ends[1])] {
        head.put(9, name);
        head.point(&point);
    }
    head.pairs(&[(0, "ENDSEC"), (0, "SECTION"), (2, "CLASSES"), (0, "ENDSEC")]);
    head.text + &body.text
}

fn tables(body: &mut Groups, layers: &[&str]) {
    body.pairs(&[(0, "SECTION"), (2, "TABLES")]);
    body.table("VPORT", 0x8, 0);
    body.put(0, "ENDTAB");
    body.table("LTYPE", LINE_TYPES, 3);
    for (handle, name) in [(0x14, "ByBlock"), (0x15, "ByLayer"), (0x16, "Continuous")] {
        body.record("LTYPE", handle, LINE_TYPES, "AcDbLinetypeTableRecord", name);
        body.pairs(&[(70, "0"), (3, ""), (72, "65"), (73, "0"), (40, "0.0")]);
    }
    body.put(0, "ENDTAB");
    body.table("LAYER", LAYERS, layers.len() + 1);
    for (k, name) in ["0"].iter().chain(layers).enumerate() {
        let handle = body.fresh();
        body.record("LAYER", handle, LAYERS, "AcDbLayerTableRecord", name);
        let colour = if k == 0 { 7 } else { COLOURS[(k - 1) % COLOURS.len()] };
        body.pairs(&[(70, "0"), (62, &colour.to_string()), (6, "Continuous")]);
    }
    body.put(0, "ENDTAB");
    body.table("STYLE", STYLES, 1);
    body.record("STYLE", 0x11, STYLES, "AcDbTextStyleTableRecord", "Standard");
    body.pairs(&[(70, "0"), (40, "0.0"), (41, "1.0"), (50, "0.0"), (71, "0"), (42, "2.5"), (3, "txt"), (4, "")]);
    body.put(0, "ENDTAB");
    for (name, handle) in [("VIEW", 0x6), ("UCS", 0x7)] {
        body.table(name, handle, 0);
        body.put(0, "ENDTAB");
    }
    body.table("APPID", 0x9, 1);
    body.record("APPID", 0x12, 0x9, "AcDbRegAppTableRecord", "ACAD");
    body.pairs(&[(70, "0"), (0, "ENDTAB")]);
    body.table("DIMSTYLE", 0xA, 1);
    body.pairs(&[(100, "AcDbDimStyleTable"), (0, "DIMSTYLE"), (105, "27"), (330, "A")]);
    body.pairs(&[(100, "AcDbSymbolTableRecord"), (100, "AcDbDimStyleTableRecord"), (2, "Standard"), (70, "0")]);
    body.put(0, "ENDTAB");
    body.table("BLOCK_RECORD", BLOCK_RECORDS, 2);
    for (handle, name) in [(MODEL_SPACE, "*Model_Space"), (PAPER_SPACE, "*Paper_Space")] {
        body.record("BLOCK_RECORD", handle, BLOCK_RECORDS, "AcDbBlockTableRecord", name);
    }
    body.pairs(&[(0, "ENDTAB"), (0, "ENDSEC")]);
}

fn blocks(body: &mut Groups) {
    body.pairs(&[(0, "SECTION"), (2, "BLOCKS")]);
    for (owner, name) in [(MODEL_SPACE, "*Model_Space"), (PAPER_SPACE, "*Paper_Space")] {
        let (begin, end) = (body.fresh(), body.fresh());
        body.entity("BLOCK", begin, owner, "0");
        body.pairs(&[(100, "AcDbBlockBegin"), (2, name), (70, "0")]);
        body.point(&[0.0; 3]);
        body.pairs(&[(3, name), (1, "")]);
        body.entity("ENDBLK", end, owner, "0");
        body.put(100, "AcDbBlockEnd");
    }
    body.put(0, "ENDSEC");
}
