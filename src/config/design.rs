//! What a design file means: a family with its parameters, conventions, and what is to be written.

use super::design_targets::design_targets;
use super::diagnostic::{Diagnostic, Severity};
use super::document::{Document, Raw, nearest, require};
use super::keys::{FAMILIES, FIGURES, KEYS, Kind};
use super::reference::{Reference, reference};
use crate::hull::StationNumbers;
use crate::hydrostatics::{
    CoefficientLength, Conventions, DENSITIES, GRAVITY_HEIGHTS, LcbReference, PrismaticSection, SHELL_FACTORS,
    SHELL_THICKNESSES, Shell,
};
use crate::parametric::{Family, Infeasible, analytic, ucl_cosh};
use crate::units::{NAME_REMEDY, name_fault};

/// What is to be written about the hull; what is `None` gets the default of the report. Lengths \[m\].
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    /// Draughts of the hydrostatic table.
    pub draughts: Option<Vec<f64>>,
    /// Stations of the offset table, from AP.
    pub stations: Option<Vec<f64>>,
    /// Waterlines of the offset table.
    pub waterlines: Option<Vec<f64>>,
    /// Buttocks of the heights table.
    pub buttocks: Option<Vec<f64>>,
    /// Names of the figures to draw, of [`FIGURES`].
    pub figures: Vec<&'static str>,
}

impl Default for Output {
    fn default() -> Self {
        Self { draughts: None, stations: None, waterlines: None, buttocks: None, figures: FIGURES.to_vec() }
    }
}

/// A design: what to generate and what to write about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    /// Name of the ship.
    pub name: String,
    /// Family and parameters.
    pub family: Family,
    /// Conventions of the hydrostatic tables.
    pub conventions: Conventions,
    /// What is to be written.
    pub output: Output,
    /// Published figures to stand beside those of the hull.
    pub reference: Option<Reference>,
    file: String,
    places: Vec<KeyPosition>,
    tables: Vec<KeyPosition>,
}

#[derive(Debug, Clone, PartialEq)]
struct KeyPosition {
    path: String,
    line: usize,
    column: usize,
}

impl Design {
    /// A design that does not come from a TOML file: default conventions and output.
    #[must_use]
    pub fn new(file: &str, name: &str, family: Family) -> Self {
        Self {
            name: name.to_owned(),
            family,
            conventions: Conventions::default(),
            output: Output::default(),
            reference: None,
            file: file.to_owned(),
            places: Vec::new(),
            tables: Vec::new(),
        }
    }

    /// The message of a family about some of its keys, with the place of the first of them that the file has; of the
    /// preset, or of the table, when it has none of them. An error names the keys that the file does not have.
    #[must_use]
    pub fn diagnose(&self, severity: Severity, code: &'static str, keys: &[&str], message: &str) -> Diagnostic {
        let preset = self.places.iter().find(|p| p.path == "project.preset");
        let place = keys.iter().find_map(|key| self.place(key)).or(preset).or_else(|| {
            let tables = keys.iter().filter_map(|key| KEYS.iter().find(|k| k.name == *key)).map(|k| k.table);
            // The table of the key, or the one that holds it.
            let holds = |t: &&KeyPosition, table: &str| table == t.path || table.starts_with(&format!("{}.", t.path));
            tables.filter_map(|table| self.tables.iter().rev().find(|t| holds(t, table))).next()
        });
        let absent: Vec<&str> = keys.iter().filter(|key| self.place(key).is_none()).copied().collect();
        let help = if severity == Severity::Warning || self.places.is_empty() || absent.is_empty() {
            String::new()
        } else {
            let origin = if preset.is_some() { "from the preset" } else { "a default" };
            format!("Not in the file: {} ({origin}).", absent.join(", "))
        };
        Diagnostic {
            severity,
            code,
            file: self.file.clone(),
            line: place.map(|p| p.line),
            column: place.map(|p| p.column),
            key: place.map_or_else(|| keys.first().map_or_else(String::new, |k| (*k).to_owned()), |p| p.path.clone()),
            message: message.to_owned(),
            found: String::new(),
            help,
        }
    }

    /// Every reason why the family refuses, with its place in the file. A reason that is about defaults alone follows
    /// from what the file says, and is left out beside reasons about that.
    #[must_use]
    pub fn diagnose_all(&self, reasons: &[Infeasible]) -> Vec<Diagnostic> {
        let written = |reason: &&Infeasible| reason.keys.iter().any(|key| self.place(key).is_some());
        let any = reasons.iter().any(|reason| written(&reason));
        reasons
            .iter()
            .filter(|reason| !any || written(reason))
            .map(|r| self.diagnose(Severity::Error, r.code, &r.keys, &r.message))
            .collect()
    }

    /// The place of a key, named by its path or by its last word, or of the other key that says the same thing.
    fn place(&self, key: &str) -> Option<&KeyPosition> {
        let named = |key: &str| {
            let word = last_word(key);
            self.places
                .iter()
                .find(|p| p.path.eq_ignore_ascii_case(key))
                .or_else(|| self.places.iter().find(|p| last_word(&p.path).eq_ignore_ascii_case(word)))
        };
        named(key).or_else(|| match last_word(key) {
            "Cb" => named("displacement"),
            "transom_height" => named("transom_immersion"),
            _ => None,
        })
    }
}

/// Reads a design file. `file` is its name for messages; the name of the ship defaults to its stem.
///
/// # Errors
/// Every problem of the file at once.
pub fn read(file: &str, text: &str) -> Result<Design, Vec<Diagnostic>> {
    let mut document = Document::read(file, text);
    if !document.problems.iter().any(|p| p.code == "E120") {
        let design = interpret(&mut document);
        if document.problems.is_empty() {
            return Ok(design);
        }
        let refusals = refusals(&design, &document.problems);
        document.problems.extend(refusals);
    }
    Err(document.finish())
}

/// Why the family refuses what could be read of a file with other problems; nothing where those problems may be the
/// cause.
fn refusals(design: &Design, problems: &[Diagnostic]) -> Vec<Diagnostic> {
    // Without its required numbers a family cannot say anything.
    let required = match &design.family {
        Family::Cosh(requested) => vec![requested.length],
        Family::UclCosh(p) => vec![p.length, p.breadth, p.depth, p.draught],
        Family::Wigley(d) | Family::Box(d) | Family::Ellipsoid(d) => vec![d.length, d.breadth, d.draught],
    };
    let family_unknown = problems.iter().any(|p| p.key == "project.family");
    if family_unknown || !required.iter().all(|value| value.is_finite()) {
        return Vec::new();
    }
    let words: Vec<&str> = problems.iter().map(|p| last_word(&p.key)).filter(|word| !word.is_empty()).collect();
    let caused = |key: &&'static str| {
        let given = design.place(key).is_some();
        words.iter().any(|word| {
            word.eq_ignore_ascii_case(key)
                || (!given && (*word == "preset" || nearest(word, std::iter::once(*key)).is_some()))
        })
    };
    let mut reasons = design.family.generate(&design.name).err().unwrap_or_default();
    reasons.retain(|reason| !reason.keys.iter().any(caused));
    design.diagnose_all(&reasons)
}

fn last_word(path: &str) -> &str {
    path.rsplit('.').next().unwrap_or(path)
}

fn stem(file: &str) -> &str {
    let base = file.rsplit(['/', '\\']).next().unwrap_or(file);
    base.rsplit_once('.').map_or(base, |(stem, _)| stem)
}

fn interpret(document: &mut Document<'_>) -> Design {
    document.integer("schema");
    let name = document.text("project.name").filter(|name| !name.trim().is_empty());
    if let (Some(text), Some((_, span, _))) = (&name, document.raw("project.name"))
        && let Some(fault) = name_fault(text)
    {
        document.problem("E123", "project.name", &span, fault, NAME_REMEDY.to_owned());
    }
    let family_word = match document.entry("project.family") {
        Some(_) => document.word("project.family"),
        None => Some(FAMILIES[0]),
    };
    if let Some(family) = family_word {
        refuse_other_families(document, family);
    }
    let conventions = conventions(document);
    let family = match family_word {
        Some("ucl-cosh") => Family::UclCosh(raw_parameters(document)),
        Some("wigley") => Family::Wigley(dimensions(document)),
        Some("box") => Family::Box(dimensions(document)),
        Some("ellipsoid") => Family::Ellipsoid(dimensions(document)),
        _ => Family::Cosh(Box::new(design_targets(document, conventions.density, family_word.is_some()))),
    };
    let output = output(document);
    let reference = reference(document);
    let place = |path: String, byte: usize| {
        let (line, column) = document.position(byte);
        KeyPosition { path, line, column }
    };
    let places = document.entries.iter().map(|entry| place(entry.key.path(), entry.key_span.start)).collect();
    let tables = document.tables.iter().map(|(path, byte)| place(path.clone(), *byte)).collect();
    let file = document.file.to_owned();
    Design {
        name: name.unwrap_or_else(|| stem(&file).to_owned()),
        family,
        conventions,
        output,
        reference,
        file,
        places,
        tables,
    }
}

/// Keys that the family does not have.
fn refuse_other_families(document: &mut Document<'_>, family: &str) {
    let strangers: Vec<_> = document
        .entries
        .iter()
        .filter(|e| !e.key.families.is_empty() && !e.key.families.contains(&family))
        .map(|e| (e.key.path(), e.key_span.clone(), e.key.families.join(", ")))
        .collect();
    for (path, span, families) in strangers {
        let message = format!("{path} is not a key of the family \"{family}\"");
        document.problem("E126", &path, &span, message, format!("It belongs to {families}."));
    }
}

fn conventions(document: &mut Document<'_>) -> Conventions {
    let mut conventions = Conventions::default();
    conventions.given.density = document.entry("water.density").is_some();
    conventions.given.lcb_reference = document.entry("conventions.lcb_reference").is_some();
    if let Some(density) = document.number("water.density") {
        conventions.density = density;
        if !DENSITIES.contains(&density) {
            let span = document.entry("water.density").map_or(0..0, |e| e.span.clone());
            let help = if (900.0..=1300.0).contains(&density) {
                "Write it in t/m3, or as \"1025 kg/m3\"."
            } else {
                "Sea water is 1.025 t/m3."
            };
            document.problem(
                "E124",
                "water.density",
                &span,
                format!("water.density is {density} t/m3, expected 0.9 to 1.3"),
                help.into(),
            );
        }
    }
    conventions.stations = StationNumbers {
        spaces: document.integer("conventions.stations").unwrap_or(conventions.stations.spaces),
        from_forward: document.word("conventions.station_zero") == Some("FP"),
    };
    conventions.shell = shell(document).unwrap_or(Shell::None);
    if let Some(thickness) = document.number("water.keel_thickness") {
        conventions.keel_thickness = thickness;
    }
    conventions.centre_of_gravity_height = document.number("weight.KG");
    if let Some(height) = conventions.centre_of_gravity_height.filter(|height| !GRAVITY_HEIGHTS.contains(height)) {
        let span = document.entry("weight.KG").map_or(0..0, |e| e.span.clone());
        let message =
            format!("weight.KG is {height} m, expected {} to {}", GRAVITY_HEIGHTS.start(), GRAVITY_HEIGHTS.end());
        document.problem("E124", "weight.KG", &span, message, "Write it in metres, or with its unit.".into());
    }
    if document.word("conventions.coefficient_length") == Some("Lwl") {
        conventions.coefficient_length = CoefficientLength::Waterline;
    }
    if document.word("conventions.section_for_Cp") == Some("midship") {
        conventions.prismatic_section = PrismaticSection::Midship;
    }
    if let Some(word) = document.word("conventions.lcb_reference") {
        conventions.lcb_reference =
            LcbReference::ALL.into_iter().find(|r| r.as_str() == word).unwrap_or(conventions.lcb_reference);
    }
    conventions
}

fn shell(document: &mut Document<'_>) -> Option<Shell> {
    let path = "water.shell";
    let (raw, span, kind) = document.raw(path)?;
    let Raw::Table(fields) = &raw else {
        document.unexpected(path, &raw, &span, kind);
        return None;
    };
    let of = |name: &str| -> Vec<_> { fields.iter().filter(|f| f.0.eq_ignore_ascii_case(name)).cloned().collect() };
    let others: Vec<_> = fields
        .iter()
        .filter(|f| !f.0.eq_ignore_ascii_case("thickness") && !f.0.eq_ignore_ascii_case("factor"))
        .cloned()
        .collect();
    document.fields(path, &others, ["thickness", "factor"], Kind::Length)?;
    let [thickness] = document.fields(path, &of("thickness"), ["thickness"], Kind::Length)?;
    let [factor] = document.fields(path, &of("factor"), ["factor"], Kind::Number)?;
    match (thickness, factor) {
        (Some(thickness), None) if SHELL_THICKNESSES.contains(&thickness) => Some(Shell::Thickness(thickness)),
        (None, Some(factor)) if SHELL_FACTORS.contains(&factor) => Some(Shell::Factor(factor)),
        (Some(_), Some(_)) => {
            document.problem(
                "E126",
                path,
                &span,
                "water.shell has both thickness and factor".into(),
                "Give one of them.".into(),
            );
            None
        }
        (None, None) => {
            document.unexpected(path, &raw, &span, kind);
            None
        }
        (thickness, factor) => {
            let found =
                thickness.map_or_else(|| format!("factor {}", factor.unwrap_or(0.0)), |t| format!("thickness {t} m"));
            document.problem(
                "E124",
                path,
                &span,
                format!("water.shell: {found}; expected a thickness of 0 to 1 m or a factor of 1 to 1.1"),
                String::new(),
            );
            None
        }
    }
}

fn raw_parameters(document: &mut Document<'_>) -> ucl_cosh::Parameters {
    let paths = [
        "dimensions.Lpp",
        "dimensions.B",
        "dimensions.T",
        "dimensions.D",
        "form.raw.ms",
        "form.raw.bow",
        "form.raw.transom",
        "form.raw.deck",
        "form.raw.tb",
        "form.raw.td",
        "form.raw.acu",
        "form.raw.kf",
        "form.raw.sa",
    ];
    require(document, &paths, "the family \"ucl-cosh\" is raw and has no defaults");
    let [
        length,
        breadth,
        draught,
        depth,
        midship_fullness,
        bow,
        transom_fullness,
        forward_deck,
        transom_breadth_ratio,
        transom_tip_ratio,
        aft_cut_up_ratio,
        keel_forward_ratio,
        side_slope,
    ] = paths.map(|path| document.number(path).unwrap_or(f64::NAN));
    ucl_cosh::Parameters {
        length,
        breadth,
        depth,
        draught,
        midship_fullness,
        bow,
        transom_fullness,
        forward_deck,
        transom_breadth_ratio,
        transom_tip_ratio,
        aft_cut_up_ratio,
        keel_forward_ratio,
        side_slope,
    }
}

fn dimensions(document: &mut Document<'_>) -> analytic::Dimensions {
    require(document, &["dimensions.Lpp", "dimensions.B", "dimensions.T"], "a test body needs its dimensions");
    let [length, breadth, draught] =
        ["dimensions.Lpp", "dimensions.B", "dimensions.T"].map(|path| document.number(path).unwrap_or(f64::NAN));
    let depth = document.number("dimensions.D").unwrap_or(draught);
    analytic::Dimensions { length, breadth, draught, depth }
}

fn output(document: &mut Document<'_>) -> Output {
    let defaults = Output::default();
    Output {
        draughts: document.positions("output.draughts"),
        stations: document.positions("output.stations"),
        waterlines: document.positions("output.waterlines"),
        buttocks: document.positions("output.buttocks"),
        figures: figures(document).unwrap_or(defaults.figures),
    }
}

fn figures(document: &mut Document<'_>) -> Option<Vec<&'static str>> {
    let path = "output.figures";
    let (raw, span, kind) = document.raw(path)?;
    let names: Vec<(Raw, std::ops::Range<usize>)> = match &raw {
        Raw::Array(items) => items.clone(),
        text @ Raw::Text(_) => vec![(text.clone(), span.clone())],
        other => {
            document.unexpected(path, other, &span, kind);
            return None;
        }
    };
    let mut known: Vec<&'static str> = FIGURES.to_vec();
    known.extend(["all", "none"]);
    let mut figures = Vec::new();
    for (name, at) in &names {
        let Raw::Text(text) = name else {
            document.unexpected(path, name, at, kind);
            continue;
        };
        match document.one_of(path, text, at, &known) {
            Some("all") => figures.extend(FIGURES),
            Some("none") | None => {}
            Some(figure) => figures.push(figure),
        }
    }
    // In the order of the list, each once.
    Some(FIGURES.into_iter().filter(|figure| figures.contains(figure)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn messages(text: &str) -> Vec<String> {
        read("x.toml", text).unwrap_err().iter().map(ToString::to_string).collect()
    }

    #[test]
    fn the_name_defaults_to_the_file() {
        assert_eq!(read("a/coaster.toml", "dimensions.Lpp = 80").unwrap().name, "coaster");
    }

    #[test]
    fn conventions_and_output() {
        let design = read(
            "x.toml",
            "dimensions.Lpp = 80\n[water]\nshell = { thickness = \"10 mm\" }\nkeel_thickness = \"15 mm\"\n[weight]\nKG = 6\n\
             [conventions]\ncoefficient_length = \"lwl\"\nsection_for_Cp = \"midship\"\nlcb_reference = \"fp\"\nstation_zero = \"FP\"\nstations = 10\n\
             [output]\ndraughts = { from = 1, to = 3, step = 1 }\nwaterlines = [1, \"2000 mm\"]\nfigures = [\"lines\"]",
        )
        .unwrap();
        assert_eq!(design.conventions.shell, Shell::Thickness(0.01));
        assert_eq!(design.conventions.coefficient_length, CoefficientLength::Waterline);
        assert_eq!(design.conventions.prismatic_section, PrismaticSection::Midship);
        assert_eq!(design.conventions.lcb_reference, LcbReference::ForwardPerpendicular);
        assert_eq!(design.conventions.centre_of_gravity_height, Some(6.0));
        assert_eq!(design.output.draughts.as_deref(), Some(&[1.0, 2.0, 3.0][..]));
        assert_eq!(design.output.waterlines.as_deref(), Some(&[1.0, 2.0][..]));
        assert_eq!(design.conventions.stations, StationNumbers { spaces: 10, from_forward: true });
        assert_eq!(design.output.figures, ["lines"]);
    }

    #[test]
    fn a_family_message_finds_the_line_of_its_key() {
        let design = read("hull.toml", "[dimensions]\nLpp = 80\n[form]\n  Cb = 0.85\n").unwrap();
        let shown = design.diagnose(Severity::Error, "E102", &["Cm", "Cb"], "Cb 0.85 with Cm 0.80 gives Cp 1.06 > 1.");
        assert_eq!(
            shown.to_string(),
            "E102 hull.toml:4:3 Cb 0.85 with Cm 0.80 gives Cp 1.06 > 1. Not in the file: Cm (a default)."
        );
        let shown = |severity, key| design.diagnose(severity, "E1", &[key], "no").to_string();
        assert_eq!(shown(Severity::Error, "B"), "E1 hull.toml:1:2 no. Not in the file: B (a default).");
        assert_eq!(shown(Severity::Warning, "B"), "E1 hull.toml:1:2 no");
        assert_eq!(shown(Severity::Error, "KG"), "E1 hull.toml no. Not in the file: KG (a default).");
        assert_eq!(shown(Severity::Error, "rake"), "E1 hull.toml:3:2 no. Not in the file: rake (a default).");
        let design = read("hull.toml", "project.preset = \"tug\"\ndimensions.Lpp = 80").unwrap();
        let shown = design.diagnose(Severity::Error, "E1", &["transom_height"], "no").to_string();
        assert_eq!(shown, "E1 hull.toml:1:9 no. Not in the file: transom_height (from the preset).");
    }

    #[test]
    fn all_problems_of_a_file_at_once() {
        let found =
            messages("[dimensions]\nLpp = 80\nB = \"13,2\"\n[form]\nCbb = 0.7\nCm = \"kerlin\"\n[watter]\nx = 1\n");
        assert_eq!(found.len(), 4, "{found:#?}");
        assert!(
            found[0].starts_with("E123 x.toml:3:5 dimensions.B: '13,2' has a decimal comma; write 13.2"),
            "{}",
            found[0]
        );
        assert_eq!(found[1], "E121 x.toml:5:1 form.Cbb is not a key of a design. Did you mean Cb?");
        assert_eq!(found[2], "E127 x.toml:6:6 form.Cm: \"kerlin\" is not known. Did you mean \"kerlen\"?");
        assert_eq!(found[3], "E121 x.toml:7:2 watter is not a key of a design. Did you mean water?");
    }
}
