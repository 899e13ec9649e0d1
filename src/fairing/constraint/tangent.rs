//! Prescribed tangents: dy/dx = tan(angle) on a waterline, dy/dz = tan(angle) on a station, linear in the net on a
//! fixed chart.
//!
//! A vertical side is 0 deg on the station. At the ends of a waterline y' = -x' tan(half angle of entrance), and y' =
//! x' tan(half angle of run); where the chart stands still, x' = 0, a round stem has no angle to prescribe.

use super::super::bends::bend;
use super::super::model::{Limit, Row};
use super::super::surface::FairSurface;
use super::lines::TangentPlace;

/// x' or z' below this part of the length of the ship, over the domain, is none.
const STILL: f64 = 1e-6;

pub(super) fn limits(surface: &FairSurface, place: TangentPlace, angle: f64) -> Result<Vec<Limit>, String> {
    let hull = &surface.hull;
    let net = hull.surface();
    let (aft, fore) = net.u().domain();
    let ends = |u: f64, z: f64| hull.height_parameter_at(u, z).map(|v| [u, v]);
    let (at, station, sign, words) = match place {
        TangentPlace::Entrance(z) => (ends(fore, z), false, -1.0, format!("the stem does not reach z = {z:.3} m")),
        TangentPlace::Run(z) => (ends(aft, z), false, 1.0, format!("the stern does not reach z = {z:.3} m")),
        TangentPlace::Waterline([x, z]) => {
            (hull.parameters(x, z), false, 1.0, format!("the surface has no point at x = {x:.3} m, z = {z:.3} m"))
        }
        TangentPlace::Station([x, z]) => {
            (hull.parameters(x, z), true, 1.0, format!("the surface has no point at x = {x:.3} m, z = {z:.3} m"))
        }
    };
    let still = || "the chart of the surface stands still there: a round end has no angle".to_owned();
    let bend = bend(net, at.ok_or(words)?, station).ok_or_else(still)?;
    if bend.along.abs() <= STILL * hull.particulars().length_between_perpendiculars {
        return Err(still());
    }
    let slope = sign * angle.tan();
    let row: Row = bend.slope.iter().map(|&(i, value)| (i, value / bend.along)).collect();
    Ok(vec![Limit { row, lower: slope, upper: slope }])
}
