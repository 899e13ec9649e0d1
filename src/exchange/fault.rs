//! Faults of the records of a body, as many as help.

/// After so many faults the rest of a file is not read.
const MOST_FAULTS: usize = 100;

/// Coordinates larger than this are of no ship in any unit.
pub(super) const LARGEST: f64 = 1e8;

/// What is wrong with a record of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct RecordFault {
    /// Line, from 1; none in binary files and of the whole.
    pub(super) line: Option<usize>,
    /// What stands there.
    pub(super) found: String,
    /// What is wrong with it.
    pub(super) message: String,
}

/// The faults found so far.
#[derive(Debug, Default)]
pub(super) struct Faults {
    pub(super) list: Vec<RecordFault>,
}

impl Faults {
    pub(super) fn add(&mut self, line: Option<usize>, found: &str, message: String) {
        if !self.is_full() {
            self.list.push(RecordFault { line, found: found.chars().take(80).collect(), message });
        }
    }

    pub(super) fn is_full(&self) -> bool {
        self.list.len() >= MOST_FAULTS
    }

    /// A point of `count` words that must be numbers.
    pub(super) fn point(&mut self, line: usize, text: &str, words: &[&str], count: usize) -> Option<[f64; 3]> {
        if words.len() != count {
            self.add(Some(line), text, format!("{} numbers, expected {count}", words.len()));
            return None;
        }
        let mut point = [0.0; 3];
        for (slot, word) in point.iter_mut().zip(words) {
            match word.parse::<f64>() {
                Ok(value) if value.abs() <= LARGEST => *slot = value,
                _ => {
                    self.add(Some(line), word, "expected a number of at most 1e8".to_owned());
                    return None;
                }
            }
        }
        Some(point)
    }

    /// Whether the corners of triangle `index`, from 0, are numbers; if not, this is a fault.
    pub(super) fn corners(&mut self, index: usize, triangle: &[[f64; 3]; 3]) -> bool {
        let sound = triangle.iter().flatten().all(|c| c.abs() <= LARGEST);
        if !sound {
            self.add(None, "", format!("triangle {} has a corner that is no number of at most 1e8", index + 1));
        }
        sound
    }

    pub(super) fn or<T>(self, value: impl FnOnce() -> T) -> Result<T, Vec<RecordFault>> {
        if self.list.is_empty() { Ok(value()) } else { Err(self.list) }
    }
}
