//! Reading and writing integers: files whose elements are no characters.

use std::io::Write as _;
use std::rc::Rc;

use num_bigint::{BigInt, Sign};

use super::{StreamKind, closed, followed, has_integers, not_usable};
use crate::image::Image;
use crate::value::Value;
use crate::value::known;
use crate::value::number::from_big;
use crate::value::raise::Raise;
use crate::value::stream::{Elements, Stream};

/// Reads an integer; `None` at the end.
pub(crate) fn read_byte(image: &Image, stream: &Rc<Stream>) -> Result<Option<Value>, Box<Raise>> {
    let stream = &followed(image, stream)?;
    if !has_integers(image, stream)? {
        return Err(of_characters(stream, image, "INPUT-STREAM-P"));
    }
    let inputs = match (&mut *stream.kind.borrow_mut(), stream.elements) {
        (
            StreamKind::FileContents {
                bytes, position, ..
            },
            Elements::Integers { signed, .. },
        ) => {
            let end = *position + stream.width();
            let Some(taken) = bytes.get(*position..end) else {
                return Ok(None);
            };
            let number = if signed {
                BigInt::from_signed_bytes_le(taken)
            } else {
                BigInt::from_bytes_le(Sign::Plus, taken)
            };
            *position = end;
            return Ok(Some(from_big(number)));
        }
        (StreamKind::TwoWay { input, .. }, _) => vec![input.clone()],
        (StreamKind::Concatenated { inputs, .. }, _) => inputs.clone(),
        (StreamKind::Closed, _) => return Err(closed(stream)),
        _ => return Err(not_usable(stream, "INPUT-STREAM-P", image)),
    };
    for input in inputs {
        if let Some(byte) = read_byte(image, &input)? {
            if let StreamKind::TwoWay {
                echo: true, output, ..
            } = &*stream.kind.borrow()
            {
                write_byte(image, output, &byte)?;
            }
            return Ok(Some(byte));
        }
    }
    Ok(None)
}

/// Writes an integer.
pub(crate) fn write_byte(
    image: &Image,
    stream: &Rc<Stream>,
    byte: &Value,
) -> Result<(), Box<Raise>> {
    let stream = &followed(image, stream)?;
    if !has_integers(image, stream)? {
        return Err(of_characters(stream, image, "OUTPUT-STREAM-P"));
    }
    let targets = match (&mut *stream.kind.borrow_mut(), stream.elements) {
        (
            StreamKind::FileOutput {
                file,
                position,
                length,
                ..
            },
            Elements::Integers { bits, signed },
        ) => {
            let bytes = encoded(byte, bits, signed, stream.width())?;
            *position += bytes.len() as u64;
            *length = (*length).max(*position);
            return file
                .write_all(&bytes)
                .map_err(|error| Raise::new(known::STREAM_ERROR, error.to_string()));
        }
        (
            StreamKind::FileContents {
                bytes,
                position,
                target: Some(target),
            },
            Elements::Integers { bits, signed },
        ) => {
            let new = encoded(byte, bits, signed, stream.width())?;
            let end = (*position + new.len()).min(bytes.len());
            target.is_changed = true;
            bytes.splice(*position..end, new.iter().copied());
            *position += new.len();
            return Ok(());
        }
        (StreamKind::TwoWay { output, .. }, _) => vec![output.clone()],
        (StreamKind::Broadcast { targets }, _) => targets.clone(),
        (StreamKind::Closed, _) => return Err(closed(stream)),
        _ => return Err(not_usable(stream, "OUTPUT-STREAM-P", image)),
    };
    targets
        .iter()
        .try_for_each(|target| write_byte(image, target, byte))
}

/// The bytes of an integer, the low one first.
fn encoded(byte: &Value, bits: u32, signed: bool, width: usize) -> Result<Vec<u8>, Box<Raise>> {
    let number = match byte {
        Value::Int(n) => Some(BigInt::from(*n)),
        Value::Big(n) => Some(n.as_ref().clone()),
        _ => None,
    };
    let fits = |n: &BigInt| {
        if signed {
            let limit = BigInt::from(1) << (bits - 1);
            *n >= -limit.clone() && *n < limit
        } else {
            n.sign() != Sign::Minus && n.bits() <= u64::from(bits)
        }
    };
    let Some(number) = number.filter(fits) else {
        let name = if signed {
            known::SIGNED_BYTE
        } else {
            known::UNSIGNED_BYTE
        };
        let expected = Value::list([name.into(), Value::Int(bits.into())]);
        return Err(Raise::type_error(byte, expected));
    };
    let filler = if number.sign() == Sign::Minus {
        0xff
    } else {
        0
    };
    let mut bytes = number.to_signed_bytes_le();
    bytes.resize(width, filler);
    Ok(bytes)
}

/// The error for a stream that reads or writes characters, or nothing.
fn of_characters(stream: &Rc<Stream>, image: &Image, predicate: &str) -> Box<Raise> {
    if matches!(&*stream.kind.borrow(), StreamKind::Closed) {
        return closed(stream);
    }
    let usable = if predicate.starts_with("INPUT") {
        stream.is_input()
    } else {
        stream.is_output()
    };
    if !usable {
        return not_usable(stream, predicate, image);
    }
    Raise::new(
        known::STREAM_ERROR,
        "The elements of the stream are characters, not bytes; give OPEN an :ELEMENT-TYPE such as (UNSIGNED-BYTE 8).",
    )
    .with(known::K_STREAM, Value::Stream(stream.clone()))
}
