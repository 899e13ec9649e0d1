//! The program `loftsman`: see `loftsman --help`.

use std::process::ExitCode;

fn main() -> ExitCode {
    loftsman::internals::cli::run(std::env::args_os())
}
