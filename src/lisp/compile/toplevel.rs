//! Evaluation at top level in two steps: compiling a form, and running its code.

use std::rc::Rc;

use crate::image::Image;
use crate::value::Value;
use crate::value::code::Code;
use crate::value::known;
use crate::value::raise::Raise;

/// The parts of a form that `eval` compiles one after the other. Each is to be run before the next one
/// is asked for, since it may define what that is expanded and compiled with.
pub struct Parts {
    /// Forms that have not been compiled yet, the next one last.
    left: Vec<Value>,
}

impl Parts {
    /// The parts of a form.
    pub fn of(form: &Value) -> Parts {
        Parts {
            left: vec![form.clone()],
        }
    }

    /// Expands and compiles the next part.
    pub fn next(&mut self, image: &mut Image) -> Result<Option<Rc<Code>>, Box<Raise>> {
        while let Some(form) = self.left.pop() {
            let (form, _) = super::macroexpand(image, &form)?;
            let rest = form.cdr_or_nil();
            let parts = match form.car_or_nil().as_symbol() {
                Some(known::PROGN) => rest,
                Some(known::EVAL_WHEN) if is_executed(image, &rest.car_or_nil()) => {
                    rest.cdr_or_nil()
                }
                _ => return super::compile_form(image, &form).map(Some),
            };
            let parts: Vec<Value> = parts.iter_list().collect();
            self.left.extend(parts.into_iter().rev());
        }
        Ok(None)
    }
}

/// Do the situations of an `eval-when` include evaluation? While a file is loaded as if it had been
/// compiled, they also include loading and compiling.
pub(crate) fn is_executed(image: &Image, situations: &Value) -> bool {
    let as_compiled = image.special(known::V_AS_COMPILED).as_symbol() == Some(known::T);
    let mut situations = situations.iter_list().filter_map(|s| s.as_symbol());
    situations.any(|situation| match situation {
        known::K_EXECUTE | known::EVAL => true,
        known::K_LOAD_TOPLEVEL | known::K_COMPILE_TOPLEVEL => as_compiled,
        old => as_compiled && matches!(image.name(old), "LOAD" | "COMPILE"),
    })
}
