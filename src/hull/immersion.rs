//! The immersed part of the parameter plane below a draught: v from v_min up to the waterline or, where it is lower, the deck.
//!
//! On the line u = constant the body ends at v_end(u) = min(v_T, v_deck(u)), v_deck(u) being the lowest v at which
//! z(v) = deck height at x(u, v). While the deck is dry everywhere, v_end is v_T for every u. Where it is immersed, the plane
//! is split in u where the deck meets the waterline, a knot line v_k or a knot of the deck, so that v_end(u) is smooth
//! within each piece.

use super::form::Hull;
use crate::numeric::bracketed_root;

/// Intervals in which a span is searched for points where the deck meets a line v = constant.
const SAMPLES: usize = 16;

/// What the body ends at, on a piece in u.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum UpperEnd {
    /// The waterline v = v_T (or the top of the surface when the draught is above it).
    Waterline,
    /// The deck at side.
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
}

/// The body below one draught.
#[derive(Debug, Clone)]
pub(crate) struct Immersion<'a> {
    hull: &'a Hull,
    draught: f64,
    waterline: f64,
    above: bool,
    deck_immersed: bool,
}

impl<'a> Immersion<'a> {
    /// None when nothing is immersed: the draught is below the lowest line, or is not a number.
    pub(crate) fn new(hull: &'a Hull, draught: f64) -> Option<Self> {
        // Draughts that miss the lowest or the highest line by rounding are at that line.
        let rounding = 1e-12 * (hull.top() - hull.bottom());
        if draught.is_nan() || draught < hull.bottom() - rounding {
            return None;
        }
        let (lowest, highest) = hull.heights().knots().domain();
        let above = draught > hull.top() + rounding;
        let waterline = if draught >= hull.top() {
            highest
        } else if draught <= hull.bottom() {
            lowest
        } else {
            hull.height_parameter(draught)?
        };
        let lowest_deck = hull.deck().points().iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
        let slack = 1e-9 * (hull.top() - hull.bottom());
        let mut immersion =
            Self { hull, draught: draught.clamp(hull.bottom(), hull.top()), waterline, above, deck_immersed: false };
        if immersion.draught > lowest_deck + slack {
            immersion.deck_immersed = true;
        }
        Some(immersion)
    }

    /// The draught, the top of the surface when it is above that \[m\].
    pub(crate) fn draught(&self) -> f64 {
        self.draught
    }

    /// v_T, or the upper end of the domain when the draught is above the surface.
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
        if !self.deck_immersed || self.above_deck(u, self.waterline) <= 0.0 {
            return self.waterline;
        }
        let (lowest, highest) = self.hull.heights().knots().domain();
        if self.above_deck(u, lowest) >= 0.0 {
            return lowest;
        }
        let tolerance = f64::EPSILON * (highest - lowest);
        bracketed_root(|v| self.above_deck(u, v), lowest, self.waterline, tolerance).unwrap_or(self.waterline)
    }

    /// The v at which the section at `x` ends.
    pub(crate) fn section_end(&self, x: f64) -> f64 {
        if !self.deck_immersed {
            return self.waterline;
        }
        let deck = self.hull.deck_height(x);
        if deck >= self.draught {
            return self.waterline;
        }
        self.hull.height_parameter(deck).unwrap_or(self.hull.heights().knots().domain().0)
    }

    /// The pieces in u, in order; one a span while the deck is dry.
    pub(crate) fn pieces(&self) -> Vec<Piece> {
        let knots = self.hull.surface().u();
        let mut pieces = Vec::new();
        let lines = if self.deck_immersed { self.lines() } else { Vec::new() };
        let deck_knots = if self.deck_immersed { self.deck_knots() } else { Vec::new() };
        for span in knots.spans() {
            let (from, to) = (knots.knots()[span], knots.knots()[span + 1]);
            if !self.deck_immersed {
                pieces.push(Piece { span, from, to, upper: UpperEnd::Waterline });
                continue;
            }
            let mut cuts: Vec<f64> = deck_knots.iter().copied().filter(|&u| u > from && u < to).collect();
            let tolerance = f64::EPSILON * (to - from);
            for &v in &lines {
                let height = |u: f64| self.above_deck(u, v);
                for k in 0..SAMPLES {
                    let at = |k: usize| from + (to - from) * k as f64 / SAMPLES as f64;
                    if let Ok(u) = bracketed_root(height, at(k), at(k + 1), tolerance) {
                        cuts.push(u);
                    }
                }
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
                pieces.push(Piece { span, from: low, to: cut, upper });
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
                self.hull.length_parameter(x, self.hull.height_parameter(z)?)
            })
            .collect()
    }
}
