//! Functions written in Rust, as the machine calls them.

use std::rc::Rc;

use super::image::Image;
use super::value::Value;
use super::value::function::{Function, Native, NativeBody};
use super::value::raise::Raise;
use super::value::symbol::Sym;
use super::vm::machine::Machine;
use super::vm::step::Step;

/// A builtin that returns at once and calls no Lisp function.
pub(crate) type PureFn = fn(&mut Image, &[Value]) -> Result<Value, Box<Raise>>;
/// A builtin that may call functions, wait, or unwind.
pub(crate) type ControlFn = fn(&mut Machine<'_>, Vec<Value>) -> Result<Step, Box<Raise>>;
/// A pure builtin with data of its own (a structure's accessor, a constant function).
type MadeFn = dyn Fn(&mut Image, &[Value]) -> Result<Value, Box<Raise>>;
/// A control builtin with data of its own.
type MadeControlFn = dyn Fn(&mut Machine<'_>, Vec<Value>) -> Result<Step, Box<Raise>>;

/// The Rust function of a builtin.
#[derive(Clone, Copy)]
pub(crate) enum BuiltinCall {
    /// Returns at once.
    Pure(PureFn),
    /// May call, wait or unwind.
    Control(ControlFn),
}

/// What [`NativeBody::Made`] holds.
enum Made {
    /// Returns at once.
    Pure(Box<MadeFn>),
    /// May call, wait or unwind.
    Control(Box<MadeControlFn>),
}

/// A function written in Rust, ready to be called.
pub(crate) enum NativeCall<'a> {
    /// Returns at once.
    Pure(PureFn),
    /// May call, wait or unwind.
    Control(ControlFn),
    /// Returns at once; carries data.
    Made(&'a MadeFn),
    /// May call, wait or unwind; carries data.
    MadeControl(&'a MadeControlFn),
}

impl Image {
    /// The Rust function of a native one.
    #[inline]
    pub(crate) fn native_call<'a>(&self, native: &'a Native) -> NativeCall<'a> {
        match &native.body {
            NativeBody::Builtin(number) => match self.natives[*number as usize] {
                BuiltinCall::Pure(f) => NativeCall::Pure(f),
                BuiltinCall::Control(f) => NativeCall::Control(f),
            },
            NativeBody::Made(made) => match made.downcast_ref() {
                Some(Made::Pure(f)) => NativeCall::Made(f.as_ref()),
                Some(Made::Control(f)) => NativeCall::MadeControl(f.as_ref()),
                None => unreachable!("`made` and `made_control` alone make such functions"),
            },
        }
    }

    /// The Rust function of a builtin that returns at once and carries no data.
    #[inline(always)]
    pub(crate) fn pure_call(&self, native: &Native) -> Option<PureFn> {
        match native.body {
            NativeBody::Builtin(number) => match self.natives[number as usize] {
                BuiltinCall::Pure(f) => Some(f),
                BuiltinCall::Control(_) => None,
            },
            NativeBody::Made(_) => None,
        }
    }

    /// A function object for a Rust function.
    pub(crate) fn native(
        &mut self,
        name: Sym,
        arity: (u16, Option<u16>),
        call: BuiltinCall,
    ) -> Rc<Function> {
        let number = u32::try_from(self.natives.len()).unwrap_or(u32::MAX);
        self.natives.push(call);
        Rc::new(Function::native(name, arity, NativeBody::Builtin(number)))
    }
}

impl Function {
    /// A pure function with data of its own.
    pub(crate) fn made(
        name: Sym,
        arity: (u16, Option<u16>),
        call: impl Fn(&mut Image, &[Value]) -> Result<Value, Box<Raise>> + 'static,
    ) -> Rc<Function> {
        let made = Made::Pure(Box::new(call));
        Rc::new(Function::native(
            name,
            arity,
            NativeBody::Made(Box::new(made)),
        ))
    }

    /// A control function with data of its own.
    pub(crate) fn made_control(
        name: Sym,
        arity: (u16, Option<u16>),
        call: impl Fn(&mut Machine<'_>, Vec<Value>) -> Result<Step, Box<Raise>> + 'static,
    ) -> Rc<Function> {
        let made = Made::Control(Box::new(call));
        Rc::new(Function::native(
            name,
            arity,
            NativeBody::Made(Box::new(made)),
        ))
    }
}
