use super::super::read_table;
use super::along::SECTIONS;

/// An IGES file of curves of degree 1 through points (entity 126), in metres.
fn iges(curves: &[Vec<[f64; 3]>]) -> String {
    let mut text = String::new();
    let mut line = |body: &str, letter: char, number: usize| text.push_str(&format!("{body:<72}{letter}{number:>7}\n"));
    line("curves", 'S', 1);
    line("1H,,1H;,4Htest,4Htest,4Htest,4Htest,32,38,6,308,15,4Htest,1.,6,1HM,1,0.,", 'G', 1);
    line("15H19700101.000000,1E-6,100.,4Htest,4Htest,11,0,15H19700101.000000;", 'G', 2);
    let (mut directory, mut parameters) = (Vec::new(), Vec::new());
    for (k, points) in curves.iter().enumerate() {
        let n = points.len();
        let mut words = vec!["126".to_owned(), (n - 1).to_string(), "1".to_owned()];
        words.extend(["0", "0", "1", "0", "0."].map(str::to_owned));
        words.extend((0..n).map(|k| format!("{k}.")));
        words.push(format!("{}.", n - 1));
        words.extend(std::iter::repeat_n("1.".to_owned(), n));
        words.extend(points.iter().flatten().map(|c| format!("{c:?}")));
        words.extend(["0.".to_owned(), format!("{}.", n - 1), "0.".to_owned(), "0.".to_owned(), "0.".to_owned()]);
        let first = parameters.len() + 1;
        let own = 2 * k + 1;
        for (i, chunk) in words.chunks(4).enumerate() {
            let end = if 4 * (i + 1) >= words.len() { ";" } else { "," };
            parameters.push(format!("{:<64}{own:>8}", chunk.join(",") + end));
        }
        let count = parameters.len() + 1 - first;
        directory.push(format!("{:>8}{first:>8}{}", 126, format!("{:>8}", 0).repeat(7)));
        directory.push(format!("{:>8}{:>8}{:>8}{count:>8}{:>8}", 126, 0, 0, 0));
    }
    directory.iter().enumerate().for_each(|(k, body)| line(body, 'D', k + 1));
    parameters.iter().enumerate().for_each(|(k, body)| line(body, 'P', k + 1));
    line(&format!("S{:>7}G{:>7}D{:>7}P{:>7}", 1, 2, directory.len(), parameters.len()), 'T', 1);
    text
}

/// A point of a wedge: y = (1 - x/20)(1 + z).
fn wedge(x: f64, z: f64) -> [f64; 3] {
    [x, (1.0 - x / 20.0) * (1.0 + z), z]
}

#[test]
fn curves_at_one_x_are_sections() {
    let mut curves: Vec<Vec<[f64; 3]>> =
        (0..5).map(|i| (0..4).rev().map(|j| wedge(4.0 * f64::from(i), f64::from(j))).collect()).collect();
    // Port of one section, and a deck line.
    curves.push(curves[0].iter().map(|&[x, y, z]| [x, -y, z]).collect());
    curves.push((0..5).map(|i| wedge(4.0 * f64::from(i), 3.0 + 0.01 * f64::from(i))).collect());
    let read = read_table("a.igs", iges(&curves).as_bytes()).unwrap();
    let said = read.notes.iter().map(ToString::to_string).collect::<String>();
    assert!(said.contains("7 curves (IGES) without surfaces") && said.contains("left out: 1 curve,"), "{said}");
    assert_eq!(read.table.stations.len(), 5);
    for (i, station) in read.table.stations.iter().enumerate() {
        assert_eq!(station.outlines.len(), 1);
        assert!((station.station.x - 4.0 * i as f64).abs() < 1e-12);
        for p in &station.outlines[0] {
            assert!((p.y - wedge(station.station.x, p.z)[1]).abs() < 1e-9);
        }
        assert!(station.outlines[0][0].z < 1e-12);
    }
}

#[test]
fn waterlines_alone_make_sections() {
    let curves: Vec<Vec<[f64; 3]>> =
        (0..4).map(|j| (0..6).map(|i| wedge(4.0 * f64::from(i), f64::from(j))).collect()).collect();
    let read = read_table("a.igs", iges(&curves).as_bytes()).unwrap();
    assert!(read.notes.iter().any(|note| note.code == "W334"));
    assert_eq!(read.table.stations.len(), SECTIONS + 1);
    for station in &read.table.stations {
        assert_eq!(station.outlines[0].len(), 4);
        assert!(station.outlines[0].iter().all(|p| (p.y - wedge(station.station.x, p.z)[1]).abs() < 1e-9));
    }
}

#[test]
fn other_curves_are_refused_with_their_numbers() {
    let deck: Vec<[f64; 3]> = (0..6).map(|i| wedge(4.0 * f64::from(i), 3.0 + 0.1 * f64::from(i * i))).collect();
    let text = iges(&[deck]);
    let problems = read_table("a.igs", text.as_bytes()).unwrap_err();
    assert!(problems.iter().any(|p| p.code == "E328" && p.message.contains("1 curve: 0 at one x")), "{problems:?}");
    // A weight of zero names its entity.
    let faulty = text.replacen("1.,1.,1.,1.", "0.,1.,1.,1.", 1);
    assert_ne!(faulty, text);
    let problems = read_table("a.igs", faulty.as_bytes()).unwrap_err();
    assert!(problems.iter().any(|p| p.code == "E350" && p.found.contains("entity 126, D1")), "{problems:?}");
}

/// A DXF file of 3D polylines on layers, with the group codes of R12.
fn dxf(curves: &[(&str, Vec<[f64; 3]>)]) -> String {
    let mut text = "  0\nSECTION\n  2\nENTITIES\n".to_owned();
    for (layer, points) in curves {
        text.push_str(&format!("  0\nPOLYLINE\n  8\n{layer}\n 66\n1\n 70\n8\n"));
        for [x, y, z] in points {
            text.push_str(&format!("  0\nVERTEX\n  8\n{layer}\n 10\n{x:?}\n 20\n{y:?}\n 30\n{z:?}\n 70\n32\n"));
        }
        text.push_str("  0\nSEQEND\n");
    }
    text + "  0\nENDSEC\n  0\nEOF\n"
}

fn said(read: &super::super::ReadTable) -> String {
    read.notes.iter().map(|note| format!("{note}\n")).collect()
}

/// Five sections of the wedge.
fn stations() -> Vec<(&'static str, Vec<[f64; 3]>)> {
    (0..5).map(|i| ("FRAMES", (0..4).map(|j| wedge(3.0 * f64::from(i), f64::from(j))).collect())).collect()
}

#[test]
fn layers_are_chosen_and_what_is_left_out_is_named() {
    let mut curves = stations();
    curves.push(("BUTTOCKS", (0..5).map(|i| [3.0 * f64::from(i), 0.5, 0.1 * f64::from(i)]).collect()));
    curves.push(("HOUSE", vec![[1.5, 0.0, 5.0], [1.5, 1.0, 5.0], [1.5, 1.0, 7.0]]));
    let text = dxf(&curves);
    let read = read_table("a.dxf", text.as_bytes()).unwrap();
    assert_eq!(read.table.stations.len(), 6);
    assert!(said(&read).contains("W320") && said(&read).contains("states no unit of length"), "{}", said(&read));
    assert!(
        said(&read).contains("W332 a.dxf: left out: 1 curve, in no plane of a section (BUTTOCKS 1)"),
        "{}",
        said(&read)
    );
    let chosen = [("a.toml", "[table]\nunits = \"m\"\nparts = \"frames\"\n")];
    let read = super::super::read_table_with("a.dxf", text.as_bytes(), chosen).unwrap();
    assert_eq!(read.table.stations.len(), 5);
    assert!(!said(&read).contains("no unit of length"), "{}", said(&read));
    let unknown = [("a.toml", "[table]\nparts = \"hull\"\n")];
    let problems = super::super::read_table_with("a.dxf", text.as_bytes(), unknown).unwrap_err();
    assert!(problems.iter().any(|p| p.code == "E311" && p.remedy.contains("BUTTOCKS, FRAMES, HOUSE")), "{problems:?}");
}

#[test]
fn pieces_of_a_section_are_one_line() {
    let mut curves = Vec::new();
    for (layer, points) in stations() {
        for pair in points.windows(2) {
            // Pieces in either direction, twice, and those of the other side.
            curves.push((layer, vec![pair[1], pair[0]]));
            curves.push((layer, pair.to_vec()));
            curves.push((layer, pair.iter().map(|&[x, y, z]| [x, -y, z]).collect()));
        }
    }
    let read = read_table("a.dxf", dxf(&curves).as_bytes()).unwrap();
    assert!(said(&read).contains("5 sections give both sides, which are alike"), "{}", said(&read));
    for station in &read.table.stations {
        assert_eq!((station.outlines.len(), station.outlines[0].len()), (1, 4));
    }
    // A side that differs is told of with how far.
    for (_, points) in &mut curves {
        points.iter_mut().filter(|p| p[1] < 0.0).for_each(|p| p[1] -= 0.1);
    }
    let read = read_table("a.dxf", dxf(&curves).as_bytes()).unwrap();
    assert!(said(&read).contains("W331") && said(&read).contains("differ by up to 0.1"), "{}", said(&read));
}

#[test]
fn views_of_a_drawing_are_refused() {
    let flat: Vec<(&str, Vec<[f64; 3]>)> = (0..5)
        .map(|i| {
            ("BODY", (0..4).map(|j| wedge(4.0 * f64::from(i), f64::from(j))).map(|[_, y, z]| [y, z, 0.0]).collect())
        })
        .collect();
    let problems = read_table("a.dxf", dxf(&flat).as_bytes()).unwrap_err();
    assert!(problems.iter().any(|p| p.code == "E328" && p.message.contains("one plane, z = 0")), "{problems:?}");
}

#[test]
fn waterlines_close_the_ends_of_stations() {
    // y = (1 - (x/10)^2)(1 + z)/4 from a stern at -10 to a stem at 10, both upright.
    let at = |x: f64, z: f64| [x, 0.25 * (1.0 - x * x / 100.0) * (1.0 + z), z];
    let mut curves: Vec<(&str, Vec<[f64; 3]>)> = (-4..=4)
        .map(|i| 2.0 * f64::from(i))
        .map(|x| ("STATIONS", (0..4).map(|j| at(x, f64::from(j))).collect()))
        .collect();
    let lines = (0..4).map(|j| ("WATERLINES", (-20..=20).map(|i| at(0.5 * f64::from(i), f64::from(j))).collect()));
    curves.extend(lines);
    curves.push(("STEM", vec![[10.0, 0.0, 0.0], [10.0, 0.0, 3.0]]));
    let read = read_table("a.dxf", dxf(&curves).as_bytes()).unwrap();
    assert!(said(&read).contains("10 sections between the outermost ones and the ends"), "{}", said(&read));
    let stations = &read.table.stations;
    assert_eq!(stations.len(), 9 + 2 * 6);
    let shift = 10.0;
    for station in stations {
        for p in &station.outlines[0] {
            let y = at(station.station.x - shift, p.z)[1];
            assert!((p.y - y).abs() < 1e-3, "{} {} {} {y}", station.station.x, p.z, p.y);
        }
    }
}
