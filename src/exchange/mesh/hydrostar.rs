//! Meshes of HydroStar (Bureau Veritas): COORDINATES with or without the numbers of nodes, PANEL TYPE 0 (corners) or 1 (its
//! number, then corners), each up to its END. SYMMETRY 1 mirrors at y = 0, 2 at x = 0 too.

use super::super::fault::RecordFault;
use super::numbers::Numbers;
use super::panels_read::{PanelBody, body, quadrilateral, too_many};

/// Words that begin sections.
const NODES: &str = "COORDINATES";
const PANELS: &str = "PANEL";

/// Whether this is the beginning of a mesh of HydroStar.
pub(in super::super) fn is_hydrostar(bytes: &[u8]) -> bool {
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(2000)]).into_owned();
    // TYPE and its number may follow.
    let begins = |line: &str| {
        let mut words = line.split_whitespace();
        words.next() == Some(NODES) && words.next().is_none_or(|word| word == "TYPE")
    };
    start.lines().any(begins)
}

/// Reads a mesh of HydroStar.
///
/// # Errors
/// Every fault of the file, up to a number of them.
pub(in super::super) fn read_hydrostar(bytes: &[u8]) -> Result<PanelBody, Vec<RecordFault>> {
    let mut numbers = Numbers::of(bytes);
    let (mut nodes, mut corners, mut planes) = (Vec::new(), Vec::new(), [false; 2]);
    // Of nodes: whether this is their section; of panels: the numbers before their corners.
    let (mut in_nodes, mut before) = (false, None);
    while let Some(line) = numbers.rest_of_line() {
        let place = numbers.place();
        let words: Vec<&str> = line.split([' ', '\t', ':', ',']).filter(|word| !word.is_empty()).collect();
        let Some(first) = words.first() else { continue };
        if let Some(section) = first.strip_prefix("END") {
            (in_nodes, before) = (in_nodes && section != NODES, before.filter(|_| section != PANELS));
            if section == "FILE" {
                break;
            }
        } else if first.starts_with(NODES) {
            in_nodes = true;
        } else if *first == PANELS {
            let kind = words.last().and_then(|word| word.parse::<usize>().ok()).filter(|kind| *kind <= 1);
            if kind.is_none() {
                numbers.faults.add(place, line, "expected PANEL TYPE 0 or 1".to_owned());
            }
            before = kind;
        } else if *first == "SYMMETRY" {
            let [across, along] = match words.last() {
                Some(&"1") => [true, false],
                Some(&"2") => [true, true],
                _ => [false, false],
            };
            planes = [along, across];
        } else if in_nodes {
            let point = if words.len() == 4 { &words[1..] } else { &words[..] };
            if words.len() == 4 && words[0].parse() != Ok(nodes.len() + 1) {
                numbers.faults.add(
                    place,
                    words[0],
                    format!("expected node {}: nodes stand in their order", nodes.len() + 1),
                );
            }
            nodes.extend(numbers.faults.point(place.unwrap_or(0), line, point, 3));
        } else if let Some(before) = before {
            let found: Option<Vec<usize>> = words.iter().skip(before).map(|word| word.parse().ok()).collect();
            let panel = match found.as_deref() {
                Some(&[a, b, c]) => quadrilateral([a, b, c, c], &nodes, place, &mut numbers.faults),
                Some(&[a, b, c, d]) => quadrilateral([a, b, c, d], &nodes, place, &mut numbers.faults),
                _ => {
                    numbers.faults.add(place, line, "expected 3 or 4 numbers of nodes".to_owned());
                    None
                }
            };
            corners.extend(panel.into_iter().flatten());
        }
        if numbers.faults.is_full() || too_many(nodes.len().max(corners.len() / 2), &mut numbers.faults) {
            break;
        }
    }
    body(numbers.faults, corners, planes)
}
