//! Builtins for printing objects in a form of one's own.

use crate::lisp::builtin::{Builtin, Operator, pure};
use crate::lisp::image::Image;
use crate::lisp::object::form::form;
use crate::lisp::print::{self, Calls, Settings, identity};
use crate::lisp::stream;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;

/// The builtins.
pub(crate) static TABLE: &[Builtin] = &[pure(
    "PRINT-OBJECT",
    "object stream",
    "Prints an object. Add methods to print instances of your classes in a form of your own.",
    &[
        "(progn (defclass cup () ((size :initarg :size))) (defmethod print-object ((c cup) stream) (format stream \"<cup ~a>\" (slot-value c 'size))) (make-instance 'cup :size 3)) => <cup 3>",
    ],
    print_object,
)];

/// Builtins of the package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = &[pure(
    "%IDENTITY-TEXT",
    "object",
    "The text that tells an unreadable object from others.",
    &[],
    |image, args| Ok(Value::string(identity(image, &args[0]))),
)];

/// The macros.
pub(crate) static OPERATORS: &[Operator] = &[Operator {
    name: "PRINT-UNREADABLE-OBJECT",
    lambda_list: "(object stream &key type identity) &body body",
    doc: "Writes #<…> around what the body writes, with the type and the identity of the object if asked for.",
    examples: &[
        "(with-output-to-string (s) (print-unreadable-object ('a s :type t) (write-string \"x\" s))) => \"#<SYMBOL x>\"",
    ],
    expand: Some(expand_print_unreadable),
}];

/// Prints the default form of an object.
fn print_object(image: &mut Image, args: &[Value]) -> Result<Value, Box<Raise>> {
    let settings = Settings::of(image);
    let column = stream::column(image, &args[1])?.unwrap_or_default();
    let text = print::write(image, &args[0], &settings, column, &mut Calls::none());
    stream::write(image, &args[1], &text)?;
    Ok(args[0].clone())
}

fn expand_print_unreadable(image: &mut Image, whole: &Value) -> Result<Value, Box<Raise>> {
    let rest = whole.cdr_or_nil();
    let parts = rest.car_or_nil().list_to_vec().unwrap_or_default();
    let [object_form, stream_form, options @ ..] = parts.as_slice() else {
        return Err(Raise::program(
            "PRINT-UNREADABLE-OBJECT takes (object stream) with :TYPE and :IDENTITY, and a body.",
        ));
    };
    let option = |keyword| {
        options
            .chunks_exact(2)
            .find(|pair| pair[0].as_symbol() == Some(keyword))
            .map_or(Value::NIL, |pair| pair[1].clone())
    };
    let object = Value::Symbol(image.gensym("OBJECT"));
    let stream = Value::Symbol(image.gensym("STREAM"));
    let has_type = Value::Symbol(image.gensym("TYPE"));
    let has_identity = Value::Symbol(image.gensym("IDENTITY"));
    let type_flag = has_type.clone();
    let write = |text: Value| form![known::WRITE_STRING, text, stream.clone()];
    let space = || write(" ".into());
    let body = rest.cdr_or_nil();
    let mut forms = vec![
        write("#<".into()),
        form![
            known::WHEN,
            has_type.clone(),
            form![
                known::PRIN1,
                form![known::TYPE_OF, object.clone()],
                stream.clone(),
            ],
        ],
    ];
    if !body.is_nil() {
        forms.push(form![known::WHEN, has_type, space()]);
        forms.push(form![known::PROGN; body]);
    }
    forms.push(form![
        known::WHEN,
        has_identity.clone(),
        space(),
        write(form![known::SYS_IDENTITY_TEXT, object.clone()]),
    ]);
    forms.push(write(">".into()));
    forms.push(Value::NIL);
    let bindings = form![
        form![object, object_form.clone()],
        form![stream, stream_form.clone()],
        form![type_flag, option(known::K_TYPE)],
        form![has_identity, option(known::K_IDENTITY)],
    ];
    Ok(form![known::LET, bindings; Value::list(forms)])
}
