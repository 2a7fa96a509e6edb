//! Functions: closures, builtins and generic functions.

use std::cell::OnceCell;
use std::rc::Rc;

use super::Value;
use super::generic::GenericFunction;
use super::raise::Raise;
use super::symbol::Sym;
use crate::lisp::image::Image;
use crate::lisp::vm::code::Code;
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::Step;

/// A function object.
pub(crate) struct Function {
    /// What the function does.
    pub(crate) body: Body,
}

/// What a function does when it is called.
pub(crate) enum Body {
    /// Compiled code with the values of its free variables.
    Closure {
        /// The compiled code.
        code: Rc<Code>,
        /// Values, or boxes, of the free variables in the order that the code expects.
        captured: Vec<Value>,
    },
    /// A function written in Rust.
    Native(Native),
    /// A generic function.
    Generic(Box<GenericFunction>),
    /// A function of the library, which is compiled when it is first called.
    Deferred(Deferred),
}

/// A function that is compiled when it is first called.
pub(crate) struct Deferred {
    /// Its name.
    pub(crate) name: Sym,
    /// The number of its definition among those of the image.
    pub(crate) number: usize,
    /// The compiled function.
    pub(crate) function: OnceCell<Rc<Function>>,
}

impl Deferred {
    /// A definition that has not been needed yet.
    pub(crate) fn new(name: Sym, number: usize) -> Deferred {
        Deferred {
            name,
            number,
            function: OnceCell::new(),
        }
    }
}

/// A builtin that returns at once and calls no Lisp function.
pub(crate) type PureFn = fn(&mut Image, &[Value]) -> Result<Value, Box<Raise>>;
/// A builtin that may call functions, wait, or unwind.
pub(crate) type ControlFn = fn(&mut Machine<'_>, Vec<Value>) -> Result<Step, Box<Raise>>;
/// A pure builtin with data of its own (a structure's accessor, a constant function).
pub(crate) type MadeFn = Rc<dyn Fn(&mut Image, &[Value]) -> Result<Value, Box<Raise>>>;
/// A control builtin with data of its own.
pub(crate) type MadeControlFn =
    Rc<dyn Fn(&mut Machine<'_>, Vec<Value>) -> Result<Step, Box<Raise>>>;

/// A function written in Rust.
pub(crate) struct Native {
    /// Its name.
    pub(crate) name: Sym,
    /// Fewest arguments.
    pub(crate) min: u16,
    /// Most arguments; none if there is no limit.
    pub(crate) max: Option<u16>,
    /// The Rust function.
    pub(crate) call: NativeCall,
}

/// The Rust side of a builtin.
#[derive(Clone)]
pub(crate) enum NativeCall {
    /// Returns at once.
    Pure(PureFn),
    /// May call, wait or unwind.
    Control(ControlFn),
    /// Returns at once; carries data.
    Made(MadeFn),
    /// May call, wait or unwind; carries data.
    MadeControl(MadeControlFn),
}

impl Function {
    /// A closure over `captured`.
    pub(crate) fn closure(code: Rc<Code>, captured: Vec<Value>) -> Function {
        Function {
            body: Body::Closure { code, captured },
        }
    }

    /// A builtin.
    pub(crate) fn native(name: Sym, min: u16, max: Option<u16>, call: NativeCall) -> Function {
        Function {
            body: Body::Native(Native {
                name,
                min,
                max,
                call,
            }),
        }
    }

    /// A builtin as a value: a pure function with data of its own.
    pub(crate) fn made(
        name: Sym,
        arity: (u16, Option<u16>),
        call: impl Fn(&mut Image, &[Value]) -> Result<Value, Box<Raise>> + 'static,
    ) -> Rc<Function> {
        Rc::new(Function::native(
            name,
            arity.0,
            arity.1,
            NativeCall::Made(Rc::new(call)),
        ))
    }

    /// A builtin as a value: a control function with data of its own.
    pub(crate) fn made_control(
        name: Sym,
        arity: (u16, Option<u16>),
        call: impl Fn(&mut Machine<'_>, Vec<Value>) -> Result<Step, Box<Raise>> + 'static,
    ) -> Rc<Function> {
        Rc::new(Function::native(
            name,
            arity.0,
            arity.1,
            NativeCall::MadeControl(Rc::new(call)),
        ))
    }

    /// A function that is compiled when it is first called.
    pub(crate) fn deferred(deferred: Deferred) -> Function {
        Function {
            body: Body::Deferred(deferred),
        }
    }

    /// The definition in the library, if this is a function or macro of it.
    pub(crate) fn as_deferred(&self) -> Option<&Deferred> {
        match &self.body {
            Body::Deferred(deferred) => Some(deferred),
            _ => None,
        }
    }

    /// The generic function, if this is one.
    pub(crate) fn as_generic(&self) -> Option<&GenericFunction> {
        match &self.body {
            Body::Generic(g) => Some(g),
            _ => None,
        }
    }
}
