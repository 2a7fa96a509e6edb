//! Checking a text without running it.
//!
//! A text is read and compiled form by form. Definitions take effect, so that later forms
//! can be read and compiled with them and calls can be checked; nothing else is evaluated,
//! and the values of variables are not computed. The compiler's notes are judged at the end,
//! when all definitions are known.

use std::collections::HashSet;

use super::judge::{Judge, Mistake};
use super::known::KnownNames;
use super::suggestion;
use super::tokens;
use crate::dialogue::screen::INTERRUPT;
use crate::dialogue::{Finding, Severity};
use crate::printing;
use lisp::compile;
use lisp::evaluator::nested;
use lisp::image::Image;
use lisp::image::notes::{Note, NoteKind};
use lisp::reader::Reader;
use lisp::reader::flattened::hidden_forms;
use lisp::source::{Place, SourceId};
use lisp::value::Value;
use lisp::value::known as names;
use lisp::value::raise::Raise;
use lisp::value::symbol::VariableKind;

/// The mistakes in a text, in the order of the text; what it defines is added to what is known.
pub(crate) fn check_text(
    image: &mut Image,
    known: &mut KnownNames,
    source_name: &str,
    text: &str,
) -> Vec<Finding> {
    let check = Check {
        image,
        known,
        name: source_name,
        text,
    };
    check.findings()
}

/// The check of a text.
struct Check<'s> {
    image: &'s mut Image,
    known: &'s mut KnownNames,
    name: &'s str,
    text: &'s str,
}

impl Check<'_> {
    fn findings(mut self) -> Vec<Finding> {
        let text = self.text;
        let source = self.image.sources.add(self.name, text);
        let mut reader = Reader::new(self.image, source);
        let mut findings = Vec::new();
        self.image.notes = Some(Vec::new());
        let was_open = self.known.is_open;
        loop {
            let (form, place) = match reader.next_form(self.image) {
                Ok(Some(form)) => form,
                Ok(None) => break,
                Err(error) => {
                    let suggestion = suggestion::of_unreadable(text, &error);
                    let finding = self.finding(error.raise());
                    findings.push(Finding {
                        suggestion: suggestion.or(finding.suggestion),
                        ..finding
                    });
                    // What the rest of the text defines is unknown.
                    self.known.is_open = true;
                    break;
                }
            };
            self.known.note_form(self.image, &form);
            self.image.noted_form = place;
            self.check_form(&form, &mut findings);
        }
        let notes = self.image.notes.take().unwrap_or_default();
        for note in &notes {
            match &note.kind {
                NoteKind::Definition(form) => self.known.note_definition(self.image, form),
                NoteKind::Assigned(name) => {
                    self.known.defined.insert(*name);
                }
                _ => {}
            }
        }
        findings.extend(self.warnings(&notes));
        findings.extend(self.hidden_forms(source, text));
        self.known.is_open = was_open;
        findings.sort_by_key(|f| f.place.as_ref().map(|place| (place.line, place.column)));
        findings
    }

    /// What the compiler's notes say.
    fn warnings(&mut self, notes: &[Note]) -> Vec<Finding> {
        let mistakes = Judge::new(self.image, self.known).judge_all(notes);
        let mistakes = placed(self.image, mistakes).into_iter();
        mistakes
            .map(|(place, mistake)| Finding {
                suggestion: suggestion::proposed(self.image, place, &mistake.text),
                message: mistake.text,
                place: self.image.sources.locate(place),
                severity: Severity::Warning,
            })
            .collect()
    }

    /// Forms in comments that have lost their ends.
    fn hidden_forms(&mut self, source: SourceId, text: &str) -> Vec<Finding> {
        let hidden = hidden_forms(text).into_iter();
        hidden
            .map(|comment| {
                let sources = &mut self.image.sources;
                let place = sources.place(source, comment.comment.start, comment.comment.end);
                Finding {
                    message: format!(
                        "The comment has swallowed \"{}\"; break the line before that if it is no \
                         comment.",
                        comment.code_in(text)
                    ),
                    place: sources.locate(place),
                    severity: Severity::Warning,
                    suggestion: None,
                }
            })
            .collect()
    }

    /// Checks one form at top level.
    fn check_form(&mut self, form: &Value, findings: &mut Vec<Finding>) {
        let head = form.car_or_nil().as_symbol();
        let inner = match head {
            Some(names::PROGN | names::LOCALLY) => form.cdr_or_nil(),
            Some(names::EVAL_WHEN) => form.cdr_or_nil().cdr_or_nil(),
            _ => return self.check_single(form, findings),
        };
        for form in inner.iter_list() {
            self.check_form(&form, findings);
        }
    }

    fn check_single(&mut self, form: &Value, findings: &mut Vec<Finding>) {
        let effect = self.effect(form);
        if effect != Effect::Reading
            && let Err(raise) = compile::compile_form(self.image, form)
        {
            let finding = self.finding(raise);
            return findings.push(finding);
        }
        let form = match effect {
            Effect::None => return,
            Effect::Reading | Effect::Definition => form.clone(),
            Effect::Variable => {
                let name = form.cdr_or_nil().car_or_nil();
                Value::list([names::DEFVAR.into(), name])
            }
        };
        let notes = self.image.notes.take();
        let result = nested::call_nested(self.image, names::EVAL.into(), vec![form]);
        self.image.output.take();
        self.image.notes = notes;
        if let Err(raise) = result
            && (effect == Effect::Reading || is_about_locks(&raise))
        {
            let finding = self.finding(raise);
            findings.push(finding);
        }
    }

    /// Does what later forms need to be read and compiled.
    fn effect(&self, form: &Value) -> Effect {
        let Some(head) = form.car_or_nil().as_symbol() else {
            return Effect::None;
        };
        match head {
            names::IN_PACKAGE
            | names::DEFPACKAGE
            | names::DEFMACRO
            | names::DEFSTRUCT
            | names::DEFINE_SYMBOL_MACRO
            | names::DEFSETF => return Effect::Reading,
            _ => {}
        }
        let entry = self.image.entry(head);
        match entry.map(|_| self.image.name(head)) {
            Some("DEFVAR" | "DEFPARAMETER" | "DEFCONSTANT" | "DEFINE-CONSTANT") => {
                let name = form.cdr_or_nil().car_or_nil().as_symbol();
                let is_fresh =
                    name.is_some_and(|name| self.image.symbol(name).kind == VariableKind::Lexical);
                if is_fresh {
                    Effect::Variable
                } else {
                    Effect::None
                }
            }
            Some("DECLAIM") => Effect::Definition,
            Some(name) if name.starts_with("DEF") => Effect::Definition,
            _ => Effect::None,
        }
    }

    fn finding(&mut self, raise: Box<Raise>) -> Finding {
        let mut abort = printing::raised(self.image, raise);
        let place = self.image.sources.locate(self.image.noted_form);
        abort.place = abort.place.or(place);
        let suggestion = suggestion::suggested(self.name, self.text, &abort);
        let asks = abort.hint.filter(|hint| hint.starts_with("Did you mean"));
        let message = match asks {
            _ if abort.condition == INTERRUPT => {
                "To expand this takes too long: a macro calculates without end, or for long."
                    .to_owned()
            }
            Some(asks) => format!("{} {asks}", abort.report.trim_end()),
            None => abort.report,
        };
        Finding {
            message,
            place: abort.place,
            severity: Severity::Error,
            suggestion,
        }
    }
}

/// Does it refuse a definition that would give a locked name another meaning?
fn is_about_locks(raise: &Raise) -> bool {
    match raise {
        Raise::Condition { condition, .. } => match condition {
            Value::Instance(instance) => instance.class().name == names::LOCKED_PACKAGE_ERROR,
            _ => false,
        },
        Raise::Make { class, .. } => *class == names::LOCKED_PACKAGE_ERROR,
    }
}

/// Mistakes with the places of what is wrong, each once: of several about a name at a place, the first.
pub(super) fn placed(image: &mut Image, mistakes: Vec<(Place, Mistake)>) -> Vec<(Place, Mistake)> {
    let mut seen = HashSet::new();
    let mut found = Vec::new();
    for (form, mistake) in mistakes {
        let place = place_of(image, form, &mistake);
        let subject = mistake.name.as_ref().unwrap_or(&mistake.text);
        if seen.insert((image.sources.bytes_of(place), subject.clone())) {
            found.push((place, mistake));
        }
    }
    found
}

/// The place of the name that is wrong, or else that of the form.
fn place_of(image: &mut Image, form: Place, mistake: &Mistake) -> Place {
    let Some(name) = &mistake.name else {
        return form;
    };
    let sources = &mut image.sources;
    let range = sources.text(form).and_then(|text| tokens::find(text, name));
    range
        .and_then(|range| sources.within(form, range.start, range.end))
        .unwrap_or(form)
}

/// The effect of a form on later forms.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Effect {
    /// None that matters here.
    None,
    /// Later forms cannot be read or expanded without it.
    Reading,
    /// It defines something.
    Definition,
    /// It defines a variable; its value must not be computed.
    Variable,
}
