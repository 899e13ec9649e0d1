//! What a design file says: the values of the known keys with their places.

use std::collections::HashSet;
use std::ops::Range;

use toml::de::{DeTable, DeValue};

use super::diagnostic::{Diagnostic, Severity, quoted};

use super::keys::{KEYS, Key, REMOVED, RENAMED};
use crate::units::{LineStarts, counted};

/// Files longer than this are not design files \[bytes\].
pub(super) const LARGEST: usize = 1 << 20;

/// Of more problems than these only the number is reported.
const MOST_PROBLEMS: usize = 50;

/// Words longer than this are misprints of no key.
const LONGEST_WORD: usize = 60;

/// A value as it stands in the file.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Raw {
    /// A string.
    Text(String),
    /// A whole or decimal number.
    Number(f64),
    /// true or false.
    Switch(bool),
    /// A date.
    Other(&'static str),
    /// An array with the place of each item.
    Array(Vec<(Raw, Range<usize>)>),
    /// A table, usually inline.
    Table(Vec<(String, Raw, Range<usize>)>),
}

impl Raw {
    /// The words for messages, with the value where it is short.
    pub(super) fn describe(&self) -> String {
        match self {
            Self::Text(text) if text.chars().count() <= 40 => format!("\"{text}\""),
            Self::Text(_) => "a long text".into(),
            Self::Number(value) => format!("{value}"),
            Self::Switch(_) => "a boolean".into(),
            Self::Other(kind) => format!("a {kind}"),
            Self::Array(items) => format!("a list of {}", items.len()),
            Self::Table(_) => "a table".into(),
        }
    }
}

/// One known key of the file.
#[derive(Debug)]
pub(super) struct Entry {
    pub(super) key: &'static Key,
    pub(super) value: Raw,
    /// Bytes of the value.
    pub(super) span: Range<usize>,
    /// Bytes of the key.
    pub(super) key_span: Range<usize>,
}

/// A design file: its known keys, and the messages about it so far.
pub(super) struct Document<'a> {
    pub(super) file: &'a str,
    pub(super) text: &'a str,
    lines: LineStarts,
    /// The keys that such a file has.
    keys: &'static [Key],
    /// What such a file is, "a design".
    pub(super) noun: &'static str,
    pub(super) entries: Vec<Entry>,
    /// Tables that the file opens, by their path in lower case, with the byte where their name stands.
    pub(super) tables: Vec<(String, usize)>,
    /// The first problems, at most [`MOST_PROBLEMS`] with a place.
    pub(super) problems: Vec<Diagnostic>,
    /// Problems beyond these.
    more: usize,
}

fn raw(value: &DeValue<'_>) -> Raw {
    match value {
        DeValue::String(text) => Raw::Text(text.to_string()),
        DeValue::Integer(number) => {
            let digits = number.as_str();
            i128::from_str_radix(digits, number.radix()).map_or(Raw::Number(f64::INFINITY), |n| Raw::Number(n as f64))
        }
        DeValue::Float(number) => Raw::Number(number.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Array(items) => Raw::Array(items.iter().map(|v| (raw(v.get_ref()), v.span())).collect()),
        DeValue::Table(table) => Raw::Table(
            table
                .iter()
                .map(|(k, v)| (k.get_ref().to_string(), raw(v.get_ref()), k.span().start..v.span().end))
                .collect(),
        ),
        DeValue::Boolean(value) => Raw::Switch(*value),
        other => Raw::Other(other.type_str()),
    }
}

/// The candidate nearest to `word` by edit distance with swaps, when it is near: one edit, and one more for every three
/// letters; or when one begins with the other.
pub(super) fn nearest<'c>(word: &str, candidates: impl Iterator<Item = &'c str>) -> Option<&'c str> {
    if word.len() > LONGEST_WORD {
        return None;
    }
    let word = word.to_lowercase();
    let allowed = 1 + word.chars().count() / 3;
    let distance = |candidate: &str| match strsim::osa_distance(&word, candidate) {
        _ if word.len() >= 4 && (candidate.starts_with(&word) || word.starts_with(candidate)) => 1,
        distance => distance,
    };
    candidates
        .map(|candidate| (distance(&candidate.to_lowercase()), candidate))
        .filter(|(distance, _)| *distance <= allowed && *distance < word.chars().count())
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

impl<'a> Document<'a> {
    /// Reads the text of a design; whatever is wrong with it stands in `problems`.
    pub(super) fn read(file: &'a str, text: &'a str) -> Self {
        Self::with_keys(file, text, KEYS, "a design")
    }

    /// Reads the text of a file with `keys`, which is `noun` in messages.
    pub(super) fn with_keys(file: &'a str, text: &'a str, keys: &'static [Key], noun: &'static str) -> Self {
        let (entries, tables, problems, lines) = (Vec::new(), Vec::new(), Vec::new(), LineStarts::new(text));
        let mut document = Self { file, text, lines, keys, noun, entries, tables, problems, more: 0 };
        if text.len() > LARGEST {
            document
                .whole_file("E120", format!("the file has {} bytes; {noun} file has at most {LARGEST}", text.len()));
            return document;
        }
        let (table, errors) = DeTable::parse_recoverable(text);
        let mut seen = HashSet::new();
        for error in &errors {
            let span = error.span().unwrap_or(text.len()..text.len());
            // A second message about a line is an echo of the first.
            if seen.insert(document.lines.line(span.start)) {
                let help = if document.is_full() { String::new() } else { document.syntax_help(&span) };
                document.problem("E120", "", &span, format!("not TOML: {}", error.message()), help);
            }
        }
        if !errors.is_empty() {
            // What was recovered is a guess; messages about it would hide the cause.
            return document;
        }
        document.walk("", table.get_ref());
        document.entries.sort_by_key(|entry| entry.key_span.start);
        document
    }

    /// What usually stands behind a syntax error on a line.
    fn syntax_help(&self, span: &Range<usize>) -> String {
        let line = self.lines.text(self.text, self.lines.line(span.start));
        let line = line.split('#').next().unwrap_or("");
        let Some((_, value)) = line.split_once('=') else { return String::new() };
        let value = value.trim();
        if let Some((whole, decimals)) = value.split_once(',')
            && !value.starts_with(['[', '{', '"', '\''])
            && whole.trim().parse::<i64>().is_ok()
            && decimals.starts_with(|c: char| c.is_ascii_digit())
        {
            return format!("A decimal comma? Write {}.{}.", whole.trim(), decimals.trim());
        }
        if value.starts_with(|c: char| c.is_ascii_alphabetic() || c.is_ascii_digit() || c == '+' || c == '-') {
            return format!("Words, and numbers with units, stand in quotes: \"{value}\".");
        }
        String::new()
    }

    /// Takes the keys of one table, and of the tables in it.
    fn walk(&mut self, path: &str, table: &DeTable<'_>) {
        let mut items: Vec<_> = table.iter().collect();
        items.sort_by_key(|(name, _)| name.span().start);
        for (name, value) in items {
            let full = if path.is_empty() { name.get_ref().to_string() } else { format!("{path}.{}", name.get_ref()) };
            let lower = full.to_lowercase();
            let renamed = |(_, new): &&(&str, &str)| self.keys.iter().any(|k| k.path() == *new);
            let mut renamed = RENAMED.iter().filter(renamed);
            let is_table = self.keys.iter().any(|k| under(k.table, &lower))
                || renamed.clone().any(|(old, _)| old.rsplit_once('.').is_some_and(|(table, _)| table == lower));
            let path_now = renamed.find(|(old, _)| *old == lower).map_or(lower.clone(), |(_, new)| (*new).to_owned());
            let known = self.keys.iter().find(|k| k.path().to_lowercase() == path_now);
            match (value.get_ref(), known) {
                (DeValue::Table(inner), None) if is_table => {
                    self.tables.push((lower.clone(), name.span().start));
                    self.walk(&lower, inner);
                }
                (other, None) if is_table => {
                    let found = raw(other).describe();
                    self.problem(
                        "E122",
                        &full,
                        &value.span(),
                        format!("{full} is {found}, expected a table"),
                        format!("Write [{lower}] on its own line."),
                    );
                }
                (value_ref, Some(key)) => {
                    if let Some(first) = self.entries.iter().find(|e| e.key.path() == key.path()) {
                        let line = self.lines.line(first.key_span.start);
                        self.problem(
                            "E126",
                            &full,
                            &name.span(),
                            format!("{full} is written a second time; it stands in line {line}"),
                            "Upper and lower case are the same key.".into(),
                        );
                        continue;
                    }
                    self.entries.push(Entry { key, value: raw(value_ref), span: value.span(), key_span: name.span() });
                }
                (_, None) => self.unknown(path, name.get_ref(), &full, &name.span()),
            }
        }
    }

    fn unknown(&mut self, path: &str, name: &str, full: &str, span: &Range<usize>) {
        if self.is_full() {
            self.more += 1;
            return;
        }
        let removed = REMOVED.iter().filter(|(old, _)| old.eq_ignore_ascii_case(full));
        let mut served = removed.filter_map(|(_, new)| self.keys.iter().find(|key| key.path() == *new));
        if let Some(key) = served.next() {
            let help = format!("Give {} instead: {}", key.path(), key.description);
            self.problem("E121", full, span, format!("{full} was removed"), help);
            return;
        }
        let here = self.keys.iter().filter(|k| k.table.to_lowercase() == path).map(|k| k.name);
        let tables = self.keys.iter().flat_map(|k| k.table.split('.')).filter(|word| !word.is_empty());
        let elsewhere = self.keys.iter().find(|k| k.name.eq_ignore_ascii_case(name));
        let help = if let Some(key) = elsewhere {
            if key.table.is_empty() {
                format!("{} stands at the top of the file.", key.name)
            } else {
                format!("{} belongs to [{}].", key.name, key.table)
            }
        } else if let Some(near) = nearest(name, here.clone().chain(tables)) {
            format!("Did you mean {near}?")
        } else if let Some(near) = nearest(name, self.keys.iter().map(|k| k.name)) {
            let table = self.keys.iter().find(|k| k.name == near).map_or("", |k| k.table);
            format!("Did you mean {near} of [{table}]?")
        } else {
            let mut names: Vec<String> = here.map(str::to_owned).collect();
            for key in self.keys.iter().filter(|k| !k.table.is_empty()) {
                let inside = match path {
                    "" => Some(key.table),
                    _ => key.table.strip_prefix(path).and_then(|rest| rest.strip_prefix('.')),
                };
                let child = inside.and_then(|rest| rest.split('.').next());
                let shown = child.map(|c| if path.is_empty() { format!("[{c}]") } else { format!("[{path}.{c}]") });
                names.extend(shown.filter(|shown| !names.contains(shown)));
            }
            if names.is_empty() {
                "`loftsman schema` lists all keys.".into()
            } else {
                format!("Known here: {}.", names.join(", "))
            }
        };
        self.problem("E121", full, span, format!("{full} is not a key of {}", self.noun), help);
    }

    /// The entry of a key, by its path as in the list of keys.
    pub(super) fn entry(&self, path: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.key.path() == path)
    }

    /// Line and column, both from 1, of a byte.
    pub(super) fn position(&self, byte: usize) -> (usize, usize) {
        self.lines.position(self.text, byte)
    }

    /// Whether further problems are only counted.
    fn is_full(&self) -> bool {
        self.problems.len() >= MOST_PROBLEMS
    }

    /// The problems in the order of the file, and how many more there are.
    pub(super) fn finish(mut self) -> Vec<Diagnostic> {
        self.problems.sort_by_key(|p| (p.line.unwrap_or(0), p.column.unwrap_or(0)));
        self.problems.dedup();
        if self.more > 0 {
            let message = format!("{} not shown", counted(self.more, "more problem"));
            self.whole_file("E131", message);
        }
        self.problems
    }

    /// Notes a problem at a place of the file.
    pub(super) fn problem(
        &mut self,
        code: &'static str,
        key: &str,
        span: &Range<usize>,
        message: String,
        help: String,
    ) {
        if self.is_full() {
            self.more += 1;
            return;
        }
        let (line, column) = self.position(span.start);
        self.problems.push(Diagnostic {
            severity: Severity::Error,
            code,
            file: self.file.to_owned(),
            line: Some(line),
            column: Some(column),
            key: key.to_owned(),
            message,
            found: quoted(self.text, span),
            help,
        });
    }

    /// Notes a problem of the whole file.
    pub(super) fn whole_file(&mut self, code: &'static str, message: String) {
        self.problems.push(Diagnostic {
            severity: Severity::Error,
            code,
            file: self.file.to_owned(),
            line: None,
            column: None,
            key: String::new(),
            message,
            found: String::new(),
            help: String::new(),
        });
    }
}

/// Whether `table` is the table `path` or lies in it.
fn under(table: &str, path: &str) -> bool {
    let table = table.to_lowercase();
    table == path || table.strip_prefix(path).is_some_and(|rest| rest.starts_with('.'))
}

/// Notes the required keys that are absent.
pub(super) fn require(document: &mut Document<'_>, paths: &[&str], why: &str) {
    let missing: Vec<&str> = paths.iter().filter(|path| document.entry(path).is_none()).copied().collect();
    if !missing.is_empty() {
        document.whole_file("E125", format!("{} missing: {why}", missing.join(", ")));
    }
}
