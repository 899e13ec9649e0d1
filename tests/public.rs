//! The public face of the library, which is short: what `src/lib.rs` and `src/prelude.rs` name, item by item.

use crate::support::{carried, files_of, read_text, sources};

/// Most items that `cargo doc` lists.
const ITEMS: usize = 150;

/// The names of an import, `a::{B, c::D as E}` gives B and E.
fn names(import: &str) -> Vec<String> {
    let inside = import.split_once('{').map_or(import, |(_, group)| group.trim_end_matches('}'));
    let last = |path: &str| path.rsplit("::").next().map(|name| name.rsplit(" as ").next().unwrap_or(name).to_owned());
    inside.split(',').map(str::trim).filter(|path| !path.is_empty()).filter_map(last).collect()
}

/// The names of all `pub use` of a text.
fn exported(text: &str) -> Vec<String> {
    let imports = text.split("pub use ").skip(1).filter_map(|rest| rest.split(';').next());
    imports.flat_map(names).collect()
}

/// The items that a text declares as public at its outermost level; modules are none.
fn declared(text: &str) -> Vec<String> {
    let kinds = ["fn ", "struct ", "enum ", "trait ", "const ", "type "];
    let items = text.lines().filter_map(|line| line.strip_prefix("pub "));
    let named = items.filter_map(|item| kinds.iter().find_map(|kind| item.strip_prefix(kind)));
    let word = |item: &str| item.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    named.map(word).collect()
}

#[test]
fn names_are_heard() {
    let text = "pub use a::B;\npub mod m {\n    pub use a::{\n        C, d::E as F,\n    };\n}\nuse a::{G};\n";
    assert_eq!(exported(text), ["B", "C", "F"]);
    assert_eq!(declared("pub fn a<T>() {}\n    pub fn b(self) {}\npub(crate) fn c() {}\npub struct D;\n"), ["a", "D"]);
}

#[test]
fn it_is_short() {
    let (root, prelude) = (read_text(carried("src/lib.rs")), read_text(carried("src/prelude.rs")));
    let face = exported(&root);
    assert!(!face.iter().any(|name| name == "*"), "src/lib.rs names what is public item by item");
    let jobs = declared(&prelude);
    let count = face.len() + declared(&root).len() + jobs.len();
    assert!((100..=ITEMS).contains(&count), "{count} items are public, of {ITEMS} at most");
    // What the prelude hands on has its page in the face.
    for name in exported(&prelude) {
        assert!(face.contains(&name), "{name} is in the prelude alone");
    }
}

/// Blocks of Rust in README and book are parts of examples, which run.
#[test]
fn listings_are_of_the_examples() {
    let examples: Vec<String> = sources(&carried("examples")).iter().map(read_text).collect();
    let mut documents = files_of(&carried("docs/src"), "md");
    documents.push(carried("README.md"));
    let mut count = 0;
    for document in documents {
        let text = read_text(&document);
        for listing in text.split("```rust\n").skip(1).filter_map(|rest| rest.split("```").next()) {
            count += 1;
            let lines: Vec<&str> = listing.lines().map(str::trim).collect();
            let runs = |example: &String| {
                example.lines().map(str::trim).collect::<Vec<_>>().join("\n").contains(&lines.join("\n"))
            };
            assert!(examples.iter().any(runs), "{}: {listing}", document.display());
        }
    }
    assert!(count >= 2);
}
