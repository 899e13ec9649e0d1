//! Reading of STEP (ISO 10303-21): the faces of the data section where it has some, and otherwise every B-spline surface, in the
//! length unit of the file.

use std::collections::BTreeMap;

use super::super::super::fault::{Faults, RecordFault};
use super::super::surfaces::CadSurfaces;
use super::faces::faces;
use super::geometry::Geometry;

/// Surfaces that have no ends without a face.
const OTHERS: [&str; 7] = [
    "CYLINDRICAL_SURFACE",
    "CONICAL_SURFACE",
    "SPHERICAL_SURFACE",
    "TOROIDAL_SURFACE",
    "SURFACE_OF_REVOLUTION",
    "SURFACE_OF_LINEAR_EXTRUSION",
    "PLANE",
];

/// Lists in lists, at most.
const DEEPEST: usize = 16;

/// Whether these are the first bytes of a STEP file.
pub(in super::super::super) fn is_step(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(200)];
    start.trim_ascii_start().starts_with(b"ISO-10303-21")
}

/// A parameter of an instance.
#[derive(Debug, Clone)]
pub(super) enum Value {
    Number(f64),
    Text,
    Reference(u64),
    List(Vec<Value>),
    /// The values of a typed one: `LENGTH_MEASURE(25.4)`.
    Typed(Vec<Value>),
    /// `.T.`, `$`, `*` and the like.
    Word(String),
}

/// An instance: its parts by keyword, and its line.
pub(super) struct Instance {
    pub(super) parts: Vec<(String, Vec<Value>)>,
    pub(super) line: usize,
}

impl Instance {
    /// Its keyword; of several that which says most.
    pub(super) fn kind(&self) -> String {
        let names = || self.parts.iter().map(|(name, _)| name);
        let with_knots = names().find(|name| name.ends_with("WITH_KNOTS"));
        with_knots.or_else(|| names().max_by_key(|name| name.len())).cloned().unwrap_or_default()
    }

    pub(super) fn part(&self, keyword: &str) -> Option<&[Value]> {
        self.parts.iter().find(|(name, _)| name == keyword).map(|(_, values)| values.as_slice())
    }
}

/// Runs over the characters of a file.
struct StepReader<'t> {
    text: &'t [u8],
    at: usize,
    line: usize,
}

impl StepReader<'_> {
    /// Passes blanks and comments.
    fn blanks(&mut self) {
        loop {
            match self.text.get(self.at) {
                Some(b'\n') => {
                    self.line += 1;
                    self.at += 1;
                }
                Some(b) if b.is_ascii_whitespace() => self.at += 1,
                Some(b'/') if self.text.get(self.at + 1) == Some(&b'*') => {
                    self.at += 2;
                    while self.at < self.text.len() && !self.text[self.at..].starts_with(b"*/") {
                        self.line += usize::from(self.text[self.at] == b'\n');
                        self.at += 1;
                    }
                    self.at = (self.at + 2).min(self.text.len());
                }
                _ => return,
            }
        }
    }

    fn peek(&mut self) -> Option<u8> {
        self.blanks();
        self.text.get(self.at).copied()
    }

    fn take(&mut self, wanted: u8) -> bool {
        let found = self.peek() == Some(wanted);
        self.at += usize::from(found);
        found
    }

    /// The characters as long as they are of a kind.
    fn word(&mut self, of: impl Fn(u8) -> bool) -> String {
        let from = self.at;
        while self.text.get(self.at).is_some_and(|&b| of(b)) {
            self.at += 1;
        }
        String::from_utf8_lossy(&self.text[from..self.at]).into_owned()
    }

    fn keyword(&mut self) -> String {
        self.blanks();
        self.word(|b| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'-' | b'!')).to_ascii_uppercase()
    }

    /// `(a, b, ...)`; none when it is no list.
    fn list(&mut self, depth: usize) -> Option<Vec<Value>> {
        if depth > DEEPEST || !self.take(b'(') {
            return None;
        }
        let mut values = Vec::new();
        if self.take(b')') {
            return Some(values);
        }
        loop {
            values.push(self.value(depth)?);
            if self.take(b')') {
                return Some(values);
            }
            if !self.take(b',') {
                return None;
            }
        }
    }

    fn value(&mut self, depth: usize) -> Option<Value> {
        match self.peek()? {
            b'(' => self.list(depth + 1).map(Value::List),
            b'\'' => self.text().then_some(Value::Text),
            b'#' => {
                self.at += 1;
                self.word(|b| b.is_ascii_digit()).parse().ok().map(Value::Reference)
            }
            b'.' if self.text.get(self.at + 1).is_some_and(u8::is_ascii_alphabetic) => {
                Some(Value::Word(self.word(|b| b.is_ascii_alphanumeric() || matches!(b, b'.' | b'_'))))
            }
            b'$' | b'*' => {
                self.at += 1;
                Some(Value::Word(String::new()))
            }
            b'"' => {
                self.at += 1;
                let word = self.word(|b| b != b'"');
                self.at += 1;
                Some(Value::Word(word))
            }
            b if b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.') => {
                let word = self.word(|b| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.' | b'E' | b'e'));
                word.parse().ok().map(Value::Number)
            }
            _ => {
                let name = self.keyword();
                if name.is_empty() {
                    return None;
                }
                self.list(depth + 1).map(Value::Typed)
            }
        }
    }

    /// Passes a text in quotes, a doubled quote in it included; whether it ends.
    fn text(&mut self) -> bool {
        self.at += 1;
        loop {
            match self.text.get(self.at) {
                None => return false,
                Some(b'\'') if self.text.get(self.at + 1) == Some(&b'\'') => self.at += 2,
                Some(b'\'') => {
                    self.at += 1;
                    return true;
                }
                Some(b) => {
                    self.line += usize::from(*b == b'\n');
                    self.at += 1;
                }
            }
        }
    }

    /// The instance after its number: `= NAME(...)` or `= (A(...) B(...))`.
    fn instance(&mut self) -> Option<Instance> {
        let line = self.line;
        if !self.take(b'=') {
            return None;
        }
        let mut parts = Vec::new();
        if self.take(b'(') {
            while !self.take(b')') {
                let name = self.keyword();
                parts.push((name, self.list(0)?));
            }
        } else {
            let name = self.keyword();
            parts.push((name, self.list(0)?));
        }
        self.take(b';').then_some(Instance { parts, line })
    }

    /// On to the end of a statement.
    fn skip(&mut self) {
        while let Some(b) = self.peek() {
            match b {
                b';' => {
                    self.at += 1;
                    return;
                }
                b'\'' => {
                    self.text();
                }
                _ => self.at += 1,
            }
        }
    }
}

/// Reads the surfaces of a STEP file.
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super::super) fn read_step(bytes: &[u8]) -> Result<CadSurfaces, Vec<RecordFault>> {
    let mut faults = Faults::default();
    let mut reader = StepReader { text: bytes, at: 0, line: 1 };
    let mut instances: BTreeMap<u64, Instance> = BTreeMap::new();
    while let Some(b) = reader.peek() {
        if b != b'#' {
            reader.skip();
            continue;
        }
        let line = reader.line;
        reader.at += 1;
        let name = reader.word(|b| b.is_ascii_digit());
        match (name.parse::<u64>(), reader.instance()) {
            (Ok(number), Some(instance)) => {
                instances.insert(number, instance);
            }
            _ => {
                faults.add(Some(line), &format!("#{name}"), "not an instance: #n = NAME(...);".to_owned());
                reader.skip();
            }
        }
        if faults.is_full() {
            break;
        }
    }
    let mut read = CadSurfaces { unit: super::unit::of(&instances, &mut faults), ..CadSurfaces::default() };
    let radian = radian(&instances);
    let mut geometry = Geometry { instances: &instances, faults: &mut faults, radian, points: 0 };
    (read.body, read.unread) = faces(&mut geometry);
    if read.body.faces.is_empty() && read.unread.is_empty() {
        loose_surfaces(&mut geometry, &mut read);
    }
    if read.surfaces.is_empty() && read.body.faces.is_empty() && read.unread.is_empty() && faults.list.is_empty() {
        faults.add(None, "", "no faces, and no B_SPLINE_SURFACE_WITH_KNOTS".to_owned());
    }
    faults.or(|| read)
}

/// The splines of a file without faces.
fn loose_surfaces(geometry: &mut Geometry<'_>, read: &mut CadSurfaces) {
    let instances = geometry.instances;
    let is_spline = |i: &Instance| i.kind().contains("B_SPLINE_SURFACE") || i.part("BEZIER_SURFACE").is_some();
    for (&number, instance) in instances.iter().filter(|(_, i)| is_spline(i)) {
        match geometry.spline_surface(number) {
            Some(found) => read.surfaces.push(found),
            None => {
                let message = "not a B-spline surface that can be used".to_owned();
                geometry.faults.add(Some(instance.line), &format!("#{number}"), message);
            }
        }
        if geometry.faults.is_full() {
            return;
        }
    }
    for other in OTHERS {
        let count = instances.values().filter(|i| i.part(other).is_some()).count();
        if count > 0 {
            read.notes.push(format!("{count} {other} of no face are not read"));
        }
    }
}

/// Radians in the unit of plane angles of a file.
fn radian(instances: &BTreeMap<u64, Instance>) -> f64 {
    let of = |instance: &Instance| {
        let [_, Value::Reference(measure)] = instance.part("CONVERSION_BASED_UNIT")? else { return None };
        let [value, ..] = instances.get(measure)?.part("PLANE_ANGLE_MEASURE_WITH_UNIT")? else { return None };
        match value {
            Value::Typed(list) => {
                list.first().and_then(|value| if let Value::Number(n) = value { Some(*n) } else { None })
            }
            Value::Number(number) => Some(*number),
            _ => None,
        }
    };
    instances.values().filter(|i| i.part("PLANE_ANGLE_UNIT").is_some()).find_map(of).unwrap_or(1.0)
}

/// The numbers of a list.
pub(super) fn numbers(value: &Value) -> Option<Vec<f64>> {
    let Value::List(list) = value else { return None };
    list.iter().map(|v| if let Value::Number(number) = v { Some(*number) } else { None }).collect()
}

/// A whole number from 0 up to one.
pub(super) fn whole(value: &Value, most: usize) -> Option<usize> {
    match value {
        Value::Number(n) if *n >= 0.0 && *n <= most as f64 && n.fract() <= 0.0 => Some(*n as usize),
        _ => None,
    }
}
