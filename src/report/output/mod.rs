//! What jobs write: files that appear whole, manifests, pictures.

pub(super) mod files;
pub(super) mod manifest;
pub(super) mod pictures;
pub(super) mod staging;
