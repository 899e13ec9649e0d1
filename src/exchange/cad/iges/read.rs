//! Reading of IGES: the faces of a file (entities 144, 143, 510, 108) where it has some, and otherwise every rational B-spline
//! surface (128), with the transformations (124) of their directory entries. Of a file without surfaces the curves
//! (126, and lines, 110) are read.

use std::collections::BTreeMap;

use super::super::super::fault::{Faults, RecordFault};
use super::super::surfaces::{CadCurve, CadSurfaces, MOST_POINTS, points_of, spline_curve, surface};
use super::faces::faces;
use super::geometry::motion;
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector};

/// Columns before the letter of a section.
const LETTER: usize = 72;

/// Metres in the units of the flag of the global section, from 1: inch, millimetre, (named), foot, mile, metre,
/// kilometre, mil, micron, centimetre, microinch.
const UNITS: [f64; 11] = [0.0254, 1e-3, f64::NAN, 0.3048, 1609.344, 1.0, 1e3, 2.54e-5, 1e-6, 1e-2, 2.54e-8];

/// Entities that are neither surfaces nor parts of what is read, and need no mention: transformations, curves, names,
/// colours, trimming.
const SILENT: [usize; 25] = [
    0, 100, 102, 104, 106, 110, 112, 116, 124, 126, 130, 141, 142, 143, 144, 186, 308, 314, 402, 404, 406, 408, 410,
    502, 504,
];

/// Entities that are surfaces, and are not read: planes, splines by polynomials, ruled ones, of revolution, tabulated cylinders,
/// offsets, and those of solids.
const SURFACES: [usize; 14] = [108, 114, 118, 120, 122, 140, 190, 191, 192, 193, 194, 196, 197, 198];

/// Curves of a file at most.
const MOST_CURVES: usize = 20_000;

/// Lines of parameters of a transformation at most: twelve numbers and what follows them.
const MATRIX: usize = 24;

/// Whether these are the first lines of an IGES file: 80 columns, the 73rd of which is S.
pub(in super::super::super) fn is_iges(bytes: &[u8]) -> bool {
    let line = bytes.split(|&b| matches!(b, b'\n' | b'\r')).next().unwrap_or_default();
    line.len() >= LETTER + 8
        && line[LETTER] == b'S'
        && line[LETTER + 1..LETTER + 8].iter().all(|b| b.is_ascii_digit() || *b == b' ')
}

/// An entity of the directory.
pub(super) struct Entry {
    pub(super) kind: usize,
    pub(super) form: usize,
    /// First parameter record, and how many.
    pointer: usize,
    count: usize,
    /// Directory number of its transformation, 0 for none.
    transformation: usize,
    /// Line in the file.
    pub(super) line: usize,
}

/// One parameter of a record.
enum Parameter {
    Number(f64),
    Text(String),
}

/// The parameters of a text until its record delimiter.
fn parameters(text: &[u8], [field, record]: [u8; 2]) -> Vec<Parameter> {
    let (mut list, mut at) = (Vec::new(), 0);
    loop {
        while text.get(at) == Some(&b' ') {
            at += 1;
        }
        let digits = text[at..].iter().take_while(|b| b.is_ascii_digit()).count();
        if digits > 0 && text.get(at + digits) == Some(&b'H') {
            let length: usize =
                std::str::from_utf8(&text[at..at + digits]).ok().and_then(|n| n.parse().ok()).unwrap_or(0);
            let from = at + digits + 1;
            let to = from.saturating_add(length).min(text.len());
            list.push(Parameter::Text(String::from_utf8_lossy(&text[from..to]).into_owned()));
            at = to;
            at += text[at..].iter().take_while(|&&b| b != field && b != record).count();
        } else {
            let length = text[at..].iter().take_while(|&&b| b != field && b != record).count();
            let word: String =
                text[at..at + length].iter().map(|&b| if matches!(b, b'D' | b'd') { 'E' } else { b as char }).collect();
            let word = word.trim();
            // What is left out is 0 or the usual.
            let number = if word.is_empty() { 0.0 } else { word.parse().unwrap_or(f64::NAN) };
            list.push(Parameter::Number(number));
            at += length;
        }
        if at >= text.len() || text[at] == record {
            return list;
        }
        at += 1;
    }
}

/// The sections of a file by their letters: each line with its number in the file.
fn sections(bytes: &[u8]) -> BTreeMap<u8, Vec<(usize, &[u8])>> {
    let mut sections: BTreeMap<u8, Vec<(usize, &[u8])>> = BTreeMap::new();
    let lines = bytes.split(|&b| b == b'\n').map(|line| line.strip_suffix(b"\r").unwrap_or(line));
    for (k, line) in lines.enumerate().filter(|(_, line)| line.len() > LETTER) {
        sections.entry(line[LETTER]).or_default().push((k + 1, line));
    }
    sections
}

/// A number of eight columns; 0 where they are blank.
fn column(line: &[u8], field: usize) -> usize {
    let text = line.get(8 * (field - 1)..8 * field).unwrap_or_default();
    std::str::from_utf8(text).ok().and_then(|text| text.trim().parse().ok()).unwrap_or(0)
}

/// Reads the surfaces of an IGES file.
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super::super) fn read_iges(bytes: &[u8]) -> Result<CadSurfaces, Vec<RecordFault>> {
    let mut faults = Faults::default();
    let mut read = CadSurfaces::default();
    let sections = sections(bytes);
    let of = |letter: u8| sections.get(&letter).map_or(&[][..], Vec::as_slice);
    let global: Vec<u8> = of(b'G').iter().flat_map(|(_, line)| &line[..LETTER]).copied().collect();
    // The delimiters come first: "1H,,1H;," when they are not the usual.
    let delimiter = |at: usize, usual: u8| {
        if global.get(at..at + 2) == Some(b"1H") { global.get(at + 2).copied().unwrap_or(usual) } else { usual }
    };
    let field = delimiter(0, b',');
    let second = if global.starts_with(b"1H") { 4 } else { 1 };
    let delimiters = [field, delimiter(second, b';')];
    let header = parameters(global.get(second..).unwrap_or_default(), delimiters);
    // Counted from the record delimiter: the scale is the 13th, the flag of the unit the 14th, its name the 15th of the
    // section.
    let number = |k: usize| match header.get(k) {
        Some(Parameter::Number(value)) => *value,
        _ => 0.0,
    };
    let flag = number(12);
    let named = match header.get(13) {
        Some(Parameter::Text(name)) => match name.trim().to_ascii_uppercase().as_str() {
            "M" => 1.0,
            "MM" => 1e-3,
            "CM" => 1e-2,
            "IN" | "INCH" => 0.0254,
            "FT" => 0.3048,
            _ => f64::NAN,
        },
        _ => f64::NAN,
    };
    let unit = if flag >= 1.0 { UNITS.get(flag as usize - 1).copied().unwrap_or(f64::NAN) } else { UNITS[0] };
    let unit = if unit.is_finite() { unit } else { named };
    if !unit.is_finite() {
        let message = format!("the unit of length is flag {flag}, no name of a unit that is known");
        faults.add(None, "G section", message);
    }
    read.unit = unit.is_finite().then_some(unit);
    let directory = entries(of(b'D'), &mut faults);
    let body = of(b'P');
    // Each line of parameters belongs to one entity.
    let claimed = directory.values().map(|entry| entry.count.min(body.len())).fold(0, usize::saturating_add);
    if claimed > 2 * body.len() {
        let message = format!("the entities claim {claimed} lines of parameters, there are {}", body.len());
        faults.add(None, "D section", message);
        return Err(faults.list);
    }
    let list_of = |entry: &Entry, most: usize| {
        let lines = body.iter().skip(entry.pointer.saturating_sub(1)).take(entry.count.min(most));
        let text: Vec<u8> = lines.flat_map(|(_, line)| &line[..64]).copied().collect();
        parameters(&text, delimiters)
    };
    let mut others: BTreeMap<usize, usize> = BTreeMap::new();
    let mut points = 0;
    let of_entry = |entry: &Entry| {
        let transformation = directory.get(&entry.transformation).filter(|_| entry.transformation > 0);
        (list_of(entry, usize::MAX), transformation.map(|entry| numbers(&list_of(entry, MATRIX))))
    };
    let plain = |entry: &Entry| {
        let (list, place) = of_entry(entry);
        (numbers(&list), place)
    };
    (read.body, read.unread) = faces(&directory, &plain, &mut faults);
    if !read.body.faces.is_empty() || !read.unread.is_empty() {
        return faults.or(|| read);
    }
    for (name, entry) in &directory {
        if entry.kind != 128 {
            if !SILENT.contains(&entry.kind) && entry.kind < 500 {
                *others.entry(entry.kind).or_default() += 1;
            }
            continue;
        }
        let (list, place) = of_entry(entry);
        let title = format!("entity 128, D{name}");
        if let Some(found) = entity_128(&mut faults, entry.line, &title, &numbers(&list), place.as_deref(), &mut points)
        {
            read.surfaces.push(found);
        }
        if faults.is_full() {
            break;
        }
    }
    let unread: Vec<String> = others
        .iter()
        .filter(|(kind, _)| SURFACES.contains(kind))
        .map(|(kind, count)| format!("{count} of {kind}"))
        .collect();
    if read.surfaces.is_empty() && !unread.is_empty() && faults.list.is_empty() {
        let kinds = unread.join(", ");
        let message =
            format!("its surfaces are not read (entities {kinds}), and its curves are edges of these, not sections");
        faults.add(None, "", message);
    }
    if read.surfaces.is_empty() && faults.list.is_empty() {
        let curves = directory.iter().filter(|(_, entry)| matches!(entry.kind, 110 | 126));
        for (name, entry) in curves.take(MOST_CURVES) {
            let (list, place) = of_entry(entry);
            let title = format!("entity {}, D{name}", entry.kind);
            let list = numbers(&list);
            let found = match entry.kind {
                126 => entity_126(&mut faults, entry.line, &title, &list, place.as_deref(), &mut points),
                _ => entity_110(&mut faults, entry.line, &title, &list, place.as_deref()),
            };
            read.curves.extend(found);
            if faults.is_full() {
                break;
            }
        }
    }
    if read.surfaces.is_empty() && read.curves.is_empty() && faults.list.is_empty() {
        let found: Vec<String> = others.iter().map(|(kind, count)| format!("{count} of {kind}")).collect();
        let there =
            if found.is_empty() { String::new() } else { format!("; the file has entities {}", found.join(", ")) };
        faults.add(None, "", format!("no B-spline surfaces (entity 128) and no curves (126){there}"));
    }
    for (kind, count) in others {
        read.notes.push(format!("{count} entities {kind} are not read"));
    }
    faults.or(|| read)
}

/// The entries by their directory numbers.
fn entries(lines: &[(usize, &[u8])], faults: &mut Faults) -> BTreeMap<usize, Entry> {
    let mut directory = BTreeMap::new();
    for (k, pair) in lines.chunks(2).enumerate() {
        let [(row, first), (_, second)] = pair else {
            faults.add(Some(pair[0].0), "", "a directory entry of one line, expected two".to_owned());
            break;
        };
        let entry = Entry {
            kind: column(first, 1),
            pointer: column(first, 2),
            count: column(second, 4),
            form: column(second, 5),
            transformation: column(first, 7),
            line: *row,
        };
        directory.insert(2 * k + 1, entry);
    }
    directory
}

fn numbers(list: &[Parameter]) -> Vec<f64> {
    list.iter().map(|p| if let Parameter::Number(value) = p { *value } else { f64::NAN }).collect()
}

/// A line of its parameters.
fn entity_110(faults: &mut Faults, line: usize, name: &str, list: &[f64], place: Option<&[f64]>) -> Option<CadCurve> {
    let Some([ax, ay, az, bx, by, bz]) = list.get(1..7) else {
        faults.add(Some(line), name, format!("{} parameters, expected 7", list.len()));
        return None;
    };
    let points = [[*ax, *ay, *az], [*bx, *by, *bz]].map(|point| motion(place).point(point));
    if points.iter().flatten().all(|c| c.is_finite()) {
        return Some(CadCurve { line, points: points.to_vec(), ..CadCurve::default() });
    }
    faults.add(Some(line), name, "a coordinate that is no number".to_owned());
    None
}

/// The points of a rational B-spline curve of its parameters.
fn entity_126(
    faults: &mut Faults,
    line: usize,
    name: &str,
    list: &[f64],
    place: Option<&[f64]>,
    points: &mut usize,
) -> Option<CadCurve> {
    let (found, ends) = spline_126(faults, line, name, list, place, points)?;
    Some(points_of(line, &found, ends))
}

/// A rational B-spline curve of its parameters, and between which of its own it lies.
pub(super) fn spline_126(
    faults: &mut Faults,
    line: usize,
    name: &str,
    list: &[f64],
    place: Option<&[f64]>,
    points: &mut usize,
) -> Option<(BsplineCurve<4>, [f64; 2])> {
    let whole = |k: usize| list.get(k).copied().filter(|v| v.fract().abs() <= 0.0 && (0.0..=1e5).contains(v));
    let (Some(upper), Some(degree)) = (whole(1), whole(2)) else {
        faults.add(Some(line), name, "parameters 1 and 2, expected whole numbers up to 100000".to_owned());
        return None;
    };
    let (count, degree) = (upper as usize + 1, degree as usize);
    let (knots, weights) = (7, 7 + count + degree + 1);
    let net = weights + count;
    *points = points.saturating_add(count);
    if list.len() < net + 3 * count || *points > MOST_POINTS {
        faults.add(Some(line), name, format!("{} parameters, expected {}", list.len(), net + 3 * count));
        return None;
    }
    let place = motion(place);
    let of = |k: usize| (list[weights + k], place.point([0, 1, 2].map(|axis| list[net + 3 * k + axis])));
    let end = |k: usize| list.get(net + 3 * count + k).copied().unwrap_or(0.0);
    let found = spline_curve(faults, line, name, degree, list[knots..weights].to_vec(), (0..count).map(of))?;
    let (a, b) = found.knots().domain();
    let ends = [end(0), end(1)];
    // Without two ends it is the whole of it.
    let ends = if ends[0] < ends[1] { ends.map(|t| t.clamp(a, b)) } else { [a, b] };
    Some((found, ends))
}

/// A rational B-spline surface of its parameters; points run with u fastest.
pub(super) fn entity_128(
    faults: &mut Faults,
    line: usize,
    name: &str,
    list: &[f64],
    place: Option<&[f64]>,
    points: &mut usize,
) -> Option<BsplineSurface<4>> {
    let mut whole = |k: usize, most: usize| {
        let value = list.get(k).copied().unwrap_or(f64::NAN);
        let fits = value >= 0.0 && value.fract() <= 0.0 && value <= most as f64;
        if !fits {
            faults.add(Some(line), name, format!("parameter {k} is {value}, expected a whole number up to {most}"));
        }
        fits.then_some(value as usize)
    };
    let (k1, k2) = (whole(1, MOST_POINTS)?, whole(2, MOST_POINTS)?);
    let (m1, m2) = (whole(3, 100)?, whole(4, 100)?);
    let (rows, columns) = (k1 + 1, k2 + 1);
    let count = rows.saturating_mul(columns);
    let (u, v) = (10, 10 + rows + m1 + 1);
    let weights = v + columns + m2 + 1;
    let net = weights.saturating_add(count);
    *points = points.saturating_add(count);
    if *points > MOST_POINTS {
        faults.add(Some(line), name, format!("more than {MOST_POINTS} control points"));
        return None;
    }
    if list.len() < net + 3 * count {
        faults.add(Some(line), name, format!("{} parameters, expected {}", list.len(), net + 3 * count));
        return None;
    }
    let place = motion(place);
    let of = |k: usize| (list[weights + k], place.point([0, 1, 2].map(|axis| list[net + 3 * k + axis])));
    let order = (0..rows).flat_map(|i| (0..columns).map(move |j| j * rows + i));
    let knots = [list[u..v].to_vec(), list[v..weights].to_vec()];
    let found = surface(faults, Some(line), name, [m1, m2], knots, order.map(of))?;
    // What of it is meant.
    let end = |k: usize| list.get(net + 3 * count + k).copied().unwrap_or(0.0);
    let part = |knots: &KnotVector, [from, to]: [f64; 2]| {
        let (a, b) = knots.domain();
        let (from, to) = (from.max(a), to.min(b));
        if to - from > 1e-9 * (b - a) { [from, to] } else { [a, b] }
    };
    let (us, vs) = (part(found.u(), [end(0), end(1)]), part(found.v(), [end(2), end(3)]));
    found.part(us, vs).ok().or(Some(found))
}
