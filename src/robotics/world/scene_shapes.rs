//! Every shape in the world with its pose, for cameras and viewers.

use super::part_key::PartKey;
use super::scene::World;
use crate::robot::KinematicTree;
use spatial::{PlacedShape, Pose, Shape};

/// A shape at its current pose.
#[derive(Clone, Copy, Debug)]
pub struct SceneShape<'w> {
    /// The body that it belongs to.
    pub key: PartKey,
    /// The solid.
    pub shape: &'w Shape,
    /// Pose of the solid's frame in the map frame.
    pub pose: Pose,
}

impl World {
    /// The collision shapes: first the kitchen's, then the robot's, then the objects'. The
    /// floor, which is infinite, is left out.
    pub fn shapes(&self) -> Vec<SceneShape<'_>> {
        let mut found = Vec::new();
        add_tree(
            &mut found,
            &self.models.kitchen,
            &self.state.kitchen_poses,
            PartKey::Furniture,
        );
        add_tree(
            &mut found,
            &self.models.robot,
            &self.state.robot_poses,
            PartKey::Robot,
        );
        for object in self.state.objects.values() {
            let pose = self.physics.pose(object.body);
            found.extend(object.shapes.iter().map(|placed| SceneShape {
                key: object.key(),
                shape: &placed.shape,
                pose: pose * placed.pose,
            }));
        }
        found
    }
}

fn add_tree<'w>(
    found: &mut Vec<SceneShape<'w>>,
    tree: &'w KinematicTree,
    poses: &[Pose],
    key: fn(u32) -> PartKey,
) {
    for ((id, link), pose) in tree.links().zip(poses) {
        let key = key(super::part_key::index(id));
        found.extend(
            link.collisions
                .iter()
                .map(|placed: &PlacedShape| SceneShape {
                    key,
                    shape: &placed.shape,
                    pose: pose * placed.pose,
                }),
        );
    }
}
