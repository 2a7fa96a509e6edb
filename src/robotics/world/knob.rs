//! Knobs, such as those of a stove: what a joint of its own turns about its middle.
//!
//! They are found from the shapes of the kitchen. A hand takes a knob from outside, across its axis, and turns
//! about that axis with it (`handle_hold`).

use nalgebra::{UnitQuaternion, Vector3};

use super::models::Models;
use super::scene::World;
use super::solid::to_parry;
use crate::robot::{JointId, JointKind, KinematicTree, LinkId};
use spatial::{Pose, trig};

/// How far (m) the middle of a knob may be from its axis.
const OFF_AXIS: f64 = 0.003;
/// Radii (m) of what fingers can take and turn.
const RADII: [f64; 2] = [0.004, 0.025];
/// Angle (rad) from the lower end of its joint at which a knob counts as on.
pub const KNOB_ON: f64 = 0.35;

/// A knob.
#[derive(Clone, Debug, PartialEq)]
pub struct Knob {
    /// The link that is turned.
    pub link: LinkId,
    /// The joint that turns it.
    pub joint: JointId,
    /// The direction of its axis away from what it is fixed to, in its frame.
    pub(crate) outward: Vector3<f64>,
    /// 1 if the joint turns about that direction, -1 if about the opposite one.
    pub(crate) sign: f64,
    /// Radius (m) of the circle about it.
    pub(crate) radius: f64,
    /// Where it begins and ends (m) along that direction, from its origin.
    pub(crate) ends: [f64; 2],
}

impl Models {
    /// All knobs of the kitchen, in its order.
    pub fn knobs(&self) -> Vec<Knob> {
        let links = self.kitchen.links().map(|(link, _)| link);
        links.filter_map(|link| self.knob(link)).collect()
    }

    /// The knob that a link of the kitchen is, if it is one.
    pub fn knob(&self, link: LinkId) -> Option<Knob> {
        let kitchen = &self.kitchen;
        let id = kitchen.ancestors(link).next()?;
        let joint = kitchen.joint(id);
        let turns = matches!(joint.kind, JointKind::Revolute | JointKind::Continuous);
        if !turns || joint.child != link || joint.mimic.is_some() || has_handle(kitchen, link) {
            return None;
        }
        let mut links = self.kitchen_geometry.solid_links.iter();
        let solids = &links.find(|one| one.link == link)?.solids;
        let axis = joint.axis.into_inner();
        // A turn after which the axis is the x axis.
        let turn = UnitQuaternion::rotation_between(&axis, &Vector3::x())
            .unwrap_or_else(half_turn_about_z);
        let turn = to_parry(&Pose::from_parts(Default::default(), turn));
        let mut bounds = solids
            .iter()
            .map(|s| s.shape.compute_aabb(&(turn * s.pose)));
        let body = bounds.next()?;
        let (center, half) = (body.center(), body.half_extents());
        let radius = half.y.max(half.z);
        if center.y.abs().max(center.z.abs()) > OFF_AXIS || !(RADII[0]..=RADII[1]).contains(&radius)
        {
            return None;
        }
        let sign = if center.x < 0.0 { -1.0 } else { 1.0 };
        let ends = [center.x * sign - half.x, center.x * sign + half.x];
        Some(Knob {
            link,
            joint: id,
            outward: axis * sign,
            sign,
            radius,
            ends,
        })
    }
}

impl World {
    /// The angle (rad) of a knob, and whether it is on.
    pub fn knob_state(&self, knob: &Knob) -> (f64, bool) {
        let kitchen = &self.models().kitchen;
        let angle = kitchen.position(self.kitchen_positions(), knob.joint);
        let limits = kitchen.joint(knob.joint).limits;
        let turned = limits.map_or_else(|| trig::wrap(angle).abs(), |l| angle - l.lower);
        (angle, turned >= KNOB_ON)
    }
}

fn half_turn_about_z() -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(0.0, 0.0, 0.0, 1.0))
}

/// Whether a handle is fixed to the link: then it is a door.
fn has_handle(kitchen: &KinematicTree, link: LinkId) -> bool {
    let mut fixed = kitchen
        .joints()
        .filter(|(_, joint)| joint.kind == JointKind::Fixed && joint.parent == link);
    fixed.any(|(_, joint)| kitchen.link(joint.child).name.contains("handle"))
}
