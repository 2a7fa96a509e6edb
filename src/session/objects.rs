//! The values that an editor refers to, by number.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

use super::dialogue::ObjectNumber;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::image::extension::Extension;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::copy::Copier;
use lisp::value::raise::Raise;

/// Maximum number of values that are kept; beyond that, the oldest are forgotten.
const MAX_OBJECTS: usize = 10_000;

/// Builtins of package `SWANK`.
pub(super) static TABLE: &[Builtin] = builtins![presented];

/// The values, kept in the image.
#[derive(Default)]
pub(super) struct Objects {
    is_served: Cell<bool>,
    next: Cell<ObjectNumber>,
    kept: RefCell<BTreeMap<ObjectNumber, Value>>,
    /// What a form has asked to inspect.
    inspected: RefCell<Option<Value>>,
}

impl Objects {
    /// Those of an image.
    pub(super) fn of(image: &mut Image) -> Rc<Objects> {
        let objects = image.extension::<Objects>();
        objects.unwrap_or_else(|| image.extend(Objects::default()))
    }

    /// Sets whether an editor is the front.
    pub(super) fn set_served(&self, is_served: bool) {
        self.is_served.set(is_served);
    }

    /// Whether an editor is the front.
    pub(super) fn is_served(&self) -> bool {
        self.is_served.get()
    }

    /// Keeps the values of a form, if an editor is the front.
    pub(super) fn keep_values(&self, values: &[Value]) {
        if self.is_served() {
            for value in values {
                self.keep(value.clone());
            }
        }
    }

    /// The number that the next value gets.
    pub(super) fn next(&self) -> ObjectNumber {
        self.next.get()
    }

    /// Keeps a value.
    pub(super) fn keep(&self, value: Value) -> ObjectNumber {
        let number = self.next.get();
        self.next.set(number + 1);
        let mut kept = self.kept.borrow_mut();
        kept.insert(number, value);
        let oldest = (kept.len() > MAX_OBJECTS).then(|| kept.pop_first());
        drop(kept);
        // Freeing a value may run any code.
        drop(oldest);
        number
    }

    /// The value with a number.
    pub(super) fn get(&self, number: ObjectNumber) -> Option<Value> {
        self.kept.borrow().get(&number).cloned()
    }

    /// Forgets a value.
    pub(super) fn forget(&self, number: ObjectNumber) {
        let value = self.kept.borrow_mut().remove(&number);
        drop(value);
    }

    /// Gives the editor a value to inspect.
    pub(super) fn inspect_next(&self, value: Value) {
        self.inspected.replace(Some(value));
    }

    /// The value to inspect, once.
    pub(super) fn take_inspected(&self) -> Option<Value> {
        self.inspected.take()
    }
}

impl Extension for Objects {
    fn copied(self: Rc<Self>, copier: &mut Copier) -> Rc<dyn Extension> {
        if self.is_served() || self.next() > 0 || self.inspected.borrow().is_some() {
            copier.refuse("values that an editor refers to");
        }
        Rc::new(Objects::default())
    }
}

/// The value that Emacs shows under a number. Emacs writes a call of it where a value is copied into an
/// input.
#[builtin("LOOKUP-PRESENTED-OBJECT-OR-LOSE")]
fn presented(image: &Image, number: &Value) -> Result<Value, Box<Raise>> {
    let number = match number {
        Value::Int(number) => ObjectNumber::try_from(*number).ok(),
        _ => None,
    };
    let objects = image.extension::<Objects>();
    let value = number.and_then(|number| objects?.get(number));
    value.ok_or_else(|| Raise::simple("That value is no longer known.".to_owned()))
}
