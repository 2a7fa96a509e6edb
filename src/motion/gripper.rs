//! Opening, closing and positioning the fingers.

use super::failure::MotionFailure;
use super::grip::Grip;
use super::hand::{gripper_of, hand_may_touch_objects, pressing};
use super::job::{
    Activity, Job, MotionOutcome, MotionStatus, ProcessModule, Progress, check_finite,
};
use super::joint_follower::JointFollower;
use super::joint_limit::violation;
use super::joint_motion::{Arrival, JointGoal, JointMotion};
use super::speeds;
use super::trajectory::{Corners, Trajectory};
use crate::robot::{LinkId, Side};
use crate::world::{CollisionHit, World};

/// A goal farther outside the limits than this (rad) is a failure.
const CROPPED: f64 = 1e-4;

/// What to do with the fingers of a hand.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum GripperCommand {
    /// Open as far as possible.
    Open,
    /// Close completely, or until something between them stops them.
    Close,
    /// To an opening (m).
    Position(f64),
    /// Close until both fingers press on one object: the named one, or any.
    Grip {
        /// Name of the object, if another one would be wrong.
        object: Option<String>,
    },
}

/// Moves the fingers of one hand.
pub(crate) type MoveGripper = Job<Fingers>;

/// What the fingers of a hand are doing.
#[derive(Clone, Debug)]
#[allow(clippy::large_enum_variant, reason = "there are two of them at a time")]
pub(crate) enum Fingers {
    /// They move to an opening.
    Move(JointMotion<FingerGoal>),
    /// They close around an object.
    Grip(Grip),
}

/// The opening that the fingers of a hand are to reach.
#[derive(Clone, Debug)]
pub(crate) struct FingerGoal {
    side: Side,
    command: GripperCommand,
}

impl MoveGripper {
    /// Carries out the command with one hand.
    pub(crate) fn new(side: Side, command: GripperCommand) -> Self {
        Self::begin(match command {
            GripperCommand::Grip { object } => Fingers::Grip(Grip::new(side, object)),
            command => Fingers::Move(JointMotion::to(FingerGoal { side, command })),
        })
    }
}

impl Activity for Fingers {
    const MODULE: ProcessModule = ProcessModule::Grippers;

    fn step(&mut self, world: &mut World) -> Option<MotionStatus> {
        match self {
            Self::Move(fingers) => fingers.step(world),
            Self::Grip(grip) => grip.step(world),
        }
    }

    fn progress(&self) -> Progress {
        match self {
            Self::Move(fingers) => fingers.progress(),
            Self::Grip(_) => Progress {
                what: "gripping",
                fraction: 0.0,
            },
        }
    }
}

impl FingerGoal {
    /// Desired position of the finger joint (rad).
    fn position(&self, world: &World) -> f64 {
        let gripper = gripper_of(world, self.side);
        match self.command {
            GripperCommand::Open => gripper.limits.upper,
            GripperCommand::Close | GripperCommand::Grip { .. } => gripper.limits.lower,
            GripperCommand::Position(opening) => opening * gripper.joint_per_metre,
        }
    }

    fn is_closing(&self, world: &World) -> bool {
        let joint = gripper_of(world, self.side).joint;
        world.robot_configuration().joints.get(joint) > self.position(world)
    }
}

impl JointGoal for FingerGoal {
    const MODULE: ProcessModule = ProcessModule::Grippers;
    /// Longer than the arms wait before they look for another path: often the fingers would
    /// touch the robot's own forearm.
    const BLOCKED_TIMEOUT: f64 = 1.0;

    fn what(&self) -> &'static str {
        match self.command {
            GripperCommand::Open => "opening the gripper",
            GripperCommand::Close | GripperCommand::Grip { .. } => "closing the gripper",
            GripperCommand::Position(_) => "moving the gripper",
        }
    }

    fn plan(&mut self, world: &World, _: u32) -> Result<JointFollower, MotionFailure> {
        let goal = self.position(world);
        check_finite(Self::MODULE, &[goal])?;
        let gripper = gripper_of(world, self.side);
        let joints = vec![gripper.joint];
        let path = [
            vec![world.robot_configuration().joints.get(gripper.joint)],
            vec![gripper.limits.clamp(goal)],
        ];
        let limits = speeds::limits_of(&world.models().description, &joints);
        let trajectory = Trajectory::new(&path, &limits, Corners::Round);
        let allowed = hand_may_touch_objects(world, self.side);
        Ok(JointFollower::new(joints, trajectory, allowed))
    }

    fn carriers(&self, _: &World) -> Vec<LinkId> {
        Vec::new()
    }

    /// Closing fingers have arrived when something is between them.
    fn met(&self, world: &World, _: f64) -> Option<MotionOutcome> {
        let is_held = || pressing(world, self.side).iter().any(Option::is_some);
        (self.is_closing(world) && is_held()).then_some(MotionOutcome::Arrived)
    }

    fn arrived(&mut self, world: &mut World) -> Arrival {
        let (gripper, goal) = (gripper_of(world, self.side), self.position(world));
        if gripper.limits.excess(goal) <= CROPPED {
            return Arrival::Done(MotionOutcome::Arrived);
        }
        let joint = world.models().robot.joint(gripper.joint);
        Arrival::Failed(MotionFailure::GripperLimit {
            side: self.side,
            goal: goal / gripper.joint_per_metre,
            violation: violation(joint, gripper.limits, goal),
        })
    }

    fn blocked(&self, _: &World, hit: CollisionHit) -> MotionFailure {
        MotionFailure::FingersBlocked {
            side: self.side,
            hit: hit.into(),
        }
    }
}
