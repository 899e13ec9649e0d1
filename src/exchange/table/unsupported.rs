//! Files of other kinds that are given for a table by mistake: drawings, archives, pictures.
//!
//! They are recognised by their first bytes, where these are published, and else by the ending of the name together with what
//! a text of that kind begins with. One message about the kind helps more than one about each of its lines.

/// First bytes of a kind of file.
const FIRST_BYTES: [(&[u8], &str); 10] = [
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
    if start.trim_start().starts_with('{') {
        return Some("JSON (of a hull? hydro, section, inspect and report read those)");
    }
    let name = name.to_ascii_lowercase();
    ENDINGS.iter().find(|(ending, _)| name.ends_with(ending)).map(|(_, kind)| *kind)
}
