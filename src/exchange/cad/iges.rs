//! IGES 5.3 (US PRO, 1996): each face of the solid as a B-spline surface, entity 128, untrimmed.
//!
//! Records of 80 columns: text in the first 72, a letter and a number from 73 on. Points run with u fastest.

mod read;

pub(in super::super) use read::{is_iges, read_iges};

use super::{CadUnit, plain, real};
use crate::hull::{Region, Solid, SolidFace};

/// Text of a parameter record.
const WIDTH: usize = 64;

/// A string with its length, as IGES counts it.
fn hollerith(text: &str) -> String {
    format!("{}H{text}", text.len())
}

/// Numbers of the colours of the standard: 2 red, 4 blue, 5 yellow, 7 cyan, 8 white.
const fn colour(region: Region) -> usize {
    match region {
        Region::Hull => 4,
        Region::Bottom => 2,
        Region::Transom | Region::Bow => 7,
        Region::Deck => 5,
    }
}

/// Entity 128 with its parameters.
fn parameters(face: &SolidFace, scale: f64) -> Vec<String> {
    let surface = &face.surface;
    let [rows, columns] = surface.shape();
    let (u, v) = (surface.u(), surface.v());
    let mut list: Vec<String> =
        [128, rows - 1, columns - 1, u.degree(), v.degree(), 0, 0, 1, 0, 0].iter().map(ToString::to_string).collect();
    list.extend(u.knots().iter().chain(v.knots()).map(|&knot| real(knot)));
    list.extend(std::iter::repeat_n("1.".to_owned(), rows * columns));
    for j in 0..columns {
        for i in 0..rows {
            list.extend(surface.point(i, j).map(|coordinate| real(coordinate * scale)));
        }
    }
    let ((a, b), (c, d)) = (u.domain(), v.domain());
    list.extend([a, b, c, d].map(real));
    list
}

/// Fields with commas between them and `;` at the end, broken between fields into records of `width` columns.
fn records(fields: &[String], width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for (k, field) in fields.iter().enumerate() {
        let text = format!("{field}{}", if k + 1 == fields.len() { ";" } else { "," });
        let last = lines.len() - 1;
        if lines[last].len() + text.len() > width && !lines[last].is_empty() {
            lines.push(text);
        } else {
            lines[last].push_str(&text);
        }
    }
    lines
}

/// Text of an IGES file of the faces of the solid.
#[must_use]
pub fn write_iges(solid: &Solid, name: &str, unit: CadUnit) -> String {
    let name: String = plain(name).chars().take(60).collect();
    let name = if name.trim().is_empty() { "hull".to_owned() } else { name };
    let (flag, word) = match unit {
        CadUnit::Metre => ("6", "M"),
        CadUnit::Millimetre => ("2", "MM"),
    };
    let largest = solid.vertices.iter().flatten().map(|c| c.abs()).fold(1.0, f64::max) * unit.in_a_metre();
    let epoch = hollerith("19700101.000000");
    let version = hollerith(concat!("loftsman ", env!("CARGO_PKG_VERSION")));
    let global: Vec<String> = [
        "1H,".to_owned(),
        "1H;".to_owned(),
        hollerith(&name),
        hollerith("hull.igs"),
        version.clone(),
        version,
        "32".to_owned(),
        "308".to_owned(),
        "15".to_owned(),
        "308".to_owned(),
        "15".to_owned(),
        hollerith(&name),
        "1.".to_owned(),
        flag.to_owned(),
        hollerith(word),
        "1".to_owned(),
        "0.".to_owned(),
        epoch.clone(),
        real(1e-9 * unit.in_a_metre()),
        real(largest),
        String::new(),
        String::new(),
        "11".to_owned(),
        "0".to_owned(),
        epoch,
    ]
    .to_vec();
    let mut text = String::new();
    let mut put = |body: &str, letter: char, number: usize| {
        text.push_str(&format!("{body:<72}{letter}{number:>7}\n"));
    };
    put("Hull as B-spline surfaces; x forward, y to port, z up", 'S', 1);
    let global = records(&global, 72);
    for (k, line) in global.iter().enumerate() {
        put(line, 'G', k + 1);
    }
    let bodies: Vec<Vec<String>> =
        solid.faces.iter().map(|face| records(&parameters(face, unit.in_a_metre()), WIDTH)).collect();
    let mut first = 1;
    for (k, (face, body)) in solid.faces.iter().zip(&bodies).enumerate() {
        let label: String = face.name.replace("hull ", "").chars().take(8).collect::<String>().to_uppercase();
        put(
            &format!("{:>8}{first:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}", 128, 0, 1, 0, 0, 0, 0, "00000000"),
            'D',
            2 * k + 1,
        );
        put(
            &format!(
                "{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{label:>8}{:>8}",
                128,
                0,
                colour(face.region),
                body.len(),
                0,
                "",
                "",
                0
            ),
            'D',
            2 * k + 2,
        );
        first += body.len();
    }
    let mut number = 0;
    for (k, body) in bodies.iter().enumerate() {
        for line in body {
            number += 1;
            put(&format!("{line:<WIDTH$}{:>8}", 2 * k + 1), 'P', number);
        }
    }
    put(&format!("S{:>7}G{:>7}D{:>7}P{number:>7}", 1, global.len(), 2 * bodies.len()), 'T', 1);
    text
}
