//! Evaluation at top level in two steps: compiling a form, and running its code.

use std::rc::Rc;

use crate::image::Image;
use crate::value::Value;
use crate::value::code::Code;
use crate::value::known;
use crate::value::raise::Raise;

/// Compiles a form as `eval` does, part by part, and lets each part be run before the next one is
/// expanded.
pub fn evaluate_each<E: From<Box<Raise>>>(
    image: &mut Image,
    form: &Value,
    run: &mut dyn FnMut(&mut Image, Rc<Code>) -> Result<(), E>,
) -> Result<(), E> {
    let mut left = vec![form.clone()];
    while let Some(form) = left.pop() {
        let (form, _) = super::macroexpand(image, &form)?;
        let rest = form.cdr_or_nil();
        let parts = match form.car_or_nil().as_symbol() {
            Some(known::PROGN) => rest,
            Some(known::EVAL_WHEN) if is_executed(&rest.car_or_nil()) => rest.cdr_or_nil(),
            _ => {
                let code = super::compile_form(image, &form)?;
                run(image, code)?;
                continue;
            }
        };
        let parts: Vec<Value> = parts.iter_list().collect();
        left.extend(parts.into_iter().rev());
    }
    Ok(())
}

/// Do the situations of an `eval-when` include evaluation?
pub(crate) fn is_executed(situations: &Value) -> bool {
    let mut situations = situations.iter_list();
    situations.any(|s| matches!(s.as_symbol(), Some(known::K_EXECUTE | known::EVAL)))
}
