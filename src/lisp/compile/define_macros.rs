//! The defining macros that the Lisp library itself is written with, and `define-setf-expander`.
//! The others are in `library/definitions.lisp`.

use crate::image::Image;
use crate::print;
use crate::value::Value;
use crate::value::form::{doc_form, form, quoted as quote, split_body, style_warning};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

type Expansion = Result<Value, Box<Raise>>;

fn argument(form: &Value, n: usize) -> Value {
    form.iter_list().nth(n).unwrap_or(Value::NIL)
}

fn name_argument(image: &Image, form: &Value, what: &str) -> Result<Sym, Box<Raise>> {
    let name = argument(form, 1);
    match name.as_symbol() {
        Some(sym) if !name.is_nil() => Ok(sym),
        _ => {
            let shown = print::to_string(image, &name, true);
            Err(Raise::program(format!(
                "{shown} is not a symbol: the name of {what} was expected."
            )))
        }
    }
}

pub(super) fn defun(image: &mut Image, form: &Value) -> Expansion {
    let name = argument(form, 1);
    let is_setf = name.car_or_nil().as_symbol() == Some(known::SETF);
    if !is_setf {
        name_argument(image, form, "a function")?;
    }
    let rest = form.cdr_or_nil().cdr_or_nil();
    if !rest.car_or_nil().is_list() || rest.is_nil() {
        return Err(Raise::program(
            "DEFUN takes a name, a list of parameters and a body.",
        ));
    }
    let warning = warning_of_text_alone(image, form, &name, &rest);
    let lambda = Value::list_with_tail([known::NAMED_LAMBDA.into(), name.clone()], rest);
    let definition = form![known::DEFINE_FUNCTION, quote(name), lambda];
    Ok(match warning {
        Some(warning) => form![known::PROGN, warning, definition],
        None => definition,
    })
}

/// The form that warns of a function with parameters that only returns a text, where a documentation
/// string stands. That is what is left of a library's function if it has forms for other
/// implementations only.
fn warning_of_text_alone(
    image: &Image,
    form: &Value,
    name: &Value,
    lambda_list_and_body: &Value,
) -> Option<Value> {
    let forms = lambda_list_and_body.cdr_or_nil();
    let is_alone = matches!(forms.car_or_nil(), Value::Str(_)) && forms.cdr_or_nil().is_nil();
    if !is_alone || lambda_list_and_body.car_or_nil().is_nil() {
        return None;
    }
    let place = match form {
        Value::Cons(cons) => image.sources.locate(cons.place()),
        _ => None,
    };
    let place = place.map_or_else(String::new, |place| format!("{place}: "));
    Some(style_warning(format!(
        "{place}{} only returns its documentation string: no form follows it, perhaps since #+ or #- leaves all out.",
        print::qualified(image, name)
    )))
}

pub(super) fn defmacro(image: &mut Image, form: &Value) -> Expansion {
    let name = name_argument(image, form, "a macro")?;
    let rest = form.cdr_or_nil().cdr_or_nil();
    let lambda_list = rest.car_or_nil();
    let body = rest.cdr_or_nil();
    let doc = doc_form(split_body(&body).doc.as_ref());
    let lambda = super::destructure::macro_function(image, name, &lambda_list, &body)?;
    Ok(form![
        known::DEFINE_MACRO,
        quote(name),
        lambda,
        quote(lambda_list),
        doc
    ])
}

pub(super) fn defparameter(image: &mut Image, form: &Value) -> Expansion {
    let name = name_argument(image, form, "a variable")?;
    Ok(form![
        known::DEFINE_PARAMETER,
        quote(name),
        argument(form, 2),
        argument(form, 3)
    ])
}

pub(super) fn defvar(image: &mut Image, form: &Value) -> Expansion {
    let name = name_argument(image, form, "a variable")?;
    let rest = form.cdr_or_nil().cdr_or_nil();
    if rest.is_nil() {
        return Ok(form![known::DEFINE_VARIABLE, quote(name)]);
    }
    // The value is computed only if the variable is unbound.
    Ok(form![
        known::PROGN,
        form![
            known::DEFINE_VARIABLE,
            quote(name),
            rest.cdr_or_nil().car_or_nil()
        ],
        form![
            known::UNLESS,
            form![known::BOUNDP, quote(name)],
            form![known::SETQ, name, rest.car_or_nil()]
        ],
        quote(name)
    ])
}

pub(super) fn define_setf_expander(image: &mut Image, form: &Value) -> Expansion {
    let name = name_argument(image, form, "an accessor")?;
    let rest = form.cdr_or_nil().cdr_or_nil();
    let lambda =
        super::destructure::macro_function(image, name, &rest.car_or_nil(), &rest.cdr_or_nil())?;
    Ok(form![known::SET_SETF_EXPANDER, quote(name), lambda])
}

pub(super) fn in_package(_: &mut Image, form: &Value) -> Expansion {
    let rest = form.cdr_or_nil();
    let (Value::Cons(_), Value::Symbol(known::NIL, ..)) = (&rest, rest.cdr_or_nil()) else {
        return Err(Raise::program("IN-PACKAGE is written (IN-PACKAGE NAME)."));
    };
    let package = form![known::EXISTING_PACKAGE, quote(rest.car_or_nil())];
    let always = form![
        known::K_COMPILE_TOPLEVEL,
        known::K_LOAD_TOPLEVEL,
        known::K_EXECUTE
    ];
    Ok(form![
        known::EVAL_WHEN,
        always,
        form![known::SETQ, known::V_PACKAGE, package]
    ])
}
