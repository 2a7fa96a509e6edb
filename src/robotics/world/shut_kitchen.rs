//! The kitchen with everything shut, and whether what one joint moves would then meet what another one moves.

use super::models::Models;
use super::moved_part::SLACK;
use super::part_key::{PartKey, index};
use super::placed_solid::PlacedSolid;
use super::separation::separation;
use super::solid::to_parry;
use super::two_stages::come_out;
use crate::robot::JointId;
use parry3d_f64::bounding_volume::BoundingVolume;
use spatial::Pose;

/// The kitchen with everything shut.
pub struct ShutKitchen<'m> {
    models: &'m Models,
}

impl<'m> ShutKitchen<'m> {
    /// That of some models.
    pub fn new(models: &'m Models) -> Self {
        Self { models }
    }

    /// Whether what the first joint moves meets what the second one moves while the first is at one of some
    /// positions (m or rad) and the second is shut, or at a position. What overlaps while both are shut does not
    /// count.
    pub fn meet(
        &self,
        [moving, other]: [JointId; 2],
        positions: &[f64],
        other_at: Option<f64>,
    ) -> bool {
        let shut = self.models.kitchen.zero_positions();
        let mut open = shut.clone();
        if let Some(position) = other_at {
            open.set(other, position);
            come_out(&self.models.kitchen, &mut open, other);
        }
        let others = self.solids(other, &open);
        positions.iter().any(|position| {
            let mut there = open.clone();
            there.set(moving, *position);
            come_out(&self.models.kitchen, &mut there, moving);
            let own = self.solids(moving, &there);
            own.iter().any(|(key, one)| {
                others.iter().any(|(other_key, two)| {
                    one.0.bounds.intersects(&two.0.bounds)
                        && separation(&one.0.pose, one.1, &two.0.pose, two.1, -SLACK).is_some()
                        && !self.models.overlap_at_rest(*key, *other_key, SLACK)
                })
            })
        })
    }

    /// The solids that a joint moves, where they are with some positions.
    fn solids(
        &self,
        joint: JointId,
        positions: &crate::robot::JointPositions,
    ) -> Vec<(PartKey, (PlacedSolid, &'m super::solid::Solid))> {
        let kitchen = &self.models.kitchen;
        let mut poses = Vec::new();
        kitchen.forward_kinematics(&Pose::identity(), positions, &mut poses);
        let child = kitchen.joint(joint).child;
        let links = self.models.kitchen_geometry.solid_links.iter();
        let own = links.filter(|link| kitchen.carries(child, link.link));
        own.flat_map(|link| {
            let pose = poses.get(link.link.index()).copied().unwrap_or_default();
            let (key, pose) = (PartKey::Furniture(index(link.link)), to_parry(&pose));
            let solids = link.solids.iter();
            solids.map(move |solid| (key, (PlacedSolid::new(solid, &pose), solid)))
        })
        .collect()
    }
}
