//! The one list of hydrostatic quantities.

use super::row::Hydrostatics;

/// One quantity: its keys, its words, and how to take it from a row.
#[derive(Debug, Clone, Copy)]
pub struct Quantity {
    /// ITTC code, the key in CSV and JSON.
    pub key: &'static str,
    /// Symbol of the field, for drawings.
    pub symbol: &'static str,
    /// Name in full.
    pub name: &'static str,
    /// Unit, `-` for none.
    pub unit: &'static str,
    /// Definition, one line.
    pub definition: &'static str,
    /// Decimals in print.
    pub decimals: usize,
    /// The value of a row.
    pub value: fn(&Hydrostatics) -> Option<f64>,
}

impl Quantity {
    /// The quantity of a key; none for a key that is none of [`QUANTITIES`].
    #[must_use]
    pub fn of(key: &str) -> Option<&'static Self> {
        QUANTITIES.iter().find(|quantity| quantity.key == key)
    }

    /// Decimals of a value in print: [`Self::decimals`], and up to two more for volumes, areas, masses and moments of
    /// boats, so that four figures are seen.
    #[must_use]
    pub fn decimals_of(&self, value: f64) -> usize {
        let grows = ["m2", "m3", "m4", "t", "t/cm", "t m/cm", "t m/m"].contains(&self.unit);
        if !grows || !value.is_finite() || value.abs() < 1e-12 {
            return self.decimals;
        }
        let wanted = 3 - value.abs().log10().floor() as i32;
        self.decimals.max((wanted.max(0) as usize).min(self.decimals + 2))
    }
}

/// Every quantity, in the order of tables. Keys are ITTC computer symbols where there is one.
pub const QUANTITIES: &[Quantity] = &[
    Quantity {
        key: "T",
        symbol: "T",
        name: "draught, moulded",
        unit: "m",
        definition: "waterline above the base line",
        decimals: 3,
        value: |row| Some(row.draught),
    },
    Quantity {
        key: "TK",
        symbol: "T_K",
        name: "draught, to the underside of the keel",
        unit: "m",
        definition: "moulded draught + thickness of the keel plate; the moulded draught where none is given",
        decimals: 3,
        value: |row| Some(row.keel_draught),
    },
    Quantity {
        key: "DISPVOL",
        symbol: "∇",
        name: "displacement volume, moulded",
        unit: "m3",
        definition: "2 int int y dx dz below the waterline",
        decimals: 1,
        value: |row| Some(row.displacement_volume),
    },
    Quantity {
        key: "DISPM",
        symbol: "Δ",
        name: "displacement mass, moulded",
        unit: "t",
        definition: "density x volume",
        decimals: 1,
        value: |row| Some(row.displacement_mass),
    },
    Quantity {
        key: "DISPX",
        symbol: "Δ_ext",
        name: "displacement mass, extreme",
        unit: "t",
        definition: "density x extreme volume, by the shell convention",
        decimals: 1,
        value: |row| Some(row.displacement_mass_extreme),
    },
    Quantity {
        key: "XCB",
        symbol: "LCB",
        name: "longitudinal centre of buoyancy, from AP",
        unit: "m",
        definition: "moment of the volume about AP / volume; from AP, + forward",
        decimals: 3,
        value: |row| row.lcb,
    },
    Quantity {
        key: "XCBPC",
        symbol: "LCB%",
        name: "longitudinal centre of buoyancy, % of Lpp from midship",
        unit: "%",
        definition: "100 (LCB - Lpp/2) / Lpp; from midship, + forward",
        decimals: 3,
        value: |row| row.lcb_percent,
    },
    Quantity {
        key: "KB",
        symbol: "KB",
        name: "height of the centre of buoyancy",
        unit: "m",
        definition: "moment of the volume about the base line / volume",
        decimals: 3,
        value: |row| row.kb,
    },
    Quantity {
        key: "AWL",
        symbol: "A_W",
        name: "waterplane area",
        unit: "m2",
        definition: "2 int y dx on the waterline",
        decimals: 2,
        value: |row| Some(row.waterplane_area),
    },
    Quantity {
        key: "XWL",
        symbol: "LCF",
        name: "longitudinal centre of flotation, from AP",
        unit: "m",
        definition: "2 int x y dx / A_W; from AP, + forward",
        decimals: 3,
        value: |row| row.lcf,
    },
    Quantity {
        key: "TPC",
        symbol: "TPC",
        name: "tonnes per centimetre immersion",
        unit: "t/cm",
        definition: "density x A_W / 100",
        decimals: 3,
        value: |row| Some(row.tonnes_per_centimetre),
    },
    Quantity {
        key: "MTC",
        symbol: "MTC",
        name: "moment to change trim one centimetre",
        unit: "t m/cm",
        definition: "displacement x GM_L / (100 Lpp); BM_L where KG is not given",
        decimals: 2,
        value: |row| row.moment_to_change_trim,
    },
    Quantity {
        key: "MTM",
        symbol: "MTM",
        name: "moment to change trim one metre",
        unit: "t m/m",
        definition: "100 MTC",
        decimals: 1,
        value: |row| row.moment_to_trim_metre,
    },
    Quantity {
        key: "IT",
        symbol: "I_T",
        name: "transverse second moment of the waterplane",
        unit: "m4",
        definition: "(2/3) int y^3 dx",
        decimals: 1,
        value: |row| Some(row.transverse_inertia),
    },
    Quantity {
        key: "IL",
        symbol: "I_L",
        name: "longitudinal second moment of the waterplane",
        unit: "m4",
        definition: "2 int x^2 y dx - A_W LCF^2, about LCF",
        decimals: 1,
        value: |row| Some(row.longitudinal_inertia),
    },
    Quantity {
        key: "BMT",
        symbol: "BM_T",
        name: "transverse metacentric radius",
        unit: "m",
        definition: "I_T / volume",
        decimals: 3,
        value: |row| row.bm_transverse,
    },
    Quantity {
        key: "BML",
        symbol: "BM_L",
        name: "longitudinal metacentric radius",
        unit: "m",
        definition: "I_L / volume",
        decimals: 2,
        value: |row| row.bm_longitudinal,
    },
    Quantity {
        key: "KMT",
        symbol: "KM_T",
        name: "height of the transverse metacentre",
        unit: "m",
        definition: "KB + BM_T",
        decimals: 3,
        value: |row| row.km_transverse,
    },
    Quantity {
        key: "KML",
        symbol: "KM_L",
        name: "height of the longitudinal metacentre",
        unit: "m",
        definition: "KB + BM_L",
        decimals: 2,
        value: |row| row.km_longitudinal,
    },
    Quantity {
        key: "GMT",
        symbol: "GM_T",
        name: "transverse metacentric height",
        unit: "m",
        definition: "KM_T - KG",
        decimals: 3,
        value: |row| row.gm_transverse,
    },
    Quantity {
        key: "GML",
        symbol: "GM_L",
        name: "longitudinal metacentric height",
        unit: "m",
        definition: "KM_L - KG",
        decimals: 2,
        value: |row| row.gm_longitudinal,
    },
    Quantity {
        key: "CB",
        symbol: "C_B",
        name: "block coefficient",
        unit: "-",
        definition: "volume / (L B T)",
        decimals: 4,
        value: |row| row.block_coefficient,
    },
    Quantity {
        key: "CM",
        symbol: "C_M",
        name: "midship section coefficient, at Lpp/2",
        unit: "-",
        definition: "A_M / (B T), A_M at Lpp/2",
        decimals: 4,
        value: |row| row.midship_coefficient,
    },
    Quantity {
        key: "CX",
        symbol: "C_X",
        name: "coefficient of the largest section",
        unit: "-",
        definition: "A_X / (B T), A_X the largest section wherever it is",
        decimals: 4,
        value: |row| row.maximum_section_coefficient,
    },
    Quantity {
        key: "CP",
        symbol: "C_P",
        name: "longitudinal prismatic coefficient",
        unit: "-",
        definition: "volume / (A L), A by the convention",
        decimals: 4,
        value: |row| row.prismatic_coefficient,
    },
    Quantity {
        key: "CPF",
        symbol: "C_PF",
        name: "prismatic coefficient, fore body",
        unit: "-",
        definition: "volume forward of Lpp/2 / (A L/2)",
        decimals: 4,
        value: |row| row.prismatic_coefficient_fore,
    },
    Quantity {
        key: "CPA",
        symbol: "C_PA",
        name: "prismatic coefficient, aft body",
        unit: "-",
        definition: "volume aft of Lpp/2 / (A L/2)",
        decimals: 4,
        value: |row| row.prismatic_coefficient_aft,
    },
    Quantity {
        key: "CWP",
        symbol: "C_WP",
        name: "waterplane coefficient",
        unit: "-",
        definition: "A_W / (L B)",
        decimals: 4,
        value: |row| row.waterplane_coefficient,
    },
    Quantity {
        key: "CVP",
        symbol: "C_VP",
        name: "vertical prismatic coefficient",
        unit: "-",
        definition: "volume / (A_W T)",
        decimals: 4,
        value: |row| row.vertical_prismatic_coefficient,
    },
    Quantity {
        key: "CS",
        symbol: "C_S",
        name: "wetted surface coefficient",
        unit: "-",
        definition: "S / sqrt(volume L)",
        decimals: 4,
        value: |row| row.wetted_surface_coefficient,
    },
    Quantity {
        key: "S",
        symbol: "S",
        name: "wetted surface",
        unit: "m2",
        definition: "true area of side, flat of bottom, immersed transom and flat bow",
        decimals: 2,
        value: |row| Some(row.wetted_surface),
    },
    Quantity {
        key: "LWL",
        symbol: "L_WL",
        name: "length on the waterline",
        unit: "m",
        definition: "extent of the waterplane in x",
        decimals: 3,
        value: |row| Some(row.waterline_length),
    },
    Quantity {
        key: "BWL",
        symbol: "B_WL",
        name: "breadth on the waterline",
        unit: "m",
        definition: "extent of the waterplane in y",
        decimals: 3,
        value: |row| Some(row.waterline_breadth),
    },
    Quantity {
        key: "AM",
        symbol: "A_M",
        name: "midship section area, at Lpp/2",
        unit: "m2",
        definition: "immersed area of the section at Lpp/2",
        decimals: 3,
        value: |row| Some(row.midship_section_area),
    },
    Quantity {
        key: "AX",
        symbol: "A_X",
        name: "area of the largest section",
        unit: "m2",
        definition: "largest immersed section area",
        decimals: 3,
        value: |row| Some(row.maximum_section_area),
    },
    Quantity {
        key: "XAX",
        symbol: "x_AX",
        name: "position of the largest section, from AP",
        unit: "m",
        definition: "from AP, + forward; the middle of a parallel middle body",
        decimals: 3,
        value: |row| row.maximum_section_position,
    },
    Quantity {
        key: "IE",
        symbol: "i_E",
        name: "half angle of entrance",
        unit: "deg",
        definition: "between waterline and centreplane at its fore end, behind the local shape of the stem; none of a square bow",
        decimals: 2,
        value: |row| row.half_angle_of_entrance,
    },
    Quantity {
        key: "IR",
        symbol: "i_R",
        name: "half angle of run",
        unit: "deg",
        definition: "between waterline and centreplane at its aft end",
        decimals: 2,
        value: |row| row.half_angle_of_run,
    },
    Quantity {
        key: "XPA",
        symbol: "x_PA",
        name: "aft end of the parallel middle body",
        unit: "m",
        definition: "from AP, + forward; sections within 1e-6 of A_X",
        decimals: 3,
        value: |row| row.parallel_body_aft,
    },
    Quantity {
        key: "XPF",
        symbol: "x_PF",
        name: "fore end of the parallel middle body",
        unit: "m",
        definition: "from AP, + forward; sections within 1e-6 of A_X",
        decimals: 3,
        value: |row| row.parallel_body_fore,
    },
    Quantity {
        key: "LE",
        symbol: "L_E",
        name: "length of entrance, to FP",
        unit: "m",
        definition: "fore end of the parallel middle body, or x_AX where there is none, to FP",
        decimals: 3,
        value: |row| row.entrance_length,
    },
    Quantity {
        key: "LP",
        symbol: "L_P",
        name: "length of the parallel middle body",
        unit: "m",
        definition: "x_PF - x_PA",
        decimals: 3,
        value: |row| row.parallel_body_fore.zip(row.parallel_body_aft).map(|(fore, aft)| fore - aft),
    },
    Quantity {
        key: "LR",
        symbol: "L_R",
        name: "length of run, from AP",
        unit: "m",
        definition: "AP to the aft end of the parallel middle body, or to x_AX where there is none",
        decimals: 3,
        value: |row| row.run_length,
    },
    Quantity {
        key: "SLEND",
        symbol: "L/∇^(1/3)",
        name: "slenderness",
        unit: "-",
        definition: "L / volume^(1/3)",
        decimals: 3,
        value: |row| row.slenderness,
    },
    Quantity {
        key: "DLR",
        symbol: "Δ/(0.01L)^3",
        name: "displacement-length ratio, by (0.01 L)^3",
        unit: "t/m3",
        definition: "displacement / (0.01 L)^3",
        decimals: 2,
        value: |row| row.displacement_length_ratio,
    },
    Quantity {
        key: "ALV",
        symbol: "A_LV",
        name: "lateral plane area",
        unit: "m2",
        definition: "area of the underwater profile on the centreplane",
        decimals: 2,
        value: |row| Some(row.lateral_area),
    },
    Quantity {
        key: "XLV",
        symbol: "x_LV",
        name: "centre of the lateral plane, from AP",
        unit: "m",
        definition: "from AP, + forward",
        decimals: 3,
        value: |row| row.lateral_centre_x,
    },
    Quantity {
        key: "ZLV",
        symbol: "z_LV",
        name: "centre of the lateral plane, height",
        unit: "m",
        definition: "above the base line",
        decimals: 3,
        value: |row| row.lateral_centre_z,
    },
    Quantity {
        key: "AT",
        symbol: "A_T",
        name: "immersed transom area",
        unit: "m2",
        definition: "projected on the transverse plane",
        decimals: 3,
        value: |row| Some(row.transom_area),
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boats_are_printed_with_four_figures() {
        let of = |key: &str| Quantity::of(key).unwrap();
        for (key, value, decimals) in
            [("DISPVOL", 7.214, 3), ("DISPVOL", 489.8, 1), ("DISPVOL", 8322.5, 1), ("MTC", 0.1, 4), ("CB", 0.05, 4)]
        {
            assert_eq!(of(key).decimals_of(value), decimals, "{key} {value}");
        }
    }

    #[test]
    fn keys_are_unique_and_plain() {
        for (index, quantity) in QUANTITIES.iter().enumerate() {
            assert!(quantity.key.chars().all(|c| c.is_ascii_uppercase()), "{}", quantity.key);
            assert!(QUANTITIES[..index].iter().all(|other| other.key != quantity.key), "{}", quantity.key);
            assert!(!quantity.definition.contains('\n') && !quantity.name.is_empty() && !quantity.unit.is_empty());
        }
    }

    #[test]
    fn every_field_has_a_key() {
        // All fields of the row are numbers; one of the quantities (L_P) is derived from two of them. Three fields are no columns:
        // the aft end of the waterline, and transverse centre and heel, which a symmetric body has not.
        let empty = format!("{:?}", Hydrostatics::default());
        let fields = empty.matches(": ").count() - 1;
        assert_eq!(QUANTITIES.len() + 3, fields + 1);
    }
}
