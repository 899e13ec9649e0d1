//! Every message, provoked once.

use super::*;
use loftsman::internals::exchange::Severity;

/// What is wrong with a file, provoked once each: name, text, code, row (0: the whole file), part of the message.
fn faults() -> Vec<(&'static str, String, &'static str, usize, &'static str)> {
    let ghs = write_ghs(&ship());
    let bri = write_britfair(&ship());
    let pias = write_pias(&ship());
    let strip = write_pdstrip(&ship());
    let round = write_freeship(&ship());
    let without = |text: &str, lines: &[usize]| -> String {
        let kept = text.lines().enumerate().filter(|(i, _)| !lines.contains(&(i + 1)));
        kept.map(|(_, line)| format!("{line}\n")).collect()
    };
    let cut =
        |text: &str, lines: usize| -> String { text.lines().take(lines).map(|line| format!("{line}\n")).collect() };
    let row_of = |text: &str, line: &str| text.lines().position(|l| l.trim() == line).unwrap() + 1;
    let star = |mark: &str| row_of(&ghs, mark);
    vec![
        ("a.gf", ghs.replace("P:M", "metric"), "E326", 2, "KEY:value"),
        ("a.gf", ghs.replace("P:M", "XY:1"), "W334", 2, "'XY:' is not used"),
        ("a.gf", without(&ghs, &[star("*")]), "E324", star("**") - 1, "'*' should end"),
        ("a.gf", without(&ghs, &[star("**")]), "E322", 0, "number of sections should be a whole number"),
        ("a.gf", without(&ghs, &[star("***")]), "E324", star("****") - 1, "'***' should end the components"),
        ("a.gf", without(&ghs, &[star("****")]), "E324", star("****") - 1, "ends before '****'"),
        ("a.gf", cut(&ghs, 12), "E324", 12, "ends before '**'"),
        ("a.gf", ghs.replace("*\nHULL\n3", "*\nHULL\n4"), "E322", 0, "x and number of points expected (row"),
        ("a.gf", ghs.replace("*\nHULL\n3", "*\nHULL\n2"), "E322", 0, "number of sections expected, one number"),
        ("a.gf", ghs.replace("*\nHULL\n3", "*\nHULL\n3000000"), "E321", row_of(&ghs, "*") + 2, "beyond 1000000"),
        ("a.gf", ghs.replace("*\nHULL\n3", "*\nHULL\n999999"), "E322", 0, "expected"),
        ("a.gf", ghs.replace("-67.2572,6\n", "-67.2572,7\n"), "E322", 0, "should be a whole number"),
        ("a.gf", ghs.replace("HULL.C\n0\n", "HULL.C\nx\n"), "E321", star("**") + 2, "the side is not a number"),
        (
            "a.gf",
            ghs.replace("0\n1\n0,0,0\nHULL\n***", "0\n1\n0,0\nHULL\n***"),
            "E322",
            star("**") + 4,
            "offset x, y, z",
        ),
        ("a.gf", ghs.replace("1\nHULL.C\n****", "1\nHULL.X\n****"), "E326", star("***") + 1, "does not define"),
        ("a.gf", ghs.replace("0,0,0\nHULL\n***", "0,0,0\nHILL\n***"), "E326", star("**") + 1, "has a shape that"),
        (
            "a.gf",
            ghs.replace("1\nHULL.C\n****", "2\nHULL.C\n****"),
            "E322",
            0,
            "announces 2 components, the file has 1",
        ),
        ("a.gf", ghs.replace("0,0,0\n**\n", "1,0,0\n**\n"), "W334", star("**") - 1, "are not applied"),
        ("a.gf", "a\n*\n**\n***\n****\n".to_owned(), "E328", 0, "no shapes"),
        ("a.gf", format!("{}****\n", cut(&ghs, star("***"))), "E328", 0, "no parts"),
        ("a.bri", bri.replace("\n1\n", "\n2\n"), "W332", 2, "2 hulls; the first is read"),
        ("a.bri", bri.replace("\n1\n", "\none\n"), "E321", 2, "number of hulls is not a number"),
        ("a.bri", bri.replace("\n1\n", "\n1 2\n"), "E326", 2, "second line"),
        ("a.bri", bri.replace("4 0.000000 0.000000", "5 0.000000 0.000000"), "E322", 3, "announces 5 points, 4 there"),
        ("a.bri", bri.replace("4 0.000000 0.000000", "4 0.000000 0.500000"), "W334", 3, "x is written as 0 and as 0.5"),
        ("a.bri", without(&bri, &[8]), "E324", 8, "'0' should end the section of row 3"),
        ("a.bri", bri.replace("0 0 0\n", ""), "E324", 0, "without '0 0 0'"),
        ("a.bri", bri.replace("3.500000 6.000000", "3,5 6.000000"), "E321", 6, "y is not a number. Write 3.5"),
        (
            "a.bri",
            bri.replace("3.500000 6.000000", "-3.500000 6.000000")
                .replace("3.500000 7", "-3.500000 7")
                .replace("3.000000 4", "-3.000000 4")
                .replace("0.000000 4.000000\n-", "-1 4\n-"),
            "E325",
            3,
            "4 of 4 half-breadths are negative. Give the side with positive y",
        ),
        ("a.bri", bri.replace("\n0 0 0\n", "\n0 0 0\nmore\n"), "W332", 0, "what follows"),
        ("a.bri", bri.replace("5 20.500000 20.500000", "5 20.500000"), "E326", 9, "begins with its number of points"),
        ("a.bri", "name\n".to_owned(), "E324", 0, "ends after its name"),
        ("a.pias", pias.replacen('3', "4", 1), "E322", 1, "announces 4 sections, 3 there"),
        ("a.pias", pias.replacen("     4\n", "     9\n", 1), "E322", 2, "announces 9 points, 4 there"),
        (
            "a.pias",
            pias.replacen("3.5000   6.0000     1", "3.5000   6.0000", 1),
            "E322",
            6,
            "a point is y, z and a flag",
        ),
        (
            "a.pias",
            pias.replacen("3.5000   6.0000     1", "-3.5000   6.0000     1", 1),
            "E325",
            2,
            "1 of 4 half-breadths are negative",
        ),
        ("a.pias", pias.replacen("3.5000   6.0000     1", "-0.0001   6.0000     1", 1), "W335", 2, "taken as 0"),
        ("a.pias", pias.clone(), "W334", 0, "read as knuckles"),
        ("a.pias", without(&pias, &[8]), "E326", 0, "a line with x and one with the number of points"),
        ("a.pias", pias.replace(" 20.5000\n", " 50.5000\n"), "E323", 15, "x = 41 m after 50.5 m"),
        ("a.pias", pias.replace(" 20.5000\n", " 41.0000\n"), "E323", 15, "two sections at x = 41 m"),
        ("a.pias", cut(&pias, 7).replacen('3', "1", 1), "E328", 0, "only 1 section"),
        ("geomet.out", strip.replacen('3', "2", 1), "E322", 1, "announces 2 sections, 3 there"),
        (
            "geomet.out",
            strip.replace("0.0000 4 0", "0.0000 5 0"),
            "E322",
            4,
            "5 points announced in row 2, the lines of y hold 8",
        ),
        ("geomet.out", strip.replace("0.0000 4 0", "0.0000 3 0"), "E322", 3, "hold 4"),
        ("geomet.out", strip.replace("0.0000 4 0", "0.0000 999999 0"), "E322", 0, "the file ends after"),
        ("geomet.out", strip.replace("0.0000 4 0", "0.0000 4"), "E326", 2, "number of gaps expected"),
        ("geomet.out", strip.replace("0.0000 4 0", "0.0000 4 1"), "E322", 2, "1 gaps announced, 0 given"),
        ("geomet.out", strip.replacen(" t ", " f ", 1), "W331", 0, "sections give both sides"),
        ("geomet.out", "2 f 1\n0 2 0\n 0 0\n 0 1\n9 2 0\n 0 1\n 0 1\n".to_owned(), "E328", 2, "both sides expected"),
        ("a.seaway", SEAWAY.replace("\n2\n11.0", "\n5000\n11.0"), "E322", 4, "5000 intervals announced"),
        ("a.seaway", SEAWAY.replace("-1 2 0.0", "-1 400 0.0"), "E322", 7, "section 1 announces 401 points"),
        ("a.seaway", SEAWAY.replace("-1 2 0.0", "-1 3 0.0"), "E322", 10, "the last of them within a line"),
        ("a.seaway", SEAWAY.replace("*** End of file ***\n", ""), "E324", 15, "without a line of stars"),
        ("a.seaway", cut(SEAWAY, 5), "E324", 5, "the file ends before"),
        ("a.seaway", SEAWAY.replace("3.0 0.0 20.0 1.0", "3.0 0.5 20.0 1.0"), "W334", 3, "trim 0.5 m is not applied"),
        ("a.seaway", SEAWAY.replace("1.0 1.0 1.0", "1.0 1.0 1.0\n7"), "E322", 16, "1 numbers after the three factors"),
        ("a.txt", round.replacen("6.00000", "6,00000", 1), "E321", 4, "z is not a number. Write 6.00000"),
        (
            "a.txt",
            round.replacen("        20.50000         6.25000", "        21.50000         6.25000", 1),
            "E323",
            7,
            "the section runs from x = 20.5 to 21.5 m",
        ),
        (
            "a.txt",
            round.replacen("         3.50000         6.00000", "         3.50000", 1),
            "E326",
            4,
            "2 fields; a point is x, y, z",
        ),
        ("chines.txt", CHINES.replace("9 0.5 0.8", "4 0.5 0.8"), "E323", 6, "chine 2: x = 4 m after 5 m"),
        ("chines.txt", CHINES.to_owned(), "W334", 0, "3 chines"),
        ("a.txt", DELFTSHIP.replacen('3', "4", 1), "E322", 1, "numbers after the head"),
        ("a.txt", DELFTSHIP.replace("10.0\n3.0", "10.0\n-3.0"), "E327", 10, "the draught is -3 m"),
        ("a.txt", DELFTSHIP.replace("2.5 3.5 4.25", "-2.5 3.5 4.25"), "E325", 14, "negative"),
        ("a.txt", DELFTSHIP.replace("0 10 30 40", "0 30 10 40"), "E323", 11, "10 after 30"),
        ("a.txt", DELFTSHIP.replace("2.5 3.5 4.25", "2.5 3,5 4.25"), "E321", 14, "Write 3.5"),
        ("ratio.csv", FRACTIONS.replace("# L = 40 m, B = 32 ft, T = 3.0", "# B = 32 ft"), "E327", 0, "L (Lpp), T"),
        ("ratio.csv", FRACTIONS.replace("B = 32 ft", "B = 32 leagues"), "E321", 2, ""),
        ("ratio.csv", FRACTIONS.replace("station 0 = AP", "station 0 = stern"), "E326", 3, "station 0 is AP or FP"),
        ("ratio.csv", FRACTIONS.replace("# station 0 = AP, 10 = FP\n", ""), "W334", 0, "taken as FP"),
        (
            "ratio.csv",
            FRACTIONS.replace("max,0.8,0.9,1,\n", "").replace("# a small", "# y / ymax of a small"),
            "E326",
            0,
            "no row of maxima",
        ),
        (
            "ratio.csv",
            FRACTIONS.replace("max,0.8,0.9,1,\n", "").replace("# a small", "# y/(B/2) of a small"),
            "W334",
            0,
            "fractions are of B/2",
        ),
        ("ratio.csv", FRACTIONS.replace("max,0.8,0.9,1,\n", "max,0.8,0.9\n"), "E322", 8, "shorter than the head"),
        ("ratio.csv", format!("{FRACTIONS}max,1,1,1,\n"), "E326", 9, "a second row of maxima"),
        ("ratio.csv", FRACTIONS.replace("5,0.5,0.9,1,1", "5,0.5,9,1,1"), "W335", 6, "above 1"),
        ("ratio.csv", FRACTIONS.replace("5,0.5,0.9,1,1", "5,0.5,-0.9,1,1"), "E325", 6, "negative"),
        ("ratio.csv", FRACTIONS.replace("5,0.5,0.9,1,1", "5,0.5,0.9"), "E322", 6, "3 cells, the head has 5"),
        ("ratio.csv", FRACTIONS.replace("5,0.5,0.9,1,1", "15,0.5,0.9,1,1"), "E323", 7, "station 10 after 15"),
        ("ratio.csv", FRACTIONS.replace("wl0.5,wl1", "wl1,wl0.5"), "E323", 4, "waterline at 1.5 m after 3 m"),
        ("ratio.csv", FRACTIONS.replace("wl0.5,wl1", "wl1,wl7"), "E326", 4, "7 times the draught"),
        ("ratio.csv", FRACTIONS.replace("wl0.5,wl1", "low,wl1"), "E326", 4, "a column is a waterline"),
        ("ratio.csv", FRACTIONS.replace("# a small ship", "# waterline k at z = k*x/0"), "E326", 1, "k times numbers"),
        ("ratio.csv", FRACTIONS.to_owned(), "W332", 4, "'area' is not used"),
        ("points.csv", POINTS.replace("x_from_AP_m,", "station,"), "E326", 1, "the head has no column x"),
        ("points.csv", POINTS.replace("y_mm", "y_normalised"), "E326", 1, "a column is station, x"),
        ("points.csv", POINTS.replace("loop,point", "point,point"), "E326", 1, "a second column"),
        ("points.csv", POINTS.replace("0,0,1,1500,1000", "0,0,1,1500"), "E322", 3, "4 fields, the head has 5"),
        (
            "points.csv",
            POINTS.replace("0,0,1,1500,1000", "0,0,1,-1500,1000"),
            "E325",
            2,
            "1 of 3 half-breadths are negative",
        ),
        ("points.csv", POINTS.replace("20,0,1,2000", "21,0,1,2000"), "E323", 0, "out of order"),
        (
            "markers.txt",
            MARKERS.replace("2\t20\t3", "2\t21\t3"),
            "E323",
            5,
            "station 2: x = 21 m here and 20 m in row 4",
        ),
        ("markers.txt", MARKERS.replace("2\t20\t3\t3", "2\t20\tx\t3"), "E321", 5, "'x': y is not a number"),
    ]
}

#[test]
fn every_message() {
    let mut missing = Vec::new();
    for (name, text, code, row, part) in faults() {
        let problems = match read_table(name, text.as_bytes()) {
            Ok(read) => {
                if code.starts_with('E') {
                    missing.push(format!("{name} {code} '{part}': was read\n{text}"));
                    continue;
                }
                read.notes
            }
            Err(problems) => problems,
        };
        let hit = problems.iter().any(|p| {
            p.code == code && p.to_string().contains(part) && (row == 0 || p.row == Some(row)) && p.file == name
        });
        if !hit {
            missing.push(format!("{name} {code} row {row} '{part}' not in:\n{}", list(&problems)));
        }
        // Errors by their rows; what was noticed beside them comes after them.
        let refused = problems.iter().any(|p| p.severity == Severity::Error);
        let order = |p: &TableProblem| (if refused { p.severity } else { Severity::Note }, p.row.unwrap_or(0));
        assert!(problems.iter().map(order).is_sorted(), "{}", list(&problems));
    }
    assert!(missing.is_empty(), "{}", missing.join("\n\n"));
}

#[test]
fn all_problems_of_a_file_at_once() {
    let text = write_pias(&ship())
        .replacen("     4\n", "     9\n", 1)
        .replacen("3.5000   6.0000     1", "3.5x00   6,0000     1", 1)
        .replacen("6.2500   4.0000     1", "-6.2500   4.0000     1", 1);
    let problems = read_table("a.pias", text.as_bytes()).unwrap_err();
    let places: Vec<_> =
        problems.iter().filter(|p| p.severity == Severity::Error).map(|p| (p.code, p.row, p.column)).collect();
    let expected =
        [("E322", Some(2), None), ("E321", Some(6), Some(1)), ("E321", Some(6), Some(2)), ("E325", Some(8), None)];
    assert_eq!(places, expected, "{}", list(&problems));
}
