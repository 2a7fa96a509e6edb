//! Reading forms from streams and strings.

use std::rc::Rc;

use super::streams::or_method;
use crate::builtin::Builtin;
use crate::image::Image;
use crate::print;
use crate::reader::{Completeness, ReadError, Reader, is_complete};
use crate::stream::{self, Stream};
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::{Bounds, Sequence};
use crate::value::string::LispString;
use crate::vm::computation::{Computation, Progress, compute};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Reads a form from a stream.
///
/// `(with-input-from-string (s "(1 2) 3") (read s))` => `(1 2)`
#[builtin("READ")]
fn read_builtin(
    machine: &mut Machine<'_>,
    stream: Option<&Value>,
    eof_error_p: Option<&Value>,
    eof_value: Option<&Value>,
    recursive_p: Option<&Value>,
) -> Result<Step> {
    let args = [stream, eof_error_p, eof_value, recursive_p];
    read(machine, args, false)
}

/// Like READ, without reading the blank after the form.
///
/// `(with-input-from-string (s "a b") (list (read-preserving-whitespace s) (read-char s) (read s)))` => `(A #\  B)`
#[builtin]
fn read_preserving_whitespace(
    machine: &mut Machine<'_>,
    stream: Option<&Value>,
    eof_error_p: Option<&Value>,
    eof_value: Option<&Value>,
    recursive_p: Option<&Value>,
) -> Result<Step> {
    let args = [stream, eof_error_p, eof_value, recursive_p];
    read(machine, args, true)
}

/// Is nothing open at the end of the text?
///
/// `(system::%whole-form-p "(a")` => `NIL`
#[builtin("%WHOLE-FORM-P")]
fn whole_form_p(text: &Value) -> bool {
    let text = text.as_text().unwrap_or_default();
    let is_open = matches!(is_complete(&text), Completeness::Incomplete { .. });
    !is_open
}

/// Reading a form that may stop for evaluation.
struct Reading {
    reader: Reader,
    /// Where the reader's text begins in the stream's rest.
    start: usize,
    then: After,
}

/// What happens with the form.
enum After {
    /// It is the value; the stream continues after it.
    Stream(FromStream),
    /// It is the first value; the second is the position.
    String {
        /// Characters before the text.
        before: usize,
        /// A stream of the text, for errors.
        stream: Value,
        eof: Eof,
        preserve_whitespace: bool,
    },
    /// It is an element of a list that ends with a character.
    List {
        end: char,
        items: Vec<Value>,
        stream: Value,
    },
}

struct FromStream {
    stream: Value,
    eof: Eof,
    preserve_whitespace: bool,
}

/// What the end of the text means: an error (with the stream), or a value.
enum Eof {
    Error(Value),
    Value(Value),
}

impl Eof {
    fn of(error: Option<&Value>, value: Option<&Value>, stream: Value) -> Eof {
        match error {
            Some(error) if error.is_nil() => Eof::Value(value.cloned().unwrap_or(Value::NIL)),
            _ => Eof::Error(stream),
        }
    }

    fn value(&self, image: &Image) -> Result<Value> {
        match self {
            Eof::Value(value) => Ok(value.clone()),
            Eof::Error(stream) => Err(end_of_file(image, stream)),
        }
    }
}

fn end_of_file(image: &Image, stream: &Value) -> Box<Raise> {
    let shown = print::to_string(image, stream, true);
    Raise::new(known::END_OF_FILE, format!("end of file on {shown}"))
        .with(known::K_STREAM, stream.clone())
}

impl Computation for Reading {
    type Output = Value;

    fn advance(
        &mut self,
        machine: &mut Machine<'_>,
        answer: Option<Value>,
    ) -> Result<Progress<Value>> {
        let image = &mut *machine.image;
        if let Some(value) = answer {
            let outcome = self.reader.supply(image, value);
            if let Some(progress) = self.take(image, outcome)? {
                return Ok(progress);
            }
        }
        loop {
            if let Some(list) = self.end_of_list(image)? {
                return Ok(Progress::Done(list));
            }
            let outcome = self.reader.next(image);
            if let Some(progress) = self.take(image, outcome)? {
                return Ok(progress);
            }
        }
    }
}

impl Reading {
    /// Takes what the reader has read; returns nothing if reading must continue.
    fn take(
        &mut self,
        image: &mut Image,
        outcome: std::result::Result<crate::reader::Outcome, ReadError>,
    ) -> Result<Option<Progress<Value>>> {
        use crate::reader::Outcome;
        let form = match outcome {
            Ok(Outcome::Evaluate(form)) => {
                return Ok(Some(Progress::Call {
                    function: known::EVAL.into(),
                    args: vec![form],
                }));
            }
            Ok(Outcome::Form(form, _)) => Some(form),
            Ok(Outcome::End) => None,
            Err(error) => {
                self.advance_stream(image)?;
                let stream = match &self.then {
                    After::Stream(from) => &from.stream,
                    After::List { stream, .. } | After::String { stream, .. } => stream,
                };
                return Err(error.raise().with(known::K_STREAM, stream.clone()));
            }
        };
        let value = match (&mut self.then, form) {
            (After::List { items, .. }, Some(form)) => {
                items.push(form);
                return Ok(None);
            }
            (After::List { stream, .. }, None) => {
                let error = end_of_file(image, stream);
                self.advance_stream(image)?;
                return Err(error);
            }
            (After::Stream(from), Some(form)) => {
                if !from.preserve_whitespace {
                    self.reader.skip_one_blank(image);
                }
                self.advance_stream(image)?;
                form
            }
            (After::Stream(from), None) => {
                let value = from.eof.value(image);
                self.advance_stream(image)?;
                value?
            }
            (
                After::String {
                    before,
                    eof,
                    preserve_whitespace,
                    ..
                },
                form,
            ) => {
                let value = match form {
                    Some(form) => {
                        if !*preserve_whitespace {
                            self.reader.skip_one_blank(image);
                        }
                        form
                    }
                    None => eof.value(image)?,
                };
                let read = self.reader.text().get(..self.reader.position());
                let position = *before + read.map_or(0, |text| text.chars().count());
                Value::values(vec![value, Value::from(position)])
            }
        };
        Ok(Some(Progress::Done(value)))
    }

    /// Tells the stream how much was read.
    fn advance_stream(&self, image: &mut Image) -> Result<()> {
        let stream = match &self.then {
            After::Stream(from) => &from.stream,
            After::List { stream, .. } => stream,
            After::String { .. } => return Ok(()),
        };
        let consumed = self.reader.position().saturating_sub(self.start);
        stream::advance(image, stream, consumed)
    }

    /// The list, if what is being read is one and its end comes next.
    fn end_of_list(&mut self, image: &mut Image) -> Result<Option<Value>> {
        let After::List { end, items, stream } = &mut self.then else {
            return Ok(None);
        };
        let rest = self.reader.rest();
        let blanks = rest.len() - rest.trim_start().len();
        if !rest.trim_start().starts_with(*end) {
            return Ok(None);
        }
        let consumed = blanks + end.len_utf8();
        let read = self.reader.position().saturating_sub(self.start) + consumed;
        stream::advance(image, stream, read)?;
        Ok(Some(Value::list(std::mem::take(items))))
    }
}

fn reading_of_stream(image: &mut Image, then: After) -> Result<Reading> {
    let stream = match &then {
        After::Stream(from) => &from.stream,
        After::List { stream, .. } => stream,
        After::String { .. } => &Value::NIL,
    };
    let (text, start) = stream::rest(image, stream)?;
    let backquotes = match stream {
        Value::Stream(stream) => stream.backquotes.get(),
        _ => 0,
    };
    let mut reader = Reader::of_text(text).for_program();
    reader = reader.at(start).within(backquotes);
    if image.special(known::V_STANDARD_FIRST).is_true() {
        // What is read inside is read with the readtable.
        image.set_special(known::V_STANDARD_FIRST, Value::NIL);
        reader = reader.beginning_as_standard();
    }
    Ok(Reading {
        reader,
        start,
        then,
    })
}

fn read(
    machine: &mut Machine<'_>,
    args: [Option<&Value>; 4],
    preserve_whitespace: bool,
) -> Result<Step> {
    let [designator, eof_error_p, eof_value, recursive_p] = args;
    let designator = designator.unwrap_or(&Value::NIL);
    let stream = match stream::input_stream(machine.image, designator) {
        Ok(stream) => Value::Stream(stream),
        Err(raise) => {
            let name = if preserve_whitespace {
                known::READ_PRESERVING_WHITESPACE
            } else {
                known::READ
            };
            return or_method(raise, name, given(args));
        }
    };
    // In a recursive call, the blank after the form is left to the outer read.
    let is_recursive = recursive_p.is_some_and(Value::is_true);
    let then = After::Stream(FromStream {
        eof: Eof::of(eof_error_p, eof_value, stream.clone()),
        stream,
        preserve_whitespace: preserve_whitespace || is_recursive,
    });
    if stream::is_standard_input(machine.image, designator) {
        ask_for_form(machine.image);
    }
    let reading = reading_of_stream(machine.image, then)?;
    compute(machine, "READ", reading)
}

/// The arguments of a call, as far as they are given.
fn given<const N: usize>(args: [Option<&Value>; N]) -> Vec<Value> {
    args.into_iter().flatten().cloned().collect()
}

/// Has a person type until there is a whole form, or they type no more.
fn ask_for_form(image: &Image) {
    loop {
        let unread = image.input.unread();
        let is_whole = !matches!(is_complete(&unread), Completeness::Incomplete { .. });
        if is_whole && !unread.trim().is_empty() || !image.input.ask(image.output.pending()) {
            return;
        }
    }
}

/// Reads a form from a string; also where reading ended.
///
/// `(read-from-string "(a b) c")` => `(A B) ; 6`
#[builtin]
fn read_from_string(
    machine: &mut Machine<'_>,
    string: &Rc<LispString>,
    eof_error_p: Option<&Value>,
    eof_value: Option<&Value>,
    #[key] start: Option<&Value>,
    #[key] end: Option<&Value>,
    #[key] preserve_whitespace: Option<bool>,
) -> Result<Step> {
    let sequence = Sequence::Str(string.clone());
    let bounds = Bounds::new(&sequence, start, end)?;
    let text: Rc<str> = match bounds.end {
        None => string.text().into(),
        Some(end) => {
            let chars = string.text();
            let part: String = chars
                .chars()
                .skip(bounds.start)
                .take(end - bounds.start)
                .collect();
            part.into()
        }
    };
    let stream = Value::Stream(Rc::new(Stream::from_text(text.clone())));
    let reading = Reading {
        reader: Reader::of_text(text).for_program(),
        start: 0,
        then: After::String {
            before: bounds.start,
            eof: Eof::of(eof_error_p, eof_value, stream.clone()),
            stream,
            preserve_whitespace: preserve_whitespace == Some(true),
        },
    };
    compute(machine, "READ", reading)
}

/// Reads forms up to a character.
///
/// `(with-input-from-string (s "1 2 ]") (read-delimited-list #\] s))` => `(1 2)`
#[builtin]
fn read_delimited_list(
    machine: &mut Machine<'_>,
    character: char,
    stream: Option<&Value>,
    recursive_p: Option<&Value>,
) -> Result<Step> {
    let stream = match stream::input_stream(machine.image, stream.unwrap_or(&Value::NIL)) {
        Ok(stream) => Value::Stream(stream),
        Err(raise) => {
            let args = given([Some(&character.into()), stream, recursive_p]);
            return or_method(raise, known::READ_DELIMITED_LIST, args);
        }
    };
    let then = After::List {
        end: character,
        items: Vec::new(),
        stream,
    };
    let mut reading = reading_of_stream(machine.image, then)?;
    reading.reader = reading.reader.with_terminator(character);
    compute(machine, "READ", reading)
}

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = builtins![
    read_builtin,
    read_preserving_whitespace,
    read_from_string,
    read_delimited_list,
];

/// Builtins of package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![whole_form_p,];
