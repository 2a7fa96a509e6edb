//! Streams: reading characters, their state.

use std::rc::Rc;

use crate::builtin::Builtin;
use crate::image::Image;
use crate::stream::{self, Elements, Stream, StreamKind};
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::step::Step;

type Outcome = Result<Value, Box<Raise>>;

pub(super) fn stream_of(value: &Value) -> Result<&Rc<Stream>, Box<Raise>> {
    match value {
        Value::Stream(stream) => Ok(stream),
        _ => Err(Raise::type_error(value, known::STREAM)),
    }
}

/// What a builtin that may call functions does after an error: if that is about an object that was
/// given as a stream, what its methods do takes the builtin's place.
pub(crate) fn or_method(
    raise: Box<Raise>,
    name: Sym,
    args: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    match raise.stream_object() {
        Some(stream) => Ok(Step::tail_call(
            known::SYS_CALL_STREAM_METHOD,
            vec![name.into(), Value::list(args), stream.clone()],
        )),
        None => Err(raise),
    }
}

/// Is the object a stream?
///
/// `(streamp *standard-output*)` => `T`
#[builtin]
fn streamp(object: &Value) -> bool {
    match object {
        Value::Stream(_) => true,
        Value::Instance(instance) => instance.is_a(known::STREAM),
        _ => false,
    }
}

/// Can the stream be read?
///
/// `(input-stream-p (make-string-input-stream "x"))` => `T`
#[builtin]
fn input_stream_p(image: &mut Image, stream: &Rc<Stream>) -> Outcome {
    let stream = stream::followed(image, stream)?;
    Ok(Value::bool(stream.is_input()))
}

/// Can the stream be written?
///
/// `(output-stream-p (make-string-input-stream "x"))` => `NIL`
#[builtin]
fn output_stream_p(image: &mut Image, stream: &Rc<Stream>) -> Outcome {
    let stream = stream::followed(image, stream)?;
    Ok(Value::bool(stream.is_output()))
}

/// Is somebody at the other end?
///
/// `(interactive-stream-p *standard-input*)` => `NIL`
#[builtin]
fn interactive_stream_p(stream: &Value) -> Outcome {
    stream_of(stream).map(|_| Value::NIL)
}

/// Is the stream open?
///
/// `(open-stream-p (make-string-input-stream "x"))` => `T`
#[builtin]
fn open_stream_p(stream: &Rc<Stream>) -> bool {
    !matches!(&*stream.kind.borrow(), StreamKind::Closed)
}

/// The type of what the stream carries.
///
/// `(stream-element-type (make-string-input-stream "x"))` => `CHARACTER`
#[builtin]
fn stream_element_type(stream: &Rc<Stream>) -> Outcome {
    Ok(match stream.elements {
        Elements::Characters => known::CHARACTER.into(),
        Elements::Integers { bits, signed } => {
            let name = if signed {
                known::SIGNED_BYTE
            } else {
                known::UNSIGNED_BYTE
            };
            Value::list([name.into(), Value::Int(bits.into())])
        }
    })
}

/// How characters are encoded in files: UTF-8.
///
/// `(stream-external-format (make-string-input-stream "x"))` => `:DEFAULT`
#[builtin("STREAM-EXTERNAL-FORMAT")]
fn external_format(image: &mut Image, _stream: &Rc<Stream>) -> Outcome {
    Ok(image.keyword("DEFAULT").into())
}

/// Closes a stream; was it open?
///
/// `(close (make-string-input-stream "x"))` => `T`
#[builtin]
fn close(stream: &Rc<Stream>, #[key] _abort: Option<&Value>) -> Result<bool, Box<Raise>> {
    stream::close(stream)
}

/// Writes out what is held back.
///
/// `(finish-output)` => `NIL`
// Flushes the buffer of a file stream.
#[builtin]
fn finish_output(image: &mut Image, stream: Option<&Value>) -> Outcome {
    let target = stream.unwrap_or(&Value::NIL);
    let stream = stream::output_stream(image, target)?;
    stream::flush(&stream)?;
    image.output.finish();
    Ok(Value::NIL)
}

/// Does nothing: no input waits.
///
/// `(clear-input)` => `NIL`
#[builtin]
fn clear_input(image: &mut Image, stream: Option<&Value>) -> Outcome {
    stream::input_stream(image, stream.unwrap_or(&Value::NIL))?;
    Ok(Value::NIL)
}

/// The result of reading at the end: the end-of-file value, or an error.
pub fn at_end(
    image: &Image,
    stream: Option<&Value>,
    error: Option<&Value>,
    value: Option<&Value>,
) -> Outcome {
    if error.is_some_and(Value::is_nil) {
        return Ok(value.cloned().unwrap_or(Value::NIL));
    }
    let stream = stream::input_stream(image, stream.unwrap_or(&Value::NIL))?;
    let stream = Value::Stream(stream);
    Err(Raise::new(
        known::END_OF_FILE,
        format!("end of file on {}", super::shown::shown(image, &stream)),
    )
    .with(known::K_STREAM, stream))
}

/// Reads a character.
///
/// `(read-char (make-string-input-stream "abc"))` => `#\a`
#[builtin]
fn read_char(
    image: &mut Image,
    stream: Option<&Value>,
    eof_error_p: Option<&Value>,
    eof_value: Option<&Value>,
    _recursive_p: Option<&Value>,
) -> Outcome {
    let source = stream.unwrap_or(&Value::NIL);
    match stream::read_char(image, source)? {
        Some(c) => Ok(Value::Char(c)),
        None => at_end(image, stream, eof_error_p, eof_value),
    }
}

/// Looks at the next character; with `T` the next that is not blank, with a character the next such
/// one.
///
/// `(peek-char t (make-string-input-stream "  x"))` => `#\x`
// `(peek-char type stream eof-error-p eof-value)`: `T` skips blanks, a character skips everything
// before it.
#[builtin]
fn peek_char(
    image: &mut Image,
    type_: Option<&Value>,
    stream: Option<&Value>,
    eof_error_p: Option<&Value>,
    eof_value: Option<&Value>,
    _recursive_p: Option<&Value>,
) -> Outcome {
    let source = stream.unwrap_or(&Value::NIL);
    while let Some(c) = stream::peek_char(image, source)? {
        let skipped = match type_ {
            Some(Value::Symbol(known::T, ..)) => c.is_whitespace(),
            Some(Value::Char(wanted)) => c != *wanted,
            _ => false,
        };
        if !skipped {
            return Ok(Value::Char(c));
        }
        stream::advance(image, source, c.len_utf8())?;
    }
    at_end(image, stream, eof_error_p, eof_value)
}

/// Gives the character back that was read last.
///
/// `(let ((s (make-string-input-stream "ab"))) (unread-char (read-char s) s) (read-char s))` => `#\a`
#[builtin]
fn unread_char(image: &mut Image, character: char, stream: Option<&Value>) -> Outcome {
    let c = character;
    stream::unread_char(image, stream.unwrap_or(&Value::NIL), c)?;
    Ok(Value::NIL)
}

/// Is there a character to read?
///
/// `(listen (make-string-input-stream ""))` => `NIL`
#[builtin]
fn listen(image: &mut Image, stream: Option<&Value>) -> Outcome {
    let source = stream.unwrap_or(&Value::NIL);
    // Nobody is asked.
    if stream::is_standard_input(image, source) {
        return Ok(Value::bool(!image.input.unread().is_empty()));
    }
    Ok(Value::bool(stream::peek_char(image, source)?.is_some()))
}

/// Reads a line; the second value tells whether it ended without a newline.
///
/// `(read-line (make-string-input-stream "only"))` => `"only" ; T`
#[builtin]
fn read_line(
    image: &mut Image,
    stream: Option<&Value>,
    eof_error_p: Option<&Value>,
    eof_value: Option<&Value>,
    _recursive_p: Option<&Value>,
) -> Outcome {
    let source = stream.unwrap_or(&Value::NIL);
    let (text, from) = stream::rest(image, source)?;
    let rest = text.get(from..).unwrap_or("");
    if rest.is_empty() {
        let value = at_end(image, stream, eof_error_p, eof_value)?;
        return Ok(Value::values(vec![value, Value::T]));
    }
    let (line, ended) = match rest.split_once('\n') {
        Some((line, _)) => (line, true),
        None => (rest, false),
    };
    stream::advance(image, source, line.len() + usize::from(ended))?;
    Ok(Value::values(vec![
        Value::string(line),
        Value::bool(!ended),
    ]))
}

/// Writes out what is held back.
///
/// `(force-output)` => `NIL`
#[builtin]
fn force_output(image: &mut Image, stream: Option<&Value>) -> Outcome {
    finish_output(image, stream)
}

/// Does nothing: all output is written.
///
/// `(clear-output)` => `NIL`
#[builtin]
fn clear_output(image: &mut Image, stream: Option<&Value>) -> Outcome {
    finish_output(image, stream)
}

/// Reads a character.
///
/// `(read-char-no-hang (make-string-input-stream "abc"))` => `#\a`
#[builtin]
fn read_char_no_hang(
    image: &mut Image,
    stream: Option<&Value>,
    eof_error_p: Option<&Value>,
    eof_value: Option<&Value>,
    recursive_p: Option<&Value>,
) -> Outcome {
    read_char(image, stream, eof_error_p, eof_value, recursive_p)
}

/// Streams.
pub(crate) static TABLE: &[Builtin] = builtins![
    streamp,
    input_stream_p,
    output_stream_p,
    interactive_stream_p,
    open_stream_p,
    stream_element_type,
    external_format,
    close,
    finish_output,
    force_output,
    clear_output,
    clear_input,
    read_char,
    read_char_no_hang,
    peek_char,
    unread_char,
    listen,
    read_line,
];
