//! A topic that a node hears.

use std::sync::Arc;

use rustdds::no_key::SimpleDataReader;
use rustdds::{DataReaderStatus, StatusEvented};

use super::payload::{AsBytes, Payload};
use crate::cdr::decode;
use crate::layout::Layouts;
use crate::value::Value;

/// A topic that a node hears.
pub struct TopicReader {
    pub(super) topic: String,
    pub(super) message: String,
    pub(super) layouts: Arc<Layouts>,
    pub(super) reader: SimpleDataReader<Payload, AsBytes>,
}

impl TopicReader {
    /// The next message, if there is one. What cannot be read is passed over.
    pub fn take(&self) -> Option<Value> {
        self.reader.drain_read_notifications();
        while let Ok(Some(sample)) = self.reader.try_take_one() {
            let payload = sample.sample;
            let read = decode(&self.layouts, &self.message, &payload.bytes, payload.order);
            if let Ok(value) = read {
                return Some(value);
            }
        }
        None
    }

    /// Its name.
    pub fn topic(&self) -> &str {
        &self.topic
    }

    /// The quality of service by which the last speaker since the last call does not match, if there was one: it is
    /// not heard, and the protocol tells neither side's user.
    pub fn mismatch(&self) -> Option<String> {
        let mut mismatch = None;
        while let Some(status) = self.reader.try_recv_status() {
            if let DataReaderStatus::RequestedIncompatibleQos { last_policy_id, .. } = status {
                mismatch = Some(format!("{last_policy_id:?}"));
            }
        }
        mismatch
    }
}
