//! The part of a tape that belongs to one input.

use std::rc::Rc;

use super::frame::Frame;

/// Greatest size of the answers of one input (bytes), compressed or not.
const MOST_BYTES: usize = 1 << 28;

/// What is recorded of one input.
#[derive(Clone, PartialEq, Debug)]
pub struct Part {
    /// The answers, compressed; `None` if the input cannot be played.
    pub answers: Option<Vec<u8>>,
    /// The states that were recorded meanwhile.
    pub frames: Vec<Rc<Frame>>,
    /// The number of the frame of the state in which it left the world at rest; `None` if a motion
    /// or an evaluation is suspended, or if the state cannot be written.
    pub end: Option<u64>,
    /// The numbers of all frames that snapshots refer to.
    pub needed: Vec<u64>,
}

impl Part {
    pub fn new(
        entries: Option<&[u8]>,
        frames: Vec<Rc<Frame>>,
        end: Option<u64>,
        needed: Vec<u64>,
    ) -> Part {
        Part {
            answers: entries.map(lz4_flex::block::compress_prepend_size),
            frames,
            end,
            needed,
        }
    }

    /// The answers; `None` if there are none, or if they are damaged.
    pub(super) fn entries(&self) -> Option<Vec<u8>> {
        let answers = self.answers.as_ref()?;
        let size = u32::from_le_bytes(*answers.first_chunk()?);
        if usize::try_from(size).ok()? > MOST_BYTES {
            return None;
        }
        lz4_flex::block::decompress_size_prepended(answers).ok()
    }
}
