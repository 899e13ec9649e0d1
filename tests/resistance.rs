//! The command `resistance`: figures against published and closed ones, where inputs come from, warnings, refusals.

use serde_json::Value;

use crate::cli::config;
use crate::support::{carried, folder, json, names_in, program, stderr, stdout};

fn run(arguments: &[&str]) -> (i32, String, String) {
    let output = program(&[&["resistance"], arguments].concat());
    (output.status.code().unwrap(), stdout(&output), stderr(&output))
}

#[track_caller]
fn answer(arguments: &[&str]) -> (Value, String) {
    let (code, out, err) = run(&[arguments, &["--json"]].concat());
    assert_eq!(code, 0, "{err}");
    (json(out), err)
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

/// Knots of a Froude number on 100 m.
fn knots(froude: f64) -> String {
    format!("{}", froude * (9.80665f64 * 100.0).sqrt() * 3600.0 / 1852.0)
}

fn input<'a>(json: &'a Value, symbol: &str) -> &'a Value {
    let inputs = json["inputs"].as_array().unwrap();
    inputs.iter().find(|input| input["symbol"] == symbol).unwrap_or_else(|| panic!("{symbol}"))
}

/// All that the worked example of Holtrop and Mennen 1982 states, over a hull that has nothing to do with it.
#[test]
fn what_is_given_replaces_what_the_hull_has() {
    let hull = config("container-ship.toml");
    let (json, _) = answer(&[
        &hull,
        "--speeds",
        "25",
        "--method",
        "holtrop-1982",
        "--lwl",
        "205",
        "--breadth",
        "32",
        "--draught",
        "10",
        "--volume",
        "37500",
        "--lcb",
        "-0.75",
        "--cm",
        "0.98",
        "--cwp",
        "0.75",
        "--wetted-surface",
        "7381.45",
        "--half-angle",
        "12.08",
        "--transom-area",
        "16",
        "--bulb-area",
        "20",
        "--bulb-height",
        "4",
        "--stern",
        "U",
        "--appendage",
        "1.5=50",
        "--density",
        "1.025",
        "--viscosity",
        "1.18831e-6",
        "--propulsive-efficiency",
        "0.7",
    ]);
    let row = &json["rows"][0];
    for (key, expected, relative) in
        [("RF", 869.63e3, 1e-4), ("RW", 557.11e3, 1.5e-3), ("RA", 220.57e3, 1e-3), ("RT", 1793.26e3, 1e-3)]
    {
        assert!((number(&row[key]) / expected - 1.0).abs() < relative, "{key}: {}", row[key]);
    }
    assert!((number(&row["PE"]) / (number(&row["RT"]) * number(&row["V"])) - 1.0).abs() < 1e-12);
    assert!((number(&row["PD"]) * 0.7 / number(&row["PE"]) - 1.0).abs() < 1e-12);
    for symbol in ["L", "B", "T", "volume", "lcb", "C_M", "C_WP", "S", "i_E", "A_T", "A_BT", "h_B", "nu", "eta_D"] {
        assert_eq!(input(&json, symbol)["origin"], "given", "{symbol}");
    }
    assert_eq!(row["outside"].as_array().unwrap().len(), 0);
}

/// Wigley's hull of 100 m at Fn 0.3: 10^3 C_W = 2.141667 on S = 0.14879063 L^2.
#[test]
fn thin_ship_theory_has_its_reference() {
    let (json, err) = answer(&[&config("wigley.toml"), "--speeds", &knots(0.3), "--method", "michell"]);
    let row = &json["rows"][0];
    let speed = number(&row["V"]);
    let pressure = 0.5 * 1025.0 * speed * speed * 1487.9063;
    assert!((1e3 * number(&row["RW"]) / pressure / 2.141667 - 1.0).abs() < 1e-5, "{}", row["RW"]);
    assert!(json["limits"].as_str().unwrap().contains("slender hull, deep water, no sinkage"));
    assert!((number(&input(&json, "S")["value"]) - 1487.9063).abs() < 1e-3);
    assert_eq!(input(&json, "S")["origin"], "from the hull");
    assert_eq!(input(&json, "1+k1")["origin"], "assumed");
    assert!(err.contains("W513 ") && err.contains("State --form-factor"), "{err}");
    // L/2 is the centre of a hull that is symmetric.
    assert!(number(&input(&json, "lcb")["value"]).abs() < 1e-6);
    let given = answer(&[&config("wigley.toml"), "--speeds", "18", "--method", "michell", "--form-factor", "1.1"]);
    assert!(!given.1.contains("W513"), "{}", given.1);
}

#[test]
fn the_page_has_inputs_table_and_limits() {
    let hull = config("container-ship.toml");
    let (code, page, err) = run(&[&hull, "--speeds", "12:24:4", "--propulsive-efficiency", "0.7"]);
    assert_eq!(code, 0, "{err}");
    let words = [
        "from the hull",
        "assumed",
        "given",
        "holtrop-1984",
        "RF(1+k1)",
        "PD",
        "Int. Shipbuilding Progress 31 (1984)",
        "Regression of models",
    ];
    assert!(words.iter().all(|word| page.contains(word)), "{page}");
    let length = page.lines().find(|line| line.starts_with("LPP")).expect("a line of L_PP");
    assert!(length.contains("230.000 m") && length.contains("given; length between perpendiculars"), "{length}");
    let longest = page.lines().map(|line| line.chars().count()).max().unwrap();
    assert!(longest <= 100, "{longest}: {page}");
    let friction = run(&[&hull, "--speeds", "12", "--method", "ittc-57", "--form-factor", "1.2"]);
    assert!(friction.0 == 0 && friction.1.contains("no wave resistance"), "{}", friction.1);
}

#[test]
fn figures_outside_the_data_and_doubtful_hulls_are_warned_of() {
    // C_P 0.667, L/B 10, B/T 1.6 of Wigley's hull, and Fn 0.6.
    let (json, err) =
        answer(&[&config("wigley.toml"), "--speeds", &format!("10,{}", knots(0.6)), "--method", "holtrop-1982"]);
    assert!(err.contains("W510 ") && err.contains("Fn 0.600, data to 0.45") && err.contains("B/T"), "{err}");
    let outside = |row: usize| -> Vec<&str> {
        json["rows"][row]["outside"].as_array().unwrap().iter().map(|range| range["symbol"].as_str().unwrap()).collect()
    };
    assert_eq!((outside(0), outside(1)), (vec!["B/T"], vec!["Fn", "B/T"]));
    let page = run(&[&config("wigley.toml"), "--speeds", "10"]).1;
    assert!(page.contains("outside: B/T"), "{page}");
    // A full hull, and one with a rounded stem.
    let bulk = config("bulk-carrier.toml");
    let (_, err) = answer(&[&bulk, "--speeds", "14", "--method", "michell"]);
    assert!(err.contains("W512 ") && err.contains("is above 0.6"), "{err}");
    let (json, err) = answer(&[&config("ellipsoid.toml"), "--speeds", "5"]);
    assert!(err.contains("W511 ") && err.contains("State --half-angle"), "{err}");
    assert_eq!(input(&json, "i_E")["note"], "Holtrop 1982, from the dimensions");
}

#[test]
fn files_are_written_once_and_are_the_same_each_time() {
    let folder = folder("files");
    let out = |name: &str| folder.join(name).display().to_string();
    let hull = config("frigate.toml");
    let arguments =
        |out: &str| [hull.as_str(), "--speeds", "14:30:2", "-o", out, "--method", "holtrop-1984"].map(str::to_owned);
    let go = |out: &str, more: &[&str]| {
        let arguments = arguments(out);
        let list: Vec<&str> = arguments.iter().map(String::as_str).chain(more.iter().copied()).collect();
        run(&list)
    };
    assert_eq!(go(&out("a"), &[]).0, 0);
    assert_eq!(go(&out("b"), &[]).0, 0);
    let names = ["manifest.json", "resistance.csv", "resistance.json", "resistance.png", "resistance.svg"];
    assert_eq!(names_in(out("a")), names);
    for name in names {
        assert_eq!(
            std::fs::read(folder.join("a").join(name)).unwrap(),
            std::fs::read(folder.join("b").join(name)).unwrap()
        );
    }
    assert!(folder.read("a/resistance.csv").lines().count() == 11);
    let (code, _, err) = go(&out("a"), &[]);
    assert!(code == 6 && err.contains("E601"), "{err}");
    assert_eq!(go(&out("a"), &["--force", "--no-figures"]).0, 0);
    assert_eq!(names_in(out("a")), ["manifest.json", "resistance.csv", "resistance.json"]);
}

#[test]
fn bad_input_is_refused_with_its_remedy() {
    let hull = config("frigate.toml");
    for (arguments, words) in [
        (vec!["--speeds", "8m:16m:1m"], "plain numbers in knots"),
        (vec!["--speeds", "0"], "0.1 to 100 knots"),
        (vec!["--speeds", "10", "--method", "guess"], "holtrop-1984"),
        (vec!["--speeds", "10", "--appendage", "fin=3"], "rudder-behind-skeg"),
        (vec!["--speeds", "10", "--cm", "1.2"], "above 0 and up to 1"),
        (vec!["--speeds", "10", "--density", "1.5"], "0.9 to 1.3 t/m3"),
        (vec!["--speeds", "10", "--temperature", "60"], "0 to 30 degrees"),
        (vec!["--speeds", "10", "--draught", "99"], "--draught"),
        (vec![], "--speeds"),
    ] {
        let list: Vec<&str> = [hull.as_str()].into_iter().chain(arguments.iter().copied()).collect();
        let (code, out, err) = run(&list);
        assert!(code == 2 && out.is_empty() && err.contains(words), "{arguments:?}: {code} {err}");
    }
    let (code, _, err) = run(&[&config("box.toml"), "--speeds", "8"]);
    assert!(
        code == 3 && err.contains("E510 ") && err.contains("C_P is 1.0000; the formulas need 0.26 to 0.99"),
        "{err}"
    );
    // What no ship has, and speeds at which a method says more than the ship weighs.
    for (arguments, words) in [
        (vec!["--transom-area", "60"], "A_T is 60.0000"),
        (vec!["--bulb-area", "60", "--bulb-height", "3"], "A_BT is 60.0000"),
        (vec!["--wetted-surface", "100"], "S is 100.0000"),
        (vec!["--method", "michell", "--volume", "9000", "--draught", "6"], "C_B is 1.5"),
        (vec!["--draught", "0.05"], "R_T over the weight is"),
    ] {
        let wigley = config("wigley.toml");
        let list = [&[wigley.as_str(), "--speeds", "16"], arguments.as_slice()].concat();
        let (code, out, err) = run(&list);
        assert!(code == 3 && out.is_empty() && err.contains("E510 ") && err.contains(words), "{arguments:?}: {err}");
    }
    // A table that states no draught.
    let table = carried("tests/data/series60_cb060/offsets.csv").display().to_string();
    let (code, _, err) = run(&[&table, "--speeds", "16"]);
    assert!(code == 2 && err.contains("resistance needs a draught"), "{err}");
    let (code, _, err) = run(&[&table, "--speeds", "16", "--draught", "6.502"]);
    assert_eq!(code, 0, "{err}");
}
