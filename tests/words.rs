//! Words that the glossary of `CONTRIBUTING.md` bars stand in no document, help text, message or rustdoc. Identifiers
//! are exempt: code spans and code blocks, and placeholders of messages.

use std::ops::Range;
use std::path::Path;

use crate::support::{carried, commands, files_of, program, read_text, sources, stdout};

/// Barred words with their forms; words of a phrase may stand on two lines.
const BARRED: [&[&str]; 10] = [
    &["wish", "wishes", "wished", "wishing"],
    &["lobe", "lobes"],
    &["can be had", "cannot be had", "could be had", "can all be had", "cannot all be had", "to be had"],
    &["is told", "are told"],
    &["stands over", "stand over"],
    &["net of its own", "nets of their own"],
    &["gives way", "give way", "gave way", "given way"],
    &["step of the writing", "steps of the writing", "step of its writing", "steps of its writing"],
    &["by waves"],
    &["said"],
];

/// Folders whose rustdoc is not looked at yet, their messages are: they are being rewritten with the words of the
/// glossary.
const REWRITTEN: [&str; 2] = ["src/fairing/", "src/hull/fit/"];

/// The words of a text with the bytes where they stand.
fn words(text: &str) -> Vec<(usize, String)> {
    let mut words = Vec::new();
    let mut start = None;
    for (at, character) in text.char_indices().chain([(text.len(), ' ')]) {
        let inside = character.is_alphanumeric() || character == '_';
        match start {
            None if inside => start = Some(at),
            Some(from) if !inside => {
                words.push((from, text[from..at].to_lowercase()));
                start = None;
            }
            _ => {}
        }
    }
    words
}

/// The barred words of a text, with the bytes where they stand.
fn barred(text: &str) -> Vec<(usize, &'static str)> {
    let words = words(text);
    let phrases: Vec<(&str, Vec<&str>)> =
        BARRED.iter().flat_map(|forms| forms.iter()).map(|form| (*form, form.split(' ').collect())).collect();
    let mut found = Vec::new();
    for (index, (at, _)) in words.iter().enumerate() {
        let here = |parts: &[&str]| {
            parts.iter().enumerate().all(|(k, part)| words.get(index + k).is_some_and(|(_, word)| word == part))
        };
        found.extend(phrases.iter().filter(|(_, parts)| here(parts)).map(|(form, _)| (*at, *form)));
    }
    found
}

/// `text` with blanks instead of these bytes; lines stay.
fn blanked(text: &str, parts: &[Range<usize>]) -> String {
    let inside = |at: usize| parts.iter().any(|part| part.contains(&at));
    text.char_indices()
        .map(|(at, c)| if c != '\n' && inside(at) { " ".repeat(c.len_utf8()) } else { c.into() })
        .collect()
}

/// Markdown without its code spans and code blocks.
fn prose(markdown: &str) -> String {
    let (mut parts, mut block, mut start) = (Vec::new(), false, 0);
    for line in markdown.split_inclusive('\n') {
        let fence = line.trim_start().starts_with("```");
        if fence || block {
            parts.push(start..start + line.len());
        }
        block ^= fence;
        start += line.len();
    }
    let without = blanked(markdown, &parts);
    let ticks: Vec<usize> = without.match_indices('`').map(|(at, _)| at).collect();
    let spans: Vec<Range<usize>> = ticks.chunks_exact(2).map(|pair| pair[0]..pair[1] + 1).collect();
    blanked(&without, &spans)
}

/// A piece of a source file: its bytes, and whether it is documentation or else a string.
struct Piece {
    bytes: Range<usize>,
    documentation: bool,
}

/// Doc comments and string literals of a source file; neighbouring lines of a doc comment are one piece.
fn pieces(source: &str) -> Vec<Piece> {
    let bytes = source.as_bytes();
    let find = |from: usize, what: &str| source[from..].find(what).map_or(source.len(), |at| from + at);
    let mut pieces: Vec<Piece> = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let rest = &source[at..];
        let name_before = at > 0 && (bytes[at - 1].is_ascii_alphanumeric() || bytes[at - 1] == b'_');
        let raw = rest.strip_prefix('r').map(|after| after.bytes().take_while(|b| *b == b'#').count());
        if rest.starts_with("//") {
            let end = find(at, "\n");
            let documentation = rest.starts_with("//!") || rest.starts_with("///") && !rest.starts_with("////");
            if documentation {
                match pieces.last_mut() {
                    Some(last) if last.documentation && source[last.bytes.end..at].trim().is_empty() => {
                        last.bytes.end = end;
                    }
                    _ => pieces.push(Piece { bytes: at..end, documentation }),
                }
            }
            at = end;
        } else if rest.starts_with("/*") {
            at = find(at, "*/") + 2;
        } else if let Some(signs) = raw.filter(|n| !name_before && rest[1 + n..].starts_with('"')) {
            let end = find(at + signs + 2, &format!("\"{}", "#".repeat(signs)));
            pieces.push(Piece { bytes: at + signs + 2..end, documentation: false });
            at = end + 1 + signs;
        } else if rest.starts_with('"') {
            let mut end = at + 1;
            while end < bytes.len() && bytes[end] != b'"' {
                end += if bytes[end] == b'\\' { 2 } else { 1 };
            }
            pieces.push(Piece { bytes: at + 1..end, documentation: false });
            at = end + 1;
        } else if rest.starts_with('\'') {
            // A character, or a lifetime.
            let mut characters = rest.char_indices().skip(1);
            let (first, second) = (characters.next(), characters.next());
            at += match (first, second) {
                (Some((_, '\\')), _) => rest[3..].find('\'').map_or(1, |end| end + 4),
                (Some(_), Some((end, '\''))) => end + 1,
                _ => 1,
            };
        } else {
            at += rest.chars().next().map_or(1, char::len_utf8);
        }
    }
    pieces
}

/// A string without its placeholders, escapes and the breaks of its lines.
fn message(literal: &str) -> String {
    let mut parts = Vec::new();
    for (open, _) in literal.match_indices('{') {
        let inside = literal[open + 1..].split('}').next().unwrap_or_default();
        if inside.len() < literal.len() - open - 1 && !inside.contains([' ', '{', '\n']) {
            parts.push(open..open + inside.len() + 2);
        }
    }
    parts.extend(literal.match_indices('\\').map(|(at, _)| at..at + 2));
    blanked(literal, &parts)
}

/// The barred words of a source file, with their lines; `documented` says whether its rustdoc counts.
fn in_source(source: &str, documented: bool) -> Vec<(usize, &'static str)> {
    let mut found = Vec::new();
    for piece in pieces(source).into_iter().filter(|piece| documented || !piece.documentation) {
        let text = &source[piece.bytes.clone()];
        let text = if piece.documentation {
            let signs = ["///", "//!"].iter().flat_map(|sign| text.match_indices(sign)).map(|(at, _)| at..at + 3);
            prose(&blanked(text, &signs.collect::<Vec<_>>()))
        } else {
            message(text)
        };
        found.extend(barred(&text).into_iter().map(|(at, form)| (line(source, piece.bytes.start + at), form)));
    }
    found
}

fn line(text: &str, at: usize) -> usize {
    text.as_bytes()[..at].iter().filter(|byte| **byte == b'\n').count() + 1
}

/// `CONTRIBUTING.md` without what its glossary bars: the last column, and the line that lists the barred words.
fn without_the_last_column(text: &str) -> String {
    let kept = |line: &str| match line.trim_end().strip_suffix('|').and_then(|row| row.rfind('|')) {
        _ if line.starts_with("Barred everywhere:") => String::new(),
        Some(last) => line[..=last].to_owned(),
        None => line.to_owned(),
    };
    text.lines().map(|line| kept(line) + "\n").collect()
}

fn listed(name: &str, found: Vec<(usize, &str)>) -> Vec<String> {
    found.into_iter().map(|(line, form)| format!("{name}:{line}: \"{form}\"")).collect()
}

#[test]
fn barred_words_stand_nowhere() {
    let root = carried("");
    let mut faults = Vec::new();
    let mut documents =
        ["README.md", "CONTRIBUTING.md", "ARCHITECTURE.md", "RELEASING.md"].map(ToOwned::to_owned).to_vec();
    let all = [("docs", "md"), ("docs", "toml"), ("configs", "md"), ("configs", "toml")];
    for path in all.into_iter().flat_map(|(folder, ending)| files_of(&root.join(folder), ending)) {
        documents.push(path.strip_prefix(&root).unwrap().display().to_string());
    }
    for name in documents {
        let text = read_text(root.join(&name));
        let text = if name == "CONTRIBUTING.md" { without_the_last_column(&text) } else { text };
        let found = barred(&prose(&text)).into_iter().map(|(at, form)| (line(&text, at), form)).collect();
        faults.extend(listed(&name, found));
    }
    for file in sources(&root.join("src")) {
        let name = file.strip_prefix(&root).map(Path::display).unwrap().to_string().replace('\\', "/");
        let documented = !REWRITTEN.iter().any(|folder| name.starts_with(folder));
        faults.extend(listed(&name, in_source(&read_text(&file), documented)));
    }
    assert!(faults.is_empty(), "words that the glossary of CONTRIBUTING.md bars:\n{}", faults.join("\n"));
}

#[test]
fn barred_words_stand_in_no_help() {
    let help = stdout(&program(&["--help"]));
    let commands = commands();
    assert!(commands.len() > 15 && commands.iter().any(|command| command == "fair-curve"), "{commands:?}");
    let mut faults = Vec::new();
    for command in commands {
        let text = stdout(&program(&["help", &command]));
        assert!(text.contains("Usage:"), "{command}");
        let found = barred(&text).into_iter().map(|(at, form)| (line(&text, at), form)).collect();
        faults.extend(listed(&format!("loftsman {command} --help"), found));
    }
    faults.extend(listed("loftsman --help", barred(&help)));
    assert!(faults.is_empty(), "words that the glossary of CONTRIBUTING.md bars:\n{}", faults.join("\n"));
}

#[test]
fn every_barred_word_is_one_of_the_glossary() {
    let text = read_text(carried("CONTRIBUTING.md"));
    let line = text.lines().find_map(|line| line.strip_prefix("Barred everywhere: ")).unwrap();
    let mut listed: Vec<&str> = line.trim_end_matches('.').split(", ").collect();
    let mut here: Vec<&str> = BARRED.iter().map(|forms| forms[0]).collect();
    listed.sort_unstable();
    here.sort_unstable();
    assert_eq!(listed, here);
}

#[test]
fn whole_words_are_found_where_people_read_them() {
    let source = "//! It is\n//! told, as `said` and aforesaid.\n/// ```\n/// let wish = 1;\n/// ```\nfn said(c: char) {\n    // wish\n    \
                  let quote = ('\"', '\\'', 'x');\n    print(\"{said} {wish:?} cannot \\\n        be had\");\n    print(r#\"a \"Lobe\"\"#);\n}\n";
    assert_eq!(in_source(source, true), [(1, "is told"), (9, "cannot be had"), (11, "lobe")]);
    assert_eq!(in_source(source, false), [(9, "cannot be had"), (11, "lobe")]);
}
