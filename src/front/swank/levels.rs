//! The levels at which evaluations have stopped, and the requests that wait there.

use super::answer::{Answer, Yield};
use super::debugger;
use super::engine::Engine;
use super::hub::{self, Request};
use super::sexp::Sexp;
use defect::Defect;
use session::dialogue::Outcome;
use session::dialogue::screen::INTERRUPT;

/// A request whose evaluation has stopped.
pub(super) struct Pending {
    /// The number of its level.
    pub(super) number: u64,
    pub(super) request: Request,
    /// Whether the request has still to be answered.
    pub(super) waits: bool,
    /// Whether the client is shown the level.
    pub(super) is_shown: bool,
    pub(super) answer: Answer,
    pub(super) yielded: Yield,
}

/// What an input has led to.
pub(super) struct Ended {
    pub(super) outcome: Outcome,
    /// The condition with which it ended, as printed, unless it finished.
    pub(super) aborted: Option<String>,
}

impl Ended {
    pub(super) fn by_defect(_: Defect) -> Ended {
        Ended {
            outcome: Outcome::Aborted,
            aborted: Some("#<DEFECT>".to_owned()),
        }
    }
}

impl Engine<'_> {
    /// Compares the stack of pending requests with the session's levels after an input: answers
    /// the requests whose evaluations have ended, and tells where the session has stopped.
    /// `begun` is the request whose evaluation the input has begun, if it has begun one.
    pub(super) fn settle(&mut self, mut begun: Option<Pending>, ended: &Ended) {
        let now = self.session.stops();
        let known = self.pending.iter().zip(&now);
        let kept = known.take_while(|(p, number)| p.number == **number).count();
        let mut left = self.pending.split_off(kept);
        for (at, pending) in left.iter().enumerate().rev() {
            if pending.is_shown {
                debugger::tell_left(&pending.request.client, kept + at + 1);
            }
        }
        // The outermost evaluation that was left has gone on, all further in have been abandoned.
        let mut going = None;
        if !left.is_empty() {
            going = Some(left.remove(0));
            // Whoever comes back to a level is shown it again.
            if let Some(below) = self.pending.last_mut() {
                below.is_shown = false;
            }
            for pending in left.into_iter().rev().chain(begun.take()) {
                self.abort(pending, "NIL");
            }
        }
        match (going.or(begun), now.get(kept)) {
            (Some(mut stopped), Some(number)) => {
                stopped.number = *number;
                stopped.is_shown = false;
                self.pending.push(stopped);
            }
            (Some(done), None) => self.finish(done, ended),
            // A decision has opened a level, such as by a value that cannot be computed.
            (None, Some(number)) => self.open_unasked(*number),
            (None, None) => {}
        }
        if now.len() > self.pending.len() {
            // Nobody could be shown those levels.
            self.give("decision", ":q", &mut |_| {});
            self.pending.clear();
        }
        if let Outcome::Quit(status) = ended.outcome {
            self.hub.end(hub::Ended::Quit(status));
        }
        self.show_stop();
    }

    /// A level that belongs to the client of the one below, but to no request.
    fn open_unasked(&mut self, number: u64) {
        let below = self.pending.last();
        let request = below.map(|pending| pending.request.clone());
        self.pending.extend(request.map(|request| Pending {
            number,
            request,
            waits: false,
            is_shown: false,
            answer: Answer::Nothing,
            yielded: Yield::default(),
        }));
    }

    /// Answers a request whose evaluation has ended.
    fn finish(&mut self, pending: Pending, ended: &Ended) {
        match &ended.aborted {
            Some(condition) if condition != INTERRUPT => return self.abort(pending, condition),
            Some(_) => return self.abort(pending, "NIL"),
            // Back on a level further out: the evaluation was abandoned.
            None if ended.outcome == Outcome::Stopped => return self.abort(pending, "NIL"),
            None => {}
        }
        self.keep_beginning(&pending);
        let request = &pending.request;
        if pending.waits {
            let value = match pending.answer {
                Answer::Inspector => self.inspector_of(request, pending.yielded.object),
                ref answer => answer.value(&pending.yielded),
            };
            request.ok(value);
        }
        if let Some(object) = self.session.take_inspected() {
            self.show_inspector(request, object);
        }
    }

    fn abort(&mut self, pending: Pending, reason: &str) {
        self.keep_beginning(&pending);
        if pending.waits {
            pending.request.abort(reason);
        }
    }

    /// Keeps what an input at a client's prompt has left behind, for its next one.
    fn keep_beginning(&mut self, pending: &Pending) {
        if !pending.answer.is_of_prompt() {
            return;
        }
        let (package, prompt) = self.session.package_names();
        let beginning = self.session.beginning();
        let Some(state) = self.clients.get_mut(&pending.request.client.number) else {
            return;
        };
        state.beginning = beginning;
        if state.package != package {
            state.package.clone_from(&package);
            let message = [Sexp::symbol(":new-package"), package.into(), prompt.into()];
            state.client.outbox.send(&Sexp::list(message));
        }
    }

    /// Leaves the innermost levels as long as they belong to clients that are gone.
    pub(super) fn leave_for_the_gone(&mut self) {
        loop {
            let Some(top) = self.pending.last() else {
                return;
            };
            if self.clients.contains_key(&top.request.client.number) {
                return;
            }
            let before = self.pending.len();
            self.leave_level();
            if self.pending.len() >= before {
                // Cleanup code has stopped again; there is nobody to decide.
                self.decide(":q");
                if self.pending.len() >= before {
                    return;
                }
            }
        }
    }
}
