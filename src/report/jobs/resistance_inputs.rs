//! What a prediction of resistance needs: from the command, from the hull, or assumed.

use crate::hull::Hull;
use crate::hydrostatics::Hydrostatics;
use crate::numeric::gauss_legendre;
use crate::resistance::{
    Appendage, InputOrigin, PredictionInput, ShipParameters, SternShape, Water, half_angle_of_entrance,
    kinematic_viscosity,
};

/// Temperature of the water where none is given \[deg C\].
const TEMPERATURE: f64 = 15.0;
/// Half angles of entrance from this on are those of a rounded stem \[deg\].
const BLUNT: f64 = 60.0;
/// Parts of the midship section that the section at the stem has where it is a bulb.
const BULBS: std::ops::Range<f64> = 0.002..0.3;
/// Breadth at the waterline, beside that of the section below, that is none.
const CLOSED: f64 = 0.05;
/// Height of the centre of a bulb at most, beside the draught (Holtrop 1984).
const HIGHEST: f64 = 0.6;

/// What the command states; what is not stated comes from the hull, or is assumed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ResistanceOptions {
    /// Length on the waterline \[m\].
    pub length: Option<f64>,
    /// Breadth \[m\].
    pub breadth: Option<f64>,
    /// Displacement volume [m^3].
    pub volume: Option<f64>,
    /// LCB forward of the middle of the waterline [% of its length].
    pub lcb: Option<f64>,
    /// C_M.
    pub midship_coefficient: Option<f64>,
    /// C_WP.
    pub waterplane_coefficient: Option<f64>,
    /// Wetted surface [m^2].
    pub wetted_surface: Option<f64>,
    /// Half angle of entrance \[deg\].
    pub half_angle: Option<f64>,
    /// Immersed area of the transom [m^2].
    pub transom_area: Option<f64>,
    /// Transverse area of the bulb [m^2].
    pub bulb_area: Option<f64>,
    /// Height of the centre of that area \[m\].
    pub bulb_height: Option<f64>,
    /// Shape of the after body.
    pub stern: Option<SternShape>,
    /// Appendages.
    pub appendages: Vec<Appendage>,
    /// 1 + k1.
    pub form_factor: Option<f64>,
    /// C_A.
    pub allowance: Option<f64>,
    /// Density [t/m^3].
    pub density: Option<f64>,
    /// Temperature \[deg C\].
    pub temperature: Option<f64>,
    /// Kinematic viscosity [m^2/s].
    pub viscosity: Option<f64>,
    /// Propulsive efficiency P_E / P_D.
    pub efficiency: Option<f64>,
}

/// The inputs that were found.
#[derive(Debug, Clone)]
pub(in crate::report) struct Gathered {
    pub(in crate::report) ship: ShipParameters,
    pub(in crate::report) water: Water,
    pub(in crate::report) inputs: Vec<PredictionInput>,
    /// The half angle that the hull has and that was not used \[deg\].
    pub(in crate::report) blunt: Option<f64>,
    /// Whether the bulb was found in the hull.
    pub(in crate::report) bulb_found: bool,
}

/// A list of inputs in the making.
#[derive(Default)]
struct Inputs(Vec<PredictionInput>);

struct Label {
    symbol: &'static str,
    name: &'static str,
    unit: &'static str,
    decimals: usize,
}

const fn label(symbol: &'static str, name: &'static str, unit: &'static str, decimals: usize) -> Label {
    Label { symbol, name, unit, decimals }
}

impl Inputs {
    /// The first value there is: given, from the hull, assumed with a note.
    fn take(&mut self, label: Label, given: Option<f64>, hull: Option<f64>, assumed: (f64, &'static str)) -> f64 {
        let (value, origin, note) = match (given, hull) {
            (Some(value), _) => (value, InputOrigin::Given, ""),
            (None, Some(value)) => (value, InputOrigin::FromHull, ""),
            (None, None) => (assumed.0, InputOrigin::Assumed, assumed.1),
        };
        self.0.push(input(label, value, origin, note));
        value
    }
}

fn input(label: Label, value: f64, origin: InputOrigin, note: &'static str) -> PredictionInput {
    let Label { symbol, name, unit, decimals } = label;
    PredictionInput { symbol, name, value, unit, decimals, origin, note }
}

/// What a hull or body tells at one draught.
pub(in crate::report) struct Afloat<'a> {
    pub(in crate::report) row: &'a Hydrostatics,
    pub(in crate::report) hull: Option<&'a Hull>,
    /// Its draught above its lowest point \[m\].
    pub(in crate::report) draught: f64,
    pub(in crate::report) draught_given: bool,
    /// Density of its tables [t/m^3], and whether it is stated there.
    pub(in crate::report) density: f64,
    pub(in crate::report) density_given: bool,
}

/// Gathers the inputs.
pub(in crate::report) fn gather(afloat: &Afloat<'_>, options: &ResistanceOptions) -> Gathered {
    let row = afloat.row;
    let mut list = Inputs::default();
    let draught = afloat.draught;
    let [given, hull] = if afloat.draught_given { [Some(draught), None] } else { [None, Some(draught)] };
    let length =
        list.take(label("L", "length on the waterline", "m", 3), options.length, Some(row.waterline_length), (0.0, ""));
    let breadth = list.take(
        label("B", "breadth on the waterline", "m", 3),
        options.breadth,
        Some(row.waterline_breadth),
        (0.0, ""),
    );
    list.take(label("T", "draught, even keel", "m", 3), given, hull, (0.0, ""));
    let volume = list.take(
        label("volume", "displacement volume, moulded", "m3", 2),
        options.volume,
        Some(row.displacement_volume),
        (0.0, ""),
    );
    let middle = row.waterline_aft.map(|aft| aft + 0.5 * row.waterline_length);
    let lcb = row.lcb.zip(middle).map(|(lcb, middle)| 100.0 * (lcb - middle) / row.waterline_length);
    let lcb = list.take(label("lcb", "LCB, forward of L/2", "% L", 3), options.lcb, lcb, (0.0, "at L/2"));
    let over = |area: f64, of: f64| (of > 0.0).then_some(area / of);
    let midship_coefficient = list.take(
        label("C_M", "midship section coefficient", "-", 4),
        options.midship_coefficient,
        over(row.midship_section_area, row.waterline_breadth * draught),
        (1.0, ""),
    );
    let waterplane_coefficient = list.take(
        label("C_WP", "waterplane coefficient", "-", 4),
        options.waterplane_coefficient,
        over(row.waterplane_area, row.waterline_length * row.waterline_breadth),
        (1.0, ""),
    );
    let wetted_surface = list.take(
        label("S", "wetted surface without transom", "m2", 2),
        options.wetted_surface,
        Some(row.wetted_surface - row.transom_area),
        (0.0, ""),
    );
    let transom_area = list.take(
        label("A_T", "immersed area of the transom at rest", "m2", 3),
        options.transom_area,
        Some(row.transom_area),
        (0.0, ""),
    );
    let bulb = afloat.hull.and_then(|hull| bulb_of(hull, row, draught));
    let bulb_area = list.take(
        label("A_BT", "transverse area of the bulb at the stem", "m2", 3),
        options.bulb_area,
        afloat.hull.map(|_| bulb.map_or(0.0, |bulb| bulb[0])),
        (0.0, "no bulb"),
    );
    let bulb_height = list.take(
        label("h_B", "height of its centre above the keel", "m", 3),
        options.bulb_height,
        afloat.hull.map(|_| bulb.map_or(0.0, |bulb| bulb[1])),
        (0.0, ""),
    );
    let stern = options.stern.unwrap_or_default();
    let mut ship = ShipParameters {
        length,
        breadth,
        draught_fore: draught,
        draught_aft: draught,
        volume,
        lcb,
        midship_coefficient,
        waterplane_coefficient,
        wetted_surface,
        half_angle: 0.0,
        transom_area,
        bulb_area,
        bulb_height,
        stern,
        appendages: options.appendages.clone(),
    };
    let of_hull = row.half_angle_of_entrance;
    let sharp = of_hull.filter(|&angle| angle > 0.0 && angle < BLUNT);
    let assumed = (half_angle_of_entrance(&ship), "Holtrop 1982, from the dimensions");
    ship.half_angle = list.take(label("i_E", "half angle of entrance", "deg", 2), options.half_angle, sharp, assumed);
    let given = options.stern.map(SternShape::coefficient);
    list.take(label("C_stern", "shape of the after body", "-", 0), given, None, (0.0, "normal sections"));
    appendages(&mut list, options);
    let water = water(&mut list, options, afloat.density, afloat.density_given);
    Gathered {
        blunt: of_hull.filter(|_| options.half_angle.is_none() && sharp.is_none()),
        bulb_found: options.bulb_area.is_none() && bulb.is_some(),
        ship,
        water,
        inputs: list.0,
    }
}

fn appendages(list: &mut Inputs, options: &ResistanceOptions) {
    let surface: f64 = options.appendages.iter().map(|one| one.surface).sum();
    let weighted: f64 = options.appendages.iter().map(|one| one.surface * one.factor).sum();
    let given = |value: f64| (!options.appendages.is_empty()).then_some(value);
    list.take(label("S_APP", "wetted surface of appendages", "m2", 2), given(surface), None, (0.0, "none"));
    if surface > 0.0 {
        list.take(label("1+k2", "their factor, mean by surface", "-", 3), given(weighted / surface), None, (1.0, ""));
    }
}

fn water(list: &mut Inputs, options: &ResistanceOptions, stored: f64, is_given: bool) -> Water {
    let of_hull = is_given.then_some(stored);
    let density =
        list.take(label("density", "of the water", "t/m3", 4), options.density, of_hull, (stored, "sea water"));
    let temperature = options.temperature.unwrap_or(TEMPERATURE);
    if options.viscosity.is_none() {
        list.take(label("t", "temperature of the water", "deg C", 1), options.temperature, None, (TEMPERATURE, ""));
    }
    let base = Water::new(1e3 * density, temperature);
    let of_tables = (1e6 * kinematic_viscosity(1e3 * density, temperature), "ITTC 7.5-02-01-03 (2011)");
    let given = options.viscosity.map(|viscosity| 1e6 * viscosity);
    let viscosity = 1e-6 * list.take(label("nu", "kinematic viscosity", "1e-6 m2/s", 4), given, None, of_tables);
    Water { viscosity, ..base }
}

/// The inputs of the viscous resistance, once they are known.
pub(in crate::report) fn viscous_inputs(
    options: &ResistanceOptions,
    form_factor: (f64, &'static str),
    allowance: (f64, &'static str),
) -> Vec<PredictionInput> {
    let mut list = Inputs::default();
    list.take(label("1+k1", "form factor", "-", 4), options.form_factor, None, form_factor);
    let of_method = (1e3 * allowance.0, allowance.1);
    let given = options.allowance.map(|allowance| 1e3 * allowance);
    list.take(label("C_A", "correlation allowance", "1e-3", 4), given, None, of_method);
    if let Some(efficiency) = options.efficiency {
        list.take(label("eta_D", "propulsive efficiency P_E / P_D", "-", 4), Some(efficiency), None, (1.0, ""));
    }
    list.0
}

/// Area and height of centre of the section where the waterline meets the stem, if it is a bulb: closed at the waterline
/// and a small part of the midship section.
fn bulb_of(hull: &Hull, row: &Hydrostatics, draught: f64) -> Option<[f64; 2]> {
    let fore = row.waterline_aft? + row.waterline_length;
    let keel = row.draught - draught;
    let half = |z: f64| hull.half_breadth(fore, z).unwrap_or(0.0).max(0.0);
    let (mut area, mut moment, mut widest) = (0.0, 0.0, 0.0f64);
    for (z, weight) in gauss_legendre(48).on(keel, row.draught) {
        let y = half(z);
        area += 2.0 * weight * y;
        moment += 2.0 * weight * y * (z - keel);
        widest = widest.max(y);
    }
    let is_bulb = BULBS.contains(&(area / row.midship_section_area)) && half(row.draught) <= CLOSED * widest;
    is_bulb.then(|| [area, (moment / area).min(HIGHEST * draught)])
}
