//! Questions to a client: texts that it is asked to type.

use std::cell::{Cell, RefCell};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::hub::{Client, Hub};
use super::sexp::Sexp;
use session::dialogue::ShownAhead;

/// The number of the session's thread.
pub(super) const THREAD: Sexp = Sexp::Int(1);

/// Asks the client for which the session evaluates.
pub(super) struct Questions {
    hub: Arc<Hub>,
    interrupt: Arc<AtomicBool>,
    client: RefCell<Option<Arc<Client>>>,
    ahead: ShownAhead,
    tags: Cell<i64>,
}

impl Questions {
    pub(super) fn new(hub: Arc<Hub>, interrupt: Arc<AtomicBool>) -> Questions {
        Questions {
            hub,
            interrupt,
            client: RefCell::new(None),
            ahead: ShownAhead::default(),
            tags: Cell::new(0),
        }
    }

    /// Sets the client that is asked.
    pub(super) fn set_client(&self, client: Option<Arc<Client>>) {
        self.client.replace(client);
        self.ahead.reset();
    }

    /// A number for a question.
    pub(super) fn next_tag(&self) -> i64 {
        self.tags.set(self.tags.get() + 1);
        self.tags.get()
    }

    /// Asks for a text, after what the program has written; waits for it. `None` if there is nobody to
    /// ask, or if that is interrupted.
    pub(super) fn ask(&self, written: &str) -> Option<String> {
        let client = self.client.borrow().clone()?;
        client
            .outbox
            .write(self.ahead.show(written), &self.interrupt);
        let tag = self.next_tag();
        let message = |kind: &str| Sexp::list([Sexp::symbol(kind), THREAD, Sexp::Int(tag)]);
        client.outbox.send(&message(":read-string"));
        let typed = self.hub.wait_for_text(client.number, tag);
        if typed.is_none() {
            client.outbox.send(&message(":read-aborted"));
        }
        typed
    }

    /// The part of an output that the client has not seen with a question.
    pub(super) fn unseen<'t>(&self, output: &'t str) -> &'t str {
        self.ahead.unseen(output)
    }
}
