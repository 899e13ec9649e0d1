//! What is agreed about a table beside its numbers: a TOML file of the same name beside it, or comment lines in it.
//!
//! `offsets.toml` beside `offsets.csv`, every key optional; lengths are metres or carry a unit (`"62 ft"`):
//!
//! ```toml
//! [table]
//! name = "Fishing vessel"
//! units = "mm"                # m, cm, mm, ft, in, feet-inches-eighths
//! x_units = "m"               # of the stations, when they are others
//! z_units = "m"               # of the waterlines
//! breadths = "full"           # half (default), full
//! rows = "waterlines"         # stations, waterlines
//! layout = "matrix"           # matrix, tidy, pairs
//! stations = "from FP"        # from AP, from midship, from FP, numbers from AP, numbers from FP
//! station_spacing = 2.1       # between station numbers
//! spaces = 20                 # station numbers in Lpp
//! waterline_spacing = 0.6     # between the numbers of WL 1, WL 2, ...
//! buttock_spacing = 0.5       # between the numbers of Butt 1, Butt 2, ...
//! Lpp = 62.0                  # B, T, D likewise
//! separator = ";"             # , ; | tab blank
//! decimal = ","               # , .
//! sheet = "Offsets"           # of a workbook
//! axes = "x -z y"             # of a body of triangles or surfaces: our x, y, z in terms of the file's
//! up = "y"                    # of a body: the file's axis that points up, instead of all three
//! body = "half"               # of a body: one side of it (half), or all (whole)
//! scale = 59.407              # of a body: metres (or units) for one of the file, a model's scale
//! x_origin = 71.056           # of a body: where the origin of the file is, forward of AP, above the base line [m]
//! z_origin = 6.15
//! sections = 40               # of a body: spaces between the sections of its table
//!
//! [dimensions]                # Lpp, B, T and D may stand here instead, as in a job
//! T = 3.5
//!
//! [endings]                   # profiles as pairs [z, x] at the waterlines
//! stern = [[0.0, 1.2], [1.5, 0.4]]
//! stem = [[0.0, 60.1], [1.5, 61.0]]
//!
//! [transom]
//! x = -2.5                    # where the plane meets the base line
//! slope = -0.1                # dx/dz
//!
//! [[line]]
//! name = "chine"
//! kind = "knuckle"            # knuckle, tangent
//! points = [[0.0, 3.1, 0.8], [20.0, 4.0, 0.6]]
//! ```
//!
//! The keys of `[table]` may stand in comment lines of the table too: `# units = mm`, or several: `# Lpp = 20 m, B = 6
//! m`; capital and small letters are the same. A comment that is no `key = value` with a single word before the sign is
//! a comment, but for what it says of stations: `# Stations 3 ft apart`, `# Stations numbered from FP`.

pub(super) mod prose;

use self::prose::Sentences;
pub(super) use self::prose::spacing;
use super::header::From;
use super::problem::{Field, Problems};
use crate::hull::{FeatureLine, Rows, StatedParticulars, TableLayout, TransomPlane};
use crate::units::{Notation, parse_length};

/// How the positions of stations are to be understood.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct StationScale {
    pub(super) from: From,
    /// Station numbers instead of distances.
    pub(super) numbers: bool,
}

/// The conventions of one table; whatever is not given is found in the table.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Settings {
    pub(super) name: Option<String>,
    pub(super) stated: StatedParticulars,
    pub(super) units: Option<Notation>,
    pub(super) x_units: Option<Notation>,
    pub(super) z_units: Option<Notation>,
    /// Full breadths.
    pub(super) full: Option<bool>,
    pub(super) rows: Option<Rows>,
    pub(super) layout: Option<TableLayout>,
    pub(super) stations: Option<StationScale>,
    pub(super) station_spacing: Option<f64>,
    pub(super) waterline_spacing: Option<f64>,
    pub(super) buttock_spacing: Option<f64>,
    pub(super) spaces: Option<f64>,
    pub(super) separator: Option<char>,
    /// Name of the sheet of a workbook.
    pub(super) sheet: Option<String>,
    pub(super) decimal_comma: Option<bool>,
    /// (z, x) of the stern and of the stem \[m\].
    pub(super) endings: [Vec<[f64; 2]>; 2],
    pub(super) transom: Option<TransomPlane>,
    pub(super) lines: Vec<FeatureLine>,
    /// How a body lies in its file.
    pub(super) frame: BodyFrame,
    /// What sentences beside the numbers say, where nothing else does.
    pub(super) sentences: Sentences,
    /// Words by which heights count from the load waterline.
    pub(super) from_waterline: Option<String>,
}

/// A part of a body that is chosen.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum PartChoice {
    /// A shell by its number, from 1.
    Number(usize),
    /// A group, a solid or a layer.
    Name(String),
}

/// How a body lies in its file.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct BodyFrame {
    /// The parts that count; none: all.
    pub(super) parts: Option<Vec<PartChoice>>,
    /// The file's axis, 0 to 2, and its sign, for x, y and z.
    pub(super) axes: Option<[(usize, f64); 3]>,
    /// The axis that points up, with its sign.
    pub(super) up: Option<(usize, f64)>,
    /// Whether one side of it is given.
    pub(super) half: Option<bool>,
    pub(super) scale: Option<f64>,
    /// Where the origin of the file is in x and in z \[m\].
    pub(super) x_origin: Option<f64>,
    pub(super) z_origin: Option<f64>,
    /// Spaces between sections.
    pub(super) sections: Option<usize>,
}

/// Keys of `[table]`.
pub(super) const KEYS: [&str; 28] = [
    "name",
    "units",
    "x_units",
    "z_units",
    "breadths",
    "rows",
    "layout",
    "stations",
    "station_spacing",
    "waterline_spacing",
    "buttock_spacing",
    "spaces",
    "Lpp",
    "B",
    "T",
    "D",
    "separator",
    "decimal",
    "sheet",
    "comment",
    "axes",
    "up",
    "body",
    "parts",
    "scale",
    "x_origin",
    "z_origin",
    "sections",
];

/// A value of a key.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Text(String),
    Number(f64),
    /// What it is, in words.
    Other(&'static str),
}

/// The candidate nearest to a word, when it is near.
pub(super) fn nearest<'c>(word: &str, candidates: impl Iterator<Item = &'c str>) -> Option<&'c str> {
    let word = word.to_lowercase();
    let letters = word.chars().count();
    let most = |c: &str| 1 + c.chars().count().min(letters) / 4;
    candidates
        // Distances take the product of the lengths.
        .filter(|c| c.chars().count().abs_diff(letters) <= most(c))
        .map(|c| (strsim::osa_distance(&word, &c.to_lowercase()), c))
        .filter(|(distance, c)| *distance <= most(c) && *distance < letters)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, c)| c)
}

/// What a header that cannot be read may have been meant to be.
pub(super) fn suggestion(text: &str) -> String {
    nearest(text, super::header::SIDES.iter().map(|(name, _)| *name)).map_or_else(
        || "Write a number, or words with a number, as WL 3 (1.50 m)".to_owned(),
        |name| format!("Did you mean '{name}'?"),
    )
}

impl Settings {
    /// Takes the settings among the comment lines of a table.
    pub(super) fn comments(&mut self, comments: &[(usize, String)], problems: &mut Problems) {
        for (row, comment) in comments.iter().flat_map(|(row, comment)| parts(comment).map(move |part| (row, part))) {
            let Some((key, value)) = comment.split_once('=') else {
                self.prose(comment);
                self.dimensions(comment, problems);
                continue;
            };
            let (key, value) = (key.trim(), value.trim().trim_matches('"'));
            if key.is_empty() || value.is_empty() || key.contains(|c: char| !c.is_alphanumeric() && c != '_') {
                self.prose(comment);
                continue;
            }
            let place = Field { text: key.to_owned(), row: *row, column: 1 };
            let known = KEYS.iter().find(|k| k.eq_ignore_ascii_case(key));
            // Prose may hold an equals sign; only what looks like a key is taken for a wrong one.
            match (known, nearest(key, KEYS.into_iter().filter(|k| k.len() > 2))) {
                (Some(key), _) => {
                    if let Err((message, remedy)) = self.set(key, &Value::Text(value.to_owned())) {
                        problems.error("E311", &place, message, &remedy);
                    }
                }
                (None, Some(near)) => {
                    let message = "not a convention of a table".to_owned();
                    problems.error("E311", &place, message, &format!("Did you mean {near}?"));
                }
                (None, None) => self.prose(&comment.replace('_', " ")),
            }
        }
    }

    /// Sets one key of `[table]`.
    ///
    /// # Errors
    /// What is wrong with its value, and the remedy.
    pub(super) fn set(&mut self, key: &str, value: &Value) -> Result<(), (String, String)> {
        match key {
            "name" => self.name = Some(text(key, value)?),
            "sheet" => self.sheet = Some(text(key, value)?),
            "comment" => {}
            "units" => self.units = Some(unit(key, value)?),
            "x_units" => self.x_units = Some(unit(key, value)?),
            "z_units" => self.z_units = Some(unit(key, value)?),
            "breadths" => self.full = Some(choice(key, value, &[("half", false), ("full", true)])?),
            "rows" => {
                let all = [("stations", Rows::Stations), ("waterlines", Rows::Waterlines)];
                self.rows = Some(choice(key, value, &all)?);
            }
            "layout" => {
                let all = [("matrix", TableLayout::Matrix), ("tidy", TableLayout::Tidy), ("pairs", TableLayout::Pairs)];
                self.layout = Some(choice(key, value, &all)?);
            }
            "stations" => {
                let scale = |from, numbers| StationScale { from, numbers };
                let all = [
                    ("from AP", scale(From::AftPerpendicular, false)),
                    ("from midship", scale(From::Midship, false)),
                    ("from FP", scale(From::ForePerpendicular, false)),
                    ("numbers from AP", scale(From::AftPerpendicular, true)),
                    ("numbers from FP", scale(From::ForePerpendicular, true)),
                ];
                self.stations = Some(choice(key, value, &all)?);
            }
            "station_spacing" => self.station_spacing = Some(length(key, value)?),
            "waterline_spacing" => self.waterline_spacing = Some(length(key, value)?),
            "buttock_spacing" => self.buttock_spacing = Some(length(key, value)?),
            "spaces" => self.spaces = Some(length(key, value)?),
            "Lpp" => self.stated.length_between_perpendiculars = Some(length(key, value)?),
            "B" => self.stated.breadth = Some(length(key, value)?),
            "T" => self.stated.draught = Some(length(key, value)?),
            "D" => self.stated.depth = Some(length(key, value)?),
            "separator" => {
                let all = [(",", ','), (";", ';'), ("|", '|'), ("tab", '\t'), ("\t", '\t'), ("blank", ' '), (" ", ' ')];
                self.separator = Some(choice(key, value, &all)?);
            }
            "decimal" => self.decimal_comma = Some(choice(key, value, &[(",", true), (".", false)])?),
            "axes" => (self.frame.axes, self.frame.up) = (Some(axes(key, value)?), None),
            "up" => {
                let all = [("x", 0), ("y", 1), ("z", 2)];
                let signs = all.map(|(name, axis)| (name, (axis, 1.0)));
                let below = [("-x", (0, -1.0)), ("-y", (1, -1.0)), ("-z", (2, -1.0))];
                self.frame.up = Some(choice(key, value, &[signs, below].concat())?);
                self.frame.axes = None;
            }
            "body" => self.frame.half = Some(choice(key, value, &[("half", true), ("whole", false)])?),
            "parts" => self.frame.parts = Some(parts_of(key, value)?),
            "scale" => self.frame.scale = Some(length(key, value)?),
            "x_origin" => self.frame.x_origin = Some(place(key, value)?),
            "z_origin" => self.frame.z_origin = Some(place(key, value)?),
            "sections" => self.frame.sections = Some(count(key, value)?),
            _ => return Err((format!("{key} is not a convention of a table"), String::new())),
        }
        Ok(())
    }
}

/// A length in metres with the digits that matter.
pub(super) fn metres(length: f64) -> String {
    format!("{}", (1e6 * length).round() / 1e6)
}

/// The parts `key = value` of a comment, divided by commas or semicolons; the whole where any part is no such thing.
fn parts(comment: &str) -> impl Iterator<Item = &str> {
    let pair = |part: &str| {
        part.split_once('=').is_some_and(|(key, value)| {
            let key = key.trim();
            !value.trim().is_empty() && !key.is_empty() && key.chars().all(|c| c.is_alphanumeric() || c == '_')
        })
    };
    let several = comment.split([',', ';']).all(pair);
    comment.split(move |c| several && matches!(c, ',' | ';'))
}

fn found(value: &Value) -> String {
    match value {
        Value::Text(text) => format!("\"{}\"", text.chars().take(40).collect::<String>()),
        Value::Number(number) => format!("{number}"),
        Value::Other(kind) => (*kind).to_owned(),
    }
}

fn text(key: &str, value: &Value) -> Result<String, (String, String)> {
    match value {
        Value::Text(text) => Ok(text.clone()),
        other => Err((format!("{key} is {}, expected a text", found(other)), String::new())),
    }
}

fn unit(key: &str, value: &Value) -> Result<Notation, (String, String)> {
    let known = Notation::ALL.map(Notation::as_str);
    match value {
        Value::Text(word) => Notation::from_word(word),
        _ => None,
    }
    .ok_or_else(|| (format!("{key} is {}", found(value)), format!("Known are {}", known.join(", "))))
}

fn choice<T: Copy>(key: &str, value: &Value, all: &[(&str, T)]) -> Result<T, (String, String)> {
    let word = match value {
        Value::Text(word) => word.as_str(),
        _ => "",
    };
    all.iter().find(|(name, _)| name.eq_ignore_ascii_case(word)).map(|(_, item)| *item).ok_or_else(|| {
        let names: Vec<&str> = all.iter().map(|(name, _)| *name).filter(|name| !name.trim().is_empty()).collect();
        (format!("{key} is {}", found(value)), format!("Known are {}", names.join(", ")))
    })
}

/// Three different axes of a file with their signs, `x -z y`.
fn axes(key: &str, value: &Value) -> Result<[(usize, f64); 3], (String, String)> {
    let wrong = || {
        let remedy = "Give the file's axis for our x (forward), y (to port) and z (up), as \"x -z y\"".to_owned();
        (format!("{key} is {}", found(value)), remedy)
    };
    let words = match value {
        Value::Text(text) => text.to_ascii_lowercase(),
        _ => return Err(wrong()),
    };
    let mut list = Vec::new();
    for word in words.split([' ', ',']).filter(|word| !word.is_empty()) {
        let (sign, name) = word.strip_prefix('-').map_or((1.0, word.trim_start_matches('+')), |name| (-1.0, name));
        let axis = ["x", "y", "z"].iter().position(|axis| *axis == name).ok_or_else(wrong)?;
        list.push((axis, sign));
    }
    match list[..] {
        [a, b, c] if a.0 != b.0 && b.0 != c.0 && c.0 != a.0 => Ok([a, b, c]),
        _ => Err(wrong()),
    }
}

/// Numbers and names with commas between them.
fn parts_of(key: &str, value: &Value) -> Result<Vec<PartChoice>, (String, String)> {
    let words = match value {
        Value::Text(text) => text.clone(),
        Value::Number(number) => number.to_string(),
        Value::Other(kind) => return Err((format!("{key} is {kind}, expected a text"), String::new())),
    };
    let words = words.split(',').map(str::trim).filter(|word| !word.is_empty());
    let choice = |word: &str| word.parse().map_or_else(|_| PartChoice::Name(word.to_owned()), PartChoice::Number);
    let list: Vec<PartChoice> = words.map(choice).collect();
    if list.is_empty() {
        Err((format!("{key} is empty"), "Give names or numbers, as \"1,3\"".to_owned()))
    } else {
        Ok(list)
    }
}

/// A length of either sign.
fn place(key: &str, value: &Value) -> Result<f64, (String, String)> {
    let number = match value {
        Value::Number(number) => *number,
        Value::Text(text) => parse_length(text).map_err(|error| (format!("{key}: {error}"), String::new()))?,
        Value::Other(kind) => return Err((format!("{key} is {kind}, expected a length"), String::new())),
    };
    if number.abs() < 1e5 { Ok(number) } else { Err((format!("{key} is {number}"), String::new())) }
}

/// A number of things.
fn count(key: &str, value: &Value) -> Result<usize, (String, String)> {
    let number = match value {
        Value::Number(number) => *number,
        Value::Text(text) => text.trim().parse().unwrap_or(f64::NAN),
        Value::Other(_) => f64::NAN,
    };
    if (4.0..=400.0).contains(&number) && number.fract() <= 0.0 {
        return Ok(number as usize);
    }
    Err((format!("{key} is {}", found(value)), "Give a whole number from 4 to 400".to_owned()))
}

/// A length or a number that is larger than zero.
pub(super) fn length(key: &str, value: &Value) -> Result<f64, (String, String)> {
    let number = match value {
        Value::Number(number) => *number,
        Value::Text(text) => parse_length(text).map_err(|error| (format!("{key}: {error}"), String::new()))?,
        Value::Other(kind) => return Err((format!("{key} is {kind}, expected a length"), String::new())),
    };
    if number.is_finite() && number > 0.0 && number < 1e5 {
        return Ok(number);
    }
    Err((format!("{key} is {number}"), "It must be larger than 0 and smaller than 100000".to_owned()))
}
