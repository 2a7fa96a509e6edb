//! Notes about variables that a program binds but never reads. Those that macros bind do not count,
//! nor those whose names begin with `_`.

use super::analyze::Compiler;
use super::body::Body;
use super::node::Binding;
use super::scope::{Entry, Scope, Var, VariableMeaning};
use crate::image::notes::NoteKind;
use crate::source::Place;
use crate::value::Value;

impl Compiler<'_> {
    /// Is the place one in the form that is noted, so that a person has written what is there?
    pub(super) fn is_written(&self, place: Place) -> bool {
        let sources = &self.image.sources;
        match (
            sources.bytes_of(place),
            sources.bytes_of(self.image.noted_form),
        ) {
            (Some((source, start, end)), Some((whole, first, last))) => {
                source == whole && first <= start && end <= last
            }
            _ => false,
        }
    }

    /// Takes a note of a variable that a body does not read. It is bound by the first of some lists that
    /// is one.
    pub(super) fn note_unread(&mut self, binding: &Binding, lists: &[&Value], body: &Body) {
        if self.image.notes.is_none() {
            return;
        }
        let list = lists.iter().find_map(|list| list.as_cons());
        if let (Binding::Lexical(var), Some(list)) = (binding, list) {
            self.note_unread_variable(var, list.place(), body);
        }
    }

    /// The same for the parameters of a function; the scope is that of its body.
    pub(super) fn note_unread_parameters(&mut self, list: &Value, scope: &Scope, body: &Body) {
        let place = match list {
            Value::Cons(cons) if self.image.notes.is_some() => cons.place(),
            _ => return,
        };
        let function = self.function_id();
        for entry in scope.entries() {
            match entry {
                Entry::Variable(_, VariableMeaning::Lexical(var)) if var.owner == function => {
                    self.note_unread_variable(var, place, body);
                }
                Entry::Variable(_, VariableMeaning::Special) => {}
                _ => break,
            }
        }
    }

    fn note_unread_variable(&mut self, var: &Var, place: Place, body: &Body) {
        let data = self.image.symbol(var.name);
        let is_meant = data.name.starts_with('_') || data.package.is_none();
        if var.read.get() || is_meant || body.ignored.contains(&var.name) {
            return;
        }
        if self.is_written(place) {
            let kind = NoteKind::Unused(var.name, var.assigned.get());
            self.image.note(place, || kind);
        }
    }
}
