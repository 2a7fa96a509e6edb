//! Printing structures, conditions and other instances, by the program's own functions where there
//! are such.

use std::rc::Rc;

use super::{Printer, Task};
use crate::print::atom::with_message;
use crate::print::dispatch;
use crate::print::report;
use crate::print::shape::Style;
use crate::print::symbol;
use crate::value::Value;
use crate::value::class::{ClassKind, Instance};
use crate::value::document::{Document, Newline};
use crate::value::known;

impl Printer<'_> {
    pub(super) fn instance(&mut self, value: &Value, instance: &Rc<Instance>, depth: usize) {
        if let Some(text) = self.text_by_program(value, instance, depth) {
            self.document.append(&text);
            return;
        }
        match instance.class().kind {
            ClassKind::Structure => {
                // One without slots has nothing that could be too deep.
                if !instance.slots.borrow().is_empty() && self.is_too_deep(depth) {
                    return;
                }
                self.document.open("#S(", ")");
                let settings = self.settings.clone().with_escape(true);
                let name = symbol::symbol(self.image, instance.class().name, &settings);
                self.document.text(&name);
                self.tasks.push(Task::Close(")"));
                self.tasks.push(Task::Slots {
                    instance: instance.clone(),
                    next: 0,
                    depth,
                });
            }
            ClassKind::Condition if !self.settings.escape => {
                let text = report::report(self.image, value);
                self.document.text(&text);
            }
            ClassKind::Condition if self.has_function_to_ask(instance) => {
                let write = known::SYS_WRITE_MESSAGE.into();
                let text = self.text_of_call(write, vec![value.clone()], depth);
                let message = text.and_then(|text| report::on_line(&text.into_text()));
                let class = instance.class().name;
                let text = with_message(self.image, value, class, self.settings, message);
                self.document.text(&text);
            }
            _ => self.atom(value),
        }
    }

    /// Does only a function of the program know what a condition says? One that prints the condition
    /// itself is not asked again.
    fn has_function_to_ask(&self, instance: &Rc<Instance>) -> bool {
        report::message(self.image, instance).is_none()
            && report::function(instance).is_some()
            && !self.image.special(known::V_IN_REPORT).is_true()
    }

    /// The text that the program's own printing function makes of an instance, if it has one.
    fn text_by_program(
        &mut self,
        value: &Value,
        instance: &Instance,
        depth: usize,
    ) -> Option<Document> {
        let skips_method = std::mem::take(&mut self.skips_method);
        if !skips_method && dispatch::has_print_method(self.image, instance) {
            return self.text_of_call(known::PRINT_OBJECT.into(), vec![value.clone()], depth);
        }
        if self.settings.escape {
            return None;
        }
        let report = report::function(instance)?;
        self.text_of_call(Value::Function(report), vec![value.clone()], depth)
    }

    pub(super) fn slots(&mut self, instance: Rc<Instance>, next: usize, depth: usize) {
        let class = instance.class();
        let Some(name) = class.slots.borrow().get(next).map(|slot| slot.name) else {
            return;
        };
        self.document.text(" ");
        self.document.newline(Newline::Linear);
        if self.is_cut(next) {
            self.document.text("...");
            return;
        }
        let name = symbol::name(self.image.name(name), self.settings);
        self.document.text(&format!(":{name} "));
        self.document.newline(Newline::Miser);
        let value = instance.slots.borrow().get(next).cloned();
        self.tasks.push(Task::Slots {
            instance,
            next: next + 1,
            depth,
        });
        let value = value.unwrap_or(Value::Unbound);
        self.tasks.push(Task::Value(value, Style::Auto, depth + 1));
    }
}
