//! The conic interior point of Clarabel as a second opinion: rows scaled to unit size, two-sided rows split into two cones.
//!
//! P and q are divided by the mean diagonal of P: without it the solver stalls (its tolerances are absolute where the
//! objective is small).

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};
use loftsman::internals::qp::{Problem, Settings, Solution, Status};

/// One row of the cone form: A_k x + s = b.
struct ConeRow {
    row: usize,
    sign: f64,
    right: f64,
}

/// The answer of Clarabel.
pub(crate) fn solve(problem: &Problem, settings: &Settings) -> Solution {
    let n = problem.linear.len();
    let m = problem.rows.row_count();
    let objective_scale = objective_scale(problem);
    let row_scale: Vec<f64> = (0..m)
        .map(|row| {
            let size = problem.rows.row_size(row);
            if size > 0.0 { 1.0 / size } else { 1.0 }
        })
        .collect();
    let (mut equal, mut one_sided) = (Vec::new(), Vec::new());
    for row in 0..m {
        let (lower, upper) = (problem.lower[row], problem.upper[row]);
        if lower >= upper {
            equal.push(ConeRow { row, sign: 1.0, right: upper });
            continue;
        }
        if upper.is_finite() {
            one_sided.push(ConeRow { row, sign: 1.0, right: upper });
        }
        if lower.is_finite() {
            one_sided.push(ConeRow { row, sign: -1.0, right: -lower });
        }
    }
    let (equal_count, one_sided_count) = (equal.len(), one_sided.len());
    let cone_rows: Vec<ConeRow> = equal.into_iter().chain(one_sided).collect();
    let (mut rows, mut columns, mut values, mut right) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for (index, cone) in cone_rows.iter().enumerate() {
        let (places, entries) = problem.rows.row(cone.row);
        for (&place, &entry) in places.iter().zip(entries) {
            rows.push(index);
            columns.push(place);
            values.push(cone.sign * entry * row_scale[cone.row]);
        }
        right.push(cone.right * row_scale[cone.row]);
    }
    let constraints = CscMatrix::new_from_triplets(cone_rows.len(), n, rows, columns, values);
    let (mut rows, mut columns, mut values) = (Vec::new(), Vec::new(), Vec::new());
    for row in 0..n {
        let (places, entries) = problem.quadratic.row(row);
        for (&place, &entry) in places.iter().zip(entries) {
            if place >= row {
                rows.push(row);
                columns.push(place);
                values.push(entry * objective_scale);
            }
        }
    }
    let quadratic = CscMatrix::new_from_triplets(n, n, rows, columns, values);
    let linear: Vec<f64> = problem.linear.iter().map(|value| value * objective_scale).collect();
    let mut cones = Vec::new();
    if equal_count > 0 {
        cones.push(SupportedConeT::ZeroConeT(equal_count));
    }
    if one_sided_count > 0 {
        cones.push(SupportedConeT::NonnegativeConeT(one_sided_count));
    }
    let options = DefaultSettings {
        verbose: false,
        max_threads: 1,
        max_iter: u32::try_from(settings.iterations).unwrap_or(u32::MAX),
        tol_gap_abs: settings.tolerance,
        tol_gap_rel: settings.tolerance,
        tol_feas: settings.tolerance,
        ..DefaultSettings::default()
    };
    let Ok(mut solver) = DefaultSolver::new(&quadratic, &linear, &constraints, &right, &cones, options) else {
        return Solution {
            status: Status::Limit,
            x: vec![0.0; n],
            multipliers: vec![0.0; m],
            iterations: 0,
            progress: Vec::new(),
            interior: None,
        };
    };
    solver.solve();
    let status = match solver.solution.status {
        SolverStatus::Solved | SolverStatus::AlmostSolved => Status::Optimal,
        SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => Status::Infeasible,
        SolverStatus::DualInfeasible | SolverStatus::AlmostDualInfeasible => Status::Unbounded,
        _ => Status::Limit,
    };
    let mut multipliers = vec![0.0; m];
    for (cone, z) in cone_rows.iter().zip(&solver.solution.z) {
        multipliers[cone.row] += cone.sign * z * row_scale[cone.row] / objective_scale;
    }
    Solution {
        status,
        x: solver.solution.x.clone(),
        multipliers,
        iterations: usize::try_from(solver.solution.iterations).unwrap_or(usize::MAX),
        progress: Vec::new(),
        interior: None,
    }
}

/// 1 over the mean diagonal of P; for a linear program 1 over the largest |q|.
fn objective_scale(problem: &Problem) -> f64 {
    let n = problem.linear.len();
    let mut diagonal = 0.0;
    for row in 0..n {
        let (places, entries) = problem.quadratic.row(row);
        diagonal += places.iter().zip(entries).filter(|&(&place, _)| place == row).map(|(_, entry)| entry).sum::<f64>();
    }
    let mean = diagonal / n.max(1) as f64;
    if mean > 0.0 {
        return 1.0 / mean;
    }
    let largest = problem.linear.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    if largest > 0.0 { 1.0 / largest } else { 1.0 }
}
