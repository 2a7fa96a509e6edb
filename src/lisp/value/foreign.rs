//! Values that layers above the language define: tasks, fluents, designators, poses.

use std::any::Any;
use std::cell::Cell;

use super::Value;
use super::copy::Copier;
use super::cycles::Mark;
use super::release::{Dead, release};
use super::symbol::Sym;

/// What a value may need to know while it prints. The image implements it.
pub trait PrintContext {
    /// A symbol's name.
    fn name(&self, sym: Sym) -> &str;

    /// Is the symbol a keyword?
    fn is_keyword(&self, sym: Sym) -> bool;

    /// The symbol of that name that is accessible in the named package.
    fn find_symbol(&self, package: &str, name: &str) -> Option<Sym>;

    /// The value of a special variable.
    fn special(&self, sym: Sym) -> &Value;

    /// A value as `princ` (`escape` false) or `prin1` (`escape` true) print it.
    fn text(&self, value: &Value, escape: bool) -> String;

    /// A function's name with the package of its symbol.
    fn qualified(&self, name: &Value) -> String;

    /// The made-up address of an object.
    fn identity(&self, object: &Value) -> String;
}

/// A value whose behaviour another layer defines.
pub trait Foreign: Any {
    /// The symbol that `type-of` returns.
    fn type_symbol(&self) -> Sym;

    /// The readable form, as `princ` (`escape` false) or `prin1` (`escape` true) print it.
    fn print(&self, context: &dyn PrintContext, escape: bool) -> String;

    /// A function of a stream that writes what `princ` shows, if programs can say that.
    fn writer(&self) -> Option<Value> {
        None
    }

    /// Can its printed form be read again? One that begins with `#<` cannot in any case.
    fn is_readable(&self) -> bool {
        true
    }

    /// What `describe` adds to the printed form: lines, or nothing.
    fn describe(&self, context: &dyn PrintContext) -> String {
        let _ = context;
        String::new()
    }

    /// Can it be a part of a circle of values that hold each other? Then it tells what it holds, and
    /// lets go of it.
    fn may_be_in_circle(&self) -> bool {
        false
    }

    /// Visits the values that it holds.
    fn for_each_reference(&self, visit: &mut dyn FnMut(&Value)) {
        let _ = visit;
    }

    /// Lets go of the values that it holds: nobody can see it any more.
    fn let_go(&self) {}

    /// What a copy of the image has in its place; unless told, there can be no copy.
    fn copied(&self, copier: &mut Copier) -> ForeignCopy {
        let _ = copier;
        ForeignCopy::Refused("a value of something that runs")
    }

    /// Puts into a new copy what it refers to that may refer to it.
    fn fill_copy(&self, copy: &dyn Any, copier: &mut Copier) {
        let _ = (copy, copier);
    }

    /// Is this `equal` to another value that is not identical to it?
    fn is_equal(&self, other: &Value) -> bool {
        let _ = other;
        false
    }
}

/// What a copy of an image has in place of a foreign value.
pub enum ForeignCopy {
    /// The value itself: neither it nor what it refers to ever changes.
    Same,
    /// Another one.
    New(Box<dyn Foreign>),
    /// None, for this reason: the image cannot be copied.
    Refused(&'static str),
}

/// Owner of a foreign value.
pub struct ForeignBox {
    object: Box<dyn Foreign>,
    /// Is it among those that may be in a circle?
    pub(super) is_suspect: Cell<bool>,
    mark: Mark,
}

impl ForeignBox {
    /// Wraps an object.
    pub fn new(object: impl Foreign) -> ForeignBox {
        ForeignBox::of(Box::new(object))
    }

    /// Wraps an object that is in a box.
    pub(super) fn of(object: Box<dyn Foreign>) -> ForeignBox {
        ForeignBox {
            object,
            is_suspect: Cell::new(false),
            mark: Mark::default(),
        }
    }

    /// The object, if it is of type `T`.
    pub fn downcast_ref<T: 'static>(&self) -> Option<&T> {
        let any: &dyn Any = self.object.as_ref();
        any.downcast_ref::<T>()
    }

    /// What the collector has written on it.
    pub(super) fn mark(&self) -> &Mark {
        &self.mark
    }

    /// The object's behaviour.
    pub fn object(&self) -> &dyn Foreign {
        self.object.as_ref()
    }
}

/// Stands in the place of an object that has been handed over to be freed.
struct Gone;

impl Foreign for Gone {
    fn type_symbol(&self) -> Sym {
        super::known::NIL
    }

    fn print(&self, _: &dyn PrintContext, _: bool) -> String {
        String::new()
    }
}

impl Drop for ForeignBox {
    fn drop(&mut self) {
        // A structure without fields takes no memory.
        release(Dead::Object(std::mem::replace(
            &mut self.object,
            Box::new(Gone),
        )));
    }
}
