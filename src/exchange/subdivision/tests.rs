use super::*;

fn small() -> SubdivisionProject {
    let point = |x: f64, y: f64, z: f64, kind| ([x, y, z], kind);
    use NetPointKind::{Corner, Crease, Dart, Regular};
    SubdivisionProject {
        name: "small \\ boat\nsecond line".to_owned(),
        stated: StatedParticulars {
            length_between_perpendiculars: Some(10.0),
            breadth: Some(3.0),
            draught: Some(1.1),
            depth: None,
        },
        unit: 1.0,
        net: SubdivisionNet {
            points: vec![
                point(0.0, 0.0, 0.0, Corner),
                point(10.0 / 3.0, 0.0, -0.1, Crease),
                point(10.0, 1.0, 2.0, Dart),
                point(1.0e-7, 1.5, 2.0, Regular),
                point(5.0, 1.5, 2.5, Corner),
            ],
            edges: vec![
                NetEdge { ends: [0, 1], crease: true },
                NetEdge { ends: [1, 2], crease: false },
                NetEdge { ends: [2, 3], crease: false },
                NetEdge { ends: [3, 0], crease: true },
            ],
            faces: vec![NetFace { corners: vec![0, 1, 2, 3], layer: 0 }, NetFace { corners: vec![2, 4, 3], layer: 1 }],
            layers: vec![
                NetLayer { name: "side".to_owned(), colour: 255, symmetric: true, in_hydrostatics: true },
                NetLayer { name: "deck".to_owned(), colour: 0xFF_00FF, symmetric: true, in_hydrostatics: false },
            ],
        },
    }
}

#[test]
fn what_is_written_is_read_back() {
    let project = small();
    let text = write_ftm(&project);
    assert!(is_ftm(text.as_bytes()));
    assert_eq!(read_ftm(text.as_bytes()).unwrap(), project);
    let feet = SubdivisionProject { unit: FOOT, ..project };
    let back = read_ftm(write_ftm(&feet).as_bytes()).unwrap();
    assert_eq!(back.net, feet.net);
    assert!((back.stated.breadth.unwrap() - 3.0).abs() < 1e-14 && (back.unit - FOOT).abs() < 1e-15);
}

/// The records of a text as the binary file has them.
fn binary(text: &str) -> Vec<u8> {
    let mut bytes = b"\x09\0\0\0FREE!ship\x0f".to_vec();
    let all: Vec<&str> = text.lines().skip(2).collect();
    let mut at = 0;
    let mut put = |bytes: &mut Vec<u8>, kinds: &str| {
        for kind in kinds.chars() {
            let line = all[at];
            at += 1;
            match kind {
                'i' => bytes.extend(line.parse::<i32>().unwrap().to_le_bytes()),
                'f' => bytes.extend(line.parse::<f32>().unwrap().to_le_bytes()),
                'b' => bytes.push(line.parse::<u8>().unwrap()),
                'p' => line.split(' ').for_each(|w| bytes.extend(w.parse::<f32>().unwrap().to_le_bytes())),
                _ => {
                    let line = unescape(line);
                    bytes.extend(i32::try_from(line.len()).unwrap().to_le_bytes());
                    bytes.extend(line.as_bytes());
                }
            }
        }
    };
    put(&mut bytes, "iibbbbbbbbbbfb");
    put(&mut bytes, "ssfffbffbiibfbss");
    put(&mut bytes, "i");
    for _ in 0..2 {
        put(&mut bytes, "siibbbbbffb");
    }
    put(&mut bytes, "ii");
    for _ in 0..5 {
        put(&mut bytes, "pibb");
    }
    put(&mut bytes, "i");
    for _ in 0..4 {
        put(&mut bytes, "iibb");
    }
    put(&mut bytes, "iiiiiiiibiiiiib");
    bytes
}

fn unescape(line: &str) -> String {
    line.replace("\\n", "\n").replace("\\\\", "\\")
}

#[test]
fn the_binary_file_has_the_same_records() {
    let project = small();
    let bytes = binary(&write_ftm(&project));
    assert!(is_fbm(&bytes));
    let read = read_fbm(&bytes).unwrap();
    assert_eq!(
        (&read.net.edges, &read.net.faces, &read.net.layers),
        (&project.net.edges, &project.net.faces, &project.net.layers)
    );
    assert_eq!(read.name, project.name);
    for ((a, kind), (b, other)) in read.net.points.iter().zip(&project.net.points) {
        assert_eq!(kind, other);
        assert!((0..3).all(|k| (a[k] - b[k]).abs() <= 1e-6 * b[k].abs()), "{a:?} {b:?}");
    }
    // Cut anywhere, the record is named.
    for length in 13..bytes.len() - 1 {
        let faults = read_fbm(&bytes[..length]).unwrap_err();
        assert!(faults.iter().any(|fault| fault.message.contains("follow")), "{length}: {faults:?}");
    }
}

#[test]
fn faults_name_their_line() {
    let text = write_ftm(&small());
    let fault = |text: &str| {
        let list = read_ftm(text.as_bytes()).unwrap_err();
        assert_eq!(list.len(), 1, "{list:?}");
        (list[0].line, list[0].message.clone())
    };
    let lines: Vec<&str> = text.lines().collect();
    let changed = |at: usize, new: &str| {
        let mut lines = lines.clone();
        lines[at - 1] = new;
        lines.join("\n")
    };
    let (line, message) = fault(&changed(2, "9.9"));
    assert_eq!(line, Some(2));
    assert!(message.contains("version"), "{message}");
    let place = lines.iter().position(|line| line.starts_with("0 0 0")).unwrap() + 1;
    assert!(fault(&changed(place, "0 0")).1.contains("2 numbers, expected 3"));
    assert!(fault(&changed(place + 1, "7")).1.contains("the kind of a point"));
    assert!(fault(&changed(place - 1, "999999")).1.contains("the number of points: 999999"));
    assert!(fault(&lines[..lines.len() - 6].join("\n")).1.contains("the file ends where"));
}

#[test]
fn damaged_binary_files_never_stop_the_program() {
    let bytes = binary(&write_ftm(&small()));
    let mut state = 1_u64;
    let mut below = |n: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % n
    };
    for _ in 0..2000 {
        let mut damaged = bytes.clone();
        for _ in 0..=below(4) {
            let at = 13 + below(damaged.len() - 13);
            match below(3) {
                0 => damaged[at] = below(256) as u8,
                1 => drop(damaged.splice(at..at, [0xff, 0xff, 0xff, 0x7f])),
                _ => damaged.truncate(at.max(20)),
            }
        }
        if let Ok(project) = read_fbm(&damaged) {
            let [_, mesh] = project.net.meshes(5_000, 2);
            assert!(mesh.vertices.iter().flatten().all(|c| c.is_finite()));
        }
    }
}
