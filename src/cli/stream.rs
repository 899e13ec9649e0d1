//! The standard streams. A reader that stops early is not an error.

use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use crate::hull::TableForm;
use crate::report::{Destination, Failure, OutputFile};

/// Writes data to stdout.
pub(super) fn data(text: &str) -> Result<(), Failure> {
    raw(text.as_bytes())
}

fn raw(bytes: &[u8]) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::FileSystem { act: "write", path: "standard output".into(), error })
        }
        _ => Ok(()),
    }
}

/// Writes a message to stderr; when nobody reads it, nothing is lost.
pub(super) fn message(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

/// Where the data of a command go: a file, or stdout when there is none.
#[derive(Debug, Clone, Copy)]
pub(super) struct Target<'a> {
    /// The file.
    pub(super) file: Option<&'a Path>,
    /// Files that the command reads; none of them is written over.
    pub(super) inputs: &'a [PathBuf],
    /// Whether a file that is there already is overwritten.
    pub(super) force: bool,
}

impl Target<'_> {
    /// Writes text.
    pub(super) fn text(&self, text: String) -> Result<(), Failure> {
        self.bytes(text.into_bytes())
    }

    /// Writes bytes.
    pub(super) fn bytes(&self, contents: Vec<u8>) -> Result<(), Failure> {
        match self.file {
            None => raw(&contents),
            Some(path) => self.into(path, |name| Ok(OutputFile { name: name.to_owned(), contents })),
        }
    }

    /// Writes a table; a file whose name ends in `.xlsx` becomes a workbook.
    pub(super) fn table(&self, text: String, form: &TableForm) -> Result<(), Failure> {
        match self.file {
            None => data(&text),
            Some(path) => self.into(path, |name| OutputFile::table(name, text, form)),
        }
    }

    fn into(&self, path: &Path, contents: impl FnOnce(&str) -> Result<OutputFile, Failure>) -> Result<(), Failure> {
        let Some(name) = path.file_name() else {
            let error = std::io::Error::new(ErrorKind::InvalidInput, "not the name of a file");
            return Err(Failure::FileSystem { act: "write", path: path.to_owned(), error });
        };
        let folder = path.parent().unwrap_or(Path::new(""));
        let destination = Destination { folder, inputs: self.inputs, force: self.force };
        destination.write(&[contents(&name.to_string_lossy())?])
    }
}

/// A JSON value as text with a line end.
pub(super) fn json(value: &serde_json::Value) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(value).map_err(|error| Failure::Internal(error.to_string()))?;
    Ok(text + "\n")
}
