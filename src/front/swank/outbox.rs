//! What is sent to a client: a queue that a thread of its own writes, so that a client that does
//! not read holds nobody up for long.
//!
//! Output of programs is collected for a few hundredths of a second and sent as one message.

use std::collections::VecDeque;
use std::io::Write;
use std::net::{Shutdown, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::framing::{LONGEST, framed};
use super::sexp::Sexp;

/// How long output is collected.
const COLLECTING: Duration = Duration::from_millis(40);
/// Bytes that may wait before output has to wait, too.
const MAX_WAITING: usize = 256 << 10;
/// Bytes of output in one message.
const MAX_TOGETHER: usize = 32 << 10;
/// How long a client may read nothing at all while something waits for it.
const PATIENCE: Duration = Duration::from_secs(30);
/// How often somebody who waits for room looks whether that is still worthwhile.
const LOOKING: Duration = Duration::from_millis(10);

/// What waits to be sent to a client.
pub(super) struct Outbox {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    waiting: VecDeque<Vec<u8>>,
    /// Number of bytes that wait, without the collected output.
    bytes: usize,
    /// Output that is being collected, and since when.
    text: String,
    since: Option<Instant>,
    /// Nothing more is accepted; what waits is still sent.
    is_ending: bool,
    /// Nothing is sent any more.
    is_closed: bool,
}

impl Outbox {
    /// An outbox with the thread that sends what it gets.
    pub(super) fn open(stream: TcpStream) -> std::io::Result<Arc<Outbox>> {
        stream.set_write_timeout(Some(PATIENCE))?;
        let outbox = Arc::new(Outbox {
            state: Mutex::default(),
            changed: Condvar::new(),
        });
        let own = Arc::clone(&outbox);
        thread::Builder::new()
            .name("swank output".to_owned())
            .spawn(move || own.send_all(stream))?;
        Ok(outbox)
    }

    /// Sends a message after everything before it.
    pub(super) fn send(&self, message: &Sexp) {
        let bytes = framed(&message.to_string());
        let mut state = self.lock();
        if state.is_ending || state.is_closed {
            return;
        }
        state.text_to_message();
        match bytes {
            Some(bytes) => state.push(bytes),
            None => state.push_too_long(message),
        }
        self.changed.notify_all();
    }

    /// Sends output of a program. If much waits already, this waits, too, unless the program is
    /// to be interrupted; then the output is left out.
    pub(super) fn write(&self, text: &str, interrupt: &AtomicBool) {
        let mut state = self.lock();
        while state.bytes + state.text.len() > MAX_WAITING {
            if state.is_closed || interrupt.load(Ordering::Relaxed) {
                return;
            }
            let waited = self.changed.wait_timeout(state, LOOKING);
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
        if state.is_ending || state.is_closed {
            return;
        }
        state.since.get_or_insert_with(Instant::now);
        state.text.push_str(text);
        if state.text.len() > MAX_TOGETHER {
            state.text_to_message();
        }
        self.changed.notify_all();
    }

    /// Ends the connection once everything has been sent.
    pub(super) fn end(&self) {
        let mut state = self.lock();
        state.text_to_message();
        state.is_ending = true;
        self.changed.notify_all();
    }

    /// Waits until the connection has ended, but not longer than that.
    pub(super) fn wait_for_end(&self, longest: Duration) {
        let until = Instant::now() + longest;
        let mut state = self.lock();
        while !state.is_closed && Instant::now() < until {
            let waited = self.changed.wait_timeout(state, LOOKING);
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The work of the thread.
    fn send_all(&self, mut stream: TcpStream) {
        while let Some(bytes) = self.next() {
            let sent = stream.write_all(&bytes);
            let mut state = self.lock();
            state.bytes -= bytes.len();
            if sent.is_err() {
                break;
            }
            self.changed.notify_all();
        }
        let mut state = self.lock();
        state.is_closed = true;
        state.waiting.clear();
        state.bytes = 0;
        self.changed.notify_all();
        drop(state);
        // This ends the thread that reads from the connection, too; it may be closed already.
        let _ = stream.shutdown(Shutdown::Both);
    }

    /// The next message; `None` at the end.
    fn next(&self) -> Option<Vec<u8>> {
        let mut state = self.lock();
        loop {
            if let Some(bytes) = state.waiting.pop_front() {
                return Some(bytes);
            }
            if state.is_ending {
                return None;
            }
            let collected = state.since.map(|since| since.elapsed());
            let waited = match collected {
                Some(long) if long >= COLLECTING => {
                    state.text_to_message();
                    continue;
                }
                Some(long) => {
                    let waited = self.changed.wait_timeout(state, COLLECTING - long);
                    waited.unwrap_or_else(PoisonError::into_inner).0
                }
                None => {
                    let waited = self.changed.wait(state);
                    waited.unwrap_or_else(PoisonError::into_inner)
                }
            };
            state = waited;
        }
    }
}

impl State {
    fn push(&mut self, bytes: Vec<u8>) {
        self.bytes += bytes.len();
        self.waiting.push_back(bytes);
    }

    /// Makes messages of the collected output.
    fn text_to_message(&mut self) {
        self.since = None;
        let text = std::mem::take(&mut self.text);
        let mut rest = text.as_str();
        while !rest.is_empty() {
            // Escapes at most double the length.
            let longest = rest.len().min(LONGEST / 4);
            let mut ends = (1..=longest).rev();
            let end = ends.find(|end| rest.is_char_boundary(*end));
            let (part, after) = rest.split_at(end.unwrap_or(rest.len()));
            rest = after;
            let message = Sexp::list([Sexp::symbol(":write-string"), part.into()]);
            if let Some(bytes) = framed(&message.to_string()) {
                self.push(bytes);
            }
        }
    }

    /// In place of a message that is longer than messages can be: a request still gets an answer.
    fn push_too_long(&mut self, message: &Sexp) {
        let shorter = match message.items() {
            [Sexp::Symbol(kind), _, id] if kind == ":return" => {
                let told = Sexp::list([
                    Sexp::symbol(":abort"),
                    "The answer is longer than 16 MB.".into(),
                ]);
                Sexp::list([Sexp::symbol(":return"), told, id.clone()])
            }
            _ => Sexp::list([
                Sexp::symbol(":write-string"),
                "; More than 16 MB were left out.\n".into(),
            ]),
        };
        if let Some(bytes) = framed(&shorter.to_string()) {
            self.push(bytes);
        }
    }
}
