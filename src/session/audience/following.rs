//! The session's followers, which are notified of every step, of edits and of other events.

use super::{Audience, task_news};
use crate::simulation::Simulation;
use crate::simulation::jobs::Job;
use cram::Plan;
use lisp::image::Image;
use robotics::motion::{MotionFailure, PlannedTrajectory};
use robotics::world::CollisionHit;
use view::watch::{
    About, Cause, Follower, Halt, Observation, TaskId, TaskNews, TaskState, WatchEvent,
};

/// The followers of a session.
#[derive(Default)]
pub(crate) struct Followers {
    all: Vec<(FollowerId, Box<dyn Follower>)>,
    last: u64,
    /// Why the session does not go on, as followers know it.
    halt: Option<Halt>,
    /// The tasks that followers know to be stopped, parents first.
    stopped: Vec<TaskNews>,
}

/// Identifies a follower.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct FollowerId(u64);

impl Audience {
    /// Adds a follower, which is notified from now on.
    pub(crate) fn add_follower(
        &mut self,
        simulation: &Simulation,
        image: &Image,
        mut follower: Box<dyn Follower>,
    ) -> FollowerId {
        Plan::of(image).keep_journal();
        let trajectories = simulation.jobs.trajectories();
        follower.see(&observation(simulation, &trajectories), Cause::Rest);
        let now = simulation.now();
        for news in &self.followers.stopped {
            follower.hear(now, &WatchEvent::Task(news.clone()));
        }
        if let Some(halt) = &self.followers.halt {
            follower.hear(now, &WatchEvent::Halted(halt.clone()));
        }
        self.followers.last += 1;
        let id = FollowerId(self.followers.last);
        self.followers.all.push((id, follower));
        id
    }

    /// Removes a follower.
    pub(crate) fn remove_follower(&mut self, id: FollowerId) {
        self.followers.all.retain(|(known, _)| *known != id);
    }

    /// Whether there are any followers.
    pub(crate) fn has_followers(&self) -> bool {
        !self.followers.all.is_empty()
    }

    /// Shows the followers the present state of the world.
    pub fn show(&mut self, simulation: &Simulation, cause: Cause) {
        if self.followers.all.is_empty() {
            return;
        }
        let mut followers = std::mem::take(&mut self.followers.all);
        let trajectories = simulation.jobs.trajectories();
        let observation = observation(simulation, &trajectories);
        for (_, follower) in &mut followers {
            follower.see(&observation, cause);
        }
        followers.append(&mut self.followers.all);
        self.followers.all = followers;
    }

    /// Notifies the followers of an event.
    pub fn tell(&mut self, now: f64, event: &WatchEvent) {
        for (_, follower) in &mut self.followers.all {
            follower.hear(now, event);
        }
    }

    /// Notifies the followers that the session does not go on, with the tasks that have stopped,
    /// or that it does.
    pub(crate) fn tell_halt(&mut self, now: f64, halt: Option<Halt>, stopped: Vec<TaskNews>) {
        let before = std::mem::replace(&mut self.followers.stopped, stopped.clone());
        let is_still = |news: &&TaskNews| stopped.iter().any(|task| task.id == news.id);
        for news in before.iter().filter(|news| !is_still(news)) {
            let goes_on = TaskNews {
                state: TaskState::Running,
                failure: String::new(),
                class: String::new(),
                ..news.clone()
            };
            self.tell(now, &WatchEvent::Task(goes_on));
        }
        for news in stopped.into_iter().filter(|news| !before.contains(news)) {
            self.tell(now, &WatchEvent::Task(news));
        }
        if self.followers.halt == halt {
            return;
        }
        let event = halt.clone().map_or(WatchEvent::Resumed, WatchEvent::Halted);
        self.followers.halt = halt;
        self.tell(now, &event);
    }

    /// Notifies the followers that the session goes on, if they do not know.
    pub(crate) fn tell_resumed(&mut self, now: f64) {
        if self.followers.halt.is_some() {
            self.tell_halt(now, None, Vec::new());
        }
    }

    /// Notifies the followers of changes in the states of tasks.
    pub(crate) fn tell_tasks(&mut self, image: &Image) {
        if self.followers.all.is_empty() {
            return;
        }
        for change in Plan::of(image).fetch_journal() {
            let (time, news) = task_news::of_change(image, change);
            // Whatever has become of it, it is not stopped any more.
            self.followers.stopped.retain(|task| task.id != news.id);
            self.tell(time, &WatchEvent::Task(news));
        }
    }

    /// Notifies the followers of a change in the state of a motion.
    pub(crate) fn tell_motion(
        &mut self,
        now: f64,
        job: &Job,
        state: TaskState,
        failure: Option<&MotionFailure>,
    ) {
        if self.followers.all.is_empty() {
            return;
        }
        let about = job.told.about.as_deref().map(|about| {
            let module = job.module.to_string();
            let about = About {
                module,
                ..about.clone()
            };
            about.into()
        });
        self.tell(
            now,
            &WatchEvent::Task(TaskNews {
                id: TaskId::Motion(job.ticket.0),
                parent: job.told.parent.or(Some(TaskId::Task(job.task.0))),
                name: job.name.clone(),
                state,
                failure: failure.map(ToString::to_string).unwrap_or_default(),
                class: failure.map_or("", MotionFailure::class_name).to_owned(),
                result: String::new(),
                about: about.filter(|_| state == TaskState::Running),
            }),
        );
    }

    /// Notifies the followers of the collision that stopped a motion.
    pub(crate) fn tell_collision(&mut self, now: f64, hit: &CollisionHit) {
        for (_, follower) in &mut self.followers.all {
            follower.collide(now, hit);
        }
    }
}

fn observation<'a>(
    simulation: &'a Simulation,
    trajectories: &'a [(u64, PlannedTrajectory<'a>)],
) -> Observation<'a> {
    Observation {
        time: simulation.now,
        world: &simulation.world,
        axes: simulation.axes.as_ref().map(|axes| (axes.pose, axes.size)),
        location: simulation
            .location_map
            .as_ref()
            .or(simulation.resolved_map.as_ref()),
        trajectories,
    }
}
