//! Pictures and texts as notebooks show them.

use std::io;

use serde_json::{Value, json};

use crate::picture::Image;

/// What shows a picture: its PNG, and a text for those who cannot show that.
pub(crate) fn of_picture(picture: &Image) -> io::Result<Value> {
    let text = format!("[picture, {} × {}]", picture.width(), picture.height());
    Ok(json!({
        "data": {"image/png": base64(&picture.to_png()?), "text/plain": text},
        "metadata": {},
        "transient": {},
    }))
}

/// What shows a text that will be replaced.
pub(crate) fn of_progress(line: &str, display_id: &str) -> Value {
    json!({
        "data": {"text/plain": line},
        "metadata": {},
        "transient": {"display_id": display_id},
    })
}

/// Bytes as the text that JSON can hold (RFC 4648).
pub(crate) fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let byte = |at: usize| u32::from(chunk.get(at).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for place in 0..4 {
            match place <= chunk.len() {
                // Six bits.
                true => text.push(char::from(DIGITS[(bits >> (18 - 6 * place) & 63) as usize])),
                false => text.push('='),
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_written_as_rfc_4648_has_them() {
        for (bytes, text) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
        assert_eq!(base64(&[0xfb, 0xff, 0xfe]), "+//+");
    }
}
