//! Signatures of messages: who knows the key of the connection file may talk to the kernel.

use std::fmt::Write;

use hmac::{Hmac, KeyInit, Mac};
use sha2::Sha256;

/// Signs and verifies.
#[derive(Clone)]
pub(crate) struct Signer(Option<Hmac<Sha256>>);

impl Signer {
    /// With a key; nothing is signed or verified if that is empty.
    pub(crate) fn new(key: &str) -> Signer {
        let keyed = (!key.is_empty()).then(|| Hmac::new_from_slice(key.as_bytes()).ok());
        Signer(keyed.flatten())
    }

    /// The signature of parts, in hexadecimal digits.
    pub(crate) fn sign(&self, parts: &[&[u8]]) -> String {
        let Some(mac) = self.of(parts) else {
            return String::new();
        };
        let bytes = mac.finalize().into_bytes();
        bytes.iter().fold(String::new(), |mut text, byte| {
            // Writing to a string does not fail.
            let _ = write!(text, "{byte:02x}");
            text
        })
    }

    /// Whether this is the signature of parts.
    pub(crate) fn verify(&self, parts: &[&[u8]], signature: &[u8]) -> bool {
        let Some(mac) = self.of(parts) else {
            return true;
        };
        bytes_of(signature).is_some_and(|bytes| mac.verify_slice(&bytes).is_ok())
    }

    fn of(&self, parts: &[&[u8]]) -> Option<Hmac<Sha256>> {
        let mut mac = self.0.clone()?;
        parts.iter().for_each(|part| mac.update(part));
        Some(mac)
    }
}

/// The bytes that hexadecimal digits stand for.
fn bytes_of(digits: &[u8]) -> Option<Vec<u8>> {
    let pairs = digits.chunks(2).map(|pair| {
        let text = std::str::from_utf8(pair).ok().filter(|t| t.len() == 2)?;
        u8::from_str_radix(text, 16).ok()
    });
    pairs.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_signature_is_that_of_rfc_4231() {
        let signer = Signer::new("Jefe");
        let signature = signer.sign(&[b"what do ya want ", b"for nothing?"]);
        assert_eq!(
            signature,
            "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843"
        );
        let parts: [&[u8]; 1] = [b"what do ya want for nothing?"];
        assert!(signer.verify(&parts, signature.as_bytes()));
        assert!(!signer.verify(&[b"what do you want"], signature.as_bytes()));
        for wrong in ["", "5b", "zz", "é", &signature[1..]] {
            assert!(!signer.verify(&parts, wrong.as_bytes()), "{wrong}");
        }
        assert!(Signer::new("").verify(&parts, b""));
    }
}
