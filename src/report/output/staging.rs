//! A folder beside the files of a run, in which they are written before they appear. A lock tells a run that goes on from
//! one that was killed: what the latter left, the next run removes.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

/// Runs that may write into one folder at once.
const MOST_RUNS: usize = 64;

/// So many places are looked through for what killed runs left.
const LEFT_BY_KILLED: usize = 8;

/// A folder of this run alone; it goes with this guard.
pub(in crate::report) struct Staging {
    folder: PathBuf,
    lock: PathBuf,
    _held: File,
}

/// The lock at a path, where no run holds it, and whether the file system knows locks; none where one does.
fn taken(lock: &Path, options: &OpenOptions) -> io::Result<Option<(File, bool)>> {
    let file = options.open(lock)?;
    let sure = match file.try_lock() {
        Err(TryLockError::WouldBlock) => return Ok(None),
        locked => locked.is_ok(),
    };
    // Another run may have removed the file between the two steps, and made it anew.
    Ok(is_at(&file, lock).then_some((file, sure)))
}

#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    matches!((file.metadata(), path.metadata()), (Ok(a), Ok(b)) if (a.dev(), a.ino()) == (b.dev(), b.ino()))
}

#[cfg(not(unix))]
fn is_at(_: &File, path: &Path) -> bool {
    path.exists()
}

impl Staging {
    fn names(parent: &Path, number: usize) -> [PathBuf; 2] {
        ["part", "lock"].map(|ending| parent.join(format!(".loftsman-{number}.{ending}")))
    }

    /// A place in a folder that is there.
    pub(in crate::report) fn within(parent: &Path) -> io::Result<Self> {
        let mut options = OpenOptions::new();
        options.write(true).create(true).truncate(false);
        for number in 0..MOST_RUNS {
            let [folder, lock] = Self::names(parent, number);
            let Some((held, sure)) = taken(&lock, &options)? else { continue };
            if sure {
                Self::clear(parent, number + 1);
                let _ = fs::remove_dir_all(&folder);
            } else if folder.exists() {
                continue;
            }
            let staging = Self { folder, lock, _held: held };
            fs::create_dir(&staging.folder)?;
            return Ok(staging);
        }
        Err(io::Error::other(format!("{MOST_RUNS} runs write here already")))
    }

    /// Removes what killed runs left from a number on.
    fn clear(parent: &Path, from: usize) {
        let mut options = OpenOptions::new();
        options.write(true);
        for number in from..from + LEFT_BY_KILLED {
            let [folder, lock] = Self::names(parent, number);
            if let Ok(Some((held, true))) = taken(&lock, &options) {
                drop(Self { folder, lock, _held: held });
            }
        }
    }

    pub(in crate::report) fn folder(&self) -> &Path {
        &self.folder
    }

    /// Writes a file by its name, which may hold folders.
    pub(in crate::report) fn put(&self, name: &str, contents: &[u8]) -> io::Result<()> {
        let path = self.folder.join(name);
        path.parent().map_or(Ok(()), fs::create_dir_all)?;
        fs::write(path, contents)
    }

    /// Moves a file to its place. What a link points to is written, not the link.
    pub(in crate::report) fn settle(&self, name: &str, path: &Path, made: &mut Made) -> io::Result<()> {
        path.parent().map_or(Ok(()), |parent| made.folder(parent))?;
        let (own, path) = (self.folder.join(name), path.canonicalize().unwrap_or_else(|_| path.to_owned()));
        match fs::rename(&own, &path) {
            Err(error) if error.kind() == io::ErrorKind::CrossesDevices => {
                let beside = Self::within(path.parent().unwrap_or(Path::new(".")))?;
                let near = beside.folder.join("file");
                fs::copy(&own, &near).and_then(|_| fs::rename(near, path))
            }
            done => done,
        }
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        // What cannot be removed is left to the next run.
        let _ = fs::remove_dir_all(&self.folder);
        let _ = fs::remove_file(&self.lock);
    }
}

/// Folders that a run made; they go with this guard unless they are kept.
#[derive(Default)]
pub(in crate::report) struct Made(Vec<PathBuf>);

impl Made {
    /// Makes a folder and those above it that are not there.
    pub(in crate::report) fn folder(&mut self, folder: &Path) -> io::Result<()> {
        let absent = folder.ancestors().take_while(|path| !path.as_os_str().is_empty() && !path.exists());
        let absent: Vec<PathBuf> = absent.map(Path::to_owned).collect();
        self.0.extend(absent.into_iter().rev());
        fs::create_dir_all(folder)
    }

    pub(in crate::report) fn keep(&mut self) {
        self.0.clear();
    }
}

impl Drop for Made {
    fn drop(&mut self) {
        // A folder that somebody else has put something into stays.
        self.0.iter().rev().for_each(|folder| drop(fs::remove_dir(folder)));
    }
}
