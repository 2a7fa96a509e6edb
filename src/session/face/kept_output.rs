//! What is printed, as much of it as is to be kept.

use std::cell::RefCell;
use std::rc::Rc;

/// The beginning of what a session has printed; see [`Session::keep_output`](crate::Session::keep_output).
/// Clones share it.
#[derive(Clone, Debug)]
pub struct KeptOutput {
    state: Rc<RefCell<State>>,
    max_bytes: usize,
}

#[derive(Debug)]
struct State {
    text: String,
    /// How many more characters are kept.
    room: usize,
    /// How many bytes have been printed.
    bytes: usize,
}

impl KeptOutput {
    pub(super) fn new(characters: usize, max_bytes: usize) -> Self {
        let state = State {
            text: String::new(),
            room: characters,
            bytes: 0,
        };
        Self {
            state: Rc::new(RefCell::new(state)),
            max_bytes,
        }
    }

    pub(super) fn add(&self, text: &str) {
        let state = &mut *self.state.borrow_mut();
        state.bytes = state.bytes.saturating_add(text.len());
        for c in text.chars().take(state.room) {
            state.text.push(c);
            state.room -= 1;
        }
    }

    /// What has been kept; nothing of it is left.
    pub fn take(&self) -> String {
        std::mem::take(&mut self.state.borrow_mut().text)
    }

    /// Whether more bytes have been printed than may be.
    pub fn is_too_long(&self) -> bool {
        self.state.borrow().bytes > self.max_bytes
    }
}
