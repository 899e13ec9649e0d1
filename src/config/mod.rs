//! The design file: what it says (a document of known keys with their places), then what it means (a [`Design`]).
//!
//! Every problem of a file is found in one reading and reported with line, column, key, what was found, what was
//! expected and the remedy. [`KEYS`] is the one list of keys: reading, messages, the JSON Schema and the templates of
//! `loftsman new` come from it.

mod derive;
mod design;
mod design_targets;
mod diagnostic;
mod document;
mod job;
mod keys;
mod method;
mod reference;
mod schema;
mod table_keys;
mod template;
mod value;

pub use derive::{DERIVE_KEYS, DeriveFile, read_derive, read_derive_option};
pub use design::{Design, Output, read};
pub use diagnostic::{Diagnostic, Severity};
pub use job::{JOB_KEYS, JobFile, Location, Quantity, RuleEntry, TableItem, TableRef, Target, read_job, read_option};
pub use keys::{FAMILIES, FIGURES, KEYS, Key, Kind, PRESET_ALIASES};
pub use method::{METHOD_KEYS, METHODS, MethodFile, read_method};
pub use reference::{Reference, ReferenceRow};
pub use schema::{conventions_schema, design_schema, job_schema, method_schema};
pub use table_keys::TABLE_KEYS;
pub use template::{TEMPLATES, template};
