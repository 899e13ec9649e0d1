//! Whole jobs: from a design to the files about it, and what is printed of them.

mod check;
mod convert;
mod failure;
mod files;
mod generate;
mod markdown;
mod page;
mod self_test;
mod source;

pub use check::{Accepted, Check, CheckProblem, accept, check_files, check_json, check_page, check_table};
pub use convert::{Converted, convert_table};
pub use failure::Failure;
pub use files::{OutputFile, write_all, write_run};
pub use generate::{Outputs, generate_outputs};
pub use page::{hydrostatics_page, self_test_page, summary_page};
pub use self_test::{SelfCheck, self_test};
pub use source::{Source, offsets, read_design, read_source, read_table_file, sections_of};
