//! States of the world on the tape, compressed.

use std::rc::Rc;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// Greatest size of a state (bytes), compressed or not. A state of the kitchen has a quarter of a
/// megabyte.
const MOST_BYTES: usize = 1 << 28;

/// A state.
#[derive(Clone, PartialEq, Eq, Serialize, Deserialize, Debug)]
pub struct Frame {
    /// Identifies it within the tape.
    pub number: u64,
    /// The world's hash.
    pub hash: u64,
    bytes: Rc<[u8]>,
}

impl Frame {
    /// `None` if the state cannot be written.
    pub fn of(number: u64, hash: u64, state: &impl Serialize) -> Option<Frame> {
        let bytes = postcard::to_allocvec(state).ok()?;
        (bytes.len() <= MOST_BYTES).then(|| Frame {
            number,
            hash,
            bytes: lz4_flex::block::compress_prepend_size(&bytes).into(),
        })
    }

    /// Its size (bytes).
    pub fn size(&self) -> usize {
        self.bytes.len()
    }

    /// The state; `None` if the bytes are something else.
    pub fn state<T: DeserializeOwned>(&self) -> Option<T> {
        let size = u32::from_le_bytes(*self.bytes.first_chunk()?);
        if usize::try_from(size).ok()? > MOST_BYTES {
            return None;
        }
        let bytes = lz4_flex::block::decompress_size_prepended(&self.bytes).ok()?;
        postcard::from_bytes(&bytes).ok()
    }
}
