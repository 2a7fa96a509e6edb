//! Messages on the wire: how a request is read, and how what a kernel says is written.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Instant, SystemTime, UNIX_EPOCH};

use serde::Deserialize;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::signature::Signer;
use super::zmtp::PeerNumber;

/// The version of the messages' protocol.
pub(crate) const PROTOCOL: &str = "5.4";
/// Stands between addresses and message.
const DELIMITER: &[u8] = b"<IDS|MSG>";
/// Frames of a message after the signature: header, parent header, metadata and content.
const PARTS: usize = 4;

/// A message from a client.
#[derive(Debug)]
pub(crate) struct Request {
    /// Who sent it.
    pub(crate) peer: PeerNumber,
    /// The identity of who sent it, which the client has on all sockets.
    pub(crate) identity: Vec<u8>,
    /// Addresses within the client, which precede the answer, too.
    envelope: Vec<Vec<u8>>,
    /// The header, as received.
    pub(crate) header: Vec<u8>,
    /// What is wanted.
    pub(crate) kind: String,
    /// What it is about.
    pub(crate) content: Value,
    /// When it came.
    pub(crate) received: Instant,
}

#[derive(Deserialize)]
struct Header {
    msg_type: String,
}

impl Request {
    /// Reads a message; `None` if it is none, its signature is wrong, or it has come before.
    pub(crate) fn read(
        signer: &Signer,
        peer: PeerNumber,
        identity: &[u8],
        mut frames: Vec<Vec<u8>>,
    ) -> Option<Request> {
        let at = frames.iter().position(|frame| frame == DELIMITER)?;
        let rest = frames.split_off(at);
        let [_, signature, header, parent, metadata, content, ..] = rest.as_slice() else {
            return None;
        };
        let parts: [&[u8]; PARTS] = [header, parent, metadata, content];
        if !signer.accept(&parts, signature) {
            return None;
        }
        let known: Header = serde_json::from_slice(header).ok()?;
        Some(Request {
            peer,
            identity: identity.to_vec(),
            envelope: frames,
            header: header.clone(),
            kind: known.msg_type,
            content: serde_json::from_slice(content).ok()?,
            received: Instant::now(),
        })
    }

    /// A text of the content; empty if there is none.
    pub(crate) fn text(&self, key: &str) -> &str {
        self.content.get(key).and_then(Value::as_str).unwrap_or("")
    }

    /// A truth value of the content.
    pub(crate) fn flag(&self, key: &str, otherwise: bool) -> bool {
        let value = self.content.get(key).and_then(Value::as_bool);
        value.unwrap_or(otherwise)
    }
}

/// Writes the messages of a kernel.
pub(crate) struct Author {
    signer: Signer,
    /// A name of this kernel that no other has.
    session: String,
    written: AtomicU64,
}

impl Author {
    /// An author whose messages are signed.
    pub(crate) fn new(signer: Signer) -> Author {
        let now = SystemTime::now().duration_since(UNIX_EPOCH);
        let nanos = now.map_or(0, |now| now.as_nanos());
        let seed = format!("{nanos} {}", std::process::id());
        let digest = Sha256::digest(seed.as_bytes());
        let digits: Vec<String> = digest[..16].iter().map(|b| format!("{b:02x}")).collect();
        Author {
            signer,
            session: digits.concat(),
            written: AtomicU64::new(0),
        }
    }

    /// The signer.
    pub(crate) fn signer(&self) -> &Signer {
        &self.signer
    }

    /// The first frame of what is published.
    pub(crate) fn topic(&self, kind: &str) -> Vec<u8> {
        format!("kernel.{}.{kind}", self.session).into_bytes()
    }

    /// A name for something that can be shown again.
    pub(crate) fn display_id(&self) -> String {
        let number = self.written.fetch_add(1, Ordering::Relaxed);
        format!("{}-display-{number}", self.session)
    }

    /// The frames of the answer to a request.
    pub(crate) fn answer(&self, request: &Request, kind: &str, content: &Value) -> Vec<Vec<u8>> {
        let mut frames = request.envelope.clone();
        frames.extend(self.message(kind, &request.header, content));
        frames
    }

    /// The frames of a message, without addresses. The parent is the header of the request that it
    /// belongs to, or empty.
    pub(crate) fn message(&self, kind: &str, parent: &[u8], content: &Value) -> Vec<Vec<u8>> {
        let number = self.written.fetch_add(1, Ordering::Relaxed);
        let now = SystemTime::now().duration_since(UNIX_EPOCH);
        let header = json!({
            "msg_id": format!("{}_{number}", self.session),
            "session": self.session,
            "username": "planwright",
            "date": timestamp(now.map_or(0, |now| now.as_micros())),
            "msg_type": kind,
            "version": PROTOCOL,
        });
        let header = header.to_string().into_bytes();
        let parent = if parent.is_empty() { b"{}" } else { parent };
        let content = content.to_string().into_bytes();
        let signature = self.signer.sign(&[&header, parent, b"{}", &content]);
        vec![
            DELIMITER.to_vec(),
            signature.into_bytes(),
            header,
            parent.to_vec(),
            b"{}".to_vec(),
            content,
        ]
    }
}

/// A moment as ISO 8601 has it, from the microseconds since 1970.
fn timestamp(micros: u128) -> String {
    const DAY: u128 = 24 * 60 * 60;
    let (seconds, micros) = (micros / 1_000_000, micros % 1_000_000);
    let (days, second) = (seconds / DAY, seconds % DAY);
    // Days are counted from 1 March 0000, so that leap days come last: eras of 400 years are alike.
    let days = days + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1_460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (month, next) = if month < 10 {
        (month + 3, 0)
    } else {
        (month - 9, 1)
    };
    let year = era * 400 + year + next;
    let (hour, minute) = (second / 3600, second / 60 % 60);
    let second = second % 60;
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}.{micros:06}Z")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_those_of_the_calendar() {
        assert_eq!(timestamp(0), "1970-01-01T00:00:00.000000Z");
        let leap = 951_827_696_000_001;
        assert_eq!(timestamp(leap), "2000-02-29T12:34:56.000001Z");
        assert_eq!(
            timestamp(1_767_225_599_999_999),
            "2025-12-31T23:59:59.999999Z"
        );
    }

    #[test]
    fn only_messages_with_the_right_signature_are_read() {
        let author = Author::new(Signer::new("key"));
        let frames = author.message("kernel_info_request", b"", &json!({"a": 1}));
        let read = |frames| Request::read(author.signer(), 1, b"me", frames);
        let request = read(frames.clone()).expect("it is signed");
        assert_eq!(
            (request.kind.as_str(), request.flag("b", true)),
            ("kernel_info_request", true)
        );
        assert!(read(frames.clone()).is_none(), "it comes again");
        for frame in 0..frames.len() {
            let mut changed = frames.clone();
            changed[frame].push(b' ');
            assert!(read(changed).is_none(), "frame {frame}");
            assert!(read(frames[..frame].to_vec()).is_none(), "cut at {frame}");
        }
    }
}
