//! Services that a node offers, as Cyclone's middleware of ROS 2 carries them: before each request and each reply
//! stand 16 bytes that tell whose request it is, and which.

use std::sync::Arc;

use rustdds::no_key::{DataWriter, SimpleDataReader};

use super::payload::{AsBytes, Payload};
use crate::cdr::{ByteOrder, decode, encode};
use crate::layout::Layouts;
use crate::value::Value;

/// Length of what identifies a request.
pub(super) const HEADER: usize = 16;

/// Whose request it is, and which: bytes that are handed back as they came. They are two numbers of eight bytes, but
/// implementations disagree on the order of the second one's halves, so nothing may be calculated with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RequestId([u8; HEADER]);

/// A service that a node offers.
pub struct Service {
    pub(super) layouts: Arc<Layouts>,
    pub(super) request: String,
    pub(super) response: String,
    pub(super) requests: SimpleDataReader<Payload, AsBytes>,
    pub(super) replies: DataWriter<Payload, AsBytes>,
}

impl Service {
    /// The next request, if there is one. What is no request is passed over.
    pub fn take(&self) -> Option<(RequestId, Value)> {
        self.requests.drain_read_notifications();
        while let Ok(Some(sample)) = self.requests.try_take_one() {
            if let Some(request) = self.read(&sample.sample) {
                return Some(request);
            }
        }
        None
    }

    fn read(&self, payload: &Payload) -> Option<(RequestId, Value)> {
        let (header, body) = payload.bytes.split_at_checked(HEADER)?;
        let mut header: [u8; HEADER] = header.try_into().ok()?;
        if payload.order == ByteOrder::Big {
            // Ours are the other way round.
            header.chunks_exact_mut(8).for_each(<[u8]>::reverse);
        }
        let request = decode(&self.layouts, &self.request, body, payload.order).ok()?;
        Some((RequestId(header), request))
    }

    /// Answers a request; false if the answer cannot be sent.
    pub fn reply(&self, to: RequestId, answer: &Value) -> bool {
        let Ok(body) = encode(&self.layouts, &self.response, answer) else {
            return false;
        };
        let bytes = [&to.0[..], &body].concat();
        self.replies.write(Payload::new(bytes), None).is_ok()
    }
}
