//! Names of the stations of a table over their sections in a body plan.

use super::body_plan::range;
use super::canvas::{Anchor, Canvas, Rectangle, TextStyle};
use super::caption;
use super::label::{LabelPlacer, Preference, length, places_over};
use super::sheet::LETTERS;
use super::view::THREAD;
use crate::fairing::record::FairRecord;

/// How far below the foot of a view along the ship its names of stations stand, as many rows as it takes for all of
/// them \[mm\].
pub(super) const ROWS: [f64; 4] = [3.0, 6.6, 10.2, 13.8];
/// Sections whose upper ends are nearer to each other than this bear one name \[mm\].
const BESIDE: f64 = 2.4;
/// Sections as long as this bear a name between their ends as well \[mm\].
const LONG: f64 = 40.0;
/// The unit of the steps in which a place for a name is looked for \[mm\].
const NEAR: f64 = 2.6;

/// The names of the stations over the upper ends of their sections, with a thread where they stand aside; those aft of
/// `midship` left of `centre`, the others right of it. The sections next to the centre line have the first choice of
/// places.
pub(super) fn name_stations(
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
    for (end, own) in groups {
        let room = if is_aft(own[0]) {
            Rectangle { right: centre - 0.4, ..*window }
        } else {
            Rectangle { left: centre + 0.4, ..*window }
        };
        let places = places_over(end, NEAR, [8, 24]);
        let name = |k: usize| caption::plain(&stations[k].name).chars().take(9).collect::<String>();
        let [first, last] = [own.iter().min(), own.iter().max()].map(|k| k.map_or(String::new(), |k| name(*k)));
        let name = if first == last { first } else { range(&first, &last) };
        placer.name_off_curves(canvas, &name, &style, &places, &room, (end, &THREAD));
    }
}

/// The names of the stations on their sections, at the bilge too, where a name keeps off the neighbours; `curves` are the
/// first that the placer has.
pub(super) fn number_sections(
    canvas: &mut Canvas,
    record: &FairRecord,
    curves: &[(usize, Vec<[f64; 2]>)],
    placer: &mut LabelPlacer,
    window: &Rectangle,
) {
    let style = TextStyle::new(LETTERS, Anchor::Middle);
    let preferred = Preference { part: 0.35, crossings: 0, beside: false };
    for (k, (station, line)) in curves.iter().enumerate() {
        if length(line) >= LONG {
            let name: String = caption::plain(&record.lines.stations[*station].name).chars().take(9).collect();
            placer.name_curve(canvas, k, &name, &style, preferred, window);
        }
    }
}
