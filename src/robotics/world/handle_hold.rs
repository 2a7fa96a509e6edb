//! Hands that hold the handles of drawers and doors, or knobs, and the joints that follow them.
//!
//! Robot and kitchen are kinematic: no force moves them. So what friction does between pads and
//! bar is a rule. While the fingers are as close together as when they pressed, the joint takes in
//! every step the position at which the held point of the bar is nearest to where the hand carries
//! it. A hand that turns about a bar with corners has its fingers pushed apart by them. The joint
//! stays behind if something stops the part, if the part is pressed against something with more
//! than the pads transmit, or if they do not even overcome the friction of its rails or hinges. The
//! hand slips off once the held point is farther than [`GREATEST_GAP`] from the hand, or the hand
//! has been turned farther than rubber pads yield. A knob is turned by the turn of the hand about its axis, as long
//! as the pads transmit the torque that this takes.

use serde::Serialize;

use super::allowed_pairs::AllowedPairs;
use super::body_name::BodyName;
use super::collision::CollisionHit;
use super::error::WorldError;
use super::hash::Hasher;
use super::knob::Knob;
use super::moved_part::Part;
use super::scene::{World, pose_of};
use super::solid::{Solid, from_parry_vector, to_parry};
use super::two_stages::{AT_END, freeing_joint, has_turned};
use crate::robot::{JointId, JointKind, LinkId, Side};
use nalgebra::{Point3, Translation3, UnitQuaternion, Vector3};
use spatial::{Pose, trig};

/// How far (m) the held point of a bar may be from where the hand carries it.
pub(crate) const GREATEST_GAP: f64 = 0.005;
/// How far (rad) a hand may be turned on a bar about any axis but that of the bar.
const GREATEST_TWIST: f64 = 0.1;
/// How far (rad) a hand may be turned about the bar, to each side: rubber pads roll on it.
pub(crate) const GREATEST_PIVOT: f64 = 0.75;
/// How far (rad) a finger joint opens before its fingers count as pressing no more.
const OPENED: f64 = 1e-4;
/// How far (m) a bar sinks into both pads together, at most: they are of rubber.
const MAX_GIVE: f64 = 0.002;
/// Coefficient of friction of the pads on a bar.
const PAD_FRICTION: f64 = 1.0;
/// The force (N) at the handle that it takes to move a drawer on its rails or a door in its
/// hinges: an assumption, the kitchen's description says nothing.
const RUNNING_FORCE: f64 = 8.0;
/// The torque (Nm) that it takes to turn a knob: an assumption, likewise.
const KNOB_TORQUE: f64 = 0.3;
/// How far (rad) a hand may turn on a knob that stays behind.
const GREATEST_KNOB_SLIP: f64 = 0.1;
/// A part that is pressed against something with more than this (N) is not moved any further.
const CRUSHING_FORCE: f64 = 50.0;
/// Overlap (m) of a part with the robot that stops it.
const CONTACT: f64 = 0.0005;
/// Rounds of the search for the position of a joint, and by how much (m or rad) it is moved for a derivative.
const ROUNDS: u32 = 3;
const DIFFERENCE: f64 = 1e-4;
/// How thick (m) a bar may be.
const THICKEST: f64 = 0.06;
/// The joint is where it should be if the two differ by less than this (m or rad).
const STILL: f64 = 1e-9;

/// How a hand holds a handle.
#[derive(Clone, Debug, PartialEq)]
pub struct HandleHold {
    /// The hand.
    pub side: Side,
    /// The link that has the bar.
    pub handle: LinkId,
    /// The joint that moves it.
    pub joint: JointId,
    /// The pose of the handle in the frame of the palm when it was gripped.
    grip: Pose,
    /// The held point (m) of the bar, in the frame of the handle.
    point: Point3<f64>,
    /// The direction of the bar in the frame of the handle.
    bar: Vector3<f64>,
    /// Position of the finger joint (rad) at which the fingers press now.
    fingers: f64,
    /// The gap between the pads minus the width of the bar there (m): negative, since pads yield.
    give: f64,
    /// The greatest force (N) that friction transmits.
    strength: f64,
    /// The knob that is held, if it is one.
    knob: Option<Knob>,
    /// What stops the part, if it does not follow.
    against: Option<Box<CollisionHit>>,
    /// In which direction the joint was last to move: 1, -1, or 0.
    direction: i8,
}

impl HandleHold {
    /// What stops the drawer or door, if it does not follow the hand.
    pub(crate) fn against(&self) -> Option<&CollisionHit> {
        self.against.as_deref()
    }

    /// The pose of the handle in the frame of the palm when it was gripped.
    pub fn grip(&self) -> &Pose {
        &self.grip
    }

    /// The held point (m) of the bar, in the frame of the handle.
    pub fn point(&self) -> &Point3<f64> {
        &self.point
    }

    /// The direction of the bar in the frame of the handle.
    pub fn bar(&self) -> &Vector3<f64> {
        &self.bar
    }

    pub(super) fn hash_into(&self, hasher: &mut Hasher) {
        hasher.integer(u64::from(self.side == Side::Left));
        hasher.integer(self.handle.index() as u64);
        hasher.integer(self.joint.index() as u64);
        hasher.pose(&self.grip);
        hasher.number(self.fingers);
        hasher.number(self.give);
        hasher.number(self.strength);
    }
}

/// A handle that a hand has lost.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HandleSlip {
    /// The hand.
    pub side: Side,
    /// The handle.
    pub handle: BodyName,
    /// Name of the joint that it moves.
    pub joint: String,
    /// Where the joint is (rad or m).
    pub position: f64,
    /// How far (m) the hand was from the held point of the bar.
    pub gap: f64,
    /// What stopped the part, if something did.
    pub(crate) against: Option<CollisionHit>,
    /// The number of the step in which it happened.
    pub step: u64,
}

impl World {
    /// Makes the hand hold a handle, with its fingers pressing on the bar as they are now, each
    /// with the effort (N). `false` if the link is not moved by a joint.
    pub(crate) fn hold_handle(&mut self, side: Side, handle: LinkId, effort: f64) -> bool {
        let kitchen = &self.models.kitchen;
        let moving = |joint: &JointId| kitchen.joint(*joint).is_actuated();
        let Some(joint) = kitchen.ancestors(handle).find(moving) else {
            return false;
        };
        let arm = self.models.description.arm(side);
        let palm = self.link_pose(arm.gripper.palm);
        let tool = arm.tool_for_wrist(&self.link_pose(arm.wrist));
        let pose = self.furniture_pose(handle);
        let (bar, _) = self.bar(handle);
        let middle = self.bar_middle(handle);
        let tool = pose.inverse_transform_point(&Point3::from(tool.translation.vector));
        let grip = palm.inv_mul(&pose);
        let fingers = self.state.robot.joints.get(arm.gripper.joint);
        let give = arm.gripper.gap(fingers) - self.width_of_bar(handle, &grip);
        let mut hold = HandleHold {
            side,
            handle,
            joint,
            grip,
            point: Point3::from(middle + bar * (tool.coords - middle).dot(&bar)),
            bar,
            fingers,
            give: give.max(-MAX_GIVE),
            strength: 2.0 * PAD_FRICTION * effort,
            knob: self.models.knob(handle).filter(|knob| knob.joint == joint),
            against: None,
            direction: 0,
        };
        self.release_handle(side);
        hold.fingers = self.spread_fingers(&hold);
        self.state.handles.push(hold);
        true
    }

    /// The direction of a handle's bar in its frame, along which its longest solid is longest, and
    /// half of its length (m); of a knob, that of its axis, away from what it is fixed to.
    pub fn bar(&self, handle: LinkId) -> (Vector3<f64>, f64) {
        if let Some(knob) = self.models.knob(handle) {
            return (knob.outward, (knob.ends[1] - knob.ends[0]) / 2.0);
        }
        let Some(bar) = self.bar_solid(handle) else {
            return (Vector3::z(), 0.0);
        };
        let half = bar.bounds.half_extents();
        if half.x >= half.y && half.x >= half.z {
            (Vector3::x(), half.x)
        } else if half.y >= half.z {
            (Vector3::y(), half.y)
        } else {
            (Vector3::z(), half.z)
        }
    }

    /// How wide (m) a handle's bar is between the fingers, by the pose of the handle in the frame
    /// of the palm, along whose y axis the fingers close.
    fn width_of_bar(&self, handle: LinkId, grip: &Pose) -> f64 {
        let Some(bar) = self.bar_solid(handle) else {
            return 0.0;
        };
        let (along, _) = self.bar(handle);
        let closing = grip.rotation.inverse() * Vector3::y();
        let across = closing - along * along.dot(&closing);
        let Some(turn) = UnitQuaternion::rotation_between(&across, &Vector3::y()) else {
            return 0.0;
        };
        let turn = to_parry(&Pose::from_parts(Translation3::identity(), turn));
        2.0 * bar.shape.compute_aabb(&(turn * bar.pose)).half_extents().y
    }

    /// The middle (m) of a handle's bar, in its frame; the origin of a knob.
    pub(crate) fn bar_middle(&self, handle: LinkId) -> Vector3<f64> {
        if self.models.knob(handle).is_some() {
            return Vector3::zeros();
        }
        let bar = self.bar_solid(handle);
        bar.map_or_else(Vector3::zeros, |bar| from_parry_vector(bar.bounds.center()))
    }

    /// Whether fingers go around the bar of a link: it is thin across its length.
    pub(crate) fn has_bar(&self, handle: LinkId) -> bool {
        let half = self.bar_solid(handle).map(|bar| bar.bounds.half_extents());
        half.is_some_and(|half| {
            let mut sides = [half.x, half.y, half.z];
            sides.sort_by(f64::total_cmp);
            sides[1] <= THICKEST / 2.0
        })
    }

    /// The mean place (m) of the posts that carry a handle's bar, from the bar's middle, in the handle's
    /// frame; zero if it has none.
    pub(crate) fn handle_posts(&self, handle: LinkId) -> Vector3<f64> {
        let solids = self.handle_solids(handle);
        let Some(bar) = self.bar_solid(handle) else {
            return Vector3::zeros();
        };
        let middle = from_parry_vector(bar.bounds.center());
        let posts = solids.iter().filter(|solid| !std::ptr::eq(*solid, bar));
        let places: Vec<Vector3<f64>> = posts
            .map(|post| from_parry_vector(post.bounds.center()) - middle)
            .collect();
        let sum: Vector3<f64> = places.iter().sum();
        sum / (places.len().max(1) as f64)
    }

    /// The bar of a handle: its longest solid, the first of several.
    fn bar_solid(&self, handle: LinkId) -> Option<&Solid> {
        let length = |solid: &Solid| {
            let half = solid.bounds.half_extents();
            half.x.max(half.y).max(half.z)
        };
        let solids = self.handle_solids(handle).iter();
        solids.reduce(|longest, solid| match length(solid) > length(longest) {
            true => solid,
            false => longest,
        })
    }

    fn handle_solids(&self, handle: LinkId) -> &[Solid] {
        let mut links = self.models.kitchen_geometry.solid_links.iter();
        let found = links.find(|l| l.link == handle);
        found.map_or(&[], |l| l.solids.as_slice())
    }

    /// How the hand holds a handle, if it does.
    pub fn handle_hold(&self, side: Side) -> Option<&HandleHold> {
        self.state.handles.iter().find(|hold| hold.side == side)
    }

    /// Lets go of the handle that the hand holds.
    pub fn release_handle(&mut self, side: Side) {
        self.state.handles.retain(|hold| hold.side != side);
    }

    /// Lets go of all handles that a joint moves, or of all.
    pub(super) fn release_handles(&mut self, of: Option<JointId>) {
        self.state
            .handles
            .retain(|hold| of.is_some_and(|joint| joint != hold.joint));
    }

    /// The last handle that has slipped out of one of the hands in that step or later.
    pub(crate) fn handle_slip_since(
        &self,
        step: u64,
        is_hand: impl Fn(Side) -> bool,
    ) -> Option<&HandleSlip> {
        let mut slips = self.state.handle_slips.iter();
        slips.find(|slip| slip.step >= step && is_hand(slip.side))
    }

    /// How far (m) the held point of the bar is from where the hand carries it.
    #[cfg(test)]
    pub(crate) fn handle_gap(&self, side: Side) -> Option<f64> {
        let hold = self.handle_hold(side)?;
        let carried = self.carried(hold) * hold.point;
        let real = self.furniture_pose(hold.handle) * hold.point;
        Some((carried - real).norm())
    }

    /// By how much (rad) the hand has been turned about the bar since it gripped it.
    pub(crate) fn handle_pivot(&self, hold: &HandleHold) -> f64 {
        let real = self.furniture_pose(hold.handle).rotation;
        let carried = self.carried(hold).rotation;
        turns(&(real.inverse() * carried), &hold.bar)[0]
    }

    /// Where the hand carries the handle, in the map frame.
    fn carried(&self, hold: &HandleHold) -> Pose {
        let palm = self.models.description.arm(hold.side).gripper.palm;
        self.link_pose(palm) * hold.grip
    }

    /// Moves the joints of held handles to where the hands come to be in the next step. Call
    /// before a step in which the robot moves.
    pub(super) fn follow_hands(&mut self) {
        for mut hold in std::mem::take(&mut self.state.handles) {
            let gripper = &self.models.description.arm(hold.side).gripper;
            if self.state.robot.joints.get(gripper.joint) > hold.fingers + OPENED {
                continue;
            }
            hold.against = None;
            for joint in self.joints_of(&hold) {
                if self.is_locked(&hold, joint) {
                    continue;
                }
                let wanted = self.wanted_position(&hold, joint);
                let now = self.state.kitchen.get(joint);
                if (wanted - now).abs() > STILL {
                    let direction = if wanted > now { 1 } else { -1 };
                    let part = self.part(joint);
                    let goes_on = hold.direction == direction;
                    match self.stops(&hold, &part, wanted, goes_on) {
                        Some(stopped) => hold.against = stopped.map(Box::new),
                        None => self.follow(joint, wanted),
                    }
                    hold.direction = direction;
                }
            }
            let carried = self.carried(&hold);
            let real = self.furniture_pose(hold.handle);
            let gap = (carried * hold.point - real * hold.point).norm();
            let [pivot, twist] = turns(&(real.rotation.inverse() * carried.rotation), &hold.bar);
            let greatest = match &hold.knob {
                Some(_) => GREATEST_KNOB_SLIP,
                None => GREATEST_PIVOT,
            };
            if gap <= GREATEST_GAP && pivot.abs() <= greatest && twist <= GREATEST_TWIST {
                hold.fingers = self.spread_fingers(&hold);
                self.state.handles.push(hold);
                continue;
            }
            let slip = HandleSlip {
                side: hold.side,
                handle: self.models.furniture_body(hold.handle),
                joint: self.models.kitchen.joint(hold.joint).name.clone(),
                position: self.state.kitchen.get(hold.joint),
                gap,
                against: hold.against.map(|hit| *hit),
                step: self.state.steps,
            };
            self.state.handle_slips.retain(|old| old.side != slip.side);
            self.state.handle_slips.push(slip);
        }
    }

    /// Lets the fingers be as far apart as the bar between them is wide; the position of their
    /// joint (rad).
    fn spread_fingers(&mut self, hold: &HandleHold) -> f64 {
        let gripper = &self.models.description.arm(hold.side).gripper;
        let joint = gripper.joint;
        let palm = self.link_pose(gripper.palm);
        let grip = palm.inv_mul(&self.furniture_pose(hold.handle));
        let gap = self.width_of_bar(hold.handle, &grip) + hold.give;
        let position = gripper.position_for_gap(gap);
        let mut robot = self.state.robot.clone();
        robot.joints.set(joint, position);
        self.set_robot_configuration(&robot);
        position
    }

    fn follow(&mut self, joint: JointId, position: f64) {
        self.set_joint(joint, position);
        self.state.kitchen_moves = true;
    }

    /// The joints that follow the hand: for a door that comes out before it turns, what lets it out, too.
    fn joints_of(&self, hold: &HandleHold) -> Vec<JointId> {
        let freeing = freeing_joint(&self.models.kitchen, hold.joint);
        freeing.into_iter().chain([hold.joint]).collect()
    }

    /// Whether a joint cannot move: a door does not turn before it has come out, and does not go in before it
    /// has turned back.
    fn is_locked(&self, hold: &HandleHold, joint: JointId) -> bool {
        let kitchen = &self.models.kitchen;
        let Some(freeing) = freeing_joint(kitchen, hold.joint) else {
            return false;
        };
        if joint == freeing {
            return has_turned(kitchen, &self.state.kitchen, hold.joint);
        }
        let out = self.state.kitchen.get(freeing);
        let limits = kitchen.joint(freeing).limits;
        limits.is_some_and(|slide| out < slide.upper - AT_END)
    }

    /// The position (rad or m) of a joint, within its limits, at which the held point of the bar
    /// is nearest to where the hand carries it.
    fn wanted_position(&self, hold: &HandleHold, joint: JointId) -> f64 {
        let now = self.state.kitchen.get(joint);
        let joint = self.models.kitchen.joint(joint);
        let child = self.furniture_pose(joint.child);
        let axis = child.rotation * joint.axis.into_inner();
        let real = self.furniture_pose(hold.handle) * hold.point;
        let carried = self.carried(hold) * hold.point;
        let wanted = match joint.kind {
            _ if hold.knob.is_some() => {
                let sign = hold.knob.as_ref().map_or(1.0, |knob| knob.sign);
                now + sign * self.handle_pivot(hold)
            }
            _ if self.follows(hold) => self.wanted_of_leader(hold, carried),
            JointKind::Prismatic => now + axis.dot(&(carried - real)),
            _ => {
                // The joint's axis goes through the origin of its child.
                let origin = Point3::from(child.translation.vector);
                let across = |p: Point3<f64>| {
                    let arm = p - origin;
                    arm - axis * axis.dot(&arm)
                };
                let (from, to) = (across(real), across(carried));
                now + trig::atan2(axis.dot(&from.cross(&to)), from.dot(&to))
            }
        };
        joint.limits.map_or(wanted, |limits| limits.clamp(wanted))
    }

    /// Whether the handle is also moved by joints that follow the one that the hand moves.
    fn follows(&self, hold: &HandleHold) -> bool {
        let kitchen = &self.models.kitchen;
        let mut joints = kitchen.ancestors(hold.handle);
        joints.any(|joint| kitchen.joint(joint).mimic.is_some())
    }

    /// The position (rad or m) at which the held point is nearest to a point (m), for a handle that moves neither
    /// straight nor on a circle, as that of a front that folds.
    fn wanted_of_leader(&self, hold: &HandleHold, carried: Point3<f64>) -> f64 {
        let point = |position: f64| {
            let (_, poses) = self.kitchen_with(hold.joint, position);
            pose_of(&poses, hold.handle) * hold.point
        };
        let mut position = self.state.kitchen.get(hold.joint);
        for _ in 0..ROUNDS {
            let here = point(position);
            let tangent =
                (point(position + DIFFERENCE) - point(position - DIFFERENCE)) / (2.0 * DIFFERENCE);
            let square = tangent.norm_squared();
            if square <= f64::EPSILON {
                break;
            }
            position += tangent.dot(&(carried - here)) / square;
        }
        position
    }

    /// Whether something keeps the part from following the hand to a position (rad or m), and what,
    /// if it is not the hand's weakness.
    fn stops(
        &self,
        hold: &HandleHold,
        part: &Part,
        position: f64,
        goes_on: bool,
    ) -> Option<Option<CollisionHit>> {
        let is_weak = match &hold.knob {
            Some(knob) => hold.strength * knob.radius < KNOB_TORQUE,
            None => hold.strength < RUNNING_FORCE,
        };
        if is_weak {
            return Some(None);
        }
        let moved = self.moved(part, position);
        if let Some(hit) = moved.furniture_hit() {
            return Some(Some(hit));
        }
        let fingers = self.and_fingers_on(AllowedPairs::none(), hold);
        let robot = &self.state.robot;
        let is_of_part = |hit: &CollisionHit| match &hit.other {
            BodyName::Furniture(link) => part.links.contains(&link.id),
            BodyName::Object(name) => part.riders.contains(name),
            BodyName::Robot(_) | BodyName::Floor => false,
        };
        let hits = moved.checker().all_hits(robot, &fingers, -CONTACT);
        if let Some(hit) = hits.into_iter().find(is_of_part) {
            return Some(Some(hit));
        }
        let limit = hold.strength.min(CRUSHING_FORCE) - RUNNING_FORCE;
        let (body, force) = self.resistance(part).filter(|_| goes_on)?;
        (force > limit).then(|| {
            Some(CollisionHit {
                moving: self.models.furniture_body(hold.handle),
                other: body,
                depth: 0.0,
                point: self.furniture_pose(hold.handle) * hold.point,
            })
        })
    }

    /// Also allows the fingers to touch the handle that they hold.
    fn and_fingers_on(&self, pairs: AllowedPairs, hold: &HandleHold) -> AllowedPairs {
        let handle = self.models.furniture_body(hold.handle);
        let gripper = &self.models.description.arm(hold.side).gripper;
        let fingers = gripper.fingers.iter().flatten();
        pairs.and_all(fingers.map(|link| self.models.robot_body(*link)), &handle)
    }

    /// The pairs of fingers and the handles that they hold.
    pub(crate) fn fingers_on_handles(&self) -> AllowedPairs {
        let holds = self.state.handles.iter();
        holds.fold(AllowedPairs::none(), |pairs, hold| {
            self.and_fingers_on(pairs, hold)
        })
    }

    /// The name of a handle's joint and where it is (rad or m).
    pub(crate) fn joint_of_handle(&self, hold: &HandleHold) -> Result<(String, f64), WorldError> {
        let name = self.models.kitchen.joint(hold.joint).name.clone();
        let position = self.kitchen_joint(&name)?;
        Ok((name, position))
    }
}

/// The angles (rad) by which a rotation turns about an axis, and by which it tilts that axis.
fn turns(rotation: &UnitQuaternion<f64>, axis: &Vector3<f64>) -> [f64; 2] {
    let (imag, w) = (rotation.imag(), rotation.w);
    let pivot = 2.0 * trig::atan2(imag.dot(axis), w);
    let tilted = rotation * axis;
    let twist = trig::atan2(tilted.cross(axis).norm(), tilted.dot(axis));
    [trig::wrap(pivot), twist]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_about_the_bar_is_no_twist() {
        let axis = Vector3::y();
        let pivot = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -0.4);
        let twist = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.2);
        let near = |found: [f64; 2], expected: [f64; 2]| {
            let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs());
            assert!(off.fold(0.0, f64::max) < 1e-9, "{found:?}");
        };
        near(turns(&pivot, &axis), [-0.4, 0.0]);
        near(turns(&twist, &axis), [0.0, 0.2]);
        near(turns(&(twist * pivot), &axis), [-0.4, 0.2]);
    }
}
