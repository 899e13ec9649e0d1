//! Every message about a design file, provoked once; and readers that meet random bytes.

use loftsman::internals::config::read;
use loftsman::internals::exchange::{read_hgf, read_hull};
use loftsman::internals::units::{parse, parse_list};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

fn messages(text: &str) -> Vec<String> {
    match read("hull.toml", text) {
        Ok(design) => panic!("no message: {design:?}"),
        Err(problems) => problems.iter().map(ToString::to_string).collect(),
    }
}

#[track_caller]
fn says(text: &str, expected: &str) {
    let found = messages(text);
    assert!(found.iter().any(|message| message.starts_with(expected)), "expected: {expected}\nfound: {found:#?}");
}

const LENGTH: &str = "dimensions.Lpp = 80\n";

fn with(rest: &str) -> String {
    format!("{LENGTH}{rest}")
}

#[test]
fn syntax() {
    says("[dimensions]\nLpp = = 3", "E120 hull.toml:2:7 not TOML:");
    let comma = messages("[dimensions]\nB = 13,2\n");
    assert!(comma.iter().any(|m| m.contains("A decimal comma? Write 13.2.")), "{comma:#?}");
    let unquoted = messages("[form]\nCm = kerlen\n");
    assert!(unquoted.iter().any(|m| m.contains("stand in quotes: \"kerlen\"")), "{unquoted:#?}");
    says(&"#".repeat(2 << 20), "E120 hull.toml the file has 2097152 bytes");
}

#[test]
fn keys() {
    says(&with("form.Cpw = 0.8"), "E121 hull.toml:2:6 form.Cpw is not a key of a design. Did you mean Cwp?");
    says(&with("Cb = 0.8"), "E121 hull.toml:2:1 Cb is not a key of a design. Cb belongs to [form].");
    says(&with("form.zzzzzz = 0.8"), "E121 hull.toml:2:6 form.zzzzzz is not a key of a design. Known here: Cb,");
    says(&with("qqqqqq.x = 0.8"), "E121 hull.toml:2:1 qqqqqq is not a key of a design.");
    says(&with("form.stern.beam_transom = 1"), "E121 hull.toml:2:12 form.stern.beam_transom is not a key");
    says(&with("form.Cb = 0.7\nform.CB = 0.7"), "E126 hull.toml:");
    says(&with("form = 3"), "E122 hull.toml:2:8 form is 3, expected a table. Write [form] on its own line.");
    says(
        &with("water.shell = { thick = 1 }"),
        "E121 hull.toml:2:17 water.shell.thick is not a key of a design. Did you mean thickness?",
    );
    says("project.name = \"x\"", "E125 hull.toml dimensions.Lpp missing");
    says("project.family = \"box\"\ndimensions.Lpp = 1", "E125 hull.toml dimensions.B, dimensions.T missing");
    says(
        "project.family = \"ucl-cosh\"\ndimensions.Lpp = 1",
        "E125 hull.toml dimensions.B, dimensions.T, dimensions.D, form.raw.ms,",
    );
    says(
        "project.family = \"box\"\n[form]\nCb = 1",
        "E126 hull.toml:3:1 form.Cb is not a key of the family \"box\". It belongs to cosh.",
    );
    says("schema = 2\n", "E128 hull.toml:1:10 schema 2 is not known to this program");
}

/// Every line begins with the expected one, in this order.
#[track_caller]
fn says_all(text: &str, expected: &[&str]) {
    let found = messages(text);
    let fits = found.len() == expected.len() && found.iter().zip(expected).all(|(f, e)| f.starts_with(e));
    assert!(fits, "expected: {expected:#?}\nfound: {found:#?}");
}

#[test]
fn what_the_family_refuses_stands_beside_the_other_problems() {
    says_all(
        "[dimensions]\nLpp = 80\nB = 13\nT = 8.2\nD = 7.9\n[form]\nCb = 0.85\nCm = 0.8\nCwp = 0.7\n[forn]\nx = 1\n",
        &[
            "E105 hull.toml:4:1 T 8.200 m is not less than depth D",
            "E102 hull.toml:7:1 Cb 0.8500 with Cm 0.8000",
            "E103 hull.toml:9:1 Cb 0.8500 needs Cwp above 0.8500; you set 0.7000.",
            "E121 hull.toml:10:2 forn is not a key of a design. Did you mean form?",
        ],
    );
    let boxed = "project.family = \"box\"\ndimensions = { Lpp = 80, B = 10, T = 8, D = 7 }\n";
    says_all(
        &format!("{boxed}output.figures = 3\n"),
        &["E105 hull.toml:2:", "E122 hull.toml:3:18 output.figures is 3"],
    );
    // A number that could not be read, or went to a misspelled key, is not held against the design.
    says_all("[dimensions]\nLpp = 80\nT = 8.2\nD = \"7,9\"\n", &["E123 hull.toml:4:5 dimensions.D: '7,9'"]);
    says_all(&with("form.Cb = 0.85\nform.CM = \"0.8x\""), &["E123 hull.toml:3:11 form.Cm: 'x' is not a unit"]);
    says_all("[dimensions]\nLpp = = 80\n", &["E120 hull.toml:2:7 not TOML:"]);
    says_all(
        &with("[zzzzzz]\n"),
        &[
            "E121 hull.toml:2:2 zzzzzz is not a key of a design. Known here: schema, [project], [dimensions], [form], [water], [weight], [conventions], [output], [reference].",
        ],
    );
    says_all(
        &with("form.bow.zzzzzzz = 1"),
        &["E121 hull.toml:2:10 form.bow.zzzzzzz is not a key of a design. Known here: rake,"],
    );
}

#[test]
fn remarks_of_a_design_that_can_be_built() {
    let remarks = |text: &str| {
        let generated = read("hull.toml", text).unwrap().family.generate("ship").unwrap_or_else(|e| panic!("{e:#?}"));
        generated.remarks.into_iter().map(|remark| (remark.code, remark.key)).collect::<Vec<_>>()
    };
    let cargo =
        "project.preset = \"general-cargo\"\ndimensions = { Lpp = 80, B = 13.2, T = 5.2, D = 7 }\nform.Cb = 0.72\n";
    assert_eq!(remarks(cargo), []);
    assert_eq!(remarks(&cargo.replace("13.2", "15.5")), [("W202", "B")]);
    assert!(remarks(&format!("{cargo}form.parallel_body = [0.52, 0.6]\n")).contains(&("W203", "Cm")));
}

#[test]
fn published_tables() {
    let table = |text: &str| with(&format!("reference.table = \"{text}\""));
    says(&table("T,DISPVOLL\\n1,2"), "E150 hull.toml:2:19 the table has an unknown column `DISPVOLL`");
    says(&table("KB\\n1"), "E150 hull.toml:2:19 the table has no column T");
    says(&table("T,KB\\n1"), "E150 hull.toml:2:19 line 2 of the table is `1`");
}

#[test]
fn types() {
    says(&with("project.name = 3"), "E122 hull.toml:2:16 project.name is 3, expected a text in quotes");
    says(&with("form.Cb = true"), "E122 hull.toml:2:11 form.Cb is a boolean, expected a number");
    says(&with("form.parallel_body = 0.4"), "E122 hull.toml:2:22 form.parallel_body is 0.4, expected two fractions");
    says(&with("form.parallel_body = [0.4]"), "E122 hull.toml:2:22 form.parallel_body is a list of 1, expected two");
    says(&with("form.LCB = [1]"), "E122 hull.toml:2:12 form.LCB is a list of 1, expected \"+0.8 %\"");
    says(
        &with("conventions.stations = 2.5"),
        "E122 hull.toml:2:24 conventions.stations is 2.5, expected a whole number from 4",
    );
    says(&with("output.figures = 3"), "E122 hull.toml:2:18 output.figures is 3, expected \"all\", \"none\"");
    says(&with("output.figures = [3]"), "E122 hull.toml:2:19 output.figures is 3");
    says(&with("output.draughts = 1979-05-27"), "E122 hull.toml:2:19 output.draughts is a datetime");
    says(&with("water.shell = 1.006"), "E122 hull.toml:2:15 water.shell is 1.006, expected { thickness");
    says(&with("project.preset = 1"), "E122 hull.toml:2:18 project.preset is 1, expected one of");
    says(&with("form.LCB = \"3 t\""), "E122 hull.toml:2:12 form.LCB is \"3 t\", expected \"+0.8 %\"");
}

#[test]
fn values() {
    says(&with("dimensions.B = \"13,2\""), "E123 hull.toml:2:16 dimensions.B: '13,2' has a decimal comma; write 13.2.");
    says(&with("dimensions.B = \"13 furlongs\""), "E123 hull.toml:2:16 dimensions.B: 'furlongs' is not a unit");
    says(
        &with("dimensions.B = \"13 deg\""),
        "E123 hull.toml:2:16 dimensions.B: \"13 deg\" is an angle, expected a length",
    );
    says(&with("dimensions.B = \"14 kn\""), "E123 hull.toml:2:16 dimensions.B: \"14 kn\" is a speed");
    says(&with("dimensions.B = \"3-11-9\""), "E123 hull.toml:2:16 dimensions.B: '3-11-9': eighths must be 0 to 7");
    says(&with("dimensions.B = nan"), "E123 hull.toml:2:16 dimensions.B is NaN, expected a finite number");
    says(&with("form.LCB = 0.8"), "E123 hull.toml:2:12 form.LCB is 0.8, and its unit is missing. Write \"+0.8 %\"");
    says(&with("form.LCB = \"x AP\""), "E123 hull.toml:2:12 form.LCB: 'x' is not a number");
    says(&with("output.draughts = \"1:9\""), "E123 hull.toml:2:19 output.draughts: item 1: a range is from:to:step");
    says(&with("output.draughts = []"), "E123 hull.toml:2:19 output.draughts: the list is empty");
    says(
        &with("output.draughts = { from = 1, to = 2 }"),
        "E123 hull.toml:2:19 output.draughts: from, to and step are all needed",
    );
    says(
        &with("output.draughts = { from = 1, to = 2, step = -1 }"),
        "E123 hull.toml:2:19 output.draughts: item 1: a step of -1",
    );
    says(&with("form.parallel_body = [0.6, 0.4]"), "E124 hull.toml:2:22 form.parallel_body is 0.6 to 0.4");
    says(
        &with("water.density = 1025"),
        "E124 hull.toml:2:17 water.density is 1025 t/m3, expected 0.9 to 1.3. Write it in t/m3",
    );
    says(&with("water.density = 8"), "E124 hull.toml:2:17 water.density is 8 t/m3, expected 0.9 to 1.3. Sea water");
    says(&with("water.shell = { factor = 2 }"), "E124 hull.toml:2:15 water.shell: factor 2; expected");
    says(
        &with("project.preset = \"frigat\""),
        "E127 hull.toml:2:18 project.preset: \"frigat\" is not known. Did you mean \"frigate\"?",
    );
    says(
        &with("project.preset = \"zzz\""),
        "E127 hull.toml:2:18 project.preset: \"zzz\" is not known. Known are \"bulk-carrier\"",
    );
    says(
        &with("output.figures = \"linse\""),
        "E127 hull.toml:2:18 output.figures: \"linse\" is not known. Did you mean \"lines\"?",
    );
    says(
        &with("form.stern.transom_height = 0.5"),
        "E125 hull.toml:2:12 form.stern.transom_height is measured by D, which the design does not say. Give D",
    );
    says(
        &with("form.stern.transom_immersion = \"1 m\""),
        "E125 hull.toml:2:12 form.stern.transom_immersion is measured by T",
    );
    says(&with("form.stern.transom_beam = \"9 m\""), "E125 hull.toml:2:12 form.stern.transom_beam is measured by B");
}

#[test]
fn contradictions() {
    let dimensions = "dimensions = { Lpp = 80, B = 13.2, T = 5.2, D = 7 }\n";
    says(
        &format!("{dimensions}form.Cb = 0.72\nform.displacement = \"4150 t\""),
        "E110 hull.toml:3:6 displacement 4150.0 t and Lpp B T Cb rho = 4052.5 t disagree by 2.4 %. Give one of them; this displacement is Cb 0.7373, or T 5.325 m",
    );
    says(
        &format!("{dimensions}form.stern.transom_height = 0.5\nform.stern.transom_immersion = 0.1"),
        "E126 hull.toml:3:12 transom_height and transom_immersion say the same thing twice. Give one of them.",
    );
    says(&with("water.shell = { factor = 1.006, thickness = 0.01 }"), "E126 hull.toml:2:15 water.shell has both");
    let three = with("form.run_length = 30\nform.entrance_length = 30\nform.parallel_body = [0.4, 0.5]");
    says(
        &three,
        "E111 hull.toml:3:6 run 30.000 m + parallel body 8.000 m + entrance 30.000 m = 68.000 m, and Lpp is 80.000 m",
    );
    says(
        &with("form.run_length = 50\nform.entrance_length = 40"),
        "E111 hull.toml:3:6 run 50.000 m + entrance 40.000 m = 90.000 m is more than Lpp",
    );
    says(
        &with("form.run_length = 30\nform.parallel_body = [0.5, 0.6]"),
        "E111 hull.toml:2:6 form.run_length is 30.000 m, and parallel_body leaves 40.000 m",
    );
}

/// Texts from pieces that mean something to the readers, with random bytes between them.
fn text(random: &mut StdRng, pieces: &[&str]) -> String {
    let mut bytes = Vec::new();
    for _ in 0..random.random_range(0..40) {
        if random.random_range(0..4) == 0 {
            bytes.extend((0..random.random_range(0..6)).map(|_| random.random_range(0..=255u8)));
        } else {
            bytes.extend_from_slice(pieces[random.random_range(0..pieces.len())].as_bytes());
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[test]
fn random_design_files_never_panic() {
    let mut random = StdRng::seed_from_u64(1);
    let pieces = [
        "[form]\n",
        "[dimensions]\n",
        "[form.stern]\n",
        "Lpp",
        "=",
        " = ",
        "1e400",
        "-0",
        "0x7f",
        "[",
        "]",
        "{",
        "}",
        "\"",
        "\n",
        ",",
        ".",
        "LCB",
        "\"+0.8 %\"",
        "parallel_body",
        "[0.4, 0.5]",
        "displacement",
        "Cb",
        "shell = { thickness = ",
        "draughts",
        "\"1:9:1\"",
        "nan",
        "inf",
        "transom_immersion",
        "'''",
        "\"\"\"",
        "\u{feff}",
        "\u{2032}",
        "\"3-4-5+\"",
        "figures",
        "ucl-cosh",
        "family",
        "project.",
        "1979-05-27",
    ];
    for _ in 0..20_000 {
        let _ = read("x.toml", &text(&mut random, &pieces));
    }
    let _ = read("x.toml", &"[".repeat(100_000));
    let _ = read("x.toml", &format!("a = {}", "[".repeat(100_000)));
    let _ = read("x.toml", &format!("a = {}", "{ b = ".repeat(100_000)));
    let _ = read("x.toml", &"a.".repeat(100_000));
}

#[test]
fn random_records_and_hulls_never_panic() {
    let mut random = StdRng::seed_from_u64(2);
    let pieces = [
        "Name",
        "LOA",
        "BOA",
        "D",
        "HullData",
        ",",
        "\n",
        "\"",
        " ",
        "1 2 3 4 5 6 7 8 9",
        "1e400",
        "-",
        "100",
        "ms_val",
        "loa_val",
        "\r\n",
        ";",
        "{\"format\": \"loftsman-hull\", \"version\": 1, ",
        "\"version\": 1",
        "\"surface\": {",
        "\"degree\": [3, 3]",
        "[[",
        "]]",
        "}",
        ":",
        "null",
        "\"knots\": [[0,0,1,1],[0,0,1,1]]",
        "1.5",
        "[",
        "{",
    ];
    for _ in 0..20_000 {
        let text = text(&mut random, &pieces);
        let _ = read_hgf(&text);
        let _ = read_hull(&text);
    }
    let _ = read_hull(&"[".repeat(1_000_000));
}

#[test]
fn random_quantities_and_lists_never_panic() {
    let mut random = StdRng::seed_from_u64(3);
    let pieces = [
        "1",
        "9",
        ":",
        ",",
        "...",
        "e",
        "E5",
        "-",
        "+",
        ".",
        "3-4-5",
        " ft",
        " in",
        "'",
        "\"",
        "5/8",
        "/",
        "0",
        " ",
        "m3",
        "t/m3",
        "%",
        "\u{2032}",
        "\u{b3}",
        "1e308",
        "mm",
        "deg",
        "\u{2026}",
        "99999999999",
    ];
    for _ in 0..100_000 {
        let text = text(&mut random, &pieces);
        if let Ok(measure) = parse(&text) {
            assert!(measure.value.is_finite(), "{text:?}");
        }
        if let Ok(list) = parse_list(&text) {
            assert!(list.len() <= 10_000 && list.iter().all(|x| x.is_finite()), "{text:?}");
        }
    }
}
