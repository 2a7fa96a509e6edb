//! Why a motion did not reach its goal.
//!
//! A failure carries what is known: the pair of bodies that touch, the limit that is
//! violated and by how much, what was tried and what would work. The wording is in
//! `Display` alone: a first line as in CRAM, or a sentence that says what and why, and
//! where it can be computed, a second sentence that says what would work.

use serde::Serialize;
use thiserror::Error;

use super::base_place::BasePlace;
use super::broken_loop::BrokenLoop;
use super::no_grasp::NoGrasp;
use super::no_handle_grasp::NoHandleGrasp;
use super::overload::Overload;
use super::pinned_object::PinnedObject;
use super::process_module::ProcessModule;
use super::pushed_object::PushedObject;
use super::robot_trouble::RobotFailure;
use super::short_arm::ShortArm;
use super::stopped_part::StoppedPart;
use super::stuck_object::StuckObject;
use super::unreachable::{UnreachablePose, UnreachableReason};
use super::wording::{
    heights, list, nearest, next_below, onto, place, sights, stopped, touch, why_slipped,
};
use super::wrong_trajectory::WrongTrajectory;
use crate::perception::Visibility;
use crate::robot::{LimitViolation, Side};
use crate::world::{BodyName, CollisionHit, HandleSlip, MapArea, Slip, StandTrial, Tilt};
use spatial::Shortest;

/// Why a motion did not reach its goal.
#[derive(Clone, Debug, Error, PartialEq, Serialize)]
pub enum MotionFailure {
    /// The goal of the base is occupied.
    #[error("the robot cannot stand at {}: {}{}", place(.goal), touch(.hit), nearest(.nearest_free))]
    GoalOccupied {
        /// Goal of the base, in the map frame.
        goal: BasePlace,
        /// What would touch.
        hit: Box<CollisionHit>,
        /// The nearest pose with the same heading where the robot fits in its present posture.
        nearest_free: Option<BasePlace>,
    },
    /// The goal of the base is not on the map.
    #[error(
        "the robot cannot stand at {}: that is beyond the map, which covers {map}",
        place(.goal)
    )]
    GoalOffMap {
        /// Goal of the base, in the map frame.
        goal: BasePlace,
        /// The map.
        map: MapArea,
    },
    /// No path leads to the goal.
    #[error(
        "no path leads to {} for the robot in its present posture{}",
        place(.goal), list(", in the way: ", .blockers)
    )]
    Enclosed {
        /// Goal of the base, in the map frame.
        goal: BasePlace,
        /// The obstacles on the path with the fewest collisions.
        blockers: Vec<BodyName>,
    },
    /// The robot has no neck, and is to look at what its camera has not in its picture.
    #[error(
        "the robot cannot look there: its camera does not turn, and the point is not in its picture"
    )]
    NeckMissing,
    /// The robot has no drive, and is to go elsewhere.
    #[error("the robot cannot go to {}: its base does not drive", place(.goal))]
    BaseIsFixed {
        /// Goal of the base, in the map frame.
        goal: BasePlace,
    },
    /// The robot is in collision and cannot drive out of it.
    #[error("the robot cannot drive: {}", touch(.hit))]
    DriveStartOccupied {
        /// What touches.
        hit: Box<CollisionHit>,
    },
    /// The path was free and has become blocked.
    #[error("on the way to {} the robot was stopped: {}", place(.goal), touch(.hit))]
    DriveBlocked {
        /// Goal of the base, in the map frame.
        goal: BasePlace,
        /// What would touch.
        hit: Box<CollisionHit>,
    },
    /// The robot has pushed an object along while it drove.
    #[error("on the way to {} {} pushed {} by {:.0} mm", place(.goal), .pushed.by, .pushed.object, 1e3 * .pushed.distance)]
    DrivePushes {
        /// Goal of the base, in the map frame.
        goal: BasePlace,
        /// What was pushed.
        pushed: PushedObject,
    },
    /// The torso has reached its limit, short of the goal.
    #[error(
        "Torso goal {} was out of joint limits\nthe torso goes from {} to {} m",
        Shortest(*.goal),
        Shortest(*.lower),
        Shortest(*.upper)
    )]
    TorsoGoalOutOfLimits {
        /// Height that was wanted (m).
        goal: f64,
        /// Least height (m).
        lower: f64,
        /// Greatest height (m).
        upper: f64,
    },
    /// The torso was stopped.
    #[error("the torso was stopped at {height:.3} m on its way to {goal:.3} m: {}", touch(.hit))]
    TorsoBlocked {
        /// Height that was wanted (m).
        goal: f64,
        /// Height that was reached (m).
        height: f64,
        /// What would touch.
        hit: Box<CollisionHit>,
    },
    /// The neck has reached its limit, short of the goal.
    #[error("Look action wanted to twist the neck\n{violation}")]
    NeckLimit {
        /// The joint and its range.
        violation: LimitViolation,
    },
    /// The head was stopped.
    #[error("the head was stopped: {}", touch(.hit))]
    NeckBlocked {
        /// What would touch.
        hit: Box<CollisionHit>,
    },
    /// No object that matches the query is in sight.
    #[error("Could not find object {wanted}.{}", sights(.candidates, .wanted, .meant.as_deref(), *.may_err))]
    ObjectNotFound {
        /// What was looked for.
        wanted: String,
        /// How much of each matching object is in sight.
        candidates: Vec<Visibility>,
        /// The type with the most similar name, if there is no such type.
        meant: Option<String>,
        /// Whether the robot may overlook objects that are in sight.
        may_err: bool,
    },
    /// The fingers met without an object between them.
    #[error(
        "There was no object to grip\nthe fingers of the {side} hand met without an object between them"
    )]
    NothingGripped {
        /// The hand.
        side: Side,
    },
    /// The fingers hold another object.
    #[error("the {side} hand has {held} between its fingers, not {wanted}")]
    WrongObject {
        /// The hand.
        side: Side,
        /// The object that was to be gripped.
        wanted: String,
        /// What is between the fingers.
        held: BodyName,
    },
    /// The fingers cannot get to the position.
    #[error("the {side} gripper cannot open to {goal:.3} m: {violation}")]
    GripperLimit {
        /// The hand.
        side: Side,
        /// Opening that was wanted (m).
        goal: f64,
        /// The joint and its range.
        violation: LimitViolation,
    },
    /// The fingers were stopped.
    #[error("the fingers of the {side} hand were stopped: {}", touch(.hit))]
    FingersBlocked {
        /// The hand.
        side: Side,
        /// What would touch.
        hit: Box<CollisionHit>,
    },
    /// A finger pressed an object onto what carries it, instead of closing on it.
    #[error(
        "a finger of the {side} hand pressed {} onto {} with {:.0} N, and it did not give way",
        .pinned.object, .pinned.against, .pinned.force
    )]
    FingerPins {
        /// The hand.
        side: Side,
        /// What was pressed.
        pinned: PinnedObject,
    },
    /// A joint goal is outside the joint's range.
    #[error("{violation}")]
    JointLimit {
        /// The joint and its range.
        violation: LimitViolation,
    },
    /// A list of joint positions has the wrong length.
    #[error(
        "length of joints list is incorrect: the {side} arm has {expected} joints, not {given}"
    )]
    JointCount {
        /// The arm.
        side: Side,
        /// Number of positions that were given.
        given: usize,
        /// Number of joints of the arm.
        expected: usize,
    },
    /// A trajectory that somebody else has planned cannot be followed.
    #[error("{0}")]
    WrongTrajectory(Box<WrongTrajectory>),
    /// No posture of the arm brings the hand to the pose.
    #[error("{0}")]
    PoseUnreachable(Box<UnreachablePose>),
    /// No grasp of the object works.
    #[error("{0}")]
    NoGrasp(Box<NoGrasp>),
    /// The goals of both hands need different heights of the torso.
    #[error(
        "In MOVE-TCP goals for the two arms require different torso angles).\n\
         the left one is reachable at {}, the right one at {}", heights(.left), heights(.right)
    )]
    TorsoConflict {
        /// Torso heights (m) that suit the left hand: least and greatest.
        left: Option<[f64; 2]>,
        /// Torso heights (m) that suit the right hand: least and greatest.
        right: Option<[f64; 2]>,
    },
    /// The arms would touch something at the goal.
    #[error("the arms cannot go there: {}", touch(.hit))]
    ArmGoalInCollision {
        /// What would touch.
        hit: Box<CollisionHit>,
    },
    /// The arms touch something and may not move.
    #[error("the arms cannot move: {}", touch(.hit))]
    ArmStartInCollision {
        /// What touches.
        hit: Box<CollisionHit>,
    },
    /// No path for the arms was found.
    #[error("no path for the arms was found in {samples} attempts: {}", touch(.hit))]
    ArmPathNotFound {
        /// What would touch on the straight path.
        hit: Box<CollisionHit>,
        /// Number of random configurations tried.
        samples: usize,
    },
    /// No path for the arms was found on which what a hand holds stays upright.
    #[error(
        "no path for the arms was found in {samples} attempts on which {} stays upright in the {} hand: \
         straight there it would tilt by {:.0} degrees, and what is in it or on it would leave it",
        .tilt.object, .tilt.side, .tilt.angle.to_degrees()
    )]
    NoLevelPath {
        /// How much it would tilt at first on the straight path.
        tilt: Box<Tilt>,
        /// Number of random configurations tried.
        samples: usize,
    },
    /// There is no posture for carrying in which what a hand holds is upright.
    #[error(
        "held like that by the {side} hand, {object} cannot be carried upright: what is in it or on it would leave it"
    )]
    NotCarriedUpright {
        /// The hand.
        side: Side,
        /// What it holds.
        object: String,
    },
    /// The arms were stopped.
    #[error("the arms were stopped: {}", touch(.hit))]
    ArmBlocked {
        /// What would touch.
        hit: Box<CollisionHit>,
    },
    /// A hand missed its goal because something else moved the robot meanwhile.
    #[error(
        "the {side} hand ended {:.1} mm and {:.1} degrees away from its goal, because the \
         torso or the base moved at the same time", .distance * 1e3, .angle.to_degrees()
    )]
    HandGoalMissed {
        /// The hand.
        side: Side,
        /// Distance (m) from the goal.
        distance: f64,
        /// Angle (rad) from the goal.
        angle: f64,
    },
    /// A held object does not follow the hand.
    #[error(
        "stopped because {} is stuck{}: it is {:.1} mm behind the hand and pressed with {:.0} N",
        .0.object, list(" against ", &.0.against), .0.lag * 1e3, .0.force
    )]
    HeldObjectStuck(Box<StuckObject>),
    /// The robot has pressed an object that it does not hold onto what carries it.
    #[error("the robot pressed {} onto {} with {:.0} N", .0.object, .0.against, .0.force)]
    ObjectPinned(Box<PinnedObject>),
    /// A part of the robot has pushed an object along that it was not to touch.
    #[error("{} pushed {} by {:.0} mm", .0.by, .0.object, 1e3 * .0.distance)]
    ObjectPushed(Box<PushedObject>),
    /// A held object has slipped out of the hand.
    #[error(
        "{} has slipped out of the {} hand: the two were torn apart with {:.1} N, and the fingers \
         hold up to {:.1} N", .0.object, .0.side, .0.force, .0.strength
    )]
    HeldObjectSlipped(Box<Slip>),
    /// A held object is more than the arm can carry.
    #[error("{0}")]
    TooHeavy(Box<Overload>),
    /// An object is not held by the hand that was said to hold it.
    #[error(
        "{object} is not between the fingers of the {side} hand, which press on it with {:.1} and \
         {:.1} N: grip it first", .forces[0], .forces[1]
    )]
    NotBetweenFingers {
        /// The hand.
        side: Side,
        /// The object.
        object: String,
        /// The force (N) of each finger on it.
        forces: [f64; 2],
    },
    /// The fingers cannot press like that.
    #[error(
        "the {side} gripper cannot press with {effort} N: its fingers press with more than 0 and \
         up to {greatest} N"
    )]
    GripEffort {
        /// The hand.
        side: Side,
        /// The force that was wanted (N).
        effort: f64,
        /// The greatest force (N).
        greatest: f64,
    },
    /// Nothing would carry an object where it is to be put down.
    #[error(
        "nothing carries {object} at ({:.3} {:.3} {:.3}) or within {:.0} cm below it: {}",
        .place[0], .place[1], .place[2], .depth * 100.0, next_below(.below)
    )]
    NothingBelow {
        /// Name of the object, which stays in the hand.
        object: String,
        /// Where it was to be (m), in the map frame.
        place: [f64; 3],
        /// How far below (m) a support would do.
        depth: f64,
        /// What is below at all, and how far (m) the object would fall.
        below: Option<(f64, BodyName)>,
    },
    /// An object would not stay where it is to be put down.
    #[error(
        "{object} would not stand at ({:.3} {:.3} {:.3}): let go there, it would move by {:.1} cm \
         and tip by {:.0} degrees, {}",
        .place[0], .place[1], .place[2], .trial.moved * 100.0, .trial.tilt.to_degrees(),
        onto(.trial.support.as_ref())
    )]
    WouldNotStand {
        /// Name of the object, which stays in the hand.
        object: String,
        /// Where it was to be (m), in the map frame.
        place: [f64; 3],
        /// What would happen.
        trial: Box<StandTrial>,
    },
    /// The arm cannot move a held object straight to where it is to be put down.
    #[error(
        "the {side} arm cannot put {object} down there: no way leads straight to that place, \
         neither from where the hand is nor from above"
    )]
    NoWayDown {
        /// The arm.
        side: Side,
        /// Name of the object, which stays in the hand.
        object: String,
    },
    /// The hand holds nothing.
    #[error("the {side} hand holds nothing")]
    HoldsNothing {
        /// The hand.
        side: Side,
    },
    /// The hand holds no handle.
    #[error("the {side} hand holds no handle of a drawer or door: grip one first")]
    HoldsNoHandle {
        /// The hand.
        side: Side,
    },
    /// A handle has slipped out of the hand.
    #[error(
        "Handle slipped\nthe {} hand has lost {}: {} is at {:.3}{}",
        .0.side, .0.handle, .0.joint, .0.position, why_slipped(.0)
    )]
    HandleSlipped(Box<HandleSlip>),
    /// The motion would part two hands from what they hold together.
    #[error("{0}")]
    LoopBroken(Box<BrokenLoop>),
    /// A drawer or door was stopped, or would be.
    #[error("{}", stopped(.0))]
    PartStopped(Box<StoppedPart>),
    /// The arm cannot move a drawer or door as far as wanted.
    #[error(
        "the {} arm is too short to bring {} from {:.3} to {:.3} from where the robot stands: it gets \
         to {:.3}", .0.side, .0.joint, .0.position, .0.wanted, .0.reach
    )]
    ArmTooShort(Box<ShortArm>),
    /// No hand can open or close a drawer or door.
    #[error("{0}")]
    NoHandleGrasp(Box<NoHandleGrasp>),
    /// A part of the robot has stopped on its way, though nothing is in it.
    #[error("the {module} stopped on the way to the goal: the motors stalled")]
    Stalled {
        /// The part of the robot.
        module: ProcessModule,
    },
    /// A goal has a coordinate that is infinite or NaN.
    #[error("the goal for the {module} is not a finite number")]
    NotFinite {
        /// The part of the robot that the goal is for.
        module: ProcessModule,
    },
    /// The world has no such object or frame.
    #[error("{0}")]
    UnknownName(String),
    /// A robot that is driven from outside has not done it, or not so.
    #[error("{0}")]
    Robot(Box<RobotFailure>),
}

impl MotionFailure {
    /// Whether the cause may go away while other jobs move the robot.
    pub(crate) fn may_pass(&self) -> bool {
        match self {
            Self::GoalOccupied { .. }
            | Self::Enclosed { .. }
            | Self::DriveStartOccupied { .. }
            | Self::TorsoBlocked { .. }
            | Self::ArmGoalInCollision { .. }
            | Self::ArmStartInCollision { .. }
            | Self::ArmPathNotFound { .. }
            | Self::NoLevelPath { .. } => true,
            Self::PoseUnreachable(pose) => {
                matches!(pose.reason, UnreachableReason::Collisions { .. })
            }
            _ => false,
        }
    }

    /// The two bodies that touch, or would, if that is the cause.
    pub fn hit(&self) -> Option<&CollisionHit> {
        match self {
            Self::GoalOccupied { hit, .. }
            | Self::DriveStartOccupied { hit }
            | Self::DriveBlocked { hit, .. }
            | Self::TorsoBlocked { hit, .. }
            | Self::NeckBlocked { hit }
            | Self::FingersBlocked { hit, .. }
            | Self::ArmGoalInCollision { hit }
            | Self::ArmStartInCollision { hit }
            | Self::ArmPathNotFound { hit, .. }
            | Self::ArmBlocked { hit } => Some(hit),
            Self::PartStopped(stopped) => Some(&stopped.hit),
            _ => None,
        }
    }
}
