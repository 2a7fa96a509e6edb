//! Furniture that is in other furniture as its file has it.
//!
//! Published kitchens are made for looks: fronts reach into their carcasses, rails into their drawers. What overlaps
//! while everything is shut has been built so, and tells nothing about what would stop a drawer or door.

use std::collections::BTreeSet;

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};

use super::link_geometry::TreeGeometry;
use super::obstacles::{Obstacle, Obstacles};
use super::part_key::PartKey;
use super::separation::separation;
use crate::robot::KinematicTree;
use spatial::Pose;

/// Pairs of links that overlap where they are at rest, the lesser key first.
pub(super) type PairsAtRest = BTreeSet<(PartKey, PartKey)>;

/// The pair of two keys, the lesser first.
pub(super) fn pair(a: PartKey, b: PartKey) -> (PartKey, PartKey) {
    (a.min(b), a.max(b))
}

/// Finds the pairs of links that overlap by more than `slack` (m) with every joint at zero.
pub(super) fn pairs_at_rest(
    kitchen: &KinematicTree,
    geometry: &TreeGeometry,
    slack: f64,
) -> PairsAtRest {
    let mut poses = Vec::new();
    let zero = kitchen.zero_positions();
    kitchen.forward_kinematics(&Pose::identity(), &zero, &mut poses);
    let furniture = Obstacles::new(geometry, &poses);
    let mut found = PairsAtRest::new();
    let all = furniture.all();
    for (i, one) in all.iter().enumerate() {
        let bounds: &Aabb = &one.placed.bounds;
        for place in furniture.places_near(bounds).filter(|place| *place > i) {
            // These are places in this list.
            let other = &all[place];
            let pair = pair(one.key, other.key);
            if one.key != other.key && !found.contains(&pair) && overlap(one, other, slack) {
                found.insert(pair);
            }
        }
    }
    found
}

fn overlap(one: &Obstacle, other: &Obstacle, slack: f64) -> bool {
    one.placed.bounds.intersects(&other.placed.bounds)
        && separation(
            &one.placed.pose,
            &one.solid,
            &other.placed.pose,
            &other.solid,
            -slack,
        )
        .is_some()
}
