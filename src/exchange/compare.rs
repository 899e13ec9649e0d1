//! A comparison of two hulls as CSV and JSON.

use serde_json::{Value, json};

use super::number::{cell, json_number, line};
use crate::hull::SurfaceDistance;
use crate::hydrostatics::{Hydrostatics, QUANTITIES};

/// A particular of two hulls.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparedValue {
    /// Key: that of a quantity, or `LPP`, `B`, `D`.
    pub key: &'static str,
    /// Name in full.
    pub name: &'static str,
    /// Unit, `-` for none.
    pub unit: &'static str,
    /// Decimals in print.
    pub decimals: usize,
    /// The values of the first and of the second hull.
    pub values: [Option<f64>; 2],
    /// Second less first: in per cent of the first; of a centre in per cent of L_PP.
    pub change: Option<f64>,
}

/// What the files of a comparison hold.
#[derive(Debug, Clone, Copy)]
pub struct CompareFile<'a> {
    /// Names of the hulls.
    pub names: [&'a str; 2],
    /// Particulars and coefficients.
    pub values: &'a [ComparedValue],
    /// Hydrostatics of both at common draughts.
    pub rows: &'a [[Hydrostatics; 2]],
    /// How far the second hull is from the first, and the first from the second.
    pub distances: [Option<SurfaceDistance>; 2],
    /// Warnings.
    pub warnings: &'a [String],
}

/// Second less first, in per cent of the first; none where the first is nothing.
#[must_use]
pub fn per_cent([first, second]: [Option<f64>; 2]) -> Option<f64> {
    let change = 100.0 * (second? - first?) / first?.abs();
    change.is_finite().then_some(change)
}

fn distance_json(distance: &Option<SurfaceDistance>) -> Value {
    distance.map_or(
        Value::Null,
        |d| json!({ "largest": d.largest, "at": d.at, "outside": d.outside, "rms": d.rms, "mean": d.mean }),
    )
}

/// `{"hulls", "values": [{"key", "name", "unit", "first", "second", "change"}], "distances", "hydrostatics", "warnings"}`.
/// Changes are per cent, those of longitudinal centres per cent of L_PP; distances are metres.
#[must_use]
pub fn compare_json(file: &CompareFile<'_>) -> Value {
    let value = |v: &ComparedValue| {
        json!({
            "key": v.key,
            "name": v.name,
            "unit": v.unit,
            "first": json_number(v.values[0]),
            "second": json_number(v.values[1]),
            "change": json_number(v.change),
        })
    };
    let row = |[a, b]: &[Hydrostatics; 2]| {
        let all = QUANTITIES.iter().map(|quantity| {
            let values = [(quantity.value)(a), (quantity.value)(b)];
            let [first, second, change] = [values[0], values[1], per_cent(values)].map(json_number);
            (quantity.key.to_owned(), json!({ "first": first, "second": second, "change": change }))
        });
        Value::Object(all.collect())
    };
    json!({
        "hulls": file.names,
        "values": file.values.iter().map(value).collect::<Vec<_>>(),
        "distances": { "second_from_first": distance_json(&file.distances[0]), "first_from_second": distance_json(&file.distances[1]) },
        "hydrostatics": file.rows.iter().map(row).collect::<Vec<_>>(),
        "warnings": file.warnings,
    })
}

/// A CSV table: a row a draught and a quantity with both values and the change in per cent of the first.
#[must_use]
pub fn compare_csv(file: &CompareFile<'_>) -> String {
    let head = ["T", "quantity", "unit", "first", "second", "change_percent"].map(str::to_owned);
    let mut text = line(&head);
    for [a, b] in file.rows {
        for quantity in QUANTITIES.iter().filter(|quantity| quantity.key != "T") {
            let values = [(quantity.value)(a), (quantity.value)(b)];
            if values.iter().all(Option::is_none) {
                continue;
            }
            let cells = [values[0], values[1], per_cent(values)].map(cell);
            let [first, second, change] = cells;
            let fields =
                [cell(Some(a.draught)), quantity.key.to_owned(), quantity.unit.to_owned(), first, second, change];
            text.push_str(&line(&fields));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_of_the_first_hull() {
        assert_eq!(per_cent([Some(2.0), Some(3.0)]), Some(50.0));
        assert_eq!(per_cent([Some(-2.0), Some(-3.0)]), Some(-50.0));
        assert_eq!((per_cent([Some(0.0), Some(1.0)]), per_cent([None, Some(1.0)])), (None, None));
    }

    #[test]
    fn a_row_a_quantity() {
        let row = |volume: f64| Hydrostatics { draught: 2.0, displacement_volume: volume, ..Hydrostatics::default() };
        let rows = [[row(100.0), row(110.0)]];
        let file = CompareFile { names: ["a", "b"], values: &[], rows: &rows, distances: [None; 2], warnings: &[] };
        assert!(compare_csv(&file).contains("2,DISPVOL,m3,100,110,10\n"), "{}", compare_csv(&file));
        assert_eq!(compare_json(&file)["hydrostatics"][0]["DISPVOL"]["change"], 10.0);
        assert!(compare_json(&file)["distances"]["second_from_first"].is_null());
    }
}
