//! The document: pages of their sizes, what they share, and what the file says of itself. No dates and no chance: the
//! same pages give the same bytes.

use super::drawing::{FONT, PageContent};
use super::error;
use super::letters::Letters;
use super::packed::{COMPACT, packed};
use crate::plot::paper::error::PlotError;
use pdf_writer::{Filter, Finish, Name, Pdf, Rect, Ref, TextStr};

/// What a viewer shows of the document as a whole.
pub(super) struct About<'a> {
    pub(super) title: &'a str,
    /// Name and version of the program.
    pub(super) creator: &'a str,
    /// Language of its text, as `en`.
    pub(super) language: &'a str,
}

/// The document in the making.
pub(super) struct Document {
    pdf: Pdf,
    catalog: Ref,
    tree: Ref,
    resources: Ref,
    font: Ref,
    /// The next object.
    next: Ref,
    pages: Vec<Ref>,
    letters: Letters,
}

impl Document {
    pub(super) fn new() -> Self {
        let mut next = Ref::new(1);
        let [catalog, tree, resources, font] = [(); 4].map(|()| next.bump());
        let (pdf, letters) = (Pdf::with_settings(COMPACT), Letters::new());
        Self { pdf, catalog, tree, resources, font, next, pages: Vec::new(), letters }
    }

    /// A further page, its size in points.
    pub(super) fn page(
        &mut self,
        size: [f64; 2],
        draw: impl FnOnce(&mut PageContent<'_>) -> Result<(), PlotError>,
    ) -> Result<(), PlotError> {
        let mut content = PageContent::new(size[1], &mut self.letters);
        draw(&mut content)?;
        let stream = packed(&content.finish())?;
        let [id, contents] = [(); 2].map(|()| self.next.bump());
        let [width, height] = size.map(|points| points as f32);
        let mut page = self.pdf.page(id);
        page.parent(self.tree).media_box(Rect::new(0.0, 0.0, width, height)).contents(contents);
        page.pair(Name(b"Resources"), self.resources);
        page.finish();
        self.pdf.stream(contents, &stream).filter(Filter::FlateDecode);
        self.pages.push(id);
        Ok(())
    }

    /// The bytes of the file.
    pub(super) fn finish(mut self, about: &About<'_>) -> Result<Vec<u8>, PlotError> {
        let mut catalog = self.pdf.catalog(self.catalog);
        catalog.pages(self.tree).lang(TextStr(about.language));
        catalog.finish();
        let count = i32::try_from(self.pages.len()).map_err(error)?;
        self.pdf.pages(self.tree).count(count).kids(self.pages.iter().copied());
        let mut resources = self.pdf.indirect(self.resources).dict();
        if !self.letters.is_empty() {
            resources.insert(Name(b"Font")).dict().pair(FONT, self.font);
        }
        resources.finish();
        if !self.letters.is_empty() {
            self.letters.write(&mut self.pdf, self.font, &mut self.next)?;
        }
        let info = self.next.bump();
        self.pdf.document_info(info).title(TextStr(about.title)).creator(TextStr(about.creator));
        Ok(self.pdf.finish())
    }
}
