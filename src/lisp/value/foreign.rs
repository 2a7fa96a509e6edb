//! Values that layers above the language bring along: tasks, fluents, designators, poses.

use std::any::Any;

use super::Value;
use super::symbol::Sym;
use crate::lisp::image::Image;

/// A value whose behaviour another layer defines.
pub(crate) trait Foreign: Any {
    /// The symbol that `type-of` returns.
    fn type_symbol(&self) -> Sym;

    /// The readable form, as `princ` (`escape` false) or `prin1` (`escape` true) print it.
    fn print(&self, image: &Image, escape: bool) -> String;

    /// Is this `equal` to another value that is not identical to it?
    fn is_equal(&self, other: &Value) -> bool {
        let _ = other;
        false
    }
}

/// Owner of a foreign value.
pub(crate) struct ForeignBox {
    object: Box<dyn Foreign>,
}

impl ForeignBox {
    /// Wraps an object.
    pub(crate) fn new(object: impl Foreign) -> ForeignBox {
        ForeignBox {
            object: Box::new(object),
        }
    }

    /// The object, if it is of type `T`.
    pub(crate) fn downcast_ref<T: 'static>(&self) -> Option<&T> {
        let any: &dyn Any = self.object.as_ref();
        any.downcast_ref::<T>()
    }

    /// The object's behaviour.
    pub(crate) fn object(&self) -> &dyn Foreign {
        self.object.as_ref()
    }
}
