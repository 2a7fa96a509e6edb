//! Walks through the messages of a recording, one chunk after the other, so that no more than one is unpacked at a
//! time. The library for MCAP files needs all of them at once, since it cannot unpack any.

use std::collections::HashMap;

use mcap::records::op;
use mcap::{MAGIC, McapError};

use super::RecordingError;
use super::channel::Channel;
use super::decompress::{Chunk, number, record};

/// A message of one of our channels.
pub(super) struct Message<'a> {
    pub(super) channel: Channel,
    /// Of the data: `json` or `protobuf`.
    pub(super) encoding: &'a str,
    /// When it was written (s).
    pub(super) time: f64,
    pub(super) data: &'a [u8],
}

/// What a walk has found.
pub(super) struct Walk {
    /// Is there any message of ours?
    pub(super) is_ours: bool,
    /// Does the file end abruptly?
    pub(super) is_cut_off: bool,
}

/// Hands the messages of wanted channels to a function, in the order of the file.
pub(super) fn walk(
    bytes: &[u8],
    is_wanted: &dyn Fn(Channel) -> bool,
    take: &mut dyn FnMut(&Message<'_>) -> Result<(), RecordingError>,
) -> Result<Walk, RecordingError> {
    let mut walker = Walker {
        channels: HashMap::new(),
        is_ours: false,
        is_wanted,
        take,
    };
    let mut rest = bytes.strip_prefix(MAGIC).ok_or(McapError::BadMagic)?;
    let mut unpacked = Vec::new();
    let mut is_cut_off = false;
    loop {
        let Some((opcode, content, after)) = record(rest) else {
            is_cut_off = true;
            let is_chunk = rest.first() == Some(&op::CHUNK);
            match (walker.is_ours, is_chunk) {
                (true, _) => break,
                (false, true) => return Err(RecordingError::CutOff),
                (false, false) => return Err(McapError::UnexpectedEof.into()),
            }
        };
        rest = after;
        match opcode {
            op::DATA_END | op::FOOTER => break,
            op::CHUNK => {
                let chunk = Chunk::of(content).ok_or(McapError::UnexpectedEof)?;
                let content = chunk.content_in(&mut unpacked)?;
                let done = match chunk.is_whole(content) {
                    true => walker.chunk(content),
                    false => Err(RecordingError::CutOff),
                };
                match done {
                    // What has been read before the damage is good.
                    Err(RecordingError::CutOff | RecordingError::Format(_)) if walker.is_ours => {
                        is_cut_off = true;
                        break;
                    }
                    done => done?,
                }
            }
            _ => walker.record(opcode, content)?,
        }
    }
    Ok(Walk {
        is_ours: walker.is_ours,
        is_cut_off,
    })
}

/// A channel of the file.
struct Known {
    channel: Option<Channel>,
    encoding: String,
}

struct Walker<'w> {
    channels: HashMap<u16, Known>,
    is_ours: bool,
    is_wanted: &'w dyn Fn(Channel) -> bool,
    take: &'w mut dyn FnMut(&Message<'_>) -> Result<(), RecordingError>,
}

impl Walker<'_> {
    fn chunk(&mut self, mut rest: &[u8]) -> Result<(), RecordingError> {
        while !rest.is_empty() {
            let (opcode, content, after) = record(rest).ok_or(McapError::UnexpectedEof)?;
            self.record(opcode, content)?;
            rest = after;
        }
        Ok(())
    }

    fn record(&mut self, opcode: u8, content: &[u8]) -> Result<(), RecordingError> {
        match opcode {
            op::CHANNEL => self.channel(content).ok_or(McapError::UnexpectedEof)?,
            op::MESSAGE => {
                // The channel, a number, when it was written, when it was published.
                let parts = u16_of(content).and_then(|(id, rest)| {
                    let (time, rest) = number(rest.get(4..)?)?;
                    Some((id, time, rest.get(8..)?))
                });
                let (id, time, data) = parts.ok_or(McapError::UnexpectedEof)?;
                let Some(known) = self.channels.get(&id) else {
                    return Err(McapError::UnknownChannel(0, id).into());
                };
                let Some(channel) = known.channel else {
                    return Ok(());
                };
                self.is_ours = true;
                if (self.is_wanted)(channel) {
                    (self.take)(&Message {
                        channel,
                        encoding: &known.encoding,
                        time: time as f64 * 1e-9,
                        data,
                    })?;
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn channel(&mut self, content: &[u8]) -> Option<()> {
        let (id, rest) = u16_of(content)?;
        let (_schema, rest) = u16_of(rest)?;
        let (topic, rest) = text_of(rest)?;
        let (encoding, _) = text_of(rest)?;
        let known = Known {
            channel: Channel::of_topic(topic),
            encoding: encoding.to_owned(),
        };
        self.channels.insert(id, known);
        Some(())
    }
}

/// The 16-bit number at the beginning.
fn u16_of(bytes: &[u8]) -> Option<(u16, &[u8])> {
    let (number, rest) = bytes.split_first_chunk()?;
    Some((u16::from_le_bytes(*number), rest))
}

/// The text at the beginning, which is preceded by its length.
fn text_of(bytes: &[u8]) -> Option<(&str, &[u8])> {
    let (length, rest) = bytes.split_first_chunk()?;
    let length = usize::try_from(u32::from_le_bytes(*length)).ok()?;
    let (text, rest) = rest.split_at_checked(length)?;
    Some((std::str::from_utf8(text).ok()?, rest))
}
