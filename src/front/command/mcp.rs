//! Serves a session to assistants and other programs (Model Context Protocol).

use std::io;
use std::path::PathBuf;

use clap::Args;

use super::failure::{CommandError, Status};
use super::open::{open_for_programs, open_session};
use super::options::{LogLevel, Options};
use super::outputs::Outputs;
use crate::mcp::{Server, World};

/// How to serve.
#[derive(Args, Debug)]
pub(crate) struct McpArguments {
    /// Folder into which pages with runs may be written; without it, nothing is written
    #[arg(long, value_name = "FOLDER")]
    folder: Option<PathBuf>,
}

/// Answers requests on standard input until it ends.
pub(crate) fn mcp(options: &Options, wanted: &McpArguments) -> Result<Status, CommandError> {
    Outputs::reading(options.files())
        .folder("--folder", wanted.folder.as_ref())
        .check()?;
    let quiet = Options {
        log_level: LogLevel::Warn,
        realtime: None,
        ..options.clone()
    };
    let session = open_session(&quiet)?;
    let world = World::new(session, wanted.folder.clone(), open_for_programs)
        .map_err(CommandError::Open)?;
    let input = io::stdin().lock();
    Server::new(world).serve(input, io::stdout().lock())?;
    Ok(Status::Good)
}
