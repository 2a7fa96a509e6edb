//! Finds mistakes in plan files without running them.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::Args;
use lisp::visible::visible;

use super::failure::{CommandError, Status, read};
use super::open::open;
use super::options::Options;
use super::paint::Paint;
use session::dialogue::{Evaluate, Finding};

/// What to check.
#[derive(Args, Debug)]
pub(crate) struct CheckArguments {
    /// Plan files
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
}

/// Checks the files in the order in which they would be loaded and prints the findings.
pub(crate) fn check(options: &Options, wanted: &CheckArguments) -> Result<Status, CommandError> {
    let paint = Paint::new(options.color, &io::stdout());
    let mut session = open(options)?;
    let mut to = io::BufWriter::new(io::stdout());
    let mut found = 0;
    for path in &wanted.files {
        let name = path.display().to_string();
        for finding in session.check(&name, &read(path)?) {
            found += 1;
            to.write_all(described(&name, &finding, paint).as_bytes())?;
        }
    }
    let files = counted(wanted.files.len(), "file");
    writeln!(to, "{files} checked, {} found", counted(found, "mistake"))?;
    to.flush()?;
    Ok(if found == 0 {
        Status::Good
    } else {
        Status::Bad
    })
}

fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// A finding with its place and the form underlined.
pub(crate) fn described(name: &str, finding: &Finding, paint: Paint) -> String {
    let message = paint.bad(&finding.message);
    match &finding.place {
        Some(place) => format!("{place}: {message}\n{}\n", place.underlined()),
        None => format!("{}: {message}\n", visible(name)),
    }
}
