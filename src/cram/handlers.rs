//! The failures that handlers in programs name, and how often each has been handled: a plan whose
//! handlers have never run has not been tested.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use lisp::evaluator::matching::is_of_type;
use lisp::image::Image;
use lisp::image::extension::Extension;
use lisp::print;
use lisp::source::Place;
use lisp::value::Value;
use lisp::value::copy::Copier;
use lisp::value::known;

/// Sources of the plans that are built in.
const BUILT_IN: &str = "plans/lib/";

/// All handlers of programs in an image.
#[derive(Default)]
pub struct Handlers {
    all: RefCell<Vec<Handler>>,
    /// How many of them, the first ones, belong to what the program is given.
    given: Cell<usize>,
}

/// A clause of `with-failure-handling`.
struct Handler {
    place: Place,
    /// File and line.
    location: String,
    /// The types that it names, and how often it has handled a failure of each.
    types: Vec<(Value, u64)>,
}

impl Handlers {
    /// Those of an image.
    pub fn of(image: &mut Image) -> Rc<Self> {
        let handlers = image.extension::<Self>();
        handlers.unwrap_or_else(|| image.extend(Self::default()))
    }

    /// The number of a clause; `None` if it is not from a program.
    pub(super) fn know(image: &mut Image, clause: &Value) -> Option<usize> {
        let place = first_place(clause)?;
        let location = image.sources.locate(place)?;
        if !image.sources.is_of_program(place) || location.name.starts_with(BUILT_IN) {
            return None;
        }
        let all = Self::of(image);
        let mut all = all.all.borrow_mut();
        // A macro call may be expanded repeatedly.
        if let Some(known) = all.iter().position(|handler| handler.place == place) {
            return Some(known);
        }
        // Folders differ between machines.
        let file = location.name.rsplit('/').next().unwrap_or_default();
        all.push(Handler {
            place,
            location: format!("{file}:{}", location.line),
            types: named(&clause.car_or_nil()).map(|name| (name, 0)).collect(),
        });
        Some(all.len() - 1)
    }

    /// Notes that a handler begins to handle a condition.
    pub(super) fn note(image: &mut Image, number: usize, condition: &Value) {
        let all = Self::of(image);
        let mut all = all.all.borrow_mut();
        let Some(handler) = all.get_mut(number) else {
            return;
        };
        for (name, count) in &mut handler.types {
            // A type that is none has been reported where the handler was established.
            *count += u64::from(is_of_type(image, condition, name).unwrap_or(false));
        }
    }

    /// Those that there are now are not the program's own.
    pub fn give(&self) {
        self.given.set(self.all.borrow().len());
    }

    /// Counts from zero.
    pub fn reset(&self) {
        for handler in self.all.borrow_mut().iter_mut() {
            handler.types.iter_mut().for_each(|(_, count)| *count = 0);
        }
    }

    /// File, line and type of those of the program, in order, and how often each has handled a failure.
    pub fn counts(&self, image: &Image) -> Vec<(String, u64)> {
        let all = self.all.borrow();
        let each = all.iter().skip(self.given.get()).flat_map(|handler| {
            handler.types.iter().map(|(name, count)| {
                let name = print::to_string(image, name, false);
                (format!("{} {name}", handler.location), *count)
            })
        });
        each.collect()
    }
}

impl Extension for Handlers {
    fn copied(self: Rc<Self>, copier: &mut Copier) -> Rc<dyn Extension> {
        let all = self.all.borrow();
        let all = all.iter().map(|handler| {
            let types = handler.types.iter();
            Handler {
                place: handler.place,
                location: handler.location.clone(),
                types: types
                    .map(|(name, count)| (copier.value(name), *count))
                    .collect(),
            }
        });
        Rc::new(Handlers {
            all: RefCell::new(all.collect()),
            given: self.given.clone(),
        })
    }
}

/// The types that a type names: those of `(or …)`, or just itself.
fn named(name: &Value) -> impl Iterator<Item = Value> {
    let choices = match name.car_or_nil().as_symbol() {
        Some(known::OR) => name.cdr_or_nil().list_to_vec(),
        _ => None,
    };
    choices.unwrap_or_else(|| vec![name.clone()]).into_iter()
}

/// The first place of a form in a text; macros make forms without places around those that they are
/// given.
fn first_place(form: &Value) -> Option<Place> {
    let mut pending = vec![form.clone()];
    while let Some(form) = pending.pop() {
        let Value::Cons(cons) = &form else {
            continue;
        };
        if cons.place().is_some() {
            return Some(cons.place());
        }
        pending.push(cons.cdr());
        pending.push(cons.car());
    }
    None
}
