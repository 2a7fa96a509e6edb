//! What the pretty printer's macros and functions, which are written in Lisp, need of streams.

use crate::value::string::LispString;
use std::rc::Rc;

use super::composing::compose;
use super::streams::stream_of;
use crate::builtin::Builtin;
use crate::image::Image;
use crate::print::{self, Settings, SharedLabels};
use crate::stream::{self, Stream};
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::document::{Document, Newline, Tab};
use crate::value::known;
use crate::value::raise::Raise;
use crate::vm::machine::Machine;
use crate::vm::step::Step;

type Outcome = Result<Value, Box<Raise>>;

/// The output stream that a designator denotes.
#[builtin("%OUTPUT-STREAM")]
fn output_stream(image: &mut Image, designator: &Value) -> Outcome {
    stream::output_stream(image, designator).map(Value::Stream)
}

/// May lines break in what is written to the stream?
#[builtin("%PRETTY-STREAM-P")]
fn pretty_stream_p(image: &mut Image, stream: &Value) -> bool {
    stream::pretty(image, stream).is_some()
}

/// A stream that collects what will be laid out and written to the target.
#[builtin("%MAKE-PRETTY-STREAM")]
fn make_pretty_stream(image: &mut Image, target: &Value) -> Outcome {
    let start = stream::column(image, target)?.unwrap_or(0);
    Ok(Value::Stream(Rc::new(Stream::to_document(true, start))))
}

/// Ends a block and writes the suffix.
#[builtin("%END-BLOCK", "stream suffix")]
fn end_block(image: &mut Image, stream_value: &Value, suffix: &Rc<LispString>) -> Outcome {
    if let Some(stream) = stream::pretty(image, stream_value) {
        stream.with_document(Document::end);
    }
    stream::write(image, stream_value, &suffix.text())?;
    Ok(Value::NIL)
}

/// The labels of a list that a logical block prints.
#[builtin("%LABELS")]
fn labels(image: &mut Image, list: &Value) -> Outcome {
    let labels = SharedLabels::of(image, list, &Settings::of(image));
    Ok(Value::foreign(labels))
}

/// Is the object printed with a label in the logical block?
#[builtin("%LABELLED-P")]
fn labelled_p(image: &mut Image, object: &Value) -> bool {
    let labels = Settings::of(image).shared;

    labels.is_some_and(|labels| labels.is_marked(object))
}

/// Writes the label that the object has in the logical block; does it take the place of the object?
#[builtin("%WRITE-LABEL")]
fn write_label(image: &mut Image, object: &Value, stream: &Value) -> Outcome {
    let labels = Settings::of(image).shared;
    let Some((label, is_all)) = labels.and_then(|labels| labels.next(object)) else {
        return Ok(Value::NIL);
    };
    stream::write(image, stream, &label)?;
    Ok(Value::bool(is_all))
}

/// Indents the next lines from the current column, or from where the block started.
#[builtin("%INDENT")]
fn indent(image: &mut Image, current: bool, columns: &Value, stream: &Value) -> Outcome {
    let Value::Int(columns) = columns else {
        return Err(Raise::type_error(columns, known::FIXNUM));
    };
    if let Some(stream) = stream::pretty(image, stream) {
        stream.with_document(|document| {
            if current {
                document.indent_current(*columns);
            } else {
                document.indent_block(*columns);
            }
        });
    }
    Ok(Value::NIL)
}

/// Breaks the lines of what the stream has collected, and writes them to the target.
#[builtin("%LAY-OUT")]
fn lay_out(image: &mut Image, stream: &Value, target: &Value) -> Outcome {
    let Some(document) = stream_of(stream)?.take_document() else {
        return Err(Raise::type_error(stream, known::STRING_STREAM));
    };
    let start = stream::column(image, target)?.unwrap_or(0);
    let text = print::laid_out(document, &Settings::of(image), start);
    stream::write(image, target, &text)?;
    Ok(Value::NIL)
}

/// Writes the prefix and starts a block, whose lines begin with it if so wanted.
#[builtin("%START-BLOCK")]
fn start_block(
    image: &mut Image,
    stream: &Value,
    prefix: &Rc<LispString>,
    per_line: bool,
    suffix: &Rc<LispString>,
) -> Outcome {
    let prefix = prefix.text();
    let suffix = suffix.text();
    stream::write(image, stream, &prefix)?;
    if let Some(stream) = stream::pretty(image, stream) {
        let prefix = if per_line { prefix } else { String::new() };
        stream.with_document(|document| document.start_lines(prefix.into(), suffix.into()));
    }
    Ok(Value::NIL)
}

/// A place where a line may break.
#[builtin("%NEWLINE", "kind stream")]
fn newline(image: &mut Image, kind: &Value, stream_value: &Value) -> Outcome {
    let newline = match kind.as_symbol().map(|sym| image.name(sym)) {
        Some("LINEAR") => Newline::Linear,
        Some("FILL") => Newline::Fill,
        Some("MISER") => Newline::Miser,
        _ => Newline::Mandatory,
    };
    if let Some(stream) = stream::pretty(image, stream_value) {
        stream.with_document(|document| document.newline(newline));
    }
    Ok(Value::NIL)
}

/// Blanks up to a column.
#[builtin("%TAB", "section relative column step stream")]
fn tab(
    image: &mut Image,
    section: bool,
    relative: bool,
    column_value: &Value,
    step_value: &Value,
    stream_value: &Value,
) -> Outcome {
    let count = |value: &Value| match value {
        Value::Int(n) if *n >= 0 => Ok(usize::try_from(*n).unwrap_or(usize::MAX).min(10_000)),
        other => Err(Raise::type_error(other, known::UNSIGNED_BYTE)),
    };
    let tab = Tab {
        by_section: section,
        is_relative: relative,
        column: count(column_value)?,
        step: count(step_value)?,
    };
    if let Some(stream) = stream::pretty(image, stream_value) {
        stream.with_document(|document| document.tab(tab));
    }
    Ok(Value::NIL)
}

/// Writes the object as if the dispatch table had no function for it.
#[builtin("%WRITE-AS-STANDARD", "stream object")]
fn write_as_standard(
    machine: &mut Machine<'_>,
    stream_value: Value,
    object: Value,
) -> Result<Step, Box<Raise>> {
    let settings = Settings::of(machine.image);
    let target = stream_value;
    if let Some(stream) = stream::pretty(machine.image, &target) {
        return compose(
            machine,
            "WRITE",
            move |image, calls| Ok(print::document_default(image, &object, &settings, calls)),
            move |_, text| {
                stream.with_document(|document| document.append(&text));
                Ok(Step::Return(Value::NIL))
            },
        );
    }
    let start = stream::column(machine.image, &target)?.unwrap_or(0);
    compose(
        machine,
        "WRITE",
        move |image, calls| {
            Ok(print::write_default(
                image, &object, &settings, start, calls,
            ))
        },
        move |machine, text| {
            stream::write(machine.image, &target, &text)?;
            Ok(Step::Return(Value::NIL))
        },
    )
}

/// Builtins of package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![
    output_stream,
    pretty_stream_p,
    make_pretty_stream,
    lay_out,
    start_block,
    end_block,
    labels,
    labelled_p,
    write_label,
    newline,
    indent,
    tab,
    write_as_standard,
];
