//! Judging postures of some joints while everything else stays as it is.

use super::guard::{GREATEST_LAG, GUARD_DEPTH};
use super::joint_follow::with_joints;
use crate::robot::JointId;
use crate::world::{AllowedPairs, CollisionChecker, CollisionHit, RobotConfiguration, World};

/// Gap (m) that planned postures keep to everything.
pub(super) const PLAN_MARGIN: f64 = 0.004;
/// Overlap (m) of pairs that touch at the start, up to which postures pass.
const TOUCH_DEPTH: f64 = GUARD_DEPTH - 0.0005;

/// Tells which postures are free. Pairs that are near each other at the start, such as a
/// held object and what it stands on, may stay near, but not overlap.
pub(super) struct Judge<'w> {
    checker: CollisionChecker<'w>,
    robot: RobotConfiguration,
    joints: Vec<JointId>,
    /// Pairs that may touch, and those that are near at the start.
    relaxed: AllowedPairs,
    /// Pairs that may touch.
    allowed: AllowedPairs,
    is_near_something: bool,
}

impl<'w> Judge<'w> {
    pub(super) fn new(world: &'w World, joints: Vec<JointId>, allowed: &AllowedPairs) -> Self {
        let mut checker = world.collision_checker();
        let robot = world.robot_configuration().clone();
        let near = checker.all_hits(&robot, allowed, PLAN_MARGIN);
        let (deep, near): (Vec<_>, Vec<_>) = near.into_iter().partition(|h| h.depth > TOUCH_DEPTH);
        // What overlaps already must be able to part, wherever the overlap came from.
        let allowed = deep
            .into_iter()
            .filter(|h| h.depth < GREATEST_LAG)
            .fold(allowed.clone(), |all, h| all.and(h.moving, h.other));
        let is_near_something = !near.is_empty();
        let relaxed = near
            .into_iter()
            .fold(allowed.clone(), |all, h| all.and(h.moving, h.other));
        Self {
            checker,
            robot,
            joints,
            relaxed,
            allowed,
            is_near_something,
        }
    }

    /// The whole robot with the joints at the positions.
    pub(super) fn robot_at(&self, positions: &[f64]) -> RobotConfiguration {
        with_joints(&self.robot, &self.joints, positions)
    }

    /// What forbids the joints to be at the positions, if anything does.
    pub(super) fn blocked(&mut self, positions: &[f64]) -> Option<CollisionHit> {
        for (joint, position) in self.joints.iter().zip(positions) {
            self.robot.joints.set(*joint, *position);
        }
        let near = self
            .checker
            .first_hit(&self.robot, &self.relaxed, PLAN_MARGIN);
        if near.is_some() || !self.is_near_something {
            return near;
        }
        self.checker
            .first_hit(&self.robot, &self.allowed, -TOUCH_DEPTH)
    }

    /// The smallest gap (m) in that posture, up to `reach` (m).
    pub(super) fn clearance(&mut self, positions: &[f64], reach: f64) -> f64 {
        let robot = self.robot_at(positions);
        self.checker
            .clearance(&robot, &self.relaxed, reach)
            .map_or(reach, |c| c.distance)
    }
}
