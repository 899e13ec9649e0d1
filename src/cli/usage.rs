//! What is wrong with a command line, with a code.

use std::ffi::OsString;

use clap::error::{ContextKind, ContextValue, ErrorKind};

use crate::config::{Diagnostic, Severity};
use crate::report::{COMMAND_LINE, Failure};

/// Whether a command line asks for JSON, also one that cannot be understood.
pub(super) fn wants_json(arguments: &[OsString]) -> bool {
    arguments.iter().take_while(|word| *word != "--").any(|word| word == "--json" || word == "--jsonl")
}

fn code(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::UnknownArgument | ErrorKind::InvalidSubcommand => "E701",
        ErrorKind::MissingRequiredArgument
        | ErrorKind::MissingSubcommand
        | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand
        | ErrorKind::TooFewValues => "E702",
        ErrorKind::ArgumentConflict | ErrorKind::TooManyValues => "E704",
        _ => "E703",
    }
}

/// The words of a context.
fn words(value: Option<&ContextValue>) -> String {
    match value {
        Some(ContextValue::String(text)) => text.clone(),
        Some(ContextValue::Strings(list)) => list.join(", "),
        _ => String::new(),
    }
}

/// What to do about a value that an option does not take.
fn of_value(key: &str, valid: &str) -> String {
    match (key, valid) {
        ("", "") => "The command describes its options with --help".to_owned(),
        (key, "") => format!("Correct the value of {key}, which the command describes with --help"),
        (_, valid) => format!("Give one of {valid}"),
    }
}

/// The failure of a command line. Its message is what the parser says of it, without its heading.
pub(super) fn failure(error: &clap::Error) -> Failure {
    let text = error.render().to_string();
    let text = text.trim_end().trim_start_matches("error: ");
    let (message, help) = text.split_once("\n\n").unwrap_or((text, ""));
    let message: Vec<&str> = message.lines().map(str::trim).collect();
    let message = message.join(" ");
    let invalid = [ContextKind::InvalidArg, ContextKind::InvalidSubcommand];
    let found = words(error.get(ContextKind::InvalidValue));
    let valid = words(error.get(ContextKind::ValidValue));
    let expected = if valid.is_empty() { String::new() } else { format!("; expected {valid}") };
    // The list of what is possible stands behind `expected`.
    let message = match message.split_once(" [possible values:") {
        Some((before, _)) => before.to_owned(),
        None => message,
    };
    let key = words(invalid.into_iter().find_map(|kind| error.get(kind)));
    let code = code(error.kind());
    let help = if code == "E703" { of_value(&key, &valid) } else { help.trim().to_owned() };
    Failure::Options(vec![Diagnostic {
        severity: Severity::Error,
        code,
        file: COMMAND_LINE.to_owned(),
        line: None,
        column: None,
        key,
        message: format!("{message}{expected}"),
        found,
        help,
    }])
}
