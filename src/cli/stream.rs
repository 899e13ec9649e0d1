//! The standard streams. A reader that stops early is not an error.

use std::io::{ErrorKind, Write};
use std::path::Path;

use crate::hull::TableForm;
use crate::report::{Failure, OutputFile, write_all};

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

/// Writes data to a file, or to stdout when there is none.
pub(super) fn data_or_file(text: String, file: Option<&Path>, force: bool) -> Result<(), Failure> {
    let Some(path) = file else { return data(&text) };
    into(path, force, |name| Ok(OutputFile::text(name, text)))
}

/// The same of bytes.
pub(super) fn bytes_or_file(contents: Vec<u8>, file: Option<&Path>, force: bool) -> Result<(), Failure> {
    let Some(path) = file else { return raw(&contents) };
    into(path, force, |name| Ok(OutputFile { name: name.to_owned(), contents }))
}

/// The same of a table; a file whose name ends in `.xlsx` becomes a workbook.
pub(super) fn table_or_file(text: String, form: &TableForm, file: Option<&Path>, force: bool) -> Result<(), Failure> {
    let Some(path) = file else { return data(&text) };
    into(path, force, |name| OutputFile::table(name, text, form))
}

fn into(path: &Path, force: bool, contents: impl FnOnce(&str) -> Result<OutputFile, Failure>) -> Result<(), Failure> {
    let Some(name) = path.file_name() else {
        let error = std::io::Error::new(ErrorKind::InvalidInput, "not the name of a file");
        return Err(Failure::FileSystem { act: "write", path: path.to_owned(), error });
    };
    let folder = path.parent().unwrap_or(Path::new(""));
    write_all(folder, &[contents(&name.to_string_lossy())?], force)
}

/// A JSON value as text with a line end.
pub(super) fn json(value: &serde_json::Value) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(value).map_err(|error| Failure::Internal(error.to_string()))?;
    Ok(text + "\n")
}
