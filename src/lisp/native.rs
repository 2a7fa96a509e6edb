//! Functions written in Rust, as the machine calls them.

use std::any::Any;
use std::rc::Rc;

use super::image::Image;
use super::value::Value;
use super::value::copy::{Copied, Copier};
use super::value::function::{Function, MadeBody, Native, NativeBody};
use super::value::raise::Raise;
use super::value::symbol::Sym;
use super::vm::machine::Machine;
use super::vm::step::Step;

/// A builtin that returns at once and calls no Lisp function.
pub type PureFn = fn(&mut Image, &[Value]) -> Result<Value, Box<Raise>>;
/// A builtin that may call functions, wait, or unwind.
pub(crate) type ControlFn = fn(&mut Machine<'_>, Vec<Value>) -> Result<Step, Box<Raise>>;
/// A pure builtin with data of its own (a structure's accessor, a constant function).
type MadeFn = dyn Fn(&mut Image, &[Value]) -> Result<Value, Box<Raise>>;
/// A control builtin with data of its own.
type MadeControlFn = dyn Fn(&mut Machine<'_>, Vec<Value>) -> Result<Step, Box<Raise>>;

/// The Rust function of a builtin.
#[derive(Clone, Copy)]
pub enum BuiltinCall {
    /// Returns at once.
    Pure(PureFn),
    /// May call, wait or unwind.
    Control(ControlFn),
}

/// What [`NativeBody::Made`] holds.
struct Made {
    call: MadeCall,
    /// Makes the function again of a copy of its data; none if a copy of the image cannot have it.
    copy: Option<Box<Recipe>>,
}

enum MadeCall {
    /// Returns at once.
    Pure(Box<MadeFn>),
    /// May call, wait or unwind.
    Control(Box<MadeControlFn>),
}

/// Makes a function of a copy of its data.
type Recipe = dyn Fn(&mut Copier) -> Made;

impl Made {
    fn pure_of<D: Copied>(
        data: Rc<D>,
        call: impl Fn(&D, &mut Image, &[Value]) -> Result<Value, Box<Raise>> + Copy + 'static,
    ) -> Made {
        let own = data.clone();
        Made {
            call: MadeCall::Pure(Box::new(move |image, args| call(&own, image, args))),
            copy: Some(Box::new(move |copier| {
                Made::pure_of(Rc::new(data.copied(copier)), call)
            })),
        }
    }

    fn control_of<D: Copied>(
        data: Rc<D>,
        call: impl Fn(&D, &mut Machine<'_>, Vec<Value>) -> Result<Step, Box<Raise>> + Copy + 'static,
    ) -> Made {
        let own = data.clone();
        Made {
            call: MadeCall::Control(Box::new(move |machine, args| call(&own, machine, args))),
            copy: Some(Box::new(move |copier| {
                Made::control_of(Rc::new(data.copied(copier)), call)
            })),
        }
    }
}

impl MadeBody for Made {
    fn copied(&self, copier: &mut Copier) -> Option<Box<dyn MadeBody>> {
        let made = self.copy.as_ref()?(copier);
        Some(Box::new(made))
    }
}

/// A function written in Rust, ready to be called.
pub enum NativeCall<'a> {
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
    pub fn native_call<'a>(&self, native: &'a Native) -> NativeCall<'a> {
        match &native.body {
            NativeBody::Builtin(number) => match self.natives[*number as usize] {
                BuiltinCall::Pure(f) => NativeCall::Pure(f),
                BuiltinCall::Control(f) => NativeCall::Control(f),
            },
            NativeBody::Made(made) => {
                let made: &dyn Any = made.as_ref();
                match made.downcast_ref::<Made>().map(|made| &made.call) {
                    Some(MadeCall::Pure(f)) => NativeCall::Made(f.as_ref()),
                    Some(MadeCall::Control(f)) => NativeCall::MadeControl(f.as_ref()),
                    None => unreachable!("nothing else makes such functions"),
                }
            }
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
    pub fn native(
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
    /// A pure function of its arguments and of data. An image that is copied has it of a copy of these.
    pub fn pure_of<D: Copied>(
        name: Sym,
        arity: (u16, Option<u16>),
        data: D,
        call: impl Fn(&D, &mut Image, &[Value]) -> Result<Value, Box<Raise>> + Copy + 'static,
    ) -> Rc<Function> {
        Function::of_made(name, arity, Made::pure_of(Rc::new(data), call))
    }

    /// A control function of its arguments and of data. An image that is copied has it of a copy of these.
    pub fn control_of<D: Copied>(
        name: Sym,
        arity: (u16, Option<u16>),
        data: D,
        call: impl Fn(&D, &mut Machine<'_>, Vec<Value>) -> Result<Step, Box<Raise>> + Copy + 'static,
    ) -> Rc<Function> {
        Function::of_made(name, arity, Made::control_of(Rc::new(data), call))
    }

    /// A control function that belongs to what runs: an image that has it cannot be copied.
    pub fn made_control(
        name: Sym,
        arity: (u16, Option<u16>),
        call: impl Fn(&mut Machine<'_>, Vec<Value>) -> Result<Step, Box<Raise>> + 'static,
    ) -> Rc<Function> {
        let call = MadeCall::Control(Box::new(call));
        Function::of_made(name, arity, Made { call, copy: None })
    }

    fn of_made(name: Sym, arity: (u16, Option<u16>), made: Made) -> Rc<Function> {
        let body = NativeBody::Made(Box::new(made));
        Rc::new(Function::native(name, arity, body))
    }
}
