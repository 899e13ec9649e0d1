//! Lines beyond the outermost offsets of the table they come from: they are drawn dashed.

use super::inputs::FigureInputs;
use super::outline;
use super::view::OUTLINE;
use crate::fairing::record::FairRecord;
use crate::hull::Cut;
use crate::plot::paper::canvas::{Canvas, Pen};

/// What stands on drawings with lines beyond their outermost offsets.
pub(in crate::plot) const BEYOND: &str = "dashed: beyond the outermost offsets, extrapolated";

/// Least length of a line beyond its offsets that is distinguished, as a part of that of all offsets.
const BEYOND_LEAST: f64 = 2e-3;

/// The same pen for the part of a line beyond the outermost offsets.
pub(in crate::plot) const fn guessed(pen: Pen) -> Pen {
    pen.dashed(&[1.3, 0.9])
}

/// x of the outermost offsets and of the given ends of a waterline of the table \[m\]; none of other lines.
pub(in crate::plot) fn known(record: &FairRecord, cut: &Cut) -> Option<[f64; 2]> {
    let Cut::Waterline { z } = *cut else { return None };
    let own = record.changes.iter().filter(|change| (change.z - z).abs() < 1e-9).map(|change| change.x);
    let number = record.lines.waterlines.iter().position(|other| (other - z).abs() < 1e-9);
    let ends = number.and_then(|k| record.lines.endings.get(k)).into_iter().flatten().copied().flatten();
    let all: Vec<f64> = own.chain(ends).collect();
    let [low, high] = all.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(*x), b.max(*x)]);
    let (stations, slack) = (&record.lines.stations, BEYOND_LEAST);
    let length = stations.first().zip(stations.last()).map_or(0.0, |(a, b)| slack * (b.x - a.x));
    (low <= high).then_some([low - length, high + length])
}

/// A line in the parts that lie between two x, and beyond them: whether beyond, and the points.
pub(in crate::plot) fn parts(line: &[[f64; 3]], between: Option<[f64; 2]>) -> Vec<(bool, Vec<[f64; 3]>)> {
    let Some([low, high]) = between else { return vec![(false, line.to_vec())] };
    let beyond = |p: &[f64; 3]| p[0] < low || p[0] > high;
    let mut parts: Vec<(bool, Vec<[f64; 3]>)> = Vec::new();
    for p in line {
        match parts.last_mut() {
            Some((out, points)) if *out == beyond(p) => points.push(*p),
            last => {
                let from = last.and_then(|(_, points)| points.last().copied());
                let border = from.map(|q| {
                    let limit = if p[0].min(q[0]) < low { low } else { high };
                    let t = (limit - q[0]) / (p[0] - q[0]);
                    std::array::from_fn(|d| q[d] + t * (p[d] - q[d]))
                });
                if let Some((border, (_, points))) = border.zip(parts.last_mut()) {
                    points.push(border);
                }
                parts.push((beyond(p), border.into_iter().chain([*p]).collect()));
            }
        }
    }
    parts
}

/// The centreplane profile in the parts that lie between the offsets and given ends of the waterlines beside them, and
/// those that lie beyond: whether beyond, and the points.
pub(in crate::plot) fn profile_parts(record: &FairRecord, line: &[[f64; 3]]) -> Vec<(bool, Vec<[f64; 3]>)> {
    let waterlines = &record.lines.waterlines;
    let ranges: Vec<Option<[f64; 2]>> = waterlines.iter().map(|&z| known(record, &Cut::Waterline { z })).collect();
    let beyond = |[x, _, z]: [f64; 3]| {
        let above = waterlines.partition_point(|other| *other < z);
        let beside = [above.checked_sub(1), Some(above)].into_iter().flatten();
        let beside: Vec<[f64; 2]> = beside.filter_map(|k| *ranges.get(k)?).collect();
        !beside.is_empty() && beside.iter().all(|[low, high]| x < *low || x > *high)
    };
    let mut parts: Vec<(bool, Vec<[f64; 3]>)> = Vec::new();
    for pair in line.windows(2) {
        let out = beyond(std::array::from_fn(|d| 0.5 * (pair[0][d] + pair[1][d])));
        match parts.last_mut() {
            Some((before, points)) if *before == out => points.push(pair[1]),
            _ => parts.push((out, pair.to_vec())),
        }
    }
    parts
}

/// The centreplane profile of a hull in its parts: whether beyond the offsets of the table it comes from, and the points
/// (x, z) \[m\].
fn profile_of(inputs: &FigureInputs) -> Vec<(bool, Vec<[f64; 3]>)> {
    let line: Vec<[f64; 3]> = outline::centreplane(inputs.hull).into_iter().map(|[x, z]| [x, 0.0, z]).collect();
    match inputs.record {
        Some(record) => profile_parts(record, &line),
        None => vec![(false, line)],
    }
}

/// Whether parts of the profile lie beyond the offsets.
pub(in crate::plot) fn is_guessed(inputs: &FigureInputs) -> bool {
    profile_of(inputs).iter().any(|(beyond, _)| *beyond)
}

/// Draws the centreplane profile, dashed beyond the offsets, and gives its points on the sheet.
pub(in crate::plot) fn draw_centreplane(
    canvas: &mut Canvas,
    inputs: &FigureInputs,
    at: impl Fn([f64; 2]) -> [f64; 2],
) -> Vec<[f64; 2]> {
    let mut all = Vec::new();
    for (beyond, part) in profile_of(inputs) {
        let part: Vec<[f64; 2]> = part.into_iter().map(|[x, _, z]| at([x, z])).collect();
        canvas.polyline(&part, &if beyond { guessed(OUTLINE) } else { OUTLINE });
        all.extend(part);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_parted_where_their_offsets_end() {
        let line = [[0.0, 0.0, 1.0], [2.0, 2.0, 1.0], [4.0, 3.0, 1.0], [6.0, 3.0, 1.0]];
        let found = parts(&line, Some([1.0, 5.0]));
        let beyond: Vec<bool> = found.iter().map(|(out, _)| *out).collect();
        assert_eq!(beyond, [true, false, true]);
        assert_eq!(found[1].1, [[1.0, 1.0, 1.0], [2.0, 2.0, 1.0], [4.0, 3.0, 1.0], [5.0, 3.0, 1.0]]);
        assert_eq!((found[0].1.len(), found[2].1[1]), (2, [6.0, 3.0, 1.0]));
        assert_eq!(parts(&line, None), [(false, line.to_vec())]);
    }
}
