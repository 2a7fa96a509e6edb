//! A 64-bit hash of a world's state, for tests of determinism.

/// FNV-1a over the bits of numbers and text. The same on every platform.
#[derive(Clone, Copy, Debug)]
pub struct Hasher(u64);

impl Default for Hasher {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Hasher {
    /// Feeds bytes.
    pub fn bytes(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    /// Feeds text and an end marker.
    pub fn text(&mut self, text: &str) {
        self.bytes(text.as_bytes());
        self.bytes(&[0xff]);
    }

    /// Feeds an integer.
    pub fn integer(&mut self, value: u64) {
        self.bytes(&value.to_le_bytes());
    }

    /// Feeds the bits of a number.
    pub fn number(&mut self, value: f64) {
        self.integer(value.to_bits());
    }

    /// Feeds the bits of a pose.
    pub fn pose(&mut self, pose: &spatial::Pose) {
        let q = pose.rotation.quaternion();
        for number in pose.translation.vector.iter().chain(q.coords.iter()) {
            self.number(*number);
        }
    }

    /// The hash of everything fed so far.
    pub fn finish(self) -> u64 {
        self.0
    }
}
