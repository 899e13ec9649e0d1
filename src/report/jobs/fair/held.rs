//! What `fair` prints of the whole hull: displacement and its centre, curvature, what is held and at which price.

use super::job::FairOutputs;
use super::words::{counted, line_name, millimetres, more_than};
use crate::exchange::priced;
use crate::fairing::change::Turns;
use crate::fairing::constraint::Constraint;
use crate::fairing::held::Held;
use crate::fairing::inspect::PolygonSigns;
use crate::fairing::outcome::Outcome;
use crate::fairing::relinearise::ON_TARGET;
use crate::hydrostatics::Quantity;
use crate::report::words::page::{fixed, fixed_sign, wrapped};

/// Section areas that the page lists one by one.
pub(in crate::report) const MOST_AREAS: usize = 4;

/// Part of a target that a quantity on it is off by rounding.
const ROUNDING: f64 = 1e-12;

/// A constraint before and after, and what holding it costs.
fn held_line(held: &Held, length: Option<f64>, nearest: bool) -> String {
    let target = held.constraint.target();
    let (unit, decimals) = match held.constraint {
        Constraint::Displacement(_) | Constraint::Volume { .. } => (" m3", 3),
        Constraint::CentreOfBuoyancy(_)
        | Constraint::CentreOfFlotation(_)
        | Constraint::CentreOfVolume { .. }
        | Constraint::HeightOfBuoyancy(_)
        | Constraint::Metacentre { .. } => (" m", 4),
        Constraint::WaterplaneArea(_) | Constraint::SectionArea { .. } | Constraint::WettedSurface(_) => (" m2", 3),
        _ => ("", 6),
    };
    let percent = match (held.constraint, length) {
        (
            Constraint::CentreOfBuoyancy(_) | Constraint::CentreOfFlotation(_) | Constraint::CentreOfVolume { .. },
            Some(length),
        ) => {
            format!(" ({:+.3} % L)", 100.0 * (held.after / length - 0.5))
        }
        _ => String::new(),
    };
    let words = held.constraint.words();
    let missed = nearest && !held.is_had();
    let [low, high] = held.interval();
    let off = match held.missed() {
        _ if missed => {
            format!(
                "{} were asked for and are out of reach: this is the nearest found that leaves a fair hull",
                fixed(target, decimals) + unit
            )
        }
        off if held.band > 0.0 => {
            let place = if off.abs() > 0.0 { format!("{off:.0e}{unit} outside") } else { "within".to_owned() };
            // A band that nobody stated is that of the errors of the table.
            let why = if held.band > held.constraint.band() { ", two standard errors about the likeliest" } else { "" };
            format!("{place} {} to {}{why}", fixed(low, decimals), fixed(high, decimals) + unit)
        }
        off if off.abs() > ROUNDING * target.abs() => format!("off target by {off:.0e}"),
        _ => "on target".to_owned(),
    };
    let price = priced(if missed { "what was reached" } else { "it" }, held.price);
    format!(
        "{words}: {} -> {}{unit}{percent}, {off}; {price}.",
        fixed(held.before, decimals),
        fixed(held.after, decimals),
    )
}

/// Monotone pieces and total variation of curvature on stations and waterlines, and the regions of the surface.
fn pieces(outcome: &Outcome) -> String {
    let [before, after] = outcome.monotone_pieces();
    let least = outcome.least_monotone_pieces().map_or(String::new(), |least| format!(" (least {least})"));
    let variation = outcome.variation().map_or(String::new(), |[before, after]| {
        format!(" total variation over its range, in the median of the lines, {before:.1} -> {after:.1};")
    });
    let [regions, regions_after] = outcome.regions;
    let line = format!(
        "Curvature of stations and waterlines: monotone pieces {before} -> {after}{least};{variation} regions of one sign of \
         Gaussian curvature {regions} -> {regions_after}. A bump counts from {} mm.",
        millimetres(outcome.resolution)
    );
    wrapped(&line, 2)
}

/// How many lines bend more often than the signs that they were asked for say; nothing where none does.
fn more_than_asked(outputs: &FairOutputs) -> String {
    let kinds = outputs.certificate["inflections"].as_object().into_iter().flatten();
    let lines = kinds.flat_map(|(_, lines)| lines.as_array().into_iter().flatten());
    let lines: Vec<_> = lines.filter(|line| more_than(line, "asked").is_some()).collect();
    let worse = lines.iter().filter(|line| more_than(line, "before").is_some()).count();
    match lines.len() {
        0 => String::new(),
        n => wrapped(
            &format!(
                "{} than was asked of {}, {} than before (asked and after in fairing.json): signs are asked for at places along a \
                 line, and what is held may leave it no room for them.",
                counted(n, "line bends more often", "lines bend more often"),
                if n == 1 { "it" } else { "them" },
                match worse {
                    0 => "none more often".to_owned(),
                    worse if worse == n => "more often".to_owned(),
                    worse => format!("{worse} of them more often"),
                }
            ),
            2,
        ),
    }
}

/// Displacement and LCB before and after, or volume and its centre where no draught is stated, with `arrow` between.
pub(in crate::report) fn change_of_form(outputs: &FairOutputs, arrow: &str) -> String {
    let length = outputs.outcome.after.particulars().length_between_perpendiculars;
    let moved = |a: f64, b: f64| fixed_sign(100.0 * (b - a) / length, 3, " % L");
    match &outputs.rows {
        Some([before, after]) => {
            let [a, b] = [before, after].map(|row| crate::report::words::page::value(row, "DISPM"));
            let change = share(before.displacement_volume, after.displacement_volume);
            let lcb = before.lcb.zip(after.lcb).map_or(String::new(), |(a, b)| format!(", LCB {}", moved(a, b)));
            format!("Displacement {a} {arrow} {b} t{change}{lcb}")
        }
        None => {
            let (below, [volumes, centres]) = volumes(&outputs.outcome);
            let (change, [a, b]) = (share(volumes[0], volumes[1]), volumes.map(volume_of));
            let centre = moved(centres[0], centres[1]);
            format!("Volume below z = {below:.3} m {a} {arrow} {b} m3{change}, its centre {centre}")
        }
    }
}

/// Displacement, LCB, KB and C_M of both hulls.
pub(in crate::report) fn hydrostatics(outputs: &FairOutputs, page: &mut String) {
    let length = outputs.outcome.after.particulars().length_between_perpendiculars;
    let from_midship = outputs.outcome.before.counts_from_aft_perpendicular().then_some(length);
    let mut line = change_of_form(outputs, "->") + ".";
    let turns = ["waterline", "station", "buttock", "diagonal"].map(|kind| outputs.outcome.inflections(kind));
    let sum = |side: usize| turns.iter().map(|counts| counts[side]).sum::<usize>();
    line.push_str(&format!(" Inflections {} -> {}:", sum(0), sum(1)));
    for (kind, [a, b]) in ["waterlines", "stations", "buttocks", "diagonals"].iter().zip(turns) {
        line.push_str(&format!(" {kind} {a} -> {b}{}", if *kind == "diagonals" { "." } else { "," }));
    }
    page.push_str(&wrapped(&line, 2));
    page.push_str("  (buttocks and diagonals are no lines of the table: they were never used)\n");
    page.push_str(&pieces(&outputs.outcome));
    page.push_str(&more_than_asked(outputs));
    page.push_str(&far_above_the_least(&outputs.outcome));
    let sum =
        |side: usize, count: fn(&PolygonSigns) -> usize| outputs.outcome.signs[side].iter().map(count).sum::<usize>();
    let line = format!(
        "Control polygon, signs + and -: {} -> {} changes, {} -> {} enclosed by two of the other (control-polygon.csv).",
        sum(0, |line| line.changes),
        sum(1, |line| line.changes),
        sum(0, |line| line.enclosed),
        sum(1, |line| line.enclosed)
    );
    page.push_str(&wrapped(&line, 2));
    if let Some(jump) = outputs.outcome.jump {
        let line = format!("Largest jump of curvature that fairing adds across lines of the net: {jump:.1e} 1/m.");
        page.push_str(&wrapped(&line, 2));
    }
    if outputs.outcome.held.is_empty() {
        page.push_str("Nothing of the whole hull is held.\n");
    }
    let areas = outputs.outcome.held.iter().filter(|held| matches!(held.constraint, Constraint::SectionArea { .. }));
    let areas: Vec<&Held> = areas.collect();
    let whole = areas.len() > MOST_AREAS;
    for held in &outputs.outcome.held {
        if !(whole && matches!(held.constraint, Constraint::SectionArea { .. })) {
            page.push_str(&wrapped(&held_line(held, from_midship, outputs.outcome.nearest), 2));
        }
    }
    if whole {
        let off = areas.iter().map(|held| held.missed().abs() / held.scale);
        let price = areas.iter().map(|held| held.price).fold(0.0, f64::max);
        let moved = areas.iter().map(|held| (held.after - held.before).abs()).fold(0.0, f64::max);
        let line = format!(
            "Section areas at {} places: off target by {:.0e} B T at most, changed by {moved:.3} m2 at most. Of the most expensive one, {} \
             (fairing.json).",
            areas.len(),
            off.fold(0.0, f64::max),
            priced("it", price)
        );
        page.push_str(&wrapped(&line, 2));
    }
    if outputs.outcome.targets_off(ON_TARGET) > 1 {
        let line = "The price of a target is the moves that the same program saves without it, the signs of its lines unchanged. A job \
                    without it may choose other signs.";
        page.push_str(&wrapped(line, 2));
    }
    for held in &outputs.outcome.rules {
        let words = held.rule.words();
        let binds = match held.binding {
            _ if held.given_up => "GIVEN UP, it is infeasible with the other targets".to_owned(),
            0 => "does not bind".to_owned(),
            n if n == held.rows => priced("it", held.price),
            n => format!("binds in {n} of {} rows; {}", held.rows, priced("it", held.price)),
        };
        page.push_str(&wrapped(&format!("{}{}: {binds}.", words[..1].to_uppercase(), &words[1..]), 2));
    }
    if let Some(errors) = &outputs.outcome.faired.settled {
        let last = errors.last().copied().unwrap_or(0.0);
        let steps = counted(errors.len() - 1, "step", "steps");
        let line = if last <= ON_TARGET {
            format!("Successive linearisation took {steps}: relative error {last:.0e}.")
        } else {
            format!("Successive linearisation STALLED after {steps}, {last:.0e} of its target away.")
        };
        page.push_str(&wrapped(&line, 2));
    }
}

/// A change in parts of what was before, ` (+0.012 %)`; nothing where there was nothing.
pub(in crate::report) fn share(before: f64, after: f64) -> String {
    if before.abs() > 0.0 {
        format!(" ({})", fixed_sign(100.0 * (after / before - 1.0), 3, " %"))
    } else {
        String::new()
    }
}

/// A volume \[m^3\] in as many decimals as a displacement volume has.
pub(in crate::report) fn volume_of(volume: f64) -> String {
    fixed(volume, Quantity::of("DISPVOL").map_or(1, |quantity| quantity.decimals_of(volume)))
}

/// The height \[m\] of [`Hull::reference_height`](crate::hull::Hull::reference_height) of the surface through the table,
/// and below it the volume \[m^3\] and its centre \[m\] before and after.
pub(in crate::report) fn volumes(outcome: &Outcome) -> (f64, [[f64; 2]; 2]) {
    let below = outcome.held_below().map_or_else(|| outcome.before.reference_height(), |(below, _)| below);
    let quantities = [Constraint::Volume { volume: 0.0, below }, Constraint::CentreOfVolume { x: 0.0, below }];
    (below, quantities.map(|quantity| [&outcome.before, &outcome.after].map(|hull| quantity.value(hull))))
}

/// Inflections that a line keeps above its proved least from which the page names it, and how many lines it names.
const ABOVE: usize = 4;
const NAMED: usize = 4;

/// The lines that keep most inflections above their proved least, and how fewer can be asked for; nothing where none
/// keeps many.
fn far_above_the_least(outcome: &Outcome) -> String {
    let least = |turns: &Turns| turns.minimum.filter(|(_, proved)| *proved).map(|(least, _)| least);
    let above = |turns: &Turns| least(turns).map_or(0, |least| turns.after.saturating_sub(least));
    let mut lines: Vec<&Turns> = outcome.turns.iter().filter(|turns| above(turns) >= ABOVE).collect();
    if lines.is_empty() {
        return String::new();
    }
    let count = lines.len();
    lines.sort_by_key(|turns| std::cmp::Reverse(above(turns)));
    let name = |turns: &&Turns| {
        format!("{} {} (least {})", line_name(&turns.cut), turns.after, least(turns).unwrap_or_default())
    };
    let names: Vec<String> = lines.iter().take(NAMED).map(name).collect();
    let more = if count > NAMED { format!(", {} more", count - NAMED) } else { String::new() };
    let line = format!(
        "Lines that keep more inflections than necessary, since removing them would move offsets too far: {}{more}. \
         shape.inflections requires fewer at any cost.",
        names.join(", ")
    );
    wrapped(&line, 2)
}
