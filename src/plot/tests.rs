//! The figures of hulls of several kinds: what stands on them and where.

use super::figures::figure::Figure;
use super::paper::canvas::Canvas;
use super::paper::error::PlotError;
use super::paper::scale::drawing_scale;
use super::paper::svg::Svg;
use super::ship::inputs::FigureInputs;
use super::ship::lines_grid::LinesGrid;
use super::ship::profile;
use super::ship::profile::{LongStyle, Naming};
use super::ship::view::View;
use crate::hull::{Hull, StationNumbers};
use crate::hydrostatics::{Conventions, CurvesOfForm};
use crate::parametric::ShipType;
use crate::parametric::analytic::{self, Dimensions};
use crate::parametric::cosh::{self, DesignTargets};

fn wigley() -> Hull {
    let dimensions = Dimensions { length: 100.0, breadth: 10.0, draught: 6.25, depth: 9.0 };
    analytic::wigley("Wigley", &dimensions).unwrap().hull
}

fn ship(name: &str, ship_type: ShipType, [length, breadth, draught, depth, block]: [f64; 5]) -> Hull {
    let requested = DesignTargets {
        ship_type: Some(ship_type),
        length,
        breadth: Some(breadth),
        draught: Some(draught),
        depth: Some(depth),
        block_coefficient: Some(block),
        ..DesignTargets::default()
    };
    cosh::generate(name, &requested).unwrap().hull
}

/// Sharp at both ends, flat at both ends; fine with a transom, full with a parallel body, short with sheer.
fn hulls() -> Vec<Hull> {
    let body = |breadth| Dimensions { length: 40.0, breadth, draught: 3.0, depth: 5.0 };
    vec![
        wigley(),
        analytic::rectangular_box("box", &body(12.0)).unwrap().hull,
        ship("container ship", ShipType::Container, [230.0, 32.2, 11.5, 19.0, 0.65]),
        ship("frigate", ShipType::Frigate, [100.0, 13.2, 4.4, 9.0, 0.50]),
        ship("bulk carrier", ShipType::BulkCarrier, [180.0, 30.0, 11.0, 16.0, 0.82]),
        ship("fishing vessel", ShipType::Fishing, [23.0, 7.0, 2.9, 4.0, 0.52]),
        ship("shallow yacht", ShipType::Yacht, [10.0, 3.0, 0.6, 1.6, 0.40]),
    ]
}

/// Draws a hull at its design draught, with a table from 0.2 T to D.
fn with_inputs<T>(hull: &Hull, draw: impl FnOnce(&FigureInputs) -> T) -> T {
    let p = hull.particulars();
    let conventions = Conventions::default();
    let design = CurvesOfForm::new(hull, &[hull.reference_height()], &conventions);
    let curves =
        CurvesOfForm::new(hull, &[0.2 * hull.reference_height(), hull.reference_height(), p.depth], &conventions);
    draw(&FigureInputs {
        hull,
        before: None,
        record: None,
        design: design.rows.first(),
        curves: &curves,
        source: None,
        dense: None,
    })
}

#[test]
fn text_keeps_apart_and_on_the_sheet() {
    let mut faults = Vec::new();
    for hull in &hulls() {
        for figure in Figure::ALL {
            let canvas = with_inputs(hull, |inputs| figure.compose(inputs)).unwrap();
            let (texts, sheet) = (canvas.texts(), canvas.sheet());
            for (k, text) in texts.iter().enumerate() {
                if !sheet.contains(&text.place) {
                    faults.push(format!("{} {}: {text:?} leaves the sheet", hull.name(), figure.key()));
                }
                for other in &texts[..k] {
                    if text.place.grown(-0.05).overlaps(&other.place.grown(-0.05)) {
                        faults.push(format!("{} {}: {text:?} on {other:?}", hull.name(), figure.key()));
                    }
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// The name of a station or of several: `19½`, `3 – 5`, `-½ to ½`.
fn names_stations(text: &str) -> bool {
    text.chars().all(|c| c.is_ascii_digit() || "-½– to".contains(c)) && text.chars().any(|c| !c.is_alphabetic())
}

#[test]
fn names_of_stations_stand_clear_of_all_other_text() {
    for hull in &hulls() {
        let canvas = with_inputs(hull, |inputs| Figure::Lines.compose(inputs)).unwrap();
        let texts = canvas.texts();
        let stations = texts.iter().enumerate().filter(|(_, text)| names_stations(&text.content));
        assert!(stations.clone().count() > 40, "{}", hull.name());
        for (k, station) in stations {
            let place = station.place.grown(0.15);
            let other = texts.iter().enumerate().find(|(m, other)| *m != k && place.overlaps(&other.place));
            assert!(other.is_none(), "{}: {station:?} at {other:?}", hull.name());
        }
    }
}

#[test]
fn every_waterline_is_named_in_the_half_breadth_plan() {
    for hull in hulls().iter().filter(|hull| hull.name() != "box") {
        let grid = LinesGrid::new(hull, 1e-3, StationNumbers::default(), None);
        let scale = drawing_scale(grid.length[1] - grid.length[0], 350.0);
        let mut canvas = Canvas::new(420.0, 297.0);
        let style = LongStyle { text_size: 3.0, naming: Naming::Full };
        profile::draw_half_breadths(&mut canvas, hull, &grid, &View::new([40.0, 150.0], scale), style);
        for plane in grid.waterlines.iter().chain(&grid.design_waterline).filter(|plane| plane.on_side > 0) {
            let named = canvas.texts().iter().any(|text| text.content == plane.name);
            assert!(named, "{}: {} bears no name", hull.name(), plane.name);
        }
        for plane in &grid.diagonals {
            let names = canvas.texts().iter().filter(|text| text.content == plane.name).count();
            assert!((1..=2).contains(&names), "{}: {} bears {names} names", hull.name(), plane.name);
        }
        let document = canvas.finish("half-breadths");
        assert!(
            document.contains("stroke-width=\"0.55\" stroke-dasharray"),
            "{}: the DWL looks as others",
            hull.name()
        );
    }
}

#[test]
fn lines_plans_bear_a_table_and_the_length_overall() {
    for hull in &hulls() {
        let canvas = with_inputs(hull, |inputs| Figure::Lines.compose(inputs)).unwrap();
        for part in ["HALF-BREADTHS [m]", "deck at side", "L_OA ", "BODY PLAN   1 : ", "DWL"] {
            assert!(canvas.texts().iter().any(|text| text.content.starts_with(part)), "{}: {part}", hull.name());
        }
    }
}

#[test]
fn figures_bear_the_names_of_their_lines() {
    let hull = ship("frigate", ShipType::Frigate, [100.0, 13.2, 4.4, 9.0, 0.50]);
    let wanted: [(Figure, &[&str]); 5] = [
        (
            Figure::Lines,
            &[
                "frigate",
                "LINES PLAN",
                "PROFILE   1 : 500",
                "BODY PLAN   1 : 100",
                "AP",
                "FP",
                "DWL  4.40 m",
                "WL 1  1.00 m",
                "III",
                "D1",
                "0½",
                "19½",
                "100 mm on paper",
            ],
        ),
        (Figure::Sections, &["BODY PLAN – frigate", "CL", "DWL  4.40 m", "WL ½  0.50 m", "D2", "17", "4"]),
        (
            Figure::SectionalArea,
            &[
                "SECTIONAL-AREA CURVE – frigate",
                "A(x)",
                "section area A [m²]",
                "A / A_X [-]",
                "station, L_PP / 20 from AP",
            ],
        ),
        (
            Figure::Hydrostatics,
            &[
                "HYDROSTATIC CURVES – frigate",
                "Δ",
                "∇",
                "LCB",
                "LCF",
                "KB",
                "KM_T",
                "KM_L",
                "TPC",
                "MTC",
                "C_B",
                "C_M = C_X",
                "C_P",
                "C_WP",
                "A_WL",
                "S",
            ],
        ),
        (
            Figure::DiagramSheet,
            &[
                "DIAGRAM SHEET – frigate",
                "AP",
                "FP",
                "midship (L_PP / 2)",
                "KM_L",
                "KM_T",
                "LCB",
                "MTM",
                "C_X",
                "1 mm = 0.025",
            ],
        ),
    ];
    for (figure, names) in wanted {
        let canvas = with_inputs(&hull, |inputs| figure.compose(inputs)).unwrap();
        for name in names {
            assert!(canvas.texts().iter().any(|text| text.content == *name), "{}: {name} is missing", figure.key());
        }
    }
}

#[test]
fn the_same_inputs_give_the_same_bytes() {
    let hull = wigley();
    for figure in Figure::ALL {
        let draw = || with_inputs(&hull, |inputs| figure.draw(inputs)).unwrap();
        let (first, second) = (draw(), draw());
        assert_eq!(first, second, "{}", figure.key());
        let png = |svg: &Svg| svg.to_png(60.0).unwrap();
        assert!(png(&first) == png(&second), "{}", figure.key());
    }
}

#[test]
fn pictures_are_of_the_size_of_a_page() {
    let hull = wigley();
    for figure in Figure::ALL {
        let svg = with_inputs(&hull, |inputs| figure.draw(inputs)).unwrap();
        let png = svg.to_png(figure.dots_per_inch()).unwrap();
        assert!(png.windows(4).any(|bytes| bytes == b"pHYs"), "{}: no resolution", figure.key());
        assert!(png.len() < 1_000_000, "{}: {} bytes", figure.key(), png.len());
        let width = u32::from_be_bytes(png[16..20].try_into().unwrap());
        assert!((1200..=3500).contains(&width), "{}: {width} pixels", figure.key());
    }
}

#[test]
fn a_picture_has_a_size() {
    let hull = wigley();
    let svg = with_inputs(&hull, |inputs| Figure::SectionalArea.draw(inputs)).unwrap();
    for dots_per_inch in [0.0, -3.0, f64::NAN, 1e6] {
        assert!(matches!(svg.to_png(dots_per_inch), Err(PlotError::PictureSize { .. })));
    }
}

#[test]
fn curves_need_two_draughts() {
    let hull = wigley();
    let table = CurvesOfForm::new(&hull, &[6.25], &Conventions::default());
    let inputs = FigureInputs {
        hull: &hull,
        before: None,
        record: None,
        design: table.rows.first(),
        curves: &table,
        source: None,
        dense: None,
    };
    for figure in [Figure::Hydrostatics, Figure::DiagramSheet] {
        assert_eq!(figure.draw(&inputs), Err(PlotError::TooFewDraughts(1)), "{}", figure.key());
    }
}

#[test]
fn curves_end_where_the_deck_edge_goes_under() {
    let hull = ship("frigate", ShipType::Frigate, [100.0, 13.2, 4.4, 9.0, 0.50]);
    let p = hull.particulars();
    let table = CurvesOfForm::new(
        &hull,
        &[0.5 * hull.reference_height(), hull.reference_height(), 1.3 * p.depth],
        &Conventions::default(),
    );
    let inputs = FigureInputs {
        hull: &hull,
        before: None,
        record: None,
        design: table.rows.get(1),
        curves: &table,
        source: None,
        dense: None,
    };
    let rows = inputs.dense_rows().unwrap();
    let edge = inputs.immersed_edge(&rows).unwrap();
    assert!((edge - p.depth).abs() < 0.05 * p.depth, "{edge}");
    assert!(rows.iter().all(|row| row.draught <= edge + 1e-9));
    for figure in [Figure::Hydrostatics, Figure::DiagramSheet] {
        let canvas = figure.compose(&inputs).unwrap();
        let named = canvas.texts().iter().any(|text| text.content.starts_with("deck edge goes under at "));
        assert!(named, "{}", figure.key());
    }
    with_inputs(&hull, |inputs| assert_eq!(inputs.immersed_edge(&inputs.dense_rows().unwrap()), None));
}

#[test]
fn names_of_sections_stand_on_their_side_of_the_centre_line() {
    for hull in &hulls() {
        let canvas = with_inputs(hull, |inputs| Figure::Sections.compose(inputs)).unwrap();
        let texts = canvas.texts();
        let centre =
            texts.iter().find(|text| text.content == "CL").map(|text| 0.5 * (text.place.left + text.place.right));
        let centre = centre.unwrap();
        // The names over the deck; those on the curves may stand across the line.
        let top = texts.iter().filter(|text| text.content.starts_with("WL ")).map(|text| text.place.top);
        let top = top.fold(f64::INFINITY, f64::min);
        for text in texts.iter().filter(|text| names_stations(&text.content) && text.place.bottom < top) {
            let first = text.content.split([' ', '½']).next().unwrap_or_default().parse::<i32>();
            match first {
                Ok(first) if first > 10 => assert!(text.place.left > centre, "{}: {text:?}", hull.name()),
                Ok(first) if first < 10 => assert!(text.place.right < centre, "{}: {text:?}", hull.name()),
                _ => {}
            }
        }
    }
}
