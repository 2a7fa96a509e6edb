//! Who may be connected: strangers, who have not shown the secret of a server, such as the random
//! word of the page's address, and guests, who have. However many strangers come, there is room for
//! guests: one stranger too many makes the one leave that has been waiting longest, who has had the
//! time to show the word.

use std::collections::VecDeque;
use std::io;
use std::net::{Shutdown, TcpStream};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

/// Who is connected.
#[derive(Debug)]
pub struct Door {
    max_strangers: usize,
    max_guests: usize,
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
    /// For a server that at most so many strangers, and so many guests besides, may be connected to.
    pub fn new(max_strangers: usize, max_guests: usize) -> Door {
        Door {
            max_strangers,
            max_guests,
            strangers: Mutex::default(),
            guests: AtomicUsize::new(0),
            all: AtomicUsize::new(0),
        }
    }

    /// Admits a stranger; the one that has been waiting longest may have to leave. Waits while
    /// those who have to leave have not left.
    pub fn admit(self: &Arc<Self>, stream: &TcpStream) -> io::Result<Stranger> {
        while self.all.load(Ordering::Relaxed) >= 2 * self.max_strangers + self.max_guests {
            thread::sleep(Duration::from_millis(1));
        }
        let stream = stream.try_clone()?;
        let mut strangers = self.strangers();
        if strangers.waiting.len() >= self.max_strangers
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
pub struct Stranger {
    door: Arc<Door>,
    number: u64,
}

impl Stranger {
    /// The connection has shown the word. `None` if there are too many that have.
    pub fn welcome(&self) -> Option<Guest> {
        self.forget();
        let guest = Guest(Arc::clone(&self.door));
        let others = self.door.guests.fetch_add(1, Ordering::Relaxed);
        (others < self.door.max_guests).then_some(guest)
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
pub struct Guest(Arc<Door>);

impl Drop for Guest {
    fn drop(&mut self) {
        self.0.guests.fetch_sub(1, Ordering::Relaxed);
    }
}
