//! Damaged files and bytes that are no table.

use super::*;
use loftsman::internals::exchange::Severity;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

/// What must hold of whatever was read.
fn sound(name: &str, bytes: &[u8]) {
    match read_table(name, bytes) {
        Ok(ReadTable { table, .. }) => {
            assert!(table.stations.windows(2).all(|pair| pair[0].station.x <= pair[1].station.x), "{name}");
            for p in table.stations.iter().flat_map(|s| s.outlines.iter().flatten()) {
                assert!(p.y.is_finite() && p.z.is_finite() && p.y >= 0.0, "{name} {p:?}");
            }
            for (_, write, _) in WRITERS {
                write(&table);
            }
        }
        Err(problems) => {
            assert!(problems.iter().any(|p| p.severity == Severity::Error), "{name}");
            assert!(problems.len() < 1000 && problems.iter().all(|p| p.found.chars().count() < 200), "{name}");
        }
    }
}

#[test]
fn damaged_files_are_refused_or_read_and_never_stop_the_program() {
    let mut random = StdRng::seed_from_u64(2);
    let mut samples: Vec<(&str, String)> = WRITERS.iter().map(|(name, write, _)| (*name, write(&ship()))).collect();
    samples.extend(
        [
            ("a.seaway", SEAWAY),
            ("d.txt", DELFTSHIP),
            ("c.txt", CHINES),
            ("r.csv", FRACTIONS),
            ("p.csv", POINTS),
            ("m.txt", MARKERS),
        ]
        .map(|(name, text)| (name, text.to_owned())),
    );
    let grid = OffsetTable {
        waterlines: (0..5).map(f64::from).collect(),
        stations: (0..5).map(|i| StationOffsets::new(i.to_string(), 10.0 * f64::from(i))).collect(),
        ..OffsetTable::default()
    };
    samples.push(("in.mlt", write_michlet(&grid, "a", 1.0)));
    let words = [
        "-1",
        "0",
        "1e9",
        "999999999999999999999",
        "nan",
        "1e-300",
        "-0",
        "1,5",
        "*",
        "**",
        "****",
        "\n",
        "\n\n",
        "0 0 0",
        "\u{e9}",
        "t",
    ];
    for (name, text) in &samples {
        sound(name, text.as_bytes());
        for _ in 0..1500 {
            let mut bytes = text.clone().into_bytes();
            for _ in 0..random.random_range(1..4) {
                let at = random.random_range(0..bytes.len());
                let end = (at + random.random_range(0..12)).min(bytes.len());
                let word = words[random.random_range(0..words.len())];
                match random.random_range(0..5) {
                    0 => drop(bytes.drain(at..end)),
                    1 => drop(bytes.splice(at..at, word.bytes())),
                    2 => drop(bytes.splice(at..end, word.bytes())),
                    3 => bytes[at] = random.random_range(0..=255),
                    _ => bytes.truncate(at + 1),
                }
                if bytes.is_empty() {
                    break;
                }
            }
            sound(name, &bytes);
        }
    }
    for name in ["a.gf", "a.bri", "a.seaway", "a.txt", "a.csv"] {
        for _ in 0..1000 {
            let length = random.random_range(0..300);
            let alphabet = b"0123456789.,-* \n\n\n\tx#";
            let plain = random.random_bool(0.7);
            let bytes: Vec<u8> = (0..length)
                .map(|_| {
                    if plain { alphabet[random.random_range(0..alphabet.len())] } else { random.random_range(0..=255) }
                })
                .collect();
            sound(name, &bytes);
        }
    }
}
