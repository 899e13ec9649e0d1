//! A drawing onto a page: groups, paths and text of usvg as operators of a content stream.
//!
//! Coordinates stay those of the drawing; every group with a transform nests in that of the page. What our drawings
//! never hold is an error and not left out.

use super::error;
use super::letters::Letters;
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font;
use pdf_writer::types::{LineCapStyle, LineJoinStyle, TextRenderingMode};
use pdf_writer::{Content, Finish, Name, Str, TextStr};
use resvg::tiny_skia::{PathSegment, Transform};
use resvg::usvg::layout::PositionedGlyph;
use resvg::usvg::{
    BlendMode, Fill, FillRule, Group, LineCap, LineJoin, Node, Opacity, Paint, PaintOrder, Path, Stroke, Text, Tree,
};

/// Points of a PDF in a pixel of SVG.
const PIXEL: f32 = 72.0 / 96.0;
/// Coordinates are rounded to a power of ten of their unit, no larger than this on paper \[points\].
const GRAIN: f64 = 0.005;
/// The part of the size by which a letter may stand off its place.
const SLACK: f64 = 0.5e-3;

/// Name of the font in the resources of every page.
pub(super) const FONT: Name<'static> = Name(b"F");

type Colour = [u8; 3];

/// What a viewer keeps from operator to operator.
#[derive(Clone)]
struct State {
    fill: Colour,
    stroke: Colour,
    width: f32,
    cap: LineCap,
    join: LineJoin,
    miter_limit: f32,
    /// Lengths of dashes and gaps, and where they begin.
    dash: (Vec<f32>, f32),
    /// Size of the letters; none before the first.
    size: Option<f32>,
    mode: TextRenderingMode,
    /// Points on paper in a unit.
    scale: f64,
    /// Steps of coordinates in a unit.
    steps: f64,
}

impl State {
    /// That of a new page.
    fn new() -> Self {
        Self {
            fill: [0; 3],
            stroke: [0; 3],
            width: 1.0,
            cap: LineCap::Butt,
            join: LineJoin::Miter,
            miter_limit: 10.0,
            dash: (Vec::new(), 0.0),
            size: None,
            mode: TextRenderingMode::Fill,
            scale: 1.0,
            steps: steps(1.0),
        }
    }

    /// Coordinates that are `by` times as large on paper follow.
    fn scale(&mut self, by: f64) {
        self.scale *= by;
        self.steps = steps(self.scale);
    }

    /// `value` without digits that nobody can see.
    fn rounded(&self, value: f32) -> f32 {
        ((f64::from(value) * self.steps).round() / self.steps) as f32
    }
}

/// Steps in a unit of so many points, a power of ten.
fn steps(scale: f64) -> f64 {
    10f64.powi(-(GRAIN / scale).log10().floor() as i32)
}

/// Whether `new` takes the place of another value in `old`.
fn replaces<T: PartialEq>(old: &mut T, new: T) -> bool {
    let differs = *old != new;
    *old = new;
    differs
}

/// The colour of a paint, which is one and covers.
fn colour(paint: &Paint, opacity: Opacity) -> Result<Colour, PlotError> {
    if opacity != Opacity::ONE {
        return Err(error("a drawing has a colour that is seen through"));
    }
    match paint {
        Paint::Color(colour) => Ok([colour.red, colour.green, colour.blue]),
        _ => Err(error("a drawing has a gradient or a pattern")),
    }
}

/// Parts of full light, four decimals: enough for 256 steps.
fn light(colour: Colour) -> [f32; 3] {
    colour.map(|part| (f32::from(part) / 255.0 * 1e4).round() / 1e4)
}

/// Refuses what needs a layer of its own.
fn check_plain(group: &Group) -> Result<(), PlotError> {
    let reasons = [
        (group.opacity() != Opacity::ONE, "a group that is seen through"),
        (group.clip_path().is_some(), "a clip path"),
        (group.mask().is_some(), "a mask"),
        (!group.filters().is_empty(), "a filter"),
        (group.blend_mode() != BlendMode::Normal, "a blend mode"),
    ];
    match reasons.iter().find(|(found, _)| *found) {
        Some((_, what)) => Err(error(format!("a drawing has {what}"))),
        None => Ok(()),
    }
}

/// Letters in a row that wait for their operator: strings of codes, with moves between them.
#[derive(Default)]
struct LetterRow {
    /// Codes and the move after them \[thousandths of the size, to the left\].
    parts: Vec<(Vec<u8>, f32)>,
    codes: Vec<u8>,
}

impl LetterRow {
    fn shift(&mut self, thousandths: f32) {
        self.parts.push((std::mem::take(&mut self.codes), thousandths));
    }

    fn write(&mut self, content: &mut Content) {
        let codes = std::mem::take(&mut self.codes);
        if self.parts.is_empty() {
            if !codes.is_empty() {
                content.show(Str(&codes));
            }
            return;
        }
        let mut row = content.show_positioned();
        let mut items = row.items();
        for (before, thousandths) in self.parts.drain(..) {
            if !before.is_empty() {
                items.show(Str(&before));
            }
            items.adjust(thousandths);
        }
        if !codes.is_empty() {
            items.show(Str(&codes));
        }
    }
}

/// Where the next letter of a row would stand, and the directions along it and up.
#[derive(Clone, Copy)]
struct Pen {
    at: [f64; 2],
    axes: [f64; 4],
}

impl Pen {
    fn is_parallel_to(&self, other: &Self) -> bool {
        self.axes.iter().zip(other.axes).all(|(a, b)| (a - b).abs() < 1e-5)
    }

    /// How far it is to a place, along the row and up.
    fn steps_to(&self, place: [f64; 2]) -> [f64; 2] {
        let [a, b, c, d] = self.axes;
        let [x, y] = [0, 1].map(|k| place[k] - self.at[k]);
        [x * d - y * c, y * a - x * b].map(|step| step / (a * d - b * c))
    }

    fn advance(&mut self, along: f64) {
        self.at = [0, 1].map(|k| self.at[k] + along * self.axes[k]);
    }
}

/// The content of a page in the making.
pub(super) struct PageContent<'a> {
    content: Content,
    /// Height of the page \[points\].
    height: f64,
    letters: &'a mut Letters,
    state: State,
}

impl<'a> PageContent<'a> {
    /// An empty page, its height in points.
    pub(super) fn new(height: f64, letters: &'a mut Letters) -> Self {
        Self { content: Content::with_settings(super::packed::COMPACT), height, letters, state: State::new() }
    }

    pub(super) fn finish(self) -> Vec<u8> {
        self.content.finish().into_vec()
    }

    /// Draws with the upper left corner at `at` \[points\]; nothing reaches beyond the size of the drawing.
    pub(super) fn place(&mut self, tree: &Tree, at: [f64; 2]) -> Result<(), PlotError> {
        let corner = Transform::from_row(PIXEL, 0.0, 0.0, -PIXEL, at[0] as f32, (self.height - at[1]) as f32);
        self.nested(corner, |page| {
            page.content.rect(0.0, 0.0, tree.size().width(), tree.size().height()).clip_nonzero().end_path();
            page.group(tree.root())
        })
    }

    /// Draws in coordinates of their own.
    fn nested(
        &mut self,
        inner: Transform,
        draw: impl FnOnce(&mut Self) -> Result<(), PlotError>,
    ) -> Result<(), PlotError> {
        let area = f64::from(inner.sx) * f64::from(inner.sy) - f64::from(inner.kx) * f64::from(inner.ky);
        if !area.is_normal() {
            return Err(error("a drawing has a group without extent"));
        }
        let outer = self.state.clone();
        let Transform { sx, kx, ky, sy, tx, ty } = inner;
        let [a, b, c, d] = [sx, ky, kx, sy].map(without_dust);
        self.content.save_state().transform([a, b, c, d, outer.rounded(tx), outer.rounded(ty)]);
        self.state.scale(area.abs().sqrt());
        draw(self)?;
        self.content.restore_state();
        self.state = outer;
        Ok(())
    }

    fn group(&mut self, group: &Group) -> Result<(), PlotError> {
        check_plain(group)?;
        if group.transform().is_identity() {
            return self.children(group);
        }
        self.nested(group.transform(), |page| page.children(group))
    }

    fn children(&mut self, group: &Group) -> Result<(), PlotError> {
        group.children().iter().try_for_each(|node| match node {
            Node::Group(group) => self.group(group),
            Node::Path(path) => self.path(path),
            Node::Text(text) => self.text(text),
            Node::Image(_) => Err(error("a drawing has a picture")),
        })
    }

    /// Sets the colours and the line of what follows.
    fn set_paint(&mut self, fill: Option<&Fill>, stroke: Option<&Stroke>, order: PaintOrder) -> Result<(), PlotError> {
        if fill.is_some() && stroke.is_some() && order == PaintOrder::StrokeAndFill {
            return Err(error("a drawing has an edge under its area"));
        }
        fill.map_or(Ok(()), |fill| self.set_fill(fill))?;
        stroke.map_or(Ok(()), |stroke| self.set_stroke(stroke))
    }

    fn set_fill(&mut self, fill: &Fill) -> Result<(), PlotError> {
        let new = colour(fill.paint(), fill.opacity())?;
        if replaces(&mut self.state.fill, new) {
            let [red, green, blue] = light(new);
            if new == [new[0]; 3] {
                self.content.set_fill_gray(red);
            } else {
                self.content.set_fill_rgb(red, green, blue);
            }
        }
        Ok(())
    }

    fn set_stroke(&mut self, stroke: &Stroke) -> Result<(), PlotError> {
        let new = colour(stroke.paint(), stroke.opacity())?;
        if replaces(&mut self.state.stroke, new) {
            let [red, green, blue] = light(new);
            if new == [new[0]; 3] {
                self.content.set_stroke_gray(red);
            } else {
                self.content.set_stroke_rgb(red, green, blue);
            }
        }
        if replaces(&mut self.state.width, stroke.width().get()) {
            self.content.set_line_width(stroke.width().get());
        }
        if replaces(&mut self.state.cap, stroke.linecap()) {
            self.content.set_line_cap(match stroke.linecap() {
                LineCap::Butt => LineCapStyle::ButtCap,
                LineCap::Round => LineCapStyle::RoundCap,
                LineCap::Square => LineCapStyle::ProjectingSquareCap,
            });
        }
        if replaces(&mut self.state.join, stroke.linejoin()) {
            self.content.set_line_join(match stroke.linejoin() {
                LineJoin::Miter => LineJoinStyle::MiterJoin,
                LineJoin::MiterClip => return Err(error("a drawing has corners that are cut off")),
                LineJoin::Round => LineJoinStyle::RoundJoin,
                LineJoin::Bevel => LineJoinStyle::BevelJoin,
            });
        }
        if replaces(&mut self.state.miter_limit, stroke.miterlimit().get()) {
            self.content.set_miter_limit(stroke.miterlimit().get());
        }
        let dash = stroke.dasharray().map_or_else(Vec::new, <[f32]>::to_vec);
        // Where they begin has no sign in PDF.
        let length: f32 = dash.iter().sum();
        let begin = if length > 0.0 { stroke.dashoffset().rem_euclid(length) } else { 0.0 };
        if replaces(&mut self.state.dash, (dash.clone(), begin)) {
            self.content.set_dash_pattern(dash, begin);
        }
        Ok(())
    }

    fn path(&mut self, path: &Path) -> Result<(), PlotError> {
        let (fill, stroke) = (path.fill(), path.stroke());
        if !path.is_visible() || fill.is_none() && stroke.is_none() {
            return Ok(());
        }
        self.set_paint(fill, stroke, path.paint_order())?;
        self.outline(path);
        match (fill.map(Fill::rule), stroke) {
            (Some(FillRule::NonZero), None) => self.content.fill_nonzero(),
            (Some(FillRule::EvenOdd), None) => self.content.fill_even_odd(),
            (Some(FillRule::NonZero), Some(_)) => self.content.fill_nonzero_and_stroke(),
            (Some(FillRule::EvenOdd), Some(_)) => self.content.fill_even_odd_and_stroke(),
            (None, _) => self.content.stroke(),
        };
        Ok(())
    }

    fn outline(&mut self, path: &Path) {
        let state = &self.state;
        let content = &mut self.content;
        let mut last = [0.0; 2];
        for segment in path.data().segments() {
            match segment {
                PathSegment::MoveTo(to) => {
                    content.move_to(state.rounded(to.x), state.rounded(to.y));
                    last = [to.x, to.y];
                }
                PathSegment::LineTo(to) => {
                    content.line_to(state.rounded(to.x), state.rounded(to.y));
                    last = [to.x, to.y];
                }
                PathSegment::QuadTo(corner, to) => {
                    // The same curve of the third degree.
                    let toward = |end: f32, corner: f32| state.rounded(end + 2.0 / 3.0 * (corner - end));
                    let [x1, y1] = [toward(last[0], corner.x), toward(last[1], corner.y)];
                    let [x2, y2] = [toward(to.x, corner.x), toward(to.y, corner.y)];
                    content.cubic_to(x1, y1, x2, y2, state.rounded(to.x), state.rounded(to.y));
                    last = [to.x, to.y];
                }
                PathSegment::CubicTo(first, second, to) => {
                    let [x1, y1, x2, y2, x, y] =
                        [first.x, first.y, second.x, second.y, to.x, to.y].map(|value| state.rounded(value));
                    content.cubic_to(x1, y1, x2, y2, x, y);
                    last = [to.x, to.y];
                }
                PathSegment::Close => {
                    content.close_path();
                }
            }
        }
    }

    /// Letters at the places that usvg found, which are those of the pictures.
    fn text(&mut self, text: &Text) -> Result<(), PlotError> {
        for span in text.layouted().iter().filter(|span| span.visible) {
            for line in [&span.overline, &span.underline].into_iter().flatten() {
                self.path(line)?;
            }
            let (fill, stroke) = (span.fill.as_ref(), span.stroke.as_ref());
            self.set_paint(fill, stroke, span.paint_order)?;
            self.content.begin_text();
            let mode = match (fill, stroke) {
                (Some(_), None) => TextRenderingMode::Fill,
                (None, Some(_)) => TextRenderingMode::Stroke,
                (Some(_), Some(_)) => TextRenderingMode::FillStroke,
                (None, None) => TextRenderingMode::Invisible,
            };
            if replaces(&mut self.state.mode, mode) {
                self.content.set_text_rendering_mode(mode);
            }
            let size = span.font_size.get();
            if replaces(&mut self.state.size, Some(size)) {
                self.content.set_font(FONT, size);
            }
            self.glyphs(&span.positioned_glyphs, f64::from(size));
            self.content.end_text();
            if let Some(line) = &span.line_through {
                self.path(line)?;
            }
        }
        Ok(())
    }

    /// Glyphs of one size, in as few rows as their places allow.
    fn glyphs(&mut self, glyphs: &[PositionedGlyph], size: f64) {
        let mut row = LetterRow::default();
        let mut pen: Option<Pen> = None;
        for glyph in glyphs {
            // usvg counts in units of the font, y down.
            let t = glyph.transform();
            let axes = [t.sx, t.ky, -t.kx, -t.sy].map(|value| f64::from(value) * font::UNITS / size);
            let place = [f64::from(t.tx), f64::from(t.ty)];
            let mut at = self.go_to(pen, &mut row, Pen { at: place, axes }, size);
            let (code, says) = self.letters.code(glyph.id.0, &glyph.text);
            if says {
                row.codes.extend(code.to_be_bytes());
            } else {
                row.write(&mut self.content);
                let mut span = self.content.begin_marked_content_with_properties(Name(b"Span"));
                span.properties().actual_text(TextStr(&glyph.text));
                span.finish();
                self.content.show(Str(&code.to_be_bytes())).end_marked_content();
            }
            at.advance(font::glyph_advance(glyph.id.0) * size);
            pen = Some(at);
        }
        row.write(&mut self.content);
    }

    /// Brings the pen to the place of a letter: along its row, or to the start of another.
    fn go_to(&mut self, pen: Option<Pen>, row: &mut LetterRow, place: Pen, size: f64) -> Pen {
        if let Some(mut pen) = pen.filter(|pen| pen.is_parallel_to(&place)) {
            let [along, up] = pen.steps_to(place.at);
            if up.abs() < SLACK * size {
                let thousandths = (-1e3 * along / size).round();
                if thousandths != 0.0 {
                    row.shift(thousandths as f32);
                    pen.advance(-1e-3 * thousandths * size);
                }
                return pen;
            }
        }
        row.write(&mut self.content);
        let [a, b, c, d] = place.axes.map(|value| without_dust(((value * 1e6).round() / 1e6) as f32));
        let [x, y] = place.at.map(|value| self.state.rounded(value as f32));
        self.content.set_text_matrix([a, b, c, d, x, y]);
        Pen { at: [f64::from(x), f64::from(y)], ..place }
    }
}

/// Nothing for what is left of a turn by a quarter.
fn without_dust(value: f32) -> f32 {
    if value.abs() < 1e-5 { 0.0 } else { value }
}
