//! Builtins for programs that print objects in a form of their own.

use crate::lisp::builtin::Builtin;
use crate::lisp::image::Image;
use crate::lisp::print::{self, Calls, Settings};
use crate::lisp::stream;
use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;
use crate::lisp::{builtin, builtins};

/// Prints an object. Add methods to print instances of your classes in a form of your own.
///
/// `(progn (defclass cup () ((size :initarg :size))) (defmethod print-object ((c cup) stream) (format stream "<cup ~a>" (slot-value c 'size))) (make-instance 'cup :size 3))` => `<cup 3>`
// Prints the default form of an object.
#[builtin(_, "object stream")]
fn print_object(image: &mut Image, args: &[Value]) -> Result<Value, Box<Raise>> {
    let settings = Settings::of(image);
    let column = stream::column(image, &args[1])?.unwrap_or_default();
    let text = print::write(image, &args[0], &settings, column, &mut Calls::none());
    stream::write(image, &args[1], &text)?;
    Ok(args[0].clone())
}

/// The builtins.
pub(crate) static TABLE: &[Builtin] = builtins![print_object,];
