//! A thread that works for as long as somebody has it.

use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::{self, JoinHandle};

use super::node::{Node, NodeError};

/// The thread, which ends when this is dropped.
pub(super) struct Background {
    stop: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Background {
    /// Starts a thread for a node. It ends when what it is given has no sender any more.
    ///
    /// # Errors
    ///
    /// If the system has no thread to give.
    pub(super) fn start(
        node: &Node,
        name: &str,
        run: impl FnOnce(&Receiver<()>) + Send + 'static,
    ) -> Result<Self, NodeError> {
        let (stop, stopped) = channel();
        let thread = thread::Builder::new().name(name.to_owned());
        let thread = thread.spawn(move || run(&stopped));
        let thread = thread.map_err(|error| NodeError::Start {
            reach: node.reach(),
            cause: error.to_string(),
        })?;
        Ok(Self {
            stop: Some(stop),
            thread: Some(thread),
        })
    }
}

impl Drop for Background {
    fn drop(&mut self) {
        drop(self.stop.take());
        if let Some(thread) = self.thread.take() {
            // What it could not do is lost in any case.
            drop(thread.join());
        }
    }
}
