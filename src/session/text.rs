//! Evaluating a text: reading a form, evaluating it, and so on to the end.

use super::{Ended, Session};
use crate::dialogue::{Abort, Event, Outcome};
use crate::lisp::raise::Raise;
use crate::lisp::value::Value;
use crate::lisp::vm::machine;
use crate::reader::{self, Reader};

impl Session {
    /// Evaluates all forms of a text. Each is read after those before it have been
    /// evaluated, so that it sees the package that they chose.
    pub(super) fn evaluate_text(
        &mut self,
        source_name: &str,
        text: &str,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        let source = self.image.sources.add(source_name, text);
        let mut reader = Reader::new(&self.image, source);
        loop {
            let form = match self.read_form(&mut reader) {
                Ok(Some(form)) => form,
                Ok(None) => return Outcome::Finished,
                Err(abort) => {
                    sink(Event::Aborted(abort));
                    return Outcome::Aborted;
                }
            };
            match self.evaluate_form(&form, sink) {
                Ended::Values(values) => {
                    let printed = values.iter().map(|v| self.printed(v)).collect();
                    self.flush(sink);
                    sink(Event::Values(printed));
                    self.image.output.begin_line();
                    if let Some(status) = self.simulation.quit {
                        return Outcome::Quit(status);
                    }
                }
                Ended::Aborted(abort) => {
                    sink(Event::Aborted(abort));
                    self.image.output.begin_line();
                    return Outcome::Aborted;
                }
            }
        }
    }

    /// The next form of the text, `#.` evaluated.
    fn read_form(&mut self, reader: &mut Reader) -> Result<Option<Value>, Box<Abort>> {
        let mut next = reader.next(&mut self.image);
        loop {
            match next {
                Ok(reader::Outcome::Form(form, _)) => return Ok(Some(form)),
                Ok(reader::Outcome::End) => return Ok(None),
                Ok(reader::Outcome::Evaluate(form)) => {
                    let value = self.evaluate_now(&form).map_err(|r| self.raised(r))?;
                    next = reader.supply(&mut self.image, value);
                }
                Err(error) => return Err(Box::new(self.raised(error.raise()))),
            }
        }
    }

    fn evaluate_now(&mut self, form: &Value) -> Result<Value, Box<Raise>> {
        let eval = crate::lisp::known::EVAL.into();
        machine::call_nested(&mut self.image, eval, vec![form.clone()])
    }
}
