//! Reading of panels, in the units and axes of their files: GDF (WAMIT), PNL (HAMS), meshes of NEMOH. Numbers are read
//! as words whatever the lines; a panel of four different corners becomes two triangles from its first. Where the file
//! names a plane of symmetry, the half that is given is read: whoever reads bodies mirrors it.

use super::super::fault::{Faults, LARGEST, RecordFault};
use super::MOST_TRIANGLES;
use crate::hull::TriangleMesh;

/// The words of a text with their lines; what follows `!` or `#` in a line is a comment.
struct Words<'a> {
    list: std::vec::IntoIter<(usize, &'a str)>,
    last: usize,
    faults: Faults,
}

impl<'a> Words<'a> {
    fn of(text: &'a str, skip: usize) -> Self {
        let list: Vec<(usize, &str)> = text
            .lines()
            .enumerate()
            .skip(skip)
            .flat_map(|(k, line)| {
                let said = line.split(['!', '#']).next().unwrap_or_default();
                said.split_whitespace().map(move |word| (k + 1, word))
            })
            .collect();
        let last = list.last().map_or(0, |(line, _)| *line);
        Self { list: list.into_iter(), last, faults: Faults::default() }
    }

    /// The next number; none, with a fault, when there is none.
    fn number(&mut self, what: &str) -> Option<f64> {
        let Some((line, word)) = self.list.next() else {
            self.faults.add(Some(self.last), "", format!("the file ends, expected {what}"));
            return None;
        };
        // FORTRAN writes 1.0D+01.
        match word.replace(['D', 'd'], "e").parse::<f64>() {
            Ok(value) if value.abs() <= LARGEST => Some(value),
            _ => {
                self.faults.add(Some(line), word, format!("expected {what}, a number of at most 1e8"));
                None
            }
        }
    }

    /// The next whole number that is not negative.
    fn count(&mut self, what: &str) -> Option<usize> {
        let value = self.number(what)?;
        if value >= 0.0 && value.fract() == 0.0 {
            return Some(value as usize);
        }
        self.faults.add(Some(self.last), &value.to_string(), format!("expected {what}, a whole number"));
        None
    }

    fn point(&mut self, what: &str) -> Option<[f64; 3]> {
        Some([self.number(what)?, self.number(what)?, self.number(what)?])
    }

    /// The rest of the line of the word read last does not count: words up to the next line are left out.
    fn next_line(&mut self, line: usize) {
        while self.list.as_slice().first().is_some_and(|(other, _)| *other == line) {
            self.list.next();
        }
    }

    fn line(&self) -> usize {
        self.list.as_slice().first().map_or(self.last, |(line, _)| *line)
    }
}

/// The triangles of a panel with corners in turn, from the first of these, as its volume is reckoned on the page of
/// `export`.
fn triangles([a, b, c, d]: [[f64; 3]; 4]) -> [[[f64; 3]; 3]; 2] {
    [[a, b, c], [a, c, d]]
}

fn body(mut faults: Faults, corners: Vec<[[f64; 3]; 3]>) -> Result<TriangleMesh, Vec<RecordFault>> {
    let mesh = TriangleMesh::from_corners(corners.into_iter());
    if mesh.triangles.is_empty() && faults.list.is_empty() {
        faults.add(None, "", "no panels".to_owned());
    }
    faults.or(|| mesh)
}

fn too_many(count: usize, faults: &mut Faults) -> bool {
    let over = count > MOST_TRIANGLES / 2;
    if over {
        faults.add(None, "", format!("{count} panels or nodes; at most {} are read", MOST_TRIANGLES / 2));
    }
    over
}

/// Reads a GDF file of low order: a title, ULEN and GRAV, ISX and ISY, the number of panels, and the corners of each.
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super) fn read_gdf(bytes: &[u8]) -> Result<TriangleMesh, Vec<RecordFault>> {
    let text = String::from_utf8_lossy(bytes);
    let mut words = Words::of(&text, 1);
    let mut corners = Vec::new();
    let header = |words: &mut Words<'_>| -> Option<usize> {
        for what in [["ULEN", "GRAV"], ["ISX", "ISY"]] {
            let line = words.line();
            words.number(what[0])?;
            words.number(what[1])?;
            // Names may follow the numbers.
            words.next_line(line);
        }
        let line = words.line();
        let count = words.count("the number of panels")?;
        words.next_line(line);
        Some(count)
    };
    if let Some(count) = header(&mut words).filter(|count| !too_many(*count, &mut words.faults)) {
        for k in 0..count {
            let mut panel = [[0.0; 3]; 4];
            let what = format!("a corner of panel {} of {count}", k + 1);
            for corner in &mut panel {
                let Some(point) = words.point(&what) else { return body(words.faults, Vec::new()) };
                *corner = point;
            }
            corners.extend(triangles(panel));
        }
    }
    body(words.faults, corners)
}

/// A panel by the numbers of its nodes, from 1; none, with a fault, when there is no such node.
fn by_number(numbers: [usize; 4], nodes: &[[f64; 3]], line: usize, faults: &mut Faults) -> Option<[[f64; 3]; 4]> {
    let mut panel = [[0.0; 3]; 4];
    for (corner, number) in panel.iter_mut().zip(numbers) {
        let Some(node) = number.checked_sub(1).and_then(|k| nodes.get(k)) else {
            faults.add(Some(line), &number.to_string(), format!("no node; there are {}", nodes.len()));
            return None;
        };
        *corner = *node;
    }
    Some(panel)
}

/// Reads a mesh of NEMOH: two numbers, nodes with their numbers up to a line of zeros, four corners of each panel up to
/// another.
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super) fn read_nemoh(bytes: &[u8]) -> Result<TriangleMesh, Vec<RecordFault>> {
    let text = String::from_utf8_lossy(bytes);
    let mut words = Words::of(&text, 0);
    let (mut nodes, mut corners) = (Vec::new(), Vec::new());
    let first = words.line();
    if words.number("2").is_none() || words.number("0 or 1 for the plane of symmetry").is_none() {
        return body(words.faults, corners);
    }
    words.next_line(first);
    loop {
        let (Some(number), Some(point)) = (words.count("the number of a node, or 0"), words.point("a coordinate"))
        else {
            return body(words.faults, corners);
        };
        if number == 0 {
            break;
        }
        nodes.push(point);
        if too_many(nodes.len(), &mut words.faults) {
            return body(words.faults, corners);
        }
    }
    loop {
        let line = words.line();
        let mut numbers = [0; 4];
        for number in &mut numbers {
            let Some(found) = words.count("the number of a corner, or 0") else { return body(words.faults, corners) };
            *number = found;
        }
        if numbers == [0; 4] {
            return body(words.faults, corners);
        }
        let Some(panel) = by_number(numbers, &nodes, line, &mut words.faults) else {
            return body(words.faults, corners);
        };
        corners.extend(triangles(panel));
        if too_many(corners.len() / 2, &mut words.faults) {
            return body(words.faults, corners);
        }
    }
}

/// Reads a PNL file: numbers of panels and nodes and two symmetries, nodes with their numbers, and panels with theirs,
/// the number of their corners and those.
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super) fn read_pnl(bytes: &[u8]) -> Result<TriangleMesh, Vec<RecordFault>> {
    let text = String::from_utf8_lossy(bytes);
    // Headings are lines of dashes.
    let said: String =
        text.lines().map(|line| if line.contains("--") { "\n".to_owned() } else { format!("{line}\n") }).collect();
    let mut words = Words::of(&said, 0);
    let mut corners = Vec::new();
    let header = [(); 4].map(|()| words.count("the numbers of panels and nodes and the symmetries"));
    let [Some(panels), Some(count), Some(_), Some(_)] = header else { return body(words.faults, corners) };
    if too_many(panels.max(count), &mut words.faults) {
        return body(words.faults, corners);
    }
    let mut nodes = Vec::new();
    for k in 0..count {
        let what = format!("node {} of {count}", k + 1);
        let (Some(_), Some(point)) = (words.count(&what), words.point(&what)) else {
            return body(words.faults, corners);
        };
        nodes.push(point);
    }
    for k in 0..panels {
        let (line, what) = (words.line(), format!("panel {} of {panels}", k + 1));
        let (Some(_), Some(sides)) = (words.count(&what), words.count(&what)) else {
            return body(words.faults, corners);
        };
        if !(3..=4).contains(&sides) {
            words.faults.add(Some(line), &sides.to_string(), "expected 3 or 4 corners".to_owned());
            return body(words.faults, corners);
        }
        let mut numbers = [0; 4];
        for number in numbers.iter_mut().take(sides) {
            let Some(found) = words.count(&what) else { return body(words.faults, corners) };
            *number = found;
        }
        if sides == 3 {
            numbers[3] = numbers[2];
        }
        let Some(panel) = by_number(numbers, &nodes, line, &mut words.faults) else {
            return body(words.faults, corners);
        };
        corners.extend(triangles(panel));
    }
    body(words.faults, corners)
}
