//! The relations of a recording, attached to its end: who asks about it need not read its messages.
//!
//! They are those of the messages before the attachment. It says where it begins, so that it is not believed any more
//! once another program has copied the file with other messages.

use std::io::{self, Read, Seek, SeekFrom, Write};

use mcap::MAGIC;
use mcap::records::op;

use super::decompress::{number, record};
use super::episode::Wanted;
use super::mcap_file::McapFile;
use super::messages::text_of;
use super::rows::{Datum, RELATIONS, Rows};
use super::wire::{Content, Out, field, varint};

const NAME: &str = "planwright/episode";
const MEDIA_TYPE: &str = "application/x-planwright-episode";

/// What rows mean, and how they are written. Others are not read.
const VERSION: u64 = 1;

/// Fields of the attachment, in Protobuf.
const VERSION_FIELD: u32 = 1;
const BEGIN_FIELD: u32 = 2;
const RELATION_FIELD: u32 = 3;
/// Fields of a relation: its name, the names of its columns and its values, packed with lz4.
const NAME_FIELD: u32 = 1;
const COLUMN_FIELD: u32 = 2;
const VALUES_FIELD: u32 = 3;

/// What precedes a value.
const NULL: u8 = 0;
const INT: u8 = 1;
const NUMBER: u8 = 2;
const TEXT: u8 = 3;

/// Maximum size (bytes) of the attachment, and of the values of a relation.
const MAX_BYTES: u64 = 256 << 20;

/// Attaches relations to a file all of whose messages have been added.
pub(super) fn write<W: Write>(
    file: &mut McapFile<W>,
    relations: &[(&'static str, Rows)],
) -> io::Result<()> {
    let mut out = Out::default();
    out.number(VERSION_FIELD, VERSION);
    out.number(BEGIN_FIELD, file.attachment_begin()?);
    for (name, rows) in relations {
        let mut relation = Out::default();
        relation.text(NAME_FIELD, name);
        for column in rows.columns {
            relation.text(COLUMN_FIELD, column);
        }
        let mut values = Out::default();
        for datum in rows.rows.iter().flatten() {
            add_value(&mut values, datum);
        }
        let packed = lz4_flex::block::compress_prepend_size(&values.0);
        relation.bytes(VALUES_FIELD, &packed);
        out.bytes(RELATION_FIELD, &relation.0);
    }
    file.attach(NAME, MEDIA_TYPE, &out.0)
}

fn add_value(to: &mut Out, datum: &Datum) {
    match datum {
        Datum::Null => to.0.push(NULL),
        Datum::Int(int) => {
            to.0.push(INT);
            to.0.extend(int.to_le_bytes());
        }
        Datum::Number(number) => {
            to.0.push(NUMBER);
            to.0.extend(number.to_le_bytes());
        }
        Datum::Text(text) => {
            to.0.push(TEXT);
            to.varint(text.len() as u64);
            to.0.extend(text.as_bytes());
        }
    }
}

/// The wanted relations that are attached to a file; `None` if there are none, or none that can be believed.
pub(super) fn read<F: Read + Seek>(
    file: &mut F,
    wanted: Wanted,
) -> Option<Vec<(&'static str, Rows)>> {
    let (offset, length) = found(file)?;
    file.seek(SeekFrom::Start(offset)).ok()?;
    let bytes = read_bytes(file, length)?;
    let (op::ATTACHMENT, content, []) = record(&bytes)? else {
        return None;
    };
    let (content, checksum) = content.split_last_chunk()?;
    if crc32fast::hash(content).to_le_bytes() != *checksum {
        return None;
    }
    // When it was attached and made.
    let rest = content.get(16..)?;
    let (_, rest) = text_of(rest)?;
    let (_, rest) = text_of(rest)?;
    let (_, data) = number(rest)?;
    relations(data, offset, wanted)
}

/// Where the attachment is, and how long its record is (bytes), as the index at the end of the file says.
fn found<F: Read + Seek>(file: &mut F) -> Option<(u64, u64)> {
    // An opcode, a length, two offsets and a checksum.
    const FOOTER: usize = 1 + 8 + 8 + 8 + 4;
    const END: usize = FOOTER + MAGIC.len();
    let end = file.seek(SeekFrom::End(0)).ok()?;
    let begin = end.checked_sub(END as u64)?;
    file.seek(SeekFrom::Start(begin)).ok()?;
    let bytes = read_bytes(file, END as u64)?;
    let bytes = bytes.strip_suffix(MAGIC)?;
    let (op::FOOTER, content, []) = record(bytes)? else {
        return None;
    };
    let (_, rest) = number(content)?;
    let (groups, _) = number(rest)?;
    // Where the records of each kind are.
    file.seek(SeekFrom::Start(groups)).ok()?;
    let bytes = read_bytes(file, begin.checked_sub(groups)?)?;
    let group = records(&bytes).find_map(|(opcode, content)| {
        let (kind, rest) = content.split_first()?;
        (opcode == op::SUMMARY_OFFSET && *kind == op::ATTACHMENT_INDEX).then_some(rest)
    })?;
    let (offset, rest) = number(group)?;
    let (length, _) = number(rest)?;
    file.seek(SeekFrom::Start(offset)).ok()?;
    let bytes = read_bytes(file, length)?;
    records(&bytes).find_map(|(_, content)| {
        let (offset, rest) = number(content)?;
        let (length, rest) = number(rest)?;
        // When it was attached and made, and the size of its data.
        let (name, _) = text_of(rest.get(24..)?)?;
        (name == NAME).then_some((offset, length))
    })
}

fn read_bytes(file: &mut impl Read, length: u64) -> Option<Vec<u8>> {
    if length > MAX_BYTES {
        return None;
    }
    let mut bytes = Vec::new();
    let count = file.take(length).read_to_end(&mut bytes).ok()?;
    (count as u64 == length).then_some(bytes)
}

/// Opcodes and contents of records.
fn records(mut bytes: &[u8]) -> impl Iterator<Item = (u8, &[u8])> {
    std::iter::from_fn(move || {
        let (opcode, content, rest) = record(bytes)?;
        bytes = rest;
        Some((opcode, content))
    })
}

/// Reads the relations of an attachment that begins at an offset of its file.
fn relations(mut data: &[u8], offset: u64, wanted: Wanted) -> Option<Vec<(&'static str, Rows)>> {
    let (mut is_ours, mut is_here) = (false, false);
    let mut found = Vec::new();
    while !data.is_empty() {
        let (field, content, rest) = field(data)?;
        data = rest;
        match (u32::try_from(field).ok()?, content) {
            (VERSION_FIELD, Content::Number(version)) => is_ours = version == VERSION,
            (BEGIN_FIELD, Content::Number(begin)) => is_here = begin == offset,
            (RELATION_FIELD, Content::Bytes(bytes)) if is_ours && is_here => {
                found.push(relation(bytes, wanted)?);
            }
            _ => return None,
        }
    }
    (is_ours && is_here).then_some(found)
}

fn relation(mut bytes: &[u8], wanted: Wanted) -> Option<(&'static str, Rows)> {
    let (mut name, mut columns, mut packed) = (&[][..], Vec::new(), &[][..]);
    while !bytes.is_empty() {
        let (field, content, rest) = field(bytes)?;
        bytes = rest;
        let Content::Bytes(content) = content else {
            return None;
        };
        match u32::try_from(field).ok()? {
            NAME_FIELD => name = content,
            COLUMN_FIELD => columns.push(content),
            VALUES_FIELD => packed = content,
            _ => return None,
        }
    }
    let mut known = RELATIONS.iter();
    let (name, known) = known.find(|(known, _)| known.as_bytes() == name)?;
    if !known.iter().map(|column| column.as_bytes()).eq(columns) {
        return None;
    }
    let rows = match wanted.has(name) {
        true => rows(packed, known.len())?,
        false => Vec::new(),
    };
    Some((
        name,
        Rows {
            columns: known,
            rows,
        },
    ))
}

/// Reads rows of so many columns.
fn rows(packed: &[u8], columns: usize) -> Option<Vec<Vec<Datum>>> {
    let (size, block) = packed.split_first_chunk()?;
    let size = u64::from(u32::from_le_bytes(*size));
    // A size that cannot be true costs no memory.
    if size > MAX_BYTES.min(block.len() as u64 * 256) {
        return None;
    }
    let values = lz4_flex::block::decompress(block, usize::try_from(size).ok()?).ok()?;
    let (mut rest, mut rows) = (&values[..], Vec::new());
    while !rest.is_empty() {
        let mut row = Vec::with_capacity(columns);
        for _ in 0..columns {
            let (datum, after) = value(rest)?;
            rest = after;
            row.push(datum);
        }
        rows.push(row);
    }
    Some(rows)
}

fn value(bytes: &[u8]) -> Option<(Datum, &[u8])> {
    let (kind, rest) = bytes.split_first()?;
    Some(match *kind {
        NULL => (Datum::Null, rest),
        INT => {
            let (int, rest) = rest.split_first_chunk()?;
            (Datum::Int(i64::from_le_bytes(*int)), rest)
        }
        NUMBER => {
            let (number, rest) = rest.split_first_chunk()?;
            (Datum::Number(f64::from_le_bytes(*number)), rest)
        }
        TEXT => {
            let (length, rest) = varint(rest)?;
            let (text, rest) = rest.split_at_checked(usize::try_from(length).ok()?)?;
            (Datum::Text(std::str::from_utf8(text).ok()?.into()), rest)
        }
        _ => return None,
    })
}
