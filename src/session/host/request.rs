//! Carrying out tasks' requests, and advancing the world while all tasks wait.

use super::call::HostCall;
use super::{SimulationHost, note_motions};
use crate::audience::task_news;
use crate::facts;
use crate::simulation::jobs::{Completion, Job, Told};
use cram::designator::MotionRequest;
use cram::{Advance, Host, Reply, TaskId, Ticket};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::motion::{Motion, MotionStatus};
use robotics::world::physics::STEP_SECONDS;
use view::watch::{Cause, TaskState};

impl Host for SimulationHost {
    type Call = HostCall;

    fn call(&mut self, image: &mut Image, task: TaskId, call: HostCall) -> Reply {
        self.reply(image, task, |host, image| {
            if call.is_edit && host.is_closed {
                return Err(closed());
            }
            let reply = (call.call)(host, image, &call.args);
            if call.is_edit {
                host.person.note_moment(&host.simulation);
            }
            host.audience.show(&host.simulation, Cause::Edit);
            reply
        })
    }

    fn perform(&mut self, image: &mut Image, task: TaskId, motion: MotionRequest) -> Reply {
        self.reply(image, task, |host, image| {
            // What is done in a copy of the world has not been done.
            if host.is_closed && host.person.snapshots.is_trial() {
                return Err(closed());
            }
            host.begin(image, &motion)
        })
    }

    fn advance(&mut self, image: &mut Image, now: f64, until: Option<f64>) -> Advance {
        self.advance_watched(image, now, until, &mut |_| {})
    }

    fn idle(&mut self, image: &mut Image, now: f64, until: f64) -> f64 {
        let mut steps = 0u32;
        self.simulation.now = now;
        self.audience.tell_resumed(now);
        // A world at rest does not need to be stepped.
        while self.simulation.now < until && !self.simulation.world.is_at_rest() {
            if image.is_interrupted() {
                return self.simulation.now;
            }
            self.step(image);
            steps += 1;
            self.simulation.now = now + f64::from(steps) * STEP_SECONDS;
        }
        while self.simulation.now < until
            && let Some(slice) = self.audience.slice()
        {
            let slice = slice.min(until - self.simulation.now);
            self.audience.wait(slice, image.interrupt());
            if image.is_interrupted() {
                return self.simulation.now;
            }
            self.simulation.now += slice;
            self.audience.show(&self.simulation, Cause::Wait);
        }
        self.simulation.now = until;
        self.audience.show(&self.simulation, Cause::Step);
        until
    }

    fn cancel(&mut self, _: &mut Image, ticket: Ticket) {
        if let Some(job) = self.simulation.jobs.cancel(ticket) {
            let now = self.simulation.now;
            self.audience
                .tell_motion(now, &job, TaskState::Evaporated, None);
            self.simulation.jobs.leave(job);
        }
    }

    fn stand_still(&mut self, image: &mut Image, now: f64) -> Advance {
        self.simulation.now = now;
        let mut done = Vec::new();
        let mut steps = 0u32;
        while self.simulation.jobs.is_braking() && self.tick(image, &mut done) {
            // Braking is short, and a viewer who has paused the session must not hold it up. What
            // an interrupt leaves of a step is done when the motions go on.
            self.step_at_once(image);
            steps += 1;
            self.simulation.now = now + f64::from(steps) * STEP_SECONDS;
        }
        self.simulation.jobs.leaving.retain(Job::is_moving);
        Advance {
            now: self.simulation.now,
            done,
        }
    }

    fn pause(&mut self, _: &mut Image, ticket: Ticket) {
        self.simulation.jobs.set_paused(ticket, true);
    }

    fn wake(&mut self, _: &mut Image, ticket: Ticket) {
        self.simulation.jobs.set_paused(ticket, false);
    }
}

/// Why a closed session refuses an edit.
fn closed() -> Box<Raise> {
    Raise::simple(
        "This session is closed: plans move the robot, but nothing edits the world, and no file is used.",
    )
}

impl SimulationHost {
    /// As [`Host::advance`]; `watch` is called after every step.
    pub(crate) fn advance_watched(
        &mut self,
        image: &mut Image,
        now: f64,
        until: Option<f64>,
        watch: &mut dyn FnMut(&SimulationHost),
    ) -> Advance {
        self.simulation.now = now;
        self.audience.tell_resumed(now);
        let mut done = Vec::new();
        let mut steps = 0u32;
        while done.is_empty()
            && until.is_none_or(|until| self.simulation.now < until)
            && !image.is_interrupted()
        {
            self.simulation.jobs.admit_waiting();
            if !self.tick(image, &mut done) {
                break;
            }
            self.step(image);
            steps += 1;
            self.simulation.now = now + f64::from(steps) * STEP_SECONDS;
            self.person.note_now_and_then(&self.simulation);
            watch(self);
        }
        if image.is_interrupted() {
            self.simulation.stop_robot();
        }
        if !done.is_empty() {
            self.person.note_moment(&self.simulation);
        }
        Advance {
            now: self.simulation.now,
            done,
        }
    }

    /// What is going on, if that is known, what the robot is doing, its progress, and the simulated
    /// time, on one line.
    pub(crate) fn progress(&self, what: Option<&str>) -> String {
        let what = what.map(str::to_owned).into_iter();
        let mut parts: Vec<String> = what.chain(self.simulation.jobs.progress()).collect();
        parts.push(format!("{:.1} s", self.simulation.now));
        format!("… {}", parts.join(" · "))
    }

    /// The reply to what a task asks for.
    fn reply(
        &mut self,
        image: &mut Image,
        task: TaskId,
        work: impl FnOnce(&mut Self, &mut Image) -> Result<Reply, Box<Raise>>,
    ) -> Reply {
        self.asking = task;
        self.person.snapshots.touch();
        let reply = work(self, image);
        facts::follow(image, &self.simulation.models);
        note_motions(&self.simulation, image);
        reply.unwrap_or_else(|raise| Reply::Now(Err(raise)))
    }

    /// Begins a motion.
    fn begin(&mut self, image: &mut Image, request: &MotionRequest) -> Result<Reply, Box<Raise>> {
        let (motion, subject) = self.simulation.motion_for(image, request)?;
        let mut motion = self.simulation.with_faults(image, motion, request);
        // What is only tried out does not move a robot elsewhere.
        if !self.person.snapshots.is_trial() {
            motion = self.simulation.of_real_robot(motion);
        }
        // Report the task before its actions.
        self.audience.tell_tasks(image);
        let told = self.told(image, Some(request));
        let name = request.motion_type.to_lowercase();
        Ok(Reply::Later(self.start(motion, subject, name, told)))
    }

    /// What followers are told of a motion.
    pub(crate) fn told(&self, image: &Image, request: Option<&MotionRequest>) -> Told {
        if !self.audience.has_followers() {
            return Told::default();
        }
        let about = request.map(|r| task_news::about(image, &r.designator, r.place).into());
        Told {
            parent: Some(task_news::starter_in(image, self.asking)),
            about,
        }
    }

    /// Starts a motion as soon as its process module is free.
    pub(crate) fn start(
        &mut self,
        motion: Box<dyn Motion>,
        subject: Value,
        name: String,
        told: Told,
    ) -> Ticket {
        let simulation = &mut self.simulation;
        self.person.begin_motion(simulation);
        let now = simulation.now;
        let job = simulation
            .jobs
            .add(motion, subject, self.asking, name, told);
        self.audience
            .tell_motion(now, job, TaskState::Running, None);
        job.ticket
    }

    /// Lets the motions set the robot's joints for the next step. If an interrupt comes before
    /// or while one of them plans, leaves the rest for later and returns false.
    fn tick(&mut self, image: &mut Image, completions: &mut Vec<Completion>) -> bool {
        let simulation = &mut self.simulation;
        let now = simulation.now;
        let mut partial_step = simulation.jobs.partial_step.take().unwrap_or_default();
        let mut leaving = std::mem::take(&mut simulation.jobs.leaving);
        leaving.retain(Job::is_moving);
        for job in &mut leaving {
            if !partial_step.ticked.contains(&job.ticket) {
                job.brake(&mut simulation.world);
                partial_step.ticked.push(job.ticket);
            }
        }
        simulation.jobs.leaving = leaving;
        let mut jobs = std::mem::take(&mut simulation.jobs.active);
        let mut is_whole = true;
        for job in &mut jobs {
            if partial_step.ticked.contains(&job.ticket) {
                continue;
            }
            if job.is_paused {
                job.brake(&mut simulation.world);
                partial_step.ticked.push(job.ticket);
                continue;
            }
            let Some(status) = job.tick(image, &mut simulation.world) else {
                is_whole = false;
                break;
            };
            partial_step.ticked.push(job.ticket);
            let result = match status {
                MotionStatus::Running => continue,
                MotionStatus::Done(outcome) => {
                    self.audience
                        .tell_motion(now, job, TaskState::Succeeded, None);
                    Ok(simulation.outcome(image, &outcome, &job.subject))
                }
                MotionStatus::Failed(failure) => {
                    self.audience
                        .tell_motion(now, job, TaskState::Failed, Some(&failure));
                    if let Some(hit) = failure.hit() {
                        self.audience.tell_collision(now, hit);
                    }
                    Err(simulation.failure(image, &failure, &job.subject))
                }
            };
            partial_step.completions.push((job.ticket, result));
        }
        jobs.append(&mut simulation.jobs.active);
        simulation.jobs.active = jobs;
        if !is_whole {
            simulation.jobs.partial_step = Some(partial_step);
            return false;
        }
        let mut ended = partial_step.completions;
        let has_ended = |ticket: Ticket| ended.iter().any(|(t, _)| *t == ticket);
        simulation.jobs.active.retain(|job| !has_ended(job.ticket));
        completions.append(&mut ended);
        true
    }

    fn step(&mut self, image: &mut Image) {
        self.step_at_once(image);
        self.audience.wait(STEP_SECONDS, image.interrupt());
    }

    /// A step of the world, without waiting for real time to pass.
    fn step_at_once(&mut self, image: &mut Image) {
        let simulation = &mut self.simulation;
        let step = simulation.world.steps();
        simulation.world.step();
        let base = simulation.base().translation;
        simulation.tally.base_at([base.x, base.y]);
        simulation.tell_of_slips(image, step);
        simulation.tell_of_tilts(image, step);
        self.audience.observe(simulation);
        self.audience.film(simulation);
        self.audience.show(simulation, Cause::Step);
    }
}
