//! Functions: closures, builtins and generic functions.

use std::any::Any;
use std::rc::Rc;

use super::Value;
use super::code::Code;
use super::copy::Copier;
use super::cycles::Mark;
use super::generic::GenericFunction;
use super::release::release_values;
use super::symbol::Sym;

/// A function object.
pub struct Function {
    /// What the function does.
    pub body: Body,
    pub(super) mark: Mark,
}

impl From<Body> for Function {
    fn from(body: Body) -> Function {
        Function {
            body,
            mark: Mark::default(),
        }
    }
}

/// What a function does when it is called.
pub enum Body {
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
pub struct Deferred {
    pub name: Sym,
    /// The number of its definition among those of the image.
    pub number: usize,
}

impl Deferred {
    /// A definition that has not been needed yet.
    pub fn new(name: Sym, number: usize) -> Deferred {
        Deferred { name, number }
    }
}

/// A function written in Rust.
pub struct Native {
    pub name: Sym,
    /// Fewest arguments.
    pub min: u16,
    /// Maximum number of arguments; none if there is no limit.
    pub max: Option<u16>,
    /// The Rust function.
    pub body: NativeBody,
}

/// Where the Rust function is.
pub enum NativeBody {
    /// In the image's table of builtins, under this number.
    Builtin(u32),
    /// Here, with data of its own. Its type is known where such functions are made.
    Made(Box<dyn MadeBody>),
}

/// A Rust function with data of its own.
pub trait MadeBody: Any {
    /// The same function with copies of its data; `None` if a copy of the image cannot have it.
    fn copied(&self, copier: &mut Copier) -> Option<Box<dyn MadeBody>>;
}

impl Native {
    /// Does it accept `count` arguments?
    #[inline]
    pub(crate) fn accepts(&self, count: usize) -> bool {
        count >= usize::from(self.min) && self.max.is_none_or(|max| count <= usize::from(max))
    }
}

impl Function {
    /// A closure over `captured`.
    pub fn closure(code: Rc<Code>, captured: Vec<Value>) -> Function {
        Body::Closure { code, captured }.into()
    }

    /// A function written in Rust.
    pub fn native(name: Sym, arity: (u16, Option<u16>), body: NativeBody) -> Function {
        let native = Native {
            name,
            min: arity.0,
            max: arity.1,
            body,
        };
        Body::Native(native).into()
    }

    /// A function that is compiled when it is first called.
    pub fn deferred(deferred: Deferred) -> Function {
        Body::Deferred(deferred).into()
    }

    /// The definition in the library, if this is a function or macro of it.
    pub fn as_deferred(&self) -> Option<&Deferred> {
        match &self.body {
            Body::Deferred(deferred) => Some(deferred),
            _ => None,
        }
    }

    /// The generic function, if this is one.
    pub fn as_generic(&self) -> Option<&GenericFunction> {
        match &self.body {
            Body::Generic(g) => Some(g),
            _ => None,
        }
    }
}

impl Drop for Function {
    fn drop(&mut self) {
        if let Body::Closure { captured, .. } = &mut self.body
            && !captured.is_empty()
        {
            release_values(std::mem::take(captured));
        }
    }
}
