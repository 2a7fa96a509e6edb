//! The debugger: stops, their choices and frames.

use std::sync::Arc;

use super::answer::Answer;
use super::definitions::{location, nowhere};
use super::engine::Engine;
use super::hub::{Client, Request};
use super::question::THREAD;
use super::sexp::Sexp;
use session::dialogue::screen::INTERRUPT;
use session::dialogue::{Need, StackFrame, Stop};

/// Number of frames that are shown at first.
const FIRST_FRAMES: usize = 20;
/// Number of frames in one answer.
const MAX_FRAMES: usize = 500;
/// A choice for whose value a client has been asked.
pub(super) struct Asked {
    /// The request by which it was chosen.
    request: Request,
    tag: i64,
    /// The number of the level.
    level: u64,
    choice: usize,
}

/// Tells a client that a level has been left.
pub(super) fn tell_left(client: &Client, level: usize) {
    let message = [
        Sexp::symbol(":debug-return"),
        THREAD,
        level.into(),
        Sexp::NIL,
    ];
    client.outbox.send(&Sexp::list(message));
}

/// Name and text of a choice.
fn parts_of_choice(label: &str) -> (&str, &str) {
    let named = label
        .strip_prefix('[')
        .and_then(|rest| rest.split_once("] "));
    named.unwrap_or(match label {
        "Continue." => ("CONTINUE", label),
        "Abort." => ("ABORT", label),
        _ => ("PARK", label),
    })
}

fn frame(number: usize, frame: &StackFrame) -> Sexp {
    let restartable = Sexp::list([Sexp::symbol(":restartable"), Sexp::t()]);
    Sexp::list([number.into(), frame.call.as_str().into(), restartable])
}

impl Engine<'_> {
    /// Shows the last level to its client, unless that knows it.
    pub(super) fn show_stop(&mut self) {
        let (Some(stop), Some(top)) = (self.session.last_stop(), self.pending.last_mut()) else {
            return;
        };
        if std::mem::replace(&mut top.is_shown, true) {
            return;
        }
        let client = Arc::clone(&top.request.client);
        let pending = self.pending.iter().rev();
        let pending = pending.filter(|p| p.waits && p.request.client.number == client.number);
        let pending: Vec<Sexp> = pending.map(|p| Sexp::Int(p.request.id)).collect();
        let frames = self.session.stack();
        let frames = frames.iter().enumerate().take(FIRST_FRAMES);
        let choices = self.choices(&stop);
        let choices = choices.iter().map(|choice| {
            let label = stop.choices.get(*choice).map_or("", String::as_str);
            let (name, text) = parts_of_choice(label);
            Sexp::list([name, text].map(Sexp::from))
        });
        let message = [
            Sexp::symbol(":debug"),
            THREAD,
            stop.level.into(),
            told_condition(&stop),
            Sexp::list(choices),
            Sexp::list(frames.map(|(number, told)| frame(number, told))),
            Sexp::List(pending),
        ];
        client.outbox.send(&Sexp::list(message));
        let activate = [
            Sexp::symbol(":debug-activate"),
            THREAD,
            stop.level.into(),
            Sexp::NIL,
        ];
        client.outbox.send(&Sexp::list(activate));
    }

    /// The choices that an editor can make, by their numbers in the session.
    fn choices(&self, stop: &Stop) -> Vec<usize> {
        let all = 0..stop.choices.len();
        all.filter(|choice| self.session.choice_needs(*choice) != Need::Text)
            .collect()
    }

    /// Whether the last level is one about which the client of a request may decide; if not, the
    /// request is answered.
    fn may_decide(&self, request: &Request) -> bool {
        match self.pending.last() {
            None => {
                request.abort("nothing has stopped");
                false
            }
            Some(top) if top.request.client.number != request.client.number => {
                request.abort("another client's evaluation has stopped on top of this one");
                false
            }
            Some(_) => true,
        }
    }

    /// Answers a request that decides, and tells that its level is left.
    fn begin_decision(&mut self, request: &Request) {
        request.abort("NIL");
        let level = self.pending.len();
        if let Some(top) = self.pending.last_mut()
            && std::mem::take(&mut top.is_shown)
        {
            tell_left(&top.request.client, level);
        }
    }

    /// `invoke-nth-restart-for-emacs`.
    pub(super) fn choose(&mut self, request: &Request) {
        if !self.may_decide(request) {
            return;
        }
        let level = request.argument(0).and_then(Sexp::as_index);
        if level != Some(self.pending.len()) {
            return request.abort("that is not the last level");
        }
        let number = request.argument(1).and_then(Sexp::as_index);
        let stop = self.session.last_stop();
        let choices = stop.map(|stop| self.choices(&stop)).unwrap_or_default();
        match number.and_then(|number| choices.get(number)) {
            Some(choice) => self.choose_number(request, *choice),
            None => request.abort("there is no such restart"),
        }
    }

    fn choose_number(&mut self, request: &Request, choice: usize) {
        if self.session.choice_needs(choice) == Need::Value {
            return self.ask_for_value(request, choice);
        }
        self.begin_decision(request);
        self.decide(&choice.to_string());
    }

    /// Asks the client for the value of a choice.
    fn ask_for_value(&mut self, request: &Request, choice: usize) {
        self.forget_question();
        let tag = self.questions.next_tag();
        let Some(level) = self.pending.last().map(|top| top.number) else {
            return;
        };
        let outbox = &request.client.outbox;
        let question = "Which value? Type a form: ";
        outbox.send(&Sexp::list([
            Sexp::symbol(":write-string"),
            question.into(),
        ]));
        let read = [Sexp::symbol(":read-string"), THREAD, Sexp::Int(tag)];
        outbox.send(&Sexp::list(read));
        self.asked = Some(Asked {
            request: request.clone(),
            tag,
            level,
            choice,
        });
    }

    /// A client has typed what it was asked for.
    pub(super) fn typed(&mut self, client: &Client, tag: i64, text: &str) {
        let is_it =
            |asked: &mut Asked| asked.tag == tag && asked.request.client.number == client.number;
        let Some(asked) = self.asked.take_if(is_it) else {
            return;
        };
        let top = self.pending.last().map(|top| top.number);
        if top != Some(asked.level) || text.trim().is_empty() {
            return asked.request.abort("NIL");
        }
        self.begin_decision(&asked.request);
        self.decide(&format!("{} {}", asked.choice, text.trim()));
    }

    /// A client does not want to type what it was asked for.
    pub(super) fn not_typed(&mut self, client: &Client) {
        let asked = self.asked.as_ref();
        if asked.is_some_and(|asked| asked.request.client.number == client.number) {
            self.forget_question();
        }
    }

    /// Takes a question back.
    pub(super) fn forget_question(&mut self) {
        if let Some(asked) = self.asked.take() {
            let taken_back = [Sexp::symbol(":read-aborted"), THREAD, Sexp::Int(asked.tag)];
            asked.request.client.outbox.send(&Sexp::list(taken_back));
            asked.request.abort("NIL");
        }
    }

    /// `throw-to-toplevel`: leaves all levels of the client.
    pub(super) fn leave_all(&mut self, request: &Request) {
        self.forget_question();
        if !self.may_decide(request) {
            return;
        }
        self.begin_decision(request);
        let client = request.client.number;
        let is_own = |pending: &super::levels::Pending| pending.request.client.number == client;
        if self.pending.iter().all(is_own) {
            return self.decide(":q");
        }
        while self.pending.last().is_some_and(is_own) {
            let before = self.pending.len();
            self.leave_level();
            if self.pending.len() >= before {
                return;
            }
        }
    }

    /// `sldb-abort`: leaves the last level.
    pub(super) fn abort_level(&mut self, request: &Request) {
        self.forget_question();
        if self.may_decide(request) {
            self.begin_decision(request);
            self.leave_level();
        }
    }

    /// Leaves the last level.
    pub(super) fn leave_level(&mut self) {
        self.decide(":a");
    }

    /// `sldb-continue`.
    pub(super) fn go_on(&mut self, request: &Request) {
        if !self.may_decide(request) {
            return;
        }
        let stop = self.session.last_stop();
        let choices = stop.map(|stop| stop.choices).unwrap_or_default();
        let mut choices = choices.iter().map(|label| parts_of_choice(label).0);
        match choices.position(|name| name == "CONTINUE") {
            Some(choice) => self.choose_number(request, choice),
            None => request.abort("there is no restart CONTINUE"),
        }
    }

    /// `restart-frame` and `sldb-return-from-frame`: an input that leaves a frame.
    pub(super) fn leave_frame(&mut self, request: &Request, input: &str) {
        let number = request.argument(0).and_then(Sexp::as_index);
        let Some(number) = number.filter(|number| *number < self.session.stack().len()) else {
            return request.abort("there is no such frame");
        };
        if !self.may_decide(request) {
            return;
        }
        self.select_frame(number);
        self.begin_decision(request);
        self.decide(input);
    }

    /// Makes later evaluations on this level happen in a frame.
    fn select_frame(&mut self, number: usize) {
        self.give("decision", &format!(":frame {number}"), &mut |_| {});
    }

    /// `backtrace`.
    pub(super) fn backtrace(&mut self, request: &Request) {
        let from = request.argument(0).and_then(Sexp::as_index).unwrap_or(0);
        let to = request.argument(1).and_then(Sexp::as_index);
        let count = to.map_or(MAX_FRAMES, |to| to.saturating_sub(from).min(MAX_FRAMES));
        let frames = self.session.stack();
        let frames = frames.iter().enumerate().skip(from).take(count);
        request.ok(Sexp::list(frames.map(|(number, told)| frame(number, told))));
    }

    /// `frame-locals-and-catch-tags`.
    pub(super) fn variables(&mut self, request: &Request) {
        let number = request.argument(0).and_then(Sexp::as_index);
        let variables = number.map(|number| self.session.frame_variables(number));
        let variables = variables.unwrap_or_default().into_iter();
        let told = variables.map(|(name, value)| {
            Sexp::properties([
                ("name", name.into()),
                ("id", Sexp::Int(0)),
                ("value", value.into()),
            ])
        });
        request.ok(Sexp::list([Sexp::list(told), Sexp::NIL]));
    }

    /// The frame that a request names first.
    fn frame_of(&self, request: &Request) -> Option<StackFrame> {
        let number = request.argument(0).and_then(Sexp::as_index)?;
        self.session.stack().into_iter().nth(number)
    }

    /// `frame-source-location`.
    pub(super) fn place_of_frame(&mut self, request: &Request) {
        request.ok(match self.frame_of(request) {
            Some(frame) => location(frame.place.as_ref()),
            None => nowhere("There is no such frame."),
        });
    }

    /// `frame-package-name`.
    pub(super) fn package_of_frame(&mut self, request: &Request) {
        let package = self.frame_of(request).map(|frame| frame.package);
        request.ok(package
            .unwrap_or_else(|| "COMMON-LISP-USER".to_owned())
            .into());
    }

    /// `eval-string-in-frame`, `pprint-eval-string-in-frame` and `inspect-in-frame`.
    pub(super) fn evaluate_in_frame(&mut self, request: &Request, answer: Answer) {
        let (Some(text), Some(frame)) = (
            request.text(0),
            request.argument(1).and_then(Sexp::as_index),
        ) else {
            return request.abort("a form and a frame are needed");
        };
        if !self.may_decide(request) {
            return;
        }
        self.select_frame(frame);
        let source = self.next_input();
        let package = request.argument(2).and_then(Sexp::as_name);
        let in_package = Request {
            package: package
                .map(str::to_owned)
                .or_else(|| request.package.clone()),
            ..request.clone()
        };
        self.evaluate(&in_package, &source, text, answer);
    }
}

/// The condition of a stop: report, class, and nothing more.
fn told_condition(stop: &Stop) -> Sexp {
    let abort = &stop.abort;
    if abort.condition == INTERRUPT {
        return Sexp::list(["Interrupt from Emacs".into(), "".into(), Sexp::NIL]);
    }
    let mut report = abort.report.trim_end().to_owned();
    let place = abort
        .main_place()
        .filter(|place| !place.name.starts_with("prompt["));
    let hint = abort.hint.iter().map(|hint| format!("\n{hint}"));
    report.extend(hint.chain(place.map(|place| format!("\nat {place}"))));
    let context = abort.context();
    // The numbers of inputs mean nothing to the user.
    let lines = context.iter().map(|line| line.split(" at prompt[").next());
    report.extend(lines.flatten().map(|line| format!("\n{line}")));
    let class = format!("   [Condition of type {}]", abort.class);
    Sexp::list([report.into(), class.into(), Sexp::NIL])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_have_a_name_and_a_text() {
        let parts = parts_of_choice;
        assert_eq!(
            parts("[ABORT] Return to [the] top."),
            ("ABORT", "Return to [the] top.")
        );
        assert_eq!(parts("Continue."), ("CONTINUE", "Continue."));
        assert_eq!(parts("Abort, and park the arms.").0, "PARK");
    }
}
