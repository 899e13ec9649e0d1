//! Main dimensions and deck of a fitted hull, from the table or, where it is silent, from its offsets.

use super::super::{HullError, OffsetTable, PrincipalParticulars};
use super::FitError;
use super::rows::Row;
use crate::numeric::median;
use crate::spline::KnotVector;
use crate::units::counted;

/// How [`length_by_stations`] comes to it, in words.
pub(super) const BY_STATIONS: &str = "from the station at x = 0 to the outermost at a whole number of station spacings";

/// Part of the length of the hull that the distance of the perpendiculars is at least.
const PERPENDICULARS: f64 = 0.9;

/// L_PP by the stations, x counting from AP: the outermost one that stands a whole number of the usual distance (the
/// median) forward of the station at x = 0; none where there is no such station or the hull of `length` \[m\] is much
/// longer.
pub(super) fn length_by_stations(table: &OffsetTable, length: f64) -> Option<f64> {
    let mut places: Vec<f64> = table.stations.iter().map(|station| station.station.x).collect();
    places.sort_by(f64::total_cmp);
    places.dedup_by(|a, b| *a - *b <= 1e-9 * length);
    let mut steps: Vec<f64> = places.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let step = median(&mut steps)?;
    let whole = |x: f64| (x / step - (x / step).round()).abs() <= 1e-4;
    let from_aft = places.iter().any(|x| x.abs() <= 1e-6 * length);
    let last = places.iter().copied().filter(|&x| whole(x)).fold(0.0, f64::max);
    (from_aft && step > 0.0 && last >= PERPENDICULARS * length).then_some(last)
}

/// How L_PP comes from the ends of the hull, in words.
pub(super) const BY_ENDS: &str = "between the ends of the hull";

/// L_PP, B, T and D: stated, or L_PP by the stations ([`length_by_stations`]), else between the ends of the waterline
/// at T, or of the hull where no T is stated, B twice the greatest half-breadth, D the top. No T is taken from the
/// lines. What was taken from them is noted.
pub(super) fn particulars(table: &OffsetTable, rows: &[Row], notes: &mut Vec<String>) -> PrincipalParticulars {
    let stated = &table.stated;
    let usable = |value: Option<f64>| value.filter(|v| v.is_finite() && *v > 0.0);
    let (bottom, top) = (rows[0].z, rows[rows.len() - 1].z);
    let depth = usable(stated.depth).unwrap_or_else(|| {
        notes.push(format!("no depth is stated: D = {top:.3} m, the highest waterline"));
        if top > 0.0 { top } else { top - bottom }
    });
    let draught = usable(stated.draught);
    let breadth = usable(stated.breadth).unwrap_or_else(|| {
        let half = rows.iter().flat_map(|r| r.sites.iter().map(|s| s.y).chain(r.ends.map(|e| e.y))).fold(0.0, f64::max);
        notes.push(format!("no breadth is stated: B = {:.3} m, twice the greatest half-breadth", 2.0 * half));
        2.0 * half
    });
    let length = usable(stated.length_between_perpendiculars).unwrap_or_else(|| {
        let (length, how) = match draught {
            Some(draught) => {
                // Ends of the waterline at T, between the rows around it.
                let k = rows.partition_point(|r| r.z < draught).clamp(1, rows.len() - 1);
                let (a, b) = (&rows[k - 1], &rows[k]);
                let share = ((draught - a.z) / (b.z - a.z)).clamp(0.0, 1.0);
                let at = |side: usize| a.ends[side].x + share * (b.ends[side].x - a.ends[side].x);
                (at(1) - at(0), "that of the waterline at T")
            }
            None => {
                let aft = rows.iter().map(|r| r.ends[0].x).fold(f64::INFINITY, f64::min);
                let fore = rows.iter().map(|r| r.ends[1].x).fold(f64::NEG_INFINITY, f64::max);
                (fore - aft, BY_ENDS)
            }
        };
        let (length, how) = length_by_stations(table, length).map_or((length, how), |length| (length, BY_STATIONS));
        notes.push(format!("no length is stated: L_PP = {length:.3} m, {how}"));
        length
    });
    notes.extend(shorter_than_broad(length, breadth));
    PrincipalParticulars { length_between_perpendiculars: length, breadth, draught, depth }
}

/// What is wrong with a ship that is shorter than it is broad.
pub(super) fn shorter_than_broad(length: f64, breadth: f64) -> Option<String> {
    (length < breadth).then(|| {
        format!(
            "L_PP = {length:.3} m is less than B = {breadth:.3} m: are the stations numbers, not metres? Then say station_spacing = ..., or \
             spaces = ... and Lpp = ..., in the table or the file beside it"
        )
    })
}

/// Whether the plane of the transom cuts the station at `x` between its highest offset and the next waterline.
fn before_transom(table: &OffsetTable, x: f64, highest: f64) -> bool {
    let next = table.waterlines.iter().copied().filter(|&z| z > highest).min_by(f64::total_cmp);
    table.transom.zip(next).is_some_and(|(plane, z)| highest.is_finite() && plane.x_base + plane.slope * z > x)
}

/// Knots and control points (x, z) of the deck at side: the heights of the stations where the table gives them, or of
/// their highest offsets, joined straight, inside the surface; level at the top where every station reaches it.
#[allow(clippy::type_complexity, reason = "the two parts of one curve, taken apart at once")]
pub(super) fn deck(
    table: &OffsetTable,
    rows: &[Row],
    notes: &mut Vec<String>,
) -> Result<(KnotVector, Vec<[f64; 2]>), FitError> {
    let (bottom, top) = (rows[0].z, rows[rows.len() - 1].z);
    let last = &rows[rows.len() - 1];
    let [aft, fore] = [0, 1].map(|side| {
        let ends = rows.iter().map(|r| r.ends[side].x);
        if side == 0 { ends.fold(last.ends[0].x, f64::min) } else { ends.fold(last.ends[1].x, f64::max) }
    });
    let mut assumed = 0usize;
    let mut heights: Vec<(f64, f64)> = Vec::new();
    for station in &table.stations {
        let highest = station.half_breadths.iter().zip(&table.waterlines).filter(|(c, _)| c.value().is_some());
        let highest = highest.map(|(_, z)| *z).fold(f64::NEG_INFINITY, f64::max);
        let z = match station.deck_height {
            Some(z) if z.is_finite() => z,
            // The station meets the transom there, not the deck.
            _ if before_transom(table, station.station.x, highest) => continue,
            _ if highest.is_finite() => {
                assumed += usize::from(highest < top);
                highest
            }
            _ => continue,
        };
        heights.push((station.station.x, z.clamp(bottom + 1e-6 * (top - bottom), top)));
    }
    heights.sort_by(|a, b| a.0.total_cmp(&b.0));
    heights.dedup_by(|a, b| a.0 - b.0 <= 1e-9 * (fore - aft));
    if assumed > 0 {
        notes.push(format!("the deck at side of {} is taken at the highest offset there", counted(assumed, "station")));
    }
    let level = heights.iter().all(|h| h.1 >= top - 1e-9 * (top - bottom));
    let points: Vec<[f64; 2]> = if level || heights.len() < 2 {
        vec![[aft, top], [fore, top]]
    } else {
        let (first, last) = (heights[0].1, heights[heights.len() - 1].1);
        let slack = 1e-6 * (fore - aft);
        let inside = heights.iter().filter(|h| h.0 > aft + slack && h.0 < fore - slack).map(|h| [h.0, h.1]);
        std::iter::once([aft, first]).chain(inside).chain([[fore, last]]).collect()
    };
    let breaks: Vec<f64> = points.iter().map(|p| p[0]).collect();
    let knots = KnotVector::from_breakpoints(1, &breaks, &vec![1; breaks.len() - 2]).map_err(HullError::from)?;
    Ok((knots, points))
}
