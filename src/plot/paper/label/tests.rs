//! Names keep off curves, combs, arrows and each other.

use super::*;

#[test]
fn a_segment_that_passes_a_corner_does_not_cross() {
    let r = Rectangle::new(0.0, 0.0, 2.0, 1.0);
    assert!(crosses(&r, [-1.0, 0.5], [3.0, 0.5]));
    assert!(crosses(&r, [0.5, 0.5], [0.6, 0.6]));
    assert!(!crosses(&r, [-1.0, 0.5], [0.5, -1.0]));
    assert!(!crosses(&r, [3.0, 0.0], [3.0, 1.0]));
}

#[test]
fn segments_meet_or_do_not() {
    assert!(meet([[0.0, 0.0], [2.0, 2.0]], [[0.0, 2.0], [2.0, 0.0]]));
    assert!(!meet([[0.0, 0.0], [2.0, 2.0]], [[3.0, 2.0], [2.1, 0.0]]));
}

#[test]
fn names_keep_off_combs_and_heads_of_arrows() {
    let mut canvas = Canvas::new(100.0, 50.0);
    let mut placer = LabelPlacer::default();
    let (style, sheet) = (TextStyle::new(3.0, Anchor::Middle), canvas.sheet());
    placer.add_arrow([[10.0, 30.0], [10.0, 20.0]]);
    placer.add_teeth(&[[[40.0, 5.0], [40.0, 24.0]]]);
    // The head is in the way of the first, the shaft of the second.
    assert_eq!(
        placer.name_point(&mut canvas, "5", &style, &[[10.9, 20.5], [10.0, 27.0], [10.0, 35.0]], &sheet),
        Some(2)
    );
    assert_eq!(placer.name_point(&mut canvas, "6", &style, &[[40.0, 10.0], [40.0, 30.0]], &sheet), Some(1));
    // What has no other place stands on a tooth, but never on a head.
    assert_eq!(placer.name_point(&mut canvas, "7", &style, &[[40.0, 10.0]], &sheet), Some(0));
    assert_eq!(placer.name_point(&mut canvas, "8", &style, &[[10.0, 20.5]], &sheet), None);
    let places =
        [15.0, 20.0].map(|y| Canvas::text_place([41.2, y], "1.5", &TextStyle { anchor: Anchor::End, ..style }));
    let shift = placer.clear_shift(&places, 8.0);
    assert!((shift - 1.5).abs() < 1e-9, "{shift}");
    assert!(placer.clear_shift(&places, 0.5) <= 0.5);
}

#[test]
fn a_name_with_a_leader_stands_off_every_curve() {
    let mut canvas = Canvas::new(100.0, 50.0);
    let mut placer = LabelPlacer::default();
    for k in 0..8 {
        let y = 20.0 + f64::from(k);
        placer.add_curve(&[[10.0, y], [90.0, y]]);
    }
    let (style, sheet) = (TextStyle::new(3.0, Anchor::Start), canvas.sheet());
    let on = Preference { part: 0.5, crossings: 0, beside: false };
    for curve in 0..8 {
        assert!(!placer.name_curve(&mut canvas, curve, "WL 1", &style, on, &sheet));
        assert!(placer.name_by_leader(&mut canvas, curve, "WL 1", &style, &Pen::new(0.1, "#000000"), &sheet));
    }
    for (k, text) in canvas.texts().iter().enumerate() {
        assert_eq!(placer.crossings(&text.place, &[]), 0, "{text:?}");
        assert!(canvas.texts()[..k].iter().all(|other| !other.place.overlaps(&text.place)), "{text:?}");
    }
}

#[test]
fn names_keep_apart() {
    let mut canvas = Canvas::new(100.0, 50.0);
    let mut placer = LabelPlacer::default();
    placer.add_curve(&[[0.0, 25.0], [100.0, 25.0]]);
    placer.add_curve(&[[0.0, 26.0], [100.0, 26.0]]);
    let style = TextStyle::new(3.0, Anchor::Start);
    let sheet = canvas.sheet();
    assert!(placer.name_curve(
        &mut canvas,
        0,
        "first",
        &style,
        Preference { part: 0.5, crossings: 9, beside: false },
        &sheet
    ));
    assert!(placer.name_curve(
        &mut canvas,
        1,
        "second",
        &style,
        Preference { part: 0.5, crossings: 9, beside: false },
        &sheet
    ));
    let texts = canvas.texts();
    assert!(!texts[0].place.overlaps(&texts[1].place));
}

#[test]
fn a_name_without_room_is_left_out() {
    let mut canvas = Canvas::new(10.0, 10.0);
    let mut placer = LabelPlacer::default();
    placer.add_curve(&[[0.0, 5.0], [10.0, 5.0]]);
    let style = TextStyle::new(3.0, Anchor::Start);
    let sheet = canvas.sheet();
    assert!(!placer.name_curve(
        &mut canvas,
        0,
        "a name too long for it",
        &style,
        Preference { part: 0.5, crossings: 9, beside: false },
        &sheet
    ));
    assert!(canvas.texts().is_empty());
}
