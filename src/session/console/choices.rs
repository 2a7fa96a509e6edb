//! The choices for continuing a stopped evaluation.

use std::ops::Range;

use super::choice::Choice;
use super::evaluator::Evaluator;
use super::stopped::Asking;
use crate::dialogue::{Event, Outcome};
use lisp::evaluator::nested;
use lisp::evaluator::restart::Restart;
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::function::Body;
use lisp::value::known;
use lisp::value::package::PackageTable;
use lisp::vm::fiber::Dynamic;

impl Evaluator {
    /// The choices at the last level, with labels.
    pub(super) fn choices(&mut self) -> Vec<(Choice, String)> {
        let mut choices = self.restart_choices();
        choices.extend(self.robot_choices());
        choices.push((
            Choice::RetryForm,
            "[RETRY-FORM] Evaluate the form again.".to_owned(),
        ));
        let simulation = &self.host.simulation;
        // A robot elsewhere does not go back.
        if simulation.robot.is_none()
            && self
                .host
                .person
                .snapshots
                .has_changed_since_form(simulation)
        {
            let label = "[REWIND-FORM] Restore the world to before the form and evaluate it again.";
            choices.push((Choice::RewindForm, label.to_owned()));
        }
        choices.push((
            Choice::EditForm,
            "[EDIT-FORM] Change the form and evaluate it again.".to_owned(),
        ));
        let level = self.console.levels.len();
        if level > 1 {
            let label = format!("[ABORT-LEVEL] Return to level {}.", level - 1);
            choices.push((Choice::AbortLevel, label));
        }
        choices.push((Choice::Abort, "[ABORT] Return to the top level.".to_owned()));
        choices
    }

    fn restart_choices(&mut self) -> Vec<(Choice, String)> {
        let Some(fiber) = self.scheduler.stopped_fiber() else {
            return Vec::new();
        };
        let restarts: Vec<Value> = fiber
            .dynamic
            .iter()
            .rev()
            .filter_map(|entry| match entry {
                Dynamic::Restarts(list) => Some(list.iter_list()),
                _ => None,
            })
            .flatten()
            .collect();
        let mut choices = Vec::new();
        for value in restarts {
            let Some(restart) = value.as_foreign::<Restart>() else {
                continue;
            };
            let name = match restart.name {
                known::NIL => "RESTART".to_owned(),
                name => self.image.name(name).to_owned(),
            };
            let report = self.report_of(restart, &value);
            let takes_value = takes_value(&self.image, restart);
            let choice = Choice::Restart {
                restart: value.clone(),
                takes_value,
            };
            choices.push((choice, format!("[{name}] {report}")));
        }
        choices
    }

    fn report_of(&mut self, restart: &Restart, value: &Value) -> String {
        let text = match &restart.report {
            Value::Str(text) => Some(text.text()),
            report if !report.is_true() => None,
            function => {
                let text = "(lambda (report) (with-output-to-string (s) (funcall report s)))";
                let lambda = self.form_of("restart", text);
                let compiled = lambda.and_then(|lambda| {
                    lisp::compile::compile_lambda(&mut self.image, &lambda).ok()
                });
                compiled
                    .and_then(|show| {
                        let show = Value::Function(show);
                        nested::call_nested(&mut self.image, show, vec![function.clone()]).ok()
                    })
                    .and_then(|text| text.as_text())
            }
        };
        text.unwrap_or_else(|| print::to_string(&self.image, value, false))
    }

    /// Makes the choice, or asks for the value that it needs.
    pub(super) fn choose_or_ask(&mut self, number: usize, sink: &mut dyn FnMut(Event)) -> Outcome {
        match self.choice(number) {
            Some(Choice::Restart {
                takes_value: true, ..
            }) => {
                self.console.asking = Asking::Value(number);
                self.tell("; Which value? Type a form, or nothing to leave it.", sink)
            }
            _ => self.choose(number, "", "", sink),
        }
    }

    fn choice(&self, number: usize) -> Option<Choice> {
        let choices = &self.console.levels.last()?.choices;
        choices.get(number).map(|(choice, _)| choice.clone())
    }

    /// Chooses the first restart with that name.
    pub(super) fn choose_by_name(&mut self, name: &str, sink: &mut dyn FnMut(Event)) -> Outcome {
        let begin = format!("[{name}]");
        let choices = self.console.levels.last().map(|level| &level.choices);
        let found = choices.and_then(|choices| {
            choices
                .iter()
                .position(|(_, label)| label.starts_with(&begin))
        });
        match found {
            Some(number) => self.choose_or_ask(number, sink),
            None => self.tell("; There is no restart that continues.", sink),
        }
    }

    /// Makes the choice; the text, unless empty, is a form for the value that it needs.
    pub(super) fn choose(
        &mut self,
        number: usize,
        source_name: &str,
        text: &str,
        sink: &mut dyn FnMut(Event),
    ) -> Outcome {
        let Some(choice) = self.choice(number) else {
            return self.tell("; There is no restart of that number; :r tells them.", sink);
        };
        match choice {
            Choice::Restart {
                restart,
                takes_value,
            } => {
                let invoke = match takes_value || !text.trim().is_empty() {
                    true => "INVOKE-RESTART",
                    false => "INVOKE-RESTART-INTERACTIVELY",
                };
                let mut form = vec![
                    self.image.intern(PackageTable::CL, invoke).into(),
                    Value::list([known::QUOTE.into(), restart]),
                ];
                if !text.trim().is_empty() {
                    match self.form_of(source_name, text) {
                        Some(value) => form.push(value),
                        None => return self.tell("; One form was expected.", sink),
                    }
                } else if takes_value {
                    return Outcome::Finished;
                }
                self.evaluate_form_aside(&Value::list(form), sink)
            }
            Choice::Call {
                frame,
                function,
                args,
                motion,
            } => {
                if let Some(motion) = motion {
                    self.host
                        .person
                        .snapshots
                        .go_back_to(&mut self.host.simulation, motion);
                }
                self.replace_frame(frame, function, args, sink)
            }
            Choice::RetryForm => self.retry_form(sink, false),
            Choice::RewindForm => self.retry_form(sink, true),
            Choice::EditForm => self.edit_form(sink),
            Choice::AbortLevel => self.leave_level(sink),
            Choice::Abort => self.give_up(sink),
        }
    }
}

/// The choices that another level offers, too: the restarts outside all others, and what the robot
/// could do.
pub(super) fn shared(choices: &[(Choice, String)], below: &[(Choice, String)]) -> Range<usize> {
    let restarts = |choices: &[(Choice, String)]| -> Vec<Value> {
        let restarts = choices.iter().map_while(|(choice, _)| match choice {
            Choice::Restart { restart, .. } => Some(restart.clone()),
            _ => None,
        });
        restarts.collect()
    };
    let (own, outer) = (restarts(choices), restarts(below));
    let pairs = own.iter().rev().zip(outer.iter().rev());
    let count = pairs.take_while(|(a, b)| a.is_eq(b)).count();
    let is_shared = |choice: &&(Choice, String)| {
        let is_call = matches!(choice.0, Choice::Call { .. });
        is_call && below.iter().any(|(_, label)| *label == choice.1)
    };
    let calls = choices.iter().skip(own.len()).take_while(is_shared).count();
    own.len() - count..own.len() + calls
}

/// Whether a restart needs a value from the user.
fn takes_value(image: &Image, restart: &Restart) -> bool {
    if restart.interactive.is_true() {
        return false;
    }
    if matches!(restart.name, known::USE_VALUE | known::STORE_VALUE) {
        return true;
    }
    let Ok(function) = image.coerce_to_function(&restart.function) else {
        return false;
    };
    match &function.body {
        Body::Closure { code, .. } => code.parameters.required > 0,
        Body::Native(native) => native.min > 0,
        Body::Generic(_) | Body::Deferred(_) => false,
    }
}
