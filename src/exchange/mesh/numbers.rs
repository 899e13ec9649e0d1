//! Numbers of mesh files, one after the other: words of a text, or bytes of either order.

use super::super::fault::{Faults, LARGEST};

/// How the numbers of a file are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Coding {
    Text,
    LittleEndian,
    BigEndian,
}

/// Kinds of numbers, with the bytes of each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Signed(usize),
    Unsigned(usize),
    Real(usize),
}

/// A whole number of 4 bytes, and a real of 8.
pub(super) const INTEGER: Kind = Kind::Signed(4);
pub(super) const DOUBLE: Kind = Kind::Real(8);

impl Kind {
    pub(super) fn bytes(self) -> usize {
        let (Self::Signed(bytes) | Self::Unsigned(bytes) | Self::Real(bytes)) = self;
        bytes
    }

    /// The number that stands in at most 8 bytes, the least significant first.
    pub(super) fn value(self, bytes: &[u8]) -> f64 {
        let bits = bytes.iter().rev().fold(0_u64, |sum, &byte| sum << 8 | u64::from(byte));
        match self {
            Self::Real(4) => f64::from(f32::from_bits(bits as u32)),
            Self::Real(_) => f64::from_bits(bits),
            Self::Unsigned(_) => bits as f64,
            Self::Signed(bytes) => {
                let shift = 64 - 8 * bytes.clamp(1, 8);
                ((bits << shift).cast_signed() >> shift) as f64
            }
        }
    }
}

/// The numbers of a file, and what is wrong with them. In a text, what follows `!` or `#` in a line is a comment.
pub(super) struct Numbers<'a> {
    bytes: &'a [u8],
    at: usize,
    /// The line of the next byte, from 1.
    line: usize,
    /// The line of the word read last.
    last: usize,
    pub(super) coding: Coding,
    pub(super) faults: Faults,
}

impl<'a> Numbers<'a> {
    pub(super) fn of(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, line: 1, last: 1, coding: Coding::Text, faults: Faults::default() }
    }

    fn skip_blanks(&mut self) {
        let mut comment = false;
        while let Some(&byte) = self.bytes.get(self.at) {
            match byte {
                b'\n' => (self.line, comment) = (self.line + 1, false),
                b'#' | b'!' => comment = true,
                _ if comment || byte.is_ascii_whitespace() => {}
                _ => break,
            }
            self.at += 1;
        }
    }

    /// The next word of a text.
    pub(super) fn word(&mut self) -> Option<&'a str> {
        self.skip_blanks();
        let rest = &self.bytes[self.at..];
        let ends = |byte: &u8| byte.is_ascii_whitespace() || matches!(byte, b'#' | b'!');
        let length = rest.iter().position(ends).unwrap_or(rest.len());
        if length == 0 {
            return None;
        }
        self.at += length;
        self.last = self.line;
        Some(str::from_utf8(&rest[..length]).unwrap_or("\u{fffd}"))
    }

    /// The rest of the line, without blanks at its ends; none at the end of the file.
    pub(super) fn rest_of_line(&mut self) -> Option<&'a str> {
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        let length = rest.iter().position(|byte| *byte == b'\n').unwrap_or(rest.len());
        self.last = self.line;
        self.at = (self.at + length + 1).min(self.bytes.len());
        self.line += 1;
        let line = &rest[..length];
        // Of a line that is no UTF-8 what stands before that.
        let text = str::from_utf8(line).or_else(|error| str::from_utf8(&line[..error.valid_up_to()]));
        Some(text.unwrap_or_default().trim())
    }

    /// Goes on after the next place of `mark`; whether there is one.
    pub(super) fn skip_past(&mut self, mark: &str) -> bool {
        let rest = &self.bytes[self.at..];
        let Some(found) = rest.windows(mark.len()).position(|part| part == mark.as_bytes()) else { return false };
        self.line += rest[..found].iter().filter(|byte| **byte == b'\n').count();
        self.at += found + mark.len();
        true
    }

    /// The next `count` bytes.
    pub(super) fn take(&mut self, count: usize, what: &str) -> Option<&'a [u8]> {
        let found = self.at.checked_add(count).and_then(|end| self.bytes.get(self.at..end));
        if found.is_none() {
            self.faults.add(None, "", format!("the file ends, expected {what}"));
        }
        self.at += found.map_or(0, <[u8]>::len);
        found
    }

    /// The next number of a kind, whatever it is.
    fn any(&mut self, kind: Kind, what: &str) -> Option<f64> {
        if self.coding != Coding::Text {
            let bytes = self.take(kind.bytes(), what)?;
            let mut eight = [0; 8];
            eight[..bytes.len()].copy_from_slice(bytes);
            if self.coding == Coding::BigEndian {
                eight[..bytes.len()].reverse();
            }
            return Some(kind.value(&eight[..bytes.len()]));
        }
        let Some(word) = self.word() else {
            self.faults.add(Some(self.last), "", format!("the file ends, expected {what}"));
            return None;
        };
        // FORTRAN writes 1.0D+01.
        let value = word.parse::<f64>().or_else(|_| word.replace(['D', 'd'], "e").parse::<f64>());
        if value.is_err() {
            self.faults.add(Some(self.last), word, format!("expected {what}, a number of at most 1e8"));
        }
        value.ok()
    }

    /// Leaves out a number.
    pub(super) fn skip(&mut self, kind: Kind, what: &str) -> Option<()> {
        self.any(kind, what).map(|_| ())
    }

    /// The next number of a kind, of at most [`LARGEST`]; none, with a fault, when there is none.
    pub(super) fn real(&mut self, kind: Kind, what: &str) -> Option<f64> {
        let value = self.any(kind, what)?;
        if value.abs() <= LARGEST {
            return Some(value);
        }
        self.faults.add(self.place(), &value.to_string(), format!("expected {what}, a number of at most 1e8"));
        None
    }

    /// The next whole number of a kind that is not negative.
    pub(super) fn whole(&mut self, kind: Kind, what: &str) -> Option<usize> {
        let value = self.any(kind, what)?;
        // Whole numbers below 2^53 are exact.
        if (0.0..9e15).contains(&value) && value.fract() == 0.0 {
            return Some(value as usize);
        }
        self.faults.add(self.place(), &value.to_string(), format!("expected {what}, a whole number"));
        None
    }

    pub(super) fn number(&mut self, what: &str) -> Option<f64> {
        self.real(DOUBLE, what)
    }

    pub(super) fn count(&mut self, what: &str) -> Option<usize> {
        self.whole(INTEGER, what)
    }

    pub(super) fn point(&mut self, kind: Kind, what: &str) -> Option<[f64; 3]> {
        Some([self.real(kind, what)?, self.real(kind, what)?, self.real(kind, what)?])
    }

    /// Whole numbers up to the end of the line, or `count` of them where the file is binary.
    pub(super) fn line_of(&mut self, count: usize, what: &str) -> Option<Vec<usize>> {
        if self.coding != Coding::Text {
            return (0..count).map(|_| self.whole(INTEGER, what)).collect();
        }
        let mut list = vec![self.count(what)?];
        let line = self.last;
        while !self.is_at_end() && self.line == line {
            list.push(self.count(what)?);
        }
        Some(list)
    }

    /// Adds a fault at the word read last; nothing can be read from there on.
    pub(super) fn fault(&mut self, found: &str, message: &str) -> Option<()> {
        self.faults.add(self.place(), found, message.to_owned());
        None
    }

    /// The line of a fault: that of the word read last in a text.
    pub(super) fn place(&self) -> Option<usize> {
        (self.coding == Coding::Text).then_some(self.last)
    }

    /// Words up to the next line are left out, if the next word stands in `line`.
    pub(super) fn next_line(&mut self, line: usize) {
        while !self.is_at_end() && self.line == line {
            self.word();
        }
    }

    pub(super) fn is_at_end(&mut self) -> bool {
        if self.coding == Coding::Text {
            self.skip_blanks();
        }
        self.at >= self.bytes.len()
    }

    /// The line of the next word.
    pub(super) fn line(&mut self) -> usize {
        if self.is_at_end() { self.last } else { self.line }
    }

    /// Whether a stated number of items, each of some bytes at least, can stand in the rest of the file; a fault if not.
    pub(super) fn holds(&mut self, count: usize, bytes: usize, what: &str) -> bool {
        // The last word of a text has no blank behind it.
        let rest = self.bytes.len() - self.at + usize::from(self.coding == Coding::Text);
        let fits = count.checked_mul(bytes).is_some_and(|needed| needed <= rest);
        if !fits {
            self.faults.add(self.place(), &count.to_string(), format!("so many {what} are not in the file"));
        }
        fits
    }
}
