//! `#n=` and `#n#`: forms that share parts or contain themselves.

use std::collections::HashSet;
use std::rc::Rc;

use super::error::ReadErrorKind;
use crate::value::Value;
use crate::value::cycles;

/// The labels of one top-level form.
#[derive(Default)]
pub(crate) struct Labels {
    entries: Vec<Label>,
}

struct Label {
    number: u32,
    /// The labelled form; while that is unfinished, a pair that stands for it.
    value: Value,
    is_finished: bool,
    is_referenced: bool,
}

impl Labels {
    /// Starts a labelled form.
    pub(crate) fn open(&mut self, number: u32) -> Result<(), ReadErrorKind> {
        if self.entries.iter().any(|l| l.number == number) {
            return Err(ReadErrorKind::BadLabel(format!(
                "multiply defined label: #{number}="
            )));
        }
        self.entries.push(Label {
            number,
            value: Value::cons(Value::NIL, Value::NIL),
            is_finished: false,
            is_referenced: false,
        });
        Ok(())
    }

    /// The form that a label stands for.
    pub(crate) fn reference(&mut self, number: Option<u32>) -> Result<Value, ReadErrorKind> {
        let number = number.ok_or(ReadErrorKind::DispatchArgument {
            letter: '#',
            reason: "the label",
        })?;
        match self.entries.iter_mut().find(|l| l.number == number) {
            Some(label) => {
                label.is_referenced = true;
                Ok(label.value.clone())
            }
            None => Err(ReadErrorKind::BadLabel(format!(
                "reference to undefined label #{number}#"
            ))),
        }
    }

    /// Ends a labelled form.
    pub(crate) fn close(&mut self, number: u32, value: &Value) -> Result<(), ReadErrorKind> {
        let Some(label) = self.entries.iter_mut().find(|l| l.number == number) else {
            return Ok(());
        };
        if label.value.is_eq(value) {
            return Err(ReadErrorKind::BadLabel(format!(
                "#{number}=#{number}# labels nothing"
            )));
        }
        let placeholder = std::mem::replace(&mut label.value, value.clone());
        label.is_finished = true;
        if label.is_referenced {
            replace(value, &placeholder, value);
        }
        Ok(())
    }
}

/// Puts `new` in place of `old` everywhere inside `root`.
fn replace(root: &Value, old: &Value, new: &Value) {
    let mut seen: HashSet<*const ()> = HashSet::new();
    let mut pending = vec![root.clone()];
    let visit = |part: &Value, pending: &mut Vec<Value>| -> Option<Value> {
        if part.is_eq(old) {
            return Some(new.clone());
        }
        pending.push(part.clone());
        None
    };
    while let Some(value) = pending.pop() {
        match &value {
            Value::Cons(cons) => {
                if !seen.insert(Rc::as_ptr(cons).cast()) {
                    continue;
                }
                if let Some(new) = visit(&cons.cdr(), &mut pending) {
                    cycles::note(cons, &new);
                    cons.set_cdr(new);
                }
                if let Some(new) = visit(&cons.car(), &mut pending) {
                    cycles::note(cons, &new);
                    cons.set_car(new);
                }
            }
            Value::Vector(vector) if seen.insert(Rc::as_ptr(vector).cast()) => {
                vector.items.change(|item| {
                    if let Some(new) = visit(item, &mut pending) {
                        *item = new;
                    }
                });
            }
            Value::Array(array) if seen.insert(Rc::as_ptr(array).cast()) => {
                array.items.change(|item| {
                    if let Some(new) = visit(item, &mut pending) {
                        *item = new;
                    }
                });
            }
            Value::Instance(instance) if seen.insert(Rc::as_ptr(instance).cast()) => {
                for item in instance.slots.borrow_mut().iter_mut() {
                    if let Some(new) = visit(item, &mut pending) {
                        *item = new;
                    }
                }
            }
            _ => {}
        }
    }
}
