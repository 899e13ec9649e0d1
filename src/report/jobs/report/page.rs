//! `report.html`: one page that opens without a network: the hull in space, the figures, and tables that can be sorted.

pub(in crate::report) use super::cells::{
    NO_DESIGN_DRAUGHT, PRICES, Table, changes, condition, constraints, escape, figures, hydrostatics, inflections,
    inflections_words, list, lowered, marked, suspects, text,
};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use super::figures::ReportFigure;
use super::verdict::verdict;
use crate::exchange::scene_json;
use crate::fairing::inspect::{Planes, Resolution};
use crate::hull::Hull;
use crate::hydrostatics::{CurvesOfForm, Hydrostatics, assumed_mark};
use crate::plot::FONT;
use crate::report::input::result::JobResult;
use crate::report::words::remarks::is_warning;

const STYLE: &str = include_str!("html/page.css");
const VIEWER: &str = include_str!("html/viewer.js");
const TABLES: &str = include_str!("html/tables.js");

/// Width of a figure that fills the column \[mm\].
const FULL: f64 = 400.0;

/// A drawing in the page; its names are its own.
fn inline(figure: &ReportFigure) -> String {
    let own = format!("{}-", figure.key);
    let text = figure.svg.as_str().replace("id=\"", &format!("id=\"{own}")).replace("url(#", &format!("url(#{own}"));
    // The size is that of the column; the viewBox keeps the proportions.
    let (head, rest) = text.split_at(text.find('>').map_or(0, |end| end + 1));
    let shape = head.find("viewBox=").map_or("", |at| &head[at..]);
    // Small charts do not fill the column.
    let wide = head.split("width=\"").nth(1).and_then(|rest| rest.split("mm").next()?.parse::<f64>().ok());
    let part = wide.map_or(100.0, |millimetres| (100.0 * millimetres / FULL).clamp(50.0, 100.0));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"{}\" style=\"width:{part:.0}%\" {shape}{rest}",
        escape(&figure.title)
    )
}

fn box_of(id: &str, word: &str, checked: bool) -> String {
    let checked = if checked { " checked" } else { "" };
    format!("<label><input type=\"checkbox\" id=\"{id}\"{checked}> {word}</label>\n")
}

fn radio(name: &str, id: &str, word: &str, checked: bool) -> String {
    let checked = if checked { " checked" } else { "" };
    format!("<label><input type=\"radio\" name=\"{name}\" id=\"{id}\"{checked}> {word}</label>\n")
}

fn viewer(result: &JobResult) -> String {
    let mut html = String::from(
        "<section id=\"viewer\"><h2>The hull in space</h2>\n<p>Drag to turn, Shift and drag to move, wheel to zoom.</p>\n\
         <div id=\"controls\">\n",
    );
    for (view, word) in [("space", "space"), ("ahead", "from ahead"), ("profile", "profile"), ("plan", "from above")] {
        html.push_str(&format!("<button type=\"button\" data-view=\"{view}\">{word}</button>\n"));
    }
    html.push_str("<fieldset>");
    for (id, word, checked) in [
        ("body", "body plan", false),
        ("station", "stations", true),
        ("waterline", "waterlines", true),
        ("buttock", "buttocks", false),
        ("diagonal", "diagonals", false),
        ("combs", "combs", false),
    ] {
        html.push_str(&box_of(id, word, checked));
    }
    html.push_str(
        "<input type=\"range\" id=\"comb-scale\" min=\"-1\" max=\"1\" step=\"0.05\" value=\"0\" aria-label=\"length of combs\"> \
         <span id=\"comb-words\"></span></fieldset>\n<fieldset>",
    );
    for (id, word, checked) in [
        ("surface", "surface", true),
        ("gaussian", "Gaussian map", false),
        ("mean", "mean map", false),
        ("zebra", "zebra", false),
    ] {
        html.push_str(&box_of(id, word, checked));
    }
    html.push_str("</fieldset>\n<fieldset>");
    html.push_str(&radio("sides", "half", "half", false));
    html.push_str(&radio("sides", "full", "full hull", true));
    html.push_str("</fieldset>\n");
    if result.fairing.is_some() {
        html.push_str("<fieldset>");
        html.push_str(&radio("when", "before", "before", false));
        html.push_str(&radio("when", "after", "after", true));
        html.push_str("</fieldset>\n");
    }
    html.push_str(
        "</div>\n<p id=\"no-view\" class=\"bad\" hidden>This browser has no WebGL; the figures below show the same.</p>\n\
         <canvas id=\"view\"></canvas>\n<p id=\"scale\"><span id=\"scale-bar\"></span> <span id=\"scale-words\"></span></p>\n\
         <p id=\"legend\"></p></section>\n",
    );
    html
}

/// The scene of the viewer, safe inside a script element.
fn scene(result: &JobResult) -> String {
    let mut planes = Planes::with_defaults(&result.hull);
    let length = result.hull.particulars().length_between_perpendiculars;
    let mut tolerance = Resolution::for_length(length).tolerance();
    let mut hulls: Vec<(&str, &Hull)> = vec![("after", &result.hull)];
    if let Some((record, _)) = &result.fairing {
        planes.stations = record.lines.stations.iter().map(|station| station.x).collect();
        planes.waterlines.clone_from(&record.lines.waterlines);
        tolerance = record.resolution;
        hulls.push(("before", &record.before));
    }
    scene_json(&hulls, &planes.cuts(), tolerance).to_string().replace("</", "<\\/")
}

/// The page.
pub(in crate::report) fn report_page(
    result: &JobResult,
    (design, before): (Option<&Hydrostatics>, Option<&Hydrostatics>),
    curves: &CurvesOfForm,
    drawn: &[ReportFigure],
    offsets: &[(&'static str, &'static str, Table)],
) -> String {
    let name = escape(result.hull.name());
    let p = result.hull.particulars();
    let mut sections: Vec<(&str, &str, String)> = Vec::new();
    if let Some((record, fairing)) = &result.fairing {
        sections.push(("suspects", "Suspects", suspects(fairing).html()));
        sections.push((
            "constraints",
            "What is held, and at which price",
            format!(
                "<p>{}. Duality gap {}, largest violation {}.</p>\n{}",
                lowered(PRICES),
                figures(&fairing["certificate"]["gap"], 2),
                figures(&fairing["certificate"]["max_violation"], 2),
                constraints(fairing).html()
            ),
        ));
        let words = inflections_words(record, fairing, false);
        let words = format!("<p>{}{}.</p>\n", words[..1].to_uppercase(), &words[1..]);
        sections.push(("inflections", "Inflections", format!("{words}{}", inflections(record, fairing, false).html())));
    }
    if let Some(design) = design {
        let table = condition(result, design, before).html();
        sections.push(("condition", "Design condition", marked(table, [design])));
    }
    sections.push(("table", "Hydrostatic table", marked(hydrostatics(curves, p.draught).html(), &curves.rows)));
    let words = "<p>Metres; x forward of AP, z from the base line, y and distances from the centreplane, diagonals by their height there.</p>\n";
    for (id, title, table) in offsets {
        sections.push((id, title, format!("{words}{}", table.html())));
    }
    if let Some(table) = changes(result) {
        sections.push(("changes", "Every offset before and after", table.html()));
    }
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">\n\
         <link rel=\"icon\" href=\"data:,\"><title>{name}</title>\n<style>\n@font-face {{ font-family: \"DejaVu Sans\"; src: url(\"data:font/ttf;base64,{}\"); }}\n\
         {STYLE}</style></head><body>\n<header><h1>{name}</h1>\n\
         <p>L<sub>PP</sub> {:.3} m{} &nbsp; B {:.3} m{} &nbsp; {} &nbsp; D {:.3} m{} &nbsp; ρ {:.3} t/m³ ({}) &nbsp; moulded; x forward \
         from AP, z up from the base line</p>\n",
        STANDARD.encode(FONT),
        p.length_between_perpendiculars,
        assumed_mark(result.conventions.assumed.length),
        p.breadth,
        assumed_mark(result.conventions.assumed.breadth),
        p.draught.map_or("T not stated".to_owned(), |draught| format!("T {draught:.3} m")),
        p.depth,
        assumed_mark(result.conventions.assumed.depth),
        result.conventions.density,
        result.conventions.sources()
    );
    if p.draught.is_none() {
        html.push_str(&format!("<p>{NO_DESIGN_DRAUGHT}</p>\n"));
    }
    for (bad, line) in verdict(result, [before, design]) {
        html.push_str(&format!("<p{}>{}</p>\n", if bad { " class=\"bad\"" } else { "" }, lowered(&line)));
    }
    for note in &result.notes {
        html.push_str(&format!("<p class=\"bad\">{}</p>\n", lowered(note)));
    }
    let notes = result.fairing.iter().flat_map(|(_, fairing)| list(&fairing["notes"]).map(text));
    let assumed: Vec<String> = notes.filter(|note| !is_warning(note)).collect();
    if !assumed.is_empty() {
        html.push_str("<details><summary>What was found and assumed</summary>\n");
        assumed.iter().for_each(|note| html.push_str(&format!("<p>{}</p>\n", lowered(note))));
        html.push_str("</details>\n");
    }
    html.push_str("</header>\n<nav><a href=\"#viewer\">The hull in space</a>");
    let shown = || drawn.iter().filter(|figure| !figure.is_table());
    let links = shown().map(|figure| (figure.key.as_str(), figure.title.as_str()));
    for (id, title) in links.chain(sections.iter().map(|(id, title, _)| (*id, *title))) {
        html.push_str(&format!("<a href=\"#{id}\">{title}</a>"));
    }
    html.push_str("</nav>\n");
    html.push_str(&viewer(result));
    for figure in shown() {
        html.push_str(&format!(
            "<section id=\"{}\"><h2>{}</h2>\n<figure>\n{}<figcaption>{}</figcaption></figure></section>\n",
            figure.key,
            figure.title,
            inline(figure),
            lowered(figure.caption)
        ));
    }
    for (id, title, body) in &sections {
        html.push_str(&format!("<section id=\"{id}\"><h2>{title}</h2>\n{body}</section>\n"));
    }
    html.push_str(&format!("<p>loftsman {}</p>\n", env!("CARGO_PKG_VERSION")));
    html.push_str(&format!("<script type=\"application/json\" id=\"scene\">{}</script>\n", scene(result)));
    html.push_str(&format!("<script>\n{TABLES}</script>\n<script>\n{VIEWER}</script>\n</body></html>\n"));
    html
}
