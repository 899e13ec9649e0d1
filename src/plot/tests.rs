//! The figures of a Wigley hull: what stands on them and where.

use super::*;
use crate::hull::PrincipalParticulars;
use crate::hydrostatics::Conventions;
use crate::spline::{BsplineCurve, BsplineSurface, KnotVector};

/// y = (B/2) (1 - (2x/L - 1)^2) (1 - (1 - z/T)^2) below z = T, wall-sided above.
pub(super) fn wigley([length, breadth, draught, depth]: [f64; 4]) -> Hull {
    let u = KnotVector::uniform(2, 1).unwrap();
    let v = KnotVector::from_breakpoints(2, &[0.0, draught, depth], &[2]).unwrap();
    let along = [0.0, 2.0, 0.0];
    let up = [0.0, 1.0, 1.0, 1.0, 1.0];
    let z = [0.0, 0.5 * draught, draught, 0.5 * (draught + depth), depth];
    let points = (0..3)
        .flat_map(|i| (0..5).map(move |j| [0.5 * length * i as f64, 0.5 * breadth * along[i] * up[j], z[j]]))
        .collect();
    let deck = BsplineCurve::new(KnotVector::uniform(1, 1).unwrap(), vec![[0.0, depth], [length, depth]]).unwrap();
    let particulars = PrincipalParticulars { length_between_perpendiculars: length, breadth, draught, depth };
    Hull::new("Wigley", particulars, BsplineSurface::new(u, v, points).unwrap(), deck).unwrap()
}

/// Draws `figure` of a hull at its design draught, with a table from 0.2 T to D.
fn with_inputs<T>(hull: &Hull, draw: impl FnOnce(&FigureInputs) -> T) -> T {
    let p = hull.particulars();
    let conventions = Conventions::default();
    let design = CurvesOfForm::new(hull, &[p.draught], &conventions);
    let curves = CurvesOfForm::new(hull, &[0.2 * p.draught, p.draught, p.depth], &conventions);
    draw(&FigureInputs { hull, design: &design.rows[0], curves: &curves })
}

#[test]
fn pictures_of_every_figure() {
    let hull = wigley([100.0, 10.0, 6.25, 9.0]);
    for figure in Figure::ALL {
        let svg = with_inputs(&hull, |inputs| figure.draw(inputs)).unwrap();
        let png = svg.to_png(figure.dots_per_inch()).unwrap();
        assert!(png.len() < 1_000_000, "{}: {} bytes", figure.key(), png.len());
        if let Ok(folder) = std::env::var("LOFTSMAN_FIGURES") {
            std::fs::write(format!("{folder}/{}.png", figure.key()), png).unwrap();
            std::fs::write(format!("{folder}/{}.svg", figure.key()), svg.as_str()).unwrap();
        }
    }
}
