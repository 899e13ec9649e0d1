//! DXF: polylines on named layers, in space or flat; of AutoCAD R12 (AC1009), which every program that reads DXF takes,
//! or 2000. Read are texts and binary files of all versions: faces by layers, or curves.

mod curves;
mod expand;
mod faces;
mod groups;
mod r2000;
mod read;
mod unit;

pub(in super::super) use groups::is_dxf;
pub(in super::super) use read::{Drawing, read_dxf};

use std::fmt::Write as _;

use super::CadUnit;

/// A polyline on a layer.
#[derive(Debug, Clone, PartialEq)]
pub struct DxfLine {
    /// Its layer: capitals, digits, `_`, `-`, `$`.
    pub layer: String,
    /// Points \[m\].
    pub points: Vec<[f64; 3]>,
    /// Whether it lies in the plane z = 0 of a drawing.
    pub flat: bool,
}

/// A version of the format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DxfVersion {
    /// AC1009.
    #[default]
    R12,
    /// AC1015.
    R2000,
}

/// The layer of a line, its points in the unit of the file, and whether it is flat.
type Scaled = (String, Vec<[f64; 3]>, bool);

/// A real number, always with a point.
fn number(value: f64) -> String {
    format!("{value:?}")
}

/// Colours of the AutoCAD index that are seen on black and on white, in turn for the layers.
const COLOURS: [u8; 6] = [5, 1, 3, 6, 4, 30];

/// The name of a layer as R12 allows it: at most 31 of its characters.
fn layer(name: &str) -> String {
    let allowed = |c: char| if c.is_ascii_alphanumeric() || "_-$".contains(c) { c.to_ascii_uppercase() } else { '_' };
    name.chars().take(31).map(allowed).collect()
}

/// Text of a DXF file. Points that are finite and lines of two points at least are written.
#[must_use]
pub fn write_dxf(lines: &[DxfLine], unit: CadUnit, version: DxfVersion) -> String {
    let scale = unit.in_a_metre();
    let lines: Vec<Scaled> = lines
        .iter()
        .map(|line| {
            let points = line.points.iter().filter(|p| p.iter().all(|c| c.is_finite()));
            (layer(&line.layer), points.map(|p| p.map(|c| c * scale + 0.0)).collect(), line.flat)
        })
        .filter(|(_, points, _): &Scaled| points.len() > 1)
        .collect();
    let mut layers: Vec<&str> = Vec::new();
    for (name, ..) in &lines {
        if !layers.contains(&name.as_str()) {
            layers.push(name);
        }
    }
    let ends = |pick: fn(f64, f64) -> f64, from: f64| -> [f64; 3] {
        let all = lines.iter().flat_map(|(_, points, _)| points);
        let found = all.fold([from; 3], |e, p| [0, 1, 2].map(|k| pick(e[k], p[k])));
        found.map(|c| if c.is_finite() { c } else { 0.0 })
    };
    let (least, greatest) = (ends(f64::min, f64::INFINITY), ends(f64::max, f64::NEG_INFINITY));
    if version == DxfVersion::R2000 {
        let unit = match unit {
            CadUnit::Metre => 6,
            CadUnit::Millimetre => 4,
        };
        return r2000::write(&lines, &layers, [least, greatest], unit);
    }
    let mut text = String::new();
    let mut put = |code: u16, value: &str| {
        let _ = writeln!(text, "{code:>3}\n{value}");
    };
    // R12 has no units of its own.
    put(999, if unit == CadUnit::Metre { "UNITS: METRES, FULL SIZE" } else { "UNITS: MILLIMETRES, FULL SIZE" });
    put(0, "SECTION");
    put(2, "HEADER");
    put(9, "$ACADVER");
    put(1, "AC1009");
    for (name, point) in [("$EXTMIN", least), ("$EXTMAX", greatest)] {
        put(9, name);
        for (k, &coordinate) in point.iter().enumerate() {
            put(10 * (k as u16 + 1), &number(coordinate));
        }
    }
    put(0, "ENDSEC");
    put(0, "SECTION");
    put(2, "TABLES");
    put(0, "TABLE");
    put(2, "LTYPE");
    put(70, "1");
    put(0, "LTYPE");
    put(2, "CONTINUOUS");
    put(70, "0");
    put(3, "Solid line");
    put(72, "65");
    put(73, "0");
    put(40, "0.0");
    put(0, "ENDTAB");
    put(0, "TABLE");
    put(2, "LAYER");
    put(70, &layers.len().to_string());
    for (k, name) in layers.iter().enumerate() {
        put(0, "LAYER");
        put(2, name);
        put(70, "0");
        put(62, &COLOURS[k % COLOURS.len()].to_string());
        put(6, "CONTINUOUS");
    }
    put(0, "ENDTAB");
    put(0, "ENDSEC");
    put(0, "SECTION");
    put(2, "ENTITIES");
    for (name, points, flat) in &lines {
        put(0, "POLYLINE");
        put(8, name);
        put(66, "1");
        // The elevation; 8: a polyline in space.
        for code in [10, 20, 30] {
            put(code, "0.0");
        }
        put(70, if *flat { "0" } else { "8" });
        for point in points {
            put(0, "VERTEX");
            put(8, name);
            for (k, &coordinate) in point.iter().enumerate() {
                put(10 * (k as u16 + 1), &number(coordinate));
            }
            put(70, if *flat { "0" } else { "32" });
        }
        put(0, "SEQEND");
        put(8, name);
    }
    put(0, "ENDSEC");
    put(0, "EOF");
    text
}
