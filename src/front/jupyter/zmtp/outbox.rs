//! What waits to be sent to a peer.

use std::collections::VecDeque;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// A queue of encoded messages; the newest go behind.
#[derive(Debug, Default)]
pub(super) struct Outbox {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct State {
    waiting: VecDeque<Arc<[u8]>>,
    /// Bytes that wait or are being sent.
    bytes: usize,
    is_closed: bool,
}

impl Outbox {
    fn state(&self) -> MutexGuard<'_, State> {
        // Nothing panics while holding the lock.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Appends a message; one for a closed outbox is lost.
    pub(super) fn push(&self, message: Arc<[u8]>) {
        let mut state = self.state();
        if !state.is_closed {
            state.bytes += message.len();
            state.waiting.push_back(message);
            self.changed.notify_all();
        }
    }

    /// The next message, as soon as there is one; `None` if the outbox has been closed.
    pub(super) fn next(&self) -> Option<Arc<[u8]>> {
        let mut state = self.state();
        loop {
            if state.is_closed {
                return None;
            }
            if let Some(message) = state.waiting.pop_front() {
                return Some(message);
            }
            let woken = self.changed.wait(state);
            state = woken.unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Notes that a message has been sent.
    pub(super) fn sent(&self, bytes: usize) {
        let mut state = self.state();
        state.bytes = state.bytes.saturating_sub(bytes);
        self.changed.notify_all();
    }

    /// Forgets what waits, and takes no more.
    pub(super) fn close(&self) {
        let mut state = self.state();
        state.is_closed = true;
        state.waiting.clear();
        state.bytes = 0;
        self.changed.notify_all();
    }

    /// Bytes that have not been sent.
    pub(super) fn bytes(&self) -> usize {
        self.state().bytes
    }

    /// Waits until at most that many bytes have not been sent, or until `moment`, or for the next
    /// change; returns how many there are then.
    pub(super) fn wait(&self, enough: usize, moment: Instant) -> usize {
        let state = self.state();
        let left = moment.saturating_duration_since(Instant::now());
        if state.bytes <= enough || left == Duration::ZERO {
            return state.bytes;
        }
        match self.changed.wait_timeout(state, left) {
            Ok((state, _)) => state.bytes,
            Err(poisoned) => poisoned.into_inner().0.bytes,
        }
    }
}
