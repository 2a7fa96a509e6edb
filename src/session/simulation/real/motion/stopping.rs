//! Letting the robot stop, and waiting for that.

use std::rc::Rc;
use std::time::Duration;

use super::super::UnderWay;
use super::super::belief::Told;
use super::super::goals::joints_of;
use super::{Ending, RealMotion, Sent, Stage};
use robotics::motion::{MotionFailure, RobotFailure, RobotTrouble};
use robotics::robot::RobotPart;
use robotics::world::World;

/// How long a robot that was to stop may take for that.
const STOPPING: Duration = Duration::from_secs(2);

impl RealMotion {
    /// Lets all goals end; the robot is to stand still.
    pub(super) fn stop(&mut self, sent: Vec<Sent>, ending: Ending) {
        for sent in sent.iter().filter(|sent| sent.end.is_none()) {
            self.robot.link.borrow_mut().cancel(sent.ticket);
        }
        self.stage = Stage::Stopping(self.now(), sent, ending);
    }

    /// Whether the robot stands still, or has been waited for long enough.
    pub(super) fn stands(&mut self, world: &mut World) -> bool {
        let now = self.now();
        let robot = Rc::clone(&self.robot);
        let Stage::Stopping(since, sent, ending) = &mut self.stage else {
            return true;
        };
        let mut link = robot.link.borrow_mut();
        for sent in sent.iter_mut().filter(|sent| sent.end.is_none()) {
            sent.end = link.end(sent.ticket);
        }
        let has_ended = sent.iter().all(|sent| sent.end.is_some());
        let parts: Vec<RobotPart> = sent.iter().map(|sent| sent.order.part).collect();
        let under_way = robot.under_way.borrow();
        let is_other = |other: &UnderWay| !other.parts.iter().any(|part| parts.contains(part));
        // What others let move may go on.
        let is_alone = !under_way.iter().any(is_other);
        drop(under_way);
        let models = world.models();
        let joints = parts.iter().flat_map(|part| joints_of(models, *part));
        let joints: Vec<&str> = joints
            .map(|joint| models.robot.joint(joint).name.as_str())
            .collect();
        let joints = (!is_alone).then_some(joints.as_slice());
        let base = is_alone || parts.contains(&RobotPart::Base);
        let stands = has_ended && link.stands_still(joints, base);
        if !stands && now.saturating_sub(*since) < STOPPING {
            return false;
        }
        if !stands {
            let running = sent.iter().filter(|sent| sent.end.is_none());
            let running: Vec<&str> = running.map(|sent| sent.interface.name.as_str()).collect();
            let what = match running.is_empty() {
                true => "it still moves, or does not tell".to_owned(),
                false => format!("nothing says that these have ended: {}", running.join(", ")),
            };
            // Who does not stand gets no new goal.
            if let Ending::Anew = ending {
                let trouble = RobotTrouble::NoState(
                    "the robot did not stand still when it was to stop".to_owned(),
                );
                let module = self.module;
                *ending = Ending::Failed(Box::new(MotionFailure::Robot(Box::new(RobotFailure {
                    module,
                    trouble,
                }))));
            }
            link.shout(&format!(
                "THE ROBOT DOES NOT STAND STILL 2 s after it was to stop ({what}). \
                 Use the emergency stop if it moves."
            ));
        }
        drop(link);
        robot.free(&parts);
        if let Ok(told) = Told::now(&robot, world) {
            told.believe(world, |part| parts.contains(&part), self.closed());
        }
        true
    }
}
