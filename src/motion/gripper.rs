//! Opening, closing and positioning the fingers, gripping, and the hold on an object.

use super::failure::MotionFailure;
use super::guard;
use super::job::{Motion, MotionOutcome, MotionStatus, ProcessModule, Progress, check_finite};
use super::joint_follower::{FollowStep, JointFollower, with_joints};
use super::joint_limit::violation;
use super::speeds;
use super::trajectory::{Corners, Trajectory};
use crate::robot::Side;
use crate::robot::description::Gripper;
use crate::world::physics::STEP_SECONDS;
use crate::world::{AllowedPairs, BodyName, ContactForce, World};

/// A goal farther outside of the limits than this (rad) is a failure.
const CROPPED: f64 = 1e-4;
/// How long (s) the way may be blocked while nothing moves. Longer than the arms wait before
/// they look for another way: often it is the own forearm that fingers would touch.
const BLOCKED_TIMEOUT: f64 = 1.0;
/// Force (N) from which on a finger counts as pressing.
pub(crate) const GRIP_FORCE: f64 = 2.0;
/// How long (s) fingers may press on different things before that counts as a failure.
const UNEQUAL: f64 = 0.25;

/// What to do with the fingers of a hand.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum GripperCommand {
    /// Open as far as possible.
    Open,
    /// Close completely, or as far as what is in between lets them.
    Close,
    /// To an opening (m).
    Position(f64),
    /// Close until both fingers press on one object: the named one, or any.
    Grip {
        /// Name of the object, when another one would be wrong.
        object: Option<String>,
    },
}

/// Moves the fingers of one hand.
#[derive(Clone, Debug)]
pub(crate) struct MoveGripper {
    side: Side,
    command: GripperCommand,
    follow: Option<JointFollower>,
    unequal: f64,
    ended: bool,
}

/// Any object may be touched by any link of the hand.
pub(super) fn hand_may_touch_objects(world: &World, side: Side) -> AllowedPairs {
    let names = hand_names(world, side);
    world.objects().fold(AllowedPairs::none(), |all, object| {
        all.and_all(names.clone(), &BodyName::Object(object.name().to_owned()))
    })
}

/// The links of a hand as bodies.
pub(super) fn hand_names(world: &World, side: Side) -> Vec<BodyName> {
    let models = world.models();
    let links = models.description.arm(side).gripper.links();
    links.map(|link| models.robot_body(link)).collect()
}

impl MoveGripper {
    /// Carries out the command with one hand.
    pub(crate) fn new(side: Side, command: GripperCommand) -> Self {
        Self {
            side,
            command,
            follow: None,
            unequal: 0.0,
            ended: false,
        }
    }

    fn gripper<'w>(&self, world: &'w World) -> &'w Gripper {
        &world.models().description.arm(self.side).gripper
    }

    /// Position of the finger joint (rad) that is wanted.
    fn goal(&self, world: &World) -> f64 {
        let gripper = self.gripper(world);
        match self.command {
            GripperCommand::Open => gripper.limits.upper,
            GripperCommand::Close | GripperCommand::Grip { .. } => gripper.limits.lower,
            GripperCommand::Position(opening) => opening * gripper.joint_per_metre,
        }
    }

    fn is_closing(&self, world: &World) -> bool {
        world
            .robot_configuration()
            .joints
            .get(self.gripper(world).joint)
            > self.goal(world)
    }

    fn start(&self, world: &World) -> JointFollower {
        let gripper = self.gripper(world);
        let joints = vec![gripper.joint];
        let from = vec![world.robot_configuration().joints.get(gripper.joint)];
        let to = vec![gripper.limits.clamp(self.goal(world))];
        let limits = speeds::limits_of(&world.models().description, &joints);
        let trajectory = Trajectory::new(&[from, to], &limits, Corners::Round);
        JointFollower::new(joints, trajectory, hand_may_touch_objects(world, self.side))
    }

    /// Moves the fingers to a position; closing ones stop when something is between them.
    fn position(&mut self, world: &mut World) -> Option<MotionStatus> {
        if self.is_closing(world) && self.pressing(world).iter().any(Option::is_some) {
            return Some(MotionStatus::Done(MotionOutcome::Arrived));
        }
        let mut follow = self.follow.take().unwrap_or_else(|| self.start(world));
        let step = follow.tick(world, |_| false);
        self.follow = Some(follow);
        match step {
            FollowStep::Moving | FollowStep::Stuck(_) => None,
            FollowStep::Blocked { still, .. } if still < BLOCKED_TIMEOUT => None,
            FollowStep::Blocked { hit, .. } => {
                let side = self.side;
                Some(MotionStatus::failed(MotionFailure::FingersBlocked {
                    side,
                    hit: hit.into(),
                }))
            }
            FollowStep::Arrived => Some(self.arrived(world)),
        }
    }

    fn arrived(&self, world: &World) -> MotionStatus {
        let (gripper, goal) = (self.gripper(world), self.goal(world));
        if gripper.limits.excess(goal) <= CROPPED {
            return MotionStatus::Done(MotionOutcome::Arrived);
        }
        let joint = world.models().robot.joint(gripper.joint);
        MotionStatus::failed(MotionFailure::GripperLimit {
            side: self.side,
            goal: goal / gripper.joint_per_metre,
            violation: violation(joint, gripper.limits, goal),
        })
    }

    /// What each finger presses on.
    fn pressing(&self, world: &World) -> [Option<ContactForce>; 2] {
        let contacts = world.finger_contacts(self.side);
        contacts.map(|forces| {
            let objects = forces.into_iter().filter(|f| f.body.object().is_some());
            objects
                .filter(|f| f.force > GRIP_FORCE)
                .max_by(|a, b| a.force.total_cmp(&b.force))
        })
    }

    /// Closes both fingers, which one joint moves; ends when both press on one object.
    fn grip(&mut self, world: &mut World) -> Option<MotionStatus> {
        let GripperCommand::Grip { object: wanted } = &self.command else {
            return None;
        };
        let side = self.side;
        let pressing = self.pressing(world);
        if let [Some(left), Some(right)] = &pressing {
            if left.body == right.body {
                let held = left.body.object().unwrap_or_default().to_owned();
                let right_one = wanted.as_ref().is_none_or(|w| *w == held);
                return Some(match (right_one, wanted) {
                    (false, Some(wanted)) => MotionStatus::failed(MotionFailure::WrongObject {
                        side,
                        wanted: wanted.clone(),
                        held: left.body.clone(),
                    }),
                    _ => MotionStatus::Done(MotionOutcome::Gripped { object: held }),
                });
            }
            self.unequal += STEP_SECONDS;
            if self.unequal > UNEQUAL {
                return Some(MotionStatus::failed(MotionFailure::WrongObject {
                    side,
                    wanted: wanted.clone().unwrap_or_else(|| "one object".to_owned()),
                    held: left.body.clone(),
                }));
            }
        }
        let gripper = self.gripper(world);
        let now = world.robot_configuration();
        let position = now.joints.get(gripper.joint);
        if position <= gripper.limits.lower {
            return Some(MotionStatus::failed(MotionFailure::NothingGripped { side }));
        }
        let closer = position - speeds::GRIP_VELOCITY * STEP_SECONDS;
        let next = with_joints(now, &[gripper.joint], &[closer.max(gripper.limits.lower)]);
        let allowed = hand_may_touch_objects(world, side);
        if let Some(hit) = guard::obstacle(world, &next, &allowed) {
            return Some(MotionStatus::failed(MotionFailure::FingersBlocked {
                side,
                hit: hit.into(),
            }));
        }
        world.set_robot_configuration(&next);
        None
    }
}

impl Motion for MoveGripper {
    fn module(&self) -> ProcessModule {
        ProcessModule::Grippers
    }

    fn tick(&mut self, world: &mut World) -> MotionStatus {
        if self.ended {
            return MotionStatus::Done(MotionOutcome::Arrived);
        }
        if let Err(failure) = check_finite(ProcessModule::Grippers, &[self.goal(world)]) {
            self.ended = true;
            return MotionStatus::failed(failure);
        }
        let end = match self.command {
            GripperCommand::Grip { .. } => self.grip(world),
            _ => self.position(world),
        };
        match end {
            None => MotionStatus::Running,
            Some(end) => {
                self.ended = true;
                end
            }
        }
    }

    fn cancel(&mut self) {
        self.ended = true;
    }

    fn progress(&self) -> Progress {
        let what = match self.command {
            GripperCommand::Open => "opening the gripper",
            GripperCommand::Close => "closing the gripper",
            GripperCommand::Position(_) => "moving the gripper",
            GripperCommand::Grip { .. } => "gripping",
        };
        Progress {
            what,
            fraction: self.follow.as_ref().map_or(0.0, JointFollower::fraction),
        }
    }
}
