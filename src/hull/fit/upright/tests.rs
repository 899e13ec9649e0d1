use super::*;
use crate::hull::{Cell, Marks, OutlinePoint, StationOffsets};
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

/// The folder of the published hulls; none, with a line that says so, where it is absent.
fn data(path: &str) -> Option<String> {
    let folder = std::env::var("LOFTSMAN_DATA").unwrap_or_else(|_| format!("{}/../shared/data", env!("CARGO_MANIFEST_DIR")));
    let found = std::fs::read_to_string(format!("{folder}/{path}")).ok();
    if found.is_none() {
        println!("skipped: no {path} in the folder of LOFTSMAN_DATA");
    }
    found
}

/// Rows of numbers of a CSV file: columns x, y, z by their index.
fn outlines(text: &str, [x, y, z]: [usize; 3]) -> OffsetTable {
    let mut stations: Vec<StationOffsets> = Vec::new();
    for line in text.lines().skip(1) {
        let fields: Vec<f64> = line.split(',').map(|f| f.parse().unwrap()).collect();
        if stations.last().is_none_or(|s| (s.station.x - fields[x]).abs() > 1e-9) {
            stations.push(StationOffsets::new(format!("{}", stations.len()), fields[x]));
            stations.last_mut().unwrap().outlines.push(Vec::new());
        }
        let point = OutlinePoint { y: fields[y], z: fields[z], marks: Marks::default() };
        let branch = if x == 0 && z == 4 { fields[1] as usize } else { 0 };
        let own = &mut stations.last_mut().unwrap().outlines;
        own.resize(own.len().max(branch + 1), Vec::new());
        own[branch].push(point);
    }
    OffsetTable { stations, ..OffsetTable::default() }
}

/// A body plan with points, for looking at.
fn draw(net: &Net, name: &str) {
    let Ok(folder) = std::env::var("LOFTSMAN_DRAW") else { return };
    let size = size(&net.profiles);
    let k = 700.0 / size.breadth;
    let x0 = net.profiles[0].x;
    let span = net.profiles[net.profiles.len() - 1].x - x0;
    let (low, mid) = (net.profiles.iter().map(Profile::keel).fold(f64::INFINITY, f64::min), 0.45);
    let mut out = String::from("<svg xmlns='http://www.w3.org/2000/svg' width='1500' height='1600' viewBox='0 0 1500 1600'><rect width='1500' height='1600' fill='white'/>");
    let mut path = |points: Vec<[f64; 2]>, color: &str, width: f64| {
        let d: Vec<String> = points.iter().map(|p| format!("{:.2},{:.2}", p[0], p[1])).collect();
        out += &format!("<polyline points='{}' fill='none' stroke='{color}' stroke-width='{width}'/>", d.join(" "));
    };
    let height = size.depth * k;
    let body = |p: [f64; 3]| {
        let side = if (p[0] - x0) / span < mid { -1.0 } else { 1.0 };
        [750.0 + side * p[1] * k, 20.0 + height - (p[2] - low) * k]
    };
    let sites = &net.length.sites;
    for pair in sites.windows(2) {
        for j in 0..4 {
            let u = pair[0] + (pair[1] - pair[0]) * f64::from(j) / 4.0;
            let curve = (0..=600).map(|i| body(net.surface.eval(u, f64::from(i) / 600.0))).collect();
            if j == 0 { path(curve, "black", 0.9) } else if j == 2 { path(curve, "#a0c0ff", 0.6) }
        }
    }
    let s = 1460.0 / span;
    let flat = |x: f64, y: f64, base: f64, f: f64| [20.0 + (x - x0) * s, base - y * f];
    let base = 20.0 + height + 300.0;
    for line in net.surface.v().breakpoints() {
        let curve = (0..=1200).map(|i| net.surface.eval(f64::from(i) / 1200.0, line));
        path(curve.map(|p| flat(p[0], p[2] - low, base, 250.0 / size.depth)).collect(), "#c07020", 0.5);
    }
    for w in 1..=12 {
        let z = low + size.depth * (f64::from(w) - 0.01) / 12.0;
        let mut points = Vec::new();
        for i in 0..=1500 {
            let curve = net.surface.curve_at_u(f64::from(i) / 1500.0);
            let (mut a, mut b) = (0.0, 1.0);
            if curve.eval(0.0)[2] > z || curve.eval(1.0)[2] < z { continue; }
            for _ in 0..40 { let m = 0.5 * (a + b); if curve.eval(m)[2] < z { a = m } else { b = m } }
            let p = curve.eval(a);
            points.push(flat(p[0], p[1], base + 300.0, 250.0 / size.breadth));
        }
        path(points, "#206020", 0.7);
    }
    for profile in &net.profiles {
        for p in &profile.points {
            let [a, b] = body([profile.x, p.y.unwrap_or(0.0), p.z]);
            out += &format!("<circle cx='{a:.2}' cy='{b:.2}' r='1.6' fill='red'/>");
        }
    }
    out += "</svg>";
    std::fs::write(format!("{folder}/{name}.svg"), &out).unwrap();
    let tree = resvg::usvg::Tree::from_str(&out, &resvg::usvg::Options::default()).unwrap();
    let mut map = resvg::tiny_skia::Pixmap::new(1500, 1600).unwrap();
    resvg::render(&tree, resvg::tiny_skia::Transform::default(), &mut map.as_mut());
    map.save_png(format!("{folder}/{name}.png")).unwrap();
}

fn summary(net: &Net, table: &OffsetTable, name: &str) -> [f64; 3] {
    let sums = volume(&net.surface);
    let worst = net.cells(table).iter().filter_map(|c| c.residual).fold(0.0f64, |m, r| m.max(r.abs()));
    let low = net.surface.points().iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    println!("{name}: V {:.4} LCB {:.4} KB {:.4} cells {worst:.1e} least y {low:.3} {:?} {:?}", sums[0], sums[1], sums[2], net.surface.shape(), net.notes);
    draw(net, name);
    sums
}

/// Every second station, with the last.
fn thinned(table: &OffsetTable) -> OffsetTable {
    let last = table.stations.len() - 1;
    let stations = table.stations.iter().enumerate().filter(|(k, _)| k % 2 == 0 || *k == last).map(|(_, s)| s.clone()).collect();
    OffsetTable { stations, ..table.clone() }
}

#[test]
fn the_yacht_of_pdstrip() {
    let Some(text) = data("pdstrip_yacht/sections.csv") else { return };
    let table = outlines(&text, [0, 2, 3]);
    let net = Net::new(&table).unwrap();
    summary(&net, &table, "yacht");
    for (k, p) in net.profiles.iter().enumerate() {
        for q in &p.points {
            let v = net.v(k, q.z).unwrap();
            let s = net.surface.eval(net.length.sites[k], v);
            assert!((s[1] - q.y.unwrap()).abs() < 1e-9 && (s[2] - q.z).abs() < 1e-9);
        }
    }
    let half = thinned(&table);
    summary(&Net::new(&half).unwrap(), &half, "yacht_half");
    let Some(text) = data("pdstrip_yacht/offsets.csv") else { return };
    let grid = grid(&text, None);
    summary(&Net::new(&grid).unwrap(), &grid, "yacht_grid");
}

/// A grid of half-breadths: x, z_keel, and z_top where `top` names its column, then waterlines named by their heights.
fn grid(text: &str, top: Option<usize>) -> OffsetTable {
    let mut lines = text.lines();
    let first = top.map_or(2, |t| t + 1);
    let waterlines: Vec<f64> = lines.next().unwrap().split(',').skip(first).map(|f| f.parse().unwrap()).collect();
    let stations = lines
        .map(|line| {
            let fields: Vec<Option<f64>> = line.split(',').map(|f| f.parse().ok()).collect();
            let mut station = StationOffsets::new(line.split(',').next().unwrap(), fields[0].unwrap());
            station.keel_height = fields[1];
            station.deck_height = top.and_then(|t| fields[t]);
            station.half_breadths = fields[first..].iter().map(|&f| Cell::from(f)).collect();
            station
        })
        .collect();
    OffsetTable { waterlines, stations, ..OffsetTable::default() }
}

#[test]
fn the_stern_trawler() {
    let Some(text) = data("sterntrawler/sections.csv") else { return };
    let table = outlines(&text, [0, 3, 4]);
    summary(&Net::new(&table).unwrap(), &table, "trawler_sections");
    let Some(text) = data("sterntrawler/offsets.csv") else { return };
    let table = grid(&text, Some(2));
    summary(&Net::new(&table).unwrap(), &table, "trawler_grid");
}
