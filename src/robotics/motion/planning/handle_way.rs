//! The way of a hand that opens or closes something by its handle.

use nalgebra::{Point3, Translation3, Unit, UnitQuaternion, Vector3};

use super::cartesian_path::wrist_in_arm_base;
use crate::robot::{ArmPositions, JointId, JointKind, LinkId, Side};
use crate::world::{HandleHold, Models, MovedPart, Part, RobotConfiguration, World};
use spatial::{Pose, pose, trig};

/// The angles (rad) by which a hand is turned about a bar while a door is opened, in the order in
/// which they are tried; positive against the door's turn.
pub(crate) const PIVOTS: [f64; 5] = [0.0, 0.35, 0.7, -0.35, -0.7];
/// How far (m or rad) a drawer or door moves at most between neighbouring points of a way.
const STEP: (f64, f64) = (0.01, 0.02);
/// How far (m) the tool may be from its line between neighbouring points.
const OFF_LINE: f64 = 0.001;
/// Largest change (rad) of a joint of the arm between neighbouring points; more is a jump from one
/// branch of the inverse kinematics to another.
const JUMP: f64 = 0.35;

/// How a hand holds a bar, or would.
#[derive(Clone, Debug)]
pub(crate) struct BarGrip {
    /// The link that has the bar.
    pub(crate) handle: LinkId,
    /// The pose of the tool in the frame of the handle.
    pub(crate) tool: Pose,
    /// The held point of the bar (m), in the frame of the handle.
    pub(crate) point: Point3<f64>,
    /// The direction of the bar in the frame of the handle.
    pub(crate) bar: Vector3<f64>,
}

impl BarGrip {
    /// The grip of a hand of the world.
    pub(crate) fn of(world: &World, hold: &HandleHold) -> Self {
        let arm = world.models().description.arm(hold.side);
        let palm = world.link_pose(arm.gripper.palm);
        let tool = arm.tool_for_wrist(&world.link_pose(arm.wrist));
        Self {
            handle: hold.handle,
            tool: hold.grip().inverse() * palm.inverse() * tool,
            point: *hold.point(),
            bar: *hold.bar(),
        }
    }

    /// The pose of the tool for a pose of the handle, in the same frame, with the hand turned about
    /// the bar by an angle (rad).
    pub(crate) fn tool(&self, handle: &Pose, pivot: f64) -> Pose {
        let point = Translation3::from(self.point.coords);
        handle * point * turn(&self.bar, pivot) * point.inverse() * self.tool
    }
}

/// Rotation by an angle (rad) about a unit vector.
pub(crate) fn turn(axis: &Vector3<f64>, angle: f64) -> UnitQuaternion<f64> {
    let (s, c) = trig::sin_cos(angle / 2.0);
    let q = nalgebra::Quaternion::from_parts(c, axis * s);
    Unit::new_unchecked(q)
}

/// Where a drawer or door comes to be on its way, point by point.
pub(crate) struct PartWay<'w> {
    pub(crate) positions: Vec<f64>,
    pub(crate) parts: Vec<MovedPart<'w>>,
}

impl<'w> PartWay<'w> {
    /// The way between two positions (rad or m) of the joint, with points as far apart as given, or
    /// as close as a motion needs.
    pub(crate) fn new(
        world: &'w World,
        part: &Part,
        [from, to]: [f64; 2],
        step: Option<(f64, f64)>,
    ) -> Self {
        let (metres, radians) = step.unwrap_or(STEP);
        let stages = world.stages(part.joint, [from, to]);
        let mut positions = Vec::new();
        let mut parts = Vec::new();
        // Where the joints of the stages are.
        let mut joints: Vec<(JointId, f64)> =
            stages.iter().map(|(j, [from, _])| (*j, *from)).collect();
        for (stage, (joint, [from, to])) in stages.iter().enumerate() {
            let step = match world.models().kitchen.joint(*joint).kind {
                JointKind::Prismatic => metres,
                _ => radians,
            };
            let count = ((to - from).abs() / step).ceil().max(1.0) as u32;
            let at = |i: u32| from + (to - from) * f64::from(i) / f64::from(count);
            // A stage begins where the one before has ended.
            for position in (u32::from(stage > 0)..=count).map(at) {
                joints[stage].1 = position;
                let own = joints.iter().find(|(joint, _)| *joint == part.joint);
                positions.push(own.map_or(position, |(_, position)| *position));
                parts.push(world.moved_by(part, &joints));
            }
        }
        Self { positions, parts }
    }

    /// The poses of the tool in the map frame on the way, if the hand turns about the bar from
    /// the first to the second angle (rad) meanwhile.
    pub(crate) fn tools(&self, grip: &BarGrip, [from, to]: [f64; 2]) -> Vec<Pose> {
        let last = self.parts.len().saturating_sub(1).max(1) as f64;
        let poses = self.parts.iter().enumerate().map(|(i, part)| {
            let share = i as f64 / last;
            grip.tool(&part.pose(grip.handle), from + (to - from) * share)
        });
        poses.collect()
    }
}

/// Whether joints that move evenly between two configurations keep the tool on its line, so that the
/// hand neither leaves the bar nor pulls at it.
fn keeps_to_line(
    models: &Models,
    robot: &RobotConfiguration,
    side: Side,
    [from, to]: [&ArmPositions; 2],
    tools: [&Pose; 2],
) -> bool {
    let arm = models.description.arm(side);
    let mut joints = robot.joints.clone();
    let mut middle = *from;
    for (q, end) in middle.iter_mut().zip(to) {
        *q = 0.5 * (*q + end);
    }
    arm.set_positions(&mut joints, &middle);
    let wrist = models.robot.link_pose(arm.wrist, &robot.base, &joints);
    let wanted = pose::between(tools[0], tools[1], 0.5);
    pose::distance_between(&arm.tool_for_wrist(&wrist), &wanted) <= OFF_LINE
}

/// The arm's positions along poses of the tool in the map frame, each nearest to the one before;
/// as many as there are, up to `jump` times the usual change between them. If that is 1, the tool
/// keeps to its line also between them.
pub(crate) fn follow_tools(
    models: &Models,
    robot: &RobotConfiguration,
    side: Side,
    tools: &[Pose],
    start: &ArmPositions,
    jump: f64,
) -> Vec<ArmPositions> {
    let arm = models.description.arm(side);
    let base = robot.base.inverse();
    let mut before = *start;
    let mut all = Vec::with_capacity(tools.len());
    for (i, tool) in tools.iter().enumerate() {
        let wrist = wrist_in_arm_base(models, robot, arm, &(base * tool));
        let Ok(next) = arm.kinematics.nearest(&wrist, &before) else {
            break;
        };
        let farthest = next.iter().zip(&before).map(|(a, b)| (a - b).abs());
        if farthest.fold(0.0, f64::max) > jump * JUMP {
            break;
        }
        let is_exact = jump > 1.0
            || i == 0
            || keeps_to_line(models, robot, side, [&before, &next], [&tools[i - 1], tool]);
        if !is_exact {
            break;
        }
        all.push(next);
        before = next;
    }
    all
}
