//! Messages as bytes, which `rustdds` neither makes nor reads.

use std::convert::Infallible;

use rustdds::RepresentationIdentifier;
use rustdds::bytes::Bytes;
use rustdds::no_key::{Decode, DefaultDecoder, DeserializerAdapter, SerializerAdapter};

use crate::cdr::ByteOrder;

/// An encoded message, without the header of the encapsulation.
#[derive(Clone, Debug)]
pub(super) struct Payload {
    pub(super) bytes: Bytes,
    pub(super) order: ByteOrder,
}

impl Payload {
    /// A message of ours.
    pub(super) fn new(bytes: Vec<u8>) -> Self {
        Self {
            bytes: bytes.into(),
            order: ByteOrder::Little,
        }
    }
}

/// What hands bytes over as they are.
pub(super) struct AsBytes;

impl SerializerAdapter<Payload> for AsBytes {
    type Error = Infallible;

    fn output_encoding() -> RepresentationIdentifier {
        RepresentationIdentifier::CDR_LE
    }

    fn to_bytes(payload: &Payload) -> Result<Bytes, Infallible> {
        Ok(payload.bytes.clone())
    }
}

impl DeserializerAdapter<Payload> for AsBytes {
    type Error = Infallible;
    type Decoded = Payload;

    fn supported_encodings() -> &'static [RepresentationIdentifier] {
        &[
            RepresentationIdentifier::CDR_LE,
            RepresentationIdentifier::CDR_BE,
        ]
    }

    fn transform_decoded(decoded: Payload) -> Payload {
        decoded
    }
}

impl DefaultDecoder<Payload> for AsBytes {
    type Decoder = Taking;
    const DECODER: Taking = Taking;
}

/// Takes the bytes of a message.
#[derive(Clone)]
pub(super) struct Taking;

impl Decode<'_, Payload> for Taking {
    type Error = Infallible;

    fn decode_bytes(
        self,
        bytes: &[u8],
        encoding: RepresentationIdentifier,
    ) -> Result<Payload, Infallible> {
        let order = match encoding {
            RepresentationIdentifier::CDR_BE => ByteOrder::Big,
            _ => ByteOrder::Little,
        };
        Ok(Payload {
            bytes: Bytes::copy_from_slice(bytes),
            order,
        })
    }
}
