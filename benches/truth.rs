//! Fairing against known truths: seeded tables of `tests/truth_hulls`, faired as a user would, measured against the
//! hull that they were sampled from. Medians and worst cases over 30 seeds; `-- --quick` takes 3, a number as many, a
//! name the cases of that name.

#[path = "../tests/random/mod.rs"]
mod random;
#[allow(dead_code, reason = "the page is of the test")]
#[path = "../tests/truth_hulls/mod.rs"]
mod truth_hulls;

use truth_hulls::cases;
use truth_hulls::measure::Summary;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
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
