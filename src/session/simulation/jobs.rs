//! Active motions, and those that wait for the part of the robot that they need.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::interruption::interruption;
use cram::{TaskId, Ticket};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;
use robotics::motion::interruption::interruptible;
use robotics::motion::{Motion, MotionStatus, PlannedTrajectory, ProcessModule};
use robotics::world::World;
use view::watch::{self, About};

/// A motion that a task waits for.
pub struct Job {
    pub(crate) ticket: Ticket,
    pub module: ProcessModule,
    motion: Box<dyn Motion>,
    /// The designator named in failures.
    pub(crate) subject: Value,
    /// The task that waits.
    pub task: TaskId,
    /// The kind of motion, for display.
    pub name: String,
    /// What followers are told of it.
    pub told: Told,
    pub(crate) is_paused: bool,
}

/// What followers are told of a motion, if there are any when it begins.
#[derive(Clone, Default)]
pub struct Told {
    /// The action or the task that performs it.
    pub parent: Option<watch::TaskId>,
    /// What it is.
    pub about: Option<Arc<About>>,
}

/// All motions.
#[derive(Default)]
pub(crate) struct Jobs {
    /// Active motions, in the order in which they started.
    pub(crate) active: Vec<Job>,
    /// Motions that have been cancelled and brake.
    pub(crate) leaving: Vec<Job>,
    /// Motions that wait for a process module, in order.
    waiting: VecDeque<Job>,
    /// What has been done for the next step, if an interrupt came in between.
    pub(crate) partial_step: Option<PartialStep>,
    /// Number of motions begun so far.
    pub begun: u64,
}

/// An incomplete step of the world: what motions have done for it so far.
#[derive(Default)]
pub(crate) struct PartialStep {
    /// Motions that have set their joints.
    pub(crate) ticked: Vec<Ticket>,
    /// Motions that have ended in this step.
    pub completions: Vec<Completion>,
}

/// How a motion has ended.
pub(crate) type Completion = (Ticket, Result<Value, Box<Raise>>);

impl Job {
    /// Whether the robot would not be at rest if the motion were left alone now.
    pub(crate) fn is_moving(&self) -> bool {
        self.motion.is_moving()
    }

    /// Lets the motion set joints for a step of braking.
    pub(crate) fn brake(&mut self, world: &mut World) {
        if self.motion.is_moving() {
            self.motion.brake(world);
        }
    }

    /// Lets the motion set joints; `None` if an interrupt came before or while it planned, in
    /// which case it is unchanged.
    pub fn tick(&mut self, image: &Image, world: &mut World) -> Option<MotionStatus> {
        let Some(before) = self.motion.before_planning() else {
            return Some(self.motion.tick(world));
        };
        if image.is_interrupted() {
            return None;
        }
        let status = interruptible(interruption(image), || self.motion.tick(world));
        if status.is_none() {
            self.motion = before;
            image.polls().seen_since_last();
        }
        status
    }
}

impl Jobs {
    /// Adds a motion, which begins as soon as its process module is free.
    pub(crate) fn add(
        &mut self,
        motion: Box<dyn Motion>,
        subject: Value,
        task: TaskId,
        name: String,
        told: Told,
    ) -> &Job {
        self.begun += 1;
        self.waiting.push_back(Job {
            ticket: Ticket(self.begun),
            module: motion.module(),
            motion,
            subject,
            task,
            name,
            told,
            is_paused: false,
        });
        // The motion has just been added.
        &self.waiting[self.waiting.len() - 1]
    }

    /// Starts the motions whose process modules are free.
    pub(crate) fn admit_waiting(&mut self) {
        if self.partial_step.is_some() {
            return;
        }
        let mut still_waiting = VecDeque::new();
        while let Some(job) = self.waiting.pop_front() {
            let is_busy = |other: &Job| job.module.excludes(other.module);
            let before = self.active.iter().chain(&self.leaving);
            if before.into_iter().any(is_busy) || still_waiting.iter().any(is_busy) {
                still_waiting.push_back(job);
            } else {
                self.active.push(job);
            }
        }
        self.waiting = still_waiting;
    }

    /// Ends a motion and removes it. Until [`Self::leave`] it goes on moving.
    pub(crate) fn cancel(&mut self, ticket: Ticket) -> Option<Job> {
        let is_it = |job: &Job| job.ticket == ticket;
        let mut cancelled = match self.active.iter().position(is_it) {
            Some(place) => Some(self.active.remove(place)),
            None => {
                let place = self.waiting.iter().position(is_it);
                place.and_then(|place| self.waiting.remove(place))
            }
        };
        if let Some(job) = &mut cancelled {
            job.motion.cancel();
        }
        let is_moving = cancelled.as_ref().is_some_and(Job::is_moving);
        if self.active.is_empty() && !is_moving {
            self.partial_step = None;
        }
        cancelled
    }

    /// Lets a cancelled motion brake in the next steps.
    pub(crate) fn leave(&mut self, job: Job) {
        if job.is_moving() {
            self.leaving.push(job);
        }
    }

    /// Whether motions brake that have been cancelled or paused.
    pub(crate) fn is_braking(&self) -> bool {
        let paused = self.active.iter().filter(|job| job.is_paused);
        self.leaving.iter().chain(paused).any(Job::is_moving)
    }

    /// Lets robots elsewhere stop, and waits for that.
    pub(crate) fn stop_elsewhere(&mut self, world: &mut World) {
        let moves = |job: &Job| job.motion.is_elsewhere() && job.motion.is_moving();
        loop {
            let mut jobs = self.active.iter_mut().chain(&mut self.leaving);
            let mut are_still = true;
            for job in jobs.by_ref().filter(|job| moves(job)) {
                job.motion.brake(world);
                are_still = false;
            }
            if are_still {
                return;
            }
        }
    }

    /// Pauses a motion or lets it continue.
    pub(crate) fn set_paused(&mut self, ticket: Ticket, paused: bool) {
        for job in self.active.iter_mut().chain(&mut self.waiting) {
            if job.ticket == ticket {
                job.is_paused = paused;
            }
        }
    }

    /// Whether no motion is active or waiting.
    pub(crate) fn is_idle(&self) -> bool {
        self.active.is_empty() && self.waiting.is_empty() && self.leaving.is_empty()
    }

    /// No motions, after so many.
    pub(crate) fn after(begun: u64) -> Self {
        Jobs {
            begun,
            ..Jobs::default()
        }
    }

    /// Forgets all motions.
    pub(crate) fn clear(&mut self) {
        self.active.clear();
        self.leaving.clear();
        self.partial_step = None;
        self.waiting.clear();
    }

    /// The trajectories that motions follow, with the motions' numbers.
    pub(crate) fn trajectories(&self) -> Vec<(u64, PlannedTrajectory<'_>)> {
        let jobs = self.active.iter();
        jobs.filter_map(|job| Some((job.ticket.0, job.motion.planned()?)))
            .collect()
    }

    /// What each motion is doing, and its progress.
    pub(crate) fn progress(&self) -> impl Iterator<Item = String> {
        let jobs = self.active.iter().filter(|job| !job.is_paused);
        jobs.map(|job| {
            let progress = job.motion.progress();
            let percent = (progress.fraction * 100.0).clamp(0.0, 100.0);
            format!("{} {percent:.0} %", progress.what)
        })
    }
}
