//! Opening, closing and positioning the fingers.

use super::grip::Grip;
use super::job::{Activity, Job, MotionOutcome, MotionStatus, Progress, check_finite};
use super::joint_motion::{Arrival, JointGoal, JointMotion};
use crate::motion::contact::hand::{gripper_of, hand_may_touch, hand_may_touch_objects, pressing};
use crate::motion::contact::holding::{held_objects, press};
use crate::motion::failure::joint_limit::violation;
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::failure::process_module::ProcessModule;
use crate::motion::planning::joint_plan::JointPlan;
use crate::motion::trajectories::speeds;
use crate::motion::trajectories::trajectory::Trajectory;
use crate::robot::{LinkId, Side};
use crate::world::{BodyName, CollisionHit, World};

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
        /// The force (N) of each finger; as much as possible if none is given.
        effort: Option<f64>,
        /// Whether both hands are to hold it.
        together: bool,
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
    /// Whether the fingers close, which is known once the motion is planned.
    is_closing: bool,
}

impl MoveGripper {
    /// Carries out the command with one hand.
    pub fn new(side: Side, command: GripperCommand) -> Self {
        Self::begin(match command {
            GripperCommand::Grip {
                object,
                effort,
                together,
            } => Fingers::Grip(Grip::new(side, object, effort, together)),
            command => Fingers::Move(JointMotion::to(FingerGoal {
                side,
                command,
                is_closing: false,
            })),
        })
    }
}

impl Activity for Fingers {
    const MODULE: ProcessModule = ProcessModule::Grippers;

    fn step(&mut self, world: &mut World) -> Option<MotionStatus> {
        match self {
            Self::Move(fingers) => {
                let end = fingers.step(world);
                if matches!(end, Some(MotionStatus::Done(_)))
                    && let Err(failure) = fingers.goal().hold(world)
                {
                    return Some(MotionStatus::failed(failure));
                }
                end
            }
            Self::Grip(grip) => grip.step(world),
        }
    }

    fn grip_effort(&self) -> Option<f64> {
        match self {
            Self::Move(_) => None,
            Self::Grip(grip) => grip.effort(),
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
            GripperCommand::Position(opening) => gripper.wanted_for_opening(opening),
        }
    }

    /// What both fingers press on, if they press.
    fn between(&self, world: &World) -> Option<[BodyName; 2]> {
        let [left, right] = pressing(world, self.side);
        Some([left?.body, right?.body])
    }
}

impl FingerGoal {
    /// Fingers that have closed on an object hold it, whatever they were to do.
    fn hold(&self, world: &mut World) -> Result<(), MotionFailure> {
        let side = self.side;
        if !self.is_closing || !held_objects(world, side).is_empty() {
            return Ok(());
        }
        match self.between(world) {
            Some([left, right]) if left == right => {
                let effort = gripper_of(world, side).effort;
                press(world, side, left.object().unwrap_or_default(), effort)
            }
            _ => Ok(()),
        }
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

    fn plan(&mut self, world: &World, _: u32) -> Result<JointPlan, MotionFailure> {
        let goal = self.position(world);
        check_finite(Self::MODULE, &[goal])?;
        let gripper = gripper_of(world, self.side);
        let joints = vec![gripper.joint];
        let path = [
            vec![world.robot_configuration().joints.get(gripper.joint)],
            vec![gripper.limits.clamp(goal)],
        ];
        let limits = speeds::limits_of(&world.models().description, &joints);
        let trajectory = Trajectory::new(&path, &limits);
        self.is_closing = path[0] > path[1];
        // Closing fingers may meet what is between them. Opening ones push nothing away; what they let go
        // of may lean on one of them until it stands.
        let allowed = if self.is_closing {
            hand_may_touch_objects(world, self.side)
        } else {
            hand_may_touch(world, self.side, held_objects(world, self.side))
        };
        Ok(JointPlan::new(joints, trajectory, allowed))
    }

    fn carriers(&self, _: &World) -> Vec<LinkId> {
        Vec::new()
    }

    /// What moves beside opening fingers leaves them the room.
    fn follows(&self, world: &mut World) {
        if !self.is_closing {
            let gripper = gripper_of(world, self.side);
            let (joint, to) = (gripper.joint, gripper.limits.clamp(self.position(world)));
            world.fingers_are_opening(joint, to);
        }
    }

    /// Closing fingers have arrived when something is between them.
    fn met(&self, world: &World, _: f64) -> Option<MotionOutcome> {
        let holds = || !held_objects(world, self.side).is_empty();
        let meets = self.is_closing && (holds() || self.between(world).is_some());
        meets.then_some(MotionOutcome::Arrived)
    }

    fn arrived(&mut self, world: &mut World) -> Arrival {
        let (gripper, goal) = (gripper_of(world, self.side), self.position(world));
        if gripper.limits.excess(goal) <= CROPPED {
            return Arrival::Done(MotionOutcome::Arrived);
        }
        let joint = world.models().robot.joint(gripper.joint);
        Arrival::Failed(MotionFailure::GripperLimit {
            side: self.side,
            goal: gripper.opening_at(goal),
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
