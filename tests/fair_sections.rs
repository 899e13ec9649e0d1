//! Fairing of sections that are given as points: stations whose points rise from keel to deck have proved least numbers
//! of inflections and are asked for them, as those of a table of offsets.

use std::fmt::Write;

use loftsman::internals::exchange::read_table;
use loftsman::internals::fairing::job::Job;
use loftsman::internals::fairing::outcome::Outcome;
use loftsman::internals::hull::Cut;
use loftsman::internals::qp::Status;

use crate::random::Random;

/// A boat of 20 x 4 x 1.5 m with sections y = 2 (1 - s^2) (1 - (1 - z/D)^2) over a keel that rises at the ends, s = 2
/// x/L - 1, each of 14 points with errors of a standard deviation of 3 mm.
fn faired() -> Outcome {
    let (length, depth) = (20.0, 1.5);
    let mut random = Random(11);
    let mut text = "station,x_m,point,y_m,z_m\n".to_owned();
    for i in 0..13 {
        let x = length * (0.04 + 0.92 * f64::from(i) / 12.0);
        let s = 2.0 * x / length - 1.0;
        let keel = 0.3 * s * s;
        for k in 0..14 {
            let part = f64::from(k) / 13.0;
            let error = if k == 0 { 0.0 } else { 0.003 * random.normal() };
            let half = 2.0 * (1.0 - s * s) * (1.0 - (1.0 - part).powi(2)) + error;
            writeln!(text, "{i},{x:.4},{k},{half:.4},{:.4}", keel + (depth - keel) * part).unwrap();
        }
    }
    let table = read_table("sections.csv", text.as_bytes()).unwrap_or_else(|problems| panic!("{problems:?}")).table;
    Job::default().run(&table).unwrap()
}

#[test]
#[ignore = "takes 5 s"]
fn stations_of_points_have_a_proved_least_number_and_lose_their_noise() {
    let outcome = faired();
    assert_eq!(outcome.status, Status::Optimal);
    let stations: Vec<_> = outcome.turns.iter().filter(|turns| matches!(turns.cut, Cut::Station { .. })).collect();
    assert_eq!(stations.len(), 13);
    assert!(stations.iter().all(|turns| turns.minimum == Some((0, true)) && turns.after <= turns.before));
    let [before, after] = outcome.inflections("station");
    assert!(before >= 20 && after <= 2, "{before} > {after}");
    assert!(outcome.turns.iter().all(|turns| turns.after <= turns.before));
}
