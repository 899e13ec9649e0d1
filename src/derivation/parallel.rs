//! A parallel middle body of the nearest hull: control half-breadths that are equal along the ship.
//!
//! A spline of degree p is constant from one knot to another where the control values of all spans between them are equal. So knots
//! come to both ends of the body, and the half-breadths below T of the rows between them become free and equal in pairs, linear
//! equations of the program. Outside of it the lines leave with the continuity of the net. The edge of a flat of bottom is free
//! then, from stem to stern, because it is a line of the body.

use super::refusal::Refusal;
use crate::hull::Hull;

/// Waterlines on which the ends of the body are looked for.
const WATERLINES: usize = 33;
/// Part of the parameters within which a knot is at an end.
const AT_KNOT: f64 = 1e-9;
/// Part of B by which half-breadths of a parallel body may differ.
const SAME: f64 = 1e-9;
/// Part of D by which heights may differ along the body.
const LEVEL: f64 = 1e-9;

/// Rows and columns of the net that are equal along the ship.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Band {
    pub(super) first: usize,
    pub(super) last: usize,
    /// The columns that bear on what is below T.
    pub(super) columns: usize,
}

impl Band {
    pub(super) fn holds(&self, row: usize, column: usize) -> bool {
        (self.first..=self.last).contains(&row) && column < self.columns
    }

    /// Sets the half-breadths of each column of the band to their mean.
    pub(super) fn level(&self, y: &mut [f64], columns: usize) {
        for j in 0..self.columns {
            let of_column = || (self.first..=self.last).map(|i| i * columns + j);
            let mean = of_column().map(|k| y[k]).sum::<f64>() / (self.last - self.first + 1) as f64;
            of_column().for_each(|k| y[k] = mean);
        }
    }

    /// Neighbours along the ship.
    pub(super) fn pairs(&self, columns: usize) -> Vec<[usize; 2]> {
        let rows = self.first..self.last;
        rows.flat_map(|i| (0..self.columns).map(move |j| [i * columns + j, (i + 1) * columns + j])).collect()
    }
}

/// The parameters between which the sections from `aft` to `fore` \[m\] are, at all heights below T; none where a waterline ends
/// before.
fn parameters(hull: &Hull, draught: f64, [aft, fore]: [f64; 2]) -> Option<[f64; 2]> {
    let (low, _) = hull.surface().v().domain();
    let (start, end) = hull.surface().u().domain();
    let top = hull.height_parameter_at(0.5 * (start + end), draught)?;
    let mut found = [f64::INFINITY, f64::NEG_INFINITY];
    for k in 0..WATERLINES {
        let v = low + (top - low) * k as f64 / (WATERLINES - 1) as f64;
        found[0] = found[0].min(hull.length_parameter(aft, v)?);
        found[1] = found[1].max(hull.length_parameter(fore, v)?);
    }
    (found[0] > start && found[1] < end && found[0] < found[1]).then_some(found)
}

/// The band of a hull with knots at the ends of the body; none where there are none.
pub(super) fn band(hull: &Hull, draught: f64, ends: [f64; 2]) -> Option<Band> {
    let [from, to] = parameters(hull, draught, ends)?;
    let (along, up) = (hull.surface().u(), hull.surface().v());
    let slack = AT_KNOT * (along.domain().1 - along.domain().0);
    let knots = along.knots();
    let inside: Vec<usize> = along
        .spans()
        .into_iter()
        .filter(|&span| knots[span] >= from - slack && knots[span + 1] <= to + slack)
        .collect();
    let (first, last) = (inside.first()? - along.degree(), *inside.last()?);
    let columns = up.find_span(hull.height_parameter_at(0.5 * (from + to), draught)?) + 1;
    Some(Band { first, last, columns })
}

/// The longest run of rows with the same half-breadths below T, where sections between knots are alike; none where there are no
/// such sections.
pub(super) fn own_band(hull: &Hull, draught: f64) -> Option<Band> {
    let surface = hull.surface();
    let (start, end) = surface.u().domain();
    let columns = surface.v().find_span(hull.height_parameter_at(0.5 * (start + end), draught)?) + 1;
    let rows = surface.shape()[0];
    let slack = SAME * hull.particulars().breadth;
    let is_same = |i: usize| {
        let apart = |j: usize| (surface.point(i + 1, j)[1] - surface.point(i, j)[1]).abs();
        (0..columns).all(|j| apart(j) <= slack) && (0..columns).any(|j| surface.point(i, j)[1] > slack)
    };
    let (mut best, mut first) = (0..0, 0);
    for i in 0..rows.saturating_sub(1) {
        if !is_same(i) {
            first = i + 1;
        } else if i + 1 - first > best.len() {
            best = first..i + 1;
        }
    }
    (best.len() >= surface.u().degree()).then_some(Band { first: best.start, last: best.end, columns })
}

/// The hull with knots at the ends of the body, which change nothing.
///
/// # Errors
/// E420 where the ends are beyond the waterlines below T, or where the heights of the net change along the body.
pub(super) fn with_ends(hull: &Hull, draught: f64, ends: [f64; 2]) -> Result<Hull, Refusal> {
    let refuse = |message: String, remedy: String| Refusal::new("E420", vec!["parallel-body"], message, remedy);
    let [aft, fore] = ends;
    let Some(found) = parameters(hull, draught, ends) else {
        let (low, _) = hull.surface().v().domain();
        let ((start, end), top) = (hull.surface().u().domain(), hull.height_parameter(draught));
        let at = |u: f64| [Some(low), top].into_iter().flatten().map(move |v| hull.surface().eval(u, v)[0]);
        let (from, to) = (at(start).fold(f64::NEG_INFINITY, f64::max), at(end).fold(f64::INFINITY, f64::min));
        let message = format!(
            "a parallel body from {aft:.3} to {fore:.3} m is not between the ends of all waterlines below T, {from:.3} and {to:.3} m"
        );
        return Err(refuse(message, format!("Give ends between {from:.3} and {to:.3} m")));
    };
    let surface = hull.surface();
    let along = surface.u();
    let slack = AT_KNOT * (along.domain().1 - along.domain().0);
    let is_new = |u: &f64| along.breakpoints().iter().all(|knot| (knot - u).abs() > slack);
    let knots: Vec<f64> = found.into_iter().filter(is_new).collect();
    let made = surface.insert_knots(&knots, &[]).map_err(|error| Refusal::hull(&error))?;
    let hull = Hull::new(hull.name(), *hull.particulars(), made, hull.deck().clone())
        .map_err(|error| Refusal::hull(&error))?;
    let Some(band) = band(&hull, draught, ends) else {
        return Err(refuse(
            format!("no sections from {aft:.3} to {fore:.3} m are between knots of the net"),
            "Give a longer parallel body".to_owned(),
        ));
    };
    let height = |i: usize, j: usize| hull.surface().point(i, j)[2];
    let rise = (band.first..=band.last)
        .flat_map(|i| (0..band.columns).map(move |j| (i, j)))
        .map(|(i, j)| (height(i, j) - height(band.first, j)).abs())
        .fold(0.0, f64::max);
    if rise > LEVEL * hull.particulars().depth {
        let message = format!(
            "the heights of the net change by {rise:.4} m from {aft:.3} to {fore:.3} m, where a parallel body has none"
        );
        return Err(refuse(message, "Derive from a hull with a level keel and level waterlines there".to_owned()));
    }
    Ok(hull)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::derivation::samples::parabolic;

    /// The ends are knots of the band, and nothing has moved.
    #[test]
    fn knots_come_to_the_ends() {
        let parent = parabolic();
        let hull = with_ends(&parent, 6.25, [40.0, 55.0]).unwrap();
        let found = band(&hull, 6.25, [40.0, 55.0]).unwrap();
        let along = hull.surface().u();
        let x = |u: f64| hull.surface().eval(u, 0.5)[0];
        let knots = along.knots();
        assert!((x(knots[found.first + along.degree()]) - 40.0).abs() < 1e-9);
        assert!((x(knots[found.last + 1]) - 55.0).abs() < 1e-9);
        for (x, z) in [(12.0, 2.0), (47.0, 5.0)] {
            let [a, b] = [&parent, &hull].map(|hull| hull.half_breadth(x, z).unwrap());
            assert!((a - b).abs() < 1e-12);
        }
    }

    #[test]
    fn ends_beyond_the_ship_are_refused_with_numbers() {
        let refused = with_ends(&parabolic(), 6.25, [40.0, 155.0]).unwrap_err();
        assert!(refused.code == "E420" && refused.message.contains("155.000") && refused.remedy.contains("100.000"));
    }
}
