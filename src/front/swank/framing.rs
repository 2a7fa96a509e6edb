//! Messages on a connection: six hexadecimal digits, the number of bytes that follow, and these.

use std::io::{self, Read};

/// Number of digits.
const DIGITS: usize = 6;
/// The longest message: what the digits can say.
pub(super) const LONGEST: usize = 0xff_ffff;

/// Reads a message; `None` at the end of the connection.
pub(super) fn read(from: &mut impl Read) -> io::Result<Option<String>> {
    read_at_most(from, LONGEST)
}

/// Reads a message of so many bytes at most; `None` at the end of the connection. Bytes that are not
/// UTF-8 become replacement characters.
///
/// # Errors
///
/// A connection that ends in the middle of a message, or on which something else than a message
/// was sent, is an error; nothing that follows could be understood.
pub(super) fn read_at_most(from: &mut impl Read, most: usize) -> io::Result<Option<String>> {
    let mut digits = Vec::with_capacity(DIGITS);
    from.take(DIGITS as u64).read_to_end(&mut digits)?;
    if digits.is_empty() {
        return Ok(None);
    }
    let length = length(&digits).ok_or_else(|| {
        io::Error::new(
            io::ErrorKind::InvalidData,
            "a message begins with its length",
        )
    })?;
    if length > most as u64 {
        return Err(io::Error::new(
            io::ErrorKind::InvalidData,
            "the message is too long",
        ));
    }
    // The memory grows with what arrives, not with what is announced.
    let mut bytes = Vec::new();
    from.take(length).read_to_end(&mut bytes)?;
    if bytes.len() as u64 != length {
        return Err(io::ErrorKind::UnexpectedEof.into());
    }
    Ok(Some(String::from_utf8_lossy(&bytes).into_owned()))
}

fn length(digits: &[u8]) -> Option<u64> {
    if digits.len() != DIGITS || !digits.iter().all(u8::is_ascii_hexdigit) {
        return None;
    }
    u64::from_str_radix(std::str::from_utf8(digits).ok()?, 16).ok()
}

/// A text as a message; `None` if it is too long for one.
pub(super) fn framed(text: &str) -> Option<Vec<u8>> {
    (text.len() <= LONGEST).then(|| format!("{:06x}{text}", text.len()).into_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_length_counts_bytes() {
        let message = framed("(:write-string \"äöü→ π 𝒳\")").unwrap();
        assert!(message.starts_with(b"000023("));
        let read = read(&mut message.as_slice()).unwrap();
        assert_eq!(read.as_deref(), Some("(:write-string \"äöü→ π 𝒳\")"));
    }

    #[test]
    fn what_is_no_message_is_an_error() {
        assert!(matches!(read(&mut &b""[..]), Ok(None)));
        for bytes in [
            &b"GET / HTTP/1.1\r\n"[..],
            b"00000",
            b"00000gx",
            b"+0000ax",
            b"00000cab",
        ] {
            assert!(read(&mut &*bytes).is_err(), "{bytes:?}");
        }
        assert!(read(&mut &b"ffffff("[..]).is_err());
    }
}
