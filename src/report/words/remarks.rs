//! Remarks of readers, and what is unusual of a ship.

use std::path::Path;

use crate::hydrostatics::Hydrostatics;

/// Whether a note of what was assumed is a warning of the reader, `W320 ...`: it may change what all numbers mean.
pub(in crate::report) fn is_warning(note: &str) -> bool {
    let digits = note.strip_prefix('W').unwrap_or_default();
    digits.len() > 3 && digits.as_bytes()[..3].iter().all(u8::is_ascii_digit)
}

/// A message about a file without the folder of this: results say nothing of where it lies.
pub(in crate::report) fn without_folder(note: &str, file: &Path) -> String {
    match file.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        Some(folder) => note.replacen(&format!("{}{}", folder.display(), std::path::MAIN_SEPARATOR), "", 1),
        None => note.to_owned(),
    }
}

/// What hardly any ship has at its design draught, as a warning.
pub(in crate::report) fn unusual(row: &Hydrostatics) -> Option<String> {
    let found: Vec<String> = row.unusual().into_iter().map(|(_, found)| found).collect();
    let draught = row.draught;
    (!found.is_empty())
        .then(|| format!("W354 at {draught:.3} m {}. Check where AP is, and the forward axis", found.join(", ")))
}
