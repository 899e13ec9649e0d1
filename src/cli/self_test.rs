//! `loftsman self-test`

use clap::Args;

use super::stream;
use crate::report::{Failure, SelfCheck, self_test, self_test_page};

#[derive(Debug, Args)]
pub(super) struct Arguments {}

pub(super) fn run(_: &Arguments) -> Result<(), Failure> {
    let checks = self_test()?;
    stream::data(&self_test_page(&checks))?;
    if checks.iter().all(SelfCheck::passed) {
        Ok(())
    } else {
        Err(Failure::Check("E501 the self-test failed: see the lines marked FAILED".to_owned()))
    }
}
