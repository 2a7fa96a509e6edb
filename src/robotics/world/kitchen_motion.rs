//! Drawers and doors, and how they move.

use std::sync::Arc;

use super::collision::CollisionHit;
use super::error::WorldError;
use super::scene::{World, pose_of};
use super::two_stages::freeing_joint;
use crate::robot::{JointId, JointPositions, KinematicTree, LinkId};
use closest_name::closest_name;
use spatial::Pose;

/// Steps (m, rad) in which the way of a drawer or door is looked at.
const WAY_STEP: f64 = 0.02;
/// The most steps: a wheel may be told to turn a million times.
const MAX_WAY_STEPS: f64 = 400.0;

impl World {
    /// Pose of a link of the kitchen in the map frame.
    pub fn furniture_pose(&self, link: LinkId) -> Pose {
        pose_of(&self.state.kitchen_poses, link)
    }

    /// Positions of all joints of the kitchen (rad or m).
    pub fn kitchen_positions(&self) -> &JointPositions {
        &self.state.kitchen
    }

    /// Position of a joint of the kitchen (rad or m).
    pub fn kitchen_joint(&self, name: &str) -> Result<f64, WorldError> {
        let joint = self.moving_kitchen_joint(name)?;
        Ok(self.models.kitchen.position(&self.state.kitchen, joint))
    }

    /// What is in the way of a drawer or door to a position (rad or m), which is clamped to the joint's
    /// limits: where on the way the joint then is, and what the part, or what rides in it, would run
    /// into. What it is in already does not count.
    pub fn way_of_kitchen_joint(
        &self,
        name: &str,
        position: f64,
    ) -> Result<Option<(f64, CollisionHit)>, WorldError> {
        let joint = self.moving_kitchen_joint(name)?;
        let limits = self.models.kitchen.joint(joint).limits;
        let goal = limits.map_or(position, |l| l.clamp(position));
        let now = self.models.kitchen.position(&self.state.kitchen, joint);
        let part = self.part(joint);
        let before = self.moved(&part, now).hits();
        // What is no number is refused where the joint is moved.
        if !goal.is_finite() {
            return Ok(None);
        }
        let steps = ((goal - now).abs() / WAY_STEP).ceil();
        let steps = steps.clamp(1.0, MAX_WAY_STEPS);
        for step in 1..=steps as u32 {
            let at = now + (goal - now) * f64::from(step) / steps;
            let is_new = |hit: &CollisionHit| {
                let mut known = before.iter();
                !known.any(|known| known.moving == hit.moving && known.other == hit.other)
            };
            if let Some(hit) = self.moved(&part, at).hits().into_iter().find(is_new) {
                return Ok(Some((at, hit)));
            }
        }
        Ok(None)
    }

    /// Makes a drawer or door move to the position (rad or m) during the next step, taking
    /// along what is in it. The position is clamped to the joint's limits and returned.
    #[cfg(test)]
    pub(crate) fn set_kitchen_joint(
        &mut self,
        name: &str,
        position: f64,
    ) -> Result<f64, WorldError> {
        let position = self.change_kitchen_joint(name, position)?;
        self.state.kitchen_moves = true;
        Ok(position)
    }

    /// Puts a drawer or door at the position (rad or m) at once, with what is in it. A hand that
    /// holds its handle loses it. The position is clamped to the joint's limits and returned.
    pub fn teleport_kitchen_joint(&mut self, name: &str, position: f64) -> Result<f64, WorldError> {
        let joint = self.moving_kitchen_joint(name)?;
        let part = self.part(joint);
        if position.is_finite() {
            let limits = self.models.kitchen.joint(joint).limits;
            let position = limits.map_or(position, |l| l.clamp(position));
            let (_, poses) = self.kitchen_with(joint, position);
            self.carry_riders(&part, &poses);
        }
        let position = self.change_kitchen_joint(name, position)?;
        self.release_handles(Some(joint));
        self.state.kitchen_moves = false;
        for (body, group) in self
            .kitchen_bodies
            .iter()
            .zip(&self.models.kitchen_geometry.groups)
        {
            if let (Some(body), true) = (body, group.moves) {
                self.physics
                    .place(*body, &pose_of(&self.state.kitchen_poses, group.root));
            }
        }
        Ok(position)
    }

    fn change_kitchen_joint(&mut self, name: &str, position: f64) -> Result<f64, WorldError> {
        let joint = self.moving_kitchen_joint(name)?;
        if !position.is_finite() {
            return Err(WorldError::ImpossibleNumber {
                quantity: "the position",
                name: name.to_owned(),
                value: position,
            });
        }
        let limits = self.models.kitchen.joint(joint).limits;
        let position = limits.map_or(position, |l| l.clamp(position));
        if let Some(freeing) = freeing_joint(&self.models.kitchen, joint)
            && let Some(slide) = self.models.kitchen.joint(freeing).limits
        {
            // A door that has not turned is in.
            self.set_joint(freeing, slide.lower);
        }
        self.set_joint(joint, position);
        Ok(position)
    }

    /// Notes that the joint is at the position (rad or m), which is within its limits. The bodies
    /// are still where they were.
    pub(super) fn set_joint(&mut self, joint: JointId, position: f64) {
        let (positions, poses) = self.kitchen_with(joint, position);
        let geometry = &self.models.kitchen_geometry;
        self.state.furniture = Arc::new(self.state.furniture.with_links_at(geometry, &poses));
        self.state.kitchen = positions;
        self.state.kitchen_poses = poses;
    }

    fn moving_kitchen_joint(&self, name: &str) -> Result<JointId, WorldError> {
        let tree: &KinematicTree = &self.models.kitchen;
        tree.joint_named(name)
            .filter(|j| tree.joint(*j).is_actuated())
            .ok_or_else(|| WorldError::UnknownKitchenJoint {
                name: name.to_owned(),
                closest: closest_name(
                    name,
                    tree.joints()
                        .filter(|(_, j)| j.is_actuated())
                        .map(|(_, j)| j.name.as_str()),
                )
                .map(str::to_owned),
            })
    }
}
