//! A robot elsewhere that plans drive: the world here is what they believe of it.
//!
//! Each motion is first tried in a copy of the world, which gives the goals for the robot, and the reason if it cannot
//! be. Then the robot gets the goals, and the world here follows; in the end, what the robot tells of itself counts.

mod belief;
mod check;
mod goals;
mod motion;
mod sight;
mod trial;

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use super::Simulation;
use crate::outside::RobotLink;
use lisp::value::raise::Raise;
use robotics::motion::{DetectQuery, Motion, ProcessModule};
use robotics::robot::{RobotInterface, RobotPart, Side};

use motion::RealMotion;

/// A robot elsewhere.
pub(crate) struct RobotAccess {
    link: RefCell<Box<dyn RobotLink>>,
    interface: RobotInterface,
    /// How many plans that drive it are under way, one inside the other.
    depth: Cell<u32>,
    /// The parts that have goals.
    busy: RefCell<Vec<RobotPart>>,
    /// Hands that have closed farther than what they were to grip is wide, and the gap (m) at which they were to meet it. Until
    /// they open, the world here has fingers in what they missed.
    missed: RefCell<Vec<(Side, f64)>>,
    /// Whether it has told how it is at least once.
    was_heard: Cell<bool>,
}

/// The robot of a session, shared with the motions that it carries out.
pub(crate) type SharedRobot = Rc<RobotAccess>;

impl RobotAccess {
    /// A robot that is reached by a link.
    pub(crate) fn new(link: Box<dyn RobotLink>, interface: RobotInterface) -> SharedRobot {
        Rc::new(Self {
            link: RefCell::new(link),
            interface,
            depth: Cell::new(0),
            busy: RefCell::default(),
            missed: RefCell::default(),
            was_heard: Cell::new(false),
        })
    }

    /// The gap (m) at which a hand was to meet what it has missed, if it has.
    fn missed(&self, part: RobotPart) -> Option<f64> {
        let missed = self.missed.borrow();
        let mut missed = missed.iter();
        let missed = missed.find(|(side, _)| part == RobotPart::Gripper(*side));
        missed.map(|(_, gap)| *gap)
    }

    /// Remembers, or forgets, that a hand has missed what it was to meet at a gap (m).
    fn note_missed(&self, part: RobotPart, gap: Option<f64>) {
        let RobotPart::Gripper(side) = part else {
            return;
        };
        let mut missed = self.missed.borrow_mut();
        missed.retain(|(known, _)| *known != side);
        missed.extend(gap.map(|gap| (side, gap)));
    }

    fn is_driven(&self) -> bool {
        self.depth.get() > 0
    }
}

impl Simulation {
    /// From now on, motions are carried out by the robot that is reached by a link, until [`Self::leave_robot`].
    pub(crate) fn drive_robot(&self) -> Result<(), Box<Raise>> {
        let Some(robot) = &self.robot else {
            return Err(Raise::simple(
                "There is no robot to drive: start planwright with --real-robot, as in \
                 planwright run --real-robot my.plan, where a robot's actions can be reached over ROS 2.",
            ));
        };
        if self.world.noise().is_some() {
            return Err(Raise::simple(
                "A robot that errs in simulation (--noise) drives no real one: leave the errors out.",
            ));
        }
        robot.depth.set(robot.depth.get() + 1);
        Ok(())
    }

    /// The end of [`Self::drive_robot`].
    pub(crate) fn leave_robot(&self) {
        if let Some(robot) = &self.robot {
            robot.depth.set(robot.depth.get().saturating_sub(1));
        }
    }

    /// No plan drives the robot any more, whatever was begun.
    pub(crate) fn give_robot_up(&self) {
        if let Some(robot) = &self.robot {
            robot.depth.set(0);
        }
    }

    /// The motion as one of the robot elsewhere, if plans drive one now.
    pub(crate) fn of_real_robot(&self, motion: Box<dyn Motion>) -> Box<dyn Motion> {
        let robot = self.robot.as_ref().filter(|robot| robot.is_driven());
        match robot {
            Some(robot) if motion.module() != ProcessModule::Clock => {
                let query = self.sought.clone();
                let query = query.filter(|_| motion.module() == ProcessModule::Perception);
                Box::new(RealMotion::new(motion, query, Rc::clone(robot)))
            }
            _ => motion,
        }
    }

    /// Lets the robot elsewhere stop whatever it does, since nobody looks after it for now.
    pub(crate) fn stop_robot(&mut self) {
        if self.robot.is_some() {
            self.jobs.stop_elsewhere(&mut self.world);
        }
    }
}

/// What a motion of perception looks for.
type Query = Option<DetectQuery>;
