//! Running the methods of a call: around, before, primary, after; or combined by an operator.

use std::rc::Rc;

use super::effective::{Effective, Shape};
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::function::Function;
use crate::lisp::value::generic::{Combination, Method};
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::Sym;
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::{Resume, Step};

/// How far a call has come.
#[derive(Clone, Copy)]
pub(crate) enum Stage {
    /// At the around method of this number.
    Around(usize),
    /// At the primary method of this number.
    Primary(usize),
}

/// The begin of a call.
pub(crate) const START: Stage = Stage::Around(0);

/// Runs a call from a stage on.
pub(crate) fn run(
    effective: &Rc<Effective>,
    stage: Stage,
    args: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    let (around, before, primary, after, combination) = match &effective.shape {
        Shape::Combined {
            around,
            before,
            primary,
            after,
            combination,
        } => (around, before, primary, after, *combination),
        Shape::Single(method) | Shape::Read(_, method) | Shape::Write(_, method) => {
            return Ok(call(method, || Value::NIL, args));
        }
        // Callers deal with it.
        Shape::NotApplicable => return Err(nothing_to_run()),
    };
    match stage {
        Stage::Around(i) => {
            if let Some(method) = around.get(i) {
                let next = Stage::Around(i + 1);
                return Ok(invoke(effective, method, Some(next), args));
            }
            if !combination.is_standard() {
                return operate(effective, combination, primary, args);
            }
            if before.is_empty() && after.is_empty() {
                return run(effective, Stage::Primary(0), args);
            }
            let main = Box::new(Standard {
                effective: effective.clone(),
                args,
                done: 0,
                result: None,
            });
            main.next()
        }
        Stage::Primary(i) => match primary.get(i) {
            Some(method) => {
                let next = (i + 1 < primary.len()).then_some(Stage::Primary(i + 1));
                Ok(invoke(effective, method, next, args))
            }
            None => Err(nothing_to_run()),
        },
    }
}

/// The error that `call-next-method` has nothing to call.
pub(crate) fn no_next_method(image: &Image, name: &Value) -> Box<Raise> {
    let shown = super::qualified(image, name);
    let report = format!("There is no next method for the generic function {shown}.");
    Raise::new(known::NO_NEXT_METHOD_ERROR, report).with(known::K_METHOD, name.clone())
}

/// The error that an effective method has no method to run, which callers rule out.
fn nothing_to_run() -> Box<Raise> {
    Raise::new(known::NO_NEXT_METHOD_ERROR, "There is no next method.")
}

/// The call of one method; `next` is the stage that `call-next-method` goes on with.
fn invoke(
    effective: &Rc<Effective>,
    method: &Rc<Method>,
    next: Option<Stage>,
    args: Vec<Value>,
) -> Step {
    let next_args = if method.takes_next && next.is_some() {
        args.clone()
    } else {
        Vec::new()
    };
    call(
        method,
        || match next {
            Some(stage) => Value::Function(next_function(effective.clone(), stage, next_args)),
            None => Value::NIL,
        },
        args,
    )
}

fn call(method: &Rc<Method>, next: impl FnOnce() -> Value, mut args: Vec<Value>) -> Step {
    if method.takes_next {
        args.insert(0, next());
    }
    Step::TailCall {
        function: Value::Function(method.function.clone()),
        args,
    }
}

/// The function behind `call-next-method`: without arguments it uses those of the call.
fn next_function(effective: Rc<Effective>, stage: Stage, args: Vec<Value>) -> Rc<Function> {
    Function::made_control(known::CALL_NEXT_METHOD, (0, None), move |_, given| {
        let args = if given.is_empty() {
            args.clone()
        } else {
            given
        };
        run(&effective, stage, args)
    })
}

/// Before methods, the primary method, after methods; the value is that of the primary one.
struct Standard {
    effective: Rc<Effective>,
    args: Vec<Value>,
    /// Number of methods that have run.
    done: usize,
    result: Option<Value>,
}

impl Standard {
    fn next(mut self: Box<Self>) -> Result<Step, Box<Raise>> {
        let effective = self.effective.clone();
        let Shape::Combined { before, after, .. } = &effective.shape else {
            return Err(nothing_to_run());
        };
        let index = self.done;
        self.done += 1;
        if index == before.len() {
            let step = run(&effective, Stage::Primary(0), self.args.clone())?;
            return Ok(then(step, true, self));
        }
        let method = if index < before.len() {
            before.get(index)
        } else {
            after.get(index - before.len() - 1)
        };
        match method {
            Some(method) => {
                let step = call(method, || Value::NIL, self.args.clone());
                Ok(then(step, false, self))
            }
            None => Ok(Step::Return(self.result.unwrap_or(Value::NIL))),
        }
    }
}

impl Resume for Standard {
    fn resume(mut self: Box<Self>, _: &mut Machine<'_>, value: Value) -> Result<Step, Box<Raise>> {
        let is_primary = match &self.effective.shape {
            Shape::Combined { before, .. } => self.done == before.len() + 1,
            _ => false,
        };
        if is_primary {
            self.result = Some(value);
        }
        self.next()
    }

    fn name(&self) -> &'static str {
        "CALL-METHOD"
    }
}

/// Turns the tail call of a method into a call whose value goes to `next`.
fn then(step: Step, all_values: bool, next: Box<dyn Resume>) -> Step {
    match step {
        Step::TailCall { function, args } if all_values => Step::CallForValues {
            function,
            args,
            then: next,
        },
        Step::TailCall { function, args } => Step::Call {
            function,
            args,
            then: next,
        },
        // Methods are always tail calls.
        other => other,
    }
}

/// Runs all methods of an operator combination and combines their values.
fn operate(
    effective: &Rc<Effective>,
    combination: Combination,
    methods: &[Rc<Method>],
    args: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    if let [only] = methods
        && combination.is_identity
    {
        return Ok(invoke(effective, only, None, args));
    }
    Box::new(Operation {
        effective: effective.clone(),
        operator: combination.operator,
        args,
        values: Vec::new(),
    })
    .next()
}

struct Operation {
    effective: Rc<Effective>,
    operator: Sym,
    args: Vec<Value>,
    values: Vec<Value>,
}

impl Operation {
    fn next(self: Box<Self>) -> Result<Step, Box<Raise>> {
        let Shape::Combined { primary, .. } = &self.effective.shape else {
            return Err(nothing_to_run());
        };
        let Some(method) = primary.get(self.values.len()) else {
            return Ok(match self.operator {
                known::PROGN | known::AND | known::OR => {
                    Step::Return(self.values.last().cloned().unwrap_or(Value::NIL))
                }
                operator => Step::TailCall {
                    function: Value::Symbol(operator),
                    args: self.values,
                },
            });
        };
        let step = invoke(&self.effective, method, None, self.args.clone());
        Ok(then(step, false, self))
    }
}

impl Resume for Operation {
    fn resume(mut self: Box<Self>, _: &mut Machine<'_>, value: Value) -> Result<Step, Box<Raise>> {
        let decided = match self.operator {
            known::AND => value.is_nil(),
            known::OR => value.is_true(),
            _ => false,
        };
        if decided {
            return Ok(Step::Return(value));
        }
        self.values.push(value);
        self.next()
    }

    fn name(&self) -> &'static str {
        "CALL-METHOD"
    }
}
