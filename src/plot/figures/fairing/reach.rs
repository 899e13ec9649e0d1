//! Parts of a ship along its length: long or crowded views have a sheet for each half.

use crate::plot::paper::canvas::{Canvas, Rectangle};
use crate::plot::paper::scale::rule_scale;
use crate::plot::ship::extent::LONG_SIDES;
use crate::plot::ship::view::DESIGN;

/// Room forward of half a ship \[mm\].
pub(in crate::plot) const HALF_SIDE: f64 = 5.5;
/// Scale 1 : n of a view along the ship on A3 from which on its halves have a sheet each: rings and names have no room.
const CROWDED: u32 = 1000;
/// Distance of rings that can be told apart \[mm\].
const RINGS_APART: f64 = 2.5;

/// A part of a ship along its length.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::plot) struct Reach {
    /// Aft and fore end \[m\].
    pub(in crate::plot) x: [f64; 2],
    /// What it is called; nothing where it is the whole.
    pub(in crate::plot) name: String,
    /// Whether its ends are those of the ship.
    pub(in crate::plot) outer: [bool; 2],
}

impl Reach {
    /// The whole ship.
    pub(in crate::plot) fn whole(x: [f64; 2]) -> Self {
        Self { x, name: String::new(), outer: [true; 2] }
    }

    /// The whole ship from `x[0]` to `x[1]`; its halves where on A3 the places of
    /// rings on each of its lines say that it is crowded, or its scale, and halves have a larger one. `scale` is the n of
    /// the scale 1 : n of a part.
    pub(in crate::plot) fn sheets(x: [f64; 2], scale: impl Fn(&Self) -> u32, rings: &[Vec<[f64; 2]>]) -> Vec<Self> {
        let near = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < RINGS_APART;
        let touch = |line: &Vec<[f64; 2]>| (1..line.len()).any(|k| line[..k].iter().any(|other| near(other, &line[k])));
        let whole = Self::whole(x);
        let n = scale(&whole);
        if n < CROWDED && !rings.iter().any(touch) {
            return vec![whole];
        }
        let halves = Self::halves(x);
        if halves.iter().all(|half| scale(half) < n) { halves } else { vec![whole] }
    }

    fn halves(x: [f64; 2]) -> Vec<Self> {
        let at = 0.5 * (x[0] + x[1]);
        let named = |half: &str, to: &str| format!(", {half} BODY {to} x = {at:.2} m");
        vec![
            Self { x: [x[0], at], name: named("AFT", "TO"), outer: [true, false] },
            Self { x: [at, x[1]], name: named("FORE", "FROM"), outer: [false, true] },
        ]
    }

    pub(in crate::plot) fn length(&self) -> f64 {
        self.x[1] - self.x[0]
    }

    pub(in crate::plot) fn is_whole(&self) -> bool {
        self.outer == [true; 2]
    }

    /// The longest of some.
    pub(in crate::plot) fn longest(reaches: &[Self]) -> Option<&Self> {
        reaches.iter().max_by(|a, b| a.length().total_cmp(&b.length()))
    }

    /// The largest scale 1 : n at which it fits along `paper` \[mm\].
    pub(in crate::plot) fn scale(&self, paper: [f64; 2]) -> u32 {
        let forward = if self.is_whole() { LONG_SIDES[1] } else { HALF_SIDE };
        rule_scale(self.length(), paper[0] - LONG_SIDES[0] - forward)
    }

    /// Whether a place along the ship belongs to it.
    pub(in crate::plot) fn has(&self, x: f64) -> bool {
        let slack = 1e-9 * self.length();
        (self.outer[0] || x >= self.x[0] - slack) && (self.outer[1] || x <= self.x[1] + slack)
    }

    /// What is drawn of a view with it from `sides[0]` to `sides[1]` on `paper` \[mm\]: all there is beyond the ends of the
    /// ship, and nothing of the other half.
    pub(in crate::plot) fn window(&self, sides: [f64; 2], paper: [f64; 2]) -> Rectangle {
        let left = if self.outer[0] { 0.0 } else { sides[0] };
        let right = if self.outer[1] { paper[0] } else { sides[1] };
        Rectangle::new(left, 0.0, right, paper[1])
    }

    /// Where the other half begins: at `sides` on a view from `top` to `bottom` \[mm\]; what was drawn.
    pub(in crate::plot) fn draw_border(
        &self,
        canvas: &mut Canvas,
        sides: [f64; 2],
        [top, bottom]: [f64; 2],
    ) -> Option<[[f64; 2]; 2]> {
        let mut drawn = None;
        for (outer, x) in self.outer.into_iter().zip(sides) {
            if !outer {
                let border = [[x, top], [x, bottom]];
                canvas.line(border[0], border[1], &DESIGN);
                drawn = Some(border);
            }
        }
        drawn
    }
}
