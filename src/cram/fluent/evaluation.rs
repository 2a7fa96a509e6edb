//! Computes the value of a fluent.
//!
//! The computation has its own stack, because chains of networks may be long, and it pauses at each
//! call of a Lisp function.

use super::{FluentRef, Kind, Missed, Operation};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;
use lisp::vm::calls::Calls;
use lisp::vm::computation::{Computation, Progress, compute};
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// The computation of a fluent's value.
pub(crate) struct Reading {
    stack: Vec<Frame>,
    /// Whether pulses and changes remain unread.
    peek: bool,
}

struct Frame {
    fluent: FluentRef,
    args: Vec<Value>,
    next: usize,
    values: Vec<Value>,
    /// Whether the function of the network has been called.
    is_called: bool,
}

impl Reading {
    /// Starts to compute the value of the fluent; with `fresh`, a cached value is not used.
    pub(crate) fn new(fluent: &FluentRef, peek: bool, fresh: bool) -> Reading {
        let mut reading = Reading {
            stack: Vec::new(),
            peek,
        };
        if fresh && let Kind::Net { cache, .. } = &fluent.get().kind {
            cache.set(Value::Unbound);
        }
        reading.push(fluent.clone());
        reading
    }

    fn push(&mut self, fluent: FluentRef) {
        let args = match &fluent.get().kind {
            Kind::Net {
                args, operation, ..
            } => {
                let mut args = args.borrow().clone();
                if matches!(operation, Operation::Apply(_))
                    && let Some(last) = args.pop()
                {
                    args.extend(last.iter_list());
                }
                args
            }
            _ => Vec::new(),
        };
        self.stack.push(Frame {
            fluent,
            args,
            next: 0,
            values: Vec::new(),
            is_called: false,
        });
    }

    /// Continues; `answer` is the value of the call at which it paused.
    pub(super) fn go_on(
        &mut self,
        image: &mut Image,
        answer: Option<Value>,
    ) -> Result<Progress<Value>> {
        let mut incoming = answer;
        loop {
            let Some(frame) = self.stack.last_mut() else {
                return Ok(Progress::Done(incoming.unwrap_or(Value::NIL)));
            };
            let fluent = frame.fluent.clone();
            if let Some(value) = incoming.take() {
                if frame.is_called {
                    incoming = Some(self.finish(value));
                    continue;
                }
                frame.values.push(value);
            }
            match &fluent.get().kind {
                Kind::Value { value, .. } => incoming = Some(self.finish(value.get())),
                Kind::Net {
                    operation, cache, ..
                } => {
                    let known = cache.get();
                    if !known.is_unbound() {
                        self.stack.pop();
                        incoming = Some(known);
                        continue;
                    }
                    match net_step(operation, frame) {
                        NetStep::Value(value) => incoming = Some(self.finish(value)),
                        NetStep::Read(source) => self.push(source),
                        NetStep::Pure(function, args) => {
                            let value = function(image, &args)?.primary();
                            incoming = Some(self.finish(value));
                        }
                        NetStep::Call(function, args) => {
                            frame.is_called = true;
                            return Ok(Progress::Call { function, args });
                        }
                    }
                }
                Kind::Pulses {
                    source,
                    mode,
                    processed,
                } => {
                    let reference = source.get().pulses.get();
                    let is_pulsed = processed.get() < reference;
                    if is_pulsed && !self.peek {
                        processed.set(match mode {
                            Missed::Always => processed.get() + 1,
                            Missed::Once | Missed::Never => reference,
                        });
                    }
                    incoming = Some(self.finish(Value::bool(is_pulsed)));
                }
                Kind::Change {
                    source,
                    test,
                    key,
                    old,
                } => match change_step(frame, source, test, key, old) {
                    ChangeStep::Read(source) => self.push(source),
                    ChangeStep::Call(function, args) => {
                        return Ok(Progress::Call { function, args });
                    }
                    ChangeStep::Value { now, is_same } => {
                        if !is_same && !self.peek {
                            old.set(now);
                        }
                        incoming = Some(self.finish(Value::bool(!is_same)));
                    }
                },
            }
        }
    }

    /// Ends the computation of the topmost fluent, whose value is given.
    fn finish(&mut self, value: Value) -> Value {
        if let Some(frame) = self.stack.pop()
            && let Kind::Net {
                cache,
                is_cacheable: true,
                ..
            } = &frame.fluent.get().kind
        {
            cache.set(value.clone());
        }
        value
    }
}

enum NetStep {
    Value(Value),
    Read(FluentRef),
    Pure(lisp::native::PureFn, Vec<Value>),
    Call(Value, Vec<Value>),
}

fn net_step(operation: &Operation, frame: &mut Frame) -> NetStep {
    loop {
        let decided = match (operation, frame.values.last()) {
            (Operation::And, Some(value)) if value.is_nil() => Some(Value::NIL),
            (Operation::Or, Some(value)) if value.is_true() => Some(value.clone()),
            _ => None,
        };
        if let Some(value) = decided {
            return NetStep::Value(value);
        }
        let Some(arg) = frame.args.get(frame.next) else {
            break;
        };
        frame.next += 1;
        match FluentRef::from_value(arg) {
            Some(source) => match source.get().known_value() {
                Some(value) => frame.values.push(value),
                None => return NetStep::Read(source),
            },
            None => frame.values.push(arg.clone()),
        }
    }
    let mut values = std::mem::take(&mut frame.values);
    match operation {
        Operation::And => NetStep::Value(values.pop().unwrap_or(Value::T)),
        Operation::Or => NetStep::Value(values.pop().unwrap_or(Value::NIL)),
        Operation::Pure(function) => NetStep::Pure(*function, values),
        Operation::Call(function) => NetStep::Call(function.clone(), values),
        Operation::Apply(function) => {
            let Kind::Net { args, .. } = &frame.fluent.get().kind else {
                return NetStep::Value(Value::NIL);
            };
            let spread = args.borrow().len().saturating_sub(1);
            let list = Value::list(values.split_off(spread.min(values.len())));
            values.push(list);
            NetStep::Call(function.clone(), values)
        }
    }
}

enum ChangeStep {
    Read(FluentRef),
    Call(Value, Vec<Value>),
    Value { now: Value, is_same: bool },
}

/// The values in the frame are the source's value, its key, and the result of the test.
fn change_step(
    frame: &mut Frame,
    source: &FluentRef,
    test: &Value,
    key: &Value,
    old: &lisp::value::slot::Slot,
) -> ChangeStep {
    let Some(value) = frame.values.first().cloned() else {
        return ChangeStep::Read(source.clone());
    };
    if frame.values.len() == 1 {
        if key.is_true() {
            return ChangeStep::Call(key.clone(), vec![value]);
        }
        frame.values.push(value);
    }
    let now = frame.values.get(1).cloned().unwrap_or(Value::NIL);
    if frame.values.len() == 2 {
        if test.is_true() {
            return ChangeStep::Call(test.clone(), vec![now, old.get()]);
        }
        frame.values.push(Value::bool(now.is_eql(&old.get())));
    }
    let is_same = frame.values.get(2).is_some_and(Value::is_true);
    ChangeStep::Value { now, is_same }
}

impl Computation for Reading {
    type Output = Value;

    fn advance(
        &mut self,
        machine: &mut Machine<'_>,
        answer: Option<Value>,
    ) -> Result<Progress<Value>> {
        self.go_on(machine.image, answer)
    }
}

/// The value of a fluent, for use inside a builtin.
pub(crate) async fn value(calls: &Calls, fluent: &FluentRef) -> Result<Value> {
    match fluent.get().known_value() {
        Some(value) => Ok(value),
        None => calls.compute(Reading::new(fluent, false, false)).await,
    }
}

/// The step that returns the value of a fluent.
pub(crate) fn read(machine: &mut Machine<'_>, fluent: &FluentRef, peek: bool) -> Result<Step> {
    match fluent.get().known_value() {
        Some(value) => Ok(Step::Return(value)),
        None => compute(machine, "VALUE", Reading::new(fluent, peek, false)),
    }
}
