//! Pulling or pushing a drawer or door by the handle that a hand holds, or turning a knob.
//!
//! The hand moves along the way that the joint prescribes: straight, or on an arc, on which it
//! turns with the door or, within what the pads yield, about the bar: so that it can open and withdraw
//! afterwards, if that is possible. The joint itself follows the
//! hand (`world::handle_hold`). The motion does not begin if the arm is too short, or if something
//! is in the way of the drawer or door, and stops when something turns out to be.

use super::job::{Job, MotionOutcome, check_finite};
use super::joint_motion::{Arrival, JointGoal, JointMotion};
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::failure::process_module::ProcessModule;
use crate::motion::failure::short_arm::ShortArm;
use crate::motion::failure::stopped_part::StoppedPart;
use crate::motion::planning::handle_approach::{
    APPROACH_JUMP, close_links, obstacle, with_open_hand, withdrawal,
};
use crate::motion::planning::handle_way::{BarGrip, PIVOTS, PartWay, follow_tools};
use crate::motion::planning::joint_plan::JointPlan;
use crate::motion::planning::planning_group::PlanningGroup;
use crate::motion::planning::way_obstacle::{part_obstacle, robot_obstacle};
use crate::motion::trajectories::axis_group::AxisGroup;
use crate::motion::trajectories::speeds;
use crate::motion::trajectories::trajectory::Trajectory;
use crate::robot::{ArmPositions, JointKind, Side};
use crate::world::{AllowedPairs, CollisionHit, HandleHold, World};
use spatial::Pose;
use spatial::pose::distance_between;

/// How far (m or rad) from its goal the joint may be at the end.
const MISSED: f64 = 0.001;

/// Moves what a hand holds by the handle to a position of its joint.
pub(crate) type Pull = Job<JointMotion<PullGoal>>;

/// The goal of pulling or pushing.
#[derive(Clone, Debug)]
pub(crate) struct PullGoal {
    side: Side,
    /// Position of the joint (rad or m); clamped to its limits once the motion is planned.
    position: f64,
}

impl Pull {
    /// Moves the joint whose handle the hand holds to the position (rad or m), or to its limit.
    pub fn new(side: Side, position: f64) -> Self {
        Self::begin(JointMotion::to(PullGoal { side, position }))
    }
}

/// What prevents a hand from going along with a part.
pub(super) enum WayObstacle {
    /// The arm does not get farther than that point of the way.
    TooShort(usize),
    /// Something is in the way at that point.
    Hit(usize, CollisionHit),
}

impl PullGoal {
    fn hold<'w>(&self, world: &'w World) -> Result<&'w HandleHold, MotionFailure> {
        let side = self.side;
        world
            .handle_hold(side)
            .ok_or(MotionFailure::HoldsNoHandle { side })
    }

    /// The arm's way along poses of the tool.
    fn arm_way(
        &self,
        world: &World,
        grip: &BarGrip,
        way: &PartWay<'_>,
        tools: &[Pose],
    ) -> Result<Vec<ArmPositions>, WayObstacle> {
        let models = world.models();
        let robot = world.robot_configuration();
        let start = models.description.arm(self.side).positions(&robot.joints);
        let points = follow_tools(models, robot, self.side, tools, &start, 1.0);
        let hand = (self.side, grip.handle);
        if let Some((i, hit)) = robot_obstacle(world, robot, hand, way, &points) {
            return Err(WayObstacle::Hit(i, hit));
        }
        if points.len() < tools.len() {
            return Err(WayObstacle::TooShort(points.len().saturating_sub(1)));
        }
        Ok(points)
    }
}

impl JointGoal for PullGoal {
    const MODULE: ProcessModule = ProcessModule::Arms;
    const BLOCKED_TIMEOUT: f64 = 0.3;

    fn what(&self) -> &'static str {
        "moving a handle"
    }

    fn plan(&mut self, world: &World, _: u32) -> Result<JointPlan, MotionFailure> {
        check_finite(Self::MODULE, &[self.position])?;
        let hold = self.hold(world)?;
        let models = world.models();
        let joint = models.kitchen.joint(hold.joint);
        self.position = joint
            .limits
            .map_or(self.position, |l| l.clamp(self.position));
        let from = world.kitchen_positions().get(hold.joint);
        let part = world.part(hold.joint);
        let way = PartWay::new(world, &part, [from, self.position], None);
        let stopped = |(i, hit): (usize, CollisionHit)| {
            MotionFailure::PartStopped(Box::new(StoppedPart {
                joint: joint.name.clone(),
                position: from,
                ahead: way.positions.get(i).copied(),
                hit,
            }))
        };
        if let Some(obstacle) = part_obstacle(&way) {
            return Err(stopped(obstacle));
        }
        let grip = BarGrip::of(world, hold);
        let sign = if self.position < from { 1.0 } else { -1.0 };
        let now = world.handle_pivot(hold);
        let pivots: Vec<f64> = match joint.kind {
            JointKind::Prismatic => vec![now],
            _ if models.knob(hold.handle).is_some() => vec![now],
            _ => PIVOTS.iter().map(|pivot| sign * pivot).collect(),
        };
        let mut farthest: Option<(usize, WayObstacle)> = None;
        let close = close_links(world, &[self.side]);
        // The first way after which the hand cannot leave the handle.
        let mut caught = None;
        for pivot in pivots {
            let tools = way.tools(&grip, [now, pivot]);
            let obstacle = match self.arm_way(world, &grip, &way, &tools) {
                Ok(points) if self.can_leave(world, &way, (&points, &tools), &close) => {
                    return Ok(self.follower(world, (&points, &tools)));
                }
                Ok(points) => {
                    caught.get_or_insert((points, tools));
                    continue;
                }
                Err(obstacle) => obstacle,
            };
            let got = match obstacle {
                WayObstacle::TooShort(i) | WayObstacle::Hit(i, _) => i,
            };
            if farthest.as_ref().is_none_or(|(far, _)| got > *far) {
                farthest = Some((got, obstacle));
            }
        }
        if let Some((points, tools)) = &caught {
            return Ok(self.follower(world, (points, tools)));
        }
        Err(match farthest {
            Some((i, WayObstacle::Hit(_, hit))) => stopped((i, hit)),
            other => MotionFailure::ArmTooShort(Box::new(ShortArm {
                side: self.side,
                joint: joint.name.clone(),
                position: from,
                wanted: self.position,
                reach: other
                    .and_then(|(i, _)| way.positions.get(i).copied())
                    .unwrap_or(from),
            })),
        })
    }

    /// How the hand ends is the joint's matter.
    fn arrived(&mut self, world: &mut World) -> Arrival {
        let hold = match self.hold(world) {
            Ok(hold) => hold,
            Err(failure) => return Arrival::Failed(failure),
        };
        let position = world.kitchen_positions().get(hold.joint);
        let left = world.stages(hold.joint, [position, self.position]);
        let is_there = |(_, [now, end]): &(_, [f64; 2])| (now - end).abs() <= MISSED;
        if left.iter().all(is_there) {
            return Arrival::Done(MotionOutcome::Arrived);
        }
        Arrival::Failed(MotionFailure::ArmTooShort(Box::new(ShortArm {
            side: self.side,
            joint: world.models().kitchen.joint(hold.joint).name.clone(),
            position,
            wanted: self.position,
            reach: position,
        })))
    }

    fn blocked(&self, _: &World, hit: CollisionHit) -> MotionFailure {
        MotionFailure::ArmBlocked { hit: hit.into() }
    }
}

impl PullGoal {
    /// Whether the hand can open at the end of a way and withdraw; what is close in any case does not count.
    fn can_leave(
        &self,
        world: &World,
        way: &PartWay<'_>,
        (points, tools): (&[ArmPositions], &[Pose]),
        close: &AllowedPairs,
    ) -> bool {
        let (Some(end), Some(tool), Some(part)) = (points.last(), tools.last(), way.parts.last())
        else {
            return false;
        };
        let (models, side) = (world.models(), self.side);
        let robot = with_open_hand(world, world.robot_configuration(), side);
        let tools = withdrawal(tool);
        let back = follow_tools(models, &robot, side, &tools, end, APPROACH_JUMP);
        back.len() == tools.len() && obstacle(world, (&robot, side), part, close, &back).is_none()
    }

    /// A trajectory through the points, on which the tool is no faster than on straight lines between its poses.
    fn follower(&self, world: &World, (points, tools): (&[ArmPositions], &[Pose])) -> JointPlan {
        let group = PlanningGroup::new(world, false, &[self.side]);
        let mut limits = speeds::limits_of(&world.models().description, &group.joints);
        let hand = speeds::HAND;
        let axis = group.joints.len();
        limits.push(AxisGroup::single(axis, hand.velocity, hand.acceleration));
        let mut length = 0.0;
        let mut path = vec![
            group
                .now(world)
                .into_iter()
                .chain([0.0])
                .collect::<Vec<f64>>(),
        ];
        for (i, point) in points.iter().enumerate().skip(1) {
            // There are as many tools as points.
            length += distance_between(&tools[i - 1], &tools[i]);
            path.push(point.iter().copied().chain([length]).collect());
        }
        let trajectory = Trajectory::rounded(&path, &limits, &mut |_| true);
        JointPlan::new(group.joints, trajectory, world.fingers_on_handles())
    }
}
