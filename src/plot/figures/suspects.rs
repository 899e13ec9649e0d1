//! Suspect cells of a table of offsets: a map of the scores by station and waterline, and the section and the waterline
//! through each suspect. Heights at buttocks are drawn the same way, with the buttock in place of the waterline; points
//! of sections each in its section ([`points`]).
//!
//! Marks of the map differ by their shape as well as by their colour: an upright cross is a value above its
//! prediction, a bar one below; their size is the score.

mod points;

use crate::fairing::{Suspect, Suspects, height_grid};
use crate::hull::OffsetTable;
use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::{LEAST_LETTERS, LETTERS};
use crate::plot::paper::scale::{decimals, multiples, nice_step};
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;

use crate::units::counted;
pub use points::suspect_points_figure;

/// Width of the sheet \[mm\].
const WIDTH: f64 = 297.0;
/// Room left and right \[mm\].
const MARGIN: f64 = 14.0;
/// Height over the map \[mm\].
const HEAD: f64 = 26.0;
/// Room left of the map for the names of stations \[mm\].
const NAMES: f64 = 14.0;
/// Largest side of a cell of the map \[mm\].
const LARGEST_CELL: f64 = 6.0;
/// Height of a row of small plots with its words \[mm\].
const ROW: f64 = 62.0;
/// Most suspects with plots.
const MOST_PLOTS: usize = 8;
/// Cells on each side of a suspect that its plots show.
const REACH: usize = 5;
/// Score at which a mark has its full size.
const FULL_SCORE: f64 = 8.0;
const ABOVE: &str = "#b35806";
const BELOW: &str = "#2166ac";
const GREY: &str = "#808080";

/// What the numbers of a grid are.
#[derive(Debug, Clone, Copy)]
pub(in crate::plot) struct Words {
    title: &'static str,
    one: &'static str,
    /// The lines across the stations.
    across: &'static str,
    /// Axes of their positions and of the numbers.
    place: &'static str,
    value: &'static str,
    /// Whether the numbers run along the sheet in a section, as half-breadths do.
    outward: bool,
}

pub(in crate::plot) const OFFSETS: Words = Words {
    title: "SUSPECT OFFSETS",
    one: "offset",
    across: "waterline",
    place: "z [m]",
    value: "half-breadth [m]",
    outward: true,
};

const HEIGHTS: Words = Words {
    title: "SUSPECT HEIGHTS",
    one: "height",
    across: "buttock",
    place: "half-breadth [m]",
    value: "z [m]",
    outward: false,
};

/// Draws the suspects among half-breadths.
///
/// # Errors
/// [`PlotError::Chart`] for a table without cells.
pub fn suspects_figure(table: &OffsetTable, result: &Suspects) -> Result<Svg, PlotError> {
    Ok(Svg::new(compose(table, result, &OFFSETS)?.finish("suspects")))
}

/// Draws the suspects among heights at buttocks.
///
/// # Errors
/// [`PlotError::Chart`] for a table without such heights.
pub fn suspect_heights_figure(table: &OffsetTable, result: &Suspects) -> Result<Svg, PlotError> {
    let grid = height_grid(table).ok_or_else(|| PlotError::Chart("the table has no heights".to_owned()))?;
    Ok(Svg::new(compose(&grid, result, &HEIGHTS)?.finish("suspect heights")))
}

pub(in crate::plot) fn compose(table: &OffsetTable, result: &Suspects, words: &Words) -> Result<Canvas, PlotError> {
    let (rows, columns) = (table.waterlines.len(), table.stations.len());
    if rows == 0 || columns == 0 {
        return Err(PlotError::Chart("the table has no cells".to_owned()));
    }
    let cell = ((WIDTH - 2.0 * MARGIN - NAMES) / columns as f64).min(LARGEST_CELL);
    let map = Rectangle::new(MARGIN + NAMES, HEAD, MARGIN + NAMES + cell * columns as f64, HEAD + cell * rows as f64);
    let shown = result.suspects.len().min(MOST_PLOTS);
    let plots_top = map.bottom + 24.0;
    let height = plots_top + ROW * shown.div_ceil(2) as f64 + 8.0;
    let mut canvas = Canvas::new(WIDTH, height);
    let title = match table.name.as_str() {
        "" => words.title.to_owned(),
        name => format!("{} – {}", words.title, caption::plain(name)),
    };
    canvas.text([0.5 * WIDTH, 8.0], &title, &TextStyle::new(4.5, Anchor::Middle));
    canvas.text([0.5 * WIDTH, 15.0], &headline(result, words), &TextStyle::new(2.8, Anchor::Middle));
    draw_map(&mut canvas, table, result, words, &map, cell);
    draw_key(&mut canvas, map.bottom + 15.5);
    for (k, suspect) in result.suspects.iter().take(shown).enumerate() {
        let left = if k % 2 == 0 { MARGIN } else { 0.5 * WIDTH + 3.0 };
        let top = plots_top + ROW * (k / 2) as f64;
        draw_suspect(&mut canvas, table, suspect, words, [left, top]);
    }
    if result.suspects.len() > shown {
        let more = format!("{} further suspects are in the list", result.suspects.len() - shown);
        canvas.text([MARGIN, height - 4.0], &more, &TextStyle::new(2.6, Anchor::Start));
    }
    canvas.text([WIDTH - 6.0, height - 4.0], &caption::program(), &TextStyle::new(LEAST_LETTERS, Anchor::End));
    Ok(canvas)
}

fn headline(result: &Suspects, words: &Words) -> String {
    let judged = result.verdicts.iter().flatten().flatten().count();
    let count = match result.suspects.len() {
        0 => "no suspects".to_owned(),
        n => counted(n, "suspect"),
    };
    format!(
        "{count} among {} that their neighbours can judge    noise of the table {}",
        counted(judged, words.one),
        length(result.noise)
    )
}

/// A small length with three significant digits.
fn length(value: f64) -> String {
    let millimetres = 1000.0 * value;
    let digits = if millimetres.abs() >= 100.0 {
        0
    } else if millimetres.abs() >= 10.0 {
        1
    } else {
        2
    };
    format!("{millimetres:.digits$} mm")
}

fn draw_map(canvas: &mut Canvas, table: &OffsetTable, result: &Suspects, words: &Words, map: &Rectangle, cell: f64) {
    let centre = |i: usize, j: usize| [map.left + cell * (i as f64 + 0.5), map.bottom - cell * (j as f64 + 0.5)];
    for (i, station) in result.verdicts.iter().enumerate() {
        for (j, verdict) in station.iter().enumerate() {
            let at = centre(i, j);
            let half = 0.5 * cell;
            match verdict {
                Some(verdict) => draw_mark(canvas, at, verdict.score, 0.44 * cell),
                None => {
                    let given = table.stations[i].half_breadths.get(j).and_then(crate::hull::Cell::value).is_some();
                    let place = Rectangle::new(at[0] - half, at[1] - half, at[0] + half, at[1] + half);
                    canvas.fill(&place, if given { "#eeeeee" } else { "#d0d0d0" });
                }
            }
        }
    }
    let thin = Pen::new(0.08, "#b0b0b0");
    for i in 0..=table.stations.len() {
        let x = map.left + cell * i as f64;
        canvas.line([x, map.top], [x, map.bottom], &thin);
    }
    for j in 0..=table.waterlines.len() {
        let z = map.bottom - cell * j as f64;
        canvas.line([map.left, z], [map.right, z], &thin);
    }
    canvas.rectangle(map, &Pen::new(0.25, "#000000"));
    let size = (0.62 * cell).clamp(2.3, 2.4);
    // Names stand at every line where there is room, else at every second, third ...
    let stride = |room: f64, needed: f64| (needed / room).ceil().max(1.0) as usize;
    let style = TextStyle::new(size, Anchor::End);
    for (j, z) in table.waterlines.iter().enumerate().step_by(stride(cell, 1.25 * size)) {
        canvas.text([map.left - 1.2, centre(0, j)[1]], &format!("{}", rounded(*z)), &style);
    }
    let upward = TextStyle::new(size, Anchor::End).upward();
    for (i, station) in table.stations.iter().enumerate().step_by(stride(cell, 1.25 * size)) {
        let name: String = caption::plain(&station.station.name).chars().take(8).collect();
        canvas.text([centre(i, 0)[0], map.bottom + 1.2], &name, &upward);
    }
    let label = TextStyle::new(LEAST_LETTERS, Anchor::Start);
    canvas.text([map.left, map.top - 3.0], &format!("{} [m] over station", words.across), &label);
    draw_rings(canvas, result, map, cell, &centre);
}

fn rounded(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0 + 0.0
}

/// A ring round each suspect, its name at the first of eight places around it that is free.
fn draw_rings(
    canvas: &mut Canvas,
    result: &Suspects,
    map: &Rectangle,
    cell: f64,
    centre: &dyn Fn(usize, usize) -> [f64; 2],
) {
    let radius = 0.72 * cell;
    let mut taken: Vec<Rectangle> = Vec::new();
    for suspect in &result.suspects {
        let [x, y] = centre(suspect.station, suspect.waterline);
        canvas.polyline(&circle([x, y], radius), &Pen::new(0.45, "#000000"));
        taken.push(Rectangle::new(x - radius, y - radius, x + radius, y + radius));
    }
    let style = TextStyle::new((0.75 * cell).clamp(2.4, 3.4), Anchor::Middle).halo();
    let field = map.grown(5.0);
    for suspect in &result.suspects {
        let [x, y] = centre(suspect.station, suspect.waterline);
        let (near, far) = (radius + 0.62 * style.size, radius + 0.9 * style.size);
        let places = [
            [0.0, -near],
            [far, 0.0],
            [-far, 0.0],
            [0.0, near],
            [far, -near],
            [-far, -near],
            [far, near],
            [-far, near],
        ];
        let place = |offset: [f64; 2]| Canvas::text_place([x + offset[0], y + offset[1]], &suspect.id, &style);
        let free = places.into_iter().find(|&offset| {
            let place = place(offset);
            field.contains(&place) && !taken.iter().any(|other| other.overlaps(&place))
        });
        let offset = free.unwrap_or(places[0]);
        taken.push(place(offset));
        canvas.text([x + offset[0], y + offset[1]], &suspect.id, &style);
    }
}

fn circle(at: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    (0..=32)
        .map(|k| {
            let angle = std::f64::consts::TAU * f64::from(k) / 32.0;
            [at[0] + radius * angle.cos(), at[1] + radius * angle.sin()]
        })
        .collect()
}

/// An upright cross for a value above its prediction, a bar for one below; half its length is `largest` at the full
/// score.
fn draw_mark(canvas: &mut Canvas, at: [f64; 2], score: f64, largest: f64) {
    let reach = largest * (score.abs() / FULL_SCORE).min(1.0);
    if reach < 0.04 * largest {
        return;
    }
    let width = 0.25 + 0.5 * (score.abs() / FULL_SCORE).min(1.0);
    let pen = Pen::new(width, if score > 0.0 { ABOVE } else { BELOW });
    canvas.line([at[0] - reach, at[1]], [at[0] + reach, at[1]], &pen);
    if score > 0.0 {
        canvas.line([at[0], at[1] - reach], [at[0], at[1] + reach], &pen);
    }
}

fn draw_key(canvas: &mut Canvas, y: f64) {
    let style = TextStyle::new(2.6, Anchor::Start);
    let mut x = MARGIN + NAMES;
    for score in [8.0, 4.0, 2.0] {
        for sign in [1.0, -1.0] {
            draw_mark(canvas, [x + 2.0, y], sign * score, 2.4);
            let text = format!("{:+.0}", sign * score);
            canvas.text([x + 5.2, y], &text, &style);
            x += 13.0;
        }
    }
    canvas.text([x, y], "value less prediction, in local noise (8 and more: full size)", &style);
    x += 84.0;
    canvas.fill(&Rectangle::new(x, y - 1.4, x + 3.6, y + 1.4), "#d0d0d0");
    canvas.text([x + 5.0, y], "no hull", &style);
    x += 20.0;
    canvas.fill(&Rectangle::new(x, y - 1.4, x + 3.6, y + 1.4), "#eeeeee");
    canvas.text([x + 5.0, y], "not judged", &style);
}

/// The words about a suspect, its section and its waterline.
fn draw_suspect(canvas: &mut Canvas, table: &OffsetTable, suspect: &Suspect, words: &Words, at: [f64; 2]) {
    let [left, top] = at;
    let width = 0.5 * WIDTH - MARGIN - 3.0;
    let station = &table.stations[suspect.station];
    let first = format!(
        "{}   {}, {} {} m: {}, {:+.1} local noise; expected {} ± {:.1} mm",
        suspect.id,
        caption::plain(&station.station.words()),
        words.across,
        rounded(table.waterlines[suspect.waterline]),
        suspect.written,
        suspect.verdict.score,
        rounded(suspect.verdict.expected),
        1000.0 * suspect.verdict.uncertainty
    );
    canvas.text([left, top], &first, &TextStyle::new(2.6, Anchor::Start));
    let second = format!(
        "{}: {}   (probability that it is wrong {:.3})",
        suspect.hypothesis().as_str(),
        suspect.proposed_text,
        suspect.probability
    );
    canvas.text([left, top + 4.4], &second, &TextStyle::new(2.6, Anchor::Start));
    let frame = |k: f64| {
        let step = 0.5 * width;
        Rectangle::new(left + step * k + 11.0, top + 9.0, left + step * (k + 1.0) - 2.0, top + ROW - 14.0)
    };
    let given = |i: usize, j: usize| table.stations[i].half_breadths.get(j).and_then(crate::hull::Cell::value);
    let (i, j) = (suspect.station, suspect.waterline);
    let section: Vec<[f64; 2]> = (j.saturating_sub(REACH)..(j + REACH + 1).min(table.waterlines.len()))
        .filter(|&k| k != j)
        .filter_map(|k| {
            given(i, k).map(|y| if words.outward { [y, table.waterlines[k]] } else { [table.waterlines[k], y] })
        })
        .collect();
    let z = table.waterlines[j];
    let axes = if words.outward { [words.value, words.place] } else { [words.place, words.value] };
    let verdict = &suspect.verdict;
    let reading = Expected { value: suspect.value, expected: verdict.expected, band: 2.0 * verdict.uncertainty };
    small_plot(canvas, &frame(0.0), axes, &section, reading, z, words.outward);
    let waterline: Vec<[f64; 2]> = (i.saturating_sub(REACH)..(i + REACH + 1).min(table.stations.len()))
        .filter(|&k| k != i)
        .filter_map(|k| given(k, j).map(|y| [table.stations[k].station.x, y]))
        .collect();
    small_plot(canvas, &frame(1.0), ["x [m]", words.value], &waterline, reading, station.station.x, false);
}

/// What is known of one reading: its value, what is expected, and how far either side of that.
#[derive(Debug, Clone, Copy)]
pub(in crate::plot) struct Expected {
    pub(in crate::plot) value: f64,
    pub(in crate::plot) expected: f64,
    pub(in crate::plot) band: f64,
}

/// One line through a reading at `place`: the other offsets, the reading hollow, what is expected with its band.
pub(in crate::plot) fn small_plot(
    canvas: &mut Canvas,
    frame: &Rectangle,
    names: [&str; 2],
    others: &[[f64; 2]],
    reading: Expected,
    place: f64,
    section: bool,
) {
    let point = |y: f64| if section { [y, place] } else { [place, y] };
    let Expected { value, expected, band } = reading;
    let [cell, low, high] = [value, expected - band, expected + band].map(point);
    let range = |axis: usize| {
        let all = others.iter().chain([&cell, &low, &high]).map(|p| p[axis]);
        let (a, b) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        let room = 0.08 * (b - a).max(1e-6);
        [a - room, b + room]
    };
    let ranges = [range(0), range(1)];
    let on = |p: [f64; 2]| {
        let share = |axis: usize| (p[axis] - ranges[axis][0]) / (ranges[axis][1] - ranges[axis][0]);
        [frame.left + share(0) * frame.width(), frame.bottom - share(1) * frame.height()]
    };
    draw_axes(canvas, frame, names, ranges);
    let line: Vec<[f64; 2]> = others.iter().map(|&p| on(p)).collect();
    canvas.polyline(&line, &Pen::new(0.2, GREY));
    for at in line {
        canvas.area(&circle(at, 0.75), "#000000");
    }
    let (a, b) = (on(low), on(high));
    canvas.line(a, b, &Pen::new(1.1, "#9ecae1"));
    let at = on(point(expected));
    let tick = if section { [0.0, 1.6] } else { [1.6, 0.0] };
    canvas.line([at[0] - tick[0], at[1] - tick[1]], [at[0] + tick[0], at[1] + tick[1]], &Pen::new(0.5, BELOW));
    canvas.polyline(&circle(on(cell), 1.3), &Pen::new(0.45, ABOVE));
}

fn draw_axes(canvas: &mut Canvas, frame: &Rectangle, names: [&str; 2], ranges: [[f64; 2]; 2]) {
    // Nine pixels where the sheet is 1200 wide.
    let size = (0.0076 * canvas.sheet().width()).clamp(2.4, LETTERS);
    let style = TextStyle::new(size, Anchor::Middle);
    let thin = Pen::new(0.08, "#c8c8c8");
    for (axis, [low, high]) in ranges.into_iter().enumerate() {
        let step = nice_step(high - low, 4.0);
        for value in multiples(step, low, high) {
            let share = (value - low) / (high - low);
            let text = format!("{:.*}", decimals(step), value + 0.0);
            if axis == 0 {
                let x = frame.left + share * frame.width();
                canvas.line([x, frame.top], [x, frame.bottom], &thin);
                canvas.text([x, frame.bottom + 0.4 + 0.8 * size], &text, &style);
            } else {
                let y = frame.bottom - share * frame.height();
                canvas.line([frame.left, y], [frame.right, y], &thin);
                canvas.text([frame.left - 0.8, y], &text, &TextStyle::new(size, Anchor::End));
            }
        }
    }
    canvas.rectangle(frame, &Pen::new(0.18, "#000000"));
    canvas.text([0.5 * (frame.left + frame.right), frame.bottom + 0.4 + 2.0 * size], names[0], &style);
    canvas.text([frame.left, frame.top - 0.7 * size], names[1], &TextStyle::new(size, Anchor::Middle));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fairing::suspects;
    use crate::hull::{Cell, StationOffsets};

    fn table(wrong: &[(usize, usize, f64)]) -> OffsetTable {
        let waterlines: Vec<f64> = (0..11).map(|j| 0.625 * f64::from(j)).collect();
        let stations = (1..21)
            .map(|i| {
                let x = 5.0 * f64::from(i);
                let mut station = StationOffsets::new(format!("{i}"), x);
                let half = |z: f64| 5.0 * (1.0 - (x / 52.5 - 1.0).powi(2)) * (1.0 - (1.0 - z / 8.0).powi(2)).max(0.01);
                station.half_breadths =
                    waterlines.iter().map(|&z| Cell::from(Some((half(z) * 1000.0).round() / 1000.0))).collect();
                station
            })
            .collect();
        let mut table = OffsetTable { waterlines, stations, ..OffsetTable::default() };
        table.form.decimals = Some(3);
        for &(i, j, by) in wrong {
            let value = table.stations[i].half_breadths[j].value().unwrap() + by;
            table.stations[i].half_breadths[j] = Cell::from(Some(value));
        }
        table
    }

    #[test]
    fn nothing_overlaps_and_nothing_leaves_the_sheet() {
        let wrong = [(8, 5, 0.3), (9, 5, -0.4), (3, 8, 0.5), (15, 2, -0.3), (15, 9, 1.0)];
        for wrong in [&wrong[..0], &wrong[..1], &wrong[..]] {
            let table = table(wrong);
            let result = suspects(&table);
            assert_eq!(result.suspects.len(), wrong.len());
            // The same numbers as heights at buttocks.
            let mut turned = OffsetTable { buttocks: table.waterlines.clone(), ..table.clone() };
            turned.stations.iter_mut().for_each(|s| s.heights = s.half_breadths.clone());
            assert!(suspect_heights_figure(&turned, &result).unwrap().as_str().contains("SUSPECT HEIGHTS"));
            let heights = height_grid(&turned).unwrap();
            for canvas in [compose(&table, &result, &OFFSETS).unwrap(), compose(&heights, &result, &HEIGHTS).unwrap()] {
                let texts = canvas.texts();
                for (k, text) in texts.iter().enumerate() {
                    assert!(canvas.sheet().contains(&text.place), "{text:?} leaves the sheet");
                    for other in &texts[..k] {
                        assert!(!text.place.overlaps(&other.place), "{text:?} on {other:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_table_without_cells_has_no_figure() {
        let table = OffsetTable::default();
        assert!(suspects_figure(&table, &suspects(&table)).is_err());
        assert!(suspect_heights_figure(&table, &suspects(&table)).is_err());
    }
}
