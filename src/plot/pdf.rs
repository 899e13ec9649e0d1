//! Figures on the pages of a PDF at true size: vectors, and text in the embedded font. No dates: the same figures give the same bytes.

use super::figure::Svg;
use super::sheet::{ROOM, Sheet, framed};
use super::{PlotError, caption, png};
use krilla::geom::{Size, Transform};
use krilla::metadata::Metadata;
use krilla::page::PageSettings;
use krilla::surface::Surface;
use krilla::{Document, SerializeSettings};
use krilla_svg::{SurfaceExt, SvgSettings};
use resvg::usvg::Tree;

/// Points of a PDF in a millimetre.
const POINTS: f64 = 72.0 / 25.4;
/// Millimetres in a pixel of SVG.
const PIXEL: f64 = 25.4 / 96.0;

fn error(what: impl std::fmt::Display) -> PlotError {
    PlotError::Pdf(what.to_string())
}

/// Width and height of a drawing \[mm\].
fn size(tree: &Tree) -> [f64; 2] {
    [f64::from(tree.size().width()), f64::from(tree.size().height())].map(|pixels| pixels * PIXEL)
}

/// Draws with the upper left corner at `at` \[mm\].
fn place(surface: &mut Surface<'_>, tree: &Tree, at: [f64; 2]) -> Result<(), PlotError> {
    let [width, height] = size(tree).map(|millimetres| (millimetres * POINTS) as f32);
    let size = Size::from_wh(width, height).ok_or_else(|| error("a drawing has no size"))?;
    surface.push_transform(&Transform::from_translate((at[0] * POINTS) as f32, (at[1] * POINTS) as f32));
    surface.draw_svg(tree, size, SvgSettings::default()).ok_or_else(|| error("a drawing could not be placed"))?;
    surface.pop();
    Ok(())
}

/// The pages: each figure with its title, in the middle of an A3 sheet with frame, title block and check bar, or as the whole
/// sheet where it is larger than the frame leaves.
///
/// # Errors
/// [`PlotError::Svg`], [`PlotError::Pdf`].
pub fn write_pdf(ship: &str, figures: &[(&str, &Svg)]) -> Result<Vec<u8>, PlotError> {
    let mut document = Document::new_with(SerializeSettings::default());
    let metadata = Metadata::new().title(ship.to_owned()).creator(caption::program()).language("en".to_owned());
    document.set_metadata(metadata);
    for (k, (title, svg)) in figures.iter().enumerate() {
        let tree = png::tree(svg.as_str())?;
        let own = size(&tree);
        let fits = own[0] <= ROOM[0] + 0.1 && own[1] <= ROOM[1] + 0.1;
        let paper = if fits { Sheet::A3.size() } else { own };
        let [width, height] = paper.map(|millimetres| (millimetres * POINTS) as f32);
        let settings = PageSettings::from_wh(width, height).ok_or_else(|| error("a page has no size"))?;
        let mut page = document.start_page_with(settings);
        let mut surface = page.surface();
        if fits {
            place(&mut surface, &png::tree(framed(ship, title, k + 1, figures.len()).as_str())?, [0.0, 0.0])?;
            let frame = Sheet::A3.frame();
            // A figure covers what is under it: it stays off the frame.
            let at = [0.5 * (paper[0] - own[0]), frame.top + 1.0 + 0.5 * (ROOM[1] - own[1]).max(0.0)];
            place(&mut surface, &tree, at)?;
        } else {
            place(&mut surface, &tree, [0.0, 0.0])?;
        }
        surface.finish();
        page.finish();
    }
    document.finish().map_err(|found| error(format!("{found:?}")))
}
