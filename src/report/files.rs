//! Writing of files: all or nothing is checked first, and each file appears whole.

use std::fs;
use std::path::{Path, PathBuf};

use super::failure::Failure;

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
}

/// Writes `files` into `folder`, which is made when it is not there. Without `force` nothing is written when one of the files
/// is there already. Each file is written under another name beside its place and then renamed.
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
