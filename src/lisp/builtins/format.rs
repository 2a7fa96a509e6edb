//! `format` and `formatter`.

use super::composing::compose;
use super::streams::or_method;
use crate::builtin::{Builtin, Operator};
use crate::image::Image;
use crate::print::format::Control;
use crate::stream;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::vm::calls::{Args, run};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

/// Macros of package `COMMON-LISP`.
pub static OPERATORS: &[Operator] = &[Operator {
    name: "FORMATTER",
    lambda_list: "control",
    doc: "A function that writes its arguments to a stream as the control string says.",
    examples: &["(format nil (formatter \"~a-~a\") 1 2) => \"1-2\""],
    expand: Some(expand_formatter),
}];

/// Where the text goes.
enum Destination {
    /// Into a string that is returned.
    Result,
    /// To the stream of a designator.
    Stream(Value),
    /// To the end of a string with a fill pointer.
    String(Value),
}

fn destination(value: &Value) -> Result<Destination, Box<Raise>> {
    match value {
        Value::Symbol(known::NIL, ..) => Ok(Destination::Result),
        Value::Symbol(known::T, ..) => Ok(Destination::Stream(Value::NIL)),
        Value::Instance(instance) if instance.is_a(known::STREAM) => {
            Ok(Destination::Stream(value.clone()))
        }
        Value::Stream(_) => Ok(Destination::Stream(value.clone())),
        Value::Str(string) if string.has_fill_pointer.get() => {
            Ok(Destination::String(value.clone()))
        }
        other => Err(Raise::type_error(
            other,
            Value::list([
                known::OR.into(),
                known::NULL.into(),
                Value::list([known::MEMBER.into(), Value::T]),
                known::STREAM.into(),
                known::STRING.into(),
            ]),
        )),
    }
}

impl Destination {
    fn column(&self, image: &Image) -> Result<usize, Box<Raise>> {
        match self {
            Destination::Stream(target) => Ok(stream::column(image, target)?.unwrap_or(0)),
            Destination::Result | Destination::String(_) => Ok(0),
        }
    }

    fn take(self, image: &mut Image, text: String) -> Result<Value, Box<Raise>> {
        match self {
            Destination::Result => return Ok(Value::string(text)),
            Destination::Stream(target) => stream::write(image, &target, &text)?,
            Destination::String(target) => {
                if let Value::Str(string) = &target {
                    text.chars().for_each(|c| string.push(c));
                }
            }
        }
        Ok(Value::NIL)
    }
}

/// Writes the arguments as the control string says: to a string that it returns (NIL), to standard
/// output (T), to a stream, or to the end of a string with a fill pointer.
///
/// `(format nil "~a and ~s" "x" "x")` => `"x and \"x\""`
/// `(format nil "~{~a~^, ~}" '(1 2 3))` => `"1, 2, 3"`
/// `(format nil "~,2f ~5d ~r" 3.14159 42 42)` => `"3.14    42 forty-two"`
#[builtin(_, "destination control &rest arguments")]
fn format(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    let destination = destination(&args[0])?;
    match &args[1] {
        Value::Str(control) => {
            let control = Control::parse(&control.borrow())?;
            let column = match destination.column(machine.image) {
                Ok(column) => column,
                Err(raise) => return or_method(raise, known::FORMAT, args),
            };
            if let Destination::Stream(target) = &destination
                && let Some(stream) = stream::pretty(machine.image, target)
            {
                return compose(
                    machine,
                    "FORMAT",
                    move |image, calls| {
                        let arguments = args.get(2..).unwrap_or(&[]);
                        control.run_in_document(image, arguments, column, calls)
                    },
                    move |_, text| {
                        stream.with_document(|document| document.append(&text));
                        Ok(Step::Return(Value::NIL))
                    },
                );
            }
            compose(
                machine,
                "FORMAT",
                move |image, calls| control.run(image, args.get(2..).unwrap_or(&[]), column, calls),
                move |machine, text| destination.take(machine.image, text).map(Step::Return),
            )
        }
        function @ Value::Function(_) => {
            if let Destination::Stream(target) = &destination {
                let stream = match stream::output_stream(machine.image, target) {
                    Ok(stream) => stream,
                    Err(raise) => return or_method(raise, known::FORMAT, args),
                };
                let mut call = vec![Value::Stream(stream)];
                call.extend(args.iter().skip(2).cloned());
                let function = function.clone();
                return run(machine, "FORMAT", |calls| async move {
                    calls.call(&function, Args::Many(call)).await;
                    Ok(Value::NIL)
                });
            }
            let target = std::rc::Rc::new(stream::Stream::to_text());
            let mut call = vec![Value::Stream(target.clone())];
            call.extend(args.iter().skip(2).cloned());
            let function = function.clone();
            run(machine, "FORMAT", |calls| async move {
                calls.call(&function, Args::Many(call)).await;
                let text = target.take_text().unwrap_or_default();
                calls
                    .with(|machine| destination.take(machine.image, text))
                    .await
            })
        }
        other => Err(Raise::type_error(
            other,
            Value::list([
                known::OR.into(),
                known::STRING.into(),
                known::FUNCTION.into(),
            ]),
        )),
    }
}

/// Writes to a stream as FORMAT does; the arguments that are left.
// Writes to a stream as FORMAT does; returns the arguments that are left.
#[builtin("%FORMAT-REST", "stream control &rest arguments")]
fn format_rest(
    machine: &mut Machine<'_>,
    stream_value: Value,
    control_value: Value,
    arguments: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    let Value::Str(control) = &control_value else {
        return Err(Raise::type_error(&control_value, known::STRING));
    };
    let control = Control::parse(&control.borrow())?;
    let target = stream_value;
    if let Some(stream) = stream::pretty(machine.image, &target) {
        return compose(
            machine,
            "FORMATTER",
            move |image, calls| control.run_for_rest(image, &arguments, 0, true, calls),
            move |_, (output, rest)| {
                stream.with_document(|document| document.append(&output.into_document()));
                Ok(Step::Return(Value::list(rest)))
            },
        );
    }
    // The methods of an object that is a stream know its column, if anybody does.
    let column = stream::column(machine.image, &target)
        .ok()
        .flatten()
        .unwrap_or(0);
    compose(
        machine,
        "FORMATTER",
        move |image, calls| control.run_for_rest(image, &arguments, column, false, calls),
        move |machine, (output, rest)| {
            let text = Value::string(output.into_text());
            run(machine, "FORMATTER", |calls| async move {
                let write = known::WRITE_STRING.into();
                calls.call(&write, Args::Many(vec![text, target])).await;
                Ok(Value::list(rest))
            })
        },
    )
}

fn expand_formatter(image: &mut Image, form: &Value) -> Result<Value, Box<Raise>> {
    let control = form.cdr_or_nil().car_or_nil();
    if let Some(text) = control.as_text() {
        // A wrong control string is reported now, not when the function is called.
        Control::parse(&text)?;
    }
    let target = image.gensym("STREAM");
    let arguments = image.gensym("ARGUMENTS");
    let parameters = [target.clone(), known::L_REST.into(), arguments.clone()];
    let call: [Value; 5] = [
        known::APPLY.into(),
        Value::list([known::FUNCTION.into(), known::SYS_FORMAT_REST.into()]),
        target,
        control,
        arguments,
    ];
    let lambda: [Value; 3] = [
        known::LAMBDA.into(),
        Value::list(parameters),
        Value::list(call),
    ];
    Ok(Value::list([known::FUNCTION.into(), Value::list(lambda)]))
}

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = builtins![format,];

/// What the expansion of FORMATTER calls.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![format_rest,];
