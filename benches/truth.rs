//! Fairing against known truths: seeded tables of `tests/truth_hulls`, faired as a user would, measured against the
//! hull that they were sampled from. Medians and worst cases over 30 seeds; `-- --quick` takes 3, a number as many, a
//! name the cases of that name.
//!
//! `-- --draws N` draws N tables at random instead (`tests/truth_draws`) and measures the fair hull along all lines of
//! the table, beside the partners of `tests/partners`: `--no-partners` leaves these out, `--seed S` draws others,
//! `--only K` takes the draw of that number.

#[allow(dead_code, reason = "what is taken apart is of the tests")]
#[path = "../tests/partners/mod.rs"]
mod partners;
#[path = "../tests/random/mod.rs"]
mod random;
#[allow(dead_code, unused_imports, reason = "the nets are written by the test")]
#[path = "../tests/truth_draws/mod.rs"]
mod truth_draws;
#[allow(dead_code, reason = "the page is of the test")]
#[path = "../tests/truth_hulls/mod.rs"]
mod truth_hulls;

use std::io::Write;

use truth_draws::{Draw, Measured, Summary as DrawSummary};
use truth_hulls::cases;
use truth_hulls::measure::Summary;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let value = |option: &str| {
        let at = arguments.iter().position(|argument| argument == option)?;
        Some(arguments.get(at + 1).and_then(|text| text.parse::<u64>().ok()).unwrap_or_else(|| panic!("{option} N")))
    };
    let (count, only) = (value("--draws"), value("--only"));
    if count.is_some() || only.is_some() {
        let numbers = only.map_or(0..count.unwrap_or(0), |number| number..number + 1);
        let with_partners = !arguments.iter().any(|argument| argument == "--no-partners");
        return draws(value("--seed").unwrap_or(1), numbers, with_partners);
    }
    let quick = arguments.iter().any(|argument| argument == "--quick");
    let seeds = arguments.iter().find_map(|argument| argument.parse().ok()).unwrap_or(if quick { 3 } else { 30 });
    let names: Vec<&String> =
        arguments.iter().filter(|name| !name.starts_with("--") && name.parse::<u64>().is_err()).collect();
    println!("a/b: median and worst; changes of sign: truth > before > after\n{}", Summary::head());
    for case in cases() {
        let title = case.title();
        if names.is_empty() || names.iter().any(|name| title.contains(name.as_str())) {
            println!("{}", Summary::new(&case, seeds));
        }
    }
}

/// Draws of these numbers: a row each, and the summary.
fn draws(seed: u64, numbers: std::ops::Range<u64>, with_partners: bool) {
    let mut measured = Vec::new();
    for number in numbers {
        // The title stands there while the draw is faired, so that a slow one has a name.
        let draw = Draw::new(seed, number);
        print!("{} ", draw.title());
        let _ = std::io::stdout().flush();
        let row = Measured::new(&draw, with_partners);
        println!("{row}");
        measured.push(row);
    }
    println!("{}", DrawSummary(&measured));
}
