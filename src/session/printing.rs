//! Values and conditions as text.

use super::Session;
use crate::dialogue::Abort;
use crate::lisp::condition;
use crate::lisp::known;
use crate::lisp::print;
use crate::lisp::raise::Raise;
use crate::lisp::symbol::Sym;
use crate::lisp::value::Value;
use crate::lisp::vm::machine;

impl Session {
    /// A value as the prompt prints it.
    pub(super) fn printed(&mut self, value: &Value) -> String {
        self.printed_by(known::PRIN1_TO_STRING, value)
    }

    /// What is told of a condition that nobody handled.
    pub(super) fn describe(&mut self, condition: &Value) -> Abort {
        let place = self.image.condition_place(condition);
        Abort {
            report: self.printed_by(known::PRINC_TO_STRING, condition),
            condition: self.printed(condition),
            place: place.and_then(|p| self.image.sources.locate(p)),
        }
    }

    /// What is told of an error in Rust code.
    pub(super) fn raised(&mut self, raise: Box<Raise>) -> Abort {
        let place = raise.place();
        let mut abort = match condition::make(&self.image, &raise) {
            Ok(condition) => self.describe(&condition),
            Err(_) => Abort {
                report: "An error could not be described.".to_owned(),
                condition: "#<ERROR>".to_owned(),
                place: None,
            },
        };
        if abort.place.is_none() {
            abort.place = self.image.sources.locate(place);
        }
        abort
    }

    /// A value printed by a function, so that the user's print methods are heard; if they
    /// fail, by the printer alone.
    fn printed_by(&mut self, function: Sym, value: &Value) -> String {
        let args = vec![value.clone()];
        machine::call_nested(&mut self.image, function.into(), args)
            .ok()
            .and_then(|text| text.as_text())
            .unwrap_or_else(|| {
                print::to_string(&self.image, value, function == known::PRIN1_TO_STRING)
            })
    }
}
