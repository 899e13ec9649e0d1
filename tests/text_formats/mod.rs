//! Readers of the text formats of other programs: published hulls, what is written is read back, every message, and bytes
//! that are no table.

mod damage;
mod faults;
mod published;
mod samples;

use loftsman::internals::exchange::{
    ReadTable, TableProblem, read_table, write_britfair, write_delftship, write_freeship, write_ghs, write_michlet,
    write_pdstrip, write_pias,
};
use loftsman::internals::hull::{Marks, OffsetTable, OutlinePoint, StationOffsets};

use crate::support::read;

fn list(problems: &[TableProblem]) -> String {
    problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// Area of both sides of a section below `draught`: the integral of y dz along its lines, which counts what a line
/// doubles back over once \[m^2\].
fn area(station: &StationOffsets, draught: f64) -> f64 {
    let mut sum = 0.0;
    for pair in station.outlines.iter().flat_map(|line| line.windows(2)) {
        let (a, b) = (pair[0], pair[1]);
        let (low, high) = (a.z.min(draught), b.z.min(draught));
        if (b.z - a.z).abs() > 0.0 {
            let at = |z: f64| a.y + (b.y - a.y) * (z - a.z) / (b.z - a.z);
            sum += (high - low) * (at(low) + at(high));
        }
    }
    sum
}

/// Volume below `draught` by the trapezoid rule over the sections \[m^3\].
fn volume(table: &OffsetTable, draught: f64) -> f64 {
    let stations = &table.stations;
    stations
        .windows(2)
        .map(|pair| 0.5 * (pair[1].station.x - pair[0].station.x) * (area(&pair[0], draught) + area(&pair[1], draught)))
        .sum()
}

fn breadth(table: &OffsetTable) -> f64 {
    2.0 * table.stations.iter().flat_map(|s| s.outlines.iter().flatten()).map(|p| p.y).fold(0.0, f64::max)
}

/// A transom, a flat bottom with a knuckle, and a bulb under a flare.
fn ship() -> OffsetTable {
    let station = |name: &str, x: f64, branches: &[&[(f64, f64)]]| StationOffsets {
        outlines: branches
            .iter()
            .map(|line| {
                let mark = |y: f64, z: f64| y > 6.0 && z < 1.5;
                line.iter()
                    .map(|&(y, z)| OutlinePoint { y, z, marks: Marks { knuckle: mark(y, z), ..Marks::default() } })
                    .collect()
            })
            .collect(),
        deck_centre_height: Some(7.125),
        ..StationOffsets::new(name, x)
    };
    OffsetTable {
        name: "three sections".to_owned(),
        stations: vec![
            station("0", 0.0, &[&[(0.0, 4.0), (3.0, 4.25), (3.5, 6.0), (3.5, 7.0)]]),
            station("1", 20.5, &[&[(0.0, 0.0), (5.0, 0.0), (6.25, 1.0), (6.25, 4.0), (6.25, 7.0)]]),
            station("2", 41.0, &[&[(0.0, 0.0), (1.0, 1.0), (0.0, 2.0)], &[(0.0, 4.0), (1.0, 5.0), (2.5, 7.0)]]),
        ],
        ..OffsetTable::default()
    }
}

type Writer = fn(&OffsetTable) -> String;

/// Name of a file, writer, half of the last digit \[m\].
const WRITERS: [(&str, Writer, f64); 5] = [
    ("a.gf", write_ghs, 0.5e-4 * 0.3048),
    ("a.bri", write_britfair, 0.5e-6),
    ("a.pias", write_pias, 0.5e-4),
    ("geomet.out", write_pdstrip, 0.5e-4),
    ("a.txt", write_freeship, 0.5e-5),
];

const DELFTSHIP: &str = "3\n4\n1\n1\n1\n1\n1\n40.0\n10.0\n3.0\n0 10 30 40\n0.5 1.5 3.0\n\
    - - 1.00\n2.5 3.5 4.25\n3.0 4.0 5.0\n- 0.25 0.5\n\
    5 3.0  5 4.5  5 5.0  5.5 2.0\n2.0 0.25 0 0.5\n4.0 2.5 -1.0\n39.0 40.5 41.0\n0 1.0 1.5 0\n";

const SEAWAY: &str = "4.19\nSmall ship\n3.0 0.0 20.0 1.0\n2\n11.0 10.0\n2\n-1 2 0.0\n2.0 0.0 2.5 1.0 3.0\n2.0\n\
    10.00 3 0.0\n0.0 0.0 0.0 2.0 1.0 3.0\n3.0 3.0\n20.00 1 0.0\n0.0 0.0 3.0 0.5\n1.0 1.0 1.0\n*** End of file ***\n";

const CHINES: &str = "1\n0 0 0.1\n5 0 0\n10 0 1\n\n0 1 0.5\n5 1.5 0.4\n9 0.5 0.8\n10 0 1\n\n0 1.25 1\n10 0.25 1.5\n";

const FRACTIONS: &str = "# a small ship\n# L = 40 m, B = 32 ft, T = 3.0\n# station 0 = AP, 10 = FP\n\
    station,wl0_tangent,wl0.5,wl1,area\n0,0,0,0.2,0\n5,0.5,0.9,1,1\n10,0,0.01,0.02,0\nmax,0.8,0.9,1,\n";

const POINTS: &str = "x_from_AP_m,loop,point,y_mm,z_mm\n0,0,0,0,500\n0,0,1,1500,1000\n0,0,2,1600,3000\n\
    20,0,0,0,0\n20,0,1,2000,0\n20,0,2,2100,3000\n39,0,0,0,100\n39,0,1,250,500\n39,0,2,0,900\n\
    39,1,0,0,1500\n39,1,1,800,3000\n39,1,2,0,3010\n";

const MARKERS: &str = "Station\tLong. Pos. m\tOffset m\tHeight m\n1\t0\t0\t0.5\n1\t0\t2\t3\n2\t20\t0\t0\n2\t20\t3\t3\n";
