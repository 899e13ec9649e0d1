//! A row of a table of hydrostatics.

/// Hydrostatics of one draught. A field is `None` where the quantity is not defined (a coefficient at zero volume, GM
/// without a centre of gravity, a waterplane above the deck).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Hydrostatics {
    /// Draught above the base line \[m\].
    pub draught: f64,
    /// Keel (extreme) draught T_K \[m\].
    pub keel_draught: f64,
    /// Displacement volume, moulded [m^3].
    pub displacement_volume: f64,
    /// Displacement mass, moulded \[t\].
    pub displacement_mass: f64,
    /// Displacement mass, extreme \[t\].
    pub displacement_mass_extreme: f64,
    /// Longitudinal centre of buoyancy, forward of AP \[m\].
    pub lcb: Option<f64>,
    /// Longitudinal centre of buoyancy, forward of midship [% of Lpp].
    pub lcb_percent: Option<f64>,
    /// Height of the centre of buoyancy above the base line \[m\].
    pub kb: Option<f64>,
    /// Waterplane area [m^2].
    pub waterplane_area: f64,
    /// Longitudinal centre of flotation, forward of AP \[m\].
    pub lcf: Option<f64>,
    /// Tonnes per centimetre immersion [t/cm].
    pub tonnes_per_centimetre: f64,
    /// Moment to change trim one centimetre [t m/cm].
    pub moment_to_change_trim: Option<f64>,
    /// Moment to change trim one metre [t m/m].
    pub moment_to_trim_metre: Option<f64>,
    /// Transverse second moment of the waterplane [m^4].
    pub transverse_inertia: f64,
    /// Longitudinal second moment of the waterplane about LCF [m^4].
    pub longitudinal_inertia: f64,
    /// BM_T \[m\]
    pub bm_transverse: Option<f64>,
    /// BM_L \[m\]
    pub bm_longitudinal: Option<f64>,
    /// KM_T \[m\]
    pub km_transverse: Option<f64>,
    /// KM_L \[m\]
    pub km_longitudinal: Option<f64>,
    /// GM_T \[m\]
    pub gm_transverse: Option<f64>,
    /// GM_L \[m\]
    pub gm_longitudinal: Option<f64>,
    /// C_B
    pub block_coefficient: Option<f64>,
    /// C_M
    pub midship_coefficient: Option<f64>,
    /// C_X
    pub maximum_section_coefficient: Option<f64>,
    /// C_P
    pub prismatic_coefficient: Option<f64>,
    /// C_PF
    pub prismatic_coefficient_fore: Option<f64>,
    /// C_PA
    pub prismatic_coefficient_aft: Option<f64>,
    /// C_WP
    pub waterplane_coefficient: Option<f64>,
    /// C_VP
    pub vertical_prismatic_coefficient: Option<f64>,
    /// C_S = S / sqrt(volume L)
    pub wetted_surface_coefficient: Option<f64>,
    /// Wetted surface, transom and flat of bottom included [m^2].
    pub wetted_surface: f64,
    /// Aft end of the waterline, forward of AP \[m\].
    pub waterline_aft: Option<f64>,
    /// Length on the waterline \[m\].
    pub waterline_length: f64,
    /// Breadth on the waterline \[m\].
    pub waterline_breadth: f64,
    /// Area of the section at Lpp / 2 [m^2].
    pub midship_section_area: f64,
    /// Largest section area [m^2].
    pub maximum_section_area: f64,
    /// Position of the largest section, forward of AP \[m\].
    pub maximum_section_position: Option<f64>,
    /// Half angle of entrance \[deg\].
    pub half_angle_of_entrance: Option<f64>,
    /// Half angle of run \[deg\].
    pub half_angle_of_run: Option<f64>,
    /// Aft end of the parallel middle body, forward of AP \[m\].
    pub parallel_body_aft: Option<f64>,
    /// Fore end of the parallel middle body, forward of AP \[m\].
    pub parallel_body_fore: Option<f64>,
    /// Length of entrance \[m\].
    pub entrance_length: Option<f64>,
    /// Length of run \[m\].
    pub run_length: Option<f64>,
    /// Slenderness L / volume^(1/3).
    pub slenderness: Option<f64>,
    /// Displacement-length ratio, mass / (0.01 L)^3 [t/m^3].
    pub displacement_length_ratio: Option<f64>,
    /// Lateral plane area [m^2].
    pub lateral_area: f64,
    /// Centre of the lateral plane, forward of AP \[m\].
    pub lateral_centre_x: Option<f64>,
    /// Centre of the lateral plane, above the base line \[m\].
    pub lateral_centre_z: Option<f64>,
    /// Immersed transom area [m^2].
    pub transom_area: f64,
    /// y of the centre of buoyancy \[m\], + to port, of a body that is not symmetrical.
    pub transverse_centre: Option<f64>,
    /// Angle of heel to port by that \[deg\], where KG is known and GM is positive.
    pub heel: Option<f64>,
    /// Remark on the row (draught above the deck at side, below the keel); none for an ordinary row.
    pub remark: Option<String>,
}

/// LCB further from midship is hardly any ship's [% of Lpp].
const USUAL_LCB: f64 = 6.0;

/// Half angles of entrance of ships \[deg\].
const USUAL_ENTRANCE: std::ops::RangeInclusive<f64> = 3.0..=70.0;

/// Least initial metacentric height of the IS Code 2008 \[m\].
pub const LEAST_GM: f64 = 0.15;

/// Part of the height of a body above which what is immersed has a volume.
const IMMERSED: f64 = 1e-3;

/// Relative error of a quantity beyond which it is none of rounding, nor of the skin of a union of shells.
const ROUNDING: f64 = 1e-4;

impl Hydrostatics {
    /// What no body within the box from `least` to `greatest` (x, y, z) \[m\] has at this draught, in words: a volume or an
    /// area of the waterplane below 0 or above that of its box, a section above its rectangle, a centre of buoyancy beside
    /// the immersed part. Skin that is counted twice, or walls inside it, show so.
    #[must_use]
    pub fn impossible(&self, [least, greatest]: [[f64; 3]; 2]) -> Vec<String> {
        let [length, breadth] = [greatest[0] - least[0], greatest[1] - least[1]];
        let depth = self.draught.min(greatest[2]) - least[2];
        if depth <= 0.0 {
            return Vec::new();
        }
        let volume = length * breadth * depth;
        let quantities = [
            ("the displacement volume", self.displacement_volume, volume, "m3"),
            ("the waterplane area", self.waterplane_area, length * breadth, "m2"),
            ("the midship section area", self.midship_section_area, breadth * depth, "m2"),
            ("the largest section area", self.maximum_section_area, breadth * depth, "m2"),
        ];
        let is_wrong = |value: f64, most: f64| value < -ROUNDING * most || value > (1.0 + ROUNDING) * most;
        let wrong = quantities.into_iter().filter(|&(_, value, most, _)| is_wrong(value, most));
        let mut found: Vec<String> = wrong
            .map(|(name, value, most, unit)| {
                format!(
                    "at {:.3} m {name} is {value:.3} {unit}; that of the box around it is {most:.3} {unit}",
                    self.draught
                )
            })
            .collect();
        if self.displacement_volume <= 0.0 && depth > IMMERSED * (greatest[2] - least[2]) {
            found.push(format!(
                "at {:.3} m {depth:.3} m of the body is immersed, and its skin encloses nothing",
                self.draught
            ));
        }
        if let Some(kb) = self.kb.filter(|kb| !(-ROUNDING..=1.0 + ROUNDING).contains(&((kb - least[2]) / depth))) {
            let [low, high] = [least[2], least[2] + depth];
            found.push(format!(
                "at {:.3} m KB is {kb:.3} m; what is immersed is from {low:.3} to {high:.3} m",
                self.draught
            ));
        }
        found
    }

    /// What hardly any ship has at its design draught, each with the key of the target behind it: LCB far from midship,
    /// ends that are blunter than a quarter of a circle or finer than a blade.
    #[must_use]
    pub fn unusual(&self) -> Vec<(&'static str, String)> {
        let lcb = self.lcb_percent.filter(|percent| percent.abs() > USUAL_LCB);
        let lcb = lcb.map(|lcb| {
            ("LCB", format!("LCB is {lcb:+.2} % of Lpp from midship; usual are -{USUAL_LCB} to +{USUAL_LCB} %"))
        });
        let entrance = self.half_angle_of_entrance.filter(|angle| *angle > 0.0 && !USUAL_ENTRANCE.contains(angle));
        let entrance = entrance.map(|angle| {
            let [least, most] = [USUAL_ENTRANCE.start(), USUAL_ENTRANCE.end()];
            (
                "entrance_length",
                format!("the half angle of entrance is {angle:.1} degrees; usual are {least} to {most}"),
            )
        });
        lcb.into_iter().chain(entrance).collect()
    }

    /// Whether GM is known and less than ships must have at sea (IS Code 2008, part A, 2.2.4).
    #[must_use]
    pub fn is_tender(&self) -> bool {
        self.gm_transverse.is_some_and(|gm| gm < LEAST_GM)
    }

    /// Coefficients above 1 by more than `slack`, which the length, breadth and draught they are referred to do not hold, in
    /// words.
    #[must_use]
    pub fn above_one(&self, slack: f64) -> Vec<String> {
        let coefficients = [
            ("CB", self.block_coefficient),
            ("CM", self.midship_coefficient),
            ("CX", self.maximum_section_coefficient),
            ("CP", self.prismatic_coefficient),
            ("CWP", self.waterplane_coefficient),
        ];
        let above = coefficients
            .into_iter()
            .filter_map(|(name, value)| Some((name, value.filter(|v| *v > 1.0 + ROUNDING + slack)?)));
        above.map(|(name, value)| format!("{name} {value:.3}")).collect()
    }
}
