//! `manifest.json`: what was read and written, by their SHA-256; no times, so that the same input gives the same bytes.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// One file and its hash.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ManifestEntry {
    /// Name of the file, without its folder.
    pub file: String,
    /// Length \[bytes\].
    pub bytes: usize,
    /// SHA-256 in hexadecimal.
    pub sha256: String,
}

impl ManifestEntry {
    /// The entry of a file with these contents.
    #[must_use]
    pub fn new(file: &str, contents: &[u8]) -> Self {
        Self { file: file.to_owned(), bytes: contents.len(), sha256: sha256(contents) }
    }
}

/// What a run read and wrote.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Manifest {
    /// Name of the program.
    pub program: &'static str,
    /// Its version.
    pub version: &'static str,
    /// The design that was read.
    pub input: ManifestEntry,
    /// What was read besides.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub others: Vec<ManifestEntry>,
    /// The files that were written, in the order of their names; the manifest itself is not among them.
    pub outputs: Vec<ManifestEntry>,
}

/// The files that a manifest says were written; none when the text is no manifest of this program.
#[must_use]
pub fn read_manifest_outputs(text: &str) -> Vec<ManifestEntry> {
    #[derive(Deserialize)]
    struct Written {
        program: String,
        outputs: Vec<ManifestEntry>,
    }
    match serde_json::from_str(text) {
        Ok(Written { program, outputs }) if program == env!("CARGO_PKG_NAME") => outputs,
        _ => Vec::new(),
    }
}

/// The file that a manifest says was read; none when the text is no manifest of this program.
#[must_use]
pub fn read_manifest_input(text: &str) -> Option<ManifestEntry> {
    #[derive(Deserialize)]
    struct Read {
        program: String,
        input: ManifestEntry,
    }
    let read: Read = serde_json::from_str(text).ok()?;
    (read.program == env!("CARGO_PKG_NAME")).then_some(read.input)
}

/// SHA-256 in hexadecimal.
#[must_use]
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outputs_are_read_back_from_manifests_only() {
        let outputs = vec![ManifestEntry::new("a.png", b"a")];
        let mut manifest = Manifest {
            program: "loftsman",
            version: "1",
            input: ManifestEntry::new("a.toml", b""),
            others: Vec::new(),
            outputs,
        };
        let text = |manifest: &Manifest| serde_json::to_string(manifest).unwrap();
        assert_eq!(read_manifest_outputs(&text(&manifest)), manifest.outputs);
        manifest.program = "other";
        assert!(read_manifest_outputs(&text(&manifest)).is_empty() && read_manifest_outputs("{").is_empty());
    }

    #[test]
    fn the_hash_of_abc() {
        // FIPS 180-4, example of SHA-256.
        assert_eq!(sha256(b"abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    }
}
