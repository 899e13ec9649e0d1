//! The finished drawing.

use super::error::PlotError;
use super::png;
use super::png::Drawing;
use std::fmt;
use std::sync::{Arc, OnceLock};

/// A finished drawing.
#[derive(Clone)]
pub struct Svg {
    text: String,
    /// As it was read for a picture or a document.
    tree: OnceLock<Arc<Drawing>>,
}

impl fmt::Debug for Svg {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("Svg").field("text", &self.text).finish()
    }
}

impl PartialEq for Svg {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

impl Svg {
    pub(in crate::plot) fn new(text: String) -> Self {
        Self { text, tree: OnceLock::new() }
    }

    /// The drawing as resvg reads it, which takes as long as some pictures do: once.
    pub(in crate::plot) fn tree(&self) -> Result<Arc<Drawing>, PlotError> {
        if let Some(tree) = self.tree.get() {
            return Ok(Arc::clone(tree));
        }
        let tree = Arc::new(png::tree(&self.text)?);
        Ok(Arc::clone(self.tree.get_or_init(|| tree)))
    }

    /// The SVG document; its size is in millimetres.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.text
    }

    /// The drawing as PNG at `dots_per_inch`.
    ///
    /// # Errors
    /// [`PlotError::PictureSize`] when the picture would be empty or have a side of more than 20000 pixels.
    pub fn to_png(&self, dots_per_inch: f64) -> Result<Vec<u8>, PlotError> {
        png::render(self.tree()?.as_ref(), dots_per_inch)
    }
}
