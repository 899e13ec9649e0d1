//! The text formats of other programs, in the order in which they are tried.

use super::grid::{LARGEST_TABLE, MOST_CELLS, MOST_ROWS, with_line_ends};
use super::problem::{FilePosition, Problems};
use super::settings::Settings;
use super::{
    ReadTable, TableProblem, britfair, delftship, freeship, ghs, heights, michlet, pdstrip, pias, points, ratio, seaway,
};
use crate::hull::{OffsetTable, Program};

/// Whether a text is in a format, the table in it, and the program, where its format can be written.
type Format = (fn(&str, &str) -> bool, Reader, Option<Program>);

type Reader = fn(&str, &str) -> Result<ReadTable, Vec<TableProblem>>;

const FORMATS: [Format; 10] = [
    (michlet::recognise, michlet::read, None),
    (ghs::recognise, ghs::read, Some(Program::Ghs)),
    (britfair::recognise, britfair::read, Some(Program::Britfair)),
    (seaway::recognise, seaway::read, None),
    (pdstrip::recognise, pdstrip::read, Some(Program::Pdstrip)),
    (delftship::recognise, delftship::read, None),
    (pias::recognise, pias::read, Some(Program::Pias)),
    (freeship::recognise, freeship::read, Some(Program::Freeship)),
    (ratio::recognise, ratio::read, None),
    (points::recognise, points::read, None),
];

/// The table in a file of another program; none when it is in none of these formats.
///
/// Bytes that are not UTF-8 stand in names only and are replaced. The TOML beside a file gives the dimensions of a
/// table of fractions, the unit of points, and what the file does not state.
pub(super) fn read(
    name: &str,
    bytes: &[u8],
    sidecar: Option<(&str, &str)>,
    settings: &Settings,
) -> Option<Result<ReadTable, Vec<TableProblem>>> {
    // The reader of fields says what is wrong with longer files.
    if bytes.len() > LARGEST_TABLE || super::xlsx::is_xlsx(bytes) {
        return None;
    }
    let text = with_line_ends(String::from_utf8_lossy(bytes));
    let read = recognised(name, &text, sidecar, settings)?;
    let of_points = points::recognise(name, &text);
    Some(read.and_then(|mut read| {
        let mut problems = Problems::new(name);
        let words = heights::from_waterline_above(&text).filter(|_| of_points);
        let draught = settings.stated.draught.or(read.table.stated.draught);
        heights::settle(&mut read.table, words.as_deref(), draught, &mut problems);
        read.notes.extend(problems.finish()?);
        checked(name, read, settings, [!of_points, true])
    }))
}

/// A table with what the settings say of it, and with what is unknown of its bottom and ends. `own_unit`: its format
/// states the unit; `chines`: its points are no samples of curves, and may be on chines.
pub(super) fn checked(
    name: &str,
    mut read: ReadTable,
    settings: &Settings,
    [own_unit, chines]: [bool; 2],
) -> Result<ReadTable, Vec<TableProblem>> {
    let mut problems = Problems::new(name);
    super::obeyed::obey(settings, own_unit, &mut read.table, &mut problems);
    if chines {
        super::chines::mark(&mut read.table, &mut problems);
    }
    super::bottom::unknown(&read.table, &mut problems);
    super::ends::cut_off(&read.table, &mut problems);
    super::checks::missing(&mut read.table, &mut problems);
    super::checks::particulars(&read.table, &mut problems);
    read.notes.extend(problems.finish()?);
    read.notes.sort_by_key(|note| (note.row.unwrap_or(0), note.column.unwrap_or(0)));
    Ok(read)
}

/// The table in a text of one of the formats.
fn recognised(
    name: &str,
    text: &str,
    sidecar: Option<(&str, &str)>,
    settings: &Settings,
) -> Option<Result<ReadTable, Vec<TableProblem>>> {
    if let Some((sidecar, particulars)) = sidecar.filter(|_| ratio::recognise(name, text)) {
        let stated = super::sidecar::read_particulars(sidecar, particulars);
        return Some(stated.and_then(|stated| ratio::read_with(name, text, &stated)));
    }
    let (_, read, program) = FORMATS.iter().find(|(recognise, _, _)| recognise(name, text))?;
    let fields = text.split([' ', '\t', ',', ';']).take(2 * MOST_CELLS + 1).filter(|part| !part.is_empty()).count();
    if text.lines().take(MOST_ROWS + 1).count() > MOST_ROWS || fields > MOST_CELLS {
        let mut problems = Problems::new(name);
        problems.error("E312", FilePosition::FILE, format!("more than {MOST_ROWS} rows or {MOST_CELLS} numbers"), "");
        return Some(Err(problems.finish().err().unwrap_or_default()));
    }
    let of_points = points::recognise(name, text) && std::ptr::fn_addr_eq(*read, points::read as Reader);
    let read = if of_points { points::read_with(name, text, settings) } else { read(name, text) };
    Some(read.map(|mut read| {
        // Only sections can be written by the writers of these formats.
        let sections = read.table.stations.iter().any(|s| !s.outlines.is_empty()) && read.table.lines.is_empty();
        read.table.form.program = program.filter(|_| sections);
        read
    }))
}

/// The file of a table in the format of a program, when reading it gives the sections of the table: as many, with as
/// many points. The differences of what is read are the largest and the root mean square of those of the points, and
/// the largest of the positions \[m\].
pub(super) fn write(table: &OffsetTable, program: Program) -> Option<super::WrittenTable> {
    let text = match program {
        Program::Ghs => ghs::write(table),
        Program::Britfair => britfair::write(table),
        Program::Pias => pias::write(table),
        Program::Pdstrip => pdstrip::write(table),
        Program::Freeship => freeship::write(table),
    };
    let (_, read, _) = FORMATS.iter().find(|(_, _, of)| *of == Some(program))?;
    let back = read("", &text).ok()?.table;
    let mut rounding = super::Rounding::default();
    let mut squares = 0.0;
    if back.stations.len() != table.stations.len() {
        return None;
    }
    for (a, b) in table.stations.iter().zip(&back.stations) {
        let (here, there): (Vec<_>, Vec<_>) =
            (a.outlines.iter().flatten().collect(), b.outlines.iter().flatten().collect());
        if here.len() != there.len() {
            return None;
        }
        rounding.largest_of_positions = rounding.largest_of_positions.max((a.station.x - b.station.x).abs());
        for (p, q) in here.into_iter().zip(there) {
            let distance = (p.y - q.y).hypot(p.z - q.z);
            rounding.cells += 1;
            rounding.largest = rounding.largest.max(distance);
            squares += distance * distance;
        }
    }
    rounding.root_mean_square = (squares / rounding.cells.max(1) as f64).sqrt();
    // A difference beyond any rounding is another hull.
    (rounding.largest.max(rounding.largest_of_positions) < 1e-3).then_some(super::WrittenTable {
        text,
        rounding,
        is_alike: true,
    })
}
