//! Suspect points of sections: each in its section, with the nearest point of the curve through its neighbours.

use super::{ABOVE, BELOW, GREY, MARGIN, MOST_PLOTS, ROW, WIDTH, circle, draw_axes, length, rounded};
use crate::fairing::{PointSuspect, PointSuspects};
use crate::hull::OffsetTable;
use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font::LEAST_LETTERS;
use crate::plot::paper::svg::Svg;
use crate::plot::ship::caption;
use crate::units::counted;

/// Height over the plots \[mm\].
const HEAD: f64 = 28.0;
/// Points on each side of a suspect that its left plot shows.
const REACH: usize = 6;

/// Draws the suspects among the points of sections.
///
/// # Errors
/// [`PlotError::Chart`] for a table without sections as points.
pub fn suspect_points_figure(table: &OffsetTable, result: &PointSuspects) -> Result<Svg, PlotError> {
    Ok(Svg::new(compose(table, result)?.finish("suspect points")))
}

fn compose(table: &OffsetTable, result: &PointSuspects) -> Result<Canvas, PlotError> {
    if table.stations.iter().all(|s| s.outlines.is_empty()) {
        return Err(PlotError::Chart("the table has no sections as points".to_owned()));
    }
    let shown = result.suspects.len().min(MOST_PLOTS);
    let height = HEAD + ROW * shown.div_ceil(2) as f64 + 8.0;
    let mut canvas = Canvas::new(WIDTH, height);
    let title = match table.name.as_str() {
        "" => "SUSPECT POINTS".to_owned(),
        name => format!("SUSPECT POINTS – {}", caption::plain(name)),
    };
    canvas.text([0.5 * WIDTH, 8.0], &title, &TextStyle::new(4.5, Anchor::Middle));
    let count = match result.suspects.len() {
        0 => "no suspects".to_owned(),
        n => counted(n, "suspect"),
    };
    let words = format!(
        "{count} among {} that their neighbours can judge    noise of the table {}",
        counted(result.judged, "point"),
        length(result.noise)
    );
    canvas.text([0.5 * WIDTH, 15.0], &words, &TextStyle::new(2.8, Anchor::Middle));
    for (k, suspect) in result.suspects.iter().take(shown).enumerate() {
        let left = if k % 2 == 0 { MARGIN } else { 0.5 * WIDTH + 3.0 };
        draw_suspect(&mut canvas, table, suspect, [left, HEAD + ROW * (k / 2) as f64]);
    }
    if result.suspects.len() > shown {
        let more = format!("{} further suspects are in the list", result.suspects.len() - shown);
        canvas.text([MARGIN, height - 4.0], &more, &TextStyle::new(2.6, Anchor::Start));
    }
    canvas.text([WIDTH - 6.0, height - 4.0], &caption::program(), &TextStyle::new(LEAST_LETTERS, Anchor::End));
    Ok(canvas)
}

/// The words about a suspect, its neighbourhood and its whole section.
fn draw_suspect(canvas: &mut Canvas, table: &OffsetTable, suspect: &PointSuspect, [left, top]: [f64; 2]) {
    let station = &table.stations[suspect.station];
    let style = TextStyle::new(2.6, Anchor::Start);
    let first = format!(
        "{}   {}, point {}: y {} z {}, {} from the curve of its neighbours, {:+.1} local noise",
        suspect.id,
        caption::plain(&station.station.words()),
        suspect.point,
        rounded(suspect.given[0]),
        rounded(suspect.given[1]),
        length(suspect.distance),
        suspect.score
    );
    canvas.text([left, top], &first, &style);
    let second = format!(
        "{} {}: {}, {}   (probability that it is wrong {:.3})",
        suspect.number.as_str(),
        suspect.written,
        suspect.hypothesis().as_str(),
        suspect.proposed_text,
        suspect.probability
    );
    canvas.text([left, top + 4.4], &second, &style);
    let step = 0.5 * (0.5 * WIDTH - MARGIN - 3.0);
    let frame =
        |k: f64| Rectangle::new(left + step * k + 11.0, top + 9.0, left + step * (k + 1.0) - 2.0, top + ROW - 14.0);
    let branch: Vec<[f64; 2]> = station.outlines[suspect.branch].iter().map(|p| [p.y, p.z]).collect();
    let near = suspect.point.saturating_sub(REACH)..(suspect.point + REACH + 1).min(branch.len());
    outline(canvas, &frame(0.0), &branch[near.clone()], suspect, suspect.point - near.start);
    outline(canvas, &frame(1.0), &branch, suspect, suspect.point);
}

/// Points of a section in order, the suspect number `own` hollow, the nearest point of the curve of the others beside it.
fn outline(canvas: &mut Canvas, frame: &Rectangle, points: &[[f64; 2]], suspect: &PointSuspect, own: usize) {
    let all = || points.iter().chain([&suspect.expected]);
    let range = |axis: usize| {
        let (a, b) = all().map(|p| p[axis]).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        let room = 0.08 * (b - a).max(1e-6);
        [a - room, b + room]
    };
    let ranges = [range(0), range(1)];
    let on = |p: &[f64; 2]| {
        let share = |axis: usize| (p[axis] - ranges[axis][0]) / (ranges[axis][1] - ranges[axis][0]);
        [frame.left + share(0) * frame.width(), frame.bottom - share(1) * frame.height()]
    };
    draw_axes(canvas, frame, ["half-breadth [m]", "z [m]"], ranges);
    let others: Vec<[f64; 2]> = points.iter().enumerate().filter(|(k, _)| *k != own).map(|(_, p)| on(p)).collect();
    canvas.polyline(&others, &Pen::new(0.2, GREY));
    for at in others {
        canvas.area(&circle(at, 0.6), "#000000");
    }
    let at = on(&suspect.expected);
    let pen = Pen::new(0.5, BELOW);
    canvas.line([at[0] - 1.2, at[1] - 1.2], [at[0] + 1.2, at[1] + 1.2], &pen);
    canvas.line([at[0] - 1.2, at[1] + 1.2], [at[0] + 1.2, at[1] - 1.2], &pen);
    canvas.polyline(&circle(on(&suspect.given), 1.3), &Pen::new(0.45, ABOVE));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fairing::point_suspects;
    use crate::hull::{Marks, OutlinePoint, StationOffsets};

    #[test]
    fn a_wrong_point_is_drawn_in_its_section() {
        let mut table = OffsetTable::default();
        for i in 0..9 {
            let mut station = StationOffsets::new(format!("{i}"), 5.0 * f64::from(i));
            let point = |k: i32| {
                let angle = std::f64::consts::FRAC_PI_2 * f64::from(k) / 20.0;
                let round = |v: f64| (1000.0 * v).round() / 1000.0;
                OutlinePoint { y: round(6.0 * angle.sin()), z: round(6.0 - 6.0 * angle.cos()), marks: Marks::default() }
            };
            station.outlines = vec![(0..=20).map(point).collect()];
            table.stations.push(station);
        }
        table.form.decimals = Some(3);
        table.stations[4].outlines[0][9].y += 0.3;
        let result = point_suspects(&table);
        assert_eq!(result.suspects.len(), 1);
        let canvas = compose(&table, &result).unwrap();
        let texts = canvas.texts();
        for (k, text) in texts.iter().enumerate() {
            assert!(canvas.sheet().contains(&text.place), "{text:?} leaves the sheet");
            assert!(texts[..k].iter().all(|other| !text.place.overlaps(&other.place)), "{text:?}");
        }
        assert!(
            suspect_points_figure(&table, &result).unwrap().as_str().contains("P1\u{a0}\u{a0}\u{a0}station 4, point 9")
        );
        assert!(suspect_points_figure(&OffsetTable::default(), &result).is_err());
    }
}
