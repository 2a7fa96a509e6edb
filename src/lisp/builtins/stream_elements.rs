//! Elements of streams: sequences of them, bytes, and positions in files.

use std::io::{Seek as _, SeekFrom};
use std::rc::Rc;

use super::streams::{at_end, stream_of};
use super::strings::string;
use crate::builtin::Builtin;
use crate::image::Image;
use crate::stream::{self, Stream, StreamKind};
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::{Bounds, Sequence, index, text_of};

type Outcome = Result<Value, Box<Raise>>;

/// Reads characters or bytes into a sequence; the index after the last one.
///
/// `(read-sequence (make-string 2) (make-string-input-stream "abc"))` => `2`
#[builtin]
fn read_sequence(
    image: &mut Image,
    sequence: Sequence,
    stream: &Value,
    #[key] start: Option<Value>,
    #[key] end: Option<Value>,
) -> Outcome {
    let target = sequence;
    let bounds = Bounds::new(&target, start.as_ref(), end.as_ref())?;
    let end = bounds.end_of(target.len()?);
    let source = stream::input_stream(image, stream)?;
    let reads_bytes = stream::has_integers(image, &source)?;
    let read = |image: &mut Image| match reads_bytes {
        true => stream::read_byte(image, &source),
        false => Ok(stream::read_char(image, stream)?.map(Value::Char)),
    };
    let mut at = bounds.start;
    while at < end
        && let Some(element) = read(image)?
    {
        target.set(at, element)?;
        at += 1;
    }
    Ok(at.into())
}

/// Writes the characters or bytes of a sequence.
///
/// `(with-output-to-string (s) (write-sequence "hello" s :start 1 :end 3))` => `"el"`
#[builtin]
fn write_sequence(
    image: &mut Image,
    sequence: &Value,
    stream: &Value,
    #[key] start: Option<Value>,
    #[key] end: Option<Value>,
) -> Outcome {
    let source = Sequence::of(sequence)?;
    let bounds = Bounds::new(&source, start.as_ref(), end.as_ref())?;
    let items = source.items(bounds)?;
    let target = stream::output_stream(image, stream)?;
    if stream::has_integers(image, &target)? {
        for item in &items {
            stream::write_byte(image, &target, item)?;
        }
    } else {
        stream::write(image, stream, &text_of(&items)?)?;
    }
    Ok(sequence.clone())
}

/// Reads an integer from a file that was opened with an :ELEMENT-TYPE of integers.
///
/// `(handler-case (read-byte (make-string-input-stream "a")) (stream-error () 'characters))` => `CHARACTERS`
// `(read-byte stream eof-error-p eof-value)`.
#[builtin]
fn read_byte(
    image: &mut Image,
    stream: &Value,
    eof_error_p: Option<&Value>,
    eof_value: Option<&Value>,
) -> Outcome {
    match stream::read_byte(image, stream_of(stream)?)? {
        Some(byte) => Ok(byte),
        None => at_end(image, Some(stream), eof_error_p, eof_value),
    }
}

/// Writes an integer to a file that was opened with an :ELEMENT-TYPE of integers.
///
/// `(handler-case (write-byte 1 (make-string-output-stream)) (stream-error () 'characters))` => `CHARACTERS`
#[builtin]
fn write_byte(image: &mut Image, integer: &Value, stream: &Rc<Stream>) -> Outcome {
    stream::write_byte(image, stream, integer)?;
    Ok(integer.clone())
}

/// How many bytes a character or string would take in a file.
///
/// `(file-string-length *standard-output* "naïve")` => `6`
// How many bytes a character or a string takes in a file.
#[builtin]
fn file_string_length(image: &mut Image, stream: &Value, object: &Value) -> Outcome {
    let stream = stream::output_stream(image, stream)?;
    // A stream that writes nowhere takes no more than one element.
    if matches!(&*stream.kind.borrow(), StreamKind::Broadcast { targets } if targets.is_empty()) {
        return Ok(Value::Int(1));
    }
    Ok(match object {
        Value::Char(c) => c.len_utf8(),
        other => string(other)?.borrow().len(),
    }
    .into())
}

/// How far a stream has come, or sets that.
///
/// `(file-position (make-string-input-stream "x"))` => `0`
// The position in a stream: in characters, or in bytes for a stream that writes a file.
#[builtin(_, "stream &optional position")]
fn file_position(stream: &Rc<Stream>, position_value: Option<&Value>) -> Outcome {
    match (&mut *stream.kind.borrow_mut(), position_value) {
        (StreamKind::StringInput { text, position }, None) => {
            let before = text.get(..*position).unwrap_or("");
            Ok(before.chars().count().into())
        }
        (StreamKind::StringInput { text, position }, Some(new)) => {
            let count = match new {
                Value::Symbol(sym, ..) if *sym == known::K_START => 0,
                Value::Symbol(sym, ..) if *sym == known::K_END => usize::MAX,
                other => index(other)?,
            };
            let offset = text.char_indices().nth(count);
            *position = offset.map_or(text.len(), |(i, _)| i);
            Ok(Value::T)
        }
        (StreamKind::StringOutput { text }, None) => Ok(text.chars().count().into()),
        (StreamKind::FileOutput { position, .. }, None) => {
            let elements = *position / stream.width() as u64;
            Ok(i64::try_from(elements).map_or(Value::NIL, Value::Int))
        }
        (StreamKind::FileOutput { file, position, .. }, Some(new)) => {
            let target = match new {
                Value::Symbol(known::K_START, ..) => SeekFrom::Start(0),
                Value::Symbol(known::K_END, ..) => SeekFrom::End(0),
                other => SeekFrom::Start((index(other)? * stream.width()) as u64),
            };
            *position = file
                .seek(target)
                .map_err(|error| Raise::new(known::STREAM_ERROR, error.to_string()))?;
            Ok(Value::T)
        }
        (StreamKind::FileContents { position, .. }, None) => {
            Ok((*position / stream.width()).into())
        }
        (
            StreamKind::FileContents {
                bytes, position, ..
            },
            Some(new),
        ) => {
            let target = match new {
                Value::Symbol(known::K_START, ..) => 0,
                Value::Symbol(known::K_END, ..) => bytes.len(),
                other => index(other)?.saturating_mul(stream.width()),
            };
            let exists = target <= bytes.len();
            if exists {
                *position = target;
            }
            Ok(Value::bool(exists))
        }
        (StreamKind::Broadcast { targets }, None) if targets.is_empty() => Ok(Value::Int(0)),
        _ => Ok(Value::NIL),
    }
}

/// The file stream that tells the length of a stream: of several to which one writes, the last one.
fn measured(stream: &Rc<Stream>) -> Option<Rc<Stream>> {
    let mut stream = stream.clone();
    loop {
        let next = match &*stream.kind.borrow() {
            StreamKind::Broadcast { targets } => targets.last()?.clone(),
            _ => break,
        };
        stream = next;
    }
    Some(stream)
}

/// The length of the file behind a stream.
///
/// `(file-length (make-broadcast-stream))` => `0`
#[builtin(_, "stream")]
fn file_length(image: &mut Image, stream_value: &Value) -> Outcome {
    let stream = stream::followed(image, stream_of(stream_value)?)?;
    let Some(stream) = measured(&stream) else {
        return Ok(Value::Int(0));
    };
    let bytes = match &*stream.kind.borrow() {
        StreamKind::StringInput { text, .. } if stream.file.is_some() => text.len(),
        StreamKind::FileContents { bytes, .. } => bytes.len(),
        StreamKind::FileOutput { length, .. } => usize::try_from(*length).unwrap_or(usize::MAX),
        _ => return Err(Raise::type_error(stream_value, known::FILE_STREAM)),
    };
    Ok((bytes / stream.width()).into())
}

/// Elements of streams.
pub(crate) static TABLE: &[Builtin] = builtins![
    read_sequence,
    write_sequence,
    file_position,
    file_length,
    read_byte,
    write_byte,
    file_string_length,
];
