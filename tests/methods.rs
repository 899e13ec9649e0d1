//! The methods of five published systems, each as a setting of `Hull::fit`: their printed tables, their properties, and
//! every file of `configs/methods` run by itself.

use std::fs;
use std::path::PathBuf;

use loftsman::internals::hull::{
    Cell, Entry, FitError, FitMethod, Fitted, Hull, LeastSquares, NetKnots, OffsetStation, OffsetTable,
    ParametricStations, QuadraticNet, StationOffsets, UniformBicubic,
};
use loftsman::internals::hydrostatics::{Conventions, CurvesOfForm};
use loftsman::internals::report::{fit_outputs, read_fit};
use loftsman::internals::spline::{BsplineSurface, Parametrization};

use crate::support::{carried, folder, json, names_in, program, read_text, stderr, stdout};

/// A table from a matrix; NaN is a blank cell.
fn table(xs: &[f64], zs: &[f64], y: impl Fn(usize, usize) -> f64) -> OffsetTable {
    let station = |i: usize| StationOffsets {
        half_breadths: (0..zs.len()).map(|j| Cell::from(Some(y(i, j)).filter(|y| !y.is_nan()))).collect(),
        station: OffsetStation { name: format!("{i}"), x: xs[i] },
        ..StationOffsets::new("", xs[i])
    };
    OffsetTable {
        name: "test".into(),
        waterlines: zs.to_vec(),
        stations: (0..xs.len()).map(station).collect(),
        endings: vec![[None; 2]; zs.len()],
        ..OffsetTable::default()
    }
}

fn fit(table: &OffsetTable, method: FitMethod) -> Fitted {
    Hull::fit(table, &method).unwrap_or_else(|error| panic!("{error}"))
}

fn at(fitted: &Fitted, x: f64, z: f64) -> f64 {
    fitted.hull.half_breadth(x, z).unwrap()
}

const FISHING_X: [f64; 5] = [0.0, 2.1, 4.2, 6.3, 8.4];
const FISHING_Z: [f64; 4] = [0.7, 1.3, 1.9, 2.5];
/// Half-breadths of a fishing vessel's forebody (Blagojevic, Split), frames R5 to R9.
const FISHING_Y: [[f64; 4]; 5] = [
    [0.89, 2.36, 3.16, 3.385],
    [0.84, 2.25, 2.99, 3.245],
    [0.65, 1.72, 2.435, 2.81],
    [0.345, 1.065, 1.63, 2.055],
    [0.15, 0.45, 0.75, 1.045],
];

fn fishing() -> OffsetTable {
    table(&FISHING_X, &FISHING_Z, |i, j| FISHING_Y[i][j])
}

fn printed_settings() -> LeastSquares {
    LeastSquares {
        orders: [3, 3],
        control_points: [Some(4), Some(4)],
        knots: [Some(vec![3., 3., 3., 6., 7., 7., 9., 10.]), Some(vec![2., 2., 2., 6., 8., 8., 10.])],
        parameters: [Some(vec![3., 4., 5., 6., 7.]), Some(vec![2., 4., 6., 8.])],
    }
}

/// x, z, printed by the bilinear program, printed by the least-squares program.
const PRINTED: [[f64; 4]; 4] =
    [[1.05, 0.7, 0.865, 0.8797], [4.2, 0.7, 0.65, 0.6536], [5.25, 0.7, 0.4975, 0.515], [5.25, 2.5, 2.4325, 2.469]];

#[test]
fn the_printed_table_of_the_fishing_vessel() {
    let bilinear = fit(&fishing(), FitMethod::Bilinear);
    let least_squares = fit(&fishing(), FitMethod::LeastSquares(printed_settings()));
    for [x, z, first, second] in PRINTED {
        let (a, b) = (at(&bilinear, x, z), at(&least_squares, x, z));
        println!("{x} {z}: {a:.4} ({first}), {b:.4} ({second})");
        assert!((a - first).abs() < 1e-10, "{x} {z}: {a}");
        assert!((b - second).abs() < 1e-3, "{x} {z}: {b}");
    }
    // An independent computation of the same least squares, to its four printed decimals.
    for ([x, z, ..], exact) in PRINTED.into_iter().zip([0.8797, 0.6538, 0.5147, 2.4697]) {
        assert!((at(&least_squares, x, z) - exact).abs() < 5.1e-5, "{x} {z}");
    }
    // Hat functions meet their data; 16 control points do not meet 20.
    assert!(bilinear.misfit().largest() < 1e-12 && bilinear.misfit().given == 20);
    let misfit = least_squares.misfit();
    assert!((misfit.rms - 0.0163).abs() < 5e-5 && (misfit.largest() - 0.044).abs() < 5e-4, "{misfit:?}");
    // The normal equations: residuals are orthogonal to every control point, and so to a constant and to u.
    let moment = |f: &dyn Fn(usize, usize) -> f64| -> f64 {
        least_squares.cells.iter().map(|c| c.residual.unwrap() * f(c.station, c.waterline)).sum()
    };
    assert!(moment(&|_, _| 1.0).abs() < 1e-12 && moment(&|i, j| (i * j * j) as f64).abs() < 1e-10);
}

/// y = x^2 + z^2 on the unit grid: nothing at the nodes, 1/4 in the middle of an edge, 1/2 in the middle of a cell,
/// exactly.
#[test]
fn hat_functions_over_a_paraboloid() {
    let lines: Vec<f64> = (0..=50).map(f64::from).collect();
    let square = |x: f64, z: f64| x * x + z * z;
    let fitted = fit(&table(&lines, &lines, |i, j| square(i as f64, j as f64)), FitMethod::Bilinear);
    assert!(fitted.misfit().largest() < 1e-9 && fitted.misfit().given == 51 * 51);
    let surface = fitted.hull.surface();
    for i in 0..50 {
        for j in 0..50 {
            let (x, z) = (f64::from(i), f64::from(j));
            for (dx, dz, error) in [(0.0, 0.0, 0.0), (0.5, 0.0, 0.25), (0.0, 0.5, 0.25), (0.5, 0.5, 0.5)] {
                let found = surface.eval(x + dx, z + dz);
                assert!(found[0] - (x + dx) == 0.0 && found[2] - (z + dz) == 0.0);
                assert!(found[1] - square(x + dx, z + dz) - error == 0.0, "{x} {z} {dx} {dz} {found:?}");
            }
        }
    }
}

/// A point of the uniform bicubic patch over 4 x 4 vertices: [t^3 t^2 t 1] M_s [V] M_s^T [s^3 s^2 s 1]^T.
fn patch(v: &[[f64; 4]; 4], t: f64, s: f64) -> f64 {
    let m = [[-1.0, 3.0, -3.0, 1.0], [3.0, -6.0, 3.0, 0.0], [-3.0, 0.0, 3.0, 0.0], [1.0, 4.0, 1.0, 0.0]];
    let weights = |t: f64| -> [f64; 4] {
        let powers = [t * t * t, t * t, t, 1.0];
        std::array::from_fn(|k| (0..4).map(|r| powers[r] * m[r][k] / 6.0).sum())
    };
    let (a, b) = (weights(t), weights(s));
    (0..4).map(|i| (0..4).map(|j| a[i] * v[i][j] * b[j]).sum::<f64>()).sum()
}

/// 0, 0, 0, 1, .., n - 1, n - 1, n - 1 with the vertices of `triple` three times.
fn tripled(n: usize, triple: &[usize]) -> Vec<usize> {
    (0..n).flat_map(|k| vec![k; if k == 0 || k + 1 == n || triple.contains(&k) { 3 } else { 1 }]).collect()
}

#[test]
fn the_uniform_bicubic_surface_is_that_of_its_basis_matrix() {
    for knuckles in [vec![], vec![1.3]] {
        let columns: Vec<usize> = knuckles.iter().map(|_| 1).collect();
        let settings = UniformBicubic { knuckle_waterlines: knuckles, knuckle_stations: vec![] };
        let fitted = fit(&fishing(), FitMethod::UniformBicubic(settings));
        let surface = fitted.hull.surface();
        let (rows, columns) = (tripled(5, &[]), tripled(4, &columns));
        for i in 0..rows.len() - 3 {
            for j in 0..columns.len() - 3 {
                let vertices = |f: &dyn Fn(usize, usize) -> f64| -> [[f64; 4]; 4] {
                    std::array::from_fn(|a| std::array::from_fn(|b| f(rows[i + a], columns[j + b])))
                };
                let nets =
                    [vertices(&|a, _| FISHING_X[a]), vertices(&|a, b| FISHING_Y[a][b]), vertices(&|_, b| FISHING_Z[b])];
                for (t, s) in [(0.0, 0.0), (0.3, 0.8), (0.5, 0.5), (0.95, 0.1)] {
                    let found = surface.eval(i as f64 + t, j as f64 + s);
                    let exact = nets.each_ref().map(|net| patch(net, t, s));
                    assert!((0..3).all(|d| (found[d] - exact[d]).abs() < 1e-13), "{i} {j}: {found:?} {exact:?}");
                }
            }
        }
    }
}

/// Border curves depend on border vertices only, the corners are met, and inner cells are not.
#[test]
fn borders_of_the_uniform_bicubic_surface() {
    let method = || FitMethod::UniformBicubic(UniformBicubic::default());
    let fitted = fit(&fishing(), method());
    let moved =
        fit(&table(&FISHING_X, &FISHING_Z, |i, j| FISHING_Y[i][j] + f64::from(u8::from(i == 2 && j == 1))), method());
    let (u, v) = (fitted.hull.surface().u().domain().1, fitted.hull.surface().v().domain().1);
    for k in 0..=20 {
        let t = f64::from(k) / 20.0;
        for (a, b) in [(t * u, 0.0), (t * u, v), (0.0, t * v), (u, t * v)] {
            let pair = [&fitted, &moved].map(|f| f.hull.surface().eval(a, b)[1]);
            assert!((pair[0] - pair[1]).abs() < 1e-15, "{a} {b} {pair:?}");
        }
    }
    assert!((at(&moved, 4.2, 1.3) - at(&fitted, 4.2, 1.3)).abs() > 0.1);
    for (i, j) in [(0, 0), (0, 3), (4, 0), (4, 3)] {
        assert!((at(&fitted, FISHING_X[i], FISHING_Z[j]) - FISHING_Y[i][j]).abs() < 1e-13);
    }
    let misfit = fitted.misfit();
    assert!(misfit.given == 20 && (0.01..0.5).contains(&misfit.largest()), "{misfit:?}");
}

/// With a tripled row, the surface is the two surfaces of its two sides, which share the curve of that row; the tangent
/// breaks.
#[test]
fn two_surfaces_joined_along_a_knuckle() {
    let settings = UniformBicubic { knuckle_waterlines: vec![1.3], knuckle_stations: vec![] };
    let whole = fit(&fishing(), FitMethod::UniformBicubic(settings));
    let part = |from: usize, to: usize| {
        let cut = table(&FISHING_X, &FISHING_Z[from..=to], |i, j| FISHING_Y[i][from + j]);
        fit(&cut, FitMethod::UniformBicubic(UniformBicubic::default()))
    };
    let (lower, upper) = (part(0, 1), part(1, 3));
    for k in 0..=42 {
        let x = 0.2 * f64::from(k);
        for z in [0.7, 0.9, 1.25, 1.3] {
            assert!((at(&whole, x, z) - at(&lower, x, z)).abs() < 1e-11, "{x} {z}");
        }
        for z in [1.3, 1.31, 1.8, 2.5] {
            assert!((at(&whole, x, z) - at(&upper, x, z)).abs() < 1e-11, "{x} {z}");
        }
    }
    // The slopes dy/dz on the two sides are those of the legs of the net that end in the knuckle.
    let slope = |a: f64, b: f64| (at(&whole, 0.0, b) - at(&whole, 0.0, a)) / (b - a);
    let legs = [(FISHING_Y[0][1] - FISHING_Y[0][0]) / 0.6, (FISHING_Y[0][2] - FISHING_Y[0][1]) / 0.6];
    assert!((slope(1.299, 1.3) - legs[0]).abs() < 1e-9 && (slope(1.3, 1.301) - legs[1]).abs() < 1e-9);
    assert!((legs[0] - legs[1]).abs() > 1.0);
}

/// Values of the functions of order k over knots by the recurrence of Cox and de Boor, written out.
fn cox_de_boor(knots: &[f64], i: usize, k: usize, t: f64) -> f64 {
    if k == 1 {
        return f64::from(u8::from(knots[i] <= t && t < knots[i + 1]));
    }
    let part = |above: f64, below: f64, f: f64| if below > 0.0 { above / below * f } else { 0.0 };
    part(t - knots[i], knots[i + k - 1] - knots[i], cox_de_boor(knots, i, k - 1, t))
        + part(knots[i + k] - t, knots[i + k] - knots[i + 1], cox_de_boor(knots, i + 1, k - 1, t))
}

#[test]
fn the_quadratic_net_has_the_knots_of_the_thesis() {
    let fitted = fit(&fishing(), FitMethod::QuadraticNet(QuadraticNet::default()));
    let surface = fitted.hull.surface();
    let scaled = |knots: &[f64]| -> Vec<f64> { knots.iter().map(|t| (t * 1e9).round() / 1e9).collect() };
    assert_eq!(scaled(surface.u().knots()), [0., 0., 0., 1., 2., 3., 3., 3.]);
    assert_eq!(scaled(surface.v().knots()), [0., 0., 0., 1., 2., 2., 2.]);
    let (u, v) = (1.3, 0.4);
    let mut exact = 0.0;
    for (i, row) in FISHING_Y.iter().enumerate() {
        for (j, y) in row.iter().enumerate() {
            exact += y
                * cox_de_boor(&[0., 0., 0., 1., 2., 3., 3., 3.], i, 3, u)
                * cox_de_boor(&[0., 0., 0., 1., 2., 2., 2.], j, 3, v);
        }
    }
    assert!((surface.eval(u, v)[1] - exact).abs() < 1e-14);
    assert!((at(&fitted, 0.0, 0.7) - 0.89).abs() < 1e-14 && (at(&fitted, 8.4, 2.5) - 1.045).abs() < 1e-14);
    assert!(fitted.misfit().largest() > 0.01);
}

#[test]
fn a_split_quadratic_net_is_two_surfaces() {
    let xs: Vec<f64> = (0..7).map(|k| f64::from(k * k)).collect();
    let y = |i: usize, j: usize| 1.0 + (i as f64).sin() + 0.3 * (j * j) as f64;
    for knots in [NetKnots::OpenUniform, NetKnots::Midpoints] {
        let settings = |split: &[f64]| FitMethod::QuadraticNet(QuadraticNet { knots, split_stations: split.to_vec() });
        let whole = fit(&table(&xs, &FISHING_Z, y), settings(&[9.0]));
        let aft = fit(&table(&xs[..4], &FISHING_Z, y), settings(&[]));
        let fore = fit(&table(&xs[3..], &FISHING_Z, |i, j| y(i + 3, j)), settings(&[]));
        for k in 0..=36 {
            let x = f64::from(k);
            let part = if x <= 9.0 { &aft } else { &fore };
            assert!((at(&whole, x, 1.7) - at(part, x, 1.7)).abs() < 1e-11, "{knots:?} {x}");
        }
        let knots_of_aft = aft.hull.surface().u().knots().to_vec();
        let expected = if knots == NetKnots::Midpoints { 2.5 } else { 1.0 };
        assert!((knots_of_aft[3] - expected).abs() < 1e-12, "{knots_of_aft:?}");
    }
}

/// The hemisphere of radius 6 by azimuths of 22.5 and altitudes of 10 degrees, interpolated as in 1999: the thesis
/// prints Gaussian curvatures from 0.026 to 0.029, where 1/36 is exact. An independent computation has 0.02596 to
/// 0.02874 and the mean 0.02776 at the inner points of 60 equal parts of the parameters up to 0.9 of the altitude.
#[test]
fn the_hemisphere_of_1999() {
    let on_sphere = |i: i32, j: i32| {
        let (a, h) = ((22.5 * f64::from(i)).to_radians(), (10.0 * f64::from(j)).to_radians());
        [a.cos() * h.cos(), a.sin() * h.cos(), h.sin()].map(|c| 6.0 * c)
    };
    let grid: Vec<[f64; 3]> =
        (0..17).flat_map(|i| (0..10).map(move |j| (i, j))).map(|(i, j)| on_sphere(i, j)).collect();
    let surface = BsplineSurface::through_grid([2, 2], Parametrization::ChordLength, 10, &grid).unwrap();
    let (mut low, mut high, mut sum, mut count) = (f64::INFINITY, 0.0f64, 0.0, 0.0);
    let mut radius = 0.0f64;
    for i in 1..60 {
        for j in 1..54 {
            let jet = surface.jet(f64::from(i) / 60.0, f64::from(j) / 60.0);
            let k = jet.curvature().unwrap().gaussian;
            (low, high, sum, count) = (low.min(k), high.max(k), sum + k, count + 1.0);
            radius = radius.max((jet.point.iter().map(|c| c * c).sum::<f64>().sqrt() - 6.0).abs());
        }
    }
    println!("{low:.5} to {high:.5}, mean {:.5}, radius within {radius:.4}", sum / count);
    assert!((low - 0.02596).abs() < 5.1e-6 && (high - 0.02874).abs() < 5.1e-6, "{low} {high}");
    assert!((sum / count - 0.02776).abs() < 5.1e-6, "{}", sum / count);
    assert_eq!([low, high].map(|k| format!("{k:.3}")), ["0.026", "0.029"]);
    assert!(radius < 0.0024);
}

/// The same through the table of offsets of the hemisphere: the volume is 2/3 pi R^3 but for the cap below the lowest
/// waterline.
#[test]
fn the_hemisphere_as_a_hull() {
    let job = read_fit(&carried("configs/methods").join("seed004-hemisphere.toml"), None, None).unwrap();
    let fitted = Hull::fit(&job.table, &job.method.method).unwrap();
    let volume = CurvesOfForm::new(&fitted.hull, &[6.0], &Conventions::default()).rows[0].displacement_volume;
    let exact = 144.0 * std::f64::consts::PI;
    println!("volume {volume:.3} of {exact:.3}; {:?}", fitted.misfit());
    assert!((volume / exact - 1.0).abs() < 0.005, "{volume}");
    assert!(fitted.misfit().largest() < 0.06, "{:?}", fitted.misfit());
    // Waterlines end in the given ends.
    for (z, [stern, stem]) in job.table.waterlines.iter().zip(&job.table.endings) {
        let found = fitted.hull.endings(*z).unwrap();
        assert!((found[0] - stern.unwrap()).abs() < 0.02 && (found[1] - stem.unwrap()).abs() < 0.02, "{z} {found:?}");
    }
}

/// Every file of the folder runs by itself; its first line says what it shows; what it makes is a hull with numbers.
#[test]
fn every_method_file_runs() {
    let mut files: Vec<PathBuf> =
        fs::read_dir(carried("configs/methods")).unwrap().map(|e| e.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|e| e == "toml"));
    files.sort();
    assert!(files.len() >= 9);
    let mut kinds = Vec::new();
    for path in &files {
        let name = path.display();
        let first = read_text(path).lines().next().unwrap().to_owned();
        assert!(first.starts_with("# ") && first.len() > 20 && first.ends_with('.'), "{name}: {first}");
        let job = read_fit(path, None, None).unwrap_or_else(|e| panic!("{e}"));
        kinds.push(job.method.method.as_str());
        let outputs = fit_outputs(&job, &[]).unwrap_or_else(|e| panic!("{name}: {e}"));
        let misfit = outputs.fitted.misfit();
        let volume = outputs.estimate.volume;
        println!("{name}: V {volume:.3} max {:.4} rms {:.4}", misfit.largest(), misfit.rms);
        assert!(volume > 0.0 && misfit.given >= 20);
        assert_eq!(outputs.design_row.is_some(), job.method.stated.draught.is_some(), "{name}");
        let given = job.table.stations.iter().flat_map(|s| &s.half_breadths).filter(|c| c.value().is_some()).count();
        assert_eq!(misfit.given, given, "{name}");
        if job.method.method == FitMethod::Bilinear {
            assert!(misfit.largest() < 1e-12, "{name}");
        }
    }
    for method in FitMethod::all() {
        assert!(kinds.contains(&method.as_str()), "no file shows {}", method.as_str());
    }
}

/// Series 60 through each method: hat functions give the volume of the trapezoidal rule exactly, the others come near the
/// published block coefficient 0.600 as their kind allows.
#[test]
fn volumes_of_series_60() {
    let job = read_fit(&carried("configs/methods").join("seed001-uniform-bicubic.toml"), None, None).unwrap();
    let t = &job.table;
    let block = 121.92 * 16.256 * 6.5024;
    let volume = |method: FitMethod| {
        let fitted = fit(t, method);
        CurvesOfForm::new(&fitted.hull, &[6.5024], &Conventions::default()).rows[0].displacement_volume
    };
    let steps = |lines: &[f64]| -> Vec<f64> {
        let step = |k: usize| if k == 0 || k == lines.len() { 0.0 } else { lines[k] - lines[k - 1] };
        (0..lines.len()).map(|k| 0.5 * (step(k) + step(k + 1))).collect()
    };
    let xs: Vec<f64> = t.stations.iter().map(|s| s.station.x).collect();
    let below = t.waterlines.iter().filter(|z| **z < 6.51).count();
    let (wx, wz) = (steps(&xs), steps(&t.waterlines[..below]));
    let mut trapezoid = 0.0;
    for (station, wx) in t.stations.iter().zip(&wx) {
        for (cell, wz) in station.half_breadths.iter().zip(&wz) {
            trapezoid += 2.0 * wx * wz * cell.value().unwrap();
        }
    }
    let bilinear = volume(FitMethod::Bilinear);
    assert!((bilinear / trapezoid - 1.0).abs() < 1e-12, "{bilinear} {trapezoid}");
    let ranges = [
        (FitMethod::Bilinear, 0.593, 0.594),
        (FitMethod::LeastSquares(LeastSquares::default()), 0.590, 0.605),
        (FitMethod::UniformBicubic(UniformBicubic::default()), 0.575, 0.600),
        (FitMethod::QuadraticNet(QuadraticNet::default()), 0.575, 0.600),
        (FitMethod::ParametricStations(ParametricStations::default()), 0.594, 0.602),
    ];
    for (method, low, high) in ranges {
        let word = method.as_str();
        let cb = volume(method) / block;
        println!("{word}: {cb:.4}");
        assert!((low..high).contains(&cb), "{word}: {cb}");
    }
}

/// What a table leaves blank is filled as documented, and said.
#[test]
fn blank_and_unknown_cells() {
    let blank = |i: usize, j: usize| match (i, j) {
        (0, 0) | (4, _) | (2, 3) => f64::NAN,
        _ => FISHING_Y[i][j],
    };
    let mut t = table(&FISHING_X, &FISHING_Z, blank);
    t.stations[1].half_breadths[2].entry = Entry::Unknown;
    let fitted = fit(&t, FitMethod::Bilinear);
    assert!(at(&fitted, 0.0, 0.7).abs() < 1e-15 && at(&fitted, 8.4, 1.9).abs() < 1e-15);
    assert!((at(&fitted, 4.2, 2.5) - FISHING_Y[2][2]).abs() < 1e-14, "the highest offset is carried up");
    let middle = 0.5 * (FISHING_Y[0][2] + FISHING_Y[2][2]);
    assert!((at(&fitted, 2.1, 1.9) - middle).abs() < 1e-14);
    let misfit = fitted.misfit();
    assert_eq!((misfit.given, misfit.predicted), (13, 1));
    let notes = fitted.notes.join("\n");
    for words in
        ["5 blank cells below the hull", "1 blank cells above", "1 unknown cells", "Lpp is not stated: 8.400 m"]
    {
        assert!(notes.contains(words), "{words}: {notes}");
    }
    let surface = fitted.surface_table(&t);
    assert!((surface.stations[1].half_breadths[2].value().unwrap() - middle).abs() < 1e-14);
    assert!(surface.stations[4].half_breadths.iter().all(|c| c.value().is_none()));
}

fn refused(table: &OffsetTable, method: FitMethod) -> String {
    Hull::fit(table, &method).unwrap_err().to_string()
}

#[test]
fn what_cannot_be_fitted_is_said() {
    let t = fishing();
    let says = |found: String, expected: &str| assert!(found.contains(expected), "{found}\n{expected}");
    let least = |change: &dyn Fn(&mut LeastSquares)| {
        let mut settings = printed_settings();
        change(&mut settings);
        refused(&t, FitMethod::LeastSquares(settings))
    };
    says(
        least(&|s| s.control_points = [Some(6), Some(2)]),
        "control_points_along: 6 control points of order 3 for 5 stations. Expected 3 to 5.; control_points_up: 2 control",
    );
    says(least(&|s| s.orders[0] = 9), "order_along: the order is 9. Orders are 2 to 8.");
    says(
        least(&|s| s.parameters[1] = Some(vec![1.0])),
        "parameters_up: 1 parameters for 4 waterlines. Give one for each",
    );
    says(least(&|s| s.parameters[0] = Some(vec![3., 4., 5., 6., 8.])), "parameters_along: 8 is outside the knots. The");
    says(least(&|s| s.parameters[0] = Some(vec![3., 4., 4., 6., 7.])), "parameters_along: data site 2 (4): not above");
    says(least(&|s| s.parameters[0] = Some(vec![3., 3.1, 3.2, 3.3, 3.4])), "parameters_along: the data sites do not");
    says(least(&|s| s.knots[0] = Some(vec![0.0; 3])), "knots_along: 3 knots. 4 control points of order 3 need 7.");
    says(
        least(&|s| s.knots[1] = Some(vec![2., 2., 2., 6., 5., 8., 10.])),
        "knots_up: knot 4 (5): smaller than the knot",
    );
    let uniform = UniformBicubic { knuckle_waterlines: vec![1.5], knuckle_stations: vec![9.0] };
    says(
        refused(&t, FitMethod::UniformBicubic(uniform)),
        "knuckle_stations: no line of the table is at 9 m. The nearest is at 8.4 m.; knuckle_waterlines: no line",
    );
    let net =
        |split: f64| FitMethod::QuadraticNet(QuadraticNet { split_stations: vec![split], ..QuadraticNet::default() });
    says(refused(&t, net(2.1)), "split_stations: 2 stations from 0 m to 2.1 m. Each part needs three");
    says(refused(&t, net(2.2)), "split_stations: no line of the table is at 2.2 m. The nearest is at 2.1 m.");
    let stations = ParametricStations { order: 1, parts_along: Some(0), parts_up: Some(2000), ..Default::default() };
    says(
        refused(&t, FitMethod::ParametricStations(stations)),
        "order: the order is 1. Orders are 2 to 8.; parts_along: 0 parts. Expected 1 to 1000.; parts_up: 2000 parts",
    );
    let narrow = table(&FISHING_X, &FISHING_Z, |i, j| if j == 0 && i > 0 { f64::NAN } else { FISHING_Y[i][j] });
    says(
        refused(&narrow, FitMethod::ParametricStations(ParametricStations::default())),
        "kind: the waterline at 0.7 m has 1 point, its ends counted. Each waterline needs two",
    );
    let one = table(&FISHING_X, &FISHING_Z[..1], |i, j| FISHING_Y[i][j]);
    assert_eq!(
        Hull::fit(&one, &FitMethod::Bilinear).unwrap_err(),
        FitError::TooFew { stations: 5, waterlines: 1, least: 2 }
    );
    says(refused(&one, FitMethod::Bilinear), "5 stations with 1 waterline; a surface needs at least 2 of each");
    let mut small = fishing();
    small.stated.breadth = Some(0.1);
    says(refused(&small, FitMethod::Bilinear), "half-breadths of the net, row 0, column 1: 2.36 m; with B 0.1 m");
}

fn method_file(name: &str) -> String {
    carried("configs/methods").join(name).display().to_string()
}

#[test]
fn fit_writes_its_files_and_a_page() {
    let folder = folder("fit");
    let path = folder.join("nubs");
    let target = path.to_str().unwrap();
    let method = method_file("seed000-least-squares.toml");
    let output = program(&["fit", &method, "--draught", "1.9", "-o", target]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let page = stdout(&output);
    println!("{page}");
    assert!(page.lines().all(|line| line.chars().count() <= 80), "{page}");
    for words in ["least-squares, level chart", "20 cells, missed by 0.04", "0.0163 m RMS", "DISPVOL", "manifest.json"]
    {
        assert!(page.contains(words), "{words}: {page}");
    }
    let names = names_in(&path);
    let expected = [
        "diagram-sheet.png",
        "fit.json",
        "hull.json",
        "hydrostatics.csv",
        "hydrostatics.png",
        "lines.png",
        "manifest.json",
        "offsets.csv",
        "residuals.csv",
        "sectional-area.png",
        "sections.svg",
    ];
    assert_eq!(names, expected);
    let read = |name: &str| read_text(path.join(name));
    let fit = json(read("fit.json"));
    assert_eq!((fit["method"].as_str(), fit["chart"].as_str()), (Some("least-squares"), Some("level")));
    assert!((fit["cells"]["rms"].as_f64().unwrap() - 0.0163).abs() < 5e-5 && fit["cells"]["given"] == 20);
    assert_eq!(fit["inputs"][1]["file"], "seed000-fishing-vessel.csv");
    let residuals = read("residuals.csv");
    assert_eq!(residuals.lines().next().unwrap(), "station,x [m],waterline [m],table [m],surface [m],residual [m]");
    assert_eq!(residuals.lines().count(), 21);
    for line in residuals.lines().skip(1) {
        let cells: Vec<f64> = line.rsplit(',').take(3).map(|c| c.parse().unwrap()).collect();
        assert!((cells[1] - cells[2] - cells[0]).abs() < 1e-12, "{line}");
    }
    // The surface at the cells, in the shape of the table.
    let offsets = read("offsets.csv");
    assert_eq!(offsets.lines().count(), 6, "{offsets}");
    let first: f64 = offsets.lines().nth(1).unwrap().split(',').nth(1).unwrap().parse().unwrap();
    assert!((first - 0.89).abs() < 0.05 && (first - 0.89).abs() > 1e-4, "{first}");
    // The hull is one for the other commands.
    let hydro = program(&["hydro", target, "--draughts", "1.9", "--json"]);
    let rows = json(&hydro.stdout);
    let (a, b) = (rows["rows"][0]["DISPVOL"].as_f64().unwrap(), fit["design"]["DISPVOL"].as_f64().unwrap());
    assert!((a - b).abs() < 1e-9 * b, "{a} {b}");
    // The same bytes again, and nothing overwritten without being told.
    let again = folder.join("again");
    let output = program(&["fit", &method, "--draught", "1.9", "-o", again.to_str().unwrap(), "-q"]);
    assert!(output.status.success() && output.stdout.is_empty());
    let read = |name: &str| read_text(again.join(name));
    assert_eq!(read("residuals.csv"), residuals);
    let output =
        program(&["fit", &method_file("seed000-bilinear.toml"), "-o", again.to_str().unwrap(), "--no-figures"]);
    assert_eq!(output.status.code(), Some(6));
    assert!(stderr(&output).contains("E601"));
}

#[test]
fn a_table_with_a_method_and_a_draught() {
    let path = folder("draught");
    let table = method_file("seed000-fishing-vessel.csv");
    for method in ["bilinear", &method_file("seed000-bilinear.toml")] {
        let target = path.to_str().unwrap();
        let arguments =
            ["fit", &table, "--method", method, "--draught", "1.3", "-o", target, "--no-figures", "--json", "--force"];
        let output = program(&arguments);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let fit = json(&output.stdout);
        assert_eq!((fit["method"].as_str(), fit["particulars"]["T"].as_f64()), (Some("bilinear"), Some(1.3)));
        assert_eq!(fit["inputs"][0]["file"], "seed000-fishing-vessel.csv");
        // The trapezoidal rule over the lower cell row.
        let area: f64 = FISHING_Y.iter().zip([1.05, 2.1, 2.1, 2.1, 1.05]).map(|(y, w)| w * 0.6 * (y[0] + y[1])).sum();
        assert!((fit["design"]["DISPVOL"].as_f64().unwrap() - area).abs() < 1e-10, "{area}");
    }
}

#[test]
fn messages_of_fit() {
    let path = folder("messages");
    let write = |name: &str, text: &str| path.write(name, text);
    let says = |arguments: &[&str], code: i32, words: &[&str]| {
        let mut all = vec!["fit"];
        all.extend(arguments);
        let target = path.join("out").display().to_string();
        all.extend(["-o", &target]);
        let output = program(&all);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(code), "{message}");
        assert!(words.iter().all(|word| message.contains(word)), "{words:?}: {message}");
        assert!(!path.join("out").exists());
    };
    let grid = method_file("seed000-fishing-vessel.csv");
    let alone = write("alone.toml", "[method]\nkind = \"bilinear\"\n");
    says(&[&alone], 3, &["E161", "alone.toml", "the file names no table", "fit TABLE --method FILE"]);
    says(&[&alone, "--method", "graded"], 2, &["is a method file already", "--method graded says it twice"]);
    says(&[&grid, "--method", "bilinaer"], 2, &["'bilinaer' is neither a file nor one of graded, bilinear"]);
    says(&[&grid, "--method", "absent.toml"], 6, &["E602", "absent.toml"]);
    let wrong =
        write("wrong.toml", "[method]\nkind = \"least-squares\"\ncontrol_points_up = 9\nknots_along = [0, 1]\n");
    says(
        &[&grid, "--method", &wrong],
        3,
        &["E160", "wrong.toml:3:1 method.control_points_up: 9 control points", "wrong.toml:4:1 method.knots_along: "],
    );
    let unknown = write("unknown.toml", "[method]\nkindd = \"bilinear\"\n");
    says(
        &[&unknown],
        3,
        &["E121", "unknown.toml:2:1 method.kindd is not a key of a method. Did you mean kind?", "E125"],
    );
    let narrow = write("narrow.toml", "[dimensions]\nB = 0.1\n[method]\nkind = \"bilinear\"\n");
    says(
        &[&grid, "--method", &narrow],
        3,
        &["E163", "the bilinear surface over this table is no hull", "with B 0.1 m"],
    );
    let line = write("line.csv", "x\\z [m],1,2,3\n0,1,1.5,2\n");
    says(&[&line, "--method", "quadratic-net"], 3, &["line.csv"]);
    let missing = write("missing.toml", "table = \"no.csv\"\n[method]\nkind = \"bilinear\"\n");
    says(&[&missing], 6, &["E602", "no.csv"]);
}
