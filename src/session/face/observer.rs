//! A follower that tells an observer what happens in plans.

use std::collections::BTreeSet;

use super::plan_event::{PlanEvent, PlanEventKind, TaskBegin, TaskEnd};
use robotics::motion::held_objects;
use robotics::robot::Side;
use robotics::world::{CollisionHit, World};
use view::watch::{Cause, Follower, Observation, TaskId, TaskNews, TaskState, WatchEvent};

/// Tells a function of the program what happens.
pub(crate) struct Observer {
    tell: Box<dyn FnMut(&PlanEvent)>,
    /// What has begun and has not ended.
    open: BTreeSet<TaskId>,
    /// Whether what functions do to the world is passed over, so that hands hold only what the robot has taken.
    ignores_edits: bool,
    /// What the hands hold; `None` before the world has been seen.
    held: Option<Vec<(Side, String)>>,
}

impl Observer {
    pub(crate) fn new(tell: Box<dyn FnMut(&PlanEvent)>) -> Observer {
        Observer {
            tell,
            open: BTreeSet::new(),
            ignores_edits: false,
            held: None,
        }
    }

    /// The same, but what functions do to the world, such as the taking away of a held object, is not told.
    pub(crate) fn of_robot(self) -> Observer {
        Observer {
            ignores_edits: true,
            ..self
        }
    }

    fn tell(&mut self, time: f64, kind: PlanEventKind) {
        (self.tell)(&PlanEvent { time, kind });
    }

    fn change(&mut self, news: &TaskNews) -> Option<PlanEventKind> {
        let id = news.id;
        Some(match news.state {
            TaskState::Running if self.open.insert(id) => PlanEventKind::Began(TaskBegin {
                id,
                parent: news.parent,
                name: news.name.clone(),
                about: news.about.clone(),
            }),
            TaskState::Running => PlanEventKind::Continued(id),
            TaskState::Suspended => PlanEventKind::Suspended(id),
            TaskState::Stopped => return None,
            TaskState::Succeeded | TaskState::Failed | TaskState::Evaporated => {
                self.open.remove(&id);
                let has_failed = news.state == TaskState::Failed;
                PlanEventKind::Ended(TaskEnd {
                    id,
                    name: news.name.clone(),
                    state: news.state,
                    failure: has_failed.then(|| (news.class.clone(), news.failure.clone())),
                    result: news.result.clone(),
                })
            }
        })
    }
}

impl Follower for Observer {
    fn see(&mut self, observation: &Observation<'_>, cause: Cause) {
        let held = held(observation.world);
        let Some(before) = self.held.replace(held.clone()) else {
            return;
        };
        if self.ignores_edits && cause != Cause::Step {
            return;
        }
        let time = observation.time;
        for (side, object) in before
            .iter()
            .filter(|held_before| !held.contains(held_before))
        {
            let (side, object) = (*side, object.clone());
            self.tell(time, PlanEventKind::Released { object, side });
        }
        for (side, object) in held.into_iter().filter(|held| !before.contains(held)) {
            self.tell(time, PlanEventKind::Held { object, side });
        }
    }

    fn hear(&mut self, time: f64, event: &WatchEvent) {
        let kind = match event {
            WatchEvent::Output(text) => Some(PlanEventKind::Printed(text.clone())),
            WatchEvent::Task(news) => self.change(news),
            WatchEvent::Halted(_) | WatchEvent::Resumed => None,
        };
        if let Some(kind) = kind {
            self.tell(time, kind);
        }
    }

    fn collide(&mut self, time: f64, hit: &CollisionHit) {
        let bodies = [&hit.moving, &hit.other].map(ToString::to_string);
        self.tell(time, PlanEventKind::Collided(bodies));
    }
}

/// The objects that the hands hold.
fn held(world: &World) -> Vec<(Side, String)> {
    let held = world.models().description.sides().flat_map(|side| {
        let objects = held_objects(world, side).into_iter();
        objects.map(move |object| (side, object))
    });
    held.collect()
}
