//! Turning the head to look at something.
//!
//! Of a neck that pans and tilts as the PR2's does, the head is aimed, not one of its cameras.

use nalgebra::Point3;

use super::job::{Job, MotionOutcome, check_finite};
use super::joint_motion::{Arrival, JointGoal, JointMotion};
use crate::motion::failure::joint_limit::violation;
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::failure::process_module::ProcessModule;
use crate::motion::planning::aim::{is_in_picture, neck_positions};
use crate::motion::planning::joint_plan::JointPlan;
use crate::motion::trajectories::speeds;
use crate::motion::trajectories::trajectory::Trajectory;
use crate::robot::{LimitViolation, LinkId};
use crate::world::{AllowedPairs, CollisionHit, World};
use spatial::Pose;

/// An angle farther outside its limits than this (rad) is a failure.
const CROPPED: f64 = 1e-4;

/// How far (m) ahead the point is that stands for looking straight ahead.
const STRAIGHT_AHEAD: f64 = 100.0;

/// The height (m) above the floor from which the head looks straight ahead.
fn level_height(world: &World, base: &Pose) -> f64 {
    let description = &world.models().description;
    let head = description.neck.joints.last();
    let head = head.map(|joint| world.models().robot.joint(*joint).child);
    let head = world.link_pose(head.unwrap_or(description.camera().frame));
    (base.inverse() * head).translation.z
}

/// A direction to look in, relative to the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LookDirection {
    /// Straight ahead, both neck joints at 0.
    Forward,
    /// At a table in front of the robot.
    Down,
    /// At a table, to the left.
    Left,
    /// At a table, to the right.
    Right,
    /// Ahead and above the head.
    Up,
}

impl LookDirection {
    /// The point (m) in the base's frame to look at; `None` for straight ahead.
    fn point(self) -> Option<Point3<f64>> {
        match self {
            Self::Forward => None,
            Self::Down => Some(Point3::new(0.65, 0.08, 0.76)),
            Self::Left => Some(Point3::new(0.65, 0.76, 0.76)),
            Self::Right => Some(Point3::new(0.65, -0.76, 0.76)),
            Self::Up => Some(Point3::new(1.5, 0.0, 2.2)),
        }
    }
}

/// What to look at.
#[derive(Clone, Debug, PartialEq)]
pub enum LookTarget {
    /// The origin of a pose in the map frame.
    InMap(Pose),
    /// The origin of a pose in the frame of the robot's base.
    InBase(Pose),
    /// The origin of a link of the robot or the kitchen, or of an object, by name.
    Frame(String),
    /// A direction.
    Direction(LookDirection),
}

/// Turns the head. Angles beyond the neck's limits are clamped, the head moves as far as
/// possible, and then the motion fails.
pub type Look = Job<JointMotion<LookGoal>>;

/// The point at which the head is to be aimed.
#[derive(Clone, Debug)]
pub struct LookGoal {
    target: LookTarget,
    violation: Option<LimitViolation>,
}

impl Look {
    /// Looks at the target's position when the motion starts.
    pub fn new(target: LookTarget) -> Self {
        Self::begin(JointMotion::to(LookGoal {
            target,
            violation: None,
        }))
    }
}

impl LookGoal {
    /// The point to look at in the map frame; `None` for straight ahead.
    fn point(&self, world: &World) -> Result<Option<Point3<f64>>, MotionFailure> {
        let base = world.robot_configuration().base;
        let origin = |pose: &Pose| Point3::from(pose.translation.vector);
        Ok(match &self.target {
            LookTarget::InMap(pose) => Some(origin(&world.from_belief(pose))),
            LookTarget::InBase(pose) => Some(origin(&(base * pose))),
            LookTarget::Direction(direction) => direction.point().map(|p| base * p),
            LookTarget::Frame(name) => {
                let models = world.models();
                let robot = models.robot.link_named(name).map(|l| world.link_pose(l));
                let kitchen = || {
                    models
                        .kitchen
                        .link_named(name)
                        .map(|l| world.furniture_pose(l))
                };
                let found = robot.or_else(kitchen);
                let pose = match found {
                    Some(pose) => pose,
                    None => world.object_pose(name).map_err(|_| {
                        MotionFailure::UnknownName(format!("there is no frame {name}"))
                    })?,
                };
                Some(origin(&pose))
            }
        })
    }
}

impl JointGoal for LookGoal {
    const MODULE: ProcessModule = ProcessModule::Neck;
    const BLOCKED_TIMEOUT: f64 = 0.3;

    fn what(&self) -> &'static str {
        "looking"
    }

    fn plan(&mut self, world: &World, _: u32) -> Result<JointPlan, MotionFailure> {
        let point = self.point(world)?;
        if let Some(point) = &point {
            check_finite(Self::MODULE, point.coords.as_slice())?;
        }
        let joints = world.models().description.neck.joints.clone();
        if let Some(point) = point.filter(|_| joints.is_empty())
            && !is_in_picture(world, &point)
        {
            return Err(MotionFailure::NeckMissing);
        }
        let wanted = match point {
            None => vec![0.0; joints.len()],
            Some(point) => neck_positions(world, &point),
        };
        let tree = &world.models().robot;
        let mut goal = Vec::new();
        for (id, wanted) in joints.iter().zip(wanted) {
            let joint = tree.joint(*id);
            let cropped = joint.limits.map_or(wanted, |l| l.clamp(wanted));
            goal.push(cropped);
            if let Some(l) = joint.limits.filter(|l| l.excess(wanted) > CROPPED) {
                self.violation = Some(violation(joint, l, wanted));
            }
        }
        let now = joints
            .iter()
            .map(|j| world.robot_configuration().joints.get(*j))
            .collect();
        let limits = speeds::limits_of(&world.models().description, &joints);
        let trajectory = Trajectory::new(&[now, goal], &limits);
        Ok(JointPlan::new(joints, trajectory, AllowedPairs::none()))
    }

    fn aims_at(&self, world: &World) -> Option<Point3<f64>> {
        let base = world.robot_configuration().base;
        let ahead = || base * Point3::new(STRAIGHT_AHEAD, 0.0, level_height(world, &base));
        self.point(world)
            .ok()
            .map(|point| point.unwrap_or_else(ahead))
    }

    fn carriers(&self, _: &World) -> Vec<LinkId> {
        Vec::new()
    }

    fn arrived(&mut self, _: &mut World) -> Arrival {
        match self.violation.take() {
            None => Arrival::Done(MotionOutcome::Arrived),
            Some(violation) => Arrival::Failed(MotionFailure::NeckLimit { violation }),
        }
    }

    fn blocked(&self, _: &World, hit: CollisionHit) -> MotionFailure {
        MotionFailure::NeckBlocked { hit: hit.into() }
    }
}
