//! Streams of a document as they are packed.

use super::error;
use crate::plot::paper::error::PlotError;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use pdf_writer::Settings;
use std::io::Write;

/// No spaces that only people need.
pub(super) const COMPACT: Settings = Settings { pretty: false };

/// `bytes` as a stream holds them.
pub(super) fn packed(bytes: &[u8]) -> Result<Vec<u8>, PlotError> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::new(6));
    encoder.write_all(bytes).and_then(|()| encoder.finish()).map_err(error)
}
