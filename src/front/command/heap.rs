//! The limit to the memory in use.

use std::fs;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use lisp::guard::heap::HeapLimit;

/// How to learn how many bytes are in use; not known where planwright is embedded.
static IN_USE: OnceLock<fn() -> usize> = OnceLock::new();

/// The limit where the machine does not tell how much memory it has.
const USUAL: usize = 4 << 30;

/// The limit of sessions.
static LIMIT: AtomicUsize = AtomicUsize::new(usize::MAX);

/// The bytes in use that no session has asked for.
static BESIDE: AtomicUsize = AtomicUsize::new(0);

/// Sets how to learn how many bytes are in use.
pub(super) fn count_by(in_use: fn() -> usize) {
    // Called once, at the start of the process.
    let _ = IN_USE.set(in_use);
}

/// The limit to the memory in use: the given one, or half of what this process can have.
pub(super) fn limit(bytes: Option<usize>) -> Option<HeapLimit> {
    IN_USE.get()?;
    let bytes = bytes.unwrap_or_else(|| available().map_or(USUAL, |all| all / 2));
    LIMIT.store(bytes, Ordering::Relaxed);
    Some(HeapLimit {
        bytes,
        in_use: in_use_by_sessions,
    })
}

fn in_use_by_sessions() -> usize {
    let all = IN_USE.get().map_or(0, |in_use| in_use());
    all.saturating_sub(BESIDE.load(Ordering::Relaxed))
}

/// Memory for what is kept of sessions, such as the records of a sweep: it does not count against
/// their limit, or their number would decide what they can do. It may be as much as one of them may
/// have.
#[derive(Default)]
pub(super) struct Beside(usize);

impl Beside {
    /// So many bytes more are kept. Returns whether that may go on.
    pub(super) fn keep(&mut self, bytes: usize) -> bool {
        self.0 += bytes;
        let all = BESIDE.fetch_add(bytes, Ordering::Relaxed) + bytes;
        all < LIMIT.load(Ordering::Relaxed)
    }
}

impl Drop for Beside {
    fn drop(&mut self) {
        BESIDE.fetch_sub(self.0, Ordering::Relaxed);
    }
}

/// The bytes of memory that this process can have, if the system tells: those of the machine, of
/// its control group or of its address space, whichever are fewest.
fn available() -> Option<usize> {
    let machine = number_in("/proc/meminfo", "MemTotal:").map(|kilobytes| kilobytes * 1024);
    let group = number_in("/sys/fs/cgroup/memory.max", "");
    let space = number_in("/proc/self/limits", "Max address space");
    [machine, group, space].into_iter().flatten().min()
}

/// The number behind a label at the start of a line of a file.
fn number_in(path: &str, label: &str) -> Option<usize> {
    let text = fs::read_to_string(path).ok()?;
    let rest = text.lines().find_map(|line| line.strip_prefix(label))?;
    rest.split_whitespace().next()?.parse().ok()
}

/// The bytes that an argument says: a number, with K, M or G behind it if need be.
pub(super) fn bytes(text: &str) -> Result<usize, String> {
    let wrong = || "expected a number of bytes, such as 500M or 2G".to_owned();
    let (number, unit) = match text.to_ascii_uppercase().trim_end_matches('B') {
        text if text.ends_with('K') => (text.trim_end_matches('K').to_owned(), 1 << 10),
        text if text.ends_with('M') => (text.trim_end_matches('M').to_owned(), 1 << 20),
        text if text.ends_with('G') => (text.trim_end_matches('G').to_owned(), 1 << 30),
        text => (text.to_owned(), 1),
    };
    let number: usize = number.trim().parse().map_err(|_| wrong())?;
    let bytes = number.checked_mul(unit).ok_or_else(wrong)?;
    if bytes < LEAST {
        return Err(format!(
            "the least that a session works with is {}M",
            LEAST >> 20
        ));
    }
    Ok(bytes)
}

/// The smallest limit: a session with its world takes a third of that.
const LEAST: usize = 32 << 20;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_units() {
        assert_eq!(bytes("500M"), Ok(500 << 20));
        assert_eq!(bytes("2g"), Ok(2 << 30));
        assert_eq!(bytes("64MB"), Ok(64 << 20));
        assert_eq!(bytes("100000000"), Ok(100_000_000));
        for wrong in ["", "M", "-1G", "1.5G", "99999999999999999999", "1K", "2T"] {
            assert!(bytes(wrong).is_err(), "{wrong}");
        }
    }
}
