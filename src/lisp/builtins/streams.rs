//! Streams: making and combining them, reading characters, their state.

use std::rc::Rc;

use super::keywords;
use super::strings::string;
use crate::lisp::builtin::{Builtin, pure};
use crate::lisp::image::Image;
use crate::lisp::stream::{self, Stream, StreamKind};
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::sequence::{Bounds, Sequence, character, index, text_of};

type Outcome = Result<Value, Box<Raise>>;

fn stream_of(value: &Value) -> Result<&Rc<Stream>, Box<Raise>> {
    match value {
        Value::Stream(stream) => Ok(stream),
        _ => Err(Raise::type_error(value, known::STREAM)),
    }
}

fn made(stream: Stream) -> Value {
    Value::Stream(Rc::new(stream))
}

fn make_string_output_stream(_: &mut Image, _: &[Value]) -> Outcome {
    Ok(made(Stream::to_text()))
}

fn get_output_stream_string(_: &mut Image, args: &[Value]) -> Outcome {
    match stream_of(&args[0])?.take_text() {
        Some(text) => Ok(Value::string(text)),
        None => Err(Raise::type_error(&args[0], known::STRING_STREAM)),
    }
}

fn make_string_input_stream(_: &mut Image, args: &[Value]) -> Outcome {
    let string = string(&args[0])?.clone();
    let sequence = Sequence::Str(string.clone());
    let bounds = Bounds::new(&sequence, args.get(1), args.get(2))?;
    Ok(made(Stream::from_text(
        string.slice(bounds.start, bounds.end),
    )))
}

/// A stream that appends to a string with a fill pointer.
fn make_fill_pointer_stream(_: &mut Image, args: &[Value]) -> Outcome {
    let target = string(&args[0])?.clone();
    if !target.has_fill_pointer.get() {
        return Err(Raise::simple(
            "The string has no fill pointer, so nothing can be appended to it.",
        ));
    }
    Ok(made(Stream::new(StreamKind::StringTarget {
        string: target,
    })))
}

fn parts(args: &[Value]) -> Result<Vec<Rc<Stream>>, Box<Raise>> {
    args.iter().map(|a| stream_of(a).cloned()).collect()
}

fn make_broadcast_stream(_: &mut Image, args: &[Value]) -> Outcome {
    let targets = parts(args)?;
    let kind = StreamKind::Broadcast {
        targets: targets.clone(),
    };
    Stream::compound(kind, &targets).map(made)
}

fn make_concatenated_stream(_: &mut Image, args: &[Value]) -> Outcome {
    let inputs = parts(args)?;
    let kind = StreamKind::Concatenated {
        inputs: inputs.clone(),
        unread: None,
    };
    Stream::compound(kind, &inputs).map(made)
}

fn two_way(args: &[Value], echo: bool) -> Outcome {
    let (input, output) = (stream_of(&args[0])?.clone(), stream_of(&args[1])?.clone());
    if !input.is_input() {
        return Err(Raise::type_error(&args[0], known::STREAM));
    }
    if !output.is_output() {
        return Err(Raise::type_error(&args[1], known::STREAM));
    }
    let kind = StreamKind::TwoWay {
        input: input.clone(),
        output: output.clone(),
        echo,
        unread: None,
    };
    Stream::compound(kind, &[input, output]).map(made)
}

fn make_two_way_stream(_: &mut Image, args: &[Value]) -> Outcome {
    two_way(args, false)
}

fn make_echo_stream(_: &mut Image, args: &[Value]) -> Outcome {
    two_way(args, true)
}

fn make_synonym_stream(_: &mut Image, args: &[Value]) -> Outcome {
    let symbol = super::property_lists::symbol(&args[0])?;
    Ok(made(Stream::new(StreamKind::Synonym { symbol })))
}

fn streamp(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::bool(matches!(args[0], Value::Stream(_))))
}

fn input_stream_p(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::bool(stream_of(&args[0])?.is_input()))
}

fn output_stream_p(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(Value::bool(stream_of(&args[0])?.is_output()))
}

fn interactive_stream_p(_: &mut Image, args: &[Value]) -> Outcome {
    stream_of(&args[0]).map(|_| Value::NIL)
}

fn open_stream_p(_: &mut Image, args: &[Value]) -> Outcome {
    let stream = stream_of(&args[0])?;
    let open = !matches!(&*stream.kind.borrow(), StreamKind::Closed);
    Ok(Value::bool(open))
}

fn stream_element_type(_: &mut Image, args: &[Value]) -> Outcome {
    stream_of(&args[0]).map(|_| known::CHARACTER.into())
}

fn external_format(image: &mut Image, args: &[Value]) -> Outcome {
    stream_of(&args[0])?;
    Ok(image.keyword("DEFAULT").into())
}

fn close(image: &mut Image, args: &[Value]) -> Outcome {
    keywords::parse(image, &args[1..], [known::K_ABORT])?;
    stream::close(stream_of(&args[0])?).map(Value::bool)
}

/// Flushes the buffer of a file stream.
fn finish_output(image: &mut Image, args: &[Value]) -> Outcome {
    let target = args.first().unwrap_or(&Value::NIL);
    let stream = stream::output_stream(image, target)?;
    stream::flush(&stream)?;
    image.output.finish();
    Ok(Value::NIL)
}

fn clear_input(image: &mut Image, args: &[Value]) -> Outcome {
    stream::input_stream(image, args.first().unwrap_or(&Value::NIL))?;
    Ok(Value::NIL)
}

/// The result of reading at the end: the end-of-file value, or an error.
pub(crate) fn at_end(
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

fn read_char(image: &mut Image, args: &[Value]) -> Outcome {
    let source = args.first().unwrap_or(&Value::NIL);
    match stream::read_char(image, source)? {
        Some(c) => Ok(Value::Char(c)),
        None => at_end(image, args.first(), args.get(1), args.get(2)),
    }
}

/// `(peek-char type stream eof-error-p eof-value)`: `T` skips blanks, a character skips everything
/// before it.
fn peek_char(image: &mut Image, args: &[Value]) -> Outcome {
    let source = args.get(1).unwrap_or(&Value::NIL);
    while let Some(c) = stream::peek_char(image, source)? {
        let skipped = match args.first() {
            Some(Value::Symbol(known::T, ..)) => c.is_whitespace(),
            Some(Value::Char(wanted)) => c != *wanted,
            _ => false,
        };
        if !skipped {
            return Ok(Value::Char(c));
        }
        stream::advance(image, source, c.len_utf8())?;
    }
    at_end(image, args.get(1), args.get(2), args.get(3))
}

fn unread_char(image: &mut Image, args: &[Value]) -> Outcome {
    let c = character(&args[0])?;
    stream::unread_char(image, args.get(1).unwrap_or(&Value::NIL), c)?;
    Ok(Value::NIL)
}

fn listen(image: &mut Image, args: &[Value]) -> Outcome {
    let source = args.first().unwrap_or(&Value::NIL);
    // Nobody is asked.
    if stream::is_standard_input(image, source) {
        return Ok(Value::bool(!image.input.unread().is_empty()));
    }
    Ok(Value::bool(stream::peek_char(image, source)?.is_some()))
}

fn read_line(image: &mut Image, args: &[Value]) -> Outcome {
    let source = args.first().unwrap_or(&Value::NIL);
    let (text, from) = stream::rest(image, source)?;
    let rest = text.get(from..).unwrap_or("");
    if rest.is_empty() {
        let value = at_end(image, args.first(), args.get(1), args.get(2))?;
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

fn read_sequence(image: &mut Image, args: &[Value]) -> Outcome {
    let [start, end] = keywords::parse(image, &args[2..], [known::K_START, known::K_END])?;
    let target = Sequence::of(&args[0])?;
    let bounds = Bounds::new(&target, start.as_ref(), end.as_ref())?;
    let end = bounds.end_of(target.len()?);
    let mut at = bounds.start;
    while at < end
        && let Some(c) = stream::read_char(image, &args[1])?
    {
        target.set(at, Value::Char(c))?;
        at += 1;
    }
    Ok(at.into())
}

fn write_sequence(image: &mut Image, args: &[Value]) -> Outcome {
    let [start, end] = keywords::parse(image, &args[2..], [known::K_START, known::K_END])?;
    let source = Sequence::of(&args[0])?;
    let bounds = Bounds::new(&source, start.as_ref(), end.as_ref())?;
    let text = text_of(&source.items(bounds)?)?;
    stream::write(image, &args[1], &text)?;
    Ok(args[0].clone())
}

/// The position in a stream: in characters, or in bytes for a stream that writes a file.
fn file_position(_: &mut Image, args: &[Value]) -> Outcome {
    let stream = stream_of(&args[0])?;
    match (&mut *stream.kind.borrow_mut(), args.get(1)) {
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
            Ok(i64::try_from(*position).map_or(Value::NIL, Value::Int))
        }
        _ => Ok(Value::NIL),
    }
}

fn file_length(_: &mut Image, args: &[Value]) -> Outcome {
    let stream = stream_of(&args[0])?;
    let length = match &*stream.kind.borrow() {
        StreamKind::StringInput { text, .. } => text.len(),
        StreamKind::FileOutput { position, .. } => usize::try_from(*position).unwrap_or(0),
        _ => return Err(Raise::type_error(&args[0], known::STREAM)),
    };
    Ok(length.into())
}

fn stream_list(streams: &[Rc<Stream>]) -> Value {
    Value::list(streams.iter().cloned().map(Value::Stream))
}

/// The parts of a combined stream, as a list.
fn components(value: &Value) -> Result<Value, Box<Raise>> {
    match &*stream_of(value)?.kind.borrow() {
        StreamKind::Broadcast { targets } => Ok(stream_list(targets)),
        StreamKind::Concatenated { inputs, .. } => Ok(stream_list(inputs)),
        StreamKind::TwoWay { input, output, .. } => {
            Ok(stream_list(&[input.clone(), output.clone()]))
        }
        StreamKind::Synonym { symbol } => Ok(Value::list([Value::symbol(*symbol)])),
        _ => Err(Raise::type_error(value, known::STREAM)),
    }
}

fn all_components(_: &mut Image, args: &[Value]) -> Outcome {
    components(&args[0])
}

fn first_component(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(components(&args[0])?.car_or_nil())
}

fn second_component(_: &mut Image, args: &[Value]) -> Outcome {
    Ok(components(&args[0])?.cdr_or_nil().car_or_nil())
}

/// Streams.
pub(crate) static TABLE: &[Builtin] = &[
    pure(
        "STREAMP",
        "object",
        "Is the object a stream?",
        &["(streamp *standard-output*) => T"],
        streamp,
    ),
    pure(
        "INPUT-STREAM-P",
        "stream",
        "Can the stream be read?",
        &["(input-stream-p (make-string-input-stream \"x\")) => T"],
        input_stream_p,
    ),
    pure(
        "OUTPUT-STREAM-P",
        "stream",
        "Can the stream be written?",
        &["(output-stream-p (make-string-input-stream \"x\")) => NIL"],
        output_stream_p,
    ),
    pure(
        "INTERACTIVE-STREAM-P",
        "stream",
        "Is somebody at the other end?",
        &["(interactive-stream-p *standard-input*) => NIL"],
        interactive_stream_p,
    ),
    pure(
        "OPEN-STREAM-P",
        "stream",
        "Is the stream open?",
        &["(open-stream-p (make-string-input-stream \"x\")) => T"],
        open_stream_p,
    ),
    pure(
        "STREAM-ELEMENT-TYPE",
        "stream",
        "The type of what the stream carries.",
        &["(stream-element-type (make-string-input-stream \"x\")) => CHARACTER"],
        stream_element_type,
    ),
    pure(
        "STREAM-EXTERNAL-FORMAT",
        "stream",
        "How characters are encoded in files: UTF-8.",
        &["(stream-external-format (make-string-input-stream \"x\")) => :DEFAULT"],
        external_format,
    ),
    pure(
        "MAKE-STRING-OUTPUT-STREAM",
        "&key element-type",
        "A stream that collects what is written.",
        &[
            "(let ((s (make-string-output-stream))) (princ 1 s) (get-output-stream-string s)) => \"1\"",
        ],
        make_string_output_stream,
    ),
    pure(
        "GET-OUTPUT-STREAM-STRING",
        "stream",
        "Takes the text that a string output stream has collected.",
        &["(get-output-stream-string (make-string-output-stream)) => \"\""],
        get_output_stream_string,
    ),
    pure(
        "MAKE-STRING-INPUT-STREAM",
        "string &optional start end",
        "A stream that gives the characters of a string.",
        &["(read-char (make-string-input-stream \"abc\" 1)) => #\\b"],
        make_string_input_stream,
    ),
    pure(
        "MAKE-BROADCAST-STREAM",
        "&rest streams",
        "A stream that writes to several others.",
        &["(princ 1 (make-broadcast-stream)) => 1"],
        make_broadcast_stream,
    ),
    pure(
        "MAKE-CONCATENATED-STREAM",
        "&rest streams",
        "A stream that reads several others one after the other.",
        &[
            "(read-line (make-concatenated-stream (make-string-input-stream \"a\") (make-string-input-stream \"b\"))) => \"ab\" ; T",
        ],
        make_concatenated_stream,
    ),
    pure(
        "MAKE-TWO-WAY-STREAM",
        "input output",
        "A stream that reads one stream and writes another.",
        &[
            "(read-char (make-two-way-stream (make-string-input-stream \"a\") (make-broadcast-stream))) => #\\a",
        ],
        make_two_way_stream,
    ),
    pure(
        "MAKE-ECHO-STREAM",
        "input output",
        "A stream that writes what it reads to another.",
        &[
            "(let* ((out (make-string-output-stream)) (s (make-echo-stream (make-string-input-stream \"ab\") out))) (read-char s) (get-output-stream-string out)) => \"a\"",
        ],
        make_echo_stream,
    ),
    pure(
        "MAKE-SYNONYM-STREAM",
        "symbol",
        "A stream that stands for the value of a variable.",
        &["(streamp (make-synonym-stream '*standard-output*)) => T"],
        make_synonym_stream,
    ),
    pure(
        "BROADCAST-STREAM-STREAMS",
        "stream",
        "The streams that a broadcast stream writes to.",
        &["(broadcast-stream-streams (make-broadcast-stream)) => NIL"],
        all_components,
    ),
    pure(
        "CONCATENATED-STREAM-STREAMS",
        "stream",
        "The streams that a concatenated stream has still to read.",
        &["(concatenated-stream-streams (make-concatenated-stream)) => NIL"],
        all_components,
    ),
    pure(
        "TWO-WAY-STREAM-INPUT-STREAM",
        "stream",
        "The stream that is read.",
        &["(streamp (two-way-stream-input-stream *terminal-io*)) => T"],
        first_component,
    ),
    pure(
        "TWO-WAY-STREAM-OUTPUT-STREAM",
        "stream",
        "The stream that is written.",
        &["(streamp (two-way-stream-output-stream *terminal-io*)) => T"],
        second_component,
    ),
    pure(
        "ECHO-STREAM-INPUT-STREAM",
        "stream",
        "The stream that is read.",
        &[
            "(streamp (echo-stream-input-stream (make-echo-stream *standard-input* *standard-output*))) => T",
        ],
        first_component,
    ),
    pure(
        "ECHO-STREAM-OUTPUT-STREAM",
        "stream",
        "The stream that is written.",
        &[
            "(streamp (echo-stream-output-stream (make-echo-stream *standard-input* *standard-output*))) => T",
        ],
        second_component,
    ),
    pure(
        "SYNONYM-STREAM-SYMBOL",
        "stream",
        "The variable that a synonym stream stands for.",
        &["(synonym-stream-symbol (make-synonym-stream '*x*)) => *X*"],
        first_component,
    ),
    pure(
        "CLOSE",
        "stream &key abort",
        "Closes a stream; was it open?",
        &["(close (make-string-input-stream \"x\")) => T"],
        close,
    ),
    pure(
        "FINISH-OUTPUT",
        "&optional stream",
        "Writes out what is held back.",
        &["(finish-output) => NIL"],
        finish_output,
    ),
    pure(
        "FORCE-OUTPUT",
        "&optional stream",
        "Writes out what is held back.",
        &["(force-output) => NIL"],
        finish_output,
    ),
    pure(
        "CLEAR-OUTPUT",
        "&optional stream",
        "Does nothing: all output is written.",
        &["(clear-output) => NIL"],
        finish_output,
    ),
    pure(
        "CLEAR-INPUT",
        "&optional stream",
        "Does nothing: no input waits.",
        &["(clear-input) => NIL"],
        clear_input,
    ),
    pure(
        "READ-CHAR",
        "&optional stream eof-error-p eof-value recursive-p",
        "Reads a character.",
        &["(read-char (make-string-input-stream \"abc\")) => #\\a"],
        read_char,
    ),
    pure(
        "READ-CHAR-NO-HANG",
        "&optional stream eof-error-p eof-value recursive-p",
        "Reads a character.",
        &["(read-char-no-hang (make-string-input-stream \"abc\")) => #\\a"],
        read_char,
    ),
    pure(
        "PEEK-CHAR",
        "&optional type stream eof-error-p eof-value recursive-p",
        "Looks at the next character; with `T` the next that is not blank, with a character the next such one.",
        &["(peek-char t (make-string-input-stream \"  x\")) => #\\x"],
        peek_char,
    ),
    pure(
        "UNREAD-CHAR",
        "character &optional stream",
        "Gives the character back that was read last.",
        &[
            "(let ((s (make-string-input-stream \"ab\"))) (unread-char (read-char s) s) (read-char s)) => #\\a",
        ],
        unread_char,
    ),
    pure(
        "LISTEN",
        "&optional stream",
        "Is there a character to read?",
        &["(listen (make-string-input-stream \"\")) => NIL"],
        listen,
    ),
    pure(
        "READ-LINE",
        "&optional stream eof-error-p eof-value recursive-p",
        "Reads a line; the second value tells whether it ended without a newline.",
        &["(read-line (make-string-input-stream \"only\")) => \"only\" ; T"],
        read_line,
    ),
    pure(
        "READ-SEQUENCE",
        "sequence stream &key start end",
        "Reads characters into a sequence; the index after the last one.",
        &["(read-sequence (make-string 2) (make-string-input-stream \"abc\")) => 2"],
        read_sequence,
    ),
    pure(
        "WRITE-SEQUENCE",
        "sequence stream &key start end",
        "Writes the characters of a sequence.",
        &["(with-output-to-string (s) (write-sequence \"hello\" s :start 1 :end 3)) => \"el\""],
        write_sequence,
    ),
    pure(
        "FILE-POSITION",
        "stream &optional position",
        "How far a stream has come, or sets that.",
        &["(file-position (make-string-input-stream \"x\")) => 0"],
        file_position,
    ),
    pure(
        "FILE-LENGTH",
        "stream",
        "The length of the file behind a stream.",
        &["(file-length (make-string-input-stream \"abc\")) => 3"],
        file_length,
    ),
];

/// What expansions call; in `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = &[pure(
    "%MAKE-FILL-POINTER-STREAM",
    "string",
    "A stream that appends to a string with a fill pointer.",
    &[
        "(streamp (system::%make-fill-pointer-stream (make-array 0 :element-type 'character :fill-pointer 0))) => T",
    ],
    make_fill_pointer_stream,
)];
