//! The method file: how a table of offsets becomes a surface, and which table.
//!
//! ```toml
//! table = "grid.csv"        # beside the method file; may be left out when the command names one
//! [method]
//! kind = "least-squares"
//! order_along = 3
//! ```

use super::diagnostic::{Diagnostic, Severity};
use super::document::Document;
use super::keys::{Key, Kind, key};
use crate::hull::{
    FitMethod, LeastSquares, NetKnots, ParametricStations, QuadraticNet, SettingProblem, StatedParticulars,
    UniformBicubic,
};
use crate::spline::{MAX_DEGREE, Parametrization};

/// Words for `method.kind`.
pub const METHODS: [&str; 6] =
    ["graded", "bilinear", "least-squares", "uniform-bicubic", "quadratic-net", "parametric-stations"];

const LEAST_SQUARES: &[&str] = &["least-squares"];
const UNIFORM: &[&str] = &["uniform-bicubic"];
const NET: &[&str] = &["quadratic-net"];
const STATIONS: &[&str] = &["parametric-stations"];
const ORDERS: Kind = Kind::Integer(2, MAX_DEGREE as u32 + 1);
const COUNT: Kind = Kind::Integer(2, 10_000);
const PARTS: Kind = Kind::Integer(1, 1000);
const NET_KNOTS: [&str; 2] = ["open-uniform", "midpoints"];
const PARAMETRIZATIONS: [&str; 3] = ["chord-length", "centripetal", "uniform"];

/// Every key of the method file. `families` of a key are the methods that have it.
pub const METHOD_KEYS: &[Key] = &[
    key("", "schema", Kind::Integer(1, 1), &[], "Version of the keys: 1."),
    key(
        "",
        "table",
        Kind::Text,
        &[],
        "Table of offsets, relative to this file. Default: the one that the command names.",
    ),
    key("dimensions", "Lpp", Kind::Length, &[], "L_PP, over what the table states."),
    key("dimensions", "B", Kind::Length, &[], "B moulded, over what the table states."),
    key("dimensions", "T", Kind::Length, &[], "Design draught, over what the table states."),
    key("dimensions", "D", Kind::Length, &[], "Depth to the deck at side, over what the table states."),
    key("method", "kind", Kind::Word(&METHODS), &[], "The method; `graded` is the default of the program."),
    key("method", "order_along", ORDERS, LEAST_SQUARES, "Order along the hull, degree + 1. Default: 3."),
    key("method", "order_up", ORDERS, LEAST_SQUARES, "Order up the hull, degree + 1. Default: 3."),
    key(
        "method",
        "control_points_along",
        COUNT,
        LEAST_SQUARES,
        "Control points along the hull. Default: as the knots have, or three quarters of the stations.",
    ),
    key(
        "method",
        "control_points_up",
        COUNT,
        LEAST_SQUARES,
        "Control points up the hull. Default: as the knots have, or three quarters of the waterlines.",
    ),
    key(
        "method",
        "knots_along",
        Kind::Numbers,
        LEAST_SQUARES,
        "Knots along the hull, clamped or not; more than control points + order are left out. Default: by the parameters.",
    ),
    key(
        "method",
        "knots_up",
        Kind::Numbers,
        LEAST_SQUARES,
        "Knots up the hull, clamped or not; more than control points + order are left out. Default: by the parameters.",
    ),
    key(
        "method",
        "parameters_along",
        Kind::Numbers,
        LEAST_SQUARES,
        "Parameter of each station. Default: in proportion to x.",
    ),
    key(
        "method",
        "parameters_up",
        Kind::Numbers,
        LEAST_SQUARES,
        "Parameter of each waterline. Default: in proportion to z.",
    ),
    key(
        "method",
        "knuckle_waterlines",
        Kind::Positions,
        UNIFORM,
        "Waterlines of the table where two surfaces meet C0. Default: none.",
    ),
    key(
        "method",
        "knuckle_stations",
        Kind::Positions,
        UNIFORM,
        "Stations of the table where two surfaces meet C0. Default: none.",
    ),
    key("method", "knots", Kind::Word(&NET_KNOTS), NET, "Rule of the knots. Default: \"open-uniform\"."),
    key(
        "method",
        "split_stations",
        Kind::Positions,
        NET,
        "Stations of the table where one surface ends and the next begins. Default: none.",
    ),
    key("method", "order", ORDERS, STATIONS, "Order of waterlines, columns and surface, degree + 1. Default: 3."),
    key("method", "parts_along", PARTS, STATIONS, "Equal parts of each waterline. Default: stations + 1."),
    key("method", "parts_up", PARTS, STATIONS, "Equal parts of each column. Default: waterlines - 1."),
    key(
        "method",
        "parametrization",
        Kind::Word(&PARAMETRIZATIONS),
        STATIONS,
        "How parameters follow from points. Default: \"chord-length\".",
    ),
];

/// What a method file says.
#[derive(Debug, Clone, PartialEq)]
pub struct MethodFile {
    /// The method with its settings.
    pub method: FitMethod,
    /// The table of offsets, relative to the file; none when the file does not name one.
    pub table: Option<String>,
    /// Main dimensions that override those of the table.
    pub stated: StatedParticulars,
    file: String,
    /// Keys with line and column.
    places: Vec<(String, usize, usize)>,
}

impl MethodFile {
    /// A method with its default settings that no file describes.
    #[must_use]
    pub fn new(method: FitMethod) -> Self {
        Self { method, table: None, stated: StatedParticulars::default(), file: String::new(), places: Vec::new() }
    }

    /// Problems of settings with the places of their keys, or of the kind where the file does not have the key. The file
    /// is `table` when no file describes the method.
    #[must_use]
    pub fn diagnose(&self, problems: &[SettingProblem], table: &str) -> Vec<Diagnostic> {
        let place = |key: &str| self.places.iter().find(|p| p.0.eq_ignore_ascii_case(&format!("method.{key}")));
        let message = |problem: &SettingProblem| {
            let at = place(problem.key).or_else(|| place("kind"));
            Diagnostic {
                severity: Severity::Error,
                code: "E160",
                file: if self.file.is_empty() { table.to_owned() } else { self.file.clone() },
                line: at.map(|p| p.1),
                column: at.map(|p| p.2),
                key: format!("method.{}", problem.key),
                message: format!("method.{}: {}", problem.key, problem.message),
                found: String::new(),
                help: problem.help.clone(),
            }
        };
        problems.iter().map(message).collect()
    }
}

/// Reads a method file. `file` is its name for messages.
///
/// # Errors
/// Every problem of the file at once.
pub fn read_method(file: &str, text: &str) -> Result<MethodFile, Vec<Diagnostic>> {
    let mut document = Document::with_keys(file, text, METHOD_KEYS, "a method");
    if !document.problems.iter().any(|p| p.code == "E120") {
        let method = interpret(&mut document);
        if document.problems.is_empty() {
            return Ok(method);
        }
    }
    Err(document.finish())
}

fn interpret(document: &mut Document<'_>) -> MethodFile {
    document.integer("schema");
    let kind = document.word("method.kind");
    if document.entry("method.kind").is_none() {
        let message = format!("method.kind missing: one of \"{}\"", METHODS.join("\", \""));
        document.whole_file("E125", message);
    }
    if let Some(kind) = kind {
        refuse_other_methods(document, kind);
    }
    let table = document.text("table");
    let mut length = |path: &str| {
        let value = document.number(path)?;
        if value > 0.0 {
            return Some(value);
        }
        let span = document.entry(path).map_or(0..0, |e| e.span.clone());
        document.problem("E124", path, &span, format!("{path} is {value} m"), "Expected a positive length.".into());
        None
    };
    let stated = StatedParticulars {
        length_between_perpendiculars: length("dimensions.Lpp"),
        breadth: length("dimensions.B"),
        draught: length("dimensions.T"),
        depth: length("dimensions.D"),
    };
    // What belongs to another method was refused above; here everything is read, so that every problem is found.
    let least_squares = least_squares(document);
    let uniform = UniformBicubic {
        knuckle_waterlines: document.positions("method.knuckle_waterlines").unwrap_or_default(),
        knuckle_stations: document.positions("method.knuckle_stations").unwrap_or_default(),
    };
    let net = QuadraticNet {
        knots: match document.word("method.knots") {
            Some("midpoints") => NetKnots::Midpoints,
            _ => NetKnots::OpenUniform,
        },
        split_stations: document.positions("method.split_stations").unwrap_or_default(),
    };
    let stations = parametric_stations(document);
    let method = match kind {
        Some("bilinear") => FitMethod::Bilinear,
        Some("least-squares") => FitMethod::LeastSquares(least_squares),
        Some("uniform-bicubic") => FitMethod::UniformBicubic(uniform),
        Some("quadratic-net") => FitMethod::QuadraticNet(net),
        Some("parametric-stations") => FitMethod::ParametricStations(stations),
        _ => FitMethod::Graded,
    };
    let places = document.entries.iter().map(|entry| {
        let (line, column) = document.position(entry.key_span.start);
        (entry.key.path(), line, column)
    });
    MethodFile { method, table, stated, file: document.file.to_owned(), places: places.collect() }
}

fn least_squares(document: &mut Document<'_>) -> LeastSquares {
    let default = LeastSquares::default();
    let paths = |name: &str| [format!("method.{name}_along"), format!("method.{name}_up")];
    let [orders, counts, knots, parameters] = ["order", "control_points", "knots", "parameters"].map(paths);
    let whole = |number: u32| number as usize;
    LeastSquares {
        orders: [0, 1].map(|side| document.integer(&orders[side]).map_or(default.orders[side], whole)),
        control_points: [0, 1].map(|side| document.integer(&counts[side]).map(whole)),
        knots: [0, 1].map(|side| document.numbers(&knots[side])),
        parameters: [0, 1].map(|side| document.numbers(&parameters[side])),
    }
}

fn parametric_stations(document: &mut Document<'_>) -> ParametricStations {
    let default = ParametricStations::default();
    let whole = |number: u32| number as usize;
    ParametricStations {
        order: document.integer("method.order").map_or(default.order, whole),
        parts_along: document.integer("method.parts_along").map(whole),
        parts_up: document.integer("method.parts_up").map(whole),
        parametrization: match document.word("method.parametrization") {
            Some("uniform") => Parametrization::Uniform,
            Some("centripetal") => Parametrization::Centripetal,
            _ => default.parametrization,
        },
    }
}

/// Keys that the method does not have.
fn refuse_other_methods(document: &mut Document<'_>, kind: &str) {
    let strangers: Vec<_> = document
        .entries
        .iter()
        .filter(|e| !e.key.families.is_empty() && !e.key.families.contains(&kind))
        .map(|e| (e.key.path(), e.key_span.clone(), e.key.families.join(", ")))
        .collect();
    for (path, span, methods) in strangers {
        let message = format!("{path} is not a key of the method \"{kind}\"");
        document.problem("E126", &path, &span, message, format!("It belongs to {methods}."));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn messages(text: &str) -> Vec<String> {
        read_method("m.toml", text).unwrap_err().iter().map(ToString::to_string).collect()
    }

    #[test]
    fn the_words_are_those_of_the_methods() {
        let words: Vec<&str> = FitMethod::all().iter().map(FitMethod::as_str).collect();
        assert_eq!(words, METHODS);
        for method in FitMethod::all() {
            let text = format!("[method]\nkind = \"{}\"", method.as_str());
            assert_eq!(read_method("m.toml", &text).unwrap().method, method);
        }
    }

    #[test]
    fn every_setting_is_read() {
        let text = "table = \"grid.csv\"\n[dimensions]\nT = \"2500 mm\"\n[method]\nkind = \"least-squares\"\norder_up = 4\n\
                    control_points_along = 4\nknots_along = [0, 0, 0, 1, 2, 2, 2]\nparameters_up = [0, 1.5]";
        let file = read_method("m.toml", text).unwrap();
        assert_eq!((file.table.as_deref(), file.stated.draught), (Some("grid.csv"), Some(2.5)));
        let expected = LeastSquares {
            orders: [3, 4],
            control_points: [Some(4), None],
            knots: [Some(vec![0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0]), None],
            parameters: [None, Some(vec![0.0, 1.5])],
        };
        assert_eq!(file.method, FitMethod::LeastSquares(expected));
        let text = "[method]\nkind = \"parametric-stations\"\norder = 4\nparts_along = 20\nparts_up = 9\nparametrization = \"uniform\"";
        let expected = ParametricStations {
            order: 4,
            parts_along: Some(20),
            parts_up: Some(9),
            parametrization: Parametrization::Uniform,
        };
        assert_eq!(read_method("m.toml", text).unwrap().method, FitMethod::ParametricStations(expected));
        let text = "[method]\nkind = \"quadratic-net\"\nknots = \"midpoints\"\nsplit_stations = [\"10 m\"]";
        let expected = QuadraticNet { knots: NetKnots::Midpoints, split_stations: vec![10.0] };
        assert_eq!(read_method("m.toml", text).unwrap().method, FitMethod::QuadraticNet(expected));
        let text = "[method]\nkind = \"uniform-bicubic\"\nknuckle_waterlines = [1.3]\nknuckle_stations = \"2.1,4.2\"";
        let expected = UniformBicubic { knuckle_waterlines: vec![1.3], knuckle_stations: vec![2.1, 4.2] };
        assert_eq!(read_method("m.toml", text).unwrap().method, FitMethod::UniformBicubic(expected));
    }

    #[test]
    fn all_problems_of_a_file_at_once() {
        let found = messages(
            "tabel = \"a.csv\"\ndimensions.T = -2\n[method]\nkind = \"bilinear\"\nknots_along = [0, \"a\"]\norder = 99\nkontrol = 1",
        );
        let expected = [
            "E121 m.toml:1:1 tabel is not a key of a method. Did you mean table?",
            "E124 m.toml:2:16 dimensions.T is -2 m. Expected a positive length.",
            "E126 m.toml:5:1 method.knots_along is not a key of the method \"bilinear\". It belongs to least-squares.",
            "E122 m.toml:5:19 method.knots_along is \"a\", expected a number",
            "E126 m.toml:6:1 method.order is not a key of the method \"bilinear\". It belongs to parametric-stations.",
            "E122 m.toml:6:9 method.order is 99, expected a whole number from 2 to 8",
            "E121 m.toml:7:1 method.kontrol is not a key of a method. Known here: kind,",
        ];
        assert_eq!(found.len(), expected.len(), "{found:#?}");
        for (found, expected) in found.iter().zip(expected) {
            assert!(found.starts_with(expected), "{found}\n{expected}");
        }
        assert!(messages("")[0].starts_with("E125 m.toml method.kind missing: one of \"graded\", \"bilinear\""));
        let found = messages("[method]\nkind = \"bilinaer\"");
        assert_eq!(found, ["E127 m.toml:2:8 method.kind: \"bilinaer\" is not known. Did you mean \"bilinear\"?"]);
        assert!(messages("[method]\nkind = \"least-squares\"\nknots_up = 3")[0].contains("expected a list of numbers"));
        assert!(messages("a = ")[0].starts_with("E120 m.toml:1"));
    }

    #[test]
    fn problems_with_a_table_find_their_key() {
        let file = read_method("m.toml", "[method]\nkind = \"least-squares\"\nknots_up = [1]").unwrap();
        let problem = |key| SettingProblem { key, message: "no".into(), help: "Yes.".into() };
        let shown: Vec<String> = file
            .diagnose(&[problem("knots_up"), problem("order_up")], "t.csv")
            .iter()
            .map(ToString::to_string)
            .collect();
        assert_eq!(shown, ["E160 m.toml:3:1 method.knots_up: no. Yes.", "E160 m.toml:2:1 method.order_up: no. Yes."]);
        let shown = MethodFile::new(FitMethod::Bilinear).diagnose(&[problem("kind")], "t.csv")[0].to_string();
        assert_eq!(shown, "E160 t.csv method.kind: no. Yes.");
    }
}
