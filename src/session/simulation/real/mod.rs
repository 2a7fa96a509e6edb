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
    /// The motions that it carries out.
    under_way: RefCell<Vec<UnderWay>>,
    /// Whether a motion that is to be tried wants copies of those under way.
    wants_copies: Cell<bool>,
    /// Whether each motion is tried before anything is sent, also where the robot itself finds the way.
    is_tried: Cell<bool>,
    /// Hands that have closed farther than what they were to grip is wide, and the gap (m) at which they were to meet it. Until
    /// they open, the world here has fingers in what they missed.
    missed: RefCell<Vec<(Side, f64)>>,
    /// Whether it has told how it is at least once.
    was_heard: Cell<bool>,
}

/// A motion that a robot carries out.
struct UnderWay {
    module: ProcessModule,
    parts: Vec<RobotPart>,
    /// A copy, from the present step, of the same motion in the world here, if one was wanted; there is none in it once the
    /// motion has ended.
    copy: Option<Option<Box<dyn Motion>>>,
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
            under_way: RefCell::default(),
            wants_copies: Cell::new(false),
            is_tried: Cell::new(true),
            missed: RefCell::default(),
            was_heard: Cell::new(false),
        })
    }

    /// Whether a part has a goal.
    fn is_busy(&self, part: RobotPart) -> bool {
        let under_way = self.under_way.borrow();
        under_way.iter().any(|other| other.parts.contains(&part))
    }

    /// Whether a motion has to wait for those that are under way. What the upper body may do depends on all of it: on the
    /// height of the arms, and on how far the fingers stand out. A camera sees nothing reliable on the way.
    fn must_wait(&self, module: ProcessModule) -> bool {
        use ProcessModule as P;
        let upper = [P::Arms, P::Torso, P::Grippers];
        let under_way = self.under_way.borrow();
        under_way.iter().any(|other| {
            module == P::Perception
                || other.module == module
                || (upper.contains(&module) && upper.contains(&other.module))
        })
    }

    /// Whether nothing is under way.
    fn is_idle(&self) -> bool {
        self.under_way.borrow().is_empty()
    }

    /// Copies of what goes on in the world here; `None` until they have been made.
    fn companions(&self) -> Option<Vec<Box<dyn Motion>>> {
        let mut under_way = self.under_way.borrow_mut();
        if under_way.iter().any(|other| other.copy.is_none()) {
            self.wants_copies.set(true);
            return None;
        }
        self.wants_copies.set(false);
        let copies = under_way.iter_mut().map(|other| other.copy.take());
        Some(copies.flatten().flatten().collect())
    }

    /// Leaves a copy of what a motion does in the world here, if one is wanted.
    fn leave_copy(&self, parts: &[RobotPart], here: Option<&dyn Motion>) {
        if !self.wants_copies.get() {
            return;
        }
        let mut under_way = self.under_way.borrow_mut();
        for other in under_way.iter_mut().filter(|other| other.parts == parts) {
            other.copy = Some(here.and_then(Motion::copied));
        }
    }

    /// Parts of the robot are free again.
    fn free(&self, parts: &[RobotPart]) {
        let mut under_way = self.under_way.borrow_mut();
        under_way.retain(|other| !other.parts.iter().any(|part| parts.contains(part)));
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

    /// Whether each motion is tried before anything is sent, also where the robot itself finds the way. Returns how it was.
    pub(crate) fn set_prospection(&self, is_tried: bool) -> bool {
        let robot = self.robot.as_ref();
        robot.is_none_or(|robot| robot.is_tried.replace(is_tried))
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
