//! How two peers begin: a greeting, then a command that says what socket each is.

use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use super::frame::{bytes, encoded_command, malformed, read_frame};
use super::socket::Kind;

/// How long a peer may take.
const PATIENCE: Duration = Duration::from_secs(5);
/// Maximum number of bytes in a peer's command.
const MAX_BYTES: u64 = 4096;
/// Bytes of a greeting.
const GREETING: usize = 64;

/// Greets a peer; returns its identity, which is empty if it has none.
pub(super) fn greet(stream: &TcpStream, kind: Kind) -> io::Result<Vec<u8>> {
    let mut hurried = Hurried {
        stream,
        until: Instant::now() + PATIENCE,
    };
    stream.set_write_timeout(Some(PATIENCE))?;
    let mut to = stream;
    to.write_all(&greeting())?;
    let theirs: [u8; GREETING] = bytes(&mut hurried)?;
    let is_null = theirs[12..32].starts_with(b"NULL\0");
    if theirs[0] != 0xff || theirs[9] & 1 == 0 || theirs[10] < 3 || !is_null {
        return Err(malformed(
            "the peer does not speak ZMTP 3 without encryption",
        ));
    }
    to.write_all(&encoded_command(&ready(kind)))?;
    let frame = read_frame(&mut hurried, MAX_BYTES)?;
    let properties = frame.body.strip_prefix(b"\x05READY");
    let properties = properties.filter(|_| frame.is_command);
    let Some(properties) = properties.and_then(properties_of) else {
        return Err(malformed("the peer is not ready"));
    };
    let property = |wanted: &str| {
        let mut found = properties.iter();
        let found = found.find(|(name, _)| name.eq_ignore_ascii_case(wanted.as_bytes()));
        found.map(|(_, value)| *value)
    };
    let theirs = property("Socket-Type").unwrap_or_default();
    if !kind.peers().iter().any(|peer| peer.as_bytes() == theirs) {
        return Err(malformed("the peer is no counterpart of this socket"));
    }
    stream.set_read_timeout(None)?;
    stream.set_write_timeout(None)?;
    Ok(property("Identity").unwrap_or_default().to_vec())
}

fn greeting() -> [u8; GREETING] {
    let mut greeting = [0; GREETING];
    greeting[0] = 0xff;
    greeting[9] = 0x7f;
    greeting[10] = 3;
    greeting[12..16].copy_from_slice(b"NULL");
    greeting
}

fn ready(kind: Kind) -> Vec<u8> {
    let mut body = b"\x05READY\x0bSocket-Type".to_vec();
    let name = kind.name().as_bytes();
    // The names are short.
    body.extend((name.len() as u32).to_be_bytes());
    body.extend(name);
    body
}

/// Names and values.
fn properties_of(mut rest: &[u8]) -> Option<Vec<(&[u8], &[u8])>> {
    let mut properties = Vec::new();
    while let Some((length, after)) = rest.split_first() {
        let (name, after) = after.split_at_checked(usize::from(*length))?;
        let (length, after) = after.split_first_chunk::<4>()?;
        let length = usize::try_from(u32::from_be_bytes(*length)).ok()?;
        let (value, after) = after.split_at_checked(length)?;
        properties.push((name, value));
        rest = after;
    }
    Some(properties)
}

/// Reads until a moment, however slowly the bytes come.
struct Hurried<'a> {
    stream: &'a TcpStream,
    until: Instant,
}

impl Read for Hurried<'_> {
    fn read(&mut self, to: &mut [u8]) -> io::Result<usize> {
        let left = self.until.saturating_duration_since(Instant::now());
        if left.is_zero() {
            return Err(io::ErrorKind::TimedOut.into());
        }
        self.stream.set_read_timeout(Some(left))?;
        let mut stream = self.stream;
        stream.read(to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn properties_end_where_they_say() {
        let body = ready(Kind::Router);
        let properties = properties_of(&body[6..]);
        assert_eq!(
            properties,
            Some(vec![(&b"Socket-Type"[..], &b"ROUTER"[..])])
        );
        for length in 1..body.len() - 6 {
            assert_eq!(properties_of(&body[6..6 + length]), None, "{length}");
        }
    }
}
