//! Binary data as text for JSON (RFC 4648).

const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// The bytes as text, with padding.
pub fn base64(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let byte = |i: usize| three.get(i).map_or(0, |b| u32::from(*b));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for i in 0..4 {
            let digit = (bits >> (18 - 6 * i) & 63) as usize;
            // Six bits are a valid index into 64 digits.
            text.push(if i <= three.len() {
                char::from(DIGITS[digit])
            } else {
                '='
            });
        }
    }
    text
}

/// The bytes of a text; `None` if it is not base64 with padding.
pub(crate) fn from_base64(text: &str) -> Option<Vec<u8>> {
    let digit = |byte: u8| {
        let place = DIGITS.iter().position(|digit| *digit == byte)?;
        u32::try_from(place).ok()
    };
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    let (fours, rest) = text.as_bytes().as_chunks::<4>();
    if !rest.is_empty() {
        return None;
    }
    for (i, four) in fours.iter().enumerate() {
        let is_last = i + 1 == fours.len();
        let given = match four {
            [_, _, b'=', b'='] if is_last => 2,
            [_, _, _, b'='] if is_last => 3,
            _ => 4,
        };
        let mut bits = 0;
        for byte in four.iter().take(given) {
            bits = bits << 6 | digit(*byte)?;
        }
        bits <<= 6 * (4 - given);
        bytes.extend(bits.to_be_bytes().iter().skip(1).take(given - 1));
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use crate::watch::base64::{base64, from_base64};

    #[test]
    fn the_examples_of_the_standard_hold() {
        let texts = ["", "f", "fo", "foo", "foob", "fooba", "foobar"];
        let expected = [
            "", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy",
        ];
        assert_eq!(texts.map(|text| base64(text.as_bytes())), expected);
        for (text, expected) in texts.iter().zip(expected) {
            assert_eq!(from_base64(expected).as_deref(), Some(text.as_bytes()));
        }
        for wrong in ["Zg=", "Zg", "Z===", "Zm9=Zm9v", "Zm9?"] {
            assert_eq!(from_base64(wrong), None, "{wrong}");
        }
    }
}
