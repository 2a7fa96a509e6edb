//! Words that cannot be guessed.

use std::fmt::Write;
use std::hash::{BuildHasher, Hasher, RandomState};

use sha2::{Digest, Sha256};

/// A random word of 32 hexadecimal digits.
///
/// The standard library seeds each thread's hash keys from the operating system's source of
/// randomness, so hashes under these keys are unpredictable.
pub fn random_word() -> String {
    let mut word = String::new();
    for _ in 0..2 {
        let mut hasher = RandomState::new().build_hasher();
        hasher.write_u8(b'w');
        // Writing to a string cannot fail.
        let _ = write!(word, "{:016x}", hasher.finish());
    }
    word
}

/// A word of 32 hexadecimal digits that belongs to a text: the first half of its SHA-256. The same text
/// has the same word everywhere, and nobody knows how to write one that contains its own.
pub(super) fn word_of(text: &str) -> String {
    let digest = Sha256::digest(text.as_bytes());
    let mut word = String::new();
    for byte in digest.iter().take(16) {
        // Writing to a string cannot fail.
        let _ = write!(word, "{byte:02x}");
    }
    word
}

/// Whether the two are equal, in a time that does not depend on where they differ.
pub fn is_same(a: &[u8], b: &[u8]) -> bool {
    let differences = a.iter().zip(b).fold(0, |all, (x, y)| all | (x ^ y));
    a.len() == b.len() && differences == 0
}

#[cfg(test)]
mod tests {
    use crate::watch::live::token::*;

    #[test]
    fn words_are_long_and_differ() {
        let words = [random_word(), random_word()];
        assert!(words.iter().all(|w| w.len() == 32));
        assert_ne!(words[0], words[1]);
    }

    /// The digest of "abc" is an example of FIPS 180-4.
    #[test]
    fn a_text_has_the_same_word_everywhere() {
        assert_eq!(word_of("abc"), "ba7816bf8f01cfea414140de5dae2223");
    }

    #[test]
    fn only_equal_words_are_the_same() {
        assert!(is_same(b"abc", b"abc"));
        assert!(!is_same(b"abc", b"abd") && !is_same(b"abc", b"ab") && !is_same(b"", b"a"));
    }
}
