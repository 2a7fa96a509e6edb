//! Making condition objects.

use std::rc::Rc;

use crate::image::Image;
use crate::object::define::no_class;
use crate::value::Value;
use crate::value::class::{Class, ClassKind, Initform, Instance};
use crate::value::function::Function;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;

/// A condition object with slots that are still waiting for their initial values.
pub struct Draft {
    pub condition: Rc<Instance>,
    /// Positions of those slots, each with the function that computes its value.
    pub pending: Vec<(usize, Rc<Function>)>,
}

/// The condition that an error in Rust code stands for.
///
/// An explicit report is kept in the condition, so that it can be found again; a `SIMPLE-CONDITION`
/// also gets it as its format control.
pub fn make(image: &Image, raise: &Raise) -> Result<Value, Box<Raise>> {
    let (class, text, initargs) = match raise {
        Raise::Condition { condition, .. } => return Ok(condition.clone()),
        Raise::Make {
            class,
            report,
            initargs,
            ..
        } => (*class, report, initargs),
    };
    let class = condition_class(image, class)?;
    let draft = fill(&class, initargs);
    let condition = draft.condition;
    if let Some(text) = text {
        condition.set_slot(known::REPORT, Value::string(text.clone()));
        if condition
            .slot(known::FORMAT_CONTROL)
            .is_some_and(|v| v.is_nil())
        {
            condition.set_slot(
                known::FORMAT_CONTROL,
                Value::string(text.replace('~', "~~")),
            );
        }
    }
    Ok(Value::Instance(condition))
}

/// A condition of a class with initargs (keywords and values in turn); initargs that the
/// class does not know are ignored. Initial values that must be computed by a function are
/// left to the caller.
pub fn draft(image: &Image, class: Sym, initargs: &[Value]) -> Result<Draft, Box<Raise>> {
    let class = condition_class(image, class)?;
    if !initargs.len().is_multiple_of(2) {
        return Err(Raise::program("odd number of &KEY arguments"));
    }
    let pairs: Vec<(Sym, Value)> = initargs
        .chunks_exact(2)
        .filter_map(|pair| Some((pair[0].as_symbol()?, pair[1].clone())))
        .collect();
    Ok(fill(&class, &pairs))
}

/// Like [`draft`] when nothing must be computed; slots with computed initial values stay
/// unbound.
pub fn make_condition(image: &Image, class: Sym, initargs: &[Value]) -> Result<Value, Box<Raise>> {
    Ok(Value::Instance(draft(image, class, initargs)?.condition))
}

/// The report that is stored in the condition itself: that of an error in Rust code.
#[cfg(test)]
pub fn report(condition: &Value) -> Option<String> {
    match condition {
        Value::Instance(instance) => instance.slot(known::REPORT)?.as_text(),
        _ => None,
    }
}

fn condition_class(image: &Image, name: Sym) -> Result<Rc<Class>, Box<Raise>> {
    match image.class(name) {
        Some(class) if class.kind == ClassKind::Condition => Ok(class.clone()),
        Some(_) => Err(Raise::type_error(
            &Value::symbol(name),
            Value::symbol(known::CONDITION),
        )),
        None => Err(no_class(image, name)),
    }
}

/// Fills slots from initargs (the first of several wins), then default initargs, then initforms.
fn fill(class: &Rc<Class>, initargs: &[(Sym, Value)]) -> Draft {
    let condition = Rc::new(Instance::new(class.clone()));
    let mut pending = Vec::new();
    let defaults = class.default_initargs.borrow();
    for (index, slot) in class.slots.borrow().iter().enumerate() {
        let given = initargs.iter().find(|(k, _)| slot.initargs.contains(k));
        let init = match given {
            Some((_, value)) => Some(Initform::Value(value.clone())),
            None => defaults
                .iter()
                .find(|(k, _)| slot.initargs.contains(k))
                .map(|(_, form)| form.clone())
                .or_else(|| slot.initform.clone()),
        };
        match init {
            None => {}
            Some(Initform::Value(value)) => match &slot.shared {
                Some(shared) => shared.set(value),
                None => condition.slots.borrow_mut()[index] = value,
            },
            Some(Initform::Function(function)) => pending.push((index, function)),
        }
    }
    Draft { condition, pending }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::object::testing;

    fn slot(condition: &Value, name: Sym) -> Option<Value> {
        match condition {
            Value::Instance(instance) => instance.slot(name),
            _ => None,
        }
    }

    #[test]
    fn a_type_error_keeps_datum_and_expected_type() {
        let image = testing::image();
        let raise = Raise::type_error(&Value::Int(5), known::LIST);
        let condition = make(&image, &raise).ok().expect("a condition");
        assert!(slot(&condition, known::DATUM).is_some_and(|v| v.is_eq(&Value::Int(5))));
        assert!(
            slot(&condition, known::EXPECTED_TYPE)
                .is_some_and(|v| v.as_symbol() == Some(known::LIST))
        );
        assert_eq!(report(&condition), None);
    }

    #[test]
    fn an_explicit_report_is_kept_and_is_a_format_control_without_directives() {
        let image = testing::image();
        let condition = make(&image, &Raise::simple("50~ of it"))
            .ok()
            .expect("made");
        assert_eq!(report(&condition).as_deref(), Some("50~ of it"));
        let control = slot(&condition, known::FORMAT_CONTROL).and_then(|v| v.as_text());
        assert_eq!(control.as_deref(), Some("50~~ of it"));
    }

    #[test]
    fn unknown_initargs_are_ignored() {
        let image = testing::image();
        let initargs = [Value::symbol(known::K_COUNT), Value::Int(1)];
        assert!(make_condition(&image, known::SIMPLE_ERROR, &initargs).is_ok());
    }

    #[test]
    fn a_class_that_is_no_condition_is_a_type_error() {
        let image = testing::image();
        assert!(make_condition(&image, known::INTEGER, &[]).is_err());
    }
}
