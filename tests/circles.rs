//! Inside a floor imports go one way too: of the files and folders of one folder none import each other in a circle.
//!
//! A folder counts as one beside its neighbours, and its `mod.rs` is its face: what stands below may take from it, and it
//! passes on what stands below. An import of a name that a face passes on counts for the file that has it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use crate::support::{carried, read_text, sources};

/// A module below `src` by the names on the way to it.
type Module = Vec<String>;

/// Circles that are there still; none may come, and what goes is taken off the list.
const KNOWN: [&str; 15] = [
    "derivation/blend: model, weights",
    "derivation: derive, limits",
    "exchange/cad/dxf: expand, read",
    "exchange/cad/iges: faces, geometry, read",
    "exchange/cad/rhino: blocks, read",
    "exchange/cad/step: faces, geometry, read, unit",
    "exchange/table: around, assemble, boat, boat_rows, bottom, britfair, checks, delftship, ends, fields, formats, freeship, \
     ghs, heights, long, matrix, michlet, numbering, obeyed, pdstrip, pias, points, ratio, scale, seaway, sections, settings, \
     sidecar, tidy, write",
    "exchange: hull_json, hydrostatics",
    "exchange: subdivision, table",
    "fairing/field: choice, likelihood, line_errors",
    "fairing/field: density, net",
    "hull/fit: rows, transom",
    "hull/triangles: rims, shells",
    "hull: brep, mesh, triangles",
    "hull: chart, form, section",
];

/// A file: its module, its text without comments and tests, and the paths that it imports.
struct Source {
    text: String,
    /// Each with the name under which it is known here, and whether it is passed on.
    imports: Vec<(Module, String)>,
}

/// Text without comments and without the modules of tests.
fn bare(text: &str) -> String {
    let lines = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    let mut kept = String::new();
    let mut in_tests = false;
    let lines: Vec<&str> = lines.collect();
    for (k, line) in lines.iter().enumerate() {
        let begins = *line == "#[cfg(test)]"
            && lines.get(k + 1).is_some_and(|next| next.starts_with("mod ") && next.ends_with('{'));
        in_tests |= begins;
        if !in_tests {
            kept.push_str(line);
            kept.push('\n');
        }
        in_tests &= *line != "}";
    }
    kept
}

/// The paths of one tree of imports: `a::{b, c::d}` is `a::b` and `a::c::d`.
fn leaves(tree: &str) -> Vec<String> {
    let tree = tree.trim();
    let Some(open) = tree.find('{') else { return vec![tree.to_owned()] };
    let (before, inside) = (&tree[..open], tree[open + 1..].rsplit_once('}').map_or("", |(inside, _)| inside));
    let (mut depth, mut part) = (0, String::new());
    let mut parts = Vec::new();
    for c in inside.chars().chain([',']) {
        match c {
            ',' if depth == 0 => parts.push(std::mem::take(&mut part)),
            _ => {
                depth += i32::from(c == '{') - i32::from(c == '}');
                part.push(c);
            }
        }
    }
    let filled = parts.iter().filter(|part| !part.trim().is_empty());
    filled.flat_map(|part| leaves(part)).map(|leaf| format!("{before}{leaf}")).collect()
}

/// The names of a path, without `self` at its end, and the name that it has here.
fn path(leaf: &str) -> (Module, String) {
    let (path, alias) = leaf.split_once(" as ").map_or((leaf, None), |(path, alias)| (path, Some(alias.trim())));
    let mut names: Module = path.split("::").map(|name| name.trim().to_owned()).collect();
    if names.len() > 1 && names.last().is_some_and(|name| name == "self") {
        names.pop();
    }
    let own = alias.map_or_else(|| names.last().cloned().unwrap_or_default(), str::to_owned);
    (names, own)
}

fn source(text: &str) -> Source {
    let text = bare(text);
    let starts = text.match_indices("use ").map(|(at, _)| at).filter(|at| {
        let before = text[..*at].trim_end_matches(' ').chars().next_back();
        before.is_none_or(|c| c == '\n' || c == ')' || c == 'b')
    });
    let trees = starts.filter_map(|at| text[at + 4..].split_once(';').map(|(tree, _)| tree.to_owned()));
    let imports = trees.flat_map(|tree| leaves(&tree)).map(|leaf| path(&leaf)).collect();
    Source { text, imports }
}

/// All modules below a folder.
fn modules(root: &Path) -> BTreeMap<Module, Source> {
    let file = |path: std::path::PathBuf| {
        let inside = path.strip_prefix(root).unwrap().with_extension("");
        let mut names: Module = inside.components().map(|c| c.as_os_str().to_string_lossy().into_owned()).collect();
        if names.last().is_some_and(|name| name == "mod") {
            names.pop();
        }
        (names, source(&read_text(&path)))
    };
    sources(root).into_iter().map(file).collect()
}

/// The module that has what a path names, seen from a module: through the faces that pass it on.
fn resolve(all: &BTreeMap<Module, Source>, from: &Module, names: &[String], depth: usize) -> Option<Module> {
    let mut at = from.clone();
    let mut rest = names;
    match names.first()?.as_str() {
        "crate" => {
            at.clear();
            rest = &names[1..];
        }
        "self" | "super" => {
            while let Some(word @ ("self" | "super")) = rest.first().map(String::as_str) {
                if word == "super" {
                    at.pop();
                }
                rest = &rest[1..];
            }
        }
        first => {
            let below: Module = from.iter().cloned().chain([first.to_owned()]).collect();
            all.get(&below)?;
        }
    }
    while let Some((name, others)) = rest.split_first() {
        let below: Module = at.iter().cloned().chain([name.clone()]).collect();
        if all.contains_key(&below) {
            (at, rest) = (below, others);
            continue;
        }
        let passed = all.get(&at)?.imports.iter().find(|(_, own)| own == name);
        let through = passed.filter(|_| depth < 8).and_then(|(path, _)| resolve(all, &at, path, depth + 1));
        return Some(through.unwrap_or(at));
    }
    Some(at)
}

/// Paths in the code itself: `super::rows::Row`.
fn paths(text: &str) -> Vec<Module> {
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let words = text.split(|c: char| !is_name(c) && c != ':');
    let starts = |word: &&str| ["crate::", "super::", "self::"].iter().any(|start| word.starts_with(start));
    words.filter(starts).map(|word| word.split("::").map(str::to_owned).collect()).collect()
}

/// Which neighbours the files and folders of each folder take from.
fn neighbours(all: &BTreeMap<Module, Source>) -> BTreeMap<Module, BTreeMap<String, BTreeSet<String>>> {
    let mut found: BTreeMap<Module, BTreeMap<String, BTreeSet<String>>> = BTreeMap::new();
    for (module, source) in all {
        let named = source.imports.iter().map(|(path, _)| path.clone()).chain(paths(&source.text));
        for target in named.filter_map(|path| resolve(all, module, &path, 0)) {
            let common = module.iter().zip(&target).take_while(|(a, b)| a == b).count();
            if common > 0 && common < module.len() && common < target.len() {
                let folder = found.entry(module[..common].to_vec()).or_default();
                folder.entry(module[common].clone()).or_default().insert(target[common].clone());
            }
        }
    }
    found
}

/// What is reached from a neighbour.
fn reached(graph: &BTreeMap<String, BTreeSet<String>>, from: &str) -> BTreeSet<String> {
    let mut seen = BTreeSet::new();
    let mut open = vec![from.to_owned()];
    while let Some(name) = open.pop() {
        for next in graph.get(&name).into_iter().flatten() {
            if seen.insert(next.clone()) {
                open.push(next.clone());
            }
        }
    }
    seen
}

/// The circles of a folder, each with its names in order.
fn circles(graph: &BTreeMap<String, BTreeSet<String>>) -> BTreeSet<Vec<String>> {
    let reach: BTreeMap<&String, BTreeSet<String>> = graph.keys().map(|name| (name, reached(graph, name))).collect();
    let with = |name: &String| -> Vec<String> {
        let back = |other: &&String| reach[name].contains(*other) && reach.get(other).is_some_and(|r| r.contains(name));
        graph.keys().filter(back).cloned().collect()
    };
    graph.keys().map(with).filter(|circle| circle.len() > 1).collect()
}

#[test]
fn no_imports_go_in_circles() {
    let all = modules(&carried("src"));
    assert!(all.len() > 400, "only {} sources were found", all.len());
    let words = |(folder, graph): (&Module, &BTreeMap<String, BTreeSet<String>>)| {
        circles(graph)
            .into_iter()
            .map(|circle| format!("{}: {}", folder.join("/"), circle.join(", ")))
            .collect::<Vec<_>>()
    };
    let found: BTreeSet<String> = neighbours(&all).iter().flat_map(words).collect();
    let known: BTreeSet<String> = KNOWN.iter().map(|line| (*line).to_owned()).collect();
    let new: Vec<&String> = found.difference(&known).collect();
    let gone: Vec<&String> = known.difference(&found).collect();
    assert!(new.is_empty() && gone.is_empty(), "new: {new:#?}\nno longer there: {gone:#?}");
}

#[test]
fn a_circle_is_found_through_a_face() {
    let file = |text: &str| source(text);
    let name = |path: &str| path.split('/').map(str::to_owned).collect::<Module>();
    let all: BTreeMap<Module, Source> = [
        ("hull", file("mod a;\nmod b;\npub use a::First;\n")),
        ("hull/a", file("use super::b::second;\npub struct First;\n")),
        (
            "hull/b",
            file("use super::First;\npub fn second(_: First) {}\n#[cfg(test)]\nmod tests {\n    use super::c;\n}\n"),
        ),
    ]
    .into_iter()
    .map(|(path, source)| (name(path), source))
    .collect();
    let found = neighbours(&all);
    assert_eq!(circles(&found[&name("hull")]), BTreeSet::from([vec!["a".to_owned(), "b".to_owned()]]));
    assert_eq!(leaves("a::{b, c::{d, e as f}}"), ["a::b", "a::c::d", "a::c::e as f"]);
}
