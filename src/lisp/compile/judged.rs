//! Compiling a form together with the warnings about it.

use std::rc::Rc;

use crate::image::Image;
use crate::image::warnings::Warning;
use crate::value::Value;
use crate::value::code::Code;
use crate::value::known;
use crate::value::raise::Raise;

/// Compiles a form; returns also the warnings that need not wait for the end of the text.
pub(crate) fn compile_judged(
    image: &mut Image,
    form: &Value,
) -> Result<(Rc<Code>, Vec<Warning>), Box<Raise>> {
    if !image.has_judge() || asks_first(form) {
        return Ok((super::compile_form(image, form)?, Vec::new()));
    }
    let (code, notes) = image.noting(|image| super::compile_form(image, form));
    let code = code?;
    let notes = image.sorted_notes(notes);
    Ok((code, image.judged(&notes)))
}

/// Does a form ask first whether a locked name is to be defined? It has the definition twice, and nobody
/// has said yet which one is meant.
fn asks_first(form: &Value) -> bool {
    let test = form.cdr_or_nil().car_or_nil();
    form.car_or_nil().as_symbol() == Some(known::IF)
        && test.car_or_nil().as_symbol() == Some(known::SYS_ASK_ABOUT_LOCKS)
}
