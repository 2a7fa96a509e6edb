//! How Rust code calls Lisp functions and continues afterwards.
//!
//! A builtin that calls functions, waits or asks for something is an asynchronous Rust
//! function that awaits each of these. The Rust compiler turns it into a state machine,
//! which stays in a frame of the fiber while it waits: a call goes through the machine, so
//! it may wait, unwind, or be interrupted, and nothing recurses on the Rust stack. Calls of
//! pure builtins are answered at once, without the machine.
//!
//! Between two calls the function reaches the machine through [`Calls::with`].

use std::any::Any;
use std::cell::Cell;
use std::future::Future;
use std::pin::Pin;
use std::rc::Rc;
use std::task::{Context, Poll, Waker};

use super::callable::function_of;
use super::computation::{Progress, Remainder};
use super::machine::Machine;
use super::step::Step;
use crate::image::Image;
use crate::native::NativeCall;
use crate::value::Value;
use crate::value::function::Body;
use crate::value::raise::Raise;

/// The most calls of pure builtins that are answered in a row before the machine gets a turn, so
/// that endless ones can be interrupted.
const DIRECT_CALLS: u32 = 1000;

/// Arguments of a call.
pub enum Args {
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

/// What a layer above the language says about a call while it is open, for code that inspects the
/// stack.
pub struct Annotation {
    /// What the call is about; shown as its argument.
    pub subject: Value,
    /// Whatever else that layer wants to keep with the frame.
    pub note: Box<dyn Any>,
}

/// What an asynchronous builtin waits for.
enum Errand {
    /// The value of a call.
    Call {
        function: Value,
        args: Args,
        manner: Manner,
    },
    /// The answer to a request to the code that runs the fiber.
    Request(Box<dyn Any>),
    /// Work on the machine.
    Work(Rc<dyn Work>),
}

/// How a call is made.
enum Manner {
    /// For its primary value, and without the machine if that is possible.
    Plain,
    /// For its primary value, with the builtin's frame below the call in any case.
    Framed,
    /// For all values.
    Values,
    /// For its primary value, with an annotation of the frame.
    Annotated(Rc<Annotation>),
}

#[derive(Default)]
struct Exchange {
    errand: Cell<Option<Errand>>,
    answer: Cell<Option<Value>>,
}

/// The means by which an asynchronous builtin calls functions.
pub struct Calls(Rc<Exchange>);

impl Calls {
    /// Calls a function with one argument, for the primary value.
    pub fn call1(&self, function: &Value, a: Value) -> Awaited<'_> {
        self.call(function, Args::One([a]))
    }

    /// Calls a function with two arguments, for the primary value.
    pub fn call2(&self, function: &Value, a: Value, b: Value) -> Awaited<'_> {
        self.call(function, Args::Two([a, b]))
    }

    /// Calls a function, for the primary value.
    pub fn call(&self, function: &Value, args: Args) -> Awaited<'_> {
        self.call_in(function, args, Manner::Plain)
    }

    /// Calls a function, even a pure builtin, on top of a frame of the caller, for the primary
    /// value. Dynamic entries that the caller makes for the call need that frame.
    pub(crate) fn call_in_frame(&self, function: &Value, args: Vec<Value>) -> Awaited<'_> {
        self.call_in(function, Args::Many(args), Manner::Framed)
    }

    /// Calls a function, for all values (`Value::Multiple` unless exactly one).
    pub fn call_for_values(&self, function: &Value, args: Vec<Value>) -> Awaited<'_> {
        self.call_in(function, Args::Many(args), Manner::Values)
    }

    /// Calls a function with an annotation of the call, for the primary value.
    pub fn call_about(
        &self,
        annotation: Annotation,
        function: &Value,
        args: Vec<Value>,
    ) -> Awaited<'_> {
        let manner = Manner::Annotated(Rc::new(annotation));
        self.call_in(function, Args::Many(args), manner)
    }

    fn call_in(&self, function: &Value, args: Args, manner: Manner) -> Awaited<'_> {
        let function = function.clone();
        self.awaited(Errand::Call {
            function,
            args,
            manner,
        })
    }

    /// Makes a request to the code that runs the fiber, for all values of the answer.
    pub fn request(&self, request: impl Any) -> Awaited<'_> {
        self.awaited(Errand::Request(Box::new(request)))
    }

    fn awaited(&self, errand: Errand) -> Awaited<'_> {
        Awaited {
            exchange: &self.0,
            errand: Some(errand),
        }
    }

    /// Runs a closure on the machine.
    pub fn with<R, F>(&self, work: F) -> Working<'_, R, F>
    where
        R: 'static,
        F: FnOnce(&mut Machine<'_>) -> R + 'static,
    {
        Working {
            exchange: &self.0,
            job: Rc::new(Job {
                work: Cell::new(Some(work)),
                result: Cell::new(None),
            }),
        }
    }
}

/// A call or a request under way.
pub struct Awaited<'a> {
    exchange: &'a Exchange,
    errand: Option<Errand>,
}

impl Future for Awaited<'_> {
    type Output = Value;

    fn poll(mut self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<Value> {
        if let Some(errand) = self.errand.take() {
            self.exchange.errand.set(Some(errand));
            return Poll::Pending;
        }
        match self.exchange.answer.take() {
            Some(value) => Poll::Ready(value),
            None => Poll::Pending,
        }
    }
}

/// Work on the machine that a builtin waits for.
trait Work {
    fn perform(&self, machine: &mut Machine<'_>);
}

struct Job<R, F> {
    work: Cell<Option<F>>,
    result: Cell<Option<R>>,
}

impl<R, F: FnOnce(&mut Machine<'_>) -> R> Work for Job<R, F> {
    fn perform(&self, machine: &mut Machine<'_>) {
        if let Some(work) = self.work.take() {
            self.result.set(Some(work(machine)));
        }
    }
}

/// Work on the machine under way.
pub struct Working<'a, R, F> {
    exchange: &'a Exchange,
    job: Rc<Job<R, F>>,
}

impl<R, F> Future for Working<'_, R, F>
where
    R: 'static,
    F: FnOnce(&mut Machine<'_>) -> R + 'static,
{
    type Output = R;

    fn poll(self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<R> {
        if let Some(result) = self.job.result.take() {
            return Poll::Ready(result);
        }
        self.exchange
            .errand
            .set(Some(Errand::Work(self.job.clone())));
        Poll::Pending
    }
}

/// Runs an asynchronous builtin until it ends or needs the machine for a call. `name` is shown in
/// backtraces. The builtin ends with a value, or with a step that replaces it.
pub fn run<F, T>(
    machine: &mut Machine<'_>,
    name: &'static str,
    body: impl FnOnce(Calls) -> F,
) -> Result<Step, Box<Raise>>
where
    F: Future<Output = Result<T, Box<Raise>>> + 'static,
    T: Into<Step>,
{
    let exchange = Rc::new(Exchange::default());
    let body = body(Calls(exchange.clone()));
    let suspended = Suspended {
        name,
        rest: Rest::Function {
            exchange,
            future: Box::pin(async move { body.await.map(Into::into) }),
        },
        annotation: None,
    };
    Box::new(suspended).advance(machine, None)
}

/// A builtin that is waiting.
pub struct Suspended {
    name: &'static str,
    rest: Rest,
    annotation: Option<Rc<Annotation>>,
}

/// The rest of a builtin.
enum Rest {
    /// An asynchronous function.
    Function {
        exchange: Rc<Exchange>,
        future: Pin<Box<dyn Future<Output = Result<Step, Box<Raise>>>>>,
    },
    /// A computation that ends with a step.
    Computation(Box<dyn Remainder>),
}

impl Suspended {
    /// A builtin whose rest is a computation.
    pub(super) fn in_computation(name: &'static str, computation: Box<dyn Remainder>) -> Self {
        Self {
            name,
            rest: Rest::Computation(computation),
            annotation: None,
        }
    }

    fn advance(
        mut self: Box<Self>,
        machine: &mut Machine<'_>,
        answer: Option<Value>,
    ) -> Result<Step, Box<Raise>> {
        let (exchange, future) = match &mut self.rest {
            Rest::Computation(computation) => {
                let progress = computation.advance(machine, answer)?;
                return self.go_on_computing(machine, progress);
            }
            Rest::Function { exchange, future } => (exchange, future),
        };
        exchange.answer.set(answer);
        let mut context = Context::from_waker(Waker::noop());
        let mut budget = DIRECT_CALLS;
        self.annotation = None;
        loop {
            if let Poll::Ready(outcome) = future.as_mut().poll(&mut context) {
                return outcome;
            }
            // A builtin awaits nothing but errands, so there is one.
            match exchange.errand.take() {
                Some(Errand::Work(work)) => work.perform(machine),
                Some(Errand::Call {
                    function,
                    args,
                    manner,
                }) => {
                    budget -= 1;
                    if budget > 0
                        && matches!(manner, Manner::Plain)
                        && let Some(value) =
                            call_directly(machine.image, &function, args.as_slice())
                    {
                        exchange.answer.set(Some(value?.primary()));
                        continue;
                    }
                    let all = matches!(manner, Manner::Values);
                    if let Manner::Annotated(annotation) = manner {
                        self.annotation = Some(annotation);
                    }
                    return Ok(Step::Call {
                        function,
                        args: args.into_vec(),
                        all,
                        then: self,
                    });
                }
                Some(Errand::Request(request)) => {
                    return Ok(Step::RequestThen(request, self));
                }
                None => return Ok(Step::Return(Value::NIL)),
            }
        }
    }

    /// Continues a computation that has progressed this far.
    pub(super) fn go_on_computing(
        mut self: Box<Self>,
        machine: &mut Machine<'_>,
        mut progress: Progress<Step>,
    ) -> Result<Step, Box<Raise>> {
        let mut budget = DIRECT_CALLS;
        loop {
            let (function, args) = match progress {
                Progress::Done(step) => return Ok(step),
                Progress::Call { function, args } => (function, args),
            };
            budget -= 1;
            if budget > 0
                && let Rest::Computation(computation) = &mut self.rest
                && !computation.needs_frame()
                && let Some(value) = call_directly(machine.image, &function, &args)
            {
                progress = computation.advance(machine, Some(value?.primary()))?;
                continue;
            }
            return Ok(Step::Call {
                function,
                args,
                all: false,
                then: self,
            });
        }
    }

    /// Continues with the value that it was waiting for.
    pub fn resume(
        self: Box<Self>,
        machine: &mut Machine<'_>,
        value: Value,
    ) -> Result<Step, Box<Raise>> {
        self.advance(machine, Some(value))
    }

    /// The builtin's name, for backtraces.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// The annotation of the open call.
    pub fn annotation(&self) -> Option<&Rc<Annotation>> {
        self.annotation.as_ref()
    }
}

/// Calls a pure builtin that accepts this number of arguments; none for other functions.
fn call_directly(
    image: &mut Image,
    function: &Value,
    args: &[Value],
) -> Option<Result<Value, Box<Raise>>> {
    let function = function_of(image, function)?.clone();
    let Body::Native(native) = &function.body else {
        return None;
    };
    if !native.accepts(args.len()) {
        return None;
    }
    match image.native_call(native) {
        NativeCall::Pure(call) => {
            let result = call(image, args);
            // The machine calls the method of an object that was given as a stream.
            let is_for_method = result
                .as_ref()
                .is_err_and(|raise| raise.stream_object().is_some());
            (!is_for_method).then_some(result)
        }
        NativeCall::Made(call) => Some(call(image, args)),
        NativeCall::Control(_) | NativeCall::MadeControl(_) => None,
    }
}
