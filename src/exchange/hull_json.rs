//! `hull.json`: the hull as numbers, read back bit for bit.
//!
//! An object with `format` "loftsman-hull", `version` 1, `name`, `particulars` (Lpp, B, D, and T where it is stated), `surface` (`degree` in u
//! and v, `knots` in u and v, and the nets `x`, `y`, `z`: one list for each control point along the ship, aft to
//! forward, with one number for each control point from bottom to top; on a level hull all lists of `z` are equal),
//! `deck` (degree, knots, x, z of the deck at side) and `conventions`. All lengths in metres. Numbers are the shortest
//! decimals that read back to the same bits. Members that a reader does not know are left alone, so that later programs
//! can add to version 1.

use serde::{Deserialize, Serialize};

use super::hydrostatics::ConventionsRecord;
use crate::hull::{Hull, HullError, PrincipalParticulars};
use crate::hydrostatics::Conventions;
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector, MAX_DEGREE, SplineError};
use crate::units::{NAME_REMEDY, name_fault};

const FORMAT: &str = "loftsman-hull";
const VERSION: u64 = 1;
/// Files longer than this are not read \[bytes\].
pub const LARGEST_HULL_FILE: usize = 64 << 20;
/// The most control points in one direction.
const MOST_POINTS: usize = 4000;

/// Why a text is not a hull.
#[derive(Debug, thiserror::Error)]
pub enum HullFileError {
    /// Longer than any such file.
    #[error("the file has {0} bytes; a hull.json has at most {LARGEST_HULL_FILE}")]
    Size(usize),
    /// Not JSON, or a member of another type.
    #[error("line {line}, column {column}: {field}{message}")]
    Json {
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// Path of the member with a colon, or nothing.
        field: String,
        /// What is wrong.
        message: String,
    },
    /// Another format.
    #[error("format is \"{0}\", expected \"{FORMAT}\"")]
    Format(String),
    /// A version that this program does not know.
    #[error("version {0} is newer than this program, which reads version {VERSION}; use a newer loftsman")]
    Version(u64),
    /// Sizes that do not fit together, or beyond all limits.
    #[error("{field}: {found}, expected {expected}")]
    Shape {
        /// Member.
        field: String,
        /// Number found.
        found: usize,
        /// Number expected.
        expected: String,
    },
    /// Knots or points that make no spline.
    #[error("{field}: {error}")]
    Spline {
        /// Member.
        field: &'static str,
        /// What is wrong.
        error: SplineError,
    },
    /// Dimensions and conventions that no ship has, each with its member.
    #[error("{}", .0.join("; "))]
    Values(Vec<String>),
    /// Splines that make no hull.
    #[error(transparent)]
    Hull(#[from] HullError),
}

/// What a hull file holds.
#[derive(Debug, Clone, PartialEq)]
pub struct HullFile {
    /// The hull.
    pub hull: Hull,
    /// Conventions of its tables.
    pub conventions: Conventions,
}

#[derive(Deserialize)]
struct Head {
    format: String,
    version: u64,
}

#[derive(Serialize, Deserialize)]
struct Record {
    format: String,
    version: u64,
    name: String,
    particulars: super::summary::Particulars,
    surface: SurfaceRecord,
    deck: DeckRecord,
    #[serde(default)]
    conventions: ConventionsRecord,
}

#[derive(Serialize, Deserialize)]
struct SurfaceRecord {
    degree: [usize; 2],
    knots: [Vec<f64>; 2],
    x: Vec<Vec<f64>>,
    y: Vec<Vec<f64>>,
    z: Vec<Vec<f64>>,
}

#[derive(Serialize, Deserialize)]
struct DeckRecord {
    degree: usize,
    knots: Vec<f64>,
    x: Vec<f64>,
    z: Vec<f64>,
}

/// The text of a hull file. Same hull, same bytes.
///
/// # Errors
/// A number that JSON cannot write; a [`Hull`] has none.
pub fn write_hull(hull: &Hull, conventions: &Conventions) -> Result<String, serde_json::Error> {
    let surface = hull.surface();
    let [rows, columns] = surface.shape();
    let net = |axis: usize| -> Vec<Vec<f64>> {
        (0..rows).map(|i| (0..columns).map(|j| surface.point(i, j)[axis]).collect()).collect()
    };
    let deck = hull.deck();
    let record = Record {
        format: FORMAT.into(),
        version: VERSION,
        name: hull.name().to_owned(),
        particulars: hull.particulars().into(),
        surface: SurfaceRecord {
            degree: [surface.u().degree(), surface.v().degree()],
            knots: [surface.u().knots().to_vec(), surface.v().knots().to_vec()],
            x: net(0),
            y: net(1),
            z: net(2),
        },
        deck: DeckRecord {
            degree: deck.knots().degree(),
            knots: deck.knots().knots().to_vec(),
            x: deck.points().iter().map(|p| p[0]).collect(),
            z: deck.points().iter().map(|p| p[1]).collect(),
        },
        conventions: ConventionsRecord::from(conventions),
    };
    // One line a member and a row of a net: short enough to read, long enough not to fill screens.
    let one = |value: &serde_json::Value| serde_json::to_string(value);
    let value = serde_json::to_value(&record)?;
    let mut text = String::from("{\n");
    let members = ["format", "version", "name", "particulars", "surface", "deck", "conventions"];
    for (index, member) in members.iter().enumerate() {
        text.push_str(&format!("\"{member}\": "));
        match (&value[member], *member) {
            (inner, "surface") => {
                text.push_str(&format!(
                    "{{\n \"degree\": {},\n \"knots\": {}",
                    one(&inner["degree"])?,
                    one(&inner["knots"])?
                ));
                for axis in ["x", "y", "z"] {
                    let rows: Result<Vec<String>, _> = inner[axis].as_array().into_iter().flatten().map(one).collect();
                    text.push_str(&format!(",\n \"{axis}\": [\n  {}\n ]", rows?.join(",\n  ")));
                }
                text.push_str("\n}");
            }
            (inner, _) => text.push_str(&one(inner)?),
        }
        text.push_str(if index + 1 < members.len() { ",\n" } else { "\n" });
    }
    text.push_str("}\n");
    Ok(text)
}

fn json<'a, T: Deserialize<'a>>(text: &'a str) -> Result<T, HullFileError> {
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let value = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
        let path = error.path().to_string();
        let field = if matches!(path.as_str(), "." | "?") { String::new() } else { format!("{path}: ") };
        json_error(error.inner(), field)
    })?;
    deserializer.end().map_err(|error| json_error(&error, String::new()))?;
    Ok(value)
}

/// What is wrong with a text that is no JSON, without the position, which stands before the message already.
pub fn json_message(error: &serde_json::Error) -> String {
    if error.is_eof() {
        return "the file ends before its value is complete, as if it were cut off".to_owned();
    }
    error.to_string().split(" at line ").next().unwrap_or("").to_owned()
}

fn json_error(error: &serde_json::Error, field: String) -> HullFileError {
    HullFileError::Json { line: error.line(), column: error.column(), field, message: json_message(error) }
}

/// Main dimensions and conventions that no ship has.
fn faults(p: &PrincipalParticulars, conventions: &Conventions) -> Vec<String> {
    let dimensions = [
        ("Lpp", Some(p.length_between_perpendiculars)),
        ("B", Some(p.breadth)),
        ("T", p.draught),
        ("D", Some(p.depth)),
    ];
    let mut list: Vec<String> = dimensions
        .into_iter()
        .filter_map(|(key, value)| Some((key, value.filter(|value| *value <= 0.0)?)))
        .map(|(key, value)| format!("particulars.{key} is {value} m, expected more than 0"))
        .collect();
    if let Some(draught) = p.draught.filter(|_| list.is_empty() && p.draught_exceeds_depth()) {
        list.push(format!("particulars.T is {draught} m, expected at most particulars.D, {} m", p.depth));
    }
    list.extend(conventions.faults().into_iter().map(|fault| format!("conventions.{fault}")));
    list
}

fn size(field: &str, found: usize, expected: usize) -> Result<(), HullFileError> {
    if found == expected {
        return Ok(());
    }
    Err(HullFileError::Shape { field: field.to_owned(), found, expected: expected.to_string() })
}

fn knots(field: &'static str, degree: usize, knots: Vec<f64>) -> Result<KnotVector, HullFileError> {
    if knots.len() > MOST_POINTS {
        let expected = format!("at most {MOST_POINTS}");
        return Err(HullFileError::Shape { field: field.to_owned(), found: knots.len(), expected });
    }
    // The format keeps to the degrees of hulls.
    let found = if (1..=MAX_DEGREE).contains(&degree) {
        KnotVector::new(degree, knots)
    } else {
        Err(SplineError::Degree(degree))
    };
    found.map_err(|error| HullFileError::Spline { field, error })
}

/// Reads a hull file.
///
/// # Errors
/// [`HullFileError`] naming the place and the member.
pub fn read_hull(text: &str) -> Result<HullFile, HullFileError> {
    if text.len() > LARGEST_HULL_FILE {
        return Err(HullFileError::Size(text.len()));
    }
    let head: Head = json(text)?;
    if head.format != FORMAT {
        return Err(HullFileError::Format(head.format.chars().take(40).collect()));
    }
    if head.version != VERSION {
        return Err(HullFileError::Version(head.version));
    }
    let mut record: Record = json(text)?;
    let mut particulars = PrincipalParticulars::from(&record.particulars);
    // Older programs supplied a draught that nobody had stated, and marked it.
    if record.conventions.design_draught_assumed {
        particulars.draught = None;
    }
    record.conventions.without_draught = particulars.draught.is_none();
    let conventions: Conventions = record.conventions.into();
    let name = name_fault(&record.name).map(|fault| format!("name: {fault}. {NAME_REMEDY}"));
    let faults: Vec<String> = name.into_iter().chain(faults(&particulars, &conventions)).collect();
    if !faults.is_empty() {
        return Err(HullFileError::Values(faults));
    }
    let [degree_u, degree_v] = record.surface.degree;
    let [knots_u, knots_v] = record.surface.knots;
    let u = knots("surface.knots[0]", degree_u, knots_u)?;
    let v = knots("surface.knots[1]", degree_v, knots_v)?;
    let (rows, columns) = (u.basis_count(), v.basis_count());
    for (axis, net) in [("x", &record.surface.x), ("y", &record.surface.y), ("z", &record.surface.z)] {
        size(&format!("surface.{axis}"), net.len(), rows)?;
        for (i, row) in net.iter().enumerate() {
            size(&format!("surface.{axis}[{i}]"), row.len(), columns)?;
        }
    }
    let (x, y, z) = (&record.surface.x, &record.surface.y, &record.surface.z);
    let points =
        (0..rows * columns).map(|k| (k / columns, k % columns)).map(|(i, j)| [x[i][j], y[i][j], z[i][j]]).collect();
    let surface =
        BsplineSurface::new(u, v, points).map_err(|error| HullFileError::Spline { field: "surface", error })?;
    let deck_knots = knots("deck.knots", record.deck.degree, record.deck.knots)?;
    size("deck.x", record.deck.x.len(), deck_knots.basis_count())?;
    size("deck.z", record.deck.z.len(), deck_knots.basis_count())?;
    let points = record.deck.x.iter().zip(&record.deck.z).map(|(x, z)| [*x, *z]).collect();
    let deck = BsplineCurve::new(deck_knots, points).map_err(|error| HullFileError::Spline { field: "deck", error })?;
    let hull = Hull::new(&record.name, particulars, surface, deck)?;
    Ok(HullFile { hull, conventions })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn hull(net: &[f64], width: f64) -> Hull {
        let (u, v) = (KnotVector::uniform(3, 2).unwrap(), KnotVector::uniform(2, 3).unwrap());
        let points =
            (0..25).map(|k| [(k / 5) as f64 * 7.3 + 0.1, net[k] * width, (k % 5) as f64 * 1.7 - 0.2]).collect();
        let deck = BsplineCurve::new(KnotVector::uniform(1, 1).unwrap(), vec![[0.1, 6.0], [29.3, 6.1]]).unwrap();
        let particulars = PrincipalParticulars {
            length_between_perpendiculars: 29.0,
            breadth: width,
            draught: Some(3.0),
            depth: 6.0,
        };
        Hull::new("Test \"1\"", particulars, BsplineSurface::new(u, v, points).unwrap(), deck).unwrap()
    }

    fn sample() -> String {
        write_hull(&hull(&[0.3; 25], 8.0), &Conventions::default()).unwrap()
    }

    proptest! {
        #[test]
        fn read_back_bit_for_bit(
            net in proptest::collection::vec(-1.0f64..10.0, 25),
            width in 1e-3f64..1e3,
            density in 0.9f64..1.3,
        ) {
            let conventions = Conventions { density, ..Conventions::default() };
            let written = hull(&net, width);
            let text = write_hull(&written, &conventions).unwrap();
            let read = read_hull(&text).unwrap();
            prop_assert_eq!(&read.hull, &written);
            prop_assert_eq!(read.conventions, conventions);
            prop_assert_eq!(write_hull(&read.hull, &read.conventions).unwrap(), text);
        }

        #[test]
        fn damaged_files_are_refused_or_read_but_never_panic(at in 0usize..2000, byte in 0u8..128) {
            let mut bytes = sample().into_bytes();
            let at = at % bytes.len();
            bytes[at] = byte;
            if let Ok(text) = String::from_utf8(bytes) {
                let _ = read_hull(&text);
            }
        }
    }

    #[test]
    fn every_message() {
        let message = |text: &str| read_hull(text).unwrap_err().to_string();
        let sample = sample();
        assert_eq!(message("{"), "line 1, column 1: the file ends before its value is complete, as if it were cut off");
        assert_eq!(
            message(&sample.replace("loftsman-hull", "other")),
            "format is \"other\", expected \"loftsman-hull\""
        );
        assert_eq!(
            message(&sample.replace("\"version\": 1", "\"version\": 2")),
            "version 2 is newer than this program, which reads version 1; use a newer loftsman"
        );
        let no_number = message(&sample.replacen("2.4", "\"2.4\"", 1));
        assert!(no_number.contains("surface.y[0][0]: invalid type: string \"2.4\", expected f64"), "{no_number}");
        assert!(message(&sample.replacen("2.4", "1e999", 1)).contains("number out of range"));
        assert!(message(&sample.replacen("2.4", "NaN", 1)).contains("expected value"));
        assert_eq!(message(&sample.replacen("2.4,", "", 1)), "surface.y[0]: 4, expected 5");
        assert!(
            message(&sample.replace("\"degree\": [3,2]", "\"degree\": [9,2]"))
                .starts_with("surface.knots[0]: degree 9")
        );
        let sunk = sample.replace("\"D\":6.0", "\"D\":2.5").replace("\"density\":1.025", "\"density\":0.0");
        assert_eq!(
            message(&sunk.replace("\"KG\":null", "\"KG\":1e300")),
            format!(
                "particulars.T is 3 m, expected at most particulars.D, 2.5 m; conventions.density is 0 t/m3, expected 0.9 to 1.3; \
                 conventions.KG is {} m, expected -1000 to 1000",
                1e300
            )
        );
        let negative = sample.replace("\"D\":6.0", "\"D\":-6.0").replace("\"T\":3.0", "\"T\":0.0");
        assert_eq!(
            message(&negative),
            "particulars.T is 0 m, expected more than 0; particulars.D is -6 m, expected more than 0"
        );
        for (shell, expected) in [("factor\":0.5", "1 to 1.1"), ("thickness\":-1.0", "0 to 1")] {
            let said = message(&sample.replace("\"shell\":null", &format!("\"shell\":{{\"{shell}}}")));
            assert!(said.starts_with("conventions.shell") && said.ends_with(expected), "{said}");
        }
        assert!(message(&sample.replace("\"name\"", "\"nome\"")).contains("missing field `name`"));
        let long: Vec<String> = (0..5000).map(|k| k.to_string()).collect();
        let many = sample.replacen("\"knots\": [[", &format!("\"knots\": [[{},", long.join(",")), 1);
        assert!(message(&many).contains("expected at most 4000"));
    }
}
