//! The two long views of a lines plan: profile (sheer plan) and half-breadth plan.

use super::extrapolated::draw_centreplane;
use super::inputs::FigureInputs;
use super::lines_grid::{GridPlane, LinesGrid};
use super::view::{BASE, BUTTOCK, DESIGN, DESIGN_WATERLINE, DIAGONAL, GRID, OUTLINE, THREAD, View, WATERLINE};
use crate::hull::Hull;
use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::label::{LabelPlacer, Preference, length};

/// Room beside the hull for the names of waterlines and buttocks with their distances [mm].
const SIDE_ROOM: f64 = 28.0;
/// Room beside the hull for their names alone [mm].
const NARROW_SIDE_ROOM: f64 = 15.5;
/// Room beside the hull where nothing is named [mm].
const BARE_SIDE_ROOM: f64 = 4.0;
/// Room above the hull for the names of stations [mm].
pub(in crate::plot) const TOP_ROOM: f64 = 7.0;
/// Room below the hull for the names of stations and perpendiculars [mm].
pub(in crate::plot) const END_ROOM: f64 = 11.0;
/// Most waterlines of a table that all bear names.
const MANY: usize = 16;
/// Grid lines go this far beyond the hull [mm].
const BEYOND: f64 = 3.0;

/// What stands beside the long views.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::plot) enum Naming {
    /// Names of waterlines and buttocks with their distances at both ends.
    Full,
    /// The same at the aft end alone.
    FullAft,
    /// Their names alone at both ends.
    Names,
    /// Their names alone at the aft end.
    NamesAft,
}

impl Naming {
    /// From the most to the least text.
    pub(in crate::plot) const ALL: [Self; 4] = [Self::Full, Self::FullAft, Self::Names, Self::NamesAft];

    /// Room aft and forward of the hull [mm].
    pub(in crate::plot) fn rooms(self) -> [f64; 2] {
        match self {
            Self::Full => [SIDE_ROOM, SIDE_ROOM],
            Self::FullAft => [SIDE_ROOM, BARE_SIDE_ROOM],
            Self::Names => [NARROW_SIDE_ROOM, NARROW_SIDE_ROOM],
            Self::NamesAft => [NARROW_SIDE_ROOM, BARE_SIDE_ROOM],
        }
    }

    /// Whether names bear distances.
    fn has_distances(self) -> bool {
        matches!(self, Self::Full | Self::FullAft)
    }

    /// Whether there are names forward of the hull.
    fn is_at_both_ends(self) -> bool {
        matches!(self, Self::Full | Self::Names)
    }
}

/// How the long views are lettered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::plot) struct LongStyle {
    /// Size of the text [mm].
    pub(in crate::plot) text_size: f64,
    /// What stands beside them.
    pub(in crate::plot) naming: Naming,
}

/// Largest distance from the centreplane along a diagonal [m].
pub(in crate::plot) fn diagonal_reach(grid: &LinesGrid) -> f64 {
    grid.diagonals
        .iter()
        .flat_map(|plane| plane.curves.iter().flatten().map(|point| LinesGrid::expanded(point, plane.at)[1]))
        .fold(0.0, f64::max)
}

/// Frame of the grid for a view that reaches from `low` to `high` [m].
fn frame(grid: &LinesGrid, view: &View, low: f64, high: f64) -> Rectangle {
    let [left, bottom] = view.at([grid.length[0], low]);
    let [right, top] = view.at([grid.length[1], high]);
    Rectangle::new(left, top, right, bottom).grown(BEYOND)
}

/// Stations as upright lines, named above and below where there is room, whole stations first.
fn draw_stations(canvas: &mut Canvas, hull: &Hull, grid: &LinesGrid, view: &View, frame: &Rectangle, text_size: f64) {
    let style = TextStyle::new(text_size, Anchor::Middle);
    let room = frame.grown(END_ROOM + SIDE_ROOM);
    let length = hull.particulars().length_between_perpendiculars;
    let places = [frame.top - 0.8 * text_size, frame.bottom + 0.8 * text_size];
    let mut names = LabelPlacer::default();
    for plane in &grid.stations {
        let x = view.at([plane.at, 0.0])[0];
        let perpendicular = plane.at.abs() < 1e-9 * length || (plane.at - length).abs() < 1e-9 * length;
        canvas.line([x, frame.top], [x, frame.bottom], if perpendicular { &BASE } else { &GRID });
    }
    // Whole stations first, so that halves give way where it is narrow; of them every one, or every second, fifth or
    // tenth.
    let (halves, whole): (Vec<&GridPlane>, Vec<&GridPlane>) = grid.stations.iter().partition(|plane| !plane.whole);
    let widest =
        whole.iter().map(|plane| Canvas::text_place([0.0, 0.0], &plane.name, &style).width()).fold(0.0, f64::max);
    let pitch = grid.station_spacing * view.scale;
    let every = [1, 2, 5, 10].into_iter().find(|&n| f64::from(n) * pitch >= widest + 0.6 * text_size).unwrap_or(20);
    let halves = halves.into_iter().filter(|_| every == 1);
    for plane in whole.into_iter().filter(|plane| plane.count % every == 0).chain(halves) {
        let x = view.at([plane.at, 0.0])[0];
        for y in places {
            names.name_point(canvas, &plane.name, &style, &[[x, y]], &room);
        }
    }
    for (name, x) in [("AP", 0.0), ("FP", length)] {
        let at = [view.at([x, 0.0])[0], places[1] + 1.3 * text_size];
        names.name_point(canvas, name, &style, &[at], &room);
    }
}

/// A line along the ship with its name at both ends, the ends given.
fn draw_level(
    canvas: &mut Canvas,
    names: &mut LabelPlacer,
    frame: &Rectangle,
    y: f64,
    pen: &Pen,
    name: &str,
    style: LongStyle,
) {
    canvas.line([frame.left, y], [frame.right, y], pen);
    name_ends(canvas, names, frame, y, name, (style.text_size, style.naming.is_at_both_ends()));
}

/// A name aft of the frame at one height, and forward of it where it is wanted at both ends.
fn name_ends(
    canvas: &mut Canvas,
    names: &mut LabelPlacer,
    frame: &Rectangle,
    y: f64,
    name: &str,
    (text_size, both): (f64, bool),
) {
    let room = frame.grown(SIDE_ROOM + BEYOND);
    let style = TextStyle::new(text_size, Anchor::End);
    names.name_point(canvas, name, &style, &[[frame.left - 1.0, y]], &room);
    if both {
        let right = TextStyle { anchor: Anchor::Start, ..style };
        names.name_point(canvas, name, &right, &[[frame.right + 1.0, y]], &room);
    }
}

/// The profile, bow to the right; the origin of `view` is AP on the base line.
pub(in crate::plot) fn draw_profile(
    canvas: &mut Canvas,
    inputs: &FigureInputs,
    grid: &LinesGrid,
    view: &View,
    style: LongStyle,
) {
    let hull = inputs.hull;
    let text_size = style.text_size;
    let frame = frame(grid, view, grid.height[0], grid.height[1]);
    canvas.begin_group("profile");
    draw_stations(canvas, hull, grid, view, &frame, text_size);
    let mut names = LabelPlacer::default();
    for plane in grid.design_waterline.iter().chain(&grid.waterlines) {
        let pen = if grid.is_design(plane) {
            &DESIGN
        } else if plane.at.abs() < 1e-9 {
            &BASE
        } else {
            &GRID
        };
        let y = view.at([0.0, plane.at])[1];
        let name = if style.naming.has_distances() { grid.waterline_label(plane) } else { plane.name.clone() };
        draw_level(canvas, &mut names, &frame, y, pen, &name, style);
    }
    let mut placer = LabelPlacer::default();
    let mut owners = Vec::new();
    for plane in &grid.buttocks {
        for (k, curve) in plane.curves.iter().enumerate() {
            placer.add_curve(&view.draw(canvas, curve.iter().map(|p| [p[0], p[2]]), &BUTTOCK));
            owners.push((k < plane.on_side).then_some(plane));
        }
    }
    let outline = draw_centreplane(canvas, inputs, |point| view.at(point));
    let deck = view.draw(canvas, grid.deck.iter().map(|p| [p[0], p[2]]), &OUTLINE);
    let inside = frame.grown(-BEYOND);
    placer.add_curve(&outline);
    placer.add_curve(&deck);
    let style = TextStyle::new(text_size, Anchor::Middle).coloured(BUTTOCK.colour);
    for (k, plane) in owners.iter().enumerate() {
        let Some(plane) = plane else { continue };
        let longest = grid.length[1] - grid.length[0];
        let part = if longest > 0.0 { 0.06 + 0.03 * (k % 4) as f64 } else { 0.1 };
        name_twice(canvas, &mut placer, k, &plane.name, &style, part, &inside);
    }
    canvas.end_group();
}

/// Names a curve near both of its ends, clear of other curves; once, with a leader or where it meets fewest, when there
/// is no clear place.
fn name_twice(
    canvas: &mut Canvas,
    placer: &mut LabelPlacer,
    curve: usize,
    name: &str,
    style: &TextStyle,
    part: f64,
    window: &Rectangle,
) {
    let clear = |part| Preference { part, crossings: 0, beside: false };
    let ends = [part, 1.0 - part].map(|part| placer.name_curve(canvas, curve, name, style, clear(part), window));
    if ends == [false, false] && !placer.name_by_leader(canvas, curve, name, style, &THREAD, window) {
        let preference = Preference { crossings: 2, ..clear(part) };
        placer.name_curve(canvas, curve, name, style, preference, window);
    }
}

/// The half-breadth plan: waterlines above the centre line, diagonals in their true shape below it; the origin of `view` is AP on the centre line.
pub(in crate::plot) fn draw_half_breadths(
    canvas: &mut Canvas,
    hull: &Hull,
    grid: &LinesGrid,
    view: &View,
    style: LongStyle,
) {
    let text_size = style.text_size;
    let frame = frame(grid, view, -diagonal_reach(grid), grid.half_breadth);
    canvas.begin_group("half-breadth-plan");
    draw_stations(canvas, hull, grid, view, &frame, text_size);
    let mut names = LabelPlacer::default();
    draw_level(canvas, &mut names, &frame, view.origin[1], &BASE, "CL", style);
    for plane in &grid.buttocks {
        let y = view.at([0.0, plane.at])[1];
        let name = if style.naming.has_distances() { grid.buttock_label(plane) } else { plane.name.clone() };
        draw_level(canvas, &mut names, &frame, y, &GRID, &name, style);
    }
    let mut placer = LabelPlacer::default();
    let mut owners: Vec<Option<(&GridPlane, &Pen)>> = Vec::new();
    for plane in grid.design_waterline.iter().chain(&grid.waterlines) {
        let pen = if grid.is_design(plane) { &DESIGN_WATERLINE } else { &WATERLINE };
        for (k, curve) in plane.curves.iter().enumerate() {
            placer.add_curve(&view.draw(canvas, curve.iter().map(|p| [p[0], p[1]]), pen));
            owners.push((k < plane.on_side).then_some((plane, pen)));
        }
    }
    for plane in &grid.diagonals {
        let expanded = |point: &[f64; 3]| {
            let [x, s] = LinesGrid::expanded(point, plane.at);
            [x, -s]
        };
        let placed: Vec<_> =
            plane.curves.iter().map(|curve| view.draw(canvas, curve.iter().map(expanded), &DIAGONAL)).collect();
        // Its longest piece bears the name, of those on the side where there are such.
        let pieces = if plane.on_side > 0 { plane.on_side } else { placed.len() };
        let longest = (0..pieces).max_by(|a, b| length(&placed[*a]).total_cmp(&length(&placed[*b])));
        for (k, line) in placed.iter().enumerate() {
            placer.add_curve(line);
            owners.push((Some(k) == longest).then_some((plane, &DIAGONAL)));
        }
    }
    let mut deck: Vec<_> = grid.deck.iter().map(|p| [p[0], p[1]]).collect();
    if let (Some(&[aft, _]), Some(&[fore, _])) = (deck.first(), deck.last()) {
        deck.insert(0, [aft, 0.0]);
        deck.push([fore, 0.0]);
    }
    placer.add_curve(&view.draw(canvas, deck, &OUTLINE));
    placer.add_curve(&[[frame.left, view.origin[1]], [frame.right, view.origin[1]]]);
    let inside = frame.grown(-0.5 * BEYOND);
    // The design waterline comes first in the list and has the first choice of places.
    for (k, owner) in owners.iter().enumerate() {
        let Some((plane, pen)) = owner else { continue };
        let style = TextStyle::new(text_size, Anchor::Middle).coloured(pen.colour);
        let part = 0.08 + 0.035 * (k % 5) as f64;
        if *pen == &DIAGONAL {
            name_twice(canvas, &mut placer, k, &plane.name, &style, part, &inside);
            continue;
        }
        let clear = Preference { part, crossings: 0, beside: false };
        // On the curve, or else with a leader on the side of the waterlines, or anywhere.
        let upper = Rectangle { bottom: view.origin[1], ..inside };
        // Of the many of a table a leader for every second is enough.
        let led = !grid.of_table[1] || grid.waterlines.len() <= MANY || plane.count % 2 == 0;
        let named = placer.name_curve(canvas, k, &plane.name, &style, clear, &inside)
            || !led
            || placer.name_by_leader(canvas, k, &plane.name, &style, &THREAD, &upper)
            || placer.name_by_leader(canvas, k, &plane.name, &style, &THREAD, &inside);
        if !named {
            let preference = Preference { crossings: 4, ..clear };
            placer.name_curve(canvas, k, &plane.name, &style, preference, &inside);
        }
    }
    canvas.end_group();
}
