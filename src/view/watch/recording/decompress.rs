//! Unpacks the compressed chunks of an MCAP file, in pure Rust: the reader of MCAP files would
//! need C libraries for that.
//!
//! Our own recordings are compressed with lz4; other tools may rewrite them.

use std::borrow::Cow;
use std::io::{self, ErrorKind, Read};

use lz4_flex::frame::FrameDecoder;
use mcap::MAGIC;
use mcap::records::op;
use ruzstd::decoding::StreamingDecoder;

use super::RecordingError;

/// Maximum unpacked size (bytes) of a chunk. Recorders write chunks of some megabytes.
const MAX_CHUNK: u64 = 1 << 30;

/// The file with all its chunks unpacked. A file without compressed chunks, or without records,
/// is returned as it is; from the first malformed record on, so is the rest of any file.
pub(super) fn decompressed(file: &[u8]) -> Result<Cow<'_, [u8]>, RecordingError> {
    let mut unpacked: Option<Vec<u8>> = None;
    let mut rest = file.strip_prefix(MAGIC).unwrap_or_default();
    while let Some((opcode, content, after)) = record(rest) {
        let here = file.len() - rest.len();
        let chunk = (opcode == op::CHUNK).then(|| Chunk::of(content)).flatten();
        match chunk.filter(Chunk::is_compressed) {
            Some(chunk) => {
                let to = unpacked.get_or_insert_with(|| file[..here].to_vec());
                chunk.unpack(to)?;
            }
            None => {
                if let Some(to) = &mut unpacked {
                    to.extend_from_slice(&file[here..file.len() - after.len()]);
                }
            }
        }
        rest = after;
    }
    let Some(mut unpacked) = unpacked else {
        return Ok(Cow::Borrowed(file));
    };
    unpacked.extend_from_slice(rest);
    Ok(Cow::Owned(unpacked))
}

/// The first record: opcode, content, and what follows it.
fn record(bytes: &[u8]) -> Option<(u8, &[u8], &[u8])> {
    let (opcode, rest) = bytes.split_first()?;
    let (length, rest) = number(rest)?;
    let (content, after) = rest.split_at_checked(usize::try_from(length).ok()?)?;
    Some((*opcode, content, after))
}

/// The 64-bit number at the beginning.
fn number(bytes: &[u8]) -> Option<(u64, &[u8])> {
    let (number, rest) = bytes.split_first_chunk()?;
    Some((u64::from_le_bytes(*number), rest))
}

/// A chunk record.
struct Chunk<'a> {
    /// Times of the first and the last message.
    times: &'a [u8],
    size: u64,
    /// Checksum of the unpacked content.
    checksum: &'a [u8],
    compression: &'a [u8],
    content: &'a [u8],
}

impl<'a> Chunk<'a> {
    fn of(record: &'a [u8]) -> Option<Self> {
        let (times, rest) = record.split_at_checked(16)?;
        let (size, rest) = number(rest)?;
        let (checksum, rest) = rest.split_at_checked(4)?;
        let (length, rest) = rest.split_first_chunk()?;
        let length = usize::try_from(u32::from_le_bytes(*length)).ok()?;
        let (compression, rest) = rest.split_at_checked(length)?;
        let (length, rest) = number(rest)?;
        let content = rest.get(..usize::try_from(length).ok()?)?;
        Some(Self {
            times,
            size,
            checksum,
            compression,
            content,
        })
    }

    fn is_compressed(&self) -> bool {
        !self.compression.is_empty()
    }

    /// Appends this chunk as an uncompressed one.
    fn unpack(&self, to: &mut Vec<u8>) -> Result<(), RecordingError> {
        if self.size > MAX_CHUNK {
            return Err(RecordingError::LargeChunk { size: self.size });
        }
        let mut content = Vec::new();
        match self.compression {
            b"lz4" => self.read_into(&mut content, &mut FrameDecoder::new(self.content))?,
            b"zstd" => {
                let mut frames = self.content;
                while !frames.is_empty() && (content.len() as u64) < self.size {
                    let mut frame = StreamingDecoder::new(&mut frames).map_err(io::Error::other)?;
                    self.read_into(&mut content, &mut frame)?;
                }
            }
            other => {
                let name = String::from_utf8_lossy(other).into_owned();
                return Err(RecordingError::Compression(name));
            }
        }
        if content.len() as u64 != self.size {
            let text = format!(
                "a chunk has {} bytes or more instead of {}",
                content.len(),
                self.size
            );
            return Err(io::Error::new(ErrorKind::InvalidData, text).into());
        }
        // Times, sizes, checksum, an empty name of the compression, and the content.
        let length = self.times.len() + 8 + self.checksum.len() + 4 + 8 + content.len();
        to.push(op::CHUNK);
        to.extend_from_slice(&(length as u64).to_le_bytes());
        to.extend_from_slice(self.times);
        to.extend_from_slice(&self.size.to_le_bytes());
        to.extend_from_slice(self.checksum);
        to.extend_from_slice(&0u32.to_le_bytes());
        to.extend_from_slice(&self.size.to_le_bytes());
        to.append(&mut content);
        Ok(())
    }

    /// Reads at most one byte more than the chunk should have.
    fn read_into(&self, to: &mut Vec<u8>, from: &mut impl Read) -> io::Result<()> {
        let left = (self.size + 1).saturating_sub(to.len() as u64);
        from.take(left).read_to_end(to)?;
        Ok(())
    }
}
