//! Who may be connected: strangers, who have not shown the random word of the page's address, and
//! guests, who have. However many strangers come, there is room for guests: one stranger too many
//! makes the one leave that has been waiting longest, who has had the time to show the word.

use std::collections::VecDeque;
use std::io;
use std::net::{Shutdown, TcpStream};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

/// Maximum number of strangers.
const MAX_STRANGERS: usize = 128;

/// Maximum number of guests. A page has one lasting connection, and up to five short ones.
const MAX_GUESTS: usize = 96;

/// Who is connected.
#[derive(Debug, Default)]
pub(crate) struct Door {
    strangers: Mutex<Strangers>,
    guests: AtomicUsize,
    /// Number of connections that have not ended, of those who had to leave, too.
    all: AtomicUsize,
}

#[derive(Debug, Default)]
struct Strangers {
    /// With their numbers, in order of arrival.
    waiting: VecDeque<(u64, TcpStream)>,
    last: u64,
}

impl Door {
    /// Admits a stranger; the one that has been waiting longest may have to leave. Waits while
    /// those who have to leave have not left.
    pub(crate) fn admit(self: &Arc<Self>, stream: &TcpStream) -> io::Result<Stranger> {
        while self.all.load(Ordering::Relaxed) >= 2 * MAX_STRANGERS + MAX_GUESTS {
            thread::sleep(Duration::from_millis(1));
        }
        let stream = stream.try_clone()?;
        let mut strangers = self.strangers();
        if strangers.waiting.len() >= MAX_STRANGERS
            && let Some((_, oldest)) = strangers.waiting.pop_front()
        {
            // It may have left by itself.
            let _ = oldest.shutdown(Shutdown::Both);
        }
        strangers.last += 1;
        let number = strangers.last;
        strangers.waiting.push_back((number, stream));
        self.all.fetch_add(1, Ordering::Relaxed);
        Ok(Stranger {
            door: Arc::clone(self),
            number,
        })
    }

    fn strangers(&self) -> MutexGuard<'_, Strangers> {
        // Nothing panics while holding the lock.
        self.strangers
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }
}

/// A connection that has not shown the word.
#[derive(Debug)]
pub(crate) struct Stranger {
    door: Arc<Door>,
    number: u64,
}

impl Stranger {
    /// The connection has shown the word. `None` if there are too many that have.
    pub(super) fn welcome(&self) -> Option<Guest> {
        self.forget();
        let guest = Guest(Arc::clone(&self.door));
        let others = self.door.guests.fetch_add(1, Ordering::Relaxed);
        (others < MAX_GUESTS).then_some(guest)
    }

    fn forget(&self) {
        let mut strangers = self.door.strangers();
        strangers
            .waiting
            .retain(|(number, _)| *number != self.number);
    }
}

impl Drop for Stranger {
    fn drop(&mut self) {
        self.forget();
        self.door.all.fetch_sub(1, Ordering::Relaxed);
    }
}

/// A connection that has shown the word.
#[derive(Debug)]
pub(crate) struct Guest(Arc<Door>);

impl Drop for Guest {
    fn drop(&mut self) {
        self.0.guests.fetch_sub(1, Ordering::Relaxed);
    }
}
