//! How a command ends.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::jupyter::{InstallError, KernelError, NotebookError};
use crate::prompt::{JournalError, ReplError};
use lisp::files::text_of;
use session::WatchError;
use view::picture::ViewError;
use view::watch::live::PlaceError;
use view::watch::recording::RecordingError;

/// How a command ended that could do its work.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Status {
    /// Success.
    Good,
    /// A condition was not handled, a transcript differs, or a check found a problem.
    Bad,
    /// The work could not be done.
    Unusable,
    /// A part of the work is missing.
    Incomplete,
    /// planwright could not do a part of the work.
    Defective,
    /// The program exited with a status of its own.
    Left(u8),
}

impl Status {
    pub(crate) fn code(self) -> u8 {
        match self {
            Status::Good => 0,
            Status::Bad => 1,
            Status::Unusable => 2,
            Status::Incomplete => 3,
            Status::Defective => 4,
            Status::Left(code) => code,
        }
    }
}

/// Why a command could not do its work.
#[derive(Debug, Error)]
pub(crate) enum CommandError {
    /// Standard output cannot be written to.
    #[error("cannot write: {0}")]
    Write(#[from] io::Error),
    /// A file named on the command line cannot be read.
    #[error("cannot read {}: {error}", path.display())]
    Read { path: PathBuf, error: io::Error },
    /// A blessed transcript or a picture cannot be written.
    #[error("cannot write {}: {error}", path.display())]
    Rewrite { path: PathBuf, error: io::Error },
    /// There is no such view to draw.
    #[error("{0}")]
    View(#[from] ViewError),
    /// A recording cannot be shown.
    #[error("cannot show {}: {error}", path.display())]
    Recording {
        path: PathBuf,
        error: RecordingError,
    },
    /// The page of a recording cannot be served.
    #[error("{0}")]
    Serve(PlaceError),
    /// The session cannot be watched.
    #[error("{0}")]
    Watch(#[from] WatchError),
    /// The robot and its world cannot be set up.
    #[error("{0}")]
    Open(String),
    /// A sweep cannot be run.
    #[error("{0}")]
    Sweep(String),
    /// What was performed cannot be written.
    #[error("cannot write the episode into {}: {}", path.display(), report.trim_end())]
    Episode { path: PathBuf, report: String },
    /// A question cannot be answered.
    #[error("{0}")]
    Ask(String),
    /// Submissions cannot be graded.
    #[error("{0}")]
    Grade(String),
    /// Not all that was asked for could be written.
    #[error("{}", lines(.0))]
    Unwritten(Vec<CommandError>),
    /// An earlier session cannot be resumed.
    #[error("{0}")]
    Resume(#[from] JournalError),
    /// The kernel for notebooks cannot run.
    #[error("{0}")]
    Kernel(#[from] KernelError),
    /// The kernel cannot be made known to Jupyter.
    #[error("{0}")]
    Install(#[from] InstallError),
    /// A file is no executed notebook.
    #[error("{} is no notebook: {error}", path.display())]
    Notebook { path: PathBuf, error: NotebookError },
    /// An output is an input, too.
    #[error(
        "{option} {} would overwrite {}, which is read: name another file",
        path.display(), input.display()
    )]
    Overwrites {
        option: &'static str,
        path: PathBuf,
        input: PathBuf,
    },
    /// Two outputs are the same file.
    #[error("{} and {} both write {}: name two files", options[0], options[1], path.display())]
    WritesTwice {
        options: [&'static str; 2],
        path: PathBuf,
    },
    /// There are frames of another film in the folder.
    #[error(
        "{} has frames already, such as {example}, which would be mixed with new ones: remove them, \
         or name another folder", folder.display()
    )]
    OtherFrames { folder: PathBuf, example: String },
    /// The prompt does not work.
    #[error("{0}")]
    Prompt(#[from] ReplError),
}

impl CommandError {
    /// Whether the reader of our output has closed it.
    pub(crate) fn is_broken_pipe(&self) -> bool {
        matches!(
            self,
            CommandError::Write(error) | CommandError::Prompt(ReplError::Write(error))
                if error.kind() == io::ErrorKind::BrokenPipe
        )
    }
}

/// Each on a line.
fn lines(errors: &[CommandError]) -> String {
    let errors: Vec<String> = errors.iter().map(ToString::to_string).collect();
    errors.join("\n")
}

/// Reads a file of forms named on the command line; the tutorial's files are built in.
pub(crate) fn read(path: &Path) -> Result<String, CommandError> {
    text_of(path).or_else(|error| {
        let name = path.to_str().filter(|_| !path.exists());
        let built_in = name.and_then(plan_files::text_of);
        built_in
            .map(str::to_owned)
            .ok_or_else(|| CommandError::Read {
                path: path.to_owned(),
                error,
            })
    })
}
