//! How far a sweep has got, on standard error.

use std::io::{self, IsTerminal, Write};
use std::time::Instant;

use lisp::visible::visible;
use sweep::Record;
use sweep::summary::Title;

/// Width of the bar.
const WIDTH: u64 = 30;

/// How far a sweep has got: a bar in a terminal, else a line for each tenth.
pub(super) struct Progress {
    name: String,
    count: u64,
    begun: Instant,
    done: u64,
    tried: u64,
    worked: u64,
    is_terminal: bool,
}

impl Progress {
    pub(super) fn new(title: &Title, count: u64) -> Self {
        Self {
            name: visible(&title.name).into_owned(),
            count,
            begun: Instant::now(),
            done: 0,
            tried: 0,
            worked: 0,
            is_terminal: io::stderr().is_terminal(),
        }
    }

    /// One more world is done.
    pub(super) fn record(&mut self, record: &Record) {
        let share =
            |done: u64, of: u64| u128::from(done) * u128::from(of) / u128::from(self.count.max(1));
        let tenth = |done: u64| share(done, 10);
        let before = tenth(self.done);
        self.done += 1;
        self.tried += u64::from(record.outcome.counts());
        self.worked += u64::from(record.is_success());
        let is_new = tenth(self.done) > before;
        // If standard error is closed, nobody wants to know.
        if self.is_terminal {
            let filled = share(self.done, WIDTH) as usize;
            let bar = "█".repeat(filled) + &"░".repeat(WIDTH as usize - filled);
            let _ = write!(io::stderr(), "\r{bar} {}\x1b[K", self.text());
        } else if is_new && self.count >= 10 {
            let _ = writeln!(io::stderr(), "{}: {}", self.name, self.text());
        }
    }

    fn text(&self) -> String {
        let rate = 100.0 * self.worked as f64 / self.tried.max(1) as f64;
        let passed = self.begun.elapsed().as_secs_f64();
        let left = passed / self.done as f64 * self.count.saturating_sub(self.done) as f64;
        let (done, count) = (self.done, self.count);
        format!("{done}/{count} worlds, {rate:.1} % successful, {left:.0} s left")
    }

    /// Removes the bar.
    pub(super) fn end(&self) {
        if self.is_terminal {
            let _ = write!(io::stderr(), "\r\x1b[K");
        }
    }
}
