//! A prediction of resistance as CSV and JSON.

use serde_json::{Value, json};

use super::number::{cell, json_number, line};
use crate::resistance::{Method, PredictionInput, PredictionRow, power};
use crate::units::KNOT;

/// What the files of a prediction hold.
#[derive(Debug, Clone, Copy)]
pub struct ResistanceFile<'a> {
    /// Name of the hull.
    pub name: &'a str,
    /// The method.
    pub method: Method,
    /// Its limits, as a page states them.
    pub limits: &'a str,
    /// The inputs.
    pub inputs: &'a [PredictionInput],
    /// A row a speed.
    pub rows: &'a [PredictionRow],
    /// Propulsive efficiency, where it was given.
    pub efficiency: Option<f64>,
    /// Warnings.
    pub warnings: &'a [String],
}

type Column = (&'static str, &'static str, fn(&PredictionRow) -> f64);

/// Keys, units and values of the columns; keys are ITTC computer symbols where there is one.
const COLUMNS: [Column; 14] = [
    ("VKN", "kn", |row| row.components.speed / KNOT),
    ("V", "m/s", |row| row.components.speed),
    ("FN", "-", |row| row.components.froude),
    ("RN", "-", |row| row.components.reynolds),
    ("CF", "-", |row| row.components.friction_coefficient),
    ("FORMF", "-", |row| row.components.form_factor),
    ("RF", "N", |row| row.components.friction),
    ("RAPP", "N", |row| row.components.appendages),
    ("RW", "N", |row| row.components.wave),
    ("RB", "N", |row| row.components.bulb),
    ("RTR", "N", |row| row.components.transom),
    ("RA", "N", |row| row.components.allowance),
    ("RT", "N", |row| row.components.total()),
    ("PE", "W", |row| row.components.effective_power()),
];

impl ResistanceFile<'_> {
    fn delivered(&self, row: &PredictionRow) -> Option<f64> {
        self.efficiency.map(|efficiency| power(row.components.effective_power(), efficiency))
    }

    fn row_json(&self, row: &PredictionRow) -> Value {
        let values = COLUMNS.iter().map(|(key, _, of)| ((*key).to_owned(), json_number(Some(of(row)))));
        let mut object: serde_json::Map<String, Value> = values.collect();
        object.insert("PD".to_owned(), json_number(self.delivered(row)));
        let outside = row.outside.iter().map(|range| {
            let [low, high] = range.limits.map(|limit| json_number(Some(limit).filter(|v| v.is_finite())));
            json!({ "symbol": range.symbol, "value": range.value, "from": low, "to": high })
        });
        object.insert("outside".to_owned(), outside.collect());
        Value::Object(object)
    }
}

/// `{"hull", "method", "source", "limits", "units", "inputs": [...], "warnings": [...], "rows": [...]}`. A figure outside the
/// range of the data names it in `outside`.
#[must_use]
pub fn resistance_json(file: &ResistanceFile<'_>) -> Value {
    let input = |input: &PredictionInput| {
        json!({
            "symbol": input.symbol,
            "name": input.name,
            "value": json_number(Some(input.value)),
            "unit": input.unit,
            "origin": input.origin.as_str(),
            "note": input.note,
        })
    };
    let units = COLUMNS.iter().map(|(key, unit, _)| ((*key).to_owned(), json!(unit)));
    json!({
        "hull": file.name,
        "method": file.method.as_str(),
        "source": file.method.source(),
        "limits": file.limits,
        "units": units.chain([("PD".to_owned(), json!("W"))]).collect::<serde_json::Map<String, Value>>(),
        "inputs": file.inputs.iter().map(input).collect::<Vec<_>>(),
        "warnings": file.warnings,
        "rows": file.rows.iter().map(|row| file.row_json(row)).collect::<Vec<_>>(),
    })
}

/// A CSV table: the keys, the units, one row a speed, and a last column with the ranges that are left.
#[must_use]
pub fn resistance_csv(file: &ResistanceFile<'_>) -> String {
    let head = |of: fn(&Column) -> &'static str, last: [&str; 2]| {
        let fields = COLUMNS.iter().map(|column| of(column).to_owned());
        line(&fields.chain(last.map(str::to_owned)).collect::<Vec<_>>())
    };
    let mut text = head(|column| column.0, ["PD", "outside"]) + &head(|column| column.1, ["W", ""]);
    for row in file.rows {
        let mut fields: Vec<String> = COLUMNS.iter().map(|(_, _, of)| cell(Some(of(row)))).collect();
        fields.push(cell(file.delivered(row)));
        fields.push(row.outside.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "));
        text.push_str(&line(&fields));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::resistance::{Components, InputOrigin, Range};

    #[test]
    fn figures_outside_the_data_say_so_in_both_files() {
        let components = Components { speed: 10.0 * KNOT, wave: 1000.0, ..Components::default() };
        let outside = vec![Range { symbol: "L/B", value: 3.0, limits: [5.0, f64::INFINITY] }];
        let input = PredictionInput {
            symbol: "L",
            name: "length",
            value: 100.0,
            unit: "m",
            decimals: 3,
            origin: InputOrigin::Given,
            note: "",
        };
        let file = ResistanceFile {
            name: "ship",
            method: Method::Michell,
            limits: "few",
            inputs: &[input],
            rows: &[PredictionRow { components, outside }],
            efficiency: Some(0.5),
            warnings: &[],
        };
        let csv = resistance_csv(&file);
        let lines: Vec<&str> = csv.lines().collect();
        assert!(lines.len() == 3 && lines[1].starts_with("kn,m/s,-"), "{csv}");
        assert!(lines[2].starts_with("10,") && lines[2].ends_with("L/B 3.000, data 5 or more\""), "{csv}");
        let json = resistance_json(&file);
        assert_eq!(json["rows"][0]["outside"][0]["to"], Value::Null);
        assert_eq!(json["rows"][0]["PD"], json!(2.0 * 1000.0 * 10.0 * KNOT));
        assert_eq!(json["inputs"][0]["origin"], "given");
    }
}
