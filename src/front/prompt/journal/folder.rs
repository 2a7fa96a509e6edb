//! The folder in which journals are kept by default.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use super::super::history::state_directory;
use super::writing::{Journal, lock};
use super::{Beginning, Recorded};

/// Number of journals that are always kept.
const MAX_JOURNALS: usize = 20;
/// Journals that were written to within this time are always kept: two weeks.
const KEPT_FOR: Duration = Duration::from_secs(14 * 24 * 60 * 60);
const EXTENSION: &str = "journal";

/// The folder; `None` if there is no place for it.
pub(super) fn folder() -> Option<PathBuf> {
    Some(state_directory()?.join("journals"))
}

/// The journals in a folder, oldest first.
pub(super) fn journals(folder: &Path) -> Vec<PathBuf> {
    aged(folder).into_iter().map(|(_, path)| path).collect()
}

fn aged(folder: &Path) -> Vec<(SystemTime, PathBuf)> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut found: Vec<(SystemTime, PathBuf)> = entries
        .filter(|entry| entry.path().extension().is_some_and(|e| e == EXTENSION))
        .filter_map(|entry| Some((entry.metadata().ok()?.modified().ok()?, entry.path())))
        .collect();
    found.sort();
    found
}

/// A new journal in the folder, with inputs that it takes over.
pub(super) fn begin(
    folder: &Path,
    beginning: &Beginning,
    inputs: &[Recorded],
) -> io::Result<Journal> {
    fs::create_dir_all(folder)?;
    forget_old(folder, SystemTime::now());
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    let seconds = since.map_or(0, |since| since.as_secs());
    let process = std::process::id();
    let mut copy = 0;
    loop {
        // In containers that share a folder, processes may have the same number.
        let name = match copy {
            0 => format!("{seconds}-{process}.{EXTENSION}"),
            copy => format!("{seconds}-{process}-{copy}.{EXTENSION}"),
        };
        match Journal::create(&folder.join(name), beginning, inputs) {
            Err(error)
                if matches!(
                    error.kind(),
                    io::ErrorKind::AlreadyExists | io::ErrorKind::ResourceBusy
                ) =>
            {
                copy += 1;
            }
            result => return result,
        }
    }
}

/// Removes old journals if there are too many, but none of a running session.
pub(super) fn forget_old(folder: &Path, now: SystemTime) {
    let known = aged(folder);
    let too_many = (known.len() + 1).saturating_sub(MAX_JOURNALS);
    for (written, path) in known.into_iter().take(too_many) {
        let is_old = now.duration_since(written).is_ok_and(|age| age > KEPT_FOR);
        if !is_old {
            break;
        }
        let Ok(file) = File::open(&path) else {
            continue;
        };
        if lock(&file).unwrap_or(false) {
            // Files that cannot be removed do no harm.
            let _ = fs::remove_file(&path);
            let _ = fs::remove_file(tape_beside(&path));
        }
    }
}

/// A file that earlier versions kept beside a journal.
fn tape_beside(journal: &Path) -> PathBuf {
    let mut name = journal.as_os_str().to_owned();
    name.push(".tape");
    PathBuf::from(name)
}
