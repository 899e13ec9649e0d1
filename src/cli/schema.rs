//! `loftsman schema [design|method|job|table]`

use clap::{Args, ValueEnum};

use super::stream;
use crate::config::{conventions_schema, design_schema, job_schema, method_schema};
use crate::report::Failure;

#[derive(Debug, Clone, Copy, ValueEnum)]
enum File {
    /// The design file of `generate`
    Design,
    /// The method file of `fit`
    Method,
    /// The job file of `fair`
    Job,
    /// The conventions beside a table of offsets or a body
    Table,
}

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Which file
    #[arg(value_enum, default_value = "design")]
    file: File,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    match arguments.file {
        File::Design => stream::data(&stream::json(&design_schema())?),
        File::Job => stream::data(&stream::json(&job_schema())?),
        File::Table => stream::data(&stream::json(&conventions_schema())?),
        File::Method => stream::data(&stream::json(&method_schema())?),
    }
}
