//! The body plan: aft sections on the left, forward sections on the right, the midship section on both sides.

use super::extent::midship_of;
use super::inputs::FigureInputs;
use super::lines_grid::{GridPlane, LinesGrid};
use super::station_names::range;
use super::view::{BASE, DESIGN, DIAGONAL_PLANE, GRID, OUTLINE, STATION, THREAD, View};
use crate::plot::paper::canvas::{Anchor, Canvas, Rectangle, TextStyle};
use crate::plot::paper::label::{FLAT, LabelPlacer, Preference, length, places_over};

/// Room beside the sections for the names of waterlines [mm].
pub(in crate::plot) const SIDE_ROOM: f64 = 28.5;
/// Room above the sections for the names of stations [mm].
pub(in crate::plot) const TOP_ROOM: f64 = 16.0;
/// Room below the sections for the names of buttocks [mm].
pub(in crate::plot) const BOTTOM_ROOM: f64 = 12.0;
/// Grid lines go this far beyond the hull [mm].
const BEYOND: f64 = 3.0;
/// A section shorter than this on paper is named at the deck alone [mm].
const SHORT: f64 = 25.0;

/// Which side of the centre line sections of a half of the ship stand on: aft -1 (left), forward +1 (right).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::plot) enum Half {
    Aft,
    Fore,
}

impl Half {
    fn sign(self) -> f64 {
        match self {
            Self::Aft => -1.0,
            Self::Fore => 1.0,
        }
    }

    /// Its place in pairs of ends.
    fn index(self) -> usize {
        usize::from(self == Self::Fore)
    }

    fn has(self, x: f64, midship: f64) -> bool {
        let slack = 1e-9 * midship.abs();
        match self {
            Self::Aft => x <= midship + slack,
            Self::Fore => x >= midship - slack,
        }
    }
}

/// Draws the body plan around `view`, whose origin is centre line and base line.
pub(in crate::plot) fn draw(canvas: &mut Canvas, inputs: &FigureInputs, grid: &LinesGrid, view: &View, text_size: f64) {
    let midship = midship_of(inputs);
    let half_width = grid.half_breadth * view.scale + BEYOND;
    let (top, bottom) = (view.at([0.0, grid.height[1]])[1] - BEYOND, view.at([0.0, grid.height[0]])[1] + BEYOND);
    let [centre, _] = view.origin;
    let frame = Rectangle::new(centre - half_width, top, centre + half_width, bottom);
    canvas.begin_group("body-plan");
    draw_grid(canvas, grid, view, &frame, text_size);

    let mut placer = LabelPlacer::default();
    for text in canvas.texts() {
        placer.take(text.place);
    }
    let (mut owners, mut outlines) = (Vec::new(), Vec::new());
    for half in [Half::Aft, Half::Fore] {
        let sign = half.sign();
        let project = |points: &[[f64; 3]]| points.iter().map(|p| [sign * p[1], p[2]]).collect::<Vec<_>>();
        for plane in grid.stations.iter().filter(|plane| half.has(plane.at, midship)) {
            for (k, curve) in plane.curves.iter().enumerate() {
                let placed = view.draw(canvas, project(curve), &STATION);
                owners.push((&plane.name, if k < plane.on_side { length(&placed) } else { 0.0 }));
                placer.add_curve(&placed);
            }
        }
        let deck: Vec<_> = grid.deck.iter().filter(|p| half.has(p[0], midship)).copied().collect();
        outlines.push(view.draw(canvas, project(&deck), &OUTLINE));
        outlines.extend(draw_flat_end(canvas, grid, view, half));
    }
    outlines.iter().for_each(|outline| placer.add_curve(outline));
    name_diagonals(canvas, &mut placer, grid, view, &frame, text_size);
    for half in [Half::Aft, Half::Fore] {
        name_stations(canvas, &mut placer, grid, view, half, midship, text_size);
    }
    for half in [Half::Aft, Half::Fore] {
        name_flat_end(canvas, &mut placer, grid, view, half, text_size);
    }
    // At the bilge too, where a name keeps off the neighbours.
    let style = TextStyle::new(0.9 * text_size, Anchor::Middle);
    for (k, (name, length)) in owners.iter().enumerate() {
        if *length < SHORT {
            continue;
        }
        placer.name_curve(canvas, k, name, &style, Preference { part: 0.3, crossings: 0, beside: false }, &frame);
    }
    canvas.end_group();
}

/// Whether the hull ends in a plane there that can be seen on paper.
fn has_flat_end(grid: &LinesGrid, view: &View, half: Half) -> bool {
    grid.ends[half.index()].iter().any(|p| p[1] * view.scale > 0.1)
}

/// The name of the transom, or of a flat bow, over its corner at the deck, where no station stands at it.
fn name_flat_end(
    canvas: &mut Canvas,
    placer: &mut LabelPlacer,
    grid: &LinesGrid,
    view: &View,
    half: Half,
    text_size: f64,
) {
    let at_end = |plane: &GridPlane| (plane.at - grid.length[half.index()]).abs() <= 1e-3 * grid.station_spacing;
    let corner = grid.ends[half.index()].iter().max_by(|a, b| a[2].total_cmp(&b[2]).then(a[1].total_cmp(&b[1])));
    let Some(corner) = corner.filter(|_| has_flat_end(grid, view, half) && !grid.stations.iter().any(at_end)) else {
        return;
    };
    let at = view.at([half.sign() * corner[1], corner[2]]);
    let name = if half == Half::Aft { "transom" } else { "flat bow" };
    name_at_deck(canvas, placer, name, at, &half_room(grid, view, half), text_size);
}

/// The transom (aft) or a flat bow (forward): its edge and its upper edge.
fn draw_flat_end(canvas: &mut Canvas, grid: &LinesGrid, view: &View, half: Half) -> Option<Vec<[f64; 2]>> {
    let end = &grid.ends[half.index()];
    let sign = half.sign();
    if !has_flat_end(grid, view, half) {
        return None;
    }
    let mut edge: Vec<_> = end.iter().map(|p| [sign * p[1], p[2]]).collect();
    if let Some(&[_, z]) = edge.last() {
        edge.push([0.0, z]);
    }
    if let Some(&[_, z]) = edge.first() {
        edge.insert(0, [0.0, z]);
    }
    Some(view.draw(canvas, edge, &OUTLINE))
}

/// The lines in which the planes of a diagonal stand edgewise, from the centre line out, as far as the grid goes:
/// outboard to its edge or down to its foot.
fn diagonal_lines(grid: &LinesGrid, view: &View, frame: &Rectangle, plane: &GridPlane) -> [[[f64; 2]; 2]; 2] {
    let (sine, cosine) = grid.diagonal_angle.sin_cos();
    let reach = (0.5 * frame.width() / view.scale / cosine).min((plane.at - grid.height[0]) / sine);
    [-1.0, 1.0].map(|sign| [[0.0, plane.at], [sign * reach * cosine, plane.at - reach * sine]].map(|p| view.at(p)))
}

/// Names the planes of the diagonals on their lines, clear of sections where they can be.
fn name_diagonals(
    canvas: &mut Canvas,
    placer: &mut LabelPlacer,
    grid: &LinesGrid,
    view: &View,
    frame: &Rectangle,
    text_size: f64,
) {
    let style = TextStyle::new(0.9 * text_size, Anchor::Middle).coloured(DIAGONAL_PLANE.colour);
    let first = placer.curve_count();
    let named = |plane| diagonal_lines(grid, view, frame, plane).map(|line| (line, plane));
    let lines: Vec<([[f64; 2]; 2], &GridPlane)> = grid.diagonals.iter().flat_map(named).collect();
    for (line, _) in &lines {
        placer.add_curve(line);
    }
    for (k, (_, plane)) in lines.iter().enumerate() {
        let preference = Preference { part: 0.97, crossings: 2, beside: false };
        placer.name_curve(canvas, first + k, &plane.name, &style, preference, frame);
    }
}

fn draw_grid(canvas: &mut Canvas, grid: &LinesGrid, view: &View, frame: &Rectangle, text_size: f64) {
    let [centre, base] = view.origin;
    let mut names = LabelPlacer::default();
    let room = frame.grown(SIDE_ROOM + BEYOND);
    let style = TextStyle::new(text_size, Anchor::End);
    for plane in grid.design_waterline.iter().chain(&grid.waterlines) {
        let y = view.at([0.0, plane.at])[1];
        let pen = if grid.is_design(plane) { &DESIGN } else { &GRID };
        canvas.line([frame.left, y], [frame.right, y], pen);
        let label = grid.waterline_label(plane);
        names.name_point(canvas, &label, &style, &[[frame.left - 1.0, y]], &room);
        let right = TextStyle { anchor: Anchor::Start, ..style };
        names.name_point(canvas, &label, &right, &[[frame.right + 1.0, y]], &room);
    }
    // Name and distance side by side, in two rows, or the name alone, the same for all.
    let caption = TextStyle { anchor: Anchor::Middle, ..style };
    let widest = |text: &dyn Fn(&GridPlane) -> String| {
        grid.buttocks
            .iter()
            .map(|plane| Canvas::text_place([0.0, 0.0], &text(plane), &caption).width())
            .fold(0.0, f64::max)
    };
    let room_of_one = grid.buttock_spacing * view.scale - 1.2 * text_size;
    let distance = |plane: &GridPlane| grid.buttock_label(plane).replacen(&plane.name, "", 1).trim().to_owned();
    let (one_row, two_rows) =
        (widest(&|plane| grid.buttock_label(plane)) < room_of_one, widest(&distance) < room_of_one);
    // Names alone that are wider than their distance: every second, or every third.
    let names_alone = widest(&|plane| plane.name.clone()) + 0.5 * text_size;
    let every = if one_row || two_rows {
        1
    } else {
        (names_alone / (grid.buttock_spacing * view.scale)).ceil().max(1.0) as usize
    };
    for (k, plane) in grid.buttocks.iter().enumerate() {
        for sign in [-1.0, 1.0] {
            let x = view.at([sign * plane.at, 0.0])[0];
            canvas.line([x, frame.top], [x, frame.bottom], &GRID);
            let rows = if one_row {
                vec![grid.buttock_label(plane)]
            } else if two_rows {
                vec![plane.name.clone(), distance(plane)]
            } else if (k + 1) % every == 0 {
                vec![plane.name.clone()]
            } else {
                Vec::new()
            };
            for (row, text) in rows.iter().enumerate() {
                let at = [x, frame.bottom + text_size * (0.95 + 1.2 * row as f64)];
                names.name_point(canvas, text, &caption, &[at], &room);
            }
        }
    }
    canvas.line([centre, frame.top], [centre, frame.bottom], &BASE);
    canvas.line([frame.left, base], [frame.right, base], &BASE);
    names.name_point(
        canvas,
        "CL",
        &TextStyle { anchor: Anchor::Middle, ..style },
        &[[centre, frame.bottom + 0.95 * text_size]],
        &room,
    );
    for plane in &grid.diagonals {
        for line in diagonal_lines(grid, view, frame, plane) {
            canvas.polyline(&line, &DIAGONAL_PLANE);
        }
    }
}

/// Names of the sections of one half over their ends at the deck; those that end too close to each other bear one name.
#[allow(clippy::too_many_arguments, reason = "all of them are the drawing in hand")]
fn name_stations(
    canvas: &mut Canvas,
    placer: &mut LabelPlacer,
    grid: &LinesGrid,
    view: &View,
    half: Half,
    midship: f64,
    text_size: f64,
) {
    let room = half_room(grid, view, half);
    let mut groups: Vec<([f64; 2], Vec<&GridPlane>)> = Vec::new();
    // From the centre line out: there is least room beside it.
    let mut planes: Vec<&GridPlane> = grid.stations.iter().filter(|plane| half.has(plane.at, midship)).collect();
    if half == Half::Fore {
        planes.reverse();
    }
    for plane in planes {
        let end = plane.curves.iter().flatten().max_by(|a, b| a[2].total_cmp(&b[2]));
        let Some(end) = end else { continue };
        let at = view.at([half.sign() * end[1], end[2]]);
        match groups.last_mut() {
            Some((first, planes)) if (at[0] - first[0]).hypot(at[1] - first[1]) < 1.3 * text_size => planes.push(plane),
            _ => groups.push((at, vec![plane])),
        }
    }
    for (at, planes) in groups {
        let (mut first, mut last) = (planes[0], planes[planes.len() - 1]);
        if last.at < first.at {
            (first, last) = (last, first);
        }
        let name = if planes.len() > 1 { range(&first.name, &last.name) } else { first.name.clone() };
        name_at_deck(canvas, placer, &name, at, &room, text_size);
    }
}

/// Where names of one half stand: on the side of their sections.
fn half_room(grid: &LinesGrid, view: &View, half: Half) -> Rectangle {
    let reach = grid.half_breadth * view.scale + SIDE_ROOM;
    let top = view.at([0.0, grid.height[1]])[1] - TOP_ROOM;
    let [centre, base] = view.origin;
    match half {
        Half::Aft => Rectangle::new(centre - reach, top, centre - 0.4, base),
        Half::Fore => Rectangle::new(centre + 0.4, top, centre + reach, base),
    }
}

/// A name over the end `at` of a section at the deck: up and aside, the nearest first.
fn name_at_deck(
    canvas: &mut Canvas,
    placer: &mut LabelPlacer,
    name: &str,
    at: [f64; 2],
    room: &Rectangle,
    text_size: f64,
) {
    let style = TextStyle::new(text_size, Anchor::Middle).halo();
    let places = places_over(at, text_size, [4, 15], 1.0);
    if !placer.name_off_curves(canvas, name, &style, &places, room, (at, &THREAD)) {
        let places = places_over(at, text_size, [4, 15], FLAT);
        placer.name_off_curves(canvas, name, &style, &places, room, (at, &THREAD));
    }
}
