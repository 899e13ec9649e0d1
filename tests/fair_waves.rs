//! The least wave resistance within the tolerances of a table.

use std::fmt::Write as _;
use std::path::PathBuf;

use loftsman::internals::fairing::outcome::Outcome;
use loftsman::internals::resistance::WaveTrade;
use serde_json::Value;

use crate::fair::{faired_as_it_is, file};
use crate::support::{Folder, folder, program, stderr};

/// A table of Wigley's hull of 100 x 10 x 6.25 m, of 15 stations and 8 waterlines to the millimetre.
fn wigley(folder: &Folder) -> PathBuf {
    let mut text = "x\\z [m]".to_owned();
    (0..8).for_each(|k| write!(text, ",{}", f64::from(k)).unwrap());
    for station in 0..15 {
        let x = 100.0 * f64::from(station) / 14.0;
        write!(text, "\n{x:.4}").unwrap();
        for waterline in 0..8 {
            let (s, t) = (2.0 * x / 100.0 - 1.0, (6.25 - f64::from(waterline)).max(0.0) / 6.25);
            write!(text, ",{:.3}", 5.0 * (1.0 - s * s) * (1.0 - t * t)).unwrap();
        }
    }
    folder.write("wigley.toml", "[table]\nT = 6.25\n");
    folder.write("wigley.csv", &text).into()
}

fn waves(outcome: &Outcome) -> &[WaveTrade] {
    &outcome.faired.waves.as_ref().unwrap().trades
}

/// Each of seven weights has the least lambda E + w R, within the tolerances, with what is held and the signs.
#[test]
fn the_wave_resistance_falls_within_the_tolerances() {
    let folder = folder("fair-waves");
    let options =
        [("--tolerance", "tolerance.table", "40 mm"), ("--wave-resistance", "waves.froude_numbers", "0.30:0.34:0.02")];
    let (_, outputs) = faired_as_it_is(&wigley(&folder), &options);
    let outcome = &outputs.outcome;
    let trades = waves(outcome);
    assert_eq!(trades.len(), 7);
    for pair in trades.windows(2) {
        assert!(pair[1].ratio < pair[0].ratio && pair[1].energy > pair[0].energy, "{pair:?}");
        for (this, other) in [(pair[0], pair[1]), (pair[1], pair[0])] {
            let sum = |trade: WaveTrade| trade.energy + this.weight * trade.ratio;
            assert!(sum(this) <= sum(other) * (1.0 + 1e-6), "{pair:?}");
        }
        assert!(pair[1].inflections <= pair[0].inflections, "{pair:?}");
    }
    let result = outcome.faired.waves.as_ref().unwrap();
    let mean = result.after.iter().zip(&result.before).map(|(a, b)| a / b).sum::<f64>() / 3.0;
    assert!((mean - trades[result.taken].ratio).abs() < 1e-4 && mean < 0.98, "{mean}");
    let moved = outcome.changes.iter().map(|change| (change.after - change.before).abs()).fold(0.0, f64::max);
    assert!(moved > 0.02 && moved < 0.04 * (1.0 + 1e-6), "{moved}");
    assert!(outcome.held.iter().all(|held| held.is_had()), "{:?}", outcome.held);
    assert!(outcome.faired.solved.certificate.gap.abs() < 1e-9);
    let [before, after] = outcome.changes_of_sign();
    assert!(after <= before);
    let written: Value = serde_json::from_str(&file(&outputs, "fairing.json")).unwrap();
    let written = &written["wave_resistance"];
    assert_eq!(written["weights"].as_array().unwrap().len(), 7);
    assert!(written["speeds"][0]["RW_after"].as_f64().unwrap() < written["speeds"][0]["RW_before"].as_f64().unwrap());
}

#[test]
fn a_wave_resistance_that_has_no_sense_is_refused() {
    let folder = folder("fair-waves-refused");
    let table = wigley(&folder).display().to_string();
    let out = folder.join("out").display().to_string();
    let refusal = |options: &[&str]| {
        let arguments = [&["fair", table.as_str(), "--no-figures", "-o", out.as_str()], options].concat();
        let run = program(&arguments);
        assert!(!std::path::Path::new(&out).exists());
        (run.status.code(), stderr(&run))
    };
    for (options, code) in [
        (&["--wave-resistance", "3"][..], "E124"),
        (&["--wave-weight", "3"], "E125"),
        (&["--wave-resistance", "0.3", "--wave-weight", "-1"], "E124"),
        (&["--wave-resistance", "0.3", "--grades"], "--grades goes without --wave-resistance"),
    ] {
        let (status, err) = refusal(options);
        assert!(status == Some(2) && err.contains(code), "{options:?}: {err}");
    }
    // Rocker has no level waterlines of the net.
    let yacht = crate::support::carried(crate::fair::YACHT).display().to_string();
    let run = program(&["fair", &yacht, "--draught", "0.673", "--wave-resistance", "0.3", "--no-figures", "-o", &out]);
    assert!(run.status.code() == Some(2) && stderr(&run).contains("E425"), "{}", stderr(&run));
    let run = program(&["fair", &carried_series60(), "--wave-resistance", "0.3", "--no-figures", "-o", &out]);
    assert!(run.status.code() == Some(2) && stderr(&run).contains("E184"), "{}", stderr(&run));
}

fn carried_series60() -> String {
    crate::support::carried(crate::fair::TABLE).display().to_string()
}
