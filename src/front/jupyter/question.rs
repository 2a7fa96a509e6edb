//! Asking the person in front of a notebook for a line.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::Duration;

use serde_json::json;

use super::interrupter::Interrupter;
use super::message::{Author, Request};
use super::zmtp::Socket;

/// How often a wait looks for interrupts.
const LOOK: Duration = Duration::from_millis(20);

/// Asks and waits for answers.
pub(crate) struct Questions {
    /// Where questions are asked.
    pub(super) stdin: Socket,
    /// Where requests come from.
    pub(super) shell: Socket,
    pub(super) author: Arc<Author>,
    /// The answers.
    pub(super) replies: Receiver<Request>,
    pub(super) interrupter: Interrupter,
}

impl Questions {
    /// Asks who has sent a request. `None` if that is interrupted, or if nobody is there who could
    /// answer.
    pub(crate) fn ask(&self, request: &Request, prompt: &str) -> Option<String> {
        // Answers to questions that were given up.
        while self.replies.try_recv().is_ok() {}
        let content = json!({"prompt": prompt, "password": false});
        let question = self
            .author
            .message("input_request", &request.header, &content);
        if !self.stdin.send_to(&request.identity, &question) {
            return None;
        }
        loop {
            match self.replies.recv_timeout(LOOK) {
                Ok(reply) if reply.identity == request.identity => {
                    return Some(reply.text("value").to_owned());
                }
                Ok(_) => {}
                Err(RecvTimeoutError::Timeout) => {
                    if self.interrupter.is_interrupted() || !self.shell.has(request.peer) {
                        return None;
                    }
                }
                Err(RecvTimeoutError::Disconnected) => return None,
            }
        }
    }
}
