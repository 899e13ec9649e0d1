use super::*;
use crate::hull::{Cell, FeatureLine, Functional, LineKind, Marks, OutlinePoint, StationOffsets};
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
        let (mut between, mut at) = (0.0f64, [0.0; 3]);
        for i in 0..200 {
            for j in 0..100 {
                let p = net.surface.eval((i as f64 + 0.5) / 200.0, (j as f64 + 0.5) / 100.0);
                // Distance from the ellipsoid to first order: F / |grad F|.
                let q = [p[0] / 10.0, p[1] / 2.0, p[2] - 1.0];
                let f = q.iter().map(|q| q * q).sum::<f64>() - 1.0;
                let slope = 2.0 * (q[0] / 10.0).hypot(q[1] / 2.0).hypot(q[2]);
                if (f / slope).abs() > between { at = p; }
                between = between.max((f / slope).abs());
            }
        }
        println!("{n} {m}: V {:.2e} lcb {lcb:.2e} kb {:.2e} cells {worst:.1e} between {between:.2e} {at:?} {:?} {:?}", v / exact - 1.0, vcb - (1.0 - 0.375), net.surface.shape(), net.notes);
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
    for (k, p) in net.profiles.iter().enumerate().filter(|(_, p)| p.station.is_some()) {
        for q in &p.points {
            let v = net.v(k, q.z).unwrap();
            let s = net.surface.eval(net.length.sites[k], v);
            assert!((s[1] - q.y.unwrap()).abs() < 1e-9 && (s[2] - q.z).abs() < 1e-9);
        }
    }
    match fit(&table) { Ok(f) => println!("{:?}", at_draught(&f.hull, 0.9652)), Err(e) => println!("{e}") }
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


/// Lines of knuckles of the stern trawler: corners of its sections next to the creases of its control net.
fn knuckles(sections: &OffsetTable, creases: &[(&str, &[[f64; 3]])]) -> Vec<FeatureLine> {
    creases
        .iter()
        .map(|(name, crease)| {
            let mut points = Vec::new();
            for station in &sections.stations {
                let x = station.station.x;
                let Some(pair) = crease.windows(2).find(|w| w[0][0] <= x && x < w[1][0]) else { continue };
                let t = (x - pair[0][0]) / (pair[1][0] - pair[0][0]);
                let [y, z] = [1, 2].map(|d| pair[0][d] + t * (pair[1][d] - pair[0][d]));
                let outline = &station.outlines[0];
                let turn = |k: usize| {
                    let [a, b, c] = [&outline[k - 1], &outline[k], &outline[k + 1]];
                    let angle = |p: &OutlinePoint, q: &OutlinePoint| (q.z - p.z).atan2(q.y - p.y);
                    (angle(b, c) - angle(a, b)).abs()
                };
                let near = (1..outline.len() - 1).filter(|&k| (outline[k].y - y).hypot(outline[k].z - z) < 0.4);
                let Some(k) = near.max_by(|&a, &b| turn(a).total_cmp(&turn(b))) else { continue };
                if turn(k) > 0.15 {
                    points.push([x, outline[k].y, outline[k].z]);
                }
            }
            FeatureLine { name: (*name).to_owned(), kind: LineKind::Knuckle, points }
        })
        .collect()
}

const SKEG: [[f64; 3]; 8] = [[3.18, 0.0, 3.52], [3.6, 0.2, 3.38], [7.2, 1.35, 2.37], [10.8, 1.92, 1.45], [14.4, 2.14, 0.78], [18.0, 2.18, 0.41], [21.6, 2.15, 0.30], [21.7, 2.15, 0.30]];
const SIDE: [[f64; 3]; 11] = [[0.0, 5.8, 8.25], [1.8, 5.8, 7.33], [3.6, 5.8, 6.54], [7.2, 5.8, 5.29], [10.8, 5.8, 4.04], [14.4, 5.8, 2.93], [18.0, 5.8, 2.18], [21.6, 5.8, 2.0], [25.2, 5.8, 2.64], [28.8, 5.8, 5.02], [32.4, 5.8, 8.26]];
const UPPER: [[f64; 3]; 2] = [[0.0, 5.8, 8.25], [32.4, 5.8, 8.26]];

fn at_draught(hull: &Hull, draught: f64) -> [f64; 4] {
    let value = |f: Functional| f.value(hull, draught);
    let v = value(Functional::Volume);
    let largest = (0..=400).map(|k| value(Functional::SectionArea { x: 10.0 + 0.05 * f64::from(k) })).fold(0.0, f64::max);
    [v, value(Functional::LongitudinalMoment) / v, largest, value(Functional::WaterplaneArea)]
}

#[test]
fn the_stern_trawler() {
    let Some(text) = data("sterntrawler/sections.csv") else { return };
    let sections = outlines(&text, [0, 3, 4]);
    let Some(text) = data("sterntrawler/offsets.csv") else { return };
    let bare = grid(&text, Some(2));
    let lines = knuckles(&sections, &[("skeg", &SKEG), ("side", &SIDE), ("upper", &UPPER)]);
    for l in &lines { println!("{} {:?}", l.name, l.points.iter().map(|p| format!("{:.2} {:.2} {:.2}", p[0], p[1], p[2])).collect::<Vec<_>>()); }
    for (name, table) in [
        ("trawler_grid", bare.clone()),
        ("trawler_lines", OffsetTable { lines: lines.clone(), ..bare }),
        ("trawler_sections", sections.clone()),
        ("trawler_sections_lines", OffsetTable { lines, ..sections }),
    ] {
        let net = match Net::new(&table) { Ok(net) => net, Err(e) => { println!("{name} {e}"); continue; } };
        summary(&net, &table, name);
        match fit(&table) {
            Ok(fitted) => for (z, v, lcb, amax, awp) in [(5.2736, 1633.484, 21.875, 55.168, 450.395), (5.75, 1851.552, 21.567, 60.694, 464.684)] {
                let found = at_draught(&fitted.hull, z);
                println!("{name} {z}: V {:.3} ({:+.2} %) LCB {:.3} ({lcb}) amax {:.3} ({amax}) awp {:.3} ({awp})", found[0], 100.0 * (found[0] / v - 1.0), found[1], found[2], found[3]);
            },
            Err(e) => println!("{name}: {e}"),
        }
    }
}

#[test]
fn a_hard_chine_prism() {
    // Deadrise to the chine at y = 2, z = 0.5, flare to y = 3 at z = 2; exact area per side 0.5 * 2 * 0.5 + 2.5 * 1.5.
    let half = |z: f64| if z < 0.5 { 4.0 * z } else { 2.0 + (z - 0.5) / 1.5 };
    let waterlines: Vec<f64> = (0..=8).map(|k| 0.25 * f64::from(k)).collect();
    let stations = (0..=6)
        .map(|k| {
            let mut station = StationOffsets::new(format!("{k}"), 2.0 * f64::from(k));
            station.half_breadths = waterlines
                .iter()
                .map(|&z| {
                    let mut cell = Cell::from(Some(half(z)));
                    cell.marks.knuckle = (z - 0.5).abs() < 1e-9;
                    cell
                })
                .collect();
            station
        })
        .collect();
    let table = OffsetTable { waterlines, stations, ..OffsetTable::default() };
    let net = Net::new(&table).unwrap();
    let [v, lcb, _] = volume(&net.surface);
    println!("{v} {:?} {:?}", net.notes, net.surface.shape());
    assert!((v - 2.0 * 12.0 * (0.5 + 3.75)).abs() < 1e-11 && (lcb - 6.0).abs() < 1e-12, "{v} {lcb}");
}

#[test]
fn small_craft() {
    for name in ["freeship_chines_import.txt", "freeship_round_import.txt", "pias_barge.txt", "pdstrip_geometry.txt"] {
        let Some(text) = data(&format!("formats/samples/{name}")) else { continue };
        let read = match crate::exchange::read_table(name, text.as_bytes()) { Ok(r) => r, Err(p) => { println!("{name} {}", p[0]); continue } };
        println!("{name}: {:?} stations, {} lines", read.table.stations.len(), read.table.lines.len());
        let net = Net::new(&read.table).unwrap();
        summary(&net, &read.table, name.split('.').next().unwrap());
        match fit(&read.table) { Ok(_) => println!("hull"), Err(e) => println!("{name}: {e}") }
    }
}
