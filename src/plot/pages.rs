//! What the pages of a document are made of.

use super::paper::svg::Svg;

/// A figure of the document.
#[derive(Debug, Clone, Copy)]
pub struct Page<'a> {
    /// What the title block calls it.
    pub title: &'a str,
    /// What to look for; three lines of the title block.
    pub caption: &'a str,
    /// The drawing.
    pub svg: &'a Svg,
}

/// What all title blocks of a document say.
#[derive(Debug, Clone, Copy)]
pub struct Heading<'a> {
    /// Name of the ship.
    pub ship: &'a str,
    /// What the drawings were made from, with its hash.
    pub source: &'a str,
    /// The date, as it was given.
    pub date: Option<&'a str>,
}
