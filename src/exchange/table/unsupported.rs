//! Files of other kinds that are given for a table by mistake: drawings, archives, pictures.
//!
//! They are recognised by their first bytes, where these are published, and else by the ending of the name together with what
//! a text of that kind begins with. One message about the kind helps more than one about each of its lines.

/// First bytes of a kind of file.
const FIRST_BYTES: [(&[u8], &str); 11] = [
    (b"\x89HDF", "a mesh (HDF5, as MED and CGNS)"),
    (b"<VTKFile", "a mesh (VTK), which needs the feature `packages` of the library"),
    (b"\x1f\x8b", "a file compressed by gzip"),
    (b"BZh", "a file compressed by bzip2"),
    (b"\xfd7zXZ\0", "a file compressed by xz"),
    (b"7z\xbc\xaf\x27\x1c", "a 7z archive"),
    (b"%PDF", "a PDF document"),
    (b"\x89PNG", "a PNG picture"),
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"AC10", DWG),
    (b"\xd0\xcf\x11\xe0", "a workbook or document of the older binary Office format"),
];

/// Endings of names of files that are no text, or none that we read.
const ENDINGS: [(&str, &str); 1] = [(".dwg", DWG)];

/// Drawings of a form that is not published.
pub(super) const DWG: &str = "a drawing (DWG)";

/// Beginnings of the texts of bodies that are not read, in small letters, and what they are.
const BODIES: [(&str, &str); 9] = [
    ("dbrep_drawableshape", BREP),
    ("cascade topology", BREP),
    ("meshversionformatted", MEDIT),
    ("mesh3d", "a mesh (Netgen)"),
    ("*heading", ABAQUS),
    ("*node", ABAQUS),
    ("*keyword", "a mesh (LS-DYNA)"),
    ("begin bulk", NASTRAN),
    ("ndime=", "a mesh (SU2)"),
];
const NASTRAN: &str = "a mesh (Nastran)";
pub(super) const BREP: &str = "a body (BREP of OpenCASCADE)";
const MEDIT: &str = "a mesh (Medit)";
const ABAQUS: &str = "a mesh (Abaqus)";
const TECPLOT: &str = "a mesh or a field (Tecplot)";

/// What can be done with a file of a kind.
pub(super) fn remedy(kind: &str) -> &'static str {
    match kind {
        DWG => "Save it as DXF, with faces or with lines in space",
        BREP => "Save it as STEP or IGES",
        TECPLOT => "Save its surface as STL, PLY or VTK",
        _ if kind.starts_with("a mesh (") && !kind.contains("VTK") => "Save its surface as STL, PLY, VTK or gmsh",
        _ => "Give a table of offsets, or sections, as CSV, XLSX or a text format of offsets",
    }
}

/// A body of a kind that is not read, by the first lines of its text that are no remarks.
fn body(lower: &str) -> Option<&'static str> {
    if lower.starts_with("#vrml") {
        return Some("a mesh (VRML)");
    }
    let remarks = ["#", "**", "//", "$"];
    let is_said = |line: &&str| !line.is_empty() && !remarks.iter().any(|remark| line.starts_with(remark));
    let mut lines = lower.lines().map(str::trim).filter(is_said);
    let first = lines.next()?;
    if let Some((_, kind)) = BODIES.iter().find(|(start, _)| first.starts_with(start)) {
        return Some(kind);
    }
    let is_point =
        |rest: &str| rest.trim_start_matches(['*', ',', ' ', '\t']).starts_with(|c: char| c.is_ascii_digit());
    if first.strip_prefix("grid").is_some_and(is_point) {
        return Some(NASTRAN);
    }
    if first == "-1" && lines.next().is_some_and(|second| ["151", "164", "2411", "2420"].contains(&second)) {
        return Some("a mesh (I-DEAS UNV)");
    }
    let is_titled = first.starts_with("title") || first.starts_with("variables");
    let has = |word: &str| lower.lines().any(|line| line.trim_start().starts_with(word));
    (is_titled && has("variables") && has("zone")).then_some(TECPLOT)
}

/// The kind of a file that holds no table of offsets; none when it may hold one.
pub(super) fn format(name: &str, bytes: &[u8]) -> Option<&'static str> {
    if let Some((_, kind)) = FIRST_BYTES.iter().find(|(first, _)| bytes.starts_with(first)) {
        return Some(kind);
    }
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(2000)]);
    let lower = start.trim_start().to_ascii_lowercase();
    if lower.starts_with("<!doctype html") || lower.starts_with("<html") {
        return Some("a web page (HTML)");
    }
    if lower.starts_with("<?xml") && lower.contains("<vtkfile") {
        return Some("a mesh (VTK), which needs the feature `packages` of the library");
    }
    if lower.contains("<x3d") {
        return Some("a mesh (X3D)");
    }
    if let Some(kind) = body(&lower) {
        return Some(kind);
    }
    if start.trim_start().starts_with('{') {
        return Some("JSON (of a hull? hydro, section, inspect and report read those)");
    }
    let name = name.to_ascii_lowercase();
    ENDINGS.iter().find(|(ending, _)| name.ends_with(ending)).map(|(_, kind)| *kind)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_of_other_programs_are_named() {
        for (text, kind) in [
            ("DBRep_DrawableShape\n\nCASCADE Topology V3, (c) Open Cascade\n", BREP),
            ("MeshVersionFormatted 2\nDimension 3\n", MEDIT),
            ("# Generated\nmesh3d\n\ndimension\n3\n", "a mesh (Netgen)"),
            ("** remark\n*HEADING\nship\n*NODE\n1, 0., 0., 0.\n", ABAQUS),
            ("$ remark\nGRID    1       0       0.00E+00-5.000006.000000\n", NASTRAN),
            ("$# remark\n*KEYWORD\n*NODE\n1, 0, -5, 6\n", "a mesh (LS-DYNA)"),
            ("    -1\n  2411\n         1         1\n", "a mesh (I-DEAS UNV)"),
            ("#VRML V1.0 ascii\nCoordinate3 {\n", "a mesh (VRML)"),
            ("<?xml version=\"1.0\"?>\n<!DOCTYPE X3D>\n<X3D profile='Interchange'>\n", "a mesh (X3D)"),
            ("NDIME= 3\nNELEM= 0\n", "a mesh (SU2)"),
            ("TITLE = \"hull\"\nVARIABLES = \"X\", \"Y\"\nZONE NODES = 7\n0.0 1.0\n", TECPLOT),
        ] {
            assert_eq!(format("hull.txt", text.as_bytes()), Some(kind), "{text}");
            assert!(remedy(kind).starts_with("Save"), "{kind}");
        }
        for table in ["title,ship\nx,0,1\n0,1,2\n", "Title: variables of a zone\n1 2 3\n"] {
            assert_eq!(format("hull.csv", table.as_bytes()), None, "{table}");
        }
    }
}
