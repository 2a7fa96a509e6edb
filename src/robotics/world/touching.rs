//! What touches what, and how far bodies extend, by their shapes.

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::math::Pose as ParryPose;

use super::body_name::BodyName;
use super::error::WorldError;
use super::part_key::{PartKey, index};
use super::scene::World;
use super::separation::{lowest_point, separation};
use super::solid::{Solid, to_parry};

/// The widest gap (m) between two bodies that touch: the engine lets things rest that far apart.
const GAP: f64 = 0.001;

impl World {
    /// What an object touches: furniture, then the robot, then other objects, then the floor. What only
    /// leans on it by the engine's reckoning counts, too.
    pub fn touching(&self, name: &str) -> Result<Vec<BodyName>, WorldError> {
        let object = self.object(name)?;
        let at = to_parry(&self.physics.pose(object.body));
        let near = object.bounds.transform_by(&at).loosened(GAP);
        let touches = |solid: &Solid, pose: &ParryPose| {
            object.solids.iter().any(|own| {
                let at = at * own.pose;
                separation(&at, own, pose, solid, GAP).is_some()
            })
        };
        let mut found: Vec<PartKey> = Vec::new();
        for place in self.state.furniture.places_near(&near) {
            // The places are those of this list.
            let other = &self.state.furniture.all()[place];
            if !found.contains(&other.key) && touches(&other.solid, &other.placed.pose) {
                found.push(other.key);
            }
        }
        for link in &self.models.robot_geometry.solid_links {
            let pose = to_parry(&self.link_pose(link.link));
            let is_near = link.bounds.transform_by(&pose).intersects(&near);
            if is_near && link.solids.iter().any(|s| touches(s, &(pose * s.pose))) {
                found.push(PartKey::Robot(index(link.link)));
            }
        }
        for other in self.objects().filter(|other| other.key() != object.key()) {
            let pose = to_parry(&self.physics.pose(other.body));
            let is_near = other.bounds.transform_by(&pose).intersects(&near);
            if is_near && other.solids.iter().any(|s| touches(s, &(pose * s.pose))) {
                found.push(other.key());
            }
        }
        let on_floor = object
            .solids
            .iter()
            .any(|solid| lowest_point(&(at * solid.pose), solid).z <= GAP);
        if on_floor {
            found.push(PartKey::Floor);
        }
        let mut names: Vec<BodyName> = found
            .iter()
            .filter_map(|key| self.body_name(*key))
            .collect();
        for contact in self.object_contacts(name)? {
            if contact.force > 0.0 && !names.contains(&contact.body) {
                names.push(contact.body);
            }
        }
        Ok(names)
    }

    /// The box around a body in the map frame (m), its lower and its upper corner; of the robot and the
    /// kitchen, around one link. `None` if it has no shape.
    pub fn box_of(&self, body: &BodyName) -> Option<[[f64; 3]; 2]> {
        let bounds = match body {
            BodyName::Floor => return None,
            BodyName::Object(name) => {
                let object = self.object(name).ok()?;
                let at = to_parry(&self.physics.pose(object.body));
                let solids = object.solids.iter();
                union(solids.map(|solid| solid.shape.compute_aabb(&(at * solid.pose))))
            }
            BodyName::Furniture(link) => {
                let key = PartKey::Furniture(index(link.id));
                let all = self.state.furniture.all().iter();
                union(all.filter(|o| o.key == key).map(|o| o.placed.bounds))
            }
            BodyName::Robot(link) => {
                let at = to_parry(&self.link_pose(link.id));
                let links = &self.models.robot_geometry.solid_links;
                let link = links.iter().find(|solids| solids.link == link.id)?;
                let solids = link.solids.iter();
                union(solids.map(|solid| solid.shape.compute_aabb(&(at * solid.pose))))
            }
        };
        bounds.map(|b| [b.mins.to_array(), b.maxs.to_array()])
    }

    /// The links of the robot that have a shape, in the order of its tree.
    pub fn solid_robot_links(&self) -> impl Iterator<Item = BodyName> {
        let links = self.models.robot_geometry.solid_links.iter();
        links.filter_map(|l| self.body_name(PartKey::Robot(index(l.link))))
    }

    /// The links of the kitchen that have a shape, in the order of its tree.
    pub fn solid_kitchen_links(&self) -> impl Iterator<Item = BodyName> {
        let links = self.models.kitchen_geometry.solid_links.iter();
        links.filter_map(|l| self.body_name(PartKey::Furniture(index(l.link))))
    }
}

fn union(boxes: impl Iterator<Item = Aabb>) -> Option<Aabb> {
    boxes.reduce(|a, b| a.merged(&b))
}
