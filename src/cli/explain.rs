//! `loftsman explain [CODE...]`

use clap::Args;

use super::stream;
use crate::report::{Failure, codes_json, codes_list, codes_text, explanations};

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Codes of messages, as E301 or w320; without one, all codes with their titles
    #[arg(value_name = "CODE")]
    codes: Vec<String>,
    /// One JSON array of objects with code, title, cause, example and remedy
    #[arg(long)]
    json: bool,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let found = explanations(&arguments.codes)?;
    let text = match (arguments.json, arguments.codes.is_empty()) {
        (true, _) => stream::json(&codes_json(&found))?,
        (false, true) => codes_list(&found),
        (false, false) => codes_text(&found),
    };
    stream::data(&text)
}
