//! `.hgf` and `.huf`: the parameters of the raw cosh generator as one CSV record under one header.
//!
//! Two layouts are in use. In the first the columns are `Name, LOA, BOA, D, ..., HullData, ...`, and `HullData` is a
//! list of numbers with spaces between them, of which the program reads, counted from 1: 1 to 9 the parameters ms, bow,
//! transom, deck, tb, td, acu, kf, sa, and 20 and 21 the draughts forward and aft. In the second every parameter is a
//! column of its own, `shipname, loa_val, boa_val, depth_val, ms_val, bow_val, tr_val` (or `tr_stern_val`)`, deck_val,
//! tb_val, td_val, acu_val, kf_val, sa_val, tf_val, ta_val`. Decks, bulkheads and the rest are not read. The design
//! draught is the mean of the two draughts: the generator has none of its own. Lengths are metres, the slope is in
//! radians.

use crate::parametric::ucl_cosh::Parameters;

/// Files longer than this are not read \[bytes\].
const LARGEST: usize = 1 << 20;

/// Why a text is not a `.hgf` file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum HgfError {
    /// Longer than any such file.
    #[error("the file has {0} bytes; a .hgf file has at most {LARGEST}")]
    Size(usize),
    /// No header or no record.
    #[error("{0}; expected a header line and one record")]
    Records(&'static str),
    /// A record that cannot be split into fields.
    #[error("line {line}: {message}")]
    Csv {
        /// Line of the file.
        line: usize,
        /// What is wrong.
        message: String,
    },
    /// A column that is not there.
    #[error("line {line}: no column {column} in the header; expected {expected}")]
    Column {
        /// Line of the header.
        line: usize,
        /// Name of the column.
        column: &'static str,
        /// What the header should have.
        expected: &'static str,
    },
    /// A field that is not a number.
    #[error("line {line}, {field}: '{found}' is not a number")]
    Number {
        /// Line of the record.
        line: usize,
        /// Name of the column, with the place in its list.
        field: String,
        /// As written.
        found: String,
    },
    /// A list that is too short.
    #[error("line {line}, HullData: {found} numbers, expected at least {expected}; number {expected} is {meaning}")]
    Short {
        /// Line of the record.
        line: usize,
        /// Numbers found.
        found: usize,
        /// Numbers needed.
        expected: usize,
        /// What the last needed one is.
        meaning: &'static str,
    },
}

impl HgfError {
    /// Line of the file, from 1; none when the message is about the whole file.
    #[must_use]
    pub fn line(&self) -> Option<usize> {
        match self {
            Self::Csv { line, .. }
            | Self::Column { line, .. }
            | Self::Number { line, .. }
            | Self::Short { line, .. } => Some(*line),
            Self::Size(_) | Self::Records(_) => None,
        }
    }
}

/// The ship of a `.hgf` file.
#[derive(Debug, Clone, PartialEq)]
pub struct HgfShip {
    /// Name; empty when the file has none.
    pub name: String,
    /// Parameters; the draught is the mean of the draughts forward and aft.
    pub parameters: Parameters,
}

/// Columns of the second layout, in the order of [`Parameters`] below.
const COLUMNS: [&[&str]; 9] = [
    &["ms_val"],
    &["bow_val"],
    &["tr_stern_val", "tr_val"],
    &["deck_val"],
    &["tb_val"],
    &["td_val"],
    &["acu_val"],
    &["kf_val"],
    &["sa_val"],
];

struct Record<'a> {
    header: &'a csv::StringRecord,
    record: &'a csv::StringRecord,
    header_line: usize,
    line: usize,
    errors: Vec<HgfError>,
}

impl Record<'_> {
    fn text(&self, names: &[&str]) -> Option<&str> {
        let index = self.header.iter().position(|h| names.iter().any(|n| n.eq_ignore_ascii_case(h.trim())))?;
        Some(self.record.get(index).unwrap_or("").trim())
    }

    fn parse(&mut self, field: &str, found: &str) -> f64 {
        match found.parse::<f64>() {
            Ok(value) if value.is_finite() => value,
            _ => {
                let found: String = found.chars().take(40).collect();
                self.errors.push(HgfError::Number { line: self.line, field: field.to_owned(), found });
                f64::NAN
            }
        }
    }

    fn number(&mut self, names: &'static [&'static str], expected: &'static str) -> f64 {
        match self.text(names).map(str::to_owned) {
            Some(text) => self.parse(names[0], &text),
            None => {
                self.errors.push(HgfError::Column { line: self.header_line, column: names[0], expected });
                f64::NAN
            }
        }
    }
}

/// Reads a `.hgf` file.
///
/// # Errors
/// Every [`HgfError`] of the file.
pub fn read_hgf(text: &str) -> Result<HgfShip, Vec<HgfError>> {
    if text.len() > LARGEST {
        return Err(vec![HgfError::Size(text.len())]);
    }
    let text = text.trim_start_matches('\u{feff}');
    let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text.as_bytes());
    let mut records = reader.records();
    let mut next = |missing: &'static str| match records.next() {
        None => Err(vec![HgfError::Records(missing)]),
        Some(Ok(record)) => Ok(record),
        Some(Err(error)) => {
            let line = error.position().map_or(1, |p| p.line() as usize);
            Err(vec![HgfError::Csv {
                line,
                message: "not a CSV record".to_owned() + if error.is_io_error() { " (reading failed)" } else { "" },
            }])
        }
    };
    let header = next("the file is empty")?;
    let record = next("the file has a header and no record")?;
    let line = |r: &csv::StringRecord| r.position().map_or(1, |p| p.line() as usize);
    let mut fields = Record {
        header: &header,
        record: &record,
        header_line: line(&header),
        line: line(&record),
        errors: Vec::new(),
    };
    let (numbers, [fore, aft], dimensions) = match fields.text(&["HullData"]).map(str::to_owned) {
        Some(list) => hull_data(&mut fields, &list),
        None => columns(&mut fields),
    };
    let name = fields.text(&["Name", "shipname"]).unwrap_or("").to_owned();
    if !fields.errors.is_empty() {
        return Err(fields.errors);
    }
    let [
        midship_fullness,
        bow,
        transom_fullness,
        forward_deck,
        transom_breadth_ratio,
        transom_tip_ratio,
        aft_cut_up_ratio,
        keel_forward_ratio,
        side_slope,
    ] = numbers;
    let [length, breadth, depth] = dimensions;
    Ok(HgfShip {
        name,
        parameters: Parameters {
            length,
            breadth,
            depth,
            draught: 0.5 * (fore + aft),
            midship_fullness,
            bow,
            transom_fullness,
            forward_deck,
            transom_breadth_ratio,
            transom_tip_ratio,
            aft_cut_up_ratio,
            keel_forward_ratio,
            side_slope,
        },
    })
}

type Numbers = ([f64; 9], [f64; 2], [f64; 3]);

fn hull_data(fields: &mut Record<'_>, list: &str) -> Numbers {
    let expected = "Name, LOA, BOA, D, HullData";
    let dimensions = [["LOA"], ["BOA"], ["D"]].map(|names| {
        let name = names[0];
        match fields.text(&names).map(str::to_owned) {
            Some(text) => fields.parse(name, &text),
            None => {
                fields.errors.push(HgfError::Column { line: fields.header_line, column: name, expected });
                f64::NAN
            }
        }
    });
    let words: Vec<&str> = list.split_whitespace().collect();
    if words.len() < 21 {
        let (needed, meaning) = if words.len() < 9 { (9, "the slope sa") } else { (21, "the draught aft ta") };
        fields.errors.push(HgfError::Short { line: fields.line, found: words.len(), expected: needed, meaning });
        return ([f64::NAN; 9], [f64::NAN; 2], dimensions);
    }
    let mut at = |index: usize| fields.parse(&format!("HullData number {}", index + 1), words[index]);
    (std::array::from_fn(&mut at), [at(19), at(20)], dimensions)
}

fn columns(fields: &mut Record<'_>) -> Numbers {
    let expected = "HullData, or the columns loa_val, boa_val, depth_val, ms_val, bow_val, tr_val, deck_val, tb_val, td_val, acu_val, kf_val, sa_val, tf_val, ta_val";
    let dimensions: [&'static [&'static str]; 3] = [&["loa_val"], &["boa_val"], &["depth_val"]];
    if fields.text(dimensions[0]).is_none() && fields.text(COLUMNS[0]).is_none() {
        fields.errors.push(HgfError::Column { line: fields.header_line, column: "HullData", expected });
        return ([f64::NAN; 9], [f64::NAN; 2], [f64::NAN; 3]);
    }
    let draughts: [&'static [&'static str]; 2] = [&["tf_val"], &["ta_val"]];
    (
        COLUMNS.map(|names| fields.number(names, expected)),
        draughts.map(|names| fields.number(names, expected)),
        dimensions.map(|names| fields.number(names, expected)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A record of the first layout with other numbers than any published ship's.
    const FIRST: &str = "Id,Name,LOA,BOA,D,DeckPos,HullData,MaxSpeed\n\
        1,Ship 2,80,12,8,8 4 0,1.4 0.2 1.3 0.7 0.8 0.5 0.25 0.85 0.1 13 0.9 3 0.8 0.9 1 1 4 72 11 4 5 1.5,20\n";

    #[test]
    fn first_layout() {
        let ship = read_hgf(FIRST).unwrap();
        let p = ship.parameters;
        assert_eq!(ship.name, "Ship 2");
        let expected = Parameters {
            length: 80.0,
            breadth: 12.0,
            depth: 8.0,
            draught: 4.5,
            midship_fullness: 1.4,
            bow: 0.2,
            transom_fullness: 1.3,
            forward_deck: 0.7,
            transom_breadth_ratio: 0.8,
            transom_tip_ratio: 0.5,
            aft_cut_up_ratio: 0.25,
            keel_forward_ratio: 0.85,
            side_slope: 0.1,
        };
        assert_eq!(p, expected);
    }

    #[test]
    fn second_layout() {
        let text = "loa_val,boa_val,depth_val,shipname,ms_val,bow_val,tr_val,deck_val,tb_val,td_val,acu_val,kf_val,sa_val,tf_val,ta_val\n\
            80,12,8,Ship 2,1.4,0.2,1.3,0.7,0.8,0.5,0.25,0.85,0.1,4,5\n";
        assert_eq!(read_hgf(text).unwrap(), read_hgf(FIRST).unwrap());
    }

    #[test]
    fn every_message() {
        let messages = |text: &str| read_hgf(text).unwrap_err().iter().map(ToString::to_string).collect::<Vec<_>>();
        assert_eq!(messages(""), ["the file is empty; expected a header line and one record"]);
        assert_eq!(
            messages("Name,LOA\n"),
            ["the file has a header and no record; expected a header line and one record"]
        );
        assert!(
            messages("a,b\n1,2\n")[0].starts_with("line 1: no column HullData in the header; expected HullData, or")
        );
        assert_eq!(
            messages(&FIRST.replace("1.4 0.2", "1.4 x").replace(",80,", ",L,")),
            ["line 2, LOA: 'L' is not a number", "line 2, HullData number 2: 'x' is not a number"]
        );
        assert_eq!(
            messages("Name,LOA,BOA,HullData\na,1,2,1 2 3\n"),
            [
                "line 1: no column D in the header; expected Name, LOA, BOA, D, HullData",
                "line 2, HullData: 3 numbers, expected at least 9; number 9 is the slope sa"
            ]
        );
        assert!(
            messages("LOA,BOA,D,HullData\n1,2,3,1 2 3 4 5 6 7 8 9\n")[0].ends_with("number 21 is the draught aft ta")
        );
        assert!(messages("loa_val,boa_val\n1,2\n").iter().any(|m| m.contains("no column ms_val")));
        assert!(messages(&"x".repeat(LARGEST + 1))[0].contains("a .hgf file has at most"));
        assert!(messages("a,b\n\"1,2").len() == 1);
    }
}
