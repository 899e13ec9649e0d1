//! The binary project file, `.fbm`, little-endian: numbers of four bytes, truth of one byte, texts with their length
//! before them.

use super::super::fault::{Faults, RecordFault};
use super::{LARGEST, Records, SubdivisionProject, VERSIONS, Version, project};

/// Whether these are the first bytes of such a file.
#[must_use]
pub(in super::super) fn is_fbm(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\x09\0\0\0FREE!ship")
}

/// Reads a project.
///
/// # Errors
/// What is wrong with the first record that cannot be read.
pub(in super::super) fn read_fbm(bytes: &[u8]) -> Result<SubdivisionProject, Vec<RecordFault>> {
    project(&mut Binary { bytes, at: 0 })
}

struct Binary<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Binary<'a> {
    fn take(&mut self, count: usize, what: &str, faults: &mut Faults) -> Option<&'a [u8]> {
        let end = self.at.checked_add(count).filter(|&end| end <= self.bytes.len());
        let Some(end) = end else {
            let left = self.bytes.len() - self.at;
            faults.add(None, "", format!("byte {}: {what} has {count} bytes, {left} follow", self.at));
            return None;
        };
        let taken = &self.bytes[self.at..end];
        self.at = end;
        Some(taken)
    }

    fn four(&mut self, what: &str, faults: &mut Faults) -> Option<[u8; 4]> {
        self.take(4, what, faults)?.try_into().ok()
    }
}

impl Records for Binary<'_> {
    fn version(&mut self, faults: &mut Faults) -> Option<Version> {
        let number = usize::from(self.take(1, "the version", faults)?[0]);
        if number >= VERSIONS.len() {
            let message =
                format!("byte {}: version number {number}; known are 0 to {}", self.at - 1, VERSIONS.len() - 1);
            faults.add(None, "", message);
            return None;
        }
        Some(Version(number))
    }

    fn integer(&mut self, what: &str, faults: &mut Faults) -> Option<i64> {
        self.four(what, faults).map(|bytes| i64::from(i32::from_le_bytes(bytes)))
    }

    fn number(&mut self, what: &str, faults: &mut Faults) -> Option<f64> {
        self.four(what, faults).map(|bytes| f64::from(f32::from_le_bytes(bytes)))
    }

    fn boolean(&mut self, what: &str, faults: &mut Faults) -> Option<bool> {
        self.take(1, what, faults).map(|bytes| bytes[0] != 0)
    }

    fn text(&mut self, what: &str, faults: &mut Faults) -> Option<String> {
        let at = self.at;
        let size = self.integer(what, faults)?;
        let Some(size) = usize::try_from(size).ok().filter(|&size| size <= self.left()) else {
            faults.add(None, "", format!("byte {at}: {what} has {size} characters, {} bytes follow", self.left()));
            return None;
        };
        self.take(size, what, faults).map(|bytes| String::from_utf8_lossy(bytes).into_owned())
    }

    fn point(&mut self, what: &str, faults: &mut Faults) -> Option<[f64; 3]> {
        let at = self.at;
        let mut point = [0.0; 3];
        for slot in &mut point {
            *slot = self.number(what, faults)?;
        }
        if point.iter().all(|c| c.abs() <= LARGEST) {
            return Some(point);
        }
        faults.add(None, &format!("{point:?}"), format!("byte {at}: {what}: expected numbers of at most 1e8"));
        None
    }

    fn picture(&mut self, size: usize, faults: &mut Faults) -> Option<()> {
        self.take(size, "the preview", faults).map(drop)
    }

    fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    fn line(&self) -> Option<usize> {
        None
    }
}
