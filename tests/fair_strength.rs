//! The dial of fairness: from the surface through the table to the smoothest within its tolerances.

use loftsman::internals::fairing::job::Job;
use loftsman::internals::fairing::outcome::Outcome;
use loftsman::internals::fairing::strength::Fairness;
use loftsman::internals::hull::OffsetTable;
use loftsman::internals::qp::Status;

use crate::support::{carried, folder, json, program, read_text, stderr, stdout, table_of};

const SERIES_60: &str = "tests/data/series60_cb060/offsets.csv";
const S_175: &str = "tests/data/s175/offsets.csv";

fn graded(table: &OffsetTable, grade: f64) -> Outcome {
    let outcome = Job { fairness: Fairness::new(grade).unwrap(), ..Job::default() }.run(table).unwrap();
    assert_eq!(outcome.status, Status::Optimal, "{grade}");
    assert!(outcome.is_field, "{grade}");
    outcome
}

/// Grade 0 keeps every offset that is not suspected within half the resolution of the table.
#[test]
fn raw_is_the_surface_through_the_table() {
    for path in [SERIES_60, S_175] {
        let table = table_of(carried(path));
        let half = 0.5 * table.form.quantum().unwrap();
        let outcome = graded(&table, 0.0);
        let moves = outcome.changes.iter().filter(|change| !change.suspect);
        let furthest = moves.map(|change| (change.after - change.before).abs()).fold(0.0, f64::max);
        assert!(furthest <= half * (1.0 + 1e-6), "{path}: {furthest} for {half}");
        assert!(outcome.held.is_empty() && !outcome.is_no_fairer(), "{path}");
        assert!(!outcome.notes.iter().any(|note| note.contains("is on the end of the hull")), "{:?}", outcome.notes);
    }
}

/// A higher grade moves more and bends less, and from light on leaves no more changes of sign.
#[test]
fn a_higher_grade_is_fairer_and_moves_more() {
    let table = table_of(carried(SERIES_60));
    let outcomes = [0.0, 3.0, 5.0, 8.0].map(|grade| graded(&table, grade));
    for pair in outcomes.windows(2) {
        let [low, high] = [&pair[0], &pair[1]];
        let words = format!("{} and {}", low.fairness, high.fairness);
        assert!(high.moves().0 >= low.moves().0, "{words}: {} {}", low.moves().0, high.moves().0);
        assert!(high.energy[1] <= low.energy[1] * 1.001, "{words}: {} {}", low.energy[1], high.energy[1]);
        let fairer = high.changes_of_sign()[1] <= low.changes_of_sign()[1];
        assert!(low.fairness.is_raw() || fairer, "{words}");
    }
}

/// Where the noise is that of rounding, the cost of an inflection rises while there are many over the least. The hull is
/// nearer to the least, and whoever states the cost has what that leaves.
#[test]
fn the_cost_of_an_inflection_rises_where_a_table_has_no_errors_but_rounding() {
    let left = |name: &str, price: Option<f64>| {
        let table = table_of(carried(format!("tests/truth/{name}.csv")));
        let outcome = Job { price, ..Job::default() }.run(&table).unwrap();
        let signs = outcome.changes_of_sign()[1];
        (signs, far_above(signs, outcome.least_changes_of_sign().unwrap()))
    };
    assert_eq!([None, Some(12.0)].map(|price| left("08", price).1), [false, true]);
    assert!(left("26", None).0 < left("26", Some(12.0)).0);
    // An error of 40 mm leaves room for fewer inflections than the hull has.
    assert_eq!(left("39", None), left("39", Some(12.0)));
}

/// Whether a hull has many changes of sign over the least.
fn far_above(count: usize, least: usize) -> bool {
    count as f64 > 1.5 * least as f64 + 2.0
}

#[test]
fn the_command_takes_grades_by_number_and_name() {
    let folder = folder("strength");
    let out = folder.join("out");
    let table = carried(SERIES_60).display().to_string();
    let run = |grade: &[&str]| {
        program(&[&["fair", &table, "-o", out.to_str().unwrap(), "--no-figures", "--force"], grade].concat())
    };
    let output = run(&["--fairness", "smooth", "--verbose"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stdout(&output).contains("Fairness 8 (smooth)"), "{}", stdout(&output));
    let result = json(read_text(out.join("fairing.json")));
    assert_eq!(result["smoothing"]["fairness"], 8.0);
    // The surface through the table may have as many changes of sign as it has.
    let output = run(&["--fairness", "0"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stdout(&output).starts_with("Through the table: "), "{}", stdout(&output));
    for (grade, said) in
        [("11", "fairness is 11. Expected a number from 0 to 10"), ("fairest", "\"fairest\" is not known")]
    {
        let output = run(&["--fairness", grade]);
        assert_eq!(output.status.code(), Some(2), "{grade}");
        assert!(stderr(&output).contains(said), "{}", stderr(&output));
    }
    let output = run(&["--fairness", "3", "--weight", "1e-3"]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
}

/// In a job file the weight of the energy and the dial contradict each other.
#[test]
fn a_job_has_one_strength() {
    let folder = folder("strengths");
    let job = folder.join("job.toml");
    let table = carried(SERIES_60).display().to_string();
    std::fs::write(&job, format!("fairness = 3\n[table]\nfile = {table:?}\n[inflections]\ncost = 4\n")).unwrap();
    let output = program(&["fair", job.to_str().unwrap(), "-o", folder.join("out").to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    let said = "fairness and inflections.cost both say how strongly the table is faired. Give one of them.";
    assert!(stderr(&output).contains("E170") && stderr(&output).contains(said), "{}", stderr(&output));
}
