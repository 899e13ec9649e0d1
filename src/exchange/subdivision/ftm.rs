//! The project file as text, `.ftm`: a record a line, the three coordinates of a point on one line.
//!
//! Written as version 2.01, which has all that a body needs; every number is read back bit for bit.

use std::fmt::Write as _;

use super::super::fault::{Faults, RecordFault};
use super::{FOOT, Records, SubdivisionProject, VERSIONS, Version, project};

/// Whether this is the beginning of such a file.
#[must_use]
pub(in super::super) fn is_ftm(bytes: &[u8]) -> bool {
    bytes.starts_with(b"FREE!ship\n") || bytes.starts_with(b"FREE!ship\r\n")
}

/// Reads a project.
///
/// # Errors
/// What is wrong with the first record that cannot be read.
pub(in super::super) fn read_ftm(bytes: &[u8]) -> Result<SubdivisionProject, Vec<RecordFault>> {
    let text = String::from_utf8_lossy(bytes);
    project(&mut Text { lines: text.lines().collect(), at: 0 })
}

struct Text<'a> {
    lines: Vec<&'a str>,
    at: usize,
}

impl<'a> Text<'a> {
    fn next(&mut self, what: &str, faults: &mut Faults) -> Option<&'a str> {
        let line = self.lines.get(self.at).copied();
        if line.is_none() {
            faults.add(Some(self.at), "", format!("the file ends where {what} is expected"));
        }
        self.at += 1;
        line
    }

    fn wrong<T>(&self, found: &str, what: &str, expected: &str, faults: &mut Faults) -> Option<T> {
        faults.add(self.line(), found, format!("{what}: expected {expected}"));
        None
    }
}

/// A number with a point, or with a comma as some countries' settings write it.
fn float(word: &str) -> Option<f64> {
    word.replace(',', ".").parse::<f64>().ok().filter(|value| value.is_finite())
}

/// A version as a decimal number, by which versions rise: 3.3+ is between 3.27+ and 3.32+, 4.6.2 is 4.62+.
fn decimal(name: &str) -> Option<f64> {
    let name = name.trim();
    let name = name.strip_suffix('+').unwrap_or(name);
    let (whole, digits) = name.split_once('.')?;
    let digits = digits.replacen('.', "", 1);
    let are_digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    (are_digits(whole) && are_digits(&digits)).then(|| format!("{whole}.{digits}").parse().ok()).flatten()
}

impl Records for Text<'_> {
    fn version(&mut self, faults: &mut Faults) -> Option<Version> {
        let line = self.next("the version", faults)?;
        let found = decimal(line).filter(|version| (1.0..=5.0).contains(version));
        // Releases between those of the list write the same records as the last one before them.
        match found.and_then(|found| VERSIONS.iter().rposition(|known| decimal(known).is_some_and(|v| v <= found))) {
            Some(number) => Some(Version(number)),
            None => self.wrong(line, "the version", "a version from 1.0 to 5.0+", faults),
        }
    }

    fn integer(&mut self, what: &str, faults: &mut Faults) -> Option<i64> {
        let line = self.next(what, faults)?;
        match line.trim().parse() {
            Ok(value) => Some(value),
            Err(_) => self.wrong(line, what, "a whole number", faults),
        }
    }

    fn number(&mut self, what: &str, faults: &mut Faults) -> Option<f64> {
        let line = self.next(what, faults)?;
        match float(line.trim()) {
            Some(value) => Some(value),
            None => self.wrong(line, what, "a number", faults),
        }
    }

    fn boolean(&mut self, what: &str, faults: &mut Faults) -> Option<bool> {
        let line = self.next(what, faults)?;
        match line.trim().to_ascii_lowercase().as_str() {
            "1" | "-1" | "true" => Some(true),
            "0" | "false" => Some(false),
            _ => self.wrong(line, what, "0 or 1", faults),
        }
    }

    fn text(&mut self, what: &str, faults: &mut Faults) -> Option<String> {
        self.next(what, faults).map(unescaped)
    }

    fn point(&mut self, what: &str, faults: &mut Faults) -> Option<[f64; 3]> {
        let line = self.next(what, faults)?;
        let words: Vec<String> = line.split_whitespace().map(|word| word.replace(',', ".")).collect();
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        faults.point(self.at, line, &words, 3)
    }

    fn picture(&mut self, _size: usize, faults: &mut Faults) -> Option<()> {
        self.next("the preview", faults).map(drop)
    }

    fn left(&self) -> usize {
        self.lines.len().saturating_sub(self.at)
    }

    fn line(&self) -> Option<usize> {
        Some(self.at)
    }
}

/// A text of more lines stands on one with `\n`, a backslash twice.
fn unescaped(line: &str) -> String {
    let mut text = String::with_capacity(line.len());
    let mut characters = line.chars();
    while let Some(c) = characters.next() {
        match c {
            '\\' => match characters.next() {
                Some('n') => text.push('\n'),
                Some(other) => text.push(other),
                None => text.push('\\'),
            },
            c => text.push(c),
        }
    }
    text
}

fn escaped(text: &str) -> String {
    text.replace('\\', "\\\\").replace("\r\n", "\\n").replace(['\n', '\r'], "\\n")
}

/// The text of a project, version 2.01.
#[must_use]
pub fn write_ftm(project: &SubdivisionProject) -> String {
    let SubdivisionProject { name, stated, unit, net } = project;
    let mut text = String::new();
    let mut line = |words: &dyn std::fmt::Display| {
        let _ = writeln!(text, "{words}");
    };
    line(&"FREE!ship");
    line(&"2.01");
    // Medium precision; both sides are not shown.
    line(&1);
    line(&0);
    // Control net and sections are shown, normals, combs and diagonals are not.
    for shown in [1, 0, 1, 1, 1, 0, 1, 0, 1, 0] {
        line(&shown);
    }
    line(&0.1);
    line(&0);
    line(&escaped(name));
    line(&"");
    let main = [stated.length_between_perpendiculars, stated.breadth, stated.draught];
    main.iter().for_each(|value| line(&(value.unwrap_or(0.0) / unit)));
    line(&u8::from(main.iter().any(Option::is_some)));
    line(&1.025);
    line(&1);
    line(&0);
    line(&0x00F0_F0F0);
    line(&u8::from((unit - FOOT).abs() < 1e-12));
    line(&1);
    line(&0);
    line(&0);
    line(&"");
    line(&"loftsman");
    line(&net.layers.len());
    for (k, layer) in net.layers.iter().enumerate() {
        line(&escaped(&layer.name));
        line(&k);
        line(&layer.colour);
        line(&1);
        line(&u8::from(layer.symmetric));
        line(&0);
        line(&1);
        line(&u8::from(layer.in_hydrostatics));
        line(&0);
        line(&0);
        line(&1);
    }
    line(&0);
    line(&net.points.len());
    for ([x, y, z], kind) in &net.points {
        line(&format_args!("{x} {y} {z}"));
        line(&(*kind as usize));
        line(&0);
        line(&0);
    }
    line(&net.edges.len());
    for edge in &net.edges {
        line(&edge.ends[0]);
        line(&edge.ends[1]);
        line(&u8::from(edge.crease));
        line(&0);
    }
    // No control curves.
    line(&0);
    line(&net.faces.len());
    for face in &net.faces {
        line(&face.corners.len());
        face.corners.iter().for_each(|corner| line(corner));
        line(&face.layer);
        line(&0);
    }
    // Stations, buttocks, waterlines, diagonals, markers.
    for _ in 0..5 {
        line(&0);
    }
    text
}
