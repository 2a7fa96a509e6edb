//! The journal: every input is on disk before it is evaluated, so that a session can be resumed
//! however it ended.
//!
//! A journal is a text file of records, one on each line: a word, a checksum, and a text (see
//! [`record`]). `seed`, `world`, `world-description`, `robot`, `robot-description`, `objects`, `noise`,
//! `faithful`, `package-path`, `systems`, `setup` and `closed` say how the session began. `input` is an input, `pasted` an input
//! that conditions do not stop; its evaluation begins when the record is on disk. `interrupted` says
//! where it was interrupted, and `ended` that it has ended, with the hash of the world then, and how;
//! `loaded` names a file that it has loaded, or one with which the session began, with a digest. While
//! a session is resumed, `again` says that the evaluation of that input begins once more, and
//! `skipped` that it is left out. Replaying a journal leads to the same state, because nothing else has
//! an effect.
//!
//! Invariants:
//! - A journal is only ever appended to, by the one session that holds its lock. What a session
//!   cannot continue in place, it continues in a copy.
//! - The checksum of a record covers everything before it, too. What is in front of the first
//!   damaged record is what was written.

mod folder;
mod loaded;
mod opening;
mod reading;
mod record;
mod writing;

use std::io;
use std::path::PathBuf;

use thiserror::Error;

pub(crate) use loaded::Loaded;
pub(crate) use opening::{Opened, Wanted, copied, open};
pub(crate) use reading::Earlier;
pub(crate) use writing::Journal;

/// How a session began.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub(crate) struct Beginning {
    /// Seed for everything random.
    pub(crate) seed: u64,
    /// The kitchen used instead of the built-in one.
    pub(crate) world: Option<PathBuf>,
    /// What that kitchen's furniture is for.
    pub(crate) world_description: Option<PathBuf>,
    /// The robot used instead of the built-in one.
    pub(crate) robot: Option<PathBuf>,
    /// What that robot's links and joints are for.
    pub(crate) robot_description: Option<PathBuf>,
    /// Further types of objects.
    pub(crate) objects: Option<PathBuf>,
    /// The errors of the robot's sensors and motors, as on the command line.
    pub(crate) noise: Option<String>,
    /// Whether no joint moves faster than its URDF says.
    pub(crate) is_faithful: bool,
    /// Folders with the packages that URDFs name.
    pub(crate) package_path: Vec<PathBuf>,
    /// Folders in which systems are looked for.
    pub(crate) systems: Vec<PathBuf>,
    /// Files that were loaded first.
    pub(crate) setup: Vec<PathBuf>,
    /// Whether inputs could use no files and not edit the world.
    pub(crate) is_closed: bool,
    /// What was in these files.
    pub(crate) digests: Vec<Loaded>,
}

/// An input of an earlier session.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Recorded {
    /// What was typed.
    pub(crate) text: String,
    /// Where its evaluation was interrupted.
    pub(crate) interrupted_at: Option<u64>,
    /// Whether conditions stop its evaluation rather than end it.
    pub(crate) stops: bool,
    /// What became of it.
    pub(crate) end: End,
    /// How it ended, if that was recorded.
    pub(crate) ending: Option<String>,
    /// The files that it has loaded.
    pub(crate) loaded: Vec<Loaded>,
}

/// What became of an input.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum End {
    /// Nothing says that its evaluation ended: the program may have died of it.
    Unknown,
    /// It ended; the hash of the world afterwards, if that was recorded.
    Ended(Option<u64>),
    /// The user left it out when the session was resumed.
    Skipped,
}

/// Why a journal cannot be used.
#[derive(Debug, Error)]
pub(crate) enum JournalError {
    /// There is no journal.
    #[error("there is no journal of an earlier session{}", .0.as_ref().map(|d| format!(" in {}", d.display())).unwrap_or_default())]
    None(Option<PathBuf>),
    /// All journals belong to sessions that are running.
    #[error(
        "every journal in {} belongs to a running session; --resume={} starts from a copy of the newest",
        folder.display(), newest.display()
    )]
    Running {
        /// Where they are.
        folder: PathBuf,
        /// The newest one.
        newest: PathBuf,
    },
    /// It cannot be read.
    #[error("cannot read the journal {}: {error}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The reason.
        error: io::Error,
    },
    /// It is not a journal.
    #[error("{} is not a journal", .0.display())]
    Format(PathBuf),
    /// It was written by a later version of the program.
    #[error("{} is the journal of a newer planwright; resume it with that version", .0.display())]
    Newer(PathBuf),
    /// It would be overwritten.
    #[error(
        "{file} is the journal of an earlier session: --resume={file} continues it; give --journal a new file",
        file = path.display()
    )]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// Files have changed, and nobody has said that this does not matter.
    #[error(
        "{} is not resumed, since files have changed; with --despite-changes it is, with the files as they are",
        .0.display()
    )]
    Changed(PathBuf),
    /// An input ended otherwise than before, and nobody has said that this does not matter.
    #[error(
        "{} is not resumed beyond input {number}, which ended otherwise than before; with \
         --despite-changes it is", path.display()
    )]
    Differs {
        /// The file.
        path: PathBuf,
        /// The number of the input, from one.
        number: usize,
    },
    /// Something else would be overwritten.
    #[error("{} is not a journal and is not overwritten: give --journal a new file", .0.display())]
    Foreign(PathBuf),
}

#[cfg(test)]
mod tests;
