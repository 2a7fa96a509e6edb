//! Calls: finding the function, arranging its arguments, entering its code.

use std::rc::Rc;

use super::entry::Next;
use crate::image::Image;
use crate::native::NativeCall;
use crate::object;
use crate::object::dispatch::AtOnce;
use crate::print;
use crate::value::Value;
use crate::value::code::Code;
use crate::value::function::{Body, Function};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::fiber::Dynamic;
use crate::vm::frames::{Frame, FrameKind};
use crate::vm::machine::Machine;

/// The most calls that may be open at once.
pub(super) const MAX_FRAMES: usize = 1_000_000;
/// Calls allowed beyond that limit for the handlers of the error that it causes.
const SPARE_FRAMES: usize = 10_000;

impl Machine<'_> {
    /// Calls a function, or the function of a symbol, with its arguments in a vector.
    pub(super) fn call_value(&mut self, function: Value, args: Vec<Value>, multi: bool) -> Next {
        let function = match self.image.coerce_to_function(&function) {
            Ok(f) => f,
            Err(raise) => return self.raise(raise),
        };
        let cut = self.fiber.stack.len();
        match &function.body {
            Body::Native(native) => {
                if !native.accepts(args.len()) {
                    return self.raise(wrong_count(native.name.into(), args.len()));
                }
                match self.image.native_call(native) {
                    NativeCall::Pure(f) => match f(self.image, &args) {
                        Ok(value) => Next::Deliver(if multi { value } else { value.primary() }),
                        Err(raise) => self.instead(native.name, args, raise, multi),
                    },
                    NativeCall::Made(f) => match f(self.image, &args) {
                        Ok(value) => Next::Deliver(if multi { value } else { value.primary() }),
                        Err(raise) => self.raise(raise),
                    },
                    NativeCall::Control(f) => match f(self, args) {
                        Ok(step) => self.take_step(step, multi),
                        Err(raise) => self.raise(raise),
                    },
                    NativeCall::MadeControl(f) => match f(self, args) {
                        Ok(step) => self.take_step(step, multi),
                        Err(raise) => self.raise(raise),
                    },
                }
            }
            Body::Generic(_) => match object::dispatch::call_generic(self, &function, args) {
                Ok(step) => self.take_step(step, multi),
                Err(raise) => self.raise(raise),
            },
            Body::Deferred(deferred) => match self.image.force(deferred) {
                Ok(function) => self.call_value(Value::Function(function), args, multi),
                Err(raise) => self.raise(raise),
            },
            Body::Closure { code, .. } => {
                let code = code.clone();
                let count = args.len();
                self.fiber.stack.extend(args);
                match self.enter_closure(function, &code, count, cut, multi) {
                    Ok(()) => Next::Run,
                    Err(raise) => {
                        self.fiber.stack.truncate(cut);
                        self.raise(raise)
                    }
                }
            }
        }
    }

    /// Enters a closure whose arguments are on the stack.
    fn enter_closure(
        &mut self,
        function: Rc<Function>,
        code: &Rc<Code>,
        count: usize,
        cut: usize,
        multi: bool,
    ) -> Result<(), Box<Raise>> {
        let depth = self.fiber.frames.len();
        if depth >= MAX_FRAMES {
            self.check_depth(depth)?;
        }
        match code.exact_count {
            Some(exact) if count == usize::from(exact) => {}
            Some(_) => return Err(wrong_count(code.name.value(), count)),
            None => self.arrange_arguments(code, count)?,
        }
        let base = self.fiber.stack.len() - code.parameters.slots();
        let dynamic = self.fiber.dynamic.len();
        let frames = &mut self.fiber.frames;
        frames.enter(function, base, cut, dynamic, multi);
        Ok(())
    }

    fn check_depth(&self, frames: usize) -> Result<(), Box<Raise>> {
        let handling = self
            .fiber
            .dynamic
            .iter()
            .any(|d| matches!(d, Dynamic::HandlerMask { .. } | Dynamic::Unwind { .. }));
        let limit = MAX_FRAMES + if handling { SPARE_FRAMES } else { 0 };
        if frames < limit {
            return Ok(());
        }
        Err(Raise::new(
            known::CONTROL_STACK_EXHAUSTED,
            format!(
                "Control stack exhausted: {MAX_FRAMES} calls are open. Is there a recursion that never ends?"
            ),
        ))
    }

    /// Brings arguments on the stack into the order of the parameters' slots.
    fn arrange_arguments(&mut self, code: &Code, count: usize) -> Result<(), Box<Raise>> {
        let parameters = &code.parameters;
        let required = usize::from(parameters.required);
        let optional = usize::from(parameters.optional);
        let positional = required + optional;
        let takes_more = parameters.rest || parameters.has_keys;
        if count < required || (count > positional && !takes_more) {
            return Err(wrong_count(code.name.value(), count));
        }
        let stack = &mut self.fiber.stack;
        let start = stack.len() - count;
        if count < positional {
            stack.fill_up(start + positional);
            if parameters.rest {
                stack.push(Value::NIL);
            }
            stack.fill_up(stack.len() + parameters.keys.len());
            return Ok(());
        }
        let more = stack.split_off(start + positional);
        if parameters.has_keys {
            check_keywords(self.image, code, &more)?;
        }
        let stack = &mut self.fiber.stack;
        if parameters.rest {
            stack.push(Value::list(more.iter().cloned()));
        }
        for key in parameters.keys.iter() {
            let value = more
                .chunks_exact(2)
                .find(|pair| pair[0].as_symbol() == Some(*key))
                .map_or(Value::Unbound, |pair| pair[1].clone());
            stack.push(value);
        }
        Ok(())
    }

    /// Calls a function whose arguments are the topmost `count` values; the result replaces
    /// everything from `cut` up.
    pub(super) fn call_on_stack(
        &mut self,
        function: Rc<Function>,
        count: usize,
        cut: usize,
        multi: bool,
    ) -> Next {
        if let Body::Closure { code, .. } = &function.body {
            let code = code.clone();
            return match self.enter_closure(function, &code, count, cut, multi) {
                Ok(()) => Next::Run,
                Err(raise) => {
                    self.fiber.stack.truncate(cut);
                    self.raise(raise)
                }
            };
        }
        if let Body::Deferred(deferred) = &function.body {
            return match self.image.force(deferred) {
                Ok(function) => self.call_on_stack(function, count, cut, multi),
                Err(raise) => {
                    self.fiber.stack.truncate(cut);
                    self.raise(raise)
                }
            };
        }
        let start = self.fiber.stack.len() - count;
        if let Body::Generic(generic) = &function.body {
            let args = &self.fiber.stack[start..];
            match object::dispatch::call_at_once(self.image, generic, args) {
                Some(AtOnce::Slot(value)) => {
                    self.fiber.stack.truncate(cut);
                    self.fiber.stack.push(value);
                    return Next::Run;
                }
                Some(AtOnce::Method(method)) => {
                    return self.call_on_stack(method, count, cut, multi);
                }
                None => {}
            }
        }
        if let Body::Native(native) = &function.body
            && native.accepts(count)
            && let Some(f) = self.image.pure_call(native)
        {
            let window = self.fiber.stack.window(cut, start + count - cut);
            window.close_below(0);
            let result = f(self.image, &window.slots[start - cut..window.top]);
            window.close();
            return match result {
                Ok(value) => {
                    self.fiber.stack.truncate(cut);
                    let value = if multi { value } else { value.primary() };
                    self.fiber.stack.push(value);
                    Next::Run
                }
                Err(raise) => self.failed(native.name, raise, start, cut, multi),
            };
        }
        let args = self.fiber.stack.split_off(start);
        self.fiber.stack.truncate(cut);
        match self.call_value(Value::Function(function), args, multi) {
            Next::Deliver(value)
                if matches!(
                    self.fiber.frames.last(),
                    Some(Frame {
                        kind: FrameKind::Code { .. },
                        ..
                    })
                ) =>
            {
                self.fiber.stack.push(value);
                Next::Run
            }
            next => next,
        }
    }

    /// Calls the function below the topmost `count` results with all their values.
    pub(super) fn call_with_values(&mut self, count: usize, multi: bool) -> Next {
        let start = self.fiber.stack.len() - count;
        let mut args = Vec::with_capacity(count);
        for result in self.fiber.stack.split_off(start) {
            match result {
                Value::Multiple(values) => args.extend(values.iter().cloned()),
                single => args.push(single),
            }
        }
        let called = self.pop();
        self.call_value(called, args, multi)
    }

    /// A pure builtin with the values from `start` up has failed; everything from `cut` up is given
    /// up. See [`Self::instead`].
    #[cold]
    pub(super) fn failed(
        &mut self,
        name: Sym,
        raise: Box<Raise>,
        start: usize,
        cut: usize,
        multi: bool,
    ) -> Next {
        let args = self.fiber.stack.split_off(start);
        self.fiber.stack.truncate(cut);
        self.instead(name, args, raise, multi)
    }

    /// What happens after a pure builtin has failed: the error, unless an object was given to it as a
    /// stream. Then it has done nothing yet, and what the object's methods do takes its place.
    #[cold]
    fn instead(&mut self, name: Sym, args: Vec<Value>, raise: Box<Raise>, multi: bool) -> Next {
        match raise.stream_object() {
            Some(stream) => {
                let args = vec![name.into(), Value::list(args), stream.clone()];
                self.call_value(known::SYS_CALL_STREAM_METHOD.into(), args, multi)
            }
            None => self.raise(raise),
        }
    }
}

/// The error of a call of the named function with so many arguments.
fn wrong_count(name: Value, count: usize) -> Box<Raise> {
    Raise::program(format!("invalid number of arguments: {count}")).with(known::K_NAME, name)
}

fn check_keywords(image: &Image, code: &Code, more: &[Value]) -> Result<(), Box<Raise>> {
    if !more.len().is_multiple_of(2) {
        return Err(Raise::program("odd number of &KEY arguments"));
    }
    let others_allowed = code.parameters.allow_other_keys
        || more
            .chunks_exact(2)
            .find(|pair| pair[0].as_symbol() == Some(known::K_ALLOW_OTHER_KEYS))
            .is_some_and(|pair| pair[1].is_true());
    if others_allowed {
        return Ok(());
    }
    for pair in more.chunks_exact(2) {
        let is_known = pair[0]
            .as_symbol()
            .is_some_and(|s| s == known::K_ALLOW_OTHER_KEYS || code.parameters.keys.contains(&s));
        if !is_known {
            let shown = print::to_string(image, &pair[0], true);
            let keys = code.parameters.keys.iter().map(|key| image.name(*key));
            let raise = Raise::unknown_key(&shown, keys);
            return Err(raise.with(known::K_NAME, code.name.value()));
        }
    }
    Ok(())
}
