//! Hydrostatic tables as CSV and JSON, with the ITTC codes of the one list of quantities as keys.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::hull_json::write_hull;
use super::number::{cell, json_number, line};
use crate::hull::{Hull, StationNumbers};
use crate::hydrostatics::{
    Assumed, CoefficientLength, Conventions, CurvesOfForm, Given, Hydrostatics, LcbReference, PrismaticSection,
    QUANTITIES, Shell,
};

/// Conventions as they stand in JSON files.
#[derive(Debug, Clone, Serialize, Deserialize, Default)]
#[serde(default)]
pub(super) struct ConventionsRecord {
    density: Option<f64>,
    coefficient_length: Option<LengthWord>,
    #[serde(rename = "section_for_Cp")]
    section_for_cp: Option<SectionWord>,
    lcb_reference: Option<LcbWord>,
    shell: Option<ShellRecord>,
    keel_thickness: Option<f64>,
    #[serde(rename = "KG")]
    kg: Option<f64>,
    /// Of older files: nobody stated the draught of the hull. Not written any more.
    #[serde(skip_serializing)]
    pub(super) design_draught_assumed: bool,
    /// Symbols of the other main dimensions that were assumed; written only where there are some.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    dimensions_assumed: Vec<String>,
    /// What was given of L_PP, B, T, LCB and density; written only where it is not the first three alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    given: Option<Vec<String>>,
    /// Whether the hull has no design draught; where a file says what was given.
    #[serde(skip)]
    pub(super) without_draught: bool,
    /// Written only where it is not 20.
    #[serde(skip_serializing_if = "Option::is_none")]
    station_spaces: Option<u32>,
    /// Written only where it is FP.
    #[serde(skip_serializing_if = "Option::is_none")]
    station_zero: Option<LcbWord>,
}

#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
enum LengthWord {
    Lpp,
    Lwl,
}

#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum SectionWord {
    Maximum,
    Midship,
}

#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
enum LcbWord {
    #[serde(rename = "AP")]
    AftPerpendicular,
    #[serde(rename = "midship")]
    Midship,
    #[serde(rename = "FP")]
    ForwardPerpendicular,
    #[serde(rename = "percent")]
    Percent,
}

#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum ShellRecord {
    Factor(f64),
    Thickness(f64),
}

fn given_words(given: Given) -> Vec<String> {
    let all = [
        ("L_PP", given.length),
        ("B", given.breadth),
        ("T", given.draught == Some(true)),
        ("LCB", given.lcb_reference),
        ("density", given.density),
    ];
    all.into_iter().filter(|(_, given)| *given).map(|(word, _)| word.to_owned()).collect()
}

fn given_of(words: &[String]) -> Given {
    let has = |word: &str| words.iter().any(|one| one == word);
    let draught = Some(has("T"));
    Given { length: has("L_PP"), breadth: has("B"), draught, lcb_reference: has("LCB"), density: has("density") }
}

impl From<&Conventions> for ConventionsRecord {
    fn from(c: &Conventions) -> Self {
        Self {
            density: Some(c.density),
            coefficient_length: Some(match c.coefficient_length {
                CoefficientLength::BetweenPerpendiculars => LengthWord::Lpp,
                CoefficientLength::Waterline => LengthWord::Lwl,
            }),
            section_for_cp: Some(match c.prismatic_section {
                PrismaticSection::Maximum => SectionWord::Maximum,
                PrismaticSection::Midship => SectionWord::Midship,
            }),
            lcb_reference: Some(match c.lcb_reference {
                LcbReference::AftPerpendicular => LcbWord::AftPerpendicular,
                LcbReference::Midship => LcbWord::Midship,
                LcbReference::ForwardPerpendicular => LcbWord::ForwardPerpendicular,
                LcbReference::Percent => LcbWord::Percent,
            }),
            shell: match c.shell {
                Shell::None => None,
                Shell::Factor(factor) => Some(ShellRecord::Factor(factor)),
                Shell::Thickness(thickness) => Some(ShellRecord::Thickness(thickness)),
            },
            keel_thickness: Some(c.keel_thickness),
            kg: c.centre_of_gravity_height,
            design_draught_assumed: false,
            dimensions_assumed: c.assumed.symbols().into_iter().map(str::to_owned).collect(),
            given: (c.given != Given::default()).then(|| given_words(c.given)),
            without_draught: false,
            station_spaces: Some(c.stations.spaces).filter(|&spaces| spaces != StationNumbers::default().spaces),
            station_zero: c.stations.from_forward.then_some(LcbWord::ForwardPerpendicular),
        }
    }
}

impl From<ConventionsRecord> for Conventions {
    fn from(record: ConventionsRecord) -> Self {
        let defaults = Self::default();
        let given = record.given.as_ref().map_or(Given::default(), |words| given_of(words));
        let draught = given.draught.filter(|_| !record.without_draught);
        let assumed = |symbol: &str| record.dimensions_assumed.iter().any(|one| one == symbol);
        Self {
            density: record.density.unwrap_or(defaults.density),
            coefficient_length: match record.coefficient_length {
                Some(LengthWord::Lwl) => CoefficientLength::Waterline,
                _ => CoefficientLength::BetweenPerpendiculars,
            },
            prismatic_section: match record.section_for_cp {
                Some(SectionWord::Midship) => PrismaticSection::Midship,
                _ => PrismaticSection::Maximum,
            },
            lcb_reference: match record.lcb_reference {
                None | Some(LcbWord::AftPerpendicular) => LcbReference::AftPerpendicular,
                Some(LcbWord::Midship) => LcbReference::Midship,
                Some(LcbWord::ForwardPerpendicular) => LcbReference::ForwardPerpendicular,
                Some(LcbWord::Percent) => LcbReference::Percent,
            },
            shell: match record.shell {
                None => Shell::None,
                Some(ShellRecord::Factor(factor)) => Shell::Factor(factor),
                Some(ShellRecord::Thickness(thickness)) => Shell::Thickness(thickness),
            },
            keel_thickness: record.keel_thickness.unwrap_or(defaults.keel_thickness),
            centre_of_gravity_height: record.kg,
            assumed: Assumed { length: assumed("L_PP"), breadth: assumed("B"), depth: assumed("D") },
            given: Given { draught, ..given },
            stations: StationNumbers {
                spaces: record.station_spaces.filter(|&n| n >= 1).unwrap_or(defaults.stations.spaces),
                from_forward: matches!(record.station_zero, Some(LcbWord::ForwardPerpendicular)),
            },
        }
    }
}

/// The conventions as a JSON object: density \[t/m^3\], coefficient_length, section_for_Cp, lcb_reference, shell,
/// keel_thickness \[m\], KG \[m\], and the reference points in words.
#[must_use]
pub fn conventions_json(conventions: &Conventions) -> Value {
    let mut value = serde_json::to_value(ConventionsRecord::from(conventions)).unwrap_or(Value::Null);
    if let Some(object) = value.as_object_mut() {
        object.insert("lengths".into(), json!("m"));
        object.insert("masses".into(), json!("t"));
        object.insert("origin".into(), json!("x from AP, + forward; z from the moulded base line, + up"));
        object.insert("XCBPC".into(), json!("% of Lpp from midship, + forward"));
    }
    value
}

/// One row as a JSON object; a quantity that is not defined is null. Of a body that is not symmetrical it has YCB \[m\]
/// and, where GM is known, HEEL \[deg\].
#[must_use]
pub fn row_json(row: &Hydrostatics) -> Value {
    let mut object: Map<String, Value> =
        QUANTITIES.iter().map(|quantity| (quantity.key.to_owned(), json_number((quantity.value)(row)))).collect();
    for (key, value) in [("YCB", row.transverse_centre), ("HEEL", row.heel)] {
        object.extend(value.map(|value| (key.to_owned(), json_number(Some(value)))));
    }
    if let Some(remark) = &row.remark {
        object.insert("remark".into(), json!(remark));
    }
    Value::Object(object)
}

/// `{"conventions": {...}, "warnings": [...], "rows": [{"T": ..., ...}, ...], "hull": {...}}`, the hull as in `hull.json`;
/// null for a body of triangles.
///
/// # Errors
/// A number that JSON cannot write; a [`Hull`] has none.
pub fn hydrostatics_json(
    hull: Option<&Hull>,
    table: &CurvesOfForm,
    warnings: &[String],
) -> Result<Value, serde_json::Error> {
    let written = hull.map(|hull| write_hull(hull, &table.conventions)).transpose()?;
    Ok(json!({
        "conventions": conventions_json(&table.conventions),
        "warnings": warnings,
        "rows": table.rows.iter().map(row_json).collect::<Vec<_>>(),
        "hull": written.map(|text| serde_json::from_str::<Value>(&text)).transpose()?,
    }))
}

/// A CSV table: the keys, the units, one row a draught, and a last column with remarks. Of a body whose sides differ, YCB
/// \[m\] and, where KG is known, its heel \[deg\] stand before the remarks.
#[must_use]
pub fn hydrostatics_csv(table: &CurvesOfForm) -> String {
    type Aside = (&'static str, &'static str, fn(&Hydrostatics) -> Option<f64>);
    let asides: [Aside; 2] = [("YCB", "m", |row| row.transverse_centre), ("HEEL", "deg", |row| row.heel)];
    let asides: Vec<Aside> =
        asides.into_iter().filter(|(.., of)| table.rows.iter().any(|row| of(row).is_some())).collect();
    let head =
        |of: fn(&crate::hydrostatics::Quantity) -> &'static str, aside: fn(&Aside) -> &'static str, last: &str| {
            let own = QUANTITIES.iter().map(of).chain(asides.iter().map(aside)).chain([last]);
            line(&own.map(str::to_owned).collect::<Vec<_>>())
        };
    let mut text = head(|q| q.key, |(key, ..)| key, "remark");
    text.push_str(&head(|q| q.unit, |(_, unit, _)| unit, ""));
    for row in &table.rows {
        let values = QUANTITIES.iter().map(|q| (q.value)(row)).chain(asides.iter().map(|(.., of)| of(row)));
        let mut fields: Vec<String> = values.map(cell).collect();
        fields.push(row.remark.clone().unwrap_or_default());
        text.push_str(&line(&fields));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conventions_survive_their_record() {
        let shells = [Shell::None, Shell::Factor(1.006), Shell::Thickness(0.01), Shell::None];
        for (shell, lcb_reference) in shells.into_iter().zip(LcbReference::ALL) {
            let conventions = Conventions {
                lcb_reference,
                density: 1.0,
                coefficient_length: CoefficientLength::Waterline,
                prismatic_section: PrismaticSection::Midship,
                shell,
                keel_thickness: 0.015,
                centre_of_gravity_height: Some(7.5),
                assumed: Assumed { breadth: lcb_reference == LcbReference::Percent, ..Assumed::default() },
                given: Given { density: lcb_reference == LcbReference::Percent, ..Given::default() },
                stations: StationNumbers {
                    spaces: if shell == Shell::None { 20 } else { 10 },
                    from_forward: lcb_reference == LcbReference::Midship,
                },
            };
            let text = serde_json::to_string(&ConventionsRecord::from(&conventions)).unwrap();
            let back: ConventionsRecord = serde_json::from_str(&text).unwrap();
            assert_eq!(Conventions::from(back), conventions);
            assert!(text.contains(&format!("\"lcb_reference\":\"{}\"", lcb_reference.as_str())), "{text}");
        }
        let empty: ConventionsRecord = serde_json::from_str("{}").unwrap();
        assert_eq!(Conventions::from(empty), Conventions::default());
    }

    #[test]
    fn undefined_quantities_are_empty_and_null() {
        let row = Hydrostatics { draught: 0.5, remark: Some("below, the keel".into()), ..Hydrostatics::default() };
        let table = CurvesOfForm { conventions: Conventions::default(), rows: vec![row] };
        let csv = hydrostatics_csv(&table);
        let lines: Vec<&str> = csv.lines().collect();
        assert!(lines[0].starts_with('T') && lines[1].starts_with('m') && lines[2].starts_with("0.5"));
        assert!(lines[2].ends_with("\"below, the keel\""));
    }
}
