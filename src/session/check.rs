//! Looking for mistakes without running anything.

use super::Session;
use crate::dialogue::Finding;
use crate::lisp::compile;
use crate::lisp::known;
use crate::lisp::raise::Raise;
use crate::lisp::value::Value;
use crate::lisp::vm::machine;
use crate::reader::Reader;

impl Session {
    /// Reads and compiles all forms of a text. Definitions that later forms are read or
    /// expanded with (packages, macros) take effect; nothing else is evaluated.
    pub(super) fn check_text(&mut self, source_name: &str, text: &str) -> Vec<Finding> {
        let source = self.image.sources.add(source_name, text);
        let mut reader = Reader::new(&self.image, source);
        let mut findings = Vec::new();
        loop {
            let form = match reader.next_form(&mut self.image) {
                Ok(Some((form, _))) => form,
                Ok(None) => return findings,
                Err(error) => {
                    let finding = self.finding(error.raise());
                    findings.push(finding);
                    return findings;
                }
            };
            let result = if shapes_reading(&form) {
                machine::call_nested(&mut self.image, known::EVAL.into(), vec![form]).map(|_| ())
            } else {
                compile::compile_form(&mut self.image, &form).map(|_| ())
            };
            if let Err(raise) = result {
                let finding = self.finding(raise);
                findings.push(finding);
            }
        }
    }

    fn finding(&mut self, raise: Box<Raise>) -> Finding {
        let abort = self.raised(raise);
        Finding {
            message: abort.report,
            place: abort.place,
        }
    }
}

/// Must the form be evaluated for those after it to be read and compiled?
fn shapes_reading(form: &Value) -> bool {
    form.car_or_nil().as_symbol().is_some_and(|head| {
        matches!(
            head,
            known::IN_PACKAGE
                | known::DEFPACKAGE
                | known::DEFMACRO
                | known::DEFSTRUCT
                | known::DEFINE_SYMBOL_MACRO
                | known::DEFSETF
        )
    })
}
