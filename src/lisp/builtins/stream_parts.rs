//! Making streams, combining them, and what they are made of.

use crate::value::string::LispString;
use std::rc::Rc;

use super::streams::stream_of;
use crate::builtin::Builtin;
use crate::image::Image;
use crate::stream::{self, Stream, StreamKind};
use crate::typed::FromValue;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::{Bounds, Sequence};

type Outcome = Result<Value, Box<Raise>>;

fn made(stream: Stream) -> Value {
    Value::Stream(Rc::new(stream))
}

/// A stream that collects what is written.
///
/// `(let ((s (make-string-output-stream))) (princ 1 s) (get-output-stream-string s))` => `"1"`
#[builtin]
fn make_string_output_stream(#[key] _element_type: Option<&Value>) -> Value {
    made(Stream::to_text())
}

/// Takes the text that a string output stream has collected.
///
/// `(get-output-stream-string (make-string-output-stream))` => `""`
#[builtin]
fn get_output_stream_string(stream: &Value) -> Outcome {
    match stream_of(stream)?.take_text() {
        Some(text) => Ok(Value::string(text)),
        None => Err(Raise::type_error(stream, known::STRING_STREAM)),
    }
}

/// A stream that gives the characters of a string.
///
/// `(read-char (make-string-input-stream "abc" 1))` => `#\b`
#[builtin]
fn make_string_input_stream(
    string: &Rc<LispString>,
    start: Option<&Value>,
    end: Option<&Value>,
) -> Outcome {
    let string = string.clone();
    let sequence = Sequence::Str(string.clone());
    let bounds = Bounds::new(&sequence, start, end)?;
    Ok(made(Stream::from_text(
        string.slice(bounds.start, bounds.end),
    )))
}

/// A stream that appends to a string with a fill pointer.
///
/// `(streamp (system::%make-fill-pointer-stream (make-array 0 :element-type 'character :fill-pointer 0)))` => `T`
// A stream that appends to a string with a fill pointer.
#[builtin("%MAKE-FILL-POINTER-STREAM", "string")]
fn make_fill_pointer_stream(string_argument: &Rc<LispString>) -> Outcome {
    let target = string_argument.clone();
    if !target.has_fill_pointer.get() {
        return Err(Raise::simple(
            "The string has no fill pointer, so nothing can be appended to it.",
        ));
    }
    Ok(made(Stream::new(StreamKind::StringTarget {
        string: target,
    })))
}

/// A stream that another one is to read.
struct Input(Rc<Stream>);

impl FromValue<'_> for Input {
    fn from_value(image: &mut Image, value: &Value) -> Result<Self, Box<Raise>> {
        let stream = stream_of(value)?;
        match stream.is_input() {
            true => Ok(Input(stream.clone())),
            false => Err(stream::not_usable(stream, "INPUT-STREAM-P", image)),
        }
    }
}

/// A stream that another one is to write.
struct Output(Rc<Stream>);

impl FromValue<'_> for Output {
    fn from_value(image: &mut Image, value: &Value) -> Result<Self, Box<Raise>> {
        let stream = stream_of(value)?;
        match stream.is_output() {
            true => Ok(Output(stream.clone())),
            false => Err(stream::not_usable(stream, "OUTPUT-STREAM-P", image)),
        }
    }
}

/// A stream that writes to several others.
///
/// `(princ 1 (make-broadcast-stream))` => `1`
#[builtin]
fn make_broadcast_stream(streams: Vec<Output>) -> Outcome {
    let targets: Vec<_> = streams.into_iter().map(|output| output.0).collect();
    let kind = StreamKind::Broadcast {
        targets: targets.clone(),
    };
    Stream::compound(kind, &targets).map(made)
}

/// A stream that reads several others one after the other.
///
/// `(read-line (make-concatenated-stream (make-string-input-stream "a") (make-string-input-stream "b")))` => `"ab" ; T`
#[builtin]
fn make_concatenated_stream(streams: Vec<Input>) -> Outcome {
    let inputs: Vec<_> = streams.into_iter().map(|input| input.0).collect();
    let kind = StreamKind::Concatenated {
        inputs: inputs.clone(),
        unread: None,
    };
    let stream = Stream::compound(kind, &inputs)?;
    // A function of a macro character may read through it.
    let enclosing = inputs.iter().map(|input| input.backquotes.get()).max();
    stream.backquotes.set(enclosing.unwrap_or_default());
    Ok(made(stream))
}

fn two_way(Input(input): Input, Output(output): Output, echo: bool) -> Outcome {
    let kind = StreamKind::TwoWay {
        input: input.clone(),
        output: output.clone(),
        echo,
        unread: None,
    };
    Stream::compound(kind, &[input, output]).map(made)
}

/// A stream that reads one stream and writes another.
///
/// `(read-char (make-two-way-stream (make-string-input-stream "a") (make-broadcast-stream)))` => `#\a`
#[builtin]
fn make_two_way_stream(input: Input, output: Output) -> Outcome {
    two_way(input, output, false)
}

/// A stream that writes what it reads to another.
///
/// `(let* ((out (make-string-output-stream)) (s (make-echo-stream (make-string-input-stream "ab") out))) (read-char s) (get-output-stream-string out))` => `"a"`
#[builtin]
fn make_echo_stream(input: Input, output: Output) -> Outcome {
    two_way(input, output, true)
}

/// A stream that stands for the value of a variable.
///
/// `(streamp (make-synonym-stream '*standard-output*))` => `T`
#[builtin]
fn make_synonym_stream(symbol: &Value) -> Outcome {
    if symbol.as_symbol().is_none() {
        return Err(Raise::type_error(symbol, known::SYMBOL));
    }
    let symbol = symbol.clone();
    Ok(made(Stream::new(StreamKind::Synonym { symbol })))
}

fn stream_list(streams: &[Rc<Stream>]) -> Value {
    Value::list(streams.iter().cloned().map(Value::Stream))
}

/// The parts of a combined stream, as a list.
fn components(value: &Value) -> Outcome {
    match &*stream_of(value)?.kind.borrow() {
        StreamKind::Broadcast { targets } => Ok(stream_list(targets)),
        StreamKind::Concatenated { inputs, .. } => Ok(stream_list(inputs)),
        StreamKind::TwoWay { input, output, .. } => {
            Ok(stream_list(&[input.clone(), output.clone()]))
        }
        StreamKind::Synonym { symbol } => Ok(Value::list([symbol.clone()])),
        _ => Err(Raise::type_error(value, known::STREAM)),
    }
}

/// The streams that a broadcast stream writes to.
///
/// `(broadcast-stream-streams (make-broadcast-stream))` => `NIL`
#[builtin("BROADCAST-STREAM-STREAMS")]
fn all_components(stream: &Value) -> Outcome {
    components(stream)
}

/// The stream that is read.
///
/// `(streamp (two-way-stream-input-stream *terminal-io*))` => `T`
#[builtin("TWO-WAY-STREAM-INPUT-STREAM")]
fn first_component(stream: &Value) -> Outcome {
    Ok(components(stream)?.car_or_nil())
}

/// The stream that is written.
///
/// `(streamp (two-way-stream-output-stream *terminal-io*))` => `T`
#[builtin("TWO-WAY-STREAM-OUTPUT-STREAM")]
fn second_component(stream: &Value) -> Outcome {
    Ok(components(stream)?.cdr_or_nil().car_or_nil())
}

/// The name of the file that a stream reads or writes, or `NIL`.
///
/// `(system::%stream-file *standard-input*)` => `NIL`
#[builtin("%STREAM-FILE")]
fn stream_file(stream: &Rc<Stream>) -> Outcome {
    let file = &stream.file;
    Ok(file.as_deref().map_or(Value::NIL, Value::string))
}

/// The streams that a concatenated stream has still to read.
///
/// `(concatenated-stream-streams (make-concatenated-stream))` => `NIL`
#[builtin]
fn concatenated_stream_streams(stream: &Value) -> Outcome {
    all_components(stream)
}

/// The stream that is read.
///
/// `(streamp (echo-stream-input-stream (make-echo-stream *standard-input* *standard-output*)))` => `T`
#[builtin]
fn echo_stream_input_stream(stream: &Value) -> Outcome {
    first_component(stream)
}

/// The stream that is written.
///
/// `(streamp (echo-stream-output-stream (make-echo-stream *standard-input* *standard-output*)))` => `T`
#[builtin]
fn echo_stream_output_stream(stream: &Value) -> Outcome {
    second_component(stream)
}

/// The variable that a synonym stream stands for.
///
/// `(synonym-stream-symbol (make-synonym-stream '*x*))` => `*X*`
#[builtin]
fn synonym_stream_symbol(stream: &Value) -> Outcome {
    first_component(stream)
}

/// Making and combining streams.
pub(crate) static TABLE: &[Builtin] = builtins![
    make_string_output_stream,
    get_output_stream_string,
    make_string_input_stream,
    make_broadcast_stream,
    make_concatenated_stream,
    make_two_way_stream,
    make_echo_stream,
    make_synonym_stream,
    all_components,
    concatenated_stream_streams,
    first_component,
    second_component,
    echo_stream_input_stream,
    echo_stream_output_stream,
    synonym_stream_symbol,
];

/// What expansions call; in `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![make_fill_pointer_stream, stream_file,];
