//! Commented design files to begin with.

use super::keys::{KEYS, Key, preset_of};

/// One design to begin with: its word, what it shows, and its values by path; a value that starts with `#` is shown as a
/// comment.
#[derive(Debug, Clone, Copy)]
pub struct Template {
    /// The word for `loftsman new`.
    pub name: &'static str,
    /// One line on what it is.
    pub title: &'static str,
    values: &'static [(&'static str, &'static str)],
}

/// Every design to begin with: the types of ship, then the other families.
pub const TEMPLATES: &[Template] = &[
    Template {
        name: "bulk-carrier",
        title: "Panamax bulk carrier: full, long parallel body, circular bilge",
        values: &[
            ("dimensions.Lpp", "217.0"),
            ("dimensions.B", "32.25"),
            ("dimensions.T", "12.2"),
            ("dimensions.D", "18.0"),
            ("form.Cb", "0.80"),
            ("form.Cm", "0.99"),
        ],
    },
    Template {
        name: "container",
        title: "Container ship: fine ends, transom, flare forward",
        values: &[
            ("dimensions.Lpp", "230.0"),
            ("dimensions.B", "32.2"),
            ("dimensions.T", "10.8"),
            ("dimensions.D", "19.0"),
            ("form.Cb", "0.65"),
            ("form.Cm", "0.98"),
        ],
    },
    Template {
        name: "general-cargo",
        title: "Coaster of 80 m",
        values: &[
            ("dimensions.Lpp", "80.0"),
            ("dimensions.B", "13.2"),
            ("dimensions.T", "5.2"),
            ("dimensions.D", "7.0"),
            ("form.Cb", "0.72"),
            ("form.Cm", "\"kerlen\""),
        ],
    },
    Template {
        name: "ro-ro",
        title: "Ro-ro ferry",
        values: &[
            ("dimensions.Lpp", "160.0"),
            ("dimensions.B", "25.0"),
            ("dimensions.T", "6.5"),
            ("dimensions.D", "14.5"),
            ("form.Cb", "0.60"),
            ("form.Cm", "0.95"),
        ],
    },
    Template {
        name: "tug",
        title: "Harbour tug",
        values: &[
            ("dimensions.Lpp", "28.0"),
            ("dimensions.B", "9.0"),
            ("dimensions.T", "3.6"),
            ("dimensions.D", "4.8"),
            ("form.Cb", "0.54"),
            ("form.Cm", "0.88"),
        ],
    },
    Template {
        name: "fishing",
        title: "Fishing vessel of 21 m",
        values: &[
            ("dimensions.Lpp", "21.04"),
            ("dimensions.B", "6.86"),
            ("dimensions.T", "2.5"),
            ("dimensions.D", "3.7"),
            ("form.Cb", "0.50"),
            ("form.Cm", "0.80"),
        ],
    },
    Template {
        name: "frigate",
        title: "Frigate: fast, transom stern, round bilge",
        values: &[
            ("dimensions.Lpp", "142.0"),
            ("dimensions.B", "19.06"),
            ("dimensions.T", "6.15"),
            ("dimensions.D", "12.0"),
            ("form.Cb", "0.50"),
            ("form.Cm", "0.80"),
        ],
    },
    Template {
        name: "yacht",
        title: "Sailing yacht, canoe body",
        values: &[
            ("dimensions.Lpp", "10.0"),
            ("dimensions.B", "3.0"),
            ("dimensions.T", "0.6"),
            ("dimensions.D", "1.6"),
            ("form.Cb", "0.40"),
            ("form.Cm", "0.70"),
        ],
    },
    Template {
        name: "wigley",
        title: "Wigley hull, the parabolic test body: Cb 4/9, Cm 2/3",
        values: &[
            ("dimensions.Lpp", "100.0"),
            ("dimensions.B", "10.0"),
            ("dimensions.T", "6.25"),
            ("dimensions.D", "10.0"),
        ],
    },
    Template {
        name: "box",
        title: "Rectangular box: every coefficient is 1",
        values: &[
            ("dimensions.Lpp", "100.0"),
            ("dimensions.B", "20.0"),
            ("dimensions.T", "5.0"),
            ("dimensions.D", "10.0"),
        ],
    },
    Template {
        name: "ellipsoid",
        title: "Ellipsoid with its centre in the waterplane: Cb pi/6",
        values: &[
            ("dimensions.Lpp", "60.0"),
            ("dimensions.B", "20.0"),
            ("dimensions.T", "8.0"),
            ("dimensions.D", "12.0"),
        ],
    },
    Template {
        name: "ucl-cosh",
        title: "Raw hyperbolic-cosine generator, the frigate of its lineage",
        values: &[
            ("dimensions.Lpp", "100.0"),
            ("dimensions.B", "15.0"),
            ("dimensions.T", "5.0"),
            ("dimensions.D", "9.4"),
            ("form.raw.ms", "1.5"),
            ("form.raw.bow", "0.1"),
            ("form.raw.transom", "1.5"),
            ("form.raw.deck", "0.8"),
            ("form.raw.tb", "0.9"),
            ("form.raw.td", "0.4"),
            ("form.raw.acu", "0.2"),
            ("form.raw.kf", "0.9"),
            ("form.raw.sa", "0.13"),
        ],
    },
];

/// What is shown, as a comment, for a key that a template leaves to its default.
fn sample(path: &str) -> &'static str {
    match path {
        "form.displacement" => "\"4050 t\"",
        "form.LCB" => "\"auto\"",
        "form.Cwp" => "\"auto\"",
        "form.parallel_body" => "[0.42, 0.58]",
        "form.entrance_length" | "form.run_length" => "\"30 m\"",
        "form.bilge_radius" => "\"2.5 m\"",
        "form.deadrise" => "\"3 deg\"",
        "form.keel_breadth" => "\"0.8 m\"",
        "form.section_character" => "0.0",
        "form.bow.rake" => "\"12 deg\"",
        "form.bow.forefoot" => "\"1.5 m\"",
        "form.bow.entrance_half_angle_max" => "\"25 deg\"",
        "form.bow.flare" => "\"10 deg\"",
        "form.stern.transom_beam" => "0.80",
        "form.stern.transom_height" => "0.45",
        "form.stern.transom_immersion" => "0.05",
        "form.stern.overhang" => "\"2 m\"",
        "form.stern.cut_up" => "0.12",
        "form.deck.sheer_fore" => "\"1.2 m\"",
        "form.deck.sheer_aft" => "\"0.6 m\"",
        "water.density" => "1.025",
        "water.shell" => "{ thickness = \"10 mm\" }",
        "water.keel_thickness" => "\"15 mm\"",
        "weight.KG" => "\"7.5 m\"",
        "conventions.coefficient_length" => "\"Lpp\"",
        "conventions.section_for_Cp" => "\"maximum\"",
        "conventions.lcb_reference" => "\"AP\"",
        "conventions.station_zero" => "\"AP\"",
        "conventions.stations" => "20",
        "output.draughts" => "{ from = 1.0, to = 6.5, step = 0.25 }",
        "output.stations" => "\"0,5,...,80\"",
        "output.waterlines" => "\"0:7:0.5\"",
        "output.buttocks" => "\"1,2,3\"",
        "output.figures" => "\"all\"",
        "reference.source" => "\"tank report 123, page 4\"",
        "reference.note" => "\"keel draughts in the report\"",
        "reference.table" => "\"T,DISPVOL\\n3.0,1234.5\"",
        _ => "0.0",
    }
}

/// The family and the preset of a template.
fn family(name: &str) -> (&str, Option<&str>) {
    match name {
        "wigley" | "box" | "ellipsoid" | "ucl-cosh" => (name, None),
        preset => ("cosh", Some(preset)),
    }
}

/// The commented design file of the template `name`, or of the preset that it is another word for; none when there is
/// no such template.
#[must_use]
pub fn template(name: &str) -> Option<String> {
    let name = preset_of(name);
    let template = TEMPLATES.iter().find(|t| t.name.eq_ignore_ascii_case(name))?;
    let (family, preset) = family(template.name);
    let mut text = format!(
        "# {}.\n# Plain numbers are SI units and degrees; with a unit they stand in quotes: \"32250 mm\", \"62 ft 3 in\", \"12 deg\".\n\
         # Lines that begin with # show further keys; what is left out gets a default that the output names.\n",
        template.title
    );
    let mut table = "";
    for key in KEYS.iter().filter(|key| key.families.is_empty() || key.families.contains(&family)) {
        if key.table != table {
            table = key.table;
            text.push_str(&format!("\n[{table}]\n"));
        }
        let path = key.path();
        let value = match path.as_str() {
            "schema" => Some("1".to_owned()),
            "project.name" => Some(format!("\"{}\"", template.name)),
            "project.family" => Some(format!("\"{family}\"")),
            "project.preset" => preset.map(|word| format!("\"{word}\"")),
            path => template.values.iter().find(|(p, _)| *p == path).map(|(_, v)| (*v).to_owned()),
        };
        text.push_str(&line(key, &path, value.as_deref()));
    }
    Some(text)
}

fn line(key: &Key, path: &str, value: Option<&str>) -> String {
    let (mark, value) = match value {
        Some(value) => ("", value),
        None => ("# ", sample(path)),
    };
    format!("# {}\n{mark}{} = {value}\n", key.description, key.name)
}

#[cfg(test)]
mod tests {
    use super::super::read;
    use super::*;

    #[test]
    fn every_template_reads_without_a_message() {
        for template in TEMPLATES {
            let text = super::template(template.name).unwrap();
            let design = read("new.toml", &text).unwrap_or_else(|e| panic!("{}: {e:?}", template.name));
            assert_eq!(design.name, template.name);
        }
    }

    #[test]
    fn what_a_template_shows_in_comments_is_valid_too() {
        let text = super::template("general-cargo").unwrap();
        let shown: String = text
            .lines()
            .map(|line| match line.strip_prefix("# ") {
                Some(rest) if rest.split_once(" = ").is_some_and(|(key, _)| KEYS.iter().any(|k| k.name == key)) => rest,
                _ => line,
            })
            // These say twice what other lines say.
            .filter(|line| {
                !["displacement", "transom_immersion", "entrance_length", "run_length"]
                    .iter()
                    .any(|k| line.starts_with(k))
            })
            .map(|line| format!("{line}\n"))
            .collect();
        read("new.toml", &shown).unwrap_or_else(|e| panic!("{e:#?}\n{shown}"));
    }

    #[test]
    fn every_ship_type_has_a_template() {
        for ship in crate::parametric::ShipType::ALL {
            assert!(template(ship.as_str()).is_some(), "{}", ship.as_str());
        }
        assert_eq!(template("tanker"), template("bulk-carrier"));
        assert!(template("submarine").is_none());
    }
}
