//! Carrying out requests of tasks, and advancing the world while all tasks wait.

use std::any::Any;

use super::call::HostCall;
use super::{Job, Simulation};
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;
use crate::motion::interruption::interruptible;
use crate::motion::{Motion, MotionOutcome, MotionStatus};
use crate::plan::designator::MotionRequest;
use crate::plan::{Advance, Host, Reply, TaskId, Ticket};
use crate::watch::{Cause, TaskState};
use crate::world::physics::STEP_SECONDS;

/// A step of the world to come: what motions have done for it so far.
#[derive(Default)]
pub(super) struct PartialStep {
    /// Motions that have set their joints.
    ticked: Vec<Ticket>,
    /// What has ended by that.
    completions: Vec<Completion>,
}

type Completion = (Ticket, Result<Value, Box<Raise>>);

impl Host for Simulation {
    fn request(&mut self, image: &mut Image, task: TaskId, request: Box<dyn Any>) -> Reply {
        self.asking = task;
        self.touch();
        let reply = self.reply(image, request);
        self.note_motions(image);
        reply
    }

    fn advance(&mut self, image: &mut Image, now: f64, until: Option<f64>) -> Advance {
        self.advance_watched(image, now, until, &mut |_| {})
    }

    fn idle(&mut self, image: &mut Image, now: f64, until: f64) -> f64 {
        let mut steps = 0u32;
        self.now = now;
        // A world at rest need not be stepped.
        while self.now < until && !self.world.is_at_rest() {
            if self.is_interrupted(image) {
                return self.now;
            }
            self.step(image);
            steps += 1;
            self.now = now + f64::from(steps) * STEP_SECONDS;
        }
        while self.now < until
            && let Some(pace) = &mut self.pace
            && let Some(slice) = pace.slice()
        {
            let slice = slice.min(until - self.now);
            pace.wait(slice, &image.interrupt);
            if self.is_interrupted(image) {
                return self.now;
            }
            self.now += slice;
            self.show(Cause::Wait);
        }
        self.now = until;
        self.show(Cause::Step);
        until
    }

    fn cancel(&mut self, _: &mut Image, ticket: Ticket) {
        let is_it = |job: &Job| job.ticket == ticket;
        let cancelled = match self.active.iter().position(is_it) {
            Some(place) => Some(self.active.remove(place)),
            None => {
                let place = self.waiting.iter().position(is_it);
                place.and_then(|place| self.waiting.remove(place))
            }
        };
        if let Some(mut job) = cancelled {
            job.motion.cancel();
            self.tell_motion(&job, TaskState::Evaporated, "");
        }
        if self.active.is_empty() {
            self.partial_step = None;
        }
    }

    fn pause(&mut self, _: &mut Image, ticket: Ticket) {
        self.set_paused(ticket, true);
    }

    fn wake(&mut self, _: &mut Image, ticket: Ticket) {
        self.set_paused(ticket, false);
    }
}

impl Simulation {
    /// As [`Host::advance`]; `watch` is called after every step.
    pub(in crate::session) fn advance_watched(
        &mut self,
        image: &mut Image,
        now: f64,
        until: Option<f64>,
        watch: &mut dyn FnMut(&Simulation),
    ) -> Advance {
        self.now = now;
        let mut done = Vec::new();
        let mut steps = 0u32;
        while done.is_empty()
            && until.is_none_or(|until| self.now < until)
            && !self.is_interrupted(image)
        {
            if self.partial_step.is_none() {
                self.admit_waiting();
            }
            if !self.tick(image, &mut done) {
                break;
            }
            self.step(image);
            steps += 1;
            self.now = now + f64::from(steps) * STEP_SECONDS;
            watch(self);
        }
        Advance {
            now: self.now,
            done,
        }
    }

    /// What the robot is doing, how far that is, and the simulated time, on one line.
    pub(in crate::session) fn progress(&self) -> String {
        let jobs = self.active.iter().filter(|job| !job.is_paused);
        let mut parts: Vec<String> = jobs
            .map(|job| {
                let progress = job.motion.progress();
                let percent = (progress.fraction * 100.0).clamp(0.0, 100.0);
                format!("{} {percent:.0} %", progress.what)
            })
            .collect();
        parts.push(format!("{:.1} s", self.now));
        format!("… {}", parts.join(" · "))
    }

    /// The reply to a request.
    fn reply(&mut self, image: &mut Image, request: Box<dyn Any>) -> Reply {
        let request = match request.downcast::<HostCall>() {
            Ok(call) => {
                let reply = (call.call)(self, image, &call.args);
                self.show(Cause::Edit);
                return reply.unwrap_or_else(|raise| Reply::Now(Err(raise)));
            }
            Err(request) => request,
        };
        match request.downcast::<MotionRequest>() {
            Ok(request) => match self.motion_for(image, &request) {
                Ok((motion, subject)) => {
                    // The task is told before what it does.
                    self.tell_tasks(image);
                    let name = request.motion_type.to_lowercase();
                    Reply::Later(self.start(motion, subject, name))
                }
                Err(raise) => Reply::Now(Err(raise)),
            },
            Err(_) => Reply::Now(Err(Raise::control("This cannot be waited for."))),
        }
    }

    /// Starts a motion as soon as its process module is free.
    pub(super) fn start(
        &mut self,
        motion: Box<dyn Motion>,
        subject: Value,
        name: String,
    ) -> Ticket {
        self.next_ticket += 1;
        self.begin_motion();
        let ticket = Ticket(self.next_ticket);
        let job = Job {
            ticket,
            module: motion.module(),
            motion,
            subject,
            task: self.asking,
            name,
            is_paused: false,
        };
        self.tell_motion(&job, TaskState::Running, "");
        self.waiting.push_back(job);
        ticket
    }

    fn admit_waiting(&mut self) {
        let mut still_waiting = std::collections::VecDeque::new();
        while let Some(job) = self.waiting.pop_front() {
            let is_busy = |other: &Job| other.module == job.module;
            if self.active.iter().any(is_busy) || still_waiting.iter().any(is_busy) {
                still_waiting.push_back(job);
            } else {
                self.active.push(job);
            }
        }
        self.waiting = still_waiting;
    }

    /// Lets the motions set the robot's joints for the next step. When an interrupt comes
    /// before one of them plans, or while it does, the rest is left for later: false.
    fn tick(&mut self, image: &mut Image, completions: &mut Vec<Completion>) -> bool {
        let mut partial_step = self.partial_step.take().unwrap_or_default();
        let mut jobs = std::mem::take(&mut self.active);
        let mut is_whole = true;
        for job in &mut jobs {
            if job.is_paused || partial_step.ticked.contains(&job.ticket) {
                continue;
            }
            let Some(status) = self.tick_job(image, job) else {
                is_whole = false;
                break;
            };
            partial_step.ticked.push(job.ticket);
            let result = match status {
                MotionStatus::Running => continue,
                MotionStatus::Done(outcome) => {
                    self.tell_motion(job, TaskState::Succeeded, "");
                    Ok(self.outcome(image, &outcome, &job.subject))
                }
                MotionStatus::Failed(failure) => {
                    self.tell_motion(job, TaskState::Failed, &failure.to_string());
                    if let Some(hit) = failure.hit() {
                        self.tell_collision(hit);
                    }
                    Err(self.failure(image, &failure, &job.subject))
                }
            };
            partial_step.completions.push((job.ticket, result));
        }
        jobs.append(&mut self.active);
        self.active = jobs;
        if !is_whole {
            self.partial_step = Some(partial_step);
            return false;
        }
        let has_ended = |job: &Job| {
            partial_step
                .completions
                .iter()
                .any(|(t, _)| *t == job.ticket)
        };
        self.active.retain(|job| !has_ended(job));
        completions.append(&mut partial_step.completions);
        true
    }

    /// Lets one motion set joints; none if an interrupt came before or while it planned. It
    /// is then as it was.
    fn tick_job(&mut self, image: &mut Image, job: &mut Job) -> Option<MotionStatus> {
        let Some(before) = job.motion.before_planning() else {
            return Some(job.motion.tick(&mut self.world));
        };
        if image.is_interrupted() {
            return None;
        }
        let status = interruptible(&image.interrupt, || job.motion.tick(&mut self.world));
        if status.is_none() {
            job.motion = before;
            image.polls.seen_since_last();
        }
        status
    }

    /// What a motion has brought about, as a value.
    fn outcome(&mut self, image: &mut Image, outcome: &MotionOutcome, subject: &Value) -> Value {
        match outcome {
            MotionOutcome::Arrived | MotionOutcome::Gripped { .. } => Value::NIL,
            MotionOutcome::Put { raised, .. } => Value::Double(*raised),
            MotionOutcome::Released { object, .. } => {
                self.held.shift_remove(object);
                Value::NIL
            }
            MotionOutcome::Detected(objects) => self.detected(image, objects, subject),
        }
    }

    fn step(&mut self, image: &Image) {
        self.world.step();
        self.observe();
        self.film();
        self.show(Cause::Step);
        if let Some(pace) = &mut self.pace {
            pace.wait(STEP_SECONDS, &image.interrupt);
        }
    }

    fn set_paused(&mut self, ticket: Ticket, paused: bool) {
        for job in self.active.iter_mut().chain(&mut self.waiting) {
            if job.ticket == ticket {
                job.is_paused = paused;
            }
        }
    }

    fn is_interrupted(&self, image: &Image) -> bool {
        image.is_interrupted()
    }
}
