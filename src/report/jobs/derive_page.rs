//! The page of `derive`: what was wanted and what the daughter has, how it was met, and the parent beside it.

use std::fmt::Write as _;

use super::compare::page::compare_page;
use super::derive::DeriveOutputs;
use super::waves::waves_page;
use crate::derivation::{BindingLimits, Method};
use crate::exchange::DerivedTarget;
use crate::report::words::page::{dimensions, fixed, wrapped};

/// Decimals of a value of a target.
pub(in crate::report) fn decimals(target: &DerivedTarget) -> usize {
    match target.unit {
        "-" => 5,
        "m3" | "m2" => 2,
        "deg" => 3,
        _ => 4,
    }
}

/// The shadow price per 1 % of the target.
fn price(target: &DerivedTarget) -> String {
    target.price.map_or(String::new(), |price| format!("{:.2e}", 0.01 * price))
}

fn targets(page: &mut String, outputs: &DeriveOutputs) {
    if outputs.targets.is_empty() {
        return;
    }
    let _ = writeln!(
        page,
        "{:<10}{:>12}{:>13}{:>13}{:>10}  {:<6}{:>11}",
        "", "scaled", "requested", "achieved", "error", "origin", "price"
    );
    for target in &outputs.targets {
        let write = |value: f64| fixed(value, decimals(target));
        let error = (target.achieved - target.requested) / target.requested.abs().max(1e-300);
        let _ = writeln!(
            page,
            "{:<10}{:>12}{:>13}{:>13}{:>10}  {:<6}{:>11}",
            target.key,
            write(target.scaled),
            write(target.requested),
            write(target.achieved),
            format!("{error:.0e}"),
            target.origin,
            price(target)
        );
    }
    for target in outputs.targets.iter().filter(|target| target.interval.is_some()) {
        let Some([low, high]) = target.interval else { continue };
        let write = |value: f64| fixed(value, decimals(target));
        let signs = if target.keeps_signs { "" } else { ", without the signs of curvature of the parent" };
        let line =
            format!("{} can be {} to {} with the others as they are{signs}.", target.key, write(low), write(high));
        page.push_str(&wrapped(&line, 2));
    }
    page.push('\n');
}

/// Limits of one kind, with what the optimum changes by for a slack of 1 mm.
fn binding(limits: &BindingLimits) -> String {
    let words = match limits.kind {
        "order" => "order of sections and waterlines",
        "signs" => "signs of curvature",
        "within" => "--within",
        other => other,
    };
    let price = if limits.kind == "signs" {
        format!("{:.1e} m2 per 1e-6/m", 1e-6 * limits.price)
    } else {
        format!("{:.1e} m2 per mm", 1e-3 * limits.price)
    };
    format!("{} of {words}, {price}", limits.count)
}

fn how(outputs: &DeriveOutputs) -> Vec<String> {
    let derived = &outputs.derived;
    let mut lines = Vec::new();
    if let Some([[aft, fore], low, high]) = derived.shift {
        let unit = if outputs.method == Method::Nearest { "of half lengths" } else { "of phi" };
        lines.push(format!(
            "Sections are shifted by {aft:+.4} aft and {fore:+.4} forward, {unit}; they pass each other beyond {:+.4} to {:+.4} and {:+.4} to {:+.4}.",
            low[0], high[0], low[1], high[1]
        ));
    }
    if let Some([low, high]) = derived.shift_reach {
        lines.push(format!("The shift alone reaches C_B {low:.4} to {high:.4}."));
    }
    if outputs.method == Method::Nearest {
        let signs = if derived.keeps_signs {
            "with the signs of curvature of the parent"
        } else {
            "without signs of curvature"
        };
        lines.push(format!(
            "Half-breadths change by least bending {signs}: energy {:.2e} m2, duality gap {:.0e} of the optimum. Prices are m2 per 1 % more of a target, of L_PP for LCB and LCF.",
            derived.energy, derived.gap
        ));
        if !derived.binding.is_empty() {
            let list: Vec<String> = derived.binding.iter().map(binding).collect();
            lines.push(format!("Limits that bind: {}.", list.join("; ")));
        }
        if let Some([aft, fore]) = derived.parallel_body {
            lines.push(format!("Sections below T are alike from {aft:.3} to {fore:.3} m forward of AP."));
        }
    }
    for (what, list) in [("height", &outputs.moved_heights), ("position", &outputs.moved_positions)] {
        for [from, to] in list {
            lines.push(format!(
                "What lies at {what} {from:.3} m of the parent at these dimensions is moved to {to:.3} m."
            ));
        }
    }
    let [before, after] = outputs.inflections;
    lines.push(format!("Inflections of stations and waterlines, scaled parent > daughter: {before} > {after}."));
    if outputs.middle_bodies.iter().any(Option::is_some) {
        let [scaled, own] = outputs
            .middle_bodies
            .map(|body| body.map_or("none".to_owned(), |[aft, fore]| format!("{aft:.3} to {fore:.3} m")));
        lines.push(format!("Parallel middle body, scaled parent > daughter: {scaled} > {own}."));
    }
    if let Some(moved) = outputs.moved {
        lines.push(format!(
            "Moved from the scaled parent: {:.3} m at most, at x {:.2} z {:.2}; RMS {:.3} m.",
            moved.largest, moved.at[0], moved.at[2], moved.rms
        ));
    }
    lines
}

/// The page, at most 80 columns.
#[must_use]
pub fn derive_page(outputs: &DeriveOutputs) -> String {
    let title = format!("{}, derived by {}", outputs.outputs.summary.name, outputs.method.as_str());
    let mut page = wrapped(&title, 2);
    page.push_str(&dimensions(outputs.derived.hull.particulars()));
    page.push('\n');
    targets(&mut page, outputs);
    if let Some([gm, kg]) = outputs.stability {
        let line = format!("GM {gm:.4} m with KG {kg:.4} m, without free surfaces: KM is their sum.");
        page.push_str(&wrapped(&line, 2));
    }
    how(outputs).iter().for_each(|line| page.push_str(&wrapped(line, 2)));
    page.push('\n');
    outputs.derived.waves.iter().for_each(|found| page.push_str(&waves_page(found, ["scaled", "bending m2"])));
    page.push_str(&compare_page(&outputs.comparison));
    page
}
