//! Contact forces between bodies, as of the last physics step.

use nalgebra::Vector3;

use super::body_name::BodyName;
use super::error::WorldError;
use super::object::{Attachment, Object};
use super::part_key::PartKey;
use super::physics::{BodyHandle, GRAVITY};
use super::scene::World;
use crate::robot::{LinkId, Side};
use spatial::pose::{angle_between, distance_between};

/// The force that one body exerts on another.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactForce {
    /// The other body.
    pub body: BodyName,
    /// Sum of the normal forces (N), averaged over the last step.
    pub force: f64,
}

/// A place at which a body presses on an object.
#[derive(Clone, Debug, PartialEq)]
pub struct Press {
    /// The body.
    pub body: BodyName,
    /// Where (m, map frame).
    pub at: Vector3<f64>,
    /// The normal force on the object (N, map frame), averaged over the last step.
    pub force: Vector3<f64>,
}

/// How far a held object lags behind the link that carries it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeldError {
    /// Distance (m) between where the object is and where it was gripped.
    pub distance: f64,
    /// Angle (rad) between the two orientations.
    pub angle: f64,
    /// Force (N) that the weld exerts.
    pub force: f64,
}

impl World {
    /// Where and how the bodies that touch an object press on it, in a fixed order.
    pub fn presses(&self, object: &Object) -> Vec<Press> {
        let mut presses = Vec::new();
        self.physics.visit_contacts(object.body, any, |contact| {
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
    pub fn object_contacts(&self, name: &str) -> Result<Vec<ContactForce>, WorldError> {
        let body = self.object(name)?.body;
        Ok(self.forces_on(body, any))
    }

    /// The links of the robot that press on the object, in a fixed order.
    pub(crate) fn robot_contacts(&self, name: &str) -> Result<Vec<ContactForce>, WorldError> {
        let body = self.object(name)?.body;
        Ok(self.forces_on(body, |_, other| is_robot(other)))
    }

    /// Sum of the forces (N) on the object from anything but the robot and grains: its support and what it
    /// bumps into.
    pub fn support_force(&self, name: &str) -> Result<f64, WorldError> {
        let mut sum = 0.0;
        let body = self.object(name)?.body;
        let counts = |_, other| is_outside(other);
        self.physics
            .visit_contacts(body, counts, |contact| sum += contact.force);
        Ok(sum)
    }

    /// The force (N) with which the robot presses the object down, by friction, too: what carries
    /// it bears that besides the object's weight. Zero if the robot does not touch it.
    pub(crate) fn pressed_down(&self, name: &str) -> Result<f64, WorldError> {
        let object = self.object(name)?;
        if !self.touches(object, is_robot) {
            return Ok(0.0);
        }
        let mut load = -object.mass * GRAVITY;
        let counts = |_, other| !is_robot(other);
        self.physics
            .visit_contacts(object.body, counts, |contact| load += contact.push.z);
        Ok(load.max(0.0))
    }

    /// Whether the object presses on anything but the robot and grains.
    pub(super) fn touches_others(&self, object: &Object) -> bool {
        self.touches(object, is_outside)
    }

    fn touches(&self, object: &Object, counts: impl Fn(u64) -> bool) -> bool {
        let mut touches = false;
        let counts = |_, other| counts(other);
        self.physics
            .visit_contacts(object.body, counts, |_| touches = true);
        touches
    }

    /// What carries or stops the object, except the robot.
    pub fn supports(&self, name: &str) -> Result<Vec<ContactForce>, WorldError> {
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
                for one in self.forces_on(body, |link, _| link == own) {
                    add(&mut forces, one);
                }
            }
            forces
        })
    }

    /// How far the held object lags behind its grip; `None` if nothing holds it.
    pub fn weld_error(&self, name: &str) -> Result<Option<WeldError>, WorldError> {
        let object = self.object(name)?;
        let attachment = object.attachment.as_ref();
        Ok(attachment.map(|attachment| self.error_of(object, attachment)))
    }

    /// How far the held object lags behind the grip of one of the links that hold it, and the force (N) of that grip;
    /// `None` if that does not hold it.
    pub(crate) fn grip_error(
        &self,
        name: &str,
        link: LinkId,
    ) -> Result<Option<WeldError>, WorldError> {
        let object = self.object(name)?;
        let attachment = object.attachment_to(link);
        Ok(attachment.map(|attachment| self.error_of(object, attachment)))
    }

    fn error_of(&self, object: &Object, attachment: &Attachment) -> WeldError {
        let wanted = self.link_pose(attachment.link) * attachment.at;
        let real = self.physics.pose(object.body);
        WeldError {
            distance: distance_between(&wanted, &real),
            angle: angle_between(&wanted, &real),
            force: self.physics.weld_force(attachment.weld),
        }
    }

    pub(super) fn forces_on(
        &self,
        body: BodyHandle,
        counts: impl Fn(u64, u64) -> bool,
    ) -> Vec<ContactForce> {
        let mut forces = Vec::new();
        self.physics.visit_contacts(body, counts, |contact| {
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

/// Every contact, whatever the codes of the two bodies.
fn any(_: u64, _: u64) -> bool {
    true
}

/// Whether that is the code of one of the robot's links.
fn is_robot(code: u64) -> bool {
    matches!(PartKey::from_code(code), PartKey::Robot(_))
}

/// Whether that is the code of what is neither the robot nor a grain in the object.
fn is_outside(code: u64) -> bool {
    !matches!(PartKey::from_code(code), PartKey::Robot(_) | PartKey::Grain)
}

fn add(forces: &mut Vec<ContactForce>, one: ContactForce) {
    match forces.iter_mut().find(|f| f.body == one.body) {
        Some(known) => known.force += one.force,
        None => forces.push(one),
    }
}
