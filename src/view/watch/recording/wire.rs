//! Protobuf's encoding of fields.

/// Bytes to which fields are added.
#[derive(Default)]
pub(super) struct Out(pub(super) Vec<u8>);

/// How the content of a field is encoded.
const VARINT: u64 = 0;
const FIXED64: u64 = 1;
const DELIMITED: u64 = 2;
const FIXED32: u64 = 5;

impl Out {
    pub(super) fn varint(&mut self, mut number: u64) {
        while number >= 0x80 {
            // The low seven bits.
            self.0.push((number & 0x7f) as u8 | 0x80);
            number >>= 7;
        }
        self.0.push(number as u8);
    }

    fn key(&mut self, number: u32, wire: u64) {
        self.varint(u64::from(number) << 3 | wire);
    }

    pub(super) fn number(&mut self, number: u32, value: u64) {
        self.key(number, VARINT);
        self.varint(value);
    }

    pub(super) fn double(&mut self, number: u32, value: f64) {
        self.key(number, FIXED64);
        self.0.extend(value.to_le_bytes());
    }

    pub(super) fn fixed32(&mut self, number: u32, value: u32) {
        self.key(number, FIXED32);
        self.0.extend(value.to_le_bytes());
    }

    pub(super) fn bytes(&mut self, number: u32, value: &[u8]) {
        self.key(number, DELIMITED);
        self.varint(value.len() as u64);
        self.0.extend(value);
    }

    pub(super) fn text(&mut self, number: u32, value: &str) {
        self.bytes(number, value.as_bytes());
    }
}

/// The content of a field.
#[derive(Clone, Copy)]
pub(super) enum Content<'a> {
    Number(u64),
    Fixed64([u8; 8]),
    Bytes(&'a [u8]),
    Fixed32([u8; 4]),
}

/// The number at the beginning, and what follows it.
pub(super) fn varint(bytes: &[u8]) -> Option<(u64, &[u8])> {
    let mut number = 0;
    for (i, byte) in bytes.iter().take(10).enumerate() {
        number |= u64::from(byte & 0x7f) << (7 * i);
        if byte & 0x80 == 0 {
            return Some((number, bytes.get(i + 1..)?));
        }
    }
    None
}

/// The field at the beginning: its number and content, and what follows it.
pub(super) fn field(bytes: &[u8]) -> Option<(u64, Content<'_>, &[u8])> {
    let (key, rest) = varint(bytes)?;
    let (content, rest) = match key & 7 {
        VARINT => {
            let (number, rest) = varint(rest)?;
            (Content::Number(number), rest)
        }
        FIXED64 => {
            let (value, rest) = rest.split_first_chunk()?;
            (Content::Fixed64(*value), rest)
        }
        DELIMITED => {
            let (length, rest) = varint(rest)?;
            let (value, rest) = rest.split_at_checked(usize::try_from(length).ok()?)?;
            (Content::Bytes(value), rest)
        }
        FIXED32 => {
            let (value, rest) = rest.split_first_chunk()?;
            (Content::Fixed32(*value), rest)
        }
        _ => return None,
    };
    Some((key >> 3, content, rest))
}
