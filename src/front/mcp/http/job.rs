//! What passes between the connections and the thread that has the sessions.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::sync::mpsc::SyncSender;

use serde_json::Value;

pub(super) const JSON: &str = "application/json";
const TEXT: &str = "text/plain; charset=utf-8";

/// What a client asks for.
pub(super) struct Job {
    /// The session that it names.
    pub(super) session: Option<String>,
    pub(super) what: Asked,
    /// Has the client gone?
    pub(super) is_gone: Arc<AtomicBool>,
    pub(super) reply: SyncSender<Reply>,
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
