//! What may be wrong with the hull of a table by more than one per cent of its volume.

use crate::fairing::Suspects;
use crate::hull::{Hull, OffsetTable, OutlinePoint, SectionalAreaCurve, StationOffsets, enclosed, keel_height};
use crate::numeric::{gauss_legendre, trapezoids};
use crate::report::words::lengths;
use crate::units::{Notation, counted};
use std::f64::consts::PI;

/// Part of the volume from which a doubt is a warning.
const SHARE: f64 = 0.01;

/// Share of the volume between lines from which a doubt of their spacing is a warning.
const SPACED: f64 = 0.03;

/// Points between two stations at which sections are integrated.
const SPACING_POINTS: usize = 4;

/// Greatest turn between two chords that is of a curve \[rad\].
const CURVED: f64 = 0.25 * PI;

/// The suspects of a table in one line: a warning where they change the volume by more than one per cent.
pub(in crate::report) fn suspects_doubt(table: &OffsetTable, found: &Suspects) -> Option<String> {
    let line = suspects_line(table, found)?;
    let area = |expected: bool| {
        let station = |(k, station): (usize, &StationOffsets)| {
            let offset = |(j, z): (usize, &f64)| {
                let suspect = found.suspects.iter().find(|s| expected && s.station == k && s.waterline == j);
                let value = suspect.map_or_else(|| station.half_breadth(j), |suspect| Some(suspect.verdict.expected));
                [*z, value.unwrap_or(0.0)]
            };
            let offsets: Vec<[f64; 2]> = table.waterlines.iter().enumerate().map(offset).collect();
            [station.station.x, trapezoids(&offsets)]
        };
        trapezoids(&table.stations.iter().enumerate().map(station).collect::<Vec<_>>())
    };
    let (written, expected) = (area(false), area(true));
    let share = written / expected - 1.0;
    Some(if share.is_finite() && share.abs() > SHARE {
        format!("W341 {line}. As written the volume is {:+.1} % of that with the expected offsets", 100.0 * share)
    } else {
        line
    })
}

/// Area of a section as its points are drawn, one side [m^2], and about what a curve through them has more.
///
/// Points joined by chords enclose int y dz; pieces that fall take away. A curve that turns by t over a chord l bulges by
/// l^2 t / 12.
fn drawn(points: &[OutlinePoint]) -> [f64; 2] {
    let chords: Vec<[f64; 2]> = points.windows(2).map(|p| [p[1].y - p[0].y, p[1].z - p[0].z]).collect();
    let turn = |k: usize| {
        let ([a, b], [c, d]) = (chords[k], chords[k + 1]);
        let turn = (a * d - b * c).atan2(a * c + b * d);
        if points[k + 1].marks.knuckle || turn.abs() > CURVED { 0.0 } else { turn }
    };
    let turns: Vec<f64> = (0..chords.len().saturating_sub(1)).map(turn).collect();
    let around = |k: usize| {
        let both = [k.checked_sub(1), Some(k)].map(|at| at.and_then(|at| turns.get(at)).copied());
        let known: Vec<f64> = both.into_iter().flatten().collect();
        known.iter().sum::<f64>() / known.len().max(1) as f64
    };
    let bulge = chords.iter().enumerate().map(|(k, [y, z])| (y * y + z * z) * around(k) / 12.0).sum();
    [enclosed(points), bulge]
}

/// The volume inside the sections of a table as they are drawn against that of the hull between the same heights: a warning
/// where they differ by more than one per cent, and more than curves through the points bulge.
pub(in crate::report) fn drawn_doubt(table: &OffsetTable, hull: &Hull) -> Option<String> {
    let outlined: Vec<&StationOffsets> = table
        .stations
        .iter()
        .filter(|station| station.half_breadths.is_empty() && station.outlines.iter().any(|line| line.len() > 1))
        .collect();
    if outlined.len() < 3 {
        return None;
    }
    let (mut of_points, mut bulges, mut of_hull) = (Vec::new(), Vec::new(), Vec::new());
    for station in outlined {
        let x = station.station.x;
        let (mut area, mut bulge, mut found) = (0.0, 0.0, 0.0);
        for line in station.outlines.iter().filter(|line| line.len() > 1) {
            let [own, more] = drawn(line);
            let ends = [line[0].z, line[line.len() - 1].z];
            let sign = (ends[1] - ends[0]).signum();
            (area, bulge) = (area + sign * own, bulge + more.abs());
            let low_high = line.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], p| [a.min(p.z), b.max(p.z)]);
            let areas = SectionalAreaCurve::areas(hull, &low_high, &[x]).remove(0);
            found += 0.5 * (areas[1] - areas[0]);
        }
        of_points.push([x, area]);
        bulges.push([x, bulge]);
        of_hull.push([x, found]);
    }
    let [drawn, bulge, found] = [of_points, bulges, of_hull].map(|list| trapezoids(&list));
    let off = found / drawn - 1.0;
    if drawn > 0.0 && off.abs() > SHARE && off.abs() <= SHARE + 2.0 * bulge / drawn && table.form.boat_lines.is_empty()
    {
        return Some(format!(
            "W340 curves through the points of the sections enclose {:+.1} % more than straight lines between them, {} m3: chines are \
             marked K, and more points show what is round",
            100.0 * off,
            volume(2.0 * drawn)
        ));
    }
    (drawn > 0.0 && off.abs() > SHARE + 2.0 * bulge / drawn).then(|| {
        format!(
            "W340 the sections as they are drawn enclose {} m3 on both sides, and the hull through them {:+.1} % of that: points were \
             left out, or the curves through them are others. Are they in order from keel to deck, and the chines marked?",
            volume(2.0 * drawn),
            100.0 * off
        )
    })
}

/// How much more volume the hull has than straight lines from station to station, and at its stations than straight lines from
/// offset to offset: a warning each from three per cent on. The surface through lines so far apart may be off by a third of
/// that (Richardson 1911).
pub(in crate::report) fn spacing_doubts(table: &OffsetTable, hull: &Hull) -> Vec<String> {
    let height = hull.reference_height();
    let x: Vec<f64> = table.stations.iter().map(|station| station.station.x).collect();
    if x.len() < 2 {
        return Vec::new();
    }
    let at_stations = SectionalAreaCurve::new(hull, height, &x).areas;
    let along: Vec<[f64; 2]> = x.iter().zip(&at_stations).map(|(&x, &area)| [x, area]).collect();
    let rule = gauss_legendre(SPACING_POINTS);
    let inside: Vec<[f64; 2]> = x.windows(2).flat_map(|gap| rule.on(gap[0], gap[1])).map(|(x, w)| [x, w]).collect();
    let positions: Vec<f64> = inside.iter().map(|[x, _]| *x).collect();
    let areas = SectionalAreaCurve::new(hull, height, &positions).areas;
    let whole: f64 = inside.iter().zip(areas).map(|([_, weight], area)| weight * area).sum();
    let straight = trapezoids(&along);
    let mut doubts = Vec::new();
    let mut doubt = |lines: &str, where_to: &str, [found, straight]: [f64; 2]| {
        let more = found / straight - 1.0;
        if straight > 0.0 && more.abs() > SPACED {
            doubts.push(format!(
                "W342 between the {lines} the hull encloses {:.1} % {} than straight lines, {} m3 below {height:.3} m: its shape there \
                 is not known. Give {lines} {where_to}",
                100.0 * more.abs(),
                if more > 0.0 { "more" } else { "less" },
                volume(straight)
            ));
        }
    };
    doubt("stations", "where the hull bends", [whole, straight]);
    let polygon = |x: f64| {
        let keel = keel_height(hull, x)?;
        let heights = table.waterlines.iter().copied().filter(|z| (keel..height).contains(z));
        let heights = [keel].into_iter().chain(heights).chain([height]);
        let points: Vec<[f64; 2]> = heights.filter_map(|z| Some([z, hull.half_breadth(x, z)?])).collect();
        Some([x, 2.0 * trapezoids(&points)])
    };
    if table.stations.iter().all(|station| station.outlines.is_empty()) {
        let polygons: Vec<[f64; 2]> = x.iter().map(|&x| polygon(x).unwrap_or([x, 0.0])).collect();
        doubt("waterlines", "where the sections bend", [straight, trapezoids(&polygons)]);
    }
    doubts
}

/// A volume \[m3\] with four digits at least: `1.278`, `70.99`, `123456`.
fn volume(volume: f64) -> String {
    let digits = volume.max(f64::MIN_POSITIVE).log10().floor().clamp(-9.0, 3.0);
    format!("{volume:.0$}", (3.0 - digits) as usize)
}

/// Suspects of a table in one line, the most severe with its place; none without suspects.
pub(in crate::report) fn suspects_line(table: &OffsetTable, found: &Suspects) -> Option<String> {
    let worst = found.suspects.first()?;
    table.stations.get(worst.station)?;
    let waterline = table.waterlines.get(worst.waterline)?;
    let form = &table.form;
    let at = match lengths::of_heights(form) {
        Notation::Metres => format!("{waterline:.3} m"),
        notation => lengths::place(notation, &form.waterline_heads, *waterline),
    };
    Some(format!(
        "{}: run `check`; the worst is station {}, waterline {at}: written {}, {}, expected {}",
        counted(found.suspects.len(), "suspect cell"),
        lengths::station(table, worst.station),
        worst.written,
        lengths::length(form.notation, worst.value, 4),
        lengths::length(form.notation, worst.verdict.expected, 4)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hull::Marks;

    #[test]
    fn the_bulge_of_an_arc() {
        let point = |k: usize| {
            let angle = 0.5 * PI * f64::from(u32::try_from(k).unwrap()) / 12.0;
            OutlinePoint { y: angle.sin(), z: 1.0 - angle.cos(), marks: Marks::default() }
        };
        let points: Vec<OutlinePoint> = (0..=12).map(point).collect();
        let [area, bulge] = drawn(&points);
        assert!((area + bulge - 0.25 * PI).abs() < 2e-3 * area && bulge > 2e-3, "{area} {bulge}");
    }
}
