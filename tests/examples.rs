//! The examples run, and are as short as they promise.
#![expect(unreachable_pub, reason = "the main function of an example is called here")]

use crate::support::{carried, read_text, sources};
use loftsman::prelude::Failure;

#[path = "../examples/export.rs"]
mod export;
#[path = "../examples/fair.rs"]
mod fair;
#[path = "../examples/fair_curve.rs"]
mod fair_curve;
#[path = "../examples/fit.rs"]
mod fit;
#[path = "../examples/generate.rs"]
mod generate;
#[path = "../examples/hydrostatics.rs"]
mod hydrostatics;
#[path = "../examples/report.rs"]
mod report;
#[path = "../examples/sections.rs"]
mod sections;

/// The working directory of tests is the root of the package, as that of examples is.
#[test]
fn they_run() -> Result<(), Failure> {
    export::main()?;
    fair::main()?;
    fair_curve::main()?;
    fit::main()?;
    generate::main()?;
    hydrostatics::main()?;
    report::main()?;
    sections::main()
}

#[test]
fn they_are_short() {
    let examples = sources(&carried("examples"));
    assert_eq!(examples.len(), 8);
    for example in examples {
        let lines = read_text(&example).lines().count();
        assert!(lines <= 30, "{}: {lines} lines", example.display());
    }
}
