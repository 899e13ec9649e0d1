//! `loftsman self-test`

use clap::Args;

use super::stream;
use crate::report::{Failure, SelfCheck, self_test, self_test_page};

#[derive(Debug, Args)]
pub(super) struct Arguments {}

pub(super) fn run(_: &Arguments) -> Result<(), Failure> {
    let checks = self_test()?;
    stream::data(&self_test_page(&checks))?;
    verdict(&checks)
}

fn verdict(checks: &[SelfCheck]) -> Result<(), Failure> {
    if checks.iter().all(SelfCheck::passed) {
        Ok(())
    } else {
        Err(Failure::Check("E501 the self-test failed: see the lines marked FAILED".to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_failed_check_fails_the_test() {
        let check = |error| SelfCheck {
            body: "box".to_owned(),
            key: "CB",
            ours: Some(1.0),
            exact: 1.0,
            error,
            tolerance: 1e-10,
        };
        assert!(verdict(&[check(0.0)]).is_ok());
        let failure = verdict(&[check(0.0), check(1e-9)]).unwrap_err();
        assert!(failure.exit_code() == 5 && failure.to_string().starts_with("E501 "), "{failure}");
    }
}
