//! Small samples of our own: what is written is read back, and each format says what it says.

use super::*;

#[test]
fn what_is_written_is_read_back() {
    let ship = ship();
    for (name, write, digit) in WRITERS {
        let text = write(&ship);
        let back = read(name, &text).table;
        assert_eq!(back.stations.len(), 3, "{name}");
        for (a, b) in ship.stations.iter().zip(&back.stations) {
            assert!((a.station.x - b.station.x).abs() <= digit + 1e-12);
            assert_eq!(a.outlines.len(), b.outlines.len(), "{name} {:?}", b.outlines);
            for (a, b) in a.outlines.iter().flatten().zip(b.outlines.iter().flatten()) {
                assert!((a.y - b.y).abs() <= digit + 1e-12 && (a.z - b.z).abs() <= digit + 1e-12, "{name} {a:?} {b:?}");
                assert!(name != "a.pias" || a.marks == b.marks);
            }
            assert!(name != "a.gf" || (b.deck_centre_height.unwrap() - 7.125).abs() < digit);
        }
        assert!((volume(&ship, 6.0) / volume(&back, 6.0) - 1.0).abs() < 1e-4);
        assert_eq!(write(&back), text, "{name}: writing again changes nothing");
    }
}

#[test]
fn sections_under_water_for_strip_theory() {
    let mut ship = ship();
    ship.stated.draught = Some(4.5);
    let back = read("geomet.out", &write_pdstrip(&ship)).table;
    assert_eq!(back.stated.draught, Some(4.5));
    assert!((volume(&back, 9.0) / volume(&ship, 4.5) - 1.0).abs() < 1e-4);
    for station in &back.stations {
        assert!((station.outlines.last().unwrap().last().unwrap().z - 4.5).abs() < 1e-9);
    }
}

#[test]
fn grids_are_written_as_sections() {
    use loftsman::internals::parametric::analytic::{self, Dimensions};
    let dimensions = Dimensions { length: 100.0, breadth: 10.0, draught: 6.25, depth: 9.0 };
    let hull = analytic::wigley("Wigley", &dimensions).expect("valid dimensions").hull;
    let table = OffsetTable::with_defaults(&hull);
    for (name, write, _) in WRITERS {
        let back = read(name, &write(&table)).table;
        let volume = volume(&back, 6.25);
        // Trapezoids of 7 waterlines and 20 stations lose 0.6 % of 4/9 L B T.
        assert!((volume / (4.0 / 9.0 * 6250.0) - 1.0).abs() < 0.01, "{name}: {volume}");
    }
}

#[test]
fn offsets_with_counts_and_flags() {
    let ReadTable { table, notes } = read("a.txt", DELFTSHIP);
    let cells: Vec<Vec<Option<f64>>> = table
        .stations
        .iter()
        .map(|s| s.half_breadths.iter().map(loftsman::internals::hull::Cell::value).collect())
        .collect();
    assert_eq!(cells[0], [None, None, Some(1.0)]);
    assert_eq!(cells[3], [None, Some(0.25), Some(0.5)]);
    assert_eq!(table.waterlines, [0.5, 1.5, 3.0]);
    assert_eq!(table.stations[3].deck_height, Some(5.5));
    assert_eq!(table.stations[1].deck_half_breadth, Some(4.5));
    assert_eq!(table.stations[3].keel_height, Some(0.5));
    assert_eq!(table.endings[2], [Some(-1.0), Some(41.0)]);
    assert_eq!(table.stations[2].flat_of_bottom, Some(1.5));
    assert_eq!(table.stated.breadth, Some(10.0));
    assert_eq!(table.form.decimals, Some(2));
    assert!(notes.iter().any(|note| note.message.contains("not published")));
    // A line a waterline is known by its length.
    let turned = DELFTSHIP.replace(
        "- - 1.00\n2.5 3.5 4.25\n3.0 4.0 5.0\n- 0.25 0.5\n",
        "- 2.5 3.0 -\n- 3.5 4.0 0.25\n1.00 4.25 5.0 0.5\n",
    );
    let turned = read("a.txt", &turned).table;
    for (a, b) in table.stations.iter().zip(&turned.stations) {
        let values =
            |s: &StationOffsets| s.half_breadths.iter().map(loftsman::internals::hull::Cell::value).collect::<Vec<_>>();
        assert_eq!(values(a), values(b));
    }
}

#[test]
fn small_samples_of_the_others() {
    let ship = read("a.seaway", SEAWAY).table;
    assert_eq!(ship.name, "Small ship");
    assert_eq!(ship.stations.iter().map(|s| s.station.x).collect::<Vec<_>>(), [-1.0, 10.0, 20.0]);
    assert_eq!((ship.stations[1].outlines[0][1].y, ship.stations[1].outlines[0][1].z), (2.0, 0.0));
    let scaled = read("a.seaway", &SEAWAY.replace("1.0 1.0 1.0", "2.0 1.5 0.5"));
    assert!((volume(&scaled.table, 9.0) / volume(&ship, 9.0) - 1.5).abs() < 1e-12);
    assert!(list(&scaled.notes).contains("multiplied by 2, 1.5 and 0.5"));

    let boat = read("chines.txt", CHINES).table;
    assert_eq!(boat.lines.len(), 3);
    let at_five = boat.stations.iter().find(|s| (s.station.x - 5.0).abs() < 1e-12).unwrap();
    let points: Vec<(f64, f64)> = at_five.outlines[0].iter().map(|p| (p.y, p.z)).collect();
    assert_eq!(points, [(0.0, 0.0), (1.5, 0.4), (0.75, 1.25)]);
    assert!(at_five.outlines[0][1].marks.knuckle && !at_five.outlines[0][2].marks.knuckle);

    let table = read("ratio.csv", FRACTIONS).table;
    assert!((table.stations[1].half_breadths[1].value().unwrap() - 0.9 * 0.9 * 16.0 * 0.3048).abs() < 1e-12);
    assert!((table.stations[1].station.x - 20.0).abs() < 1e-12 && table.stations[1].half_breadths[0].marks.tangent);
    assert_eq!(table.stations[1].half_breadths[1].written.as_ref().unwrap().column, 3);
    assert!((table.waterlines[1] - 1.5).abs() < 1e-12);

    let points = read("sections.csv", POINTS).table;
    assert_eq!(points.stations[2].outlines.len(), 2);
    assert_eq!(points.stations[2].outlines[1].len(), 2, "the deck is taken off");
    assert!((points.stations[2].deck_centre_height.unwrap() - 3.01).abs() < 1e-12);
    assert!((points.stations[1].outlines[0][2].y - 2.1).abs() < 1e-12);
    assert_eq!(points.form.decimals, Some(3));
    assert!((breadth(&read("markers.txt", MARKERS).table) - 6.0).abs() < 1e-12);

    // A section that gives both sides, in a format of half sections.
    let both = "both\n1\n6 0 0\n0.1 0\n1 1\n1 2\n-1 2\n-1.1 1\n-0.1 0\n0\n3 5 5\n0 0\n2 1\n2 2\n0\n0 0 0\n";
    let both = read("a.bri", both);
    assert!(list(&both.notes).contains("differ by up to 0.1"), "{}", list(&both.notes));
    assert!((both.table.stations[0].outlines[0][1].y - 0.1).abs() < 1e-12);
    // An unsymmetric body of strip theory, with a gap.
    let unsymmetric = "2 f 2\n0 4 0\n 1 1 -1 -1\n 0 2 2 0\n9 5 1 3\n 1 1 0 -1 -1\n 0 2 2 2 0\n";
    assert_eq!(read("geomet.out", unsymmetric).table.stations[0].outlines[0].len(), 4);
}

#[test]
fn origins_and_directions() {
    // From the forward perpendicular aft: GHS counts aft, 65.6168 ft are 20 m.
    let shape = |xs: [f64; 3]| {
        let sections: String = xs.iter().map(|x| format!("{x},3\n0,0\n9,3\n9,9\n")).collect();
        format!(
            "a\nL:65.6168\n*\nS\n3\n{sections}0,0,0\n**\nC\n0\n1\n0,0,0\nS\n***\nHULL\nSEA WATER\n1\n1\n0,0,0\n1\nC\n****\n"
        )
    };
    for (xs, origin) in [
        ([0.0, 32.8084, 65.6168], "forward perpendicular"),
        ([-32.8084, 0.0, 32.8084], "amidships"),
        ([-65.6168, -32.8084, 0.0], "after perpendicular"),
        ([100.0, 132.8084, 165.6168], "the aftermost section is taken as AP"),
    ] {
        let read = read("a.gf", &shape(xs));
        assert!(list(&read.notes).contains(origin), "{origin}: {}", list(&read.notes));
        for (station, x) in read.table.stations.iter().zip([0.0, 10.0, 20.0]) {
            assert!((station.station.x - x).abs() < 1e-4, "{origin}: {}", station.station.x);
        }
    }
    // From the bow: turned round, with the same x.
    let text = "2\n20\n2\n0 0 1\n1 1 1\n0\n2\n0 0 1\n2 1 1\n";
    let table = read("a.pias", text).table;
    assert!(table.stations[0].station.x.abs() < 1e-12 && (table.stations[0].outlines[0][1].y - 2.0).abs() < 1e-12);
}

#[test]
fn one_sided_parts_and_others_are_left_out_with_notes() {
    let text = write_ghs(&ship()).replace("0,0,0\n**\n", "0,0,0\nSKEG\n2\n10,4\n3,0\n4,0\n4,1\n3,0\n30,4\n3,0\n4,0\n4,1\n3,0\n0,0,0\n**\nSKEG.S\n1\n1\n0,0,0\nSKEG\n")
        .replace("0,0,0\n1\nHULL.C\n", "0,0,0\n2\nSKEG.S\nHULL.C\nTANK\nFRESH WATER\n2\n1\n0,0,0\n1\nHULL.C\n");
    let read = read("a.gf", &text);
    assert_eq!(read.table.stations.len(), 3);
    let notes = list(&read.notes);
    assert!(
        notes.contains("component 'SKEG.S' is left out: 2 sections from y = 0.914 to 1.219 m, on starboard only"),
        "{notes}"
    );
    assert!(notes.contains("part 'TANK' is left out"), "{notes}");
    // The hull on one side only is not mirrored.
    let half = write_ghs(&ship()).replace("HULL.C\n0\n", "HULL.C\n1\n");
    let problems = list(&read_table("a.gf", half.as_bytes()).unwrap_err());
    assert!(problems.contains("on starboard only") && problems.contains("needs side 0"), "{problems}");
}

#[test]
fn tables_of_delftship_are_read_back() {
    let first = read("d.txt", DELFTSHIP).table;
    let text = write_delftship(&first);
    let again = read("d.txt", &text).table;
    assert_eq!(write_delftship(&again), text);
    assert_eq!((&again.waterlines, &again.endings), (&first.waterlines, &first.endings));
    for (a, b) in again.stations.iter().zip(&first.stations) {
        let values =
            |s: &StationOffsets| s.half_breadths.iter().map(loftsman::internals::hull::Cell::value).collect::<Vec<_>>();
        assert_eq!(values(a), values(b));
        assert_eq!((a.keel_height, a.deck_height, a.flat_of_bottom), (b.keel_height, b.deck_height, b.flat_of_bottom));
    }
}
