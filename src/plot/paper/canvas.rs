//! A drawing in millimetres, written as SVG with float coordinates.
//!
//! Coordinates: x to the right, y down, from the upper left corner of the sheet [mm]; three decimals (1 micrometre on
//! paper). The same calls give the same bytes.
//!
//! Letters are drawn after the lines of their group, and all white edges before all letters, as elements of their own:
//! no edge can cover a letter, and no renderer has to know `paint-order`. Subscripts have their own x.

mod rectangle;

use super::canvas::rectangle::{area_inside, inside};
pub(in crate::plot) use rectangle::Rectangle;

use super::font;
use super::font::LETTERS;
use super::straight::straightened;
use std::fmt::Write;

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::plot) struct Pen {
    /// Width [mm].
    pub(in crate::plot) width: f64,
    /// Colour, `#rrggbb`.
    pub(in crate::plot) colour: &'static str,
    /// Lengths of dashes and gaps [mm]; empty: a full line.
    pub(in crate::plot) dash: &'static [f64],
}

impl Pen {
    pub(in crate::plot) const fn new(width: f64, colour: &'static str) -> Self {
        Self { width, colour, dash: &[] }
    }

    pub(in crate::plot) const fn dashed(self, dash: &'static [f64]) -> Self {
        Self { dash, ..self }
    }
}

/// Which point of a text stands at its position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::plot) enum Anchor {
    Start,
    Middle,
    End,
}

/// How a text is set; its position is on the middle of the height of its capitals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::plot) struct TextStyle {
    /// Size [mm]; capitals are 0.729 of it.
    pub(in crate::plot) size: f64,
    /// Which point stands at the position.
    pub(in crate::plot) anchor: Anchor,
    /// Colour, `#rrggbb`.
    pub(in crate::plot) colour: &'static str,
    /// Turned a quarter to read upwards.
    pub(in crate::plot) upward: bool,
    /// With a white edge, for text on lines.
    pub(in crate::plot) halo: bool,
}

impl TextStyle {
    pub(in crate::plot) const fn new(size: f64, anchor: Anchor) -> Self {
        Self { size, anchor, colour: "#000000", upward: false, halo: false }
    }

    pub(in crate::plot) const fn coloured(self, colour: &'static str) -> Self {
        Self { colour, ..self }
    }

    pub(in crate::plot) const fn upward(self) -> Self {
        Self { upward: true, ..self }
    }

    pub(in crate::plot) const fn halo(self) -> Self {
        Self { halo: true, ..self }
    }
}

/// A text with its place, for the placing of further text and for tests.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::plot) struct PlacedText {
    pub(in crate::plot) content: String,
    pub(in crate::plot) place: Rectangle,
}

/// The drawing under construction.
pub(in crate::plot) struct Canvas {
    width: f64,
    height: f64,
    body: String,
    /// White edges of the texts of the group in hand.
    halos: String,
    /// Texts of the group in hand.
    letters: String,
    /// Lines and areas are cut off outside of it.
    clip: Option<Rectangle>,
    texts: Vec<PlacedText>,
}

/// Width of the white edge around letters, half of it outside of them, in sizes of the text.
const EDGED: f64 = 0.42;
/// What stays free at the edges of a sheet \[mm\].
const EDGE: f64 = 3.0;

/// Size of a subscript \[mm\] in a text of `size`: nearly three quarters of it, but no less than letters are anywhere.
fn subscript(size: f64) -> f64 {
    (0.72 * size).max(size.min(LETTERS))
}

/// How far an area reaches over its edge, so that no seam shows between it and its neighbours \[mm\].
pub(in crate::plot) const HAIR: f64 = 0.06;

/// How much lower a subscript stands, as a part of the size of its text.
const SUBSCRIPT_DROP: f64 = 0.22;

/// `text` in pieces of full size and subscripts: `_` lowers the letters and digits that follow it.
fn pieces(text: &str) -> Vec<(bool, &str)> {
    let mut result = Vec::new();
    let mut parts = text.split('_');
    if let Some(first) = parts.next() {
        result.push((false, first));
    }
    for part in parts {
        let end = part.find(|c: char| !c.is_alphanumeric()).unwrap_or(part.len());
        result.push((true, &part[..end]));
        result.push((false, &part[end..]));
    }
    result.retain(|(_, piece)| !piece.is_empty());
    result
}

/// Text as markup. Spaces in a run and at the ends become spaces that do not break: browsers make one of others,
/// whatever `xml:space` says.
fn escape(text: &str) -> String {
    let mut result = String::with_capacity(text.len());
    let mut characters = text.chars().peekable();
    let mut last = None;
    while let Some(c) = characters.next() {
        match c {
            '&' => result.push_str("&amp;"),
            '<' => result.push_str("&lt;"),
            '>' => result.push_str("&gt;"),
            ' ' if last.is_none_or(|c| c == ' ') || characters.peek().is_none_or(|c| *c == ' ') => {
                result.push('\u{a0}')
            }
            _ => result.push(c),
        }
        last = Some(c);
    }
    result
}

/// `value` with at most three decimals, without trailing zeros.
fn number(value: f64) -> String {
    let mut text = format!("{value:.3}");
    text.truncate(text.trim_end_matches('0').trim_end_matches('.').len());
    if text == "-0" { "0".to_owned() } else { text }
}

/// Appends a text element painted with the attributes `paint`.
fn write_element(out: &mut String, at: [f64; 2], pieces: &[(bool, &str)], style: &TextStyle, paint: &str) {
    let drop = 0.5 * font::CAP_HEIGHT * style.size;
    let (x, y) = if style.upward { (at[0] + drop, at[1]) } else { (at[0], at[1] + drop) };
    let single = pieces.len() < 2;
    let anchor = match style.anchor {
        Anchor::Middle if single => "middle",
        Anchor::End if single => "end",
        _ => "start",
    };
    let _ = write!(
        out,
        "<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{anchor}\" {paint}",
        number(x),
        number(y),
        number(style.size)
    );
    if style.upward {
        let _ = write!(out, " transform=\"rotate(-90 {} {})\"", number(x), number(y));
    }
    out.push('>');
    if single {
        pieces.iter().for_each(|(_, piece)| out.push_str(&escape(piece)));
    } else {
        let sizes = pieces.iter().map(|(low, _)| if *low { subscript(style.size) } else { style.size });
        let widths: Vec<f64> =
            pieces.iter().zip(sizes.clone()).map(|((_, piece), size)| font::width(piece) * size).collect();
        let length: f64 = widths.iter().sum();
        let mut place = match style.anchor {
            Anchor::Start => x,
            Anchor::Middle => x - 0.5 * length,
            Anchor::End => x - length,
        };
        for (((low, piece), size), width) in pieces.iter().zip(sizes).zip(widths) {
            let _ = write!(
                out,
                "<tspan x=\"{}\" y=\"{}\" font-size=\"{}\">{}</tspan>",
                number(place),
                number(y + if *low { SUBSCRIPT_DROP * style.size } else { 0.0 }),
                number(size),
                escape(piece)
            );
            place += width;
        }
    }
    out.push_str("</text>\n");
}

impl Canvas {
    /// An empty white sheet \[mm\].
    pub(in crate::plot) fn new(width: f64, height: f64) -> Self {
        Self {
            width,
            height,
            body: String::new(),
            halos: String::new(),
            letters: String::new(),
            clip: None,
            texts: Vec::new(),
        }
    }

    /// The sheet without what stays free at its edges.
    pub(in crate::plot) fn frame(&self) -> Rectangle {
        self.sheet().grown(-EDGE)
    }

    /// The whole drawing.
    pub(in crate::plot) fn sheet(&self) -> Rectangle {
        Rectangle::new(0.0, 0.0, self.width, self.height)
    }

    pub(in crate::plot) fn texts(&self) -> &[PlacedText] {
        &self.texts
    }

    fn stroke(&mut self, pen: &Pen) {
        let _ = write!(self.body, " fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"", pen.colour, number(pen.width));
        if !pen.dash.is_empty() {
            let dash: Vec<_> = pen.dash.iter().map(|&length| number(length)).collect();
            let _ = write!(self.body, " stroke-dasharray=\"{}\"", dash.join(" "));
        }
    }

    fn points(&mut self, points: &[[f64; 2]]) {
        self.body.push_str(" points=\"");
        for (k, [x, y]) in points.iter().enumerate() {
            let _ = write!(self.body, "{}{},{}", if k == 0 { "" } else { " " }, number(*x), number(*y));
        }
        self.body.push('"');
    }

    pub(in crate::plot) fn line(&mut self, from: [f64; 2], to: [f64; 2], pen: &Pen) {
        self.polyline(&[from, to], pen);
    }

    /// A ring of 24 straight pieces.
    pub(in crate::plot) fn ring(&mut self, [x, y]: [f64; 2], radius: f64, pen: &Pen) {
        let circle: Vec<[f64; 2]> = (0..=24)
            .map(|k| (std::f64::consts::TAU * f64::from(k) / 24.0).sin_cos())
            .map(|(s, c)| [x + radius * c, y + radius * s])
            .collect();
        self.polyline(&circle, pen);
    }

    pub(in crate::plot) fn polyline(&mut self, points: &[[f64; 2]], pen: &Pen) {
        match self.clip {
            Some(window) => inside(points, &window).iter().for_each(|piece| self.stroked(piece, pen)),
            None => self.stroked(points, pen),
        }
    }

    fn stroked(&mut self, points: &[[f64; 2]], pen: &Pen) {
        if points.len() > 1 {
            self.body.push_str("<polyline");
            self.points(points);
            self.stroke(pen);
            self.body.push_str("/>\n");
        }
    }

    /// A filled area without an outline.
    pub(in crate::plot) fn area(&mut self, points: &[[f64; 2]], colour: &str) {
        let part = self.clip.map(|window| area_inside(points, &window));
        let points = part.as_deref().unwrap_or(points);
        if points.len() < 3 {
            return;
        }
        self.body.push_str("<polygon");
        self.points(points);
        let _ = writeln!(self.body, " fill=\"{colour}\"/>");
    }

    /// Filled areas, with a hair of their own colour around them if `edged`, so that no seam shows between neighbours:
    /// twice [`HAIR`] wide. Corners are rounded to a hundredth of a millimetre, and those that lie beside a side left
    /// out: both are less than the hair.
    pub(in crate::plot) fn areas(&mut self, areas: &[Vec<[f64; 2]>], colour: &str, edged: bool) {
        if areas.is_empty() {
            return;
        }
        let _ = write!(self.body, "<path fill=\"{colour}\"");
        if edged {
            let _ = write!(self.body, " stroke=\"{colour}\" stroke-width=\"{}\"", number(2.0 * HAIR));
        }
        self.body.push_str(" d=\"");
        let hundredths = |place: &[f64; 2]| place.map(|c| (100.0 * c).round());
        for area in areas {
            let mut last: Option<[f64; 2]> = None;
            for place in straightened(area).iter().map(hundredths) {
                let from = last.unwrap_or_default();
                let [x, y] = [0, 1].map(|d| number((place[d] - from[d]) / 100.0));
                let _ = write!(self.body, "{}{x} {y}", if last.is_none() { 'M' } else { 'l' });
                last = Some(place);
            }
            self.body.push('z');
        }
        self.body.push_str("\"/>\n");
    }

    pub(in crate::plot) fn rectangle(&mut self, r: &Rectangle, pen: &Pen) {
        let _ = write!(self.body, "<rect {}", r.attributes());
        self.stroke(pen);
        self.body.push_str("/>\n");
    }

    pub(in crate::plot) fn fill(&mut self, r: &Rectangle, colour: &str) {
        self.area(&[[r.left, r.top], [r.right, r.top], [r.right, r.bottom], [r.left, r.bottom]], colour);
    }

    /// Lines and areas that follow are drawn inside `window` only, until [`Canvas::end_group`].
    pub(in crate::plot) fn begin_clip(&mut self, window: &Rectangle) {
        self.flush_text();
        self.clip = Some(*window);
        self.body.push_str("<g>\n");
    }

    /// A named group, for programs that read the SVG, until [`Canvas::end_group`].
    pub(in crate::plot) fn begin_group(&mut self, id: &str) {
        self.flush_text();
        let _ = writeln!(self.body, "<g id=\"{id}\">");
    }

    /// Ends the group; its text comes last in it.
    pub(in crate::plot) fn end_group(&mut self) {
        self.flush_text();
        self.clip = None;
        self.body.push_str("</g>\n");
    }

    /// Elements of another SVG writer, its origin at `at`, its unit `unit` millimetres.
    pub(in crate::plot) fn embed(&mut self, elements: &str, at: [f64; 2], unit: f64) {
        let (x, y) = (number(at[0]), number(at[1]));
        let _ = writeln!(self.body, "<g transform=\"translate({x} {y}) scale({unit})\">\n{elements}</g>");
    }

    /// The rectangle that `text` takes at `at`.
    pub(in crate::plot) fn text_place(at: [f64; 2], text: &str, style: &TextStyle) -> Rectangle {
        let pieces = pieces(text);
        let size = |low: bool| if low { subscript(style.size) } else { style.size };
        let length: f64 = pieces.iter().map(|(low, piece)| font::width(piece) * size(*low)).sum();
        let subscript = pieces.iter().any(|(low, _)| *low);
        let above = 0.5 * font::CAP_HEIGHT * style.size;
        let below = above + style.size * if subscript { font::DESCENT } else { 0.5 * font::DESCENT };
        let before = match style.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => 0.5 * length,
            Anchor::End => length,
        };
        if style.upward {
            Rectangle::new(at[0] - above, at[1] - length + before, at[0] + below, at[1] + before)
        } else {
            Rectangle::new(at[0] - before, at[1] - above, at[0] - before + length, at[1] + below)
        }
    }

    /// Writes `text`; `_` lowers the letters and digits that follow it.
    pub(in crate::plot) fn text(&mut self, at: [f64; 2], text: &str, style: &TextStyle) {
        let place = Self::text_place(at, text, style);
        self.write_text(at, text, &place, style);
        self.texts.push(PlacedText { content: text.to_owned(), place });
    }

    /// Notes a text that another writer has drawn.
    pub(in crate::plot) fn note_text(&mut self, content: &str, place: Rectangle) {
        self.texts.push(PlacedText { content: content.to_owned(), place });
    }

    fn write_text(&mut self, at: [f64; 2], text: &str, place: &Rectangle, style: &TextStyle) {
        let pieces = &pieces(text);
        if style.halo {
            let edge = format!(
                "fill=\"none\" stroke=\"#ffffff\" stroke-width=\"{}\" stroke-linejoin=\"round\" aria-hidden=\"true\"",
                number(EDGED * style.size)
            );
            write_element(&mut self.halos, at, pieces, style, &edge);
            // A line through a gap between words, or beside a point or a 1, reads as a hyphen or a colon.
            let _ = writeln!(self.halos, "<rect {} fill=\"#ffffff\"/>", place.attributes());
        }
        write_element(&mut self.letters, at, pieces, style, &format!("fill=\"{}\"", style.colour));
    }

    /// Sets the text that waits: all white edges, then all letters.
    fn flush_text(&mut self) {
        self.body.push_str(&std::mem::take(&mut self.halos));
        self.body.push_str(&std::mem::take(&mut self.letters));
    }

    /// The finished document.
    pub(in crate::plot) fn finish(self, title: &str) -> String {
        let ground =
            format!("<rect width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n", number(self.width), number(self.height));
        self.finish_on(title, &ground)
    }

    /// The finished document without a ground, to be laid over another.
    pub(in crate::plot) fn finish_clear(self, title: &str) -> String {
        self.finish_on(title, "")
    }

    fn finish_on(mut self, title: &str, ground: &str) -> String {
        self.flush_text();
        let (w, h) = (number(self.width), number(self.height));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}mm\" height=\"{h}mm\" viewBox=\"0 0 {w} {h}\" \
             font-family=\"'{}', sans-serif\">\n<title>{}</title>\n{ground}{}</svg>\n",
            font::FAMILY,
            escape(title),
            self.body
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_decimals_at_most() {
        for (value, text) in
            [(1.0, "1"), (0.1, "0.1"), (-0.0001, "0"), (12.3456, "12.346"), (-2.5, "-2.5"), (100.0, "100")]
        {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn subscripts_end_at_the_first_sign_that_is_no_letter() {
        assert_eq!(pieces("KM_T [m], C_WP"), [(false, "KM"), (true, "T"), (false, " [m], C"), (true, "WP")]);
    }

    #[test]
    fn a_text_takes_the_place_its_anchor_says() {
        let style = TextStyle::new(10.0, Anchor::Middle);
        let place = Canvas::text_place([100.0, 50.0], "00", &style);
        let half = 1303.0 / 2048.0 * 10.0;
        assert!((place.left - (100.0 - half)).abs() < 1e-9 && (place.right - (100.0 + half)).abs() < 1e-9);
        let upward = Canvas::text_place([100.0, 50.0], "00", &style.upward());
        assert!((upward.height() - place.width()).abs() < 1e-9);
    }

    #[test]
    fn white_edges_come_before_all_letters_and_after_the_lines() {
        let mut canvas = Canvas::new(50.0, 10.0);
        let style = TextStyle::new(2.0, Anchor::Middle).halo();
        canvas.text([10.0, 5.0], "I_T", &style);
        canvas.text([20.0, 5.0], "KB", &style);
        canvas.line([0.0, 5.0], [50.0, 5.0], &Pen::new(0.1, "#000000"));
        let document = canvas.finish("t");
        assert!(!document.contains("paint-order"));
        let lines: Vec<&str> =
            document.lines().filter(|l| l.starts_with("<text") || l.starts_with("<polyline")).collect();
        let kind = |line: &&str| {
            if line.starts_with("<polyline") {
                'l'
            } else if line.contains("fill=\"none\"") {
                'h'
            } else {
                't'
            }
        };
        assert_eq!(lines.iter().map(kind).collect::<String>(), "lhhtt");
        let letters = |line: &str| line[line.find('>').unwrap()..].to_owned();
        assert_eq!(letters(lines[1]), letters(lines[3]));
    }

    #[test]
    fn subscripts_stand_where_the_piece_before_them_ends() {
        let mut canvas = Canvas::new(50.0, 10.0);
        canvas.text([10.0, 5.0], "m_0m", &TextStyle::new(2.048, Anchor::Start));
        // "m" is 1995 units of 2048 wide; the subscript takes the letter with it.
        let document = canvas.finish("t");
        assert!(document.contains("<tspan x=\"10\" y"), "{document}");
        assert!(document.contains("<tspan x=\"11.995\" y"), "{document}");
    }

    #[test]
    fn markup_in_a_text_is_escaped() {
        let mut canvas = Canvas::new(10.0, 10.0);
        canvas.text([1.0, 1.0], "a<b & c", &TextStyle::new(2.0, Anchor::Start));
        assert!(canvas.finish("<t>").contains("a&lt;b &amp; c</text>"));
    }
}
