//! Writing of files: all or nothing is checked first, and each file appears whole.

use std::collections::HashSet;
use std::fs;
use std::path::{Component, Path, PathBuf};

use super::staging::{Made, Staging};
use crate::exchange::{read_manifest_outputs, sha256, workbook};
use crate::hull::TableForm;
use crate::report::failure::Failure;

/// The file that lists the others with their hashes.
pub(in crate::report) const MANIFEST: &str = "manifest.json";

/// A file to be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutputFile {
    /// Name in its folder; with the folders within it and slashes between them.
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
    #[doc(hidden)]
    pub fn table(name: &str, text: String, form: &TableForm) -> Result<Self, Failure> {
        if !is_workbook(Path::new(name)) {
            return Ok(Self::text(name, text));
        }
        let contents = workbook(&text, form).map_err(|error| Failure::Internal(format!("{name}: {error}")))?;
        Ok(Self { name: name.to_owned(), contents })
    }
}

/// Whether a file is a workbook by its name.
pub(in crate::report) fn is_workbook(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("xlsx"))
}

/// Whether two paths are one file or folder; an empty one is the folder that the program runs in.
#[must_use]
pub fn same_path(a: &Path, b: &Path) -> bool {
    let real = |path: &Path| Path::new(".").join(path).canonicalize();
    matches!((real(a), real(b)), (Ok(a), Ok(b)) if a == b)
}

/// Files that a run reads, by their true paths: looked up once, however many files are written.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Inputs(HashSet<PathBuf>);

impl Inputs {
    /// Those of these paths that are there.
    #[must_use]
    pub fn of<P: AsRef<Path>>(paths: &[P]) -> Self {
        Self(paths.iter().filter_map(|path| true_path(&Path::new(".").join(path))).collect())
    }

    fn has(&self, path: &Path) -> bool {
        true_path(path).is_some_and(|path| self.0.contains(&path))
    }
}

#[cfg(test)]
thread_local! {
    /// How often the true path of a file was looked up.
    static LOOKED_UP: std::cell::Cell<usize> = const { std::cell::Cell::new(0) };
}

/// The true path of a file that is there.
fn true_path(path: &Path) -> Option<PathBuf> {
    #[cfg(test)]
    LOOKED_UP.with(|count| count.set(count.get() + 1));
    path.canonicalize().ok()
}

/// Where the files of a run go.
#[derive(Debug, Clone, Copy)]
pub struct Destination<'a> {
    /// Their folder, which is made when it is not there.
    pub folder: &'a Path,
    /// Files that the run reads; none of them is written over or removed.
    pub inputs: &'a Inputs,
    /// Whether other files that are there already are overwritten.
    pub force: bool,
}

impl Destination<'_> {
    /// Whether files of these names may be written. Writing asks the same; a long job asks before it begins.
    ///
    /// # Errors
    /// [`Failure::Usage`] when one of them is read; [`Failure::Exists`].
    pub fn check<'n>(&self, names: impl IntoIterator<Item = &'n str>) -> Result<(), Failure> {
        let paths: Vec<PathBuf> = names.into_iter().map(|name| self.folder.join(name)).collect();
        if let Some(path) = paths.iter().find(|path| self.is_read(path)) {
            return Err(Failure::Usage(format!(
                "{} is read and would be overwritten, with --force too; choose another place for the output",
                path.display()
            )));
        }
        if self.folder.metadata().is_ok_and(|data| !data.is_dir()) {
            let error = std::io::Error::from(std::io::ErrorKind::NotADirectory);
            return Err(Failure::FileSystem { act: "write into", path: self.folder.to_owned(), error });
        }
        // A device, a pipe or a folder is no file that can be replaced by another.
        if let Some(path) = paths.iter().find(|path| path.metadata().is_ok_and(|data| !data.is_file())) {
            let error = std::io::Error::new(std::io::ErrorKind::InvalidInput, "there, and no file");
            return Err(Failure::FileSystem { act: "write", path: path.clone(), error });
        }
        let there = paths.into_iter().filter(|path| !self.force && path.symlink_metadata().is_ok());
        let there: Vec<PathBuf> = there.collect();
        if there.is_empty() { Ok(()) } else { Err(Failure::Exists(there)) }
    }

    fn is_read(&self, path: &Path) -> bool {
        self.inputs.has(path)
    }

    /// Writes the files of one run with [`Destination::write`]. With `force`, files that the manifest of an earlier run
    /// in the folder lists and this run does not write are removed, when they are still what that run wrote.
    ///
    /// # Errors
    /// Those of [`Destination::write`].
    pub fn write_run(&self, files: &[OutputFile]) -> Result<(), Failure> {
        let manifest = self.folder.join(MANIFEST);
        let earlier = if self.force { fs::read_to_string(manifest).unwrap_or_default() } else { String::new() };
        self.write(files)?;
        for entry in read_manifest_outputs(&earlier) {
            // Names of files within this folder, and nothing else.
            let within = Path::new(&entry.file).components().all(|part| matches!(part, Component::Normal(_)));
            let path = self.folder.join(&entry.file);
            if !within || files.iter().any(|file| file.name == entry.file) || self.is_read(&path) {
                continue;
            }
            let regular = path.symlink_metadata().is_ok_and(|data| data.is_file() && data.len() == entry.bytes as u64);
            if regular && fs::read(&path).is_ok_and(|bytes| sha256(&bytes) == entry.sha256) {
                let removed = fs::remove_file(&path);
                removed.map_err(|error| Failure::FileSystem { act: "remove", path: path.clone(), error })?;
                // A folder of this run goes with its last file; one that is not empty stays.
                let folders = path.ancestors().skip(1).take_while(|folder| *folder != self.folder);
                let _ = folders.map(fs::remove_dir).find(Result::is_err);
            }
        }
        Ok(())
    }

    /// Writes `files`, all or none of them as [`Destination::check`] says. All are written in a folder beside their
    /// place first: a new folder appears with all of them by one rename; in a folder that is there they are renamed one
    /// by one, the manifest last, so that its hashes hold only of a whole set.
    ///
    /// # Errors
    /// Those of [`Destination::check`]; [`Failure::FileSystem`].
    pub fn write(&self, files: &[OutputFile]) -> Result<(), Failure> {
        self.check(files.iter().map(|file| file.name.as_str()))?;
        let here = Path::new(".");
        let is_new = !self.folder.as_os_str().is_empty() && !self.folder.exists();
        let within = if is_new { self.folder.parent().unwrap_or(here) } else { self.folder };
        let within = if within.as_os_str().is_empty() { here } else { within };
        let failure = |act, path: &Path, error| Failure::FileSystem { act, path: path.to_owned(), error };
        let mut made = Made::default();
        made.folder(within).map_err(|error| failure("make", self.folder, error))?;
        let staging = Staging::within(within).map_err(|error| failure("write into", within, error))?;
        for file in files {
            let put = staging.put(&file.name, &file.contents);
            put.map_err(|error| failure("write", &self.folder.join(&file.name), error))?;
        }
        if is_new {
            fs::rename(staging.folder(), self.folder).map_err(|error| failure("make", self.folder, error))?;
        } else {
            let (last, others): (Vec<_>, Vec<_>) = files.iter().partition(|file| file.name == MANIFEST);
            for file in others.into_iter().chain(last) {
                let path = self.folder.join(&file.name);
                staging.settle(&file.name, &path, &mut made).map_err(|error| failure("write", &path, error))?;
            }
        }
        made.keep();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Looked up for runs over so many designs that are files, each of which writes ten files.
    fn looked_up(runs: usize) -> usize {
        let folder = std::env::temp_dir().join(format!("loftsman-lookups-{}-{runs}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let designs: Vec<PathBuf> = (0..runs).map(|k| folder.join(format!("{k}.toml"))).collect();
        designs.iter().for_each(|path| fs::write(path, "").unwrap());
        let before = LOOKED_UP.with(std::cell::Cell::get);
        let inputs = Inputs::of(&designs);
        let names: Vec<String> = (0..10).map(|k| format!("{k}.csv")).collect();
        for k in 0..runs {
            let to = Destination { folder: &folder.join(k.to_string()), inputs: &inputs, force: false };
            to.check(names.iter().map(String::as_str)).unwrap();
        }
        fs::remove_dir_all(&folder).unwrap();
        LOOKED_UP.with(std::cell::Cell::get) - before
    }

    #[test]
    fn many_designs_cost_no_more_paths_each_than_one() {
        let one = looked_up(1);
        assert_eq!(looked_up(200), 200 * one);
    }
}
