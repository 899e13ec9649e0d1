//! The text formats of other programs, in the order in which they are tried.

use super::{ReadTable, TableProblem, britfair, delftship, freeship, ghs, pdstrip, pias, points, ratio, seaway};

/// Whether a text is in a format, and the table in it.
type Format = (fn(&str, &str) -> bool, fn(&str, &str) -> Result<ReadTable, Vec<TableProblem>>);

const FORMATS: [Format; 9] = [
    (ghs::recognise, ghs::read),
    (britfair::recognise, britfair::read),
    (seaway::recognise, seaway::read),
    (pdstrip::recognise, pdstrip::read),
    (delftship::recognise, delftship::read),
    (pias::recognise, pias::read),
    (freeship::recognise, freeship::read),
    (ratio::recognise, ratio::read),
    (points::recognise, points::read),
];

/// Larger files are no hulls of these formats \[bytes\].
const LARGEST: usize = 64 << 20;

/// The table in a file of another program; none when it is in none of these formats.
///
/// Bytes that are not UTF-8 stand in names only and are replaced. The TOML beside a file gives the dimensions of a table of
/// fractions; the other formats need none.
pub(super) fn read(
    name: &str,
    bytes: &[u8],
    beside: Option<(&str, &str)>,
) -> Option<Result<ReadTable, Vec<TableProblem>>> {
    if bytes.len() > LARGEST {
        return None;
    }
    let text = String::from_utf8_lossy(bytes);
    if let Some((beside, particulars)) = beside.filter(|_| ratio::recognise(name, &text)) {
        let stated = ratio::read_particulars(beside, particulars);
        return Some(stated.and_then(|stated| ratio::read_with(name, &text, &stated)));
    }
    let (_, read) = FORMATS.iter().find(|(recognise, _)| recognise(name, &text))?;
    Some(read(name, &text))
}
