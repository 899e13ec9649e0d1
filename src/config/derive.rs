//! The job file of `derive`: the parent, and what the daughter is to have.
//!
//! ```toml
//! [derive]
//! parent = "hull.json"      # beside the job file
//! Lpp = 91
//! Cb = 0.72
//! LCB = "+0.8 %"
//! ```

use super::design_targets::position_along;
use super::diagnostic::Diagnostic;
use super::document::{Document, Raw};
use super::keys::{Key, Kind, key};
use crate::units::{Dimension, parse_length};

/// Words for `derive.method`.
const METHODS: [&str; 4] = ["affine", "one-minus-prismatic", "lackenby", "nearest"];
/// Words for `derive.free`.
const FREE: [&str; 4] = ["none", "displacement", "lcb", "cm"];

const fn of(name: &'static str, kind: Kind, description: &'static str) -> Key {
    key("derive", name, kind, &[], description)
}

/// Every key of the job file of `derive`.
pub const DERIVE_KEYS: &[Key] = &[
    key("", "schema", Kind::Integer(1, 1), &[], "Version of the keys: 1."),
    of(
        "parent",
        Kind::Text,
        "The parent, relative to this file: hull, folder of a result, design, table, mesh or CAD file.",
    ),
    of("parent_draught", Kind::Length, "Design draught of the parent. Default: its own."),
    of("method", Kind::Word(&METHODS), "How targets are met. Default: \"nearest\"."),
    of("Lpp", Kind::Length, "L_PP. Default: of the parent."),
    of("B", Kind::Length, "B moulded. Default: of the parent."),
    of("T", Kind::Length, "Design draught. Default: of the parent."),
    of("D", Kind::Length, "Depth to the deck at side. Default: of the parent."),
    of("displacement", Kind::Displacement, "Displacement, moulded: mass or volume."),
    of("Cb", Kind::Number, "Block coefficient, instead of the displacement. Default: of the parent."),
    of("Cp", Kind::Number, "Prismatic coefficient."),
    of("Cm", Kind::Number, "Midship section coefficient. Default: of the parent."),
    of(
        "bilge_radius",
        Kind::Length,
        "Bilge radius r instead of Cm: that of a midship section with level bottom and plumb sides, C_M = 1 - (2 - pi/2) r^2/(B T).",
    ),
    of("Cwp", Kind::Number, "Waterplane coefficient. Default: free."),
    of("LCB", Kind::CentreOfBuoyancy, "Longitudinal centre of buoyancy. Default: of the parent, in parts of Lpp."),
    of("LCF", Kind::CentreOfBuoyancy, "Longitudinal centre of flotation. Default: free."),
    of("KB", Kind::Length, "Height of the centre of buoyancy above the base line. Default: free."),
    of("KM", Kind::Length, "Height of the transverse metacentre above the base line. Default: free."),
    of(
        "GM",
        Kind::Length,
        "Transverse metacentric height, with KG: KM = KG + GM, without free surfaces. Default: free.",
    ),
    of("KG", Kind::Length, "Height of the centre of gravity above the base line, of GM."),
    of("wetted_surface", Kind::Area, "Wetted surface. Default: free."),
    of("entrance", Kind::Angle, "Half angle of entrance of the design waterline. Default: free."),
    of("run", Kind::Angle, "Half angle of run of the design waterline. Default: free."),
    of(
        "section_areas",
        Kind::SectionAreas,
        "Areas of sections below the design draught, both sides: [[x, area]], or a CSV of x and area (a path from this file). Volume, \
         LCB and C_M are then free.",
    ),
    of(
        "parallel_body",
        Kind::Positions,
        "Aft and fore end of the parallel body, of the methods nearest and lackenby. Default: of the parent.",
    ),
    of(
        "move_height",
        Kind::Phrases("\"3.2 m : 3.6 m\""),
        "What lies at the first height of the scaled parent, as a level knuckle or an edge of a flat, comes to the second. Default: none.",
    ),
    of(
        "move_position",
        Kind::Phrases("\"-2 m : -2.5 m\""),
        "The same along the ship, forward of AP, as of a transom or the end of a knuckle. Default: none.",
    ),
    of(
        "wave_resistance",
        Kind::Positions,
        "Froude numbers at which the wave resistance is made small, as \"0.25:0.30:0.01\". Default: none.",
    ),
    of("wave_weight", Kind::Number, "Weight of the wave resistance, m^2. Default: the knee of seven weights."),
    of("within", Kind::Length, "How far half-breadths move at most for the wave resistance. Default: no limit."),
    of("free", Kind::Word(&FREE), "What is not kept although nothing states it. Default: \"none\"."),
];

/// What a job file of `derive` or an option of the command states.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DeriveFile {
    /// The parent, relative to the file.
    pub parent: Option<String>,
    /// Draught of the parent \[m\].
    pub parent_draught: Option<f64>,
    /// The word of the method.
    pub method: Option<&'static str>,
    /// L_PP, B, T and D \[m\].
    pub dimensions: [Option<f64>; 4],
    /// Displacement mass \[t\].
    pub mass: Option<f64>,
    /// Displacement volume \[m^3\].
    pub volume: Option<f64>,
    /// C_B, C_P, C_M and C_WP \[-\].
    pub coefficients: [Option<f64>; 4],
    /// Bilge radius \[m\], instead of C_M.
    pub bilge_radius: Option<f64>,
    /// LCB and LCF: x = share L_PP + shift \[m\].
    pub centres: [Option<[f64; 2]>; 2],
    /// KB and KM \[m\].
    pub heights: [Option<f64>; 2],
    /// GM and KG \[m\].
    pub stability: [Option<f64>; 2],
    /// Wetted surface \[m^2\].
    pub wetted_surface: Option<f64>,
    /// Half angles of entrance and run \[deg\].
    pub angles: [Option<f64>; 2],
    /// Positions \[m\] and areas of sections \[m^2\].
    pub section_areas: Vec<[f64; 2]>,
    /// The file that has them.
    pub area_file: Option<String>,
    /// Aft and fore end of the parallel body \[m\].
    pub parallel_body: Option<[f64; 2]>,
    /// Heights that lines come from and to \[m\].
    pub moved_heights: Vec<[f64; 2]>,
    /// The same of positions forward of AP.
    pub moved_positions: Vec<[f64; 2]>,
    /// Froude numbers at which the wave resistance is made small.
    pub froude_numbers: Option<Vec<f64>>,
    /// Weight of the wave resistance [m^2].
    pub wave_weight: Option<f64>,
    /// How far half-breadths move at most for it \[m\].
    pub within: Option<f64>,
    /// What is not kept.
    pub free: Vec<&'static str>,
}

impl DeriveFile {
    /// These values, and those of `other` where there is none.
    #[must_use]
    pub fn over(self, other: Self) -> Self {
        // Mass, volume and C_B are one target.
        let stated = self.mass.is_some() || self.volume.is_some() || self.coefficients[0].is_some();
        let (mass, volume, block) = if stated {
            (self.mass, self.volume, self.coefficients[0])
        } else {
            (other.mass, other.volume, other.coefficients[0])
        };
        // KM and GM are one target, and so are areas and the file of them.
        let own_height = self.heights[1].is_some() || self.stability[0].is_some();
        let of_height = if own_height { &self } else { &other };
        let (height, metacentric) = (of_height.heights[1], of_height.stability[0]);
        // C_M and the bilge radius are one target.
        let own_midship = self.coefficients[2].is_some() || self.bilge_radius.is_some();
        let of_midship = if own_midship { &self } else { &other };
        let (midship, bilge_radius) = (of_midship.coefficients[2], of_midship.bilge_radius);
        let own_areas = self.area_file.is_some() || !self.section_areas.is_empty();
        let (section_areas, area_file) =
            if own_areas { (self.section_areas, self.area_file) } else { (other.section_areas, other.area_file) };
        let each = |k: usize| self.coefficients[k].or(other.coefficients[k]);
        Self {
            parent: self.parent.or(other.parent),
            parent_draught: self.parent_draught.or(other.parent_draught),
            method: self.method.or(other.method),
            dimensions: [0, 1, 2, 3].map(|k| self.dimensions[k].or(other.dimensions[k])),
            mass,
            volume,
            coefficients: [block, each(1), midship, each(3)],
            bilge_radius,
            centres: [0, 1].map(|k| self.centres[k].or(other.centres[k])),
            heights: [self.heights[0].or(other.heights[0]), height],
            stability: [metacentric, self.stability[1].or(other.stability[1])],
            wetted_surface: self.wetted_surface.or(other.wetted_surface),
            angles: [0, 1].map(|k| self.angles[k].or(other.angles[k])),
            section_areas,
            area_file,
            parallel_body: self.parallel_body.or(other.parallel_body),
            moved_heights: if self.moved_heights.is_empty() { other.moved_heights } else { self.moved_heights },
            moved_positions: if self.moved_positions.is_empty() { other.moved_positions } else { self.moved_positions },
            froude_numbers: self.froude_numbers.or(other.froude_numbers),
            wave_weight: self.wave_weight.or(other.wave_weight),
            within: self.within.or(other.within),
            free: if self.free.is_empty() { other.free } else { self.free },
        }
    }
}

/// Reads a job file of `derive`. `file` is its name for messages.
///
/// # Errors
/// Every problem of the file at once.
pub fn read_derive(file: &str, text: &str) -> Result<DeriveFile, Vec<Diagnostic>> {
    let mut document = Document::with_keys(file, text, DERIVE_KEYS, "a job of derive");
    if !document.problems.iter().any(|p| p.code == "E120") {
        let job = interpret(&mut document);
        if document.problems.is_empty() {
            return Ok(job);
        }
    }
    Err(document.finish())
}

/// What an option of the command states, in the words of the job file.
///
/// # Errors
/// Every problem of the value; the option stands for the file in the messages.
pub fn read_derive_option(option: &str, key: &str, value: &str) -> Result<DeriveFile, Vec<Diagnostic>> {
    let kind = DERIVE_KEYS.iter().find(|k| k.name == key).map(|k| k.kind);
    let bare = matches!(kind, Some(Kind::Area | Kind::Number)) && value.trim().parse::<f64>().is_ok();
    let quoted = serde_json::Value::String(value.to_owned()).to_string();
    let value = if bare { value.trim().to_owned() } else { quoted };
    read_derive(option, &format!("derive.{key} = {value}")).map_err(|problems| {
        problems.into_iter().map(|problem| Diagnostic { line: None, column: None, ..problem }).collect()
    })
}

/// A number more than 0.
fn positive(document: &mut Document<'_>, path: &str, what: &str) -> Option<f64> {
    let value = document.number(path)?;
    if value > 0.0 {
        return Some(value);
    }
    let span = document.entry(path).map_or(0..0, |e| e.span.clone());
    document.problem("E124", path, &span, format!("{path} is {value}"), format!("Expected a positive {what}."));
    None
}

/// A coefficient of form.
fn coefficient(document: &mut Document<'_>, path: &str) -> Option<f64> {
    let value = document.number(path)?;
    let strictly = path != "derive.Cb" && path != "derive.Cp";
    if value > 0.0 && (value < 1.0 || (strictly && value <= 1.0)) {
        return Some(value);
    }
    let span = document.entry(path).map_or(0..0, |e| e.span.clone());
    let help = "Expected a coefficient of form: more than 0 and less than 1, as 0.72.".to_owned();
    document.problem("E124", path, &span, format!("{path} is {value}"), help);
    None
}

fn centre(document: &mut Document<'_>, path: &str) -> Option<[f64; 2]> {
    let (raw, span, kind) = document.raw(path)?;
    match &raw {
        Raw::Text(text) => position_along(document, path, text, &span, kind),
        Raw::Number(_) => {
            let help = "Write \"+0.8 %\" (of Lpp from midship, + forward) or \"41.0 m AP\".".to_owned();
            document.problem(
                "E123",
                path,
                &span,
                format!("{path} is {}, and its unit is missing", raw.describe()),
                help,
            );
            None
        }
        _ => {
            document.unexpected(path, &raw, &span, kind);
            None
        }
    }
}

/// A half angle of the waterline \[deg\].
fn half_angle(document: &mut Document<'_>, path: &str) -> Option<f64> {
    let value = document.number(path)?.to_degrees();
    if (0.1..=85.0).contains(&value) {
        return Some(value);
    }
    let span = document.entry(path).map_or(0..0, |e| e.span.clone());
    let message = format!("{path} is {value} deg");
    document.problem("E124", path, &span, message, "Expected a half angle of 0.1 to 85 deg.".to_owned());
    None
}

/// Positions and areas, or the name of the file that has them.
fn section_areas(document: &mut Document<'_>) -> (Vec<[f64; 2]>, Option<String>) {
    let path = "derive.section_areas";
    let Some((raw, span, kind)) = document.raw(path) else { return (Vec::new(), None) };
    let number = |(raw, _): &(Raw, _)| match raw {
        Raw::Number(value) if value.is_finite() => Some(*value),
        _ => None,
    };
    let pair = |(item, _): &(Raw, _)| match item {
        Raw::Array(numbers) => match numbers.iter().map(number).collect::<Option<Vec<f64>>>()?[..] {
            [x, area] => Some([x, area]),
            _ => None,
        },
        _ => None,
    };
    match &raw {
        Raw::Text(file) if !file.trim().is_empty() => return (Vec::new(), Some(file.trim().to_owned())),
        Raw::Array(items) => {
            if let Some(list) = items.iter().map(pair).collect::<Option<Vec<_>>>() {
                return (list, None);
            }
            let message = format!("{path} has an item that is no pair of finite numbers");
            document.problem("E122", path, &span, message, "Expected [[x, area], ...], m and m2.".to_owned());
        }
        _ => document.unexpected(path, &raw, &span, kind),
    }
    (Vec::new(), None)
}

/// The bilge radius, which stands in the place of C_M.
fn bilge_radius(document: &mut Document<'_>) -> Option<f64> {
    let found = positive(document, "derive.bilge_radius", "length");
    if let (Some(_), Some(entry)) = (found, document.entry("derive.Cm")) {
        let span = entry.key_span.clone();
        let message = "derive.bilge_radius and derive.Cm are one target".to_owned();
        document.problem("E126", "derive.bilge_radius", &span, message, "Leave one of them out.".to_owned());
    }
    found
}

/// GM and KG, which state KM together.
fn stability(document: &mut Document<'_>) -> [Option<f64>; 2] {
    let found = ["derive.GM", "derive.KG"].map(|path| positive(document, path, "length"));
    if let (Some(_), Some(entry)) = (found[0], document.entry("derive.KM")) {
        let span = entry.key_span.clone();
        let message = "derive.GM and derive.KM are one target".to_owned();
        document.problem("E126", "derive.GM", &span, message, "Leave one of them out.".to_owned());
    }
    found
}

fn parallel_body(document: &mut Document<'_>) -> Option<[f64; 2]> {
    let path = "derive.parallel_body";
    let list = document.positions(path)?;
    if let [aft, fore] = list[..]
        && aft < fore
    {
        return Some([aft, fore]);
    }
    let span = document.entry(path).map_or(0..0, |e| e.span.clone());
    let message = format!("{path} has {} positions", list.len());
    document.problem(
        "E124",
        path,
        &span,
        message,
        "Expected its aft and its fore end, rising, as [40, 55].".to_owned(),
    );
    None
}

/// Lengths from and to.
fn moves(document: &mut Document<'_>, path: &str) -> Vec<[f64; 2]> {
    let Some((raw, span, kind)) = document.raw(path) else { return Vec::new() };
    let items = match raw {
        Raw::Array(items) => items,
        single => vec![(single, span)],
    };
    let mut found = Vec::new();
    for (item, at) in items {
        let Raw::Text(text) = &item else {
            document.unexpected(path, &item, &at, kind);
            continue;
        };
        let pair = text.split_once(':').map(|(from, to)| [from, to].map(|part| parse_length(part.trim()).ok()));
        if let Some([Some(from), Some(to)]) = pair {
            found.push([from, to]);
        } else {
            let message = format!("{path} is {text:?}, and not two lengths");
            document.problem("E122", path, &at, message, "Expected from and to, as \"3.2 m : 3.6 m\".".to_owned());
        }
    }
    found
}

fn interpret(document: &mut Document<'_>) -> DeriveFile {
    document.integer("schema");
    let displacement = document.dimensioned("derive.displacement");
    if let Some(measure) = displacement.filter(|measure| measure.value <= 0.0) {
        let path = "derive.displacement";
        let span = document.entry(path).map_or(0..0, |e| e.span.clone());
        let message = format!("{path} is {}", measure.value);
        document.problem("E124", path, &span, message, "Expected a positive mass or volume.".to_owned());
    }
    let displacement = displacement.filter(|measure| measure.value > 0.0);
    let of_volume = |volume: bool| {
        displacement.filter(|m| (m.dimension == Dimension::Volume) == volume).map(|measure| measure.value)
    };
    let (mass, volume) = (of_volume(false), of_volume(true));
    if let (Some(_), Some(entry)) = (displacement, document.entry("derive.Cb")) {
        let span = entry.key_span.clone();
        let message = "derive.Cb and derive.displacement are one target".to_owned();
        document.problem("E126", "derive.Cb", &span, message, "Leave one of them out.".to_owned());
    }
    let (section_areas, area_file) = section_areas(document);
    let free = document.word("derive.free").filter(|word| *word != "none");
    DeriveFile {
        parent: document.text("derive.parent"),
        parent_draught: positive(document, "derive.parent_draught", "length"),
        method: document.word("derive.method"),
        dimensions: ["derive.Lpp", "derive.B", "derive.T", "derive.D"].map(|path| positive(document, path, "length")),
        mass,
        volume,
        coefficients: ["derive.Cb", "derive.Cp", "derive.Cm", "derive.Cwp"].map(|path| coefficient(document, path)),
        bilge_radius: bilge_radius(document),
        centres: ["derive.LCB", "derive.LCF"].map(|path| centre(document, path)),
        heights: ["derive.KB", "derive.KM"].map(|path| positive(document, path, "length")),
        stability: stability(document),
        wetted_surface: positive(document, "derive.wetted_surface", "area"),
        angles: ["derive.entrance", "derive.run"].map(|path| half_angle(document, path)),
        section_areas,
        area_file,
        parallel_body: parallel_body(document),
        moved_heights: moves(document, "derive.move_height"),
        moved_positions: moves(document, "derive.move_position"),
        froude_numbers: document.froude_numbers("derive.wave_resistance"),
        wave_weight: positive(document, "derive.wave_weight", "weight"),
        within: positive(document, "derive.within", "length"),
        free: free.into_iter().collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_and_options_have_the_same_keys() {
        let file = read_derive("j.toml", "[derive]\nparent = \"a.json\"\nLpp = \"91 m\"\nCb = 0.72\nLCB = \"+0.8 %\"")
            .unwrap();
        assert_eq!(
            (file.parent.as_deref(), file.dimensions[0], file.coefficients[0]),
            (Some("a.json"), Some(91.0), Some(0.72))
        );
        let option = read_derive_option("--displacement", "displacement", "4000 m3").unwrap();
        let both = option.over(file);
        assert_eq!((both.volume, both.coefficients[0], both.dimensions[0]), (Some(4000.0), None, Some(91.0)));
        assert!((both.centres[0].unwrap()[0] - 0.508).abs() < 1e-12);
        assert_eq!(
            read_derive_option("--wetted-surface", "wetted_surface", "1200").unwrap().wetted_surface,
            Some(1200.0)
        );
        assert_eq!(
            read_derive_option("--parallel-body", "parallel_body", "40,55").unwrap().parallel_body,
            Some([40.0, 55.0])
        );
    }

    #[test]
    fn what_no_ship_has_names_its_option() {
        for (option, key, value, code) in [
            ("--cb", "Cb", "1.2", "E124 --cb"),
            ("--cm", "Cm", "-0.2", "E124 --cm"),
            ("--lcb", "LCB", "3", "--lcb"),
            ("--lpp", "Lpp", "0", "E124 --lpp"),
            ("--method", "method", "lackenbi", "Did you mean \"lackenby\"?"),
            ("--displacement", "displacement", "-4", "E124 --displacement"),
            ("--entrance", "entrance", "95", "E124 --entrance"),
            ("--gm", "GM", "-1", "E124 --gm"),
        ] {
            let found = read_derive_option(option, key, value).unwrap_err()[0].to_string();
            assert!(found.contains(code), "{found}");
        }
        let areas =
            read_derive("j.toml", "[derive]\nsection_areas = [[40, 12.5], [50, 13]]\nrun = \"12 deg\"").unwrap();
        assert_eq!(areas.section_areas, [[40.0, 12.5], [50.0, 13.0]]);
        assert!((areas.angles[1].unwrap() - 12.0).abs() < 1e-12);
        let found = read_derive("j.toml", "[derive]\nGM = 1\nKM = 8\nsection_areas = [[40]]").unwrap_err();
        let codes: Vec<&str> = found.iter().map(|problem| problem.code).collect();
        assert_eq!(codes, ["E126", "E122"]);
        let found = read_derive("j.toml", "[derive]\nCb = 0.7\ndisplacement = 4000\nLbp = 3").unwrap_err();
        let codes: Vec<&str> = found.iter().map(|problem| problem.code).collect();
        assert_eq!(codes, ["E126", "E121"]);
    }
}
