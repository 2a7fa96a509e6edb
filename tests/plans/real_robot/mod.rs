//! Plans on a robot elsewhere, which is scripted: without a network, on a clock of its own.
//!
//! Whatever such a robot says or does not say, a motion ends: in success if the robot is where it was to be, or else in the
//! failure that CRAM has for that, with words that name what has happened.

mod at_once;
mod grips;
mod lies;
mod obedience;
mod scripted_robot;
mod sight;
mod untruths;

use std::collections::BTreeMap;

use robotics::robot::{RobotPart, Side};
use session::SessionOptions;
use spatial::Pose;

use super::cook::Cook;
use scripted_robot::{Conduct, Robot, ScriptedRobot, Untruth};

const LEFT_ARM: RobotPart = RobotPart::Arm(Side::Left);
const LEFT_GRIPPER: RobotPart = RobotPart::Gripper(Side::Left);

const DRIVE: &str = "(let ((?pose (make-pose \"map\" '((-0.3 0.4 0) (0 0 0 1)))))
  (perform (a motion (type going) (target (a location (pose ?pose))))))";
const LIFT: &str = "(perform (a motion (type moving-torso) (joint-angle 0.1)))";
const LOOK: &str = "(let ((?pose (make-pose \"map\" '((2 0 1) (0 0 0 1)))))
  (perform (a motion (type looking) (target (a location (pose ?pose))))))";
const REACH: &str = "(perform (a motion (type moving-arm-joints) (left-configuration (1.9 0.2 1.4 -1.8 1.3 -0.6 0.4))))";
const OPEN: &str =
    "(perform (a motion (type moving-gripper-joint) (gripper left) (joint-angle 0.05)))";
const DETECT: &str = "(perform (a motion (type detecting) (object (an object (type bottle)))))";

/// A session whose plans drive a scripted robot.
struct Driver {
    cook: Cook,
    robot: ScriptedRobot,
}

impl Driver {
    /// A robot that stands where the session believes it.
    fn new() -> Self {
        Self::with(&SessionOptions::default())
    }

    fn with(options: &SessionOptions) -> Self {
        // As fast as it goes, since the robot's clock is its own.
        let options = SessionOptions {
            realtime: Some(1e6),
            ..options.clone()
        };
        let mut cook = Cook::with(&options);
        let robot = Robot::new(cook.session.models(), Pose::identity(), BTreeMap::new());
        let robot = ScriptedRobot::new(robot);
        cook.session.drive(Box::new(robot.clone()));
        let driver = Self { cook, robot };
        driver.follow_simulation();
        driver
    }

    /// The robot is put where the session has its own.
    fn follow_simulation(&self) {
        let world = self.cook.session.simulation().world();
        let configuration = world.robot_configuration();
        let joints = world.models().robot.joints();
        let joints = joints.map(|(id, joint)| (joint.name.clone(), configuration.joints.get(id)));
        let mut robot = self.robot.change();
        robot.joints = joints.collect();
        robot.base = configuration.base;
    }

    fn set(&self, part: RobotPart, conduct: Conduct) {
        self.robot.change().set(part, conduct);
    }

    /// From when on (s) in a motion the robot tells of itself what is not so.
    fn lies_after(&self, seconds: f64, untruth: Untruth) {
        self.robot.change().untruth = Some((seconds, untruth));
    }

    /// What has to work on the robot.
    fn done(&mut self, text: &str) -> String {
        self.cook.done(&format!("(with-real-robot {text})"))
    }

    /// What has to fail on the robot with that class, and these words.
    fn fails(&mut self, class: &str, words: &[&str], text: &str) {
        let (report, condition) = match self.cook.say(&format!("(with-real-robot {text})")) {
            Err(failure) => failure,
            Ok(said) => panic!("{text} did not fail: {said}"),
        };
        let told = format!("{condition}: {report}");
        let is_of_class = condition.starts_with(&format!("#<{} ", class.to_uppercase()));
        assert!(is_of_class, "{class} was expected, not {told}");
        for word in words {
            assert!(told.contains(word), "{word:?} is not in {told:?}");
        }
    }

    /// Nothing of the robot moves, nor will.
    fn assert_rest(&self) {
        let robot = self.robot.get();
        assert!(!robot.moves(), "it moves on: {:?}", robot.told);
        assert!(robot.shouts.is_empty(), "{:?}", robot.shouts);
    }

    /// Where the robot is believed to be.
    fn believed_base(&self) -> Pose {
        let world = self.cook.session.simulation().world();
        world.robot_configuration().base
    }

    /// Where a joint is believed to be.
    fn believed(&self, joint: &str) -> f64 {
        let world = self.cook.session.simulation().world();
        let mut joints = world.models().robot.joints();
        let (id, _) = joints.find(|(_, known)| known.name == joint).unwrap();
        world.robot_configuration().joints.get(id)
    }
}
