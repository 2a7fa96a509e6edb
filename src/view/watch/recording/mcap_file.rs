//! Writes an MCAP file: messages in compressed chunks (lz4), with an index and statistics at the
//! end.

use std::collections::BTreeMap;
use std::io::{self, Write};

use lz4_flex::frame::{BlockSize, FrameEncoder, FrameInfo};
use mcap::MAGIC;
use mcap::records::op;

/// Size (bytes) from which on a chunk is written, and the time (ns) between its messages after
/// which it is: what a session that is killed had not written is lost.
const CHUNK_BYTES: usize = 512 << 10;
const CHUNK_TIME: u64 = 1_000_000_000;

/// An MCAP file that is being written.
pub(super) struct McapFile<W: Write> {
    to: W,
    /// Number of bytes written.
    at: u64,
    sequence: u32,
    /// Records of schemas and channels, which are repeated at the end.
    schemas: Vec<u8>,
    channels: Vec<u8>,
    schema_count: u16,
    channel_count: u16,
    chunk: Chunk,
    /// What is known of chunks: the records of the index at the end.
    index: Vec<u8>,
    chunk_count: u32,
    counts: BTreeMap<u16, u64>,
    span: Option<[u64; 2]>,
    /// The records of the index of attachments.
    attachments: Vec<u8>,
    attachment_count: u32,
}

/// The chunk that is being filled.
#[derive(Default)]
struct Chunk {
    records: Vec<u8>,
    /// Times and offsets of the messages of each channel.
    messages: BTreeMap<u16, Vec<(u64, u64)>>,
    span: Option<[u64; 2]>,
}

impl<W: Write> McapFile<W> {
    /// Begins a file written by this library.
    pub(super) fn begin(to: W, library: &str) -> io::Result<Self> {
        let mut file = Self {
            to,
            at: 0,
            sequence: 0,
            schemas: Vec::new(),
            channels: Vec::new(),
            schema_count: 0,
            channel_count: 0,
            chunk: Chunk::default(),
            index: Vec::new(),
            chunk_count: 0,
            counts: BTreeMap::new(),
            span: None,
            attachments: Vec::new(),
            attachment_count: 0,
        };
        file.put(MAGIC)?;
        let mut header = Vec::new();
        add_text(&mut header, "");
        add_text(&mut header, library);
        file.put(&record(op::HEADER, &header))?;
        Ok(file)
    }

    /// Adds a schema in an encoding of schemas; returns its number.
    pub(super) fn add_schema(
        &mut self,
        name: &str,
        encoding: &str,
        definition: &[u8],
    ) -> io::Result<u16> {
        self.schema_count += 1;
        let mut content = self.schema_count.to_le_bytes().to_vec();
        add_text(&mut content, name);
        add_text(&mut content, encoding);
        add_bytes(&mut content, definition);
        let schema = record(op::SCHEMA, &content);
        self.schemas.extend(&schema);
        self.put(&schema)?;
        Ok(self.schema_count)
    }

    /// Adds a channel of messages in an encoding; returns its number.
    pub(super) fn add_channel(
        &mut self,
        schema: u16,
        topic: &str,
        encoding: &str,
    ) -> io::Result<u16> {
        self.channel_count += 1;
        let mut content = self.channel_count.to_le_bytes().to_vec();
        content.extend(schema.to_le_bytes());
        add_text(&mut content, topic);
        add_text(&mut content, encoding);
        add_bytes(&mut content, &[]);
        let channel = record(op::CHANNEL, &content);
        self.channels.extend(&channel);
        self.put(&channel)?;
        Ok(self.channel_count)
    }

    /// Adds a message to a channel at a time (ns).
    pub(super) fn add(&mut self, channel: u16, time: u64, data: &[u8]) -> io::Result<()> {
        let is_full = self.chunk.records.len() >= CHUNK_BYTES;
        let is_old =
            (self.chunk.span).is_some_and(|[first, _]| time.saturating_sub(first) > CHUNK_TIME);
        if is_full || is_old {
            self.end_chunk()?;
        }
        let chunk = &mut self.chunk;
        let offset = chunk.records.len() as u64;
        chunk
            .messages
            .entry(channel)
            .or_default()
            .push((time, offset));
        chunk.span = Some(widened(chunk.span, time));
        self.span = Some(widened(self.span, time));
        *self.counts.entry(channel).or_default() += 1;
        let mut content = channel.to_le_bytes().to_vec();
        content.extend(self.sequence.to_le_bytes());
        self.sequence = self.sequence.wrapping_add(1);
        content.extend(time.to_le_bytes());
        content.extend(time.to_le_bytes());
        content.extend(data);
        chunk.records.extend(record(op::MESSAGE, &content));
        Ok(())
    }

    fn end_chunk(&mut self) -> io::Result<()> {
        let chunk = std::mem::take(&mut self.chunk);
        let Some([first, last]) = chunk.span else {
            return Ok(());
        };
        let blocks = FrameInfo::new().block_size(BlockSize::Max1MB);
        let mut packed = FrameEncoder::with_frame_info(blocks, Vec::new());
        packed.write_all(&chunk.records)?;
        let packed = packed.finish().map_err(io::Error::other)?;
        let size = chunk.records.len() as u64;
        let mut content = Vec::with_capacity(packed.len() + 64);
        for number in [first, last, size] {
            content.extend(number.to_le_bytes());
        }
        content.extend(crc32fast::hash(&chunk.records).to_le_bytes());
        add_text(&mut content, "lz4");
        content.extend((packed.len() as u64).to_le_bytes());
        content.extend(&packed);
        let begin = self.at;
        self.put(&record(op::CHUNK, &content))?;
        let length = self.at - begin;

        let mut offsets = Vec::new();
        let indices = self.at;
        for (channel, messages) in &chunk.messages {
            offsets.extend(channel.to_le_bytes());
            offsets.extend(self.at.to_le_bytes());
            let mut list = Vec::new();
            for (time, offset) in messages {
                list.extend(time.to_le_bytes());
                list.extend(offset.to_le_bytes());
            }
            let mut content = channel.to_le_bytes().to_vec();
            add_bytes(&mut content, &list);
            self.put(&record(op::MESSAGE_INDEX, &content))?;
        }
        let mut entry = Vec::new();
        for number in [first, last, begin, length] {
            entry.extend(number.to_le_bytes());
        }
        add_bytes(&mut entry, &offsets);
        entry.extend((self.at - indices).to_le_bytes());
        add_text(&mut entry, "lz4");
        entry.extend((packed.len() as u64).to_le_bytes());
        entry.extend(size.to_le_bytes());
        self.index.extend(record(op::CHUNK_INDEX, &entry));
        self.chunk_count += 1;
        Ok(())
    }

    /// Ends the chunk, and returns where what is attached next will begin: the number of bytes before it.
    pub(super) fn attachment_begin(&mut self) -> io::Result<u64> {
        self.end_chunk()?;
        Ok(self.at)
    }

    /// Attaches data, at the time of the last message.
    pub(super) fn attach(&mut self, name: &str, media_type: &str, data: &[u8]) -> io::Result<()> {
        let offset = self.attachment_begin()?;
        let [_, last] = self.span.unwrap_or_default();
        let mut content = Vec::with_capacity(data.len() + 100);
        // When it was attached and made.
        for time in [last; 2] {
            content.extend(time.to_le_bytes());
        }
        add_text(&mut content, name);
        add_text(&mut content, media_type);
        content.extend((data.len() as u64).to_le_bytes());
        content.extend(data);
        content.extend(crc32fast::hash(&content).to_le_bytes());
        self.put(&record(op::ATTACHMENT, &content))?;
        let mut entry = Vec::new();
        for number in [offset, self.at - offset, last, last, data.len() as u64] {
            entry.extend(number.to_le_bytes());
        }
        add_text(&mut entry, name);
        add_text(&mut entry, media_type);
        self.attachments
            .extend(record(op::ATTACHMENT_INDEX, &entry));
        self.attachment_count += 1;
        Ok(())
    }

    /// Ends the file.
    pub(super) fn finish(mut self) -> io::Result<()> {
        self.end_chunk()?;
        // No checksum of all data: each chunk has its own.
        self.put(&record(op::DATA_END, &[0; 4]))?;
        let mut summary = Vec::new();
        let mut offsets = Vec::new();
        let groups = [
            (op::SCHEMA, std::mem::take(&mut self.schemas)),
            (op::CHANNEL, std::mem::take(&mut self.channels)),
            (op::STATISTICS, record(op::STATISTICS, &self.statistics())),
            (op::CHUNK_INDEX, std::mem::take(&mut self.index)),
            (op::ATTACHMENT_INDEX, std::mem::take(&mut self.attachments)),
        ];
        let begin = self.at;
        for (opcode, group) in groups {
            if group.is_empty() {
                continue;
            }
            let mut content = vec![opcode];
            content.extend((begin + summary.len() as u64).to_le_bytes());
            content.extend((group.len() as u64).to_le_bytes());
            offsets.extend(record(op::SUMMARY_OFFSET, &content));
            summary.extend(group);
        }
        let offset_begin = begin + summary.len() as u64;
        summary.extend(offsets);
        // The checksum covers the summary and the footer up to itself.
        let mut footer = begin.to_le_bytes().to_vec();
        footer.extend(offset_begin.to_le_bytes());
        summary.push(op::FOOTER);
        summary.extend(20u64.to_le_bytes());
        summary.extend(footer);
        let sum = crc32fast::hash(&summary);
        summary.extend(sum.to_le_bytes());
        self.put(&summary)?;
        self.put(MAGIC)?;
        self.to.flush()
    }

    fn statistics(&self) -> Vec<u8> {
        let mut content = self.counts.values().sum::<u64>().to_le_bytes().to_vec();
        content.extend(self.schema_count.to_le_bytes());
        // Channels, attachments, metadata and chunks.
        let channels = u32::from(self.channel_count);
        for number in [channels, self.attachment_count, 0, self.chunk_count] {
            content.extend(number.to_le_bytes());
        }
        for time in self.span.unwrap_or_default() {
            content.extend(time.to_le_bytes());
        }
        let mut counts = Vec::new();
        for (channel, count) in &self.counts {
            counts.extend(channel.to_le_bytes());
            counts.extend(count.to_le_bytes());
        }
        add_bytes(&mut content, &counts);
        content
    }

    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.to.write_all(bytes)?;
        self.at += bytes.len() as u64;
        Ok(())
    }
}

fn widened(span: Option<[u64; 2]>, time: u64) -> [u64; 2] {
    span.map_or([time; 2], |[first, last]| [first.min(time), last.max(time)])
}

fn record(opcode: u8, content: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(content.len() + 9);
    bytes.push(opcode);
    bytes.extend((content.len() as u64).to_le_bytes());
    bytes.extend(content);
    bytes
}

fn add_bytes(to: &mut Vec<u8>, bytes: &[u8]) {
    // No part of a recording is longer than four gigabytes.
    let length = u32::try_from(bytes.len()).unwrap_or(u32::MAX);
    to.extend(length.to_le_bytes());
    to.extend(bytes);
}

fn add_text(to: &mut Vec<u8>, text: &str) {
    add_bytes(to, text.as_bytes());
}
