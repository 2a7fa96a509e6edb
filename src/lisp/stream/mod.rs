//! Reading and writing streams.
//!
//! All text that a program writes goes through [`write()`]; nothing else prints. Reading at the end
//! gives `None`; the caller decides whether that is an error.

mod bytes;

use std::io::Write as _;
use std::rc::Rc;

pub(crate) use bytes::{read_byte, write_byte};

use super::image::Image;
use super::value::Value;
use super::value::known;
use super::value::raise::Raise;
pub(crate) use super::value::stream::MAX_NESTING;
pub use super::value::stream::{Elements, Stream, StreamKind};
use super::value::symbol::Sym;

/// Defines the standard stream variables.
pub fn install(image: &mut Image) {
    let input = Rc::new(Stream::new(StreamKind::StandardInput));
    let output = Rc::new(Stream::new(StreamKind::StandardOutput));
    let both = || {
        Value::Stream(Rc::new(Stream {
            nesting: 1,
            ..Stream::new(StreamKind::TwoWay {
                input: input.clone(),
                output: output.clone(),
                echo: false,
                unread: None,
            })
        }))
    };
    image.define_special(known::V_STANDARD_INPUT, Value::Stream(input.clone()));
    for name in [known::V_STANDARD_OUTPUT, known::V_TRACE_OUTPUT] {
        image.define_special(name, Value::Stream(output.clone()));
    }
    let errors = Rc::new(Stream::new(StreamKind::ErrorOutput));
    image.define_special(known::V_ERROR_OUTPUT, Value::Stream(errors));
    for name in [known::V_TERMINAL_IO, known::V_QUERY_IO, known::V_DEBUG_IO] {
        image.define_special(name, both());
    }
}

/// The output stream that a designator denotes: `NIL` is `*standard-output*`, `T` is
/// `*terminal-io*`.
pub(crate) fn output_stream(image: &Image, designator: &Value) -> Result<Rc<Stream>, Box<Raise>> {
    designated(image, designator, known::V_STANDARD_OUTPUT)
}

/// The input stream that a designator denotes: `NIL` is `*standard-input*`, `T` is `*terminal-io*`.
pub(crate) fn input_stream(image: &Image, designator: &Value) -> Result<Rc<Stream>, Box<Raise>> {
    designated(image, designator, known::V_STANDARD_INPUT)
}

fn designated(image: &Image, designator: &Value, default: Sym) -> Result<Rc<Stream>, Box<Raise>> {
    let mut value = match designator {
        Value::Symbol(known::NIL, ..) => image.special(default),
        Value::Symbol(known::T, ..) => image.special(known::V_TERMINAL_IO),
        other => other,
    };
    // A synonym stream stands for a variable's value, which may itself be a synonym stream.
    for _ in 0..MAX_NESTING {
        let Value::Stream(stream) = value else {
            return Err(Raise::type_error(value, known::STREAM));
        };
        match &*stream.kind.borrow() {
            StreamKind::Synonym {
                symbol: Value::Symbol(symbol, _),
            } => value = image.special(*symbol),
            _ => return Ok(stream.clone()),
        }
    }
    Err(endless_synonym(value))
}

fn endless_synonym(stream: &Value) -> Box<Raise> {
    Raise::new(
        known::STREAM_ERROR,
        "A synonym stream stands for itself; bind its variable to another stream.",
    )
    .with(known::K_STREAM, stream.clone())
}

/// The value of the variable for a synonym stream; any other stream unchanged.
pub(crate) fn followed(image: &Image, stream: &Rc<Stream>) -> Result<Rc<Stream>, Box<Raise>> {
    designated(image, &Value::Stream(stream.clone()), known::NIL)
}

/// The stream that a designator denotes, if lines may break in what is written to it.
pub fn pretty(image: &Image, designator: &Value) -> Option<Rc<Stream>> {
    let stream = output_stream(image, designator).ok()?;
    stream.is_pretty().then_some(stream)
}

/// Writes a text to the stream that a designator denotes.
pub fn write(image: &mut Image, designator: &Value, text: &str) -> Result<(), Box<Raise>> {
    let stream = output_stream(image, designator)?;
    write_to(image, &stream, text, 0)
}

fn write_to(
    image: &mut Image,
    stream: &Rc<Stream>,
    text: &str,
    depth: u32,
) -> Result<(), Box<Raise>> {
    if depth > MAX_NESTING {
        return Err(endless_synonym(&Value::Stream(stream.clone())));
    }
    let stream = &followed(image, stream)?;
    let targets = match &mut *stream.kind.borrow_mut() {
        StreamKind::StandardOutput => {
            image.output.write(text);
            return Ok(());
        }
        StreamKind::ErrorOutput => {
            image.output.write_error(text);
            return Ok(());
        }
        StreamKind::StringOutput { text: collected } => {
            collected.push_str(text);
            return Ok(());
        }
        StreamKind::Pretty { document, .. } => {
            document.text(text);
            return Ok(());
        }
        StreamKind::StringTarget { string } => {
            text.chars().for_each(|c| string.push(c));
            return Ok(());
        }
        StreamKind::FileOutput { .. } | StreamKind::FileContents { .. }
            if stream.elements != Elements::Characters =>
        {
            return Err(of_bytes(stream));
        }
        StreamKind::FileContents {
            bytes,
            position,
            target: Some(target),
        } => {
            // As many characters are replaced as are written.
            let old = String::from_utf8_lossy(bytes.get(*position..).unwrap_or_default());
            let replaced: usize = old
                .chars()
                .take(text.chars().count())
                .map(char::len_utf8)
                .sum();
            let end = (*position + replaced).min(bytes.len());
            target.is_changed = true;
            bytes.splice(*position..end, text.bytes());
            *position += text.len();
            return Ok(());
        }
        StreamKind::FileOutput {
            file,
            column,
            position,
            length,
        } => {
            *column = column_after(text, *column);
            *position += text.len() as u64;
            *length = (*length).max(*position);
            return file
                .write_all(text.as_bytes())
                .map_err(|error| Raise::new(known::STREAM_ERROR, error.to_string()));
        }
        StreamKind::Broadcast { targets } => targets.clone(),
        StreamKind::TwoWay { output, .. } => vec![output.clone()],
        StreamKind::Closed => return Err(closed(stream)),
        _ => return Err(not_usable(stream, "OUTPUT-STREAM-P", image)),
    };
    for target in targets {
        write_to(image, &target, text, depth + 1)?;
    }
    Ok(())
}

fn column_after(text: &str, before: usize) -> usize {
    match text.rsplit_once('\n') {
        Some((_, last)) => last.chars().count(),
        None => before + text.chars().count(),
    }
}

/// Number of characters on the current line of an output stream, if that is known.
pub fn column(image: &Image, designator: &Value) -> Result<Option<usize>, Box<Raise>> {
    let mut stream = output_stream(image, designator)?;
    for _ in 0..=MAX_NESTING {
        let next = match &*stream.kind.borrow() {
            StreamKind::StandardOutput | StreamKind::ErrorOutput => {
                return Ok(Some(image.output.column()));
            }
            StreamKind::StringOutput { text } => return Ok(Some(column_after(text, 0))),
            StreamKind::Pretty { document, start } => return Ok(Some(document.column(*start))),
            StreamKind::StringTarget { string } => {
                return Ok(Some(column_after(&string.borrow(), 0)));
            }
            StreamKind::FileOutput { column, .. } => return Ok(Some(*column)),
            StreamKind::Broadcast { targets } => match targets.last() {
                Some(last) => last.clone(),
                None => return Ok(Some(0)),
            },
            StreamKind::TwoWay { output, .. } => output.clone(),
            StreamKind::Closed => return Err(closed(&stream)),
            _ => return Ok(None),
        };
        stream = followed(image, &next)?;
    }
    Ok(None)
}

/// Starts a new line unless the stream is at the start of one; returns whether it did.
pub fn fresh_line(image: &mut Image, designator: &Value) -> Result<bool, Box<Raise>> {
    let needed = column(image, designator)?.is_none_or(|column| column > 0);
    if needed {
        write(image, designator, "\n")?;
    }
    Ok(needed)
}

/// Reads a character; `None` at the end.
pub(crate) fn read_char(image: &mut Image, designator: &Value) -> Result<Option<char>, Box<Raise>> {
    let c = peek_char(image, designator)?;
    if let Some(c) = c {
        advance(image, designator, c.len_utf8())?;
    }
    Ok(c)
}

/// Returns the next character without reading it; `None` at the end.
pub(crate) fn peek_char(image: &Image, designator: &Value) -> Result<Option<char>, Box<Raise>> {
    let stream = input_stream(image, designator)?;
    peek_at(image, &stream, 0)
}

fn peek_at(image: &Image, stream: &Rc<Stream>, depth: u32) -> Result<Option<char>, Box<Raise>> {
    if depth > MAX_NESTING {
        return Err(endless_synonym(&Value::Stream(stream.clone())));
    }
    let stream = &followed(image, stream)?;
    let inputs = match &*stream.kind.borrow() {
        StreamKind::StandardInput => {
            let text = image.input.text(image.output.pending());
            return Ok(text.chars().next());
        }
        StreamKind::StringInput { text, position } => {
            return Ok(text.get(*position..).and_then(|rest| rest.chars().next()));
        }
        StreamKind::FileContents { .. } if stream.elements != Elements::Characters => {
            return Err(of_bytes(stream));
        }
        StreamKind::FileContents {
            bytes, position, ..
        } => return Ok(next_char(bytes.get(*position..).unwrap_or_default())),
        StreamKind::TwoWay {
            unread: Some(c), ..
        }
        | StreamKind::Concatenated {
            unread: Some(c), ..
        } => return Ok(Some(*c)),
        StreamKind::TwoWay { input, .. } => vec![input.clone()],
        StreamKind::Concatenated { inputs, .. } => inputs.clone(),
        StreamKind::Closed => return Err(closed(stream)),
        _ => return Err(not_usable(stream, "INPUT-STREAM-P", image)),
    };
    for input in inputs {
        if let Some(c) = peek_at(image, &input, depth + 1)? {
            return Ok(Some(c));
        }
    }
    Ok(None)
}

/// Is the stream standard input, perhaps by way of a stream for both directions?
pub(crate) fn is_standard_input(image: &Image, designator: &Value) -> bool {
    let Ok(mut stream) = input_stream(image, designator) else {
        return false;
    };
    for _ in 0..=MAX_NESTING {
        let next = match &*stream.kind.borrow() {
            StreamKind::StandardInput => return true,
            StreamKind::TwoWay { input, .. } => input.clone(),
            _ => return false,
        };
        stream = match followed(image, &next) {
            Ok(next) => next,
            Err(_) => return false,
        };
    }
    false
}

/// The unread text of an input stream: a text and the byte offset at which the unread part begins.
/// [`advance`] records how much of it was read.
pub fn rest(image: &Image, designator: &Value) -> Result<(Rc<str>, usize), Box<Raise>> {
    let stream = input_stream(image, designator)?;
    if let StreamKind::StringInput { text, position } = &*stream.kind.borrow() {
        return Ok((text.clone(), *position));
    }
    let mut text = String::new();
    rest_of(image, &stream, &mut text, 0)?;
    Ok((text.into(), 0))
}

fn rest_of(
    image: &Image,
    stream: &Rc<Stream>,
    collected: &mut String,
    depth: u32,
) -> Result<(), Box<Raise>> {
    if depth > MAX_NESTING {
        return Err(endless_synonym(&Value::Stream(stream.clone())));
    }
    let stream = &followed(image, stream)?;
    let inputs = match &*stream.kind.borrow() {
        StreamKind::StandardInput => {
            collected.push_str(&image.input.text(image.output.pending()));
            return Ok(());
        }
        StreamKind::StringInput { text, position } => {
            collected.push_str(text.get(*position..).unwrap_or(""));
            return Ok(());
        }
        StreamKind::FileContents { .. } if stream.elements != Elements::Characters => {
            return Err(of_bytes(stream));
        }
        StreamKind::FileContents {
            bytes, position, ..
        } => {
            let rest = bytes.get(*position..).unwrap_or_default();
            collected.push_str(&String::from_utf8_lossy(rest));
            return Ok(());
        }
        StreamKind::TwoWay { input, unread, .. } => {
            collected.extend(unread);
            vec![input.clone()]
        }
        StreamKind::Concatenated { inputs, unread } => {
            collected.extend(unread);
            inputs.clone()
        }
        StreamKind::Closed => return Err(closed(stream)),
        _ => return Err(not_usable(stream, "INPUT-STREAM-P", image)),
    };
    inputs
        .iter()
        .try_for_each(|input| rest_of(image, input, collected, depth + 1))
}

/// Marks `bytes` bytes of the text from [`rest`] as read.
pub fn advance(image: &mut Image, designator: &Value, bytes: usize) -> Result<(), Box<Raise>> {
    let stream = input_stream(image, designator)?;
    advance_in(image, &stream, bytes, 0).map(drop)
}

/// Returns the part of `bytes` that goes beyond the stream's text.
fn advance_in(
    image: &mut Image,
    stream: &Rc<Stream>,
    bytes: usize,
    depth: u32,
) -> Result<usize, Box<Raise>> {
    if bytes == 0 {
        return Ok(0);
    }
    if depth > MAX_NESTING {
        return Err(endless_synonym(&Value::Stream(stream.clone())));
    }
    let stream = &followed(image, stream)?;
    let mut left = bytes;
    let (input, echo_to) = match &mut *stream.kind.borrow_mut() {
        StreamKind::StandardInput => return Ok(image.input.advance(bytes)),
        StreamKind::StringInput { text, position } => {
            let available = text.len().saturating_sub(*position);
            let step = available.min(bytes);
            *position += step;
            return Ok(bytes - step);
        }
        StreamKind::FileContents {
            bytes: contents,
            position,
            ..
        } => {
            let step = contents.len().saturating_sub(*position).min(bytes);
            *position += step;
            return Ok(bytes - step);
        }
        StreamKind::TwoWay {
            input,
            output,
            echo,
            unread,
        } => {
            if let Some(c) = unread.take() {
                left = left.saturating_sub(c.len_utf8());
            }
            (vec![input.clone()], echo.then(|| output.clone()))
        }
        StreamKind::Concatenated { inputs, unread } => {
            if let Some(c) = unread.take() {
                left = left.saturating_sub(c.len_utf8());
            }
            (inputs.clone(), None)
        }
        _ => return Ok(bytes),
    };
    if let Some(output) = echo_to {
        let mut text = String::new();
        input
            .iter()
            .try_for_each(|input| rest_of(image, input, &mut text, depth + 1))?;
        let shown = text.get(..left.min(text.len())).unwrap_or("");
        write_to(image, &output, shown, depth + 1)?;
    }
    for part in &input {
        left = advance_in(image, part, left, depth + 1)?;
    }
    drop_used_up(image, stream, depth)?;
    Ok(left)
}

/// Drops the exhausted parts of a concatenated stream.
fn drop_used_up(image: &Image, stream: &Rc<Stream>, depth: u32) -> Result<(), Box<Raise>> {
    let inputs = match &*stream.kind.borrow() {
        StreamKind::Concatenated { inputs, .. } => inputs.clone(),
        _ => return Ok(()),
    };
    let mut used_up = 0_usize;
    for input in &inputs {
        if peek_at(image, input, depth + 1)?.is_some() {
            break;
        }
        used_up += 1;
    }
    if let StreamKind::Concatenated { inputs, .. } = &mut *stream.kind.borrow_mut() {
        inputs.drain(..used_up.min(inputs.len()));
    }
    Ok(())
}

/// Puts back the character that was read last.
pub(crate) fn unread_char(
    image: &mut Image,
    designator: &Value,
    c: char,
) -> Result<(), Box<Raise>> {
    let mut stream = input_stream(image, designator)?;
    for _ in 0..=MAX_NESTING {
        let next = match &mut *stream.kind.borrow_mut() {
            StreamKind::StringInput { text, position } => {
                let before = position.checked_sub(c.len_utf8());
                return match before.filter(|p| text.get(*p..).is_some_and(|t| t.starts_with(c))) {
                    Some(p) => {
                        *position = p;
                        Ok(())
                    }
                    None => Err(Raise::new(
                        known::STREAM_ERROR,
                        format!("The character {c} was not read last, so it cannot be given back."),
                    )),
                };
            }
            StreamKind::FileContents { position, .. } => {
                *position = position.saturating_sub(c.len_utf8());
                return Ok(());
            }
            StreamKind::TwoWay {
                unread, echo: true, ..
            }
            | StreamKind::Concatenated { unread, .. } => {
                *unread = Some(c);
                return Ok(());
            }
            StreamKind::TwoWay { input, .. } => input.clone(),
            StreamKind::StandardInput => {
                image.input.put_back(c);
                return Ok(());
            }
            StreamKind::Closed => return Err(closed(&stream)),
            _ => return Err(not_usable(&stream, "INPUT-STREAM-P", image)),
        };
        stream = followed(image, &next)?;
    }
    Err(endless_synonym(&Value::Stream(stream)))
}

/// Does a stream read or write integers, perhaps by way of other streams?
pub(crate) fn has_integers(image: &Image, stream: &Rc<Stream>) -> Result<bool, Box<Raise>> {
    let mut stream = followed(image, stream)?;
    for _ in 0..=MAX_NESTING {
        let next = match &*stream.kind.borrow() {
            StreamKind::TwoWay { input, .. } => input.clone(),
            StreamKind::Broadcast { targets: parts }
            | StreamKind::Concatenated { inputs: parts, .. } => match parts.first() {
                Some(first) => first.clone(),
                // Nothing is at its end, and takes everything.
                None => return Ok(true),
            },
            _ => return Ok(stream.elements != Elements::Characters),
        };
        stream = followed(image, &next)?;
    }
    Ok(false)
}

/// Flushes the buffer of a file stream.
pub fn flush(stream: &Stream) -> Result<(), Box<Raise>> {
    match &mut *stream.kind.borrow_mut() {
        StreamKind::FileOutput { file, .. } => file
            .flush()
            .map_err(|error| Raise::new(known::STREAM_ERROR, error.to_string())),
        StreamKind::FileContents {
            bytes,
            target: Some(target),
            ..
        } if target.is_changed => {
            if let Some(file) = &stream.file {
                let written = target.files.write(file, bytes);
                written.map_err(|error| Raise::new(known::STREAM_ERROR, error.to_string()))?;
            }
            target.is_changed = false;
            Ok(())
        }
        _ => Ok(()),
    }
}

/// Closes a stream; returns whether it was open.
pub fn close(stream: &Stream) -> Result<bool, Box<Raise>> {
    flush(stream)?;
    let mut kind = stream.kind.borrow_mut();
    let was_open = !matches!(*kind, StreamKind::Closed);
    // The streams of the session stay open.
    if !matches!(
        *kind,
        StreamKind::StandardOutput | StreamKind::ErrorOutput | StreamKind::StandardInput
    ) {
        *kind = StreamKind::Closed;
    }
    Ok(was_open)
}

/// The first character of a text in UTF-8; `None` if it is empty.
fn next_char(bytes: &[u8]) -> Option<char> {
    let start = bytes.get(..bytes.len().min(4)).unwrap_or_default();
    String::from_utf8_lossy(start).chars().next()
}

/// The error for a file whose elements are no characters.
fn of_bytes(stream: &Rc<Stream>) -> Box<Raise> {
    Raise::new(
        known::STREAM_ERROR,
        "The elements of the stream are integers, not characters; READ-BYTE and WRITE-BYTE are for these.",
    )
    .with(known::K_STREAM, Value::Stream(stream.clone()))
}

fn closed(stream: &Rc<Stream>) -> Box<Raise> {
    Raise::new(known::STREAM_ERROR, "The stream is closed.")
        .with(known::K_STREAM, Value::Stream(stream.clone()))
}

pub(crate) fn not_usable(stream: &Rc<Stream>, predicate: &str, image: &Image) -> Box<Raise> {
    let stream = Value::Stream(stream.clone());
    let predicate = image
        .packages
        .find_symbol(crate::value::package::PackageTable::CL, predicate);
    match predicate {
        Some((sym, _)) => {
            Raise::type_error(&stream, Value::list([known::SATISFIES.into(), sym.into()]))
        }
        None => Raise::type_error(&stream, known::STREAM),
    }
}
