//! Published figures of a ship, to stand beside those of its hull.

use super::document::{Document, nearest};
use crate::hydrostatics::QUANTITIES;

/// A published hydrostatic table.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// Where it was published.
    pub source: String,
    /// What explains the differences; empty by default.
    pub note: String,
    /// ITTC codes of the columns, without the draught.
    pub columns: Vec<&'static str>,
    /// One row a draught.
    pub rows: Vec<ReferenceRow>,
}

/// One draught of a published table.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceRow {
    /// Draught \[m\].
    pub draught: f64,
    /// Values in the units of the codes.
    pub values: Vec<f64>,
}

impl Reference {
    /// Ours less theirs in % of theirs; the plain difference where theirs is 0.
    #[must_use]
    pub fn difference_percent(&self, theirs: f64, ours: f64) -> f64 {
        if theirs.abs() > 0.0 { 100.0 * (ours - theirs) / theirs } else { ours - theirs }
    }
}

/// The reference of a design file: `reference.table` is text with commas, its first line the codes, one of them T.
pub(super) fn reference(document: &mut Document<'_>) -> Option<Reference> {
    let path = "reference.table";
    let source = document.text("reference.source");
    let note = document.text("reference.note").unwrap_or_default();
    let text = document.text(path)?;
    let (_, span, _) = document.raw(path)?;
    let mut problem = |message: String, help: &str| document.problem("E150", path, &span, message, help.to_owned());
    let mut lines = text.lines().map(str::trim).enumerate().filter(|(_, line)| !line.is_empty());
    let header = lines.next().map(|(_, line)| line).unwrap_or_default();
    let mut columns = Vec::new();
    for word in header.split(',').map(str::trim) {
        match QUANTITIES.iter().find(|quantity| quantity.key.eq_ignore_ascii_case(word)) {
            Some(quantity) => columns.push(quantity.key),
            None => {
                let help = nearest(word, QUANTITIES.iter().map(|quantity| quantity.key)).map_or_else(
                    || "columns are ITTC codes, as in hydrostatics.csv".to_owned(),
                    |k| format!("did you mean `{k}`?"),
                );
                problem(format!("the table has an unknown column `{word}`"), &help);
                return None;
            }
        }
    }
    let Some(at) = columns.iter().position(|key| *key == "T") else {
        problem("the table has no column T".to_owned(), "give the draughts in a column T");
        return None;
    };
    let mut rows = Vec::new();
    for (number, line) in lines {
        let cells: Vec<Option<f64>> =
            line.split(',').map(|word| word.trim().parse().ok().filter(|value: &f64| value.is_finite())).collect();
        if cells.len() != columns.len() || cells.contains(&None) {
            problem(
                format!("line {} of the table is `{line}`", number + 1),
                &format!("{} numbers, one a column, with decimal points", columns.len()),
            );
            continue;
        }
        let mut values: Vec<f64> = cells.into_iter().flatten().collect();
        let draught = values.remove(at);
        rows.push(ReferenceRow { draught, values });
    }
    columns.remove(at);
    Some(Reference { source: source.unwrap_or_else(|| "published figures".to_owned()), note, columns, rows })
}

#[cfg(test)]
mod tests {
    use super::super::read;

    fn with(table: &str) -> String {
        format!(
            "[project]\nfamily = \"box\"\n[dimensions]\nLpp = 10\nB = 2\nT = 1\n[reference]\nsource = \"a box\"\ntable = \"\"\"\n{table}\n\"\"\"\n"
        )
    }

    #[test]
    fn a_table_is_read() {
        let reference = read("a.toml", &with("T,DISPVOL,cb\n0.5,10,1\n1,20,1")).unwrap().reference.unwrap();
        assert_eq!((reference.columns, reference.rows.len()), (vec!["DISPVOL", "CB"], 2));
        assert!((reference.rows[1].values[0] - 20.0).abs() < 1e-15 && (reference.rows[1].draught - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_wrong_table_says_what_is_wrong() {
        for (table, part) in [
            ("T,DISPVOLL\n1,2", "unknown column `DISPVOLL`"),
            ("DISPVOL\n1", "no column T"),
            ("T,KB\n1,x\n2", "line 2 of the table is `1,x`"),
            ("T,KB\n1,2,3", "2 numbers"),
        ] {
            let text: Vec<String> = read("a.toml", &with(table)).unwrap_err().iter().map(ToString::to_string).collect();
            assert!(text.iter().any(|line| line.contains(part)), "{part}: {text:?}");
        }
    }
}
