//! The body of a hull as patches over rectangles of parameters: the side to port, and the halves of the faces that
//! close it.
//!
//! The side is S(u, v), above a knot line below the lowest deck drawn down to it: v = v_0 + (w - v_0) (d(u) - v_0) /
//! (v_1 - v_0) for w > v_0. A closing face is ruled from the centreplane to an edge of the side, (x, s y, z) with 0 <=
//! s <= 1.

use super::super::form::Hull;
use super::{Region, above_deck, deck_parameter};
use crate::spline::{cross, dot, length};
use std::cell::RefCell;
use std::collections::BTreeMap;

/// Half-breadths below this part of the greatest are on the centreplane.
const CENTREPLANE: f64 = 1e-9;

/// Part of the height of the lowest deck below which rows are not moved to the deck.
const UNMOVED: f64 = 0.75;

/// Knot lines at which the tangent plane turns by less are no edges of the mesh \[rad\].
const CREASE: f64 = 0.02;

/// Heights from the deck that are 0, over the depth, and steps until they are.
const DECK: f64 = 1e-13;
const SECANTS: usize = 8;

/// Points of a span of a knot line at which the turn of the tangent plane is looked at.
const LOOKS: usize = 4;

/// A quadratic form of directions.
pub(super) type Form = [[f64; 3]; 3];

/// All directions alike.
pub(super) const ROUND: Form = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A part of a line of the parameters of the side at which its tangent plane turns.
#[derive(Debug, Clone, Copy)]
pub(super) struct Crease {
    /// 0: a line u, 1: a line w.
    axis: usize,
    value: f64,
    from: f64,
    to: f64,
}

/// Where a vertex is: a point of the parameters of a patch, or a rectangle of them that shrinks to a point of the body.
#[derive(Debug, Clone, Copy)]
pub(super) struct Site {
    pub(super) region: Region,
    pub(super) low: [f64; 2],
    pub(super) high: [f64; 2],
}

impl Site {
    pub(super) const fn at(region: Region, place: [f64; 2]) -> Self {
        Self { region, low: place, high: place }
    }

    /// The same vertex has also this place on its patch.
    pub(super) fn add(&mut self, place: [f64; 2]) {
        self.low = [0, 1].map(|k| self.low[k].min(place[k]));
        self.high = [0, 1].map(|k| self.high[k].max(place[k]));
    }

    pub(super) fn is_point(&self) -> bool {
        self.low[0] >= self.high[0] && self.low[1] >= self.high[1]
    }

    pub(super) fn middle(&self) -> [f64; 2] {
        [0, 1].map(|k| 0.5 * (self.low[k] + self.high[k]))
    }

    /// The place nearest to `other`.
    pub(super) fn nearest(&self, other: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| other[k].clamp(self.low[k], self.high[k]))
    }
}

/// The port half of the body.
pub(super) struct Body<'a> {
    hull: &'a Hull,
    /// Ends of u and of w.
    pub(super) ends: [[f64; 2]; 2],
    /// Rows above this knot are moved to the deck.
    moved: f64,
    cut: bool,
    centreplane: f64,
    /// The v of the deck by the bits of u - u_0.
    tops: RefCell<BTreeMap<u64, f64>>,
    creases: Vec<Crease>,
}

impl<'a> Body<'a> {
    pub(super) fn new(hull: &'a Hull, us: &[f64]) -> Self {
        let surface = hull.surface();
        let ((a, b), (c, d)) = (surface.u().domain(), surface.v().domain());
        let tops: BTreeMap<u64, f64> = us.iter().map(|&u| ((u - a).to_bits(), deck_parameter(hull, u))).collect();
        let lowest = tops.values().copied().fold(d, f64::min);
        let knots = surface.v().breakpoints();
        let corner = |v: f64| surface.v().multiplicity(v) >= surface.v().degree();
        let kept = knots.iter().copied().filter(|&v| {
            let share = if corner(v) { 1.0 - 1e-6 } else { UNMOVED };
            v <= c + share * (lowest - c)
        });
        let moved = kept.fold(c, f64::max);
        let breadth = surface.points().iter().map(|p| p[1].abs()).fold(0.0, f64::max);
        let mut body = Self {
            hull,
            ends: [[a, b], [c, d]],
            moved,
            cut: lowest < d,
            centreplane: CENTREPLANE * breadth,
            tops: RefCell::new(tops),
            creases: Vec::new(),
        };
        body.creases = body.find_creases();
        body
    }

    fn find_creases(&self) -> Vec<Crease> {
        let surface = self.hull.surface();
        let mut found: Vec<Crease> = Vec::new();
        for axis in [0, 1] {
            let (knots, others) = if axis == 0 { (surface.u(), surface.v()) } else { (surface.v(), surface.u()) };
            let breaks = knots.breakpoints();
            for around in breaks.windows(3) {
                let value = around[1];
                let above = axis == 1 && self.cut && value > self.moved;
                if knots.multiplicity(value) < knots.degree() || above {
                    continue;
                }
                let before = value - 1e-7 * (value - around[0]);
                let normal = |t: f64, other: f64| {
                    let jet = if axis == 0 { surface.jet(t, other) } else { surface.jet(other, t) };
                    jet.curvature().map(|found| found.normal)
                };
                let turns = |other: f64| {
                    let both = normal(before, other).zip(normal(value, other));
                    both.is_some_and(|(p, q)| dot(p, q) < CREASE.cos())
                };
                for span in others.breakpoints().windows(2) {
                    let looks = (0..=LOOKS).map(|k| span[0] + (span[1] - span[0]) * k as f64 / LOOKS as f64);
                    if looks.into_iter().any(turns) {
                        match found.last_mut() {
                            Some(last)
                                if last.axis == axis
                                    && last.value.to_bits() == value.to_bits()
                                    && last.to.to_bits() == span[0].to_bits() =>
                            {
                                last.to = span[1];
                            }
                            _ => found.push(Crease { axis, value, from: span[0], to: span[1] }),
                        }
                    }
                }
            }
        }
        found
    }

    /// The v of the deck on the line `u`.
    fn top(&self, u: f64) -> f64 {
        let key = (u - self.ends[0][0]).max(0.0).to_bits();
        let mut tops = self.tops.borrow_mut();
        if let Some(&found) = tops.get(&key) {
            return found;
        }
        let before = tops.range(..key).next_back().map(|(&k, &v)| (f64::from_bits(k), v));
        let after = tops.range(key..).next().map(|(&k, &v)| (f64::from_bits(k), v));
        let found = match (before, after) {
            (Some((s, p)), Some((t, q))) => self.top_near(u, p + (q - p) * (f64::from_bits(key) - s) / (t - s)),
            _ => None,
        };
        let found = found.unwrap_or_else(|| deck_parameter(self.hull, u));
        tops.insert(key, found);
        found
    }

    /// The same by secants from a guess below the upper edge of the surface; none where they leave it or do not end.
    fn top_near(&self, u: f64, guess: f64) -> Option<f64> {
        let [low, high] = self.ends[1];
        let above = |v: f64| above_deck(self.hull, [u, v]);
        let slack = DECK * (self.hull.top() - self.hull.bottom());
        let (mut p, mut q) = (guess, guess - 1e-4 * (guess - low));
        let (mut f, mut g) = (above(p), above(q));
        for _ in 0..SECANTS {
            if f.abs() <= slack {
                return (p < high).then_some(p);
            }
            let next = p - f * (p - q) / (f - g);
            if !(low..=high).contains(&next) {
                return None;
            }
            (q, g) = (p, f);
            (p, f) = (next, above(next));
        }
        None
    }

    /// The v of a place (u, w) of the side.
    pub(super) fn height(&self, [u, w]: [f64; 2]) -> f64 {
        let last = self.ends[1][1];
        if !self.cut || w <= self.moved {
            return w;
        }
        let top = self.top(u);
        if top < last { self.moved + (w - self.moved) * (top - self.moved) / (last - self.moved) } else { w }
    }

    /// A point of the side; half-breadths that are 0 to rounding, or less, are 0.
    pub(super) fn side(&self, place: [f64; 2]) -> [f64; 3] {
        let [x, y, z] = self.hull.surface().point_of_many(place[0], self.height(place));
        [x, if y <= self.centreplane { 0.0 } else { y }, z]
    }

    /// The place of the side at which a closing face has its edge.
    pub(super) fn edge_place(&self, region: Region, along: f64) -> [f64; 2] {
        let [[a, b], [c, d]] = self.ends;
        match region {
            // The centreplane closes half of a finished mesh.
            Region::Hull | Region::Bottom | Region::Centreplane => [along, c],
            Region::Deck => [along, d],
            Region::Transom => [a, along],
            Region::Bow => [b, along],
        }
    }

    /// A point of a patch.
    pub(super) fn point(&self, region: Region, place: [f64; 2]) -> [f64; 3] {
        if region == Region::Hull {
            return self.side(place);
        }
        let [x, y, z] = self.side(self.edge_place(region, place[0]));
        [x, y * place[1], z]
    }

    /// The place of a vertex on a patch that it belongs to.
    pub(super) fn site_on(&self, site: &Site, region: Region, on_centreplane: bool) -> Site {
        if site.region == region {
            return *site;
        }
        let axis = usize::from(matches!(region, Region::Transom | Region::Bow));
        if site.region == Region::Hull {
            // Where the face has no breadth, all of its shares are one point.
            let share = if on_centreplane { 0.0 } else { 1.0 };
            return Site { region, low: [site.low[axis], share], high: [site.high[axis], 1.0] };
        }
        let end = |last: bool| self.ends[axis][usize::from(last)];
        let along = match region {
            Region::Hull | Region::Centreplane => return *site,
            Region::Bottom | Region::Deck => end(site.region == Region::Bow),
            Region::Transom | Region::Bow => end(site.region == Region::Deck),
        };
        Site { region, low: [along, site.low[1]], high: [along, site.high[1]] }
    }

    /// Whether the line between two vertices of the side is part of a crease.
    pub(super) fn is_crease(&self, a: &Site, b: &Site) -> bool {
        self.creases.iter().any(|crease| {
            let k = crease.axis;
            let on = |site: &Site| site.low[k] <= crease.value && crease.value <= site.high[k];
            let along = 0.5 * (a.middle()[1 - k] + b.middle()[1 - k]);
            on(a) && on(b) && crease.from <= along && along <= crease.to
        })
    }

    /// The largest principal curvature k of the side at a place \[1/m\], and the form that gives |normal curvature| / k
    /// of a direction; none where the surface has no tangent plane.
    pub(super) fn curvature(&self, place: [f64; 2]) -> Option<(f64, Form)> {
        let jet = self.hull.surface().jet(place[0], self.height(place));
        let found = jet.curvature()?;
        let [p, q] = found.principal.map(f64::abs);
        let largest = p.max(q);
        if !largest.is_finite() || largest <= 0.0 {
            return Some((0.0, ROUND));
        }
        // The shape operator over the dual of the tangents.
        let n = found.normal;
        let area = length(cross(jet.du, jet.dv));
        let dual = [cross(jet.dv, n), cross(n, jet.du)].map(|d| d.map(|c| c / area));
        let second = [[dot(jet.duu, n), dot(jet.duv, n)], [dot(jet.duv, n), dot(jet.dvv, n)]];
        let mut shape = [[0.0; 3]; 3];
        for i in 0..2 {
            for j in 0..2 {
                for (r, row) in shape.iter_mut().enumerate() {
                    for (c, slot) in row.iter_mut().enumerate() {
                        *slot += second[i][j] * dual[i][r] * dual[j][c];
                    }
                }
            }
        }
        // |A| = (A^2 + |k_1 k_2| I) / (|k_1| + |k_2|) in the tangent plane.
        let mut form = [[0.0; 3]; 3];
        for (r, row) in form.iter_mut().enumerate() {
            for (c, slot) in row.iter_mut().enumerate() {
                let squared: f64 = (0..3).map(|k| shape[r][k] * shape[k][c]).sum();
                let one = if r == c { 1.0 } else { 0.0 };
                *slot = (squared + p * q * one) / ((p + q) * largest);
            }
        }
        Some((largest, form))
    }
}
