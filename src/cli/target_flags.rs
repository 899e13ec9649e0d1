//! Dimensions and targets of a hull that is made from others, as options of `derive` and `blend`.

use clap::Args;

use crate::config::{DeriveFile, Diagnostic, read_derive_option};
use crate::report::Failure;

pub(super) const DIMENSIONS: &str = "Dimensions";
pub(super) const TARGETS: &str = "Targets";

/// Dimensions and targets.
#[derive(Debug, Args)]
pub(super) struct TargetFlags {
    /// Length between perpendiculars [default: kept]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, help_heading = DIMENSIONS)]
    lpp: Option<String>,
    /// Moulded breadth [default: kept]
    #[arg(long, alias = "breadth", value_name = "LENGTH", allow_hyphen_values = true, help_heading = DIMENSIONS)]
    beam: Option<String>,
    /// Design draught [default: kept]
    #[arg(long, alias = "draft", value_name = "LENGTH", allow_hyphen_values = true, help_heading = DIMENSIONS)]
    draught: Option<String>,
    /// Depth to the deck at side [default: kept]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, help_heading = DIMENSIONS)]
    depth: Option<String>,
    /// Displacement, moulded: tonnes, or "4000 m3"
    #[arg(long, value_name = "MASS|VOLUME", allow_hyphen_values = true, help_heading = TARGETS)]
    displacement: Option<String>,
    /// Block coefficient [default: kept]
    #[arg(long, value_name = "CB", allow_hyphen_values = true, help_heading = TARGETS)]
    cb: Option<String>,
    /// Longitudinal centre of buoyancy, "+0.8 %" of Lpp from midship or "41 m AP" [default: kept, in parts of Lpp]
    #[arg(long, value_name = "LCB", allow_hyphen_values = true, help_heading = TARGETS)]
    lcb: Option<String>,
    /// Prismatic coefficient
    #[arg(long, value_name = "CP", allow_hyphen_values = true, help_heading = TARGETS)]
    cp: Option<String>,
    /// Midship section coefficient [default: kept]
    #[arg(long, value_name = "CM", allow_hyphen_values = true, help_heading = TARGETS)]
    cm: Option<String>,
    /// Waterplane coefficient
    #[arg(long, value_name = "CWP", allow_hyphen_values = true, help_heading = TARGETS)]
    cwp: Option<String>,
    /// Longitudinal centre of flotation, as LCB
    #[arg(long, value_name = "LCF", allow_hyphen_values = true, help_heading = TARGETS)]
    lcf: Option<String>,
    /// Height of the centre of buoyancy
    #[arg(long, value_name = "KB", allow_hyphen_values = true, help_heading = TARGETS)]
    kb: Option<String>,
    /// Height of the transverse metacentre
    #[arg(long, value_name = "KM", allow_hyphen_values = true, help_heading = TARGETS)]
    km: Option<String>,
    /// Transverse metacentric height, with --kg: KM = KG + GM, without free surfaces
    #[arg(long, value_name = "GM", allow_hyphen_values = true, help_heading = TARGETS)]
    gm: Option<String>,
    /// Height of the centre of gravity, of --gm
    #[arg(long, value_name = "KG", allow_hyphen_values = true, help_heading = TARGETS)]
    kg: Option<String>,
    /// Half angle of entrance of the design waterline, degrees
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true, help_heading = TARGETS)]
    entrance: Option<String>,
    /// Half angle of run of the design waterline, degrees
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true, help_heading = TARGETS)]
    run: Option<String>,
    /// Wetted surface, m2
    #[arg(long, value_name = "AREA", allow_hyphen_values = true, help_heading = TARGETS)]
    wetted_surface: Option<String>,
}

impl TargetFlags {
    /// Whether C_M is stated.
    pub(super) fn states_midship(&self) -> bool {
        self.cm.is_some()
    }

    /// What the options state, with others as (option, key, value).
    ///
    /// # Errors
    /// [`Failure::Options`] with every value that cannot be read; [`Failure::Usage`] for two options of one target.
    pub(super) fn wanted(&self, others: &[(&str, &str, Option<&String>)]) -> Result<DeriveFile, Failure> {
        let named = [
            ("--lpp", "Lpp", &self.lpp),
            ("--beam", "B", &self.beam),
            ("--draught", "T", &self.draught),
            ("--depth", "D", &self.depth),
            ("--displacement", "displacement", &self.displacement),
            ("--cb", "Cb", &self.cb),
            ("--lcb", "LCB", &self.lcb),
            ("--cp", "Cp", &self.cp),
            ("--cm", "Cm", &self.cm),
            ("--cwp", "Cwp", &self.cwp),
            ("--lcf", "LCF", &self.lcf),
            ("--kb", "KB", &self.kb),
            ("--km", "KM", &self.km),
            ("--gm", "GM", &self.gm),
            ("--kg", "KG", &self.kg),
            ("--entrance", "entrance", &self.entrance),
            ("--run", "run", &self.run),
            ("--wetted-surface", "wetted_surface", &self.wetted_surface),
        ];
        let (mut wanted, mut problems): (DeriveFile, Vec<Diagnostic>) = Default::default();
        let named = named.map(|(option, key, value)| (option, key, value.as_ref()));
        for &(option, key, value) in named.iter().chain(others) {
            let Some(value) = value else { continue };
            match read_derive_option(option, key, value) {
                Ok(one) if key == "free" => wanted.free.extend(one.free),
                Ok(one) if key == "move_height" => wanted.moved_heights.extend(one.moved_heights),
                Ok(one) if key == "move_position" => wanted.moved_positions.extend(one.moved_positions),
                Ok(one) => wanted = wanted.over(one),
                Err(found) => problems.extend(found),
            }
        }
        if self.cb.is_some() && self.displacement.is_some() {
            return Err(Failure::Usage("--cb and --displacement are one target: leave one of them out".to_owned()));
        }
        if self.km.is_some() && self.gm.is_some() {
            return Err(Failure::Usage("--km and --gm are one target: leave one of them out".to_owned()));
        }
        if problems.is_empty() { Ok(wanted) } else { Err(Failure::Options(problems)) }
    }
}
