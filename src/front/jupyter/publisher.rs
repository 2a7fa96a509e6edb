//! What all clients see: the state of the kernel, output, values, pictures and errors.
//!
//! Output is collected for a moment, so that a plan that writes many lines does not send as many
//! messages; nothing is dropped. Everything else waits for the output before it.

use std::io;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::message::Author;
use super::zmtp::Socket;

/// How long output is collected.
const COLLECTING: Duration = Duration::from_millis(120);
/// Bytes of output that are sent without waiting for more.
const MUCH: usize = 256 << 10;

/// Publishes to all clients.
pub(crate) struct Publisher {
    socket: Socket,
    author: Arc<Author>,
    collected: Mutex<Collected>,
    changed: Condvar,
}

#[derive(Default)]
struct Collected {
    text: String,
    /// The stream that it belongs to.
    stream: &'static str,
    /// The request that it belongs to.
    parent: Vec<u8>,
    is_over: bool,
}

impl Publisher {
    /// A publisher, with a thread that sends what has been collected.
    pub(crate) fn start(socket: Socket, author: Arc<Author>) -> io::Result<Arc<Publisher>> {
        let publisher = Arc::new(Publisher {
            socket,
            author,
            collected: Mutex::default(),
            changed: Condvar::new(),
        });
        let sending = Arc::clone(&publisher);
        thread::Builder::new().spawn(move || sending.keep_sending())?;
        Ok(publisher)
    }

    fn collected(&self) -> MutexGuard<'_, Collected> {
        // Nothing panics while holding the lock.
        self.collected
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }

    /// Publishes a message that belongs to the request with that header.
    pub(crate) fn publish(&self, kind: &str, parent: &[u8], content: &Value) {
        let mut collected = self.collected();
        self.send_collected(&mut collected);
        self.send(kind, parent, content);
    }

    /// Publishes whether the kernel is busy with that request.
    pub(crate) fn tell_state(&self, parent: &[u8], state: &str) {
        self.publish("status", parent, &json!({"execution_state": state}));
    }

    /// Waits while a client lags far behind, until `is_hurried`. Whoever publishes much does that
    /// before each message.
    pub(crate) fn wait_for_room(&self, is_hurried: impl Fn() -> bool) {
        self.socket.wait_for_room(is_hurried);
    }

    /// Publishes output, soon.
    pub(crate) fn write(&self, stream: &'static str, parent: &[u8], text: &str) {
        if text.is_empty() {
            return;
        }
        let mut collected = self.collected();
        if collected.stream != stream || collected.parent != parent {
            self.send_collected(&mut collected);
            collected.stream = stream;
            parent.clone_into(&mut collected.parent);
        }
        if collected.text.is_empty() {
            self.changed.notify_all();
        }
        collected.text.push_str(text);
        if collected.text.len() > MUCH {
            self.send_collected(&mut collected);
        }
    }

    /// Takes back the line of a request's output that is not ended yet, if it has not been published.
    pub(crate) fn take_unfinished_line(&self, parent: &[u8]) -> String {
        let mut collected = self.collected();
        if collected.parent != parent {
            return String::new();
        }
        let line = collected.text.rfind('\n').map_or(0, |at| at + 1);
        collected.text.split_off(line)
    }

    /// Publishes the output that has been collected.
    pub(crate) fn flush(&self) {
        self.send_collected(&mut self.collected());
    }

    /// A name for something that can be shown again.
    pub(crate) fn display_id(&self) -> String {
        self.author.display_id()
    }

    /// Sends everything, at the latest by a moment, and then nothing more.
    pub(crate) fn end(&self, until: Instant) {
        {
            let mut collected = self.collected();
            self.send_collected(&mut collected);
            collected.is_over = true;
            self.changed.notify_all();
        }
        self.socket.drain(until);
    }

    fn send(&self, kind: &str, parent: &[u8], content: &Value) {
        let mut frames = vec![self.author.topic(kind)];
        frames.extend(self.author.message(kind, parent, content));
        self.socket.publish(&frames);
    }

    fn send_collected(&self, collected: &mut Collected) {
        if !collected.text.is_empty() {
            let text = std::mem::take(&mut collected.text);
            let content = json!({"name": collected.stream, "text": text});
            self.send("stream", &collected.parent, &content);
        }
    }

    fn keep_sending(&self) {
        let mut collected = self.collected();
        while !collected.is_over {
            if collected.text.is_empty() {
                let woken = self.changed.wait(collected);
                collected = woken.unwrap_or_else(PoisonError::into_inner);
                continue;
            }
            drop(collected);
            thread::sleep(COLLECTING);
            collected = self.collected();
            self.send_collected(&mut collected);
        }
    }
}
