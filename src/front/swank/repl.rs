//! The prompt in a buffer: `listener-eval` and what belongs to it.

use super::answer::Answer;
use super::engine::Engine;
use super::hub::Request;
use super::outbox::Outbox;
use super::package_text::package_name;
use super::sexp::Sexp;
use session::dialogue::ObjectNumber;

fn result(text: &str) -> Sexp {
    Sexp::list([
        Sexp::symbol(":write-string"),
        text.into(),
        Sexp::symbol(":repl-result"),
    ])
}

/// Shows values of a form; `first` is the number of the first one, if they can be pointed at.
pub(super) fn show_values(outbox: &Outbox, values: &[String], first: Option<ObjectNumber>) {
    if values.is_empty() {
        return outbox.send(&result("; No value\n"));
    }
    for (at, value) in values.iter().enumerate() {
        let mark = |kind: &str| {
            let number = first? + at as ObjectNumber;
            let number = Sexp::Int(i64::try_from(number).ok()?);
            let mark = [Sexp::symbol(kind), number, Sexp::symbol(":repl-result")];
            Some(Sexp::list(mark))
        };
        if let Some(start) = mark(":presentation-start") {
            outbox.send(&start);
        }
        outbox.send(&result(value));
        if let Some(end) = mark(":presentation-end") {
            outbox.send(&end);
        }
        outbox.send(&result("\n"));
    }
}

impl Engine<'_> {
    /// `create-repl`.
    pub(super) fn create_repl(&mut self, request: &Request) {
        self.begin(request, true);
        let (name, prompt) = self.session.package_names();
        self.client(request).package.clone_from(&name);
        request.ok(Sexp::list([name.into(), prompt.into()]));
    }

    /// `listener-eval`.
    pub(super) fn listener_eval(&mut self, request: &Request) {
        let Some(text) = request.text(0) else {
            return request.abort("listener-eval takes a text");
        };
        let presents = self.client(request).presents;
        let source = self.next_input();
        self.evaluate(request, &source, text, Answer::Prompt { presents });
    }

    /// `set-package`.
    pub(super) fn set_package(&mut self, request: &Request) {
        let wanted = request.argument(0).and_then(Sexp::as_name);
        let wanted = wanted.unwrap_or_default().to_owned();
        self.begin(request, true);
        if !self.enter(package_name(&wanted)) {
            return request.abort(&format!("there is no package {wanted}"));
        }
        let (name, prompt) = self.session.package_names();
        let beginning = self.session.beginning();
        let state = self.client(request);
        state.beginning = beginning;
        state.package.clone_from(&name);
        request.ok(Sexp::list([name.into(), prompt.into()]));
    }
}
