//! Base poses from which an arm of fewer than six joints has a pose of its hand in the plane in which it
//! moves.

use crate::robot::Side;
use crate::world::World;
use spatial::{Pose, pose};

/// How far the base may be turned (rad) and moved aside (m): other poses of a search are nearer then.
const NEAR: [f64; 2] = [0.15, 0.05];
/// Base poses this close together (m, rad) are the same.
const SAME: f64 = 1e-3;

/// Collects base poses near one.
pub(super) struct AlignedBases<'w> {
    world: &'w World,
    /// In the map frame.
    base: Pose,
    found: Vec<Pose>,
}

impl<'w> AlignedBases<'w> {
    /// Near a base pose in the map frame.
    pub(super) fn new(world: &'w World, base: &Pose) -> Self {
        Self {
            world,
            base: *base,
            found: Vec::new(),
        }
    }

    /// Adds the one for a pose of a hand's tool in the map frame. Arms that reach poses in general need no
    /// other base pose.
    pub(super) fn add(&mut self, side: Side, tool: &Pose) {
        let models = self.world.models();
        let arm = models.description.arm(side);
        let base = match arm.kinematics.plane() {
            None => self.base,
            Some(plane) => {
                let joints = &self.world.robot_configuration().joints;
                let frame = models.description.base.frame;
                let arm_base = models.robot.relative_pose(frame, arm.base, joints);
                let wrist = arm.wrist_for_tool(tool);
                let (base, moved) =
                    plane.base_for(&self.base, &arm_base.unwrap_or_default(), &wrist);
                if moved.iter().zip(NEAR).any(|(by, most)| by.abs() > most) {
                    return;
                }
                base
            }
        };
        let is_same = |known: &Pose| {
            pose::distance_between(known, &base) < SAME && pose::angle_between(known, &base) < SAME
        };
        if !self.found.iter().any(is_same) {
            self.found.push(base);
        }
    }

    /// All that have been added.
    pub(super) fn bases(self) -> Vec<Pose> {
        self.found
    }
}
