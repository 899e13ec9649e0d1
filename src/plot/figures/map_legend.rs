//! The legend under the maps of the side of a hull: what colours, lines and hatched fields are.

use crate::plot::paper::canvas::{Anchor, Canvas, Pen, Rectangle, TextStyle};
use crate::plot::paper::font::LEAST_LETTERS;
use crate::plot::paper::scale::{decimals, figures, nice_step};

/// Steps of colour on each side of white.
pub(in crate::plot) const STEPS: i32 = 7;

/// Part of the surface that the full colours hold.
pub(in crate::plot) const SHARE: f64 = 0.95;

/// Size of the text \[mm\].
pub(in crate::plot) const TEXT: f64 = 3.1;

/// Lines across which curvature jumps, and knuckles.
pub(in crate::plot) const JUMP: Pen = Pen::new(0.25, "#d0107a").dashed(&[1.6, 0.9]);

pub(in crate::plot) const KNUCKLE_LINE: Pen = Pen::new(0.6, "#d0107a");

/// Stations beyond which girths begin at the stern or stem profile, and how far inside the ends they are marked, in
/// lengths of the hull.
pub(in crate::plot) const KEEL_END: Pen = Pen::new(0.3, "#000000").dashed(&[0.5, 0.9]);

/// Lines where there is no side, and their distance \[mm\]: a grey would be that of a colour in black and white.
const NO_SIDE: Pen = Pen::new(0.12, "#a0a0a0");

const APART: f64 = 2.2;

/// Hatches a field where there is no side.
pub(in crate::plot) fn hatch(canvas: &mut Canvas, field: &Rectangle) {
    canvas.begin_clip(field);
    let count = ((field.width() + field.height()) / APART).floor() as i32;
    for k in 1..=count {
        let by = APART * f64::from(k);
        canvas.line([field.left + by, field.top], [field.left, field.top + by], &NO_SIDE);
    }
    canvas.end_group();
}

/// What is mapped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SurfaceMapKind {
    /// Gaussian curvature.
    Gaussian,
    /// Mean curvature.
    Mean,
    /// Reflections.
    Zebra,
}

/// Left edge of the legend, width of a field of colour, and distance of the rows \[mm\].
const LEFT: f64 = 26.0;
const SWATCH: f64 = 14.0;
const ROW: f64 = 6.0;

/// What the legend has to say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::plot) struct Legend {
    pub(in crate::plot) kind: SurfaceMapKind,
    /// Curvature of the full colours.
    pub(in crate::plot) full: f64,
    /// Curvature that both sides of a line of zero reach beside it, as a part of the full colours.
    pub(in crate::plot) floor: f64,
    /// Knot lines at which curvature may jump and that are not marked.
    pub(in crate::plot) more: usize,
    /// Whether lines where curvature jumps, and knuckles, are marked.
    pub(in crate::plot) marked: [bool; 2],
    /// Whether ends of the keel are marked.
    pub(in crate::plot) ends: bool,
    /// Whether the hull before fairing is there too.
    pub(in crate::plot) pair: bool,
}

impl Legend {
    /// Draws the legend, its first row at `y`.
    pub(in crate::plot) fn draw(&self, canvas: &mut Canvas, y: f64) {
        let style = TextStyle::new(TEXT, Anchor::Start);
        self.colours(canvas, y);
        let mut x = LEFT;
        let mut item = |canvas: &mut Canvas, row: f64, pen: Option<&Pen>, words: &str, first: bool| {
            if first {
                x = LEFT;
            }
            let at = y + row * ROW;
            if let Some(pen) = pen {
                canvas.line([x, at], [x + 11.0, at], pen);
            } else {
                let field = Rectangle::new(x, at - 1.8, x + 11.0, at + 1.8);
                hatch(canvas, &field);
                canvas.rectangle(&field, &Pen::new(0.08, "#808080"));
            }
            canvas.text([x + 13.0, at], words, &style);
            x = Canvas::text_place([x + 13.0, at], words, &style).right + 6.0;
        };
        item(canvas, 1.0, None, "no side: beyond deck and profiles, or on the flat of bottom, which is plane", true);
        if self.marked[0] {
            item(canvas, 1.0, Some(&JUMP), "curvature jumps across a line of the surface", false);
        }
        if self.marked[1] {
            item(canvas, 1.0, Some(&KNUCKLE_LINE), "knuckle", false);
        }
        if self.ends {
            let colours = if self.kind == SurfaceMapKind::Zebra { "stripes" } else { "colours" };
            let words = format!(
                "end of the keel: beyond it girths begin at the profile; rows step there, and {colours} with them, not the surface"
            );
            item(canvas, 2.0, Some(&KEEL_END), &words, true);
        }
        if self.more > 0 {
            let words = format!("curvature may jump at {} lines of the surface, too many to be drawn", self.more);
            canvas.text([LEFT, y + 3.0 * ROW], &words, &style);
        } else if self.pair && self.marked[0] {
            let words = "before and after have the same net: through the table its lines carry a continuous curvature, after fairing they need \
                         not, so that dashes may stand after alone";
            canvas.text([LEFT, y + 3.0 * ROW], words, &style);
        }
    }

    /// What the colours are, or what stripes are.
    fn colours(&self, canvas: &mut Canvas, y: f64) {
        let (kind, full) = (self.kind, self.full);
        let style = TextStyle::new(TEXT, Anchor::Start);
        if kind == SurfaceMapKind::Zebra {
            let words = "reflections of lamps along the ship, seen from abeam: a kink on a dashed line is a jump of curvature, a step a break of \
                         the tangent plane";
            canvas.text([LEFT, y], words, &style);
            return;
        }
        if full <= 0.0 {
            canvas.text([LEFT, y], "0 all over the side", &style);
            return;
        }
        let mut x = LEFT;
        let digits = decimals(nice_step(full.max(f64::MIN_POSITIVE), 20.0));
        for step in -STEPS..=STEPS {
            let place = Rectangle::new(x, y - 2.6, x + SWATCH, y + 2.6);
            canvas.fill(&place, &kind.colour(step));
            canvas.rectangle(&place, &Pen::new(0.08, "#808080"));
            let value = full * (f64::from(step) / f64::from(STEPS)).powi(2).copysign(f64::from(step));
            let text = if step == 0 { "0".to_owned() } else { format!("{value:+.digits$}") };
            let ink = if step.abs() > 5 { "#ffffff" } else { "#000000" };
            // The smallest steps have no figures of their own.
            if step == 0 || step.abs() % 2 == 1 && step.abs() > 2 {
                let style = TextStyle::new(TEXT, Anchor::Middle);
                let fitted = ((SWATCH - 0.8) / Canvas::text_place([0.0, 0.0], &text, &style).width())
                    .clamp(LEAST_LETTERS / TEXT, 1.0);
                canvas.text([x + 0.5 * SWATCH, y], &text, &TextStyle { size: fitted * TEXT, ..style }.coloured(ink));
            }
            x += SWATCH;
        }
        let words = match kind {
            SurfaceMapKind::Gaussian => "+ convex both ways; - saddle; black: 0",
            _ => "+ convex outward; - hollow; black: 0",
        };
        let share = 100.0 * SHARE;
        let words = format!("{}   {words}; full: what {share:.0} % of the side do not pass", kind.unit());
        canvas.text([x + 3.0, y], &words, &style);
        let words = format!(
            "steps of colour are squares: step k of {STEPS} is (k/{STEPS})² of the full, so that little curvature shows beside much; \
             zero is drawn where both sides reach {} {}",
            figures(self.floor * full, 1),
            kind.unit()
        );
        let row = if self.more > 0 || self.pair && self.marked[0] { 4.0 } else { 3.0 };
        canvas.text([LEFT, y + row * ROW], &words, &style);
    }
}
