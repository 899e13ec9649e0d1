use super::*;
use crate::hull::PrincipalParticulars;
use crate::spline::{BsplineCurve, BsplineSurface, Collocation, KnotVector};

/// A hull of L_PP, B, T and D from its net.
fn of_net(dimensions: [f64; 4], [u, v]: [KnotVector; 2], points: Vec<[f64; 3]>) -> Hull {
    let [length, breadth, draught, depth] = dimensions;
    let deck = vec![[-0.1 * length, depth], [1.1 * length, depth]];
    let deck = BsplineCurve::new(KnotVector::uniform(1, 1).unwrap(), deck).unwrap();
    let particulars =
        PrincipalParticulars { length_between_perpendiculars: length, breadth, draught: Some(draught), depth };
    Hull::new("test", particulars, BsplineSurface::new(u, v, points).unwrap(), deck).unwrap()
}

/// Wigley's hull of L 10 m, B/L 0.1, T/L 0.0625, exactly, as a bicubic net.
fn hull() -> Hull {
    let (u, v) = (KnotVector::uniform(3, 21).unwrap(), KnotVector::uniform(3, 11).unwrap());
    let (along, up) = (u.greville(), v.greville());
    let places: Vec<[f64; 2]> = along.iter().flat_map(|&a| up.iter().map(move |&b| [a, b])).collect();
    let mut breadths: Vec<f64> = places.iter().map(|[a, b]| 2.0 * a * (1.0 - a) * b * (2.0 - b)).collect();
    Collocation::new(&u, &along).unwrap().solve_tensor(&Collocation::new(&v, &up).unwrap(), &mut breadths);
    // Greville abscissae are the control values of the parameter itself.
    let points = places.iter().zip(&breadths).map(|([a, b], &y)| [10.0 * a, y, 0.625 * b]).collect();
    of_net([10.0, 1.0, 0.625, 0.625], [u, v], points)
}

/// A hull with raked ends over level waterlines, or with a rockered keel and round sections.
fn raked(rockered: bool) -> Hull {
    let (u, v) = (KnotVector::uniform(3, 21).unwrap(), KnotVector::uniform(3, 11).unwrap());
    let mut points = Vec::new();
    for &s in &u.greville() {
        for &t in &v.greville() {
            let (xi, height) = (2.0 * s - 1.0, t * t);
            let keel = 5.0 * xi * xi;
            points.push(if rockered {
                [100.0 * s + 4.0 * height * xi, 8.0 * (1.0 - xi * xi) * t, keel + (10.0 - keel) * height]
            } else {
                [100.0 * s + 4.0 * t * xi, 8.0 * (1.0 - xi * xi) * t * (2.0 - t), 10.0 * t]
            });
        }
    }
    of_net([100.0, 16.0, 6.0, 10.0], [u, v], points)
}

fn water() -> Water {
    Water { density: 999.1, viscosity: 1.1386e-6, gravity: 9.80665 }
}

fn speed(froude: f64) -> f64 {
    froude * (9.80665f64 * 10.0).sqrt()
}

/// 10^3 C_W = R_W / (rho U^2 S / 2), computed independently with 50 digits over closed forms; S = 0.14879063 L^2.
const REFERENCE: [(f64, f64); 20] = [
    (0.15, 0.361691),
    (0.18, 0.714010),
    (0.20, 0.887563),
    (0.22, 0.653582),
    (0.25, 1.063920),
    (0.267, 0.975509),
    (0.289, 1.986760),
    (0.30, 2.141667),
    (0.316, 1.831475),
    (0.32, 1.711057),
    (0.35, 1.247922),
    (0.354, 1.284483),
    (0.38, 1.971957),
    (0.40, 2.733929),
    (0.408, 3.029980),
    (0.45, 4.154258),
    (0.50, 4.517250),
    (0.60, 3.918409),
    (0.80, 2.595292),
    (1.0, 1.836361),
];

#[test]
fn wigley_from_medium_to_high_speed() {
    let (hull, water) = (hull(), water());
    let ship = ThinShip::new(&hull, 0.625).unwrap();
    assert!(ship.is_quadratic_form());
    for (froude, expected) in REFERENCE {
        let speed = speed(froude);
        let found = 1e3 * ship.wave_resistance(speed, &water) / (0.5 * 999.1 * speed * speed * 14.879063);
        // Six decimals were given.
        assert!((found - expected).abs() < 6e-7 + 1e-6 * expected, "{froude}: {found} {expected}");
    }
}

/// Resistances of an independent program with endpoint waves on contours of steepest descent \[N\].
#[test]
fn wigley_at_low_speed() {
    let (ship, water) = (ThinShip::new(&hull(), 0.625).unwrap(), water());
    for (froude, expected) in
        [(0.08, 1.945940872497e-1), (0.05, 1.057847519834e-2), (0.03, 5.113923599287e-4), (0.02, 4.417234459536e-5)]
    {
        let found: f64 = ship.wave_resistance(speed(froude), &water);
        assert!((found / expected - 1.0).abs() < 1e-9, "{froude}: {found:e} {expected:e}");
    }
}

/// The general path, which knows nothing of nets, on the same hull.
#[test]
fn waterlines_agree_with_the_net() {
    let (hull, water) = (hull(), water());
    let net = ThinShip::new(&hull, 0.625).unwrap();
    let lines = Kochin::Waterlines(WaterlineKochin::new(&hull, 0.625, waterlines::NODES));
    let lines = ThinShip { kochin: lines, length: net.length };
    for froude in [0.1, 0.2, 0.316, 0.5, 1.0] {
        let [a, b] = [&net, &lines].map(|ship| ship.wave_resistance(speed(froude), &water));
        assert!((b / a - 1.0).abs() < 3e-6, "{froude}: {a} {b}");
    }
}

/// Raked ends, rockered keels and round sections: with more nodes over the depth the figures stay.
#[test]
fn more_waterlines_change_nothing() {
    for rockered in [false, true] {
        let hull = raked(rockered);
        let [coarse, fine] = [waterlines::NODES, waterlines::NODES + 4].map(|nodes| ThinShip {
            kochin: Kochin::Waterlines(WaterlineKochin::new(&hull, 6.0, nodes)),
            length: immersed_length(&hull),
        });
        let water = Water::new(1025.0, 15.0);
        for froude in [0.2, 0.4] {
            let speed = froude * (water.gravity * 100.0).sqrt();
            let [a, b] = [&coarse, &fine].map(|ship| ship.wave_resistance(speed, &water));
            assert!((b / a - 1.0).abs() < 1e-5, "{rockered} {froude}: {a} {b}");
        }
    }
}

#[test]
fn the_gradient_is_that_of_a_quadratic_form() {
    let (hull, water) = (hull(), water());
    let ship = ThinShip::new(&hull, 0.625).unwrap();
    let speed = speed(0.3);
    let found = ship.wave_gradient(speed, &water).unwrap();
    let resistance = ship.wave_resistance(speed, &water);
    assert!((found.resistance / resistance - 1.0).abs() < 1e-14);
    let breadths: Vec<f64> = hull.surface().points().iter().map(|point| point[1]).collect();
    let product: f64 = breadths.iter().zip(&found.gradient).map(|(c, g)| c * g).sum();
    assert!((product / (2.0 * resistance) - 1.0).abs() < 1e-7, "{product} {resistance}");
    // A central difference of a quadratic form has no error of its own.
    let (index, step) = (60, 0.1);
    let changed = [step, -step].map(|step| {
        let Kochin::Net(mut net) = ship.kochin.clone() else { panic!() };
        net.change(index, step);
        ThinShip { kochin: Kochin::Net(net), length: ship.length }.wave_resistance(speed, &water)
    });
    let slope = (changed[0] - changed[1]) / (2.0 * step);
    assert!((slope / found.gradient[index] - 1.0).abs() < 1e-6, "{slope} {}", found.gradient[index]);
}

#[test]
fn at_rest_there_is_no_resistance() {
    let ship = ThinShip::new(&hull(), 0.625).unwrap();
    assert!(ship.wave_resistance(0.0, &water()) == 0.0);
    assert!(ship.wave_gradient(0.0, &water()).unwrap().gradient.iter().all(|g| *g == 0.0));
    assert!(ThinShip::new(&hull(), 2.0).is_err());
    assert_eq!(ship.wave_resistances(&[0.0, 1.0, 2.0], &water()).len(), 3);
}

/// R_W(c + d) = R_W + g'd + |R'd|^2, on a rectangle and with raked ends.
#[test]
fn the_quadratic_form_is_that_of_the_resistance() {
    for (hull, tolerance) in [(hull(), 2e-6), (raked(false), 2e-4)] {
        let draught = hull.particulars().draught.unwrap();
        let length = hull.particulars().length_between_perpendiculars;
        let columns = hull.surface().shape()[1];
        let free: Vec<usize> = vec![5 * columns + 3, 5 * columns + 4, 11 * columns + 6, 16 * columns + 9];
        let forms = WaveForms::new(&hull, draught).unwrap();
        let speed = 0.3 * (9.80665 * length).sqrt();
        let form = forms.at(speed, &water(), &free);
        let exact = ThinShip::new(&hull, draught).unwrap().wave_resistance(speed, &water());
        assert!((form.resistance / exact - 1.0).abs() < tolerance, "{} {exact}", form.resistance);
        let change = [0.02, -0.01, 0.03, 0.01].map(|part: f64| part * hull.particulars().breadth);
        let mut points = hull.surface().points().to_vec();
        free.iter().zip(change).for_each(|(&k, d)| points[k][1] += d);
        let surface = BsplineSurface::new(hull.surface().u().clone(), hull.surface().v().clone(), points).unwrap();
        let moved = Hull::new("moved", *hull.particulars(), surface, hull.deck().clone()).unwrap();
        let found = ThinShip::new(&moved, draught).unwrap().wave_resistance(speed, &water());
        let linear: f64 = form.gradient.iter().zip(change).map(|(g, d)| g * d).sum();
        let along = |root: &Vec<f64>| root.iter().zip(change).map(|(r, d)| r * d).sum::<f64>();
        let square: f64 = form.roots.iter().map(|root| along(root).powi(2)).sum();
        let expected = form.resistance + linear + square;
        assert!((found / expected - 1.0).abs() < 2.0 * tolerance, "{found} {expected} {linear} {square}");
    }
}
