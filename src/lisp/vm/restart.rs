//! Restarts: named ways to go on that a condition's handler, or a person, may choose.

use super::fiber::Dynamic;
use super::machine::Machine;
use crate::lisp::foreign::Foreign;
use crate::lisp::image::Image;
use crate::lisp::known;
use crate::lisp::symbol::Sym;
use crate::lisp::value::Value;

/// A restart.
pub struct Restart {
    /// Its name; `NIL` for an anonymous one.
    pub name: Sym,
    /// The function that it calls.
    pub function: Value,
    /// A string, or a function of a stream that describes it; `NIL` if there is none.
    pub report: Value,
    /// A function that asks for the arguments; `NIL` if there is none.
    pub interactive: Value,
}

impl Foreign for Restart {
    fn type_symbol(&self) -> Sym {
        known::RESTART
    }

    fn print(&self, image: &Image, escape: bool) -> String {
        let name = image.name(self.name);
        if escape {
            format!("#<RESTART {name}>")
        } else if let Value::Str(text) = &self.report {
            text.text()
        } else {
            name.to_owned()
        }
    }
}

impl Machine<'_> {
    /// The restarts in force, innermost first.
    pub fn restarts(&self) -> Vec<Value> {
        self.fiber
            .dynamic
            .iter()
            .rev()
            .filter_map(|entry| match entry {
                Dynamic::Restarts(list) => Some(list.iter_list()),
                _ => None,
            })
            .flatten()
            .collect()
    }

    /// The innermost restart of a name, or the restart object itself if it is in force.
    pub fn find_restart(&self, designator: &Value) -> Option<Value> {
        self.restarts().into_iter().find(|restart| {
            restart.is_eq(designator)
                || restart
                    .as_foreign::<Restart>()
                    .is_some_and(|r| designator.as_symbol() == Some(r.name) && r.name != known::NIL)
        })
    }
}
