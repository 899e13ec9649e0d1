//! What many tests need: the built program, folders of their own, files of the package, tables, curves and noise.

use std::fs;
use std::ops::Deref;
use std::panic::Location;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use loftsman::internals::exchange::{ReadTable, read_table, read_table_with};
use loftsman::internals::hull::{Cell, OffsetTable, StationOffsets};
use rand::RngExt;
use rand::rngs::StdRng;
use serde_json::Value;

/// The built program with these arguments, not started yet; nothing comes from its standard input.
pub(crate) fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_loftsman"));
    command.args(arguments).stdin(Stdio::null());
    command
}

/// What the built program answers to these arguments.
pub(crate) fn program(arguments: &[&str]) -> Output {
    command(arguments).output().unwrap()
}

/// What the command `convert` answers.
pub(crate) fn convert(arguments: &[&str]) -> Output {
    program(&[&["convert"], arguments].concat())
}

pub(crate) fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// A folder of one test: removed with this guard, but kept where the test fails.
pub(crate) struct Folder(PathBuf);

/// An empty folder that no test of another module and no other run has.
#[track_caller]
pub(crate) fn folder(test: &str) -> Folder {
    let module = Path::new(Location::caller().file()).file_stem().unwrap().display();
    Folder(lasting_folder(&format!("{module}-{test}-{}", std::process::id())))
}

/// An empty folder that stays until the next run empties it: for what tests share in a static, which is never dropped.
pub(crate) fn lasting_folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

impl Folder {
    pub(crate) fn read(&self, name: &str) -> String {
        read_text(self.join(name))
    }

    /// Writes a file of the folder; gives its path as an argument of the program.
    pub(crate) fn write(&self, name: &str, contents: impl AsRef<[u8]>) -> String {
        fs::write(self.join(name), contents).unwrap();
        self.join(name).display().to_string()
    }
}

impl Deref for Folder {
    type Target = Path;

    fn deref(&self) -> &Path {
        &self.0
    }
}

impl AsRef<Path> for Folder {
    fn as_ref(&self) -> &Path {
        &self.0
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            let _ = fs::remove_dir_all(&self.0);
        }
    }
}

/// A file or folder of the package.
pub(crate) fn carried(file: impl AsRef<Path>) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(file)
}

/// The folder with published hulls that are not carried here: `LOFTSMAN_DATA`, or `../shared/data` beside this package;
/// where there is none, prints a line.
pub(crate) fn shared_folder() -> Option<PathBuf> {
    let folder = std::env::var_os("LOFTSMAN_DATA").map_or_else(|| carried("../shared/data"), PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    println!("skipped: {} is absent; set LOFTSMAN_DATA", folder.display());
    None
}

/// The text of a file.
#[track_caller]
pub(crate) fn read_text(path: impl AsRef<Path>) -> String {
    let path = path.as_ref();
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The value of a text in JSON.
#[track_caller]
pub(crate) fn json(text: impl AsRef<[u8]>) -> Value {
    serde_json::from_slice(text.as_ref()).unwrap()
}

/// The names of what is in a folder, in order.
pub(crate) fn names_in(folder: impl AsRef<Path>) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// The files with an ending in a folder and in the folders within it, in order.
pub(crate) fn files_of(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(files_of(&path, ending));
        } else if path.extension().is_some_and(|e| e == ending) {
            files.push(path);
        }
    }
    files.sort();
    files
}

/// The Rust sources in a folder and in the folders within it, in order.
pub(crate) fn sources(folder: &Path) -> Vec<PathBuf> {
    files_of(folder, "rs")
}

/// The commands that the help lists.
pub(crate) fn commands() -> Vec<String> {
    let help = stdout(&program(&["--help"]));
    let (_, list) = help.split_once("Commands:").unwrap();
    // A description may run on in the next line, further in.
    let names = list.split("\n\n").next().unwrap().lines().filter_map(|line| line.strip_prefix("  "));
    names.filter(|line| !line.starts_with(' ')).filter_map(|l| l.split(' ').next()).map(ToOwned::to_owned).collect()
}

/// What is read from a text under the name of a file.
#[track_caller]
pub(crate) fn read(name: &str, text: &str) -> ReadTable {
    read_table(name, text.as_bytes()).unwrap_or_else(|problems| {
        let list: Vec<String> = problems.iter().take(10).map(ToString::to_string).collect();
        panic!("{name}:\n{}", list.join("\n"))
    })
}

/// The notes on a table and on what stands beside it.
#[track_caller]
pub(crate) fn notes(text: &str, beside: &str) -> Vec<String> {
    let read = read_table_with("t.csv", text.as_bytes(), Some(("t.toml", beside)));
    read.unwrap_or_else(|problems| panic!("{}", problems[0])).notes.iter().map(ToString::to_string).collect()
}

/// One of the messages holds every part.
#[track_caller]
pub(crate) fn among(messages: &[String], parts: &[&str]) {
    let found = messages.iter().any(|message| parts.iter().all(|part| message.contains(part)));
    assert!(found, "{parts:?} in\n{}", messages.join("\n"));
}

/// The table of a file.
#[track_caller]
pub(crate) fn table_of(path: impl AsRef<Path>) -> OffsetTable {
    let name = path.as_ref().display().to_string();
    let bytes = fs::read(path).unwrap_or_else(|error| panic!("{name}: {error}"));
    read_table(&name, &bytes).unwrap_or_else(|problems| panic!("{name}: {problems:?}")).table
}

/// A table of `count` stations at `x` of their number, written with these decimals of a metre.
pub(crate) fn sampled(
    waterlines: Vec<f64>,
    count: i32,
    x: impl Fn(f64) -> f64,
    decimals: i32,
    mut half: impl FnMut(f64, f64) -> f64,
) -> OffsetTable {
    let parts = 10f64.powi(decimals);
    let mut cell = |x: f64, z: f64| Cell::from(Some((half(x, z) * parts).round() / parts));
    let stations = (0..count)
        .map(|i| {
            let x = x(f64::from(i));
            StationOffsets {
                half_breadths: waterlines.iter().map(|&z| cell(x, z)).collect(),
                ..StationOffsets::new(format!("{i}"), x)
            }
        })
        .collect();
    let mut table = OffsetTable { waterlines, stations, ..OffsetTable::default() };
    table.form.decimals = usize::try_from(decimals).ok();
    table
}

/// Normal noise of standard deviation 1 from a sequence of its own (Weyl).
pub(crate) fn weyl_noise() -> impl FnMut() -> f64 {
    let mut count = 0;
    move || {
        count += 1;
        let uniform = |by: f64| (f64::from(count) * by).fract();
        (-2.0 * uniform(0.754_877_666).max(1e-9).ln()).sqrt() * (std::f64::consts::TAU * uniform(0.569_840_290)).cos()
    }
}

/// Exponents of the waterlines and of the sections of a hull of random form.
pub(crate) fn random_form(random: &mut StdRng) -> [f64; 3] {
    [(0.6, 1.2), (1.3, 3.0), (0.6, 1.0)].map(|(a, b)| random.random_range(a..b))
}

/// Half-breadth of such a hull over the greatest one, at `along` of its length and `below` of its depth below the deck.
pub(crate) fn half_breadth_of_form([plan, up, bilge]: [f64; 3], along: f64, below: f64) -> f64 {
    (1.0 - (2.0 * along - 1.0).powi(2)).max(0.0).powf(plan) * (1.0 - below.powf(up)).powf(bilge)
}

/// A normal number of standard deviation 1.
pub(crate) fn normal(random: &mut StdRng) -> f64 {
    let (u, v): (f64, f64) = (random.random_range(1e-12..1.0), random.random_range(0.0..1.0));
    (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
}

/// 1 - (cosh(a t) - 1) / (cosh a - 1) with mu = a^2, the cosine where mu < 0: one inflection at pi / (2 a) if mu <
/// -pi^2 / 4.
fn kernel(mu: f64, t: f64) -> f64 {
    let a = mu.abs().sqrt();
    match mu {
        mu if mu > 1e-3 => 1.0 - ((a * t).cosh() - 1.0) / (a.cosh() - 1.0),
        mu if mu < -1e-3 => 1.0 - (1.0 - (a * t).cos()) / (1.0 - a.cos()),
        _ => 1.0 - t * t,
    }
}

/// A waterline of 100 m with the largest half-breadth 8 m at 50 m; mu < -pi^2 / 4 makes a hollow end.
pub(crate) fn waterline(aft: f64, forward: f64, x: f64) -> f64 {
    8.0 * if x < 50.0 { kernel(aft, 1.0 - x / 50.0) } else { kernel(forward, x / 50.0 - 1.0) }
}
