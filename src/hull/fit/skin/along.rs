//! Along the ship: cubics from section to section through every column of control values.
//!
//! Slopes at the sections are those of the C2 cubic spline with the "not a knot" end conditions (de Boor 2001, IV), so
//! that the surface is C2 there wherever nothing stands against it; they are taken back where a cubic would leave the
//! range of its neighbours ([`limits`]) and where heights would fall from column to column. Where the keel line
//! jumps the splines on both sides do not know of each other.

use super::super::limits;
use crate::spline::{Collocation, KnotVector, SplineError};

/// Degree in both directions.
pub(super) const DEGREE: usize = 3;

/// Slopes at the sections.
#[derive(Debug)]
pub(super) struct Along<'a> {
    sites: &'a [f64],
    pieces: Vec<Piece>,
}

#[derive(Debug)]
struct Piece {
    first: usize,
    last: usize,
    collocation: Option<Collocation>,
    /// First basis function and derivatives of the basis at each site.
    rows: Vec<(usize, Vec<f64>)>,
}

impl Piece {
    fn new(sites: &[f64], first: usize, last: usize) -> Result<Self, SplineError> {
        let own = &sites[first..=last];
        if own.len() < 2 {
            return Ok(Self { first, last, collocation: None, rows: Vec::new() });
        }
        let degree = DEGREE.min(last - first);
        let mut breakpoints = vec![own[0]];
        if degree == DEGREE && own.len() > 4 {
            breakpoints.extend(&own[2..own.len() - 2]);
        }
        breakpoints.push(own[own.len() - 1]);
        let knots = KnotVector::from_breakpoints(degree, &breakpoints, &vec![1; breakpoints.len() - 2])?;
        let rows = own
            .iter()
            .map(|&t| {
                let span = knots.find_span(t);
                let [_, slopes] = knots.basis_derivatives::<2>(span, t);
                (span - degree, slopes[..=degree].to_vec())
            })
            .collect();
        Ok(Self { first, last, collocation: Some(Collocation::new(&knots, own)?), rows })
    }
}

impl<'a> Along<'a> {
    /// For sections at `sites`; between those of each of the `jumps` the splines are parted.
    pub(super) fn new(sites: &'a [f64], jumps: &[[usize; 2]]) -> Result<Self, SplineError> {
        let mut pieces = Vec::new();
        let mut first = 0;
        for &[aft, fore] in jumps {
            pieces.push(Piece::new(sites, first, aft)?);
            first = fore;
        }
        pieces.push(Piece::new(sites, first, sites.len() - 1)?);
        Ok(Self { sites, pieces })
    }

    fn free(&self, values: &[f64]) -> Vec<f64> {
        let mut slopes = vec![0.0; values.len()];
        for piece in &self.pieces {
            let Some(collocation) = &piece.collocation else {
                // A section between two jumps, or alone at an end: straight on to its neighbour.
                slopes[piece.first] = limits::parabolic(self.sites, values)[piece.first];
                continue;
            };
            let mut control = values[piece.first..=piece.last].to_vec();
            collocation.solve(&mut control);
            for (slope, (from, row)) in slopes[piece.first..].iter_mut().zip(&piece.rows) {
                *slope = row.iter().zip(&control[*from..]).map(|(b, c)| b * c).sum();
            }
        }
        slopes
    }

    /// Slopes of columns of half-breadths, one list a section.
    pub(super) fn half_breadths(&self, sections: &[Vec<f64>]) -> Vec<Vec<f64>> {
        self.columns(sections, 0.0)
    }

    /// Slopes of columns of heights, which do not fall from column to column between the sections either.
    pub(super) fn heights(&self, sections: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let mut slopes = self.columns(sections, f64::NEG_INFINITY);
        for (k, (own, heights)) in slopes.iter_mut().zip(sections).enumerate() {
            let before = k.checked_sub(1).map(|j| self.sites[k] - self.sites[j]);
            let after = self.sites.get(k + 1).map(|next| next - self.sites[k]);
            for c in 1..own.len() {
                let room = 3.0 * (heights[c] - heights[c - 1]).max(0.0);
                let least = after.map_or(f64::NEG_INFINITY, |h| own[c - 1] - room / h);
                let most = before.map_or(f64::INFINITY, |h| own[c - 1] + room / h);
                own[c] = own[c].max(least).min(most);
            }
        }
        slopes
    }

    fn columns(&self, sections: &[Vec<f64>], floor: f64) -> Vec<Vec<f64>> {
        let mut slopes = vec![Vec::with_capacity(sections[0].len()); sections.len()];
        for c in 0..sections[0].len() {
            let values: Vec<f64> = sections.iter().map(|s| s[c]).collect();
            let mut own = self.free(&values);
            limits::limit(self.sites, &values, floor, &mut own);
            slopes.iter_mut().zip(own).for_each(|(list, slope)| list.push(slope));
        }
        slopes
    }

    /// Control values, one list a row of the net: values and slopes at the sections over knots that are double there.
    pub(super) fn control(&self, sections: &[Vec<f64>], slopes: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let at = |k: usize, reach: f64| -> Vec<f64> {
            sections[k].iter().zip(&slopes[k]).map(|(value, slope)| value + reach / 3.0 * slope).collect()
        };
        let last = sections.len() - 1;
        let mut rows = vec![sections[0].clone()];
        for k in 0..last {
            let h = self.sites[k + 1] - self.sites[k];
            rows.push(at(k, h));
            rows.push(at(k + 1, -h));
        }
        rows.push(sections[last].clone());
        rows
    }
}

/// Knots that are double at every inner site.
pub(super) fn double_knots(sites: &[f64]) -> Result<KnotVector, SplineError> {
    KnotVector::from_breakpoints(DEGREE, sites, &vec![2; sites.len() - 2])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spline::BsplineCurve;

    #[test]
    fn cubics_are_kept_where_nothing_stands_against_them() {
        let sites = [0.0, 0.15, 0.3, 0.55, 0.8, 1.0];
        let cubic = |t: f64| 1.0 + 2.0 * t + t * t + 0.5 * t * t * t;
        let sections: Vec<Vec<f64>> = sites.iter().map(|&t| vec![cubic(t), cubic(t) + 1.0]).collect();
        let along = Along::new(&sites, &[]).unwrap();
        let rows = along.control(&sections, &along.heights(&sections));
        let knots = double_knots(&sites).unwrap();
        for c in 0..2 {
            let points = rows.iter().map(|row| [row[c]]).collect();
            let curve = BsplineCurve::new(knots.clone(), points).unwrap();
            for n in 0..=50 {
                let t = f64::from(n) / 50.0;
                assert!((curve.eval(t)[0] - cubic(t) - c as f64).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn heights_keep_their_order_and_jumps_do_not_ring() {
        let sites: Vec<f64> = (0..8).map(|k| f64::from(k) / 7.0).collect();
        let keel: [f64; 8] = [0.0, -0.1, 0.1, -2.0, -2.1, 3.0, 3.2, 3.1];
        let sections: Vec<Vec<f64>> = keel.iter().map(|&z| vec![z, z.max(0.0), z.max(0.0) + 1e-3, 4.0]).collect();
        let along = Along::new(&sites, &[[4, 5]]).unwrap();
        let rows = along.control(&sections, &along.heights(&sections));
        for row in &rows {
            assert!(row.windows(2).all(|w| w[1] >= w[0] - 1e-12), "{row:?}");
            // A turn may need a third of the slope beside it, 0.1 and 0.2 a gap.
            assert!((-2.1 - 0.04..=3.2 + 0.04).contains(&row[0]), "{row:?}");
        }
    }
}
