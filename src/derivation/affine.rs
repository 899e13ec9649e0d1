//! The parent at other main dimensions.
//!
//! x grows by L/L0 and y by B/B0. Heights grow by s = T/T0 up to the design waterline, and the depth becomes D: with T/T0 =
//! D/D0 all of it is one scale, so that C_B, C_M, C_WP, the centres in parts of the dimensions and BM T / B^2 stay (the
//! affine laws). Otherwise the slope of the map of heights goes from s at the waterline to r at the deck,
//!
//! ```text
//! f' = s + (r - s) (3 w^2 - 2 w^3),   w = min(1, (z - z1) / (c (D0 - z1))),   r = s + 2 (a - s) / (2 - c)
//! ```
//!
//! with z1 the highest control height that bears on the immersed part, so that this part is scaled as a whole, and
//! a = (D - s z1) / (D0 - z1) the mean slope above it. c is 1, or less where r would be below s/5: then r is s/5. The map is
//! twice differentiable, and rises as long as a > s/4.

use super::refusal::Refusal;
use super::request::Dimensions;
use crate::hull::{Hull, PrincipalParticulars};
use crate::spline::{BsplineCurve, BsplineSurface};

/// Part of the way from T to D that the change of slope has at least.
const LEAST_WAY: f64 = 0.15;

/// Slope of the map at the deck, over that below T, from which the change of slope ends below the deck.
const DRY_SLOPE: f64 = 0.2;
/// Least mean slope of the map above T, over that below.
const LEAST_SLOPE: f64 = 0.25;

/// Part of a span above T in which knots are added.
const FINER: f64 = 0.5;

/// The map of heights.
#[derive(Debug, Clone, Copy)]
struct Heights {
    scale: f64,
    top_slope: f64,
    /// c.
    reach: f64,
    from: f64,
    depth: f64,
}

impl Heights {
    /// With the mean slope `mean` above `from`; none where it is below [`LEAST_SLOPE`] of `scale`.
    fn new(scale: f64, mean: f64, from: f64, depth: f64) -> Option<Self> {
        let least = DRY_SLOPE * scale;
        let top_slope = 2.0 * mean - scale;
        let (top_slope, reach) =
            if top_slope >= least { (top_slope, 1.0) } else { (least, 2.0 * (mean - least) / (scale - least)) };
        (mean > LEAST_SLOPE * scale).then_some(Self { scale, top_slope, reach, from, depth })
    }

    fn at(&self, z: f64) -> f64 {
        let way = self.depth - self.from;
        let w = ((z - self.from) / way).max(0.0);
        let part = (w / self.reach).min(1.0);
        // The integral of 3 w^2 - 2 w^3.
        let grown = self.reach * (part.powi(3) - 0.5 * part.powi(4)) + (w - self.reach).max(0.0);
        self.scale * z + (self.top_slope - self.scale) * way * grown
    }
}

/// The surface of a hull, and the greatest control height of it that bears on what is below T: with more knots just above T
/// where that would leave too little of the side, or where `finer` asks for them; T where heights are no function of v.
fn with_dry_side(hull: &Hull, draught: f64, depth: f64, finer: bool) -> (BsplineSurface<3>, f64) {
    let surface = hull.surface();
    let Some(v) = hull.height_parameter(draught) else { return (surface.clone(), draught) };
    let height = |surface: &BsplineSurface<3>| surface.point(0, surface.v().find_span(v))[2];
    let is_low = |z: f64| z > draught && z < draught + (1.0 - LEAST_WAY) * (depth - draught);
    let found = height(surface);
    if is_low(found) && !finer {
        return (surface.clone(), found);
    }
    let degree = surface.v().degree();
    let end = surface.v().breakpoints().into_iter().find(|knot| *knot > v).unwrap_or(surface.v().domain().1);
    let more: Vec<f64> =
        (1..=degree).map(|k| v + FINER * (end - v) * k as f64 / degree as f64).filter(|knot| *knot < end).collect();
    match surface.insert_knots(&[], &more) {
        Ok(finer) if is_low(height(&finer)) => {
            let found = height(&finer);
            (finer, found)
        }
        _ => (surface.clone(), draught),
    }
}

/// The hull at other dimensions; what is not named is kept.
///
/// # Errors
/// [`Refusal`] where the deck would fold below the waterline, or the dimensions are none of a hull.
pub fn scaled(parent: &Hull, dimensions: &Dimensions) -> Result<Hull, Refusal> {
    let old = *parent.particulars();
    let Some(old_draught) = old.draught else { return Err(Refusal::no_draught()) };
    let draught = dimensions.draught.unwrap_or(old_draught);
    let new = PrincipalParticulars {
        length_between_perpendiculars: dimensions.length.unwrap_or(old.length_between_perpendiculars),
        breadth: dimensions.breadth.unwrap_or(old.breadth),
        draught: Some(draught),
        depth: dimensions.depth.unwrap_or(old.depth),
    };
    let along = new.length_between_perpendiculars / old.length_between_perpendiculars;
    let across = new.breadth / old.breadth;
    let scale = draught / old_draught;
    let uniform = (new.depth - scale * old.depth).abs() <= 1e-12 * new.depth;
    let map = |finer: bool| {
        let (surface, from) = with_dry_side(parent, old_draught, old.depth, finer);
        let way = (old.depth - from).max(1e-9 * old.depth);
        let mean = if uniform { scale } else { (new.depth - scale * from) / way };
        let least = scale * (from + LEAST_SLOPE * way);
        Heights::new(scale, mean, from, old.depth).map(|heights| (surface, heights)).ok_or(least)
    };
    let mapped = if new.draught_exceeds_depth() { Err(draught) } else { map(false).or_else(|_| map(true)) };
    let (surface, heights) = mapped.map_err(|least| Refusal::depth(new.depth, least.max(draught), draught))?;
    let points = surface.points().iter().map(|[x, y, z]| [along * x, across * y, heights.at(*z)]).collect();
    let deck = parent.deck().points().iter().map(|[x, z]| [along * x, heights.at(*z)]).collect();
    let deck = BsplineCurve::new(parent.deck().knots().clone(), deck).map_err(|error| Refusal::hull(&error))?;
    let surface = BsplineSurface::new(surface.u().clone(), surface.v().clone(), points);
    let surface = surface.map_err(|error| Refusal::hull(&error))?;
    Hull::new(parent.name(), new, surface, deck).map_err(|error| Refusal::hull(&error))
}

#[cfg(test)]
mod tests {
    use super::super::quantity::{Quantity, Reference, value_of};
    use super::*;
    use crate::derivation::samples::tug;
    use crate::hydrostatics::Conventions;

    /// L, B and T, D by one factor: volumes grow as L B T, C_M and C_WP stay, centres stay in parts of L and T, BM grows as
    /// B^2 / T.
    #[test]
    fn affine_laws() {
        let parent = tug();
        let p = *parent.particulars();
        let (l, b, z) = (1.13, 0.91, 1.07);
        let dimensions = Dimensions {
            length: Some(l * p.length_between_perpendiculars),
            breadth: Some(b * p.breadth),
            draught: p.draught.map(|t| z * t),
            depth: Some(z * p.depth),
        };
        let hull = scaled(&parent, &dimensions).unwrap();
        let conventions = Conventions::default();
        let of = |hull: &Hull, quantity| value_of(quantity, hull, &Reference::of(hull, &conventions).unwrap());
        let ratio = |quantity| of(&hull, quantity) / of(&parent, quantity);
        let bm = |hull: &Hull| of(hull, Quantity::Km) - of(hull, Quantity::Kb);
        for (found, expected) in [
            (ratio(Quantity::Volume), l * b * z),
            (ratio(Quantity::MidshipCoefficient), 1.0),
            (ratio(Quantity::PrismaticCoefficient), 1.0),
            (ratio(Quantity::WaterplaneCoefficient), 1.0),
            (ratio(Quantity::Lcb), l),
            (ratio(Quantity::Lcf), l),
            (ratio(Quantity::Kb), z),
            (bm(&hull) / bm(&parent), b * b / z),
        ] {
            assert!((found - expected).abs() < 1e-10, "{found} {expected}");
        }
    }

    /// Another depth alone leaves what is immersed as it is.
    #[test]
    fn the_depth_alone_is_that_of_the_topside() {
        let parent = tug();
        let depth = 1.12 * parent.particulars().depth;
        let hull = scaled(&parent, &Dimensions { depth: Some(depth), ..Dimensions::default() }).unwrap();
        let middle = 0.5 * hull.particulars().length_between_perpendiculars;
        assert!((hull.deck_height(middle) - depth).abs() < 1e-9, "{}", hull.deck_height(middle));
        let conventions = Conventions::default();
        for quantity in [Quantity::Volume, Quantity::Lcb, Quantity::WaterplaneCoefficient] {
            let of = |hull: &Hull| value_of(quantity, hull, &Reference::of(hull, &conventions).unwrap());
            assert!((of(&hull) / of(&parent) - 1.0).abs() < 1e-10, "{quantity:?}");
        }
    }

    #[test]
    fn a_deck_below_the_waterline_is_refused() {
        let parent = tug();
        let refused = scaled(&parent, &Dimensions { depth: Some(3.0), ..Dimensions::default() }).unwrap_err();
        assert!(refused.code == "E420" && refused.message.contains("3.6"), "{refused:?}");
    }
}
