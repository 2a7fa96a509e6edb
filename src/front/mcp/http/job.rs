//! What passes between the connections and the threads that have the sessions.

use std::io;
use std::net::TcpStream;
use std::sync::mpsc::SyncSender;
use std::sync::{Arc, Mutex, PoisonError};

use serde_json::Value;

pub(super) const JSON: &str = "application/json";
const TEXT: &str = "text/plain; charset=utf-8";

/// What a client asks for.
pub(super) struct Job {
    /// The session that it names.
    pub(super) session: Option<String>,
    pub(super) what: Asked,
    pub(super) client: Arc<Client>,
    pub(super) reply: SyncSender<Reply>,
}

impl Job {
    /// The message of the protocol, if it is one.
    pub(super) fn message(&self) -> Option<&[u8]> {
        match &self.what {
            Asked::Message(message) => Some(message),
            Asked::End => None,
        }
    }

    /// Answers it, which ends it: as long as there is a job, its connection stays open. Who has gone meanwhile gets no
    /// answer.
    pub(super) fn answer(self, reply: Reply) {
        let _ = self.reply.send(reply);
    }
}

/// Who waits for an answer, at the other end of a connection.
pub(super) struct Client(Mutex<TcpStream>);

impl Client {
    pub(super) fn of(stream: &TcpStream) -> io::Result<Client> {
        Ok(Client(Mutex::new(stream.try_clone()?)))
    }

    /// Whether the connection has been closed. Nothing else may be done with it meanwhile.
    pub(super) fn has_gone(&self) -> bool {
        let stream = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if stream.set_nonblocking(true).is_err() {
            return true;
        }
        let peeked = stream.peek(&mut [0]);
        let is_blocking = stream.set_nonblocking(false).is_ok();
        match peeked {
            Ok(count) => count == 0,
            Err(error) => error.kind() != io::ErrorKind::WouldBlock || !is_blocking,
        }
    }
}

pub(super) enum Asked {
    /// A message of the protocol.
    Message(Vec<u8>),
    /// The session is to end.
    End,
}

/// What a client gets.
pub(super) struct Reply {
    pub(super) status: &'static str,
    pub(super) kind: &'static str,
    pub(super) headers: String,
    pub(super) content: String,
}

impl Reply {
    pub(super) fn json(status: &'static str, content: &Value) -> Reply {
        Reply {
            status,
            kind: JSON,
            headers: String::new(),
            content: content.to_string(),
        }
    }

    pub(super) fn text(status: &'static str, content: &str) -> Reply {
        Reply {
            status,
            kind: TEXT,
            headers: String::new(),
            content: format!("{content}\n"),
        }
    }

    pub(super) fn nothing(status: &'static str) -> Reply {
        Reply {
            content: String::new(),
            ..Reply::text(status, "")
        }
    }
}
