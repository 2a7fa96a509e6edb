//! Frames, and messages made of them.

use std::io::{self, Read};

/// Maximum number of bytes in the frames of a message that a peer sends.
pub(crate) const MAX_BYTES: u64 = 16 << 20;
/// Maximum number of frames in a message that a peer sends.
const MAX_FRAMES: usize = 256;

const MORE: u8 = 1;
const LONG: u8 = 2;
const COMMAND: u8 = 4;

/// A frame as it is received.
#[derive(Debug)]
pub(crate) struct Frame {
    /// Whether it belongs to the transport, not to a message.
    pub(crate) is_command: bool,
    /// Whether the message goes on after it.
    pub(crate) has_more: bool,
    /// Its contents.
    pub(crate) body: Vec<u8>,
}

/// Reads a frame of at most `room` bytes.
pub(crate) fn read_frame(from: &mut impl Read, room: u64) -> io::Result<Frame> {
    let [flags] = bytes(from)?;
    if flags & !(MORE | LONG | COMMAND) != 0 {
        return Err(malformed("a frame has unknown flags"));
    }
    let length = match flags & LONG == 0 {
        true => u64::from(bytes::<1>(from)?[0]),
        false => u64::from_be_bytes(bytes(from)?),
    };
    if length > room {
        return Err(malformed("a message is too long"));
    }
    let mut body = Vec::new();
    from.take(length).read_to_end(&mut body)?;
    if body.len() as u64 != length {
        return Err(io::ErrorKind::UnexpectedEof.into());
    }
    Ok(Frame {
        is_command: flags & COMMAND != 0,
        has_more: flags & MORE != 0,
        body,
    })
}

/// What a peer sends after the handshake.
#[derive(Debug)]
pub(super) enum Received {
    /// The frames of a message.
    Message(Vec<Vec<u8>>),
    /// A command of the transport.
    Command(Vec<u8>),
}

/// Reads a message of at most `room` bytes, or a command.
pub(super) fn read(from: &mut impl Read, mut room: u64) -> io::Result<Received> {
    let mut frames = Vec::new();
    loop {
        let frame = read_frame(from, room)?;
        if frame.is_command {
            return match frames.is_empty() && !frame.has_more {
                true => Ok(Received::Command(frame.body)),
                false => Err(malformed("a command is in the middle of a message")),
            };
        }
        room -= frame.body.len() as u64;
        frames.push(frame.body);
        if !frame.has_more {
            return Ok(Received::Message(frames));
        }
        if frames.len() >= MAX_FRAMES {
            return Err(malformed("a message has too many frames"));
        }
    }
}

/// A message as bytes.
pub(crate) fn encoded<F: AsRef<[u8]>>(frames: &[F]) -> Vec<u8> {
    let mut to = Vec::new();
    for (number, frame) in frames.iter().enumerate() {
        let more = if number + 1 < frames.len() { MORE } else { 0 };
        encode(&mut to, more, frame.as_ref());
    }
    to
}

/// A command as bytes.
pub(super) fn encoded_command(body: &[u8]) -> Vec<u8> {
    let mut to = Vec::new();
    encode(&mut to, COMMAND, body);
    to
}

fn encode(to: &mut Vec<u8>, flags: u8, body: &[u8]) {
    match u8::try_from(body.len()) {
        Ok(length) => to.extend([flags, length]),
        Err(_) => {
            to.push(flags | LONG);
            to.extend((body.len() as u64).to_be_bytes());
        }
    }
    to.extend(body);
}

/// The next bytes.
pub(super) fn bytes<const COUNT: usize>(from: &mut impl Read) -> io::Result<[u8; COUNT]> {
    let mut bytes = [0; COUNT];
    from.read_exact(&mut bytes)?;
    Ok(bytes)
}

pub(super) fn malformed(what: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, what.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(mut from: &[u8]) -> io::Result<Vec<Vec<u8>>> {
        match read(&mut from, MAX_BYTES)? {
            Received::Message(frames) => Ok(frames),
            Received::Command(_) => Err(malformed("a command")),
        }
    }

    #[test]
    fn messages_are_read_as_they_were_written() {
        let long = vec![7; 300];
        let message: [&[u8]; 3] = [b"", b"ab", &long];
        let read = frames(&encoded(&message)).expect("the message is whole");
        assert_eq!(read, message);
    }

    #[test]
    fn a_length_is_not_believed() {
        let announced = [&[LONG][..], &(1_u64 << 60).to_be_bytes()].concat();
        let error = frames(&announced).expect_err("it is too long");
        assert_eq!(error.kind(), io::ErrorKind::InvalidData);
        let cut = [&[LONG][..], &MAX_BYTES.to_be_bytes(), b"abc"].concat();
        let error = frames(&cut).expect_err("most of it is missing");
        assert_eq!(error.kind(), io::ErrorKind::UnexpectedEof);
    }

    #[test]
    fn a_message_without_end_is_refused() {
        let endless = [MORE, 0].repeat(2 * MAX_FRAMES);
        let error = frames(&endless).expect_err("it has too many frames");
        assert_eq!(error.kind(), io::ErrorKind::InvalidData);
    }

    #[test]
    fn commands_stand_alone() {
        let mut inside = vec![MORE, 0];
        inside.extend(encoded_command(b"\x04PING"));
        assert!(frames(&inside).is_err());
        assert!(frames(&[0x10, 0]).is_err());
    }
}
