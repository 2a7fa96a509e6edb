//! The contacts that a motion of the hands declares.

use super::hand::hand_names;
use super::holding::held_objects;
use crate::robot::Side;
use crate::world::{AllowedPairs, BodyName, World};

/// What a motion of the hands may touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CollisionMode {
    /// Nothing.
    AvoidAll,
    /// The hand may touch its object, and what it holds may stand on something.
    AllowHand,
    /// The hand may touch its object, and what it holds may be pressed against anything, as far
    /// as the guard permits. Arms and hands never pass through furniture.
    AllowAll,
}

/// The pairs that a motion declares.
#[derive(Clone, Debug, Default)]
pub(crate) struct ExpectedContacts {
    /// Pairs that may overlap.
    pub(crate) allowed: AllowedPairs,
    /// Pairs that may touch.
    pub(crate) touching: AllowedPairs,
}

impl ExpectedContacts {
    /// The pairs for a motion of the hands, which may touch the target; any object if none is
    /// named.
    pub(crate) fn of(
        world: &World,
        hands: impl Iterator<Item = Side>,
        mode: CollisionMode,
        target: Option<&str>,
    ) -> Self {
        let mut all = Self::default();
        if mode == CollisionMode::AvoidAll {
            return all;
        }
        let objects: Vec<BodyName> = world
            .objects()
            .map(|o| BodyName::Object(o.name().to_owned()))
            .collect();
        for side in hands {
            let hand = hand_names(world, side);
            let is_target = |o: &&BodyName| target.is_none_or(|name| o.object() == Some(name));
            for object in objects.iter().filter(is_target) {
                all.allowed = all.allowed.and_all(hand.iter().cloned(), object);
            }
            for held in held_objects(world, side).into_iter().map(BodyName::Object) {
                let others = objects.iter().filter(|o| **o != held).cloned();
                let others = others.chain(furniture(world));
                if mode == CollisionMode::AllowAll {
                    all.allowed = all.allowed.and_all(others, &held);
                } else {
                    all.touching = all.touching.and_all(others, &held);
                }
            }
        }
        all
    }
}

/// All links of the furniture that can be touched, and the floor.
fn furniture(world: &World) -> Vec<BodyName> {
    let models = world.models();
    let links = models
        .kitchen
        .links()
        .filter(|(_, link)| !link.collisions.is_empty());
    let names = links.map(|(id, _)| models.furniture_body(id));
    names.chain([BodyName::Floor]).collect()
}
