//! Fairing recovers hulls that are known: some cases of the benchmark `benches/truth.rs` with few seeds, and its limits.
//!
//! With LOFTSMAN_REPORT set, every case is run and reports/truth/report.md is written.

mod truth_hulls;

use std::path::Path;

use truth_hulls::{Case, Errors, Summary, cases};

const SEEDS: u64 = 3;

fn case(name: &str, errors: Errors) -> Case {
    let found = cases().into_iter().find(|case| case.name == name && case.errors == errors);
    found.unwrap_or_else(|| panic!("no case {name}, {}", errors.words()))
}

/// The summary of a case, after what holds for every case: the wishes are met, the optimum is proved.
fn summary(name: &str, errors: Errors) -> Summary {
    let summary = Summary::new(&case(name, errors), SEEDS);
    println!("{summary}");
    assert_eq!(summary.failed, 0, "{summary}");
    assert!(summary.volume <= 1e-12 && summary.lcb <= 1e-12, "{summary}");
    assert!(summary.gap <= 1e-9, "{summary}");
    assert!(summary.worse[0] == 0, "{summary}");
    summary
}

/// Worst sign changes after and those of the truth: waterlines, sections, diagonals.
fn changes(summary: &Summary) -> [[f64; 2]; 3] {
    summary.changes.map(|[truth, _, after]| [truth[0], after[1]])
}

#[test]
fn the_wigley_hull_comes_back_without_a_change_of_sign() {
    for (errors, limit) in [(0.025, 0.0053), (0.002, 0.00057)] {
        let summary = summary("Wigley", Errors::Normal(errors));
        assert!(summary.rms[1][0] <= limit, "{summary}");
        assert!(changes(&summary).iter().all(|[_, after]| *after == 0.0), "{summary}");
    }
}

#[test]
fn the_s_shaped_hull_keeps_its_own_changes_of_sign() {
    for (errors, limit) in [(0.04, 0.0136), (0.002, 0.00117)] {
        let summary = summary("S-shaped", Errors::Normal(errors));
        assert!(summary.rms[1][0] <= limit, "{summary}");
        assert!(summary.worse[1] == 0, "{summary}");
        assert!(changes(&summary)[..2].iter().all(|[truth, after]| *after <= truth + 1.0), "{summary}");
    }
}

/// Sections of a parallel middle body gain no change of sign. Its waterlines keep ripples within the flat where the truth has none
/// (see reports/truth): fewer than before, but more than the truth.
#[test]
fn a_parallel_middle_body_loses_its_noise() {
    let summary = summary("middle body", Errors::Normal(0.01));
    assert!(summary.rms[1][1] <= 0.6 * summary.rms[0][0], "{summary}");
    assert!(summary.worse[1] == 0, "{summary}");
    assert!(changes(&summary)[1][1] <= changes(&summary)[1][0] + 2.0, "{summary}");
    assert!(summary.changes[0][2][1] < summary.changes[0][1][0], "{summary}");
}

#[test]
fn errors_of_typing_do_not_reach_the_hull() {
    for (name, limit) in [("Wigley", 0.00076), ("S-shaped", 0.0013)] {
        for errors in [Errors::Typing, Errors::Outliers] {
            let summary = summary(name, errors);
            assert!(summary.rms[1][1] <= limit, "{summary}");
        }
    }
}

#[test]
fn the_page_of_all_cases() {
    if std::env::var_os("LOFTSMAN_REPORT").is_none() {
        return println!("skipped: LOFTSMAN_REPORT is not set");
    }
    let mut text = String::from(
        "# Fairing against known truths\n\nMade by `LOFTSMAN_REPORT=1 cargo test --test truth`, 5 seeds a case; `cargo bench --bench truth` \
         takes 30. What the hulls and errors are: head of `tests/truth_hulls/mod.rs`. a/b: median and worst case; changes of sign: truth, \
         before, after; lengths in millimetres; displacement and LCB of the truth are given to the job.\n\n",
    );
    text.push_str(Summary::head());
    text.push('\n');
    for case in cases() {
        text.push_str(&format!("{}\n", Summary::new(&case, 5)));
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("reports/truth");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("report.md"), text).unwrap();
}
