use super::*;
use crate::resistance::{Appendage, SternShape};

/// The worked example of Holtrop and Mennen 1982.
fn example() -> ShipParameters {
    let mut ship = ShipParameters {
        length: 205.0,
        breadth: 32.0,
        draught_fore: 10.0,
        draught_aft: 10.0,
        volume: 37500.0,
        lcb: -0.75,
        midship_coefficient: 0.98,
        waterplane_coefficient: 0.75,
        wetted_surface: 1.0,
        half_angle: 45.0,
        transom_area: 16.0,
        bulb_area: 20.0,
        bulb_height: 4.0,
        stern: SternShape::U,
        appendages: vec![Appendage { surface: 50.0, factor: 1.5 }],
    };
    ship.wetted_surface = wetted_surface_estimate(&ship);
    ship.half_angle = half_angle_of_entrance(&ship);
    ship
}

const WATER: Water = Water { density: 1025.0, viscosity: 1.18831e-6, gravity: 9.81 };
const SPEED: f64 = 25.0 * 1852.0 / 3600.0;

#[track_caller]
fn close(found: f64, expected: f64, relative: f64) {
    assert!((found / expected - 1.0).abs() < relative, "{found} for {expected}");
}

/// Figures as printed, to their digits; R_A is that of the printed formula (see the head of the module).
#[test]
fn the_worked_example_of_1982() {
    let ship = example();
    close(ship.wetted_surface, 7381.45, 1e-5);
    close(ship.half_angle, 12.08, 1e-3);
    close(ship.run_length(), 81.385, 1e-4);
    let method = Holtrop::new(&ship, Edition::Of1982).unwrap();
    close(method.c1, 1.398, 1e-3);
    close(method.c2, 0.7595, 1e-4);
    close(method.c5, 0.9592, 1e-4);
    close(method.m1, -2.1274, 1e-4);
    close(method.lambda, 0.6513, 2e-4);
    close(method.form_factor(), 1.156, 5e-4);
    close(method.correlation_allowance(), 0.000_352_5, 1e-3);
    let at = method.components(SPEED, &WATER);
    close(at.froude, 0.2868, 2e-4);
    close(at.friction, 869_630.0, 1e-4);
    close(at.appendages, 8_830.0, 1e-3);
    close(at.wave, 557_110.0, 1e-3);
    close(at.bulb, 49.0, 2e-2);
    assert!(at.transom == 0.0, "{}", at.transom);
    close(at.allowance, 220_570.0, 1e-3);
    close(at.total(), 1_793_260.0, 1e-3);
}

/// The set of 1984 is continuous where its formulas meet, and at slow speed that of 1982 differs by the form factor and
/// the humps alone.
#[test]
fn the_set_of_1984_is_continuous() {
    let method = Holtrop::new(&example(), Edition::Of1984).unwrap();
    for froude in BETWEEN {
        let [below, above] = [-1e-9, 1e-9].map(|step| method.wave(froude + step, &WATER));
        close(above, below, 1e-6);
    }
    let middle = method.wave(0.475, &WATER);
    close(middle, 0.5 * (method.wave(0.40, &WATER) + method.wave(0.55, &WATER)), 1e-12);
    assert!(method.components(0.0, &WATER).total() == 0.0);
}

/// The form factor of 1984 written out by hand for a barge of round numbers: (B/L) = 0.1, (T/L) = 0.05, C_P = 0.5,
/// L_R = L/2, L^3/volume = 400.
#[test]
fn the_form_factor_of_1984() {
    let ship = ShipParameters {
        length: 100.0,
        breadth: 10.0,
        draught_fore: 5.0,
        draught_aft: 5.0,
        volume: 2500.0,
        lcb: 0.0,
        midship_coefficient: 1.0,
        stern: SternShape::Normal,
        bulb_area: 0.0,
        transom_area: 0.0,
        ..example()
    };
    let logarithm = 1.06806 * 0.1f64.ln() + 0.46106 * 0.05f64.ln() + 0.121563 * 2f64.ln() + 0.36486 * 400f64.ln()
        - 0.604247 * 0.5f64.ln();
    close(Holtrop::new(&ship, Edition::Of1984).unwrap().form_factor(), 0.93 + 0.487118 * logarithm.exp(), 1e-12);
    let v = ShipParameters { stern: SternShape::V, ..ship.clone() };
    let [normal, v] = [ship, v].map(|ship| Holtrop::new(&ship, Edition::Of1984).unwrap().form_factor() - 0.93);
    close(v, 0.89 * normal, 1e-12);
}

#[test]
fn what_no_formula_takes_is_refused_with_its_limit() {
    let ship = ShipParameters { volume: 66000.0, half_angle: 91.0, bulb_height: 7.0, ..example() };
    let faults: Vec<String> =
        Holtrop::new(&ship, Edition::Of1984).unwrap_err().iter().map(ToString::to_string).collect();
    let all = faults.join("; ");
    assert!(all.contains("C_P is 1.0266; the formulas need 0.26 to 0.99") && all.contains("h_B is 7.0000"), "{all}");
    assert!(all.contains("i_E is 91.0000"), "{all}");
}
