//! The terminal itself, where the line editor does not do what is needed.

use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// Width of a terminal that does not tell its own.
pub(super) const USUAL_COLUMNS: usize = 80;

/// How long it may take until the process stands still after it has been told to.
const UNTIL_STOPPED: Duration = Duration::from_millis(500);
const POLL: Duration = Duration::from_millis(2);

/// The modes of a terminal outside the line editor.
#[cfg(unix)]
#[derive(Clone)]
pub(super) struct Modes {
    usual: rustix::termios::Termios,
    is_continued: Arc<AtomicBool>,
}

#[cfg(unix)]
impl Modes {
    /// Those of standard input as they are now.
    pub(super) fn now() -> Option<Modes> {
        let is_continued = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&is_continued);
        signal_hook::flag::register(signal_hook::consts::SIGCONT, flag).ok()?;
        Some(Modes {
            usual: rustix::termios::tcgetattr(io::stdin()).ok()?,
            is_continued,
        })
    }

    /// Stops the process and its group, as Ctrl-Z does, with a terminal that others can use;
    /// returns when it goes on. Other threads of the process may be told first, so this waits.
    pub(super) fn suspend(&self) -> io::Result<()> {
        use rustix::process::{Signal, getpgrp, kill_process_group};
        use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

        let raw = tcgetattr(io::stdin())?;
        let mut out = io::stdout();
        out.write_all(PASTE_OFF)?;
        out.flush()?;
        tcsetattr(io::stdin(), OptionalActions::Drain, &self.usual)?;
        self.is_continued.store(false, Ordering::SeqCst);
        kill_process_group(getpgrp(), Signal::TSTP)?;
        let begin = Instant::now();
        while !self.is_continued.load(Ordering::SeqCst) && begin.elapsed() < UNTIL_STOPPED {
            thread::sleep(POLL);
        }
        tcsetattr(io::stdin(), OptionalActions::Drain, &raw)?;
        out.write_all(PASTE_ON)?;
        out.flush()
    }
}

const PASTE_OFF: &[u8] = b"\x1b[?2004l";
const PASTE_ON: &[u8] = b"\x1b[?2004h";

/// Width of the terminal that is written to.
#[cfg(unix)]
pub(super) fn columns() -> usize {
    let size = rustix::termios::tcgetwinsize(io::stdout());
    let columns = size.map_or(0, |size| usize::from(size.ws_col));
    if columns == 0 { USUAL_COLUMNS } else { columns }
}

/// Whether something has been typed that nobody has read; waits for it that long.
#[cfg(unix)]
pub(super) fn has_input(within: Duration) -> bool {
    use rustix::event::{PollFd, PollFlags, Timespec, poll};

    let stdin = io::stdin();
    let mut waited = [PollFd::new(&stdin, PollFlags::IN)];
    let Ok(time) = Timespec::try_from(within) else {
        return false;
    };
    poll(&mut waited, Some(&time)).is_ok_and(|count| count > 0)
        && waited.iter().any(|fd| fd.revents().contains(PollFlags::IN))
}

/// Whether a terminal lays its lines out anew when its width changes, as almost all do.
pub(super) fn reflows() -> bool {
    let variable = |name| std::env::var(name).unwrap_or_default();
    let kind = variable("TERM");
    let is_old = ["linux", "st", "st-", "vt", "screen"]
        .iter()
        .any(|old| kind == *old || kind.starts_with(&format!("{}-", old.trim_end_matches('-'))));
    let is_within_tmux = !variable("TMUX").is_empty();
    is_within_tmux || !is_old && variable("XTERM_VERSION").is_empty()
}
