//! Requests that come line by line, of bounded length.

use std::io::{self, BufRead};

/// Maximum number of bytes of a request.
pub(crate) const MAX_REQUEST: usize = 4 << 20;

/// A line has more bytes than a request may have.
pub(crate) struct TooLong;

/// The next line; `None` at the end. What is too long is read and forgotten.
pub(crate) fn next_line(input: &mut impl BufRead) -> io::Result<Option<Result<Vec<u8>, TooLong>>> {
    let mut line = Vec::new();
    let mut part = |line: &mut Vec<u8>| {
        let mut limited = io::Read::take(input.by_ref(), MAX_REQUEST as u64);
        limited.read_until(b'\n', line)
    };
    if part(&mut line)? == 0 {
        return Ok(None);
    }
    if line.last() == Some(&b'\n') || line.len() < MAX_REQUEST {
        return Ok(Some(Ok(line)));
    }
    loop {
        line.clear();
        if part(&mut line)? == 0 || line.last() == Some(&b'\n') {
            return Ok(Some(Err(TooLong)));
        }
    }
}
