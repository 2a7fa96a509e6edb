//! Warnings about what is defined at the prompt. What is evaluated at once reports its mistakes itself.

use super::evaluator::{Ended, Evaluator};
use crate::dialogue::screen::is_input_name;
use lisp::evaluator::nested;
use lisp::image::Image;
use lisp::source::Place;
use lisp::value::Value;
use lisp::value::known;

impl Evaluator {
    /// Before a form is evaluated: it is to be judged if it defines something and has been typed.
    pub(super) fn begin_judging(&mut self, form: &Value, place: Place) {
        let image = &mut self.image;
        let source = image.sources.bytes_of(place).map(|(source, ..)| source);
        let source = source.and_then(|source| image.sources.get(source));
        let is_typed = source.is_some_and(|source| is_input_name(&source.name));
        let is_definition = is_definition(image, form);
        image.begin_noted_form(place, is_typed && is_definition);
    }

    /// After the form at a place has been evaluated: the warnings are due if it is the last one.
    pub(super) fn end_judging(&mut self, place: Place, ended: &Ended) {
        self.image.begin_noted_form(Place::NONE, false);
        match ended {
            Ended::Values(_) if self.is_last(place) => self.warn_of_pending(),
            Ended::Values(_) => {}
            Ended::Aborted(_) | Ended::Stopped(_) => drop(self.image.take_pending_notes()),
        }
    }

    /// Does nothing stand after a place?
    fn is_last(&self, place: Place) -> bool {
        let sources = &self.image.sources;
        let rest = sources.bytes_of(place).and_then(|(source, _, end)| {
            let text = &sources.get(source)?.text;
            text.get(usize::try_from(end).ok()?..)
        });
        rest.is_none_or(|rest| rest.trim().is_empty())
    }

    /// Signals the warnings that have waited for the end of the text.
    pub(super) fn warn_of_pending(&mut self) {
        let notes = self.image.take_pending_notes();
        for warning in self.image.judged(&notes) {
            let warn = Value::from(known::WARN);
            // A handler that fails has nobody to tell.
            drop(nested::call_nested(
                &mut self.image,
                warn,
                warning.arguments(),
            ));
        }
    }
}

/// Is it a form that defines something?
fn is_definition(image: &Image, form: &Value) -> bool {
    let operator = form.car_or_nil().as_symbol();
    operator.is_some_and(|operator| image.name(operator).starts_with("DEF"))
}
