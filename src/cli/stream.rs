//! The standard streams. A reader that stops early is not an error.

use std::io::{ErrorKind, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use crate::hull::TableForm;
use crate::report::{Destination, Failure, Inputs, OutputFile, TENDER, same_path};

/// Whether something was written to stdout: a second document behind the first would spoil both.
static WRITTEN: AtomicBool = AtomicBool::new(false);

/// Whether something was written to stdout.
pub(super) fn is_written() -> bool {
    WRITTEN.load(Ordering::Relaxed)
}

/// Writes data to stdout.
pub(super) fn data(text: &str) -> Result<(), Failure> {
    raw(text.as_bytes())
}

/// Writes a page to stdout; on a terminal, unless `NO_COLOR` is set, too little GM is red.
pub(super) fn page(text: &str) -> Result<(), Failure> {
    data(&coloured(
        text,
        std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|word| word.is_empty()),
    ))
}

fn coloured(text: &str, is_terminal: bool) -> String {
    let line = |line: &str| match line {
        line if is_terminal && line.starts_with(TENDER) => format!("\u{1b}[31m{line}\u{1b}[0m\n"),
        line => format!("{line}\n"),
    };
    text.lines().map(line).collect()
}

fn raw(bytes: &[u8]) -> Result<(), Failure> {
    WRITTEN.fetch_or(!bytes.is_empty(), Ordering::Relaxed);
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
            Some(path) => self.into(path, None, |name| Ok(OutputFile { name: name.to_owned(), contents })),
        }
    }

    /// Writes a table, with its conventions in a TOML file of the same name; a file whose name ends in `.xlsx` becomes a
    /// workbook.
    pub(super) fn table(&self, text: String, form: &TableForm, conventions: Option<String>) -> Result<(), Failure> {
        match self.file {
            None => data(&text),
            Some(path) => self.into(path, conventions, |name| OutputFile::table(name, text, form)),
        }
    }

    fn into(
        &self,
        path: &Path,
        conventions: Option<String>,
        contents: impl FnOnce(&str) -> Result<OutputFile, Failure>,
    ) -> Result<(), Failure> {
        let Some(name) = path.file_name() else {
            let error = std::io::Error::new(ErrorKind::InvalidInput, "not the name of a file");
            return Err(Failure::FileSystem { act: "write", path: path.to_owned(), error });
        };
        let folder = path.parent().unwrap_or(Path::new(""));
        let inputs = Inputs::of(self.inputs);
        let destination = Destination { folder, inputs: &inputs, force: self.force };
        let mut files = vec![contents(&name.to_string_lossy())?];
        let beside = Path::new(name).with_extension("toml").to_string_lossy().into_owned();
        // Beside the table that was read its conventions stand already.
        let is_read = self.inputs.iter().any(|input| same_path(input, &folder.join(&beside)));
        files.extend(conventions.filter(|_| !is_read).map(|text| OutputFile::text(&beside, text)));
        destination.write(&files)
    }
}

/// A JSON value as text with a line end.
pub(super) fn json(value: &impl serde::Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(value).map_err(|error| Failure::Internal(error.to_string()))?;
    Ok(text + "\n")
}

/// The same, with what was assumed about the hull as the member `warnings`.
pub(super) fn json_of(mut value: serde_json::Value, warnings: Vec<String>) -> Result<String, Failure> {
    if let Some(object) = value.as_object_mut() {
        object.insert("warnings".to_owned(), warnings.into());
    }
    json(&value)
}

/// The same, with the failure that ends the command after it, as the member `error`.
pub(super) fn json_judged(mut value: serde_json::Value, verdict: &Result<(), Failure>) -> Result<String, Failure> {
    if let (Err(failure), Some(object)) = (verdict, value.as_object_mut()) {
        object.extend(failure.to_json().as_object().cloned().unwrap_or_default());
    }
    json(&value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn too_little_gm_is_red_on_terminals_alone() {
        let page = format!("T 3\n{TENDER} 0.15 m\n");
        assert_eq!(coloured(&page, false), page);
        assert_eq!(coloured(&page, true), format!("T 3\n\u{1b}[31m{TENDER} 0.15 m\u{1b}[0m\n"));
    }
}
