//! `with-output-to-string`, `with-input-from-string`, `with-open-stream`,
//! `with-open-file`.

use super::forms::{binding, cl, let_form, progn, split_declarations, system};
use crate::lisp::builtin::Operator;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;

type Outcome = Result<Value, Box<Raise>>;

/// The parts of `(operator (head…) body…)`.
fn parts(form: &Value, shape: &str) -> Result<(Vec<Value>, Vec<Value>), Box<Raise>> {
    let mut forms = form.iter_list().skip(1);
    match forms.next().and_then(|head| head.list_to_vec()) {
        Some(head) if !head.is_empty() => Ok((head, forms.collect())),
        _ => Err(Raise::program(format!("The form is written {shape}."))),
    }
}

/// The value of a keyword among the forms of a head.
fn option(image: &Image, head: &[Value], name: &str) -> Option<Value> {
    head.chunks(2).find_map(|pair| match pair {
        [Value::Symbol(key), value] if image.is_keyword(*key) && image.name(*key) == name => {
            Some(value.clone())
        }
        _ => None,
    })
}

fn with_output_to_string(image: &mut Image, form: &Value) -> Outcome {
    let shape = "(WITH-OUTPUT-TO-STRING (VARIABLE [STRING]) BODY...)";
    let (head, body) = parts(form, shape)?;
    let (declarations, body) = split_declarations(body);
    let target = head.get(1).filter(|string| string.is_true());
    let (variable, body) = match (head.first(), target) {
        (Some(variable), Some(string)) => {
            let make = system(image, "%MAKE-FILL-POINTER-STREAM");
            let start = Value::list([make, string.clone()]);
            (binding(variable, start), vec![progn(body)])
        }
        (Some(variable), None) => {
            let start = Value::list([cl(image, "MAKE-STRING-OUTPUT-STREAM")]);
            let take = cl(image, "GET-OUTPUT-STREAM-STRING");
            let result = Value::list([take, variable.clone()]);
            (binding(variable, start), vec![progn(body), result])
        }
        (None, _) => return Err(Raise::program(format!("The form is written {shape}."))),
    };
    Ok(let_form(vec![variable], declarations, body))
}

fn with_input_from_string(image: &mut Image, form: &Value) -> Outcome {
    let shape = "(WITH-INPUT-FROM-STRING (VARIABLE STRING &KEY START END INDEX) BODY...)";
    let (head, body) = parts(form, shape)?;
    let [variable, string, options @ ..] = head.as_slice() else {
        return Err(Raise::program(format!("The form is written {shape}.")));
    };
    let (declarations, body) = split_declarations(body);
    let start = option(image, options, "START").unwrap_or(Value::Int(0));
    let end = option(image, options, "END").unwrap_or(Value::NIL);
    let make = cl(image, "MAKE-STRING-INPUT-STREAM");
    let opened = Value::list([make, string.clone(), start.clone(), end]);
    let mut result = progn(body);
    if let Some(index) = option(image, options, "INDEX") {
        let position = Value::list([cl(image, "FILE-POSITION"), variable.clone()]);
        let sum = Value::list([known::PLUS.into(), start, position]);
        let note = Value::list([known::SETF.into(), index, sum]);
        result = Value::list([known::MULTIPLE_VALUE_PROG1.into(), result, note]);
    }
    Ok(let_form(
        vec![binding(variable, opened)],
        declarations,
        [result],
    ))
}

/// Binds a variable to a stream and closes it afterwards, however the body ends.
fn closing(image: &mut Image, variable: &Value, stream: Value, body: Vec<Value>) -> Value {
    let (declarations, body) = split_declarations(body);
    let close = Value::list([
        known::WHEN.into(),
        variable.clone(),
        Value::list([cl(image, "CLOSE"), variable.clone()]),
    ]);
    let protected = Value::list([known::UNWIND_PROTECT.into(), progn(body), close]);
    let_form(vec![binding(variable, stream)], declarations, [protected])
}

fn with_open_stream(image: &mut Image, form: &Value) -> Outcome {
    let shape = "(WITH-OPEN-STREAM (VARIABLE STREAM) BODY...)";
    let (head, body) = parts(form, shape)?;
    match head.as_slice() {
        [variable, stream] => Ok(closing(image, variable, stream.clone(), body)),
        _ => Err(Raise::program(format!("The form is written {shape}."))),
    }
}

fn with_open_file(image: &mut Image, form: &Value) -> Outcome {
    let shape = "(WITH-OPEN-FILE (VARIABLE PATH OPTION...) BODY...)";
    let (head, body) = parts(form, shape)?;
    let [variable, arguments @ ..] = head.as_slice() else {
        return Err(Raise::program(format!("The form is written {shape}.")));
    };
    let open = cl(image, "OPEN");
    let opened = Value::cons(open, Value::list(arguments.to_vec()));
    Ok(closing(image, variable, opened, body))
}

/// Macros that open and close streams.
pub(crate) static OPERATORS: &[Operator] = &[
    Operator {
        name: "WITH-OUTPUT-TO-STRING",
        lambda_list: "(variable &optional string) &body body",
        doc: "Evaluates the body with a stream; returns the text that was written to it.",
        examples: &["(with-output-to-string (s) (princ 1 s) (princ 2 s)) => \"12\""],
        expand: Some(with_output_to_string),
    },
    Operator {
        name: "WITH-INPUT-FROM-STRING",
        lambda_list: "(variable string &key start end index) &body body",
        doc: "Evaluates the body with a stream that gives the characters of a string.",
        examples: &["(with-input-from-string (s \"abc\" :start 1) (read-char s)) => #\\b"],
        expand: Some(with_input_from_string),
    },
    Operator {
        name: "WITH-OPEN-STREAM",
        lambda_list: "(variable stream) &body body",
        doc: "Evaluates the body with a stream and closes it afterwards.",
        examples: &[
            "(with-open-stream (s (make-string-input-stream \"a\")) (read-char s)) => #\\a",
        ],
        expand: Some(with_open_stream),
    },
    Operator {
        name: "WITH-OPEN-FILE",
        lambda_list: "(variable path &rest options) &body body",
        doc: "Opens a file, evaluates the body with the stream, and closes it afterwards.",
        examples: &["(with-open-file (s \"no-such-file.txt\" :if-does-not-exist nil) s) => NIL"],
        expand: Some(with_open_file),
    },
];
