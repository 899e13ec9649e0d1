//! Time of the fairing programs with displacement and LCB held (336, 2,400 and 10,000 unknowns): the structured
//! interior point against Clarabel in the same run, and a second solve after one lock was moved.
//! `cargo bench --bench qp [-- 336]`. Under each row: seconds of CPU of both (Linux; Clarabel with one thread), and by
//! what ours misses displacement (relative), LCB (over L) and the bands \[m\].
//!
//! `-- --offsets DIR` takes the readings from `DIR/fair_21x11_24x14.csv`, `fair_81x41_60x40.csv` and
//! `fair_161x101_125x80.csv` (depths in the first row, stations in the first column). `--partner COMMAND` runs another
//! program between ours, turn by turn, with `{case}` in COMMAND replaced by `81x41_60x40` and so on; it has to print its
//! seconds of CPU as `t=0.31s` and may print its objective as `J=1203.112`.

#[allow(dead_code, reason = "random programs are of the test")]
#[path = "../tests/qp_problems/mod.rs"]
mod qp_problems;

use loftsman::internals::qp::{Problem, Settings, Solution, Solver};
use qp_problems::{constant_part, fairing_of, readings, second_opinion};
use std::process::Command;
use std::time::Instant;

const CASES: [([usize; 2], [usize; 2], usize); 3] =
    [([21, 11], [24, 14], 9), ([81, 41], [60, 40], 5), ([161, 101], [125, 80], 1)];

/// Seconds of CPU that this thread has used; none where the system does not tell.
fn processor_seconds() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(1e-9 * text.split_whitespace().next()?.parse::<f64>().ok()?)
}

/// What a solver took and found.
#[derive(Clone)]
struct Run {
    seconds: f64,
    processor: f64,
    iterations: usize,
    gap: f64,
    /// Displacement, LCB and the worst of all other rows.
    missed: [f64; 3],
}

fn ours(problem: &Problem, settings: &Settings) -> Solution {
    problem.solve(settings).unwrap()
}

/// The shortest of the turns of each solver, taken in turn.
fn race(problem: &Problem, rounds: usize) -> [Run; 2] {
    let none = Run { seconds: f64::INFINITY, processor: f64::INFINITY, iterations: 0, gap: 0.0, missed: [0.0; 3] };
    let mut result = [none.clone(), none];
    for _ in 0..rounds {
        let solvers: [fn(&Problem, &Settings) -> Solution; 2] = [ours, second_opinion::solve];
        for (solve, result) in solvers.into_iter().zip(&mut result) {
            let (start, used) = (Instant::now(), processor_seconds());
            let solution = solve(problem, &Settings::default());
            let seconds = start.elapsed().as_secs_f64();
            let processor = processor_seconds().zip(used).map_or(f64::NAN, |(now, then)| now - then);
            let gap = problem.certificate(&solution.x, &solution.multipliers, 0.0).gap;
            let missed = |k: usize| {
                let y = problem.rows.dot(k, &solution.x);
                (problem.lower[k] - y).max(y - problem.upper[k]).max(0.0)
            };
            let others = (2..problem.lower.len()).map(missed).fold(0.0, f64::max);
            *result = Run {
                seconds: result.seconds.min(seconds),
                processor: result.processor.min(processor),
                iterations: solution.iterations,
                gap,
                missed: [missed(0), missed(1), others],
            };
        }
    }
    result
}

/// Seconds of a cold solve and of the next after a fixed offset was moved by 2 mm.
fn warm(problem: &Problem, lock: usize) -> [f64; 2] {
    let mut problem = problem.clone();
    let middle = 0.5 * (problem.lower[lock] + problem.upper[lock]);
    (problem.lower[lock], problem.upper[lock]) = (middle, middle);
    let start = Instant::now();
    let mut solver = Solver::new(&problem, &Settings::default()).unwrap();
    solver.solve();
    let cold = start.elapsed().as_secs_f64();
    (problem.lower[lock], problem.upper[lock]) = (middle + 0.002, middle + 0.002);
    let start = Instant::now();
    solver.update(&problem).unwrap();
    solver.solve();
    [cold, start.elapsed().as_secs_f64()]
}

/// The half-breadths of a file: the first row and the first column are depths and stations.
fn readings_of(file: &str) -> Vec<f64> {
    let text = std::fs::read_to_string(file).unwrap_or_else(|problem| panic!("{file}: {problem}"));
    let row = |line: &str| line.split(',').skip(1).map(|cell| cell.parse().unwrap()).collect::<Vec<f64>>();
    text.lines().skip(1).flat_map(row).collect()
}

/// Seconds of CPU and the objective that another program prints.
fn partner(command: &str, case: &str) -> (f64, Option<f64>) {
    let command = command.replace("{case}", case);
    let output = Command::new("sh").args(["-c", &command]).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let number = |name: &str| {
        let word = text.split_whitespace().find_map(|word| word.strip_prefix(name))?;
        word.trim_end_matches('s').parse().ok()
    };
    let seconds = number("t=").unwrap_or_else(|| panic!("{command} printed no t=...s"));
    (seconds, number("J="))
}

/// Medians of our seconds of CPU and of another program's, turn by turn, and the objectives of both.
fn against(problem: &Problem, constant: f64, command: &str, case: &str) {
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    let (mut reached, mut printed) = (0.0, None);
    for _ in 0..5 {
        let used = processor_seconds();
        let solution = problem.solve(&Settings::default()).unwrap();
        ours.push(processor_seconds().zip(used).map_or(f64::NAN, |(now, then)| now - then));
        reached = problem.objective(&solution.x) + constant;
        let (seconds, objective) = partner(command, case);
        theirs.push(seconds);
        printed = objective;
    }
    let median = |mut all: Vec<f64>| {
        all.sort_by(f64::total_cmp);
        all[all.len() / 2]
    };
    let (ours, theirs) = (median(ours), median(theirs));
    let printed = printed.map_or(String::new(), |j| format!(", partner's {j:.6}"));
    println!(
        "         CPU {ours:.4} s, partner {theirs:.4} s: ours/partner {:.3}; objective {reached:.6}{printed}",
        ours / theirs
    );
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let value = |name: &str| arguments.iter().position(|a| a == name).and_then(|at| arguments.get(at + 1));
    let (folder, command) = (value("--offsets"), value("--partner"));
    let wanted = arguments.iter().find(|&a| CASES.iter().any(|(_, net, _)| (net[0] * net[1]).to_string() == *a));
    println!("unknowns   rows |     ours      its gap     | Clarabel   its gap     | ours/Clarabel | warm/cold");
    let mut last: Option<(f64, f64)> = None;
    for (seed, (offsets, net, rounds)) in (1..).zip(CASES) {
        let n = net[0] * net[1];
        if wanted.is_some_and(|wanted| **wanted != n.to_string()) {
            continue;
        }
        let case = format!("{}x{}_{}x{}", offsets[0], offsets[1], net[0], net[1]);
        let read = |folder| readings_of(&format!("{folder}/fair_{case}.csv"));
        let half_breadths = folder.map_or_else(|| readings(offsets, seed), read);
        let problem = fairing_of(offsets, net, &half_breadths);
        let [ours, clarabel] = race(&problem, rounds);
        let [cold, again] = warm(&problem, 2 + offsets[0] / 2 * offsets[1] + offsets[1] / 3);
        println!(
            "{n:8} {:6} | {:8.4} s {:5} {:7.0e} | {:8.4} s {:3} {:7.0e} | {:13.3} | {:.2}",
            problem.lower.len(),
            ours.seconds,
            ours.iterations,
            ours.gap,
            clarabel.seconds,
            clarabel.iterations,
            clarabel.gap,
            ours.seconds / clarabel.seconds,
            again / cold
        );
        let [volume, centre, band] = ours.missed;
        println!(
            "         CPU {:.4} s, {:.4} s; displacement off by {volume:.0e}, LCB by {:.0e} L, rows of bands and signs by {band:.0e} m",
            ours.processor, clarabel.processor, centre
        );
        if let Some((before, seconds)) = last.filter(|_| n > 2400) {
            println!("growth exponent from {before}: {:.2}", (ours.seconds / seconds).ln() / (n as f64 / before).ln());
        }
        if let Some(command) = command {
            against(&problem, constant_part(&half_breadths), command, &case);
        }
        last = Some((n as f64, ours.seconds));
    }
}
