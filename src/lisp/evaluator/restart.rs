//! Restarts: named ways to continue, which a condition's handler or the user may choose.

use std::cell::RefCell;

use crate::value::Value;
use crate::value::foreign::{Foreign, PrintContext};
use crate::value::function::Function;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::fiber::Dynamic;
use crate::vm::frames::{Frame, FrameKind};
use crate::vm::machine::Machine;

pub struct Restart {
    /// Its name; `NIL` for an anonymous one.
    pub name: Sym,
    /// The function that it calls.
    pub function: Value,
    /// A string, or a function of a stream that describes it; `NIL` if there is none.
    pub report: Value,
    /// A function that asks for the arguments; `NIL` if there is none.
    pub interactive: Value,
    /// A function of a condition, or of `NIL`, that says whether it applies; `NIL` if there is none.
    pub test: Value,
    /// The conditions that it belongs to.
    pub conditions: RefCell<Vec<Value>>,
}

impl Restart {
    /// May it be offered for this condition (`NIL`: for none in particular), its test aside?
    pub(crate) fn may_apply_to(&self, condition: &Value) -> bool {
        let conditions = self.conditions.borrow();
        condition.is_nil() || conditions.is_empty() || conditions.iter().any(|c| c.is_eq(condition))
    }
}

impl Foreign for Restart {
    fn type_symbol(&self) -> Sym {
        known::RESTART
    }

    fn print(&self, context: &dyn PrintContext, escape: bool) -> String {
        let name = context.name(self.name);
        if escape {
            format!("#<RESTART {name}>")
        } else if let Value::Str(text) = &self.report {
            text.text()
        } else {
            name.to_owned()
        }
    }

    fn may_be_in_circle(&self) -> bool {
        true
    }

    fn for_each_reference(&self, visit: &mut dyn FnMut(&Value)) {
        for part in [&self.function, &self.report, &self.interactive, &self.test] {
            visit(part);
        }
        if let Ok(conditions) = self.conditions.try_borrow() {
            conditions.iter().for_each(visit);
        }
    }

    fn let_go(&self) {
        self.conditions.take();
    }

    fn writer(&self) -> Option<Value> {
        let is_function = !matches!(self.report, Value::Str(_)) && self.report.is_true();
        is_function.then(|| self.report.clone())
    }
}

/// The tag of the catch at which a failed operation receives the value that it lacked.
struct FailedOperation;

impl Foreign for FailedOperation {
    fn type_symbol(&self) -> Sym {
        known::CATCH
    }

    fn print(&self, _: &dyn PrintContext, _: bool) -> String {
        "#<FAILED-OPERATION>".to_owned()
    }
}

impl Machine<'_> {
    /// Establishes the restarts of an error about an unbound variable or an undefined function:
    /// they supply the value that the failed operation lacks.
    pub(super) fn offer_restarts(&mut self, raise: &Raise) {
        let Raise::Make {
            class, initargs, ..
        } = raise
        else {
            return;
        };
        let name = initargs
            .iter()
            .find(|(key, _)| *key == known::K_NAME)
            .and_then(|(_, name)| name.as_symbol());
        let (
            Some(name),
            Some(Frame {
                kind: FrameKind::Code { pc, .. },
                ..
            }),
        ) = (name, self.fiber.frames.last())
        else {
            return;
        };
        let is_variable = match *class {
            known::UNBOUND_VARIABLE => true,
            known::UNDEFINED_FUNCTION => false,
            _ => return,
        };
        let tag = Value::foreign(FailedOperation);
        self.fiber.dynamic.push(Dynamic::Catch {
            tag: tag.clone(),
            frame: self.fiber.frames.len() - 1,
            height: self.fiber.stack.len(),
            target: u32::try_from(pc.get()).unwrap_or(u32::MAX),
            multi: false,
        });
        let give = move |how: fn(&mut Machine<'_>, Sym, Value)| {
            let tag = tag.clone();
            Function::made_control(known::USE_VALUE, (0, Some(1)), move |machine, args| {
                let value = match args.into_iter().next() {
                    Some(value) => value,
                    None => machine.image.special(name).clone(),
                };
                if value.is_unbound() {
                    return Err(Raise::unbound_variable(name));
                }
                how(machine, name, value.clone());
                machine.throw(&tag, value)
            })
        };
        let restart = |name, report: &str, function| {
            Value::foreign(Restart {
                name,
                function: Value::Function(function),
                report: report.into(),
                interactive: Value::NIL,
                test: Value::NIL,
                conditions: RefCell::default(),
            })
        };
        let shown = self.image.name(name).to_owned();
        let mut restarts = Vec::new();
        if is_variable {
            let report = format!("Retry using {shown}.");
            restarts.push(restart(known::CONTINUE, &report, give(|_, _, _| {})));
        }
        restarts.push(restart(
            known::USE_VALUE,
            "Use specified value.",
            give(|_, _, _| {}),
        ));
        if is_variable {
            restarts.push(restart(
                known::STORE_VALUE,
                "Set specified value and use it.",
                give(|machine, name, value| machine.image.set_special(name, value)),
            ));
        }
        let list = Value::list(restarts);
        self.fiber.dynamic.push(Dynamic::Restarts(list));
    }

    /// The restarts in force, innermost first.
    pub fn restarts(&self) -> Vec<Value> {
        self.fiber
            .dynamic
            .iter()
            .rev()
            .filter_map(|entry| match entry {
                Dynamic::Restarts(list) => Some(list.iter_list()),
                _ => None,
            })
            .flatten()
            .collect()
    }
}
