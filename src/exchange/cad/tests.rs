use super::*;
use crate::hull::{Hull, PrincipalParticulars, Solid};
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector};

#[test]
fn reals_have_a_point_and_come_back() {
    for (value, text) in
        [(1.0, "1."), (0.25, "0.25"), (1.5e-7, "1.5E-7"), (-1e22, "-1.E22"), (0.0, "0."), (-0.0, "0."), (120.0, "120.")]
    {
        assert_eq!(real(value), text);
    }
    for value in [0.1 + 0.2, 1.0 / 3.0, 6.02e-23, 12345.678e10, f64::MIN_POSITIVE] {
        assert_eq!(real(value).parse::<f64>().unwrap().to_bits(), value.to_bits());
    }
}

fn barge() -> Solid {
    let (u, v) = (KnotVector::uniform(2, 2).unwrap(), KnotVector::uniform(1, 1).unwrap());
    let points =
        u.greville().iter().flat_map(|&s| v.greville().into_iter().map(move |t| [60.0 * s, 5.0, 4.0 * t])).collect();
    let deck = BsplineCurve::new(KnotVector::uniform(1, 1).unwrap(), vec![[0.0, 4.0], [60.0, 4.0]]).unwrap();
    let particulars =
        PrincipalParticulars { length_between_perpendiculars: 60.0, breadth: 10.0, draught: Some(3.0), depth: 4.0 };
    let hull = Hull::new("it's a barge", particulars, BsplineSurface::new(u, v, points).unwrap(), deck).unwrap();
    Solid::new(&hull).unwrap()
}

#[test]
fn a_step_file_refers_only_to_what_it_has() {
    let text = write_step(&barge(), "it's a barge\n", CadUnit::Millimetre);
    assert!(text.starts_with("ISO-10303-21;\n") && text.ends_with("END-ISO-10303-21;\n"));
    assert!(
        text.contains("MANIFOLD_SOLID_BREP('it''s a barge\\X2\\000A\\X0\\'")
            && text.contains("SI_UNIT(.MILLI.,.METRE.)")
    );
    assert!(text.contains("60000.") && text.is_ascii());
    let mut defined = std::collections::BTreeSet::new();
    for line in text.lines().filter(|line| line.starts_with('#')) {
        let (number, rest) = line[1..].split_once('=').unwrap();
        for part in rest.split('#').skip(1) {
            let digits: String = part.chars().take_while(char::is_ascii_digit).collect();
            assert!(defined.contains(&digits), "#{digits} before it is defined: {line}");
        }
        assert!(defined.insert(number.to_owned()), "{line}");
    }
    assert_eq!(text.matches("ADVANCED_FACE").count(), 6);
    assert_eq!(text.matches("EDGE_CURVE").count(), 12);
    assert_eq!(text.matches("VERTEX_POINT").count(), 8);
    assert_eq!(text.matches("STYLED_ITEM").count(), 6);
}

#[test]
fn a_step_file_names_its_hull_in_any_script() {
    let text = write_step(&barge(), "Æ\\b 船船 🚢", CadUnit::Metre);
    assert!(text.contains("FILE_NAME('\\X2\\00C6\\X0\\\\\\b \\X2\\82398239\\X0\\ \\X4\\0001F6A2\\X0\\',"), "{text}");
}

#[test]
fn records_of_an_iges_file_have_80_columns_and_count_themselves() {
    let text = write_iges(&barge(), "barge", CadUnit::Metre);
    let mut counts = std::collections::BTreeMap::new();
    for line in text.lines() {
        assert_eq!(line.len(), 80, "{line}");
        let letter = line.as_bytes()[72] as char;
        let count = counts.entry(letter).or_insert(0);
        *count += 1;
        assert_eq!(line[73..].trim().parse::<usize>().unwrap(), *count, "{line}");
    }
    let last = text.lines().last().unwrap();
    for (letter, from) in [('S', 0), ('G', 8), ('D', 16), ('P', 24)] {
        assert_eq!(last.as_bytes()[from] as char, letter);
        assert_eq!(last[from + 1..from + 8].trim().parse::<usize>().unwrap(), counts[&letter]);
    }
    // Vertices, edges and their 12 curves, 6 faces of a surface and a loop, shell and solid.
    assert_eq!(counts[&'D'], 2 * (2 + 12 + 6 * 3 + 2));
    // Every entity points to its own parameters.
    let directory: Vec<&str> = text.lines().filter(|line| line.as_bytes()[72] == b'D').collect();
    let body: Vec<&str> = text.lines().filter(|line| line.as_bytes()[72] == b'P').collect();
    for (k, pair) in directory.chunks(2).enumerate() {
        let first: usize = pair[0][8..16].trim().parse().unwrap();
        let count: usize = pair[1][24..32].trim().parse().unwrap();
        assert!(body[first - 1].starts_with(&format!("{},", pair[0][..8].trim())), "{}", body[first - 1]);
        assert!(body[first + count - 2][..64].trim_end().ends_with(';'));
        assert!(body[first - 1..first + count - 1].iter().all(|line| line[64..72].trim() == (2 * k + 1).to_string()));
    }
}

#[test]
fn a_dxf_file_has_its_layers_and_pairs() {
    let lines = [
        DxfLine { layer: "stations".to_owned(), points: vec![[0.0, 0.0, 0.0], [0.0, 1.5, 2.0]], flat: false },
        DxfLine {
            layer: "water lines".to_owned(),
            points: vec![[0.0, 0.0, 1.0], [f64::NAN, 0.0, 0.0], [1.0, 0.5, 1.0]],
            flat: true,
        },
        DxfLine { layer: "none".to_owned(), points: vec![[0.0; 3]], flat: false },
    ];
    let text = write_dxf(&lines, CadUnit::Millimetre, DxfVersion::R12);
    let all: Vec<&str> = text.lines().collect();
    assert_eq!(all.len() % 2, 0);
    let pairs: Vec<(u16, &str)> = all.chunks(2).map(|pair| (pair[0].trim().parse().unwrap(), pair[1])).collect();
    let count = |value: &str| pairs.iter().filter(|pair| **pair == (0, value)).count();
    assert_eq!([count("POLYLINE"), count("VERTEX"), count("SEQEND"), count("LAYER")], [2, 4, 2, 2]);
    assert!(pairs.contains(&(2, "STATIONS")) && pairs.contains(&(2, "WATER_LINES")) && !pairs.contains(&(2, "NONE")));
    assert!(pairs.contains(&(20, "1500.0")));
    assert_eq!(pairs.last(), Some(&(0, "EOF")));
}

#[test]
fn handles_of_a_drawing_of_2000_are_different_and_owned() {
    let points = vec![[0.0, 1.0, 0.0], [2.0, 1.0, 0.0]];
    let lines = [true, false].map(|flat| DxfLine { layer: "a".to_owned(), points: points.clone(), flat });
    let text = write_dxf(&lines, CadUnit::Metre, DxfVersion::R2000);
    let all: Vec<&str> = text.lines().map(str::trim).collect();
    assert_eq!(all.len() % 2, 0);
    let pairs: Vec<(&str, &str)> = all.chunks(2).map(|pair| (pair[0], pair[1])).collect();
    // The seed stands first.
    let handles: Vec<&str> =
        pairs.iter().filter(|(code, _)| ["5", "105"].contains(code)).map(|(_, value)| *value).collect();
    let different: std::collections::BTreeSet<&str> = handles.iter().copied().collect();
    assert_eq!(different.len(), handles.len());
    let number = |handle: &str| u32::from_str_radix(handle, 16).unwrap();
    assert!(handles[1..].iter().all(|handle| number(handle) < number(handles[0])));
    for (_, owner) in pairs.iter().filter(|(code, _)| ["330", "350"].contains(code)) {
        assert!(*owner == "0" || different.contains(owner), "{owner}");
    }
    for kind in ["LWPOLYLINE", "POLYLINE", "SEQEND"] {
        assert_eq!(pairs.iter().filter(|pair| **pair == ("0", kind)).count(), 1, "{kind}");
    }
}
