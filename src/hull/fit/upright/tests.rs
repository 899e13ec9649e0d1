//! Closed forms: an ellipsoid, a prism with chines, a wedge; ends, marks and lines.

use super::*;
use crate::hull::{Cell, FeatureLine, Functional, LineKind, StationOffsets};
use crate::numeric::gauss_legendre;

/// Volume of both sides below the upper edge \[m^3\], and the x and z of its centroid \[m\].
pub(super) fn volume(surface: &BsplineSurface<3>) -> [f64; 3] {
    let mut sums = [0.0; 3];
    let (us, vs) = (surface.u().breakpoints(), surface.v().breakpoints());
    for a in us.windows(2) {
        for (u, wu) in gauss_legendre(5).on(a[0], a[1]) {
            for b in vs.windows(2) {
                for (v, wv) in gauss_legendre(6).on(b[0], b[1]) {
                    let d = surface.derivatives::<2>(u, v);
                    let weight = 2.0 * wu * wv * d[0][0][1] * d[1][0][0] * d[0][1][2];
                    sums[0] += weight;
                    sums[1] += weight * d[0][0][0];
                    sums[2] += weight * d[0][0][2];
                }
            }
        }
    }
    [sums[0], sums[1] / sums[0], sums[2] / sums[0]]
}

/// The greatest residual of the cells with a value \[m\].
pub(super) fn greatest_residual(cells: &[CellResidual]) -> f64 {
    cells.iter().filter_map(|cell| cell.residual).fold(0.0, |most, r| most.max(r.abs()))
}

/// Half an ellipsoid with semi-axes 10, 2 and 1 below z = 1 in equal spaces.
fn ellipsoid(spaces: usize, steps: usize) -> OffsetTable {
    let waterlines: Vec<f64> = (0..=steps).map(|k| k as f64 / steps as f64).collect();
    let stations = (0..=spaces)
        .map(|k| {
            let x = 10.0 * (2.0 * k as f64 / spaces as f64 - 1.0);
            let r = (1.0 - (x / 10.0) * (x / 10.0)).max(0.0);
            let half = |z: f64| {
                let s = r - (1.0 - z) * (1.0 - z);
                (s >= 0.0).then(|| 2.0 * s.sqrt())
            };
            StationOffsets {
                keel_height: Some(1.0 - r.sqrt()),
                deck_height: Some(1.0),
                half_breadths: waterlines.iter().map(|&z| Cell::from(half(z))).collect(),
                ..StationOffsets::new(format!("{k}"), x)
            }
        })
        .collect();
    OffsetTable { name: "ellipsoid".to_owned(), waterlines, stations, ..OffsetTable::default() }
}

/// Rockered keel, both ends blunt, cells at level waterlines: volume to 1e-4 from 15 x 10, distance between the cells to
/// three thousandths of the depth and falling.
#[test]
fn the_canoe_body_of_an_ellipsoid() {
    let exact = 4.0 / 3.0 * std::f64::consts::PI * 20.0 / 2.0;
    let mut distances = Vec::new();
    for (spaces, steps, allowed) in [(14, 9, 2e-4), (24, 14, 3e-5), (48, 28, 5e-6)] {
        let table = ellipsoid(spaces, steps);
        let net = Net::new(&table).unwrap();
        let [found, lcb, vcb] = volume(&net.surface);
        let mut distance = 0.0f64;
        for i in 0..200 {
            for j in 0..100 {
                let p = net.surface.eval((f64::from(i) + 0.5) / 200.0, (f64::from(j) + 0.5) / 100.0);
                // Distance from the ellipsoid to first order: F / |grad F|.
                let q = [p[0] / 10.0, p[1] / 2.0, p[2] - 1.0];
                let f = q.iter().map(|q| q * q).sum::<f64>() - 1.0;
                distance = distance.max((0.5 * f / (q[0] / 10.0).hypot(q[1] / 2.0).hypot(q[2])).abs());
            }
        }
        println!(
            "{spaces} x {steps}: volume {:.1e}, KB {:.1e}, distance {distance:.1e} m",
            found / exact - 1.0,
            vcb - 0.625
        );
        assert!((found / exact - 1.0).abs() < allowed && lcb.abs() < 1e-10 && (vcb - 0.625).abs() < allowed);
        assert!(greatest_residual(&net.cells(&table)) < 1e-9 && net.notes.is_empty(), "{:?}", net.notes);
        distances.push(distance);
    }
    assert!(
        distances[0] < 5e-3 && distances[1] < 0.6 * distances[0] && distances[2] < 0.5 * distances[1],
        "{distances:?}"
    );
    let fitted = fit(&ellipsoid(24, 14)).unwrap();
    assert_eq!(fitted.chart, Chart::Upright);
    assert!((Functional::Volume.value(&fitted.hull, 1.0) / exact - 1.0).abs() < 3e-5);
}

/// y = sin(x) z on waterlines 0 to 1: exact around the section, of fourth order along the ship.
#[test]
fn order_along_the_ship() {
    let error = |spaces: usize| {
        let waterlines: Vec<f64> = (0..=4).map(|k| 0.25 * f64::from(k)).collect();
        let stations = (0..=spaces)
            .map(|k| {
                let x = 1.0 + 2.0 * k as f64 / spaces as f64;
                let half_breadths = waterlines.iter().map(|z| Cell::from(Some(x.sin() * z))).collect();
                StationOffsets { half_breadths, ..StationOffsets::new(format!("{k}"), x) }
            })
            .collect();
        let net = Net::new(&OffsetTable { waterlines, stations, ..OffsetTable::default() }).unwrap();
        (0..500)
            .map(|i| net.surface.eval((f64::from(i) + 0.5) / 500.0, 0.7))
            .fold(0.0f64, |m, p| m.max((p[1] - p[0].sin() * p[2]).abs()))
    };
    let errors = [10, 20, 40].map(error);
    assert!(errors[0] < 2e-4 && errors[0] > 11.0 * errors[1] && errors[1] > 11.0 * errors[2], "{errors:?}");
}

/// Deadrise to the chine at y = 2, z = 1/2, flare to y = 3 at z = 2, 12 m long.
fn prism(mark: bool) -> OffsetTable {
    let half = |z: f64| if z < 0.5 { 4.0 * z } else { 2.0 + (z - 0.5) / 1.5 };
    let waterlines: Vec<f64> = (0..=8).map(|k| 0.25 * f64::from(k)).collect();
    let stations = (0..=6)
        .map(|k| {
            let mut station = StationOffsets::new(format!("{k}"), 2.0 * f64::from(k));
            for &z in &waterlines {
                let mut cell = Cell::from(Some(half(z)));
                cell.marks.knuckle = mark && (z - 0.5).abs() < 1e-9;
                station.half_breadths.push(cell);
            }
            station
        })
        .collect();
    OffsetTable { waterlines, stations, ..OffsetTable::default() }
}

#[test]
fn a_prism_with_a_hard_chine_is_exact() {
    let chine = vec![[0.0, 2.0, 0.5], [12.0, 2.0, 0.5]];
    let line = FeatureLine { name: "chine".to_owned(), kind: LineKind::Knuckle, points: chine };
    let exact = 2.0 * 12.0 * (0.5 + 3.75);
    for table in [prism(true), OffsetTable { lines: vec![line], ..prism(false) }] {
        let net = Net::new(&table).unwrap();
        assert_eq!(net.lines.len(), 1);
        let [found, lcb, _] = volume(&net.surface);
        assert!((found / exact - 1.0).abs() < 1e-12 && (lcb - 6.0).abs() < 1e-11, "{found} {lcb}");
        // The chine is crisp: both panels are plane to rounding up to the knuckle.
        for k in 0..=100 {
            let p = net.surface.eval(0.37, f64::from(k) / 100.0);
            let half = if p[2] < 0.5 { 4.0 * p[2] } else { 2.0 + (p[2] - 0.5) / 1.5 };
            assert!((p[1] - half).abs() < 1e-12, "{p:?}");
        }
    }
    // Without the mark one curve runs through the chine and leaves the panels.
    let blind = Net::new(&prism(false)).unwrap().surface;
    let off = (0..=100).map(|k| blind.eval(0.37, f64::from(k) / 100.0)).map(|p| {
        let half = if p[2] < 0.5 { 4.0 * p[2] } else { 2.0 + (p[2] - 0.5) / 1.5 };
        (p[1] - half).abs()
    });
    assert!(off.fold(0.0, f64::max) > 1e-3);
}

#[test]
fn unknown_cells_are_predicted() {
    let mut table = prism(true);
    table.stations[3].half_breadths[6].entry = Entry::Unknown;
    let fitted = fit(&table).unwrap();
    let cell = fitted.cells.iter().find(|c| c.station == 3 && c.waterline == 6).unwrap();
    assert!(cell.residual.is_none());
    assert!((cell.half_breadth - (2.0 + 1.0 / 1.5)).abs() < 1e-9, "{cell:?}");
    assert!(greatest_residual(&fitted.cells) < 1e-12);
    assert!(fitted.notes.iter().any(|note| note.contains("cut off")), "{:?}", fitted.notes);
}

#[test]
fn too_little_is_an_error() {
    let one = OffsetTable { stations: prism(true).stations[..1].to_vec(), ..prism(true) };
    assert!(matches!(fit(&one), Err(FitError::TooFew { stations: 1, least: 2, .. })));
    let mut flat = prism(true);
    flat.stations.iter_mut().flat_map(|s| &mut s.half_breadths).for_each(|c| c.entry = Entry::Absent);
    assert!(matches!(fit(&flat), Err(FitError::TooFew { stations: 0, .. })));
}
