//! What `fair` wrote, read back for drawings and reports: `fairing.json` and `changes.csv`.

use serde::Deserialize;
use serde_json::Value;

use super::fairing::{kind_word, status_word};
use super::hull_json::json_message;
use crate::fairing::change::Change;
use crate::fairing::record::{AreaTargets, Crossing, Doubt, SectionTarget, TableLines};
use crate::fairing::smoothing::Trial;
use crate::fairing::surface::Origin;
use crate::hull::{LineKind, OffsetStation};
use crate::qp::{Progress, Status};
use crate::units::{Notation, counted, unguarded};

/// Why a text is no file of `fair`.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FairingFileError {
    /// Not JSON, or a member that is missing or of another type.
    #[error("line {line}, column {column}: {message}")]
    Json {
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What was found and expected.
        message: String,
    },
    /// A word that is none of a list.
    #[error("{member}: found \"{found}\", expected one of {expected}")]
    Word {
        /// Member.
        member: &'static str,
        /// What stands there.
        found: String,
        /// What may.
        expected: String,
    },
    /// Another number of offsets than the fairing moved.
    #[error("line {line}: the file ends after {found}, expected the {expected} of fairing.json")]
    Rows {
        /// The line after the last, from 1.
        line: usize,
        /// Offsets that are there, in words.
        found: String,
        /// How many there should be.
        expected: usize,
    },
    /// Not the columns of `changes.csv`.
    #[error("line 1: found no column \"{0}\"")]
    Column(&'static str),
    /// A field that is no number, or names no line of the table.
    #[error("line {line}, column \"{column}\": found \"{found}\", expected {expected}")]
    Field {
        /// Line, from 1.
        line: usize,
        /// Head of the column.
        column: &'static str,
        /// What stands there.
        found: String,
        /// What may.
        expected: &'static str,
    },
}

/// What `fairing.json` says besides its prices and proofs.
#[derive(Debug, Clone)]
pub struct FairingFile {
    /// Name of the ship.
    pub name: String,
    /// How the program ended.
    pub status: Status,
    /// Lines of the table.
    pub lines: TableLines,
    /// What was asked of the sectional-area curve.
    pub targets: AreaTargets,
    /// Offsets that their neighbours contradict.
    pub doubts: Vec<Doubt>,
    /// Energy before and after.
    pub energy: [f64; 2],
    /// Whether the first is that of the likeliest field.
    pub is_field: bool,
    /// The departure of a bend from its chord that counts \[m\], where it is known.
    pub resolution: Option<f64>,
    /// Noise of an offset \[m\].
    pub sigma: f64,
    /// What a search for the smoothing weight takes of it for errors \[m\].
    pub errors: f64,
    /// Rows of `changes.csv`, where it is known.
    pub offsets: Option<usize>,
    /// Offsets that are smoothed, where it is known.
    pub readings: Option<usize>,
    /// Effective degrees of freedom.
    pub edf: f64,
    /// The net at the weight that was taken.
    pub chosen: Trial,
    /// The search for the weight.
    pub trials: Vec<Trial>,
    /// The iterates of the last program.
    pub progress: Vec<Progress>,
    /// All of it.
    pub whole: Value,
}

#[derive(Deserialize)]
struct Record {
    name: String,
    status: String,
    table: LinesRecord,
    noise: Noise,
    #[serde(default)]
    moves: Moves,
    smoothing: Smoothing,
    energy: Energy,
    #[serde(default)]
    convergence: Vec<Iterate>,
    #[serde(default)]
    suspects: Vec<SuspectRecord>,
    #[serde(default)]
    constraints: Vec<HeldRecord>,
    inflections: Option<BandRecord>,
}

#[derive(Deserialize)]
struct BandRecord {
    dead_band: Option<f64>,
}

#[derive(Deserialize)]
struct HeldRecord {
    kind: String,
    target: f64,
    x: Option<f64>,
    #[serde(default)]
    band: f64,
}

/// What was asked of the sectional-area curve; the place of a section is missing from files of old programs.
fn area_targets(held: &[HeldRecord]) -> AreaTargets {
    let of = |kind: &str| held.iter().find(|held| held.kind == kind).map(|held| held.target);
    let sections = held.iter().filter(|held| held.kind == "section_area");
    let section = |held: &HeldRecord| Some(SectionTarget { x: held.x?, area: held.target, band: held.band });
    AreaTargets { volume: of("displacement"), lcb: of("lcb"), sections: sections.filter_map(section).collect() }
}

#[derive(Deserialize, Default)]
struct Moves {
    offsets: Option<usize>,
}

#[derive(Deserialize)]
struct Energy {
    before: f64,
    after: f64,
    #[serde(default)]
    before_is_of_the_field: bool,
}

#[derive(Deserialize)]
struct SuspectRecord {
    id: String,
    station: f64,
    station_name: String,
    waterline: f64,
    written: String,
    value: f64,
    score: f64,
    hypothesis: String,
    proposed: f64,
    proposed_written: String,
}

#[derive(Deserialize)]
struct Iterate {
    primal: f64,
    dual: f64,
    gap: f64,
}

#[derive(Deserialize)]
struct LinesRecord {
    notation: String,
    quantum: Option<f64>,
    stations: Vec<StationRecord>,
    waterlines: Vec<f64>,
    endings: Vec<[Option<f64>; 2]>,
    #[serde(default)]
    crossings: Vec<CrossingRecord>,
}

#[derive(Deserialize)]
struct CrossingRecord {
    station: f64,
    z: f64,
    kind: String,
}

#[derive(Deserialize)]
struct StationRecord {
    name: String,
    x: f64,
}

#[derive(Deserialize)]
struct Noise {
    sigma: f64,
    errors: Option<f64>,
}

#[derive(Deserialize)]
struct Smoothing {
    weight: f64,
    readings: Option<usize>,
    edf: f64,
    rms: f64,
    energy: f64,
    trials: Vec<TrialRecord>,
}

#[derive(Deserialize)]
struct TrialRecord {
    weight: f64,
    gcv: Option<f64>,
    rms: f64,
    energy: f64,
    edf: f64,
}

/// Reads `fairing.json`.
///
/// # Errors
/// [`FairingFileError`] with the place.
pub fn read_fairing(text: &str) -> Result<FairingFile, FairingFileError> {
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let record: Record = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
        let path = error.path().to_string();
        json(error.inner(), if matches!(path.as_str(), "." | "?") { String::new() } else { format!("{path}: ") })
    })?;
    let whole: Value = serde_json::from_str(text).map_err(|error| json(&error, String::new()))?;
    let ends = [Status::Optimal, Status::Infeasible, Status::Unbounded, Status::Limit];
    let status = ends.into_iter().find(|status| status_word(*status) == record.status);
    let word =
        |member, found: &str, expected: String| FairingFileError::Word { member, found: found.to_owned(), expected };
    let status = status.ok_or_else(|| word("status", &record.status, ends.map(status_word).join(", ")))?;
    let table = record.table;
    let notation = Notation::from_word(&table.notation)
        .ok_or_else(|| word("table.notation", &table.notation, "m, mm, feet-inches-eighths, cm, ft, in".to_owned()))?;
    let stations: Vec<OffsetStation> =
        table.stations.into_iter().map(|s| OffsetStation { name: s.name, x: s.x }).collect();
    let station_at = |x: f64| stations.iter().position(|station| (station.x - x).abs() <= 1e-9);
    let kinds = [LineKind::Knuckle, LineKind::Tangent];
    let crossing = |c: CrossingRecord| {
        let kind = kinds.into_iter().find(|kind| kind_word(*kind) == c.kind)?;
        Some(Crossing { station: station_at(c.station)?, z: c.z, kind })
    };
    let crossings = table.crossings.into_iter().filter_map(crossing).collect();
    let doubt = |suspect: SuspectRecord| {
        let named = |station: &OffsetStation| {
            (station.x - suspect.station).abs() <= 1e-9 && station.name == suspect.station_name
        };
        Some(Doubt {
            station: stations.iter().position(named)?,
            id: suspect.id,
            z: suspect.waterline,
            value: suspect.value,
            proposed: suspect.proposed,
            written: [suspect.written, suspect.proposed_written],
            hypothesis: suspect.hypothesis,
            score: Some(suspect.score),
        })
    };
    let doubts = record.suspects.into_iter().filter_map(doubt).collect();
    let smoothing = record.smoothing;
    Ok(FairingFile {
        name: record.name,
        status,
        targets: area_targets(&record.constraints),
        doubts,
        energy: [record.energy.before, record.energy.after],
        is_field: record.energy.before_is_of_the_field,
        lines: TableLines {
            stations,
            waterlines: table.waterlines,
            endings: table.endings,
            quantum: table.quantum,
            notation,
            crossings,
        },
        resolution: record.inflections.and_then(|inflections| inflections.dead_band),
        sigma: record.noise.sigma,
        errors: record.noise.errors.unwrap_or(record.noise.sigma),
        offsets: record.moves.offsets,
        readings: smoothing.readings,
        edf: smoothing.edf,
        chosen: Trial {
            lambda: smoothing.weight,
            gcv: f64::NAN,
            rms: smoothing.rms,
            energy: smoothing.energy,
            edf: smoothing.edf,
        },
        trials: smoothing
            .trials
            .into_iter()
            .map(|t| Trial {
                lambda: t.weight,
                gcv: t.gcv.unwrap_or(f64::NAN),
                rms: t.rms,
                energy: t.energy,
                edf: t.edf,
            })
            .collect(),
        progress: record
            .convergence
            .into_iter()
            .map(|p| Progress { primal: p.primal, dual: p.dual, gap: p.gap })
            .collect(),
        whole,
    })
}

fn json(error: &serde_json::Error, field: String) -> FairingFileError {
    let message = format!("{field}{}", json_message(error));
    FairingFileError::Json { line: error.line(), column: error.column(), message }
}

/// The columns of `changes.csv` that are read.
const COLUMNS: [&str; 9] =
    ["waterline", "x [m]", "z [m]", "before [m]", "after [m]", "tolerance [m]", "locked", "suspect", "station"];

/// No offset is farther from the centreplane, no place farther from the origin \[m\].
const FARTHEST: f64 = 1e5;

/// No offset moves farther \[m\].
const FARTHEST_MOVE: f64 = 1e3;

/// Reads `changes.csv`; stations and waterlines are found among those of the table by their places. `offsets` is how
/// many rows it should have, where that is known.
///
/// # Errors
/// [`FairingFileError`] with line and column.
pub fn read_changes(text: &str, lines: &TableLines, offsets: Option<usize>) -> Result<Vec<Change>, FairingFileError> {
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(text.as_bytes());
    let heads = reader.headers().cloned().unwrap_or_default();
    let mut at = [0; COLUMNS.len()];
    for (place, name) in at.iter_mut().zip(COLUMNS) {
        *place = heads.iter().position(|head| head == name).ok_or(FairingFileError::Column(name))?;
    }
    let mut changes = Vec::new();
    for (row, record) in reader.records().enumerate() {
        let line = row + 2;
        let record = record.unwrap_or_default();
        let wrong = |column: usize, expected| FairingFileError::Field {
            line,
            column: COLUMNS[column],
            found: record.get(at[column]).unwrap_or_default().to_owned(),
            expected,
        };
        let field = |column: usize| record.get(at[column]).unwrap_or_default();
        if field(3).is_empty() != field(4).is_empty() {
            // It was unknown before, or no part of the hull reads it.
            continue;
        }
        let number = |column: usize| {
            let value = field(column).parse::<f64>().map_err(|_| wrong(column, "a number"))?;
            // Not a number is neither.
            if value.abs() <= FARTHEST { Ok(value) } else { Err(wrong(column, "a number of at most 100000 m")) }
        };
        let x = number(1)?;
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-9;
        let station = lines.stations.iter().position(|s| near(s.x, x) && s.name == unguarded(field(8)));
        let station = station.ok_or_else(|| wrong(8, "a station of the table in fairing.json, with its x"))?;
        let counted = |text: &str| text.parse::<usize>().ok();
        let origin = match (field(0), field(0).strip_prefix("point ")) {
            ("deck", _) => Origin::Deck { station },
            (_, Some(place)) => {
                let pair = place.split_once('.').and_then(|(a, b)| Some((counted(a)?, counted(b)?)));
                let (outline, point) =
                    pair.ok_or_else(|| wrong(0, "the number of an outline and of its point, point 0.6"))?;
                Origin::Point { station, outline, point }
            }
            _ => {
                let z = number(0)?;
                let found = lines.waterlines.iter().position(|&other| near(other, z));
                let waterline = found.ok_or_else(|| wrong(0, "a waterline of the table in fairing.json, or deck"))?;
                Origin::HalfBreadth { station, waterline }
            }
        };
        let [before, after] = [number(3)?, number(4)?];
        if (after - before).abs() > FARTHEST_MOVE {
            return Err(wrong(4, "an offset that moves by at most 1000 m"));
        }
        changes.push(Change {
            station,
            origin,
            x,
            z: number(2)?,
            before,
            after,
            tolerance: if field(5).is_empty() { None } else { Some(number(5)?) },
            suspect: field(7) == "yes",
            locked: field(6) == "yes",
        });
    }
    let found = changes.len();
    match offsets.unwrap_or(found.max(1)) {
        expected if expected == found => Ok(changes),
        expected => Err(FairingFileError::Rows { line: found + 2, found: counted(found, "offset"), expected }),
    }
}

/// The offsets of `changes.csv` as they are written in the table before and after, row by row; empty where they are not
/// known.
#[must_use]
pub fn read_texts(text: &str) -> Vec<[String; 2]> {
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(text.as_bytes());
    let heads = reader.headers().cloned().unwrap_or_default();
    let at = ["text before", "text after"].map(|name| heads.iter().position(|head| head == name));
    let field = |record: &csv::StringRecord, at: Option<usize>| {
        at.and_then(|at| record.get(at)).unwrap_or_default().trim().to_owned()
    };
    let texts = |record: csv::Result<csv::StringRecord>| {
        let record = record.unwrap_or_default();
        at.map(|at| field(&record, at))
    };
    // What was unknown before is none of the offsets that moved.
    let before = heads.iter().position(|head| head == COLUMNS[3]);
    let known = |record: &csv::Result<csv::StringRecord>| {
        let unknown = before.and_then(|before| record.as_ref().ok()?.get(before)).is_some_and(str::is_empty);
        !unknown
    };
    reader.records().filter(known).map(texts).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines() -> TableLines {
        TableLines {
            stations: vec![OffsetStation { name: "1".into(), x: 5.0 }],
            waterlines: vec![0.5, 1.25],
            endings: vec![[None; 2]; 2],
            quantum: Some(1e-3),
            notation: Notation::Metres,
            crossings: Vec::new(),
        }
    }

    const HEAD: &str = "station,waterline,x [m],z [m],before [m],after [m],move [m],tolerance [m],used,locked,suspect";

    #[test]
    fn changes_are_read_back() {
        let text = format!(
            "{HEAD}\n1,1.25,5,1.25,2,2.001,0.001,0.002,0.5,yes,\n1,deck,5,3,2.5,2.4,-0.1,,,,yes\n1,point 1.6,5,3,2,2,0,,,,\n"
        );
        let changes = read_changes(&text, &lines(), None).unwrap();
        let waterline = Some(1);
        assert_eq!(
            (changes[0].origin.waterline(), changes[0].tolerance, changes[0].locked),
            (waterline, Some(0.002), true)
        );
        let deck = Origin::Deck { station: 0 };
        assert_eq!((changes[1].origin, changes[1].tolerance, changes[1].suspect), (deck, None, true));
        assert_eq!(changes[2].origin, Origin::Point { station: 0, outline: 1, point: 6 });
        assert!(read_changes(&text.replace("1.6", "1"), &lines(), None).is_err());
    }

    #[test]
    fn texts_of_offsets_are_read_where_they_are_known() {
        let text =
            format!("{HEAD},text before,text after\n1,1.25,5,1.25,2,2.001,0.001,,,,,2-0-0,2-0-1+\n1,deck,5,3,2,2\n");
        let texts = [["2-0-0", "2-0-1+"], ["", ""]].map(|pair| pair.map(str::to_owned));
        assert_eq!(read_texts(&text), texts);
        assert_eq!(read_texts(&format!("{HEAD}\n1,1.25\n")), [[String::new(), String::new()]]);
    }

    #[test]
    fn every_fault_has_its_place() {
        let message = |text: &str| read_changes(text, &lines(), Some(2)).unwrap_err().to_string();
        assert_eq!(message("station,x\n"), "line 1: found no column \"waterline\"");
        assert_eq!(
            message(&format!("{HEAD}\n1,0.6,5,0.6,2,2,0,,,,\n")),
            "line 2, column \"waterline\": found \"0.6\", expected a waterline of the table in fairing.json, or deck"
        );
        assert_eq!(
            message(&format!("{HEAD}\n1,0.5,5,0.5,two,2,0,,,,\n")),
            "line 2, column \"before [m]\": found \"two\", expected a number"
        );
        let row = |after: &str| format!("{HEAD}\n1,0.5,5,0.5,2,{after},0,,,,\n");
        assert_eq!(message(&row("2")), "line 3: the file ends after 1 offset, expected the 2 of fairing.json");
        for (after, expected) in [
            ("nan", "a number of at most 100000 m"),
            ("-inf", "a number of at most 100000 m"),
            ("1e300", "a number of at most 100000 m"),
            ("1002.1", "an offset that moves by at most 1000 m"),
        ] {
            let said = format!("line 2, column \"after [m]\": found \"{after}\", expected {expected}");
            assert_eq!(message(&row(after)), said);
        }
        assert!(read_changes(&format!("{HEAD}\n"), &lines(), None).is_err());
        let head = read_fairing("{\"name\": 1}").unwrap_err().to_string();
        assert_eq!(head, "line 1, column 10: name: invalid type: integer `1`, expected a string");
    }
}
