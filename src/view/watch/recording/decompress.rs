//! Unpacks the compressed chunks of an MCAP file, in pure Rust: the reader of MCAP files would
//! need C libraries for that.
//!
//! Our own recordings are compressed with lz4; other tools may rewrite them.

use std::borrow::Cow;
use std::io::{self, ErrorKind, Read};

use defect::caught;
use lz4_flex::frame::FrameDecoder;
use mcap::records::op;
use mcap::{MAGIC, McapError};
use ruzstd::decoding::StreamingDecoder;

use super::RecordingError;
use super::chunks::Content;

/// Maximum unpacked size (bytes) of a chunk. Recorders write chunks of some megabytes.
pub(super) const MAX_CHUNK: u64 = 1 << 30;

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
pub(super) fn record(bytes: &[u8]) -> Option<(u8, &[u8], &[u8])> {
    let (opcode, rest) = bytes.split_first()?;
    let (length, rest) = number(rest)?;
    let (content, after) = rest.split_at_checked(usize::try_from(length).ok()?)?;
    Some((*opcode, content, after))
}

/// The 64-bit number at the beginning.
pub(super) fn number(bytes: &[u8]) -> Option<(u64, &[u8])> {
    let (number, rest) = bytes.split_first_chunk()?;
    Some((u64::from_le_bytes(*number), rest))
}

/// The first two bytes of an LZ4 frame: the version, and that no block needs those before it; and what else they say.
const VERSION: u8 = 0b1100_0000;
const VERSION_1: u8 = 0b0100_0000;
const INDEPENDENT: u8 = 0b0010_0000;
const BLOCK_CHECKSUMS: u8 = 0b0001_0000;
const CONTENT_SIZE: u8 = 0b0000_1000;
const DICTIONARY: u8 = 0b0000_0001;

/// A byte of a block stands for at most so many.
const MAX_RATIO: usize = 256;

/// Makes the contents of an LZ4 frame those of a buffer, without a copy in between, if the frame is one of independent
/// blocks and unpacks to that size. Checksums are left to who knows that of the whole.
fn unpack_frame(frame: &[u8], size: usize, buffer: &mut Vec<u8>) -> bool {
    // A size that cannot be true costs no memory.
    if size > frame.len().saturating_mul(MAX_RATIO) {
        return false;
    }
    // What is there is overwritten.
    buffer.resize(size, 0);
    blocks_into(frame, buffer) == Some(size)
}

/// Unpacks the blocks of a frame; how many bytes they have.
fn blocks_into(frame: &[u8], to: &mut [u8]) -> Option<usize> {
    let rest = frame.strip_prefix(&0x184d_2204_u32.to_le_bytes())?;
    let flags = *rest.first()?;
    if flags & VERSION != VERSION_1 || flags & INDEPENDENT == 0 || flags & DICTIONARY != 0 {
        return None;
    }
    let size = if flags & CONTENT_SIZE != 0 { 8 } else { 0 };
    // The flags, the maximum size of a block, the size of the content, and a checksum of those.
    let mut rest = rest.get(3 + size..)?;
    let mut at = 0;
    loop {
        let (length, after) = rest.split_first_chunk()?;
        let length = u32::from_le_bytes(*length);
        if length == 0 {
            return Some(at);
        }
        let is_packed = length >> 31 == 0;
        let (block, after) = after.split_at_checked((length & 0x7fff_ffff) as usize)?;
        let place = to.get_mut(at..)?;
        at += match is_packed {
            true => lz4_flex::block::decompress_into(block, place).ok()?,
            false => {
                place.get_mut(..block.len())?.copy_from_slice(block);
                block.len()
            }
        };
        rest = match flags & BLOCK_CHECKSUMS {
            0 => after,
            _ => after.get(4..)?,
        };
    }
}

/// A chunk record.
pub(super) struct Chunk<'a> {
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

    /// What the chunk of a record holds, in memory that is no longer needed.
    ///
    /// Damage that makes a library panic is an error, too.
    pub(super) fn unpacked(record: &[u8], mut bytes: Vec<u8>) -> Result<Content, RecordingError> {
        let chunk = Chunk::of(record).ok_or(McapError::UnexpectedEof)?;
        if chunk.is_compressed() {
            caught(|| chunk.unpack_content(&mut bytes))??;
        } else {
            bytes.clear();
            bytes.extend_from_slice(chunk.content);
        }
        let found = crc32fast::hash(&bytes).to_le_bytes();
        // Zero stands for none.
        let is_whole = matches!(chunk.checksum, [0, 0, 0, 0]) || chunk.checksum == found;
        Ok(Content { bytes, is_whole })
    }

    /// Replaces the contents of a buffer by those of this chunk.
    fn unpack_content(&self, content: &mut Vec<u8>) -> Result<(), RecordingError> {
        if self.size > MAX_CHUNK {
            return Err(RecordingError::LargeChunk { size: self.size });
        }
        if self.compression == b"lz4" && unpack_frame(self.content, self.size as usize, content) {
            return Ok(());
        }
        content.clear();
        match self.compression {
            b"lz4" => self.read_into(content, &mut FrameDecoder::new(self.content))?,
            b"zstd" => {
                let mut frames = self.content;
                while !frames.is_empty() && (content.len() as u64) < self.size {
                    let mut frame = StreamingDecoder::new(&mut frames).map_err(io::Error::other)?;
                    self.read_into(content, &mut frame)?;
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
        Ok(())
    }

    /// Appends this chunk as an uncompressed one.
    fn unpack(&self, to: &mut Vec<u8>) -> Result<(), RecordingError> {
        let mut content = Vec::new();
        self.unpack_content(&mut content)?;
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    #[test]
    fn a_size_that_cannot_be_true_takes_no_memory() {
        let mut writer = lz4_flex::frame::FrameEncoder::new(Vec::new());
        writer.write_all(&[7; 5000]).unwrap();
        let frame = writer.finish().unwrap();
        let mut buffer = Vec::new();
        assert!(!unpack_frame(&frame, 1 << 30, &mut buffer));
        assert_eq!(buffer.capacity(), 0);
        assert!(!unpack_frame(&frame, 4999, &mut buffer));
        assert!(unpack_frame(&frame, 5000, &mut buffer));
        assert_eq!(buffer, [7; 5000]);
    }
}
