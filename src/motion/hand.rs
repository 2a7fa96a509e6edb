//! A hand: its links, and what its fingers press on.

use crate::robot::Side;
use crate::robot::description::Gripper;
use crate::world::{AllowedPairs, BodyName, ContactForce, World};

/// Force (N) above which a finger counts as pressing.
pub(crate) const GRIP_FORCE: f64 = 2.0;

/// Allows any link of the hand to touch any object.
pub(super) fn hand_may_touch_objects(world: &World, side: Side) -> AllowedPairs {
    let names = hand_names(world, side);
    world.objects().fold(AllowedPairs::none(), |all, object| {
        all.and_all(names.clone(), &BodyName::Object(object.name().to_owned()))
    })
}

/// The links of a hand as bodies.
pub(super) fn hand_names(world: &World, side: Side) -> Vec<BodyName> {
    let models = world.models();
    let links = models.description.arm(side).gripper.links();
    links.map(|link| models.robot_body(link)).collect()
}

/// The links of an arm, from the shoulder on, and of its hand.
pub(super) fn arm_names(world: &World, side: Side) -> Vec<BodyName> {
    let models = world.models();
    let [first, ..] = models.description.arm(side).joints();
    let shoulder = models.robot.joint(*first).child;
    let links = models.robot.links().map(|(link, _)| link);
    let moving = links.filter(|link| models.robot.carries(shoulder, *link));
    moving.map(|link| models.robot_body(link)).collect()
}

/// The gripper of a hand.
pub(super) fn gripper_of(world: &World, side: Side) -> &Gripper {
    &world.models().description.arm(side).gripper
}

/// The force (N) with which each finger of a hand presses on the object.
pub(super) fn pressing_on(world: &World, side: Side, object: &str) -> [f64; 2] {
    world.finger_contacts(side).map(|forces| {
        let own = forces.iter().filter(|f| f.body.object() == Some(object));
        own.fold(0.0, |sum, f| sum + f.force)
    })
}

/// What each finger of a hand presses on.
pub(super) fn pressing(world: &World, side: Side) -> [Option<ContactForce>; 2] {
    let contacts = world.finger_contacts(side);
    contacts.map(|forces| {
        let objects = forces.into_iter().filter(|f| f.body.object().is_some());
        objects
            .filter(|f| f.force > GRIP_FORCE)
            .max_by(|a, b| a.force.total_cmp(&b.force))
    })
}
