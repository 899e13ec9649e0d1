//! Every message about a table of offsets, provoked.

use loftsman::internals::exchange::{MOST_COLUMNS, Severity, TableProblem, read_table, read_table_with};

use std::fs;

use crate::support::{among, folder, notes, program, stdout};

fn problems(text: &str) -> Vec<String> {
    shown(read_table("t.csv", text.as_bytes()).err())
}

fn beside(text: &str, toml: &str) -> Vec<String> {
    shown(read_table_with("t.csv", text.as_bytes(), Some(("t.toml", toml))).err())
}

fn shown(problems: Option<Vec<TableProblem>>) -> Vec<String> {
    let problems = problems.expect("the table is refused");
    problems.iter().filter(|p| p.severity == Severity::Error).map(ToString::to_string).collect()
}

#[track_caller]
fn one(text: &str, message: &str) {
    assert_eq!(problems(text), [message], "{text}");
}

const GOOD: &str = "x [m],0.5,1\n0,1,2\n10,2,3\n";

#[test]
fn e300_no_table() {
    among(&problems(""), &["E300 t.csv: the file is empty"]);
    among(&problems("\n\n,,\n"), &["E300 t.csv: the file is empty"]);
    among(&problems("a\0b"), &["E300 t.csv: the file is not text"]);
    among(&problems("hello world\n"), &["E300 t.csv"]);
    among(&problems("x,1,2\n"), &["E300 t.csv row 1, column 1: 'x': 1 row of 3 fields: no table of offsets"]);
    among(&problems("PK\u{3}\u{4}"), &["E300 t.csv: not a workbook that can be read"]);
}

#[test]
fn e301_cells_all_at_once() {
    let text = "x [m],WL 0.5,WL 1\n0,3-11-9,abc\n10,(6.41,2\n20,nan,3.3.3\n";
    assert_eq!(
        problems(text),
        [
            "E301 t.csv row 2, column 2: '3-11-9': eighths are 0 to 7. Did you mean 3-11-0 or 4-0-1?",
            "E301 t.csv row 2, column 3: 'abc': not a number, a length or one of - * ? Leave the cell empty where there is no \
             hull; write ? where the offset is not known.",
            "E301 t.csv row 3, column 2: '(6.41': the bracket is not closed. Write (6.41).",
            "E301 t.csv row 4, column 2: 'nan': not a number, a length or one of - * ? Leave the cell empty where there is no \
             hull; write ? where the offset is not known.",
            "E301 t.csv row 4, column 3: '3.3.3': not a number, a length or one of - * ? Leave the cell empty where there is no \
             hull; write ? where the offset is not known.",
        ]
    );
    let tidy = "station,x,curve,z,y,flag\n1,0,WL,1,2,Q\n1,0,WL,,2,\n";
    among(&problems(tidy), &["E301", "'Q': not a flag"]);
    among(&problems(tidy), &["E301", "row 3", "a WL without its z"]);
    among(&problems("STN 0,STN 1\n\"0.5,1\",\"0.5,1\"\nx,\"1.5,2\"\n"), &["E301", "'x': not a pair"]);
}

#[test]
fn e303_positions_in_disorder() {
    one(
        "x [m],0.5,1.5,1\n0,1,2,3\n10,2,3,3\n",
        "E303 t.csv row 1, column 4: '1': the positions of the waterlines rise, but 1 m ('1') follows 1.5 m ('1.5'). Correct the \
         position, or put the lines in order",
    );
    among(&problems("x [m],0.5,1\n0,1,2\n20,2,3\n10,2,3\n"), &["E303", "row 4", "stations rise, but 10 m"]);
}

#[test]
fn e304_breadths_that_contradict_the_breadth() {
    let full = "x [m],0.5,1\n0,4,9\n10,9.5,10\n";
    among(
        &beside(full, "[table]\nB = 10"),
        &["E304 t.csv: 3 half-breadths exceed B/2 = 5.00 by up to 5.00 m", "breadths = \"full\""],
    );
    let half = "x [m],0.5,1\n0,4,4.5\n10,4.5,5\n";
    among(&beside(half, "[table]\nB = 10\nbreadths = \"full\""), &["E304", "2.50 m and B/2 is 5.00 m", "\"half\""]);
    // Merely suspicious: one cell beyond B/2.
    assert!(read_table_with("t", b"x [m],0.5,1\n0,4,5\n10,4.5,6\n", Some(("t.toml", "[table]\nB = 10"))).is_ok());
}

#[test]
fn e305_units_that_contradict_the_numbers() {
    among(
        &beside("x,0.5,1\n0,8000,16100\n10,9000,16100\n", "[table]\nunits = \"m\""),
        &["E305 t.csv: the largest half-breadth is 16100, which looks like millimetres, but the unit is m", "\"mm\""],
    );
    among(&beside("x,0.5,1\n0,1.25,2\n10,2,3\n", "[table]\nunits = \"mm\""), &["E305", "looks like metres"]);
    among(&problems("x [m],500,1000\n0,1,2\n10,2,3\n"), &["E305", "largest height is 1000"]);
}

#[test]
fn e306_twice() {
    among(&problems("x [m],0.5,0.50\n0,1,2\n10,2,3\n"), &["E306 t.csv row 1, column 3", "row 1, column 2 already"]);
    among(
        &problems("x [m],0.5,1\n0,1,2\n10,1,2\n10,2,3\n"),
        &["E306", "a station at 10 m stands in row 3, column 1 already"],
    );
    let tidy = "station,x,curve,z,y,flag\n1,0,WL,1,2,\n1,0,WL,1,3,\n";
    among(&problems(tidy), &["E306 t.csv row 3", "stands in row 2 already"]);
    among(&problems(&format!("{GOOD}\n{GOOD}")), &["E306", "a second block of half-breadths"]);
    among(&problems(&format!("{GOOD}\nx\\y [m],1\n0,1\n15,2\n")), &["E306", "15 m that the half-breadths do not have"]);
}

#[test]
fn e307_ragged_rows() {
    assert_eq!(
        problems("x [m],0.5,1\n0,1\n10,2,3,4\n20,1,2\n"),
        [
            "E307 t.csv row 2: the row has 2 fields, the header has 3. Fill up with empty fields where there is no hull",
            "E307 t.csv row 3: the row has 4 fields, the header has 3. Take away what is too much, or a decimal comma",
        ]
    );
    among(&problems("x [m],0.5,1\n0,\"1,2\n10,2,3\n"), &["E307", "a quotation mark is opened and not closed"]);
    among(&problems("station,x,curve,z,y,flag\n1,0,WL,1,2\n"), &["E307", "the row has 5 fields, the header has 6"]);
}

#[test]
fn e308_decimal_commas() {
    among(
        &problems("x [m],1,2,3\n0,0,5,1,5,2,5\n10,0,5,1,5,2,5\n"),
        &["E308 t.csv row 2", "7", "(4)", "decimal commas between separators that are commas too", "';' or tabs"],
    );
    among(&problems("x [m];0.5;1\n0;1,5;2\n10;2.5;3\n"), &["E308 t.csv row 2, column 2: '1,5'", "Did you mean 1.5?"]);
}

#[test]
fn e309_signs() {
    let found = problems("x [m],0.5,1\n0,1,-2\n10,2,3\n");
    among(&found, &["E309 t.csv row 2, column 3: '-2'", "1 are negative and 3 positive", "station '0'"]);
    assert!(notes("x [m],0.5,1\n0,-1,-2\n10,-2,-3\n", "").iter().any(|n| n.contains("starboard")));
}

#[test]
fn e310_headers() {
    among(&problems("x [m],0.5,keeel\n0,1,2\n10,2,3\n"), &["E310", "'keeel'", "Did you mean 'keel'?"]);
    among(&problems("x [m],0.5,foo\n0,1,2\n10,2,3\n"), &["E310 t.csv row 1, column 3", "names no position"]);
    among(&problems("x [m],0.5,\n0,1,2\n10,2,3\n"), &["E310 t.csv row 2, column 3: '2': an offset without a header"]);
    among(&problems("x [m],0.5,1\nfoo,1,2\n10,2,3\n"), &["E310 t.csv row 2, column 1: 'foo': the header of a station"]);
    among(
        &problems("station,x,curve,z,y,flag\n1,0,WK,1,2,\n"),
        &["E310", "'WK': not a kind of curve", "Did you mean WL?"],
    );
    among(&problems("station,x,curve,z,y,flag\n1,foo,WL,1,2,\n"), &["E310", "no position of a station"]);
    among(&problems("STN 0,foo\n\"0.5,1\",\"0.5,1\"\n"), &["E310", "'foo': the header of a station"]);
}

#[test]
fn e311_conventions() {
    let all = beside(
        GOOD,
        "[tabel]\n[table]\nunit = \"mm\"\nbreadths = \"whole\"\nLpp = -3\nB = \"wide\"\nname = 3\nstations = \"AP\"\n[endings]\nsten = 3\n\
         stem = 4\n[transom]\nslope = \"a\"\nz = 1\n[[line]]\nkind = \"soft\"\npints = 3\n",
    );
    among(&all, &["E311 t.toml row 1", "'tabel'", "Did you mean [table]?"]);
    among(&all, &["E311 t.toml row 3", "'unit': not a key of the conventions", "Did you mean units?"]);
    among(&all, &["'breadths': breadths is \"whole\"", "Known are half, full"]);
    among(&all, &["'Lpp': Lpp is -3", "larger than 0"]);
    among(&all, &["'B': B: 'wide' is not a number"]);
    among(&all, &["'name': name is 3, expected a text"]);
    among(&all, &["stations is \"AP\"", "from AP, from midship, from FP"]);
    among(&all, &["'sten'", "Did you mean stern?"]);
    among(&all, &["'stem': expected a list of points of 2 numbers"]);
    among(&all, &["'slope': expected a number"]);
    among(&all, &["'z': not a key", "Known are x, slope"]);
    among(&all, &["'transom': a transom without x"]);
    among(&all, &["expected knuckle or tangent"]);
    among(&all, &["'pints'", "Did you mean points?"]);
    among(&all, &["a line of 0 points"]);
    among(&beside(GOOD, "[table"), &["E311 t.toml row 1", "not TOML"]);
    among(&beside(GOOD, "[line]\nname = \"a\"\n"), &["Write [[line]] with two brackets"]);
    among(&beside(GOOD, "[endings]\nstem = [[0.75, 20]]\n"), &["E311", "0.75 m, where the table has no waterline"]);
    among(&problems(&format!("# unitts = mm\n{GOOD}")), &["E311 t.csv row 1", "'unitts'", "Did you mean units?"]);
    among(&problems(&format!("# units = mn\n{GOOD}")), &["units is \"mn\"", "Known are m, mm"]);
    // A design beside the table, and prose, are no conventions.
    among(&notes(GOOD, "[dimensions]\nLpp = 3\n[form]\nCb = 0.6\n"), &["t.toml beside the table has no [table]"]);
    assert!(read_table("t", format!("# station 0 = AP; y = half\n{GOOD}").as_bytes()).is_ok());
}

#[test]
fn e312_too_large() {
    let wide = "1,".repeat(MOST_COLUMNS + 10);
    among(&problems(&wide), &["E312", "more than 4000 fields in a row"]);
    among(&problems(&"1\n".repeat(200_002)), &["E312", "more than 200000 rows"]);
    among(&problems(&format!("{}\n", "a".repeat(2000))), &["E312", "a field longer than 1000 bytes"]);
    let huge = vec![b'1'; (16 << 20) + 1];
    among(&shown(read_table("t.csv", &huge).err()), &["E312", "a table has at most 16777216"]);
    among(
        &problems(&format!("x [m],0.5\n0,{}\n", "9".repeat(100))),
        &["E301", "100 characters; a cell has at most 80"],
    );
    // Stations are few, so that comparing all with all stays cheap.
    let mut text = String::from("x [m],0.5\n");
    (0..5000).for_each(|i| text += &format!("{i},1\n"));
    among(&problems(&text), &["E312 t.csv row 1, column 1", "5000 stations and 1 waterline; a table has at most 4000"]);
    let mut text = String::from("station,x,curve,z,y,flag\n");
    (0..2000).for_each(|i| text += &format!("1,{i},WL,{i},1,\n"));
    among(&problems(&text), &["E312", "2000 stations, 2000 waterlines and 0 buttocks"]);
    // Many errors of different causes are counted, not listed.
    let mut text = String::from("x [m],0.5\n");
    let letter = |k: u8| char::from(b'a' + k);
    (0..=u8::MAX).for_each(|i| text += &format!("{i},1 q{}{}\n", letter(i / 26), letter(i % 26)));
    let found = problems(&text);
    assert_eq!(found.len(), 101);
    among(&found, &["E312", "156 more problems not shown"]);
}

#[test]
fn e313_nothing_in_it() {
    among(&problems("x [m],0.5,1\n0,,\n10,-,*\n"), &["E313 t.csv: the table has no offset at all"]);
}

#[test]
fn w311_stations_on_both_sides_of_the_origin() {
    let text = "x_from_AP [m],0.5,1\n-10,0,0\n-4,1,2\n4,1,2\n10,0,0\n";
    among(&notes(text, ""), &["W311", "from x = -10.000 to 10.000 m", "x_from_midship"]);
    // Without a word they count from midship, with a warning.
    let open = text.replace("_from_AP", "");
    among(&notes(&open, ""), &["W320", "stations from -10 to 10", "taken from midship", "Give stations"]);
    for quiet in [GOOD, open.as_str(), "x_from_midship [m],0.5,1\n-10,0,0\n-4,1,2\n4,1,2\n10,0,0\n"] {
        assert!(!notes(quiet, "").iter().any(|note| note.contains("W311")), "{:?}", notes(quiet, ""));
    }
}

/// On one side: half a metre of 2 m^2 below the lowest waterline, and 0.875 m^3 above it.
#[test]
fn w315_a_bottom_that_the_table_does_not_show() {
    let text = "x [m],0.5,1\n0,0,0\n1,2,1\n2,0,1\n";
    among(&notes(text, ""), &["W315", "the lowest waterline is 0.5 m above the base line", "up to 53.3 %"]);
    // A keel without a flat of bottom leaves the sections down to it open.
    among(&notes("x [m],keel,0.5,1\n0,0,0,0\n1,0,2,1\n2,0,0,1\n", ""), &["W315", "between the keel and the lowest"]);
    let flat = "x [m],keel,flat of bottom,0.5,1\n0,0,0,0,0\n1,0,2,2,1\n2,0,0,0,1\n";
    for quiet in ["x [m],0,1\n0,0,0\n1,2,1\n2,0,1\n", flat] {
        assert!(!notes(quiet, "").iter().any(|note| note.contains("W315")), "{:?}", notes(quiet, ""));
    }
}

#[test]
fn waterlines_that_are_numbered_are_told() {
    let text = "x [m],WL 0,WL 1,WL 2\n0,0,0,0\n1,2,1,2\n2,0,1,1\n".replace("x [m]", "");
    among(
        &notes(&text, ""),
        &["W320", "waterlines are numbered, 'WL 0' to 'WL 2'", "taken as 1 m apart", "waterline_spacing"],
    );
    let quiet = |text: &str, beside: &str| {
        let found = notes(text, beside);
        assert!(!found.iter().any(|note| note.contains("are numbered, 'WL")), "{found:?}");
    };
    quiet(&text, "[table]\nwaterline_spacing = 1.5\n");
    quiet(&text.replace("WL 1", "WL 0.75"), "");
    quiet(&format!("z [m]{text}"), "");
}

#[test]
fn an_end_from_which_stations_are_numbered_is_told() {
    let text = "station,1,2\n0,0,0\n1,1,2\n2,1,2\n3,0,0\n";
    let beside = |stations: &str| format!("[table]\nstation_spacing = 3\n{stations}");
    among(&notes(text, &beside("")), &["W320", "0 is taken as AP", "numbers from FP"]);
    for stated in ["stations = \"numbers from AP\"", "stations = \"numbers from FP\""] {
        let found = notes(text, &beside(stated));
        assert!(!found.iter().any(|note| note.contains("0 is taken as AP")), "{found:?}");
    }
}

/// Five stations in 20 m, 5 m broad and 2 m deep, whose headers say nothing, or the wrong thing.
#[test]
fn a_hull_is_longer_than_it_is_broad() {
    let text = "WL,0,5,10,15,20\n0,0,1,1.5,1,0\n1,0,2,2.4,2,0\n2,0,2.1,2.5,2.2,0\n";
    let turned = "WL,0,1,2\n0,0,0,0\n5,1,2,2.1\n10,1.5,2.4,2.5\n15,1,2,2.2\n20,0,0,0\n";
    for text in [text.to_owned(), text.replace("WL", ""), turned.to_owned(), turned.replace("WL", "")] {
        let read = read_table_with("t.csv", text.as_bytes(), None).unwrap();
        assert_eq!((read.table.stations.len(), read.table.waterlines.len()), (5, 3), "{text}");
    }
    among(&notes(turned, ""), &["W320", "the hull would be 2 long, 5 broad and 20 high"]);
}

/// Dimensions may stand beside a table as in a job.
#[test]
fn dimensions_beside_a_table() {
    let table = |toml: &str| read_table_with("t.csv", GOOD.as_bytes(), Some(("t.toml", toml))).unwrap().table.stated;
    for toml in ["[dimensions]\nLpp = 9\nT = \"75 cm\"\n", "[Dimensions]\nlpp = 9\nt = 0.75\n[table]\nunits = \"m\"\n"]
    {
        let stated = table(toml);
        assert_eq!((stated.length_between_perpendiculars, stated.draught), (Some(9.0), Some(0.75)), "{toml}");
    }
    let refused = [
        ("[dimensions]\nT = 0\n", "E311 t.toml row 2, column 5: 'T': T is 0"),
        (
            "[dimensions]\nLbp = 9\n",
            "E311 t.toml row 2, column 1: 'Lbp': not a key of the conventions. Did you mean Lpp?",
        ),
        ("[dimension]\nT = 1\n", "Did you mean [dimensions]?"),
        (
            "[table]\nt = 1\n[dimensions]\nT = 1\n",
            "E311 t.toml row 4, column 1: 'T': stands in [table] and in [dimensions]. Give it once",
        ),
    ];
    for (toml, message) in refused {
        among(&beside(GOOD, toml), &[message]);
    }
    // A design or a job of the same name has them too, and tables of its own.
    for toml in ["[dimensions]\nT = 1\n[form]\nCb = 0.6\n", "[dimensions]\nT = 1\n[hold]\nCb = 0.6\n"] {
        among(&notes(GOOD, toml), &["N321", "nor [dimensions] alone, and is not read"]);
        assert_eq!(table(toml).draught, None);
    }
}

#[test]
fn warnings_and_notes() {
    among(&notes(GOOD, ""), &["W306", "no profiles of stem and stern"]);
    among(&notes(GOOD, "[table]\nT = 1\n"), &["W307", "only 2 waterlines up to T 1 m"]);
    among(&notes("station,0,1,2\n0,1,2,3\n1,1,,3\n2,1,2,3\n", ""), &["W314", "station 1, waterline 1 m"]);
    among(&notes("x [m],0.5,1,2\n0,1,2,0\n10,2,3,0\n", ""), &["W320", "above waterline 1 m, where it is up to 3 m"]);
    among(&notes("station,0.5,1\n0,1,2\n1,2,3\n", ""), &["W320", "taken as 1 m apart", "station_spacing"]);
    // A unit beside the word: distances where a hull of so many would be longer than it is broad, numbers else.
    let metric = |x: [u32; 3]| format!("station [mm],500,1000\n{},0,100\n{},2000,3000\n{},0,100\n", x[0], x[1], x[2]);
    assert!(!notes(&metric([0, 10_000, 20_000]), "").iter().any(|note| note.contains("W320")));
    among(&notes(&metric([0, 10, 20]), ""), &["W320", "stations are numbered"]);
    among(&notes("x_from_midship_m,0.5,1\n0,1,2\n1,2,3\n", ""), &["W320", "x is 0 at midship"]);
    among(&notes("x_from_midship_m,0.5,1\n-2,1,2\n-1,1,2\n2,2,3\n", ""), &["W320", "AP and FP, 4 m apart"]);
    among(
        &notes("x_from_FP_m,0.5,1\n0,1,2\n1,2,3\n", ""),
        &["W320", "the aftermost station, 1 m aft of FP, is taken as AP"],
    );
    among(&notes("x_from_FP_m,0.5,1\n0,1,2\n1,2,3\n", "[table]\nLpp = 5"), &["N321", "FP, which is 5 m forward"]);
    among(&notes("station,0.5,1\n0,1,2\n20,2,3\n", "[table]\nLpp = 50\n"), &["20 spaces in L_PP of 50 m"]);
    among(
        &notes("station,0.5,1\n0,1,2\n20,2,3\n", "[table]\nLpp = 50\nstations = \"numbers from FP\"\n"),
        &["station 0 is FP, 50 m forward of AP"],
    );
    among(&notes("x [m],1,0.5\n10,1,2\n0,2,3\n", ""), &["stations are written from forward aft"]);
    among(&notes("x [m],1,0.5\n10,1,2\n0,2,3\n", ""), &["waterlines are written from the deck down"]);
    among(&notes(GOOD, ""), &["N321", "2 stations and 2 waterlines; rows are stations", "separated by ','"]);
    among(&notes("x;0,5;1\n0;1;2\n10;2;3\n", ""), &["decimal commas"]);
    among(&notes("x,0.5,1\n0,1000,2000\n10,2000,3000\n", ""), &["half-breadths up to 3000 are taken as millimetres"]);
    among(&notes("x,0.5,1\n0,1000,2000\n10,2000,3000\n", ""), &["heights up to 1 are taken as metres"]);
    among(&notes("x,0.5,1\n0,1,2\n10,2,3\n", ""), &["half-breadths up to 3 are taken as metres"]);
}

#[test]
fn an_empty_table_is_an_empty_table_and_notes_are_no_errors() {
    let to = folder("empty");
    let file = to.join("empty.csv");
    fs::write(&file, "").unwrap();
    let done = program(&["hydro", file.to_str().unwrap(), "--json"]);
    assert_eq!(done.status.code(), Some(3));
    let json: serde_json::Value = serde_json::from_str(&stdout(&done)).unwrap();
    let codes: Vec<&str> = json["error"].as_array().unwrap().iter().map(|e| e["code"].as_str().unwrap()).collect();
    assert_eq!(codes, ["E300"], "{json}");
    let bad = to.join("bad.csv");
    fs::write(&bad, "x [m],1,2\n0,1,a\n5,1,2\n").unwrap();
    let done = program(&["hydro", bad.to_str().unwrap(), "--json"]);
    let json: serde_json::Value = serde_json::from_str(&stdout(&done)).unwrap();
    let codes: Vec<&str> = json["error"].as_array().unwrap().iter().map(|e| e["code"].as_str().unwrap()).collect();
    assert!(codes.contains(&"E301") && !codes.iter().any(|code| code.starts_with('N')), "{codes:?}");
}

#[test]
fn e305_names_the_unit_that_the_numbers_have() {
    let table = |corner: &str, [x, y, z]: [f64; 3]| {
        let heads: Vec<String> = [1.0, 3.0, 6.0].iter().map(|height| (z * height).to_string()).collect();
        let rows = [(0.0, 0.0), (50.0, 8.0), (100.0, 0.0)].map(|(at, half)| {
            let cells: Vec<String> = [0.5, 0.8, 1.0].iter().map(|part| format!("{:.0}", y * half * part)).collect();
            format!("{},{}\n", x * at, cells.join(","))
        });
        format!("{corner},{}\n{}", heads.join(","), rows.concat())
    };
    for (scales, kind, key) in [
        ([1.0, 100.0, 1.0], "half-breadth is 800, which looks like centimetres", "units = \"cm\""),
        ([1.0, 1000.0, 1.0], "half-breadth is 8000, which looks like millimetres", "units = \"mm\""),
        ([1.0, 1.0, 1000.0], "height is 6000, which looks like millimetres", "z_units = \"mm\""),
        ([100.0, 1.0, 1.0], "distance is 10000, which looks like centimetres", "x_units = \"cm\""),
    ] {
        let text = table("x \\ z [m]", scales);
        among(&problems(&text), &["E305", kind, &format!("Declare {key}")]);
        let obeyed = read_table_with("t.csv", text.as_bytes(), [("t.toml", format!("[table]\n{key}\n").as_str())]);
        let table = obeyed.unwrap_or_else(|list| panic!("{}", list[0])).table;
        assert!((table.stations[1].half_breadth(2).unwrap() - 8.0).abs() < 1e-9, "{key}");
        assert!(
            (table.stations[2].station.x - 100.0).abs() < 1e-9 && (table.waterlines[2] - 6.0).abs() < 1e-9,
            "{key}"
        );
    }
    // Metres among the positions of centimetres are metres.
    let text = table("x [m]", [1.0, 100.0, 1.0]);
    let read = read_table_with("t.csv", text.as_bytes(), [("t.toml", "[table]\nunits = \"cm\"\n")]).unwrap();
    assert!((read.table.waterlines[2] - 6.0).abs() < 1e-9, "{:?}", read.table.waterlines);
}

#[test]
fn lengths_in_messages_have_no_more_digits_than_they_need() {
    let found = problems("x [ft],1,2,3,3\n0,0,0,0,0\n10,1,2,2,2\n20,0,0,0,0\n");
    among(&found, &["E306", "a waterline at 0.9144 m stands"]);
    assert!(!found.iter().any(|problem| problem.contains("0.91440")), "{found:?}");
}
