//! Hulls drawn at random: all families and presets, and carried tables made fair once.

use std::path::Path;

use loftsman::internals::exchange::read_table;
use loftsman::internals::hull::Hull;
use loftsman::internals::parametric::cosh::{DesignTargets, MidshipTarget};
use loftsman::internals::parametric::{Family, ShipType, analytic, ucl_cosh};

use crate::partners::{FairNet, Table};
use crate::random::Random;

/// A hull that is known.
pub(super) struct Truth {
    pub(super) name: String,
    half: Box<dyn Fn(f64, f64) -> Option<f64>>,
    /// Stations from where to where, and waterlines \[m\].
    pub(super) ends: [f64; 2],
    pub(super) heights: [f64; 2],
    /// B \[m\].
    pub(super) breadth: f64,
    /// Whether it is a table made fair by the smoother, which is no partner then.
    pub(super) smoothed: bool,
}

/// Folders of `tests/data` whose tables were made fair.
const CARRIED: [&str; 4] = ["s175", "series60_cb060", "series60_cb070", "series60_cb075"];

impl Truth {
    pub(super) fn half_breadth(&self, x: f64, z: f64) -> Option<f64> {
        (self.half)(x, z).filter(|y| *y > 1e-6)
    }

    /// Of a hundred hulls 76 are presets, 6 raw ones of cosh arcs, 8 in closed form, 10 carried ones.
    pub(super) fn drawn(random: &mut Random) -> Self {
        match random.below(50) {
            0..=37 => preset(random),
            38..=40 => raw(random),
            41 | 42 => closed("wigley", random, Family::Wigley),
            43 => closed("ellipsoid", random, Family::Ellipsoid),
            44 => closed("box", random, Family::Box),
            _ => carried(CARRIED[random.below(CARRIED.len())]),
        }
    }

    fn of_hull(name: &str, hull: Hull, ends: [f64; 2], top: f64) -> Self {
        let breadth = hull.particulars().breadth;
        // Waterlines are written in millimetres, and not above the hull.
        let [bottom, top] = [(1e3 * hull.bottom()).ceil() / 1e3, (1e3 * top).floor() / 1e3];
        Self {
            name: name.to_owned(),
            half: Box::new(move |x, z| {
                (z <= hull.deck_height(x) + 1e-9).then(|| hull.half_breadth(x, z.min(hull.top()))).flatten()
            }),
            ends,
            heights: [bottom, top],
            breadth,
            smoothed: false,
        }
    }
}

fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * random.uniform()
}

/// A hull of a preset with particulars, rake, flare and section character of its own; what the generator refuses is
/// drawn again, at last nearer to the preset.
fn preset(random: &mut Random) -> Truth {
    let ship_type = ShipType::ALL[random.below(ShipType::ALL.len())];
    let p = ship_type.preset();
    let lengths = match ship_type {
        ShipType::BulkCarrier => [90.0, 320.0],
        ShipType::Container => [100.0, 350.0],
        ShipType::GeneralCargo => [60.0, 180.0],
        ShipType::RoRo => [80.0, 230.0],
        ShipType::Tug => [18.0, 45.0],
        ShipType::Fishing => [14.0, 70.0],
        ShipType::Frigate => [70.0, 155.0],
        ShipType::Yacht => [8.0, 35.0],
    };
    for trial in 0..40 {
        let part = 1.0 - f64::from(trial) / 40.0;
        let mut within = |[middle, low, high]: [f64; 3]| middle + part * (between(random, low, high) - middle);
        let ratios = [p.length_breadth, p.breadth_draught, p.block].map(&mut within);
        let length = between(random, lengths[0], lengths[1]);
        let breadth = length / ratios[0];
        let draught = breadth / ratios[1];
        let mut about = |value: f64, by: f64| value + part * by * (2.0 * random.uniform() - 1.0);
        let rake = about(p.stem_rake_deg, 8.0).max(0.0).to_radians();
        let targets = DesignTargets {
            ship_type: Some(ship_type),
            length,
            breadth: Some(breadth),
            draught: Some(draught),
            depth: Some(draught * about(p.depth_draught, 0.15).max(1.1)),
            block_coefficient: Some(ratios[2]),
            midship_coefficient: Some(MidshipTarget::Value(about(p.midship, 0.3 * (1.0 - p.midship)).min(0.997))),
            lcb: Some(length * (0.5 + 0.01 * about(p.lcb_percent, 0.8))),
            stem_rake: Some(rake),
            section_character: Some(about(p.section_character, 0.8)),
            parallel_body: Some([between(random, 0.35, 0.45), between(random, 0.52, 0.62)].map(|t| t * length))
                .filter(|_| ratios[2] > 0.68 && random.below(3) == 0),
            deadrise: Some(between(random, 2.0, 15.0).to_radians())
                .filter(|_| p.midship < 0.96 && random.below(3) == 0),
            flare: Some(between(random, 5.0, 30.0).to_radians()).filter(|_| random.below(2) == 0),
            sheer_fore: Some(length * between(random, 0.0, 0.04)).filter(|_| random.below(4) == 0),
            transom_breadth: Some(between(random, 0.4, 0.9)).filter(|_| random.below(4) == 0),
            ..DesignTargets::default()
        };
        let Ok(generated) = Family::Cosh(Box::new(targets)).generate("truth") else { continue };
        let hull = generated.hull;
        let depth = hull.particulars().depth;
        let top = match random.below(3) {
            0 => draught,
            1 => (1.25 * draught).min(0.98 * depth),
            _ => 0.98 * depth,
        };
        let top = (1e2 * top).floor() / 1e2;
        let forward = hull.endings(top).map_or(length, |ends| ends[1]);
        let aft = hull.endings(top).map_or(0.0, |ends| ends[0]);
        let ends = match random.below(3) {
            0 => [0.0, length],
            1 => [aft.min(0.0), forward.max(length)],
            _ => [0.0, 0.5 * (length + forward.max(length))],
        };
        return Truth::of_hull(ship_type.as_str(), hull, ends, top);
    }
    panic!("no {} is feasible", ship_type.as_str());
}

/// A hull of the raw generator about its example frigate.
fn raw(random: &mut Random) -> Truth {
    loop {
        let length = between(random, 40.0, 140.0);
        let breadth = length / between(random, 5.0, 9.0);
        let draught = breadth / between(random, 2.5, 4.0);
        let parameters = ucl_cosh::Parameters {
            length,
            breadth,
            depth: draught * between(random, 1.5, 2.0),
            draught,
            midship_fullness: between(random, 1.0, 2.0),
            bow: between(random, 0.05, 0.5),
            transom_fullness: between(random, 1.0, 2.0),
            forward_deck: between(random, 0.4, 1.2),
            transom_breadth_ratio: between(random, 0.5, 0.95),
            transom_tip_ratio: between(random, 0.3, 0.5),
            aft_cut_up_ratio: between(random, 0.15, 0.3),
            keel_forward_ratio: between(random, 0.85, 0.95),
            side_slope: between(random, 0.0, 0.2),
        };
        if let Ok(generated) = Family::UclCosh(parameters).generate("truth") {
            return Truth::of_hull("ucl-cosh", generated.hull, [0.0, length], 0.95 * parameters.depth);
        }
    }
}

fn closed(name: &str, random: &mut Random, family: impl Fn(analytic::Dimensions) -> Family) -> Truth {
    let length = between(random, 50.0, 200.0);
    let breadth = length / between(random, 5.0, 10.0);
    let draught = breadth / between(random, 1.5, 3.0);
    let dimensions = analytic::Dimensions { length, breadth, draught, depth: draught };
    let hull = family(dimensions).generate("truth").unwrap_or_else(|problems| panic!("{problems:?}")).hull;
    Truth::of_hull(name, hull, [0.0, length], draught)
}

/// The largest block of a table all cells of which hold offsets.
fn block(table: &Table) -> Table {
    let (rows, columns) = (table.x.len(), table.z.len());
    let mut best = (0, [0; 4]);
    for i in 0..rows {
        for j in 0..columns {
            for k in i..rows {
                for l in j..columns {
                    let size = (k - i + 1) * (l - j + 1);
                    if size > best.0 && (i..=k).all(|i| (j..=l).all(|j| table.full(i, j))) {
                        best = (size, [i, j, k, l]);
                    }
                }
            }
        }
    }
    let [i, j, k, l] = best.1;
    Table {
        x: table.x[i..=k].to_vec(),
        z: table.z[j..=l].to_vec(),
        y: table.y[i..=k].iter().map(|row| row[j..=l].to_vec()).collect(),
    }
}

fn of_data(file: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(file)
}

/// The block of a carried table in which all offsets are given, made fair by the smoother: the text that is committed.
pub(crate) fn text_of_made_fair(folder: &str) -> String {
    let path = of_data("data").join(folder).join("offsets.csv");
    let bytes = std::fs::read(&path).unwrap();
    let table = read_table("offsets.csv", &bytes).unwrap_or_else(|problems| panic!("{folder}: {problems:?}")).table;
    FairNet::of(&block(&Table::from(&table))).to_string()
}

/// The carried tables and the files of their nets.
pub(crate) fn made_fair() -> impl Iterator<Item = (&'static str, std::path::PathBuf)> {
    CARRIED.into_iter().map(|folder| (folder, FairNet::path(folder)))
}

/// A carried table that was made fair.
fn carried(folder: &str) -> Truth {
    let net = FairNet::committed(folder);
    let [ends, heights] = net.extent();
    let breadth = 2.0 * net.value(0.5 * (ends[0] + ends[1]), heights[1]);
    let inside = move |t: f64, [from, to]: [f64; 2]| (from - 1e-3..=to + 1e-3).contains(&t);
    Truth {
        name: folder.to_owned(),
        half: Box::new(move |x, z| (inside(x, ends) && inside(z, heights)).then(|| net.value(x, z))),
        ends,
        heights,
        breadth,
        smoothed: true,
    }
}
