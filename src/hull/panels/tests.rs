use super::*;
use crate::hull::{HullError, PrincipalParticulars};
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector};
use std::collections::HashMap;

fn hull(u: KnotVector, v: KnotVector, place: impl Fn(f64, f64) -> [f64; 3]) -> Result<Hull, HullError> {
    let (us, vs) = (u.greville(), v.greville());
    let points = us.iter().flat_map(|&s| vs.iter().map(move |&t| (s, t))).map(|(s, t)| place(s, t)).collect();
    let surface = BsplineSurface::new(u, v, points)?;
    let deck = BsplineCurve::new(KnotVector::uniform(1, 1)?, vec![[-1.0, 6.0], [101.0, 6.0]])?;
    let particulars =
        PrincipalParticulars { length_between_perpendiculars: 100.0, breadth: 8.0, draught: Some(4.0), depth: 6.0 };
    Hull::new("test", particulars, surface, deck)
}

/// y = 16 u (1 - u) v, by its blossom over the knots in u; x = 100 u, z = 6 v.
fn parabolic() -> Hull {
    let (u, v) = (KnotVector::uniform(2, 2).unwrap(), KnotVector::uniform(1, 3).unwrap());
    let mut points = Vec::new();
    for i in 0..u.basis_count() {
        let [a, b] = [u.knots()[i + 1], u.knots()[i + 2]];
        for t in v.greville() {
            points.push([50.0 * (a + b), 8.0 * (a + b - 2.0 * a * b) * t, 6.0 * t]);
        }
    }
    let surface = BsplineSurface::new(u, v, points).unwrap();
    let deck = BsplineCurve::new(KnotVector::uniform(1, 1).unwrap(), vec![[-1.0, 6.0], [101.0, 6.0]]).unwrap();
    let particulars =
        PrincipalParticulars { length_between_perpendiculars: 100.0, breadth: 8.0, draught: Some(4.0), depth: 6.0 };
    Hull::new("parabolic", particulars, surface, deck).unwrap()
}

fn settings(draught: f64, size: f64) -> PanelSettings {
    PanelSettings { draught, size, flatness: 1e-2 }
}

/// Every edge belongs to two panels in opposite directions, except on the waterline and on the centreplane.
fn watertight(mesh: &PanelMesh) -> bool {
    let mut edges: HashMap<(usize, usize), [usize; 2]> = HashMap::new();
    for panel in &mesh.panels {
        for k in 0..4 {
            let (p, q) = (panel[k], panel[(k + 1) % 4]);
            if p != q {
                edges.entry((p.min(q), p.max(q))).or_default()[usize::from(p > q)] += 1;
            }
        }
    }
    edges.iter().all(|(&(p, q), uses)| {
        let (a, b) = (mesh.vertices[p], mesh.vertices[q]);
        let free = (a[1] <= 0.0 && b[1] <= 0.0) || (a[2] >= 0.0 && b[2] >= 0.0);
        if free { uses[0] + uses[1] == 1 } else { *uses == [1, 1] }
    })
}

#[test]
fn a_box_has_its_volume_and_area_to_rounding() {
    let line = || KnotVector::uniform(1, 1).unwrap();
    let hull = hull(line(), line(), |s, t| [100.0 * s, 4.0, 6.0 * t]).unwrap();
    let mesh = PanelMesh::new(&hull, &settings(4.0, 3.0)).unwrap();
    let report = mesh.report();
    assert!((report.volume / 3200.0 - 1.0).abs() < 1e-13, "{report:?}");
    // Sides, bottom, transom and bow.
    assert!((report.area / (2.0 * 400.0 + 800.0 + 2.0 * 32.0) - 1.0).abs() < 1e-13, "{report:?}");
    assert_eq!((report.triangles, report.unevenness), (0, 0.0));
    assert!(report.longest <= 3.0 + 1e-12 && watertight(&mesh), "{report:?}");
    assert_eq!(report.panels, 34 * 2 + 34 * 2 + 2 * 2 * 2);
}

#[test]
fn the_volume_of_panels_converges_at_second_order() {
    let hull = parabolic();
    // 2 int y dx dz = 2 (100 * 16/6) (T^2 / (2 * 6)).
    let exact = 2.0 * 100.0 * 16.0 / 6.0 * 16.0 / 12.0;
    let mut last = f64::NAN;
    for size in [4.0, 2.0, 1.0, 0.5] {
        let mesh = PanelMesh::new(&hull, &settings(4.0, size)).unwrap();
        let report = mesh.report();
        assert!(watertight(&mesh) && report.longest < 1.2 * size, "{report:?}");
        let error = (report.volume / exact - 1.0).abs();
        assert!(error < 2e-3 * size * size, "{error:e} at {size}");
        assert!(last.is_nan() || error < 0.32 * last, "{error:e} after {last:e}");
        last = error;
    }
}

#[test]
fn panels_end_on_the_waterline_and_on_the_centreplane() {
    let hull = parabolic();
    let mesh = PanelMesh::new(&hull, &settings(3.3, 2.5)).unwrap();
    assert!(mesh.vertices.iter().all(|[_, y, z]| *y >= 0.0 && *z <= 0.0));
    let afloat = mesh.vertices.iter().filter(|v| v[2].to_bits() == 0).count();
    assert!(afloat > 40, "{afloat}");
}

#[test]
fn a_rockered_keel_leaves_the_water() {
    // z = z_keel(x) + height v, the keel a parabola that rises 3 m to both ends.
    let (u, v) = (KnotVector::uniform(2, 4).unwrap(), KnotVector::uniform(1, 2).unwrap());
    let mut points = Vec::new();
    for i in 0..u.basis_count() {
        let [a, b] = [u.knots()[i + 1], u.knots()[i + 2]];
        let keel = 3.0 * (1.0 - 2.0 * (a + b) + 4.0 * a * b);
        for t in v.greville() {
            points.push([50.0 * (a + b), 0.5 + 3.5 * t, keel + (6.0 - keel) * t]);
        }
    }
    let surface = BsplineSurface::new(u, v, points).unwrap();
    let deck = BsplineCurve::new(KnotVector::uniform(1, 1).unwrap(), vec![[-1.0, 6.0], [101.0, 6.0]]).unwrap();
    let particulars =
        PrincipalParticulars { length_between_perpendiculars: 100.0, breadth: 8.0, draught: Some(2.0), depth: 6.0 };
    let hull = Hull::new("rocker", particulars, surface, deck).unwrap();
    let exact = crate::hull::Functional::Volume.value(&hull, 2.0);
    let mut last = f64::NAN;
    for size in [4.0, 2.0, 1.0] {
        let mesh = PanelMesh::new(&hull, &settings(2.0, size)).unwrap();
        assert!(watertight(&mesh));
        let error = (mesh.report().volume / exact - 1.0).abs();
        assert!(last.is_nan() || error < 0.35 * last, "{error:e} after {last:e}");
        last = error;
    }
    assert!(last < 1e-3, "{last:e}");
}

#[test]
fn panels_that_cannot_be_are_refused() {
    let hull = parabolic();
    let error = |draught, size| PanelMesh::new(&hull, &settings(draught, size)).unwrap_err();
    assert_eq!(error(0.0, 1.0), PanelError::NothingImmersed { draught: 0.0, bottom: 0.0 });
    assert!(matches!(error(7.0, 1.0), PanelError::DeckImmersed { .. }));
    assert_eq!(error(4.0, 1e-6), PanelError::TooMany { size: 1e-6 });
    assert_eq!(error(4.0, 0.02), PanelError::TooMany { size: 0.02 });
}
