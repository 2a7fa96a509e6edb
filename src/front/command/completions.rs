//! Prints completion scripts for shells.

use std::io::{self, Write};

use clap::{Args, Command};
use clap_complete::Shell;

use super::failure::{CommandError, Status};

/// What to complete for.
#[derive(Args, Debug)]
pub(crate) struct CompletionsArguments {
    /// The shell to complete for
    shell: Shell,
}

/// Prints the script for the command line.
pub(crate) fn print(
    mut command: Command,
    wanted: &CompletionsArguments,
) -> Result<Status, CommandError> {
    let mut script = Vec::new();
    clap_complete::generate(wanted.shell, &mut command, "planwright", &mut script);
    io::stdout().write_all(&script)?;
    Ok(Status::Good)
}
