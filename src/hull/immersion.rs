//! The immersed part of the parameter plane below a draught: v from v_min up to the waterline or, where it is lower,
//! the deck.
//!
//! On the line u = constant the body ends at v_end(u) = min(v_T(u), v_deck(u)), v_T(u) being the v at which z(u, v) is
//! the draught (v_max where all of the line is immersed) and v_deck(u) the lowest v at which z is the deck height at
//! x(u, v).
//!
//! Level hulls: while the deck is dry everywhere, v_end is v_T for every u. Where it is immersed, the plane is split in
//! u where the deck meets the waterline, a knot line v_k or a knot of the deck, so that v_end(u) is smooth within each
//! piece.
//!
//! Other hulls: the plane is split as well where the waterline crosses a knot line v_k, leaves through the keel line or
//! meets the upper edge, and there are no pieces where nothing is immersed. Where the waterline leaves through the keel
//! line of a graded chart, v_T(u) is like a square root; rules on such pieces run in t of u = a + (b - a) t^2 (3 - 2t).

use std::sync::OnceLock;

use super::chart;
use super::form::Hull;
use crate::numeric::{bracketed_root, gauss_legendre};

/// Intervals in which a span is searched for points where the deck meets a line v = constant.
const SAMPLES: usize = 16;

/// Nodes of a rule on a piece whose end is singular, and on any other one that is not polynomial.
const SINGULAR_NODES: usize = 24;
const SMOOTH_NODES: usize = 14;

/// A keel line as near to the waterline as this part of the height of the hull makes the end of a piece singular.
const NEAR_KEEL: f64 = 0.05;

/// What the body ends at, on a piece in u.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum UpperEnd {
    /// The waterline v = v_T (or the top of the surface when the draught is above it).
    Waterline,
    /// The deck at side, or the upper edge of the surface.
    Deck,
}

/// A piece [from, to] of one span in u.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Piece {
    /// Index of the span.
    pub(crate) span: usize,
    /// Lower end.
    pub(crate) from: f64,
    /// Upper end.
    pub(crate) to: f64,
    /// What closes the body above.
    pub(crate) upper: UpperEnd,
    /// Whether v_end is singular at an end of the piece.
    pub(crate) singular: bool,
    /// Whether v_end is the same for all of it.
    pub(crate) straight: bool,
}

impl Piece {
    /// Nodes and weights in u; at least `exact` of them, which do for the polynomials of a piece with a constant v_end.
    pub(crate) fn nodes(&self, exact: usize) -> Vec<(f64, f64)> {
        if self.straight {
            return gauss_legendre(exact).on(self.from, self.to).collect();
        }
        if !self.singular {
            return gauss_legendre(exact.max(SMOOTH_NODES)).on(self.from, self.to).collect();
        }
        let width = self.to - self.from;
        let rule = gauss_legendre(exact.max(SINGULAR_NODES)).on(0.0, 1.0);
        rule.map(|(t, w)| (self.from + width * t * t * (3.0 - 2.0 * t), w * width * 6.0 * t * (1.0 - t))).collect()
    }
}

/// The body below one draught.
#[derive(Debug, Clone)]
pub(crate) struct Immersion<'a> {
    hull: &'a Hull,
    draught: f64,
    waterline: f64,
    above: bool,
    deck_immersed: bool,
    /// Below this a height is the draught \[m\].
    slack: f64,
    /// The pieces in u, once they have been asked for.
    pieces: OnceLock<Vec<Piece>>,
}

impl<'a> Immersion<'a> {
    /// None when nothing is immersed: the draught is below the lowest line, or is not a number.
    pub(crate) fn new(hull: &'a Hull, draught: f64) -> Option<Self> {
        // Draughts that miss the lowest or the highest line by rounding are at that line.
        let rounding = 1e-12 * (hull.top() - hull.bottom());
        if draught.is_nan() || draught < hull.bottom() - rounding {
            return None;
        }
        let (lowest, highest) = hull.surface().v().domain();
        let above = draught > hull.top() + rounding;
        let waterline = if draught >= hull.top() || !hull.is_level() {
            highest
        } else if draught <= hull.bottom() {
            lowest
        } else {
            hull.height_parameter(draught)?
        };
        let lowest_deck = hull.deck().points().iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
        let slack = 1e-9 * (hull.top() - hull.bottom());
        let draught = draught.clamp(hull.bottom(), hull.top());
        let deck_immersed = hull.is_cut_by_deck() && draught > lowest_deck + slack;
        Some(Self { hull, draught, waterline, above, deck_immersed, slack, pieces: OnceLock::new() })
    }

    /// The draught, the top of the surface when it is above that \[m\].
    pub(crate) fn draught(&self) -> f64 {
        self.draught
    }

    /// v_T of a level hull, or the upper end of the domain when the draught is above the surface; the upper end of
    /// other hulls.
    pub(crate) fn waterline(&self) -> f64 {
        self.waterline
    }

    /// Whether the draught is above the highest line of the surface.
    pub(crate) fn above(&self) -> bool {
        self.above
    }

    /// Whether the control points of the deck leave room for a part of the deck to be immersed.
    pub(crate) fn deck_immersed(&self) -> bool {
        self.deck_immersed
    }

    /// Height above the deck at side of the point (u, v) \[m\].
    fn above_deck(&self, u: f64, v: f64) -> f64 {
        let [x, _, z] = self.hull.surface().eval(u, v);
        z - self.hull.deck_height(x)
    }

    /// v_end(u).
    pub(crate) fn end(&self, u: f64) -> f64 {
        if !self.hull.is_level() {
            return self.end_at(u);
        }
        if !self.deck_immersed || self.above_deck(u, self.waterline) <= 0.0 {
            return self.waterline;
        }
        let (lowest, highest) = self.hull.surface().v().domain();
        if self.above_deck(u, lowest) >= 0.0 {
            return lowest;
        }
        let tolerance = f64::EPSILON * (highest - lowest);
        bracketed_root(|v| self.above_deck(u, v), lowest, self.waterline, tolerance).unwrap_or(self.waterline)
    }

    /// The v at which the section at `x` ends.
    pub(crate) fn section_end(&self, x: f64) -> f64 {
        if !self.hull.is_level() {
            let deck = if self.deck_immersed { self.hull.deck_height(x) } else { f64::INFINITY };
            return chart::end_along(self.hull, x, self.draught.min(deck));
        }
        if !self.deck_immersed {
            return self.waterline;
        }
        let deck = self.hull.deck_height(x);
        if deck >= self.draught {
            return self.waterline;
        }
        self.hull.height_parameter(deck).unwrap_or(self.hull.surface().v().domain().0)
    }

    /// v_end(u) of a hull that is not level.
    fn end_at(&self, u: f64) -> f64 {
        let surface = self.hull.surface();
        let (lowest, highest) = surface.v().domain();
        let afloat = if surface.eval(u, highest)[2] <= self.draught + 1e-3 * self.slack {
            highest
        } else {
            self.hull.height_parameter_at(u, self.draught).unwrap_or(lowest)
        };
        if !self.deck_immersed || self.above_deck(u, afloat) <= 0.0 {
            return afloat;
        }
        if self.above_deck(u, lowest) >= 0.0 {
            return lowest;
        }
        bracketed_root(|v| self.above_deck(u, v), lowest, afloat, f64::EPSILON * (highest - lowest)).unwrap_or(afloat)
    }

    /// Where v_end(u) of a hull that is not level is not smooth, besides the knots in u.
    fn cuts(&self) -> Vec<f64> {
        let surface = self.hull.surface();
        let (lowest, _) = surface.v().domain();
        let breakpoints = surface.v().breakpoints();
        let mut cuts: Vec<f64> = breakpoints.iter().flat_map(|&v| chart::passages(surface, v, self.draught)).collect();
        // A keel line that turns close to the waterline.
        if let Some(keel) = chart::coordinate(&surface.curve_at_v(lowest), 2, self.draught) {
            let near = NEAR_KEEL * (self.hull.top() - self.hull.bottom());
            cuts.extend(chart::turns(&keel).into_iter().filter(|&u| keel.eval(u)[0].abs() < near));
        }
        if self.deck_immersed {
            cuts.extend(self.deck_knots());
            let spans: Vec<[f64; 2]> = surface.u().breakpoints().windows(2).map(|w| [w[0], w[1]]).collect();
            let over = |u: f64, v: f64| self.above_deck(u, v);
            let afloat = |u: f64| self.hull.height_parameter_at(u, self.draught);
            for [from, to] in spans {
                for &v in &breakpoints {
                    cuts.extend(crossings(|u| over(u, v), from, to));
                }
                // Where nothing is afloat there is no gap.
                cuts.extend(crossings(|u| afloat(u).map_or(f64::NAN, |v| over(u, v)), from, to));
            }
        }
        cuts.sort_by(f64::total_cmp);
        cuts
    }

    /// The pieces of a hull that is not level.
    fn pieces_of_chart(&self) -> Vec<Piece> {
        let surface = self.hull.surface();
        let knots = surface.u();
        let (lowest, highest) = surface.v().domain();
        let near = NEAR_KEEL * (self.hull.top() - self.hull.bottom());
        let (cuts, mut pieces) = (self.cuts(), Vec::new());
        for span in knots.spans() {
            let (from, to) = (knots.knots()[span], knots.knots()[span + 1]);
            let mut low = from;
            for cut in cuts.iter().copied().filter(|&u| u > from && u < to).chain([to]) {
                if cut - low <= 1e-13 * (to - from) && cut < to {
                    continue;
                }
                let (a, b) = (low, cut);
                low = cut;
                let middle = 0.5 * (a + b);
                if surface.eval(middle, lowest)[2] > self.draught + self.slack {
                    continue;
                }
                let end = self.end(middle);
                let afloat = surface.eval(middle, end)[2] >= self.draught - self.slack;
                let upper = if afloat { UpperEnd::Waterline } else { UpperEnd::Deck };
                let same = |u: f64| self.end(u).to_bits() == highest.to_bits();
                let straight = same(middle) && same(0.75 * a + 0.25 * b) && same(0.25 * a + 0.75 * b);
                let singular =
                    !straight && [a, b].iter().any(|&u| (surface.eval(u, lowest)[2] - self.draught).abs() < near);
                pieces.push(Piece { span, from: a, to: b, upper, singular, straight });
            }
        }
        pieces
    }

    /// The pieces in u, in order; on level hulls one a span while the deck is dry.
    pub(crate) fn pieces(&self) -> &[Piece] {
        self.pieces.get_or_init(|| if self.hull.is_level() { self.pieces_of_level() } else { self.pieces_of_chart() })
    }

    /// The pieces of a level hull.
    fn pieces_of_level(&self) -> Vec<Piece> {
        let knots = self.hull.surface().u();
        let mut pieces = Vec::new();
        let lines = if self.deck_immersed { self.lines() } else { Vec::new() };
        let deck_knots = if self.deck_immersed { self.deck_knots() } else { Vec::new() };
        for span in knots.spans() {
            let (from, to) = (knots.knots()[span], knots.knots()[span + 1]);
            if !self.deck_immersed {
                let upper = UpperEnd::Waterline;
                pieces.push(Piece { span, from, to, upper, singular: false, straight: true });
                continue;
            }
            let mut cuts: Vec<f64> = deck_knots.iter().copied().filter(|&u| u > from && u < to).collect();
            for &v in &lines {
                cuts.extend(crossings(|u| self.above_deck(u, v), from, to));
            }
            cuts.push(to);
            cuts.sort_by(f64::total_cmp);
            let mut low = from;
            for cut in cuts {
                // Cuts closer than rounding make no piece.
                if cut - low <= 1e-13 * (to - from) && cut < to {
                    continue;
                }
                let dry = self.above_deck(0.5 * (low + cut), self.waterline) <= 0.0;
                let upper = if dry { UpperEnd::Waterline } else { UpperEnd::Deck };
                pieces.push(Piece { span, from: low, to: cut, upper, singular: false, straight: dry });
                low = cut;
            }
        }
        pieces
    }

    /// The lines v at which v_end(u) is not smooth: the waterline and the knot lines below it.
    fn lines(&self) -> Vec<f64> {
        let mut lines: Vec<f64> =
            self.hull.surface().v().breakpoints().into_iter().filter(|&v| v < self.waterline).collect();
        lines.push(self.waterline);
        lines
    }

    /// Parameters u at which the knots of the deck lie.
    fn deck_knots(&self) -> Vec<f64> {
        let deck = self.hull.deck();
        let ends = deck.knots().breakpoints();
        ends.iter()
            .filter_map(|&t| {
                let [x, z] = deck.eval(t);
                self.hull.parameters(x, z).map(|[u, _]| u)
            })
            .collect()
    }
}

/// The roots of `function` between `from` and `to` that [`SAMPLES`] equal intervals show; where it is not a number
/// there is none.
fn crossings(function: impl Fn(f64) -> f64, from: f64, to: f64) -> Vec<f64> {
    let at = |k: usize| from + (to - from) * k as f64 / SAMPLES as f64;
    let values: Vec<f64> = (0..=SAMPLES).map(|k| function(at(k))).collect();
    let tolerance = f64::EPSILON * (to - from);
    let changes = (0..SAMPLES).filter(|&k| values[k] * values[k + 1] <= 0.0);
    changes.filter_map(|k| bracketed_root(&function, at(k), at(k + 1), tolerance).ok()).collect()
}
