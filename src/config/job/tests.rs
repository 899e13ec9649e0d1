use super::*;
use crate::fairing::bends::Line;
use crate::fairing::constraint::Constraint;
use crate::fairing::constraint::{FixedLine, Rule, TangentPlace};
use crate::fairing::{LineCourse, LineKind as Breaks, ProposedLine};
use crate::hull::{Cell, FeatureLine, LineKind, StationOffsets};

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
        stated: StatedParticulars { draught: Some(3.0), ..StatedParticulars::default() },
        ..OffsetTable::default()
    }
}

#[test]
fn everything_is_read() {
    let text = "schema = 1\n[table]\nfile = \"a.csv\"\n[dimensions]\nT = \"4000 mm\"\n[energy]\nweight = 0.01\n\
                [tolerance]\ntable = \"3 mm\"\nstations = { \"9 1/2\" = \"1 mm\", \"0 m\" = 0.002 }\n[tolerance.cells]\n\"10@2 m\" = \"1/8 in\"\n\
                [lock]\ncells = [\"0@4\"]\nstations = [10]\nwaterlines = \"2 m\"\n\
                [hold]\nDisplacement = \"4100 t\"\nLCB = \"+1 %\"\nKB = \"table\"\nCm = \"free\"\nLCF = \"41 m AP\"\nsection_areas = [[50, 12.5], [60, 11, 0.5]]\n\
                [suspects]\nexclude = false\n[inflections]\ncost = 2.5";
    let file = read_job("j.toml", text).unwrap();
    assert_eq!((file.table.as_deref(), file.stated.draught), (Some("a.csv"), Some(4.0)));
    let job = file.for_table(&table(), 100.0).unwrap();
    assert_eq!((job.weight, job.tolerance.table), (Some(0.01), Some(0.003)));
    assert_eq!(job.tolerance.stations.len(), 2);
    assert!(job.tolerance.stations.contains(&(1, 0.001)) && job.tolerance.stations.contains(&(0, 0.002)));
    assert_eq!(job.tolerance.cells, [(2, 1, 0.003_175)]);
    // The cell, the last station where it has offsets, the waterline at 2 m.
    assert_eq!(job.locked, [(0, 1), (0, 2), (1, 1), (2, 1), (2, 2)]);
    assert!(!job.exclude_suspects && job.price == Some(2.5));
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
fn a_price_that_no_program_can_carry_is_refused() {
    for text in ["0", "-1", "1e7", "1e308"] {
        let problems = read_job("j.toml", &format!("[inflections]\ncost = {text}")).unwrap_err();
        assert_eq!(problems.iter().map(|problem| problem.code).collect::<Vec<_>>(), ["E124"], "{text}");
    }
    assert_eq!(read_job("j.toml", "[inflections]\ncost = 1e6").unwrap().price, Some(1e6));
}

#[test]
fn a_key_that_was_renamed_is_read_by_its_old_name() {
    let price = |text: &str| read_job("j.toml", text).map(|job| job.price);
    assert_eq!(price("[signs]\nprice = 2.5"), Ok(Some(2.5)));
    let codes: Vec<_> = price("[signs]\nother = 1").unwrap_err().iter().map(|problem| problem.code).collect();
    assert_eq!(codes, ["E121"]);
}

#[test]
fn a_key_that_was_removed_is_refused_with_what_serves() {
    for (removed, serves) in crate::config::keys::REMOVED {
        let (table, name) = removed.split_once('.').unwrap();
        let said = messages(&format!("fairness = 3\n[{table}]\n{name} = 3"));
        let expected = format!("E121 j.toml:3:1 {removed} was removed. Give {serves} instead: ");
        assert!(said.len() == 1 && said[0].starts_with(&expected), "{said:?}");
    }
    assert_eq!(read_option("--job", "Energy.Order", "3").unwrap_err()[0].code, "E121");
}

#[test]
fn nothing_said_is_the_default() {
    let job = read_job("j.toml", "").unwrap().for_table(&table(), 100.0).unwrap();
    let default = Job::default();
    assert_eq!((job.holding, job.tolerance, job.locked), (default.holding, default.tolerance, default.locked));
    assert_eq!((job.weight, job.signs, job.price), (default.weight, default.signs, default.price));
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
        .with(option("--weight", "energy.weight", "0.01"))
        .with(option("--waterplane-area", "hold.waterplane_area", "700"));
    assert_eq!(
        job.hold,
        [(Quantity::BlockCoefficient, Target::Value(0.6)), (Quantity::WaterplaneArea, Target::Value(700.0))]
    );
    let job = job.for_table(&table(), 100.0).unwrap();
    assert_eq!((job.tolerance.table, job.weight), (Some(0.002), Some(0.01)));
    assert_eq!(job.locked, [(0, 0), (0, 1), (0, 2), (1, 1)]);
    let problem = read_option("--cb", "hold.Cb", "1.2").unwrap_err();
    assert_eq!(problem[0].to_string(), "E124 --cb hold.Cb is 1.2. Expected a number above 0, at most 1.");
    let job = read_option("--lock", "lock.stations", "11").unwrap();
    let problem = job.for_table(&table(), 100.0).unwrap_err();
    assert_eq!(problem[0].to_string(), "E171 --lock lock.stations: no station \"11\". The table has 0, 9 1/2, 10.");
}

#[test]
fn places_without_hull_and_tolerances_of_nothing_are_refused() {
    let job = read_job("j.toml", "hold.section_areas = [[500, 20], [50, 20]]").unwrap();
    let problems = job.for_table(&table(), 100.0).unwrap_err();
    assert_eq!(problems.len(), 1);
    let said = problems[0].to_string();
    assert!(
        said.starts_with("E171 j.toml:1:") && said.contains("no section at x = 500.000 m: the stations stand"),
        "{said}"
    );
    let problems = read_job("j.toml", "tolerance.stations = { \"0\" = \"0 mm\" }").unwrap_err();
    let said = "E124 j.toml:1:24 tolerance.stations.0 is 0 m. Expected a positive length; what must not move is locked under [lock].";
    assert_eq!(problems[0].to_string(), said);
}

#[test]
fn all_problems_of_a_file_at_once() {
    let found = messages(
        "tabel.file = \"a\"\n[tolerance]\ntable = -1\nstations = { \"5\" = \"1 t\" }\ncells = { \"5\" = 1 }\n[lock]\ncells = [\"5\", true]\n\
         [hold]\ndisplacement = \"frei\"\nCb = 1.2\nLCB = 3\nCm = 0.9\nwaterplane_area = \"5 %\"\nsection_areas = [[1]]\ncm = 0.8\n[suspects]\nexclude = 1\n\
         [energy]\nweight = -1",
    );
    let expected = [
        "E121 j.toml:1:1 tabel is not a key of a job. Did you mean table?",
        "E124 j.toml:3:9 tolerance.table is -1. Expected a positive length; what must not move is locked under [lock].",
        "E123 j.toml:4:14 tolerance.stations.5: \"1 t\" is a mass, expected a table of names with lengths",
        "E123 j.toml:5:11 tolerance.cells: \"5\" is no cell. Write \"station@waterline\", as \"5@6.5\".",
        "E123 j.toml:7:10 lock.cells: \"5\" is no cell.",
        "E122 j.toml:7:15 lock.cells is a boolean, expected a list of names",
        "E127 j.toml:9:16 hold.displacement: \"frei\" is not known. Did you mean \"free\"?",
        "E124 j.toml:10:6 hold.Cb is 1.2. Expected a number above 0, at most 1.",
        "E123 j.toml:11:7 hold.LCB is 3, and its unit is missing.",
        "E123 j.toml:13:19 hold.waterplane_area: \"5 %\" is a percentage, expected an area",
        "E122 j.toml:14:18 hold.section_areas: an item is [1.0]. Expected a list of [x, area]",
        "E126 j.toml:15:1 hold.cm is written a second time",
        "E122 j.toml:17:11 suspects.exclude is 1, expected true or false",
        "E124 j.toml:19:10 energy.weight is -1.",
    ];
    assert_eq!(found.len(), expected.len(), "{found:#?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!(found.starts_with(expected), "{found}\n{expected}");
    }
    let found =
        messages("[hold]\nKM = 1e300\nwetted_surface = \"1e10 m2\"\nsection_areas = [[50, 1e155], [50, 20, -1]]");
    let expected = [
        "E124 j.toml:2:6 hold.KM is 1e300. Expected a number above 0, at most 1000000000.",
        "E124 j.toml:3:18 hold.wetted_surface is 10000000000. Expected a number above 0, at most 1000000000.",
        "E122 j.toml:4:18 hold.section_areas: an item is [50.0, 1e155]. Expected a list of [x, area]",
        "E122 j.toml:4:31 hold.section_areas: an item is [50.0, 20.0, -1.0]. Expected a list of [x, area]",
    ];
    assert_eq!(found.len(), expected.len(), "{found:#?}");
    for expected in expected {
        assert!(found.iter().any(|found| found.starts_with(expected)), "{found:#?}\n{expected}");
    }
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

#[test]
fn rules_for_lines_and_regions_are_read() {
    let text = "[lock]\nlines = [\"Stem\", \"waterline 2\", \"station 9 1/2\", \"line chine\"]\n\
                [tangent]\nentrance = { \"2\" = \"12 deg\" }\nrun = { \"4 m\" = 20 }\nstations = { \"9 1/2@2\" = \"0 deg\" }\nwaterlines = { \"50@3\" = -4 }\n\
                [flat]\nside = \"waterlines 2 to 4, stations 0 to 9 1/2\"\nbottom = [\"stations 10 m to 50 m\"]\n\
                [shape]\nrising = [\"waterline 2 from 0 to 9 1/2\"]\nfalling = \"station 10\"\nconvex = [\"station 9 1/2 from 1 m\"]\nconcave = [\"waterline 3\"]\n\
                inflections = { \"waterline 4\" = 1, \"station 0\" = 0, \"waterline 2 from 9 1/2\" = 2 }\n[lines]\naccept = [\"L2\", \"l1\"]\n\
                knuckle = \"waterline 2 from 9 1/2 to 100\"\ntangent = [\"station 50 m\"]";
    let file = read_job("j.toml", text).unwrap();
    let mut table = table();
    let points = vec![[0.0, 1.0, 2.5], [95.0, 1.2, 2.4]];
    table.lines.push(FeatureLine { name: "Chine".into(), kind: LineKind::Knuckle, points });
    let job = file.for_table(&table, 100.0).unwrap();
    let open = [f64::NEG_INFINITY, f64::INFINITY];
    let degrees = |angle: f64| angle.to_radians();
    let expected = [
        Rule::Fixed(FixedLine::Stem),
        Rule::Fixed(FixedLine::Line(Line::Waterline(2.0))),
        Rule::Fixed(FixedLine::Line(Line::Station(95.0))),
        Rule::Fixed(FixedLine::Named("Chine".into(), vec![[0.0, 2.5], [95.0, 2.4]])),
        Rule::FlatOfSide { x: [0.0, 95.0], z: [2.0, 4.0] },
        Rule::FlatOfBottom { x: [10.0, 50.0] },
        Rule::Monotone { line: Line::Waterline(2.0), over: [0.0, 95.0], rising: true },
        Rule::Monotone { line: Line::Station(100.0), over: open, rising: false },
        Rule::Curvature { line: Line::Station(95.0), over: [1.0, f64::INFINITY], convex: true },
        Rule::Curvature { line: Line::Waterline(3.0), over: open, convex: false },
        Rule::Inflections { line: Line::Waterline(4.0), over: open, most: 1 },
        Rule::Inflections { line: Line::Station(0.0), over: open, most: 0 },
        Rule::Inflections { line: Line::Waterline(2.0), over: [95.0, f64::INFINITY], most: 2 },
        Rule::Tangent(TangentPlace::Entrance(2.0), degrees(12.0)),
        Rule::Tangent(TangentPlace::Run(4.0), degrees(20.0)),
        Rule::Tangent(TangentPlace::Waterline([50.0, 3.0]), degrees(-4.0)),
        Rule::Tangent(TangentPlace::Station([95.0, 2.0]), 0.0),
    ];
    for rule in &expected {
        // Angles to the hundredth of a degree that the words have.
        let same = |found: &Rule| found.words() == rule.words();
        assert!(job.rules.iter().any(same), "{} of {:#?}", rule.words(), job.rules);
    }
    assert_eq!(job.rules.len(), expected.len());
    assert_eq!(job.accepted, Accepted::These(vec![2, 1]));
    let line = |kind, course, at, reach| ProposedLine { kind, course, at, reach, gain: 1.0 };
    let [low, high] = [table.waterlines[0], *table.waterlines.last().unwrap()];
    assert_eq!(
        job.lines,
        [
            line(Breaks::Knuckle, LineCourse::Waterline, 2.0, [95.0, 100.0]),
            line(Breaks::Tangent, LineCourse::Station, 50.0, [low, high]),
        ]
    );
    let short = read_job("j.toml", "[lines]\nknuckle = \"waterline 2 from 9 1/2 to 95.5\"").unwrap();
    let found = short.for_table(&table, 100.0).unwrap_err()[0].to_string();
    assert_eq!(
        found,
        "E177 j.toml:2:11 lines.knuckle: the part of the line that breaks has 1 station of the table. Name a part with two of \
         them at least, between 0 and 100 m."
    );
    let accepted = |text: &str| read_job("j.toml", &format!("lines.accept = {text}")).unwrap().accepted;
    assert_eq!(accepted("\"all\""), Some(Accepted::All));
    assert_eq!(accepted("\"L1, L3\""), Some(Accepted::These(vec![1, 3])));
}

#[test]
fn metacentre_and_wetted_surface_are_read() {
    let given = |text: &str| match read_job("j.toml", text).unwrap().for_table(&table(), 100.0).unwrap().holding {
        Holding::Both { own, given } => (own.len(), given),
        holding => panic!("{holding:?}"),
    };
    assert_eq!(given("hold.KM = 6.5"), (3, vec![Constraint::Metacentre { height: 6.5, gravity: 0.0 }]));
    let gm = vec![Constraint::Metacentre { height: 0.5, gravity: 6.0 }, Constraint::WettedSurface(900.0)];
    assert_eq!(given("[hold]\nGM = \"500 mm\"\nKG = 6\nwetted_surface = 900"), (3, gm));
    assert_eq!(given("hold.KM = \"table\"").0, 4);
    // A ship may be unstable as she stands.
    let less = vec![Constraint::Metacentre { height: -0.2, gravity: 7.0 }];
    assert_eq!(given("[hold]\nGM = -0.2\nKG = 7"), (3, less));
    let both = vec![Constraint::Displacement(4000.0), Constraint::BlockCoefficient(0.6)];
    assert_eq!(given("[hold]\ndisplacement = \"4000 m3\"\nCb = 0.6"), (2, both));
    let refused = |text: &str| -> Vec<String> {
        let file = read_job("j.toml", text).unwrap();
        file.for_table(&table(), 100.0).unwrap_err().iter().map(ToString::to_string).collect()
    };
    let said = "E179 j.toml:2:6 hold.GM: the height of the centre of gravity is not given. Give hold.KG (--kg), or hold KM instead.";
    assert_eq!(refused("[hold]\nGM = 0.5"), [said]);
    assert_eq!(
        messages("[hold]\nKM = 6\nGM = 1\nKG = 5"),
        ["E170 j.toml:3:1 KM and GM say the same. Give one of them."]
    );
    // GM and KG may come as two options.
    let option = |name, key, value| read_option(name, key, value).unwrap();
    let job = JobFile::default().with(option("--gm", "hold.GM", "0.5")).with(option("--kg", "hold.KG", "6"));
    assert!(job.for_table(&table(), 100.0).is_ok());
    let alone = JobFile::default().with(option("--gm", "hold.GM", "0.5")).for_table(&table(), 100.0).unwrap_err();
    assert!(alone[0].to_string().starts_with("E179 --gm hold.GM: the height"), "{}", alone[0]);
    let gravity = JobFile::default().with(option("--kg", "hold.KG", "6")).for_table(&table(), 100.0).unwrap_err();
    assert!(gravity[0].to_string().starts_with("E179 --kg hold.KG: "), "{}", gravity[0]);
    // Options stand over the job of the file, and beside each other.
    let file = read_job("j.toml", "hold.Cb = 0.7").unwrap();
    let two = option("--displacement", "hold.displacement", "4000 m3").and(option("--cb", "hold.Cb", "0.6"));
    let held = |job: JobFile| match job.for_table(&table(), 100.0).unwrap().holding {
        Holding::Both { given, .. } => given,
        holding => panic!("{holding:?}"),
    };
    let both = vec![Constraint::Displacement(4000.0), Constraint::BlockCoefficient(0.6)];
    assert_eq!(held(file.clone().with(two)), both);
    let one = option("--displacement", "hold.displacement", "4000 m3");
    assert_eq!(held(file.with(one)), both[..1]);
}

/// The table's own displacement and LCB are among them: without a draught volume and centre of volume are held unasked.
#[test]
fn targets_at_a_draught_are_refused_where_none_is_stated() {
    let table = OffsetTable { stated: StatedParticulars::default(), ..table() };
    let text = "[hold]\ndisplacement = \"4000 m3\"\nCb = 0.6\nLCB = \"+1 %\"\nCm = \"table\"\nKB = 2\nLCF = \"41 m AP\"\n\
                Cwp = 0.7\nGM = 1\nKG = 5\nwetted_surface = 900\nsection_areas = [[50, 12.5]]";
    let file = read_job("j.toml", text).unwrap();
    let found: Vec<String> = file.for_table(&table, 100.0).unwrap_err().iter().map(ToString::to_string).collect();
    assert_eq!(found.len(), 10, "{found:#?}");
    let help = "Give --draught (T under [table] beside a table, under [dimensions] of a job), or leave it out. Then volume and \
                centre of volume below the highest waterline that every station between the ends has are held.";
    for (found, what) in found.iter().zip([
        "j.toml:2:16 hold.displacement: displacement",
        "j.toml:3:6 hold.Cb: C_B",
        "j.toml:4:7 hold.LCB: LCB",
        "j.toml:6:6 hold.KB: KB",
        "j.toml:7:7 hold.LCF: LCF",
        "j.toml:8:7 hold.Cwp: C_WP",
        "j.toml:5:6 hold.Cm: C_M",
        "j.toml:9:6 hold.GM: GM_T",
        "j.toml:11:18 hold.wetted_surface: wetted surface",
        "j.toml:12:18 hold.section_areas: a section area",
    ]) {
        assert_eq!(*found, format!("E184 {what} needs a draught, and none is stated. {help}"));
    }
    assert!(file.for_table(&super::tests::table(), 100.0).is_ok());
    let problems =
        |hold: &str| read_job("j.toml", hold).unwrap().for_table(&table, 100.0).map_or_else(|all| all.len(), |_| 0);
    assert_eq!(problems("hold.displacement = \"table\"\nhold.LCB = \"table\""), 2);
    assert_eq!(problems("hold.displacement = \"free\"\nhold.Cm = \"free\""), 0);
    let stated = read_job("j.toml", &format!("dimensions.T = 3\n{text}")).unwrap();
    assert!(stated.for_table(&table, 100.0).is_ok());
}

#[test]
fn problems_of_rules_are_told_at_their_places() {
    let found = messages(
        "[lock]\nlines = [\"steem\", 3, \"waterline 2 from 1 to 3\"]\n[tangent]\nentrance = { \"2\" = \"95 deg\" }\nrun = 3\n\
         stations = { \"5\" = 1 }\nwaterlines = { \"5@2\" = \"3 m\" }\n[flat]\nside = [\"stations 1 to 2\"]\nbottom = [\"waterlines 1 to 2\"]\n\
         [shape]\nrising = [\"watrline 2\"]\nfalling = 4\nconvex = [\"waterline\"]\nconcave = [\"station 5 to\"]\n\
         inflections = { \"waterline 2\" = 1.5, \"deck\" = 1 }\n[lines]\naccept = [\"2\"]\n[hold]\nKG = -1\nwetted_surface = \"5 m\"",
    );
    let expected = [
        "E123 j.toml:2:10 lock.lines: \"steem\" is not clear. Did you mean stem?",
        "E122 j.toml:2:19 lock.lines is 3, expected a list of texts",
        "E123 j.toml:2:22 lock.lines: \"waterline 2 from 1 to 3\" is not clear. Expected a list of texts",
        "E124 j.toml:4:14 tangent.entrance.2 is 95 deg. Expected 0 to 89 deg.",
        "E122 j.toml:5:7 tangent.run is 3, expected a table of places with angles",
        "E123 j.toml:6:14 tangent.stations: \"5\" is no place. Write \"station@height\", as \"5@6.5\".",
        "E123 j.toml:7:16 tangent.waterlines.5@2: \"3 m\" is a length, expected a table of places with angles",
        "E123 j.toml:9:9 flat.side: \"stations 1 to 2\" is not clear. Expected a list of texts, as [\"stations 8 to 12, waterlines 3 to 9.75\"].",
        "E123 j.toml:10:11 flat.bottom: \"waterlines 1 to 2\" is not clear.",
        "E123 j.toml:12:11 shape.rising: \"watrline 2\" is not clear. Did you mean waterline?",
        "E122 j.toml:13:11 shape.falling is 4, expected a list of texts",
        "E123 j.toml:14:11 shape.convex: \"waterline\" is not clear.",
        "E123 j.toml:15:12 shape.concave: \"station 5 to\" is not clear.",
        "E122 j.toml:16:17 shape.inflections.waterline 2 is 1.5. Expected a whole number from 0 to 99.",
        "E123 j.toml:16:38 shape.inflections: \"deck\" is not clear.",
        "E123 j.toml:18:11 lines.accept: \"2\" is no line that is proposed. Expected L1, L2, ... or all.",
        "E124 j.toml:20:6 hold.KG is -1. Expected a positive length.",
        "E123 j.toml:21:18 hold.wetted_surface: \"5 m\" is a length, expected an area",
    ];
    assert_eq!(found.len(), expected.len(), "{found:#?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!(found.starts_with(expected), "{found}\n{expected}");
    }
    let job = read_job(
        "j.toml",
        "[lock]\nlines = [\"line chine\", \"station 11\"]\n[shape]\nconvex = [\"waterline 2 from 10 to 0\"]",
    )
    .unwrap();
    let found: Vec<String> = job.for_table(&table(), 100.0).unwrap_err().iter().map(ToString::to_string).collect();
    let expected = [
        "E178 j.toml:2:10 lock.lines: no line \"chine\". The table declares no knuckles and no tangent lines.",
        "E177 j.toml:4:11 shape.convex: the range from 100 m to 0 m is empty. Write the lesser of both first.",
    ];
    assert_eq!(found, expected);
}

#[test]
fn one_line_has_one_tolerance() {
    let text = "[tolerance.stations]\n\"9 1/2\" = \"1 mm\"\n\"95 m\" = \"2 mm\"\n[tolerance.waterlines]\n\"2 m\" = \"1 mm\"\n\"2\" = 0.001\n";
    let problems = read_job("j.toml", text).unwrap().for_table(&table(), 100.0).unwrap_err();
    let said: Vec<String> = problems.iter().map(ToString::to_string).collect();
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(said[0].starts_with("E183 j.toml:3:"), "{}", said[0]);
    assert!(
        said[0].contains("\"95 m\" is 0.002 m, and 0.001 m under another name of it. Name it once."),
        "{}",
        said[0]
    );
}
