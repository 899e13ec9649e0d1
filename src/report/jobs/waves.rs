//! The wave resistance on the pages of `derive` and `fair`, and its figure.

use std::fmt::Write as _;

use crate::plot::trade_figure;
use crate::report::failure::Failure;
use crate::report::output::files::OutputFile;
use crate::report::output::pictures::pictures;
use crate::report::words::page::{fixed, wrapped};
use crate::resistance::{THIN_SHIP_LIMITS, WaveResult};

/// R_W at each Froude number, and what other weights come to; `first` is the hull before and `cost` what is paid, in words.
pub(in crate::report) fn waves_page(waves: &WaveResult, [first, cost]: [&str; 2]) -> String {
    let page = &mut String::new();
    let _ = writeln!(page, "{:>8}{:>16}{:>16}{:>10}", "Fn", format!("R_W {first} kN"), "R_W kN", "change");
    for ((number, before), after) in waves.froude_numbers.iter().zip(&waves.before).zip(&waves.after) {
        let change = format!("{:+.1} %", 100.0 * (after / before - 1.0));
        let [before, after] = [before, after].map(|value| fixed(1e-3 * value, 3));
        let _ = writeln!(page, "{number:>8.4}{before:>16}{after:>16}{change:>10}");
    }
    page.push('\n');
    let _ = writeln!(page, "{:>12}{:>12}{:>14}{:>12}{:>14}", "weight m2", "mean R_W", cost, "moves mm", "inflections");
    for (k, trade) in waves.trades.iter().enumerate() {
        let [weight, energy] = [trade.weight, trade.energy].map(|value| format!("{value:.2e}"));
        let ratio = format!("{:+.2} %", 100.0 * (trade.ratio - 1.0));
        let moves = fixed(1e3 * trade.moves, 1);
        let signs = if trade.keeps_signs { "" } else { " signs not kept" };
        let taken = format!("{}{signs}", if k == waves.taken { " <" } else { "" });
        let _ = writeln!(page, "{weight:>12}{ratio:>12}{energy:>14}{moves:>12}{:>14}{taken}", trade.inflections);
    }
    page.push('\n');
    page.push_str(&wrapped(THIN_SHIP_LIMITS, 2));
    page.push('\n');
    std::mem::take(page)
}

/// The figure of the weights, as PNG and SVG, where several were solved.
pub(in crate::report) fn trade_files(name: &str, waves: &WaveResult) -> Result<Vec<OutputFile>, Failure> {
    pictures("wave-trade", trade_figure(name, &waves.trades, waves.taken))
}
