//! An archive that is read: numbers, texts, chunks and objects, all of them within their chunk.

use super::chunks::{CRC, SHORT, class_of, code, crc};

/// Larger numbers are of no ship in any unit.
const LARGEST: f64 = 1e12;

/// Most classes of data beside an object.
const MOST_BESIDE: usize = 64;

/// Runs over the bytes of a chunk.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    /// Whether lengths of chunks have 8 bytes, and not 4.
    wide: bool,
}

/// A chunk of an archive.
#[derive(Debug, Clone, Copy)]
pub(super) struct Chunk<'a> {
    pub(super) code: u32,
    /// Its value, of a chunk without contents.
    pub(super) value: i64,
    /// What is in it, without the CRC.
    pub(super) inside: Cursor<'a>,
    /// The CRC at its end.
    crc: Option<u32>,
}

impl Chunk<'_> {
    /// Whether the CRC of a chunk without chunks inside it is that of its contents.
    pub(super) fn is_sound(&self) -> bool {
        self.crc.is_none_or(|stated| crc(0, self.inside.bytes) == stated)
    }
}

/// An object: its class, its data, and the data of other classes beside it.
#[derive(Debug, Clone)]
pub(super) struct Object<'a> {
    pub(super) class: [u8; 16],
    pub(super) data: Chunk<'a>,
    pub(super) beside: Vec<([u8; 16], Cursor<'a>)>,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8], wide: bool) -> Self {
        Self { bytes, wide }
    }

    pub(super) fn is_at_end(&self) -> bool {
        self.bytes.is_empty()
    }

    pub(super) fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.bytes.split_at_checked(count)?;
        self.bytes = rest;
        Some(taken)
    }

    /// All that is left.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.bytes
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.take(N)?.try_into().ok()
    }

    pub(super) fn byte(&mut self) -> Option<u8> {
        self.array().map(|[byte]| byte)
    }

    /// Whether a byte is not 0.
    pub(super) fn flag(&mut self) -> Option<bool> {
        self.byte().map(|byte| byte != 0)
    }

    pub(super) fn int(&mut self) -> Option<i32> {
        self.array().map(i32::from_le_bytes)
    }

    /// A number of at most [`LARGEST`].
    pub(super) fn real(&mut self) -> Option<f64> {
        self.array().map(f64::from_le_bytes).filter(|value| value.abs() <= LARGEST)
    }

    pub(super) fn reals<const N: usize>(&mut self) -> Option<[f64; N]> {
        let mut all = [0.0; N];
        for slot in &mut all {
            *slot = self.real()?;
        }
        Some(all)
    }

    /// The two bytes of a version in one.
    pub(super) fn version(&mut self) -> Option<[u8; 2]> {
        self.byte().map(|byte| [byte >> 4, byte & 15])
    }

    pub(super) fn id(&mut self) -> Option<[u8; 16]> {
        self.array()
    }

    /// A number of things of which each has some bytes at least, all in the rest of the chunk.
    pub(super) fn count(&mut self, bytes: usize) -> Option<usize> {
        let count = usize::try_from(self.int()?).ok()?;
        (count.checked_mul(bytes)? <= self.bytes.len()).then_some(count)
    }

    /// Numbers with how many there are before them.
    pub(super) fn list(&mut self) -> Option<Vec<f64>> {
        let count = self.count(8)?;
        (0..count).map(|_| self.real()).collect()
    }

    /// Indices with how many there are before them; those that are not 0 or more are left out.
    pub(super) fn indices(&mut self) -> Option<Vec<usize>> {
        let count = self.count(4)?;
        let all: Option<Vec<i32>> = (0..count).map(|_| self.int()).collect();
        Some(all?.into_iter().filter_map(|index| usize::try_from(index).ok()).collect())
    }

    /// A text of UTF-16 with a 0 behind it.
    pub(super) fn text(&mut self) -> Option<String> {
        let count = self.count(2)?;
        let units: Vec<u16> = self.take(2 * count)?.chunks_exact(2).map(|b| u16::from_le_bytes([b[0], b[1]])).collect();
        Some(String::from_utf16_lossy(units.strip_suffix(&[0]).unwrap_or(&units)))
    }

    /// The next chunk.
    pub(super) fn chunk(&mut self) -> Option<Chunk<'a>> {
        let code = self.array().map(u32::from_le_bytes)?;
        let value =
            if self.wide { i64::from_le_bytes(self.array()?) } else { i64::from(i32::from_le_bytes(self.array()?)) };
        let inside = Self { bytes: &[], ..*self };
        if code & SHORT != 0 {
            return Some(Chunk { code, value, inside, crc: None });
        }
        // A length of 4 bytes has no sign.
        let length = if self.wide { usize::try_from(value).ok()? } else { value as u32 as usize };
        let bytes = self.take(length)?;
        if code & CRC == 0 {
            return Some(Chunk { code, value: 0, inside: Self { bytes, ..*self }, crc: None });
        }
        let (bytes, end) = bytes.split_last_chunk::<4>()?;
        Some(Chunk { code, value: 0, inside: Self { bytes, ..*self }, crc: Some(u32::from_le_bytes(*end)) })
    }

    /// What is in the next chunk, which has a code.
    pub(super) fn inside(&mut self, code: u32) -> Option<Self> {
        self.chunk().filter(|chunk| chunk.code == code).map(|chunk| chunk.inside)
    }

    /// What is in the next chunk without a code of its own.
    pub(super) fn anonymous(&mut self) -> Option<Self> {
        self.inside(code::ANONYMOUS)
    }

    /// The object that begins here.
    pub(super) fn object(&mut self) -> Option<Object<'a>> {
        let mut inside = self.inside(code::CLASS)?;
        let class = class_of(inside.inside(code::CLASS_ID)?.id()?);
        let data = inside.chunk().filter(|chunk| chunk.code == code::CLASS_DATA)?;
        let mut beside = Vec::new();
        while let Some(chunk) = inside.chunk().filter(|chunk| chunk.code == code::USER_DATA) {
            if beside.len() < MOST_BESIDE {
                beside.extend(user_data(chunk.inside));
            }
        }
        Some(Object { class, data, beside })
    }
}

/// The class and the data of a chunk of data beside an object.
fn user_data(mut inside: Cursor<'_>) -> Option<([u8; 16], Cursor<'_>)> {
    inside.version()?;
    let class = inside.inside(code::USER_DATA_HEADER)?.id()?;
    Some((class, inside.anonymous()?))
}
