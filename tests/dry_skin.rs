//! Skins that water does not reach: plates with two sides, and bulkheads and decks whose edges are edges of the skin. Volumes are
//! those of the boxes outside.

use loftsman::internals::hull::{DrySkin, TriangleMesh};

use crate::support::{folder, program, stderr};

type Point = [f64; 3];
type Triangle = [Point; 3];

/// A parallelogram in m by n cells of two triangles each.
fn grid(at: Point, along: Point, across: Point, [m, n]: [u32; 2]) -> Vec<Triangle> {
    let point = |i: u32, j: u32| -> Point {
        let (s, t) = (f64::from(i) / f64::from(m), f64::from(j) / f64::from(n));
        std::array::from_fn(|k| at[k] + s * along[k] + t * across[k])
    };
    let cells = (0..m).flat_map(|i| (0..n).map(move |j| (i, j)));
    cells
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

/// The walls of a box without a lid, turned outward, 20 by 8 by 4 cells.
fn open_box([low, high]: [Point; 2]) -> Vec<Triangle> {
    let [l, b, h]: [f64; 3] = std::array::from_fn(|k| high[k] - low[k]);
    let (x, y, z) = ([l, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, h]);
    let mut all = grid(low, y, x, [8, 20]);
    all.extend(grid(low, x, z, [20, 4]));
    all.extend(grid([low[0], high[1], low[2]], z, x, [4, 20]));
    all.extend(grid(low, z, y, [4, 8]));
    all.extend(grid([high[0], low[1], low[2]], y, z, [8, 4]));
    all
}

const OUTER: [Point; 2] = [[0.0, -4.0, 0.0], [40.0, 4.0, 4.0]];

fn lid() -> Vec<Triangle> {
    grid([0.0, -4.0, 4.0], [40.0, 0.0, 0.0], [0.0, 8.0, 0.0], [20, 8])
}

fn mesh(parts: Vec<Triangle>) -> TriangleMesh {
    TriangleMesh::from_corners(parts.into_iter()).oriented().0
}

/// An open box of plates of a thickness, with a rim between its skins; each side of the inner one is half as fine or finer.
fn hollow(t: f64) -> Vec<Triangle> {
    let inner = [[t, t - 4.0, t], [40.0 - t, 4.0 - t, 4.0]];
    let mut parts = open_box(OUTER);
    parts.extend(open_box(inner).into_iter().map(|[a, b, c]| [a, c, b]));
    let ring = |[low, high]: [Point; 2]| -> Vec<Point> {
        let side = |from: [f64; 2], to: [f64; 2], n: u32| {
            (0..n).map(move |k| {
                let share = f64::from(k) / f64::from(n);
                [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1]), 4.0]
            })
        };
        let corners = [[low[0], low[1]], [high[0], low[1]], [high[0], high[1]], [low[0], high[1]]];
        [(0, 1, 20), (1, 2, 8), (2, 3, 20), (3, 0, 8)]
            .into_iter()
            .flat_map(|(a, b, n)| side(corners[a], corners[b], n))
            .collect()
    };
    let (out, within) = (ring(OUTER), ring(inner));
    for k in 0..out.len() {
        let n = (k + 1) % out.len();
        parts.extend([[out[k], out[n], within[n]], [out[k], within[n], within[k]]]);
    }
    parts
}

#[test]
fn the_inner_skin_of_a_hollow_box_is_left_out() {
    for thickness in [0.01, 0.4] {
        let body = mesh(hollow(thickness));
        let (left, found) = body.clone().without_dry_skin();
        assert_eq!(found, DrySkin { inner: 768, ..DrySkin::default() }, "{thickness}");
        assert_eq!((left.triangles.len(), left.bounds()), (body.triangles.len() - 768, body.bounds()), "{thickness}");
    }
}

/// A ring of triangles between two squares about (20, 0), of half sides and heights.
fn ring([low, high]: [(f64, f64); 2]) -> Vec<Triangle> {
    let square = |(half, z): (f64, f64)| -> [Point; 4] {
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[a, b]| [20.0 + half * a, half * b, z])
    };
    let (from, to) = (square(low), square(high));
    let side = |k: usize| {
        let n = (k + 1) % 4;
        [[from[k], from[n], to[n]], [from[k], to[n], to[k]]]
    };
    (0..4).flat_map(side).collect()
}

/// A box with a pool through it that is narrower than a cell of the search at the keel.
fn pool() -> Vec<Triangle> {
    let walls = open_box(OUTER).into_iter().filter(|t| t.iter().any(|p| p[2] > 0.0));
    let plate = |z: f64, half: f64| {
        let (high, low) = ((20.0 - half, 4.0 - half), (20.0 + half, half));
        let part = |x: f64, y: f64, l: f64, b: f64| grid([x, y, z], [l, 0.0, 0.0], [0.0, b, 0.0], [1, 1]);
        [
            part(0.0, -4.0, high.0, 8.0),
            part(low.0, -4.0, high.0, 8.0),
            part(high.0, -4.0, 2.0 * half, high.1),
            part(high.0, low.1, 2.0 * half, high.1),
        ]
        .concat()
    };
    let well =
        [ring([(0.1, 0.0), (0.1, 0.5)]), ring([(0.1, 0.5), (2.0, 0.5)]), ring([(2.0, 0.5), (2.0, 4.0)])].concat();
    walls.chain(plate(0.0, 0.1)).chain(plate(4.0, 2.0)).chain(well).collect()
}

#[test]
fn bodies_without_dry_skin_stay_as_they_are() {
    let demihulls = [[[0.0, 2.0, 0.0], [20.0, 4.0, 4.0]], [[0.0, -4.0, 0.0], [20.0, -2.0, 4.0]]];
    let two: Vec<Triangle> = demihulls.into_iter().flat_map(open_box).collect();
    let closed: Vec<Triangle> = open_box(OUTER).into_iter().chain(lid()).collect();
    // A deck well below its bulwarks, of which the upper edges are open.
    let bulwarks = open_box([[0.0, -4.0, 4.0], [40.0, 4.0, 4.5]]).into_iter().filter(|t| t.iter().any(|p| p[2] > 4.1));
    let sunk: Vec<Triangle> = closed.iter().copied().chain(bulwarks).collect();
    let well = pool();
    for (name, parts) in
        [("two hulls", two), ("no deck", open_box(OUTER)), ("closed", closed), ("bulwarks", sunk), ("moonpool", well)]
    {
        let body = mesh(parts);
        let (left, found) = body.clone().without_dry_skin();
        assert!(found.sheets + found.inner == 0 && left == body, "{name}: {found:?}");
    }
}

/// Each sheet ends on vertices of the skin; some of them part it in two.
fn sheets() -> Vec<(&'static str, Vec<Triangle>)> {
    let bulkhead = |x: f64| grid([x, -4.0, 0.0], [0.0, 8.0, 0.0], [0.0, 0.0, 4.0], [8, 4]);
    let along = |y: f64| grid([0.0, y, 0.0], [40.0, 0.0, 0.0], [0.0, 0.0, 4.0], [20, 4]);
    let tank_top = grid([0.0, -4.0, 1.0], [40.0, 0.0, 0.0], [0.0, 8.0, 0.0], [20, 8]);
    let mut knuckled = grid([0.0, -4.0, 1.0], [40.0, 0.0, 0.0], [0.0, 4.0, 1.0], [20, 4]);
    knuckled.extend(grid([0.0, 0.0, 2.0], [40.0, 0.0, 0.0], [0.0, 4.0, -1.0], [20, 4]));
    let low = grid([10.0, -4.0, 0.0], [0.0, 8.0, 0.0], [0.0, 0.0, 2.0], [8, 2]);
    let mixed = [bulkhead(10.0), along(2.0), tank_top.clone()].concat();
    vec![
        ("bulkheads", [bulkhead(10.0), bulkhead(30.0)].concat()),
        ("along", along(2.0)),
        ("two along", [along(2.0), along(-1.0)].concat()),
        ("tank top", tank_top),
        ("knuckled", knuckled),
        ("low", low),
        ("mixed", mixed),
    ]
}

#[test]
fn sheets_that_share_edges_with_the_skin_are_left_out() {
    for (number, (name, sheets)) in sheets().into_iter().enumerate() {
        let lids: &[bool] = if name == "mixed" { &[true, false] } else { &[number % 2 == 0] };
        for &has_lid in lids {
            let mut skin = open_box(OUTER);
            if has_lid {
                skin.extend(lid());
            }
            let alone = mesh(skin.clone());
            let count = sheets.len();
            skin.extend(&sheets);
            let (left, found) = mesh(skin).without_dry_skin();
            assert_eq!(found, DrySkin { sheets: count, ..DrySkin::default() }, "{name}, lid: {has_lid}");
            let left = left.oriented().0;
            assert_eq!(
                (left.triangles.len(), left.open_edges().len()),
                (alone.triangles.len(), alone.open_edges().len())
            );
            assert!((left.report().volume - alone.report().volume).abs() < 1e-9, "{name}, lid: {has_lid}");
        }
    }
}

/// The commands say what is left out, and the figures are those of the outer skin.
#[test]
fn the_commands_name_dry_skin() {
    let place = folder("dry-skin");
    std::fs::create_dir_all(&place).unwrap();
    let text = |parts: &[Triangle]| {
        let facet = |t: &Triangle| {
            let vertex = |p: &Point| format!("vertex {} {} {}\n", p[0], p[1], p[2]);
            format!("facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n", t.iter().map(vertex).collect::<String>())
        };
        format!("solid\n{}endsolid\n", parts.iter().map(facet).collect::<String>())
    };
    let longitudinal = grid([0.0, 2.0, 0.0], [40.0, 0.0, 0.0], [0.0, 0.0, 4.0], [20, 4]);
    let cases = [
        ("hollow.stl", hollow(0.012), "W320 hollow.stl: 768 triangles of an inner skin left out"),
        ("along.stl", [open_box(OUTER), longitudinal].concat(), "W320 along.stl: 160 triangles of sheets inside"),
    ];
    for (name, parts, wanted) in cases {
        let path = place.join(name);
        std::fs::write(&path, text(&parts)).unwrap();
        let output = program(&["hydro", &path.display().to_string(), "--draughts", "3", "--json"]);
        let (found, notes) = (String::from_utf8_lossy(&output.stdout).into_owned(), stderr(&output));
        assert!(output.status.success(), "{name}: {notes}");
        let volume =
            found.split("\"DISPVOL\": ").filter_map(|part| part.split([',', '\n']).next()?.trim().parse().ok());
        assert!(volume.into_iter().any(|v: f64| (v - 960.0).abs() < 1e-6), "{name}: {found}");
        let notes = notes.replace(&place.display().to_string(), "").replace("/", "");
        assert!(notes.contains(wanted), "{name}: {notes}");
    }
}
