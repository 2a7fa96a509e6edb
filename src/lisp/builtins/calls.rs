//! Builtins that call Lisp functions, written as asynchronous Rust functions.
//!
//! Such a builtin awaits each call. The Rust compiler turns it into a state machine, and
//! [`run`] makes that a [`Resume`]: each call suspends the builtin and goes through the
//! machine, so it may wait, unwind, or be interrupted, and nothing recurses on the Rust
//! stack. Calls of pure builtins are answered at once, without the machine.

use std::cell::Cell;
use std::future::Future;
use std::pin::Pin;
use std::rc::Rc;
use std::task::{Context, Poll, Waker};

use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::function::{Body, Function, NativeCall};
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::{FunctionCell, known};
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::{Resume, Step};

/// How many pure builtins are called in a row before the machine gets a turn, so that
/// endless ones can be interrupted.
const DIRECT_CALLS: u32 = 1000;

/// Arguments of a call.
pub(crate) enum Args {
    /// One argument.
    One([Value; 1]),
    /// Two arguments.
    Two([Value; 2]),
    /// Any number.
    Many(Vec<Value>),
}

impl Args {
    fn as_slice(&self) -> &[Value] {
        match self {
            Args::One(args) => args,
            Args::Two(args) => args,
            Args::Many(args) => args,
        }
    }

    fn into_vec(self) -> Vec<Value> {
        match self {
            Args::One(args) => args.into(),
            Args::Two(args) => args.into(),
            Args::Many(args) => args,
        }
    }
}

struct Request {
    function: Value,
    args: Args,
}

#[derive(Default)]
struct Exchange {
    request: Cell<Option<Request>>,
    answer: Cell<Option<Value>>,
}

/// What an asynchronous builtin calls functions with.
pub(crate) struct Calls(Rc<Exchange>);

impl Calls {
    /// Calls a function with one argument; the primary value.
    pub(crate) fn call1(&self, function: &Value, a: Value) -> Call<'_> {
        self.call(function, Args::One([a]))
    }

    /// Calls a function with two arguments; the primary value.
    pub(crate) fn call2(&self, function: &Value, a: Value, b: Value) -> Call<'_> {
        self.call(function, Args::Two([a, b]))
    }

    /// Calls a function; the primary value.
    pub(crate) fn call(&self, function: &Value, args: Args) -> Call<'_> {
        let function = function.clone();
        Call {
            exchange: &self.0,
            request: Some(Request { function, args }),
        }
    }
}

/// A call under way.
pub(crate) struct Call<'a> {
    exchange: &'a Exchange,
    request: Option<Request>,
}

impl Future for Call<'_> {
    type Output = Value;

    fn poll(mut self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<Value> {
        if let Some(request) = self.request.take() {
            self.exchange.request.set(Some(request));
            return Poll::Pending;
        }
        match self.exchange.answer.take() {
            Some(value) => Poll::Ready(value),
            None => Poll::Pending,
        }
    }
}

type Outcome = Result<Value, Box<Raise>>;

/// Runs an asynchronous builtin until it returns or needs the machine for a call.
pub(crate) fn run<F>(
    machine: &mut Machine<'_>,
    name: &'static str,
    body: impl FnOnce(Calls) -> F,
) -> Result<Step, Box<Raise>>
where
    F: Future<Output = Outcome> + 'static,
{
    let exchange = Rc::new(Exchange::default());
    let future = Box::pin(body(Calls(exchange.clone())));
    Box::new(Suspended {
        name,
        exchange,
        future,
    })
    .advance(machine)
}

struct Suspended<F> {
    name: &'static str,
    exchange: Rc<Exchange>,
    future: Pin<Box<F>>,
}

impl<F: Future<Output = Outcome> + 'static> Suspended<F> {
    fn advance(mut self: Box<Self>, machine: &mut Machine<'_>) -> Result<Step, Box<Raise>> {
        let mut context = Context::from_waker(Waker::noop());
        let mut budget = DIRECT_CALLS;
        loop {
            if let Poll::Ready(outcome) = self.future.as_mut().poll(&mut context) {
                return outcome.map(Step::Return);
            }
            // A builtin awaits nothing but calls, so a request is there.
            let Some(Request { function, args }) = self.exchange.request.take() else {
                return Ok(Step::Return(Value::NIL));
            };
            budget -= 1;
            if budget > 0
                && let Some(value) = call_directly(machine.image, &function, args.as_slice())
            {
                self.exchange.answer.set(Some(value?.primary()));
                continue;
            }
            return Ok(Step::Call {
                function,
                args: args.into_vec(),
                then: self,
            });
        }
    }
}

impl<F: Future<Output = Outcome> + 'static> Resume for Suspended<F> {
    fn resume(
        self: Box<Self>,
        machine: &mut Machine<'_>,
        value: Value,
    ) -> Result<Step, Box<Raise>> {
        self.exchange.answer.set(Some(value));
        self.advance(machine)
    }

    fn name(&self) -> &'static str {
        self.name
    }
}

/// Calls a pure builtin that accepts this number of arguments; none for other functions.
fn call_directly(image: &mut Image, function: &Value, args: &[Value]) -> Option<Outcome> {
    let function = function_of(image, function)?.clone();
    let Body::Native(native) = &function.body else {
        return None;
    };
    let accepted = args.len() >= usize::from(native.min)
        && native.max.is_none_or(|max| args.len() <= usize::from(max));
    match &native.call {
        _ if !accepted => None,
        NativeCall::Pure(call) => Some(call(image, args)),
        NativeCall::Made(call) => Some(call(image, args)),
        NativeCall::Control(_) | NativeCall::MadeControl(_) => None,
    }
}

/// The function that a function designator means, if it means one.
pub(crate) fn function_of<'a>(image: &'a Image, designator: &'a Value) -> Option<&'a Rc<Function>> {
    match designator {
        Value::Function(function) => Some(function),
        Value::Symbol(sym) => image.function(*sym),
        _ => None,
    }
}

/// Checks that a value designates a function, and replaces a symbol by the function that
/// it names.
pub(crate) fn callable(image: &Image, designator: &Value) -> Result<Value, Box<Raise>> {
    match designator {
        Value::Function(_) => Ok(designator.clone()),
        Value::Symbol(sym) => match &image.symbol(*sym).function {
            FunctionCell::Function(function) => Ok(Value::Function(function.clone())),
            _ => Err(Raise::undefined_function(designator.clone())),
        },
        _ => Err(Raise::type_error(
            designator,
            Value::list([
                known::OR.into(),
                known::FUNCTION.into(),
                known::SYMBOL.into(),
            ]),
        )),
    }
}

/// The builtin that a function value is, by name.
pub(crate) fn builtin_name(function: &Value) -> Option<crate::lisp::Sym> {
    match function {
        Value::Function(f) => match &f.body {
            Body::Native(native) => Some(native.name),
            _ => None,
        },
        _ => None,
    }
}
