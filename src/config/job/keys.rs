//! The keys of the job file.

use super::super::keys::{Key, Kind, key};
use crate::fairing::strength::Fairness;

pub(super) const HOLD: [&str; 2] = ["table", "free"];
const AUTO: [&str; 1] = ["auto"];

const fn hold(name: &'static str, kind: &'static Kind, description: &'static str) -> Key {
    key("hold", name, Kind::OrWord(kind, &HOLD), &[], description)
}

const fn shape(name: &'static str, description: &'static str) -> Key {
    key("shape", name, Kind::Phrases(r#""waterline 6.5 from 0 to 5", "station 5 from 2 m""#), &[], description)
}

/// Every key of the job file.
pub const JOB_KEYS: &[Key] = &[
    key("", "schema", Kind::Integer(1, 1), &[], "Version of the keys: 1."),
    key(
        "",
        "fairness",
        Kind::NumberOrWord(&Fairness::NAMES),
        &[],
        "How strongly the table is faired, from 0, the surface through the table, to 10; or \"raw\" (0), \"light\" (3), \"fair\" (5), \"smooth\" (8). Default: 5.",
    ),
    key(
        "table",
        "file",
        Kind::Text,
        &[],
        "Table of offsets, relative to this file. Default: the one that the command names.",
    ),
    key("dimensions", "Lpp", Kind::Length, &[], "L_PP, over what the table states."),
    key("dimensions", "B", Kind::Length, &[], "B moulded, over what the table states."),
    key(
        "dimensions",
        "T",
        Kind::Length,
        &[],
        "Design draught, over what the table states: what is held holds there. Without one volume and centre of volume are held, and targets are refused.",
    ),
    key("dimensions", "D", Kind::Length, &[], "Depth to the deck at side, over what the table states."),
    key("water", "density", Kind::Density, &[], "Density of the water. Default: 1.025 t/m3."),
    key(
        "energy",
        "weight",
        Kind::NumberOrWord(&AUTO),
        &[],
        "Smoothing weight; \"auto\" takes that for the errors of the table (Mallows), on an independent net that of least generalised cross-validation. Default: \"auto\".",
    ),
    key(
        "tolerance",
        "table",
        Kind::Length,
        &[],
        "Greatest move of an offset. Default: three times the noise about it, at least twice the resolution of the table; on the net of the surface through the table at most B/1000 or 15 mm, unless that is three times as rough.",
    ),
    key("tolerance", "stations", Kind::NamedLengths, &[], "Tolerances of single stations, { \"10\" = \"1 mm\" }."),
    key(
        "tolerance",
        "waterlines",
        Kind::NamedLengths,
        &[],
        "Tolerances of single waterlines, { \"6.5 m\" = \"1 mm\" }.",
    ),
    key("tolerance", "cells", Kind::NamedLengths, &[], "Tolerances of single cells, { \"10@6.5\" = \"1 mm\" }."),
    key("lock", "stations", Kind::Names, &[], "Stations that do not move: names of the table, or positions."),
    key("lock", "waterlines", Kind::Names, &[], "Waterlines that do not move: heights."),
    key("lock", "cells", Kind::Names, &[], "Cells that do not move, \"station@waterline\"."),
    key(
        "lock",
        "lines",
        Kind::Phrases(r#""stem", "deck", "waterline 6.5", "line KNUCKLE 1""#),
        &[],
        "Lines that stay where the surface through the table has them: \"stem\", \"stern\", \"keel\", \"deck\", \"station 5\", \"waterline 6.5\", \"line NAME\" for a knuckle or tangent line of the table.",
    ),
    hold(
        "displacement",
        &Kind::Displacement,
        "Displacement at the design draught. Default: \"table\". Without a draught the default is the volume below the highest waterline that every station between the ends has.",
    ),
    hold("Cb", &Kind::Number, "Block coefficient, instead of the displacement."),
    hold("LCB", &Kind::CentreOfBuoyancy, "Longitudinal centre of buoyancy. Default: \"table\"."),
    hold("KB", &Kind::Length, "Height of the centre of buoyancy above the base line. Default: \"free\"."),
    hold("LCF", &Kind::CentreOfBuoyancy, "Longitudinal centre of flotation. Default: \"free\"."),
    hold("Cwp", &Kind::Number, "Waterplane coefficient. Default: \"free\"."),
    hold("waterplane_area", &Kind::Area, "Waterplane area, instead of Cwp. Default: \"free\"."),
    hold("Cm", &Kind::Number, "Midship section coefficient. Default: \"table\"."),
    hold("KM", &Kind::Length, "Height of the transverse metacentre above the base line. Default: \"free\"."),
    hold("GM", &Kind::Length, "Transverse metacentric height, instead of KM; needs KG. Default: \"free\"."),
    key("hold", "KG", Kind::Length, &[], "Height of the centre of gravity above the base line, for GM."),
    hold("wetted_surface", &Kind::Area, "Wetted surface at the design draught. Default: \"free\"."),
    key(
        "tangent",
        "entrance",
        Kind::NamedAngles(r#""6.5" = "12 deg""#),
        &[],
        "Half angles of entrance of waterlines, { \"6.5\" = \"12 deg\" }.",
    ),
    key("tangent", "run", Kind::NamedAngles(r#""6.5" = "12 deg""#), &[], "Half angles of run of waterlines."),
    key(
        "tangent",
        "waterlines",
        Kind::NamedAngles(r#""5@6.5" = "4 deg""#),
        &[],
        "Angles of waterlines from the centreline at \"station@height\", positive where the half-breadth rises forward.",
    ),
    key(
        "tangent",
        "stations",
        Kind::NamedAngles(r#""5@6.5" = "0 deg""#),
        &[],
        "Angles of stations from the vertical at \"station@height\", positive where the half-breadth rises upward; 0 deg where a flat of side begins.",
    ),
    key(
        "flat",
        "side",
        Kind::Phrases(r#""stations 8 to 12, waterlines 3 to 9.75""#),
        &[],
        "Flats of side, \"stations 8 to 12, waterlines 3 to 9.75\": the half-breadth is B/2 there.",
    ),
    key(
        "flat",
        "bottom",
        Kind::Phrases(r#""stations 8 to 12""#),
        &[],
        "Flats of bottom, \"stations 8 to 12\": their edge stays where the surface through the table has it.",
    ),
    shape(
        "rising",
        "Parts of lines on which the half-breadth rises, forward along a waterline and upward along a station.",
    ),
    shape("falling", "Parts of lines on which the half-breadth falls."),
    shape("convex", "Parts of lines that are convex, full as seen from outside."),
    shape("concave", "Parts of lines that are concave, hollow as seen from outside."),
    key(
        "shape",
        "inflections",
        Kind::NamedCounts(r#""waterline 6.5" = 1"#),
        &[],
        "Most inflections of lines or parts of them, { \"waterline 6.5\" = 1, \"station 0 from 2 m to 6 m\" = 0 }.",
    ),
    key(
        "hold",
        "section_areas",
        Kind::SectionAreas,
        &[],
        "Areas of sections below the design draught, both sides: [[x, area], [x, area, band]], a CSV of x, area and band (a path from \
         this file), or \"table\": those of the table at every station.",
    ),
    key(
        "hold",
        "section_area_band",
        Kind::Number,
        &["0.5"],
        "How far section areas may be off that have no band of their own, m2. Default: 0.",
    ),
    key(
        "suspects",
        "exclude",
        Kind::Switch,
        &[],
        "Whether cells that are more likely wrong than right are left out. Default: true.",
    ),
    key(
        "lines",
        "accept",
        Kind::Phrases(r#""L1", "L2""#),
        &[],
        "Which of the knuckles and tangent lines that `fair` proposes are taken: [\"L1\", \"L2\"], or \"all\". Default: none.",
    ),
    key(
        "lines",
        "knuckle",
        Kind::Phrases(r#""waterline 6 from 0 to 18""#),
        &[],
        "Lines across which the slope of the hull breaks, that the table does not declare: waterlines or stations, or parts of them.",
    ),
    key(
        "lines",
        "tangent",
        Kind::Phrases(r#""station 8 from 2 to 9.75""#),
        &[],
        "The same for lines across which the curvature breaks: edges of flats and of straight parts.",
    ),
    key(
        "waves",
        "froude_numbers",
        Kind::Positions,
        &[],
        "Froude numbers of L_PP at which the wave resistance is made small within the tolerances, as \"0.25:0.30:0.01\". Default: none.",
    ),
    key(
        "waves",
        "weight",
        Kind::Number,
        &[],
        "Weight of the wave resistance against the energy of the move, m^2. Default: the knee of seven weights.",
    ),
    key(
        "inflections",
        "cost",
        Kind::Number,
        &[],
        "Greatest cost of removing an inflection: the sum of squared moves that it adds, over the noise squared. Default: 12; 2 keeps what noise of the size of tolerance.table / 3 does not explain.",
    ),
];
