//! The torque that the pads of two fingers transmit.

use std::f64::consts::PI;

use nalgebra::Vector3;
use parry3d_f64::math::Vector;
use parry3d_f64::query::Ray;

use crate::robot::description::Gripper;
use crate::world::Object;
use crate::world::solid::to_parry;
use spatial::Pose;

/// How far (m) behind the tool point the middle of the pads is around something thin.
const BEHIND: f64 = 0.01;

/// How two pads hold an object.
pub(crate) struct Pads {
    /// The middle between them (m, map frame).
    at: Vector3<f64>,
    /// The axis through both (map frame).
    axis: Vector3<f64>,
    /// The gap between them (m).
    gap: f64,
    /// The radius (m) of the disc on which each presses, as large as the pad.
    radius: f64,
    /// The force (N) with which each presses.
    press: f64,
    /// The force (N) that friction on both transmits.
    strength: f64,
}

/// A torque that is more than pads transmit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ExcessTorque {
    /// The torque (Nm) that the load exerts.
    pub torque: f64,
    /// The greatest torque (Nm) that they transmit.
    pub limit: f64,
}

impl Pads {
    /// Those of a gripper with the tool at a pose in the map frame, which press on the object with a force
    /// (N) from both sides of a gap (m); `None` if their size is not known.
    pub(crate) fn new(
        gripper: &Gripper,
        object: &Object,
        tool: &Pose,
        gap: f64,
        press: f64,
    ) -> Option<Self> {
        let [length, width] = gripper.pad_size?;
        Some(Self {
            at: tool.translation.vector - tool.rotation * Vector3::x() * BEHIND,
            axis: tool.rotation * Vector3::y(),
            gap,
            radius: (length * width / PI).sqrt(),
            press,
            strength: 2.0 * object.friction * press,
        })
    }

    /// Those that press on something with a force (N) from both sides of a gap (m) around a point; `None` if
    /// their size is not known. All is in a frame whose z axis is up.
    pub(crate) fn between(
        gripper: &Gripper,
        friction: f64,
        at: Vector3<f64>,
        axis: Vector3<f64>,
        gap: f64,
        press: f64,
    ) -> Option<Self> {
        let [length, width] = gripper.pad_size?;
        Some(Self {
            at,
            axis,
            gap,
            radius: (length * width / PI).sqrt(),
            press,
            strength: 2.0 * friction * press,
        })
    }

    /// Those that will close, from so far apart (m), on an object which is at a pose in the map frame.
    pub(crate) fn closing(
        gripper: &Gripper,
        object: &Object,
        object_at: &Pose,
        tool: &Pose,
        opening: f64,
        press: f64,
    ) -> Option<Self> {
        let mut pads = Self::new(gripper, object, tool, opening, press)?;
        let way = |side: f64| {
            let from = pads.at + pads.axis * (side * opening / 2.0);
            let [from, ahead] = [from, pads.axis * -side].map(|v| Vector::new(v.x, v.y, v.z));
            let ray = Ray::new(from, ahead);
            let hits = object.solids.iter().filter_map(|solid| {
                let at = to_parry(object_at) * solid.pose;
                solid.shape.cast_ray(&at, &ray, opening, true)
            });
            hits.reduce(f64::min)
        };
        if let (Some(left), Some(right)) = (way(1.0), way(-1.0)) {
            pads.gap = (opening - left - right).max(0.0);
        }
        Some(pads)
    }

    /// The gap between them (m).
    pub(crate) fn gap(&self) -> f64 {
        self.gap
    }

    /// The torque of a load (N) that acts at a point (m, map frame), if they do not transmit that much.
    ///
    /// Two soft fingers are taken, each of whose pads presses evenly on a disc. About the axis through
    /// both pads, such discs transmit 2/3 of friction × force × radius (Murray, Li, Sastry: A Mathematical
    /// Introduction to Robotic Manipulation, 1994, section 5.2), and less the more of the friction
    /// carries the load itself: both together stay within an ellipsoid (Howe, Cutkosky: Practical
    /// Force-Motion Models for Sliding Manipulation, IJRR 15(6), 1996). About the axes across it, friction
    /// acts at the gap's width, and the middle of a disc's pressure can move by a quarter of its radius
    /// before its edge lifts off.
    pub(crate) fn excess(&self, load: f64, at: &Vector3<f64>) -> Option<ExcessTorque> {
        // It would slip out before it turns.
        if load >= self.strength {
            return None;
        }
        let torque = (at - self.at).cross(&Vector3::new(0.0, 0.0, -load));
        let about = torque.dot(&self.axis);
        let across = (torque - self.axis * about).norm();
        let share = load / self.strength;
        let free = (1.0 - share * share).sqrt();
        let about_limit = 2.0 / 3.0 * self.strength * self.radius * free;
        let across_limit = self.strength / 2.0 * self.gap + self.press * self.radius / 2.0;
        [(about.abs(), about_limit), (across, across_limit)]
            .into_iter()
            .find(|(torque, limit)| torque > limit)
            .map(|(torque, limit)| ExcessTorque { torque, limit })
    }
}
