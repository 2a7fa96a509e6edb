//! What may be a plan: a regular file of some size, in UTF-8.

use std::fs::Metadata;
use std::io::{Error, ErrorKind, Result};

/// The most bytes that a file of forms may have. The largest that people write have a few hundred
/// thousand.
pub const MAX_PLAN_BYTES: u64 = 1 << 26;

/// An error if so many bytes are more than a plan can have.
pub fn permit_plan_length(bytes: u64) -> Result<()> {
    if bytes <= MAX_PLAN_BYTES {
        return Ok(());
    }
    let most = MAX_PLAN_BYTES >> 20;
    Err(Error::new(
        ErrorKind::FileTooLarge,
        format!("it is larger than a file of forms can be, which is {most} MB"),
    ))
}

/// An error for a folder, a pipe or a device where a file was expected.
pub fn permit_regular(known: &Metadata) -> Result<()> {
    match known.file_type() {
        kind if kind.is_file() => Ok(()),
        kind if kind.is_dir() => Err(not_regular("a folder")),
        _ => Err(not_regular("a pipe or a device")),
    }
}

/// The error for something else where a file was expected.
pub(super) fn not_regular(what: &str) -> Error {
    let text = format!("it is {what}, and no regular file");
    Error::new(ErrorKind::InvalidInput, text)
}

/// The text that bytes are; an error that names the first place at which they are not UTF-8.
pub fn utf8(bytes: Vec<u8>) -> Result<String> {
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let bytes = error.as_bytes();
        let before = String::from_utf8_lossy(bytes.get(..valid).unwrap_or_default());
        let line = before.matches('\n').count() + 1;
        let last = before.rsplit_once('\n').map_or(&*before, |(_, last)| last);
        let column = last.chars().count() + 1;
        let byte = bytes.get(valid).copied().unwrap_or_default();
        Error::new(
            ErrorKind::InvalidData,
            format!("it is not UTF-8 at line {line}, column {column}: byte {byte:#04x}"),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_place_that_is_not_utf_8_is_named() {
        let error = utf8(b"(a)\n\xc3\xa9 x\xff(b)".to_vec()).unwrap_err();
        assert_eq!(
            error.to_string(),
            "it is not UTF-8 at line 2, column 4: byte 0xff"
        );
        assert_eq!(utf8("é".into()).unwrap(), "é");
    }
}
