//! The surface of a hull whose deck at side cuts it, up to the deck: below a line of the net as it is, above it anew.
//!
//! With v = d(u) the parameter of the deck, the part above the knot v_0 <= min d is
//!
//! ```text
//! T(u, t) = S(u, v_0 + t (d(u) - v_0)),   0 <= t <= 1.
//! ```
//!
//! Where no knot lies between v_0 and the deck, T is a polynomial of the degree of S in t, and only its coefficients,
//! functions of u, are interpolated: by splines two degrees higher, as smooth as S at the knots of S, with corners
//! where the deck has knots, so that the lower edge is that of the part below to rounding. Where the deck crosses knots
//! they are lines that move in t; T is then interpolated in t too. Spans are halved until the deviation, measured
//! between the points that are met, is small enough or spans are too many.

use super::super::form::Hull;
use super::super::mesh::deck_parameter;
use crate::spline::{BsplineSurface, KnotVector, MAX_DEGREE, SplineError, length, minus};

/// A deviation of this part of the breadth is small enough.
const ENOUGH: f64 = 1e-9;

/// The part above begins below the lowest deck by this part of the parameters at least.
const LEAST: f64 = 1e-3;

/// Degrees by which the new part is above the surface.
const HIGHER: usize = 2;

/// Parts of a span of knots at which the deck is looked at.
const SAMPLES: usize = 8;

/// Parts of the spans of the new part in u: those tried.
const PARTS: [usize; 3] = [1, 2, 4];

/// Spans in t for each span of the surface that the deck crosses.
const ACROSS: usize = 8;

/// The parts of the surface, from below, and what they leave it by \[m\].
pub(super) struct Parts {
    pub(super) surfaces: Vec<BsplineSurface<3>>,
    pub(super) deviation: f64,
}

/// Places in u, between the knots, where the deck at side has a knot or leaves the upper edge of the surface.
fn corners(hull: &Hull, deck: &impl Fn(f64) -> f64, sites: &[f64]) -> Vec<f64> {
    let surface = hull.surface();
    let to = surface.v().domain().1;
    let halved = |from: f64, to: f64, first: &dyn Fn(f64) -> bool| {
        let (mut low, mut high) = (from, to);
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if first(middle) { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    };
    let mut found = Vec::new();
    let curve = hull.deck();
    let inner: Vec<f64> = curve.knots().breakpoints().into_iter().map(|s| curve.eval(s)[0]).collect();
    let x = |u: f64| surface.eval(u, deck(u))[0];
    for pair in sites.windows(2) {
        let (here, there) = (x(pair[0]), x(pair[1]));
        found.extend(
            inner.iter().filter(|&&at| here < at && at < there).map(|&at| halved(pair[0], pair[1], &|u| x(u) < at)),
        );
        let open = [pair[0], pair[1]].map(|u| deck(u) < to);
        if open[0] != open[1] {
            found.push(halved(pair[0], pair[1], &|u| (deck(u) < to) == open[0]));
        }
    }
    found
}

/// Knots of a higher degree over the same breakpoints, as smooth, each span in parts; with corners.
fn raised(knots: &KnotVector, corners: &[f64], parts: usize) -> Result<KnotVector, SplineError> {
    let higher = HIGHER.min(MAX_DEGREE.saturating_sub(knots.degree()));
    let degree = knots.degree() + higher;
    let (from, to) = knots.domain();
    let near = 1e-7 * (to - from);
    let mut breaks: Vec<(f64, usize)> =
        knots.breakpoints().into_iter().map(|at| (at, (knots.multiplicity(at) + higher).min(degree))).collect();
    for &corner in corners {
        match breaks.iter_mut().find(|(at, _)| (at - corner).abs() < near) {
            Some((at, times)) if *at > from && *at < to => *times = degree,
            Some(_) => {}
            None => breaks.push((corner, degree)),
        }
    }
    breaks.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut fine = Vec::new();
    for pair in breaks.windows(2) {
        fine.push(pair[0]);
        let (low, width) = (pair[0].0, pair[1].0 - pair[0].0);
        fine.extend((1..parts).map(|k| (low + width * k as f64 / parts as f64, 1)));
    }
    fine.extend(breaks.last());
    let (places, times): (Vec<f64>, Vec<usize>) = fine.into_iter().unzip();
    KnotVector::from_breakpoints(degree, &places, &times[1..times.len() - 1])
}

/// The surface up to its deck at side, in one part where the deck does not cut it.
pub(super) fn below_deck(hull: &Hull) -> Result<Parts, SplineError> {
    let surface = hull.surface();
    let (from, to) = surface.v().domain();
    let deck = |u: f64| deck_parameter(hull, u);
    let breaks = surface.u().breakpoints();
    let within = |w: &[f64], k: usize| w[0] + (w[1] - w[0]) * k as f64 / SAMPLES as f64;
    let mut sites: Vec<f64> = breaks.windows(2).flat_map(|w| (0..SAMPLES).map(move |k| within(w, k))).collect();
    sites.extend(breaks.last());
    let tops: Vec<f64> = sites.iter().map(|&u| deck(u)).collect();
    let (lowest, highest) = tops.iter().fold((to, from), |(a, b), &v| (a.min(v), b.max(v)));
    if lowest >= to {
        return Ok(Parts { surfaces: vec![surface.clone()], deviation: 0.0 });
    }
    let begin =
        surface.v().breakpoints().into_iter().filter(|&v| v <= lowest - LEAST * (to - from)).fold(from, f64::max);
    let crossed = surface.v().breakpoints().into_iter().filter(|&v| begin < v && v < highest).count();
    let t = if crossed == 0 {
        KnotVector::uniform(surface.v().degree(), 1)?
    } else {
        let degree = (surface.v().degree() + HIGHER).min(MAX_DEGREE);
        KnotVector::uniform(degree, ACROSS * (crossed + 1))?
    };
    let corners = corners(hull, &deck, &sites);
    let breadth = surface.points().iter().map(|p| p[1].abs()).fold(0.0, f64::max);
    let point = |u: f64, top: f64, t: f64| surface.eval(u, begin + t * (top - begin));
    let middles = |sites: &[f64]| sites.windows(2).map(|w| 0.5 * (w[0] + w[1])).collect::<Vec<_>>();
    let ts = t.greville();
    let mut best: Option<(BsplineSurface<3>, f64)> = None;
    for parts in PARTS {
        let u = raised(surface.u(), &corners, parts)?;
        let us = u.greville();
        let mut points = Vec::with_capacity(us.len() * ts.len());
        for &s in &us {
            let top = deck(s);
            points.extend(ts.iter().map(|&t| point(s, top, t)));
        }
        let above = BsplineSurface::interpolate([u, t.clone()], [&us, &ts], &points)?;
        let mut deviation = 0.0_f64;
        for s in middles(&us) {
            let top = deck(s);
            for t in middles(&ts) {
                deviation = deviation.max(length(minus(above.eval(s, t), point(s, top, t))));
            }
        }
        if best.as_ref().is_none_or(|(_, found)| deviation < *found) {
            best = Some((above, deviation));
        }
        if deviation <= ENOUGH * breadth {
            break;
        }
    }
    let (above, deviation) = best.unwrap_or_else(|| (surface.clone(), 0.0));
    let mut surfaces = Vec::new();
    if begin > from {
        let (a, b) = surface.u().domain();
        surfaces.push(surface.part([a, b], [from, begin])?);
    }
    surfaces.push(above);
    Ok(Parts { surfaces, deviation })
}
