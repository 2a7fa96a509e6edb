//! The last check before the robot moves by one step.
//!
//! Planned paths are collision-free, but the world changes while a path is followed: other
//! jobs move other joints, and objects get pushed. So every single step is checked again,
//! whatever was planned. A step is refused if it brings the robot, or what it holds, deeper
//! into something than [`GUARD_DEPTH`], or presses an object harder onto what carries it. If two
//! bodies already overlap that much, steps that separate them or slide along are still taken,
//! or the robot could never get away; but no step may exceed [`GREATEST_DEPTH`].

use super::payload::overload;
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::failure::pinned_object::PinnedObject;
use crate::motion::failure::stopped_part::StoppedPart;
use crate::motion::failure::stuck_object::StuckObject;
use crate::robot::{LinkId, Side};
use crate::world::physics::GRAVITY;
use crate::world::{
    AllowedPairs, CollisionChecker, CollisionHit, MovingParts, Object, Pairs, RobotConfiguration,
    World,
};

/// Overlap (m) that a step may cause: much less than the 2 mm that are never exceeded, to
/// leave room for sliding away.
pub(crate) const GUARD_DEPTH: f64 = 0.0008;
/// Lag (m) of a held object behind the hand above which it counts as stuck.
pub(crate) const GREATEST_LAG: f64 = 0.01;
/// Force (N) between a held object and what it bumps into above which it counts as stuck.
pub(crate) const GREATEST_FORCE: f64 = 50.0;
/// Overlap (m) that no step exceeds, however deep it was before.
const GREATEST_DEPTH: f64 = 0.0019;
/// A sliding step may seem to go deeper by this much (m): rounding, not motion.
const SLIDE: f64 = 2e-5;
/// Gap (m) up to which what is pressed counts as touching.
const TOUCHING: f64 = 0.0005;
/// Pairs that overlap less than this (m) do not count as overlapping before the step.
const NOT_YET: f64 = GUARD_DEPTH / 2.0;

/// What rules out the configuration after the next step, if anything does.
pub(crate) fn obstacle(
    world: &World,
    next: &RobotConfiguration,
    allowed: &AllowedPairs,
) -> Option<CollisionHit> {
    let mut checker = world.collision_checker();
    // Only these pairs can get deeper.
    let now = world.robot_configuration();
    let moving = MovingParts::between(&world.models().robot, now, next);
    checker.expect_once(moving, Pairs::Changing);
    let Some(first) = checker.first_hit(next, allowed, -GUARD_DEPTH) else {
        return pressed_harder(world, &mut checker, next, allowed);
    };
    let now = checker.all_hits(now, allowed, -NOT_YET);
    if now.is_empty() {
        return Some(first);
    }
    let is_deeper = |hit: &CollisionHit| {
        let before = now
            .iter()
            .find(|n| n.moving == hit.moving && n.other == hit.other);
        let before = before.map_or(0.0, |b| b.depth);
        hit.depth > before && hit.depth > (before + SLIDE).min(GREATEST_DEPTH)
    };
    checker
        .all_hits(next, allowed, -GUARD_DEPTH)
        .into_iter()
        .find(is_deeper)
}

/// A pair of robot and object that comes closer while the robot presses the object onto something:
/// that gives way, so the two never overlap much.
fn pressed_harder(
    world: &World,
    checker: &mut CollisionChecker<'_>,
    next: &RobotConfiguration,
    allowed: &AllowedPairs,
) -> Option<CollisionHit> {
    let is_pinned = |object: &&Object| pinned(world, object.name()).is_some();
    let all_pinned: Vec<&str> = loose(world).filter(is_pinned).map(Object::name).collect();
    if all_pinned.is_empty() {
        return None;
    }
    let is_of_one = |hit: &CollisionHit| {
        let object = hit.other.object();
        object.is_some_and(|object| all_pinned.contains(&object))
    };
    let now = checker.all_hits(world.robot_configuration(), allowed, TOUCHING);
    let is_deeper = |hit: &CollisionHit| {
        let is_same = |n: &&CollisionHit| n.moving == hit.moving && n.other == hit.other;
        let before = now.iter().find(is_same);
        before.is_none_or(|before| hit.depth > before.depth)
    };
    let next = checker.all_hits(next, allowed, TOUCHING);
    next.into_iter().filter(is_of_one).find(is_deeper)
}

/// The objects that no hand holds.
pub(super) fn loose(world: &World) -> impl Iterator<Item = &Object> {
    world
        .objects()
        .filter(|object| object.attachment().is_none())
}

/// What is wrong with objects in the hands on the links for which `is_hand`, if anything: one has
/// slipped away since that step of the world, is too heavy, or is stuck.
pub(crate) fn trouble_with_held(
    world: &World,
    since: u64,
    is_hand: impl Fn(LinkId) -> bool,
) -> Option<MotionFailure> {
    let palm = |side: Side| world.models().description.arm(side).gripper.palm;
    if let Some(slip) = world.slip_since(since, |side| is_hand(palm(side))) {
        return Some(MotionFailure::HeldObjectSlipped(Box::new(slip.clone())));
    }
    if let Some(slip) = world.handle_slip_since(since, |side| is_hand(palm(side))) {
        return Some(MotionFailure::HandleSlipped(Box::new(slip.clone())));
    }
    if let Some(stopped) = stopped_part(world, |side| is_hand(palm(side))) {
        return Some(MotionFailure::PartStopped(Box::new(stopped)));
    }
    if let Some(overload) = overload(world, &is_hand) {
        return Some(MotionFailure::TooHeavy(Box::new(overload)));
    }
    let stuck = stuck_object(world, is_hand)?;
    Some(MotionFailure::HeldObjectStuck(Box::new(stuck)))
}

/// The object, if the robot presses it onto something.
pub(crate) fn pinned(world: &World, object: &str) -> Option<PinnedObject> {
    let force = world.pressed_down(object).ok()?;
    let weight = world.object(object).ok()?.mass() * GRAVITY;
    if force <= GREATEST_FORCE.max(weight) {
        return None;
    }
    Some(PinnedObject {
        object: object.to_owned(),
        against: world.carrier(object).ok()??,
        force,
    })
}

/// The first drawer or door that something keeps from following one of the hands.
fn stopped_part(world: &World, is_hand: impl Fn(Side) -> bool) -> Option<StoppedPart> {
    let mut sides = world
        .models()
        .description
        .sides()
        .filter(|side| is_hand(*side));
    sides.find_map(|side| {
        let hold = world.handle_hold(side)?;
        let hit = hold.against()?.clone();
        let (joint, position) = world.joint_of_handle(hold).ok()?;
        Some(StoppedPart {
            joint,
            position,
            ahead: None,
            hit,
        })
    })
}

/// The first object held by one of the links that lags or is pressed too much.
fn stuck_object(world: &World, is_hand: impl Fn(LinkId) -> bool) -> Option<StuckObject> {
    let held = world
        .objects()
        .filter(|o| o.attachments().any(|a| is_hand(a.link)));
    for object in held {
        let name = object.name();
        let errors = object.attachments().map(|one| {
            let error = world.grip_error(name, one.link).ok().flatten();
            error.map_or(0.0, |error| error.distance)
        });
        let lag = errors.fold(0.0, f64::max);
        let force = world.support_force(name).unwrap_or(0.0);
        if lag > GREATEST_LAG || force > GREATEST_FORCE {
            let pressed = world.supports(name).unwrap_or_default();
            let most = pressed
                .into_iter()
                .max_by(|a, b| a.force.total_cmp(&b.force));
            let against = most.map(|m| m.body);
            return Some(StuckObject {
                object: name.to_owned(),
                lag,
                force,
                against,
            });
        }
    }
    None
}
