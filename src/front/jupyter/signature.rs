//! Signatures of messages: who knows the key of the connection file may talk to the kernel.

use std::collections::{HashSet, VecDeque};
use std::fmt::Write;
use std::sync::{Arc, Mutex, PoisonError};

use hmac::{Hmac, KeyInit, Mac};
use sha2::Sha256;

/// Signs and verifies.
#[derive(Clone)]
pub(crate) struct Signer {
    mac: Option<Hmac<Sha256>>,
    seen: Arc<Mutex<Seen>>,
}

/// Signatures of messages that have come, the oldest first. A message that somebody has overheard, and
/// sends again, has one of them.
#[derive(Default)]
struct Seen {
    all: HashSet<Vec<u8>>,
    in_order: VecDeque<Vec<u8>>,
}

/// How many signatures are kept.
const MAX_SEEN: usize = 1 << 16;

impl Seen {
    /// Notes a signature; returns whether it has not come before.
    fn note(&mut self, signature: Vec<u8>) -> bool {
        if !self.all.insert(signature.clone()) {
            return false;
        }
        self.in_order.push_back(signature);
        if self.in_order.len() > MAX_SEEN
            && let Some(oldest) = self.in_order.pop_front()
        {
            self.all.remove(&oldest);
        }
        true
    }
}

impl Signer {
    /// With a key; nothing is signed or verified if that is empty.
    pub(crate) fn new(key: &str) -> Signer {
        let keyed = (!key.is_empty()).then(|| Hmac::new_from_slice(key.as_bytes()).ok());
        Signer {
            mac: keyed.flatten(),
            seen: Arc::default(),
        }
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

    /// Whether this is the signature of parts that have not come before.
    pub(crate) fn accept(&self, parts: &[&[u8]], signature: &[u8]) -> bool {
        if !self.verify(parts, signature) {
            return false;
        }
        let is_signed = self.mac.is_some();
        let mut seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        !is_signed || bytes_of(signature).is_some_and(|bytes| seen.note(bytes))
    }

    fn of(&self, parts: &[&[u8]]) -> Option<Hmac<Sha256>> {
        let mut mac = self.mac.clone()?;
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

    #[test]
    fn a_message_is_accepted_once() {
        let signer = Signer::new("key");
        let parts = |n: usize| n.to_string().into_bytes();
        for n in 0..=MAX_SEEN {
            let message = parts(n);
            let signature = signer.sign(&[&message]);
            assert!(signer.accept(&[&message], signature.as_bytes()));
            let again = signature.to_uppercase();
            assert!(!signer.clone().accept(&[&message], again.as_bytes()));
        }
        let seen = signer.seen.lock().unwrap();
        assert_eq!((seen.all.len(), seen.in_order.len()), (MAX_SEEN, MAX_SEEN));
    }
}
