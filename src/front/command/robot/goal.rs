//! Goals as the actions of ROS 2 have them, as calls of functions of the plan language.

use super::trajectory::{Trajectory, now, part_joints, positions};
use robotics::robot::Side;
use robotics::world::Models;
use ros::Value;
use ros::message;
use ros::{SceneModel, SceneState};
use session::{Datum, FramedPose};
use spatial::Pose;
use std::time::Duration;

/// What an action does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Deed {
    /// The base drives.
    Navigate,
    /// A hand opens or closes.
    Gripper(Side),
    /// An arm, or the torso, moves along a trajectory.
    Follow(Option<Side>),
    /// The head turns.
    PointHead,
}

/// The error codes of nav2 for what has no code of its own, and for frames that are not known.
const UNKNOWN: i64 = 9000;
const TF_ERROR: i64 = 9002;

/// The error codes of FollowJointTrajectory.
const INVALID_GOAL: i64 = -1;
const INVALID_JOINTS: i64 = -2;
const OLD_STAMP: i64 = -3;
const PATH_VIOLATED: i64 = -4;

/// What is told of a goal that was to end.
const GIVEN_UP: &str = "the goal was given up";

/// The gap (m) by which a hand may miss what was asked of it.
const GAP_TOLERANCE: f64 = 0.003;

/// How a goal has ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Ended {
    /// It has been reached.
    Reached,
    /// It has not, and why.
    Failed(String),
    /// It cannot be: nothing has moved.
    Refused(String),
    /// It names joints that there are not, or not all of its own as often.
    WrongJoints(String),
    /// It was to begin before now.
    Late(String),
    /// Nothing is known of its frame.
    NoFrame(String),
    /// It was to end.
    Interrupted,
}

/// What a session is to do for a goal.
pub(super) enum Call {
    /// A function, and its arguments.
    Function(&'static str, Vec<Datum>),
    /// A trajectory of arms, one after the other, or of the torso.
    Follow(Vec<Side>, Trajectory),
    /// Trajectories of the torso, and of arms, one after the other.
    FollowAll(Trajectory, Vec<Side>, Trajectory),
}

impl Call {
    /// Both at once, if they are trajectories of different parts; otherwise the first one.
    pub(super) fn together(self, other: Self) -> Self {
        match (self, other) {
            (Self::Follow(sides, torso), Self::Follow(others, arms)) if sides.is_empty() => {
                Self::FollowAll(torso, others, arms)
            }
            (Self::Follow(sides, arms), Self::Follow(others, torso)) if others.is_empty() => {
                Self::FollowAll(torso, sides, arms)
            }
            (Self::Follow(mut sides, one), Self::Follow(others, two)) => {
                sides.extend(others);
                Self::Follow(sides, one.beside(&two))
            }
            (Self::FollowAll(torso, mut sides, one), Self::Follow(others, two)) => {
                sides.extend(others);
                Self::FollowAll(torso, sides, one.beside(&two))
            }
            (one, _) => one,
        }
    }

    /// The function, and its arguments.
    pub(super) fn arguments(self) -> (&'static str, Vec<Datum>) {
        match self {
            Self::Function(function, arguments) => (function, arguments),
            Self::Follow(sides, trajectory) => (
                "planwright-robot::follow-trajectory",
                trajectory.arguments(&sides),
            ),
            Self::FollowAll(torso, sides, arms) => (
                "planwright-robot::follow-trajectories",
                vec![
                    Datum::List(torso.arguments(&[])),
                    Datum::List(arms.arguments(&sides)),
                ],
            ),
        }
    }
}

impl Deed {
    /// Whether a goal can be one: numbers are finite, a rotation is one.
    pub(super) fn fits(self, goal: &Value) -> bool {
        match self {
            Self::Navigate => pose(goal.at(&["pose", "pose"])).is_some(),
            Self::Gripper(_) => {
                let gap = number(goal, &["command", "position"]);
                gap.is_some_and(|gap| (0.0..=1.0).contains(&gap))
            }
            Self::PointHead => point(goal.at(&["target", "point"])).is_some(),
            // What is wrong with one is told in the result.
            Self::Follow(_) => true,
        }
    }

    /// The call that carries the goal out.
    pub(super) fn prepare(
        self,
        goal: &Value,
        models: &Models,
        scene: &SceneModel,
        state: &SceneState,
    ) -> Result<Call, Ended> {
        let framed = |header: &[&str], pose: Option<Pose>| {
            let frame = goal.at(header).and_then(Value::as_text).unwrap_or_default();
            let pose = pose.ok_or_else(|| Ended::Failed("the goal is no pose".to_owned()))?;
            let carrier = match frame {
                frame if frame == scene.map || frame == scene.odometry => Pose::identity(),
                frame if frame == scene.base => state.base,
                frame => return Err(no_frame(frame, scene)),
            };
            Ok(Datum::Pose(FramedPose::from(carrier * pose)))
        };
        Ok(match self {
            Self::Navigate => {
                let pose = pose(goal.at(&["pose", "pose"]));
                let pose = framed(&["pose", "header", "frame_id"], pose)?;
                Call::Function("planwright-robot::navigate-to-pose", vec![pose])
            }
            Self::Gripper(side) => {
                let gap = number(goal, &["command", "position"]).unwrap_or_default();
                let gripper = &models.description.arm(side).gripper;
                let opening = gripper.opening_at(gripper.position_for_gap(gap));
                let side = Datum::keyword(side.name());
                Call::Function(
                    "planwright-robot::open-gripper",
                    vec![side, Datum::Float(opening)],
                )
            }
            Self::Follow(arm) => Call::Follow(
                arm.into_iter().collect(),
                Trajectory::of(goal, arm, models, scene, state, now())?,
            ),
            Self::PointHead => {
                let point = point(goal.at(&["target", "point"]));
                let pose = point.map(|[x, y, z]| Pose::translation(x, y, z));
                let pose = framed(&["target", "header", "frame_id"], pose)?;
                Call::Function("planwright-robot::point-head", vec![pose])
            }
        })
    }

    /// How far the goal is, after a real time.
    pub(super) fn feedback(
        self,
        goal: &Value,
        models: &Models,
        scene: &SceneModel,
        state: &SceneState,
        time: [Duration; 2],
    ) -> Option<Value> {
        let [stamp, since] = time;
        match self {
            Self::Navigate => {
                let to = pose(goal.at(&["pose", "pose"]))?;
                let distance = (to.translation.vector - state.base.translation.vector).norm();
                let current = Value::record([
                    ("header", message::header(stamp, scene.map)),
                    ("pose", message::pose(&state.base)),
                ]);
                Some(Value::record([
                    ("current_pose", current),
                    ("navigation_time", message::time(since)),
                    ("distance_remaining", distance.into()),
                ]))
            }
            Self::Gripper(side) => Some(hand(side, goal, models, scene, state)),
            Self::Follow(arm) => {
                let joints = part_joints(arm, models);
                let now = positions(&joints, scene, state);
                let begun = stamp.saturating_sub(since);
                let wanted = Trajectory::of(goal, arm, models, scene, state, begun).ok()?;
                let wanted = wanted.at(since.as_secs_f64(), &now);
                let error = wanted
                    .iter()
                    .zip(&now)
                    .map(|(wanted, now)| wanted - now)
                    .collect();
                let point = |positions: Vec<f64>| {
                    Value::record([
                        ("positions", Value::floats(positions)),
                        ("time_from_start", message::time(since)),
                    ])
                };
                Some(Value::record([
                    ("header", message::header(stamp, "")),
                    ("joint_names", Value::texts(joints)),
                    ("error", point(error)),
                    ("desired", point(wanted)),
                    ("actual", point(now)),
                ]))
            }
            Self::PointHead => None,
        }
    }

    /// The result of the action.
    pub(super) fn result(
        self,
        goal: &Value,
        ended: &Ended,
        models: &Models,
        scene: &SceneModel,
        state: &SceneState,
    ) -> Value {
        match self {
            Self::Navigate => {
                let (code, text) = match ended {
                    Ended::Reached => (0, ""),
                    Ended::NoFrame(text) => (TF_ERROR, text.as_str()),
                    Ended::Interrupted => (UNKNOWN, GIVEN_UP),
                    Ended::Failed(text)
                    | Ended::Refused(text)
                    | Ended::WrongJoints(text)
                    | Ended::Late(text) => (UNKNOWN, text.as_str()),
                };
                Value::record([("error_code", code.into()), ("error_msg", text.into())])
            }
            Self::Gripper(side) => hand(side, goal, models, scene, state),
            Self::Follow(_) => {
                let (code, text) = match ended {
                    Ended::Reached => (0, ""),
                    Ended::Refused(text) | Ended::NoFrame(text) => (INVALID_GOAL, text.as_str()),
                    Ended::WrongJoints(text) => (INVALID_JOINTS, text.as_str()),
                    Ended::Late(text) => (OLD_STAMP, text.as_str()),
                    Ended::Failed(text) => (PATH_VIOLATED, text.as_str()),
                    Ended::Interrupted => (PATH_VIOLATED, GIVEN_UP),
                };
                Value::record([("error_code", code.into()), ("error_string", text.into())])
            }
            Self::PointHead => Value::record([]),
        }
    }
}

fn no_frame(frame: &str, scene: &SceneModel) -> Ended {
    let known = [scene.map, &scene.odometry, &scene.base].join(", ");
    Ended::NoFrame(format!(
        "goals in frame {frame:?} are not understood, only in {known}"
    ))
}

/// How a hand is.
fn hand(
    side: Side,
    goal: &Value,
    models: &Models,
    scene: &SceneModel,
    state: &SceneState,
) -> Value {
    let gripper = &models.description.arm(side).gripper;
    let name = &models.robot.joint(gripper.joint).name;
    let joint = scene.joints.iter().position(|joint| joint == name);
    let position = joint.and_then(|joint| state.positions.get(joint));
    let gap = gripper.gap(position.copied().unwrap_or_default());
    let wanted = number(goal, &["command", "position"]).unwrap_or_default();
    let is_there = (gap - wanted.clamp(gripper.gap(0.0), gripper.gap(gripper.limits.upper))).abs()
        <= GAP_TOLERANCE;
    Value::record([
        ("position", gap.into()),
        ("stalled", (!is_there).into()),
        ("reached_goal", is_there.into()),
    ])
}

fn number(value: &Value, path: &[&str]) -> Option<f64> {
    let number = value.at(path).and_then(Value::as_float);
    number.filter(|number| number.is_finite())
}

fn point(value: Option<&Value>) -> Option<[f64; 3]> {
    let value = value?;
    let part = |axis: &str| number(value, &[axis]);
    Some([part("x")?, part("y")?, part("z")?])
}

/// A pose whose rotation is one; quaternions need not be of length one.
pub(in super::super) fn pose(value: Option<&Value>) -> Option<Pose> {
    let at = point(value?.get("position"))?;
    let turn = value?.get("orientation")?;
    let part = |axis: &str| number(turn, &[axis]);
    let turn = [part("x")?, part("y")?, part("z")?, part("w")?];
    spatial::pose::from_xyz_quaternion(at, turn)
}
