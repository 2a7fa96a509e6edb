//! Which journal a session reads, and in which one it is kept.

use std::fs::{self, File, OpenOptions};
use std::io::Read;
use std::path::Path;

use super::folder;
use super::reading::{Earlier, Tail};
use super::writing::{Journal, lock};
use super::{Beginning, JournalError, Recorded};

/// What the user asked for.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Wanted<'a> {
    /// A fresh session.
    Fresh,
    /// A fresh session, kept in that file.
    In(&'a Path),
    /// The last session that is not running any more.
    Last,
    /// The session in that journal.
    Of(&'a Path),
}

/// A session's journals.
#[derive(Debug, Default)]
pub(crate) struct Opened {
    /// Where the session is kept; `None` if it cannot be kept.
    pub(crate) journal: Option<Journal>,
    /// The session that is resumed.
    pub(crate) earlier: Option<Earlier>,
    /// What the user should know.
    pub(crate) remarks: Vec<String>,
}

/// A journal that was opened and, unless another session has it, locked.
struct Held {
    file: File,
    is_writable: bool,
    is_ours: bool,
    earlier: Earlier,
}

/// Opens the journals of a session; `beginning` says how it begins if it is fresh.
pub(crate) fn open(wanted: Wanted<'_>, beginning: &Beginning) -> Result<Opened, JournalError> {
    open_in(folder::folder().as_deref(), wanted, beginning)
}

/// As [`open`], with that folder for the journals for which the user names no file.
pub(super) fn open_in(
    folder: Option<&Path>,
    wanted: Wanted<'_>,
    beginning: &Beginning,
) -> Result<Opened, JournalError> {
    match wanted {
        Wanted::Fresh => Ok(fresh(folder, beginning)),
        Wanted::In(path) => fresh_in(path, beginning),
        Wanted::Last => Ok(resumed(folder, last(folder)?)),
        Wanted::Of(path) => Ok(resumed(folder, held(path)?)),
    }
}

fn fresh(folder: Option<&Path>, beginning: &Beginning) -> Opened {
    let (journal, failure) = kept_in(folder, beginning, &[]);
    Opened {
        journal,
        earlier: None,
        remarks: failure.into_iter().collect(),
    }
}

fn fresh_in(path: &Path, beginning: &Beginning) -> Result<Opened, JournalError> {
    match fs::metadata(path) {
        Ok(found) if !found.is_file() => {
            let reason = "it is not a regular file";
            return Ok(Opened {
                remarks: vec![not_kept(path, &reason)],
                ..Opened::default()
            });
        }
        Ok(found) if found.len() > 0 => make_room(path)?,
        _ => {}
    }
    Ok(match Journal::create(path, beginning, &[]) {
        Ok(journal) => Opened {
            remarks: not_yet_kept(&journal).into_iter().collect(),
            journal: Some(journal),
            ..Opened::default()
        },
        Err(error) => Opened {
            remarks: vec![not_kept(path, &error)],
            ..Opened::default()
        },
    })
}

/// Empties a journal in which nothing was typed; any other file is not overwritten.
fn make_room(path: &Path) -> Result<(), JournalError> {
    let exists = || JournalError::Exists {
        path: path.to_owned(),
    };
    match held(path) {
        Ok(held) if held.is_ours && held.earlier.is_blank() => {
            held.file.set_len(0).map_err(|_| exists())
        }
        Ok(_) | Err(JournalError::Newer(_)) => Err(exists()),
        // What cannot be read is no journal of ours, either.
        Err(_) => Err(JournalError::Foreign(path.to_owned())),
    }
}

/// The newest journal of the folder that has inputs and is not in use.
fn last(folder: Option<&Path>) -> Result<Held, JournalError> {
    let Some(folder) = folder else {
        return Err(JournalError::None(None));
    };
    let mut running = None;
    for path in folder::journals(folder).into_iter().rev() {
        match held(&path) {
            Ok(held) if held.earlier.inputs.is_empty() => {}
            Ok(held) if held.is_ours => return Ok(held),
            Ok(_) => running = running.or(Some(path)),
            // Another file does not keep anybody from resuming the session before it.
            Err(_) => {}
        }
    }
    match running {
        Some(newest) => {
            let folder = folder.to_owned();
            Err(JournalError::Running { folder, newest })
        }
        None => Err(JournalError::None(Some(folder.to_owned()))),
    }
}

/// Opens a journal to be resumed.
fn held(path: &Path) -> Result<Held, JournalError> {
    let failed = |error| JournalError::Read {
        path: path.to_owned(),
        error,
    };
    // Devices and pipes may have no end.
    if !fs::metadata(path).map_err(failed)?.is_file() {
        return Err(JournalError::Format(path.to_owned()));
    }
    let writable = OpenOptions::new().read(true).append(true).open(path);
    let is_writable = writable.is_ok();
    let mut file = writable.or_else(|_| File::open(path)).map_err(failed)?;
    let is_ours = lock(&file).map_err(failed)?;
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(failed)?;
    Ok(Held {
        file,
        is_writable,
        is_ours,
        earlier: Earlier::parse(path, &bytes)?,
    })
}

/// Continues a journal in place if that is possible, or else in a copy.
fn resumed(folder: Option<&Path>, held: Held) -> Opened {
    let Held {
        file,
        is_writable,
        is_ours,
        earlier,
    } = held;
    let name = earlier.path.display().to_string();
    let count = earlier.inputs.len();
    let reason = match &earlier.tail {
        Tail::Damaged { line } => format!(
            "; {name}, line {line}: this record is damaged. What was typed before it, {count} inputs, is resumed; what follows cannot be trusted."
        ),
        _ if !is_ours => format!("; {name} belongs to a running session."),
        Tail::Old => format!("; {name} is of an older planwright."),
        _ if !is_writable => format!("; {name} cannot be written to."),
        Tail::Whole { length, checksum } => {
            match Journal::go_on(file, &earlier.path, *length, checksum.clone()) {
                Ok(journal) => {
                    return Opened {
                        journal: Some(journal),
                        earlier: Some(earlier),
                        remarks: Vec::new(),
                    };
                }
                Err(error) => format!("; {name} cannot be written to: {error}."),
            }
        }
    };
    let (journal, remark) = copied_into(folder, &earlier.beginning, &earlier.inputs);
    Opened {
        journal,
        earlier: Some(earlier),
        remarks: vec![reason, remark],
    }
}

/// A new journal that takes over the inputs, and a remark about it.
pub(crate) fn copied(beginning: &Beginning, inputs: &[Recorded]) -> (Option<Journal>, String) {
    copied_into(folder::folder().as_deref(), beginning, inputs)
}

fn copied_into(
    folder: Option<&Path>,
    beginning: &Beginning,
    inputs: &[Recorded],
) -> (Option<Journal>, String) {
    let (journal, failure) = kept_in(folder, beginning, inputs);
    let remark = match (&journal, failure) {
        (Some(_), Some(failure)) => failure,
        (Some(journal), None) => format!(
            "; It stays as it is; this session is kept in {}.",
            journal.path().display()
        ),
        (None, failure) => failure.unwrap_or_default(),
    };
    (journal, remark)
}

/// A new journal in the folder, or why there is none.
fn kept_in(
    folder: Option<&Path>,
    beginning: &Beginning,
    inputs: &[Recorded],
) -> (Option<Journal>, Option<String>) {
    let Some(folder) = folder else {
        let text =
            "; Nothing typed here is kept: neither XDG_STATE_HOME nor HOME names a folder for it.";
        return (None, Some(text.to_owned()));
    };
    match folder::begin(folder, beginning, inputs) {
        Ok(journal) => {
            let remark = not_yet_kept(&journal);
            (Some(journal), remark)
        }
        Err(error) => (None, Some(not_kept(folder, &error))),
    }
}

/// What is said of a journal for which there is no room.
fn not_yet_kept(journal: &Journal) -> Option<String> {
    let path = journal.path().display();
    journal.is_behind().then(|| {
        format!(
            "; What is typed is not kept: there is no room for {path}. Every input tries again."
        )
    })
}

fn not_kept(path: &Path, reason: &dyn std::fmt::Display) -> String {
    format!(
        "; Nothing typed here is kept: cannot write to {}: {reason}.",
        path.display()
    )
}
