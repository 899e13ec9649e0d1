//! Names of the stations of a table over their sections in a body plan.

use super::caption;
use super::view::THREAD;
use crate::fairing::record::FairRecord;
use crate::plot::paper::canvas::{Anchor, Canvas, Rectangle, TextStyle};
use crate::plot::paper::font::LETTERS;
use crate::plot::paper::label::{FLAT, LabelPlacer, Preference, length, places_over};

/// How far below the foot of a view along the ship its names of stations stand, as many rows as it takes for all of
/// them \[mm\].
pub(in crate::plot) const ROWS: [f64; 4] = [3.0, 6.6, 10.2, 13.8];
/// Sections whose upper ends are nearer to each other than this bear one name \[mm\].
const BESIDE: f64 = 2.4;
/// Sections as long as this bear a name between their ends as well \[mm\].
const LONG: f64 = 40.0;
/// Pieces of sections as long as this are named \[mm\].
const PIECE: f64 = 4.0;
/// Lines that are nowhere farther from each other look like one \[mm\].
const HAIR: f64 = 0.4;
/// The unit of the steps in which a place for a name is looked for \[mm\].
const NEAR: f64 = 2.6;

/// The names of the stations over the upper ends of their sections, with a thread where they stand aside; those aft of
/// `midship` left of `centre`, the others right of it. The sections next to the centre line have the first choice of
/// places.
pub(in crate::plot) fn name_stations(
    canvas: &mut Canvas,
    record: &FairRecord,
    curves: &[(usize, Vec<[f64; 2]>)],
    placer: &mut LabelPlacer,
    window: &Rectangle,
    [centre, midship]: [f64; 2],
) {
    let style = TextStyle::new(LETTERS, Anchor::Middle).halo();
    let stations = &record.lines.stations;
    let is_aft = |k: usize| stations[k].x < midship;
    let (aft, fore): (Vec<usize>, Vec<usize>) = (0..stations.len()).partition(|k| is_aft(*k));
    // Sections that end side by side bear one name.
    let mut groups: Vec<([f64; 2], Vec<usize>)> = Vec::new();
    for k in aft.into_iter().chain(fore.into_iter().rev()) {
        let ends = curves.iter().filter(|(cut, _)| *cut == k).flat_map(|(_, line)| line);
        let Some(&end) = ends.min_by(|a, b| a[1].total_cmp(&b[1])) else { continue };
        match groups.last_mut() {
            Some((at, own)) if is_aft(own[0]) == is_aft(k) && (end[0] - at[0]).hypot(end[1] - at[1]) < BESIDE => {
                own.push(k);
            }
            _ => groups.push((end, vec![k])),
        }
    }
    groups.iter().for_each(|(end, _)| placer.add_end(*end));
    for (end, own) in groups {
        let room = if is_aft(own[0]) {
            Rectangle { right: centre - 0.4, ..*window }
        } else {
            Rectangle { left: centre + 0.4, ..*window }
        };
        let name = name_of(record, &own);
        for slope in [1.0, FLAT] {
            let places = places_over(end, NEAR, [12, 24], slope);
            if placer.name_off_curves(canvas, &name, &style, &places, &room, (end, &THREAD)) {
                break;
            }
        }
    }
}

/// The name of a station, or of the first and the last of several.
fn name_of(record: &FairRecord, stations: &[usize]) -> String {
    let name = |k: usize| caption::plain(&record.lines.stations[k].name).chars().take(9).collect::<String>();
    match (stations.iter().min(), stations.iter().max()) {
        (Some(first), Some(last)) if first != last => range(&name(*first), &name(*last)),
        (Some(one), _) => name(*one),
        _ => String::new(),
    }
}

/// The names of the stations on their sections, at the bilge too, where a name keeps off the neighbours; sections that lie
/// on each other bear one. Pieces that are not joined to the upper end of their station, where its name stands, bear it
/// however short they are, with a thread where there is no room on them. `curves` are the first that the placer has, and
/// `halves` the places of the aft and the fore body, which keep their names.
pub(in crate::plot) fn number_sections(
    canvas: &mut Canvas,
    record: &FairRecord,
    curves: &[(usize, Vec<[f64; 2]>)],
    placer: &mut LabelPlacer,
    halves: &[Rectangle; 2],
) {
    let style = TextStyle::new(LETTERS, Anchor::Middle);
    let preferred = Preference { part: 0.35, crossings: 0, beside: false };
    let top = |line: &[[f64; 2]]| line.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    let apart = |k: usize| {
        let (station, line) = &curves[k];
        let others = || (0..curves.len()).filter(|m| *m != k && curves[*m].0 == *station).map(|m| &curves[m].1);
        let lower = others().any(|other| top(other) < top(line) - BESIDE);
        lower && !others().any(|other| are_joined(line, other))
    };
    let centre = 0.5 * (halves[0].right + halves[1].left);
    let mut named = vec![false; curves.len()];
    // What has the least room is named first.
    let mut order: Vec<usize> = (0..curves.len()).collect();
    order.sort_by_key(|k| !apart(*k));
    for k in order {
        let (station, line) = &curves[k];
        let (long, apart) = (length(line), apart(k));
        // The bottom is drawn as a piece of its own: it lies on the base line.
        let flat = line.iter().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max) - top(line) < HAIR;
        if named[k] || flat || (long < LONG && !(apart && long >= PIECE)) {
            continue;
        }
        let same = (0..curves.len()).filter(|m| *m != k && !named[*m] && lie_on_each_other(line, &curves[*m].1));
        let own: Vec<usize> = std::iter::once(k).chain(same).collect();
        own.iter().for_each(|m| named[*m] = true);
        let stations: Vec<usize> = own.iter().map(|m| curves[*m].0).collect();
        let name = if own.len() > 1 { name_of(record, &stations) } else { name_of(record, &[*station]) };
        let middle = line.iter().map(|p| p[0]).sum::<f64>() / line.len().max(1) as f64;
        let window = &halves[usize::from(middle > centre)];
        // On the centre line there is room beside a section alone.
        let width = Canvas::text_place([0.0, 0.0], &name, &style).width();
        let beside = line.iter().all(|p| (p[0] - centre).abs() < width);
        let found = placer.name_curves(canvas, &own, &name, &style, Preference { beside, ..preferred }, window);
        if !found && apart {
            placer.name_by_leader(canvas, k, &name, &style, &THREAD, window);
        }
    }
}

/// Whether lines meet at an end.
fn are_joined(a: &[[f64; 2]], b: &[[f64; 2]]) -> bool {
    let ends = |line: &[[f64; 2]]| [line.first().copied(), line.last().copied()].into_iter().flatten();
    ends(a).any(|p| b.windows(2).any(|w| from_chord(p, [w[0], w[1]]) < HAIR))
        || ends(b).any(|p| a.windows(2).any(|w| from_chord(p, [w[0], w[1]]) < HAIR))
}

/// Whether lines are drawn as one: no point of the first is farther than a hair from a point of the second, and the other
/// way round.
fn lie_on_each_other(a: &[[f64; 2]], b: &[[f64; 2]]) -> bool {
    let near = |p: &[f64; 2], line: &[[f64; 2]]| line.windows(2).any(|w| from_chord(*p, [w[0], w[1]]) < HAIR);
    let ends = |line: &[[f64; 2]]| line.first().copied().zip(line.last().copied());
    let apart = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]) > BESIDE;
    let (Some((a0, a1)), Some((b0, b1))) = (ends(a), ends(b)) else { return false };
    if (apart(a0, b0) || apart(a1, b1)) && (apart(a0, b1) || apart(a1, b0)) {
        return false;
    }
    a.iter().step_by(4).all(|p| near(p, b)) && b.iter().step_by(4).all(|p| near(p, a))
}

/// Distance of a point from a chord \[mm\].
fn from_chord(p: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let along = [b[0] - a[0], b[1] - a[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    let part = ((p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1]) / square.max(1e-18);
    let part = part.clamp(0.0, 1.0);
    (p[0] - a[0] - part * along[0]).hypot(p[1] - a[1] - part * along[1])
}

/// `3 – 5`; after a negative number `-½ to ½`.
pub(in crate::plot) fn range(first: &str, last: &str) -> String {
    let between = if first.starts_with('-') { "to" } else { "–" };
    format!("{first} {between} {last}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_over_the_deck_have_steep_threads_and_leave_other_ends_free() {
        let ends: Vec<[f64; 2]> = (0..9).map(|k| [60.0 + 4.0 * f64::from(k), 60.0]).collect();
        let (mut canvas, mut placer) = (Canvas::new(150.0, 100.0), LabelPlacer::default());
        ends.iter().for_each(|end| placer.add_end(*end));
        let style = TextStyle::new(LETTERS, Anchor::Middle).halo();
        let window = canvas.sheet();
        for (k, end) in ends.iter().enumerate() {
            let places = places_over(*end, NEAR, [12, 40], 1.0);
            let name = format!("{k}2.345");
            assert!(placer.name_off_curves(&mut canvas, &name, &style, &places, &window, (*end, &THREAD)));
        }
        for (k, (text, end)) in canvas.texts().iter().zip(&ends).enumerate() {
            let middle = 0.5 * (text.place.left + text.place.right);
            assert!((middle - end[0]).abs() <= end[1] - text.place.bottom + 1.5, "{text:?} of {end:?}");
            let hidden = ends.iter().enumerate().any(|(m, [x, y])| {
                let under = text.place.left < *x && *x < text.place.right;
                m != k && under && text.place.bottom > y - 0.4 * LETTERS
            });
            assert!(!hidden, "{text:?} covers the end of another section");
        }
        for (k, text) in canvas.texts().iter().enumerate() {
            assert!(canvas.texts()[..k].iter().all(|other| !other.place.overlaps(&text.place)), "{text:?}");
        }
    }

    #[test]
    fn pieces_are_joined_or_apart_and_may_lie_on_each_other() {
        let line = |shift: f64| (0..30).map(|k| [f64::from(k), shift + 0.1 * f64::from(k * k)]).collect::<Vec<_>>();
        let (one, beside, mut turned) = (line(0.0), line(9.0), line(0.1));
        turned.reverse();
        assert!(lie_on_each_other(&one, &turned) && !lie_on_each_other(&one, &beside));
        assert!(!are_joined(&one, &beside) && are_joined(&one, &[[29.0, 84.1], [40.0, 84.1]]));
        // A part of a line is not the line.
        assert!(!lie_on_each_other(&one, &one[..12]));
    }
}
