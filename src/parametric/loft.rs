//! From functions to a net: interpolation of x, y and z on one pair of knot vectors.

use crate::hull::{Hull, HullError, PrincipalParticulars};
use crate::spline::{BsplineCurve, BsplineSurface, Collocation, KnotVector, SplineError};

/// One site a basis function: the Greville abscissae, moved onto the knot where a knot is simple and near, so that the
/// surface meets its functions on the lines of the design (shoulders, design waterline).
pub(super) fn sites(knots: &KnotVector) -> Vec<f64> {
    let mut sites = knots.greville();
    let breaks = knots.breakpoints();
    for &at in &breaks[1..breaks.len() - 1] {
        if knots.multiplicity(at) > 1 {
            continue;
        }
        let nearest = (1..sites.len() - 1).min_by(|&i, &j| (sites[i] - at).abs().total_cmp(&(sites[j] - at).abs()));
        if let Some(i) = nearest {
            let gap = (sites[i + 1] - sites[i]).min(sites[i] - sites[i - 1]);
            if (sites[i] - at).abs() < 0.6 * gap && at > sites[i - 1] && at < sites[i + 1] {
                sites[i] = at;
            }
        }
    }
    sites
}

/// The spline in v through `value` at the sites of `knots`.
pub(super) fn interpolate(knots: &KnotVector, value: impl Fn(f64) -> f64) -> Result<Vec<f64>, SplineError> {
    let sites = sites(knots);
    let mut values: Vec<f64> = sites.iter().map(|&t| value(t)).collect();
    Collocation::new(knots, &sites)?.solve_strided(&mut values, 0, 1);
    Ok(values)
}

/// The tensor-product spline through `value` at the sites of `u` and `v`.
pub(super) fn interpolate_tensor(
    u: &KnotVector,
    v: &KnotVector,
    value: impl Fn(f64, f64) -> f64,
) -> Result<Vec<f64>, SplineError> {
    let (sites_u, sites_v) = (sites(u), sites(v));
    let mut values: Vec<f64> =
        sites_u.iter().flat_map(|&a| sites_v.iter().map(move |&b| (a, b))).map(|(a, b)| value(a, b)).collect();
    Collocation::new(u, &sites_u)?.solve_tensor(&Collocation::new(v, &sites_v)?, &mut values);
    Ok(values)
}

/// Surface of the nets of x and y (u slowest) and the net of z in v.
pub(super) fn surface(
    u: &KnotVector,
    v: &KnotVector,
    x: &[f64],
    y: &[f64],
    z: &[f64],
) -> Result<BsplineSurface<3>, SplineError> {
    let columns = v.basis_count();
    let points = x.iter().zip(y).enumerate().map(|(k, (&x, &y))| [x, y, z[k % columns]]).collect();
    BsplineSurface::new(u.clone(), v.clone(), points)
}

/// A deck at side without sheer, at the top of the surface, from its aft to its fore end.
pub(super) fn level_deck(surface: &BsplineSurface<3>) -> Result<BsplineCurve<2>, SplineError> {
    let [rows, columns] = surface.shape();
    let (aft, fore) = (surface.point(0, columns - 1), surface.point(rows - 1, columns - 1));
    BsplineCurve::new(KnotVector::uniform(1, 1)?, vec![[aft[0], aft[2]], [fore[0], fore[2]]])
}

/// A hull with a level deck.
pub(super) fn level_hull(
    name: &str,
    particulars: PrincipalParticulars,
    surface: BsplineSurface<3>,
) -> Result<Hull, HullError> {
    let deck = level_deck(&surface)?;
    Hull::new(name, particulars, surface, deck)
}
