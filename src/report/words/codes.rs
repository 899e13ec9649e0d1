//! The codes of all messages of the program: what each is about, what causes it, and what the user does.

mod designs;
mod remarks;
mod results;
mod tables;

use std::cmp::Reverse;

use serde_json::{Value, json};

use super::page::wrapped;
use crate::report::failure::Failure;

/// What a code of messages is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Explanation {
    /// Code: `E` for an error, `W` for a warning, `N` for a note, and three digits.
    pub code: &'static str,
    /// What it is about, in a few words.
    pub title: &'static str,
    /// What is wrong, and when the program reports it.
    pub cause: &'static str,
    /// Input or a command that provokes it, or the message.
    pub example: &'static str,
    /// What the user does.
    pub remedy: &'static str,
}

const PARTS: [&[Explanation]; 4] = [&designs::DESIGNS, &tables::TABLES, &results::RESULTS, &remarks::REMARKS];

const COUNT: usize = PARTS[0].len() + PARTS[1].len() + PARTS[2].len() + PARTS[3].len();

/// Every code that the program reports, in the order of the codes.
pub const CODES: [Explanation; COUNT] = {
    let mut all = [PARTS[0][0]; COUNT];
    let (mut part, mut within, mut at) = (0, 0, 0);
    while at < COUNT {
        if within == PARTS[part].len() {
            (part, within) = (part + 1, 0);
        }
        all[at] = PARTS[part][within];
        (within, at) = (within + 1, at + 1);
    }
    all
};

/// So many codes are proposed for one that is not known.
const MOST_PROPOSED: usize = 3;

/// The explanation of a code, in upper or lower case.
#[must_use]
pub fn explanation(code: &str) -> Option<Explanation> {
    CODES.into_iter().find(|found| found.code.eq_ignore_ascii_case(code.trim()))
}

/// Explanations of these codes in their order; of all codes where none is given.
///
/// # Errors
/// [`Failure::Usage`] with the nearest codes for every code that is not known.
pub fn explanations(codes: &[String]) -> Result<Vec<Explanation>, Failure> {
    if codes.is_empty() {
        return Ok(CODES.to_vec());
    }
    let unknown = |code: &&String| explanation(code).is_none();
    let refused: Vec<String> = codes.iter().filter(unknown).map(|code| refusal(code)).collect();
    if refused.is_empty() {
        Ok(codes.iter().filter_map(|code| explanation(code)).collect())
    } else {
        Err(Failure::Usage(refused.join("\n")))
    }
}

fn refusal(word: &str) -> String {
    let near = nearest(word);
    let help = match near.split_last() {
        None => "`loftsman explain` lists all codes".to_owned(),
        Some((last, [])) => format!("Did you mean {last}?"),
        Some((last, others)) => format!("Did you mean {} or {last}?", others.join(", ")),
    };
    format!("no message has the code '{}'. {help}", word.trim())
}

/// Codes with the fewest edits from a word, at most half of its letters: the same letter first, then the nearest number.
fn nearest(word: &str) -> Vec<&'static str> {
    let word = word.trim().to_ascii_uppercase();
    let number = |code: &str| code.get(1..)?.parse::<u32>().ok();
    let apart = |code: &str| number(code).zip(number(&word)).map_or(u32::MAX, |(a, b)| a.abs_diff(b));
    let ranked = CODES.iter().map(|found| {
        let letter = Reverse(found.code.get(..1) == word.get(..1));
        (strsim::osa_distance(&word, found.code), letter, apart(found.code), found.code)
    });
    let mut ranked: Vec<_> = ranked.filter(|(edits, ..)| 2 * edits <= word.len()).collect();
    ranked.sort_unstable();
    let fewest = ranked.first().map(|(edits, ..)| *edits);
    ranked.iter().filter(|(edits, ..)| Some(*edits) == fewest).take(MOST_PROPOSED).map(|(.., code)| *code).collect()
}

/// Codes with their titles, one a line.
#[must_use]
pub fn codes_list(codes: &[Explanation]) -> String {
    codes.iter().map(|found| format!("{} {}\n", found.code, found.title)).collect()
}

/// Titles, causes, examples and remedies, for a terminal.
#[must_use]
pub fn codes_text(codes: &[Explanation]) -> String {
    let one = |found: &Explanation| {
        let Explanation { code, title, cause, example, remedy } = found;
        let parts = [("Cause", cause), ("Example", example), ("Remedy", remedy)];
        let parts = parts.map(|(name, text)| wrapped(&format!("{name}: {text}"), 2));
        format!("{code} {title}\n{}", parts.concat())
    };
    codes.iter().map(one).collect::<Vec<_>>().join("\n")
}

/// One object a code.
#[must_use]
pub fn codes_json(codes: &[Explanation]) -> Value {
    let one = |found: &Explanation| {
        let Explanation { code, title, cause, example, remedy } = found;
        json!({ "code": code, "title": title, "cause": cause, "example": example, "remedy": remedy })
    };
    codes.iter().map(one).collect()
}

/// The reference of all codes as Markdown, `docs/src/reference/codes.md`.
#[must_use]
pub fn codes_page() -> String {
    let row = |found: &Explanation| {
        let Explanation { code, title, cause, example, remedy } = found;
        format!("| {} |\n", [*code, title, cause, example, remedy].map(|text| text.replace('|', "\\|")).join(" | "))
    };
    let rows: String = CODES.iter().map(row).collect();
    format!(
        "# Message codes\n\nMessages begin with a code: `E` is an error, `W` a warning, `N` a note. The command \
         `loftsman explain E301` prints the row of a code. The program makes this page from its list of codes.\n\n\
         | code | title | cause | example | remedy |\n|---|---|---|---|---|\n{rows}"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(code: &str) -> String {
        explanations(&[code.to_owned()]).unwrap_err().to_string()
    }

    #[test]
    fn unknown_codes_propose_the_nearest() {
        assert_eq!(refused("E302"), "E705 no message has the code 'E302'. Did you mean E301, E303 or E300?");
        assert_eq!(refused("x164"), "E705 no message has the code 'x164'. Did you mean W164?");
        assert_eq!(refused("cell"), "E705 no message has the code 'cell'. `loftsman explain` lists all codes");
        assert_eq!(refused("").lines().count(), 1);
    }

    #[test]
    fn the_page_escapes_its_columns() {
        let rows = codes_page().lines().filter(|line| line.starts_with("| ")).count();
        assert_eq!(rows, CODES.len() + 1);
        assert!(codes_page().lines().all(|line| !line.starts_with("| ") || line.matches(" | ").count() == 4));
    }
}
