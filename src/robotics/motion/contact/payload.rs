//! What an arm can carry.
//!
//! The weight of a held object acts on every joint of the arm; springs balance the arm's own
//! weight, as those of the PR2 do. The URDF limits the torques of the joints, and the maker may
//! limit the mass.

use nalgebra::Vector3;

use super::grip_torque::{ExcessTorque, Pads};
use crate::motion::failure::overload::{Overload, PayloadLimit};
use crate::robot::{JointKind, LinkId, Side};
use crate::world::physics::GRAVITY;
use crate::world::{Object, World};

/// The first object held by a hand on one of the links whose weight the arm carries, though it
/// cannot. An object that still stands on something weighs on no arm.
pub(super) fn overload(world: &World, is_hand: impl Fn(LinkId) -> bool) -> Option<Overload> {
    let description = &world.models().description;
    for arm in &description.arms {
        let held = world
            .objects()
            .filter(|o| o.attachment_to(arm.gripper.palm).is_some());
        for object in held.filter(|_| is_hand(arm.gripper.palm)) {
            let Some(limit) = exceeded(world, arm.side, object) else {
                continue;
            };
            return Some(Overload {
                object: object.name().to_owned(),
                mass: object.mass(),
                side: arm.side,
                limit,
            });
        }
    }
    None
}

/// The part (N) of a weight (N) that two hands share which one of them bears, by its palm: that of the lever, as far as the
/// hands have lifted it. Grips are springs, and those of the simulation are stiff: a tenth of a millimetre between the
/// hands shifts ten newtons from one to the other, which arms that give way do not.
fn share_of(world: &World, object: &Object, palm: LinkId, weight: f64) -> f64 {
    let place = |link| world.link_pose(link).translation.vector;
    let other = object.attachments().find(|one| one.link != palm);
    let Some(other) = other.map(|one| place(one.link)) else {
        return weight;
    };
    let between = place(palm) - other;
    let level = between.xy().norm_squared();
    let share = match level > 1e-6 {
        true => {
            (world.balance_of_load(object) - other)
                .xy()
                .dot(&between.xy())
                / level
        }
        false => 0.5,
    };
    world.lift_of(object).clamp(0.0, weight) * share.clamp(0.0, 1.0)
}

/// What the object's weight exceeds, as far as the hand carries it.
fn exceeded(world: &World, side: Side, object: &Object) -> Option<PayloadLimit> {
    let arm = world.models().description.arm(side);
    let weld = world
        .grip_error(object.name(), arm.gripper.palm)
        .ok()
        .flatten()?;
    let by_two = object.is_held_by_two();
    let mass = match by_two {
        true => world.load_of(object),
        false => object.mass(),
    };
    let weight = mass * GRAVITY;
    let carried = match by_two {
        true => share_of(world, object, arm.gripper.palm, weight),
        false => weld.force.min(weight),
    };
    if let Some(payload) = arm.payload
        && mass > payload
        && carried >= payload * GRAVITY
    {
        return Some(PayloadLimit::Maker(payload));
    }
    let at = object.balance_at(&world.object_pose(object.name()).ok()?);
    let gripper = &arm.gripper;
    let tool = arm.tool_for_wrist(&world.link_pose(arm.wrist));
    let gap = gripper.gap(world.robot_configuration().joints.get(gripper.joint));
    let press = object.hold()?.press();
    let pads = Pads::new(gripper, object, &tool, gap.max(0.0), press);
    // Two hands bear the torque by their forces.
    let at = if by_two { tool.translation.vector } else { at };
    let pads = pads.filter(|_| carried > weight / 2.0 && !by_two);
    if let Some(excess) = pads.and_then(|pads| pads.excess(weight, &at)) {
        let ExcessTorque { torque, limit } = excess;
        return Some(PayloadLimit::Grip { torque, limit });
    }
    let force = Vector3::new(0.0, 0.0, -carried);
    let tree = &world.models().robot;
    arm.joints().iter().find_map(|id| {
        let joint = tree.joint(*id);
        let frame = world.link_pose(joint.child);
        let axis = frame.rotation * joint.axis.into_inner();
        let torque = (at - frame.translation.vector)
            .cross(&force)
            .dot(&axis)
            .abs();
        let effort = joint.max_effort?;
        let turns = joint.kind != JointKind::Prismatic;
        (turns && torque > effort).then(|| PayloadLimit::Joint {
            joint: joint.name.clone(),
            torque,
            effort,
        })
    })
}
