//! The embedded typeface, DejaVu Sans, and the widths of its characters.
//!
//! Widths are the advance widths of the font file (tables cmap format 4, hmtx), without kerning: at most a few hundredths
//! of the size more than what is drawn.

use std::sync::OnceLock;

/// Family name that drawings ask for.
pub(in crate::plot) const FAMILY: &str = "DejaVu Sans";

/// Least size of letters on a drawing as wide as A3: nine pixels where the drawing is 1200 pixels wide \[mm\].
pub(in crate::plot) const LETTERS: f64 = 3.15;

/// Least size of letters on any sheet \[mm\]: capitals of 1.8 mm, the least of ISO 3098.
pub(in crate::plot) const LEAST_LETTERS: f64 = 2.5;

/// The font file; licence in `font/LICENSE`.
pub(in crate::plot) const DEJAVU_SANS: &[u8] = include_bytes!("font/DejaVuSans.ttf");

/// Height of capitals, as a part of the size (OS/2 table of the font: 1493 / 2048).
pub(in crate::plot) const CAP_HEIGHT: f64 = 0.729;

/// Depth of descenders, as a part of the size.
pub(in crate::plot) const DESCENT: f64 = 0.236;

/// Height of what stands highest on a line, as a part of the size (hhea table of the font: 1901 / 2048).
pub(in crate::plot) const ASCENT: f64 = 0.928;

/// Units of the font in its size (head table).
pub(in crate::plot) const UNITS: f64 = 2048.0;

/// Left, lower, right and upper edge of all glyphs, as parts of the size (head table).
pub(in crate::plot) const BOUNDS: [f64; 4] = [-2090.0 / UNITS, -948.0 / UNITS, 3673.0 / UNITS, 2524.0 / UNITS];

/// Width taken for a character that the font does not have, as a part of the size.
const MISSING_WIDTH: f64 = 0.6;

fn metrics() -> &'static Metrics {
    static METRICS: OnceLock<Metrics> = OnceLock::new();
    METRICS.get_or_init(|| Metrics::new(DEJAVU_SANS).unwrap_or_default())
}

/// Width of `text` in units of the font size.
pub(in crate::plot) fn width(text: &str) -> f64 {
    text.chars().map(|c| metrics().advance(c)).sum()
}

/// Width of a glyph in units of the font size.
pub(in crate::plot) fn glyph_advance(glyph: u16) -> f64 {
    metrics().advance_of(glyph).unwrap_or(MISSING_WIDTH)
}

/// Start codes, end codes, deltas and range offsets of the character map, and the advance widths.
#[derive(Default)]
struct Metrics {
    ranges: Vec<CharacterRange>,
    glyphs: &'static [u8],
    advances: Vec<f64>,
}

struct CharacterRange {
    start: u16,
    end: u16,
    delta: u16,
    /// Offset into `glyphs` of the glyph of `start`; none when the delta alone maps.
    offset: Option<usize>,
}

fn u16_at(data: &[u8], at: usize) -> Option<u16> {
    Some(u16::from_be_bytes(data.get(at..at + 2)?.try_into().ok()?))
}

fn u32_at(data: &[u8], at: usize) -> Option<usize> {
    Some(u32::from_be_bytes(data.get(at..at + 4)?.try_into().ok()?) as usize)
}

fn table(data: &'static [u8], tag: &[u8; 4]) -> Option<&'static [u8]> {
    let count = usize::from(u16_at(data, 4)?);
    (0..count).map(|k| 12 + 16 * k).find_map(|record| {
        if data.get(record..record + 4)? != tag {
            return None;
        }
        let (start, length) = (u32_at(data, record + 8)?, u32_at(data, record + 12)?);
        data.get(start..start + length)
    })
}

impl Metrics {
    fn new(data: &'static [u8]) -> Option<Self> {
        let units = f64::from(u16_at(table(data, b"head")?, 18)?);
        let metric_count = usize::from(u16_at(table(data, b"hhea")?, 34)?);
        let hmtx = table(data, b"hmtx")?;
        let advances = (0..metric_count)
            .map(|k| u16_at(hmtx, 4 * k).map(|advance| f64::from(advance) / units))
            .collect::<Option<Vec<_>>>()?;
        let cmap = table(data, b"cmap")?;
        let subtable = (0..usize::from(u16_at(cmap, 2)?)).find_map(|k| {
            let start = u32_at(cmap, 8 + 8 * k)?;
            (u16_at(cmap, start)? == 4).then(|| cmap.get(start..)).flatten()
        })?;
        let segments = usize::from(u16_at(subtable, 6)?) / 2;
        let ranges = (0..segments)
            .map(|k| {
                let end = u16_at(subtable, 14 + 2 * k)?;
                let start = u16_at(subtable, 16 + 2 * (segments + k))?;
                let delta = u16_at(subtable, 16 + 2 * (2 * segments + k))?;
                let at = 16 + 2 * (3 * segments + k);
                let range = usize::from(u16_at(subtable, at)?);
                Some(CharacterRange { start, end, delta, offset: (range != 0).then_some(at + range) })
            })
            .collect::<Option<Vec<_>>>()?;
        Some(Self { ranges, glyphs: subtable, advances })
    }

    fn glyph(&self, character: char) -> Option<u16> {
        let code = u16::try_from(u32::from(character)).ok()?;
        let range = self.ranges.iter().find(|range| code <= range.end && range.start <= code)?;
        let glyph = match range.offset {
            None => code.wrapping_add(range.delta),
            Some(offset) => match u16_at(self.glyphs, offset + 2 * usize::from(code - range.start))? {
                0 => 0,
                glyph => glyph.wrapping_add(range.delta),
            },
        };
        (glyph != 0).then_some(glyph)
    }

    /// The last advance is that of all glyphs after it.
    fn advance_of(&self, glyph: u16) -> Option<f64> {
        self.advances.get(usize::from(glyph).min(self.advances.len().checked_sub(1)?)).copied()
    }

    fn advance(&self, character: char) -> f64 {
        self.glyph(character).and_then(|glyph| self.advance_of(glyph)).unwrap_or(MISSING_WIDTH)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_those_of_the_font_file() {
        // DejaVu Sans, 2048 units a size: space 651, digits 1303, m 1995, C 1430.
        for (text, units) in [(" ", 651.0), ("0", 1303.0), ("m", 1995.0), ("C", 1430.0), ("0m", 3298.0)] {
            assert!((width(text) - units / 2048.0).abs() < 1e-12, "{text}: {}", width(text) * 2048.0);
        }
    }

    #[test]
    fn the_measures_of_the_typeface_are_those_of_the_font_file() {
        let [head, hhea] = [b"head", b"hhea"].map(|tag| table(DEJAVU_SANS, tag).unwrap());
        let part = |table: &'static [u8], at: usize| f64::from(u16_at(table, at).unwrap().cast_signed()) / UNITS;
        assert!((part(head, 18) - 1.0).abs() < 1e-12);
        for (side, bound) in BOUNDS.iter().enumerate() {
            assert!((part(head, 36 + 2 * side) - bound).abs() < 1e-12, "{side}");
        }
        assert!((part(hhea, 4) - ASCENT).abs() < 5e-4 && (part(hhea, 6) + DESCENT).abs() < 5e-4);
        let glyph = metrics().glyph('m').unwrap();
        assert!((glyph_advance(glyph) - width("m")).abs() < 1e-12);
    }

    #[test]
    fn the_characters_of_the_drawings_are_in_the_font() {
        let metrics = Metrics::new(DEJAVU_SANS).unwrap();
        for character in "∇Δρ°²³⁴½¼¾·–—×Ø±↑".chars() {
            assert!(metrics.glyph(character).is_some(), "{character}");
        }
    }

    #[test]
    fn a_character_that_is_missing_has_a_width() {
        assert!((width("\u{1F6A2}") - MISSING_WIDTH).abs() < 1e-12);
    }
}
