//! Bonjean curves on the contracted profile, with their table.
//!
//! At each station the area of the section below a waterline is drawn forward of the station's line at the height of
//! the waterline, all at one scale. A waterline at any trim drawn across the profile cuts each curve at the area of its
//! station. Heights have a larger scale than lengths: the profile is contracted.

use crate::hull::{Hull, SectionalAreaCurve, StationNumbers, keel_height};
use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LETTERS;
use crate::plot::paper::label::{LabelPlacer, Preference};
use crate::plot::paper::scale::{drawing_scale, nice_step, rule_scale, sheet_scale};
use crate::plot::paper::sheet::ROOM;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::extrapolated::{BEYOND, draw_centreplane, is_guessed};
use crate::plot::ship::inputs::FigureInputs;
use crate::plot::ship::view::{DESIGN, GRID, OUTLINE};
use crate::plot::ship::{caption, outline};

/// Room aft and forward of the profile \[mm\].
const SIDES: [f64; 2] = [20.0, 17.0];
/// Upper edge of the profile, and its largest height \[mm\].
const TOP: f64 = 30.0;
const HEIGHT: f64 = 130.0;
/// Heights of a curve.
const LEVELS: usize = 60;
/// Width of the largest area, in distances of stations, at most.
const WIDEST: f64 = 3.2;
/// Most stations of the table, but for the last.
const COLUMNS: u32 = 24;
/// Most waterlines of the table.
const ROWS: f64 = 11.0;
/// Height of a row of the table \[mm\].
const ROW: f64 = 4.6;

/// Areas of stations at heights: `areas[level][station]` [m^2]; none above the deck at side.
#[derive(Debug, Clone, PartialEq)]
pub struct BonjeanTable {
    /// Positions of the stations forward of AP \[m\].
    pub stations: Vec<f64>,
    /// Heights above the base line \[m\].
    pub heights: Vec<f64>,
    /// Areas, both sides, a row a height.
    pub areas: Vec<Vec<Option<f64>>>,
}

impl BonjeanTable {
    /// Areas of `stations` below `heights`, each exact to rounding.
    #[must_use]
    pub fn new(hull: &Hull, stations: &[f64], heights: &[f64]) -> Self {
        let slack = 1e-9 * hull.particulars().depth;
        let areas = SectionalAreaCurve::areas(hull, heights, stations);
        let decks: Vec<f64> = stations.iter().map(|&x| hull.deck_height(x) + slack).collect();
        let row = |(level, &height): (usize, &f64)| {
            let area = |(areas, deck): (&Vec<f64>, &f64)| (height <= *deck).then(|| areas[level]);
            areas.iter().zip(&decks).map(area).collect()
        };
        let areas = heights.iter().enumerate().map(row).collect();
        Self { stations: stations.to_vec(), heights: heights.to_vec(), areas }
    }

    /// The table of the sheet: full stations from AP forward, every second where there are many, heights at round steps up to the deck.
    #[must_use]
    pub fn with_defaults(hull: &Hull, numbers: StationNumbers) -> Self {
        let p = hull.particulars();
        let (length, spaces) = (p.length_between_perpendiculars, f64::from(numbers.spaces));
        let every = numbers.spaces.div_ceil(COLUMNS).max(1) as usize;
        let stations: Vec<f64> = (0..=numbers.spaces).step_by(every).map(|k| length * f64::from(k) / spaces).collect();
        let step = nice_step(p.depth, ROWS);
        let count = (hull.top() / step + 1e-9).floor() as usize;
        let mut heights: Vec<f64> = (1..=count).map(|k| k as f64 * step).collect();
        if let Some(draught) = p.draught.filter(|draught| heights.iter().all(|z| (z - draught).abs() > 1e-9)) {
            heights.push(draught);
            heights.sort_by(f64::total_cmp);
        }
        Self::new(hull, &stations, &heights)
    }
}

/// Draws curves and table.
///
/// # Errors
/// [`PlotError::Chart`] for a hull without areas.
pub fn bonjean_figure(inputs: &FigureInputs) -> Result<Svg, PlotError> {
    Ok(Svg::new(compose(inputs)?.finish("bonjean")))
}

pub(in crate::plot) fn compose(inputs: &FigureInputs) -> Result<Canvas, PlotError> {
    let hull = inputs.hull;
    let p = hull.particulars();
    let length = p.length_between_perpendiculars;
    let stations = inputs.curves.conventions.stations;
    let table = BonjeanTable::with_defaults(hull, stations);
    let ends = outline::overall_length(hull);
    let (low, high) = (ends[0].min(0.0), ends[1].max(length));
    let (bottom, top) = (hull.bottom().min(0.0), hull.top());
    let spacing = stations.spacing(length);
    let name = |k: usize| stations.number((table.stations[k] / spacing).round()).to_string();
    let n = drawing_scale(top - bottom, HEIGHT);
    let upward = 1000.0 / f64::from(n);
    let step = nice_step(p.depth, ROWS);
    let is_round = |z: f64| (z / step - (z / step).round()).abs() < 1e-9;
    let floor = TOP + upward * (top - bottom);
    let levels: Vec<f64> = (0..=LEVELS).map(|k| bottom + (top - bottom) * k as f64 / LEVELS as f64).collect();
    let dense = BonjeanTable::new(hull, &table.stations, &levels);
    let largest = dense.areas.iter().flatten().flatten().copied().fold(0.0, f64::max);
    if largest <= 0.0 {
        return Err(PlotError::Chart("the hull has no section areas".to_owned()));
    }
    // The last curves need room forward of the stem.
    let reach = dense
        .areas
        .iter()
        .flat_map(|row| row.iter().zip(&table.stations))
        .filter_map(|(area, x)| Some(x + WIDEST * spacing * (*area)? / largest));
    let end = reach.fold(high, f64::max) + 0.2 * spacing;
    let room = ROOM[0] - SIDES[0] - SIDES[1];
    let contracted = rule_scale(end - low, room);
    let across = 1000.0 / f64::from(contracted);
    let left = SIDES[0] + 0.5 * (room - across * (end - low));
    let at = |x: f64, z: f64| [left + across * (x - low), floor - upward * (z - bottom)];
    let scale = sheet_scale(largest, WIDEST * spacing * across);
    let height = floor + 26.0 + ROW * (table.heights.len() + 2) as f64 + 10.0;
    let mut canvas = Canvas::new(ROOM[0], height);
    let title = format!("BONJEAN CURVES – {}", caption::plain(hull.name()));
    canvas.text([0.5 * ROOM[0], 8.0], &title, &TextStyle::new(4.5, Anchor::Middle));
    let words = format!(
        "areas: 1 mm = {scale} m² forward of the line of the station    heights 1 : {n}    lengths 1 : {contracted}    moulded"
    );
    canvas.text([0.5 * ROOM[0], 15.0], &words, &TextStyle::new(LETTERS, Anchor::Middle));
    let names = TextStyle::new(LETTERS, Anchor::End);
    let is_design = |z: f64| p.draught.is_some_and(|draught| (z - draught).abs() < 1e-9);
    for &z in &table.heights {
        canvas.line(at(low, z), at(end, z), if is_design(z) { &DESIGN } else { &GRID });
    }
    let right = TextStyle::new(LETTERS, Anchor::Start);
    // The design waterline bears its height on the other side, where it takes no place from those beside it.
    if let Some(draught) = p.draught {
        let [x, y] = at(end, draught);
        for (row, words) in ["DWL".to_owned(), format!("{draught:.2} m")].iter().enumerate() {
            canvas.text([x + 1.5, y + 3.8 * row as f64], words, &right);
        }
    }
    let mut named: Option<f64> = None;
    for &z in table.heights.iter().filter(|z| !is_design(**z) || is_round(**z)) {
        let y = at(low, z)[1];
        if named.is_none_or(|other| (other - y).abs() >= 3.6) {
            canvas.text([left - 2.0, y], &format!("{z:.2} m"), &names);
            named = Some(y);
        }
    }
    draw_centreplane(&mut canvas, inputs, |[x, z]| at(x, z));
    let deck: Vec<[f64; 2]> = outline::deck_at_side(hull).into_iter().map(|p| at(p[0], p[2])).collect();
    canvas.polyline(&deck, &OUTLINE);
    let curve = Pen::new(0.35, "#0b4a86");
    let (mut placer, mut numbers) = (LabelPlacer::default(), Vec::new());
    for (k, &x) in table.stations.iter().enumerate() {
        let Some(keel) = keel_height(hull, x) else { continue };
        canvas.line(at(x, keel), at(x, hull.deck_height(x)), &Pen::new(0.2, "#000000"));
        let mut points: Vec<[f64; 2]> = vec![at(x, keel)];
        let mut add = |z: f64, area: f64| {
            let [px, py] = at(x, z);
            points.push([px + area / scale, py]);
        };
        for (z, row) in levels.iter().zip(&dense.areas) {
            if let Some(area) = row[k].filter(|_| *z > keel) {
                add(*z, area);
            }
        }
        let deck = hull.deck_height(x);
        if let Some(area) = SectionalAreaCurve::new(hull, deck, &[x]).areas.first() {
            add(deck, *area);
        }
        canvas.polyline(&points, &curve);
        canvas.text([at(x, bottom)[0], floor + 3.4], &name(k), &TextStyle::new(LETTERS, Anchor::Middle));
        placer.add_curve(&points);
        numbers.push(k);
    }
    // Each curve bears the number of its station.
    let window = Rectangle::new(0.0, TOP - 4.0, ROOM[0], floor);
    let style = TextStyle::new(LETTERS, Anchor::Middle).coloured(curve.colour).halo();
    for (curve, k) in numbers.into_iter().enumerate() {
        let preferred = Preference { part: 0.8, crossings: 1, beside: true };
        placer.name_curve(&mut canvas, curve, &name(k), &style, preferred, &window);
    }
    canvas.text([at(0.0, bottom)[0], floor + 7.6], "AP", &TextStyle::new(LETTERS, Anchor::Middle));
    canvas.text([at(length, bottom)[0], floor + 7.6], "FP", &TextStyle::new(LETTERS, Anchor::Middle));
    let heads: Vec<String> = (0..table.stations.len()).map(name).collect();
    draw_table(&mut canvas, (&table, &heads), p.draught, floor + 17.0);
    let beyond = if is_guessed(inputs) { format!("    {BEYOND}") } else { String::new() };
    let words = format!("{}    {}{beyond}", caption::design_waterline(inputs), caption::stations(inputs));
    canvas.text([10.0, height - 4.0], &words, &TextStyle::new(LETTERS, Anchor::Start));
    canvas.text([ROOM[0] - 6.0, height - 4.0], &caption::program(), &TextStyle::new(LETTERS, Anchor::End));
    Ok(canvas)
}

/// Areas of the stations, the highest waterline on top.
fn draw_table(canvas: &mut Canvas, (table, heads): (&BonjeanTable, &[String]), design: Option<f64>, top: f64) {
    let columns = table.stations.len() as f64;
    let (left, first) = (10.0, 30.0);
    let width = (ROOM[0] - 2.0 * left - first) / columns;
    let largest = table.areas.iter().flatten().flatten().copied().fold(0.0, f64::max);
    let digits = match largest {
        1000.0.. => 0,
        100.0.. => 1,
        10.0.. => 2,
        _ => 3,
    };
    let style = TextStyle::new(LETTERS, Anchor::End);
    let head = TextStyle { anchor: Anchor::Start, ..style };
    canvas.text([left, top - 3.0], "AREAS OF SECTIONS, BOTH SIDES [m²]", &TextStyle { size: 3.2, ..head });
    let y = |row: usize| top + ROW * (row as f64 + 0.5);
    canvas.text([left + 1.0, y(0)], "z [m] \\ station", &head);
    for (k, name) in heads.iter().enumerate() {
        canvas.text([left + first + width * (k + 1) as f64 - 1.0, y(0)], name, &style);
    }
    for (row, (z, areas)) in table.heights.iter().zip(&table.areas).rev().enumerate() {
        let mark = if design.is_some_and(|design| (z - design).abs() < 1e-9) { "  DWL" } else { "" };
        canvas.text([left + 1.0, y(row + 1)], &format!("{z:.3}{mark}"), &head);
        for (k, area) in areas.iter().enumerate() {
            if let Some(area) = area {
                canvas.text(
                    [left + first + width * (k + 1) as f64 - 1.0, y(row + 1)],
                    &format!("{:.digits$}", area.max(0.0) + 0.0),
                    &style,
                );
            }
        }
    }
    let bottom = top + ROW * (table.heights.len() + 1) as f64;
    let rule = Pen::new(0.13, "#000000");
    canvas.rectangle(&Rectangle::new(left, top, ROOM[0] - left, bottom), &Pen::new(0.35, "#000000"));
    canvas.line([left, top + ROW], [ROOM[0] - left, top + ROW], &rule);
    canvas.line([left + first, top], [left + first, bottom], &rule);
}
