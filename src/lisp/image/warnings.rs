//! Warnings about forms that are evaluated at the prompt or by `load`. The compiler takes notes of them;
//! a judge, which a layer above the language provides, makes warnings of the notes.

use std::rc::Rc;

use super::Image;
use super::extension::Extension;
use super::notes::{Note, NoteKind};
use crate::source::Place;
use crate::value::Value;
use crate::value::copy::Copier;
use crate::value::known;

/// What is known about warnings.
#[derive(Default)]
pub struct Warnings {
    /// Is the form that is evaluated next to be judged?
    is_wanted: bool,
    /// What cannot be judged before the end of the text, since what is missing may be defined there.
    pending: Vec<Note>,
}

/// A warning.
pub struct Warning {
    /// What is wrong, and where.
    pub text: String,
    /// Whether the program can work all the same.
    pub is_style: bool,
}

/// What makes warnings of notes.
pub struct Judge(pub fn(&mut Image, &[Note]) -> Vec<Warning>);

impl Extension for Judge {
    fn copied(self: Rc<Self>, _: &mut Copier) -> Rc<dyn Extension> {
        self
    }
}

impl Image {
    /// From now on, the form at a place is the one that is evaluated; it is to be judged if that is wanted.
    pub fn begin_noted_form(&mut self, place: Place, is_wanted: bool) {
        self.noted_form = place;
        self.warnings.is_wanted = is_wanted;
    }

    /// Is the form to be judged whose evaluation begins? What it evaluates itself is not.
    pub(crate) fn take_wanted(&mut self) -> bool {
        std::mem::take(&mut self.warnings.is_wanted)
    }

    /// The same holds for the form that is evaluated next.
    pub(crate) fn want_warnings(&mut self, is_wanted: bool) {
        self.warnings.is_wanted = is_wanted;
    }

    /// Is there anything that makes warnings of notes?
    pub(crate) fn has_judge(&self) -> bool {
        self.extension::<Judge>().is_some()
    }

    /// Keeps notes that can be judged without what comes after the form out of those that wait for the
    /// end of the text.
    pub(crate) fn sorted_notes(&mut self, notes: Vec<Note>) -> Vec<Note> {
        let (now, later): (Vec<Note>, Vec<Note>) = notes
            .into_iter()
            .partition(|note| note.kind.is_about_form_alone());
        self.warnings.pending.extend(later);
        now
    }

    /// Does something while notes are taken.
    pub(crate) fn noting<T>(&mut self, work: impl FnOnce(&mut Image) -> T) -> (T, Vec<Note>) {
        let outside = self.notes.replace(Vec::new());
        let result = work(self);
        let notes = std::mem::replace(&mut self.notes, outside);
        (result, notes.unwrap_or_default())
    }

    /// The notes that have waited for the end of a text.
    pub fn take_pending_notes(&mut self) -> Vec<Note> {
        std::mem::take(&mut self.warnings.pending)
    }

    /// Puts notes of an outer text back.
    pub(crate) fn restore_pending_notes(&mut self, notes: Vec<Note>) {
        self.warnings.pending = notes;
    }

    /// The warnings about notes.
    pub fn judged(&mut self, notes: &[Note]) -> Vec<Warning> {
        if notes.is_empty() {
            return Vec::new();
        }
        let judge = self.extension::<Judge>();
        judge.map_or_else(Vec::new, |judge| (judge.0)(self, notes))
    }
}

impl NoteKind {
    /// Can it be judged without what comes after the form?
    fn is_about_form_alone(&self) -> bool {
        matches!(
            self,
            NoteKind::Unused(..) | NoteKind::Unreachable | NoteKind::CaughtReturn(_)
        )
    }
}

impl Warning {
    /// The arguments with which `warn` signals it.
    pub fn arguments(&self) -> Vec<Value> {
        let class = match self.is_style {
            true => known::SIMPLE_STYLE_WARNING,
            false => known::SIMPLE_WARNING,
        };
        vec![
            class.into(),
            known::K_FORMAT_CONTROL.into(),
            Value::string("~a"),
            known::K_FORMAT_ARGUMENTS.into(),
            Value::list([Value::string(self.text.as_str())]),
        ]
    }
}
