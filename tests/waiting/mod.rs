//! Waiting for what happens in other threads.

use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

/// How long anything may take on a busy machine.
const PATIENCE: Duration = Duration::from_secs(120);
/// How often it is looked at.
const POLL: Duration = Duration::from_millis(2);

/// What is there as soon as it is there.
pub(super) fn wait_for<T>(what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let begin = Instant::now();
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(begin.elapsed() < PATIENCE, "waited for {what}");
        thread::sleep(POLL);
    }
}

/// The name of a file that a test's program will write, and which is not there yet.
pub(super) fn file_to_come(name: &str) -> PathBuf {
    let path = super::scratch_folder().join(name);
    // What a process with the same number left behind.
    let _ = std::fs::remove_file(&path);
    path
}

/// Waits until a program has written a file.
pub(super) fn wait_for_file(path: &Path) {
    wait_for("a file", || path.exists().then_some(()));
}
