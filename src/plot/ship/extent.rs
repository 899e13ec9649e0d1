//! How far a faired ship reaches, and how it is laid on the paper along its length.

use super::inputs::FigureInputs;
use crate::fairing::record::FairRecord;
use crate::plot::paper::scale::drawing_scale;

/// Room aft and forward of views along the ship \[mm\]: names and heights stand aft.
pub(in crate::plot) const LONG_SIDES: [f64; 2] = [19.5, 10.0];

/// Largest half-breadth, lowest and highest height, aft and fore end of the offsets and of both hulls.
pub(in crate::plot) fn extent(record: &FairRecord) -> Option<([f64; 2], f64, [f64; 2])> {
    let points = record.changes.iter().map(|change| [change.x, change.before.max(change.after), change.z]);
    let mut x = [f64::INFINITY, f64::NEG_INFINITY];
    let mut z = x;
    let mut breadth = 0.0_f64;
    for [px, py, pz] in points {
        x = [x[0].min(px), x[1].max(px)];
        z = [z[0].min(pz), z[1].max(pz)];
        breadth = breadth.max(py);
    }
    if let Some(lowest) = record.lines.waterlines.first() {
        z[0] = z[0].min(*lowest);
    }
    for end in record.lines.endings.iter().flatten().flatten() {
        x = [x[0].min(*end), x[1].max(*end)];
    }
    (breadth > 0.0 && x[1] > x[0] && z[1] > z[0]).then_some((x, breadth, z))
}

/// Height of the base line on a drawing from one height to another \[m\]: 0, or the nearer of them where it is outside.
pub(in crate::plot) fn base([low, high]: [f64; 2]) -> f64 {
    0.0_f64.clamp(low, high)
}

/// Amidships of what is drawn \[m\]: L_PP/2 where it comes from no table.
pub(in crate::plot) fn midship_of(inputs: &FigureInputs) -> f64 {
    let half = 0.5 * inputs.hull.particulars().length_between_perpendiculars;
    let ends = inputs.record.and_then(|record| Some((record, extent(record)?.0)));
    ends.map_or(half, |(record, x)| midship(record, x))
}

/// Amidships \[m\]: L_PP/2, or the middle of the offsets where a table has its stations from elsewhere than AP.
pub(in crate::plot) fn midship(record: &FairRecord, x: [f64; 2]) -> f64 {
    let half = 0.5 * record.after.particulars().length_between_perpendiculars;
    let middle = 0.5 * (x[0] + x[1]);
    if (half - middle).abs() <= 0.1 * (x[1] - x[0]) { half } else { middle }
}

/// The largest scale at which a view along the ship from `x[0]` to `x[1]` \[m\] fits into `paper` \[mm\].
pub(in crate::plot) fn long_scale(x: [f64; 2], paper: [f64; 2]) -> u32 {
    drawing_scale(x[1] - x[0], paper[0] - LONG_SIDES.iter().sum::<f64>())
}

/// Where a view along the ship `width` \[mm\] long begins: in the middle of `paper`, where that leaves names their room.
pub(in crate::plot) fn long_left(paper: [f64; 2], width: f64) -> f64 {
    (0.5 * (paper[0] - width)).max(LONG_SIDES[0])
}
