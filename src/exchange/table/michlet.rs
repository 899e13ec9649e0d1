//! Input files of Michlet (L. Lazauskas, Cyberiad), `in.mlt`: half-breadths of the immersed hull on a grid, in a list
//! of values under comment lines that say what each is.
//!
//! Rows are stations at equal distances from the foremost to the aftmost point below the waterline, columns waterlines
//! at equal distances from the lowest point to the waterline, both odd in number, 5 to 81. The program scales the
//! half-breadths to the displacement volume that the file gives. Read are the two numbers, the offsets, volume, length
//! and draught, by their comments; x counts from the aftmost point, z from the lowest. Everything else that is written
//! is a start for the user: salt water at 15 degrees, 41 speeds up to Fn 0.5 by ITTC 1957, even keel.

use super::fields::{Separator, TextLine, finish, lines};
use super::problem::{FilePosition, Problems};
use super::{ReadTable, TableProblem};
use crate::hull::{
    Cell, Entry, Marks, OffsetTable, StatedParticulars, StationOffsets, TableForm, TableLayout, Written,
};
use crate::units::counted;
use std::fmt::Write as _;

/// Stations and waterlines of a grid at most.
const MOST: usize = 81;

/// Gravity \[m/s^2\].
const GRAVITY: f64 = 9.80665;

/// Differences of the two volumes beyond this part of one are reported.
const VOLUMES_APART: f64 = 0.02;

/// The comments, in small letters, under which what is read stands.
const LABELS: [&str; 6] = [
    "number of offset stations",
    "number of offset waterlines",
    "offsets",
    "displacement volume",
    "length (",
    "draft (",
];

/// Whether this is such a file: its comments name the two numbers.
pub(super) fn recognise(_name: &str, text: &str) -> bool {
    let found = |label: &str| {
        text.lines().any(|line| line.trim_start().starts_with('#') && line.to_ascii_lowercase().contains(label))
    };
    found(LABELS[0]) && found(LABELS[1])
}

/// The values under each comment that begins so, up to the next comment.
fn blocks<'a, 'b>(rows: &'b [TextLine<'a>], label: &str) -> impl Iterator<Item = &'b [TextLine<'a>]> {
    let comment = |line: &TextLine<'_>| line.text.starts_with('#');
    let named = move |line: &TextLine<'_>| {
        let words = line.text.trim_start_matches('#').trim().to_ascii_lowercase();
        comment(line) && words.starts_with(label)
    };
    rows.iter().enumerate().filter(move |(_, line)| named(line)).map(move |(at, _)| {
        let count = rows[at + 1..].iter().take_while(|line| !comment(line)).count();
        &rows[at + 1..=at + count]
    })
}

/// The values under a comment; those of the first hull. Comments with nothing under them, such as the title, are passed
/// over.
fn under<'a, 'b>(rows: &'b [TextLine<'a>], label: &str) -> &'b [TextLine<'a>] {
    blocks(rows, label).find(|block| !block.is_empty()).unwrap_or(&[])
}

/// The offsets: the first block of their label whose rows have more than one value, else the first with values.
fn offsets<'a, 'b>(rows: &'b [TextLine<'a>]) -> &'b [TextLine<'a>] {
    let grid = |block: &&[TextLine<'_>]| block.first().is_some_and(|line| line.fields.len() > 1);
    blocks(rows, LABELS[2]).find(grid).unwrap_or_else(|| under(rows, LABELS[2]))
}

/// Reads the first hull of a file.
///
/// # Errors
/// Every problem of the file.
pub(super) fn read(name: &str, text: &str) -> Result<ReadTable, Vec<TableProblem>> {
    let mut problems = Problems::new(name);
    let rows: Vec<TextLine<'_>> =
        lines(text, Separator::CommaOrBlank).into_iter().filter(|line| !line.text.is_empty()).collect();
    let value = |label: &str, problems: &mut Problems| {
        let field = under(&rows, label).first().and_then(|line| line.fields.first().copied());
        if field.is_none() {
            let message = format!("no value under a comment '# {label}'");
            problems.error("E326", FilePosition::FILE, message, "Write it under its comment.");
        }
        field
    };
    let counts = [0, 1].map(|k| value(LABELS[k], &mut problems));
    let measures = [3, 4, 5].map(|k| value(LABELS[k], &mut problems));
    let wanted = [0, 1].map(|k| counts[k].and_then(|field| problems.count(field, LABELS[k], 5)));
    let mut measure = |k: usize, what: &str| {
        let found = measures[k].and_then(|field| problems.number(field, what).map(|value| (field, value)));
        found.and_then(|(field, value)| {
            if value <= 0.0 {
                problems.error("E327", field, format!("{what} is {value}"), "It must be larger than 0.");
            }
            Some(value).filter(|value| *value > 0.0)
        })
    };
    let (volume, length, draught) =
        (measure(0, "the displacement volume"), measure(1, "the length"), measure(2, "the draught"));
    let block = offsets(&rows);
    if let ([line], true) = (block, wanted[0].is_some_and(|n| n > 1))
        && line.fields.len() > 1
        && wanted[1] != Some(line.fields.len())
    {
        let message = "the hull is one of a series given by parameters".to_owned();
        problems.error("E328", (FilePosition::row(line.row), line.text), message, "Give its offsets.");
        return finish(problems, None);
    }
    let ([Some(stations), Some(waterlines)], Some(length), Some(draught)) = (wanted, length, draught) else {
        return finish(problems, None);
    };
    if block.len() != stations {
        let row = block.first().map_or(1, |line| line.row);
        let message =
            format!("{} announced, {} of offsets read", counted(stations, "station"), counted(block.len(), "row"));
        problems.error("E322", FilePosition::row(row), message, "Correct the number, or the rows.");
    }
    let mut list = Vec::new();
    for (k, line) in block.iter().enumerate() {
        if line.fields.len() != waterlines {
            let message = format!("{} announced, the row has {}", counted(waterlines, "waterline"), line.fields.len());
            problems.error(
                "E322",
                (FilePosition::row(line.row), line.text),
                message,
                "Correct the number, or the row.",
            );
            continue;
        }
        let share = 1.0 - k as f64 / (stations.max(2) - 1) as f64;
        let mut station = StationOffsets::new((stations - 1 - k.min(stations - 1)).to_string(), length * share);
        for &field in &line.fields {
            let y = problems.length(field, "a half-breadth");
            if y.is_some_and(|y| y < 0.0) {
                problems.error(
                    "E325",
                    field,
                    "a half-breadth is negative".to_owned(),
                    "Write 0 where there is no hull.",
                );
            }
            let written = Written { text: field.text.to_owned(), row: field.row, column: field.column };
            let entry = y.map_or(Entry::Absent, Entry::Given);
            station.half_breadths.push(Cell { entry, marks: Marks::default(), written: Some(written) });
        }
        list.push(station);
    }
    if problems.any_errors() {
        return finish(problems, None);
    }
    list.reverse();
    let heights: Vec<f64> = (0..waterlines).map(|j| draught * j as f64 / (waterlines - 1) as f64).collect();
    let own = enclosed(&list, length, draught);
    if let Some(volume) = volume.filter(|volume| (own / volume - 1.0).abs() > VOLUMES_APART) {
        let message = format!(
            "the offsets enclose {own:.4} m3, the file states {volume:.4} m3, to which Michlet scales them; they are read as written"
        );
        problems.warning("W334", FilePosition::FILE, message, "");
    }
    problems.note(format!(
        "{stations} stations from the bow aft and {waterlines} waterlines of the immersed hull; x counts from its aftmost point, z \
         from its lowest"
    ));
    let breadth = list.iter().flat_map(|s| &s.half_breadths).filter_map(Cell::value).fold(0.0, f64::max);
    let stated = StatedParticulars {
        length_between_perpendiculars: Some(length),
        breadth: Some(2.0 * breadth),
        draught: Some(draught),
        depth: None,
    };
    let form = TableForm { layout: TableLayout::Other, decimals: Some(problems.decimals), ..TableForm::default() };
    finish(problems, Some(OffsetTable { waterlines: heights, stations: list, stated, form, ..OffsetTable::default() }))
}

/// The volume by trapezoids \[m^3\].
fn enclosed(stations: &[StationOffsets], length: f64, draught: f64) -> f64 {
    let trapezoid =
        |values: &[f64], step: f64| values.windows(2).map(|pair| 0.5 * step * (pair[0] + pair[1])).sum::<f64>();
    let areas: Vec<f64> = stations
        .iter()
        .map(|station| {
            let ys: Vec<f64> = station.half_breadths.iter().map(|cell| cell.value().unwrap_or(0.0)).collect();
            2.0 * trapezoid(&ys, draught / (ys.len().max(2) - 1) as f64)
        })
        .collect();
    trapezoid(&areas, length / (areas.len().max(2) - 1) as f64)
}

/// The text of an input file.
///
/// `table` has its stations at equal distances from the aftmost to the foremost point below the highest waterline, and
/// its waterlines at equal distances from the lowest point up; `volume` is that of displacement \[m^3\].
#[must_use]
pub fn write(table: &OffsetTable, name: &str, volume: f64) -> String {
    let position = |k: usize| table.stations.get(k).map_or(0.0, |station| station.station.x);
    let (stations, waterlines) = (table.stations.len().min(MOST), table.waterlines.len().min(MOST));
    let length = position(stations.saturating_sub(1)) - position(0);
    let height = |j: usize| table.waterlines.get(j).copied().unwrap_or(0.0);
    let draught = height(waterlines.saturating_sub(1)) - height(0);
    let speed = |froude: f64| froude * (GRAVITY * length).sqrt();
    let mut text = String::new();
    let mut say = |comment: &str, value: &str| {
        let _ = writeln!(text, "# {comment}\n{value}");
    };
    let name: String = name.chars().filter(|c| !c.is_control()).take(60).collect();
    say(&format!("{name}\n# Input File Type (0=Standard)"), "0");
    say("Input File Subtype (0=Standard)", "0");
    say("Output File Type (0=Standard)", "0");
    say("Output File Subtype (0=Standard)", "0");
    say("Course Particulars (0=None)", "0");
    say("Number of Hulls (1, 2,..., or 5)", "1");
    say("Gravitational Acceleration (m/sec/sec)", &GRAVITY.to_string());
    say("Water Density (kg/cubic metre)", "1025.9");
    say("Water Kin. Viscosity (sq. m/sec * 10^-6)", "1.1883");
    say("Base Eddy Kin. Viscosity (non-dimensional, min 1.0)", "10.0");
    say("Water Depth (metres) (max=10000.0)", "10000.0");
    say("Air Density (kg/cubic metre)", "1.226");
    say("Air Kin. Viscosity (sq. m/sec * 10^-6)", "14.4");
    say("Wind Speed (m/sec)", "0.0");
    say("Wind Direction (degrees)", "0.0");
    say("Minimum Speed (m/sec)", &format!("{:.3}", speed(0.1)));
    say("Maximum Speed (m/sec)", &format!("{:.3}", speed(0.5)));
    say("Number of Speeds", "41");
    say("Leeway Parameters (0=None)", "0");
    say("Wave Drag Ntheta", "1024");
    say("Skin Friction Method (0=None, 1=ITTC1957, 2=Grigson)", "1");
    say("Viscous Form Factor Method (0=None, 3=Dual)", "0");
    say("Viscous Drag Form Factor", "1.0");
    say("Wave Drag Form Factor", "1.0");
    say("Pressure Signature Method (0=None,1=Slender body)", "1");
    say("Number of Offset Stations (rows) (odd integer: min 5, max 81)", &stations.to_string());
    say("Number of Offset Waterlines (columns) (odd integer: min 5, max 81)", &waterlines.to_string());
    say("Ship Loading Type", "3");
    say("Ship Loading Formula Parameters", "1.0,0.0,0.0");
    // The field of waves: a sector and a rectangle abaft the ship, a beach beside it, in lengths of the ship.
    let lengths = |share: f64| format!("{:.3}", share * length);
    say("R0", &lengths(0.5));
    say("R1", &lengths(3.0));
    say("Beta", "22.5");
    say("Nr", "101");
    say("Nbeta", "101");
    say("x0", &lengths(-0.5));
    say("x1", &lengths(3.0));
    say("y0", &lengths(-1.0));
    say("y1", &lengths(1.0));
    say("Nwx", "101");
    say("Nwy", "101");
    say("x0", &lengths(0.5));
    say("x1", &lengths(3.0));
    say("y0", &lengths(1.0));
    say("z0", "-1.0");
    say("z1", "0.0");
    say("Slope", "90.0");
    say("Nbx", "11");
    say("Nbz", "11");
    let rows: Vec<String> = table.stations[..stations]
        .iter()
        .rev()
        .map(|station| {
            let breadth = |j: usize| station.half_breadths.get(j).and_then(Cell::value).unwrap_or(0.0).max(0.0);
            (0..waterlines).map(|j| format!("{:.5}", breadth(j))).collect::<Vec<_>>().join(",")
        })
        .collect();
    say("Offsets", &rows.join("\n"));
    say("Displacement Volume (cubic metres)", &format!("{volume:.6}"));
    say("Length (metres)", &format!("{length:.6}"));
    say("Draft (metres)", &format!("{draught:.6}"));
    say("Longitudinal Separation (metres) (0.0 for a monohull)", "0.0");
    say("Lateral Separation Distance (metres) (0.0 for a monohull)", "0.0");
    say("Loading Type for this hull", "3");
    say("Loading Formula Parameters", "1.0,0.0,0.0");
    for motion in ["Trim", "Sinkage", "Heel"] {
        say(&format!("{motion} Method"), "0");
        say(&format!("{motion}: Number of speeds ( >= 2)"), "2");
        say(&format!("{motion}: speed, amount"), "0.0,0.0\n10.0,0.0");
    }
    say("Appendages (0=None)", "0");
    say("Other Particulars (0=None)", "0");
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boat() -> OffsetTable {
        let stations = (0..5).map(|i| {
            let ys = (0..5).map(|j| Cell::from(Some(0.25 * f64::from(i * (4 - i)) * f64::from(j + 1))));
            StationOffsets { half_breadths: ys.collect(), ..StationOffsets::new(i.to_string(), 10.0 * f64::from(i)) }
        });
        OffsetTable {
            waterlines: (0..5).map(|j| 0.5 * f64::from(j)).collect(),
            stations: stations.collect(),
            ..OffsetTable::default()
        }
    }

    #[test]
    fn what_is_written_is_read_back() {
        let table = boat();
        let volume = enclosed(&table.stations, 40.0, 2.0);
        let text = write(&table, "boat", volume);
        assert!(recognise("in.mlt", &text));
        let back = read("in.mlt", &text).unwrap();
        assert!(back.notes.iter().all(|note| note.code != "W334"), "{:?}", back.notes);
        let back = back.table;
        assert_eq!(back.waterlines, table.waterlines);
        assert_eq!(back.stations.len(), table.stations.len());
        for (a, b) in back.stations.iter().zip(&table.stations) {
            assert!((a.station.x - b.station.x).abs() < 1e-12);
            for (p, q) in a.half_breadths.iter().zip(&b.half_breadths) {
                assert!((p.value().unwrap() - q.value().unwrap()).abs() < 1e-12);
            }
        }
        assert_eq!(write(&back, "boat", volume), text);
        // Titles are comments like those that say what follows.
        for title in ["offsets", "length (m)"] {
            assert!(read("in.mlt", &text.replacen("boat", title, 1)).is_ok_and(|read| read.table.stations.len() == 5));
        }
    }

    #[test]
    fn faults_are_named() {
        let text = write(&boat(), "boat", 1.0);
        let said = |text: &str| match read("in.mlt", text) {
            Ok(read) => read.notes.iter().map(ToString::to_string).collect::<String>(),
            Err(list) => list.iter().map(ToString::to_string).collect::<String>(),
        };
        assert!(said(&text).contains("W334") && said(&text).contains("to which Michlet scales them"));
        assert!(said(&text.replace("max 81)\n5\n# Number", "max 81)\n7\n# Number")).contains("E322"));
        assert!(said(&text.replace("# Draft", "# Depth")).contains("E326"));
        assert!(said(&text.replace("40.000000", "0.0")).contains("E327"));
        assert!(said(&text.replace("0.75000,1.50000", "0.75000,-1.50000")).contains("E325"));
        let series =
            text.replace(&text[text.find("# Offsets\n").unwrap() + 10..text.find("# Disp").unwrap()], "1, 0.5, 1.0\n");
        assert!(said(&series).contains("E328"), "{}", said(&series));
    }
}
