//! The one list of keys of the design file.

/// What may stand at a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Text.
    Text,
    /// A whole number from the first to the second.
    Integer(u32, u32),
    /// A plain number or one with `%`; the value is a fraction.
    Number,
    /// A length; plain numbers are metres.
    Length,
    /// An angle; plain numbers are degrees.
    Angle,
    /// An angle; plain numbers are radians, as in `.hgf` files.
    RawAngle,
    /// A density; plain numbers are t/m^3.
    Density,
    /// A mass (plain numbers are tonnes) or a volume.
    Displacement,
    /// A fraction, plain or with `%`, of what the description says, or a length with its unit.
    FractionOrLength,
    /// One of the words.
    Word(&'static [&'static str]),
    /// A number or one of the words.
    NumberOrWord(&'static [&'static str]),
    /// Position of the centre of buoyancy.
    CentreOfBuoyancy,
    /// Two fractions, from and to.
    Interval,
    /// Positions: a list, text in list notation, or a table with from, to, step.
    Positions,
    /// Plain numbers.
    Numbers,
    /// true or false.
    Switch,
    /// An area; plain numbers only, m^2.
    Area,
    /// What the first kind takes, or one of the words.
    OrWord(&'static Kind, &'static [&'static str]),
    /// Names of stations, waterlines or cells: a list of texts and numbers.
    Names,
    /// A table from names of stations, waterlines or cells to lengths.
    NamedLengths,
    /// Section areas: a list of [x, area] or [x, area, band], m and m^2.
    SectionAreas,
    /// Texts about lines and regions; the example stands in messages.
    Phrases(&'static str),
    /// A table from places to angles; plain numbers are degrees.
    NamedAngles(&'static str),
    /// A table from lines to whole numbers.
    NamedCounts(&'static str),
    /// Shell plating: a table with thickness or factor.
    Shell,
    /// Names from the list, one or several, or `all`, or `none`.
    Figures,
}

impl Kind {
    /// What may stand there, in words.
    #[must_use]
    pub fn words(self) -> String {
        crate::config::keys::expected(self)
    }
}

/// One key of the design file.
#[derive(Debug, Clone, Copy)]
pub struct Key {
    /// Table that it stands in, with dots; empty for the top of the file.
    pub table: &'static str,
    /// The key as it is spelled.
    pub name: &'static str,
    /// What may stand there.
    pub kind: Kind,
    /// Families that have the key; empty for all.
    pub families: &'static [&'static str],
    /// What it is, with unit and default.
    pub description: &'static str,
}

impl Key {
    /// Table and key, `form.bow.rake`.
    #[must_use]
    pub fn path(&self) -> String {
        if self.table.is_empty() { self.name.to_owned() } else { format!("{}.{}", self.table, self.name) }
    }
}

/// Words for `project.family`; the first is the default.
pub const FAMILIES: [&str; 5] = ["cosh", "ucl-cosh", "wigley", "box", "ellipsoid"];
/// Other words for presets: what the type of ship is called elsewhere, and the preset that it means.
pub const PRESET_ALIASES: [(&str, &str); 5] = [
    ("tanker", "bulk-carrier"),
    ("trawler", "fishing"),
    ("ferry", "ro-ro"),
    ("coaster", "general-cargo"),
    ("cruise", "ro-ro"),
];
/// Every word that `project.preset` takes.
pub(super) const PRESET_WORDS: [&str; 13] = [
    "bulk-carrier",
    "container",
    "general-cargo",
    "ro-ro",
    "tug",
    "fishing",
    "frigate",
    "yacht",
    "tanker",
    "trawler",
    "ferry",
    "coaster",
    "cruise",
];

/// The preset that a word means: an alias gives its preset, any other word itself.
pub(super) fn preset_of(word: &str) -> &str {
    PRESET_ALIASES.iter().find(|(alias, _)| alias.eq_ignore_ascii_case(word)).map_or(word, |(_, preset)| preset)
}

/// Words for `output.figures`.
pub const FIGURES: [&str; 5] = ["lines", "sections", "sectional-area", "hydrostatics", "diagram-sheet"];

const COSH: &[&str] = &["cosh"];
const RAW: &[&str] = &["ucl-cosh"];

pub(super) const fn key(
    table: &'static str,
    name: &'static str,
    kind: Kind,
    families: &'static [&'static str],
    description: &'static str,
) -> Key {
    Key { table, name, kind, families, description }
}

/// Every key, in the order in which templates show them.
pub const KEYS: &[Key] = &[
    key("", "schema", Kind::Integer(1, 1), &[], "Version of the keys: 1."),
    key(
        "project",
        "name",
        Kind::Text,
        &[],
        "Name of the ship; it stands in every output. Default: the name of the file.",
    ),
    key(
        "project",
        "preset",
        Kind::Word(&PRESET_WORDS),
        COSH,
        "Type of ship that fills what is left out. Tanker is bulk-carrier, trawler fishing, ferry and cruise ro-ro, coaster general-cargo.",
    ),
    key("project", "family", Kind::Word(&FAMILIES), &[], "Family of the hull. Default \"cosh\"."),
    key("dimensions", "Lpp", Kind::Length, &[], "Length between perpendiculars [m]; ucl-cosh: length over all."),
    key("dimensions", "B", Kind::Length, &[], "Breadth, moulded [m]. Default for cosh: from the preset."),
    key(
        "dimensions",
        "T",
        Kind::Length,
        &[],
        "Design draught, moulded, above the base line [m]. Default for cosh: from the preset.",
    ),
    key(
        "dimensions",
        "D",
        Kind::Length,
        &[],
        "Depth to the deck at side amidships [m]. Default for cosh: from the preset; for test bodies: T.",
    ),
    key("form", "Cb", Kind::Number, COSH, "Block coefficient on Lpp. Give this or displacement."),
    key(
        "form",
        "displacement",
        Kind::Displacement,
        COSH,
        "Moulded displacement as a mass in the water of [water] [t], or a volume \"4050 m3\". Give this or Cb.",
    ),
    key(
        "form",
        "Cm",
        Kind::NumberOrWord(&["kerlen", "hsva", "benford"]),
        COSH,
        "Midship coefficient: a number, or the formula that gives it from Cb.",
    ),
    key(
        "form",
        "LCB",
        Kind::CentreOfBuoyancy,
        COSH,
        "Centre of buoyancy: \"+0.8 %\" of Lpp from midship, + forward; \"41.0 m AP\", or a length, from AP; or \"auto\".",
    ),
    key(
        "form",
        "Cwp",
        Kind::NumberOrWord(&["auto"]),
        COSH,
        "Waterplane coefficient on Lpp, or \"auto\" for what the family gives.",
    ),
    key(
        "form",
        "parallel_body",
        Kind::Interval,
        COSH,
        "Parallel middle body, from and to, as fractions of Lpp from AP.",
    ),
    key(
        "form",
        "entrance_length",
        Kind::Length,
        COSH,
        "Length of the entrance: fore end of the parallel body, or the largest section, to FP [m].",
    ),
    key(
        "form",
        "run_length",
        Kind::Length,
        COSH,
        "Length of the run: AP to the aft end of the parallel body, or to the largest section [m].",
    ),
    key("form", "bilge_radius", Kind::Length, COSH, "Radius of the bilge [m]."),
    key("form", "deadrise", Kind::Angle, COSH, "Rise of floor [deg]."),
    key("form", "keel_breadth", Kind::Length, COSH, "Breadth of the flat keel, both sides [m]."),
    key(
        "form",
        "section_character",
        Kind::Number,
        COSH,
        "Character of the sections: 0 linear, positive U, negative V.",
    ),
    key(
        "form.bow",
        "rake",
        Kind::Angle,
        COSH,
        "Rake of the stem at and above the design waterline, forward of the vertical [deg].",
    ),
    key("form.bow", "forefoot", Kind::Length, COSH, "Distance by which the stem at the keel lies aft of FP [m]."),
    key(
        "form.bow",
        "entrance_half_angle_max",
        Kind::Angle,
        COSH,
        "Largest half angle of entrance of the design waterline [deg].",
    ),
    key(
        "form.bow",
        "flare",
        Kind::Angle,
        COSH,
        "Mean flare between the design waterline and the deck at 0.9 Lpp [deg].",
    ),
    key(
        "form.stern",
        "transom_beam",
        Kind::FractionOrLength,
        COSH,
        "Breadth of the transom at the deck, a fraction of B or a length with its unit; 0 for none.",
    ),
    key(
        "form.stern",
        "transom_height",
        Kind::FractionOrLength,
        COSH,
        "Lowest point of the transom above the base line, a fraction of D or a length with its unit.",
    ),
    key(
        "form.stern",
        "transom_immersion",
        Kind::FractionOrLength,
        COSH,
        "Depth of the lowest point of the transom below the design waterline, a fraction of T or a length with its unit; instead of transom_height.",
    ),
    key("form.stern", "overhang", Kind::Length, COSH, "Distance of the transom aft of AP [m]."),
    key(
        "form.stern",
        "cut_up",
        Kind::FractionOrLength,
        COSH,
        "Where the keel starts to rise, from AP: a fraction of Lpp or a length with its unit.",
    ),
    key("form.deck", "sheer_fore", Kind::Length, COSH, "Rise of the deck at side at FP above amidships [m]."),
    key("form.deck", "sheer_aft", Kind::Length, COSH, "Rise of the deck at side at AP above amidships [m]."),
    key("form.raw", "ms", Kind::Number, RAW, "Midship fullness m, a = m pi (ms_val)."),
    key("form.raw", "bow", Kind::Number, RAW, "Bow profile m (bow_val)."),
    key("form.raw", "transom", Kind::Number, RAW, "Transom fullness m (tr_stern_val)."),
    key("form.raw", "deck", Kind::Number, RAW, "Fullness m of the forward deck line (deck_val)."),
    key("form.raw", "tb", Kind::Number, RAW, "Breadth of the transom at the deck over B (tb_val)."),
    key("form.raw", "td", Kind::Number, RAW, "Height of the transom tip over D (td_val)."),
    key("form.raw", "acu", Kind::Number, RAW, "Aft cut-up over the length (acu_val)."),
    key("form.raw", "kf", Kind::Number, RAW, "Fore end of the keel over the length (kf_val)."),
    key(
        "form.raw",
        "sa",
        Kind::RawAngle,
        RAW,
        "Slope of the transom from the vertical; a plain number is radians (sa_val).",
    ),
    key("water", "density", Kind::Density, &[], "Density of the water [t/m3]. Default 1.025."),
    key(
        "water",
        "shell",
        Kind::Shell,
        &[],
        "From moulded to extreme displacement: { thickness = \"10 mm\" } or { factor = 1.006 }. Default none.",
    ),
    key(
        "water",
        "keel_thickness",
        Kind::Length,
        &[],
        "Thickness of the keel below the base line [m]: extreme draught is moulded draught plus this. Default 0.",
    ),
    key(
        "weight",
        "KG",
        Kind::Length,
        &[],
        "Height of the centre of gravity above the base line [m]; GM and MTC use it. Default none: MTC from BM_L.",
    ),
    key(
        "conventions",
        "coefficient_length",
        Kind::Word(&["Lpp", "Lwl"]),
        &[],
        "Length that coefficients are referred to. Default \"Lpp\".",
    ),
    key(
        "conventions",
        "section_for_Cp",
        Kind::Word(&["maximum", "midship"]),
        &[],
        "Section that Cp is referred to. Default \"maximum\".",
    ),
    key(
        "conventions",
        "lcb_reference",
        Kind::Word(&["AP", "midship", "FP", "percent"]),
        &[],
        "Where the LCB on pages is measured from: metres from AP (+ forward), midship (+ forward) or FP (+ aft), or % of Lpp from midship (+ forward). Default \"AP\".",
    ),
    key(
        "conventions",
        "station_zero",
        Kind::Word(&["AP", "FP"]),
        &[],
        "Where stations are counted from in drawings. Default \"AP\".",
    ),
    key(
        "conventions",
        "stations",
        Kind::Integer(4, 200),
        &[],
        "Number of equal spaces between the perpendiculars. Default 20, with half stations at the ends.",
    ),
    key(
        "output",
        "draughts",
        Kind::Positions,
        &[],
        "Draughts of the hydrostatic table [m]: { from, to, step }, a list, or \"1:9:1\". Default 0.2 T to D in 20 to 50 rows.",
    ),
    key(
        "output",
        "stations",
        Kind::Positions,
        &[],
        "Stations of the offset table, from AP [m]. Default: those of conventions.stations.",
    ),
    key(
        "output",
        "waterlines",
        Kind::Positions,
        &[],
        "Waterlines of the offset table, above the base line [m]. Default: ten to the design draught and up to the deck.",
    ),
    key(
        "output",
        "buttocks",
        Kind::Positions,
        &[],
        "Buttocks of the heights table, from the centreplane [m]. Default: quarters of B/2.",
    ),
    key("output", "figures", Kind::Figures, &[], "Figures to draw: names, \"all\" or \"none\". Default \"all\"."),
    key("reference", "source", Kind::Text, &[], "Where published hydrostatics of the ship stand."),
    key("reference", "note", Kind::Text, &[], "What explains the differences; printed above the comparison."),
    key(
        "reference",
        "table",
        Kind::Text,
        &[],
        "Published hydrostatics, text with commas: a line of ITTC codes with T among them, then one line a draught.",
    ),
];

/// Keys that had another name before, old and new; the old one is accepted.
pub(super) const RENAMED: [(&str, &str); 1] = [("signs.price", "inflections.cost")];

/// Keys that were removed, under all their names, and the key that serves instead.
pub(super) const REMOVED: [(&str, &str); 8] = [
    ("energy.order", "fairness"),
    ("energy.anisotropy", "fairness"),
    ("energy.true_curvature", "fairness"),
    ("energy.exact_bending", "fairness"),
    ("energy.bending", "fairness"),
    ("inflections.remove", "fairness"),
    ("signs.impose", "fairness"),
    ("flat.keep", "flat.side"),
];

/// What was expected, for messages.
pub(super) fn expected(kind: Kind) -> String {
    match kind {
        Kind::Text => "a text in quotes".into(),
        Kind::Integer(from, to) if from == to => format!("{from}"),
        Kind::Integer(from, to) => format!("a whole number from {from} to {to}"),
        Kind::Number => "a number".into(),
        Kind::Length => "a length: metres, or a text with a unit as \"32250 mm\" or \"62 ft 3 in\"".into(),
        Kind::Angle => "an angle: degrees, or a text with a unit as \"12 deg\"".into(),
        Kind::RawAngle => "an angle: radians, or a text with a unit as \"7.5 deg\"".into(),
        Kind::Density => "a density: t/m3, or a text with a unit as \"1025 kg/m3\"".into(),
        Kind::Displacement => "tonnes, or a text with a unit as \"4050 t\" or \"3951 m3\"".into(),
        Kind::FractionOrLength => "a fraction, or a length with its unit as \"3.2 m\"".into(),
        Kind::Word(words) => format!("one of \"{}\"", words.join("\", \"")),
        Kind::NumberOrWord(words) => format!("a number or one of \"{}\"", words.join("\", \"")),
        Kind::CentreOfBuoyancy => "\"+0.8 %\" (of Lpp from midship, + forward), \"41.0 m AP\" or \"auto\"".into(),
        Kind::Interval => "two fractions of Lpp from AP, as [0.42, 0.58]".into(),
        Kind::Positions => "{ from = 1, to = 9, step = 1 }, a list of lengths, or \"1:9:1\"".into(),
        Kind::Shell => "{ thickness = \"10 mm\" } or { factor = 1.006 }".into(),
        Kind::Numbers => "a list of numbers, as [0, 0, 1, 2, 2]".into(),
        Kind::Switch => "true or false".into(),
        Kind::Area => "an area: square metres, or a text with a unit as \"1103 m2\"".into(),
        Kind::OrWord(inner, words) => format!("{}; or one of \"{}\"", expected(*inner), words.join("\", \"")),
        Kind::Names => "a list of names, as [\"5\", \"9 1/2\"]; a cell is \"station@waterline\"".into(),
        Kind::NamedLengths => "a table of names with lengths, as { \"5\" = \"2 mm\" }".into(),
        Kind::SectionAreas => {
            "a list of [x, area] or [x, area, band], m and m2, the name of a CSV file, or \"table\"".into()
        }
        Kind::Phrases(example) => format!("a list of texts, as [{example}]"),
        Kind::NamedAngles(example) => format!("a table of places with angles, as {{ {example} }}"),
        Kind::NamedCounts(example) => format!("a table of lines with whole numbers, as {{ {example} }}"),
        Kind::Figures => format!("\"all\", \"none\" or names of {}", FIGURES.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parametric::ShipType;

    #[test]
    fn presets_are_those_of_the_families() {
        let names = ShipType::ALL.map(ShipType::as_str);
        assert_eq!(names, PRESET_WORDS[..names.len()]);
        assert_eq!(PRESET_ALIASES.map(|(alias, _)| alias), PRESET_WORDS[names.len()..]);
        for (alias, preset) in PRESET_ALIASES {
            assert!(names.contains(&preset) && preset_of(alias) == preset && preset_of(preset) == preset);
        }
    }

    #[test]
    fn paths_are_unique_whatever_the_case() {
        let mut paths: Vec<String> = KEYS.iter().map(|key| key.path().to_lowercase()).collect();
        paths.sort();
        paths.dedup();
        assert_eq!(paths.len(), KEYS.len());
    }
}
