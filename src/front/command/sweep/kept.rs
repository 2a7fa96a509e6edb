//! The memory of the records of a sweep, of which there may be more than it can hold.

use std::io::{self, Write};

use crate::command::heap::Beside;
use sweep::Record;

/// The memory of records that are kept. No world has less of it for them.
#[derive(Default)]
pub(super) struct Kept {
    memory: Beside,
    count: u64,
    is_full: bool,
}

impl Kept {
    /// One more record is kept. Returns whether there is room for others.
    pub(super) fn keep(&mut self, record: &Record) -> bool {
        self.count += 1;
        self.is_full |= !self.memory.keep(record.bytes());
        !self.is_full
    }

    /// Says why the sweep ends before all worlds have been run, if there is no room for others.
    pub(super) fn tell_if_full(&self) {
        if self.is_full {
            // If standard error is closed, nobody wants to know.
            let _ = writeln!(
                io::stderr(),
                "{} records take as much memory as --heap allows: a larger one is needed for more \
                 worlds, or --into FOLDER with more --shards",
                self.count
            );
        }
    }
}
