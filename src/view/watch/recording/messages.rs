//! Walks through the messages of a recording as it is read, with a few chunks unpacked at a time. The library for MCAP
//! files needs all of them at once, since it cannot unpack any.
//!
//! Chunks that hold nothing wanted, as the index after each of them says, are not unpacked; the others are by threads,
//! ahead of who reads them.

use std::collections::HashMap;
use std::io::{self, ErrorKind, Read};
use std::thread;

use mcap::records::op;
use mcap::{MAGIC, McapError};

use super::RecordingError;
use super::channel::Channel;
use super::chunks::Unpacker;
use super::decompress::{MAX_CHUNK, number, record};

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
    file: &mut dyn Read,
    is_wanted: &dyn Fn(Channel) -> bool,
    take: &mut dyn FnMut(&Message<'_>) -> Result<(), RecordingError>,
) -> Result<Walk, RecordingError> {
    let mut walker = Walker {
        channels: HashMap::new(),
        is_ours: false,
        is_wanted,
        take,
    };
    let read = thread::scope(|scope| {
        let mut file = Parts {
            file,
            unpacker: Unpacker::new(scope),
            chunk: None,
        };
        file.read(&mut walker)
    });
    let is_cut_off = match read {
        Ok(()) => false,
        // What has been read before the damage is good.
        Err(RecordingError::CutOff | RecordingError::Format(_)) if walker.is_ours => true,
        Err(error) => return Err(error),
    };
    Ok(Walk {
        is_ours: walker.is_ours,
        is_cut_off,
    })
}

/// The records of a file, as they come.
struct Parts<'f> {
    file: &'f mut dyn Read,
    unpacker: Unpacker,
    /// The last chunk, and the channels whose messages it holds, as the index after it says.
    chunk: Option<(Vec<u8>, Vec<u16>)>,
}

impl Parts<'_> {
    /// Reads up to the end of the data.
    fn read(&mut self, walker: &mut Walker<'_>) -> Result<(), RecordingError> {
        let mut magic = [0; MAGIC.len()];
        let begin = self.exactly(&mut magic)?;
        if !begin || magic != MAGIC {
            return Err(McapError::BadMagic.into());
        }
        let abrupt = self.records(walker)?;
        if let (Some(_), Some((_, channels))) = (&abrupt, &mut self.chunk) {
            // The rest of its index may be missing.
            channels.clear();
        }
        self.end_chunk(walker)?;
        while self.take(walker)? {}
        abrupt.map_or(Ok(()), Err)
    }

    /// Reads records, and takes what has been unpacked meanwhile. The value is how the file ends if it does so
    /// abruptly.
    fn records(
        &mut self,
        walker: &mut Walker<'_>,
    ) -> Result<Option<RecordingError>, RecordingError> {
        loop {
            let mut head = [0; 9];
            if !self.exactly(&mut head)? {
                return Ok(Some(McapError::UnexpectedEof.into()));
            }
            let [opcode, length @ ..] = head;
            let length = u64::from_le_bytes(length);
            if opcode == op::DATA_END || opcode == op::FOOTER {
                return Ok(None);
            }
            if opcode == op::CHUNK && length > MAX_CHUNK {
                return Err(RecordingError::LargeChunk { size: length });
            }
            if let op::CHUNK | op::CHANNEL | op::MESSAGE | op::MESSAGE_INDEX = opcode {
                let mut content = self.unpacker.memory();
                let mut record = (&mut *self.file).take(length);
                if record.read_to_end(&mut content)? as u64 != length {
                    return Ok(Some(match opcode {
                        op::CHUNK => RecordingError::CutOff,
                        _ => McapError::UnexpectedEof.into(),
                    }));
                }
                self.record(opcode, content, walker)?;
            } else {
                let mut record = (&mut *self.file).take(length);
                if io::copy(&mut record, &mut io::sink())? != length {
                    return Ok(Some(McapError::UnexpectedEof.into()));
                }
            }
        }
    }

    fn record(
        &mut self,
        opcode: u8,
        content: Vec<u8>,
        walker: &mut Walker<'_>,
    ) -> Result<(), RecordingError> {
        if opcode == op::MESSAGE_INDEX {
            if let (Some((_, channels)), Some((id, _))) = (&mut self.chunk, u16_of(&content)) {
                channels.push(id);
            }
            self.unpacker.give_back(content);
            return Ok(());
        }
        self.end_chunk(walker)?;
        if opcode == op::CHUNK {
            self.chunk = Some((content, Vec::new()));
            return Ok(());
        }
        // The messages before it come first.
        while self.take(walker)? {}
        let done = walker.record(opcode, &content);
        self.unpacker.give_back(content);
        done
    }

    /// Has the last chunk unpacked, unless its index says that it holds nothing wanted.
    fn end_chunk(&mut self, walker: &mut Walker<'_>) -> Result<(), RecordingError> {
        let Some((chunk, channels)) = self.chunk.take() else {
            return Ok(());
        };
        let known = channels.iter().map(|id| walker.channels.get(id));
        let known: Option<Vec<&Known>> = known.collect();
        if let Some(known) = known.filter(|known| !known.is_empty()) {
            let mut ours = known.iter().filter_map(|known| known.channel);
            if !ours.clone().any(walker.is_wanted) {
                walker.is_ours |= ours.next().is_some();
                self.unpacker.give_back(chunk);
                return Ok(());
            }
        }
        if self.unpacker.is_full() {
            self.take(walker)?;
        }
        self.unpacker.give(chunk);
        Ok(())
    }

    /// Takes the messages of the next chunk that has been unpacked, if there is one.
    fn take(&mut self, walker: &mut Walker<'_>) -> Result<bool, RecordingError> {
        let Some(content) = self.unpacker.take() else {
            return Ok(false);
        };
        let content = content?;
        if !content.is_whole {
            return Err(RecordingError::CutOff);
        }
        walker.chunk(&content.bytes)?;
        self.unpacker.give_back(content.bytes);
        Ok(true)
    }

    /// Fills a buffer; false if the file ends before.
    fn exactly(&mut self, buffer: &mut [u8]) -> Result<bool, RecordingError> {
        match self.file.read_exact(buffer) {
            Ok(()) => Ok(true),
            Err(error) if error.kind() == ErrorKind::UnexpectedEof => Ok(false),
            Err(error) => Err(error.into()),
        }
    }
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
                        time: seconds(time),
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

/// The time (s) of a message, of that in its record (ns).
pub(super) fn seconds(nanoseconds: u64) -> f64 {
    nanoseconds as f64 * 1e-9
}

/// The 16-bit number at the beginning.
fn u16_of(bytes: &[u8]) -> Option<(u16, &[u8])> {
    let (number, rest) = bytes.split_first_chunk()?;
    Some((u16::from_le_bytes(*number), rest))
}

/// The text at the beginning, which is preceded by its length.
pub(super) fn text_of(bytes: &[u8]) -> Option<(&str, &[u8])> {
    let (length, rest) = bytes.split_first_chunk()?;
    let length = usize::try_from(u32::from_le_bytes(*length)).ok()?;
    let (text, rest) = rest.split_at_checked(length)?;
    Some((std::str::from_utf8(text).ok()?, rest))
}
