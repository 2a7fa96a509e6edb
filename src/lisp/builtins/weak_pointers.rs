//! Weak pointers: objects that refer to others without keeping them.

use crate::builtin::{Builtin, pure};
use crate::value::Value;
use crate::value::copy::Copier;
use crate::value::foreign::{Foreign, ForeignCopy, PrintContext};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::value::weak::Reference;

/// A weak pointer; without a reference if its object was gone when the image was copied.
struct WeakPointer(Option<Reference>);

impl WeakPointer {
    fn value(&self) -> Option<Value> {
        self.0.as_ref()?.value()
    }
}

impl Foreign for WeakPointer {
    fn type_symbol(&self) -> Sym {
        known::WEAK_POINTER
    }

    fn print(&self, _: &dyn PrintContext, _: bool) -> String {
        match self.value() {
            Some(_) => "#<WEAK-POINTER>".to_owned(),
            None => "#<WEAK-POINTER to nothing>".to_owned(),
        }
    }

    fn copied(&self, copier: &mut Copier) -> ForeignCopy {
        let copy = self.value().map(|value| copier.value(&value));
        ForeignCopy::New(Box::new(WeakPointer(copy.as_ref().map(Reference::to))))
    }
}

/// Builtins of package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = &[
    pure(
        "%MAKE-WEAK-POINTER",
        "object",
        "An object that refers to another one without keeping it.",
        &[],
        |_, args| Ok(Value::foreign(WeakPointer(Some(Reference::to(&args[0]))))),
    ),
    pure(
        "%WEAK-POINTER-P",
        "object",
        "Is the object a weak pointer?",
        &["(system::%weak-pointer-p 1) => NIL"],
        |_, args| Ok(Value::bool(args[0].as_foreign::<WeakPointer>().is_some())),
    ),
    pure(
        "%WEAK-POINTER-VALUE",
        "weak-pointer",
        "The object to which a weak pointer refers; NIL if it is gone.",
        &[],
        |_, args| match args[0].as_foreign::<WeakPointer>() {
            Some(pointer) => Ok(pointer.value().unwrap_or(Value::NIL)),
            None => Err(Raise::type_error(&args[0], known::WEAK_POINTER)),
        },
    ),
];
