//! The inspector: a value with its parts, and the way that has led to it.

use std::ops::Range;

use super::answer::Answer;
use super::engine::Engine;
use super::hub::Request;
use super::sexp::Sexp;
use session::dialogue::{Inspection, ObjectNumber};

/// Number of parts that are shown at first, and of texts in one answer.
const FIRST_PARTS: usize = 100;
/// Number of texts that make a line for a part.
const TEXTS_OF_PART: usize = 4;

/// The values that a client inspects.
#[derive(Default)]
pub(super) struct Path {
    /// Those that it has come through, and those to which `next` leads.
    visited: Vec<ObjectNumber>,
    /// The index of the present one.
    at: usize,
    /// The values of parts that were told, by their numbers in the text.
    parts: Vec<ObjectNumber>,
}

impl Path {
    /// All values that are kept for it.
    pub(super) fn all(&self) -> Vec<ObjectNumber> {
        let visited = self.visited.iter();
        visited.chain(&self.parts).copied().collect()
    }

    fn present(&self) -> Option<ObjectNumber> {
        self.visited.get(self.at).copied()
    }

    fn visit(&mut self, object: ObjectNumber) {
        self.visited.truncate(self.at + 1);
        self.visited.push(object);
        self.at = self.visited.len() - 1;
    }
}

impl Engine<'_> {
    fn path(&mut self, request: &Request) -> &mut Path {
        &mut self.client(request).inspected
    }

    /// Begins to inspect a value; returns what is shown of it.
    pub(super) fn inspector_of(&mut self, request: &Request, object: Option<ObjectNumber>) -> Sexp {
        let Some(object) = object else {
            return Sexp::NIL;
        };
        let old = std::mem::take(self.path(request)).all();
        self.session.forget_objects(&old);
        self.path(request).visit(object);
        self.shown(request)
    }

    /// Opens the inspector of a client for a value.
    pub(super) fn show_inspector(&mut self, request: &Request, object: ObjectNumber) {
        let shown = self.inspector_of(request, Some(object));
        let message = [Sexp::symbol(":inspect"), shown, Sexp::NIL, Sexp::NIL];
        request.client.outbox.send(&Sexp::list(message));
    }

    /// The present value as it is shown.
    fn shown(&mut self, request: &Request) -> Sexp {
        let Some((title, content)) = self.content(request, 0..FIRST_PARTS * TEXTS_OF_PART, true)
        else {
            return Sexp::NIL;
        };
        Sexp::properties([
            ("title", title.into()),
            ("id", Sexp::Int(0)),
            ("content", content),
        ])
    }

    /// A range of the texts that show the present value. If it is shown anew, the parts are
    /// counted from zero again.
    fn content(
        &mut self,
        request: &Request,
        texts: Range<usize>,
        is_anew: bool,
    ) -> Option<(String, Sexp)> {
        let object = self.path(request).present()?;
        if is_anew {
            let old = std::mem::take(&mut self.path(request).parts);
            self.session.forget_objects(&old);
        }
        let first = texts.start / TEXTS_OF_PART;
        let last = texts
            .end
            .div_ceil(TEXTS_OF_PART)
            .min(first + 10 * FIRST_PARTS);
        let inspection = self.session.look_into(object, first..last)?;
        let Inspection {
            title,
            parts,
            count,
        } = inspection;
        let mut told = Vec::new();
        for (name, text, part) in parts {
            let value = match part {
                Some(part) => {
                    let known = &mut self.path(request).parts;
                    known.push(part);
                    let number = known.len() - 1;
                    Sexp::list([Sexp::symbol(":value"), text.into(), number.into()])
                }
                None => text.into(),
            };
            told.extend([format!("{name}: ").into(), value, "\n".into(), "".into()]);
        }
        let (start, end) = (first * TEXTS_OF_PART, first * TEXTS_OF_PART + told.len());
        let content = [
            Sexp::List(told),
            (count * TEXTS_OF_PART).into(),
            start.into(),
            end.into(),
        ];
        Some((title, Sexp::list(content)))
    }

    /// `init-inspector`.
    pub(super) fn init_inspector(&mut self, request: &Request) {
        let Some(text) = request.text(0) else {
            return request.abort("init-inspector takes a form");
        };
        let source = self.next_input();
        self.evaluate(request, &source, text, Answer::Inspector);
    }

    /// `inspect-presentation`.
    pub(super) fn inspect_presentation(&mut self, request: &Request) {
        let number = request.argument(0).and_then(Sexp::as_int);
        let object = number.and_then(|number| ObjectNumber::try_from(number).ok());
        let is_known = object.is_some_and(|object| self.session.look_into(object, 0..0).is_some());
        if !is_known {
            return request.abort("the value is no longer known");
        }
        // The path owns what it inspects; the value itself stays where it was shown.
        let before = self.session.beginning();
        let copy = object.filter(|object| self.session.set_last_value(*object));
        let copy = copy.map(|_| self.session.last_value());
        self.session.begin_with(&before);
        let shown = self.inspector_of(request, copy);
        request.ok(shown);
    }

    /// `inspect-current-condition` and `inspect-frame-var`.
    pub(super) fn inspect_stop(&mut self, request: &Request) {
        let index = |at: usize| request.argument(at).and_then(Sexp::as_index);
        let object = match (index(0), index(1)) {
            (Some(frame), Some(variable)) => self.session.frame_variable(frame, variable),
            _ => self.session.stopped_by(),
        };
        if object.is_none() {
            return request.abort("there is no such value");
        }
        let shown = self.inspector_of(request, object);
        request.ok(shown);
    }

    /// `inspect-nth-part`.
    pub(super) fn inspect_part(&mut self, request: &Request) {
        let number = request.argument(0).and_then(Sexp::as_index);
        let path = self.path(request);
        let part = number
            .filter(|number| *number < path.parts.len())
            .map(|number| path.parts.remove(number));
        let Some(part) = part else {
            return request.abort("there is no such part");
        };
        path.visit(part);
        let shown = self.shown(request);
        request.ok(shown);
    }

    /// `inspector-pop`, `inspector-next` and `inspector-reinspect`: shows the value so many steps
    /// further on the path.
    pub(super) fn inspect_again(&mut self, request: &Request, steps: isize) {
        let path = self.path(request);
        let at = path.at.checked_add_signed(steps);
        let Some(at) = at.filter(|at| *at < path.visited.len()) else {
            return request.ok(Sexp::NIL);
        };
        path.at = at;
        let shown = self.shown(request);
        request.ok(shown);
    }

    /// `inspector-range`.
    pub(super) fn inspect_range(&mut self, request: &Request) {
        let index = |at: usize| request.argument(at).and_then(Sexp::as_index);
        let (from, to) = (index(0).unwrap_or(0), index(1).unwrap_or(0));
        let content = self.content(request, from..to.max(from), false);
        request.ok(content.map_or(Sexp::NIL, |(_, content)| content));
    }

    /// `inspector-eval`: a form in which `*` is the value.
    pub(super) fn evaluate_on_inspected(&mut self, request: &Request) {
        let text = request.text(0).unwrap_or_default().to_owned();
        let Some(object) = self.path(request).present() else {
            return request.abort("nothing is inspected");
        };
        let before = self.client(request).beginning.clone();
        self.session.begin_with(&before);
        self.session.set_last_value(object);
        self.client(request).beginning = self.session.beginning();
        let source = self.next_input();
        self.evaluate(request, &source, &text, Answer::Values);
        self.client(request).beginning = before;
    }

    /// `describe-inspectee`.
    pub(super) fn describe_inspected(&mut self, request: &Request) {
        let object = self.path(request).present();
        let inspection = object.and_then(|object| self.session.look_into(object, 0..0));
        match inspection {
            Some(inspection) => request.ok(inspection.title.into()),
            None => request.abort("nothing is inspected"),
        }
    }

    /// `quit-inspector`.
    pub(super) fn quit_inspector(&mut self, request: &Request) {
        let old = std::mem::take(self.path(request)).all();
        self.session.forget_objects(&old);
        request.ok(Sexp::NIL);
    }
}
