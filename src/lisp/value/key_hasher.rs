//! The hash function of hash tables. It is fast and the same in every process; since tables are
//! iterated over in the order of insertion, it never shows.

use std::hash::Hasher;

/// An odd number with an irregular pattern of bits: 2^64 divided by the golden ratio.
const FACTOR: u64 = 0x9E37_79B9_7F4A_7C15;

/// Mixes words by multiplication; the upper half of a product is folded into the lower one, so that
/// all bits of a word reach those that choose the bucket.
#[derive(Default)]
pub(crate) struct KeyHasher(u64);

impl KeyHasher {
    #[inline]
    fn mix(&mut self, word: u64) {
        let product = u128::from(self.0.rotate_left(23) ^ word ^ FACTOR) * u128::from(FACTOR);
        self.0 = (product as u64) ^ ((product >> 64) as u64);
    }
}

impl Hasher for KeyHasher {
    #[inline]
    fn write(&mut self, bytes: &[u8]) {
        let mut words = bytes.chunks_exact(8);
        for word in &mut words {
            let mut whole = [0; 8];
            whole.copy_from_slice(word);
            self.mix(u64::from_le_bytes(whole));
        }
        let mut last = [0; 8];
        let rest = words.remainder();
        last[..rest.len()].copy_from_slice(rest);
        self.mix(u64::from_le_bytes(last) ^ ((rest.len() as u64) << 56));
    }

    #[inline]
    fn write_u8(&mut self, n: u8) {
        self.mix(u64::from(n));
    }

    #[inline]
    fn write_u32(&mut self, n: u32) {
        self.mix(u64::from(n));
    }

    #[inline]
    fn write_u64(&mut self, n: u64) {
        self.mix(n);
    }

    #[inline]
    fn write_i64(&mut self, n: i64) {
        self.mix(n as u64);
    }

    #[inline]
    fn write_usize(&mut self, n: usize) {
        self.mix(n as u64);
    }

    #[inline]
    fn finish(&self) -> u64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    fn hash_of(words: &[u64]) -> u64 {
        let mut hasher = KeyHasher::default();
        words.iter().for_each(|word| hasher.write_u64(*word));
        hasher.finish()
    }

    #[test]
    fn neighbours_spread_over_all_bits() {
        for shift in [0, 20, 40, 57] {
            let all: HashSet<u64> = (0..1000).map(|n| hash_of(&[n]) >> shift & 0x7f).collect();
            assert_eq!(all.len(), 128, "bits from {shift} on");
        }
    }

    #[test]
    fn the_order_of_words_matters() {
        assert_ne!(hash_of(&[1, 2]), hash_of(&[2, 1]));
        assert_ne!(hash_of(&[0]), hash_of(&[0, 0]));
    }
}
