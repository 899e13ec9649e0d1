//! IGES 5.3 (US PRO, 1996): the solid as a manifold B-rep, entity 186, its faces untrimmed B-spline surfaces, entities
//! 128.
//!
//! Records of 80 columns: text in the first 72, a letter and a number from 73 on.

mod entities;
mod faces;
mod geometry;
mod read;

pub(in super::super) use read::{is_iges, read_iges};

use self::entities::entities;
use super::{CadUnit, plain, real};
use crate::hull::{Region, Solid};

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
        Region::Deck | Region::Centreplane => 5,
    }
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
    let entities = entities(solid, unit.in_a_metre());
    let bodies: Vec<Vec<String>> = entities.iter().map(|entity| records(&entity.parameters, WIDTH)).collect();
    let mut first = 1;
    for (k, (entity, body)) in entities.iter().zip(&bodies).enumerate() {
        let status = if entity.dependent { "00010000" } else { "00000000" };
        put(
            &format!("{:>8}{first:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{status:>8}", entity.kind, 0, 1, 0, 0, 0, 0),
            'D',
            2 * k + 1,
        );
        let (form, colour, label) = (entity.form, entity.colour, &entity.label);
        put(
            &format!(
                "{:>8}{:>8}{colour:>8}{:>8}{form:>8}{:>8}{:>8}{label:>8}{:>8}",
                entity.kind,
                0,
                body.len(),
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
