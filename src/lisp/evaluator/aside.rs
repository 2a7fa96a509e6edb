//! Evaluation for a debugger, on top of a fiber that has stopped at a condition. The fiber's
//! bindings and restarts are in force, its handlers are not. When the evaluation has ended, the
//! fiber is as it was before.

use std::cell::RefCell;
use std::rc::Rc;

use crate::value::Value;
use crate::value::foreign::{Foreign, PrintContext};
use crate::value::function::Function;
use crate::value::known;
use crate::value::symbol::Sym;
use crate::vm::calls::run;
use crate::vm::fiber::Dynamic;
use crate::vm::machine::Machine;
use crate::vm::step::Step;

/// The state of an evaluation on top of a stopped fiber.
#[derive(Clone, Default)]
pub enum AsideState {
    /// It is under way.
    #[default]
    Running,
    /// It has returned these values to the debugger.
    Returned(Vec<Value>),
    /// It was ended by [`Aside::leave`].
    Ended,
    /// It left the stopped fiber by a non-local exit: a restart.
    Left,
}

/// An evaluation on top of a stopped fiber.
#[derive(Clone)]
pub struct Aside {
    state: Rc<RefCell<AsideState>>,
    tag: Value,
}

struct Tag;

impl Foreign for Tag {
    fn type_symbol(&self) -> Sym {
        known::CATCH
    }

    fn print(&self, _: &dyn PrintContext, _: bool) -> String {
        "#<DEBUGGER>".to_owned()
    }
}

impl Aside {
    /// An evaluation that has not begun.
    pub fn new() -> Aside {
        Aside {
            state: Rc::default(),
            tag: Value::foreign(Tag),
        }
    }

    pub fn state(&self) -> AsideState {
        self.state.borrow().clone()
    }

    /// The tag of a `catch` that the function must establish around its work.
    pub fn tag(&self) -> Value {
        self.tag.clone()
    }

    /// A function that calls another one aside, on a fiber that has stopped at `condition`. It must
    /// be called once.
    pub fn call(&self, condition: Value, function: Value, args: Vec<Value>) -> Value {
        let state = self.state.clone();
        let call = move |machine: &mut Machine<'_>, _| {
            let condition = condition.clone();
            machine.fiber.dynamic.push(Dynamic::HandlerMask {
                below: 0,
                condition: condition.clone(),
            });
            let back = Back(state.clone());
            let (function, args) = (function.clone(), args.clone());
            run(machine, "DEBUGGER", |calls| async move {
                let values = calls.call_for_values(&function, args).await;
                calls.with(|machine| machine.unmask_handlers()).await;
                back.returned(values);
                Ok(Step::Unhandled(condition))
            })
        };
        Value::Function(Function::made_control(known::EVAL, (0, Some(0)), call))
    }

    /// A function that ends the evaluation from within, at any depth.
    pub fn leave(&self) -> Value {
        let (state, tag) = (self.state.clone(), self.tag.clone());
        let call = move |machine: &mut Machine<'_>, _| {
            *state.borrow_mut() = AsideState::Ended;
            machine.throw(&tag, Value::NIL)
        };
        Value::Function(Function::made_control(known::THROW, (0, Some(0)), call))
    }
}

impl Default for Aside {
    fn default() -> Aside {
        Aside::new()
    }
}

/// Records how the evaluation ended.
struct Back(Rc<RefCell<AsideState>>);

impl Back {
    fn returned(&self, values: Value) {
        let mut state = self.0.borrow_mut();
        if matches!(*state, AsideState::Running) {
            *state = AsideState::Returned(values.into_values());
        }
    }
}

impl Drop for Back {
    /// Dropped before the evaluation has returned: a non-local exit has left it.
    fn drop(&mut self) {
        let mut state = self.0.borrow_mut();
        if matches!(*state, AsideState::Running) {
            *state = AsideState::Left;
        }
    }
}
