//! The groups of a DXF file, each a code and a value: pairs of lines of a text, or bytes.
//!
//! A record is a group of code 0 and those up to the next. Cost: linear in the file, and the memory is that of one
//! record, of [`MOST_GROUPS`] groups at most.

use std::borrow::Cow;

use super::super::super::fault::{Faults, LARGEST};

/// The first bytes of a binary file.
const SENTINEL: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";

/// Groups of a record at most: the vertices of a polyline are two or three each.
const MOST_GROUPS: usize = 8_000_000;

/// Lines of comments before the first section that are looked at.
const COMMENTS: usize = 200;

/// The value of a group.
#[derive(Debug, Clone, Copy)]
enum Value<'a> {
    Text(&'a [u8]),
    Real(f64),
    Whole(i64),
}

/// A group.
#[derive(Debug, Clone, Copy)]
pub(super) struct Group<'a> {
    pub(super) code: i32,
    /// Line of its value; 0 in binary files.
    line: u32,
    value: Value<'a>,
}

/// Bytes as text: UTF-8, or else each byte the character of its number.
fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    let bytes = bytes.trim_ascii();
    std::str::from_utf8(bytes).map_or_else(|_| bytes.iter().map(|&b| b as char).collect(), Cow::Borrowed)
}

impl Group<'_> {
    pub(super) fn text(&self) -> Cow<'_, str> {
        match self.value {
            Value::Text(bytes) => decoded(bytes),
            Value::Real(value) => value.to_string().into(),
            Value::Whole(value) => value.to_string().into(),
        }
    }

    pub(super) fn place(&self) -> Option<usize> {
        (self.line > 0).then_some(self.line as usize)
    }

    /// A number that a coordinate may be; 0, with a fault, when it is none.
    pub(super) fn real(&self, faults: &mut Faults) -> f64 {
        let value = match self.value {
            Value::Real(value) => Some(value),
            Value::Whole(value) => Some(value as f64),
            Value::Text(bytes) => decoded(bytes).parse().ok(),
        };
        match value.filter(|value: &f64| value.abs() <= LARGEST) {
            Some(value) => value,
            None => {
                let message = format!("group {}: expected a number of at most 1e8", self.code);
                faults.add(self.place(), &self.text(), message);
                0.0
            }
        }
    }

    /// A whole number; 0, with a fault, when it is none.
    pub(super) fn whole(&self, faults: &mut Faults) -> i64 {
        let value = match self.value {
            Value::Whole(value) => Some(value),
            Value::Real(value) => (value.fract().abs() <= 0.0 && value.abs() < 1e15).then_some(value as i64),
            Value::Text(bytes) => decoded(bytes).parse().ok(),
        };
        value.unwrap_or_else(|| {
            faults.add(self.place(), &self.text(), format!("group {}: expected a whole number", self.code));
            0
        })
    }
}

/// An object of the file: its groups, the first of which has code 0 and names its kind.
#[derive(Debug, Default)]
pub(super) struct Record<'a> {
    pub(super) groups: Vec<Group<'a>>,
}

impl<'a> Record<'a> {
    pub(super) fn kind(&self) -> Cow<'_, str> {
        self.groups.first().map_or(Cow::Borrowed(""), Group::text)
    }

    /// Line where it begins.
    pub(super) fn line(&self) -> Option<usize> {
        self.groups.first().and_then(Group::place)
    }

    pub(super) fn get(&self, code: i32) -> Option<&Group<'a>> {
        self.groups.iter().find(|group| group.code == code)
    }

    pub(super) fn text(&self, code: i32) -> Cow<'_, str> {
        self.get(code).map_or(Cow::Borrowed(""), Group::text)
    }

    /// A number, or what holds where there is none.
    pub(super) fn real(&self, code: i32, otherwise: f64, faults: &mut Faults) -> f64 {
        self.get(code).map_or(otherwise, |group| group.real(faults))
    }

    pub(super) fn whole(&self, code: i32, faults: &mut Faults) -> i64 {
        self.get(code).map_or(0, |group| group.whole(faults))
    }

    /// A point of the groups `code`, `code + 10` and `code + 20`.
    pub(super) fn point(&self, code: i32, faults: &mut Faults) -> Option<[f64; 3]> {
        self.get(code)?;
        Some([0, 10, 20].map(|step| self.real(code + step, 0.0, faults)))
    }

    /// The points of all groups `code`, each with the groups `code + 10` and `code + 20` that follow it.
    pub(super) fn points(&self, code: i32, faults: &mut Faults) -> Vec<[f64; 3]> {
        let mut points: Vec<[f64; 3]> = Vec::new();
        for group in &self.groups {
            if group.code == code {
                points.push([group.real(faults), 0.0, 0.0]);
            } else if let Some(last) = points.last_mut() {
                if group.code == code + 10 {
                    last[1] = group.real(faults);
                } else if group.code == code + 20 {
                    last[2] = group.real(faults);
                }
            }
        }
        points
    }

    /// All numbers of a code.
    pub(super) fn reals(&self, code: i32, faults: &mut Faults) -> Vec<f64> {
        self.groups.iter().filter(|group| group.code == code).map(|group| group.real(faults)).collect()
    }
}

/// How values stand in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Coding {
    Text,
    /// Codes of so many bytes.
    Bytes(usize),
}

/// The records of a file in turn.
pub(super) struct Records<'a> {
    bytes: &'a [u8],
    at: usize,
    line: u32,
    /// What ends a line.
    end: u8,
    coding: Coding,
    /// The group that begins the next record.
    next: Option<Group<'a>>,
}

impl<'a> Records<'a> {
    pub(super) fn of(bytes: &'a [u8]) -> Self {
        let (coding, at) = match bytes.strip_prefix(SENTINEL) {
            // Files of R12 have codes of one byte.
            Some([0, 0, ..]) => (Coding::Bytes(2), SENTINEL.len()),
            Some(_) => (Coding::Bytes(1), SENTINEL.len()),
            None => (Coding::Text, if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 }),
        };
        let end = if bytes.iter().take(4096).any(|&b| b == b'\n') { b'\n' } else { b'\r' };
        Self { bytes, at, line: 0, end, coding, next: None }
    }

    /// The comments before the first record; none of them where a binary file has no group of code 0.
    pub(super) fn comments(&mut self, faults: &mut Faults) -> Vec<Cow<'a, str>> {
        let mut comments = Vec::new();
        while let Some(group) = self.group(faults) {
            if group.code == 0 {
                self.next = Some(group);
                break;
            }
            if let Value::Text(bytes) = group.value
                && comments.len() < COMMENTS
            {
                comments.push(decoded(bytes));
            }
        }
        comments
    }

    /// The next record into one that is reused; whether there is one.
    pub(super) fn read(&mut self, record: &mut Record<'a>, faults: &mut Faults) -> bool {
        record.groups.clear();
        let Some(first) = self.next.take() else { return false };
        record.groups.push(first);
        while let Some(group) = self.group(faults) {
            if group.code == 0 {
                self.next = Some(group);
                break;
            }
            if record.groups.len() >= MOST_GROUPS {
                faults.add(record.line(), &record.kind(), format!("more than {MOST_GROUPS} groups"));
                return false;
            }
            record.groups.push(group);
        }
        true
    }

    fn group(&mut self, faults: &mut Faults) -> Option<Group<'a>> {
        match self.coding {
            Coding::Text => self.text_group(faults),
            Coding::Bytes(width) => {
                if self.at >= self.bytes.len() {
                    return None;
                }
                let group = self.byte_group(width);
                if group.is_none() {
                    faults.add(None, &format!("byte {}", self.at), "the file ends within a group".to_owned());
                }
                group
            }
        }
    }

    fn line(&mut self) -> Option<&'a [u8]> {
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        let length = rest.iter().position(|&b| b == self.end).unwrap_or(rest.len());
        self.at += length + 1;
        self.line = self.line.saturating_add(1);
        Some(&rest[..length])
    }

    fn text_group(&mut self, faults: &mut Faults) -> Option<Group<'a>> {
        let written = self.line()?;
        let code = std::str::from_utf8(written).ok().and_then(|text| text.trim().parse().ok());
        let Some(code) = code else {
            // Blanks after the end.
            if !(written.trim_ascii().is_empty() && self.bytes[self.at.min(self.bytes.len())..].trim_ascii().is_empty())
            {
                let message = "expected a group code, a whole number".to_owned();
                faults.add(Some(self.line as usize), &decoded(written), message);
            }
            return None;
        };
        let Some(value) = self.line() else {
            let message = "the file ends after this group code, expected its value".to_owned();
            faults.add(Some(self.line as usize), &decoded(written), message);
            return None;
        };
        Some(Group { code, line: self.line, value: Value::Text(value) })
    }

    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let bytes = self.bytes.get(self.at..self.at.checked_add(count)?)?;
        self.at += count;
        Some(bytes)
    }

    /// A whole number of so many bytes, the least first.
    fn bytes_whole(&mut self, count: usize) -> Option<i64> {
        let bytes = self.take(count)?;
        let shift = 64 - 8 * count as u32;
        let all = bytes.iter().rev().fold(0_u64, |sum, &b| sum << 8 | u64::from(b));
        Some((all << shift).cast_signed() >> shift)
    }

    fn byte_group(&mut self, width: usize) -> Option<Group<'a>> {
        let mut code = if width == 2 { self.bytes_whole(2)? } else { i64::from(self.take(1)?[0]) };
        if width == 1 && code == 255 {
            code = self.bytes_whole(2)?;
        }
        let value = match code {
            10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => {
                let bytes = self.take(8)?;
                Value::Real(f64::from_le_bytes(bytes.try_into().ok()?))
            }
            60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => Value::Whole(self.bytes_whole(2)?),
            90..=99 | 420..=429 | 440..=459 | 1071 => Value::Whole(self.bytes_whole(4)?),
            160..=169 => Value::Whole(self.bytes_whole(8)?),
            290..=299 => Value::Whole(self.bytes_whole(1)?),
            310..=319 | 1004 => {
                let count = usize::from(self.take(1)?[0]);
                Value::Text(self.take(count)?)
            }
            _ => {
                let rest = &self.bytes[self.at..];
                let length = rest.iter().position(|&b| b == 0)?;
                self.at += length + 1;
                Value::Text(&rest[..length])
            }
        };
        Some(Group { code: i32::try_from(code).ok()?, line: 0, value })
    }
}

/// Whether these are the first bytes of a DXF file: those of a binary one, or comments and the group 0 SECTION.
pub(in super::super::super) fn is_dxf(bytes: &[u8]) -> bool {
    if bytes.starts_with(SENTINEL) {
        return true;
    }
    let mut records = Records::of(&bytes[..bytes.len().min(64 * 1024)]);
    let mut faults = Faults::default();
    loop {
        match records.group(&mut faults) {
            Some(Group { code: 999, .. }) => {}
            Some(group) => return group.code == 0 && group.text() == "SECTION",
            None => return false,
        }
    }
}
