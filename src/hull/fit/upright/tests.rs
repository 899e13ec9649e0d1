use super::*;
use crate::hull::{Cell, OutlinePoint, StationOffsets};
use crate::numeric::gauss_legendre;

/// Volume, its x moment, its z moment of both sides by Gauss-Legendre, below the upper edge.
pub(super) fn volume(surface: &BsplineSurface<3>) -> [f64; 3] {
    let mut sums = [0.0; 3];
    let (us, vs) = (surface.u().breakpoints(), surface.v().breakpoints());
    for a in us.windows(2) {
        for (u, wu) in gauss_legendre(8).on(a[0], a[1]) {
            for b in vs.windows(2) {
                for (v, wv) in gauss_legendre(8).on(b[0], b[1]) {
                    let d = surface.derivatives::<2>(u, v);
                    let weight = 2.0 * wu * wv * d[0][0][1] * (d[1][0][0] * d[0][1][2] - d[0][1][0] * d[1][0][2]);
                    sums[0] += weight;
                    sums[1] += weight * d[0][0][0];
                    sums[2] += weight * d[0][0][2];
                }
            }
        }
    }
    [sums[0], sums[1] / sums[0], sums[2] / sums[0]]
}

/// Half an ellipsoid with semi-axes 10, 2 and 1 below z = 1, sampled at `stations` and `waterlines`, keel heights given.
fn ellipsoid(stations: usize, waterlines: usize) -> OffsetTable {
    let (a, b, c) = (10.0, 2.0, 1.0);
    let waterlines: Vec<f64> = (0..=waterlines).map(|k| k as f64 / waterlines as f64).collect();
    let stations = (0..=stations)
        .map(|k| {
            let x = a * (2.0 * k as f64 / stations as f64 - 1.0);
            let r = (1.0 - (x / a) * (x / a)).max(0.0);
            let mut station = StationOffsets::new(format!("{k}"), x);
            station.keel_height = Some(1.0 - c * r.sqrt());
            station.deck_height = Some(1.0);
            station.half_breadths = waterlines
                .iter()
                .map(|&z| {
                    let s = r - ((1.0 - z) / c).powi(2);
                    Cell::from((s >= 0.0).then(|| b * s.sqrt()))
                })
                .collect();
            station
        })
        .collect();
    OffsetTable { name: "ellipsoid".to_owned(), waterlines, stations, ..OffsetTable::default() }
}

#[test]
fn the_canoe_body_of_an_ellipsoid() {
    let exact = 4.0 / 3.0 * std::f64::consts::PI * 20.0 / 2.0;
    for (n, m) in [(14, 9), (24, 14), (48, 28)] {
        let table = ellipsoid(n, m);
        let net = Net::new(&table).unwrap();
        let [v, lcb, vcb] = volume(&net.surface);
        let worst = net.cells(&table).iter().filter_map(|c| c.residual).fold(0.0f64, |m, r| m.max(r.abs()));
        let mut between = 0.0f64;
        for i in 0..200 {
            for j in 0..100 {
                let p = net.surface.eval((i as f64 + 0.5) / 200.0, (j as f64 + 0.5) / 100.0);
                let r = 1.0 - (p[0] / 10.0).powi(2) - (1.0 - p[2]).powi(2);
                between = between.max((p[1] - 2.0 * r.max(0.0).sqrt()).abs());
            }
        }
        println!("{n} {m}: V {:.2e} lcb {lcb:.2e} kb {:.2e} cells {worst:.1e} between {between:.2e} {:?} {:?}", v / exact - 1.0, vcb - (1.0 - 0.375), net.surface.shape(), net.notes);
    }
}
