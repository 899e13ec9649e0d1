//! The TOML file beside a table.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::TableProblem;
use super::problem::{Field, Problems};
use super::ratio::slot;
use super::settings::{KEYS, Settings, Value, length, nearest};
use crate::hull::{FeatureLine, LineKind, StatedParticulars, TransomPlane};
use crate::units::{LineStarts, counted};

/// Longer files are no conventions \[bytes\].
const LARGEST: usize = 1 << 20;
/// The tables of the file.
const TABLES: [&str; 5] = ["table", "dimensions", "endings", "transom", "line"];
/// The keys of `[dimensions]`, which `[table]` has as well.
const DIMENSIONS: [&str; 4] = ["Lpp", "B", "T", "D"];
/// Where the main dimensions of a table of fractions may stand, besides the top of the file.
const PARTICULARS: [&str; 3] = ["table", "particulars", "dimensions"];

struct Sidecar<'a> {
    file: &'a str,
    text: &'a str,
    lines: LineStarts,
    problems: &'a mut Problems,
}

/// Reads the conventions of the file `name` with the contents `text`. A file that has none of our tables, or beside
/// `[dimensions]` others, as a design or a job of the same name, is left alone with a note.
pub(super) fn read(name: &str, text: &str, settings: &mut Settings, problems: &mut Problems) {
    let mut sidecar = Sidecar { file: name, text, lines: LineStarts::new(text), problems };
    let Some(document) = sidecar.document() else { return };
    let names: Vec<&str> = document.get_ref().keys().map(|key| key.get_ref().as_ref()).collect();
    let is_job = |value: &DeValue<'_>| matches!(value, DeValue::Table(table) if table.contains_key("file"));
    if document.get_ref().get("table").is_some_and(|table| is_job(table.get_ref())) {
        return sidecar.problems.note(format!("{name} beside the table is a job and has none of its conventions"));
    }
    let near = |name: &str| nearest(name, TABLES.into_iter());
    let is_key = |name: &str| KEYS.iter().any(|known| known.eq_ignore_ascii_case(name));
    // A file of nothing but keys lacks their heading; a design has tables of its own.
    let bare = names.iter().any(|name| is_key(name))
        && document.get_ref().values().all(|value| !matches!(value.get_ref(), DeValue::Table(_) | DeValue::Array(_)));
    let ours = |name: &&str| TABLES.iter().any(|t| t.eq_ignore_ascii_case(name)) || near(name).is_some();
    let dimensions = |name: &&str| name.eq_ignore_ascii_case("dimensions");
    // A design and a job have [dimensions] too, and tables of their own.
    let only_dimensions = names.iter().any(dimensions) && names.iter().all(ours);
    if !bare && !only_dimensions && !names.iter().filter(|name| !dimensions(name)).any(ours) {
        let message = format!(
            "{name} beside the table has no [table], [endings], [transom] or [[line]], nor [dimensions] alone, and is not read"
        );
        return sidecar.problems.note(message);
    }
    for (key, value) in document.get_ref() {
        let (own, span) = (key.get_ref().as_ref(), key.span());
        let key = TABLES.iter().find(|known| known.eq_ignore_ascii_case(own)).copied().unwrap_or(own);
        match (key, value.get_ref()) {
            ("table", DeValue::Table(table)) => sidecar.table(table, &KEYS, settings),
            ("dimensions", DeValue::Table(table)) => {
                sidecar.once(table, document.get_ref());
                sidecar.table(table, &DIMENSIONS, settings);
            }
            ("endings", DeValue::Table(table)) => sidecar.endings(table, settings),
            ("transom", DeValue::Table(table)) => sidecar.transom(table, settings),
            ("line", DeValue::Array(lines)) => {
                for line in lines {
                    match line.get_ref() {
                        DeValue::Table(table) => sidecar.line(table, &line.span(), settings),
                        other => {
                            sidecar.problem(key, &line.span(), format!("{}, expected a table", other.type_str()), "")
                        }
                    }
                }
            }
            ("line", _) => sidecar.problem(key, &span, "one line".to_owned(), "Write [[line]] with two brackets"),
            (known, other) if TABLES.contains(&known) => {
                sidecar.problem(
                    key,
                    &span,
                    format!("{}, expected a table", other.type_str()),
                    &format!("Write [{known}]"),
                );
            }
            _ if is_key(key) => {
                let message = "stands outside [table]".to_owned();
                sidecar.problem(key, &span, message, "Put it below a line [table]");
            }
            _ => {
                let remedy = near(key).map_or_else(
                    || format!("Known are [{}]", TABLES.join("], [")),
                    |near| format!("Did you mean [{near}]?"),
                );
                sidecar.problem(key, &span, "not a table of conventions".to_owned(), &remedy);
            }
        }
    }
}

/// Main dimensions of a TOML beside a table: `lpp`, `beam`, `draught`, `depth` (and `L`, `lbp`, `B`, `T`, `draft`, `D`)
/// at its top or in `[table]`, `[particulars]` or `[dimensions]`; numbers in metres, or texts with a unit. Other keys
/// are not looked at.
///
/// # Errors
/// A text that is no TOML, and values that are no lengths, each with its place (E311).
pub fn read_particulars(name: &str, text: &str) -> Result<StatedParticulars, Vec<TableProblem>> {
    let mut problems = Problems::new(name);
    let mut sidecar = Sidecar { file: name, text, lines: LineStarts::new(text), problems: &mut problems };
    let mut stated = StatedParticulars::default();
    if let Some(document) = sidecar.document() {
        sidecar.dimensions(document.get_ref(), &mut stated);
        for inner in PARTICULARS.iter().filter_map(|key| document.get_ref().get(*key)) {
            if let DeValue::Table(table) = inner.get_ref() {
                sidecar.dimensions(table, &mut stated);
            }
        }
    }
    problems.finish().map(|_| stated)
}

/// What a key is set to.
fn content(value: &DeValue<'_>) -> Value {
    match value {
        DeValue::String(text) => Value::Text(text.to_string()),
        other => number(other).map_or(Value::Other(other.type_str()), Value::Number),
    }
}

fn number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Integer(n) => i128::from_str_radix(n.as_str(), n.radix()).ok().map(|n| n as f64),
        DeValue::Float(n) => n.as_str().parse().ok().filter(|n: &f64| n.is_finite()),
        _ => None,
    }
}

impl<'a> Sidecar<'a> {
    /// The document of the text; none, with a problem, when it is too long or not TOML.
    fn document(&mut self) -> Option<Spanned<DeTable<'a>>> {
        if self.text.len() > LARGEST {
            let message = format!("{} bytes; conventions have at most {LARGEST}", self.text.len());
            self.problem("", &(0..0), message, "");
            return None;
        }
        match DeTable::parse(self.text) {
            Ok(document) => Some(document),
            Err(error) => {
                let span = error.span().unwrap_or(0..0);
                self.problem("", &span, format!("not TOML: {}", error.message()), "");
                None
            }
        }
    }

    /// The main dimensions among the keys of a table.
    fn dimensions(&mut self, table: &DeTable<'_>, stated: &mut StatedParticulars) {
        for (key, value) in table.iter().filter(|(_, value)| !matches!(value.get_ref(), DeValue::Table(_))) {
            let name = key.get_ref().as_ref();
            let Some(slot) = slot(stated, name) else { continue };
            match length(name, &content(value.get_ref())) {
                Ok(length) => *slot = Some(length),
                Err((message, remedy)) => self.problem(name, &value.span(), message, &remedy),
            }
        }
    }

    fn problem(&mut self, found: &str, span: &Range<usize>, message: String, remedy: &str) {
        let (row, column) = self.lines.position(self.text, span.start);
        let field = Field { text: found.to_owned(), row, column };
        self.problems.error_in(self.file, &field, message, remedy);
    }

    fn unknown(&mut self, key: &str, span: &Range<usize>, known: &[&str]) {
        let near = nearest(key, known.iter().copied());
        let remedy =
            near.map_or_else(|| format!("Known are {}", known.join(", ")), |near| format!("Did you mean {near}?"));
        self.problem(key, span, "not a key of the conventions".to_owned(), &remedy);
    }

    /// Refuses a dimension that `[table]` of the document has as well.
    fn once(&mut self, dimensions: &DeTable<'_>, document: &DeTable<'_>) {
        let is_table = |name: &str| name.eq_ignore_ascii_case("table");
        let tables = document.iter().filter(|(key, _)| is_table(key.get_ref().as_ref()));
        let keys: Vec<&str> = tables
            .filter_map(|(_, value)| match value.get_ref() {
                DeValue::Table(table) => Some(table.keys().map(|key| key.get_ref().as_ref())),
                _ => None,
            })
            .flatten()
            .collect();
        for key in dimensions.keys() {
            let name = key.get_ref().as_ref();
            if keys.iter().any(|other| other.eq_ignore_ascii_case(name)) {
                let message = "stands in [table] and in [dimensions]".to_owned();
                self.problem(name, &key.span(), message, "Give it once");
            }
        }
    }

    /// A table of the `keys` that it may have.
    fn table(&mut self, table: &DeTable<'_>, keys: &[&str], settings: &mut Settings) {
        for (key, value) in table {
            let name = key.get_ref().as_ref();
            let Some(known) = keys.iter().find(|k| k.eq_ignore_ascii_case(name)) else {
                self.unknown(name, &key.span(), keys);
                continue;
            };
            if let Err((message, remedy)) = settings.set(known, &content(value.get_ref())) {
                self.problem(name, &value.span(), message, &remedy);
            }
        }
    }

    /// A list of points of `N` numbers.
    fn points<const N: usize>(&mut self, key: &str, value: &DeValue<'_>, span: &Range<usize>) -> Vec<[f64; N]> {
        let point = |item: &DeValue<'_>| match item {
            DeValue::Array(numbers) if numbers.len() == N => {
                let mut point = [0.0; N];
                for (slot, n) in point.iter_mut().zip(numbers) {
                    *slot = number(n.get_ref())?;
                }
                Some(point)
            }
            _ => None,
        };
        let list: Option<Vec<[f64; N]>> = match value {
            DeValue::Array(items) => items.iter().map(|item| point(item.get_ref())).collect(),
            _ => None,
        };
        list.unwrap_or_else(|| {
            self.problem(key, span, format!("expected a list of points of {N} numbers"), "");
            Vec::new()
        })
    }

    fn endings(&mut self, table: &DeTable<'_>, settings: &mut Settings) {
        for (key, value) in table {
            let name = key.get_ref().to_ascii_lowercase();
            let name = name.as_str();
            match name {
                "stern" => settings.endings[0] = self.points(name, value.get_ref(), &value.span()),
                "stem" => settings.endings[1] = self.points(name, value.get_ref(), &value.span()),
                _ => self.unknown(name, &key.span(), &["stern", "stem"]),
            }
        }
    }

    fn transom(&mut self, table: &DeTable<'_>, settings: &mut Settings) {
        let mut plane = TransomPlane { x_base: 0.0, slope: 0.0 };
        let mut placed = false;
        for (key, value) in table {
            let name = key.get_ref().to_ascii_lowercase();
            let name = name.as_str();
            let content = number(value.get_ref());
            match (name, content) {
                ("x", Some(x)) => (plane.x_base, placed) = (x, true),
                ("slope", Some(slope)) => plane.slope = slope,
                ("x" | "slope", None) => self.problem(name, &value.span(), "expected a number".to_owned(), ""),
                _ => self.unknown(name, &key.span(), &["x", "slope"]),
            }
        }
        if placed {
            settings.transom = Some(plane);
        } else {
            self.problem(
                "transom",
                &(0..0),
                "a transom without x".to_owned(),
                "Write x = where it meets the base line",
            );
        }
    }

    fn line(&mut self, table: &DeTable<'_>, span: &Range<usize>, settings: &mut Settings) {
        let mut line = FeatureLine { name: String::new(), kind: LineKind::Knuckle, points: Vec::new() };
        for (key, value) in table {
            let name = key.get_ref().to_ascii_lowercase();
            let name = name.as_str();
            match (name, value.get_ref()) {
                ("name", DeValue::String(text)) => line.name = text.to_string(),
                ("kind", DeValue::String(text)) if text.as_ref() == "knuckle" => line.kind = LineKind::Knuckle,
                ("kind", DeValue::String(text)) if text.as_ref() == "tangent" => line.kind = LineKind::Tangent,
                ("kind", _) => self.problem(name, &value.span(), "expected knuckle or tangent".to_owned(), ""),
                ("points", points) => line.points = self.points(name, points, &value.span()),
                ("name", _) => self.problem(name, &value.span(), "expected a text".to_owned(), ""),
                _ => self.unknown(name, &key.span(), &["name", "kind", "points"]),
            }
        }
        if line.points.len() < 2 {
            self.problem(
                "line",
                span,
                format!("a line of {}", counted(line.points.len(), "point")),
                "Give two points at least",
            );
        } else {
            line.points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            settings.lines.push(line);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Severity;
    use super::*;

    #[test]
    fn particulars_beside_a_table() {
        let text = "name = 'a'\n[particulars]\nlpp = 121.92\nbeam = 16\ndraught = \"21 ft 4 in\"\nl_over_b = 7.5\n";
        let stated = read_particulars("a.toml", text).unwrap();
        assert_eq!(stated.length_between_perpendiculars, Some(121.92));
        assert_eq!(stated.breadth, Some(16.0));
        assert!((stated.draught.unwrap() - 6.5024).abs() < 1e-12);
        assert_eq!(read_particulars("a.toml", "[table]\nT = 6.5\n").unwrap().draught, Some(6.5));
        let problems = read_particulars("a.toml", "lpp = -1\nB = 'x'\n").unwrap_err();
        assert!(problems.iter().all(|p| p.code == "E311" && p.severity == Severity::Error));
        let rows: Vec<_> = problems.iter().map(|p| (p.row, p.found.as_str())).collect();
        assert_eq!(rows, [(Some(1), "lpp"), (Some(2), "B")]);
        let problems = read_particulars("a.toml", "a = 1\nb = = 2\n").unwrap_err();
        assert_eq!((problems[0].code, problems[0].row), ("E311", Some(2)));
    }
}
