//! Configurations that move the tools of the arms along straight lines.

use super::configuration_checker::ConfigurationChecker;
use super::joint_path::{between, is_free_between};
use super::planning_group::PlanningGroup;
use crate::robot::description::Arm;
use crate::robot::{ArmPositions, Side};
use crate::world::{Models, RobotConfiguration, World};
use spatial::{Pose, pose};

/// Distance (m) and angle (rad) between neighbouring configurations of a line.
const STEP: (f64, f64) = (0.01, 0.05);
/// Largest change (rad) of a joint between neighbouring configurations; more is a jump from
/// one branch of the inverse kinematics to another.
const JUMP: f64 = 0.35;
/// No part moves farther (m) than this without a check between neighbouring configurations.
const RESOLUTION: f64 = 0.02;

/// A straight line for the tool of one arm, in the frame of the base.
#[derive(Clone, Copy, Debug)]
pub(super) struct CartesianLine {
    pub(super) side: Side,
    pub(super) from: Pose,
    pub(super) to: Pose,
}

/// Straight lines that one or both arms follow at the same time while the torso moves to a
/// height.
pub(super) struct CartesianTask<'a> {
    pub(super) models: &'a Models,
    pub(super) robot: RobotConfiguration,
    pub(super) group: PlanningGroup,
    pub(super) lines: Vec<CartesianLine>,
    /// Final height (m) of the torso, if it is the first of the axes.
    pub(super) torso: Option<f64>,
}

/// The robot's joints along a line, and how far the tool has moved (m) at each point.
#[derive(Clone, Debug, Default)]
pub(super) struct CartesianPath {
    pub(super) points: Vec<Vec<f64>>,
    pub(super) lengths: Vec<f64>,
    /// Number of steps of the complete line.
    pub(super) steps: u32,
}

impl CartesianPath {
    /// Makes each metre of the last stretch (m) count for several, so that the tool goes slowly
    /// there.
    pub(super) fn slow_down(&mut self, stretch: f64, times: f64) {
        let end = self.lengths.last().copied().unwrap_or(0.0);
        let from = (end - stretch).max(0.0);
        for length in &mut self.lengths {
            *length += (*length - from).max(0.0) * (times - 1.0);
        }
    }
}

/// How a line ended.
#[derive(Debug)]
pub(super) enum CartesianEnd {
    Complete,
    /// No configuration, or none near the previous one.
    Unreachable,
    Blocked,
}

impl CartesianTask<'_> {
    /// Length of the longest line (m); a turn counts as the arc of a hand's length.
    fn length(&self) -> f64 {
        let lengths = self.lines.iter().map(|l| {
            let angle = pose::angle_between(&l.from, &l.to) * STEP.0 / STEP.1;
            pose::distance_between(&l.from, &l.to).max(angle)
        });
        lengths.fold(0.0, f64::max)
    }

    /// Follows the lines as far as possible. Each configuration is the one nearest to the
    /// previous one or, if a final configuration is given, to a seed that drifts towards it.
    /// Without a checker nothing is in the way.
    pub(super) fn follow(
        &self,
        start: &[f64],
        last: Option<&[f64]>,
        mut checker: Option<&mut ConfigurationChecker<'_>>,
    ) -> (CartesianPath, CartesianEnd) {
        let length = self.length();
        let steps = (length / STEP.0).ceil().max(1.0) as u32;
        let mut path = CartesianPath {
            points: vec![start.to_vec()],
            lengths: vec![0.0],
            steps,
        };
        let mut before = start.to_vec();
        for i in 1..=steps {
            let share = f64::from(i) / f64::from(steps);
            let seed = last.map_or_else(|| before.clone(), |last| between(start, last, share));
            let Some(next) = self.configuration(share, &seed, start) else {
                return (path, CartesianEnd::Unreachable);
            };
            let jump = before
                .iter()
                .zip(&next)
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f64::max);
            if jump > JUMP {
                return (path, CartesianEnd::Unreachable);
            }
            if let Some(checker) = checker.as_deref_mut()
                && self.is_blocked(&before, &next, checker)
            {
                return (path, CartesianEnd::Blocked);
            }
            path.points.push(next.clone());
            path.lengths.push(length * share);
            before = next;
        }
        (path, CartesianEnd::Complete)
    }

    fn is_blocked(
        &self,
        before: &[f64],
        next: &[f64],
        checker: &mut ConfigurationChecker<'_>,
    ) -> bool {
        !checker.is_free_on_way(next)
            || !is_free_between(&self.group.axes, before, next, RESOLUTION, checker)
    }

    /// The configuration at that fraction of the line that is nearest to the seed.
    pub(super) fn configuration(
        &self,
        share: f64,
        seed: &[f64],
        start: &[f64],
    ) -> Option<Vec<f64>> {
        let mut configuration = Vec::with_capacity(seed.len());
        let mut robot = self.robot.clone();
        if let Some(end) = self.torso {
            let from = start.first().copied()?;
            let height = from + (end - from) * share;
            let torso = &self.models.description.torso;
            torso.set_height(&mut robot.joints, height);
            configuration.push(height);
        }
        for line in &self.lines {
            let arm = self.models.description.arm(line.side);
            let tcp = pose::between(&line.from, &line.to, share);
            let wrist = wrist_in_arm_base(self.models, &robot, arm, &tcp);
            let offset = configuration.len();
            let own = seed.get(offset..offset + arm.joints().len())?;
            let seed = ArmPositions::try_from(own).ok()?;
            configuration.extend(arm.kinematics.nearest(&wrist, &seed).ok()?);
        }
        Some(configuration)
    }
}

/// The wrist pose in the frame of the arm's base for a tool pose in the frame of the robot's base.
pub(super) fn wrist_in_arm_base(
    models: &Models,
    robot: &RobotConfiguration,
    arm: &Arm,
    tcp_in_base: &Pose,
) -> Pose {
    let base = models
        .robot
        .link_pose(arm.base, &Pose::identity(), &robot.joints);
    base.inverse() * arm.wrist_for_tool(tcp_in_base)
}

/// Current pose of the arm's tool in the frame of the base.
pub(crate) fn tcp_in_base(world: &World, side: Side) -> Pose {
    let arm = world.models().description.arm(side);
    let base = world.robot_configuration().base;
    base.inverse() * arm.tool_for_wrist(&world.link_pose(arm.wrist))
}
