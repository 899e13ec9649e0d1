//! The lines that are to bear combs, as a user names them: `station 5, waterline 2.0, buttock 1.5, diagonal 3`.

use super::settings::ReportSettings;
use crate::fairing::record::FairRecord;
use crate::plot::CombLine;
use crate::report::failure::Failure;
use crate::report::input::result::JobResult;

/// How near a number has to be to the place of a station or a waterline \[m\].
const NEAR: f64 = 5e-4;

/// Exactness at which a plane is tried to cut the hull \[m\].
const FINE: f64 = 1e-6;

/// The lines of the settings; none where none are named.
///
/// # Errors
/// [`Failure::Usage`] when a word names no line, or the result has no lines with combs.
pub(in crate::report) fn comb_lines(result: &JobResult, settings: &ReportSettings) -> Result<Vec<CombLine>, Failure> {
    let words = settings.combs.split(',').map(str::trim).filter(|word| !word.is_empty());
    let Some((record, _)) = &result.fairing else {
        return match words.count() {
            0 => Ok(Vec::new()),
            _ => Err(Failure::Usage("--combs: only results of `fair` have figures with combs".to_owned())),
        };
    };
    words.map(|word| line(record, word).map_err(|why| Failure::Usage(format!("--combs: {why}")))).collect()
}

/// Some names of a list, for a message.
fn listed(names: impl ExactSizeIterator<Item = String>) -> String {
    const SHOWN: usize = 30;
    let count = names.len();
    let text = names.take(SHOWN).collect::<Vec<_>>().join(", ");
    if count > SHOWN { format!("{text}, ...") } else { text }
}

fn line(record: &FairRecord, word: &str) -> Result<CombLine, String> {
    let (kind, name) = word.split_once(char::is_whitespace).unwrap_or((word, ""));
    let name = name.trim();
    let number = name.parse::<f64>().ok().filter(|value| value.is_finite());
    let lines = &record.lines;
    match kind {
        "station" => {
            let by_name = lines.stations.iter().position(|station| station.name == name);
            let at = |x: f64| lines.stations.iter().position(|station| (station.x - x).abs() <= NEAR);
            by_name.or_else(|| at(number?)).map(CombLine::Station).ok_or_else(|| {
                let names = listed(lines.stations.iter().map(|station| station.name.clone()));
                format!("'{word}' is no station of the table; there are {names}")
            })
        }
        "waterline" => {
            let found = number.and_then(|z| lines.waterlines.iter().position(|other| (other - z).abs() <= NEAR));
            found.map(CombLine::Waterline).ok_or_else(|| {
                let names = listed(lines.waterlines.iter().map(|z| format!("{z}")));
                format!("'{word}' is no waterline of the table; there are {names} m")
            })
        }
        "buttock" | "diagonal" => {
            let place = number.filter(|value| *value > 0.0);
            let place = place.ok_or_else(|| format!("'{word}': expected a distance in metres, as {kind} 2.5"))?;
            let line = if kind == "buttock" { CombLine::Buttock(place) } else { CombLine::Diagonal(place) };
            let cut = line.cut(record);
            if [&record.before, &record.after].iter().all(|hull| hull.section(cut, FINE).branches.is_empty()) {
                let p = record.after.particulars();
                return Err(format!(
                    "'{word}' does not cut the hull, which has a breadth of {} m and a depth of {} m",
                    p.breadth, p.depth
                ));
            }
            Ok(line)
        }
        _ => Err(format!("'{word}': expected station, waterline, buttock or diagonal and its name, as waterline 2.0")),
    }
}
