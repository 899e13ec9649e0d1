//! Writing of files: all or nothing is checked first, and each file appears whole.

use std::fs;
use std::path::{Path, PathBuf};

use super::failure::Failure;
use crate::exchange::{read_manifest_outputs, sha256, workbook};
use crate::hull::TableForm;

/// A file to be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutputFile {
    /// Name in its folder.
    pub name: String,
    /// Contents.
    pub contents: Vec<u8>,
}

impl OutputFile {
    /// A file of text.
    #[must_use]
    pub fn text(name: &str, contents: String) -> Self {
        Self { name: name.to_owned(), contents: contents.into_bytes() }
    }

    /// The text of a table in the form `form`; a workbook where the name ends in `.xlsx`.
    ///
    /// # Errors
    /// [`Failure::Internal`] when a workbook cannot hold it.
    pub fn table(name: &str, text: String, form: &TableForm) -> Result<Self, Failure> {
        if !is_workbook(Path::new(name)) {
            return Ok(Self::text(name, text));
        }
        let contents = workbook(&text, form).map_err(|error| Failure::Internal(format!("{name}: {error}")))?;
        Ok(Self { name: name.to_owned(), contents })
    }
}

/// Whether a file is a workbook by its name.
pub(super) fn is_workbook(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("xlsx"))
}

/// Writes the files of one run with [`write_all`]. With `force`, files that the manifest of an earlier run in the folder
/// lists and this run does not write are removed, when they are still what that run wrote.
///
/// # Errors
/// [`Failure::Exists`], [`Failure::FileSystem`].
pub fn write_run(folder: &Path, files: &[OutputFile], force: bool) -> Result<(), Failure> {
    let earlier =
        if force { fs::read_to_string(folder.join("manifest.json")).unwrap_or_default() } else { String::new() };
    write_all(folder, files, force)?;
    for entry in read_manifest_outputs(&earlier) {
        // Names of files in this folder, and nothing else.
        let plain = Path::new(&entry.file).file_name().is_some_and(|name| name == entry.file.as_str());
        if !plain || files.iter().any(|file| file.name == entry.file) {
            continue;
        }
        let path = folder.join(&entry.file);
        let regular = path.symlink_metadata().is_ok_and(|data| data.is_file() && data.len() == entry.bytes as u64);
        if regular && fs::read(&path).is_ok_and(|bytes| sha256(&bytes) == entry.sha256) {
            fs::remove_file(&path).map_err(|error| Failure::FileSystem { act: "remove", path, error })?;
        }
    }
    Ok(())
}

/// Writes `files` into `folder`, which is made when it is not there. Without `force` nothing is written when one of the
/// files is there already. Each file is written under another name beside its place and then renamed.
///
/// # Errors
/// [`Failure::Exists`], [`Failure::FileSystem`].
pub fn write_all(folder: &Path, files: &[OutputFile], force: bool) -> Result<(), Failure> {
    let paths: Vec<PathBuf> = files.iter().map(|file| folder.join(&file.name)).collect();
    if !force {
        let there: Vec<PathBuf> = paths.iter().filter(|path| path.symlink_metadata().is_ok()).cloned().collect();
        if !there.is_empty() {
            return Err(Failure::Exists(there));
        }
    }
    if !folder.as_os_str().is_empty() {
        fs::create_dir_all(folder).map_err(|error| Failure::FileSystem {
            act: "make",
            path: folder.to_owned(),
            error,
        })?;
    }
    for (file, path) in files.iter().zip(&paths) {
        let temporary = folder.join(format!(".{}.{}.part", file.name, std::process::id()));
        let written = fs::write(&temporary, &file.contents).and_then(|()| fs::rename(&temporary, path));
        if let Err(error) = written {
            // The half-written file is of no use; that it cannot be removed either adds nothing to the message.
            let _ = fs::remove_file(&temporary);
            return Err(Failure::FileSystem { act: "write", path: path.clone(), error });
        }
    }
    Ok(())
}
