//! Services that others offer, as Cyclone's middleware of ROS 2 carries them.

use std::cell::{Cell, RefCell};
use std::sync::Arc;

use rustdds::no_key::{DataWriter, SimpleDataReader};

use super::matches::{reads, writes};
use super::payload::{AsBytes, Payload};
use super::service::HEADER;
use crate::cdr::{ByteOrder, decode, encode};
use crate::layout::Layouts;
use crate::value::Value;

/// Which request of a client.
pub type Sequence = u64;

/// An answer to a request of this client.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// It has been answered.
    To(Sequence, Value),
    /// Something was answered that cannot be read.
    Unreadable(Sequence),
    /// Something was answered that nobody of this client has asked.
    ToNobody,
}

/// A service that others offer.
pub struct ServiceClient {
    pub(super) layouts: Arc<Layouts>,
    pub(super) request: String,
    pub(super) response: String,
    pub(super) requests: DataWriter<Payload, AsBytes>,
    pub(super) replies: SimpleDataReader<Payload, AsBytes>,
    /// What identifies this client among all.
    pub(super) identity: [u8; 8],
    pub(super) next: Cell<Sequence>,
    /// Requests without an answer.
    pub(super) pending: RefCell<Vec<Sequence>>,
    /// How many read the requests, and write the replies.
    pub(super) matched: Cell<[i32; 2]>,
}

/// Maximum number of requests that wait for an answer; of more, the oldest are given up.
const MAX_PENDING: usize = 256;

impl ServiceClient {
    /// Whether somebody serves it: who hears requests, and whom replies come from. A request before that is lost.
    pub fn is_served(&self) -> bool {
        self.servers() > 0
    }

    /// How many serve it, as far as is known: who both hear requests and reply.
    pub fn servers(&self) -> usize {
        let [mut readers, mut writers] = self.matched.get();
        readers = reads(&self.requests).unwrap_or(readers);
        writers = writes(&self.replies).unwrap_or(writers);
        self.matched.set([readers, writers]);
        // Several that are not whole are several still.
        match readers.min(writers) {
            none if none <= 0 => 0,
            _ => usize::try_from(readers.max(writers)).unwrap_or(0),
        }
    }

    /// Sends a request; `None` if it cannot be sent.
    pub fn ask(&self, request: &Value) -> Option<Sequence> {
        let body = encode(&self.layouts, &self.request, request).ok()?;
        let sequence = self.next.get();
        self.next.set(sequence + 1);
        let bytes = [&self.identity[..], &sequence.to_le_bytes(), &body].concat();
        self.requests.write(Payload::new(bytes), None).ok()?;
        let mut pending = self.pending.borrow_mut();
        pending.push(sequence);
        if pending.len() > MAX_PENDING {
            pending.remove(0);
        }
        Some(sequence)
    }

    /// The next answer, if there is one. What answers other clients is passed over.
    pub fn take(&self) -> Option<Answer> {
        self.replies.drain_read_notifications();
        while let Ok(Some(sample)) = self.replies.try_take_one() {
            if let Some(answer) = self.read(&sample.sample) {
                return Some(answer);
            }
        }
        None
    }

    fn read(&self, payload: &Payload) -> Option<Answer> {
        let (header, body) = payload.bytes.split_at_checked(HEADER)?;
        let (identity, sequence) = header.split_at_checked(8)?;
        let mut identity: [u8; 8] = identity.try_into().ok()?;
        let mut sequence: [u8; 8] = sequence.try_into().ok()?;
        if payload.order == ByteOrder::Big {
            identity.reverse();
            sequence.reverse();
        }
        if identity != self.identity {
            return None;
        }
        let sequence = Sequence::from_le_bytes(sequence);
        let mut pending = self.pending.borrow_mut();
        let Some(place) = pending.iter().position(|known| *known == sequence) else {
            return Some(Answer::ToNobody);
        };
        pending.remove(place);
        let answer = decode(&self.layouts, &self.response, body, payload.order);
        Some(match answer {
            Ok(answer) => Answer::To(sequence, answer),
            Err(_) => Answer::Unreadable(sequence),
        })
    }
}
