//! What carries what: the body that holds an object up, and what that stands on in turn.

use super::body_name::BodyName;
use super::contacts::ContactForce;
use super::error::WorldError;
use super::physics::GRAVITY;
use super::scene::World;

/// What pushes an object up by less than this share of its weight does not carry it: the engine leaves
/// traces of forces where it has put bodies to sleep.
const MIN_SHARE: f64 = 0.05;

/// How far (m) above the body that carries it an object at rest may be, where the engine has no
/// contact that pushes it up.
const TOUCHING: f64 = 0.005;

impl World {
    /// The bodies that push the object up, except the robot, with the upward part of what they exert,
    /// in a fixed order.
    pub fn carrying_forces(&self, name: &str) -> Result<Vec<ContactForce>, WorldError> {
        let mut forces = self.pushes_up(name)?;
        forces.retain(|one| one.body.robot_link().is_none());
        Ok(forces)
    }

    /// The bodies that push the object up, with the upward part of what they exert, in a fixed order.
    fn pushes_up(&self, name: &str) -> Result<Vec<ContactForce>, WorldError> {
        let mut forces: Vec<ContactForce> = Vec::new();
        for press in self.presses(self.object(name)?) {
            match forces.iter_mut().find(|known| known.body == press.body) {
                Some(known) => known.force += press.force.z,
                None => forces.push(ContactForce {
                    body: press.body,
                    force: press.force.z,
                }),
            }
        }
        let least = MIN_SHARE * self.object(name)?.mass() * GRAVITY;
        forces.retain(|one| one.force > least);
        Ok(forces)
    }

    /// The bodies that carry the object, in a fixed order; of the robot, only links that do not hold it.
    pub fn carried_by(&self, name: &str) -> Result<Vec<BodyName>, WorldError> {
        let mut forces = self.pushes_up(name)?;
        if self.object(name)?.attachment().is_some() {
            forces.retain(|one| one.body.robot_link().is_none());
        }
        if forces.is_empty() {
            return Ok(self.resting_on(name)?.into_iter().collect());
        }
        Ok(forces.into_iter().map(|one| one.body).collect())
    }

    /// What carries most of the object, except the robot; `None` if it falls, or if a hand alone
    /// carries it.
    pub fn carrier(&self, name: &str) -> Result<Option<BodyName>, WorldError> {
        let forces = self.carrying_forces(name)?.into_iter();
        match forces.max_by(|a, b| a.force.total_cmp(&b.force)) {
            Some(most) => Ok(Some(most.body)),
            None => self.resting_on(name),
        }
    }

    /// What is just below an object at rest that no hand holds, for want of a contact that pushes it up.
    fn resting_on(&self, name: &str) -> Result<Option<BodyName>, WorldError> {
        let is_held = self.object(name)?.attachment().is_some();
        if is_held || self.moving_objects().any(|object| object.name() == name) {
            return Ok(None);
        }
        let below = self.below(name, &self.object_pose(name)?)?;
        Ok(below.and_then(|(gap, body)| (gap < TOUCHING).then_some(body)))
    }

    /// What carries the object, what carries that, and so on down to furniture or the floor, or to
    /// what a hand holds.
    pub fn carriers(&self, name: &str) -> Result<Vec<BodyName>, WorldError> {
        let mut chain = Vec::new();
        let mut next = self.carrier(name)?;
        while let Some(body) = next {
            // Things that lean on each other may carry each other.
            let is_known = body.object() == Some(name) || chain.contains(&body);
            next = match body.object() {
                Some(below) if !is_known => self.carrier(below)?,
                _ => None,
            };
            if is_known {
                break;
            }
            chain.push(body);
        }
        Ok(chain)
    }
}
