//! A module imports only from floors strictly below its own: never sideways, never upwards, never through the crate root.
//! Floors are private; `internals` has all of them for what stands outside the library.

use crate::support::{carried, read_text, sources};

/// Every module with its floor.
const FLOORS: [(&str, usize); 18] = [
    ("numeric", 0),
    ("units", 0),
    ("spline", 1),
    ("qp", 1),
    ("hull", 2),
    ("hydrostatics", 3),
    ("parametric", 4),
    ("resistance", 3),
    ("fairing", 4),
    ("derivation", 5),
    ("config", 5),
    ("exchange", 5),
    ("plot", 5),
    ("report", 6),
    ("cli", 7),
    ("prelude", 7),
    ("internals", 8),
    ("main", 9),
];

fn floor(module: &str) -> Option<usize> {
    FLOORS.iter().find(|(name, _)| *name == module).map(|(_, floor)| *floor)
}

/// The code of a line without its comment; good enough for sources without `//` in strings before an import.
fn code(line: &str) -> &str {
    let trimmed = line.trim_start();
    if trimmed.starts_with("//") { "" } else { trimmed.split(" // ").next().unwrap_or(trimmed) }
}

/// The first names after every `crate::` of a text, groups included: `crate::{hull::Hull, spline}` gives both. From
/// outside a floor is a module of `internals`.
fn names(text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for marker in ["crate::", "loftsman::internals::"] {
        for (at, _) in text.match_indices(marker) {
            let before = text[..at].chars().next_back();
            if before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == '$') {
                continue;
            }
            let line = text[..at].matches('\n').count() + 1;
            let rest = text[at + marker.len()..].trim_start();
            let word = |s: &str| s.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
            match rest.strip_prefix('{') {
                None => found.push((line, word(rest))),
                Some(group) => {
                    let (mut depth, mut expect) = (1, true);
                    for (index, c) in group.char_indices() {
                        match c {
                            '{' => depth += 1,
                            '}' => depth -= 1,
                            ',' if depth == 1 => expect = true,
                            c if expect && !c.is_whitespace() => {
                                expect = false;
                                found.push((line, word(&group[index..])));
                            }
                            _ => {}
                        }
                        if depth == 0 {
                            break;
                        }
                    }
                }
            }
        }
    }
    found
}

/// Breaches of the rule in one file of `module`, as `file:line: what`.
fn breaches(module: &str, file: &str, source: &str) -> Vec<String> {
    let Some(own) = floor(module) else { return vec![format!("{file}:1: module {module} has no floor")] };
    let text: String = source.lines().map(|line| format!("{}\n", code(line))).collect();
    names(&text)
        .into_iter()
        .filter(|(_, name)| name != module)
        .filter_map(|(line, name)| match floor(&name) {
            None => Some(format!("{file}:{line}: crate::{name} hides its floor; import it from its module")),
            Some(other) if other >= own => {
                Some(format!("{file}:{line}: {module} (floor {own}) imports {name} (floor {other})"))
            }
            Some(_) => None,
        })
        .collect()
}

#[test]
fn every_import_goes_down() {
    let root = carried("src");
    let mut found = Vec::new();
    let mut count = 0;
    for path in sources(&root) {
        let inside = path.strip_prefix(&root).unwrap();
        let first = inside.components().next().unwrap().as_os_str().to_string_lossy().into_owned();
        let module = first.trim_end_matches(".rs");
        if module == "lib" {
            continue;
        }
        count += 1;
        found.extend(breaches(module, &format!("src/{}", inside.display()), &read_text(&path)));
    }
    assert!(count > 40, "only {count} sources were found");
    assert!(found.is_empty(), "\n{}", found.join("\n"));
}

/// What is no floor of the library: what stands above it.
const ABOVE: [&str; 3] = ["prelude", "internals", "main"];

#[test]
fn every_floor_is_private_and_open_to_tests() {
    let (root, internals) = (read_text(carried("src/lib.rs")), read_text(carried("src/internals.rs")));
    for (module, _) in FLOORS.iter().filter(|(module, _)| !ABOVE.contains(module)) {
        assert!(root.contains(&format!("\nmod {module};\n")), "{module} is not private in src/lib.rs");
        let open = format!("pub mod {module} {{\n    pub use crate::{module}::*;\n}}\n");
        assert!(internals.contains(&open), "{module} is not in src/internals.rs");
    }
    assert!(root.contains("#[doc(hidden)]\npub mod internals;\n"));
}

/// A file that `tests/integration.rs` does not name would never be compiled.
#[test]
fn every_file_of_the_tests_is_a_module() {
    let modules = read_text(carried("tests/integration.rs"));
    for path in sources(&carried("tests")) {
        let file = if path.ends_with("mod.rs") { path.parent().unwrap() } else { &path };
        let name = file.file_stem().unwrap().display();
        let top = file.parent().is_some_and(|folder| folder.ends_with("tests")) && !file.ends_with("integration.rs");
        assert!(!top || modules.contains(&format!("\nmod {name};")), "{name}");
    }
}

#[test]
fn downward_imports_pass() {
    let source = "use crate::spline::Curve;\nuse super::quantity;\nuse crate::{numeric::root, hull::Hull};\nlet x = crate::hull::y();\n// use crate::cli;\n";
    assert_eq!(breaches("hydrostatics", "a.rs", source), Vec::<String>::new());
    assert_eq!(breaches("main", "main.rs", "loftsman::internals::cli::run()"), Vec::<String>::new());
}

#[test]
fn every_kind_of_breach_is_found_with_its_line() {
    let one = |module: &str, source: &str| breaches(module, "a.rs", source).join("; ");
    assert_eq!(
        one("hull", "\n\nuse crate::parametric::Family;"),
        "a.rs:3: hull (floor 2) imports parametric (floor 4)"
    );
    assert_eq!(one("config", "use crate::plot::Figure;"), "a.rs:1: config (floor 5) imports plot (floor 5)");
    assert_eq!(one("cli", "use crate::Hull;"), "a.rs:1: crate::Hull hides its floor; import it from its module");
    assert_eq!(one("hull", "use crate::{spline::A, cli::{B, C}};"), "a.rs:1: hull (floor 2) imports cli (floor 7)");
    assert_eq!(
        one("hull", "use crate::{\n    spline,\n    report,\n};"),
        "a.rs:1: hull (floor 2) imports report (floor 6)"
    );
    assert_eq!(one("spline", "fn f() { crate::hull::g() }"), "a.rs:1: spline (floor 1) imports hull (floor 2)");
    assert_eq!(
        one("prelude", "use crate::internals::hull::Hull;"),
        "a.rs:1: prelude (floor 7) imports internals (floor 8)"
    );
    assert_eq!(one("utils", ""), "a.rs:1: module utils has no floor");
}
