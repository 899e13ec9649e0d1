//! Codes of chunks and classes, and an archive that is being written.

/// Bit of the codes of chunks that hold their value instead of a length.
pub(super) const SHORT: u32 = 0x8000_0000;

/// Bit of the codes of chunks that end with a CRC-32 of what is in them and in no chunk inside them.
pub(super) const CRC: u32 = 0x8000;

/// Codes of chunks.
pub(super) mod code {
    pub(in super::super) const COMMENT: u32 = 0x0000_0001;
    pub(in super::super) const END_OF_FILE: u32 = 0x0000_7fff;
    pub(in super::super) const ANONYMOUS: u32 = 0x4000_8000;
    pub(in super::super) const COMPONENT: u32 = 0x4000_8002;
    pub(in super::super) const END_OF_TABLE: u32 = 0xffff_ffff;
    pub(in super::super) const MATERIALS: u32 = 0x1000_0010;
    pub(in super::super) const LAYERS: u32 = 0x1000_0011;
    pub(in super::super) const LIGHTS: u32 = 0x1000_0012;
    pub(in super::super) const OBJECTS: u32 = 0x1000_0013;
    pub(in super::super) const PROPERTIES: u32 = 0x1000_0014;
    pub(in super::super) const SETTINGS: u32 = 0x1000_0015;
    pub(in super::super) const BITMAPS: u32 = 0x1000_0016;
    pub(in super::super) const GROUPS: u32 = 0x1000_0018;
    pub(in super::super) const FONTS: u32 = 0x1000_0019;
    pub(in super::super) const DIMENSION_STYLES: u32 = 0x1000_0020;
    pub(in super::super) const DEFINITIONS: u32 = 0x1000_0021;
    pub(in super::super) const HATCH_PATTERNS: u32 = 0x1000_0022;
    pub(in super::super) const LINE_TYPES: u32 = 0x1000_0023;
    pub(in super::super) const TEXTURE_MAPPINGS: u32 = 0x1000_0025;
    pub(in super::super) const HISTORY: u32 = 0x1000_0026;
    pub(in super::super) const TOOLKIT: u32 = 0xa000_0026;
    pub(in super::super) const UNITS: u32 = 0x2000_8031;
    pub(in super::super) const LAYER: u32 = 0x2000_8050;
    pub(in super::super) const DEFINITION: u32 = 0x2000_8076;
    pub(in super::super) const OBJECT: u32 = 0x2000_8070;
    pub(in super::super) const OBJECT_KIND: u32 = 0x8200_0071;
    pub(in super::super) const OBJECT_ATTRIBUTES: u32 = 0x0200_8072;
    pub(in super::super) const OBJECT_END: u32 = 0x8200_007f;
    pub(in super::super) const CLASS: u32 = 0x0002_7ffa;
    pub(in super::super) const CLASS_ID: u32 = 0x0002_fffb;
    pub(in super::super) const CLASS_DATA: u32 = 0x0002_fffc;
    pub(in super::super) const USER_DATA: u32 = 0x0002_7ffd;
    pub(in super::super) const USER_DATA_HEADER: u32 = 0x0002_fff9;
    pub(in super::super) const CLASS_END: u32 = 0x8002_7fff;
}

/// The bytes of the identifier of a class in a file: the first three of its five groups with the least byte first.
const fn id(a: u32, b: u16, c: u16, d: [u8; 8]) -> [u8; 16] {
    let ([a0, a1, a2, a3], [b0, b1], [c0, c1]) = (a.to_le_bytes(), b.to_le_bytes(), c.to_le_bytes());
    [a0, a1, a2, a3, b0, b1, c0, c1, d[0], d[1], d[2], d[3], d[4], d[5], d[6], d[7]]
}

/// Last groups of the identifiers of the oldest classes.
const OLD: [u8; 8] = [0xbf, 0xe5, 0x00, 0x10, 0x83, 0x01, 0x22, 0xf0];

/// Identifiers of classes.
pub(super) mod class {
    use super::{OLD, id};
    pub(in super::super) const LAYER: [u8; 16] = id(0x9580_9813, 0xe985, 0x11d3, OLD);
    pub(in super::super) const BREP: [u8; 16] =
        id(0x60b5_dbc5, 0xe660, 0x11d3, [0xbf, 0xe4, 0x00, 0x10, 0x83, 0x01, 0x22, 0xf0]);
    pub(in super::super) const LINE_CURVE: [u8; 16] = id(0x4ed7_d4db, 0xe947, 0x11d3, OLD);
    pub(in super::super) const NURBS_CURVE: [u8; 16] = id(0x4ed7_d4dd, 0xe947, 0x11d3, OLD);
    pub(in super::super) const NURBS_SURFACE: [u8; 16] = id(0x4ed7_d4de, 0xe947, 0x11d3, OLD);
    pub(in super::super) const PLANE_SURFACE: [u8; 16] = id(0x4ed7_d4df, 0xe947, 0x11d3, OLD);
    pub(in super::super) const POLY_CURVE: [u8; 16] = id(0x4ed7_d4e0, 0xe947, 0x11d3, OLD);
    pub(in super::super) const MESH: [u8; 16] = id(0x4ed7_d4e4, 0xe947, 0x11d3, OLD);
    pub(in super::super) const POLYLINE_CURVE: [u8; 16] = id(0x4ed7_d4e6, 0xe947, 0x11d3, OLD);
    pub(in super::super) const ARC_CURVE: [u8; 16] =
        id(0xcf33_be2a, 0x09b4, 0x11d4, [0xbf, 0xfb, 0x00, 0x10, 0x83, 0x01, 0x22, 0xf0]);
    pub(in super::super) const REVOLVED_SURFACE: [u8; 16] =
        id(0xa162_20d3, 0x163b, 0x11d4, [0x80, 0x00, 0x00, 0x10, 0x83, 0x01, 0x22, 0xf0]);
    pub(in super::super) const SUM_SURFACE: [u8; 16] =
        id(0xc4cd_5359, 0x446d, 0x4690, [0x9f, 0xf5, 0x29, 0x05, 0x97, 0x32, 0x47, 0x2b]);
    pub(in super::super) const EXTRUSION: [u8; 16] =
        id(0x36f5_3175, 0x72b8, 0x4d47, [0xbf, 0x1f, 0xb4, 0xe6, 0xfc, 0x24, 0xf4, 0xb9]);
    /// Vertices of 64 bits beside a mesh of version 5.
    pub(in super::super) const DOUBLE_VERTICES: [u8; 16] =
        id(0x17f2_4e75, 0x21be, 0x4a7b, [0x9f, 0x3d, 0x7f, 0x85, 0x22, 0x52, 0x47, 0xe3]);
}

/// The identifiers that older programs, and Rhino itself, have for classes, each with that of the class.
const OTHER_IDS: [([u8; 16], [u8; 16]); 10] = {
    const FOUR: [u8; 8] = [0x80, 0x00, 0x00, 0x10, 0x83, 0x01, 0x22, 0xf0];
    const FIVE: [u8; 8] = [0xbf, 0xfe, 0x00, 0x10, 0x83, 0x01, 0x22, 0xf0];
    const SIX: [u8; 8] = [0x80, 0x0e, 0x00, 0x10, 0x83, 0x01, 0x22, 0xf0];
    [
        (id(0x5eaf_1119, 0x0b51, 0x11d4, FIVE), class::NURBS_CURVE),
        (id(0x76a7_09d5, 0x1550, 0x11d4, FOUR), class::NURBS_CURVE),
        (id(0x4760_c817, 0x0be3, 0x11d4, FIVE), class::NURBS_SURFACE),
        (id(0xfa4f_d4b5, 0x1613, 0x11d4, FOUR), class::NURBS_SURFACE),
        (id(0xef63_8317, 0x154b, 0x11d4, FOUR), class::POLY_CURVE),
        (id(0x0705_fdef, 0x3e2a, 0x11d4, SIX), class::BREP),
        (id(0x2d4c_fedb, 0x3e2a, 0x11d4, SIX), class::BREP),
        (id(0xf06f_c243, 0xa32a, 0x4608, [0x9d, 0xd8, 0xa7, 0xd2, 0xc4, 0xce, 0x2a, 0x36]), class::BREP),
        (id(0x0a84_01b6, 0x4d34, 0x4b99, [0x86, 0x15, 0x1b, 0x4e, 0x72, 0x3d, 0xc4, 0xe5]), class::REVOLVED_SURFACE),
        (id(0x665f_6331, 0x2a66, 0x4cce, [0x81, 0xd0, 0xb5, 0xee, 0xbd, 0x9b, 0x54, 0x17]), class::SUM_SURFACE),
    ]
};

/// The identifier of a class by any that it has.
pub(super) fn class_of(id: [u8; 16]) -> [u8; 16] {
    OTHER_IDS.iter().find(|(other, _)| *other == id).map_or(id, |(_, class)| *class)
}

/// Remainders of the CRC-32 of ISO 3309 for each byte.
const REMAINDERS: [u32; 256] = {
    let mut table = [0; 256];
    let mut k = 0;
    while k < 256 {
        let (mut value, mut bit) = (k as u32, 0);
        while bit < 8 {
            value = if value & 1 == 1 { 0xedb8_8320 ^ (value >> 1) } else { value >> 1 };
            bit += 1;
        }
        table[k] = value;
        k += 1;
    }
    table
};

/// CRC-32 of ISO 3309 of bytes that follow others with the CRC `before`; 0 of none.
pub(super) fn crc(before: u32, bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!before, |value, &byte| REMAINDERS[((value ^ u32::from(byte)) & 0xff) as usize] ^ (value >> 8))
}

/// A chunk that has begun.
struct Open {
    /// Where its contents begin.
    start: usize,
    /// The CRC so far, where it ends with one.
    crc: Option<u32>,
}

/// An archive whose chunks have lengths of 8 bytes.
#[derive(Default)]
pub(super) struct Archive {
    bytes: Vec<u8>,
    open: Vec<Open>,
}

impl Archive {
    /// Adds bytes to the innermost chunk that has begun.
    pub(super) fn put(&mut self, bytes: &[u8]) {
        self.bytes.extend(bytes);
        if let Some(Open { crc: Some(value), .. }) = self.open.last_mut() {
            *value = crc(*value, bytes);
        }
    }

    pub(super) fn byte(&mut self, value: u8) {
        self.put(&[value]);
    }

    pub(super) fn int(&mut self, value: i32) {
        self.put(&value.to_le_bytes());
    }

    /// A number of things, or the index of one; files with more than 2^31 of them cannot be written.
    pub(super) fn count(&mut self, value: usize) {
        self.int(i32::try_from(value).unwrap_or(i32::MAX));
    }

    pub(super) fn reals(&mut self, values: &[f64]) {
        values.iter().for_each(|value| self.put(&(value + 0.0).to_le_bytes()));
    }

    /// A text as UTF-16 with a 0 behind it.
    pub(super) fn text(&mut self, text: &str) {
        let units: Vec<u16> = text.encode_utf16().filter(|unit| *unit != 0).collect();
        self.count(if units.is_empty() { 0 } else { units.len() + 1 });
        if !units.is_empty() {
            units.iter().chain(&[0]).for_each(|unit| self.put(&unit.to_le_bytes()));
        }
    }

    /// A list of indices with its length.
    pub(super) fn indices(&mut self, list: &[usize]) {
        self.count(list.len());
        list.iter().for_each(|&index| self.count(index));
    }

    /// A chunk with a value instead of contents.
    pub(super) fn short(&mut self, code: u32, value: i64) {
        self.bytes.extend(code.to_le_bytes());
        self.bytes.extend(value.to_le_bytes());
    }

    /// A chunk with what is put into it.
    pub(super) fn chunk(&mut self, code: u32, contents: impl FnOnce(&mut Self)) {
        self.bytes.extend(code.to_le_bytes());
        self.bytes.extend([0; 8]);
        self.open.push(Open { start: self.bytes.len(), crc: (code & CRC != 0).then_some(0) });
        contents(self);
        let Some(Open { start, crc }) = self.open.pop() else { return };
        if let Some(value) = crc {
            self.bytes.extend(value.to_le_bytes());
        }
        let length = (self.bytes.len() - start) as u64;
        self.bytes[start - 8..start].copy_from_slice(&length.to_le_bytes());
    }

    /// A table of records.
    pub(super) fn table(&mut self, code: u32, records: impl FnOnce(&mut Self)) {
        self.chunk(code, |archive| {
            records(archive);
            archive.short(code::END_OF_TABLE, 0);
        });
    }

    /// An object of a class with its data.
    pub(super) fn object(&mut self, class: [u8; 16], data: impl FnOnce(&mut Self)) {
        self.chunk(code::CLASS, |archive| {
            archive.chunk(code::CLASS_ID, |archive| archive.put(&class));
            archive.chunk(code::CLASS_DATA, data);
            archive.short(code::CLASS_END, 0);
        });
    }

    /// The bytes with the mark of the end of the file, which has their length.
    pub(super) fn finish(mut self) -> Vec<u8> {
        let length = (self.bytes.len() + 20) as u64;
        self.chunk(code::END_OF_FILE, |archive| archive.put(&length.to_le_bytes()));
        self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_crc_of_the_standard() {
        assert_eq!(crc(0, b"123456789"), 0xcbf4_3926);
        assert_eq!(crc(crc(0, b"1234"), b"56789"), 0xcbf4_3926);
    }
}
