//! What `fair` refuses: options with exit code 2, files with 3, with the place of each.

use std::fs;
use std::path::Path;

use loftsman::internals::report::{fair_outputs, read_fair};

use crate::fair::{TABLE, YACHT, answer_to_job};
use crate::support::{carried, folder, program, stderr};

#[test]
fn a_length_that_is_none_of_the_hull_is_refused() {
    let path = folder("length");
    fs::write(path.join("j.toml"), format!("table.file = {:?}\n[dimensions]\nLpp = 1e-30\n", carried(TABLE))).unwrap();
    let refused = fair_outputs(&read_fair(&path.join("j.toml"), &[]).unwrap(), false).err().unwrap().to_string();
    assert!(refused.contains("E175") && refused.contains("L_PP of 1e-30 m does not go with stations"), "{refused}");
}

/// A target beyond all measure does not vanish beside its row, nor does a tolerance beyond all measure spoil the answer.
#[test]
fn absurd_numbers_are_not_taken_for_an_answer() {
    let folder = folder("absurd");
    let table = carried(TABLE).display().to_string();
    let run = |name: &str, option: &str, value: &str| {
        let out = folder.join(name).display().to_string();
        let options = if option == "--draught" { &[][..] } else { &["--draught", "6.828"] };
        program(&[&["fair", &table, "-o", &out, option, value, "--no-figures"][..], options].concat())
    };
    let output = run("1e9", "--displacement", "1e9");
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    let output = run("wide", "--tolerance", "1e9");
    assert!(output.status.success(), "{}", stderr(&output));
    for (option, value, code) in [
        ("--weight", "1e300", "E124"),
        ("--tolerance", "0", "E124"),
        ("--displacement", "1e15", "E124"),
        ("--draught", "100 m", "E175"),
    ] {
        let output = run("refused", option, value);
        assert_eq!(output.status.code(), Some(2), "{option}: {}", stderr(&output));
        assert!(stderr(&output).contains(code), "{option}: {}", stderr(&output));
    }
}

#[test]
fn rules_and_lines_that_the_hull_does_not_have_are_refused() {
    let folder = folder("refused");
    let table = carried(TABLE).display().to_string();
    let out = folder.join("out").display().to_string();
    let output = program(&["fair", &table, "-o", &out, "--accept-lines", "L9", "--no-figures"]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("E180") && stderr(&output).contains("L9 is not proposed"), "{}", stderr(&output));
    // The parent of Series 60 is rounded at the ends: no flat of bottom in the last metre.
    let job = folder.join("job.toml");
    fs::write(&job, format!("schema = 1\n[table]\nfile = {table:?}\n[flat]\nbottom = [\"stations 0 to 1\"]\n"))
        .unwrap();
    let output = program(&["fair", job.to_str().unwrap(), "-o", &out, "--no-figures"]);
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    assert!(stderr(&output).contains("E176") && stderr(&output).contains("no flat of bottom"), "{}", stderr(&output));
    assert!(!Path::new(&out).exists());
}

/// Messages name the line of the job that asks for what is refused, or the option.
#[test]
fn refusals_name_the_line_of_the_job() {
    let folder = folder("places");
    let refused = [
        (TABLE, "[lines]\naccept = [\"L9\"]\n", [].as_slice(), "E180 job.toml:4:10 lines.accept: L9 is not proposed"),
        (TABLE, "", &["--accept-lines", "L9"], "E180 --accept-lines lines.accept: L9 is not proposed"),
        (
            YACHT,
            "[lines]\ntangent = [\n\"waterline 0.1\"]\n",
            &[],
            "E180 job.toml:5:1 lines.tangent: the waterline at 0.1 m cannot",
        ),
        (TABLE, "[dimensions]\nT = 50\n", &[], "E175 job.toml:4:5 dimensions.T: the design draught of 50.000 m"),
        (TABLE, "[dimensions]\nT = 6\nD = 1\n", &[], "E175 job.toml:4:5 dimensions.T: the design draught of 6.000 m"),
        (TABLE, "[dimensions]\nB = 1\n", &[], "E175 job.toml:4:5 dimensions.B: half-breadths up to"),
        (TABLE, "", &["--draught", "50"], "E175 --draught dimensions.T: the design draught of 50.000 m"),
    ];
    for (table, text, options, expected) in refused {
        let (code, said) = answer_to_job(&folder, table, text, options);
        let of_file = if options.is_empty() { 3 } else { 2 };
        assert!(code == Some(of_file) && said.contains(expected), "{expected}: {said}");
    }
}

/// Options that were removed and their keys name the dial that serves instead, wherever they stand.
#[test]
fn what_was_removed_names_the_dial() {
    let path = folder("removed");
    let (table, out) = (carried(TABLE).display().to_string(), path.join("out").display().to_string());
    for option in [
        &["--order", "4"][..],
        &["--anisotropy", "1"],
        &["--allow-inflections"],
        &["--no-signs"],
        &["--true-curvature"],
        &["--exact-bending-energy"],
        &["--bending"],
    ] {
        let output = program(&[&["fair"], option, &[&table, "-o", &out, "--no-figures"]].concat());
        let (code, said) = (output.status.code(), stderr(&output));
        let expected = format!("E701 command line {} was removed: --fairness serves instead", option[0]);
        assert!(code == Some(2) && said.starts_with(&expected), "{code:?} {said}");
    }
    for (table_key, keys) in [
        ("energy", &["order = 4", "anisotropy = 1", "true_curvature = true", "exact_bending = true"][..]),
        ("inflections", &["remove = false"]),
    ] {
        for key in keys {
            let job = path.write("job.toml", format!("[table]\nfile = {table:?}\n[{table_key}]\n{key}\n"));
            let output = program(&["fair", &job, "-o", &out, "--no-figures"]);
            let (code, said) = (output.status.code(), stderr(&output));
            let name = key.split(' ').next().unwrap();
            let expected = format!("job.toml:4:1 {table_key}.{name} was removed. Give fairness instead: ");
            assert!(code == Some(3) && said.contains("E121") && said.contains(&expected), "{code:?} {said}");
        }
    }
    assert!(!path.join("out").exists());
}

#[test]
fn a_job_file_is_told_all_that_is_wrong_with_it() {
    let path = folder("messages");
    let job = path.join("job.toml");
    fs::write(&job, "[table]\nfile = \"nothing.csv\"\n[hold]\nCbb = 0.6\nLCB = 1\n[lock]\ncells = [3]\n").unwrap();
    let output = program(&["fair", job.to_str().unwrap(), "-o", path.join("out").to_str().unwrap(), "--cm", "2"]);
    assert_eq!(output.status.code(), Some(3));
    let said = stderr(&output);
    for (line, words) in
        [(4, "hold.Cbb is not a key of a job. Did you mean Cb?"), (5, "its unit is missing"), (7, "\"3\" is no cell")]
    {
        assert!(said.contains(&format!("job.toml:{line}:")) && said.contains(words), "{words}: {said}");
    }
    assert!(said.contains("--cm hold.Cm is 2"), "{said}");
    fs::write(&job, format!("[table]\nfile = {:?}\n[lock]\nstations = [\"99\"]\n", carried(TABLE))).unwrap();
    let output = program(&["fair", job.to_str().unwrap(), "-o", path.join("out").to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(3));
    assert!(stderr(&output).contains("E171") && stderr(&output).contains("job.toml:4:13"), "{}", stderr(&output));
    fs::write(&job, "[table]\nfile = \"nothing.csv\"\n").unwrap();
    assert_eq!(program(&["fair", job.to_str().unwrap()]).status.code(), Some(6));
    fs::write(&job, "[energy]\nweight = 3\n").unwrap();
    let output = program(&["fair", job.to_str().unwrap()]);
    assert!(output.status.code() == Some(3) && stderr(&output).contains("E174"), "{}", stderr(&output));
}
