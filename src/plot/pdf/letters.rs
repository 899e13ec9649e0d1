//! The typeface of a document: the glyphs that its text takes, embedded once, and what text they stand for. Drawings
//! know no other font.

use super::error;
use super::packed::packed;
use crate::plot::paper::error::PlotError;
use crate::plot::paper::font;
use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Ref, Str};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use subsetter::{GlyphRemapper, subset};

/// Width of a vertical stem \[thousandths of the size\], of the letter l.
const STEM: f32 = 90.0;
/// Codes are those of glyphs.
const IDENTITY: SystemInfo<'static> = SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };

/// The glyphs that were written so far.
pub(super) struct Letters {
    glyphs: GlyphRemapper,
    /// What each code stands for.
    texts: BTreeMap<u16, String>,
}

impl Letters {
    pub(super) fn new() -> Self {
        Self { glyphs: GlyphRemapper::new(), texts: BTreeMap::new() }
    }

    /// Whether no letter was written.
    pub(super) fn is_empty(&self) -> bool {
        self.glyphs.num_gids() < 2 && self.texts.is_empty()
    }

    /// The code of a glyph, and whether it stands for `text` in this document.
    pub(super) fn code(&mut self, glyph: u16, text: &str) -> (u16, bool) {
        let code = self.glyphs.remap(glyph);
        if !text.is_empty() {
            self.texts.entry(code).or_insert_with(|| text.to_owned());
        }
        (code, self.texts.get(&code).is_some_and(|known| known == text))
    }

    /// Writes the font as `id`, its parts as what `next` gives.
    pub(super) fn write(&self, pdf: &mut Pdf, id: Ref, next: &mut Ref) -> Result<(), PlotError> {
        let file = subset(font::DEJAVU_SANS, 0, &self.glyphs).map_err(error)?;
        // A subset differs from others in six letters: those of its hash.
        let digest = Sha256::digest(&file);
        let tag: String = digest.iter().take(6).map(|byte| char::from(b'A' + byte % 26)).collect();
        let name = format!("{tag}+DejaVuSans");
        let name = Name(name.as_bytes());
        let [descendant, descriptor, cmap, data] = [(); 4].map(|()| next.bump());

        pdf.type0_font(id)
            .base_font(name)
            .encoding_predefined(Name(b"Identity-H"))
            .descendant_font(descendant)
            .to_unicode(cmap);

        let mut cid = pdf.cid_font(descendant);
        cid.subtype(CidFontType::Type2).base_font(name).system_info(IDENTITY).font_descriptor(descriptor);
        cid.default_width(0.0).cid_to_gid_map_predefined(Name(b"Identity"));
        let widths = self.glyphs.remapped_gids().map(|glyph| (1e3 * font::glyph_advance(glyph)) as f32);
        cid.widths().consecutive(0, widths);
        cid.finish();

        let [left, bottom, right, top] = font::BOUNDS.map(|part| (1e3 * part) as f32);
        pdf.font_descriptor(descriptor)
            .name(name)
            .flags(FontFlags::SYMBOLIC)
            .bbox(Rect::new(left, bottom, right, top))
            .italic_angle(0.0)
            .ascent((1e3 * font::ASCENT) as f32)
            .descent((-1e3 * font::DESCENT) as f32)
            .cap_height((1e3 * font::CAP_HEIGHT) as f32)
            .stem_v(STEM)
            .font_file2(data);

        let mut map = UnicodeCmap::new(Name(b"DejaVuSans"), IDENTITY);
        for (code, text) in &self.texts {
            map.pair_with_multiple(*code, text.chars());
        }
        pdf.cmap(cmap, &packed(map.finish().as_slice())?).filter(Filter::FlateDecode);

        let program = packed(&file)?;
        pdf.stream(data, &program).filter(Filter::FlateDecode).pair(Name(b"Length1"), file.len() as i32);
        Ok(())
    }
}
