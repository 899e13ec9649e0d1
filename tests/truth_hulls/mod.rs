//! Hulls whose true shape is known, tables of offsets with seeded errors sampled from them, and what fairing makes of
//! these.
//!
//! Truths, the first five in closed form over the rectangle 0 <= x <= L, 0 <= z <= T with plumb ends:
//!
//! * Wigley: y = (B/2)(1 - s^2)(1 - w^2), s = 2x/L - 1, w = 1 - z/T (Wigley 1942);
//! * S-shaped: y = (B/2)(1 - r(a)/r(1))(1 - w^2), a = |s|, r(t) = 1 - cos(sqrt(-m) t), t^2/2 or cosh(sqrt(m) t) - 1 for
//!   m < 0, = 0, > 0 and m = 12 z/T - 8: hollow waterlines below, full ones above;
//! * parallel middle body: flat from 0.36 L to 0.64 L, ends 1 - q(t)/q(1) with q(t) = k t - sin(k t) or sinh(k t) - k t;
//! * bilge: parabolic waterlines over a midship section of flat keel, rise of floor of 30 degrees, an arc and a
//!   vertical side;
//! * bulk carrier, container ship, frigate: presets of the generator; Series 60 and S-175: published tables that the
//!   smoother of `tests/partners` made fair, without the ends at which offsets are missing.
//!
//! Errors are counted on 201 x 101 points. A sign change is one of the second difference of the half-breadth (of the
//! distance along the plane for diagonals) on a grid of 200 (waterlines, diagonals) or 100 (sections) steps, between humps
//! that leave their chord by L/50,000 or more.

pub(crate) mod measure;

use std::path::Path;

use loftsman::internals::exchange::read_table;
use loftsman::internals::fairing::constraint::Constraint;
use loftsman::internals::fairing::fair::PRICE;
use loftsman::internals::fairing::job::{Holding, Job};
use loftsman::internals::hull::{
    Cell, Entry, Hull, Marks, OffsetStation, OffsetTable, StatedParticulars, StationOffsets, Written,
};
use loftsman::internals::parametric::ShipType;
use loftsman::internals::parametric::cosh::{self, DesignTargets, MidshipTarget};
use loftsman::internals::units::Notation;

use crate::partners::FairNet;
use crate::random::Random;

/// A half-breadth over x and z \[m\].
type HalfBreadth = Box<dyn Fn(f64, f64) -> Option<f64>>;

/// A hull that is known.
pub(crate) struct Truth {
    pub(crate) length: f64,
    pub(crate) draught: f64,
    half: HalfBreadth,
    /// The table without errors.
    clean: OffsetTable,
    /// Displacement \[m^3\] and LCB \[m\].
    volume: f64,
    lcb: f64,
    /// x and z from which to which errors are counted.
    from: [f64; 2],
    to: [f64; 2],
}

/// What is wrong with a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Errors {
    /// Normal, standard deviation \[m\].
    Normal(f64),
    /// Rounded to multiples \[m\].
    Rounded(f64),
    /// Rounded to eighths of an inch.
    Eighths,
    /// Normal with 2 mm, written in millimetres, and in three cells two neighbouring digits swapped.
    Typing,
    /// Normal with `noise`, and as much too much or too little in single cells \[m\].
    Outliers { noise: f64, sizes: &'static [f64] },
    /// Normal with 2 mm, and 30 mm too much in three neighbouring cells of a waterline.
    Adjacent,
}

/// Three gross errors.
pub(crate) const LARGE: Errors = Errors::Outliers { noise: 0.002, sizes: &[0.1, 0.15, 0.3] };
/// Three errors of ten to fifteen noise levels.
pub(crate) const SMALL: Errors = Errors::Outliers { noise: 0.002, sizes: &[0.02, 0.02, 0.03] };
/// Price of a change of curvature at which a table keeps what its noise does not explain: that of a degree of freedom
/// in Mallows' criterion.
pub(crate) const FAITHFUL: f64 = 2.0;
/// One of six noise levels.
pub(crate) const SIX_SIGMA: Errors = Errors::Outliers { noise: 0.002, sizes: &[0.012] };
/// Gross errors among noise of 25 mm.
pub(crate) const ROUGH: Errors = Errors::Outliers { noise: 0.025, sizes: &[0.25, 0.3, 0.5] };

impl Errors {
    /// Whether seeds matter.
    pub(crate) fn is_random(self) -> bool {
        !matches!(self, Self::Rounded(_) | Self::Eighths)
    }

    pub(crate) fn words(self) -> String {
        match self {
            Self::Normal(sigma) => format!("noise {:.0} mm", sigma * 1e3),
            Self::Rounded(quantum) => format!("rounded to {:.0} mm", quantum * 1e3),
            Self::Eighths => "rounded to 1/8 in".to_owned(),
            Self::Typing => "2 mm and 3 swaps".to_owned(),
            Self::Outliers { noise, sizes } => {
                let list: Vec<String> = sizes.iter().map(|size| format!("{:.0}", size * 1e3)).collect();
                format!("{:.0} mm and {} mm once", noise * 1e3, list.join(", "))
            }
            Self::Adjacent => "2 mm and 30 mm in 3 neighbours".to_owned(),
        }
    }
}

fn steps(to: f64, count: usize) -> Vec<f64> {
    (0..count).map(|i| to * i as f64 / (count - 1) as f64).collect()
}

/// Volume \[m^3\] and its moment about x = 0 \[m^4\] between these x and z, by three-point Gauss in cells between `breaks`.
fn moments([along, up]: [[f64; 2]; 2], breaks: [&[f64]; 2], half: impl Fn(f64, f64) -> f64) -> [f64; 2] {
    let cells = |[from, to]: [f64; 2], inner: &[f64]| -> Vec<[f64; 2]> {
        let mut edges = vec![from];
        edges.extend(inner);
        edges.push(to);
        let points = [(-0.6f64.sqrt(), 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.6f64.sqrt(), 5.0 / 9.0)];
        let mut rule = Vec::new();
        for pair in edges.windows(2) {
            let h = (pair[1] - pair[0]) / 60.0;
            for k in 0..60 {
                let middle = pair[0] + h * (f64::from(k) + 0.5);
                rule.extend(points.map(|(t, w)| [middle + 0.5 * h * t, 0.5 * h * w]));
            }
        }
        rule
    };
    let (mut volume, mut moment) = (0.0, 0.0);
    let across = cells(up, breaks[1]);
    for [x, weight] in cells(along, breaks[0]) {
        let area: f64 = across.iter().map(|[z, w]| 2.0 * w * half(x, *z)).sum();
        volume += weight * area;
        moment += weight * area * x;
    }
    [volume, moment]
}

/// A truth in closed form; `breaks` where it is less smooth, for the quadrature.
fn closed(
    [length, breadth, draught]: [f64; 3],
    [stations, waterlines]: [&[f64]; 2],
    breaks: [&[f64]; 2],
    half: impl Fn(f64, f64) -> f64 + 'static,
) -> Truth {
    let mut clean = OffsetTable { waterlines: waterlines.to_vec(), ..OffsetTable::default() };
    clean.stated = StatedParticulars {
        length_between_perpendiculars: Some(length),
        breadth: Some(breadth),
        draught: Some(draught),
        depth: Some(draught),
    };
    for (i, &x) in stations.iter().enumerate() {
        let mut station = StationOffsets::new(format!("{i}"), x);
        station.half_breadths = waterlines.iter().map(|&z| Cell::from(Some(half(x, z).max(0.0)))).collect();
        station.keel_height = Some(0.0);
        clean.stations.push(station);
    }
    clean.endings = waterlines.iter().map(|_| [Some(0.0), Some(length)]).collect();
    let [volume, moment] = moments([[0.0, length], [0.0, draught]], breaks, &half);
    Truth {
        length,
        draught,
        half: Box::new(move |x, z| Some(half(x, z))),
        clean,
        volume,
        lcb: moment / volume,
        from: [0.0, 0.0],
        to: [length, draught],
    }
}

pub(crate) fn wigley() -> Truth {
    let (xs, zs) = (steps(100.0, 21), steps(6.25, 11));
    closed([100.0, 10.0, 6.25], [&xs, &zs], [&[], &[]], |x, z| {
        let (s, w) = (2.0 * x / 100.0 - 1.0, 1.0 - z / 6.25);
        5.0 * (1.0 - s * s) * (1.0 - w * w)
    })
}

pub(crate) fn s_shaped() -> Truth {
    let (xs, zs) = (steps(100.0, 21), steps(6.0, 11));
    closed([100.0, 16.0, 6.0], [&xs, &zs], [&[50.0], &[4.0]], |x, z| {
        let (a, m, w) = ((x / 50.0 - 1.0).abs(), 12.0 * z / 6.0 - 8.0, 1.0 - z / 6.0);
        let r = |t: f64| match m {
            m if m > 1e-9 => (m.sqrt() * t).cosh() - 1.0,
            m if m < -1e-9 => 1.0 - ((-m).sqrt() * t).cos(),
            _ => 0.5 * t * t,
        };
        8.0 * (1.0 - r(a) / r(1.0)) * (1.0 - w * w)
    })
}

pub(crate) fn middle_body() -> Truth {
    let (xs, zs) = (steps(100.0, 21), steps(6.0, 13));
    closed([100.0, 16.0, 6.0], [&xs, &zs], [&[36.0, 64.0], &[17.0 / 3.0]], |x, z| {
        let (t, m, w) = ((((x - 50.0).abs() - 14.0) / 36.0).max(0.0), 3.0 * z - 17.0, 1.0 - z / 6.0);
        let q = |t: f64| match m {
            m if m > 1e-6 => (m.sqrt() * t).sinh() - m.sqrt() * t,
            m if m < -1e-6 => (-m).sqrt() * t - ((-m).sqrt() * t).sin(),
            _ => t * t * t,
        };
        8.0 * (1.0 - q(t) / q(1.0)) * (1.0 - w.powi(3))
    })
}

/// Radius of the bilge of [`bilge`] \[m\].
const RADIUS: f64 = 5.0;

/// Heights of the tangent points of the bilge of [`bilge`] \[m\].
pub(crate) fn tangents() -> [f64; 2] {
    let (slope, radius) = (30f64.to_radians(), RADIUS);
    let corner = 7.2 * slope.tan();
    let reach = radius * (0.5 * (0.5 * std::f64::consts::PI - slope)).tan();
    [corner - reach * slope.sin(), corner + reach]
}

pub(crate) fn bilge() -> Truth {
    let [low, high] = tangents();
    let zs = [0.0, 0.9, 1.8, low, 3.3, 4.0, 4.8, 5.6, 6.4, high, 8.0, 9.0];
    closed([100.0, 16.0, 9.0], [&steps(100.0, 21), &zs], [&[], &[low, high]], move |x, z| {
        let s = 2.0 * x / 100.0 - 1.0;
        let section = match z {
            z if z <= low => 0.8 + z / 30f64.to_radians().tan(),
            z if z < high => 8.0 - RADIUS + (RADIUS * RADIUS - (high - z).powi(2)).max(0.0).sqrt(),
            _ => 8.0,
        };
        section * (1.0 - s * s)
    })
}

/// A surface as truth, with the table that a draughtsman lifts from it.
fn surface(hull: Hull, clean: OffsetTable) -> Truth {
    let p = *hull.particulars();
    let (first, last) = (clean.stations[0].station.x, clean.stations[clean.stations.len() - 1].station.x);
    let (low, high) = (clean.waterlines[0], clean.waterlines[clean.waterlines.len() - 1]);
    Truth {
        length: p.length_between_perpendiculars,
        draught: hull.reference_height(),
        volume: Constraint::Displacement(0.0).value(&hull),
        lcb: Constraint::CentreOfBuoyancy(0.0).value(&hull),
        clean,
        from: [first, low],
        to: [last, high],
        half: Box::new(move |x, z| hull.half_breadth(x, z)),
    }
}

/// The block of a published table of `tests/data` in which all offsets are given, as the smoother made it fair
/// (`tests/truth`): a hull with the features of a real ship and without the roughness of its table.
fn of_net(folder: &str) -> Truth {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(folder).join("offsets.csv");
    let bytes = std::fs::read(&path).unwrap();
    let table = read_table("offsets.csv", &bytes).unwrap_or_else(|problems| panic!("{folder}: {problems:?}")).table;
    let net = FairNet::committed(folder);
    let [ends, heights] = net.extent();
    let inside = |t: f64, [from, to]: [f64; 2]| (from - 1e-3..=to + 1e-3).contains(&t);
    let waterlines: Vec<f64> = table.waterlines.iter().copied().filter(|&z| inside(z, heights)).collect();
    let mut clean = OffsetTable { endings: vec![[None; 2]; waterlines.len()], ..OffsetTable::default() };
    let mut breadth = 0.0_f64;
    for station in table.stations.iter().map(|station| &station.station).filter(|station| inside(station.x, ends)) {
        let mut faired = StationOffsets::new(station.name.clone(), station.x);
        faired.half_breadths = waterlines.iter().map(|&z| Cell::from(Some(net.value(station.x, z)))).collect();
        breadth = breadth.max(2.0 * net.value(station.x, heights[1]));
        clean.stations.push(faired);
    }
    clean.waterlines = waterlines;
    let length = ends[1] - ends[0];
    clean.stated = StatedParticulars {
        length_between_perpendiculars: Some(length),
        breadth: Some(breadth),
        draught: Some(heights[1]),
        depth: Some(heights[1]),
    };
    let [volume, moment] = moments([ends, heights], [&[], &[]], |x, z| net.value(x, z));
    Truth {
        length,
        draught: heights[1],
        volume,
        lcb: moment / volume,
        clean,
        from: [ends[0], heights[0]],
        to: [ends[1], heights[1]],
        half: Box::new(move |x, z| Some(net.value(x, z))),
    }
}

/// A hull of the generator: L, B, T \[m\], C_B, C_M.
fn generated(ship_type: ShipType, [length, breadth, draught, block, midship]: [f64; 5]) -> Truth {
    let targets = DesignTargets {
        ship_type: Some(ship_type),
        length,
        breadth: Some(breadth),
        draught: Some(draught),
        block_coefficient: Some(block),
        midship_coefficient: Some(MidshipTarget::Value(midship)),
        ..DesignTargets::default()
    };
    let hull = cosh::generate("truth", &targets).unwrap().hull;
    let stations: Vec<OffsetStation> =
        (0..21).map(|i| OffsetStation { name: format!("{i}"), x: 0.05 * length * f64::from(i) }).collect();
    let clean = OffsetTable::from_hull(&hull, &stations, &steps(draught, 13), &[]);
    surface(hull, clean)
}

pub(crate) fn bulk_carrier() -> Truth {
    generated(ShipType::BulkCarrier, [217.0, 32.25, 12.2, 0.80, 0.99])
}

/// Of the size of the S-175, with a transom.
pub(crate) fn container_ship() -> Truth {
    generated(ShipType::Container, [175.0, 25.4, 9.5, 0.57, 0.98])
}

/// Fine, with rise of floor and an immersed transom.
pub(crate) fn frigate() -> Truth {
    generated(ShipType::Frigate, [142.0, 19.06, 6.15, 0.50, 0.80])
}

impl Truth {
    /// The table with its errors: cells of the centreplane stay, as a draughtsman knows them.
    pub(crate) fn table(&self, errors: Errors, seed: u64) -> OffsetTable {
        let mut random = Random(seed.wrapping_mul(7919).wrapping_add(31));
        let mut table = self.clean.clone();
        let rounded = |y: f64, quantum: f64| (y / quantum).round() * quantum;
        let mut cells = Vec::new();
        for (i, station) in table.stations.iter_mut().enumerate() {
            for (j, cell) in station.half_breadths.iter_mut().enumerate() {
                let Some(y) = cell.value().filter(|&y| y > 1e-9) else { continue };
                let (other, far) = match errors {
                    Errors::Normal(sigma) => (y + sigma * random.normal(), true),
                    Errors::Rounded(quantum) => (rounded(y, quantum), true),
                    Errors::Eighths => (rounded(y, 0.0254 / 8.0), true),
                    Errors::Typing => (rounded(y + 0.002 * random.normal(), 0.001), y > 1.0),
                    Errors::Outliers { noise, .. } => (y + noise * random.normal(), y > 0.5),
                    Errors::Adjacent => (y + 0.002 * random.normal(), y > 0.5),
                };
                cell.entry = Entry::Given(other.max(0.0));
                if far {
                    cells.push((i, j));
                }
            }
        }
        match errors {
            Errors::Eighths => {
                table.form.notation = Notation::FeetInchesEighths;
                table.form.decimals = None;
            }
            Errors::Rounded(_) => table.form.decimals = Some(2),
            Errors::Typing => {
                table.form.decimals = Some(3);
                swaps(&mut table, &cells, &mut random);
            }
            Errors::Outliers { sizes, .. } => {
                for size in sizes {
                    let (i, j) = cells.swap_remove(random.below(cells.len()));
                    let cell = &mut table.stations[i].half_breadths[j];
                    let y = cell.value().unwrap_or(0.0);
                    cell.entry = Entry::Given((if random.below(2) == 0 { y + size } else { y - size }).max(0.0));
                }
            }
            Errors::Adjacent => {
                let inside = |i: usize, j: usize| (0..3).all(|k| cells.contains(&(i + k, j)));
                let starts: Vec<(usize, usize)> = cells.iter().copied().filter(|&(i, j)| inside(i, j)).collect();
                let (i, j) = starts[random.below(starts.len())];
                for station in &mut table.stations[i..i + 3] {
                    let cell = &mut station.half_breadths[j];
                    cell.entry = Entry::Given(cell.value().unwrap_or(0.0) + 0.03);
                }
            }
            Errors::Normal(_) => {}
        }
        table
    }

    /// The job that a user gives: the table, and displacement and LCB of the ship that is meant.
    pub(crate) fn job(&self) -> Job {
        let held = vec![Constraint::Displacement(self.volume), Constraint::CentreOfBuoyancy(self.lcb)];
        Job { holding: Holding::Given(held), ..Job::default() }
    }
}

/// Two neighbouring digits of the number in metres swapped in three cells, by at least 20 mm.
fn swaps(table: &mut OffsetTable, cells: &[(usize, usize)], random: &mut Random) {
    let mut done: Vec<(usize, usize)> = Vec::new();
    for _ in 0..10_000 {
        let (i, j) = cells[random.below(cells.len())];
        let cell = &mut table.stations[i].half_breadths[j];
        let y = cell.value().unwrap_or(0.0);
        let mut text: Vec<char> = format!("{y:.3}").chars().collect();
        let k = random.below(text.len() - 1);
        if done.contains(&(i, j)) || text[k] == '.' || text[k + 1] == '.' {
            continue;
        }
        text.swap(k, k + 1);
        let text: String = text.into_iter().collect();
        let wrong: f64 = text.parse().unwrap_or(y);
        if (wrong - y).abs() < 0.02 {
            continue;
        }
        *cell = Cell {
            entry: Entry::Given(wrong),
            marks: Marks::default(),
            written: Some(Written { text, row: i + 2, column: j + 2 }),
        };
        done.push((i, j));
        if done.len() == 3 {
            return;
        }
    }
}

/// A case of the benchmark.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Case {
    /// Name of the truth.
    pub(crate) name: &'static str,
    /// Which truth.
    pub(crate) truth: fn() -> Truth,
    /// Which errors.
    pub(crate) errors: Errors,
    /// Where the user says how noisy the table is, by a tolerance of three standard deviations: what forbidding a change
    /// of curvature may cost.
    pub(crate) told: Option<f64>,
}

impl Case {
    /// The job for a hull.
    pub(crate) fn job(&self, truth: &Truth) -> Job {
        let mut job = truth.job();
        if let (Some(price), Errors::Normal(sigma)) = (self.told, self.errors) {
            (job.tolerance.table, job.price) = (Some(3.0 * sigma), Some(price));
        }
        job
    }

    /// Truth and errors.
    pub(crate) fn title(&self) -> String {
        let told = match self.told {
            None => String::new(),
            Some(PRICE) => ", tolerance named".to_owned(),
            Some(price) => format!(", tolerance named, price {price}"),
        };
        format!("{}, {}{told}", self.name, self.errors.words())
    }
}

fn series60() -> Truth {
    of_net("series60_cb060")
}

fn s175() -> Truth {
    of_net("s175")
}

/// Every case of the benchmark. The third error is 0.5 % of B/2.
pub(crate) fn cases() -> Vec<Case> {
    type Kind = (&'static str, fn() -> Truth, f64);
    let truths: [Kind; 9] = [
        ("Wigley", wigley, 0.025),
        ("S-shaped", s_shaped, 0.04),
        ("middle body", middle_body, 0.04),
        ("bilge", bilge, 0.04),
        ("bulk carrier", bulk_carrier, 0.0806),
        ("container ship", container_ship, 0.0635),
        ("frigate", frigate, 0.0477),
        ("Series 60", series60, 0.0406),
        ("S-175", s175, 0.0635),
    ];
    let mut list = Vec::new();
    for (name, truth, half_percent) in truths {
        let kinds = [
            Errors::Normal(0.002),
            Errors::Normal(0.01),
            Errors::Normal(half_percent),
            Errors::Rounded(0.05),
            Errors::Eighths,
            Errors::Typing,
            LARGE,
        ];
        list.extend(kinds.map(|errors| Case { name, truth, errors, told: None }));
    }
    for (name, truth, prices) in
        [("Series 60", series60 as fn() -> Truth, [PRICE, FAITHFUL].as_slice()), ("S-175", s175, &[PRICE, FAITHFUL])]
    {
        for sigma in [0.002, 0.01] {
            let errors = Errors::Normal(sigma);
            list.extend(prices.iter().map(|&price| Case { name, truth, errors, told: Some(price) }));
        }
    }
    list.extend([SMALL, SIX_SIGMA, ROUGH, Errors::Adjacent].map(|errors| Case {
        name: "Wigley",
        truth: wigley,
        errors,
        told: None,
    }));
    list
}
