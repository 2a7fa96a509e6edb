//! The inspector: descending into the parts of a value, and back.

use super::{Asking, Session};
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::symbol::FunctionCell;
use crate::session::dialogue::screen::is_input_name;
use crate::session::dialogue::{Event, Outcome};
use crate::session::host::parts::View;

/// Help text on what can be typed.
const REMARK: &str =
    "; A number inspects a part, b goes back, q leaves; * is the value being inspected.";

impl Session {
    /// Handles an input for the inspector; `None` if it is not for the inspector, or if nothing
    /// is being inspected.
    pub(in crate::session) fn inspector_input(
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
                let view = View::of(&mut self.host, &mut self.image, &current);
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
        let view = View::of(&mut self.host, &mut self.image, value);
        let text = view.text(&self.image);
        self.tell(&format!("{text}{REMARK}"), sink)
    }

    /// After a form: starts to inspect the value that it requested, if the session is
    /// interactive.
    pub(in crate::session) fn open_inspector(&mut self, sink: &mut dyn FnMut(Event)) {
        let Some(value) = self.host.person.inspected.take() else {
            return;
        };
        if self.console.is_interactive {
            self.console.inspected = vec![value.clone()];
            self.image.set_special(known::TIMES, value);
            sink(Event::Output(format!("{REMARK}\n")));
            self.image.output.begin_line();
        }
    }

    /// Expands shorthand in an input at a prompt, whoever types it: `?name` asks for documentation, unless it is a variable with a value;
    /// and the functions of package `PLANWRIGHT` can be called from every package.
    pub(in crate::session) fn question(&self, source_name: &str, text: &str) -> Option<String> {
        if !is_input_name(source_name) {
            return None;
        }
        self.documentation_asked(text)
            .or_else(|| self.call_of_prompt(text))
    }

    /// `(rewind …)` as `(pw:rewind …)` if that name has no meaning in the current package.
    fn call_of_prompt(&self, text: &str) -> Option<String> {
        let rest = text.trim_start().strip_prefix('(')?;
        let end = rest.find(|c: char| c.is_whitespace() || c == ')')?;
        let (name, arguments) = rest.split_at_checked(end)?;
        let upper = name.to_uppercase();
        let (current, own) = (
            self.image.current_package(),
            self.image.packages.find("PLANWRIGHT")?,
        );
        let known = self.image.packages.find_symbol(current, &upper);
        let is_defined = known.is_some_and(|(sym, _)| {
            !matches!(self.image.symbol(sym).function, FunctionCell::Unbound)
        });
        let package = self.image.packages.get(own);
        let is_offered = package
            .symbols
            .get(upper.as_str())
            .is_some_and(|(_, external)| *external);
        (!is_defined && is_offered).then(|| format!("(pw:{name}{arguments}"))
    }

    fn documentation_asked(&self, text: &str) -> Option<String> {
        let name = text.trim().strip_prefix('?')?;
        let is_name = !name.is_empty()
            && name
                .chars()
                .all(|c| !c.is_whitespace() && !"()\"';`,|".contains(c));
        if !is_name {
            return None;
        }
        let current = self.image.current_package();
        let whole = text.trim().to_uppercase();
        let variable = self.image.packages.find_symbol(current, &whole);
        let has_value = variable.is_some_and(|(sym, _)| !self.image.special(sym).is_unbound());
        (!has_value).then(|| format!("(pw:doc {name})"))
    }
}
