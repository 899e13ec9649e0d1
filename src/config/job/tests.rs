use super::*;
use crate::fairing::constraint::Constraint;
use crate::hull::{Cell, StationOffsets};

fn messages(text: &str) -> Vec<String> {
    read_job("j.toml", text).unwrap_err().iter().map(ToString::to_string).collect()
}

/// Stations 0, 9 1/2 and 10 at 0, 95 and 100 m; waterlines 0, 2 and 4 m; nothing at the last station on the base line.
fn table() -> OffsetTable {
    let station = |name: &str, x: f64, cells: [Option<f64>; 3]| StationOffsets {
        half_breadths: cells.map(Cell::from).to_vec(),
        ..StationOffsets::new(name, x)
    };
    OffsetTable {
        waterlines: vec![0.0, 2.0, 4.0],
        stations: vec![
            station("0", 0.0, [Some(1.0), Some(2.0), Some(3.0)]),
            station("9 1/2", 95.0, [Some(1.0), Some(2.0), Some(3.0)]),
            station("10", 100.0, [None, Some(2.0), Some(3.0)]),
        ],
        ..OffsetTable::default()
    }
}

#[test]
fn everything_is_read() {
    let text = "schema = 1\n[table]\nfile = \"a.csv\"\n[dimensions]\nT = \"4000 mm\"\n[energy]\norder = 4\nanisotropy = 1\nweight = 0.01\ntrue_curvature = true\n\
                [tolerance]\ntable = \"3 mm\"\nstations = { \"9 1/2\" = \"1 mm\", \"0 m\" = 0.002 }\n[tolerance.cells]\n\"10@2 m\" = \"1/8 in\"\n\
                [lock]\ncells = [\"0@4\"]\nstations = [10]\nwaterlines = \"2 m\"\n\
                [hold]\nDisplacement = \"4100 t\"\nLCB = \"+1 %\"\nKB = \"table\"\nCm = \"free\"\nLCF = \"41 m AP\"\nsection_areas = [[50, 12.5], [60, 11, 0.5]]\n\
                [suspects]\nexclude = false\n[signs]\nimpose = false";
    let file = read_job("j.toml", text).unwrap();
    assert_eq!((file.table.as_deref(), file.stated.draught), (Some("a.csv"), Some(4.0)));
    let job = file.for_table(&table(), 100.0).unwrap();
    assert_eq!((job.energy.order, job.weight, job.tolerance.table), (Some(4), Some(0.01), Some(0.003)));
    assert_eq!(job.tolerance.stations.len(), 2);
    assert!(job.tolerance.stations.contains(&(1, 0.001)) && job.tolerance.stations.contains(&(0, 0.002)));
    assert_eq!(job.tolerance.cells, [(2, 1, 0.003_175)]);
    // The cell, the last station where it has offsets, the waterline at 2 m.
    assert_eq!(job.locked, [(0, 1), (0, 2), (1, 1), (2, 1), (2, 2)]);
    assert!(!job.exclude_suspects && !job.signs && job.true_curvature);
    let Holding::Both { own, given } = job.holding else { panic!("own and given") };
    assert_eq!(own, [Constraint::HeightOfBuoyancy(0.0)]);
    let expected = [
        Constraint::Displacement(4100.0 / 1.025),
        Constraint::CentreOfBuoyancy(51.0),
        Constraint::CentreOfFlotation(41.0),
        Constraint::SectionArea { x: 50.0, area: 12.5, band: 0.0 },
        Constraint::SectionArea { x: 60.0, area: 11.0, band: 0.5 },
    ];
    assert_eq!(given, expected);
}

#[test]
fn nothing_said_is_the_default() {
    let job = read_job("j.toml", "").unwrap().for_table(&table(), 100.0).unwrap();
    let default = Job::default();
    assert_eq!((job.holding, job.tolerance, job.locked), (default.holding, default.tolerance, default.locked));
    assert_eq!((job.energy, job.weight, job.signs), (default.energy, default.weight, default.signs));
}

#[test]
fn one_target_leaves_the_others_at_the_table() {
    let holding = |text: &str| read_job("j.toml", text).unwrap().for_table(&table(), 100.0).unwrap().holding;
    let own = vec![Constraint::CentreOfBuoyancy(0.0), Constraint::MidshipCoefficient(0.0)];
    let both = |given| Holding::Both { own: own.clone(), given };
    assert_eq!(holding("hold.Cb = 0.6"), both(vec![Constraint::BlockCoefficient(0.6)]));
    assert_eq!(holding("hold.displacement = \"4000 m3\""), both(vec![Constraint::Displacement(4000.0)]));
    assert_eq!(holding("hold.displacement = \"free\""), both(Vec::new()));
}

#[test]
fn an_option_stands_over_the_file() {
    let file = read_job("j.toml", "hold.displacement = 4000\ntolerance.table = 0.01\nlock.stations = [0]").unwrap();
    let option = |name, key, value| read_option(name, key, value).unwrap();
    let job = file
        .with(option("--cb", "hold.Cb", "0.6"))
        .with(option("--tolerance", "tolerance.table", "2 mm"))
        .with(option("--lock", "lock.cells", "9 1/2@2"))
        .with(option("--order", "energy.order", "3"))
        .with(option("--waterplane-area", "hold.waterplane_area", "700"));
    assert_eq!(
        job.hold,
        [(Quantity::BlockCoefficient, Wish::Value(0.6)), (Quantity::WaterplaneArea, Wish::Value(700.0))]
    );
    let job = job.for_table(&table(), 100.0).unwrap();
    assert_eq!((job.tolerance.table, job.energy.order), (Some(0.002), Some(3)));
    assert_eq!(job.locked, [(0, 0), (0, 1), (0, 2), (1, 1)]);
    let problem = read_option("--cb", "hold.Cb", "1.2").unwrap_err();
    assert_eq!(problem[0].to_string(), "E124 --cb hold.Cb is 1.2. Expected a number above 0, at most 1.");
    let job = read_option("--lock", "lock.stations", "11").unwrap();
    let problem = job.for_table(&table(), 100.0).unwrap_err();
    assert_eq!(problem[0].to_string(), "E171 --lock lock.stations: no station \"11\". The table has 0, 9 1/2, 10.");
}

#[test]
fn all_problems_of_a_file_at_once() {
    let found = messages(
        "tabel.file = \"a\"\n[tolerance]\ntable = -1\nstations = { \"5\" = \"1 t\" }\ncells = { \"5\" = 1 }\n[lock]\ncells = [\"5\", true]\n\
         [hold]\ndisplacement = \"frei\"\nCb = 1.2\nLCB = 3\nCm = 0.9\nwaterplane_area = \"5 %\"\nsection_areas = [[1]]\ncm = 0.8\n[signs]\nimpose = 1\n\
         [energy]\norder = 7\nweight = -1",
    );
    let expected = [
        "E121 j.toml:1:1 tabel is not a key of a job. Did you mean table?",
        "E124 j.toml:3:9 tolerance.table is -1 m. A tolerance is 0 or more; 0 locks.",
        "E123 j.toml:4:14 tolerance.stations.5: \"1 t\" is a mass, expected a table of names with lengths",
        "E123 j.toml:5:11 tolerance.cells: \"5\" is no cell. Write \"station@waterline\", as \"5@6.5\".",
        "E123 j.toml:7:10 lock.cells: \"5\" is no cell.",
        "E122 j.toml:7:15 lock.cells is a boolean, expected a list of names",
        "E127 j.toml:9:16 hold.displacement: \"frei\" is not known. Did you mean \"free\"?",
        "E124 j.toml:10:6 hold.Cb is 1.2. Expected a number above 0, at most 1.",
        "E123 j.toml:11:7 hold.LCB is 3, and its unit is not said.",
        "E123 j.toml:13:19 hold.waterplane_area: \"5 %\" is a percentage, expected an area",
        "E122 j.toml:14:18 hold.section_areas: an item is a list of 1. Expected a list of [x, area]",
        "E126 j.toml:15:1 hold.cm is written a second time",
        "E122 j.toml:17:10 signs.impose is 1, expected true or false",
        "E122 j.toml:19:9 energy.order is 7, expected a whole number from 2 to 4",
        "E124 j.toml:20:10 energy.weight is -1.",
    ];
    assert_eq!(found.len(), expected.len(), "{found:#?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!(found.starts_with(expected), "{found}\n{expected}");
    }
    let found = messages("[hold]\ndisplacement = 4000\nCb = 0.6");
    assert_eq!(found, ["E170 j.toml:3:1 displacement and Cb say the same. Give one of them."]);
}

#[test]
fn names_that_the_table_does_not_have() {
    let job = read_job("j.toml", "[lock]\nstations = [\"9\"]\nwaterlines = [3]\ncells = [\"10@0\"]").unwrap();
    let found: Vec<String> = job.for_table(&table(), 100.0).unwrap_err().iter().map(ToString::to_string).collect();
    let expected = [
        "E171 j.toml:2:13 lock.stations: no station \"9\". The table has 0, 9 1/2, 10.",
        "E172 j.toml:3:15 lock.waterlines: no waterline \"3\". The table has 0, 2, 4 m.",
        "E173 j.toml:4:10 lock.cells: the table has no offset at 10@0",
    ];
    assert_eq!(found, expected);
}
