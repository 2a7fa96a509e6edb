//! Compiled code: a list of operations for a stack machine.
//!
//! The locals of a function live on the value stack above its frame's base: first the
//! parameters, then the variables of `let` forms in the order in which they are bound.
//! Slots are counted from the base.

use std::cell::OnceCell;
use std::ops::Deref;
use std::rc::Rc;

use crate::source::{Place, SourceId};
use crate::value::Value;
use crate::value::cons::Cons;
use crate::value::copy::{Copied, Copier, is_fixed};
use crate::value::operation::Op;
use crate::value::string::LispString;
use crate::value::symbol::Sym;

/// A list that copies have in common. One without items takes no memory.
#[derive(Debug)]
pub struct SharedList<T>(Option<Rc<[T]>>);

impl<T> From<Vec<T>> for SharedList<T> {
    fn from(items: Vec<T>) -> Self {
        Self((!items.is_empty()).then(|| items.into()))
    }
}

impl<T> FromIterator<T> for SharedList<T> {
    fn from_iter<I: IntoIterator<Item = T>>(items: I) -> Self {
        items.into_iter().collect::<Vec<T>>().into()
    }
}

impl<T> Deref for SharedList<T> {
    type Target = [T];

    #[inline]
    fn deref(&self) -> &[T] {
        self.0.as_deref().unwrap_or_default()
    }
}

impl<T> Clone for SharedList<T> {
    fn clone(&self) -> Self {
        Self(self.0.clone())
    }
}

impl<T> Default for SharedList<T> {
    fn default() -> Self {
        Self(None)
    }
}

/// How a closure gets the value of a free variable of its code.
#[derive(Clone, Copy, Debug)]
pub enum Capture {
    /// From a local slot of the function that makes the closure.
    Local(u32),
    /// From a free variable of that function.
    Free(u32),
}

/// The parameters of a function, in slot order: required, optional, rest, keys.
#[derive(Clone, Debug, Default)]
pub struct Parameters {
    /// Number of required parameters.
    pub required: u16,
    /// Number of optional parameters.
    pub optional: u16,
    /// Is there a rest parameter?
    pub rest: bool,
    /// Keywords of the key parameters.
    pub keys: SharedList<Sym>,
    /// Does the lambda list have `&key`?
    pub has_keys: bool,
    /// Are other keywords allowed?
    pub allow_other_keys: bool,
}

impl Parameters {
    /// Number of slots that they fill.
    pub fn slots(&self) -> usize {
        let positional = usize::from(self.required) + usize::from(self.optional);
        positional + usize::from(self.rest) + self.keys.len()
    }

    /// The number of arguments that fill the slots as they are, if there is one.
    pub(crate) fn exact_count(&self) -> Option<u16> {
        let is_simple = self.optional == 0 && !self.rest && !self.has_keys;
        is_simple.then_some(self.required)
    }
}

/// A local variable: where its value is stored, and for which operations that holds.
#[derive(Clone, Copy, Debug)]
pub struct Local {
    /// Its slot, counted from the frame's base.
    pub slot: u32,
    pub name: Sym,
    /// The first operation in its scope.
    pub from: u32,
    /// The first operation after its scope.
    pub to: u32,
}

/// A name or a lambda list: made of pairs and strings, it is copied on the way in and on the way out,
/// so that nobody can change it.
pub struct Signature {
    value: Value,
    /// Could all of it be copied?
    is_own: bool,
}

/// How deep and how long a list in a signature may be that is copied.
const MAX_IN_SIGNATURE: usize = 1000;

impl Signature {
    /// A copy of the value, or the value itself if it has parts of other kinds.
    pub fn of(value: &Value) -> Signature {
        let mut left = MAX_IN_SIGNATURE;
        let copy = tree(value, &mut left);
        Signature {
            is_own: copy.is_some(),
            value: copy.unwrap_or_else(|| value.clone()),
        }
    }

    /// What [`Signature::of`] has made, from its value and whether nobody can change it.
    pub(crate) fn unchecked(value: Value, is_own: bool) -> Signature {
        Signature { value, is_own }
    }

    /// The value, for whoever may change it.
    pub fn value(&self) -> Value {
        match self.is_own {
            true => Signature::of(&self.value).value,
            false => self.value.clone(),
        }
    }

    /// The value, for somebody who only looks at it.
    pub fn shown(&self) -> &Value {
        &self.value
    }

    /// Can nobody change it?
    pub(crate) fn is_fixed(&self) -> bool {
        self.is_own
    }
}

impl Copied for Signature {
    fn copied(&self, copier: &mut Copier) -> Signature {
        let value = match self.is_own {
            true => self.value.clone(),
            false => copier.value(&self.value),
        };
        Signature {
            value,
            is_own: self.is_own,
        }
    }
}

/// A copy of what consists of so many pairs and strings; `None` if it has parts of other kinds that
/// could be changed, or more parts.
fn tree(value: &Value, left: &mut usize) -> Option<Value> {
    *left = left.checked_sub(1)?;
    match value {
        Value::Cons(cons) => {
            let car = tree(&cons.car(), left)?;
            let copy = Cons::new(car, tree(&cons.cdr(), left)?);
            copy.set_place(cons.place());
            Some(Value::Cons(Rc::new(copy)))
        }
        Value::Str(text) => Some(Value::Str(Rc::new(LispString::clone(text)))),
        other => is_fixed(other).then(|| other.clone()),
    }
}

/// Compiled code of one function: what callers see of it, and its content. Copies share what can never change.
pub struct Code {
    /// Name: a symbol, `(setf name)`, `(lambda …)` or `NIL`.
    pub name: Signature,
    pub parameters: Parameters,
    /// The number of arguments that fill the parameters' slots as they are, if there is one.
    pub(crate) exact_count: Option<u16>,
    /// The most values that it has on the stack, from its frame's base on.
    pub room: usize,
    /// Can nothing of it ever change, nor of the code in it?
    pub(crate) is_fixed: bool,
    pub(crate) content: OnceCell<Content>,
    /// Where the content is to be read, unless it is there from the beginning.
    pub(crate) unread: Option<Unread>,
}

/// What is needed to run code and to tell about it.
pub struct Content {
    /// The operations.
    pub ops: Rc<[Op]>,
    pub constants: Vec<Value>,
    /// Code of the closures made here, with their captures.
    pub inner: Vec<(Rc<Code>, SharedList<Capture>)>,
    /// For each tagbody that closures jump into: the positions of its tags.
    pub tags: SharedList<Vec<u32>>,
    /// Places of calls: (first operation, place), in ascending order.
    pub places: SharedList<(u32, Place)>,
    /// Local variables, for the debugger, in the order of binding.
    pub locals: SharedList<Local>,
    /// Names of the free variables, in the order of the closure's captures.
    pub free: SharedList<Sym>,
    /// The lambda list as written.
    pub lambda_list: Signature,
    /// The documentation string.
    pub doc: Option<Rc<str>>,
}

/// Content that was made ahead and has not been read.
#[derive(Clone, Copy)]
pub(crate) struct Unread {
    pub(crate) bytes: &'static [u8],
    /// The source of its places.
    pub(crate) source: Option<SourceId>,
}

impl Code {
    /// The content, if it has been read: that of code that has run has.
    #[inline(always)]
    pub fn content(&self) -> Option<&Content> {
        self.content.get()
    }

    /// The place of the call that the operation belongs to.
    pub fn place_at(&self, pc: usize) -> Place {
        self.content()
            .map_or(Place::NONE, |content| content.place_at(pc))
    }
}

impl Content {
    /// Can nothing of it ever change, nor of the code in it?
    pub(crate) fn is_fixed(&self) -> bool {
        self.lambda_list.is_fixed()
            && self.constants.iter().all(is_fixed)
            && self.inner.iter().all(|(code, _)| code.is_fixed)
    }

    /// The place of the call that the operation belongs to.
    pub fn place_at(&self, pc: usize) -> Place {
        let pc = u32::try_from(pc).unwrap_or(u32::MAX);
        let after = self.places.partition_point(|(first, _)| *first <= pc);
        after
            .checked_sub(1)
            .and_then(|i| self.places.get(i))
            .map_or(Place::NONE, |(_, place)| *place)
    }
}
