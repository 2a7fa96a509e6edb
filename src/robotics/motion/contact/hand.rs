//! A hand: its links, and what its fingers press on.

use crate::robot::description::Gripper;
use crate::robot::{LinkId, Side};
use crate::world::{AllowedPairs, BodyName, ContactForce, World};

/// Force (N) above which a finger counts as pressing.
pub(crate) const GRIP_FORCE: f64 = 2.0;
/// How much farther (m) than on an object the fingers open to let it go: enough to withdraw beside it,
/// and no more, since other things may stand close to it.
const RELEASE: f64 = 0.03;

/// Gaps (m) between the fingers and a bar at which both count as pressing on it: the first one
/// touches, and the other is so near that arm and pads yield by the rest.
const BAR_TOUCHED: f64 = 0.0003;
const BAR_NEAR: f64 = 0.0012;
/// How far (m) a finger that touches a bar before the other one does may go on closing: arm and
/// pads yield by that.
const BAR_YIELDS: f64 = 0.0018;
/// How far (m) a bar may be from where the tool of a hand is.
const BAR_DEPTH: f64 = 0.025;
/// How far (m) the tool of a hand may be beside the axis of a knob.
const KNOB_ASIDE: f64 = 0.01;

/// Allows any link of the hand to touch any object.
pub(crate) fn hand_may_touch_objects(world: &World, side: Side) -> AllowedPairs {
    let objects = world.objects().map(|object| object.name().to_owned());
    hand_may_touch(world, side, objects)
}

/// The hand may touch the objects.
pub(crate) fn hand_may_touch(
    world: &World,
    side: Side,
    objects: impl IntoIterator<Item = String>,
) -> AllowedPairs {
    let names = hand_names(world, side);
    let objects = objects.into_iter();
    objects.fold(AllowedPairs::none(), |all, object| {
        all.and_all(names.clone(), &BodyName::Object(object))
    })
}

/// The links of a hand as bodies.
pub(crate) fn hand_names(world: &World, side: Side) -> Vec<BodyName> {
    let models = world.models();
    let links = models.description.arm(side).gripper.links();
    links.map(|link| models.robot_body(link)).collect()
}

/// The links of an arm, from the shoulder on, and of its hand.
pub(crate) fn arm_names(world: &World, side: Side) -> Vec<BodyName> {
    let models = world.models();
    let shoulder = models.description.arm(side).shoulder(&models.robot);
    let links = models.robot.links().map(|(link, _)| link);
    let moving = links.filter(|link| models.robot.carries(shoulder, *link));
    moving.map(|link| models.robot_body(link)).collect()
}

/// The gripper of a hand.
pub(crate) fn gripper_of(world: &World, side: Side) -> &Gripper {
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
pub(crate) fn pressing(world: &World, side: Side) -> [Option<ContactForce>; 2] {
    let contacts = world.finger_contacts(side);
    contacts.map(|forces| {
        let objects = forces.into_iter().filter(|f| f.body.object().is_some());
        objects
            .filter(|f| f.force > GRIP_FORCE)
            .max_by(|a, b| a.force.total_cmp(&b.force))
    })
}

/// A bar between the fingers of a hand, of which at least one touches it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bar {
    /// The link of the kitchen that has it.
    pub(crate) handle: LinkId,
    /// Whether both fingers press on it.
    pub(crate) is_pressed: bool,
    /// How deep (m) the finger that touches first is in it.
    depth: f64,
}

/// The bar between the fingers of a hand, if one of them touches it.
pub(crate) fn bar_between(world: &World, side: Side) -> Option<Bar> {
    let robot = world.robot_configuration();
    let near = world
        .collision_checker()
        .all_hits(robot, &AllowedPairs::none(), BAR_NEAR);
    let fingers = &gripper_of(world, side).fingers;
    let gap = |finger: &[LinkId], bar: LinkId| {
        let mut hits = near.iter().filter(|hit| {
            let moves = hit.moving.robot_link().is_some_and(|l| finger.contains(&l));
            moves && matches!(&hit.other, BodyName::Furniture(link) if link.id == bar)
        });
        // The deepest comes first.
        hits.next().map(|hit| -hit.depth)
    };
    let bars = near.iter().filter_map(|hit| match &hit.other {
        BodyName::Furniture(link) => Some(link.id),
        _ => None,
    });
    let bar = bars.into_iter().find(|bar| is_between(world, side, *bar))?;
    let [left, right] = fingers.each_ref().map(|finger| gap(finger, bar));
    Some(Bar {
        handle: bar,
        is_pressed: match (left, right) {
            (Some(left), Some(right)) => left.min(right) <= BAR_TOUCHED,
            _ => false,
        },
        depth: -left.unwrap_or(0.0).min(right.unwrap_or(0.0)),
    })
}

/// Whether the fingers may go on closing around the bar: what touches first yields a little.
pub(crate) fn yields(bar: &Bar) -> bool {
    bar.depth <= BAR_YIELDS
}

/// Whether the bar of a handle, rather than a post, or a knob is where the tool of the hand is.
fn is_between(world: &World, side: Side, handle: LinkId) -> bool {
    let arm = world.models().description.arm(side);
    let tool = arm.tool_for_wrist(&world.link_pose(arm.wrist)).translation;
    let tool = world
        .furniture_pose(handle)
        .inverse_transform_point(&tool.vector.into());
    if let Some(knob) = world.models().knob(handle) {
        let along = tool.coords.dot(&knob.outward);
        let aside = (tool.coords - knob.outward * along).norm();
        return (knob.ends[0]..=knob.ends[1] + BAR_DEPTH).contains(&along) && aside <= KNOB_ASIDE;
    }
    if !world.has_bar(handle) {
        return false;
    }
    let (bar, half) = world.bar(handle);
    let tool = tool.coords - world.bar_middle(handle);
    let along = tool.dot(&bar);
    along.abs() <= half && (tool - bar * along).norm() <= BAR_DEPTH
}

/// How far (m) a hand opens to let go of what it holds.
pub fn releasing_opening(world: &World, side: Side) -> f64 {
    let gripper = &world.models().description.arm(side).gripper;
    let now = gripper.opening_at(world.robot_configuration().joints.get(gripper.joint));
    releasing_from(gripper, now)
}

/// The same (m) for fingers that are so far apart (m).
pub(crate) fn releasing_from(gripper: &Gripper, now: f64) -> f64 {
    (now + RELEASE).min(gripper.opening_at(gripper.limits.upper))
}
