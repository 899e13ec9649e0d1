//! Presets by type of ship and the regressions behind defaults.

/// Types of ship that have a preset.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShipType {
    /// Tanker or bulk carrier.
    BulkCarrier,
    /// Container ship.
    Container,
    /// General cargo ship or coaster.
    GeneralCargo,
    /// Ro-ro ship, ferry, cruise ship.
    RoRo,
    /// Tug.
    Tug,
    /// Fishing vessel.
    Fishing,
    /// Frigate, fast displacement ship.
    Frigate,
    /// Sailing yacht, canoe body.
    Yacht,
}

/// What a preset fills in: main ratios and coefficients in the middle of the usual bands, and the character of the ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Preset {
    /// L/B: middle, lowest, highest.
    pub length_breadth: [f64; 3],
    /// B/T: middle, lowest, highest.
    pub breadth_draught: [f64; 3],
    /// D/T.
    pub depth_draught: f64,
    /// Cb: middle, lowest, highest.
    pub block: [f64; 3],
    /// Cm.
    pub midship: f64,
    /// LCB forward of midship [% of Lpp].
    pub lcb_percent: f64,
    /// Exponent of the vertical law: 0 linear, positive U sections, negative V.
    pub section_character: f64,
    /// Rake of the stem \[deg\].
    pub stem_rake_deg: f64,
    /// Stem at the keel aft of FP, over Lpp, beyond what the rake takes.
    pub forefoot: f64,
    /// Transom aft of AP, over Lpp.
    pub overhang: f64,
    /// Lowest point of the transom over T.
    pub transom_height: f64,
    /// Start of the rise of the keel, over Lpp.
    pub cut_up: f64,
    /// Sweep of the stern profile, 0 straight to 2.
    pub sweep: f64,
    /// Half width of the flat keel over B/2.
    pub keel: f64,
    /// Sheer at FP and AP, over Lpp.
    pub sheer: [f64; 2],
}

impl ShipType {
    /// Every type, in the order of lists.
    pub const ALL: [Self; 8] = [
        Self::BulkCarrier,
        Self::Container,
        Self::GeneralCargo,
        Self::RoRo,
        Self::Tug,
        Self::Fishing,
        Self::Frigate,
        Self::Yacht,
    ];

    /// The word in design files.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::BulkCarrier => "bulk-carrier",
            Self::Container => "container",
            Self::GeneralCargo => "general-cargo",
            Self::RoRo => "ro-ro",
            Self::Tug => "tug",
            Self::Fishing => "fishing",
            Self::Frigate => "frigate",
            Self::Yacht => "yacht",
        }
    }

    /// The preset. Ratios and coefficients lie inside the bands of users of each type (Kristensen & Luetzen 2012 for Cm
    /// of merchant ships); profiles are those of ordinary ships of the type.
    #[must_use]
    #[doc(hidden)]
    pub fn preset(self) -> Preset {
        let common = Preset {
            length_breadth: [6.3, 5.3, 8.0],
            breadth_draught: [2.6, 2.4, 4.0],
            depth_draught: 1.35,
            block: [0.72, 0.66, 0.80],
            midship: 0.98,
            lcb_percent: 0.3,
            section_character: 1.5,
            stem_rake_deg: 15.0,
            forefoot: 0.015,
            overhang: 0.025,
            transom_height: 0.97,
            cut_up: 0.07,
            sweep: 1.0,
            keel: 0.0,
            sheer: [0.0, 0.0],
        };
        match self {
            Self::BulkCarrier => Preset {
                length_breadth: [6.2, 5.1, 7.1],
                breadth_draught: [2.75, 2.4, 3.2],
                depth_draught: 1.4,
                block: [0.82, 0.78, 0.86],
                midship: 0.995,
                lcb_percent: 2.3,
                stem_rake_deg: 8.0,
                forefoot: 0.010,
                overhang: 0.02,
                cut_up: 0.05,
                ..common
            },
            Self::Container => Preset {
                length_breadth: [7.2, 6.0, 9.5],
                breadth_draught: [3.0, 2.6, 4.0],
                depth_draught: 1.75,
                block: [0.64, 0.58, 0.70],
                lcb_percent: -1.0,
                stem_rake_deg: 20.0,
                forefoot: 0.02,
                transom_height: 0.94,
                cut_up: 0.10,
                ..common
            },
            Self::GeneralCargo => common,
            Self::RoRo => Preset {
                length_breadth: [6.5, 5.3, 8.0],
                breadth_draught: [3.8, 3.2, 4.5],
                depth_draught: 1.6,
                block: [0.58, 0.52, 0.66],
                midship: 0.95,
                lcb_percent: -2.0,
                stem_rake_deg: 22.0,
                forefoot: 0.02,
                overhang: 0.015,
                transom_height: 0.90,
                cut_up: 0.16,
                sweep: 0.6,
                ..common
            },
            Self::Tug => Preset {
                length_breadth: [3.2, 2.6, 4.2],
                breadth_draught: [2.6, 2.1, 3.2],
                depth_draught: 1.3,
                block: [0.54, 0.48, 0.60],
                midship: 0.88,
                lcb_percent: -0.8,
                section_character: 1.0,
                stem_rake_deg: 14.0,
                forefoot: 0.03,
                overhang: 0.03,
                transom_height: 0.88,
                cut_up: 0.22,
                sweep: 0.5,
                keel: 0.05,
                sheer: [0.035, 0.012],
            },
            Self::Fishing => Preset {
                length_breadth: [4.6, 3.0, 6.3],
                breadth_draught: [2.5, 2.1, 3.0],
                depth_draught: 1.4,
                block: [0.52, 0.45, 0.60],
                midship: 0.87,
                lcb_percent: -1.6,
                section_character: 1.0,
                stem_rake_deg: 18.0,
                forefoot: 0.03,
                overhang: 0.04,
                transom_height: 0.92,
                cut_up: 0.12,
                sweep: 0.6,
                keel: 0.04,
                sheer: [0.05, 0.02],
            },
            Self::Frigate => Preset {
                length_breadth: [7.8, 7.4, 10.0],
                breadth_draught: [3.2, 3.0, 4.0],
                depth_draught: 1.7,
                block: [0.49, 0.42, 0.52],
                midship: 0.80,
                lcb_percent: -1.2,
                section_character: 1.0,
                stem_rake_deg: 24.0,
                forefoot: 0.02,
                overhang: 0.0,
                transom_height: 0.90,
                cut_up: 0.22,
                sweep: 0.5,
                keel: 0.03,
                sheer: [0.012, 0.0],
            },
            Self::Yacht => Preset {
                length_breadth: [3.6, 3.0, 4.5],
                breadth_draught: [5.0, 4.0, 6.0],
                depth_draught: 2.8,
                block: [0.42, 0.35, 0.45],
                midship: 0.72,
                lcb_percent: -0.5,
                section_character: 0.5,
                stem_rake_deg: 28.0,
                forefoot: 0.04,
                overhang: 0.06,
                transom_height: 1.24,
                cut_up: 0.25,
                sweep: 0.0,
                keel: 0.02,
                sheer: [0.03, 0.01],
            },
        }
    }
}

/// Midship coefficient of Kerlen: 1.006 - 0.0056 Cb^-3.56 (Schneekluth & Bertram 1998, section 1.5; Cb above 0.5).
#[must_use]
pub(super) fn midship_kerlen(block: f64) -> f64 {
    1.006 - 0.0056 * block.powf(-3.56)
}

/// Midship coefficient of the Hamburg model basin: 1 / (1 + (1 - Cb)^3.5) (merchant ships, Cb 0.55 to 0.85).
#[must_use]
pub(super) fn midship_hsva(block: f64) -> f64 {
    1.0 / (1.0 + (1.0 - block).powf(3.5))
}

/// Midship coefficient of Benford: 0.977 + 0.085 (Cb - 0.60) (Series 60 range, Cb 0.60 to 0.80).
#[must_use]
pub(super) fn midship_benford(block: f64) -> f64 {
    0.977 + 0.085 * (block - 0.60)
}

/// Waterplane coefficient (1 + 2 Cb / sqrt(Cm)) / 3 (Schneekluth & Bertram 1998, section 1.6).
#[must_use]
pub(super) fn waterplane_schneekluth(block: f64, midship: f64) -> f64 {
    (1.0 + 2.0 * block / midship.sqrt()) / 3.0
}

/// LCB forward of midship in % of Lpp: -13.5 + 19.4 Cp (Schneekluth & Bertram 1998, section 1.7; merchant ships).
#[must_use]
pub(super) fn lcb_percent_prismatic(prismatic: f64) -> f64 {
    -13.5 + 19.4 * prismatic
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regressions_at_a_cargo_ship() {
        assert!((midship_kerlen(0.8) - 0.993_6).abs() < 1e-3);
        assert!((midship_hsva(0.8) - 0.996_4).abs() < 1e-3);
        assert!((midship_benford(0.8) - 0.994).abs() < 1e-12);
        assert!((waterplane_schneekluth(0.8, 0.99) - 0.8694).abs() < 1e-3);
        assert!((lcb_percent_prismatic(0.7) - 0.08).abs() < 1e-12);
    }

    #[test]
    fn presets_lie_in_their_own_bands() {
        for ship in ShipType::ALL {
            let p = ship.preset();
            for [middle, low, high] in [p.length_breadth, p.breadth_draught, p.block] {
                assert!((low..=high).contains(&middle), "{ship:?}");
            }
            assert!(p.block[0] < p.midship && p.midship < 1.0 && p.depth_draught > 1.0);
        }
    }
}
