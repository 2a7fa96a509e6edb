//! Functions that are called again and again while simulated time passes.

use crate::state::Plan;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::raise::Raise;

/// Lets a function be called every so many simulated seconds, for as long as it returns true; the
/// first time, when so much time has passed. It cannot wait. A function that is called already goes on
/// as before.
#[builtin("%ACCOMPANY")]
fn accompany(image: &mut Image, period: f64, function: Value) -> Result<Value, Box<Raise>> {
    if !(period > 0.0 && period.is_finite()) {
        return Err(Raise::simple(format!(
            "A function cannot be called every {period} s: the time must be more than 0 s."
        )));
    }
    Plan::of(image).accompany(period, function);
    Ok(Value::T)
}

/// Functions of package `PLAN-SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![accompany,];
