//! Title block, check bar and table of half-breadths of a lines plan.

use super::caption;
use super::inputs::FigureInputs;
use super::lines_grid::{GridPlane, LinesGrid};
use crate::hull::Hull;
use crate::hydrostatics::{CoefficientLength, Quantity};
use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::font::{LEAST_LETTERS, LETTERS};
use crate::plot::paper::sheet::{Sheet, fitted, wide};

/// Size of the title block [mm].
pub(in crate::plot) const SIZE: [f64; 2] = [138.0, 57.0];
/// Where its second column begins, as a part of its width.
const SPLIT: f64 = 0.59;
/// Height of a row of its text [mm]; the seventh of the first column is for the number of the drawing.
const ROW_OF_TEXT: f64 = 5.2;
const FRAME: Pen = Pen::new(0.35, "#000000");
const RULE: Pen = Pen::new(0.13, "#000000");

/// Scales of the long views and of the body plan, and their sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::plot) struct Scales {
    pub(in crate::plot) long: u32,
    pub(in crate::plot) body: u32,
    pub(in crate::plot) sheet: Sheet,
}

/// Draws the title block with its lower right corner at `corner`.
pub(in crate::plot) fn draw(
    canvas: &mut Canvas,
    inputs: &FigureInputs,
    grid: &LinesGrid,
    scales: Scales,
    corner: [f64; 2],
) {
    let block = Rectangle::new(corner[0] - SIZE[0], corner[1] - SIZE[1], corner[0], corner[1]);
    let (hull, design) = (inputs.hull, inputs.design);
    canvas.rectangle(&block, &FRAME);
    let left = block.left + 3.0;
    let name = caption::plain(hull.name());
    // A long name is set smaller, so that it stays inside.
    let (name, size) = fitted(&name, 4.6, SIZE[0] - 40.0);
    canvas.text([left, block.top + 5.0], &name, &TextStyle::new(size, Anchor::Start));
    canvas.text([block.right - 3.0, block.top + 5.0], "LINES PLAN", &TextStyle::new(3.6, Anchor::End));
    canvas.line([block.left, block.top + 9.5], [block.right, block.top + 9.5], &RULE);

    let body = if scales.body == scales.long { String::new() } else { format!("   body plan 1 : {}", scales.body) };
    let printed = |key: &str| {
        let quantity = Quantity::of(key);
        let value = quantity.and_then(|q| Some((q, (q.value)(design?)?)));
        value.map_or("-".to_owned(), |(q, value)| format!("{value:.0$}", q.decimals_of(value)))
    };
    let coefficient =
        |symbol: &str, value: Option<f64>| value.map_or(String::new(), |value| format!("{symbol} {value:.4}"));
    let assumed = inputs.curves.conventions.assumed;
    let star = |assumed: bool| if assumed { "*" } else { "" };
    let mut left_column = vec![
        format!("scale 1 : {}{body}", scales.long),
        format!("L_OA {:.2} m{}    {}", grid.length[1] - grid.length[0], star(assumed.length), caption::length(inputs)),
        format!("{}    {}{}", caption::breadth(inputs), caption::depth(inputs), caption::assumed_note(inputs, "    ")),
    ];
    match design {
        Some(design) => left_column.extend([
            format!("{}    L_WL {:.2} m", caption::draught(inputs), design.waterline_length),
            format!(
                "{}    {}{}",
                coefficient("C_B", design.block_coefficient),
                coefficient("C_P", design.prismatic_coefficient),
                match inputs.curves.conventions.coefficient_length {
                    CoefficientLength::Waterline => " on L_WL",
                    CoefficientLength::BetweenPerpendiculars => "",
                }
            ),
            format!(
                "∇ {0} m³{2}    Δ {1} t{2}    ρ {3:.3} t/m³",
                printed("DISPVOL"),
                printed("DISPM"),
                star(assumed.length),
                inputs.curves.conventions.density
            ),
        ]),
        None => left_column.push(caption::draught(inputs)),
    }
    let right_column = [
        format!("sheet {}, moulded, metres", scales.sheet.as_str()),
        if grid.numbered {
            format!("stations {:.3} m, 0 at {}", grid.station_spacing, inputs.curves.conventions.stations.zero())
        } else {
            "stations of the table".to_owned()
        },
        if grid.of_table[1] {
            format!("WL of the table, buttocks {:.2} m", grid.buttock_spacing)
        } else {
            format!("waterlines {:.2}, buttocks {:.2} m", grid.waterline_spacing, grid.buttock_spacing)
        },
        diagonals(grid),
        format!("diag. fall {:.1}° outboard", grid.diagonal_angle.to_degrees()),
        inputs.source.unwrap_or_default().to_owned(),
        caption::program(),
    ];
    let columns = [
        (&left_column[..], left, SPLIT * SIZE[0] - 4.0),
        (&right_column[..], block.left + SPLIT * SIZE[0], (1.0 - SPLIT) * SIZE[0] - 2.0),
    ];
    for (column, x, room) in columns {
        for (row, text) in column.iter().enumerate() {
            // Long names of files are set smaller rather than over the edge.
            let (text, size) = fitted(text, LETTERS, room);
            let style = TextStyle::new(size, Anchor::Start);
            canvas.text([x, block.top + 13.7 + ROW_OF_TEXT * row as f64], &text, &style);
        }
    }
    draw_check_bar(canvas, [block.left + 0.5 * (SIZE[0] - 100.0), block.bottom - 6.4]);
}

/// The heights of the diagonals on the centre line.
fn diagonals(grid: &LinesGrid) -> String {
    let digits = if grid.diagonals.iter().any(|plane| plane.at >= 10.0) { 1 } else { 2 };
    let heights: Vec<String> = grid.diagonals.iter().map(|plane| format!("{:.digits$}", plane.at)).collect();
    format!("diag. on CL {} m", heights.join(", "))
}

/// Writes which drawing it is into the row of the title block with its lower right corner at `corner` that is left free
/// for it.
pub(in crate::plot) fn draw_number(canvas: &mut Canvas, text: &str, corner: [f64; 2]) {
    let at = [corner[0] - SIZE[0] + 3.0, corner[1] - SIZE[1] + 13.7 + 6.0 * ROW_OF_TEXT];
    canvas.text(at, text, &TextStyle::new(LETTERS, Anchor::Start));
}

/// A bar of 100 mm, to check the scale of a print.
pub(in crate::plot) fn draw_check_bar(canvas: &mut Canvas, at: [f64; 2]) {
    canvas.line(at, [at[0] + 100.0, at[1]], &FRAME);
    for k in 0..=10 {
        let x = at[0] + 10.0 * f64::from(k);
        let length = if k % 5 == 0 { 2.0 } else { 1.2 };
        canvas.line([x, at[1]], [x, at[1] - length], &FRAME);
    }
    let style = TextStyle::new(LETTERS, Anchor::Middle);
    canvas.text([at[0] + 50.0, at[1] + 3.2], "100 mm on paper", &style);
}

/// Height of a row of the table [mm].
const ROW: f64 = 4.4;
/// Room between the columns of the table [mm].
const APART: f64 = 1.8;
/// Waterlines past which a table may leave out every second of them, and three of four.
const MANY: [usize; 2] = [8, 16];
/// Width of its first column [mm].
const FIRST_COLUMN: f64 = 29.0;

/// Width with every second station, or every fourth where their names are wide, and height with every second or fourth waterline where there are many [mm].
pub(in crate::plot) fn smallest_table(grid: &LinesGrid) -> [f64; 2] {
    let rows = match grid.waterlines.len() {
        count if count > MANY[1] => thinned(grid, 4).len(),
        count if count > MANY[0] => thinned(grid, 2).len(),
        _ => waterlines(grid).len(),
    };
    [table_width(grid, &smallest_list(grid), LEAST_LETTERS), table_height(rows)]
}

/// Width of a column of numbers [mm].
fn numbers(grid: &LinesGrid) -> f64 {
    wide(&format!("{:.3}", grid.half_breadth), LETTERS)
}

/// Width of a column of the table with some stations, their names in letters of `size` [mm].
fn column(grid: &LinesGrid, stations: &[&GridPlane], size: f64) -> f64 {
    let names = stations.iter().map(|station| wide(&station.name, size));
    names.fold(numbers(grid), f64::max) + APART
}

/// Width of the table with some stations [mm], their names in letters of `size`.
fn table_width(grid: &LinesGrid, stations: &[&GridPlane], size: f64) -> f64 {
    FIRST_COLUMN + column(grid, stations, size) * stations.len() as f64
}

/// Height of the table with so many waterlines [mm].
fn table_height(rows: usize) -> f64 {
    ROW * (rows + 2) as f64 + 4.0
}

fn whole_stations(grid: &LinesGrid) -> Vec<&GridPlane> {
    grid.stations.iter().filter(|plane| plane.whole).collect()
}

/// Every second or fourth of the whole stations.
fn one_of(grid: &LinesGrid, step: i32) -> Vec<&GridPlane> {
    whole_stations(grid).into_iter().filter(|plane| plane.count % step == 0).collect()
}

/// The fewest stations of a table: every second, and every fourth where their names are wider than numbers.
fn smallest_list(grid: &LinesGrid) -> Vec<&GridPlane> {
    let second = one_of(grid, 2);
    if column(grid, &second, LEAST_LETTERS) > numbers(grid) + APART { one_of(grid, 4) } else { second }
}

/// Draws half-breadths of as many stations as there is room for: all, whole stations, or every second or fourth of them; of all
/// waterlines, or of every second or fourth of them and the design waterline.
pub(in crate::plot) fn draw_offsets(canvas: &mut Canvas, inputs: &FigureInputs, grid: &LinesGrid, room: &Rectangle) {
    let hull = inputs.hull;
    let fits = |planes: &Vec<&GridPlane>| table_height(planes.len()) <= room.height() + 1e-9;
    let tables = [waterlines(grid), thinned(grid, 2), thinned(grid, 4)];
    let Some(mut planes) = tables.into_iter().find(fits) else { return };
    let all: Vec<&GridPlane> = grid.stations.iter().collect();
    let stations = [all, whole_stations(grid), one_of(grid, 2), smallest_list(grid)]
        .into_iter()
        .flat_map(|list| [LETTERS, LEAST_LETTERS].map(|size| (list.clone(), size)))
        .find(|(list, size)| table_width(grid, list, *size) <= room.width() + 1e-9);
    let Some((stations, size)) = stations else { return };
    let each = column(grid, &stations, size);
    let end_of = |column: usize| room.left + FIRST_COLUMN + each * (column + 1) as f64;
    // Waterlines of which no station of the table has an offset.
    planes.retain(|plane| stations.iter().any(|station| half_breadth(hull, station, plane).is_some()));
    let height = table_height(planes.len());
    let (left, top) = (room.left, room.bottom - height + 4.0);
    let right = left + table_width(grid, &stations, size);
    let style = TextStyle::new(LETTERS, Anchor::End);
    let head = TextStyle { anchor: Anchor::Start, ..style };
    canvas.text([left, top - 2.8], "HALF-BREADTHS [m] of the surface", &TextStyle { size: 3.5, ..head });
    let row_at = |row: usize| top + ROW * (row as f64 + 0.5);
    canvas.text([left + 1.0, row_at(0)], "station", &head);
    for (column, station) in stations.iter().enumerate() {
        let x = end_of(column) - 0.5 * APART;
        canvas.text([x, row_at(0)], &station.name, &TextStyle { size, ..style });
        for (row, plane) in planes.iter().enumerate() {
            if let Some(y) = half_breadth(hull, station, plane) {
                canvas.text([x, row_at(row + 1)], &format!("{:.3}", y.max(0.0)), &style);
            }
        }
        let deck = hull.half_breadth(station.at, hull.deck_height(station.at));
        if let Some(y) = deck {
            canvas.text([x, row_at(planes.len() + 1)], &format!("{:.3}", y.max(0.0)), &style);
        }
    }
    for (row, plane) in planes.iter().enumerate() {
        canvas.text([left + 1.0, row_at(row + 1)], &grid.waterline_label(plane), &head);
    }
    canvas.text([left + 1.0, row_at(planes.len() + 1)], "deck at side", &head);
    let bottom = top + ROW * (planes.len() + 2) as f64;
    canvas.rectangle(&Rectangle::new(left, top, right, bottom), &FRAME);
    canvas.line([left, top + ROW], [right, top + ROW], &RULE);
    canvas.line([left, bottom - ROW], [right, bottom - ROW], &RULE);
    canvas.line([left + FIRST_COLUMN, top], [left + FIRST_COLUMN, bottom], &RULE);
}

/// The half-breadth at a station and a waterline; none over the deck.
fn half_breadth(hull: &Hull, station: &GridPlane, waterline: &GridPlane) -> Option<f64> {
    let inside = waterline.at <= hull.deck_height(station.at) + 1e-9;
    hull.half_breadth(station.at, waterline.at).filter(|_| inside)
}

/// The waterlines with the design waterline among them, from the base line up.
fn waterlines(grid: &LinesGrid) -> Vec<&GridPlane> {
    sorted(grid.waterlines.iter(), grid)
}

/// Waterlines and the design waterline, from the base line up.
fn sorted<'a>(planes: impl Iterator<Item = &'a GridPlane>, grid: &'a LinesGrid) -> Vec<&'a GridPlane> {
    let mut planes: Vec<_> = planes.chain(&grid.design_waterline).collect();
    planes.sort_by(|a, b| a.at.total_cmp(&b.at));
    planes
}

/// One of `step` of the whole waterlines, with the design waterline among them.
fn thinned(grid: &LinesGrid, step: i32) -> Vec<&GridPlane> {
    sorted(grid.waterlines.iter().filter(|plane| plane.whole && plane.count % step == 0), grid)
}
