//! How many are at the other ends of topics.

use rustdds::no_key::{DataWriter, SimpleDataReader};
use rustdds::{DataReaderStatus, DataWriterStatus, StatusEvented};

use super::payload::{AsBytes, Payload};

/// How many read what a writer writes, if that has changed since the last call.
pub(super) fn reads(writer: &DataWriter<Payload, AsBytes>) -> Option<i32> {
    let mut count = None;
    while let Some(status) = writer.try_recv_status() {
        if let DataWriterStatus::PublicationMatched { current, .. } = status {
            count = Some(current.count());
        }
    }
    count
}

/// How many write what a reader reads, if that has changed since the last call.
pub(super) fn writes(reader: &SimpleDataReader<Payload, AsBytes>) -> Option<i32> {
    let mut count = None;
    while let Some(status) = reader.try_recv_status() {
        if let DataReaderStatus::SubscriptionMatched { current, .. } = status {
            count = Some(current.count());
        }
    }
    count
}
