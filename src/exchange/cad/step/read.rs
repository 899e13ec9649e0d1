//! Reading of STEP (ISO 10303-21): every B_SPLINE_SURFACE_WITH_KNOTS of the data section, rational or not, untrimmed,
//! in the length unit of the file. Placements of assemblies are not applied, and a note says where there are some.

use std::collections::BTreeMap;

use super::super::super::fault::{Faults, RecordFault};
use super::super::surfaces::{CadSurfaces, MOST_POINTS, surface};
use crate::spline::{BsplineSurface, MAX_DEGREE};

/// Prefixes of the metre, and none.
const PREFIXES: [(&str, f64); 8] = [
    ("", 1.0),
    (".MICRO.", 1e-6),
    (".MILLI.", 1e-3),
    (".CENTI.", 1e-2),
    (".DECI.", 1e-1),
    (".DECA.", 1e1),
    (".HECTO.", 1e2),
    (".KILO.", 1e3),
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
enum Value {
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
struct Instance {
    parts: Vec<(String, Vec<Value>)>,
    line: usize,
}

impl Instance {
    fn part(&self, keyword: &str) -> Option<&[Value]> {
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
    let mut read = CadSurfaces { unit: unit(&instances, &mut faults), ..CadSurfaces::default() };
    let mut points = 0;
    for (number, instance) in instances.iter().filter(|(_, i)| i.part("B_SPLINE_SURFACE_WITH_KNOTS").is_some()) {
        let name = format!("#{number}");
        match b_spline(&mut faults, &name, instance, &instances, &mut points) {
            Some(found) => read.surfaces.push(found),
            None => faults.add(Some(instance.line), &name, "not a B-spline surface that can be used".to_owned()),
        }
        if faults.is_full() {
            break;
        }
    }
    let placed = instances.values().filter(|i| i.part("ITEM_DEFINED_TRANSFORMATION").is_some()).count();
    if placed > 0 {
        read.notes.push(format!("{placed} placements of an assembly are not applied"));
    }
    let others = [
        "CYLINDRICAL_SURFACE",
        "CONICAL_SURFACE",
        "SPHERICAL_SURFACE",
        "TOROIDAL_SURFACE",
        "SURFACE_OF_REVOLUTION",
        "SURFACE_OF_LINEAR_EXTRUSION",
        "PLANE",
    ];
    for other in others {
        let count = instances.values().filter(|i| i.part(other).is_some()).count();
        if count > 0 {
            read.notes.push(format!("{count} {other} are not read"));
        }
    }
    if read.surfaces.is_empty() && faults.list.is_empty() {
        faults.add(None, "", "no B_SPLINE_SURFACE_WITH_KNOTS".to_owned());
    }
    faults.or(|| read)
}

/// Metres in the length unit of a file; none where it states none, or one that is not known: a fault.
fn unit(instances: &BTreeMap<u64, Instance>, faults: &mut Faults) -> Option<f64> {
    let si = |instance: &Instance| match instance.part("SI_UNIT")?.first() {
        Some(Value::Word(prefix)) => PREFIXES.iter().find(|(name, _)| name == prefix).map(|(_, metres)| *metres),
        _ => None,
    };
    // A unit that is made of another one: its measure is typed, or a number alone.
    let converted = |instance: &Instance| {
        let [_, Value::Reference(measure)] = instance.part("CONVERSION_BASED_UNIT")? else { return None };
        let [value, Value::Reference(of)] = instances.get(measure)?.part("LENGTH_MEASURE_WITH_UNIT")? else {
            return None;
        };
        let number = match value {
            Value::Typed(list) => list.first()?,
            number => number,
        };
        let Value::Number(number) = number else { return None };
        Some(number * si(instances.get(of)?)?)
    };
    let lengths = || instances.iter().filter(|(_, i)| i.part("LENGTH_UNIT").is_some());
    let is_converted = |i: &Instance| i.part("CONVERSION_BASED_UNIT").is_some();
    // It is the one that is used.
    let (number, instance) = lengths().find(|(_, i)| is_converted(i)).or_else(|| lengths().next())?;
    let found = if is_converted(instance) { converted(instance) } else { si(instance) };
    if found.is_none() {
        faults.add(Some(instance.line), &format!("#{number}"), "not a unit of length that is known".to_owned());
    }
    found
}

fn numbers(value: &Value) -> Option<Vec<f64>> {
    let Value::List(list) = value else { return None };
    list.iter().map(|v| if let Value::Number(number) = v { Some(*number) } else { None }).collect()
}

fn whole(value: &Value, most: usize) -> Option<usize> {
    match value {
        Value::Number(n) if *n >= 0.0 && *n <= most as f64 && n.fract() <= 0.0 => Some(*n as usize),
        _ => None,
    }
}

/// Knots with their multiplicities as one sequence.
fn knots(multiplicities: &Value, values: &Value) -> Option<Vec<f64>> {
    let (times, values) = (numbers(multiplicities)?, numbers(values)?);
    let fits = times.len() == values.len() && times.iter().all(|&t| (1.0..=MAX_DEGREE as f64 + 1.0).contains(&t));
    fits.then(|| times.iter().zip(&values).flat_map(|(&t, &value)| std::iter::repeat_n(value, t as usize)).collect())
}

/// The surface of an instance.
fn b_spline(
    faults: &mut Faults,
    name: &str,
    instance: &Instance,
    instances: &BTreeMap<u64, Instance>,
    total: &mut usize,
) -> Option<BsplineSurface<4>> {
    let with_knots = instance.part("B_SPLINE_SURFACE_WITH_KNOTS")?;
    // Alone it has a name first; among others its own parameters only.
    let (form, own) = match instance.part("B_SPLINE_SURFACE") {
        Some(form) => (form, with_knots),
        None => (with_knots.get(1..8)?, with_knots.get(8..)?),
    };
    let [u_degree, v_degree, Value::List(rows), ..] = form else { return None };
    let [u_times, v_times, u_knots, v_knots, ..] = own else { return None };
    let degrees = [whole(u_degree, 100)?, whole(v_degree, 100)?];
    let mut net = Vec::new();
    for row in rows {
        let Value::List(row) = row else { return None };
        for value in row {
            let Value::Reference(point) = value else { return None };
            let [_, coordinates, ..] = instances.get(point)?.part("CARTESIAN_POINT")? else { return None };
            let [x, y, z] = numbers(coordinates)?[..] else { return None };
            net.push([x, y, z]);
        }
    }
    *total += net.len();
    if *total > MOST_POINTS {
        faults.add(Some(instance.line), name, format!("more than {MOST_POINTS} control points"));
        return None;
    }
    let weights = match instance.part("RATIONAL_B_SPLINE_SURFACE") {
        Some([Value::List(rows), ..]) => {
            rows.iter().map(numbers).collect::<Option<Vec<_>>>()?.into_iter().flatten().collect()
        }
        _ => vec![1.0; net.len()],
    };
    if weights.len() != net.len() {
        return None;
    }
    let knots = [knots(u_times, u_knots)?, knots(v_times, v_knots)?];
    surface(faults, Some(instance.line), name, degrees, knots, weights.into_iter().zip(net))
}
