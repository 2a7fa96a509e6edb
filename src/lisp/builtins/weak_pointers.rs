//! Weak pointers: objects that refer to others without keeping them.

use crate::builtin::Builtin;
use crate::image::Image;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::copy::Copier;
use crate::value::cycles;
use crate::value::foreign::{Foreign, ForeignCopy, PrintContext};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::release;
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

/// An object that refers to another one without keeping it.
#[builtin("%MAKE-WEAK-POINTER")]
fn make_weak_pointer(object: &Value) -> Result<Value, Box<Raise>> {
    Ok(Value::foreign(WeakPointer(Some(Reference::to(object)))))
}

/// Is the object a weak pointer?
///
/// `(system::%weak-pointer-p 1)` => `NIL`
#[builtin("%WEAK-POINTER-P")]
fn weak_pointer_p(object: &Value) -> Result<Value, Box<Raise>> {
    Ok(Value::bool(object.as_foreign::<WeakPointer>().is_some()))
}

/// The object to which a weak pointer refers; NIL if it is gone.
#[builtin("%WEAK-POINTER-VALUE")]
fn weak_pointer_value(weak_pointer: &Value) -> Result<Value, Box<Raise>> {
    match weak_pointer.as_foreign::<WeakPointer>() {
        Some(pointer) => Ok(pointer.value().unwrap_or(Value::NIL)),
        None => Err(Raise::type_error(weak_pointer, known::WEAK_POINTER)),
    }
}

/// Frees objects that hold each other and that nothing else refers to.
///
/// `(system::%free-circles)` => `NIL`
#[builtin("%FREE-CIRCLES")]
fn free_circles(image: &mut Image) -> Result<(), Box<Raise>> {
    release::all();
    cycles::collect_all(Some(&mut image.symbols));
    release::all();
    Ok(())
}

/// Builtins of package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![
    make_weak_pointer,
    weak_pointer_p,
    weak_pointer_value,
    free_circles,
];
