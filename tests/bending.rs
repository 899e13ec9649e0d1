//! The bending energy of a surface: closed forms, its derivatives, and its least value within the rows of a fairing
//! program.

use loftsman::fairing::bending::bending_energy;
use loftsman::fairing::least_bending::least_bending;
use loftsman::qp::{Settings, SparseRows};
use loftsman::spline::{BsplineSurface, KnotVector};
use rand::{RngExt, SeedableRng, rngs::StdRng};

use crate::qp_problems::{fairing, unbent};

/// Control values of the square of a linear function a + b t on the Greville points of a cubic or higher spline: its
/// blossom.
fn squares(knots: &KnotVector) -> Vec<[f64; 3]> {
    let p = knots.degree();
    let all = knots.knots();
    let count = knots.basis_count();
    let own = (0..count).map(|i| {
        let t = &all[i + 1..=i + p];
        let sum: f64 = t.iter().sum();
        let pairs: f64 = (0..p).flat_map(|j| (j + 1..p).map(move |k| t[j] * t[k])).sum();
        [1.0, sum / p as f64, pairs / (p * (p - 1) / 2) as f64]
    });
    own.collect()
}

/// y = (c0 + c1 x + c2 z)^2 over [0, length] x [0, height], exactly.
fn cylinder([length, height]: [f64; 2], [c0, c1, c2]: [f64; 3]) -> BsplineSurface<3> {
    let knots = [KnotVector::uniform(3, 20).unwrap(), KnotVector::uniform(4, 24).unwrap()];
    let (along, up) = (squares(&knots[0]), squares(&knots[1]));
    let mut points = Vec::new();
    for [_, u, uu] in along {
        for &[_, v, vv] in &up {
            let (x, z, xx, zz) = (length * u, height * v, length * length * uu, height * height * vv);
            let y = c0 * c0 + 2.0 * c0 * (c1 * x + c2 * z) + c1 * c1 * xx + 2.0 * c1 * c2 * x * z + c2 * c2 * zz;
            points.push([x, y, z]);
        }
    }
    BsplineSurface::new(knots[0].clone(), knots[1].clone(), points).unwrap()
}

/// int of kappa^2 ds of the parabola y = a z^2 from 0 to h: 4 a^2 int (1 + 4 a^2 z^2)^(-5/2) dz.
fn parabola(a: f64, h: f64) -> f64 {
    let square = (2.0 * a * h).powi(2);
    4.0 * a * a * h * (3.0 + 2.0 * square) / (3.0 * (1.0 + square).powf(1.5))
}

#[test]
fn a_parabolic_cylinder_has_the_energy_of_its_parabola() {
    for a in [0.02, 0.3, 1.0] {
        let (length, height) = (7.0, 2.0);
        let upright = bending_energy(&cylinder([length, height], [0.0, 0.0, f64::sqrt(a)])).unwrap();
        let lying = bending_energy(&cylinder([height, length], [0.0, f64::sqrt(a), 0.0])).unwrap();
        let exact = length * parabola(a, height);
        println!("{a}: {exact} {upright} {lying}");
        assert!((upright / exact - 1.0).abs() < 1e-10 && (lying / exact - 1.0).abs() < 1e-7);
    }
}

/// Cylinders whose generators run obliquely: k2 = 0, k1 that of the parabola across them, dA = W dx dz.
#[test]
fn an_oblique_cylinder_bends_across_its_generators_only() {
    let (b, c): (f64, f64) = (0.3, 0.4);
    let size = b.hypot(c);
    let found = bending_energy(&cylinder([3.0, 2.0], [0.1, b, c])).unwrap();
    let rule = loftsman::numeric::gauss_legendre(24);
    let mut exact = 0.0;
    for (x, dx) in rule.on(0.0, 3.0) {
        for (z, dz) in rule.on(0.0, 2.0) {
            // In the plane across the generators: y = w^2, w = 0.1 + size s; slope and second derivative by s.
            let slope = 2.0 * (0.1 + b * x + c * z) * size;
            exact += (2.0 * size * size).powi(2) / (1.0 + slope * slope).powf(2.5) * dx * dz;
        }
    }
    println!("{found} {exact}");
    assert!((found / exact - 1.0).abs() < 1e-9);
}

/// A net over a chart that is not rectangular.
fn bumpy(seed: u64) -> BsplineSurface<3> {
    let mut rng = StdRng::seed_from_u64(seed);
    let knots = [KnotVector::uniform(3, 4).unwrap(), KnotVector::uniform(3, 3).unwrap()];
    let mut points = Vec::new();
    for u in knots[0].greville() {
        for v in knots[1].greville() {
            let x = 10.0 * u + 2.0 * v * v + 0.3 * u * v;
            let z = 4.0 * v + 0.5 * u;
            points.push([x, rng.random_range(0.0..2.0), z]);
        }
    }
    BsplineSurface::new(knots[0].clone(), knots[1].clone(), points).unwrap()
}

fn with(surface: &BsplineSurface<3>, y: &[f64]) -> BsplineSurface<3> {
    let points = surface.points().iter().zip(y).map(|(p, &y)| [p[0], y, p[2]]).collect();
    BsplineSurface::new(surface.u().clone(), surface.v().clone(), points).unwrap()
}

fn half_breadths(surface: &BsplineSurface<3>) -> Vec<f64> {
    surface.points().iter().map(|point| point[1]).collect()
}

/// F by the half-breadths, by central differences of the fourth order.
fn slope(surface: &BsplineSurface<3>, y: &[f64], i: usize) -> f64 {
    let at = |step: f64| {
        let mut moved = y.to_vec();
        moved[i] += step;
        bending_energy(&with(surface, &moved)).unwrap()
    };
    let h = 1e-3;
    (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h)
}

#[test]
fn a_folded_chart_has_no_energy() {
    let surface = bumpy(3);
    let points = surface.points().iter().map(|p| [(p[0] - 4.0).powi(2), p[1], p[2]]).collect();
    let folded = BsplineSurface::new(surface.u().clone(), surface.v().clone(), points).unwrap();
    assert!(bending_energy(&surface).is_some() && bending_energy(&folded).is_none());
}

/// At the end the gradient of the true functional, by differences, is balanced by the multipliers of the rows; the rows
/// hold, no step raised the energy, and no point between it and others that keep the rows is better.
#[test]
fn the_least_energy_is_stationary_within_the_rows() {
    let net = [14, 10];
    let problem = fairing([21, 11], net, 5);
    let n = net[0] * net[1];
    let start = problem.solve(&Settings::default()).unwrap().x;
    let (surface, rest) = unbent(&problem, net, &start);
    let free: Vec<usize> = (0..n).collect();
    let found = least_bending(&surface, &rest, 1.0, &free, true, &Settings::default()).unwrap().unwrap();
    println!("{:?}, {} programs, promised {:e}", found.energies, found.programs, found.promised);
    assert!(found.programs <= 8 && found.promised.abs() <= 1e-10);
    assert!(found.energies.windows(2).all(|pair| pair[1] <= pair[0] * (1.0 + 1e-12)));
    assert!(found.energies[found.energies.len() - 1] < 0.99 * found.energies[0]);
    let held = rest.rows.apply(&found.net);
    for (k, value) in held.iter().enumerate() {
        assert!(rest.lower[k] - 1e-10 <= *value && *value <= rest.upper[k] + 1e-10, "row {k}: {value}");
    }
    let pull = rest.rows.apply_transposed(&found.solution.multipliers);
    let scale = pull.iter().fold(0.0_f64, |most, pull| most.max(pull.abs()));
    for (i, pull) in pull.iter().enumerate() {
        let left = slope(&surface, &found.net, i) + pull;
        assert!(left.abs() <= 1e-5 * scale, "{i}: {left:e} of {scale:e}");
    }
    let end = found.energies[found.energies.len() - 1];
    let mut rng = StdRng::seed_from_u64(1);
    for _ in 0..10 {
        // Another point that keeps the rows: the least of a random linear function with some of a square.
        let mut other = rest.clone();
        other.linear = (0..n).map(|_| rng.random_range(-1.0..1.0)).collect();
        other.quadratic = SparseRows::from_entries(n, n, &(0..n).map(|i| (i, i, 1.0)).collect::<Vec<_>>());
        let other = other.solve(&Settings::default()).unwrap().x;
        for part in [0.01, 0.1, 1.0] {
            let y: Vec<f64> = found.net.iter().zip(&other).map(|(a, b)| a + part * (b - a)).collect();
            assert!(bending_energy(&with(&surface, &y)).unwrap() >= end * (1.0 - 1e-9));
        }
    }
}

/// A start that breaks the rows is no start to compare with; on a chart that is not rectangular nothing else changes.
#[test]
fn oblique_charts_bend_least_as_well() {
    let surface = bumpy(8);
    let y = half_breadths(&surface);
    let n = y.len();
    let mut rows = SparseRows::new(n);
    (0..n).for_each(|i| rows.push([(i, 1.0)]));
    let quadratic = SparseRows::from_entries(n, n, &(0..n).map(|i| (i, i, 0.0)).collect::<Vec<_>>());
    let band = 0.1;
    let rest = loftsman::qp::Problem {
        quadratic,
        linear: vec![0.0; n],
        rows,
        lower: y.iter().map(|y| y - band).collect(),
        upper: y.iter().map(|y| y + band).collect(),
    };
    let free: Vec<usize> = (0..n).collect();
    let found = least_bending(&surface, &rest, 2.0, &free, true, &Settings::default()).unwrap().unwrap();
    let scale = found.solution.multipliers.iter().fold(0.0_f64, |most, z| most.max(z.abs()));
    for i in 0..n {
        let left = 2.0 * slope(&surface, &found.net, i) + found.solution.multipliers[i];
        assert!(left.abs() <= 1e-5 * scale, "{i}: {left:e} of {scale:e}");
    }
    let far: Vec<f64> = y.iter().map(|y| y + 1.0).collect();
    let again = least_bending(&with(&surface, &far), &rest, 2.0, &free, false, &Settings::default()).unwrap().unwrap();
    let [one, other] = [&found, &again].map(|found| found.energies[found.energies.len() - 1]);
    println!("{:?} {:?}", found.energies, again.energies);
    assert!((one / other - 1.0).abs() < 1e-6, "{one} {other}");
}
