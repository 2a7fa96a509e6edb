//! Answers of the world, with the tape between: they are recorded, or come from the tape.

use super::SimulationHost;
use crate::simulation::outcome;
use crate::tape::{Answer, Entry, Mark, checksum};
use cram::{Advance, Reply, Ticket};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;

/// What a request is told while its evaluation is being given up.
const LOST: &str = "The tape of the earlier session does not fit.";

impl SimulationHost {
    /// The reply to the request with that name and arguments. `work` finds it out; it may do
    /// nothing else besides that but change the physical state, the output, and symbols.
    pub(crate) fn answered(
        &mut self,
        image: &mut Image,
        name: &str,
        given: &[Value],
        work: impl FnOnce(&mut SimulationHost, &mut Image) -> Result<Reply, Box<Raise>>,
    ) -> Result<Reply, Box<Raise>> {
        if self.simulation.tape.is_playing() {
            return self.played(image, name, given, work);
        }
        if !self.simulation.tape.is_recording() {
            return work(self, image);
        }
        let mark = Mark::of(image);
        self.simulation.tape.open();
        let reply = work(self, image);
        let entry = if self.simulation.tape.is_touched() {
            let jobs = &self.simulation.shown().jobs;
            let subject = match reply {
                Ok(Reply::Later(ticket)) => jobs.subject(ticket),
                _ => None,
            };
            let answer = Answer::of(image, &reply, subject, given);
            let effects = mark.effects(image, self.simulation.motions_begun());
            answer.zip(effects).map(|(answer, effects)| Entry::Answer {
                request: checksum(image, name, given),
                effects,
                answer,
            })
        } else {
            Some(Entry::Apart)
        };
        self.simulation.tape.close(entry);
        reply
    }

    /// The reply that is on the tape.
    fn played(
        &mut self,
        image: &mut Image,
        name: &str,
        given: &[Value],
        work: impl FnOnce(&mut SimulationHost, &mut Image) -> Result<Reply, Box<Raise>>,
    ) -> Result<Reply, Box<Raise>> {
        let lost = || Raise::control(LOST);
        match self.simulation.tape.next() {
            Some(Entry::Apart) => work(self, image),
            Some(Entry::Answer {
                request,
                effects,
                answer,
            }) if request == checksum(image, name, given) => {
                self.simulation.tape.make_stale();
                self.simulation.tape.set_begun(effects.begun());
                effects.repeat(image);
                let reply = match answer {
                    Answer::Value(data) => data
                        .value(image, given)
                        .map(|value| Ok(Reply::Now(Ok(value)))),
                    Answer::Raise(data) => data.raise(image, given).map(Err),
                    Answer::Later { ticket, subject } => {
                        subject.value(image, given).map(|subject| {
                            self.simulation.tape.begin_motion(ticket, subject);
                            self.person.snapshots.note_motion(ticket.saturating_sub(1));
                            Ok(Reply::Later(Ticket(ticket)))
                        })
                    }
                };
                reply.unwrap_or_else(|| {
                    self.simulation.tape.fail();
                    Err(lost())
                })
            }
            _ => {
                self.simulation.tape.fail();
                Err(lost())
            }
        }
    }

    /// Lets time pass from `from` (s): `work` does it, or the tape tells what happened.
    pub(super) fn taped_time(
        &mut self,
        image: &mut Image,
        from: f64,
        until: Option<f64>,
        work: impl FnOnce(&mut SimulationHost, &mut Image) -> Advance,
    ) -> Advance {
        if self.simulation.tape.is_playing() {
            return self.played_time(image, from, until);
        }
        if !self.simulation.tape.is_recording() {
            return work(self, image);
        }
        let mark = Mark::of(image);
        self.simulation.tape.open();
        let advance = work(self, image);
        let is_whole = self.simulation.shown().jobs.partial_step.is_none();
        let ended = self.simulation.tape.take_ended();
        let done = ended.filter(|ended| {
            let tickets = ended.iter().map(|(ticket, _)| *ticket);
            is_whole && tickets.eq(advance.done.iter().map(|(ticket, _)| ticket.0))
        });
        let effects = mark.effects(image, self.simulation.motions_begun());
        let entry = done.zip(effects).map(|(done, effects)| Entry::Passed {
            from,
            until,
            reached: advance.now,
            effects,
            done,
        });
        self.simulation.tape.close(entry);
        advance
    }

    /// What happened meanwhile, as the tape tells it.
    fn played_time(&mut self, image: &mut Image, from: f64, until: Option<f64>) -> Advance {
        let simulation = &mut self.simulation;
        let mut advance = Advance {
            now: from,
            done: Vec::new(),
        };
        let bits = |times: (f64, Option<f64>)| (times.0.to_bits(), times.1.map(f64::to_bits));
        match simulation.tape.next() {
            Some(Entry::Passed {
                from: then,
                until: limit,
                reached,
                effects,
                done,
            }) if bits((then, limit)) == bits((from, until)) => {
                simulation.tape.make_stale();
                simulation.tape.set_begun(effects.begun());
                effects.repeat(image);
                simulation.now = reached;
                advance.now = reached;
                for (ticket, done) in done {
                    let subject = simulation.tape.end_motion(ticket);
                    let base = simulation.base_frame();
                    match subject.and_then(|s| outcome::of_done(image, &done, &s, base)) {
                        Some(outcome) => advance.done.push((Ticket(ticket), outcome)),
                        None => simulation.tape.fail(),
                    }
                }
            }
            _ => simulation.tape.fail(),
        }
        advance
    }
}
