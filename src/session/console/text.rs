//! Evaluating a text: reading and evaluating one form after another.

use std::rc::Rc;

use super::evaluator::{Ended, Evaluator};
use super::stopped::Suspended;
use crate::dialogue::{Abort, Event, Outcome};
use crate::printing;
use lisp::evaluator::nested;
use lisp::guard::stoppable;
use lisp::reader;
use lisp::reader::Reader;
use lisp::source::Place;
use lisp::value::Value;
use lisp::value::raise::Raise;

impl Evaluator {
    /// Evaluates all forms of a text. Each is read after the previous ones have been evaluated,
    /// so that it is read in the package that they selected.
    pub(super) fn evaluate_text(
        &mut self,
        source_name: &str,
        text: &str,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        let source = self.image.sources.add(source_name, text);
        let reader = Reader::new(&self.image, source);
        self.evaluate_rest(reader, sink)
    }

    /// Evaluates all forms from the reader's position.
    pub(super) fn evaluate_rest(
        &mut self,
        mut rest: Reader,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        loop {
            let (form, place) = match self.read_placed(&mut rest) {
                Ok(Some(form)) => form,
                Ok(None) => {
                    self.warn_of_pending();
                    self.flush(sink);
                    return Outcome::Finished;
                }
                Err(abort) => {
                    sink(Event::Aborted(abort));
                    self.image.output.begin_line();
                    return Outcome::Aborted;
                }
            };
            self.begin_judging(&form, place);
            let ended = self.evaluate_form(&form, sink);
            self.end_judging(place, &ended);
            match ended {
                Ended::Values(values) => {
                    if let Some(outcome) = self.tell_values(&values, sink) {
                        return outcome;
                    }
                }
                Ended::Aborted(abort) => {
                    sink(Event::Aborted(abort));
                    self.image.output.begin_line();
                    return Outcome::Aborted;
                }
                Ended::Stopped(evaluation) => {
                    let base = Suspended { form, place, rest };
                    return self.open_level(base, evaluation, sink);
                }
            }
        }
    }

    /// Evaluates a form that has been read, and the forms after it.
    pub(super) fn evaluate_first(
        &mut self,
        first: Suspended,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        match self.evaluate_form(&first.form, sink) {
            Ended::Values(values) => match self.tell_values(&values, sink) {
                Some(outcome) => outcome,
                None => self.evaluate_rest(first.rest, sink),
            },
            Ended::Aborted(abort) => {
                sink(Event::Aborted(abort));
                self.image.output.begin_line();
                Outcome::Aborted
            }
            Ended::Stopped(evaluation) => self.open_level(first, evaluation, sink),
        }
    }

    /// Reports the values of a form; returns the outcome if the form asked to exit.
    pub(super) fn tell_values(
        &mut self,
        values: &[Value],
        sink: &mut dyn FnMut(Event),
    ) -> Option<Outcome> {
        let printed = values
            .iter()
            .map(|v| printing::printed(&mut self.image, v))
            .collect();
        self.objects.keep_values(values);
        self.flush(sink);
        sink(Event::Values(printed));
        self.image.output.begin_line();
        self.open_inspector(sink);
        self.host.person.quit.map(Outcome::Quit)
    }

    /// The next form of the text, `#.` evaluated.
    pub(crate) fn read_form(&mut self, reader: &mut Reader) -> Result<Option<Value>, Box<Abort>> {
        Ok(self.read_placed(reader)?.map(|(form, _)| form))
    }

    /// The same with its place.
    pub(crate) fn read_placed(
        &mut self,
        reader: &mut Reader,
    ) -> Result<Option<(Value, Place)>, Box<Abort>> {
        let limits = Rc::clone(&self.image.limits);
        let _watch = limits.watch();
        let mut next = stoppable(|| reader.next(&mut self.image));
        loop {
            let read = match next {
                Ok(read) => read,
                Err(reason) => {
                    return Err(Box::new(printing::raised(&mut self.image, reason.into())));
                }
            };
            match read {
                Ok(reader::Outcome::Form(form, place)) => return Ok(Some((form, place))),
                Ok(reader::Outcome::End) => return Ok(None),
                Ok(reader::Outcome::Evaluate(form)) => {
                    let value = self
                        .evaluate_now(&form)
                        .map_err(|r| printing::raised(&mut self.image, r))?;
                    next = stoppable(|| reader.supply(&mut self.image, value));
                }
                Err(error) => {
                    return Err(Box::new(printing::raised(&mut self.image, error.raise())));
                }
            }
        }
    }

    fn evaluate_now(&mut self, form: &Value) -> Result<Value, Box<Raise>> {
        let eval = lisp::value::known::EVAL.into();
        nested::call_nested(&mut self.image, eval, vec![form.clone()])
    }
}
