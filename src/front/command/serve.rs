//! Serves the tools for assistants as plain lines of JSON.

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::failure::{CommandError, Status};
use super::mcp::{check_folder, opened};
use super::options::Options;
use crate::tools::{Lines, World};

/// How to serve.
#[derive(Args, Debug)]
pub(crate) struct ServeArguments {
    /// Answer requests on standard input, one on a line, until it ends
    #[arg(long, required = true)]
    stdio: bool,
    /// Folder into which pages with runs may be written; without it, nothing is written
    #[arg(long, value_name = "FOLDER")]
    folder: Option<PathBuf>,
}

/// Answers requests on standard input until it ends.
pub(crate) fn serve(options: &Options, wanted: &ServeArguments) -> Result<Status, CommandError> {
    check_folder(options, wanted.folder.as_ref())?;
    let opened = opened(options)?;
    let world = World::new(&opened, wanted.folder.as_deref()).map_err(CommandError::Open)?;
    Lines::new(world).serve(io::stdin().lock(), io::stdout().lock())?;
    Ok(Status::Good)
}
