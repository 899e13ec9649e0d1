//! From targets to numbers: ranges, defaults from presets and formulas, and the midship section.

use super::book::{Ledger, Sourced, band_remarks, midship_section, shoulders};
use super::net::Sheer;
use super::{DesignTargets, MidshipTarget};
use crate::parametric::midship::MidshipSection;
use crate::parametric::presets::{
    ShipType, lcb_percent_prismatic, midship_benford, midship_hsva, midship_kerlen, waterplane_schneekluth,
};
use crate::parametric::{DesignValue, Infeasible, Remark, ValueOrigin};

/// The targets with every gap filled \[m, rad\].
#[derive(Debug, Clone)]
pub(super) struct Resolved {
    pub(super) length: f64,
    pub(super) breadth: f64,
    pub(super) draught: f64,
    pub(super) depth: f64,
    pub(super) block: Sourced,
    pub(super) midship: Sourced,
    pub(super) lcb: Sourced,
    pub(super) waterplane: Sourced,
    /// From, to of a parallel body that was given, in whole or by the lengths of the ends.
    pub(super) fore_shoulder: Option<f64>,
    pub(super) aft_shoulder: Option<f64>,
    pub(super) section: MidshipSection,
    pub(super) rake: f64,
    pub(super) forefoot: f64,
    pub(super) transom: bool,
    pub(super) transom_height: Sourced,
    pub(super) transom_breadth: Option<f64>,
    pub(super) overhang: f64,
    pub(super) cut_up: Sourced,
    pub(super) sweep: f64,
    pub(super) flare: Option<f64>,
    pub(super) sheer: Sheer,
    pub(super) half_entrance: f64,
    pub(super) character: f64,
    pub(super) values: Vec<DesignValue>,
    pub(super) remarks: Vec<Remark>,
}

impl Resolved {
    /// Fills the gaps.
    ///
    /// # Errors
    /// Every value outside its range and every contradiction that needs no solver.
    pub(super) fn new(requested: &DesignTargets) -> Result<Self, Vec<Infeasible>> {
        let ship = requested.ship_type.unwrap_or(ShipType::GeneralCargo);
        let preset = ship.preset();
        let label = format!("preset {}", ship.as_str());
        let typed = requested.ship_type.is_some();
        let mut book = Ledger { values: Vec::new(), problems: Vec::new() };
        let open = f64::INFINITY;

        // Main dimensions.
        let length = book
            .take("Lpp", "length between perpendiculars", "m", 1.0, Some(requested.length), 0.0, "", (0.1, 1000.0))
            .value;
        let of = |what: &str| format!("{label}: {what}");
        let breadth = book
            .take(
                "B",
                "moulded breadth",
                "m",
                1.0,
                requested.breadth,
                length / preset.length_breadth[0],
                &of("L/B"),
                (1e-3 * length, length),
            )
            .value;
        let draught = book
            .take(
                "T",
                "design draught",
                "m",
                1.0,
                requested.draught,
                breadth / preset.breadth_draught[0],
                &of("B/T"),
                (1e-3 * length, length),
            )
            .value;
        let depth = book
            .take(
                "D",
                "depth at side",
                "m",
                1.0,
                requested.depth,
                draught * preset.depth_draught,
                &of("D/T"),
                (0.0, length),
            )
            .value;
        if !book.problems.is_empty() {
            return Err(book.problems);
        }
        if depth <= draught {
            book.problem(
                "E105",
                &["T", "D"],
                format!("T {draught:.3} m is not less than depth D {depth:.3} m; raise D or lower T"),
            );
        }

        // Coefficients.
        let box_volume = length * breadth * draught;
        let by_volume = requested.displacement_volume.map(|v| v / box_volume);
        if let (Some(given), Some(implied)) = (requested.block_coefficient, by_volume)
            && (given / implied - 1.0).abs() > 1e-3
        {
            book.problem(
                "E110",
                &["displacement", "Cb"],
                format!(
                    "the displaced volume {:.1} m3 and L B T Cb = {:.1} m3 disagree by {:.1} %; give one of them, or T = {:.3} m",
                    implied * box_volume,
                    given * box_volume,
                    100.0 * (implied / given - 1.0),
                    draught * implied / given
                ),
            );
        }
        let block = book.take(
            "Cb",
            "block coefficient",
            "-",
            1.0,
            by_volume.or(requested.block_coefficient),
            preset.block[0],
            &label,
            (0.15, 0.98),
        );
        let regression = |formula: &str| (formula.to_owned(), ValueOrigin::Preset);
        let (value, (source, origin)) = match requested.midship_coefficient {
            Some(MidshipTarget::Value(value)) => (value, (String::new(), ValueOrigin::Given)),
            Some(MidshipTarget::Kerlen) => (midship_kerlen(block.value), regression("Kerlen: 1.006 - 0.0056 Cb^-3.56")),
            Some(MidshipTarget::Hsva) => (midship_hsva(block.value), regression("HSVA: 1 / (1 + (1 - Cb)^3.5)")),
            Some(MidshipTarget::Benford) => {
                (midship_benford(block.value), regression("Benford: 0.977 + 0.085 (Cb - 0.60)"))
            }
            None if typed => (preset.midship, (label.clone(), ValueOrigin::Preset)),
            None => (midship_kerlen(block.value), regression("Kerlen: 1.006 - 0.0056 Cb^-3.56")),
        };
        let given = (origin == ValueOrigin::Given).then_some(value);
        let midship = book.take("Cm", "midship section coefficient", "-", 1.0, given, value, &source, (0.4, 0.9999));
        let prismatic = block.value / midship.value;
        if prismatic >= 1.0 {
            book.problem(
                "E102",
                &["Cb", "Cm"],
                format!(
                    "Cb {:.4} with Cm {:.4} gives Cp {prismatic:.3} >= 1 (impossible); Cm must be above {:.4}, Kerlen suggests {:.3} for this Cb",
                    block.value, midship.value, block.value, midship_kerlen(block.value)
                ),
            );
        }
        let (default_lcb, lcb_source) = if typed {
            (preset.lcb_percent, of("LCB in % of Lpp"))
        } else {
            (lcb_percent_prismatic(prismatic), "-13.5 + 19.4 Cp (Schneekluth & Bertram 1998)".to_owned())
        };
        let holds = 50.0 * (1.0 - prismatic);
        let most = if holds.is_finite() { 0.5 * holds.abs() } else { 0.0 };
        let default_lcb = if most > 0.0 { default_lcb.clamp(-most, most) } else { 0.0 };
        let lcb = book.take(
            "LCB",
            "centre of buoyancy forward of AP",
            "m",
            1.0,
            requested.lcb,
            length * (0.5 + default_lcb / 100.0),
            &lcb_source,
            (0.0, length),
        );
        let percent = 100.0 * (lcb.value / length - 0.5);
        if prismatic < 1.0 && percent.abs() >= holds {
            book.problem(
                "E104",
                &["LCB", "Cb", "Cm"],
                format!("LCB {percent:+.2} % of Lpp from midship is outside the +-{holds:.2} % that Cp {prismatic:.3} can hold"),
            );
        }
        let formula = waterplane_schneekluth(block.value, midship.value).min(0.96);
        let waterplane = book.take(
            "Cwp",
            "waterplane coefficient",
            "-",
            1.0,
            requested.waterplane_coefficient,
            formula,
            "(1 + 2 Cb / sqrt(Cm)) / 3 (Schneekluth & Bertram 1998)",
            (0.2, 0.9999),
        );
        if waterplane.origin == ValueOrigin::Given && waterplane.value <= block.value {
            book.problem(
                "E103",
                &["Cwp", "Cb"],
                format!(
                    "Cb {:.4} needs Cwp above {:.4}; you set {:.4}. Typical for this Cb: {:.3}",
                    block.value,
                    block.value,
                    waterplane.value,
                    (1.0 + 2.0 * block.value) / 3.0
                ),
            );
        }

        // Midship section.
        let keel = 0.5
            * book
                .take(
                    "keel_breadth",
                    "breadth of the flat keel",
                    "m",
                    1.0,
                    requested.keel_breadth,
                    preset.keel * breadth,
                    &label,
                    (0.0, 0.9 * breadth),
                )
                .value;
        if let Some(radius) = requested.bilge_radius {
            book.take(
                "bilge_radius",
                "bilge radius",
                "m",
                1.0,
                Some(radius),
                radius,
                "",
                (1e-3 * draught, draught.min(0.5 * breadth)),
            );
        }
        if let Some(deadrise) = requested.deadrise {
            book.take("deadrise", "rise of floor", "deg", 1f64.to_degrees(), Some(deadrise), deadrise, "", (0.0, 60.0));
        }
        let section = midship_section(&mut book, requested, 0.5 * breadth, draught, keel, midship);

        // Ends.
        let (fore_shoulder, aft_shoulder) = shoulders(&mut book, requested, length);
        let rake = book
            .take(
                "rake",
                "rake of the stem at and above the design waterline",
                "deg",
                1f64.to_degrees(),
                requested.stem_rake,
                preset.stem_rake_deg.to_radians(),
                &label,
                (0.0, 75.0),
            )
            .value;
        let raked = draught * rake.tan();
        let forefoot = book
            .take(
                "forefoot",
                "stem at the keel aft of FP",
                "m",
                1.0,
                requested.forefoot,
                raked + preset.forefoot * length,
                &label,
                (0.0, 0.4 * length),
            )
            .value;
        if forefoot < 2.0 / 3.0 * raked {
            book.problem(
                "E109",
                &["forefoot", "rake"],
                format!("a stem raked {:.1} deg at the waterline cannot end {forefoot:.3} m aft of FP on the keel: at least {:.3} m", rake.to_degrees(), 2.0 / 3.0 * raked),
            );
        }
        let transom = requested.transom_breadth.is_none_or(|t| t > 0.0);
        let transom_breadth = requested.transom_breadth.filter(|t| *t > 0.0);
        if let Some(t) = transom_breadth {
            book.take(
                "transom_beam",
                "breadth of the transom at the deck over B",
                "-",
                1.0,
                Some(t),
                t,
                "",
                (0.05, 0.98),
            );
        }
        let (mut transom_height, mut overhang) = (Sourced { value: draught, origin: ValueOrigin::Preset }, 0.0);
        if transom {
            transom_height = book.take(
                "transom_height",
                "lowest point of the transom",
                "m",
                1.0,
                requested.transom_height,
                (preset.transom_height * draught).min(0.5 * (draught + depth)),
                &label,
                (0.05 * draught, depth),
            );
            overhang = book
                .take(
                    "overhang",
                    "transom aft of AP",
                    "m",
                    1.0,
                    requested.stern_overhang,
                    preset.overhang * length,
                    &label,
                    (-0.2 * length, 0.3 * length),
                )
                .value;
        }
        let cut_up = book.take(
            "cut_up",
            "start of the rise of the keel",
            "m",
            1.0,
            requested.cut_up,
            preset.cut_up * length,
            &label,
            (-overhang, 0.48 * length),
        );
        let sweep = if transom_breadth.is_some() { 1.0 } else { preset.sweep };
        if let Some(flare) = requested.flare {
            book.take(
                "flare",
                "mean flare between waterline and deck at 0.9 Lpp",
                "deg",
                1f64.to_degrees(),
                Some(flare),
                flare,
                "",
                (0.0, 80.0),
            );
        }
        let sheer = Sheer {
            fore: book
                .take(
                    "sheer_fore",
                    "sheer at FP",
                    "m",
                    1.0,
                    requested.sheer_fore,
                    preset.sheer[0] * length,
                    &label,
                    (0.0, depth),
                )
                .value,
            aft: book
                .take(
                    "sheer_aft",
                    "sheer at AP",
                    "m",
                    1.0,
                    requested.sheer_aft,
                    preset.sheer[1] * length,
                    &label,
                    (0.0, depth),
                )
                .value,
        };
        let half_entrance = requested.maximum_half_entrance.map_or(open, |limit| {
            book.take(
                "entrance_half_angle_max",
                "largest half angle of entrance",
                "deg",
                1f64.to_degrees(),
                Some(limit),
                limit,
                "",
                (1.0, 89.0),
            )
            .value
        });
        let character = book
            .take(
                "section_character",
                "vertical law: 0 linear, + U sections, - V",
                "-",
                1.0,
                requested.section_character,
                preset.section_character,
                &label,
                (-4.0, 8.0),
            )
            .value;

        let remarks = band_remarks(ship, &preset, typed, length / breadth, breadth / draught, block);
        match section {
            Some(section) if book.problems.is_empty() => Ok(Self {
                length,
                breadth,
                draught,
                depth,
                block,
                midship,
                lcb,
                waterplane,
                fore_shoulder,
                aft_shoulder,
                section,
                rake,
                forefoot,
                transom,
                transom_height,
                transom_breadth,
                overhang,
                cut_up,
                sweep,
                flare: requested.flare,
                sheer,
                half_entrance,
                character,
                values: book.values,
                remarks,
            }),
            _ => Err(book.problems),
        }
    }
}
