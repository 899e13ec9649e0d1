//! What is printed on a terminal: pages of at most 80 columns.

use crate::hull::{NO_DRAUGHT, PrincipalParticulars};
use crate::hydrostatics::{
    CoefficientLength, Conventions, CurvesOfForm, Hydrostatics, LEAST_GM, LcbReference, PrismaticSection, Quantity,
    Shell,
};

pub(in crate::report) const WIDTH: usize = 80;

/// Value of a quantity with its decimals; empty when it is not defined.
pub(in crate::report) fn value(row: &Hydrostatics, key: &str) -> String {
    Quantity::of(key)
        .and_then(|quantity| (quantity.value)(row).filter(|v| v.is_finite()).map(|v| fixed(v, quantity.decimals_of(v))))
        .unwrap_or_default()
}

/// A number with so many decimals; what rounds to zero has no sign, and what is no number is "-".
pub(in crate::report) fn fixed(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return "-".to_owned();
    }
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.chars().all(|c| matches!(c, '0' | '.')) => digits.to_owned(),
        _ => text,
    }
}

/// A factor that is needed, to three decimals, upward: with less it would not do.
pub(in crate::report) fn upward(factor: f64) -> f64 {
    (1e3 * factor).ceil() / 1e3
}

/// The same with its sign, + as well.
pub(in crate::report) fn signed(value: f64, decimals: usize) -> String {
    let text = fixed(value, decimals);
    if text.starts_with('-') || text.chars().all(|c| matches!(c, '0' | '.')) { text } else { format!("+{text}") }
}

/// The same with its sign and unit.
pub(in crate::report) fn fixed_sign(value: f64, decimals: usize, unit: &str) -> String {
    format!("{}{unit}", signed(value, decimals))
}

/// The longitudinal centre of buoyancy as the conventions have it printed; empty when it is not defined.
pub(in crate::report) fn lcb(row: &Hydrostatics, conventions: &Conventions, length: f64) -> String {
    row.lcb.filter(|x| x.is_finite()).map(|x| fixed(conventions.lcb_reference.lcb(x, length), 3)).unwrap_or_default()
}

pub(in crate::report) fn unit(key: &str) -> &'static str {
    Quantity::of(key).map_or("", |quantity| if quantity.unit == "-" { "" } else { quantity.unit })
}

/// Cuts a text at words to lines of at most [`WIDTH`] characters, later lines indented.
pub(in crate::report) fn wrapped(text: &str, indent: usize) -> String {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.len() - 1;
        let line = &mut lines[last];
        if line.trim().is_empty() {
            line.push_str(word);
        } else if line.chars().count() + 1 + word.chars().count() <= WIDTH {
            line.push(' ');
            line.push_str(word);
        } else {
            lines.push(format!("{}{word}", " ".repeat(indent)));
        }
    }
    lines.join("\n") + "\n"
}

pub(in crate::report) fn conventions_line(c: &Conventions) -> String {
    let length = match c.coefficient_length {
        CoefficientLength::BetweenPerpendiculars => "Lpp",
        CoefficientLength::Waterline => "Lwl",
    };
    let section = match c.prismatic_section {
        PrismaticSection::Maximum => "the largest section",
        PrismaticSection::Midship => "the midship section",
    };
    let shell = match c.shell {
        Shell::None => String::new(),
        Shell::Factor(factor) => format!("; shell factor {factor}"),
        Shell::Thickness(thickness) => format!("; shell {} mm", thickness * 1000.0),
    };
    let trim = match c.centre_of_gravity_height {
        Some(height) => format!("MTC from GML with KG {height} m"),
        None => "MTC from BML".to_owned(),
    };
    let lcb = c.lcb_reference.statement();
    format!(
        "Coefficients on {length}, CP on {section}; {} t/m3{shell}; {trim}; x from AP; {lcb}; {}.",
        c.density,
        c.sources()
    )
}

/// The main dimensions in one line, without a draught that nobody stated.
pub(in crate::report) fn dimensions(p: &PrincipalParticulars) -> String {
    let draught = p.draught.map_or(String::new(), |draught| format!("   T {draught:.3} m"));
    format!("Lpp {:.3} m   B {:.3} m{draught}   D {:.3} m\n", p.length_between_perpendiculars, p.breadth, p.depth)
}

/// What to do where nobody stated a draught, as a sentence.
pub(in crate::report) fn no_draught() -> String {
    format!("{}{}.", NO_DRAUGHT[..1].to_uppercase(), &NO_DRAUGHT[1..])
}

/// The quantities of a condition that a page shows; `length` is Lpp \[m\].
pub(in crate::report) fn quantities(row: &Hydrostatics, conventions: &Conventions, length: f64) -> String {
    let mut page = String::new();
    // The other way to say where the centre of buoyancy is.
    let second = if conventions.lcb_reference == LcbReference::Percent { "XCB" } else { "XCBPC" };
    let keys = [
        ["DISPVOL", "DISPM", "LCB"],
        [second, "KB", "AWL"],
        ["XWL", "LWL", "BWL"],
        ["BMT", "KMT", "KML"],
        ["TPC", "MTC", "S"],
        ["CP", "CWP", "CVP"],
    ];
    for keys in keys {
        let cells = keys.map(|key| {
            let (shown, unit) = match key {
                "LCB" => (lcb(row, conventions, length), conventions.lcb_reference.unit()),
                _ => (value(row, key), unit(key)),
            };
            format!("{key:<8}{shown:>11} {unit:<7}")
        });
        page.push_str(cells.join("").trim_end());
        page.push('\n');
    }
    if conventions.centre_of_gravity_height.is_some() {
        let cells = ["GMT", "GML"].map(|key| format!("{key:<8}{:>11} {:<7}", value(row, key), unit(key)));
        page.push_str(cells.join("").trim_end());
        page.push('\n');
        page.push_str(&tender([row]));
    }
    page
}

/// A line that marks rows with too little GM; empty where there are none.
fn tender<'r>(rows: impl IntoIterator<Item = &'r Hydrostatics>) -> String {
    tender_words(rows).map_or_else(String::new, |words| wrapped(&words, 2))
}

/// The sentence of that line; none where no row has too little GM.
pub(in crate::report) fn tender_words<'r>(rows: impl IntoIterator<Item = &'r Hydrostatics>) -> Option<String> {
    let rows = rows.into_iter().filter(|row| row.is_tender());
    let draughts: Vec<String> = rows.map(|row| format!("{} m", value(row, "T"))).collect();
    let words = || format!("{TENDER} {LEAST_GM} m, the least of the IS Code, at T {}.", draughts.join(", "));
    (!draughts.is_empty()).then(words)
}

/// How the line begins that marks too little GM.
pub const TENDER: &str = "GM is below";

/// A hydrostatic table in blocks of 80 columns.
#[must_use]
pub fn hydrostatics_page(table: &CurvesOfForm, particulars: &PrincipalParticulars) -> String {
    let (conventions, length) = (&table.conventions, particulars.length_between_perpendiculars);
    let blocks: [&[&str]; 4] = [
        &["T", "DISPVOL", "DISPM", "LCB", "KB", "AWL", "XWL", "TPC"],
        &["T", "MTC", "BMT", "BML", "KMT", "KML", "LWL", "BWL"],
        &["T", "CB", "CM", "CX", "CP", "CWP", "CVP", "S"],
        &["T", "GMT", "GML"],
    ];
    let blocks = &blocks[..if conventions.centre_of_gravity_height.is_some() { 4 } else { 3 }];
    let mut page = wrapped(&conventions_line(conventions), 2);
    if particulars.draught.is_none() {
        page.push_str("No design draught is stated (--draught).\n");
    }
    for block in blocks {
        page.push('\n');
        let row = |cell: &dyn Fn(&str) -> String| {
            block.iter().map(|key| format!("{:>10}", cell(key))).collect::<String>() + "\n"
        };
        page.push_str(&row(&|key| key.to_owned()));
        let unit_of = |key: &str| if key == "LCB" { conventions.lcb_reference.unit() } else { unit(key) };
        page.push_str(&row(&|key| unit_of(key).to_owned()));
        for line in &table.rows {
            page.push_str(&row(&|key| if key == "LCB" { lcb(line, conventions, length) } else { value(line, key) }));
        }
    }
    page.push_str(&tender(&table.rows));
    for line in &table.rows {
        if let Some(remark) = &line.remark {
            page.push_str(&wrapped(&format!("T {} m: {remark}", value(line, "T")), 2));
        }
    }
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_never_pass_80_columns() {
        let text = wrapped(&"word ".repeat(60), 2);
        assert!(text.lines().count() > 3 && text.lines().all(|line| line.len() <= WIDTH));
        assert!(text.lines().nth(1).unwrap().starts_with("  word"));
    }

    #[test]
    fn what_rounds_to_zero_has_no_sign() {
        assert_eq!((fixed(-0.004, 2), fixed(-0.0, 0)), ("0.00".to_owned(), "0".to_owned()));
        assert_eq!([f64::NAN, f64::INFINITY, -f64::INFINITY].map(|value| fixed(value, 2)), ["-", "-", "-"]);
        assert_eq!((fixed(-0.006, 2), fixed(-10.0, 1)), ("-0.01".to_owned(), "-10.0".to_owned()));
    }

    #[test]
    fn the_conventions_are_said() {
        let line = conventions_line(&Conventions { centre_of_gravity_height: Some(7.5), ..Conventions::default() });
        assert_eq!(
            line,
            "Coefficients on Lpp, CP on the largest section; 1.025 t/m3; MTC from GML with KG 7.5 m; x from AP; LCB from AP, + forward; \
             given: L_PP, B, T; assumed: LCB origin, density."
        );
    }
}
