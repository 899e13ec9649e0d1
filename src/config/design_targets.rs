//! The design targets for the hull of the family `cosh`, in metres and radians.

use std::ops::Range;

use super::document::{Document, Raw};
use super::keys::{Kind, expected, preset_of};
use super::value::Scalar;
use crate::parametric::ShipType;
use crate::parametric::cosh::{DesignTargets, MidshipTarget};
use crate::units::{self, Dimension, Measure};

pub(super) fn design_targets(document: &mut Document<'_>, density: f64, complain: bool) -> DesignTargets {
    if complain {
        crate::config::document::require(document, &["dimensions.Lpp"], "the length is the least that a design says");
    }
    let preset = document.word("project.preset");
    let length = document.number("dimensions.Lpp").unwrap_or(f64::NAN);
    let (breadth, draught, depth) =
        (document.number("dimensions.B"), document.number("dimensions.T"), document.number("dimensions.D"));
    let (block, volume) = size(document, [Some(length), breadth, draught], density);
    let mut requested = DesignTargets {
        ship_type: preset.and_then(|word| ShipType::ALL.into_iter().find(|t| t.as_str() == preset_of(word))),
        length,
        breadth,
        draught,
        depth,
        block_coefficient: block,
        displacement_volume: volume,
        ..DesignTargets::default()
    };
    requested.midship_coefficient = document.number_or_word("form.Cm").map(|cm| match cm {
        Scalar::Word("kerlen") => MidshipTarget::Kerlen,
        Scalar::Word("hsva") => MidshipTarget::Hsva,
        Scalar::Word(_) => MidshipTarget::Benford,
        Scalar::Measure(number) => MidshipTarget::Value(number.value),
    });
    requested.lcb = centre_of_buoyancy(document, length);
    requested.waterplane_coefficient = match document.number_or_word("form.Cwp") {
        Some(Scalar::Measure(number)) => Some(number.value),
        _ => None,
    };
    requested.parallel_body =
        document.interval("form.parallel_body").map(|ends| ends.map(|fraction| fraction * length));
    requested.entrance_length = document.number("form.entrance_length");
    requested.run_length = document.number("form.run_length");
    lengths_add_up(document, &requested);
    requested.bilge_radius = document.number("form.bilge_radius");
    requested.deadrise = document.number("form.deadrise");
    requested.keel_breadth = document.number("form.keel_breadth");
    requested.section_character = document.number("form.section_character");
    requested.stem_rake = document.number("form.bow.rake");
    requested.forefoot = document.number("form.bow.forefoot");
    requested.maximum_half_entrance = document.number("form.bow.entrance_half_angle_max");
    requested.flare = document.number("form.bow.flare");
    requested.transom_breadth = scaled(document, "form.stern.transom_beam", breadth, "B").map(|beam| match breadth {
        Some(b) => beam / b,
        None => beam,
    });
    requested.transom_height = transom(document, draught, depth);
    requested.stern_overhang = document.number("form.stern.overhang");
    requested.cut_up = scaled(document, "form.stern.cut_up", Some(length), "Lpp");
    requested.sheer_fore = document.number("form.deck.sheer_fore");
    requested.sheer_aft = document.number("form.deck.sheer_aft");
    requested
}

/// Cb and displaced volume \[m^3\]; when both are given with L, B and T they must agree to 0.1 %.
fn size(document: &mut Document<'_>, dimensions: [Option<f64>; 3], density: f64) -> (Option<f64>, Option<f64>) {
    let block = document.number("form.Cb");
    let displacement = document.dimensioned("form.displacement");
    let volume = displacement.map(|m| if m.dimension == Dimension::Volume { m.value } else { m.value / density });
    let (Some(cb), Some(v), [Some(l), Some(b), Some(t)]) = (block, volume, dimensions) else { return (block, volume) };
    let box_volume = l * b * t;
    let difference = v / (cb * box_volume) - 1.0;
    if difference.abs() > 1e-3 {
        let span = document.entry("form.displacement").map_or(0..0, |e| e.key_span.clone());
        let message = format!(
            "displacement {:.1} t and Lpp B T Cb rho = {:.1} t disagree by {:.1} %",
            v * density,
            cb * box_volume * density,
            100.0 * difference.abs()
        );
        let help = format!(
            "Give one of them; this displacement is Cb {:.4}, or T {:.3} m with Cb {cb}.",
            v / box_volume,
            v / (l * b * cb)
        );
        document.problem("E110", "form.displacement", &span, message, help);
    }
    (block, None)
}

/// LCB from AP \[m\].
fn centre_of_buoyancy(document: &mut Document<'_>, length: f64) -> Option<f64> {
    let path = "form.LCB";
    let (raw, span, kind) = document.raw(path)?;
    if matches!(raw, Raw::Number(_)) {
        document.problem(
            "E123",
            path,
            &span,
            format!("{path} is {}, and its unit is missing", raw.describe()),
            "Write \"+0.8 %\" (of Lpp from midship, + forward) or \"41.0 m AP\".".into(),
        );
        return None;
    }
    let Raw::Text(text) = &raw else {
        document.unexpected(path, &raw, &span, kind);
        return None;
    };
    if text.trim().eq_ignore_ascii_case("auto") {
        return None;
    }
    position_along(document, path, text, &span, kind).map(|[share, shift]| share * length + shift)
}

/// A position along the ship, "+0.8 %" or "41.0 m AP": x = share L_PP + shift \[m\].
pub(super) fn position_along(
    document: &mut Document<'_>,
    path: &str,
    text: &str,
    span: &Range<usize>,
    kind: Kind,
) -> Option<[f64; 2]> {
    let text = text.trim();
    let (number, datum) = match text.rsplit_once(char::is_whitespace) {
        Some((number, word)) if ["ap", "fp", "midship"].contains(&word.to_ascii_lowercase().as_str()) => {
            (number, word.to_ascii_lowercase())
        }
        _ => (text, String::new()),
    };
    match (units::parse(number), datum.as_str()) {
        (Ok(Measure { value, dimension: Dimension::Percent }), "" | "midship") => Some([0.5 + value, 0.0]),
        (Ok(Measure { value, dimension: Dimension::Percent }), "ap") => Some([value, 0.0]),
        (Ok(Measure { value, dimension: Dimension::Length }), "" | "ap") => Some([0.0, value]),
        (Ok(Measure { value, dimension: Dimension::None }), "ap") => Some([0.0, value]),
        (Ok(Measure { value, dimension: Dimension::Length }), "fp") => Some([1.0, -value]),
        (Ok(Measure { value, dimension: Dimension::Length }), "midship") => Some([0.5, value]),
        (Ok(_), _) => {
            document.unexpected(path, &Raw::Text(text.to_owned()), span, kind);
            None
        }
        (Err(error), _) => {
            document.problem("E123", path, span, format!("{path}: {error}"), format!("Expected {}.", expected(kind)));
            None
        }
    }
}

/// Entrance, parallel body and run must make up Lpp.
fn lengths_add_up(document: &mut Document<'_>, requested: &DesignTargets) {
    let length = requested.length;
    let mut sum = Vec::new();
    let parallel = requested.parallel_body.map(|[from, to]| to - from);
    if let Some(run) = requested.run_length {
        sum.push(("run", run));
    }
    if let Some(parallel) = parallel {
        sum.push(("parallel body", parallel));
    }
    if let Some(entrance) = requested.entrance_length {
        sum.push(("entrance", entrance));
    }
    let total: f64 = sum.iter().map(|(_, part)| part).sum();
    let words: Vec<String> = sum.iter().map(|(name, part)| format!("{name} {part:.3} m")).collect();
    let words = words.join(" + ");
    let slack = 1e-3 * length;
    let place = |document: &Document<'_>| {
        ["form.entrance_length", "form.run_length", "form.parallel_body"]
            .iter()
            .find_map(|p| document.entry(p))
            .map_or(0..0, |e| e.key_span.clone())
    };
    if sum.len() == 3 && (total - length).abs() > slack {
        let span = place(document);
        document.problem(
            "E111",
            "form.entrance_length",
            &span,
            format!("{words} = {total:.3} m, and Lpp is {length:.3} m"),
            "Leave one of the three out.".into(),
        );
    } else if sum.len() == 2 && total > length + slack {
        let span = place(document);
        document.problem(
            "E111",
            "form.entrance_length",
            &span,
            format!("{words} = {total:.3} m is more than Lpp {length:.3} m"),
            format!("They may have {length:.3} m together."),
        );
    } else if let (Some([from, to]), true) = (requested.parallel_body, sum.len() == 2) {
        for (path, given, meant) in [
            ("form.run_length", requested.run_length, from),
            ("form.entrance_length", requested.entrance_length, length - to),
        ] {
            if let (Some(given), Some(span)) = (given, document.entry(path).map(|e| e.key_span.clone()))
                && (given - meant).abs() > slack
            {
                document.problem(
                    "E111",
                    path,
                    &span,
                    format!("{path} is {given:.3} m, and parallel_body leaves {meant:.3} m"),
                    "Give one of them.".into(),
                );
            }
        }
    }
}

/// A fraction of a dimension, or a length with its unit \[m\].
fn scaled(document: &mut Document<'_>, path: &str, whole: Option<f64>, name: &str) -> Option<f64> {
    let measure = document.dimensioned(path)?;
    match (measure.dimension, whole) {
        (Dimension::Length, Some(_)) => Some(measure.value),
        (Dimension::Length, None) if path == "form.stern.transom_beam" => {
            absent(document, path, name, "write a fraction");
            None
        }
        (Dimension::Length, None) => Some(measure.value),
        (_, Some(whole)) => Some(measure.value * whole),
        // The breadth of the transom stays a fraction.
        (_, None) if path == "form.stern.transom_beam" => Some(measure.value),
        (_, None) => {
            absent(document, path, name, "write a length with its unit");
            None
        }
    }
}

fn absent(document: &mut Document<'_>, path: &str, name: &str, else_do: &str) {
    let span = document.entry(path).map_or(0..0, |e| e.key_span.clone());
    document.problem(
        "E125",
        path,
        &span,
        format!("{path} is measured by {name}, which the design does not say"),
        format!("Give {name}, or {else_do}."),
    );
}

/// Height of the lowest point of the transom \[m\], from either of its two keys.
fn transom(document: &mut Document<'_>, draught: Option<f64>, depth: Option<f64>) -> Option<f64> {
    let height = scaled(document, "form.stern.transom_height", depth, "D");
    let immersion = scaled(document, "form.stern.transom_immersion", draught, "T");
    if let (Some(first), Some(second)) =
        (document.entry("form.stern.transom_height"), document.entry("form.stern.transom_immersion"))
    {
        let span = first.key_span.start.max(second.key_span.start)..first.key_span.end;
        document.problem(
            "E126",
            "form.stern.transom_immersion",
            &span,
            "transom_height and transom_immersion say the same thing twice".into(),
            "Give one of them.".into(),
        );
        return height;
    }
    match (immersion, draught) {
        (Some(immersion), Some(draught)) => Some(draught - immersion),
        (Some(_), None) => {
            absent(document, "form.stern.transom_immersion", "T", "use transom_height");
            None
        }
        (None, _) => height,
    }
}

#[cfg(test)]
mod tests {
    use super::super::read;
    use super::*;
    use crate::parametric::Family;

    fn cosh(text: &str) -> DesignTargets {
        match read("a/coaster.toml", text).unwrap_or_else(|e| panic!("{e:#?}")).family {
            Family::Cosh(requested) => *requested,
            other => panic!("{other:?}"),
        }
    }

    fn close(a: Option<f64>, b: f64) {
        assert!(a.is_some_and(|a| (a - b).abs() < 1e-9), "{a:?} {b}");
    }

    #[test]
    fn units_and_fractions_become_metres_and_radians() {
        let requested = cosh(
            "[DIMENSIONS]\nlpp = \"80 m\"\nb = 13.2\nT = \"5200 mm\"\nd = 7\n[form]\nCB = 0.72\nCm = \"Kerlen\"\nLCB = \"+0.8 %\"\n\
             Cwp = \"auto\"\nparallel_body = [0.42, \"58 %\"]\n[form.bow]\nrake = 12\nflare = \"0.2 rad\"\n\
             [form.stern]\ntransom_beam = \"6.6 m\"\ntransom_height = 0.5\ncut_up = 0.125",
        );
        close(Some(requested.length), 80.0);
        close(requested.draught, 5.2);
        close(requested.lcb, 40.64);
        close(requested.parallel_body.map(|p| p[1]), 46.4);
        close(requested.stem_rake, 12f64.to_radians());
        close(requested.flare, 0.2);
        close(requested.transom_breadth, 0.5);
        close(requested.transom_height, 3.5);
        close(requested.cut_up, 10.0);
        assert_eq!(requested.midship_coefficient, Some(MidshipTarget::Kerlen));
        assert_eq!(requested.waterplane_coefficient, None);
    }

    #[test]
    fn presets_have_other_names() {
        let of = |word: &str| cosh(&format!("project.preset = \"{word}\"\ndimensions.Lpp = 80")).ship_type;
        assert_eq!(of("Tanker"), Some(ShipType::BulkCarrier));
        assert_eq!((of("trawler"), of("coaster")), (Some(ShipType::Fishing), Some(ShipType::GeneralCargo)));
        assert_eq!((of("ferry"), of("cruise")), (Some(ShipType::RoRo), of("ro-ro")));
    }

    #[test]
    fn displacement_is_mass_or_volume() {
        let with = |d: &str| cosh(&format!("dimensions.Lpp = 80\nform.displacement = {d}\nwater.density = 1.0"));
        close(with("4000").displacement_volume, 4000.0);
        close(with("\"4000 m3\"").displacement_volume, 4000.0);
        close(cosh("dimensions.Lpp = 80\nform.displacement = \"1025 t\"").displacement_volume, 1000.0);
    }

    #[test]
    fn centre_of_buoyancy_in_every_form() {
        let with = |lcb: &str| cosh(&format!("dimensions.Lpp = 80\nform.LCB = \"{lcb}\"")).lcb;
        for (text, x) in [
            ("-1 %", 39.2),
            ("41.0 m AP", 41.0),
            ("41 AP", 41.0),
            ("41 m", 41.0),
            ("38 m FP", 42.0),
            ("-1 m midship", 39.0),
        ] {
            close(with(text), x);
        }
        assert_eq!(with("auto"), None);
    }

    #[test]
    fn immersion_is_a_fraction_of_the_draught() {
        let with = |v: &str| {
            cosh(&format!("dimensions = {{ Lpp = 80, T = 5, D = 8 }}\nform.stern.transom_immersion = {v}"))
                .transom_height
        };
        close(with("0.1"), 4.5);
        close(with("\"0.2 m\""), 4.8);
    }
}
