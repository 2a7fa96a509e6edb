//! Contact forces between bodies, as of the last physics step.

use nalgebra::Vector3;

use super::body_name::BodyName;
use super::error::WorldError;
use super::object::Object;
use super::part_key::PartKey;
use super::physics::{BodyHandle, GRAVITY, RawContact};
use super::scene::World;
use crate::robot::Side;
use crate::spatial::pose::{angle_between, distance_between};

/// The force that one body exerts on another.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ContactForce {
    /// The other body.
    pub(crate) body: BodyName,
    /// Sum of the normal forces (N), averaged over the last step.
    pub(crate) force: f64,
}

/// A place at which a body presses on an object.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Press {
    /// The body.
    pub(crate) body: BodyName,
    /// Where (m, map frame).
    pub(crate) at: Vector3<f64>,
    /// The normal force on the object (N, map frame), averaged over the last step.
    pub(crate) force: Vector3<f64>,
}

/// How far a held object lags behind the link that carries it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WeldError {
    /// Distance (m) between where the object is and where it was gripped.
    pub(crate) distance: f64,
    /// Angle (rad) between the two orientations.
    pub(crate) angle: f64,
    /// Force (N) that the weld exerts.
    pub(crate) force: f64,
}

impl World {
    /// Where and how the bodies that touch an object press on it, in a fixed order.
    pub(crate) fn presses(&self, object: &Object) -> Vec<Press> {
        let mut presses = Vec::new();
        self.physics.visit_contacts(object.body, |contact| {
            if let Some(body) = self.body_name(PartKey::from_code(contact.other)) {
                presses.push(Press {
                    body,
                    at: contact.at,
                    force: contact.push,
                });
            }
        });
        presses
    }

    /// What presses on the object, in a fixed order.
    pub(crate) fn object_contacts(&self, name: &str) -> Result<Vec<ContactForce>, WorldError> {
        let body = self.object(name)?.body;
        Ok(self.forces_on(body, |_| true))
    }

    /// Sum of the forces (N) on the object from anything but the robot: its support and what it
    /// bumps into.
    pub(crate) fn support_force(&self, name: &str) -> Result<f64, WorldError> {
        let mut sum = 0.0;
        self.physics
            .visit_contacts(self.object(name)?.body, |contact| {
                if !matches!(PartKey::from_code(contact.other), PartKey::Robot(_)) {
                    sum += contact.force;
                }
            });
        Ok(sum)
    }

    /// The force (N) with which the robot presses the object down, by friction, too: what carries
    /// it bears that besides the object's weight. Zero if the robot does not touch it.
    pub(crate) fn pressed_down(&self, name: &str) -> Result<f64, WorldError> {
        let object = self.object(name)?;
        let mut is_touched = false;
        let mut load = -object.mass * GRAVITY;
        self.physics.visit_contacts(object.body, |contact| {
            if matches!(PartKey::from_code(contact.other), PartKey::Robot(_)) {
                is_touched = true;
            } else {
                load += contact.push.z;
            }
        });
        Ok(if is_touched { load.max(0.0) } else { 0.0 })
    }

    /// Whether the object presses on anything but the robot.
    pub(super) fn touches_others(&self, object: &Object) -> bool {
        let mut touches = false;
        self.physics.visit_contacts(object.body, |contact| {
            touches |= !matches!(PartKey::from_code(contact.other), PartKey::Robot(_));
        });
        touches
    }

    /// What carries or stops the object, except the robot.
    pub(crate) fn supports(&self, name: &str) -> Result<Vec<ContactForce>, WorldError> {
        let mut forces = self.object_contacts(name)?;
        forces.retain(|f| f.body.robot_link().is_none());
        Ok(forces)
    }

    /// What each of the two fingers of a hand touches: first the one that closes from the
    /// left, then the one from the right.
    pub(crate) fn finger_contacts(&self, side: Side) -> [Vec<ContactForce>; 2] {
        let [left, right] = &self.models.description.arm(side).gripper.fingers;
        [left, right].map(|finger| {
            let mut forces: Vec<ContactForce> = Vec::new();
            for &link in finger {
                let own = PartKey::Robot(super::part_key::index(link)).code();
                let Some((body, _)) = self.body_of_link(link) else {
                    continue;
                };
                for one in self.forces_on(body, |contact| contact.own == own) {
                    add(&mut forces, one);
                }
            }
            forces
        })
    }

    /// How far the held object lags behind its grip; `None` if nothing holds it.
    pub(crate) fn weld_error(&self, name: &str) -> Result<Option<WeldError>, WorldError> {
        let object = self.object(name)?;
        let Some(attachment) = object.attachment else {
            return Ok(None);
        };
        let wanted = self.link_pose(attachment.link) * attachment.at;
        let real = self.physics.pose(object.body);
        Ok(Some(WeldError {
            distance: distance_between(&wanted, &real),
            angle: angle_between(&wanted, &real),
            force: self.physics.weld_force(attachment.weld),
        }))
    }

    pub(super) fn forces_on(
        &self,
        body: BodyHandle,
        counts: impl Fn(&RawContact) -> bool,
    ) -> Vec<ContactForce> {
        let mut forces = Vec::new();
        self.physics.visit_contacts(body, |contact| {
            if !counts(&contact) {
                return;
            }
            if let Some(body) = self.body_name(PartKey::from_code(contact.other)) {
                add(
                    &mut forces,
                    ContactForce {
                        body,
                        force: contact.force,
                    },
                );
            }
        });
        forces
    }
}

fn add(forces: &mut Vec<ContactForce>, one: ContactForce) {
    match forces.iter_mut().find(|f| f.body == one.body) {
        Some(known) => known.force += one.force,
        None => forces.push(one),
    }
}
