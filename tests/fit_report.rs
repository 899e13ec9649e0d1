//! What `fit` and `check` tell beside the hull: points of sections, suspects, estimates, a surface that leaves its data.

use loftsman::internals::hull::{FitMethod, Hull, Thinned, VolumeEstimate};
use loftsman::internals::report::{
    FitJob, FitOutputs, check_json, check_page, check_table, fit_outputs, fit_page, read_fit, read_table_file,
};

use crate::support::carried;

fn fitted(file: &str, change: impl FnOnce(&mut FitJob)) -> (FitJob, FitOutputs, String) {
    let mut job = read_fit(&carried(file), None, None).expect("a table");
    change(&mut job);
    let outputs = fit_outputs(&job, &[]).expect("a hull");
    let page = fit_page(&job, &outputs, "out").split_whitespace().collect::<Vec<_>>().join(" ");
    (job, outputs, page)
}

fn residual_rows(outputs: &FitOutputs) -> Vec<Vec<String>> {
    let file = outputs.files.iter().find(|file| file.name == "residuals.csv").expect("residuals");
    let text = String::from_utf8(file.contents.clone()).expect("text");
    text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

#[test]
fn points_of_sections_have_residuals() {
    let (_, outputs, page) = fitted("tests/data/s175/sections.csv", |_| {});
    let points = &outputs.summary["points"];
    let compared = points["compared"].as_u64().expect("points");
    assert!(compared > 100, "{compared}");
    assert!(page.contains(&format!("{compared} points of sections, missed in half-breadth by")), "{page}");
    assert!(!page.contains("0 cells, missed"), "{page}");
    let rows = residual_rows(&outputs);
    assert_eq!(rows.len() as u64, compared);
    let number = |text: &String| text.parse::<f64>().expect("a number");
    let mut squares = 0.0;
    for row in &rows {
        // Residual is surface less table, and the surface is that of the hull.
        let (x, z, given, surface, residual) =
            (number(&row[1]), number(&row[2]), number(&row[3]), number(&row[4]), number(&row[5]));
        let y = outputs.fitted.hull.half_breadth(x, z).expect("a hull there");
        assert!((y - surface).abs() < 1e-6 && (surface - given - residual).abs() < 1e-6, "{row:?}");
        squares += residual * residual;
    }
    let rms = (squares / rows.len() as f64).sqrt();
    assert!((points["rms"].as_f64().expect("rms") - rms).abs() < 1e-6);
    assert!(points["max"].as_f64().expect("max") >= rms);
}

#[test]
fn sections_as_points_are_judged_as_points() {
    let check = check_table(&carried("tests/data/s175/sections.csv")).expect("a table");
    let (page, json) = (check_page(&check), check_json(&check));
    assert!(page.contains("points of sections judged along their sections"), "{page}");
    assert_eq!((&json["judged"], &json["heights_judged"]), (&0.into(), &0.into()));
    let [judged, left] = ["points_judged", "points_not_judged"].map(|key| json[key].as_u64().expect("a number"));
    let given: usize = check.table.iter().flat_map(|t| &t.stations).flat_map(|s| &s.outlines).map(Vec::len).sum();
    assert!(judged > 100 && judged + left == given as u64, "{judged} + {left} of {given}");
    let grid = check_table(&carried("tests/data/series60_cb060/offsets.csv")).expect("a table");
    let [cells, heights, points] = grid.judged();
    assert!(cells > 100 && heights == 0 && points == 0 && grid.points_not_judged() == 0, "{cells} {heights} {points}");
}

#[test]
fn suspects_and_remarks_stand_on_the_page() {
    let (job, outputs, page) = fitted("reports/suspects/series60-misprinted.csv", |_| {});
    let count = job.suspects.suspects.len();
    assert!(count > 0);
    assert!(page.contains(&format!("WARNING: {count} suspect cell")) && page.contains("run `check`"), "{page}");
    assert_eq!(outputs.summary["suspects"]["count"], count);
    assert_eq!(outputs.summary["suspects"]["worst"]["written"], job.suspects.suspects[0].written);
    for note in job.reading.iter().take(12) {
        let start: Vec<&str> = note.message.split_whitespace().take(4).collect();
        assert!(page.contains(&start.join(" ")), "{} {page}", note.message);
    }
    let (job, _, page) = fitted("tests/data/wigley/offsets.csv", |_| {});
    assert!(job.suspects.suspects.is_empty() && !page.contains("WARNING"), "{page}");
}

#[test]
fn a_surface_that_leaves_its_data_is_told() {
    // With half of its breadth stated, the waterplane is larger than Lpp B.
    let (_, outputs, page) = fitted("tests/data/wigley/offsets.csv", |job| {
        job.table.stated.breadth = Some(5.0);
        job.table.stated.draught = Some(6.25);
    });
    assert!(outputs.warnings.iter().any(|w| w.contains("waterplane coefficient") && w.contains("1.33")), "{page}");
    assert!(page.contains("WARNING: the waterplane coefficient"), "{page}");
}

#[test]
fn the_estimate_covers_the_error_of_a_parabolic_hull() {
    let (mut table, _) = read_table_file(&carried("tests/data/wigley/offsets.csv")).expect("a table");
    table.stated.draught = Some(6.25);
    let hull = Hull::fit(&table, &FitMethod::Graded).expect("a hull").hull;
    let estimate = VolumeEstimate::new(&table, &FitMethod::Graded, &hull, 6.25);
    let exact = 4.0 / 9.0 * 100.0 * 10.0 * 6.25;
    let error = (estimate.volume / exact - 1.0).abs();
    let total = estimate.total().expect("enough lines");
    assert!(error <= total + 2e-4 && total < 5e-3, "{error} {total}");
    assert!((Thinned::error(10.0, 10.6) - 0.2).abs() < 1e-12);
    table.stations.truncate(4);
    let none = Thinned::new(&table, &FitMethod::Graded, 6.25);
    assert!(none.stations.is_none(), "four stations are too few to leave one out");
}
