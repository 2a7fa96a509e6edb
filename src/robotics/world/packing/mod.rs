//! States of the world as few bytes: written as the difference to an earlier state, and compressed.
//!
//! Most of a world is at rest most of the time, so most bytes of two states are the same. A state is
//! written with the same number of bytes for each number, whatever its value; the elements of its
//! outermost lists are held against the elements with the same index of an earlier state, so that one
//! that is longer than it was shifts nothing; and what is the same becomes zero. What is read again has
//! the same bits.
//!
//! Nothing here knows what is written.

mod alignment;
mod reader;
mod writer;

use serde::Serialize;

pub(crate) use self::alignment::{Places, Reference};
pub(crate) use self::reader::{LeftOut, Reader};
pub(crate) use self::writer::Writer;

/// What cannot be written or read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum PackingError {
    /// The bytes end before the value does.
    #[error("the bytes end too early")]
    Short,
    /// The bytes are none of what is read.
    #[error("the bytes do not say {0}")]
    NotOf(&'static str),
    /// Values of a type that is of no use in a state.
    #[error("{0} cannot be packed")]
    Unsupported(&'static str),
    /// As the value itself says it.
    #[error("{0}")]
    Other(String),
}

impl serde::ser::Error for PackingError {
    fn custom<T: std::fmt::Display>(message: T) -> Self {
        Self::Other(message.to_string())
    }
}

impl serde::de::Error for PackingError {
    fn custom<T: std::fmt::Display>(message: T) -> Self {
        Self::Other(message.to_string())
    }
}

/// Adds a value as bytes that stand for themselves.
pub(crate) fn plain<T: Serialize>(value: &T, bytes: &mut Vec<u8>) -> Result<(), PackingError> {
    let mut writer = Writer::new(std::mem::take(bytes), None, None);
    let written = value.serialize(&mut writer);
    *bytes = writer.finish().0;
    written
}

/// Bytes most of which are zero, compressed.
pub(crate) struct Compressed {
    bytes: Box<[u8]>,
    /// How many they were.
    length: usize,
}

impl Compressed {
    /// Compresses bytes. The room is for use on the way: what is kept for long is to have its own size from the
    /// beginning, or else much memory lies idle between such pieces.
    pub(crate) fn new(bytes: &[u8], room: &mut Vec<u8>) -> Self {
        room.resize(lz4_flex::block::get_maximum_output_size(bytes.len()), 0);
        let length = lz4_flex::block::compress_into(bytes, room);
        // There is room for the longest output.
        let written = &room[..length.unwrap_or(0)];
        Self {
            bytes: written.into(),
            length: bytes.len(),
        }
    }

    /// The bytes that were compressed.
    pub(crate) fn bytes(&self) -> Result<Vec<u8>, PackingError> {
        lz4_flex::block::decompress(&self.bytes, self.length)
            .map_err(|_| PackingError::NotOf("what was compressed"))
    }

    /// How much memory (bytes) they take.
    pub(crate) fn size(&self) -> usize {
        self.bytes.len()
    }
}

#[cfg(test)]
mod tests;
