//! What a `reference.toml` says is published about a hull.
//!
//! ```toml
//! hull = "Series 60 parent, Cb 0.60"      # title
//! [table]
//! file = "sections.csv"                   # else sections.csv, else offsets.csv
//! [particulars]
//! lpp = 121.92                            # also lbp; beam; depth; draught (also z_waterline, lwl_draught); x_min
//! [published]                             # figures at that draught; any section whose name ends in `published`, and `exact`
//! cb = 0.6
//! source = "Todd 1953"
//! [published.volume_m3]                   # figures at other draughts: T2_5 is 2.5 m
//! T2_5 = 662.22
//! [tolerance]                             # what is not here is printed and not judged
//! cb = 0.004                              # absolute
//! volume_percent = 0.5                    # of the published figure
//! ```
//!
//! `[check]` holds figures of other integrations of the same table; it is used where nothing is published. `volume_m3`
//! of `[mesh_check]`, `[obj_check]`, `[stl_check]` (meshes of the same ship) and `[table_check]` (trapezoids over the
//! table) is shown and not judged. `[sign_trap]` says that centres in columns named `..._printed` count positive
//! towards the aft end. A file `*hydrostatics.csv` beside it is a published table: its columns have the same names, its
//! draughts are `T_m`. `lcb_x_m` counts from the origin of x in the table; `x_min` of `[particulars]` is the x of the
//! aftmost station there, for readers that put AP elsewhere.

use toml::{Table, Value};

/// Where a centre is measured from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum CentreDatum {
    /// As it is.
    Plain,
    /// From midship, + forward.
    Forward,
    /// From midship, + aft.
    Aft,
    /// From the origin of x in the table, + forward.
    Table,
}

/// A name that figures have in these files.
#[derive(Debug, PartialEq)]
pub(super) struct Known {
    pub(super) written: &'static [&'static str],
    /// Key of the quantity.
    pub(super) key: &'static str,
    pub(super) origin: CentreDatum,
    /// Keys of `[tolerance]`: absolute, and in % of the published figure.
    absolute: &'static str,
    percent: &'static str,
}

const fn known(
    written: &'static [&'static str],
    key: &'static str,
    origin: CentreDatum,
    absolute: &'static str,
    percent: &'static str,
) -> Known {
    Known { written, key, origin, absolute, percent }
}

const KNOWN: [Known; 21] = [
    known(&["volume_m3"], "DISPVOL", CentreDatum::Plain, "volume_m3", "volume_percent"),
    known(&["displacement_t"], "DISPM", CentreDatum::Plain, "displacement_t", "displacement_percent"),
    known(&["cb"], "CB", CentreDatum::Plain, "cb", "cb_percent"),
    known(&["cm"], "CM", CentreDatum::Plain, "cm", "cm_percent"),
    known(&["cp"], "CP", CentreDatum::Plain, "cp", "cp_percent"),
    known(&["cwp"], "CWP", CentreDatum::Plain, "cwp", "cwp_percent"),
    known(&["lcb_percent_lpp_fwd"], "XCBPC", CentreDatum::Plain, "lcb_percent_lpp", ""),
    known(&["lcb_from_ap_m"], "XCB", CentreDatum::Plain, "lcb_m", ""),
    known(&["lcb_x_m"], "XCB", CentreDatum::Table, "lcb_m", ""),
    known(&["lcb_m"], "XCB", CentreDatum::Forward, "lcb_m", ""),
    known(&["lcb_m_aft_of_midship"], "XCB", CentreDatum::Aft, "lcb_m", ""),
    known(&["lcf_m"], "XWL", CentreDatum::Forward, "lcf_m", ""),
    known(&["kb_m"], "KB", CentreDatum::Plain, "kb_m", "kb_percent"),
    known(&["km_m", "kmt_m"], "KMT", CentreDatum::Plain, "km_m", "km_percent"),
    known(&["bmt_m"], "BMT", CentreDatum::Plain, "bmt_m", "bmt_percent"),
    known(&["bml_m"], "BML", CentreDatum::Plain, "bml_m", "bml_percent"),
    known(&["it_m4"], "IT", CentreDatum::Plain, "it_m4", "it_percent"),
    known(&["il_m4"], "IL", CentreDatum::Plain, "il_m4", "il_percent"),
    known(
        &["waterplane_area_m2", "awp_m2"],
        "AWL",
        CentreDatum::Plain,
        "waterplane_area_m2",
        "waterplane_area_percent",
    ),
    known(&["wetted_surface_m2"], "S", CentreDatum::Plain, "wetted_surface_m2", "wetted_surface_percent"),
    known(&["tpc_t_per_cm"], "TPC", CentreDatum::Plain, "tpc_t_per_cm", "tpc_percent"),
];

/// What a figure may differ by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tolerance {
    /// In the unit of the figure.
    Absolute(f64),
    /// In % of the figure.
    Percent(f64),
}

/// One published figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Figure {
    pub(super) known: &'static Known,
    pub(super) draught: f64,
    /// In the frame of our tables where the sign was reversed.
    pub(super) value: f64,
    pub(super) tolerance: Option<Tolerance>,
    /// `published`, `exact`, `check`, or which other body.
    pub(super) section: &'static str,
}

/// What is known about a hull.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Reference {
    pub(super) title: String,
    pub(super) source: String,
    pub(super) table: Option<String>,
    pub(super) length: Option<f64>,
    pub(super) breadth: Option<f64>,
    pub(super) draught: Option<f64>,
    pub(super) depth: Option<f64>,
    /// x of the aftmost station as it is written, in the frame of the figures that count from it.
    pub(super) aftmost: Option<f64>,
    pub(super) figures: Vec<Figure>,
    /// Numbers under names that are not known here.
    pub(super) unread: Vec<String>,
}

fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Float(number) => Some(*number),
        // Figures are small integers where they are integers.
        Value::Integer(number) => Some(*number as f64),
        _ => None,
    }
    .filter(|number| number.is_finite())
}

/// The first of several keys of several sections that is a number.
fn first(root: &Table, sections: &[&str], keys: &[&str]) -> Option<f64> {
    let tables = sections.iter().filter_map(|section| root.get(*section)?.as_table());
    tables.flat_map(|table| keys.iter().filter_map(|key| table.get(*key))).find_map(number)
}

/// `T2_5` is 2.5.
fn draught_of(key: &str) -> Option<f64> {
    key.strip_prefix(['T', 't'])?.replace('_', ".").parse().ok().filter(|draught: &f64| draught.is_finite())
}

/// The quantity that a name means, and whether the name says that it stands as printed.
fn meaning(written: &str) -> Option<(&'static Known, bool)> {
    let lower = written.to_lowercase();
    let printed = lower.ends_with("_printed");
    let mut plain = lower.as_str();
    for suffix in ["_printed", "_implied", "_other", "_pchip", "_trapezoid"] {
        plain = plain.strip_suffix(suffix).unwrap_or(plain);
    }
    KNOWN.iter().find(|known| known.written.contains(&plain)).map(|known| (known, printed))
}

struct ReferenceReader<'a> {
    root: &'a Table,
    reversed: bool,
    reference: Reference,
}

impl ReferenceReader<'_> {
    fn tolerance(&self, known: &Known) -> Option<Tolerance> {
        let table = self.root.get("tolerance")?.as_table()?;
        let find = |key: &str| if key.is_empty() { None } else { table.get(key).and_then(number) };
        let on_offsets = format!("{}_on_offsets", known.percent);
        let percent = find(known.percent).or_else(|| find(&on_offsets));
        find(known.absolute).map(Tolerance::Absolute).or(percent.map(Tolerance::Percent))
    }

    fn add(&mut self, section: &'static str, written: &str, draught: Option<f64>, value: f64) {
        let (Some((known, printed)), Some(draught)) = (meaning(written), draught) else {
            self.reference.unread.push(format!("{section}.{written}"));
            return;
        };
        let reversed = printed && self.reversed && known.origin != CentreDatum::Plain;
        let value = if reversed { -value } else { value };
        let tolerance = self.tolerance(known);
        // A table and a list may say the same.
        let same = |f: &Figure| {
            f.known.key == known.key
                && (f.draught - draught).abs() < 1e-9
                && (f.value - value).abs() < 1e-12 * value.abs()
        };
        if !self.reference.figures.iter().any(same) {
            self.reference.figures.push(Figure { known, draught, value, tolerance, section });
        }
    }

    fn section(&mut self, section: &'static str, table: &Table) {
        let own = ["draught", "z"].iter().find_map(|key| table.get(*key)).and_then(number);
        let draught = own.or(self.reference.draught);
        for (key, value) in table {
            if matches!(key.as_str(), "draught" | "z") {
                continue;
            }
            if let Some(value) = number(value) {
                self.add(section, key, draught, value);
            } else if let Some(inner) = value.as_table() {
                if inner.keys().all(|key| draught_of(key).is_some()) {
                    for (at, value) in inner {
                        if let Some(value) = number(value) {
                            self.add(section, key, draught_of(at), value);
                        }
                    }
                } else {
                    self.section(section, inner);
                }
            }
        }
    }
}

/// Reads the text of a `reference.toml` and of the published table beside it.
///
/// # Errors
/// The place and the message of what is not TOML, or not a table of numbers.
pub(super) fn read(text: &str, published_table: Option<&str>) -> Result<Reference, String> {
    let root: Table = text.parse().map_err(|error: toml::de::Error| error.to_string())?;
    let word = |section: &str, key: &str| root.get(section)?.as_table()?.get(key)?.as_str().map(str::to_owned);
    let sizes = ["particulars", "definition"];
    let reference = Reference {
        title: root.get("hull").and_then(Value::as_str).unwrap_or_default().to_owned(),
        source: word("published", "source").or_else(|| word("check", "method")).unwrap_or_default(),
        table: word("table", "file"),
        length: first(&root, &sizes, &["lpp", "lbp", "L"]),
        breadth: first(&root, &sizes, &["beam", "B"]),
        draught: first(&root, &sizes, &["draught", "lwl_draught", "z_waterline", "T"]),
        depth: first(&root, &sizes, &["depth", "D"]),
        aftmost: first(&root, &sizes, &["x_min"]),
        ..Reference::default()
    };
    let mut reader = ReferenceReader { root: &root, reversed: root.contains_key("sign_trap"), reference };
    for (name, value) in &root {
        let Some(table) = value.as_table() else { continue };
        if name.ends_with("published") {
            reader.section("published", table);
        } else if name == "exact" {
            reader.section("exact", table);
        }
    }
    if let Some(text) = published_table {
        let mut lines = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
        let header = lines.headers().map_err(|error| error.to_string())?.clone();
        let at = header.iter().position(|name| name == "T_m").ok_or("the published table has no column T_m")?;
        for record in lines.records() {
            let record = record.map_err(|error| error.to_string())?;
            let values: Vec<Option<f64>> = record.iter().map(|cell| cell.parse().ok()).collect();
            for (name, value) in header.iter().zip(&values).filter(|(name, _)| *name != "T_m") {
                if let (Some(value), Some(draught)) = (value, values[at].filter(|draught| *draught > 0.0)) {
                    reader.add("published", name, Some(draught), *value);
                }
            }
        }
    }
    let check = root.get("check").and_then(Value::as_table);
    if let Some(table) = check.filter(|_| reader.reference.figures.is_empty()) {
        reader.section("check", table);
    }
    // Volumes of other bodies that stand for the same ship; what is published may lie between them.
    let others =
        [("mesh_check", "mesh"), ("obj_check", "mesh OBJ"), ("stl_check", "mesh STL"), ("table_check", "trapezoids")];
    for (name, section) in others {
        let Some(table) = root.get(name).and_then(Value::as_table) else { continue };
        if let Some(value) = table.get("volume_m3").and_then(number) {
            let draught = reader.reference.draught;
            reader.add(section, "volume_m3", draught, value);
        }
    }
    let mut reference = reader.reference;
    reference.figures.iter_mut().filter(|f| others.iter().any(|o| o.1 == f.section)).for_each(|f| f.tolerance = None);
    reference.figures.sort_by(|a, b| a.draught.total_cmp(&b.draught));
    Ok(reference)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_draughts_tolerances_and_signs() {
        let text = "hull = 'x'\n[particulars]\nlbp = 41.4\nbeam = 9.9\ndraught = 2.6\n[published]\nsource = 'book'\ncb = 0.6\n\
                    nonsense = 3\n[published.volume_m3]\nT1_0 = 189.59\n[sign_trap]\nnote = 'reversed'\n[tolerance]\n\
                    volume_percent = 0.5\ncb = 0.004\n";
        let table = "T_m,volume_m3,LCB_m_printed,KB_m\n0,0,1,2\n1,189.59,-0.297,0.623\n";
        let reference = read(text, Some(table)).unwrap();
        assert_eq!((reference.length, reference.draught), (Some(41.4), Some(2.6)));
        let find = |key: &str| reference.figures.iter().filter(|f| f.known.key == key).collect::<Vec<_>>();
        let volume = find("DISPVOL");
        assert_eq!(volume.len(), 1, "the list and the table say the same");
        assert_eq!(volume[0].tolerance, Some(Tolerance::Percent(0.5)));
        assert!((volume[0].draught - 1.0).abs() < 1e-15);
        assert_eq!(find("CB")[0].tolerance, Some(Tolerance::Absolute(0.004)));
        assert!((find("XCB")[0].value - 0.297).abs() < 1e-15, "printed with + aft");
        assert_eq!(reference.unread, ["published.nonsense"]);
    }

    #[test]
    fn checks_stand_in_where_nothing_is_published() {
        let text = "[particulars]\nz_waterline = 0.9652\n[published]\nmass_in_input_t = 28.8\n[check]\nvolume_m3 = 24.781\n\
                    method = 'trapezoid'\n[tolerance]\nvolume_percent = 0.5\n";
        let reference = read(text, None).unwrap();
        assert_eq!(reference.figures.len(), 1);
        assert_eq!((reference.figures[0].section, reference.source.as_str()), ("check", "trapezoid"));
    }
}
