//! `loftsman completions SHELL`, `loftsman completions -o FOLDER`

use std::path::PathBuf;

use clap::{Args, Command, CommandFactory, ValueEnum};
use clap_complete::Shell;

use super::{Cli, stream};
use crate::report::{Destination, Failure, Inputs, OutputFile};

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Shell whose completions are printed
    #[arg(value_enum, required_unless_present = "output")]
    shell: Option<Shell>,
    /// Folder for the completions of all shells and for manual pages of all commands
    #[arg(short, long, value_name = "FOLDER", conflicts_with = "shell")]
    output: Option<PathBuf>,
    /// Overwrite files that are there already
    #[arg(long)]
    force: bool,
}

/// The completions of a shell, under the name by which it finds them.
fn completions(shell: Shell) -> OutputFile {
    let mut contents = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "loftsman", &mut contents);
    let name = match shell {
        Shell::Bash => "loftsman.bash".to_owned(),
        Shell::Zsh => "_loftsman".to_owned(),
        Shell::Fish => "loftsman.fish".to_owned(),
        Shell::PowerShell => "_loftsman.ps1".to_owned(),
        other => format!("loftsman.{other}"),
    };
    OutputFile { name, contents }
}

/// The manual page of a command.
fn manual_page(command: Command) -> Result<OutputFile, Failure> {
    let name = format!("{}.1", command.get_display_name().unwrap_or_else(|| command.get_name()));
    let mut contents = Vec::new();
    let written = clap_mangen::Man::new(command).render(&mut contents);
    written.map_err(|error| Failure::Internal(format!("manual page {name}: {error}")))?;
    Ok(OutputFile { name, contents })
}

/// Completions of all shells, and manual pages of the program and of its commands.
fn files() -> Result<Vec<OutputFile>, Failure> {
    let mut program = Cli::command();
    program.build();
    let commands = program.get_subcommands().filter(|command| command.get_name() != "help").cloned();
    let pages = std::iter::once(program.clone()).chain(commands).map(manual_page);
    Shell::value_variants().iter().map(|&shell| Ok(completions(shell))).chain(pages).collect()
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    if let Some(folder) = &arguments.output {
        return Destination { folder, inputs: &Inputs::default(), force: arguments.force }.write(&files()?);
    }
    match arguments.shell {
        Some(shell) => stream::data(&String::from_utf8_lossy(&completions(shell).contents)),
        None => Ok(()),
    }
}
