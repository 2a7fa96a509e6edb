//! Builtins for programs that print objects in a form of their own.

use crate::builtin::Builtin;
use crate::image::Image;
use crate::print::{self, Calls, Settings};
use crate::stream;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::raise::Raise;

/// Prints an object. Add methods to print instances of your classes in a form of your own.
///
/// `(progn (defclass cup () ((size :initarg :size))) (defmethod print-object ((c cup) stream) (format stream "<cup ~a>" (slot-value c 'size))) (make-instance 'cup :size 3))` => `<cup 3>`
// Prints the default form of an object.
#[builtin]
fn print_object(image: &mut Image, object: &Value, stream: &Value) -> Result<Value, Box<Raise>> {
    let settings = Settings::of(image);
    let column = stream::column(image, stream)?.unwrap_or_default();
    let text = print::write(image, object, &settings, column, &mut Calls::none());
    stream::write(image, stream, &text)?;
    Ok(object.clone())
}

/// The builtins.
pub(crate) static TABLE: &[Builtin] = builtins![print_object,];
