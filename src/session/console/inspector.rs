//! The inspector: descending into the parts of a value, and back.

use super::evaluator::Evaluator;
use super::stopped::Asking;
use crate::dialogue::{Event, Outcome};
use crate::host::parts::View;
use lisp::value::Value;
use lisp::value::known;

/// Help text on what can be typed.
const REMARK: &str =
    "; A number inspects a part, b goes back, q leaves; * is the value being inspected.";

impl Evaluator {
    /// Handles an input for the inspector; `None` if it is not for the inspector, or if nothing
    /// is being inspected.
    pub(crate) fn inspector_input(
        &mut self,
        text: &str,
        sink: &mut dyn FnMut(Event),
    ) -> Option<Outcome> {
        if self.console.asking != Asking::Nothing {
            return None;
        }
        let current = self.console.inspected.last()?.clone();
        match text.trim().to_lowercase().as_str() {
            "q" | ":q" | "quit" => {
                self.console.inspected.clear();
                return Some(Outcome::Finished);
            }
            "b" | ":b" | "back" => {
                if self.console.inspected.len() > 1 {
                    self.console.inspected.pop();
                }
            }
            "" => {}
            word => {
                let number: usize = word.parse().ok()?;
                let view = View::of(&self.host, &mut self.image, &current);
                match view.parts.into_iter().nth(number) {
                    Some((_, part)) if !part.is_unbound() => self.console.inspected.push(part),
                    _ => return Some(self.tell("; There is no such part.", sink)),
                }
            }
        }
        let current = self.console.inspected.last()?.clone();
        self.image.set_special(known::TIMES, current.clone());
        Some(self.tell_inspected(&current, sink))
    }

    fn tell_inspected(&mut self, value: &Value, sink: &mut dyn FnMut(Event)) -> Outcome {
        let view = View::of(&self.host, &mut self.image, value);
        let text = view.text(&self.image);
        self.tell(&format!("{text}{REMARK}"), sink)
    }

    /// After a form: starts to inspect the value that it requested, if the session is
    /// interactive.
    pub(crate) fn open_inspector(&mut self, sink: &mut dyn FnMut(Event)) {
        let Some(value) = self.host.person.inspected.take() else {
            return;
        };
        if self.objects.is_served() {
            self.objects.inspect_next(value);
        } else if self.console.is_interactive {
            self.console.inspected = vec![value.clone()];
            self.image.set_special(known::TIMES, value);
            sink(Event::Output(format!("{REMARK}\n")));
            self.image.output.begin_line();
        }
    }
}
